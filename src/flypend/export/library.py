"""The exported code compiled for this machine: its functions on arrays, and the board as a flight computer."""

from __future__ import annotations

import ctypes
import os
import shutil
import tempfile
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from flypend import errors
from flypend.board.program import computer_view
from flypend.building import builds
from flypend.compile.c99 import PRECISIONS, Precision
from flypend.compile.numeric import as_numpy
from flypend.compile.record import Record
from flypend.errors import InputError
from flypend.export import records
from flypend.export.interface import interface
from flypend.export.write import core, fill
from flypend.laws import BoundLaw, Controller, Law
from flypend.laws.references import Reference
from flypend.laws.throw import derivatives
from flypend.model import State, Vehicle, Wrench
from flypend.plants import AnyPlant, Ideal
from flypend.plants.loop import Loop
from flypend.plants.sensing import readings_record
from flypend.plants.sensors import Sensors
from flypend.signals import polling

NOT_BEGUN = 8  # of flypend_status
FLAGS = (
    "-O2", "-std=c99", "-Wall", "-Wextra", "-Wconversion", "-Wpedantic", "-Wfloat-equal", "-Wdouble-promotion",
    "-Werror",
)  # fmt: skip


class Library:
    """The C functions of `law` on `vehicle` in `precision` at `rate` (Hz), compiled with the compiler of this machine.

    With `sensors`, the flight computer with an estimator is among them.

    Arrays are the records of `flypend.export.records`, one after the other. Raises InputError without a compiler.
    """

    def __init__(
        self,
        law: Law | BoundLaw,
        vehicle: Vehicle,
        precision: Precision,
        rate: float = 500.0,
        sensors: Sensors | None = None,
    ) -> None:
        self._of = (law, vehicle, precision, rate, sensors)
        self.made = interface(law, vehicle, rate, sensors)
        self.real = np.dtype(np.float64 if precision == "double" else np.float32)
        including = "flypend_sensors.h" if sensors is not None else "flypend_law.h"
        texts = core(self.made, precision) | {"many.c": fill("many.c", {"include": including})}
        with tempfile.TemporaryDirectory(prefix="flypend-c-") as folder:
            for name, text in texts.items():
                (Path(folder) / name).write_text(text, encoding="utf-8")
            self.c = ctypes.CDLL(str(_compile(Path(folder))))
        numbers = self.made.law.numbers
        self.gains = self.array([numbers.get(field.name, 0.0) for field in self.made.gains.fields])
        self.params = self.array(records.params_of(vehicle))

    def __reduce__(self) -> tuple[Any, ...]:
        """Another process compiles for itself."""
        return (Library, self._of)

    def array(self, values: Any, *shape: int) -> Any:
        """`values` as C takes them. Raises InputError unless they have the `shape`, if told: C would read past them."""
        found = np.ascontiguousarray(values, dtype=self.real)
        if shape and found.shape != shape:
            raise InputError("values", f"numbers of shape {shape}", f"{found.shape}")
        return found

    def step(self, state: Any, reference: Any) -> tuple[Any, Any, Any]:
        """Wrenches (n, 4), rotor forces (n, k) and statuses (n,) for states (n, 30) and references (n, 30)."""
        state, reference = np.atleast_2d(state), np.atleast_2d(reference)
        count = len(state)
        state = self.array(state, count, records.STATE.length)
        reference = self.array(reference, count, records.REFERENCE.length)
        wrench, rotors = np.empty((count, 4), self.real), np.empty((count, self.made.rotors.length), self.real)
        status = np.empty(count, np.int32)
        self.call("flypend_many", count, state, reference, self.gains, self.params, wrench, rotors, status)
        return wrench, rotors, status

    def follow(self, path: Any, state: Any) -> Any:
        """The reference (30,) on a `path` (27,) for the forces in a `state` (30,)."""
        reference = np.empty(records.REFERENCE.length, self.real)
        path, state = self.array(path, records.PATH.length), self.array(state, records.STATE.length)
        self.call("flypend_follow", path, state, self.params, reference)
        return reference

    def call(self, name: str, *values: Any) -> int:
        """The status of the C function `name`: arrays are passed as pointers, integers and reals as they are."""
        real = ctypes.c_double if self.real == np.float64 else ctypes.c_float
        arguments = [
            ctypes.c_void_p(value.ctypes.data) if isinstance(value, np.ndarray)
            else ctypes.c_void_p(None) if value is None
            else ctypes.c_int(value) if isinstance(value, int) else real(value)
            for value in values
        ]  # fmt: skip
        return int(getattr(self.c, name)(*arguments))


