"""A run: times, states, wrench, signals, vehicle, law and outcome; conversion to xarray, and saving and loading."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flypend import errors
from flypend.files.netcdf import Variable
from flypend.files.whole import whole_file
from flypend.flight import files
from flypend.flight.labels import dataframe, dataset, describe, variable
from flypend.flight.outcome import Outcome
from flypend.geometry import Matrix, Numbers, Vector, cross, dot, norm
from flypend.model import State, Vehicle, Wrench, rod_tension
from flypend.model.mount import margins
from flypend.model.state import FLIP, SHAPES, E3Direction

if TYPE_CHECKING:
    import pandas
    import xarray

    from flypend.flight.request import Flight


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Trajectory:
    """One run, sampled at `t`; SI units, world frame with third axis `e3`, omega and moment in the body frame.

    Parameters
    ----------
    t : (n,)
        Times, s.
    x, x_dot, omega, y, y_dot : (n, 3)
        Pivot position and velocity, angular velocity, rod direction and its rate.
    R : (n, 3, 3)
        Rotation from body to world.
    thrust, moment : (n,), (n, 3)
        Applied wrench; thrust acts along z = R e₃, so it is negative if e₃ points down.
    rotor_forces : (n, k)
        Forces of the k rotors, N. In the ideal plant, those that the wrench would require; they may exceed the limits.
    signals : dict of (n,)
        Signals of the law: Lyapunov functions, their rates along the ideal closed loop, errors.
    drift : (k, 3)
        Drift before projection in each of k accepted steps: | |y| − 1 |, |y · y_dot| and ‖RᵀR − 1‖.
    outcome : Outcome
        Completed, diverged, singular or collided, with time and reason.
    e3 : "up" or "down"
        Direction of the frame's third axis.
    vehicle : Vehicle
        Vehicle parameters.
    law, gains : str, dict
        Name and gains of the law.
    x_ref : (n, 3), optional
        Reference position, m; default the origin.
    interpolant : callable, optional
        Dense output, from times to packed states; not saved to files.
    flight : Flight, optional
        What was flown, for pages that fly on; not saved to files.
    planned : (str, bool), optional
        What a plan says of itself, and whether it can be flown; not saved to files.
    """

    t: Numbers
    x: Vector
    x_dot: Vector
    R: Matrix
    omega: Vector
    y: Vector
    y_dot: Vector
    thrust: Numbers
    moment: Vector
    rotor_forces: Numbers
    signals: Mapping[str, Numbers] = field(default_factory=dict)
    drift: Numbers
    outcome: Outcome
    e3: E3Direction
    vehicle: Vehicle
    law: str
    gains: Mapping[str, Any]
    x_ref: Numbers = None
    interpolant: Callable[[Any], Any] | None = None
    flight: Flight | None = None
    planned: tuple[str, bool] | None = None

    def __post_init__(self) -> None:
        if self.x_ref is None:
            object.__setattr__(self, "x_ref", np.zeros((len(self.t), 3)))

    def __getstate__(self) -> dict[str, Any]:
        """Leave the flight behind in copies for other processes: it holds programs, which stay in this one."""
        return {**self.__dict__, "flight": None}

    def __repr__(self) -> str:
        """Return law, vehicle and how the run ended, in one line."""
        return f"<Trajectory of {self.law} on {self.vehicle.name}: {len(self.t)} samples, {self.outcome}>"

    @property
    def z(self) -> Vector:
        """Thrust axis z = R e₃, (n, 3)."""
        return self.R[..., :, 2]

    @property
    def packed(self) -> Numbers:
        """The sampled states (n, 24) in the order of `State.packed`, exactly as integrated."""
        rows = [getattr(self, name).reshape(len(self.t), -1) for name in SHAPES]
        return np.concatenate(rows, axis=1)

    @property
    def states(self) -> State:
        """The sampled states as one batch."""
        return State(**{name: getattr(self, name) for name in SHAPES})

    @property
    def final(self) -> State:
        """The last state, exactly as integrated."""
        return State.trusted(self.packed[-1])

    @property
    def wrench(self) -> Wrench:
        """The sampled wrenches as one batch."""
        return Wrench(self.thrust, self.moment)

    @property
    def cone(self) -> Numbers:
        """Angle (n,) between the rod and the upward thrust axis, rad: 0 with the rod straight above the vehicle."""
        up = 1.0 if self.e3 == "up" else -1.0
        return np.arctan2(norm(cross(self.y, self.z)), up * dot(self.y, self.z))

    @property
    def tension(self) -> Numbers:
        """Rod tension (n,), N, of the nominal model: negative where the vehicle pushes the rod."""
        return rod_tension(self.states, self.wrench, self.vehicle)

    @property
    def clearance(self) -> Numbers:
        """Signed distance (n,) of the rod to what its mount lets it touch, m; infinite on a gimbal.

        On a hub, from the rod's surface to the nearest rotor disc or arm; in a cup, from the bob to the cup's cone.
        """
        found = margins(self.states, self.wrench, self.vehicle, self.e3)
        if self.vehicle.mount == "cup":
            found = found[:, :1]  # a force is no distance
        return np.min(found, axis=-1, initial=np.inf)

    def at(self, t: Numbers) -> State:
        """Return the state(s) at any time(s) `t` within the run, from the integrator's dense output.

        Raises InputError if a time is outside the run, or the run holds samples only: a sampled flight, or one loaded
        from a file.
        """
        if self.interpolant is None:
            raise errors.InputError("run.at", "a run of the ideal plant, not read from a file", "samples only")
        times = errors.array("t", t, (), batch=True)
        if np.any(times < 0) or np.any(times > self.outcome.time):
            raise errors.InputError("t", f"times inside 0 .. {self.outcome.time:g} s", np.asarray(t).tolist())
        states = State.from_packed(self.interpolant(np.ravel(times)))
        return states[0] if times.ndim == 0 else states

    def flipped(self) -> Trajectory:
        """Return the run in the frame rotated by π about e₁ (e₃ up to e₃ down, and back)."""
        states, wrench = self.states.flipped(), self.wrench.flipped()
        return replace(
            self,
            **{name: getattr(states, name) for name in SHAPES},
            thrust=wrench.thrust,
            moment=wrench.moment,
            x_ref=self.x_ref @ FLIP,
            e3="down" if self.e3 == "up" else "up",
            interpolant=None,
            flight=None,
        )

    def to_xarray(self) -> xarray.Dataset:
        """Return an `xarray.Dataset` on the dimension `t`, with units, and vehicle, law and outcome as attributes.

        The drift is left out: it is recorded per step, not per sample.
        """
        return dataset(self._variables(), self._attributes())

    def to_dataframe(self, *, units: bool = False) -> pandas.DataFrame:
        """Return a `pandas.DataFrame` with one row per sample, indexed by `t`, and one column per component.

        Columns are x_1, x_2, x_3, x_dot_1, …, R_11, R_12, …, R_33 by rows, omega_1, …, y_1, …, y_dot_1, …, thrust,
        moment_1, …, rotor_force_1, …, x_ref_1, …, and the signals of the law by their names. `attrs["units"]` maps a
        column to its unit: "1" if it has none, "" for a signal of which none is known. The other `attrs` are vehicle,
        law and outcome.

        Parameters
        ----------
        units : bool
            Whether the names carry the unit, as in `x_1 [m]`, for a table to be saved.

        Raises
        ------
        InputError
            If pandas is not installed; the extra studies brings it.
        """
        return dataframe(self._variables(), self._attributes(), "t", units=units)

    def save(self, path: str | Path) -> None:
        """Save the run to the NetCDF file `path` (.nc), for xarray, MATLAB (ncread) and, through xarray, pandas.

        `fp.load` reads it. The file is written atomically. Raises InputError if it is not writable, or if the run could
        not be loaded again, because its arrays differ in length or its states are invalid.
        """
        files.write(path, *files.content(self._variables(), self._attributes(), self.drift))

    def to_mcap(self, path: str | Path) -> None:
        """Write the run to an MCAP file (.mcap), atomically, for Foxglove, PlotJuggler and ROS 2's tools; e₃ is up.

        Messages are JSON, one per sample at its time: on "/tf" the frames "vehicle" and "rod" in "world"
        (foxglove.FrameTransform; z of the rod's frame is along the rod), on "/run" the arrays of `to_xarray` (undefined
        numbers are null, R is a list of 9, row by row). "/machine" draws rotors, rod and bob once
        (foxglove.SceneUpdate). The metadata "run" holds vehicle, law and outcome.

        Parameters
        ----------
        path : str or Path
            The file, which ends in .mcap.

        Raises
        ------
        InputError
            If the file is not writable, or mcap is not installed; the extra logs brings it.
        """
        from flypend.flight.mcap_file import write_mcap  # imported here: most runs are never written so

        run = self if self.e3 == "up" else self.flipped()
        write_mcap(path, run, run._variables(), run._attributes())

    def _variables(self) -> dict[str, Variable]:
        """Return the sampled arrays with their dimensions and units."""
        over = ("t",)
        arrays = {name: getattr(self, name) for name in files.ARRAYS} | dict(self.signals)
        return {name: variable(name, over, value) for name, value in arrays.items()}

    def _attributes(self) -> dict[str, Any]:
        """Return attributes that specify what was flown and how it ended."""
        return {
            **describe(self.vehicle, self.law, self.gains, self.e3),
            "outcome": self.outcome.status,
            "outcome_time": self.outcome.time,
            "outcome_reason": self.outcome.reason,
            "signals": json.dumps(list(self.signals)),
        }

    def to_html(
        self,
        path: str | Path | None = None,
        *,
        ghost: Trajectory | Sequence[Trajectory] = (),
        title: str | None = None,
        layout: str = "overlay",
        speed: float = 1.0,
        live: bool = False,
        windows: Sequence[Any] = (),
    ) -> str:
        """Render a replay of this run: one HTML page that opens from disk, offline, in any browser.

        Parameters
        ----------
        path : str or Path, optional
            An .html file to write the page to, atomically.
        ghost : Trajectory, or up to three of them
            Runs to compare with this one.
        title : str, optional
            Title; default the laws and vehicles.
        layout : "overlay" or "beside"
            The other runs as ghosts in the same view, or each in its own view. A button on the page switches.
        speed : float
            Initial flight time over playback time, > 0. A menu on the page changes it.
        live : bool
            Whether the page computes flights itself, as WebAssembly: it responds to pokes, new starts, gains and a hand
            on the rod. Needs a compiled law, a plant of the built-in equations, and a run flown in this session. The
            other runs stay as they were.
        windows : sequence of Window
            Openings in walls that are drawn, e₃ up; `Plan.windows` are those that a plan flies through.

        Returns
        -------
        str
            The page.

        Raises
        ------
        InputError
            If there are more than four runs, the layout is unknown, the speed is not positive, the file is not
            writable, the run cannot be `live`, or a window is not a `Window`.
        """
        from flypend.flight.verdict import verdict  # imported here: most runs are never shown
        from flypend.pages import replay

        others = [ghost] if isinstance(ghost, Trajectory) else ghost
        if not (isinstance(others, Sequence) and all(isinstance(other, Trajectory) for other in others)):
            raise errors.InputError("ghost", "a Trajectory, or a sequence of them", repr(ghost))
        runs = [self, *others]
        verdicts = [verdict(run) for run in runs]
        flies = None
        if live:
            from flypend.flight.live import live_data

            flies = live_data(self.flight)
        text = replay.page(runs, verdicts, title=title, layout=layout, speed=speed, live=flies, windows=windows)
        if path is not None:
            with whole_file(path, (".html",)) as partial:
                partial.write_text(text, encoding="utf-8")
        return text

    def _repr_html_(self) -> str:
        """Return the replay in an iframe, for notebooks."""
        from flypend.pages import replay

        return replay.frame(self.to_html())


@errors.named_arguments
def load(path: str | Path) -> Trajectory:
    """Load the run that `Trajectory.save` wrote to `path`, or the flight of a plan that `Plan.save` wrote.

    Raises InputError if the file holds no valid run: every number and name is checked, with or without a digest.
    """
    return Trajectory(**files.run_from(*files.read(path, files.KIND), str(path))[0])
