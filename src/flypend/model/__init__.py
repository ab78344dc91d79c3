"""The physics: a spherical pendulum whose pivot is the centre of mass of a quadrotor, on R³ × SO(3) × S².

Glossary (symbol in the paper, name in the code)
------------------------------------------------
M, m, l     `mass` of the quadrotor, `bob_mass`, `rod_length`; kg, kg, m
I           `inertia` of the quadrotor about its centre of mass, body frame; kg m²
x, ẋ        position and velocity of the pivot, world frame; m, m/s
R           rotation, body to world; z = R e₃ is the thrust axis
ω           `omega`, angular velocity in the body frame; rad/s
y, ẏ        unit vector from the pivot to the bob and its rate, world frame; –, 1/s
f, τ        `thrust` along z, N, and `moment` in the body frame, N m: together the `wrench`
e₃          third axis of the world frame: "up" (against gravity) or, as in the paper, "down" (along gravity)

In the e₃-up frame, f ≥ 0, y = e₃ is the inverted pose and y = −e₃ the hanging one. In the paper's e₃-down frame,
f ≤ 0 carries the vehicle, y = e₃ is the hanging pose, and the paper's moment μ enters as τ = −μ. Rotating both world
and body frame by π about e₁ converts between the two (`State.flipped`, `Wrench.flipped`).
"""

from flypend.model.by_name import vehicle
from flypend.model.dynamics import (
    Rates,
    bob_position,
    gravity_vector,
    kinetic_energy,
    lie_derivative,
    linear_momentum,
    potential_energy,
    rod_tension,
    total_energy,
)
from flypend.model.motion import Disturbance, disturbed_motion, equations_of_motion
from flypend.model.state import State, Wrench
from flypend.model.vehicle import Vehicle

__all__ = [
    "Disturbance",
    "Rates",
    "State",
    "Vehicle",
    "Wrench",
    "bob_position",
    "disturbed_motion",
    "equations_of_motion",
    "gravity_vector",
    "kinetic_energy",
    "lie_derivative",
    "linear_momentum",
    "potential_energy",
    "rod_tension",
    "total_energy",
    "vehicle",
]
