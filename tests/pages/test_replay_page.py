"""The replay in a real browser without a screen: it opens from disk, plays, scrubs, shows the numbers of the run."""

import dataclasses
import gc
import itertools
import re
import time
import warnings
from io import BytesIO

import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image

import flypend as fp
from benchmarks.frames import AT_REST
from flypend import geometry
from flypend.flight.verdict import verdict
from flypend.pages import replay
from flypend.paper import experiment
from tests.browser import SMALL, picture, until

LAW = fp.laws.inverted()
WIDE, NARROW = {"width": 1280, "height": 720}, {"width": 390, "height": 844}


@pytest.fixture
def visit(offline, tmp_path):
    """Open the replay of a run from disk; see `offline`."""
    number = itertools.count()

    def open_(run, *, setting=None, text=None, drawn=False, **options):
        path = tmp_path / f"{next(number)}.html"
        path.write_text(run.to_html(**options) if text is None else text, encoding="utf-8")
        page = offline(path.as_uri(), drawn=drawn, **{"viewport": SMALL, "color_scheme": "light"} | (setting or {}))
        page.wait_for_selector("main, iframe")
        if page.evaluate("Boolean(window.flypend?.playing())"):
            page.evaluate(AT_REST)
        return page

    return open_


@pytest.fixture(scope="module")
def down():
    """In the paper's frame, e₃ along gravity; the rod begins inverted and swings to hang."""
    case = experiment("4")
    return fp.simulate(case.vehicle, case.law("corrected"), case.start, 2.0, plant="ideal")


@pytest.fixture(scope="module")
def up():
    start = fp.State(x=(0.3, -0.2, 0.1), y=(0.6, 0, 0.8), omega=(0.5, -1, 2))
    return fp.simulate(fp.vehicle("hehn2011"), LAW, start, 2.0, plant="rotors")


@pytest.fixture(scope="module")
def lqr():
    return fp.simulate(fp.vehicle("hehn2011"), fp.laws.lqr(), fp.State(y=(0.1, 0, np.sqrt(0.99))), 1.5, plant="rotors")


@pytest.fixture(scope="module")
def singular():
    case = experiment("2")
    return fp.simulate(case.vehicle, case.law("printed"), case.start, 6.5, plant="ideal")


def pose(page, t, i=0):
    page.evaluate("t => flypend.seek(t)", t)
    return {name: np.array(value) for name, value in page.evaluate("i => flypend.pose(i)", i).items()}


def screen(page, i=0):
    """Pixels of pivot and bob, once the camera has arrived."""
    places = page.evaluate("i => flypend.screen(i)", i)
    for _ in range(300):
        after = page.evaluate("i => flypend.screen(i)", i)
        if np.allclose([*places.values()], [*after.values()], atol=1e-3):
            break
        places = after
    else:
        raise AssertionError("the camera does not arrive")
    return np.array(after["pivot"]), np.array(after["bob"])


# It shows the run --------------------------------------------------------------------------------------------------


def test_it_opens_from_disk_and_draws(visit, up):
    page = visit(up, drawn=True)
    assert page.title() == page.locator("h1").inner_text() == "inverted law on hehn2011"
    assert page.evaluate("[flypend.time(), flypend.duration(), flypend.playing()]") == [0, 2, False]
    assert page.locator(".plot").count() == 4
    seen = picture(page)
    centre = screen(page)[0].astype(int)
    around = seen[centre[1] - 60 : centre[1] + 60, centre[0] - 60 : centre[0] + 60]
    assert len(np.unique(around.reshape(-1, 3), axis=0)) > 100  # a shaded machine, not a blank
    for plot in page.locator(".plot canvas").all():
        curves = np.asarray(Image.open(BytesIO(plot.screenshot())).convert("RGB"))
        assert len(np.unique(curves.reshape(-1, 3), axis=0)) > 20


@pytest.mark.parametrize("name", ["down", "up"])
def test_the_pose_at_a_time_is_that_of_the_run(visit, name, request):
    run = request.getfixturevalue(name)
    page = visit(run)
    for i in (0, 1, 57, 100, len(run.t) - 1):
        shown = pose(page, float(run.t[i]))
        assert shown["t"] == pytest.approx(run.t[i], abs=1e-6)
        # 32-bit floats, also of the time, over which things turn at up to 20 rad/s.
        for key in ("x", "y", "R", "x_ref"):
            np.testing.assert_allclose(shown[key], getattr(run, key)[i], atol=5e-6, err_msg=key)
        for key in ("thrust", "rotor_forces", "x_dot", "y_dot"):
            np.testing.assert_allclose(shown[key], getattr(run, key)[i], atol=2e-4, err_msg=key)


def test_it_opens_with_one_drawing(visit, up):
    """The first picture costs a start the most; none is drawn that is gone before anyone sees it."""
    page = visit(up, setting={"reduced_motion": "reduce"})
    until(page, "flypend.frames().count > 0")
    page.wait_for_timeout(500)
    assert page.evaluate("flypend.frames().count") == 1


