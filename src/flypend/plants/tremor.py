"""How much a vehicle trembles in hover, by linear theory: what the noise of its sensors does through estimator and law.

In the coordinates ξ of `laws.linearise` without the heading, about inverted hover, ξ̇ = A ξ + B w with the wrench w of
rotors of lag T, ẇ = (c − w)/T. Each control period h the computer commands c = w + lead (−K ξ̂ − w) for the ξ̂ that it
predicts. The readings are H ξ(t − latency) = H e^{−A latency} ξ(t), with white noise of variance R/h a period, and the
estimator is a Kalman filter with the densities Q that the one on board believes. The world is as its model has it: of Q
only the noise of an accelerometer acts. With the error e = ξ − ξ̂ after a correction, Φ = e^{A h},

    e⁺ = (1 − L H)(Φ e + noise of the accelerometer) − L (noise of the readings).

A command acts a delay d after its readings. Predicted from there, ξ̂ is off by e^{A d} e; so the loop is that of no
delay, driven by e^{A d} e. Over what the lead leaves of the lag, the computer predicts as well, under its last
command. (ξ, w, c, e) is a linear system in steps of h, whose covariance solves a Lyapunov equation. Flights tremble
some 5 % more with motion capture, and up to a fifth more on board: forces and biases are estimated besides.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

from flypend.building import builds
from flypend.geometry import E3, Numbers
from flypend.laws import BoundLaw
from flypend.laws.bound import Computer
from flypend.laws.linearise import COORDINATES, SYMMETRIES, linearise, open_loop
from flypend.laws.references import hover
from flypend.laws.throw import bob_path
from flypend.model import State, Vehicle, Wrench
from flypend.plants.lag import largest_lead
from flypend.plants.plant import AnyPlant, Sampled
from flypend.plants.sensors import Sensors

KEPT = [i for i, name in enumerate(COORDINATES) if name not in SYMMETRIES]
PLACE = [KEPT.index(COORDINATES.index(f"x_{i}")) for i in (1, 2, 3)]
AXIS = [KEPT.index(COORDINATES.index(f"theta_{i}")) for i in (1, 2)]
# Largest tremor of the thrust axis, rad, RMS, with which flights stand, and that up to which a law is calmed. Errors of
# the axis about two directions exceed r at one instant with probability exp(−r²/σ²); a flight stands if none of some
# twenty independent instants of a second exceeds 0.05. With σ = 0.05/3 one flight in 400 does not, with 0.05/4 one in
# 400,000, so that a machine may tremble by a third more than believed.
MOST_TREMOR, CALM_TREMOR = 0.05 / 3, 0.05 / 4
SHARES = 8  # steps from the default gains to the calmest
# What a machine may have of the believed masses and rod, at least: where loops are fastest, rotors with a lag resonate.
LIGHT = {"mass": 0.8, "bob_mass": 0.8, "rod_length": 0.85}
# Densities are of order 1e-8 in SI units; in these the Riccati equation is well conditioned.
UNIT = 1e-6
ROUNDOFF = 1e-12
LEAST_NOISE = 1e-16  # density of readings, SI: 1e-7 at 100 Hz; below it the Riccati equation is ill conditioned
SHORTEST_LAG = 0.05  # of rotors without one, in control periods


class Tremor(NamedTuple):
    """Root mean squares in hover: distance of the pivot from its reference, m; tilt of the thrust axis, rad."""

    place: float
    axis: float


@builds
def calm(law: BoundLaw, plant: AnyPlant) -> BoundLaw:
    """Return `law` calmed near its reference until hover on the sensors of `plant` trembles little enough.

    So must hover of a vehicle lighter than believed, by `LIGHT`. The law is unchanged if it has no such gains, or
    `plant` no estimator.
    """
    if law.calmer is None:
        return law
    if not isinstance(plant, Sampled) or plant.sensors is None or plant.sensors.rates != "estimated":
        return law.calm_by(0.0)
    return _calm(law.calm_by(0.0), plant.sensors.told, 1 / plant.rate, plant.assumed_delay)


@lru_cache(maxsize=64)
def _calm(law: BoundLaw, sensors: Sensors, period: float, delay: float) -> BoundLaw:
    """Return `law` with the least share of calm with which it trembles by no more than `CALM_TREMOR`; else with all."""
    gains, prepared = tuple(law.gains.items()), repr(law.calm_by(1.0).prepared)
    steering = _Steering(law.control, law.vehicle, law.computer, gains, prepared, law)
    return law.calm_by(_share(steering, sensors, period, delay))


@dataclass(frozen=True)
class _Steering:
    """What the tremor of a `law` depends on: laws built anew, as for each flight of a page, share an answer."""

    control: Callable[..., Any]
    vehicle: Vehicle
    computer: Computer
    gains: tuple[tuple[str, Any], ...]
    prepared: str  # for the calmest, whose ratios name the gains that were not given
    law: BoundLaw = field(compare=False)


@lru_cache(maxsize=64)
def _share(steering: _Steering, sensors: Sensors, period: float, delay: float) -> float:
    """Return the least share of calm with which `steering` trembles by less than `CALM_TREMOR`."""
    law = steering.law
    vehicle = law.vehicle
    light = vehicle.replace(**{name: share * getattr(vehicle, name) for name, share in LIGHT.items()})

    def trembles(step: int) -> bool:
        calmed = law.calm_by(step / SHARES)
        return any(tremor(calmed, sensors, period, delay, flown).axis > CALM_TREMOR for flown in (vehicle, light))

    if not trembles(0):
        return 0.0
    low, high = 0, SHARES
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if trembles(middle) else (low, middle)
    return high / SHARES


def too_noisy(law: BoundLaw, plant: AnyPlant) -> str:
    """Return in a line that hover on the sensors of `plant` trembles too much even with calm gains, else nothing.

    It names the stream of readings whose halved noise, of which the estimator is told, would help most.
    """
    if law.e3 != "up" or not isinstance(plant, Sampled) or plant.sensors is None or plant.sensors.rates != "estimated":
        return ""
    sensors, calmed = plant.sensors, calm(law, plant)

    def trembles(sensors: Sensors) -> float:
        return tremor(calmed, sensors, 1 / plant.rate, plant.assumed_delay).axis

    now = trembles(sensors)
    if not MOST_TREMOR < now < np.inf:
        return ""
    halved = {
        name: trembles(sensors.replace(**{name: replace(stream, noise=stream.noise / 2)}))
        for name, stream in sensors.streams.items()
    }
    worst = min(halved, key=halved.__getitem__)
    return (
        f"hover: on these sensors the thrust axis trembles by {1e3 * now:.1f} mrad, more than the "
        f"{1e3 * MOST_TREMOR:.1f} with which flights stand; half the noise of the {worst} readings would leave "
        f"{1e3 * halved[worst]:.1f}"
    )


def tremor(law: BoundLaw, sensors: Sensors, period: float, delay: float = 0.0, flown: Vehicle | None = None) -> Tremor:
    """Return how much the vehicle `flown`, by default that of `law`, trembles in hover on `sensors`.

    `period` is that of control and `delay` that from measurement to command, both in s. Infinite, if the linearised
    loop is not stable.
    """
    with threadpool_limits(1):  # matrices of some 40 rows: threads would only wait for each other
        return _tremor(law, sensors, period, delay, flown or law.vehicle)


def _tremor(law: BoundLaw, sensors: Sensors, period: float, delay: float, flown: Vehicle) -> Tremor:
    """Return the standard deviations of place and thrust axis in hover, by a Lyapunov equation."""
    n = len(KEPT)
    loop, driven = _loop(law, flown, period, delay)
    if np.max(np.abs(np.linalg.eigvals(loop))) >= 1:
        return Tremor(np.inf, np.inf)
    filtered, noise = _filter_errors(_motion(law.vehicle)[0], sensors, law.vehicle, period)
    whole = np.block([[loop, driven], [np.zeros((n, len(loop))), filtered]])
    drive = np.zeros_like(whole)
    drive[-n:, -n:] = noise
    variances = np.diag(_covariance(whole, drive))
    return Tremor(*(float(np.sqrt(np.sum(variances[part]))) for part in (PLACE, AXIS)))


def estimate_errors(vehicle: Vehicle, sensors: Sensors, period: float, times: int) -> tuple[Numbers, Numbers]:
    """Return (F, Q) of the estimator's error e in hover over `times` control periods: e⁺ = F e + noise of covariance Q.

    Coordinates are those of `laws.linearise` without the heading, (15,), SI units; `period` is that of control, s.
    """
    with threadpool_limits(1):
        F, Q = _filter_errors(_motion(vehicle)[0], sensors.told, vehicle, period)
        over, added = np.eye(len(F)), np.zeros_like(Q)
        for _ in range(times):
            over, added = F @ over, F @ added @ F.T + Q
    return over, added


@lru_cache(maxsize=16)
def _motion(vehicle: Vehicle) -> tuple[Numbers, Numbers]:
    """Return A and B of `vehicle` in hover."""
    A, B = open_loop(vehicle, "up", State(y=E3), Wrench(vehicle.weight, np.zeros(3)))
    return A[np.ix_(KEPT, KEPT)], B[KEPT]


def _loop(law: BoundLaw, flown: Vehicle, period: float, delay: float) -> tuple[Numbers, Numbers]:
    """Return the matrix of a step of (ξ, w, c), c the last command, and how e drives it.

    The computer predicts with the vehicle of `law`.
    """
    vehicle, computer, one = law.vehicle, law.computer, np.eye(4)
    (A, B), K = _motion(vehicle), _feedback(law)
    n = len(A)
    lag = max(vehicle.rotor_lag, SHORTEST_LAG * period)
    lead = min(computer.lead, largest_lead(lag, period))
    finds = computer.delay_reach > 0
    predicted = delay if finds else computer.latency
    left = lag / lead if finds and vehicle.rotor_lag and not computer.models_lag else 0.0

    def lag_matrices(A: Numbers, B: Numbers, duration: float) -> Numbers:
        rates = np.zeros((n + 8, n + 8))
        rates[:n, : n + 4] = np.hstack([A, B])
        rates[n : n + 4, n:] = np.hstack([-one, one]) / lag
        return exponential(rates * duration)[: n + 4]

    ahead, step = lag_matrices(A, B, left + predicted - delay)[:n], lag_matrices(*_motion(flown), period)
    command = -lead * K @ ahead
    command[:, n : n + 4] += (1 - lead) * one
    loop = np.zeros((n + 8, n + 8))
    loop[: n + 4, : n + 4] = step[:, : n + 4]
    loop[: n + 4] += step[:, n + 4 :] @ command
    loop[n + 4 :] = command
    misled = lead * K @ ahead[:, :n] @ exponential(A * predicted)
    return loop, np.concatenate([step[:, n + 4 :] @ misled, misled])


@lru_cache(maxsize=16)
def _feedback(law: BoundLaw) -> Numbers:
    """Return K of the command −K ξ̂ of `law` in hover."""
    A, B = _motion(law.vehicle)
    held = law if law.along is None else law.along(bob_path(hover()))
    K: Numbers = np.linalg.pinv(B) @ (A - linearise(held, law.vehicle, State(y=E3)).A[np.ix_(KEPT, KEPT)])
    return K


def _filter_errors(A: Numbers, sensors: Sensors, vehicle: Vehicle, period: float) -> tuple[Numbers, Numbers]:
    """Return the matrix of a step of the estimator's error e, and the covariance of what is added to it."""
    H, R = _readings(A, sensors, period)
    felt, nominal = _driven(sensors, vehicle, period)
    moved, variances = exponential(A * period), R / period
    P = _riccati(moved, H, variances / UNIT, nominal * period / UNIT) * UNIT
    L = np.linalg.solve(H @ P @ H.T + np.diag(variances), H @ P).T
    kept = np.eye(len(A)) - L @ H
    return kept @ moved, kept @ felt @ kept.T * period + L * variances @ L.T


