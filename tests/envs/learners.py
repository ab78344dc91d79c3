"""The first lines of training libraries, with our ids put in: `make learners` runs them where the libraries are.

They have an environment of their own, since PyTorch takes gigabytes; nothing is skipped there.
"""

import re
from pathlib import Path

import gymnasium as gym
import numpy as np
import pytest
import torch
from stable_baselines3 import PPO, SAC
from stable_baselines3.common.env_checker import check_env
from stable_baselines3.common.env_util import make_vec_env as made_one_by_one
from stable_baselines3.common.evaluation import evaluate_policy
from stable_baselines3.common.monitor import Monitor, load_results
from stable_baselines3.common.vec_env import DummyVecEnv, VecNormalize, VecVideoRecorder

import flypend as fp
import flypend.envs
from benchmarks import learners, scores
from flypend.envs import VectorWorlds
from flypend.envs.sb3 import VecWorlds, make_vec_env
from flypend.examples import gradient, train

ROOT = Path(__file__).parents[2]
ID = "flypend/Balance-v0"
PAGE = (ROOT / "docs" / "envs" / "environments.md").read_text(encoding="utf-8")

EXAMPLES = (ROOT / "docs" / "reference" / "examples.py").read_text(encoding="utf-8")


@pytest.fixture(autouse=True)
def _one_thread_in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    torch.set_num_threads(1)


CELLS = re.findall(r"^# %% sb3\.\w+[^\n]*\n(.*?)(?=^# %%|\Z)", EXAMPLES, flags=re.M | re.S)
LEARNERS = re.compile(r"^```python learners\n(.*?)^```$", flags=re.M | re.S)
TRAINED, ONE, FLOWN = LEARNERS.findall(PAGE)
TUTORIAL = LEARNERS.findall((ROOT / "docs" / "tutorials" / "learn-by-gradient.md").read_text(encoding="utf-8"))


def test_there_is_something_to_run():
    assert (len(CELLS), len(TUTORIAL)) == (2, 4)


@pytest.mark.parametrize("code", [*CELLS, ONE, "".join(TUTORIAL)])
def test_what_the_page_says_runs(code):
    exec(compile(code, "environments.md", "exec"), {"__name__": "__main__"})


def test_the_first_policy_balances_as_a_law():
    """From a lean a little beyond those of training it is never lost, and up at the end as scores mean it."""
    names = {"__name__": "__main__"}
    exec(compile(TRAINED + ONE + FLOWN, "environments.md", "exec"), names)
    assert names["run"].y[:, 2].min() > 0.5
    assert names["run"].y[-1, 2] > scores.UP


def test_the_example_trains_a_policy_that_balances():
    assert train.train()[1] >= 0.95


# Stable-Baselines3 --------------------------------------------------------------------------------------------------


def test_sb3_by_name():
    """The one-liner of its README."""
    model = PPO("MlpPolicy", ID, n_steps=64).learn(128)
    env = model.get_env()
    seen = env.reset()
    for _ in range(10):
        action, _ = model.predict(seen, deterministic=True)
        seen, _, _, _ = env.step(action)
        assert env.render("rgb_array").shape == (480, 480, 3)


def test_sb3_on_worlds_made_one_by_one():
    env = made_one_by_one(ID, n_envs=4, seed=0, monitor_dir="logs")
    PPO("MlpPolicy", env, n_steps=64).learn(256)
    assert len(load_results("logs"))


def test_sb3_has_nothing_to_say(recwarn):
    check_env(gym.make(ID, render_mode="rgb_array"))
    assert not [one for one in recwarn.list if "flypend" in str(one.filename)]
    assert isinstance(Monitor(gym.make(ID)).reset(seed=0)[0], np.ndarray)


def test_the_adapter_is_the_librarys_own_vector_but_faster():
    """Bit for bit until worlds end: after that they begin differently."""
    ours, theirs = make_vec_env(ID, 5), made_one_by_one(ID, 5)
    assert isinstance(theirs, DummyVecEnv)
    for env in (ours, theirs):
        env.seed(7)
    assert np.array_equal(ours.reset(), theirs.reset())
    actions, over = np.full((5, 4), -0.7, dtype=np.float32), np.zeros(5, dtype=bool)
    while not over.any():
        mine, others = ours.step(actions), theirs.step(actions)
        over = mine[2]
        assert np.array_equal(mine[0][~over], others[0][~over])
        assert np.array_equal(mine[1], others[1])
        assert np.array_equal(over, others[2])
    for i in np.flatnonzero(over):
        told, same = mine[3][i], others[3][i]
        assert np.array_equal(told["terminal_observation"], same["terminal_observation"])
        assert told["TimeLimit.truncated"] is same["TimeLimit.truncated"] is False
        assert told["episode"]["l"] == same["episode"]["l"]
        assert told["episode"]["r"] == pytest.approx(same["episode"]["r"], rel=1e-4)  # float32, and 6 decimals there


