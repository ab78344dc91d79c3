"""The laboratory: a page in the browser whose sliders change a flight while it plays; `lab.server` serves it."""

from flypend.lab.standalone import lab_page

__all__ = ["lab_page"]
