"""From how many free starts of the random box a rod on a hub can stand: `python -m benchmarks.passable [runs] [seed]`.

hehn2011 on a hub, the starts of `benchmarks.mounts`. Plans keep the rod clear of discs and arms by `GAP`, from eight
guesses each; a start without a plan is not one that no law could manage. Prints from how many there is a plan, from how
many the law stands, and from how many one or the other. Some seconds a start.
"""

import sys

import flypend as fp
from benchmarks.mounts import DURATION, free
from flypend.flight.metrics import wilson
from flypend.studies.starts import random_starts

GAP = 1e-3  # m; one that is touched at the start, or is left within a moment, cannot be kept larger


def main():
    """Print the counts."""
    runs, seed = (int(value) for value in (sys.argv[1:] + ["40", "4712"][len(sys.argv) - 1 :]))
    vehicle = fp.vehicle("hehn2011").replace(mount="hub")
    starts = free(random_starts(2 * runs, seed), vehicle)[:runs]
    flown = fp.simulate_ensemble(vehicle, fp.laws.inverted(), starts, DURATION, plant="rotors").success
    planned = fp.plan_ensemble(vehicle, starts, clearance=GAP, guesses=8).success
    either = planned | flown
    low, high = wilson(int(either.sum()), runs)
    print(f"plans from {planned.sum()} of {runs}, the law stands from {flown.sum()}, ", end="")
    print(f"one or the other from {either.sum()} ({low:.1%} to {high:.1%})")


if __name__ == "__main__":
    main()
