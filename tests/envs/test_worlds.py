"""Worlds stepped by the kernel: the physics of `simulate`, seeds, ends, rewards, and what differs between them."""

import copy
import inspect
import pickle
import re
from dataclasses import replace

import casadi as ca
import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import check_env

import flypend as fp
from benchmarks import omnidrones_tasks
from flypend.envs import DifferentiableWorlds, Randomisation, VectorWorlds, World, balance, environment
from flypend.envs.draws import Draws
from flypend.envs.kernel import Worlds
from flypend.envs.make import PHYSICS
from flypend.envs.make import TASKS as BUILT_IN
from flypend.envs.task import Begin
from flypend.flight.tasks import touches
from flypend.laws import Controller
from flypend.model.rod import stretch

VEHICLE = fp.vehicle("hehn2011")
AT_ONCE = PHYSICS.replace(lag=0.0)  # rotors that begin with the hover of another vehicle soon do the same
OMNIDRONES = [make() for make in omnidrones_tasks.TASKS.values()]
TASKS = [*BUILT_IN, *OMNIDRONES]
NAMES = [getattr(task, "name", None) or task.title().replace("_", "") for task in TASKS]


def replayed(start, commands, plant, vehicle=VEHICLE, hold=1):
    """States and rotor forces of a flight by `simulate` under rotor `commands`, each held for `hold` ticks."""

    class Table:
        def __init__(self, loop, rotors):
            self.tick = 0

        def command(self, t, measured):
            self.tick += 1
            return commands[(self.tick - 1) // hold]

    law = Controller(name="table", function=lambda t, s: fp.Wrench(0.0, np.zeros(3)), flight_computer=Table)
    duration = len(commands) * hold / plant.rate
    run = fp.simulate(vehicle, law, start, duration, plant=plant)
    return np.concatenate([run.packed, run.rotor_forces], axis=1)


def forces_of(actions, vehicle=VEHICLE):
    low, high = vehicle.rotor_limits
    return low + (high - low) * (actions.astype(float) + 1) / 2


def rates_of(actions, vehicle=VEHICLE):
    """Thrust and body rates of the action "rates"."""
    actions, most = actions.astype(float), len(vehicle.rotor_spins) * vehicle.rotor_limits[1]
    return np.hstack([most * (actions[:, :1] + 1) / 2, 12.0 * actions[:, 1:]])


def some_actions(steps, count, seed=0, size=0.2):
    """Actions about hover."""
    low, high = VEHICLE.rotor_limits
    hover = 2 * (VEHICLE.weight / 4 - low) / (high - low) - 1
    noise = np.random.default_rng(seed).uniform(-size, size, (steps, count, 4))
    return np.clip(hover + noise, -1, 1).astype(np.float32)


@pytest.mark.parametrize(
    "changes", [{}, {"sag": 0.1, "spin_up": 1.5}, {"pivot_offset": (0.01, 0, 0.02)}, {"air": "all"}, {"lag": 0.0}]
)
def test_a_world_flies_as_simulate_does_bit_for_bit(changes):
    plant = PHYSICS.replace(**changes)
    world = World("swing_up", plant=plant)
    world.reset(seed=5)
    begin = world.worlds.states[0]
    actions = some_actions(100, 1)[:, 0]
    states = [begin]
    for action in actions:
        world.step(action)
        states.append(world.worlds.states[0])
    # The rotors of a world begin at hover; those of a flight at rest.
    flown = from_hover(begin, forces_of(actions), plant)
    assert np.array_equal(states, flown)


def test_a_world_ends_on_its_floor():
    """Without thrust, a hanging rod lands, first in one world and not at all in the other."""
    ends = {}
    for floor in (None, -0.8):
        world = World("swing_up", plant=PHYSICS.replace(floor=floor))
        world.reset(seed=5)
        ends[floor] = any(world.step(np.full(4, -1, dtype=np.float32))[2] for _ in range(20))
    assert ends == {None: False, -0.8: True}


@pytest.mark.parametrize("drawn", [True, False])
def test_the_rod_that_flies_lands(drawn):
    """A rod of 0.85 m instead of 0.565 m reaches a floor 0.8 m below, and a task sees its end there."""
    task, plant = replace(BUILT_IN["swing_up"](), shown=lambda now: now.end), PHYSICS.replace(floor=-0.8)
    known = World(task, plant=plant)
    if drawn:
        other = World(task, plant=plant, randomise={"rod_length": (1.5, 1.5)})
    else:
        other = World(task, plant=plant.replace(mismatch={"rod_length": 1.5}))
    known.reset(seed=5)
    seen, _ = other.reset(seed=5)
    state = other.worlds.states[0]
    assert np.allclose(seen[-3:], state[:3] + 1.5 * VEHICLE.reach * state[18:21], atol=1e-6)
    assert not known.step(np.zeros(4))[2]
    assert other.step(np.zeros(4))[2]


@pytest.mark.parametrize(
    ("task", "mount", "drawn", "written"),
    [
        ("catch_in_cup", "cup", {"randomise": {"bob_mass": (1.3, 1.3), "rod_length": (1.5, 1.5)}},
         {"bob_mass": 1.3 * VEHICLE.bob_mass, "rod_length": 1.5 * VEHICLE.rod_length}),
        ("swing_up", "hub", {"plant": AT_ONCE.replace(pivot_offset=(0, 0, 0.05))}, {"pivot_offset": (0, 0, 0.05)}),
    ],
    ids=["cup", "hub"],
)  # fmt: skip
def test_a_rod_touches_the_vehicle_that_flies(task, mount, drawn, written):
    """The same ends as those of a vehicle that is written so; others than those of the nominal one."""
    worlds = [
        VectorWorlds(
            task, 400, mount=mount, autoreset_mode="NextStep", vehicle=vehicle, **({"plant": AT_ONCE} | arguments)
        )
        for vehicle, arguments in ((VEHICLE, drawn), (VEHICLE.replace(**written), {}), (VEHICLE, {}))
    ]
    for each in worlds:
        each.reset(seed=0)
    rng, ends = np.random.default_rng(1), np.zeros((3, 400), dtype=int)
    for k in range(80):
        action = rng.uniform(-1, 0.6, (400, 4))
        over = np.array([each.step(action)[2] for each in worlds])
        ends[over & (ends == 0)] = k + 1
    assert np.array_equal(ends[0], ends[1])
    assert (ends[0] != ends[2]).sum() > 10


@pytest.mark.parametrize("task", OMNIDRONES, ids=lambda task: task.name)
def test_so_does_a_world_of_omnidrones_every_16_ms(task):
    world = World(task, randomise={})
    world.reset(seed=5)
    vehicle, states = world.worlds.env.vehicle, [world.worlds.states[0]]
    hover = vehicle.weight / vehicle.rotor_limits[1] / 2 - 1
    actions = (hover + np.random.default_rng(0).uniform(-0.1, 0.1, (25, 4))).astype(np.float32)
    assert not any(world.step(action)[2] or states.append(world.worlds.states[0]) for action in actions)
    assert np.array_equal(states, from_hover(states[0], forces_of(actions, vehicle), PHYSICS, vehicle, hold=16))


def from_hover(begin, commands, plant, vehicle=VEHICLE, hold=10):
    """The same flight by the steps of `simulate`, from rotors that already turn; each command is held for ticks."""
    from flypend.plants.actuation import Actuation, make_engine

    true = plant.true_vehicle(vehicle)
    engine = make_engine(true, plant)
    engine.reset(begin[:24], begin[24:])
    acting, states = Actuation(engine, vehicle, plant), [begin]
    for command in commands:
        for _ in range(hold):
            acting.advance(command, 1 / plant.rate, np.zeros(6))
        states.append(np.append(engine.packed, engine.rotors))
    return np.array(states)


def test_a_flight_by_simulate_has_the_same_states():
    """From rotors at their least, to which a flight's are set."""
    worlds = Worlds(environment("balance"), 1)
    worlds.begin(np.array([3]))
    start = fp.State.from_packed(worlds.states[0, :24])
    commands = forces_of(some_actions(20, 1)[:, 0])
    flown = replayed(start, commands, PHYSICS, hold=10)
    least = np.append(start.packed(), np.full(4, VEHICLE.rotor_limits[0]))
    assert np.array_equal(flown, from_hover(least, commands, PHYSICS))


@pytest.mark.parametrize("name", NAMES)
def test_gymnasium_has_nothing_to_say(name, recwarn):
    made = gymnasium.make(f"flypend/{name}-v0")
    check_env(made.unwrapped)
    assert not recwarn.list
    vector = gymnasium.make_vec(f"flypend/{name}-v0", 3, vectorization_mode="vector_entry_point")
    seen, _ = vector.reset(seed=1)
    assert seen in vector.observation_space
    assert vector.step(vector.action_space.sample())[0] in vector.observation_space


@pytest.mark.parametrize("task", TASKS, ids=NAMES)
def test_a_world_is_the_same_whatever_surrounds_it(task):
    alone, many, split = World(task), VectorWorlds(task, 300, workers=1), VectorWorlds(task, 300, workers=2)
    actions = some_actions(120, 300, size=0.6)
    first, _ = alone.reset(seed=11)
    seen, again = many.reset(seed=11)[0], split.reset(seed=11)[0]
    assert np.array_equal(seen[0], first)
    over = False
    for action in actions:
        results, others = many.step(action), split.step(action)
        assert all(np.array_equal(a, b) for a, b in zip(results[:4], others[:4], strict=True))
        if not over:
            one = alone.step(action[0])
            over = one[2] or one[3]
            last = results[4]["final_obs"][0] if over else results[0][0]
            assert np.array_equal(one[0], last)
            assert (one[1], one[2], one[3]) == tuple(result[0] for result in results[1:4])
    assert np.array_equal(seen, again)


def test_seeds_are_exact_and_differ():
    worlds = VectorWorlds("swing_up", 16)
    a, b, c = worlds.reset(seed=4)[0], worlds.reset(seed=4)[0], worlds.reset(seed=5)[0]
    assert np.array_equal(a, b)
    assert np.array_equal(a[1:], c[:-1])  # world i has seed + i
    assert not np.array_equal(worlds.reset()[0], worlds.reset()[0])
    assert len(np.unique(a[:, 0])) == 16


def test_a_world_that_ends_begins_anew_and_differently():
    worlds = VectorWorlds("balance", 64)
    worlds.reset(seed=0)
    down = -np.ones((64, 4), dtype=np.float32)
    begun = []
    for _ in range(300):
        seen, _, terminated, _, infos = worlds.step(down)
        if terminated.any():
            assert np.array_equal(infos["_final_obs"], terminated)
            assert np.all(np.linalg.norm(infos["final_obs"][terminated, :3], axis=1) > 2.9)
            begun.append(seen[terminated, :3])
    begun = np.concatenate(begun)
    assert len(begun) > 100
    assert len(np.unique(begun[:, 0])) == len(begun)
    assert np.linalg.norm(begun, axis=1).max() <= 0.5


def test_it_is_cut_off_after_its_duration():
    worlds = VectorWorlds("swing_up", 9, duration=0.5)
    worlds.reset(seed=0)
    cut = [worlds.step(some_actions(1, 9)[0])[3] for _ in range(100)]
    assert np.array_equal(np.flatnonzero([c.all() for c in cut]), [49, 99])
    assert sum(c.sum() for c in cut) == 18


@pytest.mark.parametrize("absurd", [np.nan, np.inf, -np.inf, 1e30])
def test_an_absurd_action_ends_its_own_world_at_most(absurd):
    calm, hurt = VectorWorlds("swing_up", 20), VectorWorlds("swing_up", 20)
    calm.reset(seed=1)
    hurt.reset(seed=1)
    actions = some_actions(50, 20)
    for k, action in enumerate(actions):
        bad = action.copy()
        if k == 10:
            bad[7] = absurd
        a, b = calm.step(action), hurt.step(bad)
        assert b[2][7] == (k == 10 and not abs(absurd) < np.inf)  # a finite one is clipped
        others = np.arange(20) != 7
        assert all(np.array_equal(x[others], y[others]) for x, y in zip(a[:4], b[:4], strict=True))
        assert all(np.isfinite(x).all() for x in b[:2])


def test_random_actions_of_any_size_leave_everything_finite():
    rng, worlds = np.random.default_rng(2), VectorWorlds("swing_up", 256, action="rates")
    worlds.reset(seed=2)
    for _ in range(400):
        seen, rewards, *_ = worlds.step(
            (rng.standard_normal((256, 4)) * 10.0 ** rng.integers(-3, 38)).astype(np.float32)
        )
        assert np.isfinite(seen).all()
        assert np.isfinite(rewards).all()
        assert np.abs(rewards).max() < 2


# What is observed and paid -------------------------------------------------------------------------------------------


def test_the_reward_is_its_formula():
    worlds = VectorWorlds("balance", 50)
    worlds.reset(seed=3)
    before = some_actions(2, 50)
    worlds.step(before[0])
    _, rewards, terminated, *_ = worlds.step(before[1])
    s = worlds.worlds.states
    near = lambda v, scale: 1 / (1 + (v**2).sum(1) / scale**2)  # noqa: E731
    kept = 0.4 + 0.3 * near(s[:, :3], 0.5) + 0.1 * near(s[:, 3:6], 1)
    kept += 0.1 * near(s[:, 21:24], 3) + 0.1 * near(s[:, 15:18], 5)
    change = ((before[1].astype(float) - before[0]) ** 2).sum(1)
    assert not terminated.any()
    assert np.allclose(rewards, (1 + s[:, 20]) / 2 * kept - 0.02 * change, atol=1e-6)  # float32


def test_tracking_is_paid_for_being_where_the_goal_is():
    worlds = VectorWorlds("track", 50)
    before = worlds.reset(seed=5)[0].astype(float)
    action = some_actions(1, 50)[0]
    seen, rewards, terminated, *_ = worlds.step(action)
    near = lambda v, scale: 1 / (1 + (v**2).sum(1) / scale**2)  # noqa: E731
    s = seen.astype(float)
    kept = 0.4 + 0.3 * near(s[:, :3], 0.5) + 0.1 * near(s[:, 3:6], 1)
    kept += 0.1 * near(s[:, 21:24], 3) + 0.1 * near(s[:, 15:18], 5)
    paid = (1 + s[:, 20]) / 2 * kept - 0.02 * ((action - before[:, 28:32]) ** 2).sum(1)
    assert not terminated.any()
    assert np.allclose(rewards, paid * (0.5 + 0.5 * near(s[:, :3], 0.3)), atol=1e-5)  # float32
    assert np.ptp(near(s[:, :3], 0.2)) > 0.1  # worlds begin up to 0.1 m from the goal


def test_the_shaped_swing_up_begins_at_any_angle_and_pays_for_standing():
    worlds = gymnasium.make_vec("flypend/SwingUpShaped-v0", 4000, vectorization_mode="vector_entry_point").unwrapped
    plain = VectorWorlds("swing_up", 4000)
    worlds.reset(seed=3)
    y, y_dot = worlds.worlds.states[:, 18:21], worlds.worlds.states[:, 21:24]
    # A quarter of seven tenths in each quarter of u, and three tenths hang: give or take five deviations of 32.
    quarters = np.histogram((np.arccos(y[:, 2]) / np.pi) ** (2 / 3), 4, (0, 1))[0]
    assert np.all(abs(quarters - [700, 700, 700, 1900]) < 160)
    assert np.all(abs(y[:, :2].mean(0)) < 5 * np.sqrt((y[:, :2] ** 2).mean(0) / 4000))  # in any direction
    energies = y[:, 2] + VEHICLE.l * (y_dot**2).sum(1) / (2 * VEHICLE.g)
    assert 0.9 < energies.max() < 1.0 + 1e-12
    plain.reset(seed=3)
    plain.worlds.arrays["memories"][:] = worlds.worlds.arrays["memories"][:, :-1]  # which has the time for coming up
    action = some_actions(1, 4000)[0]
    _, paid, over, *_ = worlds.step(action)
    upright = plain.step(action)[1]
    y, y_dot = worlds.worlds.states[:, 18:21], worlds.worlds.states[:, 21:24]
    still = 1 / (1 + 2 * (1 - y[:, 2]) / 0.3**2) / (1 + (y_dot**2).sum(1) / 3.0**2)
    still /= 1 + (worlds.worlds.states[:, :3] ** 2).sum(1) / 1.5**2
    assert not over.any()
    assert np.allclose(paid, upright * (0.4 + 0.6 * still), atol=1e-6)  # float32


def test_the_shaped_swing_up_ends_when_the_rod_is_not_up_in_time():
    worlds = VectorWorlds("swing_up", 400, shaped=True)
    worlds.reset(seed=4)
    by, first = np.where(worlds.worlds.states[:, 20] > 0.9, 0.3, 3.0), np.ones(400, dtype=bool)
    early = 0
    for k in range(1, 302):
        seen, _, over, _, infos = worlds.step(np.full((400, 4), -0.23))  # about what carries it
        for i in np.flatnonzero(over):
            seen[i] = infos["final_obs"][i]
        due = (k / 100 > by + 1e-9) & (seen[:, 20] < 0.5) | (np.linalg.norm(seen[:, :3], axis=1) > 5)
        assert np.array_equal(over[first], due[first])
        first, early = first & ~over, early + (k < 200) * int((first & over).sum())
    assert early > 50
    assert not first.all()


def test_observations_are_relative_to_the_goal():
    worlds = VectorWorlds("track", 4, shape="circle", size=0.5, turn_rate=1.5)
    seen, _ = worlds.reset(seed=0)
    goals = worlds.worlds.states[:, :3] - seen[:, :3]
    assert np.allclose(np.linalg.norm(goals, axis=1), 0.5, atol=1e-6)
    ahead = seen[:, -9:-6] + goals
    turned = np.arctan2(ahead[:, 1], ahead[:, 0]) - np.arctan2(goals[:, 1], goals[:, 0])
    assert np.allclose(np.mod(turned, 2 * np.pi), 0.15, atol=1e-5)
    flat = VectorWorlds("balance", 1, attitude="6d")
    assert VectorWorlds("balance", 1).single_observation_space.shape[0] == flat.single_observation_space.shape[0] + 3


def test_the_body_frame_shows_the_same_vectors_turned():
    """Of all vectors of the world frame, those of the goal's way included; what is of the body stays as it is."""
    arguments = {"task": "track", "num_envs": 16}
    world, body = VectorWorlds(**arguments), VectorWorlds(**arguments, attitude="body")
    world.reset(seed=0), body.reset(seed=0)
    for action in some_actions(3, 16):
        seen, turned = world.step(action)[0].astype(float), body.step(action)[0]
    columns = seen[:, 6:15].reshape(16, 3, 3)  # rows are the body's axes

    def to_body(place):
        return (columns @ seen[:, place : place + 3, None])[..., 0]

    wanted = [to_body(0), to_body(3), columns[:, :, 2], seen[:, 15:18], to_body(18), to_body(21), seen[:, 24:32]]
    wanted += [to_body(place) for place in (32, 35, 38)]
    assert np.allclose(turned, np.hstack(wanted), rtol=0, atol=1e-6 * (1 + abs(turned)))  # single precision
    assert abs(turned[:, :3] - seen[:, :3]).max() > 0.1


def test_history_follows_the_present():
    worlds, plain = VectorWorlds("swing_up", 5, history=2), VectorWorlds("swing_up", 5)
    first, now = worlds.reset(seed=0)[0], plain.reset(seed=0)[0]
    assert np.array_equal(first, np.tile(now, 3))
    seen = [now]
    for action in some_actions(4, 5):
        rows = worlds.step(action)[0]
        seen.append(plain.step(action)[0])
    assert np.array_equal(rows, np.concatenate(seen[:-4:-1], axis=1))


@pytest.mark.parametrize("task", [*BUILT_IN, "shaped"])
def test_a_late_observation_is_the_one_that_was(task):
    """Of every task, with a history, through ends: of many worlds, and of one, which equals the first of them."""
    given = {"task": "swing_up", "shaped": True} if task == "shaped" else {"task": task}
    arguments = given | {"duration": 0.05, "randomise": {"lag": (0.9, 1.1)}}
    late, history = 2, 1
    memory = {"history": history, "observation_delay": late}
    worlds, plain = (VectorWorlds(num_envs=3, **arguments, **more) for more in (memory, {}))
    single = World(**arguments, **memory)
    row, now = worlds.reset(seed=4)[0], plain.reset(seed=4)[0]
    alone, k, ends = single.reset(seed=4)[0], plain.single_observation_space.shape[0], 0
    assert single.observation_space.shape == worlds.single_observation_space.shape == ((1 + history) * k,)
    was = [now] * (1 + late + history)
    for action in some_actions(12, 3):
        assert np.array_equal(row, np.concatenate([was[-1 - late], was[-2 - late]], axis=1))
        assert np.array_equal(alone, row[0])
        row, rewards, *_, infos = worlds.step(action)
        now, undelayed, *_, told = plain.step(action)
        assert np.array_equal(rewards, undelayed)
        over = told.get("_final_obs", np.zeros(3, bool))
        alone = single.step(action[0])[0]
        if over.all():
            ends += 1
            last = np.concatenate([was[-late], was[-1 - late]], axis=1)
            assert np.array_equal(infos["final_obs"], last)
            assert np.array_equal(alone, last[0])
            break
        assert not over.any()
        was.append(now)
    assert ends == 1
    assert not np.array_equal(was[-late], was[-1])
    was = [now] * (1 + late + history)  # a new beginning knows nothing of the end before it
    assert np.array_equal(row, np.tile(now, 2))


def test_a_late_observation_goes_on_after_a_copy():
    """A copy, a pickle and a saved state remember what is still on its way; a state of another delay is refused."""
    worlds = VectorWorlds("balance", 5, observation_delay=2)
    worlds.reset(seed=1)
    actions = some_actions(6, 5)
    for action in actions[:3]:
        worlds.step(action)
    kept, others = worlds.save_state(), [copy.deepcopy(worlds), pickle.loads(pickle.dumps(worlds))]
    rows = [worlds.step(action)[0] for action in actions[3:]]
    worlds.restore_state(kept)
    for one in (worlds, *others):
        assert all(np.array_equal(one.step(action)[0], row) for action, row in zip(actions[3:], rows, strict=True))
    with pytest.raises(fp.InputError, match=r"^state\.observation_delay: expected 1, got 2"):
        VectorWorlds("balance", 5, observation_delay=1).restore_state(kept)


def test_without_copies_arrays_stay_where_they_are():
    worlds = VectorWorlds("balance", 8, copy=False)
    seen, _ = worlds.reset(seed=0)
    again = worlds.step(some_actions(1, 8)[0])[0]
    assert np.shares_memory(seen, again)


@pytest.mark.parametrize(("history", "late"), [(0, 0), (2, 0), (1, 3)])
def test_jax_shares_the_memory_of_the_worlds(history, late):
    """It copies what does not begin at a multiple of 64 bytes, which an array of NumPy does one time in four."""
    import jax  # here: it takes a second

    given = {"copy": False, "history": history, "observation_delay": late}
    several = [VectorWorlds("balance", count, **given) for count in (3, 8, 40, 1000)]
    for worlds in several:
        arrays = worlds.reset(seed=0)[0], *worlds.step(np.zeros((worlds.num_envs, 4)))[:4]
        for array in arrays:
            assert jax.dlpack.from_dlpack(array).unsafe_buffer_pointer() == array.ctypes.data


def test_starts_are_on_the_manifold_and_where_the_task_says():
    worlds = Worlds(environment("swing_up"), 4000)
    worlds.begin(np.arange(4000))
    states = fp.State.trusted(worlds.states[:, :24])
    assert np.allclose(np.linalg.norm(states.y, axis=1), 1, atol=1e-14)
    assert np.allclose(np.swapaxes(states.R, 1, 2) @ states.R, np.eye(3), atol=1e-13)
    assert np.abs((states.y * states.y_dot).sum(1)).max() < 1e-14
    assert states.y[:, 2].max() <= -np.cos(0.2)
    # Uniform in a cap: the third component is uniform. Its mean of 4,000 is within five deviations of the middle.
    middle, width = -(1 + np.cos(0.2)) / 2, 1 - np.cos(0.2)
    assert abs(states.y[:, 2].mean() - middle) < 5 * width / np.sqrt(12 * 4000)


# What acts -----------------------------------------------------------------------------------------------------------


def test_rates_are_followed():
    worlds = VectorWorlds("swing_up", 3, action="rates", plant=PHYSICS.replace(lag=0.0))
    worlds.reset(seed=0)
    for _ in range(40):
        worlds.step(np.tile(np.array([-0.2, 0.1, -0.05, 0.02], dtype=np.float32), (3, 1)))
    assert np.allclose(worlds.worlds.states[:, 15:18], [1.2, -0.6, 0.24], atol=0.05)


def test_a_wrench_is_allocated():
    worlds = VectorWorlds("swing_up", 1, action="wrench", plant=PHYSICS.replace(lag=0.0))
    worlds.reset(seed=0)
    worlds.step(np.array([[-0.3, 0.05, -0.02, 0.0]], dtype=np.float32))
    wrench = VEHICLE.mixing() @ worlds.worlds.states[0, 24:]
    largest = np.abs(VEHICLE.mixing()[1:]).sum(1) * VEHICLE.rotor_limits[1] / 2
    assert np.allclose(wrench, [4 * 3.5 * 0.35, *(largest * [0.05, -0.02, 0])], atol=1e-6)


@pytest.mark.parametrize("number", ["mass", "bob_mass", "rod_length"])
def test_another_vehicle_flies_as_one_that_is_mistaken(number):
    """A ratio of 1.2, for all worlds, is `mismatch` of the plant, but for the inertia, which goes with the mass."""
    ratio = {number: 1.2} | ({"inertia": 1.2} if number == "mass" else {})
    drawn = World("swing_up", randomise={number: (1.2, 1.2)})
    known = World("swing_up", plant=PHYSICS.replace(mismatch=ratio))
    drawn.reset(seed=1)
    known.reset(seed=1)
    for action in some_actions(20, 1)[:, 0]:
        drawn.step(action)
        known.step(action)
    assert np.allclose(drawn.worlds.states, known.worlds.states, rtol=0, atol=1e-11)


def test_a_spinning_rod_is_that_of_another_vehicle():
    """Its moments of inertia scale with its mass and the square of its length."""
    spins = VEHICLE.replace(rod_inertia=3e-3, rod_spin_inertia=1e-4, rod_spin=30.0)
    drawn = World(
        "swing_up", plant=AT_ONCE, vehicle=spins, randomise={"bob_mass": (0.8,) * 2, "rod_length": (1.3,) * 2}
    )
    known = World("swing_up", plant=AT_ONCE, vehicle=spins.replace(**stretch(spins, 0.8, 1.3)))
    for world in (drawn, known):
        world.reset(seed=1)
        for action in some_actions(20, 1)[:, 0]:
            world.step(action)
    assert np.allclose(drawn.worlds.states, known.worlds.states, rtol=0, atol=1e-11)


def test_lag_and_strength_and_wind_are_those_drawn():
    slow, known = World("swing_up", randomise={"lag": (2, 2)}), World("swing_up", plant=PHYSICS.replace(lag=0.04))
    for world in (slow, known):
        world.reset(seed=1)
    for action in some_actions(10, 1)[:, 0]:
        slow.step(action)
        known.step(action)
    assert np.allclose(slow.worlds.states, known.worlds.states, rtol=0, atol=1e-12)
    weak = Worlds(environment("swing_up", randomise={"strength": (0.8, 0.9)}), 50)
    weak.begin(np.arange(50))
    for _ in range(30):
        weak.step(np.ones((50, 4)))
    ratios = weak.states[:, 24:] / VEHICLE.rotor_limits[1]
    assert ratios.min() >= 0.8 - 1e-6
    assert ratios.max() <= 0.9
    assert ratios.std() > 0.02


def test_thrust_is_drawn_once_for_all_rotors():
    worlds = Worlds(environment("swing_up", randomise={"thrust": (0.8, 1.2)}), 50)
    worlds.begin(np.arange(50))
    for _ in range(30):
        worlds.step(np.ones((50, 4)))
    ratios = worlds.states[:, 24:] / VEHICLE.rotor_limits[1]
    assert np.ptp(ratios, axis=1).max() < 1e-12
    assert ratios.min() >= 0.8 - 1e-6
    assert ratios.max() <= 1.2
    assert ratios[:, 0].std() > 0.05  # uniform: 0.115


def test_bands_are_ratios_of_what_is_written():
    bands = {"mass": (0.5, 0.7), "rotor_lag": (0.0, 0.04), "thrust_scale": (0.7, 0.9), "delay": (0.0, 0.02),
             "strength": ([0.9, 1.0, 1.0, 1.0], [1.0, 1.1, 1.0, 1.0]), "sag": (0.0, 0.1)}  # fmt: skip
    vehicle = VEHICLE.replace(bands=bands, mass=0.6, thrust_scale=0.8)
    found = environment("balance", vehicle=vehicle, randomise="bands").randomise
    late = environment("balance", vehicle=vehicle, randomise="bands", plant=PHYSICS.replace(delay=0.005)).randomise
    assert late.delay == pytest.approx((0.0, 0.015))  # and with the plant's, up to the 20 ms of the band
    wanted = {"mass": (5 / 6, 7 / 6), "lag": (0.05, 0.04 / vehicle.rotor_lag), "thrust": (0.875, 1.125)}
    wanted |= {"delay": (0.0, 0.02), "strength": (0.9, 1.1), "bob_mass": (1.0, 1.0), "wind": (0.0, 0.0)}
    for name, interval in wanted.items():
        assert getattr(found, name) == pytest.approx(interval), name


def test_wind_pushes():
    """A constant force, for want of anything else: the centre of mass falls beside where it would."""
    force = 0.5
    still, blown = (Worlds(environment("swing_up", randomise={"wind": (w, w)}), 30) for w in (0.0, force))
    for worlds in (still, blown):
        worlds.begin(np.arange(30))
    for action in some_actions(10, 30):
        still.step(action)
        blown.step(action)
    total, share = VEHICLE.weight / VEHICLE.gravity, VEHICLE.bob_mass * VEHICLE.gravity / VEHICLE.weight
    centre = [w.states[:, :3] + share * VEHICLE.l * w.states[:, 18:21] for w in (still, blown)]
    shift = np.linalg.norm(centre[1] - centre[0], axis=1)
    assert np.allclose(shift, force / total * 0.1**2 / 2, rtol=0.05)  # the thrust axis turns a little less or more


@pytest.mark.parametrize(("late", "action"), [(0.003, "rotors"), (0.01, "rotors"), (0.025, "rotors"), (0.025, "rates")])
def test_a_delayed_command_acts_later(late, action):
    """In steps of 1 ms: by the same flight under commands that are moved. A rate loop follows them without delay."""
    world = World("swing_up", randomise={"delay": (late, late)}, action=action)
    world.reset(seed=2)
    begin = world.worlds.states[0]
    actions = some_actions(12, 1)[:, 0]
    for each in actions:
        world.step(each)
    commands = forces_of(actions) if action == "rotors" else rates_of(actions)
    first = begin[24:] if action == "rotors" else [VEHICLE.weight, 0, 0, 0]
    ticks = round(1000 * late)
    moved = np.concatenate([np.tile(first, (ticks, 1)), np.repeat(commands, 10, axis=0)])[:120]
    plant = PHYSICS.replace(interface="rates" if action == "rates" else "wrench")
    flown = from_hover(begin, moved, plant, hold=1)[-1]
    # Kernels may fuse products and sums of a rate loop.
    assert np.allclose(world.worlds.states[0], flown, rtol=0, atol=0 if action == "rotors" else 1e-12)


@pytest.mark.parametrize("late", [0.0, 0.02])
def test_rates_are_tracked_as_simulate_does(late):
    """A turn of 1 rad/s, which a delay inside the rate loop would make swing."""
    world = World("swing_up", action="rates", plant=PHYSICS.replace(delay=late))
    world.reset(seed=3)
    begin, action = world.worlds.states[0], np.array([-0.5, 1 / 12, 0, 0], dtype=np.float32)
    for _ in range(40):
        world.step(action)
    start, command = fp.State.from_packed(begin[:24]), rates_of(action[None])
    plant = fp.Plant(rate=100.0, delay=late, interface="rates")
    flown = replayed(start, np.tile(command, (40, 1)), plant)[-1]
    assert np.allclose(world.worlds.states[0, 15:18], flown[15:18], rtol=0, atol=1e-2)  # from other rotors


def test_a_rod_that_touches_ends_its_world():
    """Level, with the rod swinging down through an arm of a hub; on a gimbal the same worlds go on."""
    hub, gimbal = (VectorWorlds("balance", 200, mount=mount, duration=3.0) for mount in ("hub", "gimbal"))
    for worlds in (hub, gimbal):
        worlds.reset(seed=0)
    still = some_actions(1, 200, size=0.0)[0]
    ends = np.zeros((2, 200), dtype=bool)
    for _ in range(250):
        for k, worlds in enumerate((hub, gimbal)):
            ends[k] |= worlds.step(still)[2]
    assert ends[0].sum() >= ends[1].sum()


def test_a_shaped_swing_up_on_a_hub_begins_with_the_rod_clear_of_its_parts():
    vehicle = fp.vehicle("hehn2011").replace(mount="hub")
    worlds = VectorWorlds("swing_up", 400, vehicle=vehicle, shaped=True)  # 17 of 400 drawn rods are within an arm
    worlds.reset(seed=0)
    starts = fp.State.from_packed(worlds.worlds.states[:, :24])
    assert not touches(vehicle, starts).any()
    assert (starts.y[:, 2] > -0.9).sum() > 200


def test_a_rod_leaves_its_cup():
    worlds = VectorWorlds("catch_in_cup", 100)
    worlds.reset(seed=0)
    still = some_actions(1, 100, size=0.0)[0]
    ends = np.zeros(100, dtype=bool)
    for _ in range(300):
        ends |= worlds.step(still)[2]
    assert ends.mean() > 0.9  # nothing balances them


def test_what_has_been_flown_is_a_run(tmp_path):
    world = World("balance")
    world.reset(seed=0)
    for action in some_actions(20, 1)[:, 0]:
        world.step(action)
    run = world.trajectory()
    assert run.t[-1] == pytest.approx(0.2)
    forces, (x, y, _) = run.rotor_forces, world.worlds.env.vehicle.rotor_positions.T
    assert np.allclose(run.thrust, forces.sum(axis=1))
    assert np.allclose(run.moment[:, :2], np.stack([forces @ y, -forces @ x], axis=1))
    assert np.array_equal(run.packed[-1], world.worlds.states[0, :24])
    run.to_html(tmp_path / "a.html")
    assert (tmp_path / "a.html").stat().st_size > 1e5


@pytest.mark.parametrize(
    ("arguments", "action", "outcome"),
    [
        ({"task": "swing_up", "duration": 0.2}, 0.0, "completed at 0.2 s"),
        ({"task": "balance"}, -1.0, r"completed at 0\..* s: the task Balance ended the episode"),
        (
            {"task": "swing_up", "plant": PHYSICS.replace(floor=-0.8)},
            -1.0,
            r"collided at .* s: the rod touched the floor",
        ),
        ({"task": "swing_up"}, np.nan, r"diverged at 0\.01 s: state or action was not finite.*"),
    ],
    ids=["duration", "task", "floor", "lost"],
)
def test_a_run_ends_with_the_last_state_and_says_why(arguments, action, outcome):
    world, seen, over, steps = World(**arguments), None, False, 0
    world.reset(seed=0)
    while not over:
        seen, _, terminated, truncated, _ = world.step(np.full(4, action))
        over, steps = terminated or truncated, steps + 1
    run = world.trajectory()
    assert len(run.t) == steps + 1
    assert np.allclose(run.packed[-1, [0, 1, 2, 18, 19, 20]], seen[[0, 1, 2, 18, 19, 20]], rtol=1e-6)
    assert re.fullmatch(outcome, str(run.outcome))
    copied = copy.deepcopy(world).trajectory()
    assert copied.outcome == run.outcome
    world.reset(seed=0)
    assert world.trajectory().outcome == fp.Outcome("completed", 0.0)


def test_a_rotation_that_a_task_draws_is_one_and_any_is_as_likely():
    draws = Draws()
    R = draws.rotation()
    shares = np.random.default_rng(0).uniform(size=(3, 4000))
    drawn = np.array(ca.Function("drawn", [draws.symbols], [ca.vec(R)]).map(4000)(shares)).T.reshape(-1, 3, 3)
    np.testing.assert_allclose(np.swapaxes(drawn, 1, 2) @ drawn, np.broadcast_to(np.eye(3), drawn.shape), atol=1e-14)
    np.testing.assert_allclose(np.linalg.det(drawn), 1)
    # Each entry has mean 0 and variance 1/3: of 4,000 draws, four deviations.
    assert np.abs(drawn.mean(axis=0)).max() < 4 * np.sqrt(1 / 3 / 4000)


# What is refused -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"task": "hop"}, "task"), ({"task": "track", "shape": "star"}, "shape"), ({"rate": 300.0}, "rate"),
        ({"action": "speed"}, "action"), ({"randomise": {"mass": (1.2, 0.8)}}, "randomise.mass"),
        ({"randomise": {"mass": (0.0, 1.0)}}, "randomise.mass"), ({"num_envs": 0}, "num_envs"),
        ({"plant": PHYSICS.replace(noise=fp.Noise(x=1e-3))}, "plant"), ({"duration": -1}, "duration"),
        ({"task": "catch_in_cup", "mount": "hub"}, "mount"), ({"task": "swing_up", "mount": "cup"}, "mount"),
        ({"task": "swing_up", "shaped": True, "mount": "cup"}, "mount"), ({"mount": "bogus"}, "mount"),
        ({"history": -1}, "history"), ({"history": 1.5}, "history"),
        ({"observation_delay": -1}, "observation_delay"), ({"workers": 0}, "workers"),
        ({"num_envs": True}, "num_envs"), ({"randomise": {"mas": (1, 1)}}, "randomise.mas"),
        ({"randomise": "mass"}, "randomise"), ({"randomise": "bands"}, "randomise"),
        ({"randomise": {"mass": 1.2}}, "randomise.mass"),
        ({"randomise": {"delay": (0, 20)}}, "randomise.delay"), ({"plant": "rotors"}, "plant"),
        ({"shape": "circle"}, "shape"), ({"task": "track", "shap": "circle"}, "shap"),
        ({"task": environment("balance").task, "shape": "circle"}, "shape"),
        ({"task": "track", "size": np.nan}, "size"), ({"task": "track", "turn_rate": "fast"}, "turn_rate"),
        ({"duration": 1e-9}, "duration"), ({"duration": 1e300}, "duration"),
        ({"action": "rates", "plant": PHYSICS.replace(rate_loop_rate=500.0)}, "plant.rate_loop_rate"),
    ],
)  # fmt: skip
def test_what_is_not_possible_is_refused(arguments, field):
    with pytest.raises(fp.InputError, match=rf"^{re.escape(field)}: "):
        VectorWorlds(**arguments)


