"""A sampled flight, step by step in Python: measure, command, hold, with the plant's imperfections in between.

It flies callable laws, for which there is no kernel, and serves as the reference for the kernel.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from flypend import signals
from flypend.board.command import idle_command
from flypend.board.computer import Estimating, FlightComputer, SteppedBoard
from flypend.building import built
from flypend.compile.llvm.random import PER_TICK, normals
from flypend.compile.numeric import as_numpy, distinct
from flypend.compile.problem import GUST_TICK
from flypend.errors import InputError
from flypend.flight.outcome import LEFT, Outcome
from flypend.flight.request import Flight
from flypend.flight.touch import watcher
from flypend.geometry import Numbers
from flypend.laws import Controller
from flypend.model import Vehicle
from flypend.model.state import MAX_STATE, convert_packed
from flypend.plants.actuation import Actuation, make_engine
from flypend.plants.loop import Loop
from flypend.plants.measurement import GUST_MEMORY, GUSTS, MEASUREMENT, gusts, measurement, noise_numbers, wind_numbers
from flypend.plants.plant import Plant
from flypend.plants.schedule import segments_within
from flypend.plants.sensing import START_TICK, draws_size, first_estimate, first_memory, sensing, start_draws

NOT_FINITE = "the law's wrench is not a finite number"


@dataclass(frozen=True)
class Samples:
    """A sampled flight at its control ticks: `t` (n,), s; `packed` (n, 24), e₃ up; `rotors` (n, k), N; `outcome`."""

    t: Numbers
    packed: Numbers
    rotors: Numbers
    outcome: Outcome

    def at(self, ticks: Numbers) -> Samples:
        """Return the samples at the control ticks nearest to `ticks` (real numbers), without duplicates."""
        kept = distinct(np.clip(np.rint(ticks).astype(int), 0, len(self.t) - 1))
        return Samples(self.t[kept], self.packed[kept], self.rotors[kept], self.outcome)


def fly_stepwise(flight: Flight, rotors: Numbers = None) -> Samples:
    """Fly the single start of `flight`, whose plant is sampled, step by step.

    `rotors` (n,) are the initial rotor forces, N; default their minimum. Every control tick is recorded.
    """
    loop = flight.loop
    vehicle, law, plant = loop.vehicle, loop.law, loop.sampled.replace(seed=flight.seed)
    start, duration = flight.starts, flight.duration
    true = plant.true_vehicle(vehicle)
    engine = make_engine(true, plant)
    packed = convert_packed(start.packed(), law.e3)
    begin = np.full(len(vehicle.rotor_spins), vehicle.rotor_limits[0]) if rotors is None else np.asarray(rotors)
    engine.reset(packed, begin)
    world = Actuation(engine, vehicle, plant)
    period, ticks = 1 / plant.rate, number_of_ticks(duration, plant)
    measure, next_wind = _chance(true, plant, packed, ticks)
    computer = flight_computer(loop, begin, estimate_at_start(plant, packed))
    states, forces = [engine.packed], [engine.rotors]
    segments = segments_within(plant.delay, period)
    commands = [idle_command(loop, begin)] * max(age for age, _ in segments)  # in effect before the first
    outcome = Outcome("completed", ticks * period)
    watch, there = watcher(true, floor=plant.floor), np.append(engine.packed, engine.rotors)
    if (touch := watch(there, there, period)) is not None:
        outcome, ticks = Outcome("collided", 0.0, touch.reason), 0
    with np.errstate(all="ignore"):
        for k in range(ticks):
            signals.poll()
            measured = measure(k, engine.packed)
            command = computer.command(k * period, measured)
            if not np.isfinite(np.sum(command)):
                outcome = Outcome("singular", k * period, NOT_FINITE)
                break
            commands.append(command)
            wind = next_wind(k)
            for age, while_ in segments:
                world.advance(commands[-1 - age], while_, wind)
            if not np.max(np.abs(engine.packed)) < MAX_STATE:  # or NaN
                outcome = Outcome("diverged", k * period, LEFT)
                break
            here = np.append(engine.packed, engine.rotors)
            if (touch := watch(there, here, period)) is not None:
                outcome = Outcome("collided", (k + touch.share) * period, touch.reason)
                break
            there = here
            states.append(engine.packed)
            forces.append(engine.rotors)
    return Samples(np.arange(len(states)) * period, np.array(states), np.array(forces), outcome)


def flight_computer(loop: Loop, rotors: Numbers, estimate: Numbers = None) -> FlightComputer:
    """Return the flight computer of `loop`, for initial rotor forces `rotors` (n,), N.

    A plant with sensors needs an `estimate` (24,) of the state at the start, e₃ up. Raises InputError for a controller
    that replaces the flight computer and takes no readings.
    """
    if isinstance(loop.law, Controller) and loop.law.flight_computer is not None:
        made: FlightComputer = loop.law.flight_computer(loop, rotors)
        if loop.sampled.sensors is not None:
            if not isinstance(made, Estimating):
                raise InputError("plant.sensors", "perfect, for a controller without an estimator", loop.law.name)
            made.estimate_from(estimate)
        return made
    return SteppedBoard(loop, rotors, estimate)


def estimate_at_start(plant: Plant, packed: Numbers) -> Numbers:
    """Return the estimate (24,) with which a flight from the state `packed` (24,), e₃ up, begins; None if perfect."""
    if plant.sensors is None:
        return None
    return np.asarray(first_estimate(plant.sensors)(packed, _draws_at_start(plant))).ravel()


def _draws_at_start(plant: Plant) -> Numbers:
    return normals(plant.seed, 1, start_draws(plant.sensors), first=START_TICK)[0]


def number_of_ticks(duration: float, plant: Plant) -> int:
    """Return the number of control ticks in a flight of `duration` seconds."""
    return max(1, round(duration * plant.rate))


def nearest_ticks(times: Numbers, plant: Plant, duration: float) -> Numbers:
    """Return the control ticks (k,) nearest to `times` (s) in a flight of `duration` seconds, without duplicates."""
    return distinct(np.clip(np.rint(times * plant.rate).astype(np.int64), 0, number_of_ticks(duration, plant)))


def _chance(
    vehicle: Vehicle, plant: Plant, start: Numbers, ticks: int
) -> tuple[Callable[[int, Numbers], Numbers], Callable[[int], Numbers]]:
    """Return (tick, state) → measured state or readings, and tick → wind forces on vehicle and bob (6,), N."""
    count = PER_TICK if plant.sensors is None else max(PER_TICK, draws_size(plant.sensors))
    drawn = normals(plant.seed, ticks, count) if is_random(plant) else None
    measure: Callable[[int, Any], Any] = lambda _, packed: packed  # noqa: E731
    if plant.noise is not None and drawn is not None:
        noisy, sigma = _compile(measurement), noise_numbers(plant.noise)
        measure = lambda k, packed: noisy(packed, drawn[k, MEASUREMENT], sigma)  # noqa: E731
    if plant.sensors is not None and drawn is not None:
        measure = _sense(vehicle, plant, start, drawn)
    if plant.wind is None:
        return measure, lambda _: np.zeros(6)
    blow, numbers, gust = _compile(gusts), wind_numbers(plant.wind, 1 / plant.rate), np.zeros(GUST_MEMORY)
    nothing = np.zeros(6)
    if drawn is not None:
        gust[:6] = normals(plant.seed, 1, first=GUST_TICK)[0, GUSTS]

    def next_wind(k: int) -> Numbers:
        gust[:], force = blow(gust, nothing if drawn is None else drawn[k, GUSTS], numbers)
        return force

    return measure, next_wind


def _sense(vehicle: Vehicle, plant: Plant, start: Numbers, drawn: Numbers) -> Callable[[int, Numbers], Numbers]:
    """Return (tick, state) → readings, for the true `start` (24,) and the random numbers `drawn` (ticks, n)."""
    period, count = 1 / plant.rate, draws_size(plant.sensors)
    sense = as_numpy(sensing(plant.sensors, vehicle, period))
    memory = np.asarray(ca.DM(first_memory(plant.sensors, period, start, _draws_at_start(plant)))).ravel()

    def measure(k: int, packed: Numbers) -> Numbers:
        nonlocal memory
        memory, readings = sense(memory, k * period, packed, drawn[k, :count])
        return readings

    return measure


@built(maxsize=None)
def _compile(make: Callable[[], ca.Function]) -> Any:
    return as_numpy(make())


def is_random(plant: Plant) -> bool:
    """Whether flights through `plant` depend on its seed."""
    blown = plant.wind is not None and plant.wind.random
    return plant.noise is not None or plant.sensors is not None or blown
