"""Scalar programs as functions on JAX arrays, for GPUs."""
