"""What a log told of a machine: numbers with bands, what it left open, and how well the model explains it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend import errors
from flypend.identification.fit import FIELDS, Fit
from flypend.identification.model import CHANNELS, ROTOR_AIR, places
from flypend.identification.rotors import patterns
from flypend.model import Vehicle
from flypend.model.rod import stretch
from flypend.plants.plant import Plant

# Student's t with as many degrees of freedom as scores of segments, 30 in a minute, at 97.5 %.
T_975 = 2.05
LEARNED = 0.5  # of the guess's standard deviation; a log that leaves more has told next to nothing
# Numbers that are known but for the mass, as no log tells masses and forces apart.
WITH_MASS = ("bob_mass", "inertia", "scale", *ROTOR_AIR)
WHITE = 0.1  # autocorrelation beyond which prediction errors are called coloured
MORE = {
    "rod_length": "let the rod swing by 20° and more, once a few seconds",
    "bob_mass": "let the rod swing by 20° and more, once a few seconds",
    "inertia": "roll, pitch and yaw doublets at two thirds of the largest moment",
    "drag_ratio": "yaw doublets, and log every row of the gyroscope",
    "lag": "roll and pitch doublets of 0.1 s",
    "spin_up": "roll and pitch doublets of 0.1 s",
    "delay": "roll and pitch doublets of 0.1 s",
    "sag": "climbs and drops at 1.5 and 0.6 of the hover thrust",
    "scale": "climbs and drops at 1.5 and 0.6 of the hover thrust",
    "rotor_drag": "a straight flight at 3 m/s, there and back",
    "inflow": "climbs and drops at 1.5 and 0.6 of the hover thrust",
}

Band = tuple[Any, Any]


@errors.named_arguments
@dataclass(frozen=True, eq=False)
class Identified:
    """A machine as `flypend.identify` found it.

    Parameters
    ----------
    vehicle : Vehicle
        The machine, with `thrust_scale` and `bands`.
    bands : dict
        Field → (low, high), in the units and shape of the field: each is meant to contain the true number in 95 % of
        cases. Beside fields of the vehicle there are `delay`, `latency` (s), `sag`, `spin_up`, and `strength` by
        rotors.
    delay : float
        Time from the row of a command to its action, s.
    plant : Plant
        Sampled plant with the delay, sag, spin-up and strengths of the rotors that were found.
    untold : tuple of str
        Fields with a number about which the log says next to nothing: it stays near the guess.
    """

    vehicle: Vehicle
    bands: dict[str, Band]
    delay: float
    plant: Plant
    untold: tuple[str, ...]
    _fit: Fit

    def report(self) -> str:
        """Return a page of text: every number with its band, what stays open, and how well the model fits."""
        fit, machine, lines = self._fit, self.vehicle, []
        found = fit.search.values(fit.theta) | vars(self.plant) | vars(machine) | {"inertia": np.diag(machine.inertia)}
        found |= {name: np.maximum(found[name], 0.0) for name in ROTOR_AIR}
        left = _left_open(fit)
        for name, ends in self.bands.items():
            # Strengths share their patterns: what leaves one of these open leaves all of them so.
            as_before = np.any(left[name]) if name == "strength" else left.get(name, False)
            as_before = np.broadcast_to(as_before, np.shape(np.ravel(ends[0])))
            for i, (value, a, b) in enumerate(zip(*map(np.ravel, (found[name], *ends)), strict=True)):
                label = name if np.size(ends) == 2 else f"{name}[{i}]"
                said = "  as known before" if as_before[i] else ""
                lines.append(f"{label:16s} {value:12.5g}   {a:.5g} to {b:.5g}{said}")
        low, high = self.torque_over_inertia
        ratio = machine.drag_ratio / machine.inertia[2, 2]
        lines.append(f"{'drag_ratio / I_3':16s} {ratio:12.5g}   {low:.5g} to {high:.5g}")
        lines += ["", "prediction errors      rms, over expected, correlation with the next"]
        for name in CHANNELS:
            rms, ratio, correlation = self._explain(name)
            if np.isfinite(rms):
                colour = "" if abs(correlation) < WHITE else "  coloured: something is not in the model"
                lines.append(f"{name:16s} {rms:12.3g} {ratio:10.2f} {correlation:10.2f}{colour}")
        asked = dict.fromkeys(MORE[name] for name in MORE if FIELDS.get(name, name) in self.untold)
        lines += ["", f"{fit.passes} passes of the filter, {'converged' if self.converged else 'NOT converged'}"]
        if found["delay"] <= 0.0:
            lines.append("delay ended at 0: if commands are stamped later than they were sent, the lag is wrong")
        if fit.last.refused:
            lines.append(f"{fit.last.refused} readings left out, as they are far from their predictions")
        lines += [f"to tell more: {one}" for one in asked]
        return "\n".join(lines) + "\n"

    @property
    def converged(self) -> bool:
        """Whether the search ended; if not, numbers may be off by more than their bands."""
        return self._fit.converged

    @property
    def torque_over_inertia(self) -> tuple[float, float]:
        """Band of drag_ratio/I₃, 1/(kg m): yaw reveals the quotient, and its band is far narrower than theirs."""
        at = places(self._fit.search.table)
        a, b = at["drag_ratio"].start, at["inertia"].stop - 1
        C = self._fit.covariance
        spread = T_975 * np.sqrt(max(C[a, a] + C[b, b] - 2 * C[a, b], 0.0))
        middle = self.vehicle.drag_ratio / self.vehicle.inertia[2, 2]
        return float(middle * np.exp(-spread)), float(middle * np.exp(spread))

    def _explain(self, name: str) -> tuple[float, float, float]:
        """Return, of a channel's prediction errors, rms, rms over expected, and correlation of each with the next."""
        errors, spreads = (part[:, places(CHANNELS)[name]] for part in (self._fit.last.errors, self._fit.last.spreads))
        known = np.isfinite(errors).all(axis=1)
        if known.sum() < 10:
            return np.nan, np.nan, np.nan
        white = errors[known] / spreads[known]
        correlation = np.mean(white[1:] * white[:-1]) / np.mean(white**2)
        return (
            float(np.sqrt(np.mean(errors[known] ** 2))), float(np.sqrt(np.mean(white**2))), float(correlation)
        )  # fmt: skip


