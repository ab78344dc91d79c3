"""The flight computer as one program: (memory, measurement, reference, gains, params) → (memory, command).

It is the source of the kernel of sampled flights (MuJoCo included), the Python reference, and the exported C. In each
control period it estimates the state, if the plant has sensors, and external forces; it predicts the state at which its
command will be applied, evaluates the law there, allocates the wrench to the rotors, adds lead, and advances its rotor
model and its queue of commands in transit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from flypend.board import observer as observing
from flypend.board.believed import Believed
from flypend.board.command import command_width, idle_command, law_command, steering, usable_lead
from flypend.board.delay import DelayEstimator
from flypend.board.differences import Differences
from flypend.board.estimator import Filter, assumed_delay, assumed_segments
from flypend.board.twin import Twin
from flypend.model.state import SIZE
from flypend.plants.lag import held, step_timing
from flypend.plants.loop import Loop
from flypend.plants.plant import Plant
from flypend.plants.schedule import Segment, ahead, within_period
from flypend.plants.sensing import readings_size


@dataclass(frozen=True, eq=False)
class Board:
    """The flight computer of a loop.

    Parameters
    ----------
    loop : Loop
        Vehicle, law and plant.
    believed : Believed
        The nominal vehicle of its equations.
    reference : int
        Length of the reference input at every step.
    step : Function
        (memory, measurement, reference, gains, params) → (memory, command): `predicting`, `law_command` and
        `remembering` in sequence. A measurement is time (s) and state (24,), e₃ up; with sensors, it is time and
        readings (see `plants.sensing`), and the estimator's `correct` comes first and its `carry` last.
    """

    loop: Loop
    believed: Believed
    reference: int
    step: ca.Function


def initial_memory(loop: Loop, rotors: Any, estimate: Any = None, believed: Believed | None = None) -> Any:
    """Return the memory (k,) of the board of `loop` before its first step, for current rotor forces `rotors` (n,), N.

    Numbers or CasADi symbols. A plant with sensors needs an `estimate` (24,) of the state to begin with, e₃ up, and the
    `believed` vehicle, by default that of `loop`.
    """
    believed = believed or Believed.numbers(loop.vehicle)
    finding = delay_estimator(loop, believed)
    late = np.zeros(0) if finding is None else finding.begun(rotors)
    parts = [rotors, np.zeros(observer_memory(loop)), late, *[idle_command(loop, rotors)] * depth(loop)]
    if (filtering := estimator(loop, believed)) is not None:
        begun = filtering.begun()(rotors, estimate, believed.symbols if believed.symbols.numel() else [])
        parts.append(begun if isinstance(rotors, ca.SX) else begun.full().ravel())
    return ca.vertcat(*parts) if isinstance(rotors, ca.SX) else np.concatenate(parts)


def known(plant: Plant) -> Plant:
    """Return what a flight computer knows of its `plant`: rate, limits, interface, rate loop; nothing of the world.

    With sensors it knows these, and the delay that its estimator assumes.
    """
    sensors = plant.sensors
    if sensors is not None:
        sensors = sensors.replace(command_delay=assumed_delay(plant))
    return Plant(
        rate=plant.rate, limits=plant.limits, interface=plant.interface, rate_loop_rate=plant.rate_loop_rate,
        rate_loop_gain=plant.rate_loop_gain, sensors=sensors,
    )  # fmt: skip


def estimator(loop: Loop, believed: Believed) -> Filter | Differences | None:
    """Return the estimator of `loop`, as `believed`; None for a plant that measures the state itself."""
    sensors = loop.sampled.sensors
    if sensors is None:
        return None
    return Filter(loop, believed) if filters(loop.sampled) else Differences(loop, believed)


def observer_memory(loop: Loop) -> int:
    """Return the size of the observer's memory. There is none beside a `Filter`, which estimates the forces itself."""
    return observing.MEMORY if loop.law.computer.observer > 0 and not filters(loop.sampled) else 0


def finds_delay(loop: Loop) -> bool:
    """Whether the board of `loop` finds its delay in flight; not under a rate loop, whose forces it does not know."""
    return loop.law.computer.delay_reach > 0 and loop.sampled.interface != "rates"


def delay_estimator(loop: Loop, believed: Believed) -> DelayEstimator | None:
    """Return what finds delays in `loop`, as `believed`; None if the law has no reach, or the vehicle a rate loop."""
    if not finds_delay(loop):
        return None
    computer, lead = loop.law.computer, usable_lead(loop.law, loop.vehicle, loop.sampled)
    left = 0.0 if computer.models_lag else believed.lag / lead
    return DelayEstimator(believed, computer.latency, computer.delay_reach, 1 / loop.sampled.rate, left)


