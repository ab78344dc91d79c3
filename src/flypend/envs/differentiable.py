"""Worlds as a pure function with derivatives: a step's vector-Jacobian product, for PyTorch, JAX and NumPy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property, lru_cache
from importlib import import_module
from typing import Any, NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.compile.chain import Chain
from flypend.compile.llvm.stagewise import WIDTH, Stagewise, lanes, stagewise
from flypend.compile.llvm.worlds import BOUND
from flypend.envs.kernel import Worlds, in_threads, shares_of
from flypend.envs.make import environment_for
from flypend.envs.problem import Environment, Parts
from flypend.errors import InputError
from flypend.geometry import clip
from flypend.model.state import SIZE
from flypend.plants.actuation import OMEGA
from flypend.plants.plant import are_seeds, check_seed


class Stepped(NamedTuple):
    """What a step returns; see `DifferentiableWorlds`.

    `memory` (count, size) of float64 are the worlds afterwards, `observations` (count, k) what is observed then,
    `rewards` (count,) those of the step, and `ended` (count,) of bool whether the task has ended, or the world is lost.
    """

    memory: Any
    observations: Any
    rewards: Any
    ended: Any


class DifferentiableWorlds:
    """Worlds as a function (memory, actions) → (memory, observations, rewards, ended), with derivatives.

    The function equals the step of `VectorWorlds` to roundoff. But it stores nothing and resets nothing: a world that
    has ended goes on until the caller replaces its row of the memory. A world whose state is not finite or out of
    bounds is lost: it stays as it was, and passes no gradient.

    A row of `memory` (count, size), float64, is a world: the number of actions since its beginning, state (24), rotor
    forces (n), N, the last action (m), commands on their way, wind, timing, what `randomise` drew, and the goal. Rows
    are independent.

    Parameters
    ----------
    task, arguments
        See `flypend.envs.environment`; the mount must be a gimbal, and sensors "perfect".
    workers : int, optional
        Threads; default one per core.

    Raises
    ------
    InputError
        As `flypend.envs.environment`, and for another mount or sensors.
    """

    def __init__(self, task: Any = "balance", *, workers: int | None = None, **arguments: Any) -> None:
        self.env = environment_for(type(self), task, arguments)
        if self.env.plant.floor is not None:
            raise InputError("plant.floor", "none: touching has no derivative", f"{self.env.plant.floor:g}")
        if self.env.vehicle.mount != "gimbal":
            raise InputError("mount", "'gimbal': touching has no derivative", repr(self.env.vehicle.mount))
        if self.env.sensors is not None:
            raise InputError("sensors", "'perfect', of worlds with derivatives", repr(self.env.sensors))
        self.workers = None if workers is None else errors.integer("workers", workers, 1)

    def begin(self, seeds: Sequence[int]) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
        """Return memory (count, size) and observations (count, k) of new worlds, one per seed.

        They are those of `VectorWorlds` with these seeds. Raises InputError unless these are integers from 0.
        """
        if not are_seeds(seeds) or len(seeds) == 0:
            raise InputError("seeds", "a sequence of integers", repr(seeds)[:80])
        for seed in seeds:
            check_seed("seeds", seed)
        worlds = Worlds(self.env, len(seeds), self.workers)
        worlds.begin(np.asarray(seeds, dtype=np.int64))
        memory = np.concatenate([np.zeros((len(seeds), 1)), worlds.part("state", self.size - 1)], axis=1)
        return memory, worlds.observations.copy()

    def step(self, memory: Any, actions: Any) -> Stepped:
        """Advance worlds (count, size) by `actions` (count, m), each in [−1, 1].

        Raises InputError for other shapes.
        """
        memory, actions = self._given(memory, actions)
        after, seen, judged = self._run(0, memory, actions)
        lost = _lost(judged, actions)
        rewards = np.where(lost & ~np.isfinite(judged[:, 0]), 0.0, judged[:, 0])
        seen = np.where(lost[:, None], np.nan_to_num(seen), seen)
        return Stepped(np.where(lost[:, None], memory, after), seen, rewards, lost | (judged[:, 1] > 0))

    def pullback(
        self, memory: Any, actions: Any, to_memory: Any, to_observations: Any, to_rewards: Any
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the gradients of `memory` (count, size) and `actions` (count, m), from those of what `step` returns.

        Where a number is limited, such as an action outside [−1, 1], the derivative is that of the limit: 0.
        """
        memory, actions = self._given(memory, actions)
        given = (to_memory, to_observations, np.reshape(to_rewards, (-1, 1)))
        before, to_actions, judged = self._run(1, memory, actions, *given)
        kept = ~_lost(judged, actions)[:, None]
        return np.where(kept, before, 0.0), np.where(kept, to_actions, 0.0)

    def torch(self, memory: Any, actions: Any) -> Stepped:
        """`step` for tensors of PyTorch on the CPU, with autograd; observations and rewards are of the actions' type.

        There are first derivatives only: with `create_graph=True` the gradient raises InputError.
        `memory` is a tensor of float64, such as `torch.from_numpy` makes of that of `begin`.
        """
        return Stepped(*_torch_step().apply(self, memory, actions))

    def jax(self, memory: Any, actions: Any) -> Stepped:
        """`step` for arrays of JAX, with `grad`, `jit` and `scan`; results are of the types of `memory` and `actions`.

        Unless JAX works in double precision (`jax_enable_x64`), the memory is rounded after every step.
        """
        return Stepped(*self._jax_step(memory, actions))

    @cached_property
    def _jax_step(self) -> Any:
        try:
            jax: Any = import_module("jax")
        except ModuleNotFoundError as missing:
            raise InputError("worlds.jax", "JAX (pip install jax)", f"no module {missing.name}") from None

        def called(function: Any, *arguments: Any, like: Any) -> Any:
            kinds = [jax.ShapeDtypeStruct(shape, kind) for shape, kind in like]

            def on_host(*values: Any) -> Any:
                found = function(*map(np.asarray, values))
                return tuple(np.asarray(value, kind.dtype) for value, kind in zip(found, kinds, strict=True))

            return jax.pure_callback(on_host, kinds, *arguments)

        @jax.custom_vjp  # type: ignore[untyped-decorator]
        def step(memory: Any, actions: Any) -> Any:
            count, kind, seen = len(memory), actions.dtype, self._programs[0].nnz_out(1)
            like = [(memory.shape, memory.dtype), ((count, seen), kind), ((count,), kind), ((count,), bool)]
            return tuple(called(self.step, memory, actions, like=like))

        def back(given: Any, gradients: Any) -> Any:
            like = [(array.shape, array.dtype) for array in given]
            return tuple(called(self.pullback, *given, *gradients[:3], like=like))

        step.defvjp(lambda memory, actions: (step(memory, actions), (memory, actions)), back)
        return step

    @property
    def size(self) -> int:
        """Length of a row of the memory."""
        return int(self._programs[0].nnz_in(0))

    @cached_property
    def _programs(self) -> tuple[ca.Function, ca.Function]:
        return step_and_pullback(self.env)

    @cached_property
    def _loops(self) -> tuple[Stagewise, Stagewise]:
        forward, backward = self._programs
        return stagewise(forward), stagewise(backward)

    def _given(self, memory: Any, actions: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        memory, actions = np.asarray(memory, dtype=float), np.asarray(actions, dtype=float)
        count = len(memory) if memory.ndim else 0
        for name, array, length in (("memory", memory, self.size), ("actions", actions, self.env.actions)):
            if array.shape != (count, length) or not count:
                raise InputError(name, f"numbers of shape (count, {length})", f"shape {array.shape}")
        return memory, actions

    def _run(self, which: int, *rows: Any) -> list[NDArray[np.float64]]:
        """Return what program number `which` makes of `rows` (count, …) of its inputs, in rows."""
        program, loop, count = self._programs[which], self._loops[which], len(rows[0])
        groups = -(-count // WIDTH)
        inputs = [lanes(groups, program.nnz_in(i)) for i in range(program.n_in())]
        outputs = [lanes(groups, program.nnz_out(i)) for i in range(program.n_out())]
        filled = np.minimum(np.arange(groups * WIDTH), count - 1)  # the last world fills the last group
        for array, given in zip(inputs, rows, strict=True):
            array[:] = np.asarray(given)[filled].reshape(groups, WIDTH, -1).transpose(0, 2, 1)
        in_threads(loop.on(*inputs, *outputs), shares_of(groups, self.workers))
        return [array.transpose(0, 2, 1).reshape(groups * WIDTH, -1)[:count] for array in outputs]


def _lost(judged: NDArray[np.float64], actions: NDArray[np.float64]) -> NDArray[np.bool_]:
    return (judged[:, 2] > 0) | ~np.isfinite(actions).all(axis=1)


def step_and_pullback(env: Environment) -> tuple[ca.Function, ca.Function]:
    """Return a step of `env`, and its vector-Jacobian product, as calls of scalar functions.

    (memory, action) → (memory, observation, (reward, ended, lost)), the last two above 0 if so; and (memory, action,
    gradients of memory, observation and reward) → (gradients of memory and action, (reward, ended, lost)).
    """
    parts, chain = Parts(env), Chain()
    parts.begin()  # which finds the length of the goal
    lengths = [1, *parts.lengths, parts.goals]
    memory, action = ca.MX.sym("memory", sum(lengths)), ca.MX.sym("action", env.actions)
    before = ca.vertsplit(memory, [0, *np.cumsum(lengths).tolist()])
    clock, state, rotors, acted, queue, wind, timing, numbers, delay, goal = before
    rates, step = env.action == "rates", parts.step()
    asked = chain.call(_scalar("asked", [env.actions], lambda a: [clip(a, -1.0, 1.0)]), action)
    command = chain.call(parts.command(), asked)
    for i in range(env.steps):
        held = chain.call(_hold(parts), ca.MX(i), command, queue, delay) if parts.queued else command
        forces = chain.call(_follow_rates(parts), held, state) if rates else held
        state, rotors = chain.call(step, state, rotors, forces, wind, timing, numbers)
    if parts.queued:
        sizes = [parts.width, queue.numel()]
        queue = chain.call(
            _scalar("queued", sizes, lambda new, old: [ca.vertcat(new, old[: -parts.width])]), command, queue
        )
    clock = chain.call(_scalar("ticked", [1], lambda clock: [clock + 1]), clock)
    rest = [queue, wind, timing, numbers, delay, goal]
    seen = chain.call(_observe(parts, lengths), clock, state, rotors, asked, *rest)
    reward, ended, lost = chain.call(_judge(parts, lengths), clock, state, rotors, acted, *rest, asked)
    after = [clock, state, rotors, asked, *rest]
    judged = ca.vertcat(reward, ended, lost)
    to_after = ca.MX.sym("to_memory", memory.numel())
    to_seen, to_reward = ca.MX.sym("to_seen", seen.numel()), ca.MX.sym("to_reward")
    seeds = [*zip(after, ca.vertsplit(to_after, [0, *np.cumsum(lengths).tolist()]), strict=True)]
    *to_before, to_action = chain.pullback([*seeds, (seen, to_seen), (reward, to_reward)], [*before, action])
    return (
        ca.Function("advance", [memory, action], [ca.vertcat(*after), seen, judged]),
        ca.Function(
            "pullback", [memory, action, to_after, to_seen, to_reward], [ca.vertcat(*to_before), to_action, judged]
        ),
    )


def _scalar(name: str, lengths: Sequence[int], made: Callable[..., list[Any]]) -> ca.Function:
    """Return the function of vectors of these `lengths` whose outputs are what is `made` of their symbols."""
    vectors = [ca.SX.sym(f"v{i}", length) for i, length in enumerate(lengths)]
    return ca.Function(name, vectors, list(map(ca.densify, made(*vectors))))


def _hold(parts: Parts) -> ca.Function:
    """(step, command, queue, delay) → the command that acts in that step: `hold` in compile/loops/worlds.cpp."""
    width, queued, steps = parts.width, parts.queued, parts.env.steps

    def held(*given: Any) -> list[Any]:
        step, acting, queue, delay = given
        for age in range(queued):
            earlier = queue[age * width : (age + 1) * width]
            acting = ca.if_else(delay - step > age * steps, earlier, acting)
        return [acting]

    return _scalar("held", [1, width, queued * width, 1], held)


def _follow_rates(parts: Parts) -> ca.Function:
    """(command, state) → rotor forces, by the rate loop."""
    loop = parts.loop()
    return _scalar("rate_loop", [parts.width, SIZE], lambda command, state: [loop(command, state[OMEGA], ca.SX(0, 1))])


def _observe(parts: Parts, lengths: Sequence[int]) -> ca.Function:
    """(parts of the memory) → observation, limited as in compile/loops/worlds.cpp."""

    def observe(clock: Any, *memory: Any) -> list[Any]:
        return [clip(parts.observe()(clock / parts.env.rate, ca.vertcat(*memory)), -BOUND, BOUND)]

    return _scalar("observe", lengths, observe)


def _judge(parts: Parts, lengths: Sequence[int]) -> ca.Function:
    """(parts of the memory, with the action before; action) → reward, ended, lost."""

    def judge(clock: Any, *given: Any) -> list[Any]:
        *memory, action = given
        reward, ended = parts.judge()(clock / parts.env.rate, ca.vertcat(*memory), action)
        return [reward, ended, ca.logic_not(ca.sumsqr(ca.vertcat(memory[0], memory[1])) < BOUND**2)]

    return _scalar("judge", [*lengths, parts.env.actions], judge)


@lru_cache(maxsize=1)
def _torch_step() -> Any:
    """The function of PyTorch's autograd."""
    try:
        torch: Any = import_module("torch")
    except ModuleNotFoundError as missing:
        raise InputError("worlds.torch", "PyTorch (pip install torch)", f"no module {missing.name}") from None

    def tensors(values: Sequence[Any], *kinds: Any) -> tuple[Any, ...]:
        return tuple(torch.from_numpy(value).to(kind) for value, kind in zip(values, kinds, strict=True))

    class Step(torch.autograd.Function):  # type: ignore[misc]
        @staticmethod
        def forward(ctx: Any, worlds: DifferentiableWorlds, memory: Any, actions: Any) -> Any:
            """Step the worlds; tensors in, tensors out."""
            ctx.worlds = worlds
            ctx.save_for_backward(memory, actions)
            stepped = worlds.step(memory.detach().numpy(), actions.detach().numpy())
            found = tensors(stepped, memory.dtype, actions.dtype, actions.dtype, torch.bool)
            ctx.mark_non_differentiable(found[-1])
            return found

        @staticmethod
        def backward(ctx: Any, *gradients: Any) -> Any:
            if torch.is_grad_enabled():  # else what a second derivative lacks would count as 0
                raise InputError("create_graph", "False: worlds have first derivatives only", "True")
            memory, actions = ctx.saved_tensors
            given = [gradient.numpy() for gradient in gradients[:3]]
            found = ctx.worlds.pullback(memory.detach().numpy(), actions.detach().numpy(), *given)
            return None, *tensors(found, memory.dtype, actions.dtype)

    return Step
