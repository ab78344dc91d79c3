"""Scalar programs: what CasADi says, in fewer operations."""

import contextlib
import itertools
import operator

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from programs import OPERATIONS, evaluate, program_of

import flypend as fp
from flypend.compile.program import FOLD, LIBRARY, Program, lower
from flypend.flight.criterion import Criterion
from flypend.flight.kernels.ideal import ideal_problem
from flypend.plants import Ideal
from flypend.plants.loop import Loop

UNARY = [
    ca.sqrt, ca.fabs, ca.sign, ca.sin, ca.cos, ca.tan, ca.asin, ca.acos, ca.atan, ca.sinh, ca.cosh, ca.tanh, ca.asinh,
    ca.acosh, ca.atanh, ca.exp, ca.log, ca.floor, ca.ceil, ca.erf, ca.logic_not, lambda a: -a, lambda a: 1 / a,
    lambda a: a**2, lambda a: a**3, lambda a: a**-2, lambda a: 2 * a, lambda a: a - 0, lambda a: 0 * a, lambda a: a / 4,
]  # fmt: skip
BINARY = [
    lambda a, b: a + b, lambda a, b: a - b, lambda a, b: a * b, lambda a, b: a / b, ca.fmin, ca.fmax, ca.atan2,
    ca.fmod, ca.hypot, lambda a, b: a < b, lambda a, b: a <= b, lambda a, b: a == b, lambda a, b: a != b,
    ca.logic_and, ca.logic_or, lambda a, b: ca.if_else(a > b, a, b), lambda a, b: ca.fabs(a) ** b,
]  # fmt: skip
numbers = st.sampled_from([0.0, 1.0, -1.0, 0.5, 2.0, -3.0])


@st.composite
def expressions(draw):
    """Symbols, and a few expressions in them that share parts."""
    ca.GlobalOptions.setSimplificationOnTheFly(draw(st.booleans()))
    symbols = [ca.SX.sym(name) for name in "abc"]
    known = [*symbols, *(ca.SX(draw(numbers)) for _ in range(2))]
    place = st.integers(0, 200)
    for _ in range(draw(st.integers(1, 9))):
        one, other = (known[draw(place) % len(known)] for _ in range(2))
        if draw(st.booleans()):
            known.append(draw(st.sampled_from(BINARY))(one, other))
        else:
            known.append(draw(st.sampled_from(UNARY))(one))
    ca.GlobalOptions.setSimplificationOnTheFly(True)
    return symbols, known[-3:]


@settings(derandomize=True, max_examples=200, deadline=None)
@given(expressions(), st.lists(st.floats(-3, 3).map(lambda x: round(x, 3)), min_size=3, max_size=3))
def test_a_program_gives_what_casadi_gives(found, values):
    symbols, wanted = found
    program, function = program_of(wanted, symbols)
    given_ = np.array(function(values)).ravel()
    got = np.array(evaluate(program, [np.float64(value) for value in values])[0], dtype=float)
    finite = np.isfinite(given_) & (np.abs(given_) < 1e12)
    # Reciprocals that are shared and powers that are products: some roundings, amplified in at most nine operations.
    np.testing.assert_allclose(got[finite], given_[finite], rtol=1e-8, atol=1e-8)


def operations_of(expression, *symbols):
    return program_of([expression], symbols)[0].counts()


def test_derivatives_of_roots_and_limits_take_no_division_of_their_own():
    x, x_dot = ca.SX.sym("x"), ca.SX.sym("v")
    root = 1 / ca.sqrt(1 + x * x)
    assert operations_of(root, x)["div"] == 1
    rate = ca.vertcat(root, ca.jtimes(root, x, x_dot))
    assert program_of([rate], [x, x_dot])[0].counts()["div"] == 1
    eighth = 1 / ca.sqrt(ca.sqrt(ca.sqrt(1 + x**8)))
    counts = program_of([eighth, ca.jtimes(eighth, x, x_dot)], [x, x_dot])[0].counts()
    assert (counts["div"], counts["sqrt"]) == (1, 3)
    clipped = ca.fmin(ca.fmax(x, 0), 1)
    assert "div" not in operations_of(ca.jtimes(clipped, x, x_dot), x, x_dot)


def test_the_derivative_of_a_limit_is_shared_where_both_sides_are_equal():
    x = ca.SX.sym("x")
    program, function = program_of([ca.jacobian(ca.fmax(x, 1), x), ca.jacobian(ca.fmin(x, 1), x)], [x])
    for value, wanted in ((0.0, [0.0, 1.0]), (1.0, [0.5, 0.5]), (2.0, [1.0, 0.0])):
        np.testing.assert_array_equal(np.array(function(value)).ravel(), wanted)
        np.testing.assert_array_equal(evaluate(program, [np.float64(value)])[0], wanted)


a, b, c = (ca.SX.sym(name) for name in "abc")


