"""Worlds for Stable-Baselines3 and libraries built on it, such as sbx, which have a vector interface of their own."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode

from flypend.envs.vector import VectorWorlds
from flypend.errors import InputError

try:
    from stable_baselines3.common.vec_env import VecEnv, VecMonitor
except ModuleNotFoundError as _missing:
    _wanted = "Stable-Baselines3 (pip install stable-baselines3)"
    raise InputError("flypend.envs.sb3", _wanted, f"no module {_missing.name}") from None

__all__ = ["VecWorlds", "make_vec_env"]


def make_vec_env(
    env_id: str, n_envs: int = 1, seed: int | None = None, env_kwargs: Mapping[str, Any] | None = None,
    monitor_dir: str | Path | None = None,
) -> Any:  # fmt: skip
    """Make worlds as `stable_baselines3.common.env_util.make_vec_env` does, but all in one call of compiled code.

    Parameters
    ----------
    env_id : str
        As in `gymnasium.make`: "flypend/Balance-v0".
    n_envs : int
        Number of worlds.
    seed : int, optional
        World i begins with `seed` + i.
    env_kwargs : dict, optional
        Arguments of the environment: see `flypend.envs.VectorWorlds`. Pictures can be drawn unless its `render_mode`
        is None.
    monitor_dir : str or Path, optional
        Folder for the file worlds.monitor.csv: return, length and time of each episode.

    Returns
    -------
    VecEnv
        `VecWorlds` in a VecMonitor, so that the library logs returns and lengths.

    Raises
    ------
    InputError
        If an argument is unknown or out of range.
    """
    arguments = {"render_mode": "rgb_array"} | dict(env_kwargs or {})
    worlds = gymnasium.make_vec(env_id, n_envs, vectorization_mode="vector_entry_point", **arguments)
    made = VecWorlds(cast("VectorWorlds", worlds.unwrapped))
    if seed is not None:
        made.seed(seed)
    return VecMonitor(made, None if monitor_dir is None else str(Path(monitor_dir) / "worlds"))


class VecWorlds(VecEnv):  # type: ignore[misc]
    """Worlds as a VecEnv, whose `reset` and `step` return arrays of observations and the last ones in `infos`.

    Parameters
    ----------
    worlds : VectorWorlds
        Worlds that are reset in the step in which they end, and return copies of their arrays.

    Raises
    ------
    InputError
        If the worlds have another `autoreset_mode`, or do not copy.
    """

    def __init__(self, worlds: VectorWorlds) -> None:
        if worlds.metadata["autoreset_mode"] is not AutoresetMode.SAME_STEP:
            raise InputError("autoreset_mode", "SameStep", worlds.metadata["autoreset_mode"].value)
        if not worlds.copy:
            raise InputError("copy", "True: the library keeps what a step returns", "False")
        self.worlds = worlds
        super().__init__(worlds.num_envs, worlds.single_observation_space, worlds.single_action_space)
        self._actions: Any = None

    def reset(self) -> Any:
        """Begin all worlds, each with the seed that `seed` has given it, if any; return observations (num_envs, k)."""
        seen, _ = self.worlds.reset(seed=self._seeds)
        self._reset_seeds()
        self._reset_options()
        return seen

    def step_async(self, actions: Any) -> None:
        """Keep the `actions` (num_envs, m) for `step_wait`."""
        self._actions = actions

    def step_wait(self) -> tuple[Any, Any, Any, list[dict[str, Any]]]:
        """Advance all worlds; return observations, rewards, which are over, and a dict for each.

        Of a world that is over the dict has its last observation as "terminal_observation", and whether it was cut
        off as "TimeLimit.truncated".
        """
        seen, rewards, terminated, truncated, last = self.worlds.step(self._actions)
        over = terminated | truncated
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for i in np.flatnonzero(over):
            cut = bool(truncated[i] and not terminated[i])
            infos[i] = {"terminal_observation": last["final_obs"][i], "TimeLimit.truncated": cut}
        return seen, rewards, over, infos

    def close(self) -> None:
        """Close the worlds."""
        self.worlds.close()

    def get_images(self) -> list[Any]:
        """Return a picture (480, 480, 3) of each world; None without a render_mode."""
        return list(self.worlds.render() or [None] * self.num_envs)

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """Return the attribute `attr_name` of the worlds, which all share, once for each of `indices`."""
        return [getattr(self.worlds, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Refuse: worlds share their attributes, so none can have a `value` of `attr_name` at `indices` alone."""
        raise NotImplementedError(f"worlds share their attributes: make them with another {attr_name}")

    def env_method(self, method_name: str, *method_args: Any, indices: Any = None, **method_kwargs: Any) -> list[Any]:
        """Refuse: a world of many has no method `method_name` to call at `indices`, whatever the arguments."""
        raise NotImplementedError(f"a world of many has no methods of its own, such as {method_name}")

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        """Say of each world of `indices` that it is not wrapped by `wrapper_class`."""
        return [False for _ in self._get_indices(indices)]
