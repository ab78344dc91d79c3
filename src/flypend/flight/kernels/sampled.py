"""The kernel of sampled flights: the board and the world around it, compiled for many flights at a time."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from itertools import chain
from typing import NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend.board.command import idle_command
from flypend.board.nominal import Nominal
from flypend.board.program import board, initial_memory
from flypend.compile.llvm import jit
from flypend.compile.llvm.loops import LoopModule
from flypend.compile.llvm.sampled import ARGUMENTS, INTEGERS, kernel_module
from flypend.compile.llvm.target import Target
from flypend.compile.numeric import distinct
from flypend.compile.problem import EquationsProblem, MujocoProblem, SampledProblem, Sensing, Stretch
from flypend.compile.program import Program, lower
from flypend.compile.routine import lower_calls
from flypend.errors import array
from flypend.flight.criterion import EXTENTS, REDUCTIONS, Criterion, observe
from flypend.flight.kernels.results import Flown, Kernel, Progress, in_order, in_pieces, inputs_of
from flypend.flight.kernels.stopping import Word
from flypend.flight.sampled import is_random, number_of_ticks
from flypend.flight.touch import touch_of
from flypend.geometry import Numbers
from flypend.model import State, Vehicle
from flypend.model.outline import extent
from flypend.model.state import FLIP_PACKED, MAX_STATE, SIZE, convert_packed
from flypend.plants.actuation import rate_loop
from flypend.plants.defect_program import size_numbers
from flypend.plants.defects import blank
from flypend.plants.equations import rotor_step
from flypend.plants.loop import Loop
from flypend.plants.machine import as_nominal, is_wrong, machine_numbers
from flypend.plants.measurement import gusts, measurement, noise_numbers, wind_numbers
from flypend.plants.motors import motor_timing
from flypend.plants.mujoco import MAX_FORCE, MuJoCoWorld, filter_lag, from_mujoco, substeps
from flypend.plants.mujoco_world import STEP_NUMBERS, motors, step_numbers, surroundings
from flypend.plants.noise import Noise
from flypend.plants.plant import Plant, Wind
from flypend.plants.schedule import segments_within, steps_in
from flypend.plants.sensing import START_TICK, first_estimate, first_memory, sensing, start_draws

WIDTH = 8
JUDGED = REDUCTIONS + EXTENTS
ARGUMENT_KINDS = [ctypes.c_int64 if name in INTEGERS else ctypes.c_void_p for name in ARGUMENTS]
# Runs per piece of work; MuJoCo flies them one by one, some tens of milliseconds each.
PIECE, PIECE_MUJOCO = 4 * WIDTH, 1


class Ticks(NamedTuple):
    """Increasing control ticks in a kernel's format: `judged` (1 or 0), and `rows`, the samples kept before each."""

    ticks: NDArray[np.int64]
    judged: NDArray[np.int64]
    rows: NDArray[np.int64]

    @classmethod
    def of(cls, judge_at: ArrayLike, keep_at: ArrayLike | None) -> Ticks:
        """Merge the ticks at which the criterion is evaluated and those kept; `rows` ends with the total."""
        judge, keep = (
            distinct(np.asarray(() if some is None else some, dtype=np.int64)) for some in (judge_at, keep_at)
        )
        ticks = distinct(np.concatenate([judge, keep]))
        judged = np.diff(np.append(np.searchsorted(judge, ticks), len(judge)))
        return cls(ticks, judged, np.append(np.searchsorted(keep, ticks), len(keep)))


