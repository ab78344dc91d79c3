"""A law of one's own from a function: symbols where it can be, numbers where not, mistakes in one line."""

import pickle

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.laws import Controller, Gain, Law, LawError, from_function
from flypend.laws.bound import Control
from flypend.laws.gain import POSITIVE

VEHICLE = fp.vehicle("hehn2011")
START = fp.State(y=(0.1, 0.0, np.sqrt(0.99)), omega=(0.1, -0.2, 0.3))


def symbolic(t, state, vehicle, *, lift=1.0, brake=0.1):
    return fp.Wrench(lift * vehicle.weight, -brake * state.omega)


def numeric(t, state, vehicle, *, lift=1.0, brake=0.1):
    thrust = lift * vehicle.weight
    if state.x[2] > 1e3:
        thrust = 0.0
    return fp.Wrench(thrust, -brake * np.asarray(state.omega))


def downwards(t, state, vehicle, *, lift=1.0, brake=0.1):
    return fp.Wrench(-lift * vehicle.weight, -brake * state.omega)


def test_symbols_make_a_law_and_numbers_a_controller():
    law, controller = from_function(symbolic), from_function(numeric)
    assert (type(law), law.name, law.e3) == (Law, "symbolic", "up")
    assert (type(controller), controller.name) == (Controller, "numeric")
    assert "casadi.if_else" in controller.because
    assert f"test_own.py:{numeric.__code__.co_firstlineno + 2}" in controller.because
    assert law.values == dict(controller.gains) == {"lift": 1.0, "brake": 0.1}


@pytest.mark.parametrize("gains", [{}, {"lift": 1.1, "brake": 0.05}])
def test_both_fly_alike_with_the_gains_given(gains):
    runs = [
        fp.simulate(VEHICLE, from_function(f).with_gains(gains), START, 0.5, plant="rotors")
        for f in (symbolic, numeric)
    ]
    np.testing.assert_allclose(runs[0].x, runs[1].x, atol=1e-9)
    assert dict(runs[0].gains) == dict(runs[1].gains) == {"lift": 1.0, "brake": 0.1, **gains}
    plain = fp.simulate(VEHICLE, from_function(numeric), START, 0.5, plant="rotors")
    assert np.allclose(runs[1].x, plain.x) == (not gains)  # negative control


def test_a_law_with_e3_down_flies_the_same():
    up = fp.simulate(VEHICLE, from_function(symbolic), START, 0.5, plant="rotors")
    down = fp.simulate(VEHICLE, from_function(downwards, e3="down"), START.flipped(), 0.5, plant="rotors").flipped()
    np.testing.assert_allclose(up.x, down.x, atol=1e-9)


def test_gains_of_its_own_may_have_units_and_bounds():
    law = from_function(symbolic, gains=[Gain("brake", 0.1, "N m s", "Brake", POSITIVE)])
    with pytest.raises(fp.InputError, match=r"^brake: expected a finite number > 0 N m s, got 0$"):
        law.with_gains({"brake": 0})
    with pytest.raises(fp.InputError, match=r"^law: expected a gain among the arguments of symbolic, got grip$"):
        from_function(symbolic, gains=[Gain("grip", 1.0)])


def test_gains_of_a_symbolic_law_vary_from_run_to_run():
    starts = fp.State.random(np.random.default_rng(0), 3)
    lifts = np.array([0.9, 1.0, 1.1])
    runs = fp.simulate_ensemble(VEHICLE, from_function(symbolic), starts, 0.3, plant="rotors", gains={"lift": lifts})
    for i, lift in enumerate(lifts):
        law = from_function(symbolic).with_gains({"lift": lift})
        single = fp.simulate(VEHICLE, law, starts[i], 0.3, plant="rotors")
        final = runs.final[i].packed() if isinstance(runs.final, fp.State) else runs.final[i]
        np.testing.assert_allclose(final, single.states.packed()[-1], atol=1e-9)


# Forms -----------------------------------------------------------------------------------------------------------


def test_the_forms_of_the_first_version_go_on():
    old = from_function(lambda t, state, vehicle, gains: fp.Wrench(vehicle.weight, 0 * state.omega), name="old")
    assert (type(old), old.name) == (Law, "old")
    plain = from_function(lambda t, state: fp.Wrench(1.0, np.zeros(3)))
    assert isinstance(plain, Controller)
    assert plain.bind(VEHICLE).function(0.0, START).thrust == 1.0
    short = from_function(lambda _, s, v, k: fp.Wrench(v.weight, 0 * s.omega))
    assert isinstance(short, Law)


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (lambda a, b: None, r"a function of \(t, state, vehicle, .*got <lambda> of \(a, b\)"),
        (lambda t, state, vehicle, force: None, r"got <lambda> of \(t, state, vehicle, force\)"),
        (lambda state, t, vehicle: None, r"got <lambda> of \(state, t, vehicle\)"),
        (lambda t, state, vehicle, gains, _: None, r"got <lambda> of \(t, state, vehicle, gains, _\)"),
    ],
)
def test_arguments_go_by_their_names(function, words):
    with pytest.raises(fp.InputError, match=words):
        from_function(function)


