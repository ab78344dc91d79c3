"""The flight of a setting, and those of its map: the region of attraction over initial directions of the rod.

Through a sampled plant a setting flies in pieces, between which pokes strike; else in parts. Each poke ends one part,
and the state it leaves starts the next: all that there is to the ideal plant. A law that is a Python function begins
its flight computer anew.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from flypend.building import built
from flypend.compile.numeric import as_numpy
from flypend.flight.ensemble import fly_many
from flypend.flight.kernels import IdealKernel
from flypend.flight.kernels.launch import Solution, last_tick, sampled_samples
from flypend.flight.kernels.pieces import PiecesKernel
from flypend.flight.live import PERIOD
from flypend.flight.outcome import NOT_ENOUGH, Outcome
from flypend.flight.request import Flight
from flypend.flight.sampled import Samples, fly_stepwise, nearest_ticks, number_of_ticks
from flypend.flight.simulate import record_run
from flypend.flight.trajectory import Trajectory
from flypend.lab.setting import Poke, Setting
from flypend.lab.tuning import Stepped, Tell, Tuned, in_pieces, tune_loop, values
from flypend.model import State, Vehicle
from flypend.model.state import SHAPES, SIZE, E3Direction, convert_packed, split
from flypend.pages.offers import directions
from flypend.plants import Sampled
from flypend.plants.equations import struck

MOST_STEPS = 20_000  # of the ideal plant, over all parts of a flight; usual gains need less than 1,000 for 30 s
SPENT = f"the laboratory stops a flight after {MOST_STEPS:,} integration steps; flypend run does not"
# Of a map: its flights, how many of them the first and the largest chunk have.
RUNS = {"ideal": 3000, "sampled": 1200, "stepped": 96}
FIRST, MOST = {"ideal": 16, "sampled": 16, "stepped": 2}, {"ideal": 256, "sampled": 64, "stepped": 8}
CHUNK_TIME = 0.1  # s of processor time that a chunk should take, to be seen as it comes


def fly(setting: Setting, tell: Tell = lambda: None) -> Trajectory:
    """Fly `setting`, pokes included, and return the trajectory in the frame of its law.

    The flight continues for the duration of the setting after the last poke. `tell` is called before a compilation.
    A flight ends after MOST_STEPS.
    """
    flight = setting.flight
    machine, gains = tune_loop(setting, tell), values(setting)
    if isinstance(machine, Stepped) or isinstance(machine.kernel, IdealKernel):
        parts = list(_fly_parts(setting, machine, gains))
    elif setting.pokes:
        parts = [_fly_through_pokes(setting, machine, in_pieces(machine, tell), gains)]
    else:
        lasting = max(flight.duration, 1 / machine.kernel.loop.sampled.rate)
        parts = [sampled_samples(machine.kernel, flight.replace(duration=lasting), gains)]
    return _trajectory(setting, machine, gains, parts)


def _fly_parts(setting: Setting, machine: Tuned | Stepped, gains: Any) -> Iterator[Samples]:
    """Fly from poke to poke, each part from the state that the blow leaves, and yield the parts in flight time."""
    flight, e3 = setting.flight, machine.law.e3
    begin, state, rotors, left = 0.0, flight.starts, None, MOST_STEPS
    for number, poke in enumerate((*setting.pokes, None)):
        lasting = flight.duration if poke is None else _struck_at(poke, flight) - begin
        if isinstance(machine, Stepped):
            noise = (flight.seed or 0) + number
            part = _fly_stepped(machine, flight.replace(starts=state, seed=noise), begin, lasting, rotors)
        else:
            part, steps = _fly_ideal(machine, gains, flight.replace(starts=state), begin, lasting, left)
            left -= steps
        keep = slice(min(number, 1), None)  # the blow has changed the first sample of a later part
        yield Samples(part.t[keep], part.packed[keep], part.rotors[keep], part.outcome)
        if poke is None or part.outcome.status != "completed":
            return
        state = poke_state(State(**split(part.packed[-1])), flight.vehicle, "up", poke).in_frame(e3)
        begin = float(part.t[-1]) if isinstance(flight.plant, Sampled) else _struck_at(poke, flight)
        rotors = part.rotors[-1]


def _fly_stepped(machine: Stepped, flight: Flight, begin: float, lasting: float, rotors: Any) -> Samples:
    """Fly one part of a flight in Python, from the rotor forces `rotors` (N): `lasting` s, but one tick at least."""
    assert isinstance(flight.plant, Sampled)
    rate = flight.plant.rate
    law = replace(machine.law, function=lambda t, state: machine.law.function(begin + t, state))
    part = flight.replace(law=law, duration=max(lasting, 1 / rate))
    flown = fly_stepwise(part, rotors).at(part.moments * rate)
    return replace(flown, t=begin + flown.t, outcome=replace(flown.outcome, time=begin + flown.outcome.time))


def _fly_ideal(
    machine: Tuned, gains: Any, flight: Flight, begin: float, lasting: float, left: int
) -> tuple[Samples, int]:
    """Fly one part of a flight in the ideal plant: `lasting` s, in at most `left` steps. Return how many it took."""
    if lasting == 0:
        t, packed, outcome, steps = np.array([begin]), flight.starts.packed()[None], Outcome("completed", begin), 0
    else:
        assert isinstance(machine.kernel, IdealKernel)
        part = flight.replace(duration=lasting, tolerances=replace(flight.tolerances, max_steps=max(left, 1)))
        solution = Solution(machine.kernel, part, gains, begin)
        outcome, t, steps = solution.outcome, begin + part.grid, len(solution.knots) - 1
        if outcome.reason.endswith(NOT_ENOUGH):
            outcome = replace(outcome, reason=SPENT)
        if outcome.status != "completed":
            t = np.append(t[t < outcome.time], outcome.time)
        packed = solution(t)
    columns = np.broadcast_to(gains[:, None], (len(gains), len(t)))
    wrench = np.array(machine.wrench(t[None], packed.T, columns)).T
    rotors = wrench @ machine.vehicle.unmixing(machine.law.e3).T
    return Samples(t, convert_packed(packed, machine.law.e3), rotors, outcome), steps


def _fly_through_pokes(setting: Setting, machine: Tuned, pieces: PiecesKernel, gains: Any) -> Samples:
    """Fly a sampled plant through all pokes: board, noise and commands in transit go on as if nothing had happened."""
    flight, plant = setting.flight, machine.kernel.loop.sampled
    ticks = [_tick(poke, 1 / plant.rate) for poke in setting.pokes]
    flown = pieces.begin(flight.starts, seed=flight.seed or 0, gains=dict(zip(machine.names, gains, strict=True)))
    last = ticks[-1] + number_of_ticks(flight.duration, plant)
    blows = [np.zeros(6), *(_impulses(poke, plant.true_vehicle(flight.vehicle)) for poke in setting.pokes)]
    rows, blow = [], np.zeros(6)
    for tick, impulses in zip((*ticks, last), blows, strict=True):
        blow = blow + impulses  # of pokes within one tick, all at once
        if flown.flying and tick > flown.ticks:
            rows.append(flown.advance(tick - flown.ticks, blow))
            blow = np.zeros(6)
    outcome, every = flown.outcome, np.concatenate(rows)
    end = min(last_tick(outcome, plant), len(every) - 1)
    whole = flight.replace(duration=last / plant.rate)
    kept = nearest_ticks(whole.moments, plant, whole.duration)
    kept = np.append(kept[kept < end], end)
    return Samples(kept / plant.rate, every[kept, :SIZE], every[kept, SIZE:], outcome)


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
    """Return `state` (frame `e3`) after the impulse of `poke`: x_dot and y_dot jump, all else stays."""
    after = _strike(vehicle)(state.in_frame(e3).packed(), _impulses(poke, vehicle))
    return State.trusted(after).in_frame(e3)


@built(maxsize=16)
def _strike(vehicle: Vehicle) -> Callable[..., Any]:
    """Return (state (24,), impulses (6,)) → state, with the pivot at the centre of mass, as the ideal plant has it."""
    return as_numpy(struck(vehicle.replace(pivot_offset=(0.0, 0.0, 0.0))))


def _trajectory(setting: Setting, machine: Tuned | Stepped, gains: Any, parts: list[Samples]) -> Trajectory:
    """Return the flight that the `parts` make in a row."""
    t, packed, rotors = (np.concatenate([getattr(part, name) for part in parts]) for name in ("t", "packed", "rotors"))
    plant, e3 = setting.flight.plant, machine.law.e3
    true = plant.true_vehicle(machine.vehicle) if isinstance(plant, Sampled) else machine.vehicle
    packed = convert_packed(packed, e3)
    return record_run(
        setting.law, machine.vehicle, t, packed, rotors @ true.mixing(e3).T, rotor_forces=rotors,
        outcome=parts[-1].outcome, signals=_signals(machine, gains, t, packed), gains=setting.gains,
    )  # fmt: skip


def _signals(machine: Tuned | Stepped, gains: Any, t: Any, packed: Any) -> dict[str, Any]:
    """Return V along a flight if its law has one: all that the page plots, without the rates, which take as long."""
    if isinstance(machine, Stepped) or machine.lyapunov is None:
        return {}
    columns = np.broadcast_to(gains[:, None], (len(gains), len(t)))
    return {"V": np.array(machine.lyapunov(t[None], packed.T, columns))[0]}


def region(setting: Setting, tell: Tell = lambda: None) -> Iterator[dict[str, Any]]:
    """Fly `setting` with the rod at rest in all directions, the rest of its start unchanged, and yield chunks.

    A chunk holds `total`, `done` and, for each of its flights, `y` (e₃ up), `settling` (s; None for a failure) and
    `cause`. A flight of more than MOST_STEPS counts as diverged.
    """
    flight = setting.flight
    machine, gains = tune_loop(setting, tell), values(setting)
    kind = "stepped" if isinstance(machine, Stepped) else "sampled" if isinstance(flight.plant, Sampled) else "ideal"
    count, done, size = RUNS[kind], 0, FIRST[kind]
    rods = directions(count)
    tuning = {name: float(value) for name, value in zip(machine.names, gains, strict=True)}
    exact = replace(flight.tolerances, max_steps=MOST_STEPS)
    while done < count:
        begun = time.thread_time()
        y = rods[done : done + size]
        own = _starts(setting.start, y).in_frame(machine.law.e3)
        request = flight.replace(
            law=machine.law, starts=own, gains=tuning, criterion=machine.criterion, tolerances=exact,
            seed=(flight.seed or 0) + done,
        )  # fmt: skip
        result = fly_many(request, workers=1)
        done += len(y)
        judged = zip(result.settling.tolist(), result.success, strict=True)
        yield {
            "total": count, "done": done, "y": np.round(y, 5).tolist(),
            "settling": [settling if good else None for settling, good in judged],
            "cause": [str(cause) for cause in result.cause],
        }  # fmt: skip
        took = max(time.thread_time() - begun, 1e-3)
        size = int(np.clip(size * CHUNK_TIME / took, FIRST[kind], min(2 * size, MOST[kind])))


def _starts(start: State, y: Any) -> State:
    given = {name: np.broadcast_to(getattr(start, name), (len(y), *SHAPES[name])) for name in SHAPES}
    return State(**{**given, "y": y, "y_dot": np.zeros_like(y)})
