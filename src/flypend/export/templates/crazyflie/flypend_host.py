#!/usr/bin/env python3
"""Poses, setpoints and the switch of the law for a Crazyflie with flypend's app.

Needs cflib. Keys: l the law, p PID, d land and end, space stops the motors. Replace `Bodies` by your motion capture.
"""

import argparse
import contextlib
import os
import queue
import select
import struct
import sys
import termios
import time
import tty
from collections import namedtuple

LATE = 10.0  # ms from the picture to the packet: measure yours
SETTLE = 2.0  # s of poses before it arms: the estimator needs them
CLIMB = 0.5  # m/s
LANDING = 4.0  # s
GAP = 0.1  # s without frame or bob, after which it says so
SETPOINT = 0.02  # s between setpoints
TURN = 0.001  # s between looks at motion capture and keys

# For the firmware's Kalman filter, which in flight takes all lateral force for noise and does not know the rod's: so
# much noise (m/s²) that velocities follow the poses, which are this good (m).
FILTER = {"kalman.pNAcc_xy": 20.0, "kalman.pNAcc_z": 20.0, "locSrv.extPosStdDev": 0.001}

# What motion capture saw: its own time (s), the vehicle's position (m) and quaternion (x, y, z, w), and the bob's
# position (m), in a frame with z up; None for a bob that it did not see.
Frame = namedtuple("Frame", "time position quaternion bob")


class Bodies:
    """Your motion capture: replace `read`."""

    def read(self):
        """The newest Frame, without waiting; the same again, or None, while there is no newer one."""
        raise NotImplementedError("read your motion capture here")


class RefusedError(Exception):
    """The firmware keeps another value of a parameter."""


def rod_packet(frame):
    """The message of the app channel: the bob's position from the vehicle, m."""
    return struct.pack("<c3f", b"b", *(end - here for end, here in zip(frame.bob, frame.position, strict=True)))


class Keys:
    """The keys of a terminal, which must not gather lines."""

    def __init__(self, descriptor):
        self.descriptor = descriptor

    def __call__(self):
        """All keys since the last call, in their order; "d" when the terminal is gone."""
        if self.descriptor is None or not select.select([self.descriptor], [], [], 0)[0]:
            return ""
        pressed = os.read(self.descriptor, 1024).decode(errors="ignore")
        if not pressed:
            self.descriptor = None
            return "d"
        return pressed


def tell(cf, name, value, patience=2.0):
    """Set a parameter and read it back. Raises RefusedError where the firmware keeps another value."""
    heard = queue.Queue()
    group, _, own = name.partition(".")

    def hear(_, text):
        heard.put(float(text))

    cf.param.add_update_callback(group=group, name=own, cb=hear)
    try:
        cf.param.set_value(name, value)
        heard.get(timeout=patience)  # the answer to a write repeats what was written
        cf.param.request_param_update(name)
        kept = heard.get(timeout=patience)
    except queue.Empty:
        raise RefusedError(f"{name}: no answer from the vehicle") from None
    finally:
        cf.param.remove_update_callback(group, own, hear)
    if not abs(kept - value) <= 1e-6 * abs(value):  # single precision; not a number is another value, too
        raise RefusedError(f"{name}: {value:g} was refused, it stays {kept:g}")


def stop(cf, pause=time.sleep):
    """Stop the motors and lock the vehicle; it must be started anew. More than once: packets wait in a queue."""
    for _ in range(3):
        with contextlib.suppress(KeyboardInterrupt):
            cf.supervisor.send_emergency_stop()
            pause(0.05)


