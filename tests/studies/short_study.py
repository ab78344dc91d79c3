"""A study that takes a second, and the files of a store that can be compared."""

import json
import math

SHORT = {
    "vehicle": "nayak2018",
    "law": {"name": "corrected"},
    "plant": "ideal",
    "duration": 1.0,
    "judge_period": 0.1,
    "runs": 100,
    "chunk": 40,
    "criterion": {"target": "e3", "position": math.inf, "rod": 1.0, "axis": 0.5},
    "vary": {"start": {"y": "uniform", "R": "uniform", "omega": {"ball": 3.0}, "y_dot": {"disc": 2.0}}},
}


def content(folder):
    """Every file of a store by name, without its random id."""
    files = {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    root = json.loads(files["zarr.json"])
    root["attributes"].pop("id")
    return files | {"zarr.json": json.dumps(root)}
