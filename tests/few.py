"""Parameters of tests: some combinations in every run, all others in the slow one."""

from itertools import product

import pytest


def slow(*values):
    """Parameters of a slow test."""
    return pytest.param(*values, marks=pytest.mark.slow)


def few(kept, *axes):
    """All combinations of the values of the `axes`, of one axis its values; those that are not in `kept` are slow."""
    kept = list(kept) if len(axes) > 1 else [(value,) for value in kept]
    return [pytest.param(*one) if one in kept else slow(*one) for one in product(*axes)]


def each_once(*axes):
    """As `few`: the axes go in step, a shorter one from its start again."""
    axes = [list(axis) for axis in axes]
    return few([tuple(axis[i % len(axis)] for axis in axes) for i in range(max(map(len, axes)))], *axes)
