"""A study, flown into its store; stopped in any way, it goes on where it was."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING, Any

from flypend import errors
from flypend.studies.sweep.chunk import fly_range, program_digest
from flypend.studies.sweep.cluster import flown_chunks
from flypend.studies.sweep.store import alone, opened, removed
from flypend.studies.sweep.study import Study
from flypend.studies.sweep.study import study as study_from

if TYPE_CHECKING:
    import xarray

Progress = Callable[[int, int], Any]


def sweep(
    study: Study | str | Path | Mapping[str, Any],
    store: str | Path,
    *,
    scheduler: str | None = None,
    workers: int | None = None,
    processes: bool = False,
    force: bool = False,
    progress: Progress = lambda *_: None,
) -> xarray.Dataset:
    """Fly a study into a Zarr store, and give the store as an `xarray.Dataset` that is read when it is asked.

    Stopped in any way, the same call goes on where it was, and the result is equal, to the last bit, to that of a call
    that was not stopped. A store that is finished is left as it is.

    Parameters
    ----------
    study : Study, path or dict
        What to fly: a TOML file or its content; docs/studies/studies.md lists the keys.
    store : path
        Ends in .zarr.
    scheduler : str, optional
        Address of a Dask scheduler, such as tcp://host:8786; default a cluster of this machine.
    workers : int, optional
        Cores of this machine to use; default all.
    processes : bool
        Whether this machine's cluster is made of processes. Threads are as fast, start sooner, and end with the caller.
    force : bool
        Whether to begin anew, whatever a sweep has left at `store`.
    progress : callable
        Told `(done, total)` runs.

    Raises
    ------
    InputError
        For a study that makes no sense, a store of another study (with the difference), one that cannot be written or
        that another sweep is writing, and a scheduler that does not answer.
    """
    for module in ("zarr", "xarray", "distributed", "scipy"):
        errors.require(module, extra="studies", for_="sweep")
    made = study if isinstance(study, Study) else study_from(study)
    if force:
        removed(store)
    like = fly_range(made, 0, 1)
    program = program_digest(made)
    kept = opened(store, made, program, versions(), like)
    with alone(kept):
        missing = [number for number in range(made.chunks) if not kept.whole(number, verify=True)]
        done = made.runs - sum(_length(made, number) for number in missing)
        progress(done, made.runs)
        if missing:
            flown = flown_chunks(
                made.text(), program, missing, scheduler=scheduler, workers=workers, processes=processes
            )
            for number, columns in flown:
                kept.write(number, columns)
                done += _length(made, number)
                progress(done, made.runs)
    return dataset(kept.path)


def _length(study: Study, number: int) -> int:
    return min(study.chunk, study.runs - number * study.chunk)


def dataset(path: str | Path) -> xarray.Dataset:
    """The store at `path` as an `xarray.Dataset`, its numbers read when they are asked for."""
    errors.require("xarray", extra="studies", for_="store")
    import xarray

    found: xarray.Dataset = xarray.open_zarr(path, chunks=None, consolidated=False)
    return found


def versions() -> dict[str, str]:
    """Versions of everything that the numbers of a run depend on."""
    return {name: metadata.version(name) for name in ("flypend", "casadi", "llvmlite", "numpy", "scipy")}
