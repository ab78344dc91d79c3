"""Vehicle parameters, loaded from TOML and validated once, and the rotor mixing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from flypend import errors
from flypend.errors import InputError
from flypend.files.toml import read_toml
from flypend.geometry import Matrix, Numbers, Vector
from flypend.model.air import Air
from flypend.model.bands import bands_from
from flypend.model.body import MOUNTS, Body, MountKind
from flypend.model.estimate import Measured, Quantity, guess
from flypend.model.mjcf import model_xml
from flypend.model.plausible import check_plausible
from flypend.model.state import FLIP, E3Direction
from flypend.model.table import on_base
from flypend.model.urdf import model_sdf, model_urdf

# By which power of s the bands shrink of a machine whose rotors push s times as hard as commanded.
SCALED = {"mass": 1.0, "bob_mass": 1.0, "inertia": 1.0, "thrust_scale": 1.0, "rotor_drag": 0.5, "inflow": 0.5}


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Vehicle:
    """A multirotor with a rod on a ball joint. SI units, body frame front-left-up.

    A rod with the transverse inertia J moves like a point bob with a second mass at the pivot: together they have the
    mass, first moment and second moment of the rod. The paper's letters are those of that bob. They are exact for every
    rod whose pivot is at the vehicle's centre of mass: m = λ bob_mass, l = rod_length/λ, M = mass + (1 − λ) bob_mass, λ
    = 1/(1 + J/(bob_mass rod_length²)).

    Parameters
    ----------
    name : str
        Name for tables and files.
    mass : float
        Mass without the rod, kg.
    bob_mass : float
        Mass of the rod with its bob, kg.
    rod_length : float
        Distance from the pivot to the centre of mass of rod and bob, m.
    rod_end : float, optional
        Distance from the pivot to the far end of the rod, m; default `rod_length`.
    rod_inertia : float
        Moment of inertia of the rod with its bob about their centre of mass, across the rod; 0 for a point mass, kg m².
        See `flypend.model.rod`.
    inertia : (3,) or (3, 3)
        Principal moments or inertia matrix about the centre of mass, body frame; kg m².
    gravity : float
        g, m/s².
    rotor_positions : (n, 3)
        Positions of the n ≥ 4 rotors relative to the centre of mass, body frame; m.
    rotor_spins : (n,)
        Sign of the reaction torque of each rotor about the up axis: +1 for a rotor spinning clockwise seen from above.
    drag_ratio : float
        c, torque per unit thrust of a rotor; m.
    rotor_limits : (2,)
        Minimum and maximum force of one rotor; N.
    rotor_lag : float
        Time constant of the first-order lag of the rotor forces; s.
    mount : "gimbal", "hub" or "cup"
        What carries the rod; see `flypend.model.body`.
    body : Body or dict, optional
        Radii of the parts that the rod can touch; required for a hub or a cup.
    pivot_offset : (3,)
        Position of the ball joint relative to the centre of mass, body frame, m. Offset, friction and spin act in
        sampled plants; laws and the ideal plant neglect them.
    pivot_damping, pivot_friction : float
        Viscous (N m s) and dry friction (N m) of the joint; see `flypend.model.joint`.
    rod_spin, rod_spin_inertia : float
        Constant angular velocity of the rod about its own axis, rad/s, and its moment of inertia about it, kg m².
    air : Air or dict, optional
        Coefficients of the air's forces. They act on plants that name them; laws do not know them.
    thrust_scale : float
        Ratio of the force of every rotor to that commanded. Limits, commands and flights are in commanded force; see
        `commanded`.
    bands : dict, optional
        Field → (low, high), as `Vehicle.estimate` and `flypend.identify` return them. For `identify`, the bands of the
        guess are the prior.

    Raises
    ------
    InputError
        If a number is not finite, out of range or implausible (see `flypend.model.plausible`), the inertia is not
        symmetric positive definite or violates the triangle inequality, a spin is not ±1, the rotors cannot produce
        every wrench, the mount is unknown, or a hub or cup has no body.
    """

    name: str = "unnamed"
    mass: float
    bob_mass: float
    rod_length: float
    rod_end: float | None = None
    rod_inertia: float = 0.0
    inertia: Matrix
    gravity: float = 9.81
    rotor_positions: Numbers
    rotor_spins: Numbers
    drag_ratio: float
    rotor_limits: Numbers
    rotor_lag: float = 0.0
    mount: MountKind = "gimbal"
    body: Any = None
    pivot_offset: Vector = (0.0, 0.0, 0.0)
    pivot_damping: float = 0.0
    pivot_friction: float = 0.0
    rod_spin: float = 0.0
    rod_spin_inertia: float = 0.0
    air: Any = None
    thrust_scale: float = 1.0
    bands: Any = None

    def __post_init__(self) -> None:
        def put(name: str, value: Any) -> None:
            if isinstance(value, np.ndarray):
                value.setflags(write=False)
            object.__setattr__(self, name, value)

        for name, bounds in _NUMBERS.items():
            put(name, errors.number(name, getattr(self, name), **bounds))
        if self.rod_end is not None:
            put("rod_end", errors.number("rod_end", self.rod_end, at_least=self.rod_length, unit="m"))
        self._check_spin()
        put("inertia", _inertia(self.inertia))
        put("rotor_positions", errors.array("rotor_positions", self.rotor_positions, (None, 3)))
        put("rotor_spins", errors.array("rotor_spins", self.rotor_spins, (len(self.rotor_positions),)))
        put("rotor_limits", errors.array("rotor_limits", self.rotor_limits, (2,)))
        if not np.all(np.abs(self.rotor_spins) == 1):
            raise InputError("rotor_spins", "each +1 or -1", self.rotor_spins.tolist())
        if not 0 <= self.rotor_limits[0] < self.rotor_limits[1]:
            raise InputError("rotor_limits", "0 <= least < largest force in N", self.rotor_limits.tolist())
        errors.one_of("mount", self.mount, MOUNTS)
        put("body", _record(Body, "body", self.body, "a Body"))
        put("pivot_offset", errors.array("pivot_offset", self.pivot_offset, (3,)))
        put("air", _record(Air, "air", self.air, "an Air"))
        put("bands", bands_from(self.bands, len(self.rotor_spins)))
        if self.mount != "gimbal" and self.body is None:
            raise InputError("body", f"the radii of the machine's parts, for the mount {self.mount!r}", "nothing")
        rank = np.linalg.matrix_rank(self.mixing())
        if rank < 4:
            raise InputError("rotor_positions", "rotors that produce every thrust and moment", f"mixing of rank {rank}")
        check_plausible(self)

    def _check_spin(self) -> None:
        inertia = self.rod_spin_inertia
        if inertia > 2 * self.rod_inertia * (1 + 1e-9):
            given = f"{inertia:g} with rod_inertia {self.rod_inertia:g}"
            raise InputError("rod_spin_inertia", "at most twice rod_inertia, as in every solid body", given)
        if self.rod_spin and not inertia:
            raise InputError("rod_spin_inertia", "a number > 0 for a rod that spins", "0")

    @property
    def free_joint(self) -> bool:
        """Whether the joint is as laws take it: at the centre of mass, without friction, the rod not spinning."""
        return not (np.any(self.pivot_offset) or self.rubs or self.rod_spin)

    @property
    def rotors_from_pivot(self) -> Numbers:
        """Rotor positions (n, 3) relative to the pivot, body frame, m."""
        return self.rotor_positions - self.pivot_offset

    @property
    def rubs(self) -> bool:
        """Whether the joint has friction."""
        return self.pivot_damping > 0 or self.pivot_friction > 0

    M = property(lambda self: self.mass + (1 - self._share) * self.bob_mass, doc="Mass that moves with the pivot, kg.")
    m = property(lambda self: self._share * self.bob_mass, doc="Mass of the equivalent point bob, kg.")
    l = property(lambda self: self.rod_length / self._share, doc="Distance from the pivot to the equivalent bob, m.")
    g = property(lambda self: self.gravity, doc="Gravitational acceleration, m/s².")
    I = property(lambda self: self.inertia, doc="Inertia matrix, body frame, kg m².")
    I_inv = property(lambda self: np.linalg.inv(self.inertia), doc="Inverse of the inertia matrix.")

    @property
    def reach(self) -> float:
        """Distance from the pivot to the far end of the rod, m."""
        return self.rod_length if self.rod_end is None else self.rod_end

    @property
    def _share(self) -> float:
        """Share of the rod's mass in the equivalent point bob, m l²/(m l² + J): 1 for a point mass."""
        point = self.bob_mass * self.rod_length**2
        return float(point / (point + self.rod_inertia))

    def in_frame(self, e3: E3Direction) -> Vehicle:
        """Return the vehicle with its inertia in the body frame of `e3` ("up" or "down")."""
        turned = FLIP @ self.inertia @ FLIP
        if errors.one_of("e3", e3, ("up", "down")) == "up" or np.array_equal(turned, self.inertia):
            return self
        return replace(self, inertia=turned)

    @property
    def weight(self) -> float:
        """Hover thrust (M + m) g, N."""
        return (self.mass + self.bob_mass) * self.gravity

    def commanded(self) -> Vehicle:
        """Return the vehicle in units of commanded force, in which its `thrust_scale` is 1.

        A machine whose rotors push s times as hard as commanded moves like one with masses, inertias, friction and drag
        divided by s, under the same commands. Laws, flights, plans and models for other engines use that machine; wind
        is in the same unit.
        """
        s = self.thrust_scale
        if s == 1.0:
            return self
        air = self.air
        if air is not None:  # rotor_drag √(s f)/s
            root = {name: getattr(air, name) / np.sqrt(s) for name in ("rotor_drag", "inflow")}
            air = Air(**root, lift=air.lift / s, body_drag=[value / s for value in air.body_drag])
        shared = ("mass", "bob_mass", "rod_inertia", "rod_spin_inertia", "inertia", "pivot_damping", "pivot_friction")
        changes = {name: getattr(self, name) / s for name in shared}
        bands = {name: np.array(band) / s ** SCALED.get(name, 0.0) for name, band in (self.bands or {}).items()}
        return replace(self, **changes, air=air, thrust_scale=1.0, bands=bands or None)

    def mixing(self, e3: E3Direction = "up") -> Numbers:
        """Matrix (4, n) from rotor forces to (thrust, moment) in the body frame of `e3` ("up" or "down").

        For `e3` = "down" the thrust row is negative: the negative of the first row of the paper's (transfmu). The
        other rows agree with (transfmu).
        """
        x, y, _ = self.rotor_positions.T
        up = np.array([np.ones_like(x), y, -x, self.drag_ratio * self.rotor_spins])
        return up if errors.one_of("e3", e3, ("up", "down")) == "up" else np.diag([-1.0, 1.0, -1.0, -1.0]) @ up

    def unmixing(self, e3: E3Direction = "up") -> Numbers:
        """Matrix (n, 4) from (thrust, moment) to rotor forces, of minimum norm for n > 4; `e3` as in `mixing`."""
        return np.linalg.pinv(self.mixing(e3))

    def sharing(self) -> tuple[Numbers, float, Numbers]:
        """Rotor forces per unit roll and pitch moment (n, 2), and per unit yaw moment as magnitude and signs (n,).

        Raises InputError if the rotors do not share thrust equally, or yaw as two groups of equal magnitude.
        """
        unmixing = self.unmixing()
        per_thrust, per_yaw = unmixing[:, 0], unmixing[:, 3]
        if not (np.allclose(per_thrust, 1 / len(unmixing)) and np.allclose(np.abs(per_yaw), np.abs(per_yaw[0]))):
            raise InputError("rotor_positions", "rotors that share thrust and yaw equally", "an asymmetric vehicle")
        return unmixing[:, 1:3], float(np.abs(per_yaw[0])), np.sign(per_yaw)

    def __repr__(self) -> str:
        """Return the name and the numbers that matter most, in one line."""
        rotors = f"{len(self.rotor_spins)} rotors of {self.rotor_limits[0]:g} to {self.rotor_limits[1]:g} N"
        masses = f"mass {self.mass:g} kg, bob {self.bob_mass:g} kg, rod {self.rod_length:g} m"
        return f"<Vehicle {self.name}: {masses}, {rotors}, lag {self.rotor_lag:g} s>"

    @cached_property
    def _content(self) -> str:
        return repr(self.to_dict())

    def __eq__(self, other: object) -> bool:
        """Whether `other` is a vehicle with the same field values."""
        return isinstance(other, Vehicle) and self._content == other._content

    def __hash__(self) -> int:
        return hash(self._content)

    def replace(self, **changes: Any) -> Self:
        """Return a copy with the fields in `changes` replaced, validated again. Raises InputError.

        A dict as `body` or `air` replaces those of its numbers alone.
        """
        errors.only_known("vehicle", changes, _FIELDS)
        for name in ("body", "air"):
            own = getattr(self, name)
            if own is not None and isinstance(changes.get(name), Mapping):
                changes[name] = own.to_dict() | changes[name]
        return replace(self, **changes)

    def to_dict(self) -> dict[str, Any]:
        """Return the fields as plain numbers, lists and dicts, as in a vehicle TOML file."""
        values = {name: _plain(getattr(self, name)) for name in _FIELDS}
        if self.thrust_scale == 1.0:
            del values["thrust_scale"]
        return {name: value for name, value in values.items() if value is not None}

    def to_mjcf(self, *, timestep: float = 1e-3, lag: bool = True) -> str:
        """Return the machine as a model for MuJoCo (MJCF): the one that the plant "mujoco" flies. z up, SI units.

        The body "vehicle" is free, with its origin in the pivot; the body "bob", which is the rod, turns about it by
        the ball joint "pivot". The controls "rotor0", "rotor1", … are the forces of the rotors, N, within
        `rotor_limits`. Friction of the joint, air and the mount are not in the model, since MuJoCo's own joints and air
        differ from the package's. Geoms are for display only, without mass or contact. `rod_spin` belongs to a state.

        Parameters
        ----------
        timestep : float
            Step of the integrator (RK4), s.
        lag : bool
            Whether the forces follow the controls with the time constant `rotor_lag`, from 0 N on.

        Raises
        ------
        InputError
            If the timestep is not positive.
        """
        return model_xml(self.commanded(), timestep=timestep, lag=self.rotor_lag if lag else 0.0, limits=True)

    def to_urdf(self) -> str:
        """Return the machine as URDF, for ROS, Gazebo, Drake, Isaac, PyBullet and MuJoCo. z up, SI units.

        The link "vehicle" is the root, with its origin in the pivot; it is free only if the program that loads it makes
        it so. URDF has no ball joint, so the rod, "bob", turns about two axes, "pivot_x" and "pivot_y". Between them is
        a ring with a millionth of the rod's mass and inertia. The rod cannot spin about its own axis, and the angles
        are singular where it lies along the vehicle's x. The links "rotor0", "rotor1", … are the frames in which the
        rotors push along z. URDF does not describe rotors: limits, torques, lag and mount are in a comment. Shapes are
        for display only, and do not collide.
        """
        return model_urdf(self.commanded())

    def to_sdf(self) -> str:
        """Return the machine as SDF 1.8, for Gazebo and Drake: a model to be included in a world. z up, SI units.

        The link "vehicle" has its origin in the pivot, about which the rod, the link "bob", turns by the ball joint
        "pivot", with z along the rod. The frames "rotor0", "rotor1", … are those in which the rotors push along z.
        Limits, torques, lag and mount are in a comment, as in `to_urdf`. Shapes are for display only, and do not
        collide.
        """
        return model_sdf(self.commanded())

    @classmethod
    def from_dict(cls, values: dict[str, Any], field: str = "vehicle") -> Self:
        """Build a vehicle from the parsed TOML `values`. Raises InputError with field names prefixed by `field`."""
        errors.only_known(field, values, _FIELDS)
        for name in _required(cls):
            if name not in values:
                raise InputError(f"{field}.{name}", errors.documentation_of(cls, name), "nothing")
        try:
            return cls(**values)
        except InputError as error:
            raise InputError(f"{field}.{error.field}", error.expected, error.got) from None

    @classmethod
    @errors.named_arguments
    def estimate(
        cls, *, mass: Quantity, arm: Quantity, propeller: Quantity, rod_length: Quantity, rod_mass: Quantity = 0.0,
        bob_mass: Quantity = 0.0, motor: str | None = None, battery: Quantity | None = None,
        thrust: Quantity | None = None, inertia: ArrayLike | None = None, rotors: int = 4,
        mount: MountKind = "gimbal", name: str = "mine",
    ) -> Self:  # fmt: skip
        """Return a vehicle from what a person can measure, the rest by scaling laws, with a band for each number.

        Each quantity is a number in SI or text with a unit: "620 g", "17 cm", "1.2 kgf". `flypend vehicle new` writes
        the same as TOML, with the source of each guess.

        Parameters
        ----------
        mass, arm : float or str
            Mass without the rod, kg; distance from the centre to a rotor, m.
        propeller : float or str
            Diameter, m; inches as "10x4.5" or "1045"; or a name of `flypend.model.estimate.parts`.
        rod_length, rod_mass, bob_mass : float or str
            Length of a uniform rod from the pivot to its end, m; its mass, and that of a bob at its end, kg.
        motor, battery : str, optional
            "920 KV" or the name of a known motor; "4S" or volts. Give both, or neither.
        thrust : float or str, optional
            Largest force of one rotor, N, if it was measured.
        inertia : (3,), optional
            Principal moments, kg m², if they are known.
        rotors : int
            How many, at equal angles.
        mount, name
            As in `Vehicle`.

        Raises
        ------
        InputError
            If a number is implausible (the message names the unit that was probably meant), or the rotors are too weak
            to hover.
        """
        found = Measured(
            mass, arm, propeller, rod_length, rod_mass, bob_mass, motor, battery, thrust, inertia, rotors, mount, name
        )
        return cls(**guess(found).fields)

    @classmethod
    def from_toml(cls, path: str | Path) -> Self:
        """Load a vehicle from the TOML file at `path`, as `flypend.vehicle` does. Raises InputError."""
        return cls.from_dict(on_base(read_toml(path), Path(path).parent, (Path(path).resolve(),)))


