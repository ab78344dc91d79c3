"""What policies score in the tasks of the environments: `python -m benchmarks.scores TASK [--policy NAME …]`.

A row per policy: random actions; the linear-quadratic regulator, the inverted law and the learned one, as flight
computers whose commands are the actions; a plan that is tracked; PPO of Stable-Baselines3 and SAC of sbx, which are
trained first (`benchmarks.learners`), until they score `--wanted` of the inverted law, once for each `--seed`; a
network that `examples/gradient.py` trains. Only those that need no training fly by default. A score is the sum of the
rewards of an episode; a rod is up at the end if the world is cut off with the rod within 15° of upright. All fly from
the same starts, which no training has seen. The last row of several seeds is their mean, with the interval of Student's
t over seeds.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any, NamedTuple

import casadi as ca
import numpy as np
from scipy import stats

import flypend as fp
from benchmarks.learners import BODY, SETTINGS, trained
from flypend.board.program import board, initial_memory
from flypend.compile.llvm.stagewise import WIDTH, lanes, stagewise
from flypend.envs import VectorWorlds
from flypend.envs.kernel import Worlds
from flypend.envs.make import TASKS
from flypend.flight.metrics import wilson
from flypend.model.state import SIZE
from flypend.plants.loop import Loop

SEED, RUNS, PLANS = 41_000_000, 200, 30
CHECKED = 42_000_000  # starts that decide when training stops
# What plans keep, by task. Balance ends at a lean of 60°; free plans let the rod fall and throw it, which saves room.
PLANNED: dict[str, dict[str, Any]] = {"Balance": {"lean": 1.0}, "SwingUp": {}}
UP = np.cos(np.deg2rad(15))
Policy = Callable[[VectorWorlds, Any], Any]


class Scored(NamedTuple):
    """Returns of first episodes (n,), and which ended with the rod up (n,)."""

    returns: Any
    up: Any


def scored(task: str, policy: Policy, count: int, seed: int, **seen_as: Any) -> Scored:
    """Fly the first episodes of `count` worlds by `policy`: (worlds, observations) → actions (count, m).

    `seen_as` are arguments of the environment that say what is observed.
    """
    worlds = VectorWorlds(task, count, **seen_as)
    seen, _ = worlds.reset(seed=seed)
    returns, on, up = np.zeros(count), np.ones(count, dtype=bool), np.zeros(count, dtype=bool)
    while on.any():
        seen, rewards, terminated, truncated, infos = worlds.step(policy(worlds, seen))
        returns[on] += rewards[on]
        for i in np.flatnonzero(on & truncated & ~terminated):
            up[i] = height(worlds, infos["final_obs"][i]) > UP
        on &= ~(terminated | truncated)
    return Scored(returns, up)


def height(worlds: VectorWorlds, seen: Any) -> float:
    """Return y₃ of an observation."""
    if worlds.worlds.env.attitude == "body":
        return float(seen[6:9] @ seen[12:15])  # of the vertical and the rod
    return float(seen[20])


def random_actions(seed: int = 0) -> Policy:
    """Draw actions uniformly."""
    draw = np.random.default_rng(seed)
    return lambda worlds, seen: draw.uniform(-1, 1, worlds.action_space.shape)


class Law:
    """The law `fp.laws.NAME` about the goal, on a flight computer per world, which is shown the true state."""

    def __init__(self, name: str) -> None:
        self._name, self._board, self._arrays, self._later = name, None, [], np.zeros(0)

    def __call__(self, worlds: VectorWorlds, seen: Any) -> Any:
        """Return the actions of all worlds."""
        own = worlds.worlds
        if self._board is None:
            self._begin(own)
        memory, measured, after, command = self._arrays
        _fill(measured, np.column_stack([own.times + self._later, own.states[:, :SIZE]]))
        self._board(len(memory), *self._arrays)
        memory[:] = after
        return acted(command.transpose(0, 2, 1).reshape(-1, own.env.rotors)[: own.count], own.env.vehicle)

    def _begin(self, own: Worlds) -> None:
        env, about = own.env, {}
        self._later = np.zeros(own.count)
        if own.goals.shape[1]:  # all follow the path with the phase 0, each a later part of it
            self._later = own.goals[:, 0] / env.task.goal.__self__.rate  # type: ignore[attr-defined]
            about = {"reference": lambda t: env.task.goal(t, [0.0])[0]}
        law = getattr(fp.laws, self._name)(**about)
        loop = Loop(env.vehicle, law.bind(env.vehicle), fp.Plant(rate=env.rate))
        program = board(loop)
        inputs = [ca.MX.sym(name, program.numel_in(i)) for i, name in enumerate(("memory", "measurement"))]
        whole = ca.Function("board", inputs, program(*inputs, [], [], []))
        self._board, groups = stagewise(whole), -(-own.count // WIDTH)
        self._arrays = [lanes(groups, k) for k in (whole.numel_in(0), 1 + SIZE, whole.numel_out(0), env.rotors)]
        _fill(self._arrays[0], np.array([initial_memory(loop, state[SIZE:]) for state in own.states]))


def _fill(array: Any, rows: Any) -> None:
    """Put `rows` into the lanes of `array`, the last into all that are left."""
    filled = np.minimum(np.arange(len(array) * WIDTH), len(rows) - 1)
    array[:] = rows[filled].reshape(len(array), WIDTH, -1).transpose(0, 2, 1)


class Planned:
    """In each world a plan from its start to hover at the origin, tracked by a flight computer of its own."""

    def __init__(self) -> None:
        self._computers: list[Any] = []

    def __call__(self, worlds: VectorWorlds, seen: Any) -> Any:
        """Return the actions of all worlds."""
        own, vehicle = worlds.worlds, worlds.worlds.env.vehicle
        for state in own.states[len(self._computers) :]:
            start, kept = fp.State.from_packed(state[:SIZE]), PLANNED[own.env.task.name]
            plan = fp.plan(vehicle, start, rotors=state[SIZE:], **kept)
            law = fp.track(plan) if plan else fp.laws.plan_and_track()
            loop = Loop(vehicle, law, fp.Plant(rate=own.env.rate))
            self._computers.append(law.flight_computer(loop, state[SIZE:]))
        rows = zip(self._computers, own.times, own.states, strict=True)
        return acted(np.array([computer.command(time, state[:SIZE]) for computer, time, state in rows]), vehicle)


def acted(forces: Any, vehicle: fp.Vehicle) -> Any:
    """Return the actions (count, n) of rotor forces, N."""
    low, high = vehicle.rotor_limits
    return np.clip(2 * (forces - low) / (high - low) - 1, -1, 1)


LAWS = ("lqr", "inverted", "learned")
TRAINED = (*SETTINGS, "gradient")


def policy_of(name: str) -> Policy:
    """Return the policy of this name that needs no training."""
    return random_actions() if name == "random" else Planned() if name == "plan" else Law(name)


def told(name: str, found: Scored, law: Scored, trained: str = "| | | ") -> str:
    """Return the row of a table."""
    n, score = len(found.returns), found.returns.mean()
    half = 1.96 * found.returns.std(ddof=1) / np.sqrt(n)
    low, high = wilson(int(found.up.sum()), n)
    return (
        f"| {name} | {score:.0f} ({score - half:.0f} to {score + half:.0f}) | {score / law.returns[:n].mean():.0%} | "
        f"{found.up.sum()} of {n} | {low:.1%} to {high:.1%} {trained}|"
    )


def mean_of(name: str, seeds: list[tuple[float, ...]], runs: int, law: float) -> str:
    """Return the row of all `seeds`: of each its score, rods up of `runs`, steps, seconds of processor and of wall."""
    score, up, steps, processor, wall = np.mean(seeds, axis=0)
    half = stats.t.ppf(0.975, len(seeds) - 1) * np.std([seed[0] for seed in seeds], ddof=1) / np.sqrt(len(seeds))
    return (
        f"| {name}, mean of {len(seeds)} seeds | {score:.0f} ({score - half:.0f} to {score + half:.0f}) | "
        f"{score / law:.0%} | {up * len(seeds):.0f} of {runs * len(seeds):,} | | {steps:,.0f} | {processor:.0f} | "
        f"{wall:.0f} |"
    )


def main() -> None:
    """Fly, train, and print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("task", choices=TASKS)
    parser.add_argument("--policy", action="append", choices=("random", *LAWS, "plan", *TRAINED))
    parser.add_argument("--seed", type=int, action="append", help="of training")
    parser.add_argument("--wanted", type=float, default=0.9, help="share of the law's score at which training stops")
    parser.add_argument("--minutes", type=float, default=10.0, help="most processor time of a training")
    parser.add_argument("--threads", type=int, default=1, help="of PyTorch")
    parser.add_argument("--body", action="store_true", help="PPO and SAC see the state in the body frame")
    asked = parser.parse_args()
    seen_as = BODY if asked.body else {}
    names = asked.policy or ["random", *LAWS, *["plan"] * (TASKS[asked.task]().name in PLANNED)]
    law = scored(asked.task, policy_of("inverted"), RUNS, SEED)
    columns = "score (95 % interval) | of the law's | up at the end | 95 % interval | steps | processor, s | wall, s"
    print(f"| policy | {columns} |\n|---|---|---|---|---|---|---|---|")
    for name in names:
        if name == "inverted":
            print(told(name, law, law), flush=True)
        elif name not in TRAINED:
            runs = PLANS if name == "plan" else RUNS
            print(told(name, scored(asked.task, policy_of(name), runs, SEED), law), flush=True)
        else:
            seeds: list[tuple[float, ...]] = []
            for seed in asked.seed or [0]:
                done = trained(
                    name, asked.task, seed,
                    lambda one: scored(asked.task, one, RUNS, CHECKED, **seen_as).returns.mean(),
                    asked.wanted * law.returns.mean(), 60 * asked.minutes, asked.threads, seen_as,
                )  # fmt: skip
                found = scored(asked.task, done.policy, RUNS, SEED, **seen_as)
                spent = done.steps, done.processor, done.wall
                seeds.append((found.returns.mean(), found.up.sum(), *spent))
                print(told(f"{name}, seed {seed}", found, law, "| {:,} | {:.0f} | {:.0f} ".format(*spent)), flush=True)
            if len(seeds) > 1:
                print(mean_of(name, seeds, RUNS, law.returns.mean()))


if __name__ == "__main__":
    main()
