"""Theorem C: the chart is the law, Taylor models contain it, certificates hold, and wrong ones are rejected."""

import copy
import json
import subprocess
import sys
from functools import cache
from types import SimpleNamespace

import casadi as ca
import numpy as np
import pytest
from balls import BITS, OPERATIONS
from flint import arb, ctx
from taylor_balls import proves

import flypend as fp
from flypend.compile.program import interpret, lower
from flypend.export.records import SymbolicVehicle, params_of, params_record
from flypend.geometry import E3, cross, dot, rotation_from_vector
from flypend.laws import certificate, references, verify
from flypend.laws.certified import _run, _state, chart_function, differs, statement
from flypend.laws.chart import LAGGED, SIZE, law_at
from flypend.model import State, Wrench
from flypend.model.mount import clearances
from tests.few import slow

HEHN = fp.vehicle("hehn2011")


@cache
def found(name="hehn2011", lag=False, mount="gimbal"):
    law = fp.laws.almost_global_lag() if lag else fp.laws.almost_global()
    return law.bind(fp.vehicle(name).replace(mount=mount)).certified_set()


@pytest.mark.parametrize(
    ("name", "lag", "least"),
    [
        ("hehn2011", False, 5e-2), slow("crazyflie", False, 4.9e-2),
        # Up to two minutes each.
        slow("hehn2011", True, 4e-2),
        slow("nayak2018", False, 1.1e-2),
        slow("crazyflie", True, 3e-2),
        slow("nayak2018", True, 1e-2),
    ],
)  # fmt: skip
def test_the_set_is_as_large_as_promised_and_its_certificate_is_proved(name, lag, least):
    certified = found(name, lag)
    assert certified.c >= least
    assert certificate.check(certified.certificate) == ""
    assert differs(certified.certificate, certified.law) == ""
    assert certificate.check(certified.certificate | {"c": 1.1 * certified.c})  # c is the largest within 5 %
    assert certificate.check(certified.certificate | {"w": 10.0})


def test_through_a_lag_as_large_a_set_as_promised_is_proved():
    """Not the largest one, which takes half a minute to find: see above."""
    law = fp.laws.almost_global_lag().bind(HEHN)
    made = statement(law) | {"c": 4e-2}
    assert certificate.check(made) == ""
    assert differs(made, law) == ""


