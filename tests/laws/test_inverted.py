"""The inverted law: its identities, its equilibrium, its gains, and whether it inverts; and what does not."""

import re
from types import SimpleNamespace

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

import flypend as fp
from flypend import geometry as geo
from flypend.laws import course, inverted_gains, throw
from flypend.laws.closed_loop import close_loop
from flypend.laws.inverted import SPIN_LAG
from flypend.laws.inverted_gains import SEPARATION
from flypend.laws.references import circle, hover, lemniscate, line
from flypend.model import Disturbance, disturbed_motion
from flypend.model.state import SIZE
from flypend.plants import PRESETS, Plant
from flypend.settings.laws import DETUNED
from flypend.studies import random_starts
from tests.few import each_once

property_test = settings(max_examples=60, deadline=None, derandomize=True)

VEHICLE = fp.vehicle("hehn2011")
M, m, l, g = VEHICLE.M, VEHICLE.m, VEHICLE.l, VEHICLE.g
E3 = np.array([0.0, 0, 1])
LAW = fp.laws.inverted()
BOUND = LAW.bind(VEHICLE)
GAINS = SimpleNamespace(**BOUND.gains, **BOUND.prepared)
STARTS = fp.State.random(np.random.default_rng(12345), 10)

# Accelerations of order 1e2, and some ten products of them, eps each.
ROUNDOFF = 1e-11


def _tilted():
    """The vehicle with principal axes that are not those of the body, and three different moments."""
    turn = geo.random_rotation(np.random.default_rng(0))
    return VEHICLE.replace(inertia=turn @ np.diag([3.2e-3, 2.8e-3, 5.5e-3]) @ turn.T)


def _near_upright(rng, n):
    """Random states whose rod is up, beyond where the throw ends."""
    states = fp.State.random(rng, n)
    y = geo.unit(E3 + 0.15 * geo.random_sphere(rng, (n,)))
    y_dot = geo.random_tangent(rng, y, 2.0)
    return fp.State(x=rng.uniform(-1, 1, (n, 3)), x_dot=states.x_dot, R=states.R, omega=states.omega, y=y, y_dot=y_dot)


def _along(direction, rng):
    """A rotation whose third axis is along `direction` (3,), turned about it by chance."""
    z = geo.unit(direction)
    first = geo.unit(geo.project_tangent(z, rng.standard_normal(3)))
    return np.stack([first, np.cross(z, first), z], axis=-1)


# The identity of the derivation -----------------------------------------------------------------------------------


def test_the_force_of_the_derivation_gives_rod_and_bob_what_is_asked():
    # F = −M l u + ((M+m) a + M l |ẏ|²) y + M D on the quadrotor: p̈ = −g e₃ + F_b/m + a y and ÿ + |ẏ|² y = u.
    rng = np.random.default_rng(1)
    for state in fp.State.random(rng, 100):
        y, y_dot = state.y, state.y_dot
        on_vehicle, on_bob = rng.standard_normal(3), 0.2 * rng.standard_normal(3)
        u, a = geo.tangent_part(y, 10 * rng.standard_normal(3)), 10 * rng.standard_normal()
        force = -M * l * u + ((M + m) * a + M * l * y_dot @ y_dot) * y + M * (on_bob / m - on_vehicle / M)
        turned = fp.State(x_dot=state.x_dot, R=_along(force, rng), omega=state.omega, y=y, y_dot=y_dot)
        wrench = fp.Wrench(geo.norm(force), np.zeros(3))
        rates = disturbed_motion(turned, wrench, VEHICLE, "up", Disturbance(on_vehicle, on_bob))
        np.testing.assert_allclose(rates.y_ddot + y_dot @ y_dot * y, u, rtol=0, atol=ROUNDOFF)
        bob = rates.x_ddot + l * rates.y_ddot
        np.testing.assert_allclose(bob, -g * E3 + on_bob / m + a * y, rtol=0, atol=ROUNDOFF)


def _rod_force(vehicle, reference, gains):
    """(t, x, x_dot, y, y_dot, z, force on vehicle, on bob) → the law's force on the quadrotor (3,), and the errors."""
    t = ca.SX.sym("t")
    x, x_dot, y, y_dot, z, on_vehicle, on_bob = (ca.SX.sym(name, 3) for name in ("x", "v", "y", "w", "z", "a", "b"))
    _, p, _ = throw.bob_path(reference)(t, vehicle, on_bob)
    v, a, jerk = throw.derivatives(p, t, 3)
    e, e_dot = x + vehicle.l * y - p, x_dot + vehicle.l * y_dot - v
    rod = throw.Rod(y, y_dot)
    pose = throw.Pose(throw.low_rod(rod, z, E3, gains), x[2] - reference(t)[2], np.array([1.0, 0, 0]), 1.0)
    F = throw.rod_force(throw.Bob(e, e_dot, a, jerk), rod, pose, (on_vehicle, on_bob), vehicle, gains)
    outputs = [ca.densify(value) for value in (F, e, e_dot, a, jerk)]
    function = ca.Function("rod_force", [t, x, x_dot, y, y_dot, z, on_vehicle, on_bob], outputs)
    return lambda *values: [np.array(value)[:, 0] for value in function(*values)]


def _demand(e, v, a_ref, on_bob, k):
    """A = g e₃ − F_b/m + p̈_ref + a(e, v), written again: horizontal and vertical loop with limited errors."""
    limited = e / np.sqrt(1 + e @ e / (1.8 * g / k.position_bandwidth**2) ** 2)
    w, zeta = np.array([k.position_bandwidth] * 2 + [k.height_bandwidth]), k.position_damping
    asked = -(w**2) * limited - 2 * zeta * w * v
    if asked[2] < 0:
        asked[2] /= np.sqrt(1 + (asked[2] / k.descent_limit) ** 2)
    if k.tilt_limit < np.pi / 2:
        asked[:2] /= np.sqrt(1 + asked[:2] @ asked[:2] / (0.5 * g * np.tan(k.tilt_limit)) ** 2)
    return g * E3 - on_bob / m + a_ref + asked


