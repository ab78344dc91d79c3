"""Sweeps: run i depends on the study and i alone, a store survives everything, and no store is mistaken for another."""

import itertools
import math
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import Future
from contextlib import nullcontext

import numpy as np
import psutil
import pytest
import zarr
from scipy.stats import kstest
from short_study import SHORT, content

import flypend as fp
from flypend.files.toml import toml_text
from flypend.flight.kernels import launch
from flypend.flight.metrics import metrics
from flypend.geometry import dot, norm
from flypend.model.state import FLIP
from flypend.paper import experiment
from flypend.studies.sweep import bins, cube
from flypend.studies.sweep import chunk as flown
from flypend.studies.sweep.chunk import CAUSES, fly_range
from flypend.studies.sweep.claim import lock_of
from flypend.studies.sweep.design import design
from flypend.studies.sweep.store import _seal, find_store

GRID = SHORT | {"runs": 3, "vary": {"start": {"tilt": {"from": 0.0, "to": 3.0, "points": 4}, "R": "uniform"},
                                    "gains": {"k_d": {"values": [0.5, 2.0]}}}}  # fmt: skip
NOISY = {
    "vehicle": "hehn2011", "law": {"name": "lqr"}, "duration": 0.2, "criterion": {"hold": 0.1}, "runs": 6, "chunk": 4,
    "plant": {"base": "rotors", "rate": 100.0, "seed": 5, "noise": {"x": 0.01, "omega": 0.1}},
    "vary": {"start": {"omega": {"ball": 1.0}}, "plant": {"delay": {"values": [0.0, 0.01]}}},
    "start": {"y": [0.0, 0.0, 1.0]},
}  # fmt: skip


def columns(path):
    """Every number of a store."""
    store = find_store(path)
    parts = [store.read(k) for k in range(store.study.chunks)]
    return {name: np.concatenate([part[name] for part in parts]) for name in store.columns}


def same(one, other):
    assert one.keys() == other.keys()
    for name in one:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)


# What is drawn --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("sampling", cube.SAMPLINGS)
@pytest.mark.parametrize("table", [SHORT, GRID, NOISY], ids=["random", "grid", "plants"])
def test_a_run_is_drawn_alike_in_every_chunking(table, sampling):
    study = fp.study(table | {"sampling": sampling})
    whole = design(study, 0, study.runs)
    for size in (1, 2, 5, 7):
        parts = [design(study, a, min(a + size, study.runs)) for a in range(0, study.runs, size)]
        np.testing.assert_array_equal(np.concatenate([part.packed for part in parts]), whole.packed)
        np.testing.assert_array_equal(np.concatenate([part.cells for part in parts]), whole.cells)
        for name in whole.gains:
            np.testing.assert_array_equal(np.concatenate([part.gains[name] for part in parts]), whole.gains[name])
    assert len(np.unique(whole.packed, axis=0)) > 1


@pytest.mark.parametrize("sampling", cube.SAMPLINGS)
def test_another_seed_and_another_stream_are_other_samples(sampling):
    one, seed, stream = (cube.members(sampling, *which, 50, 3, 0, 50) for which in ((1, 0), (2, 0), (1, 1)))
    assert not set(one.ravel()) & set(seed.ravel())
    assert not set(one.ravel()) & set(stream.ravel())


def test_a_latin_hypercube_and_a_sobol_sequence_are_what_they_are_called():
    n = 64
    latin, sobol, uniform = (cube.members(kind, 3, 0, n, 2, 0, n) for kind in ("latin", "sobol", "uniform"))
    filled = [len(np.unique(np.floor(n * points[:, 0]))) for points in (latin, sobol, uniform)]
    assert filled[:2] == [n, n]  # one point in each of n strips
    assert filled[2] < 50  # negative control: independent points leave strips empty
    boxes = {tuple(box) for box in np.floor(8 * sobol).astype(int)}
    assert len(boxes) == n  # a (0, 6, 2) net


