"""What to fly, as data: every text either names a flight or is refused in one line, and nothing else happens."""

import dataclasses
import math
import string
import tomllib
from pathlib import Path

import numpy as np
import pytest
import tomli_w
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

import flypend as fp
from flypend.flight.request import Flight
from flypend.flight.simulate import fly
from flypend.laws import law_from_dict, law_names
from flypend.model.by_name import vehicle_names
from flypend.model.state import SHAPES
from flypend.paper import experiment, experiment_names
from flypend.settings.runfile import KEYS, check_plain, plant_of, run_file

SWING_UP = str(Path(fp.__file__).parent / "examples" / "swing-up.toml")
OWN = """
vehicle = "nayak2018"
duration = 2.0
law = { name = "corrected", gains = { k_d = 1.5 } }

[start]
y = [0.6, 0.0, 0.8]
y_dot = [0.8, 0.0, -0.6]
"""


def in_one_line(error):
    assert len(str(error).splitlines()) == 1
    assert ": expected " in str(error)
    assert ", got " in str(error)


def flight(what, overrides=()):
    """The request that this says."""
    return run_file(what, overrides).flight


def written(folder, text, name="own.toml"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return str(path)


def refused(what, *overrides):
    """The one line that refuses this."""
    with pytest.raises(fp.InputError) as caught:
        flight(what, overrides)
    in_one_line(caught.value)
    return str(caught.value)


def same_state(one, other):
    for name in SHAPES:  # to the eps of projecting twice what was on the manifold
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=0, atol=1e-15)


# What is flown ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", experiment_names())
def test_an_experiment_by_its_name_is_its_row_under_the_corrected_law(name):
    chosen, row = flight(name), experiment(name)
    same_state(chosen.starts, row.start)
    assert chosen.vehicle == row.vehicle
    assert chosen.law.name == "corrected"
    assert chosen.law.gains == row.law().values
    assert (chosen.duration, chosen.tolerances.rtol) == (6.5, 1e-9)


def test_a_flight_flies_what_it_says():
    chosen = flight("4", ["duration=0.3", "rtol=1e-7"])
    row = experiment("4")
    wanted = fp.simulate(row.vehicle, row.law(), row.start, 0.3, rtol=1e-7, plant="ideal")
    # Starts equal to an eps, rtol 1e-7.
    np.testing.assert_allclose(fly(chosen).states.packed(), wanted.states.packed(), rtol=0, atol=1e-9)
    exact = fly(flight("4", ["duration=0.3"]))
    assert np.max(np.abs(fly(chosen).states.packed() - exact.states.packed())) > 1e-9
    assert fly(chosen.replace(duration=0.1)).t[-1] == 0.1


def test_a_file_of_ones_own(tmp_path):
    chosen = flight(written(tmp_path, OWN))
    same_state(chosen.starts, fp.State(y=(0.6, 0, 0.8), y_dot=(0.8, 0, -0.6)))
    assert chosen.vehicle == fp.vehicle("nayak2018")
    assert chosen.law.gains == fp.laws.corrected(k_d=1.5).values
    assert chosen.duration == 2.0


@pytest.mark.parametrize(
    "text",
    [
        'vehicle = "hehn2011"',
        'vehicle = { base = "hehn2011" }',
        'vehicle = { base = "hehn2011", mount = "gimbal", body = { arm_radius = 0.006 } }',
        'vehicle = { base = "nayak2018", NAME, MASSES, rod_length = 0.565, INERTIA, ROTORS, BODY, AIR }',
        "vehicle = { NAME, MASSES, rod_length = 0.565, INERTIA, ROTORS, rotor_lag = 0.02, BODY, AIR }",
    ],
)
def test_a_vehicle_by_name_by_table_and_by_changes_of_another_is_the_same(tmp_path, text):
    data = fp.vehicle("hehn2011").to_dict()
    rotors = ("rotor_positions", "rotor_spins", "drag_ratio", "rotor_limits")
    text = (
        text.replace("NAME", 'name = "hehn2011"')
        .replace("MASSES", "mass = 0.5, bob_mass = 0.05")
        .replace("INERTIA", f"inertia = {data['inertia']}")
    )
    for table in ("body", "air"):
        content = ", ".join(f"{name} = {value}" for name, value in data[table].items())
        text = text.replace(table.upper(), f"{table} = {{ {content} }}")
    text = text.replace("ROTORS", ", ".join(f"{name} = {data[name]}" for name in rotors))
    chosen = flight(written(tmp_path, OWN.replace('vehicle = "nayak2018"', text)))
    assert chosen.vehicle == fp.vehicle("hehn2011")


