"""Starts, gains and plants of the runs of a study: run i depends on the study and on i only."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np

from flypend.geometry import rotation_from_quat_xyzw
from flypend.model.state import FLIP, SHAPES
from flypend.studies.sweep import cube
from flypend.studies.sweep.axes import ANGLES
from flypend.studies.sweep.study import Study


@dataclass(frozen=True, eq=False)
class Design:
    """The starts, gains and grid cells of a range of n runs."""

    packed: Any  # (n, 24), starts in the frame of the law
    gains: dict[str, Any]  # those that vary, name → (n,)
    cells: Any  # (n,), index of the cell of the grid
    columns: dict[str, Any]  # the varied quantities as stored, name → (n,) or (n, k)


def design(study: Study, first: int, last: int, stream: int = cube.REPORTED) -> Design:
    """Return runs `first` to `last` (exclusive) of `study`, from its sample `stream`."""
    index = np.arange(first, last)
    cells, drawn = index // study.samples, _draw(study, index % study.samples, stream)
    numbers: dict[tuple[str, str], Any] = {}
    places = dict(zip(study.grid, np.unravel_index(cells, study.shape) if study.grid else (), strict=True))
    column = 0
    for axis in study.axes:
        if axis.values:
            numbers[axis.group, axis.name] = np.array(axis.values)[places[axis]]
        else:
            u = drawn[:, column : column + axis.dimensions]
            numbers[axis.group, axis.name] = u if axis.dimensions > 1 else axis.at(u[:, 0])
            column += axis.dimensions
    fields, columns = _starts(study, numbers, len(index))
    for (group, name), value in numbers.items():
        if group != "start":
            columns[f"{group}.{name}"] = value
    gains = {name: value for (group, name), value in numbers.items() if group == "gains"}
    runs, fixed = len(index), study.flight.starts
    parts = [
        np.broadcast_to(fields.get(name, getattr(fixed, name)), (runs, *shape)).reshape(runs, prod(shape))
        for name, shape in SHAPES.items()
    ]
    return Design(np.concatenate(parts, axis=1), gains, cells, columns)


def _draw(study: Study, members: Any, stream: int) -> Any:
    """The points of these members in the unit cube; members are consecutive within a cell."""
    how = (study.sampling, study.seed, stream, study.samples, study.dimensions)
    ends = np.flatnonzero(np.diff(members) < 0) + 1
    if len(ends) > 1:  # whole cells
        return cube.members(*how, 0, study.samples)[members]
    pieces = np.split(members, ends)
    return np.concatenate([cube.members(*how, int(piece[0]), int(piece[-1]) + 1) for piece in pieces])


def _starts(study: Study, numbers: dict[tuple[str, str], Any], runs: int) -> tuple[dict[str, Any], dict[str, Any]]:
    """The varied fields of the starts, in the frame of the law, and the columns to store (fields and angles)."""
    given = {axis.name: (axis, numbers["start", axis.name]) for axis in study.axes if axis.group == "start"}
    fields: dict[str, Any] = {}
    columns: dict[str, Any] = {}
    for name in ("x", "x_dot", "omega"):
        if name in given:
            axis, u = given[name]
            fields[name] = columns[name] = cube.in_ball(u, axis.high)
    if "R" in given:
        columns["quat_xyzw"] = cube.as_quat_xyzw(given["R"][1])
        fields["R"] = rotation_from_quat_xyzw(columns["quat_xyzw"])
    if "y" in given:
        fields["y"] = cube.on_sphere(given["y"][1])
    if angles := {name: given[name][1] for name in ANGLES if name in given}:
        flip = FLIP if study.law.e3 == "down" else np.eye(3)
        own = flip @ study.flight.starts.y
        default = {"tilt": np.arctan2(np.hypot(own[0], own[1]), own[2]), "azimuth": np.arctan2(own[1], own[0])}
        y, y_dot = cube.tilt_rods(*(angles.get(name, np.full(runs, default.get(name, 0.0))) for name in ANGLES))
        columns |= angles
        fields["y"] = y @ flip
        if {"rate", "heading"} & angles.keys():
            fields["y_dot"] = y_dot @ flip
    if "y_dot" in given:
        y = fields.get("y", np.broadcast_to(study.flight.starts.y, (runs, 3)))
        axis, u = given["y_dot"]
        fields["y_dot"] = cube.in_disc(u, y, axis.high)
    columns |= {name: fields[name] for name in ("y", "y_dot") if name in fields}
    return fields, columns
