"""What the scene shows besides the flight: floor, pole, mounts, and where a rod cannot start."""

import json
import re
from urllib.parse import quote

import numpy as np
import pytest

import flypend as fp
from benchmarks.frames import AT_REST
from flypend.flight.live import live_data
from flypend.geometry import unit
from tests.browser import opened, picture, until

LAW = fp.laws.inverted()
MACHINE = fp.vehicle("hehn2011")


@pytest.fixture
def visit(offline, tmp_path):
    def open_(run, address="", *, drawn=False, **options):
        page = opened(offline, run, tmp_path, address, {"drawn": drawn, "color_scheme": "light"}, **options)
        page.evaluate(AT_REST)
        return page

    return open_


def hovering(mount="gimbal"):
    return fp.simulate(MACHINE.replace(mount=mount), LAW, fp.State(y=(0, 0, 1)), 0.5)


def test_the_floor_stays_where_it_is_while_a_live_flight_falls(visit):
    run = fp.simulate(MACHINE, fp.laws.corrected(), fp.State(y=(0, 0, 1)), 0.2, plant="ideal")
    page = visit(run, live=True)
    page.evaluate("flypend.go(true)")
    until(page, "() => flypend.live().tick > 100")
    before = page.evaluate("flypend.floor()")
    start = page.evaluate("flypend.pose().x")[2]
    until(page, "() => flypend.pose().x[2] > 3 || flypend.live().over")  # e₃ is along gravity
    assert page.evaluate("flypend.pose().x")[2] > start
    assert page.evaluate("flypend.floor()") == before


def test_the_floor_is_drawn_where_the_world_has_one(visit):
    run = fp.simulate(MACHINE, LAW, fp.State(y=(0, 0, 1)), 0.5, plant=fp.Plant(floor=-1.25))
    assert visit(run).evaluate("flypend.floor()") == -1.25
    assert visit(hovering()).evaluate("flypend.floor()") != -1.25


def test_the_pole_tells_the_height_of_the_machine(visit):
    """The pivot hovers at the height of the start, so the mark of 0 m is level with it, but for the perspective."""
    page = visit(hovering())
    page.evaluate("flypend.camera('side')")
    page.wait_for_timeout(1500)
    place = page.evaluate("flypend.screen(0)")["pivot"]
    top = page.locator(".picture").bounding_box()["y"]
    marks = {mark.inner_text(): mark.bounding_box() for mark in page.locator(".height:visible").all()}
    assert list(marks) == sorted(marks, key=lambda words: float(words.removesuffix(" m").replace("−", "-")))
    zero = marks["0 m"]
    assert zero["y"] + zero["height"] / 2 - top == pytest.approx(place[1], abs=60)
    assert zero["y"] > marks["0.5 m"]["y"]


def test_a_height_stands_beside_the_pole_away_from_the_machine(visit):
    """To the left of a pole that is left of the machine: the word then hides none of it."""
    page, sides = visit(hovering()), set()
    for drag in (0, 250, 250, 250):
        page.mouse.move(450, 250)
        page.mouse.down()
        page.mouse.move(450 + drag, 250, steps=3)
        page.mouse.up()
        page.wait_for_timeout(800)
        machine, picture = page.evaluate("flypend.screen(0)")["pivot"][0], page.locator(".picture").bounding_box()["x"]
        for mark in page.locator(".height:visible").all():
            pole, box = float(re.search(r"[\d.]+", mark.evaluate("one => one.style.transform"))[0]), mark.bounding_box()
            before = box["x"] + box["width"] - picture < pole
            assert before == (70 < pole < machine)  # 70 pixels: at the edge it stands where there is room
            sides.add(before)
    assert sides == {True, False}


def test_heights_are_told_apart_and_not_over_the_sphere_of_directions(visit):
    """After a fall of over 100 m, where three digits were not enough."""
    law, machine = fp.laws.corrected(), fp.vehicle("nayak2018")
    page = visit(fp.simulate(machine, law, fp.State(y=(0.1, 0, np.sqrt(0.99))).in_frame(law.e3), 6.5, plant="ideal"))
    page.evaluate("flypend.pause(), flypend.seek(6.5)")
    page.wait_for_timeout(300)
    told = [mark.inner_text() for mark in page.locator(".height:visible").all()]
    assert len(told) >= 3
    assert len(set(told)) == len(told)
    assert all(float(word.split()[0].replace("−", "-")) < -100 for word in told)
    page.keyboard.press("s")
    until(page, f"() => document.querySelectorAll('.height:not([hidden])').length < {len(told)}")
    assert covered(page) == []


def covered(page):
    """Heights of the pole that lie below other words, with those words."""
    return page.evaluate(
        """() => {
          const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
          const seen = (named) => [...document.querySelectorAll(named)]
            .map((one) => [one.textContent, one.getBoundingClientRect()]).filter(([, box]) => box.width);
          const words = seen(".said, .key, .globe, figcaption");
          const below = ([height, a]) => words.filter(([, b]) => meet(a, b)).map(([word]) => [height, word]);
          return seen(".height").flatMap(below);
        }"""
    )


