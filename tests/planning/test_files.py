"""Plans in files: every number comes back, a loaded plan flies as the plan did, and what is no plan is refused."""

import dataclasses
import json

import numpy as np
import pytest
import xarray

import flypend as fp
from flypend.files.netcdf import read_netcdf, write_netcdf
from flypend.laws.references import circle, sample

HEHN = fp.vehicle("hehn2011")
START = fp.State(x=(-1.0, 0.0, 0.0), y=(0, 0, 1))
WINDOW = fp.Window((-0.4, 0.1, 0.2), 0.9, 1.4, normal=(1, 0.2, 0), depth=0.02)


@pytest.fixture(scope="module")
def plan():
    return fp.plan(HEHN, START, {"effort": 1.0}, window=WINDOW, target=(0.5, 0, 0), time_limit=120.0)


@pytest.fixture
def saved(plan, tmp_path):
    plan.save(tmp_path / "plan.nc")
    return tmp_path / "plan.nc"


def fields(plan):
    return [field.name for field in dataclasses.fields(plan) if field.name not in ("path", "windows")]


def same(one, other):
    """Compare every field of two plans bit by bit, and their windows."""
    for name in fields(one):
        a, b = getattr(one, name), getattr(other, name)
        if isinstance(a, np.ndarray):
            assert (a.dtype, a.shape) == (b.dtype, b.shape)
            assert a.tobytes() == b.tobytes(), name
        else:
            assert a == b, name
    for a, b in zip(one.windows, other.windows, strict=True):
        for field in dataclasses.fields(a):
            np.testing.assert_array_equal(getattr(a, field.name), getattr(b, field.name))


def test_a_plan_comes_back_with_every_bit(plan, saved, tmp_path):
    loaded = fp.load_plan(str(saved))
    assert plan.status in ("converged", "feasible")
    same(plan, loaded)
    assert (loaded.path is None, repr(loaded), loaded.excursion) == (True, repr(plan), plan.excursion)
    loaded.save(tmp_path / "again.nc")
    assert (tmp_path / "again.nc").read_bytes() == saved.read_bytes()


def test_a_loaded_plan_is_flown_as_the_plan(plan, saved):
    first, second = (fp.simulate(HEHN, fp.track(each), START, 2.0) for each in (plan, fp.load_plan(saved)))
    assert first.packed.tobytes() == second.packed.tobytes()
    np.testing.assert_array_equal(first.x_ref, second.x_ref)


def test_the_file_of_a_plan_is_that_of_its_flight(plan, saved):
    run = fp.load(saved)
    assert (run.law, run.packed.tobytes()) == ("plan", plan.packed.tobytes())
    with xarray.open_dataset(saved, engine="scipy") as data:
        np.testing.assert_array_equal(data["commands"], plan.commands)
        assert data["commands"].attrs["units"] == "N"


def test_a_failed_plan_is_saved_too(tmp_path):
    failed = fp.plan(HEHN, fp.State(y=(0, 0, -1)), duration=0.3)
    assert failed.status == "failed"
    failed.save(tmp_path / "plan.nc")
    same(failed, fp.load_plan(tmp_path / "plan.nc"))


def test_a_path_is_kept_at_its_samples(tmp_path):
    path = circle(0.3, 2.0, (0.1, 0, 0.2))
    plan = fp.plan(HEHN, fp.State(x=(0.4, 0, 0.2), y=(0, 0, 1)), duration=3.0, path=path, time_limit=120.0)
    plan.save(tmp_path / "plan.nc")
    loaded = fp.load_plan(tmp_path / "plan.nc")
    same(plan, loaded)
    np.testing.assert_array_equal(loaded.x_ref, plan.x_ref)
    assert loaded.excursion == plan.excursion
    between = (plan.t[1:] + plan.t[:-1]) / 2
    h = plan.t[1]
    # Chords of a circle: r (1 − cos(ω h/2)).
    np.testing.assert_allclose(
        sample(loaded.reference, between), sample(path, between), atol=1.01 * 0.3 * (1 - np.cos(2.0 * h / 2))
    )
    far = np.array([plan.duration, plan.duration + 5.0])
    np.testing.assert_array_equal(sample(loaded.reference, far), np.tile(plan.x_ref[-1], (2, 1)))
    np.testing.assert_array_equal(sample(loaded.path, np.array([-1.0])), plan.x_ref[:1])
    loaded.save(tmp_path / "again.nc")
    same(loaded, fp.load_plan(tmp_path / "again.nc"))


def test_a_run_is_no_plan_and_says_so(tmp_path):
    fp.simulate(HEHN, fp.laws.lqr(), START, 0.1).save(tmp_path / "run.nc")
    with pytest.raises(fp.InputError, match=r"run\.nc: expected a plan saved by flypend, got a run: no objective"):
        fp.load_plan(tmp_path / "run.nc")


@pytest.mark.parametrize(
    ("harm", "field"),
    [
        ({"commands": lambda plan: plan.commands[:-1]}, "commands"),
        ({"commands": lambda plan: plan.commands[:, :3]}, "commands"),
        ({"commands": lambda plan: plan.commands + 5.0}, "rotor_forces"),
        ({"commands": lambda plan: plan.commands * np.nan}, "commands"),
        ({"target": lambda plan: np.array([0.5, 0.0])}, "target"),
        ({"stage": lambda plan: 2 * plan.stage}, "t"),
        ({"stage": lambda plan: -plan.stage}, "stage"),
        ({"t": lambda plan: plan.t[::-1].copy()}, "t"),
        ({"status": lambda plan: "perfect"}, "status"),
        ({"iterations": lambda plan: 2.5}, "iterations"),
        ({"guess": lambda plan: float("inf")}, "guess"),
        ({"solve_time": lambda plan: -1.0}, "solve_time"),
        ({"objective": lambda plan: {"effort": float("nan")}}, "objective"),
        ({"reason": lambda plan: 3}, "reason"),
        ({"packed": lambda plan: 2 * plan.packed}, "R"),
        ({"rotor_forces": lambda plan: plan.rotor_forces[:, :3]}, "rotor_forces"),
    ],
)
def test_what_could_not_be_loaded_is_not_written(harm, field, plan, tmp_path):
    """The same check is made of what is written and of what was read; a word is checked at once."""
    with pytest.raises(fp.InputError) as caught:
        dataclasses.replace(plan, **{name: change(plan) for name, change in harm.items()}).save(tmp_path / "plan.nc")
    assert not list(tmp_path.iterdir())
    assert caught.value.field.startswith(field)


@pytest.mark.parametrize("name", ["objective", "windows", "vehicle", "gains"])
@pytest.mark.parametrize(
    "text", ["{", "3", '{"a": NaN}', '{"a": 1e999}', '[{"centre": 1}]', "[" * 100_000, '"\\ud800"']
)
def test_json_that_means_nothing_is_one_line(name, text, saved, tmp_path):
    variables, attributes = read_netcdf(saved)
    numbers = {key: value for key, value in variables.items() if value.values.dtype.kind == "f"}
    del attributes["digest"], attributes["plan_digest"]
    write_netcdf(tmp_path / "bad.nc", numbers, attributes)
    fp.load_plan(tmp_path / "bad.nc")  # without digests it is checked, and accepted
    assert json.loads(attributes[name]) is not None
    write_netcdf(tmp_path / "bad.nc", numbers, attributes | {name: text})
    with pytest.raises(fp.InputError, match=rf"expected a (plan|run) saved by flypend, got a damaged one \({name}"):
        fp.load_plan(tmp_path / "bad.nc")