def test_near_upright_the_bob_does_what_its_loop_asks_and_the_rod_what_lemma_2_asks(monkeypatch):
    monkeypatch.setattr(throw, "THRUST_SHARE", 1e3)
    function = _rod_force(VEHICLE, lemniscate(0.6, 1.3), GAINS)
    k, rng, h = GAINS, np.random.default_rng(2), 1e-5
    for state in _near_upright(rng, 100):
        t, y, y_dot = rng.uniform(0, 5), state.y, state.y_dot
        on_vehicle, on_bob = 0.5 * rng.standard_normal(3), 0.05 * rng.standard_normal(3)
        F, e, v, a_ref, jerk = function(t, state.x, state.x_dot, y, y_dot, E3, on_vehicle, on_bob)
        A = _demand(e, v, a_ref, on_bob, k)
        d = geo.unit(A)
        # ḋ by a difference along the ideal bob: p̈ = −g e₃ + F_b/m + (A·y) y.
        e_ddot = (A @ y) * y - g * E3 + on_bob / m - a_ref
        ahead, behind = (geo.unit(_demand(e + s * v, v + s * e_ddot, a_ref + s * jerk, on_bob, k)) for s in (h, -h))
        d_dot = (ahead - behind) / (2 * h)
        omega_d = np.cross(d, d_dot)
        v_e = y_dot - np.cross(omega_d, y)
        u = k.rod_bandwidth**2 * geo.tangent_part(y, d) - 2 * k.rod_damping * k.rod_bandwidth * v_e
        u += (y @ omega_d) * np.cross(y, y_dot)

        turned = fp.State(x_dot=state.x_dot, R=_along(F, rng), omega=state.omega, y=y, y_dot=y_dot)
        wrench = fp.Wrench(geo.norm(F), np.zeros(3))
        rates = disturbed_motion(turned, wrench, VEHICLE, "up", Disturbance(on_vehicle, on_bob))
        np.testing.assert_allclose(rates.y_ddot + y_dot @ y_dot * y, u, rtol=0, atol=1e-6)  # h² and eps/h
        bob = rates.x_ddot + l * rates.y_ddot
        np.testing.assert_allclose(bob, -g * E3 + on_bob / m + (A @ y) * y, rtol=0, atol=1e-8)


@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_the_thrust_axis_follows_its_target_as_stated(share):
    # z̈ = −|ż|² z + u_z with u_z = ω² spring − 2 ζ ω v_e; f = F·z within what the rotors give; yaw is damped.
    vehicle, reference = _tilted(), line((0.1, 0.2, -0.3), (0.6, -0.4, 0.3))
    law = fp.laws.inverted(reference, pump_share=share).bind(vehicle)
    k, rng, h = SimpleNamespace(**law.gains, **law.prepared), np.random.default_rng(3), 1e-5
    force = _rod_force(vehicle, reference, k)
    t, packed, external = ca.SX.sym("t"), ca.SX.sym("s", SIZE), ca.SX.sym("F", 6)
    wrench = law.evaluate(t, fp.State.symbolic(packed), vehicle, (external[:3], external[3:])).wrench
    function = ca.Function("law", [t, packed, external], [ca.densify(ca.vertcat(wrench.thrust, wrench.moment))])

    low = _numeric(lambda y, y_dot, z: throw.low_rod(throw.Rod(y, y_dot), z, E3, k), (3,), (3,), (3,))

    def rod_after(tau, s):
        """The rod after coasting for `tau`, and its rate."""
        length = np.sqrt(1 + tau**2 * s["y_dot"] @ s["y_dot"])
        y = (s["y"] + tau * s["y_dot"]) / length
        return y, (s["y_dot"] - tau * (s["y_dot"] @ s["y_dot"]) * s["y"]) / length

    def force_after(tau, time, s, forces):
        """F for the rod after coasting for `tau`, from x, ẋ, y, ẏ."""
        return force(time, s["x"], s["x_dot"], *rod_after(tau, s), s["z"], *forces)[0]

    def target(time, s, forces):
        """z_d."""
        wanted = force_after(k.coast_time, time, s, forces)
        wanted[2] = max(wanted[2], np.hypot(*wanted[:2]) / np.tan(k.tilt_limit))
        wanted += 0.028 * vehicle.weight * E3
        return wanted / np.sqrt(wanted @ wanted + (0.006 * vehicle.weight) ** 2)

    largest = 4 * vehicle.rotor_limits[1]
    seen = set()
    for state in fp.State.random(rng, 60):
        time, forces = rng.uniform(0, 5), (0.5 * rng.standard_normal(3), 0.05 * rng.standard_normal(3))
        f, *moment = np.array(function(time, state.packed(), np.concatenate(forces)))[:, 0]
        here = {"x": state.x, "x_dot": state.x_dot, "y": state.y, "y_dot": state.y_dot, "z": state.z}
        F = force_after((1 - share) * k.coast_time, time, here, forces)
        assert f == pytest.approx(np.clip(F @ state.z, 0, largest), abs=1e-12)
        seen.add("none" if f == 0 else "some")

        rates = disturbed_motion(state, fp.Wrench(f, np.array(moment)), vehicle, "up", Disturbance(*forces))
        rate = {"x": rates.x_dot, "x_dot": rates.x_ddot, "y": rates.y_dot, "y_dot": rates.y_ddot}
        rate["z"] = state.R @ np.cross(state.omega, E3)
        z_d = target(time, here, forces)
        ahead, behind = (
            target(time + s, {name: here[name] + s * rate[name] for name in here}, forces) for s in (h, -h)
        )
        z_d_dot = k.rate_feedforward * (ahead - behind) / (2 * h)
        R, omega, z = state.R, state.omega, state.z
        z_dot = R @ np.cross(omega, E3)
        v_e = z_dot - np.cross(np.cross(z_d, z_d_dot), z)
        bandwidth = k.attitude_bandwidth * (1 + k.mounting.haste * low(*rod_after(k.coast_time, here), z))
        damping = 2 * k.attitude_damping * bandwidth
        spring = geo.tangent_part(z, z_d) / np.sqrt((1 + z @ z_d) / 2 + 0.014)
        spring += 0.03 * ((1 - z @ z_d) / 2) ** 4 * R[:, 0]
        turn, turn_rate = bandwidth**2 * spring, 1.3 * np.sqrt(inverted_gains.angular_authority(vehicle))
        turn /= (1 + (np.linalg.norm(turn) / (turn_rate * damping)) ** 8) ** 0.125
        u = turn - damping * v_e
        # ω̇ for z̈ = −|ż|² z + u, turned back by what the body spins while the rotors lag.
        wanted = R.T @ np.cross(z, u) + omega[2] * R.T @ z_dot
        wanted = Rotation.from_rotvec([0, 0, -2 * np.arctan(SPIN_LAG * vehicle.rotor_lag * omega[2] / 2)]).apply(wanted)
        close = 1e-5 * damping * max(1, np.max(np.abs(z_d_dot)))  # h² and eps/h in ż_d, of which damping makes u
        np.testing.assert_allclose(rates.omega_dot[:2], wanted[:2], rtol=0, atol=close)
        assert rates.omega_dot[2] == pytest.approx(-k.yaw_damping * omega[2], abs=ROUNDOFF)
    assert seen == {"none", "some"}


