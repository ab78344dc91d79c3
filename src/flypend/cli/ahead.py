"""Drawing libraries take a second to import: a command that needs them at its end imports them while it flies."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from threading import Thread


def ahead(imports: Callable[[], None]) -> None:
    """Call `imports` in a thread. What fails there fails again, and is told, where the module is used."""

    def bring() -> None:
        with suppress(Exception):
            imports()

    Thread(target=bring, daemon=True, name=imports.__name__).start()


def pictures_of_studies() -> None:
    """Import what draws comparisons and ladders."""
    import flypend.pictures.studies  # noqa: F401


def maps() -> None:
    """Import what draws maps."""
    import flypend.pictures.maps  # noqa: F401
