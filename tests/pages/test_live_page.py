"""A page that flies by itself, in a real browser without a screen or a network, beside the package's own kernels."""

import itertools
import json
import time
from dataclasses import replace
from urllib.parse import quote

import numpy as np
import pandas as pd
import pytest

import flypend as fp
from benchmarks.frames import AT_REST, UNDRAWN
from flypend.envs import World
from flypend.flight.kernels.pieces import pieces_kernel
from flypend.flight.live import live_data, live_loop
from flypend.flight.simulate import Signals
from flypend.flight.verdict import goal, verdict
from flypend.lab.flying import poke_state
from flypend.lab.setting import Poke
from flypend.model.state import convert_packed
from flypend.plants import MOTION_CAPTURE, plant
from flypend.plants.sensors import SUITES
from tests.browser import SMALL, shown, until
from tests.few import few, slow
from tests.flight.test_metrics import flight as constructed

LAW = fp.laws.inverted()
WIDE, NARROW = {"width": 1280, "height": 800}, {"width": 390, "height": 844}


@pytest.fixture
def visit(offline, tmp_path):
    """Open the live page of a run from disk; see `offline`."""
    number = itertools.count()

    def open_(run, hash_="", **setting):
        path = tmp_path / f"{next(number)}.html"
        run.to_html(path, live=True)
        page = offline(path.as_uri() + hash_, **{"viewport": SMALL, "color_scheme": "light"} | setting)
        shown(page)
        page.evaluate(AT_REST)
        return page

    return open_


@pytest.fixture(scope="module")
def run():
    start = fp.State(y=(0.6, 0, 0.8), omega=(0.5, -1, 2), x=(0.3, -0.2, 0.1))
    return fp.simulate(fp.vehicle("hehn2011"), LAW, start, 6.0)


def poses(page, times):
    """State and rotor forces that the page shows at `times`."""
    told = page.evaluate("times => times.map((t) => (flypend.seek(t), flypend.pose(0)))", list(map(float, times)))
    names = ("x", "x_dot", "R", "y", "y_dot", "rotor_forces")
    return {name: np.array([pose[name] for pose in told]) for name in names} | {"t": np.array([p["t"] for p in told])}


def flown(run, setting):
    """The flight of a page's `setting` by the package: rows of state and rotor forces, one for each tick, e₃ up."""
    loop, rate = live_loop(run.flight), run.flight.plant.rate
    start = fp.State(**setting["start"]).in_frame(run.e3)
    flight = pieces_kernel(loop, goal(run.e3)).begin(start, seed=run.flight.seed or 0, gains=setting["law"]["gains"])
    given, knobs = setting["plant"], {}
    knobs |= {name: [given[name]] for name in ("lag", "delay") if name in given}
    knobs |= {"noise": list(given["noise"].values())} if "noise" in given else {}
    knobs |= {"rotor_limits": setting["vehicle"]["rotor_limits"]} if "rotor_limits" in setting["vehicle"] else {}
    flight.turn(**knobs)
    rows, impulses, mass = [], np.zeros(6), {"bob": run.vehicle.bob_mass, "vehicle": run.vehicle.mass}
    for poke in setting["pokes"]:
        rows.append(flight.advance(round(poke["time"] * rate) - flight.ticks, impulses))
        place = 3 if poke["on"] == "bob" else 0
        impulses = np.zeros(6)
        impulses[place : place + 3] = mass[poke["on"]] * np.array(poke["velocity"])
    rows.append(flight.advance(round(setting["duration"] * rate), impulses))
    return np.concatenate(rows)


def assert_flies(page, run, atol=1e-9):
    """What the page shows is what the package flies: at the times that it shows, to rounding."""
    rows, rate = flown(run, page.evaluate("flypend.setting()")), run.flight.plant.rate
    end = page.evaluate("flypend.duration()")
    assert end == pytest.approx((len(rows) - 1) / rate, abs=1e-9)
    seen = poses(page, np.round(np.linspace(0, end - 0.01, 60), 2))  # every hundredth of a second is a sample
    ticks = np.rint(seen["t"] * rate).astype(int)
    scale = 1 + np.abs(rows[ticks])
    for name, place in {"x": slice(0, 3), "y": slice(18, 21), "rotor_forces": slice(24, None)}.items():
        assert np.max(np.abs(seen[name] - rows[ticks, place]) / scale[:, place]) < atol, name


def go_to(page, setting):
    """Bring the page to `setting` by its address."""
    page.evaluate("hash => { location.hash = hash; }", quote(json.dumps(setting)))
    for _ in range(200):
        if page.evaluate("flypend.setting()") == setting:
            return shown(page)
        time.sleep(0.03)
    raise AssertionError(setting)


# The same flight ------------------------------------------------------------------------------------------------------


def test_it_opens_with_the_flight_that_was_recorded(visit, run):
    page = visit(run)
    seen = poses(page, run.t[::50])
    for name in ("x", "x_dot", "R", "y", "y_dot", "rotor_forces"):
        np.testing.assert_allclose(seen[name], getattr(run, name)[::50], atol=1e-9, err_msg=name)
    assert page.evaluate("flypend.verdict().good") is True
    assert page.locator("header > .verdict").inner_text().startswith("upright after")
    assert page.locator(".plot").count() == 4


def test_the_lyapunov_function_of_other_gains_is_plotted(visit):
    """Its axis is logarithmic: the number beside it has two digits, of a sample that falls on a control tick."""
    vehicle = fp.vehicle("hehn2011")
    run = fp.simulate(vehicle, fp.laws.repaired(), fp.State(y=(0.6, 0, 0.8)), 6.0)
    page, gains = visit(run), {"k_1": 1.3 * run.gains["k_1"]}
    setting = page.evaluate("flypend.setting()") | {"law": {"name": "repaired", "gains": gains}}
    page.locator("text=Pin").click()  # no ghost of the recorded flight
    go_to(page, setting)
    rows, rate = flown(run, setting), run.flight.plant.rate
    law, t = fp.laws.repaired(**gains).bind(vehicle), np.array([0.0, 1.0, 3.0, 5.0])
    V = Signals(vehicle, law, t, convert_packed(rows[np.rint(t * rate).astype(int), :24], law.e3))["V"]
    for time_, value in zip(t, V, strict=True):
        page.evaluate("t => flypend.seek(t)", time_)
        until(page, "t => flypend.time() === t", time_)
        page.evaluate("() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)))")
        told = page.locator(".plot", has_text="Lyapunov").locator("output").inner_text()
        digits, exponent = told.split("·10")
        raised = exponent.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
        assert float(f"{digits}e{raised}") == pytest.approx(value, rel=0.051), told
    assert page.locator(".plot").count() == 5
    said = page.locator(".plot", has_text="Lyapunov").locator("canvas").get_attribute("aria-label")
    assert said.startswith("Lyapunov function V over time, 10⁻")


