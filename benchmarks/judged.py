"""What independent judges measured on version 0.1, measured again: `python -m benchmarks.judged [runs] [word …]`.

Prints a Markdown table: finding, figure of 0.1 as the judges found it, figure of today by our own seeds, with Wilson
intervals (95 %). `runs` is the number of flights or vehicles of a row (default 200; the judges took 100 to 2,000); only
rows whose finding contains one of the words are measured.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from itertools import islice
from time import process_time

import numpy as np

import flypend as fp
from benchmarks.clearance import crossings, flown, in_body, nearest
from benchmarks.export_flights import bare
from benchmarks.machines import machines
from flypend.errors import InputError
from flypend.flight.feasibility import feasibility
from flypend.flight.metrics import wilson
from flypend.plants import MOTION_CAPTURE, ROTORS, SUITES
from flypend.studies.check import check
from flypend.studies.starts import random_starts

SEED = 20261122  # of no start that anything was tuned on
INVERTED = fp.laws.inverted()


def _told(count: int, runs: int) -> str:
    low, high = wilson(count, runs)
    return f"{count} of {runs} ({100 * low:.1f} to {100 * high:.1f} %)"


def _stand(vehicle: fp.Vehicle, plant: fp.Plant = ROTORS, runs: int = 200, duration: float = 10.0) -> str:
    """Successes of the inverted law from random starts, or why it refuses."""
    try:
        found = fp.simulate_ensemble(vehicle, INVERTED, random_starts(runs, SEED), duration, plant=plant)
    except InputError as error:
        return f"refused: {error.field}"
    return _told(int(found.success.sum()), runs)


def _taken(vehicle: fp.Vehicle) -> bool:
    """Whether the inverted law does not refuse `vehicle`."""
    try:
        INVERTED.bind(vehicle)
    except InputError:
        return False
    return True


def _hehn(**changes) -> fp.Vehicle:
    return fp.vehicle("hehn2011").replace(**changes)


def random_box(runs: int) -> str:
    """Success and excursion from random starts."""
    found = fp.simulate_ensemble(_hehn(), INVERTED, random_starts(runs, SEED), 10.0)
    middle, most = (found.percentile("excursion", q) for q in (50, 95))
    return f"{_told(int(found.success.sum()), runs)}, excursion {middle:.2f} / {most:.2f} m"


def through_rotors(runs: int) -> str:
    """How many random flights on a gimbal would have kept clear of rotors, and how many keep the rod above them."""
    starts, clear, above = random_starts(runs, SEED), 0, 0
    for i in range(runs):
        rod = in_body(flown(starts[i], INVERTED))
        clear += nearest(crossings(rod), _hehn()) > 0.1
        above += bool(np.all(rod[:, 2] > 0))
    return f"clear of discs of 0.1 m {_told(clear, runs)}; y·z > 0 throughout {_told(above, runs)}"


def on_a_hub(runs: int) -> str:
    """Standing without touching on a hub, from starts that do not touch."""
    tasks = check(_hehn(mount="hub"), INVERTED, runs=runs, seed=SEED, margins=False).tasks
    words = [f"{name} {_told(int(tasks[name].success.sum()), len(tasks[name]))}" for name in ("hanging", "random")]
    return "; ".join(words)


def leans(runs: int) -> str:
    """Leans at rest that are caught without dropping the rod."""
    found = check(_hehn(), INVERTED, runs=1, margins=False).catch
    return f"caught directly up to {np.degrees(found.lean):.0f}°, within {found.excursion:.2f} m"


def against_optimum(runs: int) -> str:
    """Excursion from sixty random starts."""
    found = fp.simulate_ensemble(_hehn(), INVERTED, random_starts(60, SEED), 10.0)
    return f"{found.percentile('excursion', 50):.2f} m median, {found.percentile('excursion', 95):.2f} m p95"


def other_vehicles(runs: int) -> str:
    """Random vehicles: refused, doubtful, and how many stand at least 95 % of sixty random starts in 10 and in 30 s."""
    starts = random_starts(60, SEED)
    refused = doubtful = short = long = sure_long = 0
    for vehicle in machines(runs, SEED):
        sure = not feasibility(vehicle).doubtful
        doubtful += not sure
        if not _taken(vehicle):
            refused += 1
            continue
        found = fp.simulate_ensemble(vehicle, INVERTED, starts, 30.0)
        short += np.mean(found.settling <= 9.0) >= 0.95  # stands for the last second of ten
        long += found.rate >= 0.95
        sure_long += sure and found.rate >= 0.95
    return (
        f"{refused} of {runs} refused, {doubtful} doubtful; {short} reach 95 % in 10 s, {long} in 30 s; "
        f"of those without doubt {_told(sure_long, runs - doubtful)}"
    )


def cones(runs: int) -> str:
    """Slow random vehicles for a minute: failures, and how many of them circle on the cone y₃ = −1/3."""
    starts, flights, failed, circling = random_starts(20, SEED), 0, 0, 0
    slow = (vehicle for vehicle in machines(10 * runs, SEED) if feasibility(vehicle).agility < 3)
    for vehicle in islice(filter(_taken, slow), max(1, runs // 10)):
        found = fp.simulate_ensemble(vehicle, INVERTED, starts, 60.0)
        flights, failed = flights + 20, failed + int(np.sum(~found.success))
        circling += int(np.sum(~found.success & (np.abs(found.final.y[:, 2] + 1 / 3) < 0.1)))
    return f"{failed} of {flights} fail, {circling} of them circle there"


def bare_law(runs: int) -> str:
    """The law without observer, prediction and lead, as `flypend_step` in C is."""
    rows = [row.split("|") for row in bare(random_starts(runs, SEED), None).splitlines()[2:]]
    return "; ".join(f"{row[1].strip()} {row[-2].strip()}" for row in rows) + f" of {runs}"


def motion_capture(runs: int) -> str:
    """White noise of motion capture on every measurement, rates included."""
    return _stand(_hehn(), ROTORS.replace(noise=MOTION_CAPTURE), runs)


def estimated(runs: int) -> str:
    """Poses of motion capture, the rod to 0.3 or 1 mrad: with rates differenced, and with the estimator."""
    mocap = SUITES["mocap"]

    def poses(noise: float, rate: float, rates: str = "estimated") -> fp.Plant:
        each = {name: replace(getattr(mocap, name), rate=rate) for name in ("position", "attitude")}
        return ROTORS.replace(
            sensors=mocap.replace(rod=replace(mocap.rod, noise=noise, rate=rate), rates=rates, **each)
        )

    plants = {
        "differenced at 200 Hz, 0.3 mrad": poses(3e-4, 200.0, "differenced"),
        "1 mrad": poses(1e-3, 200.0, "differenced"),
        "estimated, 1 mrad at 200 Hz": poses(1e-3, 200.0),
        "100 Hz": poses(1e-3, 100.0),
        "50 Hz": poses(1e-3, 50.0),
        "as the suite is, 3.5 mrad at 200 Hz": ROTORS.replace(sensors=mocap),
        "onboard": ROTORS.replace(sensors=SUITES["onboard"]),
    }
    return "; ".join(f"{name} {_stand(_hehn(), plant, runs)}" for name, plant in plants.items())


def slow_rotors(runs: int) -> str:
    """The Crazyflie with its identified lag, with the rod of 0.1 and with one of half a metre."""
    long = fp.vehicle("crazyflie")
    short = long.replace(rod_length=0.2)
    return (
        f"knowing 30 ms {_stand(short.replace(rotor_lag=0.03), ROTORS.replace(lag=0.072), runs)}; knowing 72 ms "
        f"{_stand(short, ROTORS, runs)}; with a rod of 0.5 m {_stand(long, ROTORS, runs)}"
    )


def cliffs(runs: int) -> str:
    """Beyond the delays and the rods that 0.1 bore."""
    plants = {
        "35 ms": ROTORS.replace(delay=0.035),
        "40 ms": ROTORS.replace(delay=0.04),
        "rod ×1.12": ROTORS.replace(mismatch={"rod_length": 1.12}),
        "rod ×1.15": ROTORS.replace(mismatch={"rod_length": 1.15}),
        "20 + 40 ms, 100 Hz": ROTORS.replace(delay=0.02, lag=0.04, rate=100.0),
        "30 + 50 ms, 100 Hz": ROTORS.replace(delay=0.03, lag=0.05, rate=100.0),
    }
    return "; ".join(f"{name} {_stand(_hehn(), plant, runs)}" for name, plant in plants.items())


def margins(runs: int) -> str:
    """Where 90 % still succeed."""
    found = check(_hehn(), INVERTED, runs=runs, seed=SEED).margins
    return "; ".join(f"{name} {margin.describe()}" for name, margin in found.items())


def yaw_spin(runs: int) -> str:
    """An upright rod on a vehicle that spins, from 40 directions of the rod's lean, and one upside down."""
    angle = 2 * np.pi * np.arange(40) / 40
    y = np.stack([0.1 * np.cos(angle), 0.1 * np.sin(angle), np.full(40, np.sqrt(0.99))], axis=-1)
    words = []
    for spin in (25.0, 30.0, 40.0):
        starts = fp.State(y=y, omega=np.tile([0, 0, spin], (40, 1)))
        found = fp.simulate_ensemble(_hehn(), INVERTED, starts, 20.0)
        words.append(f"{spin:g} rad/s {_told(int(found.success.sum()), 40)}")
    over = fp.State(y=[(0, 0, 1)], R=[np.diag([1.0, -1.0, -1.0])])
    stands = bool(fp.simulate_ensemble(_hehn(), INVERTED, over, 20.0).success[0])
    return "; ".join(words) + f"; upside down under an upright rod: {'stands' if stands else 'does not stand'}"


