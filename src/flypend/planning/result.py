"""A plan: states, rotor forces and commands over time, how good it is, and how it was found."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.building import built
from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.files.whole import whole_file
from flypend.flight.files import write
from flypend.flight.labels import UNITS, column_names
from flypend.flight.metrics import wilson
from flypend.flight.outcome import Outcome
from flypend.flight.trajectory import Trajectory
from flypend.geometry import norm
from flypend.laws.references import Reference, hover, sample
from flypend.model import State, Vehicle
from flypend.model.state import SHAPES, SIZE, split
from flypend.planning import files
from flypend.planning.dynamics import Array, Units
from flypend.planning.files import Status
from flypend.planning.inequalities import YAW, end_errors
from flypend.planning.problem import spin_tolerance
from flypend.planning.window import Window
from flypend.plants.equations import runge_kutta_step
from flypend.plants.lag import TIMING_SIZE, hold, step_timing

INDEPENDENT_STEP = 1e-3  # s
ROUNDING = 1e-6  # of a tolerance at the end


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Plan:
    """A planned flight to inverted hover; SI units, world frame with e₃ up.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle parameters.
    objective : dict
        Weights of what was minimised, by name.
    target : (3,)
        Where the pivot should hover, m.
    path : callable, optional
        Where the pivot should be until then, m, as a function of time; default the target.
    windows : tuple of Window
        What it flies through.
    t : (n,)
        Times, s: as many in each stage, at equal distances.
    packed : (n, 24)
        States at these times, in the order of `State.packed`.
    rotor_forces : (n, k)
        Forces of the k rotors at these times, N.
    commands : (stages, k)
        Rotor forces commanded, N, each held for `stage` seconds.
    stage : float
        Duration of a stage, s.
    status : "converged", "feasible" or "failed"
        "failed" unless the plan ends in hover and keeps all limits; "converged" if also `stationarity` is at most 1e-4
        and it keeps its clearance. A converged plan is a local optimum, the best of those that the guesses led to.
    reason : str
        Why it failed, or has not converged; else empty.
    solve_time : float
        Processor time that the solver took, s.
    iterations : int
        Iterations of the solver.
    stationarity : float
        Relative change of the cost, barrier included, that the last Newton step predicted: how far the plan is from the
        first-order conditions. 0 at a local optimum.
    guess : int
        The style of the guess that led here.
    guesses, agreeing : int
        Number of guesses of which this plan is the best, and how many of them, itself included, came within 1 % of its
        cost before it alone was solved to the end. The fewer agree, the more likely another guess leads to a better
        plan.
    """

    vehicle: Vehicle
    objective: dict[str, float]
    target: Array
    t: Array
    packed: Array
    rotor_forces: Array
    commands: Array
    stage: float
    status: Status
    reason: str
    solve_time: float
    iterations: int
    stationarity: float
    guess: int
    guesses: int
    agreeing: int
    path: Reference | None = None
    windows: tuple[Window, ...] = ()

    def __repr__(self) -> str:
        """Return the vehicle and the `summary`."""
        return f"<Plan for {self.vehicle.name}: {self.summary}>"

    @property
    def summary(self) -> str:
        """Duration, excursion, status and what it took, in one line."""
        why = f" ({self.reason})" if self.reason else ""
        reached = f"{self.duration:.2f} s, excursion {self.excursion:.3f} m"
        among = f", best of {self.guesses} guesses ({self.agreeing} within 1 %)" if self else ""
        return f"{self.status}{why}: {reached}{among}, solved in {1e3 * self.solve_time:.0f} ms"

    def __bool__(self) -> bool:
        """Whether the plan can be flown: False if it failed."""
        return self.status != "failed"

    @property
    def duration(self) -> float:
        """Duration, s."""
        return float(self.t[-1])

    @property
    def excursion(self) -> float:
        """Largest distance of the pivot from the target, or from where the path has it, m."""
        return float(np.max(norm(self.x - self.x_ref)))

    @property
    def reference(self) -> Reference:
        """Where the pivot is to be, as a function of time: the path, then the target.

        Raises InputError if the plan ends otherwise than in inverted hover, after which there is nothing to follow.
        """
        self.check_end()
        path = self.path
        return hover(self.target) if path is None else lambda t: path(ca.fmin(t, self.duration))

    def check_end(self) -> None:
        """Raise InputError unless the plan ends in inverted hover, within the tolerances of plans."""
        n, units = len(self.vehicle.rotor_spins), Units.of(self.vehicle)
        end = np.append(self.packed[-1], self.rotor_forces[-1])
        end[:3] -= self.target
        errors_of = _hover_errors(n)(end / units.states(n), spin_tolerance(self.vehicle, units))
        if not np.max(np.abs(errors_of)) <= 1 + ROUNDING:
            raise InputError("plan", "one that ends in inverted hover", "another end, which is not tracked")

    @property
    def x_ref(self) -> Array:
        """Where the pivot is to be (n, 3), m."""
        places: Array = np.tile(self.target, (len(self.t), 1)) if self.path is None else sample(self.path, self.t)
        return places

    @property
    def effort(self) -> float:
        """Root mean square of the rotor forces, relative to each rotor's share of the weight."""
        share = self.vehicle.weight / len(self.vehicle.rotor_spins)
        return float(np.sqrt(np.mean(self.rotor_forces**2)) / share)

    @property
    def states(self) -> State:
        """The states as one batch."""
        return State.trusted(self.packed)

    x = property(lambda self: self.packed[:, 0:3], doc="Pivot position (n, 3), m.")
    x_dot = property(lambda self: self.packed[:, 3:6], doc="Pivot velocity (n, 3), m/s.")
    R = property(lambda self: self.packed[:, 6:15].reshape(-1, 3, 3), doc="Rotation from body to world (n, 3, 3).")
    omega = property(lambda self: self.packed[:, 15:18], doc="Angular velocity (n, 3), body frame, rad/s.")
    y = property(lambda self: self.packed[:, 18:21], doc="Rod direction (n, 3).")
    y_dot = property(lambda self: self.packed[:, 21:24], doc="Rate of the rod direction (n, 3), 1/s.")

    @cached_property
    def trajectory(self) -> Trajectory:
        """The plan as a run, for replays (also as a ghost) and metrics."""
        wrench = self.rotor_forces @ self.vehicle.mixing().T
        return Trajectory(
            t=self.t, **split(self.packed), thrust=wrench[:, 0], moment=wrench[:, 1:], rotor_forces=self.rotor_forces,
            drift=np.zeros((0, 3)), outcome=Outcome("completed", self.duration), e3="up", vehicle=self.vehicle,
            law="plan", gains={}, x_ref=self.x_ref, planned=(self.summary, bool(self)),
        )  # fmt: skip

    def to_html(self, path: str | Path | None = None) -> str:
        """Render a replay of the plan, as `Trajectory.to_html` does, and write it to `path` if given."""
        return self.trajectory.to_html(path, windows=self.windows)

    def save(self, path: str | Path) -> None:
        """Save the plan to the NetCDF file `path` (.nc), which `fp.load_plan` reads; `fp.load` reads its flight.

        The file is written atomically. Raises InputError if it is not writable, or if the plan could not be loaded
        again, because its arrays differ in length or its numbers are not finite.
        """
        write(path, *files.content(self))

    def to_csv(self, path: str | Path) -> None:
        """Write the plan to the file `path` (.csv), a row per sample.

        Columns are named and have units as in `Trajectory.to_dataframe`; command_1, … are the commands held from then
        on. The file is written atomically. Raises InputError if it is not writable.
        """
        per_stage = (len(self.t) - 1) // len(self.commands)
        commands = self.commands[np.minimum(np.arange(len(self.t)) // per_stage, len(self.commands) - 1)]
        parts = np.column_stack([self.t, self.packed, self.rotor_forces, commands])
        shapes = {"t": (), **SHAPES, "rotor_forces": self.commands.shape[1:], "command": self.commands.shape[1:]}
        units = UNITS | {"command": "N"}
        names = [f"{column} [{units[name]}]" for name in shapes for column in column_names(name, shapes[name])]
        with whole_file(path, (".csv",)) as target:
            np.savetxt(target, parts, fmt="%.9g", delimiter=",", header=",".join(names), comments="")

    @cached_property
    def end_error(self) -> float:
        """Distance between the ends of the plan and of an independent integration of its commands.

        The larger of the distance of the pivots, m, and that of the rods, both as they are: a flight without feedback
        amplifies whatever two integrators do differently. The equations are those of `model.motion`, by the classical
        Runge-Kutta method and projection, in steps of 1 ms at most.
        """
        step, lag = _independent_step(self.vehicle), self.vehicle.rotor_lag
        count = max(1, int(np.ceil(self.stage / INDEPENDENT_STEP - 1e-9)))
        timing = step_timing(lag, self.stage / count)
        state, rotors = self.packed[0], self.rotor_forces[0]
        for command in self.commands:
            for _ in range(count):
                state, rotors = step(state, rotors, command, timing)
        off = state - self.packed[-1]
        return float(max(norm(off[0:3]), norm(off[18:21])))


@errors.named_arguments
@dataclass(frozen=True, eq=False)
class PlanEnsemble:
    """Plans of one vehicle from n starts.

    Parameters
    ----------
    plans : tuple of Plan
        A plan for each start, in order.
    """

    plans: tuple[Plan, ...]

    def __len__(self) -> int:
        """Number of plans."""
        return len(self.plans)

    def __iter__(self) -> Iterator[Plan]:
        """Iterate over the plans."""
        return iter(self.plans)

    def __getitem__(self, i: int) -> Plan:
        """Return the plan from start i."""
        return self.plans[i]

    def __repr__(self) -> str:
        """Return vehicle, share of plans that can be flown, and excursion in one line."""
        low, high = self.interval
        found = f"{int(np.sum(self.success))} of {len(self)} planned (95 %: {100 * low:.1f} to {100 * high:.1f} %)"
        middle, most = (self.percentile("excursion", q) for q in (50, 95))
        return f"<Plans for {self.plans[0].vehicle.name}: {found}, excursion {middle:.3f} / {most:.3f} m>"

    @property
    def success(self) -> NDArray[np.bool_]:
        """Which plans can be flown, (n,)."""
        return np.array([bool(plan) for plan in self.plans])

    @property
    def excursion(self) -> NDArray[np.float64]:
        """Excursions (n,), m; NaN where there is no plan."""
        return np.array([plan.excursion if plan else np.nan for plan in self.plans])

    @property
    def duration(self) -> NDArray[np.float64]:
        """Durations (n,), s; NaN where there is no plan."""
        return np.array([plan.duration if plan else np.nan for plan in self.plans])

    @property
    def solve_time(self) -> NDArray[np.float64]:
        """Processor time of each plan (n,), s, all its guesses included."""
        return np.array([plan.solve_time for plan in self.plans])

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson interval of the share of plans that can be flown, 95 %."""
        return wilson(int(np.sum(self.success)), len(self))

    def percentile(self, name: str, q: float) -> float:
        """Return percentile `q` of the property `name` where it is finite; NaN if there are none.

        It is "excursion", "duration" or "solve_time".
        """
        values = getattr(self, errors.one_of("name", name, ("excursion", "duration", "solve_time")))
        values = values[np.isfinite(values)]
        return float(np.percentile(values, q)) if len(values) else float("nan")


@built(maxsize=4)
def _hover_errors(rotors: int) -> Any:
    """Return (state (24 + n,), tolerance of the spin), own units → `end_errors` about inverted hover."""
    state, spin = ca.SX.sym("state", SIZE + rotors), ca.SX.sym("spin")
    errors_of = end_errors(state, ca.vertcat(ca.SX(YAW, 1), spin))
    return as_numpy(ca.Function("hover_errors", [state, spin], [ca.densify(errors_of)]))


def _independent_step(vehicle: Vehicle) -> Any:
    """Return (state, rotors, command, timing) → (state, rotors) after a Runge-Kutta step of the whole state."""
    n = len(vehicle.rotor_spins)
    packed, rotors, command = ca.SX.sym("s", SIZE), ca.SX.sym("r", n), ca.SX.sym("u", n)
    timing = ca.SX.sym("h", TIMING_SIZE)
    forces, after = hold(rotors, command, timing)
    moved = runge_kutta_step(packed, forces, None, timing[0], vehicle)
    outputs = [ca.densify(moved), ca.densify(after)]
    return as_numpy(ca.Function("independent", [packed, rotors, command, timing], outputs))


@errors.named_arguments
def load_plan(path: str | Path) -> Plan:
    """Load the plan that `Plan.save` wrote to `path`, with exactly the same numbers.

    A path that it follows is made of straight lines between its samples.

    Raises InputError if the file holds no valid plan: every number and name is checked, with or without a digest.
    """
    return Plan(**files.fields_of(path))
