"""Loops over stages: a map, a recursion forward and one backward, each lane by itself."""

import casadi as ca
import numpy as np
import pytest

from flypend.compile.llvm.stagewise import WIDTH, lanes, stagewise

STAGES = 7


def filled(*shape):
    array = lanes(*shape)
    array[:] = np.random.default_rng(len(shape) + shape[0]).normal(size=array.shape)
    return array


def test_a_map_with_a_shared_input():
    x, p = ca.SX.sym("x", 3), ca.SX.sym("p", 3)
    run = stagewise(ca.Function("product", [x, p], [x * p, ca.sin(x)]), shared=(1,))
    xs, ps, products, sines = filled(STAGES, 3), filled(3), lanes(STAGES, 3), lanes(STAGES, 3)
    run(STAGES, xs, ps, products, sines)
    np.testing.assert_array_equal(products, xs * ps)
    np.testing.assert_allclose(sines, np.sin(xs), rtol=4e-16, atol=0)  # 1.5 ulp, see `elementary`


@pytest.mark.parametrize("backward", [False, True])
def test_what_a_stage_writes_the_next_one_reads(backward):
    x, a = ca.SX.sym("x", 2), ca.SX.sym("a", 2)
    run = stagewise(ca.Function("recursion", [x, a], [a * x + 1]), backward=backward)
    xs, rates = lanes(STAGES + 1, 2), filled(STAGES, 2)
    first, last = (xs, xs[1:]) if not backward else (xs[1:], xs)
    xs[-1 if backward else 0] = 2.0
    run(STAGES, first, rates, last)
    expected = np.full((2, WIDTH), 2.0)
    for k in reversed(range(STAGES)) if backward else range(STAGES):
        expected = rates[k] * expected + 1
        np.testing.assert_allclose(
            xs[k if backward else k + 1], expected, rtol=1e-15, atol=1e-15
        )  # multiply-add rounds once


def test_no_lane_depends_on_another():
    x = ca.SX.sym("x", 4)
    run = stagewise(ca.Function("mixed", [x], [ca.exp(-(x**2)) / (1 + ca.norm_2(x))]))
    xs, out, alone = filled(STAGES, 4), lanes(STAGES, 4), lanes(STAGES, 4)
    run(STAGES, xs, out)
    other = lanes(STAGES, 4)
    other[:] = np.nan
    other[..., 3] = xs[..., 3]
    run(STAGES, other, alone)
    np.testing.assert_array_equal(alone[..., 3], out[..., 3])


def test_a_call_on_arrays_begins_at_any_stage():
    x, p = ca.SX.sym("x", 3), ca.SX.sym("p", 1)
    run = stagewise(ca.Function("product", [x, p], [x * p]), shared=(1,))
    xs, factor, products = filled(STAGES, 3), filled(1), lanes(STAGES, 3)
    run.on(xs, factor, products)(2, 3)
    np.testing.assert_array_equal(products[2:5], (xs * factor)[2:5])
    assert not np.any(products[:2])
    assert not np.any(products[5:])


@pytest.mark.parametrize("count", [WIDTH, WIDTH + 1, 3 * WIDTH - 1])
def test_stages_abreast_are_those_one_by_one(count):
    """Eleven inputs and nine outputs: whole blocks of eight and what is left of them are turned into lanes and back."""
    rng = np.random.default_rng(count)
    x, p = ca.SX.sym("x", 11), ca.SX.sym("p", 2)
    function = ca.Function("some", [x, p], [ca.vertcat(x[:8] * p[0], x[10] / p[1]), x[2] + x[9]])
    xs, ps = rng.normal(size=(count, 11)), rng.normal(size=2)
    nine, one = np.zeros((count, 9)), np.zeros((count, 1))
    stagewise(function, shared=(1,), abreast=True)(count, xs, ps, nine, one)
    np.testing.assert_allclose(nine, np.column_stack([xs[:, :8] * ps[0], xs[:, 10] / ps[1]]), rtol=4e-16, atol=0)
    np.testing.assert_array_equal(one[:, 0], xs[:, 2] + xs[:, 9])
