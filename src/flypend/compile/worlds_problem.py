"""The problem that a kernel of stepped worlds simulates, as programs: what an environment for learning is made of."""

from __future__ import annotations

from dataclasses import dataclass

from flypend.compile.problem import Touch
from flypend.compile.program import Program


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

    @property
    def size(self) -> int:
        """Length of the memory."""
        return len(self.first.outputs[0])


@dataclass(frozen=True)
class WorldsProblem:
    """Worlds that are advanced by actions, and begin again when they end.

    The memory of a world is what `begin` returns: state (24), rotor forces (n), last action (m), earlier commands
    (`queued` times n), wind (6), timing of the rotors, numbers of the vehicle, the commands' delay in steps, goal; and
    then that of `estimating`, if any.

    Parameters
    ----------
    begin : Program
        (uniform random numbers) → (memory).
    command : Program
        (state with rotor forces, action in [−1, 1], numbers) → rotor forces (n), evaluated once an action, or before
        every step if `inner`.
    inner : bool
        See `command`.
    step : Program
        (state, rotors, command, wind, timing, numbers) → (state, rotors).
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
    inner: bool
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
            "state": state, "rotors": rotors, "action": self.command.inputs[1], "queue": self.queued * rotors,
            "wind": wind, "timing": timing, "numbers": numbers, "delay": 1,
        }  # fmt: skip
        found, place = {}, 0
        for name, length in lengths.items():
            found[name] = place
            place += length
        estimate = len(self.begin.outputs[0])
        own = 0 if self.estimating is None else self.estimating.size
        return found | {"goal": place, "estimate": estimate, "end": estimate + own}