def test_the_lyapunov_function_is_not_held_at_the_end_of_its_axis(visit):
    """It falls by more than the eight decades that are drawn: the curve leaves the plot, the number goes on."""
    law, start = fp.laws.almost_global(), fp.State(y=(0.5, 0, -np.sqrt(0.75)))
    page = visit(fp.simulate(fp.vehicle("hehn2011"), law, start, 9.0, plant="ideal"))
    told = []
    for t in (0.0, 6.0, 9.0):
        page.evaluate("t => flypend.seek(t)", t)
        until(page, "t => flypend.time() === t", t)
        page.evaluate("() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)))")
        digits, exponent = page.locator(".plot", has_text="Lyapunov").locator("output").inner_text().split("·10")
        told.append(float(f"{digits}e{exponent.translate(str.maketrans('⁻⁰¹²³⁴⁵⁶⁷⁸⁹', '-0123456789'))}"))
    assert told[2] < 0.1 * told[1] < 1e-9 * told[0]


DRAWN = "() => performance.getEntriesByName('flypend drawn').length === 1"
LOOP = "() => { let x = 1; for (let i = 0; i < 5e7; i++) x = Math.imul(x, 1664525) + 1013904223 | 0; return x; }"


def test_it_is_small_and_begins_soon(chromium, run, tmp_path):
    """What the page's main thread does until its first flight is drawn, beside a loop that a slow machine slows too.

    In processor time, which other programs do not lengthen; WebGL draws elsewhere. 300 ms where the loop takes 55.
    """
    path = tmp_path / "live.html"
    run.to_html(path, live=True)
    assert path.stat().st_size < 1.2e6
    context = chromium.new_context(offline=True, viewport=SMALL)
    page = context.new_page()
    session = context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})

    def spent():
        told = {entry["name"]: entry["value"] for entry in session.send("Performance.getMetrics")["metrics"]}
        return told["TaskDuration"]

    page.goto(path.as_uri())
    until(page, DRAWN)
    working = spent()
    page.evaluate(LOOP)
    measure = spent() - working
    worked, flights = page.evaluate("[flypend.timings()[0].flown, flypend.number()]")
    context.close()
    assert working < 10 * measure, (working, measure)
    assert flights == 1
    assert worked < 1000, worked  # ms in the worker, for a flight of six seconds; 20 on an idle machine


# The page's own time for a frame, in loops: the loop takes 55 ms where a replay takes 1.8 ms a frame, and a flight that
# goes on 1.8 ms, but twice as much on a machine so busy that each of its frames has more to tell.
FRAME = {False: 0.07, True: 0.1}


@pytest.mark.parametrize("live", [False, True])
def test_a_frame_takes_little_of_the_page(chromium, run, tmp_path, live):
    """Scripts, style and layout, in processor time of the main thread; without draw calls, which software would do."""
    run.to_html(tmp_path / "page.html", live=live)
    context = chromium.new_context(offline=True, viewport=SMALL)
    page = context.new_page()
    page.add_init_script(UNDRAWN)
    session = context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})

    def spent(*names):
        told = {entry["name"]: entry["value"] for entry in session.send("Performance.getMetrics")["metrics"]}
        return sum(told[name] for name in names)

    page.goto(tmp_path.joinpath("page.html").as_uri())
    until(page, "() => window.flypend && flypend.frames().count > 0")
    if live:
        shown(page)
    page.evaluate("flypend.seek(2), flypend.go(true)" if live else "flypend.play()")
    page.wait_for_timeout(500)
    parts, frames = ("ScriptDuration", "RecalcStyleDuration", "LayoutDuration"), "flypend.frames().count"
    before, first = spent(*parts), page.evaluate(frames)
    page.wait_for_timeout(2500)
    each = (spent(*parts) - before) / (page.evaluate(frames) - first)
    before = spent("TaskDuration")
    page.evaluate("live => live ? flypend.go(false) : flypend.pause()", live)
    page.evaluate(LOOP)
    measure = spent("TaskDuration") - before
    context.close()
    assert each < FRAME[live] * measure, (each, measure)


# Calls that draw, for a frame: every mesh costs as much as any other. World 3, pole 1, a machine 15 and 2 for its
# shadow, paths and reference 4.
MESHES = 25


@pytest.mark.parametrize("live", [False, True])
def test_a_frame_draws_few_meshes(chromium, run, tmp_path, live):
    run.to_html(tmp_path / "page.html", live=live)
    context = chromium.new_context(offline=True, viewport=SMALL)
    page = context.new_page()
    counted = "=> { window.meshes = (window.meshes ?? 0) + (name !== 'clear'); };"
    page.add_init_script(UNDRAWN.replace("=> {};", counted))
    page.goto(tmp_path.joinpath("page.html").as_uri())
    until(page, "() => window.flypend && flypend.frames().count > 0")
    if live:
        shown(page)
    page.evaluate("flypend.seek(2), flypend.go(true)" if live else "flypend.play()")
    page.wait_for_timeout(500)
    before = page.evaluate("[meshes, flypend.frames().count]")
    page.wait_for_timeout(500)
    meshes, frames = page.evaluate(
        "([meshes, count]) => [window.meshes - meshes, flypend.frames().count - count]", before
    )
    context.close()
    assert 5 * frames < meshes <= MESHES * frames, (meshes, frames)


