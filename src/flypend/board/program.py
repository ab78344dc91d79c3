"""The flight computer as one program: (memory, measurement, reference, gains, params) → (memory, command).

It is the source of the kernel of sampled flights (MuJoCo included), the Python reference, and the exported C. In each
control period it estimates the state, if the plant has sensors, and external forces; it predicts the state at which its
command will be applied, evaluates the law there, allocates the wrench to the rotors, adds lead, and advances its rotor
model and its queue of commands in transit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from flypend.board import observer as observing
from flypend.board.command import (
    OUTSIDE,
    command_width,
    idle_command,
    law_command,
    steering,
    total_forces,
    usable_lead,
)
from flypend.board.delay import DelayEstimator
from flypend.board.differences import Differences
from flypend.board.estimator import Filter, segments_of
from flypend.board.nominal import Nominal
from flypend.board.trim import trim
from flypend.board.twin import Twin
from flypend.compile.record import Field, Record
from flypend.geometry import Numbers
from flypend.model.state import SIZE
from flypend.plants.lag import hold, step_timing
from flypend.plants.loop import Loop
from flypend.plants.plant import Plant
from flypend.plants.schedule import Segment, segments_ahead, segments_within
from flypend.plants.sensing import readings_record


@dataclass(frozen=True, eq=False)
class Parts:
    """What the board of `loop`, as `nominal`, consists of.

    Parameters
    ----------
    loop : Loop
        Vehicle, law and plant.
    nominal : Nominal
        The nominal vehicle of its equations.
    estimator : Filter or Differences, optional
        What estimates the state; None for a plant that measures the state itself.
    finding : DelayEstimator, optional
        What finds the delay; None if the law has no reach, or under a rate loop, whose forces the board does not know.
    """

    loop: Loop
    nominal: Nominal
    estimator: Filter | Differences | None
    finding: DelayEstimator | None

    @cached_property
    def memory(self) -> Record:
        """Table of the memory: `rotors`, observer and delay estimator, `commands` in transit, newest first, `estimate`.

        It holds what there is of them.
        """
        loop, width = self.loop, command_width(self.loop)
        unit = "thrust, N, and body rates, rad/s" if loop.sampled.interface == "rates" else "N"
        records = [observing.RECORD] * self.observes + [part.record for part in (self.finding,) if part is not None]
        fields = (
            Field("rotors", len(loop.vehicle.rotor_spins), "modelled forces of the rotors, N"),
            *map(Field.of, records),
            Field("commands", _under_way(loop) * width, f"commands in transit, newest first, {unit}"),
            *[Field.of(part.record) for part in (self.estimator,) if part is not None],
        )
        return Record("memory", "What the flight computer remembers.", fields)

    @property
    def own(self) -> Record:
        """Table of the memory without that of the estimator."""
        return self._only(*(field.name for field in self.memory.fields if field.name != "estimate"))

    @property
    def kept(self) -> Record:
        """Table of the memory of observer and delay estimator."""
        return self._only("observer", "delay")

    def _only(self, *names: str) -> Record:
        return replace(self.memory, fields=tuple(field for field in self.memory.fields if field.name in names))

    @property
    def observes(self) -> bool:
        """Whether there is an observer of external forces. A `Filter` estimates them itself."""
        return self.loop.law.computer.observer > 0 and not filters(self.loop.sampled)

    def commands(self, memory: Numbers) -> list[Numbers]:
        """Return the commands in transit in a `memory`, newest first."""
        return ca.vertsplit(memory[self.memory.place("commands")], command_width(self.loop))  # type: ignore[no-any-return]

    def delay(self, memory: Numbers) -> float | None:
        """Return the delay, s, that the board has found, from its `memory`; None if it does not look for it."""
        return None if self.finding is None else float(memory[self.memory.place("delay.found")].item())

    @property
    def symbols(self) -> tuple[Numbers, Numbers, Numbers]:
        """Symbols for its own memory, a measurement (25,) and the parameters."""
        params = ca.MX.sym("params", self.nominal.symbols.numel())
        return ca.MX.sym("memory", self.own.length), ca.MX.sym("measurement", 1 + SIZE), params


def parts(loop: Loop, nominal: Nominal | None = None) -> Parts:
    """Return what the board of `loop` consists of, as `nominal`, by default the vehicle of `loop` as numbers."""
    nominal, plant, computer = nominal or Nominal(loop.vehicle), loop.sampled, loop.law.computer
    finds, estimator, finding = finds_delay(loop), None, None
    if plant.sensors is not None:
        estimator = Filter(loop, nominal, finds=finds) if filters(plant) else Differences(loop, nominal)
    if finds:
        left = 0.0 if computer.models_lag else nominal.lag / usable_lead(loop.law, loop.vehicle, plant)
        given = (computer.latency, computer.delay_reach, 1 / plant.rate, left, plant.assumed_delay)
        finding = DelayEstimator(nominal, *given)
    return Parts(loop, nominal, estimator, finding)


def initial_memory(loop: Loop, rotors: Numbers, estimate: Numbers = None, nominal: Nominal | None = None) -> Numbers:
    """Return the memory (k,) of the board of `loop` before its first step, for current rotor forces `rotors` (n,), N.

    Numbers or CasADi symbols. A plant with sensors needs an `estimate` (24,) of the state to begin with, e₃ up, and the
    `nominal` vehicle, by default that of `loop`.
    """
    made = parts(loop, nominal)
    begun = {"rotors": rotors, "observer": np.zeros(observing.RECORD.length)}
    begun["commands"] = ca.vertcat(*[idle_command(loop, rotors)] * _under_way(loop))
    if made.finding is not None:
        begun["delay"] = made.finding.begin(rotors)
    if made.estimator is not None:
        symbols = made.nominal.symbols
        begun["estimate"] = made.estimator.begin()(rotors, estimate, symbols if symbols.numel() else [])
    memory = made.memory.join(begun)
    return memory if isinstance(rotors, ca.SX) else memory.full().ravel()


def computer_view(plant: Plant) -> Plant:
    """Return what a flight computer knows of its `plant`: rate, limits, interface, rate loop; nothing of the world.

    With sensors it knows these, and the delay that its estimator assumes.
    """
    sensors = plant.sensors
    if sensors is not None:
        sensors = sensors.replace(command_delay=plant.assumed_delay)
    return Plant(
        rate=plant.rate, limits=plant.limits, interface=plant.interface, rate_loop_rate=plant.rate_loop_rate,
        rate_loop_gain=plant.rate_loop_gain, sensors=sensors,
    )  # fmt: skip


def finds_delay(loop: Loop) -> bool:
    """Whether the board of `loop` finds its delay in flight; not under a rate loop, whose forces it does not know."""
    return loop.law.computer.delay_reach > 0 and loop.sampled.interface != "rates"


def filters(plant: Plant) -> bool:
    """Whether the board in `plant` has a `Filter`."""
    return plant.sensors is not None and plant.sensors.rates == "estimated"


def _under_way(loop: Loop) -> int:
    """Return the number of commands to remember: all that are applied from now until the next one takes effect."""
    assumed = () if loop.sampled.sensors is None or finds_delay(loop) else segments_of(loop.sampled)
    return max(1, *(segment.age for segment in (*_predictor(loop), *_within(loop), *assumed)))


def board(
    loop: Loop, nominal: Nominal | None = None, command: ca.Function | None = None, reference: int = 0
) -> ca.Function:
    """Build the flight computer of `loop`.

    Parameters
    ----------
    loop : Loop
        Vehicle, bound law, sampled plant, and the input gains. Of the plant, only what a flight computer knows is used:
        rate, limits, interface, and rate and gain of the rate loop.
    nominal : Nominal, optional
        The nominal vehicle of the equations; default the vehicle of `loop`, as numbers.
    command : Function, optional
        Replacement for `law_command`, with the same inputs; default the law about its own reference.
    reference : int
        Length of the reference input of `command`.

    Returns
    -------
    Function
        (memory, measurement, reference, gains, params) → (memory, command): `predict_program`, `law_command`,
        `remember_program` and `trim_program` in sequence. A measurement is time (s) and state (24,), e₃ up; with
        sensors, it is time and readings (see `plants.sensing`), and the estimator's `correct` comes first and its
        `carry` last.
    """
    made = parts(loop, nominal)
    nominal, read = made.nominal, SIZE if made.estimator is None else readings_record(loop.sampled.sensors).length
    predict, remember = predict_program(made), remember_program(made)
    command = command or law_command(loop, nominal, steering(loop.symbolic))
    whole, measurement = ca.MX.sym("memory", made.memory.length), ca.MX.sym("measurement", 1 + read)
    path, gains = ca.MX.sym("reference", reference), ca.MX.sym("gains", len(loop.parameters))
    params = ca.MX.sym("params", nominal.symbols.numel())
    memory, measured = whole, measurement
    if made.estimator is not None:
        memory = whole[: made.own.length]
        estimate = whole[made.memory.place("estimate")]
        corrected, state, outside = made.estimator.correct()(estimate, measurement[1:], params)
        measured = ca.vertcat(measurement[0], state)
    estimated = [outside] if filters(loop.sampled) else []
    kept, forces, state, rotors, horizon = predict(memory, measured, params, *estimated)
    # CasADi returns a call whose value is always 0 as a sparse vector, which would leave the last command in place:
    # this one, and that of `trim_program`.
    given = ca.densify(command(measured[0], horizon, state, rotors, forces, path, gains, params))
    after = remember(memory, kept, measured, forces, given, params)
    if made.estimator is not None:
        after = ca.vertcat(after, carry_program(made)(corrected, outside, given, memory, after, params))
    names = (["memory", "measurement", "reference", "gains", "params"], ["memory_after", "command"])
    sent = ca.densify(trim_program(made)(after[: made.own.length], given, params))
    return ca.Function("board", [whole, measurement, path, gains, params], [after, sent], *names)


def _predictor(loop: Loop) -> tuple[Segment, ...]:
    return segments_ahead(_in_transit(loop), 1 / loop.sampled.rate)


def _within(loop: Loop) -> tuple[Segment, ...]:
    return segments_within(_in_transit(loop), 1 / loop.sampled.rate)


def _in_transit(loop: Loop) -> float:
    """Return for how long, s, the board's rotor model holds a command back: not at all where the delay is found."""
    return 0.0 if finds_delay(loop) else loop.law.computer.latency


