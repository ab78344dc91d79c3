"""The tasks of OmniDrones: their numbers, formulas and ends, evaluated anew from the states of the worlds."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from benchmarks.omnidrones_tasks import (
    TASKS,
    Gate,
    inv_pendulum_fly_through,
    inv_pendulum_hover,
    inv_pendulum_track,
)
from flypend.envs import VectorWorlds, World, environment
from flypend.envs.kernel import Worlds
from flypend.envs.task import Moment

PERIOD = 0.016
MASS = 0.716
GOALS = {"inv_pendulum_hover": 1, "inv_pendulum_track": 7, "inv_pendulum_fly_through": 2}  # numbers


def flown(task, count, steps, seed=0):
    """By step: states, rewards, ends, goals, infos and observations of worlds with actions about hover; the worlds."""
    worlds = VectorWorlds(TASKS[task](), count)
    worlds.reset(seed=seed)
    hover = 2 * worlds.worlds.env.vehicle.weight / (4 * worlds.worlds.env.vehicle.rotor_limits[1]) - 1
    rng, rows = np.random.default_rng(seed), []
    for _ in range(steps):
        goals = worlds.worlds.part("goal", GOALS[task])
        actions = hover + rng.uniform(-0.1, 0.1, (count, 4))
        seen, rewards, terminated, _, infos = worlds.step(actions)
        rows.append((worlds.worlds.states, rewards, terminated, goals, infos, seen))
    return rows, worlds


def named(states, reach=1.0):
    """Parts of states (count, 28): those that the formulas use."""
    s = fp.State.trusted(states[:, :24])
    turning = np.einsum("nij,nj->ni", s.R, s.omega)[:, 2]
    return s, s.x + reach * s.y, np.linalg.norm(s.x_dot + reach * s.y_dot, axis=1), turning


def effort(states):
    return 0.1 * np.exp(-np.sqrt(states[:, 24:] / 6.003).sum(1))


def test_the_vehicle_is_that_of_its_source():
    vehicle = fp.vehicle("hummingbird-omnidrones")
    rod = fp.rod_with_bob(0.025, 1.0, 0.25 * MASS)
    for name, value in rod.items():
        assert getattr(vehicle, name) == pytest.approx(value, rel=1e-3)  # four digits
    assert vehicle.mass == MASS
    assert vehicle.rotor_limits[1] == pytest.approx(838**2 * 8.54858e-6, rel=1e-4)
    assert vehicle.drag_ratio == pytest.approx(1.3677728816e-7 / 8.54858e-6, rel=1e-3)
    # 43 % of the way in a step of 16 ms.
    assert 1 - np.exp(-PERIOD / vehicle.rotor_lag) == pytest.approx(0.43, abs=1e-3)


def test_hover_pays_its_formula():
    rows, _ = flown("inv_pendulum_hover", 60, 25)
    for states, rewards, terminated, *_ in rows:
        s, payload, speed, turning = named(states)
        up, e = s.y[:, 2], np.linalg.norm(payload - [0, 0, 2.5], axis=1)
        wanted = up + np.exp(-1.2 * e) + up * (1 / (1 + turning**4) + np.exp(-speed)) + effort(states)
        assert np.allclose(rewards[~terminated], wanted[~terminated], atol=1e-6)  # float32
    assert not rows[0][2].any()


def eight(t, goal):
    """Where the payload should be, by the figure eight that its source defines; `goal` as in the worlds' memory."""
    _, c, heading, *size, w = goal
    passed = w * t
    phase = np.pi / 2 + (passed / (1 + 1 / abs(passed)) if passed else 0.0)
    x = np.array([np.cos(phase), np.sin(phase) * np.cos(phase), c * np.sin(phase)]) / (1 + np.sin(phase) ** 2)
    turn = np.array([[np.cos(heading), -np.sin(heading), 0], [np.sin(heading), np.cos(heading), 0], [0, 0, 1]])
    return np.array([0, 0, 3.0]) + (turn @ x) * size


