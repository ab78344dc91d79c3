"""The linearisation against the flow, against derivatives by NumPy, and against eigenvalues known by hand."""

from functools import cache

import numpy as np
import pytest
from scipy.linalg import expm

import flypend as fp
from flypend.compile.numeric import as_numpy
from flypend.flight.integrate import integrate
from flypend.flight.request import Tolerances
from flypend.laws.closed_loop import close_loop
from flypend.laws.linearise import COORDINATES, linearise, open_loop, retract, tangent_basis
from flypend.laws.throw import THRUST_SHARE
from flypend.model import equations_of_motion

ARM = 0.046 * np.sqrt(0.5)
CRAZYFLIE = fp.Vehicle(
    name="30 g",
    mass=0.027,
    bob_mass=0.003,
    rod_length=0.15,
    inertia=[1.66e-5, 1.66e-5, 2.93e-5],
    rotor_positions=[[ARM, -ARM, 0], [-ARM, -ARM, 0], [-ARM, ARM, 0], [ARM, ARM, 0]],
    rotor_spins=[-1, 1, -1, 1],
    drag_ratio=0.006,
    rotor_limits=[0.0, 0.15],
    rotor_lag=0.03,
)
# The law asks for an attitude loop 1.5 times as fast as the rod's. With the inertia that its paper prints (that of a
# vehicle ten times as heavy) nayak2018 cannot have it, so here its rotors are stronger, which is all that changes.
STRONG_NAYAK = fp.vehicle("nayak2018").replace(rotor_limits=[0.08, 50.0])
VEHICLES = {"hehn2011": fp.vehicle("hehn2011"), "nayak2018": STRONG_NAYAK, "30 g": CRAZYFLIE}


@cache
def inverted(name):
    """The linearisation of the inverted law, on a vehicle of `VEHICLES`."""
    return linearise(fp.laws.inverted(), VEHICLES[name])


def coordinates_of(state, at):
    """ξ of `state` about `at`: the definition, written anew."""
    turn = at.R.T @ state.R
    angle = np.arccos(np.clip((np.trace(turn) - 1) / 2, -1, 1))
    axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    theta = axis / np.sinc(angle / np.pi)
    b = tangent_basis(at)[18:21, 12:14].T
    return np.concatenate([state.x - at.x, state.x_dot - at.x_dot, theta, state.omega, b @ state.y, b @ state.y_dot])


# Charts ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(3))
def test_retract_and_coordinates_are_inverse_and_their_derivative_is_the_basis(seed):
    rng = np.random.default_rng(seed)
    random = fp.State.random(rng)
    at = fp.State(x=random.x, R=random.R, y=random.y)
    xi = rng.uniform(-0.4, 0.4, 16)
    np.testing.assert_allclose(coordinates_of(retract(at, xi), at), xi, rtol=0, atol=1e-13)  # some hundred roundoffs
    h = 1e-5
    for i, column in enumerate(tangent_basis(at).T):
        step = h * np.eye(16)[i]
        slope = (retract(at, step).packed() - retract(at, -step).packed()) / (2 * h)
        np.testing.assert_allclose(column, slope, rtol=0, atol=1e-9)  # h²/6, and 1e-16/h


def test_about_an_upright_rod_the_coordinates_are_the_horizontal_components():
    for height in (1, -1):
        basis = tangent_basis(fp.State(y=(0, 0, height)))[18:21, 12:14]
        np.testing.assert_array_equal(basis, [[1, 0], [0, height], [0, 0]])


# The matrix ------------------------------------------------------------------------------------------------------


def flow_derivative(loop, at, h, eps):
    """∂ξ(h)/∂ξ(0) by central differences of runs, and forward less backward ones; no derivative is CasADi's."""
    rates, columns = as_numpy(loop.rates), []
    for i in range(16):
        ends = []
        for sign in (1, -1):
            start = retract(at, sign * eps * np.eye(16)[i])
            end = integrate(rates, start.packed(), h, Tolerances(rtol=1e-13))(np.array([h]))[0]
            ends.append(coordinates_of(fp.State.from_packed(end), at) / eps)
        columns.append((ends[0], -ends[1]))
    forward, backward = np.array(columns).transpose(1, 2, 0)
    return (forward + backward) / 2, forward - backward


