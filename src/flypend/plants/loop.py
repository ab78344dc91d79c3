"""The closed loop as one record: what flies, what steers it, and what stands between the two."""

from __future__ import annotations

from dataclasses import dataclass

from flypend.laws import Law
from flypend.model import Vehicle
from flypend.plants.plant import AnyPlant


@dataclass(frozen=True)
class Loop:
    """A vehicle under a bound law through a plant: everything that compiled code depends on.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle that the law believes in.
    law : Law
        The law, bound to that vehicle.
    plant : Ideal or Sampled
        What stands between the law and the world.
    parameters : tuple of str
        Gains that are inputs of the code, so that they may differ from run to run.
    """

    vehicle: Vehicle
    law: Law
    plant: AnyPlant
    parameters: tuple[str, ...] = ()
