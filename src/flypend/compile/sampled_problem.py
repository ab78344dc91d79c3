"""What a kernel of sampled flights flies, as programs and times."""

from __future__ import annotations

from dataclasses import dataclass

from flypend.compile.program import Program


@dataclass(frozen=True)
class Stretch:
    """A while under the command computed `age` ticks ago, in `steps` equal steps.

    `timing` is what a step must know of its length and of the lag, in numbers; none where they are an input.
    """

    age: int
    steps: int
    timing: tuple[float, ...] = ()


@dataclass(frozen=True)
class SampledProblem:
    """What a kernel flies, as programs.

    Parameters
    ----------
    command : Program
        (t, state, rotors, forces, parameters) → command.
    world, twin : Program
        One step (state, rotors, command, wind, timing) → (state, rotors) of what flies, and of what the law believes.
    lag : Program, optional
        (rotors, command, timing) → rotors of what the law believes in, alone; there is one if there is no `loop`.
    loop : Program, optional
        (command, omega) → rotor forces, before every step of either; without it a command is the rotor forces.
    measure : Program, optional
        (state, draws, noise) → state as measured.
    gusts : Program, optional
        (gust, draws, numbers of the wind) → (gust, wind).
    observe_first, observe : Program, optional
        Those of the observer of external forces.
    judge : Program
        (t, state with rotor forces, parameters) → the values that `reductions` reduce at the sample ticks.
    reductions : tuple of str
        One kind per value: see `Reductions`.
    ahead, within, flown : tuple of Stretch
        What the prediction, the model of the rotors and the world go through in a tick. How the world steps through
        each of its own is an input, as are the noise and the wind.
    period, latency : float
        Control period, and the delay that the law plans for, s.
    idle : tuple of float
        The command before the first.
    random : bool
        Whether numbers are drawn.
    """

    command: Program
    world: Program
    twin: Program
    lag: Program | None
    loop: Program | None
    measure: Program | None
    gusts: Program | None
    observe_first: Program | None
    observe: Program | None
    judge: Program
    reductions: tuple[str, ...]
    ahead: tuple[Stretch, ...]
    within: tuple[Stretch, ...]
    flown: tuple[Stretch, ...]
    period: float
    latency: float
    idle: tuple[float, ...]
    random: bool

    @property
    def size(self) -> int:
        """Length of the state."""
        return self.command.inputs[1]

    @property
    def rotors(self) -> int:
        """Number of rotors."""
        return self.command.inputs[2]

    @property
    def parameters(self) -> int:
        """Number of parameters."""
        return self.command.inputs[4]

    @property
    def inputs(self) -> tuple[int, int, int]:
        """Lengths of the inputs that all flights of a call share: timings of the world, noise and wind."""
        noise, wind = (program.inputs[2] if program else 0 for program in (self.measure, self.gusts))
        return self.world.inputs[4] * len(self.flown), noise, wind

    @property
    def depth(self) -> int:
        """Number of commands that must be remembered."""
        return 1 + max(stretch.age for stretch in (*self.ahead, *self.within, *self.flown))
