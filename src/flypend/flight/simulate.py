"""A single closed-loop run: vehicle, law and start in, `Trajectory` out."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend import errors, plants, signals
from flypend.compile.numeric import as_numpy
from flypend.compile.problem import LONGEST
from flypend.flight.kernels import SampledKernel, has_kernel, kernel_of
from flypend.flight.kernels.launch import Solution, sampled_samples
from flypend.flight.request import Flight, Tolerances, bound_to, some_times
from flypend.flight.sampled import fly_stepwise
from flypend.flight.touch import watcher
from flypend.flight.trajectory import Trajectory
from flypend.geometry import Numbers
from flypend.laws import AnyLaw, BoundLaw
from flypend.laws.closed_loop import ClosedLoop, close_loop, lyapunov_function, signal_names
from flypend.laws.references import sample
from flypend.model import State, Vehicle
from flypend.model.state import SIZE, convert_packed, project, split
from flypend.plants import AnyPlant, Ideal, Sampled

if TYPE_CHECKING:
    from flypend.flight.integrate import Integration

ENGINES = ("kernel", "scipy")


@errors.named_arguments
@signals.defer()
def simulate(
    vehicle: Vehicle,
    law: AnyLaw,
    start: State,
    duration: float,
    *,
    plant: str | AnyPlant = "rotors",
    rtol: float = 1e-9,
    atol: float | None = None,
    times: ArrayLike | None = None,
    engine: str = "kernel",
) -> Trajectory:
    """Fly `vehicle` under `law` from `start` for `duration` seconds.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle parameters.
    law : Law or Controller
        Control law. Its `e3` is the frame of `start` and of the result.
    start : State
        A single state.
    duration : float
        Flight time, s, > 0.
    plant : str, Ideal or Plant
        "rotors" (limits, lag and sampling, with the built-in equations), "ideal" (continuous time, the wrench acts as
        commanded; a Controller is sampled at its rate), "mujoco" (like "rotors", but integrated by MuJoCo), "hehn2011"
        (thrust and body rates at 50 Hz), or a `Plant`.
    rtol, atol : float
        Tolerances of the adaptive step in the ideal plant (DOP853; at 1e-6 and looser DP5, which is faster there). atol
        defaults to rtol, since state entries are of order one in SI units. A sampled flight has fixed steps of at
        most `plants.schedule.PLANT_STEP`.
    times : (n,) increasing, optional
        Sample times, s; default every 0.01 s. In a sampled flight, the nearest control ticks. A run that ends early is
        sampled up to its end.
    engine : "kernel" or "scipy"
        Machine code compiled for vehicle, law and plant; or the independent reference: SciPy's DOP853 for the ideal
        plant, step by step in Python for a sampled one. A Controller has no kernel and always uses the latter.

    Returns
    -------
    Trajectory
        Also if the run diverges or reaches a singularity of the law: see `Trajectory.outcome`.

    Raises
    ------
    InputError
        If `start` is a batch, a duration or tolerance is not positive, times lie outside the run, or the engine is
        unknown.
    """
    if isinstance(start, State) and start.batch_shape:
        raise errors.InputError("start", "a single state", f"a batch of shape {start.batch_shape}")
    exact = Tolerances(rtol=rtol, atol=atol)
    flight = Flight(
        vehicle=vehicle, law=bound_to(vehicle, law), starts=start, duration=duration, plant=plants.plant(plant),
        tolerances=exact, times=some_times(times),
    )  # fmt: skip
    return fly(flight, engine)


def fly(flight: Flight, engine: str = "kernel") -> Trajectory:
    """Fly a request with a single start by `engine`, "kernel" or "scipy", as in `simulate`."""
    errors.one_of("engine", engine, ENGINES)
    plant = flight.plant
    run = _ideal(flight, engine) if isinstance(plant, Ideal) else _fly_sampled(flight, plant, engine)
    return replace(run, flight=flight)


def _ideal(flight: Flight, engine: str) -> Trajectory:
    """Fly the closed loop in continuous time; the wrench acts as commanded, or after the rotors' lag."""
    loop = close_loop(flight.vehicle, flight.loop.symbolic, lag=flight.loop.lag)
    solution = Solution(kernel_of(flight), flight) if engine == "kernel" else _by_scipy(flight, loop)
    wanted, end = flight.moments, solution.outcome.time
    t = wanted if solution.outcome.status == "completed" else np.append(wanted[wanted < end], end)
    packed = solution(t)
    values = np.array(loop.outputs(t[None], packed.T)).T
    law, vehicle, wrench = flight.law, flight.vehicle, values[:, :4]
    return record_run(
        law, vehicle, t, packed, wrench, rotor_forces=wrench @ vehicle.unmixing(law.e3).T,
        signals=dict(zip(loop.signal_names, values[:, 4:].T, strict=True)), drift=solution.drift,
        outcome=solution.outcome, interpolant=(lambda t: solution(t)[..., :SIZE]) if flight.loop.lag else solution,
    )  # fmt: skip


