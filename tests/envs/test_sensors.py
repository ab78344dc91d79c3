"""Worlds with sensors: what is observed is what the flight computer of `simulate` estimates; all else is the same."""

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import flypend as fp
from flypend.board.computer import SteppedBoard
from flypend.envs import VectorWorlds, World, environment
from flypend.envs.kernel import Worlds
from flypend.envs.make import PHYSICS
from flypend.flight.request import Flight
from flypend.flight.sampled import fly_stepwise
from flypend.laws import Controller
from tests.few import each_once

VEHICLE = fp.vehicle("hehn2011")
SEED = 2**62  # of the flight whose sensors are those of the world with seed 0


def estimates(worlds):
    """Estimated state and rotor forces (count, 28)."""
    return worlds.part("estimate", 28)


def some_actions(steps, size=0.1):
    low, high = VEHICLE.rotor_limits
    hover = 2 * (VEHICLE.weight / 4 - low) / (high - low) - 1
    return np.clip(hover + np.random.default_rng(0).uniform(-size, size, (steps, 4)), -1, 1).astype(np.float32)


def flown(start, rotors, commands, plant):
    """States, rotor forces and estimates of a flight of `simulate`, whose flight computer gives the `commands`."""
    told = []

    class Table:
        def __init__(self, loop, rotors):
            self._loop, self._rotors, self._left = loop, rotors, list(commands)

        def estimate_from(self, estimate):
            self._board = SteppedBoard(self._loop, self._rotors, estimate, steer=lambda *_: self._left.pop(0))

        def command(self, t, readings):
            given = self._board.command(t, readings)
            told.append(np.append(self._board.estimated, self._rotors_estimated()))
            return given

        def _rotors_estimated(self):
            return self._board.filtered[24:28]

    law = Controller(name="table", function=lambda t, s: fp.Wrench(0.0, np.zeros(3)), flight_computer=Table)
    flight = Flight(vehicle=VEHICLE, law=law, starts=start, duration=len(commands) / plant.rate, plant=plant, seed=SEED)
    samples = fly_stepwise(flight, rotors=rotors)
    return samples.packed, samples.rotors, np.array(told)


@pytest.mark.parametrize(("action", "sensors"), each_once(("rotors", "wrench", "rates"), ("mocap", "onboard")))
def test_a_world_estimates_as_a_flight_does(sensors, action):
    """The same motion to the bit, where commands are; estimates to roundoff: kernels fuse products and sums."""
    steps = 40
    # The accelerometer reads at the centre of mass of the machine that flies, which the computer takes for the pivot.
    offset = (0.01, 0.0, 0.02) if sensors == "onboard" else (0.0, 0.0, 0.0)
    # Steps of 2 ms, as `simulate` divides a period of 10 ms; 1 ms for a rate loop of 1 kHz. A delay of rotor commands.
    physics = PHYSICS if action == "rates" else PHYSICS.replace(rate=500.0, delay=0.012 if action == "rotors" else 0.0)
    physics = physics.replace(pivot_offset=offset)
    worlds = Worlds(environment("swing_up", sensors=sensors, action=action, plant=physics), 1)
    worlds.begin(np.array([0]))
    asked = some_actions(steps)
    if action != "rotors":
        asked[:, 1:] = 0.02 * np.random.default_rng(1).uniform(-1, 1, (steps, 3))
    states, seen = [worlds.states[0]], [estimates(worlds)[0]]
    for each in asked:
        worlds.step(each[None])
        states.append(worlds.states[0])
        seen.append(estimates(worlds)[0])
    states = np.array(states)
    plant = fp.Plant(
        rate=100.0, sensors=sensors, delay=physics.delay, rate_loop_rate=physics.rate,
        interface="rates" if action == "rates" else "wrench", pivot_offset=offset,
    )  # fmt: skip
    commands = commanded(asked.astype(float), action)
    packed, rotors, told = flown(fp.State.trusted(states[0, :24]), states[0, 24:], commands, plant)
    flight = np.concatenate([packed, rotors], axis=1)
    assert np.array_equal(states, flight) if action == "rotors" else np.allclose(states, flight, rtol=0, atol=1e-9)
    assert np.allclose(np.array(seen)[:-1], told, rtol=0, atol=1e-9)
    assert np.abs(told[:, :24] - packed[:-1]).max() > 1e-3  # it is an estimate


def commanded(asked, action):
    """Commands of the `asked` actions, float64."""
    low, high = VEHICLE.rotor_limits
    thrust = 4 * high * (asked[:, :1] + 1) / 2
    if action == "rotors":
        return low + (high - low) * (asked + 1) / 2
    if action == "rates":
        return np.hstack([thrust, 12.0 * asked[:, 1:]])
    moments = np.abs(VEHICLE.mixing()[1:]).sum(1) * high / 2 * asked[:, 1:]
    return np.hstack([thrust, moments]) @ VEHICLE.unmixing().T