@pytest.mark.parametrize("name", VEHICLES)
def test_the_matrix_of_the_inverted_law_is_that_of_its_flow(name):
    vehicle, found = VEHICLES[name], inverted(name)
    h = 0.02
    got, kink = flow_derivative(close_loop(vehicle, fp.laws.inverted().bind(vehicle)), found.at, h, 1e-4)
    expected = expm(h * found.A)
    # Rows differ in size by a thousand (a rate over an angle), so each entry is compared with the largest of its row.
    # The third derivative of the flow over the first is (1/angle)²: eps² = 1e-8 times some tens.
    scale = np.max(np.abs(expected), axis=1, keepdims=True)
    np.testing.assert_allclose(got / scale, expected / scale, rtol=0, atol=2e-6)
    assert np.max(np.abs(expected - np.eye(16))) > 1
    # The law has minima, maxima and roots, but is smooth here: the one-sided derivatives agree to second order.
    assert np.max(np.abs(kink / scale)) < 1e-2


def test_the_matrix_of_the_corrected_law_is_that_of_its_flow():
    vehicle = fp.vehicle("nayak2018")
    law = fp.laws.corrected(speed_floor=0.3)  # |ẏ| enters smoothly on the scale of the floor: eps²/floor² is the error
    found = linearise(law, vehicle)
    h = 0.1
    got, _ = flow_derivative(close_loop(vehicle, law), found.at, h, 1e-4)
    np.testing.assert_allclose(got, expm(h * found.A), rtol=0, atol=1e-6)


@pytest.mark.parametrize("law", [fp.laws.lqr(), fp.laws.inverted(), fp.laws.almost_global()], ids=lambda law: law.name)
def test_rotors_that_give_more_than_commanded_are_commanded_less(law):
    """The law knows of `thrust_scale`, so that the closed loop is the same, but for the default gains of `inverted`."""
    vehicle = fp.vehicle("hehn2011").replace(thrust_scale=0.7)
    linear = linearise(law, vehicle)
    ends = fp.sensitivity(vehicle, law, linear.at, 0.3).on_manifold[0]
    np.testing.assert_allclose(ends, expm(0.3 * linear.A), atol=1e-6)


def test_the_open_loop_is_what_numpy_differentiates():
    rng = np.random.default_rng(1)
    for e3, at in (("up", fp.State(y=(0, 0, 1))), ("up", fp.State(y=(0, 0, -1))), ("down", fp.State(y=(0, 0, 1)))):
        vehicle = fp.vehicle("hehn2011").replace(rod_length=rng.uniform(0.3, 1))
        held = fp.Wrench(vehicle.weight * (1 if e3 == "up" else -1), np.zeros(3))
        A, B = open_loop(vehicle, e3, at, held)
        E = tangent_basis(at)
        h = 1e-5

        def velocity(xi, u, at=at, E=E, vehicle=vehicle, held=held, e3=e3):
            wrench = fp.Wrench(held.thrust + u[0], held.moment + u[1:])
            rates = equations_of_motion(retract(at, xi), wrench, vehicle, e3).packed()
            return np.linalg.lstsq(E, rates, rcond=None)[0]

        for matrix, size in ((A, 16), (B, 4)):
            for i in range(size):
                step = h * np.eye(size)[i]
                xi, u = (step, np.zeros(4)) if size == 16 else (np.zeros(16), step)
                slope = (velocity(xi, u) - velocity(-xi, -u)) / (2 * h)
                # h² times second derivatives below 100, and 1e-16/h times entries up to 1/I = 300.
                np.testing.assert_allclose(matrix[:, i], slope, rtol=0, atol=1e-7)


# Eigenvalues known by hand ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", VEHICLES)
def test_the_open_loop_falls_over_at_the_rate_of_a_rod_on_a_steady_thrust(name):
    # With z = e₃ and f = (M+m) g, (ddty_notfin) is η̈ = (f/Ml) η for the horizontal part η of y near e₃, since
    # ŷ²e₃ = y × (y × e₃) = y y₃ − e₃ → η. Hanging, η̈ = −(f/Ml) η. All else is a chain of integrators.
    vehicle = VEHICLES[name]
    rate = np.sqrt((vehicle.mass + vehicle.bob_mass) * vehicle.gravity / (vehicle.mass * vehicle.rod_length))
    hover = fp.Wrench(vehicle.weight, np.zeros(3))
    for height, expected in ((1, [-rate, -rate, rate, rate]), (-1, [-1j * rate, -1j * rate, 1j * rate, 1j * rate])):
        A, _ = open_loop(vehicle, "up", fp.State(y=(0, 0, height)), hover)
        values = np.linalg.eigvals(A)
        # Eigenvalues of a chain of four integrators move by (1e-16)^(1/4) = 1e-4 of its entries, some tens at most.
        fast = values[np.abs(values) > 0.1 * rate]
        np.testing.assert_allclose(np.sort_complex(fast), expected, rtol=1e-9, atol=1e-9)
        assert len(values) - len(fast) == 12


