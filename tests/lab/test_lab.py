"""The laboratory without a browser: flights with gains as inputs, pokes, exports, maps, and the server."""

import asyncio
import copy
import json
import os
import re
import signal
import subprocess
import sys
import time
import tomllib
from contextlib import suppress
from dataclasses import replace
from functools import partial, reduce
from pathlib import Path

import numpy as np
import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import websocket_connect

import flypend as fp
from flypend import plants
from flypend.errors import InputError
from flypend.flight.kernels.pieces import pieces_kernel
from flypend.flight.kernels.sampled import structure
from flypend.flight.metrics import metrics
from flypend.flight.simulate import Signals
from flypend.flight.simulate import fly as fly_request
from flypend.flight.verdict import goal, verdict
from flypend.geometry import cross, dot
from flypend.lab import answers, flying
from flypend.lab.answers import answer, engine_of
from flypend.lab.controls import figures, offer, sliders
from flypend.lab.export import python, toml
from flypend.lab.flying import fly, poke_state, region
from flypend.lab.server import LARGEST_MESSAGE, Laboratory, serve
from flypend.lab.session import Slot, read
from flypend.lab.setting import Poke, setting_of
from flypend.lab.shares import Shares
from flypend.lab.tuning import tune_loop
from flypend.lab.worker import END, GRACE, encode
from flypend.laws import law_names
from flypend.pages.offers import DEFECTS, directions
from flypend.paper import experiment
from flypend.plants import SUITES
from flypend.plants.defects import NAMES, room
from flypend.settings.runfile import run_file
from tests.few import each_once, slow

OFFER = offer()
START = {"x": [0.2, -0.1, 0.3], "y": [0.6, 0.0, 0.8], "y_dot": [0.4, 0.2, -0.3], "omega": [0.3, -0.2, 0.1]}


def asked(law="inverted", plant="ideal", gains=None, **more):
    base = {"base": plant} if isinstance(plant, str) else plant
    return (
        OFFER["first"]
        | {"law": {"name": law, "gains": gains or {}}, "plant": base, "start": START, "duration": 2.0}
        | more
    )


# Flights ------------------------------------------------------------------------------------------------------------

ROUGH = {"base": "rotors", "lag": 0.03, "wind": {"on_vehicle": [0.4, 0, 0]}, "noise": {"x": 1e-3, "y": 2e-3}}
CASES = [
    asked(gains={"rod_bandwidth": 8.5, "throw_speed": 1.7}),
    asked("lqr", gains={"rod_error": 0.1, "moment_deviation": 0.3}),
    asked("corrected", gains={"k_1": 7.0}, vehicle={"base": "nayak2018"}),
    asked(plant="rotors", gains={"attitude_bandwidth": 17.0}),
    asked("lqr", plant="hehn2011", gains={"rod_error": 0.1}),
    asked("learned", plant="rotors"),
    asked(plant=ROUGH, vehicle={"base": "hehn2011", "mount": "hub", "rotor_limits": [0.08, 3.0]}),
    slow(asked(plant={"base": "rotors", "sensors": "mocap", "delay": 0.005}, gains={"throw_speed": 1.3})),
    asked(
        "lqr",
        plant={"base": "rotors", "sensors": "laboratory", "defects": {"gyro_bias": 0.0, "outliers": 0.002}},
    ),
]


@pytest.mark.parametrize("case", CASES, ids=range(len(CASES)))
def test_the_flight_is_the_one_that_simulate_and_both_exports_make(case, tmp_path):
    setting = setting_of(case)
    run = fly(setting)
    path = tmp_path / "flight.toml"
    path.write_text(toml(setting), encoding="utf-8")
    by_file, names = fly_request(run_file(str(path)).flight), {}
    exec(python(setting), names)
    assert run.gains == dict(names["run"].gains) == dict(by_file.gains)
    for other in (by_file, names["run"]):
        assert run.e3 == other.e3
        np.testing.assert_array_equal(run.t, other.t)
        for name in ("x", "R", "y"):  # gains in the code or beside it: another order of roundings, 2 s of growth
            np.testing.assert_allclose(getattr(run, name), getattr(other, name), atol=1e-6, err_msg=name)
        np.testing.assert_allclose(run.rotor_forces, other.rotor_forces, atol=1e-4)
    np.testing.assert_array_equal(by_file.y, names["run"].y)


@pytest.mark.parametrize(
    ("law", "plant"), each_once(("printed", "corrected", "repaired", "almost_global"), ("hehn2011", "ideal"))
)
def test_the_lyapunov_function_is_that_of_the_gains_flown(law, plant):
    name = "rod_stiffness" if law == "almost_global" else "k_1"
    gains = {name: 1.02 * getattr(fp.laws, law)().gains_for(fp.vehicle("hehn2011"))[name]}
    pokes = [{"time": 1.0, "on": "bob", "velocity": [0.3, 0, 0]}]
    setting = setting_of(asked(law, plant=plant, gains=gains, pokes=pokes))
    run = fly(setting)
    along = Signals(setting.flight.vehicle, setting.flight.law, run.t, run.packed)
    np.testing.assert_allclose(run.signals["V"], along["V"], rtol=1e-9, atol=1e-9 * along["V"].max())


@pytest.mark.parametrize("sensors", ["perfect", "mocap"])
def test_gains_and_their_sliders_follow_from_the_sensors(sensors):
    """At 50 Hz the law has to be calmer on poses with noise than on a state that is known."""
    setting = setting_of(asked(plant={"base": "hehn2011", "sensors": sensors}))
    told = {facts["path"]: facts["value"] for facts in sliders(setting)}
    through = plants.plant("hehn2011").replace(sensors=sensors)
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, 1)), 0.1, plant=through)
    for name, value in run.gains.items():
        assert told.get(f"law.gains.{name}", value) == value
    assert ("plant.noise" in told) == (sensors == "perfect")
    assert (setting.flight.law.calm == 0) == (sensors == "perfect")


