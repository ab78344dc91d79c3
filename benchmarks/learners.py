"""PPO and SAC of Stable-Baselines3, and the gradient of `examples/gradient.py`, as `benchmarks.scores` trains them.

The settings of PPO and SAC are those of the library but for what stands here. They are one set for all tasks. For the
swing-up they learn on the shaped task, and are scored on the other.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

IDS = {
    "balance": "flypend/Balance-v0", "swing_up": "flypend/SwingUpShaped-v0", "track": "flypend/Track-v0",
    "catch_in_cup": "flypend/CatchInCup-v0",
}  # fmt: skip
WORLDS = {"ppo": 256, "sac": 64}
EVERY = {"ppo": 65_536, "sac": 16_384}  # steps between two looks at the score
SETTINGS: dict[str, dict[str, Any]] = {
    # Rollouts of 64 steps are 0.64 s, over which the rod would fall; large batches, since an update costs what dozens
    # of steps of the worlds do; little noise at first, for noise alone tips the rod.
    "ppo": {
        "n_steps": 64, "batch_size": 4096, "n_epochs": 8, "learning_rate": 1e-3,
        "policy_kwargs": {"net_arch": [64, 64], "log_std_init": -1.0},
    },
    # 16 gradients for 64 transitions: a gradient costs some thousand steps of a world.
    "sac": {
        "learning_starts": 8192, "train_freq": 1, "gradient_steps": 16, "batch_size": 512, "learning_rate": 1e-3,
        "buffer_size": 500_000, "policy_kwargs": {"net_arch": [64, 64]},
    },
}  # fmt: skip


def trained(
    name: str, task: str, seed: int, score: Callable[[Any], float], wanted: float, seconds: float
) -> tuple[Any, int, float]:
    """Train by the algorithm `name` until the `score` of its policy is `wanted`, or for `seconds` of processor time.

    Return the policy, (worlds, observations) → actions, its steps, and the processor time with that of the scores.
    The gradient stops by itself.
    """
    import torch

    if name == "gradient":
        return by_gradient(task, seed)
    from stable_baselines3 import PPO, SAC
    from stable_baselines3.common.vec_env import VecNormalize

    from flypend.envs.sb3 import make_vec_env

    torch.set_num_threads(1)
    begin = time.process_time()
    made = make_vec_env(IDS[task], WORLDS[name], seed=1_000_000 * seed)
    # Returns of about 1 are what the step sizes are made for. Normalised observations do not help.
    normalised = VecNormalize(made, norm_obs=False)
    model = {"ppo": PPO, "sac": SAC}[name]("MlpPolicy", normalised, seed=seed, device="cpu", **SETTINGS[name])

    def policy(worlds: Any, seen: Any) -> Any:
        return model.predict(seen, deterministic=True)[0]

    while True:
        model.learn(EVERY[name], reset_num_timesteps=False)
        now, spent = score(policy), time.process_time() - begin
        print(f"{name} {task} seed {seed}: {model.num_timesteps} steps, {spent:.0f} s, {now:.1f}", file=sys.stderr)
        if now >= wanted or spent > seconds:
            return policy, model.num_timesteps, spent


def by_gradient(task: str, seed: int) -> tuple[Any, int, float]:
    """Train the network of the example, and return as `trained`; it flies at the rate of the task."""
    import torch

    from flypend.examples import gradient

    torch.set_num_threads(1)
    begin = time.process_time()
    network, steps = gradient.train(task, seed)

    @torch.no_grad()
    def policy(worlds: Any, seen: Any) -> Any:
        return network(torch.from_numpy(seen[:, :24])).numpy()

    return policy, steps, time.process_time() - begin
