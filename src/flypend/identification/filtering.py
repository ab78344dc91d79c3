"""One pass of the extended Kalman filter over a log, with the score of the prediction errors by segments.

The filter carries D, the derivative of its error by the searched numbers θ, along: with gain K, readings' derivatives H
and G, and motion's F and B, (1 − K H) D − K G after a reading, and F D + B after a step. The derivative of the gain is
left out: it multiplies prediction errors, which nothing before them foretells, and so leaves the score's mean at zero.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from flypend import signals
from flypend.geometry import Numbers, unit
from flypend.identification.log import Grid
from flypend.identification.model import ERROR, LOCAL, MOVING, READING, places, sizes
from flypend.identification.rotors import Forces

SEGMENT = 2.0  # s, over which scores are summed: some correlation times of gusts and swings
SETTLING = 1.0  # s at the beginning, in which the filter finds the state; they do not count
BLOCK = 10.0  # s, over which later readings tell of a gust; memory grows with it
GATE = 6.0  # standard deviations beyond which a channel's reading is taken to be of something else
GUST_TIME = 1.0  # s
# Power of the ratio by which what drives is corrected: scores feel a part of an error of a slow gust.
HASTE = 1.5
ABSENT = 0.6  # a ratio below which the noise is probably none; it leaves twice as fast
# Parts of a local error of the state that share one density of noise.
NOISY = places({
    "x": 3, "x_dot": 3, "phi": 3, "omega": 2, "omega_3": 1, "y": 3, "y_dot": 3, "on_vehicle": 3, "on_bob": 3,
})  # fmt: skip
# Of what drives, these are estimated: white accelerations explain what gusts do, and would take their place.
SOUGHT = ("omega", "omega_3", "on_vehicle", "on_bob")
DRIVEN = ("x_dot", "omega", "omega_3", "y_dot", "on_vehicle", "on_bob")


@dataclass(frozen=True)
class Noises:
    """Variances: of each channel's readings, (5,), and of what drives each part of `DRIVEN` in a step, (6,)."""

    reading: Numbers
    driving: Numbers
    decay: float

    def matrices(self) -> tuple[Any, Any]:
        """Return the variances of the 15 readings and of the 24 local errors of a step."""
        Q = np.zeros(LOCAL)
        for name, value in zip(DRIVEN, self.driving, strict=True):
            Q[NOISY[name]] = value
        return np.repeat(self.reading, 3), Q


class Programs(NamedTuple):
    """The compiled functions of `identification.model`."""

    move: Callable[..., Any]
    read: Callable[..., Any]


@dataclass(frozen=True)
class Pass:
    """What a pass found."""

    information: (
        Numbers  # (p, p): sum of JᵀS⁻¹J over readings, J the derivative of a prediction error, S its covariance
    )
    scores: Numbers  # (segments, p): minus the gradient of the cost, by segments of `SEGMENT` seconds
    noises: Noises  # what the prediction errors say of the noises
    errors: Numbers  # (k, 15): prediction errors; NaN where nothing was read
    spreads: Numbers  # (k, 15): their standard deviations
    refused: int  # readings beyond `GATE`


