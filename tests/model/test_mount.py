"""Mounts: the distance from the rod to discs and arms against a search over the rod, and the room in a cup."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.errors import InputError
from flypend.geometry import random_rotation, random_sphere
from flypend.model.body import Body
from flypend.model.mount import clearances, least_margin, margins, margins_of, part_names
from flypend.model.rod import uniform_rod

LENGTH = 0.565
BODY = Body(disc_radius=0.0635, arm_radius=0.006, hub_radius=0.03, rod_radius=0.005)
CENTRES = np.array([[0.17, 0, 0], [0, -0.17, 0], [-0.17, 0, 0], [0, 0.17, 0]])


def rods(count, seed=0):
    """Unit vectors, half of them near the plane of the rotors, where discs are."""
    vectors = np.random.default_rng(seed).standard_normal((count, 3))
    vectors[::2, 2] *= 0.1
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def searched(rod, centre, body=BODY, points=20_001):
    """Least distance from points of the rod to points of the disc, from its definition."""
    along = np.linspace(body.hub_radius, LENGTH, points)[:, None] * rod - centre
    beyond = np.maximum(np.hypot(along[:, 0], along[:, 1]) - body.disc_radius, 0)
    return np.hypot(beyond, along[:, 2]).min() - body.rod_radius


@pytest.mark.parametrize("height", [0.0, 0.02, -0.015])
def test_the_distance_to_a_disc_is_the_least_over_the_rod(height):
    centres, sample = CENTRES + np.array([0, 0, height]), rods(150)
    found = clearances(sample, centres, LENGTH, BODY)
    for rod, row in zip(sample, found, strict=True):
        for centre, value in zip(centres, row[:4], strict=True):
            # Points of the search are 27 µm apart. A rod through a disc has a depth below that; the search finds 0.
            assert max(value, -BODY.rod_radius) == pytest.approx(searched(rod, centre), abs=1e-4)


def test_a_rod_through_a_disc_is_as_deep_as_its_way_to_the_rim():
    """A disc 2 cm above the pivot, crossed 1 cm inside its rim."""
    target = np.array([0.17 - 0.0635 + 0.01, 0, 0.02])
    value = clearances(target / np.linalg.norm(target), CENTRES + np.array([0, 0, 0.02]), LENGTH, BODY)[0]
    assert value == pytest.approx(-0.01 - BODY.rod_radius, abs=1e-12)


def test_the_distance_to_an_arm_is_the_least_over_both():
    s = np.linspace(BODY.hub_radius, LENGTH, 400)[:, None]
    q = np.linspace(BODY.hub_radius, 0.17, 400)
    for rod in rods(40, seed=1):
        for centre, value in zip(CENTRES, clearances(rod, CENTRES, LENGTH, BODY)[4:], strict=True):
            along = centre / np.linalg.norm(centre)
            squared = s[:, 0, None] ** 2 + q**2 - 2 * s[:, 0, None] * q * (rod @ along)
            assert value == pytest.approx(np.sqrt(squared.min()) - 0.011, abs=1e-9)


def test_a_rotor_at_the_pivot_has_a_disc_and_no_arm():
    centres = np.vstack([CENTRES, np.zeros(3)])
    found, others = clearances(rods(40), centres, LENGTH, BODY), clearances(rods(40), CENTRES, LENGTH, BODY)
    assert np.array_equal(found[:, [0, 1, 2, 3, 5, 6, 7, 8]], others)
    assert np.all(found[:, 9] > found[:, 4])  # never the nearest part
    symbol = ca.SX.sym("q", 3)
    same = ca.Function("f", [symbol], [clearances(symbol, centres, LENGTH, BODY)])
    assert np.array(same(rods(40)[7])).ravel() == pytest.approx(found[7], abs=1e-12)


def test_between_two_arms_the_rod_passes_and_along_an_arm_it_does_not():
    """It may cross the plane of the rotors as far from the bisector as disc and rod together leave room."""
    room = np.pi / 4 - np.arcsin((BODY.disc_radius + BODY.rod_radius) / 0.17)
    for angle, passes in ((0, True), (room - 1e-6, True), (room + 1e-6, False), (np.pi / 4, False)):
        bearing = np.pi / 4 + angle
        rod = np.array([np.cos(bearing), np.sin(bearing), 0.0])
        assert (clearances(rod, CENTRES, LENGTH, BODY).min() > 0) == passes
    assert np.degrees(room) == pytest.approx(21.2, abs=0.05)


@pytest.mark.parametrize("height", [0.0, 0.02, -0.015])
def test_the_nearest_part_is_found_without_a_look_at_the_others(height):
    """Rotors of equal height and distance: the smallest margin and its place, from one disc and one arm."""
    vehicle = fp.vehicle("hehn2011").replace(mount="hub", rotor_positions=CENTRES + np.array([0, 0, height]))
    u, push = ca.SX.sym("u", 3), ca.SX(0)
    nearest = ca.Function("nearest", [u], [ca.vertcat(*least_margin(u, push, vehicle))])
    for rod in rods(500, seed=6):
        every = margins_of(rod, np.zeros(()), vehicle)
        least, place, clearance = nearest(rod).full().ravel()
        assert least == clearance == pytest.approx(every.min(), abs=1e-12)
        assert every[int(place)] == pytest.approx(every.min(), abs=1e-12)


@pytest.mark.parametrize("e3", ["up", "down"])
@pytest.mark.parametrize("mount", ["hub", "cup", "gimbal"])
def test_symbols_numbers_and_frames_agree(mount, e3):
    vehicle = fp.vehicle("hehn2011").replace(mount=mount)
    states = fp.State.random(np.random.default_rng(3), 50)
    wrench = fp.Wrench(np.linspace(0, 9, 50), np.zeros((50, 3)))
    up = margins(states, wrench, vehicle, "up")
    assert up.shape == (50, len(part_names(vehicle)))
    if e3 == "down":
        states, wrench = states.flipped(), wrench.flipped()
    packed, f = ca.SX.sym("s", 24), ca.SX.sym("f")
    written = margins(fp.State.symbolic(packed), fp.Wrench(f, ca.SX.zeros(3)), vehicle, e3)
    values = ca.Function("margins", [packed, f], [ca.densify(written)])
    symbolic = np.array([values(row, thrust).full().ravel() for row, thrust in
                         zip(states.packed(), wrench.thrust, strict=True)]).reshape(50, -1)  # fmt: skip
    np.testing.assert_allclose(margins(states, wrench, vehicle, e3), up, atol=1e-12)
    np.testing.assert_allclose(symbolic, up, atol=1e-12)


def test_the_room_in_a_cup_is_the_distance_of_the_bob_to_the_cone():
    vehicle = fp.vehicle("hehn2011").replace(mount="cup", body={**BODY.to_dict(), "cup_angle": 1.0})
    rng = np.random.default_rng(5)
    states = fp.State(y=random_sphere(rng, (30,)), R=random_rotation(rng, (30,)))
    room = margins(states, fp.Wrench(np.ones(30), np.zeros((30, 3))), vehicle, "up")[:, 0]
    lean = np.arccos(np.einsum("ni,ni->n", states.y, states.z))
    along = np.linspace(0, 1, 20_001)[:, None]  # the generator of the cone next to the bob
    bob = vehicle.l * np.stack([np.sin(lean), np.cos(lean)])
    least = np.hypot(along * np.sin(1.0) - bob[0], along * np.cos(1.0) - bob[1]).min(axis=0)
    np.testing.assert_allclose(room, np.where(lean < 1.0, least, -least), atol=1e-4)


@pytest.mark.parametrize("rod", [{}, uniform_rod(0.1, 1.0)], ids=["bob", "uniform"])
def test_a_cup_can_push_but_not_pull(rod):
    """At hover the cup carries the rod's weight; a vehicle in free fall with a spinning rod would have to pull."""
    vehicle = fp.vehicle("hehn2011").replace(mount="cup", **rod)
    hover = margins(fp.State(y=(0, 0, 1)), fp.Wrench(vehicle.weight, np.zeros(3)), vehicle, "up")
    assert hover[1] == pytest.approx(vehicle.bob_mass * vehicle.g)
    spinning = margins(fp.State(y=(0, 0, 1), y_dot=(3, 0, 0)), fp.Wrench(0.0, np.zeros(3)), vehicle, "up")
    assert spinning[1] < 0


