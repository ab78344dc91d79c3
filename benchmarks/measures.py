"""What versions are compared by, in the public interface that 0.1 shares: `python -m benchmarks.measures rotors`.

Prints the name and the figure of each measure that is named, for the version on the path.
"""

from __future__ import annotations

import random
import sys
import time
from collections.abc import Callable
from typing import Any

# Not numpy, nor flypend: `imported` and `own` time their import.
REPEATS = 3


def flown(runs: int, duration: float = 10.0, **options: Any) -> float:
    """Flights per second of processor time of the inverted law on hehn2011, the best of some repeats."""
    import numpy as np

    import flypend as fp

    vehicle, law = fp.vehicle("hehn2011"), fp.laws.inverted()
    starts = fp.State.random(np.random.default_rng(0), runs)
    fp.simulate_ensemble(vehicle, law, starts[:1], duration, workers=1, **options)  # compiles
    best = float("inf")
    for _ in range(REPEATS):
        begin = time.process_time()
        fp.simulate_ensemble(vehicle, law, starts, duration, workers=1, **options)
        best = min(best, time.process_time() - begin)
    return runs / best


def real() -> Any:
    """The plant "rotors" with noise and gusts; the law's observer estimates the forces."""
    import flypend as fp

    noise = fp.Noise(x=1e-3, x_dot=1e-2, attitude=2e-3, omega=1e-2, y=2e-3, y_dot=2e-2)
    return fp.Plant(noise=noise, wind=fp.Wind(gust_on_vehicle=0.1, gust_on_bob=0.01))


def imported() -> float:
    """Seconds of processor time of `import flypend` beyond those of `import numpy`."""
    import numpy  # noqa: F401

    begin = time.process_time()
    import flypend  # noqa: F401

    return time.process_time() - begin


def own() -> float:
    """Seconds of processor time from the first import to the end of a first flight under a law never seen before."""
    begin = time.process_time()
    import flypend as fp
    from flypend.geometry import E3, cross

    stiffness = 300.0 + random.random()

    def control(t: Any, state: Any, vehicle: Any, *_: Any) -> Any:
        p, p_dot = state.x + vehicle.l * (state.y - E3), state.x_dot + vehicle.l * state.y_dot
        lean = 2.9 * state.y + 0.5 * state.y_dot + 0.28 * p + 0.47 * p_dot
        error = state.R.T @ cross(state.z, E3 + lean - lean[2] * E3)
        climb = 1 - 0.4 * state.x[2] - 0.5 * state.x_dot[2]
        return fp.Wrench(vehicle.weight * climb, vehicle.I @ (stiffness * error - 30 * state.omega))

    law = fp.Law(name="own", e3="up", control=control)
    fp.simulate(fp.vehicle("hehn2011"), law, fp.State(y=(0.1, 0, 0.995)), 10.0, plant="rotors")
    return time.process_time() - begin


MEASURES: dict[str, Callable[[], float]] = {
    "unjudged": lambda: flown(2048, plant="ideal", rtol=1e-6, judge_period=10.0),
    "judged": lambda: flown(2048, plant="ideal", rtol=1e-6),
    "rotors": lambda: flown(256, plant="rotors"),
    "real": lambda: flown(256, plant=real()),
    "mujoco": lambda: flown(4, plant="mujoco"),
    "imported": imported,
    "own": own,
}


if __name__ == "__main__":
    for name in sys.argv[1:]:
        print(name, MEASURES[name](), flush=True)
