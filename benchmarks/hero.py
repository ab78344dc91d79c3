"""Draw the animation of the README: `python -m benchmarks.hero` writes docs/img/hero.webp.

A live page flies it: thrown from hanging, caught, poked twice. Its pictures are taken one by one in the chromium of the
tests, the flip in slow motion.
"""

import io
import json
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory
from urllib.parse import quote

from PIL import Image
from playwright.sync_api import sync_playwright

import flypend as fp
from benchmarks.lab import OPTIONS, SHOWN

TARGET = Path(__file__).parents[1] / "docs" / "img" / "hero.webp"
SIZE = {"width": 720, "height": 405}
RATE = 12.5  # pictures a second: the machine fills the picture, so each of them takes more bytes
QUALITY = 50  # of WebP, up to 100
FIRST = 0.02  # s: at its beginning a page shades the starts that are barred
DRAGGED, NEARER = (70, -36), -250  # pixels, from the camera beside the vehicle: level, before a plain sky; by the wheel
SPEEDS = ((0.85, 1.0), (1.65, 0.35), (7.6, 1.0))  # until this time of flight, s, it plays at this speed
POKES = (
    {"time": 3.0, "on": "bob", "velocity": [1.1, 0.4, 0.0]},
    {"time": 5.2, "on": "vehicle", "velocity": [-1.2, 0.0, 0.3]},
)
SAID = 0.7  # s for which a poke is named
# The scene alone, as large as the window.
STYLE = """.scene { position: fixed !important; inset: 0; margin: 0 !important; border-radius: 0 !important; }
.handle, .low, .compass, .busy, .recovered, .scene > .invite { display: none !important; }
.motion span { display: none; } .motion b { font-size: 26px !important; }
.poke-word { position: fixed; z-index: 10; font: 600 22px system-ui, sans-serif; color: var(--rod); }"""
SAY = """([word, on]) => {
  const said = document.querySelector(".poke-word") ?? document.querySelector(".scene").appendChild(
    Object.assign(document.createElement("p"), { className: "poke-word" }));
  const [left, top] = flypend.screen(0)[on === "bob" ? "bob" : "pivot"];
  said.textContent = word;
  Object.assign(said.style, { left: `${left + 26}px`, top: `${Math.max(top - 44, 6)}px` });
}"""


def times():
    """Times of flight of the pictures, s."""
    out, t = [], FIRST
    for end, speed in SPEEDS:
        while t < end:
            out.append(t)
            t += speed / RATE
    return out


def picture(page, t):
    """The scene of `page` at the time `t`."""
    page.evaluate("t => flypend.seek(t)", t)
    poke = next((poke for poke in POKES if poke["time"] <= t < poke["time"] + SAID), None)
    page.evaluate(SAY, ["poked" if poke else "", poke["on"] if poke else "bob"])
    return Image.open(io.BytesIO(page.screenshot())).convert("RGB")


def flown(browser, folder):
    """A page of `browser` with the flight."""
    file = Path(folder) / "hero.html"
    run = fp.simulate(fp.vehicle("hehn2011").replace(mount="hub"), fp.laws.inverted(), fp.State(y=(0, 0, -1)), 2.4)
    run.to_html(file, live=True)
    page = browser.new_page(viewport=SIZE, color_scheme="light", reduced_motion="reduce", device_scale_factor=1)
    page.goto(file.as_uri())
    page.wait_for_function(SHOWN)
    setting = page.evaluate("flypend.setting()") | {"pokes": POKES, "duration": 2.4}
    page.evaluate("hash => { location.hash = hash; }", quote(json.dumps(setting)))
    page.wait_for_function("() => flypend.setting().pokes.length === 2")
    page.wait_for_function(SHOWN)
    page.add_style_tag(content=STYLE)
    page.evaluate("flypend.pin(), flypend.camera('side')")
    page.wait_for_timeout(800)  # until it is there
    middle = SIZE["width"] / 2, SIZE["height"] / 2
    page.mouse.move(*middle)
    page.mouse.down()
    page.mouse.move(*(at + way for at, way in zip(middle, DRAGGED, strict=True)), steps=4)
    page.mouse.up()
    page.mouse.wheel(0, NEARER)
    return page


def main():
    """Draw it, and tell how large it is."""
    with sync_playwright() as playwright, TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=OPTIONS)
        page = flown(browser, folder)
        page.wait_for_timeout(500)
        frames = [picture(page, t) for t in times()]
    settings = {"duration": round(1000 / RATE), "loop": 0, "quality": QUALITY, "method": 4}
    frames[0].save(TARGET, save_all=True, append_images=frames[1:], **settings)
    print(f"{TARGET.name}: {len(frames)} pictures in {len(frames) / RATE:.1f} s, {TARGET.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
