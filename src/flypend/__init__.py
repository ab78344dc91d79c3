"""flypend models, controls and simulates a spherical pendulum on a quadrotor, on R³ × SO(3) × S².

Names are imported when they are first used.
"""

from __future__ import annotations

from functools import partial
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from flypend.registry import LAWS

if TYPE_CHECKING:
    from flypend import laws as laws
    from flypend.errors import InputError as InputError
    from flypend.export import export_app as export_app
    from flypend.export import export_c as export_c
    from flypend.export import export_plan as export_plan
    from flypend.flight.criterion import Criterion as Criterion
    from flypend.flight.ensemble import Ensemble as Ensemble
    from flypend.flight.ensemble import simulate_ensemble as simulate_ensemble
    from flypend.flight.metrics import Metrics as Metrics
    from flypend.flight.metrics import metrics as metrics
    from flypend.flight.outcome import Outcome as Outcome
    from flypend.flight.recoveries import Recovery as Recovery
    from flypend.flight.recoveries import recoveries as recoveries
    from flypend.flight.request import Flight as Flight
    from flypend.flight.request import Tolerances as Tolerances
    from flypend.flight.sensitivity import Sensitivity as Sensitivity
    from flypend.flight.sensitivity import sensitivity as sensitivity
    from flypend.flight.simulate import simulate as simulate
    from flypend.flight.trajectory import Trajectory as Trajectory
    from flypend.flight.trajectory import load as load
    from flypend.identification import Identified as Identified
    from flypend.identification import identify as identify
    from flypend.laws import BoundLaw as BoundLaw
    from flypend.laws import Controller as Controller
    from flypend.laws import Gain as Gain
    from flypend.laws import Law as Law
    from flypend.laws.linearise import linearise as linearise
    from flypend.model.air import Air as Air
    from flypend.model.body import Body as Body
    from flypend.model.rod import rod_with_bob as rod_with_bob
    from flypend.model.rod import uniform_rod as uniform_rod
    from flypend.model.shipped import vehicle as vehicle
    from flypend.model.state import State as State
    from flypend.model.state import Wrench as Wrench
    from flypend.model.vehicle import Vehicle as Vehicle
    from flypend.planning.constraints import Constraints as Constraints
    from flypend.planning.planner import plan as plan
    from flypend.planning.planner import plan_ensemble as plan_ensemble
    from flypend.planning.receding_horizon import nmpc as nmpc
    from flypend.planning.result import Plan as Plan
    from flypend.planning.result import PlanEnsemble as PlanEnsemble
    from flypend.planning.result import load_plan as load_plan
    from flypend.planning.tracking import plan_and_track as plan_and_track
    from flypend.planning.tracking import track as track
    from flypend.planning.window import Window as Window
    from flypend.plants import Ideal as Ideal
    from flypend.plants import Noise as Noise
    from flypend.plants import Plant as Plant
    from flypend.plants import Sensor as Sensor
    from flypend.plants import Sensors as Sensors
    from flypend.plants import Wind as Wind
    from flypend.studies.check import Check as Check
    from flypend.studies.check import check as check
    from flypend.studies.compare import Comparison as Comparison
    from flypend.studies.compare import compare as compare
    from flypend.studies.starts import random_starts as random_starts
    from flypend.studies.sweep.run import sweep as sweep
    from flypend.studies.sweep.study import Study as Study
    from flypend.studies.sweep.study import study as study
    from flypend.studies.trial import Trial as Trial
    from flypend.studies.trial import trial as trial
    from flypend.studies.tune import Objective as Objective
    from flypend.studies.tune import Tuned as Tuned
    from flypend.studies.tune import tune as tune

__version__ = "0.3.0.dev0"

# Where each name is defined.
_WHERE = {
    "errors": ("InputError",),
    "export": ("export_app", "export_c", "export_plan"),
    "flight.criterion": ("Criterion",),
    "flight.ensemble": ("Ensemble", "simulate_ensemble"),
    "flight.metrics": ("Metrics", "metrics"),
    "flight.outcome": ("Outcome",),
    "flight.recoveries": ("Recovery", "recoveries"),
    "flight.request": ("Flight", "Tolerances"),
    "flight.sensitivity": ("Sensitivity", "sensitivity"),
    "flight.simulate": ("simulate",),
    "flight.trajectory": ("Trajectory", "load"),
    "identification": ("Identified", "identify"),
    "laws": ("BoundLaw", "Controller", "Gain", "Law"),
    "laws.linearise": ("linearise",),
    "model": ("State", "Vehicle", "Wrench", "vehicle"),
    "model.air": ("Air",),
    "model.body": ("Body",),
    "model.rod": ("rod_with_bob", "uniform_rod"),
    "planning.constraints": ("Constraints",),
    "planning.planner": ("plan", "plan_ensemble"),
    "planning.receding_horizon": ("nmpc",),
    "planning.result": ("Plan", "PlanEnsemble", "load_plan"),
    "planning.tracking": ("plan_and_track", "track"),
    "planning.window": ("Window",),
    "plants": ("Ideal", "Noise", "Plant", "Sensor", "Sensors", "Wind"),
    "studies.check": ("Check", "check"),
    "studies.compare": ("Comparison", "compare"),
    "studies.starts": ("random_starts",),
    "studies.sweep": ("Study", "study", "sweep"),
    "studies.trial": ("Trial", "trial"),
    "studies.tune": ("Objective", "Tuned", "tune"),
}
_MODULES = {name: f"flypend.{module}" for module, names in _WHERE.items() for name in names}

__all__ = sorted(["laws", *_MODULES])


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


LAWS |= {name: partial(__getattr__, name) for name in ("nmpc", "plan_and_track", "track")}
