"""What `make first-contact` types is what the pages say, and it notices what a newcomer would stumble over."""

import re
import sys
from pathlib import Path

import pytest

from flypend.cli.app import app
from tests import first_contact
from tests.first_contact import LEDGER, PAGES, ROOT, RULES, BrokenError, Machine, Step, command, journeys, steps_of

TYPED = {step.text for steps in journeys().values() for step in steps}
REFUSAL = "flypend: lab: expected the extra lab (pip install '.[lab]'), got no module tornado"


def test_every_command_of_the_pages_is_typed():
    for page in PAGES:
        text = (ROOT / page).read_text(encoding="utf-8")
        code = re.findall(r"^    .*$|`[^`]*`", text, flags=re.MULTILINE)
        named = sum(len(re.findall(rf"\bflypend (?:{'|'.join(app.commands)})\b", line)) for line in code)
        assert sum(not step.is_python for step in steps_of(text)) == named
    assert sum(line.startswith("python examples/") for line in TYPED) == 4
    assert len(TYPED) > 35


def test_the_rules_are_about_commands_that_are_typed():
    named = {*RULES["needs"], *RULES["foreign"], *RULES["smaller"], *RULES["long"]["commands"]}
    assert named <= TYPED
    assert all(line == command(line) for line in named)


def test_commands_of_the_ledger_are_typed():
    assert len(TYPED & LEDGER.keys()) >= 6


def test_a_page_goes_on_where_its_python_was():
    steps = steps_of(
        "```python\na = 1\n```\n\n    flypend laws   # all\n\nand `flypend run\n4`\n\n```python\nb = a\n```\n"
    )
    assert steps == [
        Step("a = 1\n", True), Step("flypend laws"), Step("flypend run 4"), Step("a = 1\nb = a\n", True),
    ]  # fmt: skip


@pytest.fixture
def typing(tmp_path, monkeypatch):
    """Return a function that types a line where flypend is a script of Python."""

    def typed(line, script, rules=None):
        (tmp_path / "bin").mkdir()
        (tmp_path / "folder").mkdir()
        program = tmp_path / "bin" / "flypend"
        program.write_text(f"#!{sys.executable}\nimport sys, pathlib\n{script}\n", encoding="utf-8")
        program.chmod(0o755)
        monkeypatch.setattr(first_contact, "RULES", {**RULES, **(rules or {})})
        machine = Machine(tmp_path / "bin" / "python", whole=True, cache=tmp_path)
        return machine.type(Step(line), tmp_path / "folder")

    return typed


def test_a_refusal_is_one_line_with_the_extra(typing):
    assert typing("flypend lab", f"sys.exit(print({REFUSAL!r}, file=sys.stderr) or 2)") == REFUSAL


@pytest.mark.parametrize(
    "script",
    [
        "",  # it works all the same: the rule is old
        f"sys.exit(print({REFUSAL!r}, file=sys.stderr) or 1)",
        f"sys.exit(print({'warning: …' + chr(10) + REFUSAL!r}, file=sys.stderr) or 2)",
        f"pathlib.Path('plan.nc').touch(); sys.exit(print({REFUSAL!r}, file=sys.stderr) or 2)",
        f"sys.exit(print({REFUSAL.replace('extra lab', 'extra studies')!r}, file=sys.stderr) or 2)",
        f"print('solved'); sys.exit(print({REFUSAL!r}, file=sys.stderr) or 2)",
    ],
)
def test_a_worse_refusal_is_noticed(typing, script):
    with pytest.raises(BrokenError):
        typing("flypend lab", script)


NAYAK = "flypend compare --law inverted --vehicle nayak2018 --runs 500 --seed 2024"
FOUND = LEDGER[NAYAK].values["inverted"]
PRINTED = f"print('inverted {{}} 500 {FOUND['wilson_low']:.1%} {FOUND['wilson_high']:.1%}')"
GOOD = FOUND["successes"]


def test_the_numbers_of_a_page_are_compared_with_what_is_printed(typing):
    typing(NAYAK, PRINTED.format(GOOD))


@pytest.mark.parametrize(
    "script", [PRINTED.format(GOOD + 1), "print('nothing')", PRINTED.format(GOOD) + "; sys.exit(1)"]
)
def test_another_number_is_noticed(typing, script):
    with pytest.raises(BrokenError):
        typing(NAYAK, script)


def test_what_a_command_suggests_is_typed_too(typing):
    script = "sys.exit(7) if 'run' in sys.argv else print('Try: flypend run examples/swing-up.toml')"
    with pytest.raises(BrokenError, match=r"flypend run examples/swing-up\.toml ends with 7"):
        typing("flypend examples", script)


def test_a_python_that_is_not_here_is_told(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(first_contact, "python_of", lambda version: None)
    with pytest.raises(BrokenError, match="no Python"):  # nothing was typed
        first_contact.main(Path("none.whl"), tmp_path)
    assert len(capsys.readouterr().out.splitlines()) == len(first_contact.VERSIONS)