def test_track_pays_its_formula_and_shows_what_comes():
    rows, worlds = flown("inv_pendulum_track", 40, 20)
    first = [i for i in range(40) if not any(row[2][i] for row in rows)]  # still in their first episode
    assert len(first) > 10
    for k, (states, rewards, _, goals, *_) in enumerate(rows):
        _, payload, *_ = named(states)
        for i in first:
            e = np.linalg.norm(payload[i] - eight((k + 1) * PERIOD, goals[i]))
            assert rewards[i] == pytest.approx(np.exp(-1.6 * e) + effort(states[i : i + 1])[0], abs=1e-6)
    seen = worlds.worlds.observations
    for i in first:
        here, later = (eight((20 + k) * PERIOD, rows[-1][3][i]) for k in (0, 25))
        assert np.allclose(seen[i, -4:-1], later - here, atol=1e-5)
        assert seen[i, -1] == pytest.approx(20 / 600)
        relative = rows[-1][0][i, :3] - (here - [0, 0, 1.0])
        assert np.allclose(seen[i, :3], relative, atol=1e-5)


def test_the_velocity_of_the_eight_is_its_derivative():
    task = inv_pendulum_track()
    numbers = np.array([1.0, 0.3, 0.7, 2.0, 3.0, 1.2, -0.9])
    t, step = 1.3, 1e-5
    ahead, behind = (np.array(ca.DM(ca.evalf(ca.SX(task.goal(t + d, numbers)[0])))) for d in (step, -step))
    rate = np.array(ca.DM(ca.evalf(ca.SX(task.goal(t, numbers)[1]))))
    assert np.allclose(rate, (ahead - behind) / (2 * step), atol=1e-8)


def test_fly_through_pays_its_formula_and_shows_the_gate():
    rows, worlds = flown("inv_pendulum_fly_through", 60, 25)
    for states, rewards, terminated, *_ in rows:
        s, payload, speed, turning = named(states, 0.85)
        p = 1 / (1 + 1.2 * np.linalg.norm(payload - [1.5, 0, 2.3], axis=1))
        wanted = p * (1 + s.y[:, 2] + 1 / (1 + turning**4) + np.exp(-speed)) + effort(states)
        assert np.allclose(rewards[~terminated], wanted[~terminated], atol=1e-6)
    seen, states = worlds.worlds.observations, worlds.worlds.states
    assert np.allclose(seen[:, -5:-3] + states[:, [0, 2]], [0, 1.2], atol=1e-6)
    upper = seen[:, -3:-1] + states[:, [0, 2]]
    assert np.allclose(upper[:, 0], 0, atol=1e-6)
    assert upper[:, 1].min() > 2.1
    assert upper[:, 1].max() < 2.4


@pytest.mark.parametrize(
    ("task", "least", "most", "tilt", "reach"),
    [
        ("inv_pendulum_hover", (-1.5, -1.5, 1.0), (1.5, 1.5, 2.0), 0.15 * np.pi, 1.0),
        ("inv_pendulum_track", (0.0, 0.0, 1.7), (0.0, 0.0, 2.3), 0.1 * np.pi, 1.0),
        ("inv_pendulum_fly_through", (-2.2, 0.0, 1.0), (-1.0, 0.0, 2.0), 0.15 * np.pi, 0.85),
    ],
)
def test_worlds_begin_where_their_source_says(task, least, most, tilt, reach):
    worlds = Worlds(environment(TASKS[task]()), 3000)
    worlds.begin(np.arange(3000))
    s = fp.State.trusted(worlds.states[:, :24])
    assert worlds.env.vehicle.reach == pytest.approx(reach)
    assert np.all(s.x >= np.array(least) - 1e-12)
    assert np.all(s.x <= np.array(most) + 1e-12)
    width = np.ptp(s.x, axis=0) / np.maximum(np.subtract(most, least), 1e-9)
    assert np.all((width > 0.99) | (np.array(least) == most))  # uniform: of 3,000 the extremes are near the ends
    assert np.array_equal(s.y, s.R[:, :, 2])
    pitch, roll = np.arcsin(-s.R[:, 2, 0]), np.arctan2(s.R[:, 2, 1], s.R[:, 2, 2])
    for angle in (roll, pitch):
        assert np.abs(angle).max() == pytest.approx(tilt, rel=0.01)
        assert angle.std() == pytest.approx(tilt / np.sqrt(3), rel=0.05)  # uniform; 5 deviations
    assert np.allclose(np.swapaxes(s.R, 1, 2) @ s.R, np.eye(3), atol=1e-14)
    assert np.allclose(np.linalg.det(s.R), 1)
    assert not np.concatenate([s.x_dot, s.omega, s.y_dot]).any()


