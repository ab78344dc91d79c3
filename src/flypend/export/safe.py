"""What exported code does where it cannot fly the law: it levels out as long as the attitude can be trusted."""

from __future__ import annotations

from typing import Any

import casadi as ca

from flypend.geometry import E3, apply, cross, scale
from flypend.model import State
from flypend.model.momenta import moment_for
from flypend.model.state import SIZE
from flypend.plants.loop import Loop

# Damping times the time from measurement to moment. A loop of rates around a pure delay is unstable from π/2 on.
SHARE = 1 / 2


def levelling_gains(loop: Loop) -> tuple[float, float]:
    """Stiffness (1/s²) and critical damping (1/s) that the rotors of `loop` can follow without lead and prediction."""
    slowness = loop.vehicle.rotor_lag + loop.law.computer.latency + 1 / loop.sampled.rate
    damping = SHARE / slowness
    return (damping / 2) ** 2, damping


def hold_level(loop: Loop, vehicle: Any, params: Any) -> ca.Function:
    """(state (24,), params) → wrench (4,), e₃ up, that turns z up, damps the rates and carries vehicle and bob.

    With θ the angle between z and e₃: α = k 2 sin(θ/2) (z × e₃)/|z × e₃| − d ω, which vanishes upside down only there,
    and τ = I α + ω × I ω. The thrust is the weight times cos θ, and none where it would push down. It reads nothing of
    the state but attitude and rates.
    """
    packed = ca.SX.sym("state", SIZE)
    state = State.symbolic(packed)
    stiffness, damping = levelling_gains(loop)
    turn = scale(stiffness / ca.sqrt((1 + state.z[2]) / 2 + 1e-3), apply(state.R.T, cross(state.z, E3)))
    moment = moment_for(turn - damping * state.omega, state.omega, vehicle)
    thrust = vehicle.weight * ca.fmax(state.z[2], 0)
    return ca.Function("hold", [packed, params], [ca.cse(ca.densify(ca.vertcat(thrust, moment)))])
