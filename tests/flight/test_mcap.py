"""Runs as MCAP: read back by the format's own reader, they are the runs."""

import json

import numpy as np
import pytest

import flypend as fp
from flypend.geometry import rotation_from_quat_xyzw

mcap_reader = pytest.importorskip("mcap.reader")
jsonschema = pytest.importorskip("jsonschema")


def _read(path):
    """Messages by topic with their times, ns; schemas by topic; and the metadata."""
    messages, schemas = {}, {}
    with path.open("rb") as stream:
        reader = mcap_reader.make_reader(stream, validate_crcs=True)
        for schema, channel, message in reader.iter_messages(log_time_order=False):
            assert (channel.message_encoding, schema.encoding) == ("json", "jsonschema")
            messages.setdefault(channel.topic, []).append((message.log_time, json.loads(message.data)))
            schemas[channel.topic] = schema.name, json.loads(schema.data)
        about = {entry.name: entry.metadata for entry in reader.iter_metadata()}
    return messages, schemas, about


@pytest.mark.parametrize("law", ["inverted", "repaired"])
def test_a_run_is_read_back(law, tmp_path):
    """Whichever way e₃ points: the file has it up."""
    law = getattr(fp.laws, law)()
    flown = fp.simulate(fp.vehicle("hehn2011"), law, fp.State(y=(0, 0, -1)), duration=0.5)
    run = flown if flown.e3 == "up" else flown.flipped()
    flown.to_mcap(tmp_path / "run.mcap")
    messages, schemas, about = _read(tmp_path / "run.mcap")
    times, rows = zip(*messages["/run"], strict=True)
    assert np.allclose(np.array(times) * 1e-9, run.t, rtol=0, atol=0.5e-9)  # whole nanoseconds
    for name, array in {"x": run.x, "R": run.R, "y_dot": run.y_dot, "rotor_forces": run.rotor_forces}.items():
        assert np.array_equal([row[name] for row in rows], np.reshape(array, (len(run.t), -1)))
    assert rows[0].keys() == schemas["/run"][1]["properties"].keys()
    assert set(run.signals) < rows[0].keys()
    assert schemas["/run"][1]["properties"]["x_dot"]["description"] == "m/s"
    assert about["run"]["law"] == run.law
    assert fp.Vehicle(**json.loads(about["run"]["vehicle"])) == run.vehicle
    assert len(messages["/tf"]) == 2 * len(run.t)
    for time, message in messages["/tf"]:
        i = times.index(time)
        assert message["timestamp"] == {"sec": time // 10**9, "nsec": time % 10**9}
        assert [message["translation"][axis] for axis in "xyz"] == run.x[i].tolist()
        R = rotation_from_quat_xyzw(np.array([message["rotation"][axis] for axis in "xyzw"]))
        same = (R, run.R[i]) if message["child_frame_id"] == "vehicle" else (R[:, 2], run.y[i])
        assert np.allclose(*same, rtol=0, atol=1e-7)  # beside −e₃ the shortest rotation knows 1 + y₃ to eps
    assert (schemas["/tf"][0], schemas["/machine"][0]) == ("foxglove.FrameTransform", "foxglove.SceneUpdate")
    ((_, scene),) = messages["/machine"]
    assert {entity["frame_id"]: len(entity["cylinders"]) for entity in scene["entities"]} == {"vehicle": 4, "rod": 1}


def _shows(schema):
    """Whether Foxglove's reader of JSON schemas takes this one: types of all fields, and no array of arrays."""
    if schema["type"] == "object":
        return all(map(_shows, schema["properties"].values()))
    if schema["type"] == "array":
        return schema["items"]["type"] != "array" and _shows(schema["items"])
    return schema["type"] in ("string", "boolean", "number", "integer")


def _closed(schema):
    """The same schema, in which each field must be there, and no other."""
    fields = {name: _closed(field) for name, field in schema.get("properties", {}).items()}
    items = {"items": _closed(schema["items"])} if "items" in schema else {}
    # Of what is drawn, the vehicle has no ball.
    return {**schema, **items, "properties": fields, "required": sorted(fields.keys() - {"spheres"}),
            "additionalProperties": False}  # fmt: skip


def test_messages_are_as_their_schemas_say(tmp_path):
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, 1)), duration=0.05)
    run.to_mcap(tmp_path / "run.mcap")
    messages, schemas, _ = _read(tmp_path / "run.mcap")
    assert schemas.keys() == {"/run", "/tf", "/machine"}
    for topic, (_, schema) in schemas.items():
        assert _shows(schema)
        for _, message in messages[topic]:
            jsonschema.validate(message, _closed(schema))


def test_what_is_undefined_is_null(tmp_path):
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, 1)), duration=0.05)
    run.thrust[1] = np.nan
    run.to_mcap(tmp_path / "run.mcap")
    rows = [row for _, row in _read(tmp_path / "run.mcap")[0]["/run"]]
    assert [i for i, row in enumerate(rows) if row["thrust"] is None] == [1]


def test_another_ending_or_no_extra_is_one_line(tmp_path, monkeypatch):
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, 1)), duration=0.05)
    with pytest.raises(fp.InputError, match=r"^path: expected a file name ending in \.mcap"):
        run.to_mcap(tmp_path / "run.bag")
    assert not list(tmp_path.iterdir())
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(fp.InputError, match=r"^run\.to_mcap: expected the extra logs \(.*\), got no module mcap$"):
        run.to_mcap(tmp_path / "run.mcap")
