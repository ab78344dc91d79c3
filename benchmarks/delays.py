"""What a delay costs that the law is told, and one that it is not: `python -m benchmarks.delays [runs] [seed]`.

hehn2011 behind rotors from random starts. The law is told the delay of the plant, then nothing (its default), then a
delay that is 5 or 15 ms off.
"""

import sys

import flypend as fp
from flypend.flight.metrics import wilson

VEHICLE = fp.vehicle("hehn2011")
DELAYS = (0.0, 0.02, 0.03, 0.036, 0.045, 0.052, 0.06, 0.07, 0.08, 0.1, 0.12)  # s
DURATION = 10.0  # s


def flown(delay, latency, starts):
    """Print how many of `starts` stand at `delay` (s) with the law told `latency` (s), None for its default."""
    law = fp.laws.inverted() if latency is None else fp.laws.inverted(latency=latency)
    found = fp.simulate_ensemble(VEHICLE, law, starts, DURATION, plant=fp.Plant(delay=delay))
    low, high = wilson(found.success.sum(), len(found.success))
    far = ", ".join(f"{found.percentile('excursion', q):.2f}" for q in (50, 95))
    print(
        f"delay {1000 * delay:3.0f} ms, told {'default' if latency is None else f'{1000 * latency:3.0f} ms'}: "
        f"{found.success.sum()} of {len(found.success)} (95 %: {low:.1%} to {high:.1%}), excursion {far} m",
        flush=True,
    )


def main():
    """Fly every delay, told and untold."""
    runs, seed = (int(text) for text in (*sys.argv[1:3], *("200", "771900")[len(sys.argv[1:3]) :]))
    starts = fp.random_starts(runs, seed)
    for off in (0.0, None, 0.005, -0.005, 0.015, -0.015):
        for delay in DELAYS:
            latency = None if off is None else delay + off
            if latency is None or latency >= 0:
                flown(delay, latency, starts)


if __name__ == "__main__":
    main()
