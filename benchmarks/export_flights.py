"""Flights of the exported law beside the Python one, and of the light form beside the full one.

    python benchmarks/export_flights.py --runs 500 --plant mujoco

prints success, excursion and settling of the same random starts under the Python law, its C in both precisions, and
the light form.
"""

import argparse

import flypend as fp
from flypend.export import compiled
from flypend.studies.starts import random_starts


def main() -> None:
    """Fly and print one line per controller."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--plant", default="rotors")
    parser.add_argument("--vehicle", default="hehn2011")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--only", help="part of the name of a controller")
    given = parser.parse_args()
    vehicle = fp.vehicle(given.vehicle)
    full, light = fp.laws.inverted(), fp.laws.inverted(form="light")
    controllers = {
        "full, Python": lambda: full,
        "full, C double": lambda: compiled(full, vehicle),
        "full, C float": lambda: compiled(full, vehicle, "float"),
        "light, C float": lambda: compiled(light, vehicle, "float"),
    }
    starts = random_starts(given.runs, given.seed)
    for name, make in controllers.items():
        if given.only and given.only not in name:
            continue
        runs = fp.simulate_ensemble(vehicle, make(), starts, 10.0, plant=given.plant, workers=given.workers)
        low, high = runs.interval
        print(
            f"{name:15} {given.plant} success {runs.rate:.1%} of {len(runs)} (95 % {low:.1%} to {high:.1%}), "
            f"excursion p50 {runs.percentile('excursion', 50):.2f} p95 {runs.percentile('excursion', 95):.2f} m, "
            f"settling p50 {runs.percentile('settling', 50):.2f} p95 {runs.percentile('settling', 95):.2f} s",
            flush=True,
        )


if __name__ == "__main__":
    main()