@pytest.mark.parametrize("name", VEHICLES)
def test_inverted_hover_is_stable_but_for_the_heading(name):
    found = inverted(name)
    assert found.stable
    assert found.symmetries == ("theta_3",)
    values = found.eigenvalues
    assert abs(values[0]) < 1e-9  # the heading, a zero column of A
    assert np.all(values[1:].real < (-0.85 if name == "nayak2018" else -1))  # of a slow vehicle, 1/s
    assert values[1].real == pytest.approx(found.spectral_abscissa, rel=1e-9)
    # Yaw is decoupled: its rate decays as the gain says.
    assert np.min(np.abs(values + fp.laws.inverted().gains_for(VEHICLES[name])["yaw_damping"])) < 1e-9
    np.testing.assert_allclose(found.acceleration, 0, rtol=0, atol=1e-9)


@pytest.mark.parametrize("name", VEHICLES)
def test_the_height_of_the_inverted_law_has_the_eigenvalues_of_its_gains(name):
    # Upright the bob's height obeys ë = −w² e − 2ζw ė. The saturation of the force, 1/(1 + r⁸)^(1/8) at r = f/limit,
    # takes its derivative down by (1 + r⁸)^(−9/8); and hover sinks until the law asks for what is cut off.
    vehicle, found, k = VEHICLES[name], inverted(name), fp.laws.inverted().gains_for(VEHICLES[name])
    w, zeta = k["height_bandwidth"], k["position_damping"]
    limit = THRUST_SHARE * vehicle.rotor_limits[1] * 4
    r = vehicle.weight / limit
    slope = (1 + r**8) ** (-9 / 8)
    expected = np.roots([1, 2 * zeta * w * slope, w**2 * slope])
    for value in expected:
        assert np.min(np.abs(found.eigenvalues - value)) < 1e-2 * w  # r is taken without what is cut off
    # Uncut, the thrust to ask for is weight/(1 − r⁸)^(1/8): g r⁸/8 more acceleration, and w² per metre below.
    sag = vehicle.gravity * ((1 - r**8) ** (-1 / 8) - 1) / w**2
    np.testing.assert_allclose(found.at.x, [0, 0, -sag], rtol=0, atol=1e-3 * sag + 1e-12)


def test_the_corrected_law_governs_rod_and_axis_and_nothing_else():
    # Its equilibrium, y = z = e₃ along gravity, hangs. The rod obeys η̈ = −k_p η − k_d η̇ with z = z_d and the axis
    # λ² + k_2 λ + k_1; pivot and velocity do not enter, nor does the heading, and the yaw rate is not damped.
    vehicle, floor = fp.vehicle("nayak2018"), 1e-2
    found = linearise(fp.laws.corrected(k_d=1.2, k_1=9, k_2=4, speed_floor=floor), vehicle)
    k_p = vehicle.weight / (vehicle.mass * vehicle.rod_length * (1 + floor))
    governed = found.without("x", "x_dot", "theta_3", "omega_3")
    expected = np.concatenate([np.tile(np.roots([1, 1.2, k_p]), 2), np.tile(np.roots([1, 4, 9]), 2)])
    np.testing.assert_allclose(
        np.sort_complex(np.round(governed.eigenvalues, 6)), np.sort_complex(np.round(expected, 6)), rtol=0, atol=2e-6
    )
    assert governed.stable
    zeros = np.abs(found.eigenvalues) < 1e-6  # x, ẋ, heading and yaw rate: pairs of integrators, (1e-16)^(1/2)
    assert np.count_nonzero(zeros) == 8
    assert not found.stable
    assert found.symmetries == ("theta_3",)
    # The floor keeps the thrust below the weight by 1/(1 + s): the vehicle sinks although it rests in all else.
    np.testing.assert_allclose(found.acceleration, [0, 0, vehicle.gravity * floor / (1 + floor)], rtol=0, atol=1e-12)
    damped = linearise(fp.laws.corrected(yaw_damping=2.5), vehicle)
    assert np.count_nonzero(np.abs(damped.eigenvalues) < 1e-6) == 7


