"""The ideal plant through JAX, for a GPU: the same programs on rows of one array. It also runs on a CPU."""

from __future__ import annotations

from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import lru_cache
from importlib import import_module
from typing import Any

import numpy as np

from flypend import errors
from flypend.compile.methods import method as method_named
from flypend.flight.criterion import Criterion
from flypend.flight.kernels.flown import Flown
from flypend.flight.kernels.ideal import MAX_STEPS, ideal_problem
from flypend.laws import BoundLaw
from flypend.model import Vehicle
from flypend.plants import Ideal
from flypend.plants.loop import Loop

# Runs that are under way together: what fits a cache, or what fills a GPU.
LANES = {"cpu": 256}
LANES_OF_GPU = 32768


@dataclass(frozen=True, eq=False)
class ArrayKernel:
    """A closed loop in JAX.

    Parameters
    ----------
    vehicle, law
        What flies, what steers it.
    parameters : tuple of str
        Gains that may differ from run to run.
    function : callable
        The integrator of `flypend.compile.jax.array_steps`.
    """

    vehicle: Vehicle
    law: BoundLaw
    parameters: tuple[str, ...]
    function: Any

    def fly(
        self,
        starts: Any,
        duration: float,
        *,
        rtol: float,
        atol: float | None = None,
        parameters: Any = None,
        max_steps: int = MAX_STEPS,
    ) -> Flown:
        """Fly all `starts` (n, 24), in the frame of the law, for `duration` seconds, on JAX's default device.

        Parameters
        ----------
        starts, duration, rtol, atol, parameters
            As in `IdealKernel.fly`.
        max_steps : int
            A run with more steps ends as diverged.

        Returns
        -------
        Flown
            Without reductions and samples.
        """
        from flypend.compile.jax.array_steps import Setting

        given = np.asarray(starts, dtype=float)
        own = [self.law.numbers[name] for name in self.parameters]
        n = len(given)
        values = np.broadcast_to(own, (n, len(own))) if parameters is None else np.asarray(parameters, float)
        if values.shape != (n, len(own)):
            raise errors.InputError("parameters", f"shape {(n, len(own))}", f"shape {values.shape}")
        setting = Setting(n, float(duration), float(rtol), float(rtol if atol is None else atol), max_steps)
        with _doubles():
            results = self.function(_rows(given), _rows(values), setting)
            final, end, code, steps = (np.asarray(x)[..., :n] for x in results)
        return Flown(final=np.ascontiguousarray(final.T), end=end, code=code, reductions=None, steps=steps)


@lru_cache(maxsize=16)
def array_kernel(
    vehicle: Vehicle, law: BoundLaw, parameters: tuple[str, ...] = (), *, method: str = "dp5"
) -> ArrayKernel:
    """The closed loop of `vehicle` under a bound `law` in JAX (extra "gpu"), compiled when it first flies.

    Parameters
    ----------
    vehicle, law, parameters, method
        As in `ideal_kernel`.

    Raises
    ------
    InputError
        Without JAX, for an unknown method or gain, and for a law with operations that cannot be compiled.
    """
    errors.require("jax", extra="gpu", for_="engine")
    from jax import default_backend

    from flypend.compile.jax.array_steps import write_integrator

    problem = ideal_problem(Loop(vehicle, law, Ideal(), parameters), Criterion())
    integrator = write_integrator(problem, method_named(method), LANES.get(default_backend(), LANES_OF_GPU))
    return ArrayKernel(vehicle, law, parameters, integrator)


def _rows(values: Any) -> Any:
    """`values` (n, k) as rows (k, m), n filled up to a power of two: JAX compiles for every m."""
    n = len(values)
    return np.pad(values, ((0, (1 << (n - 1).bit_length()) - n), (0, 0)), mode="edge").T.copy()


def _doubles() -> AbstractContextManager[Any]:
    """JAX with doubles inside, and as it was outside."""
    import jax

    holder = jax if hasattr(jax, "enable_x64") else import_module("jax.experimental")
    return holder.enable_x64(True)  # type: ignore[no-any-return]
