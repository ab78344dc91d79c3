"""The ledger and the pages: a measured number on a page is one that a command of that page has printed."""

import json
import sys
from datetime import date

import pytest

from benchmarks import results
from benchmarks.quantities import Said, said
from benchmarks.results import CONSTANTS, ROOT, Result, measured, pages, put, put_tables, rows, typed, unknown

LEDGER = results.results()
NAMES = [path.relative_to(ROOT).as_posix() for path in pages()]


@pytest.mark.parametrize("name", NAMES)
def test_a_measured_number_of_a_page_is_in_the_ledger(name):
    found = unknown((ROOT / name).read_text(encoding="utf-8"), ROOT / name, LEDGER)
    assert sorted({number.text for number in found}) == sorted(CONSTANTS["unprinted"].get(name, []))


def test_what_pages_need_not_print_is_on_pages():
    told = {**CONSTANTS, **CONSTANTS["unprinted"]}
    assert told.keys() - {"everywhere", "unprinted"} <= set(NAMES)
    for name in told.keys() & set(NAMES):
        numbers = {number.text for number in said((ROOT / name).read_text(encoding="utf-8"))}
        assert {*CONSTANTS.get(name, []), *CONSTANTS["unprinted"].get(name, [])} <= numbers


def test_another_number_on_a_page_is_noticed():
    path = ROOT / "docs" / "findings.md"
    page = path.read_text(encoding="utf-8")
    assert page.count("3.03 / 3.82") == 1
    (wrong,) = unknown(page.replace("3.03 / 3.82", "3.03 / 7.77"), path, LEDGER)
    assert wrong.text == "7.77"
    assert unknown(page.replace("--runs 2000 --seed 2024\n", "--runs 2001 --seed 2024\n"), path, LEDGER)


WRONG = (
    "It fails in 83.17 % of flights.", "It fails in 8317 flights.", "1,871 of 1,994 succeed.", "A step takes 83.17 ms.",
    "A 8317-m excursion.", "It is 8317 times faster, or 8317x.", "Within $8317$ m.", "Settles in 8317 seconds.",
    "From 83.17 to 91.71 m.", "The error is 8.317e-7.", "- **83.17 m/s**",
    "| a | b |\n|---|---|\n| c | 8317 |", "Costs 8317 ns, 8317 μs.", "Within 8317 degrees.", "![8317 m](a.png)",
    "## It takes 83.17 s",  # in a section of its own
)  # fmt: skip


@pytest.mark.parametrize("several", [WRONG, ("> lost 83171 bytes",)], ids=["", "quoted"])  # a > might end a tag
@pytest.mark.parametrize("name", NAMES)
def test_a_wrong_number_is_noticed_however_it_is_written(name, several):
    """At the end of every page, also below a link to other pages, whose results count, too."""
    page, ends = (ROOT / name).read_text(encoding="utf-8").partition("\n## What was tried")[0], []
    for wrong in several:
        ends.append((len(page), len(page := f"{page}\n\n{wrong}\n")))
    noticed = [number.begin for number in unknown(page, ROOT / name, LEDGER)]
    assert [wrong for wrong, (a, b) in zip(several, ends, strict=True) if not any(a < at < b for at in noticed)] == []


@pytest.mark.parametrize("result", LEDGER, ids=lambda result: result.name)
def test_a_result_is_named_by_a_page_and_by_code(result):
    assert any(typed(result.command) in results.commands(path.read_text(encoding="utf-8")) for path in pages())
    assert result.code
    assert all(results.place_of(source).exists() for source in result.code)
    assert result.values
    assert result.date > date(2026, 11, 1)


def test_the_file_of_a_result_has_all_of_it():
    code = {"laws": {"lqr.py": "0123abcd"}}
    result = Result("x", 'flypend "a b"', code, date(2026, 11, 22), "a", {"5 cm": {"c d": [1, 2.5]}})
    assert Result("x", **results.tomllib.loads(result.text())) == result


def test_rows_of_tables_and_lines():
    table = "| law | stand | far (m) |\n|---|---|---|\n| **a** | 2,000 of 2000 | 0.5, 1e-3 |\n"
    assert rows(f"{table}\nhanging: 3 of 4 (1.5 %)\np95 7 m\n") == {
        "a": {"stand": [2000, 2000], "far (m)": [0.5, 1e-3]}, "hanging": [3, 4, 1.5], "p95": [7],
    }  # fmt: skip


def test_a_report_is_preferred_to_what_is_printed(tmp_path):
    report = {"settings": {"runs": 9}, "laws": [{"law": "a", "runs": 20, "far": 1 / 3, "causes": {"rod": 2}}]}
    report["laws"].append({"law": "a", "runs": 30})
    assert measured("5", tmp_path) == {"all": [5]}
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "report.json").write_text(json.dumps(report), encoding="utf-8")
    again = {"a again": {"runs": 30}}
    assert measured("5", tmp_path) == {"a": {"runs": 20, "far": 0.33333}, "a causes": {"rod": 2}} | again


