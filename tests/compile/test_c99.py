"""Scalar programs as C99: each operation, literals, order."""

import ctypes

import casadi as ca
import numpy as np
import pytest
from cbuild import build

import flypend as fp
from flypend.compile.c99 import (
    SCRATCH,
    call,
    function,
    inputs_used_by,
    literal,
    routine_function,
    routine_scratch,
    statements,
)
from flypend.compile.program import FOLD, Operation, Program, drop_dead, interpret, lower
from flypend.compile.routine import lower_calls
from flypend.compile.scratch import SPAN, TRUTHS, matrices, scratch


def _compiled(program, folder, precision="double"):
    """The C function of `program` with one input and one output vector, on NumPy arrays."""
    inputs = [[f"in[{i}]" for i in range(program.inputs[0])]]
    outputs = [[f"out[{i}]" for i in range(len(program.outputs[0]))]]
    body = "\n".join(statements(program, inputs, outputs, precision))
    head = f"#include <math.h>\ntypedef {precision} flypend_real;\nvoid f(const flypend_real *in, flypend_real *out);\n"
    (folder / "f.c").write_text(f"{head}void f(const flypend_real *in, flypend_real *out)\n{{\n{body}\n}}\n")
    library = ctypes.CDLL(str(build(folder, ("f.c",), "f.so", flags=("-shared", "-fPIC"))))
    real = np.float64 if precision == "double" else np.float32

    def call(values):
        given, found = np.array(values, dtype=real), np.empty(len(program.outputs[0]), dtype=real)
        library.f(given.ctypes.data_as(ctypes.c_void_p), found.ctypes.data_as(ctypes.c_void_p))
        return found

    return call


@pytest.mark.parametrize("precision", ["double", "float"])
def test_every_operation_means_what_casadi_means(tmp_path, precision):
    a, b = ca.SX.sym("a"), ca.SX.sym("b")
    x = ca.vertcat(a, b)
    values = ca.vertcat(
        a + b, a - b, a * b, a / b, -a, ca.sqrt(a * a + 1), ca.fabs(a), ca.fmin(a, b), ca.fmax(a, b), ca.sign(a),
        a < b, a <= b, ca.eq(a, b), ca.ne(a, b), ca.logic_not(a), ca.logic_and(a, b), ca.logic_or(a, b),
        ca.if_else(a < b, a, 2), a**3, b**-2, 3 * (-2.5 - a),
        2 * (a < b) + ca.ne(a, b), ca.logic_and(a < b, b), ca.logic_not(ca.eq(a, b)), ca.if_else(b, a, -1),
    )  # fmt: skip
    function = ca.Function("f", [x], [ca.densify(values)])
    program = lower(function)
    assert {
        "fabs",
        "fmin",
        "fmax",
        "sign",
        "lt",
        "le",
        "eq",
        "ne",
        "not",
        "and",
        "or",
        "sqrt",
    } <= program.counts().keys()
    call = _compiled(program, tmp_path, precision)
    tolerance = 1e-15 if precision == "double" else 5e-7
    for pair in [(1.0, 1.0), (0.0, 2.0), (-1.5, 0.5), (2.0, -3.0), (0.0, -0.25), (-2.0, -2.0), (-0.0, 0.0)]:
        wanted = np.array(function(pair)).ravel()
        np.testing.assert_allclose(call(pair), wanted, rtol=tolerance, atol=tolerance, err_msg=str(pair))


def test_what_is_not_a_number_equals_nothing(tmp_path):
    a, b = ca.SX.sym("a"), ca.SX.sym("b")
    values = ca.vertcat(a < b, a <= b, ca.eq(a, b), ca.ne(a, b), ca.logic_not(a), ca.if_else(a, b, 0), a < ca.inf)
    call = _compiled(lower(ca.Function("f", [ca.vertcat(a, b)], [values])), tmp_path)
    for a_, b_ in [(np.nan, 2.0), (2.0, np.nan), (np.nan, np.nan), (np.inf, np.inf), (np.inf, -np.inf)]:
        given = np.array([a_, b_])
        with np.errstate(invalid="ignore"):
            wanted = [a_ < b_, a_ <= b_, a_ == b_, a_ != b_, not a_, b_ if a_ != 0 else 0.0, a_ < np.inf]
        np.testing.assert_array_equal(call(given), np.array(wanted, dtype=float))


def test_other_functions_of_the_library_are_refused():
    x = ca.SX.sym("x")
    program = lower(ca.Function("f", [x], [ca.sin(x)]))
    with pytest.raises(fp.InputError, match="law: expected no function of the C library but the square root, got sin"):
        statements(program, [["x"]], [["*y"]], "double")


def test_literals_are_exact_in_their_precision():
    rng = np.random.default_rng(1)
    for value in [0.0, 1.0, -2.0, 1e-9, 1e30, *np.exp(rng.uniform(-60, 60, 50))]:
        assert float(literal(value, "double")) == value
        text = literal(value, "float")
        assert text.endswith("f")
        assert np.float32(text[:-1]) == np.float32(value)
    for value in (1e39, 1e-60, np.nan):
        with pytest.raises(fp.InputError, match="precision: expected finite numbers that it can hold"):
            literal(value, "float")
    with pytest.raises(fp.InputError, match="precision"):
        literal(np.inf, "double")


