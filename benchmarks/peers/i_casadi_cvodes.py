"""CasADi's interface to SUNDIALS CVODES, one run after the other."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.peers import Fly, Peer


def make(problem: Any, threads: int) -> Fly:
    """Adams' method without Jacobians of sensitivities, one integrator per tolerance."""
    import casadi as ca

    from flypend.laws.closed_loop import close_loop

    loop = close_loop(problem.vehicle, problem.law)
    t, s = ca.SX.sym("t"), ca.SX.sym("s", 24)
    system = {"x": s, "t": t, "ode": loop.rates(t, s)}
    made: dict[float, Any] = {}

    def fly(starts: Any, tolerance: float) -> Any:
        if tolerance not in made:
            options = {"abstol": tolerance, "reltol": tolerance, "max_num_steps": 100_000,
                       "linear_multistep_method": "adams", "nonlinear_solver_iteration": "functional"}  # fmt: skip
            made[tolerance] = ca.integrator("run", "cvodes", system, 0.0, problem.duration, options)
        return np.array([np.array(made[tolerance](x0=start)["xf"]).ravel() for start in starts])

    return fly


PEER = Peer("CasADi CVODES", "Adams, functional iteration, no projection", make, 48)
