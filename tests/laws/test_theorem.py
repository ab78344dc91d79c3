"""Theorems A, B and D: the identity for V̇ in ball arithmetic, the domain, the equilibria and the guarantees."""

from copy import copy
from dataclasses import replace
from functools import cache, partial
from types import SimpleNamespace

import casadi as ca
import numpy as np
import pytest
from balls import RateCheck

import flypend as fp
from benchmarks.withstood import withstood
from flypend.geometry import E3, norm, rotation_from_vector
from flypend.laws import references
from flypend.laws.almost_global_bounds import slopes
from flypend.laws.almost_global_gains import damper, largest_descent, spring
from flypend.laws.guarantee import least_distance, rate_bound
from flypend.laws.repaired import control_repaired, stiffness
from flypend.laws.step import Step

PAPERS, HEHN = fp.vehicle("nayak2018"), fp.vehicle("hehn2011")
UPSIDE_DOWN = np.diag([1.0, -1.0, -1.0])
LAWS = {
    "repaired": (fp.laws.repaired(), PAPERS),
    "almost_global": (fp.laws.almost_global(), HEHN),
    "almost_global on a circle": (fp.laws.almost_global(references.circle(0.5, 1.0)), HEHN),
    "almost_global_lag": (fp.laws.almost_global_lag(), HEHN),
}
SOLVED = ("repaired", "almost_global")
NARROW = 1e-25  # relative width of a ball that says something; those here are 1e-50


@cache
def rate_check(name):
    return RateCheck(*LAWS[name], lag=name == "almost_global_lag")


@pytest.mark.parametrize(
    ("name", "states"),
    [("repaired", 300), ("almost_global", 100), ("almost_global on a circle", 2), ("almost_global_lag", 20)],
)
def test_the_claimed_rate_of_v_is_the_exact_one(name, states):
    check, rng = rate_check(name), np.random.default_rng(2026)
    for _ in range(states):
        ball = check(rng)
        assert ball.contains(0)
        assert ball.rad() < NARROW


@pytest.mark.slow
@pytest.mark.parametrize("name", LAWS)
def test_the_claimed_rate_of_v_is_the_exact_one_at_ten_thousand_states(name):
    test_the_claimed_rate_of_v_is_the_exact_one(name, 10_000)


FALSE = [fp.laws.printed(), fp.laws.printed(beta="off"), fp.laws.corrected(), fp.laws.corrected(beta="regularized")]
UNCANCELLED = replace(fp.laws.repaired(), control=partial(control_repaired, cancelled=0.0))


@pytest.mark.parametrize(
    "law",
    [
        fp.laws.printed(),
        fp.laws.printed(beta="off"),
        fp.laws.corrected(),
        fp.laws.corrected(beta="regularized"),
        UNCANCELLED,
    ],
)
def test_the_balls_tell_a_claim_that_is_false(law):
    check, rng = RateCheck(law, PAPERS), np.random.default_rng(1)
    for _ in range(20):
        ball = check(rng)
        assert not ball.contains(0)
        assert ball.rad() < NARROW


def test_the_balls_tell_a_lag_that_the_law_does_not_know():
    # The law believes another lag than that of its rotors: 1 % more.
    def mistaken(t, state, vehicle, k, *, path, acting):
        told = copy(vehicle)
        object.__setattr__(told, "rotor_lag", 1.01 * vehicle.rotor_lag)
        return fp.laws.almost_global_lag().control(t, state, told, k, path=path, acting=acting)

    law, rng = replace(fp.laws.almost_global_lag(), control=mistaken), np.random.default_rng(1)
    check = RateCheck(law, HEHN, lag=True)
    for _ in range(3):
        ball = check(rng)
        assert not ball.contains(0)
        assert ball.rad() < NARROW