def test_an_experiment_with_changes(tmp_path):
    text = """
    experiment = 5
    duration = 1
    rtol = 1e-8
    law = { name = "printed", gains = { k_1 = 7, beta = "off" } }
    vehicle = { mass = 0.3 }
    start = { omega = [0, 0, 0] }
    """
    chosen, row = flight(written(tmp_path, text)), experiment("5")
    same_state(chosen.starts, dataclasses.replace(row.start, omega=np.zeros(3)))
    assert chosen.vehicle == row.vehicle.replace(mass=0.3)
    assert chosen.law.gains == fp.laws.printed(k_d=1, k_1=7, k_2=4, beta="off").values
    assert (chosen.duration, chosen.tolerances.rtol) == (1.0, 1e-8)


def test_the_gains_of_an_experiment_are_for_the_laws_of_the_paper():
    chosen = flight("5", ["law.name=inverted", "vehicle=hehn2011"])
    assert chosen.law.name == "inverted"
    assert not {"k_d", "k_1", "k_2"} & set(chosen.law.gains)
    assert chosen.vehicle == fp.vehicle("hehn2011")


def test_the_settings_say_everything_that_was_flown():
    chosen, again = run_file("3", ["vehicle.mass=0.5", "law.gains.k_d=2"])
    assert fp.Vehicle.from_dict(again["vehicle"]) == chosen.vehicle
    assert law_from_dict(again["law"]).values == chosen.law.gains
    same_state(fp.State(**again["start"]), chosen.starts)
    assert again["duration"] == chosen.duration


def test_the_settings_of_a_flight_are_its_own():
    first = flight("2", ["start.y=[0.0, 0.0, 1.0]", "start.y_dot=[0.0, 0.0, 0.0]", "law.gains.k_d=5"])
    second = flight("2")
    assert first.law.gains["k_d"] == 5
    assert second.law.gains["k_d"] == 1
    same_state(second.starts, experiment("2").start)


# Overrides ----------------------------------------------------------------------------------------------------------


def test_overrides_apply_in_order():
    assert flight("2", ["duration=1", "duration=3", "duration=2"]).duration == 2
    chosen = flight("2", ["experiment=3", "law.gains.k_1=1", "law.gains.k_1=2", "law.gains={k_2=6}"])
    assert {key: chosen.law.gains[key] for key in ("k_d", "k_1", "k_2")} == {"k_d": 1, "k_1": 11, "k_2": 6}
    same_state(chosen.starts, experiment("3").start)


def test_overrides_change_a_file_and_leave_the_rest(tmp_path):
    path = written(tmp_path, OWN)
    chosen = flight(path, ["vehicle.mass=0.7", "law.gains.k_2=3", "start.x=[1, 2, 3]"])
    assert chosen.vehicle == fp.vehicle("nayak2018").replace(mass=0.7)
    assert chosen.law.gains == fp.laws.corrected(k_d=1.5, k_2=3).values
    np.testing.assert_array_equal(chosen.starts.x, [1, 2, 3])
    np.testing.assert_array_equal(chosen.starts.y, [0.6, 0, 0.8])
    assert flight(path, ["vehicle=hehn2011", "vehicle.mass=0.7"]).vehicle.inertia[0, 0] == 3.2e-3


