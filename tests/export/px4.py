"""Stand-ins for PX4 around its exported module: headers made from the messages' definitions, and a world in Python."""

import ctypes
import re

import numpy as np
from cbuild import STANDINS, build
from scipy.spatial.transform import Rotation

KINDS = {
    "float64": ("double", "d"), "float32": ("float", "f"), "uint64": ("uint64_t", "Q"), "uint32": ("uint32_t", "I"),
    "uint16": ("uint16_t", "H"), "uint8": ("uint8_t", "B"), "int8": ("int8_t", "b"), "bool": ("bool", "B"),
    "char": ("char", "B"),
}  # fmt: skip
CPP = "-std=c++17"  # as PX4 compiles; -Wextra and more as cbuild has them


def headers(folder):
    """Write the headers that flypend.hpp includes into `folder`/px4, and return that place."""
    place = folder / "px4"
    topics, fields, lines = [], [], ['#pragma once\n#include "platform.hpp"']
    for section in (STANDINS / "px4" / "messages.txt").read_text().split("\n[")[1:]:
        names, _, body = section.partition("]")
        topic, *kind = names.split()
        struct = f"{(kind or [topic])[0]}_s"
        topics.append(topic)
        lines.append(f"struct {struct} {{")
        for row in body.strip().splitlines():
            if row.startswith("#"):
                continue
            (kind_of, count, name, value) = re.fullmatch(r"(\w+?)(?:\[(\d+)\])? (\w+)(?: = (\d+))?", row).groups()
            cpp, code = KINDS[kind_of]
            if value:
                lines.append(f"    static constexpr {cpp} {name} = {value};")
                continue
            lines.append(f"    {cpp} {name}{f'[{count}]' if count else ''};")
            fields.append(f'{{"{topic}", "{name}", \'{code}\', offsetof({struct}, {name}), {count or 1}}},')
        lines += ["};", f"namespace standin {{ inline {struct} data_{topic};"]
        lines.append(f'inline topic orb_{topic} = {{"{topic}", &data_{topic}, sizeof data_{topic}, 0}}; }}')
    lines.append("namespace standin { static const field fields[] = {" + "\n".join(fields) + "};")
    lines.append("static topic *const topics[] = {" + ", ".join(f"&orb_{name}" for name in topics) + "}; }")
    names = re.findall(r"^        (FPD_\w+):$", (folder / "module.yaml").read_text(), re.M)
    named = "".join(f'inline constexpr const char *{name} = "{name}"; ' for name in names)
    lines.append(f"namespace px4 {{ namespace params {{ {named} }} }}")
    for header in re.findall(r"#include <(.*/.*)>", (folder / "flypend.hpp").read_text()):
        path = place / header
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text('#pragma once\n#include "everything.hpp"\n')
    (place / "everything.hpp").write_text("\n".join(lines) + "\n")
    return place


def library(folder, tail=()):
    """The module of `folder` among stand-ins, as a shared library."""
    place = headers(folder)
    for name in ("flypend_law", "flypend_frames"):
        build(folder, (f"{name}.c",), f"{name}.o", flags=("-c", "-fPIC", "-I."))
    flags = (CPP, "-Wno-float-equal", "-Wno-unused-parameter", "-shared", "-fPIC", "-I.", f"-I{place}", f"-I{STANDINS / 'px4'}", *tail)  # fmt: skip  # noqa: E501
    sources = ("flypend_law.o", "flypend_frames.o", "flypend.cpp", STANDINS / "px4" / "fly.cpp")
    return build(folder, sources, "module.so", "g++", flags)


