"""The set-up of Hehn and D'Andrea (2011), next to their published results: `python -m benchmarks.circles [LAW ...]`.

Hover and two circles, thrust and body rates at 50 Hz, 30 ms latency; the laws are inverted and lqr by default.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from rich.box import SIMPLE
from rich.console import Console
from rich.table import Table

from benchmarks.results import record
from flypend.errors import InputError, one_of
from flypend.flight.simulate import simulate
from flypend.geometry import norm
from flypend.laws import Law, law_names, references
from flypend.laws.by_name import FACTORIES, follows
from flypend.model import State, vehicle
from flypend.plants import MOTION_CAPTURE, as_sampled
from flypend.report.studies import short

# Chosen: a period of four seconds; the rates of their circles are not known here.
RATE = 2 * np.pi / 4
CASES: Mapping[str, Callable[[Any], Any]] = {
    "hover": references.hover(),
    "circle R = 0.1 m": references.circle(0.1, RATE),
    "circle R = 0.5 m": references.circle(0.5, RATE),
}
# Approximate values from their experiment, m: the offset in hover and the position error on the small circle.
PUBLISHED: Mapping[str, str] = {"hover": "offset about 0.05", "circle R = 0.1 m": "error about 0.1"}
# The latency that every law compensates here, s: the value they identified and used in their controller.
LATENCY = 0.03
PLANT = as_sampled("hehn2011").replace(noise=MOTION_CAPTURE, mismatch={"mass": 1.02, "rod_length": 0.98})
DURATION, JUDGED = 20.0, 10.0


@dataclass(frozen=True)
class Tracking:
    """One law on one case, over the last 10 s: whether the rod stood, mean offset and RMS error of the pivot, m.

    Offset and error are NaN if the run is not completed.
    """

    law: str
    case: str
    stood: bool
    offset: float
    error: float
    published: str


def hehn2011(laws: tuple[str, ...] = ("inverted", "lqr"), seed: int = 1) -> list[Tracking]:
    """Fly hover and circles with the vehicle hehn2011 on `PLANT` (motion-capture noise, 2 % model error).

    Parameters
    ----------
    laws : tuple of str
        Names of shipped laws that follow a reference.
    seed : int
        Seed of the noise.

    Raises
    ------
    InputError
        If a law is unknown or does not follow a reference.
    """
    return [_fly(name, case, reference, seed) for case, reference in CASES.items() for name in laws]


def _fly(name: str, case: str, reference: Callable[[Any], Any], seed: int) -> Tracking:
    machine = vehicle("hehn2011")
    law = _law(name, reference).bind(machine)
    law = replace(law, computer=replace(law.computer, latency=LATENCY))
    start = references.sample(reference, np.array([0.0, 1e-3]))
    state = State(x=start[0], x_dot=(start[1] - start[0]) / 1e-3, y=(0.0, 0.0, 1.0))
    run = simulate(machine, law, state, DURATION, plant=PLANT.replace(seed=seed))
    completed = run.outcome.status == "completed"
    judged = run.t >= DURATION - JUDGED
    difference = (run.x - run.x_ref)[judged]
    return Tracking(
        law=name,
        case=case,
        stood=bool(completed and np.all(run.y[judged, 2] > 0.9)),
        offset=float(norm(difference.mean(axis=0))) if completed else np.nan,
        error=float(np.sqrt(np.mean(norm(difference) ** 2))) if completed else np.nan,
        published=PUBLISHED.get(case, "–"),
    )


def _law(name: str, reference: Callable[[Any], Any]) -> Law:
    if not follows(one_of("law", name, law_names())):
        raise InputError("law", "a law that follows a reference", repr(name))
    return FACTORIES[name](reference=reference)


def tracking_table(results: Iterable[Tracking]) -> Table:
    """Return the table of offsets and errors, hover and circles, for the terminal."""
    table = Table(title="Set-up of Hehn and D'Andrea (2011)", title_justify="left", box=SIMPLE, padding=(0, 0, 0, 1))
    for name in ("case", "law", "stands", "offset m", "RMS error m", "published m"):
        table.add_column(name, justify="left" if name in ("case", "law") else "right")
    for r in results:
        stands = "yes" if r.stood else "[red]no"
        table.add_row(r.case, r.law, stands, short(r.offset), short(r.error), r.published)
    table.caption = "50 Hz, 30 ms latency, motion-capture noise, 2 % model error; published: their experiment"
    table.caption_justify = "left"
    return table


if __name__ == "__main__":
    found = hehn2011(tuple(sys.argv[1:]) or ("inverted", "lqr"))
    Console().print(tracking_table(found))
    for tracking in found:
        record(f"{tracking.case}, {tracking.law}", offset=tracking.offset, error=tracking.error)
