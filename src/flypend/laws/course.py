"""What a moving reference asks of the inverted law: the motion along it, and the force that its loops do not ask for.

The bob's path p(t) is a flat output. In still air the rod is y = A/|A| with A = g e₃ + p̈, and the force on the
quadrotor is F = (M+m) A − M l ÿ: what carries both, less what bob and rod take of it. So the thrust axis z = F/|F| and
its rate follow from derivatives of p, here up to its snap. Forces of the wind are left to the loops, as in hover.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import casadi as ca

from flypend.geometry import E3, Numbers, Scalar, Vector, dot, norm, scale, tangent_part, unit
from flypend.laws.throw import Bob, Rod, coast
from flypend.model import Vehicle
from flypend.model.momenta import carrying_force

# Derivatives of p, beside itself, that are used: up to its snap, as exported code is told.
DERIVATIVES = 4


class Course(NamedTuple):
    """What a rod that has coasted is compared with, each (3, 1).

    The bob's position `p`, m, velocity `v`, m/s, acceleration `a`, m/s², and `jerk`, m/s³; the rod's direction `up`;
    and the `force`, N, that the motion takes beyond what the loops ask for while they see no error.
    """

    p: Vector
    v: Vector
    a: Vector
    jerk: Vector
    up: Vector
    force: Vector

    def bob(self, x: Vector, x_dot: Vector, rod: Rod, l: Scalar) -> Bob:
        """Return the bob of the `rod` of length `l` (m) on the pivot at `x` (m) with velocity `x_dot`, each (3, 1)."""
        return Bob(x + l * rod.y - self.p, x_dot + l * rod.y_dot - self.v, self.a, self.jerk)


class Motion(NamedTuple):
    """A motion along the path of the bob, each (3, 1) but `size`: values, their rates, or symbols for them.

    The bob's position `p`, m, velocity `v`, m/s, and `jerk`, m/s³; direction `y` and rate `y_dot`, 1/s, of the rod;
    |A| as `size`, m/s²; `force` F, N, and its direction, the thrust axis `z`.
    """

    p: Vector
    v: Vector
    jerk: Vector
    y: Vector
    y_dot: Vector
    size: Scalar
    force: Vector
    z: Vector

    def coast(self, time: Scalar, vehicle: Vehicle) -> Course:
        """Return what a rod is compared with that has coasted for `time`, s: this one after coasting as long.

        Pivot and force are those of now. So the loops see no error along this motion, although its rod does not coast.
        """
        rod, l = coast(Rod(self.y, self.y_dot), time), vehicle.l
        bob = self.p + l * (rod.y - self.y), self.v + l * (rod.y_dot - self.y_dot)
        jerk = scale(dot(self.y, self.jerk), rod.y) + scale(self.size, rod.y_dot)
        # What the loops ask for: the force along a rod that coasts.
        force = self.force - scale(carrying_force(self.size, rod.y_dot, vehicle), rod.y)
        return Course(*bob, scale(self.size, rod.y) - vehicle.g * E3, jerk, rod.y, force)


# Symbols for a motion: a law in them stays short, however long the expressions of its path are.
HELD = Motion(*(ca.SX.sym(name, 1 if name == "size" else 3) for name in Motion._fields))


def motion(p: Sequence[Vector], vehicle: Vehicle) -> tuple[Motion, Motion]:
    """Return the motion along the bob's path `p`, its position and four derivatives, each (3, 1), and its rates."""
    whole, swung = vehicle.M + vehicle.m, vehicle.M * vehicle.l
    A, A_1, A_2 = vehicle.g * E3 + p[2], p[3], p[4]
    size, y = norm(A), unit(A)
    # A = |A| y, differentiated until the snap is used up.
    size_1 = dot(y, A_1)
    y_1 = (A_1 - scale(size_1, y)) / size
    size_2 = dot(y_1, A_1) + dot(y, A_2)
    y_2 = (A_2 - scale(size_2, y) - 2 * scale(size_1, y_1)) / size
    size_3 = dot(y_2, A_1) + 2 * dot(y_1, A_2)
    y_3 = -(scale(size_3, y) + 3 * scale(size_2, y_1) + 3 * scale(size_1, y_2)) / size
    force, force_1 = whole * A - swung * y_2, whole * A_1 - swung * y_3
    z = unit(force)
    z_1 = tangent_part(z, force_1) / norm(force)
    return Motion(p[0], p[1], p[3], y, y_1, size, force, z), Motion(p[1], p[2], p[4], y_1, y_2, size_1, force_1, z_1)


def rate_along(value: Numbers, rates: Motion) -> Numbers:
    """Return the rate of the expression `value` of `HELD`, whose rates are given."""
    return ca.jtimes(value, ca.vertcat(*HELD), ca.vertcat(*rates))


def at_rest(p: Sequence[Vector]) -> Course:
    """Return what a rod is compared with, however long it has coasted, if the bob's acceleration is constant."""
    place, velocity, acceleration, jerk = p[:4]
    return Course(place, velocity, acceleration, jerk, E3, 0.0)
