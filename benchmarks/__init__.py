"""Side by side: flypend's kernels and what else could fly the same closed loop. `make bench` runs it."""