@pytest.mark.parametrize("name", SOLVED)
def test_v_falls_at_the_claimed_rate_along_a_flight(name):
    law, vehicle = LAWS[name]
    start = fp.State.random(np.random.default_rng(5), max_omega=12, max_y_dot=12, max_x_dot=5)
    h = 1e-3
    times = np.arange(0.0, 3.0, h)
    run = fp.simulate(vehicle, law, start, 3.0, plant="ideal", rtol=1e-12, times=times)
    V, claimed = run.signals["V"], run.signals["V_rate_claimed"]
    slope = (V[:-4] - 8 * V[1:-3] + 8 * V[3:-1] - V[4:]) / (12 * h)
    # Five points: an error of h⁴/30 V⁗, with rates of up to some 40 /s; the largest |V̇| is the scale.
    np.testing.assert_allclose(slope, claimed[2:-2], rtol=0, atol=1e-5 * np.max(np.abs(claimed)))
    assert np.all(claimed <= 0)
    assert np.all(np.diff(V) <= 0)
    terms = [run.signals[key] for key in run.signals if key.startswith("V_") and key[2:].isdigit()]
    np.testing.assert_allclose(sum(terms), V, rtol=1e-12)


@pytest.mark.parametrize("engine", ["kernel", "scipy"])
@pytest.mark.parametrize(
    ("name", "start", "told"),
    [
        ("repaired", fp.State(y=(1, 0, 0), R=UPSIDE_DOWN), "outside the domain of Theorem A: z = -z_d"),
        ("almost_global", fp.State(y=(0, 0, 1), R=UPSIDE_DOWN), "outside the domain of Theorem B: y = -d or z = -z_d"),
    ],
)
def test_a_start_on_the_exceptional_set_is_named_in_one_line(name, start, told, engine):
    law, vehicle = LAWS[name]
    run = fp.simulate(vehicle, law, start, 1.0, plant="ideal", engine=engine)
    assert (run.outcome.status, run.outcome.time) == ("singular", 0.0)
    assert run.outcome.reason.startswith(told)
    assert "\n" not in run.outcome.reason


def test_the_rod_opposite_to_its_target_is_named_although_no_axis_is_defined_there():
    law = fp.laws.almost_global(shear=0.0)  # without it, −d is the rod that hangs at rest
    for engine in ("kernel", "scipy"):
        run = fp.simulate(HEHN, law, fp.State(y=-E3), 1.0, plant="ideal", engine=engine)
        assert run.outcome.reason.startswith("outside the domain of Theorem B")
    assert law.bind(HEHN).guarantee(fp.State(y=-E3)).reason == "outside the domain: y = -d"
    assert fp.laws.almost_global().bind(HEHN).guarantee(fp.State(y=-E3)).covered


@pytest.mark.parametrize("name", SOLVED)
@pytest.mark.parametrize("about", [(1, 0, 0), (0.6, 0.8, 0)])
def test_starts_beside_the_exceptional_set_converge(name, about):
    law, vehicle = LAWS[name]
    R = rotation_from_vector((np.pi - 1e-3) * np.array(about, dtype=float))
    rod = (1, 0, 0) if name == "repaired" else (0, 0, 1)
    run = fp.simulate(vehicle, law, fp.State(y=rod, R=R), 15.0, plant="ideal")
    assert run.outcome.status == "completed"
    assert norm(run.y[-1] - E3) < 1e-3
    assert norm(run.z[-1] - E3) < 1e-3
    assert np.all(np.diff(run.signals["V"]) <= 1e-9 * run.signals["V"][0])


def test_theorem_a_has_one_sink_and_one_saddle():
    law = fp.laws.repaired()
    rest = fp.linearise(law, PAPERS, fp.State(y=E3)).without("x", "x_dot", "theta_3")
    assert np.all(rest.eigenvalues.real < -0.5)
    top = fp.linearise(law, PAPERS, fp.State(y=-E3)).without("x", "x_dot", "theta_3", "omega_3")
    assert len(top.eigenvalues) == 8
    assert np.sum(top.eigenvalues.real > 1e-6) == 2
    assert np.sum(top.eigenvalues.real < -1e-6) == 6


