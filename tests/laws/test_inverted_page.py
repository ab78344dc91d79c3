"""What docs/laws/inverted.md and its appendix claim about the law: energy, target, spring, equilibria, clearance."""

import importlib.util
import re
from pathlib import Path
from types import SimpleNamespace

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend import geometry as geo
from flypend.laws import throw
from flypend.laws.law import Computer
from flypend.laws.linearise import linearise

ROOT = Path(__file__).parents[2]
PAGE = " ".join(
    word
    for name in ("inverted.md", "inverted-appendix.md")
    for word in (ROOT / "docs" / "laws" / name).read_text(encoding="utf-8").split()
)
VEHICLE = fp.vehicle("hehn2011")
E3 = np.array([0.0, 0.0, 1.0])


def told(pattern):
    """Numbers in the one place of the page that `pattern` matches."""
    (found,) = re.findall(pattern, PAGE)
    return [float(text.replace("−", "-")) for text in (found if isinstance(found, tuple) else (found,))]


# Equation (4) ---------------------------------------------------------------------------------------------------------


def _energy_rate(y, y_dot, force, vehicle):
    """Ė of E = |ẏ|²/2 + w² y₃ under (1), and E/w²."""
    w_squared = vehicle.weight / (vehicle.M * vehicle.l)
    y_ddot = -(force - y * (y @ force)) / (vehicle.M * vehicle.l) - (y_dot @ y_dot) * y
    return y_dot @ y_ddot + w_squared * y_dot[2], (y_dot @ y_dot) / 2 / w_squared + y[2]


@pytest.mark.parametrize(("sign", "towards"), [(-1, True), (+1, False)])
def test_the_sign_of_the_page_drives_the_energy_to_its_value_upright_and_the_other_away(sign, towards):
    vehicle, rate = fp.vehicle("nayak2018"), 2.0
    rng = np.random.default_rng(0)
    rods = geo.random_sphere(rng, (1000,))
    for y, y_dot in zip(rods, geo.random_tangent(rng, rods, 3.0), strict=True):
        share = _energy_rate(y, y_dot, 0 * y, vehicle)[1]
        force = vehicle.weight * E3 + sign * vehicle.M * vehicle.l * rate * (1 - share) * y_dot
        change, _ = _energy_rate(y, y_dot, force, vehicle)
        assert change == pytest.approx(-sign * rate * (1 - share) * (y_dot @ y_dot), rel=1e-9, abs=1e-9)
        assert (change * (1 - share) > 0) == towards
    assert r"F &= (M+m)\, A - M l\, \kappa\, (1 - E/w^2)\, \dot y" in PAGE


def test_the_law_has_the_sign_of_the_page():
    vehicle, gains = fp.vehicle("nayak2018"), SimpleNamespace(mounting=SimpleNamespace(shift=0.0))
    y, y_dot = np.array([0.6, 0, -0.8]), np.array([0.4, 1.0, 0.3])
    force = (
        ca.DM(
            throw.pumping_force(
                ca.DM(vehicle.g * E3), throw.Rod(ca.DM(y), ca.DM(y_dot)), ca.DM([1, 0, 0]), vehicle, gains
            )
        )
        .full()
        .ravel()
    )
    change, share = _energy_rate(y, y_dot, force, vehicle)
    circling, rate = E3 @ np.cross(y, y_dot), 2 * np.sqrt(vehicle.g / vehicle.l)
    assert change == pytest.approx(rate * ((1 - share) * (y_dot @ y_dot) - 0.4 * circling**2), rel=1e-12)


def test_the_energy_upright_is_also_that_of_a_cone():
    vehicle = fp.vehicle("nayak2018")
    w_squared, height = vehicle.weight / (vehicle.M * vehicle.l), told(r"cone \$y_3 = (-1)/3\$")[0] / 3
    radius = np.sqrt(1 - height**2)
    y, y_dot = np.array([radius, 0, height]), np.array([0, radius * np.sqrt(w_squared / -height), 0])
    y_ddot = -w_squared * (E3 - y * height) - (y_dot @ y_dot) * y
    np.testing.assert_allclose(y_ddot, [-(y_dot @ y_dot) / radius, 0, 0], atol=1e-12)  # it circles at one height
    assert _energy_rate(y, y_dot, 0 * y, vehicle)[1] == pytest.approx(1, abs=1e-12)


# Target and spring of the axis ----------------------------------------------------------------------------------------


def _target(force, tilt, share):
    """What z_d is made of, in weights."""
    return throw.lift(ca.DM(force), tilt).full().ravel() + share * E3


