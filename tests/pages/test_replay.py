"""The page of a replay as a file: it holds the run to the precision of a screen, nothing can break out of it."""

import base64
import dataclasses
import html
import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import flypend as fp
from flypend import geometry, palette
from flypend.flight.criterion import Criterion
from flypend.flight.metrics import metrics
from flypend.flight.verdict import MISSED, verdict
from flypend.model.mount import part_names
from flypend.pages import replay
from flypend.paper import experiment

ROOT = Path(__file__).parents[2]
WIDTHS = {"x": 3, "x_dot": 3, "quat_xyzw": 4, "y": 3, "y_dot": 3, "thrust": 1, "rotor_forces": 4, "x_ref": 3}
SINGLE = 2 * np.finfo(np.float32).eps  # relative, of a number kept in 32 bits


def fly(name="4", law="corrected", duration=1.0, **options):
    case = experiment(name)
    return fp.simulate(case.vehicle, case.law(law, **options), case.start, duration, plant="ideal")


def packed(run):
    return replay.pack(run, verdict(run))


@pytest.fixture(scope="module")
def dense():
    return fly()


@pytest.fixture(scope="module")
def sampled():
    vehicle = fp.vehicle("hehn2011")
    return fp.simulate(vehicle, fp.laws.inverted(), fp.State(y=(0.6, 0, 0.8)), 1.0, plant="rotors")


def embedded(text):
    """The data in a page, read as a browser does: up to the first end of a script."""
    return json.loads(re.search(r'<script id="flypend-data" type="application/json">(.*?)</script', text, re.S)[1])


def columns(record):
    """Columns of one run as the page decodes them."""
    raw = {name: np.frombuffer(base64.b64decode(text), "<f4") for name, text in record["columns"].items()}
    assert raw.keys() - {"clearance", "V"} == {"t", "excess", *WIDTHS}
    return {name: values.reshape(-1, WIDTHS[name]) if name in WIDTHS else values for name, values in raw.items()}


def same(record, run, states, t):
    """Whether the columns are the `states` of `run` at the times `t`."""
    kept = columns(record)
    for name in ("x", "x_dot", "y", "y_dot"):
        np.testing.assert_allclose(kept[name], getattr(states, name), rtol=SINGLE, atol=1e-7)
    np.testing.assert_allclose(geometry.rotation_from_quat_xyzw(kept["quat_xyzw"]), states.R, atol=1e-6)
    np.testing.assert_allclose(kept["thrust"][:, 0], np.interp(t, run.t, run.thrust), rtol=SINGLE, atol=1e-6)
    for k, force in enumerate(run.rotor_forces.T):
        np.testing.assert_allclose(kept["rotor_forces"][:, k], np.interp(t, run.t, force), rtol=SINGLE, atol=1e-6)


# What is in it ------------------------------------------------------------------------------------------------------


def test_the_dense_output_is_sampled_at_the_rate_of_a_screen(dense):
    record = packed(dense)
    t = columns(record)["t"].astype(float)
    assert (t[0], t[-1]) == (0, pytest.approx(1.0))
    assert len(t) >= 101
    assert np.all(np.diff(t) > 0)
    assert np.diff(t).max() <= 0.01 * (1 + 1e-5)
    same(record, dense, dense.at(np.clip(t, 0, 1)), t)


def test_of_a_law_that_has_one_the_lyapunov_function_is_kept(dense, sampled):
    kept = columns(packed(dense))
    V = np.interp(kept["t"], dense.t, dense.signals["V"])
    np.testing.assert_allclose(kept["V"], V, rtol=1e-3, atol=SINGLE * V.max())  # of times kept in 32 bits
    assert "V" not in columns(packed(sampled))


def test_of_a_sampled_flight_samples_are_kept(sampled):
    run = sampled
    record = packed(run)
    t = columns(record)["t"]
    kept = [int(np.argmin(np.abs(run.t - time))) for time in t]
    np.testing.assert_allclose(run.t[kept], t, atol=1e-6)
    assert (kept[0], kept[-1]) == (0, len(run.t) - 1)
    same(record, run, run.states[np.array(kept)], run.t[kept])


