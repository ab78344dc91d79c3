"""One chunk of a study: sample it, fly it, evaluate the criterion, and return the columns for the store."""

from __future__ import annotations

import hashlib
from itertools import pairwise
from typing import Any

import numpy as np

from flypend.building import builds, built
from flypend.errors import InputError
from flypend.flight.criterion import PARTS
from flypend.flight.ensemble import fly_many
from flypend.flight.kernels import kernel_of, plant_numbers
from flypend.flight.request import Flight
from flypend.laws import Controller
from flypend.laws.own import fingerprint
from flypend.model import State
from flypend.plants import Sampled
from flypend.studies.sweep.design import Design, design
from flypend.studies.sweep.study import Study, study

# The meaning of the stored cause codes, by index.
CAUSES = ("success", *PARTS, "diverged", "singular", "collided")
FLOATS = (
    "settling", "excursion", "effort", "peak_force", "end", "clearance", "lowest", "box_x", "box_y", "box_z"
)  # fmt: skip


@built(maxsize=4)
def _study_of(text: str, program: str) -> Study:
    """Return the study in the TOML string `text`, which must compile to `program`: the file of its law may change.

    Raises InputError if it compiles to another.
    """
    import tomllib

    made = study(tomllib.loads(text))
    if program_digest(made) != program:
        raise InputError("scheduler", "workers with the flypend of this process, and its law", "other equations")
    return made


def fly_chunk(text: str, number: int, program: str) -> dict[str, Any]:
    """Return the columns of chunk `number` of the study in the TOML string `text`, flown on one core.

    Raises InputError if the study compiles to a program other than the caller's (`program`, a digest).
    """
    made = _study_of(text, program)
    rows = made.rows(number)
    return fly_range(made, rows.start, rows.stop)


def fly_range(study: Study, first: int, last: int) -> dict[str, Any]:
    """Return the columns of runs `first` to `last` (exclusive) of `study`, flown on one core."""
    drawn, requests = _requests(study, first, last)
    parts = [fly_many(flight, workers=1) for flight in requests]
    judged = [flown.columns for flown in parts]
    columns = {name: np.concatenate([some[name] for some in judged]) for name in judged[0]}
    cause = np.zeros(last - first, dtype=np.uint8)
    for code, word in enumerate(CAUSES[1:], start=1):
        cause[columns["cause"] == word] = code
    out = {name: value.astype(np.float32) for name, value in drawn.columns.items()}
    out |= {name: columns[name].astype(np.float32) for name in FLOATS}
    out |= {"success": columns["success"], "cause": cause}
    return out | ({"final": np.concatenate([flown.final.packed() for flown in parts])} if study.final else {})


@builds
def _requests(study: Study, first: int, last: int) -> tuple[Design, list[Flight]]:
    """Return runs `first` to `last` (exclusive) of `study`, and their requests."""
    drawn = design(study, first, last)
    return drawn, flights(study, drawn, first)


def flights(study: Study, drawn: Design, first: int = 0) -> list[Flight]:
    """Return the runs `drawn` as requests, one per stretch of runs on one plant; `first` is the first run's index."""
    number = drawn.cells // study.plant_cells.step  # of the plant; they are outermost in the grid
    ends = [0, *(np.flatnonzero(np.diff(number)) + 1).tolist(), len(number)]
    found = []
    for begin, end in pairwise(ends):
        plant, part = study.plant_at(int(drawn.cells[begin])), slice(begin, end)
        seed = plant.seed if isinstance(plant, Sampled) else 0
        flight = study.flight.replace(
            starts=State.trusted(drawn.packed[part]),
            gains={name: value[part] for name, value in drawn.gains.items()},
            plant=plant,
            seed=seed + first + begin,  # the noise of a run does not depend on the chunk
        )
        found.append(flight)
    return found


def program_digest(study: Study) -> str:
    """Return a digest of the compiled program, down to the last operation: law, vehicle, plants and criterion.

    A callable law, which is not compiled, enters by the text of its file.
    """
    digest = hashlib.sha256()
    for cell in study.plant_cells:
        run = cell * study.samples
        (flight,) = flights(study, design(study, run, run + 1))
        if isinstance(flight.law, Controller):
            digest.update(fingerprint(flight.law) + repr((flight.plant, flight.criterion)).encode())
            continue
        kernel = kernel_of(flight)
        if isinstance(flight.plant, Sampled):
            digest.update(plant_numbers(flight.loop).tobytes())
        digest.update(kernel.key.encode())
    return digest.hexdigest()
