"""The app for the Crazyflie: what it refuses, when the law flies in it, and what it costs the firmware.

Around stand-in headers in every run; against the firmware itself where it lies beside the project (shared/firmware).
"""

import ctypes
import re
import shutil
import struct

import numpy as np
import pytest
from boards import commands
from cbuild import STANDINS, build, run
from scipy.spatial.transform import Rotation

import flypend as fp
from benchmarks.app_cost import HEADERS, LAWS, exported, size, stack
from flypend.export import fits
from flypend.export.app import AIRFRAMES, limit_rotors
from flypend.export.records import params_of
from tests.few import few, slow

LAW = fp.laws.inverted()
VEHICLE = limit_rotors(fp.vehicle("crazyflie"), AIRFRAMES["cf2"])
CUT, PID, BY_LAW, LANDING = range(4)
FLIES, OFF, NO_POSITION, NO_BOB, NO_STATE, LOW_BATTERY, TUMBLE_CHECK, REFUSED, ON_GROUND = range(9)
DISABLE, ABSOLUTE, VELOCITY = range(3)
LEGACY, FORCE = 0, 2
HEIGHT = 3.5  # m


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("app")
    flown = fp.export_app("crazyflie", LAW, fp.vehicle("crazyflie"), place, height=HEIGHT)
    assert flown == VEHICLE
    for name in HEADERS:
        (place / name).write_text('#include "firmware.h"\n')
    return place


class Entry(ctypes.Structure):
    """A row of the tables of parameters and logs."""

    _fields_ = (
        ("type", ctypes.c_int), ("name", ctypes.c_char_p), ("address", ctypes.c_void_p), ("call", ctypes.c_void_p),
    )  # fmt: skip


class Firmware:
    """The app in stand-ins, at the start of each test as after a reboot."""

    KINDS = (ctypes.c_uint8, ctypes.c_uint16, ctypes.c_float, ctypes.c_uint8, ctypes.c_float)

    def __init__(self, library):
        self.c = ctypes.CDLL(str(library))
        self.c.standin_entries.restype = ctypes.POINTER(Entry)
        self.logs, self.parameters = self._entries(0), self._entries(1)
        self.tick, self.low, self.kind, self.flying, self.posed, self.sees_pose = 1000, 0, 2, 1, 0, True
        self.c.controllerOutOfTreeInit()

    def _entries(self, parameters):
        rows, found, i = self.c.standin_entries(parameters), {}, 0
        while rows[i].name:
            found[rows[i].name.decode()] = rows[i]
            i += 1
        return found

    def _cell(self, entry):
        return self.KINDS[entry.type].from_address(entry.address)

    def log(self, name):
        return self._cell(self.logs[name]).value

    def upload(self, name, value):
        """Set a parameter as the radio does, and return what it is then."""
        entry = self.parameters[name]
        self._cell(entry).value = value
        if entry.call:
            ctypes.CFUNCTYPE(None)(entry.call)()
        return self._cell(entry).value

    def _set(self):
        """The time, battery, estimator, whether it flies, and when the last pose came."""
        self.posed = self.tick if self.sees_pose else self.posed
        ticks = (ctypes.c_uint32(value) for value in (self.tick, self.posed))
        turning = round(65535 * VEHICLE.weight / 4 / VEHICLE.rotor_limits[1])  # hover, by the stand-in's linear fit
        self.c.standin_set(next(ticks), self.low, self.kind, self.flying, next(ticks), turning)

    def app(self, message=b""):
        self._set()
        self.c.standin_app(message, len(message))

    def see(self, state, vehicle=VEHICLE):
        self.app(struct.pack("<c3f", b"b", *(vehicle.l * state.y)))

    def watch(self, state, frames=100, modes=(ABSOLUTE,) * 3):
        """See the bob for so many frames, 10 ms each, until its rate and the rotors' forces are known."""
        for _ in range(frames):
            self.see(state)
            self.fly(state, modes, steps=10)

    def told(self):
        """Calls of PID, mode and velocity of z, position x that it was asked for, whether tumbling is checked."""
        found = np.zeros(5, np.float32)
        self.c.standin_get(found.ctypes.data_as(ctypes.c_void_p))
        return found

    def fly(self, state, modes=(ABSOLUTE,) * 3, setpoint=(0.3, -0.2, 0.4), thrust=0.0, steps=1):
        """Control mode and four numbers, after so many ms."""
        numbers = [*state.x, *state.x_dot, *Rotation.from_matrix(state.R).as_quat(), *np.degrees(state.omega)]
        given = np.array([*numbers, *setpoint, thrust], np.float32)
        found = np.zeros(5, np.float32)
        for _ in range(steps):
            self.tick += 1
            self._set()
            arguments = (given.ctypes.data_as(ctypes.c_void_p), (ctypes.c_int * 3)(*modes))
            self.c.standin_fly(*arguments, ctypes.c_uint32(self.tick), found.ctypes.data_as(ctypes.c_void_p))
        return found[0], found[1:]

    def begin(self, state):
        """In the air under PID, with the bob in sight, and switched on; the tick is even, the law flies next."""
        self.watch(state)
        self.tick += 1 - self.tick % 2
        assert self.fly(state)[0] == LEGACY
        self.upload("on", 1)
        assert self.fly(state)[0] == LEGACY  # tumbling is still checked
        self.see(state)
        self.tick += self.tick % 2 + 1