def test_pokes_gains_limits_and_delay_are_flown_as_by_the_package(visit, run):
    page, gains = visit(run), run.flight.law.gains
    setting = page.evaluate("flypend.setting()") | {
        "law": {"name": "inverted", "gains": {"rod_bandwidth": 1.05 * gains["rod_bandwidth"]}},
        "plant": {"lag": 0.025, "delay": 0.007},
        "vehicle": {"rotor_limits": [0.05, 3.1]},
        "pokes": [
            {"time": 2.5, "on": "bob", "velocity": [0.6, 0.2, 0]},
            {"time": 3.25, "on": "vehicle", "velocity": [0, -0.4, 0.1]},
        ],
    }
    before = poses(page, [3.0])["x"]
    go_to(page, setting)
    assert page.evaluate("flypend.duration()") == pytest.approx(3.25 + 6)
    assert_flies(page, run)
    assert np.abs(poses(page, [3.0])["x"] - before).max() > 0.01


def test_recoveries_after_pokes_are_counted_as_by_the_package(visit, run):
    page = visit(run)
    blows = [(4.0, [0.9, 0.3, 0]), (8.0, [0, -1.2, 0])]
    pokes = [{"time": time, "on": "bob", "velocity": velocity} for time, velocity in blows]
    go_to(page, page.evaluate("flypend.setting()") | {"pokes": pokes})
    rows, rate = flown(run, page.evaluate("flypend.setting()")), run.flight.plant.rate
    R = rows[:, 6:15].reshape(-1, 3, 3)
    same = constructed(np.arange(len(rows)) / rate, x=rows[:, :3], R=R, y=rows[:, 18:21])
    page.evaluate("flypend.seek(flypend.duration())")
    found, wanted = page.evaluate("flypend.recoveries()"), fp.recoveries(same)
    assert len(found) == len(wanted) == 3
    for ours, its in zip(wanted, found, strict=True):
        for name, tolerance in {"begin": 0.011, "time": 0.022, "distance": 1e-3, "height_lost": 1e-3}.items():
            assert its[name] == pytest.approx(getattr(ours, name), abs=tolerance), name
    said = page.locator(".recovered").first
    until(page, "() => document.querySelector('.recovered').textContent.startsWith('recovery 3: ')")
    assert f"{found[2]['time']:.1f} s" in said.inner_text()
    page.evaluate("flypend.seek(8.3)")
    until(page, "() => document.querySelector('.recovered').textContent.includes('so far')")


def random_settings(first, run, count, seed=4):
    """Settings that differ from `first` in everything that a page may change."""
    rng, gains = np.random.default_rng(seed), run.flight.law.gains
    for _ in range(count):
        start = fp.State.random(rng)
        named = ("rod_damping", "height_bandwidth", "attitude_damping")
        yield first | {
            "law": {"name": "inverted", "gains": {name: gains[name] * rng.uniform(0.9, 1.15) for name in named}},
            "plant": {
                "lag": rng.uniform(0.01, 0.04), "delay": rng.uniform(0, 0.012),
                "noise": {name: rng.uniform(0, 0.3) * getattr(MOTION_CAPTURE, name) for name in vars(MOTION_CAPTURE)},
            },
            "start": {name: np.asarray(getattr(start, name)).tolist() for name in first["start"]},
            "pokes": [{"time": round(rng.uniform(1, 4), 2), "on": "bob", "velocity": rng.normal(0, 0.3, 3).tolist()}],
        }  # fmt: skip


def fly_random(page, run, count):
    first = page.evaluate("flypend.setting()")
    for setting in random_settings(first, run, count):
        go_to(page, setting)
        # A flight that amplifies a change of the start by 1e-12 to more than the bound cannot be nearer than that.
        rows, beside = flown(run, setting), json.loads(json.dumps(setting))
        beside["start"]["x"][0] += 1e-12
        apart = np.abs(flown(run, beside) - rows).max()
        assert_flies(page, run, max(1e-9, 10 * apart))


def test_random_settings_are_flown_as_by_the_package(visit, run):
    fly_random(visit(run), run, 3)


@pytest.mark.slow
def test_a_hundred_random_settings_are_flown_as_by_the_package(visit, run):
    fly_random(visit(run), run, 100)


@pytest.mark.parametrize("law", ["corrected", "lqr", "almost_global"])
def test_other_laws_fly_too(visit, law):
    rod = (0.1, 0, np.sqrt(0.99))
    other = fp.simulate(fp.vehicle("hehn2011"), getattr(fp.laws, law)(), fp.State(y=rod), 2.0)
    page = visit(other)
    seen = poses(page, other.t[::20])
    for name in ("x", "R", "y", "rotor_forces"):
        np.testing.assert_allclose(seen[name], getattr(other, name)[::20], atol=1e-9, err_msg=name)
    assert page.locator(".has-gains").is_visible() == (law != "lqr")


def test_the_ideal_plant_flies_is_poked_and_goes_on(visit):
    vehicle, start = fp.vehicle("nayak2018"), fp.State(y=(0.6, 0, 0.8), x_dot=(0.1, 0, 0))
    run = fp.simulate(vehicle, fp.laws.corrected(), start, 6.0, plant="ideal")
    page = visit(run)
    seen = poses(page, run.t[::20])
    for name in ("x", "x_dot", "R", "y", "y_dot", "rotor_forces"):
        np.testing.assert_allclose(seen[name], getattr(run, name)[::20], atol=1e-7, rtol=1e-9, err_msg=name)
    assert page.evaluate("flypend.verdict().words") == verdict(run)["words"]
    assert page.locator("[data-path^=plant]").count() == 0

    poke = {"time": 1.5, "on": "bob", "velocity": [0.8, -0.2, 0.1]}
    go_to(page, page.evaluate("flypend.setting()") | {"pokes": [poke]})
    struck = poke_state(run.states[150], vehicle, "down", Poke(1.5, "bob", np.array(poke["velocity"])))
    on = fp.simulate(vehicle, fp.laws.corrected(), struck, 6.0, plant="ideal")
    at = page.evaluate("(flypend.seek(1.5), flypend.pose(0))")  # as it was before the blow
    np.testing.assert_allclose(at["y_dot"], run.y_dot[150], atol=1e-6)
    seen = poses(page, 1.5 + on.t[1::20])
    for name in ("x", "R", "y", "rotor_forces"):
        np.testing.assert_allclose(seen[name], getattr(on, name)[1::20], atol=1e-6, rtol=1e-9, err_msg=name)

    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 200")
    page.evaluate("flypend.poke('vehicle', [0, 0.3, 0])")
    page.evaluate("flypend.pull([0, 0, -1])")
    until(page, "() => flypend.live().poked === 1 && flypend.live().pulled")
    page.evaluate("flypend.pull(null)")
    now = page.evaluate("flypend.live().tick")
    until(page, f"() => flypend.live().tick > {now} + 300")
    assert not page.evaluate("flypend.live().over")


