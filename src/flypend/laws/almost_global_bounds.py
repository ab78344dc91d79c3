"""What Theorem B guarantees of a start: bounds on all motion and on the thrust that follow from V ≤ V(0).

Each line is a triangle inequality; docs/laws/theorem-proof.md, section 5, derives them. They hold for a reference that
stands still, and they are conservative: the thrust flown is smaller by orders of magnitude.
"""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend.laws.almost_global_gains import axis_step, largest_descent, rod_step
from flypend.laws.bound import BoundLaw
from flypend.laws.closed_loop import outside, signals_at
from flypend.laws.guarantee import IDEAL, LAGGED, Guarantee, least_distance, least_share, rate_bound, saturate
from flypend.laws.step import Step
from flypend.model import State, Vehicle

MOVING = "the reference has ten bounded derivatives, and the bob's path p_ref obeys condition (C) after 60 s, too"
# Where condition (C) is tried on a moving reference: longer than its period, at samples closer than what it does.
WATCHED, APART = 60.0, 2e-3  # s


class Bob(NamedTuple):
    """Bounds on the outer loop: |e_p| (m), |v| (m/s), |A| (m/s²) from below and above, |Ȧ| (m/s³)."""

    error: float
    speed: float
    least: float
    most: float
    rate: float


class Slopes(NamedTuple):
    """Bounds on |∇σ_p| (1/s²), |∇σ_v| (1/s), |σ_p″| (1/m s²) and |σ_v″| (1/m) of the outer loop."""

    p: float
    v: float
    bend_p: float
    bend_v: float


def theorem_b(law: BoundLaw, start: State) -> Guarantee:
    """Return what Theorem B says of `start`."""
    return _bounds_from(law, start, IDEAL)


def theorem_d(law: BoundLaw, start: State) -> Guarantee:
    """Return what Theorem D says of `start`, V being V' with every rotor at its minimum.

    V ≤ V' ≤ V'(0) bounds the motion as in Theorem B; the thrust differs from that of B by √(2 V'(0)/γ_f) at most.
    """
    found = _bounds_from(law, start, LAGGED)
    apart = math.sqrt(2 * found.V / law.gains["thrust_weight"])
    low, high = found.thrust
    return replace(found, thrust=(max(0.0, low - apart), high + apart)) if found.covered else found


def _bounds_from(law: BoundLaw, start: State, assumes: tuple[str, ...]) -> Guarantee:
    """Return the bounds that follow from V ≤ V(0)."""
    found = signals_at(law, start)
    excluded = outside(law, found, {"rod_cosine": "y = -d", "axis_cosine": "z = -z_d"})
    if excluded is not None:
        return excluded
    if law.reference is None or not stands(law.reference):
        falls, allowed, when = steepest(law)
        if not falls < allowed:  # (C)
            reason = f"condition (C): the reference falls at {falls:.3g} m/s² at {when:.3g} s, and may at {allowed:.3g}"
            return Guarantee(covered=False, V=math.inf, reason=f"outside the theorem: {reason}")
        return Guarantee(covered=True, V=found["V"], assumes=(*assumes, MOVING))
    k, V, l = SimpleNamespace(**law.gains), found["V"], law.vehicle.l
    rod, bob = rod_step(k), bob_bounds(V, k, law.vehicle.g)
    turn = bob.rate / bob.least
    rod_rate = rate_bound(V, turn, bob.most, bob.speed, rod)
    return Guarantee(
        covered=True,
        V=V,
        thrust=thrust_bounds(V, k, law.vehicle, bob, rod_rate),
        rod_rate=rod_rate,
        speed=bob.speed + l * rod_rate,
        excursion=bob.error + 2 * l,
        assumes=assumes,
    )


def stands(reference: Any) -> bool:
    """Whether `reference` does not depend on time."""
    t = ca.SX.sym("t")
    return not ca.depends_on(ca.simplify(reference(t)), t)


def steepest(law: BoundLaw) -> tuple[float, float, float]:
    """Return the largest −p̈_ref·e₃ of the bob's path over a minute, what (C) allows, both m/s², and when it is, s."""
    assert law.path is not None
    t, vehicle = ca.SX.sym("t"), law.vehicle
    _, p_ref, _ = law.path(t, vehicle, ca.SX.zeros(3))
    rate = ca.jacobian(ca.densify(p_ref[2]), t)
    function = ca.Function("fall", [t], [-ca.densify(ca.jacobian(rate, t))])
    times = np.arange(0.0, WATCHED, APART)
    falls = np.array(function(times[None, :])).ravel()
    worst = int(np.argmax(np.where(np.isnan(falls), np.inf, falls)))
    return float(falls[worst]), vehicle.g - largest_descent(law.gains), float(times[worst])


