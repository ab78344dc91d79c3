"""The kernel of the ideal plant: continuous time; the wrench acts as commanded, or after the rotors' lag."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import lru_cache
from typing import Any, NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend.compile.llvm import jit
from flypend.compile.llvm.loops import LoopModule
from flypend.compile.llvm.runge_kutta import ARGUMENTS, INTEGERS, REALS, kernel_module
from flypend.compile.llvm.target import Target
from flypend.compile.methods import NAMES as METHODS
from flypend.compile.methods import method as method_named
from flypend.compile.numeric import distinct
from flypend.compile.problem import Judging, Problem
from flypend.compile.program import Program, lower
from flypend.errors import one_of
from flypend.flight.criterion import REDUCTIONS, Criterion, gauge, gauge_bounds
from flypend.flight.kernels.results import Flown, Kernel, Progress, from_queue, in_order, inputs_of
from flypend.flight.kernels.stopping import Word
from flypend.flight.request import Tolerances
from flypend.flight.touch import touch_of
from flypend.geometry import Numbers, Vector, hat
from flypend.laws import BoundLaw
from flypend.laws.closed_loop import SymbolicLoop, symbolic_loop
from flypend.model import State, Vehicle, lie_derivative
from flypend.model.dynamics import Rates
from flypend.model.state import MAX_STATE, SIZE, project_symbolic
from flypend.plants.loop import Loop

# Bytes of a SIMD vector. A long program is a long chain of dependent operations: two registers side by side hide its
# latency. A short program runs faster with one register per vector.
SHORT, LONG = 64, 128
OPERATIONS_OF_LONG = 800
BYTES = {"double": 8, "float": 4}
ARGUMENT_KINDS = [
    ctypes.c_int64 if name in INTEGERS else ctypes.c_double if name in REALS else ctypes.c_void_p for name in ARGUMENTS
]
# Share by which single precision may move the place of a time in a table: two roundings, and a margin.
ROUNDING = 5e-7


class Moments(NamedTuple):
    """Times of a run in a kernel's format, each list increasing and ending with infinity.

    States are kept at `kept`, s; the criterion is evaluated at `judged`, s. Entry b of `bins` is at most the number of
    judged times up to b / `rate`, s, as `compile/loops/grid.hpp` requires.
    """

    kept: NDArray[np.float64]
    judged: NDArray[np.float64]
    bins: NDArray[np.float64]
    rate: float

    @classmethod
    def of(cls, judge_at: ArrayLike | None = None, keep_at: ArrayLike | None = None) -> Moments:
        """Prepare the times at which the criterion is evaluated and those at which states are kept."""
        judged, kept = (np.asarray(() if some is None else some, dtype=float) for some in (judge_at, keep_at))
        last = judged[-1] if len(judged) else 0.0
        rate = 2 * len(judged) / last if last > 0 else 0.0
        edges = np.arange(2 * len(judged)) / rate if rate else np.zeros(1)
        # An edge that rounding would move past a time lies before it.
        bins = np.searchsorted(judged, (1 - ROUNDING) * edges, side="right").astype(float)
        return cls(np.append(kept, np.inf), np.append(judged, np.inf), bins, rate)


class IdealKernel(Kernel):
    """A compiled flight through the ideal plant."""

    def fly(
        self,
        starts: Numbers,
        duration: float,
        exact: Tolerances,
        *,
        parameters: NDArray[np.float64] | None = None,
        judge_at: ArrayLike | None = None,
        keep_at: ArrayLike | None = None,
        workers: int | None = None,
        progress: Progress = lambda *_: None,
    ) -> Flown:
        """Fly all `starts` (n, 24), in the law's frame, for `duration` seconds; through a lag, (n, 28) with wrenches.

        Parameters
        ----------
        exact : Tolerances
            Tolerances per step and the number of steps; method and precision are those of the kernel.
        parameters : (n, k), optional
            Values of the varying gains; default those of the law.
        judge_at : (j,), optional
            Increasing times, s, at which the criterion is evaluated; without, `Flown.reductions` is None.
        keep_at : (t,), optional
            Increasing times, s, at which states are kept. They do not affect the criterion.
        workers : int, optional
            Threads; default one per core.
        progress : callable
            Called with `(started, runs)`.
        """
        starts = np.ascontiguousarray(starts, dtype=float)
        values = inputs_of(self.loop, parameters, len(starts))
        moments, size = Moments.of(judge_at, keep_at), starts.shape[1]
        samples = None if keep_at is None else (len(moments.kept) - 1, size)
        out = Flown.of_size(
            len(starts), size, samples=samples, judged=0 if judge_at is None else len(REDUCTIONS),
            touching=self.loop.touches,
        )  # fmt: skip

        def fly(queue: Any, stop: Word) -> None:
            call(self.function, starts, values, duration, exact, moments, out, stop, queue=queue)

        from_queue(fly, len(starts), workers, progress)
        return out


def call(
    function: jit.Native,
    starts: NDArray[np.float64],
    values: NDArray[np.float64],
    until: float,
    exact: Tolerances,
    moments: Moments,
    out: Flown,
    stop: Word,
    begin: float = 0.0,
    **more: NDArray[Any] | None,
) -> None:
    """Call a compiled ideal `function` for contiguous `starts` (n, 24 or more) and parameter `values` (n, k).

    The runs last from `begin` to `until`, s, with the tolerances per step and the number of steps of `exact`.

    `out` is filled. Once `stop` is set, the call returns at its next step. `more` may be `knots` of a single run, to
    receive the number of accepted steps and four numbers for each: its time, and the drift (3,) before projection; and
    `queue` (1,), the index of the next run, through which calls in several threads share the runs.
    """
    given = {
        "starts": starts, "parameters": values, "queue": np.zeros(1, dtype=np.int64), "runs": len(starts),
        "begin": begin, "until": until, "rtol": exact.rtol, "atol": exact.absolute, "max_steps": exact.steps,
        "times": moments.kept, "time_count": len(moments.kept) - 1,
        "judge_times": moments.judged, "bins": moments.bins, "bin_count": len(moments.bins), "bin_rate": moments.rate,
        "samples": out.samples, "reductions": out.reductions, "final": out.final, "end": out.end, "status": out.code,
        "steps": out.steps, "knots": None, "clearance": out.clearance, "part": out.part, "stop": stop, **more,
    }  # fmt: skip
    function(*in_order(ARGUMENTS, given))


@lru_cache(maxsize=64)
def ideal_kernel(
    loop: Loop, criterion: Criterion | None = None, *, method: str = "dop853", precision: str = "double"
) -> IdealKernel:
    """Return the kernel of a `loop` in continuous time for `criterion` (default: inverted), compiled or from the cache.

    Of the loop's plant only count lag and floor. Its parameters are inputs, all other gains are constants of the code.
    `method` is "dop853", of order 8 for tight tolerances, or "dp5", of order 5 for 1e-6 and looser. All arithmetic has
    the `precision` "double" or "float".

    Raises InputError if the method, precision or a gain is unknown, or the law has operations that cannot be compiled.
    """
    criterion = criterion or Criterion()
    one_of("precision", precision, BYTES)
    problem = ideal_problem(loop, criterion)
    one_of("method", method, METHODS)
    return IdealKernel(loop, criterion, compile_ideal(problem, method, precision), key_of(problem, method, precision))


def key_of(problem: Problem, method: str, precision: str) -> str:
    """Return what determines the kernel of `problem`, whatever its width."""
    return f"ideal {method} {precision}, judged to the end, {problem!r}"


def compile_ideal(problem: Problem, method: str, precision: str = "double") -> jit.Native:
    """Return the kernel of `problem` by `method` in `precision`, compiled or from the cache, as wide as is fastest."""
    size = LONG if sum(problem.rates.counts().values()) > OPERATIONS_OF_LONG else SHORT
    return jit.build(*write_ideal(problem, size // BYTES[precision], method, precision), "kernel", ARGUMENT_KINDS)


def write_ideal(
    problem: Problem, width: int, method: str, precision: str, target: Target | None = None
) -> tuple[str, Callable[[], LoopModule]]:
    """Return the cache key of the kernel of `problem`, `width` runs at a time, and what writes its module."""
    key = f"{key_of(problem, method, precision)} {width} lanes, states below {MAX_STATE}"
    return key, lambda: kernel_module(problem, method_named(method), width, precision, target)


def ideal_problem(loop: Loop, criterion: Criterion) -> Problem:
    """Return the closed `loop` and `criterion` as programs, with the loop's parameters as inputs."""
    vehicle, law = loop.vehicle, loop.symbolic
    symbols = symbolic_loop(vehicle, law, loop.parameters, lag=loop.lag)
    size = symbols.s.numel()
    inputs = [symbols.t, symbols.s, symbols.p]
    wrench = ca.vertcat(symbols.wrench.thrust, symbols.wrench.moment)
    return Problem(
        rates=lower(ca.Function("rates", inputs, [symbols.rates, ca.densify(wrench)])),
        project=lower(_projection(size)),
        margin=_margin(symbols, law, inputs),
        judging=_judge(vehicle, law, criterion, size),
        # Entry 24 of what touches is the thrust: the first of the wrench, wherever it stands.
        touch=touch_of(vehicle, law.e3, by_rotors=False, floor=loop.plant.floor),
    )


