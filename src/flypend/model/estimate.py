"""A vehicle from what a person can measure: the rest by scaling, each number with its band and the source of the guess.

Bands are meant to hold the true number in 95 % of cases. Those of scaling laws cover the machines of the package whose
numbers were identified by others; `tests/model/test_estimate.py` says which.
"""

from __future__ import annotations

import json
import re
import tomllib
from functools import cache
from importlib import resources
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from flypend import errors
from flypend.errors import InputError
from flypend.model.plausible import EARTH, INERTIAS
from flypend.model.rod import rod_with_bob

Quantity = float | str  # SI, or text with a unit
# Factors to SI, by what is measured.
UNITS: dict[str, dict[str, float]] = {
    "kg": {"g": 1e-3},
    "m": {"cm": 1e-2, "mm": 1e-3, "in": 0.0254},
    "N": {"gf": 9.80665e-3, "kgf": 9.80665, "mN": 1e-3},
    "V": {"mV": 1e-3},
}
_TEXT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\d\s]*)\s*")
MOST_TEXT = 40  # characters of a quantity
AIR = 1.225  # kg/m³
# Scaling laws: middle, and the factor by which a machine may be off either way.
ROLL, YAW, INERTIA_BAND = 0.25, 0.45, 1.6  # moments of inertia over mass × arm²
THRUST_COEFFICIENT, THRUST_BAND = 0.12, 1.6  # of propellers at rest, T/(ρ n² D⁴)
MERIT, TORQUE_BAND = 0.5, 1.6  # figure of merit, ideal over actual power in hover
TORQUE = np.sqrt(2 * THRUST_COEFFICIENT / np.pi) / (2 * np.pi * MERIT)  # torque over thrust and diameter: T v/(MERIT ω)
LOADED = 0.70  # full speed under load over that without
CELL = 3.7  # V, of a lithium polymer cell
LAG, LAG_BAND = 0.045, 2.2  # s
DRAG_PER_DIAMETER, DRAG_BAND = 0.26, 2.2  # N^½ s/m²
IDLE, MOST_IDLE = 0.03, 0.15  # least force over the largest, as motors and firmware allow
SURPLUS, SURPLUS_BAND = 2.0, 1.8  # thrust of all rotors over weight, where no motor is given
MEASURED_BAND = 1.1  # of a thrust that was measured
ARM_RADIUS, HUB_RADIUS, ROD_RADIUS = 0.04, 0.2, 0.005  # over the arm, the arm, and the rod
OFF_CENTRE = 0.05  # pivot off the centre of mass over arm
MOST_ROTORS, MOST_SURPLUS = 12, 20.0
# What a person's numbers are refused for, several times beyond common machines: rods of 1 to 12 arms with 0.01 to 0.6
# of the machine's mass, arms of 0.6 to 1.5 diameters, moments of inertia of 0.1 to 1 mass · arm².
RODS, LOADS, WIDEST, MOMENTS = (0.5, 50.0), (1e-3, 1.0), 5.0, (0.02, 10.0)
SLIMMEST = 0.2  # yaw moment over the larger of the others; 1.5 to 2 are common
# N/m², thrust over the disc: tips at the speed of sound push 2,200 with the coefficient below, broad blades some more.
MOST_PRESSURE = 3000.0
# Bands of what no part of the machine tells.
OTHERS = {"spin_up": [0.6, 1.8], "sag": [0.0, 0.12], "delay": [0.0, 0.05], "latency": [0.0, 0.03]}
SCALING = "I/(m arm²) alike for like machines (Kumar and Michael 2012), as of the package's vehicles"
STATIC = "static thrust coefficient 0.12 (range of Brandt and Selig 2011), speed 0.7 of that without load"
MOMENTUM = "momentum theory with a figure of merit of 0.5 (range of small rotors: Leishman 2006)"
LAGS = "as of identified machines (arXiv 2404.07837)"
SIZE = re.compile(r"(?P<inches>\d{1,2}(?:\.\d+)?)[x×*]\d+(?:\.\d+)?(?:[x×*]\d)?|(?P<both>\d{4,5})")
KV = re.compile(r"(\d{2,5}(?:\.\d+)?)\s*[kK][vV]")
CELLS = re.compile(r"(\d{1,2})\s*[sS]")


