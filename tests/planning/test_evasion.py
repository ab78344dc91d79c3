"""While there is no plan the rod is kept off the parts of a hub, where constant rotor forces can."""

import numpy as np
import pytest

import flypend as fp
from flypend.flight.tasks import task_starts
from flypend.model.state import SIZE
from flypend.planning.fallback import BEYOND, commands, evasion, room
from flypend.planning.feedback import step_program

HUB = fp.vehicle("hehn2011").replace(mount="hub")
WAIT = 0.054  # s


@pytest.fixture(scope="module")
def starts():
    return task_starts(HUB, 21, 501)["random"]


def path_under(command, state, rotors, wait):
    step, path = step_program(HUB), [np.append(state, rotors)]
    for _ in range(27):
        path.append(step(path[-1][:SIZE], path[-1][SIZE:], command, wait / 27))
    return np.array(path)


def test_an_evasion_keeps_more_room_than_hover_and_ends_where_it_says(starts):
    low, better = HUB.rotor_limits[0], 0
    for i in range(21):
        state, rotors = starts[i].packed(), np.full(4, low)
        command, kept, end = evasion(HUB, state, rotors, WAIT)
        path = path_under(command, state, rotors, WAIT)
        np.testing.assert_allclose(path[-1], end, atol=2e-3)  # steps of 4.5 and 2 ms
        hovering = room(path_under(np.full(4, HUB.weight / 4), state, rotors, WAIT), HUB)
        farther = path_under(command, state, rotors, (1 + BEYOND) * WAIT)
        assert kept <= min(room(path, HUB), room(farther, HUB)) + 1e-3  # it looks farther ahead
        better += kept > hovering + 1e-3
    assert better >= 5


@pytest.mark.parametrize("name", ["hehn2011", "crazyflie"])
def test_commands_are_within_limits_and_turn_both_ways(name):
    vehicle = fp.vehicle(name)
    tried = np.array(commands(vehicle))
    assert np.min(tried) >= vehicle.rotor_limits[0]
    assert np.max(tried) <= vehicle.rotor_limits[1]
    moments = tried @ vehicle.mixing()[1:3].T
    np.testing.assert_allclose(np.sum(moments, axis=0), 0, atol=1e-9)
    assert np.linalg.matrix_rank(moments, tol=1e-6 * np.max(np.abs(moments))) == 2


def test_nmpc_evades_where_the_law_would_touch(starts):
    """Under the law alone the rod touches an arm before there is a plan."""
    assert fp.simulate(HUB, fp.laws.inverted(), starts[18], 0.4, plant="rotors").outcome.status == "collided"
    assert fp.simulate(HUB, fp.nmpc(HUB), starts[18], 0.4, plant="rotors").outcome.status == "completed"
