"""What can be planned: other vehicles, random ones, leans, and ensembles.

python -m benchmarks.planned vehicles --runs 50 --seed 7702 --fly 30
python -m benchmarks.planned random --vehicles 200 --runs 4 --fly 1 --seed 2025 --mount hub
python -m benchmarks.planned leans
python -m benchmarks.planned pareto
python -m benchmarks.planned windows
python -m benchmarks.planned low --runs 24 --seed 7702
python -m benchmarks.planned ensemble --runs 500 --seed 4711 --guesses 2
"""

from __future__ import annotations

import argparse
import time

import numpy as np

import flypend as fp
from benchmarks.vehicles import DURATION, WANTED, numbers, random_vehicle
from flypend.flight.metrics import wilson
from flypend.flight.tasks import touches

HEHN = fp.vehicle("hehn2011")
LONG, LEAST = 12.0, 3.0  # √(l/g), and s at least, of hover after a plan, which must stand in the last second
MARGIN = 0.08  # m, by which a window must be higher than a leaning rod: the rotors lean as well
LEANS = {20: 0.46, 30: 0.78, 40: 1.15, 60: 2.1}  # degrees, and m that optimal control with free rotors takes


def heavy() -> fp.Vehicle:
    """A vehicle of 5 kg with a thrust of 1.6 weights, a bob of 0.5 kg, and sizes as in `benchmarks.vehicles`."""
    arm, largest = 0.2 * 5 ** (1 / 3), 1.6 * 5.5 * 9.81 / 4
    roll = 5 * (0.475 * arm) ** 2
    return fp.Vehicle(
        name="heavy", mass=5.0, bob_mass=0.5, rod_length=1.0, inertia=(roll, roll, 1.7 * roll),
        rotor_positions=((arm, 0, 0), (0, -arm, 0), (-arm, 0, 0), (0, arm, 0)), rotor_spins=(1, -1, 1, -1),
        drag_ratio=0.08 * arm, rotor_limits=(0.02 * largest, largest), rotor_lag=0.04,
    )  # fmt: skip


def share(good: int, runs: int) -> str:
    """Format a share with its Wilson interval."""
    low, high = wilson(good, runs)
    return f"{good} of {runs} ({low:.1%} to {high:.1%})"


def vehicles(asked: argparse.Namespace) -> None:
    """Plan other vehicles with all guesses, and fly some of the plans."""
    known = {
        "hehn2011": HEHN,
        "crazyflie, 72 ms, rod 0.5 m": fp.vehicle("crazyflie").replace(rotor_lag=0.072, rod_length=0.5),
        "5 kg, thrust/weight 1.6": heavy(),
        "bob 0.4 of the mass": HEHN.replace(bob_mass=0.4 * HEHN.mass),
        "nayak2018": fp.vehicle("nayak2018"),
    }
    starts = fp.random_starts(asked.runs, asked.seed)
    for name, vehicle in known.items():
        plans = fp.plan_ensemble(vehicle, starts, guesses=8)
        print(f"{name}: {plans}", flush=True)
        runs = min(asked.fly, asked.runs)
        if not runs:
            continue
        flown = fp.simulate_ensemble(vehicle, fp.plan_and_track(), starts[:runs], DURATION)
        excursion = (flown.percentile("excursion", q) for q in (50, 95))
        print(
            f"  flown 30 s: {share(int(flown.success.sum()), runs)}, excursion p50, p95:",
            *map("{:.3f}".format, excursion),
        )


def hubbed(vehicle: fp.Vehicle) -> fp.Vehicle:
    """Return `vehicle` with a hub, its parts as large against its arms as those of hehn2011."""
    scale = np.linalg.norm(vehicle.rotor_positions[0]) / np.linalg.norm(HEHN.rotor_positions[0])
    parts = ("disc_radius", "arm_radius", "hub_radius", "rod_radius")
    body = {name: float(scale * getattr(HEHN.body, name)) for name in parts}
    return vehicle.replace(mount="hub", body=body)