@pytest.mark.parametrize("kind", [World, VectorWorlds, DifferentiableWorlds])
def test_an_unknown_argument_is_told_what_there_is(kind):
    with pytest.raises(fp.InputError) as refused:
        kind("track", raet=3)
    listed = refused.value.expected.removeprefix("one of ").split(", ")
    own = {name for name in inspect.signature(kind).parameters if name != "arguments"}
    assert own | {"plant", "vehicle", "sensors", "turn_rate"} <= set(listed)
    assert len(set(listed)) == len(listed)
    assert ("history" in listed) == (kind is not DifferentiableWorlds)


@pytest.mark.parametrize(
    ("name", "function"),
    [
        ("reward", lambda now: 1 - now.error.x**2),  # three numbers, of which a kernel would take one
        ("reward", lambda now: 5.0 if float(now.time) > 0.2 else 1.0),  # CasADi: always 1
        ("reward", lambda now: None),
        ("ended", lambda now: now.error.x**2 > 0.01),
        ("goal", lambda t, numbers: (ca.SX(2, 1), ca.SX(3, 1))),
        ("shown", lambda now: now.state.R),
        ("begin", lambda draws, vehicle: fp.State()),
    ],
)
def test_a_task_that_answers_something_else_is_refused(name, function):
    with pytest.raises(fp.InputError) as refused:
        World(replace(balance(), **{name: function}))
    assert refused.value.field == f"task.{name}"


