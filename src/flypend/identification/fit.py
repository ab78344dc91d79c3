"""Maximum likelihood by scoring: what is searched, and passes of the filter, each followed by a step.

Every number has a guess, how far off that may be, and a form in which it is searched. A step moves numbers and noises.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from threadpoolctl import threadpool_limits

from flypend.errors import InputError
from flypend.geometry import Numbers, Vector, vee
from flypend.identification.filtering import GUST_TIME, Noises, Pass, Programs, run_filter
from flypend.identification.log import GYRO, Log, instants, to_grid
from flypend.identification.model import CHANNELS, MOVING, READING, ROTOR_AIR, moves, places, reads, sizes, split
from flypend.identification.rotors import Forces, patterns, rotor_forces, rotor_slopes, rotor_table
from flypend.model import Vehicle
from flypend.model.air import Air

Progress = Callable[[str, int, int], None] | None

PASSES = 12
ROUGH = 2  # passes before noises are estimated, of errors that until then are the guess's
UNGATED = 4  # passes before readings far off are refused: until then the model may be what is wrong
DONE = 0.1  # of a standard error
# Standard deviations of readings where the log has too few to tell, m, rad, rad/s, m/s², rad.
READ = {"position": 2e-3, "attitude": 5e-3, "gyro": 2e-2, "force": 0.3, "rod": 5e-3}
# ... and of what drives, in 1 s, with which the search begins: m/s, rad/s (tilt and yaw), 1/s, and gusts over weight.
DRIVE = (5e-3, 0.3, 0.1, 0.01)
GUST = 0.02
ON_BOB = 4.0  # gusts on the bob over those of its share in the mass, where the search begins
WILD = 100  # of those of readings, beyond which one among others is left out; a fifth of that of what 5 % exceed
LOST = 1e3  # standard deviations of a prediction error that only something else than the flight explains
AT_REST = 0.1  # m, within which a position stays for half a second; in a fall with half the thrust it moves by 0.6 m
SWAY_TIME = 0.5  # s, over which noise of a position, even of 0.5 m, accelerates it by less than g
# s over which attitude and gyro are compared, longer than poses are late, and their correlation that tells units.
TURN, ALIKE = 0.2, 0.7
QUIETEST = 1e-4  # of a variance, over that with which the search begins
# Standard deviation of a guess: of its logarithm, for what is positive and of unknown size ...
RATIOS = {
    "rod_length": 0.15, "bob_mass": 0.1, "inertia": 0.4, "drag_ratio": 0.4, "lag": 0.7, "spin_up": 0.3,
}  # fmt: skip
# ... or of the number itself: m; logarithms of forces; share of voltage; s; rad/s; m/s²; rad. Props of one kind differ
# by some per cent, batteries lose up to a tenth, radios take some 10 ms, hobby IMUs are off by so much.
PLAIN = {
    "pivot_offset": 5e-3, "scale": 0.15, "shares": 0.05, "sag": 0.05, "delay": 0.02, "latency": 0.01, "gyro_bias": 0.05,
    "force_bias": 0.3, "misalignment": 0.02, "curve": 0.3,
}  # fmt: skip
FIELDS = {"scale": "thrust_scale", "lag": "rotor_lag", "shares": "strength"}  # of a vehicle's bands, by name here
NORMAL_975 = 1.96  # standard deviations from the middle of a band of 95 % to its end
NO_LAG = 1e-3  # of a band's upper end, in place of a lower one of 0, which a lag may have
LAG, DELAY, SAG, PWM_CURVE = 0.04, 0.01, 0.03, 0.7  # where a search begins if the guess says nothing
LEAST, MOST = {"delay": 0.0, "sag": 0.0, "curve": 0.0}, {"delay": 0.2, "sag": 0.25, "curve": 1.0}
# s in which drag stops a machine, and inflow a climb: RotorPy's take 0.5 to 5; steady wind over weight.
DRAG_TIME, INFLOW_TIME, WIND = 5.0, 1.0, 0.03


@dataclass(frozen=True, eq=False)
class Search:
    """What points θ (p,) of a search stand for."""

    vehicle: Vehicle  # the guess
    table: dict[str, int]  # names and lengths of what is searched: what moves, the rotors, what is read
    guess: Numbers  # (p,): where the search begins
    spread: Numbers  # (p,): standard deviation of the guess; 0 for what is not searched
    logarithmic: Numbers  # (p,) of bool: what is searched as the logarithm of its ratio to the guess

    def values(self, theta: Numbers) -> dict[str, Any]:
        """Return the numbers at θ (p,) by name."""
        return split(self.table, self.plain(theta))

    def plain(self, theta: Numbers) -> Any:
        """Return the numbers at θ (p,) in one array."""
        return np.where(self.logarithmic, self.guess * np.exp(np.where(self.logarithmic, theta, 0)), self.guess + theta)

    def slope(self, theta: Numbers) -> Any:
        """Return d(number)/dθ, (p,)."""
        return np.where(self.logarithmic, self.plain(theta), 1.0)

    def clip(self, theta: Numbers) -> Any:
        """Return θ (p,) with what has limits clipped to them."""
        low, high = np.full(len(theta), -np.inf), np.full(len(theta), np.inf)
        for name, place in places(self.table).items():
            low[place] = LEAST.get(name, -np.inf) - self.guess[place]
            high[place] = MOST.get(name, np.inf) - self.guess[place]
        held = np.clip(theta, low, high)
        return np.where(self.logarithmic, np.clip(theta, -1.5, 1.5), held)  # a factor of 4.5 either way


def search_from(vehicle: Vehicle, pwm: bool, accelerometer: bool) -> Search:
    """Return the search that begins at `vehicle`; with `pwm` the thrust curve is searched too.

    Bands of the vehicle are what is known before; numbers without one have the usual spreads.
    """
    n = len(vehicle.rotor_spins)
    hover = vehicle.weight / n
    slowed = vehicle.weight / vehicle.gravity / n / np.sqrt(hover)  # N^½ s/m, in 1 s
    air = vehicle.air or Air()
    given: dict[str, Any] = {
        "rod_length": vehicle.rod_length, "bob_mass": vehicle.bob_mass, "inertia": np.diag(vehicle.inertia),
        "drag_ratio": vehicle.drag_ratio, "pivot_offset": vehicle.pivot_offset,
        **{name: getattr(air, name) for name in ROTOR_AIR},
        "lag": vehicle.rotor_lag or LAG, "spin_up": 1.0, "sag": SAG, "delay": DELAY,
        "curve": PWM_CURVE if pwm else 0.0, "scale": np.log(vehicle.thrust_scale),
    }  # fmt: skip
    spreads: dict[str, Any] = {
        **RATIOS, **PLAIN, "rotor_drag": slowed / DRAG_TIME, "inflow": slowed / INFLOW_TIME,
        "wind": WIND * vehicle.weight,
    }  # fmt: skip
    for name in spreads:
        if (field := FIELDS.get(name, name)) in (vehicle.bands or {}):
            low, high = (np.array(end) for end in vehicle.bands[field])
            logarithmic = name in RATIOS or name in ("scale", "shares")
            least = np.maximum(low, NO_LAG * high)
            spreads[name] = (np.log(high / least) if logarithmic else high - low) / (2 * NORMAL_975)
            if name in ("spin_up", "sag", "delay", "latency"):  # no fields of a vehicle: the band's middle
                given[name] = (low + high) / 2
            if name == "shares":
                given[name], spreads[name] = patterns(n).T @ np.log(low * high) / 2, spreads[name].mean()
    if not pwm:
        spreads["curve"] = 0.0
    if not accelerometer:
        spreads["force_bias"] = 0.0
    table = {**MOVING, **rotor_table(n), **READING}
    parts = [
        [np.broadcast_to(number, size) for number in (given.get(name, 0.0), spreads[name], name in RATIOS)]
        for name, size in table.items()
    ]
    return Search(vehicle, table, *map(np.concatenate, zip(*parts, strict=True)))


@dataclass(frozen=True)
class Fit:
    """Where the search ended."""

    search: Search
    theta: Numbers  # (p,): its end
    covariance: Numbers  # (p, p): of θ, by the scores of segments
    last: Pass  # of the filter
    noises: Noises  # with which that weighed
    passes: int
    converged: bool  # whether the last step was below `DONE` standard errors


def fit(log: Log, vehicle: Vehicle, marker: Vector, pwm: bool, progress: Progress = None) -> Fit:
    """Search the numbers of `vehicle`, the guess, that make `log` likeliest.

    `marker` is the tracked point from the pivot, body frame, m; `pwm` says that commands are fractions; `progress` is
    called with ("pass", done, total).
    """
    check_in_air(log, vehicle, pwm)
    log = drop_wild(log)
    check_hangs(log, vehicle)
    check_moves(log, vehicle)
    check_turns(log)
    search = search_from(vehicle, pwm, bool(np.isfinite(log.force).any()))
    programs = Programs(moves(vehicle), reads(vehicle, marker))
    first = noises = first_noises(vehicle, log)
    begun: Pass | None = None
    free, theta = search.spread > 0, np.zeros(len(search.guess))
    prior = np.where(free, search.spread, 1.0) ** -2
    for k in range(PASSES):
        with threadpool_limits(1), np.errstate(all="ignore"):  # matrices are small; what is no number is told below
            found = one_pass(log, search, theta, noises, programs, pwm, gated=k >= UNGATED)
        begun = begun or found
        if not np.isfinite(found.scores).all():
            raise _lost(begun, log)
        slope = search.slope(theta)
        information = (found.information * np.outer(slope, slope) + np.diag(prior))[np.ix_(free, free)]
        scores = (found.scores * slope)[:, free]
        bread = np.linalg.inv(information)
        step = np.zeros(len(theta))
        step[free] = bread @ (scores.sum(axis=0) - (prior * theta)[free])
        after = search.clip(theta + step)
        moved = float(np.max(np.abs(after - theta)[free] / np.sqrt(np.diag(bread))))
        if progress is not None:
            progress("pass", k + 1, PASSES)
        converged = moved < DONE and k > UNGATED
        if converged or k + 1 == PASSES:
            break
        theta = after
        if k >= ROUGH:
            driving = np.clip(found.noises.driving, QUIETEST * first.driving, 1e6 * first.driving)
            noises = replace(noises, driving=driving)
    sandwich = bread @ (scores.T @ scores + np.diag(prior[free])) @ bread
    covariance = np.zeros((len(theta),) * 2)
    # The larger standard deviations of both, correlated as by the scores.
    widen = np.sqrt(np.maximum(1.0, np.diag(bread) / np.maximum(np.diag(sandwich), 1e-300)))
    covariance[np.ix_(free, free)] = sandwich * np.outer(widen, widen)
    return Fit(search, theta, covariance, found, noises, k + 1, converged)


def one_pass(
    log: Log, search: Search, theta: Numbers, noises: Noises, programs: Programs, pwm: bool, gated: bool
) -> Pass:
    """Run the filter with the numbers at θ; its scores are by the numbers themselves."""
    names = rotor_table(log.command.shape[1])
    parts = {"moving": sizes(MOVING), "rotors": sizes(names), "reading": sizes(READING)}
    now, free = split(parts, search.plain(theta)), split(parts, search.spread > 0)
    grid = to_grid(log, float(split(READING, now["reading"])["latency"][0]))
    now["reading"][0] = 0.0  # poses of the grid are that much older

    def forces(values: Any) -> Forces:
        most = search.vehicle.rotor_limits[1]
        return rotor_forces(log.t, log.command, grid.t, split(names, values), most, pwm)

    middle = forces(now["rotors"])
    slopes = rotor_slopes(middle, forces, now["rotors"], names, free["rotors"])
    return run_filter(grid, middle, slopes, now["moving"], now["reading"], noises, programs, gated)


def check_in_air(log: Log, vehicle: Vehicle, pwm: bool) -> None:
    """Raise InputError if `log` begins on the ground: at rest, with commands far below the weight."""
    rows = log.t < log.t[0] + 0.5
    thrust = log.command[rows].sum(axis=1) * (vehicle.rotor_limits[1] if pwm else 1.0)
    at = log.position[rows][np.isfinite(log.position[rows]).all(axis=1)]
    if thrust.max() < vehicle.weight / 2 and len(at) and np.ptp(at, axis=0).max() < AT_REST:
        fractions = " (or command='pwm')" if not pwm and log.command.max() <= 1 else ""
        raise InputError(log.name, f"a flight from after take-off on{fractions}", "one that begins at rest")


def check_hangs(log: Log, vehicle: Vehicle) -> None:
    """Raise InputError if the rod of `log` stands, or if what its accelerometer felt is not about g."""
    up, felt = log.rod[:, 2], np.linalg.norm(log.force, axis=1)
    up, felt = up[np.isfinite(up)], felt[np.isfinite(felt)]
    if len(up) and np.median(up) > 0:
        raise InputError(f"{log.name}, column rz", "a hanging rod, from pivot to bob, with e₃ up", "one that stands")
    if len(felt) and not vehicle.gravity / 2 < (usual := float(np.median(felt))) < 2 * vehicle.gravity:
        wanted = f"about {vehicle.gravity:.3g} m/s² in hover (not g, and gravity not subtracted)"
        raise InputError(f"{log.name}, columns ax, ay, az", wanted, f"{usual:.3g}")


@np.errstate(over="ignore", invalid="ignore")  # of readings far too large, which `_lost` names
def check_moves(log: Log, vehicle: Vehicle) -> None:
    """Raise InputError if positions of `log` accelerate as only those in another unit do."""
    known = np.isfinite(log.position).all(axis=1)
    t, position = log.t[known], log.position[known]
    before, after = (np.column_stack([np.interp(t + s, t, one) for one in position.T]) for s in (-SWAY_TIME, SWAY_TIME))
    usual = float(np.median(np.linalg.norm(after - 2 * position + before, axis=1))) / SWAY_TIME**2
    if usual > vehicle.gravity:
        wanted = "positions in m (not mm), which accelerate by less than g"
        raise InputError(f"{log.name}, columns x, y, z", wanted, f"{usual:.3g} m/s²")


@np.errstate(over="ignore", invalid="ignore")
def check_turns(log: Log) -> None:
    """Raise InputError if an axis of the gyro of `log` turns as the attitude does, but in another unit or sense."""
    known, poses = np.isfinite(log.gyro).all(axis=1), np.isfinite(log.rotation).all(axis=(1, 2))
    t, rotation = log.t[poses], log.rotation[poses]
    later = np.minimum(np.searchsorted(t, t + TURN), len(t) - 1)
    turned = vee(np.swapaxes(rotation, 1, 2) @ rotation[later])
    angles = np.cumsum(log.gyro[known] * np.gradient(log.t[known])[:, None], axis=0)
    angle = np.column_stack([np.interp(t, log.t[known], one) for one in angles.T])
    seen, felt = (one - np.median(one, axis=0) for one in (turned, angle[later] - angle))  # of a gyro with a bias
    for k, name in enumerate(GYRO):
        a, b = np.linalg.norm(seen[:, k]), np.linalg.norm(felt[:, k])
        alike = seen[:, k] @ felt[:, k] / max(a * b, 1e-300)
        if abs(alike) > ALIKE and not 0.5 < (ratio := float(np.sign(alike) * b / a)) < 2:
            wanted = "the rate at which qw, qx, qy, qz turn body to world, rad/s"
            raise InputError(f"{log.name}, column {name}", wanted, f"{ratio:.3g} times that")


def _lost(begun: Pass, log: Log) -> InputError:
    """Return the error that names the first reading of `log` far from its prediction in the first pass, `begun`."""
    ratio = np.nan_to_num(np.abs(begun.errors) / begun.spreads, posinf=0.0)
    k, i = np.argwhere(ratio >= min(LOST, ratio.max()))[0]
    row, channel = int(np.searchsorted(log.t, instants(log)[k])) + 2, list(CHANNELS)[i // 3]
    said = f"readings of {channel} that the equations of the vehicle can follow"
    return InputError(f"{log.name}, near row {row}", said, f"one {ratio[k, i]:.1g} standard deviations off")


def drop_wild(log: Log) -> Log:
    """Return `log` without single readings that no motion makes, far from the median of five in a row."""
    streams = {name: getattr(log, "rotation" if name == "attitude" else name).copy() for name in CHANNELS}
    for name, stream in streams.items():
        rows = np.flatnonzero(np.isfinite(stream.reshape(len(stream), -1)).all(axis=1))
        if len(rows) < 5:
            continue
        known = stream[rows].reshape(len(rows), -1)
        near = np.pad(np.median(sliding_window_view(known, 5, axis=0), axis=-1), ((2, 2), (0, 0)), mode="edge")
        apart = np.abs(known - near).max(axis=1)
        stream[rows[apart > max(WILD * READ[name], WILD / 5 * np.quantile(apart, 0.95))]] = np.nan
    return replace(log, rotation=streams.pop("attitude"), **streams)


def first_noises(vehicle: Vehicle, log: Log) -> Noises:
    """Return the noises with which a search begins."""
    step = float(np.diff(instants(log)[:2])[0])
    decay = float(np.exp(-step / GUST_TIME))
    gust = (GUST * vehicle.weight) ** 2 * (1 - decay**2)
    driving = [*(np.array(DRIVE) ** 2 * step), gust, gust * (ON_BOB * vehicle.bob_mass / vehicle.mass) ** 2]
    return Noises(_reading_variances(log), np.array(driving), decay)


def _reading_variances(log: Log) -> Any:
    """Return the variance of the noise of each channel, from third differences, to which smooth motion adds little.

    Prediction errors alone do not tell noise of readings from gusts by their size. Medians pass over doublets.
    """
    rotation = log.rotation[np.isfinite(log.rotation).all(axis=(1, 2))]
    streams = {
        "position": log.position, "attitude": vee(np.swapaxes(rotation[:-1], 1, 2) @ rotation[1:]), "gyro": log.gyro,
        "force": log.force, "rod": log.rod,
    }  # fmt: skip
    found = []
    for name in CHANNELS:
        known = streams[name][np.isfinite(streams[name]).all(axis=1)]
        third = np.diff(known, n=2 if name == "attitude" else 3, axis=0)  # turns are first differences
        usual = np.median((third**2).sum(axis=1)) if len(third) > 100 else np.nan
        median = 1.386 if name == "rod" else 2.366  # of χ² with two and three degrees of freedom
        variance = usual / (20 * median)  # 1² + 3² + 3² + 1²
        found.append(np.clip(variance if np.isfinite(variance) else READ[name] ** 2, 1e-4 * READ[name] ** 2, None))
    return np.array(found)