def test_between_samples_it_shows_the_dense_output(visit, down):
    page = visit(down)
    times = np.random.default_rng(5).uniform(0, 2, 40)
    shown = [pose(page, t) for t in times]
    states = down.at(times)
    error = {key: np.abs(np.array([s[key] for s in shown]) - getattr(states, key)).max() for key in ("x", "y", "R")}
    assert error["x"] < 1e-5
    assert error["y"] < 1e-5  # cubic: h⁴ d⁴y/dt⁴ / 384
    assert error["R"] < 2e-3  # constant rate between samples: h² dω/dt / 8
    off = [np.linalg.norm(s["R"].T @ s["R"] - np.eye(3)) for s in shown]
    assert max(off) < 1e-12


def test_the_readings_beside_the_plots_are_the_values_of_the_run(visit, up):
    page = visit(up)
    i = 30
    page.evaluate("t => flypend.seek(t)", float(up.t[i]))
    page.evaluate("flypend.screen(0)")
    told = [float(word.replace("−", "-")) for word in page.locator(".values output").all_inner_texts()]
    away = np.linalg.norm(up.x[i] - up.x_ref[i])
    wanted = [up.y[i, 2], up.z[i, 2], up.thrust[i], *up.rotor_forces[i], away]
    np.testing.assert_allclose(told, wanted, atol=0.00501)


@pytest.fixture(scope="module")
def thrown():
    return fp.simulate(fp.vehicle("hehn2011"), LAW, fp.State(y=(0, 0, -1)), 3.0)


def phases(page, i=0):
    return page.evaluate("i => flypend.phases(i)", i)


def test_a_swing_up_climbs_flips_catches_and_stands(visit, thrown):
    page = visit(thrown)
    told = phases(page)
    # It leans by more than 15° once more on its way home; it stands where the verdict says so.
    names = [phase["name"] for phase in told]
    assert names == ["climbs", "flips", *["catches", "settles"] * 2, "stands"][: len(names)]
    assert told[0]["from"] == 0
    assert told[-1]["to"] == pytest.approx(3)
    assert all(before["to"] == after["from"] for before, after in itertools.pairwise(told))
    climbs, flips, catches, stands = (
        np.any([(thrown.t > p["from"] + 0.02) & (thrown.t < p["to"] - 0.02) for p in told if p["name"] == name], axis=0)
        for name in ("climbs", "flips", "catches", "stands")  # samples are 0.01 s apart
    )
    bob = thrown.x_dot + thrown.vehicle.rod_length * thrown.y_dot
    height, rate = thrown.y[:, 2], np.sqrt(thrown.vehicle.gravity / thrown.vehicle.rod_length)
    assert (bob[climbs & (thrown.t > 0.1), 2] > 0).all()
    assert (height[climbs | flips] < 0).all()
    assert (thrown.y_dot[flips, 2] > 0.5 * rate).all()
    assert (height[catches | stands] > 0).all()
    assert (height[stands] > np.cos(np.radians(15))).all()
    for phase in told:
        page.evaluate("t => flypend.seek(t)", (phase["from"] + phase["to"]) / 2)
        until(page, f"() => document.querySelector('.motion b').textContent === '{phase['name']}'")


def test_phases_do_not_depend_on_the_frame_and_name_what_fails(visit, down, thrown):
    page = visit(down, ghost=down.flipped())
    assert phases(page, 0) == phases(page, 1)
    assert {phase["name"] for phase in phases(page)} >= {"drops"}
    hanging = fp.simulate(thrown.vehicle, fp.laws.lqr(), thrown.states[0], 3.0)
    assert [phase["name"] for phase in phases(visit(hanging))] == ["hangs"]


def test_rotors_turn_by_their_force(visit, up):
    page = visit(up)
    force = np.maximum(up.rotor_forces, 0) * 4 / up.vehicle.weight
    steps = np.diff(up.t)[:, None] * (np.sqrt(force[1:]) + np.sqrt(force[:-1])) / 2
    turns = pose(page, 2.0)["turned"] / steps.sum(axis=0)
    np.testing.assert_allclose(turns, turns[0], rtol=1e-5)
    assert turns[0] > 2 * np.pi  # more than a turn per second in hover


def ink(page, t):
    """Where orange, the front rotor's colour, is seen strongly, and where faintly; pixels, from above at `t`."""
    page.evaluate("t => { flypend.camera('axis'); flypend.seek(t); }", t)
    scene = page.locator(".scene").bounding_box()
    page.mouse.move(scene["x"] + scene["width"] / 2, scene["y"] + scene["height"] / 2)
    page.mouse.wheel(0, -700)
    screen(page)
    seen = picture(page)
    share = (seen[..., 0] - seen[..., 2]) / 230  # of #e69f00 over a grey floor
    return share > 0.7, (share > 0.2) & (share < 0.6)


