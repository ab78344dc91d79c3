"""The app in the firmware's own stabilizer, compiled for this machine: benchmarks/firmware at a few starts and events.

Against the firmware itself, where it lies beside the project (shared/firmware) or FLYPEND_FIRMWARE names its folder.
"""

import struct

import numpy as np
import pytest
from cbuild import run

import flypend as fp
from benchmarks.firmware.__main__ import (
    DURATION,
    SCENARIOS,
    compared,
    difference,
    exported,
    happen,
    in_firmware,
    judged,
    packed,
    starts,
    stopped,
    strayed,
)
from benchmarks.firmware.built import FLAGS, searched
from benchmarks.firmware.loop import (
    APP,
    CUT,
    FALLING,
    HOME,
    HOST,
    LANDING,
    LAW,
    OWN,
    PID,
    TICK,
    Vehicle,
    carried,
    fall,
    states,
)
from tests.few import slow


@pytest.fixture(scope="module")
def built(firmware_source, tmp_path_factory):
    return exported(firmware_source, tmp_path_factory.mktemp("firmware") / "app", "cf2")


@pytest.mark.parametrize("seed", [1, 2])
def test_a_random_start_ends_upright_within_the_space_that_its_readme_asks_for(built, seed):
    drawn = fp.State.random(np.random.default_rng(seed), 1)[0]
    start = fp.State(x=HOME, x_dot=drawn.x_dot, R=drawn.R, omega=drawn.omega, y=drawn.y, y_dot=drawn.y_dot)
    flown = Vehicle(*built)
    flown.lift()
    assert flown.release(start)
    begun = len(flown.log)
    flown.fly(DURATION)
    upright, far = judged(packed(flown, begun), HOME, TICK)
    assert upright
    assert flown.flies == LAW
    assert far < 3.0


@pytest.mark.parametrize(("kind", "number"), [("level", 0), ("random", 1)])
def test_an_excursion_is_that_with_perfect_states_and_ideal_mixing(built, kind, number):
    """In starts where the firmware's own estimate of the state costs 58 and 18 %: its attitude lags in fast turns."""
    _, far, _, ideal = in_firmware(*built, starts(60, 2024)[kind][number])
    assert far < 1.1 * ideal


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "kind", "most"), [({"sensors": "mocap"}, "random", 1.1), ({"planned": True}, "hanging", 0.3)]
)
def test_an_estimator_costs_no_room_and_a_plan_saves_it(options, kind, most, firmware_source, tmp_path):
    flown = exported(firmware_source, tmp_path / "app", "cf2", **options)
    stood, far, _, ideal = in_firmware(*flown, starts(60, 2024)[kind][1])
    assert stood
    assert far < most * ideal


def test_without_the_law_the_app_is_the_firmwares_pid_to_the_bit(built):
    """On the rig and released, the rod hanging: hover, then a landing."""
    flights = []
    for controller in (APP, OWN):
        flown = Vehicle(*built, home=(0.0, 0.0, 1.0))
        flown.lift(controller)
        flown.fly(1.0)
        flown.land(0.0, 1.0)
        flown.fly(1.0)
        flights.append(np.array([forces for _, forces, _ in flown.log]))
        assert np.ptp(flights[-1]) > 0.01
    assert np.array_equal(*flights)


@pytest.mark.parametrize("name", ["stop setpoint", slow("emergency stop"), "disarmed"])
def test_what_stops_the_firmwares_pid_stops_the_law(built, name):
    flown, own, event, end = compared(name, *built)
    assert flown.log[event - 1][2] == LAW
    assert flown.log[event - 1][1].all()
    assert (end - event) <= 40  # the supervisor looks every 40 ms
    assert stopped(flown, event) == pytest.approx(stopped(own, event), abs=0.002)
    assert stopped(flown, event) <= 0.04


def test_lost_setpoints_are_levelled_out_as_by_the_firmwares_pid_and_lock_it(built):
    flown, own, event, end = compared("setpoints lost", *built)
    assert 0.5 < (end - event) * 1e-3 < 0.56
    assert flown.log[end][2] == PID
    assert difference(flown, own, end) < 1e-3  # N, of 0.08; bit by bit, were the integrals reset at the same tick
    assert 1.9 < stopped(flown, event) < 2.1


ENDS = ["switched off", "land", "bob lost", "battery low", slow("link lost"), slow("pose lost")]


@pytest.mark.parametrize("name", ENDS)
def test_where_the_law_ends_the_motors_do_what_the_firmwares_pid_would(built, name):
    """PID of the app and the firmware's begin with other integrals, and lands or flies on where the law ends."""
    flown, own, event, end = compared(name, *built, after=0.75)
    assert end < event + 200  # so that there are 0.5 s to compare
    after = flown.log[end + 20 : end + 500]
    assert {flies for *_, flies in after} <= {PID, LANDING}
    assert np.ptp([forces for _, forces, _ in after], axis=0).max() > 0.015  # N: it moves by more
    assert difference(flown, own, end) < 0.015  # N, of 0.08


