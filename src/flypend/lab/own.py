"""Custom laws, which a page selects by name. A page can never name a file to run."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from flypend.errors import InputError
from flypend.laws import Controller, Gain, Law, law_names
from flypend.laws.closed_loop import symbolic_loop
from flypend.model import vehicle
from flypend.settings.laws import absolute, law_named, split_place


@dataclass(frozen=True, eq=False)
class OwnLaw:
    """A custom law.

    Parameters
    ----------
    law : Law or Controller
        The law.
    where : str
        `file.py:function` or `policy.onnx` with an absolute path, or `module:function`.
    stamp : str
        Digest of its file, so that code compiled from an older version is never flown.
    """

    law: Law | Controller
    where: str
    stamp: str


class OwnLaws:
    """The custom laws called `names`, like `--law`; a file that has changed is read again.

    Raises InputError if a name does not lead to a law.
    """

    def __init__(self, names: Iterable[str] = ()) -> None:
        self._where: dict[str, str] = {}
        self._kept: dict[str, OwnLaw] = {}
        for name in names:
            own = _load(str(absolute(name, Path.cwd())))
            taken = (*law_names(), *self._where)
            title = own.law.name
            while title in taken:
                title += " (own)"
            self._where[title], self._kept[title] = own.where, own

    def __getstate__(self) -> dict[str, Any]:
        """Return names and places: laws are read again where they are flown."""
        return {"_where": self._where, "_kept": {}}

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names."""
        return iter(self._where)

    def __contains__(self, name: object) -> bool:
        """Whether there is a law called `name`."""
        return isinstance(name, str) and name in self._where

    def __getitem__(self, name: str) -> OwnLaw:
        """Return the law called `name`, from its file as it is now. Raises InputError if the file has an error."""
        where, kept = self._where[name], self._kept.get(name)
        if kept is None or kept.stamp != _stamp(where):
            kept = self._kept[name] = _load(where)
        return kept


def _load(where: str) -> OwnLaw:
    law = law_named(where)
    return OwnLaw(_tunable(law) if isinstance(law, Law) else law, where, _stamp(where))


def _tunable(law: Law) -> Law:
    """Return `law` with sliders only for gains that can be compiled inputs; a gain tested by an `if` cannot."""
    example = vehicle("hehn2011")

    def usable(gain: Gain) -> bool:
        try:
            symbolic_loop(example, law, (gain.name,))
        except InputError:
            return False
        return True

    found = [gain if not gain.label or usable(gain) else replace(gain, label="") for gain in law.table.values()]
    return replace(law, gains=found)


def _stamp(where: str) -> str:
    file = Path(split_place(where)[0])
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else ""


NONE = OwnLaws()