def test_what_is_drawn_has_the_laws_it_is_said_to_have():
    """Kolmogorov and Smirnov on marginals whose law is known; p > 1e-3 of a fixed seed."""
    study = fp.study(SHORT | {"runs": 20_000, "vary": {"start": SHORT["vary"]["start"] | {"x": {"ball": 0.5}}}})
    state = fp.State.from_packed(design(study, 0, study.runs).packed)

    def looks(values, law):
        return kstest(values, law).pvalue > 1e-3

    for i in range(3):
        assert looks((state.y[:, i] + 1) / 2, "uniform")  # Archimedes: each coordinate is uniform
        assert looks((state.R[:, i, i] + 1) / 2, "uniform")  # columns of R are uniform on the sphere
    angle = np.arccos(np.clip((np.trace(state.R, axis1=1, axis2=2) - 1) / 2, -1, 1))
    assert looks(angle, lambda a: (a - np.sin(a)) / np.pi)  # Haar measure by the angle
    assert looks(norm(state.omega), lambda r: np.clip(r / 3, 0, 1) ** 3)
    assert looks(norm(state.x), lambda r: np.clip(r / 0.5, 0, 1) ** 3)
    assert looks(norm(state.y_dot), lambda r: np.clip(r / 2, 0, 1) ** 2)
    assert np.max(np.abs(dot(state.y, state.y_dot))) < 1e-12
    assert not looks(norm(state.y_dot), lambda r: np.clip(r / 2, 0, 1) ** 3)  # a disc is no ball
    assert abs(np.corrcoef(state.y[:, 0], state.R[:, 0, 0])[0, 1]) < 0.03


def test_angles_are_from_inverted_with_e3_up_whatever_the_frame_of_the_law():
    rod = {"tilt": {"values": [0.4]}, "azimuth": {"values": [0.7]}, "rate": {"values": [2.0]}}
    y = np.array([np.sin(0.4) * np.cos(0.7), np.sin(0.4) * np.sin(0.7), np.cos(0.4)])
    y_dot = 2 * np.array([np.cos(0.4) * np.cos(0.7), np.cos(0.4) * np.sin(0.7), -np.sin(0.4)])  # heading 0: it grows
    for law, turn in (("corrected", FLIP), ("inverted", np.eye(3))):
        study = fp.study(SHORT | {"law": {"name": law}, "runs": 1, "vary": {"start": rod}})
        state = fp.State.from_packed(design(study, 0, 1).packed)
        np.testing.assert_allclose(state.y[0], turn @ y, atol=1e-15)
        np.testing.assert_allclose(state.y_dot[0], turn @ y_dot, atol=1e-15)


def test_every_cell_of_the_grid_flies_the_same_sample_and_the_grid_is_gone_through_in_order():
    study = fp.study(GRID)
    drawn = design(study, 0, study.runs)
    assert (study.shape, study.runs) == ((2, 4), 24)
    assert drawn.gains["k_d"].tolist() == [0.5] * 12 + [2.0] * 12
    np.testing.assert_allclose(drawn.columns["tilt"], np.tile(np.repeat([0.0, 1, 2, 3], 3), 2))
    rotations = drawn.packed[:, 6:15].reshape(8, 3, 9)
    assert np.all(rotations == rotations[0])
    assert len(np.unique(rotations[0], axis=0)) == 3


# What is flown --------------------------------------------------------------------------------------------------------