def test_lists_of_words_and_tables_are_read_where_a_setting_has_them():
    table = tomllib.loads(
        'vehicle = "hehn2011"\nduration = 2.0\nstart = { x = [-1.5, 0, 0], y = [0, 0, 1] }\n'
        'plant = { sensors = { like = "mocap", adjustable = ["gyro_bias"] } }\n'
        '[law]\nname = "plan"\n[[law.window]]\ncentre = [0, 0.25, 0.3]\nwidth = 0.5\nheight = 1.0\n'
    )
    for name, value in table.items():
        check_plain(name, value)
    for name, value in {"start.x": ["far"], "plant.sensors.adjustable": [{}], "law.gains": [{}]}.items():
        with pytest.raises(fp.InputError, match=rf"^{name}: expected a list of numbers"):
            check_plain(name, value)


@pytest.mark.parametrize(
    "text", ["law.name=printed", 'law.name="printed"', "law.name = printed ", "law={name='printed'}"]
)
def test_a_value_is_toml_or_a_plain_word(text):
    assert flight("2", [text]).law.name == "printed"


def test_a_value_may_hold_an_equals_sign_and_a_comment():
    assert flight("2", ["vehicle.name=a=b"]).vehicle.name == "a=b"
    assert flight("2", ["duration=2 # seconds"]).duration == 2


@pytest.mark.parametrize("text", ["duration", "=2", "law..k_d=2", ".duration=2", "", "law.gains.=2", "\n=1", "a\nb=1"])
def test_an_override_without_a_key_or_a_value_is_refused(text):
    assert refused("2", text) == f"--set: expected KEY.KEY=VALUE, such as law.gains.k_d=2, got {text!r}"


def test_a_value_brings_no_second_setting():
    line = refused("2", "duration=1\nrtol=1e-3")
    assert line == "duration: expected a finite number > 0 s, got '1\\nrtol=1e-3'"


def test_a_key_below_something_that_is_no_table_is_refused(tmp_path):
    assert refused(written(tmp_path, OWN), "start.y.first=1") == (
        "--set: expected a table at start.y, got [0.6, 0.0, 0.8]"
    )
    assert refused("2", "duration=1", "duration.seconds=2").startswith("--set: expected a table at duration, got 1")


# What is refused ----------------------------------------------------------------------------------------------------


def test_a_name_near_to_nothing_is_refused_without_a_guess():
    assert refused("2", "law.gains.zzzzzz=1").endswith("got 'zzzzzz'")


def test_gains_of_another_law_are_unknown():
    assert refused("2", "law.name=printed", "law.gains.yaw_damping=1").startswith("law.gains.yaw_damping: expected one")


