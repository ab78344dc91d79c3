"""The command line, called in this process."""

import signal
import sys

import pytest

from flypend.cli import app as cli


@pytest.fixture
def call(tmp_path, monkeypatch, capsys):
    """The command in this process, in `tmp_path`: code, what it printed, and its complaints."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    handler = signal.getsignal(signal.SIGTERM)

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["flypend", *map(str, arguments)])
        with pytest.raises(SystemExit) as exit_:
            cli.main()
        return exit_.value.code, *capsys.readouterr()

    yield run
    signal.signal(signal.SIGTERM, handler)
