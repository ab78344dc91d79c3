"""The laboratory in a real browser without a screen: sliders, rod, pokes, presets, reload, tabs, map, export."""

import json
import re
import tomllib
from urllib.parse import quote

import numpy as np
import pytest
from playwright.sync_api import expect
from test_lab import Lab

from benchmarks.frames import AT_REST
from flypend.flight.simulate import fly as fly_request
from flypend.lab.answers import engine_of
from flypend.lab.controls import offer, sliders
from flypend.lab.flying import fly
from flypend.lab.setting import setting_of
from flypend.laws import inverted
from flypend.model import vehicle
from flypend.settings.runfile import run_file
from tests.browser import shown, until

OFFER = offer()
WIDE, NARROW = {"width": 1000, "height": 620}, {"width": 390, "height": 844}


@pytest.fixture(scope="module")
def server():
    server = Lab()
    yield server
    assert server.stop() == (0, "")


@pytest.fixture
def visit(offline, server):
    """Open the laboratory; at the end nothing complained and nothing was asked of anyone else."""

    def open_(hash_="", *, drawn=False, **setting):
        setting = {"offline": False, "viewport": WIDE, "color_scheme": "light"} | setting
        page = offline(server.url + hash_, drawn=drawn, **setting)
        shown(page)
        page.evaluate(AT_REST)
        return page

    return open_


def setting(page):
    return page.evaluate("flypend.setting()")


def expect_flight(page):
    """What is shown is the flight of the setting."""
    run = fly(setting_of(setting(page)))
    assert page.evaluate("flypend.duration()") == pytest.approx(run.t[-1], abs=1e-6)
    kept = page.evaluate("flypend.time()")
    for i in (0, len(run.t) // 3, len(run.t) - 1):
        page.evaluate("t => flypend.seek(t)", float(run.t[i]))
        pose = page.evaluate("flypend.pose(0)")
        np.testing.assert_allclose(pose["y"], run.y[i], atol=2e-5)
        np.testing.assert_allclose(pose["x"], run.x[i], atol=2e-5 * max(1, np.abs(run.x).max()))
    page.evaluate("t => flypend.seek(t)", kept)
    return run


def slider(page, path):
    return page.locator(f"[data-path='{path}'] input")


def test_it_opens_with_a_flight_and_its_verdict(visit):
    page = visit(drawn=True)
    run = expect_flight(page)
    assert run.law == "inverted"
    assert page.locator("header > .verdict").inner_text() == page.evaluate("flypend.verdict().words")
    assert page.locator("header > .verdict").inner_text().startswith("upright after")
    assert page.locator(".plot").count() == 4
    assert page.locator(".busy").is_hidden()


def test_a_slider_flies_anew_by_pointer_and_by_key(visit):
    page = visit()
    control = slider(page, "law.gains.throw_speed")
    control.scroll_into_view_if_needed()
    box = control.bounding_box()
    before = page.evaluate("flypend.seek(1.5), flypend.pose(0).x")
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.7 * box["width"], box["y"] + box["height"] / 2, steps=6)
    shown(page)
    page.mouse.up()
    wanted = setting(page)["law"]["gains"]["throw_speed"]
    usual = inverted().bind(vehicle("hehn2011")).gains["throw_speed"]
    assert 1.4 * usual < wanted < 2.2 * usual  # 0.7 of a range from a quarter to four times it, in logarithms
    assert np.abs(np.array(page.evaluate("flypend.pose(0).x")) - before).max() > 0.05
    assert page.evaluate("flypend.time()") == 1.5  # the clock stays
    control.focus()
    page.keyboard.press("ArrowRight")
    shown(page)
    assert wanted < setting(page)["law"]["gains"]["throw_speed"] < 1.05 * wanted
    expect_flight(page)
    page.locator(".has-gains .reset").click()
    shown(page)
    assert setting(page)["law"]["gains"] == {}


def able(page):
    """Wait until the page has machine code for its setting."""
    until(page, "() => !document.querySelector('.go').disabled")


def flies_here(page, control, value):
    """Move a slider: the page flies it itself, and the server confirms it afterwards, however slow the machine is."""
    before = page.evaluate("flypend.timings().length")
    control.fill(value)
    until(page, "before => flypend.timings().length > before", before)  # which are kept with the next frame
    assert page.evaluate("flypend.timings().at(-1).here")
    shown(page)


def test_the_page_flies_by_itself_what_the_server_then_confirms(visit):
    page = visit()
    able(page)
    control = slider(page, "law.gains.rod_damping")
    control.fill("214")
    until(page, "() => flypend.timings().some(({ here }) => here)")
    expect_flight(page)
    shown(page)
    expect_flight(page)
    last = page.evaluate("flypend.timings()[flypend.timings().length - 1]")
    assert last["here"]  # what the server confirms is not drawn again
    slider(page, "plant.delay").fill("40")
    shown(page)
    expect_flight(page)