class World:
    """PX4 around the module: what it would publish for `vehicle` in a state, and what the commander answers."""

    MODE, CHECK, OTHER = 23, 4, 2

    def __init__(self, path, vehicle, numbers, order):
        self.c, self.vehicle, self.step_us, self.now = ctypes.CDLL(str(path)), vehicle, 2500, 1_000_000
        self.c.standin_get.restype = ctypes.c_double
        self.c.standin_lives.restype = ctypes.c_bool
        self.c.standin_reset()
        self.silent, self.changed, self.nav, self.armed, self.mode = set(), {}, self.OTHER, 2, None
        for name, value in (numbers | self._geometry(order)).items():
            self.parameter(name, value)
        assert self.c.standin_start() == 0

    def _geometry(self, order):
        """CA_ROTOR of an airframe whose motor `order[i]` is rotor i; y to the right, KM > 0 counter-clockwise."""
        found = {"CA_ROTOR_COUNT": len(order), "IMU_GYRO_RATEMAX": 400}
        for i, motor in enumerate(order):
            x, y, _ = self.vehicle.rotor_positions[i]
            row = {"PX": 3 * x, "PY": -3 * y, "KM": -0.05 * np.sign(self.vehicle.rotor_spins[i])}  # ratios count
            found |= {f"CA_ROTOR{motor}_{field}": value for field, value in row.items()}
        return found

    def parameter(self, name, value):
        self.c.standin_parameter(name.encode(), ctypes.c_double(value))

    def get(self, topic, field, i=0):
        found = self.c.standin_get(topic.encode(), field.encode(), i)
        assert found != -12345, (topic, field)
        return found

    def count(self, topic):
        return self.c.standin_count(topic.encode())

    def put(self, topic, **fields):
        for name, values in fields.items():
            values = values.encode() if isinstance(values, str) else np.atleast_1d(values)
            for i, value in enumerate(values):
                assert self.c.standin_put(topic.encode(), name.encode(), i, ctypes.c_double(value)), (topic, name)
        self.c.standin_publish(topic.encode())

    def see(self, state, felt=(0, 0, 9.81)):
        """Publish what PX4 measures and estimates in `state`, and the bob; `felt` is the specific force, body, m/s²."""
        ned, time = state.flipped(), {"timestamp": self.now, "timestamp_sample": self.now}
        x, y, z, w = Rotation.from_matrix(ned.R).as_quat()
        place, velocity = dict(zip("xyz", ned.x, strict=True)), dict(zip(("vx", "vy", "vz"), ned.x_dot, strict=True))
        valid = dict.fromkeys(("xy_valid", "z_valid", "v_xy_valid", "v_z_valid"), 1) | {"dead_reckoning": 0}
        bob = self.vehicle.l * np.array(ned.y)
        rows = {
            "vehicle_acceleration": time | {"xyz": np.array(felt) * [1, -1, -1]},
            "vehicle_attitude": time | {"q": (w, x, y, z)},
            "vehicle_local_position": time | place | velocity | valid,
            "debug_array": {"timestamp": self.now, "name": "bob\0", "data": bob},
            "vehicle_status": {"nav_state": self.nav, "arming_state": self.armed, "system_id": 1, "component_id": 1},
            "arming_check_request": {"request_id": 77},
            "vehicle_angular_velocity": time | {"xyz": ned.omega},
        }
        for topic, fields in rows.items():
            if topic not in self.silent:
                self.put(topic, **(fields | self.changed.get(topic, {})))

    def commander(self):
        """Answer a registration."""
        if self.count("register_ext_component_request") and self.mode is None:
            number = self.get("register_ext_component_request", "request_id")
            self.put(
                "register_ext_component_reply",
                request_id=number,
                success=1,
                arming_check_id=self.CHECK,
                mode_id=self.MODE,
            )
            self.mode = self.MODE

    def fly(self, state, steps=1, felt=(0, 0, 9.81)):
        """So many periods in the same `state`; what the motors are told then, NaN for those that nobody told."""
        for _ in range(steps):
            self.now += self.step_us
            self.see(state, felt)
            self.c.standin_run(ctypes.c_uint64(self.now))
            self.commander()
        return self.motors()

    def motors(self):
        return np.array([self.get("actuator_motors", "control", i) for i in range(12)])

    def can_run(self):
        return bool(self.get("arming_check_reply", "can_arm_and_run"))

    def obstacle(self):
        return round(self.get("debug_key_value", "value"))
