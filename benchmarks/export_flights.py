"""Flights of the exported flight computer beside Python's, of the bare law, and of the light form beside the full one.

    python benchmarks/export_flights.py --vehicle crazyflie --runs 500 --seed 2024
    python benchmarks/export_flights.py --vehicle crazyflie --runs 500 --seed 2024 --plant mujoco
    python benchmarks/export_flights.py --bare --runs 500 --seed 2024
    python benchmarks/export_flights.py --forms --runs 1000 --seed 2024

prints success, excursion and settling of the same random starts: under Python's flight computer and the C one in both
precisions; how many succeed when parts of the board are missing; or under both forms of the law in harder plants.
"""

import argparse
from dataclasses import replace

import flypend as fp
from flypend.export import compiled
from flypend.laws import Computer
from flypend.plants import MOTION_CAPTURE
from flypend.studies.starts import random_starts

DURATION = 10.0  # s


def main() -> None:
    """Fly and print one line per controller."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--plant", default="rotors")
    parser.add_argument("--vehicle", default="hehn2011")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--bare", action="store_true")
    parser.add_argument("--forms", action="store_true")
    parser.add_argument("--only", help="part of the name of a controller")
    given = parser.parse_args()
    starts = random_starts(given.runs, given.seed)
    if given.bare:
        print(bare(starts, given.workers))
        return
    vehicle = fp.vehicle(given.vehicle)
    for name, make, plant in forms() if given.forms else controllers(vehicle, given.plant):
        if given.only and given.only not in name:
            continue
        runs = fp.simulate_ensemble(vehicle, make(), starts, DURATION, plant=plant, workers=given.workers)
        low, high = runs.interval
        print(
            f"{name:28} success {runs.rate:.1%} of {len(runs)} (95 % {low:.1%} to {high:.1%}), "
            f"excursion p50 {runs.percentile('excursion', 50):.2f} p95 {runs.percentile('excursion', 95):.2f} m, "
            f"settling p50 {runs.percentile('settling', 50):.2f} p95 {runs.percentile('settling', 95):.2f} s",
            flush=True,
        )


def controllers(vehicle, plant):
    """Python and C in one plant."""
    law = fp.laws.inverted()
    return [
        ("Python", lambda: law, plant),
        ("C double", lambda: compiled(law, vehicle), plant),
        ("C float", lambda: compiled(law, vehicle, "float"), plant),
    ]


def bare(starts, workers):
    """A table of successes, with parts of the board missing."""
    cases = {
        "hehn2011": ("hehn2011", fp.Plant()),
        "hehn2011, 15 ms from measurement to command": ("hehn2011", fp.Plant(delay=0.015)),
        "hehn2011, vehicle and bob 20 % heavier than known": ("hehn2011", OFF),
        "crazyflie": ("crazyflie", fp.Plant()),
    }
    missing = {
        "board": {},
        "no observer": {"observer": 0.0},
        "no prediction": {"latency": 0.0},
        "no lead": {"lead": 1.0},
        "bare law": vars(Computer()),
    }
    lines = [f"| of {len(starts)} | {' | '.join(missing)} |", "|---" * (len(missing) + 1) + "|"]
    for name, (machine, plant) in cases.items():
        vehicle = fp.vehicle(machine)
        law = fp.laws.inverted().bind(vehicle)
        cells = []
        for change in missing.values():
            flown = replace(law, computer=replace(law.computer, **change))
            runs = fp.simulate_ensemble(vehicle, flown, starts, DURATION, plant=plant, workers=workers)
            cells.append(str(round(runs.rate * len(runs))))
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


OFF = fp.Plant(mismatch={"mass": 1.2, "bob_mass": 1.2})


def forms():
    """Both forms of the law in harder and harder plants."""
    off = {"mass": 1.1, "bob_mass": 0.9, "rod_length": 1.1, "inertia": 1.1}
    hard = {
        "rotors": "rotors",
        "40 ms lag, 100 Hz, 10 ms": fp.Plant(lag=0.04, rate=100.0, delay=0.01),
        "10 % mismatch": fp.Plant(mismatch=off),
        "motion capture noise": fp.Plant(noise=MOTION_CAPTURE),
    }
    return [
        (f"{plant}, {form}", lambda form=form: fp.laws.inverted(form=form), hard[plant])
        for plant in hard
        for form in ("full", "light")
    ]


if __name__ == "__main__":
    main()