def test_gains_from_which_a_law_computes_others_are_for_the_server(visit):
    page = visit()
    able(page)
    page.locator("select[data-path='law.name']").select_option("lqr")
    shown(page)
    able(page)
    page.locator(".starts").select_option("leaning")
    until(page, "() => flypend.timings().at(-1).here")
    shown(page)
    expect_flight(page)
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 20")
    page.locator(".has-gains input").first.fill("600")  # what goes on cannot follow
    shown(page)
    assert not page.evaluate("flypend.live().on")
    until(page, "() => document.querySelector('.go').disabled")
    expect_flight(page)
    page.locator(".has-gains .reset").click()
    shown(page)
    able(page)


@pytest.mark.parametrize(
    "plant", [{"rate": 100}, {"limits": False}, {"delay": 0.18}, {"wind": {"knock_on_bob": 0.03, "knock_period": 1.0}}]
)
def test_numbers_of_a_plant_that_its_machine_code_does_not_take_are_for_the_server(visit, plant):
    page = visit()
    able(page)
    told = setting(page) | {"plant": {"base": "rotors", **plant}}
    page.evaluate("hash => { location.hash = hash; }", quote(json.dumps(told)))
    until(page, "() => document.querySelector('.go').disabled")
    shown(page)
    slider(page, "law.gains.rod_damping").fill("214")
    shown(page)
    assert not page.evaluate("flypend.timings().at(-1).here")
    expect_flight(page)


def test_a_start_that_is_not_told_in_full_is_completed(visit):
    """Which leans: where the rod stands at once, the page flies on by itself."""
    page = visit("#" + json.dumps(setting_for_map() | {"start": {"y": [0.1, 0, 0.995]}}))
    assert set(setting(page)["start"]) == {"x", "x_dot", "R", "omega", "y", "y_dot"}
    able(page)
    flies_here(page, slider(page, "duration"), "5")
    expect_flight(page)


def test_the_ideal_plant_is_flown_by_the_page(visit):
    """Preview, confirmation, pokes between two samples, and a flight that goes on."""
    page = visit()
    page.locator("select[data-path='plant.base']").select_option("ideal")
    shown(page)
    able(page)
    flies_here(page, slider(page, "law.gains.rod_bandwidth"), "220")
    expect_flight(page)
    page.evaluate("flypend.seek(1.2345)")
    page.locator("[data-on=bob]").click()
    shown(page)
    page.evaluate("flypend.pause()")
    assert len(setting(page)["pokes"]) == 1
    expect_flight(page)
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 700")
    page.evaluate("flypend.pull([0.5, 0, 1])")
    until(page, "() => flypend.live().pulled")
    page.evaluate("flypend.pull(null)")
    page.locator(".go").click()
    shown(page)
    expect_flight(page)


def test_a_flight_goes_on_in_the_laboratory(visit):
    page = visit()
    able(page)
    page.evaluate("flypend.seek(6)")
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 3020")
    page.locator("[data-on=bob]").click()
    until(page, "() => flypend.live().poked === 1")
    assert setting(page)["pokes"] == []
    page.locator("select[data-path='plant.base']").select_option("ideal")  # another machine code
    shown(page)
    assert not page.evaluate("flypend.live().on")
    expect_flight(page)


def test_what_is_reset_or_taken_back_in_a_live_flight_is_shown_as_it_flies(visit):
    """The sliders stand where they do once the server has flown the setting."""
    plant = {"base": "rotors", "lag": 0.08, "wind": {"on_vehicle": [1.0, 0, 0]}}
    law = {"name": "inverted", "gains": {"rod_damping": 1.5}}
    page = visit("#" + json.dumps(OFFER["first"] | {"law": law, "plant": plant}))
    able(page)
    places = "() => [...document.querySelectorAll('.panel .slider output')].map((output) => output.textContent)"
    first = page.evaluate(places)
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 20")
    page.locator(".has-gains .reset").click()
    page.locator(".has-plant .reset").click()
    assert page.evaluate("flypend.live().on")
    live = page.evaluate(places)
    page.locator(".go").click()
    shown(page)
    assert live == page.evaluate(places) != first
    page.keyboard.press("Control+z")
    shown(page)
    able(page)
    page.locator(".go").click()
    until(page, "() => flypend.live().on")
    page.keyboard.press("Control+z")
    assert page.evaluate(places) == first


