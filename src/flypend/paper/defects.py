"""Defects 1 to 8 and 12 to 16 of the paper, each shown by a computation; the list of all; the runs they use."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.flight.simulate import simulate
from flypend.flight.trajectory import Trajectory
from flypend.geometry import E3, apply, dot, hat_squared, norm, random_sphere, random_tangent
from flypend.model import State, Vehicle, Wrench, equations_of_motion, potential_energy, rod_tension, vehicle
from flypend.paper import sphere, stability
from flypend.paper.claims import Finding, Runs, largest_rise
from flypend.paper.table import experiment, experiment_names, table

SEED = 2018
FINE = 1e-4  # s
YAW = 1.0  # rad, between the two starts of defect 16


def damping_sign(runs: Runs) -> Finding:
    """Defect 1: ŷ²ẏ = −ẏ, so the damping of (fpeqn) drives the rod."""
    rng = np.random.default_rng(SEED)
    y = random_sphere(rng, (1000,))
    y_dot = random_tangent(rng, y, 3.0)
    identity = np.max(norm(hat_squared(y, y_dot) + y_dot))
    rod_speed = {
        f"|ẏ| at 6.5 s, experiment {name}, no beta, rad/s": norm(run.y_dot)[-1]
        for name, run in runs.without_beta.items()
    }
    corrected = max(norm(run.y_dot)[-1] for run in runs.corrected.values())
    return Finding(
        "Damping sign in (fpeqn)",
        "f_p = k_p e₃ + k_d ẏ, because ŷ²ẏ = ẏ",
        "f_p = k_p e₃ − k_d ẏ, because ŷ²ẏ = −ẏ",
        {
            "largest |ŷ²ẏ + ẏ| over 1000 random tangent ẏ": identity,
            **rod_speed,
            "largest |ẏ| at 6.5 s with −k_d ẏ, rad/s": corrected,
        },
        bool(identity < 1e-12 and min(rod_speed.values()) > 100 and corrected < 1),
    )


def gravity_direction(runs: Runs) -> Finding:
    """Defect 2: gravity acts along +e₃, so the pose y = e₃ hangs."""
    run = runs.corrected["1"]
    vehicle = run.vehicle
    at_target, opposite = (potential_energy(State(y=y), vehicle, "down") for y in (E3, -E3))
    ends = {
        name: rod_tension(run.states[-1], Wrench(run.thrust[-1], run.moment[-1]), vehicle)
        for name, run in runs.corrected.items()
    }
    return Finding(
        "Direction of gravity in (pe) and (xeqn_txt)",
        "y → e₃ is called inverted, with V = −⟨Mgx, e₃⟩ − ⟨mg(x + ly), e₃⟩",
        "y = e₃ is the minimum of V on S²: the bob hangs along gravity and the rod is in tension; inverted is y = −e₃",
        {
            "V(e₃) − V(−e₃), J": at_target - opposite,
            "−2 m g l, J": -2 * vehicle.m * vehicle.g * vehicle.l,
            "least rod tension at 6.5 s over the corrected runs, N (positive pulls)": min(ends.values()),
            "m g, N": vehicle.m * vehicle.g,
        },
        bool(at_target < opposite and min(ends.values()) > 0),
    )


def singular_beta(runs: Runs) -> Finding:
    """Defect 3: the minimum-norm beta drives v_e to zero in finite time, and there beta is undefined."""
    evidence: dict[str, float] = {}
    for label, group in (("as printed", runs.printed), ("damping sign corrected", runs.corrected_singular)):
        evidence |= {f"|v_e| = 0 at, experiment {name}, {label}, s": run.outcome.time for name, run in group.items()}
    moments = [np.max(norm(run.moment)) for run in runs.printed.values()]
    evidence["least of the largest |moment| before it, as printed, N m"] = min(moments)
    outcomes = [run.outcome.status for group in (runs.printed, runs.corrected_singular) for run in group.values()]
    return Finding(
        "beta in (weqn) is singular",
        "beta = −|f_p| Aᵀ(z − z_d) with the minimum-norm A = ẏ v_eᵀ/|v_e|²",
        "drop beta, or regularise it: v_e/(|v_e|² + ε²); neither restores the proof (defect 9)",
        evidence,
        all(status == "singular" for status in outcomes),
    )


def gain_depends_on_speed(runs: Runs) -> Finding:
    """Defect 4: V̇₁ lacks k̇_p(1 − yᵀe₃), and |ẏ| in (kpeqn) has no derivative at 0."""
    evidence: dict[str, float] = {}
    rises, shares = [], []
    for name in runs.corrected:
        run = finely(name)
        V, missing, cross = run.signals["V"], *terms_left_out(run)
        top = int(np.argmax(V - np.minimum.accumulate(V)))
        during = slice(int(np.argmin(V[: top + 1])), top + 1)
        rises.append(largest_rise(V) / V[0])
        shares.append(float(np.trapezoid(missing[during], run.t[during]) / V[0]))
        evidence |= {
            f"largest |k̇_p (1 − yᵀe₃)|, experiment {name}, 1/s³": float(np.max(np.abs(missing))),
            f"largest rise of V, experiment {name}, over V(0)": rises[-1],
            f"of it from k̇_p, experiment {name}": shares[-1],
            f"of it from z ≠ z_d, experiment {name}": float(np.trapezoid(cross[during], run.t[during]) / V[0]),
        }
    fourth = experiment("4")
    verbatim = simulate(fourth.vehicle, fourth.law("printed", speed_floor=0.0), fourth.start, 0.1, plant=fourth.plant)
    evidence["time at which the law to the letter fails in experiment 4, ẏ(0) = 0, s"] = verbatim.outcome.time
    return Finding(
        "k_p in (kpeqn) depends on |ẏ|",
        "dV₁/dt with k_p constant; k_p = (M+m)g/(Ml(1 + |ẏ|))",
        "dV₁/dt has the additional term k̇_p(1 − yᵀe₃); √(|ẏ|² + s²) for |ẏ|, which has no derivative at ẏ = 0",
        evidence,
        bool(
            min(rises) > 0.01
            and min(shares) > 0.01
            and verbatim.outcome.status == "singular"
            and verbatim.outcome.time == 0.0
        ),
    )


def finely(name: str) -> Trajectory:
    """Fly experiment `name` under the corrected law, sampled every 0.1 ms: where ẏ passes 0, k_p has a 0.5 ms kink."""
    row = experiment(name)
    times = np.linspace(0, row.duration, round(row.duration / FINE) + 1)
    return simulate(row.vehicle, row.law(), row.start, row.duration, plant=row.plant, rtol=1e-10, times=times)


def terms_left_out(run: Trajectory) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return k̇_p(1 − yᵀe₃) and |f_p| ẏ·(z − z_d), each (n,), 1/s³: V̇ of a corrected `run` minus the claimed rate."""
    signals, vehicle = run.signals, run.vehicle
    length = -run.thrust / (vehicle.M * vehicle.l)  # |f_p|
    missing = signals["V_1_rate"] + signals["k_p"] * run.y_dot[:, 2] - length * dot(run.y_dot, run.z)
    return missing, signals["V_rate"] - signals["V_rate_claimed"] - missing