class CompiledBoard:
    """A board of `code` that has begun.

    Parameters
    ----------
    code : Library
        What was compiled.
    path : callable, optional
        Time (s) → numbers of `records.PATH`; default hover at the origin.
    rotors : (n,), optional
        Forces that the rotors begin with, N; default the least.

    `numbers` is the C struct as bytes, `memory` a view of those that the board remembers, `status` the last answer.
    """

    kind = "board"  # in the names of its C functions

    def __init__(self, code: Library, path: Callable[[float], Any] | None = None, rotors: Any = None) -> None:
        self._set_up(code, code.made.memory, records.MEASUREMENT, path)
        self.begin(rotors)

    def _set_up(self, code: Library, memory: Record, measured: Record, path: Callable[[float], Any] | None) -> None:
        """Lay out the C struct, with its `memory`, and the arrays that a step takes, such as what is `measured`."""
        self.code, self.status, self._path = code, NOT_BEGUN, path
        bytes_, start = (int(getattr(code.c, f"flypend_{self.kind}_{end}")()) for end in ("bytes", "memory"))
        self.numbers = np.zeros(bytes_, np.uint8)
        self.memory = self.numbers[start : start + memory.length * code.real.itemsize].view(code.real)
        lengths = (measured.length, records.PATH.length, code.made.rotors.length)
        self._measured, self._along, self._rotors = arrays = [np.zeros(length, code.real) for length in lengths]
        self._pointers = [
            ctypes.c_void_p(array.ctypes.data) for array in (self.numbers, *arrays[:2], code.params, arrays[2])
        ]
        self._step = getattr(code.c, f"flypend_{self.kind}_step")

    def begin(self, rotors: Any = None) -> None:
        """Begin with forces `rotors` (n,), N, of the rotors, by default the least; sets `status`."""
        self._restart(rotors)

    def _restart(self, rotors: Any, *estimate: Any) -> None:
        code = self.code
        given = None if rotors is None else code.array(rotors, code.made.rotors.length)
        name = f"flypend_{self.kind}_restart"
        self.status = code.call(name, self.numbers, code.gains, code.params, *estimate, given)

    def step(self, measured: Any, path: Any = None) -> Any:
        """Rotor forces (n,) for a state (24,) or readings, None for none, and numbers of `records.PATH`.

        Without a `path` it hovers at the origin. Sets `status`.
        """
        self._along[:] = 0 if path is None else self.code.array(path, len(self._along))
        if measured is not None:
            self._measured[:] = self.code.array(measured, len(self._measured))
        board, given, *others = self._pointers
        self.status = self._step(board, None if measured is None else given, *others)
        return self._rotors.astype(float)

    def command(self, t: float, measured: Any) -> Any:
        """Rotor forces (n,) for the state (24,), e₃ up, or readings `measured` at time `t` (s); NaN where refused.

        The safe answer is none of the law's: a flight that needs it ends as singular, as it does in Python. With a
        damaged memory it is flown, and the board begins again, as adapters do.
        """
        rotors = self.step(measured, None if self._path is None else self._path(t))
        if self.status == NOT_BEGUN:
            self.begin(rotors)
        return np.full(len(rotors), np.nan) if self.status else rotors


class CompiledSensors(CompiledBoard):
    """A flight computer of `code` with an estimator, which begins with `estimate_from`; otherwise as `CompiledBoard`.

    With a damaged memory it begins again at the last estimate.
    """

    kind = "sensors"

    def __init__(self, code: Library, path: Callable[[float], Any] | None = None, rotors: Any = None) -> None:
        assert code.made.sensing is not None
        self._set_up(code, code.made.sensing.memory, readings_record(code.made.sensing.sensors), path)
        self._begun, self._estimate = rotors, np.zeros(records.STATE.length, code.real)

    def estimate_from(self, estimate: Any) -> None:
        """Begin with the `estimate` (24,) of the state, e₃ up."""
        self._estimate[:] = np.append(estimate, np.zeros(records.FORCES))
        self.begin(self._begun)

    def begin(self, rotors: Any = None) -> None:
        """Begin with the last estimate and forces `rotors` (n,), N, by default the least; sets `status`."""
        self._restart(rotors, self._estimate)

    def command(self, t: float, measured: Any) -> Any:
        """As that of `CompiledBoard`."""
        rotors = super().command(t, measured)
        self.code.call("flypend_sensors_estimate", self.numbers, self._estimate)  # kept outside of what may be damaged
        return rotors


