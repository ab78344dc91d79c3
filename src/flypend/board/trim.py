"""The trim of a vehicle, found in flight: the moment that its rotors exert beyond their model.

Where the centre of mass is off, or one rotor is weaker than another, a thrust f exerts a moment f ρ beside the modelled
one τ. The flight computer asks its rotors for f ρ less, with ρ the trim, m. What is sent then acts as the model says,
so nothing else on board knows of it. Over a control period h the angular velocity tells the mean moment,

    J Δω/h + ω × Jω = τ + f δρ,

with δρ what is wrong with ρ, which follows by recursive least squares with forgetting.
"""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np

from flypend.board.believed import Believed
from flypend.compile.record import Field, Record
from flypend.geometry import Numbers, Scalar, Vector
from flypend.laws.inverted_gains import angular_authority
from flypend.plants.actuation import rotor_forces

RECORD = Record(
    "trim",
    "Estimator of the trim.",
    (
        Field("lever", 3, "moment per thrust beyond the model, body, m"),
        Field("weighed", 0, "what the past tells of it, N^2 s"),
    ),
)
# Time over which the past is forgotten, s, and how long a hover weighs as much as what is assumed before the flight, s:
# a first estimate takes a fifth of a second; a small vehicle with a centre of mass that is off falls over as fast.
# With 0.5 s, rotors that spin up slowly are taken for a trim in each flip: 5 to 10 % of such flights miss a catch.
FORGETTING, DOUBT = 1.5, 0.2
# While moments change, what is measured depends on the delay, of which the flight computer is not sure: in a flip it
# hardly counts. It counts half if moments differ by this share of the largest within the delays that there may be.
STEADY = 0.05
# Largest trim, as a share of the largest moment per weight: with more, there is nothing left to steer with.
MOST = 0.5


def follow(
    memory: Numbers, lacking: Vector, thrust: Scalar, spread: Scalar, fresh: Scalar, period: float, vehicle: Any
) -> Numbers:
    """Return the memory (4,) after a `period` (s) in which a moment `lacking` (3,), N m, was seen beyond the model.

    `thrust` is the mean f, N, `spread` the square of how far the modelled angular acceleration differs if the delay is
    another, (rad/s²)², and `fresh` 1 if anything was measured, else 0.
    """
    trim, authority = RECORD.split(memory), angular_authority(vehicle)
    share = fresh / (1 + spread / (STEADY * authority) ** 2)
    weighed = np.exp(-period / FORGETTING) * trim["weighed"] + share * period * thrust**2
    gain = share * period * thrust / (weighed + DOUBT * vehicle.weight**2)
    most = MOST * authority * vehicle.I[0, 0] / vehicle.weight
    lever = ca.fmin(ca.fmax(trim["lever"] + gain * lacking, -most), most)
    return RECORD.join({"lever": lever, "weighed": weighed})


def trim(believed: Believed, *, limits: bool) -> ca.Function:
    """Return (command (n,), lever (3,), params) → forces (n,) to send for it, N, within the `limits`."""
    command, lever = ca.SX.sym("u", believed.rotors), ca.SX.sym("trim", 3)
    thrust = ca.sum1(command)
    moment = ca.mtimes(believed.vehicle.mixing(), command)[1:] - thrust * lever
    sent = rotor_forces(thrust, moment, believed.vehicle, limits)
    sent = ca.if_else(ca.fabs(thrust) < np.inf, sent, np.nan)  # NaN, which limits would hide
    return ca.Function("trim", [command, lever, believed.symbols], [ca.densify(sent)])
