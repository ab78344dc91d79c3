"""The basins on docs/laws/theorem-appendix.md: `python -m benchmarks.basin`, ten minutes on two quiet cores."""

import flypend as fp
from flypend.studies.basin import measure_basin

RUNS = {"hehn2011": 1_000_000, "crazyflie": 100_000}
SEED = 20261123  # used for nothing else


def main():
    """Print how many random starts of each vehicle end in its certified set, and what that says of all."""
    print("| vehicle | starts | in the set | the last after, s | at 95 %, at least |")
    print("|---|---|---|---|---|")
    for name, runs in RUNS.items():
        found = measure_basin(fp.vehicle(name), runs, SEED)
        share = f"{100 * found.least:.4f} %"
        print(f"| {name} | {found.runs} | {found.entered} | {found.slowest} | {share} |", flush=True)


if __name__ == "__main__":
    main()
