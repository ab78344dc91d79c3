"""Which gains of a law have sliders."""

from __future__ import annotations

from flypend.laws import Controller, Law


def sliders_of(law: Law | Controller) -> tuple[str, ...]:
    """Return the names of the gains of `law` that have sliders: numeric gains with a label."""
    return tuple(name for name, gain in law.table.items() if gain.label and gain.numeric)
