"""Train a policy by PPO of Stable-Baselines3: to balance the rod, or for another task.

`python examples/train.py [TASK]` needs the extra rl and stable-baselines3, whose interface for many worlds is its own.
"""

from __future__ import annotations

import sys
import time
from typing import Any

import numpy as np
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecEnv, VecNormalize

from flypend.envs import VectorWorlds


class VecWorlds(VecEnv):
    """`VectorWorlds` as a VecEnv of Stable-Baselines3.

    Parameters
    ----------
    task, num_envs, arguments
        As in `VectorWorlds`.

    """

    def __init__(self, task: Any = "balance", num_envs: int = 1, **arguments: Any) -> None:
        self.worlds = VectorWorlds(task, num_envs, **arguments)
        super().__init__(num_envs, self.worlds.single_observation_space, self.worlds.single_action_space)
        self._actions: Any = None
        self._returns, self._lengths = np.zeros(num_envs), np.zeros(num_envs, dtype=int)

    def reset(self) -> Any:
        """Begin all worlds, with the seed given to `seed`, if any."""
        seed = self._seeds[0]
        self._reset_seeds()
        self._returns[:], self._lengths[:] = 0, 0
        return self.worlds.reset(seed=seed)[0]

    def step_async(self, actions: Any) -> None:
        """Keep the `actions` (num_envs, m) for `step_wait`."""
        self._actions = actions

    def step_wait(self) -> tuple[Any, Any, Any, list[dict[str, Any]]]:
        """Advance all worlds; those that have ended tell their last observation, return and length."""
        seen, rewards, terminated, truncated, infos = self.worlds.step(self._actions)
        over = terminated | truncated
        self._returns += rewards
        self._lengths += 1
        told: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for i in np.flatnonzero(over):
            told[i] = {
                "terminal_observation": infos["final_obs"][i],
                "TimeLimit.truncated": bool(truncated[i]),
                "episode": {"r": float(self._returns[i]), "l": int(self._lengths[i]), "t": 0.0},
            }
        self._returns[over], self._lengths[over] = 0, 0
        return seen, rewards, over, told

    def close(self) -> None:
        """Do nothing."""

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """Return the attribute of the worlds, which all share, once for each of `indices`."""
        return [getattr(self.worlds, attr_name, None) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Refuse: worlds share their attributes."""
        raise NotImplementedError(attr_name)

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:
        """Refuse: a world has no methods of its own."""
        raise NotImplementedError(method_name)

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        """Say of each world that it is not wrapped."""
        return [False for _ in self._get_indices(indices)]


def kept_up(model: PPO, task: Any, count: int, seed: int) -> float:
    """Share of `count` starts from which the rod stays up until the world is cut off."""
    worlds = VecWorlds(task, count)
    worlds.seed(seed)
    seen, up = worlds.reset(), np.ones(count, dtype=bool)
    for _ in range(worlds.worlds.worlds.env.limit):
        seen, _, over, infos = worlds.step(model.predict(seen, deterministic=True)[0])
        up &= ~np.array([o and not info["TimeLimit.truncated"] for o, info in zip(over, infos, strict=True)])
    return float(up.mean())


def train(task: Any = "balance", most: int = 18_000_000, wanted: float = 0.97) -> tuple[PPO, float]:
    """Train until the `wanted` share of 500 starts is kept up, or for `most` steps, the last quarter of them smaller.

    Return the policy, and the share of 1,000 other starts that it keeps up.
    """
    model = PPO(
        "MlpPolicy", VecNormalize(VecWorlds(task, 256), norm_obs=False), n_steps=64, batch_size=4096, n_epochs=8,
        learning_rate=1e-3, seed=0, policy_kwargs={"net_arch": [64, 64], "log_std_init": -1.0},
    )  # fmt: skip
    share = 0.0
    while share < wanted and model.num_timesteps < most:
        if model.num_timesteps > 0.75 * most:
            model.lr_schedule = lambda _: 2e-4
        model.learn(100_000, reset_num_timesteps=False)
        share = kept_up(model, task, 500, seed=10**6)
        print(f"{model.num_timesteps} steps: {100 * share:.1f} % stay up", flush=True)
    return model, kept_up(model, task, 1000, seed=2 * 10**6)


if __name__ == "__main__":
    task = sys.argv[1] if len(sys.argv) > 1 else "balance"
    model, share = train(task)
    print(f"{100 * share:.1f} % of 1,000 other starts stay up, after {time.process_time():.0f} s of processor time")
    model.save(task)
