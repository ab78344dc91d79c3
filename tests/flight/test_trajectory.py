"""A run after it was flown: any time inside it, the other frame, xarray, and a file that gives back every bit."""

import dataclasses
import pickle
import re
import stat

import casadi as ca
import numpy as np
import pytest
import xarray
from scipy.io import netcdf_file

import flypend as fp
from flypend.model import equations_of_motion, total_energy
from flypend.paper import experiment


def arrays(run):
    """Names of all fields that are arrays, whatever there may come to be."""
    return [field.name for field in dataclasses.fields(run) if isinstance(getattr(run, field.name), np.ndarray)]


@pytest.fixture(scope="module")
def run():
    case = experiment("1")
    return fp.simulate(case.vehicle, case.law(), case.start, 1.0, plant="ideal")


def _ended(how):
    """A run of each outcome."""
    case = experiment("4")
    if how == "singular":
        return fp.simulate(case.vehicle, case.law("printed"), case.start, 1.0, plant="ideal")
    if how == "singular at the start":
        return fp.simulate(case.vehicle, case.law("printed", speed_floor=0), case.start, 1.0, plant="ideal")
    if how == "diverged":
        broken = fp.Law(name="broken", e3="up", control=lambda t, s, v, k: fp.Wrench(ca.sqrt(0.2 - t), ca.SX.zeros(3)))
        return fp.simulate(case.vehicle, broken, case.start, 1.0, plant="ideal")
    return fp.simulate(case.vehicle, case.law(), case.start, 0.2, plant="ideal")


ENDS = ("completed", "singular", "singular at the start", "diverged")


# Dense output ----------------------------------------------------------------------------------------------------


def test_dense_output_equals_the_samples(run):
    states = run.at(run.t)
    # `at` projects what was projected: an eps.
    np.testing.assert_allclose(states.packed(), run.states.packed(), rtol=0, atol=1e-14)
    one = run.at(run.t[37])
    assert one.batch_shape == ()
    np.testing.assert_allclose(one.packed(), run.states.packed()[37], rtol=0, atol=1e-14)


def test_dense_output_between_samples_is_as_good_as_at_the_steps(run):
    times = np.array([0.00017, 0.12345, 0.5005, 0.99999])
    case = experiment("1")
    exact = fp.simulate(case.vehicle, case.law(), case.start, 1.0, rtol=1e-13, times=times, plant="ideal")
    # Run at rtol 1e-9; the interpolant is of order seven and loses about a digit where |ẏ| is small.
    np.testing.assert_allclose(run.at(times).packed(), exact.states.packed(), rtol=0, atol=3e-7)


def test_dense_output_is_continuous_across_steps(run):
    assert np.all(np.diff(run.interpolant.knots) > 0)
    assert run.interpolant.knots[-1] == 1.0
    knots = run.interpolant.knots[1:-1]
    left, right = (run.at(knots + side).packed() for side in (-1e-13, 1e-13))
    # The projection after a step moves the state by the drift, up to 20 rtol.
    assert np.max(np.abs(left - right)) < 2e-8


@pytest.mark.parametrize("t", [-1e-9, 1.0001, [0.5, 2.0]])
def test_a_time_outside_the_run_is_refused(run, t):
    with pytest.raises(fp.InputError, match=r"^t: expected times inside 0 \.\. 1 s, got .*$"):
        run.at(t)


@pytest.mark.parametrize("t", [np.nan, "noon", None])
def test_what_is_not_a_time_is_refused(run, t):
    with pytest.raises(fp.InputError, match=r"^t: expected .*numbers.*, got .*$"):
        run.at(t)


def test_a_run_that_ended_early_ends_there():
    short = _ended("singular")
    assert short.outcome.time < 1.0
    assert short.at(short.outcome.time).batch_shape == ()
    with pytest.raises(fp.InputError, match=r"^t: expected times inside"):
        short.at(short.outcome.time + 1e-6)


# Views -----------------------------------------------------------------------------------------------------------


def test_states_and_wrench_are_those_that_acted(run):
    # A sample obeys the equations of motion: (ddty) and (xeqn_txt) by central differences of the dense output.
    h = 1e-4
    times = run.t[20:100:20]
    before, here, after = run.at(times - h), run.at(times), run.at(times + h)
    keep = slice(20, 100, 20)
    wrench = fp.Wrench(run.thrust[keep], run.moment[keep])
    rates = equations_of_motion(here, wrench, run.vehicle, run.e3).packed()
    slope = (after.packed() - before.packed()) / (2 * h)
    # h²/6 of third derivatives up to 1e4, and the run's 1e-8 over h.
    np.testing.assert_allclose(slope, rates, rtol=0, atol=2e-4)
    np.testing.assert_array_equal(run.z, run.R[:, :, 2])
    assert run.states.batch_shape == run.t.shape
    assert run.wrench.thrust is run.thrust


