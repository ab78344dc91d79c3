"""Laws from what people write: names, modules, files, tables; and one line for everything that is wrong with them."""

import re
import sys

import cloudpickle
import numpy as np
import pytest

import flypend as fp
from flypend.laws import Controller, Law, LawError
from flypend.laws.learned import policy, save
from flypend.laws.own import fingerprint
from flypend.settings.laws import absolute, law_from, law_named, note, relative, table_of

VEHICLE = fp.vehicle("hehn2011")
START = fp.State(y=(0.1, 0.0, np.sqrt(0.99)))

TEXT = """
import numpy as np
import flypend as fp

def balance(t, state, vehicle, *, lift=1.0, mode="soft"):
    return fp.Wrench(lift * vehicle.weight, -0.1 * state.omega)

def numeric(t, state, vehicle, *, lift=1.0):
    if state.x[2] > 5:
        return fp.Wrench(0.0, np.zeros(3))
    return fp.Wrench(lift * vehicle.weight, -0.1 * np.asarray(state.omega))

def down(t, state, vehicle, *, lift=1.0):
    return fp.Wrench(-lift * vehicle.weight, -0.1 * state.omega)

made = fp.laws.from_function(down, e3="down")

def maker():
    return fp.Law(name="made", e3="up", control=lambda t, s, v, k: fp.Wrench(k.f * v.weight, 0 * s.omega),
                  gains={"f": 1.0})

def broken_maker():
    return 1 / 0

def bare(t, state, vehicle, *, k): return None

late = fp.Law(name="late", e3="up", control=lambda t, s, v, k: fp.Wrench(v.weight, s.omga))
steers = fp.Controller(name="steers", function=lambda t, s: fp.Wrench(1.0, s.omga))
number = 3.0
"""


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A current folder with laws in laws/mine.py."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    (tmp_path / "laws").mkdir()
    (tmp_path / "laws" / "mine.py").write_text(TEXT, encoding="utf-8")
    (tmp_path / "laws" / "text.npz").write_text("no policy", encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    ("name", "kind", "called"),
    [("balance", Law, "balance"), ("numeric", Controller, "numeric"), ("made", Law, "down"), ("maker", Law, "made")],
)
def test_a_law_from_a_file(here, name, kind, called):
    law = law_named(f"laws/mine.py:{name}")
    assert (type(law), law.name) == (kind, called)
    assert law.e3 == ("down" if name == "made" else "up")
    start = START if law.e3 == "up" else START.flipped()
    assert fp.simulate(VEHICLE, law, start, 0.05, plant="rotors").outcome.status == "completed"
    assert not [name for name in sys.modules if "flypend_law_" in name]


def test_a_path_is_taken_from_the_folder_given(here, monkeypatch, tmp_path_factory):
    monkeypatch.chdir(tmp_path_factory.mktemp("elsewhere"))
    assert law_from({"function": "mine.py:balance"}, here / "laws").name == "balance"
    table = absolute({"function": "mine.py:balance", "gains": {"lift": 2.0}}, here / "laws")
    assert table == {"function": f"{here / 'laws' / 'mine.py'}:balance", "gains": {"lift": 2.0}}
    assert law_from(table).values["lift"] == 2.0
    assert absolute("mine.py:balance", here / "laws") == table["function"]
    for kept in ("inverted", "module:balance", {"name": "lqr"}, {"function": "module:balance"}):
        assert absolute(kept, here) == kept
    with pytest.raises(fp.InputError, match=r"^law\.function: expected a file that is there, got 'mine\.py' in "):
        law_from({"function": "mine.py:balance"})


def test_gains_and_frame_stand_in_the_table(here):
    law = law_from({"function": "laws/mine.py:balance", "gains": {"lift": 1.5, "mode": "hard"}})
    assert law.bind(VEHICLE).gains == {"lift": 1.5, "mode": "hard"}
    assert law_from({"function": "laws/mine.py:down", "e3": "down"}).e3 == "down"
    assert law_from({"function": "laws/mine.py:numeric", "gains": {"lift": 2}}).bind(VEHICLE).gains == {"lift": 2.0}
    assert law_from(table_of("laws/mine.py:balance")).name == "balance"
    assert law_from(table_of("lqr")).name == "lqr"
    assert law_from(law) is law


def test_a_policy_is_a_law_of_its_own_name(here):
    save(policy("hehn2011-hub"), here / "laws" / "mine.npz")
    law = law_from({"function": "mine.npz", "gains": {"lead": 1.5}}, here / "laws")
    assert (law.name, law.given["lead"]) == ("mine", 1.5)
    own, hub = (each.bind(VEHICLE).prepared["network"] for each in (law, law_named("learned")))
    assert own.size == policy("hehn2011-hub").size != hub.size
    assert absolute("mine.npz", here / "laws") == str(here / "laws" / "mine.npz")
    table = {"name": "learned", "gains": {"policy": "mine.npz"}}
    assert absolute(table, here / "laws")["gains"]["policy"] == str(here / "laws" / "mine.npz")
    assert relative(absolute(table, here / "laws"), here / "laws") == table
    usual = {"name": "learned", "gains": {"policy": "hehn2011"}}
    assert absolute(usual, here) == usual
    assert table_of("laws/mine.npz") == {"function": "laws/mine.npz"}


