"""All errors of a laboratory at once: what is drawn, what fails first, and what to calibrate."""

import json

import numpy as np
import pytest

import flypend as fp
from flypend.cli.studies import ladder
from flypend.files.toml import toml_text
from flypend.flight.tasks import task_starts
from flypend.plants import ROTORS, SUITES
from flypend.plants.defects import CONSTANT, NEEDS, NUMBERS
from flypend.report.check import joint_lines
from flypend.studies import joint as joints
from flypend.studies.joint import Errors, Joint, joint
from flypend.studies.ladder import DEFECTS, rung_named, sensor_rungs
from flypend.studies.margins import Count

HEHN = fp.vehicle("hehn2011")


def errors_of(suite="mocap", vehicle=HEHN, **defects):
    plant = ROTORS.replace(sensors=SUITES[suite].replace(**defects))
    return Errors(vehicle, plant, np.random.default_rng(3))


def test_all_errors_of_a_laboratory_are_in_one_world_and_each_can_be_off():
    wrong = errors_of(gyro_bias=0.05, markers_off=(0.0, 0.01, 0.0))
    everything = dict.fromkeys(wrong.names, 1.0)
    world = wrong.world(everything)
    sensors, lab = world.sensors, SUITES["laboratory"]
    assert (sensors.gyro_bias, sensors.markers_off) == (0.05, (0.0, 0.01, 0.0))  # its own
    for name in ("imu_turned", "markers_turned", "rod_markers_off", "frame_turned", "untold_latency"):
        assert getattr(sensors, name) == getattr(lab, name)
    assert (world.sag, world.centre_of_mass) == (0.08, (0.003, 0.0, 0.0))
    assert all(0.8 <= world.mismatch[name] <= 1.2 and world.mismatch[name] != 1 for name in ("mass", "bob_mass"))
    assert np.all(np.abs(np.array(world.strength) - 1) <= 0.15)
    none = wrong.world({})
    assert none.sensors == SUITES["mocap"]
    assert (none.sag, none.centre_of_mass, set(none.strength)) == (0.0, (0.0, 0.0, 0.0), {1.0})
    assert set(none.mismatch.values()) == {1.0}
    without = wrong.world(everything | {"mass": 0.0, "gyro_bias": 0.0})
    assert "mass" not in without.mismatch
    assert without.sensors.gyro_bias == 0.0
    assert without.mismatch["rod_length"] == world.mismatch["rod_length"]
    assert without.sensors.imu_turned == sensors.imu_turned


def test_errors_grow_in_proportion_and_end_where_a_plant_does():
    wrong = errors_of(outliers=0.4)
    one, four = (wrong.world(dict.fromkeys(wrong.names, scale)) for scale in (1.0, 4.0))
    assert four.mismatch["mass"] == pytest.approx(one.mismatch["mass"] ** 4)
    assert four.sensors.imu_turned == pytest.approx(4 * one.sensors.imu_turned)
    assert (four.sensors.outliers, four.sag) == (0.99, 0.25)


def test_bands_of_a_vehicle_are_drawn_in_place_of_the_usual_ones():
    mine = HEHN.replace(bands={"mass": (0.49, 0.51), "sag": (0.1, 0.12), "rotor_limits": ((0, 3), (0, 4))})
    wrong = errors_of(vehicle=mine)
    assert {"mass", "sag"} < set(wrong.names)
    assert not {"rod_length", "thrust_scale", "rotor_limits"} & set(wrong.names)
    world = wrong.world(dict.fromkeys(wrong.names, 1.0))
    assert 0.98 <= world.mismatch["mass"] <= 1.02
    assert 0.1 <= world.sag <= 0.12
    assert "joints_off" in errors_of("onboard").names
    assert "rod_markers_off" not in errors_of("onboard").names


def flown(monkeypatch, succeed):
    """A study whose flights succeed as the function `succeed` of the plant says: a share of them."""

    def fly(flight, worlds, progress):
        return [Count(round(succeed(world) * flight.runs), flight.runs) for world in worlds]

    monkeypatch.setattr(joints, "_fly", fly)
    monkeypatch.setattr(
        joints, "_fly_tasks", lambda flight, starts, drawn, progress: ({"random": Count(9, 9)}, drawn[0])
    )
    return joint(HEHN, plant=ROTORS.replace(sensors=SUITES["mocap"]), runs=40)


