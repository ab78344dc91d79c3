"""flypend's own form for GPUs, on the CPU."""

from __future__ import annotations

from typing import Any

from benchmarks.peers import Fly, Peer


def make(problem: Any, threads: int) -> Fly:
    """The JAX form of the kernel, dp5."""
    from flypend.flight.kernels.gpu import array_kernel
    from flypend.flight.kernels.ideal import MAX_STEPS

    kernel = array_kernel(problem.loop)
    return lambda starts, rtol: kernel.fly(starts, (problem.duration, rtol, rtol, MAX_STEPS)).final


PEER = Peer("flypend in JAX (CPU)", "the form for GPUs, dp5, all runs in step", make, 1024)
