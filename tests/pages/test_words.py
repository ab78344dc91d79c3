"""Captions, colours and verdicts of pages agree, and say what the studies say, by the page's own sources in Node.js."""

import json
import subprocess
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import flypend as fp
from flypend.flight.verdict import fall, verdict
from flypend.geometry import E3, norm
from flypend.pages import replay
from flypend.palette import PAGE, STATES
from tests.few import slow

DURATION = {"corrected": 12.0}  # s, of laws that take longer than 6 s
FLIGHTS = [
    ("hehn2011", "inverted", "rotors", "gimbal"),
    ("hehn2011", "inverted", "rotors", "hub"),
    ("nayak2018", "inverted", "ideal", "gimbal"),
    ("hehn2011", "lqr", "rotors", "hub"),
    ("nayak2018", "corrected", "ideal", "gimbal"),
    ("nayak2018", "printed", "ideal", "gimbal"),
    ("hehn2011", "almost_global", "ideal", "gimbal"),
    ("hehn2011", "inverted", fp.Plant(sensors="mocap", seed=1), "gimbal"),
]
LAWS = {law: getattr(fp.laws, law)() for _, law, _, _ in FLIGHTS}


def flown(count):
    """So many flights from random starts, each kind from near upright too."""
    rng, runs = np.random.default_rng(11), []
    for i in range(count):
        vehicle, law, plant, mount = FLIGHTS[i % len(FLIGHTS)]
        lean = rng.choice([0.1, np.pi]) * rng.random()
        heading = 2 * np.pi * rng.random()
        rod = (np.sin(lean) * np.cos(heading), np.sin(lean) * np.sin(heading), np.cos(lean))
        start = fp.State(y=rod, x=rng.normal(0, 0.3, 3)).in_frame(LAWS[law].e3)
        machine = fp.vehicle(vehicle).replace(mount=mount)
        runs.append(fp.simulate(machine, LAWS[law], start, DURATION.get(law, 6.0), plant=plant))
    return runs


def told(runs, folder):
    """What a page says of `runs`."""
    packed = folder / "runs.json"
    packed.write_text(json.dumps([replay.pack(run, verdict(run)) for run in runs]), encoding="utf-8")
    script = Path(__file__).with_name("words.mjs")
    return json.loads(subprocess.run(["node", script, packed], check=True, capture_output=True, text=True).stdout)


@pytest.mark.parametrize("count", [24, slow(200)])
def test_captions_colours_and_verdicts_agree(count, tmp_path):
    runs = flown(count)
    seen = set()
    for run, page in zip(runs, told(runs, tmp_path), strict=True):
        judged, t, words, states = (
            page["verdict"],
            np.array(page["t"]),
            np.array(page["words"]),
            np.array(page["states"]),
        )
        seen.add((run.law, judged["state"], run.outcome.status))
        stands, before = words == "stands", t < t[-1]
        # A caption and its colour are of one mind, and green is for a rod that stands.
        np.testing.assert_array_equal(states[before] == "done", stands[before])
        assert states[-1] == judged["state"]
        assert set(states[before]) <= {"done", "recovering"}
        # What stands is upright, level and at its place, by the definition of the criterion.
        for values, tolerance in ((run.y - E3, 0.05), (run.z - E3, 0.05), (run.x - run.x_ref, 0.2)):
            assert (np.interp(t, run.t, norm(values))[stands] < tolerance + 1e-3).all()
        # The verdict begins where the caption does, to a sample, and says the rest.
        if judged["state"] == "done":
            assert judged["words"].startswith("upright after ")
            assert max(t[before & ~stands], default=0.0) == pytest.approx(judged["settling"], abs=0.011)
        elif judged["state"] == "recovering":
            fall = run.x[-1, 2] - run.x[0, 2]  # e₃ is along gravity
            assert judged["words"].startswith("rod hangs after ")
            assert float(judged["words"].split()[-2]) == pytest.approx(fall, rel=5e-3, abs=5e-3)
        else:
            assert not judged["good"]
            assert run.outcome.status == "completed" or judged["words"].startswith(run.outcome.status)
    assert {state for _, state, _ in seen} == set(STATES)
    assert {status for *_, status in seen} >= {"completed", "singular", "collided"}


def test_recoveries_are_those_of_the_package(tmp_path):
    runs = [run for run in flown(24) if run.e3 == "up"]
    several = 0
    for run, page in zip(runs, told(runs, tmp_path), strict=True):
        wanted, found = fp.recoveries(run), page["recoveries"]
        several += len(wanted) > 0
        assert len(found) == len(wanted)
        for ours, its in zip(wanted, found, strict=True):
            assert its["begin"] == pytest.approx(ours.begin, abs=0.011)  # a sample of the page
            if its["end"] is None:
                assert np.isnan(ours.time)
            else:
                assert its["end"] - its["begin"] == pytest.approx(ours.time, abs=0.022)
            assert its["distance"] == pytest.approx(ours.distance, rel=1e-2, abs=1e-3)
            assert its["lost"] == pytest.approx(ours.height_lost, rel=1e-2, abs=1e-3)
    assert several >= 12


def test_metres_are_written_as_a_page_writes_them():
    for metres, words in (
        (1960.4, "fell 1960 m"),
        (-12345, "rose 12300 m"),
        (0.004, "fell 0 m"),
        (1.234, "fell 1.23 m"),
    ):
        assert fall(SimpleNamespace(x=np.array([[0, 0, 0], [0, 0, metres]]))) == f"vehicle {words}"


def test_every_state_has_a_colour_in_both_themes():
    assert set(STATES) <= set(PAGE["light"]) & set(PAGE["dark"])
    assert len({PAGE["light"][state] for state in STATES}) == len({PAGE["dark"][state] for state in STATES}) == 3


def test_the_legend_names_colours_by_what_is_drawn_in_them():
    """The rod and its bob are drawn in the colour of the role "rod", the paths in those of "trail" and "ink"."""
    sources = Path(__file__).parents[2] / "web" / "src"
    key = (sources / "captions.js").read_text(encoding="utf-8")
    for role, words in {"rod": "rod and bob", "trail": "path of the bob", "ink": "path of the vehicle"}.items():
        assert f'["{role}", "{words}"]' in key
    flyer = (sources / "scene" / "flyer.js").read_text(encoding="utf-8")
    assert "colours.ghost : colours.trail" in flyer
