"""The basins on docs/laws/theorem-appendix.md: `python -m benchmarks.basin`, ten minutes on two quiet cores.

With `lag`, through rotors that lag.
"""

import sys

import flypend as fp
from flypend.studies.basin import measure_basin

RUNS = {"hehn2011": 1_000_000, "crazyflie": 100_000}
LAGGED = {"hehn2011": 20_000, "crazyflie": 20_000}
SEED = 20261123  # used for nothing else


def main(*, lag: bool):
    """Print how many random starts of each vehicle end in its certified set, and what that says of all."""
    print("| vehicle | starts | in the set | the last after, s | at 95 %, at least |")
    print("|---|---|---|---|---|")
    for name, runs in (LAGGED if lag else RUNS).items():
        found = measure_basin(fp.vehicle(name), runs, SEED, lag=lag)
        share = f"{100 * found.least:.4f} %"
        label = f"{name}, lag" if lag else name
        print(f"| {label} | {found.runs} | {found.entered} | {found.slowest} | {share} |", flush=True)


if __name__ == "__main__":
    main(lag=sys.argv[1:] == ["lag"])
