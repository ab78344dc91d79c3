"""Sensitivity of a flight's final state to start and gains: exact derivatives, from the variational equations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors, signals
from flypend.building import built
from flypend.compile.llvm import jit
from flypend.compile.problem import Problem
from flypend.compile.program import lower
from flypend.errors import InputError
from flypend.flight.kernels.ideal import Moments, call, compile_ideal
from flypend.flight.kernels.results import Flown, inputs_of
from flypend.flight.kernels.stopping import heard
from flypend.flight.labels import dataset, describe, state_variables, variable
from flypend.flight.outcome import Outcome
from flypend.flight.request import Flight, Tolerances
from flypend.flight.simulate import simulate
from flypend.laws import BoundLaw, Law
from flypend.laws.closed_loop import symbolic_loop
from flypend.laws.linearise import COORDINATES, tangent_basis
from flypend.model import State, Vehicle
from flypend.model.state import SIZE, E3Direction, project, project_symbolic
from flypend.plants import Ideal
from flypend.plants.loop import Loop

if TYPE_CHECKING:
    import xarray

# Of the difference quotient: its square is far below, and the integrator's error over it still below, a thousandth.
STEP = 1e-5


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Sensitivity:
    """Derivatives of the final state of a flight.

    Parameters
    ----------
    final : State
        Final state, in the law's frame.
    by_start : (24, 16)
        Derivatives of the packed final state with respect to the start's coordinates, `laws.linearise.COORDINATES`.
    by_gains : (24, k)
        Derivatives of the packed final state with respect to the gains.
    outcome : Outcome
        completed, diverged or singular, with its time; unless completed, all derivatives are NaN. A derivative that
        grows beyond a million counts as diverged.
    discrepancy : float
        How far a difference quotient of two flights, in a fixed direction of start and gains, is from what the
        derivatives say, over the largest entry of the latter. Where the moment jumps during the flight, as that of
        `laws.inverted` does where its tilt limit sets in, the derivatives miss what the jump adds, and it is not small.
    e3 : "up" or "down"
        Direction of the frame's third axis.
    vehicle : Vehicle
        Vehicle parameters.
    law : str
        Name of the law.
    gains : dict
        The gains of the derivatives, with their values, in the order of `by_gains`.
    """

    final: State
    by_start: NDArray[np.float64]
    by_gains: NDArray[np.float64]
    outcome: Outcome
    discrepancy: float
    e3: E3Direction
    vehicle: Vehicle
    law: str
    gains: Mapping[str, float]

    @property
    def on_manifold(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """`by_start` and `by_gains` in coordinates of the final state: (16, 16) and (16, k)."""
        coordinates = np.linalg.pinv(tangent_basis(self.final))
        return coordinates @ self.by_start, coordinates @ self.by_gains

    def to_xarray(self) -> xarray.Dataset:
        """Return an `xarray.Dataset`: by_start on final and start coordinates, by_gains on final ones and gains."""
        onto, by_gains = self.on_manifold
        ends, starts, names = ("coordinate",), ("start",), ("gain",)
        variables = {
            "coordinate": variable("coordinate", ends, COORDINATES),
            "start": variable("start", starts, COORDINATES),
            "by_start": variable("by_start", ends + starts, onto),
            **state_variables(self.final, (), "final_"),
        }
        if self.gains:
            variables["gain"] = variable("gain", names, list(self.gains))
            variables["by_gains"] = variable("by_gains", ends + names, by_gains)
        return dataset(
            variables,
            describe(self.vehicle, self.law, self.gains, self.e3)
            | vars(self.outcome)
            | {"discrepancy": self.discrepancy},
        )


@errors.named_arguments
@signals.defer()
def sensitivity(
    vehicle: Vehicle,
    law: Law | BoundLaw,
    start: State,
    duration: float,
    *,
    gains: Sequence[str] = (),
    rtol: float = 1e-9,
) -> Sensitivity:
    """Fly `vehicle` under `law` in the ideal plant and differentiate its final state with respect to start and gains.

    Parameters
    ----------
    vehicle, law, duration, rtol
        As in `simulate`; the tolerance applies to the derivatives, too.
    start : State
        A single state, in the law's frame.
    gains : sequence of str
        Names of the gains to differentiate with respect to.

    Raises
    ------
    InputError
        If the law is not symbolic, the start is a batch, the law lacks a gain, or the rod touches the vehicle.
    """
    if not isinstance(law, Law | BoundLaw):
        raise InputError("law", "a Law, which is written in symbols", type(law).__name__)
    if not isinstance(start, State) or start.batch_shape:
        raise InputError("start", "a single State", repr(start)[:80])
    flight = Flight(
        vehicle=vehicle,
        law=law.bind(vehicle),
        starts=start,
        duration=duration,
        plant=Ideal(),
        tolerances=Tolerances(rtol=rtol),
    )
    if isinstance(gains, str):
        raise InputError("gains", "a sequence of names", repr(gains))
    bound, names = flight.loop.symbolic, tuple(gains)
    errors.only_known("gains", dict.fromkeys(names), bound.numbers)
    along = np.random.default_rng(0).normal(size=len(COORDINATES) + len(names))
    flown = _fly_tangents(flight, names, along)
    first = int(np.argmax(flown.status != "completed"))  # of those that failed, or of all
    completed = flown.status[first] == "completed"
    if flight.loop.touches and (end := simulate(vehicle, law, start, duration, plant="ideal").outcome).reason:
        raise InputError("start", "one from which nothing touches, which has no derivative", str(end))
    derivatives = flown.final[:-2, SIZE:].T if completed else np.full((SIZE, len(flown) - 2), np.nan)
    quotient, told = (flown.final[-2, :SIZE] - flown.final[-1, :SIZE]) / (2 * STEP), derivatives @ along
    return Sensitivity(
        final=State.from_packed(project(flown.final[0, :SIZE])[0]),
        by_start=derivatives[:, : len(COORDINATES)],
        by_gains=derivatives[:, len(COORDINATES) :],
        outcome=Outcome(flown.status[first].item(), float(flown.end[first])),
        discrepancy=float(np.max(np.abs(quotient - told)) / np.max(np.abs(told))),
        e3=bound.e3,
        vehicle=vehicle,
        law=bound.name,
        gains={name: bound.numbers[name] for name in names},
    )


def _fly_tangents(flight: Flight, gains: tuple[str, ...], along: NDArray[np.float64]) -> Flown:
    """Fly the single start of `flight` along each coordinate and gain; final states (n, 48) hold state and derivative.

    The last two start `STEP` before and behind it in the direction `along`, without derivatives.

    Each run propagates one direction, v of the state and q of the gains: ṡ = F(t, s, p), v̇ = F_s v + F_p q, by forward
    derivatives of the same program.
    """
    coordinates, k = len(COORDINATES), len(gains)
    loop, runs = replace(flight.loop, parameters=gains), coordinates + k + 2
    starts, parameters = np.zeros((runs, 2 * SIZE)), np.zeros((runs, 2 * k))
    starts[:, :SIZE], starts[:coordinates, SIZE:] = flight.starts.packed(), tangent_basis(flight.starts).T
    parameters[:, :k], parameters[coordinates:-2, k:] = inputs_of(loop, None, runs), np.eye(k)
    steps = np.outer((STEP, -STEP), along)
    starts[-2:, :SIZE] = project(starts[-2:, :SIZE] + steps[:, :coordinates] @ starts[:coordinates, SIZE:])[0]
    parameters[-2:, :k] += steps[:, coordinates:]
    out = Flown.of_size(runs, 2 * SIZE)
    given = _kernel(loop), starts, parameters, flight.duration, flight.tolerances, Moments.of(), out
    heard([lambda stop: call(*given, stop)])
    return out


@built(maxsize=16)
def _kernel(closed: Loop) -> jit.Native:
    """Return the kernel of the `closed` loop on (state, direction) (48,) and (parameters, their direction) (2 k,)."""
    law, k = closed.symbolic, len(closed.parameters)
    loop = symbolic_loop(closed.vehicle, law, closed.parameters)
    both, parameters = ca.SX.sym("sv", 2 * SIZE), ca.SX.sym("pq", 2 * k)
    along = ca.jtimes(loop.rates, loop.s, both[SIZE:])
    if k:
        along += ca.jtimes(loop.rates, loop.p, parameters[k:])
    old, new = [loop.s, loop.p], [both[:SIZE], parameters[:k]]
    inputs = [loop.t, both, parameters]
    rates = ca.cse(ca.substitute([ca.densify(ca.vertcat(loop.rates, along))], old, new))
    margin = None
    if law.guard is not None:
        signal = loop.signals[law.guard.signal] - law.guard.threshold
        margin = lower(ca.Function("margin", inputs, ca.substitute([ca.densify(signal)], old, new)))
    # The state is projected onto the manifold; for the derivative this would change less than a step's error.
    onto = ca.vertcat(project_symbolic(both[:SIZE]), both[SIZE:])
    projection = ca.Function("project", [both], [ca.densify(onto), ca.DM.zeros(3)])
    problem = Problem(rates=lower(ca.Function("rates", inputs, rates)), project=lower(projection), margin=margin)
    return compile_ideal(problem, "dop853")
