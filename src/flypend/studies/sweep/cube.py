"""Points of the unit cube, member by member, and the uniform laws on spheres, rotations and balls that they stand for.

Member j of a sample is a function of seed and j alone, so that any chunk of it can be drawn on its own.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from flypend.errors import InputError, require
from flypend.geometry import cross, rotation_from_quat_xyzw, scale, unit

SAMPLINGS = ("uniform", "sobol", "latin")
# Streams of one seed that share no number: what a sweep reports, and what gains are tuned on.
REPORTED, TUNED = 0, 1
# A Latin hypercube is drawn as a whole; this many numbers are 160 MB.
MOST_LATIN = 20_000_000
# Philox gives four numbers per step of its counter.
BLOCK = 4
# Further than this a Sobol sequence of 30 bits repeats itself.
MOST_SOBOL = 2**30


def members(sampling: str, seed: int, stream: int, size: int, dimensions: int, first: int, last: int) -> Any:
    """Members `first` to `last` (not included) of a sample: points (last − first, dimensions) of [0, 1)ⁿ.

    Parameters
    ----------
    sampling : "uniform", "sobol" or "latin"
        Independent points; a scrambled Sobol sequence; a Latin hypercube.
    seed, stream : int
        Which sample: streams of one seed are independent.
    size, dimensions : int
        Of the whole sample.
    first, last : int
        Range of members.

    Raises
    ------
    InputError
        For a sample too large for its kind.
    """
    if dimensions == 0:
        return np.zeros((last - first, 0))
    check_size(sampling, size, dimensions)
    if sampling == "latin":
        return _latin(seed, stream, size, dimensions)[first:last]
    if sampling == "sobol":
        return _sobol(seed, stream, dimensions, first, last)
    steps = -(-dimensions // BLOCK)
    key = np.random.SeedSequence([seed, stream]).generate_state(2, np.uint64)
    source = np.random.Generator(np.random.Philox(key=key, counter=[first * steps, 0, 0, 0]))
    return source.random((last - first, BLOCK * steps))[:, :dimensions]


def check_size(sampling: str, size: int, dimensions: int) -> None:
    """Raise InputError for a sample of `size` points that `sampling` cannot give, or gives with an extra only."""
    if sampling != "uniform":
        require("scipy", extra="studies", for_="sampling")
    if sampling == "latin" and size * dimensions > MOST_LATIN:
        most = f"at most {MOST_LATIN // dimensions} in {dimensions} dimensions as a Latin hypercube (or sobol)"
        raise InputError("runs", most, size)
    if sampling == "sobol" and size > MOST_SOBOL:
        raise InputError("runs", f"at most {MOST_SOBOL} of a Sobol sequence", size)


def _sobol(seed: int, stream: int, dimensions: int, first: int, last: int) -> Any:
    from scipy.stats.qmc import Sobol  # of an extra: `check_size` asks for it

    source = Sobol(dimensions, rng=np.random.default_rng([seed, stream]))
    if first:
        return source.fast_forward(first).random(last - first)
    # One point and then the rest: a number of points that is no power of two is meant.
    return np.concatenate([source.random(1), source.random(last - 1)]) if last > 1 else source.random(last)


@lru_cache(maxsize=2)
def _latin(seed: int, stream: int, size: int, dimensions: int) -> Any:
    from scipy.stats.qmc import LatinHypercube

    return LatinHypercube(dimensions, rng=np.random.default_rng([seed, stream])).random(size)


def on_sphere(u: Any) -> Any:
    """Unit vectors (n, 3), uniform on S² for u (n, 2) uniform in the square: height and azimuth (Archimedes)."""
    height, angle = 2 * u[:, 0] - 1, 2 * np.pi * u[:, 1]
    radius = np.sqrt(np.maximum(1 - height**2, 0))
    return unit(np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1))


def as_quat_xyzw(u: Any) -> Any:
    """Quaternions (n, 4), their rotations uniform on SO(3) for u (n, 3) uniform in the cube (Shoemake 1992)."""
    one, two = np.sqrt(1 - u[:, 0]), np.sqrt(u[:, 0])
    a, b = 2 * np.pi * u[:, 1], 2 * np.pi * u[:, 2]
    return np.stack([one * np.sin(a), one * np.cos(a), two * np.sin(b), two * np.cos(b)], axis=1)


def rotations(quat_xyzw: Any) -> Any:
    """Rotation matrices (n, 3, 3) of quaternions (n, 4)."""
    return rotation_from_quat_xyzw(quat_xyzw)


def in_ball(u: Any, radius: float) -> Any:
    """Vectors (n, 3), uniform in a ball for u (n, 3) uniform in the cube."""
    return scale(radius * np.cbrt(u[:, 0]), on_sphere(u[:, 1:]))


def in_disc(u: Any, y: Any, radius: float) -> Any:
    """Tangent vectors (n, 3) at unit vectors y (n, 3), uniform in a disc for u (n, 2) uniform in the square."""
    far = np.where(np.abs(y[:, :1]) < 0.6, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])  # not along y
    one = unit(cross(y, far))
    length, angle = radius * np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
    return scale(length * np.cos(angle), one) + scale(length * np.sin(angle), cross(y, one))


def tilted(tilt: Any, azimuth: Any, rate: Any, heading: Any) -> tuple[Any, Any]:
    """Rods y and their rates y_dot (n, 3), e₃ up, at `tilt` from inverted towards `azimuth`, moving with `rate`.

    Angles in rad; a rate (1/s) with `heading` 0 increases the tilt, with π/2 the azimuth.
    """
    level = np.stack([np.cos(azimuth), np.sin(azimuth), np.zeros_like(azimuth)], axis=1)
    across = np.stack([-np.sin(azimuth), np.cos(azimuth), np.zeros_like(azimuth)], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    y = scale(np.sin(tilt), level) + np.multiply.outer(np.cos(tilt), up)
    outward = scale(np.cos(tilt), level) - np.multiply.outer(np.sin(tilt), up)
    return y, scale(rate * np.cos(heading), outward) + scale(rate * np.sin(heading), across)