# The other frame -------------------------------------------------------------------------------------------------


def test_flipped_twice_is_the_same_run(run):
    again = run.flipped().flipped()
    assert again.e3 == run.e3
    for name in arrays(run):
        np.testing.assert_allclose(getattr(again, name), getattr(run, name), rtol=0, atol=1e-14)


def test_the_flipped_run_is_the_same_physics(run):
    other = run.flipped()
    assert (run.e3, other.e3) == ("down", "up")
    assert np.all(run.thrust < 0)
    np.testing.assert_array_equal(other.thrust, -run.thrust)
    here, there = (total_energy(r.states, r.vehicle, r.e3) for r in (run, other))
    np.testing.assert_allclose(there, here, rtol=1e-13)
    np.testing.assert_array_equal(other.x[:, 0], run.x[:, 0])
    np.testing.assert_array_equal(other.x[:, 1:], -run.x[:, 1:])
    assert other.outcome == run.outcome


def test_a_law_written_in_either_frame_flies_the_same_run():
    vehicle, start = fp.vehicle("nayak2018"), experiment("3").start

    def wrench(t):
        return fp.Wrench(-5 + ca.sin(t), ca.vertcat(0.01, 0.02 * ca.cos(t), 0.03))

    flip = ca.DM([1, -1, -1])
    down = fp.Law(name="down", e3="down", control=lambda t, state, v, k: wrench(t))
    up = fp.Law(name="up", e3="up", control=lambda t, s, v, k: fp.Wrench(-wrench(t).thrust, flip * wrench(t).moment))
    first = fp.simulate(vehicle, down, start, 1.5, rtol=1e-11, plant="ideal")
    second = fp.simulate(vehicle, up, start.flipped(), 1.5, rtol=1e-11, plant="ideal").flipped()
    # Signs are exact, so both runs take the same steps; what differs is the projection's last digits.
    np.testing.assert_allclose(first.states.packed(), second.states.packed(), rtol=0, atol=1e-10)
    np.testing.assert_allclose(first.thrust, second.thrust, rtol=1e-14)
    np.testing.assert_allclose(first.moment, second.moment, rtol=0, atol=1e-15)


def test_only_a_run_from_simulate_has_dense_output(run, tmp_path):
    run.save(tmp_path / "run.nc")
    for other in (fp.load(tmp_path / "run.nc"), run.flipped()):
        with pytest.raises(fp.InputError, match=r"^run\.at: expected a run of the ideal plant"):
            other.at(0.5)


# xarray ----------------------------------------------------------------------------------------------------------


def test_the_dataset_holds_everything_with_units(run):
    data = run.to_xarray()
    assert data["x"].dims == ("t", "axis")
    assert data["R"].dims == ("t", "axis", "body_axis")
    assert data["thrust"].dims == ("t",)
    units = {"t": "s", "x_dot": "m/s", "omega": "rad/s", "y_dot": "1/s", "thrust": "N", "moment": "N m"}
    assert {name: data[name].attrs["units"] for name in units} == units
    for name in arrays(run):
        if name != "drift":  # of steps, which have other times
            np.testing.assert_array_equal(data[name], getattr(run, name))
    for name, signal in run.signals.items():
        np.testing.assert_array_equal(data[name], signal)
    assert {"V", "V_rate", "velocity_error"} <= set(data)
    assert (data.attrs["e3"], data.attrs["law"], data.attrs["outcome"]) == ("down", "corrected", "completed")
    np.testing.assert_allclose(data["y"].sel(axis="3").interp(t=0.505), run.y[50:52, 2].mean(), rtol=1e-13)


def test_the_dataset_does_not_share_memory_with_the_run(run):
    data = run.to_xarray()
    data["x"][0, 0] = 99
    assert run.x[0, 0] == 1


# Files -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("how", ENDS)
def test_save_and_load_give_back_every_bit(how, tmp_path):
    saved = _ended(how)
    assert saved.outcome.status == how.split()[0]
    saved.save(tmp_path / "run.nc")
    loaded = fp.load(str(tmp_path / "run.nc"))
    assert {"t", "x", "R", "y_dot", "moment", "drift"} <= set(arrays(saved))
    for name in arrays(saved):
        got, expected = getattr(loaded, name), getattr(saved, name)
        assert got.shape == expected.shape
        assert got.dtype == np.float64  # also of the machine's byte order
        np.testing.assert_array_equal(got, expected)
    assert list(loaded.signals) == list(saved.signals)
    for name, signal in saved.signals.items():
        np.testing.assert_array_equal(loaded.signals[name], signal)
    assert loaded.outcome == saved.outcome
    assert (loaded.e3, loaded.law, loaded.gains) == (saved.e3, saved.law, dict(saved.gains))
    assert loaded.vehicle.to_dict() == saved.vehicle.to_dict()
    np.testing.assert_array_equal(loaded.states.batch_shape, saved.states.batch_shape)


