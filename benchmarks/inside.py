"""Flights from the edge of the certified sets, within rotor limits: `python -m benchmarks.inside`, a minute.

Starts are of random direction in the chart of docs/laws/theorem-proof.md, section 8, and of random heading and yaw
rate, with V or V' near c. Each flies the law of the set.
"""

import numpy as np

import flypend as fp
from flypend.geometry import E3, cross, rotation_from_vector
from flypend.laws import certificate
from flypend.laws.certified import _state, chart_function
from flypend.model import State

CASES = (("hehn2011", False), ("crazyflie", False), ("crazyflie", True))
RUNS, SEED, DURATION = 1000, 20261127, 12.0  # s; the seed is used for nothing else
TIMES = np.linspace(0.0, DURATION, 241)


def edge(certified, runs, seed):
    """Return `runs` states at the edge of the set, and the forces of their rotors, (runs, n) or None without lag."""
    made, law, rng = certified.certificate, certified.law, np.random.default_rng(seed)
    numbers = list(made["numbers"].values())
    sizes, chart = certificate.radii(made["numbers"], certified.c), chart_function(tuple(made["numbers"]))
    states, wrenches, vehicle = [], [], law.vehicle
    for _ in range(runs):
        x = rng.normal(size=len(sizes))
        asked, place = (np.array(part).ravel() for part in chart(0.99 * x / np.linalg.norm(x) * sizes, numbers))
        state = _state(place, asked[-4:-1], law)
        turn, spin = rotation_from_vector((0, 0, rng.uniform(-np.pi, np.pi))), rng.uniform(-1, 1) * certified.yaw_rate
        R, omega = state.R @ turn, turn.T @ state.omega + (0, 0, spin)
        states.append(State(x=state.x, x_dot=state.x_dot, R=R, omega=omega, y=state.y, y_dot=state.y_dot).packed())
        if law.uses_wrench:  # f and u that act, with the yaw acceleration of Theorem B's law
            alpha = cross(E3, R.T @ asked[5:8]) + spin * cross(omega, E3) - law.gains["yaw_damping"] * spin * E3
            moment = vehicle.I @ alpha + cross(omega, vehicle.I @ omega)
            wrenches.append(np.append(asked[4], moment))
    return State.trusted(np.stack(states)), np.array(wrenches) @ vehicle.unmixing().T if wrenches else None


def main():
    """Print how many flights from the edge stay in the set and converge, and how far V rises between samples."""
    print("| vehicle | starts | least V/c | stay | largest rise of V/c | converge |")
    print("|---|---|---|---|---|---|", flush=True)
    for name, lag in CASES:
        law = (fp.laws.almost_global_lag() if lag else fp.laws.almost_global()).bind(fp.vehicle(name))
        certified = law.certified_set()
        starts, rotors = edge(certified, RUNS, SEED)
        plant = fp.Ideal(limits=True, lag=lag, rotors=rotors) if lag else fp.Ideal(limits=True)
        flown = fp.simulate_ensemble(law.vehicle, law, starts, DURATION, plant=plant, rtol=1e-10, times=TIMES)
        ratios = certified.ratios(flown.samples, flown.wrenches)
        stay, V = np.all(ratios <= 1, axis=(1, 2)), ratios[..., 0]
        rise = np.max(np.diff(V, axis=1))
        label = f"{name}, lag" if lag else name
        print(
            f"| {label} | {RUNS} | {np.min(V[:, 0]):.2f} | {stay.sum()} | {max(rise, 0.0):.1g} | "
            f"{flown.success.sum()} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
