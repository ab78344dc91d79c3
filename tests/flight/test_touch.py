"""Flights that end because the rod touches: kernels against the step-by-step reference and MuJoCo's geometry."""

from itertools import pairwise

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.compile.numeric import as_numpy
from flypend.flight.touch import NEVER, room, touching
from flypend.model.mount import part_names
from tests.few import few, slow

mujoco = pytest.importorskip("mujoco")

HUB = fp.vehicle("hehn2011").replace(mount="hub")
CUP = fp.vehicle("hehn2011").replace(mount="cup")
LAW = fp.laws.inverted()
BLIND = fp.laws.almost_global()  # flies alike whatever the mount
TICKS = np.arange(2001) / 500  # every control tick of 4 s


def flown(vehicle, start, duration=4.0, law=LAW, **settings):
    return fp.simulate(vehicle, law, start, duration, times=TICKS[: int(500 * duration) + 1], **settings)


def with_forces(run):
    return np.concatenate([run.packed, run.rotor_forces], axis=1)


@pytest.mark.parametrize(("mount", "e3"), [slow("hub", "up"), ("cup", "up"), ("hub", "down")])
def test_in_the_ideal_plant_kernel_and_scipy_end_at_the_same_touch(mount, e3):
    name, law = ("hehn2011", fp.laws.inverted()) if e3 == "up" else ("nayak2018", fp.laws.corrected())
    vehicle, starts = fp.vehicle(name).replace(mount=mount), fp.random_starts(10, 31)
    starts = starts if e3 == "up" else starts.flipped()
    ends, statuses = fp.simulate_ensemble(vehicle, law, starts, 2.0, plant="ideal"), set()
    for i in range(len(ends)):
        single = fp.simulate(vehicle, law, starts[i], 2.0, plant="ideal")
        other = fp.simulate(vehicle, law, starts[i], 2.0, plant="ideal", engine="scipy")
        assert single.outcome.status == other.outcome.status
        assert single.outcome.time == ends.end[i]
        assert (ends.cause[i] == "collided") == (single.outcome.status == "collided")
        np.testing.assert_array_equal(ends.final.packed()[i], single.packed[-1])
        # The steps differ, and the rod is looked at every half millisecond or less of each.
        assert single.outcome.time == pytest.approx(other.outcome.time, abs=0.6e-3)
        # Within that time it may meet both an arm and its disc, "arm 4" and "disc 4".
        assert single.outcome.reason.split()[-1:] == other.outcome.reason.split()[-1:]
        # The trajectory has a sample every 10 ms; in between the rod may come closer.
        assert ends.clearance[i] <= single.clearance.min() + 1e-9
        statuses.add(single.outcome.status)
    assert "collided" in statuses
    assert mount == "cup" or "completed" in statuses


@pytest.mark.parametrize(("vehicle", "plant"), [(HUB, "rotors"), (CUP, "rotors"), (HUB, "mujoco")])
def test_kernel_and_reference_end_at_the_same_touch(vehicle, plant):
    starts, duration = fp.random_starts(8, 21), 1.5
    ends = fp.simulate_ensemble(vehicle, LAW, starts, duration, plant=plant)
    seen = set()
    for i in range(len(ends)):
        run = flown(vehicle, starts[i], duration, plant=plant, engine="scipy")
        seen.add(run.outcome.status)
        assert ends.cause[i] == "collided" if run.outcome.status == "collided" else ends.cause[i] != "collided"
        # Trajectories of kernel and reference differ by roundoff, and the rod is looked at every quarter of a tick.
        assert ends.end[i] == pytest.approx(run.outcome.time, abs=0.26 / 500)
        single = flown(vehicle, starts[i], duration, plant=plant)
        assert (single.outcome.status, single.outcome.reason) == (run.outcome.status, run.outcome.reason)
        assert single.outcome.time == ends.end[i]
        assert single.t[-1] <= single.outcome.time + 1e-9
    assert seen == ({"completed", "collided"} if vehicle.mount == "hub" else {"collided"})


def test_the_clearance_of_an_ensemble_is_the_least_of_a_run():
    starts = fp.random_starts(40, 22)
    ends = fp.simulate_ensemble(HUB, LAW, starts, 4.0)
    for i in np.flatnonzero(ends.cause == "")[:10]:
        sampled = flown(HUB, starts[i]).clearance.min()
        # Between ticks the rod comes closer: its far end moves some centimetres in 2 ms, the nearest point some mm.
        assert sampled - 1e-3 < ends.clearance[i] <= sampled + 1e-12
        assert fp.metrics(flown(HUB, starts[i])).clearance == sampled
    free = fp.simulate_ensemble(fp.vehicle("hehn2011"), LAW, starts, 0.1)
    assert np.all(np.isinf(free.clearance))