def exponential(A: Numbers) -> Numbers:
    """Return e^A (n, n), by the Taylor series of A/2ᵏ with a norm below 1/8, squared k times."""
    halvings = max(0, 3 + int(np.ceil(np.log2(max(float(np.linalg.norm(A, 1)), 1e-9)))))
    part = A / 2.0**halvings
    found = term = np.eye(len(A))
    for k in range(1, 11):
        term = term @ part / k
        found = found + term
    for _ in range(halvings):
        found = found @ found
    return found


def _covariance(A: Numbers, Q: Numbers) -> Numbers:
    """Return X = A X Aᵀ + Q by doubling, for a stable A."""
    X = Q
    while np.max(np.abs(A)) > ROUNDOFF:
        X, A = X + A @ X @ A.T, A @ A
    return X


def _riccati(F: Numbers, H: Numbers, R: Numbers, Q: Numbers) -> Numbers:
    """Return the P before a correction of F, H, R (k,), Q: P = F (P⁻¹ + Hᵀ R⁻¹ H)⁻¹ Fᵀ + Q.

    By the structure-preserving doubling algorithm (Chu, Fan, Lin and Wang 2004): an iteration makes up for two.
    """
    A, G, P, change = F.T, H.T / R @ H, Q, Q
    while np.max(np.abs(change)) > ROUNDOFF * np.max(np.abs(P)):
        W = np.linalg.inv(np.eye(len(F)) + G @ P)
        change = A.T @ P @ W @ A
        A, G, P = A @ W @ A, G + A @ W @ G @ A.T, P + change
    return (P + P.T) / 2


