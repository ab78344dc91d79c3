"""The registry of gains: each law lists its own once, and everything that speaks of gains follows it."""

import dataclasses
import inspect

import numpy as np
import pytest

import flypend as fp
from flypend import errors
from flypend.export.interface import interface
from flypend.laws import law_from_dict, law_names
from flypend.laws.gain import POSITIVE, SHARE, Bounds, Gain, check_gains, document_gains, is_number, table

VEHICLE = fp.vehicle("hehn2011")
FACTORIES = {name: getattr(fp.laws, name) for name in law_names()}


@pytest.mark.parametrize("name", FACTORIES)
def test_the_defaults_lie_within_the_bounds_of_every_vehicle_here(name):
    law = FACTORIES[name]()
    for machine in ("hehn2011", "crazyflie", "nayak2018"):
        values = law.gains_for(fp.vehicle(machine))
        assert list(values) == list(law.gains)
        assert check_gains(law.gains, values) == values
        assert values == dict(law.bind(fp.vehicle(machine)).gains)


@pytest.mark.parametrize("name", FACTORIES)
def test_each_gain_says_what_it_is_and_the_docstring_says_it_too(name):
    law, text = FACTORIES[name](), inspect.getdoc(FACTORIES[name])
    assert "{gains}" not in text
    for gain in law.gains.values():
        assert gain.doc, gain.name
        assert "\n" not in gain.doc
        assert gain.doc[-1] != "."
        assert f"\n{gain.name} : " in text
        assert gain.describe() in text


def test_no_law_carries_attributes():
    for factory in FACTORIES.values():
        assert set(vars(factory)) <= {"__wrapped__"}  # of functools.wraps


@pytest.mark.parametrize("name", FACTORIES)
def test_the_c_header_says_of_each_gain_what_the_registry_says(name):
    law = FACTORIES[name]().bind(VEHICLE)
    for field in interface(law, VEHICLE).gains.fields:
        if field.name != "none":
            assert field.comment == law.table[field.name].describe()


def test_what_exported_code_fixes_is_marked_in_the_registry():
    law = fp.laws.inverted()
    assert law.fixed == law.bind(VEHICLE).fixed == ("pump_share",)
    assert [gain.name for gain in law.gains.values() if gain.fixed] == list(law.fixed)


@pytest.mark.parametrize(
    ("bounds", "inside", "outside"),
    [
        (POSITIVE, [1e-300, 1.0, 1e300], [0.0, -1.0, np.inf, np.nan]),
        (SHARE, [0.0, 0.5, 1.0], [-1e-12, 1 + 1e-12]),
        (Bounds(-1.0, 2.0), [-1.0, 2.0], [-1.001, 2.001]),
        (Bounds(), [-1e9, 0.0], [np.nan, -np.inf]),
    ],
)
def test_one_value_and_many_are_checked_alike(bounds, inside, outside):
    gain = Gain("k", 1.0, "m", bounds=bounds)
    for value in inside:
        assert gain.check(value) == value
    assert gain.check_all(inside).tolist() == inside
    for value in outside:
        with pytest.raises(fp.InputError, match=r"^k: expected "):
            gain.check(value)
        with pytest.raises(fp.InputError, match=r"^gains\.k: expected "):
            gain.check_all([*inside, value], "gains.k")


@pytest.mark.parametrize("value", [True, "1", None, [1.0, 2.0]])
def test_what_is_no_number_is_refused(value):
    with pytest.raises(fp.InputError, match=r"^k: expected a finite number"):
        Gain("k", 1.0).check(value)


def test_options_are_words_and_do_not_vary():
    gain = Gain("form", "full", choices=("full", "light"))
    assert gain.check("light") == "light"
    assert not gain.numeric
    with pytest.raises(fp.InputError, match=r"^form: expected one of full, light, got 'lihgt' \(did you mean 'light'"):
        gain.check("lihgt")
    with pytest.raises(fp.InputError, match=r"^form: expected nothing: only numbers may vary"):
        gain.check_all([1.0])
    with pytest.raises(fp.InputError, match=r"^mode: expected a word, got 3"):
        Gain("mode", "soft").check(3)


