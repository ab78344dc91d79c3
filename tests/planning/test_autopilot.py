"""Plan and track as a law: it plans for what it is told, from where the flight begins."""

import numpy as np
import pytest

import flypend as fp
from flypend.settings.laws import law_from, law_named

HEHN = fp.vehicle("hehn2011")
STARTS = fp.random_starts(3, seed=2026)


def test_it_flies_what_plan_and_track_fly():
    start = STARTS[1]
    low = HEHN.rotor_limits[0]
    run = fp.simulate(HEHN, fp.plan_and_track(), start, 3.5)
    plan = fp.plan(HEHN, start, rotors=np.clip(run.rotor_forces[0], low, None), time_limit=120.0)
    tracked = fp.simulate(HEHN, fp.track(plan), start, 3.5)
    np.testing.assert_array_equal(run.packed, tracked.packed)
    assert fp.metrics(run).success


def test_it_is_a_row_beside_laws():
    rows = fp.compare(HEHN, [fp.laws.inverted(), fp.plan_and_track()], STARTS, 5.0).rows()
    assert [row["law"] for row in rows] == ["inverted", "plan"]
    assert rows[1]["successes"] == 3
    assert rows[1]["excursion_max"] < rows[0]["excursion_p50"]


def test_another_vehicle_and_a_target_need_nothing_else():
    small = fp.vehicle("crazyflie").replace(rotor_lag=0.072, rod_length=0.5)
    run = fp.simulate(small, fp.plan_and_track(target=(0.2, 0, 0.1)), fp.State(y=(0, 0, -1)), 4.5)
    assert fp.metrics(run).success
    np.testing.assert_allclose(run.x[-1], (0.2, 0, 0.1), atol=0.02)


def test_without_a_plan_the_law_flies():
    """A tenth of a second is too short for any plan."""
    run = fp.simulate(HEHN, fp.plan_and_track(duration=0.1), STARTS[0], 8)
    law = fp.simulate(HEHN, fp.laws.inverted(), STARTS[0], 8)
    np.testing.assert_allclose(run.x, law.x, atol=1e-9)


def test_it_has_a_name_for_commands_and_files():
    assert law_named("plan").name == law_from({"name": "plan"}).name == "plan"
    with pytest.raises(fp.InputError, match=r"plan_and_track.cieling: .*did you mean 'ceiling'"):
        fp.plan_and_track(cieling=2.0)
    with pytest.raises(fp.InputError, match="gains"):
        law_from({"name": "plan", "gains": {}})


@pytest.mark.parametrize(
    ("wish", "line"),
    [
        ({"objective": "excursio"}, "did you mean 'excursion'"),
        ({"box": 3}, "box: expected numbers"),
        ({"window": 3}, "window: expected a Window"),
        ({"otherwise": 3}, "otherwise: expected a Law"),
    ],
)
def test_what_cannot_be_planned_is_refused_before_a_flight(wish, line):
    with pytest.raises(fp.InputError, match=line):
        fp.plan_and_track(**wish)
