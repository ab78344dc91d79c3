"""A vector of numbers as a table of named fields: equations, kernels and C find a number by name, at one offset."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import casadi as ca


@dataclass(frozen=True)
class Field:
    """Entry of a record: `size` numbers called `name`, explained by `comment`. A size of 0 is one plain number.

    `parts` are the entries that it consists of, if it is a record itself.
    """

    name: str
    size: int
    comment: str
    parts: tuple[Field, ...] = ()

    @classmethod
    def of(cls, record: Record) -> Field:
        """Return the entry that a whole `record` makes in another."""
        return cls(record.name, record.length, record.comment, record.fields)


@dataclass(frozen=True)
class Record:
    """Numbers called `name`, explained by `comment`, one field after the other; in C a struct `flypend_<name>`."""

    name: str
    comment: str
    fields: tuple[Field, ...]

    @property
    def length(self) -> int:
        """How many numbers it holds."""
        return sum(max(field.size, 1) for field in self.fields)

    def members(self, access: str) -> list[str]:
        """C expressions of its numbers in order, behind `access`, such as `state->`."""
        each = ([f"{access}{field.name}[{i}]" for i in range(field.size)] for field in self.fields)
        return [text for field, texts in zip(self.fields, each, strict=True) for text in texts or [access + field.name]]

    def places(self) -> Iterator[tuple[Field, slice]]:
        """Its fields, each with its place among the numbers."""
        return ((field, where) for path, field, where in _walk(self.fields) if path == field.name)

    def leaves(self) -> Iterator[tuple[str, Field, slice]]:
        """Its innermost fields, each with its path, such as "delay.found", and its place among the numbers."""
        return (found for found in _walk(self.fields) if not found[1].parts)

    def place(self, path: str) -> slice:
        """Return where the numbers of the field at `path` lie, such as "delay" or "delay.found"."""
        return next(where for name, _, where in _walk(self.fields) if name == path)

    def split(self, numbers: Any) -> dict[str, Any]:
        """Return the numbers of each field, by name; of a field of size 0 the one number."""
        return {field.name: numbers[where if field.size else where.start] for field, where in self.places()}

    def join(self, values: Mapping[str, Any]) -> Any:
        """Return the CasADi vector of the `values` of all fields by name."""
        return ca.vertcat(*(values[field.name] for field in self.fields))


def _walk(fields: tuple[Field, ...], start: int = 0, above: str = "") -> Iterator[tuple[str, Field, slice]]:
    """Yield path and place of each field, followed by those of its parts."""
    for field in fields:
        where = slice(start, start + max(field.size, 1))
        yield above + field.name, field, where
        yield from _walk(field.parts, start, f"{above}{field.name}.")
        start = where.stop