def test_a_world_that_is_cut_off_says_so():
    env = make_vec_env("flypend/SwingUp-v0", 2, seed=0, env_kwargs={"duration": 0.05})
    env.reset()
    results = [env.step(np.zeros((2, 4))) for _ in range(5)]
    assert [result[2].tolist() for result in results] == [[False] * 2] * 4 + [[True] * 2]
    assert results[-1][3][0]["TimeLimit.truncated"] is True


def test_sb3_trains_evaluates_films_and_keeps_a_log_of_many():
    env = make_vec_env(ID, n_envs=16, seed=0, monitor_dir="logs")
    model = PPO("MlpPolicy", VecNormalize(env), n_steps=32, batch_size=256).learn(1024)
    assert len(load_results("logs")) > 5
    assert 0 < evaluate_policy(model, env, 16)[0] < 500
    film = VecVideoRecorder(make_vec_env(ID, 4), "film", record_video_trigger=lambda step: step == 0, video_length=10)
    film.reset()
    for _ in range(11):
        film.step(np.zeros((4, 4)))
    film.close()
    assert next(Path("film").glob("*.mp4")).stat().st_size > 1000
    SAC("MlpPolicy", make_vec_env("flypend/SwingUp-v0", 4), learning_starts=40, buffer_size=1000).learn(80)


def test_the_adapter_refuses_worlds_that_do_otherwise():
    for arguments, field in (({"autoreset_mode": "NextStep"}, "autoreset_mode"), ({"copy": False}, "copy")):
        with pytest.raises(fp.InputError, match=rf"^{field}: "):
            VecWorlds(VectorWorlds("balance", 2, **arguments))
    with pytest.raises(NotImplementedError):
        VecWorlds(VectorWorlds("balance", 2)).env_method("render")
    with pytest.raises(fp.InputError, match=r"^raet: "):
        make_vec_env(ID, env_kwargs={"raet": 3})
    assert make_vec_env(ID, env_kwargs={"render_mode": None}).render_mode is None


def test_torch_shares_the_memory_of_the_worlds():
    worlds = gym.make_vec(ID, 8, copy=False)
    seen, _ = worlds.reset(seed=0)
    shared = torch.from_dlpack(seen)
    worlds.step(np.zeros((8, 4)))
    assert shared.data_ptr() == seen.ctypes.data
    assert np.array_equal(shared.numpy(), worlds.unwrapped.worlds.observations)


