"""Compiled kernels for a vehicle, a law and a plant: thousands of closed-loop runs a second on every core."""

from flypend.flight.kernels.flown import STATUS, Flown
from flypend.flight.kernels.ideal import IdealKernel, ideal_kernel, method_for
from flypend.flight.kernels.sampled import SampledKernel, plant_numbers, sampled_kernel, structure

__all__ = [
    "STATUS",
    "Flown",
    "IdealKernel",
    "SampledKernel",
    "ideal_kernel",
    "method_for",
    "plant_numbers",
    "sampled_kernel",
    "structure",
]
