"""A flight request: vehicle, law, starts, duration, plant, tolerances and success criterion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from functools import partial
from types import MappingProxyType
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend import errors, plants
from flypend.compile.methods import NAMES as METHODS
from flypend.errors import InputError
from flypend.files.reading import check_fits
from flypend.flight.criterion import Criterion
from flypend.geometry import norm
from flypend.laws import AnyLaw, BoundLaw, Controller
from flypend.model import State, Vehicle
from flypend.model.state import SIZE
from flypend.plants import ROTORS, AnyPlant, Ideal, Sampled
from flypend.plants.loop import Loop
from flypend.plants.plant import check_seed

SAMPLE_PERIOD = 0.01
LEAST_RTOL = 100 * float(np.finfo(float).eps)
LARGEST_RTOL = 0.1  # looser steps have no digit right
MOST_JUDGED = 1e7
MOST_SPIN = 200.0  # rad/s, where a rotor's own speed begins
# What a result takes: a sample of a trajectory with wrench, signals and intermediate arrays; a run of an ensemble.
BYTES_OF_SAMPLE, BYTES_OF_RUN = 2000, 1000
LONGEST = 20_000.0  # s: two million samples, ten million control steps at 500 Hz
# At this tolerance and looser, the method of order 5 is faster.
LOOSE = 1e-6
PRECISIONS = ("double", "float")
MAX_STEPS = 1_000_000


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Tolerances:
    """Integration tolerances of the ideal plant; a sampled flight has fixed steps, see `plants.schedule.PLANT_STEP`.

    Parameters
    ----------
    rtol, atol : float
        Tolerances of the adaptive step; atol defaults to rtol, since state entries are of order one in SI units.
    method : "dop853" or "dp5", optional
        Runge-Kutta method; default chosen by tolerance.
    precision : "double" or "float"
        Precision of all arithmetic; "float" suits tolerances of 1e-4 and looser.
    max_steps : int, optional
        A run that needs more steps ends as diverged; default a million.

    Raises
    ------
    InputError
        If a tolerance is not positive, rtol is not within 100 machine epsilons and 0.1, there are no steps, or method
        or precision is unknown.
    """

    rtol: float = 1e-9
    atol: float | None = None
    method: Literal["dop853", "dp5"] | None = None
    precision: Literal["double", "float"] = "double"
    max_steps: int | None = None

    def __post_init__(self) -> None:
        rtol = errors.number("rtol", self.rtol, above=0, at_most=LARGEST_RTOL)
        if rtol < LEAST_RTOL:
            raise InputError("rtol", f"at least {LEAST_RTOL:g}, 100 machine epsilons", f"{rtol:g}")
        object.__setattr__(self, "rtol", rtol)
        if self.atol is not None:
            object.__setattr__(self, "atol", errors.number("atol", self.atol, above=0))
        if self.method is not None:
            errors.one_of("method", self.method, METHODS)
        errors.one_of("precision", self.precision, PRECISIONS)
        if self.max_steps is not None:
            errors.integer("max_steps", self.max_steps, 1)

    @property
    def absolute(self) -> float:
        """The absolute tolerance."""
        return self.rtol if self.atol is None else self.atol

    @property
    def steps(self) -> int:
        """The largest number of steps."""
        return MAX_STEPS if self.max_steps is None else self.max_steps

    def method_for(self, law: BoundLaw) -> str:
        """Return the requested Runge-Kutta method; by default the faster one, but DOP853 if `law` can be singular.

        DP5's error estimate misses narrow singularities that DOP853's detects.
        """
        return self.method or ("dp5" if self.rtol >= LOOSE and law.guard is None else "dop853")


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Flight:
    """A flight from one start or many: everything that the result depends on, checked once.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle parameters.
    law : BoundLaw or Controller
        Control law; a Law is bound to the vehicle on construction.
    starts : State
        A single state, or a batch with one leading axis, in the law's frame.
    duration : float
        Flight time, s, > 0.
    plant : Ideal or Sampled
        Plant; default: rotor limits, rotor lag and sampling at 500 Hz. In the ideal plant, a Controller is sampled at
        its own rate.
    tolerances : Tolerances
        Tolerances of the ideal plant.
    criterion : Criterion
        Success criterion.
    gains : dict
        For a batch: gains that differ between runs, name to (n,) or one number. Like gains that are given to the law,
        they are not calmed; how far the others are follows from the law's own gains.
    times : (t,) increasing, optional
        Times at which states are kept, s; in a sampled flight, the nearest control ticks.
    judge_period : float
        Sampling period of the criterion, s.
    seed : int, optional
        Seed of noise and gusts in the first run, increasing by 1 per run; default that of the plant.

    Raises
    ------
    InputError
        If a value has the wrong type or is out of range.
    """

    vehicle: Vehicle
    law: BoundLaw | Controller
    starts: State
    duration: float
    plant: AnyPlant = ROTORS
    tolerances: Tolerances = field(default_factory=Tolerances)
    criterion: Criterion = field(default_factory=Criterion)
    gains: Mapping[str, Any] = field(default_factory=dict)
    times: NDArray[np.float64] | None = None
    judge_period: float = SAMPLE_PERIOD
    seed: int | None = None

    def __post_init__(self) -> None:
        if len(self.starts.batch_shape) > 1:
            raise InputError("starts", "a State with one leading batch axis", f"shape {self.starts.batch_shape}")
        if 0 in self.starts.batch_shape:
            raise InputError("starts", "at least one", "none")
        put = partial(object.__setattr__, self)
        put("vehicle", self.vehicle.commanded())
        put("law", bound_to(self.vehicle, self.law))
        put("duration", errors.number("duration", self.duration, above=0, at_most=LONGEST, unit="s"))
        errors.check_kind("gains", self.gains, Mapping)
        put("judge_period", errors.number("judge_period", self.judge_period, above=0, unit="s"))
        if (judged := self.duration / self.judge_period) > MOST_JUDGED:
            given = f"{self.judge_period:g} s, which takes {judged:g}"
            raise InputError("judge_period", f"at most {MOST_JUDGED:g} of them in a run", given)
        if self.judge_period > max(self.duration, SAMPLE_PERIOD):
            raise InputError("judge_period", f"at most the duration, {self.duration:g} s", f"{self.judge_period:g}")
        if self.seed is not None:
            check_seed("seed", self.seed)
        plant = plants.plant(self.plant)
        if isinstance(plant, Ideal) and isinstance(self.law, Controller):  # which is sampled
            lag = None if plant.lag else 0.0
            plant = Sampled(limits=plant.limits, lag=lag, rate=self.law.rate, floor=plant.floor)
        put("plant", plant)
        law = self.law.vary(self.gains) if isinstance(self.law, BoundLaw) else self.law
        put("law", Loop(self.vehicle, law, self.plant).law)
        if self.seed is None:
            put("seed", self.plant.seed if isinstance(self.plant, Sampled) else 0)
        put("times", _check_times(self.times, self.duration))
        put("gains", self._check_gains())
        self._check_together()

    def _check_gains(self) -> Mapping[str, NDArray[np.float64]]:
        if not self.gains:
            return MappingProxyType({})
        if self.single:
            raise InputError("gains", "nothing for a single start: set them in the law", sorted(self.gains))
        if isinstance(self.law, Controller) and self.law.steering is None:
            raise InputError("gains", "a law that depends on its gains", f"{self.law.name}, which does not")
        return MappingProxyType({name: _column(self.law, name, value, self.runs) for name, value in self.gains.items()})

    def _check_together(self) -> None:
        spin = float(np.max(norm(self.starts.omega), initial=0.0))
        if spin > MOST_SPIN:
            given = f"{spin:.4g} rad/s; is it in degrees?"
            raise InputError(
                "start.omega", f"at most {MOST_SPIN:g} rad/s ({MOST_SPIN / (2 * np.pi):.0f} turns/s)", given
            )
        self._check_lift()
        self._check_memory()
        if isinstance(self.plant, Ideal) and self.plant.lag:
            if self.vehicle.rotor_lag <= 0:
                raise InputError("vehicle.rotor_lag", "a lag > 0 s, for Ideal(lag=True)", f"{self.vehicle.rotor_lag:g}")
            self.plant.initial_wrench(self.vehicle, self.runs, self.law.e3)  # raises for wrong forces
        if isinstance(self.law, BoundLaw) and self.law.uses_wrench and not self.loop.lag:
            wanted = f"flypend.Ideal(lag=True), for {self.law.name}, which knows the rotors' lag and wrench"
            raise InputError("plant", wanted, "another")
        if isinstance(self.plant, Sampled):
            self.plant.true_vehicle(self.vehicle)  # raises if the vehicle lacks what the plant needs
            for name, usual in (("method", "nothing"), ("precision", "'double'")):
                if getattr(self.tolerances, name) != getattr(Tolerances(), name):
                    raise InputError(name, f"{usual} in a sampled flight", repr(getattr(self.tolerances, name)))

    def _check_lift(self) -> None:
        """Raise InputError if rotors with limits cannot lift the vehicle."""
        vehicle = self.vehicle
        most = len(vehicle.rotor_spins) * vehicle.rotor_limits[1]
        if self.plant.limits and most <= vehicle.weight:
            given = f"{most:.4g} N from {len(vehicle.rotor_spins)} rotors"
            masses = f"mass {vehicle.mass:g} kg + bob_mass {vehicle.bob_mass:g} kg (not g)"
            wanted = f"rotors that lift it: more than its weight, {vehicle.weight:.4g} N with {masses}"
            raise InputError("vehicle.rotor_limits", wanted, given)

    def _check_memory(self) -> None:
        """Raise InputError if the results would not fit the memory."""
        kept = len(self.moments) if self.single else 0 if self.times is None else len(self.times)
        if self.single:
            needed, what = kept * BYTES_OF_SAMPLE, f"{kept} samples"
        else:
            size = 8 * (SIZE + len(self.vehicle.rotor_spins))
            needed, what = self.runs * (BYTES_OF_RUN + kept * size), f"{self.runs} runs with {kept} samples each"
        field = "duration" if self.times is None else "times"
        check_fits(field if kept else "runs", needed, what)

    @property
    def single(self) -> bool:
        """Whether there is one start, so that the result is a `Trajectory`."""
        return not self.starts.batch_shape

    @property
    def runs(self) -> int:
        """Number of runs."""
        return 1 if self.single else len(self.starts)

    @property
    def loop(self) -> Loop:
        """The part of the request that compiled code depends on."""
        plant = self.plant.replace(seed=0) if isinstance(self.plant, Sampled) else replace(self.plant, rotors=None)
        return Loop(self.vehicle, self.law, plant, tuple(self.gains))

    @property
    def grid(self) -> NDArray[np.float64]:
        """Times at which the criterion is evaluated, s."""
        return np.linspace(0.0, self.duration, max(2, round(self.duration / self.judge_period) + 1))

    @property
    def moments(self) -> NDArray[np.float64]:
        """Times at which a single run is sampled, s: `times`, or by default `grid`."""
        return self.grid if self.times is None else self.times

    @property
    def packed(self) -> NDArray[np.float64]:
        """The packed starts (n, 24); in the ideal plant with lag, (n, 28) with the wrenches that act at the start."""
        found: NDArray[np.float64] = np.atleast_2d(self.starts.packed())
        if self.loop.lag:
            assert isinstance(self.plant, Ideal)
            found = np.concatenate([found, self.plant.initial_wrench(self.vehicle, self.runs, self.law.e3)], axis=1)
        return found

    @property
    def values(self) -> NDArray[np.float64] | None:
        """The gains (n, k) that differ between runs; None for none."""
        return np.stack(list(self.gains.values()), axis=1) if self.gains else None

    def replace(self, **changes: Any) -> Flight:
        """Return a copy with `changes` applied, validated again. Raises InputError if a value is invalid."""
        errors.only_known("flight", changes, [entry.name for entry in fields(self)])
        return replace(self, **changes)

    def through(self, plant: AnyPlant) -> Flight:
        """Return the same flight through another `plant`, with that plant's seed."""
        return replace(self, plant=plant, seed=None)

    def member(self, i: int) -> Flight:
        """Return run `i` as a flight of its own, with its own seed and, under a Controller, its own gains.

        Not available for a symbolic law with gains that differ between runs.
        """
        law = self.law
        if self.gains:
            assert isinstance(law, Controller)
            law = law.with_gains({name: float(value[i]) for name, value in self.gains.items()})
        plant = self.plant
        if isinstance(plant, Ideal) and np.ndim(plant.rotors) == 2:
            plant = replace(plant, rotors=plant.rotors[i])
        return replace(self, law=law, gains={}, starts=self.starts[i], seed=(self.seed or 0) + i, plant=plant)


