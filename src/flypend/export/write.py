"""The folder that a flight computer's build takes in."""

from __future__ import annotations

import math
import os
import warnings
import zlib
from collections.abc import Iterable, Sequence
from importlib import metadata, resources
from pathlib import Path
from string import Template
from typing import Any

import numpy as np

from flypend import errors, signals
from flypend.board.command import usable_lead
from flypend.building import builds
from flypend.compile.c99 import PRECISIONS, Precision, define_real, literal, reads
from flypend.compile.record import Record
from flypend.errors import InputError
from flypend.export import records, vectors
from flypend.export.interface import Interface, interface
from flypend.export.rehearsal import fly_tests
from flypend.export.source import ascii_of, functions, initializer, literals, offsets, sensor_values, struct, unread
from flypend.files.staging import write_texts
from flypend.laws import BoundLaw, Law
from flypend.model import Vehicle
from flypend.model.state import MANIFOLD_TOLERANCE
from flypend.plants.sensors import Sensors, sensors_called

HEADER, GUARD = "flypend_law.h", "#ifndef FLYPEND_LAW_H\n"
CORE = (HEADER, "flypend_law.c")
WITH_SENSORS = ("flypend_sensors.h", "flypend_sensors.c")
BESIDE = (
    "flypend_test.c", "flypend_fuzz.c", "flypend_vectors.h", "CMakeLists.txt", "README.md",
    "adapters/flypend_frames.h", "adapters/flypend_frames.c",
)  # fmt: skip
# Largest relative difference of a test vector.
TOLERANCE: dict[Precision, float] = {"double": 1e-12, "float": 1e-4}


@errors.named_arguments
@signals.defer()
@builds
def export_c(
    law: Law | BoundLaw,
    vehicle: Vehicle,
    out: str | Path,
    *,
    precision: Precision = "double",
    rate: float = 500.0,
    sensors: Sensors | str | None = None,
    check: bool = True,
) -> Path:
    """Write the flight computer of `law` on `vehicle` as C99 into the folder `out`.

    Beside it stand the bare law, test vectors, adapters, a README and a CMake file. The vehicle's numbers and the law's
    gains are structs that the C code takes at run time; the linear-quadratic law has its gain matrix as constants,
    computed for this vehicle. Fixed as well: control rate, latency, rotor lag, lead and bandwidth of the observer, the
    number of rotors, their spins, and whether the inertia matrix is diagonal. The same arguments give the same bytes.

    Parameters
    ----------
    law : Law
        A symbolic law that uses no function but the square root. A law that depends on time must have a `path` (see
        `BoundLaw.along`).
    vehicle : Vehicle
        What it flies.
    out : str or Path
        Folder that receives the files. It may exist, with files of the same names if an export wrote them. What an
        earlier one wrote for sensors is removed where this has none.
    precision : "double" or "float"
        Type of every number.
    rate : float
        Rate at which the flight computer will be called, Hz.
    sensors : Sensors or str, optional
        The sensors, or the name of a suite. flypend_sensors.h and .c are then written, too: the flight computer with an
        estimator. Default "perfect": no estimator.
    check : bool
        Whether to fly the law first, for seconds, and state the result in the header. A poor one is a warning.

    Returns
    -------
    Path
        The folder.

    Raises
    ------
    InputError
        If `law` is not a `Law`, or uses the time itself or a function other than the square root; if the vehicle's
        rotors do not share thrust and yaw equally; if the precision is unknown or the rate out of range; or if the
        folder cannot be written, or has files of these names that no export wrote.
    """
    if not isinstance(law, Law | BoundLaw):
        raise InputError("law", "a Law, written in symbols", repr(law))
    if not isinstance(vehicle, Vehicle):
        raise InputError("vehicle", "a Vehicle", repr(vehicle))
    check_folder(out, BESIDE)
    errors.one_of("precision", precision, PRECISIONS)
    errors.number("rate", rate, above=0, at_most=1e4, unit="Hz")
    made = interface(law, vehicle, rate, sensors_called(sensors, "sensors"))
    texts = core(made, precision)
    values = values_of(made, precision) | _vectors(made, precision)
    values["sources"] = " ".join(name for name in texts if name.endswith(".c"))
    texts |= {name: fill(name, values) for name in BESIDE}
    if check:
        found = fly_tests(law, vehicle, rate)
        texts[HEADER] = texts[HEADER].replace(GUARD, f"{found.comment()}{GUARD}", 1)
        if found.poor:
            warnings.warn(f"the exported law flies {vehicle.name} poorly: {found.poor}", stacklevel=2)
    write_texts(out, texts)
    for path in (Path(out) / name for name in WITH_SENSORS if name not in texts):
        if path.is_file() and "by flypend " in path.read_text(encoding="utf-8", errors="replace").partition("\n")[0]:
            path.unlink()  # of an earlier export, with the law of then
    return Path(out)


