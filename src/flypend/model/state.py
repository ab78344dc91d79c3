"""State on R³ × SO(3) × S² and wrench, as NumPy arrays (with leading batch axes) or CasADi expressions."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any, Literal, Self

import casadi as ca
import numpy as np

from flypend import errors, geometry
from flypend.geometry import Matrix, Numbers, Scalar, Vector

E3Direction = Literal["up", "down"]

# Rotation by π about e₁, which converts between the e₃-up and e₃-down frames.
FLIP = np.diag([1.0, -1.0, -1.0])

# Input rounded to four decimals (0.7071 for 1/√2) is accepted and projected; a larger error is rejected.
MANIFOLD_TOLERANCE = 1e-4

SHAPES: dict[str, tuple[int, ...]] = {
    "x": (3,), "x_dot": (3,), "R": (3, 3), "omega": (3,), "y": (3,), "y_dot": (3,)
}  # fmt: skip
SIZE = 24
# Beyond this magnitude (m, m/s, rad/s) the state is unphysical and the run has diverged.
MAX_STATE = 1e6
# FLIP on a packed state: x, x_dot, R (from both sides), omega, y, y_dot each change sign componentwise.
FLIP_PACKED = np.concatenate(
    [np.tile(np.diag(FLIP), 2), np.outer(np.diag(FLIP), np.diag(FLIP)).ravel(), np.tile(np.diag(FLIP), 3)]
)


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class State:
    """State of vehicle and pendulum. All fields may have the same leading batch axes.

    Parameters
    ----------
    x, x_dot : (..., 3)
        Position (m) and velocity (m/s) of the pivot, world frame. Default 0.
    R : (..., 3, 3)
        Rotation from body to world. Default the identity.
    omega : (..., 3)
        Angular velocity in the body frame, rad/s. Default 0.
    y, y_dot : (..., 3)
        Unit vector from the pivot to the bob and its rate (1/s), world frame; y_dot is tangent: y · y_dot = 0.
        y_dot defaults to 0.

    R, y and y_dot within 1e-4 of the manifold (such as rounded numbers from a paper) are projected onto it. If a field
    is a CasADi expression, all become expressions, and nothing is projected.

    Raises
    ------
    InputError
        If a shape is wrong, a number is not finite, R is not a rotation, y is not a unit vector, or y_dot is not
        tangent.
    """

    x: Vector = (0.0, 0.0, 0.0)
    x_dot: Vector = (0.0, 0.0, 0.0)
    R: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    omega: Vector = (0.0, 0.0, 0.0)
    y: Vector
    y_dot: Vector = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        if any(_has_symbols(getattr(self, name)) for name in SHAPES):
            for name, shape in SHAPES.items():
                object.__setattr__(self, name, _expression(name, getattr(self, name), shape))
            return
        values = {name: errors.array(name, getattr(self, name), shape, batch=True) for name, shape in SHAPES.items()}
        batch = _batch_shape(values)
        _check_manifold(values)
        values["R"] = geometry.project_rotation(values["R"])
        values["y"] = geometry.unit(values["y"])
        values["y_dot"] = geometry.project_tangent(values["y"], values["y_dot"])
        for name, shape in SHAPES.items():
            frozen = np.array(np.broadcast_to(values[name], batch + shape))
            frozen.setflags(write=False)
            object.__setattr__(self, name, frozen)

    @property
    def z(self) -> Vector:
        """Thrust axis z = R e₃, world frame."""
        return self.R[:, 2] if geometry.is_symbolic(self.R) else self.R[..., :, 2]

    @property
    def batch_shape(self) -> tuple[int, ...]:
        """Shape of the batch axes; () for a single state."""
        return tuple(self.y.shape[:-1])

    def packed(self) -> Numbers:
        """Return the state as one vector (..., 24): x, x_dot, R in row-major order, omega, y, y_dot."""
        if geometry.is_symbolic(self.y):
            return ca.vertcat(self.x, self.x_dot, ca.vec(self.R.T), self.omega, self.y, self.y_dot)
        rows = self.R.reshape((*self.batch_shape, 9))
        return np.concatenate([self.x, self.x_dot, rows, self.omega, self.y, self.y_dot], axis=-1)

    @classmethod
    def symbolic(cls, packed: Numbers) -> Self:
        """Build a state whose fields are slices of the CasADi vector `packed` (24, 1), without checks."""
        return cls(
            x=packed[0:3], x_dot=packed[3:6], R=ca.reshape(packed[6:15], 3, 3).T, omega=packed[15:18],
            y=packed[18:21], y_dot=packed[21:24],
        )  # fmt: skip

    @classmethod
    def from_packed(cls, packed: Numbers) -> Self:
        """Build states from vectors (..., 24) in the order of `packed`. Raises InputError like the constructor."""
        return cls(**split(errors.array("packed state", packed, (SIZE,), batch=True)))

    @classmethod
    def trusted(cls, packed: Numbers) -> Self:
        """Build states from `packed` vectors (..., 24) unchecked: integrator output, NaN after the end of a run."""
        return cls._unchecked(split(packed))

    @classmethod
    def _unchecked(cls, values: dict[str, Any]) -> Self:
        made = object.__new__(cls)
        for name in SHAPES:
            part = np.array(values[name])
            part.setflags(write=False)
            object.__setattr__(made, name, part)
        return made

    def flipped(self) -> State:
        """Return the same physical state in the frame rotated by π about e₁ (e₃ up to e₃ down, or back)."""
        vectors = {name: geometry.apply(FLIP, getattr(self, name)) for name in SHAPES if name != "R"}
        return State(**vectors, R=FLIP @ self.R @ FLIP)

    def in_frame(self, e3: E3Direction) -> State:
        """The state, given with e₃ up, in the frame of `e3`; or given in that frame, with e₃ up."""
        return self if e3 == "up" else self.flipped()

    def __getitem__(self, index: Any) -> State:
        """Select members of a batch; `index` applies to the batch axes."""
        if not self.batch_shape:
            raise IndexError("a single state has no members; only a batch of states can be indexed")
        # Members are on the manifold already. Projecting again would change the last bits.
        return type(self)._unchecked({name: getattr(self, name)[index] for name in SHAPES})

    def __len__(self) -> int:
        """Length of the first batch axis."""
        if not self.batch_shape:
            raise TypeError("a single state has no length")
        return self.batch_shape[0]

    @classmethod
    def random(
        cls,
        rng: np.random.Generator,
        size: tuple[int, ...] | int = (),
        *,
        max_omega: float = 3.0,
        max_y_dot: float = 3.0,
        max_x_dot: float = 2.0,
    ) -> Self:
        """Random states at x = 0: y uniform on S², R uniform on SO(3), rates uniform in a disc or ball.

        Parameters
        ----------
        rng : numpy.random.Generator
            Random number generator; equal generator states yield equal states.
        size : int or tuple of int
            Batch shape.
        max_omega, max_y_dot, max_x_dot : float
            Radii of the ball of omega (rad/s), the tangent disc of y_dot (1/s) and the ball of x_dot (m/s).
        """
        shape = tuple(size) if isinstance(size, tuple) else (int(size),)
        y = geometry.random_sphere(rng, shape)
        return cls(
            x=np.zeros((*shape, 3)),
            x_dot=_in_ball(rng, shape, max_x_dot),
            R=geometry.random_rotation(rng, shape),
            omega=_in_ball(rng, shape, max_omega),
            y=y,
            y_dot=geometry.random_tangent(rng, y, max_y_dot),
        )


def split(packed: Numbers) -> dict[str, Any]:
    """Split packed states (..., 24) into a dict of arrays with the shapes of the fields of `State`, unchecked."""
    packed = np.asarray(packed)
    out, start = {}, 0
    for name, shape in SHAPES.items():
        width = math.prod(shape)
        out[name] = packed[..., start : start + width].reshape((*packed.shape[:-1], *shape))
        start += width
    return out


def project(packed: Numbers) -> tuple[Numbers, Numbers]:
    """Project packed states (..., 24) onto the manifold.

    Returns the projected vectors and the drift (..., 3) before projection: | |y| − 1 |, |y · y_dot| and ‖RᵀR − 1‖.
    """
    value = split(packed)
    length, normal = geometry.norm(value["y"]), geometry.dot(value["y"], value["y_dot"])
    drift = np.stack([np.abs(length - 1), np.abs(normal), geometry.rotation_defect(value["R"])], axis=-1)
    out = np.array(packed, dtype=float)
    y = geometry.unit(value["y"])
    out[..., 6:15] = geometry.project_rotation(value["R"]).reshape((*out.shape[:-1], 9))
    out[..., 18:21] = y
    out[..., 21:24] = geometry.project_tangent(y, value["y_dot"])
    return out, drift


@errors.named_arguments
@dataclass(frozen=True, eq=False)
class Wrench:
    """Wrench of the rotors: `thrust` (N) along z = R e₃ and `moment` (..., 3) in the body frame (N m).

    In the e₃-up frame, thrust ≥ 0. In the paper's e₃-down frame, the thrust that carries the vehicle is negative.

    Parameters
    ----------
    thrust : float, (...,) or expression
        Thrust along z, N.
    moment : (..., 3) or expression (3, 1)
        Moment, body frame, N m.

    Raises
    ------
    InputError
        If the thrust is not one number and the moment not three, in numbers or in CasADi expressions.
    """

    thrust: Scalar
    moment: Vector

    def __post_init__(self) -> None:
        thrust, moment = _part("wrench.thrust", self.thrust), _part("wrench.moment", self.moment)
        shape = tuple(moment.shape)
        if shape != (3, 1) and shape[-1:] != (3,):
            raise errors.InputError("wrench.moment", "three numbers, N m", f"shape {shape}")
        batch = () if shape == (3, 1) else shape[:-1]
        if math.prod(thrust.shape) != 1 and thrust.shape != batch:
            raise errors.InputError("wrench.thrust", "one number, N", f"shape {tuple(thrust.shape)}")
        if isinstance(self.moment, list | tuple):
            object.__setattr__(self, "moment", moment)

    def flipped(self) -> Wrench:
        """Return the same wrench in the frame rotated by π about e₁."""
        return Wrench(-self.thrust, geometry.apply(FLIP, self.moment))

    def in_frame(self, e3: E3Direction) -> Wrench:
        """The wrench, given with e₃ up, in the frame of `e3`; or given in that frame, with e₃ up."""
        return self if e3 == "up" else self.flipped()


def _has_symbols(value: Any) -> bool:
    """Whether `value` is an expression, or a list of some."""
    return geometry.is_symbolic(value) or (isinstance(value, list | tuple) and any(map(geometry.is_symbolic, value)))


def _expression(field: str, value: Any, shape: tuple[int, ...]) -> Any:
    """Return a field of a state as an expression; numbers must have this `shape`, and become a DM."""
    if _has_symbols(value):
        return _part(field, value)
    return ca.DM(errors.array(field, value, shape))


def _part(field: str, value: Any) -> Any:
    """Return `value` as an array or an expression. Raises InputError unless it consists of numbers."""
    if _has_symbols(value):
        return value if geometry.is_symbolic(value) else ca.vertcat(*value)
    found = np.asarray(value)
    if found.dtype.kind in "iuf" or (found.dtype == object and all(map(geometry.is_symbolic, found.ravel()))):
        return found
    raise errors.InputError(field, "real numbers, or CasADi expressions", repr(value)[:80])


def centre_velocity(state: State, pivot_offset: Vector) -> Vector:
    """Velocity of the centre of mass c = x − R o of the vehicle, world frame, m/s; o is in the body frame, m."""
    return state.x_dot - geometry.apply(state.R, geometry.cross(state.omega, pivot_offset))


def convert_packed(packed: Numbers, e3: E3Direction) -> Numbers:
    """As `State.in_frame` for packed states (..., 24), or (24, 1) in CasADi, `e3` being "up" or "down"."""
    return packed if e3 == "up" else packed * FLIP_PACKED


def _batch_shape(values: dict[str, Any]) -> tuple[int, ...]:
    shapes = {name: value.shape[: value.ndim - len(SHAPES[name])] for name, value in values.items()}
    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError:
        raise errors.InputError("state", "fields with the same batch axes", shapes) from None


def _check_manifold(values: dict[str, Any]) -> None:
    defect = np.max(geometry.rotation_defect(values["R"]), initial=0.0)
    if defect > 3 * MANIFOLD_TOLERANCE:  # nine entries, each rounded to the fourth decimal: at most 3e-4
        mirrored = np.any(np.linalg.det(values["R"]) < 0)
        got = "determinant < 0" if mirrored else f"‖RᵀR − 1‖ = {defect:.3g}"
        raise errors.InputError("R", "a rotation (RᵀR = 1, det R = 1)", got)
    length = geometry.norm(values["y"])
    if np.any(np.abs(length - 1) > MANIFOLD_TOLERANCE):
        worst = np.ravel(length)[np.argmax(np.abs(np.ravel(length) - 1))]
        raise errors.InputError("y", "a unit vector", f"|y| = {worst:.6g}")
    normal = np.abs(geometry.dot(values["y"], values["y_dot"]))
    if np.any(normal > MANIFOLD_TOLERANCE * (1 + geometry.norm(values["y_dot"]))):
        raise errors.InputError("y_dot", "a tangent vector (y · y_dot = 0)", f"y · y_dot = {np.max(normal):.3g}")


def _in_ball(rng: np.random.Generator, shape: tuple[int, ...], radius: float) -> Any:
    return geometry.scale(radius * np.cbrt(rng.random(shape)), geometry.random_sphere(rng, shape))


assert tuple(field.name for field in fields(State)) == tuple(SHAPES)


def project_symbolic(packed: Numbers) -> Numbers:
    """Project a packed CasADi state (24, 1), close to the manifold, onto it; R by one `geometry.polar_step`."""
    s = State.symbolic(packed)
    y = geometry.unit(s.y)
    y_dot = geometry.tangent_part(y, s.y_dot)
    return State(x=s.x, x_dot=s.x_dot, R=geometry.polar_step(s.R), omega=s.omega, y=y, y_dot=y_dot).packed()