def _bob_path(reference, time):
    """The bob's position along `reference` at `time` and four derivatives, each (3,)."""
    t = ca.SX.sym("t")
    _, path, _ = throw.bob_path(reference)(t, VEHICLE, ca.SX.zeros(3))
    values = [ca.densify(v) for v in (path, *throw.derivatives(path, t, course.DERIVATIVES))]
    return [np.array(value)[:, 0] for value in ca.Function("path", [t], values)(time)]


def _balanced(path, rng):
    """State, and force (3,) on the quadrotor, of a bob balanced along `path`: position and four derivatives."""
    p = [ca.SX.sym(f"p{i}", 3) for i in range(course.DERIVATIVES + 1)]
    ideal, rates = course.motion(p, VEHICLE)
    motion = ca.Function("motion", p, [ca.densify(v) for v in (ideal.y, ideal.y_dot, ideal.force, rates.z)])
    y, y_dot, force, axis_dot = (np.array(value)[:, 0] for value in motion(*path))
    R = _along(force, rng)
    omega = R.T @ np.cross(R[:, 2], axis_dot)
    return fp.State(x=path[0] - l * y, x_dot=path[1] - l * y_dot, R=R, omega=omega, y=y, y_dot=y_dot), force


def test_the_motion_along_a_path_is_one_of_the_vehicle():
    """Polynomials of degree four, whose further derivatives are 0."""
    rng, h = np.random.default_rng(5), 1e-4
    close = {"rtol": 0, "atol": 1e-5}  # h² by third derivatives
    for _ in range(20):
        coefficients = rng.standard_normal((5, 3)) * np.array([1, 2, 2, 1, 0.3])[:, None]

        def balanced(t, coefficients=coefficients):
            each = [np.polynomial.Polynomial(c) for c in coefficients.T]
            return _balanced([np.array([(p.deriv(i) if i else p)(t) for p in each]) for i in range(5)], rng)

        (state, force), (later, _), (sooner, _) = (balanced(t) for t in (0.3, 0.3 + h, 0.3 - h))
        rates = disturbed_motion(state, fp.Wrench(geo.norm(force), np.zeros(3)), VEHICLE, "up")
        np.testing.assert_allclose((later.x_dot - sooner.x_dot) / (2 * h), rates.x_ddot, **close)
        np.testing.assert_allclose((later.y - sooner.y) / (2 * h), state.y_dot, **close)
        np.testing.assert_allclose((later.y_dot - sooner.y_dot) / (2 * h), rates.y_ddot, **close)
        np.testing.assert_allclose((later.z - sooner.z) / (2 * h), state.R @ np.cross(state.omega, E3), **close)


def test_along_its_path_a_balanced_rod_is_no_error_to_the_law(monkeypatch):
    monkeypatch.setattr(throw, "THRUST_SHARE", 1e3)  # without the limit of thrust, which is soft
    rng = np.random.default_rng(6)
    for reference in (lemniscate(0.6, 1.3), circle(1.5, 2.0)):
        law = fp.laws.inverted(reference).bind(VEHICLE)
        t, packed = ca.SX.sym("t"), ca.SX.sym("s", SIZE)
        asked = law.evaluate(t, fp.State.symbolic(packed), VEHICLE)
        thrust = ca.Function("thrust", [t, packed], [asked.wrench.thrust])
        for time in rng.uniform(0, 5, 10):
            state, force = _balanced(_bob_path(reference, time), rng)
            assert float(thrust(time, state.packed())) == pytest.approx(geo.norm(force), rel=1e-9)


@pytest.mark.parametrize(("speed", "within"), [(3.0, 0.10), (4.0, 0.20)])
def test_a_circle_is_flown_on_its_line(speed, within):
    """On rotors that lag, which the law knows, with half of the flight to settle."""
    reference = circle(1.5, speed / 1.5)
    law = fp.laws.inverted(reference).bind(VEHICLE)
    start, _ = _balanced(_bob_path(reference, 0.0), np.random.default_rng(0))
    run = fp.simulate(VEHICLE, law, start, 12.0, plant="rotors")
    late = run.t >= 6
    off = geo.norm(run.x - run.x_ref)[late]
    assert np.sqrt(np.mean(off**2)) < within / 2
    assert np.min(run.y[late, 2]) > 0


# The parts ---------------------------------------------------------------------------------------------------------


def _numeric(function, *shapes):
    symbols = [ca.SX.sym(f"v{i}", *shape) for i, shape in enumerate(shapes)]
    value = function(*symbols)
    values = value if isinstance(value, tuple) else (value,)
    compiled = ca.Function("f", symbols, [ca.densify(v) for v in values])

    def call(*arguments):
        out = compiled(*arguments)
        out = [np.array(v)[:, 0] for v in (out if isinstance(out, tuple) else (out,))]
        return out if isinstance(value, tuple) else out[0] if len(out[0]) > 1 else float(out[0][0])

    return call


