"""Apps for the firmware of a vehicle: everything that its build takes, with the safety rules of that firmware."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from flypend import errors, signals
from flypend.board.history import REACH, History
from flypend.board.tracking import POSE, ROD, track_pose, track_rod
from flypend.compile.c99 import call, function, literal
from flypend.compile.program import lower
from flypend.compile.scratch import scratch
from flypend.errors import InputError
from flypend.export import records
from flypend.export.fits import BUDGETS, PX4_STACK, check_fits
from flypend.export.interface import Interface, interface
from flypend.export.plan import files as plan_files
from flypend.export.rehearsal import Room, measure_room
from flypend.export.source import describe, initializer, literals
from flypend.export.write import check_folder, core, fill, values_of
from flypend.files.staging import write_texts
from flypend.laws import BoundLaw, Law
from flypend.model import State, Vehicle
from flypend.planning.planner import plan
from flypend.plants.sensors import Sensors, sensors_called

FILES: Mapping[str, tuple[str, ...]] = {
    "crazyflie": ("Makefile", "Kbuild", "app-config", "flypend_app.c", "README.md", "flypend_host.py"),
    "px4": ("CMakeLists.txt", "Kconfig", "module.yaml", "flypend.hpp", "flypend.cpp", "README.md"),
}
RATES: Mapping[str, float] = {"crazyflie": 500.0, "px4": 400.0}  # Hz; PX4's is IMU_GYRO_RATEMAX as it comes
PERIOD = 1e-3  # s, of the firmware's stabilizer
STREAMS = ("position", "attitude", "rod", "gyro", "accelerometer")  # what a Crazyflie's app can tell an estimator
# Parameters of the firmware, as the law's record has them: of a rod that is not light, the pendulum that swings alike.
PENDULUM = {"mass": "M", "bob_mass": "m", "rod_length": "l"}
LATEST = 0.1  # s, age up to which track_pose and track_rod take a pose


@dataclass(frozen=True)
class Airframe:
    """What the Crazyflie firmware says of an airframe in `platform_defaults_*.h`, release 2026.08.

    Parameters
    ----------
    arm : float
        Distance of a rotor from the roll and the pitch axis, m: ARM_LENGTH/√2.
    least, largest : float
        Forces of one rotor, N: THRUST_MIN, rounded up, since the firmware turns less into nothing; THRUST_MAX.
    idle : int, optional
        Idle thrust of armed motors, of 65,535; None for the firmware's own.
    """

    arm: float
    least: float
    largest: float
    idle: int | None = None


# The build refuses numbers that are not those of the firmware at hand. Brushed motors stop and start again at once; the
# brushless ones need their idle thrust, which is THRUST_MIN.
AIRFRAMES: Mapping[str, Airframe] = {
    "cf2": Airframe(arm=0.0325, least=0.0129, largest=0.12, idle=0),
    "cf21bl": Airframe(arm=0.0354, least=0.0214, largest=0.2),
}
# Motors M1 to M4 of the firmware: signs of x and y (front-left-up), and of the reaction torque about z.
MOTORS = ((1, -1, -1), (-1, -1, 1), (-1, 1, -1), (1, 1, 1))


@errors.named_arguments
@signals.defer()
def export_app(
    target: str,
    law: Law | BoundLaw,
    vehicle: Vehicle,
    out: str | Path,
    *,
    airframe: str | None = None,
    rate: float | None = None,
    height: float | None = None,
    sensors: Sensors | str | None = None,
    planned: bool = False,
) -> Vehicle:
    """Write an app for the firmware of `target` that flies `law` on `vehicle`.

    The folder `out` holds sources, build files and a README with the way from unpacking to the first swing-up.

    Parameters
    ----------
    target : "crazyflie" or "px4"
        The firmware. For a Crazyflie, an app is written; for PX4, a module with a flight mode.
    law : Law
        As in `export_c`.
    vehicle : Vehicle
        The vehicle. For a Crazyflie, it must have four rotors in the order of the firmware's motors, no more than 5 %
        of an arm from the firmware's positions. With PX4 rotors may come in any order: the module matches them with the
        parameters of the airframe.
    out : str or Path
        As in `export_c`.
    airframe : "cf2" or "cf21bl", optional
        Airframe that a Crazyflie's firmware is built for; default the one with the nearest arm length.
    rate : float, optional
        Control rate, Hz. For a Crazyflie a divisor of 1,000, default 500; for PX4 up to IMU_GYRO_RATEMAX, default 400.
    height : float, optional
        Height above the ground, m, below which the law does not begin. Default: what a swing-up needs in the model,
        with a margin.
    sensors : Sensors or str, optional
        For a Crazyflie: the sensors (poses, gyroscope and accelerometer), or the name of a suite. The law then flies on
        the estimator of `export_c` for these sensors. Default "perfect": the law flies on one observer of the pose and
        one of the rod.
    planned : bool
        For a Crazyflie: plan a swing-up of smallest excursion from rest with the rod hanging, heading along x. The law
        takes over where the plan ends, or once rod or pivot are too far from it, and flies from other headings.

    Returns
    -------
    Vehicle
        `vehicle.commanded()` as the app flies it: within the rotor limits of a Crazyflie's airframe.

    Raises
    ------
    InputError
        As `export_c`. Also if the target is unknown; if the vehicle does not fit the airframe; if an airframe, sensors
        or a plan are given for PX4; if sensors are not those of a Crazyflie, or come with a plan; if the plan fails; if
        the law does not swing the rod up and no height is given; or if it takes too many cycles or too much memory
        (`fits`).
    """
    errors.one_of("target", target, tuple(FILES))
    if not isinstance(vehicle, Vehicle):
        raise InputError("vehicle", "a Vehicle", repr(vehicle))
    check_folder(out, FILES[target])
    rate = errors.number("rate", RATES[target] if rate is None else rate, above=0, at_most=1000, unit="Hz")
    if height is not None:
        height = errors.number("height", height, at_least=0.5, at_most=100, unit="m")
    read = sensors_called(sensors, "sensors")
    if target == "px4":
        _check_px4(airframe, sensors if read else None, planned)
        flown = vehicle.commanded()
        own = _px4(flown, rate)
    else:
        _check_sensors(read, planned)
        flown, own = _crazyflie(vehicle.commanded(), rate, airframe)
    made = interface(law, flown, rate, read)
    texts = core(made, "float")
    if planned:
        texts |= plan_files(plan(flown, State(y=(0, 0, -1))), "float")
    if target == "crazyflie":
        own |= _computer(made, rate, planned)
    taken = check_fits(made, texts, BUDGETS[target])
    room = measure_room(law, flown, rate) if height is None else Room(height, height)
    values = values_of(made, "float") | {
        **{name: literal(getattr(flown, own), "float") for name, own in PENDULUM.items()},
        "limits": f"{flown.rotor_limits[0]:.3g} to {flown.rotor_limits[1]:.3g} N",
        "weight": f"{1e3 * (vehicle.mass + vehicle.bob_mass):.3g}",
        "rod": f"{flown.l:.3g}",
        "pendulum": f"{flown.M:.4g} kg, {flown.m:.4g} kg and {flown.l:.4g} m",
        "height": literal(room.height, "float"),
        "height_number": repr(room.height),
        "metres": f"{room.height:g}",
        "room": f"{room.aside:g}",
        "taken": "\n".join(f"| {what} | {number:,} |" for what, number in taken.items()),
    }
    values |= own
    texts |= {f"flypend_frames.{end}": fill(f"adapters/flypend_frames.{end}", values) for end in "hc"}
    texts |= {file: fill(f"{target}/{file}", values) for file in FILES[target]}
    write_texts(out, texts)
    return flown


def _crazyflie(vehicle: Vehicle, rate: float, airframe: str | None) -> tuple[Vehicle, dict[str, str]]:
    """The vehicle within its rotor limits, and what only the Crazyflie's templates take."""
    if 1000 % rate:
        raise InputError("rate", "a divisor of 1,000 Hz, the rate of the firmware's loop", f"{rate:g} Hz")
    arm = float(np.abs(np.array(vehicle.rotor_positions)[:, :2]).mean())
    name = airframe or min(AIRFRAMES, key=lambda known: abs(AIRFRAMES[known].arm - arm))
    frame = AIRFRAMES[errors.one_of("airframe", name, tuple(AIRFRAMES))]
    _check_motors(vehicle, name, frame)
    flown = limit_rotors(vehicle, frame)
    follow = lower(track_pose(PERIOD, flown.gravity))
    return flown, _rod_values(PERIOD, "end->from_pivot", "params.rod_length", "rod") | {
        "airframe": name,
        "arm": literal(arm, "float"),
        "least_force": literal(flown.rotor_limits[0], "float"),
        "largest_force": literal(flown.rotor_limits[1], "float"),
        "caught_up": literal(1 - math.exp(-PERIOD / flown.rotor_lag) if flown.rotor_lag else 1.0, "float"),
        "idle": "" if frame.idle is None else f"CONFIG_MOTORS_DEFAULT_IDLE_THRUST={frame.idle}\n",
        "track_pose": function(follow, "float"),
        "pose_scratch": str(scratch(follow).size),
        "pose_numbers": str(POSE.length),
        "pose_attitude": str(POSE.place("R").start),
        "call_track_pose": call(follow, ("pose", "position", "turned", "&age", "gyro", "felt"), ["pose"], "scratch"),
    }


