"""Laws from user input: a name, `module:function`, `file.py:function`, or the table of a TOML file."""

from __future__ import annotations

import importlib
import os
import sys
import traceback
from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from pathlib import Path
from types import ModuleType
from typing import Any

from flypend.building import building
from flypend.errors import InputError, one_of, only_known
from flypend.laws import AnyLaw, BoundLaw, Controller, Law, law_from_dict, law_names
from flypend.laws.law_error import LawError, Located, relative_path
from flypend.laws.learned import learned, policy
from flypend.laws.own import EXPECTED as FUNCTION
from flypend.laws.own import from_function, is_factory
from flypend.laws.trained import trained
from flypend.model import Vehicle
from flypend.planning.constraints import FIELDS
from flypend.planning.receding_horizon import nmpc
from flypend.planning.tracking import plan_and_track
from flypend.planning.window import Window
from flypend.settings.expressions import EXPECTED as EXPRESSION
from flypend.settings.expressions import Expression

# Gains of the inverted law with a slow attitude loop and no rate feedforward: a negative control, meant to fail.
DETUNED = {"attitude_bandwidth": 12.0, "rate_feedforward": 0.0}
# What `law_named` takes beside the laws of the package and custom ones.
OTHERS = {
    "detuned": "the inverted law with a slow attitude loop and no rate feedforward: a negative control, meant to fail",
    "plan": "a plan from the start, tracked with feedback (planning.plan_and_track)",
    "nmpc": "plans, and replans in flight (planning.nmpc)",
}
# Files of a policy, trained elsewhere or by `flypend learn`.
ONNX, LEARNED = ".onnx", ".npz"
PLACE = "file.py:function, module:function or a file .onnx or .npz"
PLACES = ("function", "keep", "cost")  # entries of a law's table that name a function in a file or module
PLANNED = ("objective", "target")  # what the law "plan" has beside constraints
EXPECTED = f"a Law, a Controller, a function that makes one, or {FUNCTION}"


def law_from(value: Any, folder: Path | None = None, key: str = "law") -> Law | Controller:
    """Return the law that `value` specifies: itself, a name, `module:function`, `file.py:function`, or a table.

    A table has a name or function, gains, reference and e3. Gains and reference of "nmpc" are those of the inverted law
    that it falls back on; it has latency and computing of its own. "nmpc" and "plan" have the fields of `Constraints`:
    windows as tables of their fields, keep and cost as an expression, `file.py:function` or `module:function`. "plan"
    has an objective and a target as well. File paths are relative to `folder`, by default the current one.

    Raises InputError, for the field `key`, if anything is unknown or out of range, or a file or module fails to load.
    """
    if isinstance(value, Law | Controller):
        return value
    if isinstance(value, str):
        return law_named(value, folder, key)
    if not isinstance(value, Mapping):
        raise InputError(key, "the name of a law, or a table", repr(value))
    if value.get("name") == "plan":
        return plan_and_track(**plan_from(value, folder, key))
    if value.get("name") == "nmpc":
        only_known(key, value, ("name", "gains", "reference", "latency", "computing", *FIELDS))
        own = _constraints(value, folder, key) | {
            name: value[name] for name in ("latency", "computing") if name in value
        }
        rest = {name: entry for name, entry in value.items() if name not in own}
        return nmpc(otherwise=law_from_dict({**rest, "name": "inverted"}, key), **own)
    if not isinstance(value.get("gains", {}), Mapping):
        raise InputError(f"{key}.gains", "a table of gains", repr(value["gains"]))
    if value.get("name") == "detuned":
        named = law_from_dict({**value, "name": "inverted", "gains": {**DETUNED, **value.get("gains", {})}}, key)
        return replace(named, name="detuned")
    if "function" not in value:
        return law_from_dict(value, key)
    only_known(key, value, ("function", "gains", "e3"))
    where, gains = value["function"], value.get("gains", {})
    if not isinstance(where, str) or not _is_place(where):
        raise InputError(f"{key}.function", PLACE, repr(where))
    e3 = one_of(f"{key}.e3", value["e3"], ("up", "down")) if "e3" in value else None
    return _own(where, folder, f"{key}.function", e3).with_gains(gains, f"{key}.gains")


def law_named(name: str, folder: Path | None = None, key: str = "--law") -> Law | Controller:
    """Return the law called `name`: of the package, one of `OTHERS`, or a custom law.

    A custom law is `file.py:function`, with the path relative to `folder` (default the current one), or
    `module:function`; modules are also searched for in the current folder. The name must lead to a Law, a Controller,
    a function without arguments that returns one, or a function for `laws.from_function`. `policy.onnx` is a network in
    an ONNX file, for `laws.trained`, and `policy.npz` one of `flypend learn`. `key` is the field name for
    error messages.

    Raises InputError if there is no such law, or if it fails to load.
    """
    if _is_place(name):
        return _own(name, folder, key, None)
    if name.endswith(".py"):
        raise InputError(key, PLACE, repr(name))
    return law_from({"name": one_of(key, name, (*law_names(), *OTHERS))}, folder, key)


