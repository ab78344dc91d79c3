"""The equations of motion against the Lagrangian of the paper and the conservation laws that follow from it."""

import casadi as ca
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import flypend as fp
from flypend import geometry as geo
from flypend.model import (
    bob_position,
    equations_of_motion,
    gravity_vector,
    kinetic_energy,
    lie_derivative,
    linear_momentum,
    potential_energy,
    rod_tension,
    total_energy,
)
from flypend.model.dynamics import bob_tension
from flypend.model.rod import uniform_rod
from flypend.paper import experiment

# Sums of some ten products of numbers of order one to thirty, eps each.
ROUNDOFF = 1e-12
DIRECTIONS = ["down", "up"]


def _vehicle(seed, e3):
    """A machine of order one with products of inertia.

    With e₃ down only the product that a turn of the body by π about e₁ leaves alone: which way the others count in that
    frame is a matter of `Vehicle`, tested with it.
    """
    rng = np.random.default_rng(seed)
    Q = geo.random_rotation(rng) if e3 == "up" else Rotation.from_euler("x", rng.uniform(0.3, 1.2)).as_matrix()
    return fp.vehicle("nayak2018").replace(
        mass=rng.uniform(0.3, 2),
        bob_mass=rng.uniform(0.05, 1),
        rod_length=rng.uniform(0.3, 1.5),
        rod_inertia=rng.choice([0.0, rng.uniform(0.01, 1)]),
        inertia=Q @ np.diag(rng.uniform(1, 1.9, 3)) @ Q.T,
        gravity=rng.uniform(1, 12),
    )


def _wrench(rng, size=()):
    return fp.Wrench(rng.uniform(-10, 10, size), rng.standard_normal((*size, 3)))


# Euler-Lagrange --------------------------------------------------------------------------------------------------


def _residual_function(vehicle, e3):
    """Residual of the Euler-Lagrange equations with the paper's variations, for velocities and accelerations given.

    From (lq), (lp), (pe), by CasADi derivatives; nothing of `flypend.model` is used. Variations: δx free; δR = R Σ̂, so
    δω = Σ̇ + ω × Σ and d/dt ∂L/∂ω + ω × ∂L/∂ω is the moment; δy = γ × y, so only y × (...) must vanish.
    """
    x, v, w, y, u = (ca.SX.sym(name, 3) for name in ("x", "v", "omega", "y", "y_dot"))
    a, alpha, b = (ca.SX.sym(name, 3) for name in ("x_ddot", "omega_dot", "y_ddot"))
    f, tau, z = ca.SX.sym("f"), ca.SX.sym("tau", 3), ca.SX.sym("z", 3)
    M, m, l, g = vehicle.mass, vehicle.bob_mass, vehicle.rod_length, vehicle.gravity
    along_gravity = ca.DM([0, 0, 1 if e3 == "down" else -1])

    L_Q = M * ca.dot(v, v) / 2 + ca.dot(ca.mtimes(ca.DM(vehicle.inertia), w), w) / 2
    L_p = (m * ca.dot(v + l * u, v + l * u) + vehicle.rod_inertia * ca.dot(u, u)) / 2
    V = -M * g * ca.dot(x, along_gravity) - m * g * ca.dot(x + l * y, along_gravity)
    L = L_Q + L_p - V

    def momentum(of):
        return ca.gradient(L, of)

    def ddt(p):
        return ca.jtimes(p, ca.vertcat(x, v, w, y, u), ca.vertcat(v, a, alpha, u, b))

    r_x = ddt(momentum(v)) - momentum(x) - f * z
    r_R = ddt(momentum(w)) + ca.cross(w, momentum(w)) - tau
    r_y = ca.cross(y, ddt(momentum(u)) - momentum(y))
    inputs = [x, v, w, y, u, z, f, tau, a, alpha, b]
    return ca.Function("residual", inputs, [ca.vertcat(r_x, r_R, r_y)])


def _residual(vehicle, e3, state, wrench, x_ddot, omega_dot, y_ddot):
    call = _residual_function(vehicle, e3)
    given = (state.x, state.x_dot, state.omega, state.y, state.y_dot, state.z)
    return call(*given, wrench.thrust, wrench.moment, x_ddot, omega_dot, y_ddot).full().ravel()


