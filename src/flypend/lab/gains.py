"""The gains of the laws: which have sliders, and what they are for a vehicle."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from flypend.laws import Law
from flypend.laws.law import law_from_dict
from flypend.model import Vehicle

# Gains that have sliders: words and unit.
GAINS: Mapping[str, Mapping[str, tuple[str, str]]] = {
    "inverted": {
        "position_bandwidth": ("position", "rad/s"),
        "height_bandwidth": ("height", "rad/s"),
        "rod_bandwidth": ("rod", "rad/s"),
        "rod_damping": ("rod damping", ""),
        "attitude_bandwidth": ("attitude", "rad/s"),
        "attitude_damping": ("attitude damping", ""),
        "throw_speed": ("throw speed", "m/s"),
        "coast_time": ("look ahead", "s"),
    },
    "lqr": {
        "position_error": ("position error", "m"),
        "velocity_error": ("velocity error", "m/s"),
        "attitude_error": ("attitude error", "rad"),
        "rate_error": ("rate error", "rad/s"),
        "rod_error": ("rod error", "rad"),
        "rod_rate_error": ("rod rate error", "rad/s"),
        "thrust_deviation": ("thrust", "weights"),
        "moment_deviation": ("moment", "weights"),
    },
    "corrected": {"k_d": ("k_d", "1/s"), "k_1": ("k_1", "1/s²"), "k_2": ("k_2", "1/s")},
    "printed": {"k_d": ("k_d", "1/s"), "k_1": ("k_1", "1/s²"), "k_2": ("k_2", "1/s")},
}


def gains_of(law: Law, vehicle: Vehicle) -> Mapping[str, Any]:
    """The gains with which `law` flies `vehicle`."""
    # The regulator knows its weights without its vehicle, and need not solve its equation for them.
    return law.gains if law.name == "lqr" else law.bound(vehicle).gains


@lru_cache(maxsize=64)
def proposed_gains(name: str, vehicle: Vehicle) -> Mapping[str, Any]:
    """The gains of the law called `name` for `vehicle` where nobody sets them."""
    return gains_of(law_from_dict({"name": name}), vehicle)
