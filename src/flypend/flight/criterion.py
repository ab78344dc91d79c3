"""The success criterion: one formula for trajectories and kernels."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Literal

import casadi as ca
import numpy as np

from flypend import errors
from flypend.geometry import E3, Numbers, Scalar, Vector, is_symbolic, norm
from flypend.laws.references import Reference
from flypend.model import State, Vehicle
from flypend.model.state import E3Direction

PARTS = ("rod", "axis", "position")
# Reductions over a run in a kernel, in order: time since which everything is within tolerance, last time out of
# tolerance for each part, largest distance, and mean square over time and maximum of the rotor forces.
REDUCTIONS = ("since", "last", "last", "last", "max", "mean", "max")
# What a sampled flight reduces beside them: the highest corner of the box about the machine, and minus the lowest.
EXTENTS = ("max",) * 6


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Criterion:
    """Conditions that a flight must satisfy during its last `hold` seconds to succeed.

    Parameters
    ----------
    rod, axis : float
        Bounds on |y − e₃| and |z − e₃|, each plus the lean that a moving reference requires.
    position : float
        Largest distance of the pivot from its reference, m; inf for no limit.
    hold : float
        Length of the final interval, s.
    target : "inverted" or "e3"
        Target pose of the rod: upright against gravity, or along e₃ of the law's own frame, which hangs for the
        paper's laws. The target of the thrust axis z = R e₃ is e₃ of the law's frame in either case.

    Raises
    ------
    InputError
        If a tolerance is not positive or the target is unknown.
    """

    rod: float = 0.05
    axis: float = 0.05
    position: float = 0.2
    hold: float = 1.0
    target: Literal["inverted", "e3"] = "inverted"

    def __post_init__(self) -> None:
        for entry in fields(self):
            if entry.name != "target" and getattr(self, entry.name) != np.inf:
                errors.number(f"criterion.{entry.name}", getattr(self, entry.name), above=0)
        errors.one_of("criterion.target", self.target, ("inverted", "e3"))

    def pose(self, e3: E3Direction) -> Vector:
        """Return the target direction (3,) of the rod, in a frame with third axis `e3`."""
        return E3 if self.target == "e3" or e3 == "up" else -E3

    def excess(
        self, y: Vector, z: Vector, distance: Scalar, lean: Scalar, e3: E3Direction
    ) -> tuple[Scalar, Scalar, Scalar]:
        """Return by how much each of `PARTS` exceeds its tolerance; at most 0 within it.

        `y` and `z` are rod and thrust axis in the frame `e3`, `distance` (m) is from the reference, and `lean` is the
        value of the function `lean`. NumPy batches or CasADi expressions.
        """
        rod = norm(y - self.pose(e3)) - (self.rod + lean)
        return rod, norm(z - E3) - (self.axis + lean), distance - self.position

    def squares(self, y: Vector, z: Vector, lean: Scalar, e3: E3Direction) -> tuple[Scalar, Scalar]:
        """Return |y − e₃|² and |z − e₃|², each less its squared tolerance: smooth, with the sign of `excess`.

        `y`, `z` and `lean` are CasADi expressions; see `excess`.
        """
        rod = ca.sumsqr(y - self.pose(e3)) - (self.rod + lean) ** 2
        return rod, ca.sumsqr(z - E3) - (self.axis + lean) ** 2


def lean(acceleration: Vector, g: float, e3: E3Direction = "up") -> Scalar:
    """Return |d − e₃|, d being the direction of `acceleration` + g e₃ (e₃ up): the lean needed to follow a reference.

    The `acceleration` is given in the frame `e3`.

    On a circle, rod and axis lean slightly less, since the bob's circle is smaller than the pivot's. On a horizontal
    reference the result stays below √2, so a hanging rod never passes.
    """
    symbolic = is_symbolic(acceleration)
    a = [acceleration[i] if symbolic else acceleration[..., i] for i in range(3)]
    level, up = a[0] ** 2 + a[1] ** 2, g + a[2] * (1.0 if e3 == "up" else -1.0)
    length = (level + up**2) ** 0.5
    # 1 − d·e₃ without cancellation for small leans: level / (length (length + up)).
    return (2 * level / (length * (length + up))) ** 0.5


def observe(
    t: Scalar,
    state: State,
    rotors: Numbers,
    vehicle: Vehicle,
    reference: Reference | None,
    criterion: Criterion,
    e3: E3Direction,
) -> Numbers:
    """Return the CasADi values (7, 1) that `REDUCTIONS` reduce, for `state` in the frame `e3` and `rotors` (forces, N).

    `t` is the symbol of time, s; `reference` is the reference position of the law, None for the origin.
    """
    x_ref, moving = _target(t, vehicle, reference, e3)
    distance = norm(state.x - x_ref)
    excess = criterion.excess(state.y, state.z, distance, moving, e3)
    worst = ca.fmax(ca.fmax(excess[0], excess[1]), excess[2])
    return ca.vertcat(worst, *excess, distance, ca.sumsqr(rotors) / rotors.numel(), ca.mmax(rotors))


def gauge(
    t: Scalar, state: State, vehicle: Vehicle, reference: Reference | None, criterion: Criterion, e3: E3Direction
) -> tuple[Numbers, Numbers]:
    """Return CasADi gauges (3, 1) of `PARTS`, smooth in time, and the tolerances (3, 1) that they are about.

    The gauges are |y − e₃|² and |z − e₃|² less their squared tolerances, and the squared distance. A part is within
    tolerance while its gauge is at most its entry of `gauge_bounds`. Arguments as in `observe`.
    """
    x_ref, moving = _target(t, vehicle, reference, e3)
    gauges = ca.vertcat(*criterion.squares(state.y, state.z, moving, e3), ca.sumsqr(state.x - x_ref))
    tolerances = ca.vertcat(criterion.rod + moving, criterion.axis + moving, min(criterion.position, 1e6))
    return gauges, tolerances


def gauge_bounds(criterion: Criterion) -> tuple[float, float, float]:
    """Largest value within tolerance of each gauge of `gauge`."""
    return 0.0, 0.0, criterion.position**2


def _target(t: Scalar, vehicle: Vehicle, reference: Reference | None, e3: E3Direction) -> tuple[Vector, Scalar]:
    """Return the position (3, 1) of `reference` at `t` and the lean that it requires, 0 unless it accelerates."""
    x_ref = reference(t) if reference is not None else ca.SX.zeros(3)
    velocity = ca.jacobian(x_ref, t)
    return x_ref, lean(ca.densify(ca.jacobian(velocity, t)), vehicle.g, e3) if ca.depends_on(velocity, t) else 0.0
