"""Steps per second of many worlds at once, beside other simulators: `python -m benchmarks.worlds`, two minutes.

4,096 worlds, actions at 100 Hz over motion at 1 kHz, random actions, in turns. crazyflow (Euler steps of a Crazyflie,
rotor speeds commanded, JAX) and RotorPy (batched, PyTorch) fly where they are installed (`pip install crazyflow
rotorpy roma torchdiffeq`), MuJoCo by its own `rollout` over our model. They observe nothing, pay no reward and have no
rod but for MuJoCo's. Prints steps of the motion and of the environment per second on the wall, the best of some turns.

`--counts` steps 1 to 65,536 worlds of each task instead, in one thread, and prints steps of the environment per second
of processor time, the best of some turns: what else the machine does hardly counts.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import numpy as np

from benchmarks.results import machine

COUNT, STEPS, TURNS, ACTIONS = 4096, 10, 5, 20
Peer = tuple[str, int, Callable[[], None]]


def flypend() -> Iterator[Peer]:
    """Our worlds, with observations, rewards and beginnings."""
    from flypend.envs import VectorWorlds

    kinds: dict[str, dict[str, Any]] = {name: {"action": name} for name in ("rotors", "wrench", "rates")}
    kinds |= {f"rotors, {name}": {"sensors": name} for name in ("mocap", "onboard")}
    for name, arguments in kinds.items():
        worlds = VectorWorlds("swing_up", COUNT, copy=False, **arguments)
        worlds.reset(seed=0)
        given = np.random.default_rng(0).uniform(-1, 1, (ACTIONS, COUNT, 4)).astype(np.float32)

        def step(worlds: VectorWorlds = worlds, given: np.ndarray = given) -> None:
            for row in given:
                worlds.step(row)

        yield f"flypend, {name}", COUNT, step


def crazyflow() -> Iterator[Peer]:
    """crazyflow, ten steps a call."""
    import jax
    from crazyflow.control import Control
    from crazyflow.dynamics import Dynamics
    from crazyflow.sim import Sim

    sim = Sim(COUNT, freq=1000, control=Control.rotor_vel, dynamics=Dynamics.first_principles)
    given = np.random.default_rng(0).uniform(1.0, 2.0, (ACTIONS, COUNT, 1, 4)).astype(np.float32)

    def step() -> None:
        for row in given:
            sim.rotor_vel_control(1e4 * row)
            sim.step(STEPS)
        jax.block_until_ready(sim.data.states.pos)

    yield "crazyflow", COUNT, step


def rotorpy() -> Iterator[Peer]:
    """RotorPy's batch of Crazyflies, by the fourth-order method of fixed steps; fewer worlds, since it takes long."""
    import torch
    from rotorpy.vehicles.crazyflie_params import quad_params
    from rotorpy.vehicles.multirotor import BatchedMultirotor, BatchedMultirotorParams

    device, few = torch.device("cpu"), 256
    lengths = {"x": 3, "v": 3, "w": 3, "wind": 3, "rotor_speeds": 4}
    begin = {name: torch.zeros(few, length).double() for name, length in lengths.items()}
    begin["q"] = torch.tensor([0.0, 0.0, 0.0, 1.0]).double().repeat(few, 1)
    made = BatchedMultirotorParams([quad_params] * few, few, device)
    sim = BatchedMultirotor(made, few, begin, device, integrator="rk4")
    given = torch.from_numpy(np.random.default_rng(0).uniform(1000.0, 2000.0, (ACTIONS, few, 4)))

    def step() -> None:
        state = begin
        for row in given:
            for _ in range(STEPS):
                state = sim.step(state, {"cmd_motor_speeds": row}, 1e-3)

    yield "RotorPy", few, step


def mujoco() -> Iterator[Peer]:
    """MuJoCo's rollout on two threads, our vehicle with its rod; fewer worlds, since it takes long."""
    from mujoco import MjData, MjModel, mj_getState, mj_stateSize, mjtState
    from mujoco.rollout import Rollout

    import flypend as fp
    from flypend.model.mjcf import model_xml

    model, few = MjModel.from_xml_string(model_xml(fp.vehicle("hehn2011"), timestep=1e-3, lag=0.02, bare=True)), 64
    data = MjData(model)
    state = np.zeros(mj_stateSize(model, mjtState.mjSTATE_FULLPHYSICS))
    mj_getState(model, data, state, mjtState.mjSTATE_FULLPHYSICS)
    given = np.random.default_rng(0).uniform(0.1, 3.5, (few, ACTIONS, model.nu)).repeat(STEPS, axis=1)
    pool = Rollout(nthread=2)
    yield (
        "MuJoCo rollout",
        few,
        lambda: pool.rollout(model, [MjData(model), MjData(model)], np.tile(state, (few, 1)), given),
    )


KINDS: dict[str, dict[str, Any]] = {
    "Balance": {"task": "balance"}, "SwingUp": {"task": "swing_up"}, "Track": {"task": "track"},
    "CatchInCup": {"task": "catch_in_cup"}, "Balance, mocap": {"task": "balance", "sensors": "mocap"},
    "Balance, onboard": {"task": "balance", "sensors": "onboard"},
}  # fmt: skip
COUNTS = (1, 64, 1024, 8192, 65_536)


def by_count() -> None:
    """Print steps per second of processor time by task and number of worlds."""
    from flypend.envs import VectorWorlds

    print(f"{machine()['processor']}, {machine()['date']}, one thread\n")
    print("| task | " + " | ".join(f"{count:,}" for count in COUNTS) + " |")
    print("|---|" + "---|" * len(COUNTS))
    for name, arguments in KINDS.items():
        found = []
        for count in COUNTS:
            worlds, steps = VectorWorlds(num_envs=count, workers=1, copy=False, **arguments), max(3, 20_000 // count)
            worlds.reset(seed=0)
            given = np.random.default_rng(0).uniform(-1, 1, (count, 4)).astype(np.float32)
            best = np.inf
            for _ in range(TURNS):
                begin = time.process_time()
                for _ in range(min(steps, 2000)):
                    worlds.step(given)
                best = min(best, (time.process_time() - begin) / (count * min(steps, 2000)))
            found.append(f"{1 / best:,.0f}")
        print(f"| {name} | " + " | ".join(found) + " |", flush=True)


def main() -> None:
    """Print the table."""
    if "--counts" in sys.argv[1:]:
        by_count()
        return
    peers: list[Peer] = []
    for make in (flypend, crazyflow, rotorpy, mujoco):
        with suppress(ModuleNotFoundError):
            peers += make()
    best = dict.fromkeys((name for name, *_ in peers), np.inf)
    for turn in range(TURNS + 1):
        for name, count, step in peers:
            begin = time.perf_counter()
            step()
            if turn:  # the first compiles
                best[name] = min(best[name], (time.perf_counter() - begin) / (count * ACTIONS))
    where = machine()
    print(f"{where['processor']}, {where['cores']} cores (load {where['load']:.1f}), {where['date']}\n")
    print("| simulator | environment steps/s | steps of the motion/s | flypend, rotors, is … times as fast |")
    print("|---|---|---|---|")
    for name, seconds in best.items():
        print(f"| {name} | {1 / seconds:,.0f} | {STEPS / seconds:,.0f} | {seconds / best['flypend, rotors']:.1f} |")


if __name__ == "__main__":
    main()