class SampledKernel(Kernel):
    """A compiled sampled flight. The plant's lag, noise, defects and wind are inputs: see `structure`."""

    def through(self, plant: Plant) -> SampledKernel:
        """Reuse the machine code for another `plant`. Raises ValueError if its `structure` differs."""
        other = replace(self.loop, plant=plant)
        if _structure_of(other) != _structure_of(self.loop) or _mujoco_filters(other) != _mujoco_filters(self.loop):
            raise ValueError("a plant of the same structure is needed")
        return replace(self, loop=other)

    def fly(
        self,
        starts: Numbers,
        duration: float,
        *,
        judge_at: ArrayLike,
        keep_at: ArrayLike | None = None,
        first_seed: int = 0,
        parameters: Numbers = None,
        workers: int | None = None,
        progress: Progress = lambda *_: None,
    ) -> Flown:
        """Fly all `starts` (n, 24), in the law's frame, for `duration` seconds.

        Where rotor forces are not the least, they follow the states (n, 24 + rotors), N.

        `parameters`, `workers` and `progress`, here with `(done, runs)`, are those of `IdealKernel.fly`.

        Parameters
        ----------
        judge_at : (j,) of int
            Increasing control ticks at which the criterion is evaluated.
        keep_at : (t,) of int, optional
            Increasing control ticks at which state (in the law's frame) and rotor forces are kept. They do not affect
            the criterion.
        first_seed : int
            Seed of the first run, increasing by 1 per run.
        """
        loop, vehicle = self.loop, self.loop.vehicle
        runs, n = len(starts), len(vehicle.rotor_spins)
        least = np.full((runs, n), vehicle.rotor_limits[0])
        rotors = starts[:, SIZE:] if starts.shape[1] > SIZE else least
        forces = array("rotors", rotors, least.shape)
        packed = np.concatenate([convert_packed(starts[:, :SIZE], loop.law.e3), forces], axis=1)
        seeds = (first_seed + np.arange(runs)).astype(np.int64)
        moments = Ticks.of(judge_at, keep_at)
        count = number_of_ticks(duration, loop.sampled)
        values = inputs_of(loop, parameters, runs)
        samples = None if keep_at is None else (int(moments.rows[-1]), SIZE + n)
        memory = Flown.of_size(runs, SIZE, samples=samples, judged=len(JUDGED), touching=self.loop.touches)
        numbers = plant_numbers(loop)
        piece = PIECE if loop.sampled.engine == "equations" else PIECE_MUJOCO

        def fly(part: slice, out: Flown, stop: Word) -> None:
            if out.samples is not None:
                out.samples[...] = np.nan
            given = {
                "starts": packed[part], "parameters": values[part], "plant": numbers, "seeds": seeds[part],
                "runs": len(out), "ticks": count, "sample_ticks": moments.ticks, "sample_count": len(moments.ticks),
                "judged": moments.judged, "rows": moments.rows, "row_count": int(moments.rows[-1]),
                "samples": out.samples, "reductions": out.reductions, "final": out.final, "end": out.end,
                "status": out.code, "clearance": out.clearance, "part": out.part, "stop": stop,
                "context": None, "begun": 0, "impulses": None, "mujoco": None,
            }  # fmt: skip
            if loop.sampled.engine == "equations":
                self.function(*in_order(ARGUMENTS, given))
            else:
                with MuJoCoWorld.lent(loop) as world:
                    self.function(*in_order(ARGUMENTS, given | {"mujoco": world.addresses(packed[part])}))

        flown = in_pieces(fly, memory, piece, workers, progress)
        if loop.law.e3 == "down":
            flown.final[...] *= FLIP_PACKED
            if flown.samples is not None:
                flown.samples[..., :SIZE] *= FLIP_PACKED
        return flown


def structure(plant: Plant) -> Plant:
    """Return `plant` without its seed and the machine code's inputs: lag, noise, sizes of sensors' defects, and wind.

    It keeps whether there is noise, wind, knocks, or anything random, which defects there are, and whether rotors rise
    as they fall.
    """
    knocks = plant.wind is not None and plant.wind.knocks
    gusty = Wind(gust_on_vehicle=float(is_random(plant.replace(noise=None))), knock_on_vehicle=float(knocks))
    mismatch = {name: value for name, value in plant.mismatch.items() if name != "rotor_lag"}
    return plant.replace(
        lag=None, noise=plant.noise and Noise(), wind=plant.wind and gusty, seed=0, mismatch=mismatch,
        spin_up=1.0 if plant.spin_up == 1.0 else 2.0, sensors=plant.sensors and blank(plant.sensors),
    )  # fmt: skip


