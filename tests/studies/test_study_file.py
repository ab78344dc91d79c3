"""The file of a study: every text is a study or is refused in one line, and says the same when it is written again."""

import dataclasses
import math
import re
import shlex
import tomllib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import flypend as fp
from flypend.cli import app as cli
from flypend.files.toml import toml_text
from flypend.laws import Controller
from flypend.plants import Noise, Plant
from flypend.settings.runfile import run_file
from flypend.studies.sweep.design import design
from flypend.studies.sweep.study import KEYS, standard

STUDY = {
    "vehicle": "hehn2011",
    "law": {"name": "corrected", "gains": {"k_d": 1.5}},
    "plant": {"base": "rotors", "noise": {"x": 0.01}},
    "duration": 2.0,
    "runs": 10,
    "sampling": "sobol",
    "criterion": {"target": "e3", "position": math.inf},
    "start": {"x": [0.0, 0.0, 1.0]},
    "vary": {
        "start": {"tilt": {"from": 0.0, "to": 1.0, "points": 3}, "azimuth": {"from": 0, "to": 6.0}, "R": "uniform"},
        "gains": {"k_1": {"from": 1.0, "to": 100.0, "scale": "log"}, "k_2": {"values": [4.0, 8.0]}},
        "plant": {"delay": {"values": [0.0, 0.01]}, "mismatch": {"mass": {"from": 0.9, "to": 1.1, "points": 3}}},
    },
}


def refused(table):
    with pytest.raises(fp.InputError) as caught:
        fp.study(table)
    line = str(caught.value)
    assert len(line.splitlines()) == 1
    assert ": expected " in line
    assert ", got " in line
    return line


def changed(path, value):
    """The study with one entry changed."""
    table = tomllib.loads(toml_text(STUDY))
    *outer, last = path.split(".")
    inner = table
    for key in outer:
        inner = inner.setdefault(key, {})
    inner[last] = value
    return table


def test_a_study_is_what_its_table_says():
    study = fp.study(STUDY)
    assert (study.shape, study.samples, study.runs, study.dimensions) == ((2, 3, 2, 3), 10, 360, 5)
    assert [axis.name for axis in study.grid] == ["delay", "mismatch.mass", "k_2", "tilt"]
    assert study.flight.plant == Plant(noise=Noise(x=0.01))
    last = study.plant_at(35)
    assert (last.delay, last.mismatch["mass"]) == (0.01, pytest.approx(1.1))
    assert (study.plant_at(0).delay, study.plant_at(0).mismatch["mass"]) == (0.0, pytest.approx(0.9))
    other = fp.study(STUDY | {"criterion": {"position": math.inf, "target": "e3"}})
    assert study.flight.criterion == other.flight.criterion
    assert study.law.gains["k_d"] == 1.5


@pytest.mark.parametrize(
    "plant", ["laboratory", {"base": "rotors", "sensors": "mocap"}, {"sensors": {"base": "mocap", "gyro_bias": 0.1}}]
)
def test_what_varies_of_sensors_is_on_top_of_theirs_wherever_these_are_told(plant):
    varied = {"gyro_scale": {"values": [0.01, 0.02]}, "position": {"latency": {"values": [0.01, 0.03]}}}
    study = fp.study(
        STUDY | {"plant": plant, "vary": {"plant": {"sensors": varied}}, "runs": 1, "start": {"y": [0, 0, 1]}}
    )
    sensors, last = study.flight.plant.sensors, study.plant_at(3).sensors
    assert last == sensors.replace(gyro_scale=0.02, position=dataclasses.replace(sensors.position, latency=0.03))


def test_its_text_reads_back_as_the_same():
    for table in (STUDY, standard("inverted", None, "ideal", 10, 1, None), standard("lqr", None, "rotors", 5, 2, 3.0)):
        study = fp.study(table)
        again = fp.study(tomllib.loads(study.text()))
        assert again.text() == study.text()
        assert again.axes == study.axes


def test_the_order_of_the_file_changes_nothing_that_is_drawn():
    def turned(value):
        return {k: turned(v) for k, v in reversed(value.items())} if isinstance(value, dict) else value

    assert list(turned(STUDY)["vary"]["start"]) != list(STUDY["vary"]["start"])
    one, two = (design(fp.study(table), 0, 360) for table in (STUDY, turned(STUDY)))
    np.testing.assert_array_equal(one.packed, two.packed)
    np.testing.assert_array_equal(one.gains["k_1"], two.gains["k_1"])


