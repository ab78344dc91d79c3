"""flypend models, controls and simulates a spherical pendulum on a quadrotor, on R³ × SO(3) × S²."""

from flypend import laws
from flypend.errors import InputError
from flypend.integrate import Outcome
from flypend.laws import Law
from flypend.model import State, Vehicle, Wrench, vehicle
from flypend.simulate import simulate
from flypend.trajectory import Trajectory, load

__version__ = "0.1.0"

__all__ = [
    "InputError",
    "Law",
    "Outcome",
    "State",
    "Trajectory",
    "Vehicle",
    "Wrench",
    "laws",
    "load",
    "simulate",
    "vehicle",
]
