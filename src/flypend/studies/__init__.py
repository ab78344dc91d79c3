"""Studies of many flights: laws compared from the same starts, and the ladder from the ideal plant to reality."""

from flypend.settings.laws import law_named
from flypend.studies.compare import Comparison, compare
from flypend.studies.ladder import Ladder, ladder
from flypend.studies.starts import paper_starts, random_starts

__all__ = ["Comparison", "Ladder", "compare", "ladder", "law_named", "paper_starts", "random_starts"]
