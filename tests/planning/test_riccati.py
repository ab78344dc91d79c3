"""The recursion against the linear equations of the same problem, written out and solved at once."""

import casadi as ca
import numpy as np
import pytest

from flypend.compile.llvm.stagewise import WIDTH, lanes
from flypend.compile.numeric import as_numpy
from flypend.planning.riccati import Layout, backward, forward, solve

N, M, STAGES = 4, 2, 3


def definite(rng, size):
    root = rng.normal(size=(size, size))
    return root @ root.T + 0.1 * np.eye(size)


@pytest.fixture(scope="module", params=[1, WIDTH], ids=["a problem per lane", "one problem"])
def problem(request):
    rng = np.random.default_rng(7)
    square = ca.Sparsity.dense(N, N)
    dense = Layout(square, ca.Sparsity.dense(N, M), square, request.param)
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


def in_memory(*vectors, width):
    """Stages of a recursion, the same in every lane."""
    array = lanes(len(vectors), len(vectors[0]), width=width)
    array[:] = np.array(vectors)[..., None]
    return array


def by_recursion(layout, stages, end):
    width = WIDTH if layout.block == 1 else 1
    V = column(ca.evalf(layout.to_go(*(ca.SX(ca.DM(end[name])) for name in ("P", "p", "p_e", "c", "g", "v")))))
    costs = [
        column(ca.evalf(layout.cost(*(ca.SX(ca.DM(s[name])) for name in ("Q", "R", "q", "q_e", "r", "c", "g")))))
        for s in stages
    ]
    F = [column(ca.evalf(layout.slopes(ca.SX(ca.DM(s["A"])), ca.SX(ca.DM(s["B"]))))) for s in stages]
    to_go, gains = in_memory(*[V] * (STAGES + 1), width=width), lanes(STAGES, layout.of_gains, width=width)
    given = [in_memory(*values, width=width) for values in (F, [s["d"] for s in stages], costs)]
    backward(layout)(STAGES, to_go[1:], *given, lanes(2, width=width), to_go, gains)
    place = layout.of_shared
    c, g, v = to_go[0, place : place + 3, 0]
    epsilon, delta, found, ahead = -g / c, np.zeros(N), [], as_numpy(forward(layout))
    for slopes, s, gain, after in zip(F, stages, gains[..., 0], to_go[1:, :, 0], strict=True):
        delta, upsilon, _ = ahead(delta, epsilon, slopes, s["d"], gain, after)
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
    found = np.array(ca.DM(ca.evalf(solve(ca.SX(ca.DM(S)), ca.SX(ca.DM(right))))))
    np.testing.assert_allclose(found, np.linalg.solve(S, right), rtol=1e-9)
