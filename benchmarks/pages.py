"""Draw pictures in docs/img: `python -m benchmarks.pages` draws all, or those that it is given the names of.

swing-up, replay and lab write swing-up.png, replay.png and lab.png. The browser is the chromium of the tests, without a
screen; the lab's flight is poked while it balances. api writes what examples of docs/reference/examples.py draw, and
vehicles a portrait of each vehicle of the package. live draws the still pictures of the live figures. The others
are what commands write.
"""

import os
import re
import shutil
import subprocess
import sys
from functools import partial
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image, ImageColor
from playwright.sync_api import sync_playwright

import flypend as fp
from benchmarks.frames import AT_REST
from benchmarks.lab import OPTIONS, SHOWN
from flypend.lab.controls import figures, story
from flypend.lab.standalone import chapters_page
from flypend.model.table import vehicle_names
from flypend.palette import CAUSES, SERIES
from flypend.pictures.machine import machine_figure
from flypend.pictures.stop_motion import stop_motion

DOCS = Path(__file__).parents[1] / "docs"
PICTURES = DOCS / "img"
CELL = re.compile(r"^# %% [^\n]+ \| api/(\S+): [^\n]+\n(.*?)(?=^# %%|\Z)", re.MULTILINE | re.DOTALL)
SIZE = {"width": 1280, "height": 800}
PAPER = 248  # of 255: what is as bright as this is white
SETTLE = 1500  # ms until the camera has arrived
FIGURE = {"width": 704, "height": 432}  # as docs/site/static/flypend.css shows it
MOMENTS = {"lqr": 1.0, "carry": 3.0, "throw": 0.6, "catch": 1.4, "rotors": 1.25}  # s: what a figure is about
MOMENT = 1.1  # s, of the others
FLOWN = "plan examples/planning/{}.toml --fly mujoco --figure"
# What writes a picture, as its page tells it, but for the picture's own name.
COMMANDS = {
    "map": "map --law lqr --runs 200000 -o",
    "machine": "vehicles hehn2011 -o",
    "plan-under-the-bar": FLOWN.format("under-the-bar"),
    "plan-in-sight": FLOWN.format("in-sight"),
    "plan-out-and-back": "plan examples/planning/out-and-back.toml --path examples/planning/out_and_back.py:path "
    "--duration 3 --fly mujoco --figure",
    "plan-landing": "plan examples/planning/landing.toml --end hanging --figure",
    "plan-hand-over": "plan --end examples/planning/hand-over.toml --objective effort --duration 1.5 --figure",
}


