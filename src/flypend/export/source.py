"""C text of the interface: structs, and a function around each program."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Sequence

from flypend.compile.c99 import Precision, literal, statements
from flypend.compile.program import Program
from flypend.export import records
from flypend.export.interface import Interface
from flypend.export.records import Record

_ASCII = {
    "²": "^2", "³": "^3", "⁴": "^4", "₁": "1", "₂": "2", "₃": "3", "⁻¹": "^-1", "·": "*", "×": "x", "√": "sqrt",
    "ω": "omega", "ẏ": "y_dot", "ż": "z_dot", "−": "-", "ζ": "zeta", "‖": "|", "∈": "in", "°": "deg", "τ": "tau",
}  # fmt: skip


def ascii_of(text: str) -> str:
    """`text` in letters that every compiler and editor knows."""
    for sign, plain in _ASCII.items():
        text = unicodedata.normalize("NFC", text).replace(sign, plain)
    return unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()


def struct(record: Record, unused: Sequence[str] = ()) -> str:
    """The C struct of `record`; fields in `unused` say that the law does not read them."""
    lines = [f"/* {ascii_of(record.comment)} */", "typedef struct {"]
    for field in record.fields:
        size = f"[{field.size}]" if field.size else ""
        note = " (not read by this law)" if field.name in unused else ""
        lines += [f"    /* {ascii_of(field.comment)}{note} */", f"    flypend_real {field.name}{size};"]
    return "\n".join([*lines, f"}} flypend_{record.name};"])


def unread(program: Program, vector: int, record: Record) -> list[str]:
    """Fields of `record`, input `vector` of `program`, that the program does not read."""
    read = {operation.arguments[1] for operation in program.operations if _is_input(operation, vector)}
    return [field.name for field, place in record.places() if not read & set(range(place.start, place.stop))]


def reads(program: Program, vector: int) -> bool:
    """Whether `program` reads anything of its input `vector`."""
    return any(_is_input(operation, vector) for operation in program.operations)


def _is_input(operation: object, vector: int) -> bool:
    name, arguments = operation.name, operation.arguments  # type: ignore[attr-defined]
    return bool(name == "input" and arguments[0] == vector)


def inner(
    name: str, program: Program, given: Sequence[tuple[str, Record | None]], wanted: tuple[str, Record | None],
    precision: Precision,
) -> str:  # fmt: skip
    """A static C function `name` around `program`, of pointers to the records that it reads.

    `given` are the arguments and their records (None for a plain number), `wanted` the result; without a record that is
    an array of numbers.
    """
    inputs = [record.members(f"{argument}->") if record else [argument] for argument, record in given]
    result, record = wanted
    count = len(program.outputs[0])
    outputs = record.members(f"{result}->") if record else [f"{result}[{i}]" for i in range(count)]
    parameters = [
        f"const flypend_{record.name} *{argument}" if record else f"flypend_real {argument}"
        for vector, (argument, record) in enumerate(given)
        if reads(program, vector)
    ]
    parameters.append(f"flypend_{record.name} *{result}" if record else f"flypend_real {result}[{count}]")
    body = statements(program, inputs, [outputs], precision)
    return "\n".join([f"static void {name}({', '.join(parameters)})", "{", *(f"    {line}" for line in body), "}"])


def call(name: str, program: Program, given: Sequence[str], result: str) -> str:
    """The call of the function that `inner` writes."""
    passed = [argument for vector, argument in enumerate(given) if reads(program, vector)]
    return f"{name}({', '.join([*passed, result])});"


def finite(record: Record) -> str:
    """A static C function that says whether all numbers of `record` are finite."""
    tests = [
        f"numbers({record.name}->{field.name}, {field.size})" if field.size else f"number({record.name}->{field.name})"
        for field in record.fields
    ]
    joined = "\n        && ".join(tests)
    return f"static int finite_{record.name}(const flypend_{record.name} *{record.name})\n{{\n    return {joined};\n}}"


def initializer(record: Record, values: Iterable[float], precision: Precision) -> str:
    """A C initializer of `record` from its numbers."""
    numbers = [literal(float(value), precision) for value in values]
    parts = []
    for field, place in record.places():
        text = ", ".join(numbers[place])
        parts.append(f"{{{text}}}" if field.size else text)
    return "{" + ", ".join(parts) + "}"


def functions(made: Interface, precision: Precision) -> dict[str, str]:
    """The C texts that the template of the source file takes."""
    state, reference, gains, params = records.STATE, records.REFERENCE, made.gains, made.params
    rotors, wrench, path = made.rotors, records.WRENCH, records.PATH
    step = [("state", state), ("reference", reference), ("gains", gains), ("params", params)]
    follow = [("path", path), ("state", state), ("params", params)]
    lead = [("wanted", rotors), ("modelled", rotors), ("lead", None), ("params", params)]
    inertia = next(field for field in params.fields if field.name == "inertia")
    return {
        "law": inner("law", made.step, step, ("wrench", wrench), precision),
        "carry": inner("carry", made.follow, follow, ("reference", reference), precision),
        "share": inner("share", made.mix, [("wrench", wrench), ("params", params)], ("rotors", rotors), precision),
        "quicken": inner("quicken", made.lead, lead, ("command", rotors), precision),
        "defects": inner("defects", made.check, [("state", state)], ("defect", None), precision),
        "call_law": call("law", made.step, [name for name, _ in step], "wrench"),
        "call_carry": call("carry", made.follow, [name for name, _ in follow], "reference"),
        "finite": "\n\n".join(finite(r) for r in (state, reference, gains, params, wrench, rotors, path)),
        "positive_inertia": " && ".join(f"(params->inertia[{i}] > 0)" for i in range(min(inertia.size, 3))),
        "largest": "DBL_MAX" if precision == "double" else "FLT_MAX",
    }
