"""The folder that a flight computer's build takes in."""

from __future__ import annotations

import math
from importlib import metadata, resources
from pathlib import Path
from string import Template
from typing import Any

from flypend import errors
from flypend.compile.c99 import PRECISIONS, Precision, literal
from flypend.errors import InputError
from flypend.export import records, vectors
from flypend.export.interface import Interface, interface
from flypend.export.source import ascii_of, functions, initializer, reads, struct, unread
from flypend.files.staging import staged
from flypend.laws import BoundLaw, Law
from flypend.model import Vehicle
from flypend.model.state import MANIFOLD_TOLERANCE

CORE = ("flypend_law.h", "flypend_law.c")
BESIDE = ("flypend_test.c", "flypend_fuzz.c", "CMakeLists.txt", "README.md")
ADAPTERS = (
    "adapters/flypend_frames.h", "adapters/flypend_frames.c", "adapters/flypend_crazyflie.c",
    "adapters/flypend_px4.cpp", "adapters/flypend_px4.hpp", "adapters/flypend_ros2.cpp", "adapters/flypend_ros2.hpp",
)  # fmt: skip
# Largest relative difference of a test vector.
TOLERANCE: dict[Precision, float] = {"double": 1e-12, "float": 1e-4}


def export_c(law: Law | BoundLaw, vehicle: Vehicle, out: str | Path, *, precision: Precision = "double") -> Path:
    """Write `law` for `vehicle` as C99 into the folder `out`: law, test vectors, adapters, README and CMake file.

    The vehicle's numbers and the law's gains are structs that the C code takes at run time; the linear-quadratic law
    has its gain matrix as constants, computed for this vehicle. The number of rotors, their spins, and whether the
    inertia matrix is diagonal are fixed as well. The same arguments give the same bytes.

    Parameters
    ----------
    law : Law
        Any law written in symbols with square roots only; one that depends on time must have `along`.
    vehicle : Vehicle
        What it flies.
    out : str or Path
        Folder that receives the files; it may exist.
    precision : "double" or "float"
        Type of every number.

    Returns
    -------
    Path
        The folder.

    Raises
    ------
    InputError
        For a law that is no `Law`, that uses other functions than the square root or the time itself, a vehicle whose
        rotors do not share thrust and yaw equally, an unknown precision, or a folder that cannot be written.
    """
    if not isinstance(law, Law | BoundLaw):
        raise InputError("law", "a Law, written in symbols", repr(law))
    if not isinstance(vehicle, Vehicle):
        raise InputError("vehicle", "a Vehicle", repr(vehicle))
    errors.one_of("precision", precision, PRECISIONS)
    texts = files(interface(law, vehicle), precision)
    with staged(out) as folder:
        for name, text in texts.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8", newline="\n")
    return Path(out)


def files(made: Interface, precision: Precision) -> dict[str, str]:
    """Name and text of every file."""
    values = _values(made, precision)
    texts = {name: filled(name, values) for name in (*CORE, *BESIDE, *ADAPTERS)}
    return texts | {"flypend_vectors.h": _vectors(made, precision)}


def core(made: Interface, precision: Precision) -> dict[str, str]:
    """Name and text of the two files that make the library."""
    values = _values(made, precision)
    return {name: filled(name, values) for name in CORE}


def filled(name: str, values: dict[str, Any]) -> str:
    """The template called `name` with `values` put in."""
    text = (resources.files("flypend.export") / "templates" / name).read_text(encoding="utf-8")
    return Template(text).substitute(values)


