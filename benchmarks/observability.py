"""What a flight tells of each error that a laboratory has: `python -m benchmarks.observability [vehicle]`.

A Kalman filter of the whole state and all these errors at once is linearised along two true flights, a hover of ten
seconds and a swing-up, with the noise of the suite's sensors and the forces that its estimator reckons with. Whoever
estimates an error from these readings knows it no better. Prints the standard deviation of each error after the flight
over that before it, which is 1 for what only a calibration tells; and, of the information in units of what is known
before, the rank (directions told at least as well as known before) and the condition. Draws docs/img/observability.svg.
"""

import argparse
from pathlib import Path

import casadi as ca
import matplotlib.pyplot as plt
import numpy as np

import flypend as fp
from flypend.geometry import cross
from flypend.laws.linearise import tangent_basis
from flypend.model import Disturbance, State, Wrench, disturbed_motion
from flypend.model.state import SIZE
from flypend.plants import ROTORS, SUITES
from flypend.plants.tremor import exponential

PICTURE = Path(__file__).parents[1] / "docs" / "img" / "observability.svg"
RATE = 200.0  # of the linearisation and of the poses, Hz
FLIGHTS = {"hover, 10 s": ((0.0, 0.0, 1.0), 10.0), "swing-up, 6 s": ((0.0, 0.0, -1.0), 6.0)}
DEGREE = np.pi / 180
# Standard deviations before the flight: what `flypend check` calls a careful laboratory, or worse where that is common.
# Of each, numbers; forces are in weights, moments in the largest moment.
KNOWN = {
    "rod's length": (1, 0.08), "bob's mass": (1, 0.1), "thrust": (1, 0.1), "moment": (1, 0.1),
    "delay of commands": (1, 0.01), "trim": (2, 0.05), "wind": (3, 0.02), "force across the rod": (3, 0.01),
    "gyroscope's bias": (3, 0.02), "accelerometer's bias": (3, 0.2), "IMU askew": (3, DEGREE),
    "markers askew": (3, DEGREE), "markers off the pivot": (3, 0.003), "rod's markers off": (3, 0.01),
    "joints' zeros": (3, 0.01), "age of the poses": (1, 0.005), "tilt of the frame": (3, DEGREE),
}  # fmt: skip
SUITES_SHOWN = ("mocap", "onboard")
ONLY = {"mocap": {"joints' zeros"}, "onboard": {"markers askew", "rod's markers off", "age of the poses"}}  # not there


class Nominal:
    """A vehicle whose rod and bob differ by the ratios `longer` and `heavier`, less 1."""

    def __init__(self, vehicle, longer, heavier):
        self._vehicle = vehicle
        self.l, self.m = vehicle.l * (1 + longer), vehicle.m * (1 + heavier)

    def __getattr__(self, name):
        return getattr(self._vehicle, name)

    def in_frame(self, e3):
        """As `Vehicle.in_frame`."""
        return self