def conclude(fit: Fit, guess: Vehicle, mass_error: float) -> Identified:
    """Return what `fit` says of `guess`, whose mass is known within the share `mass_error`."""
    search, n = fit.search, len(guess.rotor_spins)
    values, at = search.values(fit.theta), places(search.table)
    a, b, c = values["inertia"]
    flat = min(1.0, (a + b) / c)  # moments keep the triangle inequality; what is told is their quotient with the torque
    values |= {"inertia": np.array([a, b, flat * c]), "drag_ratio": flat * values["drag_ratio"]}
    errors = np.sqrt(np.diag(fit.covariance))
    spans: dict[str, Any] = {}
    for name, place in at.items():
        half = T_975 * errors[place]
        # Of logarithms, but for the air.
        more = mass_error * (values[name] if name in ROTOR_AIR else 1.0)
        spans[name] = np.hypot(half, more) if name in WITH_MASS else half
    bands: dict[str, Band] = {"mass": (guess.mass * (1 - mass_error), guess.mass * (1 + mass_error))}
    for name in ("rod_length", "bob_mass", "inertia", "drag_ratio", "lag", "spin_up"):
        bands[FIELDS.get(name, name)] = _band(values[name] * np.exp(-spans[name]), values[name] * np.exp(spans[name]))
    bands["thrust_scale"] = _band(*(np.exp(values["scale"] + sign * spans["scale"]) for sign in (-1, 1)))
    for name in ("pivot_offset", *ROTOR_AIR, "sag", "delay", "latency"):
        least = -np.inf if name in ("pivot_offset", "latency") else 0.0
        bands[name] = _band(*(np.maximum(values[name] + sign * spans[name], least) for sign in (-1, 1)))
    shares, basis = values["shares"], patterns(n)
    spread = T_975 * np.sqrt(np.einsum("ij,jk,ik->i", basis, fit.covariance[at["shares"], at["shares"]], basis))
    strength = np.exp(basis @ shares)
    bands["strength"] = _band(strength * np.exp(-spread), strength * np.exp(spread))
    untold = tuple(field for field, left in _left_open(fit).items() if field in bands and np.any(left))
    vehicle = _machine(guess, values, bands)
    plant = Plant(
        delay=float(values["delay"][0]), sag=float(values["sag"][0]), spin_up=float(values["spin_up"][0]),
        strength=tuple(strength),
    )  # fmt: skip
    return Identified(vehicle, bands, plant.delay, plant, untold, fit)


def _left_open(fit: Fit) -> dict[str, Any]:
    """Return, by field, of which of the numbers searched the log says next to nothing."""
    left = np.sqrt(np.diag(fit.covariance)) > LEARNED * fit.search.spread
    return {FIELDS.get(name, name): left[place] for name, place in places(fit.search.table).items()}


def _machine(guess: Vehicle, values: dict[str, Any], bands: dict[str, Band]) -> Vehicle:
    """Return the vehicle with the numbers found. A pivot stays where the guess has it unless its band excludes that."""
    number = {name: float(value[0]) for name, value in values.items() if len(value) == 1}
    inertia = np.array(guess.inertia)
    np.fill_diagonal(inertia, values["inertia"])
    rod = stretch(guess, number["bob_mass"] / guess.bob_mass, number["rod_length"] / guess.rod_length)
    changes: dict[str, Any] = rod | {
        "inertia": inertia, "drag_ratio": number["drag_ratio"], "rotor_lag": number["lag"],
        "thrust_scale": float(np.exp(number["scale"])), "bands": bands,
    }  # fmt: skip
    low, high = (np.array(end) for end in bands["pivot_offset"])
    if np.any((guess.pivot_offset < low) | (guess.pivot_offset > high)):
        changes["pivot_offset"] = values["pivot_offset"]
    if guess.air is not None:
        changes["air"] = {name: max(0.0, number[name]) for name in ROTOR_AIR}
    return guess.replace(**changes)


def _band(low: Any, high: Any) -> Band:
    return tuple(float(one[0]) if np.size(one) == 1 else tuple(map(float, one)) for one in (low, high))  # type: ignore[return-value]