@pytest.mark.parametrize("goal", [[1.0, 2.0], np.array([1.0, 2.0]), ca.DM([1.0, 2.0])])
def test_a_beginning_may_draw_some_parts_and_give_the_others(goal):
    begin = lambda draws, vehicle: Begin(fp.State(x=draws.ball(1.0), y=(0, 0, 1)), goal)  # noqa: E731
    worlds = VectorWorlds(replace(balance(), begin=begin), 20)
    worlds.reset(seed=0)
    begun = fp.State.from_packed(worlds.worlds.states[:, :24])
    assert 0.5 < np.linalg.norm(begun.x, axis=1).max() <= 1
    assert np.array_equal(begun.y, np.tile([0, 0, 1], (20, 1)))
    assert np.array_equal(begun.R, np.tile(np.eye(3), (20, 1, 1)))
    assert np.array_equal(worlds.worlds.goals, np.tile([1, 2], (20, 1)))


def test_a_task_may_bring_any_argument_of_its_environments():
    task = replace(environment("balance").task, defaults={"action": "rates", "duration": 2.0})
    assert environment(task).action == "rates"
    assert environment(task).task.duration == 2.0
    assert environment(task, action="wrench", duration=3.0).action == "wrench"
    with pytest.raises(fp.InputError, match=r"^task\.defaults\.speed: "):
        environment(replace(task, defaults={"speed": 3}))