def test_blades_blur_by_the_speed_of_their_rotor(visit):
    """At rest two blades are seen; in hover the same ink is spread over trails, paler and wider."""
    run = fp.simulate(fp.vehicle("hehn2011"), LAW, fp.State(y=(0, 0, 1)), 4.0, plant="rotors")
    assert run.rotor_forces[0].max() < 0.1 * run.rotor_forces[-1].mean()
    page = visit(run, drawn=True)
    rest, hover = ink(page, 0.0), ink(page, 4.0)
    # What is seen in both, the bob and the cage, is no blade.
    strong, faint = ((int(np.sum(a & ~b)), int(np.sum(b & ~a))) for a, b in zip(rest, hover, strict=True))
    assert strong[0] > 2 * strong[1], (strong, faint)
    assert faint[1] > 1.5 * faint[0], (strong, faint)


def test_whoever_wants_little_motion_sees_no_rotor_turn(visit, still):
    """The picture of a hovering machine is then the same at any time, but for rounding; otherwise its rotors turn."""
    changed = {}
    for wanted in ("reduce", "no-preference"):
        page = visit(still, drawn=True, setting={"reduced_motion": wanted})
        pictures = []
        for t in (0.5, 1.0, 1.03):  # after the first, all that belongs to the page stands where it belongs
            page.evaluate("t => flypend.seek(t)", t)
            screen(page)
            page.wait_for_timeout(200)
            pictures.append(picture(page))
        changed[wanted] = int(np.sum(np.abs(pictures[2] - pictures[1]).max(axis=-1) > 8))
    assert changed["reduce"] == 0, changed
    assert changed["no-preference"] > 100, changed


@pytest.fixture(scope="module")
def fallen():
    """The LQR, from a level rod: it flies on and never stands."""
    return fp.simulate(fp.vehicle("hehn2011"), fp.laws.lqr(), fp.State(y=(1, 0, 0)), 3.0)


@pytest.fixture(scope="module")
def still():
    """Upright from the start: nothing moves but the last digits."""
    return fp.simulate(fp.vehicle("hehn2011"), LAW, fp.State(y=(0, 0, 1)), 2.0, plant="ideal")


def told(page):
    """What the plots say to those who do not see them: ranges, limits, what is cut off."""
    return [canvas.get_attribute("aria-label") for canvas in page.locator(".plot canvas").all()]


def test_a_flight_that_never_stands_is_not_called_completed(visit, fallen, up):
    page = visit(fallen, ghost=up)
    said = page.locator(".legend .verdict")
    assert "completed" not in page.locator("header").inner_text()
    assert said.nth(0).inner_text() == verdict(fallen)["words"]
    assert "failed" in said.nth(0).get_attribute("class")
    assert "not settled" in said.nth(0).inner_text()


def test_curves_of_one_plot_differ_by_more_than_colour(visit, up):
    page = visit(up)
    for plot in page.locator(".plot").all():
        marks = plot.locator(".mark > :last-child").evaluate_all("all => all.map((one) => one.outerHTML)")
        assert len(set(marks)) == len(marks) >= 1


def test_limits_of_the_rotors_are_shaded_where_a_flight_comes_near(visit, up, still):
    assert "rotor limit 3.5 N" in told(visit(up))[2]
    assert "more than" not in told(visit(still))[2]  # not where it stays far below


def test_roundoff_does_not_fill_an_axis(visit, still):
    assert geometry.norm(still.x).max() < 1e-3
    low, high = re.search(r"time, (\S+) to (\S+) m", told(visit(still))[3]).groups()
    assert (float(low), float(high) >= 0.05) == (0, True)


def test_a_spike_flattens_no_plot_and_is_told(visit, singular, down):
    peak = np.abs(singular.rotor_forces).max()
    assert peak > 5e4
    for run, others in ((singular, []), (down, [singular])):
        (label,) = (text for text in told(visit(run, ghost=others)) if text.startswith("Rotor forces"))
        low, high = re.search(r"time, (\S+) to (\S+) N", label.replace("−", "-")).groups()
        assert float(high) - float(low) < 40
        assert f"cut off, peak {peak / 1e3:.0f} kN" in label


def test_symbols_are_written_as_symbols(visit, down):
    text = visit(down).locator("main").inner_html()
    assert "x_ref" not in text
    assert "k_1" not in text
    assert "<i>k</i><sub>1</sub> = 12" in text


@pytest.mark.parametrize(("scheme", "viewport"), [("light", WIDE), ("dark", NARROW)], ids=["wide", "narrow"])
def test_axe_finds_nothing(visit, axe, up, singular, scheme, viewport):
    page = visit(up, ghost=singular, setting={"color_scheme": scheme, "viewport": viewport})
    page.evaluate("flypend.seek(1)")
    screen(page)
    assert axe(page) == []
    assert verdict(singular)["words"] in page.locator(".picture").get_attribute("aria-label")
    page.evaluate("document.querySelector('.line').removeAttribute('aria-label')")
    assert [rule for rule, _ in axe(page)] == ["label"]  # negative control


# It plays and scrubs ------------------------------------------------------------------------------------------------