def test_of_many_samples_as_many_are_kept_as_a_screen_shows(sampled):
    vehicle = fp.vehicle("hehn2011")
    start = fp.State(y=(0, 0, 1))
    fine = fp.simulate(vehicle, fp.laws.inverted(), start, 1.0, plant="rotors", times=np.linspace(0, 1, 501))
    assert len(fine.t) == 501
    assert len(columns(packed(fine))["t"]) == 101


def test_a_rod_that_spins_is_sampled_finer():
    run = fly("1", "printed", 3.5, beta="off")
    rate = geometry.norm(run.y_dot)
    assert rate.max() > 30
    kept = columns(packed(run))
    turn = geometry.norm(kept["y_dot"][:-1]) * np.diff(kept["t"])
    assert turn.max() < 2 * replay.FINEST
    assert len(kept["t"]) > 1.2 * 350


def test_facts_of_the_run(dense, sampled):
    down, up = packed(dense), packed(sampled)
    assert (down["e3"], up["e3"], down["law"], up["law"]) == ("down", "up", "corrected", "inverted")
    assert down["completed"] is True
    assert down["verdict"]["good"] is metrics(dense, Criterion(target="e3", position=np.inf)).success
    vehicle = up["vehicle"]
    assert (vehicle["name"], vehicle["rod_length"]) == ("hehn2011", sampled.vehicle.rod_length)
    assert vehicle["weight"] == pytest.approx(sampled.vehicle.weight)
    assert np.linalg.norm(up["direction"]) == pytest.approx(1)
    assert ["k_1", "12"] in down["gains"]
    assert up["vehicle"]["rotor_limits"] == list(sampled.vehicle.rotor_limits)


def test_the_verdict_is_that_of_the_studies():
    """A flight that ends with its rod whirling is completed, and does not stand."""
    vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(1.0, 0, 0))
    run = fp.simulate(vehicle, fp.laws.lqr(), start, 3.0)
    one = fp.State(y=np.array([[1.0, 0, 0]]))
    ensemble = fp.simulate_ensemble(vehicle, fp.laws.lqr(), one, 3.0)
    (record,) = embedded(run.to_html())["runs"]
    assert record["completed"]
    assert record["verdict"]["good"] is bool(ensemble.success[0]) is False
    assert record["verdict"]["words"].startswith(MISSED[str(ensemble.cause[0])])


def fly_from(y, gains=None, vehicle="hehn2011"):
    start = fp.State(y=np.array(y) / np.linalg.norm(y))
    return fp.simulate(fp.vehicle(vehicle), fp.laws.inverted(**(gains or {})), start, 0.1)


def test_equal_legends_are_told_apart():
    usual, wide = fly_from((0, 0, 1)), fly_from((0, 0, 1), {"rod_damping": 0.5})
    level, other = fly_from((1, 0, 0)), fly_from((0, 0, 1), vehicle="nayak2018")

    def shown(*runs):
        return [(name["title"], tuple(map(tuple, name["gains"]))) for name in replay.names(runs)]

    assert shown(usual) == [("inverted law", ())]
    assert shown(usual, wide) == [
        ("inverted law", (("rod_damping", "0.48"),)),
        ("inverted law", (("rod_damping", "0.5"),)),
    ]
    assert [title for title, _ in shown(usual, level)] == ["inverted law, rod from 0°", "inverted law, rod from 90°"]
    assert [title for title, _ in shown(usual, other)] == ["inverted law, hehn2011", "inverted law, nayak2018"]
    assert [title for title, _ in shown(usual, usual)] == ["inverted law, 1", "inverted law, 2"]
    edited = dataclasses.replace(usual, gains={"k_p": 1.0})  # another law of that name
    assert (("k_p", "1"),) in [gains for _, gains in shown(usual, edited)]
    for runs in ((usual, wide, level), (usual, usual, wide), (usual, other, wide, level), (edited, usual)):
        assert len(set(shown(*runs))) == len(runs)


def test_the_direction_of_the_flight_does_not_depend_on_the_frame(dense):
    np.testing.assert_allclose(packed(dense)["direction"], packed(dense.flipped())["direction"], atol=1e-9)


