"""A flight log: a table of what was commanded and measured, from CSV, ULog, µSD or a bag, checked cell by cell.

The filter takes it on an even grid: readings of each step averaged, with the age of the pose.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from flypend import errors
from flypend.errors import InputError
from flypend.files.reading import read_bytes
from flypend.geometry import Numbers, project_rotation, rotation_from_quat_xyzw
from flypend.identification.formats import MCAP, ULOG, USD, parse_bag, parse_ulog, parse_usd

POSE = ("x", "y", "z", "qw", "qx", "qy", "qz")
GYRO = ("gx", "gy", "gz")
FORCE = ("ax", "ay", "az")
ROD = ("rx", "ry", "rz")
NEEDED = ("t", *POSE, *GYRO)
OPTIONAL = (*FORCE, *ROD, "vbat")
# The Crazyflie's log variables, as cflib and cfusdlog name them, by our columns with the unit of each; `locSrv`, the
# pose that it was sent, comes last and counts where the filter's is logged too. Commands are fractions of 65535.
CRAZYFLIE = {
    "timestamp": ("t", 1e-3),
    "pm.vbat": ("vbat", 1.0),
    **{f"{group}.{name}": (name, 1.0) for group in ("stateEstimate", "locSrv") for name in POSE},
    **{f"gyro.{axis}": (f"g{axis}", np.pi / 180) for axis in "xyz"},
    **{f"acc.{axis}": (f"a{axis}", 9.81) for axis in "xyz"},
    **{f"motor.m{i}": (f"u{i}", 1 / 65535) for i in range(1, 5)},
}
SHORTEST = 10.0  # s; a rod of half a metre swings seven times
SLOWEST = 50.0  # Hz; the rotation answers a kick within some 20 ms
LONGEST_GAP = 0.5  # s without any row, over which no prediction is worth its name
MOST_BYTES, COPIES = 2**28, 30  # ten minutes at 1 kHz; a cell as a Python number takes that much of its text
STEP = 5e-3  # s, of the grid; the rotation's fastest change, within the rotors' lag of 20 ms or more, takes four
NEAR_UNIT = 0.1  # a quaternion or direction of another length is of another kind


@dataclass(frozen=True, eq=False)
class Log:
    """What was commanded and measured in one flight, row by row; NaN where nothing was. World e₃ up, body FLU.

    Parameters
    ----------
    t : (k,)
        Time since the first row, s, increasing.
    position : (k, 3)
        The tracked point, world frame, m.
    rotation : (k, 3, 3)
        Body to world.
    gyro, force : (k, 3)
        Angular velocity, rad/s, and specific force, m/s², in the body frame; `force` is NaN without accelerometer.
    rod : (k, 3)
        Direction from the pivot to the bob, world frame; NaN if not tracked.
    command : (k, n)
        What each rotor was asked for: N, or a fraction from 0 to 1.
    fractions : bool
        Whether the format says that commands are fractions.
    name : str
        Of the file, for messages.
    """

    t: Numbers
    position: Numbers
    rotation: Numbers
    gyro: Numbers
    force: Numbers
    rod: Numbers
    command: Numbers
    fractions: bool = False
    name: str = "log"

    @property
    def duration(self) -> float:
        """From the first row to the last, s."""
        return float(self.t[-1] - self.t[0])

    @property
    def rate(self) -> float:
        """Rows per second, Hz."""
        return (len(self.t) - 1) / self.duration


def read_log(path: str | Path) -> Log:
    """Read the CSV, ULog, µSD or MCAP file at `path`. Raises InputError that names row and column, or topic.

    A ULog is PX4's: its longest flight is read. A µSD log is the Crazyflie's: of its variables those in `CRAZYFLIE`
    are read. Both have commands in fractions of the largest force. MCAP is a bag of ROS 2: see `formats`.
    """
    field = str(path)
    try:
        content = read_bytes(path, MOST_BYTES, copies=COPIES)
        for magic, parse in ((ULOG, parse_ulog), (MCAP, parse_bag)):
            if content.startswith(magic):
                columns, rotors, fractions = parse(content, field)
                return _check(columns, rotors, field, fractions=fractions)
        if content.startswith(USD):
            return _from_crazyflie(parse_usd(content, field), field)
        text = content.decode("utf-8-sig")
    except InputError:
        raise
    except OSError as error:
        raise InputError(field, "a readable file", error.strerror or error) from None
    except ValueError as error:  # not UTF-8, or a name that no file can have
        wanted = "a ULog, a µSD log of the Crazyflie, a bag in MCAP, or a CSV file in UTF-8"
        raise InputError(field, wanted, error) from None
    return parse_log(text, field)


def parse_log(text: str, field: str = "log") -> Log:
    """Read a log from the `text` of a CSV file, `field` in messages. Raises InputError that names row and column.

    With a column `timestamp`, columns have the names and units of `CRAZYFLIE`.
    """
    rows = csv.reader(io.StringIO(text.rstrip(), newline=""), strict=True)
    try:
        names = [name.strip() for name in next(rows, [])]
        if theirs := "timestamp" in names:
            _check_names(names, CRAZYFLIE, field)
        else:
            rotors = _check_header(names, field)
        table = [_numbers(row, names, number, field) for number, row in zip(count(2), rows, strict=False)]
    except csv.Error as error:
        raise InputError(field, f"CSV (line {rows.line_num})", error) from None
    values = np.array(table, dtype=float).reshape(len(table), len(names))
    columns = dict(zip(names, values.T, strict=True))
    return _from_crazyflie(columns, field) if theirs else _check(columns, rotors, field, fractions=False)


def _from_crazyflie(variables: dict[str, Any], field: str) -> Log:
    """Return the log in the Crazyflie's `variables` by name. Raises InputError if one is missing or wrong."""
    columns = {name: variables[theirs] * unit for theirs, (name, unit) in CRAZYFLIE.items() if theirs in variables}
    # Of two names for one thing, that of a group that is there.
    groups = {theirs.partition(".")[0] for theirs in variables}
    called = sorted(CRAZYFLIE, key=lambda theirs: theirs.partition(".")[0] in groups)
    rotors = _check_header(list(columns), field, {CRAZYFLIE[theirs][0]: theirs for theirs in called})
    return _check(columns, rotors, field, fractions=True)


