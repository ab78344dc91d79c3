"""A law with open gains; `bind` fixes them for a vehicle."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from types import MappingProxyType
from typing import Any

from flypend import errors
from flypend.building import builds
from flypend.laws.bound import BoundLaw, Computer, Feedback, Guard
from flypend.laws.gain import Gain, check_gains, pickle_by_code, table
from flypend.laws.law_error import is_own
from flypend.laws.references import check_reference
from flypend.model import Vehicle

Values = Mapping[str, Any]


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Law(Feedback):
    """A symbolic state feedback with open gains.

    Parameters
    ----------
    name : str
        Name for tables and files.
    e3 : "up" or "down"
        Direction of the world's third axis in the law's frame; the states passed to a run are in this frame.
    control : callable
        `control(t, state, vehicle, gains) -> Control` (or a bare `Wrench`) in CasADi expressions; `gains.k` is gain k.
        With `uses_forces` it accepts a fifth argument, the estimated external forces (on vehicle, on bob), each (3, 1);
        with a `path`, the keyword argument `path`.
    gains : dict, or list of Gain
        Registry of the gains: records, or defaults by name. Stored as a dict of `Gain` by name.
    given : dict
        Values that override the defaults.
    guard : Guard or callable, optional
        Where the law stops being defined, or a function of the gain values that returns it.
    computer : Computer or callable
        Lead, prediction and observer around the law in a sampled flight, or a function that returns them, of the gains
        and of what `prepare` computed.
    uses_forces : bool
        Whether the law compensates external forces.
    uses_wrench : bool
        Whether `control` takes the wrench that acts, as the keyword argument `acting`. Rotors that lag make it differ
        from the command. Such a law flies only in `Ideal(lag=True)`.
    reference : callable, optional
        Pivot position (3, 1) to hold or follow, as a CasADi function of time; None for none.
    path : callable, optional
        Path to follow (see `laws.references.Path`); None for none.
    prepare : callable, optional
        `prepare(vehicle, gains)` returns quantities computed in advance, by name; `control` sees them among the gains.
    check : callable, optional
        `check(gains)` raises InputError if gain values are inconsistent.
    fixed : tuple of str
        Gains that determine the amount of computation; exported code holds them as constants.
    theorem : callable, optional
        `theorem(bound, start)` returns what is proved of a start: see `BoundLaw.guarantee`. None for a law without one.
    certify : callable, optional
        `certify(bound)` returns the set that rotor limits allow: see `BoundLaw.certified_set`. None for a law without.
    calm : callable, optional
        `calm(vehicle, share)` returns gains, by name, with which the vehicle trembles less when the state is estimated
        from noisy readings; `share` 0 means the defaults, 1 the calmest. None for a law without such gains.
    """

    gains: Any = field(default_factory=dict)
    given: Values = field(default_factory=dict)
    guard: Guard | Callable[[Values], Guard | None] | None = None
    computer: Computer | Callable[[Values], Computer] = field(default_factory=Computer)
    prepare: Callable[[Vehicle, Values], Values] | None = None
    calm: Callable[[Vehicle, float], Values] | None = None
    _bound: dict[Vehicle, BoundLaw] = field(default_factory=dict, init=False, repr=False)
    __reduce__ = pickle_by_code

    def __post_init__(self) -> None:
        errors.one_of("law.e3", self.e3, ("up", "down"))
        errors.check_arguments("law.control", self.control, "(t, state, vehicle, gains[, forces])")
        check_reference(self.reference)
        gains = table(self.gains)
        errors.only_known("law.fixed", self.fixed, [gain.name for gain in gains.values() if gain.numeric])
        fixed = tuple(name for name, gain in gains.items() if gain.fixed or name in self.fixed)
        object.__setattr__(self, "gains", gains)
        object.__setattr__(self, "given", MappingProxyType(check_gains(gains, self.given)))
        object.__setattr__(self, "fixed", fixed)

    def __repr__(self) -> str:
        """Return name, frame and the gains that are given."""
        given = "".join(f", {name}={value!r}" for name, value in self.given.items())
        return f"<Law {self.name}, e3 {self.e3}, {len(self.gains)} gains{given}>"

    @property
    def values(self) -> dict[str, Any]:
        """Values by name of the gains that do not depend on the vehicle."""
        return {
            name: self.given.get(name, gain.default)
            for name, gain in self.gains.items()
            if name in self.given or not callable(gain.default)
        }

    def with_gains(self, given: Values, prefix: str = "") -> Law:
        """Return the law with the gains `given`, checked; messages begin with `prefix`.

        Raises InputError if a gain is unknown (naming the closest match) or a value is out of bounds.
        """
        return replace(self, given={**self.given, **check_gains(self.gains, given, prefix)})

    @property
    def table(self) -> Mapping[str, Gain]:  # type: ignore[override]  # nobody sets it
        """Registry of the gains."""
        found: Mapping[str, Gain] = self.gains
        return found

    def gains_for(self, vehicle: Vehicle) -> dict[str, Any]:
        """Return the values of all gains by name: as given, else the default for `vehicle`.

        Raises InputError if values are inconsistent.
        """
        values = {
            name: self.given[name] if name in self.given else gain.value(vehicle) for name, gain in self.gains.items()
        }
        if self.check is not None:
            self.check(values)
        return values

    def bind(self, vehicle: Vehicle) -> BoundLaw:
        """Return the law bound to `vehicle`; equal vehicles share one object.

        Raises InputError if gains are inconsistent.
        """
        vehicle = vehicle.commanded()
        if vehicle not in self._bound:
            self._bound[vehicle] = self._bind(vehicle)
        return self._bound[vehicle]

    @builds
    def _bind(self, vehicle: Vehicle) -> BoundLaw:
        gains = self.gains_for(vehicle)
        prepared = {} if self.prepare is None else self.prepare(vehicle, gains)
        bound = BoundLaw(
            **{entry.name: getattr(self, entry.name) for entry in fields(Feedback)},
            vehicle=vehicle,
            table=self.gains,
            gains=gains,
            prepared=prepared,
            guard=self.guard(gains) if callable(self.guard) else self.guard,
            computer=self.computer({**prepared, **gains}) if callable(self.computer) else self.computer,
            calmer=self._calmer(vehicle),
        )
        return bound.try_out() if is_own(self.control) else bound

    def _calmer(self, vehicle: Vehicle) -> Callable[[float, Iterable[str]], BoundLaw] | None:
        """Return the `calmer` of the law bound to `vehicle`; None if it has no calm gains, or all are given."""
        calm = self.calm
        calmed = set() if calm is None else set(calm(vehicle, 1.0)) - set(self.given)
        if calm is None or not calmed:
            return None
        made: dict[tuple[float, tuple[str, ...]], BoundLaw] = {}

        def calm_by(share: float, varied: Iterable[str]) -> BoundLaw:
            bound, held = self.bind(vehicle), tuple(sorted(calmed & set(varied)))
            changed = calmed - set(held) if share else set()
            if not held and not changed:
                return bound
            ratios = {
                name: value / bound.gains[name] for name, value in calm(vehicle, share).items() if name in changed
            }
            prepared = {**bound.prepared, "calming": ratios} if changed else bound.prepared
            law = replace(bound, prepared=prepared, calm=share if changed else 0.0, varied=held)
            return made.setdefault((share, held), law)

        return calm_by
