"""A study as data: the flight, what varies, the sample, and the success criterion."""

from __future__ import annotations

import json
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import asdict, dataclass, field
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from flypend import errors
from flypend.errors import InputError
from flypend.files.toml import parse_toml, read_toml, toml_text
from flypend.flight.criterion import Criterion
from flypend.flight.request import SAMPLE_PERIOD, Flight, Tolerances, check_judged
from flypend.flight.sampled import is_random
from flypend.laws import BoundLaw, Controller, Law
from flypend.laws.by_name import THEOREM_1
from flypend.model import Vehicle, Wrench
from flypend.model.by_name import vehicle_table
from flypend.model.state import E3Direction
from flypend.plants import AnyPlant, Ideal, Sampled
from flypend.settings.laws import absolute, drop_folders, law_from, law_table, relative, table_of
from flypend.settings.runfile import STUDY_KEYS, check_plain, plant_of, record_at, shallow, start_of, table_at
from flypend.studies.sweep.axes import Axis, axes
from flypend.studies.sweep.cube import SAMPLINGS, check_size

KEYS = ("vehicle", "law", "plant", "duration", "rtol", "start", *STUDY_KEYS)
# Runs per chunk (ideal plant, sampled plant, MuJoCo, callable law): each takes a few seconds on one core.
CHUNK, CHUNK_SAMPLED, CHUNK_MUJOCO, CHUNK_STEPPED = 32_768, 2_048, 64, 16
# A run usually takes a few hundred integrator steps; one that takes this many is chattering.
STEPS = 20_000
MOST_CHUNK = 1_000_000
MOST_RUNS = 10**9
MOST_PLANTS = 32  # more are not worth compiling


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Study:
    """A study of many runs.

    Parameters
    ----------
    flight : Flight
        The request that all runs share, except for what varies.
    axes : tuple of Axis
        The quantities that vary.
    samples : int
        Runs in each cell of the grid; every cell flies the same sample.
    sampling : "uniform", "sobol" or "latin"
        How the sample is drawn.
    seed : int
        Seed of the sample.
    chunk : int
        Number of runs that are flown and stored together.
    final : bool
        Whether final states are stored.
    settings : dict
        The study as the content of a TOML file, every default spelt out.
    tune : dict
        The table `tune`: see `flypend.studies.tune`.
    """

    flight: Flight
    axes: tuple[Axis, ...]
    samples: int
    sampling: str
    seed: int
    chunk: int
    final: bool
    settings: dict[str, Any]
    tune: dict[str, Any] = field(default_factory=dict)

    @property
    def grid(self) -> tuple[Axis, ...]:
        """The axes on a grid, those of the plant first."""
        return tuple(axis for axis in self.axes if axis.values)

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of points of each axis of the grid."""
        return tuple(len(axis.values) for axis in self.grid)

    @property
    def dimensions(self) -> int:
        """Dimensions of the sample."""
        return sum(axis.dimensions for axis in self.axes)

    @property
    def cells(self) -> int:
        """Number of cells of the grid."""
        return prod(self.shape)

    @property
    def plant_cells(self) -> range:
        """The first cell of each plant: the axes of the plant are the outermost ones."""
        return range(0, self.cells, prod(len(axis.values) for axis in self.grid if axis.group != "plant"))

    @property
    def runs(self) -> int:
        """Number of runs, over all cells of the grid."""
        return self.samples * self.cells

    @property
    def chunks(self) -> int:
        """Number of chunks."""
        return -(-self.runs // self.chunk)

    def rows(self, number: int) -> range:
        """Return the runs of chunk `number`."""
        return range(number * self.chunk, min((number + 1) * self.chunk, self.runs))

    @property
    def gains(self) -> tuple[str, ...]:
        """Names of the gains that vary."""
        return tuple(axis.name for axis in self.axes if axis.group == "gains")

    @property
    def law(self) -> BoundLaw | Controller:
        """The law of the study."""
        return self.flight.law

    def text(self, folder: Path | None = None) -> str:
        """Return the study as TOML, keys sorted, every default spelt out, without the table `tune`.

        The file of its law is relative to `folder`; by default its path is absolute.
        """
        law = self.settings["law"]
        return toml_text(_sorted({**self.settings, "law": law if folder is None else relative(law, folder)}))

    def plant_at(self, cell: int) -> AnyPlant:
        """Return the plant of cell `cell` of the grid."""
        axes_ = [axis for axis in self.grid if axis.group == "plant"]
        if not axes_:
            return self.flight.plant
        place = np.unravel_index(cell, self.shape)
        table, sensors = deepcopy(self.settings["plant"]), getattr(self.flight.plant, "sensors", None)
        if sensors is not None and any(axis.name.startswith("sensors.") for axis in axes_):
            table["sensors"] = sensors.to_dict()  # they may be a name, or those of the base
        for axis, index in zip(axes_, place, strict=False):
            *outer, name = axis.name.split(".")
            inner = table
            for key in outer:
                inner = inner.setdefault(key, {})
            inner[name] = axis.values[index]
        return plant_of(table)


@errors.named_arguments
@shallow("study")
def study(what: str | Path | Mapping[str, Any], law: str | None = None) -> Study:
    """Return the study in `what`, a TOML file or its content as a dict; docs/studies/studies.md lists the keys.

    `law`, in the form used on the command line, replaces the law.

    Raises InputError if anything is unknown (naming the closest match), missing, or out of range.
    """
    settings = deepcopy(dict(what)) if isinstance(what, Mapping) else read_toml(what)
    if not isinstance(what, Mapping) and settings.keys() and not settings.keys() & STUDY_KEYS:
        raise InputError(str(what), "a study (runs, vary, …)", f"a run file, or another: flypend run {what}")
    if "law" in settings and not isinstance(what, Mapping):
        settings["law"] = absolute(settings["law"], Path(what).parent)
    if law is not None:
        settings["law"] = table_of(law)
    for key, value in settings.items():
        check_plain(key, value)
    with np.errstate(all="ignore"):  # huge numbers overflow during validation, and so fail it
        return _build(settings)


def study_in(text: str, name: str, e3: E3Direction) -> Study:
    """Return the study in the TOML string `text` of a store, to read its runs: without its law, which may not be there.

    In its place is a law of that `name` and frame that does not fly. Raises InputError.
    """
    given = parse_toml("study", text)
    gains = table_at(table_at(given, "vary"), "gains", "vary.gains")
    stand_in = Law(name=name, e3=e3, control=_refuse, gains=dict.fromkeys(gains, 1.0))
    with shallow("study"), np.errstate(all="ignore"):
        return _build(given, stand_in)


def _refuse(*_: Any, **__: Any) -> Wrench:
    raise InputError("law", "the study's own law, to fly it", "a store")


def comparable(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return the `settings` of a study to compare with others: its law's file may be in another folder."""
    return {**settings, "law": drop_folders(settings["law"])}


