"""Flights of a page's machine code, by Node.js through the simulation of the pages."""

import base64
import json
import subprocess
from pathlib import Path

import numpy as np

from flypend.flight.live_engine import engine_facts
from flypend.flight.request import Tolerances
from flypend.model.state import seen_packed

DURATION, SEED = 6.0, 7
EXACT = Tolerances()


def flown_by_page(loop, starts, tmp_path, pieces=None, shown=None, exact=EXACT):
    """States and rotor forces at every tick of the module's flights, (runs, ticks, 24 + n), and how they ended.

    The list `shown` takes what the page shows beside the last state of each piece.
    """
    facts = engine_facts(loop, exact)
    code, into, out = (tmp_path / name for name in ("kernel.wasm", "in.json", "out.json"))
    code.write_bytes(base64.b64decode(facts.pop("code")))
    pieces = pieces or [{"ticks": round(DURATION / facts["period"])}]
    flown, ends = [], []
    for i, start in enumerate(np.atleast_2d(seen_packed(starts.packed(), loop.law.e3))):
        into.write_text(json.dumps({"facts": facts, "start": start.tolist(), "seed": SEED + i, "pieces": pieces}))
        subprocess.run(["node", Path(__file__).with_name("fly.mjs"), code, into, out], check=True)
        told = json.loads(out.read_text())
        rows = np.frombuffer(base64.b64decode(told["rows"])).reshape(-1, 24 + len(loop.vehicle.rotor_spins))
        count = 1 + sum(piece["ticks"] for piece in pieces)
        flown.append(np.pad(rows, ((0, count - len(rows)), (0, 0)), constant_values=np.nan))
        ends.append(told["outcome"])
        if shown is not None:
            shown += told["shown"]
    return np.array(flown), ends
