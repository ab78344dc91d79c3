"""The basins on docs/laws/theorem-appendix.md: `python -m benchmarks.basin`, ten minutes on two quiet cores.

With `lag`, through rotors that lag, as long. With `hub`, on a hub, from hanging and from the same box.
"""

import sys

import flypend as fp
from flypend.studies.basin import measure_basin

RUNS = {"hehn2011": 1_000_000, "crazyflie": 100_000}
LAGGED = {"hehn2011": 440_000, "crazyflie": 20_000}
SEED, LAG_SEED = 20261123, 20261126  # used for nothing else
# Starts and lag, and how many starts of each vehicle.
ON_HUB = {("hanging", False): 10_000, ("random", False): 5_000, ("hanging", True): 3_000, ("random", True): 2_000}
HUBS, HUB_SEED = ("hehn2011",), 20261125  # used for nothing else


def main(*, lag: bool):
    """Print how many random starts of each vehicle end in its certified set, and what that says of all."""
    _head()
    for name, runs in (LAGGED if lag else RUNS).items():
        _row(f"{name}, lag" if lag else name, measure_basin(fp.vehicle(name), runs, LAG_SEED if lag else SEED, lag=lag))


def on_hub():
    """Print the same of vehicles on a hub, where a flight ends at a touch, and how many do."""
    _head(" touch |")
    for name in HUBS:
        vehicle = fp.vehicle(name).replace(mount="hub")
        for (starts, lag), runs in ON_HUB.items():
            found = measure_basin(vehicle, runs, HUB_SEED, lag=lag, starts=starts)
            _row(f"{name}, {starts}{', lag' if lag else ''}", found, f" {found.touched} |")


def _head(last=""):
    print("| vehicle | starts | in the set | the last after, s | at 95 %, at least |" + last)
    print("|---|---|---|---|---|" + "---|" * bool(last), flush=True)


def _row(label, found, last=""):
    share = f"{100 * found.least:.4f} %"
    print(f"| {label} | {found.runs} | {found.entered} | {found.slowest} | {share} |" + last, flush=True)


if __name__ == "__main__":
    on_hub() if sys.argv[1:] == ["hub"] else main(lag=sys.argv[1:] == ["lag"])