def test_other_processes_are_sent_a_law_of_a_file(here):
    for name in ("balance", "numeric"):
        law = cloudpickle.loads(cloudpickle.dumps(law_named(f"laws/mine.py:{name}")))
        assert fp.simulate(VEHICLE, law, START, 0.02, plant="rotors").outcome.status == "completed"
    starts = fp.State.random(np.random.default_rng(0), 9)  # more than one task
    two, one = (
        fp.simulate_ensemble(VEHICLE, law_named("laws/mine.py:numeric"), starts, 0.05, plant="rotors", workers=workers)
        for workers in (2, 1)
    )
    np.testing.assert_array_equal(two.end, one.end)
    np.testing.assert_array_equal(two.excursion, one.excursion)


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("laws/mine.py:balanse", "--law: expected one of balance, numeric, .*got 'balanse' (did you mean 'balance'?)"),
        ("laws/none.py:f", "--law: expected a file that is there, got 'laws/none.py' in "),
        ("laws/mine.py:", "--law: expected file.py:function or module:function, got 'laws/mine.py:'"),
        (
            "laws/mine.py",
            "--law: expected file.py:function, module:function or a file .onnx or .npz, got 'laws/mine.py'",
        ),
        ("laws/mine.py:number", "--law: expected a Law, a Controller, a function that makes one, or "),
        ("laws/mine.py:bare", "--law: expected a default for every gain, got bare without one for k"),
        ("laws/mine.py:broken_maker", "laws/mine.py:23: ZeroDivisionError: division by zero (in the law broken_maker)"),
        ("no_such_module:f", "--law: expected a module that can be imported, got 'no_such_module'"),
        ("no-module:f", "--law: expected a module that can be imported, or a file that ends in .py, got 'no-module'"),
        ("invertd", "--law: expected one of printed, .*got 'invertd' (did you mean 'inverted'?)"),
        ("laws/none.npz", "policy: expected a file written by `flypend learn`, got "),
        ("laws/text.npz", "policy: expected a file written by `flypend learn`, got "),
        (3, "law: expected the name of a law, or a table, got 3"),
        (
            {"function": "laws/mine.py"},
            "law.function: expected file.py:function, module:function or a file .onnx or .npz, got ",
        ),
        ({"function": ["x"]}, "law.function: expected file.py:function, module:function or a file .onnx or .npz, got "),
        ({"function": "laws/mine.py:balance", "gains": 3}, "law.gains: expected a table of gains, got 3"),
        ({"name": "detuned", "gains": 3}, "law.gains: expected a table of gains, got 3"),
        ({"function": "laws/mine.py:balance", "gains": {"lif": 1}}, "law.gains.lif: expected one of lift, mode, got"),
        ({"function": "laws/mine.py:balance", "gains": {"lift": "x"}}, "law.gains.lift: expected a finite number, got"),
        ({"function": "laws/mine.py:balance", "gains": {"mode": 1}}, "law.gains.mode: expected a word, got 1"),
        ({"function": "laws/mine.py:balance", "e3": "left"}, "law.e3: expected one of up, down, got 'left'"),
        ({"function": "laws/mine.py:made", "e3": "up"}, "law.e3: expected nothing: laws/mine.py:made states its own"),
        (
            {"function": "laws/mine.py:balance", "name": "a"},
            "law.name: expected one of function, gains, e3, got",
        ),
        ({"name": "laws/mine.py:balance"}, "law.name: expected one of printed"),
    ],
)
def test_what_is_wrong_is_one_line(here, value, message):
    with pytest.raises(fp.InputError) as caught:
        law_named(value) if isinstance(value, str) else law_from(value)
    text = str(caught.value)
    head, _, tail = message.partition(".*")
    assert text.startswith(head), text
    assert tail in text, text
    assert "\n" not in text


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("def f(:\n    pass\n", "bad.py:1: SyntaxError: invalid syntax"),
        ("x = 1\n\ny = z\n", "bad.py:3: NameError: name 'z' is not defined"),
        ("import no_such_thing\n", "bad.py:1: ModuleNotFoundError: No module named 'no_such_thing'"),
        ("def g():\n    raise OSError('a\\nb')\n\ng()\n", "bad.py:2: OSError: a b"),
        ("\0", "bad"),
    ],
)
@pytest.mark.parametrize("how", ["file", "module"])
def test_what_cannot_be_loaded_names_its_line(here, text, message, how):
    (here / "bad.py").write_text(text, encoding="utf-8")
    for _ in range(2):  # nothing half-loaded stays
        with pytest.raises(LawError) as caught:
            law_named("bad.py:f" if how == "file" else "bad:f")
        assert str(caught.value).startswith(message)
        assert "\n" not in str(caught.value)


