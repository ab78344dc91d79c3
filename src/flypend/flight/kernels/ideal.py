"""The kernel of the ideal plant: continuous time, the wrench acts as commanded."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np
from llvmlite import ir

from flypend.compile.llvm import jit
from flypend.compile.llvm.runge_kutta import ARGUMENTS, INTEGERS, REALS, write_kernel
from flypend.compile.llvm.vector import Lanes
from flypend.compile.methods import NAMES as METHODS
from flypend.compile.methods import method as method_named
from flypend.compile.problem import Problem
from flypend.compile.program import lower
from flypend.errors import one_of
from flypend.flight.criterion import REDUCTIONS, Criterion, observed
from flypend.flight.kernels.flown import Flown, Progress, address, from_queue, inputs_of
from flypend.laws import BoundLaw
from flypend.laws.closed_loop import SymbolicLoop, symbolic_loop
from flypend.model import State, Vehicle
from flypend.model.state import MAX_STATE, SIZE, project_symbolic

# Bytes of a vector. A long program is a long chain of dependent operations: two registers side by side keep the
# processor busy while it waits. A short one is better off with all registers for one.
SHORT, LONG = 64, 128
OPERATIONS_OF_LONG = 800
BYTES = {"double": 8, "float": 4}
MAX_STEPS = 1_000_000
# From this tolerance on the method of order 5 is the faster one.
LOOSE = 1e-6


@dataclass(frozen=True, eq=False)
class IdealKernel:
    """A compiled closed loop.

    Parameters
    ----------
    vehicle, law, criterion
        What flies, what steers it, and what counts as a success.
    parameters : tuple of str
        Gains that may differ from run to run.
    function : callable
        The compiled kernel.
    key : str
        What determines the kernel, processor and versions apart.
    """

    vehicle: Vehicle
    law: BoundLaw
    criterion: Criterion
    parameters: tuple[str, ...]
    function: Any
    key: str

    def fly(
        self,
        starts: Any,
        duration: float,
        *,
        rtol: float,
        atol: float | None = None,
        parameters: Any = None,
        times: Any = (),
        keep: bool = False,
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
        times : (t,)
            Increasing times, s, at which a run is judged.
        keep : bool
            Whether the states at these times are kept, too.
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
        values = inputs_of(self.law, self.parameters, parameters, len(starts))
        moments = closed(times)
        setting = (duration, rtol, rtol if atol is None else atol, max_steps or MAX_STEPS)

        out = _memory(len(starts), moments, keep, judge)

        def fly(queue: Any) -> None:
            call(self.function, starts, values, setting, moments, out, queue=queue)

        from_queue(fly, len(starts), workers, progress)
        return out


def lane_count(problem: Problem, precision: str) -> int:
    """Lanes of the kernel of `problem`: the width at which it is fastest."""
    size = LONG if sum(problem.rates.counts().values()) > OPERATIONS_OF_LONG else SHORT
    return size // BYTES[precision]


def integrate(
    function: jit.Native,
    start: Any,
    values: Any,
    duration: float,
    rtol: float,
    atol: float,
    times: Any,
    knots: Any = None,
) -> Flown:
    """One run by a compiled ideal kernel from `start` (24,), its states at `times` kept.

    `values` (1, k) are those of its parameters, `duration` (s), `rtol`, `atol` and `times` as in `IdealKernel.fly`.
    `knots` receives the number of accepted steps and four numbers for each: its time, and the drift from the manifold.
    """
    moments = closed(times)
    out = _memory(1, moments, True, False)
    call(function, start[None], values, (duration, rtol, atol, MAX_STEPS), moments, out, knots)
    return out


def closed(times: Any) -> Any:
    """`times` with infinity at the end, where a kernel stops looking for the next."""
    return np.append(np.asarray(times, dtype=float), np.inf)


def _memory(runs: int, moments: Any, keep: bool, judge: bool) -> Flown:
    return Flown.of_size(runs, SIZE, samples=(len(moments) - 1, SIZE) if keep else None, steps=True, judged=judge)


def call(
    function: jit.Native,
    starts: Any,
    values: Any,
    setting: tuple[float, float, float, int],
    moments: Any,
    out: Flown,
    knots: Any = None,
    queue: Any = None,
) -> None:
    """Call a compiled ideal `function` for contiguous `starts` (n, 24 or more) and parameter `values` (n, k).

    `setting` is duration (s), rtol, atol and the most steps; `moments` are sample times as `closed` gives them; `out`
    is written, and `knots` as in `integrate`. Calls in several threads share one `queue` (1,), the number of the next
    run, and with it the runs.
    """
    queue = np.zeros(1, dtype=np.int64) if queue is None else queue
    function(
        address(starts), address(values), address(queue), len(starts), *setting, address(moments), len(moments) - 1,
        address(out.samples), address(out.reductions), address(out.final), address(out.end), address(out.code),
        address(out.steps), address(knots),
    )  # fmt: skip


@lru_cache(maxsize=64)
def ideal_kernel(
    vehicle: Vehicle,
    law: BoundLaw,
    criterion: Criterion | None = None,
    parameters: tuple[str, ...] = (),
    *,
    method: str = "dop853",
    precision: str = "double",
) -> IdealKernel:
    """The kernel of `vehicle` under a bound `law`, compiled or from the cache.

    Parameters
    ----------
    vehicle, law, criterion
        What flies, what steers it, and what counts as a success (default: inverted).
    parameters : tuple of str
        Gains that may differ from run to run; the others are constants of the machine code.
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
    problem = ideal_problem(vehicle, law, criterion, parameters)
    one_of("method", method, METHODS)
    key = f"ideal {method} {precision} {problem!r}"
    return IdealKernel(vehicle, law, criterion, parameters, compiled(key, problem, method, precision), key)


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