STEP = _numeric(throw.smooth_step, ())
SOFT = _numeric(throw.soft, (3,), ())
LIMITED = _numeric(throw.limit_force, (3,), ())
LIFTED = _numeric(throw.lift, (3,), ())
COASTED = _numeric(lambda y, y_dot, time: throw.coast(throw.Rod(y, y_dot), time), (3,), (3,), ())
vectors = arrays(float, 3, elements=st.floats(-1e3, 1e3))


def test_the_step_is_constant_outside_and_twice_differentiable():
    outside = [(-1e9, 0), (-1e-3, 0), (0, 0), (1, 1), (1.001, 1), (1e9, 1)]
    assert [STEP(q) for q, _ in outside] == [value for _, value in outside]  # exactly
    q = np.linspace(0, 1, 101)
    values = np.array([STEP(v) for v in q])
    assert np.all(np.diff(values) > 0)
    np.testing.assert_allclose(values + values[::-1], 1, rtol=0, atol=5e-15)  # odd about the middle; of terms of 10
    h = 1e-4
    for edge in (0, 1):  # slope 30 q² (1 − q)² and its rate are continuous: within 10 h³ of the edge's value at h
        assert abs(STEP(edge + h) - STEP(edge)) < 11 * h**3
        assert abs(STEP(edge - h) - STEP(edge)) < 11 * h**3
    assert (STEP(0.5 + h) - STEP(0.5 - h)) / (2 * h) == pytest.approx(1.875, abs=1e-6)


@property_test
@given(value=vectors, limit=st.floats(0.1, 10))
def test_a_soft_limit_is_never_passed_and_leaves_the_small_alone(value, limit):
    got, length = SOFT(value, limit), np.linalg.norm(value)
    assert np.linalg.norm(got) <= limit * (1 + 1e-15)
    assert np.linalg.norm(got) == pytest.approx(length / np.hypot(1, length / limit), rel=1e-12)
    np.testing.assert_allclose(np.cross(got, value), 0, atol=1e-12 * max(1, length) * limit)
    assert got @ value >= 0
    small = 1e-3 * limit * geo.unit(value + E3 * (length == 0))
    np.testing.assert_allclose(SOFT(small, limit), small, rtol=0, atol=1e-6 * 1e-3 * limit)  # (1e-3)²/2 of it


@property_test
@given(force=vectors, limit=st.floats(0.1, 100))
def test_a_limited_force_keeps_its_direction_and_its_limit_and_hardly_shifts_hover(force, limit):
    got, length = LIMITED(force, limit), np.linalg.norm(force)
    assert np.linalg.norm(got) <= limit * (1 + 1e-15)
    assert np.linalg.norm(got) <= length * (1 + 1e-15)
    np.testing.assert_allclose(np.cross(got, force), 0, atol=1e-12 * max(1, length) * limit)
    ratio = length / limit
    if ratio < 1 / 2:  # a soft one would take ratio²/2, 12 % at half the limit
        assert np.linalg.norm(got) >= length * (1 - ratio**8 / 8) - 1e-14 * length
    if ratio > 2:
        assert np.linalg.norm(got) > 0.999 * limit


@property_test
@given(force=vectors, tilt=st.floats(0.1, 3.1))
def test_a_lifted_force_leans_no_further_than_allowed_and_is_left_alone_within(force, tilt):
    got = LIFTED(force, tilt)
    np.testing.assert_array_equal(got[:2], force[:2])
    assert got[2] >= force[2]
    least = np.hypot(*force[:2]) / np.tan(tilt)  # of the vertical part, for that lean
    assert got[2] >= least - 1e-4  # a floor of 1e-6 N under the root, and roundoff of 1e3 · cot
    if force[2] > least:
        np.testing.assert_allclose(got, force, rtol=0, atol=1e-4)


def test_pumping_brings_the_energy_of_the_rod_to_its_value_upright():
    # E = |ẏ|²/2 + w² y₃ under F = (M+m) g e₃ + …: Ė = κ (1 − E/w²) ẏ · push, push = ẏ but for a nudge at rest.
    pumping, rate_of_energy = SimpleNamespace(**(vars(GAINS) | {"pump_share": 1.0})), 2 * np.sqrt(g / l)
    aside = np.array([1.0, 0, 0])
    force = _numeric(
        lambda A, y, y_dot: throw.pumping_force(A, throw.Rod(y, y_dot), aside, VEHICLE, pumping), (3,), (3,), (3,)
    )
    w_squared = VEHICLE.weight / (M * l)
    signs = set()
    for state in fp.State.random(np.random.default_rng(5), 50):
        y, y_dot = state.y, 2 * state.y_dot
        F = force(g * E3, y, y_dot)
        y_ddot = -geo.tangent_part(y, F) / (M * l) - y_dot @ y_dot * y  # (ddty)
        missing = 1 - (y_dot @ y_dot / 2 / w_squared + y[2])
        push = y_dot + GAINS.mounting.shift * np.sqrt(w_squared) * np.array([1.0, 0, 0])
        rate = y_dot @ y_ddot + w_squared * y_dot[2]
        circling = E3 @ np.cross(y, y_dot)  # damped besides, which costs energy
        assert rate == pytest.approx(rate_of_energy * (missing * (y_dot @ push) - 0.4 * circling**2), abs=1e-9)
        assert E3 @ np.cross(y, y_ddot) == pytest.approx(
            rate_of_energy * (missing * (E3 @ np.cross(y, push)) - 0.4 * (y[0] ** 2 + y[1] ** 2) * circling), abs=1e-9
        )
        signs.add(missing > 0)
    assert signs == {True, False}


