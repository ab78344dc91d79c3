"""The closed loop as one record: what flies, what steers it, and what stands between the two."""

from __future__ import annotations

from dataclasses import dataclass

from flypend.errors import InputError
from flypend.laws import BoundLaw, Controller
from flypend.model import Vehicle
from flypend.plants.plant import AnyPlant, Sampled, sampled_plant


@dataclass(frozen=True)
class Loop:
    """A vehicle under a bound law through a plant: everything that compiled code depends on.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle that the law believes in.
    law : BoundLaw or Controller
        The law, bound to that vehicle.
    plant : Ideal or Sampled
        What stands between the law and the world.
    parameters : tuple of str
        Gains that are inputs of the code, so that they may differ from run to run.
    """

    vehicle: Vehicle
    law: BoundLaw | Controller
    plant: AnyPlant
    parameters: tuple[str, ...] = ()

    @property
    def symbolic(self) -> BoundLaw:
        """The law, which must be one in symbols. Raises InputError for any other."""
        if not isinstance(self.law, BoundLaw):
            raise InputError("law", "a Law, written in symbols", self.law.name)
        return self.law

    @property
    def sampled(self) -> Sampled:
        """The plant, which must be a sampled one. Raises InputError for the ideal one."""
        return sampled_plant(self.plant)
