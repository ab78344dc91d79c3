"""The folder and the tables of `flypend theorem`."""

import io
import json

import pytest
from click.testing import CliRunner
from rich.console import Console

import flypend as fp
from flypend.cli.app import app
from flypend.paper import descent
from flypend.report import theorem


@pytest.fixture(scope="module")
def checked(tmp_path_factory):
    """`flypend theorem`, small: two flights of each law, a coarse basin."""
    folder = tmp_path_factory.mktemp("theorem") / "out"
    patch = pytest.MonkeyPatch()
    patch.setattr(theorem, "POINTS", 7)
    few = {name: entry for name, entry in descent.laws().items() if name in ("repaired", "almost_global", "printed")}
    patch.setattr(theorem, "laws", lambda: few)
    told = CliRunner().invoke(app, ["theorem", "--runs", "2", "--out", str(folder)], env={"COLUMNS": "80"})
    patch.undo()
    assert told.exit_code == 0, told.output
    return folder, told.output


def test_the_folder_holds_the_figures_and_the_report(checked):
    names = {path.name for path in checked[0].iterdir()}
    figures = {f"{name}.{kind}" for name in ("V-experiments", "V-swing-ups", "basin") for kind in ("png", "pdf")}
    assert names == figures | {"report.md", "report.json"}


def test_every_claim_of_the_report_holds_and_the_control_fails(checked):
    content = json.loads((checked[0] / "report.json").read_text(encoding="utf-8"))
    assert {entry["theorem"] for entry in content["claims"]} == {"A", "B"}
    assert all(claim["holds"] for entry in content["claims"] for claim in entry["claims"])
    rising = {row["law"]: row["rising"] for row in content["descents"]}
    assert rising["repaired"] == rising["almost_global"] == 0 < rising["printed"]


def test_the_terminal_shows_every_verdict(checked):
    assert "…" not in checked[1]
    assert checked[1].count("✓") == 6 * 6 + 4 * 6
    assert "✗" not in checked[1]


def test_the_table_marks_the_laws_whose_v_rises():
    row = descent.Descent(law="printed", runs=3, converged=0, ended=1, rising=2, median_rise=0.5, worst_rise=7.0)
    out = io.StringIO()
    Console(file=out, width=80).print(theorem.descent_table([row]))
    assert "2 of 3" in out.getvalue()
    assert "0.5 / 7" in out.getvalue()


def test_a_folder_that_cannot_be_written_is_told_before_the_flights(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(fp.InputError):
        theorem.check_theorems(tmp_path / "file" / "out", runs=1, seed=0)
