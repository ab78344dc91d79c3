"""Signals at random moments of commands, and streams that are closed or full.

A command ends with 130 or 143, one line and no traceback; its output is absent or whole. A few moments run with every
test; `pytest -m slow tests/cli/test_signals.py -s` runs them all and prints the counts of docs/reliability.md.
"""

import os
import random
import shlex
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest

import flypend as fp
from flypend.files.toml import toml_text

LINES = {signal.SIGINT: "flypend: interrupted", signal.SIGTERM: "flypend: terminated"}
HINT = "Finished work is kept. To resume: flypend "
STUDY = {
    "vehicle": "hehn2011", "law": {"name": "inverted"}, "duration": 3.0, "judge_period": 0.1, "runs": 4000,
    "chunk": 100, "seed": 1, "vary": {"start": {"y": "uniform"}},
    "tune": {"gains": {"position_bandwidth": [1.0, 4.0]}, "generations": 8, "runs": 100},
}  # fmt: skip
NMPC = "run swing.toml --law nmpc --no-figures -o out"
COMMANDS = (
    "run 1 -o out",
    "run swing.toml --no-figures -o out",
    NMPC,
    "run swing.toml --controller c --no-figures -o out",
    "paper -o out",
    "compare --law inverted --law lqr --runs 300 -o out",
    "compare --law mine.py:hold --runs 20 --duration 2 -o out",
    "ladder --law inverted --runs 20 --duration 3 -o out",
    "check hehn2011 -o out",
    "plan -o out.nc",
    "plan --fly mujoco -o out.nc",
    "map --law lqr --runs 5000 -o out.png",
    "sweep study.toml -o out.zarr",
    "sweep study.toml --processes --workers 2 -o out.zarr",
    "tune study.toml -o out",
    "learn --updates 2 --runs 20 -o out",
    "figures flown.nc -o out",
    "movie flown.nc -o out.mp4",
    "replay flown.nc -o out.html",
    "export-c -o out",
    "theorem --runs 20 -o out",
    "lab --html out.html",
)
RESUMABLE = {"map", "sweep", "tune", "learn"}
MINE = """
from flypend import Controller, Wrench
def hold():
    return Controller(name="hold", function=lambda t, state: Wrench(5.0, (0.0, 0.0, 0.0)), rate=100.0)
"""
LONGEST = 12.0  # s: later moments of a command are not attacked
STAYS = 20.0  # s that a worker may take to notice that its parent is gone


@pytest.fixture(scope="module")
def prepared(tmp_path_factory):
    """A folder with what the commands need, and a cache of machine code beside it."""
    folder = tmp_path_factory.mktemp("signals") / "prepared"
    folder.mkdir()
    (folder / "study.toml").write_text(toml_text(STUDY), encoding="utf-8")
    (folder / "short.toml").write_text(toml_text({**STUDY, "runs": 1000}), encoding="utf-8")
    swing = {"vehicle": "hehn2011", "law": {"name": "inverted"}, "duration": 3.0, "start": {"y": [0.0, 0.0, -1.0]}}
    (folder / "swing.toml").write_text(toml_text(swing), encoding="utf-8")
    (folder / "mine.py").write_text(MINE, encoding="utf-8")
    fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, -1.0)), 3.0).save(folder / "flown.nc")
    return folder