def method_for(rtol: float, law: BoundLaw) -> str:
    """The Runge-Kutta method for a tolerance `rtol`: the faster one, but DOP853 where `law` can be singular.

    The error estimate of order 5 steps over a narrow singularity that the other notices.
    """
    return "dp5" if rtol >= LOOSE and law.guard is None else "dop853"


def ideal_problem(vehicle: Vehicle, law: BoundLaw, criterion: Criterion, parameters: Sequence[str] = ()) -> Problem:
    """The closed loop of `vehicle` under `law` as programs, judged by `criterion`, with `parameters` as inputs."""
    loop = symbolic_loop(vehicle, law, parameters)
    inputs = [loop.t, loop.s, loop.p]
    state = State.symbolic(loop.s)
    wrench = ca.vertcat(loop.wrench.thrust, loop.wrench.moment)
    rotors = ca.mtimes(vehicle.unmixing(law.e3), wrench)
    seen = observed(loop.t, state, rotors, vehicle, law.reference, criterion, law.e3)
    return Problem(
        rates=lower(ca.Function("rates", inputs, [loop.rates])),
        project=lower(_projection()),
        margin=_margin(loop, law, inputs),
        observe=lower(ca.Function("observe", inputs, [ca.densify(seen)])),
        reductions=REDUCTIONS,
    )


def _margin(loop: SymbolicLoop, law: BoundLaw, inputs: list[Any]) -> Any:
    if law.guard is None:
        return None
    signal = loop.signals[one_of("law.guard", law.guard.signal, loop.signals)]
    return lower(ca.Function("margin", inputs, [signal - law.guard.threshold]))


def _projection() -> ca.Function:
    """A packed state → that state on the manifold, and the drift (3,) before."""
    packed = ca.SX.sym("s", 24)
    s = State.symbolic(packed)
    defect = s.R.T @ s.R - ca.SX.eye(3)
    drift = ca.vertcat(ca.fabs(ca.norm_2(s.y) - 1), ca.fabs(ca.dot(s.y, s.y_dot)), ca.norm_fro(defect))
    return ca.Function("project", [packed], [project_symbolic(packed), drift])