def test_a_flight_goes_on_when_the_connection_is_back(visit):
    """With the machine code that the page has: it asks for no other, and no worker is left behind."""
    page = visit()
    able(page)
    page.evaluate("""() => {
        const { send } = WebSocket.prototype;
        WebSocket.prototype.send = function (text) {
            window.socket = this;
            window.asked?.push(JSON.parse(text).kind);
            send.call(this, text);
        };
    }""")
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 20")
    page.evaluate("window.asked = [], socket.close()")
    until(page, "() => asked.length > 0")
    page.wait_for_timeout(100)  # all is asked at once
    assert page.evaluate("asked") == ["fly"]
    tick = page.evaluate("flypend.live().tick")
    until(page, "tick => flypend.live().tick > tick + 100", tick)
    assert len(page.workers) == 1


@pytest.mark.slow  # test_lab.py flies that law, test_live_page.py its page, and the tests above poke others
def test_the_learned_law_is_flown_poked_and_goes_on(visit):
    """Its network takes longer to compile than any other law: what is compiled here is at hand for the server."""
    learned = OFFER["first"] | {"law": {"name": "learned", "gains": {}}, "duration": 8}
    usual = setting_of(learned)
    fly(usual)
    engine_of(usual)
    fly(setting_of(learned | {"pokes": [{"time": 1.2, "on": "bob", "velocity": [1, 0, 0]}]}))
    page = visit("#" + json.dumps(OFFER["first"] | {"duration": 8}))
    page.locator("select[data-path='law.name']").select_option("learned")
    shown(page)
    assert expect_flight(page).law == "learned"
    assert page.locator("header > .verdict").inner_text().startswith("upright after")
    assert page.locator(".has-gains").is_hidden()  # its weights are no gains
    page.evaluate("flypend.seek(1.2)")
    page.locator("[data-on=bob]").click()
    shown(page)
    page.evaluate("flypend.pause()")
    assert expect_flight(page).t[-1] == pytest.approx(9.2)
    able(page)
    slider(page, "plant.lag").fill("100")
    shown(page)
    expect_flight(page)
    page.evaluate("flypend.seek(9.2)")
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 3700")
    assert page.evaluate("flypend.pose(0).y[2]") > 0.99


