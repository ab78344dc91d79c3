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
