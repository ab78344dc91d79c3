"""PX4's logs: the same flight in ULog and in CSV is the same log, and whatever else a file holds ends in one line."""

import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import flypend as fp
from flypend.errors import InputError
from flypend.identification.log import parse_log, read_log
from tests.identification.test_log import table, text

FORMATS = {
    "vehicle_attitude": "uint64_t timestamp;uint64_t timestamp_sample;float[4] q;",
    "vehicle_local_position": "uint64_t timestamp;float x;float y;float z;",
    "vehicle_visual_odometry": "uint64_t timestamp;uint64_t timestamp_sample;float[3] position;float[4] q;",
    "sensor_combined": "uint64_t timestamp;float[3] gyro_rad;float[3] accelerometer_m_s2;",
    "actuator_motors": "uint64_t timestamp;uint64_t timestamp_sample;float[12] control;",
    "battery_status": "uint64_t timestamp;float voltage_v;",
    "vehicle_land_detected": "uint64_t timestamp;bool landed;",
}
FIRST = 5_000_000  # µs; the flight controller was on for a while


def message(kind, content):
    return struct.pack("<Hc", len(content), kind.encode()) + content


def ulog(messages):
    """A ULog, by its specification, of (topic, values of its fields)."""
    out = [b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 0)]
    out += [message("F", f"{name}:{fields}".encode()) for name, fields in FORMATS.items()]
    numbers = {name: k for k, name in enumerate(FORMATS)}
    logged = dict.fromkeys(name for name, _ in messages)
    out += [message("A", struct.pack("<BH", 0, numbers[name]) + name.encode()) for name in logged]
    codes = {"uint64_t": "Q", "bool": "?", "float": "f", "float[3]": "3f", "float[4]": "4f", "float[12]": "12f"}
    packed = {
        name: "<" + "".join(codes[field.split()[0]] for field in fields.split(";")[:-1])
        for name, fields in FORMATS.items()
    }
    out += [message("D", struct.pack("<H", numbers[name]) + struct.pack(packed[name], *values))
            for name, values in messages]  # fmt: skip
    return b"".join(out)


def flight(rows, mocap=False):
    """The rows of a CSV as PX4 would log them, 100 times a second: north-east-down, front-right-down."""
    names, unused = rows[0], [np.nan] * 8
    for row in rows[1:]:
        at = dict(zip(names, map(float, row), strict=True))
        us = FIRST + round(1e6 * at["t"])
        position = at["x"], -at["y"], -at["z"]
        q = at["qw"], at["qx"], -at["qy"], -at["qz"]
        gyro, force = ([at[f"{c}x"], -at[f"{c}y"], -at[f"{c}z"]] for c in "ga")
        yield "sensor_combined", (us, *gyro, *force)
        if mocap:
            yield "vehicle_visual_odometry", (us + 900, us, *position, *q)
        else:
            yield "vehicle_local_position", (us, *position)
        yield "vehicle_attitude", (us + 700, us, *((1.0, 0.0, 0.0, 0.0) if mocap else q))
        yield "actuator_motors", (us, us - 300, *(at[f"u{i}"] for i in range(1, 5)), *unused)
        yield "battery_status", (us, at["vbat"])


@pytest.mark.parametrize("mocap", [False, True])
def test_a_flight_is_the_same_from_px4_and_from_a_table(tmp_path, mocap):
    rows = table()
    path = tmp_path / "flight.ulg"
    path.write_bytes(ulog(list(flight(rows, mocap))))
    found, same = read_log(path), parse_log(text(rows))
    assert found.t == pytest.approx(same.t, abs=1e-9)
    for name in ("position", "rotation", "gyro", "force", "command"):
        assert getattr(found, name) == pytest.approx(getattr(same, name), abs=1e-6)  # PX4 logs single precision
    assert np.isnan(found.rod).all()
    with pytest.raises(InputError, match="command='pwm'"):
        fp.identify(path, fp.vehicle("hehn2011"))


def test_motion_capture_that_sent_no_numbers_is_not_preferred(tmp_path):
    rows = table()
    lost = [("vehicle_visual_odometry", (FIRST + 10_000 * k, FIRST + 10_000 * k, *[np.nan] * 7)) for k in range(1200)]
    path = tmp_path / "flight.ulg"
    path.write_bytes(ulog([*flight(rows), *lost]))
    found, same = read_log(path), parse_log(text(rows))
    assert found.position == pytest.approx(same.position, abs=1e-6)
    assert found.rotation == pytest.approx(same.rotation, abs=1e-6)


def test_the_longest_flight_is_read(tmp_path):
    rows = table(rows=4000)
    times = FIRST + 1e6 * np.array([0.0, 2.0, 4.0, 6.0, 8.0, 28.0])
    landed = [("vehicle_land_detected", (int(us), down)) for us, down in zip(times, [1, 0, 1, 0, 0, 1], strict=True)]
    path = tmp_path / "flight.ulg"
    path.write_bytes(ulog([*flight(rows), *landed]))
    found = read_log(path)
    assert found.duration == pytest.approx(22.0)
    assert found.gyro[0, 0] == pytest.approx(float(rows[601][rows[0].index("gx")]), abs=1e-6)
    path.write_bytes(ulog([*flight(rows), *((name, (us, True)) for name, (us, _) in landed)]))
    with pytest.raises(InputError, match="never took off"):
        read_log(path)


def test_topics_at_rates_of_their_own_leave_cells_empty(tmp_path):
    slow = [one for i, one in enumerate(flight(table())) if one[0] != "vehicle_local_position" or i % 20 < 5]
    path = tmp_path / "flight.ulg"
    path.write_bytes(ulog(slow))
    found = read_log(path)
    assert len(found.t) == 1200
    assert np.isfinite(found.gyro).all()
    assert np.isfinite(found.position).all(axis=1).sum() == 300


@pytest.mark.parametrize("topic", ["vehicle_attitude", "vehicle_local_position", "sensor_combined", "actuator_motors"])
def test_a_topic_that_is_not_there_is_named(tmp_path, topic):
    path = tmp_path / "flight.ulg"
    path.write_bytes(ulog([one for one in flight(table(rows=30)) if one[0] != topic]))
    with pytest.raises(InputError, match=topic) as refused:
        read_log(path)
    assert topic not in str(refused.value.got)


@settings(max_examples=60, deadline=None)
@given(place=st.integers(16, 1500), wrong=st.binary(min_size=1, max_size=4), cut=st.integers(0, 4000))
def test_a_wrong_byte_ends_in_a_log_or_in_one_line(tmp_path_factory, place, wrong, cut):
    good = bytearray(ulog(list(flight(table(rows=40)))))
    good[place : place + len(wrong)] = wrong
    path = tmp_path_factory.mktemp("wrong") / "flight.ulg"
    path.write_bytes(good[: len(good) - cut])
    with pytest.raises(InputError):  # 40 rows are too short a flight, whatever else
        read_log(path)
