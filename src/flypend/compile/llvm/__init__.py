"""Machine code through LLVM: vectors of lanes, kernels, and the cache of compiled code."""
