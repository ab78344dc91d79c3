"""Flight logs in the formats of others, in the columns and units of a log of ours.

- ULog, of PX4, read by pyulog.
- MCAP, a bag of ROS 2, read by mcap-ros2-support. ROS has our frames (REP 103: world with e₃ up, body front-left-up),
  and its messages our units.
- The firmware's own format of the Crazyflie's µSD card deck: variables by name, as cfusdlog reads them.

    0xBC, version 2, number of kinds of events; of each kind its id, its name and its variables, "group.name(type)"
    events: id, time in µs, the variables packed
    CRC-32 of all that

  Types are letters of Python's struct. The firmware writes the checksum when logging is stopped.
"""

from __future__ import annotations

import io
import struct
from collections import defaultdict
from collections.abc import Sequence
from contextlib import redirect_stdout
from itertools import groupby
from operator import attrgetter, itemgetter
from typing import Any
from zlib import crc32

import numpy as np

from flypend import errors
from flypend.errors import InputError

ULOG, MCAP = b"ULog\x01\x12\x35", b"\x89MCAP0\r\n"
USD = b"\xbc\x02\x00"  # of version 2, which firmware since 2021 writes
XYZ = ("x", "y", "z")

Content = bytes | bytearray
Columns = tuple[Any, dict[str, Any]]  # times, and what was measured then by our columns


def merge(columns: Sequence[Columns], unit: float, begin: float = 0.0, end: float = np.inf) -> dict[str, Any]:
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


# ULog -----------------------------------------------------------------------------------------------------------------

# PX4's world is north-east-down, ours north-west-up; its body is front-right-down, ours front-left-up: half a turn
# about the first axis, in both.
TURNED = (1.0, -1.0, -1.0)
# Our columns, with the factor of each, and the topics and fields that have them. Of these the first that was logged is
# read: what motion capture sent, before what the filter made of it.
MEASURED: tuple[tuple[tuple[str, ...], tuple[float, ...], dict[str, str]], ...] = (
    (XYZ, TURNED, {"vehicle_visual_odometry": "position[{}]", "vehicle_local_position": "{xyz}"}),
    (
        ("qw", "qx", "qy", "qz"), (1.0, *TURNED),
        {"vehicle_visual_odometry": "q[{}]", "vehicle_attitude": "q[{}]"},
    ),
    (("gx", "gy", "gz"), TURNED, {"sensor_combined": "gyro_rad[{}]"}),
    (("ax", "ay", "az"), TURNED, {"sensor_combined": "accelerometer_m_s2[{}]"}),
)  # fmt: skip
COMMANDED, BATTERY, LANDED = "actuator_motors", "battery_status", "vehicle_land_detected"
MOST_ROTORS = 12  # of actuator_motors
MOST_PAST_END = 100  # reads beyond the last byte; a log cut off with the power takes one


def parse_ulog(content: Content, field: str = "log") -> tuple[dict[str, Any], int, bool]:
    """Return the columns of a ULog in the air, NaN where nothing was measured, the number of rotors, and true.

    A row is a time at which any topic was sampled; a command, a fraction, holds until the next. Raises InputError if a
    topic is missing or the file is no ULog.
    """
    topics = _topics(content, field)
    columns = [_read_first(topics, field, *measured) for measured in MEASURED]
    commands = _commands(topics, field)
    columns.append(commands)
    if BATTERY in topics:
        columns.append(_read_first(topics, field, ("vbat",), (1.0,), {BATTERY: "voltage_v"}))
    return merge(columns, 1e-6, *_in_air(topics, field)), len(commands[1]), True


