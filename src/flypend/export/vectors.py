"""Test vectors: what law, mixing and board answer in Python, from the equations with the vehicle's own numbers."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend.board.command import law_command
from flypend.board.nominal import Nominal
from flypend.board.program import board, initial_memory
from flypend.building import built
from flypend.compile.c99 import Precision
from flypend.export import records
from flypend.export.interface import reference_numbers, shift_path, wrench_from_stream
from flypend.laws import BoundLaw
from flypend.model import State, Vehicle
from flypend.model.allocation import allocate
from flypend.plants.equations import EquationsEngine
from flypend.plants.loop import Loop

COUNT, SEED = 100, 1
FLIGHTS, STEPS = 4, 25
# Spread of the random inputs: the pivot's path and its derivatives, m, m/s and so on; the external forces, weights.
PATH_SPREAD, FORCE_SPREAD = 0.5, 0.05


class Vectors(NamedTuple):
    """Inputs and outputs, each (n, length of its record)."""

    state: Any
    reference: Any
    wrench: Any
    rotors: Any


def vectors(law: BoundLaw, vehicle: Vehicle, count: int, seed: int, precision: Precision) -> Vectors:
    """`count` random states and references for the bound `law` of `vehicle`, and what Python answers.

    Inputs are rounded to `precision` first; the answers are computed in double precision.
    """
    state, reference = random_inputs(vehicle, count, seed, precision)
    answer = answers(law, vehicle)
    wrench, rotors = (np.array(value).T for value in answer(state.T, reference.T))
    return Vectors(state, reference, wrench, rotors)


def steady_vectors(
    law: BoundLaw, vehicle: Vehicle, count: int, seed: int, precision: Precision, most: float
) -> Vectors:
    """Return the first `count` of `vectors` whose wrench moves by `most` at most (relative) with the inputs' last bits.

    Next to an exceptional set a law may amplify these beyond every tolerance, and so does its C code.
    """
    draws = (vectors(law, vehicle, count, each, precision) for each in (seed, seed + 1))
    found = Vectors(*(np.concatenate(both) for both in zip(*draws, strict=True)))
    answer, rng = answers(law, vehicle), np.random.default_rng(seed)
    last = np.finfo(np.float32 if precision == "float" else float).eps
    moved = np.zeros(2 * count)
    for _ in range(4):
        inputs = (v * (1 + last / 2 * rng.choice([-1, 1], v.shape)) for v in (found.state, found.reference))
        change = np.array(answer(*(v.T for v in inputs))[0]).T - found.wrench
        for part, scale in zip((slice(1), slice(1, 4)), scales(vehicle), strict=True):
            size = np.maximum(np.abs(found.wrench[:, part]).max(axis=1), scale)
            moved = np.maximum(moved, np.abs(change[:, part]).max(axis=1) / size)
    kept = np.argsort(~(moved <= most), kind="stable")[:count]
    return Vectors(*(values[kept] for values in found))


def random_inputs(vehicle: Vehicle, count: int, seed: int, precision: Precision) -> tuple[Any, Any]:
    """Random numbers of `records.STATE`, and of `records.REFERENCE` on random paths, rounded to `precision`."""
    rng = np.random.default_rng(seed)
    start = State.random(rng, count)
    packed = start.packed()
    packed[:, :3] = rng.uniform(-2, 2, (count, 3))
    forces = FORCE_SPREAD * vehicle.weight * rng.uniform(-1, 1, (count, 6))
    state = np.concatenate([packed, forces], axis=-1)
    path = PATH_SPREAD * rng.uniform(-1, 1, (count, records.PATH.length))
    reference = np.array(path_reference(vehicle)(path.T, forces.T)).T
    return round_to(state, precision), round_to(reference, precision)


def round_to(values: Any, precision: Precision) -> Any:
    """`values` as a number of `precision` holds them, in double precision."""
    return values.astype(np.float32).astype(float) if precision == "float" else values


@built(maxsize=16)
def answers(law: BoundLaw, vehicle: Vehicle) -> Any:
    """The CasADi function (state (30), reference (30)) → wrench (4), rotor forces (n) of the bound `law`."""
    state, reference = ca.SX.sym("state", records.STATE.length), ca.SX.sym("reference", records.REFERENCE.length)
    wrench = wrench_from_stream(law, vehicle, state, reference)
    rotors = ca.densify(allocate(wrench[0], wrench[1:], vehicle))
    return ca.Function("answers", [state, reference], ca.cse([wrench, rotors]))


@built(maxsize=16)
def path_reference(vehicle: Vehicle) -> Any:
    """The CasADi function (path (27), forces (6)) → numbers of `records.REFERENCE`."""
    path, forces = ca.SX.sym("path", records.PATH.length), ca.SX.sym("forces", 6)
    return ca.Function("path_reference", [path, forces], [ca.cse(reference_numbers(vehicle, path, forces[3:]))])


class Flights(NamedTuple):
    """Flights one after the other: what the board is given, and what it answers, each (flights × steps, length)."""

    measurement: Any
    path: Any
    rotors: Any


def flights(
    loop: Loop, count: int, steps: int, seed: int, precision: Precision, law: BoundLaw | None = None
) -> Flights:
    """`count` flights of `steps` control periods of the board of `loop` from random states along random paths.

    The board of Python flies the vehicle under random constant forces, by `law` or else that of `loop`; its inputs are
    rounded to `precision`.
    """
    rng, step, rotors = np.random.default_rng(seed), board_step(loop, law), loop.vehicle.rotor_limits[0]
    period, weight, n = 1 / loop.sampled.rate, loop.vehicle.weight, len(loop.vehicle.rotor_spins)
    columns: tuple[list[Any], list[Any], list[Any]] = ([], [], [])
    for _ in range(count):
        least = np.full(n, rotors)
        memory, engine = initial_memory(loop, least), EquationsEngine(loop.vehicle)
        engine.reset(State.random(rng).packed(), least)
        wind = FORCE_SPREAD * weight * rng.uniform(-1, 1, 6)
        path = round_to(PATH_SPREAD * rng.uniform(-1, 1, records.PATH.length), precision)
        for _ in range(steps):
            measurement = round_to(engine.packed, precision)
            memory, command = (np.array(v).ravel() for v in step(memory, np.append(0.0, measurement), path, [], []))
            for values, value in zip(columns, (measurement, path, command), strict=True):
                values.append(value)
            engine.step(command, period, wind)
    return Flights(*map(np.array, columns))


@built(maxsize=16)
def board_step(loop: Loop, law: BoundLaw | None = None) -> ca.Function:
    """The board of `loop` with all numbers as constants: (memory, measurement, path, –, –) → (memory, command).

    It flies `law`, by default that of `loop`.
    """
    loop = replace(loop, parameters=())
    nominal = Nominal(loop.vehicle)

    def steer(t: Any, packed: Any, forces: Any, path: Any, gains: Any, vehicle: Any) -> Any:
        """Return the wrench of the law from its predicted state and the reference of now."""
        reference = reference_numbers(vehicle, shift_path(path, t), forces[3:])  # the measurement is at t = 0
        return wrench_from_stream(law or loop.symbolic, vehicle, ca.vertcat(packed, forces), reference)

    length = records.PATH.length
    return board(loop, nominal, law_command(loop, nominal, steer, length), length)


def scales(vehicle: Vehicle) -> tuple[float, float]:
    """Thrust (N) and moment (N m) below which a difference counts absolutely: hover, and its lever."""
    arm = float(np.sqrt(np.mean(np.sum(vehicle.rotor_positions[:, :2] ** 2, axis=1))))
    return vehicle.weight, vehicle.weight * arm