def bound_to(vehicle: Vehicle, law: AnyLaw) -> BoundLaw | Controller:
    """Return `law` bound to `vehicle`. Raises InputError if either has the wrong type."""
    errors.check_kind("vehicle", vehicle, Vehicle)
    errors.check_kind("law", law, AnyLaw)
    return law.bind(vehicle)


def check_batch(starts: State) -> None:
    """Raise InputError unless `starts` is a batch of states with one leading axis."""
    errors.check_kind("starts", starts, State)
    if len(starts.batch_shape) != 1:
        given = f"a batch of shape {starts.batch_shape}" if starts.batch_shape else "a single state"
        raise InputError("starts", "a State with one leading batch axis", given)


def check_judged(flight: Flight) -> None:
    """Raise InputError unless the duration of `flight` is as long as its criterion has to hold."""
    if flight.duration < flight.criterion.hold:
        wanted = f"at least {flight.criterion.hold:g} s, for which the criterion has to hold"
        raise InputError("duration", wanted, f"{flight.duration:g}")


def some_times(times: ArrayLike | None) -> NDArray[np.float64] | None:
    """Return `times` (t,) as an array, or None. Raises InputError unless they are numbers."""
    return None if times is None else errors.array("times", times, (None,))


def _check_times(times: NDArray[np.float64] | None, duration: float) -> NDArray[np.float64] | None:
    if (wanted := some_times(times)) is None:
        return None
    if not len(wanted) or np.any(np.diff(wanted) <= 0):
        raise InputError("times", "increasing times of shape (n,)", f"shape {wanted.shape}, or not increasing")
    if wanted[0] < 0 or wanted[-1] > duration:
        raise InputError("times", f"times inside 0 .. {duration:g} s", f"{wanted[0]:g} .. {wanted[-1]:g} s")
    return wanted


def _column(law: BoundLaw | Controller, name: str, value: ArrayLike, runs: int) -> NDArray[np.float64]:
    """Return the checked values (n,) of one gain of `law`, from (n,) or one number for all runs."""
    given = law.check_gain(name, value)
    if given.shape not in ((), (runs,)):
        raise InputError(f"gains.{name}", f"a number, or {runs} of them", f"shape {given.shape}")
    return np.broadcast_to(given, (runs,))