def test_numbers_that_a_float_of_a_screen_cannot_hold_are_clipped(dense):
    thrust, forces = dense.thrust.copy(), dense.rotor_forces.copy()
    thrust[-1], forces[-1, 0] = 1e200, np.nan
    kept = columns(packed(dataclasses.replace(dense, thrust=thrust, rotor_forces=forces)))
    assert all(np.all(np.isfinite(values)) for values in kept.values())
    assert kept["thrust"].max() == np.finfo(np.float32).max


def test_a_run_of_one_sample_has_a_page(dense):
    names = ("t", "x", "x_dot", "R", "omega", "y", "y_dot", "thrust", "moment", "rotor_forces", "x_ref")
    first = {name: getattr(dense, name)[:1] for name in names}
    first["signals"] = {name: values[:1] for name, values in dense.signals.items()}
    run = dataclasses.replace(dense, **first, outcome=fp.Outcome("singular", 0.0, "0/0"), interpolant=None)
    (record,) = embedded(run.to_html())["runs"]
    assert columns(record)["t"].tolist() == [0.0]


# The file ------------------------------------------------------------------------------------------------------------


def test_ten_seconds_are_well_below_three_megabytes(sampled):
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, -1)), 10.0, plant="rotors")
    assert len(run.to_html().encode()) < 1e6
    assert len(run.to_html(ghost=run).encode()) < 1.2e6


def test_a_run_that_spins_wildly_stays_below_three_megabytes():
    wild = fly("1", "printed", 6.5, beta="off")
    assert geometry.norm(wild.y_dot).max() > 200
    assert len(wild.to_html(ghost=[wild, wild, wild]).encode()) < 3e6


EVIL = "</script><script>alert(1)</script><!--<script>&amp;\u2028'\""


def test_names_cannot_break_out(dense):
    vehicle = dense.vehicle.replace(name=EVIL)
    run = dataclasses.replace(dense, law=EVIL, vehicle=vehicle, outcome=fp.Outcome("diverged", 1.0, EVIL))
    text = run.to_html()
    assert text.count("</script>") == 2  # that of the data and that of the program
    assert "alert(1)" not in text.replace("\\u003cscript\\u003ealert(1)", "").replace("&lt;script&gt;alert(1)", "")
    data = embedded(text)
    assert data["runs"][0]["law"] == EVIL
    assert data["runs"][0]["verdict"]["reason"] == EVIL
    assert html.unescape(re.search("<title>(.*?)</title>", text, re.S)[1]) == data["title"] == f"{EVIL} law on {EVIL}"


def test_the_page_may_fetch_nothing(dense):
    text = dense.to_html()
    policy = html.unescape(re.search(r'Content-Security-Policy" content="(.*?)"', text)[1])
    assert "default-src 'none'" in policy
    assert "http" not in policy
    assert not re.search(r"<(script|img|iframe|link)[^>]*(src|href)=\"(?!data:,)", text)


def test_it_is_written_whole_or_not_at_all(dense, tmp_path):
    path = tmp_path / "flight.html"
    text = dense.to_html(path, title="A flight", layout="beside", speed=0.25)
    assert path.read_text(encoding="utf-8") == text
    assert list(tmp_path.iterdir()) == [path]
    data = embedded(text)
    assert (data["title"], data["layout"], data["speed"]) == ("A flight", "beside", 0.25)
    assert data["palette"] == palette.PAGE
    for name in ("a.htm", "none/a.html"):
        with pytest.raises(fp.InputError):
            dense.to_html(tmp_path / name)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("options", "line"),
    [
        ({"ghost": 3}, "ghost: expected a Trajectory, or a sequence of them, got 3"),
        ({"ghost": ["b"]}, "ghost: expected a Trajectory, or a sequence of them, got ['b']"),
        ({"layout": "besides"}, "layout: expected one of overlay, beside, got 'besides' (did you mean 'beside'?)"),
        ({"speed": 0}, "speed: expected a finite number > 0, got 0"),
    ],
)
def test_what_cannot_be_shown_is_refused(dense, options, line):
    with pytest.raises(fp.InputError) as refused:
        dense.to_html(**options)
    assert str(refused.value) == line


