"""The flight of a setting: through a sampled plant in pieces, between which pokes strike; else in parts.

Each poke ends one part, and the state it leaves starts the next: all that there is to the ideal plant. A law that is a
Python function begins its flight computer anew.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from flypend.flight.kernels import IdealKernel, SampledKernel
from flypend.flight.kernels.launch import Solution, sampled_samples
from flypend.flight.kernels.pieces import PiecesKernel
from flypend.flight.live import PERIOD
from flypend.flight.outcome import NOT_ENOUGH, Outcome
from flypend.flight.request import Flight
from flypend.flight.sampled import Samples, fly_stepwise, nearest_ticks, number_of_ticks
from flypend.flight.simulate import record_run
from flypend.flight.trajectory import Trajectory
from flypend.lab.setting import Poke, Setting, in_frame
from flypend.lab.tuning import Stepped, Tell, Tuned, in_pieces, tune_loop, values
from flypend.model import Disturbance, State, Vehicle, Wrench, disturbed_motion
from flypend.model.state import SIZE, E3Direction, convert_packed, split
from flypend.plants import Sampled

STILL = Wrench(0.0, np.zeros(3))
MOST_STEPS = 20_000  # of the ideal plant, over all parts of a flight; usual gains need less than 1,000 for 30 s
SPENT = f"the laboratory stops a flight after {MOST_STEPS:,} integration steps; flypend run does not"


@dataclass(frozen=True)
class Part:
    """Samples between two pokes: time since the start of the part, packed states, rotor forces, wrench, outcome.

    `steps` are the integration steps in the ideal plant.
    """

    t: Any
    packed: Any
    rotors: Any
    wrench: Any
    outcome: Outcome
    steps: int = 0


def fly(setting: Setting, tell: Tell = lambda: None) -> Trajectory:
    """Fly `setting`, pokes included, and return the trajectory in the frame of its law.

    The flight continues for the duration of the setting after the last poke. `tell` is called before a compilation.
    A flight ends after MOST_STEPS.
    """
    flight = setting.flight
    machine, gains = tune_loop(setting, tell), values(setting)
    if setting.pokes and isinstance(machine, Tuned) and isinstance(machine.kernel, SampledKernel):
        return _trajectory(
            setting, machine, gains, [_fly_through_pokes(setting, machine, in_pieces(machine, tell), gains)]
        )
    begin, state, rotors, number = 0.0, flight.starts, None, 0
    parts: list[Part] = []
    for poke in (*setting.pokes, None):
        while_ = flight.duration if poke is None else _struck_at(poke, flight) - begin
        left = MOST_STEPS - sum(part.steps for part in parts)
        request = flight.replace(tolerances=replace(flight.tolerances, max_steps=max(left, 1)))
        part = _after(machine, gains, request, state, rotors, while_, number)
        parts.append(_move(part, begin, first=not parts))
        if poke is None or part.outcome.status != "completed":
            break
        end = State(**split(part.packed[-1]))
        state = poke_state(end, flight.vehicle, machine.law.e3, poke)
        begin = begin + float(part.t[-1]) if isinstance(flight.plant, Sampled) else _struck_at(poke, flight)
        rotors, number = part.rotors[-1], number + 1
    return _trajectory(setting, machine, gains, parts)


def _fly_through_pokes(setting: Setting, machine: Tuned, pieces: PiecesKernel, gains: Any) -> Part:
    """Fly a sampled plant through all pokes: board, noise and commands in transit go on as if nothing had happened."""
    flight, plant = setting.flight, machine.kernel.loop.sampled
    ticks = [_tick(poke, 1 / plant.rate) for poke in setting.pokes]
    flown = pieces.begin(flight.starts, seed=flight.seed or 0, gains=dict(zip(machine.names, gains, strict=True)))
    last = ticks[-1] + number_of_ticks(flight.duration, plant)
    blows = [np.zeros(6), *(_impulses(poke, plant.true_vehicle(flight.vehicle)) for poke in setting.pokes)]
    rows, blow = [], np.zeros(6)
    for tick, struck in zip((*ticks, last), blows, strict=True):
        blow = blow + struck  # of pokes within one tick, all at once
        if flown.flying and tick > flown.ticks:
            rows.append(flown.advance(tick - flown.ticks, blow))
            blow = np.zeros(6)
    outcome, every = flown.outcome, np.concatenate(rows)
    end = min(int(np.floor(outcome.time * plant.rate + 1e-6)), len(every) - 1)
    whole = flight.replace(duration=last / plant.rate)
    kept = nearest_ticks(whole.moments, plant, whole.duration)
    kept = np.append(kept[kept < end], end)
    samples = Samples(kept / plant.rate, every[kept, :SIZE], every[kept, SIZE:], outcome)
    return _part_from(samples, flight, plant)


def _impulses(poke: Poke, vehicle: Vehicle) -> Any:
    """Return the impulses (6,) of `poke` on vehicle and bob, N s, e₃ up."""
    blow = poke.velocity * (vehicle.bob_mass if poke.on == "bob" else vehicle.mass)
    return np.concatenate([np.zeros(3), blow] if poke.on == "bob" else [blow, np.zeros(3)])


def _struck_at(poke: Poke, flight: Flight) -> float:
    """Return the time of `poke`, s; in the ideal plant, at the row of a page that is nearest."""
    return poke.time if isinstance(flight.plant, Sampled) else PERIOD * _tick(poke, PERIOD)


def _tick(poke: Poke, period: float) -> int:
    """Return the tick of `period` (s) that is nearest to `poke`, of two the later, as pages round."""
    return int(np.floor(poke.time / period + 0.5))


def poke_state(state: State, vehicle: Vehicle, e3: E3Direction, poke: Poke) -> State:
    """Return `state` (frame `e3`) after the impulse of `poke`: x_dot and y_dot jump, all else stays.

    The accelerations are affine in the external force, so the jump is the acceleration with the force, minus that
    without it, times one second.
    """
    mass = vehicle.bob_mass if poke.on == "bob" else vehicle.mass
    blow = Disturbance(**{f"force_on_{poke.on}": mass * in_frame(poke.velocity, e3)})
    hit, free = disturbed_motion(state, STILL, vehicle, e3, blow), disturbed_motion(state, STILL, vehicle, e3)
    return State(
        x=state.x, x_dot=state.x_dot + hit.x_ddot - free.x_ddot, R=state.R, omega=state.omega, y=state.y,
        y_dot=state.y_dot + hit.y_ddot - free.y_ddot,
    )  # fmt: skip


def _after(
    machine: Tuned | Stepped, gains: Any, flight: Flight, state: State, rotors: Any, duration: float, number: int
) -> Part:
    """Fly part `number`: from `state` and the rotor forces `rotors` (N), for `duration` s, with its own noise."""
    if isinstance(flight.plant, Sampled):
        duration = max(duration, 1 / flight.plant.rate)
    elif duration == 0 and isinstance(machine, Tuned):
        return _part_of(machine, gains, np.zeros(1), state.packed()[None], Outcome("completed", 0.0))
    part = flight.replace(starts=state, duration=duration, seed=(flight.seed or 0) + number)
    if isinstance(machine, Stepped):
        assert isinstance(part.plant, Sampled)
        stepped = fly_stepwise(part.replace(law=machine.law), rotors).at(part.moments * part.plant.rate)
        return _part_from(stepped, part, part.plant)
    if isinstance(machine.kernel, SampledKernel):
        samples = sampled_samples(machine.kernel, part, gains, rotors)
        return _part_from(samples, part, machine.kernel.loop.sampled)
    return _ideal_part(machine, machine.kernel, gains, part)


def _ideal_part(machine: Tuned, kernel: IdealKernel, gains: Any, flight: Flight) -> Part:
    """Fly one part of a flight in the ideal plant."""
    solution = Solution(kernel, flight, gains)
    outcome, t = solution.outcome, flight.grid
    if outcome.reason.endswith(NOT_ENOUGH):
        outcome = replace(outcome, reason=SPENT)
    if outcome.status != "completed":
        t = np.append(t[t < outcome.time], outcome.time)
    return replace(_part_of(machine, gains, t, solution(t), outcome), steps=len(solution.knots) - 1)


def _part_of(machine: Tuned, gains: Any, t: Any, packed: Any, outcome: Outcome) -> Part:
    """Return the part with states `packed` (k, 24) at `t` (k,), s, and the wrenches that the law gave there."""
    columns = np.broadcast_to(gains[:, None], (len(gains), len(t)))
    wrench = np.array(machine.wrench(t[None], packed.T, columns)).T
    rotors = wrench @ machine.vehicle.unmixing(machine.law.e3).T
    return Part(t, packed, rotors, wrench, outcome)


def _part_from(samples: Samples, flight: Flight, plant: Sampled) -> Part:
    e3, true = flight.law.e3, plant.true_vehicle(flight.vehicle)
    packed = convert_packed(samples.packed, e3)
    return Part(samples.t, packed, samples.rotors, samples.rotors @ true.mixing(e3).T, samples.outcome)


def _move(part: Part, begin: float, *, first: bool) -> Part:
    """Shift `part` to flight time; unless it is the `first`, without its first sample, which the blow has changed."""
    keep = slice(None) if first else slice(1, None)
    outcome = Outcome(part.outcome.status, begin + part.outcome.time, part.outcome.reason)
    return Part(begin + part.t[keep], part.packed[keep], part.rotors[keep], part.wrench[keep], outcome)


def _trajectory(setting: Setting, machine: Tuned | Stepped, gains: Any, parts: list[Part]) -> Trajectory:
    """Return the flight that the `parts` make in a row."""
    t, packed, rotors, wrench = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("t", "packed", "rotors", "wrench")
    )
    return record_run(
        setting.law, machine.vehicle, t, packed, wrench[:, :4], rotor_forces=rotors, outcome=parts[-1].outcome,
        signals=_signals(machine, gains, t, packed), gains=setting.gains,
    )  # fmt: skip


def _signals(machine: Tuned | Stepped, gains: Any, t: Any, packed: Any) -> dict[str, Any]:
    """Return V along a flight if its law has one: all that the page plots, without the rates, which take as long."""
    if isinstance(machine, Stepped) or machine.lyapunov is None:
        return {}
    columns = np.broadcast_to(gains[:, None], (len(gains), len(t)))
    return {"V": np.array(machine.lyapunov(t[None], packed.T, columns))[0]}
