"""The table of scores: returns are those of the first episode, laws and plans know where and how worlds begin."""

import numpy as np
import pytest

from benchmarks import scores
from flypend.envs import World


def test_a_score_is_the_return_of_the_first_episode():
    found = scores.scored("balance", scores.random_actions(seed=4), 1, seed=9)
    world, draw, total, over = World("balance"), np.random.default_rng(4), 0.0, False
    world.reset(seed=9)
    while not over:
        _, reward, terminated, truncated, _ = world.step(draw.uniform(-1, 1, 4))
        total, over = total + reward, terminated or truncated
    assert found.returns == pytest.approx([total])
    assert not found.up.any()


@pytest.mark.parametrize(("task", "name", "least"), [("balance", "plan", 430), ("track", "inverted", 900)])
def test_laws_and_plans_are_paid_for_what_they_do(task, name, least):
    """On the circle, each world flies its own part of it: without the phase, the vehicle is up to a metre off.

    A plan that may let the rod fall ends a world.
    """
    found = scores.scored(task, scores.policy_of(name), 4, scores.SEED)
    assert found.up.all()
    assert found.returns.min() > least
