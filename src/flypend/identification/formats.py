"""PX4's flight logs: ULog, read by pyulog, in the columns, units and frames of a log of ours."""

from __future__ import annotations

import io
from contextlib import redirect_stdout
from itertools import groupby
from operator import itemgetter
from typing import Any

import numpy as np

from flypend import errors
from flypend.errors import InputError

MAGIC = b"ULog\x01\x12\x35"
# Fields of uORB topics, by our columns with the factor of each. PX4's world is north-east-down, ours north-west-up; its
# body is front-right-down, ours front-left-up: half a turn about the first axis, in both.
TURNED = (1.0, -1.0, -1.0)
XYZ, QUATERNION = ("x", "y", "z"), ("qw", "qx", "qy", "qz")
TURNED_QUATERNION = (1.0, 1.0, -1.0, -1.0)
# Of those in one line the first that was logged: what motion capture sent, before what the filter made of it.
POSITIONS = (("vehicle_visual_odometry", "position[{}]"), ("vehicle_local_position", "{xyz}"))
ATTITUDES = (("vehicle_visual_odometry", "q[{}]"), ("vehicle_attitude", "q[{}]"))
MOST_ROTORS = 12  # of actuator_motors
MOST_PAST_END = 100  # reads beyond the last byte; a log cut off with the power takes one
TOPICS = [
    "vehicle_visual_odometry", "vehicle_local_position", "vehicle_attitude", "sensor_combined", "actuator_motors",
    "battery_status", "vehicle_land_detected",
]  # fmt: skip


def is_ulog(content: bytes | bytearray) -> bool:
    """Whether a file with this `content` is a ULog."""
    return content.startswith(MAGIC)


def parse_ulog(content: bytes | bytearray, field: str = "log") -> tuple[dict[str, Any], int]:
    """Return the columns of a ULog in the air, NaN where nothing was measured, and the number of rotors.

    A row is a time at which any topic was sampled; a command holds until the next. Raises InputError if a topic is
    missing or the file is no ULog.
    """
    topics = _topics(content, field)
    columns: list[tuple[Any, dict[str, Any]]] = [
        _read_first(topics, field, POSITIONS, XYZ, TURNED),
        _read_first(topics, field, ATTITUDES, QUATERNION, TURNED_QUATERNION),
        _read_first(topics, field, (("sensor_combined", "gyro_rad[{}]"),), ("gx", "gy", "gz"), TURNED),
        _read_first(topics, field, (("sensor_combined", "accelerometer_m_s2[{}]"),), ("ax", "ay", "az"), TURNED),
    ]
    commands = _commands(topics, field)
    columns.append(commands)
    if "battery_status" in topics:
        columns.append(_read_first(topics, field, (("battery_status", "voltage_v"),), ("vbat",), (1.0,)))
    table = merged(columns, 1e-6, *_in_air(topics, field))
    return table, len(commands[1])


def merged(
    columns: list[tuple[Any, dict[str, Any]]], unit: float, begin: float = 0.0, end: float = np.inf
) -> dict[str, Any]:
    """Return `columns` that each have times of their own, in a `unit` (s), on all times from `begin` to `end`.

    Where a column has no value there is NaN. Column "t" is in s, from the first time.
    """
    times = np.unique(np.concatenate([t for t, _ in columns]))
    times = times[(times >= begin) & (times <= end)]
    table: dict[str, Any] = {"t": (times - times[:1]) * unit}
    for stamps, named in columns:
        inside = (stamps >= begin) & (stamps <= end)
        rows = np.searchsorted(times, stamps[inside])
        for name, values in named.items():
            table[name] = np.full(len(times), np.nan)
            table[name][rows] = values[inside]
    return table


def _topics(content: bytes | bytearray, field: str) -> dict[str, dict[str, Any]]:
    """Return the first instance of each topic: arrays by field."""
    errors.require("pyulog", extra="logs", for_=field)
    from pyulog import ULog

    try:
        with redirect_stdout(io.StringIO()):  # it prints what it finds wrong
            read = ULog(_Stream(content), TOPICS)
    except Exception as error:
        raise InputError(field, "a ULog file", f"{type(error).__name__} in pyulog") from None
    return {one.name: one.data for one in read.data_list if one.multi_id == 0}


class _Stream(io.BytesIO):
    """A file that ends: of a wrong length pyulog reads, seeks back and reads at the end for ever."""

    past_end = 0

    def read(self, size: int | None = -1, /) -> bytes:
        content = super().read(size)
        self.past_end += len(content) < (size or 0)
        if self.past_end > MOST_PAST_END:
            raise EOFError
        return content


def _read_first(
    topics: dict[str, dict[str, Any]],
    field: str,
    sources: tuple[tuple[str, str], ...],
    names: tuple[str, ...],
    factors: tuple[float, ...],
) -> tuple[Any, dict[str, Any]]:
    """Return times, µs, and columns `names` of the first of `sources`, (topic, field), that was logged."""
    for topic, pattern in sources:
        data = topics.get(topic, {})
        fields = [pattern.format(i, xyz="xyz"[i % 3]) for i in range(len(names))]
        if all(name in data for name in (*fields, "timestamp")):
            # When it was measured, where that is told; when it was published otherwise.
            sampled = data.get("timestamp_sample", np.zeros(1))
            stamps, first = np.unique(sampled if np.all(sampled > 0) else data["timestamp"], return_index=True)
            with np.errstate(invalid="ignore"):  # damaged bits may be a signalling NaN
                values = [factor * data[name][first] for name, factor in zip(fields, factors, strict=True)]
            return stamps, dict(zip(names, values, strict=True))
    raise InputError(field, f"the topic {' or '.join(topic for topic, _ in sources)}", f"{', '.join(topics) or 'none'}")


def _commands(topics: dict[str, dict[str, Any]], field: str) -> tuple[Any, dict[str, Any]]:
    """Return times, µs, and the fractions of the rotors that are used: those of others are NaN."""
    names = tuple(f"u{i + 1}" for i in range(MOST_ROTORS))
    data = dict(topics.get("actuator_motors", {}))
    data.pop("timestamp_sample", None)  # a command acts from when it is published
    stamps, found = _read_first({"actuator_motors": data}, field, (("actuator_motors", "control[{}]"),), names,
                              (1.0,) * MOST_ROTORS)  # fmt: skip
    used = next((i for i, name in enumerate(names) if np.isnan(found[name]).all()), MOST_ROTORS)
    return stamps, {name: found[name] for name in names[:used]}


def _in_air(topics: dict[str, dict[str, Any]], field: str) -> tuple[float, float]:
    """Return begin and end of the longest flight, µs; all of the log where nobody told."""
    data = topics.get("vehicle_land_detected", {})
    if "landed" not in data or "timestamp" not in data:
        return 0.0, np.inf
    stamps = data["timestamp"].astype(float)
    spans = zip(stamps, [*stamps[1:], np.inf], data["landed"] != 0, strict=True)
    flights = [list(flight) for landed, flight in groupby(spans, key=itemgetter(2)) if not landed]
    if not flights:
        raise InputError(field, "a flight", "a vehicle that never took off, by vehicle_land_detected")
    last = max(float(one["timestamp"][-1]) for one in topics.values() if len(one.get("timestamp", ())))
    longest = max(flights, key=lambda flight: min(flight[-1][1], last) - flight[0][0])
    return longest[0][0], longest[-1][1]
