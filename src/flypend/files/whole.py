"""Atomic file writes: a file appears complete or not at all."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from errno import ENAMETOOLONG
from pathlib import Path
from typing import TYPE_CHECKING
from uuid import uuid4

from flypend import errors, signals

if TYPE_CHECKING:
    from matplotlib.figure import Figure


FIGURES = (".png", ".pdf", ".svg")


def save_figure(figure: Figure, path: str | Path) -> None:
    """Write `figure` atomically to `path` (.png at the figure's dpi, .pdf or .svg).

    Raises InputError for any other suffix or an unwritable file.
    """
    import matplotlib as mpl  # imported here because other writers do not need it

    with whole_file(path, FIGURES) as partial:
        # Type 42 fonts keep PDF text as text, as publishers require. Without dates, equal figures give identical files.
        metadata = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}.get(partial.suffix.lower())
        with mpl.rc_context({"pdf.fonttype": 42, "svg.hashsalt": "flypend"}):
            figure.savefig(partial, dpi="figure", metadata=metadata)


def save_both(figure: Figure, path: Path) -> None:
    """Write `figure` to `path` with the suffixes .png and .pdf appended. Raises InputError like `save_figure`."""
    for suffix in (".png", ".pdf"):
        save_figure(figure, path.with_name(path.name + suffix))
        figure.set_layout_engine("none")  # laid out once: it takes as long as drawing


def check_file(path: str | Path, suffixes: Sequence[str], field: str = "path") -> None:
    """Raise InputError, of `field`, unless `path` has one of `suffixes` and is writable. Touches no existing file."""
    with suppress(_DroppedError), whole_file(path, suffixes, field):
        raise _DroppedError


def check_name(path: Path) -> None:
    """Raise InputError if no file can have the name `path`."""
    try:
        path.lstat()
    except (OSError, ValueError) as error:
        if isinstance(error, ValueError) or error.errno == ENAMETOOLONG:
            why = getattr(error, "strerror", error)
            raise errors.InputError(ascii(str(path)), "a name that a file can have", why) from None


def check_same(path: Path, content: bytes, what: str) -> None:
    """Raise InputError if another file than `what`, of this `content`, stands at `path`: it may hold someone's work."""
    if path.is_file() and path.read_bytes() != content:
        raise errors.InputError(str(path), f"no file, or {what} itself (--force overwrites it)", "another file")


class _DroppedError(Exception):
    """Raised inside `whole_file` to abandon the write."""


@contextmanager
def whole_file(path: str | Path, suffixes: Sequence[str], field: str = "path") -> Iterator[Path]:
    """Yield a temporary path beside `path`. If the block succeeds, rename it to `path`; otherwise delete it.

    Raises InputError if `path`, which messages call `field`, has none of `suffixes` or is not writable.
    """
    path = Path(path)
    if path.suffix.lower() not in suffixes:
        raise errors.InputError(field, "a file name ending in " + " or ".join(suffixes), str(path))
    check_name(path)
    partial = path.with_name(f".{uuid4().hex}{path.suffix}")
    try:
        if path.is_dir():
            raise errors.InputError(str(path), "a file that can be written", "a folder")
        signals.poll()
        partial.touch(exist_ok=False)
        yield partial
        signals.poll()
        partial.replace(path)
    except OSError as error:
        raise errors.InputError(str(path), "a file that can be written", error.strerror or error) from None
    finally:
        with suppress(OSError):  # a disk that is read-only says so also of what is not there
            partial.unlink()
