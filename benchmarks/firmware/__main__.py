"""Flights of the exported app in the Crazyflie's own firmware, on this machine: starts, and what may go wrong.

    python -m benchmarks.firmware ../crazyflie-firmware --starts 200 [--sensors mocap | --plan]
    python -m benchmarks.firmware ../crazyflie-firmware --scenarios
    python -m benchmarks.firmware ../crazyflie-firmware --blind
    python -m benchmarks.firmware ../crazyflie-firmware --build

PATH is a folder of the firmware with its submodules; it and gcc are needed. Commander, supervisor, Kalman filter, PID
controller, power distribution and battery compensation are the firmware's own; the app is that of `flypend export-app`.
They fly on flypend's plant at 1 kHz, with poses and bob at 100 Hz and setpoints at 50 Hz, without noise or delay.

Starts: a rig carries the vehicle to a start and lets go when the law flies; a third each hanging, level and random.
Beside them stand the same starts under Python's flight computer, on the same plant with ideal mixing.

Scenarios: the law holds the rod inverted, and then something happens. Beside it stands the same flight in which the
firmware's own PID controller takes over from the app where the law ends; forces are compared from 0.02 to 0.5 s after.

Blind: swing-ups from hanging lose the poses for good, each at another instant, and land.

Build: processor time of the commands of the app's README, from the export to a binary, on one core.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

import flypend as fp
from benchmarks.firmware.built import build
from benchmarks.firmware.loop import CUT, HOME, LANDING, LAW, OWN, PID, TICK, Vehicle
from flypend.export.app import AIRFRAMES, limit_rotors
from flypend.flight.request import Flight
from flypend.flight.sampled import fly_stepwise
from flypend.plants.plant import as_sampled
from flypend.studies.starts import random_starts

VEHICLES = {"cf2": "crazyflie", "cf21bl": "crazyflie-brushless"}
DURATION = 8.0  # s
LAW_FLOWN = fp.laws.inverted()
SETTLED = fp.Criterion(position=0.3)  # the same pose as everywhere; the Kalman filter's position wanders by centimetres
NAMES = {CUT: "cut", PID: "PID", LAW: "law", LANDING: "landing"}


def main() -> None:
    """Print a table of starts or of scenarios."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path", type=Path)
    parser.add_argument("--airframe", choices=VEHICLES, default="cf2")
    parser.add_argument("--starts", type=int, default=0)
    for name in ("scenarios", "blind", "build"):
        parser.add_argument(f"--{name}", action="store_true")
    parser.add_argument("--seed", type=int, default=2024)
    parser.add_argument("--plant", default="rotors")
    parser.add_argument("--sensors", default="perfect")
    parser.add_argument("--plan", action="store_true")
    given = parser.parse_args()
    if given.build:
        print("\n".join(built_by_readme(given.path.resolve())))
        return
    with tempfile.TemporaryDirectory() as place:
        library, vehicle = exported(
            given.path.resolve(), Path(place) / "app", given.airframe, given.sensors, planned=given.plan
        )
        if given.starts:
            for line in table(fly_starts(library, vehicle, given)):
                print(line, flush=True)
        if given.blind:
            print("\n".join(blind(library, vehicle)))
        elif given.scenarios or not given.starts:
            print("\n".join(HEAD))
            for name in SCENARIOS:
                print(told(name, *compared(name, library, vehicle)), flush=True)


def exported(
    firmware: Path, app: Path, airframe: str, sensors: str = "perfect", *, planned: bool = False
) -> tuple[Path, fp.Vehicle]:
    """The library of the firmware with a fresh app, and the vehicle that it flies."""
    vehicle = fp.vehicle(VEHICLES[airframe])
    fp.export_app("crazyflie", LAW_FLOWN, vehicle, app, airframe=airframe, sensors=sensors, planned=planned)
    return build(firmware, app, airframe), limit_rotors(vehicle, AIRFRAMES[airframe])


# Starts ---------------------------------------------------------------------------------------------------------------