def test_gains_of_runs_are_checked_by_the_law():
    law = fp.laws.inverted()
    for thing in (law, law.bind(VEHICLE)):
        assert thing.check_gain("rod_damping", [0.3, 0.5]).tolist() == [0.3, 0.5]
        for name, values, message in (
            ("rod_damping", [0.5, 0.0], r"^gains\.rod_damping: expected a finite number > 0, got 0$"),
            ("pump_share", [0.0, 1.5], r"^gains\.pump_share: expected at most 1, got 1\.5$"),
            ("pump_share", ["a"], r"^gains\.pump_share: expected numbers"),
            ("rod_dampin", 1.0, r"^gains\.rod_dampin: expected one of .*did you mean 'rod_damping'"),
            ("form", "light", r"^gains\.form: expected one of position_bandwidth"),
        ):
            with pytest.raises(fp.InputError, match=message):
                thing.check_gain(name, values)
    with pytest.raises(fp.InputError, match=r"^vary\.gains\.k_d: expected a finite number > 0 1/s, got -1$"):
        fp.laws.corrected().check_gain("k_d", [1.0, -1.0], "vary.gains")


def test_an_ensemble_refuses_gains_of_runs_that_one_run_refuses():
    starts = fp.State.random(np.random.default_rng(0), 2)
    for plant in ("ideal", "rotors"):
        for values in ([0.5, -0.5], [np.nan, 0.5]):
            with pytest.raises(fp.InputError, match=r"^gains\.rod_damping: expected"):
                fp.simulate_ensemble(
                    VEHICLE, fp.laws.inverted(), starts, 0.1, plant=plant, gains={"rod_damping": values}
                )


def test_the_study_file_refuses_gains_out_of_bounds():
    base = {"vehicle": "nayak2018", "law": {"name": "corrected"}, "duration": 1.0, "start": {"y": [0, 0, 1]}}
    for vary in ({"from": -1.0, "to": 2.0}, {"values": [1.0, 0.0]}, {"from": 0.0, "to": 2.0, "points": 3}):
        with pytest.raises(fp.InputError, match=r"^vary\.gains\.k_d: expected a finite number > 0"):
            fp.study({**base, "vary": {"gains": {"k_d": vary}}})


def test_a_table_comes_from_records_and_from_values():
    found = table({"k": 2.0, "mode": "soft", "own": Gain("own", 3.0, bounds=POSITIVE)})
    assert [gain.name for gain in found.values()] == ["k", "mode", "own"]
    assert table([Gain("a", 1.0)])["a"].default == 1.0
    with pytest.raises(TypeError):
        found["k"] = Gain("k", 1.0)
    assert [is_number(value) for value in (1, 1.0, np.float64(1), True, "1", None)] == [True] * 3 + [False] * 3


def test_documented_fills_in_one_line_and_keeps_the_rest():
    @document_gains(table([Gain("k", 1.0, "m", "How far")]))
    def f():
        """First.

        {gains}

        Last.
        """

    assert inspect.getdoc(f) == "First.\n\nGains\n-----\nk : float, default 1.0\n    How far, m\n\nLast."


def test_documented_adds_sections_to_a_docstring_that_has_lost_its_indent():
    """As every docstring has from Python 3.13 on."""

    def f(reference=None, **gains):
        pass

    f.__doc__ = "First.\n\nMore.\n"
    text = inspect.getdoc(document_gains(table([Gain("k", 1.0, "m", "How far")]), " or far", ", smooth")(f))
    assert text.startswith("First.\n\nMore.\n\nParameters\n----------\nreference : callable, optional\n    Pivot")
    assert "function of time, smooth; default" in text
    assert "\n\nGains\n-----\nk : float, default 1.0\n    How far, m\n\nRaises\n------\nInputError\n" in text
    assert text.endswith("out of bounds or far.")
    assert errors.documentation_of(f, "reference").startswith("callable, optional: pivot position (3,), m, as")


