"""Settings as TOML."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import tomli_w

from flypend.errors import InputError
from flypend.files.reading import read_text

# Names of one key, a.b.c: settings have five. `tomllib` takes their square in time: 10 s for 16,000.
MOST_NAMES = 30
_NAME = re.compile(r"""(?:(?<![\w-])[\w-]++|"[^"\n]*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+""")


def toml_text(settings: Mapping[str, Any]) -> str:
    """Serialise `settings` (numbers, strings, lists of these, tables) as TOML that round-trips exactly."""
    return tomli_w.dumps(settings)


def parse_toml(field: str, text: str) -> dict[str, Any]:
    """Parse TOML. Raises InputError, for `field`, if `text` is none, or nested too deeply."""
    names, end = 0, -1
    for found in _NAME.finditer(text):
        names, end = (names + 1 if found.start() == end else 1), found.end()
        if names >= MOST_NAMES:
            raise InputError(field, f"TOML with keys of at most {MOST_NAMES} names", "a longer one")
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise InputError(field, "TOML nested a few levels deep", "hundreds of levels") from None
    except ValueError as error:
        raise InputError(field, "a TOML file", error) from None


def read_toml(path: str | Path) -> dict[str, Any]:
    """Parse a TOML file. Raises InputError if it cannot be read, is not TOML, or is too large."""
    try:
        text = read_text(path)
    except InputError:
        raise
    except OSError as error:
        raise InputError(str(path), "a readable TOML file", error.strerror or error) from None
    except UnicodeDecodeError as error:
        before = error.object[: error.start]
        line, column = before.count(b"\n") + 1, error.start - before.rfind(b"\n")
        given = f"byte 0x{error.object[error.start]:02x} (at line {line}, column {column})"
        raise InputError(str(path), "a TOML file in UTF-8", given) from None
    except ValueError as error:  # a name that no file can have
        raise InputError(str(path), "a TOML file", error) from None
    return parse_toml(str(path), text)