def _library(folder):
    flags = ("-std=gnu11", "-shared", "-fPIC", "-I.", f"-I{STANDINS / 'crazyflie'}", "-Wno-pedantic")
    sources = (*sorted(folder.glob("flypend_*.c")), STANDINS / "fly_crazyflie.c")
    return build(folder, sources, "app.so", flags=flags)


@pytest.fixture(scope="module")
def library(folder):
    return _library(folder)


@pytest.fixture
def firmware(library):
    return Firmware(library)


def _state(seed=3):
    start = fp.State.random(np.random.default_rng(seed), 1)[0]
    return fp.State(x=(0.1, -0.2, 4.0), x_dot=start.x_dot, R=start.R, omega=start.omega, y=start.y, y_dot=start.y_dot)


# When the law flies ---------------------------------------------------------------------------------------------------


def test_a_null_setpoint_stops_the_motors_and_switches_off(firmware):
    state = _state()
    for _ in range(2):
        mode, forces = firmware.fly(state, modes=(DISABLE,) * 3)
        assert mode == FORCE
        assert np.array_equal(forces, np.zeros(4))
        assert firmware.log("flies") == CUT
        firmware.begin(state)
        assert firmware.fly(state)[0] == FORCE
        assert firmware.log("flies") == BY_LAW
    firmware.fly(state, modes=(DISABLE,) * 3)
    assert firmware.fly(state)[0] == LEGACY  # it is not on any more


def test_until_it_is_switched_on_the_pid_controller_flies(firmware):
    state = _state()
    firmware.watch(state)
    before = firmware.told()[0]
    assert firmware.fly(state, steps=20)[0] == LEGACY
    assert firmware.told()[0] == before + 20
    assert (firmware.log("flies"), firmware.log("why")) == (PID, OFF)
    assert firmware.told()[4] == 1  # tumbling is checked


def test_the_law_commands_what_the_board_does(firmware):
    # In hover, where no rotor is at its limit, and at rest, so that bob and pose are the same whenever they were seen.
    state, target = fp.State(x=(0, 0, 4), omega=(0.1, -0.1, 0), y=(0, 0, 1.0)), (0.05, -0.02, 4.0)
    firmware.begin(fp.State(x=state.x, y=state.y))
    wanted = commands(VEHICLE, LAW, [state] * 3, [target] * 3)
    assert firmware.told()[4] == 0
    for row in wanted:
        mode, forces = firmware.fly(state, setpoint=target)
        assert (mode, firmware.log("flies"), firmware.log("status")) == (FORCE, BY_LAW, 0)
        assert np.allclose(0.12 * forces, row, rtol=5e-3)  # the gyroscope turns the attitude by 1e-4 a step
        again = firmware.fly(state, setpoint=target)[1]  # the loop runs at 1 kHz, the law at 500 Hz
        assert np.array_equal(again, forces)
    assert not np.allclose(wanted[0], wanted[1], rtol=1e-3)  # it remembers


