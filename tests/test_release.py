"""What `make release` writes, without building anything."""

import importlib.util
from pathlib import Path

import pytest

import flypend as fp

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def release():
    """The script."""
    spec = importlib.util.spec_from_file_location("release", ROOT / ".ci" / "release.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_each_file_has_the_version_of_the_package_once(release):
    for name, pattern in release.FILES.items():
        assert pattern.findall((ROOT / name).read_text(encoding="utf-8")) == [fp.__version__], name


def test_the_changelog_is_dated_at_the_top(release):
    text = "# Changelog\n\n## 1.2.0 (unreleased)\n\n- New.\n\n## 1.1.0 (2020-01-01)\n"
    assert release.stamped(text, "1.2.0", "2021-02-03") == text.replace("(unreleased)", "(2021-02-03)")
    for version in ("1.1.0", "1.3.0"):
        with pytest.raises(SystemExit, match="CHANGELOG"):
            release.stamped(text, version, "2021-02-03")


def test_the_next_version_has_a_section(release):
    version = fp.__version__.split(".dev")[0]
    assert f"## {version} (" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("arguments", [[], ["0.3"], ["v0.3.0"], ["0.3.0", "0.4.0"]])
def test_another_number_is_refused(release, monkeypatch, arguments):
    monkeypatch.setattr("sys.argv", ["release.py", *arguments])
    with pytest.raises(SystemExit, match="version"):
        release.main()
