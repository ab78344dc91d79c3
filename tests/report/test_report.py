"""What a command leaves behind: a folder filled whole or not at all, tables that fit, and numbers that agree."""

import errno
import json
import math
import os
import re
import stat
import subprocess
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

import flypend as fp
from flypend.files import whole as files
from flypend.files.staging import check_writable, staging
from flypend.geometry import norm
from flypend.paper import experiment, experiment_names
from flypend.paper.claims import SETTLED, Finding, Runs, Verdict, theorem_claims
from flypend.paper.defects import DEFECTS, findings
from flypend.report import paper, text
from flypend.report.flight import movie_tasks, write_flight
from flypend.report.paper import Reproduction, reproduce
from tests.folders import content

LAWS = ("printed", "without beta", "corrected")
GROUPS = {"printed": "printed", "without beta": "without-beta", "corrected": "corrected"}


# Staging ------------------------------------------------------------------------------------------------------------


def fill(folder):
    """Two files, one of them nested, and an empty folder."""
    (folder / "report.md").write_text("new")
    (folder / "runs" / "deep").mkdir(parents=True)
    (folder / "runs" / "deep" / "1.nc").write_bytes(b"\0\1")
    (folder / "empty").mkdir()


FILLED = {"report.md": b"new", "runs": None, "runs/deep": None, "runs/deep/1.nc": b"\0\1"}


@pytest.mark.parametrize("form", [str, Path])
def test_a_folder_that_is_new_appears_with_its_files(tmp_path, form):
    with staging(form(tmp_path / "out")) as folder:
        fill(folder)
        assert not (tmp_path / "out").exists()
        assert folder.parent == tmp_path  # on the file system where it has to go
    assert content(tmp_path / "out") == FILLED
    assert os.listdir(tmp_path) == ["out"]  # noqa: PTH208


def test_a_folder_that_exists_keeps_its_other_files(tmp_path):
    out = tmp_path / "out"
    (out / "runs" / "deep").mkdir(parents=True)
    (out / "report.md").write_text("old")
    (out / "runs" / "2.nc").write_text("other")
    (out / "runs" / "deep" / "notes").write_text("mine")
    with staging(out) as folder:
        fill(folder)
        assert (out / "report.md").read_text() == "old"
    assert content(out) == FILLED | {"runs/2.nc": b"other", "runs/deep/notes": b"mine"}


