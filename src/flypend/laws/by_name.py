"""The built-in laws by name, and laws from TOML tables."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Any

from flypend import errors
from flypend.laws import references
from flypend.laws.almost_global import almost_global
from flypend.laws.inverted import inverted
from flypend.laws.law import Law
from flypend.laws.learned import learned
from flypend.laws.lqr import lqr
from flypend.laws.references import Reference
from flypend.laws.repaired import repaired
from flypend.laws.theorem1 import corrected, printed

FACTORIES: Mapping[str, Callable[..., Law]] = {
    "printed": printed,
    "corrected": corrected,
    "repaired": repaired,
    "almost_global": almost_global,
    "inverted": inverted,
    "lqr": lqr,
    "learned": learned,
}
# The laws of the paper's theorem: they accept its gains, bring the rod to their e₃ and control no position.
THEOREM_1 = ("printed", "corrected", "repaired")
SHAPES: Mapping[str, Callable[..., Reference]] = {
    shape.__name__: shape for shape in (references.hover, references.line, references.circle, references.lemniscate)
}


@errors.named_arguments
def law_names() -> list[str]:
    """Return the names of the built-in laws."""
    return list(FACTORIES)


@errors.named_arguments
def law_from_dict(values: Mapping[str, Any], key: str = "law") -> Law:
    """Build a law from a TOML table `values`, {name, gains = {...}, reference = {...}}; messages begin with `key`.

    A reference has a `shape` (hover, line, circle, lemniscate) and the arguments of that function in `laws.references`.

    Raises InputError if a law or gain is unknown (naming the closest match) or a gain is out of bounds.
    """
    errors.only_known(key, values, ("name", "gains", "reference"))
    name = errors.one_of(f"{key}.name", values.get("name"), FACTORIES)
    gains = values.get("gains", {})
    if not isinstance(gains, Mapping):
        raise errors.InputError(f"{key}.gains", "a table of gains", repr(gains))
    extra = {}
    if "reference" in values:
        if not follows(name):
            raise errors.InputError(f"{key}.reference", "nothing: the law has none", repr(values["reference"]))
        extra["reference"] = _reference(values["reference"], f"{key}.reference")
    return FACTORIES[name](**extra).with_gains(gains, f"{key}.gains")


def follows(name: str) -> bool:
    """Whether the built-in law `name` follows a reference."""
    return "reference" in inspect.signature(FACTORIES[name]).parameters


def _reference(values: Any, key: str) -> Reference:
    if not isinstance(values, Mapping):
        raise errors.InputError(key, "a table with a shape", repr(values))
    arguments = dict(values)
    shape = SHAPES[errors.one_of(f"{key}.shape", arguments.pop("shape", None), SHAPES)]
    errors.only_known(key, arguments, inspect.signature(shape).parameters)
    return shape(**arguments)
