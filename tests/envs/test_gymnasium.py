"""What gymnasium's own interface promises: render modes, the three autoreset modes, wrappers."""

import copy
from dataclasses import replace

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.wrappers import AddRenderObservation, RecordEpisodeStatistics
from gymnasium.wrappers.vector import RecordEpisodeStatistics as RecordVectorStatistics

import flypend as fp
import flypend.envs
from flypend.envs import VectorWorlds, World, track
from flypend.envs.rendering import picture
from flypend.palette import PAGE

SAME, NEXT, DISABLED = AutoresetMode.SAME_STEP, AutoresetMode.NEXT_STEP, AutoresetMode.DISABLED
LOW = np.full((5, 4), -0.7, dtype=np.float32)  # thrust below the weight: worlds end by and by


def colored(image, role):
    """Middle (2,), right and down in pixels, of what is drawn in the color of `role`, and how much there is of it."""
    wanted = [int(PAGE["light"][role][i : i + 2], 16) for i in (1, 3, 5)]
    rows, columns = np.nonzero(np.all(image == wanted, axis=-1))
    return np.array([columns.mean(), rows.mean()]) if len(rows) else None, len(rows)


# Pictures -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["Balance", "SwingUp", "Track", "CatchInCup"])
def test_a_picture_shows_the_rod_where_it_is(name):
    world = gymnasium.make(f"flypend/{name}-v0", render_mode="rgb_array")
    world.reset(seed=1)
    image = world.render()
    assert (image.shape, image.dtype) == ((480, 480, 3), np.uint8)
    (_, down), size = colored(image, "rod")
    y = world.unwrapped.trajectory().y[0]
    assert size > 500
    assert (down < 240) == (y[2] > 0)
    assert np.array_equal(image, world.render())
    for _ in range(20):
        if world.step(world.action_space.low)[2]:
            break
    assert not np.array_equal(image, world.render())


def test_a_ring_is_drawn_at_the_goal():
    """0.3 m to the right of the camera, which follows the pivot; then beside it to the left, then out of sight."""
    vehicle, state = fp.vehicle("hehn2011"), np.append(fp.State(y=(0, 0, 1)).packed(), np.full(4, 1.3))
    right = np.array([np.cos(np.deg2rad(20)), np.sin(np.deg2rad(20)), 0])
    places = [colored(picture(vehicle, state, distance * right), "reference") for distance in (0.3, -0.3, 30.0)]
    assert places[0][0][0] > 260
    assert places[1][0][0] < 220
    assert places[2][1] < places[0][1] + 200  # the line to it alone, up to the border


def test_pictures_of_many_are_those_of_each():
    worlds = gymnasium.make_vec("flypend/Track-v0", 3, render_mode="rgb_array")
    worlds.reset(seed=4)
    alone = World("track", render_mode="rgb_array")
    alone.reset(seed=5)
    for _ in range(30):
        worlds.step(np.zeros((3, 4)))
        alone.step(np.zeros(4))
    assert np.array_equal(worlds.render()[1], alone.render())
    assert not np.array_equal(worlds.render()[0], alone.render())


def test_the_last_picture_of_a_world_is_of_its_end_and_is_part_of_its_state():
    """Not of the new beginning, which the worlds already hold: it is that of the same world if it did not end."""
    world = World("track", render_mode="rgb_array")
    endless = World(replace(track(), ended=lambda now: now.time < 0), render_mode="rgb_array")
    for each in (world, endless):
        each.reset(seed=0)
    while not world.step(np.full(4, -1.0))[2]:
        endless.step(np.full(4, -1.0))
    endless.step(np.full(4, -1.0))
    assert np.array_equal(world.render(), endless.render())
    other = World("track", render_mode="rgb_array")
    other.restore_state(world.save_state())
    assert np.array_equal(other.render(), world.render())


