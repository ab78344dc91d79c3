"""What the C functions compute, as programs on the numbers of the records."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import casadi as ca

from flypend.board.command import OUTSIDE, finish, found_length, lead_rotors, rescale
from flypend.board.nominal import Nominal
from flypend.board.program import advance_unmeasured, board, initial_memory, parts
from flypend.building import built
from flypend.compile.c99 import reads
from flypend.compile.program import LIBRARY, LIBRARY_2, Program, lower
from flypend.compile.record import Record
from flypend.compile.routine import Routine, lower_calls
from flypend.errors import InputError
from flypend.export import records
from flypend.export.safe import hold_level
from flypend.laws import BoundLaw, Law
from flypend.laws.throw import bob_path, derivatives
from flypend.model import State, Vehicle
from flypend.model.allocation import allocate
from flypend.model.state import SIZE
from flypend.plants.loop import Loop
from flypend.plants.plant import Sampled
from flypend.plants.sensing import readings_record
from flypend.plants.sensors import Sensors

GAINS = 3  # place of the gains among the inputs of the law


@dataclass(frozen=True)
class Sensing:
    """A flight computer that estimates the state from readings of sensors.

    Parameters
    ----------
    sensors : Sensors
        The sensors.
    board : Routine
        The flight computer: time and readings in place of a measurement.
    memory : Record
        Table of what it remembers.
    begin : Program
        (rotors, state (24,), params) → memory.
    sound : Program
        readings → largest defect of directions and attitudes that have arrived, which are unit vectors and rotations.
    """

    sensors: Sensors
    board: Routine
    memory: Record
    begin: Program
    sound: Program


@dataclass(frozen=True)
class Interface:
    """Everything that the C code of one law on one vehicle is made from.

    Parameters
    ----------
    loop : Loop
        The vehicle whose numbers are proposed, the law bound to it, the plant that gives the control rate, and the
        gains that the code takes at run time.
    gains, params, rotors : Record
        The records that depend on them.
    constant : tuple of str
        Gains that the code holds as constants.
    programs : dict of Program
        What the functions of the bare law call: law, carry, share, quicken, gather, hold, rod, attitude, begin.
    board, unmeasured : Routine
        The flight computer, and what its memory does in a period without a measurement.
    memory : Record
        Table of what the board remembers.
    sensing : Sensing, optional
        The flight computer with an estimator.
    """

    loop: Loop
    gains: Record
    params: Record
    rotors: Record
    constant: tuple[str, ...]
    programs: Mapping[str, Program]
    board: Routine
    unmeasured: Routine
    memory: Record
    sensing: Sensing | None = None

    @property
    def law(self) -> BoundLaw:
        """The bound law, as calm as its sensors ask for."""
        return _calm(self.loop, None if self.sensing is None else self.sensing.sensors)

    @property
    def vehicle(self) -> Vehicle:
        """The vehicle whose numbers are proposed."""
        return self.loop.vehicle

    @property
    def follows(self) -> bool:
        """Whether the law follows a reference at all."""
        return bool(reads(self.programs["law"], 2))

    @property
    def has_gains(self) -> bool:
        """Whether the law has gains at run time."""
        return bool(self.loop.parameters)

    def all_programs(self) -> dict[str, Program]:
        """All programs by name, in the order of their C functions. Raises ValueError for two of one name."""
        found: dict[str, Program] = {}
        for program in (*self.programs.values(), *self.board.programs, *self.unmeasured.programs):
            if found.setdefault(program.name, program) != program:
                raise ValueError(f"two programs are called {program.name}")
        return found


def interface(law: Law | BoundLaw, vehicle: Vehicle, rate: float = 500.0, sensors: Sensors | None = None) -> Interface:
    """The C interface of `law` on `vehicle`, called `rate` times a second, with `sensors` if there are any.

    Raises InputError for a law that cannot be written for a vehicle of symbols, for a vehicle whose rotors do not
    share thrust and yaw equally, and for a rate out of range.
    """
    vehicle = vehicle.commanded()
    vehicle.sharing()  # refuses rotors that `allocate` cannot share out
    return _interface(law.bind(vehicle), vehicle, float(rate), sensors)


@built(maxsize=8)  # each precision takes the same
def _interface(law: BoundLaw, vehicle: Vehicle, rate: float, sensors: Sensors | None) -> Interface:
    """Build what `interface` returns for a law that is bound."""
    loop = Loop(vehicle, law, Sampled(rate=rate))
    record, rotors = records.params_record(vehicle), records.rotors_record(vehicle)
    params = ca.SX.sym("params", record.length)
    stand_in = records.SymbolicVehicle(params, record, vehicle)
    nominal = Nominal(stand_in, params)
    names, constant, steering = _law(_calm(loop, sensors), params, stand_in)
    loop = replace(loop, parameters=tuple(names))
    functions = {function.name(): function for function in (steering, *_around(loop, params, stand_in))}
    programs = {name: lower(function) for name, function in functions.items()}
    follows = bool(reads(programs["law"], 2))
    command = _command(loop, nominal, steering, functions["carry"], follows=follows)
    return Interface(
        loop=loop,
        gains=records.gains_record(loop.symbolic, names),
        params=record,
        rotors=rotors,
        constant=constant,
        programs=programs,
        board=replace(lower_calls(board(loop, nominal, command, records.PATH.length)), name="fly"),
        unmeasured=lower_calls(advance_unmeasured(loop, nominal)),
        memory=parts(loop, nominal).memory,
        sensing=None if sensors is None else _sensing(loop, nominal, command, sensors),
    )


def _sensing(loop: Loop, nominal: Nominal, command: ca.Function, sensors: Sensors) -> Sensing:
    """Return the flight computer of `loop` that reads `sensors`; `command` as in `board`."""
    loop = replace(loop, plant=loop.sampled.replace(sensors=sensors))
    rotors, state = ca.SX.sym("rotors", nominal.rotors), ca.SX.sym("state", SIZE)
    memory, remembered = parts(loop, nominal).memory, ca.densify(initial_memory(loop, rotors, state, nominal))
    begin = ca.Function("begin", [rotors, state, nominal.symbols], [ca.cse(remembered)])
    whole = lower_calls(board(loop, nominal, command, records.PATH.length))
    return Sensing(sensors, replace(whole, name="fly"), memory, lower(begin), lower(_sound(sensors)))


def _sound(sensors: Sensors) -> ca.Function:
    """Readings → largest |length² − 1| of directions; largest ‖RᵀR − 1‖² of attitudes, at least 2 for a reflection."""
    record = readings_record(sensors)
    readings = ca.SX.sym("readings", record.length)
    parts = record.split(readings)
    defects: list[list[Any]] = [[ca.SX(0.0)], [ca.SX(0.0)]]
    for name in sensors.streams:
        values, fresh = parts[name], parts[f"{name}_age"] >= 0
        if name in ("rod", "joints"):
            defects[0].append(fresh * ca.fabs(ca.sumsqr(values) - 1))
        elif name == "attitude":
            R = ca.reshape(values, 3, 3).T
            defects[1].append(fresh * ca.fmax(ca.sumsqr(R.T @ R - ca.SX.eye(3)), 2 * (ca.det(R) <= 0)))
    worst = [ca.mmax(ca.vertcat(*found)) for found in defects]
    return ca.Function("sound", [readings], [ca.densify(ca.vertcat(*worst))])


# The law ----------------------------------------------------------------------------------------------------------


def _calm(loop: Loop, sensors: Sensors | None) -> BoundLaw:
    """Return the law of `loop`, as calm as `sensors` ask for."""
    return replace(loop, plant=loop.sampled.replace(sensors=sensors)).symbolic


def _law(law: BoundLaw, params: Any, vehicle: Any) -> tuple[list[str], tuple[str, ...], ca.Function]:
    """Gains at run time, gains that are constants, and the law.

    The law is (state (24,), forces (6,), reference, gains, params) → wrench (4,), e₃ up.
    """
    state, forces = ca.SX.sym("state", SIZE), ca.SX.sym("forces", records.FORCES)
    reference = ca.SX.sym("reference", records.REFERENCE.length)
    gains = {name: ca.SX.sym(name) for name in law.numbers if name not in law.fixed}
    try:
        wrench = wrench_from_stream(law, vehicle, ca.vertcat(state, forces), reference, gains)
    except InputError:
        raise
    except Exception as error:  # whatever a law of one's own does with numbers that are symbols
        raise InputError("law", "equations that hold for a vehicle of symbols", f"{law.name} ({error})") from error
    names = [name for name, symbol in gains.items() if ca.depends_on(wrench, symbol)]

    def written(wrench: Any) -> ca.Function:
        entries = ca.vertcat(ca.SX(0, 1), *(gains[name] for name in names))
        return ca.Function("law", [state, forces, reference, entries, params], [ca.cse(wrench)])

    program = lower(written(wrench))
    constant = _in_functions(program, names)
    if constant:
        values = ca.DM([law.numbers[name] for name in constant])
        wrench = ca.substitute(wrench, ca.vertcat(*(gains[name] for name in constant)), values)
        names = [name for name in names if name not in constant]
    return names, (*law.fixed, *constant), written(wrench)


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


def wrench_from_stream(law: BoundLaw, vehicle: Any, state: Any, reference: Any, gains: Any = None) -> Any:
    """The wrench (4, 1), e₃ up, of a bound `law` for the numbers of `records.STATE` and `records.REFERENCE`.

    `vehicle` has numbers or symbols, as have the `gains`. Raises InputError for a law that needs the time itself.
    """
    t = ca.SX.sym("t")
    flown = law.along(_path_from_stream(reference)) if law.along is not None else law
    wrench = flown.upright(t, state[:SIZE], state[SIZE:], gains, vehicle)
    if law.along is None and ca.depends_on(wrench, t):
        raise InputError("law", "one that does not depend on time, or a Law with a `path`", law.name)
    return ca.densify(ca.substitute(wrench, t, 0))


# What it follows --------------------------------------------------------------------------------------------------


def _path_from_stream(reference: Any) -> Any:
    """The path whose derivatives at t = 0 are the numbers of a `reference` record, as Taylor polynomials."""
    place = {field.name: reference[where] for field, where in records.REFERENCE.places()}
    pivot, bob = ([place[f"{name}{order}"] for order in records.ORDERS] for name in ("x", "p"))

    def path(t: Any, vehicle: Any, _: Any) -> tuple[Any, Any, Any]:
        x, p = _polynomial(pivot, t), _polynomial(bob, t)
        return x, p, (p - x) / vehicle.l

    return path


def _polynomial(values: Sequence[Any], t: Any) -> Any:
    return sum(value * t**i / math.factorial(i) for i, value in enumerate(values))


def reference_numbers(vehicle: Any, path: Any, on_bob: Any) -> Any:
    """The numbers of `records.REFERENCE` on a `path` of the pivot, the bob carried as the laws have it.

    `vehicle` has numbers or symbols; `path` are the numbers of its record, `on_bob` (3,) is the force on the bob, N.
    """
    t = ca.SX.sym("t")
    x, p, _ = bob_path(lambda time: _polynomial(ca.vertsplit(path, 3), time))(t, vehicle, on_bob)
    orders = len(records.ORDERS)
    values = ca.vertcat(x, *derivatives(x, t, orders - 1), p, *derivatives(p, t, orders - 1))
    return ca.densify(ca.substitute(values, t, 0))


def shift_path(path: Any, time: Any) -> Any:
    """The numbers of `records.PATH` on a `path` `time` seconds later, as far as its derivatives tell."""
    orders = ca.vertsplit(path, 3)
    return ca.densify(ca.vertcat(*(_polynomial(orders[i:], time) for i in range(len(orders)))))


# The board --------------------------------------------------------------------------------------------------------


def _command(loop: Loop, nominal: Nominal, steering: ca.Function, carry: ca.Function, *, follows: bool) -> ca.Function:
    """As `board.command.law_command`, as calls of the functions that the bare law has, along a path of the pivot."""
    t, horizon = ca.MX.sym("t"), ca.MX.sym("horizon")
    state, rotors = ca.MX.sym("state", SIZE), ca.MX.sym("rotors", nominal.rotors)
    outside, path = ca.MX.sym("outside", OUTSIDE.length), ca.MX.sym("path", records.PATH.length)
    gains, params = ca.MX.sym("gains", len(loop.parameters)), ca.MX.sym("params", nominal.symbols.numel())
    found, rescaled, shift = _steps(nominal)
    reference = ca.MX(ca.DM.zeros(records.REFERENCE.length))
    forces, flown = outside[OUTSIDE.place("forces")], found(outside, params)
    if follows:
        reference = carry(shift(path, horizon), forces, flown)
    wrench = rescaled(steering(state, forces, reference, gains, flown), outside)
    command = finish(loop, nominal)(wrench, state, rotors, params)
    return ca.Function("command", [t, horizon, state, rotors, outside, path, gains, params], [command])


def _steps(nominal: Nominal) -> tuple[ca.Function, ca.Function, ca.Function]:
    """(outside, params) → params with the length of the rod as found; `rescale`; (path, time) → `shift_path`."""
    wrench, outside = ca.SX.sym("wrench", 4), ca.SX.sym("outside", OUTSIDE.length)
    path, time = ca.SX.sym("path", records.PATH.length), ca.SX.sym("time")
    params, vehicle = nominal.symbols, nominal.vehicle
    flown = ca.substitute(params, vehicle.l, found_length(vehicle, outside))
    return (
        _function("found", [outside, params], flown),
        _function("rescale", [wrench, outside], rescale(wrench, outside)),
        _function("shift", [path, time], shift_path(path, time)),
    )


# Rotors and checks ------------------------------------------------------------------------------------------------


def _around(loop: Loop, params: Any, vehicle: Any) -> list[ca.Function]:
    """What stands around the law: reference, rotors, the safe answer, the checks of a state, a memory that begins."""
    rotors, wanted, modelled = (ca.SX.sym(name, len(vehicle.rotor_spins)) for name in ("rotors", "wanted", "modelled"))
    path, forces = ca.SX.sym("path", records.PATH.length), ca.SX.sym("forces", records.FORCES)
    wrench, lead, packed = ca.SX.sym("wrench", 4), ca.SX.sym("lead"), ca.SX.sym("state", SIZE)
    state, (low, high) = State.symbolic(packed), vehicle.rotor_limits
    R, y, y_dot = state.R, state.y, state.y_dot
    quickened = ca.fmin(ca.fmax(lead_rotors(wanted, modelled, lead), low), high)
    on_sphere = ca.vertcat(ca.fabs(ca.norm_2(y) - 1), ca.fabs(ca.dot(y, y_dot)), ca.norm_2(y_dot))
    is_rotation = ca.vertcat(ca.norm_fro(R.T @ R - ca.SX.eye(3)), ca.det(R))
    return [
        _function("carry", [path, forces, params], ca.cse(reference_numbers(vehicle, path, forces[3:]))),
        _function("share", [wrench, params], allocate(wrench[0], wrench[1:], vehicle)),
        _function("quicken", [wanted, modelled, lead, params], quickened),
        _function("gather", [rotors, params], ca.mtimes(vehicle.mixing(), rotors)),
        hold_level(loop, vehicle, params),
        _function("rod", [packed], on_sphere),  # ||y| − 1|, |y · ẏ|, |ẏ|
        _function("attitude", [packed], is_rotation),  # ‖RᵀR − 1‖, det R
        _function("begin", [rotors], initial_memory(loop, rotors)),
    ]


def _function(name: str, inputs: Sequence[Any], output: Any) -> ca.Function:
    return ca.Function(name, [*inputs], [ca.densify(output)])
