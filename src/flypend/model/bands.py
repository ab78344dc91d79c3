"""Bands of a vehicle's numbers: field → (low, high), in the unit and shape of the field."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from flypend import errors
from flypend.errors import InputError

# Beside the vehicle's own numbers, those of its rotors, radio and tracking that identification finds with them.
BANDED = (
    "mass", "bob_mass", "rod_length", "inertia", "drag_ratio", "rotor_lag", "spin_up", "thrust_scale", "pivot_offset",
    "rotor_drag", "inflow", "sag", "delay", "latency", "strength", "rotor_limits",
)  # fmt: skip
POSITIVE = ("mass", "bob_mass", "rod_length", "inertia", "drag_ratio", "spin_up", "thrust_scale", "strength")
SIGNED = ("pivot_offset", "latency")


def bands_from(value: Any, rotors: int) -> Mapping[str, tuple[Any, Any]] | None:
    """Return `value`, field → (low, high) of a vehicle with `rotors`, as an unchangeable record, or None.

    Raises InputError.
    """
    if value is None:
        return None
    if not isinstance(value, Mapping):
        raise InputError("bands", "a table of field = [low, high]", repr(value))
    errors.only_known("bands", value, BANDED)
    shapes = {"inertia": (3,), "pivot_offset": (3,), "rotor_limits": (2,), "strength": (rotors,)}
    return MappingProxyType({name: _band(name, band, shapes.get(name, ())) for name, band in value.items()})


def _band(name: str, band: Any, shape: tuple[int, ...]) -> tuple[Any, Any]:
    low, high = errors.array(f"bands.{name}", band, (2, *shape))
    least = "" if name in SIGNED else "0 < " if name in POSITIVE else "0 <= "
    if np.any(low > high) or (least and np.any(low < 0)) or (name in POSITIVE and not np.all(low)):
        raise InputError(f"bands.{name}", f"{least}low <= high", repr(band)[:80])
    return tuple(float(end) if end.ndim == 0 else tuple(end.tolist()) for end in (low, high))  # type: ignore[return-value]
