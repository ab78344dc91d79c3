"""The schedule of commands: steps of a prediction that span several of them."""

import numpy as np
import pytest

from flypend.plants.schedule import Segment, in_steps, segments_ahead

CASES = {
    "12 commands in one step": (0.024, 2e-3, 0.025, [12]),
    "a rest first": (0.025, 2e-3, 0.025, [13]),
    "two steps": (0.048, 2e-3, 0.025, [12, 12]),
    "a command longer than a step": (0.1, 0.05, 0.025, [1, 1, 1, 1]),
    "steps that do not divide it": (0.05, 0.01, 0.02, [2, 1, 2]),
    "nothing": (0.0, 2e-3, 0.025, []),
}


@pytest.mark.parametrize(("latency", "period", "longest", "parts"), CASES.values(), ids=CASES)
def test_steps_span_commands_and_divide_long_ones(latency, period, longest, parts):
    segments = segments_ahead(latency, period)
    steps = in_steps(segments, longest)
    assert [len(step) for step in steps] == parts
    # In order, every command for as long as it is held.
    assert [part.age for step in steps for part in step] == sorted(part.age for step in steps for part in step)[::-1]
    for age, duration in segments:
        assert sum(p.duration for step in steps for p in step if p.age == age) == pytest.approx(duration, abs=1e-15)
    # About as long as allowed at most: by half a command longer.
    assert all(sum(part.duration for part in step) <= longest + period / 2 for step in steps)


def test_random_segments_make_as_few_steps_as_possible():
    rng = np.random.default_rng(7)
    for _ in range(200):
        segments = [Segment(age, duration) for age, duration in enumerate(rng.uniform(1e-4, 4e-3, rng.integers(1, 30)))]
        longest = rng.uniform(5e-3, 0.03)
        steps = in_steps(segments, longest)
        assert len(steps) == np.ceil(sum(segment.duration for segment in segments) / longest)
        assert [part for step in steps for part in step] == segments
