"""flypend vehicle new: a file that every command takes, from parts with units; nonsense is one line."""

from importlib import import_module

import pytest

import flypend as fp

PARTS = ("--mass", "620g", "--arm", "17cm", "--propeller", "8x4.5", "--rod-length", "90cm", "--rod-mass", "30g",
         "--bob-mass", "0.04")  # fmt: skip


def test_the_file_is_the_vehicle_with_its_sources(call, tmp_path):
    code, told, _ = call("vehicle", "new", *PARTS, "--motor", "920KV", "--battery", "3S", "-o", "mine.toml")
    assert code == 0
    assert "times its weight" in told
    mine = fp.vehicle(tmp_path / "mine.toml")
    estimated = fp.Vehicle.estimate(
        mass=0.62, arm=0.17, propeller="8x4.5", rod_length=0.9, rod_mass=0.03, bob_mass=0.04, motor="920 KV",
        battery="3S",
    )  # fmt: skip
    assert mine == estimated
    assert "Leishman" in (tmp_path / "mine.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (("--mass", "620"), "flypend: mass: expected 0.005 to 100 kg, got 620 kg (in g? write 620g)\n"),
        (("--motor", "920KV"), "flypend: battery: expected the battery that goes with the motor, got nothing\n"),
        (("-o", "mine.txt"), "flypend: "),
        (("--mount", "hook"), "flypend: mount: "),
    ],
)
def test_nonsense_is_one_line_and_writes_nothing(call, tmp_path, changes, said):
    code, _, told = call("vehicle", "new", *PARTS, *changes)
    assert code == 2
    assert told.startswith(said)
    assert told.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_what_is_missing_is_said(call):
    assert call("vehicle")[::2] == (2, "flypend: Missing command: new. See flypend vehicle --help.\n")
    assert call("vehicle", "new")[::2] == (2, "flypend: Missing option '--mass'. See flypend vehicle new --help.\n")


def test_a_file_with_numbers_put_in_by_hand_is_kept(call, tmp_path):
    file = tmp_path / "mine.toml"
    for _ in range(2):
        assert call("vehicle", "new", *PARTS)[0] == 0
    written = file.read_text(encoding="utf-8")
    file.write_text(written.replace("rotor_spins = [1", "rotor_spins = [1.0"), encoding="utf-8")
    code, _, told = call("vehicle", "new", *PARTS)
    assert code == 2
    assert told.startswith("flypend: mine.toml: expected no file")
    assert "[1.0" in file.read_text(encoding="utf-8")
    assert call("vehicle", "new", *PARTS, "--force")[0] == 0
    assert file.read_text(encoding="utf-8") == written


def test_a_rehearsal_overwrites_no_flight(call, tmp_path):
    (tmp_path / "flight.csv").write_text("a minute of a real flight", encoding="utf-8")
    code, _, told = call("identify", "flight.csv", "--rehearse", "--duration", "10.5")
    assert (code, told) == (2, "flypend: flight.csv: expected no file yet, as --rehearse writes it, got one\n")
    assert (tmp_path / "flight.csv").read_text(encoding="utf-8") == "a minute of a real flight"


@pytest.mark.parametrize("converged", [False, True])
def test_a_search_that_has_not_converged_says_so_in_its_file(call, tmp_path, monkeypatch, converged):
    room = import_module("flypend.identification.fit")  # `fit` of the room is the function
    monkeypatch.setattr(room, "PASSES", 1)
    monkeypatch.setattr(room, "UNGATED", -1)  # so that one pass can converge
    monkeypatch.setattr(room, "DONE", 1e9 * converged)
    code, told, _ = call("identify", "flight.csv", "--rehearse", "--duration", "10.5", "-o", "mine.toml")
    assert code == 0
    assert ("NOT converged" in told) is not converged
    text = (tmp_path / "mine.toml").read_text(encoding="utf-8")
    assert text.startswith("# The search has NOT converged") is not converged
    assert fp.vehicle(tmp_path / "mine.toml").bands
