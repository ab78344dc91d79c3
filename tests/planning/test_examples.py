"""The examples of plans do what their page says, at every millisecond, and would not without their constraints."""

import shutil
from pathlib import Path

import numpy as np
import pytest

import flypend as fp
from flypend.cli import app as cli
from flypend.planning.dynamics import Units
from flypend.planning.inequalities import END
from flypend.planning.result import _independent_step
from flypend.plants.lag import step_timing

HEHN = fp.vehicle("hehn2011")
EXAMPLES = Path(fp.__file__).parent / "examples" / "planning"
BAR = fp.Window((0, 0, -0.4), 6.0, 1.5, depth=0.04)
HALF_ANGLE = np.pi / 10


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    there = tmp_path_factory.mktemp("examples")
    shutil.copytree(EXAMPLES, there / "planning")
    return there


def planned(folder, *options, name="plan.nc"):
    """Return the plan of the command with the `options`, in which a word with a dot is a file of the examples."""
    words = [str(folder / "planning" / word) if "." in word and word[0].isalpha() else word for word in options]
    cli.app(["plan", *words, "-o", str(folder / name)], standalone_mode=False)
    return fp.load_plan(folder / name)


def dense(plan):
    """States at every millisecond, by another integrator than the planner's, from each stage of the plan anew."""
    count = round(plan.stage / 1e-3)
    step, timing = _independent_step(HEHN), step_timing(HEHN.rotor_lag, plan.stage / count)
    found, samples = [], (len(plan.t) - 1) // len(plan.commands)
    for k, command in enumerate(plan.commands):
        state, rotors = plan.packed[samples * k], plan.rotor_forces[samples * k]
        for _ in range(count):
            state, rotors = step(state, rotors, command, timing)
            found.append(state)
    np.testing.assert_allclose(found[-1], plan.packed[-1], atol=1e-4)  # it is the same flight
    return fp.State.from_packed(np.array(found))


def flown(plan):
    """States of the plan's flight in the simulator, with feedback."""
    run = fp.simulate(HEHN, fp.track(plan), fp.State.from_packed(plan.packed[0]), plan.duration + 2)
    assert fp.metrics(run).success
    return run.states


def off_axis(states):
    """The angle of the bob from the camera's axis, rad."""
    sight = states.x + HEHN.l * states.y + (2, 0, 0)
    return np.arccos(sight[:, 0] / np.linalg.norm(sight, axis=1))


def test_under_the_bar_with_the_rod_up(folder):
    plan = planned(folder, "under-the-bar.toml")
    for states in (dense(plan), flown(plan)):
        assert np.min(BAR.room(states, HEHN)) > 0
        assert np.min(states.y[:, 2]) > 0
    level = fp.plan(HEHN, fp.State.from_packed(plan.packed[0]), "effort", target=plan.target, lean=np.pi / 2)
    assert np.min(BAR.room(dense(level), HEHN)) < -0.1


def test_the_bob_stays_in_sight(folder):
    plan = planned(folder, "in-sight.toml")
    for states in (dense(plan), flown(plan)):
        assert np.max(off_axis(states)) < HALF_ANGLE + 1e-3
    assert plan.y[0, 2] == -1
    free = planned(folder, "in-sight.toml", "--keep", "x[2] < 9", name="free.nc")
    assert np.max(off_axis(dense(free))) > HALF_ANGLE + 0.03


def test_out_and_back(folder):
    plan = planned(folder, "out-and-back.toml", "--path", "out_and_back.py:path", "--duration", "3")
    assert plan.excursion < 0.06
    for states in (dense(plan), flown(plan)):
        assert np.min(states.y[:, 2]) > 0.8
        assert np.max(states.x[:, 0]) > 1.45
        assert np.linalg.norm(states.x[-1]) < 0.01


def test_landing_with_the_rod_hanging(folder):
    plan = planned(folder, "landing.toml", "--end", "hanging")
    states = dense(plan)
    tips = states.x + HEHN.reach * states.y
    assert -1.0 < min(np.min(states.x[:, 2]), np.min(tips[:, 2])) < -0.96
    assert np.max(np.linalg.norm(states.x_dot, axis=1)) < 1.501
    np.testing.assert_allclose(tips[-1], (0, 0, -0.965), atol=0.01)
    assert np.linalg.norm(states.x_dot[-1]) < 0.03


def test_the_rod_is_handed_over(folder):
    plan = planned(folder, "--end", "hand-over.toml", "--objective", "effort", "--duration", "1.5")
    last, units = dense(plan)[-1], Units.of(HEHN)
    unit = {"x": units.length, "x_dot": units.length / units.time, "y": 1, "y_dot": 1 / units.time}
    for name, wanted in {"x": (0.5, 0, 0.2), "x_dot": (0.3, 0, 1), "y": (1, 0, 0), "y_dot": (0, 0.5, 4)}.items():
        assert np.linalg.norm(getattr(last, name) - wanted) < END[name] * unit[name]
    with pytest.raises(fp.InputError, match="inverted hover"):
        fp.track(plan)


def test_every_example_is_on_the_page_with_its_picture():
    root = Path(fp.__file__).parents[2]
    page = (root / "docs" / "planning" / "examples.md").read_text(encoding="utf-8")
    for path in EXAMPLES.glob("*.toml"):
        assert f"examples/planning/{path.name}" in page
        picture = root / "docs" / "img" / f"plan-{path.stem}.png"
        assert f"(../img/{picture.name})" in page
        assert picture.stat().st_size < 300_000