def test_a_run_of_a_sweep_is_the_single_run(tmp_path):
    """To the accuracy of the two: another tolerance, and another step control."""
    study = fp.study(SHORT | {"rtol": 1e-9, "final": True, "runs": 5, "vary": SHORT["vary"] | {
        "gains": {"k_d": {"from": 0.5, "to": 2.0}}}})  # fmt: skip
    fp.sweep(study, tmp_path / "a.zarr", workers=1)
    found, drawn = columns(tmp_path / "a.zarr"), design(study, 0, 5)
    for i in range(5):
        law = fp.laws.corrected(k_d=drawn.gains["k_d"][i])
        run = fp.simulate(
            study.flight.vehicle, law, fp.State.from_packed(drawn.packed[i]), 1.0, rtol=1e-10, plant="ideal"
        )
        np.testing.assert_allclose(found["final"][i], run.states[-1].packed(), atol=1e-5)
        judged = metrics(run, study.flight.criterion)
        assert CAUSES[found["cause"][i]] == (judged.cause or "success")
        assert found["success"][i] == judged.success
        np.testing.assert_allclose(found["excursion"][i], judged.excursion, rtol=1e-3)
    other = fp.simulate(
        study.flight.vehicle, fp.laws.corrected(k_d=5.0), fp.State.from_packed(drawn.packed[0]), 1.0, plant="ideal"
    )
    assert np.max(np.abs(found["final"][0] - other.states[-1].packed())) > 1e-2  # gains matter


@pytest.mark.parametrize("table", [SHORT, GRID, NOISY], ids=["random", "grid", "noise and plants"])
def test_the_result_does_not_depend_on_chunks_threads_or_cluster(table, tmp_path):
    study = fp.study(table)
    whole = fly_range(study, 0, study.runs)
    for chunk, workers in ((7, 2), (100, 1)):
        path = tmp_path / f"{chunk}.zarr"
        fp.sweep(table | {"chunk": chunk}, path, workers=workers)
        same(columns(path), whole)
    assert len(np.unique(whole["effort"])) == study.runs  # no two runs are one, those of a grid with noise neither


def test_only_other_samplings_than_uniform_need_scipy(monkeypatch):
    asked = []
    monkeypatch.setattr(cube, "require", lambda module, **_named: asked.append(module))
    cube.check_size("uniform", 10, 2)
    assert asked == []
    cube.check_size("sobol", 10, 2)
    assert asked == ["scipy"]


def test_one_thread_at_a_time_builds_expressions(tmp_path, monkeypatch):
    """CasADi's nodes are shared by all threads: two that built at once have ended the process."""
    inside, most = [], []

    def watched(build):
        def call(*given, **named):
            inside.append(1)
            most.append(len(inside))
            time.sleep(0.02)
            try:
                return build(*given, **named)
            finally:
                inside.pop()

        return call

    monkeypatch.setattr(flown, "study", watched(flown.study))
    monkeypatch.setattr(flown, "flights", watched(flown.flights))
    monkeypatch.setattr(launch, "ideal_kernel", watched(launch.ideal_kernel))
    fp.sweep(SHORT | {"chunk": 3}, tmp_path / "one.zarr", workers=4)
    # Each chunk of three makes its flights and asks for their kernel; a study holds a flight, whose kernel is asked for
    # inside.
    assert len(most) >= 2 * (fp.study(SHORT).runs // 3)
    assert max(most) <= 2


def test_a_sweep_flies_on_a_cluster_that_is_there(tmp_path):
    from distributed import LocalCluster

    fp.sweep(SHORT, tmp_path / "own.zarr", workers=1)
    told = []
    with LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, protocol="tcp", host="127.0.0.1",
        dashboard_address="127.0.0.1:0", memory_limit=0, silence_logs=50,
    ) as cluster:  # fmt: skip
        address = cluster.scheduler_address
        fp.sweep(SHORT, tmp_path / "there.zarr", scheduler=address, progress=lambda *now: told.append(now))
    assert address.startswith("tcp://")
    same(columns(tmp_path / "own.zarr"), columns(tmp_path / "there.zarr"))
    assert (told[0], told[-1]) == ((0, 100), (100, 100))