def test_a_constant_below_zero_keeps_its_sign_behind_a_minus():
    # 1 - -2 without a space, or with --2, would not compile or decrement.
    program = Program("f", (1,), (Operation("input", (0, 0)), Operation("constant", (), -2.0), Operation("sub", (0, 1)),
                                  Operation("neg", (2,))), ((3,),))  # fmt: skip
    assert statements(program, [["x"]], [["y"]], "double") == [
        "const flypend_real v0 = x;",
        "const flypend_real v1 = v0 - (-2.0);",
        "const flypend_real v2 = -v1;",
        "y = v2;",
    ]


def _moving(order):
    """A program that copies entries in this order, and computes one of them first."""
    x = ca.SX.sym("x", len(order))
    return lower(ca.Function("move", [x], [ca.vertcat(2 * x[0], x[order])]))


def test_what_is_only_copied_is_not_held_on_the_stack():
    program = _moving([1, 0])
    assert statements(program, [["x[0]", "x[1]"]], [["y[0]", "y[1]", "y[2]"]], "double") == [
        "const flypend_real v0 = x[0];",
        "const flypend_real v1 = v0 + v0;",
        "y[1] = x[1];",
        "y[2] = v0;",
        "y[0] = v1;",
    ]
    text = function(_moving(list(range(300))[::-1]), "double")
    assert text.count("const flypend_real v") < 5


def test_an_output_in_place_of_an_input_is_refused_where_a_copy_would_read_what_was_written():
    assert call(_moving([1, 0]), ["x"], ["y"]) == "move(x, y);"
    later = _moving([1, 2, 0])  # x[1] takes x[1], x[2] takes x[2]; x[3] takes x[0], which nothing has overwritten
    assert call(later, ["x"], ["x"]) == "move(x, x);"
    with pytest.raises(ValueError, match=r"move copies x\[1\], which it has overwritten"):
        call(_moving([0, 1, 2]), ["x"], ["x"])


def test_a_routine_calls_its_programs_on_stretches_of_memory(tmp_path):
    x, y, k = ca.SX.sym("x", 2), ca.SX.sym("y", 2), ca.SX.sym("k", 2)
    turn = ca.Function("turn", [x, k], [ca.vertcat(x[0] * k[0] - x[1], x[1] + x[0])])
    mean = ca.Function("mean", [x, y], [(x + y) / 2, ca.dot(x, y)])
    state, unread = ca.MX.sym("state", 3), ca.MX.sym("unread", 2)
    once = turn(state[1:], ca.DM([0.5, 2.0]))
    middle, product = mean(turn(once, ca.DM([0.5, 2.0])), ca.vertcat(state[2], state[0]))
    whole = ca.Function("whole", [unread, state], [ca.vertcat(product, middle, state[1], 7.0)])
    routine = lower_calls(whole)
    assert inputs_used_by(routine) == [1]
    parts = [function(program, "double") for program in routine.programs]
    text = "\n\n".join(["typedef double flypend_real;", *parts, routine_function(routine, "double")])
    assert text.count("static void turn(") == 1
    assert text.count("turn(") == 3
    head = "void f(const double *state, double *out)"
    (tmp_path / "f.c").write_text(
        f"{text}\n\n{head};\n{head}\n{{\n    double w[{routine_scratch(routine)}];\n    whole(w, state, out);\n}}\n"
    )
    library = ctypes.CDLL(str(build(tmp_path, ("f.c",), "f.so", flags=("-shared", "-fPIC"))))
    given, found = np.array([0.3, -1.2, 2.5]), np.empty(5)
    library.f(given.ctypes.data_as(ctypes.c_void_p), found.ctypes.data_as(ctypes.c_void_p))
    assert np.allclose(found, np.array(whole([0, 0], given)).ravel(), rtol=1e-15)


def _network(rows, columns, seed=0):
    """W₂ a(W₁ x + b) + D x, and its layers: W₁ and D act on the same vector, so they are one."""
    rng = np.random.default_rng(seed)
    W_1, b, W_2, D = (rng.standard_normal(shape) for shape in ((rows, columns), rows, (8, rows), (8, columns)))
    x = ca.SX.sym("x", columns)
    hidden = ca.mtimes(ca.DM(W_1), x) + b
    out = ca.mtimes(ca.DM(W_2), hidden / ca.sqrt(1 + hidden**2)) + ca.mtimes(ca.DM(D), x)
    return ca.Function("net", [x], [ca.densify(out)]), (np.vstack([W_1, D]), W_2)