@pytest.mark.parametrize(
    "actions", [np.zeros((3, 5)), np.zeros(4), np.zeros((3, 1)), 0.3, "left", None, np.zeros((3, 4), dtype=complex)]
)
def test_actions_of_another_shape_are_refused_and_move_nothing(actions):
    """Four numbers for three worlds would else be those of all."""
    worlds = VectorWorlds("balance", 3)
    worlds.reset(seed=0)
    before = worlds.worlds.states
    with pytest.raises(fp.InputError, match=r"^actions: expected real numbers of shape \(3, 4\)"):
        worlds.step(actions)
    assert np.array_equal(worlds.worlds.states, before)


def test_a_number_beyond_single_precision_is_infinite():
    worlds = VectorWorlds("balance", 2)
    worlds.reset(seed=0)
    assert worlds.step([[0, 0, 0, 0], [0, 1e300, 0, 0]])[2].tolist() == [False, True]


@pytest.mark.parametrize("seed", [-1, 2**70, 1.5, "a", np.array(3), [1, 2], [1, -2, 3], [1, 2, 2**64]])
def test_a_seed_is_an_integer_or_one_for_each_world(seed):
    with pytest.raises(fp.InputError, match=r"^seed: "):
        VectorWorlds("balance", 3).reset(seed=seed)
    if not isinstance(seed, list):
        with pytest.raises(fp.InputError, match=r"^seed: "):
            World("balance").reset(seed=seed)


