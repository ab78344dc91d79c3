"""The paper's table of experiments, read from `nayak2018.toml` in this folder."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

from flypend import errors, laws
from flypend.laws import Law
from flypend.model import State, Vehicle, vehicle


@dataclass(frozen=True)
class Experiment:
    """One row of the paper's table, in the paper's frame (e₃ along gravity).

    Parameters
    ----------
    name : str
        "1" to "5", and "2-projected" for the second reading of experiment 2.
    vehicle : Vehicle
        The paper's vehicle.
    start : State
        Initial state.
    gains : dict
        k_d, k_1, k_2.
    duration : float
        Seconds.
    plant : str
        Name of the plant; the paper's is the ideal one.
    reading : str
        How the row is read where it cannot be taken as printed; empty otherwise.
    """

    name: str
    vehicle: Vehicle
    start: State
    gains: Mapping[str, float]
    duration: float
    plant: str
    reading: str = ""

    def law(self, name: str = "corrected", **options: Any) -> Law:
        """Return the law `name` (printed, corrected, repaired) with this row's gains and additional `options`."""
        known = ("printed", "corrected", "repaired")
        made: Law = getattr(laws, errors.one_of("law", name, known))(**self.gains, **options)
        return made


@cache
def table() -> dict[str, Any]:
    """Return the content of the table file."""
    text = (resources.files("flypend.paper") / "nayak2018.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


def experiment_names() -> list[str]:
    """Return the names of the experiments, in the paper's order."""
    return list(table()["experiments"])


def experiment(name: str) -> Experiment:
    """Return the experiment called `name`. Raises InputError if the name is unknown."""
    data = table()
    row = data["experiments"][errors.one_of("experiment", name, experiment_names())]
    start = State(**data["start"], y=row["y"], y_dot=row["y_dot"])
    return Experiment(
        name=name, vehicle=vehicle(data["vehicle"]), start=start, gains=row["gains"], duration=data["duration"],
        plant=data["plant"], reading=row.get("reading", ""),
    )  # fmt: skip
