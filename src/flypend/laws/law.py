"""What one writes down: a law with its gains open. `bind` makes it fly a vehicle."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from numpy.typing import NDArray

from flypend import errors
from flypend.laws.bound import BoundLaw, Computer, Control, Guard
from flypend.laws.gain import Gain, check_gain, checked, table
from flypend.laws.references import Path, Reference
from flypend.model import Vehicle, Wrench
from flypend.model.state import E3Direction

Values = Mapping[str, Any]


@dataclass(frozen=True, kw_only=True, eq=False)
class Law:
    """A state feedback in symbols, its gains open.

    Parameters
    ----------
    name : str
        Name for tables and files.
    e3 : "up" or "down"
        Direction of the world's third axis in which the law is written; states given to a run are in this frame.
    control : callable
        `control(t, state, vehicle, gains) -> Control` (or a bare `Wrench`) in CasADi expressions; `gains.k` is gain k.
        With `uses_forces` it takes a fifth argument, the estimated external forces (on vehicle, on bob), each (3, 1);
        with a `path` the keyword argument `path`.
    gains : dict, or list of Gain
        Its registry of gains: records, or defaults by name. It is kept as a dict of `Gain` by name.
    given : dict
        Values that replace defaults.
    guard : Guard or callable, optional
        Where the law stops being defined, or a rule for that from the values of the gains.
    computer : Computer or callable
        Lead, prediction and observer around the law in a sampled flight, or a rule for them from the gains.
    uses_forces : bool
        Whether the law compensates external forces.
    reference : callable, optional
        Position (3, 1) of the pivot that the law holds or follows, as a CasADi function of time; None for none.
    path : callable, optional
        What the law follows (see `laws.references.Path`); None for none.
    prepare : callable, optional
        `prepare(vehicle, gains)` gives what can be worked out beforehand, by name; `control` sees it among the gains.
    check : callable, optional
        `check(gains)` raises InputError for values that do not go together.
    fixed : tuple of str
        Gains that decide how much there is to compute: exported code holds them as constants.
    """

    name: str
    e3: E3Direction
    control: Callable[..., Control | Wrench]
    gains: Any = field(default_factory=dict)
    given: Values = field(default_factory=dict)
    guard: Guard | Callable[[Values], Guard | None] | None = None
    computer: Computer | Callable[[Values], Computer] = field(default_factory=Computer)
    uses_forces: bool = False
    reference: Reference | None = None
    path: Path | None = None
    prepare: Callable[[Vehicle, Values], Values] | None = None
    check: Callable[[Values], None] | None = None
    fixed: tuple[str, ...] = ()
    _bound: dict[Vehicle, BoundLaw] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        errors.one_of("law.e3", self.e3, ("up", "down"))
        gains = table(self.gains)
        errors.only_known("law.fixed", self.fixed, [gain.name for gain in gains.values() if gain.numeric])
        fixed = tuple(name for name, gain in gains.items() if gain.fixed or name in self.fixed)
        object.__setattr__(self, "gains", gains)
        object.__setattr__(self, "given", MappingProxyType(checked(gains, self.given)))
        object.__setattr__(self, "fixed", fixed)

    @property
    def values(self) -> dict[str, Any]:
        """Values of those gains that need no vehicle to have one, by name."""
        return {
            name: self.given.get(name, gain.default)
            for name, gain in self.gains.items()
            if name in self.given or not callable(gain.default)
        }

    def with_gains(self, given: Values, prefix: str = "") -> Law:
        """The same law with the gains `given`, checked; messages begin with `prefix`.

        Raises InputError for an unknown gain, with the nearest known name, and for a value out of bounds.
        """
        return replace(self, given={**self.given, **checked(self.gains, given, prefix)})

    def check_gain(self, name: str, values: Any, prefix: str = "gains") -> NDArray[Any]:
        """`values` of the gain called `name`, one or many, if it may take them; messages begin with `prefix`.

        Raises InputError for a name that is no number of the law, and values out of bounds.
        """
        return check_gain(self.gains, name, values, prefix)

    @property
    def table(self) -> Mapping[str, Gain]:
        """Its registry of gains."""
        found: Mapping[str, Gain] = self.gains
        return found

    def proposed(self, vehicle: Vehicle) -> dict[str, Any]:
        """The defaults of all gains for `vehicle`, by name, whatever is given."""
        return {name: gain.value(vehicle) for name, gain in self.table.items()}

    def gains_for(self, vehicle: Vehicle) -> dict[str, Any]:
        """Values of all gains by name: those given, and for the others the defaults for `vehicle`.

        Raises InputError for values that do not go together.
        """
        values = {
            name: self.given[name] if name in self.given else gain.value(vehicle) for name, gain in self.gains.items()
        }
        if self.check is not None:
            self.check(values)
        return values

    def bind(self, vehicle: Vehicle) -> BoundLaw:
        """The law as it flies `vehicle`; the same object every time for equal vehicles.

        Raises InputError for gains that do not go together.
        """
        if vehicle not in self._bound:
            self._bound[vehicle] = self._bind(vehicle)
        return self._bound[vehicle]

    def _bind(self, vehicle: Vehicle) -> BoundLaw:
        gains = self.gains_for(vehicle)
        return BoundLaw(
            name=self.name,
            e3=self.e3,
            vehicle=vehicle,
            control=self.control,
            table=self.gains,
            gains=gains,
            prepared={} if self.prepare is None else self.prepare(vehicle, gains),
            guard=self.guard(gains) if callable(self.guard) else self.guard,
            computer=self.computer(gains) if callable(self.computer) else self.computer,
            uses_forces=self.uses_forces,
            reference=self.reference,
            path=self.path,
            fixed=self.fixed,
        )