def test_the_rod_is_dragged_over_its_sphere(visit):
    page = visit()
    handle = page.locator(".handle")
    place = handle.bounding_box()
    x, y = place["x"] + place["width"] / 2, place["y"] + place["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 12, y - 6, steps=3)
    shown(page)
    bob = page.evaluate("flypend.screen(0).bob")
    page.mouse.up()
    rod = np.array(setting(page)["start"]["y"])
    assert np.linalg.norm(rod) == pytest.approx(1)
    assert -0.999 < rod[2] < -0.3
    scene = page.locator(".picture").bounding_box()
    assert np.hypot(scene["x"] + bob[0] - x - 12, scene["y"] + bob[1] - y + 6) < 1.5  # under the hand
    np.testing.assert_allclose(expect_flight(page).y[0], rod, atol=1e-12)
    handle.wait_for()  # it shows at the start alone, and other times have just been looked at
    handle.focus()
    page.keyboard.press("ArrowUp")
    shown(page)
    assert setting(page)["start"]["y"] != rod.tolist()
    page.evaluate("flypend.seek(1)")
    until(page, "document.querySelector('.handle').hidden")  # there is no start to drag in mid-flight


def test_a_poke_in_flight_keeps_the_past(visit):
    page = visit()
    page.evaluate("flypend.seek(1.2)")
    past = page.evaluate("(flypend.seek(0.8), flypend.pose(0).x)")
    page.evaluate("flypend.seek(1.2)")
    page.locator("[data-on=bob]").click()
    shown(page)
    page.evaluate("flypend.pause()")
    [poke] = setting(page)["pokes"]
    assert (poke["time"], poke["on"]) == (1.2, "bob")
    assert np.linalg.norm(poke["velocity"]) == pytest.approx(1)
    run = expect_flight(page)
    assert run.t[-1] == pytest.approx(7.2)
    np.testing.assert_allclose(page.evaluate("(flypend.seek(0.8), flypend.pose(0).x)"), past, atol=1e-6)
    page.evaluate("flypend.seek(0.5)")
    page.locator("[data-on=vehicle]").click()  # earlier: the later poke belongs to a flight that is no more
    shown(page)
    assert [(poke["time"], poke["on"]) for poke in setting(page)["pokes"]] == [(0.5, "vehicle")]
    page.locator(".unpoke").click()
    shown(page)
    assert page.evaluate("flypend.duration()") == 6


def test_the_story_is_told_chapter_by_chapter(visit):
    page = visit(reduced_motion="reduce")
    expect(page.locator(".step")).to_be_hidden()
    for i, step in enumerate(OFFER["story"]):
        page.locator(".story .chips button" if i == 0 else ".step .next").first.click()
        shown(page)
        assert page.locator(".step h3").inner_text() == step["title"]
        assert page.locator(".story [aria-pressed=true]").inner_text() == str(i + 1)
        assert setting(page) == step["setting"]
        assert page.locator(".drag .slider").get_attribute("data-path") == step["drag"]
        assert expect_flight(page).law == step["setting"]["law"]["name"]
        assert page.evaluate("flypend.playing()") is False  # whoever wants little motion plays it himself
        begun = [phase["from"] for phase in page.evaluate("flypend.phases()") if phase["name"] == step["phase"]]
        assert page.evaluate("flypend.time()") == pytest.approx(max(begun[0] - 0.15, 0) if begun else 0, abs=1e-6)
    expect(page.locator(".step .next")).to_be_hidden()
    page.locator(".drag input").fill("400")  # the end of the slider
    shown(page)
    assert not page.evaluate("flypend.verdict().good")
    expect(page.locator(".step")).to_be_visible()
    page.locator("select[data-path='law.name']").select_option("lqr")
    shown(page)
    expect(page.locator(".step")).to_be_hidden()


def test_a_chapter_plays_and_its_slider_flies(visit):
    page = visit()
    page.get_by_role("button", name="Chapter 4").click()
    shown(page)
    until(page, "() => flypend.playing() && flypend.time() > 0.1")
    assert page.locator(".speed select").input_value() == "0.25"
    page.locator(".drag input").fill("380")
    shown(page)
    page.evaluate("flypend.pause()")
    assert setting(page)["law"]["gains"]["throw_speed"] > 2
    assert expect_flight(page).law == "inverted"


def test_presets_random_laws_and_plants(visit):
    page = visit()
    page.get_by_role("button", name="4", exact=True).click()
    shown(page)
    run = expect_flight(page)
    assert (run.law, run.e3, run.vehicle.name) == ("corrected", "down", "nayak2018")
    assert run.y[0].tolist() == pytest.approx([0, 0, -1])
    page.locator(".starts").select_option("random")
    shown(page)
    start = setting(page)["start"]
    assert "random" not in start  # it came back in numbers
    expect_flight(page)
    page.locator("select[data-path='law.name']").select_option("lqr")
    shown(page)
    assert setting(page)["start"] == start
    assert slider(page, "law.gains.rod_error").count() == 1
    assert slider(page, "plant.lag").count() == 0
    page.locator("select[data-path='plant.base']").select_option("rotors")
    shown(page)
    noise = slider(page, "plant.noise")
    noise.focus()
    page.keyboard.press("ArrowRight")
    shown(page)
    assert setting(page)["plant"]["noise"]["x"] > 0
    expect_flight(page)


def test_sensors_are_chosen_flown_by_the_page_and_confirmed(visit):
    page = visit()
    able(page)
    choice = page.locator("select[data-path='plant.sensors']")
    assert choice.input_value() == "perfect"
    slider(page, "plant.noise").fill("40")
    choice.select_option("mocap")
    shown(page)
    assert setting(page)["plant"] == {"base": "rotors", "sensors": "mocap"}  # which have noise of their own
    assert slider(page, "plant.noise").count() == 0
    run = expect_flight(page)
    assert run.x[-1] != pytest.approx(np.zeros(3), abs=1e-6)  # noise keeps it moving
    able(page)
    slider(page, "law.gains.throw_speed").fill("210")
    until(page, "() => flypend.timings().some(({ here }) => here)")
    expect_flight(page)  # by the page
    shown(page)
    expect_flight(page)  # by the server
    slider(page, "plant.delay").fill("20")  # the estimator is told, so the server flies it
    shown(page)
    expect_flight(page)
    page.locator("select[data-path='plant.base']").select_option("ideal")
    shown(page)
    assert choice.is_disabled()
    expect_flight(page)
    page.locator("select[data-path='plant.base']").select_option("rotors")
    choice.select_option("perfect")
    shown(page)
    assert setting(page)["plant"] == {"base": "rotors"}
    expect_flight(page)


def test_a_defect_of_the_sensors_is_turned_up_until_the_vehicle_falls(visit, axe):
    page = visit()
    page.locator("select[data-path='plant.sensors']").select_option("mocap")
    shown(page)
    able(page)
    bias, told = slider(page, "plant.defects.accelerometer_bias"), page.locator(".fell")
    assert bias.get_attribute("aria-valuetext") == "0 m/s²"
    bias.focus()
    page.keyboard.press("ArrowRight")
    until(page, "() => flypend.timings().at(-1).here")
    assert setting(page)["plant"] == {"base": "rotors", "sensors": "mocap", "defects": {"accelerometer_bias": 0.025}}
    expect_flight(page)  # by the page
    shown(page)
    expect_flight(page)  # by the server
    assert told.text_content() == ""
    slider(page, "plant.defects.frame_turned").fill("20")
    page.evaluate("flypend.seek(6)")
    page.locator(".go").click()
    until(page, "() => flypend.verdict().words === 'live: upright'")
    bias.fill("400")
    until(page, "() => document.querySelector('.fell').textContent.startsWith('Fell after')")
    assert re.fullmatch(
        r"Fell after \d+\.\d s at accelerometer bias 10 m/s², cameras' frame turned 1 °\.", told.text_content()
    )
    shown(page)  # what the server confirms late changes neither line nor slider
    assert (told.text_content().startswith("Fell after"), bias.input_value()) == (True, "400")
    assert [one for one in axe(page) if one[0] != "color-contrast"] == []
    page.locator(".has-defects .reset").click()
    assert setting(page)["plant"] == {"base": "rotors", "sensors": "mocap"}
    assert bias.input_value() == "0"
    page.locator(".go").click()
    shown(page)
    bias.fill("400")
    until(page, "() => document.querySelector('.fell').textContent === 'Fails at accelerometer bias 10 m/s².'")
    page.locator("select[data-path='plant.sensors']").select_option("perfect")
    shown(page)
    assert setting(page)["plant"] == {"base": "rotors"}
    assert page.locator(".has-defects").is_hidden()


def test_a_reload_keeps_the_setting_and_another_page_is_not_disturbed(visit):
    first, second = visit(), visit()
    slider(first, "law.gains.rod_bandwidth").fill("230")
    first.locator(".starts").select_option("level")
    slider(second, "duration").fill("100")
    shown(first)
    shown(second)
    kept, other = setting(first), setting(second)
    assert kept["start"]["y"] == [1, 0, 0]
    assert "rod_bandwidth" not in other["law"]["gains"]
    assert other["duration"] == pytest.approx(9)
    first.reload()
    shown(first)
    assert setting(first) == kept
    expect_flight(first)
    expect_flight(second)
    third = visit(first.url[first.url.index("#") :])  # the address is the setting
    assert setting(third) == kept


def test_200_rapid_moves_end_with_the_last(visit, server):
    page = visit()
    page.evaluate("""() => {
        const control = document.querySelector("[data-path='law.gains.throw_speed'] input");
        for (let i = 0; i < 200; i++) {
            control.value = 100 + i;
            control.dispatchEvent(new Event("input", { bubbles: true }));
        }
    }""")
    shown(page)
    assert page.evaluate("flypend.number()") >= 201
    expect_flight(page)
    assert slider(page, "law.gains.throw_speed").input_value() == "299"
    assert server.calm()  # nothing is left


def test_the_map_fills_and_a_point_of_it_flies(visit):
    page = visit("#" + json.dumps(setting_for_map()))
    page.get_by_role("button", name="Region of attraction").click()
    until(page, "flypend.map().done > 0")
    early = page.evaluate("flypend.map()")
    until(page, "flypend.map().done === flypend.map().total && flypend.map().total > 0")
    last = page.evaluate("flypend.map()")
    assert early["done"] < early["total"] == last["done"]
    assert 0 < last["good"] < last["total"]
    until(page, f"document.querySelector('.share').innerText.includes('{last['total']} directions')")
    box = page.locator(".disc canvas").bounding_box()
    page.mouse.click(box["x"] + box["width"] / 2 + 6, box["y"] + box["height"] / 2)
    shown(page)
    y = setting(page)["start"]["y"]
    assert y[0] > 0.01
    assert abs(y[1]) < 0.01
    assert y[2] > 0.99
    assert page.locator(".map").is_hidden()
    assert page.evaluate("flypend.verdict().good")


@pytest.mark.parametrize("chapter", [2, 7])  # e₃ down and up
def test_the_map_shows_the_way_of_the_rod_against_gravity(visit, chapter):
    page = visit(reduced_motion="reduce")
    page.get_by_role("button", name=f"Chapter {chapter}").click()
    shown(page)
    run = fly(setting_of(setting(page)))
    way = np.array(page.evaluate("flypend.map().path"))
    for mine, end in zip((way[0], way[-1]), (run.y[0], run.y[-1]), strict=True):
        upright = end if run.e3 == "up" else end * [1, -1, -1]
        np.testing.assert_allclose(mine, upright, atol=2e-5)


def test_a_map_keeps_its_points_when_the_connection_is_back(visit):
    """It is asked for again, from its first direction; each is counted once."""
    page = visit("#" + json.dumps(setting_for_map()))
    page.evaluate("""() => {
        const { send } = WebSocket.prototype;
        window.told = 0;
        WebSocket.prototype.send = function (text) {
            if (window.socket !== this) this.addEventListener("message", ({ data }) => told += data.includes('"map"'));
            window.socket = this;
            send.call(this, text);
        };
    }""")
    page.get_by_role("button", name="Region of attraction").click()
    until(page, "() => told > 0")
    page.evaluate("window.told = 0, socket.close()")
    until(page, "() => told > 1")
    points = page.evaluate("flypend.map().points")
    assert len({tuple(point["y"]) for point in points}) == len(points)


def setting_for_map():
    return {
        "vehicle": {"base": "hehn2011"}, "law": {"name": "lqr", "gains": {}}, "plant": {"base": "ideal"},
        "start": {"y": [0, 0, 1]}, "duration": 8, "pokes": [],
    }  # fmt: skip


def test_the_export_is_the_flight(visit, tmp_path):
    page = visit()
    slider(page, "law.gains.rod_bandwidth").fill("230")
    page.locator(".starts").select_option("level")
    shown(page)
    page.get_by_role("button", name="TOML").click()
    expect(page.locator(".export")).to_be_visible()
    path = tmp_path / "flight.toml"
    path.write_text(page.locator(".export textarea").input_value(), encoding="utf-8")
    run = fly_request(run_file(str(path)).flight)
    assert run.gains["rod_bandwidth"] == setting(page)["law"]["gains"]["rod_bandwidth"]
    for i in (100, 300, 600):
        page.evaluate("t => flypend.seek(t)", float(run.t[i]))
        np.testing.assert_allclose(page.evaluate("flypend.pose(0).y"), run.y[i], atol=2e-5)
    page.get_by_role("button", name="Python", exact=True).click()
    expect(page.locator(".export textarea")).to_have_value(re.compile(r"fp\.simulate\("))


def test_the_export_of_a_flight_that_goes_on_is_of_the_setting_shown(visit):
    page = visit()
    able(page)
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 20")
    page.get_by_role("button", name="TOML").click()
    slider(page, "plant.lag").fill("200")
    expect(page.locator(".export textarea")).to_have_value(re.compile("lag = "))
    text = page.locator(".export textarea").input_value()
    assert tomllib.loads(text)["plant"]["lag"] == setting(page)["plant"]["lag"]
    assert page.evaluate("flypend.live().on")


def test_what_cannot_be_flown_is_told_beside_its_control(visit):
    page = visit()
    good = page.evaluate("flypend.pose(0).y")
    control = slider(page, "law.gains.rod_bandwidth")
    control.fill("399")
    until(page, "document.querySelector('.complaint') !== null")
    complaint = page.locator(".complaint")
    assert "at least 1.5 times the rod_bandwidth" in complaint.inner_text()
    assert complaint.evaluate("e => e.previousElementSibling.dataset.path") == "law.gains.rod_bandwidth"
    assert page.locator("header > .verdict").inner_text() == "not flown"
    assert page.evaluate("flypend.pose(0).y") == good  # the last flight stays, paler and at rest
    assert page.locator(".plot").first.evaluate("e => getComputedStyle(e).opacity") == "0.35"
    assert not page.evaluate("flypend.playing()")
    assert page.locator(".notice").is_visible()
    facts = {facts["path"]: facts for facts in sliders(setting_of(OFFER["first"]))}
    bound = facts["law.gains.rod_bandwidth"]["allowed"]
    assert f"rod may be {bound[0]:.3g} to {bound[1]:.3g} rad/s" in complaint.inner_text()
    page.locator(".notice button").click()
    shown(page)
    assert setting(page)["law"]["gains"] == {}
    assert page.locator(".plot").first.evaluate("e => getComputedStyle(e).opacity") == "1"
    control.fill("399")
    until(page, "document.querySelector('.complaint') !== null")
    control.fill("200")
    shown(page)
    until(page, "document.querySelector('.complaint') === null")


def test_what_a_law_refuses_is_shaded_on_its_slider(visit):
    page = visit()
    most = slider(page, "law.gains.rod_bandwidth").evaluate("e => parseFloat(e.style.getPropertyValue('--most'))")
    control = slider(page, "law.gains.rod_bandwidth")
    control.fill(str(int(4 * most) - 4))  # of 400 steps; 1 % inside
    shown(page)
    assert page.locator("header > .verdict").inner_text() != "not flown"
    control.fill(str(int(4 * most) + 4))
    until(page, "document.querySelector('header > .verdict').textContent === 'not flown'")


def test_changes_are_taken_back_and_made_again(visit):
    page = visit()
    first = setting(page)
    control = slider(page, "law.gains.throw_speed")
    for value in (210, 220, 230):  # one hand, one change
        control.fill(str(value))
    shown(page)
    page.locator(".starts").select_option("level")
    shown(page)
    last = setting(page)
    page.keyboard.press("Control+z")
    shown(page)
    assert setting(page)["start"] == first["start"]
    assert setting(page)["law"]["gains"] == last["law"]["gains"] != {}
    page.get_by_role("button", name="undo").click()
    shown(page)
    assert setting(page) == first
    expect_flight(page)
    assert page.get_by_role("button", name="undo").is_disabled()
    page.keyboard.press("Control+Shift+z")
    page.get_by_role("button", name="redo").click()
    shown(page)
    assert setting(page) == last


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("#%7B%22law", "no setting that can be read"),
        ("#" + json.dumps({"law": {"name": "gone"}, "start": {"y": [0, 0, 1]}}), "cannot be flown"),
        ("#" + json.dumps(OFFER["first"] | {"duration": 100}), "duration: expected at most 30 s"),
    ],
    ids=["cut off", "unknown law", "out of bounds"],
)
def test_an_address_that_leads_nowhere_is_no_dead_end(visit, address, words):
    page = visit(address)
    until(page, "flypend.verdict()?.good")
    assert setting(page)["law"] == OFFER["first"]["law"]
    assert words in page.locator(".notice").inner_text()
    slider(page, "law.gains.throw_speed").fill("230")
    shown(page)
    expect_flight(page)
    until(page, "document.querySelector('.notice').hidden")