def predict_program(made: Parts) -> ca.Function:
    """Return (memory, measurement, params) → kept memory, outside (8,), state (24,), rotors (n,), and horizon (s).

    State and rotors are those after the horizon, when the next command is taken to act.

    With a `Filter` there is one more input, what it finds (8,), in place of the observer; see `command.OUTSIDE`.
    """
    loop, nominal, finding = made.loop, made.nominal, made.finding
    memory, measurement, params = made.symbols
    before, commands = made.own.split(memory), made.commands(memory)
    rotors = thrusts = before["rotors"]
    state, horizon = measurement[1:], ca.MX(loop.law.computer.latency)
    found = OUTSIDE.split(ca.MX(ca.DM.zeros(OUTSIDE.length)))
    given = [ca.MX.sym("outside", OUTSIDE.length)] if filters(loop.sampled) else []
    if given and loop.law.computer.observer > 0:
        found = OUTSIDE.split(given[0])
    kept = {}
    if finding is not None:
        kept["delay"], horizon, wrenches = finding.find()(before["delay"], state[15:18], rotors, commands[0], params)
        thrusts = wrenches[0, 2]
    if made.observes:
        observe = observing.observer(nominal, loop.law.computer, 1 / loop.sampled.rate, thrusts.numel())
        kept["observer"], found["forces"], found["scale"] = observe(state, thrusts, before["observer"], params)
    if finding is not None:
        state = finding.carry()(state, horizon, wrenches, OUTSIDE.join(found), params)
    under_way = [None, *commands]  # this step's command, of age 0, is yet to come
    forces = total_forces(nominal)(state, rotors, OUTSIDE.join(found))
    state, rotors = _twin(loop, nominal, params).advance(state, rotors, under_way, _predictor(loop), forces)
    outputs = [made.kept.join(kept), OUTSIDE.join(found), state, rotors, horizon]
    return ca.Function("predict", [memory, measurement, params, *given], outputs)


