"""The command line."""

from flypend.cli.app import main

__all__ = ["main"]
