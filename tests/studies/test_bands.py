"""Vehicles drawn from bands: within them, by seed, and the law believes what is written."""

import dataclasses

import numpy as np
import pytest

import flypend as fp
from flypend.errors import InputError
from flypend.flight.metrics import wilson
from flypend.flight.request import Flight
from flypend.plants import Sampled
from flypend.settings.runfile import plant_of
from flypend.studies import bands
from flypend.studies.bands import fly_within, worlds_within
from flypend.studies.compare import files_of_failures

MINE = fp.Vehicle.estimate(
    mass=0.62, arm=0.17, propeller="8x4.5", motor="920 KV", battery="3S", rod_length=0.9, rod_mass=0.03, bob_mass=0.04
)

NEAR = MINE.replace(bands={"mass": (0.6, 0.64), "rod_length": (0.68, 0.73), "delay": (0.0, 0.01)})


def test_every_world_is_within_the_bands():
    worlds = worlds_within(MINE, Sampled(), seed=3, draws=20)
    assert worlds.pop("as written") == Sampled()
    seen = set()
    for world in worlds.values():
        true = world.true_vehicle(MINE)
        drawn = {name: getattr(true, name) for name in ("mass", "bob_mass", "rod_length", "drag_ratio", "rotor_lag")}
        drawn |= {name: getattr(world, name) for name in ("spin_up", "sag", "delay")}
        drawn |= {"pivot_offset": true.pivot_offset, "inertia": np.diag(true.inertia)}
        for name, value in drawn.items():
            low, high = (np.array(end) for end in MINE.bands[name])
            assert np.all((low <= value * (1 + 1e-9)) & (value <= high * (1 + 1e-9))), name
        push = np.array(world.strength) * MINE.thrust_scale
        low, high = np.outer(MINE.bands["thrust_scale"], np.array(MINE.bands["strength"])[:, 0]).diagonal()
        assert np.all((low <= push) & (push <= high))
        assert true.rod_inertia / MINE.rod_inertia == pytest.approx(
            true.bob_mass / MINE.bob_mass * (true.rod_length / MINE.rod_length) ** 2
        )
        seen.add(true.rotor_lag)
    assert len(seen) == 20


def test_a_lag_is_drawn_for_a_vehicle_that_is_written_without():
    quick = fp.vehicle("hehn2011").replace(rotor_lag=0.0, bands={"rotor_lag": (0.02, 0.03)})
    assert 0.02 <= worlds_within(quick, Sampled(), 1)["drawn 1"].true_vehicle(quick).rotor_lag <= 0.03
    assert worlds_within(quick, Sampled(lag=0.01), 1)["drawn 1"].true_vehicle(quick).rotor_lag == 0.01


def test_units_of_commanded_force_draw_the_same_worlds():
    told = MINE.replace(thrust_scale=0.9)  # what flies is told in units of the force that is asked for
    raw, flown = (worlds_within(vehicle, Sampled(), seed=3) for vehicle in (told, told.commanded()))
    for one, same in zip(raw.values(), flown.values(), strict=True):
        assert one.mismatch == pytest.approx(same.mismatch)
        assert np.allclose(one.strength, same.strength)
        assert (one.delay, one.sag) == (same.delay, same.sag)
    flight = Flight(vehicle=told, law=fp.laws.inverted(), starts=fp.random_starts(9, 1), duration=0.1)
    assert len(fly_within(flight, seed=3)) == 9


def test_worlds_follow_the_seed_and_keep_the_rest_of_the_plant():
    plant = Sampled(mismatch={"mass": 1.1})
    one, same, other = (worlds_within(MINE, plant, seed)["drawn 1"] for seed in (1, 1, 2))
    assert one == same != other
    low, high = MINE.bands["mass"]
    assert 1.1 * low <= one.true_vehicle(MINE).mass <= 1.1 * high


def test_a_flight_in_a_drawn_world():
    """The law keeps the rod up in most of them, believing what is written."""
    world = worlds_within(MINE.replace(bands={"mass": (0.6, 0.64), "delay": (0.0, 0.01)}), Sampled(), 1)["drawn 2"]
    run = fp.simulate(MINE, fp.laws.inverted(), fp.State(y=(0.1, 0, 0.995)), 3, plant=world)
    assert run.y[-1, 2] > 0.99


def test_a_vehicle_without_bands_is_refused():
    with pytest.raises(InputError, match=r"vehicle\.bands"):
        worlds_within(fp.vehicle("hehn2011"), Sampled(), 1)


