"""The exported law against the Python one: numbers, refusals, and what does not depend on the export."""

import os
import subprocess
import sys
from itertools import pairwise

import casadi as ca
import numpy as np
import pytest
from boards import hexarotor
from numpy.random import default_rng

import flypend as fp
from flypend.export import records, vectors
from flypend.export.interface import interface
from flypend.export.library import Library, library
from flypend.laws import Control, Law
from flypend.laws.references import lemniscate
from flypend.laws.throw import derivatives
from flypend.model import Wrench
from flypend.model.allocation import allocate
from tests.few import slow

VEHICLE = fp.vehicle("hehn2011")
INVERTED = fp.laws.inverted().bind(VEHICLE)


def _layers(*sizes):
    """Weights of a policy, one layer with each activation that training libraries offer first."""
    shapes = list(pairwise(sizes))
    rng, kinds = default_rng(5), ("tanh", "elu", "sigmoid", "identity")
    return [
        (rng.normal(0, 0.3, (n, k)), rng.normal(0, 0.1, n), kind) for (k, n), kind in zip(shapes, kinds, strict=True)
    ]


LAWS = {
    "inverted": INVERTED,
    "light": fp.laws.inverted(form="light").bind(VEHICLE),
    "corrected": fp.laws.corrected().bind(VEHICLE),
    "printed": fp.laws.printed().bind(VEHICLE),
    "lqr": fp.laws.lqr().bind(VEHICLE),
    "repaired": fp.laws.repaired().bind(VEHICLE),
    "almost_global": fp.laws.almost_global().bind(VEHICLE),
    "trained": fp.laws.trained(_layers(24, 16, 16, 12, 4)).bind(VEHICLE),
}
OK, NULL, NOT_FINITE, ROD, ATTITUDE, PARAMS, SINGULAR, WRONG_VEHICLE = range(8)


def _apart(found, wanted, scale):
    """Largest difference of rows over their length, or `scale` if that is more."""
    size = np.maximum(np.linalg.norm(wanted, axis=1), scale)
    return float(np.max(np.linalg.norm(found - wanted, axis=1) / size))


# Numbers --------------------------------------------------------------------------------------------------------


# Largest relative error of rounding to float.
ROUNDING = 2.0**-24


def _errors(answer, wanted):
    """Relative errors of thrust, moment and rotor forces, each (n,): over their length, or hover's if that is more."""
    thrust, moment = vectors.scales(VEHICLE)
    split = [
        (answer[0][:, :1], wanted.wrench[:, :1], thrust),
        (answer[0][:, 1:], wanted.wrench[:, 1:], moment),
        (answer[1], wanted.rotors, thrust),
    ]
    return np.array(
        [
            np.linalg.norm(found - right, axis=1) / np.maximum(np.linalg.norm(right, axis=1), scale)
            for found, right, scale in split
        ]
    )


def _float_errors_allowed(law, wanted, seed):
    """The errors, as of `_errors`, that float arithmetic may have at each state.

    Where the force demanded passes through zero, the thrust axis's target turns by a radian within 1 mm/s of the bob's
    speed: any float code is wrong there by as much as the law itself moves when its inputs are rounded. Four random
    roundings sample that; the law's own roundings, some hundreds, act like a few of the inputs' and add to the last
    digits. Over 10⁵ states the largest error is 7 times the sum, one in a thousand is above 2.5 times.
    """
    rng, answers = np.random.default_rng(seed + 100), vectors.answers(law, VEHICLE)
    moved = np.zeros((3, len(wanted.state)))
    for _ in range(4):
        inputs = (v * (1 + ROUNDING * rng.choice([-1, 1], v.shape)) for v in (wanted.state, wanted.reference))
        answer = [np.array(value).T for value in answers(*(v.T for v in inputs))]
        moved = np.maximum(moved, _errors(answer, wanted))
    return 8 * ROUNDING + moved