def _topics(content: Content, field: str) -> dict[str, dict[str, Any]]:
    """Return the first instance of each topic: arrays by field."""
    errors.require("pyulog", extra="logs", for_=field)
    from pyulog import ULog

    wanted = dict.fromkeys(topic for _, _, sources in MEASURED for topic in sources)
    try:
        with redirect_stdout(io.StringIO()):  # it prints what it finds wrong
            read = ULog(_Stream(content), [*wanted, COMMANDED, BATTERY, LANDED])
    except Exception as error:
        raise InputError(field, "a ULog file", f"{type(error).__name__} in pyulog") from None
    topics = {one.name: one.data for one in read.data_list if one.multi_id == 0}
    topics.get(COMMANDED, {}).pop("timestamp_sample", None)  # a command acts from when it is published
    return topics


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
    topics: dict[str, dict[str, Any]], field: str, names: Sequence[str], factors: Sequence[float],
    sources: dict[str, str],
) -> Columns:  # fmt: skip
    """Return times, µs, and columns `names` of the first of `sources`, fields by topic, that has any number."""
    for topic, pattern in sources.items():
        data = topics.get(topic, {})
        fields = [pattern.format(i, xyz="xyz"[i % 3]) for i in range(len(names))]
        if all(name in data for name in (*fields, "timestamp")) and any(np.isfinite(data[f]).any() for f in fields):
            # When it was measured, where that is told; when it was published otherwise.
            sampled = data.get("timestamp_sample", np.zeros(1))
            stamps, first = np.unique(sampled if np.all(sampled > 0) else data["timestamp"], return_index=True)
            with np.errstate(invalid="ignore"):  # damaged bits may be a signalling NaN
                values = [factor * data[name][first] for name, factor in zip(fields, factors, strict=True)]
            return stamps, dict(zip(names, values, strict=True))
    raise InputError(field, f"the topic {' or '.join(sources)} with numbers", ", ".join(topics) or "none")


def _commands(topics: dict[str, dict[str, Any]], field: str) -> Columns:
    """Return times, µs, and the fractions of the rotors that are used: those of others are NaN."""
    names = [f"u{i + 1}" for i in range(MOST_ROTORS)]
    stamps, found = _read_first(topics, field, names, [1.0] * MOST_ROTORS, {COMMANDED: "control[{}]"})
    used = next((i for i, name in enumerate(names) if np.isnan(found[name]).all()), MOST_ROTORS)
    return stamps, {name: found[name] for name in names[:used]}


def _in_air(topics: dict[str, dict[str, Any]], field: str) -> tuple[float, float]:
    """Return begin and end of the longest flight, µs; all of the log where nobody told."""
    data = topics.get(LANDED, {})
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


# MCAP -----------------------------------------------------------------------------------------------------------------

POSE, IMU, ROD = "geometry_msgs/msg/PoseStamped", "sensor_msgs/msg/Imu", "geometry_msgs/msg/Vector3Stamped"
FRACTIONS, FORCES = "actuator_msgs/msg/Actuators", "std_msgs/msg/Float64MultiArray"
# What is read of a message, by its type: fields by our columns.
FIELDS = {
    POSE: {axis: f"pose.position.{axis}" for axis in XYZ} | {f"q{axis}": f"pose.orientation.{axis}" for axis in "wxyz"},
    IMU: {
        **{f"g{axis}": f"angular_velocity.{axis}" for axis in XYZ},
        **{f"a{axis}": f"linear_acceleration.{axis}" for axis in XYZ},
    },
    ROD: {f"r{axis}": f"vector.{axis}" for axis in XYZ},
}
COMMANDS = {FRACTIONS: "normalized", FORCES: "data"}


def parse_bag(content: Content, field: str = "log") -> tuple[dict[str, Any], int, bool]:
    """Return the columns of a bag, NaN where nothing was read, the number of rotors, and whether they got fractions.

    A row is a time of any message: when it was stamped or, without a stamp, recorded. Raises InputError if there is not
    one topic of each type, except that of the rod, or the file is no bag.
    """
    read = _messages(content, field)
    columns: list[Columns] = []
    commands = None
    for kinds in ((POSE,), (IMU,), (ROD,), (FRACTIONS, FORCES)):
        topics = {topic: kind for topic, kind in read if kind in kinds}
        if len(topics) != 1 and (topics or kinds != (ROD,)):
            found = ", ".join(sorted(topics)) or "none"
            raise InputError(field, f"one topic of {' or '.join(kinds)}", found)
        for topic, kind in topics.items():
            stamps, messages = zip(*read[topic, kind], strict=True)
            if kind in FIELDS:
                named = {name: list(map(attrgetter(path), messages)) for name, path in FIELDS[kind].items()}
            else:
                sent = [list(getattr(one, COMMANDS[kind])) for one in messages]
                if len({len(row) for row in sent}) > 1:
                    raise InputError(f"{field}, topic {topic}", "as many commands in every message", "others")
                named = {f"u{i + 1}": list(values) for i, values in enumerate(zip(*sent, strict=True))}
                commands = len(named), kind == FRACTIONS
            # Of messages with one stamp the first counts.
            times, first = np.unique(np.array(stamps, dtype=float), return_index=True)
            columns.append((times, {name: np.array(values, dtype=float)[first] for name, values in named.items()}))
    assert commands is not None
    return merge(columns, 1e-9), *commands


