"""The kernel of environments: what `compile/loops/worlds.cpp` leaves open, from a problem."""

from __future__ import annotations

from flypend.compile.llvm.loops import Constants, Definition, LoopModule, isolate
from flypend.compile.llvm.random import whole_blocks
from flypend.compile.problem import WorldsProblem
from flypend.model.state import SIZE

ARGUMENTS = (
    "memories", "seeds", "actions", "observations", "rewards", "terminated", "truncated", "last", "ends",
    "causes", "first", "count", "limit", "fresh",
)  # fmt: skip
INTEGERS = ("first", "count", "limit", "fresh")
# A state is lost once its length is beyond it; no observation is larger.
BOUND = 1000.0
# Causes of the end of a world that has touched nothing; those that have are the part, as in `flight.touch.touchable`.
BY_TASK, LOST = -1.0, -2.0


def kernel_module(problem: WorldsProblem, width: int) -> LoopModule:
    """Return the module of the function "kernel" for `problem`; its arguments are `ARGUMENTS`.

    Arrays are float32 but for:

    memories
        (groups, 2 + memory, width) of float64: actions since the beginning, number of the episode, memory.
    seeds
        (groups, width) of int64.
    ends, causes
        (worlds, 24 + n) and (worlds,) of float64: last states and rotor forces, and causes, of those that have ended.
    terminated, truncated
        (worlds,) of bytes, 0 or 1.
    """
    return LoopModule("worlds", (width, "double", None), _programs(problem), _constants(problem))


def _programs(problem: WorldsProblem) -> dict[str, Definition]:
    programs = {name: isolate(getattr(problem, name)) for name in ("begin", "step", "observe", "judge")}
    programs["command"] = isolate(problem.command, exact=True)  # what is asked for, to the bit
    if problem.loop is not None:
        programs["rate_loop"] = isolate(problem.loop)
    if (touch := problem.touch) is not None:
        programs |= {"room": isolate(touch.room), "touching": isolate(touch.touching)}
    if (own := problem.estimating) is not None:
        programs |= {"first_estimate": isolate(own.first), "carry": isolate(own.carry), "sense": isolate(own.sense)}
    return programs


def _constants(problem: WorldsProblem) -> Constants:
    own, places = problem.estimating, problem.places
    parts = ("action", "queue", "wind", "timing", "numbers", "delay", "estimate")
    numbers: Constants = {
        "STATE": SIZE, "ROTORS": problem.step.inputs[1], "ACTIONS": problem.command.inputs[0],
        "COMMAND": len(problem.command.outputs[0]), "OBSERVED": len(problem.observe.outputs[0]),
        "UNIFORMS": whole_blocks(problem.begin.inputs[0]), "MEMORY": places["end"], "STEPS": problem.steps,
        "QUEUED": problem.queued, "LENGTH": problem.length, "RATES": int(problem.loop is not None),
        "NUMBERS": problem.step.inputs[5], "TOUCHES": int(problem.touch is not None), "SENSES": int(own is not None),
        "START_TICK": own.tick if own else 0, "START_DRAWS": whole_blocks(own.first.inputs[1]) if own else 0,
        "DRAWS": whole_blocks(own.sense.inputs[3]) if own else 0, "BOUND": BOUND,
        "BY_TASK": BY_TASK, "LOST": LOST,
    }  # fmt: skip
    return numbers | {f"AT_{part.upper()}": places[part] for part in parts}