@pytest.mark.parametrize(
    ("expression", "counts"),
    [
        (ca.sin(0.0) + a * 1 + 0 * b, {}),
        (a + ca.exp(ca.SX(0)) * 0, {}),
        (0 - (-a), {}),
        (a * -1, {"neg": 1}),
        (a + (-b), {"sub": 1}),
        (0 - a, {"neg": 1}),
        (a / 4, {"mul": 1}),
        (a / b, {"div": 1}),
        (a**4, {"mul": 2}),
        (a**-1, {"div": 1}),
    ],
)
def test_constants_and_neutral_elements_cost_nothing(expression, counts):
    assert operations_of(expression, a, b) == counts


def test_signs_move_into_sums():
    """Also those that CasADi did not simplify by itself."""
    ca.GlobalOptions.setSimplificationOnTheFly(False)
    wanted = [a + (-b), (-b) + a, a - (-b), 0 - a, a * -1 + b, (a * 0) + b, a * 1 - 0]
    ca.GlobalOptions.setSimplificationOnTheFly(True)
    program, function = program_of(wanted, [a, b])
    assert program.counts() == {"sub": 2, "add": 1, "neg": 1}
    values = [1.7, -2.2]
    np.testing.assert_array_equal(evaluate(program, values)[0], np.array(function(values)).ravel())


def test_divisions_by_one_value_share_its_reciprocal():
    program, function = program_of([a / c, b / c, (a + b) / c], [a, b, c])
    assert program.counts() == {"mul": 3, "div": 1, "add": 1}
    values = [1.7, -2.2, 0.3]
    np.testing.assert_allclose(evaluate(program, values)[0], np.array(function(values)).ravel(), rtol=1e-15)


@pytest.mark.parametrize("x", [-2.0, 0.25])
def test_a_branch_with_a_root_leaves_the_other_as_it_is(x):
    program, function = program_of([ca.if_else(a > 0, ca.sqrt(a), 1 / a)], [a])
    assert evaluate(program, [x])[0][0] == float(function(x))
    squares = a * a + ca.exp(b)  # nowhere negative: 1/x is (1/√x)²
    assert program_of([ca.sqrt(squares), 1 / ca.sqrt(squares), b / squares], [a, b])[0].counts()["div"] == 1


def test_an_infinite_exponent_is_left_to_the_library():
    assert operations_of(a ** ca.SX.inf(), a) == {"pow": 1}


def test_what_no_output_needs_is_left_out():
    packed = ca.SX.sym("s", 3)
    function = ca.Function("f", [packed], [packed[0] + packed[1], ca.sin(packed[2])])
    both = lower(function)
    assert both.counts() == {"add": 1, "sin": 1}
    assert [len(vector) for vector in both.outputs] == [1, 1]
    one = lower(ca.Function("f", [packed], [packed[0] + packed[1]]))
    assert sum(operation.name == "input" for operation in one.operations) == 2


def test_a_value_is_computed_once():
    assert operations_of(ca.sin(a * b) + ca.cos(b * a), a, b) == {"mul": 1, "sin": 1, "cos": 1, "add": 1}


def test_a_division_by_zero_is_left_to_the_machine():
    program, _ = program_of([ca.SX(1.0) / (a * 0)], [a])
    assert np.isinf(evaluate(program, [2.0])[0][0])


def test_an_operation_that_nobody_knows_is_refused():
    with pytest.raises(fp.errors.InputError, match="can be compiled"):
        lower(ca.Function("f", [a], [ca.log1p(a)]))


def test_a_sparse_output_is_a_mistake():
    with pytest.raises(ValueError, match="sparse"):
        lower(ca.Function("f", [a], [ca.SX(2, 1)]))


def test_arguments_stand_before_what_takes_them():
    vehicle = fp.vehicle("hehn2011")
    program = ideal_problem(Loop(vehicle, fp.laws.inverted().bind(vehicle), Ideal()), Criterion()).rates
    assert isinstance(program, Program)
    for place, operation in enumerate(program.operations):
        assert operation.name == "input" or all(number < place for number in operation.arguments)
        assert operation.name in ("input", "constant") or operation.name in OPERATIONS


AS_OPERATORS = {
    "add": operator.add, "sub": operator.sub, "mul": operator.mul, "div": operator.truediv, "neg": operator.neg,
    "lt": operator.lt, "le": operator.le, "eq": operator.eq, "ne": operator.ne, "pow": operator.pow,
    "not": ca.logic_not, "and": ca.logic_and, "or": ca.logic_or, "select": lambda c, a: ca.if_else(c, a, 0),
}  # fmt: skip


@pytest.mark.parametrize("name", FOLD)
def test_constants_are_folded_as_casadi_evaluates_them(name):
    values, compared = (-2.0, -0.5, 0.0, 0.5, 1.0, 2.0), 0
    unary = {"not", "neg", "sqrt", "fabs", "sign"} | set(LIBRARY)
    for some in itertools.product(values, repeat=1 if name in unary else 2):
        with contextlib.suppress(ValueError, ZeroDivisionError):  # left to the machine
            found = FOLD[name](*some)
            expected = float(AS_OPERATORS.get(name, getattr(ca, name, None))(*map(ca.DM, some)))
            assert found == pytest.approx(expected, rel=1e-15, nan_ok=True), some
            compared += 1
    assert compared > 0