def test_it_plays_pauses_ends_and_plays_again(visit, up):
    page = visit(up, speed=0.1)  # slow enough for a click to come before the end
    page.get_by_role("button", name="Play").click()
    until(page, "flypend.playing() && flypend.time() > 0.02")
    page.get_by_role("button", name="Pause").click()
    until(page, "!flypend.playing()")
    stopped = page.evaluate("flypend.time()")
    frames = page.evaluate("flypend.frames().count")
    time.sleep(0.3)
    assert page.evaluate("flypend.time()") == stopped < 1
    assert page.evaluate("flypend.frames().count") <= frames + 2  # nothing is drawn while nothing moves
    page.evaluate("flypend.speed(1), flypend.seek(1.9), flypend.play()")
    until(page, "!flypend.playing()")
    assert page.evaluate("flypend.time()") == 2
    page.get_by_role("button", name="Play again").click()
    until(page, "flypend.playing() && flypend.time() < 1.5")


def test_slow_motion_is_slow(visit, up):
    page = visit(up, speed=0.25)
    measure = """async () => {
        const start = performance.now(), from = flypend.time();
        flypend.play();
        await new Promise((done) => setTimeout(done, 1000));
        flypend.pause();
        return (flypend.time() - from) / (performance.now() - start) * 1000;
    }"""
    assert page.get_by_label("Speed").input_value() == "0.25"
    # A frame late at either end, and no frame counts for more than a quarter of a second.
    assert 0.02 < page.evaluate(measure) < 0.26
    page.get_by_label("Speed").select_option("0.1")
    assert page.evaluate(measure) < 0.11


def test_the_time_line_and_the_plots_scrub(visit, up):
    page = visit(up)
    page.get_by_label("Time", exact=True).fill("0.8")
    assert page.evaluate("flypend.time()") == pytest.approx(0.8)
    line = page.get_by_label("Time", exact=True).bounding_box()
    page.mouse.click(line["x"] + line["width"] / 2, line["y"] + line["height"] / 2)
    assert page.evaluate("flypend.time()") == pytest.approx(1.0, abs=0.02)
    area = page.locator(".plot .area").nth(1).bounding_box()
    left, right = area["x"] + 46, area["x"] + area["width"] - 12  # as plots.js sets its margins
    middle = area["y"] + area["height"] / 2
    page.mouse.move(left + 0.25 * (right - left), middle)
    page.mouse.down()
    assert page.evaluate("flypend.time()") == pytest.approx(0.5, abs=0.01)
    page.mouse.move(left + 0.75 * (right - left), middle, steps=4)
    page.mouse.up()
    assert page.evaluate("flypend.time()") == pytest.approx(1.5, abs=0.01)
    page.evaluate("flypend.screen(0)")
    cursor = page.locator(".plot .cursor").first.bounding_box()
    assert cursor["x"] + cursor["width"] / 2 == pytest.approx(left + 0.75 * (right - left), abs=1.5)
    assert page.locator(".time").inner_text() == f"{page.evaluate('flypend.time()'):.2f} / 2.00 s"


def test_times_that_are_none_change_nothing(visit, up):
    page = visit(up)
    page.evaluate("flypend.seek(0.7); flypend.seek(NaN); flypend.seek('x'); flypend.speed(0); flypend.speed(-1)")
    assert page.evaluate("flypend.time()") == 0.7
    assert page.get_by_label("Speed").input_value() == "1"
    page.evaluate("flypend.seek(99)")
    assert page.evaluate("flypend.time()") == 2
    page.evaluate("flypend.seek(-99)")
    assert page.evaluate("flypend.time()") == 0
    assert page.evaluate("[flypend.camera('none'), flypend.layout('beside'), flypend.theme('red')]") == [False] * 3


def test_space_presses_a_button_that_tab_has_reached_and_plays_after_a_click(visit, up):
    page = visit(up)
    side = page.get_by_role("button", name="Side", exact=True)
    page.get_by_role("button", name="Overview").focus()
    page.keyboard.press("Tab")
    page.keyboard.press("Space")
    assert (side.get_attribute("aria-pressed"), page.evaluate("flypend.playing()")) == ("true", False)
    assert side.evaluate("button => button === document.activeElement")
    page.get_by_role("button", name="Follow").click()
    page.keyboard.press("Space")
    assert page.evaluate("flypend.playing()")
    assert page.get_by_role("button", name="Follow").get_attribute("aria-pressed") == "true"


def test_keys(visit, up):
    page = visit(up)
    steps = [
        ("ArrowRight", 1 / 30), ("Shift+ArrowRight", 1 + 1 / 30), ("ArrowLeft", 1), ("End", 2), ("Shift+ArrowLeft", 1),
        ("Home", 0),
    ]  # fmt: skip
    for key, wanted in steps:
        page.keyboard.press(key)
        assert page.evaluate("flypend.time()") == pytest.approx(wanted)
    page.keyboard.press("Space")
    assert page.evaluate("flypend.playing()")
    page.keyboard.press("Space")
    assert not page.evaluate("flypend.playing()")
    page.keyboard.press("ArrowDown")
    page.evaluate("flypend.screen(0)")
    assert page.get_by_label("Speed").input_value() == "0.5"
    page.keyboard.press("4")
    assert page.get_by_role("button", name="Above").get_attribute("aria-pressed") == "true"
    page.keyboard.press("t")
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"


