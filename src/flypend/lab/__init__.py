"""The laboratory: a page in the browser whose sliders change a flight while it plays."""

from flypend import errors

errors.require("tornado", extra="lab", for_="lab")
from flypend.lab.server import serve  # noqa: E402  imports tornado

__all__ = ["serve"]