@pytest.mark.parametrize(
    ("name", "precision", "seeds"),
    [
        ("inverted", "double", 4), ("inverted", "float", 1), ("light", "double", 1), ("corrected", "float", 1),
        ("lqr", "float", 1), ("trained", "double", 1), slow("inverted", "float", 4), slow("light", "float", 1),
        slow("corrected", "double", 1), slow("lqr", "double", 1), slow("trained", "float", 1),
    ],
)  # fmt: skip
def test_100_000_random_states_agree_with_python(name, precision, seeds):
    """The first of the laws; a quarter of that for the others, and for single precision, which is held against more."""
    law, count = LAWS[name], 100_000 // 4
    for seed in range(seeds):
        wanted = vectors.vectors(law, VEHICLE, count, seed, precision)
        wrench, rotors, status = library(law, VEHICLE, precision).step(wanted.state, wanted.reference)
        assert not np.any(status)
        allowed = 1e-12 if precision == "double" else 14 * _float_errors_allowed(law, wanted, seed)
        assert np.all(_errors((wrench, rotors), wanted) < allowed)
        # Far from constant: the law is in use over all of its range.
        assert np.ptp(wanted.wrench[:, 1]) > 1e-2 * vectors.scales(VEHICLE)[1]


@pytest.mark.parametrize(
    "gain", ["rod_bandwidth", "rod_damping", "attitude_bandwidth", "rate_feedforward", "coast_time"]
)
def test_a_gain_wrong_by_a_ten_thousandth_is_more_than_a_rounding(gain):
    wrong = fp.laws.inverted(**{gain: INVERTED.numbers[gain] * (1 + 1e-4)}).bind(VEHICLE)
    wanted = vectors.vectors(wrong, VEHICLE, 1000, 0, "float")
    wrench, rotors, _ = library(INVERTED, VEHICLE, "float").step(wanted.state, wanted.reference)
    caught = _errors((wrench, rotors), wanted) > 14 * _float_errors_allowed(wrong, wanted, 0)
    assert np.mean(np.any(caught, axis=0)) > 0.1


@pytest.mark.parametrize("name", ["repaired", "almost_global"])
def test_laws_with_a_barrier_agree_with_python_as_far_as_it_lets_them(name):
    # Next to an exceptional set 1/(1 + c) amplifies the last bit of 1 + c: by 1e4 at one random state in a thousand.
    law = LAWS[name]
    wanted = vectors.vectors(law, VEHICLE, 10_000, 0, "double")
    wrench, rotors, status = library(law, VEHICLE, "double").step(wanted.state, wanted.reference)
    assert not np.any(status)
    for found, right, scale in zip(
        (wrench, rotors), (wanted.wrench, wanted.rotors), vectors.scales(VEHICLE), strict=True
    ):
        apart = np.linalg.norm(found - right, axis=1) / np.maximum(np.linalg.norm(right, axis=1), scale)
        assert np.quantile(apart, 0.999) < 1e-12
        assert np.max(apart) < 1e-9


def test_the_vectors_are_the_law_of_python_along_a_reference():
    # `vectors` and the C code share their streamed reference; here Python has the reference as a function of time.
    reference, t = lemniscate(0.4, 1.1, center=(0.1, 0.2, 0.3)), ca.SX.sym("t")
    x = reference(t)
    orders = ca.Function("x", [t], [ca.densify(ca.vertcat(x, *derivatives(x, t, records.PATH_ORDERS - 1)))])
    packed, F = ca.SX.sym("s", 24), ca.SX.sym("F", 6)
    states, _ = vectors.random_inputs(VEHICLE, 20, 4, "double")
    for law, make in (
        (fp.laws.inverted(reference), fp.laws.inverted()),
        (fp.laws.lqr(reference=reference), fp.laws.lqr()),
    ):
        control = law.bind(VEHICLE).evaluate(t, fp.State.symbolic(packed), VEHICLE, (F[:3], F[3:])).wrench
        python = ca.Function("law", [t, packed, F], [ca.vertcat(control.thrust, control.moment)])
        code = library(make.bind(VEHICLE), VEHICLE, "double")
        for time, state in zip(np.linspace(0, 5, 20), states, strict=True):
            state = state if law.name == "inverted" else np.concatenate([state[:24], np.zeros(6)])
            wrench, _, status = code.step(state, code.follow(np.array(orders(time)).ravel(), state))
            wanted = np.array(python(time, state[:24], state[24:])).T
            assert status[0] == OK
            assert _apart(wrench, wanted, 1.0) < 1e-11  # of eighth derivatives


