"""A GPU beside the processor, in one run: `python -m benchmarks.gpu`, on a machine that has one, in three minutes.

Worlds: ours on the cores that the process may use, crazyflow's on the device that JAX finds (`pip install crazyflow
"jax[cuda13]"`), actions at 100 Hz over motion at 1 kHz. Flights: the corrected law on the ideal plant, as in `make
bench`, by the method of order 5 with steps of its own in each run, in double precision: our kernel on two cores, CUDA
from the same program (CuPy), and JAX from it (`benchmarks.as_jax`), each at the loosest tolerance that gives a median
error of 1e-6; starts and final states are copied to the GPU and back. The best of some turns. `--gpu` and `--core` are
prices per hour, from which steps and flights per euro follow. Without a GPU, JAX runs on the processor, which tries the
benchmark (`--small`): a line says so, and rows say where they ran.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Any

import numpy as np

from benchmarks import clock
from benchmarks.as_jax import as_jax
from benchmarks.problem import Problem, matched
from benchmarks.results import machine
from flypend.compile.program import Program, interpret
from flypend.flight.kernels import ideal_kernel
from flypend.flight.request import Tolerances

GPU, CORE = 3.0, 0.04  # €/h of an H200 with its machine, and of a core: assumed; who pays otherwise says so
COUNTS = (4096, 65_536, 1_048_576)
FLIGHTS, TURNS = 1_000_000, 3
Fly = Callable[[Any, float], Any]
# Dormand and Prince's stages, weights and the difference from the embedded method.
STAGES = (
    (1 / 5,), (3 / 40, 9 / 40), (44 / 45, -56 / 15, 32 / 9),
    (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
    (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
    (35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84),
)  # fmt: skip
NODES = (1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0)
DEFECT = (71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40)
FIRST, SAFETY, LEAST, MOST = 1e-3, 0.9, 0.2, 5.0  # the first step, s; how a step changes


def by_jax(program: Program, duration: float) -> Fly:
    """Return a function (starts (n, 24), tolerance) → final states. Whoever is done waits until half of all are."""
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    field = _field(program)
    advance = _advance(field, duration)

    @jax.jit
    def begin(starts: Any) -> Any:
        t = jnp.zeros(len(starts))
        return t, jnp.full(len(starts), FIRST), starts.T, field(t, starts.T)

    @jax.jit
    def go_on(carried: Any, tolerance: Any) -> Any:
        few = len(carried[0]) // 2

        def going(now: Any) -> Any:
            on = (now[0] < duration).sum()
            return (on > few) | ((few < 512) & (on > 0))

        return jax.lax.while_loop(going, lambda now: advance(now, tolerance), carried)

    @jax.jit
    def half(carried: Any) -> Any:
        """The half that holds all which are not done, and where it was."""
        place = jnp.argsort(carried[0] >= duration)[: len(carried[0]) // 2]
        return tuple(row[..., place] for row in carried), place

    def fly(starts: Any, tolerance: float) -> Any:
        n = len(starts)
        filled = np.resize(starts, (max(1024, 1 << (n - 1).bit_length()), starts.shape[1]))
        carried, levels = go_on(begin(jnp.asarray(filled)), tolerance), []
        while bool((carried[0] < duration).any()):
            part, place = half(carried)
            levels.append((carried[2], place))
            carried = go_on(part, tolerance)
        final = carried[2]
        for whole, place in reversed(levels):
            final = whole.at[:, place].set(final)
        return np.asarray(final.T[:n])

    return fly


def _field(program: Program) -> Callable[[Any, Any], Any]:
    """Return (times (n,), states (24, n)) → rates."""
    import jax.numpy as jnp

    rates = as_jax(program)
    return lambda t, s: rates(t[None], s, jnp.zeros((0, len(t))))[0]


def _advance(field: Callable[[Any, Any], Any], duration: float) -> Callable[[Any, Any], Any]:
    """Return a step of all: (times, steps, states, rates there), tolerance → the same afterwards."""
    import jax
    import jax.numpy as jnp

    table = jnp.array([(*row, *[0.0] * (7 - len(row))) for row in STAGES])
    nodes, defect = jnp.array(NODES), jnp.array(DEFECT)

    def advance(carried: Any, tolerance: Any) -> Any:
        t, h, s, first = carried
        step = jnp.minimum(h, duration - t)

        def stage(j: Any, now: Any) -> Any:  # a loop, since XLA takes minutes to compile six copies of the program
            slopes, _ = now
            moved = s + step * jnp.tensordot(table[j], slopes, 1)
            return slopes.at[j + 1].set(field(t + nodes[j] * step, moved)), moved

        slopes, moved = jax.lax.fori_loop(0, 6, stage, (jnp.zeros((7, *s.shape)).at[0].set(first), s))
        scale = tolerance * (1 + jnp.maximum(jnp.abs(s), jnp.abs(moved)))
        error = jnp.sqrt(jnp.mean((step * jnp.tensordot(defect, slopes, 1) / scale) ** 2, axis=0))
        on = t < duration
        taken = on & (error <= 1)
        factor = jnp.clip(SAFETY * jnp.maximum(error, 1e-12) ** -0.2, LEAST, MOST)
        return (
            jnp.where(taken, t + step, t), jnp.where(on, step * factor, h),
            jnp.where(taken, moved, s), jnp.where(taken, slopes[6], first),
        )  # fmt: skip

    return advance


def in_c(program: Program) -> str:
    """Return the program (t, s) → rates as a function of CUDA."""
    signs = {"add": "+", "sub": "-", "mul": "*", "div": "/"}
    lines: list[str] = []

    def keep(expression: str) -> str:
        lines.append(f"const double v{len(lines)} = {expression};")
        return f"v{len(lines) - 1}"

    operations: dict[str, Callable[..., str]] = {
        name: lambda a, b, sign=sign: keep(f"{a} {sign} {b}") for name, sign in signs.items()
    }
    operations |= {"neg": lambda a: keep(f"-{a}"), "sqrt": lambda a: keep(f"sqrt({a})")}
    rates = interpret(program, [lambda _: "t", lambda i: f"s[{i}]"], operations, lambda number: keep(repr(number)))[0]
    lines += [f"r[{i}] = {name};" for i, name in enumerate(rates)]
    head = "__device__ __forceinline__ void rates(double t, const double* s, double* r) {"
    return "\n".join([head, *lines, "}\n"])


def cuda_source(program: Program) -> str:
    """Return the kernel: a run a thread, its states and slopes in registers as far as they go."""
    size, stages = program.inputs[1], ""
    for j, (row, node) in enumerate(zip(STAGES, NODES, strict=True), 1):
        total = " + ".join(f"{a!r} * k[{m}][i]" for m, a in enumerate(row) if a)
        stages += f"for (int i = 0; i < N; ++i) moved[i] = s[i] + h * ({total});\n"
        stages += f"rates(t + {node!r} * h, moved, k[{j}]);\n"
    defect = " + ".join(f"{e!r} * k[{m}][i]" for m, e in enumerate(DEFECT) if e)
    kernel = f"""
