"""One closed-loop run: vehicle, law and start in, `Trajectory` out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from flypend import errors, plants
from flypend.compile.numeric import as_numpy
from flypend.flight.kernels import ideal_kernel, method_for
from flypend.flight.kernels.single import Solution, flown_by_kernel
from flypend.flight.sampled import fly, nearest_ticks
from flypend.flight.trajectory import Trajectory
from flypend.laws import AnyLaw, BoundLaw, Controller, Law
from flypend.laws.closed_loop import ClosedLoop, close_loop
from flypend.laws.references import sampled
from flypend.model import State, Vehicle
from flypend.model.state import FLIP_PACKED, split
from flypend.plants import Plant

if TYPE_CHECKING:
    from flypend.flight.integrate import Integration

SAMPLE_PERIOD = 0.01
LEAST_RTOL = 100 * float(np.finfo(float).eps)
LONGEST = 20_000.0  # s: two million samples, ten million control steps at 500 Hz


def simulate(
    vehicle: Vehicle,
    law: AnyLaw,
    start: State,
    duration: float,
    *,
    plant: str | Plant = "ideal",
    rtol: float = 1e-9,
    atol: float | None = None,
    times: Any = None,
    engine: str = "kernel",
) -> Trajectory:
    """Fly `vehicle` under `law` from `start` for `duration` seconds.

    Parameters
    ----------
    vehicle : Vehicle
        What flies.
    law : Law or Controller
        What steers it. Its `e3` is the frame of `start` and of the result.
    start : State
        A single state.
    duration : float
        Seconds, > 0.
    plant : str or Plant
        "ideal" (continuous time, the wrench acts as commanded; a Controller is sampled at its rate), "rotors" (limits,
        lag and sampling, integrated by the package's equations), "mujoco" (the same, integrated by MuJoCo), "hehn2011"
        (thrust and body rates at 50 Hz), or a `Plant`.
    rtol, atol : float
        Tolerances of the adaptive step (DOP853; from 1e-6 on DP5, which is faster there); atol defaults to rtol, since
        state entries are of order one in SI units.
        Used by the ideal plant; a sampled flight takes steps of 1 ms or less.
    times : (n,) increasing, optional
        Times to sample, s; default every 0.01 s. A sampled flight gives the nearest control ticks. A run that ends
        early is sampled up to its end.
    engine : "kernel" or "scipy"
        Machine code made for vehicle, law and plant, or the independent reference: SciPy's DOP853 for the ideal plant,
        a sampled flight step by step in Python. What has no kernel (a Controller, MuJoCo) takes the latter anyway.

    Returns
    -------
    Trajectory
        Also for a run that diverges or meets a singularity of the law: see `Trajectory.outcome`.

    Raises
    ------
    InputError
        For a batch of states, a duration or tolerance that is not positive, times outside the run, or an unknown
        engine.
    """
    _check(vehicle, law, start)
    bound = law.bind(vehicle)
    duration = errors.number("duration", duration, above=0, at_most=LONGEST, unit="s")
    rtol = errors.number("rtol", rtol, above=0)
    if rtol < LEAST_RTOL:
        raise errors.InputError("rtol", f"at least {LEAST_RTOL:g}, a hundred roundoffs", f"{rtol:g}")
    atol = None if atol is None else errors.number("atol", atol, above=0)
    errors.one_of("engine", engine, ("kernel", "scipy"))
    wanted = _sample_times(duration, times)
    if plant == "ideal":
        if isinstance(bound, BoundLaw):
            return _ideal(vehicle, bound, start, duration, rtol, rtol if atol is None else atol, wanted, engine)
        plant = Plant(limits=False, lag=0.0, rate=bound.rate)
    return _sampled(vehicle, bound, start, duration, plants.plant(plant), wanted, engine)


def _ideal(
    vehicle: Vehicle, law: BoundLaw, start: State, duration: float, rtol: float, atol: float, wanted: Any, engine: str
) -> Trajectory:
    """The closed loop in continuous time, the wrench acting as commanded."""
    loop = close_loop(vehicle, law)
    outputs = as_numpy(loop.outputs)
    solve = _by_kernel if engine == "kernel" else _by_scipy
    solution, drift = solve(loop, start.packed(), duration, rtol, atol, outputs)
    end = solution.outcome.time
    t = wanted if solution.outcome.status == "completed" else np.append(wanted[wanted < end], end)
    packed = solution(t)
    values = np.stack([outputs(time, s) for time, s in zip(t, packed, strict=True)])
    return Trajectory(
        t=t,
        **split(packed),
        thrust=values[:, 0],
        moment=values[:, 1:4],
        rotor_forces=values[:, :4] @ vehicle.unmixing(law.e3).T,
        signals=dict(zip(loop.signal_names, values[:, 4:].T, strict=True)),
        drift=drift,
        outcome=solution.outcome,
        e3=law.e3,
        vehicle=vehicle,
        law=law.name,
        gains=dict(law.gains),
        x_ref=_reference(law, t),
        interpolant=solution,
    )


def _by_kernel(loop: ClosedLoop, start: Any, duration: float, rtol: float, atol: float, _: Any) -> tuple[Solution, Any]:
    solution = Solution(
        ideal_kernel(loop.vehicle, loop.law, method=method_for(rtol, loop.law)), start, duration, rtol, atol
    )
    return solution, solution.drift


def _by_scipy(
    loop: ClosedLoop, start: Any, duration: float, rtol: float, atol: float, outputs: Any
) -> tuple[Integration, Any]:
    errors.require("scipy", extra="studies", for_="engine")
    from flypend.flight.integrate import integrate  # brings SciPy's integrators, which a kernel does not wait for

    guard, margin, reason = loop.law.guard, None, ""
    if guard is not None:
        errors.one_of("law.guard", guard.signal, loop.signal_names)
        row, threshold, reason = 4 + loop.signal_names.index(guard.signal), guard.threshold, guard.reason

        def margin(t: float, s: Any) -> float:
            return float(outputs(t, s)[row]) - threshold

    rates = as_numpy(loop.rates)
    solution = integrate(rates, start, duration, rtol=rtol, atol=atol, margin=margin, margin_reason=reason)
    return solution, solution.drift


def _sampled(
    vehicle: Vehicle,
    law: BoundLaw | Controller,
    start: State,
    duration: float,
    plant: Plant,
    wanted: Any,
    engine: str,
) -> Trajectory:
    """A sampled flight; it is recorded at control ticks, of which those nearest to `wanted` are kept."""
    if engine == "kernel" and isinstance(law, BoundLaw) and plant.engine == "equations":
        samples = flown_by_kernel(vehicle, law, start, duration, plant, nearest_ticks(wanted, plant, duration))
    else:
        samples = fly(vehicle, law, start, duration, plant).at(wanted * plant.rate)
    wrench = samples.rotors @ plant.true_vehicle(vehicle).mixing(law.e3).T
    return Trajectory(
        t=samples.t,
        **split(samples.packed * (1.0 if law.e3 == "up" else FLIP_PACKED)),
        thrust=wrench[:, 0],
        moment=wrench[:, 1:],
        rotor_forces=samples.rotors,
        drift=np.zeros((0, 3)),
        outcome=samples.outcome,
        e3=law.e3,
        vehicle=vehicle,
        law=law.name,
        gains=dict(law.gains),
        x_ref=_reference(law, samples.t),
    )


def _reference(law: BoundLaw | Controller, times: Any) -> Any:
    return None if law.reference is None else sampled(law.reference, times)


def _check(vehicle: Vehicle, law: AnyLaw, start: State) -> None:
    kinds = (("vehicle", vehicle, Vehicle), ("law", law, Law | BoundLaw | Controller), ("start", start, State))
    for name, value, kind in kinds:
        if not isinstance(value, kind):
            raise errors.InputError(name, f"a {getattr(kind, '__name__', 'Law or Controller')}", repr(value))
    if start.batch_shape:
        raise errors.InputError("start", "a single state", f"a batch of shape {start.batch_shape}")


def _sample_times(duration: float, times: Any) -> Any:
    if times is None:
        return np.linspace(0.0, duration, max(2, round(duration / SAMPLE_PERIOD) + 1))
    wanted = errors.array("times", times, (None,))
    if not len(wanted) or np.any(np.diff(wanted) <= 0):
        raise errors.InputError("times", "increasing times of shape (n,)", f"shape {wanted.shape}, or not increasing")
    if wanted[0] < 0 or wanted[-1] > duration:
        raise errors.InputError("times", f"times inside 0 .. {duration:g} s", f"{wanted[0]:g} .. {wanted[-1]:g} s")
    return wanted