def test_the_pull_of_the_hand_is_a_spring_with_its_newtons(visit, run):
    page = visit(run)
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 20")
    assert page.locator(".newtons").is_hidden()
    page.evaluate("flypend.pull([0, 0, 50])")  # too far: the spring has a greatest force
    until(page, "() => !document.querySelector('.newtons').hidden")
    most = 1.5 * 9.81 * (run.vehicle.M + run.vehicle.m)
    assert float(page.locator(".newtons").inner_text().removesuffix(" N")) == pytest.approx(most, abs=0.051)
    assert page.locator(".coil polyline").get_attribute("points").count(",") > 5
    page.evaluate("flypend.pull(null)")
    until(page, "() => document.querySelector('.newtons').hidden")


def ideal_states(run, setting, times, moved=0.0):
    """States (n, 24) of a page's `setting` through the ideal plant by the package, the start `moved` along e₁, m."""
    law = getattr(fp.laws, run.law)(**setting["law"]["gains"])
    start = fp.State(**setting["start"]).in_frame(run.e3)
    start, [poke] = fp.State.from_packed(start.packed() + moved * np.eye(24)[0]), setting["pokes"]
    before = fp.simulate(run.vehicle, law, start, poke["time"], plant="ideal")
    struck = poke_state(before.states[-1], run.vehicle, run.e3, Poke(0.0, poke["on"], np.array(poke["velocity"])))
    after = fp.simulate(run.vehicle, law, struck, setting["duration"], plant="ideal")
    early = times < poke["time"]
    return np.concatenate([before.at(times[early]).packed(), after.at(times[~early] - poke["time"]).packed()])


def fly_random_ideal(page, run, count):
    rng, first = np.random.default_rng(6), page.evaluate("flypend.setting()")
    for _ in range(count):
        start, gains = fp.State.random(rng), ("k_d", "k_1", "k_2")
        poke = {"time": round(rng.uniform(0.5, 2), 2), "on": "bob", "velocity": rng.normal(0, 0.3, 3).tolist()}
        setting = first | {
            "law": {"name": run.law, "gains": {name: run.gains[name] * rng.uniform(0.9, 1.1) for name in gains}},
            "start": {name: np.asarray(getattr(start, name)).tolist() for name in first["start"]}, "pokes": [poke],
        }  # fmt: skip
        go_to(page, setting)
        times = np.round(np.arange(0.0, poke["time"] + 2.0, 0.1), 2)
        seen, states = poses(page, times), ideal_states(run, setting, times)
        apart = np.abs(ideal_states(run, setting, times, 1e-12) - states).max()
        for name, place in {"x": slice(0, 3), "y": slice(18, 21)}.items():
            scale = 1 + np.abs(states[:, place])
            assert np.max(np.abs(seen[name] - states[:, place]) / scale) < max(1e-8, 10 * apart), name


@pytest.fixture(scope="module")
def corrected():
    start = fp.State(y=(0.6, 0, 0.8), x_dot=(0.1, 0, 0))
    return fp.simulate(fp.vehicle("nayak2018"), fp.laws.corrected(), start, 4.0, plant="ideal")


def test_random_settings_of_the_ideal_plant_are_flown_as_by_the_package(visit, corrected):
    fly_random_ideal(visit(corrected), corrected, 3)


@pytest.mark.slow
def test_a_hundred_random_settings_of_the_ideal_plant_too(visit, corrected):
    fly_random_ideal(visit(corrected), corrected, 100)


@pytest.mark.parametrize("plant", ["ideal", "rotors"])
def test_the_page_maps_the_region_of_attraction_by_itself(visit, plant):
    """Twelve hundred flights, each of which settles or not, and when, as in the package."""
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.lqr(), fp.State(y=(0.28, 0, 0.96)), 8.0, plant=plant)
    page = visit(run)
    page.get_by_role("button", name="Region of attraction").click()
    until(page, "() => flypend.map().total > 0 && flypend.map().done === flypend.map().total")
    points = page.evaluate("flypend.map().points")
    rods = np.array([point["y"] for point in points])
    rods /= np.linalg.norm(rods, axis=1)[:, None]
    mine = np.array([np.nan if point["settling"] is None else point["settling"] for point in points])
    here = fp.simulate_ensemble(run.vehicle, fp.laws.lqr(), fp.State(y=rods), 8.0, plant=plant)
    good = np.asarray(here.success)
    assert 50 < good.sum() < len(good) - 50
    assert np.mean(np.isfinite(mine) == good) > 0.998  # one at the very border may fall on either side
    both = good & np.isfinite(mine)
    np.testing.assert_allclose(mine[both], np.asarray(here.settling)[both], atol=0.0101)
    page.get_by_role("button", name="Flight", exact=True).click()
    shown(page)
    assert page.locator(".map").is_hidden()


def test_a_map_begins_anew_when_a_gain_moves_and_ends_with_its_tab(visit, run):
    page = visit(run)
    page.evaluate("flypend.go(true)")
    page.get_by_role("button", name="Region of attraction").click()
    assert not page.evaluate("flypend.live().on")  # a map is of flights that begin and end
    until(page, "() => flypend.map().done > 60")
    page.locator("[data-path='law.gains.rod_damping'] input").fill("214")
    until(page, "() => flypend.map().done < 60")
    until(page, "() => flypend.map().done > 30")
    page.evaluate("flypend.tab('flight')")
    time.sleep(0.3)
    done = page.evaluate("flypend.map().done")
    time.sleep(1.0)
    assert page.evaluate("flypend.map().done") == done < 1200
    page.evaluate("flypend.tab('map')")
    until(page, "() => flypend.map().done > 30")
    box = page.locator(".disc canvas").bounding_box()
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 4)
    shown(page)
    assert page.locator(".map").is_hidden()
    assert page.evaluate("flypend.setting().start.y")[1] > 0.5