@pytest.mark.parametrize("name", ["hehn2011", "crazyflie"])
def test_theorem_b_has_a_sink_at_hover_on_every_vehicle(name):
    found = fp.linearise(fp.laws.almost_global(), fp.vehicle(name))
    assert found.symmetries == ("theta_3",)
    assert found.spectral_abscissa < -0.5


def test_the_matrix_at_rest_obeys_the_lyapunov_equation_of_the_proof():
    # Per horizontal axis: η̈ = −s k_p η − k_d η̇ − k_p ε, ε̇ = −k_e ε + (k_p/k) η̇ − ζ, ζ̇ = (k/ρ) ε − k_w ζ.
    gains = fp.laws.repaired().gains_for(PAPERS)
    k_p, rho = stiffness(PAPERS), gains["axis_weight"]
    k, k_e, k_w, k_d = rho * gains["k_1"], gains["k_e"], gains["k_2"], gains["k_d"]
    for s, state in ((1, fp.State(y=E3)), (-1, fp.State(y=-E3))):
        A = np.array([[0, 1, 0, 0], [-s * k_p, -k_d, -k_p, 0], [0, k_p / k, -k_e, -1], [0, 0, k / rho, -k_w]])
        P = np.diag([s * k_p, 1, k, rho])
        np.testing.assert_allclose(A.T @ P + P @ A, -2 * np.diag([0, k_d, k * k_e, rho * k_w]), atol=1e-12)
        own = np.sort_complex(np.repeat(np.linalg.eigvals(A), 2))
        found = fp.linearise(fp.laws.repaired(), PAPERS, state).without("x", "x_dot", "theta_3", "omega_3")
        np.testing.assert_allclose(np.sort_complex(found.eigenvalues.round(6)), own.round(6), atol=1e-5)


def test_the_demand_on_the_bob_must_stay_upward():
    with pytest.raises(
        fp.InputError, match=r"^gains: expected \|shear\| k_x L .* < 9\.81 m/s², gravity, got 1\d\.\d+ m/s²$"
    ):
        fp.laws.almost_global(height_reach=0.9).bind(HEHN)


def test_without_gravity_neither_theorem_says_anything():
    for law in (fp.laws.repaired(), fp.laws.almost_global()):
        with pytest.raises(fp.InputError, match=r"^vehicle\.gravity: expected gravity > 0"):
            law.bind(HEHN.replace(gravity=0.0))


@pytest.mark.parametrize("name", SOLVED)
def test_what_is_guaranteed_of_a_start_holds_along_its_flight(name):
    law, vehicle = LAWS[name]
    bound = law.bind(vehicle)
    for seed in range(6):
        start = fp.State.random(np.random.default_rng(seed), max_omega=8, max_y_dot=8, max_x_dot=3)
        told = bound.guarantee(start)
        run = fp.simulate(vehicle, bound, start, 6.0, plant="ideal")
        assert told.covered
        assert pytest.approx(run.signals["V"][0], rel=1e-12) == told.V
        low, high = told.thrust
        assert 0 <= low <= np.min(np.abs(run.thrust))
        assert np.max(np.abs(run.thrust)) <= high < np.inf
        assert np.max(norm(run.y_dot)) <= told.rod_rate < np.inf
        assert np.max(norm(run.x_dot)) <= told.speed
        assert np.max(norm(run.x)) <= told.excursion
        assert any("without limits" in assumption for assumption in told.assumes)
        # The bounds on the way: no cosine comes nearer to −1, and the axis turns no faster.
        if name == "repaired":
            step = Step(*(bound.gains[key] for key in ("k_1", "k_e", "k_2", "axis_weight", "axis_barrier")))
            assert np.min(1 + run.signals["axis_cosine"]) >= least_distance(told.V, step) * (1 - 1e-9)


def test_the_least_thrust_guaranteed_is_not_lost_to_cancellation():
    # ς > 0 for c > −1, so f ≥ ς ς_y (M+m) a_min > 0 however close to its antipodes a start with this V may come.
    bound = fp.laws.almost_global().bind(HEHN)
    starts = fp.random_starts(200, 2024)
    assert all(bound.guarantee(start).thrust[0] > 0 for start in (fp.State(y=-E3), *(starts[i] for i in range(200))))


