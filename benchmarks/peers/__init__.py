"""One file per peer. Each offers `PEER`; a new file here is a new row of the table."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

Fly = Callable[[Any, float], Any]


@dataclass(frozen=True)
class Peer:
    """Who flies.

    Parameters
    ----------
    name, note : str
        For the table: who, and what must be known to judge the figure.
    make : callable
        `make(problem, threads)` → `fly(starts, tolerance)` → final packed states (n, 24).
    runs : int
        Runs that are timed.
    threaded : bool
        Whether it can use more than one core by itself.
    accurate : bool
        Whether it solves the same problem, so that its error can be measured.
    """

    name: str
    note: str
    make: Callable[[Any, int], Fly]
    runs: int
    threaded: bool = False
    accurate: bool = True


def modules() -> list[str]:
    """Names of the files of this folder."""
    return sorted(found.name for found in pkgutil.iter_modules(__path__))


def peer(module: str) -> Peer:
    """The peer of the file called `module`."""
    found: Peer = importlib.import_module(f"benchmarks.peers.{module}").PEER
    return found


def peers() -> Iterator[tuple[str, Peer]]:
    """Every peer; those whose packages are missing say so when they are made."""
    for module in modules():
        yield module, peer(module)
