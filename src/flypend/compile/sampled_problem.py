"""The problem that a kernel of sampled flights simulates, as programs and times."""

from __future__ import annotations

from dataclasses import dataclass

from flypend.compile.problem import Touch
from flypend.compile.program import Program
from flypend.compile.routine import Routine
from flypend.model.state import SIZE

GUSTS = 18  # place of the first number for the gusts among the random numbers of a tick


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
    def memory(self) -> int:
        """Length of the board's memory."""
        return self.board.inputs[0]

    @property
    def size(self) -> int:
        """Length of the state."""
        return SIZE

    @property
    def measured(self) -> int:
        """Length of what the board is given: the state, or readings."""
        return self.board.inputs[1] - 1

    @property
    def gains(self) -> int:
        """Number of gains that are inputs of the kernel."""
        return self.board.inputs[3]

    @property
    def command(self) -> int:
        """Length of a command."""
        return len(self.begin.outputs[1])

    @property
    def rotors(self) -> int:
        """Number of rotors."""
        return self.begin.inputs[0]

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

    @property
    def gust(self) -> int:
        """Length of the memory of gusts and knocks."""
        return self.gusts.inputs[0] if self.gusts else 0

    @property
    def drawn(self) -> range:
        """The random numbers of a tick that are used: the first for the measurement, the others for the gusts."""
        measured = self.measure.inputs[1] if self.measure else self.sensing.sense.inputs[3] if self.sensing else 0
        blown = GUSTS + self.gusts.inputs[1] if self.gusts else 0
        return range(0 if measured else GUSTS, max(measured, blown))

    @property
    def depth(self) -> int:
        """Number of commands to buffer: those in transit and the current one."""
        return self.resuming.depth if self.resuming else 1 + max(stretch.age for stretch in self.flown)
