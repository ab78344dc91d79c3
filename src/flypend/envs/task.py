"""Tasks: where worlds begin, what is wanted, what it is worth, and when they end. All are expressions in symbols."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend import errors
from flypend.building import no_numbers
from flypend.envs.draws import Draws
from flypend.errors import InputError
from flypend.geometry import apply, transpose
from flypend.laws.law_error import explain
from flypend.model import State, Vehicle
from flypend.model.mount import least_margin

Goal = Callable[[Any, Any], tuple[Any, Any]]


class Begin(NamedTuple):
    """How a world begins: a state with e₃ up, and numbers (k, 1) that describe its goal."""

    state: State
    goal: Any


class Moment(NamedTuple):
    """A world after an action, as expressions, e₃ up.

    Parameters
    ----------
    time : SX
        Time since the beginning, s.
    state, error : State
        The state, and the same with position and velocity relative to the goal.
    shares : (n, 1)
        Forces of the rotors as shares of the largest.
    change : (m, 1)
        Change of the action; zero in observations.
    end, end_dot : (3, 1)
        Position and velocity of the true rod's far end, m and m/s.
    goal : (k, 1)
        The numbers that describe the goal.
    vehicle : Vehicle
        The nominal vehicle.
    """

    time: Any
    state: State
    error: State
    shares: Any
    change: Any
    end: Any
    end_dot: Any
    goal: Any
    vehicle: Vehicle


def observe_nothing(now: Moment) -> Any:
    """Observe nothing else."""
    return ca.SX(0, 1)


@dataclass(frozen=True)
class Task:
    """A task of an environment. Its environments can be pickled if its functions have names in a module.

    Parameters
    ----------
    name : str
        Its name in the id of the environment.
    begin : callable
        (draws, vehicle) → `Begin`; the vehicle is the plant's true one, but for what `randomise` draws.
    goal : callable
        (t, numbers of the goal) → desired position and velocity of the pivot, (3, 1) each, m and m/s.
    reward : callable
        (`Moment`) → the reward of a step.
    ended : callable
        (`Moment`) → an expression above 0 when the world ends.
    duration : float
        Seconds after which a world is cut off.
    ahead : tuple of float
        Times ahead, s, at which the goal is observed, too.
    shown : callable
        (`Moment`) → what else is observed (j, 1).
    defaults : dict
        Arguments of `flypend.envs.environment` that hold for this task unless others are given.
    mounts : tuple of str
        Mounts on which its worlds can begin.
    """

    name: str
    begin: Callable[[Draws, Vehicle], Begin]
    goal: Goal
    reward: Callable[[Moment], Any]
    ended: Callable[[Moment], Any]
    duration: float
    ahead: tuple[float, ...] = ()
    shown: Callable[[Moment], Any] = observe_nothing
    defaults: Mapping[str, Any] = field(default_factory=dict)
    mounts: tuple[str, ...] = ("gimbal", "hub", "cup")

    def ask(self, name: str, *arguments: Any, rows: int | None = None) -> Any:
        """Return what the function `name` answers on symbols, in columns, of so many `rows` if that is said.

        Raises InputError if it fails, or answers something else.
        """
        try:
            with no_numbers():
                answer = getattr(self, name)(*arguments)
            parts = answer if isinstance(answer, tuple) else (answer,)
            shapes = [ca.SX(part).shape for part in parts if not isinstance(part, State)]
        except Exception as error:
            given = f"one that fails: {explain(error)}"[:200]
            raise InputError(f"task.{name}", "a function of symbols that returns numbers", given) from error
        for shape in shapes:
            if shape[1] != 1 or rows not in (None, shape[0]):
                wanted = "a number: sum what is more" if rows == 1 else f"columns of {rows or 'some'} numbers"
                raise InputError(f"task.{name}", wanted, f"shape {shape}")
        return answer


def near(value: Any, scale: float) -> Any:
    """1/(1 + (|value|/scale)²): 1 at zero, ½ at `scale`."""
    return 1 / (1 + ca.sumsqr(value) / scale**2)


def upright(now: Moment) -> Any:
    """Worth of a step with the rod up at the goal, at most 1.

    ½(1 + y₃) (0.4 + 0.3 near(x, 0.5 m) + 0.1 near(ẋ, 1 m/s) + 0.1 near(ẏ, 3 rad/s) + 0.1 near(ω, 5 rad/s))
    − 0.02 |change of the action|², with near(v, s) = 1/(1 + |v|²/s²) and x, ẋ relative to the goal.
    """
    state = now.error
    kept = 0.4 + 0.3 * near(state.x, 0.5) + 0.1 * near(state.x_dot, 1.0)
    kept += 0.1 * near(state.y_dot, 3.0) + 0.1 * near(state.omega, 5.0)
    return (1 + state.y[2]) / 2 * kept - 0.02 * ca.sumsqr(now.change)


def upright_and_near(now: Moment) -> Any:
    """`upright` times 0.5 + 0.5 near(x, 0.3 m): most for a rod that is up where the goal is.

    `upright` alone pays four fifths of that for hovering amid a circle, and more than for a chase of corners.
    """
    return upright(now) * (0.5 + 0.5 * near(now.error.x, 0.3))


def hover_reference(t: Any, numbers: Any) -> tuple[Any, Any]:
    """Stay at the origin."""
    return ca.SX(3, 1), ca.SX(3, 1)


def beyond(now: Moment, radius: float) -> Any:
    """Whether the pivot is farther than `radius` (m) from the goal."""
    return ca.sumsqr(now.error.x) > radius**2


def fallen_or_beyond(now: Moment, radius: float) -> Any:
    """Whether the rod leans by more than 60°, or the pivot is farther than `radius` (m) from the goal."""
    return ca.logic_or(now.state.y[2] < 0.5, beyond(now, radius))


def _begin_near(draws: Draws, y: Any, x: float, x_dot: float, tilt: float, omega: float, y_dot: float) -> Begin:
    """Begin with the rod at `y`, and each other part of the state no larger than this, uniformly drawn."""
    state = State(
        x=draws.ball(x), x_dot=draws.ball(x_dot), R=draws.level(tilt), omega=draws.ball(omega), y=y,
        y_dot=draws.tangent(y, y_dot),
    )  # fmt: skip
    return Begin(state, ca.SX(0, 1))


def _begin_almost_upright(draws: Draws, vehicle: Vehicle, lean: float = 0.2) -> Begin:
    return _begin_near(draws, draws.cap(lean), x=0.5, x_dot=0.5, tilt=0.2, omega=0.5, y_dot=0.5)


def balance() -> Task:
    """Balance a rod that leans by at most 0.2 rad; the world ends if it leans by 60° or the vehicle is 3 m off."""
    return Task("Balance", _begin_almost_upright, hover_reference, upright, partial(fallen_or_beyond, radius=3.0), 5.0)


def _begin_hanging(draws: Draws, vehicle: Vehicle) -> Begin:
    return _begin_near(draws, -draws.cap(0.2), x=0.2, x_dot=0.2, tilt=0.2, omega=0.5, y_dot=0.5)


def _begin_at_any_angle(draws: Draws, vehicle: Vehicle) -> Begin:
    """Begin in 30 of 100 worlds as `_begin_hanging`, on a hub also where a part is in the way; else at any angle.

    That angle is π u^1.5, u uniform, and the rod at most as fast as a fall from upright. The number of the goal is the
    time, s, by which it must be up. Within 26° of upright it is 0.3, so that a rod that falls is lost at once; else 3,
    twice what a swing-up takes.
    """
    state, hangs = _begin_hanging(draws, vehicle).state, draws.share() < 0.3
    angle, turn = np.pi * draws.share() ** 1.5, draws.between(0.0, 2 * np.pi)
    y = ca.vertcat(ca.sin(angle) * ca.cos(turn), ca.sin(angle) * ca.sin(turn), ca.cos(angle))
    fastest = ca.sqrt(2 * vehicle.g / vehicle.l * (1 - y[2]))
    if vehicle.mount == "hub":
        within, _, _ = least_margin(apply(transpose(state.R), y), 0.0, vehicle)
        hangs = ca.logic_or(hangs, within < 0)
    y_dot, y = ca.if_else(hangs, state.y_dot, fastest * draws.tangent(y, 1.0)), ca.if_else(hangs, state.y, y)
    return Begin(State(**(vars(state) | {"y": y, "y_dot": y_dot})), ca.if_else(y[2] > 0.9, 0.3, 3.0))


def late_or_beyond(now: Moment, radius: float) -> Any:
    """Whether the rod leans by more than 60° when it must be up, or the pivot is beyond `radius` (m) of the goal."""
    return ca.logic_or(ca.logic_and(now.time > now.goal[0], now.state.y[2] < 0.5), beyond(now, radius))


def upright_and_still(now: Moment) -> Any:
    """`upright` times 0.4 + 0.6 near(y − e₃, 0.3) near(ẏ, 3 rad/s) near(x, 1.5 m): most for a rod that stands.

    `upright` alone pays a rod that whirls round and round a third of that, one that leans by 20° nearly all, and 2 m
    from the goal, where a catch ends, hardly more for a step towards it.
    """
    lean = now.state.y - ca.DM([0, 0, 1])
    still = near(lean, 0.3) * near(now.state.y_dot, 3.0) * near(now.error.x, 1.5)
    return upright(now) * (0.4 + 0.6 * still)


def swing_up(*, shaped: bool = False) -> Task:
    """Swing the rod up from hanging almost at rest, and balance it. The world ends if the vehicle is 5 m off.

    A rod does not hang in a cup.

    Parameters
    ----------
    shaped : bool
        Whether worlds begin with the rod at any angle, end if it is not up in time, and reward a rod at rest most.
    """
    begin, reward, ended = (
        (_begin_at_any_angle, upright_and_still, late_or_beyond) if shaped else (_begin_hanging, upright, beyond)
    )
    ended = partial(ended, radius=5.0)
    return Task("SwingUp", begin, hover_reference, reward, ended, 10.0, mounts=("gimbal", "hub"))


@dataclass(frozen=True)
class _Path:
    """A way of the goal: `curve` (phase, size, rate) → position and velocity, from a phase that is drawn."""

    curve: Callable[[Any, float, float], tuple[Any, Any]]
    size: float
    rate: float

    def goal(self, t: Any, phase: Any) -> tuple[Any, Any]:
        return self.curve(self.rate * t + phase[0], self.size, self.rate)

    def begin(self, draws: Draws, vehicle: Vehicle) -> Begin:
        phase = draws.between(0.0, 2 * np.pi)
        state, (x, x_dot) = _begin_almost_upright(draws, vehicle, lean=0.1).state, self.goal(0.0, phase)
        return Begin(State(**(vars(state) | {"x": x + 0.2 * state.x, "x_dot": x_dot})), phase)


def track(shape: str = "circle", size: float = 0.5, turn_rate: float = 1.5) -> Task:
    """Follow a path with the rod up.

    Parameters
    ----------
    shape : "circle", "lemniscate" or "waypoints"
        Path of the goal: around a circle of radius `size`, along a figure eight of half-length `size`, or from corner
        to corner of a square of half-width `size`.
    size, turn_rate : float
        Size, m, and angular rate, rad/s; on a square, four corners make a turn.
    """
    curves = {"circle": _circle, "lemniscate": _eight, "waypoints": _square}
    errors.one_of("shape", shape, curves)
    errors.number("size", size, at_least=0, unit="m")
    errors.number("turn_rate", turn_rate, unit="rad/s")
    path, ended = _Path(curves[shape], size, turn_rate), partial(fallen_or_beyond, radius=3.0)
    return Task("Track", path.begin, path.goal, upright_and_near, ended, 10.0, ahead=(0.1, 0.2, 0.4))


def _circle(phase: Any, size: float, rate: float) -> tuple[Any, Any]:
    c, s = ca.cos(phase), ca.sin(phase)
    return size * ca.vertcat(c, s, 0), size * rate * ca.vertcat(-s, c, 0)


def _eight(phase: Any, size: float, rate: float) -> tuple[Any, Any]:
    c, s = ca.cos(phase), ca.sin(phase)
    return size * ca.vertcat(s, s * c, 0), size * rate * ca.vertcat(c, c * c - s * s, 0)


def _square(phase: Any, size: float, rate: float) -> tuple[Any, Any]:
    c, s = ca.cos(phase), ca.sin(phase)
    corner = ca.vertcat(ca.if_else(c > 0, 1, -1), ca.if_else(s > 0, 1, -1), 0)
    return size * corner, ca.SX(3, 1)


def _begin_in_cup(draws: Draws, vehicle: Vehicle) -> Begin:
    return _begin_near(draws, draws.cap(0.5), x=0.0, x_dot=0.5, tilt=0.1, omega=0.2, y_dot=1.0)


def catch_in_cup() -> Task:
    """Catch a rod that is toppling in a cup, without losing it; for a vehicle with a cup."""
    far, cup = partial(beyond, radius=5.0), "cup"
    return Task("CatchInCup", _begin_in_cup, hover_reference, upright, far, 6.0, defaults={"mount": cup}, mounts=(cup,))
