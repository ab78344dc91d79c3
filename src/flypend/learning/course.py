"""What the flights of a training have in common, which machines fly, and with what errors their states are seen.

Machines are as written, or drawn from bands. Wrong masses, rod, inertia, torque ratio, lag and rotors are flown as they
are. What the flight computer does about the world is not: its estimates are the true states with errors of the theory
of tremor; it has made up for all but a part of the delay, and for a wrong thrust scale as quickly as its observer
would.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend.identification.model import ERROR
from flypend.laws.learned import GAINS, LEAST_SHARE
from flypend.model import Vehicle
from flypend.planning.dynamics import Units
from flypend.plants.bands import draw_world
from flypend.plants.lag import step_timing
from flypend.plants.motors import sag_forces
from flypend.plants.plant import Sampled
from flypend.plants.sensors import Sensors
from flypend.plants.tremor import estimate_errors

DRAWN = 512  # machines of a training with bands
UNFOUND = 0.015  # s: the longest delay that the flight computer has not found, or the rotors' curve looks like
LEAST_DELAY = 1e-6  # of a period, so that a mean over it exists
WORSE = 2.0  # errors of estimates in a manoeuvre, of a machine that is not the one believed, over those in hover
TICK = 0.002  # s, of the control period in which readings are taken
# Of a local error of the state, what the theory of tremor has: all but the heading and what is along the rod in hover.
KNOWN = [*range(8), *range(9, 14), 15, 16]


@dataclass(frozen=True)
class Course:
    """What the flights of a training have in common.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle, with rotors that have a lag; kept in units of commanded force.
    period, duration : float
        Control period and length of a flight, s.
    excursion : float
        Weight of the excursion, in rod lengths, in the cost.
    throughout, last : float
        Weights of the distance from hover (see `flights.costs`): its mean over the flight, and over its last third.
    arms : float
        Weight of the largest nearness of the rod to an arm, for a vehicle with a hub.
    bands : bool
        Whether machines drawn from the bands of the vehicle fly, and commands are late.
    sensors : Sensors, optional
        Those with whose errors states are seen; default as they are.
    """

    vehicle: Vehicle
    period: float = 0.02
    duration: float = 3.0
    excursion: float = 1.0
    throughout: float = 0.3
    last: float = 2.0
    arms: float = 3.0
    bands: bool = False
    sensors: Sensors | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "vehicle", self.vehicle.commanded())

    @property
    def steps(self) -> int:
        """Control periods of a flight."""
        return round(self.duration / self.period)

    @property
    def weights(self) -> Any:
        """Weights (steps,) of the distance from hover."""
        weights, last = np.full(self.steps, self.throughout / self.steps), max(1, self.steps // 3)
        weights[-last:] += self.last / last
        return weights


class Flown(NamedTuple):
    """Machines of some flights: numbers (count, ·) as of `Scaled`, and as `OF_FLIGHT`, and shares of hover (count, 2).

    These are shares of the rotors' range, as believed and as true.
    """

    numbers: Any
    of_flight: Any
    hover: Any


@dataclass(frozen=True)
class Machines:
    """Machines of a `course`, and errors of the estimates by which they are flown."""

    course: Course
    all: Flown

    @classmethod
    def of(cls, course: Course, seed: int) -> Machines:
        """Return the vehicle of `course` as written; with bands, `DRAWN` others by `seed`."""
        rng, rows = np.random.default_rng([seed, 3]), [machine_of(course, Sampled(), 0.0)]
        if course.bands:
            latest = min(UNFOUND, course.period)
            rows = [
                machine_of(course, draw_world(course.vehicle, Sampled(), rng), rng.uniform(0, latest))
                for _ in range(DRAWN)
            ]
        return cls(course, Flown(*map(np.array, zip(*rows, strict=True))))

    def choose(self, rng: np.random.Generator, count: int) -> Flown:
        """Return the machines of `count` flights."""
        chosen = rng.integers(len(self.all.numbers), size=count)
        return Flown(*(part[chosen] for part in self.all))

    def shares(self, hover: Any) -> Any:
        """Return the shares (steps, count) of the range that the law holds for hover, for those of `Flown.hover`."""
        nominal, true = hover.T
        since = self.course.period * np.arange(self.course.steps)[:, None]
        return true + (nominal - true) * np.exp(-GAINS["observer"].default * since)

    def errors(self, rng: np.random.Generator, count: int) -> Any:
        """Return local errors (steps + 1, 18, count) of the estimates of a flight, in own units."""
        course, found = self.course, np.zeros((self.course.steps + 1, ERROR, count))
        sensors = course.sensors
        if sensors is None:
            return found
        (step, drive), units, start = self._wandering, Units.of(course.vehicle), sensors.start
        sizes = np.repeat([start.x, start.x_dot, start.attitude, start.omega, start.y, start.y_dot], 3)[KNOWN]
        now = sizes[:, None] * rng.standard_normal((len(KNOWN), count))
        scales = np.repeat([units.length, units.length / units.time, 1.0, 1 / units.time, 1.0, 1 / units.time], 3)
        for at in found:
            at[KNOWN] = now / scales[KNOWN, None]
            now = step @ now + drive @ rng.standard_normal(now.shape)
        return found

    @cached_property
    def _wandering(self) -> tuple[Any, Any]:
        """Matrix of a period of the errors (15,), and a root of the covariance of what is added."""
        course = self.course
        assert course.sensors is not None
        step, added = estimate_errors(course.vehicle, course.sensors, TICK, round(course.period / TICK))
        values, vectors = np.linalg.eigh(added)
        return step, WORSE * vectors * np.sqrt(np.maximum(values, 0))


def machine_of(course: Course, world: Sampled, delay: float) -> tuple[Any, Any, Any]:
    """Return numbers, those of the flight, and shares of hover of the machine in `world`, `delay` seconds late."""
    nominal, true = course.vehicle, world.true_vehicle(course.vehicle)
    units, own = Units.of(nominal), Units.of(true)
    n, h, late = len(true.rotor_spins), course.period, max(delay, LEAST_DELAY * course.period)
    hover = np.full(n, true.weight / n)
    sagged = np.array(sag_forces(ca.DM(hover), true.rotor_limits[1], world.sag)).ravel() / hover  # battery as in hover
    strength = sagged * world.strength
    lag = true.rotor_lag * (1 + world.spin_up) / 2
    lead = 1 / -np.expm1(-h / nominal.rotor_lag) if nominal.rotor_lag > 0 else 1.0
    timings = [step_timing(lag / own.time, part / own.time) for part in (late, h - late)]
    modelled = step_timing(nominal.rotor_lag / own.time, h / own.time)
    low, high = (limit * strength / own.force for limit in nominal.rotor_limits)
    flight = [*timings, modelled, [lead, units.length / own.length, units.time / own.time], low, high]
    least, most = nominal.rotor_limits
    levels = np.array([nominal.weight, true.weight / strength.mean()]) / n
    shares = np.clip((levels - least) / (most - least), LEAST_SHARE, 1 - LEAST_SHARE)
    return own.numbers(true), np.concatenate(flight), shares