@pytest.mark.parametrize(
    ("override", "line"),
    [
        ("start.R=[[1, 0, 0], [0, 1, 0], [0, 0, 2]]", "start.R: expected a rotation .*, got ‖RᵀR − 1‖ = 3"),
        ("start.R=[[1, 0, 0], [0, 1, 0], [0, 0, -1]]", "start.R: expected a rotation .*, got determinant < 0"),
        ("start.y=[1, 0, 1]", "start.y: expected a unit vector, got |y| = 1.41421"),
        ("start.y_dot=[0.7, 0, 0.7]", "start.y_dot: expected a tangent vector (y · y_dot = 0), got y · y_dot = 0.99"),
        ("start.omega=[nan, 0, 0]", "start.omega: expected finite numbers, got 1 that are NaN or infinite"),
        ("start.x=[1, 2]", "start.x: expected numbers of shape (3), got shape (2,)"),
        ("start.x=5", "start.x: expected numbers of shape (3), got shape ()"),
        ("start.x=[[1, 2, 3], [4, 5]]", "start.x: expected numbers of shape (3), got .*"),
        ("start.x=[[1, 2, 3], [4, 5, 6]]", "start: expected a single state, got a batch of shape (2,)"),
        ("vehicle.mass=0", "vehicle.mass: expected a finite number > 0 kg, got 0"),
        ("vehicle.mass=-0.4", "vehicle.mass: expected a finite number > 0 kg, got -0.4"),
        ("vehicle.bob_mass=0", "vehicle.bob_mass: expected a finite number > 0 kg, got 0"),
        ("vehicle.rod_length=-1", "vehicle.rod_length: expected a finite number > 0 m, got -1"),
        ("vehicle.gravity=nan", "vehicle.gravity: expected a finite number >= 0 m/s², got nan"),
        ("vehicle.inertia=[1, -1, 1]", "vehicle.inertia: expected a positive definite matrix, got .*"),
        ("vehicle.inertia=[1, 1, 3]", "vehicle.inertia: expected .* within the triangle inequality, got 1 + 1 < 3"),
        ("duration=0", "duration: expected a finite number > 0 s, got 0"),
        ("duration=-1", "duration: expected a finite number > 0 s, got -1"),
        ("duration=inf", "duration: expected a finite number > 0 s, got inf"),
        ("duration=nan", "duration: expected a finite number > 0 s, got nan"),
        ("rtol=0", "rtol: expected a finite number > 0, got 0"),
        ("law.gains.k_d=0", "law.gains.k_d: expected a finite number > 0 1/s, got 0"),
        ("law.gains.k_d=nan", "law.gains.k_d: expected a finite number > 0 1/s, got nan"),
        # an unknown name, with the nearest known one
        ("durration=2", "durration: expected one of vehicle, .*, got 'durration' (did you mean 'duration'?)"),
        ("laws.name=printed", "laws: expected .*, got 'laws' (did you mean 'law'?)"),
        ("start.ydot=[0, 0, 0]", "start.ydot: expected .*, got 'ydot' (did you mean 'y_dot'?)"),
        ("vehicle.masss=1", "vehicle.masss: expected .*, got 'masss' (did you mean 'mass'?)"),
        ("law.gain.k_d=1", "law.gain: expected one of name, gains.*, got 'gain' (did you mean 'gains'?)"),
        ("law.name=corected", "law.name: expected one of .*, got 'corected' (did you mean 'corrected'?)"),
        ("law.gains.kd=1", "law.gains.kd: expected .*, got 'kd' (did you mean 'k_d'?)"),
        ("law.gains.beta=of", "law.gains.beta: expected one of off, regularized, got 'of' (did you mean 'off'?)"),
        (
            "vehicle=hehn",
            f"vehicle: expected one of {', '.join(vehicle_names())}, got 'hehn' (did you mean 'hehn2011'?)",
        ),
        ("vehicle.base=nayak", "vehicle.base: expected .*, got 'nayak' (did you mean 'nayak2018'?)"),
        ("experiment=2-project", "experiment: expected .*, got '2-project' (did you mean '2-projected'?)"),
        ("law.name=printed.gains", "law.name: expected .*"),
        # of the wrong type
        ("duration=two", "duration: expected a finite number > 0 s, got 'two'"),
        ('duration="2"', "duration: expected a finite number > 0 s, got '2'"),
        ("duration=true", "duration: expected a finite number > 0 s, got True"),
        ("duration=[2]", "duration: expected a finite number > 0 s, got [2]"),
        ("duration={}", "duration: expected a finite number > 0 s, got {}"),
        ("duration=", "duration: expected a finite number > 0 s, got ''"),
        ("duration=2020-01-01", "duration: expected a number, a word, a list or a table, got 2020-01-01"),
        ("vehicle.name=2020-01-01", "vehicle.name: expected a number, a word, a list or a table, got 2020-01-01"),
        ("vehicle.mass=true", "vehicle.mass: expected a finite number > 0 kg, got True"),
        ("law.gains.k_d=true", "law.gains.k_d: expected a finite number > 0 1/s, got True"),
        ("law.gains.beta=1", "law.gains.beta: expected one of off, regularized, got 1"),
        ("law.gains=[1]", "law.gains: expected a table, got [1]"),
        ("law=3", "law: expected the name of a law, or a table, got 3"),
        ("law.name=[1]", "law.name: expected one of .*, got [1]"),
        ("start=[1]", "start: expected a table, got [1]"),
        ("vehicle=[1, 2]", "vehicle: expected a table, got [1, 2]"),
        ("vehicle.base=[1]", f"vehicle.base: expected one of {', '.join(vehicle_names())}, got [1]"),
        ("experiment=[2]", "experiment: expected one of .*, got '[2]' (did you mean '2'?)"),
        ("start.y=[true, false, false]", "start.y: expected a list of numbers, got [True, False, False]"),
        ('start.y=["0", "0", "1"]', "start.y: expected a list of numbers, got ['0', '0', '1']"),
        ("start.y=[{}, {}, {}]", "start.y: expected a list of numbers, got [{}, {}, {}]"),
        ("start.y=up", "start.y: expected numbers of shape (3), got 'up'"),
        ("start.y={a=1}", "start.y: expected numbers of shape (3), got {'a': 1}"),
        ("vehicle.mass=9223372036854775808", "vehicle.mass: expected an integer of 64 bits, got one of 64 bits"),
        (f"start.x=[{10**400}, 0, 0]", "start.x: expected an integer of 64 bits, got one of 1329 bits"),
        (f"duration={'1' * 5000}", "duration: expected a finite number > 0 s, got '11111.*"),
        ('"a\\nb"=1', "\"a\\nb\": expected one of vehicle, .*"),
    ],
)  # fmt: skip
def test_a_value_that_is_wrong_is_told_with_field_expected_and_got(override, line):
    before, _, after = line.partition(".*")
    told = refused("2", override)
    assert told.startswith(before)
    assert told.endswith(after)


