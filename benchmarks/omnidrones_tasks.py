"""The inverted pendulum tasks of OmniDrones (Xu and others, arXiv 2309.12825), by its repository at 9ce7c20.

An import registers `flypend/InvPendulumHover-v0`, `-Track-v0` and `-FlyThrough-v0` with gymnasium.

A Hummingbird carries a payload on a bar; actions come every 16 ms. With e the payload's distance from its target,
up = y₃, ω_z the vertical component of the angular velocity, v the payload's speed and uᵢ the share of its largest force
that rotor i gives, each step is worth

    hover        up + exp(−1.2 e) + up (1/(1 + ω_z⁴) + exp(−v)) + effort
    track        exp(−1.6 e) + effort
    fly through  (p + p (up + 1/(1 + ω_z⁴) + exp(−v)) + effort) (1 − touched), p = 1/(1 + 1.2 e)

with effort = 0.1 exp(−Σ √uᵢ). A world ends when the vehicle is below 0.2 m, and

    hover        when up < 0.2 or e > 3.3 m
    track        when up < 0.2 or e > 0.8 m
    fly through  when up < 0.1, the payload is above 3 m, the vehicle is 2 m aside, or a bar of the gate is touched

**Departures.** The motion is ours, in 16 steps an action. The lag is one of the forces, theirs one of the throttle.
Rotors begin with the forces that hover takes with the rod, theirs without. Nothing rebounds: a world ends where the
gate is touched, which is their option `reset_on_collision`; like theirs, contact is looked for every 16 ms. The mass of
payload and bar varies as theirs does, the place of its centre does not. Observations are those of `flypend.envs`; the
share of the time that has passed comes once, not four times.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any

import casadi as ca
import gymnasium
import numpy as np

from flypend import errors
from flypend.envs.draws import Draws
from flypend.envs.task import Begin, Moment, Task
from flypend.errors import InputError
from flypend.geometry import E3
from flypend.model import State, Vehicle
from flypend.model.by_name import vehicle as vehicle_named

PERIOD = 0.016  # s
LOWEST = 0.2  # m
HOVERED, CENTRE, BEHIND = np.array([0, 0, 2.5]), np.array([0, 0, 3.0]), np.array([1.5, 0, 2.3])  # targets, m
EIGHT_STEPS = 600  # of the track
STEPS = 500


def hummingbird(bar: float) -> Vehicle:
    """OmniDrones' Hummingbird with a bar of length `bar`, m."""
    vehicle = vehicle_named("hummingbird-omnidrones")
    ratio = bar / vehicle.reach
    return vehicle.replace(
        rod_length=ratio * vehicle.rod_length, rod_end=bar, rod_inertia=ratio**2 * vehicle.rod_inertia
    )


def _defaults(bar: float) -> dict[str, Any]:
    # From 0.2 to 0.3 of the vehicle's mass and a bar of 10 to 40 g: 153 to 255 g.
    return {"vehicle": hummingbird(bar), "rate": 1 / PERIOD, "randomise": {"bob_mass": (0.75, 1.25)}}


def _at_rest(x: Any, R: Any) -> State:
    """At `x`, with attitude `R` and the bar along the thrust axis."""
    return State(x=x, x_dot=ca.SX(3, 1), R=R, omega=ca.SX(3, 1), y=R[:, 2], y_dot=ca.SX(3, 1))


def _tilted(draws: Draws, angle: float) -> Any:
    """A rotation (3, 3) of any heading, with roll and pitch uniform up to `angle` (rad) to either side."""
    roll, pitch, heading = (draws.between(-most, most) for most in (angle, angle, np.pi))
    (a, b, c), (p, q, r) = ([f(v) for v in (roll, pitch, heading)] for f in (ca.cos, ca.sin))
    return ca.vertcat(
        ca.horzcat(c * b, c * q * p - r * a, c * q * a + r * p),
        ca.horzcat(r * b, r * q * p + c * a, r * q * a - c * p),
        ca.horzcat(-q, b * p, b * a),
    )


def _held(t: Any, numbers: Any, target: Any) -> tuple[Any, Any]:
    """The payload at `target`; the first of the goal's numbers is the reach of the bar."""
    return ca.DM(target) - numbers[0] * ca.DM(E3), ca.SX(3, 1)


def _missing(now: Moment, target: Any) -> Any:
    """Distance of the payload from its target, m."""
    return ca.norm_2(ca.DM(target) - now.end)


def _calm(now: Moment) -> Any:
    """1/(1 + ω_z⁴) + exp(−v)."""
    turning = ca.dot(now.state.R[2, :].T, now.state.omega)
    return 1 / (1 + turning**4) + ca.exp(-ca.norm_2(now.end_dot))


def _effort(now: Moment) -> Any:
    return 0.1 * ca.exp(-ca.sum1(ca.sqrt(ca.fmax(now.shares, 0))))


def _any(*conditions: Any) -> Any:
    found = conditions[0]
    for condition in conditions[1:]:
        found = ca.logic_or(found, condition)
    return found


