"""What a store survives: two writers, lost and foreign parts, full and closed disks; and what is never deleted."""

import json
import os
import resource
import shutil
import subprocess
import sys

import pytest
import zarr
from short_study import SHORT, content

import flypend as fp
from flypend.files.toml import toml_text
from flypend.studies.sweep.bins import Runs
from flypend.studies.sweep.claim import lock_name, lock_of
from flypend.studies.sweep.store import find_store
from tests.few import few


@pytest.fixture
def store(tmp_path):
    fp.sweep(SHORT, tmp_path / "a.zarr", workers=1)
    return tmp_path / "a.zarr"


def again(path):
    """Sweep again, and return the numbers of runs that were whole before."""
    told = []
    fp.sweep(SHORT, path, workers=1, progress=lambda done, _: told.append(done))
    return told[0]


# Two writers ----------------------------------------------------------------------------------------------------------


def test_force_does_not_take_the_store_of_a_sweep_that_writes_it(store):
    sound = content(store)
    with lock_name(store), pytest.raises(fp.InputError, match="a store that no other sweep is writing"):
        fp.sweep(SHORT | {"seed": 2}, store, workers=1, force=True)
    assert content(store) == sound


def test_nobody_creates_a_store_beside_a_sweep_that_begins_it(tmp_path):
    path = tmp_path / "a.zarr"
    with lock_name(path), pytest.raises(fp.InputError, match="a store that no other sweep is writing"):
        fp.sweep(SHORT, path, workers=1)
    assert not path.exists()


def test_the_lock_stays_and_is_not_followed(tmp_path):
    """Unlinking a lock splits those who wait for it from those who come later: they lock two files of one name."""
    path = tmp_path / "a.zarr"
    with lock_name(path):
        inode = lock_of(path).stat().st_ino
    assert lock_of(path).stat().st_ino == inode
    lock_of(path).unlink()
    (tmp_path / "thesis.txt").write_text("years of work", encoding="utf-8")
    lock_of(path).symlink_to(tmp_path / "thesis.txt")
    with pytest.raises(fp.InputError, match="lock: expected a file that can be written"):
        fp.sweep(SHORT, path, workers=1)
    assert (tmp_path / "thesis.txt").read_text(encoding="utf-8") == "years of work"
    assert not path.exists()


@pytest.mark.parametrize("change", ["replaced", "removed", "moved"])
def test_a_store_that_is_exchanged_under_a_sweep_is_not_written_into(change, tmp_path):
    path, other = tmp_path / "a.zarr", tmp_path / "b.zarr"
    fp.sweep(SHORT | {"seed": 2}, other, workers=1)
    sound = content(other)

    def tell(done, _):
        if done == 40:
            shutil.move(path, tmp_path / "aside.zarr") if change != "removed" else shutil.rmtree(path)
            if change == "replaced":
                other.rename(path)

    with pytest.raises(fp.InputError, match=r"a\.zarr: expected the store that this sweep has begun"):
        fp.sweep(SHORT, path, workers=1, progress=tell)
    if change == "replaced":
        assert content(path) == sound
    else:
        assert not path.exists()
    if change != "removed":
        assert again(tmp_path / "aside.zarr") == 40


# Lost, cut and foreign parts ------------------------------------------------------------------------------------------


def copy_chunk(store, source, target):
    for column in [path.parent for path in store.glob("*/c")]:
        for file in column.glob(f"c/{source}"):
            goal = column / "c" / target
            shutil.rmtree(goal) if goal.is_dir() else goal.unlink(missing_ok=True)
            (shutil.copytree if file.is_dir() else shutil.copy)(file, goal)


def harmed(store, harm):
    """Do one kind of harm to chunk 1 of the store."""
    target = store / "excursion" / "c" / "1"
    if harm == "cut":
        target.write_bytes(target.read_bytes()[:20])
    elif harm == "lost":
        target.unlink()
    elif harm == "a folder":
        target.unlink()
        target.mkdir()
    elif harm == "foreign":  # every column and the mark: a whole chunk of this study, in the wrong place
        copy_chunk(store, "0", "1")
    elif harm == "swapped column":
        shutil.copy(store / "excursion" / "c" / "0", target)
    elif harm == "cut mark":
        (store / "whole" / "c" / "1").write_bytes(b"")
    elif harm == "last":  # a chunk that is not full: Zarr would read before it writes
        (store / "excursion" / "c" / "2").write_bytes(b"nothing that Blosc knows")


