"""Control allocation within rotor limits, in order of priority: roll and pitch, thrust, yaw."""

from __future__ import annotations

from functools import reduce
from typing import Any

import casadi as ca
import numpy as np

from flypend.geometry import Numbers, Scalar, Vector, clip
from flypend.model import Vehicle


def allocate(thrust: Scalar, moment: Vector, vehicle: Vehicle) -> Numbers:
    """Allocate a wrench in the e₃-up frame to rotor forces (n,) within their limits, as a CasADi expression.

    Unmixing yields f_i = r_i + T/n ± q, where r_i is the share of roll and pitch, T the thrust and q the share of yaw,
    with + on rotors of one spin direction and − on the others. Let a = T/n + q and b = T/n − q. The rotor limits
    confine a to one interval and b to another. The steps, in order of priority:

    1. Scale the r_i of each spin direction until its interval is not empty (roll and pitch).
    2. Clip the mean of a and b to its feasible range (thrust).
    3. Clip their difference to the range that remains (yaw).

    Parameters
    ----------
    thrust : SX
        Desired thrust, N.
    moment : SX (3, 1)
        Desired moment, body frame, N m.
    vehicle : Vehicle
        Source of the mixing matrix and rotor limits; its parameters may be symbolic.

    Raises
    ------
    InputError
        If the rotors do not share thrust equally, or yaw as two groups of equal magnitude.
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
    mean = clip(thrust / n, (a_low + b_low) / 2, (a_high + b_high) / 2)
    q = clip(yawing * moment[2], ca.fmax(a_low - mean, mean - b_high), ca.fmin(a_high - mean, mean - b_low))
    forces = ca.vertcat(*(scaled[i] + mean + spins[i] * q for i in range(n)))
    return clip(forces, low, high)  # guards against roundoff
