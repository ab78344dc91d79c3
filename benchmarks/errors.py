"""How errors are spread over random starts, ours beside heyoka's own: `python -m benchmarks.errors`.

The reference is heyoka's Taylor series at 1e-15; errors are relative to 1 + |entry| of the final state.
"""

import numpy as np

from benchmarks.peers import a_flypend_dp5, b_flypend_dop853, f_heyoka_batch
from benchmarks.problem import Problem, errors

RUNS, TOLERANCES, MULTIPLES = 10_000, (1e-9, 1e-12), (10, 100, 1_000, 10_000, 100_000)


def main() -> None:
    """Print the share of runs within multiples of the tolerance."""
    problem = Problem()
    starts = problem.starts(RUNS, seed=8)
    heyoka = f_heyoka_batch.PEER.make(problem, 1)
    exact = heyoka(starts, 1e-15)
    heads = " | ".join(f"within {multiple:,}" for multiple in MULTIPLES)
    print(f"| tolerance | method | median error, in tolerances | {heads} |")
    print("|---" * (3 + len(MULTIPLES)) + "|")
    for tolerance in TOLERANCES:
        for peer in (b_flypend_dop853.PEER, a_flypend_dp5.PEER, f_heyoka_batch.PEER):
            fly = heyoka if peer is f_heyoka_batch.PEER else peer.make(problem, 1)
            found = errors(fly(starts, tolerance), exact) / tolerance
            shares = " | ".join(f"{100 * np.mean(found <= multiple):.2f} %" for multiple in MULTIPLES)
            print(f"| {tolerance:.0e} | {peer.name} | {np.median(found):.1f} | {shares} |")


if __name__ == "__main__":
    main()
