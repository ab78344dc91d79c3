"""Commands on disks that are read-only or full: one line, code 2, nothing lost. The disks are mounted, as root."""

import re
import subprocess

import pytest
from short_study import SHORT, content

import flypend as fp
from flypend.files.toml import toml_text
from flypend.studies.sweep.store import find_store

# Every command that writes, with what it reads in the folder above the disk.
COMMANDS = {
    "run": ("run", "4", "--set", "duration=0.1", "--no-figures", "--out", "disk/out"),
    "run, its replay": ("run", "4", "--set", "duration=0.1", "--no-figures", "-o", "out", "--html", "disk/a.html"),
    "paper": ("paper", "--quick", "--out", "disk/out"),
    "theorem": ("theorem", "--out", "disk/out"),
    "compare": ("compare", "--runs", "1", "--duration", "1", "--out", "disk/out"),
    "compare, its flights": ("compare", "--runs", "1", "--duration", "1", "--out", "out", "--keep", "disk/out"),
    "ladder": ("ladder", "--runs", "1", "--duration", "1", "--out", "disk/out"),
    "sweep": ("sweep", "study.toml", "-o", "disk/a.zarr", "--workers", "1"),
    "map": ("map", "sound.zarr", "-o", "disk/map.png"),
    "map of a study": ("map", "study.toml", "-o", "disk/map.png", "--workers", "1"),
    "tune": ("tune", "study.toml", "-o", "disk/tuned", "--workers", "1"),
    "replay": ("replay", "run.nc", "-o", "disk/a.html"),
    "figures": ("figures", "run.nc", "-o", "disk/figures"),
    "movie": ("movie", "run.nc", "-o", "disk/a.mp4"),
    "export-c": ("export-c", "--law", "lqr", "--vehicle", "hehn2011", "-o", "disk/c"),
    "export-app": ("export-app", "crazyflie", "crazyflie", "-o", "disk/app"),
    "examples": ("examples", "-o", "disk/examples"),
}  # fmt: skip


class Disk:
    """A file system of its own in `folder`."""

    def __init__(self, folder):
        self.folder = folder
        folder.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "tmpfs", folder], capture_output=True, check=False).returncode:
            pytest.skip("only root may mount")

    def set(self, options):
        subprocess.run(["mount", "-o", f"remount,{options}", self.folder], check=True)


@pytest.fixture
def disk(tmp_path):
    made = Disk(tmp_path / "disk")
    yield made
    subprocess.run(["umount", made.folder], check=True)


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("inputs")
    (folder / "study.toml").write_text(toml_text(SHORT), encoding="utf-8")
    fp.sweep(SHORT, folder / "sound.zarr", workers=1)
    fp.simulate(fp.vehicle("hehn2011"), fp.laws.lqr(), fp.State(y=(0, 0, 1.0)), 0.1).save(folder / "run.nc")
    return folder


def link(inputs, folder):
    """Make the inputs appear in `folder`."""
    for path in inputs.iterdir():
        (folder / path.name).symlink_to(path)


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_a_read_only_disk_is_one_line_and_code_2(command, disk, inputs, call, tmp_path):
    link(inputs, tmp_path)
    disk.set("ro")
    code, _, complaints = call(*command)
    assert (code, complaints.count("\n")) == (2, 1), complaints
    assert complaints.startswith("flypend: ")
    assert re.search("disk[/:]", complaints)
    assert complaints.endswith(", got Read-only file system\n")
    assert not (tmp_path / "out").exists()


def test_what_lies_on_a_read_only_disk_is_read(disk, inputs, call):
    subprocess.run(["cp", "-r", *inputs.iterdir(), disk.folder], check=True)
    disk.set("ro")
    assert call("map", "disk/sound.zarr", "-o", "map.png")[0] == 0
    assert call("replay", "disk/run.nc")[0] == 0
    assert call("run", "4", "--set", "duration=0.1", "--no-figures")[0] == 0
    assert len(fp.study(disk.folder / "study.toml").text()) > 0


def test_a_cache_on_a_read_only_disk_is_no_error(disk, call, monkeypatch):
    disk.set("ro")
    monkeypatch.setenv("FLYPEND_CACHE", str(disk.folder / "cache"))
    code, _, complaints = call("run", "4", "--set", "duration=0.1", "--set", "law.gains.k_d=2.5", "--no-figures")
    assert (code, complaints) == (0, "")


def test_a_cache_on_a_full_disk_is_no_error(disk, call, monkeypatch):
    disk.set("size=4k")
    monkeypatch.setenv("FLYPEND_CACHE", str(disk.folder / "cache"))
    code, _, complaints = call("run", "4", "--set", "duration=0.1", "--set", "law.gains.k_d=2.25", "--no-figures")
    assert (code, complaints) == (0, "")
    assert list((disk.folder / "cache").iterdir()) == []


def test_a_sweep_goes_on_where_the_disk_was_closed_or_full(disk, inputs, call, tmp_path):
    link(inputs, tmp_path)
    sweep, path, left = ("sweep", "study.toml", "-o", "disk/a.zarr", "--workers", "1"), disk.folder / "a.zarr", set()
    for size in range(4, 1000, 12):  # kB
        disk.set(f"size={size}k")
        code, _, complaints = call(*sweep)
        if code == 0:
            break
        assert (code, complaints.count("\n")) == (2, 1), complaints
        assert complaints.endswith(", got No space left on device\n")
        left.add(sum(find_store(path).is_flown(k) for k in range(3)) if path.exists() else -1)
        if left & {1, 2}:
            disk.set("ro")
            assert call(*sweep)[0] == 2
            disk.set("rw")
    assert code == 0
    assert left >= {-1, 0, 1}  # it was full before the store, before its first chunk, and between two
    assert content(disk.folder / "a.zarr") == content(inputs / "sound.zarr")
    assert not list(disk.folder.rglob("*.partial"))
