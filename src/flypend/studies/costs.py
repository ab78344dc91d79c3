"""The costs of a search, generation by generation, in a file from which an interrupted search resumes.

The points of a generation follow from the seed and from earlier costs, so only costs are kept.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from flypend.errors import InputError
from flypend.files.reading import parse_json, read_bytes
from flypend.files.schema import Field, check_arrays

KIND = "flypend tune 1"
MOST_BYTES = 2**26  # a generation takes some 0.3 kB
GENERATION = {"costs": Field(("point",))}


class Costs:
    """The costs of the generations of one search, read from `path` and appended to it; None keeps none.

    `identity` is all that the search depends on. Raises InputError if the file belongs to another search or cannot be
    written.
    """

    def __init__(self, path: Path | None, identity: str) -> None:
        self._path = path
        self._head = f"{KIND} {hashlib.sha256(identity.encode()).hexdigest()}"
        self._known = self._read()

    def _read(self) -> list[NDArray[np.float64]]:
        if self._path is None:
            return []
        try:
            lines = read_bytes(self._path, MOST_BYTES).decode("utf-8").split("\n")
        except FileNotFoundError:
            return []
        except InputError:
            raise
        except (OSError, ValueError) as error:
            raise InputError(str(self._path), "a file of costs that can be read", error) from None
        if lines[0] != self._head:
            wanted = "the costs of this search (remove the file to start over)"
            raise InputError(str(self._path), wanted, "those of another study, or another file")
        return self._whole(lines[1:])

    @staticmethod
    def _whole(lines: list[str]) -> list[NDArray[np.float64]]:
        """The costs in `lines`, up to the first one that was not written to its end, or holds other than costs."""
        found = []
        for line in lines:
            try:
                values, check = parse_json(line)
                costs = check_arrays(GENERATION, {"costs": values})["costs"]
            except (ValueError, TypeError):
                break
            if check != _check(costs):
                break
            found.append(costs)
        return found

    @property
    def generations(self) -> int:
        """Number of generations that are known."""
        return len(self._known)

    def of(self, generation: int, size: int) -> NDArray[np.float64] | None:
        """Return the costs (size,) of a generation; None if they are not known."""
        known = self._known[generation] if generation < len(self._known) else None
        return known if known is not None and known.shape == (size,) else None

    def keep(self, generation: int, costs: NDArray[np.float64]) -> None:
        """Keep the costs of a generation. Raises InputError if the file cannot be written."""
        self._known = [*self._known[:generation], costs]
        if self._path is None:
            return
        lines = [self._head, *(json.dumps([each.tolist(), _check(each)]) for each in self._known)]
        partial = self._path.with_name(f".{self._path.name}.partial")
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            partial.write_text("\n".join(lines) + "\n", encoding="utf-8")
            partial.replace(self._path)
        except OSError as error:
            wanted = "a file that can be written (rerun to resume)"
            raise InputError(str(self._path), wanted, error.strerror or error) from None


def _check(costs: NDArray[np.float64]) -> str:
    return hashlib.sha256(costs.tobytes()).hexdigest()[:16]
