"""Defects 9 to 11 of the paper, in its stability argument: where it fails, and flights that show it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from flypend.flight.simulate import simulate
from flypend.flight.trajectory import Trajectory
from flypend.geometry import E1, E3, dot, norm, scale
from flypend.laws import corrected
from flypend.laws.linearise import linearise
from flypend.model import State, Wrench, equations_of_motion, vehicle
from flypend.paper import sphere
from flypend.paper.claims import Finding, Runs

# Members of State.random(default_rng(2024), 2000), flipped into the paper's frame, that run away.
RUNAWAYS = (446, 1990)
# Rates, rad/s, of the great circles that Lemma 2 is to track, and for how long, s.
CIRCLES, FOLLOWED = (2.0, 20.0, 60.0), 2.0


def runaway_starts() -> State:
    """Return the 2,000 random starts, in the paper's frame, that `RUNAWAYS` indexes."""
    return State.random(np.random.default_rng(2024), 2000).flipped()


def direction_cosine(run: Trajectory) -> NDArray[np.float64]:
    """Return c = z·z_d (n,) along a `run` of the corrected law."""
    k_p = np.asarray(run.signals["k_p"])
    f_p = k_p[:, None] * E3 - run.gains["k_d"] * run.y_dot
    return np.asarray(dot(run.z, scale(1 / norm(f_p), f_p)))


def cascade_runs_away(_: Runs) -> Finding:
    """Defect 9: without beta some starts run away: c = z·z_d settles below 0, and |ẏ| grows like e^(−k_d c t)."""
    evidence: dict[str, float] = {}
    shown = True
    starts, last = runaway_starts(), 12.0
    for member in RUNAWAYS:
        times = np.linspace(0, last, 121)
        run = simulate(vehicle("nayak2018"), corrected(), starts[member], last, plant="ideal", rtol=1e-10, times=times)
        c, speed = direction_cosine(run), norm(run.y_dot)
        growth, predicted = np.log(speed[-1] / speed[-11]), -run.gains["k_d"] * np.mean(c[-11:])
        product = speed * run.signals["velocity_error"]
        evidence |= {
            f"|ẏ| at 12 s, start {member}, rad/s": speed[-1],
            f"|ẏ| at 0 s, start {member}, rad/s": speed[0],
            f"z·z_d at 12 s, start {member}": c[-1],
            f"growth of ln |ẏ| in the last second, start {member}, 1/s": growth,
            f"−k_d z·z_d, mean of that second, start {member}, 1/s": predicted,
            f"|ẏ| |v_e| at 11 s, start {member}, 1/s²": product[-11],
            f"|ẏ| |v_e| at 12 s, start {member}, 1/s²": product[-1],
        }
        shown = shown and bool(speed[-1] > 20 * speed[0] and c[-1] < 0 and abs(growth - predicted) < 0.01 * predicted)
    errors = [_distance_followed(rate) for rate in CIRCLES]
    evidence |= {
        f"Lemma 2: error after {FOLLOWED:g} s on a great circle at {rate:g} rad/s": error
        for rate, error in zip(CIRCLES, errors, strict=True)
    }
    return Finding(
        "Without beta the cascade runs away from some starts",
        "Lemma 2 tracks any smooth bounded φ_d, so that (ddtynew) holds eventually",
        "the direction error decays only at the rate k_1 k_2/(k_2² + Ω²), Ω = ω_d·z: z never catches a fast z_d, and "
        "while z·z_d < 0 the rod is driven. Cure: damp z − z_d directly, and bound k_d ẏ",
        evidence,
        shown and errors[0] < 0.1 < 0.5 < errors[-1],
    )


def _distance_followed(rate: float) -> float:
    """|φ − φ_d| after `FOLLOWED` s of Lemma 2, corrected: φ_d on the equator at `rate` (rad/s), φ(0) about 70° off it.

    φ starts with the angular velocity of the reference.
    """
    start = np.array([np.cos(1.2), 0.0, np.sin(1.2)])
    times = np.array([0.0, FOLLOWED])
    reached = sphere.track(start, np.cross(rate * E3, start), lambda t: sphere.circle(t, 0.0, rate), times)
    return float(norm(reached[-1] - sphere.circle(FOLLOWED, 0.0, rate)[0]))


