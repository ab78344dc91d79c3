"""What is identified: every number with its guess, how far off a guess may be, and the form in which it is searched."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend.geometry import Numbers
from flypend.identification.model import MOVING, READING, places, split
from flypend.identification.rotors import patterns, rotor_table
from flypend.model import Vehicle

# Standard deviation of a guess: of its logarithm, for what is positive and of unknown size ...
RATIOS = {
    "rod_length": 0.15, "bob_mass": 0.1, "inertia": 0.4, "drag_ratio": 0.4, "lag": 0.7, "spin_up": 0.3,
}  # fmt: skip
# ... or of the number itself: m; logarithms of forces; share of voltage; s; rad/s; m/s²; rad. Props of one kind differ
# by some per cent, batteries lose up to a tenth, radios take some 10 ms, hobby IMUs are off by so much.
PLAIN = {
    "pivot_offset": 5e-3, "scale": 0.15, "shares": 0.05, "sag": 0.05, "delay": 0.02, "latency": 0.01, "gyro_bias": 0.05,
    "force_bias": 0.3, "misalignment": 0.02, "curve": 0.3,
}  # fmt: skip
FIELDS = {"scale": "thrust_scale", "lag": "rotor_lag", "shares": "strength"}  # of a vehicle's bands, by name here
NORMAL_975 = 1.96  # standard deviations from the middle of a band of 95 % to its end
LAG, DELAY, SAG, PWM_CURVE = 0.04, 0.01, 0.03, 0.7  # where a search begins if the guess says nothing
LEAST, MOST = {"delay": 0.0, "sag": 0.0, "curve": 0.0}, {"delay": 0.2, "sag": 0.25, "curve": 1.0}
DRAG_TIME, WIND = 5.0, 0.03  # s in which drag stops a machine; steady wind over weight


@dataclass(frozen=True, eq=False)
class Search:
    """A point θ of the search and what it stands for.

    Parameters
    ----------
    vehicle : Vehicle
        The guess.
    guess, spread : (p,)
        Where the search begins, and the standard deviation of the guess; 0 for what is not searched.
    logarithmic : (p,) of bool
        Which numbers are searched as the logarithm of their ratio to the guess.
    """

    vehicle: Vehicle
    guess: Numbers
    spread: Numbers
    logarithmic: Numbers

    @property
    def table(self) -> dict[str, int]:
        """Names and lengths of what is searched: what moves, the rotors, what is read."""
        return table(len(self.vehicle.rotor_spins))

    def values(self, theta: Numbers) -> dict[str, Any]:
        """Return the numbers at θ (p,) by name."""
        return split(self.table, self.plain(theta))

    def plain(self, theta: Numbers) -> Any:
        """Return the numbers at θ (p,) in one array."""
        return np.where(self.logarithmic, self.guess * np.exp(np.where(self.logarithmic, theta, 0)), self.guess + theta)

    def slope(self, theta: Numbers) -> Any:
        """Return d(number)/dθ, (p,)."""
        return np.where(self.logarithmic, self.plain(theta), 1.0)

    def within(self, theta: Numbers) -> Any:
        """Return θ (p,) with what has limits clipped to them."""
        low, high = np.full(len(theta), -np.inf), np.full(len(theta), np.inf)
        for name, place in places(self.table).items():
            low[place] = LEAST.get(name, -np.inf) - self.guess[place]
            high[place] = MOST.get(name, np.inf) - self.guess[place]
        held = np.clip(theta, low, high)
        return np.where(self.logarithmic, np.clip(theta, -1.5, 1.5), held)  # a factor of 4.5 either way


def table(rotors: int) -> dict[str, int]:
    """Return names and lengths of all numbers of a machine with so many rotors."""
    return {**MOVING, **rotor_table(rotors), **READING}


def search_from(vehicle: Vehicle, pwm: bool, accelerometer: bool) -> Search:
    """Return the search that begins at `vehicle`; with `pwm` the thrust curve is searched too.

    Bands of the vehicle are what is known before; numbers without one have the usual spreads.
    """
    n = len(vehicle.rotor_spins)
    hover = vehicle.weight / n
    drag = vehicle.weight / vehicle.gravity / DRAG_TIME / n / np.sqrt(hover)
    known = 0.0 if vehicle.air is None else vehicle.air.rotor_drag
    given: dict[str, Any] = {
        "rod_length": vehicle.rod_length, "bob_mass": vehicle.bob_mass, "inertia": np.diag(vehicle.inertia),
        "drag_ratio": vehicle.drag_ratio, "pivot_offset": vehicle.pivot_offset, "rotor_drag": known,
        "lag": vehicle.rotor_lag or LAG, "spin_up": 1.0, "sag": SAG, "delay": DELAY,
        "curve": PWM_CURVE if pwm else 0.0, "scale": np.log(vehicle.thrust_scale),
    }  # fmt: skip
    spreads: dict[str, Any] = {**RATIOS, **PLAIN, "rotor_drag": drag, "wind": WIND * vehicle.weight}
    for name in spreads:
        if (field := FIELDS.get(name, name)) in (vehicle.bands or {}):
            low, high = (np.array(end) for end in vehicle.bands[field])
            logarithmic = name in RATIOS or name in ("scale", "shares")
            spreads[name] = (np.log(high / low) if logarithmic else high - low) / (2 * NORMAL_975)
            if name in ("spin_up", "sag", "delay", "latency"):  # no fields of a vehicle: the band's middle
                given[name] = (low + high) / 2
            if name == "shares":
                given[name], spreads[name] = patterns(n).T @ np.log(low * high) / 2, spreads[name].mean()
    if not pwm:
        spreads["curve"] = 0.0
    if not accelerometer:
        spreads["force_bias"] = 0.0
    parts = [
        [np.broadcast_to(number, size) for number in (given.get(name, 0.0), spreads[name], name in RATIOS)]
        for name, size in table(n).items()
    ]
    return Search(vehicle, *map(np.concatenate, zip(*parts, strict=True)))
