"""Ends other than inverted hover: hanging, in motion; and what cannot follow such a plan."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.compile.numeric import as_numpy
from flypend.planning.dynamics import Units
from flypend.planning.inequalities import BASE, END, OTHER_END, YAW, end_errors
from flypend.planning.problem import request

HEHN = fp.vehicle("hehn2011")
UP, HANGING = fp.State(y=(0, 0, 1)), fp.State(y=(0, 0, -1))
TOSS = fp.State(x=(0.5, 0, 0.2), x_dot=(0.3, 0, 1), y=(1, 0, 0), y_dot=(0, 0.5, 4.0))


@pytest.fixture(scope="module")
def landing():
    return fp.plan(HEHN, UP, target=HANGING)


def test_the_rod_is_let_down(landing):
    assert landing.status == "converged"
    assert landing.y[0, 2] == 1
    assert landing.y[-1, 2] < -np.cos(0.022)
    assert np.max(np.abs(landing.y_dot[-1])) < 0.03 / Units.of(HEHN).time
    assert landing.excursion < 0.15  # as little as upwards, 0.09 m: the equations run backwards, but for lag and limits
    assert landing.end_error < 0.05


def test_a_plan_that_ends_otherwise_is_not_tracked(landing, tmp_path):
    """Behind it the inverted law would have nothing to balance; in a file it is what it was."""
    with pytest.raises(fp.InputError, match="plan: expected one that ends in inverted hover"):
        fp.track(landing)
    landing.save(tmp_path / "plan.nc")
    same = fp.load_plan(tmp_path / "plan.nc")
    assert np.array_equal(same.packed, landing.packed)
    with pytest.raises(fp.InputError, match="inverted hover"):
        fp.track(same)


@pytest.mark.parametrize(
    ("place", "values"),
    [(0, [0.1]), (6, [1, 0, 0, 0, -1, 0, 0, 0, -1]), (16, [8.0]), (18, [np.sin(0.1), 0, np.cos(0.1)]), (21, [0.4])],
)
def test_what_is_not_quite_hover_is_not_tracked_or_tabled(hovering, place, values, tmp_path):
    """Half a turn, a spin, a lean: none was told from hover, and the flight behind it failed."""
    packed = hovering.packed.copy()
    packed[-1, place : place + len(values)] = values
    other = replace(hovering, packed=packed)
    for use in (fp.track, lambda plan: fp.export_plan(plan, tmp_path / "table")):
        with pytest.raises(fp.InputError, match="plan: expected one that ends in inverted hover"):
            use(other)
    assert fp.track(hovering)


@pytest.fixture(scope="module")
def hovering():
    return fp.plan(HEHN, HANGING)


def test_a_plan_ends_in_motion():
    """The rod is level, flies up and turns, as a hand or a second machine may want it."""
    plan = fp.plan(HEHN, HANGING, target=TOSS)
    assert plan
    units = Units.of(HEHN)
    assert np.linalg.norm(plan.x[-1] - TOSS.x) < 2 * END["x"] * units.length
    assert np.linalg.norm(plan.x_dot[-1] - TOSS.x_dot) < 2 * END["x_dot"] * units.length / units.time
    assert np.linalg.norm(plan.y[-1] - TOSS.y) < 2 * END["y"]
    assert np.linalg.norm(plan.y_dot[-1] - TOSS.y_dot) < 2 * END["y_dot"] / units.time
    assert plan.end_error < 0.05
    assert fp.plan(HEHN, HANGING, target=TOSS, duration=0.3).reason == "the target is not reached"


def test_an_end_is_no_error_of_itself_and_hover_among_them():
    """For an end near hover both forms of the errors are of the same size."""
    asked = request(HEHN, HANGING, "excursion", TOSS)
    state, numbers = ca.SX.sym("s", 28), ca.SX.sym("n", BASE + OTHER_END)
    errors = as_numpy(ca.Function("errors", [state, numbers], [end_errors(state, numbers, other=True)]))
    own = np.append(fp.State.packed(TOSS), np.full(4, 1.3)) / Units.of(HEHN).states(4)
    own[:3] = 0
    np.testing.assert_allclose(errors(own, asked.numbers[: BASE + OTHER_END]), 0, atol=1e-12)
    hover = np.array([1, 1, 0, 1, END["omega"], *[0] * 3, *(0, 0, 1), *[0] * 3, *(0, 0, 1), *[0] * 3, 1.0])
    before = as_numpy(ca.Function("before", [state], [end_errors(state, ca.DM(hover))]))
    assert hover[YAW] == END["omega"]
    rng = np.random.default_rng(4)
    for _ in range(5):
        near = rng.normal(size=3) * 0.02
        y = (near[0], near[1], np.sqrt(1 - near[0] ** 2 - near[1] ** 2))
        off = np.append(fp.State(x=near, x_dot=near, omega=near, y=y).packed(), rng.uniform(0.9, 1.1, 4))
        assert np.linalg.norm(errors(off, hover)) == pytest.approx(np.linalg.norm(before(off)), rel=1e-9)


def test_an_end_must_keep_what_the_flight_keeps():
    with pytest.raises(fp.InputError, match=r"lean: expected more than the 3.14 rad \(180°\) of the target"):
        fp.plan(HEHN, UP, target=HANGING, lean=1.0)
    with pytest.raises(fp.InputError, match=r"speed: expected more than the 1\.04 m/s of the target"):
        fp.plan(HEHN, UP, target=TOSS, speed=1.0)
    with pytest.raises(fp.InputError, match="target: expected a position or a single State"):
        fp.plan(HEHN, UP, target=fp.random_starts(2, 1))


def test_a_plan_as_a_table(landing, tmp_path):
    landing.to_csv(tmp_path / "plan.csv")
    names = (tmp_path / "plan.csv").read_text().splitlines()[0].split(",")
    assert names[:5] == ["t [s]", "x_1 [m]", "x_2 [m]", "x_3 [m]", "x_dot_1 [m/s]"]
    assert names[-8:] == [f"{name}_{i} [N]" for name in ("rotor_force", "command") for i in range(1, 5)]
    assert {"R_11 [1]", "R_33 [1]"} < set(names)
    table = np.loadtxt(tmp_path / "plan.csv", delimiter=",", skiprows=1)
    assert table.shape == (len(landing.t), len(names)) == (len(landing.t), 33)
    np.testing.assert_allclose(table[:, 1:25], landing.packed, rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(table[:-1:4, -4:], landing.commands, rtol=1e-8)
    assert set(names[1:29]) <= set(landing.trajectory.to_dataframe(units=True).columns)


@pytest.mark.slow  # compiles programs for lanes
def test_an_ensemble_ends_as_it_is_asked_to():
    plans = fp.plan_ensemble(HEHN, fp.State(y=[(0, 0, 1), (0.6, 0, -0.8)]), target=HANGING)
    assert plans.success.all()
    assert all(plan.y[-1, 2] < -0.999 for plan in plans)
