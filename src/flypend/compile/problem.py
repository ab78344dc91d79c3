"""What kernels simulate, as scalar programs: the ideal plant, sampled flights, and stepped worlds to learn in."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate

from flypend.compile.program import Program, drop_dead
from flypend.compile.routine import Routine

# Operations with kinks or jumps.
PIECEWISE = frozenset(
    ("fabs", "sign", "fmin", "fmax", "floor", "ceil", "fmod", "select", "not", "and", "or", "lt", "le", "eq", "ne")
)

# Longest interval in which the rod moves along a cubic, s.
LONGEST = 2e-3
GUSTS = 18  # place of the first number for the gusts among the random numbers of a tick
GUST_TICK = 2**40 + 1  # the tick whose numbers are the gusts before the first; that before it is for sensors


@dataclass(frozen=True)
class Touch:
    """What the rod can touch; see `flypend.flight.touch`.

    States are followed by forces: of the rotors in a sampled flight, the thrust in the ideal plant.

    Parameters
    ----------
    room : Program
        (state before, state after, seconds in between) → a lower bound of the distances in between. The state before
        is also followed by the numbers of the vehicle, if they are inputs, as in `WorldsProblem`.
    touching : Program
        (before, after, seconds) → (least distance, share of the interval until the rod touches, part); the share is > 1
        if it does not.
    """

    room: Program
    touching: Program


@dataclass(frozen=True)
class Judging:
    """What is reduced over a run: gauges that must end within bounds, and forces.

    Parameters
    ----------
    gauges : Program
        (t, s, ṡ) → k gauges, their first and second time derivatives, and the tolerances they are about, each (k,). A
        gauge is a squared distance, less a squared tolerance or not; the last one is the square of which the largest
        root is reported.
    bounds : tuple of float
        Largest value within tolerance of each gauge.
    forces : Program
        Output 1 of the rates, here called wrench → mean square and maximum of the forces (2,).
    """

    gauges: Program
    bounds: tuple[float, ...]
    forces: Program

    @property
    def values(self) -> Program:
        """(t, s, ṡ) → the gauges alone, which do not depend on ṡ."""
        return drop_dead(Program("values", self.gauges.inputs, self.gauges.operations, self.gauges.outputs[:1]))

    @property
    def smooth(self) -> bool:
        """Whether the gauges are without cases, so that between steps they follow from their derivatives."""
        return not PIECEWISE & self.gauges.counts().keys()


@dataclass(frozen=True)
class Problem:
    """An initial value problem as scalar programs of time t, state s and parameters p.

    Parameters
    ----------
    rates : Program
        (t, s, p) → state rates, and if runs are judged the wrench.
    project : Program
        s → s projected onto the manifold, and the drift (3,) before projection.
    judging : Judging, optional
        What is reduced over a run.
    margin : Program, optional
        (t, s, p) → a scalar that is positive where the law is defined.
    touch : Touch, optional
        What ends a flight as collided.
    """

    rates: Program
    project: Program
    judging: Judging | None = None
    margin: Program | None = None
    touch: Touch | None = None

    @property
    def size(self) -> int:
        """Length of the state."""
        return self.rates.inputs[1]


@dataclass(frozen=True)
class Stretch:
    """An interval under the command computed `age` control ticks ago, in `steps` equal steps."""

    age: int
    steps: int


@dataclass(frozen=True)
class EquationsProblem:
    """A world simulated by the built-in equations of motion.

    Parameters
    ----------
    step : Program
        One step (state, rotors, command, wind, timing) → (state, rotors).
    """

    step: Program


@dataclass(frozen=True)
class MujocoProblem:
    """A world simulated by MuJoCo.

    Parameters
    ----------
    seen : Program
        (qpos, qvel, rotors) → (state, rotors).
    filtered : bool
        Whether the rotor lag is a MuJoCo actuator filter, with the rotor forces as its activations.
    largest : float
        Forces beyond this, N, are invalid and end the run.
    motors : Program, optional
        (commanded forces, rotors, numbers) → controls and time constants of the filters, run before every step; by
        default controls are the command, and the time constants those of the models.
    surroundings : Program, optional
        (qpos, qvel, qacc, rotors, controls, wind, numbers) → force and torque on the vehicle, force on the rod, torque
        of the joint; run before every step. By default only wind acts.
    """

    seen: Program
    filtered: bool
    largest: float
    motors: Program | None = None
    surroundings: Program | None = None


@dataclass(frozen=True)
class Sensing:
    """Sensors that deliver readings, for a flight computer that estimates the state.

    Parameters
    ----------
    begin : Program
        (state, draws) → memory of the sensors at the start; the draws are those of `tick`.
    estimate : Program
        (state, draws) → the estimate with which the flight computer begins; the same draws.
    sense : Program
        (memory, t, state, draws, sizes of defects) → (memory, readings).
    tick : int
        The tick that stands for the start among those of random numbers.
    """

    begin: Program
    estimate: Program
    sense: Program
    tick: int


@dataclass(frozen=True)
class Resuming:
    """What a flight in pieces takes at the beginning of each piece, and an ordinary one has compiled in.

    Parameters
    ----------
    strike : Program
        (state, impulses (6,) on vehicle and bob, N s) → state.
    stretches : int
        Number of intervals in a control tick; their ages and steps are inputs.
    depth : int
        Number of commands to buffer.
    """

    strike: Program
    stretches: int
    depth: int


@dataclass(frozen=True)
class SampledProblem:
    """A sampled flight as programs.

    Parameters
    ----------
    board : Routine
        The flight computer: (memory, measurement, reference, gains, params) → (memory, command); see `flypend.board`.
    begin : Program
        (rotors) → (initial memory of the board, command in effect before the first); its inputs are (rotors, estimate)
        with `sensing`.
    world : EquationsProblem or MujocoProblem
        Simulates vehicle and pendulum.
    loop : Program, optional
        Rate loop (command, omega, –) → rotor forces, run before every step of the world. Without it, a command is the
        rotor forces.
    measure : Program, optional
        (state, draws, noise parameters) → measured state.
    sensing : Sensing, optional
        In place of it: sensors that remember.
    gusts : Program, optional
        (memory of gusts and knocks, draws, wind parameters) → (memory, forces).
    judge : Program
        (t, state with rotor forces, gains) → the values to reduce over the sample ticks.
    reductions : tuple of str
        One kind of reduction per value; see `Reductions`.
    flown : tuple of Stretch
        The intervals of one control tick, in order.
    timing : int
        Number of timing inputs per stretch. Timings, noise and wind are inputs of the kernel, not compiled in.
    period : float
        Control period, s.
    random : bool
        Whether random numbers are drawn.
    touch : Touch, optional
        What ends a flight as collided.
    resuming : Resuming, optional
        For flights in pieces, through equations; in place of `flown`.
    """

    board: Routine
    begin: Program
    world: EquationsProblem | MujocoProblem
    loop: Program | None
    measure: Program | None
    gusts: Program | None
    judge: Program
    reductions: tuple[str, ...]
    flown: tuple[Stretch, ...]
    timing: int
    period: float
    random: bool
    touch: Touch | None = None
    sensing: Sensing | None = None
    resuming: Resuming | None = None

    @property
    def inputs(self) -> tuple[int, int, int, int, int]:
        """Lengths of the inputs shared by all flights of a call.

        They are ages and steps of the intervals of a flight in pieces, timings, noise parameters or sizes of the
        sensors' defects, wind parameters, and parameters of the board.
        """
        noise, wind = (program.inputs[2] if program else 0 for program in (self.measure, self.gusts))
        noise += self.sensing.sense.inputs[4] if self.sensing else 0
        stretches = self.resuming.stretches if self.resuming else len(self.flown)
        schedule = 2 * stretches if self.resuming else 0
        return schedule, self.timing * stretches, noise, wind, self.board.inputs[4]


@dataclass(frozen=True)
class Estimating:
    """An estimator that observes a world through sensors, once an action.

    Its memory begins with the estimate of the state and of the rotor forces.

    Parameters
    ----------
    first : Program
        (state with rotor forces, draws of the tick `tick`) → memory before the first readings.
    carry : Program
        (memory, action) → memory at the end of the action.
    sense : Program
        (memory, time, state, draws) → memory with the readings of that time.
    tick : int
        The tick that stands for the start among those of random numbers.
    """

    first: Program
    carry: Program
    sense: Program
    tick: int


@dataclass(frozen=True)
class WorldsProblem:
    """Worlds that are advanced by actions, and begin again when they end.

    The memory of a world is what `begin` returns: state (24), rotor forces (n), last action (m), earlier commands
    (`queued` times c), wind (6), timing of the rotors, numbers of the vehicle, the commands' delay in steps, goal; and
    then that of `estimating`, if any.

    Parameters
    ----------
    begin : Program
        (uniform random numbers) → (memory).
    command : Program
        (action in [−1, 1]) → command (c), evaluated once an action.
    loop : Program, optional
        Rate loop (command that acts, omega, –) → rotor forces, run before every step. Without it, a command is the
        rotor forces.
    step : Program
        (state, rotors, commanded forces, wind, timing, numbers) → (state, rotors).
    observe : Program
        (time, memory) → observation; the time is that since the beginning, s.
    judge : Program
        (time, memory, action) → (reward, whether the world ends: above 0). The memory still has the action before.
    queued : int
        Earlier commands that may still act.
    steps : int
        Steps of the motion for each action.
    length : float
        Length of a step, s.
    touch : Touch, optional
        What the rod can touch.
    estimating : Estimating, optional
        Sensors and estimator.
    """

    begin: Program
    command: Program
    loop: Program | None
    step: Program
    observe: Program
    judge: Program
    queued: int
    steps: int
    length: float
    touch: Touch | None = None
    estimating: Estimating | None = None

    @property
    def places(self) -> dict[str, int]:
        """Where the parts of the memory begin, and its length as "end"."""
        state, rotors, _, wind, timing, numbers = self.step.inputs
        lengths = {
            "state": state, "rotors": rotors, "action": self.command.inputs[0],
            "queue": self.queued * len(self.command.outputs[0]), "wind": wind, "timing": timing, "numbers": numbers,
            "delay": 1,
        }  # fmt: skip
        found = dict(zip((*lengths, "goal"), accumulate(lengths.values(), initial=0), strict=True))
        estimate = len(self.begin.outputs[0])
        own = 0 if self.estimating is None else len(self.estimating.first.outputs[0])
        return found | {"estimate": estimate, "end": estimate + own}
