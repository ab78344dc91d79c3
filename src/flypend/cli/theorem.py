"""The command that checks the theorems."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from flypend.cli.options import out_option, refuse_idle, style_option, vehicle_option
from flypend.cli.terminal import bold, console, counter

if TYPE_CHECKING:
    from flypend.model import Vehicle


@click.command()
@out_option("theorem-out")
@click.option(
    "--runs", type=click.IntRange(min=1), show_default="200; 100000 with --basin", help="Random flights of each law."
)
@click.option("--seed", type=click.IntRange(min=0), default=7, help="Seed of the random starts.")
@click.option("--basin", is_flag=True, help="Count the random starts that end in the certified set, within limits.")
@click.option("--lag", is_flag=True, help="With --basin: rotors lag as well.")
@click.option("--hanging", is_flag=True, help="With --basin: the rod hangs at the start, within 10° of straight down.")
@click.option("--mount", help="With --basin: what carries the rod, gimbal or hub; default the vehicle's own.")
@vehicle_option
@style_option
def theorem(
    out: Path, runs: int | None, seed: int, basin: bool, lag: bool, hanging: bool, mount: str | None, vehicle: str,
    style: str,
) -> None:  # fmt: skip
    """Fly the laws of Theorems A and B and check every claim: Theorem 1 repaired, and the inverted pendulum.

    Writes V(t) with its terms, the regions of attraction with their exceptional sets, report.md and report.json.
    Printed, corrected and other laws that lack something the proof needs fly as negative controls.

    With --basin, counts the random starts from which the inverted law brings --vehicle, with rotor limits, into the
    certified set, where Theorem B's law takes over, and writes basin.json. With --lag, the rotors lag too, and Theorem
    D's law takes over. On a hub, a flight ends where the rod touches a rotor disc or an arm.
    """
    if basin:
        refuse_idle("style", why="with --basin, which draws nothing")
        from flypend import model

        machine = model.vehicle(vehicle)
        if mount is not None:
            machine = machine.replace(mount=mount)
        _basin(out, runs or 100_000, seed, machine, lag, "hanging" if hanging else "random")
        return
    refuse_idle("vehicle", "lag", "hanging", "mount", why="without --basin")
    from flypend.report.text import summary_table
    from flypend.report.theorem import check_theorems, descent_table

    with counter() as tell:
        result = check_theorems(out, runs=runs or 200, seed=seed, style=style, progress=tell)
    console.print(summary_table(result.repaired, title="Theorem A: Theorem 1 repaired, the paper's experiments"))
    console.print(summary_table(result.almost_global, title="Theorem B: inverted from almost every start"))
    console.print(descent_table(result.descents))
    console.print(f"Report and figures are in {bold(out)}; docs/laws/theorem-proof.md has the proofs.")


def _basin(out: Path, runs: int, seed: int, vehicle: Vehicle, lag: bool, starts: str) -> None:
    """Measure the basin of the certified set, save it in `out` and print it."""
    from flypend.files.staging import staging
    from flypend.studies.basin import measure_basin

    with staging(out) as folder, counter() as tell:
        found = measure_basin(vehicle, runs, seed, lag=lag, starts=starts, progress=tell)
        found.save(folder / "basin.json")
    delayed = "lag" if lag else "no lag"
    about = f"{found.vehicle} on a {found.mount}, {found.law} law, rotor limits, {delayed}"
    console.print(f"{about}; certified set V ≤ {found.c:.3g} m²/s²")
    last = "" if found.slowest is None else f", the last after {found.slowest:g} s"
    others = f" {found.touched} of the others end at a touch." if found.entered < found.runs else ""
    console.print(f"{found.entered} of {found.runs} {found.starts} starts enter it{last}.{others}")
    console.print(f"At 95 %, at least {100 * found.least:.5f} % of such starts do. Numbers are in {bold(out)}.")
