"""`flypend check`: what it writes, what it refuses, and what its exit code says."""

import json
from importlib import import_module

import numpy as np
import pytest

import flypend as fp
from flypend.cli.options import plant_asked
from flypend.files.toml import toml_text
from flypend.settings.runfile import plant_of

QUICK = ("--runs", "16", "--no-margins", "--no-figures")

pytestmark = pytest.mark.usefixtures("one_plan")


def written(folder, **changes):
    """A TOML file of hehn2011 with `changes`."""
    path = folder / "mine.toml"
    path.write_text(toml_text({**fp.vehicle("hehn2011").to_dict(), "name": "mine", **changes}), encoding="utf-8")
    return str(path)


def test_a_vehicle_that_flies_exits_with_0_and_leaves_a_report(call, tmp_path):
    code, out, said = call("check", "hehn2011", *QUICK, "-o", "found")
    assert (code, said) == (0, "")
    assert "hehn2011 on a gimbal can be flown by inverted: lean all" in out
    assert {path.name for path in (tmp_path / "found").iterdir()} == {"report.md", "report.json"}
    told = json.loads((tmp_path / "found" / "report.json").read_text(encoding="utf-8"))
    found = fp.check(fp.vehicle("hehn2011"), runs=16, margins=False)
    assert told["checks"]["inverted"]["tasks"]["random"]["successes"] == int(found.tasks["random"].success.sum())
    assert told["settings"]["plant"] == "rotors"


def test_vehicles_drawn_from_bands_are_flown_by_check_and_compare(call, tmp_path):
    mine = written(tmp_path, bands={"mass": [0.49, 0.51], "delay": [0.0, 0.01]})
    code, out, _ = call("check", mine, "--bands", *QUICK)
    assert code == 0
    assert "random all, drawn all." in " ".join(out.split())
    report = (tmp_path / "check-out" / "report.md").read_text(encoding="utf-8")
    assert "- drawn: as random, with vehicles drawn from the bands of this one" in report
    asked = ("--law", "lqr", "--runs", "9", "--duration", "1", "--bands")
    assert call("compare", "--vehicle", mine, *asked, "-o", "compared")[0] == 0
    failed = [path.read_text(encoding="utf-8") for path in (tmp_path / "compared" / "failed").iterdir()]
    assert len({line for text in failed for line in text.splitlines() if line.startswith("delay")}) > 1
    assert json.loads((tmp_path / "compared" / "report.json").read_text(encoding="utf-8"))["settings"]["bands"] is True


def test_advice_is_printed_and_written(call, tmp_path):
    code, out, _ = call("check", written(tmp_path), "--advise", "--law", "inverted", "--law", "lqr", *QUICK)
    assert code == 0
    said = "best: inverted. inverted: 16 of 16"
    assert said in " ".join(out.split())
    assert said in (tmp_path / "check-out" / "report.md").read_text(encoding="utf-8")
    told = json.loads((tmp_path / "check-out" / "report.json").read_text(encoding="utf-8"))
    assert told["advice"]["law"] == "inverted"


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"mass": 5.0, "bob_mass": 0.5}, ["the weight is 53.96 N with mass 5 kg + bob_mass 0.5 kg (not g)"]),
        ({"gravity": 0.0}, ["without gravity no pose of the rod is upright"]),
        ({"rotor_lag": 0.5}, ["rotor lag and delay of 500 ms are too long", "the inverted law refuses the vehicle"]),
    ],
)
def test_a_vehicle_that_cannot_exits_with_1_and_the_reason(call, tmp_path, changes, words):
    code, out, _ = call("check", written(tmp_path, **changes), *QUICK)
    assert code == 1
    report = (tmp_path / "check-out" / "report.md").read_text(encoding="utf-8")
    assert all(one in " ".join(out.split()) and one in report for one in words)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"rotor_limits": [0.0, 0.0]}, "rotor_limits: expected 0 <= least < largest force in N, got [0.0, 0.0]"),
        ({"mass": -0.5}, "mass: expected a finite number > 0 kg, got -0.5"),
        ({"mount": "hub", "body": {}}, "vehicle.body.disc_radius: expected"),
        ({"rotor_positions": [[0.1, 0, 0]] * 4}, "rotor_positions: expected rotors that produce every thrust"),
    ],
)
def test_a_broken_vehicle_is_one_line_and_2(call, tmp_path, changes, words):
    code, out, said = call("check", written(tmp_path, **changes), *QUICK)
    assert (code, out) == (2, "")
    assert words in said
    assert said.count("\n") == 1
    assert not (tmp_path / "check-out").exists()


