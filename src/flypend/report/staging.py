"""The folder of a report: see `flypend.staging`."""

from flypend.staging import check_writable, staged

__all__ = ["check_writable", "staged"]
