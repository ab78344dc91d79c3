"""How many random starts the corrected law loses: `python -m benchmarks.runaway [runs]`, two minutes for 2,000.

Seed 99, 30 s, rates of vehicle and rod up to 3, 6 and 12 rad/s. A rod faster than 20 rad/s at the end spins; one that
is within 0.05 of e₃ and slower than 0.05 rad/s hangs. Last, the same with beta regularised, for the lowest rates.
"""

import sys

import numpy as np

import flypend as fp
from flypend.flight.metrics import wilson
from flypend.geometry import E3, norm
from flypend.model.state import split

SEED, DURATION, RATES = 99, 30.0, (3.0, 6.0, 12.0)


def counts(runs, rate, **options):
    """How many of `runs` starts with rates up to `rate` (rad/s) spin and how many hang under `corrected(**options)`."""
    rng = np.random.default_rng(SEED)
    starts = fp.State.random(rng, runs, max_omega=rate, max_y_dot=rate).flipped()
    law, vehicle = fp.laws.corrected(**options), fp.vehicle("nayak2018")
    # The few that spin at 1e5 rad/s take all the time; they are judged once a second.
    flown = fp.simulate_ensemble(vehicle, law, starts, DURATION, plant="ideal", rtol=1e-9, judge_period=1.0)
    final = flown.final if isinstance(flown.final, fp.State) else fp.State(**split(flown.final))
    speed = norm(final.y_dot)
    hangs = (norm(final.y - E3) < 0.05) & (speed < 0.05)
    return int(np.sum(speed > 20)), int(np.sum(hangs))


def main():
    """Print one line per distribution of starts."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 2000
    for rate, options in [*((rate, {}) for rate in RATES), (RATES[0], {"beta": "regularized"})]:
        spin, hang = counts(runs, rate, **options)
        low, high = wilson(spin, runs)
        print(
            f"beta {options.get('beta', 'off'):11} rates up to {rate:2g} rad/s: {spin} of {runs} spin "
            f"(95 %: {low:.2%} to {high:.2%}), {hang} hang",
            flush=True,
        )


if __name__ == "__main__":
    main()