@pytest.mark.parametrize("e3", DIRECTIONS)
@pytest.mark.parametrize("seed", range(8))
def test_the_equations_of_motion_are_those_of_the_lagrangian(seed, e3):
    rng = np.random.default_rng(seed)
    vehicle, state, wrench = _vehicle(seed, e3), fp.State.random(rng), _wrench(rng)
    rates = equations_of_motion(state, wrench, vehicle, e3)
    assert np.max(np.abs(_residual(vehicle, e3, state, wrench, rates[1], rates[3], rates[5]))) < 10 * ROUNDOFF
    # Kinematics and the constraints, differentiated: y·y = 1, RᵀR = 1.
    np.testing.assert_array_equal(rates.x_dot, state.x_dot)
    np.testing.assert_array_equal(rates.y_dot, state.y_dot)
    assert abs(state.y_dot @ state.y_dot + state.y @ rates.y_ddot) < ROUNDOFF
    np.testing.assert_allclose(state.R.T @ rates.R_dot, geo.hat(state.omega), rtol=0, atol=ROUNDOFF)


def test_a_batch_obeys_the_lagrangian_member_by_member():
    rng = np.random.default_rng(11)
    vehicle, state, wrench = _vehicle(1, "down"), fp.State.random(rng, (3, 4)), _wrench(rng, (3, 4))
    rates = equations_of_motion(state, wrench, vehicle, "down")
    assert rates.packed().shape == (3, 4, 24)
    for index in np.ndindex(3, 4):
        one = fp.Wrench(wrench.thrust[index], wrench.moment[index])
        member = [rate[index] for rate in rates]
        residual = _residual(vehicle, "down", state[index], one, member[1], member[3], member[5])
        assert np.max(np.abs(residual)) < 10 * ROUNDOFF
        single = equations_of_motion(state[index], one, vehicle, "down").packed()
        # Not bit-equal: State projects what is indexed once more, which moves it by an eps.
        np.testing.assert_allclose(rates.packed()[index], single, rtol=0, atol=100 * ROUNDOFF)


def test_casadi_and_numpy_evaluate_the_same_equations():
    rng = np.random.default_rng(12)
    vehicle, state, wrench = _vehicle(2, "up"), fp.State.random(rng), _wrench(rng)
    s, f, tau = ca.SX.sym("s", 24), ca.SX.sym("f"), ca.SX.sym("tau", 3)
    rates = equations_of_motion(fp.State.symbolic(s), fp.Wrench(f, tau), vehicle, "up").packed()
    got = ca.Function("rates", [s, f, tau], [rates])(state.packed(), wrench.thrust, wrench.moment).full().ravel()
    expected = equations_of_motion(state, wrench, vehicle, "up").packed()
    np.testing.assert_allclose(got, expected, rtol=0, atol=10 * ROUNDOFF)


WRONG = {
    "sign of m l ÿ": lambda v, w, r: {"x_ddot": r.x_ddot + 2 * v.m * v.l / (v.M + v.m) * r.y_ddot},
    "rod driven by f / (M+m) l": lambda v, w, r: {"y_ddot": r.y_ddot * v.M / (v.M + v.m)},
    "paper's mu for tau": lambda v, w, r: {"omega_dot": r.omega_dot - 2 * v.I_inv @ w.moment},
    "no gyroscopic moment": lambda v, w, r: {"omega_dot": v.I_inv @ w.moment},
    "gravity reversed": lambda v, w, r: {"x_ddot": r.x_ddot - 2 * gravity_vector(v, "down")},
}


@pytest.mark.parametrize("mistake", WRONG)
def test_a_wrong_equation_has_a_residual_of_order_one(mistake):
    rng = np.random.default_rng(3)
    vehicle, state, wrench = _vehicle(3, "down"), fp.State.random(rng), _wrench(rng)
    rates = equations_of_motion(state, wrench, vehicle, "down")
    right = {"x_ddot": rates.x_ddot, "omega_dot": rates.omega_dot, "y_ddot": rates.y_ddot}
    wrong = right | WRONG[mistake](vehicle, wrench, rates)
    assert np.max(np.abs(_residual(vehicle, "down", state, wrench, **right))) < 10 * ROUNDOFF
    assert np.max(np.abs(_residual(vehicle, "down", state, wrench, **wrong))) > 0.1


# Hamilton's principle, along a closed-loop run -------------------------------------------------------------------

NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)


@pytest.fixture(scope="module")
def flown():
    """A run of the corrected law on Gauss nodes over 0 .. 1.2 s; |ẏ| > 0.9 1/s, so 60 nodes integrate to 1e-10."""
    case = experiment("3")
    times = 0.6 * (NODES + 1)
    return fp.simulate(case.vehicle, case.law(), case.start, 1.2, rtol=1e-12, times=times, plant="ideal"), 0.6 * WEIGHTS


