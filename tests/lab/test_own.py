"""Laws of one's own in the laboratory: chosen by name, flown compiled or step by step, read again when they change."""

from dataclasses import replace

import numpy as np
import pytest

import flypend as fp
from flypend.errors import InputError
from flypend.flight.simulate import fly as simulate_flight
from flypend.flight.verdict import verdict
from flypend.lab.answers import answer
from flypend.lab.controls import offer, sliders
from flypend.lab.export import python, toml
from flypend.lab.flying import fly, region
from flypend.lab.own import OwnLaws
from flypend.lab.setting import setting_of
from flypend.lab.tuning import Stepped, tune_loop
from flypend.laws import LawError
from flypend.laws.learned import policy, save
from flypend.settings.runfile import run_file

TEXT = """
import numpy as np
import flypend as fp

def hold(t, state, vehicle, *, lift=1.0, brake=0.02, offset=0.0):
    return fp.Wrench(lift * vehicle.weight + offset, -brake * state.omega)

def stepped(t, state, vehicle, *, lift=1.0, brake=0.02):
    if state.x[2] > 1e3:
        return fp.Wrench(0.0, np.zeros(3))
    return fp.Wrench(lift * vehicle.weight, -brake * np.asarray(state.omega))

def down(t, state, vehicle, *, lift=1.0, brake=0.02):
    return fp.Wrench(-lift * vehicle.weight, -brake * state.omega)

hanging = fp.laws.from_function(down, e3="down", name="hanging")

def inverted(t, state, vehicle):
    return fp.Wrench(vehicle.weight, 0 * state.omega)

def climb(t, state, vehicle):
    return fp.Wrench(vehicle.weight * (1 + t), 0 * state.omega)

def climb_stepped(t, state, vehicle):
    return fp.Wrench(vehicle.weight * (2 if t > 9 else 1 + t), 0 * state.omega)
"""
NAMES = ("hold", "stepped", "hanging", "inverted")


@pytest.fixture
def own(tmp_path):
    (tmp_path / "mine.py").write_text(TEXT, encoding="utf-8")
    return OwnLaws([f"{tmp_path / 'mine.py'}:{name}" for name in NAMES])


def asked(name, plant="rotors", **more):
    start = {"y": [0.3, 0, 0.954], "omega": [0.1, 0.2, 0.3]}
    base = {"vehicle": {"base": "hehn2011"}, "plant": {"base": plant}, "start": start, "duration": 0.4, "pokes": []}
    return {**base, "law": {"name": name, "gains": more.pop("gains", {})}, **more}


def test_they_are_offered_and_one_is_the_first(own):
    assert list(own) == ["hold", "stepped", "hanging", "inverted (own)"]
    assert offer(own)["laws"] == [*fp.laws.law_names(), *own]
    assert offer(own)["first"]["law"] == {"name": "hold", "gains": {}}
    assert offer()["first"]["law"]["name"] == "inverted"


@pytest.mark.parametrize("plant", ["rotors", "ideal"])
@pytest.mark.parametrize("name", ["hold", "stepped", "hanging"])
def test_the_flight_is_the_one_that_its_exports_make(own, tmp_path, name, plant):
    setting = setting_of(asked(name, plant, gains={"lift": 1.2}), own)
    run = fly(setting)
    assert (run.law, run.gains["lift"]) == (name, 1.2)
    path, names = tmp_path / "flight.toml", {}
    path.write_text(toml(setting), encoding="utf-8")
    by_file = simulate_flight(run_file(str(path)).flight)
    exec(python(setting), names)
    for other in (by_file, names["run"]):
        assert other.gains == run.gains
        np.testing.assert_allclose(other.x[-1], run.x[-1], atol=1e-8)
    plain = fly(setting_of(asked(name, plant), own))
    assert np.max(np.abs(plain.x[-1] - run.x[-1])) > 0.01  # negative control: the gain counts


def test_compiled_and_stepped_fly_alike_with_a_poke(own):
    pokes = [{"time": 0.2, "on": "bob", "velocity": [0.5, 0, 0]}]
    runs = [fly(setting_of(asked(name, pokes=pokes), own)) for name in ("hold", "stepped")]
    np.testing.assert_allclose(runs[0].x, runs[1].x, atol=1e-9)
    np.testing.assert_allclose(runs[0].rotor_forces, runs[1].rotor_forces, atol=1e-9)
    assert not np.allclose(runs[0].x[-1], fly(setting_of(asked("hold"), own)).x[-1], atol=1e-3)


