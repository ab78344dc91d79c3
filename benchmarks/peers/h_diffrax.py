"""diffrax: jit of vmap of diffeqsolve, Dopri5 with its PID controller."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.peers import Fly, Peer

BATCH = 64


def make(problem: Any, threads: int) -> Fly:
    """The same program as the vector field, one run under vmap; doubles, final state only."""
    import diffrax
    import jax
    import jax.numpy as jnp

    from benchmarks.as_jax import as_jax

    jax.config.update("jax_enable_x64", True)
    rates, none = as_jax(problem.programs.rates), jnp.zeros((0, 1))

    def field(t: Any, s: Any, _: Any) -> Any:
        return rates(jnp.reshape(t, (1, 1)), s[:, None], none)[0][:, 0]

    term, solver = diffrax.ODETerm(field), diffrax.Dopri5()

    def one(start: Any, tolerance: Any) -> Any:
        control = diffrax.PIDController(rtol=tolerance, atol=tolerance)
        return diffrax.diffeqsolve(
            term, solver, 0.0, problem.duration, 1e-3, start, stepsize_controller=control,
            saveat=diffrax.SaveAt(t1=True), max_steps=100_000,
        ).ys[0]  # fmt: skip

    solve = jax.jit(jax.vmap(one, in_axes=(0, None)))

    def fly(starts: Any, tolerance: float) -> Any:
        # Lanes of a vmap wait for each other: small batches lose less to the few runs of very many steps.
        filled = np.resize(starts, (-(-len(starts) // BATCH) * BATCH, starts.shape[1]))
        parts = [jax.device_get(solve(jnp.asarray(part), tolerance)) for part in filled.reshape(-1, BATCH, 24)]
        return np.concatenate(parts)[: len(starts)]

    return fly


PEER = Peer("diffrax", "jit of vmap over 64 runs, Dopri5, PID controller, doubles, no projection", make, 512)
