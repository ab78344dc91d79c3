"""The output of `flypend compare` and `flypend ladder`: a table, its numbers, and a figure."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rich.table import Table

from flypend.files.staging import staging
from flypend.files.whole import save_both
from flypend.report.text import bullets, describe, markdown_table, terminal_table, write_report
from flypend.settings.runfile import run_text
from flypend.studies import Comparison, Ladder
from flypend.studies.compare import summary

COLUMNS = ("runs", "success % (95 %)", "settle s", "exc. m", "effort", "peak N", "failed")


def comparison_cells(row: dict[str, Any]) -> list[str]:
    """Return the table cells of one law; `row` is a record of `Comparison.rows`."""
    return [
        str(row["runs"]),
        f"{100 * row['success']:.4g} ({100 * row['wilson_low']:.1f}-{100 * row['wilson_high']:.1f})",
        f"{short(row['settling_p50'])}/{short(row['settling_p95'])}",
        f"{short(row['excursion_p50'])}/{short(row['excursion_p95'])}",
        short(row["effort_p50"]),
        short(row["peak_force_max"]),
        ", ".join(f"{cause} {count}" for cause, count in row["causes"].items()) or "-",
    ]


def comparison_table(comparison: Comparison) -> Table:
    """Return the table for the terminal, one row per law."""
    rows, failed = [["law", *COLUMNS[:-1]]], []
    for row in comparison.rows():
        *cells, causes = comparison_cells(row)
        rows.append([row["law"], *cells])
        failed += [f"{row['law']}: {causes}"] if row["causes"] else []
    caption = (
        f"settle, exc. (excursion): median/95th percentile; effort: RMS rotor force over hover; peak: any one rotor\n"
        f"failed: {'; '.join(failed) or 'none'}"
    )
    return terminal_table(rows, "Same starts, same plant", caption, whole=True)


def comparison_markdown(comparison: Comparison) -> str:
    """Return the Markdown table, one row per law."""
    return markdown_table([["law", *COLUMNS], *([row["law"], *comparison_cells(row)] for row in comparison.rows())])


def write_comparison(
    comparison: Comparison, settings: dict[str, Any], out: str | Path, failed: Mapping[str, Any] | None = None
) -> None:
    """Write report.md, report.json (with `settings`), comparison.pdf and .png of `comparison` into the folder `out`.

    `failed`, the run files of failed flights by name, replace those in the folder `failed` inside it.
    """
    from flypend.pictures.studies import comparison_figure

    with staging(out) as folder:
        text = f"# Laws compared\n\n{describe(settings)}\n\n{comparison_markdown(comparison)}\n"
        write_report(folder, text, {"settings": settings, "laws": comparison.rows()})
        save_both(comparison_figure(comparison), folder / "comparison")
        for name, run in (failed or {}).items():
            (folder / "failed").mkdir(exist_ok=True)
            (folder / "failed" / f"{name}.toml").write_text(run_text(run, Path(out) / "failed"), encoding="utf-8")
    for path in Path(out, "failed").glob("*-[0-9]*.toml"):  # of an earlier comparison
        if path.stem not in (failed or {}):
            path.unlink()


def ladder_rows(ladder: Ladder) -> list[list[str]]:
    """Return the cells of the ladder, one row per rung: success and excursion of each law."""
    rows = []
    for rung, comparison in ladder.rungs.items():
        flown = comparison.ensembles.values()
        rows.append([rung, *(f"{100 * e.rate:.1f} %, {short(e.percentile('excursion', 95))} m" for e in flown)])
    return rows


def ladder_table(ladder: Ladder) -> Table:
    """Return the ladder as a table for the terminal."""
    laws = list(next(iter(ladder.rungs.values())).ensembles)
    caption = "; ".join(f"{law} falls below 90 % on: {_broken(ladder, law)}" for law in laws)
    rows = [["rung", *laws], *ladder_rows(ladder)]
    return terminal_table(rows, "Success, and 95th percentile of the excursion", caption)


def write_ladder(ladder: Ladder, settings: dict[str, Any], out: str | Path) -> None:
    """Write report.md, report.json (with `settings`), ladder.pdf and .png of `ladder` into the folder `out`."""
    from flypend.pictures.studies import ladder_figure

    laws = list(next(iter(ladder.rungs.values())).ensembles)
    table = markdown_table([["rung", *laws], *ladder_rows(ladder)])
    broken = bullets(f"{law}: {_broken(ladder, law)}" for law in laws)
    failures = bullets(_failures(ladder)) or "none"
    with staging(out) as folder:
        text = f"# Reality ladder\n\n{describe(settings)}\n\n{table}\n\nRungs below 90 % success:\n\n{broken}\n"
        text += f"\nFailures by cause (the quantity out of tolerance during the last second):\n\n{failures}\n"
        content = {
            rung: {law: summary(ensemble) for law, ensemble in comparison.ensembles.items()}
            for rung, comparison in ladder.rungs.items()
        }
        write_report(folder, text, {"settings": settings, "rungs": content})
        save_both(ladder_figure(ladder), folder / "ladder")


def _failures(ladder: Ladder) -> list[str]:
    """One line per rung and law with failures: the count of each cause."""
    lines = []
    for rung, comparison in ladder.rungs.items():
        for law, ensemble in comparison.ensembles.items():
            causes = summary(ensemble)["causes"]
            counts = ", ".join(f"{cause} {count}" for cause, count in causes.items())
            lines += [f"{rung}, {law}: {counts} (of {len(ensemble)})"] if causes else []
    return lines


def _broken(ladder: Ladder, law: str) -> str:
    broken = ladder.broken(law)
    return "all" if len(broken) == len(ladder.rungs) else ", ".join(broken) or "none"


def short(value: float) -> str:
    """Format to three digits, without an exponent from 1000 up; NaN, the quantile of no runs, becomes a dash."""
    return "-" if math.isnan(value) else f"{value:.0f}" if abs(value) >= 1000 else f"{value:.3g}"
