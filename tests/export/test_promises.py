"""Every function of the exported headers keeps what its comment promises: the test reads signatures and comments."""

import ctypes
import re
from dataclasses import dataclass

import numpy as np
import pytest
from cbuild import build

import flypend as fp
from flypend.export import records
from flypend.export.interface import interface
from flypend.plants import SUITES

VEHICLE = fp.vehicle("hehn2011")
LAW = fp.laws.inverted().bind(VEHICLE)
HEADERS = ("flypend_law.h", "flypend_sensors.h")
MEMORIES = ("flypend_board", "flypend_sensors")
FUNCTION = re.compile(r"/\*((?:(?!\*/).)*)\*/\s*flypend_status (\w+)\(([^;]*)\);", re.DOTALL)
STRUCT = re.compile(r"typedef struct \{((?:(?!\}).)*)\} (\w+);", re.DOTALL)


@dataclass(frozen=True)
class Promise:
    """A function of a header: its comment, its arguments (type, name, whether it is an input) and its statuses."""

    name: str
    text: str
    arguments: tuple[tuple[str, str, bool], ...]
    statuses: frozenset[str]


class Exported:
    """The headers and the compiled code of one export."""

    def __init__(self, folder, precision):
        fp.export_c(LAW, VEHICLE, folder, precision=precision, sensors="mocap", check=False)
        sources = ("flypend_law.c", "flypend_sensors.c")
        self.c = ctypes.CDLL(str(build(folder, sources, "law.so", flags=("-shared", "-fPIC"))))
        self.real = np.float64 if precision == "double" else np.float32
        text = "\n".join((folder / name).read_text() for name in HEADERS)
        sizes = {name: int(value) for name, value in re.findall(r"#define (\w+) (\d+)\n", text)}
        self.statuses = dict(re.findall(r"FLYPEND_(\w+) = (\d+)", text))
        self.names = {int(value): name for name, value in self.statuses.items()}
        self.functions = [_promise(*found) for found in FUNCTION.findall(text)]
        assert len(self.functions) == text.count("flypend_status flypend_")
        self.lengths = {}
        for body, name in STRUCT.findall(text):
            fields = re.findall(r"flypend_real \w+(?:\[(\w+)\])?;", body)
            self.lengths[name] = sum(sizes.get(size) or int(size or 1) for size in fields)
        self.kept = self.good()

    def good(self):
        """Arguments by type that every function answers with FLYPEND_OK: arrays of reals, or of bytes of a memory."""
        packed = fp.State(y=(0.28, 0, 0.96), x=(0.1, 0.2, 0.3), omega=(0.1, 0, 0.2)).packed()
        made = interface(LAW, VEHICLE, 500.0, SUITES["mocap"])
        hover = np.zeros(records.REFERENCE.length)
        hover[17] = VEHICLE.l
        values = {
            "measurement": packed, "state": np.append(packed, np.zeros(6)), "reference": hover,
            "path": np.zeros(records.PATH.length), "params": records.params_of(VEHICLE),
            "gains": [LAW.numbers[field.name] for field in made.gains.fields],
            "wrench": [VEHICLE.weight, 0.01, -0.01, 0.001], "rotors": np.full(4, VEHICLE.weight / 4),
            "readings": [
                *packed[:3], 0, *packed[6:15], 0, *packed[18:21], 0, *packed[15:18], 0, 0, 0, VEHICLE.g, 0
            ],
        }  # fmt: skip
        found = {f"flypend_{name}": np.array(value, self.real) for name, value in values.items()}
        for name, value in found.items():
            assert len(value) == self.lengths[name], name
        for name, extra in (("board", ()), ("sensors", ("state",))):
            memory = np.zeros(8 + (len(values["gains"]) + 8000) * self.real().itemsize, np.uint8)  # more than it takes
            inputs = [found[f"flypend_{kind}"] for kind in ("gains", "params", *extra)]
            assert self.call(f"flypend_{name}_begin", [memory, *inputs]) == "OK"
            found[f"flypend_{name}"] = memory
        return found

    def call(self, name, arguments):
        """The name of the status of a function for arrays, numbers, or None for a null pointer."""
        real = ctypes.c_double if self.real == np.float64 else ctypes.c_float
        given = [
            ctypes.c_void_p(None)
            if a is None
            else ctypes.c_void_p(a.ctypes.data)
            if isinstance(a, np.ndarray)
            else real(a)
            for a in arguments
        ]
        return self.names[getattr(self.c, name)(*given)]


def _promise(comment, name, arguments):
    text = " ".join(comment.replace("\n *", " ").split())
    statuses = re.search(r"Returns ((?:\w+, )*\w+)\.", text)
    assert statuses, f"{name} does not say what it returns"
    taken = []
    for argument in arguments.split(","):
        kind, identifier = re.fullmatch(r"\s*(?:const )?(\w+) \*?(\w+)\s*", argument).groups()
        taken.append((kind, identifier, "const" in argument or "*" not in argument))
    return Promise(name, text, tuple(taken), frozenset(statuses[1].split(", ")))


@pytest.fixture(scope="module", params=["double", "float"])
def exported(request, tmp_path_factory):
    return Exported(tmp_path_factory.mktemp("promises"), request.param)