def run_filter(
    grid: Grid, forces: Forces, by_rotors: Numbers, moving: Numbers, reading: Numbers, noises: Noises,
    programs: Programs, gated: bool,
) -> Pass:  # fmt: skip
    """Filter the readings of `grid`, weighing them by `noises`; if `gated`, those beyond `GATE` are left out.

    `forces` are those of the rotors at the grid; `by_rotors` (2, k, n, q) are derivatives of the mean over the step
    that follows, and of the force now, by the numbers of the rotors. `moving` and `reading` are numbers of
    `model.MOVING` and `model.READING`, whose `latency` is what remains beyond that of the grid.
    """
    h, count = float(grid.t[1] - grid.t[0]), len(grid.t)
    m, q, n = sizes(MOVING), by_rotors.shape[-1], forces.now.shape[1]
    p = m + q + sizes(READING)
    R, Q = noises.matrices()
    (s, gusts, P), D = _begin(grid, R, noises), np.zeros((LOCAL, p))
    information, settled = np.zeros((p, p)), round(SETTLING / h)
    per_segment, per_block = max(1, round(SEGMENT / h)), round(BLOCK / h)
    scores = np.zeros((count // per_segment + 1, p))
    errors, spreads = np.full((count, 15), np.nan), np.full((count, 15), np.nan)
    there = np.repeat(grid.counts > 0, 3, axis=1)
    variances = R / np.repeat(np.maximum(grid.counts, 1), 3, axis=1)
    back, refused = _Backward(), 0
    F, A, B = np.eye(LOCAL), np.zeros((LOCAL, LOCAL)), np.zeros((LOCAL, p))
    eye, e_all, nothing = np.eye(LOCAL), np.zeros(15), np.zeros(LOCAL)
    for k in range(count):
        if k % 500 == 0:
            signals.poll()
        correction, seen, evidence, kept = nothing, there[k], None, eye
        if seen.any():
            z, H_all = programs.read(s, gusts, forces.now[k], grid.age[k], moving, reading)
            H_all, y = H_all.reshape(-1, 15).T, grid.values[k]
            e_all[:3], e_all[6:] = y[:3] - z[:3], y[12:] - z[12:]
            turned = z[3:12].reshape(3, 3).T @ y[3:12].reshape(3, 3)
            e_all[3:6] = turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]
            e_all[3:6] /= 2
            if gated and k >= settled:
                H = H_all[:, :LOCAL]
                far = (e_all**2 > GATE**2 * (((H @ P) * H).sum(axis=1) + variances[k])) & seen
                if far.any():
                    out = far.reshape(5, 3).any(axis=1)
                    refused += int(out.sum())
                    seen = seen & ~np.repeat(out, 3)
            rows = np.flatnonzero(seen)
            H, e = H_all[rows, :LOCAL], e_all[rows]
            J = H @ D
            J[:, :m] += H_all[rows, LOCAL : LOCAL + m]
            J[:, m : m + q] += H_all[rows, LOCAL + m : LOCAL + m + n] @ by_rotors[1, k]
            J[:, m + q :] += H_all[rows, LOCAL + m + n :]
            PHt = P @ H.T
            S = H @ PHt
            S.flat[:: len(rows) + 1] += variances[k, rows]
            S_inv = np.linalg.inv(S)
            K = PHt @ S_inv
            correction = K @ e
            if k >= settled:
                weighed = S_inv @ J
                information += J.T @ weighed
                scores[k // per_segment] += e @ weighed
                errors[k, rows], spreads[k, rows] = e, S.diagonal()
                evidence = (H.T @ (S_inv @ e), H.T @ S_inv @ H)
            kept = eye - K @ H
            P = P - K @ PHt.T
            D = D - K @ J
        if k + 1 == count:
            back.add(evidence, kept)
            back.close()
            break
        s, gusts, by = programs.move(
            s, gusts, correction, forces.mean[k], forces.change[k], h, noises.decay, moving
        )  # fmt: skip
        by = by.reshape(-1, ERROR).T
        A[:ERROR], B[:ERROR, :m] = by[:, :LOCAL], by[:, LOCAL : LOCAL + m]
        B[:ERROR, m : m + q] = by[:, LOCAL + m :] @ by_rotors[0, k]
        F = eye + h * A + (h * h / 2) * (A @ A)
        F[ERROR:] *= noises.decay
        added = h * (B + (h / 2) * (A @ B))
        across = np.eye(3) - s[18:21, None] * s[18:21]  # what was along the rod is gone: it is a unit vector
        for part in (slice(12, 15), slice(15, 18)):
            F[part], added[part] = across @ F[part], across @ added[part]
        back.add(evidence, F @ kept)
        if (k + 1) % per_block == 0:
            back.close()
        P = F @ P @ F.T
        P = (P + P.T) / 2
        P.flat[:: LOCAL + 1] += Q
        D = F @ D + added
    ratio = np.array([back.found[NOISY[name]].sum() / back.expected[NOISY[name]].sum() for name in DRIVEN])
    ratio[[name not in SOUGHT for name in DRIVEN]] = 1.0
    change = np.clip(ratio ** np.where(ratio < ABSENT, 2 * HASTE, HASTE), 1e-3, 10)
    better = Noises(noises.reading, noises.driving * change, noises.decay)
    return Pass(information, scores, better, errors, np.sqrt(spreads), refused)


class _Backward:
    """Scores of the noise that drives, by the adjoint of the filter (de Jong, "Smoothing and interpolation", 1989).

    With r the gradient of the log-likelihood of later readings by the predicted state, and N its variance if the model
    is right, the likelihood is stationary in the noise of a step where the sums of r² and of N are equal.
    """

    def __init__(self) -> None:
        self.found, self.expected = np.zeros(LOCAL), np.zeros(LOCAL)
        self._steps: list[tuple[Any, Any]] = []

    def add(self, evidence: tuple[Any, Any] | None, onward: Any) -> None:
        """Keep a step: (Hᵀ S⁻¹ e, Hᵀ S⁻¹ H) of its readings, and F (1 − K H)."""
        self._steps.append((evidence, onward))

    def close(self) -> None:
        """Go back over the steps kept, and forget them."""
        r, N = np.zeros(LOCAL), np.zeros((LOCAL, LOCAL))
        for evidence, onward in reversed(self._steps):
            r, N = onward.T @ r, onward.T @ N @ onward
            if evidence is not None:
                r, N = r + evidence[0], N + evidence[1]
            self.found += r**2
            self.expected += N.diagonal()
        self._steps = []


def _begin(grid: Grid, R: Numbers, noises: Noises) -> tuple[Any, Any, Any]:
    """Return state, gusts and covariance at the start, from the first readings."""
    first = [int(np.argmax(grid.counts[:, i] > 0)) for i in range(5)]
    values = grid.values
    y = values[first[4], 18:21] if grid.counts[:, 4].any() else np.array([0.0, 0.0, -1.0])
    s = np.concatenate([
        values[first[0], :3], np.zeros(3), values[first[1], 3:12], values[first[2], 12:15], unit(y), np.zeros(3),
    ])  # fmt: skip
    P = np.zeros(LOCAL)
    P[0:3], P[3:6], P[6:9], P[9:12] = 0.01**2 + R[0], 1.0, 0.02**2 + R[3], 0.1**2 + R[6]
    P[12:15], P[15:18] = (0.05**2 + R[12] if grid.counts[:, 4].any() else 0.3**2), 1.0
    left = max(1 - noises.decay**2, 1e-6)
    P[18:21], P[21:24] = noises.driving[4] / left, noises.driving[5] / left
    return s, np.zeros(6), np.diag(P)