def _twin(loop: Loop, nominal: Nominal, params: Numbers) -> Twin:
    return Twin(loop, nominal, params, forces=loop.law.computer.observer > 0)


def remember_program(made: Parts) -> ca.Function:
    """Return (memory, kept memory, measurement, outside (8,), command, params) → memory."""
    loop, nominal = made.loop, made.nominal
    memory, measurement, params = made.symbols
    kept, outside = ca.MX.sym("kept", made.kept.length), ca.MX.sym("outside", OUTSIDE.length)
    command = ca.MX.sym("command", command_width(loop))
    rotors, under_way = memory[made.own.place("rotors")], [command, *made.commands(memory)]
    if loop.sampled.interface == "rates":  # the rate loop's rotor commands depend on the rotation
        twin = _twin(loop, nominal, params)
        forces = total_forces(nominal)(measurement[1:], rotors, outside)
        _, rotors = twin.advance(measurement[1:], rotors, under_way, _within(loop), forces)
    else:
        rotors = _advance_rotors(loop, nominal, rotors, under_way)
    after = ca.vertcat(rotors, kept, *under_way[:-1])
    return ca.Function("remember", [memory, kept, measurement, outside, command, params], [after])


def trim_program(made: Parts) -> ca.Function:
    """Return (memory, command, params) → command to send, trimmed if the board finds a trim."""
    memory, _, params = made.symbols
    command = sent = ca.MX.sym("command", command_width(made.loop))
    if made.finding is not None:
        found = memory[made.own.place("delay.trim")]
        sent = trim(made.nominal, limits=made.loop.sampled.limits)(command, found, params)
    return ca.Function("trimmed", [memory, command, params], [sent])


