"""The command line."""

import os

# The matrices here are 4 × 4, and kernels have threads of their own: threads of BLAS only take time to start.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from flypend.cli.app import main

__all__ = ["main"]