def test_a_first_flight_that_fails_is_told_once(chromium, tmp_path):
    """And may be followed by one that does not."""
    (tmp_path / "bad.py").write_text(
        "import flypend as fp\n"
        "def bad(t, state, vehicle):\n"
        "    if t == 0 and state.y[2] < -0.9:\n"
        "        raise ValueError('no rod may hang')\n"
        "    return fp.Wrench(vehicle.weight, 0 * state.omega)\n",
        encoding="utf-8",
    )
    server = Lab("--law", str(tmp_path / "bad.py:bad"))
    page, asked = chromium.new_context(viewport=WIDE).new_page(), []
    page.on("websocket", lambda socket: socket.on("framesent", lambda sent: asked.append('"fly"' in sent)))
    page.goto(server.url)
    expect(page.locator(".notice")).to_contain_text("no rod may hang")
    page.wait_for_timeout(1000)
    assert sum(asked) == 1
    assert "address" not in page.locator(".notice").inner_text()
    assert "last flight" not in page.locator(".notice").inner_text()
    page.evaluate("flypend.pin()")  # nothing
    page.locator(".starts").select_option("level")
    shown(page)
    expect(page.locator(".notice")).to_be_hidden()
    page.context.close()
    assert server.stop()[0] == 0


def test_controls_come_before_the_picture_for_those_who_go_by_keys(visit):
    page = visit()
    page.locator("header button").last.focus()
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.closest('.bar') !== null")