def test_a_law_without_a_lyapunov_function_has_no_signals():
    assert fly(setting_of(asked("inverted"))).signals == fly(setting_of(asked("lqr"))).signals == {}


def test_a_gain_changes_the_flight_and_compiles_nothing():
    told = []
    first = fly(setting_of(asked(gains={"rod_bandwidth": 7.0})), lambda: told.append(1))
    told.clear()
    second = fly(setting_of(asked(gains={"rod_bandwidth": 9.0})), lambda: told.append(1))
    assert told == []
    assert np.abs(first.x - second.x).max() > 0.01
    fly(setting_of(asked(vehicle={"base": "hehn2011", "rotor_limits": [0.08, 3.0 + 1e-3]})), lambda: told.append(1))
    assert told == [1]


@pytest.mark.parametrize(
    "change",
    [{"lag": 0.05}, {"lag": 0.0}, {"noise": {"x": 3e-3, "y": 6e-3}}, {"wind": {"on_vehicle": [-0.3, 0, 0.2]}}],
    ids=str,
)
def test_lag_noise_and_wind_change_the_flight_and_compile_nothing(change):
    told = []
    first = fly(setting_of(asked(plant=ROUGH)))
    second = fly(setting_of(asked(plant=ROUGH | change)), lambda: told.append(1))
    assert told == []
    assert np.abs(first.x - second.x).max() > 1e-3


@pytest.mark.parametrize("law", law_names())
def test_a_start_is_the_same_pose_for_every_law(law):
    # The machine code of `learned` is that which its test in the page flies.
    run = fly(setting_of(asked(law, plant="rotors" if law == "learned" else "ideal", duration=0.05)))
    up = run if run.e3 == "up" else run.flipped()
    np.testing.assert_allclose(up.y[0], START["y"], atol=1e-12)
    np.testing.assert_allclose(up.x[0], START["x"], atol=1e-12)
    np.testing.assert_allclose(up.omega[0], START["omega"], atol=1e-12)


def test_presets_are_the_experiments_of_the_paper():
    for name, preset in OFFER["experiments"].items():
        mine, papers = setting_of(preset), experiment(name)
        flight = mine.flight
        np.testing.assert_allclose(flight.starts.packed(), papers.start.packed(), atol=1e-12)
        assert {key: mine.law.values[key] for key in papers.gains} == papers.gains
        assert (flight.vehicle, flight.duration, flight.law.name) == (papers.vehicle, papers.duration, "corrected")
        assert flight.plant == fp.Ideal()


def flown(step, path=None, value=None):
    """Flight and verdict of a chapter, with the value at the path of its slider, or as it is."""
    setting = copy.deepcopy(step["setting"])
    if path == "start.y.tilt":
        setting["start"] |= {"y": [np.sin(value), 0.0, np.cos(value)]}
    elif path:
        *keys, last = path.split(".")
        reduce(dict.__getitem__, keys, setting)[last] = value
    read = setting_of(setting)
    run = fly(read)
    return run, verdict(run)


def dragged(step, values):
    return [flown(step, step["drag"], value) for value in values]


def test_the_chapters_say_what_the_flights_do():
    """Each sentence about a slider, at its ends and between."""
    story = OFFER["story"]
    joint, printed, corrected, throw, flip, catch, proved, rotors = story
    assert all(flown(step)[1]["good"] for step in story if step not in (printed, corrected))
    tilts = np.radians([0.0, 5.0, 45.0, 90.0, 135.0, 175.0, 180.0])
    ends = {}
    for step in story:
        for facts in sliders(setting_of(step["setting"])):
            if facts["path"] == step["drag"]:
                ends[step["title"]] = facts["low"], facts["high"]
    assert len(ends) == sum(step["drag"] != "start.y.tilt" for step in story)
    between = {title: np.geomspace(max(low, 1e-3), high, 5) for title, (low, high) in ends.items()}
    # A rod that leans further takes the vehicle further.
    far = [verdict(run)["excursion"] for run, _ in dragged(joint, np.radians([5.0, 20.0, 40.0]))]
    assert far == sorted(far)
    # No gain of the slider saves the printed law.
    assert flown(printed)[0].outcome.status == "singular"
    assert not any(told["good"] for _, told in dragged(printed, between[printed["title"]]))
    # Corrected, the rod hangs, and the vehicle falls wherever the rod starts.
    assert "hangs" in flown(corrected)[1]["words"]
    for run, _ in dragged(corrected, tilts):
        assert run.e3 == "down"
        assert run.x[-1][2] - run.x[0][2] > 10
    # A faster throw, a higher bob.
    thrown = [run for run, _ in dragged(throw, between[throw["title"]])]
    tops = [np.max((run.x + run.vehicle.rod_length * run.y)[:, 2]) for run in thrown]
    assert tops == sorted(tops)
    assert tops[-1] > 2 * tops[0]
    # The flip fails at both ends of the slider, the catch with too much damping, and with little of it the rod is late.
    assert [told["good"] for _, told in dragged(flip, ends[flip["title"]])] == [False, False]
    low, high = dragged(catch, ends[catch["title"]])
    assert low[1]["settling"] > flown(catch)[1]["settling"]
    assert not high[1]["good"]
    # V falls, wherever the rod starts.
    for run, _ in dragged(proved, tilts[1:-1]):
        V = run.signals["V"]
        assert (np.diff(V) <= 1e-9 * V[0]).all()
    # The lag at the end of its slider is too much.
    assert not flown(rotors, rotors["drag"], ends[rotors["title"]][1])[1]["good"]


