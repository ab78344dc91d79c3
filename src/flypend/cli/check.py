"""The command that says what a vehicle can do under a law."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from flypend.cli.options import laws_option, out_option, plant_asked
from flypend.cli.terminal import bold, console, counter, tell_how


@click.command()
@click.argument("vehicle")
@laws_option
@out_option("check-out")
@click.option("--plant", default="rotors", help="rotors, mujoco or hehn2011.")
@click.option("--sensors", default="perfect", help="A suite; also flies masses, rod and thrust that are off together.")
@click.option("--runs", type=click.IntRange(min=1), help="Random starts; default 1000, or 24 if the law is slow.")
@click.option("--seed", type=click.IntRange(min=0), default=1, help="Seed of the random starts.")
@click.option("--margins/--no-margins", default=None, help="Search the margins; default unless the law is slow.")
@click.option("--trial", is_flag=True, help="Also fly a minute with 15 knocks, and sweep every number by ±25 %.")
@click.option("--figures/--no-figures", default=True, help="Draw the figure.")
def check(
    vehicle: str,
    law: tuple[str, ...],
    out: Path,
    plant: str,
    sensors: str,
    runs: int | None,
    seed: int,
    margins: bool | None,
    trial: bool,
    figures: bool,
) -> None:
    """Report what VEHICLE, a name or a TOML file, can do: hover, lean, swing-up, level and random starts, margins.

    Each task gets a grade: flights succeed from all, most (at least 90 %), some or none of its starts. The exit code is
    1, with the reason, if a law cannot even hover. The default law is inverted.
    """
    from flypend import errors, model
    from flypend.files.staging import check_writable
    from flypend.plants import PRESETS
    from flypend.report.check import check_tables, joint_lines, verdicts, write_check
    from flypend.settings.runfile import plant_of
    from flypend.studies import law_named
    from flypend.studies.check import check as examine
    from flypend.studies.joint import joint
    from flypend.studies.trial import trial as try_

    machine = model.vehicle(vehicle)
    errors.one_of("--plant", plant, [name for name in PRESETS if name != "ideal"])
    asked = plant_asked(plant, sensors)
    world = plant_of(asked)
    laws = {name: law_named(name) for name in law or ("inverted",)}
    for each in laws.values():
        tell_how(each)
    check_writable(out)
    checks, trials, joints = {}, {}, {}
    with counter() as tell:
        for name, each in laws.items():
            checks[name] = examine(machine, each, plant=world, runs=runs, seed=seed, margins=margins, progress=tell)
            if trial and checks[name].tasks:
                trials[name] = try_(machine, each, plant=world, seed=seed, progress=tell)
            if sensors != "perfect" and checks[name].tasks:
                joints[name] = joint(machine, each, plant=world, seed=seed, progress=tell)
    settings = {"vehicle": vehicle, "laws": list(laws), "plant": asked, "seed": seed}
    write_check(checks, trials, settings, out, figures=figures, joints=joints)
    for table in check_tables(checks, trials):
        console.print(table)
    for line in (*verdicts(checks), *joint_lines(joints)):
        console.print(line, markup=False)
    console.print(f"The report{' and its figure are' if figures else ' is'} in {bold(out)}.")
    if not all(each.ok for each in checks.values()):
        sys.exit(1)


COMMANDS = (check,)