def _readings(A: Numbers, sensors: Sensors, period: float) -> tuple[Numbers, Numbers]:
    """Return H (k, n) of what is read now of an earlier ξ, and the densities R (k,) of the noise of `sensors`."""
    every = np.eye(len(COORDINATES))
    joints = every[12:14].copy()  # the rod as seen from a vehicle that turns by θ: y + y × θ
    joints[0, 7], joints[1, 6] = -1.0, 1.0
    seen = {
        "position": every[0:3], "attitude": every[6:8], "gyro": every[9:12], "rod": every[12:14], "joints": joints,
        "rod_gyro": every[14:16],
    }  # fmt: skip
    streams = {name: stream for name, stream in sensors.streams.items() if name in seen}
    rows = [seen[name][:, KEPT] @ exponential(-A * stream.latency) for name, stream in streams.items()]
    return np.concatenate(rows), np.concatenate(
        [np.full(len(seen[name]), max(stream.density(period), LEAST_NOISE)) for name, stream in streams.items()]
    )


def _driven(sensors: Sensors, vehicle: Vehicle, period: float) -> tuple[Numbers, Numbers]:
    """Return the densities (n, n) that the accelerometer's noise adds to the estimate, and those that it believes."""
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    on_vehicle, on_bob = np.zeros((len(COORDINATES), 3)), np.zeros((len(COORDINATES), 3))
    on_vehicle[3:6] = np.diag([1, 1, M / (M + m)])  # across the rod, the vehicle alone takes the force on it
    on_bob[5, 2] = m / (M + m)
    on_vehicle[14:16, :2], on_bob[14:16, :2] = -np.eye(2) / l, np.eye(2) / l
    turning = np.zeros((len(COORDINATES), 3))
    turning[9:12] = np.eye(3)
    v, b, w = (G[KEPT] @ G[KEPT].T for G in (on_vehicle, on_bob, turning))
    of_vehicle, of_bob = sensors.process_noise(period, 0.0)
    return sensors.accelerometer_density(period) * v, of_vehicle * v + of_bob * b + sensors.moment_error**2 * w
