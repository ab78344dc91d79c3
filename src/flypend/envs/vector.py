"""Many worlds as one environment of gymnasium: a step is one call of compiled code."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from flypend import errors
from flypend.envs.state import Stateful
from flypend.errors import InputError
from flypend.plants.plant import are_seeds, check_seed


class VectorWorlds(Stateful, VectorEnv[Any, Any, Any]):
    """`num_envs` worlds, each reset in the step in which it ends, unless `autoreset_mode` says otherwise.

    The observations of such a step are the first of the new episodes. The last ones of the worlds that have ended are
    in `infos["final_obs"]`, at the rows marked in `infos["_final_obs"]`.

    Parameters
    ----------
    task, arguments
        See `flypend.envs.environment`.
    num_envs : int
        Number of worlds.
    copy : bool
        Whether observations, rewards and flags are copies. If not, they are the worlds' own memory, which each step,
        reset and `restore_state` overwrites in place. `infos` are copies in both cases.
    history, observation_delay : int
        See `World`.
    workers : int, optional
        Threads; default one per core.
    render_mode : "rgb_array", optional
        Makes `render` draw.
    autoreset_mode : AutoresetMode or str
        What happens to a world that ends, as in gymnasium. "SameStep": see above. "NextStep": this step returns its
        last observation; the next step ignores its action, resets it and returns reward 0. "Disabled": it waits for
        `reset` with `options={"reset_mask": which}`.

    Raises
    ------
    InputError
        As `flypend.envs.environment`.
    ResetNeeded
        If worlds are stepped that must be reset first.
    """

    metadata = Stateful.metadata | {"autoreset_mode": AutoresetMode.SAME_STEP}

    def __init__(
        self, task: Any = "balance", num_envs: int = 1, *, copy: bool = True, history: int = 0,
        observation_delay: int = 0, workers: int | None = None, render_mode: str | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.SAME_STEP, **arguments: Any,
    ) -> None:  # fmt: skip
        modes = {mode.value: mode for mode in AutoresetMode}
        named = getattr(autoreset_mode, "value", autoreset_mode)
        self._autoreset = modes[errors.one_of("autoreset_mode", named, modes)]
        self.num_envs = errors.integer("num_envs", num_envs, 1)
        threads = None if workers is None else errors.integer("workers", workers, 1)
        super().__init__(task, arguments, self.num_envs, history, observation_delay, render_mode, threads)
        self.metadata |= {"autoreset_mode": self._autoreset}
        self.copy, self.history = copy, self.worlds.history
        self.single_observation_space, self.single_action_space = self._spaces()
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)

    def reset(self, *, seed: Any = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin new episodes: world i with seed `seed` + i, or entry i of a list; without a seed, with new seeds.

        With a "reset_mask" (num_envs,) of bool in `options`, only those that it marks; the others stay as they are.
        """
        which = self._beginning_worlds(options)
        several = are_seeds(seed)
        if not several and seed is not None:
            check_seed("seed", seed)
        super().reset(seed=None if several or seed is None else int(seed))
        fresh = self.np_random.integers(2**62, size=self.num_envs)
        if several:
            fresh = self._own(seed, fresh)
        elif seed is not None:
            fresh = int(seed) + np.arange(self.num_envs)
        with self.worlds.hold(~which):
            self.worlds.begin(fresh)
            self.worlds.remember(which)
        return self._give(self.worlds.shown), {}

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Advance all worlds by `actions` (num_envs, m), each entry in [−1, 1]. Raises InputError for another shape."""
        self._check_begun()
        worlds = self.worlds
        if self._autoreset is AutoresetMode.SAME_STEP:
            worlds.step(actions)
            anew = over = worlds.terminated | worlds.truncated
        else:
            anew, over = self._step_and_wait(actions)
        infos: dict[str, Any] = {}
        if self._autoreset is AutoresetMode.SAME_STEP and over.any():
            infos = {"final_obs": worlds.last_observation(over), "_final_obs": over}
        worlds.remember(anew)
        results = (worlds.rewards, worlds.terminated, worlds.truncated)
        rewards, terminated, truncated = (self._give(result) for result in results)
        return self._give(worlds.shown), rewards, terminated, truncated, infos

    def _step_and_wait(self, actions: Any) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Advance the worlds that have not ended; return which begin anew by this step, and which it ends.

        The kernel begins a world in the step in which it ends. Until that is to be seen, the world is held, and its
        rows of `observations` and `last` are exchanged.
        """
        worlds = self.worlds
        waiting = worlds.terminated | worlds.truncated
        if self._autoreset is AutoresetMode.DISABLED and waiting.any():
            raise ResetNeeded(f"worlds {np.flatnonzero(waiting).tolist()} have ended: reset them by a reset_mask")
        with worlds.hold(waiting):
            worlds.step(actions)
        worlds.observations[waiting], worlds.rewards[waiting] = worlds.last[waiting], 0
        worlds.terminated[waiting], worlds.truncated[waiting] = False, False
        over = worlds.terminated | worlds.truncated
        worlds.observations[over], worlds.last[over] = worlds.last[over], worlds.observations[over]
        return waiting, over

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """Return a picture of each world, as `World.render`, or None without a `render_mode`.

        For a world that has ended, the picture shows the new beginning.
        """
        if self.render_mode is None:
            return None
        self._check_begun()
        return tuple(map(self._picture, self.worlds.times, self.worlds.states, self.worlds.goals))

    def _kind(self) -> str:
        return f"VectorWorlds, {self._autoreset.value}"

    def _beginning_worlds(self, options: dict[str, Any] | None) -> NDArray[np.bool_]:
        """Return which worlds (num_envs,) a reset with these options begins."""
        if not options or "reset_mask" not in options:
            return np.ones(self.num_envs, dtype=bool)
        mask = options["reset_mask"]
        if not (isinstance(mask, np.ndarray) and mask.dtype == np.bool_ and mask.shape == (self.num_envs,)):
            raise InputError("reset_mask", f"an array ({self.num_envs},) of bool", repr(mask))
        if not mask.all():
            self._check_begun()
        return mask

    def _own(self, seeds: Any, fresh: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return `seeds` (num_envs,), those that are None replaced by `fresh` ones."""
        if len(seeds) != self.num_envs:
            raise InputError("seed", f"an integer, or {self.num_envs} in a list", f"{len(seeds)}")
        for seed in seeds:
            if seed is not None:
                check_seed("seed", seed)
        return np.array([new if own is None else own for new, own in zip(fresh, seeds, strict=True)], dtype=np.int64)

    def _give(self, array: NDArray[Any]) -> NDArray[Any]:
        return array.copy() if self.copy else array
