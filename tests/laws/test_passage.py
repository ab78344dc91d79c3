"""The way between the arms: bearings, the slope that yaw follows, and a swing-up on a hub that touches nothing."""

import casadi as ca
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import flypend as fp
from flypend.laws.passage import LEVEL_FLOOR, STEERING, heading, passage_of, steer
from flypend.model.mount import clearances

HUB = fp.vehicle("hehn2011").replace(mount="hub")


def _steered(bearing, vehicle=HUB):
    way = ca.DM([np.cos(bearing), np.sin(bearing)])
    found = steer(fp.State(y=(0, 0, 1)), way, passage_of(vehicle))
    return float(found.clear), float(found.yaw)


def test_the_way_is_clear_in_the_gaps_and_blocked_over_the_arms():
    for turn in range(4):
        assert _steered(np.pi / 4 + turn * np.pi / 2)[0] == 1
        assert _steered(turn * np.pi / 2)[0] == pytest.approx(0, abs=1e-12)


def test_yaw_takes_the_nearer_gap_to_the_rod():
    for bearing in np.radians([5, 20, 40, 95, 130, 200]):
        off = (bearing - np.pi / 4 + np.pi / 4) % (np.pi / 2) - np.pi / 4
        assert np.sign(_steered(bearing)[1]) == np.sign(off)  # the rod beyond the gap: turn after it


def test_the_yaw_demanded_is_the_slope_of_the_crowding():
    """A body that yaws forward has the rod at a smaller bearing."""
    passage = passage_of(HUB)

    def crowding(bearing):
        return np.sum(((1 + passage.arms @ [np.cos(bearing), np.sin(bearing)]) / 2) ** passage.power)

    for bearing in np.linspace(0.1, 6.2, 9):
        slope = (crowding(bearing + 1e-5) - crowding(bearing - 1e-5)) / 2e-5
        assert _steered(bearing)[1] == pytest.approx(STEERING * passage.turning * slope, rel=1e-7, abs=1e-7)


@pytest.mark.parametrize("seed", range(5))
def test_the_heading_is_where_the_rod_will_be_seen_from_a_body_that_yaws(seed):
    """Against a body that has turned by then."""
    rng, time = np.random.default_rng(seed), 0.1
    state = fp.State.random(rng)
    axis = np.linalg.qr(rng.standard_normal((3, 3)))[0][0]

    def way(R, rate, ahead):
        seen = fp.State(R=R, omega=(0.3, -0.2, rate), y=state.y)
        return np.asarray(ca.DM(heading(seen, ca.DM(state.y), ca.DM(axis), ahead))).ravel()

    for rate in (-0.8, 0.5):
        turned = state.R @ Rotation.from_rotvec([0, 0, rate * time]).as_matrix()
        # A turn by 2 atan(angle/2) instead of the angle: angle³/12 < 5e-5.
        np.testing.assert_allclose(way(state.R, rate, time), way(turned, rate, 0.0), atol=5e-5)
        assert np.linalg.norm(way(state.R, rate, time) - way(state.R, rate, 0.0)) > 1e-3


@pytest.mark.parametrize("seed", range(3))
def test_the_heading_is_where_the_rod_will_be_seen_from_a_body_whose_thrust_axis_has_turned(seed):
    """The axis takes the arms along: a rod on it appears on the other side."""
    rng, tilt = np.random.default_rng(seed), 1e-4
    state = fp.State.random(rng)
    across = np.append(rng.standard_normal(2), 0.0)
    R = state.R @ Rotation.from_rotvec(tilt * across / np.linalg.norm(across)).as_matrix()

    def way(R):
        seen = fp.State(R=R, y=state.y)
        return np.asarray(ca.DM(heading(seen, ca.DM(state.y), ca.DM(axis), 0.0))).ravel()

    axis = R[:, 2]
    np.testing.assert_allclose(way(state.R), way(R), atol=100 * tilt**2)  # of second order; over LEVEL_FLOOR
    now = (state.R.T @ state.y)[:2]
    now = now / np.sqrt(now @ now + LEVEL_FLOOR**2)
    assert np.linalg.norm(now - way(R)) > 5e-6  # from a body that does not turn


def test_arms_need_not_be_even():
    arms = [[0.17, 0.02, 0], [0.02, -0.17, 0], [-0.17, 0.03, 0], [0, 0.17, 0]]
    found = passage_of(HUB.replace(rotor_positions=arms))
    assert np.min(np.arccos(found.arms @ found.gap[:2])) > np.radians(45)


def test_the_swing_up_from_hanging_at_rest_touches_neither_disc_nor_arm_on_a_hub():
    def least(vehicle):
        times = np.arange(2501) / 500
        run = fp.simulate(vehicle, fp.laws.inverted(), fp.State(y=(0, 0, -1)), 5.0, plant="rotors", times=times)
        assert run.y[-1, 2] > 0.99
        rod = np.einsum("nji,nj->ni", run.R, run.y)
        return np.min(clearances(rod, HUB.rotor_positions, HUB.l, HUB.body))

    assert least(HUB) > 0.005  # m; 0.012
    assert least(fp.vehicle("hehn2011")) < 0  # negative control: the gimbal's law does not care
