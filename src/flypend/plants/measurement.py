"""What the sensors and the air add, from normal numbers: the measured state, and gusts."""

from __future__ import annotations

import casadi as ca
import numpy as np

from flypend.geometry import hat, tangent_part, unit
from flypend.model import State
from flypend.model.state import SIZE
from flypend.plants.plant import Noise, Wind

# Of the numbers that one control tick draws, the first 18 are for the measurement and the next 6 for the gusts.
MEASUREMENT, GUSTS = slice(0, 18), slice(18, 24)


def measurement(noise: Noise) -> ca.Function:
    """(state (24,), draws (18,)) → the state as measured with `noise`, on the manifold, as a CasADi function."""
    packed, draws = ca.SX.sym("s", SIZE), ca.SX.sym("n", 18)
    s, draw = State.symbolic(packed), [draws[3 * i : 3 * i + 3] for i in range(6)]
    turn = noise.attitude * draw[2]
    angle = ca.norm_2(turn) + 1e-150  # 0/0 at a draw of exactly zero
    first, second = ca.sin(angle) / angle, 2 * (ca.sin(angle / 2) / angle) ** 2
    rotation = ca.SX.eye(3) + first * hat(turn) + second * hat(turn) @ hat(turn)
    y = unit(s.y + noise.y * tangent_part(s.y, draw[4]))
    measured = State(
        x=s.x + noise.x * draw[0],
        x_dot=s.x_dot + noise.x_dot * draw[1],
        R=s.R @ rotation,
        omega=s.omega + noise.omega * draw[3],
        y=y,
        y_dot=tangent_part(y, s.y_dot + noise.y_dot * draw[5]),
    )
    return ca.Function("measure", [packed, draws], [ca.cse(ca.densify(measured.packed()))])


def gusts(wind: Wind, period: float) -> ca.Function:
    """(gust (6,), draws (6,)) → the next gust and the force of `wind` on vehicle and bob (6,), N, as a CasADi function.

    A gust lasts for a control `period`, s.
    """
    gust, draws = ca.SX.sym("g", 6), ca.SX.sym("n", 6)
    sigma = np.repeat([wind.gust_on_vehicle, wind.gust_on_bob], 3)
    decay = float(np.exp(-period / wind.gust_time))
    following = decay * gust + np.sqrt(1 - decay**2) * sigma * draws
    return ca.Function("gusts", [gust, draws], [following, following + np.array([*wind.on_vehicle, *wind.on_bob])])