@pytest.mark.parametrize("key", ["vehicle", "law", "start", "duration"])
def test_a_missing_key_is_named(tmp_path, key):
    kept = {name: value for name, value in tomllib.loads(OWN).items() if name != key}
    lines = [f"{name} = {toml(value)}\n" for name, value in kept.items()]
    told = refused(written(tmp_path, "".join(lines)))
    assert told == f"{key}: expected a value (or `experiment`, which brings one), got nothing"


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("y = [0.6, 0.0, 0.8]\n", "", "start.y: expected a unit vector, got nothing"),
        (
            '"nayak2018"',
            "{ mass = 1 }",
            "vehicle.bob_mass: expected a number: mass of the rod with its bob, kg, got nothing",
        ),
        ('name = "corrected", ', "", "law.name: expected one of .*, got None"),
        ('"corrected"', "3", "law.name: expected one of .*, got 3"),
        ("{ k_d = 1.5 }", "1", "law.gains: expected a table of gains, got 1"),
        ('{ name = "corrected", gains = { k_d = 1.5 } }', "5", "law: expected the name of a law, or a table, got 5"),
        ("[start]", "[[start]]", "start: expected a list of numbers, got .*"),
        ("duration = 2.0", '"dura\\ntion" = 2.0', "run: expected printable keys, got 'dura\\ntion'"),
        ("duration = 2.0", '"dura tion" = 2.0', "dura tion: expected .* (did you mean 'duration'?)"),
    ],
)
def test_a_file_that_is_wrong_is_told_with_field_expected_and_got(tmp_path, old, new, line):
    assert OWN.count(old) == 1
    before, _, after = line.partition(".*")
    told = refused(written(tmp_path, OWN.replace(old, new)))
    assert told.startswith(before)
    assert told.endswith(after)


