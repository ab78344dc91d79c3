"""Many worlds as one environment of gymnasium: a step is one call of compiled code."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from flypend.envs.kernel import Worlds
from flypend.envs.make import environment, spaces
from flypend.errors import InputError


class VectorWorlds(VectorEnv[Any, Any, Any]):
    """`num_envs` worlds, which begin anew in the step in which they end.

    The observations of a step are then those of the new beginnings; the last ones of the worlds that have ended are in
    `infos["final_obs"]`, at the rows marked in `infos["_final_obs"]`.

    Parameters
    ----------
    task, arguments
        See `flypend.envs.environment`.
    num_envs : int
        Number of worlds.
    copy : bool
        Whether arrays are copied; otherwise each step overwrites those of the step before, and no memory is moved.
    history : int
        Number of earlier observations that follow the present one in a row, latest first.
    workers : int, optional
        Threads; default one per core.

    Raises
    ------
    InputError
        As `flypend.envs.environment`.
    """

    metadata = {"autoreset_mode": AutoresetMode.SAME_STEP, "render_modes": []}  # noqa: RUF012

    def __init__(
        self,
        task: Any = "balance",
        num_envs: int = 1,
        *,
        copy: bool = True,
        history: int = 0,
        workers: int | None = None,
        **arguments: Any,
    ) -> None:
        if not isinstance(num_envs, int | np.integer) or num_envs < 1:
            raise InputError("num_envs", "an integer >= 1", repr(num_envs))
        self.worlds = Worlds(environment(task, **arguments), int(num_envs), workers)
        self.num_envs, self.copy, self.history = int(num_envs), copy, history
        self._length = self.worlds.observations.shape[1]
        self._seen = np.zeros((self.num_envs, (1 + history) * self._length), dtype=np.float32)
        self.single_observation_space, self.single_action_space = spaces(self.worlds.env, self._seen.shape[1])
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin all worlds: world i with `seed` + i, or with its own of a list; without a seed, with new ones."""
        super().reset(seed=seed if isinstance(seed, int) else None)
        fresh = self.np_random.integers(2**62, size=self.num_envs)
        if isinstance(seed, int | np.integer):
            fresh = int(seed) + np.arange(self.num_envs)
        elif seed is not None:
            fresh = np.array([new if given is None else given for new, given in zip(fresh, seed, strict=True)])
        self.worlds.begin(fresh.astype(np.int64))
        self._seen[:] = np.tile(self.worlds.observations, 1 + self.history)
        return self._given(self._observations()), {}

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Advance all worlds by `actions` (num_envs, m), each entry in [−1, 1]."""
        worlds = self.worlds
        worlds.step(actions)
        over = worlds.terminated | worlds.truncated
        infos: dict[str, Any] = {}
        if over.any():
            infos = {"final_obs": self._last(over), "_final_obs": over}
        if self.history:
            self._seen[:, self._length :] = self._seen[:, : -self._length].copy()
            self._seen[:, : self._length] = worlds.observations
            self._seen[over] = np.tile(worlds.observations[over], 1 + self.history)
        results = (worlds.rewards, worlds.terminated, worlds.truncated)
        rewards, terminated, truncated = (self._given(result) for result in results)
        return self._given(self._observations()), rewards, terminated, truncated, infos

    def _observations(self) -> NDArray[np.float32]:
        return self._seen if self.history else self.worlds.observations

    def _last(self, over: NDArray[np.bool_]) -> NDArray[np.float32]:
        last = np.zeros_like(self._seen)
        last[over, : self._length] = self.worlds.last[over]
        if self.history:
            last[over, self._length :] = self._seen[over, : -self._length]
        return last

    def _given(self, array: NDArray[Any]) -> NDArray[Any]:
        return array.copy() if self.copy else array
