"""The negative control of the estimator: the last pose as it was read, and rates as differences of the last two."""

from __future__ import annotations

from typing import Any

import casadi as ca

from flypend.board.believed import Believed
from flypend.geometry import tangent_part
from flypend.model import State
from flypend.model.state import SIZE
from flypend.plants.loop import Loop
from flypend.plants.sensing import NOTHING, WIDTH, readings_size
from flypend.plants.sensors import Sensors

# The streams that are differenced, each with the time since its last reading in the memory after the state.
DIFFERENCED = ("position", "rod")


class Differences:
    """Poses and their differences as an estimate of the state; interface as `estimator.Filter`."""

    def __init__(self, loop: Loop, believed: Believed) -> None:
        self.sensors: Sensors = loop.sampled.sensors
        self._period = 1 / loop.sampled.rate
        self._params = believed.symbols
        self._rotors = believed.rotors

    @property
    def size(self) -> int:
        """Length of the memory: state (24,), and the time since the last reading of each of DIFFERENCED."""
        return SIZE + len(DIFFERENCED)

    def begun(self) -> ca.Function:
        """Return (rotors (n,), estimate (24,), params) → memory before the first step."""
        rotors, state = ca.SX.sym("r", self._rotors), ca.SX.sym("s", SIZE)
        memory = ca.vertcat(state, *[NOTHING] * len(DIFFERENCED))
        return ca.Function("estimate_begun", [rotors, state, self._params], [memory])

    def correct(self) -> ca.Function:
        """Return (memory, readings, params) → memory, state (24,), and no force (6,)."""
        memory, readings = ca.SX.sym("memory", self.size), ca.SX.sym("readings", readings_size(self.sensors))
        read, ages, place = {}, {}, 0
        for name in self.sensors.streams:
            read[name], ages[name] = readings[place : place + WIDTH[name]], readings[place + WIDTH[name]]
            place += WIDTH[name] + 1
        s = State.symbolic(memory[:SIZE])

        def latest(name: str, before: Any) -> Any:
            return ca.if_else(ages[name] >= 0, read[name], before)

        def differenced(name: str, before: Any, rate: Any, since: Any) -> tuple[Any, Any]:
            found = (read[name] - before) / ca.fmax(since - ages[name], 1e-9)
            again = (ages[name] >= 0) * (since >= 0)
            return ca.if_else(again, found, rate), ca.if_else(ages[name] >= 0, ages[name], since)

        x_dot, since_x = differenced("position", s.x, s.x_dot, memory[SIZE])
        y_dot, since_y = differenced("rod", s.y, s.y_dot, memory[SIZE + 1])
        y = latest("rod", s.y)
        state = State(
            x=latest("position", s.x),
            x_dot=x_dot,
            R=ca.reshape(latest("attitude", ca.vec(s.R.T)), 3, 3).T,
            omega=latest("gyro", s.omega),
            y=y,
            y_dot=tangent_part(y, y_dot),
        ).packed()
        outputs = [ca.densify(v) for v in (ca.vertcat(state, since_x, since_y), state, ca.SX(6, 1))]
        return ca.Function("correct", [memory, readings, self._params], outputs)

    def carry(self) -> ca.Function:
        """Return (memory, outside, commands by age, params) → memory a control period later."""
        memory, commands = ca.SX.sym("memory", self.size), ca.SX.sym("u", 0)
        outside = ca.SX.sym("outside", 6)
        since = memory[SIZE:]
        after = ca.vertcat(memory[:SIZE], ca.if_else(since >= 0, since + self._period, since))
        return ca.Function("spread", [memory, outside, commands, self._params], [after])
