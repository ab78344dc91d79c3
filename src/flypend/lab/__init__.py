"""The laboratory: a page on this machine in which a flight changes while one moves a slider."""

from flypend import errors

errors.require("tornado", extra="lab", for_="lab")
from flypend.lab.server import serve  # noqa: E402  brings tornado

__all__ = ["serve"]