@pytest.mark.parametrize(
    ("text", "value", "scale", "same"),
    [
        ("1.80", 1.8, 1, True), ("66", 66.1, 1, True), ("1,978", 1978, 1, True), ("99.8", 0.99808, 100, True),
        ("1.2", 0.0124, 100, True), ("470", 467.56, 1, True), ("2e-5", 2.3e-5, 1, True), ("33", 32.5, 1, True),
        ("0.19", -0.1916, 1, True),
        ("0.9", 0.0124, 100, False), ("1.80", 1.79, 1, False), ("34", 32.5, 1, False), ("1978", 1977, 1, False),
        ("2000", 1999, 1, False), ("470", 481.0, 1, False), ("2e-5", 2.6e-5, 1, False),
    ],
)  # fmt: skip
def test_numbers_agree_to_the_digits_of_the_page(text, value, scale, same):
    assert Said(text, 0, "", scale, "").agrees(value) == same


def test_what_is_a_quantity():
    prose = "3 laws, 20 ms, $1.5$, `2.5`, 2026-11-22, 1.1 to 1.2 m, 3 of 4; hehn2011 p95"
    page = f"# 7.5\n\n{prose}\n\n    x 4.5\n\n| a | 6 |\n"
    assert [number.text for number in said(page)] == ["7.5", "20", "1.5", "1.1", "1.2", "3", "4", "6"]
    assert [number.scale for number in said("1 to 2 cm\n")] == [100, 100]


def test_new_values_are_put_where_a_page_says_the_old_ones():
    old, new = {"a": {"far": [1.5, 2e-5], "n": 5}, "b": [1.5]}, {"a": {"far": [1.61, 3e-5], "n": 5}, "b": [2.0]}
    page = "| a | 1.5 m |\n| b | 1.5 m |\n\nfar: 1.5 m, 2e-5 m, 5 s\n"
    page, unclear = put(page, list(said(page)), old, new)
    assert page == "| a | 1.6 m |\n| b | 2.0 m |\n\nfar: 1.5 m, 3e-5 m, 5 s\n"
    assert [number.text for number in unclear] == ["1.5"]


def test_rows_of_a_printed_table_are_put_where_a_page_has_the_old_ones():
    old, printed = {"lqr": {"stands": [2, 5, 1, 3]}}, "| law | stands |\n|---|---|\n| lqr | 3 of 5 (2–4) |\n"
    ours = "| law | stands |\n|---|---|\n| `lqr` | 2 of 5 (1–3) |\n| other | 2 of 5 (1–3) |\n\n"
    others = "| law | falls |\n|---|---|\n| lqr | 2 of 5 |\n\n| law | stands |\n|---|---|\n| lqr | 0 of 5 (0–1) |\n"
    new = ours.replace("2 of 5 (1–3)", "3 of 5 (2–4)", 1)
    assert put_tables(ours + others, old, printed) == new + others
    assert put_tables(others + ours, old, printed) == others + new
    assert put_tables(ours + ours, old, printed) == ours + ours


@pytest.fixture
def clone(tmp_path, monkeypatch):
    """A clone with a room, a page and a result whose command prints a number of that room."""
    monkeypatch.setattr(results, "ROOT", tmp_path)
    monkeypatch.setattr(results, "FOLDER", tmp_path / "results")
    monkeypatch.setattr(results, "SOURCES", tmp_path / "src" / "flypend")
    for folder in ("results", "docs", "src/flypend/room"):
        (tmp_path / folder).mkdir(parents=True)
    source = tmp_path / "src" / "flypend" / "room" / "law.py"
    source.write_text("print('a: 1.25 m')\n", encoding="utf-8")
    command = f"{sys.executable} {source}"
    result = Result("one", command, {"room": {}}, date(2026, 1, 1), "", {"a": [1.25]})
    (tmp_path / "results" / "one.toml").write_text(result.text(), encoding="utf-8")
    (tmp_path / "README.md").write_text(f"    {command}\n\nIt goes 1.25 m.\n", encoding="utf-8")
    return tmp_path, source


def told(capsys):
    """What a list of the results says of the only one."""
    capsys.readouterr()
    results.main([])
    return capsys.readouterr().out.split(maxsplit=2)[2].strip()


def test_results_say_what_has_changed_since_and_are_measured_again(clone, capsys):
    folder, source = clone
    assert told(capsys) == "of code that was not recorded"
    results.main(["one"])
    assert told(capsys) == "fresh"
    source.write_text("print('a: 1.34 m')\n", encoding="utf-8")
    assert told(capsys) == "older than room/law.py"
    results.main(["one"])
    (fresh,) = results.results()
    assert fresh.values == {"a": [1.34]}
    assert fresh.age() == "fresh"
    assert "It goes 1.34 m." in (folder / "README.md").read_text(encoding="utf-8")
    with pytest.raises(SystemExit, match="no result two"):
        results.main(["two"])


def test_a_result_is_older_than_code_that_came_went_or_changed_and_not_than_words(clone):
    _, source = clone
    results.main(["one"])
    (result,) = results.results()
    source.write_text('"""A law."""\n\nprint(\'a: 1.25 m\')  # as measured\n', encoding="utf-8")
    assert result.age() == "fresh"
    for name in "abcd":
        source.with_name(f"{name}.toml").write_text("", encoding="utf-8")
    assert result.changed() == {"room": ["a.toml", "b.toml", "c.toml", "d.toml"]}
    source.unlink()
    assert result.age() == "older than 5 files of room"


def test_a_command_that_fails_measures_nothing(clone):
    _, source = clone
    source.write_text("raise SystemExit('no')\n", encoding="utf-8")
    with pytest.raises(RuntimeError, match="ends with 1"):
        results.main(["one"])
    assert results.results()[0].values == {"a": [1.25]}
