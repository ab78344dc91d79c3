"""Programs as functions on vectors of lanes: what the machine computes is what the program says."""

import ctypes

import casadi as ca
import numpy as np
import pytest
from programs import evaluate, program_of

import flypend as fp
from flypend.compile.llvm import jit
from flypend.compile.llvm.emit import Lanes, Module, define
from flypend.compile.llvm.random import PER_TICK, normals
from flypend.flight.criterion import Criterion
from flypend.flight.kernels.ideal import ideal_problem
from flypend.laws.closed_loop import close_loop
from flypend.plants import Ideal
from flypend.plants.loop import Loop


def compiled(lanes, function, pointers, kept=None):
    """A callable of arrays for an internal function of the module of `lanes`; it moves them to aligned memory.

    To the list `kept` it adds what then stands in the memory of its inputs.
    """
    outer = lanes.function("outer", pointers)
    outer.call(function, *outer.arguments)
    outer.end(visible=True)
    native = jit.Native(jit.compile_module(lanes.module), "outer", (ctypes.c_void_p,) * pointers)
    number = np.float64 if lanes.precision == "double" else np.float32

    def call(inputs, shapes):
        memory = [allocate_aligned(np.asarray(rows, dtype=number)) for rows in inputs]
        memory += [allocate_aligned(np.zeros(shape, dtype=kind)) for shape, kind in shapes]
        native(*(array.ctypes.data for array in memory))
        if kept is not None:
            kept.extend(memory[: len(inputs)])
        return memory[len(inputs) :]

    return call


def allocate_aligned(array):
    """`array` at an address divisible by 128."""
    room = np.zeros(array.nbytes + 128, dtype=np.uint8)
    first = -room.ctypes.data % 128
    copy = room[first : first + array.nbytes].view(array.dtype).reshape(array.shape)
    copy[...] = array
    return copy


def run(program, inputs, width, precision="double"):
    lanes = Lanes(Module(), width, precision)
    call = compiled(lanes, define(lanes, program), len(program.inputs) + len(program.outputs))
    number = np.float64 if precision == "double" else np.float32
    return call(inputs, [((len(vector), width), number) for vector in program.outputs])


a, b = ca.SX.sym("a"), ca.SX.sym("b")
EVERYTHING = [
    a + b, a - b, a * b, a / b, 1 / b, -a, ca.sqrt(ca.fabs(a)), ca.fabs(a), ca.fmin(a, b), ca.fmax(a, b), ca.sign(a),
    a < b, a <= b, ca.eq(a, b), ca.ne(a, b), ca.logic_not(a), ca.logic_and(a, b), ca.logic_or(a, b),
    ca.if_else(a < b, a, b), ca.sin(a), ca.cos(a), ca.tan(a), ca.asin(a / 4), ca.acos(a / 4), ca.atan(a), ca.sinh(a),
    ca.cosh(a), ca.tanh(a), ca.asinh(a), ca.acosh(1 + a * a), ca.atanh(a / 4), ca.exp(a), ca.log(ca.fabs(a)),
    ca.floor(a), ca.ceil(a), ca.erf(a), ca.fabs(a) ** b, ca.atan2(a, b), ca.fmod(a, b), ca.hypot(a, b),
]  # fmt: skip


@pytest.mark.parametrize(
    ("width", "precision", "rtol"),
    [(1, "double", 1e-14), (8, "double", 1e-14), (16, "double", 1e-14), (16, "float", 3e-6), (32, "float", 3e-6)],
)
def test_every_operation_is_what_the_interpreter_says(width, precision, rtol):
    program, _ = program_of(EVERYTHING, [a, b])
    rows = np.random.default_rng(1).uniform(-3, 3, (2, width)).astype(np.float32)
    rows[:, 0] = 2.0  # equal
    got = run(program, [rows], width, precision)[0]
    expected = [np.broadcast_to(row, width) for row in evaluate(program, rows.astype(float))[0]]
    np.testing.assert_allclose(got, expected, rtol=rtol, atol=rtol)


def test_comparisons_and_extremes_of_nan():
    """Comparisons with NaN are false, != is true; the extreme of NaN and a number is a number or NaN, never garbage."""
    program, _ = program_of([a < b, a <= b, ca.eq(a, b), ca.ne(a, b), a + b, ca.sqrt(a)], [a, b])
    rows = np.full((2, 8), np.nan)
    rows[1] = 1.0
    got = run(program, [rows], 8)[0]
    np.testing.assert_array_equal(got[:4, 0], [0, 0, 0, 1])
    assert np.isnan(got[4:, 0]).all()


@pytest.mark.parametrize("name", ["corrected", "inverted"])
@pytest.mark.parametrize(("width", "precision", "tolerance"), [(8, "double", 1e-11), (16, "float", 2e-2)])
def test_a_closed_loop_is_what_casadi_says(name, width, precision, tolerance):
    vehicle = fp.vehicle("hehn2011")
    law = getattr(fp.laws, name)().bind(vehicle)
    program = ideal_problem(Loop(vehicle, law, Ideal()), Criterion()).rates
    states = fp.State.random(np.random.default_rng(2), width).packed().T
    got = run(program, [np.zeros((1, width)), states, np.zeros((0, width))], width, precision)[0]
    rates = close_loop(vehicle, law).rates
    expected = np.array([np.array(rates(0.0, state)).ravel() for state in states.T]).T
    # Accelerations are up to some hundred rad/s², and a float has seven digits.
    np.testing.assert_allclose(got, expected, rtol=tolerance, atol=tolerance * 100)


# Random numbers --------------------------------------------------------------------------------------------------


def test_normal_numbers_are_normal_and_independent():
    drawn = normals(5, 20_000)
    n = drawn.size
    assert drawn.shape == (20_000, PER_TICK)
    # Five standard errors of each moment.
    assert abs(drawn.mean()) < 5 / np.sqrt(n)
    assert abs(drawn.var() - 1) < 5 * np.sqrt(2 / n)
    assert abs((drawn**3).mean()) < 5 * np.sqrt(15 / n)
    assert abs((drawn**4).mean() - 3) < 5 * np.sqrt(96 / n)
    correlation = np.corrcoef(drawn.T) - np.eye(PER_TICK)
    assert np.max(np.abs(correlation)) < 5 / np.sqrt(len(drawn))
    assert abs(np.mean(drawn[1:] * drawn[:-1])) < 5 / np.sqrt(n)


def test_a_flight_has_its_own_numbers_whatever_its_length():
    np.testing.assert_array_equal(normals(3, 50), normals(3, 200)[:50])
    assert not np.any(normals(3, 10) == normals(4, 10))
