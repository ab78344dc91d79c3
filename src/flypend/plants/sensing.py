"""The sensors of a flight as a program: from the true state at control ticks to what reaches the flight computer.

A reading is taken at its own instant, between the states before and after it, and waits for its latency. It is
delivered as its numbers and its age: the time (s) since it was taken, negative if nothing new has arrived.
"""

from __future__ import annotations

from collections.abc import Callable
from statistics import NormalDist
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend.geometry import E3, cross, tangent_part, unit
from flypend.model import State, Vehicle
from flypend.model.state import SIZE
from flypend.plants.cascade import rotation_by
from flypend.plants.measurement import GUSTS, measurement, noise_numbers
from flypend.plants.sensors import STREAMS, Sensor, Sensors
from flypend.plants.timing import SAME, Timing, timing

# Numbers of a reading: an attitude has its matrix by rows, joint angles are given as the rod's direction in the body.
WIDTH = {name: 9 if name == "attitude" else 3 for name in STREAMS}
NOTHING = -1.0  # age of a reading that has not arrived
# The tick whose draws are those of the estimate at the start.
START_TICK = 2**40


class Moment(NamedTuple):
    """Motion at the instant of a reading, and the mean specific force (body frame, m/s²) of the last control period."""

    state: State
    force: Any


def readings_size(sensors: Sensors) -> int:
    """Return the length of what a flight computer is given: each stream's numbers and age, in the order of STREAMS."""
    return sum(WIDTH[name] + 1 for name in sensors.streams)


def draws_of(sensors: Sensors) -> dict[str, tuple[list[int], int | None]]:
    """Return which random numbers of a tick each stream uses: three for noise, and one for dropouts, if there are any.

    Those of gusts are left out.
    """
    free = (i for i in range(10**3) if i not in range(GUSTS.start, GUSTS.stop))
    return {
        name: ([next(free) for _ in range(3)], next(free) if sensor.dropouts else None)
        for name, sensor in sensors.streams.items()
    }


def draws_size(sensors: Sensors) -> int:
    """Return how many random numbers a tick draws at most."""
    return 1 + max(max(*noise, lost or 0) for noise, lost in draws_of(sensors).values())


def first_estimate(sensors: Sensors) -> ca.Function:
    """Return (state (24,), draws (18,)) → the estimate (24,) with which a flight begins, e₃ up."""
    state, draws = ca.SX.sym("s", SIZE), ca.SX.sym("n", 18)
    return ca.Function("estimate", [state, draws], [measurement()(state, draws, noise_numbers(sensors.start))])


def first_memory(sensors: Sensors, period: float, state: Any) -> Any:
    """Return the memory of `sensing` before the first tick, for a true start `state` (24, 1), in CasADi."""
    queues = [
        np.tile(np.append(np.zeros(WIDTH[name]), NOTHING), timing(sensor, period).waiting)
        for name, sensor in sensors.streams.items()
    ]
    return ca.vertcat(state, *(ca.DM(queue) for queue in queues))


def memory_size(sensors: Sensors, period: float) -> int:
    """Return the length of the memory of `sensing`: the last true state, and the readings that wait."""
    waiting = (timing(s, period).waiting * (WIDTH[name] + 1) for name, s in sensors.streams.items())
    return SIZE + sum(waiting)


def sensing(sensors: Sensors, vehicle: Vehicle, period: float) -> ca.Function:
    """Build the CasADi function (memory, t, state (24,), draws) → (memory, readings) of one control tick, e₃ up.

    Parameters
    ----------
    sensors : Sensors
        The sensors.
    vehicle : Vehicle
        Source of gravity.
    period : float
        Control period, s.
    """
    memory, t = ca.SX.sym("memory", memory_size(sensors, period)), ca.SX.sym("t")
    packed, draws = ca.SX.sym("s", SIZE), ca.SX.sym("n", draws_size(sensors))
    before, now = State.symbolic(memory[:SIZE]), State.symbolic(packed)
    force = _specific_force(before, now, vehicle, period)
    kept, readings, place = [packed], [], SIZE
    for name, (noise, lost) in draws_of(sensors).items():
        sensor = sensors.streams[name]
        when = timing(sensor, period)
        since = _since(sensor, when, t, period)
        moment = Moment(now if when.every else _between(before, now, since, period), force)
        values = _READ[name](moment, sensor, draws[noise])
        if name == "accelerometer":  # no period has passed at time 0
            since = ca.if_else(t > period / 2, since, NOTHING)
        if lost is not None:
            since = ca.if_else(draws[lost] < NormalDist().inv_cdf(sensor.dropouts), NOTHING, since)
        entry = ca.vertcat(values, since)
        length = when.waiting * entry.numel()
        queue = ca.vertcat(entry, memory[place : place + length])
        kept.append(queue[:length])
        readings.append(_delivered(ca.vertsplit(queue, entry.numel()), when, period))
        place += length
    outputs = ca.cse([ca.densify(ca.vertcat(*kept)), ca.densify(ca.vertcat(*readings))])
    return ca.Function("sense", [memory, t, packed, draws], outputs)


