"""What forces Theorem A withstands: bounds with explicit constants, by docs/laws/theorem-proof.md, section 6."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np

from flypend.errors import InputError
from flypend.laws.bound import BoundLaw
from flypend.laws.guarantee import least_distance, saturate
from flypend.laws.repaired import axis_step, stiffness

SHARES = np.geomspace(1e-5, 0.5, 400)  # of √k_p, tried as the weight of the cross term; the bound holds for each


@dataclass(frozen=True, kw_only=True)
class Withstood:
    """Bounds on a flight of Theorem A whose rod is accelerated by |w| ≤ `most` beside what the law knows.

    From every start with V(0) ≤ `start`, V ≤ `level` for all times t, and

        √V(t) ≤ overshoot e^(−rate t) √V(0) + gain sup |w|

    because V_μ = V − cross ẏ·e₃ falls at least at the rate fall V − push √V |w|.

    Parameters
    ----------
    level, start : float
        Values of V, 1/s².
    most : float
        Largest acceleration |w| of the rod's direction, 1/s².
    rate : float
        Decay of √V, 1/s.
    overshoot : float
        At least 1.
    gain : float
        √V per acceleration, s.
    cross, fall, push : float
        Constants of V_μ, all 1/s but `push`, which has no unit.
    """

    level: float
    start: float
    most: float
    rate: float
    overshoot: float
    gain: float
    cross: float
    fall: float
    push: float


def withstood(law: BoundLaw, level: float) -> Withstood:
    """Return what the bound repaired `law` withstands while V ≤ `level`, 1/s².

    Forces F_b on the bob and F_v on the vehicle accelerate the rod by w = P_y(F_b/m − F_v/M)/l. Raises InputError
    unless 0 < `level` < 2 k_p, the value of V at the saddle, or if the barrier is too thin there for double precision.
    """
    k_p = float(stiffness(law.vehicle))
    if not 0 < level < 2 * k_p:
        raise InputError("level", f"0 < V < 2 k_p = {2 * k_p:.4g} 1/s²", f"{level:g}")
    found = [one for share in SHARES if (one := _with_share(law, level, k_p, float(share))) is not None]
    if not found:
        raise InputError("level", "one that doubles can resolve: smaller, or with a larger axis_weight", f"{level:g}")
    return min(found, key=lambda one: one.gain)


def _with_share(law: BoundLaw, level: float, k_p: float, theta: float) -> Withstood | None:
    """Bounds from V_μ = V − μ ẏ·e₃ with μ = θ√k_p; None where V_μ does not fall."""
    k, mu = SimpleNamespace(**law.gains), theta * math.sqrt(k_p)
    step = axis_step(k)
    weight, eps = step.weight * step.stiffness, step.barrier
    r, delta = math.sqrt(2 * level), least_distance(level, step)
    if delta == 0.0:
        return None
    sigma = saturate(k.k_d, k.damping_share * k_p / k.k_d, r)
    spread, barrier = (1 - eps) * delta + 2 * eps, (1 - eps) + 2 * eps / delta  # g|e|² ≥ ½·spread·h²; g ≤ barrier
    form = np.array(
        [
            [mu * k_p, -mu * k.k_d / 2, -mu * (k_p + sigma) / 2],
            [-mu * k.k_d / 2, sigma / r - mu, 0.0],
            [-mu * (k_p + sigma) / 2, 0.0, weight * k.k_e * spread / 2],
        ]
    )  # of −Ẇ in (|P_y e₃|, |ẏ|, |z − z_d|)
    of_V = np.array([k_p / (2 - level / k_p), 0.5, weight * barrier / 2])  # V is at most this form, and ½ρ|ζ|²
    scaled = form / np.outer(np.sqrt(of_V), np.sqrt(of_V))
    fall = min(float(np.linalg.eigvalsh(scaled)[0]), 2 * k.k_2)
    if fall <= 0:
        return None
    push = _gradient(k, step, k_p, r, sigma, spread, barrier) + mu * math.sqrt(2 / k_p)
    ratio = (1 + theta) / (1 - theta)
    if push > fall * sys.float_info.max / ratio:
        return None
    return Withstood(
        level=level,
        start=level / ratio,
        most=fall * math.sqrt(level) / (ratio * push),
        rate=fall / (2 * (1 + theta)),
        overshoot=math.sqrt(ratio),
        gain=ratio * push / fall,
        cross=mu,
        fall=fall,
        push=push,
    )


def _gradient(k: Any, step: Any, k_p: float, r: float, sigma: float, spread: float, barrier: float) -> float:
    """A bound on |∂V/∂ẏ|/√V while |ẏ| ≤ `r`, |σ| ≤ `sigma`, term by term."""
    weight, least, most = step.weight * step.stiffness, k_p - sigma, k_p + sigma  # N from below and above
    turn = k.k_d / least  # of z_d, and of e and c
    swing = r**2 + most  # |ÿ|
    bend = 2 * k.k_d**2 / (k.damping_share * k_p)  # |σ″|
    demand_rate = bend * swing + k.k_d * (2 * r + k.k_d)  # ∂ḟ_p
    omega = demand_rate / least + 2 * turn * k.k_d * swing / least
    cancelling = (2 * k.k_d * r + most * (2 + 2 * r * turn)) / (weight * spread)
    cancelling += 2 * most * r * (1 - step.barrier) * turn / (weight * spread**2)
    jacobian = omega + k.k_e * turn + cancelling  # of ω_d × z + v_*
    return float(math.sqrt(2) + barrier * turn * math.sqrt(2 * weight) + math.sqrt(2 * step.weight) * jacobian)
