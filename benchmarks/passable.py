"""From how many free starts of the random box a rod on a hub can stand: `python -m benchmarks.passable [runs] [seed]`.

hehn2011 on a hub, rotors plant, the starts of `benchmarks.mounts`. Counts from how many the tuned law stands untouched,
the learned law, and a plan of eight guesses (rod clear by `GAP`); from how many any of them; and, for the others,
whether some of many random rotor commands keep the rod clear for `AHEAD` seconds, and a law stands from there. Where
none keeps it clear, the rod touches whatever the rotors do, as far as a search can tell. Some seconds a start.
"""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

import flypend as fp
from benchmarks.mounts import DURATION, free
from flypend.envs import environment
from flypend.envs.kernel import Worlds
from flypend.flight.metrics import wilson
from flypend.studies.starts import random_starts

GAP = 1e-3  # m; one that is touched at the start, or is left within a moment, cannot be kept larger
AHEAD, SHUT, RATE, HELD = 0.24, 0.06, 100.0, 2  # s, s, Hz, actions for which a command is held
SHOTS, ROUNDS, BEST, LEAST_CHANCE = 2048, 8, 100, 0.05
HANDED = 32  # of what keeps clear, so many are handed to the laws


class Shooting:
    """Random commands, each rotor at one of its limits, from a start; the chances of each follow those that last.

    In the last `SHUT` seconds all rotors push least, as they do when a flight begins.
    """

    def __init__(self, vehicle: fp.Vehicle, seed: int) -> None:
        self.vehicle, self.rng = vehicle, np.random.default_rng(seed)
        self.worlds = Worlds(environment("swing_up", vehicle=vehicle, rate=RATE, duration=2 * AHEAD), SHOTS)
        self.rotors, self.periods = len(vehicle.rotor_spins), round((AHEAD - SHUT) * RATE / HELD)

    def survivors(self, start: fp.State) -> tuple[float, fp.State | None]:
        """Return how long the best keeps clear, s, and the states of those that do to the end, if any."""
        chances = np.full((self.periods, self.rotors), 0.5)
        longest = 0
        for _ in range(ROUNDS):
            high = self.rng.random((SHOTS, *chances.shape)) < chances
            lasted = self._lasted(start, high)
            longest = max(longest, int(lasted.max()))
            if longest == round(AHEAD * RATE):
                kept = self.worlds.states[lasted == longest][:HANDED, :24]
                return AHEAD, fp.State.trusted(kept)
            best = np.argsort(-lasted, kind="stable")[:BEST]
            chances = np.clip(high[best].mean(axis=0), LEAST_CHANCE, 1 - LEAST_CHANCE)
        return longest / RATE, None

    def _lasted(self, start: fp.State, high: NDArray[np.bool_]) -> NDArray[np.int64]:
        """Return after how many actions each world has touched."""
        worlds, least = self.worlds, np.full(self.rotors, self.vehicle.rotor_limits[0])
        worlds.begin(np.arange(SHOTS))
        begun = np.concatenate([start.packed(), least])
        worlds.arrays["memories"][:, 2 : 2 + len(begun)] = begun[:, None]
        alive, lasted = np.ones(SHOTS, dtype=bool), np.zeros(SHOTS, dtype=int)
        for k in range(round(AHEAD * RATE)):
            period = k // HELD
            chosen: Any = high[:, period] if period < self.periods else np.zeros((SHOTS, self.rotors))
            worlds.step(2.0 * chosen - 1.0)
            alive &= ~worlds.terminated
            lasted += alive
        return lasted


def told(what: str, count: int, runs: int) -> None:
    """Print a count with its interval."""
    low, high = wilson(count, runs)
    print(f"{what}: {count} of {runs} ({low:.1%} to {high:.1%})", flush=True)


def main() -> None:
    """Print the counts."""
    runs, seed = (int(value) for value in (sys.argv[1:] + ["200", "51017"][len(sys.argv) - 1 :]))
    vehicle = fp.vehicle("hehn2011").replace(mount="hub")
    starts = free(random_starts(2 * runs, seed), vehicle)[:runs]
    laws = [fp.laws.inverted(), fp.laws.learned()]

    def stands(law: fp.Law, states: fp.State) -> NDArray[np.bool_]:
        return fp.simulate_ensemble(vehicle, law, states, DURATION, plant="rotors").success

    flown = [stands(law, starts) for law in laws]
    planned = fp.plan_ensemble(vehicle, starts, clearance=GAP, guesses=8).success
    passed = planned | flown[0] | flown[1]
    for what, found in (("tuned law", flown[0]), ("learned law", flown[1]), ("plans", planned), ("any", passed)):
        told(what, int(found.sum()), runs)
    shooting, clear, handed = Shooting(vehicle, seed), np.ones(runs, dtype=bool), passed.copy()
    for i in np.flatnonzero(~passed):
        _, states = shooting.survivors(starts[i])
        clear[i] = states is not None
        handed[i] = clear[i] and any(stands(law, states).any() for law in laws)
    told("any, or commands and then a law", int(handed.sum()), runs)
    told("clear at first by some commands", int(clear.sum()), runs)


if __name__ == "__main__":
    main()