def test_a_figure_shows_what_its_page_says():
    """At the ends of the slider and where it begins: docs/how-to/lqr.md, flight/sensors.md, model/machine.md."""
    lqr, mocap, hub = figures()
    assert all(flown(step)[1]["good"] for step in (lqr, mocap, hub))
    assert [told["good"] for _, told in dragged(lqr, np.radians([0.0, 30.0, 60.0, 90.0]))] == [True, True, False, False]
    late = [copy.deepcopy(mocap) for _ in range(2)]
    for step, seconds in zip(late, (0.024, 0.04), strict=True):  # what the estimator finds, and the end of the slider
        step["setting"]["plant"]["defects"] = {"untold_latency": seconds}
    assert [flown(step)[1]["good"] for step in late] == [True, False]
    assert 0.01 < np.min(flown(hub)[0].clearance) < 0.015
    assert dragged(hub, [np.pi / 2])[0][0].outcome.status == "collided"


def test_a_random_start_is_its_seed():
    starts = [setting_of(asked(start={"random": seed})).start.packed() for seed in (3, 3, 4)]
    np.testing.assert_array_equal(starts[0], starts[1])
    assert np.abs(starts[0] - starts[2]).max() > 0.1


def test_the_verdict_names_what_the_law_is_to_do():
    setting = setting_of(asked(duration=6.0))
    told = verdict(fly(setting))
    judged = metrics(fly(setting))
    assert told["good"] is judged.success is True
    assert told["words"] == f"upright after {judged.settling:.1f} s, excursion {round(judged.excursion, 2):.3g} m"
    preset = setting_of(OFFER["experiments"]["5"])
    told = verdict(fly(preset))
    assert "rod hangs after" in told["words"]
    assert "vehicle fell" in told["words"]
    assert (told["good"], told["state"]) == (True, "recovering")  # the law keeps its promise, and the vehicle falls
    assert "upright" not in told["words"]
    singular = setting_of(OFFER["experiments"]["2"] | {"law": {"name": "printed", "gains": {}}})
    assert verdict(fly(singular))["words"].startswith("singular after ")


@pytest.mark.parametrize("plant", ["rotors", "ideal"])
def test_machine_code_takes_the_gains_that_are_inputs(plant):
    asked_for = setting_of(asked(plant=plant))
    facts = engine_of(asked_for)
    assert facts["kind"] == ("ideal" if plant == "ideal" else "sampled")
    assert facts["gains"] == list(tune_loop(asked_for).names)
    assert len(facts["code"]) > 1000
    balanced = engine_of(setting_of(asked("lqr", plant=plant)))
    assert balanced["gains"] == []


def test_no_machine_code_is_sent_for_what_cannot_be_flown():
    [reply] = answer({"kind": "engine", "number": 3, "key": "k", "setting": asked(duration=-1)})
    assert (reply["number"], reply["key"], reply["engine"]) == (3, "k", None)


# Pokes --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("on", ["bob", "vehicle"])
@pytest.mark.parametrize("e3", ["up", "down"])
def test_a_blow_obeys_the_laws_of_impact(on, e3):
    vehicle, state = fp.vehicle("hehn2011"), fp.State.random(np.random.default_rng(3))
    velocity = np.array([0.7, -1.1, 0.4])
    seen = velocity if e3 == "up" else velocity * [1, -1, -1]
    hit = poke_state(state, vehicle, e3, Poke(1.0, on, velocity))
    jump, swing = hit.x_dot - state.x_dot, hit.y_dot - state.y_dot
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    blow = (m if on == "bob" else M) * seen
    np.testing.assert_allclose(M * jump + m * (jump + l * swing), blow, atol=1e-12)  # momentum
    assert abs(dot(state.y, swing)) < 1e-12  # the rod keeps its length
    other = M * jump if on == "bob" else m * (jump + l * swing)  # the other body is pulled along the rod only
    assert np.linalg.norm(cross(state.y, other)) < 1e-12
    assert np.linalg.norm(other) > 1e-3
    for name in ("x", "R", "omega", "y"):
        np.testing.assert_allclose(getattr(hit, name), getattr(state, name), atol=1e-14)


@pytest.mark.parametrize("plant", ["ideal", "rotors"])
def test_a_poke_keeps_what_was_before_and_changes_what_comes_after(plant):
    before = fly(setting_of(asked(plant=plant)))
    run = fly(setting_of(asked(plant=plant, pokes=[{"time": 1.0, "on": "bob", "velocity": [0.8, 0, 0]}])))
    past = run.t < 1.0 - 1e-9
    assert past.sum() == 100
    np.testing.assert_array_equal(run.t[past], before.t[:100])
    np.testing.assert_allclose(run.packed[past], before.packed[:100], atol=1e-9)
    place = int(np.argmin(np.abs(run.t - 1.0)))
    assert run.t[place] == pytest.approx(1.0)
    np.testing.assert_allclose(run.y[place], before.y[100], atol=1e-7)  # poses do not jump, rates do
    struck = place + 1  # a flight is struck after the sample of its tick
    assert np.abs(run.y_dot[struck] - before.y_dot[100]).max() > 0.5
    assert run.t[-1] == pytest.approx(3.0)  # it goes on for its duration
    assert np.all(np.diff(run.t) > 0)


@pytest.mark.parametrize("plant", ["ideal", "rotors"])
def test_pokes_that_fall_on_one_row_strike_together(plant):
    blow = {"on": "bob", "velocity": [0.3, 0, 0]}
    several = [blow | {"time": time} for time in (0.016, 0.150, 0.1504)]
    both = [blow | {"time": 0.016}, {"time": 0.15, "on": "bob", "velocity": [0.6, 0, 0]}]
    run, other = (fly(setting_of(asked(plant=plant, pokes=pokes))) for pokes in (several, both))
    assert run.t[-1] == pytest.approx(2.15)
    np.testing.assert_allclose(run.y[-1], other.y[-1], atol=1e-6)
    assert np.all(np.diff(run.t) > 0)


