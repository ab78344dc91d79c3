"""Stores under attack: killed sweeps, two that start at once, and mutated files.

The small numbers run with every test; `pytest -m slow tests/studies/test_attacks.py -s` runs the full ones and prints
the counts of docs/reliability.md.
"""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter

import pytest
import zarr
from short_study import SHORT, content

import flypend as fp
from flypend.files.toml import toml_text
from flypend.studies.sweep.bins import Runs, sphere
from flypend.studies.sweep.store import Store, _seal, find_store

TENS = SHORT | {"chunk": 10}
SMALL = TENS | {"runs": 20}
LONG = TENS | {"runs": 400, "chunk": 20, "duration": 6.0, "rtol": 1e-9}
CHUNKS = 20
NUMBERS = [float("nan"), float("inf"), -1.0, 0.0, 1e30, 2.0]
TOML = ["-1", "0", "1e300", "nan", "inf", '"x"', "[]", "true", "{}", "1000000000", "[1.0]", "1979-05-27", "2"]
# A process that has imported and compiled everything forks one for every command: they start within a millisecond.
FORKS = """
import json, os, sys
import zarr, xarray, joblib
from flypend.cli.app import main
from flypend.studies.sweep import run, study
for line in sys.stdin:
    asked = json.loads(line)
    if "warm" in asked:
        run.fly_range(study(asked["warm"]), 0, 1)
        print("warm", flush=True)
    elif "wait" in asked:
        print(os.waitstatus_to_exitcode(os.waitpid(asked["wait"], 0)[1]), flush=True)
    elif child := os.fork():
        print(child, flush=True)
    else:
        os.chdir(asked["folder"])
        os.dup2(os.open(asked["told"], os.O_WRONLY | os.O_CREAT | os.O_TRUNC), 2)
        os.dup2(2, 1)
        sys.argv = ["flypend", *asked["arguments"]]
        try:
            main()
        except SystemExit as end:
            code = end.code
        except BaseException:
            sys.excepthook(*sys.exc_info())
            code = 99
        sys.stdout.flush(), sys.stderr.flush()
        os._exit(code)
"""


class Forks:
    """Commands that start at once; each tells what it has to say in a file of its own."""

    def __init__(self, folder):
        pipe = subprocess.PIPE
        self._folder, self._count = folder, 0
        self._process = subprocess.Popen([sys.executable, "-c", FORKS], stdin=pipe, stdout=pipe, text=True)
        for path in folder.glob("*.toml"):
            assert self._asked(warm=str(path)) == "warm"

    def _asked(self, **what):
        self._process.stdin.write(json.dumps(what) + "\n")
        self._process.stdin.flush()
        return self._process.stdout.readline().strip()

    def start(self, *arguments):
        """Start `flypend` with these arguments, and return its number and the file of what it says."""
        self._count += 1
        told = self._folder / f"{self._count % 4}.txt"
        return int(self._asked(folder=str(self._folder), told=str(told), arguments=arguments)), told

    def end(self, number):
        """Wait for a command, and return its exit code; negative if a signal ended it."""
        return int(self._asked(wait=number))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.stdin.close()
        self._process.wait(60)
        self._process.stdout.close()


def written(folder, name, table):
    (folder / name).write_text(toml_text(table), encoding="utf-8")


# Two writers ----------------------------------------------------------------------------------------------------------


def attack_double_starts(number, folder):
    """Two commands start on one store at once, of one study or of two; by exit codes."""
    found = Counter()
    for seed in (1, 2):
        written(folder, f"{seed}.toml", TENS | {"seed": seed})
    with Forks(folder) as forks:
        for k in range(number):
            name, force = f"{k}.zarr", ("--force",) * (k % 3 == 2)
            files = ("1.toml", f"{1 + k % 2}.toml")
            started = [forks.start("sweep", file, "-o", name, "--workers", "1", *force) for file in files]
            codes = sorted(forks.end(process) for process, _ in started)
            lines = [told.read_text(encoding="utf-8") for _, told in started]
            assert codes in ([0, 0], [0, 2]), lines
            assert not any("Traceback" in line for line in lines), lines
            if codes == [0, 2]:
                assert any("no other sweep is writing" in line or "seed: expected" in line for line in lines), lines
            found[tuple(codes)] += 1
            whole = Runs(folder / name)
            assert whole.number == 100
            whole.gather([])  # every chunk is of the study that the attributes name
            assert {path.name for path in folder.glob(f"*{name}*")} >= {name, f".{name}.lock"}
            assert not list(folder.glob(".*.partial")), list(folder.iterdir())
            assert not list(folder.glob(".*.removed"))
    return found


