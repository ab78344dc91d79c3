"""Machine code with which a page flies, and what it takes and gives: for web/src/live/simulation.js and its kinds."""

from __future__ import annotations

import base64
import zlib
from dataclasses import fields
from typing import Any

import numpy as np

from flypend.compile.llvm import runge_kutta, sampled
from flypend.flight.criterion import PARTS, REDUCTIONS
from flypend.flight.kernels.flown import STATUS
from flypend.flight.kernels.pieces import pieces_problem
from flypend.flight.kernels.sampled import JUDGED
from flypend.flight.kernels.single import REASONS
from flypend.flight.kernels.web import LANES, WebModule, true_vehicle, web_module
from flypend.flight.request import SAMPLE_PERIOD, Tolerances
from flypend.flight.sampled import LEFT, NOT_FINITE
from flypend.flight.touch import reason_of, touchable
from flypend.flight.verdict import HANGS, MISSED, POSE, goal
from flypend.laws.closed_loop import lyapunov_function
from flypend.model.state import SIZE
from flypend.plants import Ideal, Noise
from flypend.plants.defects import NAMES
from flypend.plants.knobs import LONGEST_DELAY, knob_values
from flypend.plants.loop import Loop

RAW = -15  # deflate without a header, which browsers call "deflate-raw"
PERIOD = 0.002  # s between two rows of a flight through the ideal plant


def engine_facts(loop: Loop, exact: Tolerances, lanes: int = LANES) -> dict[str, Any]:
    """Return machine code that flies `loop` in pages, `lanes` flights at a time, and what it takes and gives.

    The ideal plant is flown with the tolerances `exact`.
    """
    return with_machine_code(*engine(loop, exact, lanes))


def with_machine_code(module: WebModule, facts: dict[str, Any]) -> dict[str, Any]:
    """Return the `facts` of an `engine` with the machine code of its `module`: deflated, in base64."""
    deflated = zlib.compress(module.code(), 9, wbits=RAW)
    return {"code": base64.b64encode(deflated).decode("ascii"), **facts}


def inflate(code: str) -> bytes:
    """Return the module of WebAssembly that `with_machine_code` has put into `code`."""
    return zlib.decompress(base64.b64decode(code), wbits=RAW)


def engine(loop: Loop, exact: Tolerances, lanes: int = LANES) -> tuple[WebModule, dict[str, Any]]:
    """Return what `engine_facts` compiles, and the rest of what it returns."""
    law, true = loop.symbolic, true_vehicle(loop)
    criterion = goal(law.e3)
    facts = _ideal(loop, exact) if isinstance(loop.plant, Ideal) else _sampled_engine(loop)
    return web_module(loop, criterion, exact, lanes), {
        **facts,
        "lanes": lanes, "state": SIZE, "rotors": len(true.rotor_spins),
        "gains": list(loop.parameters), "parameters": [float(law.gains[name]) for name in loop.parameters],
        "judge": max(1, round(SAMPLE_PERIOD / facts["period"])), "e3": law.e3, "rod": true.rod_length,
        "masses": {"bob": true.bob_mass, "vehicle": true.mass},
        "clear": true.mount != "gimbal",
        "lyapunov": lyapunov_function(loop.vehicle, law, loop.parameters) is not None,
        "words": {
            "hold": criterion.hold, "parts": list(PARTS), "missed": MISSED, "pose": POSE, "hangs": HANGS,
            "status": np.asarray(STATUS).tolist(), "reasons": _reasons(loop),
            "touched": [[name, reason_of(loop.vehicle, i)] for i, name in enumerate(touchable(loop.vehicle))],
        },
    }  # fmt: skip


def _sampled_engine(loop: Loop) -> dict[str, Any]:
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


def _reasons(loop: Loop) -> list[str]:
    """Why flights end early, by their status; what the rod touches is told elsewhere."""
    if isinstance(loop.plant, Ideal):
        guard = loop.symbolic.guard
        told = {**REASONS, runge_kutta.SINGULAR: "" if guard is None else guard.reason}
        told[runge_kutta.TOO_MANY] = "more integration steps than a page takes"
    else:
        told = {runge_kutta.UNDEFINED: NOT_FINITE, runge_kutta.DIVERGED: LEFT}
    return [told.get(code, "") for code in range(len(STATUS))]
