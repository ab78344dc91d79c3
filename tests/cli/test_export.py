"""flypend export-c and export-app: the sensors of a laboratory reach the code."""

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
