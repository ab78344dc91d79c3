"""What friction, spin and offset of the joint do to the inverted law: `python -m benchmarks.joint [runs] [seed]`.

hehn2011 with a uniform rod of 50 g and 1.13 m, the law bound to that vehicle without knowing its joint, rotors plant.
"""

import sys
from collections import Counter

import flypend as fp
from flypend.flight.metrics import wilson
from flypend.studies.starts import random_starts

DURATION = 10.0
# On both sides of the edge of each; units as in the vehicle's file.
JOINTS = (
    {},
    *({"pivot_damping": value} for value in (3e-3, 5e-3, 1e-2)),
    *({"pivot_friction": value} for value in (1e-3, 2e-3, 5e-3, 1e-2)),
    {"rod_spin": 100.0, "rod_spin_inertia": 2.5e-6},  # a bar of 1 cm radius
    *({"rod_spin": rate, "rod_spin_inertia": 1e-3} for rate in (20.0, 60.0)),  # a wheel
    *({"pivot_offset": (0.0, 0.0, height)} for height in (0.03, 0.05, 0.1, -0.02, -0.03, -0.05)),
    {"pivot_offset": (0.03, 0.0, 0.0)},
)


def main() -> None:
    """Print a row for each joint."""
    runs, seed = (int(value) for value in (sys.argv[1:] + ["500", "2024"][len(sys.argv) - 1 :]))
    vehicle = fp.vehicle("hehn2011").replace(**fp.uniform_rod(0.05, 1.13))
    starts = random_starts(runs, seed)
    print("| joint | succeed | 95 % interval | failures end by |\n|---|---|---|---|")
    for joint in JOINTS:
        flown = fp.simulate_ensemble(vehicle.replace(**joint), fp.laws.inverted(), starts, DURATION)
        low, high = wilson(int(flown.success.sum()), runs)
        causes = Counter(map(str, flown.cause[~flown.success])).most_common(1)
        told = ", ".join(f"{name} {value}" for name, value in joint.items()) or "free"
        print(
            f"| {told} | {flown.success.sum()} | {low:.1%} to {high:.1%} | {causes[0][0] if causes else ''} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