def test_vehicle_and_gains_are_inputs_at_run_time(monkeypatch):
    other = VEHICLE.replace(
        mass=0.7, bob_mass=0.08, rod_length=0.4, inertia=(4e-3, 3e-3, 6e-3), rotor_limits=(0.1, 5.0)
    )
    law = fp.laws.inverted(rod_damping=0.5, coast_time=0.04).bind(other)
    wanted = vectors.vectors(law, other, 200, 2, "double")
    code = library(INVERTED, VEHICLE, "double")  # compiled for another vehicle and other gains
    assert np.max(np.abs(code.step(wanted.state, wanted.reference)[0] - wanted.wrench)) > 0.1
    monkeypatch.setattr(code, "params", records.params_of(other))
    monkeypatch.setattr(code, "gains", np.array([law.numbers[field.name] for field in code.made.gains.fields]))
    wrench, rotors, status = code.step(wanted.state, wanted.reference)
    assert not np.any(status)
    assert _apart(wrench, wanted.wrench, 1.0) < 1e-12
    assert _apart(rotors, wanted.rotors, 1.0) < 1e-12


def test_six_rotors_a_full_inertia_matrix_and_a_rod_with_an_extent():
    vehicle = hexarotor(VEHICLE).replace(rod_inertia=1e-2)
    for law in (fp.laws.inverted().bind(vehicle), fp.laws.corrected(yaw_damping=2.0).bind(vehicle)):
        wanted = vectors.vectors(law, vehicle, 200, 2, "double")
        wrench, rotors, status = library(law, vehicle, "double").step(wanted.state, wanted.reference)
        assert not np.any(status)
        assert rotors.shape == (200, 6)
        assert _apart(wrench, wanted.wrench, 1.0) < 1e-12
        assert _apart(rotors, wanted.rotors, 1.0) < 1e-12


@pytest.mark.parametrize("entries", [(3e-3, 4e-3, 6e-3, 5.0, 0, 0), (3e-3, 4e-3, 6e-3, 2e-3, 3e-3, -3e-3)])
def test_an_inertia_matrix_that_is_indefinite_is_refused(entries):
    vehicle = hexarotor(VEHICLE).replace(rod_inertia=1e-2)
    code, wrench = library(fp.laws.inverted().bind(vehicle), vehicle, "double"), np.empty(4)
    params, place = code.params.copy(), code.made.params.place("inertia")
    assert code.call("flypend_unmix", np.ones(6), params, wrench) == OK
    params[place] = entries
    assert code.call("flypend_unmix", np.ones(6), params, wrench) == PARAMS


def test_mixing_keeps_limits_and_priority_for_any_wrench():
    thrust, moment = ca.SX.sym("T"), ca.SX.sym("tau", 3)
    python = ca.Function("mix", [thrust, moment], [allocate(thrust, moment, VEHICLE)])
    code, rng = library(INVERTED, VEHICLE, "double"), default_rng(3)
    for _ in range(500):
        wrench = rng.normal(size=4) * [10.0, 1.0, 1.0, 0.1] * np.exp(rng.uniform(-3, 3))
        rotors = np.empty(4)
        assert code.call("flypend_mix", wrench, code.params, rotors) == OK
        assert np.allclose(rotors, np.array(python(wrench[0], wrench[1:])).ravel(), rtol=1e-13, atol=1e-13)


def test_rotor_forces_are_unmixed_to_their_wrench():
    code, forces, wrench = library(INVERTED, VEHICLE, "double"), np.array([0.3, 1.0, 2.0, 0.7]), np.empty(4)
    assert code.call("flypend_unmix", forces, code.params, wrench) == OK
    assert np.allclose(wrench, VEHICLE.mixing() @ forces, rtol=1e-14)


def test_lead_within_limits_and_the_model_of_the_rotors():
    code, rng = library(INVERTED, VEHICLE, "double"), default_rng(4)
    low, high = VEHICLE.rotor_limits
    wanted, modelled = rng.uniform(low, high, (2, 4))

    def led(by):
        command = np.empty(4)
        assert code.call("flypend_lead", wanted, modelled, by, code.params, command) == OK
        return command

    assert np.allclose(led(2.1), np.clip(modelled + 2.1 * (wanted - modelled), low, high))
    share = 1 - np.exp(-0.002 / VEHICLE.rotor_lag)  # as the header says, it moves the model on as well
    assert np.allclose(led(share), wanted + (1 - share) * (modelled - wanted))