class Guess(NamedTuple):
    """Fields of a vehicle, and where each comes from."""

    fields: dict[str, Any]
    sources: dict[str, str]

    def text(self) -> str:
        """Return the TOML of the vehicle, with the source of each number beside it."""
        tables = {name: value for name, value in self.fields.items() if isinstance(value, dict)}
        lines = [self._line(name, value) for name, value in self.fields.items() if name not in tables]
        for table, entries in tables.items():
            lines += ["", f"[{table}]" + (f"  # {self.sources[table]}" if table in self.sources else "")]
            lines += [self._line(name, value, f"{table}.") for name, value in entries.items()]
        return "\n".join(lines) + "\n"

    def _line(self, name: str, value: Any, table: str = "") -> str:
        line = f"{name} = {json.dumps(value, ensure_ascii=False)}"
        source = self.sources.get(table + name)
        return f"{line:38s} # {source}" if source else line


@cache
def parts() -> dict[str, Any]:
    """Return the motors and propellers that have a name."""
    return tomllib.loads((resources.files("flypend") / "model" / "parts.toml").read_text(encoding="utf-8"))


class Measured(NamedTuple):
    """What a scale, a ruler and the parts of a machine tell: the arguments of `Vehicle.estimate`."""

    mass: Quantity
    arm: Quantity
    propeller: Quantity
    rod_length: Quantity
    rod_mass: Quantity = 0.0
    bob_mass: Quantity = 0.0
    motor: str | None = None
    battery: Quantity | None = None
    thrust: Quantity | None = None
    inertia: ArrayLike | None = None
    rotors: int = 4
    mount: str = "gimbal"
    name: str = "mine"


def guess(measured: Measured) -> Guess:
    """Return the fields of a vehicle and their sources; see `Vehicle.estimate`."""
    m = quantity("mass", measured.mass, "kg", 0.005, 100)
    a = quantity("arm", measured.arm, "m", 0.01, 3)
    n = errors.integer("rotors", measured.rotors, 4, MOST_ROTORS)
    if n % 2:
        raise InputError("rotors", "an even number, of which half spin each way", f"{n}")
    rod = _rod(measured, m, a)
    prop, motor_known = _propeller(measured.propeller), _motor(measured.motor)
    if a > WIDEST * (diameter := prop["diameter"]):
        wanted = f"an arm of at most {WIDEST:g} diameters of the propeller, {WIDEST * diameter:.3g} m"
        raise InputError("arm", wanted, f"{a:.3g} m")
    weight = (m + rod["bob_mass"]) * EARTH
    most, pushed, off = _thrust(measured, motor_known, prop, weight / n)
    if n * most * off < weight:
        wanted = f"at least {weight / n:.3g} N, as {weight:.3g} N of weight on {n} rotors need to hover"
        raise InputError("thrust", wanted, f"{most:.3g} N ({pushed})")
    if n * most > MOST_SURPLUS * off * weight:
        wanted = f"rotors of at most {MOST_SURPLUS:g} times the weight ({weight:.3g} N)"
        raise InputError("thrust", wanted, f"{n * most / weight:.3g} times ({pushed})")
    if most > (strongest := MOST_PRESSURE * np.pi / 4 * diameter**2):
        wanted = (
            f"at most {strongest:.3g} N from a propeller of {diameter:.3g} m, whose tips stay below the speed of sound"
        )
        raise InputError("thrust", wanted, f"{most:.3g} N ({pushed}; the mass is {m:.3g} kg)")
    given = measured.inertia is not None
    moments = _moments(measured.inertia, m * a**2) if given else np.array([ROLL, ROLL, YAW]) * m * a**2
    known = "drag_ratio" in prop
    ratio = prop["drag_ratio"] if known else TORQUE * prop["diameter"]
    lag, slow = (motor_known["lag"], 1.3) if "lag" in motor_known else (LAG, LAG_BAND)
    drag = DRAG_PER_DIAMETER * prop["diameter"]
    turns = 2 * np.pi * (np.arange(n) + 0.5) / n  # the nose is between two arms
    places = a * np.column_stack([np.cos(turns), np.sin(turns), 0 * turns])
    fields = {
        "name": measured.name, "mass": m, **rod, "inertia": _short(moments), "gravity": EARTH,
        "rotor_positions": _short(places), "rotor_spins": [(-1) ** i for i in range(n)], "drag_ratio": _short(ratio),
        "rotor_limits": _short([IDLE * most, most]), "rotor_lag": lag, "mount": measured.mount,
        "body": _short(
            {"disc_radius": prop["diameter"] / 2, "arm_radius": ARM_RADIUS * a, "hub_radius": HUB_RADIUS * a,
             "rod_radius": ROD_RADIUS * rod["rod_end"]}
        ),
        "air": {"rotor_drag": _short(drag)},
        "bands": {
            "mass": _about(m, 1.005), "bob_mass": _about(rod["bob_mass"], 1.01),
            "rod_length": _about(rod["rod_length"], 1.02), "inertia": _about(moments, 1.05 if given else INERTIA_BAND),
            "drag_ratio": _about(ratio, 1.15 if known else TORQUE_BAND),
            "rotor_limits": _short([[0.0, most / off], [MOST_IDLE * most, most * off]]),
            "rotor_lag": _about(lag, slow), "rotor_drag": _about(drag, DRAG_BAND),
            "thrust_scale": _about(1.0, max(off, 1.1)), "strength": _about(np.ones(n), 1.1),
            "pivot_offset": _short([[-OFF_CENTRE * a] * 3, [OFF_CENTRE * a] * 3]), **OTHERS,
        },
    }  # fmt: skip
    sources = {
        "mass": "kg, weighed, without the rod", "bob_mass": "kg, weighed, rod and bob",
        "rod_length": "m, to the centre of mass, of a uniform rod with a bob at its end",
        "rod_inertia": "kg m², of the same rod", "rod_end": "m, measured",
        "inertia": "kg m², given" if given else f"kg m², {SCALING}",
        "rotor_positions": "m, measured; arms at equal angles, the nose between two",
        "rotor_spins": "front left clockwise seen from above, in turn: check it",
        "drag_ratio": f"m, {prop['source']}" if known else f"m, {MOMENTUM}",
        "rotor_limits": f"N, {pushed}; least force {IDLE:g} of the largest, chosen",
        "rotor_lag": f"s, {motor_known['source']}" if "lag" in motor_known else f"s, {LAGS}",
        "body": "m; discs by the propeller, the others by the arm and the rod, chosen",
        "air": f"N^½ s/m, {DRAG_PER_DIAMETER:g} of the diameter, as of RotorPy's machines",
        "bands": "low and high: the true number is meant to be within in 95 % of cases",
    }  # fmt: skip
    return Guess(fields, sources)