def test_a_poke_between_two_rows_strikes_at_the_later_as_in_pages():
    first, second = (
        fly(setting_of(asked(pokes=[{"time": time, "on": "bob", "velocity": [1, 0, 0]}]))) for time in (0.001, 0.002)
    )
    np.testing.assert_array_equal(first.y[-1], second.y[-1])


def test_a_poke_of_nothing_changes_nothing():
    nothing = [{"time": 1.5, "on": "vehicle", "velocity": [0, 0, 0]}]
    alone, hit = fly(setting_of(asked(plant="ideal"))), fly(setting_of(asked(plant="ideal", pokes=nothing)))
    times = np.linspace(1.51, 1.99, 20)
    for k in range(3):
        along = np.interp(times, alone.t, alone.x[:, k]) - np.interp(times, hit.t, hit.x[:, k])
        assert np.abs(along).max() < 1e-6 + 2e-4  # linear between samples


NOISY = {
    "base": "rotors", "delay": 0.007, "seed": 3, "noise": {"x": 0.002, "y": 0.004, "omega": 0.02},
    "wind": {"on_bob": [0.1, 0, 0], "gust_on_vehicle": 0.2},
}  # fmt: skip


@pytest.mark.parametrize("plant", ["rotors", NOISY])
def test_the_flight_computer_goes_on_through_a_poke(plant):
    """Observer, noise, gusts and commands in transit: pokes of nothing leave the flight as it was.

    To what rounding becomes in a flight that is thrown: a computer that begins anew is centimetres away.
    """
    setting = asked() | {"plant": plant if isinstance(plant, dict) else {"base": plant}}
    nothing = [{"time": time, "on": "bob", "velocity": [0, 0, 0]} for time in (0.0, 0.4, 0.4005, 1.5)]
    alone, hit = fly(setting_of(setting)), fly(setting_of(setting | {"pokes": nothing}))
    same = len(alone.t)
    np.testing.assert_allclose(hit.t[:same], alone.t, atol=1e-12)
    np.testing.assert_allclose(hit.packed[:same], alone.packed, atol=1e-8)
    np.testing.assert_allclose(hit.rotor_forces[:same], alone.rotor_forces, atol=1e-8)
    assert hit.outcome.time == pytest.approx(1.5 + 2)


def test_pokes_strike_as_in_a_flight_in_pieces():
    """Of both bodies, with gains and limits of the setting: equal to what a page flies by itself."""
    pokes = [
        {"time": 0.5, "on": "vehicle", "velocity": [0.2, -0.4, 0.1]},
        {"time": 1.2, "on": "bob", "velocity": [0.5, 0.1, 0]},
    ]
    setting = setting_of(asked(gains={"rod_damping": 0.5}, plant=NOISY, pokes=pokes))
    run, vehicle = fly(setting), setting.flight.vehicle
    loop = replace(setting.flight.loop, parameters=())
    flight = pieces_kernel(loop, goal("up")).begin(setting.flight.starts, seed=3)
    rows = [flight.advance(250)]
    rows.append(flight.advance(350, [*(vehicle.mass * np.array([0.2, -0.4, 0.1])), 0, 0, 0]))
    rows.append(flight.advance(1000, [0, 0, 0, *(vehicle.bob_mass * np.array([0.5, 0.1, 0]))]))
    every = np.concatenate(rows)
    ticks = np.rint(run.t * 500).astype(int)
    assert ticks[-1] == len(every) - 1
    np.testing.assert_allclose(run.packed, every[ticks, :24], atol=1e-8)


def test_a_flight_that_a_poke_ends_is_told_as_any_other():
    hub = asked("lqr", plant="rotors") | {"vehicle": {"base": "hehn2011", "mount": "hub"}}
    run = fly(setting_of(hub | {"pokes": [{"time": 0.1, "on": "bob", "velocity": [20, 20, 0]}]}))
    assert run.outcome.status == "collided"
    assert "touch" in run.outcome.reason
    assert 0.1 < run.outcome.time < 0.5
    assert run.t[-1] <= run.outcome.time + 1e-9
    assert np.isfinite(run.packed).all()


def test_rotors_go_on_turning_through_a_poke():
    run = fly(setting_of(asked(plant="rotors", pokes=[{"time": 1.5, "on": "bob", "velocity": [0.1, 0, 0]}])))
    jumps = np.abs(np.diff(run.rotor_forces, axis=0)).max(axis=1)
    place = int(np.argmin(np.abs(run.t - 1.5)))
    assert run.rotor_forces[place].min() > 3 * run.vehicle.rotor_limits[0]
    assert jumps[place - 1] < 0.6


# What is refused ----------------------------------------------------------------------------------------------------