def plan_from(value: Mapping[str, Any], folder: Path | None = None, key: str = "law") -> dict[str, Any]:
    """Return the arguments of `plan` that `value`, the table of the law "plan", specifies. Raises InputError."""
    only_known(key, value, ("name", *PLANNED, *FIELDS))
    return _constraints(value, folder, key) | {name: value[name] for name in PLANNED if name in value}


def _constraints(value: Mapping[str, Any], folder: Path | None, key: str) -> dict[str, Any]:
    """Return the fields of `Constraints` in the table `value` of a law, as `nmpc` takes them. Raises InputError."""
    found = {name: entry for name, entry in value.items() if name in FIELDS}
    for name in PLACES:
        if name in found:
            found[name] = own_from(found[name], folder, name, f"{key}.{name}")
    if "window" in found:
        tables = [found["window"]] if isinstance(found["window"], Mapping) else found["window"]
        if not isinstance(tables, list) or not all(isinstance(each, Mapping) for each in tables):
            raise InputError(f"{key}.window", "a table with the fields of a Window, or several", repr(tables)[:80])
        for each in tables:
            only_known(f"{key}.window", each, (field.name for field in fields(Window)))
            missing = [name for name in ("centre", "width", "height") if name not in each]
            if missing:
                raise InputError(f"{key}.window", f"a {missing[0]}", repr(each)[:80])
        found["window"] = [Window(**each) for each in tables]
    return found


def own_from(value: Any, folder: Path | None, name: str, key: str) -> Any:
    """Return the field `name` of `Constraints`, "keep", "cost" or "path", that `value` specifies.

    It is `file.py:function` with a path relative to `folder`, `module:function` or, but for a path, an expression.
    Raises InputError, whose message begins with `key`.
    """
    if not isinstance(value, str):
        raise InputError(key, EXPRESSION, repr(value)[:80])
    if ":" in value or name == "path":
        return _attribute(value, folder, key, "a function")
    return Expression(value, key, name == "keep")


def absolute(value: Any, folder: Path) -> Any:
    """Return `value`, a law as in `law_from`, with its file path made absolute from `folder`, to save with results."""
    return _move_paths(value, lambda file: str((folder / file).resolve()))


def relative(value: Any, folder: Path) -> Any:
    """Return `value` with its file path relative to `folder`: the inverse of `absolute`, for a file to be moved along.

    A path on another drive stays absolute.
    """

    def moved(file: str) -> str:
        try:
            return Path(os.path.relpath(file, folder.resolve())).as_posix()
        except ValueError:
            return file

    return _move_paths(value, moved)


def drop_folders(value: Any) -> Any:
    """Return `value`, a law as in `law_from`, with its file path reduced to the file's name, to compare laws."""
    return _move_paths(value, lambda file: Path(file).name)


def _move_paths(value: Any, move: Callable[[str], str]) -> Any:
    """Return `value`, a law as in `law_from`, with `move` of its file paths in their place."""
    if isinstance(value, Mapping):
        moved = {name: _move_paths(value[name], move) for name in PLACES if name in value}
        if isinstance(gains := value.get("gains"), Mapping):  # of which one may be the file of a policy
            moved["gains"] = {name: _move_paths(gain, move) for name, gain in gains.items()}
        return {**value, **moved}
    file, attribute = split_place(value) if isinstance(value, str) else ("", "")
    return f"{move(file)}{attribute}" if file else value


def _is_place(name: str) -> bool:
    """Whether `name` says where a law is, and is not a law's name."""
    return ":" in name or name.endswith((ONNX, LEARNED))


def split_place(name: str) -> tuple[str, str]:
    """Return the file in `name`, "" if there is none, and what follows it."""
    if name.endswith((ONNX, LEARNED)):
        return name, ""
    file, colon, attribute = name.rpartition(":")
    return (file, f":{attribute}") if colon and file.endswith(".py") else ("", "")


def note(law: AnyLaw) -> str:
    """Return a one-line note if `law` cannot be compiled, else ""."""
    if not isinstance(law, Controller):
        return ""
    why = f": {law.because}" if law.because else ""
    return f"{law.name} is not written in symbols{why}. It flies step by step in Python, about a thousand times slower."


def describe_law(law: BoundLaw | Controller, vehicle: Vehicle) -> str:
    """Return the name of `law` with the gains that differ from their defaults for `vehicle`, at most four."""
    given = {name: value for name, value in law.gains.items() if value != law.table[name].value(vehicle)}
    shown = [f"{name} {value:g}" if isinstance(value, float) else f"{name} {value}" for name, value in given.items()]
    return ", ".join([law.name, *shown[:4], *(["…"] if len(shown) > 4 else [])])


