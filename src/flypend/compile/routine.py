"""A CasADi function made of calls as a routine: scalar programs called one after the other on stretches of memory.

A prediction calls one step many times. Expanded, it would be one program of ten thousand operations, which neither a
processor's cache nor a microcontroller's flash has room for; as calls, every program exists once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import casadi as ca

from flypend.compile.program import Program, lower


class Cell(NamedTuple):
    """One number: entry `place` of memory `memory` ("input", "call" or "constant") number `number`.

    A constant is `value`; it has no place.
    """

    memory: str
    number: int = 0
    place: int = 0
    value: float = 0.0


class Call(NamedTuple):
    """A call of program number `program`: the cells it takes, and the memory that receives each of its outputs."""

    program: int
    inputs: tuple[tuple[Cell, ...], ...]
    outputs: tuple[int, ...]


@dataclass(frozen=True)
class Routine:
    """Calls of programs, in order.

    Parameters
    ----------
    name : str
        Name of the function.
    inputs : tuple of int
        Length of each input vector.
    programs : tuple of Program
        What is called, each program once.
    calls : tuple of Call
        The calls. The outputs of several may share a memory, one after the other.
    memories : tuple of int
        Length of each memory that receives an output of a call.
    outputs : tuple of tuple of Cell
        For each output vector its cells, to be read when all calls are done.
    """

    name: str
    inputs: tuple[int, ...]
    programs: tuple[Program, ...]
    calls: tuple[Call, ...]
    memories: tuple[int, ...]
    outputs: tuple[tuple[Cell, ...], ...]

    def operations(self) -> int:
        """Number of operations of one run through the routine."""
        return sum(sum(self.programs[call.program].counts().values()) for call in self.calls)


def stretches(cells: Sequence[Cell]) -> list[tuple[Cell, int]]:
    """`cells` as runs of neighbours in one memory: the first cell and the number of cells of each run."""
    ends = [0]
    for i, (a, b) in enumerate(pairwise(cells), start=1):
        if a.memory == "constant" or (b.memory, b.number, b.place) != (a.memory, a.number, a.place + 1):
            ends.append(i)
    return [(cells[a], b - a) for a, b in pairwise([*ends, len(cells)])] if cells else []


def lower_calls(function: ca.Function) -> Routine:
    """The routine of an MX `function` with dense vector inputs and outputs.

    It may call SX functions, which become programs, and MX functions of the same kind; beyond that it may only cut
    vectors and put them together. Raises ValueError for arithmetic outside the functions it calls.
    """
    builder = _Builder()
    inputs = [[Cell("input", i, k) for k in range(function.nnz_in(i))] for i in range(function.n_in())]
    outputs = builder.walk(function, inputs)
    return builder.routine(function, outputs)


class _Builder:
    def __init__(self) -> None:
        self._programs: list[Program] = []
        self._known: dict[int, int] = {}
        self._kept: list[ca.Function] = []  # their numbers stay theirs while they live
        self._calls: list[Call] = []
        self._lengths: list[int] = []

    def walk(self, function: ca.Function, inputs: list[list[Cell]]) -> list[list[Cell]]:
        """The cells of the outputs of `function` for those of its `inputs`; its calls are noted."""
        work: dict[int, list[Cell]] = {}
        outputs: list[list[Cell]] = [[] for _ in range(function.n_out())]
        for i in range(function.n_instructions()):
            code = function.instruction_id(i)
            taken, given = function.instruction_input(i), function.instruction_output(i)
            if code in (ca.OP_INPUT, ca.OP_OUTPUT):  # a vector that was put together comes and goes in parts
                info = function.instruction_MX(i).info()
                if code == ca.OP_OUTPUT:
                    outputs[info["ind"]][info["offset"] :] = work[taken[0]]
                else:
                    end = info["offset"] + function.instruction_MX(i).numel()
                    work[given[0]] = inputs[info["ind"]][info["offset"] : end]
            elif code == ca.OP_CALL:
                called = function.instruction_MX(i).which_function()
                results = self._call(called, [work.get(slot, []) for slot in taken])
                work |= {slot: cells for slot, cells in zip(given, results, strict=True) if slot >= 0}
            else:
                parts = self._arranged(function, i, [work.get(slot, []) for slot in taken])
                work |= {slot: cells for slot, cells in zip(given, parts, strict=True) if slot >= 0}
        return outputs

    def _arranged(self, function: ca.Function, i: int, taken: list[list[Cell]]) -> list[list[Cell]]:
        """Cells of an instruction that computes nothing."""
        code, node = function.instruction_id(i), function.instruction_MX(i)
        if code == ca.OP_CONST:
            return [[Cell("constant", value=float(v)) for v in ca.DM(node.to_DM()).full().ravel(order="F")]]
        if code in (ca.OP_VERTCAT, ca.OP_HORZCAT):
            return [[cell for cells in taken for cell in cells]]
        if code == ca.OP_RESHAPE:
            return [taken[0]]
        if code == ca.OP_VERTSPLIT:
            return [taken[0][a:b] for a, b in pairwise(node.info()["offset"])]
        if code == ca.OP_GETNONZEROS:
            info = node.info()
            places = info["nz"] if "nz" in info else range(*(info["slice"][k] for k in ("start", "stop", "step")))
            return [[taken[0][place] for place in places]]
        raise ValueError(f"{function.name()}: instruction {node} computes; put it into an SX function")

    def _call(self, function: ca.Function, taken: list[list[Cell]]) -> list[list[Cell]]:
        filled = [
            cells or [Cell("constant")] * function.nnz_in(j) for j, cells in enumerate(taken)
        ]  # an argument that is all zeros has no memory
        if function.is_a("MXFunction"):
            return self.walk(function, filled)
        memories = [len(self._lengths) + j for j in range(function.n_out())]
        self._lengths += [function.nnz_out(j) for j in range(function.n_out())]
        self._calls.append(Call(self._program(function), tuple(map(tuple, filled)), tuple(memories)))
        return [[Cell("call", number, k) for k in range(self._lengths[number])] for number in memories]

    def _program(self, function: ca.Function) -> int:
        key = hash(function)
        if key not in self._known:
            self._kept.append(function)
            program = lower(function)
            if program not in self._programs:
                self._programs.append(program)
            self._known[key] = self._programs.index(program)
        return self._known[key]

    def routine(self, function: ca.Function, outputs: list[list[Cell]]) -> Routine:
        """The routine of what was noted, memory being used again once nothing reads it any more."""
        names = [program.name for program in self._programs]
        if len(set(names)) < len(names):
            raise ValueError(f"{function.name()} calls different functions of one name: {sorted(names)}")
        last = self._last_reads(outputs)
        places, lengths = self._places(last)

        def moved(cells: Sequence[Cell]) -> tuple[Cell, ...]:
            return tuple(c._replace(number=places[c.number]) if c.memory == "call" else c for c in cells)

        calls = tuple(
            Call(call.program, tuple(map(moved, call.inputs)), tuple(places[number] for number in call.outputs))
            for call in self._calls
        )
        sizes = tuple(function.nnz_in(i) for i in range(function.n_in()))
        return Routine(function.name(), sizes, tuple(self._programs), calls, lengths, tuple(map(moved, outputs)))

    def _last_reads(self, outputs: list[list[Cell]]) -> dict[int, int]:
        """The last call that reads each memory; those that the outputs read outlast all calls."""
        last: dict[int, int] = {}
        for i, call in enumerate(self._calls):
            last |= {cell.number: i for cells in call.inputs for cell in cells if cell.memory == "call"}
        return last | {cell.number: len(self._calls) for cells in outputs for cell in cells if cell.memory == "call"}

    def _places(self, last: dict[int, int]) -> tuple[dict[int, int], tuple[int, ...]]:
        """Where each memory lies, and the lengths of these places.

        A call reads all that it takes before it writes, so that an output may lie where an input of it was.
        """
        free: dict[int, list[int]] = {}
        places: dict[int, int] = {}
        lengths: list[int] = []
        for i, call in enumerate(self._calls):
            read = {cell.number for cells in call.inputs for cell in cells if cell.memory == "call"}
            for number in sorted(read):
                if last[number] == i:
                    free.setdefault(self._lengths[number], []).append(places[number])
            for number in call.outputs:
                length = self._lengths[number]
                known = free.get(length)
                if known:
                    places[number] = known.pop()
                else:
                    places[number] = len(lengths)
                    lengths.append(length)
                if number not in last:  # nobody reads it
                    free.setdefault(length, []).append(places[number])
        return places, tuple(lengths)
