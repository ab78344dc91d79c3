"""The gains of the laws: which have sliders."""

from __future__ import annotations

from flypend.laws import Controller, Law


def sliders_of(law: Law | Controller) -> tuple[str, ...]:
    """Gains of `law` that have sliders: numbers with a label."""
    return tuple(name for name, gain in law.table.items() if gain.label and gain.numeric)
