"""Learning a law: flights through differentiable equations, and the gradient of what they cost."""
