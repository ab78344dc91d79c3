"""Vehicle files as tables: what the package ships, and files on top of a base."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib import resources
from pathlib import Path
from typing import Any

from flypend import errors
from flypend.errors import InputError
from flypend.files.toml import read_toml


def vehicle_names() -> list[str]:
    """Names of the vehicles shipped with the package."""
    folder = resources.files("flypend") / "vehicles"
    return sorted(entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml"))


@contextmanager
def file_of(name: str | Path, folder: Path | None = None, field: str = "vehicle") -> Iterator[Path]:
    """Yield the file of the vehicle `name`, which stands in `field`; paths are from `folder`, default the current one.

    Raises InputError for an unknown name.
    """
    if isinstance(name, Path) or (isinstance(name, str) and name.endswith(".toml")):
        yield (folder or Path()) / name
        return
    errors.one_of(field, name, vehicle_names())
    with resources.as_file(resources.files("flypend") / "vehicles" / f"{name}.toml") as path:
        yield path


def on_base(table: Any, folder: Path, files: tuple[Path, ...] = (), field: str = "vehicle.base") -> dict[str, Any]:
    """Return the `table` of a vehicle on top of its base, if it has one. Raises InputError.

    Parameters
    ----------
    table : dict
        Fields of a vehicle, and `base`: the name of a vehicle, or a path from `folder`. Tables in it stand on
        those of the base.
    folder : Path
        Folder of the file that holds the table.
    files : tuple of Path
        The files read so far, each the base of the one before.
    field : str
        What `base` is called in messages.
    """
    if not isinstance(table, Mapping):
        raise InputError("vehicle", "a table", repr(table))
    chosen = dict(table)
    if "base" not in chosen:
        return chosen
    name = chosen.pop("base")
    with file_of(name, folder, field) as path:
        if path.resolve() in files:
            raise InputError(field, "a file that is not based on itself", str(name))
        own = on_base(read_toml(path), path.parent, (*files, path.resolve()))
    for key, entry in chosen.items():
        if isinstance(entry, Mapping) and isinstance(own.get(key), Mapping):
            chosen[key] = {**own[key], **entry}
    return own | chosen