def equations(vehicle, suite):
    """Return CasADi functions of (state, errors, wrench, its rate): rates and readings with their Jacobians."""
    packed, wrench, rate = ca.SX.sym("s", SIZE), ca.SX.sym("w", 4), ca.SX.sym("r", 4)
    errors = {name: ca.SX.sym("e", size) for name, (size, _) in KNOWN.items()}
    driven = ca.SX.sym("d", 9)  # accelerations of vehicle and bob, and of the turn, that drive the state
    s, nominal = State.symbolic(packed), Nominal(vehicle, errors["rod's length"], errors["bob's mass"])
    acting = wrench - errors["delay of commands"] * rate
    thrust = (1 + errors["thrust"]) * acting[0]
    largest = vehicle.rotor_limits[1] * np.max(np.abs(vehicle.mixing()[1]))
    moment = (1 + errors["moment"]) * acting[1:] + largest * ca.vertcat(errors["trim"], 0) * acting[0] / vehicle.weight
    wind, across = vehicle.weight * errors["wind"], vehicle.weight * errors["force across the rod"]
    M, m = vehicle.M, vehicle.m
    on_vehicle = M / (M + m) * wind - across + M * driven[:3]
    on_bob = m / (M + m) * wind + across + m * driven[3:6]
    rates = disturbed_motion(s, Wrench(thrust, moment), nominal, "up", Disturbance(on_vehicle, on_bob))
    turning = rates.omega_dot + driven[6:]
    motion = ca.vertcat(rates.x_dot, rates.x_ddot, ca.vec(rates.R_dot.T), turning, rates.y_dot, rates.y_ddot)
    age, tilt = errors["age of the poses"], errors["tilt of the frame"]
    x = s.x - age * s.x_dot + s.R @ errors["markers off the pivot"]
    y = s.y - age * s.y_dot
    felt = s.R.T @ (rates.x_ddot + vehicle.g * np.array([0, 0, 1]))
    askew = errors["IMU askew"]
    turned = ca.vec(s.R.T) + ca.vec(
        (s.R @ ca.skew(errors["markers askew"]) + ca.skew(tilt) @ s.R - age * s.R @ ca.skew(s.omega)).T
    )
    readings = {
        "position": x + cross(tilt, x),
        "attitude": turned,
        "gyro": s.omega + errors["gyroscope's bias"] + cross(s.omega, askew),
        "accelerometer": felt + errors["accelerometer's bias"] + cross(felt, askew),
        "rod": y + cross(tilt, y) + cross(errors["rod's markers off"], y),
        "joints": s.R.T @ s.y + cross(errors["joints' zeros"], s.R.T @ s.y),
    }
    unknown = ca.vertcat(*errors.values())
    given = [packed, unknown, wrench, rate, driven]
    read = {name: readings[name] for name in suite.streams if name in readings}
    jacobians = [ca.jacobian(motion, v) for v in (packed, unknown, driven)]
    told = {name: [ca.jacobian(value, v) for v in (packed, unknown)] for name, value in read.items()}
    return (
        ca.Function("motion", given, jacobians),
        {name: ca.Function("told", given, pair) for name, pair in told.items()},
    )


def flown(vehicle, suite, y, duration):
    """Return states (n, 24), wrenches (n, 4) and their rates of a true flight from rest with the rod at `y`."""
    plant = ROTORS.replace(sensors=suite, seed=1)
    times = np.arange(0, duration, 1 / RATE)
    run = fp.simulate(vehicle, fp.laws.inverted(), fp.State(y=y), duration=duration, plant=plant, times=times)
    wrenches = np.column_stack([run.thrust, run.moment])[: len(times)]
    return run.states.packed()[: len(times)], wrenches, np.gradient(wrenches, 1 / RATE, axis=0)


def covariances(vehicle, name, y, duration):
    """Return the covariance of all errors before and after a flight on the suite `name`, of 16 of the state first."""
    suite, period = SUITES[name], 1 / RATE
    motion, told = equations(vehicle, suite)
    states, wrenches, rates = flown(vehicle, suite, y, duration)
    start, none = suite.start, np.zeros(9)
    known = np.concatenate([np.full(n, 1e-6 if what in ONLY[name] else sd) for what, (n, sd) in KNOWN.items()])
    first = [start.x] * 3 + [start.x_dot] * 3 + [start.attitude] * 3 + [start.omega] * 3 + [start.y] * 2
    P = before = np.diag(np.concatenate([first, [start.y_dot] * 2, known]) ** 2)
    unknown, size = np.zeros(len(known)), len(known)
    for k, (packed, wrench, rate) in enumerate(zip(states, wrenches, rates, strict=True)):
        s, given = State.trusted(packed), (packed, unknown, wrench, rate, none)
        E = tangent_basis(s)
        planes = {
            "attitude": E[6:15, 6:9].T / 2, "rod": E[18:21, 12:14].T,
            "joints": tangent_basis(fp.State(y=s.R.T @ s.y))[18:21, 12:14].T,
        }  # fmt: skip
        for stream, function in told.items():
            by_state, by_error = (np.array(value) for value in function(*given))
            H = planes.get(stream, np.eye(3)) @ np.hstack([by_state @ E, by_error])
            noise = getattr(suite, stream).density(1 / 500) * RATE
            gain = np.linalg.solve(H @ P @ H.T + noise * np.eye(len(H)), H @ P).T
            P = P - gain @ H @ P
            P = (P + P.T) / 2
        if k + 1 == len(states):
            break
        by_state, by_error, by_force = (np.array(value) for value in motion(*given))
        A = np.zeros((SIZE + size,) * 2)
        A[:SIZE] = np.hstack([by_state, by_error])
        step = exponential(A * period)[:SIZE]
        back = np.linalg.pinv(tangent_basis(State.trusted(states[k + 1])))
        F = np.eye(16 + size)
        F[:16] = back @ np.hstack([step[:, :SIZE] @ E, step[:, SIZE:]])
        departure = np.sum((wrench[0] * s.z / vehicle.weight - [0, 0, 1]) ** 2) * vehicle.g**2
        of_force = suite.force_error**2 + suite.manoeuvre_error**2 * departure
        G = np.zeros((16 + size, 9))
        G[:16] = back @ by_force * np.sqrt(period * np.array([of_force] * 6 + [suite.moment_error**2 * period] * 3))
        P = F @ P @ F.T + G @ G.T
    return before[16:, 16:], P[16:, 16:]