@pytest.mark.filterwarnings("ignore:.*render_mode:UserWarning")  # of gymnasium's own
@pytest.mark.parametrize("make", [gymnasium.make, gymnasium.make_vec])
def test_no_other_mode_is_known(make):
    world = make("flypend/Balance-v0", render_mode=None)
    world.reset()
    assert world.unwrapped.render() is None
    with pytest.raises(fp.InputError, match=r"^render_mode: expected None or 'rgb_array'"):
        make("flypend/Balance-v0", render_mode="ansi")
    with pytest.raises(ResetNeeded):
        make("flypend/Balance-v0", render_mode="rgb_array").unwrapped.render()


def test_a_list_of_pictures_is_one_for_each_step():
    world = gymnasium.make("flypend/Balance-v0", render_mode="rgb_array_list")
    world.reset(seed=0)
    for _ in range(4):
        world.step(world.action_space.sample())
    assert len(world.render()) == 5


def test_libraries_that_try_an_argument_go_on_without_it():
    """As Stable-Baselines3 and TorchRL do: after a TypeError in Python's words."""
    with pytest.raises(TypeError, match="unexpected keyword argument 'frameskip'"):
        gymnasium.make("flypend/Balance-v0", frameskip=1)
    with pytest.raises(fp.InputError, match=r"^raet: .* \(did you mean 'rate'\?\)$"):
        gymnasium.make_vec("flypend/Balance-v0", raet=50)


# Ends ---------------------------------------------------------------------------------------------------------------


def told(worlds, steps):
    """What each world tells under the same action, one observation after the other, those of steps with the rest."""
    seen, _ = worlds.reset(seed=3)
    stories, waiting = [[row.copy()] for row in seen], np.zeros(5, dtype=bool)
    same = worlds.metadata["autoreset_mode"] is SAME
    for _ in range(steps):
        seen, *rest, infos = worlds.step(LOW)
        over = rest[1] | rest[2]
        for i, story in enumerate(stories):
            begun = waiting[i] or (same and over[i])  # what is seen is a beginning
            last = infos["final_obs"][i] if same and over[i] else seen[i]
            if waiting[i]:
                assert [part[i] for part in rest] == [0, False, False]
            else:
                story.append(np.array([*last, *(part[i] for part in rest)]))
            if begun:
                story.append(seen[i].copy())
        waiting = over & (not same)
    return stories


@pytest.mark.parametrize(
    "arguments", [{}, {"history": 2}, {"sensors": "onboard"}, {"randomise": {"delay": (0.0, 0.02)}, "copy": False}]
)
def test_the_same_is_told_a_step_later(arguments):
    """NextStep against SameStep: a world tells the same one after the other, and takes a step more for each end."""
    same, later = (told(VectorWorlds("balance", 5, autoreset_mode=mode, **arguments), 250) for mode in (SAME, NEXT))
    for mine, theirs in zip(same, later, strict=True):
        assert len(mine) > len(theirs) > 240  # some have ended
        assert all(np.array_equal(a, b) for a, b in zip(mine, theirs, strict=False))


@pytest.mark.parametrize("mode", [SAME, NEXT, DISABLED])
def test_first_episodes_are_those_of_gymnasiums_own_vector(mode):
    ours = VectorWorlds("balance", 5, autoreset_mode=mode)
    theirs = SyncVectorEnv([lambda: World("balance")] * 5, autoreset_mode=mode)
    assert ours.metadata["autoreset_mode"] is mode
    assert np.array_equal(ours.reset(seed=3)[0], theirs.reset(seed=3)[0])
    over, ended = np.zeros(5, dtype=bool), 0
    while not over.any():
        mine, others = ours.step(LOW), theirs.step(LOW)
        over = mine[2] | mine[3]
        shown = ~over if mode is SAME else np.ones(5, dtype=bool)  # the second beginning is another
        assert np.array_equal(mine[0][shown], others[0][shown])
        assert all(np.array_equal(a, np.asarray(b, a.dtype)) for a, b in zip(mine[1:4], others[1:4], strict=True))
        ended += over.sum()
    assert ended