def _by_scipy(flight: Flight, loop: ClosedLoop) -> Integration:
    errors.require("scipy", extra="studies", for_="engine")
    from flypend.flight.integrate import integrate  # SciPy's integrators are slow to import, and not needed by kernels

    guard, margin, reason = loop.law.guard, None, ""
    if guard is not None:
        errors.one_of("law.guard", guard.signal, loop.signal_names)
        outputs = as_numpy(loop.outputs)
        row, threshold, reason = 4 + loop.signal_names.index(guard.signal), guard.threshold, guard.reason

        def margin(t: float, s: Numbers) -> float:
            return float(outputs(t, s)[row]) - threshold

    return integrate(
        as_numpy(loop.rates), flight.packed[0], flight.duration, flight.tolerances, margin=margin, margin_reason=reason,
        touch=_touch(flight, loop),
    )  # fmt: skip


def _touch(flight: Flight, loop: ClosedLoop) -> Callable[[Any], tuple[float, str] | None]:
    """Return what looks for a touch in the interpolant of a step, every two milliseconds; at the start, in None."""
    if not flight.loop.touches:
        return lambda _: None
    watch = watcher(flight.vehicle, flight.law.e3, by_rotors=False, floor=flight.plant.floor)
    start = flight.packed[0]
    outputs = as_numpy(loop.outputs)

    def state(interpolant: Any, t: float) -> Numbers:
        packed = project(interpolant(t))[0]
        return np.append(packed[:SIZE], outputs(t, packed)[0])

    def look(interpolant: Any) -> tuple[float, str] | None:
        if interpolant is None:
            begin = np.append(start[:SIZE], outputs(0.0, start)[0])
            touch = watch(begin, begin, 0.0)
            return None if touch is None else (0.0, touch.reason)
        times = np.linspace(interpolant.t_old, interpolant.t, 2 + int((interpolant.t - interpolant.t_old) / LONGEST))
        for a, b in pairwise(times):
            if (touch := watch(state(interpolant, a), state(interpolant, b), b - a)) is not None:
                return float(a + touch.share * (b - a)), touch.reason
        return None

    return look


def _fly_sampled(flight: Flight, plant: Sampled, engine: str) -> Trajectory:
    """Fly a sampled flight; it is recorded at the control ticks nearest to the sample times."""
    if engine == "kernel" and has_kernel(flight):
        kernel = kernel_of(flight)
        assert isinstance(kernel, SampledKernel)
        samples = sampled_samples(kernel, flight)
    else:
        samples = fly_stepwise(flight).at(flight.moments * plant.rate)
    law, vehicle = flight.law, flight.vehicle
    wrench = samples.rotors @ plant.true_vehicle(vehicle).mixing(law.e3).T
    packed = convert_packed(samples.packed, law.e3)
    told = Signals(vehicle, law, samples.t, packed) if isinstance(law, BoundLaw) else {}
    return record_run(
        law, vehicle, samples.t, packed, wrench, rotor_forces=samples.rotors, signals=told, outcome=samples.outcome
    )


def record_run(law: AnyLaw, vehicle: Vehicle, t: Numbers, packed: Numbers, wrench: Numbers, **more: Any) -> Trajectory:
    """Return the run of `vehicle` under `law` with states `packed` (n, 24) and `wrench` (n, 4) at times `t` (n,), s.

    `more` are fields of `Trajectory`, which win over these; by default without drift, and with the gains of the law.
    """
    known = {
        **split(packed), "thrust": wrench[:, 0], "moment": wrench[:, 1:], "drift": np.zeros((0, 3)), "e3": law.e3,
        "law": law.name, "gains": dict(law.gains),
        "x_ref": None if law.reference is None else sample(law.reference, t),
    }  # fmt: skip
    return Trajectory(t=t, vehicle=vehicle, **known | more)


class Signals(Mapping[str, NDArray[np.float64]]):
    """Signals (n,) of `law` along a sampled flight by name, computed on first access.

    Building the closed loop takes longer than a flight. V is computed without the rest, whose rates take most of that
    time: it is all that a page asks for.

    Parameters
    ----------
    vehicle, law
        The ideal closed loop, along which rates such as V_rate are.
    t : (n,)
        Times, s.
    packed : (n, 24)
        States in the law's frame.
    """

    def __init__(self, vehicle: Vehicle, law: BoundLaw, t: NDArray[np.float64], packed: NDArray[np.float64]) -> None:
        self._vehicle, self._law, self._t, self._packed = vehicle, law, t, packed

    @cached_property
    def _names(self) -> tuple[str, ...]:
        return signal_names(self._vehicle, self._law)

    @cached_property
    def _lyapunov(self) -> NDArray[np.float64] | None:
        function = lyapunov_function(self._vehicle, self._law)
        return None if function is None else np.array(function(self._t[None], self._packed.T, []))[0]

    @cached_property
    def _values(self) -> dict[str, NDArray[np.float64]]:
        loop = close_loop(self._vehicle, self._law)
        values = np.array(loop.outputs(self._t[None], self._packed.T))[4:]
        return dict(zip(loop.signal_names, values, strict=True))

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        if name not in self._names:
            raise KeyError(name)
        if name == "V" and self._lyapunov is not None:
            return self._lyapunov
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle as a plain dict: CasADi symbols cannot be pickled."""
        return dict, (dict(self),)
