"""Flights with wrong sensors and vehicles from held-out starts: `python -m benchmarks.held_out [vehicle] [runs]`.

A minute for 400 runs. Random starts, and a quarter as many hanging ones, under the inverted law in the plant
"rotors", 20 s each, from a seed that nothing was tuned on. Prints how many succeed, with the Wilson interval of 95 %,
and the root mean square of the pivot's distance in the last 2 s of the random ones, over flights.

`--corners` instead draws machines with every error at one of its bounds at once: masses 20 %, rod and thrust 15 %, and
20 ms of delay that nobody told of, in a wind with gusts. Twelve random starts each.
"""

import argparse

import numpy as np

import flypend as fp
from benchmarks.sensors import HEAVY, LIGHT, counted
from flypend.flight.tasks import task_starts
from flypend.plants import PRESETS, ROTORS, SUITES

SEED, DURATION = 20261124, 20.0  # s
LAST = np.arange(DURATION - 2.0, DURATION + 1e-9, 0.02)
UPRIGHT = 0.95  # the cosine of 18°: a rod that is kept up, however much the vehicle trembles
TURNED = float(np.radians(1.0))
# Of sensors: what is wrong with them alone. A sign pattern, so that no axis is spared.
SENSORS = {
    "as they are": {},
    "gyroscope off by 0.05 rad/s": {"gyro_bias": (0.03, -0.03, 0.03)},
    "accelerometer off by 0.3 m/s²": {"accelerometer_bias": (0.2, -0.2, 0.1)},
    "IMU askew by 1°": {"imu_turned": TURNED / np.sqrt(3)},
    "IMU askew by 1° about each axis": {"imu_turned": TURNED},
    "markers askew by 1° about each axis": {"markers_turned": TURNED},
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


# Of machines in a corner: half-widths, and gusts as a share of the weight.
WIDTHS, GUST, EACH = {"mass": 0.2, "bob_mass": 0.2, "rod_length": 0.15}, 0.005, 12


def corners(vehicle, runs):
    """Return plants with every error at a bound, by name of the suite."""
    rng, push = np.random.default_rng(SEED), WIND * vehicle.weight
    wind = fp.Wind(
        on_vehicle=(0.9 * push, 0.0, 0.0), on_bob=(0.1 * push, 0.0, 0.0), gust_on_vehicle=GUST * vehicle.weight
    )
    drawn = [(rng.choice([-1, 1], 3), rng.choice([0.85, 1.15])) for _ in range(runs // EACH)]
    return {
        name: [
            ROTORS.replace(
                sensors=SUITES[name].replace(command_delay=0.0), delay=0.02, wind=wind, strength=strength, seed=k,
                mismatch={what: 1 + sign * width for sign, (what, width) in zip(signs, WIDTHS.items(), strict=True)},
            )
            for k, (signs, strength) in enumerate(drawn)
        ]
        for name in ("mocap", "onboard")
    }  # fmt: skip


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
    parser.add_argument("--corners", action="store_true", help="machines with every error at a bound")
    given = parser.parse_args()
    vehicle, law = fp.vehicle(given.vehicle), fp.laws.inverted()
    if given.corners:
        print("| corners | random | upright |\n|---|---|---|")
        for name, drawn in corners(vehicle, given.runs).items():
            flown = [
                fp.simulate_ensemble(
                    vehicle, law, fp.random_starts(EACH, SEED + k), DURATION, plant=plant, times=LAST, workers=1
                )
                for k, plant in enumerate(drawn)
            ]
            stand = np.concatenate([runs.success for runs in flown])
            up = np.concatenate([np.all(runs.samples.y[..., 2] > UPRIGHT, axis=1) for runs in flown])
            print(f"| {name} | {counted(stand)} | {counted(up)} |", flush=True)
        return
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
