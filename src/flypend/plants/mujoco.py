"""MuJoCo as an independent check of the dynamics: bodies, joints and motors, none of the package's equations.

The vehicle is a free body, the rod a ball joint, the bob a point mass and each rotor a motor at its position; MuJoCo
derives the motion. The relevant MuJoCo conventions, each verified by a test:

- `qpos` of a free joint is position and quaternion (w, x, y, z) of the body frame, `qvel` its linear velocity in the
  world frame and its angular velocity in the body frame. The body frame is placed at the pivot and the inertia is
  offset from it, so position and velocity are those of the pivot.
- `qvel` of a ball joint is the angular velocity of the child relative to the parent, in the child's frame.
- `xfrc_applied` acts at a body's centre of mass and is constant in the world frame during a step; a motor on a site
  rotates with the body within the stages of RK4.
- RK4 is fourth order in attitude since MuJoCo 4.0. Earlier versions are second order if the rotation axis changes:
  after 1 s in 0.5 ms steps the state error reaches 8e-5 (MuJoCo 3.2) instead of 5e-10.
"""

from __future__ import annotations

import ctypes
import importlib
import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache, partial
from pathlib import Path
from threading import Lock
from typing import Any, ClassVar

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.building import built
from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.geometry import Matrix, Numbers, Vector, rotation_from_quat_xyzw
from flypend.model import State, Vehicle
from flypend.model.mjcf import model_xml
from flypend.model.state import SIZE
from flypend.plants.loop import Loop
from flypend.plants.plant import Plant
from flypend.plants.schedule import fewest_steps, segments_within, steps_in

# MuJoCo replaces a motor force that is NaN or larger than this (N) by zero, with only a warning.
MAX_FORCE = 1e10

# Maximum step in a flight, s. With RK4 the state error is 1e-7 after a second of tumbling. The rotor lag, a MuJoCo
# actuator filter, is integrated with the same steps. Forces from outside, held within a step, need shorter ones: at
# 2 ms a tumbling hehn2011 is off by up to 4e-4 after 0.3 s in air, a sixteenth of that at a quarter of the step.
FLIGHT_STEP, SURROUNDED_STEP = 2e-3, 0.5e-3
# A shorter lag than this, s, is none: it moves the vehicle by less than a sample can tell.
LEAST_LAG = 1e-4


