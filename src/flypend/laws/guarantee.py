"""What a theorem says of one start: whether it covers it, and the bounds that follow from V ≤ V(0)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from flypend.geometry import Scalar
from flypend.laws.step import Step
from flypend.model import Vehicle


@dataclass(frozen=True, kw_only=True)
class Guarantee:
    """What the theorem of a law says of one start. Every bound holds for all times and is conservative.

    Parameters
    ----------
    covered : bool
        Whether the start lies in the domain of the theorem.
    reason : str
        Why not, in one line; empty for a covered start.
    exceptions : str
        Which starts with this V(0) are covered and yet may not converge; empty if all do.
    V : float
        V(0), in the unit of the law's V; inf outside the domain.
    thrust : (float, float)
        Bounds on |f|, N.
    rod_rate : float
        Bound on |ẏ|, 1/s.
    speed : float
        Bound on |ẋ|, m/s, relative to the reference; inf if position is not controlled.
    excursion : float
        Bound on |x − x_ref|, m; inf if position is not controlled.
    assumes : tuple of str
        What the theorem assumes and the start does not show.
    """

    covered: bool
    V: float
    reason: str = ""
    exceptions: str = ""
    thrust: tuple[float, float] = (0.0, math.inf)
    rod_rate: float = math.inf
    speed: float = math.inf
    excursion: float = math.inf
    assumes: tuple[str, ...] = ()


def list_unmodelled(vehicle: Vehicle, *, on_hub: bool = False) -> str:
    """Return what `vehicle` has that the theorems' equations lack, in words; empty for a vehicle that they model.

    They know a free ball joint at the centre of mass, a rod that touches nothing and does not spin, and no air. With
    `on_hub` a hub is allowed, for whoever proves that the rod touches nothing.
    """
    has = {
        f"a {vehicle.mount}, which the rod must not touch": vehicle.mount not in ("gimbal", "hub" if on_hub else ""),
        "a pivot off the centre of mass": bool(np.any(vehicle.pivot_offset)),
        "friction in the joint": bool(vehicle.pivot_damping or vehicle.pivot_friction),
        "a rod that spins": bool(vehicle.rod_spin and vehicle.rod_spin_inertia),
    }
    return ", ".join(words for words, present in has.items() if present)


IDEAL = (
    "the wrench acts as commanded, without limits, lag or delay",
    "mass, inertia and rod length are as told",
    "no forces of the air",
)

LAGGED = (
    "every rotor lags by the vehicle's rotor_lag, and gives its minimum at the start; its force is known",
    "commands and forces have no limits, of either sign, and no delay",
    *IDEAL[1:],
)


def least_distance(V: float, step: Step) -> float:
    """Return 1 + c at which k Ψ(c) = `V`, by bisection in its logarithm: 1 + c is never less while V falls.

    0 where it is smaller than every double.
    """
    k, spread = step.weight * step.stiffness, 1 - step.barrier
    low, high = -V / (2 * k * step.barrier) - 1.0, math.log(2.0)
    for _ in range(200):
        middle = (low + high) / 2
        value = k * (spread * (2 - math.exp(middle)) - 2 * step.barrier * (middle - math.log(2.0)))
        low, high = (middle, high) if value > V else (low, middle)
    return math.exp(low)


def least_share(distance: float, step: Step) -> float:
    """Return ς at 1 + c = `distance`, without cancellation near the antipode."""
    return float((1 - step.fade) * distance + (2 * step.fade - 1))


def rate_bound(V: float, turn: float, force: float, gradient: float, step: Step) -> float:
    """Return a bound on |φ̇| while V ≤ `V`: |φ̇| ≤ |ω_d| + |v_*| + |ζ|.

    `turn`, `force` and `gradient` bound |ω_d| (1/s), N and |G|. |v_*| ≤ k_e + κ N |G|/k with κ = 1/(2√(ε(1−ε))) for
    ε ≤ ½, else 1.
    """
    k, eps = step.weight * step.stiffness, step.barrier
    kappa = 1 / (2 * math.sqrt(eps * (1 - eps))) if eps <= 0.5 else 1.0
    return float(turn + step.alignment + kappa * force * gradient / k + math.sqrt(2 * V / step.weight))


def saturate(k: Scalar, reach: Scalar, size: float) -> float:
    """Return k r/√(1 + r²/L²) at r = `size`, for the stiffness `k` and the reach L."""
    return float(k * size / math.sqrt(1 + (size / reach) ** 2))