def _passed(now: Moment, steps: int) -> Any:
    return now.time / (steps * PERIOD)


def _begin_hover(draws: Draws, vehicle: Vehicle) -> Begin:
    x = ca.vertcat(draws.between(-1.5, 1.5), draws.between(-1.5, 1.5), draws.between(1.0, 2.0))
    return Begin(_at_rest(x, _tilted(draws, 0.15 * np.pi)), ca.SX(vehicle.reach))


def _hover_reward(now: Moment) -> Any:
    up = now.state.y[2]
    return up + ca.exp(-1.2 * _missing(now, HOVERED)) + up * _calm(now) + _effort(now)


def _hover_ended(now: Moment) -> Any:
    return _any(now.state.x[2] < LOWEST, now.state.y[2] < 0.2, _missing(now, HOVERED) > 3.3)


def inv_pendulum_hover() -> Task:
    """Hold the payload at (0, 0, 2.5) m, on a bar of 1 m."""
    return Task(
        "InvPendulumHover", _begin_hover, partial(_held, target=HOVERED), _hover_reward, _hover_ended, STEPS * PERIOD,
        shown=partial(_passed, steps=STEPS), defaults=_defaults(1.0),
    )  # fmt: skip


def _eight(t: Any, numbers: Any) -> tuple[Any, Any]:
    """Position and velocity of the payload's target on the figure eight that the goal's `numbers` describe."""
    _, height, heading, *size, pace = ca.vertsplit(numbers)
    passed = pace * t
    slow = ca.fabs(passed) / (1 + ca.fabs(passed))  # it sets off from rest
    phase, rate = np.pi / 2 + slow * passed, pace * slow * (2 + ca.fabs(passed)) / (1 + ca.fabs(passed))
    p = ca.SX.sym("p")
    turned = ca.mtimes(_heading(heading), lemniscate(p, height)) * ca.vertcat(*size)
    x, x_dot = (ca.substitute(value, p, phase) for value in (turned, ca.jacobian(turned, p) * rate))
    return ca.DM(CENTRE) + x, x_dot


def _track_goal(t: Any, numbers: Any) -> tuple[Any, Any]:
    x, x_dot = _eight(t, numbers)
    return x - numbers[0] * ca.DM(E3), x_dot


def _begin_track(draws: Draws, vehicle: Vehicle) -> Begin:
    height, heading = draws.between(-0.6, 0.6), draws.between(0.0, 2 * np.pi)
    size = [draws.between(1.8, 3.2), draws.between(1.8, 3.2), draws.between(1.0, 1.5)]
    pace = ca.if_else(draws.share() < 0.5, -1, 1) * draws.between(0.7, 1.0)
    numbers = ca.vertcat(vehicle.reach, height, heading, *size, pace)
    x = ca.DM(CENTRE) + lemniscate(ca.SX(np.pi / 2), height) - vehicle.reach * ca.DM(E3)
    return Begin(_at_rest(x, _tilted(draws, 0.1 * np.pi)), numbers)


def _off_track(now: Moment) -> Any:
    """Distance of the payload from its target on the eight, m."""
    return ca.norm_2(_eight(now.time, now.goal)[0] - now.end)


def _track_reward(now: Moment) -> Any:
    return ca.exp(-1.6 * _off_track(now)) + _effort(now)


def _track_ended(now: Moment) -> Any:
    return _any(now.state.x[2] < LOWEST, now.state.y[2] < 0.2, _off_track(now) > 0.8)


def inv_pendulum_track() -> Task:
    """Lead the payload, on a bar of 1 m, along a figure eight that rises and falls and differs from world to world."""
    return Task(
        "InvPendulumTrack", _begin_track, _track_goal, _track_reward, _track_ended, EIGHT_STEPS * PERIOD,
        ahead=tuple(5 * k * PERIOD for k in range(1, 6)), shown=partial(_passed, steps=EIGHT_STEPS),
        defaults=_defaults(1.0),
    )  # fmt: skip


def lemniscate(phase: Any, height: Any) -> Any:
    """(cos p, sin p cos p, c sin p)/(1 + sin² p) at the phase p, with c the `height`."""
    s, c = ca.sin(phase), ca.cos(phase)
    return ca.vertcat(c, s * c, height * s) / (1 + s**2)


def _heading(angle: Any) -> Any:
    c, s = ca.cos(angle), ca.sin(angle)
    return ca.vertcat(ca.horzcat(c, -s, 0), ca.horzcat(s, c, 0), ca.horzcat(0, 0, 1))


