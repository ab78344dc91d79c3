"""Many worlds as one environment of gymnasium: a step is one call of compiled code."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from flypend import errors
from flypend.envs.kernel import Worlds
from flypend.envs.make import check_render_mode, environment, spaces
from flypend.envs.state import Stateful
from flypend.errors import InputError
from flypend.plants.plant import check_seed


class VectorWorlds(Stateful, VectorEnv[Any, Any, Any]):
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
        Whether observations, rewards and flags are copies, which nothing changes; otherwise they are the worlds' own
        memory, which each step, reset and `restore_state` overwrites in place. `infos` are copies in both cases.
    history : int
        Number of earlier observations that follow the present one in a row, latest first.
    workers : int, optional
        Threads; default one per core.
    render_mode : None
        No other is known.

    Raises
    ------
    InputError
        As `flypend.envs.environment`.
    ResetNeeded
        If they are stepped before they are reset.
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
        render_mode: None = None,
        **arguments: Any,
    ) -> None:
        check_render_mode(render_mode)
        self.num_envs = errors.integer("num_envs", num_envs, 1)
        self.history = errors.integer("history", history, 0)
        threads = None if workers is None else errors.integer("workers", workers, 1)
        super().__init__(Worlds(environment(task, **arguments), self.num_envs, threads, self.history))
        self.copy, self._length = copy, self.worlds.observations.shape[1]
        self.single_observation_space, self.single_action_space = spaces(self.worlds.env, self.worlds.seen.shape[1])
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)

    def reset(self, *, seed: Any = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin all worlds: world i with `seed` + i, or with its own of a list; without a seed, with new ones."""
        several = isinstance(seed, list | tuple | np.ndarray)
        if not several and seed is not None:
            check_seed("seed", seed)
        super().reset(seed=None if several or seed is None else int(seed))
        fresh = self.np_random.integers(2**62, size=self.num_envs)
        if several:
            fresh = self._own(seed, fresh)
        elif seed is not None:
            fresh = int(seed) + np.arange(self.num_envs)
        self.worlds.begin(fresh)
        if self.history:
            self.worlds.seen[:] = np.tile(self.worlds.observations, 1 + self.history)
        return self._given(self.worlds.seen), {}

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Advance all worlds by `actions` (num_envs, m), each entry in [−1, 1]. Raises InputError for another shape."""
        if not self.worlds.begun:
            raise ResetNeeded("reset the worlds first")
        worlds = self.worlds
        worlds.step(actions)
        over = worlds.terminated | worlds.truncated
        infos: dict[str, Any] = {}
        if over.any():
            infos = {"final_obs": self._last(over), "_final_obs": over}
        if self.history:
            worlds.seen[:, self._length :] = worlds.seen[:, : -self._length].copy()
            worlds.seen[:, : self._length] = worlds.observations
            worlds.seen[over] = np.tile(worlds.observations[over], 1 + self.history)
        results = (worlds.rewards, worlds.terminated, worlds.truncated)
        rewards, terminated, truncated = (self._given(result) for result in results)
        return self._given(worlds.seen), rewards, terminated, truncated, infos

    def _own(self, seeds: Any, fresh: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return `seeds` (num_envs,), those that are None replaced by `fresh` ones."""
        if len(seeds) != self.num_envs:
            raise InputError("seed", f"an integer, or {self.num_envs} in a list", f"{len(seeds)}")
        for seed in seeds:
            if seed is not None:
                check_seed("seed", seed)
        return np.array([new if own is None else own for new, own in zip(fresh, seeds, strict=True)], dtype=np.int64)

    def _last(self, over: NDArray[np.bool_]) -> NDArray[np.float32]:
        last = np.zeros_like(self.worlds.seen)
        last[over, : self._length] = self.worlds.last[over]
        if self.history:
            last[over, self._length :] = self.worlds.seen[over, : -self._length]
        return last

    def _given(self, array: NDArray[Any]) -> NDArray[Any]:
        return array.copy() if self.copy else array