def _values(made: Interface, precision: Precision) -> dict[str, Any]:
    law, vehicle = made.law, made.vehicle
    parts = functions(made, precision)
    gains = [law.numbers.get(field.name, 0.0) for field in made.gains.fields]
    has_gains = reads(made.step, 2)
    thrust_scale, moment_scale = vectors.scales(vehicle)
    checks = [("reference", "reference", made.follows), ("gains", "gains", has_gains)]
    return parts | {
        "law": ascii_of(law.name),
        "law_function": parts["law"],
        "vehicle": ascii_of(vehicle.name),
        "version": metadata.version("flypend"),
        "precision": precision,
        "rotors": str(made.rotors.length),
        "follows": str(int(made.follows)),
        "tolerance": literal(MANIFOLD_TOLERANCE, precision),
        "rotation_tolerance": literal(round(3 * MANIFOLD_TOLERANCE, 12), precision),
        "structs": "\n\n".join(_structs(made)),
        "gains": initializer(made.gains, gains, precision),
        "params": initializer(made.params, records.params_of(vehicle), precision),
        "still": initializer(records.REFERENCE, [0.0] * records.REFERENCE.length, precision),
        "lead": f"{law.computer.lead:.3g}",
        "lead_number": literal(law.computer.lead, precision),
        "ignored": "".join(f"    (void){name};\n" for name, _, used in checks if not used),
        "null_checks": "".join(f" || ({name} == NULL)" for name, _, used in checks if used),
        "finite_checks": "".join(
            f"    if (!finite_{record}({name})) {{\n        return FLYPEND_NOT_FINITE;\n    }}\n"
            for name, record, used in checks
            if used
        ),
        "finite": _without(parts["finite"], () if has_gains else ("gains",)),
        "zero_state": initializer(records.STATE, [0.0] * records.STATE.length, precision),
        "zero_path": initializer(records.PATH, [0.0] * records.PATH.length, precision),
        "radians": literal(math.pi / 180, precision),
        "sqrt": "sqrt" if precision == "double" else "sqrtf",
        "order": ", ".join(str(i) for i in range(made.rotors.length)),
        "baked": _baked(made),
        "latency": f"{law.computer.latency:.3g}",
        "rotor_table": _rotor_table(vehicle),
        "thrust_scale": repr(thrust_scale),
        "moment_scale": repr(moment_scale),
    }


def _baked(made: Interface) -> str:
    """What the code holds as constants, in words."""
    inertia = next(field for field in made.params.fields if field.name == "inertia")
    diagonal = "a diagonal inertia matrix" if inertia.size == 3 else "a full inertia matrix"
    text = f"the number of rotors ({made.rotors.length}), their spins, {diagonal}."
    options = made.law.options
    if made.constant:
        text += " Gains: " + ", ".join(f"{name} = {made.law.numbers[name]:.6g}" for name in made.constant) + "."
    if options:
        text += " Options: " + ", ".join(f"{name} = {value}" for name, value in options.items()) + "."
    if not reads(made.step, 2):
        text += f" All gains of the {made.law.name} law, computed for this vehicle: export again after a change of it."
    return ascii_of(text)


def _rotor_table(vehicle: Vehicle) -> str:
    lines = ["| rotor | x m | y m | spin |", "|---|---|---|---|"]
    for i, (place, spin) in enumerate(zip(vehicle.rotor_positions, vehicle.rotor_spins, strict=True)):
        lines.append(f"| {i} | {place[0]:.4g} | {place[1]:.4g} | {spin:+.0f} |")
    return "\n".join(lines)


def _without(text: str, names: tuple[str, ...]) -> str:
    """The functions in `text` but those for the records `names`, which would stand unused."""
    kept = [part for part in text.split("\n\n") if not any(f"finite_{name}(" in part for name in names)]
    return "\n\n".join(kept)


def _structs(made: Interface) -> list[str]:
    unused = unread(made.step, 0, records.STATE)
    used_to_follow = set(unread(made.follow, 1, records.STATE))
    return [
        struct(records.STATE, [name for name in unused if name in used_to_follow]),
        struct(records.REFERENCE, unread(made.step, 1, records.REFERENCE)),
        struct(records.PATH),
        struct(made.gains),
        struct(made.params),
        struct(records.WRENCH),
        struct(made.rotors),
    ]


def _vectors(made: Interface, precision: Precision) -> str:
    found = vectors.vectors(made.law, made.vehicle, vectors.COUNT, vectors.SEED, precision)
    kinds = (records.STATE, records.REFERENCE, records.WRENCH, made.rotors)
    lines = [
        "/* Random inputs, and what flypend answers in Python. */",
        "#ifndef FLYPEND_VECTORS_H",
        "#define FLYPEND_VECTORS_H",
        '#include "flypend_law.h"',
        "",
        f"#define FLYPEND_VECTOR_TOLERANCE {TOLERANCE[precision]!r}",
        "",
        "typedef struct {",
        *(f"    flypend_{record.name} {record.name};" for record in kinds),
        "} flypend_vector;",
        "",
        "static const flypend_vector flypend_vectors[] = {",
    ]
    for row in zip(found.state, found.reference, found.wrench, found.rotors, strict=True):
        parts = [initializer(record, part, precision) for record, part in zip(kinds, row, strict=True)]
        lines += ["    {" + ",\n     ".join(parts) + "},"]
    return "\n".join([*lines, "};", "#endif", ""])