def test_the_store_says_what_it_holds(tmp_path):
    table = SHORT | {"duration": 4.0, "runs": 200}
    data = fp.sweep(table, tmp_path / "a.zarr", workers=1)
    assert data.sizes["run"] == 200
    assert data.settling.attrs["units"] == "s"
    assert data.cause.attrs["flag_meanings"].split() == list(CAUSES)
    np.testing.assert_array_equal(data.success, data.cause == 0)
    assert np.all(np.isnan(data.settling) == ~data.success)
    assert fp.study(__import__("tomllib").loads(data.attrs["study"])).text() == fp.study(table).text()
    assert data.attrs["versions"]["flypend"] == fp.__version__
    assert 0 < int(data.success.sum()) < 200


# Stopped and continued ------------------------------------------------------------------------------------------------

LONG = SHORT | {"runs": 16_000, "chunk": 400, "duration": 3.0, "rtol": 1e-9}


def command(folder, *more):
    (folder / "study.toml").write_text(toml_text(LONG), encoding="utf-8")
    return [sys.executable, "-m", "flypend", "sweep", "study.toml", "-o", "b.zarr", *more]


def marks(folder):
    """Return the files that say which runs are whole; one that a kill cut off still has another name."""
    return [path for path in (folder / "b.zarr" / "whole").rglob("[0-9]*") if path.suffix != ".partial"]


def until(condition, process, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert process.poll() is None
        assert time.monotonic() < end
        time.sleep(0.005)


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    fp.sweep(LONG, folder / "b.zarr", workers=1)
    return folder / "b.zarr"


def test_killed_at_any_time_it_goes_on_and_the_result_is_the_same_to_the_last_byte(tmp_path, uninterrupted):
    stops = []
    for wanted in (1, 15):
        with subprocess.Popen(command(tmp_path, "--workers", "1"), cwd=tmp_path) as process:
            until(lambda: len(marks(tmp_path)) >= wanted, process)  # noqa: B023
            process.send_signal(signal.SIGKILL)
        stops.append(len(marks(tmp_path)))
    assert 1 <= stops[0] < stops[1] < 40  # it was stopped twice, and did go on in between
    before = {path: path.stat().st_mtime_ns for path in marks(tmp_path)}
    done = subprocess.run(command(tmp_path, "--workers", "1"), cwd=tmp_path, capture_output=True, text=True, check=True)
    assert "of 16000 runs succeed" in done.stdout
    assert all(path.stat().st_mtime_ns == then for path, then in before.items())  # what was whole was kept
    assert content(tmp_path / "b.zarr") == content(uninterrupted)  # what the kills cut off is gone as well


def test_the_death_of_a_worker_changes_nothing(tmp_path, uninterrupted):
    with subprocess.Popen(command(tmp_path, "--workers", "2", "--processes"), cwd=tmp_path) as process:
        until(lambda: len(marks(tmp_path)) >= 2, process)
        workers = [one for one in psutil.Process(process.pid).children() if "LokyProcess" in " ".join(one.cmdline())]
        assert len(workers) == 2
        os.kill(workers[0].pid, signal.SIGKILL)
        killed_at = len(marks(tmp_path))
        assert process.wait(60) == 0
    assert killed_at < 40
    assert content(tmp_path / "b.zarr") == content(uninterrupted)


@pytest.mark.parametrize("harm", ["cut", "lost", "changed", "mark"])
def test_a_chunk_that_is_not_whole_is_flown_again(harm, tmp_path):
    path = tmp_path / "a.zarr"
    fp.sweep(SHORT, path, workers=1)
    sound = content(path)
    target = path / "excursion" / "c" / "1"
    if harm == "cut":
        target.write_bytes(target.read_bytes()[:20])
    elif harm == "lost":
        target.unlink()
    elif harm == "changed":
        array = zarr.open_group(path)["excursion"]
        array[45] = array[45] + 1
    else:
        (path / "whole" / "c" / "1").write_bytes(b"")
    assert content(path) != sound
    told = []
    fp.sweep(SHORT, path, workers=1, progress=lambda *now: told.append(now))
    assert told == [(60, 100), (100, 100)]  # this chunk and no other
    assert content(path) == sound


# What is refused ------------------------------------------------------------------------------------------------------


def test_a_finished_store_is_left_as_it_is_and_force_begins_anew(tmp_path):
    path = tmp_path / "a.zarr"
    fp.sweep(SHORT, path, workers=1)
    times = {file: file.stat().st_mtime_ns for file in path.rglob("*") if file.is_file()}
    fp.sweep(SHORT, path, workers=1)
    assert {file: file.stat().st_mtime_ns for file in path.rglob("*") if file.is_file()} == times
    fp.sweep(SHORT | {"seed": 8}, path, workers=1, force=True)
    assert "seed = 8" in find_store(path).attributes["study"]
    assert {entry.name for entry in tmp_path.iterdir()} == {"a.zarr", ".a.zarr.lock"}


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"seed": 2}, "seed: expected 1, as in "),
        ({"runs": 120}, "runs: expected 100, as in "),
        ({"law": {"name": "corrected", "gains": {"k_d": 2.0}}}, "law.gains.k_d: expected nothing, as in "),
        ({"criterion": {"target": "e3"}}, "criterion.axis: expected 0.5, as in "),
    ],
)
def test_a_store_of_another_study_is_refused_and_the_difference_named(change, line, tmp_path):
    path = tmp_path / "a.zarr"
    fp.sweep(SHORT, path, workers=1)
    sound = content(path)
    with pytest.raises(fp.InputError) as caught:
        fp.sweep(SHORT | change, path, workers=1)
    assert str(caught.value).startswith(line)
    assert content(path) == sound