def test_each_world_flies_its_share_of_the_starts_with_the_noise_of_its_place():
    """Run by run as alone: in its world, with the seed of its place."""
    plant = Sampled(noise=fp.Noise(y=2e-3, omega=2e-2), seed=7)
    worlds = list(worlds_within(NEAR, plant, 1, draws=2).values())
    starts = fp.random_starts(9, 3)
    shared = fp.compare(NEAR, fp.laws.inverted(), starts, 2.0, plant=worlds).ensembles["inverted"]
    np.testing.assert_array_equal(shared.starts.packed(), starts.packed())
    for run, place in ((1, 0), (3, 1), (8, 2)):  # of three runs each
        world = worlds[place].replace(seed=7 + run)
        alone = fp.simulate_ensemble(NEAR, fp.laws.inverted(), starts[run : run + 1], 2.0, plant=world)
        np.testing.assert_array_equal(alone.final.packed()[0], shared.final.packed()[run])
    flight = Flight(vehicle=NEAR, law=fp.laws.inverted().bind(NEAR), starts=starts, duration=2.0, plant=plant)
    drawn = fly_within(flight, 1)  # none of them as written
    assert drawn.shares == (1, 1, 1, 1, 1, 1, 1, 2)
    alone = fp.simulate_ensemble(NEAR, fp.laws.inverted(), starts[:1], 2.0, plant=worlds[1].replace(seed=7))
    np.testing.assert_array_equal(alone.final.packed()[0], drawn.final.packed()[0])


def test_the_interval_of_drawn_vehicles_holds_the_rate_of_all_vehicles_of_the_bands(monkeypatch):
    """Success depends on the vehicle's mass and on chance. 400 checks know the share that holds it to 0.015."""
    some = fp.simulate_ensemble(NEAR, fp.laws.inverted(), fp.random_starts(20, 1), 0.1)
    rng, light = np.random.default_rng(4), NEAR.bands["mass"][0] / NEAR.mass
    span = NEAR.bands["mass"][1] / NEAR.mass - light

    def fly(flight):
        place = (flight.plant.mismatch["mass"] - light) / span  # uniform in (0, 1)
        return dataclasses.replace(some, success=rng.random(flight.runs) < 0.2 + 0.8 * place**2)

    monkeypatch.setattr(bands, "fly_each", lambda parts, *_: {name: fly(part) for name, part in parts.items()})
    flight = Flight(vehicle=NEAR, law=fp.laws.inverted().bind(NEAR), starts=fp.random_starts(160, 3), duration=2.0)
    flown = [fly_within(flight, seed) for seed in range(400)]
    rate = 0.2 + 0.8 / 3
    held, as_independent = (
        np.mean([low <= rate <= high for low, high in ends])
        for ends in ([one.interval for one in flown], [wilson(int(one.success.sum()), len(one)) for one in flown])
    )
    assert held > 0.93
    assert as_independent < 0.7  # negative control


def test_a_failed_flight_names_the_world_in_which_it_failed():
    plant = {"base": "rotors", "seed": 5}
    worlds = list(worlds_within(NEAR, plant_of(plant), 1, draws=2).values())
    compared = fp.compare(NEAR, fp.laws.corrected(), fp.random_starts(6, 3), 1.0, plant=worlds)
    failed = files_of_failures(compared, ["corrected"], plant, 1.0, worlds)
    assert len(failed) == 6  # it hangs the rod
    for run, place in ((0, 0), (3, 1), (5, 2)):
        assert plant_of(failed[f"corrected-{run}"]["plant"]) == worlds[place].replace(seed=5 + run)


def test_without_a_plant_nothing_is_compared():
    with pytest.raises(InputError, match="plant: expected a plant, or several"):
        fp.compare(NEAR, fp.laws.inverted(), fp.random_starts(2, 1), 1.0, plant=())


def test_a_check_flies_what_is_drawn_beside_what_is_written(one_plan):
    """A band that the law cannot follow shows in the task drawn, and nowhere else."""
    wide = fp.vehicle("hehn2011").replace(bands={"thrust_scale": (0.3, 0.31)})
    found = fp.check(wide, runs=18, duration=6.0, margins=False, bands=True)
    assert found.envelope["random"] == "all"
    assert found.rows()["drawn"]["successes"] == 0  # that as written is not among them
    assert any("drawn: 0 of 18" in warning for warning in found.warnings)
    assert found.rows()["drawn"]["wilson_high"] == wilson(0, 8)[1]  # of eight vehicles, not of 18 flights
    assert "drawn   none: 0 of 18 (0.0 to 32.4 %)" in repr(found)
    with pytest.raises(InputError, match=r"vehicle\.bands"):
        fp.check(fp.vehicle("hehn2011"), bands=True)