WRONG = [
    (None, "setting"),
    ([], "setting"),
    (asked() | {"experiment": "1"}, "experiment"),
    (asked() | {"rtol": 1e-300}, "rtol"),
    (asked("inverse"), "law.name"),
    (asked(gains={"rod_bandwith": 1}), "law.gains.rod_bandwith"),
    (asked(gains={"rod_bandwidth": float("nan")}), "law.gains.rod_bandwidth"),
    (asked(gains={"rod_bandwidth": 60.0}), "law.gains.attitude_bandwidth"),
    (asked(gains={"rod_bandwidth": 1e9}), "law.gains.rod_bandwidth"),
    (asked("lqr", gains={"rod_error": 1e-300}), "law.gains.rod_error"),
    (asked(gains={"latency": 1e9}), "law.gains.latency"),
    (asked(start={"y": [0, 0, 1], "omega": [1e5, 0, 0]}), "start.omega"),
    (asked(start={"y": [0, 0, 1], "x": [1e300, 0, 0]}), "start.x"),
    (asked(gains={"rod_bandwidth": [1, 2]}), "law.gains.rod_bandwidth"),
    (asked(plant="mujoco"), "plant.engine"),
    (asked(plant={"base": "rotors", "sensors": "eyes"}), "plant.sensors"),
    (asked(plant={"base": "rotors", "sensors": {"base": "mocap", "force_error": 1e-3}}), "plant.sensors"),
    (asked(plant={"base": "rotors", "sensors": "mocap", "noise": {"x": 1e-3}}), "plant.noise"),
    (asked(plant={"base": "rotors", "defects": {"gyro_bias": 0.1}}), "plant.defects.gyro_bias"),
    (asked(plant={"base": "rotors", "sensors": "mocap", "defects": {"joints_off": 0.1}}), "plant.defects.joints_off"),
    (asked(plant={"base": "rotors", "sensors": "mocap", "defects": {"gyro_bias": 9.0}}), "plant.defects.gyro_bias"),
    (
        asked(plant={"base": "rotors", "sensors": "mocap", "defects": {"gyro_bias": [0, 0, 1]}}),
        "plant.defects.gyro_bias",
    ),
    (
        asked(plant={"base": "rotors", "sensors": "mocap", "defects": {"untold_latency": 0.1}}),
        "plant.defects.untold_latency",
    ),
    (asked(plant={"base": "rotors", "sensors": "mocap", "defects": 3}), "plant.defects"),
    (asked(plant={"base": "rotors", "rate": 1e9}), "plant.rate"),
    (asked(plant={"base": "rotors", "engine": "mujoco"}), "plant.engine"),
    (asked(plant={"base": "rotors", "lag": -1}), "plant.lag"),
    (asked(vehicle="secret.toml"), "vehicle"),
    (asked(vehicle={"base": "hehn2011", "rotor_positions": [[0, 0, 0]] * 4}), "vehicle.rotor_positions"),
    (asked(duration=1e9), "duration"),
    (asked(duration="long"), "duration"),
    (asked(start={"y": [0, 0, 0]}), "start.|y|"),
    (asked(start={"y": [0, 0, 1], "R": [[1, 0, 0]] * 3}), "start.R"),
    (asked(start={"random": -1}), "start.random"),
    (asked(start=None), "start"),
    (asked(pokes=[{"time": 1, "on": "moon", "velocity": [0, 0, 1]}]), "pokes.on"),
    (asked(pokes=[{"time": 1, "on": "bob", "velocity": [0, 0, 1e9]}]), "pokes.velocity"),
    (asked(pokes=[{"time": 1, "on": "bob", "velocity": [0, 0, 1]}] * 2), "pokes.time"),
    (asked(pokes=[{"time": 0, "on": "bob", "velocity": [0, 0, 1]}] * 99), "pokes"),
    (asked(pokes={}), "pokes"),
]


@pytest.mark.parametrize(("wrong", "field"), WRONG, ids=range(len(WRONG)))
def test_a_wrong_setting_is_refused_in_one_line(wrong, field):
    with pytest.raises(InputError) as caught:
        setting_of(wrong)
    assert caught.value.field == field
    assert "\n" not in str(caught.value)
    [reply] = answer({"kind": "fly", "number": 7, "setting": wrong})
    assert (reply["kind"], reply["number"], reply["field"]) == ("error", 7, field)


def test_every_slider_can_be_put_where_it_says():
    checked = set()  # those of vehicle, plant and start are the same for all laws
    for law in law_names():
        setting = asked(law, plant="rotors")
        shown = sliders(setting_of(setting))
        paths = [slider["path"] for slider in shown]
        labelled = {f"law.gains.{gain.name}" for gain in setting_of(setting).law.table.values() if gain.label}
        assert labelled == {path for path in paths if path.startswith("law.gains.")}
        assert len(set(paths)) == len(paths) >= 4 + len(labelled)
        for slider in shown:
            assert slider["low"] <= slider["value"] <= slider["high"]
            if slider["path"] in checked:
                continue
            checked |= {slider["path"]} - labelled
            wanted = 0.9 * slider["value"] + 0.1 * slider["high"]
            changed = json.loads(json.dumps(setting))
            table, *keys = changed, *slider["path"].split(".")
            for key in keys[:-1]:
                table = table.setdefault(key, {})
            table[keys[-1]] = _filled(slider["put"], wanted) if slider["put"] is not None else wanted
            [again] = [s for s in sliders(setting_of(changed)) if s["path"] == slider["path"]]
            assert again["value"] == pytest.approx(wanted), slider["path"]


@pytest.mark.parametrize("sensors", ["mocap", "onboard", "laboratory"])
def test_every_defect_has_a_slider_that_compiles_nothing(sensors):
    """From 0, in its unit; to its end, but for the room for late poses, which comes in steps."""
    asked_for = asked(plant={"base": "rotors", "sensors": sensors})
    suite = SUITES[sensors]
    shown = {facts["path"]: facts for facts in sliders(setting_of(asked_for)) if facts["group"] == "defects"}
    assert set(shown) == {f"plant.defects.{name}" for name in suite.replace(adjustable="all").adjustable}
    assert set(DEFECTS) == {*NAMES} - {"vibration_rate", "outlier_off", "outlier_turned", "burst_time"}
    before = structure(setting_of(asked_for).flight.plant)
    for path, facts in shown.items():
        name = path.removeprefix("plant.defects.")
        assert (facts["low"], facts["put"]) == (0.0, {"#": DEFECTS[name][2]})
        assert facts["value"] * facts["put"]["#"] == pytest.approx(getattr(suite, name))
        # Some five times what a careful laboratory has, or more.
        assert facts["high"] * facts["put"]["#"] >= 5 * getattr(SUITES["laboratory"], name)
        defects = {name: facts["high"] * facts["put"]["#"]}
        turned = setting_of(asked(plant={"base": "rotors", "sensors": sensors, "defects": defects})).flight.plant
        assert getattr(turned.sensors, name) == pytest.approx(defects[name])
        assert (structure(turned) == before) == (room(turned.sensors) == room(suite))
        assert room(turned.sensors) == (0.06 if late(turned.sensors) > 0.02 else 0.02)
        assert late(turned.sensors) <= 0.02 or name in ("untold_latency", "latency_jitter")


