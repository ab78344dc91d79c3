"""Products of constant matrices with vectors, found again in the scalars of a program: layers of a network.

Code generators write them as a table and a loop instead of a statement for every weight.
"""

from __future__ import annotations

from dataclasses import dataclass

from flypend.compile.program import Program

LEAST = 64  # weights; fewer are as short without a loop


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
