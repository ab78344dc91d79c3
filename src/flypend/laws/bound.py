"""A law bound to one vehicle, with a value for every gain, and its output."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from types import MappingProxyType, SimpleNamespace
from typing import Any

import casadi as ca
import numpy as np

from flypend import errors
from flypend.geometry import Numbers, Scalar, Vector
from flypend.laws.gain import Gain, Tunable, is_number
from flypend.laws.guarantee import Guarantee, list_unmodelled
from flypend.laws.law_error import LawError, Located, check_finite, innermost, is_own, location, wrench_of
from flypend.laws.references import Path, Reference
from flypend.model import State, Vehicle, Wrench
from flypend.model.allocation import allocate
from flypend.model.state import FLIP_PACKED, SIZE, E3Direction

TRIED = 2  # states in which a law of the user's own is evaluated at binding
# Maps (thrust, moment) between the e₃-down and the e₃-up frame, either way.
FLIP_WRENCH = np.array([-1.0, 1.0, -1.0, -1.0])


@errors.named_arguments
@dataclass(frozen=True)
class Guard:
    """A quantity that must not vanish: where `signal` drops below `threshold`, the law is undefined for `reason`."""

    signal: str
    threshold: float
    reason: str


MAX_LATENCY = 0.5  # s; the flight computer predicts over it, command by command


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Computer:
    """Settings of the flight computer around a law in a sampled flight. The ideal plant ignores them.

    Parameters
    ----------
    lead : float
        Rotors are commanded f̂ + lead (f − f̂), where f̂ is their modelled force: a lag T acts like T/lead. 1 for none.
    latency : float
        Delay to compensate, s: the law sees the state predicted this far ahead, given the commands in transit.
    delay_reach : float
        Largest delay beyond `latency` that the flight computer finds in flight, s; 0 for none.
    models_lag : bool
        Whether the law itself accounts for the rotors' lag. If not, the part of the lag that the lead leaves is
        predicted over, like a delay that was found: the law sees the state after both.
    observer : float
        Bandwidth of the external-force observer, 1/s; 0 for none. Only for a law with `uses_forces`.
    force_limit : float
        Largest estimate of an external force, in units of the vehicle's weight.
    """

    lead: float = 1.0
    latency: float = 0.0
    delay_reach: float = 0.0
    models_lag: bool = False
    observer: float = 0.0
    force_limit: float = 0.5

    def __post_init__(self) -> None:
        errors.number("lead", self.lead, at_least=1)
        errors.number("latency", self.latency, at_least=0, at_most=MAX_LATENCY, unit="s")
        errors.number("delay_reach", self.delay_reach, at_least=0, at_most=MAX_LATENCY, unit="s")
        if not isinstance(self.models_lag, bool):
            raise errors.InputError("models_lag", "true or false", repr(self.models_lag))
        errors.number("observer", self.observer, at_least=0, unit="1/s")
        errors.number("force_limit", self.force_limit, at_least=0)


COMPUTER = tuple(entry.name for entry in fields(Computer))


def computer_of(gains: Mapping[str, Any]) -> Computer:
    """Return the flight computer with the settings that are among `gains`."""
    return Computer(**{name: gains[name] for name in COMPUTER if name in gains})


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Control:
    """Output of a law: the wrench, and scalars to record.

    Parameters
    ----------
    wrench : Wrench
        Thrust and moment, in the law's frame.
    lyapunov : dict
        Scalar expressions whose sum is the law's Lyapunov function V. The closed loop adds V, and the rates of V and of
        each scalar.
    signals : dict
        Other scalar expressions to record.
    """

    wrench: Wrench
    lyapunov: Mapping[str, Scalar] = field(default_factory=dict)
    signals: Mapping[str, Scalar] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True, eq=False)
class Feedback(Tunable):
    """What a law is, whether bound to a vehicle or not: see `Law`."""

    name: str
    e3: E3Direction
    control: Callable[..., Control | Wrench]
    uses_forces: bool = False
    uses_wrench: bool = False
    reference: Reference | None = None
    path: Path | None = None
    check: Callable[[Mapping[str, Any]], None] | None = None
    fixed: tuple[str, ...] = ()
    theorem: Callable[[BoundLaw, State], Guarantee] | None = None
    certify: Callable[[BoundLaw], Any] | None = None


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class BoundLaw(Feedback):
    """A law ready to fly: every gain has a value for one vehicle. Made by `Law.bind`.

    Parameters
    ----------
    name, e3, control, uses_forces, uses_wrench, reference, path, check, fixed, theorem, certify
        As in `Law`.
    vehicle : Vehicle
        The nominal vehicle.
    table : dict of Gain
        Registry of the gains.
    gains : dict
        Gain values by name.
    prepared : dict
        Quantities computed for the vehicle in advance; the equations see them along with the gains.
    guard : Guard, optional
        Where the law stops being defined.
    computer : Computer
        Lead, prediction and observer around the law in a sampled flight.
    calmer : callable, optional
        `calmer(share, varied)` returns the law with gains that, near its reference, are moved by `share` from the
        defaults to those that tremble least under noise, but for those named in `varied`: always the same object. None
        for a law without such gains.
    calm : float
        That share, of this law.
    varied : tuple of str
        Gains that differ from run to run and would else be moved: their values are given, and stay.
    within_limits : bool
        Whether `evaluate` keeps the wrench within what the rotors of `vehicle` give: see `limited`.
    """

    vehicle: Vehicle
    table: Mapping[str, Gain] = field(default_factory=dict)
    gains: Mapping[str, Any] = field(default_factory=dict)
    prepared: Mapping[str, Any] = field(default_factory=dict)
    guard: Guard | None = None
    computer: Computer = field(default_factory=Computer)
    calmer: Callable[[float, Iterable[str]], BoundLaw] | None = None
    calm: float = 0.0
    varied: tuple[str, ...] = ()
    within_limits: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "gains", MappingProxyType(dict(self.gains)))

    def __repr__(self) -> str:
        """Return name, frame and vehicle."""
        return f"<BoundLaw {self.name}, e3 {self.e3}, {len(self.gains)} gains for {self.vehicle.name}>"

    def bind(self, vehicle: Vehicle) -> BoundLaw:
        """Return the law itself, already bound to `vehicle`. Raises InputError if it is bound to another vehicle."""
        if vehicle.commanded() != self.vehicle:
            raise errors.InputError("law", f"one bound to {vehicle.name}", f"{self.name} bound to {self.vehicle.name}")
        return self

    def guarantee(self, start: State) -> Guarantee:
        """Return what the law's theorem says of a single `start`, in the law's frame: see `laws.guarantee.Guarantee`.

        A vehicle that the theorem does not model (`laws.guarantee.list_unmodelled`) is not covered, wherever it starts.

        Raises InputError if the law has no theorem, has been moved `along` a path, or `start` is a batch.
        """
        if self.theorem is None:
            raise errors.InputError("law", "one with a theorem: repaired or almost_global, on its own path", self.name)
        missing = list_unmodelled(self.vehicle)
        if missing:
            return Guarantee(covered=False, reason=f"outside the theorem: {missing}", V=math.inf)
        return self.theorem(self, start)

    def certified_set(self) -> Any:
        """Return the largest set {V ≤ c, |ω₃| ≤ w} that is proved to respect the rotor limits: `CertifiedSet`.

        Raises InputError if the law has none, or the theorem does not cover vehicle or reference.
        """
        if self.certify is None:
            raise errors.InputError("law", "almost_global, on its own path", self.name)
        return self.certify(self)

    def calm_by(self, share: float) -> BoundLaw:
        """Return the law with default gains moved by `share`, 0 to 1, to those that tremble least, near its reference.

        Gains that were given stay.
        """
        return self if self.calmer is None or share == self.calm else self._follow(self.calmer(share, self.varied))

    def vary(self, names: Iterable[str]) -> BoundLaw:
        """Return the law for runs that differ in the gains `names`, whose values stay where the law is calmed."""
        if self.calmer is None:
            return self
        found = self.calmer(self.calm, names)
        return self if found.varied == self.varied else self._follow(found)

    def _follow(self, found: BoundLaw) -> BoundLaw:
        """Return the law `found` on the path and the computer of this one."""
        if found.path is self.path and found.computer == self.computer:
            return found
        return replace(found, path=self.path, reference=self.reference, computer=self.computer)

    @cached_property
    def limited(self) -> BoundLaw:
        """The same law with its wrench kept within the rotor limits; one object, as long as the law itself lives."""
        return replace(self, within_limits=True, theorem=None)

    @property
    def numbers(self) -> dict[str, float]:
        """The real-valued gains, in order. These may vary from run to run within one program."""
        return {name: float(value) for name, value in self.gains.items() if is_number(value)}

    @property
    def options(self) -> dict[str, str]:
        """The gains that are strings."""
        return {name: value for name, value in self.gains.items() if isinstance(value, str)}

    @property
    def along(self) -> Callable[[Path], BoundLaw] | None:
        """Return the same law on another path (see `laws.references.Path`); None for a law without a path.

        The law's theorem is about its own path, so the law returned has none.
        """
        return None if self.path is None else lambda path: replace(self, path=path, theorem=None, certify=None)

    def evaluate(
        self,
        t: Scalar,
        state: State,
        vehicle: Vehicle,
        forces: tuple[Vector, Vector] | None = None,
        gains: Mapping[str, Any] | None = None,
        acting: Wrench | None = None,
    ) -> Control:
        """Return the control for CasADi symbols `t` (s) and `state`, under external `forces` (default none).

        `gains` holds symbols that replace some numeric gains. `vehicle` is the law's own, or one whose constants are
        symbols. `acting` are symbols of the wrench that acts; InputError if the law takes it and there is none.
        """
        if self.uses_wrench and acting is None:
            wanted = f"flypend.Ideal(lag=True): {self.name} takes the wrench of rotors whose lag it knows"
            raise errors.InputError("plant", wanted, "one in which no such wrench is known")
        given = SimpleNamespace(**{**self.prepared, **self.gains, **(gains or {})})
        known = (forces or (ca.SX.zeros(3), ca.SX.zeros(3)),) if self.uses_forces else ()
        followed: dict[str, Any] = {} if self.path is None else {"path": self.path}
        if self.uses_wrench:
            followed["acting"] = acting
        answer = Located(self.control, self.name) if is_own(self.control) else self.control
        control = answer(t, state, vehicle, given, *known, **followed)
        wrench = wrench_of(control, self.control, self.name)
        if self.within_limits:
            # The map between the frames is its own inverse.
            stacked = ca.vertcat(wrench.thrust, wrench.moment) * (1 if self.e3 == "up" else FLIP_WRENCH)
            forced = vehicle.mixing(self.e3) @ allocate(stacked[0], stacked[1:], vehicle)
            wrench = Wrench(forced[0], forced[1:])
        return replace(control, wrench=wrench) if isinstance(control, Control) else Control(wrench=wrench)

    def try_out(self) -> BoundLaw:
        """Return the law itself. Raises LawError if its equations fail, or return no finite wrench in random states."""
        t, packed, w = ca.SX.sym("t"), ca.SX.sym("s", SIZE), ca.SX.sym("w", 4)
        acting = Wrench(w[0], w[1:]) if self.uses_wrench else None
        control = self.evaluate(t, State.symbolic(packed), self.vehicle, acting=acting)
        where = location(innermost(self.control))
        for name, value in (*control.lyapunov.items(), *control.signals.items()):
            shape = getattr(value, "shape", ())
            if shape not in ((), (1,), (1, 1)):
                raise LawError(where, self.name, f"its signal {name} is not one number, but of shape {shape}")
        wrench = ca.vertcat(control.wrench.thrust, control.wrench.moment)
        function = ca.Function("tried", [t, packed, w], [ca.densify(wrench)])
        states = State.random(np.random.default_rng(0), TRIED).packed()
        values = [np.array(function(0.0, state, np.zeros(4))).ravel() for state in states]
        check_finite(values, self.control, self.name)
        return self

    def upright(
        self,
        t: Scalar,
        packed: Numbers,
        forces: Numbers = None,
        gains: Mapping[str, Any] | None = None,
        vehicle: Vehicle | None = None,
    ) -> Numbers:
        """Return thrust and moment (4, 1) in the e₃-up frame, whatever the law's own frame.

        Parameters
        ----------
        t, packed : SX
            Time, a symbol or an expression; and the packed state (24, 1), a symbol, in the e₃-up frame.
        forces : SX (6, 1), optional
            External forces on vehicle and bob, N; default none.
        gains : dict, optional
            Symbols that replace some numeric gains.
        vehicle : Vehicle, optional
            A vehicle whose constants are symbols; default the law's own.
        """
        external = None if forces is None else (forces[:3], forces[3:])
        time = t if isinstance(t, ca.SX) and t.is_symbolic() else ca.SX.sym("t")  # to differentiate references
        wrench = self.evaluate(time, State.symbolic(packed), vehicle or self.vehicle, external, gains).wrench
        stacked = ca.densify(ca.vertcat(wrench.thrust, wrench.moment))
        if time is not t:
            stacked = ca.substitute(stacked, time, t)
        if self.e3 == "up":
            return stacked
        return ca.substitute(stacked, packed, packed * FLIP_PACKED) * FLIP_WRENCH
