"""The command that checks the two theorems."""

from __future__ import annotations

from pathlib import Path

import click

from flypend.cli.options import out_option, style_option
from flypend.cli.terminal import bold, console, counter


@click.command()
@out_option("theorem-out")
@click.option("--runs", type=click.IntRange(min=1), default=200, help="Random flights of each law.")
@click.option("--seed", type=click.IntRange(min=0), default=7, help="Seed of the random starts.")
@style_option
def theorem(out: Path, runs: int, seed: int, style: str) -> None:
    """Fly both theorems and check every claim: Theorem 1 repaired, and the inverted pendulum.

    Writes V(t) with its terms, the regions of attraction with their exceptional sets, report.md and report.json.
    Printed, corrected and other laws that lack a part of the proof fly beside them as negative controls.
    """
    from flypend.report.text import summary_table
    from flypend.report.theorem import check_theorems, descent_table

    with counter() as tell:
        result = check_theorems(out, runs=runs, seed=seed, style=style, progress=tell)
    console.print(summary_table(result.repaired, title="Theorem A: Theorem 1 repaired, the paper's experiments"))
    console.print(summary_table(result.almost_global, title="Theorem B: inverted from almost every start"))
    console.print(descent_table(result.descents))
    console.print(f"Report and figures are in {bold(out)}; docs/laws/theorem-proof.md has the proofs.")