def canonical(settings: Mapping[str, Any]) -> str:
    """Return the `settings` of a study as text that is the same for any order of keys, `5` or `5.0`, and folder."""
    return json.dumps(_floats(comparable(settings)), sort_keys=True)


def _floats(value: Any) -> Any:
    """Return `value` with integers as floats, where these are equal."""
    if isinstance(value, Mapping):
        return {key: _floats(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_floats(entry) for entry in value]
    return float(value) if type(value) is int and float(value) == value else value


def _sorted(value: Any) -> Any:
    """Return `value` with the keys of its tables sorted."""
    if isinstance(value, Mapping):
        return {key: _sorted(value[key]) for key in sorted(value)}
    return [_sorted(entry) for entry in value] if isinstance(value, list) else value


def _build(given: dict[str, Any], stand_in: Law | None = None) -> Study:
    """The study that `given` specifies; under the law `stand_in`, if there is one, instead of its own."""
    errors.only_known("", given, KEYS)
    for key in ("vehicle", "law", "duration"):
        if key not in given:
            raise InputError(key, "a value", "nothing")
    start, vary = _start(given)
    flight = _flight(given, start, vary, stand_in)
    # A law in Python flies sampled through the ideal plant, too, which has no numbers to vary.
    found = axes(vary, flight.law, isinstance(plant_of(given.get("plant", "rotors")), Sampled))
    errors.check_kind("final", given.get("final", False), bool)
    # Sorted, so that the sample does not depend on the order of the keys in the file.
    order = {"plant": 0, "gains": 1, "start": 2}
    made = Study(
        flight=flight,
        axes=tuple(sorted(found, key=lambda axis: (order[axis.group], axis.name))),
        samples=errors.integer("runs", given.get("runs", 1), 1),
        sampling=errors.one_of("sampling", given.get("sampling", "uniform"), SAMPLINGS),
        seed=errors.integer("seed", given.get("seed", 1), 0),
        chunk=errors.integer("chunk", given.get("chunk", _chunk(flight)), 1),
        final=given.get("final", False),
        settings={},
        tune=table_at(given, "tune"),
    )
    exact, plant = flight.tolerances, given.get("plant", "rotors")
    settings = {
        "duration": flight.duration, "rtol": exact.rtol, "judge_period": flight.judge_period,
        "precision": exact.precision, "max_steps": exact.max_steps,
        "runs": made.samples, "sampling": made.sampling, "seed": made.seed, "chunk": made.chunk, "final": made.final,
        "vehicle": flight.vehicle.to_dict(), "law": absolute(law_table(given["law"]), Path.cwd()),
        "plant": {"base": plant} if isinstance(plant, str) and plant != "ideal" else plant,
        "criterion": asdict(flight.criterion), "start": start, "vary": vary,
    }  # fmt: skip
    object.__setattr__(made, "settings", settings)
    _check(made)
    return made


def _flight(given: dict[str, Any], start: dict[str, Any], vary: dict[str, Any], stand_in: Law | None) -> Flight:
    """The request that all runs share, except for what varies."""
    exact = Tolerances(
        rtol=errors.number("rtol", given.get("rtol", 1e-6), above=0),
        precision=given.get("precision", "double"),
        max_steps=errors.integer("max_steps", given.get("max_steps", STEPS), 100),
    )
    vehicle = Vehicle.from_dict(vehicle_table(given["vehicle"]))
    leans = {"y", "tilt", "azimuth"} & table_at(vary, "start").keys()  # from e₃
    flight = Flight(
        vehicle=vehicle,
        law=(stand_in or law_from(law_table(given["law"]))).bind(vehicle),
        starts=start_of({"y": [0.0, 0.0, 1.0], **start} if leans else start),
        duration=given["duration"],
        plant=plant_of(given.get("plant", "rotors")),
        tolerances=exact,
        criterion=record_at(given, "criterion", Criterion),
        judge_period=given.get("judge_period", SAMPLE_PERIOD),
    )
    check_judged(flight)
    return flight


def _chunk(flight: Flight) -> int:
    if isinstance(flight.law, Controller):
        return CHUNK_STEPPED
    if isinstance(flight.plant, Sampled) and flight.plant.engine == "mujoco":
        return CHUNK_MUJOCO
    return CHUNK if isinstance(flight.plant, Ideal) else CHUNK_SAMPLED


def _start(given: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The tables `start` and `vary`; no quantity may be in both."""
    start, vary = table_at(given, "start"), table_at(given, "vary")
    varied = set(table_at(vary, "start", "vary.start"))
    for name in start:
        if name in varied or (name == "y" and {"tilt", "azimuth"} & varied) or (name == "y_dot" and "rate" in varied):
            raise InputError(f"start.{name}", "nothing, since it varies", repr(start[name]))
    if {"y", "tilt", "azimuth"} & varied and "y_dot" in start:
        raise InputError("start.y_dot", "nothing where the rod varies: it would not stay tangent", start["y_dot"])
    return start, vary


def _check(made: Study) -> None:
    """Reject what is too large or inconsistent, and an invalid plant in the grid."""
    if made.runs > MOST_RUNS:
        raise InputError("runs", f"at most {MOST_RUNS} over all cells of the grid", made.runs)
    if made.chunk > MOST_CHUNK:
        raise InputError("chunk", f"at most {MOST_CHUNK}", made.chunk)
    check_size(made.sampling, made.samples, made.dimensions)
    if len(made.plant_cells) > MOST_PLANTS:
        raise InputError("vary.plant", f"at most {MOST_PLANTS} plants", len(made.plant_cells))
    plants = [made.plant_at(cell) for cell in made.plant_cells]
    drawn = made.dimensions > 0 or any(isinstance(plant, Sampled) and is_random(plant) for plant in plants)
    if made.samples > 1 and not drawn:
        raise InputError("runs", "1, since nothing is drawn", made.samples)


def standard(law: str, vehicle: str | None, plant: Any, runs: int, seed: int, duration: float | None) -> dict[str, Any]:
    """Return the standard study of a law: y uniform on S², R on SO(3), rates and velocities in balls.

    By default the paper's laws have 6.5 s to bring the rod to their e₃, at any position, and all others have 10 s to
    invert it at their reference.
    """
    papers = law in THEOREM_1
    return {
        "vehicle": vehicle or ("nayak2018" if papers else "hehn2011"),
        "law": table_of(law),
        "plant": plant,
        "duration": duration if duration is not None else 6.5 if papers else 10.0,
        "judge_period": 0.1,
        "runs": runs,
        "seed": seed,
        "criterion": {"target": "e3", "position": float("inf")} if papers else {},
        "vary": {
            "start": {
                "y": "uniform", "R": "uniform", "omega": {"ball": 3.0}, "y_dot": {"disc": 3.0}, "x_dot": {"ball": 2.0}
            }
        },
    }  # fmt: skip
