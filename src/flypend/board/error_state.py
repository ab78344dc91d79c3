"""Errors of an estimate on R³ × SO(3) × S², and how their covariance evolves.

The error has 13 numbers, in this order: δc and δv of the centre of mass c = x + a y, a = m l/(M+m), and of its
velocity; δθ of the attitude, in the world frame; η and σ of the rod and its rate, in a frame B = (b, y × b) of the
tangent plane at y that moves with the rod without turning about it:

    R = exp(δθ^) R̂,   y = unit(ŷ + B η),   ẏ = P_y (ŷ_dot + B σ).

With the force φ of the vehicle on its rotors' axes (world frame), u = φ/(M l) and w = Bᵀ ẏ, to first order

    δċ = δv,   δv̇ = δθ × φ/(M+m),   δθ̇ = R δω,   η̇ = σ,   σ̇ = ((y·u − |w|²) 1 + w wᵀ) η + Bᵀ (u × δθ).

The rod's length is found as well: the pull on a rod is φ/(M l), and with δλ of the ratio λ of the nominal to the true
length, σ̇ = … − Bᵀ u δλ. What pulls is known best: thrust and attitude are. Last, where no attitude is measured, three
more numbers follow, δβ of the gyroscope's bias, with δθ̇ = R (δω − δβ), and with an
accelerometer δα of its bias. It is taken for a force M R δα + m y (y·R δα) on the vehicle, so that

    δv̇ = … − (M R δα + m y (y·R δα))/(M+m),   σ̇ = … + Bᵀ R δα/l.

With a measured attitude both are found at once, and the estimator does without (`estimator`).

Error and attitude do not enter where they have no effect: the centre of mass does not feel the rod, neither feels yaw.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import casadi as ca
import numpy as np

from flypend.geometry import Matrix, Numbers, Scalar, Vector, clip, cross, dot, hat, polar_step, tangent_part, unit
from flypend.model import State, Vehicle
from flypend.model.momenta import lever
from flypend.plants.cascade import rotation_by
from flypend.plants.noise import Noise

CENTRE, VELOCITY, TURN, ROD, SWING = slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 11), slice(11, 13)
ERRORS = 13
PULL = slice(13, 14)  # nominal over true length of the rod, less 1
BIAS = slice(14, 17)  # of the gyroscope, where no attitude is measured
FELT_BIAS = slice(17, 20)  # of the accelerometer, where no attitude is measured

# Prior standard deviation of the pull, what it walks, 1/√s, and the most that is believed: rods 15 % off are two
# standard deviations away, and a first estimate takes a second. A rod does not change; the walk forgets a bad start.
PULL_PRIOR, PULL_WALK, MOST_PULL = 0.08, 3e-3, 0.3

# Prior standard deviation of the gyroscope's bias, rad/s, and its random walk, rad/s/√s. A larger bias takes a few
# seconds more. With a wider prior, a wrong rod length, of which nothing here knows, is taken for a bias after a
# swing-up: with 0.01 one flight in ten of a rod 15 % longer still trembles after 12 s.
BIAS_PRIOR, BIAS_WALK = 0.005, 1e-4
# The same of the accelerometer, m/s² and m/s²/√s.
FELT_BIAS_PRIOR, FELT_BIAS_WALK = 0.1, 1e-3
# Density of the error of the rate of turn per rate of turn, 1/√Hz, where no attitude is measured: an IMU askew by 1°
# turns the estimate by that share of every turn. With 5e-3 flights of an IMU that is not begin to fail.
ASKEW = 2e-3

# Readings further off than GATE standard deviations are doubted: of 1e7 numbers with a normal distribution some six
# are. PATIENCE such readings more than others, and they are believed: of 1 % wrong ones, one in 1e6 finds it so.
GATE, PATIENCE = 5.0, 3


class Reading(NamedTuple):
    """One number read: its `difference` from what was expected, its `row` (1, 13) of sensitivities, its variance.

    `fresh` is 1 if it has arrived and 0 if not.
    """

    difference: Scalar
    row: Numbers
    variance: float
    fresh: Scalar


def frame(b: Vector, y: Vector) -> Numbers:
    """Return B (3, 2) for its first column `b` (3,) at the rod `y`."""
    return ca.horzcat(b, cross(y, b))


def unpack(numbers: Numbers) -> Numbers:
    """Return the covariance (n, n) of its `numbers` (n (n + 1)/2,), the lower triangle by rows."""
    size = int(np.sqrt(2 * numbers.numel()))
    P = ca.SX(size, size)
    for place, (i, j) in enumerate(zip(*np.tril_indices(size), strict=True)):
        P[int(i), int(j)] = P[int(j), int(i)] = numbers[place]
    return P


def pack(P: Numbers) -> Numbers:
    """Return the numbers (n (n + 1)/2,) of a covariance (n, n)."""
    return ca.vertcat(*(P[int(i), int(j)] for i, j in zip(*np.tril_indices(P.shape[0]), strict=True)))


def first_covariance(start: Noise, s: State, B: Numbers, vehicle: Vehicle) -> Numbers:
    """Return the covariance (13, 13) of an estimate `s` with errors `start`, without a bias."""
    a, y_dot = lever(vehicle), B.T @ s.y_dot
    J = ca.SX.eye(ERRORS)
    J[CENTRE, ROD] = a * B
    J[VELOCITY, SWING] = a * B
    J[VELOCITY, ROD] = -a * s.y @ y_dot.T  # ẏ stays tangent
    variances = [start.x**2] * 3 + [start.x_dot**2] * 3 + [start.attitude**2] * 3
    variances += [start.y**2] * 2 + [start.y_dot**2] * 2
    return J @ ca.diag(ca.SX(variances)) @ J.T


def update(
    P: Numbers, streams: Sequence[Sequence[Reading]], rejections: Numbers, calm: Scalar = 1.0
) -> tuple[Numbers, Numbers, Numbers]:
    """Return the error (n,) that the readings of `streams` tell, one by one, its covariance, and the `rejections`.

    A number further from what is expected than GATE standard deviations is left out, unless its stream has had PATIENCE
    more such readings of late than others: then it is the estimate that is wrong.

    Biases take the share `calm` of their gain, the pull on the rod what that leaves: in hover an offset of the rod's
    markers looks like a pull. With shares s, the covariance falls by s_i + s_j − s_i s_j of what whole gains would
    leave out: the partial update of Schmidt and Kalman. With all of it they would be claimed to be known from readings
    that have not corrected them.
    """
    share = ca.SX.ones(P.shape[0], 1)
    share[ERRORS:] = calm
    if P.shape[0] > ERRORS:
        share[PULL] = 1 - calm
    apart = 1 - (1 - share) @ (1 - share).T
    error, after = ca.SX(P.shape[0], 1), []
    for readings, rejected in zip(streams, ca.vertsplit(rejections), strict=True):
        gate, far, arrived = rejected < PATIENCE - 0.5, ca.SX(0), ca.SX(0)
        for difference, row, variance, fresh in readings:
            seen = P[:, :ERRORS] @ row.T
            expected, left = row @ seen[:ERRORS] + variance, difference - row @ error[:ERRORS]
            off, arrived = fresh * (left**2 > GATE**2 * expected), fresh
            far = ca.fmax(far, off)
            gain = (fresh - gate * off) * seen / expected
            error, learnt = error + share * gain * left, apart * (gain @ seen.T)
            P = unpack(pack(P - learnt))
        after.append(clip(rejected + arrived * (2 * far - 1), 0, 2 * PATIENCE))
    return error, P, ca.vertcat(*after)


def correct(s: State, b: Vector, error: Numbers, vehicle: Vehicle) -> tuple[State, Vector, Matrix]:
    """Return the estimate `s` and the tangent vector `b`, corrected by an `error` (n,), and the turn (3, 3)."""
    B, a = frame(b, s.y), lever(vehicle)
    turn = rotation_by(error[TURN])
    y = unit(s.y + B @ error[ROD])
    y_dot = tangent_part(y, s.y_dot + B @ error[SWING])
    x = s.x + error[CENTRE] + a * (s.y - y)
    x_dot = s.x_dot + error[VELOCITY] + a * (s.y_dot - y_dot)
    return (
        State(x=x, x_dot=x_dot, R=polar_step(turn @ s.R), omega=s.omega, y=y, y_dot=y_dot),
        unit(tangent_part(y, b)),
        turn,
    )


class Densities(NamedTuple):
    """Spectral densities of what drives the errors.

    Specific forces on the vehicle and on the bob beyond the model, (m/s²)²/Hz, and the error of the angular velocity,
    (rad/s)²/Hz.
    """

    on_vehicle: Scalar
    on_bob: Scalar
    turning: float


def propagate(
    P: Numbers, s: State, b: Vector, force: Vector, vehicle: Vehicle, h: float, densities: Densities
) -> Numbers:
    """Return the covariance (n, n) a time `h` (s) after `P` at the state `s`, under the vehicle's `force` (3,), N."""
    B, M, m, size = frame(b, s.y), vehicle.M, vehicle.m, P.shape[0]
    u, w = force / (M * vehicle.l), B.T @ s.y_dot
    F = ca.SX.eye(size)
    F[CENTRE, VELOCITY] = h * ca.SX.eye(3)
    F[VELOCITY, TURN] = -h / (M + m) * hat(force)
    F[ROD, SWING] = h * ca.SX.eye(2)
    F[SWING, ROD] += h * ((dot(s.y, u) - ca.sumsqr(w)) * ca.SX.eye(2) + w @ w.T)
    F[SWING, TURN] = h * B.T @ hat(u)
    Q = ca.SX(size, size)
    for share, pull, density in ((M / (M + m), -1, densities.on_vehicle), (m / (M + m), 1, densities.on_bob)):
        G = ca.SX(size, 3)
        G[VELOCITY, :] = share * ca.SX.eye(3)
        G[SWING, :] = pull / vehicle.l * B.T
        Q += h * density * G @ G.T
    Q[TURN, TURN] += h * densities.turning * ca.SX.eye(3)
    if size > ERRORS:
        F[SWING, PULL] = -h * B.T @ u
        Q[PULL, PULL] = h * PULL_WALK**2
    if size > PULL.stop:
        F[TURN, BIAS] = -h * s.R
        Q[TURN, TURN] += h * ASKEW**2 * dot(s.omega, s.omega) * ca.SX.eye(3)
        Q[BIAS, BIAS] += h * BIAS_WALK**2 * ca.SX.eye(3)
    if size > BIAS.stop:
        F[VELOCITY, FELT_BIAS] = -h / (M + m) * (M * s.R + m * s.y @ (s.y.T @ s.R))
        F[SWING, FELT_BIAS] = h / vehicle.l * B.T @ s.R
        Q[FELT_BIAS, FELT_BIAS] += h * FELT_BIAS_WALK**2 * ca.SX.eye(3)
    return F @ P @ F.T + Q


