"""What `benchmarks.near_hover` says of the linear part: the laws themselves, flown from near hover, say the same."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from benchmarks.near_hover import ERRORS, around_hover, largest, radius, wander
from flypend.geometry import E3, rotation_from_vector
from flypend.laws.closed_loop import COMMANDS, symbolic_loop
from flypend.model import State, Wrench, equations_of_motion

VEHICLE = fp.vehicle("hehn2011")
FINE = 5e-3  # s, at most, a step of Runge-Kutta's fourth order


def flight(lag, period, periods, *, late=0, told=lambda packed: packed, tilted=1e-8):
    """Return |ω|, rad/s, and the bob's distance from its place, m, (periods, 2) under a law held for a `period`, s."""
    law = (fp.laws.almost_global_lag() if lag else fp.laws.almost_global()).bind(VEHICLE)
    loop = symbolic_loop(VEHICLE, law, lag=lag)
    command = [loop.signals[name] for name in COMMANDS] if lag else [loop.wrench.thrust, loop.wrench.moment]
    asked = ca.Function("asked", [loop.t, loop.s], [ca.vertcat(*command)])
    s, w = ca.SX.sym("s", loop.s.numel()), ca.SX.sym("w", 4)
    acting = s[24:] if lag else w
    rates = equations_of_motion(State.symbolic(s[:24]), Wrench(acting[0], acting[1:]), VEHICLE, "up").packed()
    moving = ca.vertcat(rates, (w - acting) / VEHICLE.rotor_lag) if lag else rates
    steps = int(np.ceil(period / FINE))
    rhs, h = ca.Function("rhs", [s, w], [moving]), period / steps
    k1 = rhs(s, w)
    k2 = rhs(s + h / 2 * k1, w)
    k3 = rhs(s + h / 2 * k2, w)
    step = ca.Function("step", [s, w], [s + h / 6 * (k1 + 2 * k2 + 2 * k3 + rhs(s + h * k3, w))]).mapaccum(steps)
    rod = rotation_from_vector((tilted, 0.6 * tilted, 0)) @ E3
    now = State(y=rod, omega=(tilted, tilted, 0)).packed()
    hover = np.array([VEHICLE.weight, 0, 0, 0])
    if lag:
        now = np.append(now, hover)
    waiting, out = [hover] * late, []
    for _ in range(periods):
        waiting.append(np.array(asked(0, told(now))).ravel())
        now = np.array(step(now, np.tile(waiting.pop(0)[:, None], steps)))[:, -1]
        here = State.trusted(now[:24])
        out.append([np.linalg.norm(here.omega), np.linalg.norm(here.x + VEHICLE.l * (here.y - E3))])
    return np.array(out)


@pytest.mark.parametrize("lag", [False, True])
def test_the_largest_period_is_where_a_held_law_stops_converging(lag):
    A, B, K = around_hover(VEHICLE, lag=lag)
    period = 1e-3 * largest(lambda k: radius(A, B, K, 1e-3 * k) < 1)
    assert 0.03 < period < 0.1
    for factor, grows in ((0.95, False), (1.07, True)):
        flown = flight(lag, factor * period, 180 if lag else 90)[:, 0]
        ratio = flown[-10:].max() / flown[-40:-30].max()
        assert (ratio > 1) == grows
        if grows:  # at the rate of the linear part
            assert np.log(ratio) / 30 == pytest.approx(np.log(radius(A, B, K, factor * period)), rel=0.1)


def test_the_largest_delay_is_where_a_late_law_stops_converging():
    A, B, K = around_hover(VEHICLE, lag=False)
    late = largest(lambda k: radius(A, B, K, 1e-3, k) < 1)
    for more, grows in ((-4, False), (4, True)):
        flown = flight(False, 1e-3, 1000, late=late + more)[:, 0]
        assert (flown[-300:].max() > flown[-600:-300].max()) == grows


@pytest.mark.parametrize("lag", [False, True])
def test_a_measured_error_moves_the_bob_by_less_than_the_bound_and_by_the_same_order(lag):
    A, B, K = around_hover(VEHICLE, lag=lag)
    _, _, size = ERRORS[0]
    turn = rotation_from_vector((0, size, 0))  # the rod is measured off by this

    def told(packed):
        wrong = packed.copy()
        wrong[18:21] = turn @ packed[18:21]
        return wrong

    [bound] = wander(VEHICLE, A, B, K, ERRORS[:1])
    far = flight(lag, FINE, 500, told=told, tilted=0.0)[:, 1]
    assert 0.2 * bound < far.max() < bound
