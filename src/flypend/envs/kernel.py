"""Compiled worlds, stepped by all cores."""

from __future__ import annotations

import ctypes
import hashlib
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import fields
from functools import cache
from importlib import metadata
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.building import built
from flypend.compile.llvm import jit
from flypend.compile.llvm.worlds import ARGUMENTS, INTEGERS, kernel_module
from flypend.compile.numeric import allocate_aligned
from flypend.compile.problem import WorldsProblem
from flypend.envs.problem import Environment, problem
from flypend.errors import InputError
from flypend.model.state import SIZE

WIDTH = 8
# Fewest groups of worlds worth a thread: a hundred microseconds of work.
LEAST_GROUPS = 16
MOST_THREADS = 1024  # a bound that no machine reaches; they start one by one
# Of the kernel's arguments.
KINDS = [ctypes.c_int64 if name in INTEGERS else ctypes.c_void_p for name in ARGUMENTS]


@built(maxsize=32)
def compile_worlds(made: WorldsProblem) -> jit.Native:
    """Return the kernel of `made`, compiled or from the cache."""
    return jit.build(f"worlds, {WIDTH} lanes: {made!r}", lambda: kernel_module(made, WIDTH), "kernel", KINDS)


@cache
def _pool() -> ThreadPoolExecutor:
    """The threads that all worlds of this process share; as many are started as ever work at once."""
    return ThreadPoolExecutor(MOST_THREADS, "flypend-worlds")