def starts(count: int, seed: int) -> dict[str, list[fp.State]]:
    """`count` starts in three kinds, at HOME."""
    rng = np.random.default_rng(seed)
    share, drawn = count // 3, random_starts(count - 2 * (count // 3), seed)
    kinds: dict[str, list[fp.State]] = {"hanging": [], "level": []}
    for kind, depth in (("hanging", np.pi - 0.02), ("level", np.pi / 2)):
        for turn in rng.uniform(0, 2 * np.pi, share):
            y = (np.sin(depth) * np.cos(turn), np.sin(depth) * np.sin(turn), np.cos(depth))
            kinds[kind].append(fp.State(x=HOME, y=y))
    kinds["random"] = [
        fp.State(x=HOME, x_dot=one.x_dot, R=one.R, omega=one.omega, y=one.y, y_dot=one.y_dot)
        for one in (drawn[i] for i in range(len(drawn.x)))
    ]
    return kinds


def fly_starts(library, vehicle, given):
    """For each kind: whether each flight succeeded and its excursion, m, in the firmware and with ideal mixing."""
    fly = partial(in_firmware, library, vehicle, plant=given.plant)
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        for kind, batch in starts(given.starts, given.seed).items():
            rows = list(pool.map(fly, batch))
            yield kind, *(np.array([(row[i], row[i + 1]) for row in rows]).T for i in (0, 2))


def in_firmware(library, vehicle, start, plant="rotors"):
    """Success and excursion (m) of a start in the firmware, and of the same state and forces with ideal mixing."""
    flown = Vehicle(library, vehicle, plant)
    flown.lift()
    begun = flown.release(start)
    begins, rotors = len(flown.log), flown.engine.rotors.copy()
    at = flown.state
    flown.fly(DURATION, lambda: flown.flies != LAW)
    stood, far = judged(packed(flown, begins), HOME, TICK)
    moved = fp.State(x=at.x - HOME, x_dot=at.x_dot, R=at.R, omega=at.omega, y=at.y, y_dot=at.y_dot)
    plant = as_sampled(plant)
    flight = Flight(vehicle=vehicle, law=LAW_FLOWN.bind(vehicle), starts=moved, duration=DURATION, plant=plant)
    ideal = judged(fly_stepwise(flight, rotors).packed, np.zeros(3), 1 / plant.rate)
    return begun and flown.flies == LAW and stood, far, *ideal


def packed(flown: Vehicle, begins: int) -> np.ndarray:
    """Packed states (n, 24) of a flight from the tick `begins`."""
    return np.array([state.packed() for state, *_ in flown.log[begins:]])


def judged(flight: np.ndarray, home: np.ndarray, step: float) -> tuple[bool, float]:
    """Whether the last second of packed states, one every `step` (s), was inverted hover, and the excursion, m."""
    states = fp.State.from_packed(flight)
    far = np.linalg.norm(states.x - home, axis=1)
    last = slice(-round(SETTLED.hold / step), None)
    upright = np.array([0, 0, 1])
    off = (
        (np.linalg.norm(states.y - upright, axis=1), SETTLED.rod),
        (np.linalg.norm(states.R[:, :, 2] - upright, axis=1), SETTLED.axis),
        (far, SETTLED.position),
    )
    return all((value[last] < limit).all() for value, limit in off), float(far.max())


def table(kinds):
    """Lines of the table of starts."""
    yield (
        "| starts | in the firmware | excursion, m, p50 / p95 | ideal mixing | its excursion, m, p50 / p95 | "
        "within 1.1 × | ratio, p50 / largest |"
    )
    yield "|---|---|---|---|---|---|---|"
    for kind, *flights in kinds:
        cells = [kind]
        for stood, far in flights:
            cells += [f"{stood.sum():.0f} of {len(stood)}", "{:.2f} / {:.2f}".format(*np.percentile(far, (50, 95)))]
        ratio = flights[0][1] / flights[1][1]
        cells += [f"{(ratio <= 1.1).sum()} of {len(ratio)}", f"{np.median(ratio):.2f} / {ratio.max():.2f}"]
        yield f"| {' | '.join(cells)} |"


