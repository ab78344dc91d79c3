"""PPO of Stable-Baselines3, SAC of sbx, and the gradient of `examples/gradient.py`, as `benchmarks.scores` trains them.

The settings are those of the libraries but for what stands here. For the swing-up they learn on the shaped task, and
are scored on the other. sbx is Stable-Baselines3 on JAX, and computes a gradient in a tenth of the time.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

IDS = {
    "balance": "flypend/Balance-v0", "swing_up": "flypend/SwingUpShaped-v0", "track": "flypend/Track-v0",
    "catch_in_cup": "flypend/CatchInCup-v0",
}  # fmt: skip
# What `--body` shows: the state in the body frame, where the heading changes nothing. Such a policy flies as a law.
BODY: dict[str, Any] = {"attitude": "body", "observe": "state"}
# Half as many decisions; of the swing-up, twice as many beginnings as the task has.
ONLY_IN_TRAINING: dict[str, dict[str, Any]] = {
    "swing_up": {"rate": 50.0, "duration": 5.0}, "catch_in_cup": {"rate": 50.0},
}  # fmt: skip
WORLDS = 256
EVERY = {"ppo": 65_536, "sac": 16_384}  # steps between two looks at the score
RARER = {"swing_up": 8}  # looks at long flights
SETTINGS: dict[str, dict[str, Any]] = {
    # Rollouts of 64 steps are 0.64 s, over which the rod would fall; large batches, since an update costs what dozens
    # of steps of the worlds do; little noise at first, for noise alone tips the rod.
    "ppo": {
        "n_steps": 64, "batch_size": 4096, "n_epochs": 8, "learning_rate": 1e-3,
        "policy_kwargs": {"net_arch": [64, 64], "log_std_init": -1.0},
    },
    # 32 gradients for 256 transitions: a gradient costs some hundred steps of a world.
    "sac": {
        "learning_starts": 8192, "train_freq": 1, "gradient_steps": 32, "batch_size": 512, "learning_rate": 1e-3,
        "buffer_size": 500_000, "policy_kwargs": {"net_arch": [64, 64]},
    },
}  # fmt: skip
# A rod that is caught at once costs metres, and the way back takes seconds, over which returns must look.
OF_TASK: dict[tuple[str, str], dict[str, Any]] = {("ppo", "catch_in_cup"): {"gamma": 0.995, "gae_lambda": 0.98}}
# Rate of learning from the first step to that of this number, and from there on. Large steps find the swing-up; small
# ones hold the rod still at the goal.
FALLING: dict[tuple[str, str], tuple[float, float, int]] = {
    ("ppo", task): (1e-3, 1e-4, 8_000_000) for task in ("swing_up", "catch_in_cup")
}  # fmt: skip


class Trained(NamedTuple):
    """A policy, (worlds, observations) → actions, its steps, and seconds of processor and wall, scores included."""

    policy: Any
    steps: int
    processor: float
    wall: float


def trained(
    name: str,
    task: str,
    seed: int,
    score: Callable[[Any], float],
    wanted: float,
    seconds: float,
    threads: int = 1,
    seen_as: Mapping[str, Any] | None = None,
) -> Trained:
    """Train by the algorithm `name` until the `score` of its policy is `wanted`, or for `seconds` of processor time.

    PyTorch computes with this many `threads`; XLA has its own. The gradient stops by itself, and sees what it wants;
    `seen_as` are arguments of the environment that say what the others observe.
    """
    import torch

    torch.set_num_threads(threads)
    if name == "gradient":
        return by_gradient(task, seed)
    from stable_baselines3.common.vec_env import VecNormalize

    from flypend.envs.sb3 import make_vec_env

    algorithm = _algorithm(name)
    begin, started = time.process_time(), time.perf_counter()
    arguments = {**(seen_as or {}), **ONLY_IN_TRAINING.get(task, {})}
    made = make_vec_env(IDS[task], WORLDS, seed=1_000_000 * seed, env_kwargs=arguments)
    # Returns of about 1 are what the step sizes are made for. Normalised observations do not help.
    settings = {"gamma": 0.99, **SETTINGS[name], **OF_TASK.get((name, task), {})}
    normalised = VecNormalize(made, norm_obs=False, gamma=settings["gamma"])
    model = algorithm("MlpPolicy", normalised, seed=seed, device="cpu", **settings)
    if (name, task) in FALLING:
        first, last, steps = FALLING[name, task]
        model.lr_schedule = lambda _: first * (last / first) ** min(1.0, model.num_timesteps / steps)

    def policy(worlds: Any, seen: Any) -> Any:
        return model.predict(seen, deterministic=True)[0]

    while True:
        model.learn(EVERY[name] * RARER.get(task, 1), reset_num_timesteps=False)
        now, spent = score(policy), time.process_time() - begin
        print(f"{name} {task} seed {seed}: {model.num_timesteps} steps, {spent:.0f} s, {now:.1f}", file=sys.stderr)
        if now >= wanted or spent > seconds:
            return Trained(policy, model.num_timesteps, spent, time.perf_counter() - started)


def _algorithm(name: str) -> Any:
    if name == "sac":
        import sbx

        return sbx.SAC
    from stable_baselines3 import PPO

    return PPO


def by_gradient(task: str, seed: int) -> Trained:
    """Train the network of the example, and return as `trained`; it flies at the rate of the task."""
    import torch

    from flypend.examples import gradient

    begin, started = time.process_time(), time.perf_counter()
    network, steps = gradient.train(task, seed)

    @torch.no_grad()
    def policy(worlds: Any, seen: Any) -> Any:
        return network(torch.from_numpy(seen[:, :24])).numpy()

    return Trained(policy, steps, time.process_time() - begin, time.perf_counter() - started)