@pytest.mark.parametrize("lag", [False, True])
def test_in_the_chart_the_law_is_the_law_and_v_a_sum_of_blocks(lag):
    """In ball arithmetic with vehicle and gains as symbols, at random points, at any heading and yaw rate."""
    ctx.prec = BITS
    law = (fp.laws.almost_global_lag() if lag else fp.laws.almost_global()).bind(HEHN)
    record, size = params_record(HEHN), LAGGED if lag else SIZE
    xi, p, k = ca.SX.sym("xi", size), ca.SX.sym("p", record.length), ca.SX.sym("k", len(law.numbers))
    turn, spin, yawing = ca.SX.sym("turn"), ca.SX.sym("spin"), ca.SX.sym("yawing")
    body, gains = SymbolicVehicle(p, record, HEHN), {name: k[i] for i, name in enumerate(law.numbers)}
    K, body.rotor_lag = SimpleNamespace(**gains), 1 / 32  # s, exact
    own = law_at(xi, K, body.M, body.m, body.l, body.g, body.rotor_lag if lag else None)

    across = cross(E3, own.axis)
    hat = ca.skew(across)
    half = 1 + turn**2
    heading = ca.vertcat(
        ca.horzcat(1 - turn**2, -2 * turn, 0) / half, ca.horzcat(2 * turn, 1 - turn**2, 0) / half, ca.horzcat(0, 0, 1)
    )
    R = (ca.SX.eye(3) + hat + hat @ hat / (1 + own.axis[2])) @ heading
    flat = R.T @ own.axis_rate
    omega = ca.vertcat(-flat[1], flat[0], spin)
    state = State(
        x=own.bob + body.l * (E3 - own.rod), x_dot=own.bob_rate - body.l * own.rod_rate, R=R, omega=omega, y=own.rod,
        y_dot=own.rod_rate,
    )  # fmt: skip
    # The law differentiates by the state, so it is evaluated on symbols, into which the state of the chart goes.
    s, t = ca.SX.sym("s", 28 if lag else 24), ca.SX.sym("t")
    known = {"acting": Wrench(s[24], s[25:])} if lag else {}
    control = law.evaluate(t, State.symbolic(s[:24]), body, gains=gains, **known)
    turning = spin * cross(omega, E3)

    def moment_of(u, last):
        """That of what gives the axis u, and the yaw rate `last`; with the angular acceleration."""
        alpha = ca.vertcat(cross(E3, R.T @ u)[:2], last) + turning
        return body.I @ alpha + cross(omega, body.I @ omega), alpha

    moment, _ = moment_of(own.wrenches[0][1:], -K.yaw_damping * spin)
    place = state.packed()
    if lag:
        # The yaw channel and the turning of the heading, as docs/laws/theorem-proof.md bounds them.
        T, eta_3 = body.rotor_lag, yawing + K.yaw_damping * spin
        tilted = ca.vertcat(xi[SIZE + 1 :], 0)
        u = own.wrenches[1][1:] - (tilted + cross(across, tilted) + hat @ hat @ tilted / (1 + own.axis[2]))
        acting, alpha = moment_of(own.wrenches[1][1:], yawing)
        place = ca.vertcat(place, own.wrenches[1][0], acting)
        last = yawing - T * (K.yaw_damping * yawing + K.wrench_damping * eta_3)
        moment, _ = moment_of(own.wrenches[0][1:], last)
        moment += T * body.I @ (yawing * cross(omega, E3) + spin * cross(alpha, E3) + spin * (R.T @ u))
        moment += T * (cross(alpha, body.I @ omega) + cross(omega, body.I @ alpha))

    def block(i, stiffness, reach, size):
        return stiffness * reach**2 * (ca.sqrt(1 + ca.sumsqr(xi[i : i + size]) / reach**2) - 1)

    def step(i, weight, stiffness, barrier):
        c = ca.sqrt(1 - ca.sumsqr(xi[i : i + 2]))
        psi = (1 - barrier) * (1 - c) - 2 * barrier * ca.log((1 + c) / 2)
        return weight * stiffness * psi + weight * ca.sumsqr(xi[i + 2 : i + 4]) / 2

    V = block(0, K.position_stiffness, K.position_reach, 2) + block(2, K.height_stiffness, K.height_reach, 1)
    V += ca.sumsqr(xi[3:6]) / 2 + step(6, K.rod_weight, K.rod_stiffness, K.rod_barrier)
    V += step(10, K.axis_weight, K.axis_stiffness, K.axis_barrier)
    if lag:
        V += (K.thrust_weight * xi[SIZE] ** 2 + K.moment_weight * (ca.sumsqr(xi[SIZE + 1 :]) + eta_3**2)) / 2
    wanted = ca.vertcat(control.wrench.thrust, control.wrench.moment, sum(control.lyapunov.values()))
    law_on = ca.Function("law", [s, p, k], [ca.densify(wanted)])
    at = ca.Function(
        "at", [xi, p, k, turn, spin, yawing], [place, ca.densify(ca.vertcat(own.wrenches[0][0], moment, V))]
    )
    chart, exact, rng = lower(at), lower(law_on), np.random.default_rng(3)
    for _ in range(2 if lag else 5):
        point = [arb(float(value)) for value in rng.uniform(-0.15, 0.15, size)]
        numbers = [
            [arb(float(value)) for value in values * np.exp(rng.uniform(-0.2, 0.2, np.shape(values)))]
            for values in (np.array(params_of(HEHN)), np.array(list(law.numbers.values())))
        ]
        free = [[arb(float(rng.normal()))] for _ in range(3)]
        place, answer = interpret(chart, [v.__getitem__ for v in (point, *numbers, *free)], OPERATIONS, arb)
        [truth] = interpret(exact, [v.__getitem__ for v in (place, *numbers)], OPERATIONS, arb)
        for one, two in zip(answer, truth, strict=True):
            assert (one - two).contains(0)
            assert (one - two).rad() < 1e-25