def test_saving_what_was_loaded_gives_the_same_file(run, tmp_path):
    run.save(tmp_path / "a.nc")
    fp.load(tmp_path / "a.nc").save(tmp_path / "b.nc")
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.nc", "b.nc"]  # nothing half-written is left


def test_other_programs_open_the_file(run, tmp_path):
    path = tmp_path / "run.nc"
    run.save(path)
    with netcdf_file(path, mmap=False) as opened:
        np.testing.assert_array_equal(opened.variables["y"][:], run.y)
        assert opened.variables["thrust"].units == b"N"
        assert opened.outcome == b"completed"
    with xarray.open_dataset(path) as data:
        table = data["x"].to_pandas()
        assert list(table.columns) == ["1", "2", "3"]
        np.testing.assert_array_equal(table.to_numpy(), run.x)
        frame = data[["thrust", "V"]].to_dataframe()
        np.testing.assert_array_equal(frame["V"], run.signals["V"])
        assert frame.index.name == "t"


@pytest.mark.parametrize("how", ENDS)
def test_what_xarray_opens_is_the_dataset(how, tmp_path):
    run = _ended(how)
    run.save(tmp_path / "run.nc")
    with xarray.open_dataset(tmp_path / "run.nc", engine="scipy") as opened:
        del opened.attrs["digest"]
        xarray.testing.assert_identical(
            opened.load().drop_vars(["drift", "drift_of"], errors="ignore"), run.to_xarray()
        )


def test_the_frame_of_a_saved_sampled_run_has_rows(tmp_path):
    """An array without rows, such as the drift of a plant that has none, would leave it empty."""
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.lqr(), fp.State(y=(0, 0, 1.0)), 0.05)
    run.save(tmp_path / "run.nc")
    with xarray.open_dataset(tmp_path / "run.nc", engine="scipy") as opened:
        frame = opened.to_dataframe()
    assert len(frame) == 6 * 3 * 3 * 4  # times, axes of the world and of the body, rotors
    assert fp.load(tmp_path / "run.nc").drift.shape == (0, 3)


def test_signals_of_whole_numbers_are_kept_too(run, tmp_path):
    n = len(run.t)
    odd = dataclasses.replace(
        run, signals={"count": np.arange(n), "late": run.t > 0.5, "small": np.ones(n, np.float32)}
    )
    odd.save(tmp_path / "run.nc")
    for name, signal in fp.load(tmp_path / "run.nc").signals.items():
        np.testing.assert_array_equal(signal, odd.signals[name])


def test_a_file_that_cannot_be_written_is_one_clear_line(run, tmp_path):
    (tmp_path / "file").write_text("", encoding="utf-8")
    for path, reason in (
        (tmp_path / "file" / "run.nc", "Not a directory"),
        (tmp_path / "missing" / "run.nc", "No such file or directory"),
    ):
        line = rf"^{re.escape(str(path))}: expected a file that can be written, got {reason}$"
        with pytest.raises(fp.InputError, match=line):
            run.save(path)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@pytest.mark.parametrize("name", ["run", "run.h5", "run.nc.gz", "nc"])
def test_another_suffix_is_refused(run, tmp_path, name):
    with pytest.raises(fp.InputError, match=r"^path: expected a file name ending in \.nc, got .*$"):
        run.save(tmp_path / name)
    assert not list(tmp_path.iterdir())


def _full_disk(*_args, **_kwargs):
    raise OSError(28, "No space left on device")


def test_a_write_that_fails_leaves_the_old_file_and_nothing_else(run, tmp_path, monkeypatch):
    path = tmp_path / "run.nc"
    path.write_bytes(b"old")
    monkeypatch.setattr("flypend.flight.files.write_netcdf", _full_disk)
    line = rf"^{re.escape(str(path))}: expected a file that can be written, got No space left on device$"
    with pytest.raises(fp.InputError, match=line):
        run.save(path)
    assert path.read_bytes() == b"old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["run.nc"]


def test_a_directory_in_the_place_of_the_file_is_one_clear_line(run, tmp_path):
    path = tmp_path / "run.nc"
    path.mkdir()
    with pytest.raises(fp.InputError, match=rf"^{re.escape(str(path))}: expected a file that can be written, got "):
        run.save(path)
    assert [entry.name for entry in tmp_path.iterdir()] == ["run.nc"]


def test_a_saved_file_is_as_readable_as_any_other(run, tmp_path):
    path, other = tmp_path / "run.nc", tmp_path / "other"
    run.save(path)
    other.touch()
    assert stat.S_IMODE(path.stat().st_mode) == stat.S_IMODE(other.stat().st_mode)