def apart(vehicle: fp.Vehicle, runs: int, seed: int) -> fp.State:
    """Return the first `runs` random starts at which the rod touches nothing."""
    starts = fp.random_starts(40 * runs, seed)
    return starts[np.flatnonzero(~touches(vehicle, starts))[:runs]]


def random(asked: argparse.Namespace) -> None:
    """Plan random vehicles from some starts, fly the plans, and fly the inverted law from the same starts."""
    rng, law, rows = np.random.default_rng(asked.seed), fp.laws.inverted(), []
    for i in range(asked.vehicles):
        vehicle = random_vehicle(rng)
        if i < asked.first:
            continue
        vehicle = hubbed(vehicle) if asked.mount == "hub" else vehicle
        starts = apart(vehicle, asked.runs, asked.seed + 1)
        power, agility, lag = numbers(vehicle)
        plans = fp.plan_ensemble(vehicle, starts, guesses=asked.guesses)
        flown, longest = [], max(LONG * np.sqrt(vehicle.l / vehicle.g), LEAST)
        for plan, start in list(zip(plans, (starts[k] for k in range(asked.runs)), strict=True))[: asked.fly]:
            run = fp.simulate(vehicle, fp.track(plan), start, plan.duration + longest) if plan else None
            flown.append(run is not None and fp.metrics(run).success)
        try:
            rate = fp.simulate_ensemble(vehicle, law, starts, DURATION).rate
        except fp.InputError:
            rate = 0.0
        rows.append((plans.success.mean(), np.mean(flown) if flown else np.nan, rate))
        told = " ".join(f"{value:4.0%}" for value in rows[-1])
        excursion = plans.percentile("excursion", 50) / vehicle.l
        print(f"{i:3d} thrust/weight {power:4.2f} agility {agility:7.2f} lag {lag:4.2f}:", end=" ")
        print(f"planned, flown, law {told}; {excursion:5.2f} l", flush=True)
    planned, flies, by_law = (np.array(column) >= WANTED for column in zip(*rows, strict=True))
    print(f"of {len(rows)}, from {WANTED:.0%} of {asked.runs} starts: planned {share(planned.sum(), len(rows))},")
    print(f"the plans of {asked.fly} starts stand {share(flies.sum(), len(rows))}, the law {by_law.sum()};")
    print(f"where the law does not: planned {share((planned & ~by_law).sum(), (~by_law).sum())}, ", end="")
    print(f"flown {share((flies & ~by_law).sum(), (~by_law).sum())}")


def leans(_: argparse.Namespace) -> None:
    """Plan leans at rest with the rod above the horizon, in three directions."""
    for degrees, free in LEANS.items():
        lean, told = np.radians(degrees), []
        for heading in (0.0, 0.3, np.pi / 4):
            y = (np.sin(lean) * np.cos(heading), np.sin(lean) * np.sin(heading), np.cos(lean))
            found = fp.plan(HEHN, fp.State(y=y), lean=np.pi / 2, time_limit=600)
            told.append(f"{found.excursion:.3f} m ({found.excursion / free:.2f})" if found else found.reason)
        print(f"{degrees}°: {', '.join(told)}")


def windows(_: argparse.Namespace) -> None:
    """Plan flights through windows, and tell how much room they leave."""
    up, hangs = fp.State(x=(-1.5, 0, 0), y=(0, 0, 1)), fp.State(x=(-1.5, 0, 0), y=(0, 0, -1))
    door, middle = fp.Window((0, 0, 0.2), 0.5, 1.0), (0, 0, 0.2)
    cases = [(HEHN, up, [door])]
    cases += [(HEHN, up, [fp.Window(middle, *size)]) for size in ((0.3, 0.8), (0.2, 0.9), (0.7, 0.4), (0.7, 0.3))]
    cases += [(HEHN, hangs, [door]), (HEHN.replace(mount="hub"), up, [door]), (HEHN.replace(mount="cup"), up, [door])]
    cases += [(HEHN, up, [fp.Window((-0.5, 0.2, 0.2), 0.5, 1.0), fp.Window((0.5, -0.2, 0.3), 0.5, 1.0)])]
    for vehicle, start, openings in cases:
        plan = fp.plan(vehicle, start, "effort", target=(1.5, 0, 0), window=openings, time_limit=600)
        sizes = ", ".join(f"{each.width:g} m by {each.height:g} m" for each in openings)
        room = min(float(np.min(each.room(plan.states, vehicle))) for each in openings)
        lean = np.degrees(np.arccos(np.min(plan.y[:, 2])))
        print(f"{vehicle.mount}, {sizes}: {plan.summary}; room {1e3 * room:.0f} mm, lean to {lean:.0f}°", flush=True)


