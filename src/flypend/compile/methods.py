"""Tableaus of embedded Runge-Kutta methods, with their error estimates and dense output."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

import numpy as np

from flypend.errors import one_of

NAMES = ("dop853", "dp5")


@dataclass(frozen=True)
class Method:
    """An explicit embedded Runge-Kutta method with s stages.

    Parameters
    ----------
    name : str
        "dop853" or "dp5".
    A, B, C : (s, s), (s,), (s,)
        The Butcher tableau.
    errors : tuple of (s+1,)
        Weights of one error estimate, or of two (orders 5 and 3) that Hairer's formula for DOP853 combines; entry s
        is the weight of f at the end of the step.
    A_extra, C_extra : (e, s+1+e), (e,)
        Additional stages for the dense output.
    dense : array
        For "dp5", the polynomial coefficients (s+1, 4) of the dense output; for "dop853", the stage weights
        (4, s+1+e) of its higher-order terms.
    """

    name: str
    A: Any
    B: Any
    C: Any
    errors: tuple[Any, ...]
    A_extra: Any
    C_extra: Any
    dense: Any

    @property
    def stages(self) -> int:
        """Number of stages s of a step, without those of the dense output."""
        return len(self.B)


@cache
def method(name: str) -> Method:
    """The method called `name`: "dop853" (Prince and Dormand's 8(5,3)) or "dp5" (Dormand and Prince's 5(4)).

    Raises InputError for any other name.
    """
    one_of("method", name, NAMES)
    text = resources.files("flypend.compile").joinpath("tableaus.toml").read_text(encoding="utf-8")
    t = {key: np.array(value, dtype=float) for key, value in tomllib.loads(text)[name].items()}
    if name == "dp5":
        none = np.zeros((0, len(t["E"])))
        return Method("dp5", t["A"], t["B"], t["C"], (t["E"],), none, np.zeros(0), t["P"])
    return Method("dop853", t["A"], t["B"], t["C"], (t["E5"], t["E3"]), t["A_extra"], t["C_extra"], t["D"])