@pytest.mark.parametrize(
    ("name", "steps", "seen_as"), [("ppo", 32_768, learners.BODY), ("sac", 8_448, learners.BODY), ("ppo", 32_768, {})]
)
def test_the_shipped_settings_train(name, steps, seen_as, monkeypatch):
    """One look at the score; whether they learn is measured, by `python -m benchmarks.scores`."""
    monkeypatch.setitem(learners.EVERY, name, steps // learners.RARER["swing_up"])
    found = learners.trained(name, "swing_up", 0, lambda one: 1.0, wanted=0.5, seconds=1, seen_as=seen_as)
    assert found.steps == steps
    assert scores.scored("swing_up", found.policy, 4, 0, **seen_as).returns.shape == (4,)


# Others -------------------------------------------------------------------------------------------------------------


def test_sbx():
    import sbx

    sbx.PPO("MlpPolicy", ID, n_steps=64, n_epochs=1).learn(total_timesteps=64)
    sbx.PPO("MlpPolicy", make_vec_env(ID, 16), n_steps=16, n_epochs=1).learn(256)


def cleanrl_env(idx, capture_video):
    """`make_env` of CleanRL's ppo_continuous_action.py, line by line."""

    def thunk():
        if capture_video and idx == 0:
            env = gym.make(ID, render_mode="rgb_array")
            env = gym.wrappers.RecordVideo(env, "videos")
        else:
            env = gym.make(ID)
        env = gym.wrappers.FlattenObservation(env)
        env = gym.wrappers.RecordEpisodeStatistics(env)
        env = gym.wrappers.ClipAction(env)
        env = gym.wrappers.NormalizeObservation(env)
        env = gym.wrappers.TransformObservation(env, lambda obs: np.clip(obs, -10, 10), env.observation_space)
        env = gym.wrappers.NormalizeReward(env, gamma=0.99)
        return gym.wrappers.TransformReward(env, lambda reward: np.clip(reward, -10, 10))

    return thunk


def test_cleanrl():
    envs = gym.vector.SyncVectorEnv([cleanrl_env(i, capture_video=True) for i in range(2)])
    actor = torch.nn.Sequential(torch.nn.Linear(envs.single_observation_space.shape[0], 64), torch.nn.Tanh(),
                                torch.nn.Linear(64, 4))  # fmt: skip
    seen, _ = envs.reset(seed=1)
    returns = []
    while len(returns) < 2:
        with torch.no_grad():
            action = actor(torch.Tensor(seen))
        seen, reward, _, _, infos = envs.step(action.numpy())
        assert torch.tensor(reward).view(-1).shape == (2,)
        if "episode" in infos:
            returns += infos["episode"]["r"][infos["_episode"]].tolist()
    envs.close()
    assert next(Path("videos").glob("*.mp4")).stat().st_size > 1000


def test_cleanrl_loop_on_many_at_once():
    envs = gym.wrappers.vector.RecordEpisodeStatistics(gym.make_vec(ID, 64, autoreset_mode="NextStep"))
    envs.reset(seed=1)
    lengths = []
    while not lengths:
        *_, infos = envs.step(np.full((64, 4), -0.7))
        lengths = list(infos.get("episode", {}).get("l", []))
    assert max(lengths) > 10


def test_a_window_shows_what_is_flown(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    env = gym.make(ID, render_mode="human")
    env.reset(seed=0)
    env.step(env.action_space.sample())
    env.close()


def test_torchrl():
    from torchrl.envs import GymEnv, check_env_specs

    env = GymEnv(ID)
    check_env_specs(env)
    told = env.rollout(max_steps=20)
    assert told["next", "observation"].shape == (20, 32)


def test_rllib():
    from ray.rllib.algorithms.ppo import PPOConfig

    config = (
        PPOConfig()
        .environment(ID)
        .env_runners(num_env_runners=0)
        .training(lr=0.0002, train_batch_size_per_learner=256, minibatch_size=128, num_epochs=1)
    )
    algo = config.build_algo()
    told = algo.train()
    algo.stop()
    assert told["env_runners"]["episode_return_mean"] > 0


def test_torch_differentiates_a_flight():
    """Through three steps in double precision, against differences; a network in single precision gets a gradient."""
    worlds = flypend.envs.DifferentiableWorlds("balance")
    begun, seen = map(torch.from_numpy, worlds.begin(range(5)))

    def paid(actions):
        memory, total = begun, 0
        for action in actions:
            memory, _, rewards, ended = worlds.torch(memory, action)
            assert not ended.any()
            total = total + rewards.sum()
        return total

    generator = torch.Generator().manual_seed(0)
    actions, way = (0.1 * torch.randn(3, 5, 4, dtype=torch.float64, generator=generator) for _ in range(2))
    actions.requires_grad_(True)
    (gradient,) = torch.autograd.grad(paid(actions), actions)
    h = 1e-5
    with torch.no_grad():
        difference = (paid(actions + h * way) - paid(actions - h * way)) / (2 * h)
    assert float((gradient * way).sum()) == pytest.approx(float(difference), rel=1e-6)  # h² of the third derivative
    policy = torch.nn.Linear(32, 4)
    paid([policy(seen)]).backward()
    assert policy.weight.grad.dtype == torch.float32
    assert bool((policy.weight.grad != 0).any())


def test_torch_refuses_second_derivatives():
    worlds = flypend.envs.DifferentiableWorlds("balance")
    begun, _ = map(torch.from_numpy, worlds.begin(range(3)))
    actions = torch.full((3, 4), 0.1, dtype=torch.float64, requires_grad=True)
    with pytest.raises(fp.InputError, match=r"^create_graph: "):
        torch.autograd.grad(worlds.torch(begun, actions).rewards.sum(), actions, create_graph=True)


def test_the_example_learns_by_the_gradient():
    """In forty updates the cost of flights from other starts falls by more than a quarter: to 0.64 when measured."""
    worlds = flypend.envs.DifferentiableWorlds("balance", rate=gradient.RATE, observe="state")
    torch.manual_seed(0)
    untrained, (trained, steps) = gradient.Policy(worlds.env.vehicle), gradient.train("balance", most=40)

    def cost(policy):
        with torch.no_grad():
            seen = gradient.flown(policy, worlds, *gradient.begun(worlds, 10**6, None, 0.0), 25)
            return float(gradient.distance(seen, policy).mean())

    assert steps == 256 * sum(10 + update // 2 for update in range(40))
    assert cost(trained) < 0.75 * cost(untrained)


def test_the_example_begins_on_flights_that_end_upright():
    """Observations are those of the memory; with time, they begin nearer to hanging."""
    worlds = flypend.envs.DifferentiableWorlds("swing_up", rate=gradient.RATE, observe="state")
    paths = gradient.Paths(worlds, count=8)
    policy, heights = gradient.Policy(worlds.env.vehicle), []
    for back in (0.0, 1.0, gradient.FARTHEST):
        memory, observed = gradient.begun(worlds, 1, paths, back)
        stepped = worlds.torch(memory, policy(observed))
        assert torch.allclose(stepped.observations, observed, atol=1.0)  # a step of 20 ms
        state = fp.State.from_packed(memory[0, 1:25].numpy())
        assert np.allclose(observed[0, 6:15].numpy(), state.R.ravel(order="F"), atol=1e-6)
        heights.append(float(observed[:, 20].mean()))
    assert heights[0] > 0.97 > heights[1] > heights[2]