@pytest.mark.parametrize("plant", ["rotors", "ideal"])
@pytest.mark.parametrize("name", ["climb", "climb_stepped"])
def test_the_clock_of_a_law_goes_on_through_a_poke(own, tmp_path, name, plant):
    laws = OwnLaws([f"{tmp_path / 'mine.py'}:{name}"])
    nothing = [{"time": 0.2, "on": "bob", "velocity": [0, 0, 0]}]
    alone = fly(setting_of(asked(name, plant, duration=0.6), laws))
    struck = fly(setting_of(asked(name, plant, pokes=nothing), laws))
    np.testing.assert_allclose(struck.t[[0, -1]], alone.t[[0, -1]], atol=1e-12)
    np.testing.assert_allclose(struck.final.x, alone.final.x, atol=1e-6)
    np.testing.assert_allclose(struck.thrust[-1], alone.thrust[-1], atol=1e-6)


def test_gains_have_sliders_with_their_names(own):
    found = {s["path"]: s for s in sliders(setting_of(asked("hold"), own)) if s["group"] == "gains"}
    assert list(found) == ["law.gains.lift", "law.gains.brake", "law.gains.offset"]
    assert (found["law.gains.lift"]["low"], found["law.gains.lift"]["high"]) == (0.25, 4.0)
    assert found["law.gains.lift"]["log"]
    assert not found["law.gains.offset"]["log"]  # no logarithm of 0
    assert found["law.gains.offset"]["low"] < 0 < found["law.gains.offset"]["high"]


def test_what_is_not_symbolic_is_mapped_a_few_rods_at_a_time(own):
    setting = setting_of(asked("stepped"), own)
    assert isinstance(tune_loop(setting), Stepped)
    chunk = next(region(setting))
    assert (chunk["total"], chunk["done"], len(chunk["y"])) == (96, 2, 2)
    assert verdict(fly(setting))["good"] is False


def test_a_file_that_changes_is_flown_as_it_stands(own, tmp_path):
    before = fly(setting_of(asked("hold"), own))
    path = tmp_path / "mine.py"
    path.write_text(TEXT.replace("lift * vehicle.weight + offset", "2 * lift * vehicle.weight"), encoding="utf-8")
    after = fly(setting_of(asked("hold"), own))
    assert after.x[-1, 2] > before.x[-1, 2] + 0.1
    path.write_text(TEXT.replace("return fp.Wrench(lift", "return fp.Wrench(lifted"), encoding="utf-8")
    with pytest.raises(LawError, match=r"mine\.py:6: NameError: name 'lifted' is not defined"):
        setting_of(asked("hold"), own)
    (reply,) = answer({"kind": "fly", "number": 1, "setting": asked("hold")}, own)
    assert (reply["kind"], reply["number"]) == ("error", 1)
    assert "mine.py:6: NameError" in reply["message"]


def test_a_policy_whose_file_changes_is_read_again(tmp_path):
    path = tmp_path / "mine.npz"
    learned = policy("hehn2011")
    save(learned, path)
    own = OwnLaws([str(path)])
    (name,) = own
    before = own[name]
    assert own[name] is before
    save(replace(learned, W_3=2 * learned.W_3), path)
    assert own[name] is not before


@pytest.mark.parametrize(
    ("law", "field"),
    [
        ("mine.py:hold", "law"),
        ({"name": "mine.py:hold"}, "law.name"),
        ({"function": "mine.py:hold"}, "law.function"),
        ({"name": "hold", "e3": "down"}, "law.e3"),
        ({"name": "hold", "gains": {"lif": 1}}, "law.gains.lif"),
        ({"name": "hold", "gains": {"lift": "x"}}, "law.gains.lift"),
        ({"name": "hold", "gains": {"lift": 1e9}}, "law.gains.lift"),
        ({"name": "hold", "gains": 3}, "law.gains"),
        ({"name": "none"}, "law.name"),
        ({}, "law.name"),
    ],
)
def test_a_page_runs_no_file_that_was_not_offered(own, tmp_path, monkeypatch, law, field):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError) as caught:
        setting_of({**asked("hold"), "law": law}, own)
    assert caught.value.field == field


def test_a_law_that_is_none_is_told_before_anything_is_served(tmp_path):
    from flypend.lab.server import serve

    with pytest.raises(InputError, match="a file that is there"):
        serve(laws=[str(tmp_path / "none.py:f")], browser=False, announce=lambda _: pytest.fail("served"))
