"""The commands that check the claims of the paper, and those of the theorems that repair it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import click

import flypend as fp
from flypend.cli.options import option, options_of, out_option, refuse_idle, style_option
from flypend.cli.terminal import bold, console, counter, is_missing
from flypend.files.staging import staging


@click.command()
@out_option("paper-out")
@click.option("--quick", is_flag=True, help="Skip the movies.")
@style_option
def paper(out: Path, quick: bool, style: str) -> None:
    """Fly the paper's five experiments and check every claim of its theorem.

    Writes figures, stop-motion, movies, every run as NetCDF, report.md and report.json.
    """
    from flypend.report.flight import check_movies
    from flypend.report.paper import reproduce
    from flypend.report.text import findings_table, judgement, summary_table

    movies = not (quick or is_missing("movies", check_movies))
    with counter() as tell:
        result = reproduce(out, quick=not movies, style=style, progress=tell)
    console.print(summary_table(result.verdicts))
    console.print(summary_table(result.repaired, title="Theorem 1 repaired: which claim holds after 30 s"))
    console.print(findings_table(result.findings))
    console.print(f"One swing-up by the inverted law, from hanging at rest: {judgement(result.swing_up)}.")
    console.print(f"Report, figures{', movies' if movies else ''} and runs are in {bold(out)}; start with report.md.")


@dataclass(frozen=True)
class Basin:
    """What --basin counts."""

    asked: bool = option("Count the random starts that end in the certified set, within limits.", "--basin")
    lag: bool = option("With --basin: rotors lag as well.")
    hanging: bool = option("With --basin: the rod hangs at the start, within 10° of straight down.")
    mount: str | None = option("With --basin: what carries the rod, gimbal or hub; default the vehicle's own.")
    vehicle: str = option("Vehicle name or TOML file.", default="hehn2011")

    def measure(self, out: Path, runs: int, seed: int) -> None:
        """Measure the basin of the certified set, save it in `out` and print it."""
        from flypend.studies.basin import measure_basin

        machine = fp.vehicle(self.vehicle)
        if self.mount is not None:
            machine = machine.replace(mount=self.mount)
        with staging(out) as folder, counter() as tell:
            starts = "hanging" if self.hanging else "random"
            found = measure_basin(machine, runs, seed, lag=self.lag, starts=starts, progress=tell)
            found.save(folder / "basin.json")
        delayed = "lag" if self.lag else "no lag"
        about = f"{found.vehicle} on a {found.mount}, {found.law} law, rotor limits, {delayed}"
        console.print(f"{about}; certified set V ≤ {found.c:.3g} m²/s²")
        last = "" if found.slowest is None else f", the last after {found.slowest:g} s"
        others = f" {found.touched} of the others end at a touch." if found.entered < found.runs else ""
        console.print(f"{found.entered} of {found.runs} {found.starts} starts enter it{last}.{others}")
        console.print(f"At 95 %, at least {100 * found.least:.5f} % of such starts do. Numbers are in {bold(out)}.")


@click.command()
@out_option("theorem-out")
@click.option(
    "--runs", type=click.IntRange(min=1), show_default="200; 100000 with --basin", help="Random flights of each law."
)
@click.option("--seed", type=click.IntRange(min=0), default=7, help="Seed of the random starts.")
@options_of(Basin, "basin")
@style_option
def theorem(out: Path, runs: int | None, seed: int, basin: Basin, style: str) -> None:
    """Fly the laws of Theorems A and B and check every claim: Theorem 1 repaired, and the inverted pendulum.

    Writes V(t) with its terms, the regions of attraction with their exceptional sets, report.md and report.json.
    Printed, corrected and other laws that lack something the proof needs fly as negative controls.

    With --basin, counts the random starts from which the inverted law brings --vehicle, with rotor limits, into the
    certified set, where Theorem B's law takes over, and writes basin.json. With --lag, the rotors lag too, and Theorem
    D's law takes over. On a hub, a flight ends where the rod touches a rotor disc or an arm.
    """
    if basin.asked:
        refuse_idle("style", why="with --basin, which draws nothing")
        basin.measure(out, runs or 100_000, seed)
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
