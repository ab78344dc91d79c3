"""An environment is a value: copies, saved states and forks go on bit for bit, or one line refuses."""

import copy
import pickle
from dataclasses import replace
from functools import partial

import cloudpickle
import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.vector import AsyncVectorEnv, SyncVectorEnv

import flypend as fp
from benchmarks.copies import Attack, bits, went_on
from flypend.envs import VectorWorlds, World, swing_up
from flypend.envs.make import PHYSICS

# A process with threads forks: Python 3.12 warns of what is tested here.
pytestmark = pytest.mark.filterwarnings("ignore:.*multi-threaded, use of fork:DeprecationWarning")


def some_actions(steps, *shape):
    return np.random.default_rng(0).uniform(-0.6, 0.4, (steps, *shape, 4)).astype(np.float32)


@pytest.fixture
def attack():
    made = Attack(seed=0, tasks=("balance",))
    yield made
    made.close()


def test_copies_go_on_bit_for_bit(attack):
    """Each way of copying with each shape, at random moments; 1,000 are `python -m benchmarks.copies`."""
    assert [attack.copy(number)[1] for number in range(32)] == [""] * 32


@pytest.mark.slow
def test_a_thousand_copies_of_all_tasks_do():
    attack = Attack(seed=1)
    assert {attack.copy(number)[1] for number in range(1000)} == {""}
    attack.close()


def test_a_state_is_restored_as_often_as_one_likes():
    world, actions = World("track", sensors="onboard"), some_actions(60)
    world.reset(seed=4)
    went_on(world, actions[:20])
    state = world.save_state()
    ends = [went_on(world, actions[20:])]
    for _ in range(2):
        world.restore_state(state)
        assert world.save_state() == state
        ends.append(went_on(world, actions[20:]))
    assert ends[0] == ends[1] == ends[2]
    assert ends[0][1] != state


def test_what_has_been_flown_is_part_of_a_state():
    world, other = World("balance"), World("balance")
    world.reset(seed=0)
    went_on(world, some_actions(10))
    other.restore_state(world.save_state())
    assert np.array_equal(other.trajectory().packed, world.trajectory().packed)
    assert len(other.trajectory().t) == 11


@pytest.mark.parametrize("made", [partial(World, "balance"), partial(VectorWorlds, "balance", 3)])
def test_resets_without_a_seed_go_on_too(made):
    """Before the first seed as well: a generator that is seeded when first used would differ between copies."""
    env = made()
    twins = [copy.deepcopy(env), pickle.loads(pickle.dumps(env)), made()]
    twins[2].restore_state(env.save_state())
    first, second = bits(env.reset()), bits(env.reset())
    assert first != second
    assert [(bits(twin.reset()), bits(twin.reset())) for twin in twins] == [(first, second)] * 3
    assert {twin.np_random_seed for twin in twins} == {env.np_random_seed}


def test_a_state_before_the_first_reset_is_one():
    for env in (World("balance"), VectorWorlds("balance", 2)):
        fresh = env.save_state()
        env.reset(seed=0)
        env.restore_state(fresh)
        with pytest.raises(ResetNeeded):
            env.step(np.zeros(env.action_space.shape))


def test_a_generator_of_another_kind_is_kept_and_not_mixed_up():
    world, other = World("balance"), World("balance")
    for env in (world, other):
        env.np_random = np.random.Generator(np.random.MT19937(3))
    world.reset()
    other.restore_state(world.save_state())
    assert bits(other.reset()) == bits(world.reset())
    with pytest.raises(fp.InputError, match=r"^state\.generator: "):
        World("balance").restore_state(world.save_state())


# Memory --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("history", [0, 2])
def test_views_follow_a_state_that_is_restored_but_no_copy(history):
    worlds, actions = VectorWorlds("balance", 9, copy=False, history=history), some_actions(3, 9)
    worlds.reset(seed=0)
    seen, rewards, *_ = worlds.step(actions[0])
    state, there = worlds.save_state(), bits((seen, rewards))
    twin = copy.deepcopy(worlds)
    worlds.step(actions[1])
    assert bits((seen, rewards)) != there
    worlds.restore_state(state)
    assert bits((seen, rewards)) == there
    assert np.shares_memory(worlds.step(actions[2])[0], seen)
    there = bits((seen, rewards))
    assert not np.shares_memory(twin.step(actions[1])[0], seen)
    assert bits((seen, rewards)) == there


def test_what_was_returned_as_a_copy_never_changes():
    worlds, actions = VectorWorlds("balance", 9, duration=0.02, history=1), some_actions(4, 9)
    given = [worlds.reset(seed=0), worlds.step(actions[0]), worlds.step(actions[1])]
    assert "final_obs" in given[2][4]
    before, state = bits(tuple(given)), worlds.save_state()
    worlds.step(actions[2])
    worlds.restore_state(state)
    worlds.reset()
    assert bits(tuple(given)) == before


def test_infos_are_copies_even_if_nothing_else_is():
    worlds, actions = VectorWorlds("balance", 9, duration=0.02, copy=False), some_actions(4, 9)
    worlds.reset(seed=0)
    worlds.step(actions[0])
    infos = worlds.step(actions[1])[4]
    before = bits(infos)
    worlds.step(actions[2])
    worlds.step(actions[3])
    assert bits(infos) == before


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
def test_memory_of_copies_begins_where_jax_shares_it(copied):
    """At multiples of 64 bytes; several, as an array of NumPy does by chance one time in four."""
    for count in (3, 8, 40, 1000):
        twin = copied(VectorWorlds("balance", count, copy=False, history=1))
        arrays = twin.reset(seed=0)[0], *twin.step(np.zeros((count, 4)))[:4]
        assert [array.ctypes.data % 64 for array in arrays] == [0] * 5