def test_without_autoreset_a_mask_says_who_begins():
    worlds = VectorWorlds("balance", 5, autoreset_mode="Disabled")
    worlds.reset(seed=3)
    over = np.zeros(5, dtype=bool)
    while not over.any():
        seen, _, terminated, truncated, infos = worlds.step(LOW)
        over = terminated | truncated
    assert infos == {}
    assert 0 < over.sum() < 5
    with pytest.raises(ResetNeeded, match="have ended"):
        worlds.step(LOW)
    before = worlds.worlds.states
    again, _ = worlds.reset(seed=9, options={"reset_mask": over})
    assert np.array_equal(again[~over], seen[~over])
    assert np.array_equal(worlds.worlds.states[~over], before[~over])
    assert np.array_equal(again[over], VectorWorlds("balance", 5).reset(seed=9)[0][over])
    worlds.step(LOW)


@pytest.mark.parametrize("mask", [[True] * 5, np.ones(4, dtype=bool), np.ones(5), None])
def test_another_mask_is_refused(mask):
    worlds = VectorWorlds("balance", 5)
    worlds.reset(seed=0)
    with pytest.raises(fp.InputError, match=r"^reset_mask: expected an array \(5,\) of bool"):
        worlds.reset(options={"reset_mask": mask})


def test_copies_and_states_of_worlds_that_wait_go_on():
    worlds = VectorWorlds("balance", 5, autoreset_mode=NEXT, history=1)
    worlds.reset(seed=3)
    while not (worlds.worlds.terminated | worlds.worlds.truncated).any():
        worlds.step(LOW)
    twin, third = copy.deepcopy(worlds), VectorWorlds("balance", 5, autoreset_mode=NEXT, history=1)
    third.restore_state(worlds.save_state())
    for _ in range(40):
        results = [made.step(LOW)[:4] for made in (worlds, twin, third)]
        for other in results[1:]:
            assert all(np.array_equal(a, b) for a, b in zip(results[0], other, strict=True))
    with pytest.raises(fp.InputError, match=r"^state\.kind: "):
        VectorWorlds("balance", 5, history=1).restore_state(worlds.save_state())


# Wrappers -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("mode", [SAME, NEXT])
def test_statistics_are_those_of_the_single_world(mode):
    many = RecordVectorStatistics(VectorWorlds("balance", 5, autoreset_mode=mode))
    many.reset(seed=3)
    infos = {}
    while "episode" not in infos:
        *_, infos = many.step(LOW)
    (first, *_) = np.flatnonzero(infos["_episode"])
    one = RecordEpisodeStatistics(gymnasium.make("flypend/Balance-v0"))
    one.reset(seed=3 + int(first))
    told = {}
    while "episode" not in told:
        *_, told = one.step(LOW[0])
    assert infos["episode"]["l"][first] == told["episode"]["l"] > 10
    assert infos["episode"]["r"][first] == pytest.approx(told["episode"]["r"], rel=1e-5)  # float32 sums


def test_pictures_can_be_what_is_observed():
    world = AddRenderObservation(gymnasium.make("flypend/Balance-v0", render_mode="rgb_array"))
    seen, _ = world.reset(seed=0)
    assert seen in world.observation_space
    assert seen.shape == (480, 480, 3)


def test_a_single_world_that_has_ended_waits_for_a_reset():
    world = World("balance")
    world.reset(seed=0)
    while not world.step(np.zeros(4))[2]:
        pass
    saved = world.save_state()
    with pytest.raises(ResetNeeded):
        world.step(np.zeros(4))
    other = World("balance")
    other.restore_state(saved)
    with pytest.raises(ResetNeeded):
        other.step(np.zeros(4))
    world.reset()
    world.step(np.zeros(4))
