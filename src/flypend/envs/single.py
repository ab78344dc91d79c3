"""One world as an environment of gymnasium."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium.error import ResetNeeded

from flypend.compile.llvm.worlds import BOUND, BY_TASK, LOST
from flypend.envs.state import Stateful
from flypend.errors import InputError
from flypend.flight.outcome import Outcome
from flypend.flight.touch import reason_of
from flypend.flight.trajectory import Trajectory
from flypend.model import State
from flypend.model.state import SIZE
from flypend.plants.plant import check_seed

EVERY = np.ones(1, dtype=bool)  # of one world


class World(Stateful, gymnasium.Env[Any, Any]):
    """One world. With a seed it begins and flies bit-identically to world 0 of the vector environment.

    Parameters
    ----------
    task, arguments
        See `flypend.envs.environment`.
    history : int
        Number of earlier observations that follow the latest one in a row, latest first. At the beginning of an episode
        they are copies of its first observation.
    observation_delay : int
        Number of actions by which observations are late, at most 1,000. Step k then returns the row that step k minus
        this number would have returned without delay, last action and goal included. Rewards and ends are never late.
    render_mode : "rgb_array", optional
        Makes `render` draw.

    Raises
    ------
    InputError
        As `flypend.envs.environment`.
    ResetNeeded
        If it is stepped before it is reset, or after its episode has ended.
    """

    def __init__(
        self, task: Any = "balance", *, history: int = 0, observation_delay: int = 0, render_mode: str | None = None,
        **arguments: Any,
    ) -> None:  # fmt: skip
        super().__init__(task, arguments, 1, history, observation_delay, render_mode)
        self.observation_space, self.action_space = self._spaces()
        self._flown: list[Any] = []
        self._goal = self.worlds.goals[0]

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin a new episode with `seed`, or with the next one from the generator that the last seed initialised."""
        if seed is not None:
            check_seed("seed", seed)
            seed = int(seed)
        super().reset(seed=seed)
        fresh = int(self.np_random.integers(2**62)) if seed is None else seed
        self.worlds.begin(np.array([fresh], dtype=np.int64))
        self.worlds.remember(EVERY)
        self._flown, self._goal = [self.worlds.states[0]], self.worlds.goals[0]
        return self.worlds.shown[0].copy(), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Advance by `action` (m,), each entry in [−1, 1]. Raises InputError for another shape."""
        self._check_begun()
        worlds, action = self.worlds, np.asarray(action)
        if worlds.terminated[0] or worlds.truncated[0]:
            raise ResetNeeded("the episode has ended: reset the environment")
        if action.shape != (worlds.env.actions,):
            raise InputError("actions", f"real numbers of shape ({worlds.env.actions},)", f"shape {action.shape}")
        worlds.step(action[None])
        terminated, truncated = bool(worlds.terminated[0]), bool(worlds.truncated[0])
        over = worlds.terminated | worlds.truncated
        last = worlds.last_observation(over)
        worlds.remember(over)
        state = (worlds.ends if over[0] else worlds.states)[0]
        if np.isfinite(state).all():
            self._flown.append(state.copy())
        seen = (last if over[0] else worlds.shown)[0].copy()
        return seen, float(worlds.rewards[0]), terminated, truncated, {}

    def render(self) -> Any:
        """Return a picture (480, 480, 3) of uint8 of the present, or None without a `render_mode`.

        The camera follows the vehicle along a grid of 0.5 m; a line leads to the goal. For a world that has ended, the
        picture shows its last state.
        """
        self._check_begun()
        if self.render_mode is None:
            return None
        return self._picture((len(self._flown) - 1) / self.worlds.env.rate, self._flown[-1], self._goal)

    def _save_flown(self) -> bytes:
        return np.concatenate([self._goal, *self._flown]).tobytes()

    def _restore_flown(self, flown: bytes) -> None:
        numbers = np.frombuffer(flown)
        self._goal, states = np.split(numbers, [len(self._goal)])
        self._flown = list(states.reshape(-1, self.worlds.states.shape[1]))

    def trajectory(self) -> Trajectory:
        """Return what has been flown since the last `reset` as a run, a state per action: for pages and figures.

        A last state that is not finite is left out. The outcome is "collided" or "diverged" as that of a flight, and
        "completed", with the reason, if the task has ended the episode.
        """
        self._check_begun()
        env, states = self.worlds.env, np.array(self._flown)
        forces = states[:, SIZE:]
        wrench = forces @ env.plant.true_vehicle(env.vehicle).mixing().T
        named = State.trusted(states[:, :SIZE])
        return Trajectory(
            t=np.arange(len(states)) / env.rate, **{name: getattr(named, name) for name in vars(named)},
            thrust=wrench[:, 0], moment=wrench[:, 1:], rotor_forces=forces, drift=np.zeros((0, 3)),
            outcome=self._outcome((len(states) - 1) / env.rate), e3="up", vehicle=env.vehicle,
            law=f"actions in {env.task.name}", gains={},
        )  # fmt: skip

    def _outcome(self, time: float) -> Outcome:
        """How the episode has ended at this `time`, s."""
        env, cause = self.worlds.env, self.worlds.causes[0]
        if not self.worlds.terminated[0]:
            return Outcome("completed", time)
        if cause == BY_TASK:
            return Outcome("completed", time, f"the task {env.task.name} ended the episode")
        if cause == LOST:
            return Outcome("diverged", time, f"state or action was not finite, or the state left |s| < {BOUND:g}")
        return Outcome("collided", time, reason_of(env.vehicle, int(cause)))