def test_a_browser_that_cannot_run_the_machine_code_says_so(run, chromium, tmp_path):
    path = tmp_path / "broken.html"
    code = live_data(run.flight)["engine"]["code"]
    path.write_text(run.to_html(live=True).replace(code, code[:1000]), encoding="utf-8")
    page = chromium.new_page()
    page.goto(path.as_uri())
    until(page, "() => document.querySelector('.notice')?.innerText.includes('cannot fly')")
    page.close()


def test_a_singular_flight_says_why_in_the_page_too(visit):
    run = fp.simulate(fp.vehicle("nayak2018"), fp.laws.printed(), fp.State(y=(0.6, 0, 0.8)), 3.0, plant="ideal")
    assert run.outcome.status == "singular"
    page = visit(run)
    told, expected = page.evaluate("flypend.verdict()"), verdict(run)
    assert (told["words"], told["reason"]) == (expected["words"], expected["reason"])
    assert page.evaluate("flypend.duration()") == pytest.approx(run.outcome.time, abs=0.002)


ONBOARD = SUITES["onboard"].replace(joints=replace(SUITES["onboard"].joints, quantisation=1e-12))
WRONG = SUITES["mocap"].replace(adjustable="all", gyro_bias=0.01, outliers=0.003, bursts=0.5, untold_latency=0.012)


@pytest.mark.parametrize("sensors", [slow(SUITES["mocap"]), ONBOARD, WRONG], ids=["mocap", "onboard", "mocap, wrong"])
def test_sensors_and_estimator_fly_in_the_page(visit, sensors):
    """Readings, their noise and the filter on board are those of the package.

    Joint angles come in steps here too small to matter. On steps of a milliradian a flight keeps no digits for a
    second, wherever it is flown: between two steps nobody sees which way the rod leans.
    """
    seen = fp.Plant(sensors=sensors, wind=fp.Wind(gust_on_vehicle=0.05), seed=3)
    start = fp.State(y=(0.3, 0, 0.91**0.5))
    run = fp.simulate(fp.vehicle("hehn2011"), LAW, start, 3.0, plant=seen)
    page = visit(run)
    told = poses(page, run.t[::20])
    for name in ("x", "R", "y", "rotor_forces"):
        np.testing.assert_allclose(told[name], getattr(run, name)[::20], atol=1e-9, err_msg=name)
    assert page.locator("[data-path='plant.noise']").count() == 0
    assert (page.locator("[data-path='plant.defects.gyro_bias']").count() == 1) == (sensors is WRONG)


def test_a_rod_that_touches_ends_the_flight_in_the_page_too(visit):
    down = np.array([0, -np.sin(2.5), np.cos(2.5)])
    start = fp.State(y=down, y_dot=fp.geometry.project_tangent(down, np.array([0, 9.0, 0])))
    hit = fp.simulate(fp.vehicle("hehn2011").replace(mount="hub"), fp.laws.lqr(), start, 2.0)
    assert hit.outcome.status == "collided"
    page = visit(hit)
    assert hit.outcome.reason in page.evaluate("flypend.verdict().words")
    assert page.evaluate("flypend.duration()") == pytest.approx(hit.t[-1], abs=2e-3)
    assert page.locator(".plot").count() == 5
    page.evaluate("flypend.go(true)")
    until(page, "() => flypend.live().over")


# A flight that goes on ------------------------------------------------------------------------------------------------


def test_it_flies_on_answers_pokes_and_keeps_two_hundred_of_them(visit, run):
    page = visit(run)
    page.evaluate("flypend.seek(6)")
    page.locator(".go").click()
    until(page, "() => flypend.live().tick > 3050")
    assert abs(page.evaluate("flypend.pose(0)")["y"][2] - 1) < 1e-3
    page.keyboard.press("p")
    until(page, "() => flypend.pose(0).y[2] < 0.999")
    page.evaluate(
        """async () => { for (let i = 0; i < 199; i++) {
            flypend.poke(i % 2 ? 'bob' : 'vehicle', [0.02 * Math.cos(i), 0.02 * Math.sin(i), 0.01]);
            if (i % 10 === 0) await new Promise((done) => setTimeout(done, 5));
        } }"""
    )
    until(page, "() => flypend.live().poked === 200")
    tick = page.evaluate("flypend.live().tick")
    until(page, "tick => flypend.live().tick > tick + 500", tick)
    assert not page.evaluate("flypend.live().over")
    pose = page.evaluate("flypend.pose(0)")
    assert np.isfinite(np.concatenate([np.ravel(value) for value in pose.values()])).all()
    assert np.linalg.norm(pose["y"]) == pytest.approx(1, abs=1e-9)
    page.keyboard.press("l")
    shown(page)
    assert page.evaluate("flypend.duration()") == pytest.approx(6)


def test_the_bob_is_pulled_by_pointer_and_by_key(visit, run):
    page = visit(run)
    page.evaluate("flypend.seek(6), flypend.go(true)")
    until(page, "() => flypend.live().tick > 3020")
    handle = page.locator(".handle")
    box = handle.bounding_box()
    middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(*middle)
    page.mouse.down()
    page.mouse.move(middle[0] + 120, middle[1], steps=4)
    until(page, "() => flypend.live().pulled")
    until(page, "() => Math.hypot(flypend.pose(0).y[0], flypend.pose(0).y[1]) > 0.03")
    page.mouse.up()
    until(page, "() => !flypend.live().pulled")
    handle.focus()
    page.keyboard.down("ArrowLeft")
    until(page, "() => flypend.live().pulled")
    page.keyboard.up("ArrowLeft")
    until(page, "() => !flypend.live().pulled")


