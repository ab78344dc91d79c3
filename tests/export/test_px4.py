"""The module for PX4 around stand-ins: when it flies, what the motors are told then, and what it costs.

PX4 itself is not at hand: benchmarks/px4.py flies in it. Here its messages are generated from their definitions, its
platform is a stand-in.
"""

import re

import numpy as np
import pytest
from boards import commands
from cbuild import STANDINS, run
from px4 import CPP, World, headers, library

import flypend as fp
from benchmarks.px4 import parameters
from flypend.export import fits

VEHICLE = fp.vehicle("hehn2011")
LAW = fp.laws.inverted()
HEIGHT, RATE = 4.0, 400.0
ORDER = (2, 0, 3, 1)  # rotor i of the vehicle is this motor of PX4
NONE, ROTORS, PARAMETERS, GYRO_RATE, IMU, ATTITUDE, POSITION, BOB, LOW, REFUSED = range(10)
NUMBERS = {
    "FPD_MASS": VEHICLE.M, "FPD_BOB_MASS": VEHICLE.m, "FPD_ROD_LEN": VEHICLE.l,
    "FPD_FORCE": VEHICLE.rotor_limits[1], "FPD_BOB_DELAY": 0.0, "FPD_HEIGHT": HEIGHT,
}  # fmt: skip
UP = fp.State(x=(0.3, -0.2, 5.0), y=(0, 0, 1.0))
HOVER = np.full(4, VEHICLE.weight / 4)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("px4")
    assert fp.export_app("px4", LAW, VEHICLE, place, height=HEIGHT) == VEHICLE
    return place


@pytest.fixture(scope="module")
def module(folder):
    return library(folder)


@pytest.fixture
def world(module):
    return World(module, VEHICLE, NUMBERS, ORDER)


def _select(world, state=UP, watched=100):
    """Registered, and the bob seen, in another mode; then the mode is selected after PX4's own hover command."""
    world.fly(state, watched)
    assert world.count("actuator_motors") == 0  # in another mode they are not the module's
    world.put("actuator_motors", control=np.append(HOVER / VEHICLE.rotor_limits[1], np.full(8, np.nan)))
    world.nav = world.MODE


# When it flies --------------------------------------------------------------------------------------------------------


def test_it_registers_a_mode_and_claims_the_motors_until_it_is_stopped(world):
    world.fly(UP, 3)
    assert bytes(int(world.get("register_ext_component_request", "name", i)) for i in range(8)) == b"Pendulum"
    flags = ("register_mode", "register_arming_check")
    assert all(world.get("register_ext_component_request", flag) == 1 for flag in flags)
    claim = "config_control_setpoints"
    assert world.get(claim, "source_id") == world.MODE
    for controller in ("allocation", "rates", "attitude", "position"):  # attitude: the check for tumbling
        assert world.get(claim, f"flag_control_{controller}_enabled") == 0
    world.c.standin_stop()
    world.fly(UP)
    assert (world.get("unregister_ext_component", "mode_id"), world.c.standin_lives()) == (world.MODE, 0)
    assert world.get("unregister_ext_component", "arming_check_id") == world.CHECK


def test_the_registration_is_repeated_and_another_components_answer_is_not_taken(world):
    world.mode = world.MODE  # the commander does not answer
    world.fly(UP)
    world.put("register_ext_component_reply", request_id=5, success=1, arming_check_id=1, mode_id=world.MODE)
    world.fly(UP, 150)
    assert world.count("register_ext_component_request") == 1
    world.fly(UP, 100)
    assert world.count("register_ext_component_request") == 2
    assert world.count("config_control_setpoints") == 0


