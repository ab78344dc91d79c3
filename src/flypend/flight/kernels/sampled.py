"""The kernel of sampled flights: everything that `flypend.flight.sampled` does, in the package's own equations."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np
from llvmlite import ir

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
from flypend.laws import BoundLaw
from flypend.model import State, Vehicle
from flypend.model.state import FLIP_PACKED, MAX_STATE, SIZE
from flypend.plants.actuation import rate_loop, steps_in
from flypend.plants.equations import rotor_lag, rotor_step, step_timing
from flypend.plants.measurement import gusts, measurement, noise_numbers, wind_numbers
from flypend.plants.plant import Noise, Plant, Wind
from flypend.plants.schedule import Segment, ahead, within_period

WIDTH = 8
PIECE = 4 * WIDTH


@dataclass(frozen=True, eq=False)
class SampledKernel:
    """A compiled sampled flight. Lag, noise and wind of the plant are inputs: see `structure`.

    Parameters
    ----------
    vehicle, law, plant, criterion
        What flies, what steers it, through what, and what counts as a success.
    parameters : tuple of str
        Gains that may differ from run to run.
    function : callable
        The compiled kernel.
    key : str
        What determines the kernel, processor and versions apart.
    """

    vehicle: Vehicle
    law: BoundLaw
    plant: Plant
    criterion: Criterion
    parameters: tuple[str, ...]
    function: Any
    key: str

    def through(self, plant: Plant) -> SampledKernel:
        """The same machine code for another `plant` of the same `structure`. Raises ValueError for one of another."""
        if structure(plant) != structure(self.plant):
            raise ValueError("a plant of the same structure is needed")
        return replace(self, plant=plant)

    def fly(
        self,
        starts: Any,
        duration: float,
        *,
        ticks: Any,
        first_seed: int = 0,
        parameters: Any = None,
        rotors: Any = None,
        keep: bool = False,
        workers: int | None = None,
        progress: Progress = lambda *_: None,
    ) -> Flown:
        """Fly all `starts` (n, 24), in the frame of the law, for `duration` seconds.

        Parameters
        ----------
        starts, duration
            Packed states; how long, s.
        ticks : (t,) of int
            Increasing control ticks at which a run is judged.
        first_seed : int
            Seed of the first run; the next has the next.
        parameters : (n, k), optional
            Values of the gains that vary; default those of the law.
        rotors : (n, rotors), optional
            Forces with which the rotors begin, N; default the least.
        keep : bool
            Whether states and rotor forces at these ticks are kept, too, in the frame of the law.
        workers : int, optional
            Threads; default one per core.
        progress : callable
            Told `(done, runs)`.
        """
        sign = 1.0 if self.law.e3 == "up" else FLIP_PACKED
        packed = np.ascontiguousarray(starts, dtype=float) * sign
        seeds = (first_seed + np.arange(len(packed))).astype(np.int64)
        judged = np.ascontiguousarray(ticks, dtype=np.int64)
        count = number_of_ticks(duration, self.plant)
        values = inputs_of(self.law, self.parameters, parameters, len(packed))
        least = np.full((len(packed), len(self.vehicle.rotor_spins)), self.vehicle.rotor_limits[0])
        packed = np.concatenate([packed, least if rotors is None else array("rotors", rotors, least.shape)], axis=1)

        length = SIZE + len(self.vehicle.rotor_spins)
        memory = Flown.of_size(
            len(packed), SIZE, samples=(len(judged), length) if keep else None, steps=False, judged=True
        )

        numbers = plant_numbers(self.vehicle, self.plant)

        def fly(part: slice, out: Flown) -> None:
            self._call(packed[part], values[part], numbers, seeds[part], count, judged, out)

        flown = in_pieces(fly, memory, PIECE, workers, progress)
        if self.law.e3 == "down":
            flown.final[...] *= FLIP_PACKED
            if keep:
                flown.samples[..., :SIZE] *= FLIP_PACKED
        return flown

    def _call(self, starts: Any, values: Any, numbers: Any, seeds: Any, count: int, ticks: Any, out: Flown) -> None:
        if out.samples is not None:
            out.samples[...] = np.nan
        self.function(
            address(starts), address(values), address(numbers), address(seeds), len(starts), count,
            address(ticks), len(ticks), address(out.samples), address(out.reductions), address(out.final),
            address(out.end), address(out.code),
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


def sampled_kernel(
    vehicle: Vehicle,
    law: BoundLaw,
    plant: Plant,
    criterion: Criterion | None = None,
    parameters: tuple[str, ...] = (),
) -> SampledKernel:
    """The kernel of flights of `vehicle` under a bound `law` through `plant`, compiled or from the cache.

    Parameters
    ----------
    vehicle, law, plant, criterion
        As in `SampledKernel`; the engine of the plant must be "equations".
    parameters : tuple of str
        Gains that may differ from run to run; lead, latency and observer of the flight computer may not.

    Raises
    ------
    InputError
        For an unknown gain, and for a law with operations that cannot be compiled.
    """
    return _structured(vehicle, law, structure(plant), criterion or Criterion(), parameters).through(plant)


@lru_cache(maxsize=64)
def _structured(
    vehicle: Vehicle, law: BoundLaw, plant: Plant, criterion: Criterion, parameters: tuple[str, ...]
) -> SampledKernel:
    problem = sampled_problem(vehicle, law, plant, criterion, parameters)

    def module() -> ir.Module:
        lanes = Lanes(ir.Module("flypend"), WIDTH)
        write_kernel(lanes, problem)
        return lanes.module

    kinds = [ctypes.c_int64 if name in INTEGERS else ctypes.c_void_p for name in ARGUMENTS]
    key = f"sampled, {WIDTH} lanes, states below {MAX_STATE}: {problem!r}"
    return SampledKernel(vehicle, law, plant, criterion, parameters, jit.build(key, module, "kernel", kinds), key)


def sampled_problem(
    vehicle: Vehicle, law: BoundLaw, plant: Plant, criterion: Criterion, parameters: Sequence[str] = ()
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


def _judge(vehicle: Vehicle, law: BoundLaw, criterion: Criterion, parameters: int) -> ca.Function:
    """(t, state and rotor forces with e₃ up, parameters) → what `criterion.REDUCTIONS` reduce."""
    n = len(vehicle.rotor_spins)
    t, packed, p = ca.SX.sym("t"), ca.SX.sym("s", SIZE + n), ca.SX.sym("p", parameters)
    own = packed[:SIZE] * (1.0 if law.e3 == "up" else FLIP_PACKED)
    seen = observed(t, State.symbolic(own), packed[SIZE:], vehicle, law.reference, criterion, law.e3)
    return ca.Function("judge", [t, packed, p], [ca.densify(seen)])