@pytest.mark.parametrize(("scheme", "viewport"), [("light", WIDE), ("dark", NARROW)], ids=["wide", "narrow"])
def test_axe_finds_nothing(visit, axe, scheme, viewport):
    page = visit(color_scheme=scheme, viewport=viewport)
    assert axe(page) == []
    slider(page, "law.gains.rod_bandwidth").fill("399")
    until(page, "document.querySelector('.complaint') !== null")
    page.get_by_role("button", name="TOML").click()
    assert [one for one in axe(page) if one[0] != "color-contrast"] == []  # what is pale there is out of use
    page.evaluate("flypend.tab('map')")
    until(page, "document.querySelector('.share').textContent.startsWith('not computed')")
    page.keyboard.press("Control+z")
    until(page, "flypend.map().done > 0")
    assert [one for one in axe(page) if one[0] != "color-contrast"] == []
    page.evaluate("document.querySelector('.slider input').removeAttribute('aria-label')")
    page.evaluate("document.querySelector('.slider .words').textContent = ''")
    assert "label" in [rule for rule, _ in axe(page)]  # negative control


def test_a_server_that_comes_back_is_found_again(chromium):
    first = Lab()
    page = chromium.new_context(viewport=WIDE).new_page()
    page.goto(first.url)
    shown(page)
    page.evaluate(AT_REST)  # now: once the rod stands, the flight goes on, and a slider asks the server for nothing
    assert first.stop() == (0, "")
    until(page, "document.querySelector('.busy').textContent.includes('no connection')")
    again = Lab("--port", first.host.split(":")[1])
    slider(page, "law.gains.throw_speed").fill("220")
    shown(page)
    expect_flight(page)
    page.context.close()
    assert again.stop() == (0, "")


