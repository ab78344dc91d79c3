"""How often bands hold: `python -m benchmarks.identified [logs] [seed] [seconds]`.

Logs of random machines, from random guesses, with gusts, noise, biases, delay, sag, unequal rotors and late poses, by
the package's own plant. Counted: true numbers within their 95 % bands, and errors against the goals of `identify`.
"""

import sys
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np

import flypend as fp
from flypend.identification.manoeuvre import rehearse, write_log


def machine(rng):
    """Return a machine, the plant that it flies in, its thrust scale, and a guess within the bounds of the goals."""
    size = rng.uniform(0.7, 1.4)
    base = fp.vehicle("hehn2011")
    true = base.replace(
        mass=base.mass * size, bob_mass=base.bob_mass * size * rng.uniform(0.7, 1.5),
        rotor_lag=rng.uniform(0.015, 0.05), inertia=base.inertia * size * rng.uniform(0.8, 1.2),
        rod_length=base.rod_length * rng.uniform(0.7, 1.3), rotor_limits=(0.08, 3.5 * size),
    )  # fmt: skip
    off = lambda share: 1 + rng.uniform(-share, share)  # noqa: E731
    guess = true.replace(
        mass=true.mass * off(0.005), rod_length=true.rod_length * off(0.1), bob_mass=true.bob_mass * off(0.05),
        inertia=true.inertia * off(0.35) * np.diag([off(0.05), off(0.05), 1.0]), drag_ratio=true.drag_ratio * off(0.4),
        rotor_lag=0.03,
    )  # fmt: skip
    gust = rng.uniform(0.005, 0.04) * true.weight
    plant = fp.Plant(
        delay=rng.uniform(0, 0.02), sag=rng.uniform(0, 0.08), spin_up=rng.uniform(1, 1.4),
        strength=tuple(1 + rng.uniform(-0.05, 0.05, 4)), wind=fp.Wind(gust_on_vehicle=gust, gust_on_bob=gust / 5),
        noise=fp.Noise(x=1e-3, x_dot=3e-2, attitude=3.5e-3, omega=2e-2, y=3.5e-3),
    )  # fmt: skip
    return true, plant, rng.uniform(0.88, 1.1), guess


def main():
    """Fly and identify each log; print what held."""
    logs, seed, seconds = (int(text) for text in (*sys.argv[1:4], *("20", "0", "60")[len(sys.argv[1:4]) :]))
    held: dict[str, list[bool]] = {}
    errors: dict[str, list[float]] = {}
    spent = []
    for k in range(logs):
        rng = np.random.default_rng([seed, k])
        true, plant, scale, guess = machine(rng)
        flown = rehearse(guess, true, plant, duration=seconds, latency=0.008, bias=0.01, scale=scale, seed=seed + k)
        with TemporaryDirectory() as folder:
            write_log(f"{folder}/flight.csv", flown.columns)
            begun = process_time()
            found = fp.identify(f"{folder}/flight.csv", guess)
            spent.append(process_time() - begun)
        middle = float(np.exp(np.log(plant.strength).mean()))
        truth = {
            "rod_length": true.rod_length, "bob_mass": true.bob_mass, "inertia": np.diag(true.inertia),
            "drag_ratio": true.drag_ratio, "rotor_lag": true.rotor_lag, "spin_up": plant.spin_up, "sag": plant.sag,
            "delay": plant.delay, "thrust_scale": scale * middle, "strength": np.array(plant.strength) / middle,
        }  # fmt: skip
        for name, value in truth.items():
            low, high = (np.array(end) for end in found.bands[name])
            held.setdefault(name, []).extend(np.ravel((low <= value) & (value <= high)).tolist())
        v = found.vehicle
        for name, error in {
            "rod, %": 100 * (v.rod_length / true.rod_length - 1),
            "thrust scale over mass, %": 100 * (v.thrust_scale * true.mass / v.mass / (scale * middle) - 1),
            "inertia 1 over mass, %": 100 * (v.inertia[0, 0] * true.mass / v.mass / true.inertia[0, 0] - 1),
            "torque ratio over inertia 3, %": 100
            * (v.drag_ratio / v.inertia[2, 2] / true.drag_ratio * true.inertia[2, 2] - 1),
            "lag, ms": 1e3 * (v.rotor_lag - true.rotor_lag),
            "delay, ms": 1e3 * (found.delay - plant.delay),
        }.items():
            errors.setdefault(name, []).append(abs(float(error)))
    for name, each in held.items():
        print(f"{name}: {sum(each)} of {len(each)} within the band")
    every = [one for each in held.values() for one in each]
    print(f"all: {sum(every)} of {len(every)} within the band ({np.mean(every):.1%})")
    for name, each in errors.items():
        print(f"{name}: median {np.median(each):.2f}, largest {max(each):.2f}")
    print(f"{logs} logs of {seconds} s, {np.mean(spent):.0f} s of processor time each")


if __name__ == "__main__":
    main()
