"""How much a vehicle trembles in hover, by linear theory: what the noise of its sensors does through estimator and law.

In the coordinates ξ of `laws.linearise` without the heading, about inverted hover, the vehicle moves by ξ̇ = A ξ + B u
under u = −K ξ̂. The readings are H ξ with white noise of density R, and the estimator is a Kalman filter,

    dξ̂/dt = (A − B K) ξ̂ + L (readings − H ξ̂),    L = P Hᵀ R⁻¹,    A P + P Aᵀ − P Hᵀ R⁻¹ H P + Q = 0,

with the densities Q that the estimator on board believes. The world is as its model has it: Q does not act, except the
noise of an accelerometer, which drives the estimate. With e = ξ − ξ̂ the pair (ξ, e) is a linear system driven by
white noise, whose covariance solves a Lyapunov equation. Left out are latency, sampling and rotors, with which the axis
trembles by a seventh more.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

from flypend.geometry import E3, Numbers
from flypend.laws import BoundLaw
from flypend.laws.linearise import COORDINATES, SYMMETRIES, linearise, open_loop
from flypend.laws.lqr import solve_riccati
from flypend.laws.references import hover
from flypend.laws.throw import carrying
from flypend.model import State, Vehicle, Wrench
from flypend.plants.plant import AnyPlant, Sampled
from flypend.plants.sensors import Sensors

KEPT = [i for i, name in enumerate(COORDINATES) if name not in SYMMETRIES]
PLACE = [KEPT.index(COORDINATES.index(f"x_{i}")) for i in (1, 2, 3)]
AXIS = [KEPT.index(COORDINATES.index(f"theta_{i}")) for i in (1, 2)]
# Largest tremor of the thrust axis, rad, RMS. Errors of the axis about two directions exceed r at one instant with
# probability exp(−r²/σ²); a flight stands if none of some twenty independent instants of a second exceeds 0.05. That
# takes σ = 0.05/3.3 of sound rotors and sensors, and a seventh less where they are weak, late and off.
MOST_TREMOR = 0.05 / 3.8
SHARES = 4  # steps from the default gains to the calmest
# Densities are of order 1e-8 in SI units; in these the Riccati equation is well conditioned.
UNIT = 1e-6


class Tremor(NamedTuple):
    """Root mean squares in hover: distance of the pivot from its reference, m; tilt of the thrust axis, rad."""

    place: float
    axis: float


def calm(law: BoundLaw, plant: AnyPlant) -> BoundLaw:
    """Return `law` with its default gains calmed until hover on the sensors of `plant` trembles little enough.

    The law is unchanged if it has no such gains, or `plant` no estimator.
    """
    if law.calmer is None:
        return law
    if not isinstance(plant, Sampled) or plant.sensors is None or plant.sensors.rates != "estimated":
        return law.calmed(0.0)
    return _calm(law.calmed(0.0), plant.sensors.told, 1 / plant.rate)


@lru_cache(maxsize=64)
def _calm(law: BoundLaw, sensors: Sensors, period: float) -> BoundLaw:
    """Return `law` with the least share of calm with which it trembles by no more than `MOST_TREMOR`; else with all."""

    def trembles(step: int) -> bool:
        return tremor(law.calmed(step / SHARES), sensors, period).axis > MOST_TREMOR

    if not trembles(0):
        return law
    low, high = 0, SHARES
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if trembles(middle) else (low, middle)
    return law.calmed(high / SHARES)


def too_noisy(law: BoundLaw, plant: AnyPlant) -> str:
    """Return in a line that hover on the sensors of `plant` trembles too much even with calm gains, else nothing.

    It names the stream of readings whose halved noise, of which the estimator is told, would help most.
    """
    if law.e3 != "up" or not isinstance(plant, Sampled) or plant.sensors is None or plant.sensors.rates != "estimated":
        return ""
    sensors, period, calmed = plant.sensors, 1 / plant.rate, calm(law, plant)
    assert isinstance(calmed, BoundLaw)
    now = tremor(calmed, sensors, period).axis
    if not MOST_TREMOR < now < np.inf:
        return ""
    halved = {
        name: tremor(calmed, sensors.replace(**{name: replace(stream, noise=stream.noise / 2)}), period).axis
        for name, stream in sensors.streams.items()
    }
    worst = min(halved, key=halved.__getitem__)
    return (
        f"hover: on these sensors the thrust axis trembles by {1e3 * now:.1f} mrad, more than the "
        f"{1e3 * MOST_TREMOR:.1f} with which flights stand; half the noise of the {worst} readings would leave "
        f"{1e3 * halved[worst]:.1f}"
    )


def tremor(law: BoundLaw, sensors: Sensors, period: float) -> Tremor:
    """Return how much the vehicle of `law` trembles in hover on `sensors`, at a control `period` in s.

    Infinite, if the linearised loop is not stable.
    """
    with threadpool_limits(1):  # matrices of 15 rows: threads would only wait for each other
        return _tremor(law, sensors, period)


def _tremor(law: BoundLaw, sensors: Sensors, period: float) -> Tremor:
    held = law if law.along is None else law.along(carrying(hover()))
    vehicle = law.vehicle
    closed = linearise(held, vehicle, State(y=E3)).A[np.ix_(KEPT, KEPT)]
    if np.max(np.linalg.eigvals(closed).real) >= 0:
        return Tremor(np.inf, np.inf)
    opened = open_loop(vehicle, "up", State(y=E3), Wrench(vehicle.weight, np.zeros(3)))[0][np.ix_(KEPT, KEPT)]
    H, R = _readings(sensors, period)
    felt, lacking = _driven(sensors, vehicle, period)
    scaled = (H / np.sqrt(R * UNIT)[:, None]) * UNIT
    P = solve_riccati(opened.T, scaled.T, (felt + lacking) / UNIT, np.eye(len(R))) * UNIT
    L = P @ H.T / R
    # ξ̇ = closed ξ + B K e and ė = (A − L H) e + noise: covariances of e, of ξ and e, and of ξ, one after the other.
    feedback, filtered = opened - closed, opened - L @ H
    wrong = _sylvester(filtered, filtered, L * R @ L.T + felt)
    together = _sylvester(closed, filtered, feedback @ wrong)
    crossed = feedback @ together.T
    variances = np.diag(_sylvester(closed, closed, crossed + crossed.T))
    return Tremor(*(float(np.sqrt(np.sum(variances[part]))) for part in (PLACE, AXIS)))


def _sylvester(A: Numbers, B: Numbers, C: Numbers) -> Numbers:
    """Return the X of A X + X Bᵀ + C = 0, all (n, n)."""
    one = np.eye(len(A))
    return -np.linalg.solve(np.kron(A, one) + np.kron(one, B), C.ravel()).reshape(C.shape)


def _readings(sensors: Sensors, period: float) -> tuple[Numbers, Numbers]:
    """Return H (k, n) and the densities R (k,) of the noise of the readings of `sensors`."""
    every = np.eye(len(COORDINATES))
    joints = every[12:14].copy()  # the rod as seen from a vehicle that turns by θ: y + y × θ
    joints[0, 7], joints[1, 6] = -1.0, 1.0
    seen = {
        "position": every[0:3], "attitude": every[6:8], "gyro": every[9:12], "rod": every[12:14], "joints": joints,
        "rod_gyro": every[14:16],
    }  # fmt: skip
    streams = {name: stream for name, stream in sensors.streams.items() if name in seen}
    rows = np.concatenate([seen[name][:, KEPT] for name in streams])
    return rows, np.concatenate([np.full(len(seen[n]), s.density(period)) for n, s in streams.items()])


def _driven(sensors: Sensors, vehicle: Vehicle, period: float) -> tuple[Numbers, Numbers]:
    """Return the densities (n, n) that the accelerometer's noise adds to the estimate, and those that it lacks."""
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    on_vehicle, on_bob = np.zeros((len(COORDINATES), 3)), np.zeros((len(COORDINATES), 3))
    on_vehicle[3:6] = np.diag([1, 1, M / (M + m)])  # across the rod, the vehicle alone takes the force on it
    on_bob[5, 2] = m / (M + m)
    on_vehicle[14:16, :2], on_bob[14:16, :2] = -np.eye(2) / l, np.eye(2) / l
    turning = np.zeros((len(COORDINATES), 3))
    turning[9:12] = np.eye(3)
    v, b, w = (G[KEPT] @ G[KEPT].T for G in (on_vehicle, on_bob, turning))
    return sensors.felt(period) * v, sensors.force_error**2 * (v + b) + sensors.moment_error**2 * w