def test_gains_need_defaults_that_are_numbers_or_words():
    def bare(t, state, vehicle, *, k):
        """No default."""

    def flag(t, state, vehicle, *, k=True):
        """A flag."""

    def both(t, state, vehicle, gains, *, k=1.0):
        """Two ways."""

    for function, words in (
        (bare, "a default for every gain, got bare without one for k"),
        (flag, "gains that are numbers or words, got flag with k = True"),
        (both, "got both, which has gains and an argument for them"),
    ):
        with pytest.raises(fp.InputError, match=words):
            from_function(function)


# Mistakes --------------------------------------------------------------------------------------------------------


def misspelt(t, state, vehicle):
    return fp.Wrench(vehicle.weight, state.omga)


def silent(t, state, vehicle):
    return None


def short(t, state, vehicle):
    return fp.Wrench(vehicle.weight, np.zeros(2))


def late(t, state, vehicle):
    if t > 0.1:
        return fp.Wrench(1 / 0, np.zeros(3))
    return fp.Wrench(vehicle.weight, np.zeros(3))


@pytest.mark.parametrize(
    ("function", "line", "words"),
    [
        (misspelt, 1, "AttributeError: 'State' object has no attribute 'omga' (did you mean 'omega'?)"),
        (silent, 0, "it returns NoneType, not a Wrench: return flypend.Wrench(thrust, moment)"),
        (short, 1, "wrench.moment: expected three numbers, N m, got shape (2,)"),
    ],
)
def test_a_mistake_is_one_line_with_file_and_line(function, line, words):
    with pytest.raises(LawError) as caught:
        from_function(function)
    text = str(caught.value)
    assert f"test_own.py:{function.__code__.co_firstlineno + line}: {words} (in the law {function.__name__})" in text
    assert "\n" not in text
    assert str(pickle.loads(pickle.dumps(caught.value))) == text


def test_a_signal_is_one_number():
    def control(t, state, vehicle, gains):
        return Control(wrench=fp.Wrench(vehicle.weight, 0 * state.omega), signals={"error": state.x})

    with pytest.raises(LawError, match=r"its signal error is not one number, but of shape \(3, 1\)"):
        Law(name="mine", e3="up", gains=(), control=control).bind(VEHICLE).try_out()


def test_a_mistake_in_flight_is_told_alike():
    law = from_function(late)
    assert isinstance(law, Controller)
    with pytest.raises(LawError, match=rf"test_own\.py:{late.__code__.co_firstlineno + 2}: ZeroDivisionError"):
        fp.simulate(VEHICLE, law, START, 0.3, plant="rotors")
    starts = fp.State.random(np.random.default_rng(0), 2)
    with pytest.raises(LawError, match="ZeroDivisionError"):
        fp.simulate_ensemble(VEHICLE, law, starts, 0.3, plant="rotors", workers=1)


def test_symbols_that_say_something_else_than_numbers_make_a_controller():
    def split(t, state, vehicle):
        return fp.Wrench(vehicle.weight * (1 if isinstance(t, ca.SX) else 2), 0 * state.omega)

    law = from_function(split)
    assert isinstance(law, Controller)
    assert law.because == "its symbols do not say what its numbers say"


def test_functions_of_casadi_that_take_no_numbers_make_a_law():
    def cases(t, state, vehicle):
        return fp.Wrench(ca.if_else(state.x[2] > 0, 1.0, 2.0) * vehicle.weight, ca.SX.zeros(3) * t)

    assert isinstance(from_function(cases), Law)


def test_what_cannot_be_exported_says_where_and_why(tmp_path):
    with pytest.raises(fp.InputError, match="law"):
        fp.export_c(from_function(numeric), VEHICLE, tmp_path / "c")
    assert not list(tmp_path.iterdir())
    fp.export_c(from_function(symbolic), VEHICLE, tmp_path / "c", check=False)
    assert "lift" in (tmp_path / "c" / "flypend_law.h").read_text(encoding="ascii")


def hang_or_stand(t, state, vehicle):
    return fp.Wrench(vehicle.weight * (1.5 if float(state.y[2]) < 0 else 1.0), np.zeros(3))


def wait(t, state, vehicle):
    return fp.Wrench(vehicle.weight * (1.5 if float(t) > 1 else 1.0), np.zeros(3))


def hide(t, state, vehicle):
    try:
        far = bool(state.x[2] > 0.5)
    except Exception:
        far = False
    return fp.Wrench(vehicle.weight * (1.5 if far else 1.0), np.zeros(3))


class Integral:
    total = 0.0

    def __call__(self, t, state, vehicle):
        self.total += 0.002 * (0.5 - state.x[2])
        return fp.Wrench(vehicle.weight * (1 + self.total), np.zeros(3))


@pytest.mark.parametrize("law", [hang_or_stand, wait, hide, Integral()])
def test_a_law_that_symbols_do_not_say_is_not_compiled(law):
    """float() of a symbol is NaN in CasADi: a branch on it would be lost without a word."""
    made = fp.laws.from_function(law, name="mine")
    assert isinstance(made, fp.Controller)
    if law is hang_or_stand:
        run = fp.simulate(fp.vehicle("hehn2011"), made, fp.State(y=(0, 0, -1)), 0.1, plant="ideal")
        assert run.thrust[5] == pytest.approx(1.5 * run.vehicle.weight)


def test_a_reference_that_branches_on_the_time_is_refused():
    with pytest.raises(fp.InputError, match="reference"):
        fp.laws.inverted(reference=lambda t: ca.vertcat(1.0 if float(t) > 1 else 0.0, 0, 0))