def _compile(folder: Path) -> Path:
    """The shared library of the sources in `folder`."""
    compiler = shutil.which(os.environ.get("CC", "cc"))
    if compiler is None:
        raise InputError("controller", "a C compiler called cc on the PATH", "none")
    target = folder / "law.so"
    sources = [str(path) for path in sorted(folder.glob("*.c"))]
    command = [compiler, *FLAGS, "-shared", "-fPIC", *sources, "-lm", "-o", str(target)]
    done = polling.run(command, text=True)
    if done.returncode:
        raise InputError("controller", f"C code that {compiler} compiles", done.stderr.strip()[:500])
    return target


def library(
    law: Law | BoundLaw, vehicle: Vehicle, precision: Precision, rate: float = 500.0, sensors: Sensors | None = None
) -> Library:
    """The compiled `law` for `vehicle`, once per process."""
    return _library(law.bind(vehicle), vehicle, precision, rate, sensors)


_library = lru_cache(maxsize=16)(Library)


@builds
def compiled(law: Law | BoundLaw, vehicle: Vehicle, precision: Precision = "double") -> Controller:
    """The exported flight computer of `law` on `vehicle`, compiled here, as a controller.

    It flies in sampled plants with rotor limits that take rotor forces ("rotors", "mujoco"). There it replaces the
    whole flight computer: no part is left in Python. It is compiled for the control rate of the plant.

    Parameters
    ----------
    law, vehicle
        As in `export_c`.
    precision : "double" or "float"
        Type of every number in C.

    Raises
    ------
    InputError
        As `export_c`, and without a C compiler.
    """
    if not isinstance(law, Law | BoundLaw):
        raise InputError("law", "a Law, written in symbols", getattr(law, "name", repr(law)))
    errors.one_of("precision", precision, PRECISIONS)
    vehicle = vehicle.commanded()
    bound = law.bind(vehicle)
    code = library(bound, vehicle, precision)
    path = _path(bound.reference)

    def wrench(t: float, state: State) -> Wrench:
        """The bare law, without estimates of external forces."""
        numbers = np.append(state.in_frame(bound.e3).packed(), np.zeros(records.FORCES))
        values, _, status = code.step(numbers, code.follow(path(t), numbers))
        found = Wrench(values[0, 0], values[0, 1:]) if not status[0] else Wrench(np.nan, np.full(3, np.nan))
        return found.in_frame(bound.e3)

    def flight_computer(loop: Loop, rotors: Any) -> CompiledBoard | CompiledSensors:
        if loop.vehicle != vehicle:
            raise InputError("vehicle", f"{vehicle.name}, which the law was compiled for", loop.vehicle.name)
        check_plant(loop.sampled)
        sensors = computer_view(loop.sampled).sensors
        sensors = None if sensors is None else sensors.told  # the same code, whatever is wrong with them
        code = library(bound, vehicle, precision, loop.sampled.rate, sensors)
        return CompiledBoard(code, path, rotors) if sensors is None else CompiledSensors(code, path, rotors)

    return Controller(
        name=f"{bound.name}-c" + ("" if precision == "double" else "-float"),
        function=wrench,
        e3=bound.e3,
        reference=bound.reference,
        gains=bound.gains,
        table=bound.table,
        computer=bound.computer,
        flight_computer=flight_computer,
    )


def check_plant(plant: AnyPlant) -> None:
    """Raise InputError unless exported code can command a `plant`: rotor forces within limits."""
    if isinstance(plant, Ideal):
        raise InputError("controller", "python, in the ideal plant, which is not sampled", "exported code")
    if plant.interface != "wrench" or not plant.limits:
        raise InputError("plant", "rotor forces within limits, which exported code commands", "another interface")


def _path(reference: Reference | None) -> Callable[[float], Any]:
    """The numbers of `records.PATH` at a time, for the position of the pivot as a function of time."""
    if reference is None:
        return lambda _: np.zeros(records.PATH.length)
    t = ca.SX.sym("t")
    x = ca.densify(reference(t))
    orders = ca.vertcat(x, *derivatives(x, t, records.PATH_ORDERS - 1))
    return as_numpy(ca.Function("path", [t], [ca.densify(orders)]))