def movie(page, path):
    """Frames of the movie that the page saves at `path`, and what its file says of it."""
    with page.expect_download(timeout=300_000) as waiting:
        page.get_by_role("button", name="Movie").click()
    waiting.value.save_as(path)
    reader = imageio_ffmpeg.read_frames(str(path))
    facts = next(reader)
    width, height = facts["size"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)  # read_frames leaves the pipes of an ended ffmpeg open
        frames = np.array([np.frombuffer(frame, np.uint8).reshape(height, width, 3) for frame in reader], int)
        gc.collect()
    return frames, facts, waiting.value.suggested_filename


def test_a_movie_plays_at_its_speed_however_slowly_it_is_drawn(visit, up, tmp_path):
    """Each frame is the picture of its own time: of 2 s at twice their speed 30 a second, and 1.5 s of their end."""
    page = visit(up, speed=2, drawn=True)
    page.evaluate("flypend.seek(1.3)")
    frames, facts, name = movie(page, tmp_path / "a.webm")
    assert name == "inverted-law-on-hehn2011.webm"
    box = page.locator(".picture").bounding_box()
    assert facts["size"] == pytest.approx((box["width"], box["height"]), abs=2)
    assert (facts["fps"], len(frames)) == (30, 30 + 1 + 45)
    assert facts["duration"] == pytest.approx(76 / 30, abs=0.01)
    assert page.evaluate("flypend.time()") == 2
    button = page.get_by_role("button", name="Movie")
    assert (button.get_attribute("aria-pressed"), button.inner_text()) == ("false", "Movie")
    middle = np.s_[150:350, 320:560]  # the machine, without words over the picture
    for i in (3, 8, 14):
        page.evaluate("t => flypend.seek(t)", i * 2 / 30)
        shown = picture(page)[middle]
        apart = [np.abs(frame[middle] - shown).mean() for frame in frames[:31]]
        assert int(np.argmin(apart)) == i


def test_movies_and_pictures_have_the_size_that_is_chosen(visit, tmp_path):
    short = fp.simulate(fp.vehicle("hehn2011"), LAW, fp.State(y=(0.6, 0, 0.8)), 0.1)
    page = visit(short, speed=2)
    page.locator(".sizes").select_option("1080p")
    frames, facts, _ = movie(page, tmp_path / "a.webm")
    assert facts["size"] == (1920, 1080)
    assert len(frames) == 2 + 1 + 45
    assert page.evaluate("(({ width, clientWidth }) => width === clientWidth)(document.querySelector('.picture'))")


def test_a_movie_can_be_given_up(visit, up):
    page = visit(up, speed=0.1)
    page.keyboard.press("m")
    until(page, "document.querySelector('[data-name=movie]').textContent.endsWith('%')")
    page.keyboard.press("m")
    until(page, "document.querySelector('[data-name=movie]').getAttribute('aria-pressed') === 'false'")


def test_a_movie_that_cannot_be_encoded_is_told(visit, up):
    page = visit(up)
    page.evaluate("VideoEncoder.isConfigSupported = async () => ({ supported: false })")
    page.keyboard.press("m")
    until(page, "document.querySelector('.note').textContent.includes('encodes no WebM')")
    assert page.get_by_role("button", name="Movie").get_attribute("aria-pressed") == "false"
    page.evaluate("""() => {
        VideoEncoder.isConfigSupported = async () => ({ supported: true });
        VideoEncoder.prototype.configure = () => {};
    }""")  # then it refuses to encode
    page.keyboard.press("m")
    until(page, "document.querySelector('.note').textContent.includes('encode')")
    until(page, "document.querySelector('[data-name=movie]').textContent === 'Movie'")


# Cameras -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("frame", ["down", "flipped"])
def test_gravity_points_down_the_screen(visit, down, frame):
    run = down if frame == "down" else down.flipped()
    page = visit(run)
    below = run.vehicle.rod_length * run.y[:, 2] * (1 if run.e3 == "down" else -1)  # bob under pivot
    assert below[0] < -0.4
    assert below[-1] > 0.3
    for camera in ("side", "follow", "overview"):
        page.evaluate("name => flypend.camera(name)", camera)
        for i, sign in ((0, -1), (len(run.t) - 1, 1)):
            page.evaluate("t => flypend.seek(t)", float(run.t[i]))
            pivot, bob = screen(page)
            assert sign * (bob[1] - pivot[1]) > 5, camera


def test_both_frames_give_the_same_picture(visit, down):
    places = []
    for run in (down, down.flipped()):
        page = visit(run)
        page.evaluate("flypend.camera('follow'), flypend.seek(0.9)")
        places.append(screen(page))
    np.testing.assert_allclose(places[0], places[1], atol=0.05)


def test_from_above_the_rod_is_seen_along_gravity(visit, down):
    page = visit(down)
    page.evaluate("flypend.camera('axis'), flypend.seek(0.9)")
    pivot, bob = screen(page)
    # The camera is on the −e₃ axis of the paper's frame: e₁ to the right, e₂ down the screen.
    seen, y = bob - pivot, down.at(0.9).y
    assert np.linalg.norm(y[:2]) > 0.3
    assert np.dot(seen, y[:2]) / np.linalg.norm(seen) / np.linalg.norm(y[:2]) == pytest.approx(1, abs=1e-6)
    page.evaluate("flypend.seek(0)")
    pivot, bob = screen(page)
    assert np.linalg.norm(bob - pivot) < 0.5  # upright