def test_a_run_knows_clearance_cone_and_tension():
    """A law that does not know its mount swings the rod into an arm of hehn2011."""
    low = fp.State(y=(0.6, 0, -0.8))
    run = fp.simulate(fp.vehicle("hehn2011").replace(mount="hub"), fp.laws.almost_global(), low, 3)
    assert run.clearance.shape == run.cone.shape == run.tension.shape == run.t.shape
    assert run.outcome.status == "collided"
    # The last sample lies at most 10 ms before the touch, in which the rod turns by a few degrees.
    assert 0 < run.clearance[-1] < 0.01 < run.clearance[0]
    assert run.cone[0] == pytest.approx(np.pi - np.arcsin(0.6))
    free = fp.simulate(fp.vehicle("hehn2011"), fp.laws.almost_global(), low, 12)
    assert free.cone[-1] < 0.05
    assert free.tension[0] > 0 > free.tension[-1]
    assert np.all(np.isinf(free.clearance))


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"mount": "socket"}, "mount"),
        ({"mount": "hub", "body": None}, "body"),
        ({"body": {**BODY.to_dict(), "rod_radius": 0}}, "body.rod_radius"),
        ({"body": {**BODY.to_dict(), "cup_angle": 2}}, "body.cup_angle"),
        ({"body": {**BODY.to_dict(), "colour": 1}}, "body.colour"),
        ({"body": 3}, "body"),
    ],
)
def test_an_impossible_mount_is_refused(changes, field):
    with pytest.raises(InputError) as refused:
        fp.vehicle("hehn2011").replace(**changes)
    assert refused.value.field == field


def test_a_body_needs_its_radii_and_takes_changes_of_some():
    vehicle = fp.vehicle("hehn2011")
    with pytest.raises(InputError) as refused:
        fp.Vehicle(**{**vehicle.to_dict(), "body": {"disc_radius": 0.1}})
    assert refused.value.field == "body.arm_radius"
    changed = vehicle.replace(body={"disc_radius": 0.1}).body
    assert changed.disc_radius == 0.1
    assert changed.arm_radius == vehicle.body.arm_radius


def test_a_vehicle_with_a_mount_survives_its_toml():
    vehicle = fp.vehicle("hehn2011").replace(mount="hub", body=BODY)
    assert fp.Vehicle(**vehicle.to_dict()) == vehicle != fp.vehicle("hehn2011")
    assert "body" not in vehicle.replace(mount="gimbal", body=None).to_dict()
