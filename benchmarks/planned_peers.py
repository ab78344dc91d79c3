"""What a user would otherwise pick, IPOPT and Fatrop in CasADi's wheel, on the problem of `flypend.plan`.

python -m benchmarks.planned_peers --runs 12 --seed 2211

Multiple shooting over packed states, from the same guesses: stages, limits of the rotors, cost and tolerances at the
end are those of a plan. Derivatives are exact, and evaluated in CasADi's virtual machine.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

import flypend as fp
from benchmarks.plans import PATIENT, VEHICLE, quantiles
from flypend.compile.llvm.stagewise import WIDTH
from flypend.model.state import SIZE
from flypend.planning.constraints import Constraints
from flypend.planning.durations import HORIZONS
from flypend.planning.dynamics import Scaled, step_once
from flypend.planning.inequalities import EFFORT, HIGH, LOW, SHARED, end_errors
from flypend.planning.planner import ORDER
from flypend.planning.problem import Request, request
from flypend.planning.search import NOT_REACHED, Found, Job, make_guesses, one_by_one, stages_of
from flypend.planning.solver import Settings
from flypend.planning.verdict import plans_of
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


@dataclass(frozen=True)
class Answer:
    """What a solver made of a guess: a plan with its verdict, processor time, and of that derivatives, s."""

    plan: fp.Plan
    took: float
    derivatives: float


class Shooting:
    """The problem of `asked` for a general solver: x₀ u₀ x₁ u₁ … x_N, with e as a state that stays as it is.

    Constraints come stage by stage, gaps first; the start is one of the first stage, the tolerances of the last. It
    serves all starts of a vehicle.
    """

    def __init__(self, asked: Request) -> None:
        self.N, h = stages_of(HORIZONS[0])
        n, units, vehicle = asked.rotors, asked.units, asked.vehicle
        self.width = width = SIZE + n + 1
        numbers, machine = ca.SX(ca.DM(asked.numbers)), Scaled(ca.SX(ca.DM(units.numbers(vehicle))), n)
        timing = ca.SX(ca.DM(step_timing(vehicle.rotor_lag / units.time, h)))
        x, u, after = ca.SX.sym("x", width), ca.SX.sym("u", n), ca.SX.sym("after", width)
        led = ca.vertcat(step_once(x[:-1], u, timing, machine), x[-1])
        inside, errors = x[-1] - ca.sumsqr(x[:3]), end_errors(x[:-1], numbers)
        stages = ca.Function("stage", [x, u, after], [ca.vertcat(after - led, inside)]).map(self.N)
        end = ca.Function("end", [x], [ca.vertcat(inside, errors)])

        z, start = ca.MX.sym("z", (width + n) * self.N + width), ca.MX.sym("start", width - 1)
        body, last = ca.reshape(z[:-width], width + n, self.N), z[-width:]
        X, U = body[:width, :], body[width:, :]
        G, E = stages(X, U, ca.horzcat(X[:, 1:], last)), end(last)
        effort = asked.numbers[EFFORT] * ca.sumsqr(U - 1) / 2
        cost = asked.numbers[SHARED] * last[-1] + effort + Settings().end_weight * ca.sumsqr(E[1:]) / 2
        g = ca.vertcat(G[:-1, 0], X[:-1, 0] - start, ca.vec(G[:, 1:]), E)
        self.problem = {"x": z, "p": start, "f": cost, "g": g}

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

    def solver(self, name: str) -> Any:
        """Return the solver called `name`."""
        equal = {"equality": (self.bounds["lbg"] == self.bounds["ubg"]).tolist()} if name == "fatrop" else {}
        return ca.nlpsol(name, name, self.problem, {"print_time": False, **OPTIONS[name], **equal})

    def joined(self, states: Any, commands: Any) -> Any:
        """Return the unknowns of `states` (N + 1, 24 + n) and `commands` (N, n), own units, in a ball."""
        e = 1.02 * np.max(np.sum(states[:, :3] ** 2, axis=1)) + 0.01
        x = np.hstack([states, np.full((self.N + 1, 1), e)])
        return np.append(np.hstack([x[:-1], commands]).ravel(), x[-1])

    def broken(self, z: Any, start: Any) -> float:
        """Return by how much the unknowns `z` break a constraint, own units or tolerances."""
        g = self.lacks(z, start).full().ravel()
        return float(np.max(np.maximum(self.bounds["lbg"] - g, g - self.bounds["ubg"])))

    def solve(self, solver: Any, asked: Request, states: Any, commands: Any) -> Answer:
        """Solve from `states` (N + 1, 24 + n) and `commands` (N, n), own units."""
        begin = time.process_time()
        found = solver(x0=self.joined(states, commands), p=asked.start, **self.bounds)
        took, stats = time.process_time() - begin, solver.stats()
        derivatives = sum(spent for name, spent in stats.items() if name.startswith("t_proc_nlp_"))
        z = found["x"].full().ravel()
        body, last = z[: -self.width].reshape(self.N, -1), z[-self.width : -1]
        lacks = NOT_REACHED if not self.broken(z, asked.start) <= BROKEN else ""
        ways = np.vstack([body[:, : self.width - 1], last]), body[:, self.width :]
        what = Found(*ways, float(found["f"]), lacks, "", 0, (float(found["f"]),), 0.0, stats["iter_count"], took)
        return Answer(plans_of([asked], [what], HORIZONS[0])[0], took, derivatives)


def row(name: str, plans: Sequence[fp.Plan], best: Sequence[fp.Plan], took: Any) -> str:
    """Format a row: solved, excursion against `best`, and processor time `took`, s."""
    ratio = [plan.excursion / other.excursion for plan, other in zip(plans, best, strict=True) if plan and other]
    against = quantiles(ratio, 0.5, 1) if ratio else "none"
    return f"{name}: solved {sum(map(bool, plans))} of {len(plans)}, ratio {against}; {quantiles(took, 0.5, 1)} s"


def main() -> None:
    """Solve from cold by each, and print a row of each."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=12)
    parser.add_argument("--seed", type=int, default=2211)
    parser.add_argument("--solvers", nargs="+", choices=list(OPTIONS), default=list(OPTIONS))
    asked = parser.parse_args()
    starts = fp.random_starts(asked.runs, asked.seed)
    runs = [starts[i] for i in range(asked.runs)]
    wished = [request(VEHICLE, start, "excursion", (0, 0, 0), kept=Constraints(clearance=0)) for start in runs]
    best = [fp.plan(VEHICLE, start, duration=HORIZONS[0] * each.units.time, time_limit=PATIENT)
            for start, each in zip(runs, wished, strict=True)]  # fmt: skip
    alone = plans_of(wished, one_by_one([Job(each, ORDER[0]) for each in wished], HORIZONS[0]), HORIZONS[0])
    print("solver: solved, excursion against our plan p50, most; processor time p50, most")
    for name, plans in (("plan, eight guesses", best), ("plan, one guess", alone)):
        print(row(name, plans, best, [plan.solve_time for plan in plans]), flush=True)
    shooting = Shooting(wished[0])
    for name in asked.solvers:
        solver, answers = shooting.solver(name), []
        for each, ours in zip(wished, best, strict=True):
            _, states, commands = make_guesses([Job(each, ORDER[0])] * WIDTH, HORIZONS[0])
            answers.append(shooting.solve(solver, each, states[..., 0], commands[..., 0]))
            told_of = f"{answers[-1].plan}, derivatives {answers[-1].derivatives:.1f} s"
            print(f"  {name}: {told_of}; ours {ours.excursion:.3f} m", flush=True)
        print(row(name, [a.plan for a in answers], best, [a.took for a in answers]), flush=True)


if __name__ == "__main__":
    main()
