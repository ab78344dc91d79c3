"""Every public callable, each argument in turn of a wrong type, misspelt or missing: it works or raises InputError."""

import importlib
import inspect

import numpy as np
import pytest

import flypend as fp
from flypend.compile.llvm import jit
from flypend.errors import named_arguments
from flypend.laws.own import from_function

VEHICLE, START = fp.vehicle("hehn2011"), fp.State(y=(0, 0, 1.0))
STARTS = fp.random_starts(2, seed=1)
LAW = fp.laws.inverted()
WRONG = [3, "x", None, [], object()]
# A right value of each argument that has no default, by name: never flown, since an engine that is reached ends a call.
RIGHT = {
    "vehicle": VEHICLE, "law": LAW, "laws": [LAW], "start": START, "starts": STARTS, "duration": 1.0, "runs": 2,
    "seed": 1, "name": "hehn2011", "mass": 0.1, "length": 0.5, "rod_mass": 0.1, "bob_mass": 0.1, "thrust": 1.0,
    "moment": (0, 0, 0), "y": (0, 0, 1.0), "e3": "up", "rate": 100.0, "default": 1.0,
    "function": lambda t, state: fp.Wrench(5.0, (0, 0, 0)),
    "control": lambda t, state, vehicle, gains: fp.Wrench(vehicle.weight, 0 * state.omega),
}  # fmt: skip


class ReachedError(Exception):
    """The arguments have passed every check, and the work would begin."""


@pytest.fixture(autouse=True)
def no_work(tmp_path, monkeypatch):
    """Nothing is flown, planned, compiled or exported; files are written to an empty folder."""

    def reached(*_args, **_more):
        raise ReachedError

    monkeypatch.chdir(tmp_path)
    for place in (
        "flypend.flight.simulate.fly", "flypend.flight.ensemble.fly_many", "flypend.studies.compare.fly_each",
        "flypend.planning.planner.prepare", "flypend.studies.check.fly_tasks",
        "flypend.studies.sweep.run.fly_range", "flypend.studies.tune.program_digest", "flypend.studies.trial.fly_many",
    ):  # fmt: skip
        module, _, name = place.rpartition(".")
        monkeypatch.setattr(importlib.import_module(module), name, reached)  # functions hide modules of their name
    monkeypatch.setattr(jit.Native, "__call__", reached)


def callables():
    for name in fp.__all__:
        found = getattr(fp, name)
        if callable(found) and name != "InputError":
            yield pytest.param(found, id=name)
    for name in fp.laws.__all__:
        found = getattr(fp.laws, name)
        if inspect.isfunction(found):
            yield pytest.param(found, id=f"laws.{name}")


TARGETS = list(callables())


def known(target):
    parameters = inspect.signature(target).parameters.values()
    return [p for p in parameters if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]


def attempt(target, given):
    """Return the error of a call, InputError or that work was reached; None if it works."""
    try:
        target(**given)
    except (fp.InputError, ReachedError) as error:
        return error
    return None


def right(target):
    return {p.name: RIGHT[p.name] for p in known(target) if p.default is p.empty and p.name in RIGHT}


@pytest.mark.parametrize("target", TARGETS)
def test_an_argument_of_a_wrong_type_works_or_is_an_input_error(target):
    for parameter in known(target):
        for wrong in WRONG:
            error = attempt(target, {**right(target), parameter.name: wrong})
            assert "\n" not in str(error)


@pytest.mark.parametrize("target", TARGETS)
def test_a_misspelt_argument_names_the_nearest(target):
    if any(p.kind is p.VAR_KEYWORD for p in inspect.signature(target).parameters.values()):
        return
    for parameter in known(target):
        if parameter.kind is parameter.POSITIONAL_ONLY:
            continue
        name = f"{parameter.name}q"
        error = attempt(target, {**right(target), name: 1})
        assert isinstance(error, fp.InputError)
        assert f"did you mean {parameter.name!r}?" in str(error)


@pytest.mark.parametrize("target", TARGETS)
def test_a_missing_argument_is_told_with_what_it_is(target):
    needed = [p.name for p in known(target) if p.default is p.empty]
    for name in needed:
        given = {other: RIGHT.get(other, 1.0) for other in needed if other != name}
        error = attempt(target, given)
        assert isinstance(error, fp.InputError)