@pytest.mark.parametrize(
    ("what", "why"),
    [("velocity setpoint", NO_POSITION), ("no bob", NO_BOB), ("no estimate", NO_STATE), ("other estimator", NO_STATE),
     ("old pose", NO_STATE), ("low battery", LOW_BATTERY), ("on the ground", ON_GROUND), ("too low", ON_GROUND),
     ("tumbling is checked", TUMBLE_CHECK)],
)  # fmt: skip
def test_it_does_not_begin_without(firmware, what, why):
    state = _state()
    firmware.flying = what != "on the ground"
    firmware.low, firmware.kind = int(what == "low battery"), 1 if what == "other estimator" else 2
    modes = (VELOCITY,) * 3 if what == "velocity setpoint" else (ABSOLUTE,) * 3
    here = _Nowhere(state) if what == "no estimate" else state
    if what == "too low":
        here = fp.State(x=(0, 0, float(HEIGHT) - 0.3), y=(0, 0, -1.0))
    if what != "no bob":
        firmware.watch(state, modes=modes)
    if what == "old pose":
        firmware.sees_pose = False
        firmware.watch(state, frames=21, modes=modes)
    firmware.upload("on", 1)
    if what != "tumbling is checked":
        firmware.tick += firmware.tick % 2
        firmware.fly(here, modes)  # then the app's task turns the check off
        if what == "no bob":
            firmware.app()
        else:
            firmware.see(state)
    firmware.tick += 1 - firmware.tick % 2  # the law's turn is next
    assert firmware.fly(here, modes)[0] == LEGACY
    assert (firmware.log("flies"), firmware.log("why")) == (PID, why)


class _Nowhere:
    """A state whose position is no number."""

    def __init__(self, state):
        self.x, self.x_dot, self.R, self.omega = np.full(3, np.nan), state.x_dot, state.R, state.omega


@pytest.mark.parametrize(("what", "why"), [("bob", NO_BOB), ("pose", NO_STATE), ("battery", LOW_BATTERY)])
def test_what_is_lost_in_flight_ends_in_a_landing(firmware, what, why):
    state = _state()
    firmware.begin(state)
    firmware.fly(state, steps=90)
    assert firmware.log("flies") == BY_LAW
    if what != "bob":
        firmware.low, firmware.sees_pose = int(what == "battery"), what != "pose"
        firmware.watch(state, frames=18)
        assert firmware.log("flies") == (BY_LAW if what == "pose" else LANDING)
    mode, _ = firmware.fly(state, steps=30)
    assert (mode, firmware.log("flies"), firmware.log("why")) == (LEGACY, LANDING, why)
    told = firmware.told()
    assert (told[1], told[2]) == (VELOCITY, 0)  # it hovers where it lost the bob
    moved = 0.25 * abs(state.x_dot[0]) if what == "pose" else 1e-6  # without poses, its own estimate moves on for 0.2 s
    assert told[3] == pytest.approx(state.x[0], abs=moved)
    firmware.low, firmware.sees_pose = 0, True
    firmware.see(state)
    firmware.upload("on", 1)
    firmware.fly(state, steps=1100)
    assert firmware.told()[2] == pytest.approx(-0.3)  # and goes down, though the bob is back
    firmware.app()
    assert firmware.told()[4] == 1  # tumbling is checked again
    for height in (0.04, 1.0):  # nor does it start again when somebody picks it up
        mode, forces = firmware.fly(fp.State(x=(0.1, -0.2, height), y=(0, 0, -1.0)))
        assert mode == FORCE
        assert np.array_equal(forces, np.zeros(4))
    firmware.fly(state, modes=(DISABLE,) * 3)
    assert firmware.fly(state)[0] == LEGACY


