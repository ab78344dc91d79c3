"""The closed loop as one record: vehicle, law and plant."""

from __future__ import annotations

from dataclasses import dataclass

from flypend.errors import InputError
from flypend.laws import BoundLaw, Controller
from flypend.model import Vehicle
from flypend.plants.plant import AnyPlant, Ideal, Sampled, as_sampled
from flypend.plants.tremor import calm


@dataclass(frozen=True)
class Loop:
    """Vehicle, bound law and plant: everything that compiled code depends on.

    A law that has calmer gains takes them as far as the sensors of the plant need (see `plants.tremor`).

    Parameters
    ----------
    vehicle : Vehicle
        The nominal vehicle, which the law assumes; kept in units of commanded force.
    law : BoundLaw or Controller
        The law, bound to that vehicle.
    plant : Ideal or Sampled
        The plant.
    parameters : tuple of str
        Names of gains that are inputs of the compiled code, so they can differ between runs.
    """

    vehicle: Vehicle
    law: BoundLaw | Controller
    plant: AnyPlant
    parameters: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "vehicle", self.vehicle.commanded())
        if isinstance(self.law, BoundLaw):
            limited = isinstance(self.plant, Ideal) and self.plant.limits
            object.__setattr__(self, "law", self.law.limited if limited else calm(self.law, self.plant))

    @property
    def symbolic(self) -> BoundLaw:
        """The law, which must be symbolic. Raises InputError otherwise."""
        if not isinstance(self.law, BoundLaw):
            raise InputError("law", "a Law, written in symbols", self.law.name)
        return self.law

    @property
    def lag(self) -> bool:
        """Whether the plant is ideal but for the rotors' lag."""
        return isinstance(self.plant, Ideal) and self.plant.lag

    @property
    def touches(self) -> bool:
        """Whether there is something to touch: for the rod on its mount, or a floor."""
        return self.vehicle.mount != "gimbal" or self.plant.floor is not None

    @property
    def sampled(self) -> Sampled:
        """The plant, which must be sampled. Raises InputError for the ideal plant."""
        return as_sampled(self.plant)
