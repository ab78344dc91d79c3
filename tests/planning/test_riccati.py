"""The recursion against the linear equations of the same problem, written out and solved at once."""

import casadi as ca
import numpy as np
import pytest

from flypend.compile.numeric import as_numpy
from flypend.planning.riccati import Layout, backward, forward, solved

N, M, STAGES = 4, 2, 3


def definite(rng, size):
    root = rng.normal(size=(size, size))
    return root @ root.T + 0.1 * np.eye(size)


@pytest.fixture(scope="module")
def problem():
    rng = np.random.default_rng(7)
    square = ca.Sparsity.dense(N, N)
    dense = Layout(square, ca.Sparsity.dense(N, M), square)
    stages = [
        {
            "A": rng.normal(size=(N, N)), "B": rng.normal(size=(N, M)), "d": rng.normal(size=N), "Q": definite(rng, N),
            "R": rng.uniform(0.5, 2, M), "q": rng.normal(size=N), "q_e": rng.normal(size=N), "r": rng.normal(size=M),
            "c": rng.uniform(3, 9), "g": rng.normal(),
        }
        for _ in range(STAGES)
    ]  # fmt: skip
    end = {"P": definite(rng, N), "p": rng.normal(size=N), "p_e": rng.normal(size=N), "c": 30.0, "g": 1.0, "v": 0.4}
    return dense, stages, end


def column(values):
    return np.array(ca.DM(values)).ravel()


def by_recursion(layout, stages, end):
    back, ahead = as_numpy(backward(layout)), as_numpy(forward(layout))
    V = column(ca.evalf(layout.to_go(*(ca.SX(ca.DM(end[name])) for name in ("P", "p", "p_e", "c", "g", "v")))))
    to_go, gains = [V], []
    for s in reversed(stages):
        cost = column(ca.evalf(layout.cost(*(ca.SX(ca.DM(s[name])) for name in ("Q", "R", "q", "q_e", "r", "c", "g")))))
        V, gain = back(V, np.hstack([s["A"], s["B"]]).ravel("F"), s["d"], cost, np.zeros(2))
        to_go.insert(0, V)
        gains.insert(0, gain)
    c, g, v = to_go[0][-3:]
    epsilon, delta, found = -g / c, np.zeros(N), []
    for s, gain, after in zip(stages, gains, to_go[1:], strict=True):
        delta, upsilon, _ = ahead(delta, epsilon, np.hstack([s["A"], s["B"]]).ravel("F"), s["d"], gain, after)
        found += [*upsilon, *delta]
    return np.append(found, epsilon), v - g**2 / (2 * c)


def at_once(stages, end):
    """Minimise over all unknowns (υ_0, δ_1, υ_1, δ_2, …, ε) under the dynamics, by the KKT system."""
    size = STAGES * (N + M) + 1
    H, h, rows, right, least = np.zeros((size, size)), np.zeros(size), [], [], end["v"]
    for k, s in enumerate(stages):
        u = slice(k * (N + M), k * (N + M) + M)
        x, before = slice(u.stop, u.stop + N), slice(u.start - N, u.start)
        H[u, u] += np.diag(s["R"])
        h[u] += s["r"]
        H[-1, -1] += s["c"]
        h[-1] += s["g"]
        row = np.zeros((N, size))
        row[:, x], row[:, u] = np.eye(N), -s["B"]
        if k:
            H[before, before] += s["Q"]
            h[before] += s["q"]
            H[before, -1] += s["q_e"]
            H[-1, before] += s["q_e"]
            row[:, before] = -s["A"]
        rows.append(row)
        right.append(s["d"])
    H[x, x] += end["P"]
    h[x] += end["p"]
    H[x, -1] += end["p_e"]
    H[-1, x] += end["p_e"]
    H[-1, -1] += end["c"]
    h[-1] += end["g"]
    E = np.concatenate(rows)
    whole = np.block([[H, E.T], [E, np.zeros((len(E), len(E)))]])
    w = np.linalg.solve(whole, np.concatenate([-h, *right]))[:size]
    return w, w @ H @ w / 2 + h @ w + least


def test_the_recursion_finds_the_minimum(problem):
    found, cost = by_recursion(*problem)
    expected, least = at_once(*problem[1:])
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-10)
    assert cost == pytest.approx(least, rel=1e-10)


def test_a_definite_system_is_solved_by_its_factors():
    rng = np.random.default_rng(8)
    S, right = definite(rng, 5), rng.normal(size=(5, 3))
    found = np.array(ca.DM(ca.evalf(solved(ca.SX(ca.DM(S)), ca.SX(ca.DM(right))))))
    np.testing.assert_allclose(found, np.linalg.solve(S, right), rtol=1e-9)
