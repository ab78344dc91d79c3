"""Code generation from scalar programs: LLVM kernels, C99 and JAX."""
