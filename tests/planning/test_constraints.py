"""One record for what a flight keeps, or its fields one by one."""

import numpy as np
import pytest

import flypend as fp
from flypend.planning.constraints import Keywords, gathered

HEHN = fp.vehicle("hehn2011")
LEANING = fp.State(y=(np.sin(0.3), 0, np.cos(0.3)))


def test_fields_one_by_one_and_in_a_record_make_the_same_plan():
    kept = fp.Constraints(floor=-0.5, speed=3.0)
    one = fp.plan(HEHN, LEANING, constraints=kept, time_limit=60)
    other = fp.plan(HEHN, LEANING, floor=-0.5, speed=3.0, time_limit=60)
    np.testing.assert_array_equal(one.x, other.x)
    starts = fp.State.from_packed(LEANING.packed()[None])
    one, other = fp.plan_ensemble(HEHN, starts, constraints=kept), fp.plan_ensemble(HEHN, starts, floor=-0.5, speed=3.0)
    np.testing.assert_array_equal(one[0].x, other[0].x)


def test_a_record_and_further_fields_add_up():
    kept = gathered("plan", fp.Constraints(floor=-0.5), {"ceiling": 1.0})
    assert kept.given == {"floor": -0.5, "ceiling": 1.0}
    np.testing.assert_array_equal(kept.walls[:, 2], [-0.5, 1.0])
    assert gathered("plan", None, {}).given == {}


@pytest.mark.parametrize("function", [fp.plan, fp.plan_ensemble, fp.plan_and_track, fp.nmpc])
def test_each_function_takes_both_and_refuses_a_field_in_both(function):
    first = {fp.plan: (HEHN, LEANING), fp.plan_ensemble: (HEHN, fp.random_starts(2, 1))}.get(function, ())
    with pytest.raises(fp.InputError, match=r"^clearance: expected one value"):
        function(*first, constraints=fp.Constraints(clearance=0.02), clearance=0.03)
    with pytest.raises(fp.InputError, match=r"\.clearence: .*did you mean 'clearance'"):
        function(*first, clearence=0.03)
    with pytest.raises(fp.InputError, match=r"^constraints"):
        function(*first, constraints={"floor": 1.0})


def test_nmpc_says_what_it_cannot_keep():
    with pytest.raises(fp.InputError, match=r"^floor: .*clearance alone"):
        fp.nmpc(HEHN, constraints=fp.Constraints(floor=-1.0))


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
    assert list(Keywords.__annotations__) == list(fp.Constraints.__dataclass_fields__)
