"""The exported law compiled for this machine, as a controller that flies in any sampled plant."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from flypend import errors
from flypend.compile.c99 import PRECISIONS, Precision
from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.export import records
from flypend.export.interface import interface
from flypend.export.write import core, filled
from flypend.laws import BoundLaw, Controller, Law
from flypend.laws.references import Reference
from flypend.laws.throw import derivatives
from flypend.model import State, Vehicle, Wrench

FLAGS = ("-O2", "-std=c99", "-Wall", "-Wextra", "-Wconversion", "-Wpedantic", "-Werror")


class Library:
    """The C functions of `law` on `vehicle` in `precision`, compiled with the C compiler of this machine.

    Arrays are the records of `flypend.export.records`, one after the other. Raises InputError without a compiler.
    """

    def __init__(self, law: Law | BoundLaw, vehicle: Vehicle, precision: Precision) -> None:
        self._of = (law, vehicle, precision)
        self.made = interface(law, vehicle)
        self.real = np.dtype(np.float64 if precision == "double" else np.float32)
        texts = core(self.made, precision) | {"many.c": filled("many.c", {})}
        with tempfile.TemporaryDirectory(prefix="flypend-c-") as folder:
            for name, text in texts.items():
                (Path(folder) / name).write_text(text, encoding="utf-8")
            self._c = ctypes.CDLL(str(_compile(Path(folder))))
        numbers = self.made.law.numbers
        self.gains = self._array([numbers.get(field.name, 0.0) for field in self.made.gains.fields])
        self.params = self._array(records.params_of(vehicle))

    def __reduce__(self) -> tuple[Any, ...]:
        """Another process compiles for itself."""
        return (Library, self._of)

    def _array(self, values: Any) -> Any:
        return np.ascontiguousarray(values, dtype=self.real)

    def step(self, state: Any, reference: Any) -> tuple[Any, Any, Any]:
        """Wrenches (n, 4), rotor forces (n, k) and statuses (n,) for states (n, 30) and references (n, 30)."""
        state, reference = self._array(np.atleast_2d(state)), self._array(np.atleast_2d(reference))
        count = len(state)
        wrench, rotors = np.empty((count, 4), self.real), np.empty((count, self.made.rotors.length), self.real)
        status = np.empty(count, np.int32)
        self._call("flypend_many", count, state, reference, self.gains, self.params, wrench, rotors, status)
        return wrench, rotors, status

    def follow(self, path: Any, state: Any) -> Any:
        """The reference (30,) on a `path` (27,) for the forces in a `state` (30,)."""
        reference = np.empty(records.REFERENCE.length, self.real)
        self._call("flypend_follow", self._array(path), self._array(state), self.params, reference)
        return reference

    def lead(self, wanted: Any, modelled: Any, lead: float) -> Any:
        """Commands (k,) for `wanted` and `modelled` rotor forces (k,) and a `lead`."""
        command = np.empty(self.made.rotors.length, self.real)
        self._call(
            "flypend_lead", self._array(wanted), self._array(modelled), self.real.type(lead), self.params, command
        )
        return command

    def _call(self, name: str, *values: Any) -> int:
        real = ctypes.c_double if self.real == np.float64 else ctypes.c_float
        arguments = [
            ctypes.c_void_p(value.ctypes.data) if isinstance(value, np.ndarray)
            else ctypes.c_int(value) if isinstance(value, int) else real(value)
            for value in values
        ]  # fmt: skip
        return int(getattr(self._c, name)(*arguments))


def _compile(folder: Path) -> Path:
    """The shared library of the sources in `folder`."""
    compiler = shutil.which(os.environ.get("CC", "cc"))
    if compiler is None:
        raise InputError("controller", "a C compiler called cc on the PATH", "none")
    target = folder / "flypend_law.so"
    sources = [str(path) for path in sorted(folder.glob("*.c"))]
    subprocess.run(  # noqa: S603 (a compiler on a file that was written above)
        [compiler, *FLAGS, "-shared", "-fPIC", *sources, "-lm", "-o", str(target)], check=True, capture_output=True
    )
    return target


@lru_cache(maxsize=16)
def library(law: Law | BoundLaw, vehicle: Vehicle, precision: Precision) -> Library:
    """The compiled `law` for `vehicle`, once per process."""
    return Library(law, vehicle, precision)


def compiled(law: Law | BoundLaw, vehicle: Vehicle, precision: Precision = "double") -> Controller:
    """`law` for `vehicle` as a controller whose law, mixing and lead are the exported C, compiled here.

    It flies in sampled plants with limits that take rotor forces ("rotors", "mujoco"); prediction and observer stay
    in Python.

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
        upright = state.seen(bound.e3).packed()
        values, _ = _step(code, path, t, upright, np.zeros(6))
        found = Wrench(values[0], values[1:])
        return found.seen(bound.e3)

    def source(flown: Vehicle, lead: float) -> Callable[..., Any]:
        if flown != vehicle:
            raise InputError("vehicle", f"{vehicle.name}, which the law was compiled for", flown.name)

        def command(t: float, packed: Any, rotors: Any, forces: Any) -> Any:
            _, wanted = _step(code, path, t, packed, forces)
            # Where the law refuses, what the rotors would safely do is not its answer: the flight ends as singular.
            return code.lead(wanted, rotors, lead).astype(float) if np.all(np.isfinite(wanted)) else wanted

        return command

    return Controller(
        name=f"{bound.name}-c" + ("" if precision == "double" else "-float"),
        function=wrench,
        e3=bound.e3,
        reference=bound.reference,
        gains=bound.gains,
        table=bound.table,
        computer=bound.computer,
    )


def _step(code: Library, path: Callable[[float], Any], t: float, packed: Any, forces: Any) -> tuple[Any, Any]:
    """Wrench (4,) and rotor forces (k,); NaN where the C code refuses."""
    state = records.state_numbers(packed, forces)
    wrench, rotors, status = code.step(state, code.follow(path(t), state))
    if status[0]:
        return np.full(4, np.nan), np.full(rotors.shape[1], np.nan)
    return wrench[0].astype(float), rotors[0]


def _path(reference: Reference | None) -> Callable[[float], Any]:
    """The numbers of `records.PATH` at a time, for the position of the pivot as a function of time."""
    if reference is None:
        return lambda _: np.zeros(records.PATH.length)
    t = ca.SX.sym("t")
    x = ca.densify(reference(t))
    orders = ca.vertcat(x, *derivatives(x, t, records.PATH_ORDERS - 1))
    return as_numpy(ca.Function("path", [t], [ca.densify(orders)]))
