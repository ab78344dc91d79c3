"""A run as an MCAP file, for Foxglove, PlotJuggler and ROS 2's tools: JSON messages, with Foxglove's schemas."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from flypend import errors, palette
from flypend.files.netcdf import Variable
from flypend.files.whole import whole_file
from flypend.geometry import quat_xyzw_from_rotation
from flypend.model.mjcf import drawn_thickness

FRAMES, XYZ, XYZW = ("parent_frame_id", "child_frame_id"), ("x", "y", "z"), ("x", "y", "z", "w")
# By its name Foxglove knows what a message means, by the schema what it holds: it refuses a field without a type, and
# arrays of arrays.
TRANSFORM, SCENE, SAMPLE = "foxglove.FrameTransform", "foxglove.SceneUpdate", "flypend.Sample"


def write_mcap(path: str | Path, run: Any, variables: Mapping[str, Variable], attributes: Mapping[str, Any]) -> None:
    """Write a `run`, a Trajectory with e₃ up, to `path`; see `Trajectory.to_mcap`."""
    errors.require("mcap", extra="logs", for_="run.to_mcap")
    from mcap.writer import Writer

    stamps = np.rint(np.asarray(run.t) * 1e9).astype(np.int64).tolist()
    turns = {"vehicle": quat_xyzw_from_rotation(run.R), "rod": _rod_turns(run.y)}

    def transform(i: int, frame: str) -> dict[str, Any]:
        place = {"translation": _by_name(XYZ, run.x[i]), "rotation": _by_name(XYZW, turns[frame][i])}
        return {"timestamp": _time(stamps[i])} | dict(zip(FRAMES, ("world", frame), strict=True)) | place

    def sample(i: int) -> dict[str, Any]:
        return {name: _plain(entry.values[i]) for name, entry in variables.items()}

    scene = {"deletions": [], "entities": _entities(run, _time(stamps[0]))}
    schemas = {"/tf": _schema(transform(0, "rod")), "/machine": _schema(scene), "/run": _schema(sample(0))}
    for name, entry in variables.items():
        schemas["/run"]["properties"][name]["description"] = entry.attributes["units"]
    topics = {"/tf": TRANSFORM, "/machine": SCENE, "/run": SAMPLE}
    with whole_file(path, (".mcap",)) as partial, partial.open("wb") as stream:
        writer = Writer(stream)
        writer.start(library="flypend")
        channels = {}
        for topic, name in topics.items():
            schema = json.dumps({"title": name} | schemas[topic]).encode()
            number = writer.register_schema(name, "jsonschema", schema)
            channels[topic] = writer.register_channel(topic, "json", number)

        def add(topic: str, stamp: int, message: Any) -> None:
            writer.add_message(channels[topic], stamp, json.dumps(message, allow_nan=False).encode(), stamp)

        writer.add_metadata("run", {name: str(value) for name, value in attributes.items()})
        add("/machine", stamps[0], scene)
        for i, stamp in enumerate(stamps):
            for frame in turns:
                add("/tf", stamp, transform(i, frame))
            add("/run", stamp, sample(i))
        writer.finish()


def _rod_turns(y: Any) -> Any:
    """Return quaternions (n, 4), order x, y, z, w, of the shortest rotations of e₃ to `y` (n, 3); of −e₃ about e₁."""
    turns = np.stack([-y[:, 1], y[:, 0], np.zeros(len(y)), 1 + y[:, 2]], axis=-1)
    turns[np.linalg.norm(turns, axis=1) < 1e-8] = 1.0, 0.0, 0.0, 0.0  # below, the direction would be roundoff
    return turns / np.linalg.norm(turns, axis=1, keepdims=True)


def _entities(run: Any, time: dict[str, int]) -> list[dict[str, Any]]:
    """Return what is drawn in the frames of vehicle and rod: discs, the rod, and the bob."""
    vehicle, thin = run.vehicle, drawn_thickness(run.vehicle)
    discs = [_solid(place, (40 * thin, 40 * thin, 2 * thin), palette.BLUE) for place in vehicle.rotors_from_pivot]
    rod = _solid((0, 0, vehicle.reach / 2), (2 * thin, 2 * thin, vehicle.reach), palette.GREY)
    bob = _solid((0, 0, vehicle.rod_length), (8 * thin,) * 3, palette.ORANGE)
    shapes = {"vehicle": {"cylinders": discs}, "rod": {"cylinders": [rod], "spheres": [bob]}}
    common = {"timestamp": time, "frame_locked": True, "lifetime": {"sec": 0, "nsec": 0}}
    return [common | {"frame_id": frame, "id": frame} | drawn for frame, drawn in shapes.items()]


def _solid(place: Any, size: Any, colour: str) -> dict[str, Any]:
    """Return a cylinder along z, or a sphere, of a `size` and at a `place` (3,), m; `colour` is as in `palette`."""
    pose = {"position": _by_name(XYZ, place), "orientation": _by_name(XYZW, (0, 0, 0, 1))}
    shares = [part / 255 for part in (*bytes.fromhex(colour[1:]), 255)]
    shape = {"pose": pose, "size": _by_name(XYZ, size), "color": _by_name(("r", "g", "b", "a"), shares)}
    return shape | {"bottom_scale": 1.0, "top_scale": 1.0}


def _time(stamp: int) -> dict[str, int]:
    return {"sec": stamp // 10**9, "nsec": stamp % 10**9}


def _by_name(names: tuple[str, ...], values: Any) -> dict[str, float]:
    return dict(zip(names, map(float, values), strict=True))


def _plain(value: Any) -> Any:
    """Return numbers as JSON has them: None for what is undefined, a matrix as one list, row by row."""
    if np.ndim(value):
        return [_plain(part) for part in np.ravel(value)]
    return float(value) if np.isfinite(value) else None


def _schema(message: Any) -> dict[str, Any]:
    """Return the JSON schema of a `message`; of a list, that of all its items."""
    if isinstance(message, Mapping):
        return {"type": "object", "properties": {name: _schema(value) for name, value in message.items()}}
    if isinstance(message, list):
        items = [_schema(item) for item in message] or [_schema({})]
        properties = {name: kind for item in items for name, kind in item.get("properties", {}).items()}
        return {"type": "array", "items": items[0] | ({"properties": properties} if "properties" in items[0] else {})}
    kinds = ((str, "string"), (bool, "boolean"), (int, "integer"))
    return {"type": next((name for kind, name in kinds if isinstance(message, kind)), "number")}
