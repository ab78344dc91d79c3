"""A law learned within bands beside the tuned law and the shipped one: `python -m benchmarks.learned_bands [folder]`.

hehn2011, known about as well as a scale, a ruler and a guess tell, flies 200 random starts of 15 s with the sensors
mocap: as written, and as four machines drawn from its bands that the training has not seen. Without a policy.npz in the
folder, the law is learned first, and left there; that takes minutes.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import flypend as fp
from flypend.laws.learned import save
from flypend.learning.training import Learner, usual
from flypend.studies.bands import worlds_within

SENSORS = fp.Plant(sensors="mocap").sensors
SHARES = {"mass": 0.1, "bob_mass": 0.2, "rod_length": 0.1, "drag_ratio": 0.3, "rotor_lag": 0.25}
HELD_OUT, DRAWS, RUNS, DURATION = 10**6, 4, 200, 15.0


def vehicle():
    """Return hehn2011 with bands."""
    found = fp.vehicle("hehn2011")
    moments = np.diag(found.inertia)
    near = {name: tuple(getattr(found, name) * np.array([1 - off, 1 + off])) for name, off in SHARES.items()}
    rods = {name: near.pop(name) for name in ("mass", "bob_mass", "rod_length")}
    bands = {
        **rods, "inertia": (tuple(0.8 * moments), tuple(1.2 * moments)), **near, "thrust_scale": (0.9, 1.1),
        "strength": ((0.95,) * 4, (1.05,) * 4), "sag": (0.0, 0.08), "spin_up": (1.0, 1.4), "delay": (0.0, 0.02),
    }  # fmt: skip
    return found.replace(bands=bands)


def learn(path):
    """Learn a law as `flypend learn --bands --sensors mocap` does, and save its policy."""
    learner = Learner(usual(vehicle(), bands=True, sensors=SENSORS))
    learner.imitate()
    while learner.done < learner.training.updates:
        learner.descend()
    save(learner.policy, path)


def main():
    """Fly the three laws; print a row each."""
    with TemporaryDirectory() as own:
        path = Path(*sys.argv[1:] or [own]) / "policy.npz"
        if not path.exists():
            learn(path)
        worlds = list(worlds_within(vehicle(), fp.Plant(sensors=SENSORS), HELD_OUT, DRAWS).values())
        starts = fp.random_starts(RUNS, HELD_OUT)
        laws = {
            "learned within bands": fp.laws.learned(policy=str(path)), "learned, shipped": fp.laws.learned(),
            "inverted": fp.laws.inverted(),
        }  # fmt: skip
        print(
            "| law | succeed | 95 % interval | excursion p50, p95 (m) | settling time p50 (s) |\n|---|---|---|---|---|"
        )
        for name, law in laws.items():
            flown = next(iter(fp.compare(vehicle(), [law], starts, DURATION, plant=worlds).ensembles.values()))
            low, high = flown.interval
            p50, p95 = (flown.percentile("excursion", share) for share in (50, 95))
            print(
                f"| {name} | {int(flown.success.sum())} of {RUNS} | {low:.1%} to {high:.1%} | {p50:.2f}, {p95:.2f} | "
                f"{flown.percentile('settling', 50):.1f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
