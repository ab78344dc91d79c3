"""The commands of many flights: compare laws, find what breaks them, sweep and map starts, tune gains, learn a law."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import flypend as fp
from flypend.cli.options import (
    FLOOR_HELP,
    LAW_HELP,
    SENSORS_HELP,
    Output,
    band_worlds,
    bands_option,
    floor_option,
    laws_option,
    option,
    options_of,
    out_option,
    path,
    plant_asked,
    refuse_idle,
    sensors_asked,
    sensors_option,
    vehicle_option,
)
from flypend.cli.terminal import bold, console, counter, import_in_background, is_missing, resumable, tell_how
from flypend.errors import InputError, number, one_of, require
from flypend.files.staging import staging
from flypend.files.whole import FIGURES, save_figure

if TYPE_CHECKING:
    from flypend.plants import AnyPlant

REPORTED = 2000  # starts of the report where no study names them
CHECKPOINT = "checkpoint.npz"  # of learning
OFTEN = 100  # updates between checkpoints
HELD_OUT = 10**6  # added to the seed: the starts of the judgement are none of the training
workers_option = click.option("--workers", type=click.IntRange(min=1), help="Number of cores to use; default all.")
law_option = click.option("--law", help=f"Replace the law of the study: {LAW_HELP}.")
force_option = click.option("--force", is_flag=True, help="Discard the store of an earlier sweep and start over.")


@dataclass(frozen=True)
class Starts:
    """Which vehicle flies from where, and for how long."""

    starts: str = option("random, or paper: the five starts of the paper, in the e₃-up frame.", default="random")
    runs: int = option("Number of random starts.", type=click.IntRange(min=1), default=100)
    seed: int = option("Seed of the random starts.", type=click.IntRange(min=0), default=1)
    vehicle: str = option("Vehicle name or TOML file.", default="hehn2011")
    duration: float = option("Seconds per flight.", default=10.0)

    def of(self, names: Sequence[str]) -> tuple[list[Any], Any, Any, dict[str, Any]]:
        """Return the laws called `names`, starts and vehicle, and the settings for a report. Raises InputError."""
        from flypend.studies import law_named, paper_starts

        laws = [law_named(name) for name in names]
        for law in laws:
            tell_how(law)
        machine = fp.vehicle(self.vehicle)
        number("--duration", self.duration, above=0, unit="s")
        kind = one_of("--starts", self.starts, ("random", "paper"))
        if kind == "paper":
            refuse_idle("runs", "seed", why="beside --starts paper, which are five")
        batch = paper_starts() if kind == "paper" else fp.random_starts(self.runs, self.seed)
        settings = {"laws": list(names), "vehicle": machine.name, "starts": kind, "runs": len(batch)}
        settings["duration"] = self.duration
        return laws, batch, machine, settings | ({"seed": self.seed} if kind == "random" else {})


@click.command()
@laws_option
@out_option("compare-out")
@options_of(Starts, "chosen")
@click.option("--plant", default="rotors", help="ideal, rotors, mujoco, hehn2011 or laboratory.")
@sensors_option
@bands_option
@floor_option
@click.option("--keep", type=Output(), help="Also save each failed flight in DIR (.nc).")
def compare(
    law: tuple[str, ...],
    out: Path,
    chosen: Starts,
    plant: str,
    sensors: str,
    bands: bool,
    floor: float | None,
    keep: Path | None,
) -> None:
    """Compare laws, your own included, from the same starts, in one table and one figure.

    The first 100 failures of each law become run files for flypend run, in the folder failed of the output.

    A run succeeds if, during the last second, |y - e₃| and |z - e₃| stay below 0.05 and the pivot stays within 0.2 m of
    its reference.
    """
    from flypend.report.studies import comparison_table, write_comparison
    from flypend.settings.runfile import plant_of
    from flypend.studies.compare import files_of_failures, fly_again

    asked, duration = plant_asked(plant, sensors, floor), chosen.duration
    world = plant_of(asked)
    names = law or ("inverted", "lqr", "corrected", "detuned")
    laws, batch, machine, settings = chosen.of(names)
    settings = {**settings, "plant": asked} | ({"bands": True} if bands else {})
    drawn = list(band_worlds(machine, asked, chosen.seed).values()) if bands else []
    import_in_background(lambda: import_module("flypend.pictures.studies"))
    with counter() as tell:
        flying = lambda name, done, total: tell(f"flying {name}", done, total)  # noqa: E731
        result = fp.compare(machine, laws, batch, duration, plant=drawn or world, progress=flying)
    failed = files_of_failures(result, names, asked, duration, drawn)
    write_comparison(result, settings, out, failed)
    if keep is not None:
        with staging(keep) as folder, counter() as tell:
            fly_again(failed, folder, tell)
    console.print(comparison_table(result))
    again = f", {len(failed)} failed flights in {bold(out / 'failed')}" if failed else ""
    console.print(f"Report and figure are in {bold(out)}{again}.")


@click.command()
@laws_option
@out_option("ladder-out")
@options_of(Starts, "chosen")
@click.option(
    "--rung", multiple=True, help="Fly only this rung; repeatable. Combine departures with commas: 'noise, rod +10 %'."
)
@click.option("--sensors", help="Fly a rung for each error of these sensors instead: mocap, onboard or a TOML file.")
@bands_option
def ladder(
    law: tuple[str, ...], out: Path, chosen: Starts, rung: tuple[str, ...], sensors: str | None, bands: bool
) -> None:
    """Find what breaks each law: limits, lag, motors, air, sampling, delay, noise, wrong models, or several at once."""
    from flypend.plants import plant
    from flypend.report.studies import ladder_table, write_ladder
    from flypend.studies import ladder as climb
    from flypend.studies.ladder import rung_named, rungs_for, sensor_rungs

    laws, batch, machine, settings = chosen.of(law or ("inverted", "lqr"))
    if bands:
        rungs: Mapping[str, AnyPlant] = band_worlds(machine, plant_asked("rotors", sensors or "perfect"), chosen.seed)
    else:
        rungs = rungs_for(machine) if sensors is None else sensor_rungs(sensors_asked(sensors), Path(sensors).name)
    flown = {
        name: rung_named(name, rungs)
        for name in rung or rungs
        if rung or not is_missing(f"the rung {name}", partial(plant, rungs[name]))
    }
    import_in_background(lambda: import_module("flypend.pictures.studies"))
    with counter() as tell:
        result = climb(machine, laws, batch, chosen.duration, rungs=flown, progress=tell)
    write_ladder(result, settings, out)
    console.print(ladder_table(result))
    console.print(f"Report and figure are in {bold(out)}.")


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
    fly_study(fp.study(study, law), out, scheduler=scheduler, workers=workers, processes=processes, force=force)


@dataclass(frozen=True)
class Standard:
    """The study of a law from random starts."""

    law: str | None = option(f"Fly this law from random starts instead of a study: {LAW_HELP}.")
    vehicle: str | None = option("With --law: vehicle name or TOML file.")
    plant: str = option("With --law: ideal, rotors, mujoco, hehn2011 or laboratory.", default="rotors")
    sensors: str = option(SENSORS_HELP, default="perfect")
    floor: float | None = option(FLOOR_HELP, metavar="M")
    runs: int = option("With --law: number of runs.", type=click.IntRange(min=1), default=100_000)
    seed: int = option("With --law: seed of the starts.", type=click.IntRange(min=0), default=1)
    duration: float | None = option("With --law: seconds per run.")


@click.command("map")
@click.argument("what", type=path, required=False)
@out_option("map.png", "Output file: .png, .pdf or .svg.", *FIGURES)
@click.option("--x", help="Quantity on the horizontal axis, such as tilt, rate or gains.k_d.")
@click.option("--y", help="Quantity on the vertical axis.")
@options_of(Standard, "own")
@workers_option
@force_option
def draw_map(
    what: Path | None, out: Path, x: str | None, y: str | None, own: Standard, workers: int | None, force: bool
) -> None:
    """Map success, settling time, excursion and causes of failure over the rod's initial direction and over a plane.

    WHAT is the store of a sweep (.zarr), or the TOML file of a study to fly first. With a study or --law, the runs are
    saved to a store next to the map, and an interrupted command resumes.
    """
    from flypend.studies.sweep.bins import check_plane
    from flypend.studies.sweep.study import standard

    for module in ("zarr", "xarray", "scipy"):
        require(module, extra="studies", for_="map")
    if (what is None) == (own.law is None):
        raise InputError("map", "a store, a study, or --law", "none" if what is None else "two of them")
    if what is not None:
        why = "beside a study or a store, which has its own"
        refuse_idle("vehicle", "plant", "sensors", "floor", "runs", "seed", "duration", why=why)
    made, store = None, what
    if own.law is not None:
        plant = plant_asked(own.plant, own.sensors, own.floor)
        made = fp.study(standard(own.law, own.vehicle, plant, own.runs, own.seed, own.duration))
    elif what is not None and what.suffix == ".toml":
        made = fp.study(what)
    else:
        refuse_idle("workers", "force", why="beside a store, whose runs are flown")
    if made is not None:
        check_plane(made, x, y)
        store = out.with_suffix(".zarr")
        import_in_background(lambda: import_module("flypend.pictures.maps"))
        fly_study(made, store, workers=workers, force=force)
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
    from flypend.report.tuning import summarise, write_tuned
    from flypend.studies.sweep.study import standard
    from flypend.studies.tune import DRAWN

    if (study is None) == (vehicle is None):
        raise InputError("tune", "a study, or --vehicle", "none" if study is None else "two of them")
    if study is not None:
        refuse_idle("sensors", why="beside a study, which has its own")
        made = fp.study(study, law)
    else:
        made = fp.study(standard(law or "inverted", vehicle, plant_asked("rotors", sensors), REPORTED, 1, None))
    if bands:
        made = replace(made, tune={"bands": DRAWN, "runs": 10 * DRAWN, **made.tune})
    tell_how(made.law)
    with resumable(), counter(rate=True) as tell:
        progress = partial(tell, "generations")
        result = fp.tune(made, workers=workers, costs=out / "costs.jsonl", progress=progress)
    write_tuned(result, out)
    console.print(f"before: {summarise(result.before)}", markup=False)
    console.print(f"after:  {summarise(result.after)}", markup=False)
    console.print(", ".join(f"{name} = {value:g}" for name, value in result.gains.items()), markup=False)
    console.print(f"Results are in {bold(out)}.")


@click.command()
@vehicle_option
@out_option("learn-out")
@click.option("--seed", type=click.IntRange(min=0), default=0, help="Seed of the initial weights and of the starts.")
@click.option("--mount", help="What carries the rod: gimbal or hub; default the vehicle's own.")
@bands_option
@sensors_option
@click.option("--updates", type=click.IntRange(min=1), help="Gradient updates; default 1500, on a hub 1200.")
@click.option("--runs", type=click.IntRange(min=1), default=500, help="Number of flights that evaluate the result.")
def learn(
    vehicle: str, out: Path, seed: int, mount: str | None, bands: bool, sensors: str, updates: int | None, runs: int
) -> None:
    """Learn a law for VEHICLE: a small network that imitates the inverted law and then improves on it.

    Writes the training curve and the policy. To fly the policy, use its file as --law. After an interruption, the same
    command resumes, with the same result.

    With --bands, training flies machines drawn from the bands of VEHICLE, with late commands; with --sensors, the
    network sees states with the errors of an estimator. The result is compared with the inverted law on other such
    machines, with these sensors.
    """
    from flypend.learning.training import Learner, usual
    from flypend.plants import as_sampled
    from flypend.report.learning import write_learned
    from flypend.report.studies import comparison_table
    from flypend.settings.runfile import plant_of
    from flypend.studies.advice import best_of
    from flypend.studies.starts import check_starts

    machine = fp.vehicle(vehicle)
    if mount is not None:
        machine = machine.replace(mount=mount)
    check_starts(runs, HELD_OUT + seed)
    asked = plant_asked("rotors", sensors)
    world = as_sampled(plant_of(asked))
    learner = Learner(usual(machine, seed, updates, bands, world.sensors))
    out.mkdir(parents=True, exist_ok=True)
    checkpoint = out / CHECKPOINT
    with resumable(), counter() as tell:
        if not learner.resume(checkpoint):
            learner.imitate(lambda entry: tell("imitation", int(entry.update), learner.training.rounds))
            learner.save(checkpoint)
        while learner.done < learner.training.updates:
            learner.descend()
            tell("descent", learner.done, learner.training.updates)
            if learner.done % OFTEN == 0 or learner.done == learner.training.updates:
                learner.save(checkpoint)
    policy = write_learned(learner, out)
    console.print(f"The policy is {bold(policy)}, its training {bold(out / 'curve.png')}.")
    laws, starts = [fp.laws.learned(policy=str(policy)), fp.laws.inverted()], fp.random_starts(runs, HELD_OUT + seed)
    if not bands:  # LQR flies few of these starts as written, too, and a machine takes long to compile
        laws.append(fp.laws.lqr())
    worlds = list(band_worlds(machine, asked, HELD_OUT + seed).values()) if bands else [world]
    comparison = fp.compare(machine, laws, starts, plant=worlds)
    console.print(comparison_table(comparison))
    best = best_of(comparison.ensembles)
    console.print(f"The best law here is {best}." if best else "None of these laws succeeds from 90 % of the starts.")


def fly_study(made: fp.Study, store: Path, *, processes: bool = False, **options: Any) -> None:
    """Fly the study `made` into `store` with these options of `studies.sweep`, and print the success rate."""
    from flypend.studies.sweep.tally import Tally

    tell_how(made.law)
    if isinstance(made.law, fp.Controller) and options.get("scheduler") is None:
        processes = True  # it flies step by step in Python, so that only processes can use more than one core
    with resumable(), counter(rate=True) as tell:
        flown = fp.sweep(made, store, processes=processes, **options, progress=partial(tell, f"flying {made.law.name}"))
    tally = Tally(made)
    for rows in map(made.rows, range(made.chunks)):
        tally.add(rows, flown.success[rows.start : rows.stop].values)
    rate = f"{100 * tally.rate:.4g} % ({tally.describe_interval()})"
    console.print(f"{tally.successes} of {tally.runs} runs succeed: {rate}. Runs are in {bold(store)}.")