def lemma_2(_: Runs) -> Finding:
    """Defect 5: with e₃, Lemma 2 does not track; with φ̈, its force is unbounded near the reference."""
    times = np.linspace(0, 12, 241)
    phi_d = np.array([sphere.circle(t)[0] for t in times])
    start, rate = sphere.near(phi_d[0], 0.3), np.zeros(3)
    true = sphere.track(start, rate, sphere.circle, times)
    printed = sphere.track_as_printed(start, rate, sphere.circle, E3, times)
    reference = sphere.circle(0.0)
    forces = [
        norm(sphere.printed_feedforward_force(sphere.near(reference[0], angle), rate, reference))
        for angle in (1e-2, 1e-4)
    ]
    evidence = {
        "error |φ − φ_d| after 12 s, corrected": norm(true - phi_d)[-1],
        "error |φ − φ_d| after 12 s, e₃ for φ_d": norm(printed - phi_d)[-1],
        "force with φ̈ for φ̈_d, 0.01 rad from φ_d, 1/s²": forces[0],
        "force with φ̈ for φ̈_d, 0.0001 rad from φ_d, 1/s²": forces[1],
    }
    values = list(evidence.values())
    return Finding(
        "Misprints in Lemma 2 (ureqd1)",
        "u = −k_p φ̂²e₃ − k_d v_e + ∇(τφ̇_d), ∇(τφ̇_d) = ⟨φ, φ_d × φ̇_d⟩(φ × φ̇) + (φ_d × φ̈) × φ",
        "φ_d in place of e₃, φ̈_d in place of φ̈",
        evidence,
        bool(values[0] < 1e-6 and values[1] > 0.1 and values[3] > 50 * values[2]),
    )


