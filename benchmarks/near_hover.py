"""Sampling, delay and errors of measurement near hover, linearised: `python -m benchmarks.near_hover`, seconds.

The table of docs/laws/theorem-appendix.md, for the laws of Theorems B and D. A law's wrench is held from one sample to
the next, or acts late; or the law is told a wrong state. Hover stays an equilibrium, so a loop whose linear part is
stable converges to it exactly, from near enough.
"""

import math

import casadi as ca
import numpy as np
from scipy.linalg import expm

import flypend as fp
from flypend.laws.closed_loop import COMMANDS, symbolic_loop
from flypend.model import State, Wrench, equations_of_motion

VEHICLES = ("hehn2011", "crazyflie", "nayak2018")
STEP = 2e-4  # s, of the search for the largest period and delay
FOR = 30.0  # s, over which an impulse is summed
# Errors of measurement: name, first of two coordinates, size of the error, unit of the coordinate.
ERRORS = (("rod 0.1°", 11, math.radians(0.1)), ("tilt 0.1°", 6, math.radians(0.1)), ("rod rate 0.01 rad/s", 13, 0.01))


def around_hover(vehicle, *, lag):
    """Return A, B, K of ξ' = A ξ + B w, w = K ξ: ξ (15) is x, ẋ, tilt (2), ω, y (2), ẏ (2); with lag, the wrench too.

    The heading is left out: nothing depends on it.
    """
    xi, w = ca.SX.sym("xi", 15), ca.SX.sym("w", 4)
    law = (fp.laws.almost_global_lag() if lag else fp.laws.almost_global()).bind(vehicle)
    tilt = ca.vertcat(xi[6:8], 0)
    R = ca.SX.eye(3) + ca.skew(tilt) + ca.skew(tilt) @ ca.skew(tilt) / 2
    near = ca.sqrt(1 - ca.sumsqr(xi[11:13]))
    state = State(
        x=xi[:3], x_dot=xi[3:6], R=R, omega=xi[8:11], y=ca.vertcat(xi[11:13], near),
        y_dot=ca.vertcat(xi[13:15], -ca.dot(xi[11:13], xi[13:15]) / near),
    )  # fmt: skip
    loop = symbolic_loop(vehicle, law, lag=lag)
    command = [loop.signals[name] for name in COMMANDS] if lag else [loop.wrench.thrust, loop.wrench.moment]
    asked = ca.Function("law", [loop.t, loop.s], [ca.vertcat(*command)])
    rates = equations_of_motion(state, Wrench(w[0], w[1:]), vehicle, "up").packed()
    place = ca.Function("at", [xi], [state.packed()])
    J = np.array(ca.Function("J", [xi], [ca.jacobian(place(xi), xi)])(0))
    back = np.linalg.pinv(J)
    hover = np.array([vehicle.weight, 0, 0, 0])
    both = ca.Function("both", [xi, w], [ca.jacobian(rates, xi), ca.jacobian(rates, w)])
    A, B = (back @ np.array(part) for part in both(0, hover))
    if not lag:
        K = np.array(ca.Function("K", [xi], [ca.jacobian(asked(0, place(xi)), xi)])(0))
        return A, B, K
    told = asked(0, ca.vertcat(place(xi), w))
    K = ca.Function("K", [xi, w], [ca.jacobian(told, ca.vertcat(xi, w))])
    T = vehicle.rotor_lag
    A = np.block([[A, B], [np.zeros((4, 15)), -np.eye(4) / T]])
    return A, np.vstack([np.zeros((15, 4)), np.eye(4) / T]), np.array(K(0, hover))


def held(A, B, period):
    """Return e^(A h) and what a unit of w, held for `period` h, adds."""
    n, m = B.shape
    whole = expm(np.block([[A, B], [np.zeros((m, n + m))]]) * period)
    return whole[:n, :n], whole[:n, n:]


def radius(A, B, K, period, late=0):
    """Return the spectral radius of the loop sampled at `period`, whose wrench acts `late` periods late."""
    F, G = held(A, B, period)
    n, m = G.shape
    size = n + m * late
    step = np.zeros((size, size))
    step[:n, :n] = F
    if late:
        step[:n, n : n + m] = G
        step[n : size - m, n + m :] = np.eye(m * (late - 1))
        step[size - m :, :n] = K
    else:
        step[:n, :n] += G @ K
    return np.max(np.abs(np.linalg.eigvals(step)))


def largest(stable):
    """Return the largest k up to 1,000 for which all `stable(1)`, …, `stable(k)` hold."""
    k = 0
    while k < 1000 and stable(k + 1):
        k += 1
    return k


def wander(vehicle, A, B, K, errors):
    """Return how far the bob moves at most, m, for each of the `errors` of measurement, however it varies in time."""
    bob, far = np.zeros((2, len(A))), []
    bob[0, 0] = bob[1, 1] = 1
    bob[0, 11] = bob[1, 12] = vehicle.l
    F = expm((A + B @ K) * 1e-3)
    for _, first, size in errors:
        response, total = B @ K[:, first : first + 1], 0.0
        for _ in range(int(FOR / 1e-3)):
            total = total + np.abs(bob @ response) * 1e-3
            response = F @ response
        far.append(size * float(np.linalg.norm(total)))
    return far


def main():
    """Print, for each vehicle and law, the largest period and delay, and how far errors of measurement move the bob."""
    print("| vehicle | slowest decay, 1/s | sampled at 500 Hz, 1/s | largest period, ms | largest delay, ms |", end="")
    print("".join(f" {name}, mm |" for name, *_ in ERRORS))
    print("|---" * (5 + len(ERRORS)) + "|")
    for lag in (False, True):
        for name in VEHICLES:
            vehicle = fp.vehicle(name)
            A, B, K = around_hover(vehicle, lag=lag)
            loop = A + B @ K
            decay = -np.max(np.linalg.eigvals(loop).real)
            sampled = -np.log(radius(A, B, K, 2e-3)) / 2e-3
            period = 1e3 * STEP * largest(lambda k, of=(A, B, K): radius(*of, k * STEP) < 1)
            delay = largest(lambda k, of=(A, B, K): radius(*of, 1e-3, k) < 1)
            label = f"{name}, lag" if lag else name
            print(f"| {label} | {decay:.3f} | {sampled:.3f} | {period:.1f} | {delay} |", end="")
            far = wander(vehicle, A, B, K, ERRORS)
            print("".join(f" {1e3 * value:.2g} |" for value in far), flush=True)


if __name__ == "__main__":
    main()
