"""How long the laboratory takes from a slider to the flight: on the server, and over the socket."""

import asyncio
import json
import time

import numpy as np
from tornado.httpserver import HTTPServer
from tornado.testing import bind_unused_port
from tornado.websocket import websocket_connect

from flypend.lab.controls import offer
from flypend.lab.server import Laboratory
from flypend.lab.session import flights

MOVES = 60


def setting(i, plant):
    """The first setting of the page with another gain."""
    return offer()["first"] | {
        "law": {"name": "inverted", "gains": {"rod_bandwidth": 7 + 0.03 * i}},
        "plant": {"base": plant},
    }


def on_server(plant):
    """Milliseconds of processor and of clock to answer each move."""
    times = []
    for i in range(MOVES + 1):
        message = {"number": i, "setting": setting(i, plant)}
        begun = time.process_time(), time.perf_counter()
        list(flights(message, lambda: None))
        times.append((time.process_time() - begun[0], time.perf_counter() - begun[1]))
    return 1e3 * np.array(times[1:]).T


async def over_socket(plant):
    """Milliseconds from sending a move to having its flight."""
    laboratory, (listening, port) = Laboratory("127.0.0.1"), bind_unused_port()
    server = HTTPServer(laboratory.application())
    server.add_socket(listening)
    socket = await websocket_connect(f"ws://127.0.0.1:{port}/socket", max_message_size=2**24)
    times = []
    for i in range(MOVES + 1):
        begun = time.perf_counter()
        await socket.write_message(json.dumps({"kind": "fly", "number": i, "setting": setting(i, plant)}))
        while json.loads(await socket.read_message())["kind"] != "flight":
            pass
        times.append(time.perf_counter() - begun)
    socket.close()
    server.stop()
    laboratory.close()
    return 1e3 * np.array(times[1:])


def main():
    """Print medians and 95th percentiles."""
    for plant in ("ideal", "rotors"):
        processor, clock = on_server(plant)
        trip = asyncio.run(over_socket(plant))
        for name, values in (("processor", processor), ("server", clock), ("round trip", trip)):
            median, late = np.percentile(values, (50, 95))
            print(f"{plant:7s} {name:11s} median {median:6.1f} ms   95 % {late:6.1f} ms")


if __name__ == "__main__":
    main()
