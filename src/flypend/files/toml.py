"""Writing settings as TOML."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import tomli_w


def toml_text(settings: Mapping[str, Any]) -> str:
    """Serialise `settings` (numbers, strings, lists of these, tables) as TOML that round-trips exactly."""
    return tomli_w.dumps(settings)
