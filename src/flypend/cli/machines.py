"""The commands that find a machine's numbers, from its parts and in a flight log, and say what it can do."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import flypend as fp
from flypend.cli.options import (
    BANDS_HELP,
    FLOOR_HELP,
    laws_option,
    option,
    options_of,
    out_option,
    path,
    plant_asked,
    refuse_idle,
    vehicle_option,
)
from flypend.cli.terminal import bold, console, counter, tell_how
from flypend.errors import InputError, one_of
from flypend.files.whole import check_file, check_same, whole_file

if TYPE_CHECKING:
    from flypend.identification import Command


@click.group(invoke_without_command=True)
@click.pass_context
def vehicle(context: click.Context) -> None:
    """Describe a machine of your own: flypend vehicle new."""
    if context.invoked_subcommand is None:
        raise click.UsageError("Missing command: new.")


@vehicle.command()
@click.option("--mass", required=True, help="Without the rod, battery included: 0.62, 620g.")
@click.option("--arm", required=True, help="From the centre to a rotor: 0.17, 17cm.")
@click.option("--propeller", required=True, help="Inches 10x4.5 or 1045, a diameter 254mm, or a name.")
@click.option("--rod-length", required=True, help="From the pivot to the end of the rod: 0.9, 90cm.")
@click.option("--rod-mass", default="0", help="Of a uniform rod.")
@click.option("--bob-mass", default="0", help="At the end of the rod.")
@click.option("--motor", help="Speed per volt, 920KV, or a name; with --battery.")
@click.option("--battery", help="Cells, 4S, or volts.")
@click.option("--thrust", help="Largest force of one rotor, if measured: 8, 820gf.")
@click.option("--inertia", nargs=3, type=float, help="Principal moments, if known, kg m².")
@click.option("--rotors", default=4, help="At equal angles.")
@click.option("--mount", default="gimbal", help="gimbal, hub or cup.")
@out_option("mine.toml", "The vehicle, with bands and sources.", ".toml")
@click.option("--force", is_flag=True, help="Overwrite a file that differs.")
def new(out: Path, force: bool, **measured: Any) -> None:
    """Write a vehicle file from weights, lengths and parts; guess the rest.

    Quantities are SI numbers or have a unit: 620g, 17cm, 820gf.
    """
    from flypend.model.estimate import Measured, guess

    found = guess(Measured(**measured, name=out.stem))
    machine = fp.Vehicle(**found.fields)
    if not force:
        check_same(out, found.text().encode(), "the vehicle")
    with whole_file(out, (".toml",)) as partial:
        partial.write_text(found.text(), encoding="utf-8")
    surplus = len(machine.rotor_spins) * machine.rotor_limits[1] / machine.weight
    console.print(f"{machine!r}", markup=False, highlight=False, soft_wrap=True)
    console.print(f"Its rotors push {surplus:.2g} times its weight, by this guess.")
    console.print(f"The vehicle is in {bold(out)}; next: flypend identify flight.csv --vehicle {out}", soft_wrap=True)


@dataclass(frozen=True)
class Rehearsal:
    """A flight in simulation."""

    asked: bool = option("First fly the manoeuvre with --vehicle in simulation, and write LOG.", "--rehearse")
    duration: float = option("Length of the rehearsal, s.", default=60.0)
    seed: int = option("Seed of the rehearsal.", type=click.IntRange(min=0), default=0)


@click.command()
@click.argument("log", type=path)
@vehicle_option
@out_option("identified.toml", "The machine found, with its bands.", ".toml")
@click.option(
    "--marker",
    nargs=3,
    type=float,
    default=(0.0, 0.0, 0.0),
    help="Position of the tracked point from the pivot, body frame, m.",
)
@click.option("--command", default="newton", help="What u1, u2, … are: newton, or pwm, fractions from 0 to 1.")
@click.option("--mass-error", default=0.005, help="Relative error within which the vehicle's mass is known.")
@options_of(Rehearsal, "rehearsal")
def identify(
    log: Path,
    vehicle: str,
    out: Path,
    marker: tuple[float, float, float],
    command: Command,
    mass_error: float,
    rehearsal: Rehearsal,
) -> None:
    """Find a machine's numbers, with bands, in LOG, a CSV, ULog, µSD or MCAP file of a flight with the rod hanging.

    --vehicle is the guess. Its mass counts as weighed; the positions, spins and limits of its rotors are taken as
    exact. The columns of a CSV are t, x, y, z, qw, qx, qy, qz, gx, gy, gz, u1 to u4, and optionally ax, ay, az, rx, ry,
    rz, vbat. For PX4's ULog, add --command pwm. An MCAP file is a ROS 2 bag. If the search has not converged, the
    file begins with a comment that says so.
    """
    from flypend.files.toml import toml_text
    from flypend.identification.manoeuvre import rehearsal_of, write_log

    machine = fp.vehicle(vehicle)
    with counter() as tell:
        if rehearsal.asked:
            refuse_idle("marker", "command", why="beside --rehearse, whose log is its own")
            check_file(log, (".csv",), "LOG")
            if log.exists():  # it may be a real flight
                raise InputError(str(log), "no file yet, as --rehearse writes it", "one")
            guess, flown = rehearsal_of(machine, duration=rehearsal.duration, seed=rehearsal.seed)
            write_log(log, flown.columns)
            machine = guess
        else:
            refuse_idle("seed", "duration", why="without --rehearse")
        found = fp.identify(log, machine, marker=marker, command=command, mass_error=mass_error, progress=tell)
    with whole_file(out, (".toml",)) as partial:
        doubt = (
            "" if found.converged else "# The search has NOT converged: numbers may be off by more than their bands.\n"
        )
        partial.write_text(doubt + toml_text(found.vehicle.to_dict()), encoding="utf-8")
    console.print(found.report(), markup=False, highlight=False, soft_wrap=True)
    if rehearsal.asked:
        console.print(f"The search began from {machine.name} with numbers wrong on purpose; the log is {bold(log)}.")
    console.print(f"The machine is in {bold(out)}.")


@dataclass(frozen=True)
class Flights:
    """What is flown."""

    plant: str = option("rotors, mujoco, hehn2011 or laboratory.", default="rotors")
    sensors: str = option(
        "Sensor suite, or a TOML file of one; also flies all errors of a laboratory at once.", default="perfect"
    )
    floor: float | None = option(FLOOR_HELP, metavar="M")
    runs: int | None = option(
        "Random starts of a task, and of all errors at once; default 1000 and 384, fewer if the law is slow.",
        type=click.IntRange(min=1),
    )
    seed: int = option("Seed of the random starts.", type=click.IntRange(min=0), default=1)
    advise: bool = option("Name the best law, by default of inverted and learned; if none will do, what to change.")
    bands: bool = option(f"Also f{BANDS_HELP[1:]}")


@click.command()
@click.argument("vehicle")
@laws_option
@out_option("check-out")
@options_of(Flights, "own")
@click.option(
    "--margins/--no-margins", default=None, help="Search for margins; on by default for perfect sensors and fast laws."
)
@click.option("--trial", is_flag=True, help="Also fly a minute with 15 knocks, and sweep every number by ±25 %.")
@click.option("--figures/--no-figures", default=True, help="Draw the figure.")
def check(
    vehicle: str, law: tuple[str, ...], out: Path, own: Flights, margins: bool | None, trial: bool, figures: bool
) -> None:
    """Report what VEHICLE, a name or a TOML file, can do: hover, lean, swing-up, level and random starts, margins.

    Each task gets a grade: flights succeed from all, most (at least 90 %), some or none of its starts. If a law cannot
    even hover, the exit code is 1 and the reason is printed. The default law is inverted.
    """
    from flypend.plants import PRESETS
    from flypend.report.check import check_tables, joint_lines, verdicts, write_check
    from flypend.settings.runfile import plant_of
    from flypend.studies import law_named
    from flypend.studies.advice import advise
    from flypend.studies.joint import joint

    machine = fp.vehicle(vehicle)
    one_of("--plant", own.plant, [name for name in PRESETS if name != "ideal"])
    asked = plant_asked(own.plant, own.sensors, own.floor)
    measured = isinstance(asked, dict) and "sensors" in asked
    if measured and margins is None:
        margins = False  # what fails first, and at which size, is told of all errors together
    world, seed = plant_of(asked), own.seed
    laws = {name: law_named(name) for name in law or ("inverted", *(["learned"] if own.advise else []))}
    for each in laws.values():
        tell_how(each)
    checks, trials, joints = {}, {}, {}
    with counter() as tell:
        for name, each in laws.items():
            checks[name] = fp.check(
                machine, each, plant=world, runs=own.runs, seed=seed, margins=margins, bands=own.bands, progress=tell
            )
            if trial and checks[name].tasks:
                trials[name] = fp.trial(machine, each, plant=world, seed=seed, progress=tell)
            if measured and checks[name].tasks:
                joints[name] = joint(machine, each, plant=world, runs=own.runs, seed=seed, progress=tell)
        advice = advise(machine, checks, plant=world, seed=seed, progress=tell) if own.advise else None
    settings = {"vehicle": vehicle, "laws": list(laws), "plant": asked, "seed": seed}
    write_check(checks, trials, settings, out, figures=figures, joints=joints, advice=advice)
    for table in check_tables(checks, trials):
        console.print(table)
    for line in (*verdicts(checks), *joint_lines(joints), *(advice.lines() if advice else ())):
        console.print(line, markup=False)
    console.print(f"The report{' and its figure are' if figures else ' is'} in {bold(out)}.")
    if not all(each.ok for each in checks.values()):
        sys.exit(1)