def test_a_page_that_has_flown_nothing_yet_says_so(chromium, server):
    page = chromium.new_context(viewport=WIDE).new_page()
    page.add_init_script("window.WebSocket = class { addEventListener() {} }")  # which never opens
    page.goto(server.url)
    expect(page.locator(".busy")).to_have_text("starting…")
    page.context.close()


def test_on_a_telephone_all_is_there_and_nothing_is_too_wide(visit):
    page = visit(viewport=NARROW, has_touch=True, color_scheme="dark")
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    page.locator("[data-path='law.gains.rod_bandwidth']").scroll_into_view_if_needed()
    top = page.locator(".scene").bounding_box()["y"]
    assert top == pytest.approx(0, abs=1)  # the picture stays while one moves a slider
    page.locator(".starts").select_option("level")
    shown(page)
    assert setting(page)["start"]["y"] == [1, 0, 0]
    page.evaluate("flypend.tab('map')")
    until(page, "flypend.map().done > 0")
    assert page.evaluate("document.documentElement.scrollWidth") == 390


def test_a_telephone_on_its_side_has_room_for_the_picture(visit):
    page = visit(viewport={"width": 844, "height": 390}, has_touch=True)
    for opened in (True, False):
        assert page.locator(".panel").is_visible() == opened
        boxes = [page.locator(f"main > {part}").bounding_box() for part in (".scene", ".plots", "footer")]
        scene, plots, footer = boxes
        assert scene["height"] >= 250
        assert plots["height"] == pytest.approx(scene["height"], abs=1)
        assert footer["y"] >= scene["y"] + scene["height"]
        assert page.evaluate("document.documentElement.scrollWidth") == 844
        page.get_by_role("button", name="Tune").click()
    page.evaluate("scrollTo(0, 9999)")
    footer = page.locator("footer").bounding_box()
    assert footer["y"] + footer["height"] <= 390


