"""A short check of what is exported: some seconds of flights, told in the header of the C code."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass

from flypend.errors import InputError
from flypend.export.source import ascii_of
from flypend.flight.feasibility import feasibility
from flypend.flight.metrics import wilson
from flypend.flight.tasks import fly_tasks, task_starts
from flypend.laws import BoundLaw, Law
from flypend.model import Vehicle
from flypend.plants import ROTORS

RUNS, SEED, DURATION = 200, 1, 30.0  # s
LEAST_RATE = 0.9


@dataclass(frozen=True)
class Tested:
    """What flights of the exported law show.

    Parameters
    ----------
    lines : tuple of str
        What was flown, and with which result.
    poor : str
        What is wrong, in a few words; empty if nothing is.
    """

    lines: tuple[str, ...]
    poor: str = ""

    def comment(self) -> str:
        """Return a C comment, in ASCII."""
        told = [line for text in self.lines for line in textwrap.wrap(text, 114, subsequent_indent="  ")]
        verdict = textwrap.wrap(f"POOR: {self.poor}", 114) if self.poor else []
        body = "\n".join(f" * {ascii_of(line)}".replace("*/", "* /") for line in [*verdict, *told])
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
