"""Random vehicles flown by the inverted law: `python -m benchmarks.vehicles [number] [starts] [seed]`.

Log-uniform: mass M from 0.03 to 5 kg, m/M from 0.01 to 0.5, rod from 0.1 to 2 m. Uniform: thrust to weight 1.3 to 6,
lag 10 to 80 ms. Sizes follow from the mass: arm 0.2 m (M/1 kg)^(1/3) times 0.8 to 1.25, radius of gyration of roll and
pitch 0.35 to 0.6 arms, yaw inertia 1.4 to 2 times that, drag ratio 0.05 to 0.12 arms, least force 2 % of the largest.
"""

import sys

import numpy as np

import flypend as fp
from flypend.flight.metrics import wilson
from flypend.laws.inverted_gains import angular_authority
from flypend.studies.starts import random_starts

DURATION, WANTED = 30.0, 0.95


def random_vehicle(rng):
    """A quadrotor of the distribution above."""

    def spread(low, high):
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    mass, share, rod = spread(0.03, 5.0), spread(0.01, 0.5), spread(0.1, 2.0)
    power, lag = rng.uniform(1.3, 6.0), rng.uniform(0.010, 0.080)
    arm = 0.2 * mass ** (1 / 3) * rng.uniform(0.8, 1.25)
    roll = mass * (rng.uniform(0.35, 0.6) * arm) ** 2
    yaw = roll * rng.uniform(1.4, 2.0)
    largest = power * mass * (1 + share) * 9.81 / 4
    return fp.Vehicle(
        name="random", mass=mass, bob_mass=share * mass, rod_length=rod, inertia=(roll, roll, yaw),
        rotor_positions=((arm, 0, 0), (0, -arm, 0), (-arm, 0, 0), (0, arm, 0)), rotor_spins=(1, -1, 1, -1),
        drag_ratio=arm * rng.uniform(0.05, 0.12), rotor_limits=(0.02 * largest, largest), rotor_lag=lag,
    )  # fmt: skip


def numbers(vehicle):
    """Thrust to weight, agility α l/g, and rotor lag over √(l/g)."""
    power = 4 * vehicle.rotor_limits[1] / vehicle.weight
    agility = angular_authority(vehicle) * vehicle.l / vehicle.g
    return power, agility, vehicle.rotor_lag / np.sqrt(vehicle.l / vehicle.g)


def main():
    """Print vehicle by vehicle, and the shares."""
    count, runs, seed = (int(value) for value in (sys.argv[1:] + ["200", "100", "2025"][len(sys.argv) - 1 :]))
    rng, law, flown, good = np.random.default_rng(seed), fp.laws.inverted(), 0, 0
    print(
        "| vehicle | M, kg | l, m | m/M | thrust/weight | agility | lag | succeed |\n|---|---|---|---|---|---|---|---|"
    )
    for i in range(count):
        vehicle = random_vehicle(rng)
        power, agility, lag = numbers(vehicle)
        told = f"| {i} | {vehicle.M:.3f} | {vehicle.l:.2f} | {vehicle.m / vehicle.M:.2f} "
        told += f"| {power:.2f} | {agility:.2f} | {lag:.2f} |"
        try:
            rate = fp.simulate_ensemble(vehicle, law, random_starts(runs, seed + 1), DURATION, plant="rotors").rate
        except fp.InputError as error:
            print(f"{told} refused: {error} |", flush=True)
            continue
        flown += 1
        good += rate >= WANTED
        print(f"{told} {rate:.0%} |", flush=True)
    low, high = wilson(good, flown)
    print(f"\n| | vehicles | flown | succeed from {WANTED:.0%} of the starts | 95 % interval |\n|---|---|---|---|---|")
    print(f"| all | {count} | {flown} | {good} | {low:.0%} to {high:.0%} |")


if __name__ == "__main__":
    main()