def value_at(polynomial, x):
    """P(x) exactly, for x of python-flint's numbers."""
    total = arb(polynomial.a)
    for order, tensor in enumerate((polynomial.l, polynomial.Q, polynomial.T), start=1):
        for place in () if tensor is None else np.argwhere(tensor):
            term = arb(float(tensor[tuple(place)]))
            for i in place:
                term *= x[i]
            total += term
        assert tensor is None or tensor.ndim == order
    return total


@pytest.mark.parametrize(("share", "least"), [(1.0, 1e-3), (1e-5, 1e-4), (1e-14, 1e-9)])
def test_taylor_models_contain_what_the_program_answers(share, least):
    """In ball arithmetic, at random points of the set; in a tiny one, remainders are what is left to rounding."""
    made, rng = found().certificate, np.random.default_rng(1)
    ctx.prec = BITS
    c = share * made["c"]
    sizes = [arb(size) for size in certificate.radii(made["numbers"], c)]
    (commanded,), turning, cosine = certificate.evaluate_program(made, c)
    models, used = [*commanded, *turning, cosine], 0.0
    for i in range(8):
        x = rng.normal(size=SIZE)
        x *= (1.0 if i % 3 else rng.random()) / np.linalg.norm(x) / (1 + 1e-12)
        point = [arb(float(entry)) for entry in x]
        given = [entry * size for entry, size in zip(point, sizes, strict=True)]
        answer = _run(made, given, [arb(value) for value in made["numbers"].values()], arb.sqrt)
        for (P, error), value in zip(models, answer, strict=True):
            apart = float(abs(value_at(P, point) - value).upper())
            assert apart <= error
            used = max(used, apart / error)
    assert used > least  # the bounds are not empty words


def test_a_bound_carried_backwards_contains_what_cancels():
    """What sums of remainders do not see."""
    one, x = ["constant", [], 1.0], ["input", [0, 0], 0.0]
    root = [one, x, ["add", [0, 1], 0.0], ["sqrt", [2], 0.0]]

    def bound(operations, value):
        """The bound on the last operation, once it has been compared with its `value` at many x."""
        place = len(operations) - 1
        [(P, error)] = certificate.evaluate(
            operations, lambda *_: certificate.Polynomial(0.0, np.array([0.3])), [place]
        )
        for x0 in np.linspace(-1, 1, 21):
            told = P.a + P.l[0] * x0 + P.Q[0, 0] * x0**2 + (0 if P.T is None else P.T[0, 0, 0] * x0**3)
            assert abs(told - value(0.3 * x0)) <= error
        return error

    alone = bound(root, lambda x: np.sqrt(1 + x))
    # Twice the root less itself: the sum of remainders is three times that of the root.
    assert bound([*root, ["add", [3, 3], 0.0], ["sub", [4, 3], 0.0]], lambda x: np.sqrt(1 + x)) < 1.01 * alone
    bound([*root, ["mul", [1, 3], 0.0]], lambda x: x * np.sqrt(1 + x))  # passed on by the linear part alone


def test_a_bound_that_is_not_a_number_is_not_forgotten():
    """∞ − ∞ among the coefficients of third order; the next product has none of these."""
    program = [
        ["constant", [], 3e103], ["input", [0, 0], 0.0], ["mul", [0, 1], 0.0], ["mul", [2, 2], 0.0],
        ["mul", [3, 2], 0.0], ["add", [4, 4], 0.0], ["sub", [4, 5], 0.0], ["mul", [6, 1], 0.0], ["add", [7, 1], 0.0],
    ]  # fmt: skip
    with np.errstate(all="ignore"):
        [(P, error)] = certificate.evaluate(program, lambda *_: certificate.Polynomial(0.0, np.array([0.3])), [8])
    assert (P.a, P.Q, P.T) == (0.0, None, None)
    assert not error < np.inf


