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
    "rotor_drag", "sag", "delay", "latency", "strength", "rotor_limits",
)  # fmt: skip


def bands_from(value: Any) -> Mapping[str, tuple[Any, Any]] | None:
    """Return `value`, field → (low, high), as an unchangeable record, or None. Raises InputError."""
    if value is None:
        return None
    if not isinstance(value, Mapping):
        raise InputError("bands", "a table of field = [low, high]", repr(value))
    errors.only_known("bands", value, BANDED)
    return MappingProxyType({name: _band(f"bands.{name}", band) for name, band in value.items()})


def _band(field: str, band: Any) -> tuple[Any, Any]:
    try:
        low, high = (np.asarray(end, dtype=float) for end in band)
    except (TypeError, ValueError):
        raise InputError(field, "two numbers, low and high, or two lists of them", repr(band)[:80]) from None
    fits = low.shape == high.shape and low.ndim <= 1 and np.isfinite(low).all() and np.isfinite(high).all()
    if not fits or np.any(low > high):
        raise InputError(field, "finite numbers, low <= high, of one shape", repr(band)[:80])
    return tuple(float(end) if end.ndim == 0 else tuple(end.tolist()) for end in (low, high))  # type: ignore[return-value]
