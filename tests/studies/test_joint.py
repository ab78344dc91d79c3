"""Several wrong numbers at once: corners and draws of the bands, what fails first, and what to calibrate."""

import json

import numpy as np
import pytest

import flypend as fp
from flypend.plants import SUITES, Plant
from flypend.plants.defects import CONSTANT, NEEDS, NUMBERS
from flypend.report.check import joint_lines
from flypend.studies import joint as joints
from flypend.studies.joint import BANDS, DRAWS, Joint, Wrong, joint, world_with
from flypend.studies.ladder import DEFECTS, rung_named, sensor_rungs

HEHN = fp.vehicle("hehn2011")


def wrong(kind, share, successes, **factors):
    return Wrong(kind, share, {"masses": 1.0, "rod length": 1.0, "thrust": 1.0} | factors, successes, 20)


def test_what_fails_first_is_the_worst_corner_of_the_smallest_share_that_fails():
    nominal, draws = wrong("nominal", 0.0, 20), [wrong("draw", 1.0, 0, thrust=0.9)]
    whole = [wrong("corner", 1.0, k, masses=1.2) for k in (20, 3)]
    half = [wrong("corner", 0.5, 17, masses=1.1), wrong("corner", 0.5, 20, masses=0.9)]
    quarter = [wrong("corner", 0.25, 18), wrong("corner", 0.25, 20)]
    found = Joint(BANDS, (nominal, *whole, *half, *quarter, *draws))
    assert found.share == 0.25
    assert found.worst is half[0]
    lines = found.lines()
    assert lines[-1] == "calibrate to masses ±5 %, rod length ±3.75 %, thrust ±3.75 %"
    assert lines[1].endswith("23 of 40 (42.2 to 71.5 %)")  # Wilson: scipy.stats.binomtest(23, 40).proportion_ci
    never = Joint(BANDS, (nominal, *whole, *half, *draws))
    assert never.share == 0.0
    assert "too much" in never.lines()[-1]
    good = Joint(BANDS, (nominal, wrong("corner", 1.0, 19), wrong("corner", 1.0, 18, masses=0.8), *draws))
    assert (good.share, good.worst.kind) == (1.0, "draw")
    assert good.lines()[-1] == "every corner keeps 90 %"


def test_a_wrong_world_is_wrong_on_top_of_what_its_plant_has():
    plant = Plant(strength=(0.9, 1.0, 1.0, 1.0), mismatch={"mass": 1.1})
    world = world_with(plant, {"masses": 1.2, "rod length": 0.85, "thrust": 0.9})
    assert world.mismatch == pytest.approx({"mass": 1.32, "bob_mass": 1.2, "rod_length": 0.85})
    assert world.strength == pytest.approx((0.81, 0.9, 0.9, 0.9))


def test_it_flies_every_corner_and_draw(monkeypatch):
    """With perfect states, in which the law stands all of it; one share, two of the draws."""
    monkeypatch.setattr(joints, "DRAWS", 1)
    monkeypatch.setattr(joints, "BANDS", {"masses": 0.2, "rod length": 0.0, "thrust": 0.0})
    monkeypatch.setattr(joints, "SHARES", (1.0,))
    monkeypatch.setattr(joints, "product", lambda signs, repeat: [(s,) * repeat for s in signs])
    found = joint(HEHN, runs=6)
    corners = [one for one in found.flown if one.kind == "corner"]
    assert [one.factors["masses"] for one in corners] == [1.2, 0.8]
    plant = Plant(mismatch={"mass": 1.2, "bob_mass": 1.2})
    again = fp.simulate_ensemble(HEHN, fp.laws.inverted(), fp.random_starts(6, 1), 20.0, plant=plant)
    assert corners[0].successes == again.success.sum()
    drawn = found.flown[-1]
    assert 0.8 <= drawn.factors["masses"] <= 1.2
    assert json.loads(json.dumps(found.to_dict()))["flown"][0]["runs"] == 6
    assert joint_lines({"inverted": found})[0] == "inverted, off together:"
    assert DRAWS == 8


# Rungs of the sensors -----------------------------------------------------------------------------------------------


def test_each_rung_of_the_sensors_has_one_defect_and_every_defect_has_one():
    seen = set()
    for suite in ("mocap", "onboard"):
        rungs, base = sensor_rungs(suite), SUITES[suite]
        assert next(iter(rungs)) == suite
        assert list(rungs)[-1] == "laboratory"
        for name in set(rungs) - {suite, "laboratory"}:
            sensors = rungs[name].sensors
            changed = [field for field in (*CONSTANT, *NUMBERS) if getattr(sensors, field) != getattr(base, field)]
            assert len(changed) == 1
            assert sensors.told == base
            seen |= set(changed)
    # An accelerometer's scale, and an offset of the frame that hover follows, are no rungs; the rest are sizes.
    sizes = {"vibration_rate", "outlier_off", "outlier_turned", "burst_time"}
    assert seen == {*CONSTANT, *NUMBERS} - sizes - {"accelerometer_scale", "frame_off"}
    assert {name for changes in DEFECTS.values() for name in changes} == seen
    assert NEEDS["vibration"] == "accelerometer"
    assert "accelerometer vibrates 5 m/s^2" not in sensor_rungs("mocap-without-accelerometer")
    with pytest.raises(fp.InputError, match="sensors that can be wrong"):
        sensor_rungs("perfect")
    rungs = sensor_rungs("mocap")
    assert rung_named("1 pose in 200 wrong", rungs).sensors.outliers == 0.005
    with pytest.raises(fp.InputError, match="different numbers"):
        rung_named("1 pose in 200 wrong, IMU turned 1 deg", rungs)


def test_the_laboratory_is_wrong_as_it_says():
    plant = sensor_rungs("mocap")["laboratory"]
    lab = SUITES["laboratory"]
    assert plant.sensors == lab
    assert (
        lab.told.replace(**{name: SUITES["mocap"].streams[name] for name in ("position", "attitude", "rod")})
        == SUITES["mocap"]
    )
    assert (lab.gyro_bias, lab.untold_latency, lab.rod.dropouts) == (0.005, 0.008, 0.05)
    for name in ("imu_turned", "markers_turned", "rod_markers_off", "frame_turned"):
        assert getattr(lab, name) == pytest.approx(np.radians(0.5))
    assert (plant.strength, plant.sag, plant.centre_of_mass) == (0.93, 0.08, (0.003, 0.0, 0.0))