@pytest.mark.parametrize("name", ["hehn2011", slow("crazyflie")])
def test_ball_arithmetic_proves_the_same_file_for_a_smaller_set(name):
    """A second checker, of other formulas and without doubles, agrees as far as it reaches."""
    ctx.prec = BITS
    made = found(name).certificate
    c, hover = 0.25 * made["c"], fp.vehicle(name).weight / 4
    low, high = made["limits"]
    assert proves(made, c)
    tight = 0.05 * (hover - low)
    for change in ({"limits": [low, hover + tight]}, {"limits": [hover - tight, high]}, {"w": 1000 * made["w"]}):
        assert not proves(made | change, c), change
        assert certificate.check(made | change), change
    with pytest.raises(AssertionError):  # too large for models of degree 2: a root of what may vanish
        proves(made, made["c"])


@pytest.mark.parametrize(("left", "right"), [(0.0, 0.2), (0.1, 0.2)])
@pytest.mark.parametrize("constant", ["neither", "first", "second"])
def test_the_remainder_of_a_product_has_the_product_of_the_remainders(left, right, constant):
    line = np.array([0.7])
    A = certificate.Polynomial(2.0, None if constant == "first" else line)
    B = certificate.Polynomial(-3.0, None if constant == "second" else line)
    P, rho, factors = certificate.times(A, B, left, right)
    worst = max(
        abs((at(A, x) + d * left) * (at(B, x) + e * right) - at(P, x))
        for x in (-1, 1)
        for d in (-1, 1)
        for e in (-1, 1)
    )
    bound = rho + sum(
        (abs(C.a) + (0 if C.l is None else abs(C.l[0])) + C.radius) * error
        for C, error in zip(factors, (left, right), strict=True)
    )
    assert worst <= bound * certificate.UP
    assert constant == "neither" or bound < 1.001 * worst


def at(P, x):
    return P.a + (0 if P.l is None else P.l[0] * x) + (0 if P.Q is None else P.Q[0, 0] * x**2)


def test_a_file_is_checked_by_a_program_of_its_own(tmp_path, capsys):
    path, good = tmp_path / "set.json", found().certificate
    found().save(path)
    assert json.loads(path.read_text()) == good
    command = [sys.executable, "-m", "flypend.laws.verify", str(path)]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")
    assert run.stdout.startswith("proved: V <= 0.05")
    assert run.stdout.endswith(" almost_global on hehn2011\n")

    for content in ("", "base = 1", b"\xff"):
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        assert verify.main(str(path)) == 2
        assert capsys.readouterr().err.startswith(f"{path}: expected a certificate")
    assert verify.main(str(tmp_path / "none.json")) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1

    def refused(*vehicle, **changes):
        path.write_text(json.dumps(good | changes))
        assert verify.main(str(path), *vehicle) == 1
        return capsys.readouterr().out

    assert refused(c=1.0).startswith("not proved: a ")
    assert refused("crazyflie") == "not proved: its vehicle is not that of the law\n"
    assert refused(vehicle="crazyflie") == "not proved: its numbers is not that of the law\n"
    assert refused(law=[]) == "not proved: no law of flypend is in the file: unhashable type: 'list'\n"
    wrong = copy.deepcopy(good["operations"])
    wrong[[i for i, (name, _, _) in enumerate(wrong) if name == "add"][1500]][0] = "sub"
    assert certificate.check(good | {"operations": wrong}) == ""  # proved of a program that is not the law
    assert refused(operations=wrong).startswith("not proved: its program differs from the law by ")
    with pytest.raises(fp.InputError, match=r"^path: expected a file name ending in \.json"):
        found().save(tmp_path / "set.txt")


def test_the_file_tells_which_gains_are_no_defaults():
    other = fp.laws.almost_global(rod_damping=4.3).bind(HEHN)
    made = found().certificate | {"numbers": found().certificate["numbers"] | {"rod_damping": 4.3}}
    assert verify.unlike(made) == ("", "almost_global, rod_damping 4.3 on hehn2011")
    assert differs(made, other) == ""
    made["numbers"]["rod_damping"] = -4.3
    reason, _ = verify.unlike(made)
    assert reason.startswith("no law of flypend is in the file: rod_damping: expected")


