"""The starts of the tasks are what their names say, for every mount."""

import numpy as np
import pytest

import flypend as fp
from flypend.flight.tasks import ASKEW, LEANS, TASKS, task_starts, touches

HEHN = fp.vehicle("hehn2011")


@pytest.mark.parametrize("mount", ["gimbal", "hub", "cup"])
def test_no_start_touches_and_the_random_ones_are_as_many_as_asked_for(mount):
    vehicle = HEHN.replace(mount=mount)
    starts = task_starts(vehicle, 50, seed=3)
    assert set(starts) == {name for name in TASKS if mount != "cup" or name not in ("hanging", "level")}
    assert len(starts["random"]) == len(starts.get("level", starts["random"])) == 50
    for name, batch in starts.items():
        allowed = name == "lean" and mount == "hub"  # a lean over an arm may begin in a disc
        assert allowed or not touches(vehicle, batch).any()


def test_random_starts_begin_alike_whatever_their_number_on_a_gimbal_and_differ_by_seed():
    few, again, other = (task_starts(HEHN, 20, seed)["random"].packed() for seed in (1, 1, 2))
    np.testing.assert_array_equal(few, again)
    assert np.max(np.abs(few - other)) > 0.1


def test_half_of_the_random_starts_on_a_hub_are_drawn_anew():
    """They are those of the gimbal that do not touch."""
    hub = HEHN.replace(mount="hub", body={"disc_radius": 0.12})
    drawn = task_starts(HEHN, 400, seed=5)["random"]
    free = drawn.packed()[~touches(hub, drawn)]
    assert 0 < len(free) < 400
    np.testing.assert_array_equal(task_starts(hub, 400, seed=5)["random"].packed()[: len(free)], free)


def test_leans_are_at_rest_in_their_order_and_inside_the_cone_of_a_cup():
    leans = task_starts(HEHN, 1, 1, directions=5)["lean"]
    assert not np.any([leans.omega, leans.y_dot, leans.x_dot])
    np.testing.assert_allclose(np.arccos(leans.y[:, 2]).reshape(-1, 5), np.tile(LEANS[:, None], 5), atol=1e-7)
    cup = HEHN.replace(mount="cup")
    starts = task_starts(cup, 100, 1)
    for batch, most in ((starts["lean"], cup.body.cup_angle), (starts["random"], cup.body.cup_angle / 2)):
        assert np.all(batch.y[:, 2] > np.cos(most) - 1e-12)


def test_the_hanging_rod_hangs_and_the_hovering_one_stands():
    starts = task_starts(HEHN, 1, 1)
    np.testing.assert_array_equal(starts["hanging"].y[0], [0, 0, -1])
    np.testing.assert_allclose(starts["hanging"].y[1:, 2], -np.cos(ASKEW), rtol=1e-12)
    np.testing.assert_allclose(starts["hanging"].z, np.tile([0, 0, 1], (13, 1)), atol=1e-15)
    assert np.all(starts["hover"].y == [0, 0, 1])
    np.testing.assert_allclose(np.linalg.norm(starts["hover"].x, axis=1), HEHN.l / 2, rtol=1e-12)


def test_a_machine_without_room_for_its_rod_is_told():
    crowded = HEHN.replace(mount="hub", body={"hub_radius": 0.16, "rod_radius": 0.35})
    with pytest.raises(fp.InputError, match=r"vehicle.body: expected a machine with room for its rod"):
        task_starts(crowded, 1, 1)


def test_a_narrow_cup_has_a_lean_too():
    narrow = HEHN.replace(mount="cup", body={"cup_angle": 0.05})
    leans = task_starts(narrow, 1, 1)["lean"]
    np.testing.assert_allclose(leans.y[:, 2], np.cos(0.025), rtol=1e-12)
