"""Defects 12 to 16 of the paper, in statements other than the law: signs, units, frames and conclusions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from flypend.flight.simulate import simulate
from flypend.geometry import E3, apply, dot, norm
from flypend.model import State, Vehicle, Wrench, equations_of_motion, potential_energy, vehicle
from flypend.paper.claims import Finding, Runs
from flypend.paper.table import experiment

SEED = 2018
YAW = 1.0  # rad, between the two starts


def work_sign(_: Runs) -> Finding:
    """Defect 12: the work in (hamprin) has the wrong sign, and so do the forces in (xeqn_txt) and (Rfin)."""
    rng = np.random.default_rng(SEED)
    state, body = State.random(rng, 1000), vehicle("nayak2018")
    f, mu = rng.normal(size=1000), rng.normal(size=(1000, 3))
    # In (xeqn_txt), (Rfin) and (ddty_notfin) the force is f z and the moment −mu.
    rate = energy_rate(state, Wrench(f, -mu), body)
    power = -f * dot(state.z, state.x_dot) + dot(mu, state.omega)  # power of −f R e₃ and mu
    size = np.max(np.abs(power))
    with_work_moved = energy_rate(state, Wrench(-f, mu), body)
    printed, corrected = (float(np.max(np.abs(error)) / size) for error in (rate + power, with_work_moved - power))
    return Finding(
        "Sign of the work in (hamprin)",
        "∫δL dt = ∫F·δΓ dt",
        "∫δL dt = −∫F·δΓ dt; otherwise the text's thrust −f R e₃ and moment mu enter (xeqn_txt) and (Rfin) as "
        "+f z and −mu",
        {
            "largest |Ė + P| over 1000 random states, by the printed equations, over the largest |P|": printed,
            "largest |Ė − P| with the sign of the work corrected, over the largest |P|": corrected,
        },
        max(printed, corrected) < 1e-9,
    )


def energy_rate(state: State, wrench: Wrench, of: Vehicle) -> NDArray[np.float64]:
    """Return the rate of energy (n,), W, of the vehicle `of` at `state` (n,) under `wrench`, in the paper's frame."""
    rates, body = equations_of_motion(state, wrench, of, "down"), of.in_frame("down")
    M, m, l, g = of.M, of.m, of.l, of.g
    bob_velocity, bob_acceleration = state.x_dot + l * state.y_dot, rates.x_ddot + l * rates.y_ddot
    kinetic = M * dot(state.x_dot, rates.x_ddot) + m * dot(bob_velocity, bob_acceleration)
    kinetic = kinetic + dot(state.omega, apply(body.I, rates.omega_dot))
    return np.asarray(kinetic - g * (M * state.x_dot + m * bob_velocity)[..., 2])


def thrust_at_rest(runs: Runs) -> Finding:
    """Defect 13: at the equilibrium of (xzero) f = −M l k_p = −(M+m)g, not −M l."""
    body = runs.corrected["1"].vehicle
    ends = {f"f at 6.5 s, experiment {name}, N": run.thrust[-1] for name, run in runs.corrected.items()}
    weight, printed = body.weight, body.M * body.l
    return Finding(
        "Thrust at the equilibrium, above (xzero)",
        "v = k_p e₃, |v| = k_p, f = −Ml",
        "v is f_p, and f = −M l k_p = −(M+m)g",
        {**ends, "−(M+m)g, N": -weight, "−Ml, kg m": -printed},
        all(abs(f + weight) < 0.2 * weight and abs(f) > 10 * printed for f in ends.values()),
    )


def units_of_gain(_: Runs) -> Finding:
    """Defect 14: (kpeqn) adds ‖e₃‖ = 1, dimensionless, to ‖ẏ‖, a rate: k_p depends on the unit of time."""
    seconds, minutes = printed_gain(1.0, 1.0), printed_gain(1.0, 60.0)
    return Finding(
        "Units in (kpeqn)",
        "k_p = (M+m)g/(Ml(‖e₃‖ + ‖ẏ‖))",
        "the sum of a number and a rate needs a scale: ‖e₃‖ + ‖ẏ‖/s₀; time in seconds means s₀ = 1 rad/s",
        {
            "k_p at |ẏ| = 1 rad/s, computed in seconds, 1/s²": seconds,
            "k_p at |ẏ| = 1 rad/s, computed in minutes, 1/s²": minutes,
        },
        bool(abs(seconds / minutes - 1) > 0.1),
    )


def printed_gain(speed: float, unit: float) -> float:
    """Return k_p, 1/s², by (kpeqn) at |ẏ| = `speed` (rad/s), evaluated in a time unit of `unit` seconds."""
    body = vehicle("nayak2018")
    gravity, rate = body.g * unit**2, speed * unit
    return float((body.M + body.m) * gravity / (body.M * body.l * (1 + rate)) / unit**2)


def frames(_: Runs) -> Finding:
    """Defect 15: the notation contradicts the equations on the direction of gravity and on R."""
    row = experiment("1")
    step = 1e-3
    energies = [potential_energy(State(x=height * E3, y=E3), row.vehicle, "down") for height in (step, -step)]
    pull = float((energies[1] - energies[0]) / (2 * step))
    to_world, to_body = row.start.R @ E3, row.start.R.T @ E3
    return Finding(
        "Notation of gravity and R",
        "g: gravity vector in the −e₃ direction; R b_i = e_i",
        "by (pe) gravity acts along +e₃; R maps body to world (as the text states, and z = R e₃ requires): R e_i = b_i",
        {
            "force of gravity along e₃ by (pe), −∂V/∂x₃, N": pull,
            "angle between R(0) e₃ and R(0)ᵀ e₃, degrees": float(np.degrees(np.arccos(dot(to_world, to_body)))),
        },
        bool(pull > 0 and norm(to_world - to_body) > 0.1),
    )


def conclusions(runs: Runs) -> Finding:
    """Defect 16: yaw is not aligned with anything, and the minimum-norm A of (weqn) is not a transport map."""
    row, turned = experiment("1"), np.array([[np.cos(YAW), -np.sin(YAW), 0], [np.sin(YAW), np.cos(YAW), 0], [0, 0, 1]])
    start = row.start
    other = State(
        x=start.x, x_dot=start.x_dot, R=start.R @ turned, omega=turned.T @ start.omega, y=start.y, y_dot=start.y_dot
    )
    run = runs.corrected["1"]
    twin = simulate(row.vehicle, row.law(), other, row.duration, plant=row.plant, rtol=1e-10)
    apart = max(float(np.max(np.abs(run.y - twin.y))), float(np.max(np.abs(run.z - twin.z))))
    relative = run.R[-1].T @ twin.R[-1]
    heading = float(np.abs(np.arctan2(relative[1, 0], relative[0, 0])))
    v_e = np.array([0.3, -0.4, 0.0])  # any nonzero tangent vector
    stretches = np.linalg.svd(np.outer(start.y_dot, v_e) / (v_e @ v_e), compute_uv=False)
    return Finding(
        "Two conclusions: yaw aligned, A a transport map",
        "the yaw orientation is aligned with the upright pendulum; A: T_zS² → T_yS² is a transport map",
        "yaw is not controlled (defect 8); A = ẏ v_eᵀ/|v_e|² has rank one, so it maps a direction of T_zS² to 0",
        {
            "largest difference of y and z, experiment 1 begun 1 rad further in yaw": apart,
            "difference of the headings at 6.5 s, rad": heading,
            "second singular value of A over the first": float(stretches[1] / stretches[0]),
        },
        bool(apart < 1e-6 and heading > 0.5 and stretches[1] < 1e-9 * stretches[0]),
    )