@pytest.mark.parametrize(
    "change",
    [
        {"c": np.nan}, {"c": np.inf}, {"c": "much"}, {"w": np.nan}, {"w": np.inf}, {"w": -0.1},
        {"limits": [np.nan, 1.0]}, {"limits": [0.0, np.nan]}, {"inertia": [[np.nan] * 3] * 3},
        {"unmixing": [[np.nan] * 4] * 4}, {"unmixing": []}, {"operations": []}, {"operations": [["log", [0], 0.0]]},
        {"outputs": []}, {"outputs": [0] * 8}, {"numbers": {}},
        {"body": {}},
    ],
    ids=str,
)  # fmt: skip
def test_corrupted_files_are_rejected_in_a_line(change):
    reason = certificate.check(found().certificate | change)
    assert reason
    assert "\n" not in reason


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 0.0, -1.0, 1e300, "1", None])
def test_corrupted_numbers_are_rejected(value):
    good, law = found().certificate, found().law
    for name in good["numbers"]:
        wrong = good | {"numbers": good["numbers"] | {name: value}}
        assert differs(wrong, law) == "its numbers is not that of the law"
    for name in ("M", "g", "l", "position_stiffness", "rod_weight", "axis_stiffness", "axis_weight"):
        assert certificate.check(good | {"numbers": good["numbers"] | {name: value}}), name


def test_constants_of_the_program_are_checked():
    good, law = found().certificate, found().law
    places = [i for i, (name, _, _) in enumerate(good["operations"]) if name == "constant"]
    for i in places:
        for value in (good["operations"][i][2] * (1 + 1e-6) + 1e-6, np.nan):
            wrong = copy.deepcopy(good)
            wrong["operations"][i][2] = value
            assert certificate.check(wrong) or differs(wrong, law)


def test_a_program_too_long_for_the_bounds_on_rounding_is_refused():
    one = ["constant", [], 1.0]
    for operations in ([one] * 100_001, [one, *[["add", [0, 0], 0.0]] * 2501]):
        with pytest.raises(certificate.NotProvedError, match="too long, or uses a value too often"):
            certificate.evaluate(operations, None, [0])


def test_a_program_that_is_no_number_beyond_the_set_is_not_the_law():
    """Thrust without a turn, and h − h: proved of the set, where h = |2 ξ|⁸¹⁹² is nearly 0, and else ∞ − ∞."""
    good, law = found().certificate, found().law
    wrong = copy.deepcopy(good)
    operations = wrong["operations"]

    def put(name, *arguments):
        operations.append([name, list(arguments), 0.0])
        return len(operations) - 1

    two = put("constant")
    operations[two][2] = 2.0
    squares = [put("mul", *[put("mul", put("input", 0, i), two)] * 2) for i in range(SIZE)]
    h = squares[0]
    for square in squares[1:]:
        h = put("add", h, square)
    for _ in range(12):
        h = put("mul", h, h)
    wrong["outputs"][1:4] = [put("sub", h, h)] * 3
    assert certificate.check(wrong) == ""
    assert differs(wrong, law) == "its program differs from the law by nan"


def test_wrong_certificates_are_rejected():
    good, law = found().certificate, found().law
    hover = HEHN.weight / 4
    for change in (
        {"limits": [good["limits"][0], hover + 0.05]},
        {"limits": [hover - 0.05, good["limits"][1]]},
        {"c": 1.0},
        {"c": -1.0},
        {"format": "another"},
    ):
        assert certificate.check(good | change), change
    for name in ("axis_stiffness", "rod_damping", "height_reach", "yaw_damping"):
        wrong = copy.deepcopy(good)
        wrong["numbers"][name] *= 1.01
        assert differs(wrong, law) == "its numbers is not that of the law"
    # What the program takes for the stiffness is the reach: a law of its own, and proved.
    wrong = copy.deepcopy(good)
    first = wrong["parameters"].index("position_stiffness")
    wrong["parameters"][first : first + 2] = wrong["parameters"][first : first + 2][::-1]
    assert certificate.check(wrong) == ""
    assert differs(wrong, law) == "its parameters is not that of the law"
    # A changed sign is told wherever it changes what the program answers.
    rng, changed, numbers = np.random.default_rng(0), 0, list(good["numbers"].values())
    point = rng.uniform(-0.4, 0.4, SIZE)
    right = _run(good, point, numbers)
    signs = [i for i, (name, _, _) in enumerate(good["operations"]) if name in ("add", "sub")]
    for i in rng.choice(signs, 20, replace=False):
        wrong = copy.deepcopy(good)
        wrong["operations"][i][0] = "sub" if wrong["operations"][i][0] == "add" else "add"
        apart = np.max(np.abs(_run(wrong, point, numbers) - right))
        assert bool(differs(wrong, law)) == (apart > 0)
        changed += apart > 0
    assert changed > 15


