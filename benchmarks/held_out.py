"""Flights with wrong sensors and vehicles from held-out starts: `python -m benchmarks.held_out [vehicle] [runs]`.

A minute for 400 runs. Random starts, and a quarter as many hanging ones, under the inverted law in the plant
"rotors", 20 s each, from a seed that nothing was tuned on. Prints how many succeed, with the Wilson interval of 95 %,
and the root mean square of the pivot's distance in the last 2 s of the random ones, over flights.
"""

import argparse

import numpy as np

import flypend as fp
from benchmarks.sensors import HEAVY, LIGHT, counted
from flypend.flight.tasks import task_starts
from flypend.plants import PRESETS, ROTORS, SUITES

SEED, DURATION = 20261124, 20.0  # s
LAST = np.arange(DURATION - 2.0, DURATION + 1e-9, 0.02)
TURNED = float(np.radians(1.0))
# Of sensors: what is wrong with them alone. A sign pattern, so that no axis is spared.
SENSORS = {
    "as they are": {},
    "gyroscope off by 0.05 rad/s": {"gyro_bias": (0.03, -0.03, 0.03)},
    "accelerometer off by 0.3 m/s²": {"accelerometer_bias": (0.2, -0.2, 0.1)},
    "IMU askew by 1°": {"imu_turned": TURNED},
    "markers askew by 1°": {"markers_turned": TURNED},
    "1 % of poses wrong": {"outliers": 0.01},
    "poses 20 ms older than told": {"untold_latency": 0.02},
}
# Of the world: wind as a share of the weight, of which the bob takes a tenth.
WIND = 0.01
WORLD = {
    "thrust −15 %": {"strength": 0.85},
    "battery sag 8 %": {"sag": 0.08},
    "centre of mass off by 3 mm": {"centre_of_mass": (0.003, 0.0, 0.0)},
    "wind of 1 % of the weight": {},
    "masses × 1.2, rod × 1.15": {"mismatch": HEAVY},
    "masses × 0.8, rod × 0.85": {"mismatch": LIGHT},
}


def plants(vehicle):
    """Return the plants by name of the row."""
    found = {"laboratory": PRESETS["laboratory"]}
    push = WIND * vehicle.weight
    wind = fp.Wind(on_vehicle=(0.9 * push, 0.0, 0.0), on_bob=(0.1 * push, 0.0, 0.0))
    for name in ("mocap", "onboard"):
        suite = SUITES[name]
        for what, wrong in SENSORS.items():
            seen = suite.attitude is not None or not {"markers_turned", "untold_latency"} & wrong.keys()
            if seen:
                found[f"{name}, {what}"] = ROTORS.replace(sensors=suite.replace(**wrong))
        for what, wrong in WORLD.items():
            found[f"{name}, {what}"] = ROTORS.replace(sensors=suite, **(wrong or {"wind": wind}))
    return found


def main():
    """Fly and print one line per row."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("vehicle", nargs="?", default="hehn2011")
    parser.add_argument("runs", type=int, nargs="?", default=400)
    parser.add_argument("--only", default="", help="part of the name of a row")
    given = parser.parse_args()
    vehicle, law = fp.vehicle(given.vehicle), fp.laws.inverted()
    starts = task_starts(vehicle, given.runs, SEED, directions=max(1, given.runs // 4 - 1))
    print("| wrong | random | hanging | hover, cm, p50 / p95 |\n|---|---|---|---|")
    for name, plant in plants(vehicle).items():
        if given.only in name:
            flown = [
                fp.simulate_ensemble(vehicle, law, starts[task], DURATION, plant=plant, times=LAST, workers=1)
                for task in ("random", "hanging")
            ]
            far = 100 * np.sqrt(np.mean(np.sum(flown[0].samples.x ** 2, axis=-1), axis=1))
            middle = " / ".join(f"{np.percentile(np.nan_to_num(far, nan=np.inf), p):.1f}" for p in (50, 95))
            print(f"| {name} | {' | '.join(counted(runs.success) for runs in flown)} | {middle} |", flush=True)


if __name__ == "__main__":
    main()