def test_a_landing_ends_though_the_ground_is_not_where_it_was(firmware):
    state = _state()
    firmware.begin(state)
    firmware.fly(state, steps=120)
    assert firmware.log("flies") == LANDING
    assert firmware.fly(state, steps=18_000)[0] == FORCE  # 4 m at 0.3 m/s, and some seconds
    assert np.array_equal(firmware.fly(state)[1], np.zeros(4))


def test_a_landing_levels_out_with_the_supervisor_and_can_be_taken_over(firmware):
    state = _state()
    firmware.begin(state)
    firmware.fly(state, steps=120)
    firmware.fly(state, modes=(DISABLE, DISABLE, ABSOLUTE), steps=10)
    assert firmware.log("flies") == LANDING
    assert firmware.told()[1] == VELOCITY
    assert firmware.fly(state, modes=(DISABLE,) * 3, thrust=20000.0)[0] == LEGACY  # by hand
    assert firmware.log("flies") == PID


def test_the_law_stops_on_the_ground(firmware):
    state = _state()
    firmware.begin(state)
    assert firmware.fly(state, steps=3)[0] == FORCE
    mode, forces = firmware.fly(fp.State(x=(0, 0, 0.02), R=state.R, y=(0, 0, -1.0)))
    assert mode == FORCE
    assert np.array_equal(forces, np.zeros(4))
    assert np.array_equal(firmware.fly(state)[1], np.zeros(4))


def test_the_switch_gives_it_back_to_pid_at_once(firmware):
    state = _state()
    firmware.begin(state)
    assert firmware.fly(state, steps=4)[0] == FORCE
    firmware.upload("on", 0)
    assert firmware.fly(state)[0] == LEGACY
    assert (firmware.log("flies"), firmware.log("why")) == (PID, OFF)
    firmware.fly(state, steps=1001)
    firmware.app()
    assert firmware.told()[4] == 1  # tumbling is checked again, after a second
    firmware.begin(state)
    assert firmware.fly(state, modes=(DISABLE, DISABLE, ABSOLUTE))[0] == LEGACY  # the supervisor levels out
    assert firmware.log("flies") == PID


def test_timers_that_wrap_change_nothing(library):
    """The firmware's ticks and steps of 32 bits wrap after 50 days, the poses' of 16 bits after 65 s."""
    flights = []
    for begun in (1000, 2**32 - 1100):
        firmware, state, rows = Firmware(library), _state(), []
        firmware.tick = begun
        firmware.begin(state)
        for _ in range(30):
            firmware.see(state)
            mode, forces = firmware.fly(state, steps=5)
            rows.append([mode, *forces, firmware.log("flies"), firmware.log("why"), firmware.log("bobAge")])
        mode, _ = firmware.fly(state, steps=120)  # without a bob
        flights.append([*rows, [mode, firmware.log("flies"), firmware.log("why")]])
        assert firmware.tick % 2**32 < 3000
        assert firmware.log("flies") == LANDING
    assert all(np.array_equal(a, b) for a, b in zip(*flights, strict=True))


def test_a_packet_of_another_kind_or_without_numbers_is_no_bob(firmware):
    state = _state()
    for message in (b"b", b"c" + bytes(12), struct.pack("<c3f", b"b", np.nan, 0.0, 0.0)):
        firmware.app(message)
        firmware.fly(state)
        assert firmware.log("bobAge") == 2**16 - 1