def test_a_folder_may_be_the_one_where_one_stands(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with staging(".") as folder:
        fill(folder)
    assert content(tmp_path) == FILLED


def test_a_link_to_a_folder_is_a_folder(tmp_path):
    (tmp_path / "real").mkdir()
    (tmp_path / "out").symlink_to(tmp_path / "real")
    with staging(tmp_path / "out") as folder:
        fill(folder)
    assert content(tmp_path / "real") == FILLED
    assert (tmp_path / "out").is_symlink()


@pytest.mark.parametrize("error", [ValueError("no"), KeyboardInterrupt(), SystemExit(143)])
@pytest.mark.parametrize("exists", [True, False])
def test_what_fails_leaves_nothing(tmp_path, error, exists):
    out = tmp_path / "out"
    if exists:
        out.mkdir()
        (out / "report.md").write_text("old")
    before = content(tmp_path)

    def half():
        with staging(out) as folder:
            fill(folder)
            raise error

    with pytest.raises(type(error)):
        half()
    assert content(tmp_path) == before


def test_a_failing_write_is_told_in_one_line(tmp_path):
    def write():
        with staging(tmp_path / "out") as folder:
            fill(folder)
            (folder / "report.md" / "below").write_text("impossible")

    with pytest.raises(fp.InputError, match=r"out: expected a folder that can be written, got Not a directory$"):
        write()
    assert content(tmp_path) == {}


@pytest.mark.parametrize("out", ["new", "old", "."])
def test_a_full_disk_is_told_in_one_line(tmp_path, monkeypatch, out):
    (tmp_path / "old").mkdir()
    monkeypatch.chdir(tmp_path)
    before = content(tmp_path)

    def write(*error):
        with staging(out) as folder:
            fill(folder)
            raise OSError(*(str(folder / "report.md") if part == "file" else part for part in error))

    for error in ((errno.ENOSPC, "No space left on device"), (errno.ENOSPC, "No space left on device", "file")):
        with pytest.raises(fp.InputError) as caught:
            write(*error)
        assert str(caught.value) == f"{out}: expected a folder that can be written, got No space left on device"
        assert content(tmp_path) == before


def test_a_missing_program_is_not_blamed_on_the_folder(tmp_path):
    def film():
        with staging(tmp_path / "out") as folder:
            fill(folder)
            subprocess.run([tmp_path / "ffmpeg"], check=True)

    with pytest.raises(FileNotFoundError, match="ffmpeg"):
        film()
    assert content(tmp_path) == {}


@pytest.mark.parametrize(
    ("blocked", "line"),
    [
        ("report.md", "out/report.md: expected a file or nothing, got a folder"),
        ("runs/deep/1.nc", "out/runs/deep/1.nc: expected a file or nothing, got a folder"),
        ("runs", "out/runs: expected a folder or nothing, got a file"),
        ("runs/deep", "out/runs/deep: expected a folder or nothing, got a file"),
    ],
)
def test_what_stands_in_the_way_stops_all_files(tmp_path, blocked, line):
    way = tmp_path / "out" / blocked
    way.parent.mkdir(parents=True)
    way.mkdir() if line.endswith("a folder") else way.write_text("mine")
    before = content(tmp_path)

    def write():
        with staging(tmp_path / "out") as folder:
            fill(folder)
            (folder / "a-first").write_text("new")
            (folder / "z-last").write_text("new")

    with pytest.raises(fp.InputError) as caught:
        write()
    assert str(caught.value).endswith(line)
    assert content(tmp_path) == before


@pytest.mark.parametrize(
    ("out", "line"),
    [
        ("file", "file: expected a folder, got a file"),
        ("file/out", "file/out: expected a folder that can be written, got Not a directory"),
        ("none/out", "none/out: expected a folder that can be written, got No such file or directory"),
        ("link", "link: expected a folder, got a link that leads nowhere"),
    ],
)
def test_what_cannot_be_a_folder_is_refused_before_the_work(tmp_path, out, line):
    (tmp_path / "file").write_text("mine")
    (tmp_path / "link").symlink_to(tmp_path / "gone")
    before = content(tmp_path)

    def work():
        with staging(tmp_path / out):
            pytest.fail("worked")

    for refused in (work, partial(check_writable, tmp_path / out), partial(reproduce, tmp_path / out)):
        with pytest.raises(fp.InputError) as caught:
            refused()
        assert str(caught.value).endswith(line)
        assert content(tmp_path) == before


@pytest.mark.parametrize("exists", [True, False])
def test_checking_leaves_nothing(tmp_path, exists):
    if exists:
        (tmp_path / "out").mkdir()
    before, times = content(tmp_path), [path.stat().st_mtime_ns for path in (tmp_path, *tmp_path.iterdir())]
    check_writable(tmp_path / "out")
    assert content(tmp_path) == before
    assert [path.stat().st_mtime_ns for path in (tmp_path, *tmp_path.iterdir())] == times


def test_a_folder_is_as_readable_as_any_other(tmp_path):
    (tmp_path / "usual").mkdir()
    with staging(tmp_path / "out") as folder:
        fill(folder)
    for name in ("out", "out/runs"):
        mode = stat.S_IMODE((tmp_path / name).stat().st_mode)
        assert mode == stat.S_IMODE((tmp_path / "usual").stat().st_mode)  # the folder of work is for its owner only


# Text ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (0.998764, "0.99876"),
        (1.000004, "1.00000"),
        (1.0099, "1.00990"),
        (0.9901, "0.99010"),
        (1.0, "1"),
        (0.989, "0.989"),
        (1.011, "1.01"),
        (-0.9999, "-1"),
        (0.0971287, "0.0971"),
        (104999, "1.05e+05"),
        (0.0, "0"),
        (np.float64(0.998764), "0.99876"),
        (math.nan, "nan"),
        (math.inf, "inf"),
    ],
)
def test_a_number_has_three_digits_or_its_distance_to_one(value, told):
    assert text.number(value) == told


