"""CasADi functions made of calls as routines: a sequence of calls of scalar programs on contiguous memory.

A prediction calls one step function many times. Expanded inline, it would be a program of ten thousand operations, too
large for a processor's cache or a microcontroller's flash. With calls, each program exists once.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import casadi as ca

from flypend.compile.program import Program, lower


class Cell(NamedTuple):
    """One scalar: entry `place` of buffer `number` of the kind `memory` ("input", "call" or "constant").

    A "constant" is `value` itself and has no buffer.
    """

    memory: str
    number: int = 0
    place: int = 0
    value: float = 0.0


class Call(NamedTuple):
    """A call of the program with index `program`: its input cells, and the buffer for each of its outputs."""

    program: int
    inputs: tuple[tuple[Cell, ...], ...]
    outputs: tuple[int, ...]


@dataclass(frozen=True)
class Routine:
    """A sequence of calls of programs.

    Parameters
    ----------
    name : str
        Name of the function.
    inputs : tuple of int
        Length of each input vector.
    programs : tuple of Program
        The distinct programs that are called.
    calls : tuple of Call
        The calls, in order. Outputs of different calls may reuse a buffer.
    memories : tuple of int
        Length of each buffer for outputs of calls.
    outputs : tuple of tuple of Cell
        Cells of each output vector, read after all calls.
    """

    name: str
    inputs: tuple[int, ...]
    programs: tuple[Program, ...]
    calls: tuple[Call, ...]
    memories: tuple[int, ...]
    outputs: tuple[tuple[Cell, ...], ...]

    def operations(self) -> int:
        """Number of operations of one execution of the routine."""
        return sum(sum(self.programs[call.program].counts().values()) for call in self.calls)

    def slide(self) -> int:
        """Return by how many places most cells move that the first output takes over from the first input.

        This is the length of an entry if the vector ends with a queue. 0 if none move to a later place.
        """
        moves = [i - cell.place for i, cell in enumerate(self.outputs[0]) if cell[:2] == ("input", 0)]
        later = Counter(move for move in moves if move > 0)
        return later.most_common(1)[0][0] if later else 0


def stretches(cells: Sequence[Cell]) -> list[tuple[Cell, int]]:
    """Split `cells` into contiguous runs within one buffer: the first cell and length of each run."""
    ends = [0]
    for i, (a, b) in enumerate(pairwise(cells), start=1):
        if a.memory == "constant" or (b.memory, b.number, b.place) != (a.memory, a.number, a.place + 1):
            ends.append(i)
    return [(cells[a], b - a) for a, b in pairwise([*ends, len(cells)])] if cells else []


def lower_calls(function: ca.Function) -> Routine:
    """Lower an MX `function` with dense vector inputs and outputs to a routine.

    The function may call SX functions, which become programs, and other such MX functions. Otherwise it may only split
    and concatenate vectors. Raises ValueError for arithmetic outside the called functions, and for sparse outputs.
    """
    builder = _Builder()
    inputs = [[Cell("input", i, k) for k in range(function.nnz_in(i))] for i in range(function.n_in())]
    outputs = builder.walk(function, inputs)
    return builder.routine(function, outputs)


class _Builder:
    def __init__(self) -> None:
        self._programs: list[Program] = []
        self._known: dict[int, int] = {}
        self._kept: list[ca.Function] = []  # keeps their hashes unique by keeping them alive
        self._calls: list[Call] = []
        self._lengths: list[int] = []

    def walk(self, function: ca.Function, inputs: list[list[Cell]]) -> list[list[Cell]]:
        """Return the output cells of `function` for the cells of its `inputs`, and record its calls."""
        for i in range(function.n_out()):  # whose cells would be fewer than its entries
            if function.nnz_out(i) < function.numel_out(i):
                raise ValueError(f"output {i} of {function.name()} is sparse; densify it")
        work: dict[int, list[Cell]] = {}
        outputs: list[list[Cell]] = [[] for _ in range(function.n_out())]
        for i in range(function.n_instructions()):
            code = function.instruction_id(i)
            taken, given = function.instruction_input(i), function.instruction_output(i)
            if code in (ca.OP_INPUT, ca.OP_OUTPUT):  # a concatenated vector is read and written in parts
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
                parts = self._arrange(function, i, [work.get(slot, []) for slot in taken])
                work |= {slot: cells for slot, cells in zip(given, parts, strict=True) if slot >= 0}
        return outputs

    def _arrange(self, function: ca.Function, i: int, taken: list[list[Cell]]) -> list[list[Cell]]:
        """Output cells of an instruction that only rearranges its inputs."""
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
        raise ValueError(f"{function.name()}: instruction {node} computes a value; move it into an SX function")

    def _call(self, function: ca.Function, taken: list[list[Cell]]) -> list[list[Cell]]:
        filled = [
            cells or [Cell("constant")] * function.nnz_in(j) for j, cells in enumerate(taken)
        ]  # an all-zero argument has no buffer
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
        """Build the routine from the recorded calls, reusing each buffer after its last read."""
        names = [program.name for program in self._programs]
        if len(set(names)) < len(names):
            raise ValueError(f"{function.name()} calls different functions with one name: {sorted(names)}")
        places, lengths = self._places(outputs)

        def moved(cells: Sequence[Cell]) -> tuple[Cell, ...]:
            return tuple(c._replace(number=places[c.number]) if c.memory == "call" else c for c in cells)

        calls = tuple(
            Call(call.program, tuple(map(moved, call.inputs)), tuple(places[number] for number in call.outputs))
            for call in self._calls
        )
        sizes = tuple(function.nnz_in(i) for i in range(function.n_in()))
        return Routine(function.name(), sizes, tuple(self._programs), calls, lengths, tuple(map(moved, outputs)))

    def _places(self, outputs: list[list[Cell]]) -> tuple[dict[int, int], tuple[int, ...]]:
        """Assign each buffer a slot, and return the lengths of the slots.

        An output never reuses the slot of an input of its own call: C copies from one to the other (`c99.copies`).
        """
        # What each call reads; buffers read by the outputs outlive all calls.
        reads = [_buffers(call.inputs) for call in self._calls] + [_buffers(outputs)]
        last = {number: i for i, numbers in enumerate(reads) for number in numbers}
        free: defaultdict[int, list[int]] = defaultdict(list)
        places: dict[int, int] = {}
        lengths: list[int] = []
        for i, call in enumerate(self._calls):
            for number in call.outputs:
                length = self._lengths[number]
                if not free[length]:
                    free[length].append(len(lengths))
                    lengths.append(length)
                places[number] = free[length].pop()
            never = [number for number in call.outputs if number not in last]
            for number in (*sorted(n for n in reads[i] if last[n] == i), *never):
                free[self._lengths[number]].append(places[number])
        return places, tuple(lengths)


def _buffers(vectors: Sequence[Sequence[Cell]]) -> set[int]:
    """Numbers of the outputs of calls in `vectors`."""
    return {cell.number for cells in vectors for cell in cells if cell.memory == "call"}
