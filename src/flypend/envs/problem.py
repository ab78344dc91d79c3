"""An environment as programs: task, vehicle, plant and kind of action make a `WorldsProblem`."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

import casadi as ca
import numpy as np

from flypend import errors
from flypend.compile.problem import WorldsProblem
from flypend.compile.program import lower
from flypend.envs.draws import Draws
from flypend.envs.randomise import Randomisation, Varied
from flypend.envs.sensing import Estimates
from flypend.envs.task import Moment, Task
from flypend.errors import InputError
from flypend.flight.touch import touch_of
from flypend.laws.policy import ATTITUDES, Attitude, moment_action, observe_state, rotor_action, thrust_action, to_body
from flypend.model import State, Vehicle
from flypend.model.state import SIZE
from flypend.plants.actuation import rate_loop, rotor_forces
from flypend.plants.equations import step_state
from flypend.plants.lag import symbolic_timing
from flypend.plants.motors import motion_parts, motor_timing, settle_forces, timing_size
from flypend.plants.plant import LONGEST_DELAY, Sampled
from flypend.plants.sensors import sensors_called

Action = Literal["rotors", "wrench", "rates"]
Observe = Literal["all", "state"]
MOST_RATE = 12.0  # rad/s, of the action "rates"
LONGEST = 1e9  # s, of an episode


@dataclass(frozen=True, eq=False)
class Environment:
    """The description from which worlds are made.

    Parameters
    ----------
    task : Task
        The task: where worlds begin, the goal, the reward and the end.
    vehicle : Vehicle
        The nominal vehicle, with its mount.
    plant : Plant
        The plant; its rate (Hz) is that of the motion's steps, in each of which a command acts.
    rate : float
        Actions per second, Hz; the plant's rate is a multiple of it.
    action : "rotors", "wrench" or "rates"
        What an action commands; each of its numbers is in [−1, 1]. "rotors": the forces of the rotors, from their
        minimum to their maximum. "wrench": thrust, from zero to the maximum, and moments, allocated within the limits.
        "rates": thrust and body rates up to 12 rad/s, tracked by the plant's rate loop before every step.
    attitude : "matrix", "6d" or "body"
        How the attitude is observed. "matrix": all columns of R. "6d": the first two. "body": only the vertical, with
        all vectors in the body frame, so that a policy need not learn that the heading makes no difference.
    observe : "all" or "state"
        What is observed: all that `flypend.envs` lists, or only what comes before the rotor forces. To fly the policy
        as a law, `fp.laws.trained` needs "state".
    randomise : Randomisation
        What differs from world to world.
    sensors : Sensors, str or dict, optional
        The sensors: a suite ("mocap", "onboard"), `fp.Sensors` or a table. The estimator of the flight computer is then
        part of the world. It runs once per action, and observations are its estimate; rewards and ends depend on the
        true state. Default "perfect": the state itself is observed.

    Raises
    ------
    InputError
        If the rates do not match, that of the rate loop included, the duration is shorter than an action, a delay is
        too long, the task does not begin on the vehicle's mount, or the plant has something that worlds do not have:
        noise, sensors of its own, gusts, MuJoCo.
    """

    task: Task
    vehicle: Vehicle
    plant: Sampled
    rate: float = 100.0
    action: Action = "rotors"
    attitude: Attitude = "matrix"
    observe: Observe = "all"
    randomise: Randomisation = field(default_factory=Randomisation)
    sensors: Any = None

    def __post_init__(self) -> None:
        errors.one_of("action", self.action, ("rotors", "wrench", "rates"))
        errors.one_of("attitude", self.attitude, ATTITUDES.values())
        errors.one_of("observe", self.observe, ("all", "state"))
        if self.vehicle.mount not in self.task.mounts:
            wanted = f"{' or '.join(map(repr, self.task.mounts))}, for the task {self.task.name}"
            raise InputError("mount", wanted, repr(self.vehicle.mount))
        self._check_plant()
        errors.number("rate", self.rate, above=0, at_most=self.plant.rate, unit="Hz")
        if abs(self.plant.rate / self.rate - self.steps) > 1e-9:
            raise InputError("rate", f"a divisor of the plant's {self.plant.rate:g} Hz", f"{self.rate:g}")
        errors.number("duration", self.task.duration, at_least=1 / self.rate, at_most=LONGEST, unit="s")
        errors.number("randomise.delay", self.randomise.delay[1], at_most=LONGEST_DELAY - self.plant.delay, unit="s")
        object.__setattr__(self, "sensors", sensors_called(self.sensors, "sensors"))

    def _check_plant(self) -> None:
        plant = self.plant
        if not isinstance(plant, Sampled):
            raise InputError("plant", "an fp.Plant", repr(plant))
        if plant.engine != "equations" or any(part is not None for part in (plant.noise, plant.sensors, plant.wind)):
            wanted = "one by our equations, without noise and wind; sensors are an argument of their own"
            raise InputError("plant", wanted, repr(plant))
        if self.action == "rates" and plant.rate_loop_rate != plant.rate:
            wanted = f"the plant's rate, {plant.rate:g} Hz: the loop runs before every step of the motion"
            raise InputError("plant.rate_loop_rate", wanted, f"{plant.rate_loop_rate:g}")

    @property
    def steps(self) -> int:
        """Steps of the motion for each action."""
        return max(1, round(self.plant.rate / self.rate))

    @property
    def limit(self) -> int:
        """Actions after which a world is cut off."""
        return round(self.task.duration * self.rate)

    @property
    def rotors(self) -> int:
        """Number of rotors."""
        return len(self.vehicle.rotor_spins)

    @property
    def actions(self) -> int:
        """Length of an action."""
        return self.rotors if self.action == "rotors" else 4


def problem(env: Environment) -> WorldsProblem:
    """Return the programs of `env`."""
    parts = Parts(env)
    numbers = ca.SX.sym("p", parts.numbers)
    return WorldsProblem(
        begin=lower(parts.begin()), command=lower(parts.command()),
        loop=lower(parts.loop()) if env.action == "rates" else None,
        step=lower(parts.step()), observe=lower(parts.observe()), judge=lower(parts.judge()),
        queued=parts.queued, steps=env.steps, length=1 / env.plant.rate,
        touch=touch_of(parts.machine(numbers), "up", by_rotors=True, floor=env.plant.floor, numbers=numbers),
        estimating=None if parts.estimates is None else parts.estimates.programs(parts.command(), parts.idle),
    )  # fmt: skip


def _symbols(**sizes: int) -> list[Any]:
    return [ca.SX.sym(name, size) for name, size in sizes.items()]


class Parts:
    """The functions of an environment, and the layout of the memory that they share."""

    def __init__(self, env: Environment) -> None:
        self.env = env
        self.true = env.plant.true_vehicle(env.vehicle)
        n, latest = env.rotors, env.plant.delay + env.randomise.delay[1]
        self.queued = int(np.ceil(latest * env.rate - 1e-9))
        self.timing, self.numbers = timing_size(env.plant), 3 + n if env.randomise.varies else 0
        self.width = 4 if env.action == "rates" else n  # of a command
        self.lengths = [SIZE, n, env.actions, self.queued * self.width, 6, self.timing, self.numbers, 1]
        self.estimates = None if env.sensors is None else Estimates(env.vehicle, self.true, self._computer())

    def _computer(self) -> Sampled:
        """The plant as the flight computer knows it whose commands the actions are."""
        env, plant = self.env, self.env.plant
        return Sampled(
            rate=env.rate, limits=plant.limits, delay=plant.delay, sensors=env.sensors,
            interface="rates" if env.action == "rates" else "wrench", rate_loop_rate=plant.rate,
            rate_loop_gain=plant.rate_loop_gain,
        )  # fmt: skip

    def machine(self, numbers: Any) -> Any:
        """Return the vehicle that flies, whose `numbers` differ from world to world."""
        return Varied(self.true, numbers) if self.numbers else self.true

    def begin(self) -> ca.Function:
        """(uniform numbers) → (memory)."""
        env, draws, n = self.env, Draws(), self.env.rotors
        (low, high), begun = env.vehicle.rotor_limits, env.task.ask("begin", draws, self.true)
        if not (isinstance(begun, tuple) and len(begun) == 2 and isinstance(begun[0], State)):
            raise InputError("task.begin", "a Begin: a State and the numbers of the goal", f"a {type(begun).__name__}")
        state, goal = begun[0], ca.SX(begun[1])
        hover = ca.DM(np.full(n, np.clip(env.vehicle.weight / n, low, high)))
        asked = ca.vertcat(2 * ca.sum1(hover) / (n * high) - 1, ca.DM.zeros(3))  # the action that commands it
        if env.action == "rotors":
            asked = 2 * (hover - low) / (high - low) - 1
        numbers = Varied.drawn(env.vehicle, env.randomise, draws)
        wind = draws.between(*env.randomise.wind) * draws.direction() if env.randomise.wind[1] > 0 else ca.SX(3, 1)
        delay = (env.plant.delay + draws.between(*env.randomise.delay)) * env.plant.rate
        memory = ca.vertcat(
            state.packed(), hover, asked, *[self.idle(hover)] * self.queued, wind, ca.SX(3, 1),
            self._timing(draws), numbers, ca.floor(delay + 0.5), goal,
        )  # fmt: skip
        self.goals = goal.numel()
        return ca.Function("begin", [draws.symbols], [ca.densify(memory)])

    def _timing(self, draws: Draws) -> Any:
        """Timing of the rotors, with a lag drawn in `randomise.lag`."""
        env, h = self.env, 1 / self.env.plant.rate
        if env.randomise.lag == (1.0, 1.0) or self.true.rotor_lag == 0:
            return ca.DM(motor_timing(self.true.rotor_lag, env.plant, h))
        return motor_timing(draws.between(*env.randomise.lag) * self.true.rotor_lag, env.plant, h, symbolic_timing)

    def idle(self, rotors: Any) -> Any:
        """Return the command before the first action, which keeps level `rotors` (n,), N, as they are."""
        return ca.vertcat(ca.sum1(rotors), ca.DM.zeros(3)) if self.env.action == "rates" else rotors

    def loop(self) -> ca.Function:
        """(command, omega, –) → rotor forces: the rate loop, which knows the nominal vehicle."""
        plant = self.env.plant
        return rate_loop(self.env.vehicle, plant.limits, plant.rate_loop_gain, name="rate_loop")

    def command(self) -> ca.Function:
        """(action) → rotor forces (n,), or thrust and body rates (4,) for the rate loop."""
        env, vehicle, a = self.env, self.env.vehicle, ca.SX.sym("a", self.env.actions)
        if env.action == "rotors":
            command = rotor_action(a, vehicle)
        elif env.action == "rates":
            command = ca.vertcat(thrust_action(a[0], vehicle), MOST_RATE * a[1:])
        else:
            thrust, moment = thrust_action(a[0], vehicle), moment_action(a[1:], vehicle)
            command = rotor_forces(thrust, moment, vehicle, env.plant.limits)
        return ca.Function("command", [a], [ca.densify(command)])

    def step(self) -> ca.Function:
        """(state, rotors, command, wind, timing, numbers) → (state, rotors)."""
        env, n = self.env, self.env.rotors
        s, r, u, w, h, p = _symbols(s=SIZE, r=n, u=n, w=6, h=self.timing, p=self.numbers)
        vehicle, plant = self.machine(p), motion_parts(env.plant)
        commanded = p[3:] * u if self.numbers else u
        settled = settle_forces(commanded, vehicle.rotor_limits[1], plant.strength, plant.sag)
        wind = w if env.randomise.wind[1] > 0 else None
        return ca.Function("step", [s, r, u, w, h, p], step_state(s, r, settled, wind, h, vehicle, plant))

    def _moment(self, action: Any = None, *, known: bool = False) -> tuple[Any, Any, Moment, list[Any]]:
        """Symbols of time and memory, what they say after an `action`, if there is one, and the parts of the memory.

        What is `known` of state and rotors is their estimate, if there is one.
        """
        env = self.env
        lengths = [*self.lengths, self.goals]
        estimate = self.estimates.record.length if self.estimates is not None and known else 0
        t, memory = _symbols(t=1, memory=sum(lengths) + estimate)
        parts = ca.vertsplit(memory, [0, *np.cumsum([*lengths, estimate]).tolist()])
        estimated = parts.pop()
        if estimate:
            parts[0], parts[1] = estimated[:SIZE], estimated[SIZE : SIZE + env.rotors]
        state, numbers = State.symbolic(parts[0]), parts[-1]
        x, x_dot = env.task.ask("goal", t, numbers, rows=3)
        error = State(**(vars(state) | {"x": state.x - x, "x_dot": state.x_dot - x_dot}))
        change = ca.SX.zeros(env.actions) if action is None else action - parts[2]
        reach = self.machine(parts[6]).reach
        now = Moment(
            time=t, state=state, error=error, shares=parts[1] / env.vehicle.rotor_limits[1], change=change,
            end=state.x + reach * state.y, end_dot=state.x_dot + reach * state.y_dot, goal=numbers,
            vehicle=env.vehicle,
        )  # fmt: skip
        return t, memory, now, parts

    def observe(self) -> ca.Function:
        """(time, memory) → observation; see `flypend.envs`."""
        env = self.env
        t, memory, now, parts = self._moment(known=True)
        low, high = env.vehicle.rotor_limits
        here = env.task.ask("goal", t, parts[-1], rows=3)[0]
        coming = [env.task.ask("goal", t + ahead, parts[-1], rows=3)[0] - here for ahead in env.task.ahead]
        if env.attitude == "body":
            coming = [to_body(now.error, vector) for vector in coming]
        seen = observe_state(now.error, env.attitude)
        if env.observe == "all":
            rotors = 2 * (parts[1] - low) / (high - low) - 1
            seen = ca.vertcat(seen, rotors, parts[2], *coming, env.task.ask("shown", now))
        return ca.Function("observe", [t, memory], [ca.densify(seen)])

    def judge(self) -> ca.Function:
        """(time, memory, action) → (reward, ended)."""
        action = ca.SX.sym("a", self.env.actions)
        t, memory, now, _ = self._moment(action)
        reward, ended = (self.env.task.ask(name, now, rows=1) for name in ("reward", "ended"))
        return ca.Function("judge", [t, memory, action], [ca.densify(reward), ca.densify(ended)])
