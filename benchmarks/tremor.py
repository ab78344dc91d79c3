"""Tremor in hover by linear theory beside 200 flights: `python -m benchmarks.tremor [runs]`, half a minute.

hehn2011 hovers for 10 s on sensors of several kinds, with the gains that they ask for and a good estimate at first; the
last 3 s count. Prints root mean squares of the pivot's distance and of the thrust axis' tilt, and how calm gains are.
"""

import sys
from dataclasses import replace

import numpy as np

import flypend as fp
from benchmarks.sensors import MOCAP, ONBOARD, sharper, slower
from flypend.plants import ROTORS
from flypend.plants.loop import Loop
from flypend.plants.tremor import tremor

START = fp.Noise(x=1e-3, x_dot=1e-3, attitude=1e-3, y=1e-3, y_dot=1e-3)
DURATION, LAST = 10.0, np.arange(7.0, 10.0, 0.02)  # s
ROWS = {
    "mocap": MOCAP,
    "mocap, poses at 100 Hz": slower(MOCAP, 100.0),
    "mocap, poses at 50 Hz": slower(MOCAP, 50.0),
    "mocap, rod to 1 mrad": sharper(MOCAP, 1e-3),
    "onboard": ONBOARD,
    "onboard, gyroscope to 2 mrad/s": ONBOARD.replace(gyro=replace(ONBOARD.gyro, noise=2e-3)),
    "onboard, position to 1 mm": ONBOARD.replace(position=replace(ONBOARD.position, noise=1e-3)),
}


def main():
    """Print one line per set of sensors."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    vehicle, upright = fp.vehicle("hehn2011"), np.tile([0.0, 0.0, 1.0], (runs, 1))
    law, starts = fp.laws.inverted().bind(vehicle), fp.State(x=np.zeros((runs, 3)), y=upright)
    print("| sensors | calm | hover, theory, cm | flights, cm | axis, theory, rad | flights, rad |")
    print("|---|---|---|---|---|---|")
    for name, sensors in ROWS.items():
        plant = ROTORS.replace(sensors=sensors.replace(start=START))
        flying = Loop(vehicle, law, plant).law
        told = tremor(flying, sensors, 1 / plant.rate)
        flown = fp.simulate_ensemble(vehicle, law, starts, DURATION, plant=plant, times=LAST).samples
        place, axis = (np.sqrt(np.nanmean(np.sum(v**2, axis=-1))) for v in (flown.x, flown.R[..., :2, 2]))
        print(
            f"| {name} | {flying.calm:g} | {100 * told.place:.2f} | {100 * place:.2f} | {told.axis:.4f} | {axis:.4f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
