"""Logs: what is read, and that whatever else a file holds ends in one line that says where."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from flypend.errors import InputError
from flypend.geometry import rotation_from_quat_xyzw
from flypend.identification.log import (
    CRAZYFLIE,
    NEEDED,
    POSE,
    ROD,
    _check,
    _from_crazyflie,
    instants,
    parse_log,
    read_log,
)

NAMES = (*NEEDED, "ax", "ay", "az", "rx", "ry", "rz", "u1", "u2", "u3", "u4", "vbat")


def table(rows=1200, rate=100.0):
    """A good log as a list of rows of cells, header first."""
    rng = np.random.default_rng(0)
    columns = {name: rng.normal(size=rows) for name in NAMES}
    columns["t"] = np.arange(rows) / rate
    for group in (("qw", "qx", "qy", "qz"), ("rx", "ry", "rz")):
        values = np.stack([columns[name] for name in group])
        columns |= dict(zip(group, values / np.linalg.norm(values, axis=0), strict=True))
    columns |= {f"u{i}": np.abs(columns[f"u{i}"]) for i in range(1, 5)}
    return [list(NAMES), *([repr(float(columns[name][k])) for name in NAMES] for k in range(rows))]


def text(rows):
    return "\n".join(",".join(row) for row in rows) + "\n"


def test_every_cell_is_read_where_it_stands():
    rows = table()
    log = parse_log(text(rows))
    cell = {name: float(value) for name, value in zip(rows[0], rows[8], strict=True)}
    assert log.t[7] == cell["t"]
    assert np.array_equal(log.position[7], [cell["x"], cell["y"], cell["z"]])
    assert np.array_equal(log.gyro[7], [cell["gx"], cell["gy"], cell["gz"]])
    assert np.array_equal(log.force[7], [cell["ax"], cell["ay"], cell["az"]])
    assert np.array_equal(log.command[7], [cell[f"u{i}"] for i in range(1, 5)])
    assert log.rod[7] == pytest.approx([cell["rx"], cell["ry"], cell["rz"]], rel=1e-12)  # made of length 1 again
    quaternion = np.array([cell["qx"], cell["qy"], cell["qz"], cell["qw"]])
    assert log.rotation[7] == pytest.approx(rotation_from_quat_xyzw(quaternion), abs=1e-12)


def test_a_byte_order_mark_before_a_table_is_no_part_of_it(tmp_path):
    (tmp_path / "excel.csv").write_text(text(table()), encoding="utf-8-sig")
    assert np.array_equal(read_log(tmp_path / "excel.csv").t, parse_log(text(table())).t)


def test_a_crazyflie_s_log_is_the_same_in_its_names_and_units():
    rows = table()
    ours = parse_log(text(rows))
    header = {name: (theirs, unit) for theirs, (name, unit) in CRAZYFLIE.items()}
    places = [i for i, name in enumerate(NAMES) if name in header]
    theirs = [[header[NAMES[i]][0] for i in places]]
    theirs += [[repr(float(row[i]) / header[NAMES[i]][1]) for i in places] for row in rows[1:]]
    log = parse_log(text(theirs))
    assert {"locSrv.x", "gyro.z", "motor.m4"} <= set(theirs[0])
    for name in ("t", "position", "rotation", "gyro", "force", "command"):
        assert getattr(log, name) == pytest.approx(getattr(ours, name), rel=1e-12, abs=1e-12)
    assert log.gyro[5, 1] == pytest.approx(np.radians(float(theirs[6][theirs[0].index("gyro.y")])))  # it logs deg/s
    theirs[0][0] = "tick"
    with pytest.raises(InputError, match="row 1, column"):
        parse_log(text(theirs))
    theirs[0][:2] = "timestamp", "stateEstimateZ.x"
    with pytest.raises(InputError, match=r"stateEstimateZ\.x"):
        parse_log(text(theirs))


def test_what_a_crazyflie_s_log_lacks_has_its_name_there():
    found = {theirs: np.zeros(9) for theirs, (name, _) in CRAZYFLIE.items() if name != "gy"}
    with pytest.raises(InputError, match=r"row 1: expected a column 'gyro\.y', beside timestamp, "):
        _from_crazyflie(found, "log")


def test_a_log_without_rotors_is_none():
    columns = {name: np.array([float(row[i]) for row in table()[1:]]) for i, name in enumerate(NAMES)}
    with pytest.raises(InputError, match=r"^log: expected commands of rotors, got none"):
        _check(columns, 0, "log", fractions=True)


def test_the_origin_of_time_is_that_of_the_first_row():
    """Of a clock that began in 1970, differences by a delay of 1e-6 s were rounded by a tenth of it."""
    rows, late = table(), table()
    for row in late[1:]:
        row[0] = repr(float(row[0]) + 1.7e9)
    assert parse_log(text(late)).t == pytest.approx(parse_log(text(rows)).t, abs=3e-7)  # of a double at 1.7e9


@pytest.mark.parametrize("rate", [60.0, 240.0, 400.0])
@pytest.mark.parametrize("dropped", [0.0, 0.1])
def test_stamps_in_whole_milliseconds_are_of_even_readings(rate, dropped):
    """Rows of 60 Hz are 16 or 17 ms apart: a grid of 17 ms leaves them by half a step."""
    rows = table(rows=int(12 * rate), rate=rate)
    even = instants(parse_log(text(rows)))
    for row in rows[1:]:
        row[0] = repr(round(float(row[0]), 3))
    kept = np.random.default_rng(1).random(len(rows)) >= dropped
    kept[:2] = kept[-1] = True
    found = instants(parse_log(text([row for row, there in zip(rows, kept, strict=True) if there])))
    assert len(found) == len(even)
    assert np.abs(found - even).max() <= 1.1e-3  # half a millisecond at either end, and its share in a step


def test_instants_are_those_of_the_gyro_among_rows_of_others():
    """As of topics that each have their own times; poses come 1.3 ms after every third reading of the gyro."""
    rows = table(rows=2400, rate=200.0)
    names, gyro = rows[0], {NAMES.index(name) for name in ("gx", "gy", "gz")}
    split = [names]
    for k, row in enumerate(rows[1:]):
        split.append([cell if i == 0 or i in gyro else "" for i, cell in enumerate(row)])
        if k % 3 == 0:
            later = [repr(float(row[0]) + 1.3e-3), *row[1:]]
            split.append(["" if i in gyro else cell for i, cell in enumerate(later)])
    found = instants(parse_log(text(split)))
    read = np.array([float(row[0]) for row in rows[1:]])
    assert np.abs(found - read[: len(found)]).max() < 1e-9
    assert len(found) >= len(read)


def test_empty_cells_are_no_readings_and_commands_are_held():
    rows = table()
    for name in ("x", "qw", "rx", "u2"):
        rows[8][NAMES.index(name)] = ""
    log = parse_log(text(rows))
    assert np.isnan(log.position[7, 0])
    assert np.isnan(log.rotation[7]).all()
    assert np.isnan(log.rod[7]).any()
    assert log.command[7, 1] == log.command[6, 1] == float(rows[7][NAMES.index("u2")])


def test_a_pose_that_is_kept_until_the_next_was_measured_once():
    rows = table()
    kept = [rows[0].index(name) for name in (*POSE, *ROD)]
    for k in range(2, len(rows), 2):
        for i in kept:
            rows[k][i] = rows[k - 1][i]
    log = parse_log(text(rows))
    for stream in (log.position, log.rotation, log.rod):
        assert np.isfinite(stream[::2]).all()
        assert np.isnan(stream[1::2]).all()
    assert np.isfinite(log.gyro).all()


def without(rows, name):
    place = NAMES.index(name)
    return [row[:place] + row[place + 1 :] for row in rows]


def changed(rows, number, name, cell):
    rows[number - 1][NAMES.index(name)] = cell
    return rows


WRONG = {
    "a column is missing": (lambda r: without(r, "gy"), "row 1.*'gy'"),
    "half an accelerometer": (lambda r: without(r, "ay"), "row 1.*'ay'"),
    "three rotors": (lambda r: without(r, "u4"), "row 1.*'u4'"),
    "a column nobody knows": (lambda r: changed(r, 1, "vbat", "vbatt"), "row 1, column.*vbatt.*did you mean 'vbat'"),
    "a column twice": (lambda r: changed(r, 1, "vbat", "ax"), "row 1.*'ax' 2 times"),
    "no number": (lambda r: changed(r, 500, "gz", "fast"), "row 500, column gz.*'fast'"),
    "infinite": (lambda r: changed(r, 77, "x", "inf"), "row 77, column x"),
    "a short row": (lambda r: [*r[:40], r[40][:-1], *r[41:]], "row 41.*22 cells.*21"),
    "no time": (lambda r: changed(r, 90, "t", ""), "row 90, column t"),
    "time stands still": (lambda r: changed(r, 90, "t", r[88][0]), "row 90, column t.*later"),
    "a gap": (lambda r: [*r[:300], *r[400:]], "row 301, column t.*gaps"),
    "a gap after 1970": (
        lambda r: [r[0], *([repr(1.7e9 + float(w[0])), *w[1:]] for w in [*r[1:300], *r[400:]])],
        "row 301, column t.*1700000003.99 after 1700000002.98",
    ),
    "too short": (lambda r: r[:900], "10 s of flight"),
    "milliseconds": (lambda r: [r[0], *([repr(1e3 * float(w[0])), *w[1:]] for w in r[1:])], "column t.*ms"),
    "a quaternion of length 2": (lambda r: changed(r, 33, "qw", "2"), "row 33, column qw.*length"),
    "a quaternion beyond measure": (lambda r: changed(r, 33, "qw", "1e200"), "row 33, column qw.*length inf"),
    "a rod in metres": (lambda r: changed(r, 33, "rz", "3"), "row 33, column rx.*length"),
    "a negative command": (lambda r: changed(r, 12, "u3", "-0.1"), "row 12, columns u1.*-0.1"),
    "no gyro at all": (lambda r: [r[0], *([*w[:8], "", "", "", *w[11:]] for w in r[1:])], "gyro"),
    "nothing": (lambda r: [], "row 1"),
    "an open quote": (lambda r: changed(r, 60, "x", '"1'), "CSV"),
}


@pytest.mark.parametrize(("spoil", "said"), WRONG.values(), ids=WRONG)
def test_a_bad_log_is_refused_with_row_and_column(spoil, said):
    parse_log(text(table()))  # the same, not spoilt, is read
    with pytest.raises(InputError, match=said) as refused:
        parse_log(text(spoil(table())))
    assert "\n" not in str(refused.value)


GOOD = text(table(1100))


@settings(max_examples=60, deadline=None)
@given(st.integers(0, len(GOOD)), st.integers(0, 40), st.text(max_size=12))
def test_whatever_a_file_holds_is_read_or_refused(place, cut, put):
    try:
        log = parse_log(GOOD[:place] + put + GOOD[place + cut :])
    except InputError:
        return
    assert np.all(np.diff(log.t) > 0)
    assert np.all(np.isfinite(log.command))
    for values in (log.position, log.gyro, log.force, log.rod):
        assert not np.isinf(values).any()


@settings(max_examples=60, deadline=None)
@given(st.text(max_size=200))
def test_whatever_a_text_says_is_refused_in_one_line(content):
    with pytest.raises(InputError) as refused:
        parse_log(content)
    assert len(str(refused.value).splitlines()) == 1
