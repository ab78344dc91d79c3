"""The output of `flypend check`: tables, their numbers, and a figure."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from flypend.files.staging import staging
from flypend.files.whole import save_both
from flypend.flight.tasks import TASKS
from flypend.report.studies import comparison_cells
from flypend.report.text import bullets, describe, markdown_table, number, terminal_table, write_report
from flypend.studies.advice import Advice
from flypend.studies.check import Check
from flypend.studies.joint import Joint
from flypend.studies.trial import Trial

COLUMNS = ("law", "task", "grade", "succeed", "% (95 %)", "settle s", "exc. m", "clear mm", "failed")
Cells = list[list[str]]


def task_cells(checks: Mapping[str, Check]) -> Cells:
    """Return the cells of the tasks, a row per law and task; settling, excursion: median/95 %, clearance: 5 %."""
    rows = []
    for law, check in checks.items():
        for name, row in check.rows().items():
            _, share, settling, excursion, *_, failed = comparison_cells(row)
            clear = f"{1e3 * row['clearance_p5']:.3g}" if "clearance_p5" in row else "-"
            count = f"{row['successes']} of {row['runs']}"
            rows.append([law, name, check.envelope[name], count, share, settling, excursion, clear, failed])
    return rows


def margin_cells(checks: Mapping[str, Check]) -> Cells:
    """Return the header and the cells of margins and catches: a row per quantity, a column per law."""
    rows = [["leans caught directly", *(_caught(check) for check in checks.values())]]
    names = list(dict.fromkeys(name for check in checks.values() for name in check.margins))
    for name in names:
        found = [check.margins.get(name) for check in checks.values()]
        rows.append([name, *("-" if margin is None else margin.describe() for margin in found)])
    return [["90 % succeed", *checks], *rows]


def trial_cells(trials: Mapping[str, Trial]) -> Cells:
    """Return the header and the cells of trials: uptime under knocks and success in each sweep, a column per law."""
    rows = [
        ["up under knocks, median (5 %)", *(_uptime(trial) for trial in trials.values())],
        ["standing after 60 s", *(f"{int(t.standing.sum())} of {len(t.standing)}" for t in trials.values())],
    ]
    for name in dict.fromkeys(name for trial in trials.values() for name in trial.sweeps):
        cells = [trial.sweeps.get(name, {}) for trial in trials.values()]
        rows.append([name, *("/".join(f"{100 * count.rate:.0f}" for count in row.values()) for row in cells)])
    rows.append(["mean of all sweeps", *(f"{100 * trial.robustness:.1f}" for trial in trials.values())])
    return [["% of trial and of sweeps ×0.75/0.875/1.125/1.25", *trials], *rows]


def check_tables(checks: Mapping[str, Check], trials: Mapping[str, Trial]) -> list[Table]:
    """Return the tables for the terminal."""
    tables = []
    if cells := task_cells(checks):
        first = 0 if len(checks) > 1 else 1
        tables += [[row[first:] for row in ([*COLUMNS], *cells)], margin_cells(checks)]
    return [terminal_table(table) for table in (*tables, *([trial_cells(trials)] if trials else []))]


def verdicts(checks: Mapping[str, Check]) -> list[str]:
    """Return a line per law, reason and warning."""
    lines = []
    for law, check in checks.items():
        lines.append(check.verdict(law))
        lines += [f"  {line}" for line in (*check.reasons, *check.warnings, check.possible) if line]
    return lines


def joint_lines(joints: Mapping[str, Joint]) -> list[str]:
    """Return lines per law: success under all errors of a laboratory at once, what fails first, what to calibrate."""
    return [line for law, one in joints.items() for line in (f"{law}, all at once:", *(f"  {l}" for l in one.lines()))]


def write_check(
    checks: Mapping[str, Check],
    trials: Mapping[str, Trial],
    settings: Mapping[str, Any],
    out: str | Path,
    *,
    figures: bool = True,
    joints: Mapping[str, Joint] | None = None,
    advice: Advice | None = None,
) -> None:
    """Write report.md, report.json (with `settings`) and check.pdf and .png of `checks` into the folder `out`.

    `checks`, `trials` and `joints` are keyed by law; `advice` is what follows from them. Without `figures`, or if
    nothing was flown, there is no picture.
    """
    with staging(out) as folder:
        content = {
            "settings": dict(settings),
            "checks": {law: check.to_dict() for law, check in checks.items()},
            "trials": {law: trial.to_dict() for law, trial in trials.items()},
            "advice": None if advice is None else advice.to_dict(),
            "joint": {law: one.to_dict() for law, one in (joints or {}).items()},
        }
        write_report(folder, _markdown(checks, trials, joints or {}, settings, advice), content)
        if figures and any(check.tasks for check in checks.values()):
            from flypend.pictures.studies import check_figure

            save_both(check_figure(checks), folder / "check")


def _markdown(
    checks: Mapping[str, Check],
    trials: Mapping[str, Trial],
    joints: Mapping[str, Joint],
    settings: Mapping[str, Any],
    advice: Advice | None,
) -> str:
    """Return the report as Markdown."""
    parts = ["# Check", describe(settings), bullets(verdicts(checks))]
    if cells := task_cells(checks):
        tasks = {**TASKS, "drawn": "as random, with vehicles drawn from the bands of this one"}
        flown = {name for check in checks.values() for name in check.tasks}
        meaning = bullets(f"{name}: {words}" for name, words in tasks.items() if name in flown)
        parts += [markdown_table([list(COLUMNS), *cells]), meaning, markdown_table(margin_cells(checks))]
    parts += [markdown_table(trial_cells(trials))] if trials else []
    parts += [bullets(joint_lines(joints))] if joints else []
    parts += [bullets(advice.lines())] if advice else []
    return "\n\n".join(parts) + "\n"


def _caught(check: Check) -> str:
    if check.catch is None or not check.catch.lean:
        return "none"
    return f"up to {np.degrees(check.catch.lean):.0f}°, within {number(check.catch.excursion)} m"


def _uptime(trial: Trial) -> str:
    low, median = np.percentile(trial.uptime, (5, 50))
    return f"{100 * median:.1f} ({100 * low:.1f})"
