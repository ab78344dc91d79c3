"""The command that checks the two theorems."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from flypend.cli.terminal import bold, console, counter
from flypend.cli.viewing import Style

app = typer.Typer()


@app.command()
def theorem(
    out: Annotated[Path, typer.Option("--out", "-o", help="Output folder.")] = Path("theorem-out"),
    runs: Annotated[int, typer.Option("--runs", help="Random flights of each law.", min=1)] = 200,
    seed: Annotated[int, typer.Option("--seed", help="Seed of the random starts.", min=0)] = 7,
    style: Style = "paper",
) -> None:
    """Fly the two theorems that are true, and check every claim: Theorem 1 repaired, and the inverted pendulum.

    Writes V(t) with its terms, the basins with their exceptional sets, report.md and report.json. Printed, corrected
    and other laws that lack a part of the proof fly beside them as negative controls.
    """
    from flypend.report.text import summary_table
    from flypend.report.theorem import check_theorems, descent_table

    with counter() as tell:
        result = check_theorems(out, runs=runs, seed=seed, style=style, progress=tell)
    console.print(summary_table(result.repaired, title="Theorem A: Theorem 1 repaired, the paper's experiments"))
    console.print(summary_table(result.almost_global, title="Theorem B: inverted from almost every start"))
    console.print(descent_table(result.descents))
    console.print(f"Report and figures are in {bold(out)}; docs/laws/theorem.md has the proofs.")