def resealed(group, **changes):
    """What another version would have written."""
    group.attrs.update(changes)
    group.attrs["seal"] = _seal(dict(group.attrs))


def test_a_store_begun_with_other_equations_or_versions_is_refused(tmp_path):
    path = tmp_path / "a.zarr"
    fp.sweep(SHORT, path, workers=1)
    group = zarr.open_group(path)
    program = group.attrs["program"]
    resealed(group, program="0" * 64)
    with pytest.raises(fp.InputError, match="the equations that it was begun with"):
        fp.sweep(SHORT, path, workers=1)
    resealed(group, program=program, versions={**group.attrs["versions"], "casadi": "1.0"})
    with pytest.raises(fp.InputError, match=r"versions.casadi: expected 1.0"):
        fp.sweep(SHORT, path, workers=1)


def turned(value):
    """Settings with the keys of every table in reverse order, and whole numbers without a point."""
    if isinstance(value, dict):
        return {key: turned(value[key]) for key in reversed(value)}
    return int(value) if isinstance(value, float) and value.is_integer() else value


def test_neither_the_order_of_lines_nor_the_way_a_number_is_written_makes_another_study(tmp_path):
    path, table = tmp_path / "a.zarr", SHORT | {"law": {"name": "corrected", "gains": {"k_1": 8.0, "k_d": 2.0}}}
    fp.sweep(table, path, workers=1)
    sound, told = content(path), []
    fp.sweep(turned(table), path, workers=1, progress=lambda *now: told.append(now))
    assert told == [(100, 100)]
    assert content(path) == sound
    fp.sweep({key: table[key] for key in reversed(table)}, tmp_path / "b.zarr", workers=1)
    assert content(tmp_path / "b.zarr") == sound
    fp.sweep(turned(table), tmp_path / "c.zarr", workers=1)
    same(columns(tmp_path / "c.zarr"), columns(path))


LAW = """
def spin(t, state, vehicle, *, k=0.1):
    return Wrench(vehicle.weight, -k * vehicle.I @ state.omega)
"""


