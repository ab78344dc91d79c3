"""The controls of the page: laws, plants, presets, and the sliders of a setting with their ranges and values."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from typing import Any

from flypend.errors import InputError
from flypend.lab.gains import sliders_of
from flypend.lab.own import OwnLaws
from flypend.lab.setting import LONGEST, Setting, plain
from flypend.laws import Controller, Law, law_names
from flypend.model import State, Vehicle
from flypend.model.shipped import vehicle_names
from flypend.paper import experiment, experiment_names
from flypend.plants import MOTION_CAPTURE, Noise, Sampled, Wind

MOUNTS = {"gimbal": "gimbal, no limit", "hub": "hub, between arms", "cup": "cup, on top"}
PLANTS = {"rotors": "rotors, 500 Hz", "hehn2011": "rates at 50 Hz", "ideal": "ideal"}
_NOISE = {name: {"#": value} for name, value in asdict(MOTION_CAPTURE).items()}
BISECTIONS = 12  # to a fifth of a per cent of a slider with a range of a factor of four either way
FACTOR = 4.0  # a gain's slider spans its default divided and multiplied by this


def offer(own: OwnLaws | None = None) -> dict[str, Any]:
    """Return the choices (including the custom laws `own`), the presets, and the initial setting."""
    mine = list(own or ())
    first = {
        "vehicle": {"base": "hehn2011", "mount": "gimbal"},
        "law": {"name": mine[0] if mine else "inverted", "gains": {}},
        "plant": {"base": "rotors"},
        "start": plain(State(y=(0.0, 0.0, -1.0))),
        "duration": 6.0,
        "pokes": [],
    }
    return {
        "vehicles": vehicle_names(),
        "mounts": MOUNTS,
        "laws": [*law_names(), *mine],
        "plants": PLANTS,
        "first": first,
        "starts": {name: plain(State(y=y)) for name, y in STARTS.items()},
        "experiments": {name: _preset(name) for name in experiment_names() if "-" not in name},
    }


STARTS = {"hanging": (0.0, 0.0, -1.0), "level": (1.0, 0.0, 0.0), "leaning": (0.28, 0.0, 0.96)}


def _preset(name: str) -> dict[str, Any]:
    """An experiment of the paper as a setting, its start flipped into the e₃-up frame."""
    row = experiment(name)
    return {
        "vehicle": {"base": row.vehicle.name, "mount": row.vehicle.mount},
        "law": {"name": "corrected", "gains": dict(row.gains)},
        "plant": {"base": row.plant},
        "start": plain(row.start.flipped()),
        "duration": row.duration,
        "pokes": [],
    }


def sliders(setting: Setting) -> list[dict[str, Any]]:
    """Return the sliders of `setting`: path in it, group, label, unit, value, range, and whether logarithmic."""
    flight, law = setting.flight, setting.law
    given, proposed = law.gains_for(flight.vehicle), law.proposed(flight.vehicle)
    out = []
    for name in sliders_of(law):
        value, usual, gain = given[name], proposed[name], law.table[name]
        low, high, log = _reach(usual)
        reach = (max(low, gain.bounds.low), min(high, gain.bounds.high))
        slider = _slider(f"law.gains.{name}", "gains", gain.label, gain.unit, value, *reach, log=log)
        out.append(slider | {"allowed": _allowed(law, given, name, slider["low"], slider["high"])})
    if isinstance(flight.plant, Sampled):
        out += _plant_sliders(flight.plant, flight.vehicle)
    return [*out, _slider("duration", "flight", "duration", "s", flight.duration, 2.0, LONGEST)]


def _allowed(law: Law | Controller, given: dict[str, Any], name: str, low: float, high: float) -> list[float]:
    """Between `low` and `high`, how far the gain `name` may go while the others stay as `given`."""
    check = law.check if isinstance(law, Law) else None
    if check is None:
        return [low, high]

    def refused(value: float) -> bool:
        try:
            check({**given, name: value})
        except InputError:
            return True
        return False

    return [_last_good(refused, given[name], end) for end in (low, high)]


def _last_good(refused: Callable[[float], bool], good: float, end: float) -> float:
    """Where, on the way from a `good` value to `end`, values begin to be `refused`; `end` if none is. By bisection."""
    if not refused(end):
        return end
    bad = end
    for _ in range(BISECTIONS):
        middle = (good + bad) / 2
        good, bad = (good, middle) if refused(middle) else (middle, bad)
    return good


def _reach(usual: float) -> tuple[float, float, bool]:
    """Range of the slider of a gain whose default is `usual`, and whether it is logarithmic."""
    if usual > 0:
        return usual / FACTOR, usual * FACTOR, True
    return (usual * FACTOR, -usual * FACTOR, False) if usual < 0 else (-1.0, 1.0, False)


def _plant_sliders(plant: Sampled, vehicle: Vehicle) -> list[dict[str, Any]]:
    least, largest = vehicle.rotor_limits
    share = vehicle.weight / len(vehicle.rotor_spins)
    lag = vehicle.rotor_lag if plant.lag is None else plant.lag
    noise, wind = plant.noise or Noise(), plant.wind or Wind()
    level = noise.x / MOTION_CAPTURE.x
    high = 0.5 * vehicle.weight
    return [
        _slider(
            "vehicle.rotor_limits", "plant", "rotor limit", "N", largest, 1.1 * share, 5 * share, put=[least, {"#": 1}]
        ),
        _slider("plant.lag", "plant", "rotor lag", "s", lag, 0.0, 0.1),
        _slider("plant.delay", "plant", "delay", "s", plant.delay, 0.0, 0.1),
        _slider("plant.noise", "plant", "noise", "× motion capture", level, 0.0, 10.0, put=_NOISE),
        _slider(
            "plant.wind.on_vehicle", "plant", "wind along e₁", "N", wind.on_vehicle[0], -high, high,
            put=[{"#": 1}, 0.0, 0.0],
        ),
        _slider("plant.wind.gust_on_vehicle", "plant", "gusts", "N", wind.gust_on_vehicle, 0.0, high),
    ]  # fmt: skip


def _slider(
    path: str,
    group: str,
    words: str,
    unit: str,
    value: float,
    low: float,
    high: float,
    log: bool = False,
    put: Any = None,
) -> dict[str, Any]:
    """One slider; its range is widened to include `value`.

    `put` is what the page writes at `path`, where {"#": factor} stands for factor times the value; None for the value.
    """
    return {
        "path": path, "group": group, "words": words, "unit": unit, "value": float(value),
        "low": float(min(low, value)), "high": float(max(high, value)), "log": log, "put": put, "allowed": None,
    }  # fmt: skip