def _since(sensor: Sensor, when: Timing, t: Any, period: float) -> Any:
    """Return the time (s) from the newest reading to the tick at `t`; NOTHING if there is none since the last tick."""
    if when.every:
        return ca.SX(0.0)
    since = ca.fmax(t - ca.floor(t * sensor.rate + SAME) / sensor.rate, 0.0)
    return ca.if_else(since < (1 - SAME) * period, since, NOTHING)


def _delivered(entries: list[Any], when: Timing, period: float) -> Any:
    """Return numbers and age of the reading that arrives at this tick; `entries` are those of the ticks, newest first.

    The reading of a tick was taken up to a period before it, so it arrives after `whole` periods if it was taken early
    enough, and one period later otherwise.
    """
    found = entries[when.whole]
    taken = found[-1]
    age = ca.if_else(taken >= 0, taken + when.whole * period, NOTHING)
    if not when.rest:
        return ca.vertcat(found[:-1], age)
    rest = (when.rest - SAME) * period
    early = taken >= rest
    late = entries[when.whole + 1]
    left = (late[-1] >= 0) * (late[-1] < rest)
    age = ca.if_else(early, age, ca.if_else(left, late[-1] + (when.whole + 1) * period, NOTHING))
    return ca.vertcat(ca.if_else(early, found[:-1], late[:-1]), age)


def _between(before: State, now: State, since: Any, period: float) -> State:
    """Return the motion `since` seconds before `now`, no more than a `period` after `before`.

    Positions are cubic in time, rates linear.
    """
    since = ca.fmax(since, 0.0)
    share = 1 - since / period

    def cubic(a: Any, a_dot: Any, b: Any, b_dot: Any) -> Any:
        rise, start, end = b - a, period * a_dot, period * b_dot
        return a + share * (start + share * (3 * rise - 2 * start - end + share * (start + end - 2 * rise)))

    omega = before.omega + share * (now.omega - before.omega)
    turn = since / 2 * (omega + now.omega)
    y = unit(cubic(before.y, before.y_dot, now.y, now.y_dot))
    return State(
        x=cubic(before.x, before.x_dot, now.x, now.x_dot),
        x_dot=before.x_dot + share * (now.x_dot - before.x_dot),
        R=now.R @ rotation_by(-turn),
        omega=omega,
        y=y,
        y_dot=tangent_part(y, before.y_dot + share * (now.y_dot - before.y_dot)),
    )


def _specific_force(before: State, now: State, vehicle: Vehicle, period: float) -> Any:
    """Return the mean of ẍ + g e₃ over a period in the mean body frame, m/s²."""
    return mean_force(before.x_dot, now.x_dot, before.R, now.R, vehicle.g, period)


def mean_force(v: Any, v_after: Any, R: Any, R_after: Any, g: Any, period: float) -> Any:
    """Return the mean specific force, m/s², between two velocities and attitudes a `period` apart, in the body frame.

    An accelerometer that integrates measures it, and an estimator predicts it by the same formula.
    """
    return ((R + R_after) / 2).T @ ((v_after - v) / period + g * E3)


# One reading each ------------------------------------------------------------------------------------------------


def _position(moment: Moment, sensor: Sensor, draw: Any) -> Any:
    return moment.state.x + sensor.noise * draw


def _attitude(moment: Moment, sensor: Sensor, draw: Any) -> Any:
    return ca.vec((moment.state.R @ rotation_by(sensor.noise * draw)).T)


def _rod(moment: Moment, sensor: Sensor, draw: Any) -> Any:
    return _pointed(moment.state.y, sensor, draw)


def _gyro(moment: Moment, sensor: Sensor, draw: Any) -> Any:
    return moment.state.omega + sensor.noise * draw


def _accelerometer(moment: Moment, sensor: Sensor, draw: Any) -> Any:
    return moment.force + sensor.noise * draw


def _joints(moment: Moment, sensor: Sensor, draw: Any) -> Any:
    """The rod's direction in the body frame, as the angles of a universal joint tell it: about x, then about y."""
    seen = moment.state.R.T @ moment.state.y
    if not sensor.quantisation:
        return _pointed(seen, sensor, draw)
    roll = ca.atan2(-seen[1], seen[2]) + sensor.noise * draw[0]
    pitch = ca.asin(ca.fmin(ca.fmax(seen[0], -1), 1)) + sensor.noise * draw[1]
    roll, pitch = (sensor.quantisation * ca.floor(angle / sensor.quantisation + 0.5) for angle in (roll, pitch))
    return ca.vertcat(ca.sin(pitch), -ca.cos(pitch) * ca.sin(roll), ca.cos(pitch) * ca.cos(roll))


def _rod_gyro(moment: Moment, sensor: Sensor, draw: Any) -> Any:
    return moment.state.R.T @ cross(moment.state.y, moment.state.y_dot) + sensor.noise * draw


def _pointed(direction: Any, sensor: Sensor, draw: Any) -> Any:
    return unit(direction + sensor.noise * tangent_part(direction, draw))


_READ: dict[str, Callable[[Moment, Sensor, Any], Any]] = {
    "position": _position,
    "attitude": _attitude,
    "rod": _rod,
    "gyro": _gyro,
    "accelerometer": _accelerometer,
    "joints": _joints,
    "rod_gyro": _rod_gyro,
}
