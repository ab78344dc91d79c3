"""A machine's numbers from a flight log: those for which the prediction errors of a Kalman filter are most likely.

The model is that of the sampled plants. Gusts, noisy feedback and unequal rotors are part of it; bands come from the
scores of segments of the log, which need no model of the noise to be right.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Literal

import numpy as np

from flypend import errors
from flypend.geometry import Vector
from flypend.identification.fit import fit
from flypend.identification.log import Log, read_log
from flypend.identification.result import Identified, conclude
from flypend.model import Vehicle

__all__ = ["Identified", "Log", "identify", "read_log"]

Command = Literal["newton", "pwm"]
MASS_ERROR = 0.005  # of a kitchen scale
MAST = 5  # times the distance of the farthest rotor, within which a machine carries its marker


@errors.named_arguments
def identify(
    log: str | Path, vehicle: Vehicle, *, marker: Vector = (0.0, 0.0, 0.0), command: Command = "newton",
    mass_error: float = MASS_ERROR, progress: Callable[[str, int, int], None] | None = None,
) -> Identified:  # fmt: skip
    """Find the numbers of a machine in a flight log with the rod hanging.

    An extended Kalman filter with the package's equations predicts the log. Fisher scoring finds the numbers for which
    its prediction errors are most likely (Åström, "Maximum likelihood and prediction error methods", 1980). Their
    covariance is the sandwich of the information and the scores of segments (White, 1982).

    Parameters
    ----------
    log : path
        A CSV file, PX4's ULog, a bag of ROS 2 in MCAP or a Crazyflie's µSD log; docs/how-to/identify.md has their
        columns and topics.
    vehicle : Vehicle
        The guess. Its mass counts as weighed; its rotor positions, spins, limits and gravity are taken as exact.
    marker : (3,)
        Position of the tracked point relative to the pivot, body frame, m.
    command : "newton" or "pwm"
        Whether u1, u2, … are forces, N, or fractions from 0 to 1 of the largest force.
    mass_error : float
        Relative error within which the mass is known.
    progress : callable, optional
        Called with ("pass", done, total).

    Raises
    ------
    InputError
        If the file is not such a log, its units or signs are others, it has another number of rotors than the vehicle,
        or its fractions exceed 1; or if the marker is not on the machine.
    """
    place = errors.array("marker", marker, (3,))
    reach = MAST * float(np.linalg.norm(vehicle.rotor_positions, axis=1).max())
    if np.linalg.norm(place) > reach:
        raise errors.InputError("marker", f"a place on the machine, within {reach:.2g} m", f"{place.tolist()}")
    pwm = errors.one_of("command", command, ("newton", "pwm")) == "pwm"
    errors.number("mass_error", mass_error, at_least=0, at_most=0.5)
    flown, n = read_log(log), len(vehicle.rotor_spins)
    if flown.command.shape[1] != n:
        raise errors.InputError(str(log), f"commands of {n} rotors, as the vehicle has", f"{flown.command.shape[1]}")
    if flown.fractions and not pwm:
        raise errors.InputError(str(log), "command='pwm', as such a log has fractions", "'newton'")
    if pwm and flown.command.max() > 1:
        raise errors.InputError(str(log), "fractions up to 1, as the command is pwm", f"{flown.command.max():g}")
    if not pwm and flown.command.max() > 2 * vehicle.rotor_limits[1]:
        limit = f"forces up to {vehicle.rotor_limits[1]:g} N, the vehicle's limit (or command='pwm')"
        raise errors.InputError(str(log), limit, f"{flown.command.max():g}")
    return conclude(fit(flown, vehicle, place, pwm, progress), vehicle, mass_error)
