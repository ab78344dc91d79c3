"""MuJoCo as an independent judge of the dynamics: bodies, joints and motors, none of the package's equations.

The vehicle is a free body, the rod a ball joint, the bob a point mass, each rotor a motor at its place; MuJoCo derives
the motion. What of MuJoCo's conventions matters here, each held by a test:

- `qpos` of a free joint is position and quaternion (w, x, y, z) of the body's frame, `qvel` its linear velocity in the
  world frame and its angular velocity in the body frame. The body's frame is put at the pivot and its inertia beside
  it, so position and velocity are those of the pivot.
- `qvel` of a ball joint is the angular velocity of the child relative to the parent, in the child's frame.
- `xfrc_applied` acts at a body's centre of mass and is constant in the world frame during a step; a motor on a site
  turns with the body within the stages of RK4.
- RK4 is of order 4 in attitude since MuJoCo 4.0. Before, it is of order 2 where the axis of rotation turns: after 1 s
  in steps of 0.5 ms the state is off by up to 8e-5 (MuJoCo 3.2) instead of 5e-10.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from flypend import errors
from flypend.errors import InputError
from flypend.model import State, Vehicle

# Moment of inertia of the bob about itself per m l², and its least value in kg m²: MuJoCo refuses a moving body below
# 1e-15. It is the relative error of the rod's moment of inertia about the pivot; after 1 s of flight it shows as 1e-10
# of the state. It is also all the inertia about the rod's own axis, about which roundoff therefore spins the rod, to
# 0.04 rad/s in 10 s at rates of 20 rad/s; nothing feels that. At 1e-15 MuJoCo warns of a singular inertia matrix.
BOB_INERTIA, LEAST_BOB_INERTIA = 4e-12, 1e-14

# MuJoCo takes the force of a motor as zero where it is NaN or larger than this (N), and only warns.
MAX_FORCE = 1e10

_TEMPLATE = """\
<mujoco model="flypend">
  <option integrator="RK4" timestep="{timestep!r}" gravity="0 0 {gravity!r}">
    <flag constraint="disable" contact="disable" autoreset="disable" energy="enable"/>
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
        <inertial pos="0 0 {length!r}" mass="{bob_mass!r}" diaginertia="{i!r} {i!r} {i!r}"/>
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
_ROTOR = """\
      <site name="rotor{k}" pos="{pos}"/>
      <geom name="disc{k}" type="cylinder" pos="{pos}" size="{disc!r} {thin!r}" rgba="0 0.45 0.7 0.5"/>"""
_ARM = '      <geom name="arm{k}" fromto="{center} {pos}" size="{thin!r}" rgba="0.2 0.2 0.2 1"/>'
_MOTOR = '    <motor name="rotor{k}" site="rotor{k}" gear="0 0 1 0 0 {torque!r}"/>'


def model_xml(vehicle: Vehicle, *, timestep: float, pivot_offset: Any = (0.0, 0.0, 0.0)) -> str:
    """The MJCF (MuJoCo's XML) of `vehicle` in a world with z up; its controls are the rotor forces in N.

    Parameters
    ----------
    vehicle : Vehicle
        What flies. Each rotor pushes along the body's third axis at its place and twists by drag_ratio · spin.
    timestep : float
        Step of the integrator, s.
    pivot_offset : (3,)
        Ball joint relative to the vehicle's centre of mass, body frame, m.

    Returns
    -------
    str
        A model without contacts, damping or limits. Its geoms are to be looked at: no mass, no collisions.

    Raises
    ------
    InputError
        For a timestep that is not positive or an offset that is not three finite numbers.
    """
    timestep = errors.number("timestep", timestep, above=0, unit="s")
    offset = errors.array("pivot_offset", pivot_offset, (3,))
    if offset.ndim != 1:
        raise InputError("pivot_offset", "numbers of shape (3)", f"shape {offset.shape}")
    places = vehicle.rotor_positions - offset
    torques = vehicle.drag_ratio * vehicle.rotor_spins
    moments, axes = np.linalg.eigh(vehicle.inertia)
    moments[2] = min(moments[2], moments[0] + moments[1])  # roundoff of a planar body; MuJoCo allows none
    thin = 0.02 * float(np.max(np.abs(vehicle.rotor_positions)))
    center = _numbers(0.0 - offset)
    rotors = []
    for k, place in enumerate(places):
        look = {"k": k, "pos": _numbers(place), "center": center, "thin": thin, "disc": 20 * thin}
        rotors.append(_ROTOR.format(**look))
        if np.linalg.norm(vehicle.rotor_positions[k]) > thin:  # MuJoCo refuses a capsule without length
            rotors.append(_ARM.format(**look))
    return _TEMPLATE.format(
        timestep=timestep,
        gravity=-vehicle.g,
        center=center,
        mass=vehicle.M,
        moments=_numbers(moments),
        axes=_numbers(axes[:, :2].T),
        length=vehicle.l,
        bob_mass=vehicle.m,
        i=max(BOB_INERTIA * vehicle.m * vehicle.l**2, LEAST_BOB_INERTIA),
        thin=thin,
        thick=4 * thin,
        rotors="\n".join(rotors),
        motors="\n".join(_MOTOR.format(k=k, torque=float(torque)) for k, torque in enumerate(torques)),
    )


