"""Worlds with derivatives: the step is that of the vector environment, its gradient that of finite differences."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import flypend as fp
from flypend.compile.llvm.worlds import BOUND
from flypend.envs import DifferentiableWorlds, VectorWorlds

KINDS = {
    "rotors": {},
    "late": {"randomise": {"mass": (0.9, 1.1), "lag": (0.8, 1.2), "delay": (0.0, 0.02), "wind": (0.0, 0.1)}},
    "rates": {"action": "rates"},
    "late rates": {"action": "rates", "randomise": {"delay": (0.005, 0.02)}},
    "wrench": {"action": "wrench", "attitude": "6d"},
    "track": {"task": "track"},
}
COUNT = 11  # one group, and three worlds of the next


def made(kind, steps=7):
    """Worlds of this kind after some steps, the same of the vector environment, and its last results."""
    arguments = {"task": "balance"} | KINDS[kind]
    worlds, vector = DifferentiableWorlds(**arguments), VectorWorlds(num_envs=COUNT, **arguments)
    memory, seen = worlds.begin(range(3, 3 + COUNT))
    assert np.array_equal(seen, vector.reset(seed=3)[0])
    rng = np.random.default_rng(0)
    for _ in range(steps):
        actions = rng.uniform(-0.8, 0.8, (COUNT, 4)).astype(np.float32)
        found, results = worlds.step(memory, actions), vector.step(actions)
        memory = found.memory
    assert not (results[2] | results[3]).any()
    return worlds, vector, found, results


@pytest.mark.parametrize("kind", KINDS)
def test_a_step_is_that_of_the_vector_environment(kind):
    _, vector, found, results = made(kind)
    assert np.allclose(found.memory[:, 1:29], vector.worlds.states, rtol=0, atol=1e-12)  # roundoff of 70 steps
    assert np.allclose(found.observations, results[0], rtol=1e-6, atol=1e-6)  # of single precision there
    assert np.allclose(found.rewards, results[1], rtol=1e-6, atol=1e-7)
    assert not found.ended.any()


@pytest.mark.parametrize("kind", KINDS)
def test_the_gradient_is_that_of_finite_differences(kind):
    """With respect to every number of the memory but the delay, which counts whole steps, and to every action."""
    worlds, _, found, _ = made(kind)
    rng = np.random.default_rng(1)
    to_memory, to_seen, to_reward = (rng.standard_normal(part.shape) for part in found[:3])
    actions = rng.uniform(-0.8, 0.8, (COUNT, 4))

    def total(memory, actions):
        after, seen, reward, _ = worlds.step(memory, actions)
        return (to_memory * after).sum(1) + (to_seen * seen).sum(1) + to_reward * reward

    memory, h = found.memory, 1e-6
    by_memory, by_actions = worlds.pullback(memory, actions, to_memory, to_seen, to_reward)
    goal = 1 if kind == "track" else 0
    delay = memory.shape[1] - 1 - goal
    for i in set(range(memory.shape[1])) - {delay}:
        way = h * np.eye(memory.shape[1])[i]
        difference = (total(memory + way, actions) - total(memory - way, actions)) / (2 * h)
        # Differences err by rounding / h, 1e-9 of the total, and by h² of the third derivative.
        assert np.allclose(by_memory[:, i], difference, rtol=1e-5, atol=1e-6), i
    for i in range(4):
        way = h * np.eye(4)[i]
        difference = (total(memory, actions + way) - total(memory, actions - way)) / (2 * h)
        assert np.allclose(by_actions[:, i], difference, rtol=1e-5, atol=1e-6), i


def test_a_limited_action_has_no_gradient():
    worlds, _, found, _ = made("rotors")
    actions = np.tile([2.0, -2.0, 0.1, 0.1], (COUNT, 1))
    same = worlds.step(found.memory, np.clip(actions, -1, 1))
    assert np.array_equal(worlds.step(found.memory, actions).memory, same.memory)
    _, by_actions = worlds.pullback(found.memory, actions, *(np.ones_like(part) for part in found[:3]))
    assert (by_actions[:, :2] == 0).all()
    assert (by_actions[:, 2:] != 0).all()


@pytest.mark.parametrize("how", ["action", "state"])
def test_a_lost_world_stays_and_passes_no_gradient(how):
    """And the others go on, to the bit, with the gradients that they have by themselves."""
    worlds, _, found, _ = made("rotors")
    memory, actions, ones = found.memory.copy(), np.full((COUNT, 4), 0.1), [np.ones_like(part) for part in found[:3]]
    well, gradient = worlds.step(memory, actions), worlds.pullback(memory, actions, *ones)
    if how == "action":
        actions[2, 1] = np.nan
    else:
        memory[2, 1] = 2 * BOUND
    lost, cut = worlds.step(memory, actions), worlds.pullback(memory, actions, *ones)
    others = np.arange(COUNT) != 2
    assert lost.ended.tolist() == [i == 2 for i in range(COUNT)]
    assert np.array_equal(lost.memory[2], memory[2])
    assert np.isfinite(lost.observations).all()
    assert np.isfinite(lost.rewards).all()
    for mine, whole in zip((*lost[:3], *cut), (*well[:3], *gradient), strict=True):
        assert np.array_equal(mine[others], whole[others])
    assert not np.any(cut[0][2])
    assert not np.any(cut[1][2])


def test_a_world_that_has_ended_says_so_and_goes_on():
    worlds, _, found, _ = made("rotors")
    memory = found.memory.copy()
    memory[4, 1] = 3.5  # m: beyond the 3 m of the task
    after = worlds.step(memory, np.zeros((COUNT, 4)))
    assert after.ended.tolist() == [i == 4 for i in range(COUNT)]
    assert not np.array_equal(after.memory[4], memory[4])


def test_threads_change_no_bit():
    memory, _ = DifferentiableWorlds("balance").begin(range(300))
    actions = np.random.default_rng(0).uniform(-1, 1, (300, 4))
    alone, both = (DifferentiableWorlds("balance", workers=n).step(memory, actions) for n in (1, 2))
    assert all(np.array_equal(a, b) for a, b in zip(alone, both, strict=True))


def test_jax_differentiates_a_flight():
    """Through `jit` and `scan`, against differences of the whole flight in double precision."""
    worlds = DifferentiableWorlds("balance")
    begun, _ = worlds.begin(range(COUNT))

    def paid(actions):
        def advance(memory, action):
            found = worlds.jax(memory, jnp.tile(action, (COUNT, 1)))
            return found.memory, found.rewards.mean()

        return jax.lax.scan(advance, jnp.asarray(begun), actions)[1].sum()

    with jax.enable_x64(True):
        actions = 0.1 * np.random.default_rng(2).standard_normal((5, 4))
        gradient = np.asarray(jax.jit(jax.grad(paid))(jnp.asarray(actions)))
        h, way = 1e-5, np.random.default_rng(3).standard_normal((5, 4))
        difference = (paid(jnp.asarray(actions + h * way)) - paid(jnp.asarray(actions - h * way))) / (2 * h)
        assert np.sum(gradient * way) == pytest.approx(float(difference), rel=1e-6)  # h² of the third derivative
    single = jax.grad(paid)(jnp.asarray(actions, dtype=jnp.float32))
    assert single.dtype == jnp.float32
    assert np.allclose(single, gradient, rtol=1e-3, atol=1e-5)  # the memory is rounded five times


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"mount": "hub"}, "mount"),
        ({"sensors": "mocap"}, "sensors"),
        ({"plant": fp.Plant(rate=1000, floor=-1)}, "plant.floor"),
        ({"workers": 0}, "workers"),
        ({"raet": 1}, "raet"),
    ],
)
def test_what_has_no_derivative_is_refused(arguments, field):
    with pytest.raises(fp.InputError, match=rf"^{field}: "):
        DifferentiableWorlds("balance", **arguments)


@pytest.mark.parametrize(("memory", "actions", "field"), [(3, (3, 4), "memory"), (None, (2, 4), "actions")])
def test_rows_of_another_shape_are_refused(memory, actions, field):
    worlds = DifferentiableWorlds("balance")
    given = np.zeros((3, worlds.size)) if memory is None else np.zeros(memory)
    with pytest.raises(fp.InputError, match=rf"^{field}: "):
        worlds.step(given, np.zeros(actions))


@pytest.mark.parametrize("seeds", [[-1], [1.5], [], 3, np.array(3), [2**63]])
def test_a_seed_that_is_none_is_refused(seeds):
    with pytest.raises(fp.InputError, match=r"^seeds: "):
        DifferentiableWorlds("balance").begin(seeds)