def test_parameters_that_the_law_cannot_fly_with_are_refused_at_upload(firmware):
    state = _state()
    for name, good in (("mass", 0.031), ("bobMass", 0.0025), ("rodLength", 0.45)):
        assert firmware.upload(name, good) == pytest.approx(good)
        heavy = () if name == "rodLength" else (1000 * good,)  # grams for kg: the rotors cannot carry it
        for bad in (0.0, -1.0, np.nan, np.inf, *heavy):
            assert firmware.upload(name, bad) == pytest.approx(good)
    assert firmware.upload("late", 12.0) == 12
    assert firmware.upload("late", np.nan) == 12
    assert firmware.upload("height", 2.5) == 2.5
    assert firmware.upload("height", 0.1) == 2.5
    firmware.begin(state)
    firmware.fly(state)
    assert firmware.upload("rodLength", 0.6) == pytest.approx(0.45)  # it flies


# With an estimator, and with a plan -----------------------------------------------------------------------------------


@pytest.fixture(scope="module", params=[{"sensors": "mocap"}, {"planned": True}], ids=["estimator", "plan"])
def more(request, tmp_path_factory):
    """The options of an app, and its library."""
    place = tmp_path_factory.mktemp("more")
    fp.export_app("crazyflie", LAW, fp.vehicle("crazyflie"), place, height=HEIGHT, **request.param)
    for name in HEADERS:
        (place / name).write_text('#include "firmware.h"\n')
    return request.param, _library(place)


@pytest.mark.parametrize(("target", "name"), [("crazyflie", "crazyflie"), ("px4", "hehn2011")])
def test_a_rod_that_is_not_light_is_told_to_the_firmware_as_the_pendulum_that_swings_alike(target, name, tmp_path):
    light = fp.vehicle(name)
    made = light.replace(**fp.rod_with_bob(light.bob_mass / 2, light.rod_length, light.bob_mass / 2))
    vehicle = fp.export_app(target, LAW, made, tmp_path, height=3.0)
    numbers = _pendulum(target, tmp_path)
    np.testing.assert_allclose(numbers, params_of(vehicle)[:3], rtol=1e-6)  # what the law is called with
    assert abs(numbers[2] - vehicle.rod_length) > 0.05 * vehicle.l  # negative control


def _pendulum(target, folder):
    """M, m and l that the app begins with."""
    if target == "px4":
        table = (folder / "module.yaml").read_text()
        found = [
            re.search(rf"FPD_{key}:.*?default: (\S+)", table, re.DOTALL)[1] for key in ("MASS", "BOB_MASS", "ROD_LEN")
        ]
    else:
        found = re.search(r"asked = \{([^}]*)\}", (folder / "flypend_app.c").read_text())[1].split(", ")[:3]
    return [float(number.rstrip("f")) for number in found]


@pytest.mark.parametrize(("target", "name"), [("crazyflie", "crazyflie"), ("px4", "hehn2011")])
def test_masses_are_over_the_scale_of_thrust_as_in_the_law_and_the_weight_is_that_of_the_scales(target, name, tmp_path):
    machine = fp.vehicle(name).replace(thrust_scale=0.8)
    fp.export_app(target, LAW, machine, tmp_path, height=3.0)
    numbers, defaults = _pendulum(target, tmp_path), (tmp_path / "flypend_law.c").read_text()
    np.testing.assert_allclose(numbers, [machine.M / 0.8, machine.m / 0.8, machine.l], rtol=1e-6)
    law_mass = re.search(r"flypend_default_params = \{.*?([0-9][0-9.e-]*)f", defaults, re.DOTALL)[1]
    assert float(law_mass) == pytest.approx(numbers[0])
    assert f"{1e3 * (machine.mass + machine.bob_mass):.3g} g with rod" in (tmp_path / "README.md").read_text()


def test_an_app_with_more_before_the_law_keeps_its_rules(more):
    options, library = more
    firmware, state = Firmware(library), _state()
    assert firmware.upload("late", 11.0) == 11  # the latency of the suite, and the step that a pose waits for
    assert firmware.upload("late", 12.0) == (11 if "sensors" in options else 12)
    firmware.upload("late", 0.0)
    firmware.begin(state)
    for _ in range(30):
        firmware.see(state)
        mode, forces = firmware.fly(state, steps=10)
        assert mode == FORCE
        assert firmware.log("status") == 0
        assert np.all((forces >= 0) & (forces <= 1))
    assert forces.max() > 0
    assert firmware.fly(state, steps=102)[0] == LEGACY
    assert (firmware.log("flies"), firmware.log("why")) == (LANDING, NO_BOB)
    assert np.array_equal(firmware.fly(state, modes=(DISABLE,) * 3)[1], np.zeros(4))


