"""The laboratory: a page on this machine in which a flight changes while one moves a slider."""

from flypend.lab.server import serve

__all__ = ["serve"]