def test_a_name_neither_ends_nor_begins_a_comment():
    vehicle = VEHICLE.replace(name="mine */ + /*/")
    assert library(fp.laws.inverted(), vehicle, "double").made.vehicle == vehicle  # it compiles


# Refusals -------------------------------------------------------------------------------------------------------


def _valid():
    state, reference = vectors.random_inputs(VEHICLE, 1, 7, "double")
    return state[0], reference[0]


def _broken(name):
    state, reference = _valid()
    places = {field.name: place for field, place in records.STATE.places()}
    match name:
        case "not finite":
            state[places["omega"]] = [0, np.nan, 0]
        case "infinite reference":
            reference[4] = np.inf
        case "y is long":
            state[places["y"]] *= 1.0002
        case "y_dot is not tangent":
            state[places["y_dot"]] += 3e-3 * state[places["y"]]
        case "R is mirrored":
            state[places["R"]] *= -1
        case "R is scaled":
            state[places["R"]] *= 1.0002
        case "R is zero":
            state[places["R"]] = 0
        case "overflow":
            state[places["omega"]] = 1e200
    return state, reference


@pytest.mark.parametrize(
    ("name", "status"),
    [
        ("nothing", OK), ("not finite", NOT_FINITE), ("infinite reference", NOT_FINITE), ("y is long", ROD),
        ("y_dot is not tangent", ROD), ("R is mirrored", ATTITUDE), ("R is scaled", ATTITUDE), ("R is zero", ATTITUDE),
        ("overflow", SINGULAR),
    ],
)  # fmt: skip
def test_a_bad_input_is_answered_with_its_status_and_the_safe_wrench(name, status):
    code = library(INVERTED, VEHICLE, "double")
    state, reference = _broken(name)
    wrench, _, found = code.step(state, reference)
    assert found[0] == status
    if status == OK:
        assert not np.allclose(wrench[0], level_wrench(state), rtol=1e-2)
    elif name in ("infinite reference", "y is long", "y_dot is not tangent"):
        assert np.allclose(wrench[0], level_wrench(state), rtol=1e-12)
    else:  # nobody knows where a thrust would push
        assert np.array_equal(wrench[0], [4 * VEHICLE.rotor_limits[0], 0, 0, 0])


def level_wrench(state):
    """The wrench that levels hehn2011 at 500 Hz, written down once more."""
    R, omega, I = state[6:15].reshape(3, 3), state[15:18], VEHICLE.inertia
    z = R[:, 2]
    d = 1 / 2 / (VEHICLE.rotor_lag + INVERTED.computer.latency + 2e-3)
    alpha = R.T @ np.cross(z, [0, 0, 1]) * (d / 2) ** 2 / np.sqrt((1 + z[2]) / 2 + 1e-3) - d * omega
    return np.append(VEHICLE.weight * max(z[2], 0), I @ alpha + np.cross(omega, I @ omega))


def test_what_state_rounds_is_accepted():
    state, reference = _valid()
    state[18:21] *= 1 + 0.9e-4
    assert library(INVERTED, VEHICLE, "double").step(state, reference)[2][0] == OK


@pytest.mark.parametrize(
    ("name", "value", "status"),
    [
        ("mass", 0.0, PARAMS), ("rod_length", -1.0, PARAMS), ("inertia", 0.0, PARAMS), ("gravity", -1.0, PARAMS),
        ("rotor_least", 9.0, PARAMS), ("rotor_least", -0.1, PARAMS), ("bob_mass", np.nan, NOT_FINITE),
        ("rotor_largest", np.inf, NOT_FINITE), ("spin", -1.0, WRONG_VEHICLE), ("spin", 0.0, WRONG_VEHICLE),
    ],
)  # fmt: skip
def test_params_out_of_range_stop_the_rotors(monkeypatch, name, value, status):
    code = library(INVERTED, VEHICLE, "double")
    place = {field.name: place for field, place in code.made.params.places()}[name]
    monkeypatch.setattr(code, "params", code.params.copy())
    code.params[place] = value  # all spins the same, one of them wrong at least
    wrench, rotors, found = code.step(*_valid())
    assert found[0] == status
    assert np.array_equal(wrench[0], np.zeros(4))
    assert code.call("flypend_mix", np.ones(4), code.params, rotors) == status
    assert np.array_equal(rotors[0], np.zeros(4))