@pytest.mark.parametrize("target", TARGETS)
def test_too_many_arguments_are_an_input_error(target):
    if any(p.kind is p.VAR_POSITIONAL for p in inspect.signature(target).parameters.values()):
        return
    with pytest.raises(fp.InputError):
        target(*[3] * 40)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: fp.simulate("hehn2011", LAW, START, 1.0), r"^vehicle: .* fp\.vehicle\('hehn2011'\)"),
        (lambda: fp.simulate(VEHICLE, "inverted", START, 1.0), r"^law: expected a Law .*fp\.laws\.inverted\(\)"),
        (lambda: fp.simulate(VEHICLE, LAW, START, 1.0, plnt="ideal"), r"^simulate\.plnt: .*did you mean 'plant'\?"),
        (lambda: fp.simulate(VEHICLE, LAW, START), r"^simulate\.duration: expected a number: flight time, s"),
        (lambda: fp.metrics(3), r"^run: expected a Trajectory"),
        (lambda: fp.track(3), r"^plan: expected a Plan"),
        (lambda: fp.compare(VEHICLE, [], STARTS), r"^laws: expected a law, or several, got none"),
        (lambda: fp.compare(VEHICLE, [3], STARTS), r"^law: expected a Law"),
        (lambda: fp.compare(VEHICLE, LAW, START), r"^starts: .*got a single state"),
        (lambda: fp.compare(VEHICLE, LAW, STARTS, 1e-4), r"^duration: expected at least 1 s"),
        (lambda: fp.simulate_ensemble(VEHICLE, LAW, STARTS, 1, judge_period=2), r"^judge_period: .* duration, 1 s"),
        (lambda: fp.Wrench(-0.02 * START.omega, VEHICLE.weight), r"^wrench\.moment: expected three numbers"),
        (lambda: fp.Wrench("x", (0, 0, 0)), r"^wrench\.thrust: expected real numbers"),
        (lambda: fp.Wrench(1j, (0, 0, 0)), r"^wrench\.thrust: expected real numbers"),
        (lambda: fp.Wrench((1, 2, 3), (0, 0, 0)), r"^wrench\.thrust: expected one number, N, got shape \(3,\)"),
        (lambda: fp.plan(VEHICLE, START, floor=1, ceiling=0), r"^floor: expected a height below the ceiling"),
        (lambda: fp.plan(VEHICLE, START, lean=7), r"^lean: expected at most 3\.14 rad \(180°\), got 7 rad \(401\.1°\)"),
        (lambda: fp.vehicle(3), r"^name: expected a path|^vehicle: expected one of"),
        (lambda: fp.sweep({}, "s.zarr", scheduler="tcp://a:1", workers=2), r"^workers: .* beside a scheduler"),
    ],
)  # fmt: skip
def test_what_users_mistake_is_told(call, message):
    with pytest.raises(fp.InputError, match=message) as caught:
        call()
    assert "\n" not in str(caught.value)


def test_one_law_is_compared_as_a_list_of_one(monkeypatch):
    monkeypatch.setattr(
        importlib.import_module("flypend.studies.compare"), "fly_each", lambda flights, *_: dict.fromkeys(flights)
    )
    assert list(fp.compare(VEHICLE, LAW, STARTS).ensembles) == ["inverted"]


def test_methods_of_records_are_checked_too(monkeypatch):
    monkeypatch.undo()
    run = fp.simulate(VEHICLE, fp.laws.lqr(), START, 0.05)
    for call, field in (
        (lambda: run.save(3), "path"),
        (lambda: run.save(), "save.path"),
        (lambda: run.to_html(3), "path"),
        (lambda: run.to_html("a.html", titel="x"), "to_html.titel"),
        (lambda: LAW.bind(3), "vehicle"),
    ):
        with pytest.raises(fp.InputError) as caught:
            call()
        assert caught.value.field == field


def test_a_record_is_checked_before_the_call_even_if_nothing_would_fail():
    @named_arguments
    def nothing(vehicle: fp.Vehicle) -> None:
        """Take a vehicle, and leave it alone."""

    for call in (lambda: nothing(3), lambda: nothing(vehicle=3)):
        with pytest.raises(fp.InputError, match=r"^vehicle: "):
            call()


@pytest.mark.parametrize("name", [{"x": 1.0}, 3, None])
def test_a_name_is_a_word(name):
    """A table [name] in a vehicle's file was taken, and ended in a traceback."""
    with pytest.raises(fp.InputError, match=r"^vehicle\.name: "):
        fp.Vehicle.from_dict(VEHICLE.to_dict() | {"name": name})


def test_an_error_of_our_own_stays_what_it_is(monkeypatch):
    """Negative control: a right call that fails inside is no bad input."""

    def broken(*_args, **_more):
        raise TypeError("ours")

    monkeypatch.setattr(importlib.import_module("flypend.flight.simulate"), "fly", broken)
    with pytest.raises(TypeError, match="ours"):
        fp.simulate(VEHICLE, LAW, START, 1.0)


def test_numbers_of_numpy_are_numbers():
    """Kinds are checked after a failure only: what works with NumPy's numbers goes on working."""
    assert fp.Criterion(hold=np.float32(0.5)).hold == 0.5
    assert len(fp.random_starts(np.int64(2), np.int32(1))) == 2
    assert from_function(RIGHT["control"]).name == "<lambda>"
