"""What a delay costs that the computer finds, and one that it is told: `python -m benchmarks.delays [runs] [seed]`.

hehn2011 behind rotors from random starts, with perfect measurements and with motion capture whose estimator is told of
no delay either. First the law with its defaults, which finds the delay; then the same without that (`delay_reach` 0),
untold, told, and told 5 ms too much or too little.
"""

import sys

import flypend as fp
from flypend.flight.metrics import wilson
from flypend.plants import SUITES

VEHICLE = fp.vehicle("hehn2011")
DELAYS = (0.0, 0.02, 0.036, 0.052, 0.07, 0.08, 0.09, 0.1, 0.12)  # s
DURATION = 10.0  # s
UNAWARE = SUITES["mocap"].replace(command_delay=0.0)


def flown(kind, delay, starts, sensors=None, **gains):
    """Print how many of `starts` stand at `delay` (s) under the law with `gains`."""
    plant = fp.Plant(delay=delay, sensors=sensors)
    found = fp.simulate_ensemble(VEHICLE, fp.laws.inverted(**gains), starts, DURATION, plant=plant)
    low, high = wilson(found.success.sum(), len(found.success))
    far = ", ".join(f"{found.percentile('excursion', q):.2f}" for q in (50, 95))
    print(
        f"{kind}, delay {1000 * delay:3.0f} ms: {found.success.sum()} of {len(found.success)} "
        f"(95 %: {low:.1%} to {high:.1%}), excursion {far} m",
        flush=True,
    )


def main():
    """Fly every delay, found, untold and told."""
    runs, seed = (int(text) for text in (*sys.argv[1:3], *("200", "771900")[len(sys.argv[1:3]) :]))
    starts = fp.random_starts(runs, seed)
    for delay in DELAYS:
        flown("found", delay, starts)
    for delay in DELAYS[:6]:
        flown("found, motion capture", delay, starts, UNAWARE)
    for delay in DELAYS[:4]:
        flown("untold", delay, starts, delay_reach=0)
    for off in (0.0, 0.005, -0.005):
        for delay in DELAYS[2:]:
            flown(f"told {1000 * (delay + off):.0f} ms", delay, starts, delay_reach=0, latency=delay + off)


if __name__ == "__main__":
    main()