def _judge(vehicle: Vehicle, law: BoundLaw, criterion: Criterion, size: int) -> Judging:
    """Return `criterion` as gauges of the state, and the rotor forces of a wrench."""
    t, s, s_dot = ca.SX.sym("t"), ca.SX.sym("s", size), ca.SX.sym("s_dot", size)
    state, rates = State.symbolic(s), State.symbolic(s_dot)
    gauges, tolerances = gauge(t, state, vehicle, law.reference, criterion, law.e3)
    # Position, attitude and rod direction, which alone enter a gauge, have rates that the state itself holds.
    along = Rates(state.x_dot, rates.x_dot, state.R @ hat(state.omega), rates.omega, state.y_dot, rates.y_dot)
    first = lie_derivative(gauges, state, along, t)
    outputs = [gauges, first, lie_derivative(first, state, along, t), tolerances]
    wrench = ca.SX.sym("w", 4)
    forces = _multiply(vehicle.unmixing(law.e3), wrench)
    both = ca.vertcat(ca.sumsqr(forces) / forces.numel(), ca.mmax(forces))
    return Judging(
        gauges=lower(ca.Function("gauges", [t, s, s_dot], [ca.densify(ca.SX(output)) for output in outputs])),
        bounds=gauge_bounds(criterion),
        forces=lower(ca.Function("forces", [wrench], [both])),
    )


