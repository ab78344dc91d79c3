"""Expressions of one's own: the same values as Python's, and nothing but arithmetic."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.planning.constraints import own_function
from flypend.settings.expressions import Expression

RNG = np.random.default_rng(34)
FORCES = RNG.uniform(0.1, 3, 4)


def values(own, state):
    return np.array(own_function(own, 4, "keep")(state.packed(), FORCES)).ravel()


@pytest.mark.parametrize(
    ("text", "by_hand"),
    [
        ("0.6 - x[2]", lambda m: 0.6 - m.x[2]),
        ("x[2] < 0.6", lambda m: 0.6 - m.x[2]),
        ("-1 <= x[0] < 1, y[2] > 0", lambda m: [m.x[0] + 1, 1 - m.x[0], m.y[2]]),
        ("x[0] > norm(x + 0.5*y - [2, 0, 1])", lambda m: m.x[0] - ca.norm_2(m.x + m.y / 2 - ca.DM([2, 0, 1]))),
        ("R[2, 1]*sin(pi/6)**2, -min(rotor_forces[0], 1)", lambda m: [m.R[2, 1] / 4, -ca.fmin(m.rotor_forces[0], 1)]),
        ("dot(cross(omega, y_dot), x_dot)", lambda m: ca.dot(ca.cross(m.omega, m.y_dot), m.x_dot)),
        ("x", lambda m: m.x),
    ],
)  # fmt: skip
def test_an_expression_is_what_it_says(text, by_hand):
    for state in fp.State.random(RNG, 3):
        moved = fp.State.from_packed(state.packed() + np.append(RNG.normal(size=3), np.zeros(21)))
        np.testing.assert_allclose(
            values(Expression(text, "keep", compares=True), moved), values(by_hand, moved), rtol=1e-9, atol=1e-9
        )


def test_a_norm_has_a_slope_in_hover():
    """The first thing that one limits is the distance from the origin, where hover is."""
    function = own_function(Expression("norm(x) < 1", "keep", compares=True), 4, "keep")
    state, forces = ca.SX.sym("s", 24), ca.SX.sym("f", 4)
    slope = ca.Function("slope", [state, forces], [ca.jacobian(function(state, forces), state)])
    assert np.all(np.isfinite(np.array(slope(fp.State(y=(0, 0, 1)).packed(), FORCES))))


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("", "keep: expected an expression such as"),
        ("x[2] <", "keep: expected an expression such as"),
        ("(" * 5000, "keep: expected an expression such as"),
        ("x[5]", "indices from 0, got x.5."),
        ("x + rotor_forces", "shapes that fit"),
        ("1/0", "shapes that fit"),
        ("9**9**9**9", "shapes that fit"),
        ("z", "expected one of x, x_dot"),
        ("sqr(x[0])", "did you mean 'sqrt'"),
        ("sqrt(x[0], 2)", "shapes that fit"),
        ("x[0] == 1", "keep: expected < and >"),
        ("x.__class__", "keep: expected numbers, x"),
        ("__import__('os')", "expected one of sqrt"),
        ("[i for i in x]", "keep: expected numbers, x"),
        ("True", "keep: expected numbers, x"),
        ("'a'", "keep: expected numbers, x"),
    ],
)
def test_anything_else_is_refused_in_a_line(text, line):
    with pytest.raises(fp.InputError, match=line) as caught:
        Expression(text, "keep", compares=True)
    assert "\n" not in str(caught.value)


def test_a_cost_compares_nothing():
    with pytest.raises(fp.InputError, match="cost: expected values, which are squared"):
        Expression("x[0] < 1", "cost", compares=False)