def _varied_action(flown, eps, shift, turn, swing):
    """The action, varied by x + εη shift, R exp(εη turn^), exp(εη swing^) y, with η(t) zero at both ends."""
    run, weights = flown
    vehicle = run.vehicle
    k = np.pi / 1.2
    bump, slope = eps * np.sin(k * run.t) ** 2, eps * k * np.sin(2 * k * run.t)
    body, rod = _exponentials(bump, turn), _exponentials(bump, swing)
    x_dot = run.x_dot + slope[:, None] * shift
    x = run.x + bump[:, None] * shift
    omega = np.einsum("nji,nj->ni", body, run.omega) + slope[:, None] * turn
    y = np.einsum("nij,nj->ni", rod, run.y)
    y_dot = np.einsum("nij,nj->ni", rod, run.y_dot + slope[:, None] * np.cross(swing, run.y))
    bob, M, m, l = x_dot + vehicle.l * y_dot, vehicle.M, vehicle.m, vehicle.l
    L = (M * (x_dot**2).sum(1) + ((omega @ vehicle.I) * omega).sum(1) + m * (bob**2).sum(1)) / 2
    L += vehicle.g * (M * x[:, 2] + m * (x[:, 2] + l * y[:, 2]))  # (pe), e₃ along gravity
    return weights @ L


def _exponentials(angles, axis):
    K = geo.hat(axis / np.linalg.norm(axis))
    t = (angles * np.linalg.norm(axis))[:, None, None]
    return np.eye(3) + np.sin(t) * K + (1 - np.cos(t)) * K @ K


@pytest.mark.parametrize("seed", range(3))
def test_the_action_of_a_run_is_stationary_up_to_the_work_of_its_wrench(flown, seed):
    # δ∫L dt + ∫(f z·δx + τ·Σ) dt = 0, (hamprin) with the sign of d'Alembert. No derivative of L, no ω × p is used.
    run, weights = flown
    shift, turn, swing = np.random.default_rng(seed).standard_normal((3, 3))
    h = 1e-3
    change = [_varied_action(flown, eps, shift, turn, swing) for eps in (h, -h)]
    bump = np.sin(np.pi / 1.2 * run.t) ** 2
    work = weights @ (bump * (run.thrust * (run.z @ shift) + run.moment @ turn))
    # Central difference: h²/6 times a third derivative below one (linear and quadratic parts of the action cancel or
    # are exact); run and quadrature are good to 1e-10.
    assert abs((change[0] - change[1]) / (2 * h) + work) < 1e-6
    assert abs(work) > 0.1  # what is cancelled is not small


# Conservation ----------------------------------------------------------------------------------------------------


def no_wrench(e3):
    return fp.Law(name="none", e3=e3, control=lambda t, state, vehicle, k: fp.Wrench(ca.SX(0), ca.SX.zeros(3)))


def constant_thrust(e3, thrust):
    return fp.Law(name="thrust", e3=e3, control=lambda t, state, vehicle, k: fp.Wrench(ca.SX(thrust), ca.SX.zeros(3)))


@pytest.fixture(scope="module", params=DIRECTIONS)
def falling(request):
    vehicle = _vehicle(5, request.param).replace(gravity=9.81)
    start = fp.State.random(np.random.default_rng(5))
    return fp.simulate(vehicle, no_wrench(request.param), start, 10.0, rtol=1e-11, plant="ideal")


def test_energy_is_conserved_without_wrench(falling):
    energy = total_energy(falling.states, falling.vehicle, falling.e3)
    scale = np.max(kinetic_energy(falling.states, falling.vehicle))  # 10 s of fall: the terms that cancel
    assert scale > 1e3
    # 1e-11 per step, about a hundred steps.
    assert np.max(np.abs(energy - energy[0])) < 1e-9 * scale


def test_momentum_follows_gravity(falling):
    vehicle = falling.vehicle
    momentum = linear_momentum(falling.states, vehicle)
    gravity = (vehicle.M + vehicle.m) * gravity_vector(vehicle, falling.e3)
    expected = momentum[0] + falling.t[:, None] * gravity
    np.testing.assert_allclose(momentum, expected, rtol=0, atol=1e-9 * np.max(np.abs(expected)))  # as for energy
    assert np.sign(gravity[2]) == (1 if falling.e3 == "down" else -1)
    fallen = bob_position(falling.states, vehicle)[-1, 2] * np.sign(gravity[2])
    assert fallen > 0.4 * vehicle.g * 10.0**2  # free fall: about g t²/2