def test_the_lower_bound_bounds_and_most_often_spares_the_search():
    bound, look = as_numpy(room(HUB)), as_numpy(touching(HUB))
    spared = []
    for seed in range(3):
        states = with_forces(flown(fp.vehicle("hehn2011"), fp.random_starts(1, seed)[0]))
        pairs = list(pairwise(states))
        low = np.array([bound(*pair, 0.002) for pair in pairs]).ravel()
        least = np.array([look(*pair, 0.002)[0] for pair in pairs])
        assert np.all(low <= least + 1e-12)
        spared.append(np.mean(low[1:] >= np.minimum.accumulate(least)[:-1]))
    assert np.mean(spared) > 0.8


def test_between_two_ticks_a_rod_is_seen_to_pass_through_a_disc():
    """Turning at 20 rad/s in the plane of an arm, its tip passes the discs' plane within a tick."""
    rate, half, look = 20.0, 0.001, as_numpy(touching(HUB))

    def state(angle):
        y = np.array([np.cos(angle), 0, np.sin(angle)])
        return np.append(fp.State(y=y, y_dot=rate * np.array([-y[2], 0, y[0]])).packed(), np.ones(4))

    least, share, part = look(state(-rate * half), state(rate * half), 2 * half)
    assert least < -HUB.body.rod_radius
    assert share == 0.25
    assert part_names(HUB)[int(part)] in ("disc 1", "arm 1")
    least, share, part = look(state(0.6), state(0.6 + 2 * rate * half), 2 * half)
    assert (share, part) == (NEVER, -1)
    assert least > 0


class Geometry:
    """Rod, discs and arms as MuJoCo's geoms, with its own search for the distance between them."""

    def __init__(self, vehicle):
        body = vehicle.body
        discs = "".join(
            f'<geom type="cylinder" pos="{x} {y} {z}" size="{body.disc_radius} 1e-5"/>'
            for x, y, z in vehicle.rotor_positions
        )
        arms = "".join(
            '<geom type="capsule" fromto="{} {} {} {} {} {}" size="{}"/>'.format(
                *(body.hub_radius / np.linalg.norm(place) * place), *place, body.arm_radius
            )
            for place in vehicle.rotor_positions
        )
        rod = (
            '<body mocap="true"><geom name="rod" type="capsule" '
            f'fromto="0 0 {body.hub_radius} 0 0 {vehicle.reach}" size="{body.rod_radius}"/></body>'
        )
        text = f"<mujoco><worldbody>{discs}{arms}{rod}</worldbody></mujoco>"
        self.model = mujoco.MjModel.from_xml_string(text)
        self.data = mujoco.MjData(self.model)

    def distance(self, rod):
        """Least distance, or 0 or less, of the rod along the unit vector `rod` in the body frame."""
        quat = np.array([1 + rod[2], -rod[1], rod[0], 0.0])  # turns e₃ to the rod
        self.data.mocap_quat[0] = quat / np.linalg.norm(quat)
        mujoco.mj_kinematics(self.model, self.data)
        last = self.model.ngeom - 1
        return min(mujoco.mj_geomDistance(self.model, self.data, last, i, 1.0, None) for i in range(last))


def verdict_of_mujoco(vehicle, run):
    """Time of the first touch by MuJoCo's geoms every half millisecond, the body's rotation interpolated; or None."""
    geometry, rods = Geometry(vehicle), np.einsum("nji,nj->ni", run.R, run.y)
    for k in range(len(run.t) - 1):
        for share in (0.0, 0.25, 0.5, 0.75):
            rod = (1 - share) * rods[k] + share * rods[k + 1]
            if geometry.distance(rod / np.linalg.norm(rod)) <= 0:
                return run.t[k] + share * (run.t[k + 1] - run.t[k])
    return None


def compared_with_mujoco(runs, seed, duration):
    """Number of flights that touch with MuJoCo as plant and judge, and the largest difference in time, s."""
    starts, touched, late = fp.random_starts(runs, seed), 0, 0.0
    ours = fp.simulate_ensemble(HUB, BLIND, starts, duration)
    for i in range(runs):
        run = flown(fp.vehicle("hehn2011"), starts[i], duration, law=BLIND, plant="mujoco")
        time = verdict_of_mujoco(HUB, run)
        assert (time is not None) == (ours.cause[i] == "collided"), (i, time, ours.cause[i], ours.clearance[i])
        if time is not None:
            touched, late = touched + 1, max(late, abs(time - ours.end[i]))
    return touched, late


