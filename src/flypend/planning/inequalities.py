"""Inequalities along the way, the cost of a stage, and the errors at the end, in a machine's own units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca

from flypend.geometry import E3, cross, dot
from flypend.model import State, Vehicle, Wrench, rod_tension
from flypend.model.mount import least_margin, rod_in_body
from flypend.model.state import SIZE
from flypend.planning.passage import NUMBERS, passing
from flypend.planning.scaled import Scaled

# Tolerances at the end, in own units.
END = {"x": 0.01, "x_dot": 0.02, "tilt": 0.03, "omega": 0.06, "y": 0.015, "y_dot": 0.03, "rotors": 0.15}

# Places of the numbers that every plan has: weights of the shared parameter and of effort, rotor limits, and the
# tolerance of the spin about the thrust axis at the end.
SHARED, EFFORT, LOW, HIGH, YAW, BASE = 0, 1, 2, 3, 4, 5
DIFFERENCE = 1e-4
SOFT = 0.03  # rod lengths, or weights: what is by so much too near costs its full weight


@dataclass(frozen=True)
class Structure:
    """Which inequalities a plan obeys, beside the limits of the rotors and the ball |x|² ≤ e that its cost shrinks.

    Parameters
    ----------
    box : bool
        Whether pivot and far end of the rod stay in a box.
    speed : bool
        Whether the speed of the pivot is limited.
    lean : bool
        Whether the lean of the rod is limited.
    path : bool
        Whether the ball is about a place that moves from stage to stage, not about the target.
    gates : int
        Number of windows to fly through and waypoints to pass.
    mounted : Vehicle, optional
        A vehicle whose mount limits the rod; None for a gimbal.
    """

    box: bool = False
    speed: bool = False
    lean: bool = False
    path: bool = False
    gates: int = 0
    mounted: Vehicle | None = None

    @property
    def numbers(self) -> int:
        """Length of the numbers: `BASE`, reach of the rod and corners of the box, speed, lowest y₃, then `soft` ones.

        These are the gates, the weight of being too near, and the margin of the mount.
        """
        hard = BASE + 7 * self.box + self.speed + self.lean
        return hard + NUMBERS * self.gates + 2 * self.soft

    @property
    def soft(self) -> bool:
        """Whether some are kept by a cost that grows: those about what the machine is not to touch."""
        return self.mounted is not None or self.gates > 0

    def exact(self, rotors: int) -> int:
        """Return how many inequalities, the first ones, can always be kept: limits of `rotors` rotors and the ball."""
        return 2 * rotors + 1


def inequalities(
    state: Any, command: Any, shared: Any, numbers: Any, middle: Any, structure: Structure, machine: Scaled
) -> Any:
    """Return g (k, 1), every entry of which is to be ≥ 0.

    Parameters
    ----------
    state, command : SX
        State and rotor forces (24 + n, 1), commanded forces (n, 1).
    shared : SX
        e, the squared radius of the ball.
    numbers : SX
        See `Structure.numbers`.
    middle : SX
        The middle of the ball, (3, 1).
    structure, machine
        What is wished, and the machine.
    """
    s, place = State.symbolic(state[:SIZE]), BASE
    off = s.x - middle if structure.path else s.x
    g = [command - numbers[LOW], numbers[HIGH] - command, shared - dot(off, off)]
    if structure.box:
        reach, low, high = numbers[place], numbers[place + 1 : place + 4], numbers[place + 4 : place + 7]
        for point in (s.x, s.x + reach * s.y):
            g += [point - low, high - point]
        place += 7
    if structure.speed:
        g.append(numbers[place] - dot(s.x_dot, s.x_dot) / numbers[place])
        place += 1
    if structure.lean:
        g.append(s.y[2] - numbers[place])
    return ca.vertcat(*g)


def nearness(state: Any, about: Any, numbers: Any, structure: Structure, machine: Scaled) -> Any:
    """Return by how much rod and machine are nearer than they should be to mount and frames, (k, 1), units of `SOFT`.

    Their squares cost the last but one of `numbers`; the last is the margin that the mount is to keep, in rod lengths
    or weights.
    """
    first = structure.numbers - 2 - NUMBERS * structure.gates
    gates = [numbers[first + NUMBERS * i : first + NUMBERS * (i + 1)] for i in range(structure.gates)]
    near = [-passing(state, about, gate) for gate in gates]
    if structure.mounted is not None:
        near.append(numbers[-1] - _kept(state, about, structure.mounted, machine))
    return ca.fmax(0, ca.vertcat(ca.SX(0, 1), *near) / SOFT)


def _kept(state: Any, about: Any, mounted: Vehicle, machine: Scaled) -> Any:
    """Return the least of `model.mount.margins`, in rod lengths or weights, linear in `state` about `about`.

    Its own derivatives do not exist everywhere, differences do.
    """
    here, there = (_held_by(place, machine) for place in (state, about))

    def margin(held: Any) -> Any:
        return least_margin(held[:3], held[3] * mounted.l, mounted)[0] / mounted.l

    slopes = []
    for i in range(4):
        step = DIFFERENCE * ca.SX(ca.DM.eye(4)[:, i])
        slopes.append((margin(there + step) - margin(there - step)) / (2 * DIFFERENCE))
    return margin(there) + ca.dot(ca.vertcat(*slopes), here - there)


def _held_by(state: Any, machine: Scaled) -> Any:
    """Return the rod in the body frame (3,) and its push on the vehicle, in weights."""
    s = State.symbolic(state[:SIZE])
    thrust = ca.mtimes(machine.mixing()[0, :], state[SIZE:])
    tension = rod_tension(s, Wrench(thrust, ca.SX(3, 1)), machine.vehicle)
    return ca.vertcat(rod_in_body(s, "up")[0], -tension)


def running_cost(command: Any, numbers: Any) -> Any:
    """Return the cost of a stage: half the squared deviation of the commands from hover, weighted."""
    return numbers[EFFORT] * ca.sumsqr(command - 1) / 2


def end_errors(state: Any, numbers: Any) -> Any:
    """Return the errors of the last state about inverted hover, in units of their tolerances."""
    s = State.symbolic(state[:SIZE])
    return ca.vertcat(
        s.x / END["x"],
        s.x_dot / END["x_dot"],
        _lean(s.z) / END["tilt"],
        s.omega[:2] / END["omega"],
        s.omega[2] / numbers[YAW],
        _lean(s.y) / END["y"],
        s.y_dot / END["y_dot"],
        (state[SIZE:] - 1) / END["rotors"],
    )


def _lean(a: Any) -> Any:
    """Return the error (3, 1) of a unit vector from e₃: the double tangent of half its angle, and 1 − a₃.

    The tangent is kept finite upside down, where it vanishes and 1 − a₃ is 2; near e₃ that is of second order.
    """
    level = 2 * cross(a, ca.SX(ca.DM(E3)))[:2] / (1.05 + a[2])
    return ca.vertcat(level, 1 - a[2])
