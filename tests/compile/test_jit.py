"""Machine code: compiled once, and again whenever anything that it depends on has changed."""

import ctypes
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from llvmlite import ir

import flypend
from flypend.compile.cache import VARIABLE
from flypend.compile.llvm import jit
from flypend.compile.llvm.target import native

SOURCE = Path(flypend.__file__).parent


def adder(number, calls):
    """Writes a module with a function that adds `number` to a double in memory; counts how often it is written."""

    def module():
        calls.append(number)
        made = ir.Module("adder")
        function = ir.Function(made, ir.FunctionType(ir.VoidType(), [ir.PointerType()]), "add")
        builder = ir.IRBuilder(function.append_basic_block())
        value = builder.load(function.args[0], typ=ir.DoubleType())
        builder.store(builder.fadd(value, ir.Constant(ir.DoubleType(), number)), function.args[0])
        builder.ret_void()
        return made

    return module


def result(key, number, calls):
    function = jit.build(key, adder(number, calls), "add", (ctypes.c_void_p,))
    value = np.array([1.0])
    function(value.ctypes.data)
    return value[0]


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(tmp_path / "kernels"))
    return tmp_path / "kernels"


def test_an_entry_is_written_once_and_used_again(cache):
    calls = []
    assert result("key", 2.0, calls) == 3.0
    (entry,) = cache.iterdir()
    assert entry.suffix == ".o"
    assert result("key", 99.0, calls) == 3.0  # the key determines the module
    assert calls == [2.0]


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: data[: len(data) // 2],
        lambda data: b"",
        lambda data: data[:-1] + bytes([data[-1] ^ 1]),
        lambda data: b"\x7fELF" + data,
        lambda data: data.replace(b"flypend", b"another"),
    ],
)
def test_a_damaged_entry_is_rebuilt_and_mended(cache, damage):
    calls = []
    result("key", 2.0, calls)
    (entry,) = cache.iterdir()
    sound = entry.read_bytes()
    entry.write_bytes(damage(sound))
    assert result("key", 2.0, calls) == 3.0
    assert calls == [2.0, 2.0]
    assert entry.read_bytes() == sound
    assert [path.name for path in cache.iterdir()] == [entry.name]  # nothing half-written stays


def test_another_program_has_another_entry(cache):
    calls = []
    assert result("key", 2.0, calls) == 3.0
    assert result("another key", 4.0, calls) == 5.0
    assert len(list(cache.iterdir())) == 2


def test_an_entry_of_another_kernel_under_this_name_is_refused(cache):
    calls = []
    result("key", 2.0, calls)
    (entry,) = cache.iterdir()
    result("another key", 4.0, calls)
    (other,) = set(cache.iterdir()) - {entry}
    other.rename(entry)
    assert result("key", 2.0, calls) == 3.0
    assert calls == [2.0, 4.0, 2.0]


