"""The firmware and a vehicle in one loop of 1 kHz, with a ground station that sends what the host script sends."""

from __future__ import annotations

import ctypes
import importlib.util
import shutil
import struct
import tempfile
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicHermiteSpline
from scipy.spatial.transform import Rotation

import flypend as fp
from benchmarks.ticking import Ticking
from flypend import geometry
from flypend.plants.actuation import make_engine
from flypend.plants.plant import as_sampled
from flypend.plants.sensing import mean_force

TICK = 1e-3  # s
FRAMES, SETPOINTS = 10, 20  # ticks between frames of motion capture, and between setpoints
HOME = np.array([0.0, 0.0, 5.0])  # m: a swing-up drops by two metres, and may not touch the ground
CUT, PID, LAW, LANDING = range(4)  # flypend.flies
GRAVITY = 9.81  # m/s², in which the firmware's accelerometer counts
STILL = np.zeros(6)  # no wind
CARRYING, FALLING = 1.5, 0.3  # s that the rig carries the vehicle, and that it falls until the law begins
KALMAN, APP, OWN = 2, 6, 1  # stabilizer.estimator; stabilizer.controller of the app, and the firmware's PID


def _host_script():
    """The template of the host script, as a module."""
    path = Path(fp.__file__).parent / "export" / "templates" / "crazyflie" / "flypend_host.py"
    spec = importlib.util.spec_from_file_location("flypend_host", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


HOST = _host_script()


class _World(ctypes.Structure):
    _fields_ = (
        ("gyro", ctypes.c_float * 3), ("acc", ctypes.c_float * 3), ("voltage", ctypes.c_float),
        ("battery_is_low", ctypes.c_int32),
    )  # fmt: skip


class Firmware:
    """The firmware after power-up, in memory of its own."""

    def __init__(self, library: Path) -> None:
        with tempfile.TemporaryDirectory() as folder:  # each needs a library that nobody has loaded
            self._c = ctypes.CDLL(shutil.copy(library, folder))
        self._c.host_log.restype = self._c.host_parameter.restype = ctypes.c_double
        self._c.host_said.restype = ctypes.c_char_p
        self._c.host_boot(KALMAN)
        self._forces = (ctypes.c_float * 4)()

    def step(self, world: _World) -> np.ndarray:
        """Rotor forces (4,), N, that its motors would settle at, after one tick."""
        self._c.host_step(ctypes.byref(world), self._forces)
        return np.array(self._forces, dtype=float)

    def packet(self, port: int, channel: int, data: bytes) -> None:
        """Let a packet arrive."""
        assert self._c.host_packet(port, channel, data, len(data))

    def log(self, name: str) -> float:
        """A logged number of 8 or 16 bits, or single precision."""
        return self._c.host_log(*(part.encode() for part in name.split(".")))

    def set(self, name: str, value: float) -> float:
        """Upload a parameter, and return what it is then."""
        group, own = (part.encode() for part in name.split("."))
        assert self._c.host_set(group, own, ctypes.c_double(value))
        return self._c.host_parameter(group, own)

    @property
    def numbers(self) -> dict[str, float]:
        """The airframe as the firmware knows it."""
        found = (ctypes.c_float * 4)()
        self._c.host_numbers(found)
        return dict(zip(("arm", "least", "largest", "torque"), (float(value) for value in found), strict=True))

    @property
    def said(self) -> str:
        """What it has printed."""
        return self._c.host_said().decode()


class Vehicle(Ticking):
    """A vehicle under the firmware, from power-up on a rig that holds it level, with the rod hanging.

    Parameters
    ----------
    library : Path
        Of `built.build`.
    vehicle : flypend.Vehicle
        The true one.
    plant : str or flypend.Plant
        Its engine.
    home : (3,)
        Where the rig is, and where it is asked to hover, m.
    """

    period = TICK

    def __init__(self, library: Path, vehicle: fp.Vehicle, plant="rotors", *, home=HOME) -> None:
        self.vehicle, self.firmware, self.world = vehicle, Firmware(library), _World()
        self.engine = make_engine(vehicle, as_sampled(plant))
        self.rest = fp.State(x=home, y=(0.0, 0.0, -1.0))
        self.engine.reset(self.rest.packed(), np.zeros(4))
        self.state = self._before = self.rest
        self.target, self.link, self.sees_bob, self.sees_pose = np.array(home), True, True, True
        self.voltage, self.battery_is_low = 4.0, False
        self.gyro_off, self.acc_off = np.zeros(3), np.zeros(3)  # deg/s, g
        self.ticks, self.setpoints = 0, False
        self.forces = np.zeros(4)
        self.log: list[tuple] = []  # state, forces, flies of each tick

    # What the ground station does -------------------------------------------------------------------------------------

    def arm(self, armed: bool = True) -> None:
        """Arm or disarm."""
        self.firmware.packet(9, 1, struct.pack("<B?", 1, armed))

    def emergency(self) -> None:
        """Stop for good."""
        self.firmware.packet(9, 1, struct.pack("<B", 3))

    def stop(self) -> None:
        """Send the stop setpoint."""
        self.setpoints = False
        self.firmware.packet(7, 0, struct.pack("<B", 0))

    def land(self, height: float, duration: float) -> None:
        """Land with the high-level commander."""
        self.setpoints = False
        self.firmware.packet(7, 1, struct.pack("<BI", 0, 0))
        self.firmware.packet(8, 0, struct.pack("<BBff?f", 8, 0, height, 0.0, True, duration))

    def _radio(self) -> None:
        state = self.state
        if self.ticks % FRAMES == 0:
            if self.sees_pose:
                quaternion = geometry.quat_xyzw_from_rotation(state.R)
                self.firmware.packet(6, 1, struct.pack("<B7f", 8, *state.x, *quaternion))
            if self.sees_bob:
                frame = HOST.Frame(self.ticks * TICK, state.x, None, state.x + self.vehicle.l * state.y)
                self.firmware.packet(13, 2, HOST.rod_packet(frame))
        if self.setpoints and self.ticks % SETPOINTS == 0:
            self.firmware.packet(7, 0, struct.pack("<B4f", 7, *self.target, 0.0))

    # Time -------------------------------------------------------------------------------------------------------------

    def tick(self, carried: fp.State | None = None) -> None:
        """One millisecond: in flight, or to the state where the rig carries it."""
        state, before = self.state, self._before
        if self.link:
            self._radio()
        acc = mean_force(before.x_dot, state.x_dot, before.R, state.R, GRAVITY, TICK) / GRAVITY
        world = self.world
        world.gyro[:] = (np.degrees(state.omega) + self.gyro_off).tolist()
        world.acc[:] = (acc + self.acc_off).tolist()
        world.voltage, world.battery_is_low = self.voltage, int(self.battery_is_low)
        self.forces = self.firmware.step(world)
        self._before = state
        self.engine.step(self.forces, TICK, STILL)
        if carried is not None:  # its rotors spin up as they do
            self.engine.reset(carried.packed(), self.engine.rotors)
        self.state = fp.State.trusted(np.array(self.engine.packed).ravel())
        self.ticks += 1
        self.log.append((state, self.forces, self.flies))

    @property
    def flies(self) -> int:
        """What flies: CUT, PID, LAW or LANDING."""
        return int(self.firmware.log("flypend.flies"))

    def hold(self, duration: float) -> None:
        """Stay on the rig."""
        for _ in range(round(duration / TICK)):
            self.tick(self.rest)

    def lift(self, controller: int = APP) -> None:
        """Power up, arm, and let PID run on the rig until the firmware believes that it flies."""
        self.firmware.set("stabilizer.controller", controller)
        for name, value in HOST.FILTER.items():
            self.firmware.set(name, value)
        self.hold(1.5)  # its Kalman filter settles
        self.arm()
        self.hold(0.1)
        self.setpoints = True
        self.hold(0.4)
        assert self.firmware.log("sys.isFlying") == 1, self.firmware.said

    def release(self, start: fp.State) -> bool:
        """Carry it to where it falls freely to `start`, with the law switched on just before. Whether the law flies.

        The rig follows cubic paths in x and in the rotation vectors of R and y, from rest to where it lets go. In free
        fall the rod turns as a rod does, which one that is held by a rig does not.
        """
        self.firmware.set("supervisor.tmblChckEn", 0)  # the rig may turn it over
        falling = fall(self.vehicle, start)
        path = [*states(carried(self.rest, falling[0], CARRYING)), *falling[1:]]
        for i, state in enumerate(path):
            if i * TICK > CARRYING + FALLING - 0.022:  # the app's task turns the check off within 20 ms
                self.firmware.set("flypend.on", 1)
            self.tick(state)
            if self.flies == LAW:
                return True
        return False


def fall(vehicle: fp.Vehicle, start: fp.State) -> list[fp.State]:
    """States of a free fall through `start`, one a tick, from FALLING seconds before it to 20 ms after it.

    Without thrust the motion is the same backwards in time, with the rates reversed.
    """
    engine, none = make_engine(vehicle, as_sampled("rotors")), np.zeros(4)

    def flown(begin: fp.State, duration: float) -> list[fp.State]:
        engine.reset(begin.packed(), none)
        found = []
        for _ in range(round(duration / TICK)):
            engine.step(none, TICK, STILL)
            found.append(fp.State.trusted(np.array(engine.packed).ravel()))
        return found

    before = [reversed_rates(state) for state in flown(reversed_rates(start), FALLING)]
    return [*before[::-1], start, *flown(start, 0.02)]


def reversed_rates(state: fp.State) -> fp.State:
    """The state with its rates reversed."""
    return fp.State(x=state.x, x_dot=-state.x_dot, R=state.R, omega=-state.omega, y=state.y, y_dot=-state.y_dot)


def carried(rest: fp.State, start: fp.State, duration: float) -> fp.State:
    """States of the rig, one a tick, from `rest` to `start`."""
    spin = np.cross(start.y, start.y_dot)  # angular velocity of the rod, world frame
    back = -Rotation.from_matrix(rest.R.T @ start.R).as_rotvec()  # body frame of `start`: R = start.R exp(turn)
    axis = np.cross(start.y, rest.y)
    angle = np.arctan2(np.linalg.norm(axis), start.y @ rest.y)
    if np.linalg.norm(axis) < 1e-9:
        axis = geometry.unit(np.cross(start.y, (1.0, 0.3, 0.2)))
    swing = angle * geometry.unit(axis)
    t = np.linspace(0, duration, 1 + round(duration / TICK))
    at = [0.0, duration]
    place = CubicHermiteSpline(at, [rest.x, start.x], [np.zeros(3), start.x_dot])
    turn = CubicHermiteSpline(at, [back, np.zeros(3)], [np.zeros(3), start.omega])
    swung = CubicHermiteSpline(at, [swing, np.zeros(3)], [np.zeros(3), spin])

    def R(s):
        return start.R @ Rotation.from_rotvec(turn(s)).as_matrix()

    def y(s):
        return Rotation.from_rotvec(swung(s)).as_matrix() @ start.y

    h = 1e-6
    y_dot = geometry.tangent_part(y(t), (y(t + h) - y(t - h)) / (2 * h))
    omega = Rotation.from_matrix(np.swapaxes(R(t - h), -1, -2) @ R(t + h)).as_rotvec() / (2 * h)
    return fp.State(x=place(t), x_dot=place(t, 1), R=R(t), omega=omega, y=y(t), y_dot=y_dot)


def states(batch: fp.State) -> list[fp.State]:
    """The states of a batch."""
    return [fp.State.trusted(packed) for packed in batch.packed()]
