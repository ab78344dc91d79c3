"""`Constraints`: what a flight keeps, for `plan`, `plan_ensemble`, `plan_and_track` and `nmpc` alike."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend import errors
from flypend.errors import InputError
from flypend.laws.references import Reference, check_reference
from flypend.planning.window import Window

Array = NDArray[np.float64]


class Keywords(TypedDict, total=False):
    """The fields of `Constraints`, given one by one."""

    box: ArrayLike | None
    floor: float | None
    ceiling: float | None
    speed: float | None
    lean: float | None
    window: Window | Sequence[Window] | None
    waypoints: ArrayLike | None
    path: Reference | None
    clearance: float


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Constraints:
    """What a flight keeps, beside the limits of its rotors; SI units, world frame with e₃ up.

    Parameters
    ----------
    box : (2, 3), optional
        Lowest and highest corner of a box that pivot and rod stay in, m; infinite entries for no wall.
    floor, ceiling : float, optional
        Lowest and highest height of pivot and rod, m.
    speed : float, optional
        Largest speed of the pivot, m/s.
    lean : float, optional
        Largest angle between the rod and the vertical, rad: π/2 keeps it above the horizon.
    window : Window or several, optional
        Openings in walls between start and target, to fly through: rod and machine keep clear of the frame.
    waypoints : (k, 3), optional
        Points that the pivot passes, one after the other on the way from start to target, within a twentieth of the
        rod's length, m.
    path : callable, optional
        Where the pivot is to be, m, as a function of time, with CasADi's functions (see `laws.references`): circles,
        figures of eight. The excursion is measured from it. It takes the `duration` of the plan, and ends in hover.
    clearance : float
        Distance that the rod of a hub or cup keeps from what it can touch, and the machine from a window's frame, m.

    Raises
    ------
    InputError
        If a field is out of range, or the lowest corner not below the highest.
    """

    box: ArrayLike | None = None
    floor: float | None = None
    ceiling: float | None = None
    speed: float | None = None
    lean: float | None = None
    window: Window | Sequence[Window] | None = None
    waypoints: ArrayLike | None = None
    path: Reference | None = None
    clearance: float = 0.01

    def __post_init__(self) -> None:
        errors.number("clearance", self.clearance, at_least=0, unit="m")
        for name in ("floor", "ceiling"):
            if getattr(self, name) is not None:
                errors.number(name, getattr(self, name), unit="m")
        if self.speed is not None:
            errors.number("speed", self.speed, above=0, unit="m/s")
        if self.lean is not None and errors.number("lean", self.lean, above=0, unit="rad") > np.pi:
            raise InputError("lean", f"at most {angle(np.pi)}", angle(self.lean))
        check_reference(self.path, "path")
        _ = self.windows, self.points, self.walls  # each raises if it is wrong

    @property
    def given(self) -> dict[str, Any]:
        """The fields that differ from their defaults, by name."""
        values = {field.name: (getattr(self, field.name), field.default) for field in fields(self)}
        return {name: value for name, (value, default) in values.items() if value is not default}

    @property
    def walls(self) -> Array | None:
        """Lowest and highest corner (2, 3), m, of the box with floor and ceiling; None without a wall."""
        walls = np.array([[-np.inf] * 3, [np.inf] * 3])
        if self.box is not None:
            try:
                walls = np.array(self.box, dtype=float)
            except (TypeError, ValueError):
                walls = np.array(np.nan)
            if walls.shape != (2, 3) or np.any(np.isnan(walls)):
                raise InputError("box", "numbers of shape (2, 3)", repr(self.box)[:80])
            if np.any(walls[0] >= walls[1]):
                raise InputError("box", "a lowest corner below the highest", walls.tolist())
        if self.floor is not None and self.ceiling is not None and self.floor >= self.ceiling:
            raise InputError("floor", f"a height below the ceiling, {self.ceiling:g} m", f"{self.floor:g}")
        walls[0, 2] = max(walls[0, 2], -np.inf if self.floor is None else self.floor)
        walls[1, 2] = min(walls[1, 2], np.inf if self.ceiling is None else self.ceiling)
        if walls[0, 2] >= walls[1, 2]:
            raise InputError("floor, ceiling", "a lowest corner below the highest", walls.tolist())
        return None if np.all(np.isinf(walls)) else walls

    @property
    def windows(self) -> tuple[Window, ...]:
        """The windows, none or several."""
        several = () if self.window is None else (self.window,) if isinstance(self.window, Window) else self.window
        if not isinstance(several, list | tuple) or not all(isinstance(each, Window) for each in several):
            raise InputError("window", "a Window, or several", repr(self.window)[:80])
        return tuple(several)

    @property
    def points(self) -> Array:
        """The waypoints (k, 3), m, none or several."""
        return np.zeros((0, 3)) if self.waypoints is None else errors.array("waypoints", self.waypoints, (None, 3))


def gathered(function: str, constraints: Constraints | None, keywords: Mapping[str, Any]) -> Constraints:
    """Return the `constraints` of a call of `function` with the fields that were given one by one, `keywords`.

    Raises InputError if a field is unknown or given in both ways.
    """
    errors.only_known(function, keywords, [field.name for field in fields(Constraints)])
    for name in keywords:
        if constraints is not None and name in constraints.given:
            raise InputError(name, "one value, by itself or in constraints", "two")
    return replace(constraints or Constraints(), **keywords)


def angle(radians: float) -> str:
    """Return an angle in both units: the command takes degrees."""
    return f"{radians:.3g} rad ({np.degrees(radians):.4g}°)"
