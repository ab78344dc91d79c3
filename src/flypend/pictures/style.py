"""Formats of figures: sized for a paper of two columns, or for slides. One set of letters and lines serves both."""

from __future__ import annotations

from dataclasses import dataclass

from flypend import errors


@dataclass(frozen=True)
class Style:
    """A format; lengths in inches.

    Parameters
    ----------
    half, full : (2,)
        Width and height of a small and of a large figure.
    columns : int
        Of the panels of a large figure.
    wide : float
        Width over height of the block of stop-motion pictures, in pictures.
    dpi : float
        Dots per inch of a .png.
    """

    half: tuple[float, float]
    full: tuple[float, float]
    columns: int
    wide: float
    dpi: float


STYLES = {
    "paper": Style(half=(3.4, 3.3), full=(7.16, 6.4), columns=2, wide=4 / 3, dpi=200),
    # Half the size of a slide of 13.33 by 7.5 in, which doubles letters of 8 pt and lines; 1920 dots wide.
    "slides": Style(half=(3.3, 3.3), full=(6.667, 3.75), columns=3, wide=1.9, dpi=288),
}


def style_named(name: str) -> Style:
    """The format called `name`, "paper" or "slides". Raises InputError for another."""
    return STYLES[errors.one_of("--style", name, STYLES)]
