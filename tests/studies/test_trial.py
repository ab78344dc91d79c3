"""A trial hits as hard as it says, scores what flies, and changes the number of the model that it names."""

import json

import numpy as np
import pytest

import flypend as fp
from flypend.flight.ensemble import fly_many
from flypend.plants import ROTORS
from flypend.report.check import trial_cells
from flypend.studies import trial as trials
from flypend.studies.trial import KNOCKS, swept

HEHN = fp.vehicle("hehn2011")


@pytest.fixture(scope="module")
def calm():
    """A trial without knocks, with one factor of the sweeps: every one is another kernel."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(trials, "FACTORS", (1.125,))
        return fp.trial(HEHN, runs=8, knock=0.0)


def test_uptime_counts_from_the_swing_up_on(calm):
    assert calm.standing.all()
    settled = calm.knocked.settling
    # Up is 18° from upright, which the rod passes before it settles within 3°.
    assert np.all(calm.uptime >= 1 - settled / 60)
    assert np.all(calm.uptime <= 1 - 0.3 * settled / 60)


def test_knocks_cost_uptime_and_the_hardest_bring_it_down(calm, monkeypatch):
    monkeypatch.setattr(trials, "swept", lambda *_: {})
    few = {"runs": 8, "workers": 1}
    some, many = fp.trial(HEHN, **few), fp.trial(HEHN, knock=8.0, **few)
    assert calm.uptime.mean() > some.uptime.mean() > many.uptime.mean()
    assert np.all((many.uptime >= 0) & (many.uptime <= 1))
    assert some.knock == pytest.approx(0.3 * np.sqrt(HEHN.g * HEHN.l))
    assert KNOCKS == 15


def test_knocks_are_as_hard_on_a_vehicle_whose_rotors_push_less(monkeypatch):
    flown, machine = [], HEHN.replace(thrust_scale=0.8)
    monkeypatch.setattr(trials, "swept", lambda *_: {})
    monkeypatch.setattr(trials, "fly_many", lambda flight, **given: flown.append(flight) or fly_many(flight, **given))
    assert fp.trial(machine, runs=1, knock=1.0, workers=1).vehicle == machine
    wind, moved = flown[-1].plant.wind, flown[-1].vehicle
    assert wind.knock_on_vehicle / moved.mass == wind.knock_on_bob / moved.bob_mass == 1.0


def test_the_sweeps_score_success_by_number_and_factor(calm):
    assert set(calm.sweeps) == {
        "mass", "bob_mass", "rod_length", "inertia", "arm", "drag_ratio", "thrust", "rotor_lag"
    }  # fmt: skip
    for row in calm.sweeps.values():
        assert tuple(row) == (1.125,)
        assert all(0 <= count.successes <= count.runs == 8 for count in row.values())
    lengths = calm.sweeps["rod_length"]
    plant = ROTORS.replace(mismatch={"rod_length": 1.125})
    starts = fp.random_starts(8, 1)
    assert lengths[1.125][0] == fp.simulate_ensemble(HEHN, fp.laws.inverted(), starts, 10.0, plant=plant).success.sum()
    assert 0 <= calm.robustness <= 1
    told = json.loads(json.dumps(calm.to_dict(), default=float))
    assert told["standing"]["successes"] == 8
    assert len(trial_cells({"inverted": calm})) == 4 + len(calm.sweeps)
    assert "upright at the end: 8 of 8" in repr(calm)


def test_each_sweep_changes_what_it_names():
    rod = HEHN.replace(**fp.rod_with_bob(0.03, 0.9, 0.05))
    worlds = swept(rod, ROTORS.replace(delay=0.01))
    for name, field in (("mass", "mass"), ("bob_mass", "bob_mass"), ("rod_inertia", "rod_inertia"),
                        ("inertia", "inertia"), ("arm", "rotor_positions"), ("rotor_lag", "rotor_lag")):  # fmt: skip
        true = worlds[name](1.25).true_vehicle(rod)
        np.testing.assert_allclose(getattr(true, field), 1.25 * np.asarray(getattr(rod, field)))
        same = {key: value for key, value in true.to_dict().items() if key != field}
        assert same == {key: value for key, value in rod.to_dict().items() if key != field}
    assert worlds["delay"](0.75).delay == pytest.approx(0.0075)
    longer = worlds["rod_length"](1.25).true_vehicle(rod)
    assert longer.rod_end == pytest.approx(1.25 * rod.rod_end)
    assert "delay" not in swept(rod, ROTORS)
    assert "rotor_lag" not in swept(rod.replace(rotor_lag=0.0), ROTORS)


@pytest.mark.parametrize("factor", [0.75, 1.25])
def test_weaker_rotors_move_the_machine_as_heavier_masses_do(factor):
    """Accelerations are forces over masses and inertias: nothing else knows how hard the rotors push."""
    # Rotors begin at their least force, which is to be the same for both: none.
    rod = HEHN.replace(**fp.rod_with_bob(0.03, 0.9, 0.05), rotor_limits=[0.0, 3.5])
    heavier = dict.fromkeys(("mass", "bob_mass", "rod_inertia", "inertia"), 1 / factor)
    plants = swept(rod, ROTORS)["thrust"](factor), ROTORS.replace(mismatch=heavier)
    starts = fp.random_starts(4, 3)
    ours, theirs = (fp.simulate_ensemble(rod, fp.laws.lqr(), starts, 0.5, plant=plant) for plant in plants)
    np.testing.assert_allclose(ours.final.packed(), theirs.final.packed(), rtol=0, atol=1e-8)  # roundoff, amplified


def test_a_sweep_beyond_the_range_is_refused_before_anything_flies(monkeypatch):
    monkeypatch.setattr(trials, "fly_many", lambda *_, **__: pytest.fail("flew"))
    with pytest.raises(fp.InputError, match=r"^plant\.delay: expected at most 0\.5 s"):
        fp.trial(fp.vehicle("hehn2011"), plant=fp.Plant(delay=0.45), runs=2)


def test_a_vehicle_that_the_law_refuses_is_refused():
    with pytest.raises(fp.InputError):
        fp.trial(HEHN.replace(mass=500.0), runs=2)
    with pytest.raises(fp.InputError, match="knock: expected a finite number >= 0"):
        fp.trial(HEHN, knock=-1.0)