def late(sensors):
    """By how much (s) poses may be older than told."""
    return sensors.untold_latency + sensors.latency_jitter


def _filled(put, value):
    if isinstance(put, dict):
        return put["#"] * value if "#" in put else {key: _filled(entry, value) for key, entry in put.items()}
    return [_filled(entry, value) for entry in put] if isinstance(put, list) else put


@pytest.mark.parametrize("text", ["", "{", "[]", "7", '"fly"', "{}", '{"kind":"fire"}', '{"kind":"fly","number":"1"}',
                                  "[" * 20000, b'{"kind":"fly"}', "\ud800", '{"kind":["fly"]}'])  # fmt: skip
def test_malformed_messages_are_refused(text):
    with pytest.raises(InputError, match=r"^message"):
        read(text)


# Maps ---------------------------------------------------------------------------------------------------------------


def test_directions_share_the_sphere_equally_from_the_beginning():
    for count in (100, 1000, 3000):
        y = directions(3000)[:count]
        np.testing.assert_allclose(np.linalg.norm(y, axis=1), 1, atol=1e-12)
        cells = np.histogram2d(y[:, 2], np.arctan2(y[:, 1], y[:, 0]), bins=(5, 5), range=((-1, 1), (-np.pi, np.pi)))[0]
        assert np.abs(cells - count / 25).max() < max(3, 0.12 * count / 25)
    assert directions(9)[:5].tolist() == directions(5).tolist()


def test_a_map_is_made_of_the_flights():
    wrong = asked("lqr", duration=9.0)
    chunk = next(region(setting_of(wrong)))
    assert chunk["done"] == len(chunk["y"]) < chunk["total"]
    good = [settling is not None for settling in chunk["settling"]]
    assert 0 < sum(good) < len(good)
    assert all(bool(cause) != one for cause, one in zip(chunk["cause"], good, strict=True))
    for i in (good.index(True), good.index(False)):
        setting = setting_of(wrong | {"start": START | {"y": chunk["y"][i], "y_dot": [0, 0, 0]}})
        told = verdict(fly(setting))
        assert told["good"] == good[i]
        if good[i]:
            assert told["settling"] == pytest.approx(chunk["settling"][i], abs=0.021)


def test_a_map_with_noise_is_one_whatever_its_chunks(monkeypatch):
    """A direction has a seed of its own, as a run of an ensemble has; how many make a chunk is a matter of time."""
    noisy = setting_of(asked(plant={"base": "rotors", "noise": {"y_dot": 0.05}}, duration=5.0))
    monkeypatch.setitem(flying.RUNS, "sampled", 48)
    maps = []
    for first in (16, 48):
        monkeypatch.setitem(flying.FIRST, "sampled", first)
        chunks = list(region(noisy))
        maps.append([settling for chunk in chunks for settling in chunk["settling"]])
    assert len(chunks) == 1
    assert any(maps[0])
    assert maps[0] == maps[1]


# The slot: the last question is the one that is answered ------------------------------------------------------------


class Clerk:
    """A worker without a process: it answers in two parts, 0.03 s each, and hears a stop after each."""

    def __init__(self, begun):
        self.begun, self.lines, self.on, self.alive = begun, asyncio.Queue(), False, True

    def ask(self, message):
        self.begun.append(message["number"])
        self.stopped = False
        self.task = asyncio.create_task(self.work(message["number"]))

    async def work(self, number):
        for part in (1, 2):
            await asyncio.sleep(0.03)
            assert self.on
            self.lines.put_nowait(encode({"number": number, "part": part}))
            if self.stopped:
                break
        self.lines.put_nowait(END)

    def stop(self, grace=0.0):
        assert not self.stopped  # told once
        self.stopped, self.grace = True, grace

    def switch(self, on):
        self.on = on

    async def reply(self):
        return await self.lines.get()

    def kill(self):
        self.alive = False


class Clerks:
    def __init__(self):
        self.begun, self.taken, self.given = [], [], []

    async def take(self):
        self.taken.append(Clerk(self.begun))
        return self.taken[-1]

    def give(self, clerk):
        self.given.append(clerk)


def slot_of(sent, clerks):
    async def send(reply):
        sent.append(json.loads(reply))

    shares = Shares(1)
    return Slot(shares.page(), 0, shares, clerks, send)


def test_of_many_questions_the_last_is_answered_and_nothing_is_left():
    sent, clerks = [], Clerks()

    async def scenario():
        slot = slot_of(sent, clerks)
        for number in range(200):
            slot.put({"number": number})
            await asyncio.sleep(0.0005)
        await slot._task
        assert sent[-1] == {"number": 199, "part": 2}
        slot.put({"number": 200})
        await asyncio.sleep(0.045)
        slot.drop()
        await slot._task
        assert sent[-1]["number"] == 200 or sent[-1] == {"number": 199, "part": 2}
        assert sent[-1] != {"number": 200, "part": 2}
        slot.put({"number": 201})
        await slot._task
        slot.close()

    asyncio.run(scenario())
    assert len(clerks.begun) < 20
    assert sent[-1] == {"number": 201, "part": 2}
    assert [clerk.alive for clerk in clerks.taken] == [True]
    assert clerks.given == clerks.taken  # for the next page


