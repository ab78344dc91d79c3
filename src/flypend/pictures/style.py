"""Figure formats, for a two-column paper or for slides, and what all figures share: font sizes, axes, names, titles.

matplotlib is imported inside functions: a command that draws nothing checks a style, too.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from flypend import errors
from flypend.flight.trajectory import Trajectory
from flypend.laws.by_name import FACTORIES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLUMN, PAGE = 3.5, 7.16  # widths of one and of two columns in IEEE journals, in
LABEL, SMALL = 8.0, 7.0  # font sizes, pt
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
    from matplotlib.text import Text

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


# What all figures share ----------------------------------------------------------------------------------------------


def new_figure(width: float, height: float, dpi: float = 200) -> Figure:
    """Create an empty figure of `width` × `height` inches at `dpi` on an Agg canvas, independent of pyplot."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), dpi=dpi, layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def title(run: Trajectory, between: str = ", ") -> str:
    """The name of the law, those of its options that are not the usual ones, and its gains, joined by `between`."""
    usual = FACTORIES[run.law]().values if run.law in FACTORIES else {}
    chosen = {name: value for name, value in run.gains.items() if isinstance(value, str) and value != usual.get(name)}
    options = [f"{name} {value}" for name, value in chosen.items()]
    gains = [f"{symbol(name)} = {value:g}" for name, value in run.gains.items() if name.startswith("k_")]
    return between.join(filter(None, [", ".join([f"{run.law} law", *options]), ", ".join(gains)]))


def symbol(name: str) -> str:
    """How figures write the gain `name`: k_1 as a letter with its index, rod_damping in words."""
    return f"${name}$" if re.fullmatch(r"[a-zA-Z]_\w", name) else name.replace("_", " ")


def decimals(run: Trajectory) -> int:
    """Number of decimals that distinguish the snapshot times of `run`."""
    return int(np.clip(2 - np.floor(np.log10(run.t[-1])), 2, 6)) if run.t[-1] > 0 else 2


def rule(panels: Iterable[Any]) -> None:
    """Give each of the axes `panels` small numbers, labels of one size, and a light grid behind the data."""
    for axes in panels:
        axes.tick_params(which="both", labelsize=SMALL, width=0.6, length=2.5)
        axes.xaxis.label.set_size(LABEL)
        axes.yaxis.label.set_size(LABEL)
        axes.grid(visible=True, color="#e3e3e3", linewidth=0.5)
        axes.set_axisbelow(True)


def distribution(axes: Any, values: Any, total: int, **style: Any) -> None:
    """Draw the share of a `total` number of runs, in per cent, that has one of `values` up to each."""
    share = 100 * np.arange(1, len(values) + 1) / total
    axes.step(np.sort(values), share, where="post", **style)


def plain(axis: Any, *labelled: float) -> None:
    """Label the numbers `labelled` of each decade of a logarithmic `axis`, without exponents."""
    from matplotlib.ticker import LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=labelled))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())
