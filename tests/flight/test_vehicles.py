"""The vehicles of the package: their numbers are those of their sources, and each stands in the plants of its file."""

from importlib import resources

import numpy as np
import pytest

import flypend as fp
from flypend.export.app import AIRFRAMES, limit_rotors
from flypend.model.by_name import vehicle_names
from flypend.plants import Plant
from tests.few import few

# RotorPy at commit 9b760b8: mass, inertia, arm, thrust, yaw, drag, inflow, lift and lag per rotor speed.
ROTORPY = {
    "crazyflie": (0.03, None, 0.043, 2.3e-8, 7.8e-10, 10.2506e-7, 7.553e-7, 0.0, 0.072),
    "crazyflie-brushless": (0.044, (3.3e-5, 3.6e-5, 5.9e-5), None, 4.052e-8, None, 5.09e-6, 1.19e-5, 1.11e-3, 0.05),
    "hummingbird": (0.5, (3.65e-3, 3.68e-3, 7.03e-3), 0.17, 5.57e-6, 1.36e-7, 1.19e-4, 2.32e-4, 3.39e-3, 0.005),
}  # fmt: skip


@pytest.mark.parametrize("name", ROTORPY)
def test_numbers_are_those_of_rotorpy(name):
    vehicle = fp.vehicle(name)
    mass, inertia, arm, k, k_m, k_d, k_z, k_h, lag = ROTORPY[name]
    assert (vehicle.mass, vehicle.rotor_lag) == (mass, lag)
    assert vehicle.air.rotor_drag == pytest.approx(k_d / k**0.5, rel=1e-2)  # three digits
    assert vehicle.air.inflow == pytest.approx(k_z / k**0.5, rel=1e-2)
    assert vehicle.air.lift == k_h
    if inertia is not None:
        np.testing.assert_array_equal(np.diag(vehicle.inertia), inertia)
    if arm is not None and inertia is not None:
        assert vehicle.drag_ratio == pytest.approx(k_m / k, rel=1e-2)
        np.testing.assert_allclose(np.linalg.norm(vehicle.rotor_positions, axis=1), arm, rtol=1e-3)


def test_the_brushless_crazyflie_has_the_arms_torque_and_forces_of_its_firmware():
    vehicle, frame = fp.vehicle("crazyflie-brushless"), AIRFRAMES["cf21bl"]
    assert limit_rotors(vehicle, frame) == vehicle
    assert vehicle.drag_ratio == pytest.approx(0.00569, rel=1e-2)  # THRUST2TORQUE
    np.testing.assert_allclose(np.abs(np.array(vehicle.rotor_positions)[:, :2]), frame.arm, rtol=1e-3)


@pytest.mark.parametrize("name", vehicle_names())
def test_each_file_says_where_its_numbers_come_from(name):
    text = (resources.files("flypend") / "vehicles" / f"{name}.toml").read_text(encoding="utf-8")
    assert "chosen" in text
    assert any(source in text for source in ("RotorPy", "arXiv", "Hehn", "Nayak"))
    assert text.startswith("#")


@pytest.mark.parametrize("name", [name for name in vehicle_names() if name != "nayak2018"])
def test_each_stands_in_the_default_plant(name):
    """500 of 500 in the docs; the slow one is in tests/laws/test_inverted.py."""
    vehicle, starts = fp.vehicle(name), fp.random_starts(16, seed=5)
    assert np.all(fp.simulate_ensemble(vehicle, fp.laws.inverted(), starts, 10.0).success)


@pytest.mark.parametrize("name", few(("crazyflie",), [name for name in vehicle_names() if fp.vehicle(name).air]))
def test_and_in_air(name):
    starts = fp.random_starts(16, seed=5)
    flown = fp.simulate_ensemble(fp.vehicle(name), fp.laws.inverted(), starts, 10.0, plant=Plant(air="all"))
    assert np.all(flown.success)
