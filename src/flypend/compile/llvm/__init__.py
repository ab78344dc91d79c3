"""Machine code via LLVM: SIMD lanes, kernels and the cache of compiled code."""