def test_four_runs_are_shown_and_no_more(dense):
    assert len(embedded(dense.to_html(ghost=[dense] * 3))["runs"]) == 4
    with pytest.raises(fp.InputError, match="runs: expected 1 to 4 runs, got 5"):
        dense.to_html(ghost=[dense] * 4)


def test_a_notebook_shows_the_page_in_a_frame_of_its_own(dense):
    frame = dense._repr_html_()
    inner = re.fullmatch(
        r'<iframe srcdoc="([^"]*)" title="[^"]+" sandbox="allow-scripts" style="[^"<>]*"></iframe>', frame
    )
    assert html.unescape(inner[1]) == dense.to_html()


# The program ---------------------------------------------------------------------------------------------------------

WEB = Path(replay.__file__).parent / "web"


def test_the_program_keeps_its_licences_and_cannot_end_its_script():
    program = (WEB / "page.js").read_text(encoding="utf-8")
    assert program.isascii()
    assert "</script" not in program.lower()
    assert "<!--" not in program
    assert re.search(r"@license\s+\* Copyright 2010-\d+ Three.js Authors\s+\* SPDX-License-Identifier: MIT", program)
    assert "Permission is hereby granted" in (WEB / "THREE-LICENSE.txt").read_text(encoding="utf-8")


def test_the_lock_of_the_program_names_no_registry():
    lock = (ROOT / "web" / "package-lock.json").read_text(encoding="utf-8")
    assert "resolved" not in lock
    packages = json.loads(lock)["packages"]
    assert all("integrity" in entry for name, entry in packages.items() if name)
    assert not re.search("https?:" + "//", lock)


def test_the_program_is_what_its_sources_give(tmp_path):
    assert shutil.which("npm"), "make test-tools installs npm"
    web = tmp_path / "web"
    shutil.copytree(ROOT / "web", web, ignore=shutil.ignore_patterns("node_modules"))
    for command in (["npm", "ci", "--silent"], ["node", "build.mjs", str(tmp_path / "built")]):
        done = subprocess.run(command, cwd=web, capture_output=True, text=True, timeout=300, check=False)
        assert done.returncode == 0, done.stderr
    for name in ("page.js", "THREE-LICENSE.txt"):
        assert (tmp_path / "built" / name).read_bytes() == (WEB / name).read_bytes(), f"{name} is old: make web"


def test_the_wheel_carries_the_program(tmp_path):
    import zipfile

    from hatchling.builders.wheel import WheelBuilder

    (wheel,) = WheelBuilder(str(ROOT)).build(directory=str(tmp_path), versions=["standard"])
    names = zipfile.ZipFile(wheel).namelist()
    wanted = ("page.js", "THREE-LICENSE.txt")
    assert {f"flypend/pages/web/{name}" for name in wanted} <= set(names)


@pytest.mark.parametrize(
    ("mount", "start"), [("hub", (0.6, 0, -0.8)), ("cup", (0.6, 0, -0.8)), ("gimbal", (0.6, 0, 0.8))]
)
def test_a_mount_tells_its_body_and_what_was_touched(mount, start):
    vehicle = fp.vehicle("hehn2011").replace(mount=mount, rod_end=0.7)
    run = fp.simulate(vehicle, fp.laws.lqr(), fp.State(y=start), 0.3)
    record = packed(run)
    told = verdict(run)
    assert record["vehicle"]["mount"] == mount
    assert record["vehicle"]["rod_end"] == vehicle.reach
    assert record["vehicle"]["body"] == vehicle.body.to_dict()
    assert record["vehicle"]["rotor_radius"] == vehicle.body.disc_radius
    assert ("clearance" in columns(record)) == (mount != "gimbal")
    if mount == "gimbal":
        assert told["part"] is None
        return
    np.testing.assert_allclose(columns(record)["clearance"][[0, -1]], run.clearance[[0, -1]], atol=1e-6)
    assert run.outcome.status == "collided"
    assert told["part"] in part_names(vehicle)
    assert (told["part"] in run.outcome.reason) or mount == "cup"
    assert told["words"].endswith(run.outcome.reason)