@given(st.floats(-1e300, 1e300))
def test_a_number_is_told_to_half_a_digit(value):
    tolerance = 0.5e-5 if abs(value - 1) < 1e-2 else 0.5e-2 * abs(value)
    assert abs(float(text.number(value)) - value) <= tolerance * (1 + 1e-9)


def cells(line):
    """Cells of a row of a Markdown table: what is between bars that are not escaped."""
    assert line.startswith("|")
    assert line.endswith("|")
    return re.split(r"(?<!\\)\|", line)[1:-1]


def tables(markdown):
    """The tables of a Markdown text, each a list of rows of cells."""
    blocks = re.findall(r"(?:^\|.*\n?)+", markdown, flags=re.MULTILINE)
    return [[cells(line) for line in block.splitlines()] for block in blocks]


def well_formed(table):
    head, rule, *rows = table
    assert rows
    assert {len(row) for row in table} == {len(head)}
    assert set(rule) == {"---"}


def verdict(value=0.5, holds=False, claim="y → e₃", measured="y₃ at 6.5 s", criterion="≥ 0.998"):
    return Verdict(claim, measured, value, criterion, holds)


def test_a_table_of_verdicts_is_well_formed_whatever_it_holds():
    row = [verdict(), verdict(0.99999, True), verdict(claim="|a|\nb", measured="|ẍ| at 1 s", criterion="≤ |c|")]
    keys = [("printed", "1"), ("a|b", "own | start"), ("two\nlines", "2")]
    ends = dict.fromkeys(keys, "singular at 1 s: |v_e| reaches zero\nand more")
    (table,) = tables(text.verdicts_markdown(dict.fromkeys(keys, row), ends))
    well_formed(table)
    assert len(table) == 4 + len(keys)  # head, rule, measured, criterion
    assert len(table[0]) == 3 + len(row)
    assert table[4][2:5] == [
        " singular at 1 s: \\|v_e\\| reaches zero and more ",
        " 0.5 **fails** ",
        " 0.99999 **holds** ",
    ]
    assert table[2][-1].strip() == "\\|ẍ\\|"  # without the time of one of the runs
    assert table[0][-1].strip() == "\\|a\\| b"


def test_findings_are_sections_with_a_table_each():
    made = [
        Finding("First", "f = |a|", "f = |b|", {"|x| at 1 s": 0.5, "y₃": 0.998764}, True),
        Finding("Second", "g", "h", {"z": math.nan}, False),
    ]
    told = text.findings_markdown(made)
    assert re.findall(r"^### .*$", told, flags=re.MULTILINE) == ["### 1. First", "### 2. Second"]
    assert re.findall(r"shown by this run: (\w+)", told) == ["yes", "NO"]
    first, second = tables(told)
    well_formed(first)
    assert first[2:] == [[" \\|x\\| at 1 s ", " 0.5 "], [" y₃ ", " 0.99876 "]]
    assert second[2:] == [[" z ", " nan "]]
    assert "- printed: f = |a|\n- should read: f = |b|\n" in told


def printed(table, width=80):
    console = Console(width=width, record=True, file=open(os.devnull, "w", encoding="utf-8"))  # noqa: PTH123, SIM115
    console.print(table)
    console.file.close()
    return console.export_text()