def target_vanishes(runs: Runs) -> Finding:
    """Defect 10: f_p = 0 at y·e₃ = 0, ẏ = s* e₃; there z_d is undefined and the thrust is 0."""
    run = runs.corrected["4"]
    full = run.vehicle.weight / (run.vehicle.M * run.vehicle.l)
    speed = (np.sqrt(1 + 4 * full) - 1) / 2  # k_d s (1 + s) = (M+m)g/(Ml), k_d = 1/s
    near = {ahead: _begin(speed + ahead) for ahead in (-1e-4, 1e-4, 1e-2)}
    turn = np.degrees(np.arccos(np.clip(dot(*(_target(full, speed + ahead) for ahead in (-1e-4, 1e-4))), -1, 1)))
    weight = run.vehicle.weight
    least = min(float(np.min(np.abs(flown.thrust))) for flown in runs.corrected.values())
    return Finding(
        "f_p vanishes, so z_d in (zdes) is undefined",
        "z_d = f_p/|f_p|, for all (y, ẏ)",
        "f_p = k_p e₃ − k_d ẏ is 0 at ẏ = s* e₃, k_d s*(1 + s*) = (M+m)g/(Ml) (as printed: at −s* e₃). "
        "Cure: keep |k_d ẏ| below a constant k_p",
        {
            "s*, rad/s": speed,
            "z_d turns, from 0.0001 rad/s below s* to 0.0001 above, degrees": float(turn),
            "|f|/((M+m)g) at s* + 0.0001 rad/s": abs(near[1e-4].thrust[0]) / weight,
            "|moment| at s* + 0.01 rad/s, N m": float(norm(near[1e-2].moment[0])),
            "|moment| at s* + 0.0001 rad/s, N m": float(norm(near[1e-4].moment[0])),
            "least |f_p| over the corrected runs, 1/s²": least / (run.vehicle.M * run.vehicle.l),
        },
        bool(
            turn > 179
            and abs(near[1e-4].thrust[0]) < 1e-3 * weight
            and norm(near[1e-4].moment[0]) > 50 * norm(near[1e-2].moment[0])
        ),
    )


def _target(full: float, speed: float) -> NDArray[np.float64]:
    """z_d (3,) at ẏ = `speed` e₃ for k_p = `full`/(1 + |ẏ|), k_d = 1, without a speed floor."""
    f_p = full / (1 + abs(speed)) * E3 - speed * E3
    return np.asarray(f_p / norm(f_p))


def _begin(speed: float) -> Trajectory:
    """Fly the corrected law for 1 µs from y = e₁, ẏ = `speed` e₃; its speed floor is small against |f_p|."""
    law, tilted = corrected(speed_floor=1e-6), np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]])
    return simulate(vehicle("nayak2018"), law, State(y=E1, y_dot=speed * E3, R=tilted), 1e-6, plant="ideal")


def proof_stops(_: Runs) -> Finding:
    """Defect 11: V̇ ≤ 0 alone proves no limit; the closed loop has four equilibria where the claim allows one."""
    evidence: dict[str, float] = {}
    upside_down = np.diag([1.0, -1.0, -1.0])
    growing: list[int] = []
    for rod in (1, -1):
        for axis in (1, -1):
            at = State(y=rod * E3, R=np.eye(3) if axis == 1 else upside_down)
            name = f"y = {'−' if rod < 0 else ''}e₃, z = {'−' if axis < 0 else ''}e₃"
            modes = linearise(corrected(), vehicle("nayak2018"), at).eigenvalues  # raises unless `at` is an equilibrium
            growing.append(int(np.sum(modes.real > 1e-6)))
            evidence[f"growing modes at {name}"] = growing[-1]
    level = simulate(
        vehicle("nayak2018"), corrected(), State(y=E1), 1e-6, plant="ideal"
    )  # ẏ = 0, z = z_d = e₃, v_e = 0
    moving = equations_of_motion(level.states[0], Wrench(level.thrust[0], level.moment[0]), level.vehicle, "down")
    evidence["V̇ claimed at y = e₁, ẏ = 0, z = z_d, v_e = 0, 1/s³"] = float(level.signals["V_rate_claimed"][0])
    evidence["|ÿ| there, 1/s²"] = float(norm(moving.y_ddot))
    return Finding(
        "The proof ends with V̇ ≤ 0",
        "V̇ = −k_d|ẏ|² − k_2|v_e|² ≤ 0, hence y → e₃ and z → e₃, without exception",
        "V̇ = 0 wherever ẏ = 0 and v_e = 0, so an invariance argument is missing. So is an exceptional set: "
        "y = ±e₃, z = ±z_d are four equilibria, and no continuous law stabilises a point of S² globally",
        evidence,
        growing[0] == 0
        and all(count > 0 for count in growing[1:])
        and abs(evidence["V̇ claimed at y = e₁, ẏ = 0, z = z_d, v_e = 0, 1/s³"]) < 1e-12 < evidence["|ÿ| there, 1/s²"],
    )
