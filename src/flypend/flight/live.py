"""What a page needs to fly by itself: what it offers (sliders, starts, the first setting), and its machine code.

What the code takes and gives is for web/src/live/simulation.js and its kinds.
"""

from __future__ import annotations

import base64
import zlib
from dataclasses import fields, replace
from typing import Any

import casadi as ca
import numpy as np

from flypend.building import builds
from flypend.compile.llvm import runge_kutta, sampled
from flypend.errors import InputError
from flypend.flight.criterion import PARTS, REDUCTIONS
from flypend.flight.kernels.launch import reasons
from flypend.flight.kernels.pieces import pieces_problem
from flypend.flight.kernels.results import STATUS
from flypend.flight.kernels.sampled import JUDGED
from flypend.flight.kernels.web import LANES, true_vehicle, web_module
from flypend.flight.request import SAMPLE_PERIOD, Flight, Tolerances
from flypend.flight.touch import reason_of, touchable
from flypend.flight.verdict import HANGS, MISSED, POSE, goal
from flypend.laws import BoundLaw
from flypend.laws.closed_loop import lyapunov_function
from flypend.model import State
from flypend.model.state import SIZE
from flypend.pages.offers import (
    Reach,
    defect_sliders,
    directions,
    gain_sliders,
    plain,
    plant_sliders,
    slider,
    sliders_of,
    starts,
)
from flypend.pages.replay import in_base64
from flypend.plants import AnyPlant, Ideal, Noise, Sampled
from flypend.plants.defects import NAMES
from flypend.plants.knobs import LONGEST_DELAY, knob_values
from flypend.plants.loop import Loop

DURATIONS = (2.0, 30.0)  # s
FURTHEST = 2.0  # m, that the reference moves
RANDOM = 40  # starts that a page holds, each drawn from `State.random`
MAPPED = 1200  # directions of the rod that a map has
RAW = -15  # deflate without a header, which browsers call "deflate-raw"
PERIOD = 0.002  # s between two rows of a flight through the ideal plant


@builds
def live_data(flight: Flight | None) -> dict[str, Any]:
    """Return what the page of a live `flight` holds beside its replay: `offer` and `engine`.

    Raises InputError if a page cannot fly it.
    """
    loop = live_loop(flight)
    assert flight is not None
    return {"offer": choices(flight), "engine": engine_facts(loop, flight.tolerances)}


def live_loop(flight: Flight | None) -> Loop:
    """Return the loop of `flight` whose gains with sliders are inputs. Raises InputError if a page cannot fly it."""
    if flight is None:
        raise InputError(
            "live", "a run flown in this session", "one from a file, a plan, an environment or a change of frame"
        )
    if isinstance(flight.plant, Sampled) and flight.plant.engine != "equations":
        raise InputError(
            "live", "a plant of the built-in equations, such as rotors", f"the plant {flight.plant.engine}"
        )
    if flight.loop.lag:
        raise InputError("live", "an ideal plant without lag, or a sampled one, such as rotors", "Ideal(lag=True)")
    if not isinstance(flight.law, BoundLaw):
        raise InputError("live", "a law in symbols, which can be compiled", f"the callable {flight.law.name}")
    return replace(flight.loop, parameters=tunable(flight.law))


def tunable(law: BoundLaw) -> tuple[str, ...]:
    """Return the gains of `law` that a page may change: those that its equations read as they are."""
    t, packed, forces = ca.SX.sym("t"), ca.SX.sym("s", SIZE), ca.SX.sym("F", 6)
    gains = {name: ca.SX.sym(name) for name in sliders_of(law)}
    wrench = law.upright(t, packed, forces, gains)
    return tuple(name for name, symbol in gains.items() if ca.depends_on(wrench, symbol))


def choices(flight: Flight) -> dict[str, Any]:
    """Return the choices of the page: sliders, starts, and the setting to begin with."""
    law, vehicle, plant = flight.law, flight.vehicle, flight.plant
    assert isinstance(law, BoundLaw)
    turned = [*plant_sliders(plant, vehicle), *defect_sliders(plant)] if isinstance(plant, Sampled) else []
    paths = [f"law.gains.{name}" for name in tunable(law)]
    gains = [entry for entry in gain_sliders(law, vehicle, law.gains) if entry["path"] in paths]
    first = {
        "law": {"name": law.name, "gains": {}}, "plant": {}, "vehicle": {},
        "start": plain(flight.starts.in_frame(law.e3)), "duration": flight.duration, "pokes": [],
    }  # fmt: skip
    lasting = slider("duration", "flight", "duration", "s", flight.duration, Reach(*DURATIONS))
    return {
        "first": first, "sliders": [*gains, *turned, *_places(law, plant), lasting],
        "starts": {"as flown": first["start"], **starts()},
        **draw_starts(),
        "seed": flight.seed or 0,
    }  # fmt: skip