def test_followed_vehicles_stay_in_the_middle(visit, down):
    page = visit(down)
    for camera in ("side", "follow", "axis"):
        page.evaluate("name => flypend.camera(name)", camera)
        size = page.locator(".picture").bounding_box()
        for t in (0.2, 2.0):
            page.evaluate("t => flypend.seek(t)", t)
            np.testing.assert_allclose(screen(page)[0], [size["width"] / 2, size["height"] / 2], atol=0.6)


@pytest.mark.parametrize("viewport", [SMALL, NARROW], ids=["wide", "narrow"])
def test_the_overview_holds_all_flights(visit, up, down, viewport):
    page = visit(up, ghost=down, setting={"viewport": viewport})  # which falls 20 m
    page.evaluate("flypend.camera('overview')")
    size = page.locator(".picture").bounding_box()
    for t in np.linspace(0, 2, 9):
        page.evaluate("t => flypend.seek(t)", t)
        for place in (*screen(page, 0), *screen(page, 1)):
            assert np.all(place > 0)
            assert np.all(place < [size["width"], size["height"]])


def test_the_mouse_turns_and_zooms_and_a_double_click_resets(visit, up):
    page = visit(up)
    page.evaluate("flypend.camera('side'), flypend.seek(0)")
    before = screen(page)
    box = page.locator(".picture").bounding_box()
    middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(*middle)
    page.mouse.down()
    page.mouse.move(middle[0] + 90, middle[1] + 40, steps=3)
    page.mouse.up()
    turned = screen(page)
    assert np.linalg.norm((turned[1] - turned[0]) - (before[1] - before[0])) > 10
    page.mouse.wheel(0, -500)
    zoomed = screen(page)
    assert np.linalg.norm(zoomed[1] - zoomed[0]) > 1.5 * np.linalg.norm(turned[1] - turned[0])
    page.mouse.dblclick(*middle)
    np.testing.assert_allclose(screen(page), before, atol=0.1)


@pytest.mark.parametrize("viewport", [SMALL, NARROW], ids=["wide", "narrow"])
def test_it_opens_with_a_machine_that_fills_a_third_of_the_picture(visit, up, viewport):
    page = visit(up, setting={"viewport": viewport})
    assert page.get_by_role("button", name="Follow").get_attribute("aria-pressed") == "true"
    page.evaluate("flypend.seek(0)")  # a lean of 37°, across the line of sight
    size = page.locator(".picture").bounding_box()
    pivot, bob = screen(page)
    seen = np.linalg.norm(bob - pivot)  # with bob and rotors it is a fifth longer; foreshortened by 17° of elevation
    assert 0.25 < seen / min(size["width"], size["height"]) < 0.5


def test_the_rod_is_seen_in_hover(visit, up):
    """The sum of the thrusts points along the rod; drawn solid, it would hide two thirds of it."""
    page = visit(up, drawn=True)
    page.evaluate("flypend.camera('side'), flypend.seek(2)")
    pivot, bob = screen(page)
    seen = picture(page)
    for share in (0.3, 0.45, 0.6):
        x, y = (pivot + share * (bob - pivot)).astype(int)
        around = seen[y - 2 : y + 3, x - 2 : x + 3].reshape(-1, 3)
        red, green, _ = around[np.argmax(around[:, 0] - around[:, 1])]
        assert red > green + 60, share


def test_whoever_wants_little_motion_gets_no_glide(visit, up):
    page = visit(up, setting={"reduced_motion": "reduce"})
    page.evaluate("flypend.camera('overview')")
    first = page.evaluate("flypend.screen(0)")
    page.evaluate("flypend.camera('axis')")
    np.testing.assert_array_equal(page.evaluate("flypend.screen(0).bob"), page.evaluate("flypend.screen(0).bob"))
    assert page.evaluate("flypend.screen(0)") != first
    page = visit(up)  # negative control: otherwise it glides
    page.evaluate("flypend.camera('overview')")
    screen(page)
    page.evaluate("flypend.camera('axis')")
    assert page.evaluate("flypend.screen(0).bob") != page.evaluate("flypend.screen(0).bob")


# Two runs ------------------------------------------------------------------------------------------------------------


def test_a_ghost_shows(visit, up, lqr):
    pages = [visit(up, drawn=True), visit(up, ghost=lqr, drawn=True)]
    for page in pages:
        page.evaluate("flypend.camera('follow'), flypend.seek(0.1)")
        screen(page)
    pivot, bob = screen(pages[1], 1)
    alone, both = (picture(page) for page in pages)
    for place in (pivot, bob):
        x, y = place.astype(int)
        part = np.s_[y - 12 : y + 12, x - 12 : x + 12]
        assert np.abs(alone[part] - both[part]).max() > 40
    np.testing.assert_allclose(pose(pages[1], 0.1, 1)["y"], lqr.y[10], atol=1e-5)
    names = pages[1].locator(".legend strong").all_inner_texts()
    assert names == ["inverted law", "lqr law"]
    assert pages[0].locator(".legend .only strong").is_hidden()