def test_a_store_is_read_without_its_law_and_goes_on_where_both_were_moved(tmp_path):
    """A folder with study, law and store is renamed; then the store goes to someone who has none of the others."""
    old, new, alone = (tmp_path / name for name in ("old", "new", "alone"))
    for folder in (old, alone):
        folder.mkdir()
    (old / "mine.py").write_text("from flypend import Wrench\n" + LAW, encoding="utf-8")
    table = SHORT | {
        "law": {"function": "mine.py:spin"}, "vary": {**SHORT["vary"], "gains": {"k": {"values": [0.1, 0.2]}}}
    }  # fmt: skip
    (old / "study.toml").write_text(toml_text(table), encoding="utf-8")
    fp.sweep(old / "study.toml", old / "a.zarr", workers=1)
    before = columns(old / "a.zarr")
    old.rename(new)
    told = []
    fp.sweep(new / "study.toml", new / "a.zarr", workers=1, progress=lambda *now: told.append(now))
    assert told == [(200, 200)]
    text = find_store(new / "a.zarr").attributes["study"]
    assert str(tmp_path) not in text
    assert 'function = "mine.py:spin"' in text
    (new / "a.zarr").rename(alone / "a.zarr")
    (new / "mine.py").unlink()
    same(columns(alone / "a.zarr"), before)
    assert bins.Runs(alone / "a.zarr").gather([bins.sphere(find_store(alone / "a.zarr").study, 8)])[0].runs.sum() == 200
    with pytest.raises(fp.InputError, match="law: expected the study's own law"):
        fly_range(find_store(alone / "a.zarr").study, 0, 1)
    (alone / "mine.py").write_text("from flypend import Wrench\n" + LAW.replace("weight", "mass"), encoding="utf-8")
    (new / "study.toml").rename(alone / "study.toml")
    with pytest.raises(fp.InputError, match="the equations that it was begun with"):
        fp.sweep(alone / "study.toml", alone / "a.zarr", workers=1)


def test_a_store_whose_study_is_in_the_order_of_its_file_with_an_absolute_path_is_resumed(tmp_path):
    """So were stores written before."""
    (tmp_path / "mine.py").write_text("from flypend import Wrench\n" + LAW, encoding="utf-8")
    study = fp.study(SHORT | {"law": {"function": f"{tmp_path / 'mine.py'}:spin"}})
    fp.sweep(study, tmp_path / "a.zarr", workers=1)
    resealed(zarr.open_group(tmp_path / "a.zarr"), study=toml_text(study.settings))
    fp.sweep(study, tmp_path / "a.zarr", workers=1)
    assert find_store(tmp_path / "a.zarr").attributes["study"] == toml_text(study.settings)


def test_what_no_sweep_has_written_is_neither_continued_nor_removed(tmp_path):
    (tmp_path / "mine.zarr").mkdir()
    (tmp_path / "mine.zarr" / "thesis.txt").write_text("years of work", encoding="utf-8")
    zarr.create_group(tmp_path / "other.zarr")
    for name, force in itertools.product(("mine.zarr", "other.zarr"), (False, True)):
        with pytest.raises(fp.InputError, match="expected a store that a sweep has written"):
            fp.sweep(SHORT, tmp_path / name, force=force, workers=1)
    assert (tmp_path / "mine.zarr" / "thesis.txt").exists()
    with pytest.raises(fp.InputError, match=r"a name ending in \.zarr"):
        fp.sweep(SHORT, tmp_path / "thesis", force=True, workers=1)


def test_two_sweeps_do_not_write_one_store(tmp_path):
    fcntl = pytest.importorskip("fcntl")
    path = tmp_path / "a.zarr"
    fp.sweep(SHORT, path, workers=1)
    with lock_of(path).open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        with pytest.raises(fp.InputError, match="a store that no other sweep is writing"):
            fp.sweep(SHORT, path, workers=1)


def test_a_lock_left_by_a_killed_sweep_is_no_lock(tmp_path):
    path = tmp_path / "a.zarr"
    code = (
        "import os, signal, sys; from flypend.studies.sweep.claim import lock_name\n"
        "with lock_name(sys.argv[1]): os.kill(os.getpid(), signal.SIGKILL)"
    )
    done = subprocess.run([sys.executable, "-c", code, str(path)], check=False, timeout=60)
    assert done.returncode == -signal.SIGKILL
    assert lock_of(path).exists()
    fp.sweep(SHORT, path, workers=1)


