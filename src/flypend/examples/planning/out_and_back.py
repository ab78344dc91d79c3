"""A path in time, 1.5 m out and back in 3 s, for flypend plan --path; see out-and-back.toml."""

import casadi as ca

DISTANCE, DURATION = 1.5, 3.0  # m, s


def path(t):
    """Return where the pivot is to be at time `t` (s), m: from rest, there, and back to rest."""
    s = ca.fmin(t / DURATION, 1)
    turn = 2 * ca.pi * s**3 * (10 - 15 * s + 6 * s**2)
    return ca.vertcat(DISTANCE * (1 - ca.cos(turn)) / 2, 0, 0)