class MujocoEngine:
    """Vehicle and pendulum simulated by MuJoCo, in the e₃-up frame.

    The initial state is at the origin, at rest, level and inverted. `model` and `data` are the MuJoCo objects, for
    viewers and renderers.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle parameters.
    timestep : float
        Step of the integrator (RK4), s.
    lag : float
        Time constant with which the rotor forces follow those passed to `step`, s; 0 for none.

    Raises
    ------
    InputError
        If mujoco is not installed, or like `model_xml`.
    """

    def __init__(self, vehicle: Vehicle, *, timestep: float = 0.5e-3, lag: float = 0.0) -> None:
        mujoco = _import_mujoco()
        self._mujoco = mujoco
        self._see, self._rod_spin = _compile_view(len(vehicle.rotor_spins)), vehicle.rod_spin
        xml = model_xml(vehicle, timestep=timestep, lag=lag)
        self.model = mujoco.MjModel.from_xml_string(xml)
        self.data = data = mujoco.MjData(self.model)
        self._advance = partial(mujoco.mj_step, self.model, data)
        # Views into MuJoCo's memory, bound once: reading an attribute of `data` costs as much as a matrix product.
        self._qpos, self._qvel = data.qpos, data.qvel
        self._rotors = data.act if lag > 0 else data.ctrl
        self._forces, self._all_external = data.ctrl, data.xfrc_applied.reshape(-1)
        self._on_vehicle, self._on_bob = (data.body(name).xfrc_applied for name in ("vehicle", "bob"))
        self._in_joint = data.joint("pivot").qfrc_applied

    @property
    def timestep(self) -> float:
        """Step of the integrator, s."""
        return float(self.model.opt.timestep)

    def reset(self, packed: Numbers, rotors: Numbers = None) -> None:
        """Set the state at time 0, with the vehicle's spin of the rod about its own axis.

        Parameters
        ----------
        packed : (24,)
            As `State.packed`, e₃-up frame: x, x_dot of the pivot, R in row-major order, omega (body frame), y, y_dot.
        rotors : (n,), optional
            Initial rotor forces, N; default 0.

        Raises
        ------
        InputError
            Like `State.from_packed`, and for a batch.
        """
        begin = mujoco_coordinates(packed, self._rod_spin)
        self._mujoco.mj_resetData(self.model, self.data)
        self._qpos[:], self._qvel[:] = begin[:POSITIONS], begin[POSITIONS:]
        self._rotors[:] = 0.0 if rotors is None else rotors

    @property
    def packed(self) -> Numbers:
        """The state (24,) in the order of `State.packed`, e₃-up frame; x and x_dot refer to the pivot."""
        return self._see(self._qpos, self._qvel, self._rotors)[0]

    @property
    def rotors(self) -> Numbers:
        """The rotor forces (n,), N."""
        return np.array(self._rotors)

    def step(
        self, forces: Numbers, force_on_vehicle: Vector = (0.0, 0.0, 0.0), force_on_bob: Vector = (0.0, 0.0, 0.0),
        torque_on_vehicle: Vector = (0.0, 0.0, 0.0), joint_torque: Vector = (0.0, 0.0, 0.0),
    ) -> None:  # fmt: skip
        """Advance by one timestep under constant forces.

        Parameters
        ----------
        forces : (n,)
            Commanded force of each rotor along the body's third axis, N, of either sign; limits are up to the caller.
        force_on_vehicle, force_on_bob : (3,)
            External forces at the centres of mass of vehicle and rod, world frame, N.
        torque_on_vehicle : (3,)
            External torque on the vehicle, world frame, N m.
        joint_torque : (3,)
            Torque of the joint on the rod, in the frame of the rod, N m; the vehicle feels the opposite.

        Raises
        ------
        InputError
            If the number of rotor forces is wrong, or a force is not finite.
        """
        if len(forces) != len(self._forces):
            raise InputError("forces", f"numbers of shape ({len(self._forces)})", f"shape {np.shape(forces)}")
        self._forces[:] = forces
        self._on_vehicle[:3], self._on_vehicle[3:] = force_on_vehicle, torque_on_vehicle
        self._on_bob[:3], self._in_joint[:] = force_on_bob, joint_torque
        size_squared = self._forces.dot(self._forces) + self._all_external.dot(self._all_external)
        if not size_squared < MAX_FORCE**2:  # also true for NaN
            got = f"{self._forces} on the rotors, {self._on_vehicle} on the vehicle, {self._on_bob} on the bob"
            raise InputError("forces", "finite numbers", got)
        self._advance()

    def respond_within(self, lags: Numbers) -> None:
        """Set the time constants (n,), s, of the rotors' filters, for an engine with lag."""
        self.model.actuator_dynprm[:, 0] = lags

    def coordinates(self, forces: Numbers) -> tuple[Numbers, Numbers, Numbers]:
        """Return qpos (11,), qvel (9,) and qacc (9,) under rotor forces (n,), N, and the last external forces."""
        self._forces[:] = forces
        self._mujoco.mj_forward(self.model, self.data)
        return self._qpos, self._qvel, self.data.qacc

    def energy(self) -> float:
        """Kinetic plus potential energy, J; the potential energy of each mass is zero at height 0."""
        self._mujoco.mj_forward(self.model, self.data)
        return float(self.data.energy.sum())


POSITIONS, VELOCITIES = 11, 9


