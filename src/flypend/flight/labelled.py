"""Results as labelled arrays, with the same names, dimensions and units for every kind of result."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from flypend import errors
from flypend.files.netcdf import Variable
from flypend.model import State, Vehicle
from flypend.model.state import SHAPES, E3Direction

if TYPE_CHECKING:
    import xarray

UNITS = {
    "t": "s", "x": "m", "x_dot": "m/s", "R": "1", "omega": "rad/s", "y": "1", "y_dot": "1/s", "thrust": "N",
    "moment": "N m", "rotor_forces": "N", "x_ref": "m", "settling": "s", "excursion": "m", "peak_force": "N",
    "end": "s", "clearance": "m",
}  # fmt: skip
# Axes of the world and of the body.
AXES = {"axis": ("1", "2", "3"), "body_axis": ("1", "2", "3")}
DIMENSIONS: Mapping[str, tuple[str, ...]] = {
    "x": ("axis",), "x_dot": ("axis",), "R": ("axis", "body_axis"), "omega": ("body_axis",), "y": ("axis",),
    "y_dot": ("axis",), "moment": ("body_axis",), "rotor_forces": ("rotor",), "x_ref": ("axis",),
}  # fmt: skip


def variable(name: str, over: tuple[str, ...], values: Any) -> Variable:
    """Return the array `values` of the quantity `name`, on the dimensions `over` followed by its own."""
    return Variable((*over, *DIMENSIONS.get(name, ())), np.array(values), {"units": UNITS.get(name, "")})


def state_variables(states: State, over: tuple[str, ...], prefix: str = "") -> dict[str, Variable]:
    """Return the fields of a batch of `states` on the batch dimensions `over`, their names prefixed by `prefix`."""
    return {prefix + name: variable(name, over, getattr(states, name)) for name in SHAPES}


def described(vehicle: Vehicle, law: str, gains: Mapping[str, Any], e3: E3Direction) -> dict[str, Any]:
    """Return attributes that specify vehicle, law, gains and frame."""
    return {
        "e3": e3,
        "law": law,
        "gains": json.dumps(dict(gains)),
        "vehicle": json.dumps(vehicle.to_dict()),
        "frame": f"world with third axis {e3}; omega and moment in the body frame",
    }


def dataset(variables: Mapping[str, Variable], attributes: Mapping[str, Any]) -> xarray.Dataset:
    """Return the `variables` and their axis labels as an `xarray.Dataset`."""
    errors.require("xarray", extra="studies", for_="to_xarray")
    import xarray

    used = {dim for entry in variables.values() for dim in entry.dims}
    labels = {name: Variable((name,), np.array(values)) for name, values in AXES.items() if name in used}
    coordinates = [*labels, *(name for name in variables if name in used)]
    return xarray.Dataset({**variables, **labels}, attrs=dict(attributes)).set_coords(coordinates)
