"""How long the laboratory takes from a slider to the flight: on the server, over the socket, and to the picture.

The browser is the chromium of the tests, without a screen, and draws in software.
"""

import asyncio
import json
import shutil
import subprocess
import sys
import time

import numpy as np
from playwright.sync_api import sync_playwright
from tornado.httpserver import HTTPServer
from tornado.testing import bind_unused_port
from tornado.websocket import websocket_connect

from flypend.lab.answers import answer
from flypend.lab.controls import offer
from flypend.lab.server import Laboratory

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
        message = {"kind": "fly", "number": i, "setting": setting(i, plant)}
        begun = time.process_time(), time.perf_counter()
        list(answer(message))
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


OPTIONS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
]
SHOWN = "() => window.flypend?.number() > 0 && flypend.shown() === flypend.number()"


def in_browser(pause):
    """Milliseconds of a flight in the page, from the slider until all but the picture is done, and until it is shown.

    The page is 1280 by 800 pixels. The slider rests for `pause` ms after each flight that the server has confirmed.
    """
    lab = [sys.executable, "-m", "flypend", "lab", "--no-browser"]
    server = subprocess.Popen(lab, stdout=subprocess.PIPE, text=True)
    try:
        address = next(word for word in server.stdout.readline().split() if word.startswith("http"))
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=OPTIONS)
            page = browser.new_page(viewport={"width": 1280, "height": 800})
            page.goto(address)
            page.wait_for_function(SHOWN)
            page.locator(".live").wait_for()  # the page has machine code
            for i in range(MOVES + 1):
                page.locator("[data-path='law.gains.rod_bandwidth'] input").fill(str(200 + i % 20))
                page.wait_for_function(SHOWN)
                page.wait_for_timeout(pause)
            times = [entry for entry in page.evaluate("flypend.timings()") if entry["here"]][-MOVES:]
    finally:
        server.kill()
    return np.array([[entry["flown"], entry["ready"], entry["picture"]] for entry in times]).T


def main():
    """Print medians and 95th percentiles."""
    for plant in ("ideal", "rotors"):
        processor, clock = on_server(plant)
        trip = asyncio.run(over_socket(plant))
        for name, values in (("processor", processor), ("server", clock), ("round trip", trip)):
            told(f"{plant:7s} {name}", values)
    for words, pause in (("one move", 200), ("moving on", 20)):
        flown, ready, picture = in_browser(pause)
        told(f"rotors  flown in the page, {words}", flown)
        told(f"rotors  beyond drawing, {words}", ready)
        told(f"rotors  picture, {words}", picture)


def told(name, values):
    """Print the median and 95th percentile of `values`."""
    median, late = np.percentile(values, (50, 95))
    print(f"{name:38s} median {median:6.1f} ms   95 % {late:6.1f} ms")


if __name__ == "__main__":
    main()