def draw_starts() -> dict[str, Any]:
    """Return the starts that a page draws from: `randoms`, and the `directions` of a map, in base64."""
    drawn = [State.random(np.random.default_rng(seed)) for seed in range(RANDOM)]
    return {"randoms": [plain(state) for state in drawn], "directions": in_base64(directions(MAPPED))}


def _places(law: BoundLaw, plant: AnyPlant) -> list[dict[str, Any]]:
    """Return the sliders that move the reference of a live flight, m: none without one, or with estimated places."""
    if law.reference is None or (isinstance(plant, Sampled) and plant.sensors is not None):
        return []
    words = {"x": "along e₁", "y": "along e₂", "z": "up"}
    reach = Reach(-FURTHEST, FURTHEST)
    return [slider(f"origin.{k}", "place", said, "m", 0.0, reach) for k, said in words.items()]


# The machine code -----------------------------------------------------------------------------------------------------


def engine_facts(loop: Loop, exact: Tolerances, lanes: int = LANES) -> dict[str, Any]:
    """Return machine code that flies `loop` in pages, `lanes` flights at a time, and what it takes and gives.

    The ideal plant is flown with the tolerances `exact`.
    """
    law, true = loop.symbolic, true_vehicle(loop)
    criterion = goal(law.e3)
    facts = _ideal(loop, exact) if isinstance(loop.plant, Ideal) else _sampled_facts(loop)
    texts = reasons(loop)
    if runge_kutta.TOO_MANY in texts:
        texts[runge_kutta.TOO_MANY] = "more integration steps than a page takes"
    deflated = zlib.compress(web_module(loop, criterion, exact, lanes), 9, wbits=RAW)
    return {
        "code": base64.b64encode(deflated).decode("ascii"),
        **facts,
        "lanes": lanes, "state": SIZE, "rotors": len(true.rotor_spins),
        "gains": list(loop.parameters), "parameters": [float(law.gains[name]) for name in loop.parameters],
        "bounds": [law.table[name].bounds.limits() for name in loop.parameters],
        "judge": max(1, round(SAMPLE_PERIOD / facts["period"])), "e3": law.e3, "rod": true.rod_length,
        "masses": {"bob": true.bob_mass, "vehicle": true.mass},
        "clear": true.mount != "gimbal",
        "lyapunov": lyapunov_function(loop.vehicle, law, loop.parameters) is not None,
        "words": {
            "hold": criterion.hold, "parts": list(PARTS), "missed": MISSED, "pose": POSE, "hangs": HANGS,
            "status": np.asarray(STATUS).tolist(), "reasons": [texts.get(code, "") for code in range(len(STATUS))],
            "touched": [[name, reason_of(loop.vehicle, i)] for i, name in enumerate(touchable(loop.vehicle))],
        },
    }  # fmt: skip


def inflate(code: str) -> bytes:
    """Return the module of WebAssembly that `engine_facts` has put into `code`."""
    return zlib.decompress(base64.b64decode(code), wbits=RAW)


def _sampled_facts(loop: Loop) -> dict[str, Any]:
    vehicle, plant = loop.vehicle, loop.sampled
    return {
        "kind": "sampled", "arguments": list(sampled.ARGUMENTS),
        "plant": sum(pieces_problem(loop, goal(loop.law.e3)).inputs),
        "knobs": knob_values(vehicle, plant), "noise": [entry.name for entry in fields(Noise)], "defects": list(NAMES),
        "delay": max(LONGEST_DELAY, plant.delay), "period": 1 / plant.rate, "reductions": len(JUDGED),
    }  # fmt: skip


def _ideal(loop: Loop, exact: Tolerances) -> dict[str, Any]:
    return {
        "kind": "ideal", "arguments": list(runge_kutta.ARGUMENTS), "knobs": {"origin": [0.0, 0.0, 0.0]}, "noise": [],
        "defects": [], "delay": 0.0, "period": PERIOD, "reductions": len(REDUCTIONS),
        "exact": {"rtol": exact.rtol, "atol": exact.absolute, "max_steps": exact.max_steps},
    }  # fmt: skip
