"""How often bands hold: `python -m benchmarks.identified [logs] [seed] [seconds] [engine] [folder]`.

Logs of random machines, from random guesses, with gusts, noise, biases, delay, sag, unequal rotors and late poses,
flown by MuJoCo, or by the engine "equations". Counted: true numbers within their 95 % bands, and errors against the
goals of `identify`. Logs whose result is in the folder are not flown again.
"""

import json
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np

import flypend as fp
from flypend.flight.metrics import wilson
from flypend.identification.manoeuvre import rehearse, write_log

LATENCY = 0.008  # s, of poses
# Goals by number: unit, units in one, and the largest error.
GOALS = {
    "rod": ("%", 100, 2), "bob over mass": ("%", 100, 5), "thrust scale over mass": ("%", 100, 1),
    "inertia 1 over mass": ("%", 100, 5), "inertia 2 over mass": ("%", 100, 5),
    "torque ratio over inertia 3": ("%", 100, 5), "lag": ("ms", 1000, 3), "delay": ("ms", 1000, 3),
}  # fmt: skip


def machine(rng):
    """Return a machine near hehn2011, and what `around` draws for it."""
    size = rng.uniform(0.7, 1.4)
    base = fp.vehicle("hehn2011")
    true = base.replace(
        mass=base.mass * size, bob_mass=base.bob_mass * size * rng.uniform(0.7, 1.5),
        rotor_lag=rng.uniform(0.015, 0.05), inertia=base.inertia * size * rng.uniform(0.8, 1.2),
        rod_length=base.rod_length * rng.uniform(0.7, 1.3), rotor_limits=(0.08, 3.5 * size),
    )  # fmt: skip
    return true, *around(true, rng)


def around(true, rng):
    """Return the plant that a machine flies in, its thrust scale, and a guess within the bounds of the goals."""
    off = lambda share: 1 + rng.uniform(-share, share)  # noqa: E731
    guess = true.replace(
        mass=true.mass * off(0.005), rod_length=true.rod_length * off(0.1), bob_mass=true.bob_mass * off(0.05),
        inertia=true.inertia * off(0.35) * np.diag([off(0.05), off(0.05), 1.0]), drag_ratio=true.drag_ratio * off(0.4),
        rotor_lag=0.03,
    )  # fmt: skip
    gust = rng.uniform(0.005, 0.04) * true.weight
    plant = fp.Plant(
        delay=rng.uniform(0, 0.02), sag=rng.uniform(0, 0.08), spin_up=rng.uniform(1, 1.4),
        strength=tuple(1 + rng.uniform(-0.05, 0.05, 4)), air=() if true.air is None else true.air.active(),
        wind=fp.Wind(gust_on_vehicle=gust, gust_on_bob=gust / 5, gust_time=rng.uniform(0.5, 2)),
        noise=fp.Noise(x=1e-3, x_dot=3e-2, attitude=3.5e-3, omega=2e-2, y=3.5e-3),
    )  # fmt: skip
    return plant, rng.uniform(0.88, 1.1), guess


def logged(flown, guess):
    """Return what `identify` finds in a rehearsal, and the processor time, s."""
    with TemporaryDirectory() as folder:
        write_log(f"{folder}/flight.csv", flown.columns)
        begun = process_time()
        return fp.identify(f"{folder}/flight.csv", guess), process_time() - begun


def identified(k, seed, seconds, engine):
    """Fly and identify log `k`; return what held its truth, by name, errors by goal, and processor time, s."""
    rng = np.random.default_rng([seed, k])
    true, plant, scale, guess = machine(rng)
    flying = plant.replace(engine=engine, strength=tuple(scale * np.array(plant.strength)))
    flown = rehearse(guess, true, flying, duration=seconds, latency=LATENCY, bias=0.01, seed=seed + k)
    found, spent = logged(flown, guess)
    middle = float(np.exp(np.log(plant.strength).mean()))
    truth = {
        "mass": true.mass, "rod_length": true.rod_length, "bob_mass": true.bob_mass, "inertia": np.diag(true.inertia),
        "drag_ratio": true.drag_ratio, "rotor_lag": true.rotor_lag, "spin_up": plant.spin_up, "sag": plant.sag,
        "delay": plant.delay, "latency": LATENCY, "thrust_scale": scale * middle, "pivot_offset": np.zeros(3),
        "strength": np.array(plant.strength) / middle,
    }  # fmt: skip
    held = {}
    for name, value in truth.items():
        low, high = (np.array(end) for end in found.bands[name])
        held[name] = np.ravel((low <= value) & (value <= high)).tolist()
    v, per_mass = found.vehicle, true.mass / found.vehicle.mass
    off = {
        "rod": v.rod_length / true.rod_length - 1,
        "bob over mass": v.bob_mass / true.bob_mass * per_mass - 1,
        "thrust scale over mass": v.thrust_scale * per_mass / (scale * middle) - 1,
        "inertia 1 over mass": v.inertia[0, 0] * per_mass / true.inertia[0, 0] - 1,
        "inertia 2 over mass": v.inertia[1, 1] * per_mass / true.inertia[1, 1] - 1,
        "torque ratio over inertia 3": v.drag_ratio / v.inertia[2, 2] / true.drag_ratio * true.inertia[2, 2] - 1,
        "lag": v.rotor_lag - true.rotor_lag, "delay": found.delay - plant.delay,
    }  # fmt: skip
    return {"held": held, "off": {name: float(error) for name, error in off.items()}, "spent": spent}


def main():
    """Fly and identify each log; print what held."""
    logs, seed, seconds = (int(text) for text in (*sys.argv[1:4], *("20", "0", "60")[len(sys.argv[1:4]) :]))
    engine, *keep = sys.argv[4:] or ["mujoco"]
    found = []
    for k in range(logs):
        kept = Path(keep[0], f"{seed}-{k}-{seconds}-{engine}.json") if keep else None
        if kept and kept.exists():
            found.append(json.loads(kept.read_text(encoding="utf-8")))
            continue
        found.append(identified(k, seed, seconds, engine))
        if kept:
            kept.write_text(json.dumps(found[-1]), encoding="utf-8")
    every = 0, 0
    for name in found[0]["held"]:
        each = [one for log in found for one in log["held"][name]]
        every = every[0] + sum(each), every[1] + len(each)
        print(f"{name}: {sum(each)} of {len(each)} within the band")
    print(f"all: {every[0]} of {every[1]} within the band ({every[0] / every[1]:.1%})")
    for name, (unit, factor, goal) in GOALS.items():
        errors = factor * np.array([log["off"][name] for log in found])
        good = int((np.abs(errors) <= goal).sum())
        low, high = wilson(good, logs)
        told = f"median {np.median(errors):+.2f} {unit}, largest {np.abs(errors).max():.2f} {unit}"
        print(f"{name}: {good} of {logs} within {goal:g} {unit} ({low:.0%} to {high:.0%}), {told}")
    print(f"processor time of a log of {seconds} s: {np.mean([log['spent'] for log in found]):.0f} s")


if __name__ == "__main__":
    main()
