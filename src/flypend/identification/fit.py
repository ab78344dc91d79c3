"""Maximum likelihood by scoring: passes of the filter, each followed by a step of the numbers and of the noises."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from flypend.errors import InputError
from flypend.geometry import Numbers, Vector, vee
from flypend.identification.filtering import GUST_TIME, Noises, Pass, Programs, run_filter
from flypend.identification.log import Log, grid_step, to_grid
from flypend.identification.model import CHANNELS, MOVING, READING, moves, reads, sizes, split
from flypend.identification.numbers import Search, search_from
from flypend.identification.rotors import Forces, rotor_forces, rotor_slopes, rotor_table
from flypend.model import Vehicle

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
QUIETEST = 1e-4  # of a variance, over that with which the search begins


@dataclass(frozen=True)
class Fit:
    """Where the search ended.

    Parameters
    ----------
    search : Search
        What was searched.
    theta : (p,)
        Its end.
    covariance : (p, p)
        Of θ, by the scores of segments.
    last : Pass
        The last pass of the filter.
    passes : int
        How many there were.
    converged : bool
        Whether the last step was below `DONE` standard errors.
    """

    search: Search
    theta: Numbers
    covariance: Numbers
    last: Pass
    noises: Noises
    passes: int
    converged: bool


def fit(log: Log, vehicle: Vehicle, marker: Vector, pwm: bool, progress: Progress = None) -> Fit:
    """Search the numbers of `vehicle`, the guess, that make `log` likeliest.

    `marker` is the tracked point from the pivot, body frame, m; `pwm` says that commands are fractions; `progress` is
    called with ("pass", done, total).
    """
    search = search_from(vehicle, pwm, bool(np.isfinite(log.force).any()))
    programs = Programs(moves(vehicle), reads(vehicle, marker))
    first = noises = first_noises(vehicle, log)
    free, theta = search.spread > 0, np.zeros(len(search.guess))
    prior = np.where(free, search.spread, 1.0) ** -2
    for k in range(PASSES):
        with threadpool_limits(1):  # matrices are small
            found = one_pass(log, search, theta, noises, programs, pwm, gated=k >= UNGATED)
        if not np.isfinite(found.scores).all():
            raise InputError("log", "a flight that the equations of the vehicle can follow", "one that they cannot")
        slope = search.slope(theta)
        information = (found.information * np.outer(slope, slope) + np.diag(prior))[np.ix_(free, free)]
        scores = (found.scores * slope)[:, free]
        bread = np.linalg.inv(information)
        step = np.zeros(len(theta))
        step[free] = bread @ (scores.sum(axis=0) - (prior * theta)[free])
        after = search.within(theta + step)
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
    covariance[np.ix_(free, free)] = _wider(sandwich, bread)
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


def first_noises(vehicle: Vehicle, log: Log) -> Noises:
    """Return the noises with which a search begins."""
    step = grid_step(log)
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


def _wider(one: Any, other: Any) -> Any:
    """Return a covariance with the larger standard deviations of two, correlated as the first."""
    widen = np.sqrt(np.maximum(1.0, np.diag(other) / np.maximum(np.diag(one), 1e-300)))
    return one * np.outer(widen, widen)