@pytest.mark.parametrize(
    ("name", "good", "bad"),
    [
        ("mass", 0.031, (0.0, -1.0, np.nan, np.inf)),
        ("bobMass", 0.0025, (0.0, -1.0, np.nan, np.inf)),
        ("rodLength", 0.45, (0.0, -1.0, np.nan, np.inf)),
        ("late", 12.0, (-1.0, 101.0, np.nan)),
        ("height", 2.5, (0.1, -1.0, 1001.0, np.nan)),
    ],
)
def test_a_parameter_that_the_law_cannot_fly_with_stays_what_it_was(built, name, good, bad):
    """After an upload through the firmware's table of parameters and its callback."""
    firmware = Vehicle(*built).firmware
    assert firmware.set(f"flypend.{name}", good) == pytest.approx(good)
    for value in bad:
        assert firmware.set(f"flypend.{name}", value) == pytest.approx(good), value


@pytest.mark.parametrize(
    ("name", "soon", "down"),
    [("bob lost", 0.11, (3.0, 6.5)), ("pose lost", 0.21, (2.0, 4.0)), ("battery low", 0.01, (3.0, 6.5))],
)
def test_what_the_law_needs_and_loses_ends_in_a_landing_near_by(built, name, soon, down):
    flown, event = happen(name, *built)
    phases = [flown.log[i][2] for i in range(event, len(flown.log))]
    assert phases.index(LANDING) * 1e-3 < soon
    assert phases[-1] == CUT
    assert down[0] < stopped(flown, event) < down[1]  # hover for 1 s, then 1.5 m at 0.3 m/s, or at 0.8 without poses
    aside, _ = strayed(flown, event)
    assert aside < 0.5  # the rod falls from upright


HANGING = fp.State(x=HOME, y=(0.02, 0.0, -np.sqrt(1 - 0.02**2)))
HALFWAY, CATCHING = 1.0, 1.3  # s after which it turns over, and after which it catches: at 3 and 4 m/s


def _in_a_catch(built, at):
    flown = Vehicle(*built)
    flown.lift()
    assert flown.release(HANGING)
    flown.fly(at)
    assert flown.flies == LAW
    assert np.linalg.norm(flown.state.x_dot) > 1
    return flown


def _landed(flown, event):
    """How far it strayed, its speed sideways where the motors stopped, and that height."""
    flown.fly(25.0, lambda: flown.flies == CUT or flown.state.x[2] < 0)
    away = np.array([state.x - HOME for state, *_ in flown.log[event:]])
    return np.hypot(*away[:, :2].T).max(), np.hypot(*flown.state.x_dot[:2]), flown.state.x[2]


@pytest.mark.parametrize("at", [HALFWAY, CATCHING])
def test_a_catch_that_loses_the_poses_brakes_and_lands_level(built, at):
    """On the firmware's own estimate it would be 40 to 90 m away, at 9 m/s."""
    flown = _in_a_catch(built, at)
    event, flown.sees_pose = flown.ticks, False
    aside, speed, height = _landed(flown, event)
    assert flown.flies == CUT
    assert aside < 2.5
    assert speed < 0.6  # m/s
    assert abs(height) < 0.3


def test_a_pose_that_is_no_number_spoils_the_firmwares_filter_until_the_app_resets_it(built):
    """Left alone, its covariance ends in an assertion after 10 to 16 s, and the landing in a fall."""
    flown = _in_a_catch(built, CATCHING)
    event = flown.ticks
    flown.firmware.packet(6, 1, struct.pack("<B7f", 8, np.nan, 0, 0, 0, 0, 0, 1))
    flown.fly(0.1, lambda: np.isnan(flown.firmware.log("stateEstimate.x")))
    assert np.isnan(flown.firmware.log("stateEstimate.x"))
    aside, speed, height = _landed(flown, event)
    assert flown.flies == CUT
    assert aside < 2.5
    assert speed < 0.6  # m/s
    assert abs(height) < 0.3
    assert np.isfinite([forces for _, forces, _ in flown.log[event:]]).all()
    told = [flown.firmware.log(f"stateEstimate.{axis}") for axis in "xy"]
    assert told == pytest.approx(flown.state.x[:2], abs=0.05)


@pytest.mark.parametrize("name", ["stop setpoint", "emergency stop", "disarmed"])
def test_a_stop_in_the_middle_of_a_catch_is_a_stop(built, name):
    flown = _in_a_catch(built, CATCHING)
    event = flown.ticks
    SCENARIOS[name](flown)
    flown.fly(0.6)
    assert stopped(flown, event) <= 0.041
    assert flown.flies == CUT


