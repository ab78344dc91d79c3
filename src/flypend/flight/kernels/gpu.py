"""The ideal plant in JAX, for a GPU: the same programs on rows of one array. It also runs on a CPU."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import lru_cache
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend import errors
from flypend.compile.aside import aside
from flypend.compile.methods import method as method_named
from flypend.flight.criterion import Criterion
from flypend.flight.kernels.flown import Flown, inputs_of
from flypend.flight.kernels.ideal import ideal_problem, setting_of
from flypend.flight.kernels.stopping import StoppedError, Word, interruptible
from flypend.flight.request import Flight
from flypend.plants import Ideal
from flypend.plants.loop import Loop

if TYPE_CHECKING:
    from flypend.compile.jax.array_steps import Integrator, Setting

PIECE = 0.1  # s between looks at signals
# Runs integrated together: as many as fit the cache, or fill a GPU.
LANES = {"cpu": 256}
LANES_OF_GPU = 32768


@dataclass(frozen=True, eq=False)
class ArrayKernel:
    """A closed loop in JAX.

    Parameters
    ----------
    loop : Loop
        Vehicle, law, and the gains that may differ between runs.
    integrator : Integrator
        The functions of `flypend.compile.jax.array_steps`.
    """

    loop: Loop
    integrator: Integrator

    def fly(
        self,
        starts: ArrayLike,
        setting: tuple[float, float, float, int],
        *,
        parameters: NDArray[np.float64] | None = None,
        judge_at: ArrayLike = (),
    ) -> Flown:
        """Fly all `starts` (n, 24), in the law's frame, on JAX's default device.

        Parameters
        ----------
        starts
            Packed states.
        setting : tuple
            Duration (s), rtol, atol, and step limit: a run that exceeds it ends as diverged.
        parameters, judge_at
            As in `IdealKernel.fly`.

        Returns
        -------
        Flown
            Without samples.
        """
        from flypend.compile.jax.array_steps import Setting

        given = np.asarray(starts, dtype=float)
        n = len(given)
        values = inputs_of(self.loop, parameters, n)
        duration, rtol, atol, most = setting
        asked = Setting(n, float(duration), float(rtol), float(atol), most, np.append(judge_at, np.inf))
        with interruptible() as stop:
            results = self._flown(_rows(given), _rows(values), asked, stop)
        final, end, code, steps, reductions = (np.asarray(x)[..., :n] for x in results)
        return Flown(
            final=np.ascontiguousarray(final.T), end=end, code=code, reductions=np.ascontiguousarray(reductions.T),
            steps=steps,
        )  # fmt: skip

    def _flown(self, starts: NDArray[np.float64], parameters: NDArray[np.float64], asked: Setting, stop: Word) -> Any:
        """Fly `starts` in pieces of about a tenth of a second; between them, signals and the stop word are heard."""
        begin, advance = (_in_doubles(function) for function in self.integrator)
        progress, most, flying = begin(starts, parameters, asked), 1, True
        aside(lambda: advance(progress, starts, parameters, asked, 0))  # no step: it only compiles
        while flying:
            begun = time.monotonic()
            progress, flying = advance(progress, starts, parameters, asked, most)
            if stop[0]:
                raise StoppedError("stopped")
            most = max(1, int(most * np.clip(PIECE / (time.monotonic() - begun), 0.5, 2)))
        return progress.results


def fly_on_jax(flight: Flight) -> Flown:
    """Fly every start of `flight` in JAX, with the criterion evaluated on its grid.

    Raises InputError for what this engine lacks (sampled plants, single precision, sample times), or if JAX is missing.
    """
    law = flight.loop.symbolic
    if not isinstance(flight.plant, Ideal):
        raise errors.InputError("plant", "'ideal', with the engine jax", "a sampled plant")
    if flight.vehicle.mount != "gimbal":
        raise errors.InputError("vehicle.mount", "'gimbal', with the engine jax", repr(flight.vehicle.mount))
    if flight.times is not None:
        raise errors.InputError("times", "nothing, with the engine jax", f"{len(flight.times)} of them")
    if flight.tolerances.precision != "double":
        raise errors.InputError("precision", "'double', with the engine jax", flight.tolerances.precision)
    kernel = array_kernel(flight.loop, flight.criterion, method=flight.tolerances.method_for(law))
    return kernel.fly(flight.packed, setting_of(flight), parameters=flight.values, judge_at=flight.grid)


@lru_cache(maxsize=16)
def array_kernel(loop: Loop, criterion: Criterion | None = None, *, method: str = "dp5") -> ArrayKernel:
    """Build the closed `loop` in JAX (extra "gpu"); it is compiled on its first flight.

    Parameters
    ----------
    loop, criterion, method
        As in `ideal_kernel`.

    Raises
    ------
    InputError
        If JAX is missing, the method or a gain is unknown, or the law has operations that cannot be compiled.
    """
    errors.require("jax", extra="gpu", for_="engine")
    from jax import default_backend

    from flypend.compile.jax.array_steps import write_integrator

    problem = ideal_problem(loop, criterion or Criterion())
    integrator = write_integrator(problem, method_named(method), LANES.get(default_backend(), LANES_OF_GPU))
    return ArrayKernel(loop, integrator)


def _rows(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return `values` (n, k) as rows (k, m), n padded to a power of two m, since JAX recompiles for every m."""
    n = len(values)
    return np.pad(values, ((0, (1 << (n - 1).bit_length()) - n), (0, 0)), mode="edge").T.copy()


def _in_doubles(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return `function` with double precision in JAX, its results computed when it returns."""

    def call(*given: Any) -> Any:
        import jax

        with _doubles():
            return jax.tree.map(lambda some: some.block_until_ready(), function(*given))

    return call


def _doubles() -> AbstractContextManager[Any]:
    """Enable double precision in JAX within the context."""
    import jax

    holder = jax if hasattr(jax, "enable_x64") else import_module("jax.experimental")
    return holder.enable_x64(True)  # type: ignore[no-any-return]