def test_the_camera_is_let_go_where_a_flight_goes_on_while_the_rod_is_held(visit, run):
    page, seen = visit(run), []
    page.evaluate("flypend.camera('overview')")
    for held in (False, True):
        page.locator(".starts").select_option("leaning")
        shown(page)
        page.evaluate("flypend.seek(0)")
        until(page, "() => !document.querySelector('.handle').hidden")
        if held:
            page.wait_for_timeout(500)  # the camera glides
            page.locator(".handle").hover()
            page.mouse.down()
            assert page.locator(".handle:active").count() == 1
        page.evaluate("flypend.go(true)")
        until(page, "() => flypend.live().tick > 50")
        page.mouse.up()
        page.evaluate("flypend.go(false)")
        page.locator(".starts").select_option("hanging")
        shown(page)
        page.evaluate("flypend.seek(1)")
        page.wait_for_timeout(1000)
        seen.append([page.evaluate("flypend.screen(0)")[name] for name in ("pivot", "bob")])
    np.testing.assert_allclose(*seen, atol=1)


def test_the_reference_is_moved_while_it_flies(visit, run):
    page = visit(run)
    page.evaluate("flypend.seek(6), flypend.go(true)")
    slider = page.locator("[data-path='origin.z'] input")
    slider.fill("250")  # of 400 steps from −2 to 2 m: half a metre
    until(page, "() => flypend.pose(0).x_ref[2] > 0.49")
    until(page, "() => flypend.pose(0).x[2] > 0.4")
    page.locator(".has-place .reset").click()
    until(page, "() => flypend.pose(0).x_ref[2] === 0")


def test_it_stops_scrubs_and_begins_again(visit, run):
    page = visit(run)
    page.evaluate("flypend.go(true)")
    until(page, "() => flypend.live().tick > 100")
    page.keyboard.press(" ")
    tick = page.evaluate("flypend.live().tick")
    page.evaluate("flypend.seek(0.05)")
    assert page.evaluate("flypend.time()") == pytest.approx(0.05)
    page.wait_for_timeout(300)
    assert page.evaluate("flypend.live().tick") <= tick + 50  # one piece may have been under way
    page.keyboard.press(" ")
    until(page, "tick => flypend.live().tick > tick + 60", tick)
    tick = page.evaluate("flypend.live().tick")
    page.locator(".again").click()
    until(page, "tick => flypend.live().tick < tick", tick)


def test_a_piece_that_arrives_after_a_pause_leaves_the_time_where_it_was_put(visit, run):
    page = visit(run)
    page.evaluate("flypend.go(true)")
    until(page, "() => flypend.live().tick > 100")
    time_after = page.evaluate(
        """() => new Promise((resolve) => {
            const post = Worker.prototype.postMessage;
            Worker.prototype.postMessage = function (message, ...rest) {
                post.call(this, message, ...rest);
                if (message.kind !== "advance") return;
                Worker.prototype.postMessage = post;
                document.body.dispatchEvent(new KeyboardEvent("keydown", { key: " ", code: "Space", bubbles: true }));
                const { tick } = flypend.live();
                flypend.seek(0.05);
                const look = () => (flypend.live().tick > tick ? resolve(flypend.time()) : setTimeout(look, 10));
                look();
            };
        })"""
    )
    assert time_after == pytest.approx(0.05)


def test_a_page_that_was_hidden_goes_on_where_it_was(visit, run):
    """A hidden tab is given no frames: the time that it sleeps is not flown when it wakes."""
    page = visit(run)
    page.evaluate("flypend.seek(6), flypend.go(true)")
    until(page, "() => flypend.live().tick > 3020")
    page.evaluate(
        "window.frame = requestAnimationFrame; window.requestAnimationFrame = (call) => ((window.held = call), 0)"
    )
    until(page, "() => Boolean(window.held)")
    tick = None
    while (now := page.evaluate("flypend.live().tick")) != tick:  # a piece that was under way arrives
        tick = now
        time.sleep(1)
    woken = page.evaluate(
        """(tick) => new Promise((resolve) => {
            window.requestAnimationFrame = window.frame;
            const look = () => (flypend.live().tick > tick ? resolve(flypend.live().tick) : window.frame(look));
            window.frame(window.held);
            look();
        })""",
        tick,
    )
    assert woken <= tick + 100  # of a second and more that has passed, two pieces of 0.1 s at most
    until(page, "tick => flypend.live().tick > tick + 200", tick)
    assert abs(page.evaluate("flypend.pose(0)")["y"][2] - 1) < 1e-3


# Whatever one does to it ----------------------------------------------------------------------------------------------


def test_every_slider_goes_to_its_ends(visit, run):
    """Each alone, then all at once: the page shows a flight and says how it ended, whatever the law makes of it."""
    page = visit(run, viewport={"width": 320, "height": 240})  # little to draw
    sliders = page.locator(".panel input[type=range]:visible")
    for i in range(sliders.count()):
        for end in ("min", "max"):
            usual = sliders.nth(i).input_value()
            sliders.nth(i).fill(sliders.nth(i).get_attribute(end))
            shown(page)
            assert page.evaluate("flypend.verdict().words")
            assert np.isfinite(page.evaluate("(flypend.seek(1e9), flypend.pose(0))")["x"]).all()
            sliders.nth(i).fill(usual)
    for end in ("min", "max"):
        for i in range(sliders.count()):
            sliders.nth(i).fill(sliders.nth(i).get_attribute(end))
        shown(page)
        assert page.evaluate("flypend.verdict().words")


def test_a_rod_that_is_dragged_keeps_no_rate_along_itself(visit):
    """The start has a rate; with the rod elsewhere, what of it is tangent is left, as in the laboratory."""
    moving = fp.simulate(fp.vehicle("hehn2011"), LAW, fp.State(y=(0, 0, 1), y_dot=(0, 1.5, 0)), 4.0)
    page, rod = visit(moving), np.array([0.0, 0.6, 0.8])
    setting = page.evaluate("flypend.setting()")
    setting["start"] |= {"y": rod.tolist()}
    go_to(page, setting)
    setting["start"] |= {"y_dot": fp.geometry.project_tangent(rod, np.array(setting["start"]["y_dot"])).tolist()}
    rows, seen = flown(moving, setting), poses(page, [0.0, 1.0, 3.0])
    np.testing.assert_allclose(seen["y"], rows[[0, 500, 1500], 18:21], atol=1e-9)


