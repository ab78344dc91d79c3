"""The two theorems, flown: claims, V along many flights, V(t) with its terms, and the basin."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path

from rich.table import Table
from rich.text import Text

from flypend import __version__
from flypend.files import whole
from flypend.files.staging import staging
from flypend.flight.metrics import wilson
from flypend.flight.simulate import simulate
from flypend.flight.trajectory import Trajectory
from flypend.laws import almost_global, repaired
from flypend.model import vehicle
from flypend.paper import experiment, experiment_names
from flypend.paper.claims import Verdict, fly_repaired, fly_swing_ups, theorem_a_claims, theorem_b_claims
from flypend.paper.descent import Descent, basin, descend, laws
from flypend.pictures.style import style_named
from flypend.report import text
from flypend.report.text import Column
from flypend.studies.starts import check_starts

POINTS = 61  # of the basin's grid, per axis
RISE = "largest rise over V(0), median / worst"
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True)
class Proof:
    """Result of `check_theorems`: verdicts by (theorem, start), and one row of `Descent` per law."""

    repaired: Mapping[Column, list[Verdict]]
    almost_global: Mapping[Column, list[Verdict]]
    descents: list[Descent]


def check_theorems(
    out: str | Path, *, runs: int, seed: int, style: str = "paper", progress: Progress = lambda *_: None
) -> Proof:
    """Fly the laws of Theorems A and B and negative controls; write figures, report.md and report.json into `out`.

    Each law flies `runs` random starts of `seed`. If anything fails, nothing is written. `progress` is called with
    (task, done, total). Raises InputError if the folder `out` is not writable or the `style` unknown.
    """
    style_named(style)
    check_starts(runs, seed)
    with staging(out) as folder:
        progress("flying the experiments", 0, 1)
        hanging, inverted = fly_repaired(), fly_swing_ups()
        descents = [descend(name, runs, seed, progress=partial(progress, f"flying {name}")) for name in laws()]
        theorem_a = {("A", name): theorem_a_claims(run) for name, run in hanging.items()}
        theorem_b = {("B", name): theorem_b_claims(run) for name, run in inverted.items()}
        result = Proof(theorem_a, theorem_b, descents)
        progress("drawing", 0, 1)
        _draw(hanging, inverted, folder, style)
        _write(result, folder, runs, seed)
    return result


def _draw(hanging: Mapping[str, Trajectory], inverted: Mapping[str, Trajectory], folder: Path, style: str) -> None:
    """Draw the flights of either theorem into `folder`."""
    from flypend.pictures.descent import basin_figure, descent_figure  # matplotlib is slow to import

    first = experiment("1")
    groups: dict[str, Mapping[str, Trajectory]] = {}
    for law in ("printed", "corrected"):
        rows = {name: experiment(name) for name in experiment_names()}
        groups[law] = {
            name: simulate(row.vehicle, row.law(law), row.start, row.duration, plant=row.plant, rtol=1e-10)
            for name, row in rows.items()
        }
    groups["repaired"] = hanging
    whole.save_both(descent_figure(groups, first.duration, style=style), folder / "V-experiments")
    whole.save_both(descent_figure({"almost global": inverted}, 8.0, style=style), folder / "V-swing-ups")
    panels = [basin(repaired(), first.vehicle, POINTS), basin(almost_global(), vehicle("hehn2011"), POINTS)]
    whole.save_both(basin_figure(panels, style=style), folder / "basin")


def descent_table(descents: list[Descent]) -> Table:
    """Return the rows of `descents` as a table for the terminal."""
    rows: list[list[text.Cell]] = [["law", "converge", "end early", "V rises", RISE]]
    for row in descents:
        rising = Text(f"{row.rising} of {row.runs}", "red" if row.rising else "green")
        rise = f"{row.median_rise:.2g} / {row.worst_rise:.2g}"
        rows.append([row.law, f"{row.converged} of {row.runs}", str(row.ended), rising, rise])
    return text.terminal_table(rows, "Does V fall? Wide random starts, ideal plant", space=0)


def _markdown(descents: list[Descent]) -> str:
    rows = [["law", "converge (95 %, Wilson)", "end early", "V rises", RISE]]
    for row in descents:
        low, high = wilson(row.converged, row.runs)
        share = f"{row.converged} of {row.runs} ({low:.2%} to {high:.2%})"
        rise = f"{row.median_rise:.2g} / {row.worst_rise:.2g}"
        rows.append([row.law, share, str(row.ended), str(row.rising), rise])
    return text.markdown_table(rows)


def _write(result: Proof, folder: Path, runs: int, seed: int) -> None:
    """Write the page of `result`, from `runs` flights drawn with `seed`, into `folder`."""
    parts = [
        "# Two theorems that are true",
        f"Flown by flypend {__version__} in the ideal plant: the wrench acts as commanded. "
        "docs/laws/theorem-proof.md has the statements and the proofs.",
        "## Theorem A: the paper's experiments under the repaired law, 30 s",
        text.verdicts_markdown(result.repaired),
        "## Theorem B: hehn2011 under the almost global law, 30 s",
        text.verdicts_markdown(result.almost_global),
        "## Does V fall?",
        f"{runs} flights of each law, seed {seed}: |ω|, |ẏ| ≤ 12 rad/s, |ẋ| ≤ 5 m/s, and |x_i| ≤ 10 m where position "
        "is controlled. V rises if it exceeds an earlier value by more than 1e-6 V(0) at samples 0.05 s apart. Only "
        "the first two laws have a proof; the others lack a part of it.",
        _markdown(result.descents),
        "Figures: V-experiments, V-swing-ups, and basin, the settling time over planar starts at rest.",
    ]
    claims = [
        {"theorem": theorem, "start": start, "claims": row}
        for verdicts in (result.repaired, result.almost_global)
        for (theorem, start), row in verdicts.items()
    ]
    content = {"claims": claims, "runs": runs, "seed": seed, "descents": [asdict(row) for row in result.descents]}
    text.write_report(folder, "\n\n".join(parts) + "\n", content)
