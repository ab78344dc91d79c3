"""Compiled kernels for a vehicle, a law and a plant: thousands of closed-loop runs per second on each core."""

from flypend.flight.kernels.ideal import IdealKernel, ideal_kernel
from flypend.flight.kernels.launch import fly_all, has_kernel, kernel_for, kernel_of
from flypend.flight.kernels.sampled import SampledKernel, plant_numbers, sampled_kernel, structure

__all__ = [
    "IdealKernel",
    "SampledKernel",
    "fly_all",
    "has_kernel",
    "ideal_kernel",
    "kernel_for",
    "kernel_of",
    "plant_numbers",
    "sampled_kernel",
    "structure",
]
