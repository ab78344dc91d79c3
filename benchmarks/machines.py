"""Random vehicles: masses from 0.03 to 5 kg, rods from 0.1 to 2 m, rotors from weak and slow to strong and fast."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import flypend as fp

GRAVITY = 9.81


def machines(count: int, seed: int) -> Iterator[fp.Vehicle]:
    """Yield `count` vehicles, drawn from `seed`.

    Evenly in the logarithm: mass 0.03 to 5 kg, bob 0.01 to 0.5 of it, rod 0.1 to 2 m. Evenly: thrust 1.3 to 6 times the
    weight, lag 10 to 80 ms. Arms grow with the cube root of the mass, from those of hehn2011, by ±30 %; the inertia is
    0.1 to 0.4 of mass · arm².
    """
    rng = np.random.default_rng(seed)

    def even(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    for i in range(count):
        mass = even(0.03, 5.0)
        bob_mass, rod_length = mass * even(0.01, 0.5), even(0.1, 2.0)
        strongest = rng.uniform(1.3, 6.0) * (mass + bob_mass) * GRAVITY / 4
        arm = 0.17 * np.cbrt(mass / 0.5) * even(0.7, 1.3)
        across = mass * arm**2 * even(0.1, 0.4)
        yield fp.Vehicle(
            name=f"machine {i}", mass=mass, bob_mass=bob_mass, rod_length=rod_length,
            inertia=[across, across, 1.8 * across], drag_ratio=0.016,
            rotor_positions=[[arm, 0, 0], [0, -arm, 0], [-arm, 0, 0], [0, arm, 0]], rotor_spins=[1, -1, 1, -1],
            rotor_limits=[0.02 * strongest, strongest], rotor_lag=rng.uniform(0.01, 0.08),
        )  # fmt: skip
