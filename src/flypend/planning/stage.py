"""One stage of a plan: the step of the plants' equations under a held command, and its derivatives in coordinates."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import casadi as ca

from flypend.model.state import SIZE
from flypend.planning.coordinates import MOTION, local, retract
from flypend.planning.riccati import unpacked_gains
from flypend.planning.scaled import Scaled
from flypend.plants.cascade import cascade_step
from flypend.plants.lag import TIMING_SIZE, held

LEAST_ROOM = 1e-9  # own units: less would be lost in the rounding of a command


def stepped(state: Any, command: Any, timing: Any, machine: Scaled) -> Any:
    """Return the state (24 + n, 1) after a step of `timing` (see `plants.lag.step_timing`) under `command` (n, 1)."""
    forces, rotors = held(state[SIZE:], command, timing)
    moved = cascade_step(state[:SIZE], forces.mixed(machine.mixing()), machine.outside, timing[0], machine.vehicle)
    return ca.vertcat(moved, rotors)


class Stage:
    """Symbols of a stage of a machine with `rotors` rotors, in its own units.

    `gap` are the coordinates of where the stage leads about the state `after`, at which the next stage begins.
    """

    def __init__(self, rotors: int) -> None:
        self.rotors = rotors
        self.coordinates = MOTION + rotors
        self.machine = Scaled.symbols(rotors)
        self.before, self.after = ca.SX.sym("before", SIZE + rotors), ca.SX.sym("after", SIZE + rotors)
        self.command, self.timing = ca.SX.sym("command", rotors), ca.SX.sym("timing", TIMING_SIZE)

    def gap_at(self, delta: Any) -> Any:
        """Return the gap (16 + n, 1) if the stage begins with coordinates `delta` about `before`."""
        led = stepped(retract(self.before, delta), self.command, self.timing, self.machine)
        return local(self.after, led)

    def step(self) -> ca.Function:
        """Return (before, command, timing, vehicle) → state after the stage."""
        led = stepped(self.before, self.command, self.timing, self.machine)
        return ca.Function("step", [self.before, self.command, self.timing, self.machine.numbers], [ca.cse(led)])

    def derivatives(self) -> tuple[Any, Any, Any]:
        """Return gap, and its derivatives A and B with respect to coordinates of the state and the command, sparse."""
        delta = ca.SX.sym("delta", self.coordinates)
        gap = self.gap_at(delta)
        A, B = ca.jacobian(gap, delta), ca.jacobian(gap, self.command)
        at = ca.substitute([gap, A, B], [delta], [ca.SX.zeros(self.coordinates)])
        return ca.densify(at[0]), ca.sparsify(at[1]), ca.sparsify(at[2])

    def linearised(self) -> tuple[ca.Function, Any, Any]:
        """Return (before, after, command, timing, vehicle) → gap, and non-zeros of A and B; and the patterns of both.

        See `derivatives`.
        """
        gap, A, B = self.derivatives()
        outputs = [gap, ca.vertcat(*A.nonzeros()), ca.vertcat(*B.nonzeros())]
        return self.leading(*outputs), A.sparsity(), B.sparsity()

    def leading(self, *outputs: Any) -> ca.Function:
        """Return (before, after, command, timing, vehicle) → `outputs`."""
        inputs = [self.before, self.after, self.command, self.timing, self.machine.numbers]
        return ca.Function("linearised", inputs, ca.cse([*outputs]))

    def rollout(self) -> ca.Function:
        """Return (nominal, command, gap, gains, state, length, ε, limits, timing, vehicle) → state after it, command.

        The new command is that of the `riccati` step, `length` of it, with feedback of the deviation of the state from
        the nominal one. It is kept within limits (3,): least, largest, and the largest share of the room between the
        old command and each of them that it takes; `LEAST_ROOM` always stays. What is left of the gap is
        1 − `length` of it.
        """
        n, state, length = self.coordinates, ca.SX.sym("state", SIZE + self.rotors), ca.SX.sym("length")
        gap, epsilon, limits = ca.SX.sym("gap", n), ca.SX.sym("epsilon"), ca.SX.sym("limits", 3)
        gains = ca.SX.sym("gains", self.rotors * (n + 2))
        K, k, k_e = unpacked_gains(gains, n, self.rotors)
        wanted = self.command + length * (k + epsilon * k_e) + ca.mtimes(K, local(self.before, state))
        low, high = limits[0] + LEAST_ROOM, limits[1] - LEAST_ROOM
        least = ca.fmin(ca.fmax(self.command + limits[2] * (limits[0] - self.command), low), self.command)
        most = ca.fmax(ca.fmin(self.command + limits[2] * (limits[1] - self.command), high), self.command)
        command = ca.fmin(ca.fmax(wanted, least), most)
        led = retract(stepped(state, command, self.timing, self.machine), (length - 1) * gap)
        inputs = [self.before, self.command, gap, gains, state, length, epsilon, limits]
        inputs += [self.timing, self.machine.numbers]
        return ca.Function("rollout", inputs, ca.cse([ca.densify(led), ca.densify(command)]))


@lru_cache(maxsize=4)
def stage(rotors: int) -> Stage:
    """Return the stage of a machine with this many `rotors`."""
    return Stage(rotors)
