"""Maps: every run is counted once, in the cell where it starts; areas are equal; memory does not grow with the runs."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import binomtest

import flypend as fp
from flypend import palette
from flypend.cli import app as cli
from flypend.cli.studies import fly_study
from flypend.flight.metrics import wilson, wilson_bounds
from flypend.pictures.maps import FAILED, map_figure
from flypend.studies.sweep import bins, cube
from flypend.studies.sweep.chunk import CAUSES
from flypend.studies.sweep.store import find_store, open_store
from tests.few import slow

STUDY = {
    "vehicle": "nayak2018", "law": {"name": "corrected"}, "plant": "ideal", "duration": 4.0, "judge_period": 0.1,
    "runs": 700, "chunk": 300,
    "criterion": {"target": "e3", "position": 100.0, "rod": 1.0, "axis": 0.3},
    "vary": {"start": {"y": "uniform", "y_dot": {"disc": 2.0}, "R": "uniform", "omega": {"ball": 1.0}},
             "gains": {"k_d": {"from": 1.0, "to": 4.0}}},
}  # fmt: skip
GRID = STUDY | {
    "runs": 2,
    "vary": {"start": {"tilt": {"from": 0.0, "to": 3.0, "points": 4}, "rate": {"values": [0.0, 1.0]}, "R": "uniform"}},
}


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    path = tmp_path_factory.mktemp("maps") / "a.zarr"
    fp.sweep(STUDY, path, workers=1)
    return path


def everything(path):
    found = find_store(path)
    parts = [found.read(k) for k in range(found.study.chunks)]
    return {name: np.concatenate([part[name] for part in parts]) for name in found.columns}


# Projection -----------------------------------------------------------------------------------------------------------


def test_the_projection_keeps_areas():
    """Uniform on the sphere is uniform in the discs: equal numbers in rings of equal area, to four deviations."""
    y = cube.on_sphere(cube.members("uniform", 1, 0, 40_000, 2, 0, 40_000))
    upper, flat = bins.lambert(y)
    radius = np.linalg.norm(flat, axis=1)
    assert abs(upper.sum() - 20_000) < 4 * 100
    assert radius.max() <= bins.EDGE
    rings = np.bincount((radius[upper] ** 2 / bins.EDGE**2 * 10).astype(int), minlength=10) / upper.sum()
    assert np.max(np.abs(rings - 0.1)) < 4 * np.sqrt(0.09 / 20_000)
    other = np.bincount((np.degrees(np.arccos(y[upper, 2])) / 9.001).astype(int), minlength=10) / upper.sum()
    assert np.max(np.abs(other - 0.1)) > 0.05  # negative control: rings of equal angle are not


def test_poles_and_horizon_are_where_they_are_said_to_be():
    tilt = np.radians([0, 30, 60, 90, 120, 150, 180])
    y = cube.tilt_rods(tilt, np.zeros(7), np.zeros(7), np.zeros(7))[0]
    upper, flat = bins.lambert(y)
    assert upper.tolist()[:3] + upper.tolist()[4:] == [True] * 3 + [False] * 3
    np.testing.assert_allclose(flat[:3, 0], 2 * np.sin(tilt[:3] / 2), atol=1e-12)
    np.testing.assert_allclose(flat[:, 0], flat[::-1, 0], atol=1e-12)
    np.testing.assert_allclose(flat[:, 1], 0, atol=1e-12)


# Cells ----------------------------------------------------------------------------------------------------------------


def test_every_run_is_in_its_cell_once(store):
    runs, data = bins.Runs(store), everything(store)
    sphere = bins.sphere(runs.study, 9)
    plane, (across, up) = bins.plane(runs, ("tilt", "gains.k_d"), 7)
    of_sphere, of_plane = runs.gather([sphere, plane])
    assert runs.number == 700
    for cells in (of_sphere, of_plane):
        assert cells.runs.sum() == 700
        assert cells.successes.sum() == data["success"].sum()
        np.testing.assert_array_equal(cells.causes.sum(axis=1), np.bincount(data["cause"], minlength=len(CAUSES)))
        np.testing.assert_allclose(np.nansum(cells.excursion * cells.runs), data["excursion"].sum(), rtol=1e-5)
        np.testing.assert_allclose(np.nansum(cells.settling * cells.successes), np.nansum(data["settling"]), rtol=1e-5)
    tilt = np.degrees(np.arccos(-data["y"][:, 2]))  # the paper's e3 points down
    expected = np.histogram2d(data["gains.k_d"], tilt, [up, across])[0]
    np.testing.assert_array_equal(of_plane.runs.reshape(plane.shape), expected)
    assert np.all(of_sphere.runs[:81].sum() == (tilt <= 90).sum())  # the upper hemisphere comes first
    assert 0 < data["success"].sum() < 700


def test_a_grid_keeps_its_cells(tmp_path):
    fp.sweep(GRID, tmp_path / "g.zarr", workers=1)
    runs = bins.Runs(tmp_path / "g.zarr")
    assert bins.default_plane(runs) == ("tilt", "rate")
    plane, (across, up) = bins.plane(runs, ("tilt", "rate"), 50)
    np.testing.assert_allclose(across, np.degrees([-0.5, 0.5, 1.5, 2.5, 3.5]))
    assert up.tolist() == [-0.5, 0.5, 1.5]
    assert runs.gather([plane])[0].runs.tolist() == [2.0] * 8
    assert map_figure(tmp_path / "g.zarr").axes


@pytest.fixture(scope="module")
def repeated(tmp_path_factory):
    """Forty starts, each in eight cells that are all but equal."""
    path = tmp_path_factory.mktemp("repeated") / "r.zarr"
    gains = {"k_d": {"from": 1.0, "to": 1.0 + 1e-9, "points": 8}}
    made = fp.study(STUDY | {"runs": 40, "chunk": 90, "vary": STUDY["vary"] | {"gains": gains}})
    return path, made, fp.sweep(made, path, workers=1)


def test_runs_from_one_start_are_no_independent_runs(repeated, capsys):
    path, made, data = repeated
    good = data.success.values.reshape(8, 40)
    assert np.all(good == good[0])
    assert 0 < good[0].sum() < 40
    low, high = wilson(good[0].sum(), 40)
    words = f"(95 % interval over 40 starts {100 * low:.4g} to {100 * high:.4g} %)"
    fly_study(made, path, workers=1)
    assert words in " ".join(capsys.readouterr().out.split())
    assert words in map_figure(path, cells=4).get_suptitle()
    runs = bins.Runs(path)
    for names, repeats in ((("tilt", "rate"), 8), (("tilt", "gains.k_d"), 1)):
        cells = runs.gather([bins.plane(runs, names, 4)[0]])[0]
        low, high = wilson_bounds(cells.successes / repeats, cells.runs / repeats)
        np.testing.assert_allclose(cells.width, high - low)
        assert cells.runs.sum() == 320


@pytest.mark.parametrize("sampling", ["sobol", "latin"])
def test_draws_that_are_not_independent_have_no_interval(sampling, tmp_path, capsys):
    made = fp.study(STUDY | {"runs": 64, "sampling": sampling})
    fly_study(made, tmp_path / "s.zarr", workers=1)
    words = f"(no interval: {sampling} draws are not independent)"
    assert words in " ".join(capsys.readouterr().out.split())
    assert words in map_figure(tmp_path / "s.zarr").get_suptitle()


def test_bounds_are_wilson_s():
    """Against SciPy's interval, and 0 to 1 for no runs."""
    rng = np.random.default_rng(1)
    runs = np.concatenate([[0, 1, 1, 5, 10**7], rng.integers(1, 1000, 40)])
    good = np.concatenate([[0, 0, 1, 5, 10**6], rng.integers(0, runs[5:] + 1)])
    low, high = wilson_bounds(good, runs)
    for i in range(1, len(runs)):
        expected = binomtest(int(good[i]), int(runs[i])).proportion_ci(0.95, method="wilson")
        np.testing.assert_allclose((low[i], high[i]), expected, atol=1e-9)
        np.testing.assert_array_equal(wilson(good[i], runs[i]), (low[i], high[i]))
    assert (low[0], high[0]) == (0.0, 1.0)


