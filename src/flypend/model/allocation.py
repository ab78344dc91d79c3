"""From a wrench to rotor forces within limits: roll and pitch before thrust before yaw."""

from __future__ import annotations

from functools import reduce
from typing import Any

import casadi as ca
import numpy as np


def allocate(thrust: Any, moment: Any, vehicle: Any) -> Any:
    """Rotor forces (n,) for a wrench in the frame with e₃ up, as a CasADi expression, each within the rotor limits.

    Unmixing gives f_i = r_i + T/n ± q, with r_i what roll and pitch ask for, T the thrust and q what yaw asks for, + on
    the rotors of one spin and − on those of the other. With a = T/n + q and b = T/n − q the limits say that a and b
    lie each in an interval of its own. So, in this order: the r_i of each spin are scaled until their interval is not
    empty, the mean of a and b (thrust) is brought into reach, and their difference (yaw) into what is left.

    Parameters
    ----------
    thrust : SX
        Wanted thrust, N.
    moment : SX (3, 1)
        Wanted moment, body frame, N m.
    vehicle : Vehicle
        Gives mixing and limits; its numbers may be symbols.

    Raises
    ------
    InputError
        For a vehicle whose rotors do not share thrust equally and yaw in two equal groups.
    """
    tilting, yawing, spins = vehicle.sharing()
    n = len(spins)
    low, high = vehicle.rotor_limits[0], vehicle.rotor_limits[1]
    asked = ca.mtimes(tilting, moment[:2])
    scaled: dict[int, Any] = {}
    reach: dict[int, tuple[Any, Any]] = {}
    for spin in (1, -1):
        members = [int(i) for i in np.flatnonzero(spins == spin)]
        most = reduce(ca.fmax, [asked[i] for i in members])
        least = reduce(ca.fmin, [asked[i] for i in members])
        factor = ca.fmin(1, (high - low) / ca.fmax(most - least, 1e-9 * high))
        scaled |= {i: factor * asked[i] for i in members}
        reach[spin] = (low - factor * least, high - factor * most)
    (a_low, a_high), (b_low, b_high) = reach[1], reach[-1]
    mean = _clip(thrust / n, (a_low + b_low) / 2, (a_high + b_high) / 2)
    q = _clip(yawing * moment[2], ca.fmax(a_low - mean, mean - b_high), ca.fmin(a_high - mean, mean - b_low))
    forces = ca.vertcat(*(scaled[i] + mean + spins[i] * q for i in range(n)))
    return _clip(forces, low, high)  # roundoff


def _clip(value: Any, low: Any, high: Any) -> Any:
    return ca.fmin(ca.fmax(value, low), high)
