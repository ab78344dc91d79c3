"""Plans on random starts of hehn2011: how good, how long it takes, how they are flown; and IPOPT on the same problem.

python -m benchmarks.plans --runs 60 --seed 2211 --plant mujoco
python -m benchmarks.plans --runs 12 --seed 2211 --ipopt
python -m benchmarks.plans --runs 24 --seed 2211 --guesses 10
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import casadi as ca
import numpy as np

import flypend as fp
from flypend.flight.metrics import wilson
from flypend.planning import guess
from flypend.planning.coordinates import retract
from flypend.planning.dynamics import Stage, Units
from flypend.planning.inequalities import BASE, END, YAW, end_errors
from flypend.planning.problem import STAGES_PER_UNIT
from flypend.planning.solver import Settings
from flypend.plants.lag import step_timing

VEHICLE = fp.vehicle("hehn2011")
REPEATS = 3  # of each plan, of which the least processor time counts
PATIENT = 600.0  # s: a busy machine must not decide


def ipopt(plan: fp.Plan) -> tuple[float, float, str]:
    """Return excursion (m), processor time (s) and status of IPOPT on the problem of `plan`, begun from it.

    Unknowns are coordinates about the plan; the Hessian is exact.
    """
    vehicle, units = plan.vehicle, Units.of(plan.vehicle)
    n, N = len(vehicle.rotor_spins), len(plan.commands)
    stage, delta = Stage(n), ca.SX.sym("delta", 16 + len(vehicle.rotor_spins))
    timing = step_timing(vehicle.rotor_lag / units.time, plan.stage / units.time)
    gap = stage.gap_at(delta)
    for symbols, numbers in ((stage.timing, timing), (stage.machine.numbers, units.numbers(vehicle))):
        gap = ca.substitute(gap, symbols, ca.SX(ca.DM(numbers)))
    moved, numbers = retract(stage.before, delta), ca.SX.zeros(BASE)
    numbers[YAW] = END["omega"]
    leads = ca.Function("leads", [delta, stage.command, stage.before, stage.after], [gap])
    far = ca.Function("far", [delta, stage.before], [ca.sumsqr(moved[:3])])
    end = ca.Function("end", [delta, stage.before], [end_errors(moved, numbers)])
    states = (np.column_stack([plan.packed, plan.rotor_forces]) / units.states(n))[:: (len(plan.t) - 1) // N].T
    states[:3] -= plan.target[:, None] / units.length

    D, V, e = ca.MX.sym("D", 16 + n, N), ca.MX.sym("V", n, N), ca.MX.sym("e")
    before = ca.horzcat(ca.DM.zeros(16 + n, 1), D[:, :-1])
    gaps = leads.map(N)(before, V, states[:, :-1], states[:, 1:]) - D
    inside = e - far.map(N)(D, states[:, 1:])
    effort = plan.objective["effort"] / STAGES_PER_UNIT / n * ca.sumsqr(V - 1) / 2
    cost = plan.objective["excursion"] * e + effort
    cost += Settings().end_weight * ca.sumsqr(end(D[:, -1], states[:, -1])) / 2
    low, high = vehicle.rotor_limits / units.force
    many, free = D.numel(), np.full(D.numel(), 20.0)
    problem = {"x": ca.vertcat(ca.vec(D), ca.vec(V), e), "f": cost, "g": ca.vertcat(ca.vec(gaps), ca.vec(inside))}
    options = {"ipopt.print_level": 0, "print_time": 0, "ipopt.mu_init": 1e-4, "ipopt.tol": 1e-6, "ipopt.sb": "yes"}
    solver = ca.nlpsol("reference", "ipopt", problem, options)
    largest = float(np.max(np.sum(states[:3] ** 2, axis=0)))
    first = np.concatenate([np.zeros(many), (plan.commands / units.force).ravel(), [1.02 * largest + 0.01]])
    begin = time.process_time()
    found = solver(
        x0=first, lbx=np.concatenate([-free, np.full(N * n, low), [0.0]]),
        ubx=np.concatenate([free, np.full(N * n, high), [1e3]]),
        lbg=np.zeros(many + N), ubg=np.concatenate([np.zeros(many), np.full(N, np.inf)]),
    )  # fmt: skip
    took, least = time.process_time() - begin, float(np.sum(states[:3, 0] ** 2))
    return float(np.sqrt(max(float(found["x"][-1]), least)) * units.length), took, solver.stats()["return_status"]


def best_of(start: fp.State, plan: fp.Plan, times: int, rng: np.random.Generator) -> fp.Plan:
    """Return the plan of least excursion from `times` as many guesses: the styles, and others drawn about them."""
    kept = guess.PUMPS.copy()
    for _ in range(times - 1):
        guess.PUMPS[:, [0, 1, 2, 4]] = kept[:, [0, 1, 2, 4]] * np.exp(rng.normal(scale=0.5, size=(len(kept), 4)))
        other = fp.plan(VEHICLE, start, time_limit=PATIENT)
        plan = other if other and other.excursion < plan.excursion else plan
    guess.PUMPS[:] = kept
    return plan


def quantiles(values: Any, *shares: float) -> str:
    """Format quantiles of `values`."""
    return ", ".join(f"{value:.3g}" for value in np.quantile(values, shares))


def main() -> None:
    """Plan, and print what came of it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=60)
    parser.add_argument("--seed", type=int, default=2211)
    parser.add_argument("--plant")
    parser.add_argument("--ipopt", action="store_true")
    parser.add_argument("--guesses", type=int, default=1)
    asked = parser.parse_args()
    starts, rng = fp.random_starts(asked.runs, asked.seed), np.random.default_rng(asked.seed)
    runs = [starts[i] for i in range(asked.runs)]
    plans = [[fp.plan(VEHICLE, start, time_limit=PATIENT) for _ in range(REPEATS)] for start in runs]
    first, good = [tried[0] for tried in plans], [bool(tried[0]) for tried in plans]
    spent = [1e3 * min(plan.solve_time for plan in tried) for tried in plans]
    excursions = quantiles([plan.excursion for plan in first], 0.5, 0.95)
    low, high = wilson(sum(good), len(good))
    print(f"planned: {sum(good)} of {len(good)} ({low:.1%} to {high:.1%})")
    print(f"excursion p50, p95: {excursions} m")
    print(f"guesses p50: {np.median([plan.guesses for plan in first]):.0f}")
    print(f"processor time p50, p99: {quantiles(spent, 0.5, 0.99)} ms", flush=True)
    if asked.guesses > 1:
        best = [best_of(start, plan, asked.guesses, rng) for start, plan in zip(runs, first, strict=True)]
        ratio = np.array([plan.excursion / other.excursion for plan, other in zip(first, best, strict=True)])
        told = f"{np.sum(ratio > 1.02)} improve by 2 %, {np.sum(ratio > 1.1)} by 10 %"
        print(f"{asked.guesses} times the guesses: {told}; ratio p50, p95: {quantiles(ratio, 0.5, 0.95)}")
    if asked.ipopt:
        found = [(plan, *ipopt(plan)) for plan in first if plan]
        ratio = [plan.excursion / excursion for plan, excursion, _, status in found if status == "Solve_Succeeded"]
        print(f"ratio to IPOPT from the plan ({len(ratio)} solved), p50, p95: {quantiles(ratio, 0.5, 0.95)}")
        print(f"its processor time p50: {quantiles([took for _, _, took, _ in found], 0.5)} s")
    if asked.plant:
        pairs = [(s, p) for s, p in zip(runs, first, strict=True) if p]
        flown = [fp.metrics(fp.simulate(VEHICLE, fp.track(p), s, p.duration + 3, plant=asked.plant)) for s, p in pairs]
        stood = sum(result.success for result in flown)
        low, high = wilson(stood, len(runs))
        print(f"flown on {asked.plant}: {stood} of {len(runs)} stand ({low:.1%} to {high:.1%}),")
        ratio = [result.excursion / p.excursion for result, (_, p) in zip(flown, pairs, strict=True)]
        print(f"excursion p50, p95: {quantiles([r.excursion for r in flown], 0.5, 0.95)} m,", end=" ")
        print(f"ratio to the plan p50, p95: {quantiles(ratio, 0.5, 0.95)}")


if __name__ == "__main__":
    main()