@property_test
@given(seed=st.integers(0, 10**6), time=st.floats(0, 0.5))
def test_a_coasted_rod_is_a_rod_turned_on_with_its_speed(seed, time):
    rng = np.random.default_rng(seed)
    y = geo.random_sphere(rng)
    y_dot = geo.random_tangent(rng, y, 10.0)
    ahead, rate = COASTED(y, y_dot, time)
    speed = np.linalg.norm(y_dot)
    assert np.linalg.norm(ahead) == pytest.approx(1, abs=1e-14)
    assert ahead @ rate == pytest.approx(0, abs=1e-13)
    assert np.linalg.norm(rate) == pytest.approx(speed, rel=1e-12)
    np.testing.assert_allclose(np.cross(ahead, rate), np.cross(y, y_dot), rtol=0, atol=1e-13)  # in the same plane
    angle = np.arctan2(np.linalg.norm(np.cross(y, ahead)), y @ ahead)
    assert angle == pytest.approx(np.arctan(speed * time), abs=1e-12)


def test_the_throw_ends_and_the_flip_is_allowed_where_the_gains_say():
    low = _numeric(lambda y, y_dot, z: throw.low_rod(throw.Rod(y, y_dot), z, E3, GAINS), (3,), (3,), (3,))
    allowed = _numeric(lambda y, h, v: throw.flip_permission(y, h, v, VEHICLE, GAINS), (3,), (), ())

    def rod(y_3):
        return np.array([np.sqrt(1 - y_3**2), 0, y_3])

    # At rest the lean is 1 − y₃ + catch_by_axis z·P_y e₃, and with the axis along the rod the last term is 0.
    still, within, width = np.zeros(3), GAINS.catch_within, GAINS.catch_width
    for axis, lean in (("rod", lambda c: 1 - c), ("e₃", lambda c: 1 - c + GAINS.catch_by_axis * (1 - c**2))):
        for share, value in ((-1e-9, 0.0), (0.5, 0.5), (1 + 1e-9, 1.0)):
            c = brentq(lambda c, at=within + share * width, lean=lean: lean(c) - at, -1, 1)
            assert low(rod(c), still, E3 if axis == "e₃" else rod(c)) == pytest.approx(value, abs=1e-12)
    assert low(E3, still, np.array([0.6, 0, 0.8])) == 0
    assert low(-E3, still, E3) == 1
    # A rod that rises counts as it will be after catch_time; one that falls, too.
    middle = rod(1 - within - 0.5 * width)
    rising = 0.3 * geo.unit(geo.tangent_part(middle, E3))
    assert low(middle, rising, middle) < low(middle, still, middle) < low(middle, -rising, middle)
    # v + flip_by_height h + flip_by_rod y₃ passes flip_speed, in a band of 0.2 √(g l).
    width = 0.2 * np.sqrt(g * l)
    for y_3, height in ((-1.0, 0.0), (0.3, 0.4), (0.0, -1.0)):
        edge = GAINS.flip_speed - GAINS.flip_by_height * height - GAINS.flip_by_rod * y_3
        assert allowed(rod(y_3), height, edge - 1e-9) == 0
        assert allowed(rod(y_3), height, edge + width / 2) == pytest.approx(0.5)
        assert allowed(rod(y_3), height, edge + width + 1e-9) == 1


# Gains -------------------------------------------------------------------------------------------------------------


def _similar(vehicle, s):
    """The geometrically similar vehicle of the same density: times go with √s, so that gravity stays."""
    return vehicle.replace(
        mass=vehicle.M * s**3,
        bob_mass=vehicle.m * s**3,
        rod_length=vehicle.l * s,
        inertia=vehicle.I * s**5,
        rotor_positions=vehicle.rotor_positions * s,
        drag_ratio=vehicle.drag_ratio * s,
        rotor_limits=vehicle.rotor_limits * s**3,
        rotor_lag=vehicle.rotor_lag * np.sqrt(s),
    )


# Power of s by which a gain goes: of times 1/2, speeds 1/2, bandwidths −1/2, accelerations and numbers 0.
POWERS = {name: -0.5 for name in LAW.gains if name.endswith("_bandwidth")} | {
    "coast_time": 0.5, "throw_speed": 0.5, "flip_speed": 0.5, "flip_by_rod": 0.5, "flip_by_height": -0.5,
    "catch_time": 0.5,
}  # fmt: skip
# In s and 1/s whatever the vehicle: they belong to the sensors and the computer, and to yaw, which nothing waits for.
ABSOLUTE = ("latency", "yaw_damping", "observer")


@pytest.mark.parametrize("s", [0.3, 0.7, 2.0])
def test_the_gains_of_a_similar_vehicle_are_the_same_pure_numbers(s):
    ours, theirs = (LAW.gains_for(vehicle) for vehicle in (VEHICLE, _similar(VEHICLE, s)))
    assert set(ours) == set(LAW.gains)
    assert theirs.pop("form") == ours.pop("form") == "full"
    for name in set(ours) - set(ABSOLUTE):
        assert theirs[name] == pytest.approx(ours[name] * s ** POWERS.get(name, 0.0), rel=1e-12), name
    for name in ABSOLUTE[1:]:
        assert theirs[name] == ours[name]
    assert theirs["latency"] <= ours["latency"] * max(1, np.sqrt(s)) * (1 + 1e-12)


def test_a_similar_vehicle_flies_a_similar_flight():
    # Lengths with s, times with √s, in the ideal plant; yaw, whose damping is absolute, is scaled by hand.
    s = 0.4
    start = STARTS[3]
    small = fp.State(
        x_dot=start.x_dot * np.sqrt(s),
        R=start.R,
        omega=start.omega / np.sqrt(s),
        y=start.y,
        y_dot=start.y_dot / np.sqrt(s),
    )
    times = np.linspace(0, 4, 41)
    ours = fp.simulate(VEHICLE, LAW, start, 4.0, times=times, plant="ideal")
    law = fp.laws.inverted(yaw_damping=GAINS.yaw_damping / np.sqrt(s))
    theirs = fp.simulate(_similar(VEHICLE, s), law, small, 4.0 * np.sqrt(s), times=times * np.sqrt(s), plant="ideal")
    # rtol 1e-9, grown by the throw, in which errors double some ten times.
    np.testing.assert_allclose(theirs.x / s, ours.x, rtol=0, atol=1e-4)
    np.testing.assert_allclose(theirs.y, ours.y, rtol=0, atol=1e-4)
    np.testing.assert_allclose(theirs.R, ours.R, rtol=0, atol=1e-3)
    assert np.max(geo.norm(ours.x)) > 0.3


