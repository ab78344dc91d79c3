"""Theorem 1 with three defects mended: damping sign, speed floor, and beta dropped or regularised. No proof is left."""

from __future__ import annotations

from flypend import errors
from flypend.laws.law import Law
from flypend.laws.theorem1 import BETA_GUARD, theorem_1


def corrected(
    *,
    k_d: float = 1.0,
    k_1: float = 9.0,
    k_2: float = 4.0,
    speed_floor: float = 1e-2,
    beta: str = "off",
    beta_floor: float = 0.1,
    yaw_damping: float = 0.0,
) -> Law:
    """Theorem 1 with f_p = k_p e₃ − k_d ẏ, in the paper's frame: y = e₃ is the pose that hangs along gravity.

    The paper's five experiments converge under it, and so do most random starts, but not all: some run away, the rod
    spinning ever faster (docs/paper/errata.md, defect 9).

    Parameters
    ----------
    k_d, k_1, k_2 : float
        The paper's gains K: damping of the rod (1/s), stiffness (1/s²) and damping (1/s) of the thrust axis; > 0.
    speed_floor : float
        s in √(|ẏ|² + s²), which stands for |ẏ| in (kpeqn), rad/s; > 0 keeps the law differentiable at ẏ = 0.
    beta : "off" or "regularized"
        Without beta the law is a cascade, which 4 of 2,000 random starts do not survive. "regularized" divides by
        |v_e|² + beta_floor²; it is worse, and loses a quarter of them.
    beta_floor : float
        Floor of |v_e| in beta, 1/s. At 0 beta is the paper's minimum-norm solution, which is singular.
    yaw_damping : float
        Third component of I⁻¹mu, which (setmu) leaves free, per ω₃, 1/s; 0 takes that component zero.

    Raises
    ------
    InputError
        For a gain that is not positive, a floor out of range, or an unknown `beta`.
    """
    gains = {
        "k_d": errors.number("k_d", k_d, above=0, unit="1/s"),
        "k_1": errors.number("k_1", k_1, above=0, unit="1/s²"),
        "k_2": errors.number("k_2", k_2, above=0, unit="1/s"),
        "speed_floor": errors.number("speed_floor", speed_floor, above=0, unit="rad/s"),
        "beta": errors.one_of("beta", beta, ("off", "regularized")),
        "beta_floor": errors.number("beta_floor", beta_floor, at_least=0, unit="1/s"),
        "yaw_damping": errors.number("yaw_damping", yaw_damping, at_least=0, unit="1/s"),
    }
    singular = beta == "regularized" and beta_floor == 0
    return Law(
        name="corrected",
        e3="down",
        gains=gains,
        control=lambda t, state, vehicle, k: theorem_1(
            t, state, vehicle, k_d=k.k_d, k_1=k.k_1, k_2=k.k_2, damping_sign=-1, speed_floor=k.speed_floor,
            beta_floor=k.beta_floor if k.beta == "regularized" else None, yaw_damping=k.yaw_damping,
        ),
        guard=BETA_GUARD if singular else None,
    )  # fmt: skip
