"""The inverted law on a hub, whose rod must not touch the vehicle: `python -m benchmarks.mounts [runs] [seed]`.

hehn2011 on a hub, rotors plant. A flight counts if it stands and the rod has touched nothing. Starts: hanging
(0.05 rad, 0.1 rad/s) and the rod anywhere it is free, both from a level vehicle at rest of any heading; and the free
starts of the random box.
"""

import sys

import numpy as np

import flypend as fp
from flypend.flight.metrics import wilson
from flypend.model.mount import clearances
from flypend.studies.starts import random_starts

DURATION = 10.0


def at_rest(rng, y, y_dot):
    """Level vehicles at rest of random headings with rods `y`, `y_dot` (n, 3)."""
    heading = rng.uniform(0, 2 * np.pi, len(y))
    c, s, none, one = np.cos(heading), np.sin(heading), np.zeros(len(y)), np.ones(len(y))
    R = np.stack([c, -s, none, s, c, none, none, none, one], axis=-1).reshape(-1, 3, 3)
    rest = np.zeros((len(y), 3))
    return fp.State(x=rest, x_dot=rest, R=R, omega=rest, y=y, y_dot=y_dot)


def hanging(rng, n):
    """States with the rod nearly hanging, nearly at rest."""
    y = 0.05 * rng.standard_normal((n, 3)) - [0, 0, 1]
    y /= np.linalg.norm(y, axis=-1, keepdims=True)
    rate = 0.1 * rng.standard_normal((n, 3))
    return at_rest(rng, y, rate - np.sum(rate * y, axis=-1, keepdims=True) * y)


def anywhere(rng, n):
    """States with the rod in any direction, at rest."""
    y = rng.standard_normal((n, 3))
    y /= np.linalg.norm(y, axis=-1, keepdims=True)
    return at_rest(rng, y, np.zeros((n, 3)))


def free(states, vehicle):
    """Those of `states` whose rod touches nothing."""
    rods = np.einsum("nji,nj->ni", states.R, states.y)
    gaps = clearances(rods, vehicle.rotor_positions, vehicle.reach, vehicle.body).min(axis=-1)
    return states[np.flatnonzero(gaps > 0)]


def main():
    """Print a line for each kind of start."""
    runs, seed = (int(value) for value in (sys.argv[1:] + ["2000", "4712"][len(sys.argv) - 1 :]))
    vehicle, rng = fp.vehicle("hehn2011").replace(mount="hub"), np.random.default_rng(seed)
    box = random_starts(runs, seed)
    kinds = {"hanging": hanging(rng, runs), "level, rod anywhere": anywhere(rng, runs), "random box": box}
    for kind, states in kinds.items():
        starts = free(states, vehicle)
        flown = fp.simulate_ensemble(vehicle, fp.laws.inverted(), starts, DURATION, plant="rotors")
        count, touched = int(flown.success.sum()), int(np.sum(flown.cause == "collided"))
        low, high = wilson(count, len(starts))
        print(f"{kind}: {count} of {len(starts)} stand, {low:.1%} to {high:.1%}; {touched} touch, ", end="")
        print(f"excursion {np.median(flown.excursion):.2f} / {np.percentile(flown.excursion, 95):.2f} m", flush=True)


if __name__ == "__main__":
    main()
