"""Vehicles drawn from bands: within them, by seed, and the law believes what is written."""

import numpy as np
import pytest

import flypend as fp
from flypend.errors import InputError
from flypend.plants import Sampled
from flypend.studies.bands import worlds_within

MINE = fp.Vehicle.estimate(
    mass=0.62, arm=0.17, propeller="8x4.5", motor="920 KV", battery="3S", rod_length=0.9, rod_mass=0.03, bob_mass=0.04
)


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
