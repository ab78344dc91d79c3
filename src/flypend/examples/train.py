"""Train a policy by PPO of Stable-Baselines3: to balance the rod, or for another task.

`python examples/train.py [TASK]` needs the extra rl and stable-baselines3.
"""

from __future__ import annotations

import sys
import time
from typing import Any

import numpy as np
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecNormalize

from flypend.envs import VectorWorlds
from flypend.envs.sb3 import VecWorlds


def share_kept_up(model: PPO, task: Any, count: int, seed: int) -> float:
    """Share of `count` starts from which the rod stays up until the world is cut off."""
    worlds = VectorWorlds(task, count)
    seen, _ = worlds.reset(seed=seed)
    up = np.ones(count, dtype=bool)
    for _ in range(worlds.worlds.env.limit):
        seen, _, terminated, _, _ = worlds.step(model.predict(seen, deterministic=True)[0])
        up &= ~terminated
    return float(up.mean())


def train(task: Any = "balance", most: int = 18_000_000, wanted: float = 0.97) -> tuple[PPO, float]:
    """Train until the `wanted` share of 500 starts is kept up, or for `most` steps, the last quarter of them smaller.

    Return the policy, and the share of 1,000 other starts that it keeps up.
    """
    worlds = VecNormalize(VecWorlds(VectorWorlds(task, 256)), norm_obs=False)
    model = PPO(
        "MlpPolicy", worlds, n_steps=64, batch_size=4096, n_epochs=8, learning_rate=1e-3, seed=0,
        policy_kwargs={"net_arch": [64, 64], "log_std_init": -1.0},
    )  # fmt: skip
    share = 0.0
    while share < wanted and model.num_timesteps < most:
        if model.num_timesteps > 0.75 * most:
            model.lr_schedule = lambda _: 2e-4
        model.learn(100_000, reset_num_timesteps=False)
        share = share_kept_up(model, task, 500, seed=10**6)
        print(f"{model.num_timesteps} steps: {100 * share:.1f} % stay up", flush=True)
    return model, share_kept_up(model, task, 1000, seed=2 * 10**6)


if __name__ == "__main__":
    task = sys.argv[1] if len(sys.argv) > 1 else "balance"
    model, share = train(task)
    print(f"{100 * share:.1f} % of 1,000 other starts stay up, after {time.process_time():.0f} s of processor time")
    model.save(task)
