"""Success under all errors of a laboratory at once: its vehicle's bands and its sensors' defects; which fails first."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from typing import Any

import numpy as np

from flypend import errors, plants, signals
from flypend.errors import InputError
from flypend.flight.kernels import has_kernel
from flypend.flight.metrics import Count
from flypend.flight.request import Flight, bound_to
from flypend.flight.tasks import LEAST_RATE, task_starts
from flypend.laws import AnyLaw, inverted
from flypend.model import State, Vehicle
from flypend.plants import PRESETS, SUITES, AnyPlant, Sampled
from flypend.plants.bands import world_of
from flypend.plants.defects import CONSTANT, NEEDS, NUMBERS
from flypend.plants.plant import LONGEST_DELAY, MOST_SAG
from flypend.studies.compare import Progress
from flypend.studies.margins import count_of, fly_beside, for_each
from flypend.studies.trial import is_up, knock_on

# Half widths, relative, of the bands of a vehicle that has none: weighed and measured in haste.
USUAL = {"mass": 0.2, "bob_mass": 0.2, "rod_length": 0.15, "thrust_scale": 0.15}
NOT_FLOWN = ("rotor_limits", "rotor_drag", "inflow", "latency")  # bands that `world_of` leaves out
LIMITS = {"sag": MOST_SAG, "delay": LONGEST_DELAY}  # beyond which there is no plant
JOINTS_OFF = float(np.radians(0.5))  # zeros of encoders, as the angles of the suite "laboratory"
SCALES = (1.0, 2.0, 4.0)  # of all errors together, until success drops below LEAST_RATE
SHARES = (0.5, 0.25, 0.125)  # of an error that is calibrated
DRAWS = 6  # vehicles drawn from the bands
# Random starts of all draws together and of one variant, and both where flights are slow.
RUNS, VARIANT_RUNS, SLOW_RUNS = 384, 48, 6
DURATION = 12.0  # s; three times what 95 % of the random starts need
# Flights with pokes, and s: one poke in each half of a flight, which leaves time to swing the rod up again.
POKES, POKE_PERIOD, SAMPLE = 48, 12.0, 0.05
NOT_YET = 1e-12  # of a poke, so that all flights of a vehicle share a kernel


@dataclass(frozen=True)
class Cause:
    """One of the errors of a laboratory."""

    name: str  # a number of the vehicle's bands, or a field of the plant or its sensors
    size: str  # how large it is where it was turned up alone and off
    alone: Count  # flights with this error alone
    without: Count  # flights with all the others


@dataclass(frozen=True)
class Joint:
    """The result of `joint`."""

    tasks: Mapping[str, Count]  # success of each task, "pokes" among them, under all errors at once
    draws: int  # vehicles that share the flights of a task
    scales: Mapping[float, Count]  # scale of all errors → random starts of the draw in which most fail
    # The errors at the largest of these scales, the one that fails first at the beginning. Empty if 90 % succeed at
    # every scale.
    causes: tuple[Cause, ...] = ()
    calibrated: tuple[str, ...] = ()  # errors that must be smaller for 90 % of those flights to succeed
    # Of their sizes, the largest share at which that is so, and the flights at it; 0 and those with none of them if no
    # share is small enough.
    share: float = 1.0
    kept: Count | None = None

    @property
    def scale(self) -> float:
        """The largest scale flown."""
        return max(self.scales)

    def lines(self) -> list[str]:
        """Return success of each task, that of each error alone and without it, what fails first, what to calibrate."""
        out = [f"{name}, {self.draws} draws of all errors: {count.describe()}" for name, count in self.tasks.items()]
        out += [f"the worst draw, errors × {scale:g}: {count.describe()}" for scale, count in self.scales.items()]
        if not self.causes:
            return [*out, f"nothing fails first: errors × {self.scale:g} keep 90 %"]
        out += [
            f"{one.name} {one.size}: alone {one.alone.describe()}, without it {one.without.describe()}"
            for one in self.causes
        ]
        first = self.causes[0]
        out.append(f"fails first, errors × {self.scale:g}: {first.name} {first.size}")
        assert self.kept is not None
        sizes = ", ".join(f"{one.name} {one.size}" for one in self.causes if one.name in self.calibrated)
        kept = self.kept.describe()
        change = f"to × {self.share:g} of {sizes}: {kept}" if self.share else f"{sizes}: {kept} if right"
        return [*out, f"calibrate {change}"]

    def to_dict(self) -> dict[str, Any]:
        """Return everything as plain numbers, lists and dicts."""
        return {
            "draws": self.draws,
            "tasks": {name: _row(count) for name, count in self.tasks.items()},
            "scales": {f"{scale:g}": _row(count) for scale, count in self.scales.items()},
            "causes": [asdict(one) | {"alone": _row(one.alone), "without": _row(one.without)} for one in self.causes],
            "calibrated": list(self.calibrated),
            "share": self.share,
            "kept": None if self.kept is None else _row(self.kept),
        }


def _row(count: Count) -> dict[str, Any]:
    return {**count.to_dict(), "wilson": list(count.interval)}


class Errors:
    """The errors of a laboratory in one draw.

    Parameters
    ----------
    vehicle : Vehicle
        What the law believes; a vehicle without bands gets those of `USUAL`.
    plant : Sampled
        The world without them. Of defects that it has these are the sizes; others are as in the plant "laboratory".
    rng : Generator
        Draws the vehicle, uniformly from its bands; defects have their full sizes, and sensors draw for each flight.
    """

    def __init__(self, vehicle: Vehicle, plant: Sampled, rng: np.random.Generator) -> None:
        usual = {name: getattr(vehicle, name) * np.array([1 - share, 1 + share]) for name, share in USUAL.items()}
        bands = vehicle.bands or usual
        drawn = {name: np.asarray(rng.uniform(*map(np.array, band))) for name, band in bands.items()}
        self._vehicle, self._drawn = vehicle, {name: v for name, v in drawn.items() if name not in NOT_FLOWN}
        self._defects = _defects(plant)
        clean = plant.sensors and plant.sensors.replace(**dict.fromkeys(self._defects, 0.0))
        self._plant = plant.replace(sensors=clean, centre_of_mass=(0.0, 0.0, 0.0), sag=0.0)
        lab = PRESETS["laboratory"]
        assert isinstance(lab, Sampled)
        of_plant = {name: getattr(plant, name) for name in ("sag", "centre_of_mass")}
        self._of_plant = {
            name: value if np.any(value) else getattr(lab, name)
            for name, value in of_plant.items()
            if name not in self._drawn
        }

    @property
    def names(self) -> tuple[str, ...]:
        """Every error: of the vehicle, of the plant, of its sensors."""
        return (*self._drawn, *self._of_plant, *self._defects)

    def size(self, name: str, scale: float) -> str:
        """Return the size of an error at `scale`, in words."""
        if name in self._drawn:
            value, written = np.ravel(self._value(name, scale)), np.ravel(self._written(name))
            if np.all(written != 0):
                return f"× {float(np.mean(value / written)):.3g}"
            return f"{np.round(value, 4).tolist()}"
        value = scale * np.asarray({**self._of_plant, **self._defects}[name])
        unit = CONSTANT[name][2] if name in CONSTANT else NUMBERS[name][1] if name in NUMBERS else ""
        text = f"{float(value):.3g}" if value.ndim == 0 else f"{np.round(value, 6).tolist()}"
        return f"{text} {'m' if name == 'centre_of_mass' else unit}".strip()

    def world(self, scales: Mapping[str, float]) -> Sampled:
        """Return the plant with the errors of `scales` by name, each so many times its size."""
        found = {name: self._value(name, scales[name]) for name in self._drawn if scales.get(name)}
        plant = world_of(self._vehicle, self._plant, found)
        changes: dict[str, Any] = {}
        for name, value in self._of_plant.items():
            if scale := scales.get(name):
                changes[name] = _limit(name, scale * np.asarray(value)).tolist()
        if plant.sensors is not None:
            wrong = {name: _grown(name, value, scales.get(name, 0.0)) for name, value in self._defects.items()}
            changes["sensors"] = plant.sensors.replace(**wrong)
        return plant.replace(**changes)

    def variant(self, scales: Mapping[str, float]) -> Sampled:
        """Return the `world` of `scales` with all defects in its program: only their sizes differ between variants."""
        plant = self.world(scales)
        if plant.sensors is None:
            return plant
        return plant.replace(sensors=plant.sensors.replace(adjustable=tuple(self._defects)))

    def _written(self, name: str) -> Any:
        if name == "inertia":
            return np.diag(self._vehicle.inertia)
        plants_own = name in ("strength", "spin_up", "sag", "delay")
        return np.asarray(getattr(self._plant if plants_own else self._vehicle, name))

    def _value(self, name: str, scale: float) -> Any:
        """Written plus `scale` times what was drawn beyond it; as a power where both are positive."""
        written, drawn = self._written(name), self._drawn[name]
        if np.all(written > 0) and np.all(drawn > 0) and name not in ("sag", "delay"):
            return written * (drawn / written) ** scale
        return _limit(name, written + scale * (drawn - written))


def _limit(name: str, value: Any) -> Any:
    return np.clip(value, 0.0, LIMITS[name]) if name in LIMITS else value


def _defects(plant: Sampled) -> dict[str, Any]:
    """Return sizes of the defects of sensors: those that `plant` has, and of others those of a laboratory."""
    if plant.sensors is None:
        return {}
    usual = SUITES["laboratory"]
    found = {}
    for name in (*CONSTANT, *NUMBERS):
        own, other = getattr(plant.sensors, name), JOINTS_OFF if name == "joints_off" else getattr(usual, name)
        default = getattr(plant.sensors.told, name)  # of what says only how large another defect is
        possible = name not in NEEDS or NEEDS[name] in plant.sensors.streams
        if not default and possible and np.any(own or other):
            found[name] = own or other
    return found


def _grown(name: str, value: Any, scale: float) -> Any:
    most = CONSTANT[name][1] if name in CONSTANT else NUMBERS[name][0]
    grown = np.clip(scale * np.asarray(value), -most, most)
    return tuple(grown.tolist()) if grown.ndim else float(grown)


@signals.defer()
def joint(
    vehicle: Vehicle,
    law: AnyLaw | None = None,
    *,
    plant: str | AnyPlant = "rotors",
    runs: int | None = None,
    seed: int = 1,
    progress: Progress = lambda *_: None,
) -> Joint:
    """Fly `vehicle` under all errors of a laboratory at once, then find out which fails first and what to calibrate.

    Every task of `check`, and hover that is poked twice at √(g l), flies with vehicles drawn from the bands and all
    defects of the sensors. All errors of the draw in which most random starts fail are doubled until fewer than 90 %
    succeed; there each error is turned up alone, and off from all. What fails first is what success gains most
    without, or of equal ones what it loses most by alone.

    `vehicle`, `law` and `plant` are as in `check`. Bands of the vehicle and defects of the plant's sensors are the
    sizes of the errors; where there are none, those of `USUAL` and of the plant "laboratory". All draws together fly
    `runs` random starts, by default 384; a variant flies 48, or as many if that is fewer. Starts and vehicles are drawn
    by `seed`. `progress` is called with (task, done, total).
    """
    world = plants.as_sampled(plant)
    bound = bound_to(vehicle, inverted() if law is None else law)
    count = RUNS if runs is None else errors.integer("runs", runs, 1)
    starts = task_starts(vehicle, count, seed)
    flight = Flight(
        vehicle=vehicle, law=bound, starts=starts["random"].in_frame(bound.e3), duration=DURATION, plant=world
    )
    if runs is None and not has_kernel(flight):
        starts = {name: some[:SLOW_RUNS] for name, some in starts.items()}
    rng = np.random.default_rng(seed)
    drawn = [Errors(vehicle, world, rng) for _ in range(DRAWS)]
    tasks, worst = _fly_tasks(flight, starts, drawn, progress)
    few = flight.replace(starts=starts["random"][:VARIANT_RUNS].in_frame(bound.e3))
    scales: dict[float, Count] = {}
    for scale in SCALES:
        (scales[scale],) = _fly(
            few, [worst.variant(dict.fromkeys(worst.names, scale))], partial(progress, "errors grow")
        )
        if scales[scale].rate < LEAST_RATE:
            return Joint(tasks, len(drawn), scales, *_explain(few, worst, scale, progress))
    return Joint(tasks, len(drawn), scales)


def _explain(
    flight: Flight, wrong: Errors, scale: float, progress: Progress
) -> tuple[tuple[Cause, ...], tuple[str, ...], float, Count]:
    """Return causes, what to calibrate, to which share of its size, and the flights there."""
    names, whole = wrong.names, dict.fromkeys(wrong.names, scale)
    variants = [wrong.variant({name: scale}) for name in names] + [wrong.variant(whole | {name: 0.0}) for name in names]
    found = _fly(flight, variants, partial(progress, "each error alone, and off"))
    causes = [
        Cause(name, wrong.size(name, scale), alone, without)
        for name, alone, without in zip(names, found[: len(names)], found[len(names) :], strict=True)
    ]
    causes.sort(key=lambda one: (-one.without.rate, one.alone.rate))
    off: list[str] = []
    kept = causes[0].without
    for one in causes:
        off.append(one.name)
        if len(off) > 1:
            (kept,) = _fly(flight, [wrong.variant(whole | dict.fromkeys(off, 0.0))], partial(progress, "several off"))
        if kept.rate >= LEAST_RATE:
            break
    for share in SHARES:
        (count,) = _fly(flight, [wrong.variant(whole | dict.fromkeys(off, share * scale))], partial(progress, "shares"))
        if count.rate >= LEAST_RATE:
            return tuple(causes), tuple(off), share, count
    return tuple(causes), tuple(off), 0.0, kept


def _fly_tasks(
    flight: Flight, starts: Mapping[str, State], drawn: Sequence[Errors], progress: Progress
) -> tuple[dict[str, Count], Errors]:
    """Return success of each task, whose starts the draws share, and the draw in which most random starts fail."""
    vehicle, law = flight.vehicle, flight.law
    poked = min(POKES, 2 * len(starts["random"]))
    all_starts = {**starts, "pokes": State(y=np.tile([0.0, 0.0, 1.0], (poked, 1)))}
    speed = float(np.sqrt(vehicle.g * vehicle.l))

    def fly(place: int) -> dict[str, Count]:
        world, found = drawn[place].variant(dict.fromkeys(drawn[place].names, 1.0)), {}
        for name, some in all_starts.items():
            size = speed if name == "pokes" else NOT_YET
            mine = some[place :: len(drawn)]
            if not len(mine):
                continue
            one = flight.through(knock_on(vehicle, world, size, POKE_PERIOD)).replace(
                starts=mine.in_frame(law.e3), seed=(flight.seed or 0) + place * len(some),
            )  # fmt: skip
            if name == "pokes":
                one = one.replace(duration=2 * POKE_PERIOD, times=np.arange(0.0, 2 * POKE_PERIOD, SAMPLE))
            found[name] = _count(one, _stand_of if name == "pokes" else count_of)
        return found

    found = for_each(flight, fly, range(len(drawn)), partial(progress, "all errors at once"))
    tasks = {name: Count.together(one[name] for one in found if name in one) for name in all_starts}
    worst = min(range(len(drawn)), key=lambda place: found[place].get("random", Count(1, 1)).rate)
    return tasks, drawn[worst]


def _stand_of(poked: Flight) -> Count:
    """Return in how many runs the rod is up for more than half of each half of the flight."""
    stands = np.all([half.mean(axis=1) > 0.5 for half in np.hsplit(is_up(fly_beside(poked)), 2)], axis=0)
    return Count(int(stands.sum()), poked.runs)


def _fly(flight: Flight, worlds: Sequence[Sampled], progress: Callable[[int, int], Any]) -> list[Count]:
    """Fly every start of `flight` in each of `worlds`."""
    return for_each(flight, lambda world: _count(flight.through(world)), worlds, progress)


def _count(flight: Flight, count: Callable[[Flight], Count] = count_of) -> Count:
    """Return the `count` of a `flight`: none if such a vehicle cannot fly."""
    try:
        return count(flight)
    except InputError:
        return Count(0, flight.runs)
