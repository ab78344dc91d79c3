"""The trim of a vehicle, found in flight: the moment that its rotors exert beyond their model.

Where the centre of mass is off, or one rotor is weaker than another, a thrust f exerts a moment f ρ beside the modelled
one τ; where all are weak, or the vehicle is harder to turn, (1 + σ) τ acts. The flight computer asks its rotors for
τ/(1 + σ) − f ρ, with ρ the lever, m, and σ the strength of the trim. What is sent then acts as the model says, so
nothing else on board knows of it. Over a control period h the angular velocity tells the mean moment,

    J Δω/h + ω × Jω = (1 + δσ) τ + f δρ,

with δρ and δσ what is wrong with ρ and σ, which follow by recursive least squares with forgetting.
"""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np

from flypend.board.nominal import Nominal
from flypend.compile.record import Field, Record
from flypend.geometry import Numbers, Scalar, Vector, clip
from flypend.laws.inverted_gains import angular_authority
from flypend.plants.actuation import rotor_forces

# With what is lacking q, the modelled p and the thrust f of the past, weighted: q = f a + σ p, with a the acceleration
# per thrust that the lever makes.
SUMS = Record(
    "sums",
    "Normal equations of the strength.",
    (
        Field("ff", 0, "N^2 s"),
        Field("fp", 3, "N rad/s"),
        Field("fq", 3, "N rad/s"),
        Field("pp", 0, "rad^2/s^3"),
        Field("pq", 0, "rad^2/s^3"),
    ),
)
RECORD = Record(
    "trim",
    "Estimator of the trim.",
    (
        Field("lever", 3, "moment per thrust beyond the model, body, m"),
        Field("weighed", 0, "what the past tells of it, N^2 s"),
        Field("strength", 0, "true over modelled moment, less 1"),
        Field("sums", SUMS.length, "that tell the strength"),
    ),
)
# Time over which the past is forgotten, s, and how long a hover weighs as much as what is assumed before the flight, s:
# a first estimate takes a fifth of a second; a small vehicle with a centre of mass that is off falls over as fast.
# With 0.5 s, rotors that spin up slowly are taken for a trim in each flip: 5 to 10 % of such flights miss a catch.
FORGETTING, DOUBT = 1.5, 0.2
# While moments change, what is measured depends on the delay, of which the flight computer is not sure: in a flip it
# hardly counts. It counts half if moments differ by this share of the largest within the delays that there may be.
STEADY = 0.05
# A moment tells the strength if it is a fair share of the largest, and counts half at HARD: in hover, noise of the
# gyroscope comes back as moments. A flip at full moment for DOUBTED (s) weighs as much as what is assumed before the
# flight: with twice that one throw tells only three fifths of a strength. They are forgotten over TESTED (s).
HARD, DOUBTED, TESTED = 0.02, 0.0001, 2.0
# The largest strength that is believed, either way, as of the thrust.
MOST_STRENGTH = 0.5
# Largest trim, as a share of the largest moment per weight: with more, there is nothing left to steer with.
MOST = 0.5


def follow_lever(
    memory: Numbers, lacking: Vector, thrust: Scalar, spread: Scalar, fresh: Scalar, period: float, vehicle: Any
) -> Numbers:
    """Return the memory after a `period` (s) in which a moment `lacking` (3,), N m, was seen beyond the model.

    `thrust` is the mean f, N, `spread` the square of how far the modelled angular acceleration differs if the delay is
    another, (rad/s²)², and `fresh` 1 if anything was measured, else 0.
    """
    trim, authority = RECORD.split(memory), angular_authority(vehicle)
    share = fresh / (1 + spread / (STEADY * authority) ** 2)
    weighed = np.exp(-period / FORGETTING) * trim["weighed"] + share * period * thrust**2
    gain = share * period * thrust / (weighed + DOUBT * vehicle.weight**2)
    most = MOST * authority * vehicle.I[0, 0] / vehicle.weight
    lever = clip(trim["lever"] + gain * lacking, -most, most)
    return RECORD.join(trim | {"lever": lever, "weighed": weighed})


def follow_strength(
    memory: Numbers, lacking: Vector, modelled: Vector, thrust: Scalar, weight: Scalar, vehicle: Any
) -> Numbers:
    """Return the memory after a period with an angular acceleration `lacking` (3,) beside a `modelled` one (3,).

    Both in rad/s², before any trim, behind the same filters as the `thrust`, N. The period counts with `weight`, s.
    """
    trim, largest = RECORD.split(memory), angular_authority(vehicle) ** 2
    square = ca.sumsqr(modelled)
    share = weight * square / (square + HARD**2 * largest)
    now = {"ff": thrust**2, "fp": thrust * modelled, "fq": thrust * lacking, "pp": square}
    now["pq"] = ca.dot(modelled, lacking)
    sums = {name: (1 - share / TESTED) * past + share * now[name] for name, past in SUMS.split(trim["sums"]).items()}
    goes = 1 / (sums["ff"] + 1e-9 * vehicle.weight**2) * sums["fp"]  # with the thrust; there is none yet at first
    residual = sums["pp"] - ca.dot(goes, sums["fp"])
    strength = (sums["pq"] - ca.dot(goes, sums["fq"])) / (residual + DOUBTED * largest)
    strength = clip(strength, -MOST_STRENGTH, MOST_STRENGTH)
    return RECORD.join(trim | {"strength": strength, "sums": SUMS.join(sums)})


def trim(nominal: Nominal, *, limits: bool) -> ca.Function:
    """Return (command (n,), memory (14,), params) → forces (n,) to send for it, N, within the `limits`."""
    command, memory = ca.SX.sym("u", nominal.rotors), ca.SX.sym("trim", RECORD.length)
    thrust, trim = ca.sum1(command), RECORD.split(memory)
    moment = ca.mtimes(nominal.vehicle.mixing(), command)[1:] / (1 + trim["strength"]) - thrust * trim["lever"]
    sent = rotor_forces(thrust, moment, nominal.vehicle, limits)
    sent = ca.if_else(ca.fabs(thrust) < np.inf, sent, np.nan)  # NaN, which limits would hide
    return ca.Function("trim", [command, memory, nominal.symbols], [ca.densify(sent)])