@pytest.mark.parametrize("order", [ORDER, (0, 1, 2, 3)])
def test_the_motors_are_told_what_the_board_commands(module, order):
    # Near hover no rotor is at its limit; the rod stands still, so that its rate is the same whenever it was seen.
    world, moving = World(module, VEHICLE, NUMBERS, order), fp.State(x=UP.x, y=UP.y, omega=(0.1, -0.1, 0.05))
    _select(world)
    wanted = commands(VEHICLE, LAW, [moving] * 4, [UP.x] * 4, RATE) / VEHICLE.rotor_limits[1]
    assert np.ptp(wanted, axis=1).min() > 1e-2
    for row in wanted:
        motors = world.fly(moving)
        assert np.allclose(motors[list(order)], row, atol=2e-4)  # single precision
        assert np.isnan(motors[4:]).all()
        assert world.get("vehicle_thrust_setpoint", "xyz", 2) == pytest.approx(-row.mean(), abs=2e-4)
    assert (world.obstacle(), world.count("vehicle_command")) == (NONE, 0)


def test_states_turn_from_north_east_down(world):
    """Off centre in all that a conversion could swap or lose a sign of: the next command is that of Python's state."""
    tilted = fp.State(
        x=(0.302, -0.201, 5.004), x_dot=(0.02, 0.01, -0.03),
        R=fp.geometry.rotation_from_quat_xyzw([0.004, -0.006, 0.3, 0.95]),
        omega=(0.03, -0.05, 0.04), y=UP.y,
    )  # fmt: skip
    _select(world)
    wanted = commands(VEHICLE, LAW, [UP, tilted], [UP.x] * 2, RATE) / VEHICLE.rotor_limits[1]
    assert np.all((wanted > 0.1) & (wanted < 0.9))
    assert np.ptp(wanted[1]) > 0.05
    world.fly(UP)
    felt = tilted.R.T @ [0, 0, 9.81]  # no force turns the rod
    assert np.allclose(world.fly(tilted, felt=felt)[list(ORDER)], wanted[1], atol=5e-4)


def test_it_hovers_where_it_began_and_follows_a_fresh_setpoint(world):
    _select(world)
    world.put("trajectory_setpoint", timestamp=world.now, position=(9, 9, -9))  # before the mode: not meant for it
    world.fly(UP)
    target = np.add(UP.x, (0.1, 0.05, 0.02))
    ned = {
        "timestamp": world.now,
        "position": target * [1, -1, -1],
        "velocity": [np.nan] * 3,
        "acceleration": [np.nan] * 3,
    }
    world.put("trajectory_setpoint", **ned)
    wanted = commands(VEHICLE, LAW, [UP, UP], [UP.x, target], RATE)[-1]
    motors = world.fly(UP)[list(ORDER)]
    assert np.allclose(motors, wanted / VEHICLE.rotor_limits[1], atol=2e-4)
    assert np.ptp(motors) > 1e-3


def test_a_velocity_of_an_old_setpoint_is_dropped(module):
    def told(age, north):
        world = World(module, VEHICLE, NUMBERS, ORDER)
        _select(world)
        world.fly(UP)
        zero = {"acceleration": [0] * 3, "jerk": [0] * 3, "position": np.array(UP.x) * [1, -1, -1]}
        world.put("trajectory_setpoint", timestamp=world.now - age, velocity=(north, 0, 0), **zero)
        return world.fly(UP)[:4]

    assert np.abs(told(400_000, 0.1) - told(400_000, 0)).max() > 1e-3
    assert np.array_equal(told(600_000, 0.1), told(600_000, 0))  # of 0.5 s


def test_disarmed_nothing_turns_and_another_mode_has_its_motors(world):
    _select(world)
    assert np.isfinite(world.fly(UP)[:4]).all()
    world.armed = 1
    assert np.isnan(world.fly(UP)).all()
    world.armed, world.nav = 2, world.OTHER
    world.fly(UP)
    before = world.count("actuator_motors")
    world.fly(UP, 5)
    assert world.count("actuator_motors") == before
    world.nav = world.MODE
    assert np.isfinite(world.fly(UP)[:4]).all()


def test_the_arming_check_names_what_the_mode_needs(world):
    world.fly(UP, 60)
    assert not world.can_run()  # the bob is not yet seen for 0.2 s
    world.fly(UP, 60)
    assert world.can_run()
    assert (world.get("arming_check_reply", "request_id"), world.get("arming_check_reply", "registration_id")) == (
        77,
        world.CHECK,
    )
    for need in ("angular_velocity", "attitude", "local_alt", "local_position"):
        assert world.get("arming_check_reply", f"mode_req_{need}") == 1
    world.fly(fp.State(x=(0, 0, HEIGHT - 0.3), y=UP.y))
    assert not world.can_run()


