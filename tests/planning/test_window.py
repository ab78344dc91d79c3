"""Windows and waypoints: nothing of the machine touches the frame, and what cannot pass is told in a line."""

from functools import partial

import numpy as np
import pytest

import flypend as fp
from flypend.geometry import norm
from flypend.planning.dynamics import Units
from flypend.planning.window import NEAR, _locate, body_of, through
from tests.few import slow

HEHN = fp.vehicle("hehn2011")
HOVER = {"rotors": np.full(4, HEHN.weight / 4), "target": (1.5, 0, 0)}
START = fp.State(x=(-1.5, 0, 0), y=(0, 0, 1))
DOOR = fp.Window(centre=(0, 0.25, 0.3), width=0.5, height=1.0)
# A busy machine must not decide what is found.
plan_of = partial(fp.plan, time_limit=120.0)


def solid(states, vehicle):
    """Points (n, k, 3) all over rod, arms, hub and discs, and their radii (k,)."""
    body, centres = vehicle.body, vehicle.rotors_from_pivot
    angles, shares = np.meshgrid(np.linspace(0, 2 * np.pi, 180), np.linspace(0.2, 1, 5))
    disc = np.stack([shares * np.cos(angles), shares * np.sin(angles), 0 * angles], axis=-1).reshape(-1, 3)
    held = [c + body.disc_radius * disc for c in centres] + [body.hub_radius * disc]
    thin = np.concatenate(held)
    arms = np.concatenate([np.linspace(0, 1, 50)[:, None] * c for c in centres])
    x, turn = states.x[:, None], np.swapaxes(states.R, -1, -2)
    rod = x + np.linspace(0, vehicle.reach, 150)[:, None] * states.y[:, None]
    points = np.concatenate([rod, x + arms @ turn, x + thin @ turn], axis=1)
    thick = [np.full(150, body.rod_radius), np.full(len(arms), body.arm_radius), np.zeros(len(thin))]
    return points, np.concatenate(thick)


def brute_room(window, states, vehicle):
    """How much room is left, by points alone: in the window's coordinates, those within 3 mm of the wall."""
    points, radii = solid(states, vehicle)
    n = np.array(window.normal) / norm(window.normal)
    v = np.array(window.up) - np.dot(window.up, n) * n
    v = v / norm(v)
    about = points - window.centre
    s, a, b = about @ n, about @ np.cross(n, v), about @ v
    left = np.minimum(window.width / 2 - np.abs(a), window.height / 2 - np.abs(b)) - radii
    return np.min(np.where(np.abs(s) < 3e-3 + window.depth / 2, left, np.inf), axis=1)


def check_passes(plan, window):
    assert plan, plan.reason
    assert norm(plan.x[-1] - plan.target) < 0.01 * plan.vehicle.l
    side = (plan.x[[0, -1]] - window.centre) @ window.normal
    assert side[0] * side[1] < 0
    assert np.min(brute_room(window, plan.states, plan.vehicle)) > 0


@pytest.fixture(scope="module")
def through_the_door():
    return plan_of(HEHN, START, "effort", window=DOOR, lean=np.pi / 2, **HOVER)


def test_the_rod_is_carried_upright_through_a_door_narrower_than_it_is_long(through_the_door):
    assert DOOR.width < HEHN.reach
    check_passes(through_the_door, DOOR)
    assert np.min(through_the_door.y[:, 2]) > 0.8
    # Without the wish it flies into the frame.
    free = plan_of(HEHN, START, "effort", lean=np.pi / 2, **HOVER)
    assert np.min(brute_room(DOOR, free.states, HEHN)) < -0.02


def test_it_is_flown_in_mujoco_without_touching_the_frame(through_the_door):
    pytest.importorskip("mujoco")
    run = fp.simulate(HEHN, fp.track(through_the_door), START, through_the_door.duration + 2, plant="mujoco")
    assert fp.metrics(run).success
    assert np.min(brute_room(DOOR, run.states, HEHN)) > 0


