"""Files that are written whole or not at all."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING
from uuid import uuid4

from flypend import errors

if TYPE_CHECKING:
    from matplotlib.figure import Figure


FIGURES = (".png", ".pdf", ".svg")


def save_figure(figure: Figure, path: str | Path) -> None:
    """Write `figure` to `path` (.png at its dots per inch, .pdf or .svg), whole or not at all.

    Raises InputError for another suffix or a file that cannot be written.
    """
    import matplotlib as mpl  # here, for those who write other files

    with whole_file(path, FIGURES) as partial:
        # Type 42 keeps text in a PDF as text, which publishers ask for; no dates, so equal figures are equal files.
        metadata = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}.get(partial.suffix.lower())
        with mpl.rc_context({"pdf.fonttype": 42, "svg.hashsalt": "flypend"}):
            figure.savefig(partial, dpi="figure", metadata=metadata)


def save_both(figure: Figure, path: Path) -> None:
    """Write `figure` to files called `path`, as vectors (.pdf) and as .png. Raises InputError as `save_figure`."""
    for suffix in (".png", ".pdf"):
        save_figure(figure, path.with_name(path.name + suffix))


def check_file(path: str | Path, suffixes: Sequence[str]) -> None:
    """Raise InputError if `path` ends in none of `suffixes` or cannot be written. Leaves what is there as it is."""
    with suppress(_DroppedError), whole_file(path, suffixes):
        raise _DroppedError


class _DroppedError(Exception):
    """Leaves `whole_file` without a file."""


@contextmanager
def whole_file(path: str | Path, suffixes: Sequence[str]) -> Iterator[Path]:
    """Yield a name beside `path` to write to; what is there when the block ends becomes `path`, else it is removed.

    Raises InputError if `path` ends in none of `suffixes` or cannot be written.
    """
    path = Path(path)
    if path.suffix.lower() not in suffixes:
        raise errors.InputError("path", "a file name ending in " + " or ".join(suffixes), str(path))
    partial = path.with_name(f".{uuid4().hex}{path.suffix}")
    try:
        if path.is_dir():
            raise errors.InputError(str(path), "a file that can be written", "a folder")
        partial.touch(exist_ok=False)
        yield partial
        partial.replace(path)
    except OSError as error:
        raise errors.InputError(str(path), "a file that can be written", error.strerror or error) from None
    finally:
        if path.parent.is_dir():
            partial.unlink(missing_ok=True)
