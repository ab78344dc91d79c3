"""The board's model of vehicle and rotors: where they will be when the next command takes effect."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import Any

import casadi as ca

from flypend.board.nominal import Nominal
from flypend.geometry import Numbers
from flypend.laws.inverted_gains import angular_authority
from flypend.model.state import SIZE
from flypend.plants.actuation import rate_loop
from flypend.plants.cascade import cascade_step
from flypend.plants.lag import hold_in_turn
from flypend.plants.loop import Loop
from flypend.plants.schedule import Segment, in_steps, steps_in

# Longest step of a prediction, s, and how far the vehicle may turn within one, rad, at √α, which is about the fastest
# that a law turns it by purpose; α is its largest angular acceleration.
TWIN_STEP, TWIN_TURN = 28e-3, 0.5
# The same with a rate loop on board, whose forces follow the rotation: a quarter of the rotor lag.
LOOP_STEP = 5e-3


class Twin:
    """Vehicle and rotors of `loop` as `nominal`, as function calls on MX symbols with the numbers `params`.

    `forces` says whether external forces act; `name` begins the names of its programs.
    """

    def __init__(self, loop: Loop, nominal: Nominal, params: Numbers, *, forces: bool, name: str = "twin") -> None:
        self._name = name
        self._plant, self._nominal, self._params, self._forces = loop.sampled, nominal, params, forces
        self._steps: dict[str, ca.Function] = {}
        self._longest = min(TWIN_STEP, TWIN_TURN / angular_authority(loop.vehicle) ** 0.5)
        self._loop = None
        if loop.sampled.interface == "rates":
            plant = loop.sampled
            self._loop = rate_loop(nominal.vehicle, plant.limits, plant.rate_loop_gain, nominal.symbols)

    def advance(
        self, state: Numbers, rotors: Numbers, commands: Sequence[Any], segments: Sequence[Segment], forces: Numbers
    ) -> tuple[Numbers, Numbers]:
        """Return state (24,) and rotor forces (n,), N, after the `segments`, under `forces` (6,), N.

        `commands` has the commands by age.
        """
        if self._loop is None:
            for step in in_steps(segments, self._longest):
                given = ca.vertcat(*(commands[age] for age, _ in reversed(step)))
                state, rotors = self._step(step)(state, rotors, given, forces, self._params)
            return state, rotors
        for age, duration in segments:
            steps = steps_in(duration, self._plant, LOOP_STEP)
            step = self._step([Segment(age, duration / steps)])
            for _ in range(steps):
                wanted = self._loop(commands[age], state[15:18], self._params)
                state, rotors = step(state, rotors, wanted, forces, self._params)
        return state, rotors

    def _step(self, segments: Sequence[Segment]) -> ca.Function:
        """Return the step (state, rotors, commands, newest first, forces, params) → (state, rotors)."""
        lengths = [round(1e9 * segment.duration) for segment in segments]  # ns: one function up to roundoff
        name = "_".join([self._name, *(f"{len(list(same))}x{length}" for length, same in groupby(lengths))])
        if name not in self._steps:
            self._steps[name] = self._make(name, [length / 1e9 for length in lengths])
        return self._steps[name]

    def _make(self, name: str, durations: Sequence[float]) -> ca.Function:
        nominal, n = self._nominal, self._nominal.rotors
        packed, rotors, forces = ca.SX.sym("s", SIZE), ca.SX.sym("r", n), ca.SX.sym("F", 6)
        commands = ca.SX.sym("u", n * len(durations))
        held = ca.vertsplit(commands, n)[::-1]
        ramp, after = hold_in_turn(rotors, held, durations, nominal.lag)
        wrench, outside = ramp.mix(nominal.vehicle.mixing()), forces if self._forces else None
        moved = cascade_step(packed, wrench, outside, sum(durations), nominal.vehicle)
        outputs = ca.cse([ca.densify(moved), ca.densify(after)])
        return ca.Function(name, [packed, rotors, commands, forces, nominal.symbols], outputs)