def test_side_by_side_each_has_its_picture(visit, up, lqr):
    page = visit(up, ghost=lqr)
    page.get_by_role("button", name="Side by side").click()
    page.evaluate("flypend.camera('side'), flypend.seek(0.4)")
    width = page.locator(".picture").bounding_box()["width"]
    for i in (0, 1):
        assert screen(page, i)[0][0] == pytest.approx((i + 0.5) * width / 2, abs=0.5)
    captions = page.locator(".motion").all_inner_texts()
    assert [caption.split(":")[0] for caption in captions] == ["inverted law", "lqr law"]
    page.keyboard.press("g")
    assert page.get_by_role("button", name="Overlay").get_attribute("aria-pressed") == "true"
    screen(page)
    assert [view.is_visible() for view in page.locator(".motion").all()] == [True, False]


def test_two_runs_of_different_length_share_the_clock(visit, up, lqr):
    page = visit(lqr, ghost=up)
    assert page.evaluate("flypend.duration()") == 2
    np.testing.assert_allclose(pose(page, 2.0)["y"], lqr.y[-1], atol=1e-5)  # stays at its end
    np.testing.assert_allclose(pose(page, 2.0, 1)["y"], up.y[-1], atol=1e-5)


def test_runs_of_both_frames_fly_together(visit, down):
    page = visit(down, ghost=down.flipped())
    page.evaluate("flypend.seek(1.2)")
    np.testing.assert_allclose(screen(page, 0), screen(page, 1), atol=0.05)


def test_how_a_run_ended_is_said_when_it_has(visit, singular, down):
    page = visit(singular, ghost=down, layout="beside")
    end = singular.outcome.time
    said = page.locator(".ended").first
    screen(page)
    assert said.inner_text() == ""
    page.evaluate("t => flypend.seek(t)", end + 0.1)
    screen(page)
    assert said.inner_text() == f"singular after {end:.3g} s"
    np.testing.assert_allclose(pose(page, 1.0)["x"], singular.x[-1], atol=1e-5)


def test_other_runs_can_be_put_into_the_page(visit, up, lqr, down):
    page = visit(up, ghost=lqr, layout="beside")
    page.evaluate("flypend.camera('side'), flypend.seek(1.7)")
    page.locator(".line").focus()
    memory = {down: [], up: []}  # each has gains of its own to tell
    for run in [down, up] * 3:
        page.evaluate("run => flypend.load([run])", replay.pack(run, verdict(run)))
        assert page.evaluate("flypend.time()") == 1.7
        np.testing.assert_allclose(pose(page, 1.7)["y"], run.y[170], atol=1e-5)
        box = page.locator(".picture").bounding_box()
        np.testing.assert_allclose(screen(page)[0], [box["width"] / 2, box["height"] / 2], atol=0.6)
        memory[run].append(page.locator("main *").count())
    assert page.locator(".legend p").count() == page.locator(".view").count() == 1
    assert page.get_by_role("button", name="Side by side").is_hidden()
    assert all(len(set(counts)) == 1 for counts in memory.values())  # nothing is left behind
    assert page.evaluate("document.activeElement.className") == "line"
    page.evaluate("runs => flypend.load(runs)", [replay.pack(up, verdict(up)), replay.pack(lqr, verdict(lqr))])
    page.get_by_role("button", name="Side by side").click()
    page.evaluate("run => flypend.load([run])", replay.pack(lqr, verdict(lqr)))
    assert page.evaluate("[flypend.time(), flypend.duration()]") == [1.5, 1.5]
    told = page.locator(".values output").first.inner_text()
    assert float(told.replace("−", "-")) == pytest.approx(lqr.y[-1, 2], abs=0.00501)


# Everywhere ----------------------------------------------------------------------------------------------------------


def test_it_fits_a_narrow_screen_and_answers_fingers(visit, up, lqr):
    page = visit(up, ghost=lqr, setting={"viewport": NARROW, "has_touch": True, "device_scale_factor": 2})
    assert page.evaluate("document.documentElement.scrollWidth") <= NARROW["width"]
    for control in page.locator(":is(button, select, input, .picture, .plot):visible").all():
        box = control.bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= NARROW["width"]
        if control.evaluate("e => e.tagName") in ("BUTTON", "SELECT"):
            assert box["height"] >= 32
    page.get_by_role("button", name="Play").tap()
    until(page, "flypend.time() > 0")


def test_it_fits_a_wide_screen_without_scrolling(visit, up, lqr):
    page = visit(up, ghost=lqr, setting={"viewport": WIDE})
    size = page.evaluate("[document.documentElement.scrollWidth, document.documentElement.scrollHeight]")
    assert size == [WIDE["width"], WIDE["height"]]


