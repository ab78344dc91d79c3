"""Output folders written to a staging folder first, so that no partial output is left behind."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from flypend import signals
from flypend.errors import InputError
from flypend.files.whole import check_name


def check_writable(out: str | Path) -> None:
    """Raise InputError unless `out` is, or can be created as, a writable folder. Leaves the file system unchanged."""
    beside = _beside(Path(out))
    before = beside.stat() if os.path.isdir(beside) else None  # noqa: PTH112 (as below)
    _open(Path(out)).rmdir()
    if before is not None:
        with suppress(PermissionError):  # whoever may write to a folder of somebody else may not set its times
            os.utime(beside, ns=(before.st_atime_ns, before.st_mtime_ns))


def write_texts(out: str | Path, texts: Mapping[str, str]) -> None:
    """Write `texts` by file name into the folder `out`, all or none. Raises InputError as `staging`."""
    with staging(out) as folder:
        for name, text in texts.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8", newline="\n")


@contextmanager
def staging(out: str | Path) -> Iterator[Path]:
    """Yield a staging folder. If the block succeeds, move its files into `out`; otherwise discard them.

    Raises InputError on entry unless `out` is, or can be created as, a writable folder.
    """
    out = Path(out)
    folder = _open(out)
    try:
        yield folder
        moves = [(path, out / path.relative_to(folder)) for path in sorted(folder.rglob("*")) if path.is_file()]
        for _, target in moves:  # check all targets before moving the first file
            _check_free(target, out)
        signals.poll()
        for source, target in moves:
            target.parent.mkdir(parents=True, exist_ok=True)
            source.replace(target)
    except OSError as error:
        where = error.filename
        if isinstance(where, str | Path) and not any(Path(where).is_relative_to(place) for place in (folder, out)):
            raise  # unrelated to `out`, such as a missing executable
        raise _unwritable(out, error) from None
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _open(out: Path) -> Path:
    """Create a temporary folder on the same file system as `out`: inside it if it exists, otherwise beside it."""
    check_name(out)
    if os.path.lexists(out) and not out.is_dir():
        raise InputError(str(out), "a folder", "a file" if out.exists() else "a link that leads nowhere")
    try:
        return Path(tempfile.mkdtemp(prefix=".flypend-partial-", dir=_beside(out)))
    except OSError as error:
        raise _unwritable(out, error) from None


def _beside(out: Path) -> Path:
    return out if os.path.isdir(out) else out.absolute().parent  # noqa: PTH112 (which raises for a name too long)


def _check_free(target: Path, out: Path) -> None:
    """Raise InputError if an existing path in `out` blocks the file `target` or one of its parent folders."""
    if target.is_dir():
        raise InputError(str(target), "a file or nothing", "a folder")
    for folder in target.relative_to(out).parents:
        if os.path.lexists(out / folder) and not (out / folder).is_dir():
            raise InputError(str(out / folder), "a folder or nothing", "a file")


def _unwritable(out: Path, error: OSError) -> InputError:
    return InputError(str(out), "a folder that can be written", error.strerror or error)
