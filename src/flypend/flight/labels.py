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
    import pandas
    import xarray

UNITS = {
    "t": "s", "x": "m", "x_dot": "m/s", "R": "1", "omega": "rad/s", "y": "1", "y_dot": "1/s", "thrust": "N",
    "moment": "N m", "rotor_forces": "N", "x_ref": "m", "settling": "s", "excursion": "m", "peak_force": "N",
    "end": "s", "clearance": "m", "lowest": "m", "box_x": "m", "box_y": "m", "box_z": "m",
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


def describe(vehicle: Vehicle, law: str, gains: Mapping[str, Any], e3: E3Direction) -> dict[str, Any]:
    """Return attributes that specify vehicle, law, gains and frame."""
    return {
        "e3": e3,
        "law": law,
        "gains": json.dumps(dict(gains)),
        "vehicle": json.dumps(vehicle.to_dict()),
        "frame": f"world with third axis {e3}; omega and moment in the body frame",
    }


def column_names(name: str, shape: tuple[int, ...]) -> list[str]:
    """Return the names of the components of a quantity of this `shape`: thrust; x_1, x_2, x_3; R_11, R_12, …, R_33."""
    stem = {"rotor_forces": "rotor_force"}.get(name, name)
    return [f"{stem}_{''.join(str(i + 1) for i in place)}" if place else stem for place in np.ndindex(shape)]


def dataframe(
    variables: Mapping[str, Variable], attributes: Mapping[str, Any], index: str, *, units: bool
) -> pandas.DataFrame:
    """Return `variables`, all over the dimension `index`, as a table with a row per entry of it.

    A component is a column. `attrs` holds `attributes` and, as "units", the unit of each column and of the index; with
    `units` the headers carry it as well. Raises InputError if pandas is missing, or two columns have one name.
    """
    errors.require("pandas", extra="studies", for_="to_dataframe")
    import pandas

    columns: dict[str, Any] = {}
    unit: dict[str, str] = {}
    for name, entry in variables.items():
        values = np.asarray(entry.values)
        names = column_names(name, values.shape[1:])
        if taken := columns.keys() & set(names):
            raise errors.InputError("signals", "names that no column has", min(taken))
        columns |= dict(zip(names, values.reshape(len(values), len(names)).T, strict=True))
        unit |= dict.fromkeys(names, entry.attributes["units"])
    heads = {name: f"{name} [{unit[name]}]" if units and unit[name] else name for name in columns}
    found = pandas.DataFrame(columns).rename(columns=heads).set_index(heads[index])
    found.attrs = {**attributes, "units": {heads[name]: unit[name] for name in columns}}
    return found


def dataset(variables: Mapping[str, Variable], attributes: Mapping[str, Any]) -> xarray.Dataset:
    """Return the `variables` and their axis labels as an `xarray.Dataset`."""
    errors.require("xarray", extra="studies", for_="to_xarray")
    import xarray

    used = {dim for entry in variables.values() for dim in entry.dims}
    labels = {name: Variable((name,), np.array(values)) for name, values in AXES.items() if name in used}
    coordinates = [*labels, *(name for name in variables if name in used)]
    return xarray.Dataset({**variables, **labels}, attrs=dict(attributes)).set_coords(coordinates)
