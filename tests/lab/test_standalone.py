"""The laboratory as one file, in a real browser without a network, beside the package."""

import json
from itertools import product

import numpy as np
import pytest
from test_lab_page import expect_flight, setting, slider

import flypend as fp
from benchmarks.frames import AT_REST
from flypend.lab.controls import figures, offer, story
from flypend.lab.standalone import chapters_page, lab_page
from tests.browser import shown, until
from tests.few import slow

WIDE = {"width": 1280, "height": 800}


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("alone") / "lab.html"
    path.write_text(lab_page(("hehn2011", "nayak2018"), ("inverted", "lqr", "corrected")), encoding="utf-8")
    return path


@pytest.fixture
def visit(offline, file):
    def open_(hash_=""):
        page = offline(file.as_uri() + hash_, viewport=WIDE, color_scheme="light")
        shown(page)
        page.evaluate(AT_REST)
        return page

    return open_


def choose(page, **paths):
    for path, name in paths.items():
        page.locator(f"select[data-path='{path.replace('_', '.')}']").select_option(name)
        shown(page)


CHOICES = list(product(("nayak2018", "hehn2011"), ("corrected", "lqr", "inverted"), ("ideal", "rotors")))
SOME = [CHOICES[i] for i in (1, 2, 4, 6, 9)]  # each vehicle with each law, but for the one it opens with


@pytest.mark.parametrize("chosen", [SOME, slow(CHOICES)], ids=["some", "all"])
def test_every_choice_flies_as_in_the_package(visit, chosen):
    page = visit()
    assert expect_flight(page).law == "inverted"
    for vehicle, law, plant in chosen:
        choose(page, vehicle_base=vehicle, law_name=law, plant_base=plant)
        run = expect_flight(page)
        assert (run.vehicle.name, run.law) == (vehicle, law)
        assert page.locator(".has-gains").is_visible() == (law != "lqr")  # of LQR only the server has others


def test_gains_pokes_maps_and_live_flights_need_no_server(visit):
    page = visit()
    slider(page, "law.gains.rod_bandwidth").fill("220")
    shown(page)
    page.evaluate("flypend.seek(1.2)")
    page.locator("[data-on=bob]").click()
    shown(page)
    page.evaluate("flypend.pause()")
    expect_flight(page)
    page.get_by_role("button", name="Region of attraction").click()
    until(page, "() => flypend.map().done > 100")
    page.get_by_role("button", name="Flight", exact=True).click()
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 700")
    choose(page, law_name="corrected")
    assert not page.evaluate("flypend.live().on")
    page.locator(".starts").select_option("random")
    shown(page)
    expect_flight(page)


def test_the_story_has_the_steps_that_can_be_flown(visit):
    page = visit()
    flown = [step for step in offer()["story"] if step["setting"]["law"]["name"] in {"inverted", "lqr", "corrected"}]
    names = page.locator(".story button").all_inner_texts()
    assert len([name for name in names if name.isdigit()]) == len(flown) < len(offer()["story"])
    page.get_by_role("button", name="Chapter 1").click()
    shown(page)
    assert setting(page)["law"]["name"] == flown[0]["setting"]["law"]["name"]
    page.evaluate("flypend.pause()")
    expect_flight(page)


@pytest.fixture(scope="module")
def chapters(tmp_path_factory):
    path = tmp_path_factory.mktemp("figures") / "chapters.html"
    path.write_text(chapters_page(), encoding="utf-8")
    return path


def test_the_chapters_are_a_page_of_their_own(offline, chapters):
    assert chapters.stat().st_size < 1.5e6
    page = offline(chapters.as_uri(), viewport=WIDE, color_scheme="light")
    shown(page)
    assert page.locator(".story .chips button").count() == len(offer()["story"])
    for step in offer()["story"]:
        assert page.locator(".step h3").inner_text() == step["title"]
        assert setting(page) == step["setting"]
        if page.locator(".step .next").is_visible():
            page.locator(".step .next").click()
            shown(page)


@pytest.mark.parametrize("step", [*story(), *figures()], ids=lambda step: step["name"])
def test_a_figure_has_one_slider_and_one_plot_and_flies_as_in_the_package(offline, chapters, step):
    page = offline(f"{chapters.as_uri()}?figure={step['name']}", viewport={"width": 704, "height": 432})
    shown(page)
    page.evaluate("flypend.pause()")
    assert setting(page) == step["setting"]
    assert [one.get_attribute("data-path") for one in page.locator(".slider:visible").all()] == [step["drag"]]
    told = page.locator(".plot:visible canvas").get_attribute("aria-label")
    assert told.startswith(f"{step['plot']} over time")
    assert page.evaluate("document.documentElement.scrollHeight") <= 432
    if step["name"] not in {"printed", "mocap"}:  # whose end the page finds to a step; whose noise is drawn
        expect_flight(page)