def check_folder(out: str | Path, names: Iterable[str]) -> None:
    """Raise InputError if the folder `out` has a file of one of `names`, and no README.md that an export wrote."""
    try:
        written = "ritten by flypend " in (Path(out) / "README.md").read_text(encoding="utf-8", errors="replace")
    except (OSError, ValueError):
        written = False
    for path in (Path(out) / name for name in names):
        if not written and os.path.lexists(path):
            raise InputError(str(path), "nothing, or a folder that an export wrote", "another file")


def core(made: Interface, precision: Precision) -> dict[str, str]:
    """Name and text of the files that make the library: two, and two more for a flight computer with sensors."""
    values = values_of(made, precision)
    texts = {name: fill(name, values) for name in CORE}
    if made.sensing is not None:
        values = _add_mark(values | sensor_values(made, made.sensing, precision))
        texts |= {name: fill(name, values) for name in WITH_SENSORS}
    return texts


def fill(name: str, values: dict[str, Any]) -> str:
    """The template called `name` with `values` put in."""
    text = (resources.files("flypend.export") / "templates" / name).read_text(encoding="utf-8")
    return Template(text).substitute(values)


def values_of(made: Interface, precision: Precision) -> dict[str, Any]:
    """What the templates take."""
    law, vehicle, computer = made.law, made.vehicle, made.law.computer
    gains = [law.numbers.get(field.name, 0.0) for field in made.gains.fields]
    thrust_scale, moment_scale = vectors.scales(vehicle)
    lengths = {
        "reference_length": records.REFERENCE.length, "path_length": records.PATH.length,
        "gains_length": made.gains.length, "params_length": made.params.length,
    }  # fmt: skip
    values = functions(made, precision) | _optional(made)
    values |= {name: str(length) for name, length in lengths.items()}
    values |= {
        "law": ascii_of(law.name),
        "vehicle": ascii_of(vehicle.name),
        "version": metadata.version("flypend"),
        "precision": precision,
        "real": define_real(precision),
        "memory": offsets(made.memory, "MEMORY"),
        "rotors": str(made.rotors.length),
        "follows": str(int(made.follows)),
        "rate": f"{made.loop.sampled.rate:g}",
        "period": literal(1 / made.loop.sampled.rate, precision),
        "lag": f"{vehicle.rotor_lag:.3g}",
        "observer": f"{computer.observer:.3g}",
        "tolerance": literal(MANIFOLD_TOLERANCE, precision),
        "rotation_tolerance": literal(round(3 * MANIFOLD_TOLERANCE, 12), precision),
        "structs": "\n\n".join(_structs(made)),
        "gains": initializer(made.gains, gains, precision),
        "params": initializer(made.params, records.params_of(vehicle), precision),
        "spins": literals(vehicle.sharing()[2], precision),
        "place_p": str(records.REFERENCE.place("p").start),
        "lead": f"{usable_lead(law, vehicle, made.loop.sampled):.3g}",
        "zero_path": initializer(records.PATH, np.zeros(records.PATH.length), precision),
        "zero_measurement": initializer(records.MEASUREMENT, np.zeros(records.MEASUREMENT.length), precision),
        "radians": literal(math.pi / 180, precision),
        "sqrt": "sqrt" if precision == "double" else "sqrtf",
        "baked": _constants_in_words(made),
        "latency": f"{computer.latency:.3g}",
        "rotor_table": _rotor_table(vehicle),
        "period_us": str(round(1e6 / made.loop.sampled.rate)),
        "thrust_scale": repr(thrust_scale),
        "moment_scale": repr(moment_scale),
    }
    values["checks"] = fill("checks.c", values)
    return _add_mark(values)


def _add_mark(values: dict[str, Any]) -> dict[str, Any]:
    """`values` with the mark of a memory begun by this code: what differs between two codes is in their texts."""
    return values | {"mark": f"0x{zlib.crc32(repr(sorted(values.items())).encode()) | 1:08x}U"}


