"""A run as a table of pandas: a row per sample, a column per component, each with its unit."""

import dataclasses
import sys

import numpy as np
import pandas as pd
import pytest

import flypend as fp
from flypend.flight.labels import UNITS

VEHICLE = fp.vehicle("hehn2011")


@pytest.fixture(scope="module")
def run():
    return fp.simulate(VEHICLE, fp.laws.almost_global(), fp.State(y=(0.6, 0, -0.8)), 0.5)


def test_a_row_is_a_sample_and_a_column_a_component(run):
    frame = run.to_dataframe()
    assert len(frame) == len(run.t)
    np.testing.assert_array_equal(frame.index, run.t)
    assert frame.index.name == "t"
    np.testing.assert_array_equal(frame[["x_1", "x_2", "x_3"]], run.x)
    np.testing.assert_array_equal(frame[["omega_1", "omega_2", "omega_3"]], run.omega)
    np.testing.assert_array_equal(frame.thrust, run.thrust)
    forces = frame.filter(like="rotor_force_")
    assert list(forces) == [f"rotor_force_{k}" for k in (1, 2, 3, 4)]
    np.testing.assert_array_equal(forces, run.rotor_forces)
    for i in range(3):
        for k in range(3):
            np.testing.assert_array_equal(frame[f"R_{i + 1}{k + 1}"], run.R[:, i, k])  # row, column
    assert np.ptp(run.R[:, 0, 2] - run.R[:, 2, 0]) > 0.01  # a transpose would be seen
    np.testing.assert_array_equal(frame.V, run.signals["V"])
    assert {kind.name for kind in frame.dtypes} == {"float64"}


def test_every_array_of_the_labelled_run_is_there(run):
    data, frame = run.to_xarray(), run.to_dataframe()
    components = sum(values.size // len(run.t) for values in data.data_vars.values())
    assert frame.shape == (len(run.t), components)


def test_units_are_attributes_and_on_request_in_the_names(run):
    frame = run.to_dataframe()
    assert set(frame.attrs["units"]) == {"t", *frame}
    assert frame.attrs["units"]["y_dot_3"] == UNITS["y_dot"] == "1/s"
    assert frame.attrs["units"]["moment_2"] == "N m"
    assert frame.attrs["outcome"] == "completed"
    assert frame.attrs["law"] == "almost_global"
    named = run.to_dataframe(units=True)
    np.testing.assert_array_equal(named, frame)
    assert named.index.name == "t [s]"
    assert list(named)[:3] == ["x_1 [m]", "x_2 [m]", "x_3 [m]"]
    assert "R_12 [1]" in named
    assert "V" in named  # no unit of it is known
    assert set(named.attrs["units"]) == {"t [s]", *named}


def test_it_comes_back_from_a_file(run, tmp_path):
    run.to_dataframe(units=True).to_csv(tmp_path / "run.csv")
    back = pd.read_csv(tmp_path / "run.csv", index_col="t [s]")
    np.testing.assert_array_equal(back["x_1 [m]"], run.x[:, 0])
    run.save(tmp_path / "run.nc")
    pd.testing.assert_frame_equal(fp.load(tmp_path / "run.nc").to_dataframe(), run.to_dataframe())


def test_a_signal_that_is_called_like_a_column_is_refused(run):
    with pytest.raises(fp.InputError, match=r"^signals: .*x_1"):
        dataclasses.replace(run, signals={"x_1": run.t}).to_dataframe()


def test_without_pandas_the_extra_is_named(run, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(fp.InputError, match=r"^to_dataframe: expected the extra studies"):
        run.to_dataframe()
