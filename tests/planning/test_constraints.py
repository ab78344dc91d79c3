"""One record for what a flight keeps, or its fields one by one."""

from dataclasses import fields, replace

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.planning.constraints import Keywords, Motion, broken, gather
from flypend.planning.dynamics import Stage
from flypend.planning.inequalities import inequalities
from flypend.planning.problem import request
from flypend.settings.expressions import Expression

HEHN = fp.vehicle("hehn2011")
LEANING = fp.State(y=(np.sin(0.3), 0, np.cos(0.3)))


def test_fields_one_by_one_and_in_a_record_make_the_same_plan():
    kept = fp.Constraints(floor=-0.5, ceiling=2.0)  # one structure, whose programs other tests need, too
    one = fp.plan(HEHN, LEANING, constraints=kept, time_limit=60)
    other = fp.plan(HEHN, LEANING, floor=-0.5, ceiling=2.0, time_limit=60)
    np.testing.assert_array_equal(one.x, other.x)


@pytest.mark.slow  # compiles programs for lanes
def test_and_the_same_ensemble():
    starts, kept = fp.State.from_packed(LEANING.packed()[None]), fp.Constraints(floor=-0.5, ceiling=2.0)
    one, other = (fp.plan_ensemble(HEHN, starts, **given) for given in ({"constraints": kept}, kept.given))
    np.testing.assert_array_equal(one[0].x, other[0].x)


def test_a_record_and_further_fields_add_up():
    kept = gather("plan", fp.Constraints(floor=-0.5), {"ceiling": 1.0})
    assert kept.given == {"floor": -0.5, "ceiling": 1.0}
    np.testing.assert_array_equal(kept.walls[:, 2], [-0.5, 1.0])
    assert gather("plan", None, {}).given == {}


@pytest.mark.parametrize("function", [fp.plan, fp.plan_ensemble, fp.plan_and_track, fp.nmpc])
def test_each_function_takes_both_and_refuses_a_field_in_both(function):
    first = {fp.plan: (HEHN, LEANING), fp.plan_ensemble: (HEHN, fp.random_starts(2, 1))}.get(function, ())
    with pytest.raises(fp.InputError, match=r"^clearance: expected one value"):
        function(*first, constraints=fp.Constraints(clearance=0.02), clearance=0.03)
    with pytest.raises(fp.InputError, match=r"\.clearence: .*did you mean 'clearance'"):
        function(*first, clearence=0.03)
    with pytest.raises(fp.InputError, match=r"^constraints"):
        function(*first, constraints={"floor": 1.0})


@pytest.mark.parametrize(
    ("fields", "line"),
    [
        ({"lean": 4.0}, "lean: expected at most 3.14 rad"), ({"lean": 0}, "lean"), ({"speed": -1}, "speed"),
        ({"floor": np.nan}, "floor"), ({"floor": 1.0, "ceiling": 0.0}, "floor: expected a height below the ceiling"),
        ({"box": 3}, "box: expected numbers of shape"), ({"box": np.zeros((2, 3))}, "box: expected a lowest corner"),
        ({"window": 3}, "window: expected a Window"), ({"waypoints": (1, 2)}, "waypoints"),
        ({"path": 3}, "path"), ({"clearance": -1}, "clearance"), ({"floor": "low"}, "floor"),
    ],
)  # fmt: skip
def test_wrong_fields_are_named(fields, line):
    with pytest.raises(fp.InputError, match=f"^{line}"):
        fp.Constraints(**fields)


def test_the_keywords_are_the_fields():
    assert list(Keywords.__annotations__) == [field.name for field in fields(fp.Constraints) if field.init]


def test_what_is_named_is_kept_by_value():
    """A clearance that happens to be the default is one; None names nothing."""
    kept = fp.Constraints(clearance=0.01, floor=None)
    assert kept.given == {"clearance": 0.01}
    assert fp.Constraints().clearance == kept.clearance == 0.01
    with pytest.raises(fp.InputError, match=r"^clearance: expected one value"):
        gather("plan", kept, {"clearance": 0.02})
    assert gather("plan", kept, {"floor": -1.0}).given == {"floor": -1.0, "clearance": 0.01}


def test_a_lean_is_judged_where_rounding_lifts_the_rod_above_upright():
    packed = fp.State(y=[(0, 0, 1), (1, 0, 0)]).packed()
    packed[0, 20] = np.nextafter(1, 2)  # whose arccosine does not exist
    assert broken(packed, np.ones((2, 4)), HEHN, fp.Constraints(lean=0.2)) == "the rod leans 1.37 rad (78.54°) too far"


def test_a_box_that_changes_later_changes_no_walls():
    box = np.array([[-1.0] * 3, [1.0] * 3])
    kept = fp.Constraints(box=box)
    box[0] = 5.0
    np.testing.assert_array_equal(kept.walls[0], [-1.0] * 3)


MIDDLE, RADIUS = np.array([0.16, 0.0, -0.45]), 0.05  # m: where the bob passes when a plan is free


def away(m):
    """The bob keeps out of a ball."""
    return ca.norm_2(m.x + HEHN.l * m.y - MIDDLE) - RADIUS


def room(plan):
    """How near the bob comes to the ball, m."""
    return np.min(np.linalg.norm(plan.x + HEHN.l * plan.y - MIDDLE, axis=1)) - RADIUS


