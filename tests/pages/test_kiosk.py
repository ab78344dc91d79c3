"""The page at an exhibition: touched, flung against the controller, and left alone; its address as a code; fingers."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

import flypend as fp
from tests.browser import opened, until
from tests.few import each_once

SIZE = {"width": 900, "height": 600}
PHONE = {"width": 390, "height": 844}
LEANING = fp.State(y=(0.3, 0, np.sqrt(0.91)))
ACTIVE = "button, select, input, a[href]"


@pytest.fixture(scope="module")
def run():
    return fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), LEANING, 4.0)


@pytest.fixture
def visit(offline, tmp_path, run):
    def open_(query="", *, live=True, **setting):
        return opened(offline, run, tmp_path, query, {"viewport": SIZE, "has_touch": True} | setting, live=live)

    return open_


def game(page, name):
    until(page, f"() => document.querySelector('main').dataset.game === '{name}'")


def finger(page):
    """Return a function that touches: a kind of event, and where."""
    session = page.context.new_cdp_session(page)

    def touch(kind, *places):
        points = [{"x": x, "y": y} for x, y in places]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    return touch


def test_a_kiosk_is_played_by_touch_and_goes_back_to_its_loop(visit):
    page = visit("?kiosk=4")
    touch = finger(page)
    assert page.locator(".game .rules").inner_text().startswith("Grab the ball and fling it. Score: ")
    assert not page.locator("footer").is_visible()
    assert not page.locator(".bar").is_visible()
    game(page, "idle")
    until(page, "() => flypend.playing()")
    touch("touchStart", (300, 300))
    touch("touchEnd")
    game(page, "ready")
    box = page.locator(".handle").bounding_box()
    assert min(box["width"], box["height"]) >= 44
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    touch("touchStart", (x, y))
    for step in range(1, 9):
        touch("touchMove", (x + 25 * step, y))
        page.wait_for_timeout(30)
    game(page, "held")
    assert "Let go" in page.locator(".headline").inner_text()
    touch("touchEnd")
    game(page, "watch")
    game(page, "ready")
    score = float(page.locator(".headline").inner_text().split()[2])
    last = page.evaluate("flypend.recoveries()")[-1]
    assert 0 < score <= last["time"] + 0.05  # it counts from when the ball left the hand
    assert page.locator(".best").inner_text() == f"Best so far: {score:.1f} s"
    game(page, "idle")
    until(page, "() => flypend.playing() && !flypend.live().on")
    assert page.locator(".best").inner_text() == f"Best so far: {score:.1f} s"


def test_a_ball_that_is_not_let_go_leaves_the_hand(visit):
    page = visit("?kiosk")
    touch = finger(page)
    touch("touchStart", (300, 300))
    touch("touchEnd")
    game(page, "ready")
    box = page.locator(".handle").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    touch("touchStart", (x, y))
    touch("touchMove", (x + 40, y))
    game(page, "held")
    game(page, "watch")
    assert not page.evaluate("flypend.live().pulled")
    touch("touchMove", (x + 80, y))
    assert not page.evaluate("flypend.live().pulled")


def test_a_button_makes_a_kiosk_and_a_laboratory_again(visit, axe):
    page = visit()
    page.locator(".open").click()
    page.locator("[data-keep=kiosk]").click()
    game(page, "idle")
    assert axe(page) == []
    page.locator(".leave").tap()
    until(page, "() => !document.querySelector('.game')")
    assert page.locator("footer").is_visible()


def test_the_address_is_a_code_that_a_phone_reads(visit, axe, node_modules):
    page = visit()
    page.locator(".open").click()
    page.locator("[data-keep=code]").click()
    assert "web server" in page.locator(".sheet p").inner_text()  # which a page from disk is not on
    assert axe(page) == []
    path = page.locator(".sheet path").get_attribute("d")
    size = page.evaluate("document.querySelector('.sheet svg').viewBox.baseVal.width")
    script = Path(__file__).with_name("code.mjs")
    given = json.dumps({"path": path, "size": size})
    read = subprocess.run(
        ["node", script, node_modules], input=given, check=True, capture_output=True, text=True
    ).stdout
    assert read == page.evaluate("location.href")
    page.locator(".sheet .close").click()
    page.locator(".sheet").wait_for(state="detached")  # a dialog tells of its end in a later task


@pytest.mark.parametrize(("viewport", "live"), each_once((PHONE, {"width": 1024, "height": 768}), (False, True)))
def test_a_finger_hits_every_control(visit, live, viewport):
    page = visit(live=live, viewport=viewport, is_mobile=True)
    if live:
        page.locator(".open").tap()
    small = page.evaluate(
        """(active) => [...document.querySelectorAll(active)]
        .filter((one) => one.checkVisibility({ visibilityProperty: true }))
        .map((one) => [one.className || one.dataset.keep || one.textContent, one.getBoundingClientRect()])
        .filter(([, { width, height }]) => width < 43.9 || height < 43.9)
        .map(([name, { width, height }]) => `${name}: ${width} x ${height}`)""",
        ACTIVE,
    )
    assert small == []


@pytest.mark.parametrize("live", [False, True])
def test_nothing_is_only_in_tooltips(visit, axe, live):
    page = visit(live=live)
    page.keyboard.press("?")
    said = page.locator(".sheet dl").inner_text()
    hints = page.evaluate("[...document.querySelectorAll('button[title]:not(.handle)')].map((one) => one.title)")
    assert len(hints) > 5
    assert [hint for hint in hints if hint and hint not in said] == []
    assert axe(page) == []
    page.keyboard.press("Escape")
    until(page, "() => !document.querySelector('.sheet')")