@pytest.mark.parametrize(
    ("start", "window"),
    [
        (START, fp.Window(centre=(0, 0, 0.2), width=0.2, height=0.9)),  # rolled by more than 60°, the rod upright
        (START, fp.Window(centre=(0, 0, 0.2), width=0.7, height=0.4)),  # lower than the rod is long
        (fp.State(x=(-1.5, 0.4, 0.3), y=(0, 0, -1)), fp.Window(centre=(0, 0, 0), width=0.55, height=0.55)),
        (
            fp.State(x=(1.5, 0, -1.5), y=(0, 0, 1)),
            fp.Window(centre=(1.5, 0, -0.7), width=0.7, height=0.6, normal=(0, 0, 1), up=(1, 0, 0)),
        ),
        (START, fp.Window(centre=(0, 0, 0.2), width=0.6, height=1.0, normal=(1, 0.4, 0), depth=0.1)),
    ],
    ids=["slot", "low", "from hanging", "hatch", "oblique and deep"],
)
def test_windows_of_all_kinds(start, window):
    check_passes(plan_of(HEHN, start, "effort", window=window, **HOVER), window)


def test_two_windows_and_a_hub():
    windows = [fp.Window((-0.5, 0.2, 0.2), 0.5, 1.0), fp.Window((0.5, -0.2, 0.3), 0.5, 1.0)]
    plan = plan_of(HEHN.replace(mount="hub"), START, "effort", window=windows, lean=1.5, **HOVER)
    for window in windows:
        check_passes(plan, window)
    assert np.min(plan.trajectory.clearance) > 0


def test_what_comes_nearer_than_the_clearance_says_so():
    """A cost grows for it, which the least time pays."""
    hub, hanging = HEHN.replace(mount="hub"), fp.State(y=(0, 0, -1))
    plan = fp.plan(hub, hanging, "time", clearance=0.05)
    assert plan.status == "feasible"
    distance = plan.trajectory.clearance
    wish, nearest = min(0.05, distance[0]), np.min(distance)  # the start is nearer than the clearance
    assert nearest < 0.01 < 0.03 < wish
    assert f"clearance is {wish - nearest:.3g} m" in plan.reason
    kept = fp.plan(hub, hanging, clearance=0.01)
    assert np.min(kept.trajectory.clearance) > 0.0099
    assert "clearance" not in kept.reason


def test_room_agrees_with_points_all_over_the_machine(through_the_door):
    """Where it is least; polygons about the discs are 0.5 mm too large, and points are up to 5 mm from each other."""
    room, brute = DOOR.room(through_the_door.states, HEHN), brute_room(DOOR, through_the_door.states, HEHN)
    assert abs(np.min(room) - np.min(brute)) < 8e-3


def test_room_of_a_machine_that_stands_in_the_middle():
    """The disc at the side is 0.17 m out and has a radius of 0.0635 m; the rod reaches up by 0.565 m."""
    state = fp.State(x=np.zeros((1, 3)), y=[(0, 0, 1)])
    wide = fp.Window((0, 0, 0), 0.6, 2.0).room(state, HEHN)
    np.testing.assert_allclose(wide, 0.3 - 0.17 - 0.0635 / np.cos(np.pi / 24), atol=1e-12)
    low = fp.Window((0, 0, 0), 2.0, 1.0).room(state, HEHN)
    np.testing.assert_allclose(low, 0.5 - HEHN.reach - HEHN.body.rod_radius, atol=1e-12)
    assert fp.Window((1, 0, 0), 0.1, 0.1).room(state, HEHN) == np.inf


def test_the_disc_about_the_rotors_is_where_they_are():
    vehicle = HEHN.replace(rotor_positions=np.add(HEHN.rotor_positions, (0, 0, 0.05)))
    state, units = fp.State.random(np.random.default_rng(1)), Units.of(vehicle)
    numbers = through(DOOR, vehicle, (START, fp.State(x=HOVER["target"], y=(0, 0, 1))), np.zeros(3), 0.0)
    points = np.array(_locate()(state.packed() / units.of_state, numbers))[:, 1:].reshape(2, 5, 3) * units.length
    middle = DOOR.inside(state.x + 0.05 * state.R[:, 2])
    np.testing.assert_allclose(points[:, 3:].mean(axis=1), [middle, middle], atol=1e-12)
    assert norm(points[:, 3:] - middle).max() <= body_of(vehicle)[0] * (1 + 1e-12)


