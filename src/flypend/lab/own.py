"""Laws of one's own that pages may choose, by name. A page never says which file to run."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from flypend.errors import InputError
from flypend.laws import Controller, Gain, Law, law_names
from flypend.laws.closed_loop import symbolic_loop
from flypend.model import vehicle
from flypend.settings.laws import absolute, law_named


@dataclass(frozen=True, eq=False)
class OwnLaw:
    """A law of one's own.

    Parameters
    ----------
    law : Law or Controller
        The law.
    where : str
        `file.py:function`, the path absolute, or `module:function`.
    stamp : str
        Digest of its file, so that what was compiled from another text is not flown.
    """

    law: Law | Controller
    where: str
    stamp: str


class OwnLaws:
    """The laws of one's own called `names`, as `--law` takes them; a file that has changed is read again.

    Raises InputError for one that is none.
    """

    def __init__(self, names: Iterable[str] = ()) -> None:
        self._kept: dict[str, OwnLaw] = {}
        for name in names:
            own = _loaded(str(absolute(name, Path.cwd())))
            taken = (*law_names(), *self._kept)
            title = own.law.name
            while title in taken:
                title += " (own)"
            self._kept[title] = own

    def __iter__(self) -> Iterator[str]:
        """Their names."""
        return iter(self._kept)

    def __contains__(self, name: object) -> bool:
        """Whether one is called so."""
        return isinstance(name, str) and name in self._kept

    def __getitem__(self, name: str) -> OwnLaw:
        """The law called `name`, as its file says now. Raises InputError for a mistake in it."""
        kept = self._kept[name]
        if kept.stamp != _stamp(kept.where):
            kept = self._kept[name] = _loaded(kept.where)
        return kept


def _loaded(where: str) -> OwnLaw:
    law = law_named(where)
    return OwnLaw(_tunable(law) if isinstance(law, Law) else law, where, _stamp(where))


def _tunable(law: Law) -> Law:
    """`law` with sliders only for what can be an input of compiled code: not for a gain that decides an `if`."""
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
    file = Path(where.rpartition(":")[0])
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.suffix == ".py" and file.is_file() else ""


NONE = OwnLaws()
