"""Reference trajectories of the pivot as symbolic functions of time; their derivatives are exact."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np

from flypend import errors
from flypend.building import builds, no_numbers
from flypend.errors import InputError
from flypend.geometry import Numbers, Scalar, Vector

Reference = Callable[[Scalar], Vector]
# A path of the whole system: (t, vehicle, external force on the bob) → positions of pivot and bob, and rod direction,
# each (3, 1) and a function of time.
Path = Callable[[Scalar, Any, Vector], tuple[Vector, Vector, Vector]]


def hover(x: Any = (0.0, 0.0, 0.0)) -> Reference:
    """Stay at the position `x` (3,), m. Raises InputError unless `x` is three finite numbers."""
    position = errors.array("reference.x", x, (3,))
    return lambda t: ca.SX(ca.DM(position)) + 0 * t


def line(start: Any = (0.0, 0.0, 0.0), velocity: Any = (1.0, 0.0, 0.0)) -> Reference:
    """Move from `start` (3,), m, at constant `velocity` (3,), m/s. Raises InputError unless all are finite."""
    origin, rate = errors.array("reference.start", start, (3,)), errors.array("reference.velocity", velocity, (3,))
    return lambda t: ca.DM(origin) + ca.DM(rate) * t


def circle(radius: float = 0.5, rate: float = 1.0, center: Any = (0.0, 0.0, 0.0)) -> Reference:
    """Follow a horizontal circle of `radius` (m) about `center` (3,), m, at angular `rate` (rad/s).

    Raises InputError unless the radius is positive and all numbers are finite.
    """
    r, w = errors.number("reference.radius", radius, above=0, unit="m"), errors.number("reference.rate", rate)
    middle = errors.array("reference.center", center, (3,))
    return lambda t: ca.DM(middle) + r * ca.vertcat(ca.cos(w * t), ca.sin(w * t), 0)


def lemniscate(size: float = 1.0, rate: float = 1.0, center: Any = (0.0, 0.0, 0.0)) -> Reference:
    """Follow a horizontal figure eight (Gerono) of half-length `size` (m) about `center` (3,), m, at `rate` (rad/s).

    Raises InputError unless the size is positive and all numbers are finite.
    """
    a, w = errors.number("reference.size", size, above=0, unit="m"), errors.number("reference.rate", rate)
    middle = errors.array("reference.center", center, (3,))
    return lambda t: ca.DM(middle) + a * ca.vertcat(ca.sin(w * t), ca.sin(w * t) * ca.cos(w * t), 0)


def check_reference(reference: Any, field: str = "reference") -> None:
    """Raise InputError in `field` unless `reference` is None or a function of time that gives a position (3, 1)."""
    if reference is not None:
        _try_reference(reference, field)


@builds
def _try_reference(reference: Any, field: str) -> None:
    what = "a function of time that gives a position (3, 1) of CasADi, such as laws.references.hover((0, 0, 1))"
    if not callable(reference):
        raise InputError(field, what, repr(reference)[:80])
    try:
        with no_numbers():
            answer = reference(ca.SX.sym("t"))
    except Exception as error:
        raise InputError(field, what, f"one that fails: {type(error).__name__}: {error}"[:160]) from error
    if not isinstance(answer, ca.SX | ca.DM) or answer.shape != (3, 1):
        shape = f"shape {answer.shape}" if hasattr(answer, "shape") else f"a {type(answer).__name__}"
        raise InputError(field, f"{what}, or casadi.vertcat(x, y, z)", f"one that gives {shape}")
    if not np.all(np.isfinite(sample(reference, [0.1, 1.0]))):  # math.sin of a symbol is NaN
        raise InputError(field, f"{what}, of CasADi's functions", "one that gives NaN")


@builds
def sample(reference: Reference, t: Numbers) -> Numbers:
    """Return the positions (n, 3), m, of `reference` at times `t` (n,), s."""
    time = ca.SX.sym("t")
    function = ca.Function("reference", [time], [ca.densify(reference(time))])
    return np.array(function(np.asarray(t, dtype=float)[None, :])).T.copy()