def test_a_default_that_is_spelt_out_changes_nothing():
    assert fp.study(STUDY | {"seed": 1, "judge_period": 0.01}).text() == fp.study(STUDY).text()
    assert fp.study(STUDY | {"seed": 2}).text() != fp.study(STUDY).text()


@pytest.mark.parametrize(
    ("path", "value", "start"),
    [
        ("durations", 2.0, "durations: expected one of vehicle, law"),
        ("duration", math.nan, "duration: expected a finite number > 0 s, got nan"),
        ("duration", "long", "duration: "),
        ("runs", 0, "runs: expected an integer >= 1"),
        ("runs", 2.5, "runs: expected an integer >= 1, got 2.5"),
        ("runs", True, "runs: expected an integer"),
        ("runs", 10**9, "runs: expected at most 1000000000 over all cells"),
        ("seed", -1, "seed: expected an integer >= 0"),
        ("chunk", 0, "chunk: "),
        ("chunk", 10**7, "chunk: expected at most"),
        ("sampling", "sobel", "sampling: expected one of uniform, sobol, latin, got 'sobel' (did you mean 'sobol'?)"),
        ("rtol", 0, "rtol: "),
        ("final", 1, "final: expected true or false"),
        ("precision", "half", "precision: expected one of double, float"),
        ("precision", "float", "precision: expected 'double' in a sampled flight"),
        ("plant", "ideal", "vary.plant: expected a plant with numbers"),
        ("law.name", "corected", "law.name: "),
        ("criterion.rods", 1.0, "criterion.rods: "),
        ("criterion.rod", -1.0, "criterion.rod: "),
        ("criterion.target", "up", "criterion.target: "),
        ("start.y", [0, 0, 1], "start.y: expected nothing, since it varies"),
        ("start.y_dot", [1, 0, 0], "start.y_dot: expected nothing where the rod varies"),
        ("start.R", [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "start.R: expected nothing, since it varies"),
        ("start.z", 1, "start.z: "),
        ("vary.stat", {}, "vary.stat: "),
        ("vary.start", 3, "vary.start: expected a table"),
        ("vary.start.Z", "uniform", "vary.start.Z: "),
        ("vary.start.y", "uniform", "vary.start: expected y, or tilt and azimuth, got both"),
        ("vary.start.R", "even", "vary.start.R: expected 'uniform'"),
        ("vary.start.x_dot", {"disc": 1.0}, "vary.start.x_dot: expected { ball = radius }"),
        ("vary.start.x_dot", {"ball": math.nan}, "vary.start.x_dot.ball: "),
        ("vary.start.tilt", {"from": -1.0, "to": 1.0}, "vary.start.tilt: expected angles from 0"),
        ("vary.start.rate", {"from": -1.0, "to": 1.0}, "vary.start.rate: expected rates >= 0"),
        ("vary.gains.k_1", {"from": 0.0, "to": 1.0, "scale": "log"}, "vary.gains.k_1.from: "),
        ("vary.gains.k_1", {"from": 2.0, "to": 1.0}, "vary.gains.k_1.to: "),
        ("vary.gains.k_1", {"from": 2.0}, "vary.gains.k_1.to: expected a number, got nothing"),
        ("vary.gains.k_1", {"from": 1.0, "to": 2.0, "points": 1}, "vary.gains.k_1.points: "),
        ("vary.gains.k_1", {"values": []}, "vary.gains.k_1: expected 1 to"),
        ("vary.gains.k_1", {"values": [1.0], "from": 1.0}, "vary.gains.k_1: expected values alone"),
        ("vary.gains.k_9", {"values": [1.0]}, "vary.gains.k_9: "),
        ("vary.plant.delay", {"from": 0.0, "to": 0.1}, "vary.plant.delay: expected a grid"),
        ("vary.plant.delay", {"values": [-1.0]}, "plant.delay: "),
        ("vary.plant.dely", {"values": [1.0]}, "plant.dely: "),
        ("vary.plant.rate", {"from": 100, "to": 500, "points": 33}, "vary.plant: expected at most 32 plants"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_with_its_field(path, value, start):
    assert refused(changed(path, value)).startswith(start)


def test_what_is_missing_is_told():
    for key in ("vehicle", "law", "duration"):
        table = {name: value for name, value in STUDY.items() if name != key}
        assert refused(table) == f"{key}: expected a value, got nothing"
    without = {name: value for name, value in STUDY.items() if name not in ("vary", "start")}
    assert refused(without | {"runs": 1}) == "start.y: expected a unit vector, got nothing"


def test_a_sample_of_nothing_and_a_hypercube_too_large_are_refused():
    fixed = {"vehicle": "nayak2018", "law": {"name": "corrected"}, "duration": 1.0, "start": {"y": [0, 0, 1]}}
    fixed["plant"] = "ideal"
    assert refused(fixed | {"runs": 5}) == "runs: expected 1, since nothing is drawn, got 5"
    assert fp.study(fixed).runs == 1
    steady = {"base": "rotors", "wind": {"on_vehicle": [0.1, 0.0, 0.0]}}
    assert refused(fixed | {"plant": steady, "runs": 5}) == "runs: expected 1, since nothing is drawn, got 5"
    gusts = {"vary": {"plant": {"wind": {"gust_on_vehicle": {"values": [0.0, 0.1]}}}}, "plant": steady}
    assert fp.study(fixed | gusts | {"runs": 5}).runs == 10
    noise = {"vary": {"plant": {"noise": {"x": {"values": [0.01]}}}}, "plant": "rotors"}
    assert fp.study(fixed | noise | {"runs": 5}).runs == 5
    vary = {"vary": {"start": {"R": "uniform"}}, "runs": 10_000_000}
    assert refused(fixed | vary | {"sampling": "latin"}).startswith("runs: expected at most 6666666 in 3 dimensions")
    assert fp.study(fixed | vary | {"sampling": "sobol"}).chunks == 306


PATHS = st.one_of(
    st.sampled_from(KEYS),
    st.sampled_from(["start.y", "vary.start.tilt", "vary.start.omega", "vary.gains.k_1", "vary.plant.delay",
                     "criterion.rod", "law.gains", "law.gains.k_d", "plant.noise", "vary.start", "vary.gains"]),
    st.builds(lambda a, b: f"{a}.{b}", st.sampled_from(KEYS), st.text("abk_1", min_size=1, max_size=4)),
)  # fmt: skip
SCALARS = st.one_of(
    st.floats(), st.integers(-(2**70), 2**70), st.booleans(), st.text(max_size=8),
    st.sampled_from(["uniform", "latin", "hehn2011", "ideal", "e3"]),
)  # fmt: skip
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.one_of(
        st.lists(inner, max_size=4),
        st.dictionaries(st.sampled_from(["from", "to", "points", "values", "scale", "ball", "name", "x"]), inner),
    ),
    max_leaves=6,
)


@settings(max_examples=250, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(PATHS, VALUES)
def test_whatever_is_written_is_a_study_or_one_line(path, value):
    try:
        table = changed(path, value)
    except (TypeError, AttributeError):  # a table where there is a number
        return
    try:
        made = fp.study(table)
    except fp.InputError as error:
        line = str(error)
    else:
        assert fp.study(tomllib.loads(made.text())).text() == made.text()
        return
    assert len(line.splitlines()) == 1
    assert ": expected " in line


@given(
    st.dictionaries(
        st.text(min_size=1, max_size=5), SCALARS.filter(lambda v: not isinstance(v, str) or v.isprintable())
    )
)
def test_toml_that_is_written_reads_back_as_the_same(table):
    again = tomllib.loads(toml_text({"table": table, "plain": [1.0, 2.5]}))
    assert again["plain"] == [1.0, 2.5]
    assert repr(again["table"]) == repr(table)  # NaN too


def test_the_ideal_plant_has_no_numbers_to_vary_under_a_law_in_python_either(tmp_path):
    text = "import flypend as fp\n\ndef hold(t, s, v):\n    return fp.Wrench(float(s.x[2]) * v.weight, 0 * s.omega)\n"
    (tmp_path / "mine.py").write_text(text, encoding="utf-8")
    law, asked = {"function": f"{tmp_path / 'mine.py'}:hold"}, {"delay": {"values": [0.0, 0.01]}}
    table = STUDY | {"law": law, "start": {"y": [0.0, 0.0, 1.0]}, "vary": {"plant": asked}}
    assert isinstance(fp.study(table).law, Controller)
    with pytest.raises(fp.InputError, match=r"^vary\.plant: expected a plant with numbers"):
        fp.study(table | {"plant": "ideal"})


@pytest.mark.parametrize(
    "text", ["runs = ", "duration = nan\nvehicle = 'hehn2011'\nlaw = {name = 'lqr'}", "a = 1979-05-27"]
)
@pytest.mark.parametrize("command", ["sweep", "map", "tune"])
def test_the_command_line_tells_it_in_one_line_and_leaves_nothing(text, command, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "study.toml").write_text(text, encoding="utf-8")
    out = {"sweep": "a.zarr", "map": "a.png", "tune": "a"}[command]
    monkeypatch.setattr("sys.argv", ["flypend", command, "study.toml", "-o", out])
    monkeypatch.setattr(cli.signal, "signal", lambda *_: None)
    with pytest.raises(SystemExit) as exit_:
        cli.main()
    told = capsys.readouterr()
    assert exit_.value.code == 2
    assert told.out == ""
    assert len(told.err.strip().splitlines()) == 1
    assert [entry.name for entry in tmp_path.iterdir()] == ["study.toml"]


def test_a_run_file_may_be_written_from_settings(tmp_path):
    (tmp_path / "a.toml").write_text(
        toml_text(
            {"vehicle": "nayak2018", "duration": 1.0, "law": {"name": "corrected"}, "start": {"y": [0.0, 0.6, 0.8]}}
        ),
        encoding="utf-8",
    )
    np.testing.assert_allclose(run_file(str(tmp_path / "a.toml")).flight.starts.y, [0, 0.6, 0.8])


# The page about studies -----------------------------------------------------------------------------------------------

PAGE = (Path(__file__).parents[2] / "docs" / "studies" / "studies.md").read_text(encoding="utf-8")


def block(language):
    (found,) = re.findall(rf"^```{language}\n(.*?)^```$", PAGE, flags=re.MULTILINE | re.DOTALL)
    return found


def test_the_study_of_the_page_is_one():
    study = fp.study(tomllib.loads(block("toml")))
    assert (study.shape, study.samples) == ((5,), 1_000_000)
    assert {axis.name for axis in study.axes} == {"y", "R", "omega", "y_dot", "k_d", "k_1"}


def test_the_python_of_the_page_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    exec(compile(block("python"), "studies.md", "exec"), {})
    assert 0 < float(capsys.readouterr().out) < 1


def test_the_table_of_the_page_has_the_defaults():
    study = fp.study(standard("lqr", None, "rotors", 1, 1, None) | {"judge_period": 0.01})
    rows = dict(re.findall(r"^\| `(\w+)` \| ([^|]*) \|", PAGE, flags=re.MULTILINE))
    assert set(rows) == {
        "rtol",
        "judge_period",
        "precision",
        "max_steps",
        "sampling",
        "seed",
        "chunk",
        "final",
    }
    for key, told in rows.items():
        given = re.sub(r"(?<=\d) (?=\d)", "", told).replace('"', "").replace(" s", " ")
        assert str(fp.study(STUDY).settings[key] if key == "judge_period" else study.settings[key]).lower() in (
            given.lower().replace("1e-6", "1e-06")
        ), key


def test_its_commands_can_be_typed(monkeypatch):
    monkeypatch.chdir(Path(fp.__file__).parent)  # which has the folder that `flypend examples` writes
    lines = re.findall(r"^    (flypend .*)$", PAGE, flags=re.MULTILINE)
    assert len(lines) >= 5
    for line in lines:
        _, *arguments = shlex.split(line, comments=True)
        group = cli.app
        with group.make_context("flypend", list(arguments)) as context:
            name, found, rest = group.resolve_command(context, arguments)
            with found.make_context(name, rest, parent=context) as inner:
                if name in ("sweep", "tune"):
                    assert fp.study(inner.params["study"]).runs > 0