def test_of_two_that_start_at_once_one_flies_and_one_is_told(tmp_path):
    attack_double_starts(2, tmp_path)


@pytest.mark.slow
def test_150_double_starts(tmp_path):
    print("150 double starts, by exit codes:", dict(attack_double_starts(150, tmp_path)))


# Kills ----------------------------------------------------------------------------------------------------------------


def attack_kills(number, seed, folder):
    """Kill a sweep `number` times at random moments, starting it again each time; by what the kill left.

    The moments lie within two thirds of the time that an uninterrupted sweep takes. A sweep that is finished is
    compared with one that was never interrupted, and begun again.
    """
    rng, found, path = random.Random(seed), Counter(), folder / "b.zarr"
    written(folder, "study.toml", LONG)
    with Forks(folder) as forks:
        begin = time.monotonic()
        assert forks.end(forks.start("sweep", "study.toml", "-o", "whole.zarr", "--workers", "1")[0]) == 0
        span = time.monotonic() - begin
        sound = content(folder / "whole.zarr")
        for _ in range(number):
            process, told = forks.start("sweep", "study.toml", "-o", "b.zarr", "--workers", "1")
            time.sleep(2 / 3 * span * rng.random())
            os.kill(process, signal.SIGKILL)
            code = forks.end(process)
            assert code in (0, -signal.SIGKILL), told.read_text(encoding="utf-8")
            marks = sum(find_store(path).is_flown(k) for k in range(CHUNKS)) if path.exists() else -1
            found["no store" if marks < 0 else "none" if marks == 0 else "some" if marks < CHUNKS else "all"] += 1
            if marks == CHUNKS:
                fp.sweep(LONG, path, workers=1)
                assert content(path) == sound
                shutil.rmtree(path)
    fp.sweep(LONG, path, workers=1)
    assert content(path) == sound
    assert {entry.name for entry in folder.glob("*b.zarr*")} == {"b.zarr", ".b.zarr.lock"}
    return found


def test_random_kills_change_nothing(tmp_path):
    attack_kills(2, 1, tmp_path)


@pytest.mark.slow
def test_200_random_kills(tmp_path):
    print("200 random kills, by the chunks that they left:", dict(attack_kills(200, 2, tmp_path)))


# Mutated stores -------------------------------------------------------------------------------------------------------


def mutate(store, rng):
    """Harm one to three files of a store: change, cut, lose, exchange, empty, or put a folder in their place."""
    for _ in range(rng.choice([1, 1, 2, 3])):
        files = sorted(path for path in store.rglob("*") if path.is_file())
        path = rng.choice(files)
        kind = rng.choice(["flip", "flip", "cut", "lose", "copy", "empty", "grow", "folder"])
        bytes_ = bytearray(path.read_bytes())
        if kind == "flip" and bytes_:
            for _ in range(rng.choice([1, 1, 8])):
                bytes_[rng.randrange(len(bytes_))] ^= 1 << rng.randrange(8)
            path.write_bytes(bytes_)
        elif kind == "cut":
            path.write_bytes(bytes_[: rng.randrange(len(bytes_) + 1)])
        elif kind == "lose":
            path.unlink()
        elif kind == "copy":
            path.write_bytes(rng.choice(files).read_bytes())
        elif kind == "empty":
            path.write_bytes(b"")
        elif kind == "grow":
            path.write_bytes(bytes_ + rng.randbytes(rng.choice([1, 100])))
        else:
            path.unlink()
            path.mkdir()


def mutate_behind(store, rng):
    """Change numbers, a study or an attribute of a store, and renew its marks and its seal, as one would on purpose."""
    group = zarr.open_group(store, mode="r+", zarr_format=3)
    about = dict(group.attrs)
    how = rng.choice(["number"] * 4 + ["study", "study", "attribute", "bomb", "codec"])
    name = rng.choice([name for name, _ in group.arrays() if name != "whole"])
    if how == "number":
        array = group[name]
        spot = (rng.randrange(array.shape[0]), *(0,) * (array.ndim - 1))
        array[spot] = rng.choice([0, 1, 7, 200]) if array.dtype.kind in "ub" else rng.choice(NUMBERS)
    elif how == "study":
        lines = str(about["study"]).split("\n")
        line = rng.randrange(len(lines))
        key = lines[line].split(" = ")[0]
        lines[line] = rng.choice([f"{key} = {value}" for value in TOML] + ["", "[vary.gains]", "a." * 9000 + "b = 1"])
        about["study"] = "\n".join(lines)
    elif how == "attribute":
        which = rng.choice(sorted(about))
        about[which] = rng.choice([3, None, [], {}, "x", "up"])
        if rng.random() < 0.3:
            del about[which]
    elif how == "bomb":  # 2 GB, as the head of the chunk says, of a few bytes
        for chunk in (store / name / "c").rglob("0"):
            if chunk.is_file():
                chunk.write_bytes(chunk.read_bytes()[:4] + (2**31 - 64).to_bytes(4, "little") * 2 + bytes(40))
    else:
        target = store / name / "zarr.json"
        target.write_text(target.read_text(encoding="utf-8").replace("zstd", "lz4"), encoding="utf-8")
    about["seal"] = _seal(about)
    group.attrs.put(about)
    if how in ("number", "study"):
        renew_marks(store, group, about["seal"])


