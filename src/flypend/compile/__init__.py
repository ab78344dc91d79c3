"""Code generation from scalar programs: LLVM kernels and C99."""
