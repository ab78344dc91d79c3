"""The cache of machine code: nothing that others can have written is run, it does not grow, it is never in the way."""

import errno
import os
import shutil
import stat
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import pytest

from flypend.compile import cache
from flypend.compile.cache import LIMIT_VARIABLE, VARIABLE, load, location, move, store, summarise
from flypend.errors import InputError

ENTRY, OTHER = "ab" * 32, "cd" * 32
STRANGER = 54321  # number of a user that is not us


@pytest.fixture(autouse=True)
def _first_warning():
    cache._warn.cache_clear()


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(tmp_path / "kernels"))
    return tmp_path / "kernels"


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A user without FLYPEND_CACHE; returns the folder of their cache."""
    monkeypatch.delenv(VARIABLE)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    return tmp_path / "cache" / "flypend" / "machine-code"


def give_away(path, monkeypatch):
    """Make `path` another user's; where only root may, os.fstat and os.stat say so."""
    if os.geteuid() == 0:
        os.chown(path, STRANGER, STRANGER)
        return
    inode = path.stat().st_ino
    for name in ("fstat", "stat"):
        real = getattr(os, name)

        def told(*given, real=real, **named):
            found = real(*given, **named)
            return os.stat_result((*found[:4], STRANGER, *found[5:])) if found.st_ino == inode else found

        monkeypatch.setattr(os, name, told)


def age(path, hours):
    """Make `path` look as if it had been used so many `hours` ago."""
    then = time.time() - 3600 * hours
    os.utime(path, (then, then))


# Entries --------------------------------------------------------------------------------------------------------------


def test_what_is_stored_is_loaded(folder):
    assert load(ENTRY) is None
    assert not folder.exists()  # reading makes nothing
    store(ENTRY, b"code")
    assert load(ENTRY) == b"code"
    assert load(OTHER) is None


def replaced(path, make):
    """Move the sound entry at `path` away, and `make(away, path)` something in its place."""
    away = path.with_name("elsewhere")
    path.rename(away)
    make(away, path)


ATTACKS = {
    "another user's": give_away,
    "writable by all": lambda path, _: path.chmod(0o646),
    "writable by the group": lambda path, _: path.chmod(0o660),
    "a link": lambda path, _: replaced(path, lambda away, here: here.symlink_to(away)),
    "a file with two names": lambda path, _: replaced(path, lambda away, here: here.hardlink_to(away)),
    "a pipe": lambda path, _: replaced(path, lambda _, here: os.mkfifo(here)),
}


@pytest.mark.parametrize("attack", ATTACKS.values(), ids=ATTACKS)
def test_an_entry_that_others_can_have_written_is_refused_in_one_line(folder, attack, monkeypatch, caplog):
    """Each holds a valid digest: only who may have written it tells."""
    for entry in (ENTRY, OTHER):
        store(entry, b"code")
        attack(folder / f"{entry}.o", monkeypatch)
        assert load(entry) is None
        (folder / "elsewhere").unlink(missing_ok=True)
    assert len(caplog.messages) == 1
    assert str(folder) in caplog.text
    store(ENTRY, b"mine")
    monkeypatch.undo()
    monkeypatch.setenv(VARIABLE, str(folder))
    assert load(ENTRY) == b"mine"
    assert stat.S_IMODE((folder / f"{ENTRY}.o").stat().st_mode) == 0o600


@pytest.mark.parametrize(
    "damage", [lambda code: code[:20], lambda code: code[:-1], lambda code: code + b"\0", lambda _: b""]
)
def test_a_damaged_entry_is_not_loaded(folder, damage):
    store(ENTRY, b"code")
    path = folder / f"{ENTRY}.o"
    path.write_bytes(damage(path.read_bytes()))
    assert load(ENTRY) is None


def test_an_entry_under_the_name_of_another_is_not_loaded(folder):
    store(ENTRY, b"code")
    (folder / f"{ENTRY}.o").rename(folder / f"{OTHER}.o")
    assert load(OTHER) is None


