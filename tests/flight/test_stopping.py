"""Every kernel call hears Ctrl-C and SIGTERM within half a second, however many runs it flies, and compilers too."""

import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

import flypend as fp
from flypend.flight.kernels.stopping import StoppedError, heard, interruptible, join
from flypend.signals.polling import call_in_thread
from tests.few import few

HEARD = 0.5  # s: what the user is promised
CALLS = {
    # Each takes minutes if it is not stopped; `start` is one start, `starts` three.
    "one run, sampled": "fp.simulate(vehicle, law, start, 19_000.0, times=[19_000.0])",
    "one run, ideal": "fp.simulate(vehicle, law, start, 19_000.0, plant='ideal', rtol=3e-14, times=[19_000.0])",
    "three runs, sampled": "fp.simulate_ensemble(vehicle, law, starts, 19_000.0, workers=1, judge_period=10.0)",
    "three runs, ideal": "fp.simulate_ensemble(vehicle, law, starts, 19_000.0, plant='ideal', rtol=3e-14, "
    "workers=2, judge_period=10.0)",
    "many runs, ideal": "fp.simulate_ensemble(vehicle, law, fp.random_starts(500, 1), 19_000.0, plant='ideal', "
    "rtol=3e-14, judge_period=10.0)",
    "tangents": "fp.sensitivity(vehicle, law, start, 19_000.0)",
}
CODE = """
import signal, sys, flypend as fp, numpy as np
signal.signal(signal.SIGINT, signal.default_int_handler)  # whoever runs the tests in the background ignores it
from flypend.laws.references import circle
vehicle, law = fp.vehicle("hehn2011"), fp.laws.inverted(circle(0.5, 1.0))
start, starts = fp.State(y=(0, 0, 1.0)), fp.State(y=np.tile([0.0, 0.0, 1.0], (3, 1)))
{warm}
print("ready", flush=True)
{call}
"""


def busy():
    """Seconds to allow for the end of a process with all its imports: twenty times the start of an empty one."""
    begin = time.monotonic()
    subprocess.run([sys.executable, "-c", "pass"], check=True)
    return 20 * (time.monotonic() - begin)


def told_after(process, number, wait):
    """Send a signal `wait` seconds after the process is ready, and return the seconds until it ends."""
    assert process.stdout.readline() == "ready\n"
    time.sleep(wait)
    assert process.poll() is None, "it ended by itself"
    sent = time.monotonic()
    process.send_signal(number)
    process.wait(60)
    return time.monotonic() - sent


@pytest.mark.parametrize("count", [1, 2, 3])
def test_another_thread_makes_all_calls(count):
    made = []
    calls = [lambda word, number=number: made.append(number) for number in range(count)]
    with ThreadPoolExecutor(1) as pool:
        pool.submit(heard, calls).result()
    assert sorted(made) == list(range(count))


@pytest.mark.parametrize(
    "name", few(("one run, sampled", "three runs, sampled", "many runs, ideal", "tangents"), CALLS)
)
def test_an_interrupt_ends_a_call_from_the_main_thread(name):
    call = CALLS[name]
    warm = call.replace("19_000.0", "1.0").replace("10.0", "0.5")
    command = [sys.executable, "-c", CODE.format(warm=warm, call=call)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        took = told_after(process, signal.SIGINT, 0.3)
        assert "KeyboardInterrupt" in process.stderr.read()
    assert took < HEARD + busy()


# A compiler that takes three times as long as it does, so that a signal certainly comes while it works.
SLOW = """
import signal, sys
from flypend.compile.llvm import jit
signal.signal(signal.SIGINT, signal.default_int_handler)
compile_module = jit.compile_module
def slowly(*given):
    print("ready", flush=True)
    return [compile_module(*given) for _ in range(3)][-1]
jit.compile_module = slowly
"""
AS_COMMAND = (
    SLOW
    + """
from flypend.cli import main
sys.argv = ["flypend", "run", "1", "--no-figures", "-o", sys.argv[1]]
main()
"""
)
AS_SCRIPT = (
    SLOW
    + """
import flypend as fp
try:
    fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, 1.0)), 1.0)
except KeyboardInterrupt:
    print("heard", flush=True)
"""
)


@pytest.fixture
def uncompiled(tmp_path, monkeypatch):
    """An empty cache of compiled code."""
    monkeypatch.setenv("FLYPEND_CACHE", str(tmp_path / "cache"))


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
@pytest.mark.usefixtures("uncompiled")
def test_a_command_that_compiles_ends_at_once(number, code, tmp_path):
    command = [sys.executable, "-c", AS_COMMAND, str(tmp_path / "out")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        took = told_after(process, number, 0.2)
        assert process.stderr.read() == {130: "flypend: interrupted\n", 143: "flypend: terminated\n"}[code]
    assert process.returncode == code
    assert took < HEARD + busy()
    assert {path.name for path in tmp_path.iterdir()} <= {"cache"}
    assert not list(tmp_path.rglob("*.partial"))


def heard_after(code):
    """Seconds until a process with this `code` says that it has heard SIGINT, which ends nothing else."""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        sent = time.monotonic()
        assert process.stdout.readline() == "heard\n"
        took = time.monotonic() - sent
        assert process.wait(60) == 0
    return took


@pytest.mark.usefixtures("uncompiled")
def test_a_script_that_compiles_hears_an_interrupt_at_once():
    """Its process ends when the compiler does, which would otherwise find its own memory gone."""
    assert heard_after(AS_SCRIPT) < HEARD


def test_what_is_called_aside_returns_and_raises_as_called():
    assert call_in_thread(lambda: 7) == 7
    with pytest.raises(ZeroDivisionError):
        call_in_thread(lambda: 1 // 0)


def test_what_was_stopped_is_not_believed():
    """A call in another thread that is stopped raises, and never returns its half-filled arrays."""
    vehicle, law, start, ends = fp.vehicle("hehn2011"), fp.laws.lqr(), fp.State(y=(0, 0, 1.0)), []

    def fly(word):
        try:
            with join(word):
                fp.simulate(vehicle, law, start, 19_000.0, times=[19_000.0])
        except StoppedError:
            ends.append("stopped")

    fp.simulate(vehicle, law, start, 1.0)  # compiled before
    with interruptible() as word:
        thread = threading.Thread(target=fly, args=(word,))
        thread.start()
        time.sleep(0.2)
        word[0] = 1
        thread.join(HEARD)
        assert not thread.is_alive()
    assert ends == ["stopped"]


def test_an_error_in_one_call_does_not_stop_the_next():
    with pytest.raises(ZeroDivisionError):
        heard([lambda _: 1 // 0])
    ran = []
    heard([lambda _: ran.append(1), lambda _: ran.append(2)])
    assert sorted(ran) == [1, 2]


def test_a_block_that_is_left_by_an_error_stops_what_runs_in_it():
    with pytest.raises(ValueError, match="left"), interruptible() as word:  # noqa: PT012
        with interruptible() as inner:
            assert inner is word
        raise ValueError("left")
    assert word[0] == 1
