"""The laboratory: a page in the browser whose sliders change a flight while it plays; `lab.server` serves it."""

from flypend.lab.alone import page_alone

__all__ = ["page_alone"]