# The picture ----------------------------------------------------------------------------------------------------------


def test_the_picture_shows_what_was_counted(store):
    figure = map_figure(store, cells=9)
    words = [text.get_text() for axis in figure.axes for text in axis.texts]
    for word in ("inverted", "hanging", "30°", "60°", "90°", "120°", "150°"):
        assert words.count(word) >= 4, word
    data = everything(store)
    assert f"{100 * data['success'].mean():.4g} %" in figure.get_suptitle()
    upper, lower = (axis.collections[0].get_array() for axis in figure.axes[:2])
    counted = bins.Runs(store).gather([bins.sphere(fp.study(STUDY), 9)])[0]
    np.testing.assert_allclose(np.ma.filled(upper, np.nan).ravel(), 100 * counted.rate[:81])
    np.testing.assert_allclose(np.ma.filled(lower, np.nan).ravel(), 100 * counted.rate[81:])
    assert any(axis.collections[-1].get_hatch() for axis in figure.axes[:3])  # few runs to a cell
    assert not any(axis.collections[-1].get_hatch() for axis in figure.axes[3:6])
    labels = [text.get_text() for text in figure.axes[-1].get_yticklabels()]
    assert [label.split()[0] for label in labels] == ["none", *CAUSES[1:]]
    assert [palette.CAUSES[name] for name in CAUSES[1:]] == FAILED
    assert len(set(FAILED)) == len(FAILED)


def test_angles_have_ticks_every_45_degrees(store):
    plane = map_figure(store, x="tilt", y="rate", cells=9).axes[2]
    ticks = plane.get_xticks()
    np.testing.assert_array_equal(np.unique(np.diff(ticks)), [45.0])