@pytest.mark.parametrize("precision", ["double", "float"])
def test_layers_are_tables_and_change_no_bit(tmp_path, precision):
    """Against the same program, statement by statement."""
    net, weights = _network(20, 12)
    program = lower(net)
    found = {tuple(map(len, (m.rows, m.columns))): m.weights for m in matrices(program)}
    assert set(found) == {W.shape for W in weights}
    for W in weights:
        assert np.array_equal(found[W.shape], W)
    text = function(program, precision)
    assert text.count("* ") < 60  # of 500 products
    head = f"#include <math.h>\ntypedef {precision} flypend_real;\n"
    end = "void f(const flypend_real *in, flypend_real *out);\nvoid f(const flypend_real *in, flypend_real *out)"
    (tmp_path / "f.c").write_text(
        f"{head}{text}\n{end}\n{{\n    flypend_real w[{scratch(program).size}];\n    net(w, in, out);\n}}\n"
    )
    library = ctypes.CDLL(str(build(tmp_path, ("f.c",), "f.so", flags=("-shared", "-fPIC"))))
    real = np.float64 if precision == "double" else np.float32
    operations = {"add": lambda a, b: a + b, "mul": lambda a, b: a * b, "div": lambda a, b: a / b, "sqrt": np.sqrt}
    rng = np.random.default_rng(1)
    for _ in range(20):
        given, out = rng.standard_normal(12).astype(real), np.empty(8, dtype=real)
        library.f(given.ctypes.data_as(ctypes.c_void_p), out.ctypes.data_as(ctypes.c_void_p))
        (wanted,) = interpret(program, [lambda i, given=given: given[i]], operations, real)
        assert np.array_equal(out, np.array(wanted))


def test_what_is_no_layer_is_no_table():
    """Products of variables, a single sum, sums over different variables, and one whose parts are needed elsewhere."""
    x = ca.SX.sym("x", 80)
    W = np.random.default_rng(0).standard_normal((2, 80))
    first = ca.mtimes(ca.DM(W[:1]), x)
    apart = ca.vertcat(ca.mtimes(ca.DM(W[:1, :40]), x[:40]), ca.mtimes(ca.DM(W[1:, 40:]), x[40:]))
    for values in (ca.sumsqr(x), first, apart, ca.vertcat(first, W[0, 7] * x[7], first + 1)):
        assert not matrices(lower(ca.Function("f", [x], [ca.densify(values)])))


def test_what_is_no_number_is_written_as_such():
    x = ca.SX.sym("x")
    program = lower(ca.Function("f", [x], [ca.if_else(x < np.inf, x, np.nan)]))
    text = "\n".join(statements(program, [["x"]], [["y"]], "float"))
    assert "INFINITY" in text
    assert "NAN" in text


def _long_program(rng, length=600):
    """Random operations, truths among them, each on values that were computed at any time before, or on inputs."""
    operations = [Operation("input", (0, i)) for i in range(5)] + [Operation("constant", (), 0.75)]
    kinds = {"add": 2, "sub": 2, "mul": 2, "fmin": 2, "neg": 1, "lt": 2, "ne": 2, "not": 1, "and": 2, "select": 2}
    for number in range(6, length):
        name = str(rng.choice(list(kinds)))
        arguments = tuple(int(number - 1 - rng.integers(number) ** 2 // number) for _ in range(kinds[name]))
        operations.append(Operation(name, arguments))
    outputs = tuple(int(place) for place in [*rng.integers(0, length, 20), 2, 0])  # inputs in another order, too
    return drop_dead(Program("f", (5,), tuple(operations), (outputs,)))


@pytest.mark.parametrize("seed", range(4))
def test_values_that_are_kept_change_no_bit(seed, tmp_path):
    """A program much longer than `SPAN`, whose output takes the place of its input."""
    rng = np.random.default_rng(seed)
    program = _long_program(rng)
    assert len(program.operations) > 3 * SPAN
    size = scratch(program).size
    assert 0 < size < len(program.operations) // 2
    head = "#include <math.h>\ntypedef double flypend_real;\n"
    end = "void g(double *both);\nvoid g(double *both)"
    text = function(program, "double")
    assert text.count(f"{SCRATCH}[") > size
    (tmp_path / "f.c").write_text(f"{head}{text}\n{end}\n{{\n    double w[{size}];\n    f(w, both, both);\n}}\n")
    library = ctypes.CDLL(str(build(tmp_path, ("f.c",), "f.so", flags=("-shared", "-fPIC", "-ffp-contract=off"))))
    for _ in range(10):
        given = rng.standard_normal(len(program.outputs[0]))
        (wanted,) = interpret(program, [lambda i, given=given: float(given[i])], FOLD, float)
        library.g(given.ctypes.data_as(ctypes.c_void_p))
        np.testing.assert_array_equal(given, wanted)


@pytest.mark.parametrize("seed", range(4))
def test_a_place_is_taken_again_only_when_its_value_is_not_needed_any_more(seed):
    program = _long_program(np.random.default_rng(seed))
    places = scratch(program).places
    last = {n: len(program.operations) for n in program.outputs[0]}
    for number, operation in reversed(list(enumerate(program.operations))):
        for argument in operation.arguments if operation.name != "input" else ():
            last.setdefault(argument, number)
    for a, b in ((a, b) for a in places for b in places if a < b and places[a] == places[b]):
        assert last[a] < b
    numbers = {n for n, it in enumerate(program.operations) if it.name not in ("input", "constant", *TRUTHS)}
    assert {n for n in numbers if last[n] - n > SPAN} == places.keys()
