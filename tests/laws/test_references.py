"""Reference trajectories: what they are, their derivatives, and what the bob does above them."""

import re

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend import geometry as geo
from flypend.laws.references import circle, hover, lemniscate, line, sample
from flypend.laws.throw import bob_path, derivatives

VEHICLE = fp.vehicle("hehn2011")
SUPPORT = np.array([0, 0, VEHICLE.g])
NO_FORCE = np.zeros(3)
FORCE = np.array([0.05, -0.03, 0.08])  # on the bob, N: a tenth of its weight each

REFERENCES = {
    "hover": hover((1, -2, 3)),
    "line": line((1, 2, 3), (0.5, -0.4, 0.3)),
    "circle": circle(0.8, -1.7, (1, 2, 3)),
    "lemniscate": lemniscate(1.2, 1.1, (-1, 0, 2)),
}
each = pytest.mark.parametrize("name", REFERENCES)
TIMES = np.linspace(0, 7, 29)


def _bob(reference, on_bob=NO_FORCE):
    """p, its first three derivatives and y, each (n, 3), at times (n,)."""
    t = ca.SX.sym("t")
    _, p, y = bob_path(reference)(t, VEHICLE, ca.DM(on_bob))
    values = [ca.densify(v) for v in (p, *derivatives(p, t, 3), y)]
    function = ca.Function("bob", [t], values)
    return lambda times: [np.array(value).T for value in function(np.asarray(times)[None, :])]


def _difference(function, t, h):
    """Central difference of fourth order."""
    return (8 * (function(t + h) - function(t - h)) - (function(t + 2 * h) - function(t - 2 * h))) / (12 * h)


# The references themselves ---------------------------------------------------------------------------------------


def test_hover_stays():
    np.testing.assert_array_equal(sample(REFERENCES["hover"], TIMES), np.tile([1.0, -2, 3], (len(TIMES), 1)))


def test_a_line_is_left_with_its_velocity():
    expected = np.array([1, 2, 3]) + TIMES[:, None] * [0.5, -0.4, 0.3]
    np.testing.assert_allclose(sample(REFERENCES["line"], TIMES), expected, rtol=1e-15)


def test_a_circle_has_its_radius_rate_and_sense():
    from_center = sample(REFERENCES["circle"], TIMES) - [1, 2, 3]
    np.testing.assert_allclose(geo.norm(from_center), 0.8, rtol=1e-14)
    np.testing.assert_array_equal(from_center[:, 2], 0)
    np.testing.assert_allclose(from_center[0], [0.8, 0, 0], atol=1e-15)
    turned = np.unwrap(np.arctan2(from_center[:, 1], from_center[:, 0]))
    np.testing.assert_allclose(turned, -1.7 * TIMES, rtol=0, atol=1e-13)


def test_a_lemniscate_is_gerono_s_and_passes_its_crossing_twice_a_period():
    a, period = 1.2, 2 * np.pi / 1.1
    t = np.linspace(0, period, 400, endpoint=False)
    x, y, z = (sample(REFERENCES["lemniscate"], t) - [-1, 0, 2]).T
    np.testing.assert_allclose(x**4, a**2 * (x**2 - y**2), rtol=0, atol=1e-14)
    np.testing.assert_array_equal(z, 0)
    assert np.max(x) == pytest.approx(a, rel=1e-4)  # a sample within 1/400 of a period
    assert np.min(x) == pytest.approx(-a, rel=1e-4)
    assert np.sum(np.diff(np.sign(x + 1e-9)) != 0) == 2 - 1  # once more at the end of the period
    np.testing.assert_allclose(sample(REFERENCES["lemniscate"], t + period), np.array([x - 1, y, z + 2]).T, atol=1e-13)


@each
def test_derivatives_from_the_symbols_are_those_of_finite_differences(name):
    reference, t = REFERENCES[name], ca.SX.sym("t")
    value = ca.densify(reference(t))
    for _ in range(3):
        rate = ca.densify(ca.jacobian(value, t))
        functions = [ca.Function("f", [t], [v]) for v in (value, rate)]
        position, velocity = (lambda times, f=f: np.array(f(times[None, :])).T for f in functions)
        wanted = _difference(position, TIMES, 1e-2)  # h⁴/30 of a fifth to seventh derivative, below 2.2⁷ · 0.6
        np.testing.assert_allclose(velocity(TIMES), wanted, rtol=0, atol=1e-7)
        value = rate


# The bob above a reference ---------------------------------------------------------------------------------------


@each
@pytest.mark.parametrize("on_bob", [NO_FORCE, FORCE])
def test_the_bob_is_a_rod_away_and_its_derivatives_are_those_of_its_position(name, on_bob):
    bob = _bob(REFERENCES[name], on_bob)
    p, *rates, y = bob(TIMES)
    np.testing.assert_allclose(geo.norm(y), 1, rtol=0, atol=1e-15)
    np.testing.assert_allclose(p, sample(REFERENCES[name], TIMES) + VEHICLE.l * y, rtol=0, atol=1e-14)
    for order, rate in enumerate(rates):
        wanted = _difference(lambda t, k=order: bob(t)[k], TIMES, 5e-3)  # errors go with h⁴: 1e-6
        np.testing.assert_allclose(rate, wanted, rtol=0, atol=1e-6 * max(1, np.max(np.abs(rate))))


