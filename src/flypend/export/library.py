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
from flypend.board.program import known_to_computer
from flypend.compile.c99 import PRECISIONS, Precision
from flypend.compile.numeric import as_numpy
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
from flypend.signals import waiting

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

    def lead(self, wanted: Any, modelled: Any, lead: float) -> Any:
        """Commands (k,) for `wanted` and `modelled` rotor forces (k,) and a `lead`."""
        count = self.made.rotors.length
        wanted, modelled, command = self.array(wanted, count), self.array(modelled, count), np.empty(count, self.real)
        self.call("flypend_lead", wanted, modelled, self.real.type(lead), self.params, command)
        return command

    def rotors(self, forces: Any) -> Any:
        """Rotor `forces` (n,), N, as C takes them; None for the least."""
        return None if forces is None else self.array(forces, self.made.rotors.length)

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

    `numbers` is the C struct as bytes, `status` the last answer.
    """

    def __init__(self, code: Library, path: Callable[[float], Any] | None = None, rotors: Any = None) -> None:
        self.code, self._path = code, path
        self.numbers = np.zeros(int(code.c.flypend_board_bytes()), np.uint8)
        self._measurement = np.zeros(records.MEASUREMENT.length, code.real)
        self._along = np.zeros(records.PATH.length, code.real)
        self._rotors = np.zeros(code.made.rotors.length, code.real)
        self.begin(rotors)
        self._pointers = [
            ctypes.c_void_p(array.ctypes.data)
            for array in (self.numbers, self._measurement, self._along, code.params, self._rotors)
        ]
        self._step = code.c.flypend_board_step

    def begin(self, rotors: Any = None) -> None:
        """Begin with forces `rotors` (n,), N, of the rotors, by default the least; sets `status`."""
        code, given = self.code, self.code.rotors(rotors)
        self.status = code.call("flypend_board_restart", self.numbers, code.gains, code.params, given)

    @property
    def memory(self) -> Any:
        """The numbers that the board remembers: a view of them."""
        start = int(self.code.c.flypend_board_memory())
        return self.numbers[start : start + self.code.made.memory.length * self.code.real.itemsize].view(self.code.real)

    def step(self, measurement: Any, path: Any = None) -> Any:
        """Rotor forces (n,) for a state (24,), or None for none, and numbers of `records.PATH`; sets `status`."""
        if path is not None:
            self._along[:] = path
        if measurement is None:
            self.status = self._step(self._pointers[0], None, *self._pointers[2:])
        else:
            self._measurement[:] = measurement
            self.status = self._step(*self._pointers)
        return self._rotors.astype(float)

    def skip(self) -> None:
        """Let a period go by without a call: `flypend_board_pass`."""
        self.status = self.code.call("flypend_board_pass", self.numbers)

    def command(self, t: float, measured: Any) -> Any:
        """Rotor forces (n,) for the state `measured` (24,), e₃ up, at time `t` (s); NaN where the board refuses.

        The safe answer is none of the law's: a flight that needs it ends as singular, as it does in Python. With a
        damaged memory it is flown, and the board begins again, as adapters do.
        """
        rotors = self.step(measured, None if self._path is None else self._path(t))
        if self.status == NOT_BEGUN:
            self.begin(rotors)
        return np.full(len(rotors), np.nan) if self.status else rotors


class CompiledSensors:
    """A flight computer of `code` with an estimator; arguments as of `CompiledBoard`.

    It begins with `estimate_from`. `numbers` is the C struct as bytes, `status` the last answer.
    """

    def __init__(self, code: Library, path: Callable[[float], Any] | None = None, rotors: Any = None) -> None:
        assert code.made.sensing is not None
        self.code, self._path, self._begun = code, path, rotors
        self.numbers = np.zeros(int(code.c.flypend_sensors_bytes()), np.uint8)
        self._estimate = np.zeros(records.STATE.length, code.real)
        self.status = NOT_BEGUN
        self._rotors = np.zeros(code.made.rotors.length, code.real)
        self._hover = code.array(np.zeros(records.PATH.length))
        self._reads = readings_record(code.made.sensing.sensors).length

    @property
    def memory(self) -> Any:
        """The numbers that are remembered: a view of them."""
        assert self.code.made.sensing is not None
        start = int(self.code.c.flypend_sensors_memory())
        size = self.code.made.sensing.memory.length * self.code.real.itemsize
        return self.numbers[start : start + size].view(self.code.real)

    def estimate_from(self, estimate: Any) -> None:
        """Begin with the `estimate` (24,) of the state, e₃ up."""
        self._estimate[:] = records.state_numbers(np.asarray(estimate), np.zeros(6))
        self.begin(self._begun)

    def begin(self, rotors: Any = None) -> None:
        """Begin with the last estimate and forces `rotors` (n,), N, by default the least; sets `status`."""
        code, given = self.code, self.code.rotors(rotors)
        self.status = code.call("flypend_sensors_restart", self.numbers, code.gains, code.params, self._estimate, given)

    def step(self, readings: Any, path: Any = None) -> Any:
        """Rotor forces (n,) for numbers of the readings, or None for none, and of `records.PATH`; sets `status`."""
        code, given = self.code, None if readings is None else self.code.array(readings, self._reads)
        along = self._hover if path is None else code.array(path, records.PATH.length)
        self.status = code.call("flypend_sensors_step", self.numbers, given, along, code.params, self._rotors)
        return self._rotors.astype(float)

    def command(self, t: float, measured: Any) -> Any:
        """Rotor forces (n,) for the readings `measured` at time `t` (s); NaN where they are refused.

        With a damaged memory the least forces are flown, and it begins again at the last estimate.
        """
        rotors = self.step(measured, None if self._path is None else self._path(t))
        if self.status == NOT_BEGUN:
            self.begin(rotors)
        self.code.call("flypend_sensors_estimate", self.numbers, self._estimate)  # kept outside of what may be damaged
        return np.full(len(rotors), np.nan) if self.status else rotors


def _compile(folder: Path) -> Path:
    """The shared library of the sources in `folder`."""
    compiler = shutil.which(os.environ.get("CC", "cc"))
    if compiler is None:
        raise InputError("controller", "a C compiler called cc on the PATH", "none")
    target = folder / "law.so"
    sources = [str(path) for path in sorted(folder.glob("*.c"))]
    command = [compiler, *FLAGS, "-shared", "-fPIC", *sources, "-lm", "-o", str(target)]
    done = waiting.run(command, text=True)
    if done.returncode:
        raise InputError("controller", f"C code that {compiler} compiles", done.stderr.strip()[:500])
    return target


def library(
    law: Law | BoundLaw,
    vehicle: Vehicle,
    precision: Precision,
    rate: float = 500.0,
    sensors: Sensors | None = None,
) -> Library:
    """The compiled `law` for `vehicle`, once per process."""
    return _library(law.bind(vehicle), vehicle, precision, rate, sensors)


@lru_cache(maxsize=16)
def _library(law: BoundLaw, vehicle: Vehicle, precision: Precision, rate: float, sensors: Sensors | None) -> Library:
    """Compile what `library` returns for a law that is bound."""
    return Library(law, vehicle, precision, rate, sensors)


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
    bound = law.bind(vehicle)
    code = library(bound, vehicle, precision)
    path = _path(bound.reference)

    def wrench(t: float, state: State) -> Wrench:
        """The bare law, without estimates of external forces."""
        numbers = records.state_numbers(state.in_frame(bound.e3).packed(), np.zeros(6))
        values, _, status = code.step(numbers, code.follow(path(t), numbers))
        found = Wrench(values[0, 0], values[0, 1:]) if not status[0] else Wrench(np.nan, np.full(3, np.nan))
        return found.in_frame(bound.e3)

    def flight_computer(loop: Loop, rotors: Any) -> CompiledBoard | CompiledSensors:
        if loop.vehicle != vehicle:
            raise InputError("vehicle", f"{vehicle.name}, which the law was compiled for", loop.vehicle.name)
        check_plant(loop.sampled)
        sensors = known_to_computer(loop.sampled).sensors
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
