"""The sensors of a flight as a program: from the true state at control ticks to what reaches the flight computer.

A reading is taken at its own instant, between the states before and after it, and waits for its latency. It is
delivered as its numbers and its age: the time (s) since it was taken, negative if nothing new has arrived.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from statistics import NormalDist
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend.compile.record import Field, Record
from flypend.geometry import E3, Matrix, Numbers, Scalar, Vector, clip, cross, is_symbolic, tangent_part, unit
from flypend.model import State, Vehicle
from flypend.model.state import SIZE, centre_velocity
from flypend.plants import defect_program, defects
from flypend.plants.cascade import rotation_by
from flypend.plants.defect_program import Defects
from flypend.plants.defects import POSES
from flypend.plants.measurement import GUSTS, measurement, noise_numbers
from flypend.plants.schedule import SAME_SHARE, Timing, timing
from flypend.plants.sensors import STREAMS, Sensor, Sensors

# Numbers of a reading: an attitude has its matrix by rows, joint angles are given as the rod's direction in the body.
WIDTH = {name: 9 if name == "attitude" else 3 for name in STREAMS}
NOTHING = -1.0  # age of a reading that has not arrived
# The tick whose draws are those of the start: of the estimate, then of errors that last.
START_TICK = 2**40
ESTIMATE_DRAWS = 18


class Moment(NamedTuple):
    """Motion at the instant of a reading, and the mean specific force (body frame, m/s²) of the last control period."""

    state: State
    force: Vector


_READINGS = {
    "position": "position of the pivot, world, m",
    "attitude": "rotation from body to world, by rows",
    "rod": "unit vector from the pivot to the bob, world",
    "gyro": "angular velocity, body, rad/s",
    "accelerometer": "mean specific force at the centre of mass over the last control period, body, m/s^2",
    "joints": "unit vector from the pivot to the bob, body, as the joint's angles tell it",
    "rod_gyro": "angular velocity of the rod, y x y_dot, body, rad/s",
}


def readings_record(sensors: Sensors) -> Record:
    """Return what a flight computer with `sensors` is given: what each stream reads and how old that is."""
    fields: list[Field] = []
    for name in sensors.streams:
        fields.append(Field(name, WIDTH[name], _READINGS[name]))
        fields.append(Field(f"{name}_age", 0, "seconds since it was taken; negative if nothing has arrived"))
    return Record("readings", "What the sensors have delivered since the last control period.", tuple(fields))


def memory_record(sensors: Sensors, period: float) -> Record:
    """Return the memory of `sensing` at a control `period` (s): the last true state, defects, readings that wait."""
    wrong = defect_program.record(sensors)
    lengths = {name: _ticks_under_way(sensors, name, period) * _entry(sensors, name) for name in sensors.streams}
    fields = (
        Field("state", SIZE, "at the last tick, e3 up"),
        *[Field.of(wrong)] * bool(wrong.fields),
        *(Field(name, length, "readings under way, newest first") for name, length in lengths.items() if length),
    )
    return Record("sensors", "The sensors' own.", fields)


def _late(sensors: Sensors, name: str) -> Sensor:
    """Return the stream `name` with the latency that it has at least, told or not."""
    sensor = sensors.streams[name]
    untold = sensors.untold_latency if name in POSES and not defects.shifts(sensors) else 0.0
    return replace(sensor, latency=sensor.latency + untold) if untold else sensor


def _shifts(sensors: Sensors, name: str) -> bool:
    return name in POSES and defects.shifts(sensors)


def _ticks_under_way(sensors: Sensors, name: str, period: float) -> int:
    """Return the number of control ticks whose readings of the stream `name` may still be under way."""
    when = timing(_late(sensors, name), period)
    if not _shifts(sensors, name):
        return when.waiting
    return int(np.ceil((when.whole + when.rest) + defects.room(sensors) / period)) + 1


def _entry(sensors: Sensors, name: str) -> int:
    """Return how many numbers of a reading wait: what is read, its age, and its own part of the latency, if any."""
    return WIDTH[name] + 1 + _shifts(sensors, name)


def draws_of(sensors: Sensors) -> dict[str, tuple[list[int], int | None]]:
    """Return which random numbers of a tick each stream uses: three for noise, and one for dropouts, if there are any.

    Those of gusts are left out.
    """
    free = (i for i in range(10**3) if i not in range(GUSTS.start, GUSTS.stop))
    return {
        name: ([next(free) for _ in range(3)], next(free) if sensor.dropouts else None)
        for name, sensor in sensors.streams.items()
    }


def _defect_draws(sensors: Sensors) -> dict[str, list[int]]:
    """Return which random numbers of a tick the defects use: the first that are free."""
    used = {i for noise, lost in draws_of(sensors).values() for i in (*noise, lost)} | set(
        range(GUSTS.start, GUSTS.stop)
    )
    free = (i for i in range(10**3) if i not in used)
    return {name: [next(free) for _ in range(count)] for name, count in defects.random_numbers(sensors).items()}


def draws_size(sensors: Sensors) -> int:
    """Return how many random numbers a tick draws at most."""
    of_streams = max(max(*noise, lost or 0) for noise, lost in draws_of(sensors).values())
    return 1 + max(of_streams, *(max(some) for some in _defect_draws(sensors).values()), 0)


def start_draws(sensors: Sensors) -> int:
    """Return how many random numbers the start draws: those of the estimate, then those of errors that last."""
    return ESTIMATE_DRAWS + sum(defects.CONSTANT[name][0] for name in defects.names_drawn(sensors))


def first_estimate(sensors: Sensors) -> ca.Function:
    """Return (state (24,), draws) → the estimate (24,) with which a flight begins, e₃ up; see `start_draws`."""
    state, draws = ca.SX.sym("s", SIZE), ca.SX.sym("n", start_draws(sensors))
    given = draws[:ESTIMATE_DRAWS], noise_numbers(sensors.start)
    return ca.Function("estimate", [state, draws], [measurement()(state, *given)])


def first_memory(sensors: Sensors, period: float, state: Numbers, draws: Numbers | None = None) -> Numbers:
    """Return the memory of `sensing` before the first tick, for a true start `state` (24, 1), in CasADi.

    `draws` are those of the start, see `start_draws`; errors that last need them.
    """
    if draws is None and defects.names_drawn(sensors):
        raise ValueError(f"draws of the start for {defects.names_drawn(sensors)}")
    of_flight = ca.DM(0, 1) if draws is None else draws[ESTIMATE_DRAWS:]
    queues = [
        np.tile(np.append(np.zeros(WIDTH[name]), [NOTHING, 0.0][: _entry(sensors, name) - WIDTH[name]]), waiting)
        for name in sensors.streams
        if (waiting := _ticks_under_way(sensors, name, period))
    ]
    state = state if is_symbolic(state) else ca.DM(state)
    wrong = defect_program.first(sensors, State.symbolic(state).y, of_flight)
    return ca.vertcat(state, wrong, *(ca.DM(queue) for queue in queues))


def sensing(sensors: Sensors, vehicle: Vehicle, period: float, *, sized: bool = False) -> ca.Function:
    """Build the CasADi function (memory, t, state (24,), draws) → (memory, readings) of one control tick, e₃ up.

    If it is `sized`, the sizes of defects (`defect_program.size_numbers`) are its last input.

    Parameters
    ----------
    sensors : Sensors
        The sensors.
    vehicle : Vehicle
        The vehicle that flies: source of gravity and of the place of its centre of mass.
    period : float
        Control period, s.
    """
    remembers = memory_record(sensors, period)
    memory, t = ca.SX.sym("memory", remembers.length), ca.SX.sym("t")
    packed, draws = ca.SX.sym("s", SIZE), ca.SX.sym("n", draws_size(sensors))
    past = remembers.split(memory)
    before, now = State.symbolic(past["state"]), State.symbolic(packed)
    v, v_after = (centre_velocity(state, vehicle.pivot_offset) for state in (before, now))
    force = mean_force(v, v_after, before.R, now.R, vehicle.g, period)
    chance = {name: draws[some] for name, some in _defect_draws(sensors).items()}
    numbers = defect_program.size_numbers(sensors, period)
    sizes = ca.SX.sym("sizes", len(numbers)) if sized else ca.SX(numbers)
    wrong = Defects(sensors, period, t, before.y, now.y, past.get("defects", ca.SX(0, 1)), chance, sizes)
    kept, readings = [packed, wrong.after], []
    for name, (noise, lost) in draws_of(sensors).items():
        sensor = _late(sensors, name)
        when = timing(sensor, period)
        since = _since(sensor, when, t, period)
        moment = Moment(now if when.every else _between(before, now, since, period), force)
        values = wrong.mistaken(name, _READ[name](moment, wrong, sensor, sensor.noise * draws[noise]))
        if name == "accelerometer":  # no period has passed at time 0
            since = ca.if_else(t > period / 2, since, NOTHING)
        if lost is not None:
            since = ca.if_else(draws[lost] < NormalDist().inv_cdf(sensor.dropouts), NOTHING, since)
        if (burst := wrong.lost(name)) is not None:
            since = ca.if_else(burst, NOTHING, since)
        entry = ca.vertcat(values, since)
        if (own := wrong.shift(name)) is not None:
            entry = ca.vertcat(entry, own)
        queue = ca.vertcat(entry, past.get(name, ca.SX(0, 1)))
        kept.append(queue[: -entry.numel()])
        entries = ca.vertsplit(queue, entry.numel())
        found = _deliver(entries, when, period) if own is None else _newest_arrived(entries, sensor.latency, period)
        readings.append(_report_age(found, sensor.latency - sensors.streams[name].latency))
    outputs = ca.cse([ca.densify(ca.vertcat(*kept)), ca.densify(ca.vertcat(*readings))])
    return ca.Function("sense", [memory, t, packed, draws, *[sizes] * sized], outputs)


def _report_age(reading: Numbers, untold: float) -> Numbers:
    """Return a `reading` whose age is less by what is `untold` of it, s."""
    if not untold:
        return reading
    age = reading[-1]
    return ca.vertcat(reading[:-1], ca.if_else(age >= 0, ca.fmax(age - untold, 0), NOTHING))


def _newest_arrived(entries: list[Any], latency: float, period: float) -> Numbers:
    """Return numbers and age, less its own part of the latency, of the newest of `entries` that arrives at this tick.

    An entry is numbers, age at its tick, and its own part; it arrives at the first tick at which it is old enough.
    """
    found = ca.vertcat(ca.SX.zeros(entries[0].numel() - 2), NOTHING)
    for ticks, entry in reversed(list(enumerate(entries))):
        *_, taken, own = ca.vertsplit(entry)
        over = taken + ticks * period - (latency + own) + SAME_SHARE * period
        arrives = (taken >= 0) * (over >= 0) * (over < period)
        reading = ca.vertcat(entry[:-2], ca.fmax(taken + ticks * period - own, 0))
        found = ca.if_else(arrives, reading, found)
    return found


def _since(sensor: Sensor, when: Timing, t: Scalar, period: float) -> Scalar:
    """Return the time (s) from the newest reading to the tick at `t`; NOTHING if there is none since the last tick."""
    if when.every:
        return ca.SX(0.0)
    since = ca.fmax(t - ca.floor(t * sensor.rate + SAME_SHARE) / sensor.rate, 0.0)
    return ca.if_else(since < (1 - SAME_SHARE) * period, since, NOTHING)


def _deliver(entries: list[Any], when: Timing, period: float) -> Numbers:
    """Return numbers and age of the reading that arrives at this tick; `entries` are those of the ticks, newest first.

    The reading of a tick was taken up to a period before it, so it arrives after `whole` periods if it was taken early
    enough, and one period later otherwise.
    """
    found = entries[when.whole]
    taken = found[-1]
    age = ca.if_else(taken >= 0, taken + when.whole * period, NOTHING)
    if not when.rest:
        return ca.vertcat(found[:-1], age)
    rest = (when.rest - SAME_SHARE) * period
    early = taken >= rest
    late = entries[when.whole + 1]
    left = (late[-1] >= 0) * (late[-1] < rest)
    age = ca.if_else(early, age, ca.if_else(left, late[-1] + (when.whole + 1) * period, NOTHING))
    return ca.vertcat(ca.if_else(early, found[:-1], late[:-1]), age)


def _between(before: State, now: State, since: Scalar, period: float) -> State:
    """Return the motion `since` seconds before `now`, no more than a `period` after `before`.

    Positions are cubic in time, rates linear.
    """
    since = ca.fmax(since, 0.0)
    share = 1 - since / period

    def cubic(a: Vector, a_dot: Vector, b: Vector, b_dot: Vector) -> Vector:
        """Return the cubic in time with these ends and rates there."""
        rise, start, end = b - a, period * a_dot, period * b_dot
        return a + share * (start + share * (3 * rise - 2 * start - end + share * (start + end - 2 * rise)))

    omega = before.omega + share * (now.omega - before.omega)
    turn = since / 2 * (omega + now.omega)
    y = unit(cubic(before.y, before.y_dot, now.y, now.y_dot))
    x, x_dot = cubic(before.x, before.x_dot, now.x, now.x_dot), before.x_dot + share * (now.x_dot - before.x_dot)
    y_dot = tangent_part(y, before.y_dot + share * (now.y_dot - before.y_dot))
    return State(x=x, x_dot=x_dot, R=now.R @ rotation_by(-turn), omega=omega, y=y, y_dot=y_dot)


def mean_force(v: Vector, v_after: Vector, R: Matrix, R_after: Matrix, g: Scalar, period: float) -> Vector:
    """Return the mean specific force, m/s², between two velocities and attitudes a `period` apart, in the body frame.

    An accelerometer that integrates measures it, and an estimator predicts it by the same formula.
    """
    return ((R + R_after) / 2).T @ ((v_after - v) / period + g * E3)


# What each stream reads of a moment, given what is wrong, the sensor, and its noise: see `_READINGS`.
_READ: dict[str, Callable[[Moment, Defects, Sensor, Any], Any]] = {
    "position": lambda now, wrong, sensor, noise: _quantise(wrong.position(now.state.x, now.state.R) + noise, sensor),
    "attitude": lambda now, wrong, _, noise: ca.vec((wrong.attitude(now.state.R) @ rotation_by(noise)).T),
    "rod": lambda now, wrong, _, noise: _point(wrong.rod(now.state.y), noise),
    "gyro": lambda now, wrong, sensor, noise: _quantise(wrong.gyro(now.state.omega) + noise, sensor),
    "accelerometer": lambda now, wrong, sensor, noise: _quantise(wrong.accelerometer(now.force) + noise, sensor),
    "joints": lambda now, wrong, sensor, noise: _joints(now.state, wrong, sensor, noise),
    "rod_gyro": lambda now, _, sensor, noise: _quantise(
        now.state.R.T @ cross(now.state.y, now.state.y_dot) + noise, sensor
    ),
}


def _joints(state: State, wrong: Defects, sensor: Sensor, noise: Numbers) -> Vector:
    """The rod's direction in the body frame, as the angles of a universal joint tell it: about x, then about y."""
    seen = state.R.T @ state.y
    if not sensor.quantisation and not wrong.turns_joints:
        return _point(seen, noise)
    roll, pitch = ca.atan2(-seen[1], seen[2]), ca.asin(clip(seen[0], -1, 1))
    roll, pitch = wrong.joints(roll + noise[0], pitch + noise[1])
    roll, pitch = (_quantise(angle, sensor) for angle in (roll, pitch))
    return ca.vertcat(ca.sin(pitch), -ca.cos(pitch) * ca.sin(roll), ca.cos(pitch) * ca.cos(roll))


def _quantise(values: Numbers, sensor: Sensor) -> Numbers:
    """Return `values` in steps of the sensor's quantisation."""
    step = sensor.quantisation
    return step * ca.floor(values / step + 0.5) if step else values


def _point(direction: Vector, noise: Numbers) -> Vector:
    return unit(direction + tangent_part(direction, noise))
