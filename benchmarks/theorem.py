"""Does V fall along 100,000 flights? `python -m benchmarks.theorem LAW [runs] [seed]`, some minutes on two cores.

LAW is a row of `flypend theorem`: repaired, almost_global, or one of the laws that lack a part of the proof.
"""

import sys

from flypend.flight.metrics import wilson
from flypend.paper.descent import RISES, descend


def main():
    """Print how many flights converge, and the largest rise of V."""
    name = sys.argv[1] if len(sys.argv) > 1 else "repaired"
    runs, seed = (int(text) for text in (*sys.argv[2:4], *("100000", "4242")[len(sys.argv[2:4]) :]))
    found = descend(name, runs, seed)
    low, high = wilson(found.converged, found.runs)
    print(
        f"{name}: {found.converged} of {found.runs} converge (95 %: {low:.4%} to {high:.4%}), {found.ended} end early; "
        f"V rises by more than {RISES:g} V(0) in {found.rising}, at most by {found.worst_rise:.2g} V(0)"
    )


if __name__ == "__main__":
    main()