@pytest.mark.parametrize("seed", range(4))
def test_no_slope_of_the_outer_loop_is_steeper_than_its_bound(seed):
    """First derivatives as matrices, second ones along a direction; near 0, where slopes are steepest, and anywhere."""
    rng = np.random.default_rng(seed)
    names = [
        *(f"{of}_{name}" for of in ("position", "height") for name in ("stiffness", "reach", "damping", "speed")),
        "fall_damping", "fall_speed",
    ]  # fmt: skip
    k = SimpleNamespace(**dict(zip(names, rng.uniform(0.5, 2.0, len(names)), strict=True)), shear=rng.uniform(0.8, 1.5))
    at, way, found = ca.SX.sym("e", 3), ca.SX.sym("d", 3), slopes(k)
    for value, first, second in ((spring(at, k)[1], found.p, found.bend_p), (damper(at, k), found.v, found.bend_v)):
        slope = ca.jacobian(value, at)
        bend = ca.jtimes(ca.mtimes(slope, way), at, way)
        both = ca.Function("slopes", [at, way], [slope, bend])
        steepest = sharpest = 0.0
        for size in (1e-3, 0.3, 1.0, 10.0):
            for _ in range(50):
                e, d = size * rng.standard_normal(3), rng.standard_normal(3)
                matrix, along = (np.array(part) for part in both(e, d / np.linalg.norm(d)))
                steepest = max(steepest, np.linalg.norm(matrix, 2))
                sharpest = max(sharpest, np.linalg.norm(along))
        assert 0.3 * first < steepest <= first
        assert 0.05 * second < sharpest <= second


def test_a_barrier_thinner_than_doubles_can_hold_bounds_nothing():
    told = fp.laws.almost_global().bind(HEHN).guarantee(fp.State(x_dot=(600, 0, 0), y=E3))
    assert (told.covered, told.thrust) == (True, (0.0, np.inf))
    for weight in (1e-2, 1e-4):
        with pytest.raises(fp.InputError, match=r"^level"):
            withstood(fp.laws.repaired(axis_weight=weight).bind(PAPERS), 10.0)


def test_theorem_a_names_its_exceptions_only_where_there_are_some():
    bound = fp.laws.repaired().bind(PAPERS)
    low, high = bound.guarantee(fp.State(y=(1, 0, 0))), bound.guarantee(fp.State(y=-E3, y_dot=(1, 0, 0)))
    edge = 2 * stiffness(PAPERS)
    assert low.V < edge <= high.V
    assert low.exceptions == ""
    assert "codimension 2" in high.exceptions
    assert low.excursion == low.speed == np.inf  # position is not controlled


def test_a_law_without_a_theorem_guarantees_nothing():
    with pytest.raises(fp.InputError, match=r"^law: expected one with a theorem"):
        fp.laws.inverted().bind(HEHN).guarantee(fp.State(y=E3))
    with pytest.raises(fp.InputError, match=r"^start: expected a single state"):
        fp.laws.repaired().bind(PAPERS).guarantee(fp.State.random(np.random.default_rng(0), 3))


@pytest.mark.parametrize(
    "change",
    [{"mount": "hub"}, {"mount": "cup"}, {"pivot_offset": (0.0, 0.0, 0.01)}, {"pivot_damping": 1e-3},
     {"pivot_friction": 1e-3}, {"rod_inertia": 1e-3, "rod_spin": 5.0, "rod_spin_inertia": 1e-4}],
    ids=lambda change: next(iter(change)),
)  # fmt: skip
@pytest.mark.parametrize("law", [fp.laws.repaired, fp.laws.almost_global], ids=lambda law: law.__name__)
def test_a_theorem_covers_no_vehicle_that_it_does_not_model(law, change):
    start = fp.State(y=(0.6, 0.0, 0.8))
    assert law().bind(HEHN).guarantee(start).covered
    assert law().bind(HEHN.replace(rod_inertia=1e-3)).guarantee(start).covered  # it moves like a bob and two masses
    refused = law().bind(HEHN.replace(**change)).guarantee(start)
    assert not refused.covered
    assert refused.reason.startswith("outside the theorem")
    assert refused.thrust == (0.0, np.inf)


