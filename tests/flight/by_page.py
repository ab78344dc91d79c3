"""Flights of a page's machine code, by Node.js through the simulation of the pages."""

import base64
import json
import subprocess
from pathlib import Path

import numpy as np

from flypend.flight.live import engine_facts, inflate
from flypend.flight.request import Tolerances
from flypend.laws import law_names
from flypend.model.by_name import vehicle_names
from flypend.model.state import convert_packed

# A law and a vehicle at a time, each law once; the slow tests fly all others.
PAIRS = (
    ("inverted", "crazyflie"), ("corrected", "nayak2018"), ("printed", "hehn2011"), ("repaired", "crazyflie"),
    ("almost_global", "hehn2011"), ("lqr", "nayak2018"),
)  # fmt: skip
OTHERS = [(law, vehicle) for law in law_names() for vehicle in vehicle_names() if (law, vehicle) not in PAIRS]
DURATION, SEED = 6.0, 7
EXACT = Tolerances()


def flown_by_page(loop, starts, tmp_path, pieces=None, shown=None, exact=EXACT):
    """States and rotor forces at every tick of the module's flights, (runs, ticks, 24 + n), and how they ended.

    The list `shown` takes what the page shows beside the last state of each piece.
    """
    facts, code = machine(loop, exact, tmp_path)
    pieces = pieces or [{"ticks": round(DURATION / facts["period"])}]
    flown, ends = [], []
    for i, start in enumerate(np.atleast_2d(convert_packed(starts.packed(), loop.law.e3))):
        told = by_node({"facts": facts, "start": start.tolist(), "seed": SEED + i, "pieces": pieces}, code)
        rows = np.frombuffer(base64.b64decode(told["rows"])).reshape(-1, 24 + len(loop.vehicle.rotor_spins))
        count = 1 + sum(piece["ticks"] for piece in pieces)
        flown.append(np.pad(rows, ((0, count - len(rows)), (0, 0)), constant_values=np.nan))
        ends.append(told["outcome"])
        if shown is not None:
            shown += told["shown"]
    return np.array(flown), ends


def ended_by_page(loop, starts, tmp_path, exact=EXACT, **given):
    """Status codes, end times (s) and reductions of flights that share the lanes of the module."""
    facts, code = machine(loop, exact, tmp_path, **given)
    own, ticks = convert_packed(starts.packed(), loop.law.e3).tolist(), round(DURATION / facts["period"])
    told = by_node({"facts": facts, "starts": own, "seed": SEED, "ticks": ticks}, code)
    reductions = [[np.inf if value is None else value for value in end["reductions"]] for end in told]  # as JSON has it
    return [end["status"] for end in told], [end["end"] for end in told], np.array(reductions)


def machine(loop, exact, tmp_path, **given):
    """What a page knows of its machine code, which is written to the path that is returned with it."""
    facts, code = engine_facts(loop, exact, **given), tmp_path / "kernel.wasm"
    code.write_bytes(inflate(facts.pop("code")))
    return facts, code


def by_node(asked, code):
    into, out = code.with_name("in.json"), code.with_name("out.json")
    into.write_text(json.dumps(asked))
    subprocess.run(["node", Path(__file__).with_name("fly.mjs"), code, into, out], check=True)
    return json.loads(out.read_text())