_FIELDS = tuple(field.name for field in fields(Vehicle))
# Fields that are one number, with bounds and units.
_NUMBERS: dict[str, dict[str, Any]] = {
    "mass": {"above": 0, "unit": "kg"}, "bob_mass": {"above": 0, "unit": "kg"}, "rod_length": {"above": 0, "unit": "m"},
    "drag_ratio": {"above": 0, "unit": "m"}, "rod_inertia": {"at_least": 0, "unit": "kg m²"},
    "gravity": {"at_least": 0, "unit": "m/s²"}, "pivot_damping": {"at_least": 0, "unit": "N m s"},
    "pivot_friction": {"at_least": 0, "unit": "N m"}, "rod_spin": {"unit": "rad/s"},
    "rod_spin_inertia": {"at_least": 0, "unit": "kg m²"}, "rotor_lag": {"at_least": 0, "unit": "s"},
    "thrust_scale": {"at_least": 0.05, "at_most": 20},
}  # fmt: skip


def _required(kind: type[Any]) -> list[str]:
    """Return the names of fields of a record that have no default."""
    return [entry.name for entry in fields(kind) if entry.default is MISSING]


def _record(kind: type[Any], field: str, value: Any, called: str) -> Any:
    """Return `value`, a record of this `kind`, its fields as a dict, or None. Raises InputError if it is none of them.

    In messages the record is `called` so.
    """
    if value is None or isinstance(value, kind):
        return value
    if not isinstance(value, Mapping):
        raise InputError(field, f"{called}, or its fields as a dict", repr(value))
    errors.only_known(field, value, [entry.name for entry in fields(kind)])
    for name in (needed := _required(kind)):
        if name not in value:
            raise InputError(f"{field}.{name}", f"{', '.join(needed)}, lengths in m", f"no {name}")
    return kind(**value)


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Mapping):
        return {name: [list(end) if isinstance(end, tuple) else end for end in ends] for name, ends in value.items()}
    return value.to_dict() if isinstance(value, Body | Air) else value


def _inertia(value: Any) -> Any:
    matrix = np.array(value, dtype=object)
    matrix = (
        np.diag(errors.array("inertia", value, (3,))) if matrix.ndim == 1 else errors.array("inertia", value, (3, 3))
    )
    if not np.allclose(matrix, matrix.T, rtol=0, atol=1e-12 * np.abs(matrix).max()):
        raise InputError("inertia", "a symmetric matrix", matrix.tolist())
    a, b, c = np.linalg.eigvalsh(matrix)
    if a <= 0:
        raise InputError("inertia", "a positive definite matrix", f"a principal moment of {a:.4g} kg m²")
    if a + b < c * (1 - 1e-9):
        raise InputError("inertia", "principal moments within the triangle inequality", f"{a:.4g} + {b:.4g} < {c:.4g}")
    return matrix