def _rod(measured: Measured, mass: float, arm: float) -> dict[str, float]:
    """Return the fields of the rod on a machine of `mass`, kg, with arms of `arm`, m."""
    low, high = (share * mass for share in LOADS)
    why = f"at most the machine's {mass:.3g} kg"
    alone, bob = (quantity(name, getattr(measured, name), "kg", 0, high, why) for name in ("rod_mass", "bob_mass"))
    if alone + bob == 0:
        raise InputError("rod_mass", "the mass of the rod, its bob or both, kg", "none")
    if not low <= alone + bob <= high:
        raise InputError("bob_mass", f"{low:.3g} to {high:.3g} kg of rod and bob ({why})", f"{alone + bob:.3g} kg")
    shortest, longest = (share * arm for share in RODS)
    why = f"{RODS[0]:g} to {RODS[1]:g} times the arm of {arm:.3g} m; 1 to 12 are common"
    length = quantity("rod_length", measured.rod_length, "m", shortest, longest, why)
    return {name: _short(value) for name, value in rod_with_bob(alone, length, bob).items()}


def _moments(value: ArrayLike | None, scale: float) -> Any:
    """Return the principal moments (3,) that a person knows, kg m², beside `scale`, mass × arm². Raises InputError."""
    moments = errors.array("inertia", value, (3,))
    usual, (low, high) = ROLL * scale, (share * scale for share in MOMENTS)
    if not (low <= moments[:2].min() and moments[:2].max() <= high):
        unit, meant = min(((name, f * moments[0]) for name, f in INERTIAS.items()), key=lambda one: abs(one[1] - usual))
        hint = f" (in {unit}? write {meant:.4g}, …)" if low <= meant <= high else ""
        wanted = f"{low:.2g} to {high:.2g} kg m² of roll and pitch, where {usual:.2g} is common"
        raise InputError("inertia", wanted, f"{moments[0]:.3g} and {moments[1]:.3g}{hint}")
    slim = moments[2] / moments[:2].max()
    if not slim >= SLIMMEST:
        wanted = f"roll, pitch, yaw: yaw at least {SLIMMEST:g} of the larger of the others (1.8 is common)"
        raise InputError("inertia", wanted, f"{slim:.3g} of it")
    return moments


