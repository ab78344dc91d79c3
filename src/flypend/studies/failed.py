"""The failed flights of a comparison as run files, to be flown again one by one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from flypend.model.state import SHAPES
from flypend.plants import AnyPlant
from flypend.settings.laws import absolute, table_of
from flypend.settings.runfile import plant_of
from flypend.studies.compare import Comparison, share_ends

# Of each law at most so many are kept: a law that fails for ever needs no thousand files.
MOST = 100


def files_of_failures(
    comparison: Comparison, laws: Sequence[str], plant: Any, duration: float, drawn: Sequence[AnyPlant] = ()
) -> dict[str, Any]:
    """Return the content of a run file for each failed flight of `comparison`, by name "law-run".

    Parameters
    ----------
    comparison : Comparison
        The comparison, of which at most `MOST` failures a law are taken.
    laws : sequence of str
        Its laws as on the command line, in order.
    plant, duration
        Its plant as in a run file, a name or a table, and the duration of its flights, s.
    drawn : sequence of Plant
        The plants drawn from it through which its shares flew; none if there was but that one.
    """
    found: dict[str, Any] = {}
    table_of_plant, base = {"base": plant} if isinstance(plant, str) else dict(plant), plant_of(plant)
    seed = getattr(base, "seed", None)
    for (name, ensemble), law in zip(comparison.ensembles.items(), laws, strict=True):
        table = absolute(table_of(law), Path.cwd())
        ends = share_ends(len(ensemble), len(drawn)) if drawn else [0]
        for run in np.flatnonzero(~ensemble.success)[:MOST]:
            start = ensemble.starts[run]
            own = _differing(drawn[np.searchsorted(ends, run, "right") - 1], base) if drawn else {}
            found[f"{_plain(name)}-{run}"] = {
                "vehicle": ensemble.vehicle.to_dict(),
                "law": table,
                "plant": plant if seed is None else table_of_plant | own | {"seed": seed + int(run)},
                "duration": float(duration),
                "start": {field: getattr(start, field).tolist() for field in SHAPES},
            }
    return found


def fly_again(runs: Mapping[str, Any], folder: Path, progress: Any = lambda *_: None) -> None:
    """Fly the run files `runs` of `files_of_failures` one by one, and save each in `folder` as name.nc."""
    from flypend.flight.simulate import fly
    from flypend.settings.runfile import run_of

    for done, (name, content) in enumerate(runs.items()):
        progress(f"flying {name} again", done, len(runs))
        fly(run_of(dict(content)).flight).save(folder / f"{name}.nc")


def _differing(plant: AnyPlant, base: AnyPlant) -> dict[str, Any]:
    """Return the fields in which `plant` differs from `base`, as a run file has them."""
    found = {entry.name: getattr(plant, entry.name) for entry in fields(plant)}
    changed = {name: value for name, value in found.items() if value != getattr(base, name)}
    return {name: dict(value) if isinstance(value, Mapping) else value for name, value in changed.items()}


def _plain(name: str) -> str:
    """`name` without characters that a file name cannot have."""
    return "".join(letter if letter.isalnum() else "-" for letter in name).strip("-")