def mujoco_coordinates(packed: Numbers, rod_spin: float = 0.0) -> NDArray[np.float64]:
    """MuJoCo's qpos (11,) and qvel (9,), concatenated, for a `packed` state (24,), e₃-up frame.

    The rod spins about its own axis at `rod_spin`, rad/s. Raises InputError like `State.from_packed`, and for a batch.
    """
    state = State.from_packed(packed)
    if state.batch_shape:
        raise InputError("packed state", "a single state", f"a batch of shape {state.batch_shape}")
    mujoco = _import_mujoco()
    quat_wxyz, rod_wxyz, inverse, relative, rows = (np.empty(k) for k in (4, 4, 4, 4, 9))
    mujoco.mju_mat2Quat(quat_wxyz, state.R.ravel())
    mujoco.mju_quatZ2Vec(rod_wxyz, state.y)
    mujoco.mju_negQuat(inverse, quat_wxyz)
    mujoco.mju_mulQuat(relative, inverse, rod_wxyz)
    mujoco.mju_quat2Mat(rows, rod_wxyz)
    rod_omega = np.cross(state.y, state.y_dot) + rod_spin * state.y  # world frame
    rod_rates = rows.reshape(3, 3).T @ (rod_omega - state.R @ state.omega)
    return np.concatenate([state.x, quat_wxyz, relative, state.x_dot, state.omega, rod_rates])


def from_mujoco(rotors: int) -> ca.Function:
    """CasADi function (qpos (11,), qvel (9,), forces (n,)) → (packed state (24,), forces (n,)), n `rotors`, e₃ up."""
    qpos, qvel = ca.SX.sym("qpos", POSITIONS), ca.SX.sym("qvel", VELOCITIES)
    forces = ca.SX.sym("r", rotors)
    state = state_of(qpos[:3], rotation_of(qpos[3:7]), rotation_of(qpos[7:11]), qvel)
    return ca.Function("seen", [qpos, qvel, forces], [ca.cse(ca.densify(state.packed())), forces])


def state_of(x: Any, R: Any, relative: Vector, qvel: Numbers) -> State:
    """Return the state, e₃ up, for the rotation R, that of the rod `relative` to it (3, 3), and qvel, in CasADi."""
    rod = R @ relative
    rates = qvel[6:9] + rod.T @ (R @ qvel[3:6])  # angular velocity of the rod, rod frame
    y_dot = rates[1] * rod[:, 0] - rates[0] * rod[:, 1]  # rod ((a, b, c) × e₃)
    return State(x=x, x_dot=qvel[:3], R=R, omega=qvel[3:6], y=rod[:, 2], y_dot=y_dot)


def rotation_of(quat_wxyz: Numbers) -> Matrix:
    """Rotation matrix of a quaternion, which need not be normalised."""
    return rotation_from_quat_xyzw(ca.vertcat(quat_wxyz[1:], quat_wxyz[0]))


@built(maxsize=8)
def _compile_view(rotors: int) -> Any:
    return as_numpy(from_mujoco(rotors))


def filter_lag(vehicle: Vehicle) -> float:
    """Return the time constant, s, of MuJoCo's filters for the rotors of `vehicle`; 0 for rotors without filters."""
    return vehicle.rotor_lag if vehicle.rotor_lag >= LEAST_LAG else 0.0


def substeps(duration: float, vehicle: Vehicle, plant: Plant) -> int:
    """Return the number of MuJoCo's steps in `duration` (s) of a flight of the true `vehicle`.

    None is longer than `FLIGHT_STEP` or `SURROUNDED_STEP`, nor than a quarter of the shorter lag: RK4 is stable up to
    2.8 lags only.
    """
    longest = SURROUNDED_STEP if plant.in_air(vehicle) or vehicle.rubs else FLIGHT_STEP
    if (lag := filter_lag(vehicle) * min(1.0, plant.spin_up)) > 0:
        longest = min(longest, lag / 4)
    return fewest_steps(duration, longest)


# Idle worlds that are kept: one a thread, for the few plants that a study goes through.
MOST_IDLE = 16


