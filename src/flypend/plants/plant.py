"""Plants as data: the ideal plant, or a sampled plant with limits, lag, delay, noise and wind."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from numbers import Integral
from types import MappingProxyType
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.errors import InputError
from flypend.model import Vehicle
from flypend.model.air import AIR, AirEffect
from flypend.model.joint import stiffness
from flypend.model.state import E3Direction
from flypend.plants.noise import Noise
from flypend.plants.sensors import sensors_called

Engine = Literal["equations", "mujoco"]
Interface = Literal["wrench", "rates"]
MISMATCHED = (
    "mass", "bob_mass", "rod_length", "rod_inertia", "inertia", "rotor_positions", "drag_ratio", "rotor_lag"
)  # fmt: skip


# Every command in transit is kept, and the prediction goes through them all: a delay in ms given as s would never end.
LONGEST_DELAY, MOST_IN_TRANSIT = 0.5, 1000  # s, commands
MOST_SAG = 0.25  # beyond, rotors asked for more than nearly everything give less
MOST_STIFFNESS = 1e3  # 1/s; steps of 2 ms are stable up to 1,390
LEAST_RATE = 0.01  # Hz; a period of so many steps (`schedule.PLANT_STEP`) still takes no time to fly


def check_seed(field: str, seed: object) -> None:
    """Raise InputError unless `seed` is an integer from 0 to 2⁶²; messages begin with `field`."""
    if not isinstance(seed, Integral) or isinstance(seed, bool) or not 0 <= int(seed) <= 2**62:
        raise InputError(field, "an integer from 0 to 2⁶²", repr(seed))


def are_seeds(seeds: object) -> bool:
    """Whether `seeds` is a sequence, each of whose entries may be a seed."""
    return isinstance(seeds, list | tuple | range) or (isinstance(seeds, np.ndarray) and seeds.ndim > 0)


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Wind:
    """External forces on vehicle and bob: steady wind, gusts and knocks; world frame with e₃ up, N.

    A knock comes once in every interval of `knock_period`, at a random moment: an impulse on the vehicle and one on the
    bob, each of fixed size and random direction, which act for one control period.

    Parameters
    ----------
    on_vehicle, on_bob : (3,)
        Constant forces.
    gust_on_vehicle, gust_on_bob : float
        Standard deviation of a gust per axis, from the start on; gusts are white noise through a first-order filter.
    gust_time : float
        Correlation time of a gust, s.
    knock_on_vehicle, knock_on_bob : float
        Size of the impulses of a knock, N s.
    knock_period : float
        Length of the intervals with one knock each, s.
    """

    on_vehicle: Any = (0.0, 0.0, 0.0)
    on_bob: Any = (0.0, 0.0, 0.0)
    gust_on_vehicle: float = 0.0
    gust_on_bob: float = 0.0
    gust_time: float = 1.0
    knock_on_vehicle: float = 0.0
    knock_on_bob: float = 0.0
    knock_period: float = 4.0

    def __post_init__(self) -> None:
        for name in ("on_vehicle", "on_bob"):
            object.__setattr__(self, name, tuple(errors.array(f"wind.{name}", getattr(self, name), (3,)).tolist()))
        for on in ("on_vehicle", "on_bob"):
            errors.number(f"wind.gust_{on}", getattr(self, f"gust_{on}"), at_least=0, unit="N")
            errors.number(f"wind.knock_{on}", getattr(self, f"knock_{on}"), at_least=0, unit="N s")
        for name in ("gust_time", "knock_period"):
            errors.number(f"wind.{name}", getattr(self, name), above=0, unit="s")

    @property
    def knocks(self) -> bool:
        """Whether there are knocks."""
        return max(self.knock_on_vehicle, self.knock_on_bob) > 0

    @property
    def random(self) -> bool:
        """Whether there are gusts or knocks."""
        return self.knocks or max(self.gust_on_vehicle, self.gust_on_bob) > 0


# Numbers of `Sampled`, with bounds and units; those that may be None; and the kinds of other fields.
# A prediction takes 100 ticks or more at the highest rate.
_NUMBERS: dict[str, dict[str, Any]] = {
    "rate": {"above": 0, "at_most": 1e4, "unit": "Hz"}, "rate_loop_rate": {"above": 0, "at_most": 1e5, "unit": "Hz"},
    "rate_loop_gain": {"above": 0, "unit": "1/s"}, "lag": {"at_least": 0, "unit": "s"}, "spin_up": {"above": 0},
    "sag": {"at_least": 0, "at_most": MOST_SAG}, "ground": {"unit": "m"}, "floor": {"unit": "m"},
    "pivot_damping": {"at_least": 0, "unit": "N m s"}, "pivot_friction": {"at_least": 0, "unit": "N m"},
    "rod_spin": {"unit": "rad/s"},
}  # fmt: skip
_OPTIONAL = ("lag", "ground", "floor")
_KINDS: tuple[tuple[str, Any, str], ...] = (
    ("limits", bool, "true or false"),
    ("noise", Noise | None, "a Noise or None"),
    ("wind", Wind | None, "a Wind or None"),
    ("mismatch", Mapping, "factors by name"),
)


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Ideal:
    """The ideal plant of the theorems: continuous time. The wrench acts as commanded, or within limits or after a lag.

    Parameters
    ----------
    limits : bool
        Whether commands are kept within `vehicle.rotor_limits`; priority: roll and pitch, thrust, yaw.
    lag : bool
        Whether every rotor's force follows its command through the first-order lag of the vehicle, `rotor_lag`; so do
        thrust and moment. Without limits, commands have either sign.
    rotors : array, optional
        With `lag`, forces of the n rotors at the start, N: (n,) for all runs, or (runs, n) for each. Default: their
        minimum.
    floor : float, optional
        As in `Plant`.

    Raises
    ------
    InputError
        If a field is not of this kind.
    """

    limits: bool = False
    lag: bool = False
    rotors: Any = None
    floor: float | None = None

    def __post_init__(self) -> None:
        if self.floor is not None:
            errors.number("plant.floor", self.floor, unit="m")
        for name in ("limits", "lag"):
            if not isinstance(getattr(self, name), bool):
                raise InputError(f"plant.{name}", "true or false", repr(getattr(self, name)))
        if self.rotors is None:
            return
        if not self.lag:
            raise InputError("plant.rotors", "nothing without lag: forces are as commanded", "forces")
        given = np.asarray(errors.array("plant.rotors", self.rotors, (None,), batch=True))
        # Hashable, as every plant.
        object.__setattr__(self, "rotors", tuple(map(tuple, given.tolist())) if given.ndim > 1 else tuple(given))

    def initial_wrench(self, vehicle: Vehicle, runs: int, e3: E3Direction) -> NDArray[np.float64]:
        """Return the wrench (runs, 4) at the start in the frame of `e3`. Raises InputError for wrong `rotors`."""
        n = len(vehicle.rotor_spins)
        forces = np.array(np.full(n, vehicle.rotor_limits[0]) if self.rotors is None else self.rotors)
        if forces.shape not in ((n,), (runs, n)):
            raise InputError("plant.rotors", f"forces of {n} rotors, or of {n} for each run", f"shape {forces.shape}")
        found: NDArray[np.float64] = np.broadcast_to(forces, (runs, n)) @ vehicle.mixing(e3).T
        return found


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Sampled:
    """A plant under sampled control. Each departure from the ideal plant can be set on its own.

    `flypend.Plant` is this class.

    Parameters
    ----------
    engine : "equations" or "mujoco"
        Integrator of the motion: the built-in equations, or MuJoCo.
    limits : bool
        Whether commands are kept within `vehicle.rotor_limits`; priority: roll and pitch, thrust, yaw. Rotors idle at
        their minimum until the first command acts, with or without limits.
    lag : float, optional
        Time constant of the rotors, s; 0 for none. Default: that of the vehicle.
    rate : float
        Control rate, Hz; commands are held in between (zero-order hold).
    delay : float
        Delay from measurement to command, s.
    noise : Noise, optional
        Measurement noise.
    spin_up : float
        Time constant of a rotor's force while it rises, divided by `lag`, its time constant while it falls.
    sag : float
        Share of the battery's voltage that is lost when every rotor is commanded its maximum; forces are
        proportional to the square of the voltage.
    strength : float or (n,)
        Ratio of the force of each rotor to the commanded one.
    air : tuple of str, or "all"
        Forces of the air that act: "rotor_drag", "inflow", "lift", "body_drag"; their coefficients are those of the
        vehicle's `air`. "all" stands for those that are not zero there.
    ground : float, optional
        Height of a ground that raises the thrust of rotors close to it, m; None for none. The radius of the rotors is
        that of the vehicle's `body`. Nothing collides with the ground: see `floor`.
    floor : float, optional
        Height of a floor, m, upward from the origin of the world; None for none. A flight ends as collided where the
        hub, a rotor disc or the end of the rod touches it; see `flypend.model.outline`.
    sensors : Sensors, str or dict, optional
        What measures the state, or the name of a suite ("mocap", "onboard") or a table. Default "perfect": the
        flight computer measures the state itself, with `noise`.
    pivot_offset : (3,)
        Offset of the ball joint, added to the vehicle's, body frame, m. The law does not know it.
    centre_of_mass : (3,)
        True centre of mass of the vehicle relative to the one that the law assumes, body frame, m; rotors and joint
        stay where they are.
    pivot_damping, pivot_friction : float
        Viscous (N m s) and dry friction (N m) of the joint, added to the vehicle's. The law does not know of them.
    rod_spin : float
        Angular velocity of the rod about its own axis, added to the vehicle's, rad/s. The rod must have a
        `rod_spin_inertia`. The law does not know of it.
    mismatch : dict
        Ratio of true to nominal value for mass, bob_mass, rod_length (and rod_end with it), rod_inertia, inertia,
        rotor_positions, drag_ratio, rotor_lag.
    wind : Wind, optional
        External forces.
    interface : "wrench" or "rates"
        What the law commands: rotor forces, or collective thrust and body rates, which an onboard inner loop tracks
        with gyroscope data.
    rate_loop_rate, rate_loop_gain : float
        Frequency (Hz) and proportional gain (1/s) of that inner loop.
    seed : int
        Seed of noise, gusts and knocks.

    Raises
    ------
    InputError
        If a field is out of range.
    """

    engine: Engine = "equations"
    limits: bool = True
    lag: float | None = None
    rate: float = 500.0
    delay: float = 0.0
    noise: Noise | None = None
    spin_up: float = 1.0
    sag: float = 0.0
    strength: Any = 1.0
    air: Any = ()
    ground: float | None = None
    floor: float | None = None
    sensors: Any = None
    pivot_offset: Any = (0.0, 0.0, 0.0)
    centre_of_mass: Any = (0.0, 0.0, 0.0)
    pivot_damping: float = 0.0
    pivot_friction: float = 0.0
    rod_spin: float = 0.0
    mismatch: Mapping[str, float] = field(default_factory=dict)
    wind: Wind | None = None
    interface: Interface = "wrench"
    rate_loop_rate: float = 1000.0
    rate_loop_gain: float = 40.0
    seed: int = 0

    def __post_init__(self) -> None:
        errors.one_of("plant.engine", self.engine, ("equations", "mujoco"))
        errors.one_of("plant.interface", self.interface, ("wrench", "rates"))
        for name, bounds in _NUMBERS.items():
            if (value := getattr(self, name)) is not None or name not in _OPTIONAL:
                errors.number(f"plant.{name}", value, **bounds)
        for name in ("rate", "rate_loop_rate"):
            if getattr(self, name) < LEAST_RATE:
                raise InputError(f"plant.{name}", f"at least {LEAST_RATE:g} Hz", f"{getattr(self, name):g}")
        longest = min(LONGEST_DELAY, MOST_IN_TRANSIT / self.rate)
        errors.number("plant.delay", self.delay, at_least=0, at_most=longest, unit="s")
        object.__setattr__(self, "strength", _strength(self.strength))
        object.__setattr__(self, "air", _effects(self.air))
        for name, kind, expected in _KINDS:
            if not isinstance(value := getattr(self, name), kind):
                raise InputError(f"plant.{name}", expected, repr(value))
        object.__setattr__(self, "sensors", sensors_called(self.sensors))
        if self.sensors is not None and self.noise is not None:
            raise InputError("plant.noise", "none beside sensors, which have noise of their own", repr(self.noise))
        check_seed("plant.seed", self.seed)
        for name in ("pivot_offset", "centre_of_mass"):
            offset = errors.array(f"plant.{name}", getattr(self, name), (3,))
            object.__setattr__(self, name, tuple(offset.tolist()))
        errors.only_known("plant.mismatch", self.mismatch, MISMATCHED)
        for name, factor in self.mismatch.items():
            errors.number(f"plant.mismatch.{name}", factor, above=0)
        object.__setattr__(self, "mismatch", dict(self.mismatch))

    def __hash__(self) -> int:
        """Hash by content, since `mismatch` is a dict."""
        return hash(repr(self))

    @property
    def assumed_delay(self) -> float:
        """The delay (s) from measurement to command that an estimator on board assumes."""
        given = None if self.sensors is None else self.sensors.command_delay
        return float(self.delay if given is None else given)

    def true_vehicle(self, vehicle: Vehicle) -> Vehicle:
        """Return the true vehicle for the nominal `vehicle`, with `mismatch`, `lag` and what the joint adds applied.

        Raises InputError if `vehicle` lacks what the plant needs: as many rotors as there are strengths, coefficients
        of the air, a radius of the rotors, a rod that can spin; and for friction that is too stiff.
        """
        self._check(vehicle)
        changes = {name: getattr(vehicle, name) * factor for name, factor in self.mismatch.items()}
        if vehicle.rod_end is not None and "rod_length" in changes:
            changes["rod_end"] = vehicle.rod_end * self.mismatch["rod_length"]
        if self.lag is not None:
            changes["rotor_lag"] = self.lag * self.mismatch.get("rotor_lag", 1.0)
        if any(self.pivot_offset) or any(self.centre_of_mass):
            moved = np.subtract(self.pivot_offset, self.centre_of_mass)
            changes["pivot_offset"] = vehicle.pivot_offset + moved
        if any(self.centre_of_mass):
            changes["rotor_positions"] = changes.get("rotor_positions", vehicle.rotor_positions) - self.centre_of_mass
        for name in ("pivot_damping", "pivot_friction", "rod_spin"):
            if added := getattr(self, name):
                changes[name] = getattr(vehicle, name) + added
        true = vehicle.replace(**changes)
        stiffest = stiffness(true)
        if stiffest > MOST_STIFFNESS:
            wanted = "friction that takes a millisecond or more to stop the vehicle"
            raise InputError("vehicle.pivot_friction", wanted, f"{1e3 / stiffest:.2g} ms")
        return true

    def effects(self, vehicle: Vehicle) -> tuple[Any, ...]:
        """Return the forces of the air that act on `vehicle`, of `flypend.model.air.AIR`."""
        known = _air_effects(vehicle)
        return known if self.air == ("all",) else tuple(name for name in AIR if name in self.air)

    def in_air(self, vehicle: Vehicle) -> bool:
        """Whether forces of the air or the ground act on `vehicle`, which depend on its motion and position."""
        return bool(self.effects(vehicle)) or self.ground is not None

    def _check(self, vehicle: Vehicle) -> None:
        n, strengths = len(vehicle.rotor_spins), np.size(self.strength)
        if strengths not in (1, n):
            raise InputError("plant.strength", f"a number, or one for each of {n} rotors", f"{strengths} numbers")
        known = _air_effects(vehicle)
        for name in self.air:
            if name not in known and (name != "all" or not known):
                wanted = "coefficients of the air" if name == "all" else f"a coefficient {name!r} > 0"
                raise InputError("vehicle.air", f"{wanted}, for plant.air", "none")
        if self.ground is not None and vehicle.body is None:
            raise InputError("vehicle.body", "the radius of the rotor discs, for plant.ground", "nothing")
        if self.rod_spin and not vehicle.rod_spin_inertia:
            raise InputError("vehicle.rod_spin_inertia", "a number > 0, for plant.rod_spin", "0")

    def replace(self, **changes: Any) -> Sampled:
        """Return a copy with the fields in `changes` replaced, validated again. Raises InputError."""
        errors.only_known("plant", changes, [entry.name for entry in fields(self)])
        return replace(self, **changes)


def _air_effects(vehicle: Vehicle) -> tuple[AirEffect, ...]:
    """Return the forces of the air whose coefficients `vehicle` has."""
    return () if vehicle.air is None else vehicle.air.active()


def _strength(value: Any) -> float | tuple[float, ...]:
    """Return a strength as a number, or as a tuple of one a rotor."""
    field, expected = "plant.strength", "a number > 0, or one per rotor"
    if np.ndim(value) == 0:
        return errors.number(field, value, above=0)
    strengths = errors.array(field, value, (None,))
    if not (strengths.size and np.all(strengths > 0)):
        raise InputError(field, expected, strengths.tolist())
    return tuple(strengths.tolist())


def _effects(value: Any) -> tuple[str, ...]:
    """Return the names of forces of the air as a tuple."""
    names = (value,) if isinstance(value, str) else tuple(value) if isinstance(value, list | tuple) else None
    if names is None:
        raise InputError("plant.air", "names of " + ", ".join((*AIR, "all")), repr(value))
    return tuple(errors.one_of("plant.air", name, (*AIR, "all")) for name in names)


Plant = Sampled
AnyPlant = Ideal | Sampled

ROTORS = Sampled()
PRESETS: Mapping[str, AnyPlant] = MappingProxyType(
    {
        "ideal": Ideal(),
        "rotors": ROTORS,
        "mujoco": ROTORS.replace(engine="mujoco"),
        # Hehn and D'Andrea (2011): commands at 50 Hz, about 30 ms latency, onboard body rate control.
        "hehn2011": ROTORS.replace(interface="rates", rate=50.0, delay=0.03),
        # A careful laboratory as one finds it: its sensors, tired motors, a battery in use, a body built by hand.
        "laboratory": ROTORS.replace(sensors="laboratory", strength=0.93, sag=0.08, centre_of_mass=(0.003, 0.0, 0.0)),
    }
)


def plant(name: str | AnyPlant) -> AnyPlant:
    """The plant called `name` ("ideal", "rotors", "mujoco", "hehn2011", "laboratory"), or `name` if it is a plant.

    Raises InputError for an unknown name, and for a MuJoCo plant if MuJoCo is not installed.
    """
    if not isinstance(name, str | Ideal | Sampled):
        raise InputError("plant", "a Plant, Ideal() or one of " + ", ".join(PRESETS), repr(name))
    found = PRESETS[errors.one_of("plant", name, PRESETS)] if isinstance(name, str) else name
    if isinstance(found, Sampled) and found.engine == "mujoco":
        errors.require("mujoco", extra="mujoco", for_="plant")
    return found


def as_sampled(name: str | AnyPlant) -> Sampled:
    """Like `plant`, but `name` must be a sampled plant. Raises InputError for the ideal plant."""
    found = plant(name)
    if isinstance(found, Ideal):
        raise InputError("plant", "a plant with numbers, such as 'rotors'", "the ideal plant")
    return found
