"""From state to command: law, control allocation within limits, and rotor lead."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np

from flypend.board.nominal import Nominal
from flypend.compile.record import Field, Record
from flypend.geometry import Numbers, Scalar, clip
from flypend.laws import BoundLaw, Controller
from flypend.laws.closed_loop import check_parameters
from flypend.model import State, Vehicle
from flypend.model.altered import Altered
from flypend.model.momenta import angular_acceleration
from flypend.model.state import SIZE
from flypend.plants.actuation import rotor_forces
from flypend.plants.lag import largest_lead
from flypend.plants.loop import Loop
from flypend.plants.plant import Plant

# What the board has found of the world beyond its model, and hands to law and prediction.
OUTSIDE = Record(
    "outside",
    "What is found beyond the model.",
    (
        Field("forces", 6, "external forces on vehicle and bob beside the scaled thrust, world, e3 up, N"),
        Field("scale", 0, "true over modelled thrust, less 1"),
        Field("pull", 0, "nominal over true length of the rod, less 1"),
    ),
)
# (t, state (24, 1), forces (6, 1), reference, gains by name, vehicle) → thrust and moment (4, 1), e₃ up, symbolic.
Steering = Callable[[Any, Any, Any, Any, dict[str, Any], Any], Any]


def steering(law: BoundLaw) -> Steering:
    """Return the steering of a bound `law` about its own reference."""
    return lambda t, packed, forces, _, gains, vehicle: law.upright(t, packed, forces, gains, vehicle)


def usable_lead(law: BoundLaw | Controller, vehicle: Vehicle, plant: Plant) -> float:
    """Return the lead of `law`, limited so that a rotor of `vehicle` reaches its force in one period of `plant`.

    See `plants.lag.largest_lead`.
    """
    return float(min(law.computer.lead, largest_lead(vehicle.rotor_lag, 1 / plant.rate)))


def command_width(loop: Loop) -> int:
    """Return the size of a command of `loop`: one force per rotor, or thrust and body rates."""
    return 4 if loop.sampled.interface == "rates" else len(loop.vehicle.rotor_spins)


def law_command(loop: Loop, nominal: Nominal, steer: Steering, reference: int = 0) -> ca.Function:
    """Return the law of `loop` as (t, horizon, state, rotors, forces, reference, gains, params) → command.

    Parameters
    ----------
    loop : Loop
        Source of law, interface, limits, lead, and the input gains.
    nominal : Nominal
        The nominal vehicle of the equations; `params` are its symbols.
    steer : Steering
        The wrench of the law.
    reference : int
        Length of the input `reference`.

    Returns
    -------
    Function
        Inputs: time of the measurement and how much later the command acts, s; for then, state (24,), e₃ up, modelled
        rotor forces (n,), N, and `OUTSIDE` (8,); reference, gains and params. For the interface "wrench", a
        command is the rotor forces (n,), N, with lead; for "rates", thrust and body rates (4,), which the onboard
        proportional rate loop turns into the law's moment.
    """
    t, horizon = ca.SX.sym("t"), ca.SX.sym("h")
    packed, p = ca.SX.sym("s", SIZE), ca.SX.sym("p", len(loop.parameters))
    rotors, outside = ca.SX.sym("r", nominal.rotors), ca.SX.sym("F", OUTSIDE.length)
    path = ca.SX.sym("path", reference)
    gains = {name: p[i] for i, name in enumerate(loop.parameters)}
    parts = OUTSIDE.split(outside)
    vehicle = nominal.vehicle
    if loop.symbolic.uses_forces:
        vehicle = Altered(vehicle, l=found_length(vehicle, outside))
    wrench = steer(t, packed, parts["forces"], path, gains, vehicle)
    check_parameters(loop.law.name, wrench, loop.parameters, p)
    wrench = rescale(ca.substitute(wrench, t, t + horizon), outside)
    command = to_command(loop, nominal, wrench, packed, rotors)
    inputs = [t, horizon, packed, rotors, outside, path, p, nominal.symbols]
    return ca.Function("command", inputs, [ca.cse(ca.densify(command))])


def total_forces(nominal: Nominal) -> ca.Function:
    """Return (state (24,), rotors (n,), `OUTSIDE` (8,)) → external forces (6,), N, with what scales the thrust."""
    packed, rotors, outside = ca.SX.sym("s", SIZE), ca.SX.sym("r", nominal.rotors), ca.SX.sym("F", OUTSIDE.length)
    parts = OUTSIDE.split(outside)
    scaled = parts["scale"] * ca.sum1(rotors) * State.symbolic(packed).z
    return ca.Function("total", [packed, rotors, outside], [parts["forces"] + ca.vertcat(scaled, np.zeros(3))])


def found_length(vehicle: Any, outside: Numbers) -> Scalar:
    """Return the length of the rod of a nominal `vehicle` as found, m."""
    return vehicle.l / (1 + OUTSIDE.split(outside)["pull"])


def rescale(wrench: Numbers, outside: Numbers) -> Numbers:
    """Return the `wrench` (4,) to ask of the model's rotors for that of the law.

    A weak rotor, or a heavier vehicle, acts along the thrust axis and turns with it. Told to the law as a force that
    stays where it is, it would make the loop of the thrust axis weaker by as much: the law would turn against it.
    """
    return ca.vertcat(wrench[0] / (1 + OUTSIDE.split(outside)["scale"]), wrench[1:])


def finish(loop: Loop, nominal: Nominal) -> ca.Function:
    """Return (wrench (4,) with e₃ up, state (24,), rotors (n,), params) → command, for a callable law."""
    wrench, packed, rotors = ca.SX.sym("W", 4), ca.SX.sym("s", SIZE), ca.SX.sym("r", nominal.rotors)
    command = to_command(loop, nominal, wrench, packed, rotors)
    return ca.Function("finish", [wrench, packed, rotors, nominal.symbols], [ca.densify(command)])


def to_command(loop: Loop, nominal: Nominal, wrench: Numbers, packed: Numbers, rotors: Numbers) -> Numbers:
    """Return the command for a wrench (4,), e₃ up, in CasADi; NaN for an invalid wrench, which limits would hide."""
    thrust, moment = wrench[0], wrench[1:]
    vehicle, plant = nominal.vehicle, loop.sampled
    if plant.interface == "rates":
        omega = State.symbolic(packed).omega
        return ca.vertcat(thrust, omega + angular_acceleration(moment, omega, vehicle) / plant.rate_loop_gain)
    lead = usable_lead(loop.law, loop.vehicle, plant)
    command = lead_rotors(rotor_forces(thrust, moment, vehicle, plant.limits), rotors, lead)
    if plant.limits:
        command = clip(command, vehicle.rotor_limits[0], vehicle.rotor_limits[1])
    return ca.if_else(ca.norm_1(wrench) < np.inf, command, np.nan)


def lead_rotors(wanted: Numbers, rotors: Numbers, lead: Scalar) -> Numbers:
    """Return commands (n,), N, that drive `rotors`, modelled forces (n,), to `wanted`; `lead` as in `Computer`."""
    return rotors + lead * (wanted - rotors)


def idle_command(loop: Loop, rotors: Numbers) -> Numbers:
    """Return the command before the first one arrives: current `rotors` (n,), N, or zero thrust and rates."""
    return np.zeros(4) if loop.sampled.interface == "rates" else rotors