def test_what_is_no_file_of_settings_is_refused(tmp_path):
    broken, binary = tmp_path / "broken.toml", tmp_path / "binary.toml"
    broken.write_text("duration = [1,\nlaw = 3\n")
    binary.write_bytes(b"\x89PNG\r\n\x1a\n\x00\xff")
    nothing = "run: expected an experiment (1, 2, 2-projected, 3, 4, 5) or a TOML file, got "
    for what, start in (
        (str(broken), f"{broken}: expected a TOML file, got Invalid value (at line 2"),
        (str(binary), f"{binary}: expected a TOML file in UTF-8, got byte 0x89 (at line 1, column 1)"),
        (str(tmp_path), f"{tmp_path}: expected a readable TOML file, got Is a directory"),
        (str(tmp_path / "none.toml"), f"{tmp_path / 'none.toml'}: expected a readable TOML file, got No such file"),
        (str(tmp_path / "none"), nothing),
        (str(broken / "below.toml"), f"{broken / 'below.toml'}: expected a readable TOML file, got Not a directory"),
        ("6", nothing + "'6'"),
        ("", nothing + "''"),
        ("a" * 5000, nothing + "'aaa"),
        ("2\0", nothing),
        ("a\0.toml", nothing),
    ):
        assert refused(what).startswith(start)


@pytest.mark.parametrize("depth", [70, 200, 400, 5000])
def test_settings_nested_without_end_are_refused(tmp_path, depth):
    deep = "[" * depth + "]" * depth
    refused("2", f"start.y={deep}")
    refused(written(tmp_path, f"experiment = 2\n[start]\ny = {deep}\n"))
    keys = ".".join(["start", *"a" * depth])
    refused("2", f"{keys}=1")


def test_an_empty_file_misses_everything(tmp_path):
    assert refused(written(tmp_path, "")).startswith("vehicle: expected a value")


# Any text at all ----------------------------------------------------------------------------------------------------

# Parts of keys that lead somewhere, beside any text; values likewise. What a flight needs stays small enough to build.
WORDS = [*KEYS, *SHAPES, "name", "gains", "base", "mass", "inertia", "rotor_positions", "rotor_spins", "rotor_limits",
         "k_d", "k_1", "speed_floor", "beta", "beta_floor"]  # fmt: skip
parts = st.sampled_from(WORDS) | st.text(max_size=6)
vehicles = st.sampled_from(["hehn2011", "nayak2018"])
names = st.sampled_from([*experiment_names(), *law_names(), "off", "regularized"])
numbers = st.integers(-(2**70), 2**70) | st.floats() | st.floats(0.1, 10)
entries = st.recursive(numbers | st.booleans() | st.text(max_size=4), lambda inner: st.lists(inner, max_size=4))
vectors = st.lists(st.sampled_from([0.0, 1.0, -1.0, 0.6, 0.8]), min_size=3, max_size=3)


