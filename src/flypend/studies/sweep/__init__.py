"""Studies of up to 10⁷ flights, from a TOML file to a Zarr store, chunk by chunk; interrupted sweeps resume."""

from flypend.studies.sweep.run import sweep
from flypend.studies.sweep.study import Study, study

__all__ = ["Study", "study", "sweep"]