HARMS = ["cut", "lost", "foreign", "swapped column", "cut mark", "last"]


@pytest.mark.parametrize("harm", HARMS)
def test_a_harmed_chunk_is_refused_by_map_and_flown_again_by_sweep(harm, store):
    sound = content(store)
    harmed(store, harm)
    with pytest.raises(fp.InputError, match=r"a\.zarr: expected chunk [12] as it was written"):
        Runs(store).gather([])
    assert again(store) == (80 if harm == "last" else 60)
    assert content(store) == sound


def test_a_folder_in_place_of_a_chunk_is_told(store):
    harmed(store, "a folder")
    with pytest.raises(fp.InputError, match=r"a\.zarr: expected chunk 1 as it was written"):
        Runs(store).gather([])
    with pytest.raises(
        fp.InputError, match=r"excursion/c/1: expected a file that can be written .*, got Is a directory"
    ):
        again(store)
    (store / "excursion" / "c" / "1").rmdir()
    assert again(store) == 60


@pytest.mark.parametrize("harm", ["lost", "garbage", "other type", "other chunks", "other units"])
@pytest.mark.parametrize("column", ["excursion", "y", "whole"])
def test_a_column_s_metadata_is_restored_by_sweep_and_missed_by_map(harm, column, store):
    sound = content(store)
    target = store / column / "zarr.json"
    told = json.loads(target.read_text(encoding="utf-8"))
    if harm == "lost":
        target.unlink()
    elif harm == "garbage":
        target.write_text("{", encoding="utf-8")
    elif harm == "other type":
        target.write_text(json.dumps(told | {"data_type": "int32", "fill_value": 0}), encoding="utf-8")
    elif harm == "other chunks":
        told["chunk_grid"]["configuration"]["chunk_shape"][0] = 10**12
        target.write_text(json.dumps(told), encoding="utf-8")
    else:
        target.write_text(json.dumps(told | {"attributes": {"units": "furlong"}}), encoding="utf-8")
    with pytest.raises(fp.InputError, match=rf"a\.zarr: expected the metadata of {column} as they were written"):
        Runs(store)
    assert again(store) == 100
    assert content(store) == sound


@pytest.mark.parametrize(("old", "new"), [("seed = 1", "seed = 2"), ("runs = 100", "runs = 99999999"), ('"corr', '"c')])
def test_a_store_whose_attributes_were_changed_is_refused(old, new, store):
    root = json.loads((store / "zarr.json").read_text(encoding="utf-8"))
    study = root["attributes"]["study"]
    root["attributes"]["study"] = study.replace(old, new)
    assert root["attributes"]["study"] != study
    (store / "zarr.json").write_text(json.dumps(root), encoding="utf-8")
    for use in (Runs, again):
        with pytest.raises(fp.InputError, match=r"a\.zarr: expected the attributes that a sweep has written"):
            use(store)
    fp.sweep(SHORT, store, workers=1, force=True)
    assert Runs(store).number == 100


# Disks that are full, closed or gone ----------------------------------------------------------------------------------


def run_limited(folder, *, limit):
    """Sweep in a process whose files may not pass `limit` bytes."""
    (folder / "study.toml").write_text(toml_text(SHORT), encoding="utf-8")
    command = [sys.executable, "-m", "flypend", "sweep", "study.toml", "-o", "a.zarr", "--workers", "1"]
    return subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=60, check=False,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},  # byte code that is cut off would stay
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
    )  # fmt: skip


@pytest.mark.parametrize("limit", few((0, 4000), (0, 200, 500, 4000)))
def test_a_file_that_may_not_grow_is_one_line_and_what_is_there_goes_on(limit, tmp_path):
    """The limits end it at the lock or the metadata, at the first columns, and not at all."""
    done = run_limited(tmp_path, limit=limit)
    if limit < 4000:
        assert done.returncode == 2
        assert done.stderr.count("\n") == 1
        assert "File too large" in done.stderr
    assert again(tmp_path / "a.zarr") <= 100
    assert Runs(tmp_path / "a.zarr").number == 100
    assert not list(tmp_path.rglob("*.partial"))


