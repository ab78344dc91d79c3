"""`make bench` in small: each peer and each line flies, and what cannot fly is named and stops nothing else."""

import importlib.util
import json
import math
import shutil
import sys

import numpy as np
import pytest

from benchmarks import __main__ as bench
from benchmarks import compare, measures, versions
from benchmarks.lines import LINES, Line
from benchmarks.peers import Peer, modules, peer
from benchmarks.problem import Problem, errors, reference
from benchmarks.report import with_ratios
from flypend.cli.app import app

SHORT = Problem(duration=1.0)
# Peers whose library is in the group "bench" alone, which the tests do not install.
BENCH_ONLY = {"h_diffrax": "diffrax"}


@pytest.fixture(scope="module")
def flown():
    """Starts, and where heyoka at 1e-15 takes them."""
    starts = SHORT.starts(3, seed=7)
    return starts, reference(SHORT, starts)


@pytest.mark.parametrize("module", modules())
def test_a_peer_flies_the_problem(module, flown):
    """Three runs of a second, within a hundred tolerances; without its library it says which one is missing."""
    starts, exact = flown
    chosen, library = peer(module), BENCH_ONLY.get(module)
    if library and importlib.util.find_spec(library) is None:
        with pytest.raises(ModuleNotFoundError, match=library):
            chosen.make(SHORT, 1)
        return
    final = chosen.make(SHORT, 1)(starts, 1e-7)
    assert final.shape == starts.shape
    if chosen.accurate:
        assert errors(final, exact).max() < 1e-5
        assert errors(starts, exact).max() > 0.1


def _absent(problem, threads):
    import flypend_has_no_such_peer  # noqa: F401


def _broken(problem, threads):
    raise OSError("libmissing.so: cannot open\nshared object")


def test_peers_that_cannot_fly_are_named_and_the_others_fly(monkeypatch):
    three = [("a_flypend_dp5", peer("a_flypend_dp5"))]
    three += [("x", Peer(name, "", make, 8)) for name, make in {"absent": _absent, "broken": _broken}.items()]
    monkeypatch.setattr(compare, "peers", lambda: three)
    monkeypatch.setattr(compare, "Problem", lambda: SHORT)
    said = []
    rows, missing = compare.compare(said.append, share=0.01)
    assert [row["name"] for row in rows] == ["flypend dp5"]
    assert "flypend_has_no_such_peer" in missing["absent"]
    assert "OSError" in missing["broken"]
    assert all(any(line.startswith(f"{name}: left out") for line in said) for name in missing)
    (row,) = with_ratios(rows)
    assert row["ratio"] == 1
    assert min(row[name] for name in ("per_core", "all_cores", "cold", "cold_again")) > 0


def test_without_a_reference_no_peer_flies(monkeypatch):
    monkeypatch.setitem(sys.modules, "heyoka", None)
    rows, missing = compare.compare(print, share=0.01)
    assert rows == []
    assert "heyoka" in missing["peers"]


def test_without_a_compiler_the_generated_c_is_named(monkeypatch):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    with pytest.raises(ModuleNotFoundError, match=r"g\+\+"):
        peer("c_generated_c").make(SHORT, 1)


@pytest.mark.parametrize("group", LINES, ids=lambda group: group.__name__)
def test_a_line_is_printed(group):
    lines = list(group(SHORT, 1e-5))
    assert lines
    assert all(math.isfinite(line.value) for line in lines)
    assert json.dumps([[*line, line.met] for line in lines])
    assert len({line.name for line in lines}) == len(lines)


@pytest.mark.parametrize("name", measures.MEASURES)
def test_a_measure_is_taken(name, monkeypatch):
    monkeypatch.setattr(measures, "REPEATS", 1)
    runs = measures.flown
    monkeypatch.setattr(measures, "flown", lambda count, **options: runs(2, **options))
    assert measures.MEASURES[name]() >= 0


class Recorded:
    """A version that only checks what it is asked for."""

    def measure(self, name):
        assert name in measures.MEASURES
        return 2.0

    def command(self, name, *arguments):
        app.commands[name].make_context(name, list(arguments))
        return 3.0, 4.0


@pytest.mark.parametrize("old", [None, Recorded()])
@pytest.mark.parametrize("share", [1.0, 0.001])
def test_lines_of_versions_ask_for_what_there_is(old, share):
    lines = [*versions.flights(Recorded(), old), *versions.cold(Recorded(), old)]
    lines += versions.studies(Recorded(), old, share)
    assert len(lines) > 15
    assert all(math.isfinite(line.value) for line in lines)


def test_a_version_answers_from_a_process_of_its_own():
    with versions.versions() as (today, _):
        assert today.measure("imported") > 0


def _stops(problem, share):
    yield Line("good", 1.0, "s", "≤ 2")
    raise RuntimeError("kernel\nlost")


@pytest.mark.parametrize("broken", [True, False])
def test_it_runs_to_its_end_and_says_what_is_missing(broken, monkeypatch, tmp_path, capsys):
    row = {"module": "a", "name": "flypend dp5", "note": "", "tolerance": 1e-7, "median_error": 1e-7, "error_95": 1e-6,
           "accurate": True, "all_cores": None, "compile_and_first": 1.0, "per_core": 2.0, "cold": 1.0,
           "cold_again": 1.0}  # fmt: skip
    monkeypatch.setattr(bench, "compare", lambda say, share: ([row], {"diffrax": "not there"} if broken else {}))
    monkeypatch.setattr(bench, "LINES", [_stops] if broken else [])
    monkeypatch.setattr(bench, "goals", lambda share: [Line("last", np.pi, "s")])
    monkeypatch.setattr(sys, "argv", ["benchmarks", str(tmp_path), "--share", "0.1"])
    with pytest.raises(SystemExit) as ended:
        bench.main()
    assert bool(ended.value.code) == broken
    table = json.loads((tmp_path / "benchmark.json").read_text())
    assert [line["name"] for line in table["lines"]] == ["good", "last"][not broken :]
    assert list(table["missing"]) == (["diffrax", "_stops"] if broken else [])
    printed = capsys.readouterr().out
    assert printed == (tmp_path / "benchmark.md").read_text() + "\n"
    assert all(f"Missing: {name}" in printed for name in table["missing"])
    assert (tmp_path / "benchmark.png").stat().st_size > 1000


def test_without_peers_there_is_a_table_still(tmp_path):
    where = bench.machine() | {"share": 1.0}
    bench.save(tmp_path, with_ratios([]), [], {"peers": "none"}, where)
    assert "Missing: peers (none)" in (tmp_path / "benchmark.md").read_text()