def test_payloads_weigh_what_their_source_says():
    worlds = Worlds(environment(inv_pendulum_hover()), 3000)
    worlds.begin(np.arange(3000))
    ratio = worlds.part("numbers", 2)[:, 1]
    bob = ratio * worlds.env.vehicle.bob_mass
    assert bob.min() == pytest.approx(0.2 * MASS + 0.01, rel=0.005)
    assert bob.max() == pytest.approx(0.3 * MASS + 0.04, rel=0.005)


@pytest.mark.parametrize(
    ("task", "lowest_up", "steps"),
    [("inv_pendulum_hover", 0.2, 500), ("inv_pendulum_track", 0.2, 600), ("inv_pendulum_fly_through", 0.1, 500)],
)
def test_worlds_end_as_their_source_says(task, lowest_up, steps):
    """What is last seen of worlds that end fulfils a condition, and what is seen of those that go on none."""
    env = environment(TASKS[task]())
    assert env.limit == steps
    vehicle, gate, met = env.vehicle, Gate(), set()
    target = {"inv_pendulum_hover": (0, 0, 2.5), "inv_pendulum_fly_through": (1.5, 0, 2.3)}.get(task)

    def reasons(seen, goal):
        """The conditions that an observation fulfils, by a name each."""
        wanted = np.array(eight(seen[-1] * 9.6, goal) if target is None else target)
        pivot, y = seen[:3] + wanted - [0, 0, vehicle.reach], seen[18:21]
        payload = pivot + vehicle.reach * y
        e = np.linalg.norm(payload - wanted)
        found = {"low": pivot[2] < 0.2, "fallen": y[2] < lowest_up}
        if target is None or task == "inv_pendulum_hover":
            return found | {"far": e > (0.8 if target is None else 3.3)}
        s = fp.State(x=pivot, R=seen[6:15].reshape(3, 3).T, y=y)
        touched = clearance(gate, s, goal[1], vehicle) < 0
        return found | {"aside": abs(pivot[1]) > 2, "high": payload[2] > 3, "touched": touched}

    for _, _, terminated, goals, infos, observed in flown(task, 60, 120)[0]:
        for i in np.flatnonzero(terminated):
            found = reasons(infos["final_obs"][i].astype(float), goals[i])
            assert any(found.values()), found
            met |= {name for name, holds in found.items() if holds}
        for i in np.flatnonzero(~terminated)[:4]:
            assert not any(reasons(observed[i].astype(float), goals[i]).values())
    assert "fallen" in met
    assert len(met) > 1 or task == "inv_pendulum_hover"


# The gate ------------------------------------------------------------------------------------------------------------


def clearance(gate, state, spacing, vehicle):
    """`Gate.clearance` for numbers."""
    end = state.x + vehicle.reach * state.y
    s = fp.State(**{name: ca.DM(np.asarray(value, dtype=float)) for name, value in vars(state).items()})
    now = Moment(
        time=0, state=s, error=s, shares=0, change=0, end=ca.DM(end), end_dot=ca.DM(end), goal=0, vehicle=vehicle
    )
    return float(gate.clearance(now, spacing))


def sampled(gate, state, spacing, vehicle):
    """The same from points: of the rod, of the payload's sphere, and of the disc with a thickness."""
    span, thick = 0.17 + vehicle.body.disc_radius, vehicle.body.hub_radius
    turn = np.linspace(0, 2 * np.pi, 4001)
    rim = state.x + span * (np.cos(turn)[:, None] * state.R[:, 0] + np.sin(turn)[:, None] * state.R[:, 1])
    inside = np.concatenate([state.x + share * (rim - state.x) for share in np.linspace(0, 1, 60)])
    rod = state.x + np.linspace(0, vehicle.reach, 4001)[:, None] * state.y
    apart = []
    for bar in (np.array([0, 1.2]), np.array([0, 1.2 + spacing])):
        away = lambda points, bar=bar: np.linalg.norm(points[:, [0, 2]] - bar, axis=1).min()  # noqa: E731
        apart += [away(rod) - vehicle.body.rod_radius, away(rod[-1:]) - gate.payload, away(inside) - thick]
    return min(apart) - gate.radius


