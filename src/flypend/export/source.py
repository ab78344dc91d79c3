"""C text of the interface: structs, the numbers in them, the functions of the programs, what sensors add."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from flypend.compile.c99 import Precision, call, function, inputs_used_by, literal, routine_function, routine_scratch
from flypend.compile.program import Program
from flypend.compile.record import Record
from flypend.compile.routine import Routine
from flypend.compile.scratch import scratch
from flypend.export import records
from flypend.export.interface import Interface, Sensing
from flypend.plants.sensing import readings_record
from flypend.plants.sensors import Sensors

_ASCII = {
    "²": "^2", "³": "^3", "⁴": "^4", "₁": "1", "₂": "2", "₃": "3", "⁻¹": "^-1", "·": "*", "×": "x", "√": "sqrt",
    "ω": "omega", "ẏ": "y_dot", "ż": "z_dot", "−": "-", "ζ": "zeta", "‖": "|", "∈": "in", "°": "deg", "τ": "tau",
}  # fmt: skip


def ascii_of(text: str) -> str:
    """`text` in letters that every compiler and editor knows, and that neither end a comment nor begin one."""
    for sign, plain in _ASCII.items():
        text = unicodedata.normalize("NFC", text).replace(sign, plain)
    return (
        unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode().replace("*/", "* /").replace("/*", "/ *")
    )


def struct(record: Record, unused: Sequence[str] = ()) -> str:
    """The C struct of `record`; fields in `unused` say that the law does not read them."""
    lines = [f"/* {ascii_of(record.comment)} */", "typedef struct {"]
    for field in record.fields:
        size = f"[{field.size}]" if field.size else ""
        note = " (not read by this law)" if field.name in unused else ""
        lines += [f"    /* {ascii_of(field.comment)}{note} */", f"    flypend_real {field.name}{size};"]
    return "\n".join([*lines, f"}} flypend_{record.name};"])


def offsets(record: Record, prefix: str) -> str:
    """C constants for the length of `record`, FLYPEND_<prefix>, and for where each of its fields begins."""
    lines = [f"#define FLYPEND_{prefix} {record.length}"]
    for path, field, place in record.leaves():
        size = f"{field.size} numbers" if field.size else "1 number"
        name = path.replace(".", "_").upper()
        lines += [f"/* {size}: {ascii_of(field.comment)} */", f"#define FLYPEND_{prefix}_{name} {place.start}"]
    return "\n".join(lines)


def unread(entries: set[int], record: Record) -> list[str]:
    """Fields of `record` of which none of the `entries` is read."""
    return [field.name for field, place in record.places() if not entries & set(range(place.start, place.stop))]


def numbers_of(record: Record) -> str:
    """A static C function that returns the numbers of `record` in their order: the struct holds nothing else."""
    packed = f"sizeof(flypend_{record.name}) == {record.length} * sizeof(flypend_real)"
    return "\n".join([
        f"typedef char flypend_{record.name}_is_packed[({packed}) ? 1 : -1];",
        f"static const flypend_real *{record.name}_numbers(const flypend_{record.name} *from)",
        "{",
        "    return (const flypend_real *)from;",
        "}",
    ])  # fmt: skip


def record_of(record: Record) -> str:
    """A static C function that fills `record` with numbers in their order."""
    lines = [f"    {member} = from[{i}];" for i, member in enumerate(record.members("to->"))]
    head = f"static void {record.name}_of(const flypend_real *from, flypend_{record.name} *to)"
    return "\n".join([head, "{", *lines, "}"])


def literals(values: Iterable[float], precision: Precision) -> str:
    """C literals of `values`, between commas."""
    return ", ".join(literal(value, precision) for value in values)


def rows(table: Any, precision: Precision) -> str:
    """C initializers of the rows of a `table` (n, k), a line each, or of all tables of one (m, n, k)."""
    if np.ndim(table) == 3:
        return ",\n".join(f"    {{\n{rows(each, precision)}\n    }}" for each in table)
    return ",\n".join(f"    {{{literals(row, precision)}}}" for row in table)


def initializer(record: Record, values: Any, precision: Precision) -> str:
    """A C initializer of `record` from its numbers."""
    parts = [(literals(values[place], precision), field.size) for field, place in record.places()]
    return "{" + ", ".join(f"{{{text}}}" if size else text for text, size in parts) + "}"


def _call_of(
    routine: Routine, inputs: Sequence[str], outputs: str = "in->memory, in->command", memory: str = "in->rest"
) -> str:
    """The call of the function of a `routine` with C expressions of its vectors and of its scratch `memory`."""
    return f"{routine.name}({', '.join([memory, *(inputs[i] for i in inputs_used_by(routine)), outputs])});"


# Programs that check a state, and that answer where it cannot be used.
SAFE = ("rod", "attitude", "hold", "share")


def functions(made: Interface, precision: Precision) -> dict[str, str]:
    """The C texts that the template of the source file takes."""
    inputs = [records.MEASUREMENT, records.STATE, records.PATH, made.params, records.WRENCH, made.rotors]
    inputs += [records.REFERENCE] * made.follows
    outputs = [records.REFERENCE, records.WRENCH, made.rotors]
    programs = made.all_programs()
    texts = [function(program, precision) for program in programs.values()]
    texts += [routine_function(made.board, precision), routine_function(made.unmeasured, precision)]
    places = {f"place_{field.name}": str(place.start) for field, place in made.params.places()}
    law = ("s", "s + FLYPEND_STATE", "r", "gains_numbers(gains)", "p")
    sizes = {name: scratch(program).size for name, program in programs.items()}
    largest = max(
        routine_scratch(made.board), routine_scratch(made.unmeasured), sizes["begin"], *(sizes[name] for name in SAFE)
    )
    calls = {
        "law": (law, "w"), "hold": (("s", "p"), "w"), "share": (("w", "p"), "forces"), "gather": (("forces", "p"), "w"),
        "carry": (("along", "s + FLYPEND_STATE", "p"), "r"), "quicken": (("to", "from", "&lead", "p"), "to"),
        "rod": (("s",), "defect"), "attitude": (("s",), "defect"),
    }  # fmt: skip
    return {
        "programs": "\n\n".join(texts),
        "conversions": "\n\n".join([*map(numbers_of, inputs), *map(record_of, outputs)]),
        "call_board": _call_of(
            made.board, ("board->memory", "in->measurement", "path", "gains_numbers(&board->gains)", "p")
        ),
        "call_unmeasured": _call_of(made.unmeasured, ("board->memory", "in->command"), "in->memory"),
        "call_pass": _call_of(
            made.unmeasured,
            ("board->memory", "board->memory + FLYPEND_MEMORY_COMMANDS"),
            "board->scratch.memory",
            "board->scratch.rest",
        ),
        "call_begin": call(programs["begin"], ("forces",), ["board->memory"], "board->scratch.rest"),
        "call_share_safe": call(programs["share"], ("w", "p"), ["command"], "rest"),
        **{f"call_{name}": call(programs[name], given, [to], "rest") for name, (given, to) in calls.items()},
        **{
            f"rest_{name}": f"    flypend_real rest[{sizes[name]}];\n" if sizes[name] else ""
            for name in ("carry", "share", "gather", "quicken")
        },
        "scratch": str(largest),
        "law_scratch": str(max(1, sizes["law"], *(sizes[name] for name in SAFE))),
        "positive_inertia": _positive_inertia(made.params.place("inertia")),
        "largest": "DBL_MAX" if precision == "double" else "FLT_MAX",
        **places,
    }


def _positive_inertia(place: slice) -> str:
    """A C condition: the inertia matrix at this `place` of the parameters is positive definite (Sylvester)."""
    xx, yy, zz, *off = (f"p[{i}]" for i in range(place.start, place.stop))
    minors = [xx, yy, zz]
    if off:
        xy, xz, yz = off
        minors += [
            f"{xx} * {yy} - {xy} * {xy}",
            f"{xx} * ({yy} * {zz} - {yz} * {yz}) - {xy} * ({xy} * {zz} - {yz} * {xz})"
            f" + {xz} * ({xy} * {yz} - {yy} * {xz})",
        ]
    return " && ".join(f"({minor} > 0)" for minor in minors)


def sensor_values(made: Interface, sensing: Sensing, precision: Precision) -> dict[str, Any]:
    """What the templates of a flight computer with sensors take beside the values of the law's own."""
    readings = readings_record(sensing.sensors)
    checks = {name: made.programs[name] for name in ("rod", "attitude")}
    programs: dict[str, Program] = {"begin": sensing.begin, "sound": sensing.sound, **checks}
    programs |= {program.name: program for program in sensing.board.programs}
    texts = [function(program, precision) for program in programs.values()]
    inputs = [readings, records.STATE, made.params]
    inputs += [records.PATH] * made.follows
    given = ("computer->memory", "in->readings", "path", "gains_numbers(&computer->gains)", "p")
    sizes = [scratch(program).size for program in (sensing.begin, sensing.sound, *checks.values())]
    locals_, fill = "    (void)reference;\n", ""
    if made.follows:
        locals_ = ""
        fill = """\
    const flypend_real *path = path_numbers(reference);
    if (!numbers(path, FLYPEND_PATH)) {
        return FLYPEND_NOT_FINITE;
    }
"""
    return {
        "programs": "\n\n".join([*texts, routine_function(sensing.board, precision)]),
        "conversions": "\n\n".join([*map(numbers_of, inputs), record_of(records.STATE), record_of(made.rotors)]),
        "readings_struct": struct(readings),
        "readings_length": str(readings.length),
        "sensors_memory": offsets(sensing.memory, "SENSORS_MEMORY"),
        "scratch": str(max(1, routine_scratch(sensing.board), *sizes)),
        "call_begin": call(sensing.begin, ("given.force", "s", "p"), ["computer->memory"], "computer->scratch.rest"),
        "call_sound": call(sensing.sound, ("r",), ["defect"], "rest"),
        "call_board": _call_of(sensing.board, given),
        "locals": locals_,
        "null": " || reference == NULL" if made.follows else "",
        "fill": fill,
        "command_delay": f"{sensing.sensors.command_delay or 0.0:.3g}",
        "sensor_table": "\n".join(f" *   {line}" for line in describe(sensing.sensors)),
        "start": _start(sensing.sensors),
    }


def describe(sensors: Sensors) -> list[str]:
    """Rate, noise and latency of each stream, in words."""
    return [
        f"{name}: {s.rate:g} Hz, noise {s.noise:g}, latency {s.latency:g} s"
        + (f", steps {s.quantisation:.4g}" if s.quantisation else "")
        for name, s in sensors.streams.items()
    ]


def _start(sensors: Sensors) -> str:
    s = sensors.start
    vehicle = f"{s.x:g} m, {s.x_dot:g} m/s, {s.attitude:g} rad, {s.omega:g} rad/s"
    return f"{vehicle}, and {s.y:g} rad, {s.y_dot:g} 1/s of the rod"