def _multiply(matrix: NDArray[np.float64], vector: Vector) -> Numbers:
    """Return `matrix` · `vector` with one product where a column repeats a magnitude, up to roundoff."""
    rows = [ca.SX(0) for _ in matrix]
    for column, factor in zip(matrix.T, ca.vertsplit(vector), strict=True):
        digits = np.round(column, 14 - int(np.ceil(np.log10(np.max(np.abs(column))))))
        products = {size: size * factor for size in distinct(np.abs(digits)) if size}
        for i, entry in enumerate(digits):
            if entry:
                rows[i] += products[abs(entry)] if entry > 0 else -products[abs(entry)]
    return ca.vertcat(*rows)


def _margin(symbols: SymbolicLoop, law: BoundLaw, inputs: list[Any]) -> Program | None:
    if law.guard is None:
        return None
    signal = symbols.signals[one_of("law.guard", law.guard.signal, symbols.signals)]
    return lower(ca.Function("margin", inputs, [signal - law.guard.threshold]))


def _projection(size: int) -> ca.Function:
    """Return packed state (`size`,) → state projected onto the manifold, and drift (3,) before projection."""
    packed = ca.SX.sym("s", size)
    s = State.symbolic(packed)
    defect = s.R.T @ s.R - ca.SX.eye(3)
    drift = ca.vertcat(ca.fabs(ca.norm_2(s.y) - 1), ca.fabs(ca.dot(s.y, s.y_dot)), ca.norm_fro(defect))
    return ca.Function("project", [packed], [ca.vertcat(project_symbolic(packed), packed[SIZE:]), drift])
