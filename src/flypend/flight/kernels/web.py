"""Sampled flights for web pages: the kernel of `flypend.flight.kernels.sampled` as a WebAssembly module."""

from __future__ import annotations

from dataclasses import replace

from llvmlite import ir

from flypend.compile.llvm import jit
from flypend.compile.llvm.sampled import write_kernel
from flypend.compile.llvm.target import wasm32
from flypend.compile.llvm.vector import Lanes
from flypend.compile.wasm import module
from flypend.flight.criterion import Criterion
from flypend.flight.kernels.sampled import sampled_problem, structure
from flypend.plants.loop import Loop


def web_kernel(loop: Loop, criterion: Criterion, width: int = 1) -> bytes:
    """Return a module whose function "kernel" flies `loop` and judges by `criterion`, compiled or from the cache.

    Its arguments are those of `flypend.compile.llvm.sampled`, in that order; `width` flights are flown at a time. The
    plant's lag, noise and wind are inputs, as in `SampledKernel`.

    Raises
    ------
    InputError
        If the law has operations that cannot be compiled.
    """
    problem = sampled_problem(replace(loop, plant=structure(loop.sampled)), criterion)

    def written() -> ir.Module:
        lanes = Lanes(ir.Module("flypend"), width, target=wasm32())
        write_kernel(lanes, problem)
        return lanes.module

    key = f"sampled, {width} lanes: {problem!r}"
    return module(jit.build_object(key, written, wasm32()), ["kernel"])
