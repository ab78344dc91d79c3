"""How the end of a flight depends on its start and on gains: exact derivatives, from the tangent of the closed loop."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend import errors
from flypend.errors import InputError
from flypend.flight.kernels.tangent import fly_tangents
from flypend.flight.simulate import LEAST_RTOL
from flypend.laws import BoundLaw, Law
from flypend.laws.linearise import COORDINATES, tangent_basis
from flypend.model import State, Vehicle
from flypend.model.state import SIZE, project


@dataclass(frozen=True, kw_only=True, eq=False)
class Sensitivity:
    """Derivatives of the final state of a flight.

    Parameters
    ----------
    final : State
        Where the flight ends, in the frame of the law.
    by_start : (24, 16)
        Of the packed final state by the coordinates of the start: `laws.linearise.COORDINATES`.
    by_gains : (24, k)
        Of the packed final state by the gains.
    gains : tuple of str
        Which gains.
    status : str
        "completed", "diverged" or "singular"; unless completed, all derivatives are NaN. A derivative that grows
        beyond a million counts as diverged.
    """

    final: State
    by_start: Any
    by_gains: Any
    gains: tuple[str, ...]
    status: str

    @property
    def on_manifold(self) -> tuple[Any, Any]:
        """Both in coordinates of the final state: (16, 16) and (16, k)."""
        coordinates = np.linalg.pinv(tangent_basis(self.final))
        return coordinates @ self.by_start, coordinates @ self.by_gains


def sensitivity(
    vehicle: Vehicle,
    law: Law | BoundLaw,
    start: State,
    duration: float,
    *,
    gains: Sequence[str] = (),
    rtol: float = 1e-9,
) -> Sensitivity:
    """Fly `vehicle` under `law` in the ideal plant, and differentiate where it ends by its start and by gains.

    Parameters
    ----------
    vehicle, law, duration, rtol
        As in `simulate`; the tolerance is that of the derivatives, too.
    start : State
        A single state, in the frame of the law.
    gains : sequence of str
        Names of gains of the law to differentiate by.

    Raises
    ------
    InputError
        For a law that is not symbolic, a start that is a batch, and gains that the law lacks.
    """
    if not isinstance(law, Law | BoundLaw):
        raise InputError("law", "a Law, which is written in symbols", type(law).__name__)
    if not isinstance(start, State) or start.batch_shape:
        raise InputError("start", "a single State", repr(start)[:80])
    duration = errors.number("duration", duration, above=0, unit="s")
    rtol = errors.number("rtol", rtol, at_least=LEAST_RTOL)
    bound, names = law.bind(vehicle), tuple(gains)
    errors.only_known("gains", dict.fromkeys(names), bound.numbers)
    runs, k = len(COORDINATES) + len(names), len(names)
    directions, rates = np.zeros((runs, SIZE)), np.zeros((runs, k))
    directions[: len(COORDINATES)] = tangent_basis(start).T
    rates[len(COORDINATES) :] = np.eye(k)
    values = np.tile([bound.numbers[name] for name in names], (runs, 1))
    starts = np.tile(start.packed(), (runs, 1))
    flown = fly_tangents(vehicle, bound, names, starts, directions, values, rates, duration, rtol)
    failed = flown.status[flown.status != "completed"]
    derivatives = flown.final[:, SIZE:].T if not len(failed) else np.full((SIZE, runs), np.nan)
    return Sensitivity(
        final=State.from_packed(project(flown.final[0, :SIZE])[0]),
        by_start=derivatives[:, : len(COORDINATES)],
        by_gains=derivatives[:, len(COORDINATES) :],
        gains=names,
        status=str(failed[0]) if len(failed) else "completed",
    )