def command(name):
    """What `flypend` draws as docs/img/`name`.png."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.png"
        for typed in (["examples"], [*COMMANDS[name].split(), path]):
            subprocess.run([sys.executable, "-m", "flypend", *typed], cwd=folder, check=True)
        shutil.copy(path, PICTURES)
    compress(PICTURES / f"{name}.png", 256)


def shoot(page, name, colours=256):
    """Write what `page` shows as docs/img/`name`."""
    page.wait_for_timeout(SETTLE)
    path = PICTURES / name
    page.screenshot(path=path)
    compress(path, colours)


def compress(path, colours):
    """Write the picture `path` again, with as many colours, causes of failure in theirs: others compress in haste."""
    picture, causes = Image.open(path).convert("RGB"), [ImageColor.getrgb(colour) for colour in CAUSES.values()]
    found = picture.quantize(colours - len(causes), Image.Quantize.MAXCOVERAGE, kmeans=4, dither=Image.Dither.NONE)
    few = Image.new("P", (1, 1))
    palette = np.reshape(found.getpalette(), (-1, 3))[: colours - len(causes)]
    palette[palette.min(axis=1) > PAPER] = 255
    few.putpalette([*palette.ravel().tolist(), *chain.from_iterable(causes)])
    picture.quantize(palette=few, dither=Image.Dither.NONE).save(path, optimize=True)


def api():
    """What examples draw, in the colours of the package."""
    matplotlib.use("Agg")
    matplotlib.rcParams["axes.prop_cycle"] = matplotlib.cycler(color=SERIES)
    (PICTURES / "api").mkdir(exist_ok=True)
    here = Path.cwd()
    for name, code in CELL.findall((DOCS / "reference" / "examples.py").read_text(encoding="utf-8")):
        with TemporaryDirectory() as folder:
            os.chdir(folder)
            exec(compile(code, name, "exec"), {"__name__": "__main__"})
            os.chdir(here)
            shutil.copy(Path(folder, name), PICTURES / "api" / name)
        plt.close("all")
        compress(PICTURES / "api" / name, 64)


def vehicles():
    """The vehicles of the package, to scale, each on its own scale."""
    for name in vehicle_names():
        path = PICTURES / f"vehicle-{name}.png"
        machine_figure(fp.vehicle(name)).savefig(path, dpi=100)
        compress(path, 64)


def browsed(draw):
    """Draw with a browser."""
    with sync_playwright() as playwright:
        draw(playwright.chromium.launch(executable_path=shutil.which("chromium"), args=OPTIONS))


def replay(browser):
    """The swing-up of the README, in the dive under the rod."""
    vehicle = fp.vehicle("hehn2011").replace(mount="hub")
    run = fp.simulate(vehicle, fp.laws.inverted(), fp.State(y=(0, 0, -1)), duration=6)
    with TemporaryDirectory() as folder:
        file = Path(folder) / "flight.html"
        run.to_html(file)
        page = browser.new_page(viewport=SIZE | {"height": 720})
        page.goto(file.as_uri())
        page.evaluate("flypend.seek(1.2)")
        shoot(page, "replay.png")


def live(browser):
    """Each live figure as a picture, and the page of all chapters."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "chapters.html"
        file.write_text(chapters_page(), encoding="utf-8")
        for name in ["chapters", *(step["name"] for step in [*story(), *figures()])]:
            size, asked = (SIZE, "") if name == "chapters" else (FIGURE, f"?figure={name}")
            page = browser.new_page(viewport=size, reduced_motion="reduce")
            page.goto(file.as_uri() + asked)
            page.wait_for_function(SHOWN)
            page.locator(".picture").click()  # puts the invitation away
            page.evaluate("t => flypend.seek(t)", MOMENTS.get(name, MOMENT))
            shoot(page, f"live-{name}.png", 64)
            page.close()


def stills():
    """The flight of the animation, as stop-motion."""
    machine = fp.vehicle("hehn2011").replace(mount="hub")
    run = fp.simulate(machine, fp.laws.inverted(), fp.State(y=(0, 0, -1)), duration=6)
    stop_motion(run).savefig(PICTURES / "swing-up.png", dpi=200)


def lab(browser):
    """The laboratory, half a second after a poke."""
    command = [sys.executable, "-m", "flypend", "lab", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            page = browser.new_page(viewport=SIZE)
            page.goto(next(word for word in server.stdout.readline().split() if word.startswith("http")))
            page.wait_for_function(SHOWN)
            page.evaluate(AT_REST)  # with the panel
            page.evaluate("flypend.seek(4)")
            page.wait_for_timeout(SETTLE)
            page.locator("[data-on=bob]").click()
            page.wait_for_function(SHOWN)
            page.evaluate("flypend.pause(), flypend.seek(4.5)")
            shoot(page, "lab.png")
        finally:
            server.kill()


DRAWINGS = {
    "swing-up": stills, "replay": partial(browsed, replay), "lab": partial(browsed, lab),
    "live": partial(browsed, live), "api": api, "vehicles": vehicles,
    **{name: partial(command, name) for name in COMMANDS},
}  # fmt: skip


def main(names):
    """Draw those of `names`, or all."""
    for name in names or DRAWINGS:
        DRAWINGS[name]()


if __name__ == "__main__":
    main(sys.argv[1:])