def _check_names(names: list[str], known: Collection[str], field: str) -> None:
    """Raise InputError for a column that is unknown or there twice."""
    for name in names:
        errors.one_of(f"{field}, row 1, column", name, known)
        if names.count(name) > 1:
            raise InputError(f"{field}, row 1", "each column once", f"{name!r} {names.count(name)} times")


def _check_header(names: list[str], field: str, called: Mapping[str, str] = MappingProxyType({})) -> int:
    """Return the number of rotors. Raises InputError for a column that is unknown, missing or there twice.

    Of a log that has other names for them, `called` has those.
    """
    rotors = next(i for i in count() if f"u{i + 1}" not in names)
    _check_names(names, [*NEEDED, *OPTIONAL, *(f"u{i + 1}" for i in range(max(rotors, 4)))], field)
    for group in (NEEDED, *(group for group in (FORCE, ROD) if set(group) & set(names)), ("u1", "u2", "u3", "u4")):
        for name in group:
            if name not in names:
                theirs = [called.get(one, one) for one in group]
                wanted = f"a column {called.get(name, name)!r}, beside {', '.join(theirs)}"
                raise InputError(f"{field}, row 1", wanted, "none")
    return rotors


def _numbers(row: list[str], names: list[str], number: int, field: str) -> list[float]:
    """Return a row as numbers, NaN for empty cells. Raises InputError for other cells, too few or too many."""
    if len(row) != len(names):
        raise InputError(f"{field}, row {number}", f"{len(names)} cells, as in the header", f"{len(row)}")
    found = []
    for name, cell in zip(names, map(str.strip, row), strict=True):
        try:
            value = float(cell or "nan")
        except ValueError:
            value = np.inf
        if cell and not np.isfinite(value):
            given = repr(cell[:40])
            raise InputError(f"{field}, row {number}, column {name}", "a number, or an empty cell", given)
        found.append(value)
    return found


def _check_times(t: Any, field: str) -> None:
    if np.any(missing := np.isnan(t)):
        raise InputError(f"{field}, row {_row(missing)}, column t", "a time, s", "an empty cell")
    if np.any(back := np.diff(t) <= 0):
        raise InputError(f"{field}, row {_row(back) + 1}, column t", "a later time than before", _row_of(t, back))
    if len(t) < 2 or t[-1] - t[0] < SHORTEST:
        raise InputError(field, f"at least {SHORTEST:g} s of flight", f"{t[-1] - t[0] if len(t) else 0:.3g} s")
    if (rate := (len(t) - 1) / (t[-1] - t[0])) < SLOWEST:
        raise InputError(f"{field}, column t", f"at least {SLOWEST:g} rows a second (s, not ms?)", f"{rate:.3g}")
    if np.any(gap := np.diff(t) > LONGEST_GAP):
        most = f"gaps of at most {LONGEST_GAP:g} s"
        raise InputError(f"{field}, row {_row(gap) + 1}, column t", most, _row_of(t, gap))