def shares_of(groups: int, workers: int | None = None) -> list[tuple[int, int]]:
    """Return the first group and the number of groups of each thread; `workers` is the most threads, default cores."""
    threads = max(1, min(workers or os.cpu_count() or 1, groups // LEAST_GROUPS))
    bounds = np.linspace(0, groups, threads + 1).astype(int)
    return list(zip(bounds[:-1].tolist(), np.diff(bounds).tolist(), strict=True))


def in_threads(work: Callable[[int, int], None], shares: Sequence[tuple[int, int]]) -> None:
    """Call `work(first, count)` for each of the `shares`, all at once."""
    *others, mine = shares
    waiting = [_pool().submit(work, *share) for share in others]
    work(*mine)
    wait(waiting)


if hasattr(os, "register_at_fork"):  # a forked process has none of the threads
    os.register_at_fork(after_in_child=_pool.cache_clear)


def _own(array: NDArray[Any]) -> NDArray[Any]:
    """Return a copy of `array` at the start of a cache line: JAX copies any other."""
    own: NDArray[Any] = allocate_aligned(array.shape, array.dtype)
    own[...] = array
    return own


def _rows(name: str) -> Any:
    """Return the property that is the array of this name, without the worlds that fill the last group."""
    return property(lambda worlds: worlds.arrays[name][: worlds.count])


class Worlds:
    """`count` worlds of `env`, and the arrays that a step fills.

    `observations` (count, k) and `rewards` (count,) are float32, `terminated` and `truncated` (count,) bool. A world
    that ends begins anew in the same step: its row of `observations` is that of its new beginning, and its row of
    `last` (count, k) is what would have been observed at the end; those of `ends` (count, 24 + n) and `causes` (count,)
    are its last state with rotor forces, and why it ended (see `compile.llvm.worlds`). `seen` (count, (n + 1) k), which
    `remember` fills, is what a learner gets: one observation, `late` by as many actions, and a `history` of n earlier
    ones.

    All that changes is in `arrays`, a table of plain arrays that nothing else owns. A pickle holds them and what the
    worlds are made of; the rest is made again where it is loaded.
    """

    observations, last, rewards = _rows("observations"), _rows("last"), _rows("rewards")
    terminated, truncated = _rows("terminated"), _rows("truncated")
    ends, causes = _rows("ends"), _rows("causes")

    def __init__(
        self, env: Environment, count: int, workers: int | None = None, history: int = 0, late: int = 0
    ) -> None:
        made = problem(env)
        self.env, self.count, self.workers, self.history, self.late = env, count, workers, history, late
        self._step, self._places = compile_worlds(made), made.places
        groups = -(-count // WIDTH)
        padded, seen = groups * WIDTH, len(made.observe.outputs[0])
        shapes: dict[str, tuple[Any, ...]] = {
            "memories": (groups, 2 + self._places["end"], WIDTH, np.float64),
            "seeds": (padded, np.int64),
            "actions": (padded, env.actions, np.float32),
            "observations": (padded, seen, np.float32),
            "rewards": (padded, np.float32),
            "terminated": (padded, np.bool_),
            "truncated": (padded, np.bool_),
            "last": (padded, seen, np.float32),
            "ends": (padded, SIZE + env.rotors, np.float64),
            "causes": (padded, np.float64),
            "recent": (padded if history or late else 0, (1 + history + late) * seen, np.float32),
            "seen": (padded if late else 0, (1 + history) * seen, np.float32),
        }
        self.arrays = {name: _own(np.zeros(shape, kind)) for name, (*shape, kind) in shapes.items()}
        self._shares = shares_of(groups, workers)
        parts = {entry.name: repr(getattr(env, entry.name)) for entry in fields(env)}
        self.about = {"version": metadata.version("flypend")} | parts | {
            "task": env.task.name, "vehicle": env.vehicle.name, "worlds": str(count), "history": str(history),
            "observation_delay": str(late),
            "programs": hashlib.sha256(repr((made, env.limit)).encode()).hexdigest(),
        }  # fmt: skip

    def __deepcopy__(self, memo: Any) -> Worlds:
        twin = object.__new__(Worlds)
        arrays = {name: _own(array) for name, array in self.arrays.items()}
        vars(twin).update(vars(self) | {"arrays": arrays})
        return twin

    def __reduce__(self) -> tuple[Any, ...]:
        made = self.env, self.count, self.workers, self.history, self.late
        return _unpickle, (self.about, self.save(), *made)

    def save(self) -> bytes:
        """Return the contents of `arrays`, one after the other."""
        return b"".join(array.tobytes() for array in self.arrays.values())

    def restore(self, about: Mapping[str, str], saved: bytes) -> None:
        """Fill `arrays`, where they are, with what `save` returned of worlds `about` which the same is to be said.

        Raises InputError if `about` or the length differs.
        """
        for name, mine in self.about.items():
            if about.get(name) != mine:
                raise InputError(f"state.{name}", mine, about.get(name, "nothing"))
        length = sum(array.nbytes for array in self.arrays.values())
        if len(saved) != length:
            raise InputError("state.worlds", f"{length} bytes", f"{len(saved)}")
        begin = 0
        for array in self.arrays.values():
            array.reshape(-1)[:] = np.frombuffer(saved, array.dtype, array.size, begin)
            begin += array.nbytes

    @property
    def begun(self) -> bool:
        """Whether they have begun: the number of the first world's episode is above 0."""
        return bool(self.arrays["memories"][0, 1, 0] > 0)

    @property
    def shown(self) -> NDArray[np.float32]:
        """What a learner gets (count, (history + 1) k)."""
        return self.arrays["seen" if self.late else "recent" if self.history else "observations"][: self.count]

    def remember(self, anew: NDArray[np.bool_]) -> None:
        """Put the present observations before the earlier ones; worlds that begin `anew` (count,) have no others."""
        recent, k = self.arrays["recent"][: self.count], self.observations.shape[1]
        if len(recent):
            recent[:, k:] = recent[:, :-k].copy()
            recent[:, :k] = self.observations
            recent[anew] = np.tile(self.observations[anew], recent.shape[1] // k)
        if self.late:
            self.shown[:] = recent[:, self.late * k :]

    def last_observation(self, over: NDArray[np.bool_]) -> NDArray[np.float32]:
        """Return what a learner gets (count, (history + 1) k) at the end of the worlds `over`; 0 elsewhere.

        To be called before `remember`.
        """
        shown, k = np.zeros_like(self.shown), self.observations.shape[1]
        rows = self.last[over]
        if len(recent := self.arrays["recent"][: self.count]):
            rows = np.concatenate([rows, recent[over, :-k]], axis=1)
        shown[over] = rows[:, self.late * k :]
        return shown

    def begin(self, seeds: NDArray[np.int64]) -> None:
        """Begin all worlds, with a seed (count,) each; world i draws the same numbers whatever surrounds it."""
        self.arrays["seeds"][: self.count] = seeds
        self.arrays["seeds"][self.count :] = seeds[-1]
        self.terminated[:], self.truncated[:] = False, False
        self._call(fresh=1)

    def step(self, actions: Any) -> None:
        """Advance all worlds by `actions` (count, m), each entry in [−1, 1]; one that is not finite ends its world.

        Raises InputError for another shape, or anything but real numbers.
        """
        mine, given = self.arrays["actions"][: self.count], np.asarray(actions)
        if given.shape != mine.shape or not np.can_cast(given.dtype, np.float32, "same_kind"):
            raise InputError("actions", f"real numbers of shape {mine.shape}", f"{given.dtype} of shape {given.shape}")
        with np.errstate(over="ignore"):  # a number beyond single precision is infinite
            mine[:] = given
        self._call(fresh=0)

    @contextmanager
    def hold(self, which: NDArray[np.bool_]) -> Iterator[None]:
        """Keep the worlds `which` (count,) as they are, whatever is done to all of them inside."""
        worlds = np.flatnonzero(which)
        groups, lanes = np.divmod(worlds, WIDTH)
        own = {name: (groups, slice(None), lanes) if name == "memories" else worlds for name in self.arrays}
        kept = {name: self.arrays[name][place] for name, place in own.items() if len(self.arrays[name])}
        yield
        for name, values in kept.items():
            self.arrays[name][own[name]] = values

    def _call(self, fresh: int) -> None:
        addresses = {name: array.ctypes.data for name, array in self.arrays.items()}
        given = addresses | {"limit": self.env.limit, "fresh": fresh}

        def work(first: int, count: int) -> None:
            values = given | {"first": first, "count": count}
            self._step(*(values[name] for name in ARGUMENTS))

        in_threads(work, self._shares)

    def part(self, name: str, length: int) -> NDArray[np.float64]:
        """Return a copy of a part of the worlds' memories (count, `length`); see `WorldsProblem.places`."""
        begin = 2 + self._places[name]
        part = self.arrays["memories"][:, begin : begin + length]
        return part.transpose(0, 2, 1).reshape(len(part) * WIDTH, length)[: self.count].copy()

    @property
    def states(self) -> NDArray[np.float64]:
        """States and rotor forces (count, 24 + n), a copy, e₃ up."""
        return self.part("state", SIZE + self.env.rotors)

    @property
    def goals(self) -> NDArray[np.float64]:
        """The numbers of their goals (count, k), a copy: those of `Task.goal`."""
        return self.part("goal", self._places["estimate"] - self._places["goal"])

    @property
    def times(self) -> NDArray[np.float64]:
        """Times since they began (count,), s."""
        return self.arrays["memories"][:, 0].reshape(-1)[: self.count] / self.env.rate


def _unpickle(about: Mapping[str, str], saved: bytes, *made: Any) -> Worlds:
    worlds = Worlds(*made)
    worlds.restore(about, saved)
    return worlds
