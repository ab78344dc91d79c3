"""Pages play by themselves when they open, from disk and without a network, until somebody takes over."""

import numpy as np
import pytest

import flypend as fp
from tests.browser import opened, until

MACHINE = fp.vehicle("hehn2011")


@pytest.fixture(scope="module")
def swing():
    return fp.simulate(MACHINE, fp.laws.inverted(), fp.State(y=(0, 0, -1)), 5.0)


@pytest.fixture
def visit(offline, tmp_path):
    def open_(run, *, live=False, **setting):
        return opened(offline, run, tmp_path, setting=setting, live=live)

    return open_


@pytest.mark.parametrize("live", [False, True])
def test_a_page_plays_within_two_seconds_and_time_goes_on(visit, swing, live):
    page = visit(swing, live=live)
    until(page, "() => flypend.playing() && flypend.time() > 0", seconds=2)
    before = page.evaluate("flypend.time()")
    until(page, f"() => flypend.playing() && flypend.time() > {before}", seconds=2)


def test_a_replay_slows_down_for_the_flip_and_begins_again(visit, swing):
    page = visit(swing)
    flip = next(phase for phase in page.evaluate("flypend.phases()") if phase["name"] == "flips")
    speed = page.locator(".speed select")
    until(page, f"() => flypend.time() > {flip['from']}")
    assert page.evaluate("flypend.time()") < flip["to"] + 0.5
    assert speed.input_value() == "0.25"
    until(page, "() => flypend.time() > 3")
    assert speed.input_value() == "1"
    until(page, "() => flypend.playing() && flypend.time() < 1")


def test_a_live_page_hands_the_hovering_machine_over(visit):
    leaning = fp.simulate(MACHINE, fp.laws.inverted(), fp.State(y=(0.1, 0, np.sqrt(0.99))), 4.0)
    page = visit(leaning, live=True)
    until(page, "() => flypend.live().on && flypend.live().tick > 100")
    assert page.evaluate("flypend.verdict().good")
    assert page.locator(".handle .invite").inner_text() == "Grab the ball"
    page.locator(".handle").focus()
    page.keyboard.press("ArrowLeft")
    assert page.locator(".handle .invite").is_hidden()


def test_what_does_not_stand_is_not_handed_over(visit):
    """Under a law whose goal is hanging the vehicle falls: it is shown again, not flown on for ever."""
    page = visit(fp.simulate(MACHINE, fp.laws.corrected(), fp.State(y=(0.1, 0, np.sqrt(0.99))), 0.5), live=True)
    until(page, "() => flypend.time() >= flypend.duration()")
    until(page, "() => flypend.playing() && flypend.time() < flypend.duration()")
    assert not page.evaluate("flypend.live().on")


@pytest.mark.parametrize("take", ["key", "pause", "pointer"])
def test_it_leaves_off_for_whoever_takes_over(visit, swing, take):
    page = visit(swing)
    if take == "key":
        page.keyboard.press(" ")
    elif take == "pause":
        page.evaluate("flypend.pause()")
    else:
        page.locator(".play").click()
    shown = page.evaluate("flypend.time()")
    page.wait_for_timeout(400)
    assert page.evaluate("[flypend.playing(), flypend.time()]") == [False, shown]


@pytest.mark.parametrize("live", [False, True])
def test_for_whoever_wants_little_motion_it_rests_and_says_how_to_play(visit, swing, live):
    page = visit(swing, live=live, reduced_motion="reduce")
    page.wait_for_timeout(400)
    assert page.evaluate("[flypend.playing(), flypend.time()]") == [False, 0]
    assert page.locator(".scene > .invite").inner_text() == "Press play, or the space bar"
    page.keyboard.press(" ")
    until(page, "() => flypend.time() > 0")
    assert page.locator(".scene > .invite").is_hidden()


def test_five_controls_are_in_sight_and_the_rest_is_behind_tune(visit, swing):
    page = visit(swing, live=True, reduced_motion="reduce")
    assert page.locator(".five :is(button, select)").count() == 5
    assert page.locator(".panel").is_hidden()
    page.get_by_role("button", name="Tune").click()
    assert page.locator(".panel [data-path='law.gains.rod_bandwidth']").is_visible()
    page.get_by_role("button", name="Tune").click()
    assert page.locator(".panel").is_hidden()
