"""Copies of environments at random moments: `python -m benchmarks.copies` makes 1,000 and compares what follows.

Each goes on beside its original, by the same actions, through at least one new beginning: observations, rewards, ends,
infos and the final state must have the same bits, and neither may move the other. Each state is also given to an
environment that it does not belong to, which must refuse it and stay as it was.
"""

from __future__ import annotations

import argparse
import copy
import multiprocessing
import pickle
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

import cloudpickle
import gymnasium
import numpy as np
from gymnasium.wrappers import RecordEpisodeStatistics

import flypend as fp
import flypend.envs
from flypend.envs.make import TASKS

KINDS: dict[str, dict[str, Any]] = {
    "perfect": {},
    "mocap": {"sensors": "mocap"},
    "onboard": {"sensors": "onboard"},
    "hub": {"mount": "hub"},
    "randomise": {
        "action": "rates", "attitude": "6d",
        "randomise": {"mass": (0.8, 1.2), "lag": (0.8, 1.5), "strength": (0.9, 1), "delay": (0, 0.025), "wind": (0, 1)},
    },
}  # fmt: skip
SHAPES = ("single", 1, 7, 512)
WAYS = ("deepcopy", "copy", "pickle", "cloudpickle", "saved", "restored", "fork", "spawn")
STEPS = 26  # of an episode, and so few that each world begins anew soon
PATIENCE = 120  # s, until a process that does not answer hangs


def make(task: str, kind: str, shape: Any) -> Any:
    """Return an environment as gymnasium makes it; a single one with wrappers that count."""
    name = f"flypend/{task.title().replace('_', '')}-v0"
    given = KINDS[kind] | {"duration": STEPS / (62.5 if task.startswith("inv_") else 100.0)}
    if task == "catch_in_cup":
        given["mount"] = "cup"
    if shape == "single":
        return RecordEpisodeStatistics(gymnasium.make(name, max_episode_steps=STEPS - 3, **given))
    given |= {"history": 2 if kind == "randomise" else 0, "copy": kind != "mocap", "workers": 2}
    return gymnasium.make_vec(name, shape, vectorization_mode="vector_entry_point", **given)


def bits(value: Any) -> Any:
    """Return what tells whether two results have the same bits; times on the wall are left out."""
    if isinstance(value, dict):
        return {name: bits(entry) for name, entry in value.items() if name != "t"}
    if isinstance(value, tuple):
        return tuple(map(bits, value))
    array = np.asarray(value)
    return str(array.dtype), array.shape, array.tobytes()


def went_on(env: Any, actions: Any) -> tuple[Any, Any]:
    """Return what `env` answers to `actions`, with a reset where a single world ends, and its state then."""
    found = []
    for action in actions:
        answer = env.step(action)
        found.append(bits(answer))
        if isinstance(env, gymnasium.Env) and (answer[2] or answer[3]):
            found.append(bits(env.reset()))
    return found, env.unwrapped.save_state()


def _fork(env: Any, actions: Any, pipe: Any) -> None:
    pipe.send(went_on(env, actions))


def _serve(pipe: Any) -> None:
    """Go on with every environment that comes."""
    with suppress(EOFError):
        while True:
            pipe.send(went_on(*pipe.recv()))


def _answer(pipe: Any) -> Any:
    if not pipe.poll(PATIENCE):
        raise TimeoutError("no answer")
    return pipe.recv()


class Spawned:
    """A process that shares nothing with this one, and goes on with environments sent to it."""

    def __init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs,), daemon=True)
        self._process.start()

    def __call__(self, env: Any, actions: Any) -> Any:
        """Return what a copy of `env` there answers to `actions`."""
        self._pipe.send((env, actions))
        return _answer(self._pipe)

    def close(self) -> None:
        """End it."""
        self._process.kill()
        self._process.join()


def forked(env: Any, actions: Any) -> Any:
    """Go on with `env` in a forked process."""
    context = multiprocessing.get_context("fork")
    mine, theirs = context.Pipe()
    process = context.Process(target=_fork, args=(env, actions, theirs), daemon=True)
    process.start()
    try:
        return _answer(mine)
    finally:
        process.kill()
        process.join()