@pytest.mark.parametrize(
    ("gains", "message"),
    [
        ({"rod_bandwith": 5}, "rod_bandwith: expected one of position_bandwidth"),
        ({"rod_bandwidth": 0}, "rod_bandwidth: expected a finite number > 0 rad/s, got 0"),
        ({"rod_damping": "much"}, "rod_damping: expected a finite number > 0, got 'much'"),
        ({"throw_speed": -1}, "throw_speed: expected a finite number >= 0 m/s, got -1"),
        ({"flip_speed": np.nan}, "flip_speed: expected a finite number m/s, got nan"),
        ({"descent_limit": 0}, "descent_limit: expected a finite number > 0 m/s², got 0"),
        ({"pump_share": 1.1}, "pump_share: expected at most 1, got 1.1"),
        ({"rate_feedforward": 1.01}, "rate_feedforward: expected at most 1, got 1.01"),
        ({"hanging_share": 2}, "hanging_share: expected at most 1, got 2"),
        ({"tilt_limit": 3.2}, "tilt_limit: expected at most 3.14159 rad, got 3.2"),
        ({"lead": 0.9}, "lead: expected a finite number >= 1, got 0.9"),
        ({"hanging_share": -0.1}, "hanging_share: expected a finite number >= 0, got -0.1"),
        ({"hanging_share": 1.001}, "hanging_share: expected at most 1, got 1.001"),
        ({"form": "heavy"}, "form: expected one of full, light, got 'heavy'"),
        ({"catch_within": 0}, "catch_within: expected a finite number > 0, got 0"),
    ],
)
def test_unknown_gains_and_gains_out_of_range_are_refused_in_one_line(gains, message):
    with pytest.raises(fp.InputError, match="^" + re.escape(message)) as caught:
        fp.laws.inverted(**gains)
    assert "\n" not in str(caught.value)
    if "rod_bandwith" in gains:
        assert "did you mean 'rod_bandwidth'?" in str(caught.value)


def test_bandwidths_that_are_not_separated_are_refused():
    slow, middle, fast = GAINS.position_bandwidth, GAINS.rod_bandwidth, GAINS.attitude_bandwidth
    on_the_edge = [
        ("rod_bandwidth", SEPARATION * slow, 1.001, 0.999),
        ("rod_bandwidth", fast / SEPARATION, 0.999, 1.001),
        ("position_bandwidth", middle / SEPARATION, 0.999, 1.001),
        ("attitude_bandwidth", SEPARATION * middle, 1.001, 0.999),
    ]
    for name, edge, inside, outside in on_the_edge:
        assert fp.laws.inverted(**{name: inside * edge}).bind(VEHICLE).gains[name] == inside * edge
        with pytest.raises(
            fp.InputError,
            match=r"^(rod|attitude)_bandwidth: expected at least 1\.5 times the (position|rod)_bandwidth, ",
        ):
            fp.laws.inverted(**{name: outside * edge}).bind(VEHICLE)
    with pytest.raises(fp.InputError, match=r"^(rod|attitude)_bandwidth: "):
        fp.simulate(VEHICLE, fp.laws.inverted(rod_bandwidth=100), fp.State(y=E3), 1.0, plant="ideal")


def test_calming_moves_the_gains_that_were_not_given():
    calm = BOUND.calm_by(0.5)
    assert (BOUND.calm, calm.calm) == (0.0, 0.5)
    assert BOUND.calm_by(0.0) is calm.calm_by(0.0) is BOUND
    moved = set(calm.prepared["calming"])
    assert "coast_time" in moved
    given = fp.laws.inverted(coast_time=BOUND.gains["coast_time"]).bind(VEHICLE)
    assert set(given.calm_by(0.5).prepared["calming"]) == moved - {"coast_time"}


def test_the_law_is_bound_once_per_vehicle():
    law = fp.laws.inverted(rod_damping=0.5)
    bound = law.bind(VEHICLE)
    assert law.bind(fp.vehicle("hehn2011")) is bound  # the same numbers are the same vehicle
    assert law.bind(VEHICLE.replace(mass=0.6)) is not bound
    assert bound.bind(VEHICLE) is bound
    assert bound.gains["rod_damping"] == 0.5
    assert {name: value for name, value in bound.gains.items() if name != "rod_damping"} == {
        name: value for name, value in BOUND.gains.items() if name != "rod_damping"
    }
    assert (bound.computer.lead, bound.computer.latency, bound.computer.observer) == (
        GAINS.lead, GAINS.latency, GAINS.observer,
    )  # fmt: skip
    with pytest.raises(fp.InputError, match=r"^law: expected one bound to hehn2011, got inverted bound to crazyflie$"):
        fp.simulate(VEHICLE, law.bind(fp.vehicle("crazyflie")), fp.State(y=E3), 1.0)


# The equilibrium -----------------------------------------------------------------------------------------------


def test_inverted_hover_is_an_equilibrium_but_for_what_the_limited_force_takes():
    position = np.array([1.0, -2, 0.5])
    loop = close_loop(VEHICLE, fp.laws.inverted(hover(position)).bind(VEHICLE))
    for yaw in (0.0, 1.0, -2.5):
        state = fp.State(x=position, R=Rotation.from_rotvec([0, 0, yaw]).as_matrix(), y=E3)
        rates = np.array(loop.rates(0, state.packed()))[:, 0]
        ratio = VEHICLE.weight / (throw.THRUST_SHARE * 4 * VEHICLE.rotor_limits[1])
        assert rates[5] == pytest.approx(-g * ratio**8 / 8, rel=0.01)  # ẍ₃: a few 1e-4 m/s²
        np.testing.assert_allclose(np.delete(rates, 5), 0, rtol=0, atol=1e-12)
    # The vehicle then rests where the height loop gives that back.
    sag = g * ratio**8 / 8 / GAINS.height_bandwidth**2
    low = fp.State(x=position - sag * E3, y=E3)
    assert np.max(np.abs(np.array(loop.rates(0, low.packed())))) < 0.01 * g * ratio**8 / 8
    moved = fp.State(x=position + np.array([0.1, 0, 0]), y=E3)
    assert np.max(np.abs(np.array(loop.rates(0, moved.packed())))) > 1  # negative control


