"""Bags of ROS 2 in MCAP, read by mcap-ros2-support, in the columns and units of a log of ours.

ROS has our frames (REP 103: world with e₃ up, body front-left-up), and its messages our units.
"""

from __future__ import annotations

import io
from collections import defaultdict
from typing import Any

import numpy as np

from flypend import errors
from flypend.errors import InputError
from flypend.identification.ulog import merged

MAGIC = b"\x89MCAP0\r\n"
POSE, IMU, ROD = "geometry_msgs/msg/PoseStamped", "sensor_msgs/msg/Imu", "geometry_msgs/msg/Vector3Stamped"
FRACTIONS, FORCES = "actuator_msgs/msg/Actuators", "std_msgs/msg/Float64MultiArray"
# What is read of a message, by its type: paths of fields, by our columns.
XYZ = "xyz"
FIELDS: dict[str, dict[str, tuple[str, ...]]] = {
    POSE: {
        **{axis: ("pose", "position", axis) for axis in XYZ},
        **{f"q{axis}": ("pose", "orientation", axis) for axis in "wxyz"},
    },
    IMU: {
        **{f"g{axis}": ("angular_velocity", axis) for axis in XYZ},
        **{f"a{axis}": ("linear_acceleration", axis) for axis in XYZ},
    },
    ROD: {f"r{axis}": ("vector", axis) for axis in XYZ},
}
COMMANDS = {FRACTIONS: "normalized", FORCES: "data"}


def is_mcap(content: bytes | bytearray) -> bool:
    """Whether a file with this `content` is MCAP."""
    return content.startswith(MAGIC)


def parse_bag(content: bytes | bytearray, field: str = "log") -> tuple[dict[str, Any], int, bool]:
    """Return the columns of a bag, NaN where nothing was read, the number of rotors, and whether they got fractions.

    A row is a time of any message: when it was stamped or, without a stamp, recorded. Raises InputError if there is not
    one topic of each type, except that of the rod, or the file is no bag.
    """
    read = _messages(content, field)
    columns: list[tuple[Any, dict[str, Any]]] = []
    commands = None
    for kinds in ((POSE,), (IMU,), (ROD,), (FRACTIONS, FORCES)):
        topics = {topic: kind for topic, kind in read if kind in kinds}
        if len(topics) != 1 and (topics or kinds != (ROD,)):
            found = ", ".join(sorted(topics)) or "none"
            raise InputError(field, f"one topic of {' or '.join(kinds)}", found)
        for topic, kind in topics.items():
            stamps, messages = zip(*read[topic, kind], strict=True)
            named: dict[str, Any]
            if kind in FIELDS:
                named = {name: [_at(one, path) for one in messages] for name, path in FIELDS[kind].items()}
            else:
                sent = [list(getattr(one, COMMANDS[kind])) for one in messages]
                if len({len(row) for row in sent}) > 1:
                    raise InputError(f"{field}, topic {topic}", "as many commands in every message", "others")
                named = {f"u{i + 1}": values for i, values in enumerate(zip(*sent, strict=True))}
                commands = len(named), kind == FRACTIONS
            # Of messages with one stamp the first counts.
            times, first = np.unique(np.array(stamps, dtype=float), return_index=True)
            columns.append((times, {name: np.array(values, dtype=float)[first] for name, values in named.items()}))
    assert commands is not None
    return merged(columns, 1e-9), *commands


def _messages(content: bytes | bytearray, field: str) -> dict[tuple[str, str], list[tuple[int, Any]]]:
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


def _at(message: Any, path: tuple[str, ...]) -> Any:
    for name in path:
        message = getattr(message, name)
    return message
