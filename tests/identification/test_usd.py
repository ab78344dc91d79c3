"""Logs of the Crazyflie's µSD card: the same flight as in CSV is the same log; anything else ends in one line."""

import struct
from zlib import crc32

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import flypend as fp
from flypend.errors import InputError
from flypend.identification.formats import USD, parse_usd
from flypend.identification.log import CRAZYFLIE, parse_log, read_log
from tests.identification.test_log import table, text

FIRST = 81_000_000  # µs; the vehicle was on for a while


def signed(content):
    return content + struct.pack("<I", crc32(content))


def kind(number, name, variables):
    """The header of one kind of event, with the variables' types by name."""
    named = b"".join(f"{one}({letter})".encode() + b"\0" for one, letter in variables.items())
    return struct.pack("<H", number) + name.encode() + b"\0" + struct.pack("<H", len(variables)) + named


def card(variables, rows):
    """A log by the firmware's usddeck.c: (µs, values) of the variables, and another event after each."""
    body = USD + struct.pack("<H", 2) + kind(0xFFFF, "fixedFrequency", variables)
    body += kind(3, "estTDOA", {"idA": "B", "distance": "f", "half": "e"})
    layout = "<HQ" + "".join(variables.values())
    for us, values in rows:
        body += struct.pack(layout, 0xFFFF, us, *values) + struct.pack("<HQBfe", 3, us + 40, 7, 0.5, 0.25)
    return signed(body)


def flight(pose="stateEstimate", hold=1):
    """The rows of a CSV as a card would hold them, each sent pose for `hold` rows; and as CSV of the Crazyflie."""
    ours = table()
    units = {
        name: (theirs, unit)
        for theirs, (name, unit) in CRAZYFLIE.items()
        if theirs.startswith((pose, "g", "a", "m", "p"))
    }
    names = [name for name in ours[0] if name in units]
    variables = {units[name][0]: "H" if name[0] == "u" else "f" for name in names} | {"baro.asl": "f"}
    rows = []
    for k, row in enumerate(ours[1:]):
        at = dict(zip(ours[0], map(float, row), strict=True))
        sent = dict(zip(ours[0], map(float, ours[1 + k - k % hold]), strict=True))
        values = [(sent if units[name][0].startswith(pose) else at)[name] / units[name][1] for name in names]
        values = [
            min(round(value), 65535) if name[0] == "u" else value for name, value in zip(names, values, strict=True)
        ]
        rows.append((FIRST + round(1e6 * at["t"]), [*values, 350.0]))
    lines = [["timestamp", *(units[name][0] for name in names)]]
    lines += [[repr(us / 1e3), *map(repr, values[:-1])] for us, values in rows]
    return card(variables, rows), text(lines)


def test_a_flight_is_the_same_from_a_card_and_from_a_table(tmp_path):
    content, csv = flight()
    path = tmp_path / "log00"
    path.write_bytes(content)
    found, same = read_log(path), parse_log(csv)
    assert found.fractions
    assert found.t == pytest.approx(same.t, abs=1e-9)
    for name in ("position", "rotation", "gyro", "force", "command"):
        assert getattr(found, name) == pytest.approx(getattr(same, name), rel=1e-6, abs=1e-6)  # single precision
    with pytest.raises(InputError, match="command='pwm'"):
        fp.identify(path, fp.vehicle("crazyflie"))


def test_a_pose_that_was_sent_once_is_measured_once(tmp_path):
    content, csv = flight("locSrv", hold=2)
    path = tmp_path / "log00"
    path.write_bytes(content)
    for log in (read_log(path), parse_log(csv)):
        assert np.isfinite(log.position[::2]).all()
        assert np.isnan(log.position[1::2]).all()
        assert np.isnan(log.rotation[1::2]).all()
        assert np.isfinite(log.gyro).all()


def test_a_log_that_was_not_stopped_is_refused(tmp_path):
    path = tmp_path / "log00"
    path.write_bytes(flight()[0][:-400])
    with pytest.raises(InputError, match="stopped before power off"):
        read_log(path)


def test_variables_that_are_missing_are_named(tmp_path):
    path = tmp_path / "log00"
    path.write_bytes(card({"stateEstimate.x": "f"}, [(FIRST, (1.0,))]))
    with pytest.raises(InputError, match=r"'stateEstimate\.y'"):
        read_log(path)


GOOD = flight()[0][:-4][:4000]


@settings(max_examples=300, deadline=None)
@given(st.integers(len(USD), len(GOOD)), st.integers(0, 40), st.binary(max_size=12))
def test_whatever_a_file_holds_behind_its_checksum_is_read_or_refused(place, cut, put):
    try:
        found = parse_usd(signed(GOOD[:place] + put + GOOD[place + cut :]))
    except InputError:
        return
    assert not any(np.isinf(values).any() for values in found.values())
