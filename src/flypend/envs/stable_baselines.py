"""The worlds as a vector environment of Stable-Baselines3, which has an interface of its own."""

from __future__ import annotations

from typing import Any

import numpy as np

from flypend.envs.vector import VectorWorlds
from flypend.errors import require

require("stable_baselines3", extra="rl", for_="flypend.envs.stable_baselines")

from stable_baselines3.common.vec_env.base_vec_env import VecEnv  # noqa: E402


class VecWorlds(VecEnv):  # type: ignore[misc, unused-ignore]
    """`VectorWorlds` as a VecEnv of Stable-Baselines3.

    Parameters
    ----------
    task, num_envs, arguments
        As in `VectorWorlds`.

    Raises
    ------
    InputError
        As `VectorWorlds`.
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