@pytest.mark.parametrize("sensors", ["mocap", "onboard"])
def test_observations_are_the_estimate_and_rewards_the_truth(sensors):
    worlds, perfect = (VectorWorlds("balance", 40, sensors=given) for given in (sensors, "perfect"))
    worlds.reset(seed=7)
    perfect.reset(seed=7)
    for action in some_actions(15):
        seen, *told = worlds.step(np.tile(action, (40, 1)))
        _, *known = perfect.step(np.tile(action, (40, 1)))
        assert all(np.array_equal(a, b) for a, b in zip(told[:3], known[:3], strict=True))
    assert np.array_equal(worlds.worlds.states, perfect.worlds.states)
    estimate = estimates(worlds.worlds)
    assert np.allclose(
        seen[:, :24], estimate[:, [*range(6), 6, 9, 12, 7, 10, 13, 8, 11, 14, *range(15, 24)]], atol=1e-5
    )
    low, high = VEHICLE.rotor_limits
    assert np.allclose(seen[:, 24:28], 2 * (estimate[:, 24:] - low) / (high - low) - 1, atol=1e-6)


def test_it_is_the_same_whatever_surrounds_it_and_exact_by_seed():
    alone, many, split = (
        World("balance", sensors="mocap"), VectorWorlds("balance", 300, sensors="mocap", workers=1),
        VectorWorlds("balance", 300, sensors="mocap", workers=2),
    )  # fmt: skip
    first, _ = alone.reset(seed=3)
    seen, again = many.reset(seed=3)[0], split.reset(seed=3)[0]
    assert np.array_equal(seen[0], first)
    assert np.array_equal(seen, again)
    over = False
    for action in some_actions(150, size=0.3):
        results, others = many.step(np.tile(action, (300, 1))), split.step(np.tile(action, (300, 1)))
        assert all(np.array_equal(a, b) for a, b in zip(results[:4], others[:4], strict=True))
        if not over:
            one = alone.step(action)
            over = one[2] or one[3]
            assert np.array_equal(one[0], results[4]["final_obs"][0] if over else results[0][0])
    assert over  # so that it has begun anew
    assert not np.array_equal(many.reset(seed=3)[0], many.reset(seed=4)[0])
    assert np.array_equal(many.reset(seed=3)[0], seen)


def test_another_episode_has_other_noise():
    """The first estimate is off by draws of its own in every episode, and readings do not repeat."""
    worlds = VectorWorlds("swing_up", 64, sensors="mocap", duration=0.05)
    worlds.reset(seed=0)
    errors = []
    for _ in range(4):
        for action in some_actions(5):
            worlds.step(np.tile(action, (64, 1)))
        errors.append(estimates(worlds.worlds)[:, :3] - worlds.worlds.states[:, :3])
    errors = np.array(errors).reshape(4, -1)
    assert np.all(np.abs(np.corrcoef(errors) - np.eye(4)) < 5 / np.sqrt(errors.shape[1]))  # five deviations
    assert errors.std() == pytest.approx(0.02, rel=0.15)  # where episodes begin; five deviations


def test_a_filter_tells_the_state_after_a_while():
    """Against the error of the start: in hover, 200 worlds with their rods hanging, poses to 1 mm and 10 ms late."""
    worlds = Worlds(environment("swing_up", sensors="mocap"), 200)
    worlds.begin(np.arange(200))
    off = []
    for action in some_actions(40, size=0.0):  # later the vehicles, which nothing holds, fly away
        worlds.step(np.tile(action, (200, 1)))
        off.append(np.sqrt(np.mean((estimates(worlds)[:, :24] - worlds.states[:, :24]) ** 2, axis=0)))
    assert off[-1][:3].max() < 1e-3  # less than the noise of a single pose
    assert off[-1][3:6].max() < 0.05  # of 0.2 m/s at first


def test_an_absurd_action_ends_its_own_world_at_most():
    worlds = VectorWorlds("swing_up", 20, sensors="onboard")
    worlds.reset(seed=1)
    for k, action in enumerate(some_actions(30)):
        actions = np.tile(action, (20, 1))
        if k == 10:
            actions[7], actions[8] = np.nan, np.inf
        seen, rewards, terminated, *_ = worlds.step(actions)
        assert np.isfinite(seen).all()
        assert np.isfinite(rewards).all()
        assert np.array_equal(np.flatnonzero(terminated), [7, 8] if k == 10 else [])


def test_gymnasium_has_nothing_to_say(recwarn):
    check_env(gymnasium.make("flypend/Balance-v0", sensors="onboard").unwrapped)
    assert not recwarn.list


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"sensors": "sonar"}, "sensors"), ({"sensors": {"base": "mocap", "rates": "differenced"}}, "sensors.rates"),
        ({"plant": PHYSICS.replace(sensors="mocap")}, "plant"),
    ],
)  # fmt: skip
def test_what_is_not_possible_is_refused(arguments, field):
    with pytest.raises(fp.InputError, match=field.replace(".", r"\.")):
        VectorWorlds("balance", 2, **arguments)
