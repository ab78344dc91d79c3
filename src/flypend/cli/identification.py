"""The command that finds a machine's numbers in a flight log."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from flypend.cli.options import out_option, refuse_idle, vehicle_option
from flypend.cli.terminal import bold, console, counter

if TYPE_CHECKING:
    from flypend.identification import Command


@click.command()
@click.argument("log", type=click.Path(path_type=Path))
@vehicle_option
@out_option("identified.toml", "The machine found, with its bands.")
@click.option("--marker", nargs=3, type=float, default=(0.0, 0.0, 0.0), help="Tracked point from the pivot, m.")
@click.option("--command", default="newton", help="What u1, u2, … are: newton, or pwm, fractions from 0 to 1.")
@click.option("--mass-error", default=0.005, help="Share within which the vehicle's mass is known.")
@click.option("--rehearse", is_flag=True, help="First fly the manoeuvre with --vehicle in simulation, and write LOG.")
@click.option("--duration", default=60.0, help="Of the rehearsal, s.")
@click.option("--seed", type=click.IntRange(min=0), default=0, help="Seed of the rehearsal.")
def identify(
    log: Path,
    vehicle: str,
    out: Path,
    marker: tuple[float, float, float],
    command: Command,
    mass_error: float,
    rehearse: bool,
    duration: float,
    seed: int,
) -> None:
    """Find a machine's numbers, with bands, in LOG, a CSV file of a flight with the rod hanging.

    --vehicle is the guess: its mass is taken as weighed, its rotors' places, spins and limits as known. The columns of
    LOG are t, x, y, z, qw, qx, qy, qz, gx, gy, gz, u1 to u4, and, if there are, ax, ay, az, rx, ry, rz, vbat.
    """
    from flypend import model
    from flypend.errors import InputError
    from flypend.files.toml import toml_text
    from flypend.files.whole import check_file, whole_file
    from flypend.identification import identify as find
    from flypend.identification.manoeuvre import rehearsal_of, write_log

    machine = model.vehicle(vehicle)
    check_file(out, (".toml",))
    with counter() as tell:
        if rehearse:
            if (marker, command) != ((0.0, 0.0, 0.0), "newton"):
                raise InputError("--rehearse", "the rehearsal's own log: no --marker, no --command", "them")
            check_file(log, (".csv",))
            guess, flown = rehearsal_of(machine, duration=duration, seed=seed)
            write_log(log, flown.columns)
            machine = guess
        else:
            refuse_idle("seed", "duration", why="without --rehearse")
        found = find(log, machine, marker=marker, command=command, mass_error=mass_error, progress=tell)
    with whole_file(out, (".toml",)) as partial:
        partial.write_text(toml_text(found.vehicle.to_dict()), encoding="utf-8")
    console.print(found.report(), markup=False, highlight=False, soft_wrap=True)
    if rehearse:
        console.print(f"The guess was {machine.name} with numbers wrong on purpose; the log is {bold(log)}.")
    console.print(f"The machine is in {bold(out)}.")


COMMANDS = (identify,)
