"""What flights of an exported law show in flypend's own model: how well it flies, and how much room it takes."""

from __future__ import annotations

import textwrap
from typing import NamedTuple

import numpy as np

from flypend.errors import InputError
from flypend.export.source import ascii_of
from flypend.flight.ensemble import fly_many
from flypend.flight.feasibility import feasibility
from flypend.flight.metrics import wilson
from flypend.flight.request import Flight
from flypend.flight.tasks import LEAST_RATE, TICK, fly_tasks, task_starts
from flypend.laws import BoundLaw, Law
from flypend.model import Vehicle
from flypend.plants import ROTORS

RUNS, SEED, DURATION = 200, 1, 30.0  # s
DIRECTIONS, SWING_UP = 24, 10.0  # headings, and s of a flight for the room
MARGIN = 1.5  # of what the model needs: for a machine that is not the model, and for PID to recover from a swing-up
STEP = 0.5  # m, to which the room is rounded up


class Tested(NamedTuple):
    """What flights of the exported law show: `lines` say what was flown with which result, `poor` what is wrong."""

    lines: tuple[str, ...]
    poor: str = ""

    def comment(self) -> str:
        """Return a C comment, in ASCII."""
        comments = [line for text in self.lines for line in textwrap.wrap(text, 114, subsequent_indent="  ")]
        verdict = textwrap.wrap(f"POOR: {self.poor}", 114) if self.poor else []
        body = "\n".join(f" * {ascii_of(line)}" for line in [*verdict, *comments])
        return f"/* Flown before it was exported, in flypend's own model:\n{body}\n */\n"


def fly_tests(law: Law | BoundLaw, vehicle: Vehicle, rate: float) -> Tested:
    """Fly `vehicle` under `law` at a control `rate` (Hz): hover, hanging and 200 random starts, 30 s each."""
    plant = ROTORS.replace(rate=rate)
    found = feasibility(vehicle)
    if found.impossible:
        return Tested(("Nothing was flown.",), "; ".join(found.impossible))
    starts = task_starts(vehicle, RUNS, SEED)
    starts.pop("lean")
    try:
        flown = fly_tasks(vehicle, law.bind(vehicle), plant, starts, DURATION)
    except InputError as error:
        return Tested(("Nothing was flown.",), str(error))
    lines, poor = [], []
    for name, ensemble in flown.items():
        count, runs = int(ensemble.success.sum()), len(ensemble)
        low, high = wilson(count, runs)
        words = f"{name}: {count} of {runs} stand after {DURATION:g} s"
        lines.append(f"{words} (95 %: {100 * low:.1f} to {100 * high:.1f} %)")
        if ensemble.rate < LEAST_RATE:
            poor.append(words)
    lines += [f"Doubtful: {doubt}" for doubt in found.doubtful]
    lines.append("Plant: rotors with limits and lag, perfect measurements. `flypend check` tells margins and more.")
    return Tested(tuple(lines), "; ".join(poor))


class Room(NamedTuple):
    """Room before a swing-up, around a vehicle in hover: `height` above ground and `aside` in other directions, m."""

    height: float
    aside: float


def measure_room(law: Law | BoundLaw, vehicle: Vehicle, rate: float) -> Room:
    """Return the room that `law`, called at `rate` (Hz), takes to swing the rod up on `vehicle`.

    Starts hang at rest at 25 headings; vehicle and rod stay within the room with a `MARGIN`. Raises InputError for a
    law that does not swing up from all of them.
    """
    starts = task_starts(vehicle, 1, SEED, DIRECTIONS).get("hanging")
    if starts is None:
        raise InputError("vehicle", "a mount that lets the rod hang", vehicle.mount)
    bound = law.bind(vehicle)
    flown = fly_many(
        Flight(
            vehicle=vehicle,
            law=bound,
            starts=starts.in_frame(bound.e3),
            duration=SWING_UP,
            plant=ROTORS.replace(rate=rate),
            times=np.arange(0, SWING_UP, TICK),
        )
    )
    if not flown.success.all():
        came = f"{bound.name}: {flown.success.sum()} of {len(flown)} within {SWING_UP:g} s"
        raise InputError("law", f"one that swings the rod up on {vehicle.name}, or a height", came)
    assert flown.samples is not None  # since times were given
    motion = flown.samples.in_frame(bound.e3)  # back to e₃ up
    tip = motion.x + vehicle.reach * motion.y
    lowest = min(motion.x[..., 2].min(), tip[..., 2].min())
    farthest = max(np.hypot(end[..., 0], end[..., 1]).max() for end in (motion.x, tip))
    highest = max(motion.x[..., 2].max(), tip[..., 2].max())
    return Room(_round_up(-lowest), _round_up(max(farthest, highest)))


def _round_up(length: float) -> float:
    return float(STEP * np.ceil(MARGIN * length / STEP))
