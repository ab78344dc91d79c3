"""The command that says what a vehicle can do under a law."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import click

from flypend.cli.options import BANDS_HELP, FLOOR_HELP, laws_option, option, options_of, out_option, plant_asked
from flypend.cli.terminal import bold, console, counter, tell_how


@dataclass(frozen=True)
class Flights:
    """What is flown."""

    plant: str = option("--plant", default="rotors", help="rotors, mujoco, hehn2011 or laboratory.")
    sensors: str = option(
        "--sensors",
        default="perfect",
        help="Sensor suite, or a TOML file of one; also flies all errors of a laboratory at once.",
    )
    floor: float | None = option("--floor", type=float, metavar="M", help=FLOOR_HELP)
    runs: int | None = option(
        "--runs", type=click.IntRange(min=1), help="Random starts; default 1000, or 24 if the law is slow."
    )
    seed: int = option("--seed", type=click.IntRange(min=0), default=1, help="Seed of the random starts.")
    advise: bool = option(
        "--advise",
        is_flag=True,
        help="Name the best law, by default of inverted and learned; if none will do, what to change.",
    )
    bands: bool = option("--bands", is_flag=True, help=f"Also f{BANDS_HELP[1:]}")


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
    from flypend import errors, model
    from flypend.files.staging import check_writable
    from flypend.plants import PRESETS
    from flypend.report.check import check_tables, joint_lines, verdicts, write_check
    from flypend.settings.runfile import plant_of
    from flypend.studies import law_named
    from flypend.studies.advice import advise
    from flypend.studies.check import check as examine
    from flypend.studies.joint import joint
    from flypend.studies.trial import trial as try_

    machine = model.vehicle(vehicle)
    errors.one_of("--plant", own.plant, [name for name in PRESETS if name != "ideal"])
    asked = plant_asked(own.plant, own.sensors, own.floor)
    measured = isinstance(asked, dict) and "sensors" in asked
    if measured and margins is None:
        margins = False  # what fails first, and at which size, is told of all errors together
    world, seed = plant_of(asked), own.seed
    laws = {name: law_named(name) for name in law or ("inverted", *(["learned"] if own.advise else []))}
    for each in laws.values():
        tell_how(each)
    check_writable(out)
    checks, trials, joints = {}, {}, {}
    with counter() as tell:
        for name, each in laws.items():
            checks[name] = examine(
                machine, each, plant=world, runs=own.runs, seed=seed, margins=margins, bands=own.bands, progress=tell
            )
            if trial and checks[name].tasks:
                trials[name] = try_(machine, each, plant=world, seed=seed, progress=tell)
            if measured and checks[name].tasks:
                joints[name] = joint(machine, each, plant=world, seed=seed, progress=tell)
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