def test_constant_and_tilt_limit_keep_the_target_off_zero_and_neither_does_alone():
    share, tilt = told(r"plus ([\d.]+) weights of \$e_3\$\.")[0], told(r"keeps it within ([\d.]+) rad of")[0]
    # The nearest point of the edge of the cone is 24 times as deep as it is off the axis.
    levels, depths = np.linspace(0, 2e-3, 101), np.linspace(-0.1, 0.02, 241)
    lengths = [geo.norm(_target([level, 0, depth], tilt, share)) for level in levels for depth in depths]
    least, floor = told(r"off zero, by at least ([\d.]+) weights")[0], told(r"a floor of ([\d.]+) weights")[0]
    assert share * np.sin(tilt) == pytest.approx(least, abs=5e-6)
    assert least - 1e-5 < min(lengths) < 1.05 * least
    shortest = told(r"unit vector \(([\d.]+) at the least\)")[0]
    assert least / np.hypot(least, floor) == pytest.approx(shortest, abs=5e-3)
    np.testing.assert_allclose(_target([0, 0, 0], tilt, 0.0), 0)  # without the constant
    np.testing.assert_allclose([0, 0, -share] + share * E3, 0)  # without the lift


def test_the_spring_fades_before_the_antipode():
    theta = np.radians(np.linspace(0, 180, 18001))
    spring = np.sin(theta) / np.sqrt(np.cos(theta / 2) ** 2 + 0.014)
    peak, angle, late, beyond = told(r"([\d.]+) at its peak at (\d+)°, still ([\d.]+) at (\d+)°")
    assert np.max(spring) == pytest.approx(peak, abs=5e-3)
    assert np.degrees(theta[np.argmax(spring)]) == pytest.approx(angle, abs=0.5)
    assert np.interp(beyond, np.degrees(theta), spring) == pytest.approx(late, abs=5e-3)


def test_the_bob_can_be_believed_to_be_pulled_harder_than_the_demand_allows():
    limit = Computer().force_limit * VEHICLE.weight / VEHICLE.m / VEHICLE.g
    assert limit == pytest.approx(told(r"half the weight, ([\d.]+) g on")[0])


# The second equilibrium -----------------------------------------------------------------------------------------------


def test_there_is_a_second_equilibrium_with_two_growing_modes():
    found = linearise(fp.laws.inverted(), VEHICLE, fp.State(x=(0.25, 0, 2.1), y=(0, 0, -1)))
    np.testing.assert_allclose(found.at.y, -E3, atol=1e-9)
    np.testing.assert_allclose(found.at.R, np.eye(3), atol=1e-9)
    across, height, *growth = told(r"at x = \(([\d.]+), 0, ([\d.]+)\) m.*?growing modes \(([\d.]+) and ([\d.]+) /s\)")
    np.testing.assert_allclose(found.at.x, [across, 0, height], atol=5e-4)
    modes = found.without(*found.symmetries).eigenvalues.real
    np.testing.assert_allclose(modes[:2], growth, atol=5e-3)
    assert len(modes) == 15
    assert np.all(modes[2:] < -1)


# Clearance ------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def clearance():
    spec = importlib.util.spec_from_file_location("clearance", ROOT / "benchmarks" / "clearance.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_rod_crosses_where_its_third_component_changes_sign(clearance):
    angle = np.linspace(0.3, 2.5, 12)
    bearing = np.array([np.cos(0.7), np.sin(0.7), 0])
    rod = np.cos(angle)[:, None] * E3 + np.sin(angle)[:, None] * bearing
    (crossing,) = clearance.crossings(rod)
    np.testing.assert_allclose(crossing, bearing, atol=1e-12)
    assert len(clearance.crossings(rod[:5])) == 0  # it stays above


def test_the_gap_is_that_between_the_bearing_and_the_arm(clearance):
    arm = 0.17
    for degrees in (0, 10, 30, 45, 80, 90, 135, 200):
        bearing = np.array([[np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0]])
        off = np.radians(min(degrees % 90, 90 - degrees % 90))
        assert clearance.nearest(bearing, VEHICLE) == pytest.approx(arm * np.sin(off), abs=1e-12)
    assert clearance.nearest(np.zeros((0, 3)), VEHICLE) == np.inf
    # A rod that ends before the rotor keeps off its disc.
    stub = VEHICLE.replace(rod_length=0.05)
    assert clearance.nearest(np.array([[1.0, 0, 0]]), stub) == pytest.approx(arm - 0.05)


def test_the_swing_up_of_the_readme_passes_through_a_rotor(clearance):
    rod = clearance.in_body(clearance.flown(fp.State(y=(0, 0, -1)), fp.laws.inverted()))
    assert rod[0, 2] == pytest.approx(-1)
    assert rod[-1, 2] > 0.99
    assert clearance.nearest(clearance.crossings(rod), VEHICLE) < 5e-3  # m, of a disc of 63.5 mm