def _optional(made: Interface) -> dict[str, str]:
    """The lines for reference and gains in the functions of the board and of the bare law: only for what is read."""
    found: dict[str, str] = {}
    for prefix, state, path, length in (("board", "measurement", "path", "PATH"), ("step", "s", "r", "REFERENCE")):
        read = {"reference": made.follows, "gains": made.has_gains}
        if prefix == "board":
            del read["gains"]  # it has its own, which are finite
        pointers = [state, *(pointer for pointer in read if read[pointer])]
        missing = [f"{pointer} == NULL" for pointer in pointers]
        checks = [f"{path}, FLYPEND_{length}"] * made.follows
        checks += ["gains_numbers(gains), FLYPEND_GAINS"] * ("gains" in pointers)
        found |= {
            f"{prefix}_locals": "".join(f"    (void){pointer};\n" for pointer in read if not read[pointer]),
            f"{prefix}_null": missing[0] if len(missing) == 1 else " || ".join(f"({text})" for text in missing),
            f"{prefix}_fill": made.follows * f"    const flypend_real *{path} = {length.lower()}_numbers(reference);\n",
            f"{prefix}_finite": "".join(f" || !numbers({check})" for check in checks),
        }
    return found


def _constants_in_words(made: Interface) -> str:
    """What the code holds as constants, in words."""
    inertia = made.params.place("inertia")
    diagonal = "a diagonal inertia matrix" if inertia.stop - inertia.start == 3 else "a full inertia matrix"
    text = f"the number of rotors ({made.rotors.length}), their spins, {diagonal}."
    options = made.law.options
    if made.constant:
        text += " Gains: " + ", ".join(f"{name} = {made.law.numbers[name]:.6g}" for name in made.constant) + "."
    if options:
        text += " Options: " + ", ".join(f"{name} = {value}" for name, value in options.items()) + "."
    if not made.has_gains:
        text += f" All gains of the {made.law.name} law, computed for this vehicle: export again after a change of it."
    return ascii_of(text)


def _rotor_table(vehicle: Vehicle) -> str:
    lines = ["| rotor | x m | y m | spin |", "|---|---|---|---|"]
    for i, (place, spin) in enumerate(zip(vehicle.rotor_positions, vehicle.rotor_spins, strict=True)):
        lines.append(f"| {i} | {place[0]:.4g} | {place[1]:.4g} | {spin:+.0f} |")
    return "\n".join(lines)


def _structs(made: Interface) -> list[str]:
    law, state = made.programs["law"], len(records.MEASUREMENT.fields)
    unused = unread(reads(law, 0), records.MEASUREMENT)
    forces = Record("forces", "", records.STATE.fields[state:])
    unused_forces = unread(reads(law, 1) | reads(made.programs["carry"], 1), forces)
    return [
        struct(records.MEASUREMENT, unused),
        struct(records.STATE, unused + unused_forces),
        struct(records.REFERENCE, unread(reads(law, 2), records.REFERENCE)),
        struct(records.PATH),
        struct(made.gains),
        struct(made.params),
        struct(records.WRENCH),
        struct(made.rotors),
    ]


def _vectors(made: Interface, precision: Precision) -> dict[str, str]:
    """What the template of the test vectors takes."""
    steady = TOLERANCE[precision] / 10
    found = vectors.steady_vectors(made.law, made.vehicle, vectors.COUNT, vectors.SEED, precision, steady)
    flights = vectors.flights(made.loop, vectors.FLIGHTS, vectors.STEPS, vectors.SEED, precision, made.law)
    if not all(np.isfinite(each).all() for each in flights):
        raise InputError("rate", "one at which flights stay finite", f"{made.loop.sampled.rate:g} Hz")
    answered = (records.STATE, records.REFERENCE, records.WRENCH, made.rotors)
    flown = (records.MEASUREMENT, records.PATH, made.rotors)
    return {
        "vector_tolerance": repr(TOLERANCE[precision]),
        "steps": str(vectors.STEPS),
        "vectors": _rows(answered, found, precision),
        "flights": _rows(flown, flights, precision),
    }


def _rows(kinds: Sequence[Record], columns: Sequence[Any], precision: Precision) -> str:
    rows = []
    for row in zip(*columns, strict=True):
        parts = [initializer(record, part, precision) for record, part in zip(kinds, row, strict=True)]
        rows.append("    {" + ",\n     ".join(parts) + "},")
    return "\n".join(rows)
