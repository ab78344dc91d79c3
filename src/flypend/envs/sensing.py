"""What worlds with sensors observe: the estimate of the flight computer's filter, once an action.

The filter is that of flights whose control rate is that of the actions, and whose commands the actions are. The random
numbers of a world's sensors are those that a flight with its seed plus 2⁶² would draw, and its episodes are 2⁴¹ ticks
apart. Seeds of flights end at 2⁶², so only the world with seed 0 shares them with one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np

from flypend.board.command import OUTSIDE, command_width
from flypend.board.estimator import Filter
from flypend.board.nominal import Nominal
from flypend.compile.problem import Estimating
from flypend.compile.program import lower
from flypend.compile.record import Field, Record
from flypend.errors import InputError
from flypend.laws import Controller
from flypend.model import Vehicle, Wrench
from flypend.model.state import SIZE
from flypend.plants.loop import Loop
from flypend.plants.plant import Plant
from flypend.plants.sensing import (
    START_TICK,
    draws_size,
    first_estimate,
    first_memory,
    memory_record,
    sensing,
    start_draws,
)

# The actions are the law: the filter only asks for the limit of external forces that comes with one.
ACTIONS = Controller(name="actions", function=lambda t, state: Wrench(0.0, np.zeros(3)))


class Estimates:
    """The programs of a filter for `vehicle` in worlds of the `true` one, which fly as `plant` does.

    The rate of `plant` is that of the actions. `record` is the table of their memory.

    Raises
    ------
    InputError
        If the plant's sensors difference poses instead of estimating.
    """

    def __init__(self, vehicle: Vehicle, true: Vehicle, plant: Plant) -> None:
        if plant.sensors.rates != "estimated":
            raise InputError("sensors.rates", "'estimated'", repr(plant.sensors.rates))
        self._loop, self._true, self._plant = Loop(vehicle, ACTIONS, plant), true, plant
        self._filter = Filter(self._loop, Nominal(vehicle))
        self._correct, self._carry = self._filter.correct(), self._filter.carry()
        width = command_width(self._loop)
        self._under_way = self._carry.numel_in(2) // width - 1
        commands = Field("commands", self._under_way * width, "commands in transit, newest first")
        self.record = Record(
            "sensing",
            "What a world with sensors remembers.",
            (
                Field.of(self._filter.record),
                Field.of(OUTSIDE),
                *[commands] * bool(self._under_way),
                Field.of(memory_record(plant.sensors, 1 / plant.rate)),
            ),
        )

    def programs(self, asked: ca.Function, idle: Callable[[Any], Any]) -> Estimating:
        """Return the programs; `asked` is the command (w,) of an action (m,), `idle` as in `first`."""
        return Estimating(
            first=lower(self.first(idle)), carry=lower(self.carry(asked)), sense=lower(self.sense()), tick=START_TICK
        )

    def first(self, idle: Callable[[Any], Any]) -> ca.Function:
        """(state and rotor forces (24 + n,), draws of the start) → memory before the first readings.

        `idle` returns the command (w,) that acts before the first action, for rotor forces (n,).
        """
        begin = ca.SX.sym("s", SIZE + len(self._true.rotor_spins))
        draws = ca.SX.sym("d", start_draws(self._plant.sensors))
        state, rotors = begin[:SIZE], begin[SIZE:]
        estimate = first_estimate(self._plant.sensors)(state, draws)
        filtered = self._filter.begin()(rotors, estimate, [])
        commands = ca.vertcat(*[idle(rotors)] * self._under_way)
        sensors = first_memory(self._plant.sensors, 1 / self._plant.rate, state, draws)
        memory = self.record.join(
            {"estimate": filtered, "outside": ca.SX.zeros(OUTSIDE.length), "commands": commands, "sensors": sensors}
        )
        return ca.Function("first_estimate", [begin, draws], [ca.densify(memory)])

    def carry(self, asked: ca.Function) -> ca.Function:
        """(memory, action) → memory a period later, before the readings of its end."""
        memory, action = ca.MX.sym("memory", self.record.length), ca.MX.sym("a", asked.numel_in(0))
        parts = self.record.split(memory)
        commands = ca.vertcat(asked(action), parts.get("commands", ca.MX(0, 1)))
        estimate = self._carry(parts["estimate"], parts["outside"], commands, [])
        after = self.record.join(parts | {"estimate": estimate, "commands": commands[: -asked.numel_out(0)]})
        return ca.Function("carry_estimate", [memory, action], [after])

    def sense(self) -> ca.Function:
        """(memory, time, state (24,), draws) → memory with the readings of that time."""
        sensors, period = self._plant.sensors, 1 / self._plant.rate
        memory, t = ca.MX.sym("memory", self.record.length), ca.MX.sym("t")
        state, draws = ca.MX.sym("s", SIZE), ca.MX.sym("d", draws_size(sensors))
        parts = self.record.split(memory)
        kept, readings = sensing(sensors, self._true, period)(parts["sensors"], t, state, draws)
        estimate, _, outside = self._correct(parts["estimate"], readings, [])
        after = self.record.join(parts | {"estimate": estimate, "outside": outside, "sensors": kept})
        return ca.Function("sense", [memory, t, state, draws], [after])