def experiment_2_start(runs: Runs) -> Finding:
    """Defect 6: ẏ(0) of experiment 2 is not tangent to the sphere."""
    row = table()["experiments"]["2"]
    product = float(dot(row["y"], row["y_dot_printed"]))
    return Finding(
        "Start of experiment 2",
        "y(0) = (1, 0, 1)/√2, ẏ(0) = (0.7, 0, 0.7)",
        "ẏ(0) = (0.7, 0, −0.7) (sign pattern of experiment 1), or 0 (projection)",
        {
            "yᵀẏ at the printed start, 1/s": product,
            "y₃ at 6.5 s, sign pattern": runs.corrected["2"].y[-1, 2],
            "y₃ at 6.5 s, projected": runs.corrected["2-projected"].y[-1, 2],
        },
        product > 0.9,
    )


def position_drifts(runs: Runs) -> Finding:
    """Defect 7: the law does not control position."""
    travel = {
        f"travel along gravity in 6.5 s, experiment {name}, m": run.x[-1, 2] - run.x[0, 2]
        for name, run in runs.corrected.items()
    }
    return Finding(
        "Position is not controlled",
        "zero dynamics ẍ = 0 at the equilibrium",
        "ẋ keeps the value it had on reaching the equilibrium: the vehicle keeps falling",
        {**travel, "least |ẋ| at 6.5 s, m/s": min(norm(run.x_dot)[-1] for run in runs.corrected.values())},
        min(travel.values()) > 10,
    )


def free_component(runs: Runs) -> Finding:
    """Defect 8: (setmu) leaves the third component of I⁻¹mu free; y(t) and z(t) do not depend on it."""
    chosen = experiment("1")
    zero = runs.corrected["1"]
    damped = simulate(
        chosen.vehicle, chosen.law(yaw_damping=3.0), chosen.start, chosen.duration, plant=chosen.plant, rtol=1e-10
    )
    difference = max(np.max(np.abs(zero.y - damped.y)), np.max(np.abs(zero.z - damped.z)))
    return Finding(
        "Third component of I⁻¹mu in (setmu)",
        "{I⁻¹mu}^ e₃ = ..., which leaves the component along e₃ undetermined",
        "state the choice; here the third component of I⁻¹mu is zero (or yaw_damping · ω₃)",
        {
            "largest difference of y and z between two choices": difference,
            "ω₃ at 6.5 s, third component zero, rad/s": zero.omega[-1, 2],
            "ω₃ at 6.5 s, third component 3 ω₃, rad/s": damped.omega[-1, 2],
        },
        bool(difference < 1e-6 and abs(zero.omega[-1, 2]) > 0.1 and abs(damped.omega[-1, 2]) < 0.05),
    )


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


DEFECTS: tuple[Callable[[Runs], Finding], ...] = (
    damping_sign, gravity_direction, singular_beta, gain_depends_on_speed, lemma_2, experiment_2_start, position_drifts,
    free_component, stability.cascade_runs_away, stability.target_vanishes, stability.proof_stops, work_sign,
    thrust_at_rest, units_of_gain, frames, conclusions,
)  # fmt: skip


def findings(runs: Runs) -> list[Finding]:
    """Return all defects of the paper, in the order of docs/paper/errata.md, computed on `runs`."""
    return [defect(runs) for defect in DEFECTS]


def fly_all(progress: Callable[[str], Any] = lambda _: None) -> Runs:
    """Fly every experiment under the four laws; `progress` is called with the name of each run before it starts.

    rtol is 1e-10, but 1e-8 for the runs without beta: they spin up to 2000 rad/s, and only the magnitude matters.
    """

    def group(label: str, law: str, rtol: float = 1e-10, **options: Any) -> dict[str, Trajectory]:
        out = {}
        for name in experiment_names():
            progress(f"experiment {name}, {label}")
            row = experiment(name)
            chosen = row.law(law, **options)
            out[name] = simulate(row.vehicle, chosen, row.start, row.duration, plant=row.plant, rtol=rtol)
        return out

    return Runs(
        printed=group("printed", "printed"),
        without_beta=group("printed without beta", "printed", rtol=1e-8, beta="off"),
        corrected=group("corrected", "corrected"),
        corrected_singular=group("corrected with the printed beta", "corrected", beta="regularized", beta_floor=0.0),
    )
