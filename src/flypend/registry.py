"""What a room offers although a room above it makes it: `flypend`, which stands above all of them, says where it is."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

LAWS: dict[str, Callable[[], Any]] = {}  # laws that plan, by name