# Flights ---------------------------------------------------------------------------------------------------------


def _succeeds(run):
    """Upright and at its reference during the last second."""
    last = run.t >= run.t[-1] - 1
    return (
        run.outcome.status == "completed"
        and np.max(geo.norm(run.y - E3)[last]) < 0.05
        and np.max(geo.norm(run.z - E3)[last]) < 0.05
        and np.max(geo.norm(run.x - run.x_ref)[last]) < 0.2
    )


def _excursion(run):
    return np.max(geo.norm(run.x - run.x_ref))


ROTORS = PRESETS["rotors"]
HARDER = {
    "20 ms lag, 500 Hz": ROTORS,
    "lag 50 ms": ROTORS.replace(lag=0.05),
    "delay 30 ms": ROTORS.replace(delay=0.03),
    "50 Hz": ROTORS.replace(rate=50.0),
}


@pytest.mark.parametrize("name", HARDER)
def test_from_random_starts_it_inverts_under_real_rotors(name):
    result = fp.simulate_ensemble(VEHICLE, LAW, random_starts(400, 11), 10.0, plant=HARDER[name])
    assert np.all(result.success)  # 2000 of 2000 on another seed: docs/laws/inverted.md
    assert result.percentile("excursion", 95) < 2.5  # m; 2.0 to 2.1
    low, high = VEHICLE.rotor_limits
    assert np.all(result.peak_force <= high)
    assert np.all(result.peak_force > low)


def test_the_proposed_gains_invert_a_vehicle_of_thirty_grams():
    small = fp.vehicle("crazyflie")
    result = fp.simulate_ensemble(small, LAW, random_starts(400, 11), 10.0, plant="rotors")
    assert np.all(result.success)
    assert result.percentile("excursion", 95) < 2.7  # m; with a rod of 0.5 m and 72 ms of lag


def test_a_vehicle_too_slow_to_flip_levels_pumps_and_stands(monkeypatch):
    slow, starts = fp.vehicle("nayak2018"), random_starts(200, 11)
    result = fp.simulate_ensemble(slow, LAW, starts, 20.0, plant="rotors")
    assert result.rate > 0.95  # 496 of 500 on another seed: docs/laws/inverted.md
    assert result.percentile("excursion", 95) < 40  # m: it falls while it turns over
    # Negative control: the gains of an agile vehicle, scaled to this one, throw and flip in vain.
    with monkeypatch.context() as patched:
        patched.setattr(inverted_gains, "PUMPING", {})
        agile = LAW.gains_for(slow)
    lost = fp.simulate_ensemble(slow, fp.laws.inverted(**agile), starts, 20.0, plant="rotors")
    assert lost.rate < 0.05


def _turning(share):
    """The vehicle of hehn2011 with an agility of `share` of the least with which one flips its rod."""
    slower = inverted_gains.scales(VEHICLE).agility / (share * inverted_gains.LEAST_AGILITY)
    return VEHICLE.replace(inertia=slower * VEHICLE.I)


def test_what_differs_for_a_vehicle_that_pumps_sets_in_where_it_turns_too_slowly():
    pumping, flipping = (LAW.gains_for(_turning(share)) for share in (0.999, 1.001))
    ours = LAW.gains_for(VEHICLE)
    assert pumping.pop("form") == flipping.pop("form") == ours.pop("form")
    different = {name for name in ours if pumping[name] != pytest.approx(flipping[name], rel=2e-3)}
    assert different == {
        "pump_share", "tilt_limit", "position_bandwidth", "height_bandwidth", "position_damping", "rod_bandwidth",
        "rod_damping", "attitude_damping", "coast_time", "descent_limit", "catch_width", "catch_time", "catch_by_axis",
    }  # fmt: skip
    assert {name for name in ours if flipping[name] != pytest.approx(ours[name])} == {
        "attitude_bandwidth", "coast_time"
    }  # fmt: skip


@pytest.mark.parametrize("share", [0.95, 1.05])
def test_on_either_side_of_that_border_it_inverts(share):
    result = fp.simulate_ensemble(_turning(share), LAW, random_starts(100, 11), 20.0, plant="rotors")
    assert result.rate > 0.95


def test_a_vehicle_whose_rotors_lag_too_much_for_a_flip_pumps(monkeypatch):
    vehicle = VEHICLE.replace(
        bob_mass=0.2, inertia=VEHICLE.I / 1.4, rotor_limits=tuple(np.multiply(VEHICLE.rotor_limits, (1, 1.4)))
    )
    vehicle = vehicle.replace(rotor_lag=0.46 * np.sqrt(vehicle.l / vehicle.g))
    starts = random_starts(48, 11)
    assert fp.simulate_ensemble(vehicle, LAW, starts, 30.0, plant="rotors").rate > 0.95
    # Negative control: it is agile enough to flip, and misses half of the catches.
    monkeypatch.setattr(inverted_gains, "MOST_LAG", np.inf)
    flipping = fp.laws.inverted()
    assert flipping.gains_for(vehicle)["pump_share"] == 0
    assert fp.simulate_ensemble(vehicle, flipping, starts, 30.0, plant=fp.Plant(seed=1)).rate < 0.7


@pytest.mark.parametrize("i", range(3))
def test_rotor_forces_stay_within_their_limits(i):
    run = fp.simulate(VEHICLE, LAW, STARTS[i], 10.0, plant="rotors")
    assert _succeeds(run)
    assert _excursion(run) < 3
    low, high = VEHICLE.rotor_limits
    assert np.all((run.rotor_forces >= low) & (run.rotor_forces <= high))


@pytest.mark.parametrize("i", range(5))
def test_from_random_starts_it_inverts_in_the_ideal_plant(i):
    run = fp.simulate(VEHICLE, LAW, STARTS[i], 10.0, plant="ideal")
    assert _succeeds(run)
    assert _excursion(run) < 3
    np.testing.assert_allclose(run.x[-1], 0, atol=2e-4)  # the sag of hover


