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


def test_the_mean_of_seeds_has_students_interval():
    """Of 400, 410 and 420 it is 410 ± 4.303 · 10/√3, not the 1.96 of many seeds."""
    seeds = [(400.0, 190, 1000, 60.0, 61.0), (410.0, 200, 2000, 70.0, 71.0), (420.0, 198, 3000, 80.0, 81.0)]
    told = scores.mean_of("ppo", seeds, 200, 500.0)
    assert told == "| ppo, mean of 3 seeds | 410 (385 to 435) | 82% | 588 of 600 | | 2,000 | 70 | 71 |"
