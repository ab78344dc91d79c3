"""Windows that a flight passes are drawn in its replay, where they are."""

import numpy as np
import pytest

import flypend as fp
from benchmarks.frames import AT_REST
from tests.browser import opened, picture

VEHICLE = fp.vehicle("hehn2011")
DOOR = fp.Window(centre=(0.5, 0, 0.2), width=0.6, height=0.8)


@pytest.fixture(scope="module")
def still():
    return fp.simulate(VEHICLE, fp.laws.inverted(), fp.State(y=(0, 0, 1)), 1.0)


def seen(offline, run, folder, **options):
    """The picture of a replay, seen along the wall's normal."""
    page = opened(offline, run, folder, setting={"drawn": True}, **options)
    page.evaluate(AT_REST)
    page.evaluate("flypend.camera('side')")
    page.wait_for_timeout(1500)
    return picture(page)


def test_a_wall_is_drawn_around_its_opening(offline, still, tmp_path):
    without, within = (seen(offline, still, tmp_path, windows=some) for some in ((), (DOOR,)))
    changed = np.mean(np.any(np.abs(within - without) > 6, axis=-1))
    assert 0.02 < changed < 0.9


def test_a_plan_shows_what_it_flies_through():
    plan = fp.plan(VEHICLE, fp.State(x=(-1, 0, 0), y=(0, 0, 1)), "effort", target=(1.5, 0, 0), window=DOOR)
    assert plan.windows == (DOOR,)
    assert '"windows"' in plan.to_html()
    assert '"windows"' not in plan.trajectory.to_html()


def test_what_is_no_window_is_told(still):
    with pytest.raises(fp.InputError, match="windows: expected a sequence of Window"):
        still.to_html(windows=[(0, 0, 1)])
    with pytest.raises(fp.InputError, match="windows: expected a sequence of Window"):
        still.to_html(windows=3)
    assert still.to_html(windows=DOOR) == still.to_html(windows=[DOOR])
