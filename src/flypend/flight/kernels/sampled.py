"""The kernel of sampled flights: everything that `flypend.flight.sampled` does, in the package's own equations."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple

import casadi as ca
import numpy as np
from llvmlite import ir
from numpy.typing import ArrayLike, NDArray

from flypend.board.computer import TWIN_STEP, idle_command, law_command, usable_lead
from flypend.board.observer import observer_functions
from flypend.compile.llvm import jit
from flypend.compile.llvm.sampled import ARGUMENTS, INTEGERS, write_kernel
from flypend.compile.llvm.vector import Lanes
from flypend.compile.program import Program, lower
from flypend.compile.sampled_problem import SampledProblem, Stretch
from flypend.errors import array
from flypend.flight.criterion import REDUCTIONS, Criterion, observed
from flypend.flight.kernels.flown import Flown, Progress, address, in_pieces, inputs_of
from flypend.flight.sampled import is_random, number_of_ticks
from flypend.laws.law import Law
from flypend.model import State, Vehicle
from flypend.model.state import FLIP_PACKED, MAX_STATE, SIZE
from flypend.plants.actuation import rate_loop, steps_in
from flypend.plants.equations import rotor_lag, rotor_step, step_timing
from flypend.plants.loop import Loop
from flypend.plants.measurement import gusts, measurement, noise_numbers, wind_numbers
from flypend.plants.plant import Noise, Plant, Sampled, Wind, sampled_plant
from flypend.plants.schedule import Segment, ahead, within_period

WIDTH = 8
PIECE = 4 * WIDTH


class Ticks(NamedTuple):
    """Control ticks as the kernel takes them, increasing: which are judged (1 or 0), and samples kept before each."""

    ticks: NDArray[np.int64]
    judged: NDArray[np.int64]
    rows: NDArray[np.int64]

    @classmethod
    def of(cls, judge_at: ArrayLike, keep_at: ArrayLike | None) -> Ticks:
        """The ticks of a run that is judged at some, and whose states are kept at others; `rows` ends with all."""
        judge, keep = (np.asarray(() if some is None else some, dtype=np.int64) for some in (judge_at, keep_at))
        ticks = np.union1d(judge, keep)
        rows = np.append(0, np.cumsum(np.isin(ticks, keep)))
        return cls(ticks, np.isin(ticks, judge).astype(np.int64), rows.astype(np.int64))


@dataclass(frozen=True, eq=False)
class SampledKernel:
    """A compiled sampled flight. Lag, noise and wind of the plant are inputs: see `structure`.

    Parameters
    ----------
    loop : Loop
        What flies, what steers it, through what, and which gains may differ from run to run.
    criterion : Criterion
        What counts as a success.
    function : callable
        The compiled kernel.
    key : str
        What determines the kernel, processor and versions apart.
    """

    loop: Loop
    criterion: Criterion
    function: Any
    key: str

    @property
    def plant(self) -> Sampled:
        """The plant of its loop."""
        return sampled_plant(self.loop.plant)

    def through(self, plant: Plant) -> SampledKernel:
        """The same machine code for another `plant` of the same `structure`. Raises ValueError for one of another."""
        if structure(plant) != structure(self.plant):
            raise ValueError("a plant of the same structure is needed")
        return replace(self, loop=replace(self.loop, plant=plant))

    def fly(
        self,
        starts: Any,
        duration: float,
        *,
        judge_at: ArrayLike,
        keep_at: ArrayLike | None = None,
        first_seed: int = 0,
        parameters: Any = None,
        rotors: Any = None,
        workers: int | None = None,
        progress: Progress = lambda *_: None,
    ) -> Flown:
        """Fly all `starts` (n, 24), in the frame of the law, for `duration` seconds.

        Parameters
        ----------
        starts, duration
            Packed states; how long, s.
        judge_at : (j,) of int
            Increasing control ticks at which a run is judged.
        keep_at : (t,) of int, optional
            Increasing control ticks at which state and rotor forces are kept, in the frame of the law. They change
            nothing of how a run is judged.
        first_seed : int
            Seed of the first run; the next has the next.
        parameters : (n, k), optional
            Values of the gains that vary; default those of the law.
        rotors : (n, rotors), optional
            Forces with which the rotors begin, N; default the least.
        workers : int, optional
            Threads; default one per core.
        progress : callable
            Told `(done, runs)`.
        """
        vehicle, law = self.loop.vehicle, self.loop.law
        sign = 1.0 if law.e3 == "up" else FLIP_PACKED
        packed = np.ascontiguousarray(starts, dtype=float) * sign
        seeds = (first_seed + np.arange(len(packed))).astype(np.int64)
        moments = Ticks.of(judge_at, keep_at)
        count = number_of_ticks(duration, self.plant)
        values = inputs_of(self.loop, parameters, len(packed))
        least = np.full((len(packed), len(vehicle.rotor_spins)), vehicle.rotor_limits[0])
        packed = np.concatenate([packed, least if rotors is None else array("rotors", rotors, least.shape)], axis=1)

        samples = None if keep_at is None else (int(moments.rows[-1]), SIZE + len(vehicle.rotor_spins))
        memory = Flown.of_size(len(packed), SIZE, samples=samples, steps=False, judged=True)

        numbers = plant_numbers(vehicle, self.plant)

        def fly(part: slice, out: Flown) -> None:
            self._call(packed[part], values[part], numbers, seeds[part], count, moments, out)

        flown = in_pieces(fly, memory, PIECE, workers, progress)
        if law.e3 == "down":
            flown.final[...] *= FLIP_PACKED
            if flown.samples is not None:
                flown.samples[..., :SIZE] *= FLIP_PACKED
        return flown

    def _call(self, starts: Any, values: Any, numbers: Any, seeds: Any, count: int, ticks: Ticks, out: Flown) -> None:
        if out.samples is not None:
            out.samples[...] = np.nan
        self.function(
            address(starts), address(values), address(numbers), address(seeds), len(starts), count,
            address(ticks.ticks), len(ticks.ticks), address(ticks.judged), address(ticks.rows), int(ticks.rows[-1]),
            address(out.samples), address(out.reductions), address(out.final), address(out.end), address(out.code),
        )  # fmt: skip


def structure(plant: Plant) -> Plant:
    """`plant` without the numbers that the machine code takes as inputs: lag, noise and wind, and without its seed.

    Whether there is noise, wind, and anything to be drawn remains.
    """
    gusty = Wind(gust_on_vehicle=float(is_random(plant.replace(noise=None))))
    return plant.replace(
        lag=None, noise=plant.noise and Noise(), wind=plant.wind and gusty, seed=0, mismatch=_without_lag(plant)
    )


def _without_lag(plant: Plant) -> dict[str, float]:
    return {name: value for name, value in plant.mismatch.items() if name != "rotor_lag"}


def plant_numbers(vehicle: Vehicle, plant: Plant) -> Any:
    """The numbers of `plant` that the machine code takes, as `SampledProblem.inputs` counts them."""
    period, lag = 1 / plant.rate, plant.true_vehicle(vehicle).rotor_lag
    timings = [step_timing(lag, while_ / steps) for _, while_, steps in _flown(plant)]
    noise = [] if plant.noise is None else [noise_numbers(plant.noise)]
    wind = [] if plant.wind is None else [wind_numbers(plant.wind, period)]
    return np.concatenate([*timings, *noise, *wind])


def _flown(plant: Plant) -> list[tuple[int, float, int]]:
    """What the world goes through in a control period: age of the command, seconds, steps."""
    segments = within_period(plant.delay, 1 / plant.rate)
    return [(age, while_, steps_in(while_, plant)) for age, while_ in segments]


def sampled_kernel(loop: Loop, criterion: Criterion | None = None) -> SampledKernel:
    """The kernel of sampled flights of `loop`, compiled or from the cache.

    Parameters
    ----------
    loop : Loop
        As in `SampledKernel`; the engine of its plant must be "equations". Lead, latency and observer of the flight
        computer are no parameters.
    criterion : Criterion, optional
        What counts as a success (default: inverted).

    Raises
    ------
    InputError
        For an unknown gain, and for a law with operations that cannot be compiled.
    """
    plant = sampled_plant(loop.plant)
    return _structured(replace(loop, plant=structure(plant)), criterion or Criterion()).through(plant)


@lru_cache(maxsize=64)
def _structured(loop: Loop, criterion: Criterion) -> SampledKernel:
    problem = sampled_problem(loop.vehicle, loop.law, sampled_plant(loop.plant), criterion, loop.parameters)

    def module() -> ir.Module:
        lanes = Lanes(ir.Module("flypend"), WIDTH)
        write_kernel(lanes, problem)
        return lanes.module

    kinds = [ctypes.c_int64 if name in INTEGERS else ctypes.c_void_p for name in ARGUMENTS]
    key = f"sampled, {WIDTH} lanes, states below {MAX_STATE}: {problem!r}"
    return SampledKernel(loop, criterion, jit.build(key, module, "kernel", kinds), key)


def sampled_problem(
    vehicle: Vehicle, law: Law, plant: Plant, criterion: Criterion, parameters: Sequence[str] = ()
) -> SampledProblem:
    """A flight of `vehicle` under `law` through `plant` as programs, judged by `criterion`."""
    believed, true = vehicle, plant.true_vehicle(vehicle)
    period, latency = 1 / plant.rate, law.computer.latency
    setting = (believed, plant.limits, plant.interface, plant.rate_loop_gain, usable_lead(law, believed, plant))
    watched = law.computer.observer > 0
    observer = [lower(f) for f in observer_functions(believed, law.computer)] if watched else [None, None]

    def imagined(segments: Sequence[Segment]) -> tuple[Stretch, ...]:
        made = []
        for age, duration in segments:
            steps = steps_in(duration, plant, TWIN_STEP)
            made.append(Stretch(age, steps, tuple(step_timing(believed.rotor_lag, duration / steps).tolist())))
        return tuple(made)

    rates = plant.interface == "rates"
    return SampledProblem(
        command=lower(law_command(law, *setting, parameters)),
        world=_named(rotor_step(true, plant.pivot_offset), "world"),
        twin=_named(rotor_step(believed), "twin"),
        lag=None if rates else lower(rotor_lag(believed)),
        loop=_named(_loop(believed, plant), "loop") if rates else None,
        measure=lower(measurement()) if plant.noise is not None else None,
        gusts=lower(gusts()) if plant.wind is not None else None,
        observe_first=observer[0],
        observe=observer[1],
        judge=lower(_judge(vehicle, law, criterion, len(parameters))),
        reductions=REDUCTIONS,
        ahead=imagined(ahead(latency, period)),
        within=imagined(within_period(latency, period)),
        flown=tuple(Stretch(age, steps) for age, _, steps in _flown(plant)),
        period=period,
        latency=latency,
        idle=tuple(idle_command(believed, plant).tolist()),
        random=is_random(plant),
    )


def _named(function: ca.Function, name: str) -> Program:
    program = lower(function)
    return Program(name, program.inputs, program.operations, program.outputs)


def _loop(vehicle: Vehicle, plant: Plant) -> ca.Function:
    return rate_loop(vehicle, plant.limits, plant.rate_loop_gain)


def _judge(vehicle: Vehicle, law: Law, criterion: Criterion, parameters: int) -> ca.Function:
    """(t, state and rotor forces with e₃ up, parameters) → what `criterion.REDUCTIONS` reduce."""
    n = len(vehicle.rotor_spins)
    t, packed, p = ca.SX.sym("t"), ca.SX.sym("s", SIZE + n), ca.SX.sym("p", parameters)
    own = packed[:SIZE] * (1.0 if law.e3 == "up" else FLIP_PACKED)
    seen = observed(t, State.symbolic(own), packed[SIZE:], vehicle, law.reference, criterion, law.e3)
    return ca.Function("judge", [t, packed, p], [ca.densify(seen)])
