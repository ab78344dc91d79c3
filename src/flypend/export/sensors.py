"""The C texts of a flight computer with sensors: two files beside those of the law."""

from __future__ import annotations

from typing import Any

from flypend.compile.c99 import Precision, call, function, inputs_used_by, routine_function, routine_scratch
from flypend.compile.program import Program
from flypend.compile.scratch import scratch
from flypend.export import records
from flypend.export.interface import Interface, Sensing
from flypend.export.source import numbers_of, offsets, record_of, struct
from flypend.plants.sensing import readings_record
from flypend.plants.sensors import Sensors

FILES = ("flypend_sensors.h", "flypend_sensors.c")


def sensor_values(made: Interface, sensing: Sensing, precision: Precision) -> dict[str, Any]:
    """What the templates of FILES take beside the values of the law's own."""
    readings = readings_record(sensing.sensors)
    checks = {name: made.programs[name] for name in ("rod", "attitude")}
    programs: dict[str, Program] = {"begin": sensing.begin, "sound": sensing.sound, **checks}
    programs |= {program.name: program for program in sensing.board.programs}
    texts = [function(program, precision) for program in programs.values()]
    inputs = [readings, records.STATE, made.params]
    inputs += [records.PATH] * made.follows
    given = ("computer->memory", "in->readings", "path", "gains_numbers(&computer->gains)", "p")
    fly = ["in->rest", *(given[i] for i in inputs_used_by(sensing.board)), "in->memory", "in->command"]
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
        "call_board": f"fly({', '.join(fly)});",
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