def test_a_plan_flies_level_along_x_from_where_the_rod_hangs_and_else_the_law_to_the_bit(more, library, tmp_path):
    options, with_more = more
    if "planned" not in options:
        pytest.skip("the app with an estimator has no plan")
    starts = [(_state(), True)]
    for heading, same in ((0, False), (-8, False), (12, True), (180, True)):  # degrees
        turned = Rotation.from_euler("z", heading, degrees=True).as_matrix()
        starts.append((fp.State(x=(0.3, -0.2, 4.0), R=turned, y=(0, 0, -1.0)), same))
    for i, (state, same) in enumerate(starts):
        flights = []
        for number, flown in enumerate((library, with_more)):  # copies: other tests leave parameters behind
            firmware = Firmware(shutil.copy(flown, tmp_path / f"{number}{i}.so"))
            firmware.begin(state)
            flights.append([firmware.fly(state, setpoint=state.x) for _ in range(60)])
        for (mode, forces), (other_mode, others) in zip(*flights, strict=True):
            assert mode == other_mode == FORCE
            assert np.array_equal(forces, others) == same


# What it refuses to write ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("target", "change", "more", "field"),
    [
        ("bitcraze", {}, {}, "target"),
        ("crazyflie", {}, {"airframe": "cf3"}, "airframe"),
        ("crazyflie", {}, {"airframe": "cf21bl"}, "rotor_positions"),
        ("crazyflie", {}, {"rate": 300.0}, "rate"),
        ("crazyflie", {"bob_mass": 0.03}, {}, "vehicle"),
        ("crazyflie", {"thrust_scale": 0.4}, {"height": 2.0}, "vehicle"),
        ("crazyflie", {}, {"sensors": "onboard"}, "sensors"),
        ("crazyflie", {}, {"sensors": "mocap", "planned": True}, "planned"),
        ("px4", {}, {"sensors": "mocap"}, "sensors"),
        ("px4", {}, {"planned": True}, "planned"),
        ("crazyflie", {"rotor_spins": (1, -1, 1, -1)}, {}, "rotor_positions"),
    ],
)
def test_what_is_no_such_vehicle_is_refused_and_nothing_is_written(target, change, more, field, tmp_path):
    vehicle = fp.vehicle("crazyflie").replace(**change)
    with pytest.raises(fp.InputError, match=f"^{field}: "):
        fp.export_app(target, LAW, vehicle, tmp_path / "app", **more)
    assert not (tmp_path / "app").exists()


def test_a_law_that_does_not_swing_up_is_refused_unless_a_height_is_given(tmp_path):
    with pytest.raises(fp.InputError, match=r"law: .*swings the rod up.*lqr: \d+ of 25"):
        fp.export_app("crazyflie", fp.laws.lqr(), fp.vehicle("crazyflie"), tmp_path / "app")
    assert not (tmp_path / "app").exists()
    fp.export_app("crazyflie", fp.laws.lqr(), fp.vehicle("crazyflie"), tmp_path / "app", height=2.0)


def test_the_height_is_that_of_a_swing_up_and_the_same_everywhere(tmp_path):
    vehicle = fp.vehicle("crazyflie")
    drops = []
    for turn in (0.5, 2.0, 3.5, 5.0):
        y = (0.02 * np.cos(turn), 0.02 * np.sin(turn), -np.sqrt(1 - 0.02**2))
        run = fp.simulate(VEHICLE, LAW, fp.State(y=y), 6.0)
        drops.append(-min(run.x[:, 2].min(), (run.x + vehicle.l * run.y)[:, 2].min()))
    fp.export_app("crazyflie", LAW, vehicle, tmp_path)
    height = float(re.search(r"height = ([0-9.]+)f;", (tmp_path / "flypend_app.c").read_text())[1])
    assert max(drops) < height < 3 * max(drops)
    readme = (tmp_path / "README.md").read_text()
    assert f"--hover {height:g}`" in readme
    assert f"take {height:g} m below" in readme


