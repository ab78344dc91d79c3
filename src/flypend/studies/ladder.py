"""The ladder: the same starts and laws on plants, each of which departs from the ideal in one way or in several."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from flypend import errors, plants, signals
from flypend.errors import InputError
from flypend.flight.tasks import LEAST_RATE
from flypend.laws import Controller, Law
from flypend.model import State, Vehicle
from flypend.plants import MOTION_CAPTURE, PRESETS, ROTORS, AnyPlant, Sampled
from flypend.plants.defects import NEEDS
from flypend.plants.sensors import sensors_called
from flypend.studies.compare import Comparison, differing_fields, flights_of, fly_each

if TYPE_CHECKING:
    import xarray

# The ideal wrench, then limits alone, then lag on top of limits. Every other rung adds one departure to the plant
# "rotors" (limits, the vehicle's lag, 500 Hz), so that the rung that breaks a law names the reason.
RUNGS: Mapping[str, AnyPlant] = {
    "ideal wrench": PRESETS["ideal"],
    "limits": Sampled(lag=0.0),
    **{f"lag {ms} ms": ROTORS.replace(lag=ms / 1000) for ms in (10, 20, 30, 40, 50)},
    "spin-up x1.5": ROTORS.replace(spin_up=1.5),
    "battery sag 10 %": ROTORS.replace(sag=0.1),
    "thrust -20 %": ROTORS.replace(strength=0.8),
    **{f"{rate} Hz": ROTORS.replace(rate=float(rate)) for rate in (200, 100, 50)},
    **{f"delay {ms} ms": ROTORS.replace(delay=ms / 1000) for ms in (5, 15, 30)},
    "noise": ROTORS.replace(noise=MOTION_CAPTURE),
    "mass +10 %": ROTORS.replace(mismatch={"mass": 1.1, "bob_mass": 1.1}),
    "mass -10 %": ROTORS.replace(mismatch={"mass": 0.9, "bob_mass": 0.9}),
    "rod +10 %": ROTORS.replace(mismatch={"rod_length": 1.1}),
    "rod -10 %": ROTORS.replace(mismatch={"rod_length": 0.9}),
    "inertia +10 %": ROTORS.replace(mismatch={"inertia": 1.1}),
    "inertia -10 %": ROTORS.replace(mismatch={"inertia": 0.9}),
    "pivot offset 5 cm": ROTORS.replace(pivot_offset=(0.05, 0.0, 0.0)),
    "centre of mass off 3 mm": ROTORS.replace(centre_of_mass=(0.003, 0.0, 0.0)),
    "MuJoCo": PRESETS["mujoco"],
}

# What may be wrong with sensors, one at a time. An angle is that of a marker body put on by eye.
DEFECTS: Mapping[str, Mapping[str, Any]] = {
    "gyro bias 0.01 rad/s": {"gyro_bias": 0.01},
    "gyro bias walks 0.002 rad/s/sqrt(s)": {"gyro_bias_walk": 0.002},
    "gyro scale 2 %": {"gyro_scale": 0.02},
    "gyro vibrates 0.3 rad/s": {"gyro_vibration": 0.3},
    "accelerometer bias 0.3 m/s^2": {"accelerometer_bias": 0.3},
    "accelerometer bias walks 0.03 m/s^2/sqrt(s)": {"accelerometer_bias_walk": 0.03},
    "accelerometer vibrates 5 m/s^2": {"vibration": 5.0},
    "IMU turned 1 deg": {"imu_turned": float(np.radians(1.0))},
    "markers off 5 mm": {"markers_off": 0.005},
    "markers turned 1 deg": {"markers_turned": float(np.radians(1.0))},
    "rod markers off 1 deg": {"rod_markers_off": float(np.radians(1.0))},
    "joints off 1 deg": {"joints_off": float(np.radians(1.0))},
    "frame turned 1 deg": {"frame_turned": float(np.radians(1.0))},
    "frame scale 1 %": {"frame_scale": 0.01},
    "1 pose in 200 wrong": {"outliers": 0.005},
    "bursts of 0.1 s, 1 in 2 s": {"bursts": 0.5},
    "poses 8 ms older than told": {"untold_latency": 0.008},
    "poses 20 ms older than told": {"untold_latency": 0.02},
    "poses jitter by 10 ms": {"latency_jitter": 0.01},
}

# Friction of the joint: viscous, with which the hanging rod swings at this damping ratio; dry, as a share of m g l, of
# which a good joint has a thousandth. And the spin of a rod in its bearing, rad/s.
SWING_DAMPING, DRY_SHARE, ROD_SPIN = 0.02, 0.002, 20 * np.pi

# What comes together on a machine: a slow one, one that is not quite the one written down, one with tired motors.
TOGETHER: tuple[tuple[str, ...], ...] = (
    ("lag 40 ms", "delay 15 ms", "100 Hz"),
    ("lag 50 ms", "delay 30 ms", "100 Hz"),
    ("noise", "mass +10 %", "rod +10 %"),
    ("spin-up x1.5", "battery sag 10 %", "delay 15 ms"),
    ("viscous friction", "dry friction", "rod +10 %", "delay 15 ms"),
    ("viscous friction", "dry friction", "rod spin 10 turns/s", "rod +10 %"),
)


def rungs_for(vehicle: Vehicle) -> dict[str, AnyPlant]:
    """Return `RUNGS`, then those that take numbers of `vehicle` as far as it has them, then those of `TOGETHER`."""
    found = dict(RUNGS)
    weak = (1.0,) * (len(vehicle.rotor_spins) - 1) + (0.8,)
    found["one rotor -20 %"] = ROTORS.replace(strength=weak)
    known = () if vehicle.air is None else vehicle.air.active()
    found |= {name.replace("_", " "): ROTORS.replace(air=(name,)) for name in known}
    if vehicle.body is not None:
        found["ground one radius below"] = ROTORS.replace(ground=-vehicle.body.disc_radius)
    if known:
        found["air"] = ROTORS.replace(air="all")
    vehicle = vehicle.commanded()
    swing = 2 * SWING_DAMPING * vehicle.m * vehicle.l * np.sqrt(vehicle.g * vehicle.l)
    found["viscous friction"] = ROTORS.replace(pivot_damping=float(swing))
    found["dry friction"] = ROTORS.replace(pivot_friction=float(DRY_SHARE * vehicle.m * vehicle.g * vehicle.l))
    if vehicle.rod_spin_inertia > 0:
        found["rod spin 10 turns/s"] = ROTORS.replace(rod_spin=float(ROD_SPIN))
    return found | {", ".join(names): together(names, found) for names in TOGETHER if set(names) <= found.keys()}


def sensor_rungs(sensors: Any, name: str = "sensors") -> dict[str, AnyPlant]:
    """Return the rungs of `sensors`, a suite or a table: as they are, with each of `DEFECTS` they can have, and all.

    The first is called like the suite; for a table, `name`. The last is the plant "laboratory", whatever the sensors.
    Raises InputError for an unknown suite, an invalid table and perfect sensors.
    """
    base = sensors_called(sensors, "--sensors")
    if base is None:
        raise InputError("--sensors", "sensors that can be wrong", repr(sensors))
    found: dict[str, AnyPlant] = {sensors if isinstance(sensors, str) else name: ROTORS.replace(sensors=base)}
    for defects, changes in DEFECTS.items():
        if all(defect not in NEEDS or NEEDS[defect] in base.streams for defect in changes):
            found[defects] = ROTORS.replace(sensors=base.replace(**changes))
    return found | {"laboratory": PRESETS["laboratory"]}


def together(names: Sequence[str], rungs: Mapping[str, AnyPlant]) -> Sampled:
    """Return the plant with the departures of several of `rungs` at once.

    Raises InputError for an unknown name, for the ideal wrench, and for two rungs that set the same number.
    """
    changes: dict[str, Any] = {}
    for name in names:
        plant = rungs[errors.one_of("--rung", name, rungs)]
        if not isinstance(plant, Sampled):
            raise InputError("--rung", "rungs with numbers", repr(name))
        for field, value in differing_fields(plant, ROTORS).items():
            before = changes.get(field, {})
            if field in changes and (field != "mismatch" or before.keys() & value.keys()):
                raise InputError("--rung", "rungs that change different numbers", f"{field} twice in {names}")
            changes[field] = before | value if field == "mismatch" else value
    return ROTORS.replace(**changes)


def rung_named(text: str, rungs: Mapping[str, AnyPlant]) -> AnyPlant:
    """Return the rung `text`, or several at once by names with commas in between. Raises InputError like `together`."""
    if text in rungs or "," not in text:
        return rungs[errors.one_of("--rung", text, rungs)]
    return together([name.strip() for name in text.split(",")], rungs)


@dataclass(frozen=True)
class Ladder:
    """Laws compared from the same starts, on one plant per rung.

    Parameters
    ----------
    rungs : dict of Comparison
        By name of the rung.
    """

    rungs: dict[str, Comparison]

    def broken(self, law: str, below: float = LEAST_RATE) -> list[str]:
        """Return the rungs on which the success rate of `law` is less than `below`."""
        return [rung for rung, comparison in self.rungs.items() if comparison.ensembles[law].rate < below]

    def to_xarray(self) -> xarray.Dataset:
        """Return the metrics as an `xarray.Dataset` over `rung`, `law` and `run`."""
        errors.require("xarray", extra="studies", for_="to_xarray")
        import xarray

        found = [comparison.to_xarray() for comparison in self.rungs.values()]
        return xarray.concat(found, dim=xarray.Variable("rung", list(self.rungs)), combine_attrs="override")


@signals.defer()
def ladder(
    vehicle: Vehicle,
    laws: Law | Controller | Sequence[Law | Controller],
    starts: State,
    duration: float = 10.0,
    *,
    rungs: Mapping[str, str | AnyPlant] | None = None,
    workers: int | None = None,
    progress: Callable[[str, int, int], Any] = lambda *_: None,
) -> Ladder:
    """Fly `vehicle` under `laws` from `starts` on each of `rungs`.

    Parameters
    ----------
    vehicle, laws, starts, duration, workers
        As in `compare`.
    rungs : dict, optional
        Plants by name of the rung; default `rungs_for(vehicle)`.
    progress : callable
        Called with `(task, done, total)`.
    """
    worlds = {
        rung: plants.plant(plant) for rung, plant in (rungs or rungs_for(vehicle)).items()
    }  # raises if an extra is not installed
    of_laws = flights_of(vehicle, laws, starts, duration)
    flights = {(rung, law): flight.through(world) for rung, world in worlds.items() for law, flight in of_laws.items()}
    ensembles = fly_each(
        flights, workers, lambda key, done, total: progress(f"flying {key[1]} on {key[0]}", done, total)
    )
    return Ladder({rung: Comparison({law: ensembles[rung, law] for law in of_laws}) for rung in worlds})