def test_a_folder_in_place_of_an_entry_is_no_error(folder):
    (folder / f"{ENTRY}.o").mkdir(parents=True)
    folder.chmod(0o700)
    assert load(ENTRY) is None
    store(ENTRY, b"code")
    assert load(ENTRY) is None
    assert [path.name for path in folder.iterdir()] == [f"{ENTRY}.o"]


# The folder -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("mask", [0o000, 0o002, 0o022, 0o077, 0o777])
def test_a_new_folder_is_private_whatever_the_umask(folder, mask):
    before = os.umask(mask)
    try:
        store(ENTRY, b"code")
    finally:
        os.umask(before)
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700


FOLDER_ATTACKS = {
    "another user's": give_away,
    "writable by all": lambda path, _: path.chmod(0o777),
    "writable by all, sticky": lambda path, _: path.chmod(0o1777),
    "writable by the group": lambda path, _: path.chmod(0o770),
}


@pytest.mark.parametrize("attack", FOLDER_ATTACKS.values(), ids=FOLDER_ATTACKS)
@pytest.mark.parametrize("named_by", ["variable", "settings", "nothing"])
def test_a_folder_that_others_may_write_to_is_refused(named_by, attack, tmp_path, home, monkeypatch):
    path, field = home, str(home)
    if named_by != "nothing":
        path = tmp_path / "named"
    if named_by == "variable":
        field = VARIABLE
        monkeypatch.setenv(VARIABLE, str(path))
    if named_by == "settings":
        move(path)
        field = str(tmp_path / "config" / "flypend" / "config.toml")
    store(ENTRY, b"code")
    assert load(ENTRY) == b"code"
    attack(path, monkeypatch)
    for refused in (lambda: load(ENTRY), lambda: store(OTHER, b"code"), summarise, lambda: summarise(clear=True)):
        with pytest.raises(InputError) as error:
            refused()
        assert error.value.field == field
        assert str(path) in error.value.got
    assert [file.name for file in path.iterdir()] == [f"{ENTRY}.o"]


def test_a_folder_that_others_may_read_is_used(folder):
    folder.mkdir(0o755)
    store(ENTRY, b"code")
    assert load(ENTRY) == b"code"


def test_a_link_to_a_private_folder_is_followed_and_what_it_leads_to_is_checked(folder, tmp_path):
    """As from a home folder to a larger disk."""
    real = tmp_path / "large"
    real.mkdir(0o700)
    folder.symlink_to(real)
    store(ENTRY, b"code")
    assert load(ENTRY) == b"code"
    real.chmod(0o777)
    with pytest.raises(InputError):
        load(ENTRY)


def as_stranger(code, *, argument):
    """Run Python `code` as another user, with sys.argv[1] = `argument`."""
    become = f"import os; os.setgroups([]); os.setgid({STRANGER}); os.setuid({STRANGER})\n"
    subprocess.run([sys.executable, "-c", become + code, str(argument)], check=True)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may become another user")
def test_what_another_user_left_in_an_open_folder_is_not_run_once_it_is_closed(monkeypatch, caplog):
    """The attack on version 0.2: a valid digest, written by anybody, ran as root."""
    with tempfile.TemporaryDirectory() as open_:
        folder = Path(open_) / "kernels"
        folder.mkdir()
        folder.chmod(0o777)
        Path(open_).chmod(0o755)
        monkeypatch.setenv(VARIABLE, str(folder))
        content = cache._digest(ENTRY, b"theirs") + b"theirs"
        as_stranger(f"import sys; open(sys.argv[1], 'wb').write({content!r})", argument=folder / f"{ENTRY}.o")
        with pytest.raises(InputError):
            load(ENTRY)
        folder.chmod(0o700)
        assert load(ENTRY) is None
        assert len(caplog.messages) == 1