def carry_program(made: Parts) -> ca.Function:
    """Return (corrected, outside (8,), command, memory before and after, params) → estimate a period later.

    Both memories are those without the estimate.
    """
    estimator, params = made.estimator, made.symbols[2]
    assert estimator is not None
    corrected, outside = ca.MX.sym("corrected", estimator.record.length), ca.MX.sym("outside", OUTSIDE.length)
    command = ca.MX.sym("command", command_width(made.loop))
    before, after = (ca.MX.sym(name, made.own.length) for name in ("before", "after"))
    carry = estimator.carry()
    if made.finding is not None and filters(made.loop.sampled):
        kept = made.own.split(after)
        given = made.finding.acting()(after[made.own.place("delay")], kept["rotors"], params)
    else:
        given = ca.vertcat(command, before[made.own.place("commands")])[: carry.size1_in(2)]
    carried = carry(corrected, outside, given, params)
    return ca.Function("carried", [corrected, outside, command, before, after, params], [carried])


def advance_unmeasured(loop: Loop, nominal: Nominal) -> ca.Function:
    """Return (memory, command) → memory after a period without measurement, under an external `command`.

    The observer restarts from its current estimates. Only for commands that are rotor forces: under a rate loop, the
    rotor forces depend on the body's rotation, which was not measured.
    """
    made = parts(loop, nominal)
    memory, command = ca.MX.sym("memory", made.own.length), ca.MX.sym("command", command_width(loop))
    after, under_way = made.own.split(memory), [command, *made.commands(memory)]
    if made.observes:
        after["observer"] = ca.vertcat(ca.MX(ca.DM.zeros(1)), after["observer"][1:])
    if made.finding is not None:
        after["delay"] = made.finding.skip()(after["delay"], after["rotors"])
    after |= {
        "rotors": _advance_rotors(loop, nominal, after["rotors"], under_way), "commands": ca.vertcat(*under_way[:-1])
    }  # fmt: skip
    return ca.Function("unmeasured", [memory, command], [made.own.join(after)])


def _advance_rotors(loop: Loop, nominal: Nominal, rotors: Numbers, under_way: Sequence[Any]) -> Numbers:
    """Return the modelled `rotors` one period later, under the rotor forces in transit."""
    for age, duration in _within(loop):
        rotors = _lag(nominal, round(1e9 * duration))(rotors, under_way[age])
    return rotors


def _lag(nominal: Nominal, nanoseconds: int) -> ca.Function:
    """Return (rotors, command) → rotors after a time under the command."""
    rotors, command = ca.SX.sym("r", nominal.rotors), ca.SX.sym("u", nominal.rotors)
    _, after = hold(rotors, command, step_timing(nominal.lag, nanoseconds / 1e9))
    return ca.Function(f"rotor_lag_{nanoseconds}", [rotors, command], [after])