def test_gains_that_are_not_finite_and_null_pointers_are_refused(monkeypatch):
    code = library(INVERTED, VEHICLE, "double")
    monkeypatch.setattr(code, "gains", code.gains.copy())
    code.gains[3] = np.nan
    assert code.step(*_valid())[2][0] == NOT_FINITE
    functions = (("flypend_step", 5), ("flypend_mix", 3), ("flypend_unmix", 3), ("flypend_follow", 4))
    for name, arguments in functions:
        assert code.call(name, *[None] * arguments) == NULL
        out = np.full(30, np.nan)
        assert code.call(name, *[None] * (arguments - 1), out) == NULL
        assert np.any(np.isfinite(out))
    assert code.call("flypend_lead", None, None, 1.0, None, None) == NULL


def test_without_a_compiler_there_is_one_line(monkeypatch):
    monkeypatch.setenv("CC", "no-such-compiler")
    with pytest.raises(fp.InputError, match="controller: expected a C compiler called cc"):
        Library(INVERTED, VEHICLE, "double")


# Export ---------------------------------------------------------------------------------------------------------


def test_the_same_export_twice_is_byte_equal(tmp_path):
    # In processes of their own, with other hashes, so that no order of a set can decide.
    command = [sys.executable, "-m", "flypend", "export-c", "--law", "inverted", "--precision", "float", "-o"]
    for seed in ("1", "2"):
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        subprocess.run([*command, str(tmp_path / seed)], check=True, env=environment, capture_output=True)
    names = sorted(path.relative_to(tmp_path / "1") for path in (tmp_path / "1").rglob("*") if path.is_file())
    assert {"flypend_law.c", "flypend_law.h", "flypend_vectors.h", "README.md", "CMakeLists.txt"} <= set(
        map(str, names)
    )
    for name in names:
        assert (tmp_path / "1" / name).read_bytes() == (tmp_path / "2" / name).read_bytes(), name
    everything = b"".join((tmp_path / "1" / name).read_bytes() for name in names if "README" not in str(name))
    assert everything.isascii()


def test_the_header_tells_how_the_law_flies_and_the_code_does_not_depend_on_it(tmp_path):
    told = fp.export_c(INVERTED, VEHICLE, tmp_path / "told")
    bare = fp.export_c(INVERTED, VEHICLE, tmp_path / "bare", check=False)
    header = (told / "flypend_law.h").read_text(encoding="ascii")
    random = fp.check(VEHICLE, INVERTED, runs=200, margins=False).tasks["random"]
    assert f"random: {int(random.success.sum())} of 200 stand after 30 s" in header
    assert "POOR" not in header
    begin, end = header.index("/* Flown before"), header.index("#ifndef FLYPEND_LAW_H")
    assert header[:begin] + header[end:] == (bare / "flypend_law.h").read_text(encoding="ascii")
    for name in ("flypend_law.c", "flypend_vectors.h", "README.md"):
        assert (told / name).read_bytes() == (bare / name).read_bytes()


@pytest.mark.parametrize(
    ("law", "vehicle", "words"),
    [
        (fp.laws.corrected(), VEHICLE, "hover: 0 of 12 stand after 30 s"),
        (fp.laws.inverted(), VEHICLE.replace(mass=5.0), "4 rotors push 14 N"),
    ],
)
def test_a_law_that_flies_poorly_is_exported_with_a_warning(tmp_path, law, vehicle, words):
    with pytest.warns(UserWarning, match="poorly: ") as said:
        out = fp.export_c(law, vehicle, tmp_path)
    assert words in str(said[0].message)
    header = " ".join((out / "flypend_law.h").read_text(encoding="ascii").replace("*", " ").split())
    assert "POOR: " + str(said[0].message).split("poorly: ")[1].split(";")[0] in header


def _own(control, **more):
    return Law(name="own", e3="up", control=control, **more)


