"""Loops in C++ around generated programs, and elementary functions for these.

`compile/loops` holds the loops' source and, for each width of a vector, LLVM's bitcode of it (`make loops`). Sizes,
tableaus and programs are left open there, as external constants and functions. They are linked here; LLVM then folds
the constants, unrolls what they bound and compiles for the processor at hand.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import lru_cache
from importlib import resources
from typing import Any

import llvmlite.binding as llvm
import numpy as np
from numpy.typing import ArrayLike

from flypend.compile.llvm.emit import ELEMENTARY, Lanes, Module, define, hexadecimal
from flypend.compile.llvm.target import Target, native
from flypend.compile.program import Program

SHORT = 64  # operations; a program of so few becomes part of the loop wherever it is called
VISIBLE = frozenset(("kernel", "context_size"))  # functions of a loop
Definition = Callable[[Lanes, str], str]  # defines a program under a name, as a visible function
_ELEMENTARY = re.compile(rf"(?:{'|'.join(ELEMENTARY)})\.(\d+)x(\d+)")
Constants = dict[str, int | float | ArrayLike]


def several(program: Program) -> Definition:
    """Define `program`, which the loop calls in several places or rarely."""
    short = len(program.operations) <= SHORT
    return lambda lanes, name: define(lanes, replace(program, name=name), inline=short, visible=True)


def once(program: Program) -> Definition:
    """Define `program`, which the loop calls in one place, as part of the loop."""
    return lambda lanes, name: define(lanes, replace(program, name=name), inline=True, visible=True)


def isolate(program: Program, *, exact: bool = False) -> Definition:
    """Define `program` as a function whose rounding does not depend on the loop's; `exact` as in `emit.define`."""
    return lambda lanes, name: define(lanes, replace(program, name=name), exact=exact, visible=True)


class LoopModule(Module):
    """What a loop leaves open: `programs` and `constants` by their names in the loop's source.

    Integers and floats are constants of their own, arrays of integers are such, anything else is of doubles. Of the
    functions of the `loop` those called `VISIBLE` stay so. `vectors` are width, precision and target of its lanes.
    """

    def __init__(
        self,
        loop: str,
        vectors: tuple[int, str, Target | None],
        programs: Mapping[str, Definition],
        constants: Constants,
    ) -> None:
        super().__init__()
        width, precision, target = vectors
        lanes = Lanes(self, width, precision, target or native())
        self.bitcode = file_of(loop, width, lanes.bits, lanes.target.pointer_bits)
        self.inner = {*programs, *constants}
        for name, definition in programs.items():
            definition(lanes, name)
        self.definitions += [f'@"{name}" = constant {_constant(value)}' for name, value in constants.items()]


def file_of(loop: str, width: int, bits: int, pointer_bits: int) -> str:
    """Return the name of the bitcode of `loop` for `width` lanes with numbers and pointers of so many bits."""
    return f"{loop}_{width}x{bits}_p{pointer_bits}.bc"


def _constant(value: int | float | ArrayLike) -> str:
    """Type and number, or numbers, of a constant."""
    if isinstance(value, (int, float)):
        return f"i64 {value}" if isinstance(value, int) else f"double {hexadecimal(value)}"
    whole = isinstance(value, np.ndarray) and value.dtype.kind == "i"
    numbers = [f"i64 {number}" if whole else f"double {hexadecimal(number)}" for number in np.ravel(value).tolist()]
    return f"[{len(numbers)} x {'i64' if whole else 'double'}] [{', '.join(numbers)}]"


def link(module: Any, given: Any, target: Target) -> Any:
    """Return `given`, which is `module` parsed, linked to its loop, if any, and the elementary functions it calls."""
    kinds = {found.groups() for part in given.functions if (found := _ELEMENTARY.fullmatch(part.name))}
    files = [file_of("elementary", int(width), int(bits), target.pointer_bits) for width, bits in sorted(kinds)]
    files += [module.bitcode] if isinstance(module, LoopModule) else []
    parts = [llvm.parse_bitcode(_bitcode(file)) for file in files]
    parts += [llvm.parse_assembly(f"@FUSES = constant i64 {int(target.fuses)}")] if files else []
    inner = {one.name for part in parts for one in (*part.functions, *part.global_variables)} - VISIBLE
    inner |= module.inner if isinstance(module, LoopModule) else set()
    for part in (given, *parts):
        part.triple, part.data_layout = target.triple, str(target.machine.target_data)
    for part in parts:
        given.link_in(part)
    for part in (*given.functions, *given.global_variables):
        if part.name in inner and not part.is_declaration:
            part.linkage = "internal"
    return given


@lru_cache(maxsize=8)
def _bitcode(name: str) -> bytes:
    return resources.files("flypend.compile").joinpath("loops", name).read_bytes()