# Scenarios ------------------------------------------------------------------------------------------------------------


def _switched_off(flown):
    flown.firmware.set("flypend.on", 0)


def _landed(flown):
    flown.firmware.set("flypend.on", 0)
    flown.land(0.0, 3.0)


def _attribute(**values):
    def change(flown):
        for name, value in values.items():
            setattr(flown, name, value)

    return change


SCENARIOS = {
    "switched off": _switched_off,
    "land": _landed,
    "stop setpoint": Vehicle.stop,
    "emergency stop": Vehicle.emergency,
    "disarmed": lambda flown: flown.arm(False),
    "setpoints lost": _attribute(setpoints=False),
    "link lost": _attribute(link=False),
    "bob lost": _attribute(sees_bob=False),
    "pose lost": _attribute(sees_pose=False),
    "battery low": _attribute(battery_is_low=True, voltage=3.1),
}
LOW = np.array([0.0, 0.0, 1.5])  # m
AFTER = 9.0  # s that a scenario lasts
DISARM = 4.0  # s after which the host script disarms a vehicle that it told to land


def happen(
    name: str, library: Path, vehicle: fp.Vehicle, *, instead: int | None = None, after: float = AFTER
) -> tuple[Vehicle, int]:
    """Hold the rod inverted for three seconds, let it happen, and fly on for `after` (s).

    `instead`: the tick at which the firmware's PID takes over.
    """
    flown = Vehicle(library, vehicle, home=LOW)
    flown.lift()
    flown.firmware.set("flypend.height", LOW[2])
    assert flown.release(fp.State(x=LOW, y=(np.sin(0.1), 0, np.cos(0.1))))
    flown.fly(3.0)
    event = flown.ticks
    SCENARIOS[name](flown)
    for _ in range(round(after / TICK)):
        if flown.ticks == instead:
            flown.firmware.set("stabilizer.controller", OWN)
        if name == "land" and flown.ticks == event + round(DISARM / TICK):
            flown.arm(False)
        flown.tick()
        if flown.state.x[2] < -0.2:  # below the floor, which the plant does not have
            break
    return flown, event


def compared(
    name: str, library: Path, vehicle: fp.Vehicle, *, after: float = AFTER
) -> tuple[Vehicle, Vehicle, int, int]:
    """The app's flight, that with the firmware's PID from the tick where the law ends, and ticks of event and end."""
    flown, event = happen(name, library, vehicle, after=after)
    end = next(i for i in range(event, len(flown.log)) if flown.log[i][2] != LAW)
    own, _ = happen(name, library, vehicle, instead=end, after=after)
    return flown, own, event, end


def difference(flown: Vehicle, own: Vehicle, end: int, begin: float = 0.02, until: float = 0.5) -> float:
    """Largest difference, N, of a rotor's force between two flights, `begin` to `until` s after the tick `end`.

    The firmware's PID takes up to 10 ms to run for the first time, the app's runs at once.
    """
    span = slice(end + round(begin / TICK), end + round(until / TICK))
    a, b = (np.array([forces for _, forces, _ in one.log[span]]) for one in (flown, own))
    count = min(len(a), len(b))
    return float(np.abs(a[:count] - b[:count]).max())


def stopped(flown: Vehicle, event: int) -> float | None:
    """Seconds from the event until all rotors stand still for good; None if they do not."""
    spinning = [i for i in range(event, len(flown.log)) if flown.log[i][1].any()]
    last = spinning[-1] + 1 if spinning else event
    return None if last == len(flown.log) else (last - event) * TICK


def strayed(flown: Vehicle, event: int) -> tuple[float, float]:
    """How far it went sideways from where it hovered, and its lowest point, m, until the motors stopped or 0.05 m."""
    x = np.array([state.x for state, forces, _ in flown.log[event:] if forces.any() and state.x[2] > 0.05])
    return (float(np.hypot(*(x - LOW)[:, :2].T).max()), float(x[:, 2].min())) if len(x) else (0.0, LOW[2])