def test_waypoints_are_passed_in_order():
    points = np.array([(-0.5, 0.5, 0.3), (0.0, -0.5, -0.3), (0.5, 0.5, 0.0)])
    plan = plan_of(HEHN, START, "effort", waypoints=points, lean=1.5, **HOVER)
    assert plan
    distance = norm(plan.x[:, None] - points)
    assert np.all(np.min(distance, axis=0) < NEAR * HEHN.l)
    assert np.all(np.diff(np.argmin(distance, axis=0)) > 0)
    assert np.min(plan.y[:, 2]) > 0


def test_no_stage_steps_over_a_waypoint():
    """At 3.4 m/s a stage is 7 cm long: with gates of 6 cm no plan passed all of these within 28 mm."""
    points = np.array([(-0.75, 0.366, 0.185), (0.0, 0.018, -0.129), (0.75, -0.535, -0.07)])
    plan = plan_of(HEHN, START, "effort", waypoints=points, lean=np.pi / 2, target=(1.5, 0, 0))
    assert plan
    assert plan.duration < 3.1


def test_an_ensemble_flies_through_as_well():
    starts = fp.State(x=[(-1.5, 0, 0), (-1.2, 0.2, 0.1)], y=[(0, 0, 1), (0, 0, 1)])
    for plan in fp.plan_ensemble(HEHN, starts, "effort", window=DOOR, lean=1.5, workers=1, **HOVER):
        check_passes(plan, DOOR)


def test_a_window_too_small_is_told_in_a_line():
    window = fp.Window((0, 0, 0.2), 0.2, 0.2)
    plan = fp.plan(HEHN, START, "effort", window=window, duration=3.0, time_limit=20, **HOVER)
    assert not plan
    assert plan.reason.startswith(("the frame of a window is 0.", "inverted hover is not reached"))


@pytest.mark.parametrize(
    ("wish", "line"),
    [
        ({"window": fp.Window((0, 0, 0), 0.03, 0.5)}, "window: expected an opening of more than 0.035"),
        ({"window": fp.Window((3, 0, 0), 0.5, 1.0)}, "window: expected one between start and target"),
        ({"window": fp.Window((-1.5, 2, 0), 0.5, 1.0)}, "window: expected one between start and target"),
        ({"window": fp.Window((-1.45, 2, 0), 0.5, 1.0)}, "window: expected walls that start, target"),
        ({"window": 0.5}, "window: expected a Window, or several"),
        ({"waypoints": [(3, 0, 0)]}, "waypoints: expected points that follow each other"),
        ({"waypoints": [(0.5, 0, 0), (-0.5, 0, 0)]}, "waypoints: expected points that follow each other"),
        ({"waypoints": (0, 0, 0)}, "waypoints"),
    ],
)
def test_bad_wishes_are_refused(wish, line):
    with pytest.raises(fp.InputError, match=line):
        fp.plan(HEHN, START, **HOVER, **wish)


def test_a_vehicle_without_a_body_is_refused():
    with pytest.raises(fp.InputError, match=r"vehicle\.body"):
        fp.plan(HEHN.replace(body=None), START, window=DOOR, **HOVER)


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"width": 0}, "window.width"),
        ({"depth": -0.1}, "window.depth"),
        ({"normal": (0, 0, 0)}, "window.normal: expected a direction"),
        ({"normal": (0, 0, 2)}, "window.up: expected a direction along the wall"),
        ({"centre": (0, 0)}, "window.centre"),
        ({"size": 3}, "Window"),
    ],
)
def test_windows_that_are_none_are_refused(changes, line):
    with pytest.raises(fp.InputError, match=line):
        fp.Window(**{"centre": (0, 0, 0), "width": 1.0, "height": 1.0, **changes})


@pytest.mark.parametrize(("width", "height", "degrees"), [slow(0.7, 0.4, 60), (0.55, 0.4, 75)])
def test_a_rod_that_must_lean_and_may_not_fall_passes_a_low_window(width, height, degrees):
    """Upright is a saddle, which guesses that stay upright do not leave."""
    window, limit = fp.Window(centre=(0, 0, 0.2), width=width, height=height), np.radians(degrees)
    assert height < HEHN.reach < height / np.cos(limit)
    plan = plan_of(HEHN, START, "effort", window=window, lean=limit, **HOVER)
    check_passes(plan, window)
    assert np.max(np.arccos(plan.y[:, 2])) <= limit + 1e-3