@pytest.mark.skipif(not shutil.which("setpriv"), reason="util-linux")
@pytest.mark.parametrize("mode", [0o000, 0o500])
def test_a_closed_folder_of_ours_is_no_error(mode, tmp_path):
    """As a user for whom modes count, which root is not."""
    code = f"""
import os
from pathlib import Path
folder = Path(os.environ["{VARIABLE}"])
folder.mkdir(0o700)
folder.chmod({mode})
from flypend.compile.cache import load, store
store("{ENTRY}", b"code")
assert load("{ENTRY}") is None
folder.chmod(0o700)
"""
    environment = os.environ | {VARIABLE: str(tmp_path / "kernels")}
    plain = ["setpriv", "--bounding-set=-all", "--inh-caps=-all"] if os.geteuid() == 0 else []
    done = subprocess.run([*plain, sys.executable, "-c", code], env=environment, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")


def test_a_full_disk_keeps_nothing_and_is_no_error(folder, monkeypatch):
    store(ENTRY, b"code")

    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as broken:
        broken.setattr(os, "replace", full)
        store(OTHER, b"code")
    assert load(OTHER) is None
    assert load(ENTRY) == b"code"
    assert [path.name for path in folder.iterdir()] == [f"{ENTRY}.o"]


def test_a_quota_that_ends_in_a_file_keeps_nothing_and_is_no_error(folder):
    code = f"""
import resource
from flypend.compile.cache import load, store
resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000))
store("{ENTRY}", bytes(20_000))
assert load("{ENTRY}") is None
"""
    subprocess.run([sys.executable, "-c", code], check=True)
    assert list(folder.iterdir()) == []


def test_a_folder_that_is_removed_meanwhile_is_made_again(folder):
    gone = threading.Event()

    def remove():
        while not gone.is_set():
            shutil.rmtree(folder, ignore_errors=True)

    thread = threading.Thread(target=remove)
    thread.start()
    try:
        for i in range(300):
            store(ENTRY, b"code %d" % i)
            # What was stored before may be there: a file in a folder that is being removed may not be replaced.
            assert load(ENTRY) in (None, *(b"code %d" % j for j in range(i + 1)))
    finally:
        gone.set()
        thread.join()
    store(ENTRY, b"code")
    assert load(ENTRY) == b"code"


# Size -----------------------------------------------------------------------------------------------------------------


def entry(i):
    return f"{i:064x}"


def test_the_least_recently_used_entries_leave(folder, monkeypatch):
    monkeypatch.setenv(LIMIT_VARIABLE, "0.01")  # MB
    for i in range(9):
        store(entry(i), bytes(1000))
        age(folder / f"{entry(i)}.o", 20 - i)
    assert load(entry(0)) is not None  # now it is the youngest
    store(entry(9), bytes(1000))  # ten, with their digests, are 10,490 bytes
    assert {i for i in range(10) if (folder / f"{entry(i)}.o").exists()} == {0, 3, 4, 5, 6, 7, 8, 9}
    assert summarise().size <= 0.9 * 10_000


def test_without_pressure_nothing_leaves(folder):
    for i in range(50):
        store(entry(i), bytes(1000))
        age(folder / f"{entry(i)}.o", 10000)
    store(entry(50), bytes(1000))
    assert summarise().entries == 51


def test_files_of_others_stay_and_those_of_killed_processes_leave(folder, monkeypatch):
    monkeypatch.setenv(LIMIT_VARIABLE, "0.001")
    folder.mkdir(0o700)
    for name in ("thesis.pdf", "main.o", "tmp12345678.partial", "tmp87654321.partial"):
        (folder / name).write_bytes(bytes(2000))
        age(folder / name, 48)
    (folder / "tmp87654321.partial").touch()  # another process writes it
    (folder / f"{ENTRY}.o").symlink_to(folder / "thesis.pdf")
    store(OTHER, bytes(100))
    assert {path.name for path in folder.iterdir()} >= {"thesis.pdf", "main.o", "tmp87654321.partial", f"{OTHER}.o"}
    assert not (folder / "tmp12345678.partial").exists()
    summarise(clear=True)
    assert {path.name for path in folder.iterdir()} == {"thesis.pdf", "main.o"}


@pytest.mark.parametrize("most", ["0", "0.0005"])
def test_what_is_larger_than_the_limit_is_not_stored(folder, most, monkeypatch):
    monkeypatch.setenv(LIMIT_VARIABLE, most)
    store(ENTRY, bytes(1000))
    assert not folder.exists()


@pytest.mark.parametrize("most", ["-1", "nan", "inf", "much", "1e400"])
def test_a_limit_that_is_no_size_is_refused(folder, most, monkeypatch):
    monkeypatch.setenv(LIMIT_VARIABLE, most)
    with pytest.raises(InputError) as error:
        load(ENTRY)  # before anything is compiled
    assert error.value.field == LIMIT_VARIABLE


CROWD = """
import random, sys
from flypend.compile.cache import load, store
random.seed(int(sys.argv[1]))
sys.stdin.readline()
hits = 0
for _ in range(int(sys.argv[2])):
    i = random.randrange(40)
    code, found = b"%d " % i * 200, load(f"{i:064x}")
    assert found in (None, code), i
    hits += found is not None
    if found is None:
        store(f"{i:064x}", code)
print(hits)
"""


def crowd(folder, processes, rounds):
    """Let `processes` share an empty cache that is too small; nothing is wrong, over the limit or left behind."""
    environment = os.environ | {VARIABLE: str(folder), LIMIT_VARIABLE: "0.012"}
    started = [
        subprocess.Popen(
            [sys.executable, "-c", CROWD, str(seed), str(rounds)], env=environment, stdin=subprocess.PIPE,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )
        for seed in range(processes)
    ]  # fmt: skip
    for process in started:  # together
        process.stdin.write("\n")
        process.stdin.flush()
    told = [process.communicate() for process in started]
    assert [process.returncode for process in started] == [0] * processes, told
    assert {said for _, said in told} == {""}
    hits = sum(int(found) for found, _ in told)
    assert 0 < hits < processes * rounds  # entries were used, and entries had left
    files = list(folder.iterdir())
    assert {path.suffix for path in files} == {".o"}
    assert sum(path.stat().st_size for path in files) <= 12_000
    return hits


def test_processes_share_an_empty_cache_that_is_too_small(tmp_path):
    crowd(tmp_path / "kernels", 6, 100)


@pytest.mark.slow
def test_150_processes_share_an_empty_cache_that_is_too_small(tmp_path):
    hits = crowd(tmp_path / "kernels", 150, 200)
    print(f"\n150 processes, 30000 calls: {hits} from the cache, none wrong")


# Where it is ----------------------------------------------------------------------------------------------------------

PLACE = "from flypend.compile.cache import location; print(location().folder, location().folder)"
NOBODY = "import pwd\ndef getpwuid(uid): raise KeyError(uid)\npwd.getpwuid = getpwuid\n"


def where(folder, code, **changed):
    """The cache folder of a process in `folder` with other variables, and what it says on stderr."""
    kept = {name: value for name, value in os.environ.items() if name not in (VARIABLE, "XDG_CACHE_HOME")}
    environment = {name: value for name, value in (kept | changed).items() if value is not None}
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=True)
    first, second = done.stdout.split()
    assert first == second
    return Path(first), done.stderr


