"""The flight computers of planned flights: one that predicts for plans, and the law's own, to hand over to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from flypend.board.computer import SteppedBoard
from flypend.laws import BoundLaw
from flypend.plants.loop import Loop

# (time when the command acts (s), state (24,), rotor forces (n,), external forces (6,)) → command (n,), N; None: the
# law flies.
Planned = Callable[[float, Any, Any, Any], Any]


class Boards:
    """Two boards for one vehicle, of which each is told every measurement and every command, whoever gave it.

    So the law, when it takes over, flies as if it had always flown. Both find their delay if the law's does, and use
    the same estimator.

    Parameters
    ----------
    loop : Loop
        The closed loop of the law.
    latency : float
        Delay that the plans' board begins with, s.
    planned : callable
        What commands.
    rotors : (n,)
        Initial rotor forces, N.
    estimate : (24,), optional
        The state that an estimator begins with, e₃ up.

    Attributes
    ----------
    off : (3,)
        What is added to the position, m, that the law is shown.
    """

    def __init__(self, loop: Loop, latency: float, planned: Planned, rotors: Any, estimate: Any = None) -> None:
        by_plan = replace(loop, law=for_plans(loop.law, latency))
        self._for_plans = SteppedBoard(by_plan, rotors, estimate, self._steer)
        self._for_law = SteppedBoard(loop, rotors, estimate, self._or_law)
        self._planned, self.off = planned, np.zeros(3)

    def command(self, t: float, measured: Any) -> Any:
        """Return the command (n,), N, for the `measured` state (24,), e₃ up, or readings, at time `t` (s)."""
        self._measured = t, measured
        return self._for_plans.command(t, measured)

    def _steer(self, *predicted: Any) -> Any:
        self._given = self._planned(*predicted)
        return self._for_law.command(*self._measured)

    def _or_law(self, t: float, state: Any, rotors: Any, forces: Any) -> Any:
        if self._given is not None:
            return self._given
        shown = state.copy()
        shown[:3] += self.off
        return self._for_law.law(t, shown, rotors, forces)


@lru_cache(maxsize=16)
def for_plans(law: BoundLaw, latency: float) -> BoundLaw:
    """Return `law` on a board that predicts over a `latency` (s) and what it finds, but not over the rotors' lag."""
    return replace(law, computer=replace(law.computer, latency=latency, lead=1.0, models_lag=True))
