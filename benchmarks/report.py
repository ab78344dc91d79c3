"""The figures as Markdown, JSON and a picture, ratios first."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

from benchmarks.lines import Line

# Name of a peer, and what flypend's faster kernel shall reach as a multiple of it.
GOALS = {
    "generated C, vectors, dp5": ("flypend dp5", 1.2),
    "generated C, vectors, dop853": ("flypend dop853", 1.2),
    "diffrax": (None, 20.0),
    "heyoka batch": (None, 5.0),
    "SciPy, Python right-hand side": (None, 1000.0),
}


def with_ratios(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """`rows` with what flypend is as a multiple of each, fastest first."""
    own = {row["name"]: row["per_core"] for row in rows if row["name"].startswith("flypend d")}
    for row in rows:
        against, goal = GOALS.get(row["name"], (None, None))
        row["ratio"] = (own.get(against, math.nan) if against else max(own.values(), default=math.nan)) / row[
            "per_core"
        ]
        row["goal"] = goal
    return sorted(rows, key=lambda row: row["ratio"])


def markdown(rows: list[dict[str, Any]], lines: list[Line], missing: dict[str, str], where: dict[str, Any]) -> str:
    """Two tables, and what is `missing` in them and why."""
    text = [
        f"{where['processor']}, {where['cores']} cores (load {where['load']:.1f} at the start), {where['date']}; "
        f"{_share(where)}"
        "corrected law, 6.5 s, median error 1e-6.\n",
        "| | flypend is … times as fast | goal | runs/s on a core | on all | rtol | median, 95 % error "
        "| compile, first run | cold start, again |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        name = row["name"] if row["accurate"] else f"({row['name']}: {row['note']})"
        error = f"{row['median_error']:.1e}, {row['error_95']:.1e}" if row["accurate"] else ""
        text.append(
            f"| {name} | {short(row['ratio'])} | {'≥ ' + short(row['goal']) if row['goal'] else ''} "
            f"| {short(row['per_core'])} | {short(row['all_cores'])} | {row['tolerance']:.0e} | {error} "
            f"| {row['compile_and_first']:.2f} s | {row['cold']:.1f} s, {row['cold_again']:.1f} s |"
        )
    text += ["", "| | today | 0.1 | goal |", "|---|---|---|---|"]
    text += [
        f"| {line.name} | {short(line.value)} {line.unit} | {short(line.old)} | {line.goal}{_mark(line)} |"
        for line in lines
    ]
    text += [f"\nMissing: {name} ({' '.join(why.split())})" for name, why in missing.items()]
    return "\n".join(text) + "\n"


def _share(where: dict[str, Any]) -> str:
    return "" if where["share"] == 1 else f"{where['share']:g} of the runs, no measurement; "


def _mark(line: Line) -> str:
    return "" if line.met is None else ", met" if line.met else ", missed"


def short(value: float | None) -> str:
    """Three digits, without an exponent."""
    if value is None or not math.isfinite(value):
        return ""
    digits = max(0, 2 - math.floor(math.log10(abs(value)))) if value else 0
    return f"{round(value, 2 - math.floor(math.log10(abs(value)))):,.{min(digits, 2)}f}" if value else "0"


def save(
    folder: Path, rows: list[dict[str, Any]], lines: list[Line], missing: dict[str, str], where: dict[str, Any]
) -> None:
    """benchmark.md, benchmark.json and, of peers, benchmark.png."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "benchmark.md").write_text(markdown(rows, lines, missing, where), encoding="utf-8")
    table = {"machine": where, "peers": rows, "lines": [line._asdict() | {"met": line.met} for line in lines]}
    table["missing"] = missing
    (folder / "benchmark.json").write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")
    if rows:
        picture(folder / "benchmark.png", rows, where)


def picture(path: Path, rows: list[dict[str, Any]], where: dict[str, Any]) -> None:
    """Runs per second and core, on a logarithmic axis."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context({"font.size": 9}):
        figure = Figure(figsize=(7.0, 0.8 + 0.33 * len(rows)), layout="constrained")
        axes = figure.add_subplot()
        shown = list(reversed(rows))
        own = ["tab:blue" if row["name"].startswith("flypend") else "0.7" for row in shown]
        bars = axes.barh([row["name"] for row in shown], [row["per_core"] for row in shown], color=own)
        axes.bar_label(bars, [f"{short(row['per_core'])}  ({short(row['ratio'])}×)" for row in shown], padding=3)
        axes.set(xscale="log", xlabel="closed-loop runs of 6.5 s per second and core, median error 1e-6")
        axes.set_xlim(right=12 * max(row["per_core"] for row in rows))
        axes.set_title(f"{where['processor']}, {where['date']}", fontsize=9)
        figure.savefig(path, dpi=150)