# Settings that no page can fly, as an address might have them; Infinity is what JSON makes of 1e999.
BROKEN = {
    "cut off": '{"law": {"na',
    "no table": '{"law": {"name": "inverted"}, "start": "hanging"}',
    "no number": '{"law": {"name": "inverted", "gains": {"rod_damping": NaN}}, "start": {}}',
    "half a start": '{"law": {"name": "inverted"}, "start": {"y": [0, 0, 1]}, "duration": 6}',
    "for ever": {"duration": np.inf},
    "very long": {"duration": 1e6},
    "poked too late": {"pokes": [{"time": 1e7, "on": "bob", "velocity": [1, 0, 0]}]},
    "poked before": {"pokes": [{"time": t, "on": "bob", "velocity": [0, 0, 0]} for t in (2, 1)]},
    "no such body": {"pokes": [{"time": 1, "on": "hand", "velocity": [1, 0, 0]}]},
    "a wind of one number": {"plant": {"wind": {"on_vehicle": [1]}}},
    "one limit": {"vehicle": {"rotor_limits": [1]}},
    "no direction": {"start": {"y": [0, 0, 0]}},
    "no rotation": {"start": {"R": [[1, 0, 0], [0, 1, 0], [0, 0, 2]]}},
    "another law": {"law": {"name": "lqr"}},
    "another vehicle": {"vehicle": {"base": "nayak2018"}},
    "another gain": {"law": {"gains": {"k_d": 1}}},
    "a gain that the law refuses": {"law": {"gains": {"rod_damping": -5}}},
    "another rate": {"plant": {"rate": 50}},
    "knocks": {"plant": {"wind": {"knock_on_bob": 0.05, "knock_period": 1}}},
    "a longer delay": {"plant": {"delay": 0.3}},
    "no lag": {"plant": {"lag": -1}},
    "no limits": {"vehicle": {"rotor_limits": [3, 1]}},
}


ALIKE = {"half a start", "very long", "a wind of one number", "another vehicle", "no lag"}  # as others


@pytest.mark.parametrize("name", few(BROKEN.keys() - ALIKE, BROKEN))
def test_an_address_that_leads_nowhere_is_no_dead_end(visit, run, name):
    first, broken = live_data(run.flight)["offer"]["first"], BROKEN[name]
    if isinstance(broken, dict):
        changed = {key: first[key] | value if isinstance(value, dict) else value for key, value in broken.items()}
        broken = json.dumps(first | changed).replace("Infinity", "1e999")
    page = visit(run, hash_="#" + quote(broken))
    until(page, "() => flypend.verdict()?.good")
    assert page.locator(".notice").is_visible()
    assert page.evaluate("flypend.setting()") == first
    assert_flies(page, run)


def test_an_address_that_is_broken_while_the_page_is_open_changes_nothing(visit, run):
    page = visit(run)
    setting = page.evaluate("flypend.setting()")
    page.evaluate("location.hash = '%7B%22start%22%3A1'")
    page.wait_for_timeout(200)
    assert page.evaluate("flypend.setting()") == setting
    wrong = setting | {"duration": 1e6}
    page.evaluate("hash => { location.hash = hash; }", quote(json.dumps(wrong)))
    until(page, "() => !document.querySelector('.notice').hidden")
    page.locator(".notice button").click()  # Undo
    shown(page)
    assert page.evaluate("flypend.setting()") == setting


def test_an_address_is_taken_though_the_page_writes_its_own_at_that_moment(visit, run):
    page = visit(run)
    wanted = page.evaluate("flypend.setting()") | {"duration": 3.5}
    page.evaluate(
        """([hash, old]) => { location.hash = hash; history.replaceState(null, "", `#${old}`); }""",
        [quote(json.dumps(wanted)), quote(json.dumps(page.evaluate("flypend.setting()")))],
    )
    until(page, "() => flypend.setting().duration === 3.5")


def test_a_link_that_comes_while_it_flies_live_is_shown_as_on_opening(visit, run):
    page = visit(run)
    page.evaluate("flypend.go(true)")
    until(page, "() => flypend.live().tick > 20")
    setting = page.evaluate("flypend.setting()")
    start = setting["start"] | {"x": [5, 0, 0], "y": [1, 0, 0]}
    pokes = [{"time": 1, "on": "bob", "velocity": [1, 0, 0]}]
    go_to(page, setting | {"start": start, "pokes": pokes, "duration": 7})
    assert page.evaluate("flypend.playing()")
    page.evaluate(AT_REST)
    assert_flies(page, run)


@pytest.mark.parametrize("size", [(200, 150), (320, 240)])
def test_a_tiny_window_shows_what_it_can(visit, run, size):
    page = visit(run, viewport=dict(zip(("width", "height"), size, strict=True)))
    page.evaluate("flypend.seek(6), flypend.go(true)")
    until(page, "() => flypend.live().tick > 3050")
    assert page.evaluate("flypend.frames().count") > 0


def test_what_was_asked_for_meanwhile_is_flown_after_an_error(chromium, run, tmp_path):
    page = chromium.new_page()
    page.add_init_script("""const post = Worker.prototype.postMessage;
        let flights = 0;
        Worker.prototype.postMessage = function (asked) {
            if (asked.kind !== "fly" || ++flights !== 2) return post.call(this, asked);
            const data = { kind: "error", number: asked.number, message: "broken" };
            setTimeout(() => this.dispatchEvent(new MessageEvent("message", { data })), 500);
        };""")
    run.to_html(tmp_path / "a.html", live=True)
    page.goto((tmp_path / "a.html").as_uri())
    shown(page)
    page.evaluate(AT_REST)
    for value in ("230", "260"):  # while the first is under way
        page.locator("[data-path='law.gains.rod_damping'] input").fill(value)
    shown(page)
    assert_flies(page, run)
    page.close()


# What one takes away --------------------------------------------------------------------------------------------------