def _check(columns: dict[str, Any], rotors: int, field: str, *, fractions: bool) -> Log:
    """Return the log of `columns`, its times and cells checked. Raises InputError."""
    t = columns["t"]
    _check_times(t, field)
    t = t - t[0]  # of a clock that began long ago, differences by the delay are rounded
    if rotors == 0:
        raise InputError(field, "commands of rotors", "none")
    groups = {name: np.stack([columns.get(one, np.full(len(t), np.nan)) for one in names], axis=-1)
              for name, names in (("position", POSE[:3]), ("q", POSE[3:]), ("gyro", GYRO), ("force", FORCE),
                                  ("rod", ROD))}  # fmt: skip
    for names in (("position", "q"), ("rod",)):
        # Many loggers keep the last pose until the next one comes: it was measured once.
        sent = np.concatenate([groups[name] for name in names], axis=1)
        again = np.append(False, (sent[1:] == sent[:-1]).all(axis=1))
        groups |= {name: np.where(again[:, None], np.nan, groups[name]) for name in names}
    for name in ("position", "q", "gyro"):
        if np.isfinite(groups[name]).all(axis=1).sum() < SLOWEST:
            raise InputError(field, f"rows with all of {name} measured", "next to none")
    for name, first in (("q", "qw"), ("rod", "rx")):
        with np.errstate(over="ignore"):  # of a damaged bag
            length = np.linalg.norm(groups[name], axis=1)
        if np.any(wrong := np.abs(length - 1) > NEAR_UNIT):
            given = f"length {length[np.argmax(wrong)]:.3g}"
            raise InputError(f"{field}, row {_row(wrong)}, column {first}", "a vector of length 1", given)
        groups[name] = groups[name] / length[:, None]
    command = np.stack([_hold_last(columns[f"u{i + 1}"], f"{field}, column u{i + 1}") for i in range(rotors)], axis=-1)
    if np.any(low := (command < 0).any(axis=1)):
        least = f"{command[np.argmax(low)].min():g}"
        raise InputError(f"{field}, row {_row(low)}, columns u1…", "commands >= 0", least)
    w, xyz = groups["q"][:, :1], groups["q"][:, 1:]
    known = np.isfinite(w[:, 0])
    rotation = np.full((len(t), 3, 3), np.nan)
    rotation[known] = rotation_from_quat_xyzw(np.concatenate([xyz, w], axis=1)[known])
    gyro, force, rod = (groups[name] for name in ("gyro", "force", "rod"))
    return Log(t, groups["position"], rotation, gyro, force, rod, command, fractions, field)


def _hold_last(values: Any, field: str) -> Any:
    """Return commands with empty cells filled by the one before. Raises InputError if there is none at all."""
    known = np.flatnonzero(np.isfinite(values))
    if not len(known):
        raise InputError(field, "commands", "empty cells")
    places = np.searchsorted(known, np.arange(len(values)), side="right") - 1
    return values[known[np.maximum(places, 0)]]


def _row(wrong: Any) -> int:
    """Number of the first wrong row in the file, whose header is row 1."""
    return int(np.argmax(wrong)) + 2


def _row_of(t: Any, wrong: Any) -> str:
    i = int(np.argmax(wrong))
    return f"{t[i + 1]:.15g} after {t[i]:.15g}"


# The grid -------------------------------------------------------------------------------------------------------------


class Grid(NamedTuple):
    """Readings at even instants `t` (k,), s, of `values` (k, 21) in the order of `model.CHANNELS`.

    The attitude has nine numbers, by rows. `counts` (k, 5) says how many rows each channel had there, `age` (k,) how
    long before the instant poses were taken, s, on average.
    """

    t: Numbers
    values: Numbers
    counts: Numbers
    age: Numbers


def instants(log: Log) -> Any:
    """Return the instants of the grid (k,), s, about `STEP` apart: each in the middle of whole readings of the gyro.

    No other reading changes as fast. Its interval is told by all stamps, which may be rounded, and by none left out.
    """
    t = log.t[np.isfinite(log.gyro).all(axis=1)]
    gaps = np.diff(t)
    usual = gaps[gaps <= 1.5 * np.median(gaps)].mean()
    apart = float((t[-1] - t[0]) / np.rint(gaps / usual).sum())
    rows = max(STEP, float(np.median(np.diff(log.t))))
    step = apart * max(1, int(STEP / apart + 0.2)) / max(1, int(apart / rows + 0.2))
    return np.arange(t[0] + max(0.0, step - apart) / 2, log.t[-1] + step / 2, step)


def to_grid(log: Log, latency: float) -> Grid:
    """Return `log` on the grid, with poses as old as `latency` (s) when they are written."""
    t, rows = instants(log), len(log.t)
    step = t[1] - t[0]
    streams = [log.position, log.rotation.reshape(rows, 9), log.gyro, log.force, log.rod]
    values, counts, age = np.zeros((len(t), 21)), np.zeros((len(t), 5)), np.zeros(len(t))
    begin = 0
    for channel, stream in enumerate(streams):
        pose, width = channel in (0, 1, 4), stream.shape[1]
        times = log.t - (latency if pose else 0.0)
        known = np.isfinite(stream).all(axis=1) & (times > t[0] - step / 2) & (times < t[-1] + step / 2)
        at = np.rint((times[known] - t[0]) / step).astype(int)
        counts[:, channel] = np.bincount(at, minlength=len(t))
        share = np.maximum(counts[:, channel], 1)
        for i in range(width):
            values[:, begin + i] = np.bincount(at, stream[known, i], len(t)) / share
        if channel == 0:
            age = np.bincount(at, t[at] - times[known], len(t)) / share
        begin += width
    some = counts[:, 1] > 0
    values[some, 3:12] = project_rotation(values[some, 3:12].reshape(-1, 3, 3)).reshape(-1, 9)
    return Grid(t, values, counts, age)
