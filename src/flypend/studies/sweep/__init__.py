"""Studies of up to 10⁷ flights: a TOML file in, a Zarr store out, chunk by chunk, to be stopped and continued."""

from flypend.studies.sweep.run import sweep
from flypend.studies.sweep.study import Study, study

__all__ = ["Study", "study", "sweep"]