# Law and BoundLaw ------------------------------------------------------------------------------------------------


def test_a_law_is_open_and_a_bound_law_has_every_value():
    law = fp.laws.inverted(rod_damping=0.5)
    assert (type(law).__name__, type(law.bind(VEHICLE)).__name__) == ("Law", "BoundLaw")
    assert dict(law.given) == {"rod_damping": 0.5}
    assert "rod_bandwidth" not in law.values  # it is for the vehicle to say
    assert law.values["rod_damping"] == 0.5
    assert not hasattr(law, "evaluate")
    bound = law.bind(VEHICLE)
    assert bound.vehicle is VEHICLE
    assert bound.options == {"form": "full"}
    assert set(bound.numbers) == set(bound.gains) - {"form"}
    with pytest.raises(TypeError):
        bound.gains["rod_damping"] = 1.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        bound.name = "other"


def test_gains_are_replaced_and_checked_and_the_rest_stays():
    law = fp.laws.corrected(k_d=2.0)
    other = law.with_gains({"k_1": 7})
    assert (other.values["k_d"], other.values["k_1"], law.values["k_1"]) == (2.0, 7.0, 9.0)
    with pytest.raises(fp.InputError, match=r"^law\.gains\.k_3: expected one of k_d"):
        law.with_gains({"k_3": 1.0}, "law.gains")
    with pytest.raises(fp.InputError, match=r"^k_1: expected a finite number > 0 1/s², got 0$"):
        law.with_gains({"k_1": 0})


def test_the_law_converts_frames_once():
    import casadi as ca

    from flypend.model.state import SIZE

    state = fp.State.random(np.random.default_rng(1))
    t, packed = ca.SX.sym("t"), ca.SX.sym("s", SIZE)
    for law in (fp.laws.inverted(), fp.laws.corrected()):
        bound = law.bind(VEHICLE)
        up = ca.Function("up", [t, packed], [bound.upright(t, packed)])(0.0, state.packed())
        own = state if law.e3 == "up" else state.flipped()
        wrench = bound.evaluate(t, fp.State.symbolic(packed), VEHICLE).wrench
        values = ca.Function("own", [t, packed], [ca.vertcat(wrench.thrust, wrench.moment)])(0.0, own.packed())
        values = np.array(values).ravel()
        told = fp.Wrench(values[0], values[1:]) if law.e3 == "up" else fp.Wrench(values[0], values[1:]).flipped()
        np.testing.assert_allclose(np.array(up).ravel(), [told.thrust, *told.moment], rtol=1e-12, atol=1e-12)


def test_the_time_of_a_law_may_be_an_expression():
    import casadi as ca

    from flypend.laws.references import circle
    from flypend.model.state import SIZE

    bound, state = fp.laws.inverted(circle()).bind(VEHICLE), fp.State(y=(0, 0, 1))
    t, packed = ca.SX.sym("t"), ca.SX.sym("s", SIZE)
    now = ca.Function("now", [t, packed], [bound.upright(t, packed)])
    later = ca.Function("later", [t, packed], [bound.upright(t + 0.25, packed)])
    np.testing.assert_array_equal(now(0.75, state.packed()), later(0.5, state.packed()))
    assert np.any(np.array(now(0.75, state.packed())) != np.array(now(0.5, state.packed())))


def test_a_law_by_table_knows_the_names_of_the_registry():
    for name, factory in FACTORIES.items():
        for gain in factory().gains.values():
            if gain.choices:
                made = law_from_dict({"name": name, "gains": {gain.name: gain.choices[-1]}})
                assert made.values[gain.name] == gain.choices[-1]
