"""Smooth limits and steps."""

from __future__ import annotations

import casadi as ca

from flypend.geometry import Numbers, Scalar


def soft(value: Numbers, limit: Scalar) -> Numbers:
    """Return value/√(1 + |value|²/limit²): close to `value` if short, never longer than `limit`."""
    return value / ca.sqrt(1 + ca.dot(value, value) / limit**2)


def smooth_step(q: Scalar) -> Scalar:
    """Return exactly 0 below q = 0 and exactly 1 above q = 1; twice differentiable, so that ż_d has no jump."""
    q = 1 - positive(1 - positive(q))
    return q * q * q * (10 - q * (15 - 6 * q))


def positive(value: Scalar) -> Scalar:
    """Return `value` where it is positive, else 0: max(value, 0) with a derivative that takes one operation."""
    return value * (value > 0)