class MujocoEngine:
    """A vehicle with its pendulum, moved by MuJoCo; the frame is that with e₃ up.

    It starts at the origin, at rest, level and inverted. `model` and `data` are MuJoCo's own, for a viewer or renderer.

    Parameters
    ----------
    vehicle : Vehicle
        What flies.
    timestep : float
        Step of the integrator (RK4), s.
    pivot_offset : (3,)
        Ball joint relative to the vehicle's centre of mass, body frame, m.

    Raises
    ------
    InputError
        If mujoco is not installed, or as `model_xml`.
    """

    def __init__(self, vehicle: Vehicle, *, timestep: float = 0.5e-3, pivot_offset: Any = (0.0, 0.0, 0.0)) -> None:
        errors.require("mujoco", extra="mujoco", for_="plant")
        import mujoco

        self._mujoco = mujoco
        self.model = mujoco.MjModel.from_xml_string(model_xml(vehicle, timestep=timestep, pivot_offset=pivot_offset))
        self.data = data = mujoco.MjData(self.model)
        self._advance = partial(mujoco.mj_step, self.model, data)
        self._update_frames = partial(mujoco.mj_kinematics, self.model, data)
        # Views into MuJoCo's memory, bound once: an attribute of `data` costs as much as a product of matrices.
        self._x, self._x_dot = data.qpos[0:3], data.qvel[0:3]
        self._omega, self._rod_rates = data.qvel[3:6], data.qvel[6:9]
        self._R, self._R_rod = data.body("vehicle").xmat.reshape(3, 3), data.body("bob").xmat.reshape(3, 3)
        self._rows, self._y = self._R.reshape(9), self._R_rod[:, 2]
        self._forces, self._all_external = data.ctrl, data.xfrc_applied.reshape(-1)
        self._on_vehicle, self._on_bob = (data.body(name).xfrc_applied[:3] for name in ("vehicle", "bob"))

    @property
    def timestep(self) -> float:
        """Step of the integrator, s."""
        return float(self.model.opt.timestep)

    def reset(self, packed: Any) -> None:
        """Set the state, at time 0; the rod does not spin about its own axis.

        Parameters
        ----------
        packed : (24,)
            As `State.packed`, frame with e₃ up: x, x_dot of the pivot, R by rows, omega (body frame), y, y_dot.

        Raises
        ------
        InputError
            As `State.from_packed`, and for a batch.
        """
        state = State.from_packed(packed)
        if state.batch_shape:
            raise InputError("packed state", "a single state", f"a batch of shape {state.batch_shape}")
        mujoco, data = self._mujoco, self.data
        mujoco.mj_resetData(self.model, data)
        quat_wxyz, rod_wxyz, inverse = np.empty(4), np.empty(4), np.empty(4)
        mujoco.mju_mat2Quat(quat_wxyz, state.R.ravel())
        mujoco.mju_quatZ2Vec(rod_wxyz, state.y)
        mujoco.mju_negQuat(inverse, quat_wxyz)
        self._x[:], data.qpos[3:7] = state.x, quat_wxyz
        mujoco.mju_mulQuat(data.qpos[7:11], inverse, rod_wxyz)
        self._update_frames()
        rod_omega = np.cross(state.y, state.y_dot)  # world frame
        self._x_dot[:], self._omega[:] = state.x_dot, state.omega
        self._rod_rates[:] = self._R_rod.T @ (rod_omega - self._R @ state.omega)

    @property
    def packed(self) -> Any:
        """The state (24,) in the order of `State.packed`, frame with e₃ up; x and x_dot are those of the pivot."""
        self._update_frames()
        R_rod = self._R_rod
        a, b, _ = self._rod_rates + (self._R @ self._omega) @ R_rod  # angular velocity of the rod, in its frame
        y_dot = b * R_rod[:, 0] - a * R_rod[:, 1]  # R_rod ((a, b, c) × e₃)
        return np.concatenate((self._x, self._x_dot, self._rows, self._omega, self._y, y_dot))

    def step(
        self,
        forces: Any,
        *,
        force_on_vehicle: Any = (0.0, 0.0, 0.0),
        force_on_bob: Any = (0.0, 0.0, 0.0),
    ) -> None:
        """Advance by one timestep under constant forces.

        Parameters
        ----------
        forces : (n,)
            Force of each rotor along the body's third axis, N, of either sign: limits and lag are the caller's.
        force_on_vehicle, force_on_bob : (3,)
            External forces at the vehicle's centre of mass and at the bob, world frame, N.

        Raises
        ------
        InputError
            For the wrong number of rotor forces, or a force that is not finite.
        """
        if len(forces) != len(self._forces):
            raise InputError("forces", f"numbers of shape ({len(self._forces)})", f"shape {np.shape(forces)}")
        self._forces[:] = forces
        self._on_vehicle[:] = force_on_vehicle
        self._on_bob[:] = force_on_bob
        size_squared = self._forces.dot(self._forces) + self._all_external.dot(self._all_external)
        if not size_squared < MAX_FORCE**2:  # true for NaN
            got = f"{self._forces} on the rotors, {self._on_vehicle} on the vehicle, {self._on_bob} on the bob"
            raise InputError("forces", "finite numbers", got)
        self._advance()

    def energy(self) -> float:
        """Kinetic plus potential energy, J; the potential energy is zero for both masses at height 0."""
        self._mujoco.mj_forward(self.model, self.data)
        return float(self.data.energy.sum())


def _numbers(values: Any) -> str:
    """An array as MJCF writes it, every digit kept."""
    return " ".join(repr(float(value)) for value in np.ravel(values))