def test_a_law_that_no_kernel_flies_is_told_in_one_line(here):
    said = note(law_named("laws/mine.py:numeric"))
    assert re.fullmatch(r"numeric is not written in symbols: .*, laws/mine\.py:9\. It flies step by step .*\.", said)
    assert note(law_named("laws/mine.py:balance")) == note(law_named("lqr")) == ""


def test_the_fingerprint_of_a_controller_changes_with_text_and_gains(here):
    path = here / "laws" / "mine.py"
    law = law_named("laws/mine.py:numeric")
    assert fingerprint(law) == fingerprint(law_named("laws/mine.py:numeric")) == fingerprint(law.bind(VEHICLE))
    assert fingerprint(law) != fingerprint(law.with_gains({"lift": 2.0}))
    before = fingerprint(law)
    path.write_text(TEXT.replace("> 5", "> 6"), encoding="utf-8")
    assert fingerprint(law_named("laws/mine.py:numeric")) != before


def test_the_fingerprint_of_a_controller_changes_with_what_it_reads(tmp_path):
    weights, rng = tmp_path / "weights.txt", np.random.default_rng(0)

    def reads(t, state):
        return fp.Wrench(float(weights.read_text()) * float(state.y[2]), np.zeros(3))

    def guesses(t, state):
        return fp.Wrench(rng.normal(), np.zeros(3))

    found = []
    for text in ("1.0", "1.0", "1.5"):
        weights.write_text(text)
        found.append(fingerprint(fp.Controller(name="reads", function=reads)))
    assert found[0] == found[1] != found[2]
    assert len({fingerprint(fp.Controller(name="guesses", function=guesses)) for _ in range(2)}) == 1


@pytest.mark.parametrize("name", ["late", "steers"])
def test_a_mistake_in_a_ready_law_is_located_too(here, name):
    law = law_named(f"laws/mine.py:{name}")
    with pytest.raises(LawError, match=r"^laws/mine\.py:\d+: AttributeError: .*omga' \(did you mean 'omega'\?\) \(in "):
        fp.simulate(VEHICLE, law, START, 0.05, plant="rotors")


def test_a_file_is_read_again_and_may_import_its_neighbours(here):
    (here / "laws" / "beside_law.py").write_text("LIFT = 1.25\n", encoding="utf-8")
    text = (
        "import flypend as fp\nfrom beside_law import LIFT\n"
        "def f(t, state, vehicle, *, lift=LIFT):\n    return fp.Wrench(lift * vehicle.weight, 0 * state.omega)\n"
    )
    (here / "laws" / "new.py").write_text(text, encoding="utf-8")
    assert law_named("laws/new.py:f").values == {"lift": 1.25}
    (here / "laws" / "new.py").write_text(text.replace("lift=LIFT", "lift=2.5"), encoding="utf-8")
    assert law_named("laws/new.py:f").values == {"lift": 2.5}


def test_a_file_may_load_another_of_the_same_name(here):
    (here / "mine.py").write_text(
        "from flypend.settings.laws import law_named\nlaw = law_named('laws/mine.py:balance')\n", encoding="utf-8"
    )
    assert law_named("mine.py:law").name == "balance"


@pytest.mark.parametrize("name", ["nmpc", "plan"])
def test_constraints_of_plans_come_from_a_table(name, tmp_path):
    (tmp_path / "limits.py").write_text("def low(m):\n    return 2 - m.x[2]\n")
    window = {"centre": [0.5, 0.0, 0.0], "width": 1.0, "height": 0.8}
    given = {"name": name, "floor": -2.0, "box": [[-3, -3, -3], [3, 3, 3]], "window": window, "keep": "limits.py:low"}
    found, there = law_from(given, tmp_path), law_from(absolute(given, tmp_path))
    if name == "nmpc":
        kept, again = (law.flight_computer.constraints for law in (found, there))
        assert kept.walls[0].tolist() == [-3, -3, -2]
        assert (kept.windows[0].width, kept.windows[0].height) == (1.0, 0.8)
        for each in (kept, again):
            assert each.keep(fp.State(x=(0, 0, 0.5), y=(0, 0, 1))) == 1.5
    assert relative(absolute(given, tmp_path), tmp_path) == given


@pytest.mark.parametrize(
    ("table", "line"),
    [
        ({"flor": -1}, "did you mean 'floor'"), ({"floor": "low"}, "floor: expected"), ({"path": 3}, "path: expected"),
        ({"window": 3}, "law.window: expected a table"), ({"window": {"width": 1}}, "law.window: expected a centre"),
        ({"window": {"centre": [0, 0, 0], "width": 1, "hight": 1}}, "did you mean 'height'"),
        ({"keep": "limits"}, "law.keep: expected one of x, x_dot"),
        ({"keep": "no_such:low"}, "law.keep: expected a module"), ({"keep": 3}, "law.keep: expected an expression"),
        ({"cost": "x[0] < 1"}, "law.cost: expected values"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("name", ["nmpc", "plan"])
def test_wrong_constraints_in_a_table_are_named(name, table, line):
    with pytest.raises(fp.InputError, match=line):
        law_from({"name": name, **table})
