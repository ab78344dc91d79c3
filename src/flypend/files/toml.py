"""Settings as TOML."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import tomli_w


def toml_text(settings: Mapping[str, Any]) -> str:
    """`settings` (numbers, words, lists of them, tables) as TOML that reads back as the same."""
    return tomli_w.dumps(settings)
