"""The kernel of sampled flights: what `compile/loops/sampled.cpp` leaves open, from a problem."""

from __future__ import annotations

from dataclasses import replace

from flypend.compile.llvm.emit import define_routine
from flypend.compile.llvm.loops import Constants, Definition, LoopModule, once, several
from flypend.compile.llvm.random import PER_TICK, whole_blocks
from flypend.compile.llvm.target import Target
from flypend.compile.problem import GUST_TICK, GUSTS, EquationsProblem, MujocoProblem, SampledProblem
from flypend.compile.program import Program
from flypend.model.state import MAX_STATE, SIZE

INTEGERS = ("runs", "ticks", "sample_count", "row_count", "begun")
ARGUMENTS = (
    "starts", "parameters", "plant", "seeds", "runs", "ticks",
    "sample_ticks", "sample_count", "judged", "rows", "row_count",
    "samples", "reductions", "final", "end", "status", "clearance", "part", "stop",
    "context", "begun", "impulses", "mujoco",
)  # fmt: skip
# Of a flight in pieces: what one call leaves to the next, the ticks that are flown already, and impulses (runs, 6) on
# vehicle and bob, N s, in effect at once. A call flies on to `ticks`; `sample_ticks` are of the piece. And of flights
# through MuJoCo: the addresses of `MujocoMemory` in `compile/loops/mujoco.hpp`. They may be null in other flights.
KINDS = ("max", "mean", "last", "since")  # of reduction; see `compile/loops/recording.hpp`
FILTER_STRIDE = 10  # numbers per rotor among the parameters of MuJoCo's filters


def kernel_module(problem: SampledProblem, width: int, target: Target | None = None) -> LoopModule:
    """Return the module of the functions "kernel", with `ARGUMENTS`, and "context_size" for `problem`.

    "context_size" stores the length of the argument `context`, bytes.
    """
    if isinstance(problem.world, MujocoProblem) and width != 1:
        raise ValueError("MuJoCo requires a kernel with one lane")
    return LoopModule("sampled", (width, "double", target), _programs(problem), _constants(problem))


def _programs(problem: SampledProblem) -> dict[str, Definition]:
    slide, start, world = problem.board.slide(), problem.begin, problem.world
    parts = tuple(replace(program, name=f"board.{program.name}") for program in problem.board.programs)
    board = replace(problem.board, name="board", programs=parts)
    in_one_place: dict[str, Program | None] = {
        "start": replace(start, inputs=(*start.inputs, 0)[:2]),  # without sensors there is no estimate
        "measure": problem.measure,
        "gusts": problem.gusts,
    }
    in_several: dict[str, Program | None] = {"judge": problem.judge, "rate_loop": problem.loop}
    if isinstance(world, MujocoProblem):
        in_several |= {"seen": world.seen, "motors": world.motors, "surroundings": world.surroundings}
    else:
        in_one_place["world"] = world.step
    if problem.resuming is not None:
        in_one_place["strike"] = problem.resuming.strike
    if (touch := problem.touch) is not None:
        in_several |= {"room": touch.room, "touching": touch.touching}
    if (sensing := problem.sensing) is not None:
        in_one_place["sense"] = sensing.sense
        in_several |= {"sense_begin": sensing.begin, "sense_estimate": sensing.estimate}
    return {
        "board": lambda lanes, _: define_routine(lanes, board, slide, inline=True, visible=True),
        **{name: once(program) for name, program in in_one_place.items() if program is not None},
        **{name: several(program) for name, program in in_several.items() if program is not None},
    }


def _constants(problem: SampledProblem) -> Constants:
    begin, board, gusts, judged = problem.begin, problem.board, problem.gusts, problem.reductions
    sensing, pieces, ages = problem.sensing, problem.resuming, [stretch.age for stretch in problem.flown]
    memory, given, _, gains, _ = board.inputs
    _, timings, noise, wind, params = problem.inputs
    stretches = pieces.stretches if pieces else len(ages)
    # The random numbers of a tick that are used: the first for the measurement, the others for the gusts.
    measured = problem.measure.inputs[1] if problem.measure else sensing.sense.inputs[3] if sensing else 0
    blowing = gusts.inputs[1] if gusts else 0
    drawn = max(measured, GUSTS + blowing if gusts else 0)
    numbers: Constants = {
        "STATE": SIZE, "ROTORS": begin.inputs[0], "MEMORY": memory, "SLIDE": board.slide() or memory,
        "MEASURED": given - 1, "COMMAND": len(begin.outputs[1]), "GAINS": gains, "NOISE": noise, "WIND": wind,
        "PARAMS": params, "GUST": gusts.inputs[0] if gusts else 0, "VALUES": len(judged), "PERIOD": problem.period,
        "STRETCHES": stretches, "TIMING": timings // stretches, "DEPTH": pieces.depth if pieces else 1 + max(ages),
        "PIECES": int(pieces is not None), "AGES": ages, "STEPS": [stretch.steps for stretch in problem.flown],
        "RANDOM": int(problem.random), "FIRST_DRAW": 0 if measured else GUSTS, "END_DRAW": drawn,
        "DRAWS": max(PER_TICK, whole_blocks(drawn)), "GUSTS": GUSTS, "GUST_DRAWS": blowing, "GUST_TICK": GUST_TICK,
        "RATES": int(problem.loop is not None), "MEASURES": int(problem.measure is not None),
        "TOUCHES": int(problem.touch is not None), "MOST_STATE": float(MAX_STATE),
        "KINDS": [KINDS.index(kind) for kind in judged],
        "SENSES": int(sensing is not None), "SENSED": sensing.sense.inputs[0] if sensing else 0,
        "START_TICK": sensing.tick if sensing else 0,
        "START_DRAWS": whole_blocks(sensing.estimate.inputs[1]) if sensing else 0,
    }  # fmt: skip
    return numbers | _of_mujoco(problem.world)


def _of_mujoco(world: EquationsProblem | MujocoProblem) -> Constants:
    if isinstance(world, EquationsProblem):
        names = ("MUJOCO", "QPOS", "QVEL", "FILTERED", "DRIVEN", "BLOWN", "FILTER_STRIDE")
        absent: Constants = dict.fromkeys(names, 0)
        return absent | {"MOST_FORCE": 0.0}
    qpos, qvel = world.seen.inputs[:2]
    return {
        "MUJOCO": 1, "QPOS": qpos, "QVEL": qvel, "FILTERED": int(world.filtered), "FILTER_STRIDE": FILTER_STRIDE,
        "DRIVEN": int(world.motors is not None), "BLOWN": int(world.surroundings is not None),
        "MOST_FORCE": float(world.largest),
    }  # fmt: skip
