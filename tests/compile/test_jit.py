"""The cache of compiled kernels: kept, checked, rebuilt, never in the way."""

import ctypes
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from llvmlite import ir

from flypend.compile.llvm import jit


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
    monkeypatch.setenv(jit.CACHE_VARIABLE, str(tmp_path / "kernels"))
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


def test_other_generators_have_other_entries(cache, monkeypatch):
    calls = []
    result("key", 2.0, calls)
    monkeypatch.setattr(jit, "source_digest", lambda: "of another version")
    result("key", 2.0, calls)
    assert calls == [2.0, 2.0]


def test_without_a_folder_that_can_be_written_it_works(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv(jit.CACHE_VARIABLE, str(tmp_path / "file" / "kernels"))
    calls = []
    assert result("key", 2.0, calls) == 3.0
    assert result("key", 2.0, calls) == 3.0
    assert calls == [2.0, 2.0]


def test_an_entry_of_another_kernel_under_this_name_is_refused(cache):
    calls = []
    result("key", 2.0, calls)
    (entry,) = cache.iterdir()
    result("another key", 4.0, calls)
    (other,) = set(cache.iterdir()) - {entry}
    other.rename(entry)
    assert result("key", 2.0, calls) == 3.0
    assert calls == [2.0, 4.0, 2.0]


PLACE = "import sys; from flypend.compile.llvm import jit; print(jit.cache_folder(), jit.cache_folder())"
NOBODY = "import pwd\ndef getpwuid(uid): raise KeyError(uid)\npwd.getpwuid = getpwuid\n"


def where(folder, code, **changed):
    """The cache folder of a process in `folder` with other variables, and what it says on stderr."""
    kept = {name: value for name, value in os.environ.items() if name not in (jit.CACHE_VARIABLE, "XDG_CACHE_HOME")}
    environment = {name: value for name, value in (kept | changed).items() if value is not None}
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=True)
    first, second = done.stdout.split()
    assert first == second
    return Path(first), done.stderr


@pytest.mark.parametrize("empty", ["", " ", "relative"])
def test_an_empty_cache_variable_is_not_the_current_folder(empty, tmp_path):
    path, told = where(tmp_path, PLACE, XDG_CACHE_HOME=empty, HOME=str(tmp_path / "home"))
    assert path == tmp_path / "home" / ".cache" / "flypend"
    assert told == ""


def test_without_a_home_the_cache_is_temporary_and_one_line_says_so(tmp_path):
    """As in a container under a number that nobody has: neither HOME nor an entry in the list of users."""
    path, told = where(tmp_path, NOBODY + PLACE, HOME=None)
    assert path.is_absolute()
    assert not path.is_relative_to(tmp_path)
    assert not path.exists()  # it went with the process
    assert told.count("\n") == 1
    assert jit.CACHE_VARIABLE in told