def test_geometry_of_mujoco_finds_the_same_distance():
    geometry, rng = Geometry(HUB), np.random.default_rng(2)
    from flypend.model.mount import clearances

    for rod in fp.State.random(rng, 200).y:
        ours = clearances(rod, HUB.rotor_positions, HUB.reach, HUB.body).min()
        if ours > 0:
            # The cylinder is 1e-5 m high on either side; MuJoCo's search is good to 1e-6.
            assert geometry.distance(rod) == pytest.approx(ours, abs=3e-5)


def test_mujoco_gives_the_same_verdict():
    touched, late = compared_with_mujoco(12, seed=23, duration=2.0)
    assert 2 < touched < 12
    assert late < 5e-3


@pytest.mark.slow
def test_mujoco_gives_the_same_verdict_in_500_flights():
    touched, late = compared_with_mujoco(500, seed=24, duration=4.0)
    assert 100 < touched < 500
    assert late < 5e-3


# A floor ---------------------------------------------------------------------------------------------------------

FREE = fp.vehicle("hehn2011")  # its rod can touch nothing but a floor
FLOOR = -1.0
FLOORS = {
    "rotors": fp.Plant(floor=FLOOR),
    "mujoco": fp.Plant(engine="mujoco", floor=FLOOR),
    "rates": fp.Plant(interface="rates", rate=50.0, delay=0.03, floor=FLOOR),
    "wrong rod": fp.Plant(mismatch={"rod_length": 1.2}, floor=FLOOR),
    "ideal": fp.Ideal(floor=FLOOR),
}


@pytest.mark.parametrize("name", few(("mujoco", "rates", "wrong rod", "ideal"), FLOORS))
def test_kernel_and_reference_end_at_the_same_floor(name):
    starts, duration, plant = fp.random_starts(12, 3), 2.0, FLOORS[name]
    ends = fp.simulate_ensemble(FREE, LAW, starts, duration, plant=plant)
    seen = set()
    for i in range(0, len(ends), 3):
        run = fp.simulate(FREE, LAW, starts[i], duration, plant=plant, engine="scipy")
        assert (ends.cause[i] == "collided") == (run.outcome.status == "collided")
        # Between looks heights are linear. In the ideal plant the two do not look at the same times: in 2 ms, at 1 m/s
        # and an acceleration of 3 g, that is a dt²/8 / v = 15 µs.
        assert ends.end[i] == pytest.approx(run.outcome.time, abs=2e-5 if name == "ideal" else 1e-8)
        single = fp.simulate(FREE, LAW, starts[i], duration, plant=plant)
        assert (single.outcome.status, single.outcome.reason) == (run.outcome.status, run.outcome.reason)
        seen.add(run.outcome.status)
    assert seen == {"completed", "collided"}
    assert np.all(np.isinf(ends.clearance))  # the floor is no part of the mount


@pytest.mark.parametrize(
    ("vehicle", "plant"), [(FREE, fp.Plant(floor=-0.9)), (FREE, fp.Ideal(floor=-0.9)), (HUB, "rotors"), (HUB, "ideal")]
)
def test_a_flight_that_touches_is_judged_up_to_the_touch(vehicle, plant):
    """As the single run, but that forces in the ideal plant come from the steps: those of a flight that ends there."""
    starts, law, ideal = fp.random_starts(12, 5), fp.laws.lqr(), plant == "ideal" or isinstance(plant, fp.Ideal)
    found = fp.simulate_ensemble(vehicle, law, starts, 2.0, plant=plant)
    touched = np.flatnonzero((found.cause == "collided") & (found.end > 0))
    assert len(touched) > 6
    for i in touched:
        start = starts[int(i) : int(i) + 1]
        single = fp.metrics(fp.simulate(vehicle, law, start[0], 2.0, plant=plant))
        forces = single
        if ideal:
            free = fp.simulate_ensemble(FREE, law, start, found.end[i], plant="ideal")
            forces = fp.Metrics(**{name: values[0] for name, values in free.columns.items()})
        names = ["excursion"] if ideal else ["excursion", "lowest", "box_x", "box_y", "box_z"]
        for name in names:
            assert getattr(found, name)[i] == pytest.approx(getattr(single, name), rel=1e-9), name
        for name in ("effort", "peak_force"):
            assert getattr(found, name)[i] == pytest.approx(getattr(forces, name), rel=1e-9), name


