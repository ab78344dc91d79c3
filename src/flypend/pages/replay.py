"""Replay of runs in a browser: one self-contained page with flights, scene, plots and player.

`make web` bundles the script of this page and of the laboratory from the folder web/ into flypend/pages/web/page.js.
This module packs runs into the format that the script reads: columns of 32-bit floats in base64, sampled at display
rate; the page interpolates.
"""

from __future__ import annotations

import base64
import html
import json
from collections.abc import Sequence
from functools import cache
from importlib import resources
from typing import Any

import numpy as np

from flypend import errors, palette
from flypend.geometry import norm, quat_xyzw_from_rotation
from flypend.model import State, Vehicle
from flypend.pages import sketch

RATE = 100.0  # samples per second of flight
FINEST = 0.15  # maximum rotation of rod or vehicle between samples, rad, within the limit MOST
MOST = 12_000  # maximum number of samples in a page, which keeps it below 3 MB
MOST_RUNS = 4
LARGEST = float(np.finfo(np.float32).max)

Run = Any  # flypend.Trajectory, not imported: its module imports this one
Opening = Any  # planning.Window, of a room above

# The page may run inline scripts but fetch nothing.
POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:"
# A page that flies runs machine code, in a worker that is made of text of the page.
LIVE_POLICY = POLICY.replace("script-src 'unsafe-inline'", "script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:")

PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
{policy}<link rel="icon" href="data:,">
<title>{title}</title>
</head>
<body>
<noscript>This page needs JavaScript.</noscript>
<script id="flypend-data" type="application/json">{data}</script>
{script}
</body>
</html>
"""


def document(policy: str, data: dict[str, Any]) -> str:
    """Return the HTML of a page of `data`: a laboratory if they have an `offer`, else a replay.

    It holds its script and its `policy`; without a policy, a server sends both.
    """
    data = {"layout": "overlay", "speed": 1.0, "palette": palette.PAGE, "runs": [], **data}
    meta = f'<meta http-equiv="Content-Security-Policy" content="{html.escape(policy)}">\n' if policy else ""
    script = f"<script>{program()}</script>" if policy else '<script src="page.js"></script>'
    return PAGE.format(policy=meta, title=html.escape(str(data["title"])), data=embed(data), script=script)


def page(
    runs: Sequence[Run],
    verdicts: Sequence[dict[str, Any]],
    *,
    title: str | None = None,
    layout: str = "overlay",
    speed: float = 1.0,
    live: dict[str, Any] | None = None,
    windows: Sequence[Opening] = (),
) -> str:
    """Return the HTML of a page that replays `runs`, or with `live` flies on from the first.

    Parameters
    ----------
    runs : sequence of Trajectory
        One to four runs, in either frame; the camera follows the first. Gravity always points down the screen, and
        numbers are in the frame of the run.
    verdicts : sequence of dict
        How each run ended, as `flypend.flight.verdict.verdict` returns it.
    title : str, optional
        Page title; default: laws and vehicles.
    layout : "overlay" or "beside"
        Whether the other runs appear as ghosts in the scene of the first, or in scenes of their own; a button toggles.
    speed : float
        Initial playback speed, flight time over playback time, > 0.
    live : dict, optional
        What a page needs to compute flights itself: see `flypend.flight.live`.
    windows : sequence of planning.Window
        Openings in walls that are drawn.

    Raises
    ------
    InputError
        If there are no runs or more than four, the layout is unknown, the speed is not positive, or a window is none.
    """
    if not 1 <= len(runs) <= MOST_RUNS:
        raise errors.InputError("runs", f"1 to {MOST_RUNS} runs", f"{len(runs)}")
    data: dict[str, Any] = {
        "title": title or _title(runs),
        "layout": errors.one_of("layout", layout, ("overlay", "beside")),
        "speed": errors.number("speed", speed, above=0),
        "runs": [
            {**pack(run, verdict, MOST // len(runs)), **name}
            for run, verdict, name in zip(runs, verdicts, names(runs), strict=True)
        ],
    }
    if windows:
        several = windows if isinstance(windows, Sequence) else [windows]
        data["runs"][0]["windows"] = [_opening(window) for window in several]
    return document(POLICY, data) if live is None else document(LIVE_POLICY, data | live)


def _opening(window: Opening) -> dict[str, Any]:
    if not all(hasattr(window, name) for name in ("centre", "axes", "halves", "depth")):
        raise errors.InputError("windows", "a sequence of Window", repr(window)[:80])
    parts = {name: np.asarray(getattr(window, name)).tolist() for name in ("centre", "axes", "halves")}
    return {**parts, "depth": float(window.depth)}


def frame(text: str, height: int = 640) -> str:
    """Wrap the page `text` in a sandboxed iframe for notebooks, `height` CSS pixels high."""
    style = f"width:100%;height:{height}px;border:0"
    attributes = 'title="Replay of a flight" sandbox="allow-scripts"'
    return f'<iframe srcdoc="{html.escape(text)}" {attributes} style="{style}"></iframe>'


def pack(run: Run, verdict: dict[str, Any], most: int = MOST) -> dict[str, Any]:
    """Pack `run` for the page: metadata with its `verdict`, and base64 columns of at most `most` samples."""
    t, states = _sample(run, most)
    outcome = dict(verdict)
    excess, hold = outcome.pop("excess"), outcome.pop("hold")
    rotors = np.reshape(run.rotor_forces, (len(run.t), -1))
    columns = {
        "t": t,
        "x": states.x,
        "x_dot": states.x_dot,
        "quat_xyzw": quat_xyzw_from_rotation(states.R),
        "y": states.y,
        "y_dot": states.y_dot,
        "thrust": np.interp(t, run.t, run.thrust),
        "rotor_forces": np.stack([np.interp(t, run.t, force) for force in rotors.T], axis=-1),
        "x_ref": np.stack([np.interp(t, run.t, along) for along in np.asarray(run.x_ref).T], axis=-1),
        "excess": np.interp(t, run.t, excess),
    }
    vehicle = run.vehicle
    if vehicle.mount != "gimbal":
        columns["clearance"] = np.interp(t, run.t, run.clearance)
    if "V" in run.signals:
        columns["V"] = np.interp(t, run.t, run.signals["V"])
    return {
        **names([run])[0],
        "law": run.law,
        "e3": run.e3,
        "completed": run.outcome.status == "completed",
        "verdict": outcome,
        "hold": hold,
        "direction": sketch.main_direction(states.in_frame(run.e3)).tolist(),
        "vehicle": describe_machine(vehicle),
        "floor": run.flight.plant.floor if run.flight else None,
        "columns": {name: in_base64(values) for name, values in columns.items()},
    }


def describe_machine(vehicle: Vehicle) -> dict[str, Any]:
    """Return what a page draws of `vehicle`."""
    return {
        "name": vehicle.name,
        "rod_length": vehicle.rod_length,
        "rod_end": vehicle.reach,
        "weight": vehicle.weight,
        "gravity": vehicle.gravity,
        "rotor_limits": [float(limit) if np.isfinite(limit) else None for limit in vehicle.rotor_limits],
        "rotor_positions": np.asarray(vehicle.rotors_from_pivot).tolist(),
        "rotor_spins": np.asarray(vehicle.rotor_spins).tolist(),
        "rotor_radius": sketch.disc_radius(vehicle),
        "mount": vehicle.mount,
        "body": None if vehicle.body is None else vehicle.body.to_dict(),
        "reach": sketch.reach(vehicle),
    }


def names(runs: Sequence[Run]) -> list[dict[str, Any]]:
    """Name each of `runs` for a legend: `title`, and `gains`, pairs of name and value. Equal titles are told apart.

    What tells them apart is the vehicle, else the gains that differ, else the rod at the start, else a number.
    """
    titles = [f"{run.law} law" for run in runs]
    gains = [{name: value for name, value in run.gains.items() if name.startswith("k_")} for run in runs]
    for title in {title for title in titles if titles.count(title) > 1}:
        alike = [i for i, other in enumerate(titles) if other == title]
        given = [runs[i].gains for i in alike]
        every = dict.fromkeys(name for own in given for name in own)  # a law that was edited meanwhile has others
        differing = [name for name in every if len({repr(own.get(name)) for own in given}) > 1]
        machines = [runs[i].vehicle.name for i in alike]
        rods = [f"rod from {_tilt(runs[i]):.0f}°" for i in alike]
        choices = (machines, differing and [str([own.get(name) for name in differing]) for own in given], rods)
        found = next((choice for choice in choices if len(set(choice)) == len(alike)), None)
        for number, i in enumerate(alike):
            gains[i] |= {name: given[number][name] for name in differing if name in given[number]}
            if found is None or found is machines or found is rods:
                titles[i] = f"{title}, {found[number] if found else number + 1}"
    return [{"title": title, "gains": _pairs(own)} for title, own in zip(titles, gains, strict=True)]


def _pairs(gains: dict[str, Any]) -> list[list[str]]:
    return [[name, f"{value:g}" if isinstance(value, float | int) else str(value)] for name, value in gains.items()]


def _tilt(run: Run) -> float:
    """Angle of the rod from upright at the start of `run`, degrees."""
    up = 1.0 if run.e3 == "up" else -1.0
    return float(np.degrees(np.arccos(np.clip(up * run.y[0][2], -1.0, 1.0))))


def _title(runs: Sequence[Run]) -> str:
    laws = list(dict.fromkeys(run.law for run in runs))
    vehicles = list(dict.fromkeys(_machine(run.vehicle) for run in runs))
    return f"{' and '.join(laws)} law{'s' if len(laws) > 1 else ''} on {' and '.join(vehicles)}"


def _machine(vehicle: Vehicle) -> str:
    return vehicle.name if vehicle.mount == "gimbal" else f"{vehicle.name}, {vehicle.mount}"


def _sample(run: Run, most: int) -> tuple[Any, State]:
    """Times and states to show: from dense output if available, otherwise a subset of the samples."""
    times, states = np.asarray(run.t, dtype=float), run.states
    if len(times) < 2:
        return times, states
    turning = np.maximum(norm(states.y_dot), norm(states.omega))
    rate = np.maximum(RATE, np.minimum(turning, 1e6) / FINEST)
    passed = np.concatenate([[0.0], np.cumsum(np.diff(times) * (rate[1:] + rate[:-1]) / 2)])
    count = int(np.clip(np.ceil(passed[-1] - 1e-6), 1, most - 1)) + 1
    wanted = np.interp(np.linspace(0.0, passed[-1], count), passed, times)
    if run.interpolant is not None:
        wanted = wanted.astype(np.float32).astype(float)  # the times after rounding to 32 bits, as the page sees them
        return wanted, run.at(np.clip(wanted, times[0], times[-1]))
    keep = np.unique(np.clip(np.searchsorted(times, wanted - 1e-9), 0, len(times) - 1))
    return times[keep], states[keep]


def in_base64(values: Any) -> str:
    """Return `values` as 32-bit floats in base64, which floats() of web/src/flight.js reads."""
    finite = np.clip(np.nan_to_num(np.asarray(values, dtype=float)), -LARGEST, LARGEST)
    return base64.b64encode(finite.astype("<f4").tobytes()).decode("ascii")


def embed(data: Any) -> str:
    """JSON that is safe inside a script element, whatever strings it contains."""
    text = json.dumps(data, ensure_ascii=True, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


@cache
def program() -> str:
    """The bundled script of the page."""
    return (resources.files("flypend.pages") / "web" / "page.js").read_text(encoding="utf-8")
