"""How long a light page of the laboratory waits beside six heavy ones: `python -m benchmarks.shares [KIND] [--burn N]`.

The light page asks for a flight, and rests for six times as long as such a flight takes it alone. Blocks in which it is
alone and blocks beside six heavy pages of a kind alternate, so that what else the machine does slows both alike; with
`--burn`, N processes that only compute run throughout. Prints for each kind the median and the longest wait of both,
the ratios of medians and of longest waits, and how many replies the least served heavy page had. Ten minutes for all
kinds on two cores.
"""

import argparse
import asyncio
import json
import multiprocessing
import re
import subprocess
import sys
import tempfile
import time
from itertools import count
from pathlib import Path

import numpy as np
from tornado.websocket import websocket_connect

from benchmarks.results import machine
from flypend.lab.controls import offer

FIRST = offer()["first"]
HEAVY, BLOCKS, WAITS = 6, 4, 8  # heavy pages; blocks of each sort; waits in a block
REST = 6.0  # times as long as a flight alone: a page that uses a seventh of a core
LAW = """
import numpy as np
import flypend as fp

def slow(t, state, vehicle, *, brake=0.02):
    total = sum(range(20_000))
    if state.x[2] > 1e9 or total < 0:
        return fp.Wrench(0.0, np.zeros(3))
    return fp.Wrench(vehicle.weight, -brake * np.asarray(state.omega))

def endless(t, state, vehicle, *, brake=0.02):
    while brake > 0.03 and state.x[2] < 1e9:
        pass
    return fp.Wrench(vehicle.weight, -brake * np.asarray(state.omega))
"""


def asked(law="inverted", plant="rotors", gains=None, **more):
    """A setting of the page."""
    return FIRST | {"law": {"name": law, "gains": gains or {}}, "plant": {"base": plant}} | more


def poked(i):
    """The longest flight through rotors, with as many pokes as a page may have."""
    pokes = [{"time": 1.45 * k + 0.001 * (i % 50), "on": "bob", "velocity": [0.1, 0, 0]} for k in range(1, 21)]
    return asked(duration=30.0, pokes=pokes)


# What a heavy page asks for the i-th time, and the seconds after which it asks again, whether it has an answer or not.
KINDS = {
    "sliders": ("fly", lambda i: asked(gains={"throw_speed": 1.5 + 0.001 * (i % 500)}), 0.02),
    "pokes": ("fly", poked, 1.0),
    "maps": ("map", lambda i: asked(duration=10.0, gains={"throw_speed": 1.5 + 0.001 * (i % 500)}), 3.0),
    "compiles": (
        "fly",
        lambda i: asked(vehicle={"base": "hehn2011", "rotor_limits": [0.08, 2.5 + 1e-6 * (time.time_ns() % 10**6)]}),
        3.0,
    ),
    "engines": ("engine", lambda i: asked(law=("inverted", "repaired", "almost_global")[i % 3]), 3.0),
    "lqr": ("fly", lambda i: asked("lqr", gains={"rod_error": 0.1 + 1e-4 * (i % 500)}), 0.2),
    "python": ("fly", lambda i: asked("slow", gains={"brake": 0.02 + 1e-5 * (i % 500)}, duration=3.0), 2.0),
    "endless": ("fly", lambda i: asked("endless", gains={"brake": 0.04 + 1e-5 * (i % 500)}), 1.0),
}


async def heavy(host, name, replies, place):
    """A page that asks for work of the kind `name` without end; counts what it gets at `place` of `replies`."""
    kind, setting, pause = KINDS[name]
    socket = await websocket_connect(f"ws://{host}/socket", max_message_size=2**26)

    async def read():
        while (reply := await socket.read_message()) is not None:
            replies[place] += '"compiling"' not in reply[:40]

    reading = asyncio.create_task(read())
    for i in count():
        await socket.write_message(json.dumps({"kind": kind, "number": i, "key": "", "setting": setting(i)}))
        await asyncio.sleep(pause)
    await reading


def crowd(host, kinds, replies):
    """Six heavy pages: a process of its own, so that the light page does not wait for what they read."""

    async def run():
        await asyncio.gather(*(heavy(host, name, replies, i) for i, name in enumerate(kinds)))

    asyncio.run(run())


async def waits(socket, number, rest):
    """The waits of a block, s; it rests for `rest` s in between, or REST times the last."""
    found = []
    for _ in range(WAITS):
        begun, i = time.monotonic(), next(number)
        setting = asked(gains={"rod_bandwidth": 7 + 0.01 * (i % 100)})
        await socket.write_message(json.dumps({"kind": "fly", "number": i, "setting": setting}))
        while True:
            reply = json.loads(await socket.read_message())
            if reply["kind"] == "flight" and reply["number"] == i:
                break
        found.append(time.monotonic() - begun)
        await asyncio.sleep(REST * (rest or found[-1]))
    return found


async def compare(host, kinds):
    """The waits alone and beside pages of `kinds`, s, and the replies that the least served of these had."""
    socket = await websocket_connect(f"ws://{host}/socket", max_message_size=2**24)
    number = count()
    await waits(socket, number, 0.0)  # compiled
    alone, beside, replies = [], [], multiprocessing.Array("q", len(kinds))
    for _ in range(BLOCKS):
        alone += await waits(socket, number, 0.0)
        pages = multiprocessing.get_context("fork").Process(target=crowd, args=(host, kinds, replies))
        pages.start()
        await asyncio.sleep(3 * REST * np.median(alone))
        beside += await waits(socket, number, np.median(alone))
        pages.kill()
        pages.join()
        await asyncio.sleep(1.0)
    socket.close()
    return np.array(alone), np.array(beside), int(min(replies))


def burn():
    """Compute without end."""
    while True:
        sum(range(10_000))


def main():
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="*", choices=[[], "mixed", *KINDS], help="default: all")
    parser.add_argument("--burn", type=int, default=0, metavar="N", help="processes that compute beside")
    options = parser.parse_args()
    burners = [multiprocessing.Process(target=burn, daemon=True) for _ in range(options.burn)]
    for burner in burners:
        burner.start()
    where = machine()
    print(f"{where['processor']}, {where['cores']} cores (load {where['load']:.1f}), {where['date']}.")
    print(f"{options.burn} processes compute beside.\n")
    columns = "alone, ms | beside, ms | ratio | longest alone, beside, ms | ratio of longest | least replies"
    print(f"| six heavy pages | {columns} |")
    print("|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        law = Path(folder) / "mine.py"
        law.write_text(LAW, encoding="utf-8")
        laws = [word for name in ("slow", "endless") for word in ("--law", f"{law}:{name}")]
        command = [sys.executable, "-m", "flypend", "lab", "--no-browser", *laws]
        server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        try:
            host = re.search(r"http://(\S+)/", server.stdout.readline())[1]
            for name in options.kinds or [*KINDS, "mixed"]:
                kinds = [*KINDS][:HEAVY] if name == "mixed" else [name] * HEAVY
                alone, beside, replies = asyncio.run(compare(host, kinds))
                middle, most = [1e3 * np.median(x) for x in (alone, beside)], [1e3 * max(x) for x in (alone, beside)]
                print(
                    f"| {name} | {middle[0]:.0f} | {middle[1]:.0f} | {middle[1] / middle[0]:.2f} | {most[0]:.0f}, "
                    f"{most[1]:.0f} | {most[1] / most[0]:.2f} | {replies} |",
                    flush=True,
                )
        finally:
            server.terminate()
            server.wait()


if __name__ == "__main__":
    main()
