"""Verdicts and findings as Markdown, as JSON, and as tables for the terminal."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from types import MappingProxyType
from typing import Any

from rich.box import SIMPLE
from rich.console import JustifyMethod
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from flypend import __version__
from flypend.flight.metrics import metrics
from flypend.flight.trajectory import Trajectory
from flypend.flight.verdict import fall, goal
from flypend.paper.claims import Finding, Verdict

Column = tuple[str, str]
Cell = str | Text
# What each cause of failure means by the default criterion, for readers who meet it for the first time.
_END = "within the last second"
WHY = {
    "rod": f"rod: its tip is more than 0.05 rod lengths from its goal {_END}",
    "axis": f"axis: the thrust axis leans by more than 0.05 rad {_END}",
    "position": f"position: the pivot is more than 0.2 m from its reference {_END}",
    "diverged": "diverged: the state left all bounds",
    "singular": "singular: the law stopped being defined",
    "collided": "collided: the rod touched the vehicle or left its cup, or the machine met the floor",
}


def number(value: float) -> str:
    """Format a number for a table: three significant digits, but five decimals near 1 to show the distance from 1."""
    return f"{value:.5f}" if 0 < abs(value - 1) < 1e-2 else f"{value:.3g}"


def judgement(run: Trajectory) -> str:
    """Return one line: whether `run` reaches the goal of its law, its excursion or fall, and its peak rotor force."""
    m = metrics(run, goal(run.e3))
    up = run.e3 == "up"
    pose = "inverted hover" if up else "hanging rod"
    reached = f"reached after {m.settling:.2f} s" if m.success else f"not reached ({WHY.get(m.cause, m.cause)})"
    least = (
        f", rod clear by {number(1e3 * m.clearance)} mm" if m.cause != "collided" and m.clearance < float("inf") else ""
    )
    way, lowest = fall(run), ""
    if up:
        way, lowest = f"largest distance {number(m.excursion)} m", f", lowest point at {number(m.lowest)} m"
    return f"{pose} {reached}, {way}, largest rotor force {number(m.peak_force)} N{lowest}{least}"


def terminal_table(
    rows: Sequence[Sequence[Cell]], title: str | None = None, caption: str = "", *,
    left: int = 1, whole: bool = False, space: int = 1,
) -> Table:  # fmt: skip
    """Return `rows`, the first of them the header, as a table for the terminal, with `space` left of each column.

    The first columns, `left` of them, are names; others are numbers, which are not wrapped if they shall be `whole`.
    """
    table = Table(title=title, title_justify="left", box=SIMPLE, padding=(0, 0, 0, space), min_width=len(title or ""))
    for i, name in enumerate(rows[0]):
        side: JustifyMethod = "left" if i < left else "right"
        table.add_column(escape(str(name)), justify=side, overflow="fold", no_wrap=whole and i >= left)
    for row in rows[1:]:
        table.add_row(*(escape(cell) if isinstance(cell, str) else cell for cell in row))
    table.caption, table.caption_justify = escape(caption) or None, "left"
    return table


def mark(holds: bool) -> str:
    """Return the label of a verdict."""
    return "holds" if holds else "fails"


def summary_table(verdicts: Mapping[Column, Sequence[Verdict]], title: str = "Theorem 1: which claim holds") -> Table:
    """Return the verdicts as a table for the terminal: one row per (law, experiment), one column per claim."""
    first = next(iter(verdicts.values()))
    rows: list[list[Cell]] = [["law", "start", *(verdict.claim for verdict in first)]]
    for key, row in verdicts.items():
        cells = ((number(v.value), *(("✓", "green") if v.holds else ("✗", "red"))) for v in row)
        rows.append([*key, *(Text(f"{value} {sign}", colour) for value, sign, colour in cells)])
    meaning = "; ".join(f"{v.claim}: {_generic(v.measured)} {v.criterion}" for v in first)
    caption = f"{meaning}. A claim fails as well on a run that does not reach its end."
    return terminal_table(rows, title, caption, left=2, whole=True, space=0)  # 80 columns


def findings_table(findings: Iterable[Finding]) -> Table:
    """Return the defects of the paper as a table for the terminal, each with the first number of its evidence."""
    table = Table(title="Defects of the paper, recomputed by this run", title_justify="left", box=SIMPLE)
    table.add_column("#", justify="right")
    table.add_column("defect")
    table.add_column("evidence")
    table.add_column("shown")
    for i, finding in enumerate(findings, 1):
        name, value = next(iter(finding.evidence.items()))
        table.add_row(str(i), finding.title, f"{name}: {number(value)}", "yes" if finding.shown else "[red]no")
    return table


def verdicts_markdown(
    verdicts: Mapping[Column, Sequence[Verdict]], ends: Mapping[Column, str] = MappingProxyType({})
) -> str:
    """Return the verdicts by (law, experiment) as a Markdown table; `ends` states how runs that broke off ended."""
    first = next(iter(verdicts.values()))
    rows = [
        ["law", "experiment", "run", *(v.claim for v in first)],
        ["*measured*", "", "", *(_generic(v.measured) for v in first)],
        ["*criterion*", "", "", *(v.criterion for v in first)],
    ]
    for key, row in verdicts.items():
        rows.append([*key, ends.get(key, "completed"), *(f"{number(v.value)} **{mark(v.holds)}**" for v in row)])
    return markdown_table(rows)


def findings_markdown(findings: Iterable[Finding]) -> str:
    """Return the defects as Markdown sections: as printed, as corrected, and the computed numbers."""
    sections = []
    for i, finding in enumerate(findings, 1):
        rows = [["computed", "value"], *([name, number(value)] for name, value in finding.evidence.items())]
        sections.append(
            f"### {i}. {finding.title}\n\n- printed: {finding.printed}\n- should read: {finding.corrected}\n"
            f"- shown by this run: {'yes' if finding.shown else 'NO'}\n\n{markdown_table(rows)}\n"
        )
    return "\n".join(sections)


def write_json(path: Path, content: Any) -> None:
    """Write `content` (records, mappings, numbers) as JSON to `path`; NaN becomes null."""
    path.write_text(json.dumps(_plain(content), indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


def write_report(folder: Path, markdown: str, content: Mapping[str, Any]) -> None:
    """Write report.md, and report.json with the version, into `folder`."""
    (folder / "report.md").write_text(markdown, encoding="utf-8")
    write_json(folder / "report.json", {"flypend": __version__, **content})


def _plain(content: Any) -> Any:
    if isinstance(content, Verdict | Finding):
        return _plain(asdict(content))
    if isinstance(content, Mapping):
        return {str(key): _plain(value) for key, value in content.items()}
    if isinstance(content, list | tuple):
        return [_plain(value) for value in content]
    if isinstance(content, float) and not math.isfinite(content):
        return None
    return content.item() if hasattr(content, "item") else content


def _generic(measured: str) -> str:
    return measured.split(" at ")[0]


def describe(settings: Mapping[str, Any]) -> str:
    """Return `settings` as a sentence."""
    return "; ".join(f"{name}: {value}" for name, value in settings.items()) + "."


def bullets(lines: Iterable[str]) -> str:
    """Return `lines` as a Markdown list."""
    return "\n".join(f"- {line.strip()}" for line in lines)


def markdown_table(rows: Sequence[Sequence[str]]) -> str:
    """Return `rows` of cells, the first of them the header, as a Markdown table. A cell may hold any text."""
    plain = [[" ".join(cell.replace("|", "\\|").split()) for cell in row] for row in rows]
    header, *body = ["| " + " | ".join(row) + " |" for row in plain]
    return "\n".join([header, "|" + "---|" * len(rows[0]), *body])
