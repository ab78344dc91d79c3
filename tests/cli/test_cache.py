"""flypend cache: where machine code is, cleared and moved; a folder of others ends in one line and code 2."""

import pytest

FLIGHT = ("run", "4", "--set", "duration=0.1", "--no-figures")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The default place of the cache of a user who has never flown."""
    monkeypatch.delenv("FLYPEND_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    return tmp_path / "cache" / "flypend" / "machine-code"


def test_it_is_shown_cleared_and_moved(folder, call, tmp_path):
    code, told, _ = call("cache")
    assert code == 0
    assert str(folder) in told
    assert "0 entries" in told
    assert not folder.exists()
    assert call(*FLIGHT, "--set", "law.gains.k_d=2.125")[0] == 0
    kept = {path.name for path in folder.iterdir()}
    assert f"{len(kept)} entries" in call("cache")[1]
    assert kept
    assert call("cache", "move", "new")[0] == 0  # relative to the current folder
    assert {path.name for path in (tmp_path / "new").iterdir()} == kept
    code, told, _ = call("cache")
    assert str(tmp_path / "new") in told
    assert f"{len(kept)} entries" in told
    assert call("cache", "clear")[0] == 0
    assert list((tmp_path / "new").iterdir()) == []
    assert "0 entries" in call("cache")[1]


@pytest.mark.parametrize("named", ["variable", "settings", "default"])
@pytest.mark.parametrize("command", [FLIGHT, ("cache",), ("cache", "clear"), ("compare", "--runs", "2")])
def test_a_folder_that_others_may_write_to_is_one_line_and_code_2(command, named, folder, call, monkeypatch, tmp_path):
    if named == "variable":
        folder = tmp_path / "named"
        monkeypatch.setenv("FLYPEND_CACHE", str(folder))
    if named == "settings":
        folder = tmp_path / "named"
        assert call("cache", "move", folder)[0] == 0
    folder.mkdir(parents=True, exist_ok=True)
    folder.chmod(0o777)
    changes = ("--set", "law.gains.k_d=2.375") if command == FLIGHT else ()  # which nobody has compiled in this process
    code, told, complaints = call(*command, *changes)
    assert (code, told, complaints.count("\n")) == (2, "", 1), complaints
    assert str(folder) in complaints
    assert not list(tmp_path.glob("*-out"))


@pytest.mark.parametrize("arguments", [("move",), ("move", "file"), ("move", "file/new"), ("sell",), ("clear", "all")])
def test_what_cannot_be_meant_is_one_line_and_code_2(arguments, folder, call, tmp_path):
    (tmp_path / "file").touch()
    code, _, complaints = call("cache", *arguments)
    assert (code, complaints.count("\n")) == (2, 1), complaints
    assert not (tmp_path / "config").exists()


def test_a_move_beside_the_variable_is_refused(folder, call, monkeypatch, tmp_path):
    monkeypatch.setenv("FLYPEND_CACHE", str(tmp_path / "named"))
    code, _, complaints = call("cache", "move", "new")
    assert (code, complaints.count("\n")) == (2, 1)
    assert "FLYPEND_CACHE" in complaints
    assert list(tmp_path.iterdir()) == []