def summarise(before, after, name):
    """Return by error its worst ratio of standard deviations, and rank, size and condition of the information."""
    there = np.repeat([what not in ONLY[name] for what in KNOWN], [n for n, _ in KNOWN.values()])
    scale = np.sqrt(np.diag(before))[there]
    relative = after[np.ix_(there, there)] / np.outer(scale, scale)
    told = 1 / np.linalg.eigvalsh(relative) - 1
    ratios, place = {}, 0
    for what, (n, _) in KNOWN.items():
        if what not in ONLY[name]:
            part = slice(place, place + n)
            ratios[what] = np.sqrt(np.max(np.diag(relative)[part]))
            place += n
    return ratios, int(np.sum(told >= 1)), len(told), float(np.sqrt(np.max(told) / max(np.min(told), 1e-12)))


def draw(found):
    """Draw the ratios of each case in `found`."""
    figure, axes = plt.subplots(figsize=(6.4, 5.2), layout="constrained")
    looks = {"mocap": ("#0072B2", "o"), "onboard": ("#D55E00", "s")}
    for (name, flight), (ratios, *_) in found.items():
        colour, marker = looks[name]
        rows = [list(KNOWN).index(what) + (0.12 if name == "onboard" else -0.12) for what in ratios]
        filled = colour if flight.startswith("swing") else "white"
        axes.plot(
            list(ratios.values()), rows, marker, color=colour, markerfacecolor=filled, markersize=6,
            label=f"{name}, {flight}", linestyle="none",
        )  # fmt: skip
    axes.set_xscale("log")
    axes.set_yticks(range(len(KNOWN)), list(KNOWN))
    axes.invert_yaxis()
    axes.axvline(1, color="0.5", linewidth=0.8)
    axes.set_xlabel("standard deviation after the flight / before")
    axes.grid(axis="y", linewidth=0.4)
    axes.legend(loc="upper center", bbox_to_anchor=(0.4, 1.12), ncols=2, fontsize="small", frameon=False)
    figure.savefig(PICTURE)


def main():
    """Print and draw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("vehicle", nargs="?", default="hehn2011")
    vehicle, found = fp.vehicle(parser.parse_args().vehicle), {}
    for name in SUITES_SHOWN:
        for flight, (y, duration) in FLIGHTS.items():
            found[name, flight] = summarise(*covariances(vehicle, name, y, duration), name)
    print("| error | " + " | ".join(f"{name}, {flight}" for name, flight in found) + " |\n|---" + "|---" * 4 + "|")
    for what in KNOWN:
        print(f"| {what} | " + " | ".join(f"{r[what]:.2g}" if what in r else "" for r, *_ in found.values()) + " |")
    print("| rank | " + " | ".join(f"{rank} of {size}" for _, rank, size, _ in found.values()) + " |")
    print("| condition | " + " | ".join(f"{condition:.0f}" for *_, condition in found.values()) + " |")
    draw(found)


if __name__ == "__main__":
    main()
