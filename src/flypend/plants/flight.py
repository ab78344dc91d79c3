"""One sampled flight: measure, command, hold, with whatever the plant puts in between."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from flypend.geometry import project_tangent, unit
from flypend.integrate import MAX_STATE, Outcome
from flypend.laws.law import Controller, Law
from flypend.model import State, Vehicle
from flypend.model.state import FLIP_PACKED, split
from flypend.plants.actuation import Actuation, make_engine
from flypend.plants.computer import FlightComputer, idle_command
from flypend.plants.plant import Noise, Plant, Wind


@dataclass(frozen=True)
class Samples:
    """A sampled flight at its control ticks: `t` (n,), `packed` (n, 24) and `rotors` (n, k) with e₃ up, `outcome`."""

    t: Any
    packed: Any
    rotors: Any
    outcome: Outcome


def fly(vehicle: Vehicle, law: Law | Controller, start: State, duration: float, plant: Plant) -> Samples:
    """Fly `vehicle`, as the law knows it, from `start` (in the law's frame) through `plant` for `duration` seconds.

    Rotors start at their least force. Every quantity is recorded at each control tick.
    """
    rng = np.random.default_rng(plant.seed)
    engine = make_engine(plant.true_vehicle(vehicle), plant)
    packed = start.packed() * (1.0 if law.e3 == "up" else FLIP_PACKED)
    engine.reset(packed, np.full(len(vehicle.rotor_spins), vehicle.rotor_limits[0]))
    world = Actuation(engine, vehicle, plant)
    computer = FlightComputer(law, vehicle, plant)
    gusts = _Gusts(plant.wind, 1 / plant.rate, rng)

    period, ticks = 1 / plant.rate, max(1, round(duration * plant.rate))
    states, rotors = [engine.packed], [engine.rotors]
    active, queue = idle_command(vehicle, plant), deque[tuple[float, Any]]()
    outcome = Outcome("completed", ticks * period)
    with np.errstate(all="ignore"):
        for k in range(ticks):
            t, end = k * period, (k + 1) * period
            measured = _measure(engine.packed, plant.noise, rng)
            command = computer.command(t, measured)
            if not np.isfinite(np.sum(command)):
                outcome = Outcome("singular", t, "the law's wrench is not a finite number")
                break
            queue.append((t + plant.delay, command))
            computer.tick(t, measured)
            wind = gusts.next()
            while queue and queue[0][0] < end - 1e-9:
                arrival, command = queue.popleft()
                if arrival > t + 1e-9:
                    world.advance(active, arrival - t, wind)
                    t = arrival
                active = command
            world.advance(active, end - t, wind)
            states.append(engine.packed)
            rotors.append(engine.rotors)
            if not (np.all(np.isfinite(engine.packed)) and np.max(np.abs(engine.packed)) < MAX_STATE):
                states.pop(), rotors.pop()
                outcome = Outcome("diverged", k * period, f"the state left |s| < {MAX_STATE:g}")
                break
    return Samples(np.arange(len(states)) * period, np.array(states), np.array(rotors), outcome)


def _measure(packed: Any, noise: Noise | None, rng: np.random.Generator) -> Any:
    """The packed state (24,) as measured: on the manifold, with the noise added."""
    if noise is None:
        return packed
    s = split(packed)
    draw = rng.standard_normal((6, 3))
    y = unit(s["y"] + noise.y * project_tangent(s["y"], draw[4]))
    return np.concatenate(
        [
            s["x"] + noise.x * draw[0],
            s["x_dot"] + noise.x_dot * draw[1],
            (s["R"] @ Rotation.from_rotvec(noise.attitude * draw[2]).as_matrix()).ravel(),
            s["omega"] + noise.omega * draw[3],
            y,
            project_tangent(y, s["y_dot"] + noise.y_dot * draw[5]),
        ]
    )


class _Gusts:
    """Forces on vehicle and bob (6,), one value per control period: the constant wind and a first-order gust."""

    def __init__(self, wind: Wind | None, period: float, rng: np.random.Generator) -> None:
        self._rng = rng
        if wind is None:
            self._mean, self._sigma, self._decay = np.zeros(6), np.zeros(6), 0.0
        else:
            self._mean = np.array([*wind.on_vehicle, *wind.on_bob])
            self._sigma = np.repeat([wind.gust_on_vehicle, wind.gust_on_bob], 3)
            self._decay = float(np.exp(-period / wind.gust_time))
        self._gust = np.zeros(6)
        self._still = not np.any(self._sigma)

    def next(self) -> Any:
        if self._still:
            return self._mean
        innovation = np.sqrt(1 - self._decay**2) * self._sigma * self._rng.standard_normal(6)
        self._gust = self._decay * self._gust + innovation
        return self._mean + self._gust
