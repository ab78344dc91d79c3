"""Train a network of your own, in PyTorch, by the gradient through flights: to balance the rod, or to swing it up.

`python examples/gradient.py [balance | swing_up]` needs the extra rl and torch. For the swing-up it begins ever earlier
on flights of the inverted law (a reverse curriculum): these say where to begin, not what to do.
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any

import numpy as np
import torch

import flypend as fp
from flypend.envs import DifferentiableWorlds, VectorWorlds
from flypend.envs.make import PHYSICS

RATE = 50.0  # actions per second
FLIGHTS = 256  # of an update
BALANCE = 120  # updates, while flights grow longer
NEAR = 0.3  # of the distance from hover
FARTHEST = 3.0  # s before the rod is up: no path is as long
STEEPEST = 10.0  # the largest gradient by a state that is carried back through a step


class Policy(torch.nn.Module):
    """Two layers of 64 beside a linear one: what the body frame shows of a state → four rotor forces in [−1, 1].

    In hover the network is zero, whatever its weights, and the action is that of hover.
    """

    def __init__(self, vehicle: Any) -> None:
        super().__init__()
        linear, tanh = torch.nn.Linear, torch.nn.Tanh
        self.layers = torch.nn.Sequential(linear(18, 64), tanh(), linear(64, 64), tanh(), linear(64, 4, bias=False))
        self.direct = linear(18, 4, bias=False)
        with torch.no_grad():  # at first, the machine hovers almost whatever it sees
            self.layers[-1].weight.mul_(0.3)
            self.direct.weight.zero_()
        low, high = vehicle.rotor_limits
        hover = 2 * (vehicle.weight / 4 - low) / (high - low) - 1
        self.hover = hover / np.sqrt(1 - hover**2)
        # Thrust and three moments → rotors. Moments turn the light body quickly: they begin small.
        mixing = vehicle.mixing()
        mixing = mixing / np.abs(mixing).max(axis=1, keepdims=True)
        self.mixing = torch.tensor(mixing * [[1], [0.3], [0.3], [0.3]], dtype=torch.float32)
        self.length, self.time = vehicle.l, float(np.sqrt(vehicle.l / vehicle.g))

    def seen(self, observed: Any) -> Any:
        """Position, velocity, vertical, rates, rod and its velocity in the body frame, in rod lengths and √(l/g)."""
        x, v, R, omega, y, y_dot = observed.split([3, 3, 9, 3, 3, 3], dim=-1)
        R = R.unflatten(-1, (3, 3))  # its rows are the body's axes

        def turned(vector: Any) -> Any:
            return (R @ vector.unsqueeze(-1)).squeeze(-1)

        x, v, y_dot = x / self.length, v * self.time / self.length, y_dot * self.time
        return torch.cat([turned(x), turned(v), R[..., 2], omega * self.time, turned(y), turned(y_dot)], -1)

    def asked(self, seen: Any) -> Any:
        """What the layers make of it (…, 4)."""
        return self.layers(seen) + self.direct(seen)

    def forward(self, observed: Any) -> Any:
        """Return actions (count, 4) for observations (count, 24)."""
        up = torch.tensor([0.0, 0.0, 1.0])
        hover = torch.cat([torch.zeros(6), up, torch.zeros(3), up, torch.zeros(3)])
        z = (self.asked(self.seen(observed)) - self.asked(hover)) @ self.mixing + self.hover
        return z * torch.rsqrt(1 + z * z)


def distance(observed: Any, policy: Policy) -> Any:
    """How far from hover with the rod up: 0 there, 2.1 with the rod hanging; far away it grows like a logarithm."""
    pace, length = policy.time, policy.length
    x, v, R, omega, y, y_dot = observed.split([3, 3, 9, 3, 3, 3], dim=-1)
    squares = 8 * (1 - y[..., 2]) + (1 - R[..., 8]) + 0.1 * (omega * pace).square().sum(-1)
    moving = (x.square() + (v * pace).square()).sum(-1) / length**2 + (y_dot * pace).square().sum(-1)
    return slow((1 + squares + 0.3 * moving).sqrt() - 1)


def slow(value: Any) -> Any:
    """3 log(1 + v/3): flights that have flown off count no more than others, and still know the way back."""
    return 3 * torch.log1p(value / 3)


class Paths:
    """`count` flights of the inverted law from hanging starts of "swing_up" `worlds`, on which training begins."""

    def __init__(self, worlds: DifferentiableWorlds, count: int = 128) -> None:
        vehicle, law = worlds.env.vehicle, fp.laws.inverted()
        memory, _ = worlds.begin(range(90_000_000, 90_000_000 + count))
        states = [fp.State.from_packed(row[1:25]) for row in memory]
        runs = [fp.simulate(vehicle, law, state, duration=4.5) for state in states]
        n = len(runs[0].t)
        self.rows = np.array([
            np.hstack([run.x, run.x_dot, run.R.reshape(n, 9), run.omega, run.y, run.y_dot]) for run in runs
        ])  # fmt: skip
        self.times = runs[0].t
        self.up = np.array([run.t[np.flatnonzero(run.y[:, 2] < 0.97)[-1]] for run in runs])

    def starts(self, back: float, seed: int) -> Any:
        """Return states (FLIGHTS, 24), from 0.3 s after the rod was up to `back` s before it."""
        draw = np.random.default_rng(seed)
        which = draw.integers(0, len(self.up), FLIGHTS)
        times = self.up[which] + 0.3 - (back + 0.3) * draw.random(FLIGHTS) ** 0.8
        return self.rows[which, np.searchsorted(self.times, times.clip(0))]


def begun(worlds: DifferentiableWorlds, seed: int, paths: Paths | None, back: float) -> tuple[Any, Any]:
    """Return memory and observations of new worlds, on the `paths` up to `back` s before the rod was up, if any.

    At 3 s, before which no path begins, a quarter begin as the task says.
    """
    memory, observed = worlds.begin(range(seed * FLIGHTS, (seed + 1) * FLIGHTS))
    if paths is not None:
        some = np.random.default_rng(seed + 1).random(FLIGHTS) < (0.75 if back >= FARTHEST else 1.0)
        rows = paths.starts(back, seed)[some]
        memory[some, 1:25] = rows  # after the clock
        rows[:, 6:15] = rows[:, [6, 9, 12, 7, 10, 13, 8, 11, 14]]  # observed by columns
        observed[some] = rows
    return torch.from_numpy(memory), torch.from_numpy(observed)


def flown(policy: Policy, worlds: DifferentiableWorlds, memory: Any, observed: Any, steps: int) -> Any:
    """Fly, and return the observations (steps, count, 24)."""

    def limited(gradient: Any) -> Any:
        """A flight that falls multiplies its gradient with every step: no flight has more than its share."""
        most = STEEPEST / FLIGHTS
        return None if gradient is None else gradient * (most / gradient.norm(dim=1, keepdim=True)).clamp(max=1)

    seen = []
    for _ in range(steps):
        memory, observed, _, _ = worlds.torch(memory, policy(observed))
        if memory.requires_grad:
            memory.register_hook(limited)
        seen.append(observed)
    return torch.stack(seen)


def train(task: str = "swing_up", seed: int = 0, settled: int | None = None, most: int = 800) -> tuple[Policy, int]:
    """Train until the hardest starts have been reached and `settled` updates have followed, or for `most` updates.

    The network first learns to balance, in flights of 0.2 s that grow to 1.2 s. For the swing-up, it then begins
    earlier on the paths whenever four of five flights end near hover. Return the policy, and the steps of its flights.
    """
    torch.manual_seed(seed)
    balance = DifferentiableWorlds("balance", rate=RATE, observe="state", plant=PHYSICS.replace(rate=200.0))
    worlds, paths, back, steps, total = balance, None, FARTHEST if task == "balance" else 0.0, 0, 0
    settled = settled or (60 if task == "balance" else 120)
    left, policy = settled, Policy(balance.env.vehicle)
    descent = torch.optim.Adam(policy.parameters(), betas=(0.9, 0.99))
    for update in range(most):
        if update == BALANCE and task == "swing_up":
            worlds = DifferentiableWorlds(task, rate=RATE, observe="state", plant=PHYSICS.replace(rate=200.0))
            paths = Paths(worlds)
        steps = min(10 + update // 2, 60) if update < BALANCE else 125 if back < 1.6 or paths is None else 150
        seen = flown(policy, worlds, *begun(worlds, most * seed + update, paths, back), steps)
        far = distance(seen, policy)
        excursion = slow(seen[:, :, :3].norm(dim=2).amax(dim=0) / policy.length)
        cost = excursion.mean() + 0.3 * far.mean() + 2 * far[-(steps // 3) :].mean()
        descent.zero_grad()
        cost.backward()
        torch.nn.utils.clip_grad_norm_(policy.parameters(), 5.0)
        for group in descent.param_groups:
            group["lr"] = 4e-3 * max(0.02, left / settled) ** 2
        descent.step()
        total += FLIGHTS * steps
        near = float((far[-1] < NEAR).float().mean())
        if update % 20 == 0:
            begun_at = f", begun up to {back:.1f} s before the rod is up" if paths else ""
            print(f"update {update}: {near:.0%} of flights end near hover{begun_at}", file=sys.stderr, flush=True)
        if update >= BALANCE:
            left -= back == FARTHEST
            back = min(FARTHEST, back + 0.04 * (near > 0.8))
        if not left:
            break
    return policy, total


def share_up(policy: Policy, task: str, count: int = 1000, seed: int = 2 * 10**6) -> float:
    """Share of `count` starts that end within 15° of upright, and were never lost, in the worlds as they are made."""
    worlds = VectorWorlds(task, count, observe="state")
    observed, _ = worlds.reset(seed=seed)
    kept = np.ones(count, dtype=bool)
    for _ in range(worlds.worlds.env.limit):
        with torch.no_grad():
            observed, _, ended, _, about = worlds.step(policy(torch.from_numpy(observed)).numpy())
        kept &= ~ended
    return float(np.mean(kept & (about["final_obs"][:, 20] > np.cos(np.deg2rad(15)))))


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("task", nargs="?", default="swing_up", choices=("balance", "swing_up"))
    task = parser.parse_args().task
    torch.set_num_threads(1)
    policy, _ = train(task)
    share = share_up(policy, task)
    print(f"{share:.1%} of 1,000 other starts end upright, after {time.process_time():.0f} s of processor time")
    torch.save(policy.state_dict(), f"{task}.pt")