@pytest.mark.parametrize("e3", [slow("up"), "down"])
def test_in_free_fall_the_lowest_part_lands_when_galileo_says(e3):
    """The rod hangs, and no rotor gives any force; height is upward in either frame."""
    vehicle = FREE.replace(rotor_limits=(0.0, FREE.rotor_limits[1]))
    law = fp.Law(name="rest", e3=e3, control=lambda *_: fp.Wrench(ca.SX(0), ca.SX.zeros(3)))
    start = fp.State(y=(0, 0, -1)).in_frame(e3)
    height = -FLOOR - vehicle.reach - vehicle.body.rod_radius
    for plant in (fp.Plant(limits=False, lag=0.0, floor=FLOOR), fp.Ideal(floor=FLOOR)):
        outcome = fp.simulate(vehicle, law, start, 1.0, plant=plant).outcome
        assert outcome.reason == "the rod touched the floor"
        # Linear within 2 ms: (g/8) dt² at a speed of 3 m/s.
        assert outcome.time == pytest.approx(np.sqrt(2 * height / vehicle.g), abs=2e-6)


def test_a_floor_ends_the_flights_that_go_below_it_and_changes_no_other():
    start = fp.random_starts(1, 5)[0]
    free = flown(FREE, start)
    lowest = fp.metrics(free).lowest
    low, high = (flown(FREE, start, plant=fp.Plant(floor=lowest + d)) for d in (-1e-6, 1e-3))
    np.testing.assert_array_equal(low.packed, free.packed)
    assert low.outcome.status == "completed"
    assert high.outcome.status == "collided"
    assert fp.metrics(high).lowest > lowest
    np.testing.assert_array_equal(high.packed, free.packed[: len(high.t)])


def test_who_lands_on_a_hub_or_in_a_cup_is_told_from_who_touches_the_mount():
    reasons = set()
    for vehicle in (HUB, CUP):
        for i in range(6):
            start = fp.random_starts(6, 21)[i]
            bare = flown(vehicle, start, 1.5).outcome
            run = flown(vehicle, start, 1.5, plant=fp.Plant(floor=-0.65)).outcome
            assert run.status == "collided" or bare.status == "completed"
            assert run.time <= bare.time
            assert "floor" in run.reason or run == bare
            reasons.add("floor" in run.reason)
    assert reasons == {True, False}


def test_a_machine_that_begins_below_the_floor_does_not_fly():
    for plant in (fp.Plant(floor=-0.1), fp.Ideal(floor=-0.1)):
        run = fp.simulate(FREE, LAW, fp.State(y=(0, 0, -1)), 1.0, plant=plant)
        assert (run.outcome.status, run.outcome.time) == ("collided", 0.0)
        assert fp.simulate(FREE, LAW, fp.State(y=(0, 0, 1)), 1.0, plant=plant).outcome.status == "completed"


def test_geometry_of_mujoco_meets_the_floor_at_the_same_time():
    """Hub, discs and the end of the rod as MuJoCo's geoms, and its own search for their distance to a plane."""
    body = FREE.body
    discs = "".join(
        f'<geom type="cylinder" pos="{x} {y} {z}" size="{body.disc_radius} 1e-6"/>' for x, y, z in FREE.rotor_positions
    )
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><worldbody><geom type="box" pos="0 0 {FLOOR - 5}" size="50 50 5"/><body mocap="true">{discs}'
        f'<geom type="sphere" size="{body.hub_radius}"/></body>'
        f'<body mocap="true"><geom type="sphere" size="{body.rod_radius}"/></body></worldbody></mujoco>'
    )
    data, landed = mujoco.MjData(model), 0
    for i in range(12):
        start = fp.random_starts(12, 3)[i]
        free = flown(FREE, start, 2.0, law=BLIND, plant="mujoco")
        time = None
        for t, x, R, y in zip(free.t, free.x, free.R, free.y, strict=True):
            data.mocap_pos[:] = x, x + FREE.reach * y
            mujoco.mju_mat2Quat(data.mocap_quat[0], R.ravel())
            mujoco.mj_kinematics(model, data)
            if min(mujoco.mj_geomDistance(model, data, 0, g, 9.0, None) for g in range(1, model.ngeom)) <= 0:
                time = t
                break
        ours = flown(FREE, start, 2.0, law=BLIND, plant=fp.Plant(engine="mujoco", floor=FLOOR)).outcome
        assert (time is not None) == (ours.status == "collided")
        if time is not None:
            landed += 1
            assert time - 0.002 - 1e-9 <= ours.time <= time + 1e-9
    assert 1 < landed < 12