def test_each_request_that_is_stopped_without_a_reply_has_twice_as_long_as_the_one_before():
    class Slow(Clerk):
        async def work(self, number):
            while not self.stopped:
                await asyncio.sleep(0.001)
            graces.append(self.grace)
            self.lines.put_nowait(END)

    graces, clerks = [], Clerks()

    async def scenario():
        clerks.taken.append(Slow(clerks.begun))
        clerks.take = lambda: asyncio.sleep(0, clerks.taken[0])
        slot = slot_of([], clerks)
        for number in range(4):
            slot.put({"number": number})
            while clerks.begun[-1:] != [number]:
                await asyncio.sleep(0.001)
        slot.drop()
        await slot._task

    asyncio.run(asyncio.wait_for(scenario(), 60))
    assert graces == [GRACE, 2 * GRACE, 4 * GRACE, 0.0]  # what is dropped is wanted by nobody


def test_a_page_that_closes_ends_its_work_and_no_other(monkeypatch):
    sent, clerks = [], Clerks()

    async def scenario():
        slot = slot_of(sent, clerks)
        slot.put({"number": 1})
        await asyncio.sleep(0.01)
        slot.close()
        await asyncio.wait([slot._task])

    asyncio.run(scenario())
    assert (sent, clerks.given) == ([], [])
    assert not clerks.taken[0].alive


def test_a_page_without_a_process_is_told(monkeypatch):
    sent, clerks = [], Clerks()

    async def scenario():
        slot = slot_of(sent, clerks)
        monkeypatch.setattr(clerks, "take", lambda: (_ for _ in ()).throw(OSError("no more processes")))
        slot.put({"number": 1})
        await slot._task
        monkeypatch.undo()
        slot.put({"number": 2})
        await slot._task

    asyncio.run(scenario())
    assert (sent[0]["kind"], sent[0]["number"]) == ("error", 1)
    assert sent[-1]["number"] == 2


def test_what_nobody_foresaw_is_answered(monkeypatch, caplog):
    def wrong(message, own, tell):
        raise ZeroDivisionError("so it is")

    monkeypatch.setitem(answers.ANSWERS, "fly", wrong)
    [reply] = answer({"kind": "fly", "number": 1})
    assert (reply["kind"], reply["number"]) == ("error", 1)
    assert "ZeroDivisionError: so it is" in reply["message"]
    assert "ZeroDivisionError" in caplog.text


# The server ---------------------------------------------------------------------------------------------------------


def family(process):
    """The ids of `process` and of those below it."""
    parents = {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            parents[int(path.parent.name)] = int(path.read_text().rsplit(")", 1)[1].split()[1])
    found = [process]
    for one in found:
        found += [child for child, parent in parents.items() if parent == one]
    return found


def cpu(process):
    """Seconds of processor time of `process`; 0 of one that has ended."""
    with suppress(OSError):
        fields = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return 0.0


class Lab:
    """`flypend lab` as a process."""

    def __init__(self, *options):
        command = [sys.executable, "-m", "flypend", "lab", "--no-browser", *options]
        # Whoever runs the tests in the background has them ignore Ctrl-C.
        heard = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, preexec_fn=heard
        )
        found, said = None, ""
        while not found and (line := self.process.stdout.readline()):  # of a law in Python there is a note before
            found, said = re.search(r"http://(\S+)/", line), said + line
        assert found, said
        self.host = found[1]
        self.url = f"http://{self.host}/"

    @property
    def family(self):
        """The ids of its processes."""
        return family(self.process.pid)

    def cpu(self):
        """Seconds of processor time so far, of all its processes that are there."""
        return sum(cpu(process) for process in self.family)

    def calm(self):
        """Whether it soon does nothing: within 2 s, where 200 flights or a map would take longer."""
        for _ in range(5):
            before = self.cpu()
            time.sleep(0.4)
            if self.cpu() - before < 0.05:
                return True
        return False

    def stop(self, number=signal.SIGTERM):
        self.process.send_signal(number)
        said, _ = self.process.communicate(timeout=20)
        return self.process.returncode, said


@pytest.fixture(scope="module")
def lab():
    server = Lab()
    yield server
    assert server.stop() == (0, "")  # no traceback, whatever the tests sent


async def _ask(lab, *messages, origin=None, replies=1):
    """The replies to `messages` over one socket."""
    headers = {"Origin": origin} if origin else {}
    socket = await websocket_connect(
        HTTPRequest(f"ws://{lab.host}/socket", headers=headers, connect_timeout=20), max_message_size=2**24
    )
    for message in messages:
        await socket.write_message(
            message if isinstance(message, str | bytes) else json.dumps(message), binary=isinstance(message, bytes)
        )
    out = []
    while len(out) < replies:
        reply = await asyncio.wait_for(socket.read_message(), 30)
        if reply is None:
            out.append(None)
            break
        if '"compiling"' not in reply[:40]:
            out.append(json.loads(reply))
    if out[-1] is None:
        socket.close()
    else:
        await _closed(socket)
    return out


async def _closed(socket):
    socket.close()
    while await asyncio.wait_for(socket.read_message(), 20) is not None:
        pass


def ask(*arguments, **options):
    return asyncio.run(_ask(*arguments, **options))


def code(url, **headers):
    async def fetch():
        response = await AsyncHTTPClient().fetch(HTTPRequest(url, headers=headers), raise_error=False)
        return response.code, response.headers

    return asyncio.run(fetch())


UPGRADE = {
    "Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
    "Sec-WebSocket-Version": "13",
}  # fmt: skip


def test_it_listens_on_loopback_only(lab):
    assert lab.host.startswith("127.0.0.1:")
    status, headers = code(lab.url)
    assert status == 200
    assert "default-src 'none'" in headers["Content-Security-Policy"]
    assert code(lab.url + "page.js")[0] == 200
    assert code(lab.url + "../pyproject.toml")[0] == 404


def test_another_name_that_points_here_is_refused(lab):
    port = lab.host.split(":")[1]
    for host in ("evil.example", f"evil.example:{port}", f"127.0.0.1.evil.example:{port}", "192.168.1.7"):
        assert code(lab.url, Host=host)[0] == 403, host
        assert code(lab.url + "socket", Host=host, Origin=f"http://{host}", **UPGRADE)[0] == 403
    assert code(lab.url, Host=f"localhost:{port}")[0] == 200


