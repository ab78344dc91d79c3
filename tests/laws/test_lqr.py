"""The regulator: optimal by definition, stable by linearisation, good near hover and no further."""

import os
import subprocess
import sys

import numpy as np
import pytest
from scipy.linalg import solve_continuous_lyapunov

import flypend as fp
from flypend.flight.metrics import metrics
from flypend.laws.linearise import COORDINATES, linearise, open_loop, retract
from flypend.laws.lqr import gain_matrix, weights

HEHN, NAYAK = fp.vehicle("hehn2011"), fp.vehicle("nayak2018")
UPRIGHT = fp.State(y=(0, 0, 1))
YAW = COORDINATES.index("theta_3")
DEVIATIONS = fp.laws.lqr().values


def hover_model(vehicle):
    return open_loop(vehicle, "up", UPRIGHT, fp.Wrench(vehicle.weight, np.zeros(3)))


def tilted(angle, heading=0.0, which="both", azimuth=0.7):
    """At rest at the reference: rod, thrust axis or both `angle` off upright, the vehicle headed anywhere."""
    lean = np.array([np.sin(angle) * np.cos(azimuth), np.sin(angle) * np.sin(azimuth), np.cos(angle)])
    axis = np.array([-np.sin(azimuth), np.cos(azimuth), 0]) * np.sin(angle / 2)
    turn = fp.geometry.rotation_from_quat_xyzw([*axis, np.cos(angle / 2)])
    yaw = fp.geometry.rotation_from_quat_xyzw([0, 0, np.sin(heading / 2), np.cos(heading / 2)])
    return fp.State(
        R=(turn if which in ("both", "axis") else np.eye(3)) @ yaw, y=lean if which in ("both", "rod") else (0, 0, 1)
    )


# The gain matrix -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("vehicle", [HEHN, NAYAK], ids=lambda vehicle: vehicle.name)
def test_the_gain_solves_the_riccati_equation(vehicle):
    # P is rebuilt from K alone, as the cost of flying with K: (A−BK)ᵀP + P(A−BK) + Q + KᵀRK = 0. With K = R⁻¹BᵀP that
    # is the Riccati equation, of which no other solution stabilises.
    keep = np.delete(np.arange(16), YAW)
    A, B = hover_model(vehicle)
    Q, R = weights(vehicle, DEVIATIONS)
    K = gain_matrix(vehicle, DEVIATIONS)
    np.testing.assert_array_equal(K[:, YAW], 0)
    A, B, Q, K = A[np.ix_(keep, keep)], B[keep], Q[np.ix_(keep, keep)], K[:, keep]
    P = solve_continuous_lyapunov((A - B @ K).T, -(Q + K.T @ R @ K))
    residual = A.T @ P + P @ A - P @ B @ np.linalg.solve(R, B.T @ P) + Q
    # Three solutions of systems of 120 unknowns with condition 1e4 to 1e6.
    assert np.max(np.abs(residual)) < 1e-8 * np.max(np.abs(P @ B @ K))
    assert np.min(np.linalg.eigvalsh(P)) > 0
    assert np.max(np.linalg.eigvals(A - B @ K).real) < 0


def test_the_weights_are_inverse_squares_of_the_deviations():
    given = {**DEVIATIONS, "rod_error": 0.5, "thrust_deviation": 0.25, "moment_deviation": 0.1}
    Q, R = weights(HEHN, given)
    assert Q[COORDINATES.index("y_2"), COORDINATES.index("y_2")] == pytest.approx(4.0)
    weight = 0.55 * 9.81
    roll, yaw = 0.1 * weight * 0.17, 0.1 * weight * 0.016
    np.testing.assert_allclose(np.diag(R), [1 / (0.25 * weight) ** 2, 1 / roll**2, 1 / roll**2, 1 / yaw**2])
    assert np.count_nonzero(Q - np.diag(np.diag(Q))) == 0


def test_a_common_factor_of_all_deviations_changes_nothing():
    doubled = {name: 2 * value for name, value in DEVIATIONS.items()}
    K = gain_matrix(HEHN, DEVIATIONS)
    np.testing.assert_allclose(gain_matrix(HEHN, doubled), K, rtol=1e-6, atol=1e-9 * np.max(np.abs(K)))


def test_a_dearer_error_is_paid_for_with_a_higher_gain():
    before, after = (abs(gain_matrix(HEHN, DEVIATIONS | {"position_error": e})[2, 0]) for e in (1.0, 0.5))
    assert after > 1.2 * before