def test_a_law_moved_along_a_path_has_no_theorem():
    law = fp.laws.almost_global().bind(HEHN)
    assert law.guarantee(fp.State(y=-E3)).covered
    with pytest.raises(fp.InputError, match=r"^law: "):
        law.along(law.path).guarantee(fp.State(y=-E3))


@pytest.mark.parametrize("barrier", [0.05, 0.25, 0.5, 0.9, 1.0])
def test_the_bound_on_the_wanted_rate_is_the_least_one(barrier):
    # |χ(G·φ)e − (1+c)P_φG| ≤ |G|√(2(1+c)) for χ ≤ 1; divided by (1−ε)(1+c) + 2ε it is largest where κ says.
    step = Step(1.0, 0.0, 1.0, 1.0, barrier)
    s = np.linspace(1e-6, 2, 200_001)
    largest = np.max(np.sqrt(2 * s) / ((1 - barrier) * s + 2 * barrier))
    assert rate_bound(0.0, 0.0, 1.0, 1.0, step) == pytest.approx(largest, rel=1e-6)


def test_on_a_circle_all_errors_vanish():
    # Radius 0.4 m at 1.2 rad/s: the rod leans; `bob_path` gives the bob's path, which the bob follows exactly.
    law = fp.laws.almost_global(references.circle(0.4, 1.2))
    start = fp.State.random(np.random.default_rng(11))
    run = fp.simulate(HEHN, law, start, 15.0, plant="ideal", engine="scipy")  # compiling this takes longer
    assert np.all(np.diff(run.signals["V"]) <= 1e-9 * run.signals["V"][0])
    assert run.signals["V"][-1] < 1e-10
    assert (
        norm(run.x - run.x_ref)[-1] < 1e-3
    )  # the path is exact to the square of (1.2 rad/s)² l/g = 0.08, 4 mm of lean


@pytest.mark.parametrize("name", SOLVED)
def test_the_law_turns_with_the_world(name):
    # Turning start and vehicle about the vertical turns the flight; for B only without the shear along e₁.
    law, vehicle = LAWS[name]
    law = law if name == "repaired" else fp.laws.almost_global(shear=0.0)
    start = fp.State.random(np.random.default_rng(3))
    turn = rotation_from_vector((0, 0, 0.7))
    fields = {key: turn @ getattr(start, key) for key in ("x", "x_dot", "R", "y", "y_dot")}
    one = fp.simulate(vehicle, law, start, 1.0, plant="ideal", rtol=1e-11)
    two = fp.simulate(vehicle, law, fp.State(**fields, omega=start.omega), 1.0, plant="ideal", rtol=1e-11)
    np.testing.assert_allclose(two.x, one.x @ turn.T, atol=1e-7)
    np.testing.assert_allclose(two.y, one.y @ turn.T, atol=1e-7)


def test_a_reference_that_falls_too_fast_is_refused_and_told_when():
    """Condition (C), over more than the reference's period; a vertical path of the pivot is one of the bob."""
    allowed = HEHN.g - largest_descent(fp.laws.almost_global().bind(HEHN).gains)
    assert 0.5 < allowed < HEHN.g

    def up_and_down(fall):
        """Up and down once in 20 s, with a largest downward acceleration of `fall` at 5 s."""
        w = 2 * np.pi / 20
        return lambda t: ca.vertcat(0, 0, fall / w**2 * ca.sin(w * t))

    start = fp.State(y=(0.6, 0, -0.8))
    for share, covered in ((0.99, True), (1.01, False)):
        law = fp.laws.almost_global(up_and_down(share * allowed)).bind(HEHN)
        found = law.guarantee(start)
        assert found.covered == covered
        assert ("at 5 s" in found.reason) != covered
    assert fp.laws.almost_global(references.circle(1.0, 3.0)).bind(HEHN).guarantee(start).covered  # level
