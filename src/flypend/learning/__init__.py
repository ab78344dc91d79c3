"""Learning a law: flights through differentiable equations, and the gradient of what they cost."""

from flypend.learning.course import Course
from flypend.learning.training import Learner, Training

__all__ = ["Course", "Learner", "Training"]
