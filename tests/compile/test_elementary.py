"""Logarithm, sine, cosine and inverse root on lanes: to 1.5 ulp of the truth, and what the C library says elsewhere."""

import casadi as ca
import numpy as np
import pytest
from programs import program_of
from test_vector import compiled, run

from flypend.compile.llvm.emit import Lanes, Module, emit, with_inverse_roots
from tests.few import each_once

FAR = 1e5  # rad, up to which compile/loops/elementary.hpp does without the C library
LONG = np.longdouble  # 64 bits of mantissa: its own error is a thousandth of what is measured here
pytestmark = pytest.mark.skipif(np.finfo(LONG).nmant < 63, reason="no longer numbers to compare with")
RNG = np.random.default_rng(6)
N = 1 << 14


def of_lanes(casadi_function, x, width=8):
    """The values of a CasADi function at all `x`, in rows of `width` lanes."""
    symbol = ca.SX.sym("x")
    program, _ = program_of([casadi_function(symbol)], [symbol])
    rows, lanes = x.reshape(-1, width), Lanes(Module(), width)
    some = min(64, len(rows))
    code = lanes.function("some", 2)
    source, target = code.arguments
    for row in range(some):
        ((value,),) = emit(code, program, [lambda _, row=row: code.load(source, row)])
        code.store(value, target, row)
    call = compiled(lanes, code.end(), 2)
    parts = [call([part], [(part.shape, np.float64)])[0] for part in rows.reshape(-1, some, width)]
    return np.ravel(parts)


def ulps(found, exact):
    """Error in units in the last place of `exact`."""
    return np.abs((found.astype(LONG) - exact) / np.spacing(np.abs(exact).astype(float)))


CASES = {
    "log below 1": (ca.log, np.log, RNG.uniform(0, 1, N)),
    "log near 1": (ca.log, np.log, 1 + RNG.uniform(-1e-3, 1e-3, N)),
    "log anywhere": (ca.log, np.log, np.exp(RNG.uniform(-700, 700, N))),
    "sin": (ca.sin, np.sin, RNG.uniform(-10, 10, N)),
    "cos": (ca.cos, np.cos, RNG.uniform(-10, 10, N)),
    "sin far away": (ca.sin, np.sin, RNG.uniform(-FAR, FAR, N)),
    "cos near a multiple of π/2": (ca.cos, np.cos, np.pi / 2 * np.arange(1, N + 1) * (1 + RNG.uniform(-1e-9, 1e-9, N))),
    "sin beyond": (ca.sin, np.sin, RNG.uniform(-1e9, 1e9, N)),
    "inverse root": (lambda x: 1 / ca.sqrt(x), lambda x: 1 / np.sqrt(x), np.exp(RNG.uniform(-700, 700, N))),
    "inverse root of a root": (
        lambda x: 1 / ca.sqrt(ca.sqrt(ca.sqrt(x))),
        lambda x: x ** LONG(-0.125),
        RNG.uniform(1, 9, N),
    ),
}


@pytest.mark.parametrize(("name", "width"), each_once(CASES, (1, 8, 16)))
def test_it_is_accurate_to_one_and_a_half_units_in_the_last_place(name, width):
    symbolic, exact, x = CASES[name]
    most = ulps(of_lanes(symbolic, x, width), exact(x.astype(LONG))).max()
    # Three roots in a row each add what they make of the error before, half of it.
    assert most < (3.0 if name == "inverse root of a root" else 1.5)


def test_what_has_no_usual_value_has_that_of_the_c_library():
    x = np.array([0.0, np.inf, -1.0, np.nan, 5e-324, 1e-310, 1e308, -np.inf])
    tiny = np.array([1e-310, -0.0, 1e300, 2.0**-1022, 1.0, -1e-5, 1e5, -1e5])
    with np.errstate(all="ignore"):
        for symbolic, exact in ((ca.log, np.log), (ca.sin, np.sin), (ca.cos, np.cos), (lambda v: 1 / ca.sqrt(v), None)):
            for given in (x, tiny):
                wanted = 1 / np.sqrt(given) if exact is None else exact(given)
                np.testing.assert_allclose(of_lanes(symbolic, given), wanted, rtol=4e-16, atol=0)


def test_a_lane_does_not_depend_on_the_others():
    x = RNG.uniform(-10, 10, N)
    alone = of_lanes(ca.sin, x)
    beside = x.copy()
    beside[::2] = 1e7  # sends its lanes, and no others, to the C library
    np.testing.assert_array_equal(of_lanes(ca.sin, beside)[1::2], alone[1::2])


def test_floats_take_the_c_library():
    x = RNG.uniform(0.1, 9, 16).astype(np.float32)
    symbol = ca.SX.sym("x")
    program, _ = program_of([ca.log(symbol), ca.sin(symbol)], [symbol])
    out = run(program, [x[None, :]], 16, "float")[0]
    np.testing.assert_allclose(out, [np.log(x), np.sin(x)], rtol=3e-7)


def test_roots_below_a_fraction_become_inverse_roots():
    a, b = ca.SX.sym("a"), ca.SX.sym("b")
    length = ca.sqrt(a * a + b * b)
    program, _ = program_of([a / length, b / length, ca.sqrt(ca.sqrt(a)), ca.sqrt(b)], [a, b])
    counts = with_inverse_roots(program).counts()
    assert counts["inverse root"] == 3
    assert counts["sqrt"] == 1
    assert "div" not in counts
