"""flypend models, controls and simulates a spherical pendulum on a quadrotor, on R³ × SO(3) × S²."""

from flypend import laws
from flypend.errors import InputError
from flypend.export import export_c
from flypend.flight.ensemble import Ensemble, simulate_ensemble
from flypend.flight.outcome import Outcome
from flypend.flight.request import Flight
from flypend.flight.sensitivity import Sensitivity, sensitivity
from flypend.flight.simulate import simulate
from flypend.flight.trajectory import Trajectory, load
from flypend.laws import Controller, Law
from flypend.model import State, Vehicle, Wrench, vehicle
from flypend.plants import Ideal, Noise, Plant, Wind
from flypend.studies.sweep import Study, study, sweep
from flypend.studies.tune import Objective, Tuned, tune

__version__ = "0.1.0"

__all__ = [
    "Controller",
    "Ensemble",
    "Flight",
    "Ideal",
    "InputError",
    "Law",
    "Noise",
    "Objective",
    "Outcome",
    "Plant",
    "Sensitivity",
    "State",
    "Study",
    "Trajectory",
    "Tuned",
    "Vehicle",
    "Wind",
    "Wrench",
    "export_c",
    "laws",
    "load",
    "sensitivity",
    "simulate",
    "simulate_ensemble",
    "study",
    "sweep",
    "tune",
    "vehicle",
]