def _messages(content: Content, field: str) -> dict[tuple[str, str], list[tuple[int, Any]]]:
    """Return time, ns, and content of the messages of types that are read, by topic and type."""
    errors.require("mcap_ros2", extra="logs", for_=field)
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory

    found: dict[tuple[str, str], list[tuple[int, Any]]] = defaultdict(list)
    try:
        reader = make_reader(io.BytesIO(content), decoder_factories=[DecoderFactory()])
        channels = getattr(reader.get_summary(), "channels", {}).values()
        schemas = getattr(reader.get_summary(), "schemas", {})
        read = {*FIELDS, *COMMANDS}
        topics = [one.topic for one in channels if one.schema_id and schemas[one.schema_id].name in read]
        for schema, channel, message, decoded in reader.iter_decoded_messages(topics=topics or [""]):
            assert schema is not None
            stamp = getattr(getattr(decoded, "header", None), "stamp", None)
            stamped = 0 if stamp is None else stamp.sec * 10**9 + stamp.nanosec
            found[channel.topic, schema.name].append((stamped or message.log_time, decoded))
    except Exception as error:
        wanted = "a finished bag of ROS 2 (ros2 bag reindex mends one that was cut off)"
        raise InputError(field, wanted, f"{type(error).__name__} in mcap") from None
    return found


# µSD ------------------------------------------------------------------------------------------------------------------

SAMPLED = "fixedFrequency"  # the events that are written at a fixed rate, not when something happens
TYPES = "BbHhIife"
CHECKSUM = 4  # bytes


def parse_usd(content: Content, field: str = "log") -> dict[str, Any]:
    """Return the variables (k,) that were sampled at a fixed rate, by name, with "timestamp" in ms.

    Raises InputError for a checksum that does not fit, as after power off while logging, and for any other content.
    """
    if content[-CHECKSUM:] != crc32(content[:-CHECKSUM]).to_bytes(CHECKSUM, "little"):
        raise InputError(field, "a whole µSD log, stopped before power off", "a checksum that does not fit")
    try:
        return _read_events(content, *_kinds(content), field)
    except (struct.error, ValueError, IndexError, KeyError) as error:
        raise InputError(field, "a µSD log of the Crazyflie", f"{type(error).__name__}: {error}") from None


def _kinds(content: Content) -> tuple[dict[int, tuple[str, list[str], struct.Struct]], int]:
    """Return name, variables and layout of each kind of event by its id, and where the events begin."""
    (count,), at = struct.unpack_from("<H", content, len(USD)), len(USD) + 2
    kinds = {}
    for _ in range(count):
        (number,) = struct.unpack_from("<H", content, at)
        name, at = _text(content, at + 2)
        (width,), at = struct.unpack_from("<H", content, at), at + 2
        variables, layout = [], "<"
        for _ in range(width):
            variable, at = _text(content, at)
            variables.append(variable[:-3])
            layout += errors.one_of("type", variable[-2], TYPES)
        kinds[number] = name, variables, struct.Struct(layout)
    return kinds, at


def _text(content: Content, at: int) -> tuple[str, int]:
    end = content.index(0, at)
    return content[at:end].decode("ascii"), end + 1


def _read_events(content: Content, kinds: dict[int, Any], at: int, field: str) -> dict[str, Any]:
    """Return the columns of the sampled events in `content`, from the byte `at` on. Raises InputError."""
    rows: list[tuple[float, ...]] = []
    names: list[str] = []
    while at < len(content) - CHECKSUM:
        number, us = struct.unpack_from("<HQ", content, at)
        name, variables, layout = kinds[number]
        values, at = layout.unpack_from(content, at + 10), at + 10 + layout.size
        if name == SAMPLED:
            names = variables
            rows.append((us / 1e3, *values))
    if not rows:
        raise InputError(field, f"events of the kind {SAMPLED!r}", "none")
    values = np.array(rows, dtype=float)
    values[~np.isfinite(values)] = np.nan  # no number was measured
    return dict(zip(["timestamp", *names], values.T, strict=True))