# The closed loop -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("heading", [0.0, 2.0])
@pytest.mark.parametrize("vehicle", [HEHN, NAYAK], ids=lambda vehicle: vehicle.name)
def test_the_wrapped_law_has_the_linearisation_it_was_made_from(vehicle, heading):
    A, B = hover_model(vehicle)
    found = linearise(fp.laws.lqr(), vehicle, tilted(0.0, heading))
    assert found.stable
    assert found.symmetries == ("theta_3",)
    # Turn the horizontal plane to the heading, in which x, ẋ, y and ẏ are seen, and compare with A − BK.
    c, s = np.cos(heading), np.sin(heading)
    T = np.eye(16)
    for i in (0, 3, 12, 14):
        T[i : i + 2, i : i + 2] = [[c, s], [-s, c]]
    K = gain_matrix(vehicle, DEVIATIONS)
    np.testing.assert_allclose(T @ found.A @ T.T, A - B @ K, rtol=0, atol=1e-11 * np.max(np.abs(A - B @ K)))


def test_a_small_perturbation_decays_at_the_slowest_rate():
    law = fp.laws.lqr()
    found = linearise(law, HEHN)
    values, vectors = np.linalg.eig(found.without("theta_3").A)
    worst = np.argmax(values.real)
    xi = np.insert(1e-4 * vectors[:, worst].real, YAW, 0.0)
    # Over a period of this mode, if it oscillates, it comes back smaller by its decay alone.
    period = 2 * np.pi / abs(values[worst].imag) if values[worst].imag else 1.0
    run = fp.simulate(HEHN, law, retract(found.at, xi), period, rtol=1e-12, plant="ideal")
    shrunk = run.states[-1].x @ run.states[0].x / (run.states[0].x @ run.states[0].x)
    assert shrunk == pytest.approx(np.exp(values[worst].real * period), rel=1e-3)  # 1e-4 times curvature


@pytest.mark.parametrize("plant", ["ideal", "rotors"])
@pytest.mark.parametrize("which", ["rod", "axis", "both"])
def test_a_small_tilt_is_righted(plant, which):
    for angle, heading in ((0.15, 0.0), (0.3, 2.5)):
        run = fp.simulate(HEHN, fp.laws.lqr(), tilted(angle, heading, which), 10, plant=plant, rtol=1e-6)
        assert metrics(run).success, (plant, which, angle, heading)


def test_the_heading_does_not_matter():
    straight, turned = (
        fp.simulate(HEHN, fp.laws.lqr(), tilted(0.3, heading), 2.0, plant="ideal") for heading in (0.0, 2.5)
    )
    # The inertia is that of a symmetric top, so the motion of rod and thrust axis is the same; runs are good to 1e-9.
    for name in ("x", "y", "z"):
        np.testing.assert_allclose(getattr(turned, name), getattr(straight, name), rtol=0, atol=1e-6)


@pytest.mark.parametrize("plant", ["ideal", "rotors"])
def test_a_hanging_start_stays_hanging(plant):
    # Hanging at rest has no error in the plane: the law sees nothing wrong. (Near it, it may throw itself up.)
    run = fp.simulate(HEHN, fp.laws.lqr(), fp.State(y=(0, 0, -1)), 3, plant=plant, rtol=1e-6)
    np.testing.assert_allclose(run.y, np.broadcast_to([0, 0, -1], run.y.shape), rtol=0, atol=1e-6)
    assert run.thrust[-1] == pytest.approx(HEHN.weight, rel=0.02)
    assert metrics(run).cause == "rod"


def test_a_large_tilt_of_the_rod_is_too_much_for_real_rotors():
    # It rights 45 degrees of the rod at rest and not 75; without limits and lag it would right that as well.
    start = tilted(np.radians(75), which="rod")
    assert not metrics(fp.simulate(HEHN, fp.laws.lqr(), start, 10, plant="rotors")).success


def test_thrust_is_never_negative():
    start = fp.State(x=(0, 0, 30.0), y=(0, 0, 1))
    run = fp.simulate(HEHN, fp.laws.lqr(), start, 0.1, plant="ideal")
    assert run.thrust[0] == 0.0
    assert np.min(run.thrust) >= 0


def test_without_gravity_there_is_no_upright_rod_to_regulate():
    with pytest.raises(fp.InputError, match=r"^vehicle\.gravity: "):
        fp.laws.lqr().bind(HEHN.replace(gravity=0.0))


