"""Bags of ROS 2: a flight in a bag and in CSV is the same log, and whatever else a bag holds ends in one line."""

import pytest

from flypend.errors import InputError
from flypend.identification.log import parse_log, read_log
from tests.identification.test_log import table, text

LINE = "=" * 80
TIME = f"{LINE}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
HEADER = f"{LINE}\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n{TIME}"
VECTOR = f"{LINE}\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n"
QUATERNION = f"{LINE}\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"
POINT = VECTOR.replace("Vector3", "Point")
STAMPED = "std_msgs/Header header\n"
DEFINITIONS = {
    "geometry_msgs/msg/PoseStamped": f"{STAMPED}geometry_msgs/Pose pose\n{LINE}\nMSG: geometry_msgs/Pose\n"
    f"geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n{POINT}{QUATERNION}{HEADER}",
    "sensor_msgs/msg/Imu": f"{STAMPED}geometry_msgs/Quaternion orientation\n"
    "geometry_msgs/Vector3 angular_velocity\ngeometry_msgs/Vector3 linear_acceleration\n"
    f"{QUATERNION}{VECTOR}{HEADER}",
    "geometry_msgs/msg/Vector3Stamped": f"{STAMPED}geometry_msgs/Vector3 vector\n{VECTOR}{HEADER}",
    "actuator_msgs/msg/Actuators": f"{STAMPED}float64[] position\nfloat64[] velocity\nfloat64[] normalized\n{HEADER}",
    "std_msgs/msg/Float64MultiArray": "float64[] data\n",
    "std_msgs/msg/String": "string data\n",
}
TOPICS = 5  # of a flight, with a message each in every row
ONCE = 1_700_000_000  # s since 1970, where a bag begins


def xyz(at, letter, names="xyz"):
    return {name: at[letter + name] for name in names}


def flight(rows, commands="actuator_msgs/msg/Actuators"):
    """Yield time (ns), topic, type and content of the messages of a flight with these rows."""
    for row in rows[1:]:
        at = dict(zip(rows[0], map(float, row), strict=True))
        ns = round(1e9 * at["t"])
        header = {"stamp": {"sec": ONCE + ns // 10**9, "nanosec": ns % 10**9}, "frame_id": ""}
        pose = {"position": xyz(at, ""), "orientation": xyz(at, "q", "wxyz")}
        yield ns, "/pose", "geometry_msgs/msg/PoseStamped", {"header": header, "pose": pose}
        still = dict(zip("xyzw", (0.0, 0.0, 0.0, 1.0), strict=True))
        imu = {"orientation": still, "angular_velocity": xyz(at, "g"), "linear_acceleration": xyz(at, "a")}
        yield ns, "/imu", "sensor_msgs/msg/Imu", {"header": header, **imu}
        yield ns, "/rod", "geometry_msgs/msg/Vector3Stamped", {"header": header, "vector": xyz(at, "r")}
        forces = [at[f"u{i}"] for i in range(1, 5)]
        if commands.endswith("Actuators"):
            yield ns, "/motors", commands, {"header": header, "position": [], "velocity": [], "normalized": forces}
        else:
            yield ns, "/motors", commands, {"data": forces}
        yield ns, "/said", "std_msgs/msg/String", {"data": "on"}


def write_bag(path, messages):
    writer_of = pytest.importorskip("mcap_ros2.writer")
    with path.open("wb") as stream:
        writer, known = writer_of.Writer(stream), {}
        for ns, topic, kind, content in messages:
            if kind not in known:
                known[kind] = writer.register_msgdef(kind, DEFINITIONS[kind])
            stamp = ONCE * 10**9 + ns
            writer.write_message(topic, known[kind], content, log_time=stamp, publish_time=stamp)
        writer.finish()


@pytest.mark.parametrize("commands", ["actuator_msgs/msg/Actuators", "std_msgs/msg/Float64MultiArray"])
def test_a_flight_is_the_same_from_a_bag_and_from_a_table(tmp_path, commands):
    rows = table()
    write_bag(path := tmp_path / "flight.mcap", flight(rows, commands))
    found, same = read_log(path), parse_log(text(rows))
    assert found.t == pytest.approx(same.t, abs=1e-6)  # ns since 1970 in double precision
    for name in ("position", "rotation", "gyro", "force", "rod", "command"):
        assert getattr(found, name) == pytest.approx(getattr(same, name), abs=1e-12)
    assert found.fractions == commands.endswith("Actuators")


def test_a_bag_of_other_topics_ends_in_a_line(tmp_path):
    messages = list(flight(table(rows=30)))
    write_bag(path := tmp_path / "flight.mcap", [one for one in messages if one[1] != "/imu"])
    with pytest.raises(InputError, match="one topic of sensor_msgs/msg/Imu, got none"):
        read_log(path)
    again = [(ns, "/pose/wanted", kind, content) for ns, topic, kind, content in messages if topic == "/pose"]
    write_bag(path, [*messages, *again])
    with pytest.raises(InputError, match="PoseStamped, got /pose, /pose/wanted"):
        read_log(path)


@pytest.mark.parametrize("kept", [8, 100, 5000])
def test_a_bag_that_was_cut_off_ends_in_a_line(tmp_path, kept):
    write_bag(path := tmp_path / "flight.mcap", flight(table(rows=300)))
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(InputError, match=r"finished bag|one topic"):
        read_log(path)
