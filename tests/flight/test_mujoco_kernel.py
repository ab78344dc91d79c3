"""MuJoCo inside the kernel: the flight that is flown step by step in Python, twenty times as fast."""

import mujoco
import numpy as np
import pytest

import flypend as fp
from flypend.compile.llvm.sampled import FILTER_STRIDE
from flypend.flight.criterion import Criterion
from flypend.flight.kernels import sampled_kernel
from flypend.flight.request import Flight
from flypend.flight.sampled import fly_stepwise
from flypend.plants import MOTION_CAPTURE, Plant, Wind
from flypend.plants.loop import Loop
from flypend.plants.mujoco import MOST_IDLE, MuJoCoWorld
from tests.few import few

VEHICLE = fp.vehicle("hehn2011")
INVERTED = fp.laws.inverted().bind(VEHICLE)
MUJOCO = Plant(engine="mujoco")
ENGINES = ("equations", "mujoco")
PLANTS = {
    "rotors": MUJOCO,
    "no lag": MUJOCO.replace(lag=0.0),
    "another lag": MUJOCO.replace(lag=0.05),
    "delay within a period": MUJOCO.replace(delay=0.005, rate=200.0),
    "rates": MUJOCO.replace(interface="rates", rate=50.0, delay=0.03),
    "knocks": MUJOCO.replace(wind=Wind(knock_on_vehicle=0.05, knock_on_bob=0.01, knock_period=0.1), seed=7),
    "noise and gusts": MUJOCO.replace(noise=MOTION_CAPTURE, wind=Wind(on_bob=(0.05, 0, 0), gust_on_vehicle=0.2)),
    "another vehicle": MUJOCO.replace(mismatch={"mass": 1.1, "inertia": 0.9}, pivot_offset=(0.01, 0.0, 0.02)),
    "motors": MUJOCO.replace(spin_up=1.5, sag=0.1, strength=(1.0, 0.9, 1.1, 1.0)),
    "motors without lag": MUJOCO.replace(spin_up=1.5, sag=0.1, lag=0.0),
    "air and ground": MUJOCO.replace(air="all", ground=-0.3),
    "air, motors and the rest": MUJOCO.replace(
        air=("rotor_drag", "inflow"),
        spin_up=0.7,
        sag=0.05,
        interface="rates",
        rate=50.0,
        delay=0.013,
        wind=Wind(on_bob=(0.05, 0, 0), gust_on_vehicle=0.2),
    ),
}


def flown(plant, starts, duration, **options):
    kernel = sampled_kernel(Loop(VEHICLE, INVERTED, plant), Criterion())
    ticks = np.arange(0, round(duration * plant.rate) + 1)
    return kernel.fly(starts, duration, judge_at=ticks, keep_at=ticks, first_seed=plant.seed, **options)


@pytest.mark.parametrize("name", PLANTS)
def test_it_is_the_flight_step_by_step(name):
    plant, start = PLANTS[name], fp.State.random(np.random.default_rng(5))
    ours = flown(plant, start.packed()[None], 0.6).samples[0]
    steps = fly_stepwise(Flight(vehicle=VEHICLE, law=INVERTED, starts=start, duration=0.6, plant=plant))
    # Both call the same mj_step; sums in another order grow with the flight.
    np.testing.assert_allclose(ours[:, :24], steps.packed, rtol=0, atol=1e-8)
    np.testing.assert_allclose(ours[:, 24:], steps.rotors, rtol=0, atol=1e-8)


@pytest.mark.parametrize(("lag", "own"), few(((None, 0.02), (0.0, 0.02), (0.03, 0.0)), (None, 0.0, 0.03), (0.0, 0.02)))
def test_the_lag_of_vehicle_and_plant_in_any_combination(own, lag):
    vehicle, plant = VEHICLE.replace(rotor_lag=own), MUJOCO.replace(lag=lag)
    start = fp.State.random(np.random.default_rng(8))
    runs = [fp.simulate(vehicle, fp.laws.inverted(), start, 0.4, plant=plant, engine=e) for e in ("kernel", "scipy")]
    np.testing.assert_allclose(runs[0].packed, runs[1].packed, rtol=0, atol=1e-8)
    np.testing.assert_allclose(runs[0].rotor_forces, runs[1].rotor_forces, rtol=0, atol=1e-8)


@pytest.mark.parametrize("name", ["motors", "air and ground", "air, motors and the rest"])
def test_motors_and_air_move_it_as_they_do_in_our_own_equations(name):
    """The engines differ by how they take forces that change within a step: by second order in 0.5 ms or 2 ms."""
    start = fp.State.random(np.random.default_rng(5))
    runs = [fp.simulate(VEHICLE, INVERTED, start, 0.6, plant=PLANTS[name].replace(engine=e)) for e in ENGINES]
    assert 1e-9 < np.max(np.abs(runs[0].packed - runs[1].packed)) < 1e-4
    np.testing.assert_allclose(runs[0].rotor_forces, runs[1].rotor_forces, rtol=0, atol=1e-4)


def test_a_world_that_is_lent_again_has_forgotten_the_motors_of_before():
    start = fp.State.random(np.random.default_rng(6)).packed()[None]
    plain = flown(MUJOCO, start, 0.2).samples
    flown(MUJOCO.replace(spin_up=2.0), start, 0.2)
    np.testing.assert_array_equal(flown(MUJOCO, start, 0.2).samples, plain)


def test_the_parameters_of_a_filter_lie_where_the_kernel_writes_them():
    assert mujoco.mjNDYN == FILTER_STRIDE


def test_it_is_not_the_flight_in_our_own_equations():
    """Negative control, and what the two engines differ by: rotors by RK4 in place of an exponential."""
    start = fp.State.random(np.random.default_rng(5))
    ours = flown(MUJOCO, start.packed()[None], 0.6).samples[0, -1, :24]
    own = fly_stepwise(Flight(vehicle=VEHICLE, law=INVERTED, starts=start, duration=0.6)).packed[-1]
    assert 1e-9 < np.max(np.abs(ours - own)) < 1e-4


def test_runs_do_not_depend_on_each_other_or_on_threads():
    starts = fp.State.random(np.random.default_rng(6), 5).packed()
    together = flown(MUJOCO, starts, 0.3, workers=2).samples
    for i in (0, 3):
        np.testing.assert_array_equal(together[i], flown(MUJOCO, starts[i : i + 1], 0.3).samples[0])


def test_a_run_that_is_lost_ends_and_the_next_begins_anew():
    wild = fp.State(y=(0, 0, 1), omega=(0, 0, 1e7)).packed()
    calm = fp.State(y=(0, 0, 1)).packed()
    found = flown(MUJOCO, np.stack([wild, calm]), 0.2, workers=1)
    assert found.status.tolist() == ["diverged", "completed"]  # the prediction stays finite, MuJoCo does not
    np.testing.assert_array_equal(found.samples[1], flown(MUJOCO, calm[None], 0.2).samples[0])


def test_idle_worlds_are_lent_again_and_few_are_kept():
    start = fp.State(y=(0, 0, 1)).packed()[None]
    MuJoCoWorld._idle.clear()
    flown(MUJOCO, start, 0.1)
    (_, world), *_ = MuJoCoWorld._idle
    flown(MUJOCO, start, 0.1)
    assert [kept for _, kept in MuJoCoWorld._idle] == [world]
    for i in range(MOST_IDLE + 3):
        flown(MUJOCO.replace(lag=0.03 + 1e-3 * i), start, 0.1)
    assert len(MuJoCoWorld._idle) == MOST_IDLE
    assert all(kept is not world for _, kept in MuJoCoWorld._idle)