def law_table(value: Any) -> dict[str, Any]:
    """Return the TOML table of the law `value`, a name or a table. Raises InputError."""
    if isinstance(value, str):
        return table_of(value)
    if not isinstance(value, dict):
        raise InputError("law", "the name of a law, or a table", repr(value))
    return dict(value)


def table_of(name: str) -> dict[str, Any]:
    """Return the TOML table that specifies the law `name`, as in `law_named`."""
    return {"function" if _is_place(name) or name.endswith(".py") else "name": name}


def _own(name: str, folder: Path | None, key: str, e3: Any) -> Law | Controller:
    """Return the law `name`, file.py:function, module:function or a policy; messages begin with `key`."""
    if name.endswith((ONNX, LEARNED)):
        if e3 is not None:
            raise InputError("law.e3", "nothing: a policy flies with e3 up", e3)
        path = (folder or Path.cwd()) / name
        if name.endswith(ONNX):
            return trained(path)
        policy(str(path))  # what is no policy is told now
        return replace(learned(policy=str(path)), name=path.stem)
    return _as_law(_attribute(name, folder, key, "a law"), name, key, e3)


def _attribute(name: str, folder: Path | None, key: str, what: str) -> Any:
    """Return what is called `name`, file.py:function or module:function; messages begin with `key` and want `what`."""
    source, _, attribute = name.rpartition(":")
    if not source or not attribute.isidentifier():
        raise InputError(key, "file.py:function or module:function", repr(name))
    module = _file(source, folder or Path.cwd(), key) if source.endswith(".py") else _module(source, key)
    if not hasattr(module, attribute):
        known = [word for word, value in vars(module).items() if not word.startswith("_") and _is_own(value, module)]
        if not known:
            raise InputError(key, f"{what} in {source}", f"{attribute!r}; the file or module defines none")
        one_of(key, attribute, known)
    return getattr(module, attribute)


def _is_own(value: Any, module: ModuleType) -> bool:
    return isinstance(value, Law | Controller) or getattr(value, "__module__", "") == module.__name__


def _as_law(found: Any, name: str, key: str, e3: Any) -> Law | Controller:
    """Return the law that `found`, called `name`, is or makes; messages begin with `key`."""
    if callable(found) and not isinstance(found, Law | Controller | BoundLaw) and not isinstance(found, type):
        try:
            if not is_factory(found):
                return from_function(found, e3=e3 or "up")
        except LawError:
            raise
        except InputError as error:
            raise InputError(key if error.field == "law" else error.field, error.expected, error.got) from None
        found = Located(found, name.rpartition(":")[2])()
    if e3 is not None:
        raise InputError("law.e3", f"nothing: {name} states its own", e3)
    if isinstance(found, Law | Controller):
        return found
    raise InputError(key, EXPECTED, f"{name!r}, which is none of these")


def _module(name: str, key: str) -> ModuleType:
    expected = "a module that can be imported"
    if not all(part.isidentifier() for part in name.split(".")):
        raise InputError(key, f"{expected}, or a file that ends in .py", repr(name))
    if str(Path.cwd()) not in sys.path:
        sys.path.insert(0, str(Path.cwd()))
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name and (name == error.name or name.startswith(f"{error.name}.")):
            raise InputError(key, expected, repr(name)) from None
        raise _load_error(error, name) from error
    except (Exception, SystemExit) as error:
        raise _load_error(error, name) from error


def _file(name: str, folder: Path, key: str) -> ModuleType:
    """Load the module in a file. It is kept out of `sys.modules`, so that its definitions are pickled by value."""
    path = (folder / name).resolve()
    if not path.is_file():
        raise InputError(key, "a file that is there", f"{name!r} in {folder}")
    if str(path.parent) not in sys.path:
        sys.path.append(str(path.parent))  # for its imports from the same folder
    title = f"flypend_law_{path.stem}"
    module = ModuleType(title)
    module.__file__ = str(path)
    with building:  # threads of a sweep load one file at once, and a law may load another
        sys.modules[title] = module  # the dataclass decorator looks its module up here
        try:  # reread every time: Python's bytecode cache would miss a second edit within one second
            exec(compile(path.read_bytes(), str(path), "exec"), module.__dict__)  # noqa: S102 (a law of the user's own)
        except (Exception, SystemExit) as error:
            raise _load_error(error, str(path)) from error
        finally:
            sys.modules.pop(title, None)  # a law that it loads may have the same stem
    return module


def _load_error(error: BaseException, name: str) -> LawError:
    """The one-line error for a file or module `name` that fails to load."""
    if isinstance(error, SyntaxError):
        line = f":{error.lineno}" if error.lineno else ""
        return LawError(f"{relative_path(error.filename or name)}{line}", "", f"{type(error).__name__}: {error.msg}")
    frames = [f for f in traceback.extract_tb(error.__traceback__) if "importlib" not in f.filename]
    own = [f for f in frames if f.filename != __file__]
    where = f"{relative_path(own[-1].filename)}:{own[-1].lineno}" if own else name
    return LawError(where, "", f"{type(error).__name__}: {error}")
