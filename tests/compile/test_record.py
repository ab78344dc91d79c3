"""A record: one table of offsets for equations, kernels and C."""

import casadi as ca
import numpy as np
import pytest

from flypend.compile.record import Field, Record

INNER = Record("inner", "A part.", (Field("a", 2, "m"), Field("b", 0, "s")))
OUTER = Record("outer", "The whole.", (Field("first", 3, "N"), Field.of(INNER), Field("last", 0, "kg")))


def test_fields_follow_one_another_without_a_gap():
    where = [place for _, _, place in OUTER.leaves()]
    assert [(place.start, place.stop) for place in where] == [(0, 3), (3, 5), (5, 6), (6, 7)]
    assert [path for path, _, _ in OUTER.leaves()] == ["first", "inner.a", "inner.b", "last"]
    assert OUTER.length == 7


def test_a_part_lies_where_its_path_says():
    assert (OUTER.place("inner"), OUTER.place("inner.b")) == (slice(3, 6), slice(5, 6))
    with pytest.raises(StopIteration):
        OUTER.place("inner.last")


def test_what_is_split_joins_to_the_same_numbers():
    numbers = np.arange(7.0)
    parts = OUTER.split(numbers)
    assert parts["last"] == 6
    assert list(INNER.split(parts["inner"])["a"]) == [3, 4]
    np.testing.assert_array_equal(np.asarray(OUTER.join(parts)).ravel(), numbers)
    swapped = {name: parts[name] for name in reversed(parts)}  # names decide, not the order
    np.testing.assert_array_equal(np.asarray(OUTER.join(swapped)).ravel(), numbers)
    symbols = ca.MX.sym("m", 7)
    again = ca.Function("again", [symbols], [OUTER.join(OUTER.split(symbols))])
    np.testing.assert_array_equal(np.asarray(again(numbers)).ravel(), numbers)
