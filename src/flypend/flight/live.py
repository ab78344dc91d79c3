"""What a page needs to fly by itself: machine code for it, sliders, starts, and words for how a flight ends."""

from __future__ import annotations

import base64
from dataclasses import fields, replace
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.llvm.sampled import ARGUMENTS, RESUMED_ARGUMENTS
from flypend.errors import InputError
from flypend.flight.criterion import PARTS, REDUCTIONS
from flypend.flight.kernels.flown import STATUS
from flypend.flight.kernels.pieces import pieces_problem
from flypend.flight.kernels.web import web_kernel
from flypend.flight.request import SAMPLE_PERIOD, Flight
from flypend.flight.touch import touched
from flypend.flight.verdict import MISSED, POSES, goal
from flypend.laws import BoundLaw
from flypend.laws.closed_loop import lyapunov_function
from flypend.model import State
from flypend.model.mount import part_names
from flypend.model.state import SIZE
from flypend.pages.sliders import gain_sliders, plant_sliders, slider, sliders_of
from flypend.pages.starts import plain, starts
from flypend.plants import Noise, Sampled
from flypend.plants.knobs import LONGEST_DELAY, knob_values
from flypend.plants.loop import Loop

DURATIONS = (2.0, 30.0)  # s
FURTHEST = 2.0  # m, that the reference moves
RANDOM = 40  # starts that a page holds, each drawn from `State.random`


def live_data(flight: Flight | None) -> dict[str, Any]:
    """Return what the page of a live `flight` holds beside its replay: `offer` and `engine`.

    Raises InputError if a page cannot fly it.
    """
    loop = live_loop(flight)
    assert flight is not None
    return {"offer": offered(flight), "engine": engine_facts(loop)}


def live_loop(flight: Flight | None) -> Loop:
    """Return the loop of `flight` whose gains with sliders are inputs. Raises InputError if a page cannot fly it."""
    if flight is None:
        raise InputError("live", "a run flown in this session", "one from a file, a plan or a change of frame")
    if not isinstance(flight.plant, Sampled) or flight.plant.engine != "equations":
        told = flight.plant.engine if isinstance(flight.plant, Sampled) else "ideal"
        raise InputError("live", "a sampled plant of the built-in equations, such as rotors", f"the plant {told}")
    if not isinstance(flight.law, BoundLaw):
        raise InputError("live", "a law in symbols, which can be compiled", f"the callable {flight.law.name}")
    return replace(flight.loop, parameters=tunable(flight.law))


def tunable(law: BoundLaw) -> tuple[str, ...]:
    """Return the gains of `law` that a page may change: those that its equations read as they are."""
    t, packed, forces = ca.SX.sym("t"), ca.SX.sym("s", SIZE), ca.SX.sym("F", 6)
    gains = {name: ca.SX.sym(name) for name in sliders_of(law)}
    wrench = law.upright(t, packed, forces, gains)
    return tuple(name for name, symbol in gains.items() if ca.depends_on(wrench, symbol))


def offered(flight: Flight) -> dict[str, Any]:
    """Return the choices of the page: sliders, starts, and the setting to begin with."""
    law, vehicle, plant = flight.law, flight.vehicle, flight.plant
    assert isinstance(law, BoundLaw)
    assert isinstance(plant, Sampled)
    paths = [f"law.gains.{name}" for name in tunable(law)]
    gains = [entry for entry in gain_sliders(law, vehicle, law.gains) if entry["path"] in paths]
    first = {
        "law": {"name": law.name, "gains": {}}, "plant": {}, "vehicle": {}, "start": plain(flight.starts.seen(law.e3)),
        "duration": flight.duration, "pokes": [],
    }  # fmt: skip
    low, high = min(DURATIONS[0], flight.duration), max(DURATIONS[1], flight.duration)
    lasting = slider("duration", "flight", "duration", "s", flight.duration, low, high)
    drawn = [State.random(np.random.default_rng(seed)) for seed in range(RANDOM)]
    return {
        "first": first, "sliders": [*gains, *plant_sliders(plant, vehicle), *_places(law, plant), lasting],
        "starts": {"as flown": first["start"], **starts()},
        "randoms": [plain(state) for state in drawn],
        "seed": flight.seed or 0,
    }  # fmt: skip


def _places(law: BoundLaw, plant: Sampled) -> list[dict[str, Any]]:
    """Return the sliders that move the reference of a live flight, m: none without one, or with estimated places."""
    if law.reference is None or plant.sensors is not None:
        return []
    words = {"x": "along e₁", "y": "along e₂", "z": "up"}
    return [slider(f"origin.{k}", "place", said, "m", 0.0, -FURTHEST, FURTHEST) for k, said in words.items()]


def engine_facts(loop: Loop) -> dict[str, Any]:
    """Return the machine code of `loop` for pages, and what it takes and gives, for web/src/live/simulation.js."""
    law, vehicle, plant = loop.symbolic, loop.vehicle, loop.sampled
    criterion, true = goal(law.e3), plant.true_vehicle(vehicle)
    problem = pieces_problem(loop, criterion)
    return {
        "code": base64.b64encode(web_kernel(loop, criterion)).decode("ascii"),
        "arguments": [*ARGUMENTS, *RESUMED_ARGUMENTS],
        "state": SIZE, "rotors": len(vehicle.rotor_spins), "plant": sum(problem.inputs), "reductions": len(REDUCTIONS),
        "gains": list(loop.parameters), "parameters": [float(law.gains[name]) for name in loop.parameters],
        "knobs": knob_values(vehicle, plant), "noise": [entry.name for entry in fields(Noise)],
        "delay": max(LONGEST_DELAY, plant.delay), "period": 1 / plant.rate,
        "judge": max(1, round(SAMPLE_PERIOD * plant.rate)), "e3": law.e3, "rod": true.rod_length,
        "masses": {"bob": true.bob_mass, "vehicle": true.mass},
        "clear": true.mount != "gimbal",
        "lyapunov": lyapunov_function(vehicle, law, loop.parameters) is not None,
        "words": {
            "hold": criterion.hold, "parts": list(PARTS), "missed": MISSED, "pose": POSES[law.e3],
            "status": np.asarray(STATUS).tolist(),
            "touched": [[name, touched(vehicle, i)] for i, name in enumerate(part_names(vehicle))],
        },
    }  # fmt: skip
