"""A check says of a vehicle and a law what their flights do, and why not, if they cannot."""

import json
import sys

import numpy as np
import pytest

import flypend as fp
from flypend.flight.tasks import LEANS, task_starts
from flypend.report.check import check_tables, margin_cells, task_cells, verdicts, write_check
from flypend.studies.check import caught, describe_plans
from flypend.studies.check import check as examine

HEHN = fp.vehicle("hehn2011")
FEW = {"runs": 32, "duration": 8.0, "margins": False}

pytestmark = pytest.mark.usefixtures("one_plan")


@pytest.fixture(scope="module")
def good():
    return fp.check(HEHN, **FEW)


def test_a_good_vehicle_is_told_as_its_flights_are(good):
    assert good.ok
    assert good.reasons == good.warnings == ()
    starts = task_starts(HEHN, 32, 1)
    for name, batch in starts.items():
        again = fp.simulate_ensemble(HEHN, fp.laws.inverted(), batch, 8.0)
        np.testing.assert_array_equal(good.tasks[name].excursion, again.excursion)
        assert good.rows()[name]["success"] == again.rate
    assert "32 of 32" in repr(good)
    assert max(map(len, repr(good).splitlines())) <= 80
    assert not good.margins


def test_a_check_is_plain_numbers_for_json(good):
    told = json.loads(json.dumps(good.to_dict(), default=float))
    assert told["tasks"]["random"]["runs"] == 32
    assert told["vehicle"] == HEHN.to_dict()


@pytest.mark.parametrize(
    ("vehicle", "law", "words"),
    [
        (HEHN.replace(mass=5.0), "inverted", "the weight is 49.54 N with mass 5 kg"),
        (HEHN.replace(gravity=0.0), "inverted", "without gravity"),
        (fp.vehicle("crazyflie").replace(rotor_lag=0.5), "inverted", "rotor lag and delay of 500 ms are too long"),
    ],
)
def test_a_vehicle_that_cannot_be_flown_is_a_result_with_a_reason(vehicle, law, words):
    found = fp.check(vehicle, getattr(fp.laws, law)(), **FEW)
    assert not found.ok
    assert any(words in reason for reason in found.reasons)
    assert words in repr(found)


def test_what_a_law_cannot_do_is_planned_to_tell_law_from_vehicle(monkeypatch):
    """LQR stands no rod that falls; plans do."""
    monkeypatch.setattr(sys.modules[examine.__module__], "STARTS", 8)
    found = fp.check(HEHN, fp.laws.lqr(), **FEW)
    assert found.ok  # it hovers
    assert (found.envelope["hover"], found.envelope["random"]) == ("all", "some")
    assert found.plans.success.all()
    assert "8 of 8" in found.possible
    assert found.possible in repr(found)
    assert found.to_dict()["possible"] == found.possible
    assert any(found.possible in line for line in verdicts({"lqr": found}))


def test_where_there_is_no_plan_no_law_is_blamed():
    short = fp.plan_ensemble(HEHN, fp.random_starts(2, 1), duration=0.2)
    limit = "the limit may be the vehicle's, not the lqr law's"
    assert describe_plans(short, "lqr") == f"plans reach inverted hover from 0 of 2 random starts: {limit}"


def test_rotors_without_limits_lift_anything_and_the_lag_of_the_plant_counts():
    weak = HEHN.replace(rotor_limits=[0.0, 1.2])
    assert "the weight is" in fp.check(weak, **FEW).reasons[0]
    assert fp.check(weak, fp.laws.lqr(), plant=fp.Plant(limits=False), **FEW).tasks["hover"].rate == 1.0
    late = fp.check(HEHN, plant=fp.Plant(lag=0.2), runs=4, duration=2.0, margins=False)
    assert any("rotor lag and delay of 200 ms" in reason for reason in late.reasons)


def test_a_law_that_refuses_a_vehicle_is_quoted():
    separated = fp.Law(name="choosy", e3="up", control=lambda t, s, v, k: None, check=_refuse)
    found = fp.check(HEHN, separated, **FEW)
    assert found.reasons == ("the choosy law refuses the vehicle: pace: expected less haste, got 7",)
    assert not found.tasks


def _refuse(gains):
    raise fp.InputError("pace", "less haste", 7)


def test_a_law_that_hangs_the_rod_fails_by_its_causes():
    found = fp.check(HEHN, fp.laws.corrected(), **FEW)
    assert not found.ok
    assert [reason.split(":")[0] for reason in found.reasons] == ["hover", "hanging", "level", "random"]
    assert "0 of 12" in found.reasons[0]
    assert set(found.envelope.values()) == {"none"}
    assert found.catch.lean == 0.0
    assert np.isnan(found.catch.excursion)


