"""The host script of the Crazyflie's app, over loopback: a vehicle and a motion capture that only keep books."""

import importlib.util
import os
import pty
import struct
import sys
import tty
from pathlib import Path

import numpy as np
import pytest

import flypend

SCRIPT = Path(flypend.__file__).parent / "export" / "templates" / "crazyflie" / "flypend_host.py"
PERIOD = 0.01  # s between frames


@pytest.fixture(scope="module")
def host():
    spec = importlib.util.spec_from_file_location("flypend_host", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Vehicle:
    """What cflib shows of a vehicle. Motors turn while it is armed, not locked, and asked to be somewhere.

    `interrupts` are the numbers of calls that Ctrl-C comes before.
    """

    def __init__(self, interrupts=(), refuses=None):
        self.calls, self.interrupts, self.refuses = [], set(interrupts), refuses or {}
        self.armed = self.locked = self.moving = False
        self.values, self.listeners, self.late = {}, {}, 0
        self.param = self.extpos = self.appchannel = self.commander = self.high_level_commander = self
        self.supervisor = self

    @property
    def motors(self):
        return self.armed and self.moving and not self.locked

    def _note(self, name, *given):
        self.calls.append((name, *given))
        if len(self.calls) in self.interrupts:
            raise KeyboardInterrupt

    def add_update_callback(self, group, name, cb):
        self.listeners[f"{group}.{name}"] = cb

    def remove_update_callback(self, group, name, cb):
        assert self.listeners.pop(f"{group}.{name}") is cb

    def set_value(self, name, value):
        self._note("set", name, value)
        self.values[name] = self.refuses.get(name, value)
        if name == "stabilizer.controller":
            self.values["flypend.on"] = 0
        if name in self.listeners:
            self.listeners[name](name, str(value))  # repeats what was written

    def request_param_update(self, name):
        self._note("read", name)
        self.listeners[name](name, str(float(np.float32(self.values[name]))))

    def send_extpose(self, *pose):
        self._note("pose", *pose)

    def send_packet(self, data):
        self._note("bob", *struct.unpack("<c3f", data))

    def send_position_setpoint(self, *place):
        self._note("setpoint", *place)
        self.moving = True

    def send_notify_setpoint_stop(self):
        self._note("relax")

    def land(self, height, duration):
        self._note("land", height, duration)

    def send_arming_request(self, wanted):
        self._note("arm", wanted)
        self.armed = wanted

    def send_emergency_stop(self):
        self._note("stop")
        self.locked = True

    def told(self, name):
        return [call[1:] for call in self.calls if call[0] == name]


class Room:
    """Motion capture at 100 Hz, and the clock; the bob circles. `lost` says when the bob, `dark` when all is unseen.

    From `stuck` on it repeats the bodies that it saw last, in new frames.
    """

    def __init__(self, host, keys=(), lost=(9e9, 9e9), dark=(9e9, 9e9), stuck=9e9):
        self.host, self.keys, self.lost, self.dark, self.time, self.said = host, dict(keys), lost, dark, 0.0, []
        self.stuck = stuck

    def bob(self, at):
        return (0.1 + 0.3 * np.cos(at), 0.3 * np.sin(at), 1.0)

    def read(self):
        at = PERIOD * int(self.time / PERIOD)
        if self.dark[0] <= at < self.dark[1]:
            return None
        then = min(at, self.stuck)
        bob = None if self.lost[0] <= at < self.lost[1] else self.bob(then)
        return self.host.Frame(500 + at, (0.1 + 1e-6 * then, 0.2, 0.3), (0, 0, 0, 1), bob)

    def pause(self, duration):
        self.time += duration

    def pressed(self):
        due = [at for at in self.keys if at <= self.time]
        return "".join(self.keys.pop(at) for at in sorted(due))

    def session(self, vehicle):
        return self.host.Session(
            vehicle, self, self.pressed, now=lambda: self.time, pause=self.pause, say=self.said.append
        )


def _flown(host, keys, height=1.5, vehicle=None, parameters=(), **room):
    vehicle, place = vehicle or Vehicle(), Room(host, keys, **room)
    place.session(vehicle).fly(height, parameters)
    return vehicle, place


def test_it_sends_each_frame_once_with_the_bob_from_the_vehicle(host):
    vehicle, _ = _flown(host, {1.0: " "}, height=None)
    assert len(vehicle.told("pose")) == pytest.approx(100, abs=2)  # looked at a thousand times
    assert vehicle.told("pose")[5] == pytest.approx((0.1, 0.2, 0.3, 0, 0, 0, 1), abs=1e-5)
    bobs = vehicle.told("bob")
    assert len(bobs) == len(vehicle.told("pose"))
    rod = np.array([bob[1:] for bob in bobs])
    assert np.allclose(np.hypot(rod[:, 0], rod[:, 1] + 0.2), 0.3)  # the bob circles 0.2 m beside the vehicle
    assert np.allclose(rod[:, 2], 0.7)
    assert not vehicle.told("arm")
    assert not vehicle.told("stop")  # which would lock it


def test_it_says_when_the_bob_is_unseen_and_sends_none_then(host):
    vehicle, room = _flown(host, {3.0: " "}, height=None, lost=(1.0, 2.0))
    assert len(vehicle.told("pose")) == pytest.approx(300, abs=3)
    assert [line for line in room.said if "bob" in line] == ["the bob is NOT SEEN", "the bob is seen again"]
    assert len(vehicle.told("bob")) == pytest.approx(200, abs=3)
    assert any(line.startswith("rod, m: ") for line in room.said)


def test_what_motion_capture_repeats_to_the_last_digit_is_not_seen(host):
    vehicle, room = _flown(host, {3.0: " "}, height=None, stuck=1.0)
    assert len(vehicle.told("pose")) == pytest.approx(100, abs=2)
    assert len(vehicle.told("bob")) == pytest.approx(100, abs=2)
    assert [line for line in room.said if "SEEN" in line] == ["motion capture is NOT SEEN", "the bob is NOT SEEN"]


def test_without_motion_capture_it_says_so_and_does_not_arm(host):
    vehicle, room = _flown(host, {5.0: " "}, dark=(0.0, 9e9))
    assert room.said[0] == "motion capture is NOT SEEN"
    assert not vehicle.told("pose")
    assert not vehicle.told("arm")
    assert not vehicle.told("stop")


def test_the_controller_comes_first_and_the_law_is_off(host):
    vehicle, _ = _flown(host, {0.5: " "}, height=None, parameters={"flypend.mass": 0.031})
    assert vehicle.told("set")[0] == ("stabilizer.controller", 6)
    assert vehicle.values["flypend.mass"] == 0.031
    assert vehicle.told("set")[-1][0] == "flypend.mass"
    assert vehicle.values["flypend.on"] == 0


@pytest.mark.parametrize("kept", [0.027, float("nan")])
def test_a_parameter_that_the_firmware_refused_is_not_flown_with(host, kept):
    vehicle = Vehicle(refuses={"flypend.mass": kept})
    with pytest.raises(host.RefusedError, match=r"flypend\.mass: 0\.5 was refused, it stays"):
        _flown(host, {9.0: " "}, vehicle=vehicle, parameters={"flypend.mass": 0.5})
    assert not vehicle.told("arm")
    assert not vehicle.told("stop")


def test_a_vehicle_that_does_not_answer_is_not_armed(host):
    vehicle = Vehicle()
    vehicle.request_param_update = lambda name: None
    with pytest.raises(host.RefusedError, match="no answer"):
        host.tell(vehicle, "flypend.late", 10.0, patience=0.01)


def test_a_flight_takes_off_obeys_lands_and_disarms(host):
    vehicle, _ = _flown(host, {6.0: "l", 8.0: "p", 10.0: "d"})
    heights = [place[2] for place in vehicle.told("setpoint")]
    assert heights[0] == pytest.approx(0.3, abs=0.01)
    assert heights[-1] == pytest.approx(1.8)
    assert np.all(np.diff(heights) >= 0)
    assert np.diff(heights).max() < 0.02
    names = [call[:3] for call in vehicle.calls]
    order = [names.index(("arm", True)), names.index(("set", "flypend.on", 1)), names.index(("relax",))]
    assert order == sorted(order)
    assert vehicle.told("set")[-1] == ("flypend.on", 0)
    assert vehicle.told("land") == [(0.3, 3.0)]
    assert vehicle.told("arm") == [(True,), (False,)]
    assert not vehicle.locked  # it may fly again
    poses = [i for i, call in enumerate(vehicle.calls) if call[0] == "pose"]
    assert poses[-1] > names.index(("land", 0.3, 3.0)) + 300  # until it stands


@pytest.mark.parametrize("at", [2.5, 6.5, 11.0])
def test_space_stops_the_motors_climbing_under_the_law_and_landing(host, at):
    vehicle, _ = _flown(host, {6.0: "l", 10.0: "d", at: " "} if at > 10 else {6.0: "l", at: " "})
    assert vehicle.told("arm") == [(True,)]
    assert vehicle.locked
    assert not vehicle.motors
    assert vehicle.calls[-1] == ("stop",)


def test_keys_that_came_together_are_all_obeyed(host):
    vehicle, _ = _flown(host, {6.0: "lp ", 9.0: "d"})
    on = [value for name, value in vehicle.told("set") if name == "flypend.on"]
    assert on == [0, 1, 0]
    assert vehicle.locked


def test_ctrl_c_at_any_call_stops_the_motors(host):
    """Before each call to the vehicle of a whole flight, and again while it stops."""
    whole, _ = _flown(host, {3.0: "l", 4.0: "p", 5.0: "d"})
    armed = next(i for i, call in enumerate(whole.calls, 1) if call == ("arm", True))
    asked = range(1, len(whole.calls) + 1)
    close = [i for i in asked if i % 39 == 0 or whole.calls[i - 1][0] in ("set", "read", "arm", "relax", "land")]
    for number in close:
        for again in ((), (number + 1,), (number + 1, number + 2)):
            vehicle = Vehicle(interrupts=(number, *again))
            with pytest.raises(KeyboardInterrupt):
                _flown(host, {3.0: "l", 4.0: "p", 5.0: "d"}, vehicle=vehicle)
            assert not vehicle.motors, (number, again)
            assert vehicle.locked == (number >= armed), (number, again)  # a lock needs a restart


def test_a_script_that_would_not_stop_is_found(host, monkeypatch):
    """The check above can fail."""
    monkeypatch.setattr(host, "stop", lambda *_: None)
    vehicle = Vehicle(interrupts=(600,))
    with pytest.raises(KeyboardInterrupt):
        _flown(host, {9.0: "d"}, vehicle=vehicle)
    assert vehicle.motors


def test_a_motion_capture_that_fails_in_flight_stops_the_motors(host):
    room, vehicle = Room(host), Vehicle()
    seen = room.read
    room.read = lambda: seen() if room.time < 4 else 1 / 0
    with pytest.raises(ZeroDivisionError):
        room.session(vehicle).fly(1.5)
    assert vehicle.locked


def test_keys_come_from_a_terminal_without_waiting_for_lines(host):
    master, slave = pty.openpty()
    try:
        tty.setcbreak(slave)
        keys = host.Keys(slave)
        assert keys() == ""
        os.write(master, b"lp")
        assert keys() == "lp"
        assert keys() == ""
    finally:
        os.close(slave)
        os.close(master)


def test_a_terminal_that_is_gone_lands(host):
    read, write = os.pipe()
    os.close(write)
    keys = host.Keys(read)
    assert (keys(), keys()) == ("d", "")
    os.close(read)


def test_it_wants_to_be_told_what_to_do(host, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["flypend_host.py", "radio://0/80"])
    with pytest.raises(SystemExit):
        host.main()
    assert "--watch" in capsys.readouterr().err
