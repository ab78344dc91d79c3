"""Modules that a command needs at its end, imported while it flies: drawing libraries take a second."""

from __future__ import annotations

from contextlib import suppress
from importlib import import_module
from threading import Thread


def import_ahead(module: str) -> None:
    """Import `module` in a thread. What fails there fails again, and is told, where the module is used."""

    def bring() -> None:
        with suppress(Exception):
            import_module(module)

    Thread(target=bring, daemon=True, name=f"import {module}").start()
