"""The law as C99 for a flight computer, its adapters, and the compiled law flown in the loop."""

from flypend.export.app import export_app
from flypend.export.library import compiled
from flypend.export.plan import export_nmpc, export_plan
from flypend.export.write import export_c

__all__ = ["compiled", "export_app", "export_c", "export_nmpc", "export_plan"]