def _serves_any_machine(loop: Loop) -> bool:
    """Whether the numbers of the machine are inputs of the machine code of `loop`: where they are not those believed.

    Not in MuJoCo, whose model has them, nor where something touches, which depends on them.
    """
    return loop.sampled.engine == "equations" and not loop.touches and is_wrong(loop.sampled)


def _structure_of(loop: Loop) -> tuple[Plant, bool]:
    """Return the `structure` of the plant of `loop`, and whether it serves any machine."""
    common = _serves_any_machine(loop)
    return structure(as_nominal(loop.sampled) if common else loop.sampled), common


def plant_numbers(loop: Loop) -> Numbers:
    """Return the plant parameters that the machine code inputs, in the order of `SampledProblem.inputs`."""
    plant = loop.sampled
    true = plant.true_vehicle(loop.vehicle)
    period = 1 / plant.rate
    machine = [machine_numbers(loop.vehicle, plant)] if _serves_any_machine(loop) else []
    timings = [[_timing(true, plant, while_ / steps), *machine] for _, while_, steps in _segments(plant)]
    noise = [] if plant.noise is None else [noise_numbers(plant.noise)]
    noise += [] if plant.sensors is None else [size_numbers(plant.sensors, period)]
    wind = [] if plant.wind is None else [wind_numbers(plant.wind, period)]
    return np.concatenate([*chain.from_iterable(timings), *noise, *wind])


def _timing(true: Vehicle, plant: Plant, duration: float) -> Numbers:
    """Return the numbers of a step of `duration` (s) that the world inputs; see `Equations` and `Mujoco`."""
    if plant.engine == "equations":
        return motor_timing(true.rotor_lag, plant, duration)
    steps = substeps(duration, true, plant)
    return np.append(float(steps), step_numbers(true, plant, duration / steps))


def _segments(plant: Plant) -> list[tuple[int, float, int]]:
    """Return the segments of a control period: age of the command, duration (s), steps."""
    segments = segments_within(plant.delay, 1 / plant.rate)
    return [(age, while_, steps_in(while_, plant)) for age, while_ in segments]


def sampled_kernel(loop: Loop, criterion: Criterion) -> SampledKernel:
    """Return the kernel of `loop` for `criterion`, compiled or from the cache.

    Lead, latency and observer of the flight computer may not be among the gains that differ between runs. Raises
    InputError if a gain is unknown, or the law has operations that cannot be compiled.
    """
    compiled, common = _structure_of(loop)
    if loop.sampled.engine == "mujoco":
        # Rotors with a lag, whatever it is, are MuJoCo's filters; those without are not.
        compiled = compiled.replace(lag=float(_is_filtered(loop)))
    made = _structure(replace(loop, plant=compiled), criterion, common)
    return replace(made, loop=loop)


def _is_filtered(loop: Loop) -> bool:
    return filter_lag(loop.sampled.true_vehicle(loop.vehicle)) > 0


def _mujoco_filters(loop: Loop) -> bool:
    """Whether the rotors are filters of MuJoCo, which is part of its model; in our equations the lag is a number."""
    return loop.sampled.engine == "mujoco" and _is_filtered(loop)


@lru_cache(maxsize=64)
def _structure(loop: Loop, criterion: Criterion, common: bool) -> SampledKernel:
    problem = sampled_problem(loop, criterion, any_machine=common)
    width = WIDTH if isinstance(problem.world, EquationsProblem) else 1
    key, module = write_sampled(problem, width)
    return SampledKernel(loop, criterion, jit.build(key, module, "kernel", ARGUMENT_KINDS), key)


def write_sampled(
    problem: SampledProblem, width: int, target: Target | None = None
) -> tuple[str, Callable[[], LoopModule]]:
    """Return the cache key of the kernel of `problem`, `width` flights at a time, and what writes its module."""
    key = f"sampled, {width} lanes, judged to the end, states below {MAX_STATE}: {problem!r}"
    return key, lambda: kernel_module(problem, width, target)