def test_the_printed_damping_sign_is_unstable():
    vehicle = fp.vehicle("nayak2018")
    found = linearise(fp.laws.printed(beta="off"), vehicle)
    # λ² − k_d λ + k_p
    assert found.spectral_abscissa == pytest.approx(0.5, rel=1e-6)  # k_d/2, with k_d = 1
    assert not found.stable


# Against the nonlinear motion ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", VEHICLES)
def test_a_small_perturbation_decays_as_the_matrix_says(name):
    vehicle, found = VEHICLES[name], inverted(name)
    rest = found.without("theta_3")
    rate = -rest.spectral_abscissa
    at = COORDINATES.index("theta_3")
    values, vectors = np.linalg.eig(rest.A)
    slowest = vectors[:, np.argmax(values.real)].real
    anywhere = np.random.default_rng(2).standard_normal(15)
    for start in (slowest, anywhere):
        small = 1e-5 * start / np.max(np.abs(start))
        begin, times = retract(found.at, np.insert(small, at, 0.0)), np.array([1.0, 2.0]) / rate
        run = fp.simulate(vehicle, fp.laws.inverted(), begin, times[1], rtol=1e-12, times=times, plant="ideal")
        for time, state in zip(times, run.states, strict=True):
            final = np.delete(coordinates_of(state, found.at), at)
            expected = expm(rest.A * time) @ small
            # 1e-5 times curvature, of the size that the perturbation had.
            np.testing.assert_allclose(final, expected, rtol=0, atol=2e-3 * np.max(np.abs(small)))


# What is refused -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("law", "at", "line"),
    [
        (fp.laws.inverted(), fp.State(y=(0, 0, -1)), r"^at: expected a state next to an equilibrium, got rates"),
        (fp.laws.inverted(), fp.State(y=(0, 0, 1), omega=(1, 0, 0)), r"^at: expected a state at rest"),
        (fp.laws.inverted(), fp.State.random(np.random.default_rng(0), 2), r"^at: expected a single state"),
        (fp.laws.inverted(fp.laws.references.circle()), None, r"^law: expected one whose reference stands still"),
        (fp.laws.printed(), None, r"^law: expected one that is differentiable at its equilibrium, got NaN"),
        ("inverted", None, r"^law: expected a Law"),
    ],
)
def test_what_has_no_linearisation_is_refused(law, at, line):
    with pytest.raises(fp.InputError, match=line):
        linearise(law, fp.vehicle("hehn2011"), at)


def test_an_open_loop_that_is_not_held_is_refused():
    vehicle = fp.vehicle("hehn2011")
    with pytest.raises(fp.InputError, match=r"^at: expected a state next to an equilibrium"):
        open_loop(vehicle, "up", fp.State(y=(0.6, 0, 0.8)), fp.Wrench(vehicle.weight, np.zeros(3)))


def test_coordinates_are_left_out_only_if_nothing_depends_on_them():
    found = inverted("hehn2011")
    with pytest.raises(fp.InputError, match=r"^coordinates: expected some that the others do not depend on, got y_1"):
        found.without("y_1")
    with pytest.raises(fp.InputError, match=r"^coordinates: expected one of x_1, .*, got 'phi'"):
        found.without("phi")
    assert found.without().A.shape == (16, 16)
    assert found.without("theta_3").coordinates == tuple(name for name in COORDINATES if name != "theta_3")


def test_a_guess_is_led_to_the_equilibrium_and_a_reference_moves_it():
    vehicle = fp.vehicle("hehn2011")
    law = fp.laws.inverted(fp.laws.references.hover((1.0, 2.0, 3.0)))
    found = linearise(law, vehicle)
    np.testing.assert_allclose(found.at.x - inverted("hehn2011").at.x, [1, 2, 3], rtol=0, atol=1e-9)
    np.testing.assert_allclose(found.A, inverted("hehn2011").A, rtol=0, atol=1e-6)
    near = linearise(law, vehicle, fp.State(x=(1.1, 1.9, 3.05), y=(0.02, 0, np.sqrt(1 - 0.02**2))))
    for name in ("x", "z", "y"):  # the heading is free
        np.testing.assert_allclose(getattr(near.at, name), getattr(found.at, name), rtol=0, atol=1e-9)
    ours, theirs = (sorted(at.eigenvalues, key=lambda s: (round(s.real, 6), s.imag)) for at in (near, found))
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-6)