def test_without_a_folder_that_can_be_written_it_works(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv(VARIABLE, str(tmp_path / "file" / "kernels"))
    calls = []
    assert result("key", 2.0, calls) == 3.0
    assert result("key", 2.0, calls) == 3.0
    assert calls == [2.0, 2.0]


# What the key covers --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("library", "name"), [("casadi", "__version__"), ("numpy", "__version__")])
def test_another_library_has_another_entry(cache, library, name, monkeypatch):
    calls = []
    result("key", 2.0, calls)
    monkeypatch.setattr(getattr(jit, library), name, "0.0.1")
    result("key", 2.0, calls)
    assert calls == [2.0, 2.0]


@pytest.mark.parametrize("part", ["llvmlite ", " llvm ", native().cpu])
def test_another_compiler_or_processor_has_another_entry(cache, part, monkeypatch):
    calls = []
    result("key", 2.0, calls)
    assert part in native().name
    monkeypatch.setitem(native().__dict__, "name", native().name.replace(part, f"{part}0"))
    result("key", 2.0, calls)
    assert calls == [2.0, 2.0]


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """A copy of the source, which stands for the one that this process runs."""
    folder = tmp_path / "flypend"
    shutil.copytree(SOURCE, folder, ignore=shutil.ignore_patterns("__pycache__", "web", "policies"))
    monkeypatch.setattr(jit, "_ROOT", folder)
    monkeypatch.setattr(jit, "__file__", str(folder / "compile" / "llvm" / "jit.py"))
    monkeypatch.setattr(jit, "_files", jit.source_files())
    monkeypatch.setattr(jit, "_source", jit.source_digest(jit.source_files()))
    return folder


def changed(path):
    """Exchange two bytes of the text at `path` that differ: its length stays."""
    text = bytearray(path.read_bytes())
    other = next(i for i, byte in enumerate(text) if byte != text[-2])
    text[other], text[-2] = text[-2], text[other]
    path.write_bytes(text)


WRITERS = (
    "__init__.py", "compile/tableaus.toml", "compile/methods.py", "compile/problem.py", "compile/routine.py",
    "compile/llvm/emit.py", "compile/loops/runge_kutta_8x64_p64.bc", "flight/kernels/ideal.py",
    "flight/kernels/pieces.py", "envs/kernel.py",
    "planning/solver.py", "plants/equations.py", "learning/flights.py", "model/state.py",
)  # fmt: skip


@pytest.mark.parametrize("name", WRITERS)
def test_every_source_that_writes_code_is_in_the_key(copy, name):
    changed(copy / name)
    assert jit.source_digest(jit.source_files()) != jit._source


def test_a_renamed_an_added_and_a_lost_source_are_in_the_key(copy):
    (copy / "compile" / "c99.py").rename(copy / "compile" / "c98.py")
    renamed = jit.source_digest(jit.source_files())
    (copy / "compile" / "new.py").touch()
    added = jit.source_digest(jit.source_files())
    (copy / "compile" / "c98.py").unlink()
    lost = jit.source_digest(jit.source_files())
    assert len({jit._source, renamed, added, lost}) == 4


def test_a_source_that_is_gone_or_cannot_be_read_is_no_error(copy, cache, monkeypatch):
    (copy / "compile" / ".#c99.py").symlink_to("somebody@somewhere")  # as Emacs locks a file
    assert jit.source_digest(jit.source_files()) == jit._source
    assert jit.source_digest(["/none.py"]) == ""
    monkeypatch.setattr(jit, "_source", "")
    assert result("key", 2.0, []) == 3.0
    assert not cache.exists()


def test_the_command_line_is_not_in_the_key(copy):
    """Whoever works on it need not compile again."""
    changed(copy / "cli" / "app.py")
    assert jit.source_digest(jit.source_files()) == jit._source


def test_a_process_whose_source_changes_leaves_the_cache_alone(copy, cache):
    calls = []
    result("key", 2.0, calls)
    result("key", 2.0, calls)
    assert calls == [2.0]
    changed(copy / "planning" / "solver.py")  # which this process may have imported, or may import now
    result("key", 2.0, calls)
    result("another key", 2.0, calls)
    assert calls == [2.0, 2.0, 2.0]
    assert len(list(cache.iterdir())) == 1


def test_source_that_changes_while_it_is_compiled_is_not_kept(copy, cache):
    def module():
        changed(copy / "compile" / "methods.py")
        return adder(2.0, [])()

    jit.build("key", module, "add", (ctypes.c_void_p,))
    assert not cache.exists()


def test_source_that_cannot_be_read_is_not_cached(cache, monkeypatch):
    """As in an archive, where all versions would have one key."""
    monkeypatch.setattr(jit, "_ROOT", Path("archive.zip/flypend"))
    monkeypatch.setattr(jit, "_files", jit.source_files())
    calls = []
    result("key", 2.0, calls)
    result("key", 2.0, calls)
    assert calls == [2.0, 2.0]
    assert not cache.exists()


FLIGHT = """
import flypend as fp
start = fp.State(y=(0.6, 0, 0.8), y_dot=(0, 1, 0))
run = fp.simulate(fp.vehicle("nayak2018"), fp.laws.corrected(), start, 0.5, plant="ideal")
print(repr(run.y[-1].tolist()))
"""


def test_a_changed_tableau_flies(tmp_path):
    """In one cache, as a developer has it."""
    shutil.copytree(SOURCE, tmp_path / "flypend", ignore=shutil.ignore_patterns("__pycache__"))
    tableaus = tmp_path / "flypend" / "compile" / "tableaus.toml"
    environment = os.environ | {"PYTHONPATH": str(tmp_path), VARIABLE: str(tmp_path / "kernels")}

    def flown():
        command = [sys.executable, "-c", FLIGHT]
        return subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True).stdout

    first = flown()
    text = tableaus.read_text(encoding="utf-8")
    tableaus.write_text(text.replace("[0.05260015195876773,", "[0.05270015195876773,"), encoding="utf-8")
    assert flown() != first