@errors.named_arguments
@dataclass(frozen=True)
class Gate:
    """Two level bars along the second axis of the world, one above the other, above the origin; m.

    Parameters
    ----------
    radius : float
        Of each bar.
    lower : float
        Height of the lower bar.
    spacing : (2,)
        Least and largest height of the upper bar above the lower, drawn when a world begins.
    payload : float
        Radius of the payload.

    Raises
    ------
    InputError
        If a radius or a height is out of range.
    """

    radius: float = 0.04
    lower: float = 1.2
    spacing: tuple[float, float] = (0.9, 1.2)
    payload: float = 0.04

    def __post_init__(self) -> None:
        for name in ("radius", "payload"):
            errors.number(f"gate.{name}", getattr(self, name), at_least=0, unit="m")
        errors.number("gate.lower", self.lower, unit="m")
        least, largest = errors.array("gate.spacing", self.spacing, (2,)).tolist()
        errors.number("gate.spacing", least, at_least=0, unit="m")
        errors.number("gate.spacing", largest, at_least=least, unit="m")

    def bars(self, spacing: Any) -> list[Any]:
        """Return where the bars are, (2, 1) each: along the first axis, and height."""
        return [ca.vertcat(0, self.lower), ca.vertcat(0, self.lower + spacing)]

    def clearance(self, now: Moment, spacing: Any) -> Any:
        """Return the least distance, m, between a bar and rod, payload or vehicle; below 0 they touch.

        The vehicle is a disc about its pivot that reaches to the rims of its rotors, as thick as its hub. Along the
        bars a disc is seen as an ellipse; what is taken is the stadium around it with the same axes, which is the
        ellipse itself for a vehicle that is level or stands on edge.
        """
        pivot, end, z = now.state.x[[0, 2]], now.end[[0, 2]], now.state.R[:, 2]
        body = now.vehicle.body
        span = float(np.linalg.norm(now.vehicle.rotor_positions[:, :2], axis=1).max()) + body.disc_radius
        seen = ca.fabs(z[1])  # how much of the disc's face is seen along a bar
        half = span * ca.sqrt((1 - seen) / (1 + seen)) * ca.vertcat(-z[2], z[0])
        free = [
            ca.fmin(
                ca.fmin(_apart(bar, pivot, end) - body.rod_radius, ca.norm_2(bar - end) - self.payload),
                _apart(bar, pivot - half, pivot + half) - span * seen - body.hub_radius,
            )
            for bar in self.bars(spacing)
        ]
        return ca.fmin(*free) - self.radius


def _apart(point: Any, a: Any, b: Any) -> Any:
    """Distance of a `point` from the segment from `a` to `b`, m."""
    along = b - a
    share = ca.fmin(ca.fmax(ca.dot(point - a, along) / ca.fmax(ca.sumsqr(along), 1e-12), 0), 1)
    return ca.norm_2(point - a - share * along)


@dataclass(frozen=True)
class _FlyThrough:
    """Starts, reward, end and what is shown of a flight through `gate`."""

    gate: Gate

    def begin(self, draws: Draws, vehicle: Vehicle) -> Begin:
        if vehicle.body is None:
            raise InputError("vehicle.body", "the radii of the machine's parts, for a gate", "nothing")
        x = ca.vertcat(draws.between(-2.2, -1.0), 0, draws.between(1.0, 2.0))
        numbers = ca.vertcat(vehicle.reach, draws.between(*self.gate.spacing))
        return Begin(_at_rest(x, _tilted(draws, 0.15 * np.pi)), numbers)

    def touched(self, now: Moment) -> Any:
        return self.gate.clearance(now, now.goal[1]) < 0

    def reward(self, now: Moment) -> Any:
        near = 1 / (1 + 1.2 * _missing(now, BEHIND))
        return ca.if_else(self.touched(now), 0, near * (1 + now.state.y[2] + _calm(now)) + _effort(now))

    def ended(self, now: Moment) -> Any:
        x, up = now.state.x, now.state.y[2]
        return _any(x[2] < LOWEST, ca.fabs(x[1]) > 2.0, up < 0.1, now.end[2] > 3.0, self.touched(now))

    def shown(self, now: Moment) -> Any:
        pivot = now.state.x[[0, 2]]
        return ca.vertcat(*(bar - pivot for bar in self.gate.bars(now.goal[1])), _passed(now, STEPS))


def inv_pendulum_fly_through(gate: Gate | None = None) -> Task:
    """Take the payload, on a bar of 0.85 m, between the bars of a gate and hold it at (1.5, 0, 2.3) m.

    Parameters
    ----------
    gate : Gate, optional
        The gate; default that of OmniDrones.
    """
    opening = Gate() if gate is None else gate
    if not isinstance(opening, Gate):
        raise InputError("gate", "a Gate", repr(gate))
    through = _FlyThrough(opening)
    return Task(
        "InvPendulumFlyThrough", through.begin, partial(_held, target=BEHIND), through.reward, through.ended,
        STEPS * PERIOD, shown=through.shown, defaults=_defaults(0.85),
    )  # fmt: skip


TASKS = {
    "inv_pendulum_hover": inv_pendulum_hover,
    "inv_pendulum_track": inv_pendulum_track,
    "inv_pendulum_fly_through": inv_pendulum_fly_through,
}
for _task in (make() for make in TASKS.values()):
    gymnasium.register(
        id=f"flypend/{_task.name}-v0",
        entry_point="flypend.envs.single:World",
        vector_entry_point="flypend.envs.vector:VectorWorlds",
        kwargs={"task": _task},
    )