@pytest.mark.parametrize("empty", ["", " ", "relative"])
def test_an_empty_cache_variable_is_not_the_current_folder(empty, tmp_path):
    path, told = where(tmp_path, PLACE, XDG_CACHE_HOME=empty, HOME=str(tmp_path / "home"))
    assert path == tmp_path / "home" / ".cache" / "flypend" / "machine-code"
    assert told == ""


def test_without_a_home_the_cache_is_temporary_and_one_line_says_so(tmp_path):
    """As in a container under a number that nobody has: neither HOME nor an entry in the list of users."""
    path, told = where(tmp_path, NOBODY + PLACE, HOME=None)
    assert path.is_absolute()
    assert not path.is_relative_to(tmp_path)
    assert not path.exists()  # it went with the process
    assert told.count("\n") == 1
    assert VARIABLE in told


def test_a_moved_cache_is_found_again_with_all_it_held(home, tmp_path):
    for i in range(3):
        store(entry(i), b"%d" % i)
        age(home / f"{entry(i)}.o", 10 - i)
    before = location()
    move(tmp_path / "new")
    assert location().folder == tmp_path / "new" != before.folder
    assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == 0o700
    assert [load(entry(i)) for i in range(3)] == [b"0", b"1", b"2"]
    assert not list(home.iterdir())
    used = [(tmp_path / "new" / f"{entry(i)}.o").stat().st_mtime_ns for i in range(3)]
    assert used == sorted(used)
    path, _ = where(tmp_path, PLACE, XDG_CONFIG_HOME=os.environ["XDG_CONFIG_HOME"])
    assert path == tmp_path / "new"
    move(tmp_path / "new")  # where it is: nothing is lost
    assert summarise().entries == 3


