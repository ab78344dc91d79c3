"""Draw pictures in docs/img: `python -m benchmarks.pages` writes swing-up.png, replay.png and lab.png.

The browser is the chromium of the tests, without a screen. The lab's flight is poked while it balances.
"""

import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image
from playwright.sync_api import sync_playwright

import flypend as fp
from benchmarks.lab import OPTIONS, SHOWN
from flypend.pictures.stop_motion import stop_motion

PICTURES = Path(__file__).parents[1] / "docs" / "img"
SIZE = {"width": 1280, "height": 800}
SETTLE = 1500  # ms until the camera has arrived


def shoot(page, name):
    """Write what `page` shows as docs/img/`name`."""
    page.wait_for_timeout(SETTLE)
    path = PICTURES / name
    page.screenshot(path=path)
    picture = Image.open(path).convert("RGB")  # browsers compress in haste, and 256 colours are enough
    few = picture.quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=4, dither=Image.Dither.NONE)
    few.save(path, optimize=True)


def replay(browser):
    """The swing-up of the README, in the dive under the rod."""
    start = fp.State(y=(0, 0, -1))
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), start, duration=6)
    with TemporaryDirectory() as folder:
        file = Path(folder) / "flight.html"
        run.to_html(file)
        page = browser.new_page(viewport=SIZE | {"height": 720})
        page.goto(file.as_uri())
        page.evaluate("flypend.seek(1.2)")
        shoot(page, "replay.png")


def stills():
    """The flight of the animation, as stop-motion."""
    machine = fp.vehicle("hehn2011").replace(mount="hub")
    run = fp.simulate(machine, fp.laws.inverted(), fp.State(y=(0, 0, -1)), duration=6)
    stop_motion(run).savefig(PICTURES / "swing-up.png", dpi=200)


def lab(browser):
    """The laboratory, half a second after a poke."""
    command = [sys.executable, "-m", "flypend", "lab", "--no-browser"]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        page = browser.new_page(viewport=SIZE)
        page.goto(next(word for word in server.stdout.readline().split() if word.startswith("http")))
        page.wait_for_function(SHOWN)
        page.evaluate("flypend.seek(4)")
        page.wait_for_timeout(SETTLE)
        page.locator("[data-on=bob]").click()
        page.wait_for_function(SHOWN)
        page.evaluate("flypend.pause(), flypend.seek(4.5)")
        shoot(page, "lab.png")
    finally:
        server.kill()
        server.wait()


def main():
    """Draw all."""
    stills()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=OPTIONS)
        replay(browser)
        lab(browser)


if __name__ == "__main__":
    main()