def wrong_inputs(promise, good, real):
    """Arguments with one thing wrong, and the status that they shall have; None for whichever the header lists."""
    for i, (kind, name, is_input) in enumerate(promise.arguments):
        if kind != "flypend_real":
            yield replaced(good, i, None), "OK" if f"`{name}` may be null:" in promise.text else "NULL"
        if kind in MEMORIES:
            if "NOT_BEGUN" in promise.statuses:
                for place in (0, 4, 30, 200):
                    damaged = good[i].copy()
                    damaged[place] ^= 4
                    yield replaced(good, i, damaged), "NOT_BEGUN"
                yield replaced(good, i, np.zeros_like(good[i])), "NOT_BEGUN"
        elif is_input:
            yield from wrong_numbers(good, i, real)


def wrong_numbers(good, i, real):
    """The same with numbers of argument `i` replaced."""
    largest = float(np.finfo(real).max)
    places = [None] if np.isscalar(good[i]) else range(len(good[i]))
    for place in places:
        for value in (np.nan, np.inf, -np.inf):
            yield replaced(good, i, value, place), "NOT_FINITE"
        own = good[i] if place is None else good[i][place]
        for value in (0.0, -1.0, largest, -largest, -own):
            yield replaced(good, i, value, place), None
    if places != [None]:
        for sign in (1, -1):
            yield replaced(good, i, np.full_like(good[i], sign * largest)), None


def replaced(good, i, value, place=None):
    """The arguments `good`, copied, with argument `i`, or its number at a `place`, replaced by `value`."""
    arguments = [a.copy() if isinstance(a, np.ndarray) else a for a in good]
    if place is None:
        arguments[i] = value
    else:
        arguments[i][place] = value
    return arguments


def check_memory(exported, promise, status, kind, was, now):
    """What is left of the memory, a `kind` of struct, of a function that answered with a `status`."""
    if status != "OK" and re.search(r"but FLYPEND_OK the \w+ has not begun", promise.text):
        given = ("measurement" if kind == "flypend_board" else "readings", "path", "params")
        step = [now, *(exported.kept[f"flypend_{name}"] for name in given), np.zeros(4, exported.real)]
        assert exported.call(f"{kind}_step", step) == "NOT_BEGUN"
    if status != "OK" and "as it was" in promise.text:
        np.testing.assert_array_equal(now, was)


def check_answer(promise, status, was, now):
    """What the comment says of the answer of a refusal."""
    assert np.all(np.isfinite(now)), (promise.name, status)
    if status != "OK" and "`estimate` is as it was" in promise.text:
        np.testing.assert_array_equal(now, was)
    unusable = status in ("PARAMS", "WRONG_VEHICLE")
    if (status != "OK" and "comes with zeros" in promise.text) or (unusable and "0 if the parameters" in promise.text):
        assert not np.any(now)


def check_forces(promise, status, params, forces):
    """Rotor forces are within the limits of usable `params`, and the least where the comment says so."""
    low, high = params[7], params[8]
    assert np.all((forces >= low * (1 - 1e-6)) & (forces * (1 - 1e-6) <= high)), (promise.name, status)
    if status != "OK" and "least force, 0 if" in promise.text:
        assert np.all(forces == low)


def check_hover(reference, params):
    """The reference is hover at the origin with the rod upright."""
    wanted = np.zeros(len(reference))
    wanted[17] = params[2]
    np.testing.assert_array_equal(reference, wanted)


def check_outputs(exported, promise, status, before, after):
    """What is left behind with a `status` is what the comment says."""
    given = {kind: values for (kind, _, _), values in zip(promise.arguments, after, strict=True)}
    usable = given.get("flypend_params") is not None and status not in ("PARAMS", "WRONG_VEHICLE")
    usable = usable and np.all(np.isfinite(given["flypend_params"]))
    for (kind, _, is_input), was, now in zip(promise.arguments, before, after, strict=True):
        if is_input or now is None:
            continue
        if kind in MEMORIES:
            check_memory(exported, promise, status, kind, was, now)
            continue
        check_answer(promise, status, was, now)
        if kind == "flypend_rotors" and usable:
            check_forces(promise, status, given["flypend_params"], now)
        if status != "OK" and usable and "comes with hover at the origin" in promise.text:
            check_hover(now, given["flypend_params"])


def test_every_function_returns_what_its_header_lists_and_leaves_what_it_promises(exported):
    for promise in exported.functions:
        good = [exported.kept[kind] if kind != "flypend_real" else 1.5 for kind, _, _ in promise.arguments]
        seen = {exported.call(promise.name, replaced(good, 0, good[0].copy()))}
        assert seen == {"OK"}, promise.name
        for arguments, wanted in wrong_inputs(promise, good, exported.real):
            before = [a.copy() if isinstance(a, np.ndarray) else a for a in arguments]
            status = exported.call(promise.name, arguments)
            assert status == (wanted or status), (promise.name, status)
            assert status in promise.statuses, (promise.name, status)
            check_outputs(exported, promise, status, before, arguments)
            seen.add(status)
        assert seen == promise.statuses, promise.name


def test_no_lead_between_forces_that_overflow_is_a_number(exported):
    """0 · (max − −max) is 0 · ∞: found by the fuzzer."""
    most, command = np.full(4, np.finfo(exported.real).max, exported.real), np.zeros(4, exported.real)
    status = exported.call("flypend_lead", [most, -most, 0.0, exported.kept["flypend_params"], command])
    assert status == "NOT_FINITE"
    assert np.all(np.isfinite(command))
