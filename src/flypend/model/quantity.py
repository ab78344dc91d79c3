"""Quantities as a person has them: SI numbers, or text with a unit, "620 g"."""

from __future__ import annotations

import re

from flypend import errors
from flypend.errors import InputError

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
    told = f" ({why})" if why else ""
    raise InputError(field, f"{low:.3g} to {high:.3g} {unit}{told}", f"{number:g} {unit}{hint}")