def test_a_cache_moves_out_of_a_folder_that_is_refused(home, tmp_path):
    """The way out of it; its entries stay behind."""
    store(ENTRY, b"code")
    home.chmod(0o777)
    move(tmp_path / "new")
    assert load(ENTRY) is None
    assert summarise().entries == 0


def test_the_variable_wins_and_a_move_beside_it_is_refused(home, tmp_path, monkeypatch):
    move(tmp_path / "new")
    monkeypatch.setenv(VARIABLE, str(tmp_path / "named"))
    assert location().folder == tmp_path / "named"
    with pytest.raises(InputError) as error:
        move(tmp_path / "other")
    assert error.value.field == VARIABLE
    assert not (tmp_path / "other").exists()


def test_a_move_to_where_it_cannot_be_changes_nothing(home, tmp_path, monkeypatch):
    store(ENTRY, b"code")
    (tmp_path / "file").touch()
    (tmp_path / "open").mkdir()
    (tmp_path / "open").chmod(0o777)
    for target in ("file", "open", "none/of/these"):
        with pytest.raises(InputError):
            move(tmp_path / target)
    assert load(ENTRY) == b"code"
    assert not list(tmp_path.glob("config/**/*.*"))


def test_a_move_that_cannot_be_noted_changes_nothing(home, tmp_path):
    store(ENTRY, b"code")
    (tmp_path / "config").touch()
    with pytest.raises(InputError):
        move(tmp_path / "new")
    assert load(ENTRY) == b"code"
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("text", ["cache = 3", "cache = 'relative'", "cash = '/tmp'", "cache =", "\0", ""])
def test_malformed_settings_are_one_line(home, tmp_path, text):
    settings = tmp_path / "config" / "flypend" / "config.toml"
    settings.parent.mkdir(parents=True)
    settings.write_text(text, encoding="utf-8")
    settings.chmod(0o600)
    with pytest.raises(InputError) as error:
        load(ENTRY)
    assert error.value.field.startswith(str(settings))


@pytest.mark.parametrize("attack", [give_away, lambda path, _: path.chmod(0o666)])
def test_settings_that_others_may_write_are_refused(home, tmp_path, attack, monkeypatch):
    move(tmp_path / "new")
    settings = tmp_path / "config" / "flypend" / "config.toml"
    attack(settings, monkeypatch)
    with pytest.raises(InputError) as error:
        load(ENTRY)
    assert error.value.field == str(settings)
    assert "that nobody else may write to" in error.value.expected