def test_the_same_arguments_give_the_same_bytes(folder, tmp_path):
    fp.export_app("crazyflie", LAW, fp.vehicle("crazyflie"), tmp_path, height=HEIGHT)
    for path in tmp_path.iterdir():
        assert path.read_bytes() == (folder / path.name).read_bytes(), path.name


# What it costs --------------------------------------------------------------------------------------------------------


DEEP = ("corrected", "learned", "almost_global", "inverted, with estimator", "inverted, with plan")


@pytest.mark.parametrize("name", few(DEEP, LAWS))
def test_the_control_task_needs_less_stack_than_the_firmware_can_spare(name, tmp_path):
    app = exported(name, fp.vehicle("crazyflie"), tmp_path)
    used, flown = stack(app)
    assert flown > 90
    assert 150 < used < fits.BUDGETS["crazyflie"].most["bytes of stack"]
    texts = {
        path.name: path.read_text() for part in ("law", "sensors", "plan") for path in app.glob(f"flypend_{part}.[ch]")
    }
    told = fits.measure_size(tuple(sorted(texts.items())), fits.BUDGETS["crazyflie"])
    # Frames are multiples of 8. The deepest call with a plan is not the one that the estimate adds the app's frames to.
    assert 0 <= told["bytes of stack"] - used <= 48
    flash, memory = size(app)
    assert told["bytes of flash"] == pytest.approx(flash, rel=0.02)
    assert told["bytes of RAM"] == pytest.approx(memory, rel=0.05)


@pytest.mark.parametrize(
    ("what", "most"),
    [("cycles", 40_000), ("bytes of stack", 300), ("bytes of flash", 50_000), ("bytes of RAM", 3_000)],
)
def test_a_law_that_does_not_fit_is_refused_and_told_by_how_much(what, most, tmp_path, monkeypatch):
    monkeypatch.setitem(fits.BUDGETS["crazyflie"].most, what, most)
    with pytest.raises(fp.InputError, match=rf"law: .*at most {most:,} {what} .*inverted: [\d,]+ {what}, \d+ % too"):
        fp.export_app("crazyflie", LAW, fp.vehicle("crazyflie"), tmp_path / "app", height=HEIGHT)
    assert not (tmp_path / "app").exists()


# Against the firmware itself ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("airframe", "vehicle", "whole"),
    [("cf2", "crazyflie", False), slow("cf2", "crazyflie", True), slow("cf21bl", "crazyflie-brushless", True)],
)
def test_it_builds_with_the_firmware(airframe, vehicle, whole, firmware_source, tmp_path):
    """To a binary, by the two commands of its README; or the app alone, by the firmware's own rules and headers."""
    fp.export_app("crazyflie", LAW, fp.vehicle(vehicle), tmp_path, height=HEIGHT)
    base = f"CRAZYFLIE_BASE={firmware_source}"
    alone = (f"objs-y={tmp_path}", "image_LDFLAGS=-nostdlib -r", "PYTHON=true")  # whose sizes PYTHON would tell
    run(["make", base, f"{airframe}_defconfig"], tmp_path)
    said = run(["make", "-j2", base, *(() if whole else alone)], tmp_path)
    assert (tmp_path / "build" / f"{airframe}.bin").stat().st_size > (100_000 if whole else 10_000)
    assert "warning" not in said
    config = (tmp_path / "build" / ".config").read_text()
    assert {"CONFIG_MOTORS_REQUIRE_ARMING=y", "CONFIG_CONTROLLER_OOT=y"} <= set(config.splitlines())
