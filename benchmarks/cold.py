"""One run of one peer in a process of its own: `python -m benchmarks.cold c_generated_c 1e-7`."""

import sys

from benchmarks.peers import peer
from benchmarks.problem import Problem

if __name__ == "__main__":
    problem = Problem()
    final = peer(sys.argv[1]).make(problem, 1)(problem.starts(1), float(sys.argv[2]))
    print(final.shape)