def filters(plant: Plant) -> bool:
    """Whether the board in `plant` has a `Filter`."""
    return plant.sensors is not None and plant.sensors.rates == "estimated"


def depth(loop: Loop) -> int:
    """Return the number of commands to remember: all that are applied from now until the next one takes effect."""
    assumed = () if loop.sampled.sensors is None else assumed_segments(loop.sampled)
    return max(1, *(segment.age for segment in (*_ahead(loop), *_within(loop), *assumed)))


def memory_size(loop: Loop) -> int:
    """Return the size of the memory that the board keeps between steps, the estimator's excepted."""
    return len(loop.vehicle.rotor_spins) + kept_memory(loop) + depth(loop) * command_width(loop)


def found_delay(loop: Loop, memory: Any) -> float | None:
    """Return the delay, s, that the board of `loop` has found, from its `memory`; None if it does not look for it."""
    if (finding := delay_estimator(loop, Believed.numbers(loop.vehicle))) is None:
        return None
    first = len(loop.vehicle.rotor_spins) + observer_memory(loop)
    return finding.delay(memory[first : first + finding.size])


def kept_memory(loop: Loop) -> int:
    """Return the size of the memory of observer and delay estimator, between rotors and commands."""
    finding = delay_estimator(loop, Believed.numbers(loop.vehicle))
    return observer_memory(loop) + (0 if finding is None else finding.size)


def board(
    loop: Loop, believed: Believed | None = None, command: ca.Function | None = None, reference: int = 0
) -> Board:
    """Build the flight computer of `loop`.

    Parameters
    ----------
    loop : Loop
        Vehicle, bound law, sampled plant, and the input gains. Of the plant, only what a flight computer knows is used:
        rate, limits, interface, and rate and gain of the rate loop.
    believed : Believed, optional
        The nominal vehicle of the equations; default the vehicle of `loop`, as numbers.
    command : Function, optional
        Replacement for `law_command`, with the same inputs; default the law about its own reference.
    reference : int
        Length of the reference input of `command`.
    """
    believed = believed or Believed.numbers(loop.vehicle)
    predict, remember = predicting(loop, believed), remembering(loop, believed)
    command = command or law_command(loop, believed, steering(loop.symbolic))
    filtering, own = estimator(loop, believed), memory_size(loop)
    size, read = (0, SIZE) if filtering is None else (filtering.size, readings_size(loop.sampled.sensors))
    whole, measurement = ca.MX.sym("memory", own + size), ca.MX.sym("measurement", 1 + read)
    path, gains = ca.MX.sym("reference", reference), ca.MX.sym("gains", len(loop.parameters))
    params = ca.MX.sym("params", believed.symbols.numel())
    memory, measured = whole, measurement
    if filtering is not None:
        memory = whole[:own]
        corrected, state, outside = filtering.correct()(whole[own:], measurement[1:], params)
        measured = ca.vertcat(measurement[0], state)
    estimated = [outside] if filters(loop.sampled) else []
    kept, forces, state, rotors, horizon = predict(memory, measured, params, *estimated)
    # CasADi returns a call whose value is always 0 as a sparse vector, which would leave the last command in place.
    given = ca.densify(command(measured[0], horizon, state, rotors, forces, path, gains, params))
    after = remember(memory, kept, measured, forces, given, params)
    if filtering is not None:
        commands = ca.vertcat(given, *_parts(loop, memory)[2])
        carry = filtering.carry()
        after = ca.vertcat(after, carry(corrected, outside, commands[: carry.size1_in(2)], params))
    memory = whole
    names = (["memory", "measurement", "reference", "gains", "params"], ["memory_after", "command"])
    step = ca.Function("board", [memory, measurement, path, gains, params], [after, given], *names)
    return Board(loop, believed, reference, step)


def _ahead(loop: Loop) -> tuple[Segment, ...]:
    return ahead(_in_transit(loop), 1 / loop.sampled.rate)


def _within(loop: Loop) -> tuple[Segment, ...]:
    return within_period(_in_transit(loop), 1 / loop.sampled.rate)


def _in_transit(loop: Loop) -> float:
    """Return for how long, s, the board's rotor model holds a command back: not at all where the delay is found."""
    return 0.0 if finds_delay(loop) else loop.law.computer.latency


def _parts(loop: Loop, memory: Any) -> tuple[Any, Any, Sequence[Any]]:
    """Return modelled rotors, observer memory, and the commands in transit, newest first."""
    n, k, width = len(loop.vehicle.rotor_spins), kept_memory(loop), command_width(loop)
    ends = [0, n, n + k, *(n + k + width * (i + 1) for i in range(depth(loop)))]
    rotors, kept, *commands = ca.vertsplit(memory, ends)
    return rotors, kept, commands


