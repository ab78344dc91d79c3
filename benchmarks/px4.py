"""Flights of the exported mode in PX4 itself, on this machine: a swing-up, and what may go wrong.

    python -m benchmarks.px4 ../PX4-Autopilot/build/px4_sitl_default

BUILD is a build of `px4_sitl` with the module of `flypend export-app px4 hehn2011` in it. PX4's commander, failsafes,
EKF2, controllers, allocation, land detector and output drivers are its own. It runs in lockstep with flypend's plant
over MAVLink's messages for simulators, 400 Hz, which needs pymavlink. Motion capture gives poses and the bob 100 times
a second; gyroscope and accelerometer are noisy. The vehicle stands on a floor through which its rod hangs.

A pilot in Position mode climbs to three metres and selects Pendulum with the rod hanging; after eight seconds the event
of the row happens.
"""

from __future__ import annotations

import argparse
import os
import socket
import subprocess
import tempfile
from pathlib import Path

import numpy as np

import flypend as fp
from benchmarks.ticking import Ticking
from flypend import geometry
from flypend.plants.actuation import make_engine
from flypend.plants.plant import as_sampled
from flypend.plants.sensing import mean_force

os.environ["MAVLINK20"] = "1"
TICK = 2.5e-3  # s, of the lockstep: PX4's default gyroscope rate
FRAMES, STICKS, BEATS = 4, 20, 400  # ticks between pictures, stick positions and heartbeats
NOISE = {"gyro": 3e-3, "acc": 0.03}  # rad/s, m/s²: about an ICM-20689 at this bandwidth
HEIGHT = 3.0  # m, of the hover from which the rod is swung up
FULL = 3.5  # N at full command: the module's FPD_FORCE
STILL = np.zeros(6)  # no wind
FLIP = np.array([1.0, -1.0, -1.0])  # north-west-up to north-east-down, front-left-up to front-right-down
SWING_UP = 8.0  # s
POSITION, LAND, PENDULUM = (3, 0), (4, 6), (4, 11)  # PX4's main mode and its part; the last is the first external mode
NAMES = {POSITION: "Position", LAND: "Land", PENDULUM: "Pendulum", (4, 3): "Hold", (4, 5): "Return", (2, 0): "Altitude"}
VEHICLE = fp.vehicle("hehn2011")


def parameters() -> dict[str, float]:
    """Parameters of the airframe: rotors, gains for its inertia, pose from motion capture only."""
    found: dict[str, float] = {
        "CA_AIRFRAME": 0, "CA_ROTOR_COUNT": 4, "FPD_FORCE": FULL, "THR_MDL_FAC": 0, "IMU_GYRO_RATEMAX": 400,
        "IMU_INTEG_RATE": 400,
        "MPC_THR_HOVER": VEHICLE.weight / 4 / FULL, "MPC_USE_HTE": 0,
        # The rate loop: a quarter of the rotors' bandwidth.
        "MC_ROLLRATE_P": 0.035, "MC_PITCHRATE_P": 0.035, "MC_YAWRATE_P": 0.1, "MC_ROLLRATE_D": 0, "MC_PITCHRATE_D": 0,
        "MC_ROLLRATE_I": 0.02, "MC_PITCHRATE_I": 0.02, "MC_ROLL_P": 4, "MC_PITCH_P": 4,
        "SYS_HAS_MAG": 0, "SYS_HAS_GPS": 0, "EKF2_GPS_CTRL": 0, "EKF2_BARO_CTRL": 0, "EKF2_MAG_TYPE": 5,
        "EKF2_HGT_REF": 3,
        "EKF2_EV_CTRL": 11, "EKF2_EV_DELAY": 0, "EKF2_EV_NOISE_MD": 1, "EKF2_EVP_NOISE": 0.01, "EKF2_EVA_NOISE": 0.01,
        "EKF2_MULTI_IMU": 0, "SENS_IMU_MODE": 1, "EKF2_REQ_GPS_H": 0,
        "COM_ARM_WO_GPS": 1, "COM_RC_IN_MODE": 1, "NAV_DLL_ACT": 0, "COM_DISARM_PRFLT": -1,
        "SDLOG_MODE": -1, "COM_LOW_BAT_ACT": 2, "COM_OBL_RC_ACT": 4,
    }  # fmt: skip
    for i, (place, spin) in enumerate(zip(VEHICLE.rotor_positions, VEHICLE.rotor_spins, strict=True)):
        numbers = {"PX": place[0], "PY": -place[1], "KM": -VEHICLE.drag_ratio * spin}
        found |= {f"CA_ROTOR{i}_{name}": value for name, value in numbers.items()} | {f"PWM_MAIN_FUNC{i + 1}": 101 + i}
    return found


