"""Plans in files: the file of a run, which is the planned flight, with what makes it a plan."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, fields
from functools import partial
from pathlib import Path
from typing import Any, Literal, get_args

import casadi as ca
import numpy as np

from flypend import errors
from flypend.errors import InputError
from flypend.files.netcdf import Variable
from flypend.files.schema import Field, check_arrays, check_attributes, check_variables, digest
from flypend.flight import files
from flypend.model import Vehicle
from flypend.model.state import SHAPES, SIZE
from flypend.planning.window import Window

KIND = "a plan saved by flypend"
Status = Literal["converged", "feasible", "failed"]
STATUSES: tuple[Status, ...] = get_args(Status)
FIELDS: Mapping[str, Field] = {
    "commands": Field(("stage", "rotor"), unit="N"),
    "target": Field(("axis",), unit="m", low=-files.FAR, high=files.FAR),
}
# What the flight of a plan is made of.
FLIGHT: Mapping[str, Field] = {
    "t": Field(("t",)), "packed": Field(("t", SIZE)), "rotor_forces": Field(("t", "rotor"))
}  # fmt: skip
ATTRIBUTES: Mapping[str, type] = {
    "objective": str, "windows": str, "status": str, "reason": str, "stage": float, "solve_time": float,
    "iterations": float, "stationarity": float, "guess": float, "guesses": float, "agreeing": float,
}  # fmt: skip
SEAL = "plan_digest"
WINDOW = [field.name for field in fields(Window)]
MOST_COUNT = 10**9
# By how much times may miss the stages, and forces the limits, relative to the largest: rounding in other units.
SLACK = 1e-9


def content(plan: Any) -> tuple[dict[str, Variable], dict[str, Any]]:
    """Return what the file of a `plan` holds: variables, and attributes with a digest. Raises InputError.

    It does if `fields_of` would refuse them.
    """
    check_arrays({**FLIGHT, **FIELDS}, vars(plan), _lengths(plan.vehicle))
    run = plan.trajectory
    variables, attributes = files.content(run._variables(), run._attributes(), run.drift)
    for name, field in FIELDS.items():
        variables[name] = Variable(tuple(map(str, field.dims)), getattr(plan, name), {"units": field.unit})
    attributes |= {name: getattr(plan, name) for name in ATTRIBUTES if name not in ("objective", "windows")}
    attributes["objective"] = json.dumps(dict(plan.objective))
    attributes["windows"] = json.dumps([*map(asdict, plan.windows)], default=np.ndarray.tolist)
    return variables, attributes | {SEAL: check(vars(run), attributes["digest"], variables, attributes)[1]}


def _lengths(vehicle: Vehicle) -> dict[str, int]:
    return files.LENGTHS | {"rotor": len(vehicle.rotor_spins)}


def fields_of(path: str | Path) -> dict[str, Any]:
    """Return the fields of the `Plan` in the file `path`. Raises InputError if there is none."""
    variables, attributes = files.read(path, KIND)
    run, seal = files.run_from(variables, attributes, str(path))
    if missing := [name for name in ATTRIBUTES if name not in attributes]:
        raise InputError(str(path), KIND, f"a run: no {', '.join(missing)}")
    try:
        plan, found = check(run, seal, variables, attributes)
    except InputError as error:
        raise InputError(str(path), KIND, f"a damaged one ({error})") from None
    files.check_digest(str(path), KIND, attributes, SEAL, found)
    return plan


def check(
    run: Mapping[str, Any], seal: str, variables: Mapping[str, Variable], attributes: Mapping[str, Any]
) -> tuple[dict[str, Any], str]:
    """Return the fields of the plan of the flight `run`, which has the digest `seal`, and the digest of both.

    Raises InputError.
    """
    about = check_attributes(ATTRIBUTES, attributes)
    arrays = check_variables(FIELDS, variables, _lengths(run["vehicle"]))
    plan = {
        "vehicle": run["vehicle"],
        "objective": _weights(about),
        "target": arrays["target"],
        "path": None if np.all(run["x_ref"] == arrays["target"]) else partial(_interpolate, run["t"], run["x_ref"]),
        "windows": tuple(map(_window, files.json_of("windows", about, list))),
        "t": run["t"],
        "packed": np.concatenate([run[name].reshape(len(run["t"]), -1) for name in SHAPES], axis=1),
        "rotor_forces": run["rotor_forces"],
        "commands": arrays["commands"],
        "stage": errors.number("stage", about["stage"], above=0, unit="s"),
        "status": errors.one_of("status", about["status"], STATUSES),
        "reason": about["reason"],
        "solve_time": errors.number("solve_time", about["solve_time"], at_least=0, unit="s"),
        "stationarity": errors.number("stationarity", about["stationarity"], at_least=0),
        **{name: _count(name, about) for name in ("iterations", "guess", "guesses", "agreeing")},
    }
    _check(plan, run)
    return plan, digest(arrays, about | {"digest": seal})


def _check(plan: Mapping[str, Any], run: Mapping[str, Any]) -> None:
    """Raise InputError unless times are those of the stages, and a `plan` that flies keeps its rotors' limits."""
    if (run["law"], run["e3"]) != ("plan", "up"):
        raise InputError("law, e3", "plan, up", f"{run['law']}, {run['e3']}")
    t, stages = plan["t"], len(plan["commands"])
    steps = len(t) - 1
    if not stages or not steps or steps % stages:
        raise InputError("commands", "as many samples in each stage", f"{stages} stages, {len(t)} samples")
    off = float(np.max(np.abs(t - np.arange(steps + 1) * (plan["stage"] * stages / steps))))
    if off > SLACK * t[-1]:
        raise InputError("t", "equal times in each stage", f"{off:.3g} s off")
    low, high = plan["vehicle"].rotor_limits
    forces = np.concatenate([plan["rotor_forces"], plan["commands"]])
    within = np.all((forces >= low - SLACK * high) & (forces <= high * (1 + SLACK)))
    if not np.all(np.isfinite(forces)) or (plan["status"] != "failed" and not within):
        raise InputError("rotor_forces", f"forces from {low:g} to {high:g} N", f"{forces.min():g} to {forces.max():g}")


def _weights(about: Mapping[str, Any]) -> dict[str, float]:
    given = files.json_of("objective", about, dict)
    return {name: errors.number(f"objective.{name}", value, at_least=0) for name, value in given.items()}


def _window(given: Any) -> Window:
    if not isinstance(given, dict) or given.keys() != set(WINDOW):
        raise InputError("windows", f"windows with {', '.join(WINDOW)}", repr(given)[:80])
    return Window(**given)


def _count(name: str, about: Mapping[str, Any]) -> int:
    value = about[name]
    return errors.integer(name, int(value) if value == int(value) else value, 0, MOST_COUNT)


def _interpolate(times: Any, places: Any, t: Any) -> Any:
    """Return the place (3, 1), m, at `t` (s) on straight lines between `places` (n, 3) at `times` (n,), exact there."""
    begun = ca.SX(ca.DM(times)) <= t
    now = begun * (1 - ca.vertcat(begun[1:], 0))
    now[0] += 1 - begun[0]
    slopes = np.append(np.diff(places, axis=0) / np.diff(times)[:, None], np.zeros((1, 3)), axis=0)
    return ca.mtimes(ca.DM(places).T, now) + ca.mtimes(ca.DM(slopes).T, now * (ca.fmax(t, times[0]) - ca.DM(times)))