class MuJoCoWorld:
    """MuJoCo models and data for flights of one loop, passed to compiled code by address; for one thread at a time.

    The machine code calls MuJoCo's step as a C function on the raw `mjModel` and `mjData`.

    Parameters
    ----------
    vehicle : Vehicle
        The true vehicle, including its `rotor_lag`.
    timesteps : tuple of float
        Integrator step in each segment of a control period, s.
    """

    _idle: ClassVar[list[tuple[Any, MuJoCoWorld]]] = []  # the one returned last stands last
    _lock: ClassVar[Lock] = Lock()

    def __init__(self, vehicle: Vehicle, timesteps: tuple[float, ...]) -> None:
        mujoco = _import_mujoco()
        library = _library()
        self._models = [
            mujoco.MjModel.from_xml_string(model_xml(vehicle, timestep=h, lag=filter_lag(vehicle), bare=True))
            for h in timesteps
        ]
        self._data = data = mujoco.MjData(self._models[0])
        self._models_at = np.array([model._address for model in self._models], dtype=np.uint64)
        filters = [model.actuator_dynprm.ctypes.data for model in self._models]
        self._filters_at = np.array(filters, dtype=np.uint64)
        rotors = data.act if filter_lag(vehicle) > 0 else data.ctrl
        arrays = (data.qpos, data.qvel, data.qacc, rotors, data.ctrl, data.xfrc_applied, data.qfrc_applied)
        functions = (library.mj_step, library.mj_forward, library.mj_resetData)
        self._fixed = (
            data._address, *(array.ctypes.data for array in arrays),
            *(ctypes.cast(function, ctypes.c_void_p).value for function in functions),
        )  # fmt: skip
        self._begins: Any = None
        self._rod_spin = vehicle.rod_spin

    @classmethod
    @contextmanager
    def lent(cls, loop: Loop) -> Iterator[MuJoCoWorld]:
        """Yield a world for flights of `loop`, idle or new, and take it back afterwards."""
        plant = loop.sampled
        stretches = segments_within(plant.delay, 1 / plant.rate)
        lengths = [stretch.duration / steps_in(stretch.duration, plant) for stretch in stretches]
        true = plant.true_vehicle(loop.vehicle)
        timesteps = tuple(length / substeps(length, true, plant) for length in lengths)
        key = (true, timesteps, plant.spin_up)
        with cls._lock:
            place = next((i for i, (known, _) in enumerate(cls._idle) if known == key), None)
            kept = None if place is None else cls._idle.pop(place)[1]
        world = kept or cls(true, timesteps)
        try:
            yield world
        finally:
            with cls._lock:
                cls._idle.append((key, world))
                del cls._idle[:-MOST_IDLE]

    def addresses(self, starts: Any) -> NDArray[np.int64]:
        """Addresses for the compiled code, and the coordinates of packed `starts` (n, 24 or more), e₃-up frame.

        They are those of this world until the next call.
        """
        self._begins = np.stack([mujoco_coordinates(start[:SIZE], self._rod_spin) for start in starts])
        own = (self._begins, self._models_at, self._filters_at)
        self._addresses = np.array([*self._fixed, *(array.ctypes.data for array in own)], dtype=np.int64)
        return self._addresses


@lru_cache(maxsize=1)
def _library() -> ctypes.CDLL:
    """The MuJoCo C library that the Python package has loaded."""
    folder = Path(_import_mujoco().__file__).parent
    found = sorted(
        path for path in folder.iterdir() if re.fullmatch(r"(lib)?mujoco.*\.(so|dylib|dll)[.\d]*", path.name)
    )
    if not found:
        raise InputError("plant", "a mujoco package that includes its C library", "no such file in the package")
    return ctypes.CDLL(str(found[0]))


def _import_mujoco() -> Any:
    """Import the module mujoco. Raises InputError if it is not installed."""
    errors.require("mujoco", extra="mujoco", for_="plant")
    return importlib.import_module("mujoco")
