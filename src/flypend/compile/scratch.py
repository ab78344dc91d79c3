"""What generated code keeps in memory of the caller's, and where: values of a straight-line program, and vectors.

A compiler keeps what a program of thousands of statements needs later on the stack: a kilobyte or two, where the
control task of a flight controller has little more. Generated code therefore stores such values itself. The vectors are
those of products with constant matrices, layers of a network, which are found again in the scalars of a program: code
writes them as a table and a loop instead of a statement for every weight.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from heapq import heappop, heappush

from flypend.compile.program import Operation, Program

# Statements after which a value is read from memory again; between them a compiler has registers, or the stack. Of 16,
# 24, 32, 48 and 64, the shortest code with which each function of the tuned law takes less than 100 bytes of stack on a
# Cortex-M4F, at -Os and at -O2.
SPAN = 48
# Operations whose value is true or false: integers, for which a processor has other registers, and enough of them.
TRUTHS = ("lt", "le", "eq", "ne", "not", "and", "or")
LEAST = 64  # weights of a matrix; fewer are as short without a loop


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


@dataclass(frozen=True)
class Matrix:
    """The sums Σⱼ Wᵢⱼ xⱼ of a program, each taken in the order of its columns.

    Parameters
    ----------
    rows : tuple of int
        Numbers of the operations that are these sums, ascending.
    columns : tuple of int
        Numbers of the operations xⱼ.
    weights : tuple of tuple of float
        Wᵢⱼ.
    inner : frozenset of int
        Numbers of the operations that nothing else needs: products and partial sums.
    """

    rows: tuple[int, ...]
    columns: tuple[int, ...]
    weights: tuple[tuple[float, ...], ...]
    inner: frozenset[int]


def matrices(program: Program) -> list[Matrix]:
    """Return the products with constant matrices in `program`, by their first rows; rounding stays as it is."""
    uses = program.uses()
    sums: dict[int, list[int]] = {}  # of products, in order: by the operation that ends them
    for number, operation in enumerate(program.operations):
        if operation.name != "add":
            continue
        for before, last in (operation.arguments, operation.arguments[::-1]):
            if not (uses[last] == 1 and _weight_of(program, last)):
                continue
            if before in sums and uses[before] == 1:
                sums[number] = [*sums.pop(before), last]
            elif uses[before] == 1 and _weight_of(program, before):
                sums[number] = [before, last]
            else:
                continue
            break
    groups: dict[tuple[int, ...], list[int]] = {}
    for root, products in sums.items():
        groups.setdefault(tuple(_weight_of(program, product)[1] for product in products), []).append(root)  # type: ignore[index]
    found = [
        _matrix(program, sorted(roots), columns, [sums[root] for root in sorted(roots)])
        for columns, roots in groups.items()
        if len(roots) > 1 and len(roots) * len(columns) >= LEAST
    ]
    return sorted(found, key=lambda matrix: matrix.rows)


def _weight_of(program: Program, number: int) -> tuple[float, int] | None:
    """Return weight and variable if the operation is the product of a constant and a variable."""
    operation = program.operations[number]
    if operation.name != "mul":
        return None
    for a, b in (operation.arguments, operation.arguments[::-1]):
        if program.operations[a].name == "constant" and program.operations[b].name != "constant":
            return program.operations[a].value, b
    return None


def _matrix(program: Program, rows: list[int], columns: tuple[int, ...], products: list[list[int]]) -> Matrix:
    """Return the product (rows, inner) · (inner, columns) that the partial sums `products` of the `rows` make."""
    inner = set()
    for root, row in zip(rows, products, strict=True):
        inner |= set(row)
        last = root
        for _ in row[2:]:  # back along the partial sums
            last = next(place for place in program.operations[last].arguments if place not in row)
            inner.add(last)
    weights = tuple(tuple(_weight_of(program, product)[0] for product in row) for row in products)  # type: ignore[index]
    return Matrix(tuple(rows), columns, weights, frozenset(inner))
