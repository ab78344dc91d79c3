"""flypend models, controls and simulates a spherical pendulum on a quadrotor, on R³ × SO(3) × S².

Names are imported when they are first used.
"""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from flypend import laws
    from flypend.errors import InputError
    from flypend.export import export_c, export_plan
    from flypend.flight.criterion import Criterion
    from flypend.flight.ensemble import Ensemble, simulate_ensemble
    from flypend.flight.metrics import Metrics, metrics
    from flypend.flight.outcome import Outcome
    from flypend.flight.request import Flight, Tolerances
    from flypend.flight.sensitivity import Sensitivity, sensitivity
    from flypend.flight.simulate import simulate
    from flypend.flight.trajectory import Trajectory, load
    from flypend.laws import BoundLaw, Controller, Gain, Law
    from flypend.laws.linearise import linearise
    from flypend.model.air import Air
    from flypend.model.body import Body
    from flypend.model.rod import rod_with_bob, uniform_rod
    from flypend.model.shipped import vehicle
    from flypend.model.state import State, Wrench
    from flypend.model.vehicle import Vehicle
    from flypend.planning import (
        Constraints,
        Plan,
        PlanEnsemble,
        Window,
        load_plan,
        nmpc,
        plan,
        plan_and_track,
        plan_ensemble,
        track,
    )
    from flypend.plants import Ideal, Noise, Plant, Sensor, Sensors, Wind
    from flypend.studies.check import Check, check
    from flypend.studies.compare import Comparison, compare
    from flypend.studies.starts import random_starts
    from flypend.studies.sweep.run import sweep
    from flypend.studies.sweep.study import Study, study
    from flypend.studies.trial import Trial, trial
    from flypend.studies.tune import Objective, Tuned, tune

__version__ = "0.3.0.dev0"

# Where each name is defined.
_WHERE = {
    "errors": ("InputError",),
    "export": ("export_c", "export_plan"),
    "flight.criterion": ("Criterion",),
    "flight.ensemble": ("Ensemble", "simulate_ensemble"),
    "flight.metrics": ("Metrics", "metrics"),
    "flight.outcome": ("Outcome",),
    "flight.request": ("Flight", "Tolerances"),
    "flight.sensitivity": ("Sensitivity", "sensitivity"),
    "flight.simulate": ("simulate",),
    "flight.trajectory": ("Trajectory", "load"),
    "laws": ("BoundLaw", "Controller", "Gain", "Law"),
    "laws.linearise": ("linearise",),
    "model": ("State", "Vehicle", "Wrench", "vehicle"),
    "model.air": ("Air",),
    "model.body": ("Body",),
    "model.rod": ("rod_with_bob", "uniform_rod"),
    "planning": (
        "Constraints",
        "Plan",
        "PlanEnsemble",
        "Window",
        "load_plan",
        "nmpc",
        "plan",
        "plan_and_track",
        "plan_ensemble",
        "track",
    ),
    "plants": ("Ideal", "Noise", "Plant", "Sensor", "Sensors", "Wind"),
    "studies.check": ("Check", "check"),
    "studies.compare": ("Comparison", "compare"),
    "studies.starts": ("random_starts",),
    "studies.sweep": ("Study", "study", "sweep"),
    "studies.trial": ("Trial", "trial"),
    "studies.tune": ("Objective", "Tuned", "tune"),
}
_MODULES = {name: f"flypend.{module}" for module, names in _WHERE.items() for name in names}

__all__ = [
    "Air",
    "Body",
    "BoundLaw",
    "Check",
    "Comparison",
    "Constraints",
    "Controller",
    "Criterion",
    "Ensemble",
    "Flight",
    "Gain",
    "Ideal",
    "InputError",
    "Law",
    "Metrics",
    "Noise",
    "Objective",
    "Outcome",
    "Plan",
    "PlanEnsemble",
    "Plant",
    "Sensitivity",
    "Sensor",
    "Sensors",
    "State",
    "Study",
    "Tolerances",
    "Trajectory",
    "Trial",
    "Tuned",
    "Vehicle",
    "Wind",
    "Window",
    "Wrench",
    "check",
    "compare",
    "export_c",
    "export_plan",
    "laws",
    "linearise",
    "load",
    "load_plan",
    "metrics",
    "nmpc",
    "plan",
    "plan_and_track",
    "plan_ensemble",
    "random_starts",
    "rod_with_bob",
    "sensitivity",
    "simulate",
    "simulate_ensemble",
    "study",
    "sweep",
    "track",
    "trial",
    "tune",
    "uniform_rod",
    "vehicle",
]


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        found = getattr(import_module(_MODULES[name]), name)
    elif not name.startswith("_") and find_spec(f"flypend.{name}") is not None:
        found = import_module(f"flypend.{name}")
    else:
        raise AttributeError(f"module 'flypend' has no attribute {name!r}")
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted(__all__)
