"""The tasks that a vehicle and its law are checked on: batches of starts, e₃ up, and their flights."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from flypend.errors import InputError
from flypend.flight.ensemble import Ensemble, fly_many
from flypend.flight.request import Flight
from flypend.geometry import E3, Matrix, Numbers, Vector
from flypend.laws import BoundLaw, Controller
from flypend.model import State, Vehicle, Wrench
from flypend.model.mount import margins
from flypend.model.state import SIZE
from flypend.plants import Sampled

# What each task asks, in words.
TASKS: Mapping[str, str] = {
    "hover": "rod upright, half its length from the reference",
    "lean": "level hover at rest, the rod leaning by up to 60°",
    "hanging": "rod hanging at rest, at any heading",
    "level": "level vehicle at rest, at any heading, the rod in any direction",
    "random": "any attitude and rod, rates up to 3 rad/s, speeds up to 2 m/s",
}
LEAST_RATE = 0.9  # share of starts from which a law that can fly a task succeeds
LEANS = np.radians(np.arange(5.0, 61.0, 5.0))
ASKEW = 0.02  # rad, how far a hanging rod is from straight down: none hangs better
TICK = 0.02  # s, at which leans are sampled
SWAY = np.radians(10.0)  # how far a rod hangs from straight down at most, where hanging starts are random
MOST_DRAWS = 200  # as many random starts are drawn for each one that is wanted


def task_starts(vehicle: Vehicle, runs: int, seed: int, directions: int = 12) -> dict[str, State]:
    """Return the starts of each of `TASKS`, e₃ up: `runs` random ones from `seed`, the others in some `directions`.

    Of leans there are `directions` of each of `LEANS`, in this order; in a cup, of those inside its cone,
    or if none is, of half its angle.

    In a cup nothing swings up: the tasks are hover and lean, and random starts are level and at rest, with the rod
    within half the angle of the cone. On a hub, level and random starts do not touch. Of level starts there are `runs`,
    too.
    """
    rng = np.random.default_rng(seed)
    most = vehicle.body.cup_angle if vehicle.mount == "cup" else np.pi
    leans = [lean for lean in LEANS if lean < most] or [most / 2]
    level = vehicle.l / 2 * _directions(directions, np.pi / 2)
    hanging = np.concatenate([[-E3], _directions(directions, np.pi - ASKEW)])
    starts = {
        "hover": State(x=level, y=np.broadcast_to(E3, level.shape)),
        "lean": State(y=np.concatenate([_directions(directions, lean) for lean in leans])),
        "hanging": State(y=hanging, R=_headings(rng.uniform(0, 2 * np.pi, len(hanging)))),
    }
    if vehicle.mount == "cup":
        within = State(y=_near_e3(rng, runs, vehicle.body.cup_angle / 2))
        return {"hover": starts["hover"], "lean": starts["lean"], "random": within}
    return starts | {
        "level": free_starts(vehicle, _level, np.random.default_rng((seed, 1)), runs),
        "random": free_starts(vehicle, State.random, rng, runs),
    }


def fly_tasks(
    vehicle: Vehicle,
    law: BoundLaw | Controller,
    plant: Sampled,
    starts: Mapping[str, State],
    duration: float,
    *,
    workers: int | None = None,
    progress: Callable[[str, int, int], Any] = lambda *_: None,
) -> dict[str, Ensemble]:
    """Fly `vehicle` under `law` through `plant` from the `starts` of each task, e₃ up, for `duration` s.

    Leans are sampled every `TICK`. `workers` as in `simulate_ensemble`; `progress` is called with
    (activity, done, total).
    """
    found = {}
    for name, batch in starts.items():
        times = np.arange(0.0, duration, TICK) if name == "lean" else None
        flight = Flight(
            vehicle=vehicle, law=law, starts=batch.in_frame(law.e3), duration=duration, plant=plant, times=times
        )
        found[name] = fly_many(flight, workers=workers, progress=lambda *a, name=name: progress(f"flying {name}", *a))
    return found


def touches(vehicle: Vehicle, starts: State) -> Any:
    """Return whether the rod of each of `starts` (n,), e₃ up, is where the mount does not let it be."""
    hover = Wrench(np.full(len(starts), vehicle.weight), np.zeros((len(starts), 3)))
    return np.any(margins(starts, hover, vehicle, "up") < 0, axis=-1)


def random_hanging(rng: np.random.Generator, runs: int) -> State:
    """Level vehicles at rest, at any heading, with the rod anywhere within `SWAY` of straight down."""
    return State(y=-_near_e3(rng, runs, SWAY), R=_headings(rng.uniform(0, 2 * np.pi, runs)))


def _near_e3(rng: np.random.Generator, runs: int, most: float) -> Vector:
    """Unit vectors (runs, 3), uniform within the angle `most` (rad) of e₃."""
    cosine = rng.uniform(np.cos(most), 1.0, runs)
    angle, sine = rng.uniform(0, 2 * np.pi, runs), np.sqrt(1 - cosine**2)
    return np.stack([sine * np.cos(angle), sine * np.sin(angle), cosine], axis=-1)


def _level(rng: np.random.Generator, runs: int) -> State:
    """Level vehicles at rest with the rod in any direction."""
    y = rng.standard_normal((runs, 3))
    return State(y=y / np.linalg.norm(y, axis=-1, keepdims=True), R=_headings(rng.uniform(0, 2 * np.pi, runs)))


def free_starts(
    vehicle: Vehicle, draw: Callable[[np.random.Generator, int], State], rng: np.random.Generator, runs: int
) -> State:
    """States from `draw` whose rod touches nothing: `runs` of them, in the order in which they are drawn.

    Raises InputError if there are hardly any.
    """
    packed = np.empty((0, SIZE))
    for _ in range(MOST_DRAWS):
        drawn = draw(rng, runs)
        packed = np.concatenate([packed, drawn.packed()[~touches(vehicle, drawn)]])
        if len(packed) >= runs:
            return State.trusted(packed[:runs])
    raise InputError("vehicle.body", "a machine with room for its rod", f"one it touches in {MOST_DRAWS * runs} poses")


def _directions(count: int, tilt: float) -> Vector:
    """Unit vectors (count, 3) at `tilt` (rad) from e₃, all around."""
    angle = 2 * np.pi * np.arange(count) / count
    level = np.sin(tilt) * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return np.concatenate([level, np.full((count, 1), np.cos(tilt))], axis=-1)


def _headings(angles: Numbers) -> Matrix:
    """Rotations (n, 3, 3) about e₃."""
    turned = np.broadcast_to(np.eye(3), (len(angles), 3, 3)).copy()
    turned[:, 0, 0] = turned[:, 1, 1] = np.cos(angles)
    turned[:, 1, 0], turned[:, 0, 1] = np.sin(angles), -np.sin(angles)
    return turned
