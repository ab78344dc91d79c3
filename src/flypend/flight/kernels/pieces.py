"""Flights in pieces: a kernel that flies some control ticks, returns, and goes on from where it stopped.

Between two pieces anything may change that is no structure: gains, rotor lag and limits, delay, noise, sizes of the
sensors' adjustable defects, wind, where the law believes its origin, and velocities by an impulse. Board, plant, noise
and commands under way keep their memory, so that a flight in pieces equals one that is not interrupted, bit by bit. The
same writer makes machine code and the WebAssembly of the pages (`flypend.flight.kernels.web`).
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.board.nominal import Nominal
from flypend.building import built
from flypend.compile.llvm import jit
from flypend.compile.llvm.runge_kutta import COMPLETED
from flypend.compile.llvm.sampled import ARGUMENTS
from flypend.compile.llvm.target import native
from flypend.compile.numeric import allocate_aligned, as_numpy
from flypend.compile.problem import Resuming, SampledProblem
from flypend.compile.program import lower
from flypend.errors import InputError
from flypend.flight.criterion import Criterion
from flypend.flight.kernels.launch import outcome_of
from flypend.flight.kernels.results import in_order, inputs_of
from flypend.flight.kernels.sampled import ARGUMENT_KINDS, JUDGED, sampled_problem, structure, write_sampled
from flypend.flight.outcome import Outcome
from flypend.model import State
from flypend.model.state import SIZE, convert_packed
from flypend.plants.equations import struck
from flypend.plants.knobs import KNOBS, LONGEST_DELAY, LONGEST_SHIFT, STRETCHES, depth, knob_values, turn_knobs
from flypend.plants.loop import Loop
from flypend.plants.measurement import measurement
from flypend.plants.noise import Noise
from flypend.plants.plant import Sampled, Wind

# What makes the structure of a plant random, whatever its numbers.
_GUSTY = Wind(gust_on_vehicle=1.0)


@built(maxsize=4)  # a page asks twice, for machine code and for what goes with it
def pieces_problem(loop: Loop, criterion: Criterion) -> SampledProblem:
    """Return the flights of `loop` in pieces as programs, one at a time.

    Raises InputError for a law that is not compiled, or a plant that is not simulated by the built-in equations.
    """
    made = replace(loop, plant=pieces_structure(loop.sampled))
    problem = sampled_problem(made, criterion, Nominal.limited(loop.vehicle))
    strike = lower(struck(made.sampled.true_vehicle(loop.vehicle)))
    seen = None if problem.measure is None else lower(measurement(moved=True))
    return replace(problem, measure=seen, resuming=Resuming(strike, STRETCHES, depth(made.sampled)), flown=())


def pieces_structure(plant: Sampled) -> Sampled:
    """Return `plant` without the numbers that flights in pieces take as inputs: equal ones share machine code.

    Its delays are the longest that they take; an estimator goes on to assume the delay of `plant`. Raises InputError
    for a plant that is not simulated by the built-in equations.
    """
    if plant.engine != "equations":
        raise InputError("plant.engine", "equations, for a flight in pieces", plant.engine)
    sensors, noise = plant.sensors, plant.noise
    if sensors is None:
        noise = noise or Noise()
    else:
        sensors = sensors.replace(command_delay=plant.assumed_delay)
        if {"untold_latency", "latency_jitter"} & set(sensors.adjustable):
            longest = max(sensors.untold_latency, LONGEST_SHIFT - sensors.latency_jitter)
            sensors = sensors.replace(untold_latency=longest)
    whole = plant.replace(sensors=sensors, noise=noise, wind=plant.wind or _GUSTY)
    return structure(whole).replace(delay=max(plant.delay, LONGEST_DELAY))


@dataclass(frozen=True, eq=False)
class PiecesKernel:
    """Compiled flights of `loop` in pieces: `function`, `room` (bytes of what one piece leaves to the next)."""

    loop: Loop
    function: Any
    room: int

    def begin(
        self, start: State, *, seed: int | None = None, gains: Mapping[str, float] | None = None
    ) -> PiecewiseFlight:
        """Begin a flight from `start`, in the law's frame, with the random numbers of `seed`.

        The default is the seed of the plant; that of a `Flight` is no part of its `loop`. The rotors give their least
        force. `gains` are values of gains that are inputs, default those of the law.
        """
        return PiecewiseFlight(self, start, self.loop.sampled.seed if seed is None else seed, gains or {})


def pieces_kernel(loop: Loop, criterion: Criterion) -> PiecesKernel:
    """Return the kernel of flights of `loop` in pieces, compiled or from the cache. Raises as `pieces_problem`."""
    function, room = _compile(replace(loop, plant=pieces_structure(loop.sampled)), criterion)
    return PiecesKernel(loop, function, room)


@built(maxsize=16)
def _compile(loop: Loop, criterion: Criterion) -> tuple[Any, int]:
    problem = pieces_problem(loop, criterion)
    code, room = jit.build_object(*write_sampled(problem, 1), native()), np.zeros(1, dtype=np.int64)
    jit.Native(code, "context_size", (ctypes.c_void_p,))(room.ctypes.data)
    return jit.Native(code, "kernel", tuple(ARGUMENT_KINDS)), int(room[0])


class PiecewiseFlight:
    """A flight that is flown piece by piece, by machine code; see `PiecesKernel.begin`."""

    def __init__(self, kernel: PiecesKernel, start: State, seed: int, gains: Mapping[str, float]) -> None:
        loop = kernel.loop
        self._kernel, self._loop, self.ticks = kernel, loop, 0
        self._knobs, self._turn = knob_values(loop.vehicle, loop.sampled), as_numpy(turn_knobs(loop.sampled))
        rotors = np.full(len(loop.vehicle.rotor_spins), loop.vehicle.rotor_limits[0])
        begin = np.append(convert_packed(start.packed(), loop.law.e3), rotors)
        self._given: dict[str, Any] = {
            "starts": begin[None], "parameters": inputs_of(loop, None, 1).copy(), "seeds": np.array([seed]), "runs": 1,
            "reductions": np.zeros((1, len(JUDGED))), "final": np.zeros((1, SIZE)), "end": np.zeros(1),
            "status": np.zeros(1, dtype=np.int64), "clearance": np.zeros(1), "part": np.zeros(1, dtype=np.int64),
            "stop": np.zeros(1, dtype=np.int64), "context": allocate_aligned((kernel.room // 8,)),
            "mujoco": None,
        }  # fmt: skip
        self._plant: NDArray[np.float64] = self._turn(np.concatenate(list(self._knobs.values())))
        self.tune(gains)

    def tune(self, gains: Mapping[str, float]) -> None:
        """Change gains that are inputs. Raises InputError for another."""
        names = self._loop.parameters
        errors.only_known("gains", gains, names)
        for name, value in gains.items():
            self._given["parameters"][0, names.index(name)] = value

    def turn(self, **knobs: Sequence[float]) -> None:
        """Change `KNOBS` of the plant. Raises InputError for another, or one of another length."""
        errors.only_known("knobs", knobs, KNOBS)
        for name, values in knobs.items():
            self._knobs[name] = [float(value) for value in errors.array(name, values, (KNOBS[name],))]
        self._plant = self._turn(np.concatenate(list(self._knobs.values())))

    def advance(self, ticks: int, impulses: Sequence[float] = (0.0,) * 6) -> NDArray[np.float64]:
        """Fly on for `ticks` control ticks; first, `impulses` (6,) strike vehicle and bob, N s, e₃ up.

        Returns states and rotor forces (n, 24 + k), e₃ up, at the ticks: n = `ticks`, and one more at the beginning of
        the flight. They are NaN after its end.
        """
        first = 0 if self.ticks == 0 else self.ticks + 1
        last = self.ticks + ticks
        kept = np.arange(first, last + 1)
        samples = np.full((1, len(kept), self._given["starts"].shape[1]), np.nan)
        given = self._given | {
            "ticks": last, "begun": self.ticks, "plant": self._plant, "sample_ticks": kept, "sample_count": len(kept),
            "judged": np.ones_like(kept), "rows": np.arange(len(kept) + 1), "row_count": len(kept), "samples": samples,
            "impulses": errors.array("impulses", impulses, (6,))[None].copy(),
        }  # fmt: skip
        self._kernel.function(*in_order(ARGUMENTS, given))
        self.ticks = last
        flown: NDArray[np.float64] = samples[0]
        flown[kept / self._loop.sampled.rate > float(self._given["end"][0]) + 1e-9] = np.nan  # there it has ended
        return flown

    @property
    def outcome(self) -> Outcome:
        """How and when the flight has ended; completed at its last tick while it goes on."""
        return outcome_of(self._loop, *(self._given[name] for name in ("status", "end", "part")))

    @property
    def flying(self) -> bool:
        """Whether the flight goes on."""
        return bool(self._given["status"][0] == COMPLETED)