class Session:
    """Sends what the vehicle needs, from the first pose to the last."""

    def __init__(self, cf, bodies, keys, now=time.monotonic, pause=time.sleep, say=print):
        self.cf, self.bodies, self.keys, self.now, self.pause, self.say = cf, bodies, keys, now, pause, say
        self.armed = False
        self.frame, self.said, self.seen = None, {}, {}
        self.frame_at = self.bob_at = self.now()
        self.shown_at = self.asked_at = -1e9

    def fly(self, height=None, parameters=()):
        """Send poses until space or Ctrl-C; with a `height`, m, arm, climb to it, obey the keys and end by landing."""
        try:
            # Changing the controller begins the app anew, so it comes first.
            first = {"stabilizer.controller": 6, "stabilizer.estimator": 2, "flypend.on": 0, "flypend.late": LATE}
            for name, value in {**first, **FILTER, **dict(parameters)}.items():
                tell(self.cf, name, value)
            if height is not None:
                self.climb_and_obey(height)
            else:
                while " " not in self.turn():
                    pass
        finally:
            if self.armed:
                stop(self.cf, self.pause)

    def climb_and_obey(self, height):
        """From the ground to the ground; armed at the end if the motors are to be stopped."""
        begun, pressed = self.now(), ""
        while self.frame is None or self.now() - begun < SETTLE:
            pressed += self.turn()
            if " " in pressed or "d" in pressed:
                return
        home, begun = self.frame.position, self.now()
        self.armed = True  # from now on whatever happens stops the motors
        self.cf.supervisor.send_arming_request(True)
        while True:
            climbed = min(height, CLIMB * (self.now() - begun))
            for key in self.turn((home[0], home[1], home[2] + climbed)):
                if key == " ":
                    return
                if key == "d":
                    self.land(home[2])
                    return
                if key in "lp":
                    self.cf.param.set_value("flypend.on", int(key == "l"))

    def land(self, ground):
        """Land with the firmware's own commander, and disarm."""
        self.cf.param.set_value("flypend.on", 0)
        self.cf.commander.send_notify_setpoint_stop()
        self.cf.high_level_commander.land(ground, LANDING - 1)
        begun = self.now()
        while self.now() - begun < LANDING:
            if " " in self.turn():
                return
        self.cf.supervisor.send_arming_request(False)
        self.armed = False

    def turn(self, setpoint=None):
        """Send what is new of motion capture, and `setpoint` when it is due; return the keys."""
        at, frame = self.now(), self.bodies.read()
        if frame is not None and (self.frame is None or frame.time > self.frame.time):
            self.frame = frame
            if self.is_new("vehicle", (*frame.position, *frame.quaternion)):
                self.frame_at = at
                self.cf.extpos.send_extpose(*frame.position, *frame.quaternion)
            if frame.bob is not None and self.is_new("bob", tuple(frame.bob)):
                self.bob_at = at
                self.cf.appchannel.send_packet(rod_packet(frame))
        self.tell_changes("motion capture", at - self.frame_at > GAP)
        self.tell_changes("the bob", at - self.bob_at > GAP)
        if setpoint is not None and at - self.asked_at >= SETPOINT:
            self.asked_at = at
            self.cf.commander.send_position_setpoint(*setpoint, 0.0)
        self.show(at)
        self.pause(TURN)
        return self.keys()

    def is_new(self, what, numbers):
        """Whether a body was seen: some systems repeat what they lost, to the last digit, and noise never does."""
        repeated, self.seen[what] = numbers == self.seen.get(what), numbers
        return not repeated

    def tell_changes(self, what, lost):
        """Say when something is lost or seen again."""
        if lost != self.said.get(what, False):
            self.said[what] = lost
            self.say(f"{what} is {'NOT SEEN' if lost else 'seen again'}")

    def show(self, at):
        """Print the rod, from vehicle to bob, twice a second."""
        if at - self.shown_at >= 0.5 and self.frame is not None and self.frame.bob is not None:
            self.shown_at = at
            rod = (b - a for a, b in zip(self.frame.position, self.frame.bob, strict=True))
            self.say("rod, m: " + " ".join(f"{part:+.2f}" for part in rod))


def main():
    """Connect, log what the app says, and fly."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("uri", help="such as radio://0/80/2M/E7E7E7E7E7")
    for name, unit in (("mass", "M, kg"), ("bobMass", "m, kg"), ("rodLength", "l, m")):
        parser.add_argument(f"--{name}", type=float, help=f"{unit}; default: as exported")
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--watch", action="store_true", help="send poses and print; never arm")
    what = "arm, take off and hover at this height, m; the law begins no lower than flypend.height"
    kind.add_argument("--hover", type=float, metavar="HEIGHT", help=what)
    given = parser.parse_args()

    import cflib.crtp
    from cflib.crazyflie import Crazyflie
    from cflib.crazyflie.log import LogConfig
    from cflib.crazyflie.syncCrazyflie import SyncCrazyflie

    cflib.crtp.init_drivers()
    own = {f"flypend.{name}": getattr(given, name) for name in ("mass", "bobMass", "rodLength")}
    settings = {name: value for name, value in own.items() if value is not None}
    shown = termios.tcgetattr(sys.stdin)
    tty.setcbreak(sys.stdin)
    try:
        with SyncCrazyflie(given.uri, cf=Crazyflie(rw_cache="./cache")) as link:
            log = LogConfig(name="flypend", period_in_ms=200)
            for name in ("flies", "why", "status", "bobAge"):
                log.add_variable(f"flypend.{name}")
            log.data_received_cb.add_callback(lambda _, values, __: print(values))
            link.cf.log.add_config(log)
            log.start()
            Session(link.cf, Bodies(), Keys(sys.stdin.fileno())).fly(given.hover, settings)
    except RefusedError as error:
        sys.exit(str(error))
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, shown)


if __name__ == "__main__":
    main()
