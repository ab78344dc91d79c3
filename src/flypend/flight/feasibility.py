"""Whether any controller can fly a vehicle: thrust against weight, and how far the rod may lean before it is lost.

A rod that stands on a hovering vehicle falls like θ̈ = w² (θ − φ), w² = (M+m) g/(M l), φ being the tilt of the thrust
axis. The rotors turn that axis with φ̈ = α u, |u| ≤ 1, after a delay τ and a lag T. The mode that grows, s = θ̇ + w θ,
obeys ṡ = w s − w² φ. It stays bounded only if s(0) = w² ∫ e^{−wt} φ dt, which is w² times the Laplace transform of φ at
w: at most (α/w) e^{−wτ}/(1 + wT). From rest, s = w θ, so that no controller catches a lean beyond

    θ_c = (α/w²) e^{−wτ}/(1 + wT).

α/w² is the agility, α l/g for a light bob; wT and wτ are lag and delay against √(l/g). In a linear loop, a delay τ
against a mode that grows with w makes the complementary sensitivity peak at e^{wτ} or more, whatever the controller. A
lag counts like a delay: its inverse asks the rotors for more than they have, and for a model that nobody knows. With
the customary limit of 2 on the peak, w (T + τ) may be ln 2.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from flypend.flight.request import Flight
from flypend.laws.inverted_gains import angular_authority
from flypend.model import Vehicle
from flypend.plants import Sampled

# rad. What arrives upright from a swing-up, a gust or a noisy estimate leans by some degrees.
LEAST_CATCH = 0.25
LARGEST_PEAK = 2.0
# A fifth of the weight is what is left to climb with and to stop a fall.
LEAST_THRUST_RATIO = 1.2


@dataclass(frozen=True)
class Feasibility:
    """What a vehicle's numbers allow, whatever the law.

    Parameters
    ----------
    thrust_ratio : float
        Largest thrust over weight.
    fall_rate : float
        w, the rate at which the rod falls from upright on a hovering vehicle, 1/s.
    agility : float
        α/w², with the largest angular acceleration α: in rad, the largest lean caught by rotors without lag.
    lag_ratio : float
        w T, the rotor lag relative to the time that the rod takes to fall.
    catch : float
        θ_c, rad: in the linear model of this module no controller catches a larger lean at rest, towards the axis of
        roll or of pitch that turns more slowly. Along a diagonal the rotors may turn the vehicle faster.
    impossible : tuple of str
        Why no controller can fly the vehicle; empty if one may.
    doubtful : tuple of str
        What leaves too little room for a controller that is less than perfect.
    """

    thrust_ratio: float
    fall_rate: float
    agility: float
    lag_ratio: float
    catch: float
    impossible: tuple[str, ...]
    doubtful: tuple[str, ...]


def feasibility(vehicle: Vehicle, delay: float = 0.0) -> Feasibility:
    """Return what the numbers of `vehicle` allow, for commands that act `delay` (s) after their measurement."""
    vehicle = vehicle.commanded()
    rotors, (low, high) = len(vehicle.rotor_spins), vehicle.rotor_limits
    weight = vehicle.weight
    w = float(np.sqrt(weight / (vehicle.M * vehicle.l)))
    authority = angular_authority(vehicle)
    agility = authority / w**2 if w > 0 else np.inf
    lag_ratio = w * vehicle.rotor_lag
    catch = agility * np.exp(-w * delay) / (1 + lag_ratio)
    impossible = []
    if weight == 0:
        impossible.append("without gravity no pose of the rod is upright")
    elif rotors * high <= weight:
        masses = f"mass {vehicle.mass:g} kg + bob_mass {vehicle.bob_mass:g} kg (not g)"
        impossible.append(f"{rotors} rotors push {rotors * high:.4g} N, the weight is {weight:.4g} N with {masses}")
    elif rotors * low >= weight:
        impossible.append(f"{rotors} rotors push at least {rotors * low:.4g} N, the weight is only {weight:.4g} N")
    ratio = rotors * high / weight if weight > 0 else np.inf
    found = Feasibility(float(ratio), w, float(agility), lag_ratio, float(catch), tuple(impossible), ())
    return found if impossible else replace(found, doubtful=_doubts(found, vehicle, delay))


def forewarn(flight: Flight) -> tuple[str, ...]:
    """Return what is impossible or doubtful of `flight` before it is flown: if it is to stand the rod, by rotors."""
    if not isinstance(flight.plant, Sampled) or not flight.plant.limits or flight.law.e3 == "down":
        return ()
    found = feasibility(flight.plant.true_vehicle(flight.vehicle), flight.plant.delay)
    return (*found.impossible, *found.doubtful)


def _doubts(found: Feasibility, vehicle: Vehicle, delay: float) -> tuple[str, ...]:
    doubts, w = [], found.fall_rate
    if found.thrust_ratio < LEAST_THRUST_RATIO:
        doubts.append(
            f"the largest thrust is {found.thrust_ratio:.3g} times the weight; it takes {LEAST_THRUST_RATIO:g} times"
        )
    if found.catch < LEAST_CATCH:
        doubts.append(
            f"no controller catches a rod that leans by more than {np.degrees(found.catch):.2g}° at rest (agility "
            f"α l/g {found.agility:.3g}); stronger rotors further out, less inertia or a longer rod help"
        )
    late = vehicle.rotor_lag + delay
    if w * late > np.log(LARGEST_PEAK):
        longest = np.log(LARGEST_PEAK) / w
        doubts.append(
            f"rotor lag and delay of {1e3 * late:.3g} ms are too long for a rod that falls with {w:.3g} 1/s: at most "
            f"{1e3 * longest:.3g} ms, or a rod {(late / longest) ** 2:.3g} times as long"
        )
    return tuple(doubts)