@pytest.mark.parametrize(
    "arguments",
    [("check", "hehn"), ("check", "no.toml"), ("check", "hehn2011", "--law", "inverse"), ("check",),
     ("check", "hehn2011", "--plant", "ideal"), ("check", "hehn2011", "--runs", "0")],
)  # fmt: skip
def test_what_cannot_be_asked_is_2(call, tmp_path, arguments):
    code, _, said = call(*arguments)
    assert code == 2
    assert said.startswith("flypend: ") or "Usage" in said
    assert not list(tmp_path.iterdir())


def test_several_laws_stand_in_one_table_and_one_that_fails_decides(call):
    code, out, _ = call("check", "hehn2011", "--law", "inverted", "--law", "corrected", *QUICK)
    assert code == 1
    assert "hehn2011 on a gimbal can be flown by inverted" in out
    assert "hehn2011 on a gimbal cannot be flown by corrected." in out


def test_a_hub_that_touches_from_some_starts_is_graded_not_refused(call, tmp_path):
    """README's own machine."""
    code, out, _ = call("check", written(tmp_path, mount="hub"), *QUICK)
    assert code == 0
    assert "mine on a hub can be flown by inverted: lean all, hanging all" in out


def test_a_trial_adds_its_table(call, tmp_path, monkeypatch):
    from flypend.studies import trial

    sweeps = trial.swept
    monkeypatch.setattr(trial, "swept", lambda *given: {"mass": sweeps(*given)["mass"]})
    monkeypatch.setattr(trial, "FACTORS", (1.25,))
    monkeypatch.setattr(trial, "RUNS", 8)
    assert call("check", "hehn2011", *QUICK, "--trial")[0] == 0
    told = json.loads((tmp_path / "check-out" / "report.json").read_text(encoding="utf-8"))
    assert len(told["trials"]["inverted"]["uptime"]) == 8
    assert np.all(np.array(told["trials"]["inverted"]["uptime"]) > 0.5)
    assert "mean of all sweeps" in (tmp_path / "check-out" / "report.md").read_text(encoding="utf-8")


def test_run_warns_of_a_vehicle_that_is_too_slow_and_flies_it(call, tmp_path):
    run = {
        "vehicle": {"base": "hehn2011"}, "law": "lqr", "start": {"y": [0.0, 0.0, 1.0]}, "duration": 0.1,
        "plant": {"lag": 0.3},
    }  # fmt: skip
    (tmp_path / "late.toml").write_text(toml_text(run), encoding="utf-8")
    _, _, said = call("run", "late.toml", "--no-figures")
    assert said.startswith("flypend: warning: rotor lag and delay of 300 ms are too long")
    run["plant"] = "rotors"
    (tmp_path / "late.toml").write_text(toml_text(run), encoding="utf-8")
    assert "warning" not in call("run", "late.toml", "--no-figures")[2]


def test_runs_counts_those_under_all_errors_too(call, monkeypatch):
    room, asked = import_module("flypend.studies.joint"), []

    def joint(*_, runs=None, **__):
        asked.append(runs)
        return room.Joint({}, 1, {1.0: room.Count(1, 1)})

    monkeypatch.setattr(room, "joint", joint)
    assert call("check", "hehn2011", "--sensors", "mocap", *QUICK)[0] == 0
    assert asked == [16]


def test_sensors_are_read_from_a_file(tmp_path):
    path = tmp_path / "sensors.toml"
    path.write_text('base = "mocap"\ngyro_bias = 0.02\nrod = { rate = 100.0 }\n', encoding="utf-8")
    found = plant_of(plant_asked("rotors", str(path))).sensors
    mocap = fp.Plant(sensors="mocap").sensors
    assert (found.gyro_bias, found.rod.rate, found.rod.noise) == (0.02, 100.0, mocap.rod.noise)
    assert found.told.position == mocap.position
    path.write_text('base = "perfect"\n', encoding="utf-8")
    assert plant_asked("rotors", str(path)) == "rotors"
    path.write_text('base = "mocap"\ngyro_bias = -1\n', encoding="utf-8")
    with pytest.raises(fp.InputError, match="gyro_bias"):
        plant_asked("rotors", str(path))
