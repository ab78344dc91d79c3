"""What one world and many have in common as environments of gymnasium: arguments, spaces, pictures and their state.

The state at a moment is a record: kept, compared, sent elsewhere, and gone on from.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass, replace
from typing import Any, Self
from zlib import crc32

import casadi as ca
import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.spaces import Box
from gymnasium.utils import seeding
from numpy.typing import NDArray

from flypend import errors
from flypend.compile.llvm.worlds import BOUND
from flypend.envs.kernel import Worlds
from flypend.envs.make import environment_for
from flypend.envs.rendering import MODES, picture
from flypend.errors import InputError

MOST_KEPT = 1000  # observations: ten seconds at 100 Hz, and 100 kB a world


@dataclass(frozen=True)
class SavedState:
    """State of an environment at one moment. Two are equal if the environment would go on from both in the same way.

    Parameters
    ----------
    about : tuple of (str, str)
        The environment: version, task, vehicle, number of worlds and all else that must agree.
    worlds : bytes
        Arrays of the worlds; see `flypend.envs.kernel.Worlds`.
    flown : bytes
        The goal and the states since the last reset, of a single world.
    generator : str
        State of `np_random`, which draws the seeds of resets without one, and its seed, as JSON.
    checksum : int
        CRC-32 of the rest.
    """

    about: tuple[tuple[str, str], ...]
    worlds: bytes
    flown: bytes
    generator: str
    checksum: int = 0

    def with_checksum(self) -> SavedState:
        """Return the same record with the checksum that it should have."""
        text = repr((self.about, self.generator, len(self.flown)))
        return replace(self, checksum=crc32(self.worlds, crc32(self.flown, crc32(text.encode()))))


class Stateful:
    """An environment of gymnasium whose state is that of `worlds`, its generator, and what it has flown.

    Copies by `copy`, `pickle` and `cloudpickle`, and those in a forked process, share nothing with it.
    """

    metadata: dict[str, Any] = {"render_modes": list(MODES), "render_fps": 100}  # noqa: RUF012
    np_random: Any
    np_random_seed: Any
    _np_random: Any
    _np_random_seed: Any

    def __init__(
        self, task: Any, arguments: Mapping[str, Any], count: int, history: Any, observation_delay: Any,
        render_mode: Any, workers: int | None = None,
    ) -> None:  # fmt: skip
        if render_mode is not None and render_mode not in MODES:
            wanted = "None or 'rgb_array'; make also knows 'rgb_array_list' and 'human'"
            raise InputError("render_mode", wanted, repr(render_mode))
        earlier = errors.integer("history", history, 0, MOST_KEPT)
        late = errors.integer("observation_delay", observation_delay, 0, MOST_KEPT)
        self.worlds = Worlds(environment_for(type(self), task, arguments), count, workers, earlier, late)
        self.render_mode = render_mode
        self.metadata = type(self).metadata | {"render_fps": self.worlds.env.rate}
        # Else it is seeded when first used, by each copy differently.
        self._np_random, self._np_random_seed = seeding.np_random()

    def _spaces(self) -> tuple[Box, Box]:
        """Return the spaces of the observations and of the actions of one world."""
        observed = Box(-BOUND, BOUND, self.worlds.shown.shape[1:], np.float32)
        return observed, Box(-1.0, 1.0, (self.worlds.env.actions,), np.float32)

    def _check_begun(self) -> None:
        if not self.worlds.begun:
            raise ResetNeeded("reset the environment first")

    def _picture(self, time: float, state: NDArray[np.float64], goal: NDArray[np.float64]) -> NDArray[np.uint8]:
        """Return a picture of a world in a `state` (24 + n,) at a `time`, s, whose `goal` has these numbers (k,)."""
        env = self.worlds.env
        place = env.task.goal(ca.SX(time), ca.SX(goal))[0]
        return picture(env.vehicle, state, np.array(ca.evalf(ca.SX(place))).ravel())

    def __copy__(self) -> Self:
        return deepcopy(self)

    def save_state(self) -> SavedState:
        """Return the present state of the environment, to be restored in it or in another with the same arguments.

        Generators of the spaces, from which actions are sampled, and the counts of wrappers are not part of it: copy
        a wrapped environment whole.
        """
        generator = json.dumps([self.np_random.bit_generator.state, self.np_random_seed], default=np.ndarray.tolist)
        about = ("kind", self._kind()), *self.worlds.about.items()
        return SavedState(about, self.worlds.save(), self._save_flown(), generator).with_checksum()

    def restore_state(self, state: SavedState) -> None:
        """Restore a `state` that was saved from an environment with the same arguments, and continue from there.

        Arrays that steps overwrite (`copy=False`) stay in place, and get the contents that they had then.

        Raises
        ------
        InputError
            If it is not such a state, is damaged, or belongs to another kind, version, task, vehicle, plant or number
            of worlds, or to an environment that differs in any other way. Nothing is restored then.
        """
        if not isinstance(state, SavedState):
            raise InputError("state", "what save_state returned", type(state).__name__)
        if state != state.with_checksum():
            raise InputError("state", "what save_state returned", "one that is damaged")
        about = dict(state.about)
        kind = about.pop("kind", "nothing")
        if kind != self._kind():
            raise InputError("state.kind", self._kind(), kind)
        numbers, seed = json.loads(state.generator)
        bits = self.np_random.bit_generator
        if numbers["bit_generator"] != bits.state["bit_generator"]:
            raise InputError("state.generator", bits.state["bit_generator"], numbers["bit_generator"])
        self.worlds.restore(about, state.worlds)
        self._restore_flown(state.flown)
        bits.state, self._np_random_seed = numbers, seed

    def _kind(self) -> str:
        return type(self).__name__

    def _save_flown(self) -> bytes:
        return b""

    def _restore_flown(self, flown: bytes) -> None:
        pass
