"""Laws that a room offers by name although a room above it makes them: `flypend`, above all rooms, registers them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

LAWS: dict[str, Callable[[], Any]] = {}  # laws that plan, by name