CLAIMS = ("y → e₃", "z → e₃", "V falls", "ẍ → 0", "f bounded")
WIDEST = {law: [verdict(v, claim=claim) for v, claim in zip(values, CLAIMS, strict=True)] for law, values in {
    "printed": (-0.615, -0.823, 0.882, 10.6, 0.99291),
    "without beta": (-0.0359, 0.00516, 1.05e5, 1.67e5, 1.00001),
    "corrected": (0.99912, 1.0, 1.33, 0.0971, 0.9901),
}.items()}  # fmt: skip


def test_the_summary_fits_into_80_columns():
    rows = {(law, name): row for law, row in WIDEST.items() for name in experiment_names()}
    told = printed(text.summary_table(rows))
    assert "…" not in told
    assert max(len(line.rstrip()) for line in told.splitlines()) <= 80
    lines = [line.split() for line in told.splitlines()]
    for law, name in rows:  # one line per run, with all of it
        wanted = [part for v in rows[law, name] for part in (text.number(v.value), "✗")]
        assert [*law.split(), name, *wanted] in lines
    assert [*" ".join(("law start", *CLAIMS)).split()] in lines


def test_the_summary_folds_a_long_name_and_keeps_every_number():
    name = "/a/long/path/to/a/file/of/ones/own/[bold]1[/].toml"
    told = printed(text.summary_table({("inverted", name): WIDEST["without beta"]}))
    assert "…" not in told
    for number in ("-0.0359 ✗", "0.00516 ✗", "1.05e+05 ✗", "1.67e+05 ✗", "1.00001 ✗"):
        assert number in told
    folded = "".join(line[len(" inverted ") : len(" inverted ") + 20].split(" ")[0] for line in told.splitlines()[4:])
    assert folded.startswith(name)


def test_the_summary_says_which_claim_holds():
    told = printed(text.summary_table({("corrected", "1"): [verdict(0.99912, True), verdict(1.33, False, "V falls")]}))
    assert "0.99912 ✓" in told
    assert "1.33 ✗" in told
    assert " ".join(told.split()).endswith("fails as well on a run that does not reach its end.")
    assert "y → e₃: y₃ ≥ 0.998;" in told


def test_the_table_of_findings_fits_into_80_columns():
    made = [
        Finding("A defect of (xeqn)", "f", "g", {f"largest rise of V, number {i}, {'and more ' * i}s": 1.0}, i != 1)
        for i in range(4)
    ]
    told = printed(text.findings_table(made))
    assert "…" not in told
    assert [line.split()[0] for line in told.splitlines() if re.match(r" +\d ", line)] == ["1", "2", "3", "4"]
    assert [line.split()[-1] for line in told.splitlines() if re.match(r" +\d ", line)] == ["yes", "no", "yes", "yes"]


def test_json_is_plain_and_says_null_for_what_is_no_number(tmp_path):
    path = tmp_path / "report.json"
    made = {
        "verdict": verdict(np.float64(math.nan)),
        "finding": Finding("t", "p", "c", {"a": np.inf, "b": np.float64(0.1)}, np.bool_(True)),
        "numbers": (1, np.int64(2), -math.inf, [math.nan, 0.5]),
        3: {"nested": None, "ẏ": "ẍ"},
    }

    def refuse(name):
        pytest.fail(f"{name} is not JSON")

    text.write_json(path, made)
    read = json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse)
    assert read["verdict"] == {
        "claim": "y → e₃", "measured": "y₃ at 6.5 s", "value": None, "criterion": "≥ 0.998", "holds": False,
    }  # fmt: skip
    assert read["finding"]["evidence"] == {"a": None, "b": 0.1}
    assert read["finding"]["shown"] is True
    assert read["numbers"] == [1, 2, None, [None, 0.5]]
    assert read["3"] == {"nested": None, "ẏ": "ẍ"}
    assert "ẏ" in path.read_text(encoding="utf-8")  # and can be read by people