def test_unfinished_stores_are_drawn_and_empty_ones_refused(store, tmp_path):
    import shutil

    path = tmp_path / "b.zarr"
    shutil.copytree(store, path)
    kept = find_store(path)
    kept._marks[1] = 0
    assert bins.Runs(path).number == 400
    kept._marks[2] = 0
    assert bins.Runs(path).number == 300
    kept._marks[0] = 0
    with pytest.raises(fp.InputError, match="expected a store with runs"):
        map_figure(path)


@pytest.mark.parametrize(
    ("options", "line"),
    [
        ({"x": "tilt"}, "x, y: expected both or none"),
        ({"x": "tilt", "y": "rat"}, "y: expected one of "),
        ({"x": "speed", "y": "rate"}, "x: expected one of "),
    ],
)
def test_quantities_that_the_store_lacks_are_refused(options, line, store):
    with pytest.raises(fp.InputError) as caught:
        map_figure(store, **options)
    assert str(caught.value).startswith(line)


def test_every_quantity_can_be_drawn(store):
    known = bins.quantities(bins.Runs(store).study)
    assert known == ["tilt", "rate", "spin", "body_tilt", "gains.k_d"]
    for one in known[1:]:
        _, (cells, edges) = bins.Runs(store), bins.plane(bins.Runs(store), ("tilt", one), 5)
        data = everything(store)
        values = bins._values(data, one, fp.study(STUDY))
        assert edges[1][0] <= values.min() <= values.max() <= edges[1][-1] * (1 + 1e-6)
        assert cells.shape == (5, 5)


def command(monkeypatch, capsys, *arguments):
    monkeypatch.setattr("sys.argv", ["flypend", *arguments])
    monkeypatch.setattr(cli.signal, "signal", lambda *_: None)
    with pytest.raises(SystemExit) as exit_:
        cli.main()
    return exit_.value.code, *capsys.readouterr()


def test_from_nothing_to_a_picture_in_one_command(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    asked = ("map", "--law", "corrected", "--runs", "500", "--duration", "1.5", "-o", "m.png", "--workers", "1")
    code, out, _ = command(monkeypatch, capsys, *asked)
    assert code == 0
    assert "of 500 runs succeed" in out
    assert sorted(path.name for path in tmp_path.iterdir()) == [".m.zarr.lock", "m.png", "m.zarr"]
    picture = Path("m.png").read_bytes()
    Path("m.png").unlink()
    assert command(monkeypatch, capsys, "map", "m.zarr", "-o", "m.png")[0] == 0
    assert Path("m.png").read_bytes() == picture


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ((), "map: expected a store, a study, or --law"),
        (("a.zarr", "--law", "lqr"), "map: expected a store, a study, or --law"),
        (("a.zarr",), "a.zarr: expected a store that a sweep has written, got nothing"),
        (("a.zarr", "-o", "a.jpg"), "--out: expected a file name ending in"),
        (("--law", "lqr", "--plant", "rotor"), "--plant: expected one of"),
    ],
)
def test_mistakes_are_one_line_and_code_2(arguments, line, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    code, out, err = command(monkeypatch, capsys, "map", *arguments)
    assert (code, out) == (2, "")
    assert " ".join(err.split()).startswith(f"flypend: {line}")
    assert not list(tmp_path.iterdir())


# Memory ---------------------------------------------------------------------------------------------------------------


def peak(path, out):
    """Largest resident memory, MB, of a process that draws the map of `path`.

    The kernel's high-water mark: what `getrusage` tells begins with the memory of the process that forked.
    """
    code = (
        "import re, sys; from flypend.pictures.maps import map_figure; from flypend.files.whole import save_figure;"
        "save_figure(map_figure(sys.argv[1]), sys.argv[2]);"
        "print(int(re.search(r'VmHWM:\\s+(\\d+)', open('/proc/self/status').read())[1]) // 1024)"
    )
    done = subprocess.run([sys.executable, "-c", code, path, out], capture_output=True, text=True, check=True)
    return int(done.stdout)


@pytest.mark.parametrize("runs", [2_000_000, slow(10_000_000)])
def test_millions_of_runs_take_no_more_memory_than_a_chunk(runs, tmp_path):
    """Every chunk of the store is a copy of the first: millions of runs to read, the memory of a hundred thousand."""
    small, large = tmp_path / "small.zarr", tmp_path / "large.zarr"
    table = STUDY | {"duration": 0.2, "criterion": STUDY["criterion"] | {"hold": 0.1}, "chunk": 100_000}
    fp.sweep(table | {"runs": 100_000}, small, workers=1)
    columns = find_store(small).read(0)
    kept = open_store(large, fp.study(table | {"runs": runs}), "", {})
    for number in range(runs // 100_000):
        kept.write(number, columns)
    assert bins.Runs(large).number == runs
    of_small, of_large = peak(small, tmp_path / "s.png"), peak(large, tmp_path / "l.png")
    assert of_large < 1000
    assert of_large - of_small < 60  # the columns of two million runs would be more than 100