def sampled_problem(
    loop: Loop, criterion: Criterion, nominal: Nominal | None = None, *, any_machine: bool = False
) -> SampledProblem:
    """Return the flights of `loop` and `criterion` as programs.

    `nominal` is as in `flypend.board.program.board`, `any_machine` as in `rotor_step`.
    """
    vehicle, plant = loop.vehicle, loop.sampled
    true = plant.true_vehicle(vehicle)
    rates = plant.interface == "rates"
    world: EquationsProblem | MujocoProblem
    if plant.engine == "equations":
        step = rotor_step(true, plant, windy=plant.wind is not None, any_machine=any_machine, name="world")
        world, timing = EquationsProblem(lower(step)), step.numel_in(4)
    else:
        seen = lower(from_mujoco(len(vehicle.rotor_spins)))
        effects = [None if f is None else lower(f) for f in (motors(true, plant), surroundings(true, plant))]
        world, timing = MujocoProblem(seen, _is_filtered(loop), MAX_FORCE, *effects), 1 + STEP_NUMBERS
    on_board = rate_loop(vehicle, plant.limits, plant.rate_loop_gain, name="loop_of_world")
    return SampledProblem(
        board=lower_calls(board(loop, nominal)),
        begin=_begin(loop),
        world=world,
        loop=lower(on_board) if rates else None,
        measure=lower(measurement()) if plant.noise is not None else None,
        gusts=lower(gusts(knocks=plant.wind.knocks)) if plant.wind is not None else None,
        judge=lower(_judge(loop, criterion)),
        reductions=JUDGED,
        flown=tuple(Stretch(age, steps) for age, _, steps in _segments(plant)),
        timing=timing,
        period=1 / plant.rate,
        random=is_random(plant),
        sensing=_sensing(loop, true) if plant.sensors is not None else None,
        touch=touch_of(true, "up", by_rotors=True, floor=plant.floor),
    )


def _begin(loop: Loop) -> Program:
    """Return (rotors) → (memory of the board, idle command); with sensors, (rotors, estimate)."""
    rotors, estimate = ca.SX.sym("r", len(loop.vehicle.rotor_spins)), ca.SX.sym("s", SIZE)
    inputs = [rotors] if loop.sampled.sensors is None else [rotors, estimate]
    outputs = [ca.densify(initial_memory(loop, *inputs)), ca.densify(ca.SX(idle_command(loop, rotors)))]
    return lower(ca.Function("begin", inputs, outputs))


def _sensing(loop: Loop, true: Vehicle) -> Sensing:
    sensors, period, state = loop.sampled.sensors, 1 / loop.sampled.rate, ca.SX.sym("s", SIZE)
    draws = ca.SX.sym("n", start_draws(sensors))
    memory = ca.densify(first_memory(sensors, period, state, draws))
    return Sensing(
        begin=lower(ca.Function("sensors_begin", [state, draws], [memory])),
        estimate=lower(first_estimate(sensors)),
        sense=lower(sensing(sensors, true, period, sized=True)),
        tick=START_TICK,
    )


def _judge(loop: Loop, criterion: Criterion) -> ca.Function:
    """Return (t, state and rotor forces with e₃ up, gains) → values that `JUDGED` reduces."""
    law = loop.symbolic
    n = len(loop.vehicle.rotor_spins)
    t, packed, p = ca.SX.sym("t"), ca.SX.sym("s", SIZE + n), ca.SX.sym("p", len(loop.parameters))
    own = convert_packed(packed[:SIZE], law.e3)
    low, high = extent(State.symbolic(packed[:SIZE]), loop.vehicle)
    seen = observe(t, State.symbolic(own), packed[SIZE:], loop.vehicle, law.reference, criterion, law.e3)
    return ca.Function("judge", [t, packed, p], [ca.cse(ca.densify(ca.vertcat(seen, high, -low)))])