def test_a_hub_is_failed_by_what_touches_and_a_cup_asks_for_no_swing_up():
    hub = fp.check(HEHN.replace(mount="hub"), **FEW)
    assert "clearance_p5" in hub.rows()["random"]
    assert hub.ok
    assert not hub.reasons
    assert hub.envelope["hanging"] == "all"
    assert hub.envelope["random"] == "some"
    assert "collided" in hub.warnings[-1]
    assert hub.plans is not None
    cup = fp.check(HEHN.replace(mount="cup"), **FEW)
    assert set(cup.tasks) == {"hover", "lean", "random"}
    assert cup.catch.lean <= HEHN.body.cup_angle


def test_a_catch_ends_at_the_first_lean_of_which_a_direction_is_dropped(good):
    leans, count = good.tasks["lean"], len(LEANS)
    low = np.min(leans.samples.y[..., 2], axis=1).reshape(count, -1)
    direct = leans.success.reshape(count, -1) & (low > 0)
    first = int(np.argmin(direct.all(axis=1)))
    assert direct[:first].all()
    assert not direct[first].all()
    found = caught(leans, 12)
    assert found.lean == pytest.approx(LEANS[first - 1], abs=1e-12)
    assert found.excursion == leans.excursion.reshape(count, -1)[:first].max()
    assert found.swung == np.sum(~direct & leans.success.reshape(count, -1))


def test_noise_and_delay_of_the_plant_are_flown():
    late = fp.check(HEHN, plant=fp.Plant(delay=0.12), **FEW)
    assert not late.ok
    with pytest.raises(fp.InputError, match="plant: expected a plant with numbers"):
        fp.check(HEHN, plant="ideal")
    with pytest.raises(fp.InputError, match=r"^runs: expected an integer"):
        fp.check(HEHN, runs=0)


def test_a_stepped_law_is_checked_with_fewer_flights():
    law = fp.Controller(name="idle", function=lambda t, state: fp.Wrench(HEHN.weight, np.zeros(3)))
    found = fp.check(HEHN, law, runs=2, duration=1.0)
    assert {name: len(flown) for name, flown in found.tasks.items()} == {
        "hover": 3, "lean": 36, "hanging": 4, "level": 2, "random": 2,
    }  # fmt: skip
    assert not found.margins
    assert not found.ok


def test_tables_and_files_hold_the_numbers(good, tmp_path):
    bad = fp.check(HEHN.replace(mass=5.0))
    both = {"inverted": good, "a|b": bad}
    assert [row[1] for row in task_cells(both)] == list(good.tasks)
    assert margin_cells(both)[1][2] == "none"
    assert verdicts(both)[0] == (
        "hehn2011 on a gimbal can be flown by inverted: lean all, hanging all, level all, random all."
    )
    assert verdicts(both)[1] == "hehn2011 on a gimbal cannot be flown by a|b."
    assert len(check_tables(both, {})) == 2
    assert check_tables({"bad": bad}, {}) == []
    write_check(both, {}, {"runs": 32}, tmp_path / "out")
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "report.md",
        "report.json",
        "check.png",
        "check.pdf",
    }
    told = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert told["checks"]["inverted"]["tasks"]["random"]["successes"] == 32
    assert "a\\|b" in (tmp_path / "out" / "report.md").read_text(encoding="utf-8")
    write_check({"bad": bad}, {}, {}, tmp_path / "none")
    assert {path.name for path in (tmp_path / "none").iterdir()} == {"report.md", "report.json"}


def test_the_figure_shows_every_margin_and_the_boundary(good):
    from flypend.pictures.studies import check_figure
    from flypend.studies.margins import Margin

    margin = Margin("delay", "ms", 0.0, (0.0, 10.0, 20.0), (40, 39, 3), 40, np.nan, 10.0, False, False)
    found = fp.Check(**{**vars(good), "margins": {"delay": margin}})
    panels = check_figure({"inverted": found}).axes
    assert panels[0].get_xlabel() == "delay (ms)"
    line = panels[0].get_lines()[0]
    np.testing.assert_allclose(np.asarray(line.get_xdata(), dtype=float), margin.values)
    np.testing.assert_allclose(np.asarray(line.get_ydata(), dtype=float), [100, 97.5, 7.5])
    assert panels[1].get_lines()[0].get_ydata()[-1] == 100
    assert "delay: up to 10 ms" in repr(found)
    assert margin_cells({"inverted": found, "another": good})[2] == ["delay", margin.describe(), "-"]


@pytest.mark.slow
def test_a_whole_check_knows_the_cliffs_of_delay_and_rod():
    found = examine(HEHN, seed=77)
    assert found.ok
    assert set(found.margins) == {"delay", "rotor lag", "rod length", "mass", "noise"}
    assert all(margin.high > margin.nominal for margin in found.margins.values())
    assert found.margins["rod length"].low < 0.9