def test_what_fails_first_is_named_with_the_size_that_keeps_90_per_cent(monkeypatch):
    """A world that falls from 0.02 rad of the rod's markers on, of which the laboratory has 0.0087."""
    found = flown(monkeypatch, lambda world: float(world.sensors.rod_markers_off < 0.02))
    assert list(found.scales) == [1.0, 2.0, 4.0]
    assert (found.causes[0].name, found.calibrated, found.share) == ("rod_markers_off", ("rod_markers_off",), 0.5)
    assert (found.causes[0].alone.rate, found.causes[0].without.rate) == (0.0, 1.0)
    assert {one.name: one.alone.rate for one in found.causes}["mass"] == 1.0
    assert "fails first, errors × 4: rod_markers_off 0.0349 rad" in found.lines()
    assert found.lines()[-1].startswith("calibrate to × 0.5 of rod_markers_off 0.0349 rad: 40 of 40")
    assert joint_lines({"inverted": found})[0] == "inverted, all at once:"
    assert json.loads(json.dumps(found.to_dict()))["causes"][0]["without"]["wilson"][1] > 0.999


def test_no_two_runs_of_the_draws_share_their_noise(monkeypatch):
    seeds = {}

    def count(one, task):
        seeds.setdefault(task, []).extend(range(one.seed, one.seed + one.runs))
        return Count(one.runs, one.runs)

    monkeypatch.setattr(joints, "_fly", lambda flight, worlds, progress: [Count(1, 1) for _ in worlds])
    monkeypatch.setattr(joints, "_count", count)
    random = {"random": task_starts(HEHN, 40, 1)["random"]}
    monkeypatch.setattr(joints, "task_starts", lambda *_: random)
    joint(HEHN, plant=ROTORS.replace(sensors=SUITES["mocap"]), runs=40)
    assert [len(set(of_one_task)) for of_one_task in seeds.values()] == [40, joints.POKES]


def test_two_errors_of_which_each_is_enough_are_both_to_be_calibrated(monkeypatch):
    found = flown(
        monkeypatch, lambda world: float(world.sensors.rod_markers_off < 0.004 and world.sensors.gyro_bias < 0.004)
    )
    assert set(found.calibrated) == {"rod_markers_off", "gyro_bias"}
    assert (found.scale, found.share) == (1.0, 0.25)


def test_nothing_fails_first_where_nothing_fails(monkeypatch):
    found = flown(monkeypatch, lambda world: 1.0)
    assert found.causes == ()
    assert found.lines()[-1] == "nothing fails first: errors × 4 keep 90 %"


@pytest.mark.slow
def test_a_defect_ten_times_too_large_is_what_fails_first(monkeypatch):
    """Markers of the rod off by 10 times what the laboratory has."""
    monkeypatch.setattr(joints, "DRAWS", 2)
    ten = 10 * SUITES["laboratory"].rod_markers_off
    found = joint(HEHN, plant=ROTORS.replace(sensors=SUITES["mocap"].replace(rod_markers_off=ten)), runs=48)
    assert found.scale == 1.0
    assert found.causes[0].name == "rod_markers_off"
    assert "rod_markers_off" in found.calibrated
    assert isinstance(found, Joint)
    assert set(found.tasks) == {"hover", "lean", "hanging", "level", "random", "pokes"}


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


def test_a_ladder_takes_sensors_from_a_file(tmp_path, monkeypatch):
    """The rungs are those of a suite with these sensors, and the command hands them over."""
    table = {"base": "mocap", "rod": {"noise": 0.001}}
    rungs = sensor_rungs(table, "mine.toml")
    assert list(rungs)[1:] == list(sensor_rungs("mocap"))[1:]
    assert rungs["mine.toml"].sensors.rod.noise == rungs["gyro scale 2 %"].sensors.rod.noise == 0.001
    (tmp_path / "mine.toml").write_text(toml_text(table), encoding="utf-8")
    flown = {}

    def watched(*_, rungs, **__):
        flown.update(rungs)
        raise SystemExit

    monkeypatch.setattr("flypend.studies.ladder", watched)
    arguments = ["--sensors", str(tmp_path / "mine.toml"), "--runs", "1", "-o", str(tmp_path / "out")]
    with pytest.raises(SystemExit):
        ladder.main(arguments, standalone_mode=False)
    assert flown == rungs


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