def low(asked: argparse.Namespace) -> None:
    """Plan flights through random windows lower than the rod is long, with a limit of the lean, and tell what leads.

    Such a window is lower than rod and margin, level flight with the rod at its limit would pass it, with 5° to 25° to
    spare, and the wall is up to 20° oblique.
    """
    rng, found = np.random.default_rng(asked.seed), []
    for i in range(asked.runs):
        height, width, oblique = rng.uniform(0.34, 0.52), rng.uniform(0.5, 0.8), np.radians(rng.uniform(-20, 20))
        lean = np.arccos((height - MARGIN) / HEHN.reach) + np.radians(rng.uniform(5, 25))
        window = fp.Window((0, *rng.uniform(-0.2, 0.2, 2)), width, height, (np.cos(oblique), np.sin(oblique), 0))
        start = fp.State(x=(-rng.uniform(1, 2), 0, 0), y=(0, 0, 1))
        plan = fp.plan(
            HEHN, start, "effort", target=(rng.uniform(1, 2), 0, 0), window=window, lean=lean, time_limit=600
        )
        found.append(bool(plan))
        print(
            f"{i:2d} {width:.2f} m by {height:.2f} m, at most {np.degrees(lean):.0f}°: guess {plan.guess}, "
            f"{plan.summary}",
            flush=True,
        )
    print(f"planned {share(sum(found), asked.runs)}")


def pareto(_: argparse.Namespace) -> None:
    """Plan the swing-up from hanging at rest within less and less time."""
    hanging = fp.State(y=(0, 0, -1))
    shortest = fp.plan(HEHN, hanging, "time", time_limit=600)
    for duration in (3.0, 2.5, 2.0, 1.75, 1.5, 1.25, shortest.duration):
        found = fp.plan(HEHN, hanging, duration=duration, time_limit=600)
        print(
            f"{duration:.2f} s: {found.excursion:.3f} m" if found else f"{duration:.2f} s: {found.reason}", flush=True
        )


def ensemble(asked: argparse.Namespace) -> None:
    """Plan many starts of hehn2011 on one core, and tell the processor time."""
    starts = fp.random_starts(asked.runs, asked.seed)
    fp.plan_ensemble(HEHN, starts[:2], guesses=1)
    begin = time.process_time()
    plans = fp.plan_ensemble(HEHN, starts, guesses=asked.guesses, workers=1)
    spent = time.process_time() - begin
    print(f"{asked.guesses} guesses: {plans}")
    print(f"{1e3 * spent / asked.runs:.1f} ms a plan, {asked.runs / spent:.0f} plans per second and core")


def main() -> None:
    """Run one of the benchmarks."""
    parser = argparse.ArgumentParser()
    parser.add_argument("what", choices=("vehicles", "random", "leans", "pareto", "windows", "low", "ensemble"))
    parser.add_argument("--runs", type=int, default=24)
    parser.add_argument("--seed", type=int, default=7702)
    parser.add_argument("--vehicles", type=int, default=20)
    parser.add_argument("--guesses", type=int, default=2)
    parser.add_argument("--fly", type=int, default=0)
    parser.add_argument("--first", type=int, default=0, help="the first of the random vehicles")
    parser.add_argument("--mount", choices=("gimbal", "hub"), default="gimbal")
    asked = parser.parse_args()
    jobs = (vehicles, random, leans, pareto, windows, low, ensemble)
    {job.__name__: job for job in jobs}[asked.what](asked)


if __name__ == "__main__":
    main()
