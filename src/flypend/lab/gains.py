"""The gains of the laws: which have sliders, and what they are for a vehicle."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from flypend.laws import Law, law_from_dict
from flypend.model import Vehicle


def sliders_of(law: Law) -> tuple[str, ...]:
    """Gains of `law` that have sliders: those with a label."""
    return tuple(name for name, gain in law.gains.items() if gain.label)


@lru_cache(maxsize=64)
def proposed_gains(name: str, vehicle: Vehicle) -> Mapping[str, Any]:
    """The gains of the law called `name` for `vehicle` where nobody sets them."""
    return law_from_dict({"name": name}).gains_for(vehicle)