def bob_bounds(V: float, k: SimpleNamespace, g: float) -> Bob:
    """Return the bounds on the outer loop while U + ½|v|² ≤ `V`, from the gains `k` and gravity `g`."""
    level = farthest(V, k.position_stiffness, k.position_reach)
    upright = farthest(V, k.height_stiffness, k.height_reach)
    v, s = math.sqrt(2 * V), abs(k.shear)
    pull = saturate(k.position_stiffness, k.position_reach, level)
    lift = saturate(k.height_stiffness, k.height_reach, upright)
    drag = saturate(k.position_damping, k.position_speed, v)
    brake = saturate(k.height_damping, k.height_speed, v) + 2 * k.fall_damping * v
    most = math.hypot(pull + drag, g + s * pull + lift + brake)
    slope, error = slopes(k), math.hypot(level + s * upright, upright)
    # The ideal bob has |v̇| ≤ g + |A|.
    return Bob(error, v, g - largest_descent(vars(k)), most, slope.p * v + slope.v * (g + most))


def slopes(k: SimpleNamespace) -> Slopes:
    """Return the bounds on the derivatives of (B1) and (B2): a saturation k r/√(1 + r²/L²) has |′| ≤ k, |″| ≤ 2 k/L."""
    s = 1 + abs(k.shear)
    return Slopes(
        p=max(k.position_stiffness, k.height_stiffness) * s**2,
        v=max(k.position_damping, k.height_damping + 2 * k.fall_damping),
        bend_p=2 * (k.position_stiffness / k.position_reach + k.height_stiffness / k.height_reach) * s**3,
        bend_v=2 * (k.position_damping / k.position_speed + k.height_damping / k.height_speed)
        + k.fall_damping / k.fall_speed,
    )


def farthest(V: float, k: float, reach: float) -> float:
    """Return the error at which k L² (√(1 + r²/L²) − 1) = `V`."""
    return reach * math.sqrt((1 + V / (k * reach**2)) ** 2 - 1)


def thrust_bounds(V: float, k: SimpleNamespace, vehicle: Vehicle, bob: Bob, rod_rate: float) -> tuple[float, float]:
    """Return bounds on f = |F| ς: F·y = (M+m) a_d + M l |ẏ|² from below, |F| from above, N."""
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    rod, axis = rod_step(k), axis_step(k)
    near, near_axis = least_distance(V, rod), least_distance(V, axis)
    if near == 0.0:  # no double is that small
        return 0.0, math.inf
    carried = (M + m) * bob.least * least_share(near, rod)
    g = (1 - rod.barrier) + 2 * rod.barrier / near
    push = rod.stiffness * g + rod.damping * math.sqrt(2 * V / rod.weight)  # |e| ≤ 1
    push += _feedforward(k, vehicle.g, bob, rod, rod_rate, near)
    most = math.hypot(M * l * push, (M + m) * bob.most + M * l * rod_rate**2)
    return carried * least_share(near_axis, axis), most


def _feedforward(k: SimpleNamespace, g: float, bob: Bob, rod: Step, rod_rate: float, near: float) -> float:
    """Return a bound on |d/dt(ω_d × y + v_*)| along the ideal bob, 1/s²; `near` is the least 1 + c_y."""
    turn, fall, v = bob.rate / bob.least, g + bob.most, bob.speed
    swing = rod_rate + turn  # |ċ| and ½|ė| stay below it
    # Ä = −σ_p″[v, v] − σ_p′ v̇ − σ_v″[v̇, v̇] − σ_v′ v̈.
    slope = slopes(k)
    jerk = bob.rate + bob.most * ((1 - rod.fade) * swing + rod_rate)
    bending = slope.bend_p * v**2 + slope.p * fall + slope.bend_v * fall**2 + slope.v * jerk
    turn_rate = bending / bob.least + 2 * turn * bob.rate / bob.least
    # v_* = k_e e + |A| h/(k W), |h| ≤ 2|v|, W = (1−ε)(1+c) + 2ε.
    W, weight = (1 - rod.barrier) * near + 2 * rod.barrier, rod.weight * rod.stiffness
    h_rate = 3 * (fall + rod_rate * v + v * swing)
    coupling = (bob.rate * 2 * v + bob.most * h_rate) / (weight * W)
    coupling += bob.most * 2 * v * (1 - rod.barrier) * swing / (weight * W**2)
    return float(turn_rate + turn * rod_rate + 2 * rod.alignment * swing + coupling)