# References ------------------------------------------------------------------------------------------------------


def test_it_hovers_where_it_should():
    law = fp.laws.lqr(reference=fp.laws.references.hover((1.0, -0.5, 0.3)))
    run = fp.simulate(HEHN, law, UPRIGHT, 15, rtol=1e-7, plant="ideal")
    np.testing.assert_allclose(run.x[-1], [1.0, -0.5, 0.3], rtol=0, atol=5e-3)  # 1 m, 15 s at half a second or faster
    assert metrics(run).success


def test_it_follows_a_circle_with_the_feedforward():
    radius, rate = 0.5, 1.0
    law = fp.laws.lqr(reference=fp.laws.references.circle(radius, rate))
    start = fp.State(x=(radius, 0, 0), x_dot=(0, radius * rate, 0), y=(0, 0, 1))
    run = fp.simulate(HEHN, law, start, 20, rtol=1e-7, plant="ideal")
    error = np.linalg.norm(run.x - run.x_ref, axis=1)[run.t > 15]
    # The lean of the rod is known to (rate² l/g)³ = 2e-4 of itself; a lean that is wrong by δ moves the pivot by about
    # δ times the ratio of rod to position gain: 2e-4 · 0.05 · 44 m.
    assert np.max(error) < 5e-4
    # Without it (the reference taken to stand still at every instant) the vehicle lags far behind.
    naive = fp.laws.lqr()
    offset = fp.Law(
        name="naive",
        e3="up",
        control=lambda t, state, vehicle, k: naive.bind(vehicle).evaluate(
            t, _relative(state, law.reference(t)), vehicle
        ),
        reference=law.reference,
    )
    lagging = fp.simulate(HEHN, offset, start, 20, rtol=1e-7, plant="ideal")
    assert np.max(np.linalg.norm(lagging.x - lagging.x_ref, axis=1)[lagging.t > 15]) > 0.2


def _relative(state, x_ref):
    return fp.State(x=state.x - x_ref, x_dot=state.x_dot, R=state.R, omega=state.omega, y=state.y, y_dot=state.y_dot)


# Input -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", DEVIATIONS)
@pytest.mark.parametrize("bad", [0, -1.0, np.nan, "1", None])
def test_a_deviation_that_is_not_positive_is_refused(name, bad):
    with pytest.raises(fp.InputError, match=rf"^{name}: expected a finite number > 0 .*, got .*$"):
        fp.laws.lqr(**{name: bad})


def test_the_law_is_known_by_name_with_its_gains_and_a_reference():
    assert "lqr" in fp.laws.law_names()
    law = fp.laws.law_from_dict(
        {"name": "lqr", "gains": {"rod_error": 0.3}, "reference": {"shape": "hover", "x": [1, 0, 0]}}
    )
    assert (law.name, law.e3, law.values["rod_error"]) == ("lqr", "up", 0.3)
    assert law.bind(HEHN) is law.bind(HEHN)
    assert law.bind(HEHN).gains == law.values
    for table, line in (
        ({"name": "lqr", "gains": {"rod_eror": 1}}, r"^law\.gains\.rod_eror: expected one of .*did you mean 'rod_err"),
        ({"name": "lqr", "gains": {"rod_error": -1}}, r"^law\.gains\.rod_error: expected a finite number > 0 rad, got"),
        ({"name": "lqr", "gains": {"reference": 1}}, r"^law\.gains\.reference: expected one of position_error"),
    ):
        with pytest.raises(fp.InputError, match=line):
            fp.laws.law_from_dict(table)


def test_the_gains_do_not_depend_on_the_threads_of_blas():
    """To the last bit: a worker of a sweep, whose BLAS has one thread, flies the equations of its caller."""
    code = (
        "import flypend as fp; from flypend.laws.lqr import gain_matrix as K; "
        "print(K(fp.vehicle('hehn2011'), fp.laws.lqr().values).tobytes().hex())"
    )
    told = {
        subprocess.run(
            [sys.executable, "-c", code], env={**os.environ, "OPENBLAS_NUM_THREADS": threads},
            capture_output=True, text=True, check=True,
        ).stdout
        for threads in ("1", "2", "3")
    }  # fmt: skip
    assert len(told) == 1
    assert len(told.pop()) == 2 * 8 * 64 + 1  # doubles of K (4, 16), and the end of the line