def _computer(made: Interface, rate: float, planned: bool) -> dict[str, str]:
    """What the Crazyflie's templates take of the flight computer, with an estimator or without, or behind a plan."""
    units, record, latest = ["flypend_app", "flypend_law", "flypend_frames"], records.MEASUREMENT, LATEST
    beside, calls = "", dict.fromkeys(("tell_imu", "tell_pose", "tell_rod"), "")
    if made.sensing is not None:
        sensors = made.sensing.sensors
        history = History.of(sensors, 1 / rate)
        # Arrived, a pose waits for the law's next step.
        latest = min(history.oldest(name) for name in STREAMS[:3]) - REACH - 1 / rate
        units, record = [*units, "flypend_sensors"], records.STATE
        beside = (
            f"- **How good they are**: the law's estimator reckons with {'; '.join(describe(sensors))} (SI units).\n"
        )
        calls = {
            "tell_imu": "    tell_imu(sensors);\n",
            "tell_pose": "    tell_pose(position, turned, age);\n",
            "tell_rod": "    tell_rod(end->from_pivot, age);\n",
        }
    if planned:
        units = [*units, "flypend_plan"]
        beside = (
            "- **That the rod hangs at rest**, and the vehicle is level and heads along x, to 10°: then a swing-up\n"
            "  follows a plan; else, or thrown off it, the law flies.\n"
        )
    parts = ["measured" if made.sensing is None else "sensed", *["planned"] * planned]
    return calls | {
        "computer": "".join(fill(f"crazyflie/{part}.c", {"period": literal(1 / rate, "float")}) for part in parts),
        "beside": beside,
        "flown": "planned" if planned else "computer",
        "plan_header": '#include "flypend_plan.h"\n' * planned,
        "computer_header": "flypend_law.h" if made.sensing is None else "flypend_sensors.h",
        "state_read": record.name,
        "zero_state": initializer(record, np.zeros(record.length), "float"),
        "latest": str(math.floor(1e3 * latest + 1e-6)),  # whole milliseconds, but for rounding
        "objects": "".join(f"obj-y += {unit}.o\n" for unit in units),
    }


