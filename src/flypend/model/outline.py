"""How far a machine extends in the world: the boxes that hold its hub, its rod and its rotor discs."""

from __future__ import annotations

import casadi as ca
import numpy as np

from flypend.geometry import Numbers, Vector, apply, is_symbolic
from flypend.model.state import State
from flypend.model.vehicle import Vehicle


def outline(state: State, vehicle: Vehicle) -> tuple[Numbers, Numbers]:
    """Return the lowest and the highest corner of the box about each of `outline_parts`, both (..., k, 3), m.

    The hub is a ball about the pivot, the rod ends in a ball of its own radius, and the rotor discs are flat. Without a
    `body` all of them are points. `state` is a NumPy batch or a CasADi expression, for which a result is (k, 3); in
    either frame, whose axes those of the boxes are.
    """
    body, symbolic = vehicle.body, is_symbolic(state.y)
    hub, rod, disc = (0.0, 0.0, 0.0) if body is None else (body.hub_radius, body.rod_radius, body.disc_radius)
    z = state.z
    # A flat disc reaches as far along an axis as its radius times the sine of the angle between that and its normal.
    wide = disc * (ca.sqrt(ca.fmax(1 - z**2, 0)) if symbolic else np.sqrt(np.maximum(1 - z**2, 0)))
    parts = [(state.x, hub), (state.x + vehicle.reach * state.y, rod)]
    parts += [(state.x + apply(state.R, centre), wide) for centre in vehicle.rotors_from_pivot]
    corners = [point - half for point, half in parts], [point + half for point, half in parts]
    low, high = (ca.horzcat(*rows).T if symbolic else np.stack(rows, axis=-2) for rows in corners)
    return low, high


def outline_parts(vehicle: Vehicle) -> list[str]:
    """Return the names of the parts of `outline`."""
    return ["hub", "rod", *(f"rotor {i}" for i in range(1, 1 + len(vehicle.rotor_spins)))]


def extent(state: State, vehicle: Vehicle) -> tuple[Vector, Vector]:
    """Return the lowest and the highest corner of the box about the whole machine, both (..., 3), m; see `outline`."""
    low, high = outline(state, vehicle)
    if not is_symbolic(low):
        return low.min(axis=-2), high.max(axis=-2)
    return ca.vertcat(*map(ca.mmin, ca.horzsplit(low))), ca.vertcat(*map(ca.mmax, ca.horzsplit(high)))
