"""The commands for studies of many flights: sweep, map and tune."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from flypend.cli.options import (
    FLOOR_HELP,
    LAW_HELP,
    SENSORS_HELP,
    option,
    options_of,
    out_option,
    path,
    plant_asked,
    refuse_idle,
)
from flypend.cli.terminal import bold, console, counter, import_in_background, is_stepped, resumable, tell_how

if TYPE_CHECKING:
    from flypend.studies.sweep import Study

REPORTED = 2000  # starts of the report where no study names them
workers_option = click.option("--workers", type=click.IntRange(min=1), help="Number of cores to use; default all.")
law_option = click.option("--law", help=f"Replace the law of the study: {LAW_HELP}.")
force_option = click.option("--force", is_flag=True, help="Discard the store of an earlier sweep and start over.")


@click.command()
@click.argument("study", type=path)
@click.option(
    "--out",
    "-o",
    type=path,
    required=True,
    metavar="STORE",
    help="Zarr store for the runs, a folder; its name ends in .zarr.",
)
@click.option("--scheduler", metavar="ADDRESS", help="Dask scheduler to use, such as tcp://host:8786.")
@workers_option
@click.option("--processes", is_flag=True, help="Use worker processes instead of threads.")
@force_option
@law_option
def sweep(
    study: Path, out: Path, scheduler: str | None, workers: int | None, processes: bool, force: bool, law: str | None
) -> None:
    """Fly STUDY, a TOML file, into a Zarr store of up to 10⁷ runs; docs/studies/studies.md lists the keys.

    After any interruption, the same command resumes the sweep. The result is bit-identical
    to that of an uninterrupted one.
    """
    from flypend.studies.sweep import study as study_from

    made = study_from(study, law)
    processes = processes or (scheduler is None and is_stepped(made.law))
    fly_study(made, out, scheduler=scheduler, workers=workers, processes=processes, force=force)


@dataclass(frozen=True)
class Standard:
    """The study of a law from random starts."""

    law: str | None = option("--law", help=f"Fly this law from random starts instead of a study: {LAW_HELP}.")
    vehicle: str | None = option("--vehicle", help="With --law: vehicle name or TOML file.")
    plant: str = option("--plant", default="rotors", help="With --law: ideal, rotors, mujoco, hehn2011 or laboratory.")
    sensors: str = option("--sensors", default="perfect", help=SENSORS_HELP)
    floor: float | None = option("--floor", type=float, metavar="M", help=FLOOR_HELP)
    runs: int = option("--runs", type=click.IntRange(min=1), default=100_000, help="With --law: number of runs.")
    seed: int = option("--seed", type=click.IntRange(min=0), default=1, help="With --law: seed of the starts.")
    duration: float | None = option("--duration", type=float, help="With --law: seconds per run.")


@click.command("map")
@click.argument("what", type=path, required=False)
@out_option("map.png", "Output file: .png, .pdf or .svg.")
@click.option("--x", help="Quantity on the horizontal axis, such as tilt, rate or gains.k_d.")
@click.option("--y", help="Quantity on the vertical axis.")
@options_of(Standard, "own")
@workers_option
@force_option
def draw_map(
    what: Path | None,
    out: Path,
    x: str | None,
    y: str | None,
    own: Standard,
    workers: int | None,
    force: bool,
) -> None:
    """Map success, settling time, excursion and causes of failure over the rod's initial direction and over a plane.

    WHAT is the store of a sweep (.zarr), or the TOML file of a study to fly first. With a study or --law, the runs are
    saved to a store next to the map, and an interrupted command resumes.
    """
    from flypend.errors import InputError, require
    from flypend.files.whole import FIGURES, check_file, save_figure
    from flypend.studies.sweep import study as study_from
    from flypend.studies.sweep.bins import check_plane
    from flypend.studies.sweep.study import standard

    for module in ("zarr", "xarray", "scipy"):
        require(module, extra="studies", for_="map")
    if (what is None) == (own.law is None):
        raise InputError("map", "a store, a study, or --law", "none" if what is None else "two of them")
    if out.suffix.lower() not in FIGURES:
        raise InputError("--out", "a file name ending in " + " or ".join(FIGURES), str(out))
    check_file(out, FIGURES)
    if what is not None:
        why = "beside a study or a store, which has its own"
        refuse_idle("vehicle", "plant", "sensors", "floor", "runs", "seed", "duration", why=why)
    made, store = None, what
    if own.law is not None:
        plant = plant_asked(own.plant, own.sensors, own.floor)
        made = study_from(standard(own.law, own.vehicle, plant, own.runs, own.seed, own.duration))
    elif what is not None and what.suffix == ".toml":
        made = study_from(what)
    else:
        refuse_idle("workers", "force", why="beside a store, whose runs are flown")
    if made is not None:
        check_plane(made, x, y)
        store = out.with_suffix(".zarr")
        import_in_background(lambda: import_module("flypend.pictures.maps"))
        fly_study(made, store, workers=workers, processes=is_stepped(made.law), force=force)
    assert store is not None
    from flypend.pictures.maps import map_figure

    save_figure(map_figure(store, x=x, y=y), out)
    console.print(f"The map is in {bold(out)}.")


@click.command()
@click.argument("study", type=path, required=False)
@out_option("tune-out")
@workers_option
@law_option
@click.option("--vehicle", help="Tune for this vehicle from random starts instead of a study; default law inverted.")
@click.option("--sensors", default="perfect", help=f"With --vehicle: {SENSORS_HELP}")
@click.option("--bands", is_flag=True, help="Also fly vehicles drawn from the bands of the vehicle.")
def tune(
    study: Path | None, out: Path, workers: int | None, law: str | None, vehicle: str | None, sensors: str, bands: bool
) -> None:
    """Tune gains by CMA-ES for the objective in STUDY, a TOML file, or for --vehicle; the report uses other starts.

    Costs are saved after every generation, so the same command resumes an interrupted search.
    Writes tuned.toml, an input of flypend run, and the history of the search as JSON and as a figure.
    """
    from flypend.errors import InputError
    from flypend.files.staging import check_writable
    from flypend.report.tuning import summarise, write_tuned
    from flypend.studies.sweep import study as study_from
    from flypend.studies.sweep.study import standard
    from flypend.studies.tune import DRAWN
    from flypend.studies.tune import tune as search

    if (study is None) == (vehicle is None):
        raise InputError("tune", "a study, or --vehicle", "none" if study is None else "two of them")
    if study is not None:
        refuse_idle("sensors", why="beside a study, which has its own")
        made = study_from(study, law)
    else:
        made = study_from(standard(law or "inverted", vehicle, plant_asked("rotors", sensors), REPORTED, 1, None))
    if bands:
        made = replace(made, tune={"bands": DRAWN, "runs": 10 * DRAWN, **made.tune})
    tell_how(made.law)
    check_writable(out)
    with resumable(), counter(rate=True) as tell:
        progress = partial(tell, "generations")
        result = search(made, workers=workers, costs=out / "costs.jsonl", progress=progress)
    write_tuned(result, out)
    console.print(f"before: {summarise(result.before)}", markup=False)
    console.print(f"after:  {summarise(result.after)}", markup=False)
    console.print(", ".join(f"{name} = {value:g}" for name, value in result.gains.items()), markup=False)
    console.print(f"Results are in {bold(out)}.")


def fly_study(made: Study, store: Path, **options: Any) -> None:
    """Fly the study `made` into `store` with these `options` of `studies.sweep`, and print the success rate."""
    from flypend.studies.sweep import sweep as fly

    tell_how(made.law)
    with resumable(), counter(rate=True) as tell:
        flown = fly(made, store, **options, progress=partial(tell, f"flying {made.law.name}"))
    console.print(f"{format_rate(int(flown.success.sum()), made.runs)} Runs are in {bold(store)}.")


def format_rate(successes: int, runs: int) -> str:
    """Format a success rate with its 95 % confidence interval."""
    from flypend.flight.metrics import wilson

    low, high = wilson(successes, runs)
    share = 100 * successes / runs
    return f"{successes} of {runs} runs succeed: {share:.4g} % (95 % interval {100 * low:.4g} to {100 * high:.4g} %)."