def _propeller(value: Quantity) -> dict[str, Any]:
    """Return what is known of a propeller: its diameter, m, and, of one in the table, its constants."""
    table = parts()["propellers"]
    if isinstance(value, str) and value in table:
        return {**table[value], "source": f"of the propeller {value} in the table of parts"}
    if isinstance(value, str) and (inches := SIZE.fullmatch(value.strip())):
        first = int((inches["both"] or "0")[:2])  # "1045" is 10 inches, "0845" 8 and "5045" 5.0
        size = float(inches["inches"] or (first if first < 20 else first / 10))
        return {"diameter": quantity("propeller", size * UNITS["m"]["in"], "m", 0.02, 1.0)}
    try:
        return {"diameter": quantity("propeller", value, "m", 0.02, 1.0)}
    except InputError as error:
        names = ", ".join(table)
        raise InputError(
            "propeller", f"inches ('10x4.5', '1045'), a diameter of 0.02 to 1 m, or one of {names}", error.got
        ) from None


def _motor(value: str | None) -> dict[str, Any]:
    """Return what is known of a motor: `kv`, rpm/V, and, of one in the table, its lag; nothing of None."""
    if value is None:
        return {}
    table = parts()["motors"]
    if value in table:
        return {**table[value], "source": f"of the motor {value} in the table of parts"}
    if not (found := KV.fullmatch(value.strip())):
        raise InputError("motor", f"its speed per volt ('920 KV'), or one of {', '.join(table)}", value)
    return {"kv": errors.number("motor", float(found[1]), at_least=20, at_most=30000, unit="rpm/V")}


def _thrust(measured: Measured, motor: dict[str, Any], prop: dict[str, Any], share: float) -> tuple[float, str, float]:
    """Return the largest force of a rotor, N, its source, and the factor by which it may be off.

    `share` is the weight that a rotor carries, N.
    """
    thrust, battery = measured.thrust, measured.battery
    if bool(motor) != (battery is not None):
        missing, there = ("battery", "motor") if motor else ("motor", "battery")
        raise InputError(missing, f"the {missing} that goes with the {there}", "nothing")
    if thrust is not None:
        low, high = share / MEASURED_BAND, MOST_SURPLUS * MEASURED_BAND * share
        why = f"of one rotor, 1 to {MOST_SURPLUS:g} times its share of the weight"
        return quantity("thrust", thrust, "N", low, high, why), "measured", MEASURED_BAND
    if not motor:
        return SURPLUS * share, f"{SURPLUS:g} times the weight on all rotors, chosen: a motor would tell", SURPLUS_BAND
    speed = LOADED * motor["kv"] * _volts(battery) * 2 * np.pi / 60
    constant = prop.get("thrust_constant", THRUST_COEFFICIENT * AIR * prop["diameter"] ** 4 / (4 * np.pi**2))
    return float(_short(constant * speed**2)), f"motor, battery and propeller: {STATIC}", THRUST_BAND


def _volts(battery: Quantity | None) -> float:
    """Return the voltage of a battery, given by its cells, "4S", or in volts."""
    if isinstance(battery, str) and (cells := CELLS.fullmatch(battery.strip())):
        return CELL * errors.number("battery", float(cells[1]), at_least=1, at_most=14, unit="cells")
    return quantity("battery", battery, "V", 2.5, 60)


def quantity(field: str, value: Quantity | None, unit: str, low: float, high: float, why: str = "") -> float:
    """Return `value`, a number in the SI `unit` or text with a unit, "620 g", as a float in SI.

    Raises InputError unless it lies between `low` and `high`; it says `why`, and asks for the unit probably meant.
    """
    known = {unit: 1.0, **UNITS[unit]}
    plain, factor = value, 1.0
    if isinstance(value, str):
        found = _TEXT.fullmatch(value[:MOST_TEXT])
        if not found or (found[2] or unit) not in known:
            raise InputError(field, f"a number with a unit of {', '.join(known)}, such as {low * 10:g} {unit}", value)
        plain, factor = float(found[1]), known[found[2] or unit]
    number = errors.number(field, plain, unit=unit) * factor
    if low <= number <= high:
        return number
    others = [name for name, other in UNITS[unit].items() if factor == 1.0 and low <= number * other <= high]
    hint = f" ({'; '.join(f'in {name}? write {number:g}{name}' for name in others)})" if others else ""
    reason = f" ({why})" if why else ""
    raise InputError(field, f"{low:.3g} to {high:.3g} {unit}{reason}", f"{number:g} {unit}{hint}")


def _about(middle: Any, factor: float) -> Any:
    """Return the band from `middle` over a factor to `middle` times it."""
    return [_short(np.asarray(middle) / factor), _short(np.asarray(middle) * factor)]


def _short(value: Any) -> Any:
    """Return numbers, in lists and dicts of any depth, to four digits."""
    if isinstance(value, dict):
        return {name: _short(one) for name, one in value.items()}
    if np.ndim(value):
        return [_short(one) for one in value]
    return float(f"{float(value):.4g}")