def test_numbers_pictures_and_movies_are_saved(visit, run, tmp_path):
    page = visit(run)
    with page.expect_download() as got:
        page.locator("[data-keep=csv]").click()
    got.value.save_as(tmp_path / "flight.csv")
    table, frame = pd.read_csv(tmp_path / "flight.csv"), run.to_dataframe(units=True).reset_index()
    assert set(table) - set(frame) == {"quat_x [1]", "quat_y [1]", "quat_z [1]", "quat_w [1]"}
    assert {name for name in frame if name.startswith(("t ", "x_", "y_", "thrust", "rotor_"))} <= set(table)
    kept = np.searchsorted(table["t [s]"], run.t - 1e-9)
    for name in ("x_1 [m]", "y_3 [1]", "rotor_force_2 [N]"):
        np.testing.assert_allclose(table[name].to_numpy()[kept], frame[name], atol=1e-9)
    with page.expect_download() as got:
        page.locator("[data-keep=png]").click()
    got.value.save_as(tmp_path / "flight.png")
    assert (tmp_path / "flight.png").read_bytes().startswith(b"\x89PNG")
    page.evaluate("flypend.go(true)")
    until(page, "() => flypend.live().tick > 50")
    movie = page.locator("[data-name=movie]")
    movie.click()
    until(page, "() => flypend.live().tick > 300")
    with page.expect_download(timeout=300_000) as got:
        movie.click()
    got.value.save_as(tmp_path / "flight.webm")
    assert (tmp_path / "flight.webm").stat().st_size > 1000


def test_a_link_leads_to_the_setting(visit, run):
    page = visit(run)
    slider = page.locator("[data-path='law.gains.rod_damping'] input")
    slider.fill("230")
    shown(page)
    page.locator("[data-keep=link]").click()
    setting, address = page.evaluate("[flypend.setting(), location.hash]")
    other = visit(run, hash_=address)
    assert other.evaluate("flypend.setting()") == setting
    assert_flies(other, run)


def test_the_embed_code_is_a_frame_with_the_setting(visit, run):
    page = visit(run)
    page.locator("[data-path='law.gains.rod_damping'] input").fill("230")
    shown(page)
    clipboard = "{ writeText: async (text) => { copied = text; } }"
    page.evaluate(f"() => Object.defineProperty(navigator, 'clipboard', {{ value: {clipboard} }})")
    page.locator("[data-keep=embed]").click()
    until(page, "() => document.querySelector('[data-keep=embed]').textContent === 'Copied'")
    page.evaluate("() => { made = document.createElement('div'); made.innerHTML = copied; }")
    assert page.evaluate("made.firstChild.tagName") == "IFRAME"
    assert page.evaluate("made.firstChild.src === location.href && location.hash.includes('rod_damping')")


def test_a_flight_stays_as_a_ghost_while_sliders_move(visit, run):
    page = visit(run)
    assert page.locator(".legend p").count() == 1  # the flight that was recorded is the flight itself
    page.locator("[data-path='law.gains.rod_damping'] input").fill("260")
    shown(page)
    assert page.locator(".legend p").count() == 2
    np.testing.assert_allclose(page.evaluate("(flypend.seek(3), flypend.pose(1).x)"), run.x[300], atol=1e-5)
    page.locator("[data-keep=pin]").click()
    until(page, "() => document.querySelectorAll('.legend p').length === 1")


# For everyone ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("scheme", "viewport"), [("light", WIDE), ("dark", NARROW)])
def test_axe_finds_nothing(visit, axe, run, scheme, viewport):
    page = visit(run, color_scheme=scheme, viewport=viewport)
    assert axe(page) == []
    page.evaluate("flypend.go(true)")
    until(page, "() => flypend.live().tick > 50")
    page.keyboard.press(" ")
    assert axe(page) == []


@pytest.mark.parametrize("width", few((390, 1920), (390, 768, 1280, 1920)))
def test_it_fits_every_screen(visit, run, width):
    page = visit(run, viewport={"width": width, "height": 844 if width < 1000 else 900})
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    for name in (".go", "[data-on=bob]", "[data-keep=csv]"):
        page.locator(name).scroll_into_view_if_needed()
        box = page.locator(name).bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= width


def test_what_no_page_can_fly_is_told_in_a_line(run, tmp_path):
    machine, start = fp.vehicle("hehn2011"), fp.State(y=(0.1, 0, np.sqrt(0.99)))

    def still(t, state):
        return fp.Wrench(machine.weight, np.zeros(3))

    flights = {
        "mujoco": fp.simulate(machine, LAW, start, 0.1, plant="mujoco"),
        "callable": fp.simulate(machine, fp.Controller(name="still", function=still), start, 0.1, plant="rotors"),
    }
    run.save(tmp_path / "run.nc")
    flights["session"] = fp.load(tmp_path / "run.nc")
    world = World()
    world.reset(seed=0)
    flights["an environment"] = world.unwrapped.trajectory()
    for word, flight in flights.items():
        with pytest.raises(fp.InputError, match=word) as told:
            flight.to_html(tmp_path / "no.html", live=True)
        assert "\n" not in str(told.value)
    assert not (tmp_path / "no.html").exists()


def test_random_numbers_of_the_page_are_those_of_the_plant():
    noisy = plant("rotors").replace(noise=MOTION_CAPTURE, seed=5)
    flight = fp.simulate(fp.vehicle("hehn2011"), LAW, fp.State(y=(0.1, 0, 0.99**0.5)), 0.1, plant=noisy)
    assert live_data(flight.flight)["offer"]["seed"] == 5


def test_a_learned_law_flies_with_its_network_inside(visit, tmp_path):
    """A policy from a file: the page still knows its weights once the file is gone."""
    from flypend.laws.learned import policy, save

    path = tmp_path / "mine.npz"
    save(policy("hehn2011"), path)
    vehicle = fp.vehicle("hehn2011")
    run = fp.simulate(vehicle, fp.laws.learned(policy=str(path)), fp.State(y=(0, 0, -1)), 5.0)
    page = visit(run)
    path.unlink()
    assert_flies(page, run)
    assert run.y[-1, 2] > 0.95  # it has swung up
