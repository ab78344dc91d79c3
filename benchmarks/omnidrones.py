"""From how many starts of OmniDrones' hover the bar stays up for all 8 s: `python -m benchmarks.omnidrones [FILE]`.

Laws that know the machine, through the actions of the task, beside the policy in FILE, which is trained first if there
is no such file; 2,000 starts that no training has seen. With FILE (.zip) it needs Stable-Baselines3.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

import flypend as fp
from benchmarks.omnidrones_tasks import inv_pendulum_hover
from flypend.envs import VectorWorlds
from flypend.flight.metrics import wilson

COUNT, SEED = 2000, 31_000_000
Policy = Callable[[Any], Any]


def law(law: fp.Law, vehicle: fp.Vehicle) -> Policy:
    """Return observations → actions of a law, its wrench allocated without regard to limits."""
    s = ca.SX.sym("s", 24)
    wrench = ca.Function("wrench", [s], [law.bind(vehicle).upright(ca.SX(0), s)])
    low, high = vehicle.rotor_limits

    def act(seen: Any) -> Any:
        R = seen[:, 6:15].reshape(-1, 3, 3).transpose(0, 2, 1).reshape(-1, 9)  # by rows
        states = np.hstack([seen[:, :6], R, seen[:, 15:24]]).astype(float)
        forces = vehicle.unmixing() @ np.array(wrench(states.T))
        return np.clip(2 * (forces.T - low) / (high - low) - 1, -1, 1)

    return act


def kept_up(policy: Policy, worlds: VectorWorlds) -> int:
    """Return how many worlds are cut off without having ended before."""
    seen, _ = worlds.reset(seed=SEED)
    up = np.ones(worlds.num_envs, dtype=bool)
    for _ in range(worlds.worlds.env.limit):
        seen, _, terminated, _, _ = worlds.step(policy(seen))
        up &= ~terminated
    return int(up.sum())


def main() -> None:
    """Print a line for each law, and for the policy."""
    worlds = VectorWorlds(inv_pendulum_hover(), COUNT)
    vehicle = worlds.worlds.env.vehicle
    policies = {"regulator": law(fp.laws.lqr(), vehicle), "tuned law": law(fp.laws.inverted(), vehicle)}
    if sys.argv[1:]:
        from flypend.examples.train import PPO, train

        if not Path(sys.argv[1]).exists():
            train(inv_pendulum_hover())[0].save(sys.argv[1])
        model = PPO.load(sys.argv[1])
        policies["policy"] = lambda seen: model.predict(seen, deterministic=True)[0]
    for name, policy in policies.items():
        count = kept_up(policy, worlds)
        low, high = wilson(count, COUNT)
        print(f"{name}: {count} of {COUNT} stay up ({low:.1%} to {high:.1%})", flush=True)


if __name__ == "__main__":
    main()
