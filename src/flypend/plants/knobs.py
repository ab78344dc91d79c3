"""Numbers of a sampled plant that may change during a flight: from knobs to the inputs of its machine code.

A flight in pieces takes them anew with each piece; see `flypend.flight.kernels.pieces`.
"""

from __future__ import annotations

from dataclasses import astuple
from typing import Any

import casadi as ca
import numpy as np

from flypend.geometry import Numbers, Scalar
from flypend.model import Vehicle
from flypend.plants.defect_program import sizes
from flypend.plants.defects import NAMES
from flypend.plants.lag import symbolic_timing
from flypend.plants.measurement import NOISE_SIZE, wind_numbers
from flypend.plants.motors import motor_timing
from flypend.plants.noise import Noise
from flypend.plants.plant import Sampled, Wind
from flypend.plants.schedule import SAME, longest_step
from flypend.plants.sensors import Sensors

# Knobs and their lengths: rotor lag and delay, s; noise, as the fields of `Noise`; where the origin is seen, m, so that
# a law holds another place; sizes of the defects `NAMES` of sensors, of which the adjustable act; constant forces and
# gusts on vehicle and bob, N; least and largest force of a rotor, N.
KNOBS = {
    "lag": 1, "delay": 1, "noise": NOISE_SIZE, "origin": 3, "defects": len(NAMES), "on_vehicle": 3, "on_bob": 3,
    "gust_on_vehicle": 1, "gust_on_bob": 1, "rotor_limits": 2,
}  # fmt: skip
STRETCHES = 2  # intervals of a tick: under the command before, and under the one that arrives
LONGEST_DELAY = 0.1  # s
LONGEST_SHIFT = 0.06  # s, by which poses may be older than told
LEAST_LAG = 1e-6  # s; a shorter one is none


def knob_values(vehicle: Vehicle, plant: Sampled) -> dict[str, list[float]]:
    """Return the knobs of `plant`, flown by a computer that believes in `vehicle`; see `KNOBS`."""
    wind, noise = plant.wind or Wind(), plant.noise or Noise()
    return {
        "lag": [float(plant.true_vehicle(vehicle).rotor_lag)],
        "delay": [float(plant.delay)],
        "noise": [float(value) for value in astuple(noise)],
        "origin": [0.0, 0.0, 0.0],
        "defects": [0.0] * len(NAMES) if plant.sensors is None else defect_sizes(plant.sensors),
        "on_vehicle": [float(value) for value in wind.on_vehicle],
        "on_bob": [float(value) for value in wind.on_bob],
        "gust_on_vehicle": [float(wind.gust_on_vehicle)],
        "gust_on_bob": [float(wind.gust_on_bob)],
        "rotor_limits": [float(limit) for limit in vehicle.rotor_limits],
    }


def turn_knobs(plant: Sampled) -> ca.Function:
    """Return the CasADi function (knobs) → the inputs of a flight in pieces through `plant`.

    They are age and steps of each interval, its timing, noise and origin, or sizes of the sensors' defects, wind, rotor
    limits: see `SampledProblem.inputs`.
    """
    knobs = ca.SX.sym("knobs", sum(KNOBS.values()))
    ends = np.cumsum([0, *KNOBS.values()]).tolist()
    of = dict(zip(KNOBS, ca.vertsplit(knobs, ends), strict=True))
    period = 1 / plant.rate
    intervals = _intervals(of["delay"], period, longest_step(plant))
    schedule = [ca.vertcat(age, steps) for age, steps, _ in intervals]
    lengths = [while_ / ca.fmax(steps, 1) for _, steps, while_ in intervals]
    timings = [motor_timing(of["lag"], plant, length, _timing) for length in lengths]
    seen = [of["noise"], of["origin"]] if plant.sensors is None else _defects(of["defects"], plant.sensors, period)
    numbers = ca.vertcat(*schedule, *timings, *seen, _wind(of, plant, period), of["rotor_limits"])
    return ca.Function("turned", [knobs], [ca.cse(ca.densify(numbers))])


def defect_sizes(sensors: Sensors) -> list[float]:
    """Return the sizes of the defects `NAMES` of `sensors`; 0 of one that is a vector, which no knob turns."""
    return [0.0 if np.ndim(size) else float(size) for size in (getattr(sensors, name) for name in NAMES)]


def _defects(knob: Scalar, sensors: Sensors, period: float) -> list[Any]:
    """Return the sizes that the program of `sensors` takes."""
    given = {name: size for name, size in zip(NAMES, ca.vertsplit(knob), strict=True) if name in sensors.adjustable}
    given = {name: size for name, size in given.items() if not np.ndim(getattr(sensors, name))}
    if "untold_latency" in given:
        given["untold_latency"] = ca.fmin(given["untold_latency"], LONGEST_SHIFT)
    if "latency_jitter" in given:
        untold = given.get("untold_latency", sensors.untold_latency)
        given["latency_jitter"] = ca.fmin(given["latency_jitter"], LONGEST_SHIFT - untold)
    return [number for some in sizes(sensors, period, given).values() for number in some]


def depth(plant: Sampled) -> int:
    """Return the number of commands to buffer for any delay up to that of `plant`."""
    return 2 + int(np.floor((plant.delay + SAME) * plant.rate))


def _intervals(delay: Scalar, period: float, longest: float) -> list[tuple[Scalar, Scalar, Scalar]]:
    """Age, steps and duration (s) of the intervals of a tick, as `segments_within` and `steps_in`; one may be empty."""
    whole = ca.floor((delay + SAME) / period)
    rest = delay - whole * period
    rest = ca.if_else(rest > SAME, rest, 0)
    first = ca.if_else(rest > 0, _count(rest, longest), 0)
    second = _count(period - rest, longest)
    return [(whole + 1, first, rest), (whole, second, period - rest)]


def _count(duration: Scalar, longest: float) -> Scalar:
    """Return the fewest steps of at most `longest` (s) in a `duration`, at least one; pages have no function ceil."""
    return ca.fmax(1, -ca.floor(SAME - duration / longest))


def _timing(lag: Scalar, duration: Scalar) -> Numbers:
    """As `step_timing`, of symbols."""
    while_ = ca.fmax(duration, SAME)  # of an interval that is empty nothing is used
    numbers = symbolic_timing(ca.fmax(lag, LEAST_LAG), while_)
    return ca.vertcat(while_, ca.if_else(lag > LEAST_LAG, numbers[1:], ca.DM.zeros(3)))


def _wind(of: dict[str, Any], plant: Sampled, period: float) -> Numbers:
    """As `wind_numbers`, whose decay and knocks are those of `plant`."""
    fixed, gusty = wind_numbers(plant.wind or Wind(), period), (of["gust_on_vehicle"], of["gust_on_bob"])
    return ca.vertcat(fixed[0], *gusty, of["on_vehicle"], of["on_bob"], fixed[9:])