def test_no_height_is_half_below_other_words(visit):
    """Whatever the camera follows, and on a phone, where the words take more lines."""
    hanging = fp.State(y=(0, 0, -1))
    page, told = visit(fp.simulate(MACHINE.replace(mount="hub"), LAW, hanging, 2.6)), set()
    for width in (390, 768):
        page.set_viewport_size({"width": width, "height": 1000})
        for t in np.arange(1.4, 2.6, 0.3):
            page.evaluate(f"flypend.seek({t})")
            page.wait_for_timeout(700)
            assert covered(page) == []
            told |= set(page.locator(".height:visible").all_inner_texts())
    assert {"0 m", "−0.5 m"} <= told


def test_a_hub_looks_different_from_a_gimbal(visit):
    hub, gimbal = (picture(visit(hovering(mount), drawn=True)) for mount in ("hub", "gimbal"))
    assert np.mean(np.any(np.abs(hub - gimbal) > 30, axis=-1)) > 0.005


def test_forbidden_starts_are_shaded_and_a_rod_in_one_is_freed(visit):
    run = hovering("hub")
    rotor = run.vehicle.rotors_from_pivot[0]
    first = live_data(run.flight)["offer"]["first"]
    blocked = first | {"start": first["start"] | {"y": unit(rotor).tolist()}}
    page = visit(run, "#" + quote(json.dumps(blocked)), live=True, drawn=True)
    assert page.evaluate("flypend.verdict().state") == "failed"
    assert page.evaluate("flypend.verdict().words").startswith("collided at the start, the rod touched ")
    notice = page.locator(".notice")
    assert "at the start" in notice.inner_text()
    assert page.locator(".motion b").first.inner_text() == "collided"

    def reddish():
        red, green, blue = np.moveaxis(picture(page), -1, 0)
        return np.sum((red - green > 25) & (red - green < 110) & (np.abs(green - blue) < 14))

    until(page, "() => flypend.frames().count > 1")
    page.wait_for_timeout(500)
    shaded = reddish()
    page.get_by_role("button", name="Move to a free start").click()
    until(page, "() => flypend.setting().start.y[0] < 0.999 && flypend.shown() === flypend.number()")
    freed = page.evaluate("flypend.setting().start.y")
    assert 0.5 < np.dot(freed, unit(rotor)) < 1  # nearby
    assert notice.is_hidden()
    page.evaluate("flypend.seek(0.3)")
    page.wait_for_timeout(300)
    assert shaded > 4 * reddish() + 500


def test_the_pass_between_the_arms_is_seen_from_near_by_with_its_clearance(visit):
    run = fp.simulate(MACHINE.replace(mount="hub"), LAW, fp.State(y=(0, 0, -1)), 3.0)
    least = run.t[np.argmin(run.clearance)]
    page = visit(run, drawn=True)
    near = page.locator(".near")
    assert near.is_hidden()
    page.evaluate(f"flypend.seek({least})")
    until(page, "() => !document.querySelector('.near').hidden")
    assert float(near.inner_text().removesuffix(" mm gap")) == pytest.approx(1e3 * run.clearance.min(), abs=0.6)
    shown, frame = picture(page), near.bounding_box()
    area = page.locator(".picture").bounding_box()
    left, top, side = (int(value) for value in (frame["x"] - area["x"], frame["y"] - area["y"], frame["width"]))
    red, _, blue = np.moveaxis(shown[top : top + side, left : left + side], -1, 0)
    assert np.mean(red - blue > 60) > 0.04  # the rod
    assert np.mean(red + blue < 200) > 0.1  # hub and arms
    page.evaluate("flypend.seek(2.9)")
    until(page, "() => document.querySelector('.near').hidden")


def test_a_gimbal_has_no_arms_to_pass(visit):
    page = visit(fp.simulate(MACHINE, LAW, fp.State(y=(0, 0, -1)), 1.5))
    page.evaluate("flypend.seek(1)")
    until(page, "() => flypend.time() === 1")
    assert page.locator(".near").is_hidden()


def test_a_graphics_card_lights_the_machine_by_a_room(chromium, tmp_path):
    """Software takes seconds to prepare the room's light, so it goes without; here it passes for a card."""
    hovering("hub").to_html(tmp_path / "page.html")
    pictures = []
    for name in ("SwiftShader", "GPU"):
        context = chromium.new_context(viewport={"width": 480, "height": 360}, color_scheme="light", offline=True)
        context.add_init_script(
            "const told = WebGL2RenderingContext.prototype.getParameter;"
            f"WebGL2RenderingContext.prototype.getParameter = function (name) {{ return name === 0x9246 ? '{name}' :"
            " told.call(this, name); }"  # UNMASKED_RENDERER_WEBGL
        )
        page, said = context.new_page(), []
        page.on("pageerror", lambda error, said=said: said.append(str(error)))
        page.goto((tmp_path / "page.html").as_uri())
        until(page, "() => window.flypend && flypend.frames().count > 0")
        page.evaluate(AT_REST)
        pictures.append(picture(page))
        assert said == []
        context.close()
    assert np.mean(np.any(np.abs(pictures[0] - pictures[1]) > 8, axis=-1)) > 0.001  # of which the machine is a fiftieth
