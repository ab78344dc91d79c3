"""Routines: calls of programs give what CasADi gives, wherever their memory lies."""

import casadi as ca
import numpy as np
import pytest
from test_vector import compiled

import flypend as fp
from flypend.board.program import board
from flypend.compile.llvm.emit import Lanes, Module, define_routine
from flypend.compile.routine import Cell, lower_calls, stretches
from flypend.plants.loop import Loop
from flypend.plants.plant import PRESETS


def run(routine, inputs, width):
    lanes = Lanes(Module(), width)
    call = compiled(lanes, define_routine(lanes, routine), len(routine.inputs) + len(routine.outputs))
    return call(inputs, [((max(1, len(cells)), width), np.float64) for cells in routine.outputs])


def agrees(function, width=2, seed=1):
    rng = np.random.default_rng(seed)
    inputs = [rng.normal(size=(max(1, function.nnz_in(i)), width)) for i in range(function.n_in())]
    found = run(lower_calls(function), inputs, width)
    for lane in range(width):
        expected = function.call([ca.DM(x[: function.nnz_in(i), lane]) for i, x in enumerate(inputs)])
        for ours, theirs in zip(found, expected, strict=True):
            np.testing.assert_allclose(ours[: theirs.numel(), lane], np.array(theirs).ravel(), rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("name", ["rotors", "hehn2011"])
def test_a_board_as_calls_is_what_casadi_says(name):
    vehicle = fp.vehicle("hehn2011")
    agrees(board(Loop(vehicle, fp.laws.inverted().bind(vehicle), PRESETS[name])))


def double(n, name="double"):
    x = ca.SX.sym("x", n)
    return ca.Function(name, [x], [2 * x])


def test_vectors_are_cut_and_put_together_without_operations():
    x, y = ca.MX.sym("x", 5), ca.MX.sym("y", 3)
    twice = double(3)
    joined = ca.vertcat(y[::-1], twice(x[1:4]), 7.5, x[0])
    function = ca.Function("parts", [x, y], [joined, ca.vertcat(*ca.vertsplit(x, [0, 2, 5])[::-1])])
    agrees(function)
    routine = lower_calls(function)
    assert (len(routine.calls), routine.operations()) == (1, 3)
    assert routine.outputs[0][6] == Cell("constant", value=7.5)


def test_what_is_called_twice_stands_once_and_memory_is_used_again():
    x = ca.MX.sym("x", 4)
    step, inner = double(4), ca.MX.sym("z", 4)
    twice = ca.Function("twice", [inner], [step(step(inner))])  # a function of calls inside another
    value = x
    for _ in range(5):
        value = twice(value)
    routine = lower_calls(ca.Function("ten", [x], [value]))
    assert (len(routine.programs), len(routine.calls), routine.memories) == (1, 10, (4, 4))
    agrees(ca.Function("ten", [x], [value]))


def test_a_value_that_is_needed_later_keeps_its_memory():
    x = ca.MX.sym("x", 2)
    step = double(2)
    first = step(x)
    function = ca.Function("kept", [x], [step(step(first)), first])
    assert len(lower_calls(function).memories) == 3
    agrees(function)


def test_no_output_takes_the_memory_of_an_input_of_its_own_call():
    # C copies entries from one to the other, so an overwritten one would be read.
    x = ca.MX.sym("x", 3)
    inner = ca.SX.sym("inner", 3)
    turn = ca.Function("turn", [inner], [inner[[1, 2, 0]]])
    value = x
    for _ in range(6):
        value = turn(value)
    routine = lower_calls(ca.Function("round", [x], [value]))
    for call in routine.calls:
        read = {cell.number for cells in call.inputs for cell in cells if cell.memory == "call"}
        assert read.isdisjoint(call.outputs)


def test_an_argument_that_is_zero_or_not_read_needs_no_memory():
    a, b = ca.SX.sym("a", 2), ca.SX.sym("b", 2)
    both = ca.Function("both", [a, b], [a + b, a - b])
    x = ca.MX.sym("x", 2)
    agrees(ca.Function("zero", [x], [both(x, ca.MX(2, 1))[0]]))


def test_arithmetic_outside_the_functions_is_refused():
    x = ca.MX.sym("x", 2)
    with pytest.raises(ValueError, match="computes"):
        lower_calls(ca.Function("sum", [x], [x + 1]))


def test_two_functions_of_one_name_are_refused():
    x, y = ca.MX.sym("x", 2), ca.SX.sym("y", 2)
    other = ca.Function("double", [y], [3 * y])
    with pytest.raises(ValueError, match="one name"):
        lower_calls(ca.Function("f", [x], [other(double(2)(x))]))


def test_stretches_are_the_longest_runs_of_neighbours():
    cells = [Cell("input", 0, 1), Cell("input", 0, 2), Cell("input", 1, 3), Cell("constant", value=1.0)]
    cells += [Cell("constant", value=1.0), Cell("call", 0, 0), Cell("call", 0, 1)]
    assert [length for _, length in stretches(cells)] == [2, 1, 1, 1, 2]
    assert stretches([]) == []


def queue(length):
    """A function (memory, x) → (memory, y): the memory is a number that is doubled, and a queue of entries of two.

    It answers with twice the oldest entry, and the number as it was.
    """
    memory, x = ca.MX.sym("memory", 1 + 2 * length), ca.MX.sym("x", 2)
    head, oldest = memory[:1], memory[-2:]
    after = ca.vertcat(double(1, "one")(head), double(2, "two")(x), memory[1:-2])
    return ca.Function("queue", [memory, x], [after, ca.vertcat(double(2, "two")(oldest), head)])


@pytest.mark.parametrize("length", [2, 5])
def test_a_queue_slides_through_memory_instead_of_being_copied(length):
    routine, width = lower_calls(queue(length)), 4
    assert routine.slide() == 2
    assert lower_calls(queue(1)).slide() == 0
    lanes, size = Lanes(Module(), width), 1 + 2 * length
    sliding = define_routine(lanes, routine, routine.slide())
    # One function that calls it at two places of one memory, the second two vectors before the first.
    code = lanes.function("both", 3)
    memory, x, y = code.arguments
    for place in (4, 2):
        code.call(sliding, code.vector_at(memory, place), x, code.vector_at(memory, place - 2), y)
    both = code.end()
    rng = np.random.default_rng(3)
    first, given = rng.normal(size=(size, width)), rng.normal(size=(2, width))
    begin = np.concatenate([np.zeros((4, width)), first])
    shapes = [((3, width), np.float64)]
    kept = []
    call = compiled(lanes, both, 3, kept)
    (last,) = call([begin, given], shapes)
    expected = [first[:, 0], None]
    for _ in range(2):
        expected = [np.array(v).ravel() for v in queue(length).call([ca.DM(expected[0]), ca.DM(given[:, 0])])]
    np.testing.assert_allclose(kept[0][:size, 0], expected[0], rtol=1e-14)
    np.testing.assert_allclose(last[:, 0], expected[1], rtol=1e-14)


def test_a_routine_with_a_sparse_output_is_a_mistake():
    """A call whose value is always 0 has no entries to copy: the flight would go on with the last ones."""
    x, none = ca.SX.sym("x", 3), ca.SX.sym("none", 0)
    zero = ca.Function("zero", [x, none], [ca.SX.zeros(4)])
    given, empty = ca.MX.sym("given", 3), ca.MX.sym("empty", 0)
    for outputs in ([zero(given, empty)], [ca.vertcat(zero(given, empty), given)]):
        with pytest.raises(ValueError, match="sparse"):
            lower_calls(ca.Function("whole", [given, empty], outputs))
    full = lower_calls(ca.Function("whole", [given, empty], [ca.densify(zero(given, empty))]))
    assert [cell[:2] + cell[3:] for cell in full.outputs[0]] == [("constant", 0, 0.0)] * 4