extern "C" __global__ void fly(double* states, int runs, double duration, double tolerance) {{
  const int N = {size}, run = blockIdx.x * blockDim.x + threadIdx.x;
  if (run >= runs) return;
  double s[N], moved[N], k[7][N], t = 0, next = {FIRST!r};
  for (int i = 0; i < N; ++i) s[i] = states[i * (long)runs + run];
  rates(t, s, k[0]);
  for (int tries = 0; t < duration && tries < 100000; ++tries) {{
    const double h = fmin(next, duration - t);
    {stages}
    double square = 0;
    for (int i = 0; i < N; ++i) {{
      const double scale = tolerance * (1 + fmax(fabs(s[i]), fabs(moved[i])));
      const double part = h * ({defect}) / scale;
      square += part * part;
    }}
    const double error = sqrt(square / N);
    next = h * fmin({MOST!r}, fmax({LEAST!r}, {SAFETY!r} * pow(fmax(error, 1e-12), -0.2)));
    if (error <= 1) {{
      t += h;
      for (int i = 0; i < N; ++i) {{ s[i] = moved[i]; k[0][i] = k[6][i]; }}
    }}
  }}
  for (int i = 0; i < N; ++i) states[i * (long)runs + run] = s[i];
}}
"""
    return in_c(program) + kernel


def by_cuda(program: Program, duration: float, threads: int = 64) -> Fly:
    """Return a function as `by_jax` does; starts are copied to the GPU and final states back within it."""
    import cupy

    kernel = cupy.RawKernel(cuda_source(program), "fly", options=("--std=c++17",))

    def fly(starts: Any, tolerance: float) -> Any:
        states = cupy.ascontiguousarray(cupy.asarray(starts).T)
        kernel((-(-len(starts) // threads),), (threads,), (states, np.int32(len(starts)), duration, tolerance))
        return cupy.asnumpy(cupy.ascontiguousarray(states.T))

    return fly


def two_cores(problem: Problem) -> Fly:
    """Return a function as `by_jax` does: our kernel in two threads."""
    kernel = ideal_kernel(problem.loop, method="dp5")
    return lambda starts, rtol: kernel.fly(starts, problem.duration, Tolerances(rtol=rtol), workers=2).final


def flights(count: int, gpu: float, core: float) -> None:
    """Print flights per second and per euro."""
    problem = Problem()
    few, many, own = problem.starts(48, seed=7), problem.starts(count), two_cores(problem)
    exact, program = own(few, 1e-12), problem.programs.rates
    print("| flights | tolerance | median error | first, s | flights/s | times two cores | million flights/€ |")
    print("|---|---|---|---|---|---|---|")
    base = 0.0
    makers: dict[str, tuple[Callable[[], Fly], float]] = {
        "flypend, two cores": (lambda: own, 2 * core),
        "CUDA from the same program": (lambda: by_cuda(program, problem.duration), gpu),
        "JAX from the same program": (lambda: by_jax(program, problem.duration), gpu),
    }
    for name, (make, price) in makers.items():
        with suppress(ModuleNotFoundError):
            fly = make()
            tolerance, median, _ = matched(fly, few, exact)
            (first,) = clock.wall(partial(fly, many, tolerance), repeats=1)  # compiles
            (spent,) = clock.wall(partial(fly, many, tolerance), repeats=TURNS)
            rate = count / spent
            base = base or rate
            print(
                f"| {name} | {tolerance:.0e} | {median:.1e} | {first:.1f} | {rate:,.0f} | {rate / base:.2f} | "
                f"{rate * 3600 / price / 1e6:,.0f} |", flush=True,
            )  # fmt: skip


def ours(count: int) -> Callable[[], float]:
    """Return what steps our worlds for a while and returns the steps of the environment per second."""
    from flypend.envs import VectorWorlds

    worlds = VectorWorlds("swing_up", count, copy=False, workers=len(os.sched_getaffinity(0)))
    worlds.reset(seed=0)
    given = np.random.default_rng(0).uniform(-1, 1, (count, 4)).astype(np.float32)
    return partial(_rate, lambda: worlds.step(given), lambda: None, count)


def theirs(count: int) -> Callable[[], float]:
    """The same of crazyflow's."""
    import jax
    from crazyflow.control import Control
    from crazyflow.dynamics import Dynamics
    from crazyflow.sim import Sim

    model = {"control": Control.rotor_vel, "dynamics": Dynamics.first_principles}
    sim = Sim(count, freq=1000, device=jax.default_backend(), **model)
    given = jax.device_put(1e4 * np.random.default_rng(0).uniform(1.0, 2.0, (count, 1, 4)).astype(np.float32))

    def step() -> None:
        sim.rotor_vel_control(given)
        sim.step(10)

    return partial(_rate, step, lambda: jax.block_until_ready(sim.data.states.pos), count)