def test_seeds_of_numpy_are_seeds():
    several, one = VectorWorlds("balance", 3), World("balance")
    assert np.array_equal(several.reset(seed=np.int64(7))[0], several.reset(seed=[7, 8, 9])[0])
    assert np.array_equal(one.reset(seed=np.int64(7))[0], several.reset(seed=7)[0][0])


def test_nothing_moves_before_it_has_begun():
    with pytest.raises(ResetNeeded):
        VectorWorlds("balance", 2).step(np.zeros((2, 4)))
    for call in (lambda world: world.step(np.zeros(4)), World.trajectory):
        with pytest.raises(ResetNeeded):
            call(World("balance"))


def test_ranges_are_intervals():
    assert Randomisation(mass=(0.8, 1.2)).varies
    assert not Randomisation(delay=(0.0, 0.01)).varies


# Memory ------------------------------------------------------------------------------------------------------


def flown_between_guards(steps, count, task, **arguments):
    """Step worlds whose arrays all lie between guards, with random actions, some of them absurd; check the guards."""
    worlds, rng, mark, width = Worlds(environment(task, **arguments), count), np.random.default_rng(1), 0xA5, 4096
    guards = []

    def guarded(array):
        raw = np.full(array.nbytes + 2 * width + 64, mark, dtype=np.uint8)
        first = width + -(raw.ctypes.data + width) % 64
        inside = raw[first : first + array.nbytes].view(array.dtype).reshape(array.shape)
        inside[:] = array
        guards.append((raw, first, first + array.nbytes))
        return inside

    worlds.arrays = {name: guarded(array) for name, array in worlds.arrays.items()}
    worlds.begin(np.arange(count))
    actions = rng.uniform(-1.5, 1.5, (50, count, 4)).astype(np.float32)
    actions[7, ::11], actions[13, ::13], actions[29, ::17] = np.nan, np.inf, 1e30
    for k in range(steps):
        worlds.step(actions[rng.integers(50)] if k % 3 else np.roll(actions[k % 50], k, axis=0))
    for raw, first, end in guards:
        assert np.all(raw[:first] == mark)
        assert np.all(raw[end:] == mark)
    assert all(np.isfinite(worlds.arrays[name]).all() for name in ("observations", "rewards"))
    return worlds


@pytest.mark.parametrize("task", TASKS, ids=NAMES)
def test_no_step_writes_beside_its_arrays(task):
    """A count that fills no whole group: 13 worlds in two of eight."""
    flown_between_guards(300, 13, task)


def test_no_step_of_an_estimator_does():
    flown_between_guards(200, 13, "balance", sensors="onboard")


@pytest.mark.slow
@pytest.mark.parametrize("task", TASKS, ids=NAMES)
def test_ten_million_steps_write_nowhere_else(task):
    flown_between_guards(10**7 // 4100, 4100, task)
