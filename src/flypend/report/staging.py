"""An output folder that is filled elsewhere first, so that nothing half-written is left behind."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from flypend.errors import InputError


def check_writable(out: str | Path) -> None:
    """Raise InputError if `out` cannot become a folder that can be written. Leaves nothing behind."""
    _open(Path(out)).rmdir()


@contextmanager
def staged(out: str | Path) -> Iterator[Path]:
    """Give a temporary folder beside `out`; when the block ends well, move its files into `out`, else drop them.

    Raises InputError, before anything is computed, if `out` cannot become a folder that can be written.
    """
    out = Path(out)
    folder = _open(out)
    try:
        yield folder
        for source in sorted(path for path in folder.rglob("*") if path.is_file()):
            target = out / source.relative_to(folder)
            target.parent.mkdir(parents=True, exist_ok=True)
            source.replace(target)
    except OSError as error:
        raise _unwritable(out, error) from None
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _open(out: Path) -> Path:
    """A fresh folder on the file system of `out`: inside it if it exists, else beside it."""
    if out.exists() and not out.is_dir():
        raise InputError(str(out), "a folder", "a file")
    try:
        beside = out if out.is_dir() else out.absolute().parent
        return Path(tempfile.mkdtemp(prefix=f".{out.name}-partial-", dir=beside))
    except OSError as error:
        raise _unwritable(out, error) from None


def _unwritable(out: Path, error: OSError) -> InputError:
    return InputError(str(out), "a folder that can be written", error.strerror or error)