def test_a_full_disk_is_one_line_and_the_sweep_goes_on(tmp_path, monkeypatch):
    """The system's answer is put in place of the write of the third chunk."""
    path = tmp_path / "a.zarr"
    write = zarr.Array.__setitem__
    written = []

    def full(self, *given):
        written.append(self.name)
        if len(written) > 19:  # of sixteen for each chunk
            raise OSError(28, "No space left on device", str(path / "excursion" / "c" / "1"))
        write(self, *given)

    monkeypatch.setattr(zarr.Array, "__setitem__", full)
    with pytest.raises(fp.InputError, match=r"expected a file that can be written .*, got No space left on device"):
        fp.sweep(SHORT, path, workers=1)
    monkeypatch.undo()
    assert again(path) == 40


@pytest.mark.skipif(os.geteuid() == 0, reason="root writes into folders that forbid it")
def test_a_closed_folder_is_one_line(store):
    store.parent.chmod(0o555)
    try:
        lock_of(store).chmod(0o444)
        with pytest.raises(fp.InputError, match="expected a file that can be written"):
            again(store)
    finally:
        store.parent.chmod(0o755)


# What is left and what is kept ----------------------------------------------------------------------------------------


def test_what_killed_sweeps_left_is_cleared_and_what_is_the_user_s_is_kept(store):
    folder = store.parent
    name = "0123456789abcdef" * 2
    ours = [
        folder / f".a.zarr.{name}.partial" / "zarr.json",
        folder / f".a.zarr.{name}.removed" / "excursion" / "c" / "0",
        store / "excursion" / "c" / f"7.{name}.partial",
        store / "excursion" / f"zarr.{name}.partial",
    ]
    users = [
        folder / ".a.partial" / "thesis.txt",
        folder / f".a.zarr.{name[::-1]}.partial" / "thesis.txt",
        folder / f".b.zarr.{name}.partial" / "zarr.json",  # of another store, which may be in use
        store / "excursion" / "notes.partial",
    ]
    for path in ours + users:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("text", encoding="utf-8")
    (folder / f".a.zarr.{'f' * 32}.partial").symlink_to(folder / ".a.partial")
    again(store)
    assert not any(path.exists() for path in ours)
    assert all(path.exists() for path in users)
    assert not (folder / f".a.zarr.{name}.partial").exists()
    assert (folder / f".a.zarr.{'f' * 32}.partial").is_symlink()


def test_force_keeps_what_no_sweep_has_written(store):
    (store / "thesis.txt").write_text("years of work", encoding="utf-8")
    with pytest.raises(fp.InputError, match=r"a\.zarr: expected nothing but a store, got thesis\.txt"):
        fp.sweep(SHORT, store, workers=1, force=True)
    assert (store / "thesis.txt").exists()


def test_a_store_is_found_through_a_link_and_its_lock_is_one(store):
    link = store.parent / "link.zarr"
    link.symlink_to(store)
    assert lock_of(link) == lock_of(store)
    assert again(link) == 100


def test_an_interrupted_removal_leaves_no_store(store, monkeypatch):
    """A kill inside --force: the store is gone as a whole, and the next sweep clears the rest."""
    monkeypatch.setattr(shutil, "rmtree", lambda *_, **__: (_ for _ in ()).throw(KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        fp.sweep(SHORT, store, workers=1, force=True)
    monkeypatch.undo()
    assert not store.exists()
    assert len(list(store.parent.glob(".a.zarr.*.removed"))) == 1
    assert again(store) == 0
    assert not list(store.parent.glob(".a.zarr.*.removed"))


def test_two_stores_have_two_ids(tmp_path):
    for name in ("a.zarr", "b.zarr"):
        fp.sweep(SHORT, tmp_path / name, workers=1)
    ids = {find_store(tmp_path / name).attributes["id"] for name in ("a.zarr", "b.zarr")}
    assert len(ids) == 2
    assert content(tmp_path / "a.zarr") == content(tmp_path / "b.zarr")