def test_what_cannot_be_exported_is_refused_and_nothing_is_written(tmp_path):
    asymmetric = VEHICLE.replace(rotor_positions=[[0.2, 0, 0], [0, 0.17, 0], [-0.17, 0, 0], [0, -0.17, 0]])
    hover = Wrench(VEHICLE.weight, ca.SX.zeros(3))
    cases = [
        (_own(lambda t, s, v, k: Wrench(ca.sin(s.x[2]), ca.SX.zeros(3))), VEHICLE, "square root, got sin"),
        (_own(lambda t, s, v, k: Wrench(t, ca.SX.zeros(3))), VEHICLE, "one that does not depend on time"),
        (_own(lambda t, s, v, k: Wrench(float(v.M), ca.SX.zeros(3))), VEHICLE, "a symbol is not a number"),
        (_own(lambda t, s, v, k: Wrench(k.throw, ca.SX.zeros(3)), gains={"throw": 1.0}), VEHICLE, "C\\+\\+, got throw"),
        (fp.Controller(name="python", function=lambda t, s: hover), VEHICLE, "law: expected a Law"),
        (fp.laws.inverted(), asymmetric, "rotors that share thrust and yaw equally"),
        (fp.laws.inverted(), "hehn2011", "vehicle: expected a Vehicle"),
    ]
    for law, vehicle, words in cases:
        with pytest.raises(fp.InputError, match=words):
            fp.export_c(law, vehicle, tmp_path / "out")
    with pytest.raises(fp.InputError, match="precision: expected one of double, float"):
        fp.export_c(fp.laws.inverted(), VEHICLE, tmp_path / "out", precision="half")
    for rate in (0.0, 2e4, np.nan, 3.0):
        with pytest.raises(fp.InputError, match="rate: expected"):
            fp.export_c(fp.laws.inverted(), VEHICLE, tmp_path / "out", rate=rate)
    for folder in (tmp_path / "no" / "such" / "folder", tmp_path / "a\0b"):
        with pytest.raises(fp.InputError, match=r"a folder that can be written|a name that a file can have"):
            fp.export_c(fp.laws.inverted(), VEHICLE, folder, check=False)
    assert not list(tmp_path.iterdir())


def test_a_law_of_ones_own_is_exported():
    def control(t, state, vehicle, k):
        return Control(wrench=Wrench(k.stiffness * (1 - state.x[2]) + vehicle.weight, -k.damping * state.omega))

    law = _own(control, gains={"stiffness": 3.0, "damping": 0.1, "unused": 1.0, "kind": "plain"})
    made = interface(law, VEHICLE)
    assert [field.name for field in made.gains.fields] == ["stiffness", "damping"]
    assert not made.follows
    state, reference = _valid()
    wrench, _, status = library(law, VEHICLE, "double").step(state, reference)
    assert status[0] == OK
    assert np.allclose(wrench[0], [3 * (1 - state[2]) + VEHICLE.weight, *(-0.1 * state[15:18])])


def test_only_what_a_law_reads_is_asked_for():
    made = {name: interface(law, VEHICLE) for name, law in LAWS.items()}
    assert {name: m.follows for name, m in made.items()} == {
        "inverted": True, "light": True, "corrected": False, "printed": False, "lqr": True, "repaired": False,
        "almost_global": True, "trained": False,
    }  # fmt: skip
    assert {"rod_damping", "coast_time"} <= {field.name for field in made["inverted"].gains.fields}
    assert not {"lead", "latency", "observer"} & {field.name for field in made["inverted"].gains.fields}
    assert [field.name for field in made["lqr"].gains.fields] == ["none"]  # its gain matrix is constant
    # Two gains decide how much there is to compute, and of one the law takes a cosine, which C code has not.
    constant = ("pump_share", "tilt_limit")
    assert made["inverted"].constant == constant
    assert not set(constant) & {field.name for field in made["inverted"].gains.fields}


def test_the_light_form_is_light_and_inverts():
    cost = {
        name: sum(interface(LAWS[name], VEHICLE).programs["law"].counts().values()) for name in ("inverted", "light")
    }
    assert cost["light"] < 0.85 * cost["inverted"]
    starts = fp.State.random(default_rng(11), 5)
    runs = fp.simulate_ensemble(VEHICLE, fp.laws.inverted(form="light"), starts, 6.0, plant="rotors", workers=1)
    assert runs.rate == 1.0
    with pytest.raises(fp.InputError, match="form: expected one of full, light"):
        fp.laws.inverted(form="heavy")