def test_the_clearance_of_the_gate_is_that_of_points():
    """It never says free where points touch; level, and on edge towards the bars, it is exact."""
    gate, vehicle, rng = Gate(), environment(inv_pendulum_fly_through()).vehicle, np.random.default_rng(0)
    starts = fp.random_starts(60, seed=1)
    spare = []
    for i in range(60):
        s = starts[i]
        s = fp.State(
            x=rng.uniform((-1, -1, 0.8), (1, 1, 2.4)), R=s.R, y=s.y, x_dot=s.x_dot, omega=s.omega, y_dot=s.y_dot
        )
        both = (max(apart(gate, s, 1.0, vehicle), 0.0) for apart in (sampled, clearance))
        spare.append(next(both) - next(both))
    assert min(spare) > -1e-3  # 4,000 points a rod, 60 rings a disc
    assert max(spare) < 0.1 * 0.27  # of a stadium around an ellipse: at most a tenth of the longer axis
    for axis in ((0, 0, 1), (1, 0, 0), (np.sin(0.7), 0, np.cos(0.7))):
        R = np.column_stack([np.cross((0, 1, 0), axis), (0, 1, 0), axis])
        for x in ((0.4, 0.2, 1.3), (-0.3, 0, 1.9), (0.1, 0.5, 1.65)):
            s = fp.State(x=x, R=R, y=(0, 0.6, 0.8))
            assert clearance(gate, s, 1.0, vehicle) == pytest.approx(sampled(gate, s, 1.0, vehicle), abs=5e-3)


def test_a_gate_that_is_touched_ends_a_world_without_reward():
    """Thrust towards the gate, through whose bars nothing steers: what touches is over, what goes on is clear."""
    worlds, vehicle, gate = VectorWorlds(inv_pendulum_fly_through(), 300), None, Gate()
    vehicle = worlds.worlds.env.vehicle
    worlds.reset(seed=4)
    touched = 0
    for _ in range(120):
        actions = np.tile(2 * vehicle.weight / (4 * 6.003) - 1, (300, 4)) + 0.02
        goals = worlds.worlds.part("goal", 2)[:, 1]
        _, rewards, terminated, *_ = worlds.step(actions)
        s = fp.State.trusted(worlds.worlds.states[:, :24])
        near = np.flatnonzero(~terminated & (np.abs(s.x[:, 0]) < 0.5))[:3]
        assert all(clearance(gate, s[i], goals[i], vehicle) >= 0 for i in near)
        touched += int(np.sum(terminated & (rewards == 0)))
    assert touched > 10


def test_a_gate_needs_a_machine_with_radii():
    bare = fp.vehicle("hehn2011").to_dict() | {"mount": "gimbal"}
    del bare["body"]
    with pytest.raises(fp.InputError, match=r"vehicle\.body"):
        VectorWorlds(inv_pendulum_fly_through(), 2, vehicle=fp.Vehicle(**bare))


def test_another_vehicle_and_another_gate():
    worlds = World(inv_pendulum_fly_through(Gate(spacing=(2.0, 2.5))), vehicle="hehn2011")
    seen, _ = worlds.reset(seed=0)
    assert seen[-2] - seen[-4] > 1.99
    assert worlds.worlds.env.vehicle.name == "hehn2011"
    assert worlds.worlds.env.rate == 62.5


@pytest.mark.parametrize(
    ("arguments", "field"),
    [({"radius": -1}, "radius"), ({"spacing": (1.2, 0.9)}, "spacing"), ({"lower": np.inf}, "lower"),
     ({"payload": "large"}, "payload")],
)  # fmt: skip
def test_a_gate_is_one(arguments, field):
    with pytest.raises(fp.InputError, match=rf"^gate\.{field}: "):
        Gate(**arguments)


def test_the_gate_of_a_task_is_a_gate():
    with pytest.raises(fp.InputError, match=r"^gate: "):
        inv_pendulum_fly_through(3)