def told(name: str, flown: Vehicle, own: Vehicle, event: int, end: int) -> str:
    """A line about a scenario."""
    phases = [NAMES[flown.log[i][2]] for i in range(event, len(flown.log)) if flown.log[i][2] != flown.log[i - 1][2]]
    stops = [stopped(one, event) for one in (flown, own)]
    times = ["—" if still is None else f"{still:.3f}" for still in stops]
    aside, lowest = strayed(flown, event)
    cells = [name, f"{(end - event) * TICK:.3f}", ", ".join(phases), *times, f"{aside:.2f}", f"{lowest:.2f}"]
    return f"| {' | '.join(cells)} | {difference(flown, own, end):.4f} |"


HEAD = (
    "| what happens | law flies on, s | then | motors stop after, s | firmware's PID's, s | aside, m | lowest, m | "
    "forces differ by, N |",
    "|---|---|---|---|---|---|---|---|",
)


# Without poses --------------------------------------------------------------------------------------------------------

INSTANTS = np.arange(0.4, 2.5, 0.1)  # s after the law began
OFF = {"exact": (0.0, 0.0), "0.3 °/s and 0.02 g off": (0.3, 0.02)}  # deg/s, g on each axis: a warm, levelled BMI088


def blind(library: Path, vehicle: fp.Vehicle):
    """Lines of a table: how swing-ups end that lose the poses."""
    yield "| IMU | landed within 20 s | aside, m, p50 / largest | sideways at the ground, m/s, p50 / largest |"
    yield "|---|---|---|---|"
    for name, (gyro, acc) in OFF.items():
        rows = np.array([_ends_blind(library, vehicle, at, gyro, acc) for at in INSTANTS])
        cells = (f"{np.median(row):.1f} / {row.max():.1f}" for row in rows.T[1:])
        yield f"| {name} | {rows[:, 0].sum():.0f} of {len(rows)} | {' | '.join(cells)} |"


def _ends_blind(library: Path, vehicle: fp.Vehicle, at: float, gyro: float, acc: float) -> tuple[bool, float, float]:
    flown = Vehicle(library, vehicle)
    flown.gyro_off, flown.acc_off = gyro * np.array([1, -1, 1]), acc * np.array([1, -1, 1])
    flown.lift()
    assert flown.release(fp.State(x=HOME, y=(0.02, 0.0, -np.sqrt(1 - 0.02**2))))
    flown.fly(at)
    lost, flown.sees_pose = flown.ticks, False
    down = flown.fly(20.0, lambda: flown.state.x[2] < 0.06)
    away = np.array([state.x - HOME for state, *_ in flown.log[lost:]])
    return down, float(np.hypot(*away[:, :2].T).max()), float(np.hypot(*flown.state.x_dot[:2]))


# To a binary ----------------------------------------------------------------------------------------------------------


def built_by_readme(firmware: Path):
    """Lines of a table: seconds of one core from the export to a binary, for each airframe."""
    yield "| airframe | export, s | build, s | binary, bytes |"
    yield "|---|---|---|---|"
    for airframe, vehicle in VEHICLES.items():
        with tempfile.TemporaryDirectory() as place:
            app, base = Path(place, "app"), f"CRAZYFLIE_BASE={firmware}"
            words = [Path(sys.executable).with_name("flypend"), "export-app", "crazyflie", vehicle, "-o", app]
            spent = [_spent(words, Path(place))]
            spent.append(sum(_spent(["make", base, *more], app) for more in ([f"{airframe}_defconfig"], [])))
            size = (app / "build" / f"{airframe}.bin").stat().st_size
        yield f"| {airframe} | {spent[0]:.0f} | {spent[1]:.0f} | {size} |"


def _spent(words: list, folder: Path) -> float:
    """Seconds of processor time of a command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(word) for word in words], cwd=folder, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


if __name__ == "__main__":
    main()
