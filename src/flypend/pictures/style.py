"""Figure formats: for a two-column paper or for slides. Both share font sizes and line widths."""

from __future__ import annotations

import difflib
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from flypend import errors

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLUMN, PAGE = 3.5, 7.16  # widths of one and of two columns in IEEE journals, in
SERIF = ("serif", "times", "roman", "georgia", "garamond", "libertine", "termes", "stix")


@dataclass(frozen=True)
class Style:
    """A figure format; lengths in inches.

    Parameters
    ----------
    half, full : (2,)
        Width and height of a small and of a large figure.
    panels : tuple of str
        What a large figure of a run shows, row by row; see `flypend.pictures.figures`.
    columns : int
        Number of panel columns of a large figure.
    wide : float
        Columns over rows of the grid of stop-motion pictures.
    dpi : float
        Resolution of a .png, dots per inch.
    fixed : bool
        Whether every large figure has the full height, as slides have.
    font : str
        Font family; "" for the default.
    titled : bool
        Whether figures have a title. A figure with a caption needs none.
    """

    half: tuple[float, float]
    full: tuple[float, float]
    panels: tuple[str, ...]
    columns: int
    wide: float
    dpi: float
    fixed: bool = False
    font: str = ""
    titled: bool = True


STYLES = {
    "paper": Style(
        half=(COLUMN, 3.3), full=(PAGE, 8.2), columns=2, wide=4 / 3, dpi=200,
        panels=("y", "z", "x", "distance", "thrust", "rotors", "moment", "signal"),
    ),
    # Half the size of a 13.33 × 7.5 in slide, so 8 pt text and lines double in size; 1920 pixels wide.
    "slides": Style(
        half=(3.3, 3.3), full=(6.667, 3.75), columns=3, wide=1.9, dpi=288, fixed=True,
        panels=("y", "z", "x", "thrust", "rotors", "signal"),
    ),
}  # fmt: skip


def style_named(name: str, *, font: str = "", titled: bool = True) -> Style:
    """Return the format called `name`, "paper" or "slides", with a font family and with or without titles.

    Raises InputError for any other name, and for a font that is not installed.
    """
    chosen = STYLES[errors.one_of("--style", name, STYLES)]
    return replace(chosen, font=_find_font(font), titled=titled)


def style_of(style: str | Style) -> Style:
    """Return `style`, or the format of that name."""
    return style if isinstance(style, Style) else style_named(style)


def letter(figure: Figure, style: Style) -> Figure:
    """Set all text of `figure`, formulas included, in the font of `style`, and return the figure."""
    from matplotlib.text import Text  # imported here: a command that draws nothing checks a style, too

    if style.font:
        serif = any(word in style.font.lower() for word in SERIF) and "sans" not in style.font.lower()
        for axes in figure.axes:
            axes.tick_params(which="both", labelfontfamily=style.font)
        for text in figure.findobj(Text):
            assert isinstance(text, Text)
            text.set_fontfamily(style.font)
            text.set_math_fontfamily("stix" if serif else "stixsans")
    return figure


def _find_font(font: str) -> str:
    """Return `font` if it is "" or a family that matplotlib finds. Raises InputError."""
    if not font:
        return font
    from matplotlib.font_manager import FontProperties, findfont, get_font_names

    try:
        findfont(FontProperties(family=font), fallback_to_default=False)
    except ValueError:
        near = difflib.get_close_matches(font, [*get_font_names(), "serif", "sans-serif"], n=1, cutoff=0.4)
        hint = f" (did you mean {near[0]!r}?)" if near else ""
        raise errors.InputError("--font", "a font family that is installed", f"{font!r}{hint}") from None
    return font