def test_a_scheduler_that_does_not_answer_is_told(tmp_path, monkeypatch):
    from flypend.studies.sweep import cluster

    monkeypatch.setattr(cluster, "CONNECT", 0.3)
    with pytest.raises(fp.InputError, match=r"^scheduler: expected the address of a Dask scheduler that answers"):
        fp.sweep(SHORT, tmp_path / "a.zarr", scheduler="tcp://127.0.0.1:9")


@pytest.mark.parametrize("ready", [False, True], ids=["a chunk", "its columns"])
def test_what_never_comes_from_a_scheduler_that_is_gone_is_not_waited_for(ready, monkeypatch):
    """Dask's own waits, for a chunk and for its columns, end with what they wait for."""
    import distributed

    from flypend.studies.sweep import cluster

    states = iter(["running"] * 3)
    status = property(lambda _: next(states, "closed"))
    future = type("Future", (), {"result": lambda *_: Future().result(0.01)})()  # not done by then
    methods = {"status": status, "nthreads": lambda _: {"one": 1}, "submit": lambda *_, **__: future}
    client = type("Client", (), methods)()
    monkeypatch.setattr(cluster, "_client", lambda _: nullcontext(client))
    coming = type("Coming", (), {"has_ready": lambda _: ready, "__next__": lambda _: future})()
    monkeypatch.setattr(distributed, "as_completed", lambda _: coming)
    with pytest.raises(fp.InputError, match=r"^scheduler: expected a cluster that stays"):
        next(cluster.fly_chunks("", "", [0], "tcp://127.0.0.1:9"))


def test_the_paper_s_starts_succeed_and_a_torn_gain_does_not(tmp_path):
    """A sweep of one run from experiment 1 agrees with what the paper's figure shows; k_d near 0 does not converge."""
    case = experiment("1")
    table = {
        "vehicle": "nayak2018", "duration": 9.0, "law": {"name": "corrected"}, "plant": "ideal", "runs": 1,
        "start": {name: getattr(case.start, name).tolist() for name in ("x", "x_dot", "R", "omega", "y", "y_dot")},
        "criterion": {"target": "e3", "position": math.inf}, "vary": {"gains": {"k_d": {"values": [1.0, 0.01]}}},
    }  # fmt: skip
    data = fp.sweep(table, tmp_path / "a.zarr", workers=1)
    assert data.success.values.tolist() == [True, False]


def test_a_worker_that_knows_other_equations_is_not_believed():
    from flypend.studies.sweep.chunk import fly_chunk, program_digest

    study = fp.study(SHORT)
    same(fly_chunk(study.text(), 0, program_digest(study)), fly_range(study, 0, 40))
    with pytest.raises(fp.InputError, match=r"^scheduler: expected workers with the flypend of this process"):
        fly_chunk(study.text(), 0, "0" * 64)


def test_a_cluster_that_is_lost_is_told_and_the_store_goes_on(tmp_path, uninterrupted, capfd):
    """The scheduler closes under the sweep: one line; the same sweep on this machine then completes the store."""
    from distributed import LocalCluster

    path = tmp_path / "b.zarr"
    with LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, protocol="tcp", host="127.0.0.1",
        dashboard_address="127.0.0.1:0", memory_limit=0, silence_logs=50,
    ) as cluster:  # fmt: skip

        def tell(done, total):
            if done == 2000:
                cluster.close()

        with pytest.raises(fp.InputError) as caught:
            fp.sweep(LONG, path, scheduler=cluster.scheduler_address, progress=tell)
    assert str(caught.value).startswith("scheduler: expected a cluster that stays")
    assert capfd.readouterr().err == ""  # where Dask would write pages
    assert not (content(path).keys() >= content(uninterrupted).keys())
    fp.sweep(LONG, path, workers=1)
    assert content(path) == content(uninterrupted)
