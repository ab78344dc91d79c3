"""Today's figures beside those of version 0.1, flown in turns in the same run: `python -m benchmarks.versions`.

Version 0.1 comes from the history of this repository, into a temporary folder; where that is missing, as in a shallow
clone, the figures recorded on 2026-11-21 (AMD EPYC, 2 cores) stand in for it. Its commands need typer, from the group
"bench".
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tarfile
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import NamedTuple

from benchmarks.lines import Line

COMMIT = "330e342"
ROOT = Path(__file__).parents[1]
TURNS = 3
RECORDED = {
    "unjudged": 14_000.0, "judged": 2_650.0, "rotors": 568.0, "real": 236.0, "mujoco": 0.67,
    "imported": 0.17, "own": 0.62, "run": 0.96, "compare": 8.6, "ladder": 3000.0, "map": 180.0, "map, ideal": 18.7,
}  # fmt: skip
# Runs with which a study of 0.1 is flown twice and extrapolated, where all would take it long: an hour with MuJoCo.
FEW = {"ladder": (16, 48), "map": (4_000, 20_000)}
ALL = {"compare": 2_000, "map, ideal": 200_000, "map": 200_000, "ladder": 2_000}
STUDIES = {
    "compare": ("compare",),
    "map, ideal": ("map", "--law", "inverted", "--plant", "ideal", "--force"),
    "map": ("map", "--law", "inverted", "--plant", "rotors", "--force"),
    "ladder": ("ladder",),
}


class Version(NamedTuple):
    """A version of flypend: the folder of its source, and a cache of kernels and bytecode of its own."""

    source: Path
    cache: Path

    def call(self, *arguments: str) -> tuple[str, float, float]:
        """Call Python; return what it prints, and the seconds of processor and of wall that it takes."""
        environment = os.environ | {
            "PYTHONPATH": str(self.source), "FLYPEND_CACHE": str(self.cache), "PYTHONPYCACHEPREFIX": str(self.cache),
            "PYTHONDONTWRITEBYTECODE": "",
        }  # fmt: skip
        before, begin = _children(), time.perf_counter()
        done = subprocess.run(
            [sys.executable, *arguments], cwd=ROOT, env=environment, check=True, capture_output=True, text=True
        )
        return done.stdout, _children() - before, time.perf_counter() - begin

    def measure(self, name: str) -> float:
        """One of `benchmarks.measures`."""
        return float(self.call("-m", "benchmarks.measures", name)[0].split()[-1])

    def command(self, *arguments: str) -> tuple[float, float]:
        """Seconds of processor and of wall of a command, which writes into the cache."""
        out = self.cache / ("out.png" if arguments[0] == "map" else "out")
        return self.call("-m", "flypend", *arguments, "--out", str(out))[1:]


def _children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@contextmanager
def versions() -> Iterator[tuple[Version, Version | None]]:
    """Yield today's version and 0.1, or None where the history lacks it."""
    with tempfile.TemporaryDirectory() as folder:
        old, caches = Path(folder) / "old", [Path(folder) / name for name in ("cache", "old-cache")]
        for cache in caches:
            cache.mkdir(mode=0o700)
        found = subprocess.run(["git", "archive", COMMIT, "src"], cwd=ROOT, capture_output=True, check=False)
        if found.returncode == 0:
            with tarfile.open(fileobj=BytesIO(found.stdout)) as archive:
                archive.extractall(old, filter="data")
        today = Version(ROOT / "src", caches[0])
        yield today, Version(old / "src", caches[1]) if found.returncode == 0 else None


def goals(share: float = 1.0) -> Iterator[Line]:
    """The figures of users' paths, with their goals, beside those of 0.1; studies with a `share` of their runs.

    For a share, the studies of 0.1 are those recorded, the same share of them.
    """
    with versions() as (today, old):
        yield from flights(today, old)
        yield from cold(today, old)
        yield from studies(today, old if share == 1 else None, share)


def _both(name: str, today: Version, old: Version | None, least: bool = False) -> tuple[float, float]:
    """A measure today and in 0.1: the best of some turns."""
    best, pairs = min if least else max, []
    for _ in range(TURNS):
        pairs.append((today.measure(name), old.measure(name) if old else RECORDED[name]))
    new, before = zip(*pairs, strict=True)
    return best(new), best(before)


def flights(today: Version, old: Version | None) -> Iterator[Line]:
    """Flights per second of processor time, by plant."""
    rates = {name: _both(name, today, old) for name in ("unjudged", "judged", "rotors", "real", "mujoco")}
    said = {
        "unjudged": "inverted law, 10 s, ideal plant at 1e-6, judged at its end",
        "judged": "the same, judged every 10 ms, as is the default",
        "rotors": "inverted law, 10 s, rotors at 500 Hz, judged every 10 ms",
        "real": "the same with noise, gusts and the observer",
        "mujoco": "the same flights in MuJoCo",
    }
    for name, (new, before) in rates.items():
        yield Line(said[name] + ", on a core", new, "flights/s", "", before)
    shares = {"judged over unjudged": ("judged", "unjudged", 0.75), "with noise over without": ("real", "rotors", 0.6)}
    for what, (above, below, least) in shares.items():
        new, before = (rates[above][i] / rates[below][i] for i in (0, 1))
        yield Line(what, new, "×", f"≥ {least}", before)
    for name, least in (("rotors", 3.5), ("mujoco", 15.0)):
        new, before = rates[name]
        yield Line(f"{name}: today's over 0.1's", new / before, "×", f"≥ {least}")


def cold(today: Version, old: Version | None) -> Iterator[Line]:
    """Cold starts, by the processor's time, kernels and bytecode in their caches."""
    flown = {version: [version.command("run", "1", "--no-figures")[0] for _ in range(2 * TURNS)]
             for version in (today, old) if version}  # fmt: skip
    before = min(flown[old]) if old else RECORDED["run"]
    yield Line("flypend run 1 --no-figures", min(flown[today]), "s", "≤ 0.5", before)
    for name, what, most in (
        ("imported", "import flypend, beyond numpy", 0.15), ("own", "first flight of one's own law", 1.0)
    ):  # fmt: skip
        new, before = _both(name, today, old, least=True)
        yield Line(what, new, "s", f"≤ {most}", before)


def studies(today: Version, old: Version | None, share: float = 1.0) -> Iterator[Line]:
    """What studies take on the wall, all kernels compiled: the second of two."""
    for name, arguments in STUDIES.items():
        sized = (*arguments, "--runs", str(max(2, round(share * ALL[name]))))
        new = min(today.command(*sized)[1] for _ in range(2))
        if old is None:
            before = share * RECORDED[name]
        elif name in FEW:
            before = extrapolated(old, name, arguments)
        else:
            before = min(old.command(*sized)[1] for _ in range(2))
        yield from _wall(" ".join(("flypend", *sized)), new, before)


def extrapolated(version: Version, name: str, arguments: tuple[str, ...]) -> float:
    """Seconds of a study with all runs, from two with few."""
    version.command(*arguments, "--runs", "1")  # compiles
    few, more = (version.command(*arguments, "--runs", str(runs))[1] for runs in FEW[name])
    return few + (more - few) / (FEW[name][1] - FEW[name][0]) * (ALL[name] - FEW[name][0])


def _wall(what: str, new: float, before: float) -> Iterator[Line]:
    yield Line(what + ", on the wall", new, "s", "", before)
    yield Line("0.1's time over today's", before / new, "×", "≥ 3")


if __name__ == "__main__":
    for line in goals():
        print(line, line.met, flush=True)
