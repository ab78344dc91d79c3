"""heyoka's Taylor integrator in batch mode, as many lanes as its compiler recommends."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.peers import Fly, Peer


def make(problem: Any, threads: int) -> Fly:
    """One integrator per tolerance, as heyoka compiles the tolerance in."""
    import heyoka as hy

    from benchmarks.problem import in_heyoka

    _, system = in_heyoka(problem.programs.rates)
    lanes = hy.recommended_simd_size()
    compiled: dict[float, Any] = {}

    def fly(starts: Any, tolerance: float) -> Any:
        if tolerance not in compiled:
            compiled[tolerance] = hy.taylor_adaptive_batch(
                system, np.zeros((24, lanes)), tol=tolerance, compact_mode=False
            )
        integrator, out = compiled[tolerance], np.empty_like(starts)
        for first in range(0, len(starts), lanes):
            some = starts[first : first + lanes]
            integrator.set_time(0.0)
            integrator.state[:] = np.resize(some, (lanes, 24)).T
            integrator.propagate_until(problem.duration)
            out[first : first + lanes] = integrator.state.T[: len(some)]
        return out

    return fly


PEER = Peer("heyoka batch", "Taylor series, batch mode, unrolled code, no projection", make, 512)