def test_the_judgement_tells_whether_a_run_stands_and_what_it_took():
    vehicle, law = fp.vehicle("hehn2011"), fp.laws.inverted()
    stands = fp.simulate(vehicle, law, fp.State(y=(0, 0, 1), x=(0.3, 0, 0)), 3.0, plant="ideal")
    told = re.fullmatch(
        r"inverted hover reached after ([\d.]+) s, largest distance ([\d.]+) m, largest rotor force ([\d.]+) N, "
        r"lowest point at (-[\d.]+) m",
        text.judgement(stands),
    )
    since, distance, force, lowest = map(float, told.groups())
    assert lowest == pytest.approx(fp.metrics(stands).lowest, rel=5e-3)
    assert 0 < since < 3
    assert distance == pytest.approx(np.max(norm(stands.x)), rel=5e-3)
    assert force == pytest.approx(np.max(stands.rotor_forces), rel=5e-3)
    assert text.judgement(fp.simulate(vehicle, law, fp.State(y=(0, 0, -1)), 0.1, plant="ideal")).startswith(
        "inverted hover not reached ("
    )


# One flight -----------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def short():
    row = experiment("5")
    return fp.simulate(row.vehicle, row.law(), row.start, 0.2, plant="ideal")


def test_a_flight_leaves_its_file_its_figures_and_its_reports(short, tmp_path):
    verdicts = write_flight(short, {"experiment": "5"}, tmp_path / "out", with_movies=False)
    assert sorted(content(tmp_path / "out")) == [
        "full.pdf", "full.png", "report.json", "report.md", "run.nc", "stop-motion.pdf", "stop-motion.png",
        "y3-z3.pdf", "y3-z3.png",
    ]  # fmt: skip
    np.testing.assert_array_equal(fp.load(tmp_path / "out" / "run.nc").y, short.y)
    assert verdicts == theorem_claims(short)
    report = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert [claim["value"] for claim in report["claims"]] == [v.value for v in verdicts]
    assert report["settings"] == {"experiment": "5"}
    told = (tmp_path / "out" / "report.md").read_text(encoding="utf-8")
    for table in tables(told):
        well_formed(table)
    assert [cell.strip() for cell in tables(told)[0][-1][:3]] == ["corrected", "5", "completed at 0.2 s"]


def test_the_limit_is_read_on_the_longer_run(short, tmp_path):
    row = experiment("5")
    longer = fp.simulate(row.vehicle, row.law(), row.start, 0.4, plant="ideal")
    verdicts = write_flight(short, {}, tmp_path, settled=longer, with_figures=False, with_movies=False)
    assert verdicts == theorem_claims(short, longer) != theorem_claims(short)
    assert "| corrected | own start |" in (tmp_path / "report.md").read_text(encoding="utf-8")


def test_progress_is_given_the_tasks_by_name_and_runs_them(short, tmp_path, monkeypatch):
    monkeypatch.setattr(files, "save_figure", lambda figure, path: path.write_text("drawn"))
    seen = []

    def progress(tasks):
        for name, task in list(tasks)[:2]:
            seen.append(name)
            task()

    write_flight(short, {}, tmp_path / "out", progress=progress)
    assert seen == ["y3-z3", "full"]
    assert sorted(content(tmp_path / "out")) == [
        "full.pdf", "full.png", "report.json", "report.md", "run.nc", "y3-z3.pdf", "y3-z3.png",
    ]  # fmt: skip


def test_movies_are_from_the_side_and_along_e3(short, tmp_path):
    tasks = dict(movie_tasks(short, tmp_path, "experiment-4-"))
    assert list(tasks) == ["experiment-4-movie-side", "experiment-4-movie-axis"]
    for view in ("side", "axis"):
        task = tasks[f"experiment-4-movie-{view}"]
        assert task.args == (short, tmp_path / f"experiment-4-movie-{view}.mp4")
        assert task.keywords["view"] == view
        assert task.keywords["speed"] < 1  # slow motion


