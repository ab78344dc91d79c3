"""Text that changes between frames, drawn from cached glyph outlines."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, lru_cache
from typing import Any

import numpy as np
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.textpath import TextPath
from matplotlib.transforms import IdentityTransform


def words(ax: Any, fontsize: float, color: str, *, right: bool = False) -> Callable[[str, Any], Any]:
    """Create changeable text: returns `place(words, at)`, which sets its string and position in `ax` and returns it.

    The text starts at `at`, or ends there if `right`. It is drawn from cached glyph outlines: laying out a string
    again, as matplotlib's `Text` does, takes longer than the rest of a frame.
    """
    patch = ax.add_patch(PathPatch(Path([[0.0, 0.0]]), facecolor=color, edgecolor="none", animated=True))
    patch.set_transform(IdentityTransform())
    patch.set_clip_on(False)
    scale = fontsize * ax.figure.dpi / 72

    def place(words: str, at: Any) -> Any:
        vertices, codes, width = outline(words.replace("-", "−"))
        corner = ax.transData.transform(at) - (scale * width if right else 0.0, -0.2 * scale)
        patch.set_path(Path(scale * vertices + corner, codes))
        return patch

    return place


@lru_cache(maxsize=4096)
def outline(words: str) -> tuple[Any, Any, float]:
    """Vertices (n, 2), path codes (n,) and width of the string `words` at font size 1."""
    vertices, codes, x = [np.zeros((0, 2))], [np.zeros(0, dtype=Path.code_type)], 0.0
    for character in words:
        outline, advance = glyph(character)
        if outline is not None:
            vertices.append(np.add(outline.vertices, (x, 0.0)))
            codes.append(outline.codes)
        x += advance
    return np.concatenate(vertices), np.concatenate(codes), x


@cache
def glyph(character: str) -> tuple[Any, float]:
    """Outline of `character` at font size 1 (None for a space), and its advance width."""
    bar, pair = (TextPath((0, 0), words, size=1) for words in ("|", character + "|"))
    outline = None if character.isspace() else TextPath((0, 0), character, size=1)
    return outline, float(pair.vertices[:, 0].max() - bar.vertices[:, 0].max())