@pytest.mark.parametrize("i", range(3))
def test_mujoco_agrees_that_it_inverts(i):
    run = fp.simulate(VEHICLE, LAW, STARTS[i], 10.0, plant="mujoco")
    assert _succeeds(run)
    ours = fp.simulate(VEHICLE, LAW, STARTS[i], 10.0, plant="rotors")
    # They share no equation of motion. Steps of 0.5 and 1 ms leave 1e-7, which the throw lets grow.
    assert _excursion(run) == pytest.approx(_excursion(ours), rel=1e-3)
    np.testing.assert_allclose(run.x, ours.x, rtol=0, atol=1e-3)
    np.testing.assert_allclose(run.y, ours.y, rtol=0, atol=1e-2)


UPSIDE_DOWN = Rotation.from_rotvec([np.pi - 1e-3, 0, 0]).as_matrix()


@pytest.mark.parametrize("plant", ["ideal", "rotors"])
@pytest.mark.parametrize(
    "start",
    [
        fp.State(y=-E3),  # at rest hanging, where people start
        fp.State(R=UPSIDE_DOWN, y=E3),
        fp.State(R=np.diag([1.0, -1, -1]), y=E3),
        fp.State(R=UPSIDE_DOWN, y=-E3),
        fp.State(x=(4, -3, 2), y=E3),
        fp.State(omega=(0, 0, 20), y=(0.6, 0, 0.8)),
        fp.State(omega=(0, 0, 40), y=-E3),
    ],
)
def test_it_inverts_from_where_a_pull_vanishes_from_afar_and_spinning(plant, start):
    run = fp.simulate(VEHICLE, LAW, start, 10.0, plant=plant)
    assert _succeeds(run)
    assert abs(run.omega[-1, 2]) < 1e-3


def test_inverted_at_rest_it_stays():
    run = fp.simulate(VEHICLE, LAW, fp.State(y=E3), 3.0, plant="ideal")
    assert _excursion(run) < 2e-4
    assert np.max(geo.norm(run.y - E3)) < 1e-12
    run = fp.simulate(VEHICLE, LAW, fp.State(y=E3), 3.0, plant="rotors")
    assert _excursion(run) < 0.1  # rotors begin at their least force
    assert np.max(geo.norm(run.y - E3)) < 1e-10  # roundoff, which the fall of the first instants lets grow


FOLLOWED = {
    "hover": (hover((1, -2, 0.5)), 5e-4),
    "line": (line((0, 0, 0), (1.0, 0.5, 0.2)), 5e-4),
    # What is left on a curve: two steps of the fixed point, a share of the rate of z_d and none of ÿ_d.
    "circle": (circle(0.5, 1.0), 0.02),
    "lemniscate": (lemniscate(1.0, 1.0), 0.1),
}


@pytest.mark.parametrize(("name", "plant"), each_once(FOLLOWED, ("ideal", "rotors")))
def test_it_holds_and_follows_a_reference(name, plant):
    reference, error = FOLLOWED[name]
    run = fp.simulate(VEHICLE, fp.laws.inverted(reference), fp.State(y=E3), 8.0, plant=plant)
    last = run.t > 6
    assert np.max(geo.norm(run.x - run.x_ref)[last]) < error
    assert np.min(run.y[last, 2]) > 0.95
    moved = np.max(geo.norm(run.x_ref - run.x_ref[0]))
    assert moved > 0.9 or np.all(run.x_ref == [1, -2, 0.5])  # it is that reference that was followed


# What does not invert: negative controls ------------------------------------------------------------------------


@pytest.mark.parametrize("i", range(3))
def test_the_law_of_the_paper_hangs_and_falls(i):
    law = fp.laws.corrected(k_d=1, k_1=9, k_2=4)
    run = fp.simulate(VEHICLE, law, STARTS[i].flipped(), 10.0, plant="rotors").flipped()
    assert not _succeeds(run)
    assert run.y[-1, 2] < -0.9
    assert run.x[-1, 2] < -50


@pytest.mark.parametrize("detuned", [DETUNED, {"rate_feedforward": 0.0}])
def test_a_detuned_law_does_not_invert(detuned):
    law = fp.laws.inverted(**detuned)
    runs = [fp.simulate(VEHICLE, law, STARTS[i], 10.0, plant="rotors") for i in range(3)]
    assert not any(_succeeds(run) for run in runs)


def test_a_pendulum_that_hangs_at_its_reference_is_no_success():
    hanging = fp.Law(
        name="hang",
        e3="up",
        control=lambda t, state, vehicle, k: fp.Wrench(
            vehicle.weight - 2 * state.x[2] - 2 * state.x_dot[2], -0.1 * state.omega
        ),
    )
    run = fp.simulate(VEHICLE, hanging, fp.State(y=-E3), 10.0, plant="ideal")
    assert geo.norm(run.x[-1]) < 0.2
    assert not _succeeds(run)


def test_the_plant_of_hehn_and_dandrea_takes_the_same_law():
    run = fp.simulate(VEHICLE, LAW, STARTS[0], 10.0, plant="hehn2011")
    assert _succeeds(run)
    slow = fp.simulate(VEHICLE, LAW, STARTS[0], 10.0, plant=Plant(rate=50.0, delay=0.02))
    assert _succeeds(slow)


@pytest.mark.parametrize("seed", range(20))
def test_a_force_within_the_cone_of_the_mount_lacks_nothing_and_another_gets_to_its_edge(seed):
    rng = np.random.default_rng(seed)
    F, y, cone = rng.standard_normal(3), geo.unit(rng.standard_normal(3)), rng.uniform(0.2, 1.4)
    lacking = float(throw.missing_along(ca.DM(F), ca.DM(y), cone))
    angle = np.arccos(F @ y / np.linalg.norm(F))
    if angle <= cone:
        assert lacking == 0
    else:
        raised = F + lacking * y
        assert np.arccos(raised @ y / np.linalg.norm(raised)) == pytest.approx(cone, abs=1e-9)
