"""From vehicle and law to programs: the closed loop as CasADi functions of (t, state)."""

from flypend.compile.closed_loop import ClosedLoop, close_loop

__all__ = ["ClosedLoop", "close_loop"]
