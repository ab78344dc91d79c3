"""flypend export-c and export-app: the sensors of a laboratory reach the code."""

import shutil
from pathlib import Path

import pytest

SENSORS = 'base = "mocap"\nposition = { rate = 120.0, latency = 0.0095 }\n'


@pytest.mark.parametrize(
    "command", [("export-c", "--no-check"), ("export-app", "crazyflie", "crazyflie", "--height", 2)]
)
def test_sensors_come_from_a_file(call, tmp_path, command):
    (tmp_path / "sensors.toml").write_text(SENSORS, encoding="utf-8")
    code, _, said = call(*command, "--sensors", "sensors.toml", "-o", "out")
    assert code == 0, said
    assert "position: 120 Hz, noise 0.001, latency 0.0095 s" in (tmp_path / "out/flypend_sensors.h").read_text()


def test_a_wrong_table_of_sensors_is_one_line(call, tmp_path):
    (tmp_path / "sensors.toml").write_text('base = "mocap"\ngyro_bias = -1\n', encoding="utf-8")
    code, _, said = call("export-c", "--sensors", "sensors.toml", "-o", "out")
    assert code == 2
    assert said.startswith("flypend: sensors.gyro_bias: ")
    assert said.count("\n") == 1
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "command", [("export-c", "--no-check"), ("export-app", "px4", "hehn2011", "--height", 2)], ids=["c", "app"]
)
def test_what_no_export_wrote_is_not_overwritten(call, tmp_path, command):
    place = tmp_path / "out"
    for name in ("README.md", "CMakeLists.txt"):
        place.mkdir()
        (place / name).write_text("of mine, about flypend", encoding="utf-8")
        code, _, said = call(*command, "-o", "out")
        assert (code, said.count("\n")) == (2, 1)
        assert said.startswith(f"flypend: {Path('out', name)}: expected nothing, or a folder that an export wrote")
        assert [path.read_text() for path in place.iterdir()] == ["of mine, about flypend"]
        shutil.rmtree(place)
    for _ in range(2):  # its own are replaced
        assert call(*command, "-o", "out")[0] == 0


def test_an_app_tells_only_of_limits_that_change(call, tmp_path):
    for limits, told in (([0.02, 0.11], False), ([0.01, 0.2], True)):
        (tmp_path / "mine.toml").write_text(
            f'base = "crazyflie"\nthrust_scale = 0.9\nrotor_limits = {limits}', encoding="utf-8"
        )
        code, out, said = call("export-app", "crazyflie", "mine.toml", "--height", 2)
        assert code == 0, said
        assert ("rotor forces" in out + said) == told
