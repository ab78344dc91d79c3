"""The reproduction of the paper: its experiments, figures and movies, and a verdict on each of its claims."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from flypend import __version__
from flypend.files.staging import staging
from flypend.flight.metrics import metrics
from flypend.flight.simulate import simulate
from flypend.flight.trajectory import Trajectory
from flypend.laws import inverted
from flypend.model import State, vehicle
from flypend.paper import experiment, experiment_names
from flypend.paper.claims import SETTLED, Finding, Runs, Verdict, fly_repaired, theorem_a_claims, theorem_claims
from flypend.paper.defects import findings, fly_all
from flypend.pictures.style import style_named
from flypend.report import text
from flypend.report.flight import Task, check_movies, figure_tasks, movie_tasks
from flypend.report.text import Column
from flypend.signals.polling import processes, result_of

STOP_MOTION = ("2", "4", "5")
MOVIES = ("4", "5")
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True)
class Reproduction:
    """Result of a reproduction; verdicts and ends are keyed by (law, experiment)."""

    verdicts: dict[Column, list[Verdict]]  # on the claims
    ends: dict[Column, str]  # how each run ended
    findings: list[Finding]  # the defects of the paper
    swing_up: Trajectory  # under the inverted law from hanging at rest, with rotor limits and lag
    repaired: dict[Column, list[Verdict]]  # on Theorem A, the repaired theorem


def reproduce(
    out: str | Path, *, quick: bool = False, style: str = "paper", progress: Progress = lambda *_: None
) -> Reproduction:
    """Fly the paper's experiments; write figures, movies unless `quick`, runs, report.md and report.json into `out`.

    If anything fails, nothing is written. `progress` is called with (task, done, total). Raises InputError if the
    folder `out` is not writable or the `style` unknown.
    """
    style_named(style)
    if not quick:
        check_movies()
    with staging(out) as folder:
        for name in ("runs", "figures", "movies"):
            if not (quick and name == "movies"):
                (folder / name).mkdir()
        total = 4 * len(experiment_names())
        flown = iter(range(total))
        runs = fly_all(lambda what: progress(f"flying {what}", next(flown), total))
        swing_up = simulate(vehicle("hehn2011"), inverted(), State(y=(0.0, 0.0, -1.0)), 6.0, plant="rotors")
        tasks = _pictures(runs, folder, quick, style)
        tasks += figure_tasks(swing_up, folder / "figures", "swing-up-", style=style)
        if not quick:
            tasks = movie_tasks(swing_up, folder / "movies", "swing-up-")[:1] + tasks
        with processes(os.cpu_count() or 1) as submit:
            pending = [(name, submit(task)) for name, task in tasks]
            result = _judge(runs, swing_up)
            for label, group in vars(runs).items():
                for name, run in group.items():
                    run.save(folder / "runs" / f"{label.replace('_', '-')}-{name}.nc")
            swing_up.save(folder / "runs" / "inverted-swing-up.nc")
            _write_reports(result, folder)
            for done, (name, future) in enumerate(pending):
                progress(f"drawing {name}", total + done, total + len(pending))
                result_of(future)
        progress("done", total + len(tasks), total + len(tasks))
    return result


def _pictures(runs: Runs, folder: Path, quick: bool, style: str = "paper") -> list[tuple[str, Task]]:
    """Named tasks for all figures and movies; the movies take longest and start first."""
    tasks: list[tuple[str, Task]] = []
    if not quick:
        for name in MOVIES:
            tasks += movie_tasks(runs.corrected[name], folder / "movies", f"experiment-{name}-")
    for name, run in runs.corrected.items():
        tasks += figure_tasks(run, folder / "figures", f"experiment-{name}-", name in STOP_MOTION, style)
    for name, run in runs.without_beta.items():
        prefix = f"experiment-{name}-printed-without-beta-"
        tasks += figure_tasks(run, folder / "figures", prefix, False, style)[:1]
    return tasks


def _judge(runs: Runs, swing_up: Trajectory) -> Reproduction:
    verdicts: dict[Column, list[Verdict]] = {}
    ends: dict[Column, str] = {}
    for name in experiment_names():
        row = experiment(name)
        settled = simulate(row.vehicle, row.law("corrected"), row.start, SETTLED, plant=row.plant)
        groups: list[tuple[str, Trajectory, Trajectory]] = [
            ("printed", runs.printed[name], runs.printed[name]),
            ("without beta", runs.without_beta[name], runs.without_beta[name]),
            ("corrected", runs.corrected[name], settled),
        ]
        for law, run, long_run in groups:
            verdicts[law, name] = theorem_claims(run, long_run)
            ends[law, name] = f"{run.outcome.status} at {run.outcome.time:.4g} s"
    repaired = {("repaired", name): theorem_a_claims(run) for name, run in fly_repaired().items()}
    return Reproduction(verdicts, ends, findings(runs), swing_up, repaired)


def _write_reports(result: Reproduction, folder: Path) -> None:
    parts = [
        "# Stabilizing a spherical pendulum on a quadrotor: which claims hold",
        "The five experiments of Nayak, Banavar and Maithripala, flown by flypend "
        f"{__version__} under Theorem 1 as printed and as corrected. Experiment 2 cannot be taken as printed "
        "(defect 6) and is flown in both readings. The frame is the paper's: e₃ along gravity.",
        "## Claims of Theorem 1",
        text.verdicts_markdown(result.verdicts, result.ends),
        "A claim holds on a run only if the run is completed. V rises under the corrected law, too: the paper omits a "
        "term of V̇₁ (defect 4), and without beta a cross term remains. The pose y = e₃ hangs (defect 2). The paper's "
        "starts converge under the corrected law; some others run away (defect 9).",
        "## Theorem 1 repaired",
        f"The same experiments under the repaired law (docs/laws/theorem.md, Theorem A), with the paper's gains, for "
        f"{SETTLED:g} s. Its V falls along every solution.",
        text.verdicts_markdown(result.repaired),
        "## A swing-up by another law",
        f"One flight of the inverted law on {result.swing_up.vehicle.name}, from hanging at rest, with rotor limits "
        f"and lag: {text.judgement(result.swing_up)} (figures/swing-up-stop-motion.png). One flight from one start "
        "proves nothing about others; docs/laws/inverted.md counts successes over random starts.",
        "## Defects of the paper, recomputed by this run",
        text.findings_markdown(result.findings),
    ]
    claims = [
        {"law": law, "experiment": name, "run": result.ends[law, name], "claims": row}
        for (law, name), row in result.verdicts.items()
    ]
    repaired = [{"experiment": name, "claims": row} for (_, name), row in result.repaired.items()]
    content = {"claims": claims, "repaired": repaired, "defects": result.findings}
    text.write_report(folder, "\n\n".join(parts), content | {"swing_up": vars(metrics(result.swing_up))})
