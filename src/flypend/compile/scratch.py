"""Which values of a straight-line program are kept in memory of the caller's, and where.

A compiler keeps what a program of thousands of statements needs later on the stack: a kilobyte or two, where the
control task of a flight controller has little more. Generated code therefore stores such values itself.
"""

from __future__ import annotations

from functools import lru_cache
from heapq import heappop, heappush

from flypend.compile.matrices import matrices
from flypend.compile.program import Operation, Program

# Statements after which a value is read from memory again; between them a compiler has registers, or the stack. Of 16,
# 24, 32, 48 and 64, the shortest code with which each function of the tuned law takes less than 100 bytes of stack on a
# Cortex-M4F, at -Os and at -O2.
SPAN = 48
# Operations whose value is true or false: integers, for which a processor has other registers, and enough of them.
TRUTHS = ("lt", "le", "eq", "ne", "not", "and", "or")


class Scratch:
    """Places for values that are read more than `SPAN` statements after they were computed, and for matrices' vectors.

    A place is taken again when nothing reads its value any more.

    Parameters
    ----------
    program : Program
        What is written.

    Attributes
    ----------
    places : dict
        The place of each value that has one.
    vectors : list of int
        For each of `matrices`, where its columns begin; its rows follow.
    matrices : list of Matrix
        The products with constant matrices of the program.
    inner : set of int
        Values that only the loops of the matrices compute.
    size : int
        How many numbers there are.
    """

    def __init__(self, program: Program) -> None:
        self.matrices = matrices(program)
        self.inner = {number for matrix in self.matrices for number in (*matrix.rows, *matrix.inner)}
        self.places: dict[int, int] = {}
        self.vectors: list[int] = []
        self.size = 0
        self._first = {matrix.rows[0]: matrix for matrix in self.matrices}
        last = self._last_uses(program)
        free: list[int] = []
        taken: list[tuple[int, int]] = []  # the last use, and the place
        for number, operation in enumerate(program.operations):
            while taken and taken[0][0] < number:
                free.append(heappop(taken)[1])
            if number in self._first:
                matrix = self._first[number]
                self.vectors.append(self._more(len(matrix.columns)))
                rows = self._more(len(matrix.rows))
                self.places |= {row: rows + i for i, row in enumerate(matrix.rows)}
            elif (
                number not in self.inner
                and operation.name not in ("input", "constant", *TRUTHS)
                and last[number] > number + SPAN
            ):
                self.places[number] = free.pop() if free else self._more(1)
                heappush(taken, (last[number], self.places[number]))

    def _last_uses(self, program: Program) -> dict[int, int]:
        """The last operation that reads each value; results are read after all operations."""
        last = {number: len(program.operations) for numbers in program.outputs for number in numbers}
        for number, operation in reversed(list(enumerate(program.operations))):
            for argument in self._arguments(number, operation):
                last.setdefault(argument, number)
        return last

    def _arguments(self, number: int, operation: Operation) -> tuple[int, ...]:
        """The values that are read where operation `number` stands."""
        if number in self._first:
            return self._first[number].columns
        return () if number in self.inner or operation.name == "input" else operation.arguments

    def _more(self, count: int) -> int:
        """The first of `count` new places."""
        self.size += count
        return self.size - count


@lru_cache(maxsize=32)
def scratch(program: Program) -> Scratch:
    """Return the places of `program`, found once for its function and for each call of it."""
    return Scratch(program)