def test_the_page_of_another_site_is_refused(lab):
    port = int(lab.host.split(":")[1])
    for origin in (
        "http://evil.example",
        f"http://127.0.0.1:{port + 1}",
        "null",
        f"http://localhost:{port}",
        "file://",
    ):
        assert code(lab.url + "socket", Origin=origin, **UPGRADE)[0] == 403, origin
    [reply] = ask(lab, {"kind": "fly", "number": 1, "setting": asked()}, origin=f"http://{lab.host}")
    assert reply["kind"] == "flight"


def test_it_survives_what_is_no_message(lab):
    bad = ["{", "[]", b"\x00\xff", '{"kind":"fly"}', '{"kind":"fly","setting":{"law":7}}', "[" * 9999]
    for message in bad:
        [reply] = ask(lab, message)
        assert reply["kind"] == "error", message
    assert ask(lab, "x" * (LARGEST_MESSAGE + 1)) == [None]  # the line is cut
    [reply] = ask(lab, {"kind": "fly", "number": 5, "setting": asked()})
    assert (reply["kind"], reply["number"]) == ("flight", 5)


def test_200_moves_end_with_the_last_and_leave_nothing_running(lab):
    moves = [{"kind": "fly", "number": i, "setting": asked(gains={"throw_speed": 1 + i / 200})} for i in range(200)]

    async def scenario():
        socket = await websocket_connect(f"ws://{lab.host}/socket", max_message_size=2**24)
        for move in moves:
            await socket.write_message(json.dumps(move))
        numbers = []
        while not numbers or numbers[-1] != 199:
            reply = json.loads(await asyncio.wait_for(socket.read_message(), 30))
            numbers.append(reply["number"])
        calm = await asyncio.get_running_loop().run_in_executor(None, lab.calm)
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(socket.read_message(), 0.1)
        await _closed(socket)
        return reply, numbers, calm

    reply, numbers, calm = asyncio.run(scenario())
    assert numbers == sorted(numbers)
    assert len(numbers) < 150
    assert calm
    [wanted] = [s["value"] for s in reply["sliders"] if s["path"] == "law.gains.throw_speed"]
    assert wanted == pytest.approx(1 + 199 / 200)


def test_a_map_ends_with_its_page(lab):
    slow = asked(plant="rotors", duration=20.0)
    [chunk] = ask(lab, {"kind": "map", "number": 1, "setting": slow})
    assert chunk["done"] < chunk["total"]
    assert lab.calm()


@pytest.mark.parametrize("number", [slow(signal.SIGINT), signal.SIGTERM])
def test_it_ends_at_once_even_in_the_middle_of_a_map(number):
    lab = Lab("--port", "0")

    async def scenario():
        socket = await websocket_connect(f"ws://{lab.host}/socket", max_message_size=2**24)
        await socket.write_message(json.dumps({"kind": "map", "number": 1, "setting": asked(duration=10.0)}))
        await asyncio.wait_for(socket.read_message(), 30)
        started = time.monotonic()
        result = await asyncio.get_running_loop().run_in_executor(None, lab.stop, number)
        took = time.monotonic() - started
        await _closed(socket)
        return result, took

    result, took = asyncio.run(scenario())
    assert result == (0, "")
    assert took < 8  # one piece of the map on a busy machine


def test_a_port_that_is_taken_is_told_in_one_line(lab):
    port = lab.host.split(":")[1]
    command = [sys.executable, "-m", "flypend", "lab", "--no-browser", "--port", port]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert f"127.0.0.1:{port}" in done.stderr


def test_whom_a_server_that_is_open_to_others_trusts():
    laboratory = Laboratory("0.0.0.0")
    assert laboratory.trusts("192.168.1.7:80")
    assert laboratory.trusts("localhost:80")
    assert not laboratory.trusts("evil.example:80")
    assert not laboratory.trusts("")
    assert not laboratory.trusts("[a")
    laboratory.close()
    named = Laboratory("MyHost")
    assert named.trusts("myhost:80")
    assert named.trusts("MyHost:80")
    named.close()


def test_a_host_that_no_name_can_be_is_told_in_one_line():
    with pytest.raises(fp.InputError, match=r"^--host and --port: .*label.*long") as told:
        serve("a" * 70, browser=False, announce=lambda _: pytest.fail("served"))
    assert "\n" not in str(told.value)


def test_exports_are_toml_and_say_when_pokes_are_left_out():
    setting = setting_of(asked(pokes=[{"time": 1.0, "on": "bob", "velocity": [1, 0, 0]}], plant="hehn2011"))
    assert tomllib.loads(toml(setting))["plant"]["interface"] == "rates"
    assert "left out" in toml(setting)
    assert "left out" in python(setting)
    assert "left out" not in toml(setting_of(asked()))


def test_a_mount_ends_a_flight_as_everywhere_and_is_exported():
    start = {"y": [0.6, 0.0, -0.8]}
    asked_for = {"vehicle": {"base": "hehn2011", "mount": "hub"}, "start": start, "duration": 1.0, "plant": "rotors"}
    setting = setting_of(asked("lqr", **asked_for))
    run, vehicle = fly(setting), fp.vehicle("hehn2011").replace(mount="hub")
    alone = fp.simulate(vehicle, fp.laws.lqr(), fp.State(y=start["y"]), 1.0)
    assert run.outcome == alone.outcome
    assert run.outcome.status == "collided"
    assert verdict(run)["part"] == "arm 1"
    assert 'mount = "hub"' in toml(setting)
    assert "mount='hub'" in python(setting)
    with pytest.raises(fp.InputError, match="one of gimbal, hub, cup"):
        setting_of(asked(vehicle={"base": "hehn2011", "mount": "glue"}))