def test_on_a_narrow_telephone_all_chapters_fit_and_tune_is_scrolled_to(visit):
    page = visit(viewport={"width": 360, "height": 740}, has_touch=True, reduced_motion="reduce")
    last = page.locator(".story .chips button").last.bounding_box()
    assert last["x"] + last["width"] <= 360
    assert last["height"] >= 44
    assert page.evaluate("scrollY") > 0
    scene, panel = page.locator(".scene").bounding_box(), page.locator(".panel").bounding_box()
    assert panel["y"] == pytest.approx(scene["y"] + scene["height"], abs=2)  # under the picture, which stays


@pytest.mark.parametrize("viewport", [WIDE, NARROW], ids=["wide", "narrow"])
def test_help_names_each_control_once(visit, viewport):
    page = visit(viewport=viewport)
    page.get_by_role("button", name="?", exact=True).click()
    names = page.locator(".sheet dt").all_inner_texts()
    assert {"Chapter 4", "Experiment 4", "Gains: reset", "Fly live"} < set(names)
    assert len(set(names)) == len(names)
    name, words = (page.locator(f".sheet {part}").first.bounding_box() for part in ("dt", "dd"))
    assert (words["y"] >= name["y"] + name["height"]) == (viewport is NARROW)  # beside it is no room


def test_what_is_said_of_the_server_is_not_under_the_words_of_the_flight(visit):
    page = visit(viewport={"width": 1280, "height": 800})
    assert page.locator(".panel").is_visible()
    page.evaluate("document.querySelector('.busy').hidden = false")
    page.evaluate("document.querySelector('.busy').textContent = 'no connection to the server'")
    page.evaluate("flypend.seek(2)")
    page.evaluate("flypend.screen(0)")
    said, busy = page.locator(".said").bounding_box(), page.locator(".busy").bounding_box()
    assert busy["x"] < said["x"] + said["width"]
    assert busy["y"] >= said["y"] + said["height"]


def test_a_mount_is_chosen_and_kept(visit):
    """On a hub the rod may touch: the flight ends there, says so, and has its clearance plotted."""
    page = visit("#" + json.dumps(OFFER["first"] | {"start": {"y": [0.6, 0.0, -0.8]}}))
    page.locator("select[data-path='vehicle.mount']").select_option("hub")
    shown(page)
    assert setting(page)["vehicle"] == {"base": "hehn2011", "mount": "hub"}
    assert page.locator(".plot").count() == 5
    page.locator("select[data-path='law.name']").select_option("lqr")
    shown(page)
    run = expect_flight(page)
    assert run.vehicle.mount == "hub"
    assert run.outcome.status == "collided"
    assert run.outcome.reason in page.locator("header > .verdict").inner_text()
    assert run.outcome.reason in page.locator(".track .touch").get_attribute("title")
    page.locator("select[data-path='vehicle.base']").select_option("nayak2018")
    shown(page)
    assert setting(page)["vehicle"]["mount"] == "hub"
    page.locator("select[data-path='vehicle.mount']").select_option("gimbal")
    shown(page)
    assert page.locator(".plot").count() == 4
    assert page.locator(".track .touch").count() == 0