# Files that hold no run ------------------------------------------------------------------------------------------


def _refused(path):
    line = rf"^{re.escape(str(path))}: expected a run saved by flypend, got [^\n]+$"
    return pytest.raises(fp.InputError, match=line)


def test_a_file_that_is_no_run_is_one_clear_line(tmp_path):
    path = tmp_path / "run.nc"
    with _refused(path):
        fp.load(path)
    with _refused(tmp_path):
        fp.load(tmp_path)
    for content in (b"", b"garbage", b"\x89HDF\r\n\x1a\n"):
        path.write_bytes(content)
        with _refused(path):
            fp.load(path)
    xarray.Dataset({"a": ("t", [1.0, 2.0])}).to_netcdf(path, engine="scipy")
    with _refused(path) as caught:
        fp.load(path)
    assert "NetCDF that flypend has not written" in str(caught.value)


def _without_variable(data):
    return data.drop_vars("omega")


def _without_attribute(data):
    del data.attrs["e3"]
    return data


def _without_outcome_time(data):
    del data.attrs["outcome_time"]
    return data


def _broken_json(data):
    data.attrs["vehicle"] = "{"
    return data


@pytest.mark.parametrize("damage", [_without_variable, _without_attribute, _without_outcome_time, _broken_json])
def test_a_run_with_a_part_missing_is_one_clear_line(run, tmp_path, damage):
    path = tmp_path / "run.nc"
    damage(run.to_xarray()).to_netcdf(path, engine="scipy")
    with _refused(path):
        fp.load(path)


def test_a_truncated_file_is_one_clear_line(run, tmp_path):
    run.save(tmp_path / "whole.nc")
    content = (tmp_path / "whole.nc").read_bytes()
    path = tmp_path / "run.nc"
    for length in np.linspace(4, len(content) - 8, 40).astype(int):
        path.write_bytes(content[:length])
        with _refused(path):
            fp.load(path)


def test_a_file_with_a_byte_changed_is_a_run_or_one_clear_line(run, tmp_path):
    run.save(tmp_path / "whole.nc")
    content = (tmp_path / "whole.nc").read_bytes()
    path = tmp_path / "run.nc"
    rng = np.random.default_rng(0)
    refused = 0
    for place in rng.integers(0, 4000, 300):  # the header: names, sizes, attributes
        path.write_bytes(content[:place] + rng.bytes(1) + content[place + 1 :])
        try:
            fp.load(path)
        except fp.InputError as error:
            assert str(error).startswith(f"{path}: expected a run saved by flypend, got ")  # noqa: PT017
            assert "\n" not in str(error)  # noqa: PT017
            refused += 1
    assert 0 < refused < 300


@pytest.mark.parametrize(
    ("harm", "said"),
    [
        (lambda content: content[: len(content) // 2], "a file that is cut off"),
        (lambda content: content[:10], "a file that is cut off"),
        (lambda content: b"", "an empty file"),
        (lambda content: b"\x89HDF\r\n" + content, "NetCDF 4, not NetCDF in the classic format"),
        (lambda content: b"[run]\n", "another file, not NetCDF"),
        (lambda content: content.replace(b"vehicle", b"lorry12"), "NetCDF that flypend has not written: no vehicle"),
    ],
)
def test_a_file_that_is_no_run_says_what_it_is(harm, said, run, tmp_path):
    path = tmp_path / "run.nc"
    run.save(path)
    path.write_bytes(harm(path.read_bytes()))
    with pytest.raises(fp.InputError) as caught:
        fp.load(path)
    assert str(caught.value).startswith(f"{path}: expected a run saved by flypend, got {said}")


def test_a_changed_number_is_noticed_and_can_be_meant(run, tmp_path):
    """One bit of one position: nothing else in a NetCDF file would tell."""
    path = tmp_path / "run.nc"
    run.save(path)
    with xarray.open_dataset(path, engine="scipy") as opened:
        data = opened.load()
    data["x"][3, 1] += 1e-9
    data.to_netcdf(path, engine="scipy")
    with pytest.raises(fp.InputError, match="got one that was damaged or changed since"):
        fp.load(path)
    del data.attrs["digest"]
    data.to_netcdf(path, engine="scipy")
    assert fp.load(path).x[3, 1] == run.x[3, 1] + 1e-9


def test_a_copy_for_another_process_keeps_all_but_the_flight(run):
    """Reports draw in processes of their own; a flight holds programs, which no copy takes along."""
    again = pickle.loads(pickle.dumps(run))
    assert run.flight is not None
    assert again.flight is None
    for name in arrays(run):
        np.testing.assert_array_equal(getattr(again, name), getattr(run, name))
