"""MuJoCo's rollout of vehicle and pendulum without any law: the closest that it has to an ensemble of runs."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.peers import Fly, Peer


def make(problem: Any, threads: int) -> Fly:
    """Open loop, RK4 steps of 1 ms: the cost of the motion alone, to which a law in Python or C would come."""
    import mujoco
    from mujoco import rollout

    from flypend.plants.mujoco import MujocoEngine

    model = MujocoEngine(problem.vehicle, timestep=1e-3).model
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    data = [mujoco.MjData(model) for _ in range(threads)]
    steps = round(problem.duration / model.opt.timestep)

    def fly(starts: Any, _: float) -> Any:
        begin = mujoco.MjData(model)
        size = mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS)
        state = np.zeros(size)
        mujoco.mj_getState(model, begin, state, mujoco.mjtState.mjSTATE_FULLPHYSICS)
        rollout.rollout(model, data, np.tile(state, (len(starts), 1)), nstep=steps)
        return starts

    return fly


PEER = Peer("MuJoCo rollout", "not the same: open loop, no law, RK4 at 1 ms", make, 64, threaded=True, accurate=False)
