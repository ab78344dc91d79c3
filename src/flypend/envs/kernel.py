"""Compiled worlds, stepped by all cores."""

from __future__ import annotations

import ctypes
import os
from concurrent.futures import ThreadPoolExecutor, wait
from functools import lru_cache
from typing import Any

import numpy as np
from llvmlite import ir
from numpy.typing import NDArray

from flypend.compile.llvm import jit
from flypend.compile.llvm.stepped_worlds import ARGUMENTS, INTEGERS, write_worlds
from flypend.compile.llvm.vector import Lanes
from flypend.compile.worlds_problem import WorldsProblem
from flypend.envs.problem import Environment, problem
from flypend.errors import InputError
from flypend.flight.kernels.flown import aligned

WIDTH = 8
# Fewest groups of worlds worth a thread: a hundred microseconds of work.
LEAST_GROUPS = 16
# Of the kernel's arguments.
KINDS = [ctypes.c_int64 if name in INTEGERS else ctypes.c_void_p for name in ARGUMENTS]


@lru_cache(maxsize=32)
def compiled(made: WorldsProblem) -> jit.Native:
    """Return the kernel of `made`, compiled or from the cache."""
    return jit.build(f"worlds, {WIDTH} lanes: {made!r}", lambda: module(made), "kernel", KINDS)


def module(made: WorldsProblem) -> ir.Module:
    """Return the module with the kernel of `made`, before it is compiled."""
    lanes = Lanes(ir.Module("flypend"), WIDTH)
    write_worlds(lanes, made)
    return lanes.module


def zeros(shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
    """Return an array of zeros at the start of a cache line: JAX copies any other."""
    array: NDArray[Any] = aligned(shape, kind)
    array[...] = 0
    return array


class Worlds:
    """`count` worlds of `env`, and the arrays that a step fills.

    `observations` (count, k) and `rewards` (count,) are float32, `terminated` and `truncated` (count,) bool. A world
    that ends begins anew in the same step: its row of `observations` is that of its new beginning, and its row of
    `last` (count, k) is what would have been observed at the end.
    """

    observations: NDArray[np.float32]
    last: NDArray[np.float32]
    rewards: NDArray[np.float32]
    terminated: NDArray[np.bool_]
    truncated: NDArray[np.bool_]

    def __init__(self, env: Environment, count: int, workers: int | None = None) -> None:
        made = problem(env)
        self.env, self.count, self._step = env, count, compiled(made)
        self._places = made.places
        self.groups = -(-count // WIDTH)
        padded, seen = self.groups * WIDTH, len(made.observe.outputs[0])
        self._memories = aligned((self.groups, 2 + self._places["end"], WIDTH))
        self._seeds = np.zeros(padded, dtype=np.int64)
        self._actions = np.zeros((padded, env.actions), dtype=np.float32)
        self._arrays: dict[str, NDArray[Any]] = {
            "observations": zeros((padded, seen), np.float32),
            "rewards": zeros((padded,), np.float32),
            "terminated": zeros((padded,), np.bool_),
            "truncated": zeros((padded,), np.bool_),
            "last": zeros((padded, seen), np.float32),
        }
        for name, array in self._arrays.items():
            setattr(self, name, array[:count])
        threads = max(1, min(workers or os.cpu_count() or 1, self.groups // LEAST_GROUPS))
        self._pool = ThreadPoolExecutor(threads - 1) if threads > 1 else None
        bounds = np.linspace(0, self.groups, threads + 1).astype(int)
        self._shares = list(zip(bounds[:-1].tolist(), np.diff(bounds).tolist(), strict=True))

    def begin(self, seeds: NDArray[np.int64]) -> None:
        """Begin all worlds, with a seed (count,) each; world i draws the same numbers whatever surrounds it."""
        self._seeds[: self.count] = seeds
        self._seeds[self.count :] = seeds[-1]
        self._call(fresh=1)

    def step(self, actions: Any) -> None:
        """Advance all worlds by `actions` (count, m), each entry in [−1, 1]; one that is not finite ends its world.

        Raises InputError for another shape, or anything but real numbers.
        """
        mine, given = self._actions[: self.count], np.asarray(actions)
        if given.shape != mine.shape or not np.can_cast(given.dtype, np.float32, "same_kind"):
            raise InputError("actions", f"real numbers of shape {mine.shape}", f"{given.dtype} of shape {given.shape}")
        with np.errstate(over="ignore"):  # a number beyond single precision is infinite
            mine[:] = given
        self._call(fresh=0)

    def _call(self, fresh: int) -> None:
        given: dict[str, Any] = {
            "memories": self._memories, "seeds": self._seeds, "actions": self._actions, **self._arrays,
            "limit": self.env.limit, "fresh": fresh,
        }  # fmt: skip

        def work(first: int, count: int) -> None:
            values = given | {"first": first, "count": count}
            self._step(*(values[name] if name in INTEGERS else values[name].ctypes.data for name in ARGUMENTS))

        *others, mine = self._shares
        waiting = [self._pool.submit(work, *share) for share in others] if self._pool is not None else []
        work(*mine)
        wait(waiting)

    @property
    def states(self) -> NDArray[np.float64]:
        """States and rotor forces (count, 24 + n), a copy, e₃ up."""
        length = 24 + self.env.rotors
        rows: NDArray[np.float64] = self._memories[:, 2 : 2 + length].transpose(0, 2, 1).reshape(-1, length)
        return rows[: self.count].copy()