def edge_states(certified, runs, seed):
    """States with V between 0.9 and 1 c, of random direction in the chart and random heading."""
    made, rng, out = certified.certificate, np.random.default_rng(seed), []
    sizes = certificate.radii(made["numbers"], made["c"])
    numbers = list(made["numbers"].values())
    chart = chart_function(tuple(made["numbers"]))
    for _ in range(runs):
        x = rng.normal(size=SIZE)
        x *= 0.99 / np.linalg.norm(x)
        asked, place = (np.array(part).ravel() for part in chart(x * sizes, numbers))
        state = _state(place, asked[4:7], certified.law)
        turn = rotation_from_vector((0, 0, rng.uniform(-np.pi, np.pi)))
        flat = turn.T @ state.omega + (0, 0, rng.uniform(-1, 1) * certified.yaw_rate)
        out.append(State(x=state.x, x_dot=state.x_dot, R=state.R @ turn, omega=flat, y=state.y, y_dot=state.y_dot))
    return State.trusted(np.stack([state.packed() for state in out]))


def test_flights_from_the_edge_stay_inside_and_within_the_limits():
    certified = found()
    starts = edge_states(certified, 12, 5)
    low, high = HEHN.rotor_limits
    reached = []
    for i in range(12):
        assert certified.contains(starts[i])
        run = fp.simulate(HEHN, certified.law, starts[i], 4.0, plant="ideal", times=np.linspace(0, 4, 81))
        assert np.all(run.rotor_forces > low)
        assert np.all(run.rotor_forces < high)
        assert np.all(np.diff(run.signals["V"]) <= 1e-9 * certified.c)
        reached.append(run.signals["V"][0] / certified.c)
        assert certified.contains(State.trusted(run.packed)).all()
    assert max(reached) > 0.9  # the ellipsoid is hardly larger than the set


def test_what_the_set_contains_and_how_far_it_reaches():
    certified = found()
    assert certified.contains(fp.State(y=E3))
    assert not certified.contains(fp.State(y=-E3))
    assert not certified.contains(fp.State(y=E3, omega=(0, 0, 1.01 * certified.yaw_rate)))
    batch = fp.State(y=np.stack([E3, -E3]))
    np.testing.assert_array_equal(certified.contains(batch), [True, False])
    for share, inside in ((0.999, True), (1.001, False)):
        far = share * certified.extent["speed"]
        # Only the bob's speed: rod and axis turned as they should be is what the chart does.
        x = np.zeros(SIZE)
        x[4] = far
        made = certified.certificate
        asked, place = (
            np.array(part).ravel() for part in chart_function(tuple(made["numbers"]))(x, list(made["numbers"].values()))
        )
        state = _state(place, asked[4:7], certified.law)
        assert dot(state.y, E3) < 1
        assert certified.contains(state) == inside


