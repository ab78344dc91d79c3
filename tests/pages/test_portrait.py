"""The phase portrait of the pages: the rod on the sphere of its directions, in a real browser without a screen."""

import numpy as np
import pytest

import flypend as fp
from benchmarks.frames import AT_REST, UNDRAWN
from flypend import palette
from flypend.paper import experiment
from tests.browser import begun, until

WIDE, NARROW = {"width": 1280, "height": 720}, {"width": 390, "height": 844}
# The middle of every dot, in CSS pixels from the middle of the disc, x to the right and y up; and half the canvas.
DOTS = """() => {
  const { left, top, width } = document.querySelector(".globe").getBoundingClientRect(), half = width / 2;
  const dots = [...document.querySelectorAll(".globe .rod")].reverse().map((dot) => dot.getBoundingClientRect());
  return [...dots.map((box) => [box.x + box.width / 2 - left - half, top + half - box.y - box.height / 2]), half];
}"""
# The colour of the canvas at such places, as drawn: transparent is where there is no disc.
COLOURS = """places => {
  const canvas = document.querySelector(".globe canvas"), context = canvas.getContext("2d");
  const pixel = (way) => Math.round(canvas.width / 2 + canvas.width / canvas.clientWidth * way - 0.5);
  return places.map(([x, y]) => [...context.getImageData(pixel(x), pixel(-y), 1, 1).data]);
}"""
STROKES = """window.strokes = 0;
const stroke = CanvasRenderingContext2D.prototype.stroke;
CanvasRenderingContext2D.prototype.stroke = function () {
  if (this.canvas.closest(".globe")) window.strokes += 1;
  stroke.call(this);
};"""
SHARPNESS = 4  # pixels of a screen to a CSS pixel, where colours are compared: a line is then wider than its own rim


@pytest.fixture(scope="module")
def up():
    start = fp.State(x=(0.3, -0.2, 0.1), y=(0.6, 0, 0.8), omega=(0.5, -1, 2), y_dot=(0, 3, 0))
    return fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), start, 3.0)


@pytest.fixture(scope="module")
def swing():
    return fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, -1)), 3.0)


@pytest.fixture(scope="module")
def down():
    """In the paper's frame, e₃ along gravity; the rod ends hanging."""
    case = experiment("4")
    return fp.simulate(case.vehicle, case.law("corrected"), case.start, 4.0, plant="ideal")


@pytest.fixture
def visit(chromium, tmp_path):
    contexts, complaints = [], []

    def open_(run, *, before="", setting=None, **options):
        run.to_html(tmp_path / "page.html", **options)
        context = chromium.new_context(offline=True, **{"viewport": WIDE, "color_scheme": "light"} | (setting or {}))
        contexts.append(context)
        page = context.new_page()
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.add_init_script(UNDRAWN + before)  # of the scene: the portrait is a canvas of its own
        page.goto((tmp_path / "page.html").as_uri())
        begun(page)
        page.evaluate(AT_REST)
        return page

    yield open_
    for context in contexts:
        context.close()
    assert complaints == []


def directions(run, times):
    """Directions of the rod of `run` at `times` with e₃ up, from its own samples."""
    y = np.stack([np.interp(times, run.t, run.y[:, k]) for k in range(3)], axis=-1)
    y /= np.linalg.norm(y, axis=-1, keepdims=True)
    return y if run.e3 == "up" else y * (1, -1, -1)


def places(y, middle=1):
    """Places on a disc of radius 1 whose areas are those of the sphere: at sin(θ/2), θ from the middle."""
    away = np.sin(np.arccos(np.clip(middle * y[:, 2], -1, 1)) / 2)
    heading = np.arctan2(y[:, 1], y[:, 0])
    return away[:, None] * np.stack([np.cos(heading), np.sin(heading)], axis=-1)


def seen(page, times, i=0):
    """Where the dot of run `i` is at `times`, and half the size of the canvas, in pixels."""
    found = []
    for t in times:
        page.evaluate("t => flypend.seek(t)", float(t))
        until(page, f"() => Math.abs(flypend.pose().t - {float(t)}) < 1e-9")
        page.evaluate("flypend.screen(0)")  # draws
        found.append(page.evaluate(DOTS))
    return np.array([dots[i] for dots in found]), found[0][-1]


def fitted(pixels, of):
    """The radius in pixels with which `of` fits the `pixels` best, and the largest distance that is left."""
    radius = np.sum(pixels * of) / np.sum(of**2)
    return radius, np.max(np.linalg.norm(pixels - radius * of, axis=-1))


TIMES = np.array([0.0, 0.15, 0.4, 0.8, 1.3, 2.4])


def test_a_dot_is_where_the_rod_points(visit, up, swing):
    page = visit(up, ghost=swing)
    pixels, half = seen(page, TIMES)
    radius, left = fitted(pixels, places(directions(up, TIMES)))
    assert left < 0.6  # a place is written to a tenth of a pixel, and the browser rounds the middle of the disc
    assert 0.6 * half < radius < half
    assert np.ptp(pixels, axis=0).min() > 5  # the rod moves in both directions: a dot at rest would fail
    ghost, _ = seen(page, TIMES, 1)
    assert np.max(np.linalg.norm(ghost - radius * places(directions(swing, TIMES)), axis=-1)) < 0.6
    page.get_by_role("button", name="Put hanging in the middle").click()
    over, _ = seen(page, TIMES)
    assert np.max(np.linalg.norm(over - radius * places(directions(up, TIMES), middle=-1), axis=-1)) < 0.6


