"""Theorem 1 exactly as printed. It does not do what it claims: see docs/paper/errata.md."""

from __future__ import annotations

from flypend import errors
from flypend.laws.law import Law
from flypend.laws.theorem1 import BETA_GUARD, theorem_1


def printed(
    *, k_d: float = 1.0, k_1: float = 9.0, k_2: float = 4.0, speed_floor: float = 1e-6, beta: str = "minimum-norm"
) -> Law:
    """Theorem 1 with the printed damping sign and the minimum-norm beta, in the paper's frame (e₃ along gravity).

    Parameters
    ----------
    k_d, k_1, k_2 : float
        The paper's gains K: damping of the rod (1/s), stiffness (1/s²) and damping (1/s) of the thrust axis; > 0.
    speed_floor : float
        s in √(|ẏ|² + s²), which stands for |ẏ| in (kpeqn), rad/s. At 0, to the letter, the law is undefined at ẏ = 0,
        where experiment 4 starts; the default tells what happens from there, and no result depends on its value.
    beta : "minimum-norm" or "off"
        beta by the minimum-norm A (as printed), or dropped, to see the damping sign alone.

    Raises
    ------
    InputError
        For a gain that is not positive, a negative floor, or an unknown `beta`.
    """
    gains = {
        "k_d": errors.number("k_d", k_d, above=0, unit="1/s"),
        "k_1": errors.number("k_1", k_1, above=0, unit="1/s²"),
        "k_2": errors.number("k_2", k_2, above=0, unit="1/s"),
        "speed_floor": errors.number("speed_floor", speed_floor, at_least=0, unit="rad/s"),
        "beta": errors.one_of("beta", beta, ("minimum-norm", "off")),
    }
    with_beta = beta == "minimum-norm"
    return Law(
        name="printed",
        e3="down",
        gains=gains,
        control=lambda t, state, vehicle, k: theorem_1(
            t, state, vehicle, k_d=k.k_d, k_1=k.k_1, k_2=k.k_2, damping_sign=+1, speed_floor=k.speed_floor,
            beta_floor=0.0 if k.beta == "minimum-norm" else None,
        ),
        guard=BETA_GUARD if with_beta else None,
    )  # fmt: skip