def robust(runs: int) -> str:
    """A uniform rod of the bob's mass, less thrust than known, of all rotors and of one."""
    rod, weak = _hehn(**fp.uniform_rod(0.05, 1.13)), ROTORS.replace(strength=0.8)
    one = ROTORS.replace(strength=(0.7, 1.0, 1.0, 1.0))
    return (
        f"uniform rod {_stand(rod, runs=runs)}; thrust −20 % {_stand(_hehn(), weak, runs)}; "
        f"one rotor −30 % {_stand(_hehn(), one, runs)}"
    )


def speed(runs: int) -> str:
    """Flights of 10 s per second of processor time, compilation left out."""
    starts, words = random_starts(max(runs, 400), SEED), []
    for plant, some in ((ROTORS, starts), (ROTORS.replace(engine="mujoco"), starts[:8])):
        fp.simulate_ensemble(_hehn(), INVERTED, some[:1], 10.0, plant=plant)
        begin = process_time()
        fp.simulate_ensemble(_hehn(), INVERTED, some, 10.0, plant=plant)
        words.append(f"{plant.engine} {len(some) / (process_time() - begin):.3g}")
    return "flights/s and core: " + ", ".join(words)


# Finding, figure of 0.1, and the function that measures it today.
ROWS: list[tuple[str, str, Callable[[int], str]]] = [
    ("random starts", "2000 of 2000, excursion 1.23 / 2.06 m", random_box),
    ("rod through the rotors, gimbal", "clear of 0.1 m discs 13 %; y·z > 0 4 %", through_rotors),
    ("rod past rotors and arms, hub", "no mount", on_a_hub),
    ("small leans", "26° dropped and thrown again; LQR catches 30°", leans),
    ("excursion, sixty starts", "1.19 m median, 2.36 m p95 (optimum 0.23, 0.61)", against_optimum),
    ("other vehicles, random", "15 of 200 refused; 115 reach 95 % in 10 s, 134 in 30 s", other_vehicles),
    ("circling on y₃ = −1/3, slow vehicles", "289 of 486 failures circle there after 60 s", cones),
    ("bare law in C", "crazyflie 0 of 500; 15 ms of delay 0 of 200; masses ±20 % 0 of 200", bare_law),
    (
        "perfect rates are assumed",
        "differenced, 0.3 mrad: 85 of 200, 1 mrad: 0; a filter, 1 mrad: 200 Hz and 100 Hz 200 of 200, 50 Hz 188",
        estimated,
    ),
    ("motion capture, white noise on rates", "not judged", motion_capture),
    ("lag of the Crazyflie, 72 ms", "0 of 500; refused when told; rod 0.5 m 500 of 500", slow_rotors),
    (
        "cliffs of delay and rod",
        "35 ms 199 of 200, 40 ms 0; ×1.12 500 of 500, ×1.15 0; 20 + 40 ms, 100 Hz 196 of 200, 30 + 50 ms 0",
        cliffs,
    ),
    ("margins, 90 %", "delay 35 ms, rod ×1.12", margins),
    ("yaw spin", "25 rad/s recovers, 30 flies off; upside down under an upright rod falls for ever", yaw_spin),
    ("robust", "uniform rod 100 of 100; thrust −20 % 200 of 200; one rotor −30 % 200 of 200", robust),
    ("speed of users' paths", "rotors 480 flights/s and core; MuJoCo 1", speed),
]


def main() -> None:
    """Print the table, row by row."""
    given = sys.argv[1:]
    runs = int(given.pop(0)) if given and given[0].isdigit() else 200
    chosen = [row for row in ROWS if not given or any(word in row[0] for word in given)]
    print("| finding | 0.1, by its judges | today |\n|---|---|---|")
    for finding, then, measure in chosen:
        print(f"| {finding} | {then} | {measure(runs)} |", flush=True)


if __name__ == "__main__":
    main()
