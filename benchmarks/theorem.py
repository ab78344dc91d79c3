"""The numbers of docs/laws/theorem-appendix.md: `python -m benchmarks.theorem WHAT`.

`starts` flies the random starts of seed 2024, a minute. `forces` prints what Theorem A withstands, `bounds` the thrust
that Theorem B guarantees. `LAW [runs] [seed]` is a row of `flypend theorem`: repaired, almost_global, or one of the
laws that lack a part of the proof; it is flown from 100,000 wide starts, some ten minutes. `lag [runs] [seed]` flies
almost_global_lag through 20 and 60 ms on hehn2011, and through the crazyflie's 72 ms, and almost_global through 20 ms.
"""

import sys

import numpy as np

import flypend as fp
from benchmarks.withstood import withstood
from flypend.flight.metrics import wilson
from flypend.laws.repaired import stiffness
from flypend.paper.descent import RISES, descend

SEED = 2024
HANGING = fp.Criterion(target="e3", position=np.inf)
ROWS = (
    ("repaired", "nayak2018", "ideal", 2000, 12.0),
    ("almost_global", "hehn2011", "ideal", 2000, 15.0),
    ("almost_global", "hehn2011", "rotors", 2000, 15.0),
    ("almost_global", "nayak2018", "ideal", 500, 15.0),
    ("almost_global", "crazyflie", "ideal", 500, 15.0),
    ("almost_global", "crazyflie", "rotors", 500, 15.0),
    ("almost_global", "nayak2018", "rotors", 300, 20.0),
)


def descents(name, runs, seed, machine=None):
    """Print how many wide flights converge under law `name`, and the largest rise of V; `machine` as in `descend`."""
    found = descend(name, runs, seed, machine=machine)
    low, high = wilson(found.converged, found.runs)
    early = f"{found.ended} end early" + (f", from V(0) of {found.least_ended:.2g} on" if found.ended else "")
    print(
        f"{name}: {found.converged} of {found.runs} converge (95 %: {low:.4%} to {high:.4%}), {early}; "
        f"V rises by more than {RISES:g} V(0) in {found.rising}, at most by {found.worst_rise:.2g} V(0)"
    )


THROUGH = (("hehn2011", 0.02), ("hehn2011", 0.06), ("crazyflie", 0.072))  # vehicle, lag in s


def through_lag(runs, seed):
    """Print a line for Theorem D through each lag, and one for Theorem B's law, which does not know of it."""
    for name, lag in THROUGH:
        print(f"{name}, {1000 * lag:g} ms: ", end="", flush=True)
        descents("almost_global_lag", runs, seed, fp.vehicle(name).replace(rotor_lag=lag))
    descents("almost_global, its lag unknown", min(runs, 1000), seed)


def starts():
    """Print one line per row: successes, settling time and largest distance (median, 95 %, all)."""
    for name, machine, plant, runs, duration in ROWS:
        law = getattr(fp.laws, name)()
        first = fp.random_starts(runs, SEED).in_frame(law.e3)
        target = HANGING if law.e3 == "down" else fp.Criterion()
        flown = fp.simulate_ensemble(fp.vehicle(machine), law, first, duration, plant=plant, criterion=target)
        low, high = flown.interval
        settling, far = (
            " / ".join(f"{flown.percentile(key, q):.3g}" for q in (50, 95, 100)) for key in ("settling", "excursion")
        )
        print(
            f"{name} on {machine}, {plant}: {flown.success.sum()} of {runs} (95 %: {low:.2%} to {high:.2%}), "
            f"settling {settling} s, distance {far} m",
            flush=True,
        )


def forces():
    """Print the bounds of `withstood` on nayak2018, level by level."""
    law = fp.laws.repaired().bind(fp.vehicle("nayak2018"))
    k_p, rod = float(stiffness(law.vehicle)), law.vehicle.l * law.vehicle.m
    for share in (0.01, 0.1, 0.5, 1.0, 1.5):
        found = withstood(law, share * k_p)
        print(
            f"V <= {share:g} k_p: start V(0) <= {found.start / k_p:.3g} k_p, |w| <= {found.most:.3g} 1/s² "
            f"({1000 * found.most * rod:.2g} mN on the bob), rate {found.rate:.3g} 1/s, gain {found.gain:.3g} s"
        )
    print(f"gain of a constant force: {1 / np.sqrt(2 * k_p):.3g} s")


def bounds():
    """Print the guaranteed largest thrust of Theorem B on hehn2011: over 200 random starts, and of a rod that hangs."""
    law = fp.laws.almost_global().bind(fp.vehicle("hehn2011"))
    first = fp.random_starts(200, SEED)
    most = [law.guarantee(first[i]).thrust[1] for i in range(200)]
    hanging = law.guarantee(fp.State(y=(0, 0, -1))).thrust[1]
    print(f"thrust <= {np.median(most):.2g} N in the median, {max(most):.2g} N at most; hanging {hanging:.2g} N")


def main():
    """Fly what the command line asks for."""
    name = sys.argv[1] if len(sys.argv) > 1 else "starts"
    printed = {"starts": starts, "forces": forces, "bounds": bounds}.get(name)
    if printed:
        printed()
    else:
        runs, seed = (int(text) for text in (*sys.argv[2:4], *("100000", "4242")[len(sys.argv[2:4]) :]))
        if name == "lag":
            through_lag(runs, seed)
        else:
            descents(name, runs, seed)


if __name__ == "__main__":
    main()