class Flown(Ticking):
    """A vehicle under PX4, from power-up on the ground, and the pilot.

    Parameters
    ----------
    build : Path
        Of PX4.
    seed : int
        Of the noise.
    """

    period = TICK

    def __init__(self, build: Path, seed: int) -> None:
        from pymavlink import mavutil

        self._mavutil, self._place = mavutil, tempfile.TemporaryDirectory()
        given = {f"PX4_PARAM_{name}": f"{value:g}" for name, value in parameters().items()}
        environment = {**os.environ, **given, "PX4_SYS_AUTOSTART": "10016", "PX4_SIM_MODEL": "none_iris"}
        server = socket.create_server(("127.0.0.1", 4560))
        words = [build / "bin/px4", "-d", build / "etc", "-w", self._place.name, "-s", "etc/init.d-posix/rcS"]
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        self._px4 = subprocess.Popen(words, cwd=self._place.name, env=environment, **quiet)
        self._bin, self._environment = build / "bin", environment
        server.settimeout(60)
        self._link, _ = server.accept()
        self._link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._talk = mavutil.mavlink.MAVLink(None, srcSystem=1, srcComponent=51)
        self._hear = mavutil.mavlink.MAVLink(None)
        self._ground = mavutil.mavlink_connection("udpin:127.0.0.1:14540", source_system=255)
        self.engine = make_engine(VEHICLE, as_sampled("rotors"))
        self.rest = fp.State(y=(0.0, 0.0, -1.0))
        self.engine.reset(self.rest.packed(), np.zeros(4))
        self.state = self._before = self.rest
        self.ticks, self.stands, self.rng = 0, True, np.random.default_rng(seed)
        self.sees_bob = self.sees_pose = self.link = True
        self.climb, self.mode, self.armed, self.command = 0.0, (0, 0), False, np.zeros(4)
        self.told: list[str] = []
        self.log: list[tuple] = []  # state, forces and mode of each tick

    def __enter__(self) -> Flown:
        return self

    def __exit__(self, *_) -> None:
        """End PX4."""
        self._px4.kill()
        self._px4.wait()
        self._link.close()
        self._ground.close()
        self._place.cleanup()

    def shell(self, name: str, *words: str) -> str:
        """What a command of PX4's shell says; time goes on meanwhile, as some wait for it."""
        done = subprocess.Popen(
            [self._bin / f"px4-{name}", *words],
            env=self._environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        while done.poll() is None:
            self.tick()
        return done.communicate()[0]

    # What reaches PX4 -------------------------------------------------------------------------------------------------

    def _send(self, message) -> None:
        self._link.sendall(message.pack(self._talk))

    def _sense(self) -> None:
        state, before = self.state, self._before
        noise = self.rng.normal(size=7)
        gyro = FLIP * state.omega + NOISE["gyro"] * noise[:3]
        force = mean_force(before.x_dot, state.x_dot, before.R, state.R, VEHICLE.gravity, TICK)
        acc = FLIP * force + NOISE["acc"] * noise[3:6]
        height = state.x[2] + 488
        pressure = 1013.25 * (1 - 2.25577e-5 * height) ** 5.25588 + 0.01 * noise[6]
        now = round(1e6 * (1 + self.ticks * TICK))
        self._send(
            self._talk.hil_sensor_encode(
                now, *acc, *gyro, 0.21, 0.0, 0.42, pressure, 0.0, height, 25.0, 0x3F | 0x1C0 | 0x1A00
            )
        )

    def _capture(self) -> None:
        state, now = self.state, round(1e6 * (1 + self.ticks * TICK))
        if self.sees_pose:
            turned = np.diag(FLIP) @ state.R @ np.diag(FLIP)
            x, y, z, w = geometry.quat_xyzw_from_rotation(turned)
            unknown = [float("nan")] * 21
            self._send(
                self._talk.odometry_encode(
                    now, 1, 1, *(FLIP * state.x), (w, x, y, z), *[float("nan")] * 6, unknown, unknown, 0, 2, 100
                )
            )
        if self.sees_bob:
            bob = FLIP * VEHICLE.l * state.y
            self._ground.mav.debug_float_array_send(now, b"bob", 0, [*bob, *[0.0] * 55])

    def order(self, command: int, *values: float) -> None:
        """Send a command."""
        numbers = [*values, *[0.0] * (7 - len(values))]
        self._ground.mav.command_long_send(1, 1, command, 0, *numbers)

    def select(self, mode: tuple[int, int]) -> None:
        """Select a flight mode."""
        self.order(176, 1, *mode)

    def arm(self, armed: bool = True, force: float = 0) -> None:
        """Arm, disarm, or with 21196 disarm in the air."""
        self.order(400, float(armed), force)

    # Time -------------------------------------------------------------------------------------------------------------

    def tick(self) -> None:
        """One step of the lockstep."""
        if self.ticks % FRAMES == 0:
            self._capture()
        self._sense()
        if self.link and self.ticks % STICKS == 0:
            self._ground.mav.manual_control_send(1, 0, 0, round(500 + 500 * self.climb), 0, 0)
        if self.link and self.ticks % BEATS == 0:
            self._ground.mav.heartbeat_send(6, 8, 0, 0, 0)
        self._answer()
        self._listen()
        self._before = self.state
        forces = FULL * self.command
        self.engine.step(forces, TICK, STILL)
        self.state = fp.State.trusted(np.array(self.engine.packed).ravel())
        if self.stands:
            self.stands = self.engine.rotors.sum() < VEHICLE.weight
        elif self.state.x[2] <= 0:
            self.stands = True
        if self.stands:
            x = np.array([self.state.x[0], self.state.x[1], 0.0]) if self.log else self.rest.x
            self.state = fp.State(x=x, y=self.rest.y)
            self.engine.reset(self.state.packed(), self.engine.rotors)
        self.ticks += 1
        self.log.append((self.state, forces, self.mode, self.armed))

    def _answer(self) -> None:
        """Wait for the motors of this step; PX4 sends none before its output driver runs."""
        self._link.settimeout(0.03 if self.log and self.log[-1][-1] else 0.01)
        try:
            while True:
                for message in self._hear.parse_buffer(self._link.recv(4096)) or ():
                    if message.get_type() == "HIL_ACTUATOR_CONTROLS":
                        self.command = np.clip(np.nan_to_num(message.controls[:4]), 0, 1)
                        return
        except TimeoutError:
            return

    def _listen(self) -> None:
        while (message := self._ground.recv_msg()) is not None:
            kind = message.get_type()
            if kind == "HEARTBEAT" and message.get_srcComponent() == 1:
                self.mode = (message.custom_mode >> 16 & 0xFF, message.custom_mode >> 24)
                self.armed = bool(message.base_mode & 128)
            elif kind in ("STATUSTEXT", "COMMAND_ACK"):
                self.told.append(f"{self.ticks * TICK:.2f} {message}")


# Flights --------------------------------------------------------------------------------------------------------------


def hover(flown: Flown) -> None:
    """Power up, start the module, arm and climb in Position mode, and hover with the rod hanging."""
    flown.fly(5.0)
    flown.shell("flypend", "start")
    flown.shell("mavlink", "stream", "-r", "100", "-s", "HEARTBEAT", "-u", "14580")
    flown.fly(8.0)
    flown.select(POSITION)
    flown.fly(1.0)
    flown.arm()
    assert flown.fly(2.0, lambda: flown.armed), flown.told
    flown.climb = 1.0
    assert flown.fly(10.0, lambda: flown.state.x[2] > HEIGHT), flown.told
    flown.climb = 0.0
    flown.fly(8.0)


def swing_up(flown: Flown) -> tuple[bool, float, float, float]:
    """Select the mode: whether the rod is inverted and the vehicle home, seconds until then, excursion and drop, m."""
    begun, home = len(flown.log), flown.state.x
    flown.select(PENDULUM)
    flown.fly(SWING_UP)
    found = [state for state, *_ in flown.log[begun:]]
    up = np.array([np.linalg.norm(s.y - (0, 0, 1)) < 0.1 and np.linalg.norm(s.x - home) < 0.15 for s in found])
    away = np.array([s.x - home for s in found])
    last = np.flatnonzero(~up)[-1] + 1
    stands = bool(up[-round(1 / TICK) :].all())
    return stands, last * TICK, float(np.linalg.norm(away, axis=1).max()), float(-away[:, 2].min())


def _attribute(**values):
    def change(flown):
        for name, value in values.items():
            setattr(flown, name, value)

    return change


EVENTS = {
    "Position selected": lambda flown: flown.select(POSITION),
    "Land selected": lambda flown: flown.select(LAND),
    "kill switch": lambda flown: flown.arm(False, 21196),
    "bob lost": _attribute(sees_bob=False),
    "pose lost": _attribute(sees_pose=False),
    "sticks and ground station lost": _attribute(link=False),
    "battery empty": lambda flown: flown.order(420, 100, 1),  # injects the failure
}


def happen(name: str, flown: Flown) -> str:
    """A line about an event while the rod is up."""
    event, home = len(flown.log), flown.state.x
    EVENTS[name](flown)
    flown.fly(25.0, lambda: not flown.armed and flown.stands)
    log = flown.log[event:]
    left = next((i for i, (_, _, mode, armed) in enumerate(log) if mode != PENDULUM or not armed), None)
    modes = [NAMES.get(mode, str(mode)) if armed else "stopped" for _, _, mode, armed in log]
    then = ", ".join(now for before, now in zip([NAMES[PENDULUM], *modes], modes, strict=False) if now != before)
    spinning = [i for i, (_, forces, *_) in enumerate(log) if forces.any()]
    stops = "—" if log[-1][-1] else f"{(spinning[-1] + 1 if spinning else 0) * TICK:.2f}"  # it is still armed
    x = np.array([state.x for state, forces, *_ in log if forces.any()] or [home])
    aside, lowest = np.hypot(*(x - home)[:, :2].T).max(), x[:, 2].min()
    flies = "—" if left is None else f"{left * TICK:.2f}"
    return f"| {name} | {flies} | {then} | {stops} | {aside:.2f} | {lowest:.2f} |"


def main() -> None:
    """Print a table of swing-ups and one of events."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--event", choices=EVENTS, action="append")
    given = parser.parse_args()
    rows = []
    for seed in range(given.runs):
        with Flown(given.build.resolve(), seed) as flown:
            hover(flown)
            rows.append(swing_up(flown))
    if rows:
        print("| swing-ups | rod up | until then, s, p50 / largest | excursion, m | drop, m |\n|---|---|---|---|---|")
        stood, *numbers = np.array(rows).T
        cells = " | ".join(f"{np.median(row):.2f} / {row.max():.2f}" for row in numbers)
        print(f"| from hanging | {stood.sum():.0f} of {len(stood)} | {cells} |\n", flush=True)
    print("| what happens | law flies on, s | then | motors stop after, s | aside, m | lowest, m |")
    print("|---|---|---|---|---|---|")
    for name in given.event or EVENTS:
        with Flown(given.build.resolve(), 100) as flown:
            hover(flown)
            assert swing_up(flown)[0]
            print(happen(name, flown), flush=True)


if __name__ == "__main__":
    main()
