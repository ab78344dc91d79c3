"""Whether a start lies in the domain of a law's theorem."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from flypend.errors import InputError
from flypend.laws.bound import BoundLaw
from flypend.laws.closed_loop import close_loop
from flypend.laws.guarantee import Guarantee
from flypend.model import State, Vehicle


def signals_at(law: BoundLaw, start: State) -> Mapping[str, float]:
    """Return the signals of `law` at time 0 at a single `start`, in the law's frame. Raises InputError for a batch.

    A law that takes the wrench that acts gets that of rotors at their minimum.
    """
    if start.batch_shape:
        raise InputError("start", "a single state", f"a batch of shape {start.batch_shape}")
    loop, packed = close_loop(law.vehicle, law, lag=law.uses_wrench), start.packed()
    if law.uses_wrench:
        packed = np.concatenate([packed, idle(law.vehicle)])
    with np.errstate(all="ignore"):
        values = np.array(loop.outputs(0.0, packed)).ravel()[4:]
    return dict(zip(loop.signal_names, values.tolist(), strict=True))


def idle(vehicle: Vehicle) -> NDArray[np.float64]:
    """Return the wrench (4,) of rotors at their minimum, e₃ up."""
    found: NDArray[np.float64] = vehicle.mixing() @ np.full(len(vehicle.rotor_spins), vehicle.rotor_limits[0])
    return found


def outside(law: BoundLaw, found: Mapping[str, float], sets: Mapping[str, str]) -> Guarantee | None:
    """Return the guarantee of a start on an exceptional set; None for one in the domain.

    `sets` maps the signal whose value −1 marks a set to its equation; `found` are the signals at the start.
    """
    assert law.guard is not None
    for signal, equation in sets.items():
        if not 1 + found[signal] > law.guard.threshold:
            return Guarantee(covered=False, reason=f"outside the domain: {equation}", V=math.inf)
    return None
