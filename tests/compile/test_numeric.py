"""CasADi functions as NumPy callables, also from several threads."""

from concurrent.futures import ThreadPoolExecutor

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.compile.numeric import as_numpy


def test_one_output_is_an_array_and_several_are_a_tuple():
    x, y = ca.SX.sym("x", 2), ca.SX.sym("y")
    one, two = (as_numpy(ca.Function("f", [x, y], outputs)) for outputs in ([y * x], [y * x, x + y]))
    np.testing.assert_array_equal(one([1, 2], 3), [3, 6])
    np.testing.assert_array_equal(two([1, 2], 3), [[3, 6], [4, 5]])


def test_a_sparse_output_is_refused():
    x = ca.SX.sym("x")
    with pytest.raises(ValueError, match="sparse"):
        as_numpy(ca.Function("f", [x], [ca.diag(ca.vertcat(x, x))]))


def push(t, state):
    return fp.Wrench(6.0 + np.sin(5 * t), -0.02 * state.omega)


def test_threads_that_fly_at_once_do_not_disturb_each_other():
    vehicle, law = fp.vehicle("hehn2011"), fp.Controller(name="push", function=push)
    starts = fp.State.random(np.random.default_rng(1), 6)

    def fly(i):
        return fp.simulate(vehicle, law, starts[i], 0.3).packed

    alone = [fly(i) for i in range(6)]
    with ThreadPoolExecutor(6) as pool:
        together = list(pool.map(fly, range(6)))
    for a, b in zip(alone, together, strict=True):
        np.testing.assert_array_equal(a, b)