def started(command, folder, cache):
    """Start a command in a session of its own, so that all of its processes can be told, as a terminal does."""
    environment = {**os.environ, "FLYPEND_CACHE": str(cache)}
    return subprocess.Popen(
        [sys.executable, "-m", "flypend", *shlex.split(command)], cwd=folder, env=environment,
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
        # Whoever runs the tests in the background ignores SIGINT, and so would the process.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )  # fmt: skip


def begun(process):
    """Wait until the first line of the command's entry, until when Python has both signals to itself."""
    while process.poll() is None:
        status = Path(f"/proc/{process.pid}/status").read_text(encoding="ascii")
        caught = int(next(line for line in status.splitlines() if line.startswith("SigCgt")).split()[1], 16)
        if caught >> (signal.SIGTERM - 1) & 1:
            return
        time.sleep(0.0005)


def written(folder, prepared):
    """What a command has written into `folder`, a copy of `prepared`: its files, those in stores left out."""
    known = {path.name for path in prepared.iterdir()} | {"__pycache__", "cache"}
    found = {path.relative_to(folder) for path in folder.rglob("*") if path.relative_to(folder).parts[0] not in known}
    return {path for path in found if not path.parts[0].endswith((".zarr", ".lock")) and (folder / path).is_file()}


def survivors(group):
    """Whether a process of the `group` is alive after a while."""
    end = time.monotonic() + STAYS
    while time.monotonic() < end:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return False
        time.sleep(0.05)
    os.killpg(group, signal.SIGKILL)
    return True


class Shot:
    """A signal to a command `wait` seconds after its entry; if nobody stops it, it writes `whole` and says `notes`."""

    def __init__(self, command, number, wait, folder, cache, prepared, whole, notes):
        what = f"{command}, signal {number} after {wait:.3f} s"
        with started(command, folder, cache) as process:
            begun(process)
            time.sleep(wait)
            sent = time.monotonic()
            # Ctrl-C reaches all processes of a terminal.
            if process.poll() is None:
                (os.killpg if number == signal.SIGINT else os.kill)(process.pid, number)
            _, told = process.communicate(timeout=120)
            self.took = time.monotonic() - sent
        self.finished = process.returncode in (0, 1)
        assert "Traceback" not in told, f"{what}: {told}"
        assert not survivors(process.pid), what
        left = written(folder, prepared)
        assert not [path for path in left if ".partial" in str(path) or "-partial-" in str(path)], f"{what}: {left}"
        if self.finished:
            assert told == notes, f"{what}: {told}"
            return
        assert process.returncode == 128 + number, f"{what}: code {process.returncode}, {told}"
        lines = [line for line in told.splitlines() if line not in notes.splitlines()]
        assert lines[-1:] == [LINES[number]], f"{what}: {told}"
        if command.split()[0] in RESUMABLE and lines[0].startswith(HINT):
            lines = lines[1:]
            left = {path for path in left if path.suffix not in (".jsonl", ".npz")}
        assert len(lines) == 1, f"{what}: {told}"
        assert not left or left == whole, f"{what}: {left} of {whole}"


def attack(commands, shots, seed, prepared, *, numbers=tuple(LINES), cold=3):
    """Send a signal at a random moment of each of `commands` in turn; every `cold`th has no machine code yet."""
    rng, found, failures, slowest = random.Random(seed), Counter(), [], (0.0, "")
    cache, spans, wholes, notes = prepared.parent / "cache", {}, {}, {}
    for k in range(shots):
        command = commands[k % len(commands)]
        folder = prepared.parent / f"shot-{seed}-{k}"
        if command not in spans:
            shutil.copytree(prepared, folder)
            begin = time.monotonic()
            with started(command, folder, cache) as process:
                notes[command] = process.communicate()[1]
            assert process.returncode in (0, 1), notes[command]
            spans[command] = time.monotonic() - begin
            wholes[command] = written(folder, prepared)
            shutil.rmtree(folder)
        shutil.copytree(prepared, folder)
        number, wait = rng.choice(numbers), rng.uniform(0.0, min(LONGEST, spans[command]))
        empty = k % cold == cold - 1
        own = folder / "cache" if empty else cache
        try:
            shot = Shot(command, number, wait, folder, own, prepared, wholes[command], notes[command])
        except AssertionError as error:
            print(error, flush=True)
            failures.append(str(error))
            continue
        found["finished before" if shot.finished else f"{128 + number}"] += 1
        print(f"{k}: {command}, {number.name} after {wait:.2f} s, ended after {shot.took:.2f} s", flush=True)
        if not shot.finished:
            slowest = max(slowest, (shot.took, f"{command}, {wait:.2f} s"))
        shutil.rmtree(folder)
    assert not failures, "\n\n".join(failures)
    return dict(found), slowest


def test_signals_at_random_moments(prepared):
    attack(["run 1 --no-figures -o out", "sweep short.toml -o out.zarr", "export-c -o out"], 3, 3, prepared)


@pytest.mark.parametrize("number", LINES)
def test_signals_while_it_starts(number, prepared, tmp_path):
    """Within the first tenth of a second, which is all imports."""
    for k in range(4):
        shot = Shot("laws", number, 0.025 * k, tmp_path, prepared.parent / "cache", tmp_path, set(), "")
        assert not shot.finished


@pytest.mark.slow
def test_100_signals_at_random_moments(prepared):
    found, (took, where) = attack(COMMANDS, 100, 1, prepared)
    print(f"100 signals, by exit code: {found}; the slowest ended after {took:.2f} s ({where})")


@pytest.mark.slow
def test_40_terminations_of_nmpc_flights(prepared):
    found, (took, where) = attack([NMPC], 40, 2, prepared, numbers=[signal.SIGTERM])
    print(f"40 SIGTERMs in flights of nmpc, by exit code: {found}; the slowest ended after {took:.2f} s ({where})")


def test_a_signal_at_the_end_of_the_interpreter_comes_too_late():
    """It had undone the handlers, and a process that had done its work was killed."""
    code = """
import os, signal
from flypend import signals
signals.install()
class Last:
    kill, process, number = os.kill, os.getpid(), signal.SIGINT
    def __del__(self):
        self.kill(self.process, self.number)
last = Last()
"""
    assert subprocess.run([sys.executable, "-c", code], timeout=60, check=False).returncode == 0


# Streams --------------------------------------------------------------------------------------------------------------

NOWHERE = "flypend: stdout: expected a file that can be written, got "
FULL, CLOSED = NOWHERE + "No space left on device\n", NOWHERE + "Bad file descriptor\n"


@pytest.mark.parametrize(
    ("line", "code", "told"),
    [
        ("flypend laws >/dev/full", 2, FULL),
        ("flypend --help >/dev/full", 2, FULL),
        ("flypend laws >&-", 2, CLOSED),
        ("flypend laws | true; exit ${PIPESTATUS[0]}", 141, ""),
        ("flypend --version | true; exit ${PIPESTATUS[0]}", 141, ""),
        ("flypend laws nope 2>/dev/full", 2, ""),
        ("flypend laws nope 2>&-", 2, ""),
        ("flypend laws 2>&- >/dev/null", 0, ""),
        ("flypend laws <&- >&- 2>&-", 2, ""),
        ("flypend run 4 --set duration=0.1 --no-figures <&- >&- -o out", 2, CLOSED),
        ("flypend run 4 --set duration=0.1 --no-figures >/dev/full -o out", 2, FULL),
    ],
)
def test_output_that_cannot_be_printed_is_told_in_one_line(line, code, told, tmp_path):
    """What goes into files is written all the same."""
    shell = f'flypend() {{ {shlex.quote(sys.executable)} -m flypend "$@"; }}; {line}'
    done = subprocess.run(["bash", "-c", shell], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (code, told)
    assert (tmp_path / "out" / "run.nc").exists() == ("-o out" in line)