# Rows of readings -------------------------------------------------------------------------------------------------


def position_rows(b: Vector, y: Vector, age: Scalar, vehicle: Vehicle) -> Numbers:
    """Return the sensitivities (3, 13) of the pivot's position `age` seconds ago, x = c − a y."""
    B, a = frame(b, y), lever(vehicle)
    H = ca.SX(3, ERRORS)
    H[:, CENTRE], H[:, VELOCITY] = ca.SX.eye(3), -age * ca.SX.eye(3)
    H[:, ROD], H[:, SWING] = -a * B, a * age * B
    return H


def attitude_rows() -> Numbers:
    """Return the sensitivities (3, 13) of the turn from an estimated attitude to the one read, world frame."""
    H = ca.SX(3, ERRORS)
    H[:, TURN] = ca.SX.eye(3)
    return H


def rod_rows(age: Scalar) -> Numbers:
    """Return the sensitivities (2, 13) of Bᵀ y `age` seconds ago."""
    H = ca.SX(2, ERRORS)
    H[:, ROD], H[:, SWING] = ca.SX.eye(2), -age * ca.SX.eye(2)
    return H


def joint_rows(B: Numbers, y: Vector, age: Scalar) -> Numbers:
    """Return the sensitivities (2, 13) of Bᵀ R̂ Rᵀ y: the rod as seen from the vehicle."""
    H = rod_rows(age)
    H[:, TURN] = B.T @ hat(y)
    return H


def rod_rate_rows(B: Numbers, y: Vector, y_dot: Vector) -> Numbers:
    """Return the sensitivities (2, 13) of Bᵀ (R̂ Rᵀ (y × ẏ) × ŷ): the rod's rate as seen from the vehicle."""
    H = ca.SX(2, ERRORS)
    H[:, SWING] = ca.SX.eye(2)
    H[:, TURN] = -B.T @ cross(y, y_dot) @ y.T
    return H
