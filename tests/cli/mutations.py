"""Mutations of settings and files: in front of their digests, and behind them."""

import contextlib
import io
import json
from copy import deepcopy

import numpy as np

from flypend.files.netcdf import Variable, read_netcdf, write_netcdf
from flypend.files.schema import digest
from flypend.files.toml import toml_text
from flypend.flight import files as saved_run
from flypend.planning import files as saved_plan

NUMBERS = [
    0, -1, 1, 1e-9, 1e9, 1e30, 1e308, float("nan"), float("inf"), float("-inf"), 0.5, 1e-30, True, "x", "", [], [1.0],
    {}, 10, 100, 1e5, 1e-4, 3, 0.05, 2**62, "../../etc/passwd", "a\u0000b", "\U0001f681", [1.0, 2.0], {"x": 1.0},
]  # fmt: skip
STRANGE = [
    float("nan"), float("inf"), -1.0, 0.0, 1e300, 1e-300, 2**40, "x", "", "$\\frac$", "<b>\x00", "\ud800", [], [1.0],
    {}, None, True, [[1.0, 2.0]], 10**30,
]  # fmt: skip


# Settings -------------------------------------------------------------------------------------------------------------


def places(table, path=()):
    """Every place of a nested table, as a tuple of keys."""
    for key, value in table.items():
        yield (*path, key)
        if isinstance(value, dict):
            yield from places(value, (*path, key))


def mutated_settings(base, rng):
    """A copy of `base` with one to three entries replaced, removed, renamed or doubled in the text, as text."""
    table = deepcopy(base)
    for _ in range(rng.choice([1, 1, 2, 3])):
        *outer, last = rng.choice(list(places(table)))
        inner = table
        for key in outer:
            inner = inner[key]
        kind = rng.choice(["replace"] * 6 + ["remove", "rename"])
        if kind == "replace":
            inner[last] = deepcopy(rng.choice(NUMBERS))
        elif kind == "remove":
            del inner[last]
        else:
            inner[last + rng.choice("sx_")] = inner.pop(last)
        if not table:
            break
    text = toml_text(table)
    return mutated_text(text, rng) if rng.random() < 0.15 else text


def mutated_text(text, rng):
    """`text` with a stretch removed, doubled or replaced by characters that TOML minds."""
    a = rng.randrange(len(text) + 1)
    b = min(len(text), a + rng.randrange(1, 20))
    return text[:a] + rng.choice(["", text[a:b] * 2, rng.choice('{}[]"=#.,\x00é\n')]) + text[b:]


# In front of a digest: bytes ------------------------------------------------------------------------------------------


def mutated_bytes(content, rng, other=b""):
    """`content` with bytes changed, a stretch removed, doubled, zeroed or taken from the `other` file, or cut."""
    content = bytearray(content)
    for _ in range(rng.choice([1, 1, 2, 8])):
        if not content:
            break
        a = rng.randrange(min(len(content), rng.choice([64, 2048, len(content)])))
        b = min(len(content), a + rng.choice([1, 4, 64, 1024]))
        kind = rng.choice(["flip", "flip", "random", "zero", "remove", "double", "cut", "splice", "number"])
        if kind == "flip":
            content[a] ^= 1 << rng.randrange(8)
        elif kind == "random":
            content[a:b] = rng.randbytes(b - a)
        elif kind == "zero":
            content[a:b] = bytes(b - a)
        elif kind == "remove":
            del content[a:b]
        elif kind == "double":
            content[a:a] = content[a:b]
        elif kind == "splice":
            content[a:] = other[a:]
        elif kind == "number":  # where headers keep sizes and counts
            content[a & ~3 : (a & ~3) + 4] = rng.choice([0, 1, 3, 2**16, 2**31 - 1, 2**32 - 1]).to_bytes(4)
        else:
            del content[a:]
    return bytes(content)


# Behind a digest: what the bytes say ----------------------------------------------------------------------------------

SPOTS = [np.nan, np.inf, -np.inf, -1.0, 0.0, 1e300, 1e13, 0.5]
SCALES = [-1.0, 1 + 1e-3, 2.0, 1e200, 1e-200]
ARRAYS = {
    "spot": lambda a, rng: np.where(np.arange(a.size).reshape(a.shape) == rng.randrange(a.size), rng.choice(SPOTS), a),
    "all": lambda a, rng: np.full_like(a, rng.choice([np.nan, 0.0, 1e300, -1.0])),
    "cut": lambda a, rng: a[: rng.randrange(len(a) + 1)],
    "axis": lambda a, rng: a[..., : rng.randrange(3)],
    "flat": lambda a, _: a.ravel(),
    "turn": lambda a, _: a.T,
    "reverse": lambda a, _: a[::-1],
    "scale": lambda a, rng: a * rng.choice(SCALES),
    "grow": lambda a, _: np.repeat(a, 2, axis=0),
    "single": lambda a, _: a.astype(np.float32),
    "words": lambda a, _: np.array(["words"] * len(a)),
}


def mutated_array(values, rng):
    """An array like `values` with other numbers, another shape or another type."""
    how = rng.choice(["spot"] * 4 + list(ARRAYS))
    values = values if np.asarray(values).dtype.kind in "biuf" else np.ones(np.shape(values))  # words: mutated before
    return ARRAYS[how](np.atleast_1d(np.array(values, dtype=float)), rng) if values.size else np.ones(3)


