"""What the C functions compute, as programs of the records: law, path, mixing, lead and the checks of a state."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from flypend.board.command import led
from flypend.compile.program import LIBRARY, LIBRARY_2, Program, lower
from flypend.errors import InputError
from flypend.export import records
from flypend.export.records import Record
from flypend.laws import BoundLaw, Law
from flypend.laws.throw import carrying, derivatives
from flypend.model import State, Vehicle
from flypend.model.allocation import allocate
from flypend.model.state import FLIP, SIZE

GAINS = 2  # place of the gains among the inputs of a step


@dataclass(frozen=True)
class Interface:
    """Everything that the C code of one law on one vehicle is made from.

    Parameters
    ----------
    law, vehicle
        The law, bound to the vehicle, and the vehicle whose numbers are proposed.
    gains, params, rotors : Record
        The records that depend on them.
    constant : tuple of str
        Gains that the code holds as constants.
    step : Program
        (state, reference, gains, params) → wrench.
    follow : Program
        (path, state, params) → reference.
    mix : Program
        (wrench, params) → rotors.
    lead : Program
        (wanted rotors, modelled rotors, lead, params) → rotors.
    check : Program
        state → ||y|² − 1|, |y · ẏ|, |ẏ|, ‖RᵀR − 1‖, det R.
    follows : bool
        Whether the law follows a reference at all.
    """

    law: BoundLaw
    vehicle: Vehicle
    gains: Record
    params: Record
    rotors: Record
    constant: tuple[str, ...]
    step: Program
    follow: Program
    mix: Program
    lead: Program
    check: Program
    follows: bool


class _SymbolicVehicle:
    """A vehicle whose constants are the symbols of `records.params_record`; it has what laws ask a `Vehicle` for."""

    def __init__(self, symbols: Any, record: Record, spins: Any) -> None:
        self.values = {field.name: symbols[place] for field, place in record.places()}
        v = self.values
        self.M = self.mass = v["mass"]
        self.m = self.bob_mass = v["bob_mass"]
        self.l = self.rod_length = v["rod_length"]
        self.g = self.gravity = v["gravity"]
        self.I = self.inertia = _inertia(v["inertia"])
        self.rotor_limits = (v["rotor_least"], v["rotor_largest"])
        self.rotor_spins = spins
        self.weight = (self.M + self.m) * self.g
        self.name = "symbolic"

    def sharing(self) -> tuple[Any, Any, Any]:
        """As `Vehicle.sharing`, from the symbols."""
        return ca.horzcat(self.values["per_roll"], self.values["per_pitch"]), self.values["per_yaw"], self.rotor_spins

    @property
    def I_inv(self) -> Any:
        """Inverse of the inertia matrix."""
        return ca.inv_minor(self.I)

    def seen(self, e3: str) -> _SymbolicVehicle:
        """The vehicle in the body frame of `e3`."""
        if e3 == "up" or self.I.nnz() == 3:
            return self
        turned = object.__new__(_SymbolicVehicle)
        turned.__dict__.update(self.__dict__, I=FLIP @ self.I @ FLIP)
        return turned


def _inertia(entries: Any) -> Any:
    if entries.numel() == 3:
        return ca.diag(entries)
    xx, yy, zz, xy, xz, yz = ca.vertsplit(entries)
    return ca.vertcat(ca.horzcat(xx, xy, xz), ca.horzcat(xy, yy, yz), ca.horzcat(xz, yz, zz))


def interface(law: Law | BoundLaw, vehicle: Vehicle) -> Interface:
    """The C interface of `law` on `vehicle`.

    Raises InputError for a law that cannot be written for a vehicle of symbols, and for a vehicle whose rotors do not
    share thrust and yaw equally.
    """
    allocate(ca.SX.sym("f"), ca.SX.sym("m", 3), vehicle)  # refuses rotors that it cannot share out
    bound = law.bind(vehicle)
    params = records.params_record(vehicle)
    symbols = ca.SX.sym("params", params.length)
    spins = np.sign(vehicle.unmixing()[:, 3])
    stand_in = _SymbolicVehicle(symbols, params, spins)
    names, constant, step, reference = _step(bound, symbols, stand_in)
    rotors = records.rotors_record(vehicle)
    return Interface(
        law=bound,
        vehicle=vehicle,
        gains=records.gains_record(bound, names),
        constant=constant,
        params=params,
        rotors=rotors,
        step=step,
        follow=_follow(symbols, stand_in),
        mix=_mix(symbols, stand_in),
        lead=_lead(symbols, stand_in, rotors.length),
        check=_check(),
        follows=reference,
    )


def _step(law: BoundLaw, params: Any, vehicle: Any) -> tuple[list[str], tuple[str, ...], Program, bool]:
    """Gains at run time, gains that are constants, the program of the law, and whether it follows the reference."""
    state, reference = ca.SX.sym("state", records.STATE.length), ca.SX.sym("reference", records.REFERENCE.length)
    gains = {name: ca.SX.sym(name) for name in law.numbers if name not in law.fixed}
    try:
        wrench = streamed_wrench(law, vehicle, state, reference, gains)
    except InputError:
        raise
    except Exception as error:  # whatever a law of one's own does with numbers that are symbols
        raise InputError("law", "equations that hold for a vehicle of symbols", f"{law.name} ({error})") from error
    names = [name for name, symbol in gains.items() if ca.depends_on(wrench, symbol)]
    program = _with_gains(wrench, state, reference, params, {name: gains[name] for name in names})
    constant = _in_functions(program, names)
    if constant:
        values = ca.DM([law.numbers[name] for name in constant])
        wrench = ca.substitute(wrench, ca.vertcat(*(gains[name] for name in constant)), values)
        names = [name for name in names if name not in constant]
        program = _with_gains(wrench, state, reference, params, {name: gains[name] for name in names})
    if any(math.isnan(operation.value) for operation in program.operations):  # float() of a symbol
        raise InputError("law", "equations that hold for a vehicle of symbols", f"{law.name}, which has NaN in them")
    return names, (*law.fixed, *constant), program, bool(ca.depends_on(wrench, reference))


def _with_gains(wrench: Any, state: Any, reference: Any, params: Any, gains: dict[str, Any]) -> Program:
    entries = ca.vertcat(*gains.values()) if gains else ca.SX.sym("none", 1)
    return lower(ca.Function("step", [state, reference, entries, params], [wrench]))


def _in_functions(program: Program, names: list[str]) -> tuple[str, ...]:
    """Gains of which the program takes a function that C code has not, such as a cosine: they become constants."""
    found: set[int] = set()
    above: list[set[tuple[int, ...]]] = []  # the inputs that each value depends on
    for operation in program.operations:
        is_input = operation.name == "input"
        above.append({operation.arguments} if is_input else set().union(*(above[i] for i in operation.arguments)))
        if operation.name in (*LIBRARY, *LIBRARY_2):
            found |= {entry for vector, entry in above[-1] if vector == GAINS}
    return tuple(names[entry] for entry in sorted(found))


def streamed_wrench(law: BoundLaw, vehicle: Any, state: Any, reference: Any, gains: Any = None) -> Any:
    """The wrench (4, 1), e₃ up, of a bound `law` for the numbers of `records.STATE` and `records.REFERENCE`.

    `vehicle` has numbers or symbols, as have the `gains`. Raises InputError for a law that needs the time itself.
    """
    t = ca.SX.sym("t")
    flown = law.along(_streamed(reference)) if law.along is not None else law
    wrench = flown.upright(t, state[:SIZE], state[SIZE:], gains, vehicle)
    if law.along is None and ca.depends_on(wrench, t):
        raise InputError("law", "one that does not depend on time, or a Law with a `path`", law.name)
    return ca.densify(ca.substitute(wrench, t, 0))


def _streamed(reference: Any) -> Any:
    """The path whose derivatives at t = 0 are the numbers of a `reference` record, as Taylor polynomials."""
    place = {field.name: reference[where] for field, where in records.REFERENCE.places()}
    pivot, bob = ([place[f"{name}{order}"] for order in records.ORDERS] for name in ("x", "p"))

    def path(t: Any, vehicle: Any, _: Any) -> tuple[Any, Any, Any]:
        x, p = _polynomial(pivot, t), _polynomial(bob, t)
        return x, p, (p - x) / vehicle.l

    return path


def _polynomial(values: Sequence[Any], t: Any) -> Any:
    return sum(value * t**i / math.factorial(i) for i, value in enumerate(values))


def _follow(params: Any, vehicle: Any) -> Program:
    path, state = ca.SX.sym("path", records.PATH.length), ca.SX.sym("state", records.STATE.length)
    return lower(ca.Function("follow", [path, state, params], [followed(vehicle, path, state)]))


def followed(vehicle: Any, path: Any, state: Any) -> Any:
    """The numbers of `records.REFERENCE` on a `path` of the pivot, the bob carried as the laws have it.

    `vehicle` has numbers or symbols; `path` and `state` are the numbers of their records.
    """
    t = ca.SX.sym("t")
    x, p, _ = carrying(lambda time: _polynomial(ca.vertsplit(path, 3), time))(t, vehicle, state[SIZE:][3:])
    orders = len(records.ORDERS)
    values = ca.vertcat(x, *derivatives(x, t, orders - 1), p, *derivatives(p, t, orders - 1))
    return ca.densify(ca.substitute(values, t, 0))


def _mix(params: Any, vehicle: Any) -> Program:
    wrench = ca.SX.sym("wrench", 4)
    forces = allocate(wrench[0], wrench[1:], vehicle)
    return lower(ca.Function("mix", [wrench, params], [ca.densify(forces)]))


def _lead(params: Any, vehicle: Any, count: int) -> Program:
    wanted, modelled, lead = ca.SX.sym("wanted", count), ca.SX.sym("modelled", count), ca.SX.sym("lead")
    low, high = vehicle.rotor_limits
    command = ca.fmin(ca.fmax(led(wanted, modelled, lead), low), high)
    return lower(ca.Function("lead", [wanted, modelled, lead, params], [ca.densify(command)]))


def _check() -> Program:
    """How far a state is from the manifold, in the measures of `State`."""
    symbols = ca.SX.sym("state", records.STATE.length)
    state = State.symbolic(symbols[:SIZE])
    values = (
        ca.fabs(ca.norm_2(state.y) - 1),
        ca.fabs(ca.dot(state.y, state.y_dot)),
        ca.norm_2(state.y_dot),
        ca.norm_fro(state.R.T @ state.R - ca.SX.eye(3)),
        ca.det(state.R),
    )
    return lower(ca.Function("check", [symbols], [ca.densify(ca.vertcat(*values))]))
