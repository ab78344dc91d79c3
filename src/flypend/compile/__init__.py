"""From programs to code: LLVM kernels, C99, and JAX."""