# Other processes and wrappers ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("context", ["fork", "spawn"])
def test_gymnasium_steps_it_in_other_processes(context):
    """States travel both ways; processes are given the task itself, not its name."""
    actions, made = some_actions(30, 2), partial(World, swing_up(), duration=0.2)
    alone = SyncVectorEnv([made, made])
    several = AsyncVectorEnv([made, made], context=context)
    try:
        assert bits(several.reset(seed=3)) == bits(alone.reset(seed=3))
        for action in actions:
            assert bits(several.step(action)) == bits(alone.step(action))
        states = several.call("save_state")
        assert states == tuple(env.save_state() for env in alone.envs)
        several.step(actions[0])
        several.call("restore_state", states[1])
        assert several.call("save_state") == (states[1], states[1])
    finally:
        several.close()


@pytest.mark.parametrize("context", ["fork", "spawn"])
def test_so_it_does_by_name(context):
    several = gymnasium.make_vec(
        "flypend/Balance-v0", 2, vectorization_mode="async", vector_kwargs={"context": context}
    )
    alone = gymnasium.make_vec("flypend/Balance-v0", 2, vectorization_mode="vector_entry_point")
    try:
        assert bits(several.reset(seed=1)) == bits(alone.reset(seed=1))
        action = some_actions(1, 2)[0]
        assert bits(several.step(action)[:4])[0] == bits(alone.step(action)[:4])[0]
    finally:
        several.close()


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
def test_a_vector_of_gymnasium_is_copied_with_a_new_beginning_due(copied):
    """In the mode NEXT_STEP an ended world begins with the next action."""
    alone, actions = SyncVectorEnv([partial(World, "balance", duration=0.05)] * 2), some_actions(12, 2)
    alone.reset(seed=0)
    assert any(alone.step(action)[3].all() for action in actions[:5])
    twin = copied(alone)
    answers = [bits(twin.step(action)) for action in actions[5:]]
    assert [bits(alone.step(action)) for action in actions[5:]] == answers


def test_a_task_without_a_name_is_copied_and_not_pickled():
    task = replace(swing_up(), reward=lambda now: now.state.y[2])
    world = World(task)
    world.reset(seed=0)
    twins = [copy.deepcopy(world), pickle.loads(cloudpickle.dumps(world))]
    assert bits(twins[0].step(np.zeros(4))) == bits(twins[1].step(np.zeros(4))) == bits(world.step(np.zeros(4)))
    with pytest.raises((AttributeError, pickle.PicklingError), match="lambda"):
        pickle.dumps(world)


# What is refused -----------------------------------------------------------------------------------------------------

VEHICLE = fp.vehicle("hehn2011")


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"task": "swing_up"}, "task"), ({"vehicle": "x500"}, "vehicle"), ({"rate": 50.0}, "rate"),
        ({"vehicle": VEHICLE.replace(mass=1.001 * VEHICLE.mass)}, "programs"), ({"mount": "hub"}, "programs"),
        ({"plant": PHYSICS.replace(lag=0.03)}, "plant"), ({"action": "rates"}, "action"), ({"num_envs": 4}, "worlds"),
        ({"sensors": "mocap"}, "sensors"), ({"randomise": {"mass": (0.9, 1.1)}}, "randomise"),
        ({"duration": 4.0}, "programs"), ({"history": 1}, "history"), ({"attitude": "6d"}, "attitude"),
    ],
)  # fmt: skip
def test_a_state_of_others_is_refused(arguments, field):
    worlds, others = VectorWorlds("balance", 3), VectorWorlds(**({"task": "balance", "num_envs": 3} | arguments))
    worlds.reset(seed=0)
    others.reset(seed=1)
    before = others.save_state()
    with pytest.raises(fp.InputError, match=rf"^state\.{field}: .+$"):
        others.restore_state(worlds.save_state())
    assert others.save_state() == before


def test_a_single_environment_takes_no_state_of_several():
    with pytest.raises(fp.InputError, match=r"^state\.kind: "):
        World("balance").restore_state(VectorWorlds("balance", 1).save_state())


@pytest.mark.parametrize("part", ["worlds", "flown", "generator", "about"])
def test_a_damaged_state_is_refused(part):
    world = World("balance")
    world.reset(seed=0)
    state = world.save_state()
    whole = getattr(state, part)
    for damaged in (whole[:-1], whole[1:], whole + whole[-1:]):
        with pytest.raises(fp.InputError, match=r"^state: "):
            world.restore_state(replace(state, **{part: damaged}))
    assert world.save_state() == state


@pytest.mark.parametrize("given", [None, b"", {}, 3])
def test_anything_else_is_no_state(given):
    with pytest.raises(fp.InputError, match=r"^state: "):
        World("balance").restore_state(given)


def test_a_state_of_another_version_is_refused():
    world = World("balance")
    state = world.save_state()
    other = tuple((name, "0.1" if name == "version" else value) for name, value in state.about)
    with pytest.raises(fp.InputError, match=r"^state\.version: "):
        world.restore_state(replace(state, about=other).with_checksum())
    rebuild, (about, *rest) = world.worlds.__reduce__()
    with pytest.raises(fp.InputError, match=r"^state\.version: "):
        rebuild(about | {"version": "0.1"}, *rest)
