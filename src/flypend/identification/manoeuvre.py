"""The flight that `identify` asks for, rehearsed: rod hanging, small steps, and doublets in roll, pitch and yaw."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend import errors, signals
from flypend.compile.numeric import as_numpy
from flypend.files.whole import whole_file
from flypend.geometry import E3, Numbers, quat_xyzw_from_rotation, rotation_from_vector, unit, vee
from flypend.identification.log import FORCE, GYRO, POSE, ROD, SHORTEST
from flypend.identification.model import specific_force
from flypend.model import State, Vehicle
from flypend.model.rod import stretch
from flypend.model.state import SIZE
from flypend.plants.actuation import make_engine
from flypend.plants.equations import rates_under
from flypend.plants.measurement import GUST_MEMORY, gusts, wind_numbers
from flypend.plants.noise import Noise
from flypend.plants.plant import Plant, Wind
from flypend.plants.schedule import segments_within

RATE = 250.0  # Hz, of commands and rows
STEP_TIME, STEP = 2.5, 0.4  # s between steps of the place that is held, and their size, m
DOUBLET_TIME, DOUBLET = 0.12, 0.6  # s of each half, and its moment over the largest that leaves hover's thrust
# Largest tilt of a doublet, and swing that it may give the rod, rad. Otherwise it turns a light machine over, and a rod
# that swings through the horizontal is lost to a filter that begins with a wrong length.
TILT, SWING = 0.6, 0.25
# Feedback of the flight. The attitude's natural frequency A, 1/s, is at most LAG_SHARE/lag of the rotors, its damping
# and integral terms ATTITUDE_DAMPING A and TRIM A³, and the place's frequency PLACE_SHARE A: the hanging rod has no
# damping of its own, and a place held as fast as the late thrust axis turns swings it up. SWAY is the acceleration, in
# g, that a level rod asks for. By the linear theory of hover 13 of 150 random machines are unstable, by 6 % a second.
ATTITUDE, LAG_SHARE, ATTITUDE_DAMPING, TRIM, PLACE_SHARE, SWAY = 12.0, 0.5, 2.4, 0.15, 0.133, 0.05
ACCELEROMETER = 0.1  # m/s², standard deviation of its noise
SCALE = 0.93  # of the rotors of a rehearsal
WRONG = ("rod_length", "inertia", "drag_ratio", "rotor_lag")  # in its guess
DRAWN = ("thrust_scale", "strength", "sag", "spin_up", "delay", "latency")  # other than the vehicle's bands may say
LONGEST = 600.0  # s, of a rehearsal; a log of more tells no more


class Rehearsal(NamedTuple):
    """A flown log, row by row, beside the true states (k, 24)."""

    columns: dict[str, Any]
    states: Numbers


def doublet(t: float) -> Any:
    """Return the moment (3,) to add at `t`, s, as a share of the largest: roll, pitch and yaw in turn."""
    turn, since = divmod(t, 1.0)
    moment = np.zeros(3)
    if since < 2 * DOUBLET_TIME and t > 1:
        moment[int(turn) % 3] = DOUBLET if since < DOUBLET_TIME else -DOUBLET
    return moment


def rehearse(
    vehicle: Vehicle, true: Vehicle, plant: Plant, *, duration: float = 60.0, latency: float = 0.0,
    bias: float = 0.0, seed: int = 0,
) -> Rehearsal:  # fmt: skip
    """Fly the manoeuvre with the rod hanging for `duration` seconds, and log it.

    The pilot's feedback believes in `vehicle`, but `true` flies. The `plant` has engine, motors, delay, air and gusts;
    its `noise` is that of the readings. Poses are `latency` seconds older than the row that they stand in. The
    gyroscope's bias has a standard deviation of `bias`, rad/s, that of the accelerometer ten times as many m/s². All
    noise is drawn by `seed`.
    """
    vehicle, true = vehicle.commanded(), true.commanded()
    rng, n, h = np.random.default_rng(seed), len(vehicle.rotor_spins), 1 / RATE
    noise, engine = plant.noise or Noise(), make_engine(true, plant)
    hover = np.full(n, vehicle.weight / n)
    engine.reset(State(y=(0, 0, -1)).packed(), hover)
    where = rng.uniform(-STEP, STEP, (int(duration / STEP_TIME) + 1, 3))  # the places to hold
    biases = bias * rng.normal(size=6) * np.repeat([1, 10], 3)
    segments, felt = segments_within(plant.delay, h), _specific_force(true, plant)
    asked = [hover] * (2 + max(age for age, _ in segments))
    blow, wind, rows, states = as_numpy(gusts(knocks=False)), wind_numbers(plant.wind, h), [], []
    first, before = rng.spawn(1)[0].normal(size=(2, 6))
    gust, outside = blow(np.append(first, np.zeros(GUST_MEMORY - 6)), before, wind)
    behind, turned = round(latency / h), np.zeros(3)
    attitude = LAG_SHARE / max(true.rotor_lag, LAG_SHARE / ATTITUDE)
    for k in range(int(duration * RATE)):
        signals.poll()
        packed = engine.packed
        states.append(packed)
        seen = State.trusted(states[max(0, k - behind)])
        s = State.trusted(packed)
        x = seen.x + noise.x * rng.normal(size=3)
        R = seen.R @ rotation_from_vector(noise.attitude * rng.normal(size=3))
        y = unit(seen.y + noise.y * rng.normal(size=3))
        gyro = s.omega + biases[:3] + noise.omega * rng.normal(size=3)
        force = felt(packed, engine.rotors, outside) + biases[3:] + ACCELEROMETER * rng.normal(size=3)
        speed = seen.x_dot + noise.x_dot * rng.normal(size=3)
        read = x - where[int(k * h / STEP_TIME)], speed, R, gyro, y
        command, error = _feedback(k * h, read, turned, vehicle, attitude)
        turned += h * error
        rows.append([k * h, *x, *quat_xyzw_from_rotation(R)[[3, 0, 1, 2]], *gyro, *force, *y, *command])
        asked = [command, *asked[:-1]]
        if plant.wind is not None:
            gust, outside = blow(gust, rng.normal(size=6), wind)
        for age, held in segments:
            for _ in range(2):
                engine.step(asked[age], held / 2, outside)
    names = ("t", *POSE, *GYRO, *FORCE, *ROD, *(f"u{i + 1}" for i in range(n)))
    return Rehearsal(dict(zip(names, np.array(rows).T, strict=True)), np.array(states))


def write_log(path: str | Path, columns: dict[str, Any]) -> None:
    """Write the `columns` of a log as CSV. Raises InputError if the file cannot be written."""
    lines = [",".join(columns)]
    for row in zip(*columns.values(), strict=True):
        lines.append(",".join("" if np.isnan(value) else f"{value:.7g}" for value in row))
    with whole_file(path, (".csv",)) as target:
        target.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _specific_force(true: Vehicle, plant: Plant) -> Callable[..., Any]:
    """Return (state (24,), rotor forces (n,), wind (6,)) → specific force (3,) at the centre of mass, body, m/s²."""
    packed, rotors, wind = ca.SX.sym("s", SIZE), ca.SX.sym("f", len(true.rotor_spins)), ca.SX.sym("g", 6)
    rates = State.symbolic(rates_under(packed, rotors, true.mixing() @ rotors, wind, true, plant))
    felt = specific_force(State.symbolic(packed), rates, true)
    return as_numpy(ca.Function("felt", [packed, rotors, wind], [ca.densify(felt)]))


def _feedback(t: float, read: Any, turned: Any, vehicle: Vehicle, attitude: float) -> tuple[Any, Any]:
    """Return the rotor forces (n,), N, that hold a place, with the doublets, and the error (3,) of attitude, rad.

    `read` are the position from that place, velocity, R, ω and y; `attitude` is the frequency of its loop, 1/s, and
    `turned` the integral of the error, rad s.
    """
    apart, speed, R, omega, y = read
    total, place = vehicle.mass + vehicle.bob_mass, PLACE_SHARE * attitude
    swung = SWAY * vehicle.gravity * np.append(y[:2], 0.0)
    force = total * (vehicle.gravity * E3 - place**2 * apart - 2 * place * speed - swung)
    level = unit(force)
    ahead = unit(np.cross(level, [1.0, 0.0, 0.0]))
    wanted = np.column_stack([np.cross(ahead, level), ahead, level])
    error = vee(wanted.T @ R)
    held = error + ATTITUDE_DAMPING / attitude * omega + TRIM * attitude * turned
    moment = -(attitude**2) * vehicle.I @ held
    low, high = vehicle.rotor_limits
    room = min(vehicle.weight / len(vehicle.rotor_spins) - low, high - vehicle.weight / len(vehicle.rotor_spins))
    added = doublet(t) * room * np.abs(vehicle.mixing()[1:]).sum(axis=1)
    # The two halves T of a doublet change the speed of the pivot by g T times the tilt, and the rod swings.
    tilt = min(TILT, SWING * np.sqrt(vehicle.gravity * vehicle.l) / (vehicle.gravity * DOUBLET_TIME))
    most = tilt / DOUBLET_TIME**2 * np.diag(vehicle.I)[:2]
    moment = moment + np.append(np.clip(added[:2], -most, most), added[2])
    return np.clip(vehicle.unmixing() @ np.array([force @ R[:, 2], *moment]), low, high), error


def rehearsal_of(vehicle: Vehicle, *, duration: float = 60.0, seed: int = 0) -> tuple[Vehicle, Rehearsal]:
    """Return a guess at `vehicle`, wrong by some tenths, and its flight in air, with gusts, noise, sag and delay.

    The guess has no bands of the numbers in `WRONG` and `DRAWN`. The rotors push `SCALE` times what `vehicle` says.
    Delay, sag and strengths are drawn by `seed`. Raises InputError for a `duration` (s) whose log `read_log` would not
    take, or longer than `LONGEST`.
    """
    errors.number("duration", duration, at_least=SHORTEST + 0.5, at_most=LONGEST, unit="s")
    rng = np.random.default_rng(seed)

    def off(share: float) -> float:
        return 1 + float(rng.uniform(-share, share))

    guess = vehicle.replace(
        **stretch(vehicle, 1.0, off(0.1)), drag_ratio=vehicle.drag_ratio * off(0.3),
        inertia=vehicle.inertia * off(0.3), rotor_lag=0.03,
        bands={name: band for name, band in (vehicle.bands or {}).items() if name not in WRONG + DRAWN},
    )  # fmt: skip
    gust = 0.02 * vehicle.commanded().weight
    plant = Plant(
        air=() if vehicle.air is None else vehicle.air.active(),
        delay=rng.uniform(0, 0.02), sag=rng.uniform(0.02, 0.08), spin_up=rng.uniform(1, 1.4),
        strength=tuple(SCALE * (1 + rng.uniform(-0.05, 0.05, len(vehicle.rotor_spins)))),
        noise=Noise(x=1e-3, x_dot=3e-2, attitude=3.5e-3, omega=2e-2, y=3.5e-3),
        wind=Wind(gust_on_vehicle=gust, gust_on_bob=gust / 5),
    )  # fmt: skip
    return guess, rehearse(guess, vehicle, plant, duration=duration, latency=0.008, bias=0.01, seed=seed)
