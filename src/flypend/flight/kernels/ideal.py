"""The kernel of the ideal plant: continuous time, the wrench acts as commanded."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import casadi as ca
import numpy as np
from llvmlite import ir
from numpy.typing import ArrayLike, NDArray

from flypend.compile.llvm import jit
from flypend.compile.llvm.runge_kutta import ARGUMENTS, INTEGERS, REALS, write_kernel
from flypend.compile.llvm.vector import Lanes
from flypend.compile.methods import NAMES as METHODS
from flypend.compile.methods import method as method_named
from flypend.compile.problem import Problem
from flypend.compile.program import Program, lower
from flypend.errors import one_of
from flypend.flight.criterion import REDUCTIONS, Criterion, observed
from flypend.flight.kernels.flown import Flown, Progress, address, from_queue, inputs_of
from flypend.flight.request import Flight
from flypend.laws import BoundLaw
from flypend.laws.closed_loop import SymbolicLoop, symbolic_loop
from flypend.model import State
from flypend.model.state import MAX_STATE, SIZE, project_symbolic
from flypend.plants.loop import Loop

# Bytes of a vector. A long program is a long chain of dependent operations: two registers side by side keep the
# processor busy while it waits. A short one is better off with all registers for one.
SHORT, LONG = 64, 128
OPERATIONS_OF_LONG = 800
BYTES = {"double": 8, "float": 4}
MAX_STEPS = 1_000_000


class Moments(NamedTuple):
    """Times of a run as a kernel takes them: s, increasing, infinity at the end; which are judged, and which kept.

    `judged` is 1 or 0 for each. `rows` is the number of samples kept before each, and in all.
    """

    times: NDArray[np.float64]
    judged: NDArray[np.float64]
    rows: NDArray[np.int64]

    @classmethod
    def of(cls, judge_at: ArrayLike = (), keep_at: ArrayLike | None = None) -> Moments:
        """The moments of a run that is judged at some times, and whose states are kept at others."""
        judge, keep = (np.asarray(() if some is None else some, dtype=float) for some in (judge_at, keep_at))
        times = np.append(np.union1d(judge, keep), np.inf)
        before = np.append(0, np.cumsum(np.isin(times[:-1], keep)))
        return cls(times, np.isin(times, judge).astype(float), before.astype(np.int64))

    @property
    def kept(self) -> int:
        """Number of samples that are kept."""
        return int(self.rows[-1])


@dataclass(frozen=True, eq=False)
class IdealKernel:
    """A compiled closed loop.

    Parameters
    ----------
    loop : Loop
        What flies, what steers it, and which gains may differ from run to run.
    criterion : Criterion
        What counts as a success.
    function : callable
        The compiled kernel.
    key : str
        What determines the kernel, processor and versions apart.
    """

    loop: Loop
    criterion: Criterion
    function: jit.Native
    key: str

    def fly(
        self,
        starts: Any,
        duration: float,
        *,
        rtol: float,
        atol: float | None = None,
        parameters: NDArray[np.float64] | None = None,
        judge_at: ArrayLike = (),
        keep_at: ArrayLike | None = None,
        judge: bool = True,
        max_steps: int | None = None,
        workers: int | None = None,
        progress: Progress = lambda *_: None,
    ) -> Flown:
        """Fly all `starts` (n, 24), in the frame of the law, for `duration` seconds.

        Parameters
        ----------
        starts, duration
            Packed states; how long, s.
        rtol, atol : float
            Tolerances of a step; atol defaults to rtol.
        parameters : (n, k), optional
            Values of the gains that vary; default those of the law.
        judge_at : (j,)
            Increasing times, s, at which a run is judged.
        keep_at : (t,), optional
            Increasing times, s, at which its state is kept. They change nothing of how it is judged.
        judge : bool
            Whether the runs are judged; without it `Flown.reductions` is None.
        max_steps : int
            A run that needs more is given up as diverged; default a million.
        workers : int, optional
            Threads; default one per core.
        progress : callable
            Told `(taken, runs)`.
        """
        starts = np.ascontiguousarray(starts, dtype=float)
        values = inputs_of(self.loop, parameters, len(starts))
        moments = Moments.of(judge_at, keep_at)
        setting = (duration, rtol, rtol if atol is None else atol, max_steps or MAX_STEPS)

        samples = None if keep_at is None else (moments.kept, SIZE)
        out = Flown.of_size(len(starts), SIZE, samples=samples, steps=True, judged=judge)

        def fly(queue: Any) -> None:
            call(self.function, starts, values, setting, moments, out, queue=queue)

        from_queue(fly, len(starts), workers, progress)
        return out


def lane_count(problem: Problem, precision: str) -> int:
    """Lanes of the kernel of `problem`: the width at which it is fastest."""
    size = LONG if sum(problem.rates.counts().values()) > OPERATIONS_OF_LONG else SHORT
    return size // BYTES[precision]


def setting_of(flight: Flight) -> tuple[float, float, float, int]:
    """Duration (s), rtol, atol and the most steps of the runs of `flight`."""
    exact = flight.tolerances
    return flight.duration, exact.rtol, exact.absolute, exact.max_steps or MAX_STEPS


def integrate(
    function: jit.Native,
    start: NDArray[np.float64],
    values: NDArray[np.float64],
    setting: tuple[float, float, float, int],
    times: ArrayLike,
    knots: NDArray[np.float64] | None = None,
) -> Flown:
    """One run by a compiled ideal kernel from `start` (24,), its states at increasing `times` kept.

    `values` (1, k) are those of its parameters, `setting` as in `call`. `knots` receives the number of accepted steps
    and four numbers for each: its time, and the drift from the manifold.
    """
    moments = Moments.of(keep_at=times)
    out = Flown.of_size(1, SIZE, samples=(moments.kept, SIZE), steps=True, judged=False)
    call(function, start[None], values, setting, moments, out, knots)
    return out


def call(
    function: jit.Native,
    starts: NDArray[np.float64],
    values: NDArray[np.float64],
    setting: tuple[float, float, float, int],
    moments: Moments,
    out: Flown,
    knots: NDArray[np.float64] | None = None,
    queue: NDArray[np.int64] | None = None,
) -> None:
    """Call a compiled ideal `function` for contiguous `starts` (n, 24 or more) and parameter `values` (n, k).

    `setting` is duration (s), rtol, atol and the most steps; `out` is written, and `knots` as in `integrate`. Calls in
    several threads share one `queue` (1,), the number of the next run, and with it the runs.
    """
    queue = np.zeros(1, dtype=np.int64) if queue is None else queue
    function(
        address(starts), address(values), address(queue), len(starts), *setting,
        address(moments.times), len(moments.times) - 1, address(moments.judged), address(moments.rows), moments.kept,
        address(out.samples), address(out.reductions), address(out.final), address(out.end), address(out.code),
        address(out.steps), address(knots),
    )  # fmt: skip


@lru_cache(maxsize=64)
def ideal_kernel(
    loop: Loop, criterion: Criterion | None = None, *, method: str = "dop853", precision: str = "double"
) -> IdealKernel:
    """The kernel of a `loop` in continuous time, compiled or from the cache; its plant does not matter.

    Parameters
    ----------
    loop : Loop
        What flies and what steers it. Its parameters are inputs, its other gains constants of the machine code.
    criterion : Criterion, optional
        What counts as a success (default: inverted).
    method : "dop853" or "dp5"
        Order 8 for tight tolerances, order 5 for 1e-6 and looser.
    precision : "double" or "float"
        Of all arithmetic.

    Raises
    ------
    InputError
        For an unknown method, precision or gain, and for a law with operations that cannot be compiled.
    """
    criterion = criterion or Criterion()
    one_of("precision", precision, BYTES)
    problem = ideal_problem(loop, criterion)
    one_of("method", method, METHODS)
    key = f"ideal {method} {precision} {problem!r}"
    return IdealKernel(loop, criterion, compiled(key, problem, method, precision), key)


def compiled(key: str, problem: Problem, method: str, precision: str = "double") -> jit.Native:
    """The kernel of `problem` by `method` in `precision`, compiled or from the cache under `key`."""
    width = lane_count(problem, precision)

    def module() -> ir.Module:
        lanes = Lanes(ir.Module("flypend"), width, precision)
        write_kernel(lanes, problem, method_named(method))
        return lanes.module

    kinds = [
        ctypes.c_int64 if name in INTEGERS else ctypes.c_double if name in REALS else ctypes.c_void_p
        for name in ARGUMENTS
    ]
    return jit.build(f"{key} {width} lanes, states below {MAX_STATE}", module, "kernel", kinds)


def ideal_problem(loop: Loop, criterion: Criterion) -> Problem:
    """The closed `loop` as programs, judged by `criterion`, with its parameters as inputs."""
    vehicle, law = loop.vehicle, loop.symbolic
    symbols = symbolic_loop(vehicle, law, loop.parameters)
    inputs = [symbols.t, symbols.s, symbols.p]
    state = State.symbolic(symbols.s)
    wrench = ca.vertcat(symbols.wrench.thrust, symbols.wrench.moment)
    rotors = ca.mtimes(vehicle.unmixing(law.e3), wrench)
    seen = observed(symbols.t, state, rotors, vehicle, law.reference, criterion, law.e3)
    return Problem(
        rates=lower(ca.Function("rates", inputs, [symbols.rates])),
        project=lower(_projection()),
        margin=_margin(symbols, law, inputs),
        observe=lower(ca.Function("observe", inputs, [ca.densify(seen)])),
        reductions=REDUCTIONS,
    )


def _margin(symbols: SymbolicLoop, law: BoundLaw, inputs: list[Any]) -> Program | None:
    if law.guard is None:
        return None
    signal = symbols.signals[one_of("law.guard", law.guard.signal, symbols.signals)]
    return lower(ca.Function("margin", inputs, [signal - law.guard.threshold]))


def _projection() -> ca.Function:
    """A packed state → that state on the manifold, and the drift (3,) before."""
    packed = ca.SX.sym("s", 24)
    s = State.symbolic(packed)
    defect = s.R.T @ s.R - ca.SX.eye(3)
    drift = ca.vertcat(ca.fabs(ca.norm_2(s.y) - 1), ca.fabs(ca.dot(s.y, s.y_dot)), ca.norm_fro(defect))
    return ca.Function("project", [packed], [project_symbolic(packed), drift])