def test_a_law_without_a_lyapunov_function_is_not_judged_by_the_theorem(tmp_path):
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, 1)), 0.1, plant="ideal")
    assert write_flight(run, {}, tmp_path / "out", with_figures=False, with_movies=False) == []
    assert "Theorem" not in (tmp_path / "out" / "report.md").read_text(encoding="utf-8")
    assert json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))["claims"] == []


def test_a_run_that_ended_at_its_start_leaves_a_report_too(tmp_path):
    row = experiment("4")
    run = fp.simulate(row.vehicle, row.law("printed", speed_floor=0.0), row.start, 1.0, plant="ideal")
    verdicts = write_flight(run, {}, tmp_path / "out", with_figures=False, with_movies=False)
    assert not any(v.holds for v in verdicts)
    report = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert report["outcome"]["status"] == "singular"
    assert report["outcome"]["time"] == 0


# The paper ------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def reproduced(tmp_path_factory):
    """The whole of `flypend paper --quick`: its folder, its result, and what it told on the way."""
    folder, told = tmp_path_factory.mktemp("paper") / "out", []
    result = reproduce(folder, quick=True, progress=lambda *what: told.append(what))
    return folder, result, told


@pytest.fixture(scope="module")
def report(reproduced):
    return json.loads((reproduced[0] / "report.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def runs(reproduced):
    """The runs that were written, read again."""
    groups = ("printed", "without_beta", "corrected", "corrected_singular")
    folder = reproduced[0] / "runs"
    return Runs(
        **{
            group: {name: fp.load(folder / f"{group.replace('_', '-')}-{name}.nc") for name in experiment_names()}
            for group in groups
        }
    )


def test_the_folder_holds_every_figure_and_run_and_nothing_else(reproduced):
    folder, _, _ = reproduced
    figure, run = "figures/experiment-{}-{}.png", "runs/{}-{}.nc"
    wanted = {"report.md", "report.json", "figures", "runs"}
    for name in experiment_names():
        wanted |= {figure.format(name, kind) for kind in ("y3-z3", "full", "printed-without-beta-y3-z3")}
        wanted |= {run.format(group, name) for group in ("printed", "without-beta", "corrected", "corrected-singular")}
    wanted |= {figure.format(name, "stop-motion") for name in ("2", "4", "5")}
    wanted |= {f"figures/swing-up-{kind}.png" for kind in ("y3-z3", "full", "stop-motion")}
    wanted |= {name.removesuffix(".png") + ".pdf" for name in wanted if name.endswith(".png")}
    wanted |= {"runs/inverted-swing-up.nc"}
    written = content(folder)
    assert set(written) == wanted  # no movies: it was quick
    for name, data in written.items():
        if name.endswith(".png"):
            assert data.startswith(b"\x89PNG")
            assert data.rstrip(b"\0").endswith(b"IEND\xaeB`\x82")
        if name.endswith(".pdf"):
            assert data.startswith(b"%PDF")
    assert os.listdir(folder.parent) == ["out"]  # noqa: PTH208


def test_the_runs_are_those_of_the_experiments(runs):
    options = {
        "printed": ("printed", {}), "without_beta": ("printed", {"beta": "off"}), "corrected": ("corrected", {}),
        "corrected_singular": ("corrected", {"beta": "regularized", "beta_floor": 0.0}),
    }  # fmt: skip
    for group, (law, chosen) in options.items():
        for name, run in getattr(runs, group).items():
            row = experiment(name)
            assert (run.law, run.e3, run.vehicle) == (law, "down", row.vehicle)
            assert run.gains == row.law(law, **chosen).values
            np.testing.assert_allclose(run.states[0].packed(), row.start.packed(), rtol=0, atol=1e-14)
    row = experiment("2")
    flown = fp.simulate(row.vehicle, row.law(), row.start, row.duration, rtol=1e-10, plant="ideal")
    np.testing.assert_array_equal(runs.corrected["2"].y, flown.y)  # the same run: the same numbers


@pytest.mark.parametrize(("law", "name"), [("corrected", "3"), ("printed", "2"), ("without beta", "4")])
def test_a_verdict_of_the_report_follows_from_the_run_on_disk(reproduced, runs, report, law, name):
    _, result, _ = reproduced
    run = {"printed": runs.printed, "without beta": runs.without_beta, "corrected": runs.corrected}[law][name]
    row = experiment(name)
    longer = fp.simulate(row.vehicle, row.law(), row.start, SETTLED, plant="ideal") if law == "corrected" else run
    wanted = theorem_claims(run, longer)
    (told,) = [entry for entry in report["claims"] if (entry["law"], entry["experiment"]) == (law, name)]
    assert [(claim["claim"], claim["holds"]) for claim in told["claims"]] == [(v.claim, v.holds) for v in wanted]
    np.testing.assert_allclose([claim["value"] for claim in told["claims"]], [v.value for v in wanted], rtol=1e-12)
    assert told["run"] == result.ends[law, name] == f"{run.outcome.status} at {run.outcome.time:.4g} s"
    assert [v.holds for v in result.verdicts[law, name]] == [v.holds for v in wanted]


def test_the_report_judges_every_law_on_every_experiment(report):
    entries = {(entry["law"], entry["experiment"]): entry for entry in report["claims"]}
    assert set(entries) == {(law, name) for law in LAWS for name in experiment_names()}
    for (law, _), entry in entries.items():
        held = {claim["claim"]: claim["holds"] for claim in entry["claims"]}
        assert list(held) == list(CLAIMS)
        assert [claim for claim in CLAIMS if held[claim]] == (
            ["y → e₃", "z → e₃", "ẍ → 0", "f bounded"] if law == "corrected" else
            ["y → e₃"] if held["y → e₃"] and law == "without beta" else []
        )  # fmt: skip


def test_the_defects_of_the_report_follow_from_the_runs_on_disk(reproduced, runs, report):
    assert len(report["defects"]) == len(DEFECTS) == 16
    assert all(defect["shown"] is True for defect in report["defects"])
    for told, wanted in zip(report["defects"], findings(runs), strict=True):
        assert told["title"] == wanted.title
        assert list(told["evidence"]) == list(wanted.evidence)
        # The last one is a difference of two runs, 6e-10 of them.
        np.testing.assert_allclose(
            list(told["evidence"].values()), list(wanted.evidence.values()), rtol=1e-6, atol=1e-12
        )
    speeds = [value for key, value in report["defects"][0]["evidence"].items() if key.startswith("|ẏ| at 6.5 s, exp")]
    np.testing.assert_allclose(speeds, [norm(run.y_dot)[-1] for run in runs.without_beta.values()], rtol=1e-12)


def test_the_report_for_people_says_the_same(reproduced, report):
    told = (reproduced[0] / "report.md").read_text(encoding="utf-8")
    verdicts, repaired, *evidence = tables(told)
    for table in (verdicts, repaired, *evidence):
        well_formed(table)
    for row, entry in zip(repaired[4:], report["repaired"], strict=True):
        assert row[1].strip() == entry["experiment"]
        assert all(cell.strip().endswith("**holds**") for cell in row[3:])
        assert all(claim["holds"] for claim in entry["claims"])
    assert len(evidence) == 16
    for row, entry in zip(verdicts[4:], report["claims"], strict=True):
        assert [cell.strip() for cell in row[:3]] == [entry["law"], entry["experiment"], entry["run"]]
        assert [cell.strip() for cell in row[3:]] == [
            f"{text.number(claim['value'])} **{'holds' if claim['holds'] else 'fails'}**" for claim in entry["claims"]
        ]
    for table, defect in zip(evidence, report["defects"], strict=True):
        assert [row[1].strip() for row in table[2:]] == [text.number(v) for v in defect["evidence"].values()]
    assert re.findall(r"^### (\d+)\. (.*)$", told, flags=re.MULTILINE) == [
        (str(i), defect["title"]) for i, defect in enumerate(report["defects"], 1)
    ]


def test_the_tables_of_the_terminal_fit_and_lose_nothing(reproduced):
    _, result, _ = reproduced
    told = printed(text.summary_table(result.verdicts))
    assert "…" not in told
    lines = [line.split() for line in told.splitlines()]
    for (law, name), row in result.verdicts.items():
        wanted = [part for v in row for part in (text.number(v.value), "✓" if v.holds else "✗")]
        assert [*law.split(), name, *wanted] in lines
    told = printed(text.summary_table(result.repaired))
    assert "…" not in told
    assert told.count("✓") == 6 * len(experiment_names())
    told = printed(text.findings_table(result.findings))
    assert "…" not in told
    assert max(len(line.rstrip()) for line in told.splitlines()) <= 80


def test_progress_goes_on_to_its_end(reproduced):
    told = reproduced[2]
    done, totals = [what[1] for what in told], [what[2] for what in told]
    assert done == sorted(done)
    assert all(d <= total for d, total in zip(done, totals, strict=True))
    assert told[-1][0] == "done"
    assert done[-1] == totals[-1] == len(told) - 1
    flying = [what for what, *_ in told if what.startswith("flying")]
    assert len(flying) == len(set(flying)) == 4 * len(experiment_names())


def test_the_promise_is_kept_by_the_run_on_disk(reproduced, report):
    folder, result, _ = reproduced
    run = fp.load(folder / "runs" / "inverted-swing-up.nc")
    assert (run.law, run.vehicle, run.e3) == ("inverted", fp.vehicle("hehn2011"), "up")
    assert run.y[0, 2] == -1  # from hanging at rest
    assert not run.y_dot[0].any()
    assert run.y[-1, 2] > 0.99
    assert norm(run.x[-1]) < 0.2
    assert np.max(run.rotor_forces) <= run.vehicle.rotor_limits[1]  # of real rotors
    assert report["swing_up"]["success"] is True
    assert text.judgement(run) == text.judgement(result.swing_up)
    assert text.judgement(run) in (folder / "report.md").read_text(encoding="utf-8")


def test_movies_are_made_of_experiments_4_and_5_unless_it_is_quick(runs, tmp_path):
    slow, quick = ([name for name, _ in paper._pictures(runs, tmp_path, quick)] for quick in (False, True))
    movies = [f"experiment-{name}-movie-{view}" for name in ("4", "5") for view in ("side", "axis")]
    assert slow == movies + quick  # the long ones first
    assert len(quick) == len(set(quick)) == 6 + 6 + 3 + 6


@pytest.mark.parametrize(
    ("task", "error"), [(partial(int, "x"), ValueError), (partial(os.listdir, "/none/such"), FileNotFoundError)]
)
def test_a_picture_that_fails_leaves_nothing_of_the_reproduction(runs, tmp_path, monkeypatch, task, error):
    out = tmp_path / "out"
    (out / "runs").mkdir(parents=True)
    (out / "report.md").write_text("old")
    before = content(tmp_path)
    monkeypatch.setattr(paper, "fly_all", lambda progress: runs)
    monkeypatch.setattr(paper, "simulate", lambda *_, **__: runs.corrected["4"])
    monkeypatch.setattr(paper, "_pictures", lambda *_: [("one that fails", task)])
    monkeypatch.setattr(paper, "figure_tasks", lambda *_, **__: [])
    key = ("corrected", "1")
    monkeypatch.setattr(
        paper,
        "_judge",
        lambda _, swing_up: Reproduction({key: [verdict()]}, {key: ""}, [], swing_up, {key: [verdict()]}),
    )
    with pytest.raises(error):
        reproduce(out, quick=True)
    assert content(tmp_path) == before