def toml(value):
    """`value` in TOML, on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{toml(str(key))} = {toml(entry)}" for key, entry in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        plain = set(string.printable) - set(string.whitespace) - set('"\\') | {" "}
        return '"' + "".join(c if c in plain else f"\\U{ord(c):08x}" for c in value) + '"'
    return "nan" if isinstance(value, float) and math.isnan(value) else repr(value)


def flies_or_is_refused(what, overrides=()):
    try:
        chosen = run_file(what, overrides)
    except fp.InputError as error:
        in_one_line(error)
        return
    assert isinstance(chosen.flight, Flight)
    assert chosen.flight.duration > 0
    assert set(chosen.settings) <= set(KEYS)


texts = st.one_of(
    st.text(max_size=30),
    names,
    vehicles,
    entries.map(toml),
    vectors.map(toml),
    st.dictionaries(parts, numbers | vectors | names, max_size=3).map(toml),
    st.sampled_from(
        ["2020-01-01", "1979-05-27T07:32:00Z", "07:32:00", "0x1F", "1_000", "+inf", "'''a\nb'''", "1\n[start]"]
    ),
)
overrides = st.one_of(
    st.text(max_size=30), st.tuples(st.lists(parts, min_size=1, max_size=4).map(".".join), texts).map("=".join)
)


@settings(max_examples=500, deadline=None)
@given(st.sampled_from(experiment_names()), st.lists(overrides, max_size=3))
@example("2", ["vehicle=2020-01-01"])
@example("2", [f"law.gains.k_d={10**400}"])
@example("2", ["law.gains.k\x85d=1"])
def test_any_overrides_give_a_flight_or_one_line(name, overrides):
    flies_or_is_refused(name, overrides)


trees = st.dictionaries(
    st.sampled_from(KEYS) | st.text(max_size=4),
    st.recursive(
        numbers | names | vehicles | vectors | st.booleans() | entries,
        lambda inner: st.dictionaries(parts, inner, max_size=4),
        max_leaves=8,
    ),
    max_size=5,
)


@settings(max_examples=400, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(trees | trees.map(lambda tree: {"experiment": 2, **tree}))
@example({"experiment": 2, "vehicle": {"inertia": [10.0, 10.0, 10.0], "rotor_limits": [0.0, 1.0]}})
def test_any_file_of_settings_gives_a_flight_or_one_line(tmp_path, tree):
    text = "\n".join(f"{toml(key)} = {toml(value)}" for key, value in tree.items())
    assert repr(tomllib.loads(text)) == repr(tree)  # the file says what was meant
    flies_or_is_refused(written(tmp_path, text))


@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.binary(max_size=60) | st.text(max_size=60).map(lambda text: text.encode("utf-8", "surrogatepass")))
def test_any_file_at_all_gives_a_flight_or_one_line(tmp_path, content):
    path = tmp_path / "any.toml"
    path.write_bytes(content)
    flies_or_is_refused(str(path))


reals = st.floats() | st.integers(-(2**63), 2**63 - 1) | st.floats(0.01, 10)


def lists(n, entries=reals):
    return st.lists(entries, min_size=n, max_size=n)


machines = {
    **dict.fromkeys(("mass", "bob_mass", "rod_length", "gravity", "drag_ratio", "rotor_lag"), reals),
    "inertia": lists(3) | lists(3, lists(3)),
    "rotor_positions": lists(4, lists(3)),
    "rotor_spins": lists(4) | lists(4, st.sampled_from([1, -1])),
    "rotor_limits": lists(2),
}
starts = {name: lists(3, lists(3)) if name == "R" else lists(3) for name in SHAPES}
gains = dict.fromkeys(("k_d", "k_1", "k_2", "speed_floor", "beta_floor", "yaw_damping"), reals)


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(*(st.fixed_dictionaries({}, optional=optional) for optional in (machines, starts, gains)))
@example({}, {"y": [0.0, 0.0, 1e200]}, {})
@example({}, {"R": [[1e200, 1e200, 0.0], [1e200, -1e200, 0.0], [0.0, 0.0, 1.0]]}, {})
def test_any_numbers_give_a_flight_or_one_line(tmp_path, machine, start, gains):
    lines = (f"{name} = {toml(table)}\n" for name, table in (("vehicle", machine), ("start", start)))
    flies_or_is_refused(written(tmp_path, f"experiment = 1\n{''.join(lines)}law = {toml({'gains': gains})}\n"))


positive = st.floats(1e-3, 1e3)


@settings(max_examples=50, deadline=None)
@given(st.sampled_from(experiment_names()), positive, positive, st.floats(0.1, 10.0), vectors)
def test_what_is_in_range_arrives(name, duration, k_1, mass, x):
    chosen = flight(name, [f"duration={duration}", f"law.gains.k_1={k_1}", f"vehicle.mass={mass}", f"start.x={x}"])
    assert (chosen.duration, chosen.law.gains["k_1"], chosen.vehicle.mass) == (duration, k_1, mass)
    np.testing.assert_array_equal(chosen.starts.x, x)
    np.testing.assert_array_equal(chosen.starts.y, experiment(name).start.y)
    assert chosen.law.gains["k_2"] == experiment(name).gains["k_2"]


def test_a_plant_by_name_can_be_changed_in_one_number():
    plain = flight(SWING_UP, ["plant.lag=0.05", "plant.noise.x=0.01"]).plant
    assert (plain.lag, plain.noise.x, plain.rate) == (0.05, 0.01, 500.0)
    with pytest.raises(fp.InputError, match=r"^plant: expected a base with numbers, such as 'rotors', got the ideal"):
        flight("1", ["plant=ideal", "plant.lag=0.05"])


def test_a_floor_is_part_of_any_plant():
    assert flight(SWING_UP, ["plant.floor=-1.5"]).plant.floor == -1.5
    assert flight("1", ["plant=ideal", "plant.floor=-1.5"]).plant == fp.Ideal(floor=-1.5)
    for name in ("rotors", "ideal"):
        with pytest.raises(fp.InputError, match=r"^plant\.floor: expected a finite number m, got nan$"):
            flight(SWING_UP, [f"plant={name}", "plant.floor=nan"])


def test_motors_and_air_of_a_plant_arrive():
    overrides = [
        'plant.air=["rotor_drag", "lift"]', "plant.spin_up=1.5", "plant.sag=0.1", "plant.strength=[1, 1, 0.8, 1]",
        "plant.ground=-0.5", "vehicle.base=hehn2011", "vehicle.air.lift=0.01",
    ]  # fmt: skip
    chosen = flight("5", ["law.name=inverted", "law.gains={}", 'plant="rotors"', *overrides])
    assert chosen.plant == fp.Plant(
        air=("rotor_drag", "lift"), spin_up=1.5, sag=0.1, strength=(1, 1, 0.8, 1), ground=-0.5
    )
    assert chosen.vehicle.air == fp.vehicle("hehn2011").replace(air={"lift": 0.01}).air
    assert flight("5", ["vehicle=hehn2011", "plant.base=rotors", "plant.air=all"]).plant.air == ("all",)
    with pytest.raises(
        fp.InputError, match=r"^vehicle\.air: expected coefficients of the air, for plant\.air, got none$"
    ):
        flight("5", ["plant.base=rotors", "plant.air=all"])


def test_what_would_never_end_is_refused():
    with pytest.raises(fp.InputError, match=r"^duration: expected at most 20000 s, got 1e\+07$"):
        flight(SWING_UP, ["duration=1e7"])
    with pytest.raises(fp.InputError, match=r"^plant\.rate: expected at most 10000 Hz, got 1e\+06$"):
        flight(SWING_UP, ["plant.rate=1e6"])


def test_sensors_of_a_run_file_are_a_suite_or_a_table_on_top_of_one(tmp_path):
    text = '{experiment}\n[plant]\nbase = "rotors"\n[plant.sensors]\nbase = "mocap"\n[plant.sensors.rod]\nrate = 50\n'
    file = tmp_path / "run.toml"
    file.write_text(text.format(experiment='experiment = "1"'), encoding="utf-8")
    sensors = run_file(str(file)).flight.plant.sensors
    assert (sensors.rod.rate, sensors.rod.latency, sensors.position.rate) == (50, 0.01, 200.0)
    again = tomllib.loads(tomli_w.dumps({"sensors": sensors.to_dict()}))
    assert plant_of({"base": "rotors", **again}).sensors == sensors
    suite = run_file("1", ["plant=rotors", "plant.sensors=onboard"]).flight.plant.sensors
    assert suite == fp.Plant(sensors="onboard").sensors
    with pytest.raises(fp.InputError, match=r"plant\.sensors"):
        run_file("1", ["plant=rotors", "plant.sensors=offboard"])
