"""Flights with sensors and an estimator: `python -m benchmarks.sensors [runs] [--seed N]`, a minute or two for 2,000.

Random starts of a vehicle (hehn2011 unless named) under the inverted law, rotors plant (500 Hz), 10 s each. Prints how
many stand (|y − e₃| and |z − e₃| below 0.05 and the pivot within 0.2 m throughout the last second), how many hover (RMS
of the distance in that second) within 1.5 cm, the RMS of the thrust axis' error there, and flights per second and core
of processor time.
"""

import argparse
import time
from dataclasses import replace

import numpy as np

import flypend as fp
from flypend.flight.metrics import wilson
from flypend.plants import ROTORS, SUITES
from flypend.studies.starts import random_starts

DURATION, HOVER = 10.0, 0.015  # s, m
LAST = np.arange(DURATION - 1, DURATION + 1e-9, 0.01)
MOCAP, ONBOARD, WITHOUT = SUITES["mocap"], SUITES["onboard"], SUITES["mocap-without-accelerometer"]
HEAVY = {"mass": 1.2, "bob_mass": 1.2, "rod_length": 1.15}
LIGHT = {"mass": 0.8, "bob_mass": 0.8, "rod_length": 0.85}


def slower(suite, rate):
    """The suite with its poses at another `rate`, Hz."""
    poses = {name: replace(getattr(suite, name), rate=rate) for name in ("position", "attitude", "rod")}
    return suite.replace(**poses)


def sharper(suite, noise):
    """The suite with another `noise` of the rod's direction, rad."""
    return suite.replace(rod=replace(suite.rod, noise=noise))


PLAIN = "gains of perfect sensors"
ROWS = {
    "perfect": ROTORS,
    "mocap": ROTORS.replace(sensors=MOCAP),
    "mocap, poses at 100 Hz": ROTORS.replace(sensors=slower(MOCAP, 100.0)),
    "mocap, poses at 50 Hz": ROTORS.replace(sensors=slower(MOCAP, 50.0)),
    "mocap, rod to 1 mrad": ROTORS.replace(sensors=sharper(MOCAP, 1e-3)),
    f"mocap, poses at 100 Hz, {PLAIN}": ROTORS.replace(sensors=slower(MOCAP, 100.0)),
    f"mocap, poses at 50 Hz, {PLAIN}": ROTORS.replace(sensors=slower(MOCAP, 50.0)),
    "onboard": ROTORS.replace(sensors=ONBOARD),
    "mocap, masses +5 and -5 %": ROTORS.replace(sensors=MOCAP, mismatch={"mass": 1.05, "bob_mass": 0.95}),
    "onboard, masses +5 and -5 %": ROTORS.replace(sensors=ONBOARD, mismatch={"mass": 1.05, "bob_mass": 0.95}),
    "mocap, masses × 1.2, rod × 1.15": ROTORS.replace(sensors=MOCAP, mismatch=HEAVY),
    "mocap, masses × 0.8, rod × 0.85": ROTORS.replace(sensors=MOCAP, mismatch=LIGHT),
    "onboard, masses × 1.2, rod × 1.15": ROTORS.replace(sensors=ONBOARD, mismatch=HEAVY),
    "onboard, masses × 0.8, rod × 0.85": ROTORS.replace(sensors=ONBOARD, mismatch=LIGHT),
    "mocap, thrust −15 %": ROTORS.replace(sensors=MOCAP, strength=0.85),
    "onboard, thrust −15 %": ROTORS.replace(sensors=ONBOARD, strength=0.85),
    "mocap, gyroscope off by 0.05 rad/s": ROTORS.replace(sensors=MOCAP.replace(gyro_bias=(0.03, -0.03, 0.03))),
    "onboard, gyroscope off by 0.05 rad/s": ROTORS.replace(sensors=ONBOARD.replace(gyro_bias=(0.03, -0.03, 0.03))),
    "mocap, 1 % of poses wrong": ROTORS.replace(sensors=MOCAP.replace(outliers=0.01)),
    "mocap, poses 20 ms older than told": ROTORS.replace(sensors=MOCAP.replace(untold_latency=0.02)),
    "mocap without accelerometer": ROTORS.replace(sensors=WITHOUT),
    "mocap without accelerometer, masses × 1.2, rod × 1.15": ROTORS.replace(sensors=WITHOUT, mismatch=HEAVY),
    "mocap, 10 ms of delay unknown to it": ROTORS.replace(sensors=MOCAP.replace(command_delay=0.0), delay=0.01),
    "mocap, rates differenced": ROTORS.replace(sensors=MOCAP.replace(rates="differenced")),
    "the same, rod to 0.3 mrad": ROTORS.replace(sensors=sharper(MOCAP.replace(rates="differenced"), 3e-4)),
}


def main():
    """Fly and print one line per row."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", type=int, nargs="?", default=2000)
    parser.add_argument("--seed", type=int, default=771505)
    parser.add_argument("--vehicle", default="hehn2011")
    parser.add_argument("--only", default="", help="part of the name of a row")
    given = parser.parse_args()
    vehicle, starts = fp.vehicle(given.vehicle), random_starts(given.runs, given.seed)
    law = fp.laws.inverted()
    plain = law.with_gains(law.gains_for(vehicle))  # what is given is not made calmer
    print("| sensors | stand (95 %) | hover within 1.5 cm (95 %) | hover m, p50 / p95 | axis, p50 / p95 | flights/s |")
    print("|---|---|---|---|---|---|")
    for name, plant in ROWS.items():
        if given.only not in name:
            continue
        flown = plain if PLAIN in name else law
        fp.simulate_ensemble(vehicle, flown, starts[:8], DURATION, plant=plant, times=LAST)  # compiles
        begin = time.process_time()
        runs = fp.simulate_ensemble(vehicle, flown, starts, DURATION, plant=plant, times=LAST, workers=1)
        per_second = given.runs / (time.process_time() - begin)
        print(row(name, runs, per_second), flush=True)


def row(name, runs, per_second):
    """One line of the table."""
    samples = runs.samples
    far = np.sqrt(np.mean(np.sum(samples.x**2, axis=-1), axis=1))
    off = np.sqrt(np.mean(np.sum((samples.R[..., 2] - [0, 0, 1]) ** 2, axis=-1), axis=1))
    far, off = np.nan_to_num(far, nan=np.inf), np.nan_to_num(off, nan=np.inf)
    middle = [" / ".join(f"{np.percentile(values, p):.3f}" for p in (50, 95)) for values in (far, off)]
    stand, hover = counted(runs.success), counted(far <= HOVER)
    return f"| {name} | {stand} | {hover} | {middle[0]} | {middle[1]} | {per_second:,.0f} |"


def counted(passed):
    """How many pass, with the Wilson interval."""
    low, high = wilson(int(np.sum(passed)), len(passed))
    return f"{np.sum(passed):,} ({100 * low:.1f}–{100 * high:.1f} %)"


if __name__ == "__main__":
    main()
