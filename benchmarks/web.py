"""How fast pages fly: `python -m benchmarks.web` flies random starts for 6 s by a page's machine code, and draws a map.

Processor time a flight, in Node.js, of modules with one lane and with two, beside native code on one core;
then the seconds that a live page in chromium takes for a map of the region of attraction.
"""

import json
import shutil
import subprocess
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from playwright.sync_api import sync_playwright

import flypend as fp
from benchmarks.lab import OPTIONS
from flypend.flight.live import engine_facts, inflate
from flypend.flight.request import Tolerances
from flypend.plants import plant
from flypend.plants.loop import Loop

DURATION, STARTS = 6.0, 256
DONE = "flypend.map().total > 0 && flypend.map().done === flypend.map().total"


def here(vehicle, starts, through):
    """Milliseconds of processor time a flight by native code, on one core."""
    took = []
    for _ in range(5):
        begun = time.process_time()
        fp.simulate_ensemble(vehicle, fp.laws.inverted(), starts, DURATION, plant=through, workers=1)
        took.append(1e3 * (time.process_time() - begun) / len(starts.y))
    return min(took)


def there(loop, starts, lanes, folder):
    """Milliseconds of processor time a flight by a module with so many `lanes`, and the bytes of the module."""
    facts = engine_facts(loop, Tolerances(), lanes)
    code, asked = folder / "kernel.wasm", folder / "asked.json"
    code.write_bytes(inflate(facts.pop("code")))
    given = {"facts": facts, "starts": starts.packed().tolist(), "ticks": round(DURATION / facts["period"])}
    asked.write_text(json.dumps(given))
    told = subprocess.run(
        ["node", Path(__file__).with_name("fly.mjs"), asked, code], check=True, capture_output=True, text=True
    )
    return float(told.stdout), code.stat().st_size


def mapped(browser, run, folder):
    """Seconds from a touch of the tab to the last point of the map, and the number of points."""
    page = browser.new_page(viewport={"width": 1280, "height": 800})
    file = folder / "live.html"
    run.to_html(file, live=True)
    page.goto(file.as_uri())
    while not page.evaluate("window.flypend?.number() > 0 && flypend.shown() === flypend.number()"):
        time.sleep(0.05)
    begun = time.perf_counter()
    page.get_by_role("button", name="Region of attraction").click()
    while not page.evaluate(DONE):
        time.sleep(0.02)
    took, count = time.perf_counter() - begun, page.evaluate("flypend.map().total")
    page.close()
    return took, count


def main():
    """Print both for the inverted law, through rotors and the ideal plant."""
    vehicle, starts = fp.vehicle("hehn2011"), fp.random_starts(STARTS, 1)
    with TemporaryDirectory() as name, sync_playwright() as playwright:
        folder = Path(name)
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=OPTIONS)
        for through in ("rotors", "ideal"):
            loop = Loop(vehicle, fp.laws.inverted().bind(vehicle), plant(through))
            native = here(vehicle, starts, through)
            print(f"{through}: a flight of {DURATION:g} s takes {native:.2f} ms natively")
            for lanes in (1, 2):
                took, size = there(loop, starts, lanes, folder)
                print(f"  {took:.2f} ms in Node.js with {lanes} lanes, {took / native:.1f} times that; {size} bytes")
            run = fp.simulate(vehicle, fp.laws.inverted(), fp.State(y=(0, 0, -1)), DURATION, plant=through)
            took, count = np.array([mapped(browser, run, folder) for _ in range(3)]).min(axis=0)
            print(f"  a map of {count:.0f} flights takes {took:.1f} s in a page")
        browser.close()


if __name__ == "__main__":
    main()
