"""Air around a multirotor: drag of rotors and body, loss and gain of thrust with airspeed, and ground effect.

The rotor model is that of RotorPy (Folk, Paulos and Kumar, 2023), whose coefficients per rotor speed Ω become ones per
root of the force, since f = k Ω²: its k_d, k_z and k_h are `rotor_drag` √k, `inflow` √k and `lift`.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, Literal

import casadi as ca
import numpy as np

from flypend import errors
from flypend.geometry import Scalar, Vector, cross, differentiable_root, dot, is_symbolic
from flypend.model.state import State, centre_velocity

AirEffect = Literal["rotor_drag", "inflow", "lift", "body_drag"]
AIR: tuple[AirEffect, ...] = ("rotor_drag", "inflow", "lift", "body_drag")

# A rotor is taken to be no closer to the ground than this, in radii: Cheeseman and Bennett's gain, infinite at a
# quarter of a radius, ends at 4/3.
CLOSEST = 0.5


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Air:
    """Coefficients of the forces of still air on a moving vehicle.

    With v the airspeed of a rotor in the body frame and f its force,

        (−rotor_drag √f v₁, −rotor_drag √f v₂, −inflow √f v₃ + lift (v₁² + v₂²))

    acts on it beside f, and −|v| (body_drag ∘ v) on the centre of mass, with the airspeed v there.

    Parameters
    ----------
    rotor_drag : float
        Drag of one rotor in its plane; N^½ s/m.
    inflow : float
        Thrust that one rotor loses while it moves along its axis; N^½ s/m.
    lift : float
        Thrust that one rotor gains while it moves in its plane (translational lift); N s²/m².
    body_drag : (3,)
        Drag of the body along its axes; N s²/m².

    Raises
    ------
    InputError
        If a coefficient is negative or not finite.
    """

    rotor_drag: float = 0.0
    inflow: float = 0.0
    lift: float = 0.0
    body_drag: Any = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        for name in ("rotor_drag", "inflow", "lift"):
            object.__setattr__(self, name, errors.number(f"air.{name}", getattr(self, name), at_least=0))
        drag = errors.array("air.body_drag", self.body_drag, (3,))
        if np.any(drag < 0):
            raise errors.InputError("air.body_drag", "numbers >= 0", drag.tolist())
        object.__setattr__(self, "body_drag", tuple(drag.tolist()))

    def to_dict(self) -> dict[str, Any]:
        """Return the coefficients as numbers and a list, as in a vehicle TOML file."""
        values = {entry.name: getattr(self, entry.name) for entry in fields(self)}
        return values | {"body_drag": list(self.body_drag)}

    def active(self) -> tuple[AirEffect, ...]:
        """Return the effects whose coefficients are not zero."""
        return tuple(name for name in AIR if np.any(getattr(self, name)))


def air_wrench(
    state: State, forces: Any, vehicle: Any, effects: tuple[AirEffect, ...], ground: float | None = None
) -> tuple[Vector, Vector]:
    """Return the air's force (3,), N, and moment (3,), N m, about the centre of mass, both in the body frame.

    In CasADi, e₃ up. The thrusts themselves are not included, only what air adds to them.

    Parameters
    ----------
    state : State
        The state, of symbols.
    forces : SX (n, 1)
        Thrust of each rotor in still air, N.
    vehicle : Vehicle
        Source of the coefficients, `air`, and of the geometry; its pivot need not be the centre of mass.
    effects : tuple of str
        The effects that act, of `AIR`.
    ground : float, optional
        Height of the ground, m. Close to it a rotor of radius ρ at the height h gains, after Cheeseman and Bennett
        (1955), the share q/(1 − q) of its thrust, q = (ρ/4h)², times the cosine of the tilt up to 90°; none beyond.
    """
    coefficients = {name: getattr(vehicle.air, name) if name in effects else 0.0 for name in AIR}
    drag, inflow, lift = (coefficients[name] for name in ("rotor_drag", "inflow", "lift"))
    offset = vehicle.pivot_offset if is_symbolic(vehicle.pivot_offset) else ca.DM(vehicle.pivot_offset)
    velocity = ca.mtimes(state.R.T, centre_velocity(state, offset))
    force, moment = ca.SX(3, 1), ca.SX(3, 1)
    for k, place in enumerate(vehicle.rotor_positions):
        seen, f = velocity + cross(state.omega, ca.DM(place)), ca.fmax(forces[k], 0)
        root, level = differentiable_root(f), seen[0] ** 2 + seen[1] ** 2
        up = lift * level - inflow * root * seen[2]
        if ground is not None:
            height = (state.x + ca.mtimes(state.R, ca.DM(place) - offset))[2] - ground
            up = up + f * ground_gain(height, vehicle.body.disc_radius) * ca.fmax(state.z[2], 0)
        on_rotor = ca.vertcat(-drag * root * seen[0], -drag * root * seen[1], up)
        force, moment = force + on_rotor, moment + cross(ca.DM(place), on_rotor)
    if "body_drag" in effects:
        force = force - differentiable_root(dot(velocity, velocity)) * ca.DM(coefficients["body_drag"]) * velocity
    return force, moment


def ground_gain(height: Scalar, radius: float) -> Scalar:
    """Return the share of its thrust that a level rotor of `radius` (m) gains at a `height` (m), in CasADi."""
    q = (radius / (4 * ca.fmax(height, CLOSEST * radius))) ** 2
    return q / (1 - q)
