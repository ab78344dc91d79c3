"""Theorem A under small forces: the inequality behind its bounds against every force, and flights against the worst."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from benchmarks.withstood import withstood
from flypend.laws.closed_loop import symbolic_loop
from flypend.laws.repaired import stiffness
from flypend.model.state import project
from tests.few import each_once

RATE = slice(21, 24)  # ẏ in a packed state
LAWS = {
    "proposed": fp.laws.repaired().bind(fp.vehicle("nayak2018")),
    "the paper's gains": fp.laws.repaired(k_d=2.0, k_1=6.6, k_2=4.18).bind(fp.vehicle("nayak2018")),
    "hehn2011": fp.laws.repaired().bind(fp.vehicle("hehn2011")),
}


def functions(law, cross):
    """(s, w) → V, W, Ẇ with the rod accelerated by w, |∂V/∂ẏ|; (s, size) → rates under the worst w of this size."""
    loop = symbolic_loop(law.vehicle, law)
    V, w, size = loop.signals["V"], ca.SX.sym("w", 3), ca.SX.sym("size")
    y, y_dot = loop.s[18:21], loop.s[RATE]
    W = V - cross * y_dot[2]
    pushed = loop.rates + ca.vertcat(ca.SX(21, 1), w)
    slope = ca.gradient(V, y_dot)
    slope -= ca.dot(slope, y) * y
    inputs = [ca.substitute(some, loop.t, 0) for some in (V, W, ca.jtimes(W, loop.s, pushed), ca.norm_2(slope))]
    worst = size * slope / ca.fmax(ca.norm_2(slope), 1e-12)
    against = ca.substitute(loop.rates + ca.vertcat(ca.SX(21, 1), worst), loop.t, 0)
    return ca.Function("at", [loop.s, w], inputs), ca.Function("against", [loop.s, size], ca.cse([against]))


def drawn(rng, count, size):
    """States near the hanging pose, of sizes up to `size`, and accelerations of their rods (count, 3)."""
    sizes = size * rng.uniform(0.01, 1, (count, 1))
    turned = [fp.geometry.rotation_from_vector(v) for v in sizes * rng.standard_normal((count, 3))]
    y = np.array(turned)[..., 2]
    rate = fp.geometry.project_tangent(y, 3 * sizes * rng.standard_normal((count, 3)))
    R = np.array([fp.geometry.rotation_from_vector(v) for v in sizes * rng.standard_normal((count, 3))])
    states = fp.State(y=y, y_dot=rate, R=R, omega=3 * sizes * rng.standard_normal((count, 3)))
    return states.packed(), fp.geometry.project_tangent(y, rng.standard_normal((count, 3)))


@pytest.mark.parametrize(("name", "share"), each_once(LAWS, (0.01, 0.5, 1.5)))
def test_w_falls_against_every_acceleration_wherever_v_is_below_the_level(name, share):
    law = LAWS[name]
    bound = withstood(law, share * float(stiffness(law.vehicle)))
    at, _ = functions(law, bound.cross)
    theta = bound.cross / np.sqrt(float(stiffness(law.vehicle)))
    packed, w = drawn(np.random.default_rng(3), 4000, 0.8 * np.sqrt(share))
    V, W, W_rate, slope = (np.array(some)[0] for some in at(packed.T, w.T))
    inside = bound.level >= V
    assert inside.sum() > 500
    V, W, W_rate, slope, size = V[inside], W[inside], W_rate[inside], slope[inside], np.linalg.norm(w[inside], axis=1)
    roundoff = 1e-9 * (1 + V)
    assert np.all(np.abs(W - V) <= theta * V + roundoff)
    assert np.all(W_rate <= -bound.fall * V + bound.push * np.sqrt(V) * size + roundoff)
    assert np.all(slope <= bound.push * np.sqrt(V) + roundoff)
    assert np.max(slope / np.sqrt(V)) > 0.01 * bound.push  # it is a bound of something


def test_without_the_cross_term_v_does_not_fall():
    """The control: where ẏ = 0 and the axis follows its target, V̇ = 0 although the rod is turned."""
    law = LAWS["proposed"]
    at, _ = functions(law, 0.0)
    sine, cosine = np.sin(0.5), np.cos(0.5)
    follows = law.gains["k_d"] * sine * cosine  # ż_d, while the rod is let go
    turned = fp.State(y=(sine, 0, cosine), omega=(0, follows, 0))
    V, _, V_rate, _ = (float(some) for some in at(turned.packed(), np.zeros(3)))
    assert V > 1
    assert V_rate == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("share", [0.1, 1.0])
def test_flights_against_the_worst_acceleration_stay_below_the_bound(share):
    law = LAWS["proposed"]
    k_p = float(stiffness(law.vehicle))
    bound = withstood(law, share * k_p)
    at, against = functions(law, 0.0)
    packed, _ = drawn(np.random.default_rng(4), 400, np.sqrt(share))
    V = np.array(at(packed.T, np.zeros(3))[0])[0]
    s = packed[bound.start >= V][-12:]
    assert len(s) == 12
    V_0 = np.array(at(s.T, np.zeros(3))[0])[0]
    assert V_0.max() > 0.5 * bound.start
    step, size = 5e-3, bound.most
    rates = against.map(len(s))
    for k in range(1, 1001):
        k_1 = np.array(rates(s.T, size)).T
        k_2 = np.array(rates((s + step / 2 * k_1).T, size)).T
        k_3 = np.array(rates((s + step / 2 * k_2).T, size)).T
        k_4 = np.array(rates((s + step * k_3).T, size)).T
        s = project(s + step / 6 * (k_1 + 2 * k_2 + 2 * k_3 + k_4))[0]
        if k % 50 == 0:
            root = np.sqrt(np.array(at(s.T, np.zeros(3))[0])[0])
            assert np.all(root <= bound.overshoot * np.exp(-bound.rate * k * step) * np.sqrt(V_0) + bound.gain * size)
            assert np.all(root**2 <= bound.level)
    assert root.max() > 0.9 * size / np.sqrt(2 * k_p)  # what a constant one would leave, and no less


@pytest.mark.parametrize("level", [0.0, -1.0, 49.06])
def test_a_level_at_the_saddle_is_refused(level):
    with pytest.raises(fp.InputError, match=r"2 k_p = 49\.05"):
        withstood(LAWS["proposed"], level)