def copied(env: Any, way: str, fresh: Callable[[], Any]) -> Any:
    """Return a copy of `env` made in a `way`; `fresh` makes another with the same arguments."""
    if way == "deepcopy":
        return copy.deepcopy(env)
    if way == "copy":
        return copy.copy(env)
    if way == "saved":
        other = fresh().unwrapped
        other.reset(seed=1)
        other.restore_state(pickle.loads(pickle.dumps(env.save_state())))
        return other
    return pickle.loads((cloudpickle if way == "cloudpickle" else pickle).dumps(env))


class Attack:
    """Copies of environments that are drawn with `seed`; each environment is made once and begun anew for each copy."""

    def __init__(self, seed: int, tasks: Sequence[str] = tuple(TASKS), shapes: Sequence[Any] = SHAPES) -> None:
        self._rng, self._tasks, self._shapes = np.random.default_rng(seed), tasks, shapes
        self._made: dict[Any, Any] = {}
        self._spawned = Spawned()

    def close(self) -> None:
        """End the other process."""
        self._spawned.close()

    def copy(self, number: int) -> tuple[str, str]:
        """Make a copy at a random moment; return the way, and what is wrong ("" for nothing)."""
        rng, way = self._rng, WAYS[number % len(WAYS)]
        task, kind, shape = (
            rng.choice(self._tasks),
            rng.choice(list(KINDS)),
            self._shapes[number // len(WAYS) % len(self._shapes)],
        )
        what = task, "perfect" if (task, kind) == ("catch_in_cup", "hub") else kind, shape
        if what not in self._made:
            self._made[what] = make(*what)
        env = self._made[what]
        if way in ("copy", "saved", "restored"):  # not of wrappers, which share by `copy` and have counts of their own
            env = env.unwrapped
        before, after = int(rng.integers(2 * STEPS)), STEPS + int(rng.integers(STEPS))
        env.reset(seed=int(rng.integers(2**31)))
        hover = rng.uniform(-0.5, 0.3)
        actions = hover + rng.uniform(-0.3, 0.3, (before + after, *env.action_space.shape))
        actions = np.clip(actions, -1, 1).astype(np.float32)
        went_on(env, actions[:before])
        try:
            return way, self._compared(env, way, actions[before:], lambda: make(*what)) or self._refused(env, what)
        except Exception as error:  # whatever it is, it is counted
            return way, f"{what}: {type(error).__name__}: {error}"

    def _compared(self, env: Any, way: str, actions: Any, fresh: Callable[[], Any]) -> str:
        state = env.unwrapped.save_state()
        if way == "restored":
            found = went_on(env, actions)
            env.restore_state(state)
        elif way == "fork":
            found = forked(env, actions)
        elif way == "spawn":
            found = self._spawned(env, actions)
        else:
            twin = copied(env, way, fresh)
            found = went_on(twin, actions)
        if env.unwrapped.save_state() != state:
            return "the copy moved the original"
        expected = went_on(env, actions)
        if way in ("deepcopy", "copy", "pickle", "cloudpickle", "saved") and twin.unwrapped.save_state() != found[1]:
            return "the original moved the copy"
        if expected[1] == state:
            return "nothing moved"
        return "" if found == expected else "they went on differently"

    def _refused(self, env: Any, what: Any) -> str:
        """Whether an environment that is made in another way takes the state of `env`, made as `what` says."""
        others = [other for key, other in self._made.items() if key != what]
        if not others:
            return ""
        other = others[self._rng.integers(len(others))].unwrapped
        before = other.save_state()
        with suppress(fp.InputError):
            other.restore_state(env.unwrapped.save_state())
            return "a state of another environment was taken"
        return "" if other.save_state() == before else "a refused state was restored in part"


def main() -> None:
    """Make the copies that are asked for and print how they went; exit with 1 if any went wrong."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args()
    attack, right, wrong = Attack(asked.seed), Counter[str](), []
    try:
        for number in range(asked.count):
            way, fault = attack.copy(number)
            right[way] += not fault
            if fault:
                wrong.append(fault)
                print(f"{number}, {way}: {fault}", flush=True)
    finally:
        attack.close()
    print(f"{asked.count} copies, {len(wrong)} wrong; right:", ", ".join(f"{way} {right[way]}" for way in WAYS))
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