def test_it_follows_the_theme_of_the_system(visit, up):
    brightness = []
    for scheme in ("light", "dark"):
        page = visit(up, drawn=True, setting={"color_scheme": scheme})
        seen = np.asarray(Image.open(BytesIO(page.screenshot())).convert("L"))
        brightness.append(np.median(seen))
    assert brightness[0] > 230
    assert brightness[1] < 60


def test_names_are_text(visit, up):
    evil = "</script><script>window.broken = 1</script><img src=x onerror='window.broken = 2'>"
    run = dataclasses.replace(up, law=evil, vehicle=up.vehicle.replace(name=evil))
    page = visit(run, ghost=run)
    assert page.title() == f"{evil} law on {evil}"
    assert page.locator("h1").inner_text() == f"{evil} law on {evil}"
    assert page.locator(".legend strong").first.inner_text() == f"{evil} law, 1"
    assert page.evaluate("window.broken") is None


def test_a_run_of_one_sample_opens(visit, down):
    names = ("t", "x", "x_dot", "R", "omega", "y", "y_dot", "thrust", "moment", "rotor_forces", "x_ref")
    first = {name: getattr(down, name)[:1] for name in names}
    first["signals"] = {name: values[:1] for name, values in down.signals.items()}
    run = dataclasses.replace(down, **first, outcome=fp.Outcome("singular", 0.0, "0/0"), interpolant=None)
    page = visit(run)
    page.evaluate("flypend.play()")
    assert not page.evaluate("flypend.playing()")
    np.testing.assert_allclose(pose(page, 0.0)["y"], down.y[0], atol=1e-6)
    assert np.all(np.isfinite(screen(page)))


def test_without_3d_graphics_the_plots_work(chromium, up, tmp_path):
    page = chromium.new_page()
    page.add_init_script("""const real = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
            return kind.startsWith("webgl") ? null : real.call(this, kind, ...rest);
        };""")
    up.to_html(tmp_path / "a.html")
    page.goto((tmp_path / "a.html").as_uri())
    assert "WebGL" in page.locator(".note").inner_text()
    np.testing.assert_allclose(pose(page, 1.0)["y"], up.y[100], atol=1e-5)
    assert page.locator(".values output").first.inner_text() != ""
    page.close()


def test_in_a_notebook_it_is_isolated(visit, up):
    page = visit(up, text=f"<!doctype html><title>notebook</title><p>cell</p>{up._repr_html_()}")
    frame = page.frames[1]
    until(frame, "window.flypend !== undefined")
    frame.evaluate("flypend.seek(1)")
    np.testing.assert_allclose(frame.evaluate("flypend.pose()")["y"], up.y[100], atol=1e-5)
    assert page.evaluate("window.flypend") is None
    assert page.title() == "notebook"


# Mounts ---------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def collided():
    vehicle = fp.vehicle("hehn2011").replace(mount="hub")
    down = np.array([0, -np.sin(2.5), np.cos(2.5)])
    start = fp.State(y=down, y_dot=geometry.project_tangent(down, np.array([0, 9.0, 0])))
    return fp.simulate(vehicle, fp.laws.lqr(), start, 2.0)


def test_a_touch_is_marked_on_the_time_line_and_named(visit, collided):
    assert collided.outcome.status == "collided"
    page = visit(collided)
    mark, line = page.locator(".track .touch"), page.locator(".line").bounding_box()
    assert collided.outcome.reason in mark.get_attribute("title")
    place = mark.bounding_box()
    assert place["x"] + place["width"] / 2 == pytest.approx(line["x"] + line["width"] - 8, abs=1.5)  # at its end
    page.evaluate("flypend.seek(99)")
    until(page, f"() => document.querySelector('.ended').textContent.includes('{collided.outcome.reason}')")
    assert collided.outcome.reason in page.locator(".legend .verdict").inner_text()
    assert page.title().endswith("hehn2011, hub")


def test_the_part_that_was_touched_is_seen(visit, collided):
    """It has the colour of alarm once the flight is over, and not before."""
    page = visit(collided, drawn=True)
    shown = {}
    for when, t in (("before", collided.t[-1] - 0.02), ("after", 99)):
        page.evaluate("t => { flypend.camera('axis'); flypend.seek(t); flypend.screen(); }", float(t))
        page.wait_for_timeout(600)
        picture = np.asarray(Image.open(BytesIO(page.locator(".picture").screenshot())).convert("RGB"), dtype=int)
        alarm = np.array([179, 38, 30])  # palette.ALARM
        shown[when] = int(np.sum(np.abs(picture - alarm).max(axis=-1) < 12))
    assert shown["after"] > shown["before"] + 40, shown


def test_clearance_is_plotted_where_there_is_something_to_touch(visit, collided, up):
    for run, count in ((collided, 5), (up, 4)):
        page = visit(run)
        assert page.locator(".plot").count() == count
    page = visit(collided)
    plot = page.locator(".plot").nth(4)
    assert plot.locator(".what").inner_text() == "Clearance of the rod (m)"
    i = len(collided.t) // 2
    page.evaluate("t => flypend.seek(t)", float(collided.t[i]))
    until(page, f"() => document.querySelectorAll('.plot output')[8].textContent === '{collided.clearance[i]:.2f}'")