def test_a_bob_that_is_dated_ahead_is_watched_as_long_as_another(world):
    for step in range(120):
        world.changed = {"debug_array": {"timestamp": world.now + 150_000}}
        world.fly(UP)
        assert step >= 80 or not world.can_run()  # 0.2 s
    assert world.can_run()


STALE = {
    "vehicle_attitude": ATTITUDE,
    "vehicle_local_position": POSITION,
    "debug_array": BOB,
    "vehicle_acceleration": IMU,
}
WRONG = [
    *(("vehicle_local_position", {flag: 0}, POSITION) for flag in ("xy_valid", "z_valid", "v_xy_valid", "v_z_valid")),
    ("vehicle_local_position", {"dead_reckoning": 1}, POSITION),
    ("vehicle_local_position", {"x": np.nan}, POSITION),
    ("vehicle_local_position", {"vz": np.inf}, POSITION),
    ("vehicle_attitude", {"q": (0, 0, 0, 0)}, ATTITUDE),
    ("vehicle_attitude", {"q": (np.nan, 0, 0, 0)}, ATTITUDE),
    ("vehicle_angular_velocity", {"xyz": (np.nan, 0, 0)}, IMU),
    ("vehicle_acceleration", {"xyz": (0, np.inf, 0)}, IMU),
]


def _levels_out_and_asks_for_a_landing(world, why):
    motors = world.motors()
    assert (world.obstacle(), world.can_run()) == (why, False)
    assert np.isfinite(motors[:4]).all()
    assert np.all((motors[:4] >= 0) & (motors[:4] <= 1))
    assert (world.get("vehicle_command", "command"), world.get("vehicle_command", "target_system")) == (21, 1)
    assert np.isnan(world.get("vehicle_command", "param5"))


@pytest.mark.parametrize(("topic", "why"), STALE.items())
def test_what_is_stale_levels_out_and_lands(world, topic, why):
    _select(world)
    world.fly(UP)
    world.silent = {topic}
    world.fly(UP, 39)
    assert (world.obstacle(), world.count("vehicle_command")) == (NONE, 0)  # 0.1 s
    world.fly(UP, 2)
    _levels_out_and_asks_for_a_landing(world, why)
    world.silent = set()
    world.fly(UP, 100)  # it does not take the law up again,
    assert not world.can_run()
    world.nav = world.OTHER
    world.fly(UP, 100)
    assert world.can_run()  # until the mode was left


@pytest.mark.parametrize(("topic", "fields", "why"), WRONG)
def test_what_is_not_valid_levels_out_and_lands_at_once(world, topic, fields, why):
    _select(world)
    world.fly(UP)
    world.changed = {topic: fields}
    world.fly(UP, 2)
    _levels_out_and_asks_for_a_landing(world, why)


def test_a_silent_gyroscope_stops_the_motors(world):
    _select(world)
    world.fly(UP)
    world.silent = {"vehicle_angular_velocity"}
    world.fly(UP, 39)
    assert np.isfinite(world.motors()[:4]).all()
    assert np.isnan(world.fly(UP, 2)).all()
    assert world.obstacle() == IMU


def test_a_bob_that_is_no_number_and_another_array_are_not_taken(world):
    _select(world)
    world.changed = {"debug_array": {"data": (np.nan, 0, 0)}}
    world.fly(UP, 42)
    assert world.obstacle() == BOB
    world.nav, world.changed = world.OTHER, {"debug_array": {"name": "bobby\0"}}
    world.fly(UP, 120)
    assert not world.can_run()


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("FPD_MASS", 0.0), ("FPD_MASS", 50 * VEHICLE.M), ("FPD_ROD_LEN", np.nan), ("FPD_BOB_DELAY", 101.0),
        ("FPD_HEIGHT", 0.1),
        ("FPD_FORCE", 0.9 * VEHICLE.rotor_limits[1]), ("IMU_GYRO_RATEMAX", 250), ("CA_ROTOR_COUNT", 6),
        ("CA_ROTOR1_PX", 1.0), ("CA_ROTOR2_KM", 0.05 * VEHICLE.rotor_spins[0]),
    ],
)  # fmt: skip
def test_parameters_that_cannot_be_flown_with_are_refused(world, name, value):
    world.fly(UP, 120)
    assert world.can_run()
    world.parameter(name, value)
    world.put("parameter_update", timestamp=world.now)
    world.fly(UP)
    assert not world.can_run()