@pytest.mark.parametrize("name", ["hover", "line"])
def test_without_acceleration_the_rod_leans_against_the_force_on_the_bob(name):
    for on_bob in (NO_FORCE, FORCE):
        _, v, a, jerk, y = _bob(REFERENCES[name], on_bob)(TIMES)
        expected = geo.unit(SUPPORT - on_bob / VEHICLE.m)
        np.testing.assert_allclose(y, np.tile(expected, (len(TIMES), 1)), rtol=0, atol=1e-15)
        np.testing.assert_allclose(v, np.gradient(sample(REFERENCES[name], TIMES), TIMES, axis=0), rtol=0, atol=1e-12)
        np.testing.assert_array_equal(a, 0)
        np.testing.assert_array_equal(jerk, 0)


def _lean_on_circle(radius, rate):
    """Outward component s of the rod that turns with a circle: s = −ω² ρ/√(g² + ω⁴ ρ²), ρ = r + l s the bob's radius.

    By bisection: the right side falls with s.
    """
    low, high = -1.0, 0.0
    for _ in range(100):
        s = (low + high) / 2
        rho = radius + VEHICLE.l * s
        low, high = (s, high) if s < -(rate**2) * rho / np.hypot(VEHICLE.g, rate**2 * rho) else (low, s)
    return s


@pytest.mark.parametrize("rate", [0.5, 1.0, 2.0])
def test_on_a_circle_two_steps_shrink_the_lean_by_the_contraction_squared(rate):
    radius = 0.6
    y = _bob(circle(radius, rate))(TIMES)[-1]
    outward = np.stack([np.cos(rate * TIMES), np.sin(rate * TIMES), 0 * TIMES], axis=-1)
    np.testing.assert_allclose(geo.cross(y, outward)[:, 2], 0, rtol=0, atol=1e-14)  # it leans along the radius
    lean = geo.dot(y, outward)
    exact = _lean_on_circle(radius, rate)
    assert exact < 0  # inward
    contraction = rate**2 * VEHICLE.l / VEHICLE.g
    error = np.max(np.abs(lean - exact))
    assert error < contraction**2 * abs(exact)
    # Not better than that by much: two steps, from an upright rod, and not ten.
    assert error > contraction**2 * abs(exact) / 5


@pytest.mark.parametrize("on_bob", [NO_FORCE, FORCE])
def test_on_a_lemniscate_the_residual_is_that_of_the_stated_contraction(on_bob):
    residuals = []
    rates = np.array([0.5, 1.0])
    for rate in rates:
        _, _, acceleration, _, y = _bob(lemniscate(1.0, rate), on_bob)(TIMES / rate)
        support = SUPPORT - on_bob / VEHICLE.m
        residual = np.max(geo.norm(y - geo.unit(support + acceleration)))
        first = np.max(geo.norm(geo.unit(support + acceleration) - geo.unit(support)))
        contraction = (2 * rate) ** 2 * VEHICLE.l / VEHICLE.g  # across, it goes at twice the rate
        # The lean of a unit vector has harmonics of higher rate, which shrink less: here 1.4 times as large at most.
        assert residual < 2 * contraction**2 * first
        residuals.append(residual)
    # Twice the rate: 4 times the lean, and 4 times the contraction, squared.
    assert np.log2(residuals[1] / residuals[0]) == pytest.approx(6, abs=0.8)


# What is refused -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: hover((1, 2)), "reference.x: expected numbers of shape (3), got shape (2,)"),
        (lambda: hover(np.zeros((2, 3))), "reference.x: expected numbers of shape (3), got shape (2, 3)"),
        (lambda: hover((0, np.nan, 0)), "reference.x: expected finite numbers, got 1 that are NaN or infinite"),
        (lambda: line(velocity="fast"), "reference.velocity: expected numbers of shape (3), got 'fast'"),
        (lambda: line(start=(0, 0)), "reference.start: expected numbers of shape (3), got shape (2,)"),
        (lambda: circle(radius=0), "reference.radius: expected a finite number > 0 m, got 0"),
        (lambda: circle(rate=np.inf), "reference.rate: expected a finite number, got inf"),
        (lambda: circle(center=1.0), "reference.center: expected numbers of shape (3), got shape ()"),
        (lambda: lemniscate(size=-1), "reference.size: expected a finite number > 0 m, got -1"),
        (lambda: lemniscate(rate="2"), "reference.rate: expected a finite number, got '2'"),
        (lambda: lemniscate(center=np.zeros((1, 3))), "reference.center: expected numbers of shape (3), got shape (1,"),
    ],
)
def test_what_is_no_reference_is_refused_in_one_line(make, message):
    with pytest.raises(fp.InputError, match="^" + re.escape(message)) as caught:
        make()
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("wrong", [3, (0, 0, 1), lambda t: (0, 0), lambda: 1, lambda t: "north"])
@pytest.mark.parametrize("law", [fp.laws.inverted, fp.laws.learned, fp.laws.almost_global, fp.laws.lqr])
def test_a_reference_is_a_function_of_time_that_gives_a_position(law, wrong):
    with pytest.raises(fp.InputError, match="reference"):
        law(reference=wrong)
