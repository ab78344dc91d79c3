"""What a user would otherwise pick, IPOPT, Fatrop and crocoddyl, on the problem of `flypend.plan`.

python -m benchmarks.planned_peers --runs 12 --seed 2211
python -m benchmarks.planned_peers --improve --runs 60 --seed 5150   # IPOPT begins at each plan

Multiple shooting over packed states, from the same guesses: stages, limits of the rotors, cost and tolerances at the
end are those of a plan. Derivatives are exact: C that CasADi writes, compiled by `cc -O2`. crocoddyl, whose stages have
no inequalities but the limits of commands, has the least effort alone; see `planned_crocoddyl`.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import chdir
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType
from typing import Any

import casadi as ca
import numpy as np

import flypend as fp
from benchmarks.plans import PATIENT, VEHICLE, quantiles
from benchmarks.results import record
from flypend.compile.llvm.stagewise import WIDTH
from flypend.flight.metrics import wilson
from flypend.model.state import SIZE
from flypend.planning.constraints import Constraints
from flypend.planning.durations import HORIZONS
from flypend.planning.dynamics import Scaled, step_once
from flypend.planning.inequalities import EFFORT, HIGH, LOW, SHARED, end_errors
from flypend.planning.multistart import NOT_REACHED, Found, Job
from flypend.planning.planner import ORDER
from flypend.planning.problem import Request, request
from flypend.planning.search import make_guesses, one_by_one, plan_of, stages_of
from flypend.planning.solver import Settings
from flypend.plants.lag import step_timing

TOLERANCE, ITERATIONS = 1e-6, 300
LIMIT = 60.0  # s of processor time: IPOPT keeps it, Fatrop knows only a number of iterations
BROKEN = 1e-5  # own units: solvers scale what they hold against their tolerance
OPTIONS: Mapping[str, dict[str, Any]] = {
    "ipopt": {
        "ipopt.print_level": 0, "ipopt.sb": "yes", "ipopt.tol": TOLERANCE, "ipopt.max_iter": ITERATIONS,
        "ipopt.max_cpu_time": LIMIT,
    },
    "fatrop": {
        "structure_detection": "auto", "fatrop.print_level": 0, "fatrop.tol": TOLERANCE, "fatrop.max_iter": ITERATIONS,
    },
}  # fmt: skip
OF_EFFORT = "crocoddyl"
NEAR = 1e-9  # own units: IPOPT that improves a plan begins no farther from its limits, nor with a larger barrier,
IMPROVING: Mapping[str, Any] = {
    "ipopt.mu_init": 1e-7, "ipopt.warm_start_init_point": "yes",
    **{f"ipopt.{warm}{kind}": NEAR for warm in ("", "warm_start_") for kind in
       ("bound_push", "bound_frac", "slack_bound_push", "slack_bound_frac")},
    "ipopt.warm_start_mult_bound_push": NEAR,
}  # fmt: skip
ROOM = (0.02, 0.01)  # of the first ball beyond the farthest state: share of its square, and own units
LOCAL = 0.2  # own units, by which no state may be off a plan that is improved nearby: what lies farther is another
IMPROVED = 0.01  # share of the cost by which a plan that has converged is not to be improved


@dataclass(frozen=True)
class Answer:
    """What a solver made of a guess: a plan with its verdict and cost, processor time, and of that derivatives, s."""

    plan: fp.Plan
    cost: float
    took: float
    derivatives: float


Solve = Callable[..., Answer]  # (what is asked, states (N + 1, 24 + n), commands (N, n)), own units


def compiled(name: str, write: Callable[[str], Any]) -> str:
    """Return the library of the C that `write` writes to a file here, unless it is there already."""
    library = Path(f"{name}.so").absolute()
    if not library.exists():
        write(f"{name}.c")
        compiler = [os.environ.get("CC", "cc"), "-O2", "-fPIC", "-shared"]
        subprocess.run([*compiler, f"{name}.c", "-o", str(library), "-lm"], check=True)
    return str(library)


class Shooting:
    """The problem of `asked` for a general solver: x₀ u₀ x₁ u₁ … x_N, with e as a state that stays as it is.

    Constraints come stage by stage, gaps first; the start is one of the first stage, the tolerances of the last. It
    serves all starts of a vehicle, and all weights of excursion and effort.
    """

    def __init__(self, asked: Request, horizon: float = HORIZONS[0]) -> None:
        self.horizon, (self.N, h) = horizon, stages_of(horizon)
        n, units, vehicle = asked.rotors, asked.units, asked.vehicle
        self.width = width = SIZE + n + 1
        numbers, machine = ca.SX(ca.DM(asked.numbers)), Scaled(ca.SX(ca.DM(units.numbers(vehicle))), n)
        timing = ca.SX(ca.DM(step_timing(vehicle.rotor_lag / units.time, h)))
        x, u, after = ca.SX.sym("x", width), ca.SX.sym("u", n), ca.SX.sym("after", width)
        led, errors = step_once(x[:-1], u, timing, machine), end_errors(x[:-1], numbers)
        self.step, self.errors = ca.Function("step", [x[:-1], u], [led]), ca.Function("errors", [x[:-1]], [errors])
        inside = x[-1] - ca.sumsqr(x[:3])
        stages = ca.Function("stage", [x, u, after], [ca.vertcat(after - ca.vertcat(led, x[-1]), inside)]).map(self.N)
        end = ca.Function("end", [x], [ca.vertcat(inside, errors)])

        z, start = ca.MX.sym("z", (width + n) * self.N + width), ca.MX.sym("start", width - 1)
        weights = ca.MX.sym("weights", 2)
        body, last = ca.reshape(z[:-width], width + n, self.N), z[-width:]
        X, U = body[:width, :], body[width:, :]
        G, E = stages(X, U, ca.horzcat(X[:, 1:], last)), end(last)
        cost = ca.dot(weights, ca.vertcat(last[-1], ca.sumsqr(U - 1) / 2))
        cost += Settings().end_weight * ca.sumsqr(E[1:]) / 2
        g = ca.vertcat(G[:-1, 0], X[:-1, 0] - start, ca.vec(G[:, 1:]), E)
        self.problem = {"x": z, "p": ca.vertcat(start, weights), "f": cost, "g": g}

        same, free = np.zeros(2 * width - 1), np.full(width, np.inf)
        ends = np.ones(E.numel() - 1)
        stage = np.append(np.zeros(width), np.inf)
        self.bounds = {
            "lbg": np.concatenate([same, np.zeros((width + 1) * (self.N - 1)), [0], -ends]),
            "ubg": np.concatenate([same, np.tile(stage, self.N - 1), [np.inf], ends]),
            "lbx": np.append(np.tile(np.append(-free, np.full(n, asked.numbers[LOW])), self.N), -free),
            "ubx": np.append(np.tile(np.append(free, np.full(n, asked.numbers[HIGH])), self.N), free),
        }
        self.lacks = ca.Function("lacks", [z, start], [g])
        a_stage = np.append(np.full(SIZE, True), np.full(2 * n + 1, False))
        self.moves = np.append(np.tile(a_stage, self.N), a_stage[:width])  # whether an unknown is part of a state

    def solver(
        self, name: str, more: Mapping[str, Any] = MappingProxyType({}), room: tuple[float, float] = ROOM
    ) -> Solve:
        """Return what solves by the solver called `name`, whose functions are compiled here.

        It has `more` options, and begins in a ball with `room`; see `joined`.
        """
        equal = {"equality": (self.bounds["lbg"] == self.bounds["ubg"]).tolist()} if name == "fatrop" else {}
        options = {"print_time": False, **OPTIONS[name], **equal, **more}
        library = compiled(
            f"{name}_{self.N}", lambda file: ca.nlpsol(name, name, self.problem, options).generate_dependencies(file)
        )
        return partial(self.solve, ca.nlpsol(name, name, library, options), room)

    def joined(self, states: Any, commands: Any, room: tuple[float, float] = ROOM) -> Any:
        """Return the unknowns of `states` (N + 1, 24 + n) and `commands` (N, n), own units, in a ball with `room`."""
        e = (1 + room[0]) * np.max(np.sum(states[:, :3] ** 2, axis=1)) + room[1]
        x = np.hstack([states, np.full((self.N + 1, 1), e)])
        return np.append(np.hstack([x[:-1], commands]).ravel(), x[-1])

    def broken(self, z: Any, start: Any) -> float:
        """Return by how much the unknowns `z` break a constraint, own units or tolerances."""
        g = self.lacks(z, start).full().ravel()
        return float(np.max(np.maximum(self.bounds["lbg"] - g, g - self.bounds["ubg"])))

    def solve(
        self, solver: Any, room: tuple[float, float], asked: Request, states: Any, commands: Any, near: float = np.inf
    ) -> Answer:
        """Solve from `states` and `commands`, no state farther than `near` from these; see `Solve` and `joined`."""
        numbers, first = np.append(asked.start, asked.numbers[[SHARED, EFFORT]]), self.joined(states, commands, room)
        reach = np.where(self.moves, near, np.inf)
        bounds = self.bounds | {
            "lbx": np.maximum(self.bounds["lbx"], first - reach), "ubx": np.minimum(self.bounds["ubx"], first + reach)
        }  # fmt: skip
        begin = time.process_time()
        found = solver(x0=first, p=numbers, **bounds)
        took, stats = time.process_time() - begin, solver.stats()
        derivatives = sum(spent for name, spent in stats.items() if name.startswith("t_proc_nlp_"))
        z = found["x"].full().ravel()
        body, last = z[: -self.width].reshape(self.N, -1), z[-self.width : -1]
        ways = np.vstack([body[:, : self.width - 1], last]), body[:, self.width :]
        return self.judged(asked, z, *ways, stats["iter_count"], took, derivatives)

    def judged(
        self, asked: Request, z: Any, states: Any, commands: Any, iterations: int, took: float, derivatives: float
    ) -> Answer:
        """Return the answer that `states` and `commands`, or the unknowns `z`, are."""
        lacks = NOT_REACHED if not self.broken(z, asked.start) <= BROKEN else ""
        cost = cost_of(asked, states, commands)
        what = Found(states, commands, cost, lacks, "", 0, (cost,), 0.0, iterations, took)
        return Answer(plan_of(asked, what, self.horizon), cost, took, derivatives)


def cost_of(asked: Request, states: Any, commands: Any) -> float:
    """Return the cost that is `asked` for of `states` (N + 1, 24 + n) and `commands` (N, n), own units."""
    farthest = np.max(np.sum(states[:, :3] ** 2, axis=1))
    return float(asked.numbers[SHARED] * farthest + asked.numbers[EFFORT] * np.sum((commands - 1) ** 2) / 2)


def ways_of(asked: Request, plan: fp.Plan) -> tuple[Any, Any]:
    """Return states (N + 1, 24 + n) and commands (N, n) of a `plan`, own units."""
    states = np.column_stack([plan.packed, plan.rotor_forces]) / asked.units.states(asked.rotors)
    return states[:: (len(states) - 1) // len(plan.commands)], plan.commands / asked.units.force


def of_plan(asked: Request, plan: fp.Plan) -> Answer:
    """Return a `plan` of ours as an answer."""
    return Answer(plan, cost_of(asked, *ways_of(asked, plan)), plan.solve_time, 0.0)


def show(name: str, answers: Sequence[Answer], best: Sequence[Answer]) -> None:
    """Print the row of a solver, its costs against the `best`, and record it."""
    solved, runs = sum(bool(a.plan) for a in answers), len(answers)
    ratio = [a.cost / b.cost for a, b in zip(answers, best, strict=True) if a.plan and b.plan] or [np.nan]
    took = [a.took for a in answers]
    share = 100 * sum(a.derivatives for a in answers) / sum(took)
    low, high = (100 * bound for bound in wilson(solved, runs))
    print(f"{name}: solved {solved} of {runs} ({low:.1f} % to {high:.1f} %), cost {quantiles(ratio, 0, 0.5, 1)}; "
          f"{quantiles(took, 0.5, 1)} s, derivatives {share:.0f} %", flush=True)  # fmt: skip
    columns = {"solved": [solved, runs, low, high], "cost, least, p50, most": list(np.quantile(ratio, [0, 0.5, 1]))}
    record(name, **columns, **{"time p50, most": list(np.quantile(took, [0.5, 1])), "derivatives, %": share})


def rivals(shooting: Shooting, asked: Request, names: Sequence[str]) -> dict[str, Solve]:
    """Return the solvers of these `names` that are installed."""
    found = {}
    for name in names:
        if name != OF_EFFORT:
            found[name] = shooting.solver(name)
            continue
        try:
            from benchmarks.planned_crocoddyl import Boxed
        except ImportError as error:
            print(f"{name}: left out, {error}; `make bench` installs it")
        else:
            found[name] = Boxed(shooting, asked).solve
    return found


def _asked(objective: str, start: fp.State) -> Request:
    return request(VEHICLE, start, objective, (0, 0, 0), kept=Constraints(clearance=0))


def compare(objective: str, starts: Sequence[fp.State], names: Sequence[str]) -> None:
    """Plan with an `objective` from each of `starts`, solve the same by solvers of these `names`, and print rows."""
    asked = [_asked(objective, start) for start in starts]
    duration = HORIZONS[0] * asked[0].units.time
    plans = [fp.plan(VEHICLE, start, objective, duration=duration, time_limit=PATIENT) for start in starts]
    best = [of_plan(*pair) for pair in zip(asked, plans, strict=True)]
    found = one_by_one([Job(each, ORDER[0]) for each in asked], HORIZONS[0])
    alone = [plan_of(each, what, HORIZONS[0]) for each, what in zip(asked, found, strict=True)]
    show(f"{objective}, plan", best, best)
    show(f"{objective}, plan from one guess", [of_plan(*pair) for pair in zip(asked, alone, strict=True)], best)
    for name, solve in rivals(Shooting(asked[0]), asked[0], names).items():
        answers = []
        for each, ours in zip(asked, best, strict=True):
            _, states, commands = make_guesses([Job(each, ORDER[0])] * WIDTH, HORIZONS[0])
            answers.append(answer := solve(each, states[..., 0], commands[..., 0]))
            told = f"{name} {answer.plan.status}, {answer.plan.iterations} iterations, {answer.took:.2f} s"
            print(f"  {told}, cost {answer.cost:.4g}, of the plan {ours.cost:.4g}", flush=True)
        show(f"{objective}, {name}", answers, best)


def improve(objective: str, starts: Sequence[fp.State]) -> None:
    """Plan with an `objective` from each of `starts`, let IPOPT improve those that converged, and print it."""
    solvers: dict[int, Solve] = {}
    gains, converged, elsewhere = [], 0, 0
    for i, start in enumerate(starts):
        asked, plan = _asked(objective, start), fp.plan(VEHICLE, start, objective, time_limit=PATIENT)
        if plan.status != "converged":
            print(f"  {i}: {plan.summary}", flush=True)
            continue
        converged, N = converged + 1, len(plan.commands)
        if N not in solvers:
            solvers[N] = Shooting(asked, plan.duration / asked.units.time).solver("ipopt", IMPROVING, (NEAR, NEAR))
        answer, cost = solvers[N](asked, *ways_of(asked, plan)), of_plan(asked, plan).cost
        if not answer.plan or answer.cost < (1 - IMPROVED) * cost:
            told = f"{answer.plan.status}, {1 - answer.cost / cost:.2%} less"
            elsewhere += bool(answer.plan)
            answer = solvers[N](asked, *ways_of(asked, plan), near=LOCAL)
            print(f"  {i}: {told}, nearby {answer.plan.status}, {1 - answer.cost / cost:.2%} less", flush=True)
        gains += [1 - answer.cost / cost] if answer.plan else []
    low, high = (100 * bound for bound in wilson(converged, len(starts)))
    better, some = sum(gain > IMPROVED for gain in gains), list(np.quantile(gains, [0.5, 0.95, 1]))
    print(f"{objective}: converged {converged} of {len(starts)} ({low:.1f} % to {high:.1f} %)", end=", ")
    told = quantiles(gains, 0.5, 0.95, 1)
    print(f"by more than 1 % IPOPT improves {better} of {len(gains)} nearby and {elsewhere} wherever it goes; "
          f"nearby p50, p95, most {told}", flush=True)  # fmt: skip
    found = {"improved nearby, anywhere": [better, len(gains), elsewhere], "improved p50, p95, most": some}
    record(objective, converged=[converged, len(starts), low, high], **found)


def main() -> None:
    """Solve from cold by each, and print a row of each."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=12)
    parser.add_argument("--seed", type=int, default=2211)
    parser.add_argument("--objective", nargs="+", choices=["excursion", "effort"], default=["excursion", "effort"])
    parser.add_argument("--solvers", nargs="+", choices=[*OPTIONS, OF_EFFORT], default=[*OPTIONS, OF_EFFORT])
    parser.add_argument("--improve", action="store_true", help="begin at each plan that has converged")
    given = parser.parse_args()
    starts = fp.random_starts(given.runs, given.seed)
    if not given.improve:
        print("solver: solved, cost against the plan least, p50, most; processor time p50, most")
    with TemporaryDirectory() as folder, chdir(folder):
        for objective in given.objective:
            if given.improve:
                improve(objective, [starts[i] for i in range(given.runs)])
                continue
            names = [name for name in given.solvers if name != OF_EFFORT or objective == "effort"]
            compare(objective, [starts[i] for i in range(given.runs)], names)


if __name__ == "__main__":
    main()
