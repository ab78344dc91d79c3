"""Figure formats: for a two-column paper or for slides. Both share font sizes and line widths."""

from __future__ import annotations

from dataclasses import dataclass

from flypend import errors


@dataclass(frozen=True)
class Style:
    """A figure format; lengths in inches.

    Parameters
    ----------
    half, full : (2,)
        Width and height of a small and of a large figure.
    columns : int
        Number of panel columns of a large figure.
    wide : float
        Columns over rows of the grid of stop-motion pictures.
    dpi : float
        Resolution of a .png, dots per inch.
    """

    half: tuple[float, float]
    full: tuple[float, float]
    columns: int
    wide: float
    dpi: float


STYLES = {
    "paper": Style(half=(3.4, 3.3), full=(7.16, 6.4), columns=2, wide=4 / 3, dpi=200),
    # Half the size of a 13.33 × 7.5 in slide, so 8 pt text and lines double in size; 1920 pixels wide.
    "slides": Style(half=(3.3, 3.3), full=(6.667, 3.75), columns=3, wide=1.9, dpi=288),
}


def style_named(name: str) -> Style:
    """The format called `name`, "paper" or "slides". Raises InputError for any other."""
    return STYLES[errors.one_of("--style", name, STYLES)]