@pytest.mark.slow  # compiles programs for lanes, which the other test's are not
def test_an_ensemble_keeps_a_constraint_of_ones_own():
    plans = fp.plan_ensemble(HEHN, fp.State(y=[(0, 0, -1), (0.6, 0, -0.8)]), keep=away)
    assert plans.success.all()
    assert min(map(room, plans)) >= -1e-3


def test_a_constraint_of_ones_own_is_kept():
    hanging = fp.State(y=(0, 0, -1))
    free, kept = fp.plan(HEHN, hanging, time_limit=60), fp.plan(HEHN, hanging, keep=away, time_limit=60)
    assert room(free) < -0.01
    assert bool(kept)
    assert room(kept) >= -1e-3
    assert kept.end_error < 0.05  # a swing-up without feedback; as that of other plans


@pytest.mark.parametrize("name", ["crazyflie", "hummingbird"])
def test_a_constraint_of_ones_own_sees_si_units(name):
    """The solver has units of the machine, and the target as its origin."""
    vehicle, rng = fp.vehicle(name), np.random.default_rng(5)

    def keep(m):
        return [
            m.x[0] + 9,
            ca.dot(m.x_dot, m.x) + 99,
            m.R[0, 1] + 2,
            m.omega + 99,
            m.y[2] + 2,
            m.y_dot + 99,
            m.rotor_forces + 1,
        ]

    start = replace(fp.State.random(rng), x=rng.normal(size=3))
    forces = rng.uniform(*vehicle.rotor_limits, len(vehicle.rotor_spins))
    asked = request(vehicle, start, "excursion", (0.3, -0.2, 0.4), forces, fp.Constraints(keep=keep))
    stage = Stage(asked.rotors)
    g = inequalities(stage.before, stage.command, ca.SX(1), ca.SX(asked.numbers), ca.SX(3, 1), asked.structure)
    given = ca.Function("g", [stage.before, stage.command], [g])(asked.start, np.ones(asked.rotors))
    wanted = keep(Motion(start.x, start.x_dot, start.R, start.omega, start.y, start.y_dot, forces))
    wanted = np.concatenate([np.array(value).ravel() for value in wanted])
    np.testing.assert_allclose(np.array(given).ravel()[-len(wanted) :], wanted, rtol=1e-12)


def test_what_is_kept_may_be_of_more_rotors_than_four():
    arms = 0.2 * np.array([(np.cos(k * np.pi / 3), np.sin(k * np.pi / 3), 0) for k in range(6)])
    hexarotor = fp.vehicle("hehn2011").replace(rotor_positions=arms, rotor_spins=[1, -1] * 3)
    start, kept = fp.State(y=(0, 0, -1)), fp.Constraints(keep=lambda m: m.rotor_forces[5] + 1)
    assert request(hexarotor, start, "excursion", (0, 0, 0), np.ones(6), kept).rotors == 6
    with pytest.raises(fp.InputError, match=r"^keep: "):
        request(fp.vehicle("hehn2011"), start, "excursion", (0, 0, 0), np.ones(4), kept)
    with pytest.raises(fp.InputError, match=r"^keep: "):
        fp.Constraints(keep=lambda m: m.rotor_forces[20])
    Expression("rotor_forces[5] > 0.1", "--keep", compares=True)
    with pytest.raises(fp.InputError, match=r"^--keep: "):
        Expression("rotor_forces[20] > 0.1", "--keep", compares=True)


def test_the_same_constraint_written_again_has_the_same_programs():
    first, again, other = (
        request(HEHN, LEANING, "excursion", np.zeros(3), kept=fp.Constraints(keep=keep)).structure
        for keep in (lambda m: m.x[2] + 1.0, lambda m: m.x[2] + 1.0, lambda m: m.x[2] + 1.5)
    )
    assert first == again != other


@pytest.mark.parametrize(
    "keep",
    [
        3, lambda: 1, lambda m: m.z, lambda m: [], lambda m: "high", lambda m: ca.SX.sym("a"), lambda m: None,
        lambda m: m.x[2] > -1, lambda m: [m.y[2] + 1, ca.logic_and(m.x[0] < 1, m.x[0] > -1)],
        lambda m: m.x[2], lambda m: m.x[2] - 1, lambda m: m.y[2] - 1, lambda m: np.nan, lambda m: m.rotor_forces - 1.0,
    ],
)  # fmt: skip
def test_what_cannot_be_kept_is_refused(keep):
    with pytest.raises(fp.InputError, match=r"^keep: "):
        fp.plan(HEHN, LEANING, keep=keep)


def test_a_cost_of_ones_own_is_made_small():
    """A plan that may turn only slowly turns a tenth as fast, and takes more room for it."""
    hanging = fp.State(y=(0, 0, -1))
    free, slow = fp.plan(HEHN, hanging), fp.plan(HEHN, hanging, "cost", cost=lambda m: 0.3 * m.omega)
    assert free
    assert slow
    turned = [np.mean(np.square(plan.omega)) for plan in (free, slow)]
    assert turned[1] < 0.05 * turned[0]
    assert slow.excursion > free.excursion


def test_what_is_no_cost_is_refused():
    for cost in (3, lambda m: m.z, lambda m: []):
        with pytest.raises(fp.InputError, match=r"^cost: "):
            fp.plan(HEHN, LEANING, cost=cost)
    with pytest.raises(fp.InputError, match=r"^cost: expected the cost that is the objective, got nothing"):
        fp.plan(HEHN, LEANING, "cost")