def mutated_json(text, rng):
    """The JSON `text` with one entry replaced, removed or renamed, or a few characters changed."""
    try:
        table = {"": json.loads(text)}
    except ValueError:  # mutated before
        table = {}
    if not table or rng.random() < 0.2:
        return mutated_text(text, rng)
    *outer, last = rng.choice(list(places(table)))
    inner = table
    for key in outer:
        inner = inner[key]
    if rng.random() < 0.7 or not outer:
        inner[last] = deepcopy(rng.choice(STRANGE))
    elif rng.random() < 0.5:
        del inner[last]
    else:
        inner[rng.choice(["", "x", "name", "R", "\n"])] = inner.pop(last)
    return json.dumps(table[""])


def mutated_netcdf(content, rng, folder):
    """The NetCDF file `content` with one to three of its variables and attributes changed, and its digests renewed."""
    path = folder / "mutated.nc"
    path.write_bytes(content)
    variables, attributes = read_netcdf(path)
    variables = {name: entry for name, entry in variables.items() if entry.values.dtype.kind == "f"}
    for _ in range(rng.choice([1, 1, 2, 3])):
        (mutate_variable(variables, rng) if rng.random() < 0.5 else mutate_attribute(attributes, rng))
    renew(variables, attributes, rng)
    with contextlib.suppress(UnicodeEncodeError):  # half a character, which no file can hold
        write_netcdf(path, variables, attributes)
    return path.read_bytes()


def mutate_variable(variables, rng):
    name, other = rng.choice(list(variables)), rng.choice(list(variables))
    dims, values, about = variables[name]
    how = rng.choice(["values"] * 6 + ["remove", "rename", "unit", "dims", "swap"])
    if how == "values":
        values = mutated_array(values, rng)
        same = values.shape == variables[name].values.shape
        variables[name] = Variable(dims if same else tuple(f"{name}_{k}" for k in range(values.ndim)), values, about)
    elif how == "rename":
        variables[name + "_"] = variables.pop(name)
    elif how == "unit":
        variables[name] = Variable(dims, values, {"units": rng.choice(["km", "", 3.0])})
    elif how == "dims":
        variables[name] = Variable(dims[::-1], values, about)
    elif how == "swap":
        variables[name], variables[other] = variables[other], variables[name]
    elif len(variables) > 1:
        del variables[name]


def mutate_attribute(attributes, rng):
    name = rng.choice(list(attributes))
    given = attributes[name]
    if rng.random() < 0.2 and len(attributes) > 1:
        del attributes[name]
    elif isinstance(given, str) and given[:1] in ("[", "{") and rng.random() < 0.8:
        attributes[name] = mutated_json(given, rng)
    else:
        words = ["down", "up", "singular", "converged", "failed", "plan", "k" * 2000, 2.5]
        attributes[name] = rng.choice([*words, *(each for each in STRANGE if isinstance(each, str | float))])


def renew(variables, attributes, rng):
    """Renew the digests of a file, as one who changed it on purpose would; or drop them."""
    digests = [name for name in ("digest", "plan_digest") if name in attributes]
    for name in digests:
        del attributes[name]
    if rng.random() < 0.3:
        return
    arrays = {name: entry.values for name, entry in variables.items() if entry.values.dtype.kind == "f"}
    own = {name: arrays.pop(name) for name in saved_plan.FIELDS if name in arrays}
    about = {name: attributes[name] for name in saved_run.ATTRIBUTES if name in attributes}
    attributes["digest"] = digest({"drift": np.zeros((0, 3)), **arrays}, about)
    if "plan_digest" in digests:
        more = {name: attributes[name] for name in saved_plan.ATTRIBUTES if name in attributes}
        attributes["plan_digest"] = digest(own, more | {"digest": attributes["digest"]})


def mutated_npz(content, rng, folder):
    """The .npz file `content` with some arrays changed, removed or renamed; packed as a bomb, or mislabelled."""
    with np.load(io.BytesIO(content)) as stored:
        arrays = {name: stored[name] for name in stored.files}
    for _ in range(rng.choice([1, 1, 2, 3])):
        name = rng.choice(list(arrays))
        how = rng.choice(["values"] * 5 + ["remove", "rename", "object"])
        if how == "values" and arrays[name].dtype.kind not in "UO":
            values = mutated_array(arrays[name], rng)
            arrays[name] = values.astype(np.float32) if values.dtype == float and rng.random() < 0.7 else values
        elif how == "rename":
            arrays[name + "_"] = arrays.pop(name)
        elif how == "object":
            arrays[name] = np.array([{}], dtype=object)
        elif len(arrays) > 1:
            del arrays[name]
    path, save = folder / "mutated.npz", np.savez
    if rng.random() < 0.1:  # zeros, which pack to a thousandth
        arrays[rng.choice(list(arrays))] = np.zeros((rng.choice([10, 4000]), 5000), np.float32)
        save = np.savez_compressed
    save(path, **arrays)
    found = path.read_bytes()
    if rng.random() < 0.1:  # a shape that is not that of the numbers
        found = found.replace(b"(8, 18)", rng.choice([b"(9**9,)", b"(99999,18)", b"(-8, 18)", b"(8, 18,1)"]))
    return found