def test_a_figure_plays_only_in_sight_and_leaves_the_wheel_to_its_page(offline, chapters, tmp_path):
    around = f"""<!doctype html><title>Text</title><body style="margin: 0"><div style="height: 3000px"></div>
      <iframe src="{chapters.as_uri()}?figure=throw" width="704" height="432"></iframe><div style="height: 3000px">"""
    (tmp_path / "text.html").write_text(around, encoding="utf-8")
    own = {"beside": (chapters.as_uri(),), "drawn": True, "viewport": {"width": 800, "height": 600}}
    page = offline((tmp_path / "text.html").as_uri(), **own)
    frame = page.frames[1]
    frame.wait_for_function("() => window.flypend")
    page.wait_for_timeout(500)
    assert frame.evaluate("flypend.number()") == 0  # nothing was asked for
    page.evaluate("scrollTo(0, 2900)")
    frame.wait_for_function("() => window.flypend.shown() && window.flypend.playing()")
    page.mouse.move(200, 250)
    page.mouse.wheel(0, 200)
    page.wait_for_function("scrollY > 3000")
    page.evaluate("scrollTo(0, 0)")
    frame.wait_for_function("() => !window.flypend.playing()")


def test_a_figure_takes_theme_and_letters_of_the_page_around_it(offline, chapters, tmp_path):
    (tmp_path / "text.html").write_text(f'<title>Text</title><iframe src="{chapters.as_uri()}?figure=throw"></iframe>')
    page = offline((tmp_path / "text.html").as_uri(), beside=(chapters.as_uri(),), color_scheme="light")
    frame = page.frames[1]
    frame.wait_for_function("() => window.flypend")
    page.evaluate("frames[0].postMessage({ theme: 'dark', letters: 2 }, '*')")
    frame.wait_for_function("document.documentElement.dataset.theme === 'dark'")
    assert frame.evaluate("getComputedStyle(document.documentElement).fontSize") == "28px"


@pytest.mark.parametrize(
    ("field", "lacking"),
    [
        ({"law": {"name": "repaired", "gains": {}}}, "repaired"),
        ({"law": {"name": "lqr", "gains": {"weight_position": 5}}}, "weight_position"),
        ({"law": {"name": "inverted", "gains": {"rod_damping": -5}}}, "rod_damping"),
        ({"vehicle": {"base": "hehn2011", "mount": "hub"}}, "hub"),
        ({"vehicle": {"base": "hehn2011", "mount": "gimbal", "rotor_limits": [0.08, 2.5]}}, "rotor_limits"),
        ({"plant": {"base": "rotors", "sensors": "mocap"}}, "mocap"),
        ({"plant": {"base": "rotors", "rate": 100}}, "rate"),
        ({"plant": {"base": "rotors", "wind": {"knock_on_bob": 0.05}}}, "knock_on_bob"),
        ({"plant": {"base": "rotors", "wind": {"gust_on_bob": 0.1, "gust_time": 0.2}}}, "gust_time"),
    ],
)
def test_what_is_not_in_the_file_is_told(visit, field, lacking):
    page = visit("#" + json.dumps(offer()["first"] | field))
    until(page, "() => !flypend.setting().vehicle.rotor_limits && flypend.setting().law.name === 'inverted'")
    until(page, "() => flypend.shown() === flypend.number()")  # the usual start, and why
    assert lacking in page.locator(".notice").inner_text()
    assert expect_flight(page).law == "inverted"
    assert page.locator(".export, [data-path='vehicle.rotor_limits']").count() == 0


def test_a_live_flight_ends_where_its_machine_code_does(visit):
    page = visit()
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 20")
    choose(page, law_name="corrected")
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 20")
    page.locator(".undo").click()  # back to the other law
    until(page, "() => !flypend.live().on")
    shown(page)
    assert expect_flight(page).law == "inverted"


def test_axe_finds_nothing(visit, axe):
    assert axe(visit()) == []


def test_unknown_choices_are_told():
    with pytest.raises(fp.InputError, match="vehicle"):
        lab_page(("balloon",))
    with pytest.raises(fp.InputError, match="law"):
        lab_page(laws=("mine",))
    with pytest.raises(fp.InputError, match="vehicles"):
        lab_page(())


def test_the_first_flight_is_one_that_can_be_flown(chromium, tmp_path):
    path = tmp_path / "one.html"
    path.write_text(lab_page(("nayak2018",), ("corrected",)), encoding="utf-8")
    page = chromium.new_page()
    page.goto(path.as_uri())
    shown(page)
    assert expect_flight(page).law == "corrected"
    assert np.isfinite(page.evaluate("flypend.verdict().excursion"))
    page.close()