def test_the_airframe_of_the_benchmark_in_px4_is_the_vehicle(world):
    for name, value in parameters().items():
        world.parameter(name, value)
    world.fly(UP, 120)
    assert world.can_run()


def test_a_parameter_does_not_change_in_flight(world):
    _select(world)
    before = world.fly(UP)
    world.parameter("FPD_FORCE", 3 * VEHICLE.rotor_limits[1])
    world.put("parameter_update", timestamp=world.now)
    assert np.allclose(world.fly(UP)[:4], before[:4], atol=1e-2)
    world.nav = world.OTHER
    world.fly(UP)
    world.put("actuator_motors", control=np.append(HOVER / VEHICLE.rotor_limits[1] / 3, np.full(8, np.nan)))
    world.nav = world.MODE
    assert world.fly(UP)[:4] == pytest.approx(before[:4] / 3, rel=0.01)


# The export -----------------------------------------------------------------------------------------------------------


def test_an_airframe_is_px4s_own_to_know(tmp_path):
    with pytest.raises(fp.InputError, match="airframe: expected none for px4"):
        fp.export_app("px4", LAW, VEHICLE, tmp_path / "app", airframe="cf2", height=HEIGHT)


@pytest.mark.parametrize("height", [4, np.float64(4)])
def test_a_height_of_any_type_is_a_number_of_the_module(height, tmp_path):
    fp.export_app("px4", LAW, VEHICLE, tmp_path, height=height)
    assert "            default: 4.0\n" in (tmp_path / "module.yaml").read_text()


def test_a_law_that_does_not_fit_is_refused(tmp_path, monkeypatch):
    monkeypatch.setitem(fits.BUDGETS["px4"].most, "cycles", 1_000)
    with pytest.raises(fp.InputError, match=r"at most 1,000 cycles of a flight controller with PX4.*% too many"):
        fp.export_app("px4", LAW, VEHICLE, tmp_path / "app", height=HEIGHT)


def test_every_parameter_has_its_default_and_a_short_name(folder):
    text = (folder / "module.yaml").read_text()
    found = dict(re.findall(r"^        (\w+):\n(?:.*\n)*?\s+default: (.*)$", text, re.M))
    assert {name: float(value) for name, value in found.items()} == pytest.approx(NUMBERS)
    assert max(map(len, found)) <= 16  # PX4's longest


def test_the_module_takes_no_more_than_its_budget_says(folder):
    """Stack, memory and code around the law, as the cross compiler sees them; uORB's own is not in it."""
    budget, place = fits.BUDGETS["px4"], headers(folder)
    included = ("-I.", f"-I{place}", f"-I{STANDINS / 'px4'}", "-include", "everything.hpp")
    flags = (*budget.processor, "-Os", CPP, "-fno-exceptions", "-fno-rtti", "-fcallgraph-info=su", "-DBARE")
    run(["arm-none-eabi-g++", *flags, *included, "-c", "flypend.cpp", "-o", "bare.o"], folder)
    used = fits.deepest((folder / "bare.ci").read_text(), "_ZN7Flypend3RunEv")
    code, data = map(int, run(["arm-none-eabi-size", "bare.o"], folder).splitlines()[1].split()[:2])
    assert 0.5 * budget.stack < used < budget.stack
    assert 0.5 * budget.code < code + data < budget.code
    own = f"sizeof(Flypend) - sizeof(flypend_board) < {budget.memory}"
    (folder / "size.cpp").write_text(f'#include "flypend.hpp"\nstatic_assert({own}, "too large");\n')
    run(["arm-none-eabi-g++", *flags, *included, "-c", "size.cpp", "-o", "size.o"], folder)
    assert fits.PX4_STACK - budget.most["bytes of stack"] >= 1_000