def test_angular_momentum_of_the_body_in_space_is_conserved_and_its_rotation_is_not_steady(falling):
    in_space = geo.apply(falling.R, geo.apply(falling.vehicle.I, falling.omega))
    np.testing.assert_allclose(in_space, np.broadcast_to(in_space[0], in_space.shape), rtol=0, atol=1e-8)  # |Iω| ~ 5
    assert np.max(np.abs(falling.omega - falling.omega[0])) > 0.1


def test_the_rod_turns_steadily_on_a_great_circle_in_free_fall(falling):
    y, y_dot = falling.y[0], falling.y_dot[0]
    rate = np.linalg.norm(y_dot)
    angle = rate * falling.t[:, None]
    # 1e-11 per step for some hundred steps.
    np.testing.assert_allclose(falling.y, np.cos(angle) * y + np.sin(angle) * y_dot / rate, rtol=0, atol=1e-8)


def test_under_a_steady_thrust_the_rod_is_a_spherical_pendulum_about_it():
    # With z at rest ÿ + |ẏ|²y = (f/Ml) ŷ²z conserves |ẏ|²/2 + (f/Ml) y·z and z·(y × ẏ): z repels the bob for f > 0.
    vehicle, thrust = fp.vehicle("hehn2011"), 6.0
    start = fp.State(y=(0.6, 0, 0.8), y_dot=(0, 1.5, 0))
    run = fp.simulate(vehicle, constant_thrust("up", thrust), start, 5.0, rtol=1e-11, plant="ideal")
    energy = (run.y_dot**2).sum(1) / 2 + thrust / (vehicle.M * vehicle.l) * run.y[:, 2]
    spin = np.cross(run.y, run.y_dot)[:, 2]
    assert np.ptp(energy) < 1e-8  # of 20, after some 150 steps of 1e-11
    assert np.ptp(spin) < 1e-8
    assert run.y[:, 2].min() < -0.5  # it fell over


@pytest.mark.parametrize("e3", DIRECTIONS)
def test_power_is_the_change_of_energy(e3):
    vehicle = _vehicle(6, e3)
    s, f, tau = ca.SX.sym("s", 24), ca.SX.sym("f"), ca.SX.sym("tau", 3)
    state = fp.State.symbolic(s)
    rates = equations_of_motion(state, fp.Wrench(f, tau), vehicle, e3)
    change = lie_derivative(total_energy(state, vehicle, e3), state, rates)
    power = f * ca.dot(state.z, state.x_dot) + ca.dot(tau, state.omega)
    difference = ca.Function("difference", [s, f, tau], [change - power, power])
    rng = np.random.default_rng(6)
    for member in fp.State.random(rng, 10):
        wrench = _wrench(rng)
        gap, size = (float(value) for value in difference(member.packed(), wrench.thrust, wrench.moment))
        assert abs(gap) < 10 * ROUNDOFF
        assert abs(size) > 1e-3


def test_energies_are_those_of_textbooks():
    vehicle = fp.vehicle("hehn2011")
    M, m, l, g = 0.5, 0.05, 0.565, 9.81
    low, high = fp.State(x=(4, 5, 0), y=(0, 0, -1)), fp.State(x=(-1, 2, 3), y=(0, 0, 1))
    climb = potential_energy(high, vehicle, "up") - potential_energy(low, vehicle, "up")
    assert climb == pytest.approx((M + m) * g * 3 + 2 * m * g * l, rel=1e-14)
    assert potential_energy(high, vehicle, "down") == pytest.approx(-potential_energy(high, vehicle, "up"), rel=1e-14)
    moving = fp.State(x_dot=(1, 2, 2), omega=(1, 2, 3), y=(0, 0, 1), y_dot=(3, 4, 0))
    bob = np.array([1 + 3 * l, 2 + 4 * l, 2])
    expected = (M * 9 + m * bob @ bob + 3.2e-3 * 1 + 3.2e-3 * 4 + 5.5e-3 * 9) / 2
    assert kinetic_energy(moving, vehicle) == pytest.approx(expected, rel=1e-14)
    assert total_energy(moving, vehicle, "up") == pytest.approx(expected + m * g * l, rel=1e-14)
    np.testing.assert_allclose(linear_momentum(moving, vehicle), M * np.array([1, 2, 2]) + m * bob, rtol=1e-14)


