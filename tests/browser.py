"""What tests of pages share: opening the page of a run, waiting, and the picture that it shows."""

import time
from io import BytesIO

import numpy as np
from PIL import Image

SMALL = {"width": 900, "height": 520}  # drawn fast enough in software


def until(page, condition, argument=None, *, seconds=60):
    """Wait; `wait_for_function` would compile text in the page, which the page forbids."""
    end = time.monotonic() + seconds
    while not page.evaluate(condition, argument):
        assert time.monotonic() < end, condition
        time.sleep(0.03)


def begun(page):
    """Wait until the page shows a flight."""
    until(page, "() => window.flypend && flypend.frames().count > 0 && (!flypend.shown || flypend.shown() > 0)")


def shown(page):
    """Wait for the flight of the present setting."""
    until(page, "() => window.flypend && flypend.number() > 0 && flypend.shown() === flypend.number()")


def opened(offline, run, folder, address="", setting=None, **options):
    """Return the page of a `run`, with these `options`, once it shows the flight; see `offline` for a `setting`."""
    run.to_html(folder / "page.html", **options)
    page = offline((folder / "page.html").as_uri() + address, **{"viewport": SMALL} | (setting or {}))
    begun(page)
    return page


def picture(page):
    """Pixels of the scene, once its next frame is drawn."""
    page.evaluate("flypend.screen(0)")
    return np.asarray(Image.open(BytesIO(page.locator(".picture").screenshot())).convert("RGB")).astype(int)
