"""The supervisor: the inverted law before the handover, the almost global law after it, and its guarantee."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.export.interface import interface
from flypend.geometry import E3, norm

VEHICLE = fp.vehicle("hehn2011")


def wrench_of(law, t, state):
    time, packed, F = ca.SX.sym("t"), ca.SX.sym("s", 24), ca.SX.sym("F", 6)
    external = (F[:3], F[3:])
    found = law.bind(VEHICLE).evaluate(time, fp.State.symbolic(packed), VEHICLE, external).wrench
    function = ca.Function("wrench", [time, packed, F], [ca.vertcat(found.thrust, found.moment)])
    return np.array(function(t, state.packed(), np.array([0.1, 0, -0.2, 0.01, 0.02, 0]))).ravel()


def test_one_law_flies_before_the_handover_and_the_other_after_it():
    law, state = fp.laws.supervised(handover=2.0), fp.State.random(np.random.default_rng(4))
    for time, other in ((1.999, fp.laws.inverted()), (2.0, fp.laws.almost_global())):
        np.testing.assert_allclose(wrench_of(law, time, state), wrench_of(other, time, state), rtol=1e-12)
    assert np.max(np.abs(wrench_of(law, 1.9, state) - wrench_of(law, 2.1, state))) > 0.1


def test_the_computer_is_that_of_the_inverted_law():
    assert fp.laws.supervised().bind(VEHICLE).computer == fp.laws.inverted().bind(VEHICLE).computer


def test_from_the_handover_on_v_falls_and_the_flight_converges():
    # 0.7 s after a random start the inverted law is in the middle of its throw.
    start = fp.State.random(np.random.default_rng(8), max_omega=6, max_y_dot=6)
    run = fp.simulate(VEHICLE, fp.laws.supervised(handover=0.7), start, 12.0, plant="ideal")
    V = run.signals["V_almost_global"][run.t > 0.7]
    assert V[0] > 1
    assert np.all(np.diff(V) <= 1e-9 * V[0])
    assert norm(run.y[-1] - E3) < 1e-3
    assert norm(run.x[-1]) < 1e-2


def test_a_function_of_time_is_not_exported():
    with pytest.raises(fp.InputError, match="time"):
        interface(fp.laws.supervised(), VEHICLE)