def renew_marks(store, group, seal):
    """Renew the marks of a store whose attributes have this `seal`."""
    names = sorted(name for name, _ in group.arrays() if name != "whole")
    for number in range(group["whole"].shape[0]):
        kept = object.__new__(Store)
        kept.attributes, kept._arrays = {"seal": seal}, dict.fromkeys(names)
        rows = slice(10 * number, 10 * (number + 1))
        group["whole"][number] = kept._digest(number, {name: group[name][rows] for name in names})


def attack_behind(number, seed, folder):
    """Read stores changed behind their seals and digests: what is read is as a store's columns are, and is mapped."""
    rng, ends, study = random.Random(seed), Counter(), fp.study(SMALL)
    fp.sweep(study, folder / "sound.zarr", workers=1)
    path = folder / "a.zarr"
    for k in range(number):
        shutil.copytree(folder / "sound.zarr", path)
        mutate_behind(path, rng)
        begin = time.process_time()
        try:
            runs = Runs(path)
            (found,) = runs.gather([sphere(runs.study, 4)])
            assert found.runs.sum() == runs.number, (seed, k)
            assert (found.causes.sum(axis=0) == found.runs).all(), (seed, k)
            ends["read"] += 1
        except fp.InputError as error:
            ends["in lines" if "\n" in str(error) else "refused"] += 1
        assert time.process_time() - begin < 10, (seed, k)
        shutil.rmtree(path)
    return ends


def test_stores_changed_behind_their_digests_are_read_or_refused(tmp_path):
    ends = attack_behind(40, 1, tmp_path)
    assert ends.keys() == {"read", "refused"}
    assert ends["refused"] > 10


@pytest.mark.slow
def test_1000_stores_changed_behind_their_digests(tmp_path):
    print("1,000 stores, changed behind their digests:", dict(attack_behind(1000, 2, tmp_path)))


def attack_stores(number, seed, folder):
    """Read and mend mutated stores: nothing but InputError, no wrong number, and after a sweep all numbers."""
    rng, ends, study = random.Random(seed), Counter(), fp.study(SMALL)
    fp.sweep(study, folder / "sound.zarr", workers=1)
    numbers = read(folder / "sound.zarr")
    path = folder / "a.zarr"
    for k in range(number):
        shutil.copytree(folder / "sound.zarr", path)
        mutate(path, rng)
        begin = time.process_time()
        try:
            found = read(path)
            assert right(found, numbers), (seed, k)  # whatever part of the store is left
            ends["read, every number right"] += 1
        except fp.InputError:
            ends["refused by readers"] += 1
        try:
            fp.sweep(study, path, workers=1)
            assert right(read(path), numbers), (seed, k)
            assert len(read(path)) == len(numbers), (seed, k)
            ends["mended by sweep"] += 1
        except fp.InputError:
            ends["refused by sweep"] += 1
        assert time.process_time() - begin < 10, (seed, k)
        shutil.rmtree(path)
    return ends


def read(path):
    """All chunks that a store says are flown."""
    store = find_store(path)
    return {number: store.read(number) for number in range(store.study.chunks) if store.is_flown(number)}


def right(found, numbers):
    """Whether every number in the chunks `found` is that of the sound store, bit by bit."""
    return all(
        column.tobytes() == numbers[chunk][name].tobytes()
        for chunk, columns in found.items()
        for name, column in columns.items()
    )


def test_mutated_stores_are_mended_or_refused_and_never_believed(tmp_path):
    ends = attack_stores(25, 1, tmp_path)
    assert ends["mended by sweep"] > 10


@pytest.mark.slow
def test_3000_mutated_stores(tmp_path):
    print("3,000 mutated stores:", dict(attack_stores(3000, 2, tmp_path)))
