"""Sorted numbers: times and control ticks."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray


def distinct(values: ArrayLike) -> NDArray[Any]:
    """Return `values` sorted, without duplicates. NumPy's own `unique` imports `numpy.ma`, a tenth of a cold start."""
    found = np.sort(values, axis=None)
    return found[np.append(True, found[1:] != found[:-1])] if len(found) else found


def merge(judge_at: ArrayLike, keep_at: ArrayLike | None, kind: type[Any]) -> tuple[Any, Any, NDArray[np.int64]]:
    """Merge the points, numbers of `kind`, at which the criterion is evaluated and those at which states are kept.

    Returns the points in increasing order, 1 or 0 for those that are judged, and the number of samples kept before each
    point, the total last.
    """
    judge, keep = (distinct(np.asarray(() if some is None else some, dtype=kind)) for some in (judge_at, keep_at))
    points = distinct(np.concatenate([judge, keep]))
    rows = np.append(np.searchsorted(keep, points), len(keep)).astype(np.int64)
    return points, np.diff(np.append(np.searchsorted(judge, points), len(judge))).astype(kind), rows
