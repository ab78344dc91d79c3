"""Guesses that are plans for other starts, against the pumps of `fp.plan`: hehn2011, least excursion.

python -m benchmarks.learned_guesses --library 384 --runs 60

A library of plans serves every start that a symmetry of the vehicle turns it into: its nearest members, turned to the
heading of the start, are solved as the pumps are.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

import flypend as fp
from flypend.planning.durations import HORIZONS
from flypend.planning.multistart import Found, Guess, Job
from flypend.planning.problem import Request, request
from flypend.planning.search import finish, improve, prepare, together

Array = NDArray[np.float64]

VEHICLE = fp.vehicle("hehn2011")
HORIZON = HORIZONS[0]
QUARTER = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
MIRROR = np.diag([1.0, -1.0, 1.0])


class Member(NamedTuple):
    """A plan of the library: its states and commands, and what its start looks like from the body, own units."""

    states: Array
    commands: Array
    looks: Array


def symmetries(vehicle: fp.Vehicle) -> Iterator[tuple[Array, list[int]]]:
    """Yield what turns or mirrors the body onto itself, and which rotor then stands where each one stood."""
    places, spins = vehicle.rotor_positions, vehicle.rotor_spins
    for mirror in (np.eye(3), MIRROR):
        for quarters in range(4):
            turn = np.linalg.matrix_power(QUARTER, quarters) @ mirror
            apart = np.linalg.norm((places @ turn.T)[:, None] - places[None], axis=-1)
            stands = apart.argmin(axis=0)  # rotor i stands where rotor stands[i] came from
            same = apart.min(axis=0).max() < 1e-9 and np.all(np.linalg.det(turn) * spins[stands] == spins)
            if same:
                yield turn, stands.tolist()


def turned(states: Array, world: Array, body: Array | None = None, stands: list[int] | None = None) -> Array:
    """Return packed states after `world` has turned or mirrored the world, and `body` the body."""
    body = np.eye(3) if body is None else body
    out = states.copy()
    for place in (0, 3, 18, 21):
        out[..., place : place + 3] = states[..., place : place + 3] @ world.T
    out[..., 6:15] = (world @ states[..., 6:15].reshape(*states.shape[:-1], 3, 3) @ body.T).reshape(
        states[..., 6:15].shape
    )
    out[..., 15:18] = np.linalg.det(body) * states[..., 15:18] @ body.T
    out[..., 24:] = states[..., 24:] if stands is None else states[..., 24:][..., stands]
    return out


def looks(state: Array) -> Array:
    """Return velocity, vertical, rates and rod of a packed state in the body's axes."""
    R = state[6:15].reshape(3, 3)
    return np.concatenate([state[3:6] @ R, R[2], state[15:18], state[18:21] @ R, state[21:24] @ R])


def headed(member: Member, start: Array) -> Guess:
    """Return a plan of the library, turned about the vertical to the heading of `start`, which it begins with."""
    M = member.states[0, 6:15].reshape(3, 3) @ start[6:15].reshape(3, 3).T
    angle = math.atan2(M[0, 1] - M[1, 0], M[0, 0] + M[1, 1])
    c, s = math.cos(angle), math.sin(angle)
    states = turned(member.states, np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]))
    states[0] = start
    return states, member.commands


def asked_of(start: fp.State) -> Request:
    """Return the request of a plan of least excursion from `start`."""
    return request(VEHICLE, start, "excursion", (0, 0, 0))


def pumped(asked: Request) -> Found:
    """Return what the race of all pumps finds, solved to the end."""
    found = together(asked, HORIZON, math.inf)
    return finish(Job(asked, found.style), HORIZON, found, math.inf)


def from_library(asked: Request, library: list[Member], count: int) -> Found:
    """Return the best that comes of the `count` nearest members, solved to the end."""
    own = looks(asked.start)
    near = sorted(library, key=lambda member: float(np.linalg.norm(member.looks - own)))[:count]
    tried = [improve(Job(asked, i), HORIZON, headed(member, asked.start), math.inf) for i, member in enumerate(near)]
    best = min(tried, key=lambda found: found.cost)
    return finish(Job(asked, best.style), HORIZON, best, math.inf)


def main() -> None:
    """Make the library, solve, and print times and excursions."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--library", type=int, default=384)
    parser.add_argument("--runs", type=int, default=60)
    asked = parser.parse_args()
    prepare(asked_of(fp.State(y=(0, 0, -1))))
    library = []
    drawn = fp.random_starts(asked.library, 91001)
    for i in range(asked.library):
        found = pumped(asked_of(drawn[i]))
        if not found.lacks:
            for body, stands in symmetries(VEHICLE):
                states = turned(found.states, body, body, stands)
                library.append(Member(states, found.commands[:, stands], looks(states[0])))
    starts = fp.random_starts(asked.runs, 93111)
    ways = {
        "eight pumps": pumped,
        "the nearest plan": lambda request: from_library(request, library, 1),
        "the three nearest plans": lambda request: from_library(request, library, 3),
    }
    spent = dict.fromkeys(ways, 0.0)
    costs: dict[str, list[float]] = {name: [] for name in ways}
    for i in range(asked.runs):
        for name, way in ways.items():
            begin = time.process_time()
            costs[name].append(way(asked_of(starts[i])).cost)
            spent[name] += time.process_time() - begin
    best = np.min(list(costs.values()), axis=0)
    plans = len(library) / len(list(symmetries(VEHICLE)))
    size = sum(member.states.nbytes + member.commands.nbytes for member in library[: round(plans)])
    print(f"library: {plans:.0f} plans, {size / 1e6:.1f} MB")
    print("\n| guesses | time | excursion, median, 95 %, most | without a plan |\n|---|---|---|---|")
    for name, own in costs.items():
        ratio = np.array(own) / best
        flown = np.sqrt(ratio[np.isfinite(ratio)])  # the cost is the square of the excursion
        told = ", ".join(f"{value:.3f}" for value in (*np.quantile(flown, [0.5, 0.95]), flown.max()))
        print(f"| {name} | {spent[name] / spent['eight pumps']:.2f} | {told} | {np.sum(~np.isfinite(ratio))} |")


if __name__ == "__main__":
    main()