def predicting(loop: Loop, believed: Believed) -> ca.Function:
    """Return (memory, measurement, params) → kept memory, forces (6,), state (24,), rotors (n,), and horizon (s).

    State and rotors are those after the horizon, when the next command is taken to act.

    With a `Filter` there is one more input, the forces (6,) that it estimates, in place of the observer.
    """
    memory, measurement = ca.MX.sym("memory", memory_size(loop)), ca.MX.sym("measurement", 1 + SIZE)
    params = ca.MX.sym("params", believed.symbols.numel())
    rotors, kept, commands = _parts(loop, memory)
    state, forces, horizon = measurement[1:], ca.MX(ca.DM.zeros(6)), ca.MX(loop.law.computer.latency)
    given = [ca.MX.sym("forces", 6)] if filters(loop.sampled) else []
    if given and loop.law.computer.observer > 0:
        forces = given[0]
    observed, finding, thrusts = observer_memory(loop), delay_estimator(loop, believed), rotors
    observer_kept, late = kept[:observed], kept[observed:]
    if finding is not None:
        late, horizon, wrenches = finding.find()(late, state[15:18], rotors, commands[0], params)
        thrusts = wrenches[0, 2]
    if observed:
        observe = observing.observer(believed, loop.law.computer, 1 / loop.sampled.rate, thrusts.numel())
        observer_kept, forces = observe(state, thrusts, observer_kept, params)
    if finding is not None:
        state = finding.carry()(state, horizon, wrenches, forces, params)
    kept = ca.vertcat(observer_kept, late)
    under_way = [None, *commands]  # this step's command, of age 0, is yet to come
    state, rotors = _twin(loop, believed, params).advance(state, rotors, under_way, _ahead(loop), forces)
    return ca.Function("predict", [memory, measurement, params, *given], [kept, forces, state, rotors, horizon])


def _twin(loop: Loop, believed: Believed, params: Any) -> Twin:
    return Twin(loop, believed, params, forces=loop.law.computer.observer > 0)


def remembering(loop: Loop, believed: Believed) -> ca.Function:
    """Return (memory, observer memory, measurement, forces, command, params) → memory."""
    memory, measurement = ca.MX.sym("memory", memory_size(loop)), ca.MX.sym("measurement", 1 + SIZE)
    kept, forces = ca.MX.sym("kept", kept_memory(loop)), ca.MX.sym("forces", 6)
    command, params = ca.MX.sym("command", command_width(loop)), ca.MX.sym("params", believed.symbols.numel())
    rotors, _, commands = _parts(loop, memory)
    under_way = [command, *commands]
    if loop.sampled.interface == "rates":  # the rate loop's rotor commands depend on the rotation
        twin = _twin(loop, believed, params)
        _, rotors = twin.advance(measurement[1:], rotors, under_way, _within(loop), forces)
    else:
        rotors = _lagged(loop, believed, rotors, under_way)
    after = ca.vertcat(rotors, kept, *under_way[: depth(loop)])
    return ca.Function("remember", [memory, kept, measurement, forces, command, params], [after])


def unmeasured(loop: Loop, believed: Believed) -> ca.Function:
    """Return (memory, command) → memory after a period without measurement, under an external `command`.

    The observer restarts from its current estimates. Only for commands that are rotor forces: under a rate loop, the
    rotor forces depend on the body's rotation, which was not measured.
    """
    memory, command = ca.MX.sym("memory", memory_size(loop)), ca.MX.sym("command", command_width(loop))
    rotors, kept, commands = _parts(loop, memory)
    observed, finding = observer_memory(loop), delay_estimator(loop, believed)
    zero = ca.MX(ca.DM.zeros(1))
    parts = [ca.vertcat(zero, kept[1:observed])] if observed else []
    if finding is not None:
        parts.append(finding.skipped()(kept[observed:], rotors))
    kept = ca.vertcat(*parts)
    under_way = [command, *commands]
    rotors = _lagged(loop, believed, rotors, under_way)
    after = ca.vertcat(rotors, kept, *under_way[: depth(loop)])
    return ca.Function("unmeasured", [memory, command], [after])


def _lagged(loop: Loop, believed: Believed, rotors: Any, under_way: Sequence[Any]) -> Any:
    """Return the modelled `rotors` one period later, under the rotor forces in transit."""
    for age, duration in _within(loop):
        rotors = _lag(believed, round(1e9 * duration))(rotors, under_way[age])
    return rotors


def _lag(believed: Believed, nanoseconds: int) -> ca.Function:
    """Return (rotors, command) → rotors after a time under the command."""
    rotors, command = ca.SX.sym("r", believed.rotors), ca.SX.sym("u", believed.rotors)
    _, after = held(rotors, command, step_timing(believed.lag, nanoseconds / 1e9))
    return ca.Function(f"rotor_lag_{nanoseconds}", [rotors, command], [after])