def test_where_a_flight_ends_hanging_hanging_is_in_the_middle(visit, down):
    page = visit(down)
    times = np.array([0.0, 0.5, 1.0, 3.9])
    pixels, half = seen(page, times)
    _, left = fitted(pixels, places(directions(down, times), middle=-1))
    assert left < 0.6
    assert np.linalg.norm(pixels[-1]) < 0.3 * half < np.linalg.norm(pixels[0])
    assert "Put upright in the middle" in page.locator(".over").get_attribute("title")


def rgb(colour):
    return np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)])


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_path_is_drawn_where_the_rod_goes_and_nowhere_else(visit, up, swing, scheme):
    page = visit(up, ghost=swing, setting={"color_scheme": scheme, "device_scale_factor": SHARPNESS})
    pixels, _ = seen(page, TIMES)
    radius, _ = fitted(pixels, places(directions(up, TIMES)))
    tones = palette.PAGE[scheme]

    def share(y, role):
        colours = np.array(page.evaluate(COLOURS, (radius * places(y)).tolist()))
        return np.mean(np.linalg.norm(colours[:, :3] - rgb(tones[role]), axis=-1) < 40)

    times = np.linspace(0.2, 1.5, 60)
    way = directions(up, times)
    assert share(way, "rod") > 0.9  # ring at the start and ghosts may cover a few
    assert share(directions(swing, np.linspace(0.95, 1.3, 60)), "ghost") > 0.3  # dashes
    assert share(way * (-1, -1, 1), "rod") < 0.2  # negative control: on the other side of the disc


def test_a_touch_on_the_path_goes_to_its_time(visit, up):
    page = visit(up)
    pixels, half = seen(page, TIMES)
    box = page.locator(".globe").bounding_box()
    for t, (x, y) in zip(TIMES[1:3], pixels[1:3], strict=True):
        page.mouse.click(box["x"] + half + x, box["y"] + half - y)
        assert page.evaluate("flypend.time()") == pytest.approx(t, abs=0.05)
    page.mouse.click(box["x"] + half, box["y"] + box["height"] - 2)  # nothing there
    assert page.evaluate("flypend.time()") == pytest.approx(TIMES[2], abs=0.05)


def test_nothing_is_drawn_again_while_a_replay_plays_or_rests(visit, up):
    page = visit(up, before=STROKES)
    page.wait_for_timeout(300)
    strokes, count = page.evaluate("[strokes, flypend.frames().count]")
    assert strokes > 5  # rings, path and start: negative control
    page.evaluate("flypend.play()")
    until(page, f"() => flypend.frames().count > {count + 5}")
    page.evaluate("flypend.pause()")
    page.wait_for_timeout(800)
    count = page.evaluate("flypend.frames().count")
    page.wait_for_timeout(300)
    assert page.evaluate("[strokes, flypend.frames().count]") == [strokes, count]


@pytest.mark.parametrize(
    ("viewport", "live", "open_"),
    [(NARROW, False, False), (NARROW, True, False), (WIDE, False, True), (WIDE, True, True)],
)
def test_it_is_seen_where_there_is_room_and_put_away_by_key_and_button(visit, up, viewport, live, open_):
    page = visit(up, live=live, setting={"viewport": viewport})
    fold, globe = page.get_by_role("button", name="Rod direction"), page.locator(".globe")
    for expected in (open_, not open_, open_):
        assert globe.is_visible() == expected
        assert fold.get_attribute("aria-expanded") == str(expected).lower()
        if expected:
            box, scene = globe.bounding_box(), page.locator(".scene").bounding_box()
            assert box["width"] >= 130  # with names of the axes a disc of 82 pixels
            assert scene["x"] <= box["x"]
            assert box["x"] + box["width"] <= scene["x"] + scene["width"]
            assert scene["y"] <= box["y"]
            assert box["y"] + box["height"] <= scene["y"] + scene["height"]
        if expected == open_:
            fold.focus()
            page.keyboard.press("Enter")
        else:
            page.keyboard.press("s")
    assert globe.is_visible() != open_


def test_it_is_put_away_where_the_room_is_lost(visit, up):
    page = visit(up, setting={"viewport": WIDE})
    globe = page.locator(".globe")
    assert globe.is_visible()
    page.set_viewport_size(NARROW)
    globe.wait_for(state="hidden")
    page.keyboard.press("s")
    assert globe.is_visible()  # who asks for it has it


def test_the_path_of_a_flight_that_goes_on_follows_the_rod(visit, up):
    page = visit(up, live=True, setting={"device_scale_factor": SHARPNESS})
    pixels, _ = seen(page, TIMES)
    radius, left = fitted(pixels, places(directions(up, TIMES)))
    assert left < 0.6
    page.evaluate("flypend.seek(0.2), flypend.go(true)")
    until(page, "() => flypend.live().tick > 400")
    page.evaluate("flypend.poke('bob', [0, -3, 0])")
    until(page, "() => flypend.live().tick > 700")
    page.evaluate("flypend.pause()")
    page.wait_for_timeout(300)
    end = page.evaluate("flypend.time()")
    times = np.linspace(end - 0.6, end - 0.02, 40).tolist()
    y = np.array(page.evaluate("times => times.map((t) => (flypend.seek(t), flypend.pose().y))", times))
    colours = np.array(page.evaluate(COLOURS, (radius * places(y)).tolist()))
    assert np.ptp(radius * places(y), axis=0).max() > 4  # it has been moved
    assert np.mean(np.linalg.norm(colours[:, :3] - rgb(palette.PAGE["light"]["rod"]), axis=-1) < 40) > 0.9