def test_a_setpoint_that_is_no_number_ends_in_a_landing(built):
    flown = _in_a_catch(built, CATCHING)
    event, flown.target = flown.ticks, np.array([np.nan, 0.0, 5.0])
    flown.fly(1.0)
    assert flown.flies == LANDING
    assert flown.firmware.log("flypend.why") == 7  # refused
    assert np.isfinite([forces for _, forces, _ in flown.log[event:]]).all()


def test_without_the_host_scripts_filter_settings_velocities_lag_much_further(built, monkeypatch):
    """So that nobody takes them out: a level rod."""
    off = {}
    for which, settings in (("the script's", HOST.FILTER), ("the firmware's own", {})):
        monkeypatch.setattr(HOST, "FILTER", settings)
        flown = Vehicle(*built)
        flown.lift()
        flown.release(fp.State(x=HOME, y=(1.0, 0.0, 0.0)))
        errors = []
        for _ in range(1500):
            told = [flown.firmware.log(f"stateEstimate.v{axis}") for axis in "xyz"]
            errors.append(np.linalg.norm(told - flown.log[-1][0].x_dot))
            flown.tick()
        off[which] = np.mean(errors)
    assert off["the script's"] < 0.1  # m/s
    assert off["the firmware's own"] > 2 * off["the script's"]


@pytest.mark.parametrize(
    ("limits", "says"), [((0.005, 0.147), "below the firmware's THRUST_MIN"), ((0.0193, 0.18), "")]
)
def test_the_thrust_upgrade_kit_takes_an_app_within_its_own_limits(firmware_source, built, limits, says, tmp_path):
    """It cannot give less than 0.0192 N, so an app for 0.0129 N is refused by the compiler; one for 0.0193 N is not."""
    fp.export_app("crazyflie", fp.laws.inverted(), fp.vehicle("crazyflie").replace(rotor_limits=limits), tmp_path)
    config = (built[0].parents[1] / "build/include/generated/autoconf.h").read_text()
    assert "CONFIG_CRAZYFLIE_21_PLUS 1" in config
    changed = config.replace("CONFIG_CRAZYFLIE_21_PLUS", "CONFIG_CRAZYFLIE_THRUST_UPGRADE_KIT")
    (tmp_path / "autoconf.h").write_text(changed)
    words = ["gcc", *FLAGS, *searched(firmware_source, tmp_path, tmp_path), "-include", "groups.h", "-fsyntax-only"]
    done = run([*words, "flypend_app.c"], tmp_path, check=False)
    assert (done.returncode == 0) == (not says), done.stderr
    assert says in done.stderr
    assert "beyond the firmware's THRUST_MAX" not in done.stderr


def test_the_rig_moves_as_its_rates_say():
    """Needs no firmware: derivatives of the path by differences, and its end."""
    start = fp.State.random(np.random.default_rng(3), 1)[0]
    path = states(carried(fp.State(x=HOME, y=(0, 0, -1.0)), start, 1.5))
    end = path[1500]
    for name in ("x", "x_dot", "R", "omega", "y", "y_dot"):
        assert np.allclose(getattr(end, name), getattr(start, name), atol=1e-4), name
    for before, now, after in zip(path[700:], path[701:], path[702:703], strict=False):
        assert np.allclose((after.x - before.x) / 2e-3, now.x_dot, atol=1e-4)
        assert np.allclose((after.y - before.y) / 2e-3, now.y_dot, atol=1e-4)
        spin = now.R.T @ (after.R - before.R) / 2e-3
        assert np.allclose([spin[2, 1], spin[0, 2], spin[1, 0]], now.omega, atol=1e-3)


def test_the_fall_goes_through_the_start_and_no_force_acts_but_weight():
    """Needs no firmware. The centre of mass falls with g, the vehicle's spin stays, and the rod's rate is its rate."""
    vehicle, start = fp.vehicle("crazyflie"), fp.State.random(np.random.default_rng(3), 1)[0]
    path = fall(vehicle, start)
    middle, share = round(FALLING / TICK), vehicle.m / (vehicle.M + vehicle.m)
    assert path[middle] is start
    centre = np.array([state.x + share * vehicle.l * state.y for state in path])
    t = (np.arange(len(path)) - middle) * TICK
    velocity = start.x_dot + share * vehicle.l * start.y_dot
    gone = centre[middle] + np.outer(t, velocity) - 0.5 * vehicle.gravity * np.outer(t**2, (0, 0, 1))
    assert np.abs(centre - gone).max() < 1e-6
    for before, now, after in zip(path[:-2], path[1:-1], path[2:], strict=True):
        assert np.allclose((after.y - before.y) / (2 * TICK), now.y_dot, atol=1e-3)
        spin = now.R.T @ (after.R - before.R) / (2 * TICK)
        assert np.allclose([spin[2, 1], spin[0, 2], spin[1, 0]], now.omega, atol=1e-3)
    spins = np.array([state.R @ vehicle.inertia @ state.omega for state in path])
    assert np.abs(spins - spins[middle]).max() < 1e-6 * np.linalg.norm(spins[middle])
