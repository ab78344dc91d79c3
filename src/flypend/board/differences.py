"""The negative control of the estimator: the last pose as it was read, and rates as differences of the last two."""

from __future__ import annotations

import casadi as ca

from flypend.board.command import OUTSIDE
from flypend.board.nominal import Nominal
from flypend.compile.record import Field, Record
from flypend.geometry import Numbers, Scalar, Vector, tangent_part
from flypend.model import State
from flypend.model.state import SIZE
from flypend.plants.loop import Loop
from flypend.plants.sensing import NOTHING, readings_record
from flypend.plants.sensors import Sensors

RECORD = Record(
    "estimate",
    "Differences of readings.",
    (
        Field("state", SIZE, "with e3 up"),
        Field("since_position", 0, "seconds since the last reading; negative before the first"),
        Field("since_rod", 0, "the same"),
    ),
)


class Differences:
    """Poses and their differences as an estimate of the state; interface as `estimator.Filter`."""

    def __init__(self, loop: Loop, nominal: Nominal) -> None:
        self.sensors: Sensors = loop.sampled.sensors
        self._period = 1 / loop.sampled.rate
        self._params = nominal.symbols
        self._rotors = nominal.rotors
        self.record = RECORD

    def begin(self) -> ca.Function:
        """Return (rotors (n,), estimate (24,), params) → memory before the first step."""
        rotors, state = ca.SX.sym("r", self._rotors), ca.SX.sym("s", SIZE)
        memory = RECORD.join({"state": state, "since_position": NOTHING, "since_rod": NOTHING})
        return ca.Function("estimate_begun", [rotors, state, self._params], [memory])

    def correct(self) -> ca.Function:
        """Return (memory, readings, params) → memory, state (24,), and no force (8,)."""
        record = readings_record(self.sensors)
        memory, readings = ca.SX.sym("memory", RECORD.length), ca.SX.sym("readings", record.length)
        kept, read = RECORD.split(memory), record.split(readings)
        s = State.symbolic(kept["state"])

        def latest(name: str, before: Numbers) -> Numbers:
            return ca.if_else(read[f"{name}_age"] >= 0, read[name], before)

        def difference(name: str, before: Numbers, rate: Vector) -> tuple[Vector, Scalar]:
            since, age = kept[f"since_{name}"], read[f"{name}_age"]
            found = (read[name] - before) / ca.fmax(since - age, 1e-9)
            again = (age >= 0) * (since >= 0)
            return ca.if_else(again, found, rate), ca.if_else(age >= 0, age, since)

        x_dot, since_x = difference("position", s.x, s.x_dot)
        y_dot, since_y = difference("rod", s.y, s.y_dot)
        y = latest("rod", s.y)
        R = ca.reshape(latest("attitude", ca.vec(s.R.T)), 3, 3).T
        state = State(
            x=latest("position", s.x), x_dot=x_dot, R=R, omega=latest("gyro", s.omega), y=y,
            y_dot=tangent_part(y, y_dot),
        ).packed()  # fmt: skip
        after = RECORD.join({"state": state, "since_position": since_x, "since_rod": since_y})
        outputs = [ca.densify(v) for v in (after, state, ca.SX(OUTSIDE.length, 1))]
        return ca.Function("correct", [memory, readings, self._params], outputs)

    def carry(self) -> ca.Function:
        """Return (memory, outside, commands by age, params) → memory a control period later."""
        memory, commands = ca.SX.sym("memory", RECORD.length), ca.SX.sym("u", 0)
        outside = ca.SX.sym("outside", OUTSIDE.length)
        since = memory[SIZE:]
        after = ca.vertcat(memory[:SIZE], ca.if_else(since >= 0, since + self._period, since))
        return ca.Function("spread", [memory, outside, commands, self._params], [after])
