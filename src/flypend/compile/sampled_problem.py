"""What a kernel of sampled flights flies, as programs and times."""

from __future__ import annotations

from dataclasses import dataclass

from flypend.compile.program import Program
from flypend.compile.routine import Routine


@dataclass(frozen=True)
class Stretch:
    """A while under the command computed `age` ticks ago, in `steps` equal steps."""

    age: int
    steps: int


@dataclass(frozen=True)
class EquationsProblem:
    """A world that is a program of ours.

    Parameters
    ----------
    step : Program
        One step (state, rotors, command, wind, timing, –) → (state, rotors).
    """

    step: Program


@dataclass(frozen=True)
class MujocoProblem:
    """A world that MuJoCo moves.

    Parameters
    ----------
    seen : Program
        (qpos, qvel, rotors) → (state, rotors).
    filtered : bool
        Whether the rotors are MuJoCo's own filters, and their forces its activations.
    largest : float
        Forces beyond this, N, are none.
    """

    seen: Program
    filtered: bool
    largest: float


@dataclass(frozen=True)
class SampledProblem:
    """What a kernel flies, as programs.

    Parameters
    ----------
    board : Routine
        The flight computer: (memory, measurement, reference, gains, params) → (memory, command); see `flypend.board`.
    begin : Program
        (rotors) → (memory of the board, command before the first).
    world : EquationsProblem or MujocoProblem
        What moves.
    loop : Program, optional
        (command, omega, –) → rotor forces, before every step of the world; without it a command is the rotor forces.
    measure : Program, optional
        (state, draws, noise) → state as measured.
    gusts : Program, optional
        (gust, draws, numbers of the wind) → (gust, wind).
    judge : Program
        (t, state with rotor forces, gains) → the values that `reductions` reduce at the sample ticks.
    reductions : tuple of str
        One kind per value: see `Reductions`.
    flown : tuple of Stretch
        What the world goes through in a tick.
    timing : int
        Numbers that a stretch takes as input. How the world steps is an input, as are the noise and the wind.
    period : float
        Control period, s.
    random : bool
        Whether numbers are drawn.
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

    @property
    def memory(self) -> int:
        """Length of the board's memory."""
        return self.board.inputs[0]

    @property
    def size(self) -> int:
        """Length of the state."""
        return self.board.inputs[1] - 1

    @property
    def gains(self) -> int:
        """Number of gains that are inputs."""
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
    def inputs(self) -> tuple[int, int, int]:
        """Lengths of the inputs that all flights of a call share: timings of the world, noise and wind."""
        noise, wind = (program.inputs[2] if program else 0 for program in (self.measure, self.gusts))
        return self.timing * len(self.flown), noise, wind

    @property
    def depth(self) -> int:
        """Number of commands that are on their way to the world."""
        return 1 + max(stretch.age for stretch in self.flown)