def _check_sensors(sensors: Sensors | None, planned: bool) -> None:
    if sensors is None:
        return
    if set(sensors.streams) != set(STREAMS):
        raise InputError("sensors", f"{', '.join(STREAMS)}, and nothing else", ", ".join(sensors.streams))
    if planned:  # the period in which one begins after the other would take too many cycles
        raise InputError("planned", "False with an estimator", "True")


def _check_px4(airframe: str | None, sensors: Sensors | str | None, planned: bool) -> None:
    if airframe is not None:
        raise InputError("airframe", "none for px4, whose parameters CA_ROTOR hold it", repr(airframe))
    if sensors is not None:
        raise InputError("sensors", "none for px4, which has an estimator of its own", repr(sensors))
    if planned:
        raise InputError("planned", "False for px4, whose module flies a law alone", "True")


def _px4(vehicle: Vehicle, rate: float) -> dict[str, str]:
    """What only the templates of PX4's module take."""
    places, spins = np.array(vehicle.rotor_positions)[:, :2], np.array(vehicle.rotor_spins)
    rows = np.column_stack([places / np.linalg.norm(places, axis=1).mean(), np.sign(spins)])
    return _rod_values(1 / rate, "_bob", "_params.rod_length", "_rod") | {
        **{f"{name}_number": repr(float(getattr(vehicle, own))) for name, own in PENDULUM.items()},
        "force_number": repr(float(vehicle.rotor_limits[1])),
        "places": ", ".join(f"{{{literals(row, 'float')}}}" for row in rows),
        "stack": str(PX4_STACK),
        "loop_rate": str(math.ceil(rate)),
    }


def _rod_values(period: float, bob: str, length: str, memory: str) -> dict[str, str]:
    """The function that follows the rod, every `period` seconds, and its call with these names."""
    track = lower(track_rod(period))
    return {
        "track_rod": function(track, "float"),
        "track_scratch": str(scratch(track).size),
        "rod_numbers": str(ROD.length),
        "call_track_rod": call(track, (memory, bob, "&age", "force", f"&{length}"), [memory], "scratch"),
    }


def limit_rotors(vehicle: Vehicle, frame: Airframe) -> Vehicle:
    """Return `vehicle` with rotor limits that the firmware of `frame` can give. Raises InputError if none are left."""
    least, largest = vehicle.rotor_limits
    least, largest = max(least, frame.least), min(largest, frame.largest)
    if 4 * largest <= vehicle.weight:
        what = f"a vehicle lighter than 4 × {largest:g} N, which the firmware gives"
        raise InputError("vehicle", what, f"{vehicle.weight:.3g} N")
    return vehicle.replace(rotor_limits=(least, largest))


def _check_motors(vehicle: Vehicle, name: str, frame: Airframe) -> None:
    places, spins = np.array(vehicle.rotor_positions), np.array(vehicle.rotor_spins)
    wanted = np.array(MOTORS, dtype=float)
    if len(places) != 4 or np.any(np.sign(places[:, :2]) != wanted[:, :2]) or np.any(np.sign(spins) != wanted[:, 2]):
        what = "rotors in the order of M1 to M4: front right, back right, back left, front left; spins −1, 1, −1, 1"
        raise InputError("rotor_positions", what, f"{places[:, :2].tolist()}, spins {spins.tolist()}")
    off = np.abs(np.abs(places[:, :2]) - frame.arm).max() / frame.arm
    if off > 0.05:  # the two airframes differ by 8 %
        what = f"rotors {frame.arm:g} m from the axes, as on the {name}"
        raise InputError("rotor_positions", what, f"{100 * off:.0f} % off")
