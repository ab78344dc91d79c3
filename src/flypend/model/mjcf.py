"""A vehicle as a model for MuJoCo: bodies, joints and motors, none of the package's equations."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from flypend import errors

# Moment of inertia of the bob about its centre per m l², and its minimum in kg m²: MuJoCo rejects a moving body below
# 1e-15. It is the relative error of the rod's moment of inertia about the pivot, and changes the state by 1e-10 after
# 1 s of flight. It is also the only inertia about the rod's own axis, so roundoff spins the rod about that axis (to
# 0.04 rad/s in 10 s at rates of 20 rad/s), with no effect on the motion. At 1e-15 MuJoCo warns of a singular inertia
# matrix.
BOB_INERTIA, LEAST_BOB_INERTIA = 4e-12, 1e-14

_TEMPLATE = """\
<mujoco model="flypend">
  <option integrator="RK4" timestep="{timestep!r}" gravity="0 0 {gravity!r}">
    <flag constraint="disable" contact="disable" autoreset="disable" energy="{energy}"/>
  </option>
  <default>
    <geom type="capsule" mass="0" contype="0" conaffinity="0"/>
  </default>
  <worldbody>
    <light pos="0 0 5" mode="track"/>
    <body name="vehicle">
      <freejoint/>
      <inertial pos="{center}" mass="{mass!r}" diaginertia="{moments}" xyaxes="{axes}"/>
{rotors}
      <body name="bob">
        <joint name="pivot" type="ball"/>
        <inertial pos="0 0 {length!r}" mass="{bob_mass!r}" diaginertia="{across!r} {across!r} {i!r}"/>
        <geom name="rod" fromto="0 0 0 0 0 {length!r}" size="{thin!r}" rgba="0.45 0.45 0.45 1"/>
        <geom name="bob" type="sphere" pos="0 0 {length!r}" size="{thick!r}" rgba="0.84 0.37 0 1"/>
      </body>
    </body>
  </worldbody>
  <actuator>
{motors}
  </actuator>
</mujoco>
"""
_SHOWN = re.compile(r"^ *<(geom name=|light ).*\n", flags=re.MULTILINE)
_ROTOR = """\
      <site name="rotor{k}" pos="{pos}"/>
      <geom name="disc{k}" type="cylinder" pos="{pos}" size="{disc!r} {thin!r}" rgba="0 0.45 0.7 0.5"/>"""
_ARM = '      <geom name="arm{k}" fromto="{center} {pos}" size="{thin!r}" rgba="0.2 0.2 0.2 1"/>'
_MOTOR = '    <general name="rotor{k}" site="rotor{k}" gear="0 0 1 0 0 {torque!r}"{more}/>'
_FILTER = ' dyntype="filter" dynprm="{lag!r}"'
_RANGE = ' ctrlrange="{!r} {!r}"'


def model_xml(vehicle: Any, *, timestep: float, lag: float = 0.0, limits: bool = False, bare: bool = False) -> str:
    """MJCF (MuJoCo's XML) model of `vehicle` in a z-up world; its controls are the rotor forces in N.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle parameters. Each rotor exerts a force along the body's third axis and a torque of drag_ratio · spin per
        unit force.
    timestep : float
        Step of the integrator, s.
    lag : float
        Time constant of the rotor forces, s; 0 for none.
    limits : bool
        Whether MuJoCo keeps the controls within the vehicle's rotor limits; otherwise that is up to the caller.
    bare : bool
        Whether to leave out what does not move the machine: geoms, light, and the energy at every step. The motion is
        the same, bit by bit, a tenth faster.

    Returns
    -------
    str
        A model without contacts and damping. Its geoms are for display only: no mass, no collisions.

    Raises
    ------
    InputError
        If the timestep is not positive.
    """
    timestep = errors.number("timestep", timestep, above=0, unit="s")
    offset, places = vehicle.pivot_offset, vehicle.rotors_from_pivot
    torques = vehicle.drag_ratio * vehicle.rotor_spins
    moments, axes = np.linalg.eigh(vehicle.inertia)
    moments[2] = min(moments[2], moments[0] + moments[1])  # planar body: MuJoCo tolerates no roundoff here
    thin, (across, along) = drawn_thickness(vehicle), rod_moments(vehicle)
    center = numbers(0.0 - offset)
    rotors = []
    for k, place in enumerate(places):
        look = {"k": k, "pos": numbers(place), "center": center, "thin": thin, "disc": 20 * thin}
        rotors.append(_ROTOR.format(**look))
        if np.linalg.norm(vehicle.rotor_positions[k]) > thin:  # MuJoCo rejects a capsule of zero length
            rotors.append(_ARM.format(**look))
    more = _FILTER.format(lag=lag) if lag > 0 else ""
    more += _RANGE.format(*vehicle.rotor_limits.tolist()) if limits else ""
    model = _TEMPLATE.format(
        timestep=timestep,
        gravity=-vehicle.g,
        center=center,
        mass=vehicle.mass,
        moments=numbers(moments),
        axes=numbers(axes[:, :2].T),
        length=vehicle.rod_length,
        bob_mass=vehicle.bob_mass,
        i=along,
        across=across,
        thin=thin,
        thick=4 * thin,
        energy="disable" if bare else "enable",
        rotors="\n".join(rotors),
        motors="\n".join(_MOTOR.format(k=k, torque=float(torque), more=more) for k, torque in enumerate(torques)),
    )
    return _SHOWN.sub("", model) if bare else model


def drawn_thickness(vehicle: Any) -> float:
    """Return the radius with which rod and arms are drawn, m."""
    return 0.02 * float(np.max(np.abs(vehicle.rotor_positions)))


def rod_moments(vehicle: Any) -> tuple[float, float]:
    """Return the rod's moments of inertia about its centre of mass, across and along it, kg m², as engines take them.

    They are never 0.
    """
    least = max(BOB_INERTIA * vehicle.bob_mass * vehicle.rod_length**2, LEAST_BOB_INERTIA)
    return vehicle.rod_inertia + least, max(vehicle.rod_spin_inertia, least)


def numbers(values: Any) -> str:
    """Format an array for XML with full precision."""
    return " ".join(repr(float(value)) for value in np.ravel(values))
