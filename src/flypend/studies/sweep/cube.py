"""Samples of the unit cube, and their maps to uniform distributions on spheres, rotations, balls and discs.

Member j of a sample depends on the sample (kind, seed, stream, size, dimensions) and on j only, so that any chunk of it
can be drawn on its own.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from flypend.errors import InputError, require
from flypend.geometry import cross, scale, unit

SAMPLINGS = ("uniform", "sobol", "latin")
# Independent streams of one seed: the runs that a study reports, and the runs for tuning.
REPORTED, TUNED = 0, 1
# A Latin hypercube is drawn in one piece; this many numbers occupy 160 MB.
MOST_LATIN = 20_000_000
# Philox produces four numbers per step of its counter.
BLOCK = 4
# The period of a 30-bit Sobol sequence.
MOST_SOBOL = 2**30


def members(sampling: str, seed: int, stream: int, size: int, dimensions: int, first: int, last: int) -> Any:
    """Return members `first` to `last` (exclusive) of a sample: points (last − first, dimensions) in [0, 1)ⁿ.

    The whole sample has `size` points: independent ones ("uniform"), a scrambled Sobol sequence ("sobol") or a Latin
    hypercube ("latin"). Streams of one seed are independent. Raises InputError if it is too large for its kind.
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
    """Raise InputError if `sampling` cannot draw `size` points, or needs an extra that is not installed."""
    if sampling != "uniform":
        require("scipy", extra="studies", for_="sampling")
    if sampling == "latin" and size * dimensions > MOST_LATIN:
        most = f"at most {MOST_LATIN // dimensions} in {dimensions} dimensions as a Latin hypercube (or sobol)"
        raise InputError("runs", most, size)
    if sampling == "sobol" and size > MOST_SOBOL:
        raise InputError("runs", f"at most {MOST_SOBOL} of a Sobol sequence", size)


def _sobol(seed: int, stream: int, dimensions: int, first: int, last: int) -> Any:
    """Return rows `first` to `last` (n, dimensions) of a scrambled Sobol sequence, in [0, 1)."""
    from scipy.stats.qmc import Sobol  # an extra, which `check_size` requires

    source = Sobol(dimensions, rng=np.random.default_rng([seed, stream]))
    if first:
        return source.fast_forward(first).random(last - first)
    # Draw one point, then the rest: SciPy warns if the first draw is not a power of two, which is intended here.
    return np.concatenate([source.random(1), source.random(last - 1)]) if last > 1 else source.random(last)


@lru_cache(maxsize=2)
def _latin(seed: int, stream: int, size: int, dimensions: int) -> Any:
    """Return a Latin hypercube (size, dimensions), in [0, 1)."""
    from scipy.stats.qmc import LatinHypercube

    return LatinHypercube(dimensions, rng=np.random.default_rng([seed, stream])).random(size)


def on_sphere(u: Any) -> Any:
    """Map u (n, 2), uniform in the square, to unit vectors (n, 3), uniform on S²: height and azimuth (Archimedes)."""
    height, angle = 2 * u[:, 0] - 1, 2 * np.pi * u[:, 1]
    radius = np.sqrt(np.maximum(1 - height**2, 0))
    return unit(np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1))


def as_quat_xyzw(u: Any) -> Any:
    """Map u (n, 3), uniform in the cube, to quaternions (n, 4), uniform rotations on SO(3) (Shoemake 1992)."""
    one, two = np.sqrt(1 - u[:, 0]), np.sqrt(u[:, 0])
    a, b = 2 * np.pi * u[:, 1], 2 * np.pi * u[:, 2]
    return np.stack([one * np.sin(a), one * np.cos(a), two * np.sin(b), two * np.cos(b)], axis=1)


def in_ball(u: Any, radius: float) -> Any:
    """Map u (n, 3), uniform in the cube, to vectors (n, 3), uniform in a ball."""
    return scale(radius * np.cbrt(u[:, 0]), on_sphere(u[:, 1:]))


def in_disc(u: Any, y: Any, radius: float) -> Any:
    """Map u (n, 2), uniform in the square, to tangent vectors (n, 3) at unit vectors y (n, 3), uniform in a disc."""
    far = np.where(np.abs(y[:, :1]) < 0.6, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])  # not along y
    one = unit(cross(y, far))
    length, angle = radius * np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
    return scale(length * np.cos(angle), one) + scale(length * np.sin(angle), cross(y, one))


def tilt_rods(tilt: Any, azimuth: Any, rate: Any, heading: Any) -> tuple[Any, Any]:
    """Return y and y_dot (n, 3), e₃ up, of rods at `tilt` from inverted towards `azimuth`, with |y_dot| = `rate`.

    Angles are in rad, rates in 1/s. The rate increases the tilt if `heading` is 0, the azimuth if it is π/2.
    """
    level = np.stack([np.cos(azimuth), np.sin(azimuth), np.zeros_like(azimuth)], axis=1)
    across = np.stack([-np.sin(azimuth), np.cos(azimuth), np.zeros_like(azimuth)], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    y = scale(np.sin(tilt), level) + np.multiply.outer(np.cos(tilt), up)
    outward = scale(np.cos(tilt), level) - np.multiply.outer(np.sin(tilt), up)
    return y, scale(rate * np.cos(heading), outward) + scale(rate * np.sin(heading), across)
