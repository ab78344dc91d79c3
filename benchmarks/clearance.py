"""Whether the rod would miss the rotors, were they there: `python -m benchmarks.clearance [runs]`, a minute for 1,000.

The model has no body: the rod is a line from the centre of mass, which lies in the plane of the rotors. It touches that
plane only where y·z changes sign, and there the disc of a rotor is hit if the rod, lying in the plane, passes closer to
its centre than its radius. Flights are those of the inverted law on hehn2011 with rotors, seed 2024, 10 s.
"""

import sys

import numpy as np

import flypend as fp
from flypend.flight.metrics import wilson
from flypend.studies.starts import random_starts

SEED, DURATION, RATE = 2024, 10.0, 500  # every tick of the plant
RADII = (0.0635, 0.1)  # m: a 5 inch propeller, and the 0.1 m of larger ones


def in_body(run):
    """Rᵀy (n, 3): the rod in the frame of the vehicle."""
    return np.einsum("nji,nj->ni", run.R, run.y)


def crossings(rod):
    """Unit vectors (k, 3) of a `rod` (n, 3), in the body frame, where it lies in the plane of the rotors."""
    before, after = rod[:-1], rod[1:]
    at = np.flatnonzero((before[:, 2] > 0) != (after[:, 2] > 0))
    share = before[at, 2] / (before[at, 2] - after[at, 2])
    found = before[at] + share[:, None] * (after[at] - before[at])
    return found / np.linalg.norm(found, axis=-1, keepdims=True)


def nearest(directions, vehicle):
    """Least distance (m) of a rod along any of `directions` (k, 3) to the centre of a rotor; inf for no direction."""
    centres = np.asarray(vehicle.rotor_positions)
    along = np.clip(directions @ centres.T, 0, vehicle.l)
    gaps = np.linalg.norm(centres - along[..., None] * directions[:, None], axis=-1)
    return float(np.min(gaps, initial=np.inf))


def flown(start, law):
    """A flight from `start` under `law`, sampled at every tick."""
    vehicle = fp.vehicle("hehn2011")
    times = np.linspace(0, DURATION, int(DURATION * RATE) + 1)
    return fp.simulate(vehicle, law, start, DURATION, plant="rotors", times=times)


def main():
    """Print the shares that keep clear, and how the swing-up of the README passes."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    starts, vehicle, law = random_starts(runs, SEED), fp.vehicle("hehn2011"), fp.laws.inverted()
    gaps, above = [], 0
    for i in range(runs):
        rod = in_body(flown(starts[i], law))
        gaps.append(nearest(crossings(rod), vehicle))
        above += bool(np.all(rod[:, 2] > 0))
    kept = [(f"clear of discs of {radius:g} m", int(np.sum(np.array(gaps) > radius))) for radius in RADII]
    for what, count in [*kept, ("y·z > 0 throughout", above)]:
        low, high = wilson(count, runs)
        print(f"{what}: {count} of {runs}, {count / runs:.1%} (95 %: {low:.1%} to {high:.1%})")
    passed = crossings(in_body(flown(fp.State(y=(0, 0, -1)), law)))
    bearings = ", ".join(f"{angle:.0f}°" for angle in np.degrees(np.arctan2(passed[:, 1], passed[:, 0])) % 360)
    print(f"from hanging at rest: at {bearings} from the front arm, {nearest(passed, vehicle):.4f} m from a hub")


if __name__ == "__main__":
    main()
