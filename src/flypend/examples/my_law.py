"""A custom law: flypend compare --law examples/my_law.py:balance --law inverted --runs 20."""

from flypend import Wrench
from flypend.geometry import E3, cross


def balance(t, state, vehicle, *, k_y=2.9, k_y_dot=0.5, k_p=0.28, k_p_dot=0.47, stiffness=300.0, damping=30.0):
    """Balance small tilts; it does not swing up. `state` and the wrench are CasADi expressions, e₃ up, SI units."""
    p, p_dot = state.x + vehicle.l * (state.y - E3), state.x_dot + vehicle.l * state.y_dot
    lean = k_y * state.y + k_y_dot * state.y_dot + k_p * p + k_p_dot * p_dot
    z_d = E3 + lean - lean[2] * E3
    climb = 1 - 0.4 * state.x[2] - 0.5 * state.x_dot[2]
    error = state.R.T @ cross(state.z, z_d)
    return Wrench(vehicle.weight * climb, vehicle.I @ (stiffness * error - damping * state.omega))