def test_on_a_hub_the_rod_is_proved_to_touch_nothing():
    """The set is that of a gimbal, for the rod leans far less than it may."""
    hub = found(mount="hub")
    made = hub.certificate
    assert hub.c == found().c
    assert certificate.check(made) == differs(made, hub.law) == ""
    answer = certificate.evaluate_program(made, hub.c)
    most, worst = certificate.lean(answer), np.linalg.eigh(answer.cosine[0].Q)[1][:, 0]
    xi, numbers = worst * certificate.radii(made["numbers"], hub.c), list(made["numbers"].values())
    asked = np.array(chart_function(tuple(made["numbers"]))(xi, numbers)[0]).ravel()
    assert most / 3 < np.arccos(asked[-1]) < most  # the bound holds, and is no empty word
    for change in (
        {"disc_radius": made["body"]["disc_radius"] + 0.102},
        {"arm_radius": 0.04},
        {"hub_radius": 0.007},
        {"rotors": [[x, y, 0.6] for x, y, _ in made["body"]["rotors"]]},
    ):
        wrong = made | {"body": made["body"] | change}
        assert "the rod may touch" in certificate.name_touch(wrong, most), change
    assert "the rod may touch" in certificate.check(wrong)
    for body in (wrong["body"], None):
        assert differs(made | {"body": body}, hub.law) == "its body is not that of the law"


def test_distances_to_disc_and_arm_are_bounds_of_those_in_the_world():
    """Where the checker lets the rod lean, the clearances of the world are positive; beyond, they soon are not."""
    body = HEHN.body
    for height in (0.0, 0.05, -0.05):
        rotors = HEHN.rotor_positions + np.array([0, 0, height])
        made = {"body": {"rotors": rotors.tolist(), **{k: v for k, v in vars(body).items() if k != "cup_angle"}}}
        allowed = []
        for theta in np.radians(np.arange(0.0, 90.0, 0.5)):
            around = np.radians(np.arange(0.0, 360.0, 1.0))
            rod = np.stack(
                [np.sin(theta) * np.cos(around), np.sin(theta) * np.sin(around), np.full(360, np.cos(theta))], axis=-1
            )
            clear = np.min(clearances(rod, rotors, HEHN.reach, body)) > 0
            free = certificate.name_touch(made, theta) == ""
            assert clear or not free
            allowed.append((free, clear))
        free, clear = np.sum(allowed, axis=0)
        assert height < 0 or free >= 0.8 * clear  # discs below the pivot are taken for discs above it


def test_where_no_set_can_be_certified():
    with pytest.raises(fp.InputError, match=r"^law: expected almost_global, on its own path"):
        fp.laws.inverted().bind(HEHN).certified_set()
    with pytest.raises(fp.InputError, match=r"^law\.vehicle: expected one that the theorem models"):
        fp.laws.almost_global().bind(HEHN.replace(mount="cup")).certified_set()
    with pytest.raises(fp.InputError, match=r"^law\.reference: expected one at rest"):
        fp.laws.almost_global(references.circle(0.5, 1.0)).bind(HEHN).certified_set()
    with pytest.raises(fp.InputError, match=r"^vehicle\.rotor_limits: expected forces beyond those of hover"):
        fp.laws.almost_global().bind(HEHN.replace(rotor_limits=(0.08, 1.0))).certified_set()
    law = fp.laws.almost_global().bind(HEHN)
    with pytest.raises(fp.InputError, match=r"^law: "):
        law.along(law.path).certified_set()


def test_forces_beyond_the_limits_are_not_in_the_set_even_at_a_small_wrench():
    angles = np.arange(6) * np.pi / 3
    vehicle = fp.vehicle("hehn2011").replace(
        rotor_positions=0.17 * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1),
        rotor_spins=[1, -1] * 3, rotor_lag=0.02,
    )  # fmt: skip
    bound = fp.laws.almost_global_lag().bind(vehicle)
    certified, hover = bound.certified_set(), np.full(6, vehicle.weight / 6)
    idle = np.linalg.svd(vehicle.mixing())[2][-1]  # forces without a wrench
    assert certified.contains(fp.State(y=E3), hover)
    assert not certified.contains(fp.State(y=E3), hover + 30 * idle)


def test_a_law_through_a_lag_needs_the_yaw_damping_of_its_theorem():
    assert fp.laws.almost_global(yaw_damping=0.0).gains["yaw_damping"].bounds.low == 0
    with pytest.raises(fp.InputError, match=r"^yaw_damping"):
        fp.laws.almost_global_lag(yaw_damping=0.0)