def _rate(step: Callable[[], Any], wait: Callable[[], Any], count: int) -> float:
    """Steps of all worlds per second, over a second or three steps."""
    for _ in range(3):  # the first two compile
        step()
    wait()
    begin, steps = time.perf_counter(), 0
    while steps < 3 or time.perf_counter() - begin < 1.0:
        for _ in range(max(1, 2**16 // count)):  # the host may run ahead
            step()
            steps += 1
        wait()
    return count * steps / (time.perf_counter() - begin)


def worlds(counts: tuple[int, ...], gpu: float, core: float) -> None:
    """Print steps of the environment per second and per euro, by number of worlds."""
    cores, there = len(os.sched_getaffinity(0)), "GPU" if on_gpu() else "processor"
    print(f"| worlds | flypend, {cores} cores: steps/s | million steps/€ | crazyflow, {there}: steps/s | there per € |")
    print("|---|---|---|---|---|")
    for count in counts:
        row = []
        for make, price in ((ours, cores * core), (theirs, gpu)):
            try:
                measure = make(count)
                best = max(measure() for _ in range(TURNS))
                row += [f"{best:,.0f}", f"{best * 3600 / price / 1e6:,.0f}"]
            except ModuleNotFoundError as error:
                row += [f"no {error.name}", ""]
        print(f"| {count:,} | {' | '.join(row)} |", flush=True)


def on_gpu() -> bool:
    """Return whether JAX finds a GPU."""
    import jax

    return bool(jax.default_backend() == "gpu")


def euros(text: str) -> float:
    """Return euros per hour, above 0."""
    given = float(text)
    if not 0 < given < float("inf"):
        raise argparse.ArgumentTypeError(f"expected euros per hour, above 0, got {text}")
    return given


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--gpu", type=euros, default=GPU, help="euros per hour of the GPU, with the machine about it")
    parser.add_argument("--core", type=euros, default=CORE, help="euros per hour of a core")
    parser.add_argument("--small", action="store_true", help="few worlds and flights, to try it")
    asked = parser.parse_args()
    try:
        import jax
    except ModuleNotFoundError:
        parser.error('needs JAX: pip install "jax[cuda13]", or jax to try it without a GPU')
    if not on_gpu():
        print("JAX finds no GPU: its rows and crazyflow's ran on the processor.\n")

    where = machine()
    print(
        f"{where['processor']}, {where['cores']} cores (load {where['load']:.1f}), {where['date']}; "
        f"JAX {jax.__version__} on {jax.devices()[0].device_kind}. "
        f"A GPU at {asked.gpu:g} €/h, a core at {asked.core:g} €/h.\n"
    )
    worlds(COUNTS[:1] if asked.small else COUNTS, asked.gpu, asked.core)
    print()
    flights(4096 if asked.small else FLIGHTS, asked.gpu, asked.core)


if __name__ == "__main__":
    main()