def test_lie_derivative_takes_time_into_account():
    # h = t² |ẋ|² in free fall: ḣ = 2 t |ẋ|² + 2 t² ẋ·g⃗ for a rod at rest.
    vehicle = fp.vehicle("hehn2011")
    t, s = ca.SX.sym("t"), ca.SX.sym("s", 24)
    state = fp.State.symbolic(s)
    rates = equations_of_motion(state, fp.Wrench(ca.SX(0), ca.SX.zeros(3)), vehicle, "up")
    h = t**2 * ca.dot(state.x_dot, state.x_dot)
    rate = ca.Function("rate", [t, s], [lie_derivative(h, state, rates, t)])
    start = fp.State(y=(0, 0, 1), x_dot=(1, 2, 3))
    assert float(rate(0.5, start.packed())) == pytest.approx(2 * 0.5 * 14 - 2 * 0.25 * 3 * vehicle.g, rel=1e-14)


@pytest.mark.parametrize("e3", DIRECTIONS)
def test_tension_of_the_rod_balances_both_bodies(e3):
    rng = np.random.default_rng(9)
    vehicle, state, wrench = _vehicle(9, e3), fp.State.random(rng, 50), _wrench(rng, (50,))
    rates, g = equations_of_motion(state, wrench, vehicle, e3), gravity_vector(vehicle, e3)
    pull = geo.scale(bob_tension(state, wrench, vehicle), state.y)
    quadrotor = vehicle.M * rates.x_ddot - vehicle.M * g - geo.scale(wrench.thrust, state.z)
    bob = vehicle.m * (rates.x_ddot + vehicle.l * rates.y_ddot) - vehicle.m * g
    np.testing.assert_allclose(quadrotor, pull, rtol=0, atol=100 * ROUNDOFF)
    np.testing.assert_allclose(bob, -pull, rtol=0, atol=100 * ROUNDOFF)


@pytest.mark.parametrize("e3", DIRECTIONS)
@pytest.mark.parametrize("inertia", [0.0, 0.3])
def test_force_along_the_rod_is_that_of_a_rigid_body_held_at_its_end(inertia, e3):
    """Newton's second law of the rod, whose centre of mass is at x + l_r y, and of the vehicle without it."""
    rng = np.random.default_rng(9)
    vehicle = _vehicle(9, e3).replace(rod_inertia=inertia)
    state, wrench = fp.State.random(rng, 50), _wrench(rng, (50,))
    rates, g = equations_of_motion(state, wrench, vehicle, e3), gravity_vector(vehicle, e3)
    on_vehicle = -vehicle.bob_mass * (rates.x_ddot + vehicle.rod_length * rates.y_ddot - g)
    found = rod_tension(state, wrench, vehicle)
    np.testing.assert_allclose(geo.dot(on_vehicle, state.y), found, rtol=0, atol=100 * ROUNDOFF)
    own = vehicle.mass * (rates.x_ddot - g) - geo.scale(wrench.thrust, state.z)
    np.testing.assert_allclose(own, on_vehicle, rtol=0, atol=100 * ROUNDOFF)


@pytest.mark.parametrize("rod", [{}, uniform_rod(0.1, 1.0)], ids=["bob", "uniform"])
def test_tension_at_rest_is_the_weight_of_the_rod(rod):
    # e₃ up: hanging from a hovering vehicle the rod pulls with m g, standing on it it pushes with m g.
    vehicle = fp.vehicle("hehn2011").replace(**rod)
    hover = fp.Wrench(vehicle.weight, np.zeros(3))
    for height, tension in ((-1, 1), (1, -1)):
        state = fp.State(y=(0, 0, height))
        assert rod_tension(state, hover, vehicle) == pytest.approx(tension * vehicle.bob_mass * vehicle.g, rel=1e-14)
        assert np.max(np.abs(equations_of_motion(state, hover, vehicle, "up").packed())) < ROUNDOFF


def test_the_frame_must_have_a_known_direction():
    vehicle = fp.vehicle("hehn2011")
    with pytest.raises(fp.InputError, match=r"^e3: expected one of up, down, got 'left'"):
        gravity_vector(vehicle, "left")
    with pytest.raises(fp.InputError, match=r"^e3: expected one of up, down, got 'left'"):
        equations_of_motion(fp.State(y=(0, 0, 1)), fp.Wrench(0.0, np.zeros(3)), vehicle, "left")
