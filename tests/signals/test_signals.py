"""What a script's handlers raise comes at a poll, not in the middle of what runs; commands have handlers of ours."""

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import Future
from pathlib import Path

import casadi as ca
import pytest

import flypend as fp
from flypend import signals
from flypend.signals import polling


class OwnError(Exception):
    """What a handler of a script raises."""


@pytest.fixture
def handlers():
    """Python's handler of SIGINT, which whoever runs the tests in the background ignores, and none for SIGTERM."""
    before = {number: signal.getsignal(number) for number in signals.NUMBERS}
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


def strike(number=signal.SIGINT):
    os.kill(os.getpid(), number)


def swallow():
    """What CasADi's wrapper does in vertcat: whatever a handler raises in it is gone."""
    with contextlib.suppress(BaseException):
        strike()


def test_casadi_still_swallows():
    """The reason for all this: once this fails, it may be gone."""
    assert Path(ca.__file__).with_name("casadi.py").read_text(encoding="utf-8").count("except:\n") > 10


@pytest.mark.usefixtures("handlers")
def test_an_interrupt_that_would_be_swallowed_comes_at_the_next_poll():
    swallow()  # lost
    ran = []
    with pytest.raises(KeyboardInterrupt), signals.defer():  # noqa: PT012
        swallow()
        ran.append("the block goes on")
        signals.poll()
        ran.append("never")
    assert ran == ["the block goes on"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    signals.poll()  # all is as before


@pytest.mark.usefixtures("handlers")
def test_an_interrupt_that_nothing_polls_comes_at_the_end_of_the_block_whatever_else_is_raised():
    with pytest.raises(KeyboardInterrupt), signals.defer():
        strike()
    with pytest.raises(KeyboardInterrupt), signals.defer():  # noqa: PT012
        strike()
        raise fp.InputError("pipe", "whole", "broken by the same signal")


@pytest.mark.usefixtures("handlers")
def test_a_second_interrupt_is_not_deferred():
    with pytest.raises(KeyboardInterrupt), signals.defer():  # noqa: PT012
        strike()
        with pytest.raises(KeyboardInterrupt):
            strike()


@pytest.mark.usefixtures("handlers")
def test_a_handler_of_a_script_keeps_its_meaning():
    heard = []

    def raises(number, frame):
        raise OwnError(number)

    signal.signal(signal.SIGTERM, raises)
    with pytest.raises(OwnError), signals.defer():  # noqa: PT012
        strike(signal.SIGTERM)
        signals.poll()
    signal.signal(signal.SIGTERM, lambda number, _: heard.append(number))
    with signals.defer():
        with signals.defer():
            strike(signal.SIGTERM)
        signals.poll()  # it wants nothing to stop
    assert heard == [signal.SIGTERM]


@pytest.mark.usefixtures("handlers")
def test_a_flight_step_by_step_is_stopped_at_its_tick_whatever_swallows():
    """The law strikes in a bare except, once: the interrupt would be lost, as in vertcat."""
    times = []

    def fly(t, state):
        times.append(t)
        if len(times) == 5:
            swallow()
        return fp.Wrench(5.0, (0.0, 0.0, 0.0))

    law = fp.Controller(name="hold", function=fly, rate=100.0)
    with pytest.raises(KeyboardInterrupt):
        fp.simulate(fp.vehicle("hehn2011"), law, fp.State(y=(0, 0, 1.0)), 10.0)
    assert 5 <= len(times) <= 6


@pytest.mark.usefixtures("handlers")
def test_other_threads_leave_handlers_alone():
    found = []

    def look():
        with signals.defer():
            found.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=look)
    thread.start()
    thread.join()
    assert found == [signal.default_int_handler]


@pytest.mark.usefixtures("handlers")
def test_waiting_for_a_call_and_for_a_program_polls():
    with pytest.raises(KeyboardInterrupt), signals.defer():  # noqa: PT012
        strike()
        polling.result_of(Future())  # never done
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt), signals.defer():  # noqa: PT012
        threading.Timer(0.3, strike).start()
        polling.run([sys.executable, "-c", "import time; time.sleep(60)"])
    assert time.monotonic() - begin < 30


def test_calls_that_are_done_at_once_come_in_their_order():
    calls = [Future() for _ in range(50)]
    for call in reversed(calls):
        call.set_result(None)
    assert list(polling.as_they_come(calls)) == calls


def test_a_program_is_run_as_by_subprocess():
    done = polling.run([sys.executable, "-c", "print('out'); import sys; sys.exit('err')"], text=True)
    assert (done.returncode, done.stdout, done.stderr) == (1, "out\n", "err\n")


def test_worker_processes_hear_no_interrupt_and_die_if_the_block_fails(monkeypatch):
    monkeypatch.setattr(polling, "IDLE", 0.5)
    with polling.processes(2) as submit:
        polling.result_of(submit(os.getpid))
    time.sleep(2)  # its workers have ended, and a pool of another size starts new ones
    with polling.processes(1) as submit:
        blocked = polling.result_of(submit(signal.pthread_sigmask, signal.SIG_BLOCK, []))
        worker = polling.result_of(submit(os.getpid))
        assert signal.SIGINT in blocked
        assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])
        os.kill(worker, signal.SIGINT)
        assert polling.result_of(submit(os.getpid)) == worker
    with pytest.raises(OwnError), polling.processes(1) as submit:  # noqa: PT012
        worker = polling.result_of(submit(os.getpid))
        for _ in range(50):
            submit(time.sleep, 60)
        raise OwnError
    with pytest.raises(ProcessLookupError):
        os.kill(worker, 0)


# The command line's handlers ------------------------------------------------------------------------------------------

INSTALLED = """
import os, signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)
from flypend import signals
signals.install()
signals.watch()
"""
STRIKE = "os.kill(os.getpid(), signal.SIGINT)\n"
# Holds the main thread, without the lock of the interpreter, in a call that no handler can end.
STUCK = """
import ctypes
lock, mutex = ctypes.CDLL(None).pthread_mutex_lock, ctypes.create_string_buffer(64)
print(flush=True)
lock(mutex), lock(mutex)
"""


def ended(code, *strikes):
    """Exit code, stderr and seconds of a process with INSTALLED and this `code`, struck when it prints a line."""
    command = [sys.executable, "-c", INSTALLED + code]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        process.stdout.readline()
        begin = time.monotonic()
        for number, wait in strikes:
            process.send_signal(number)
            time.sleep(wait)
        told = process.communicate(timeout=60)[1]
        return process.returncode, told, time.monotonic() - begin


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_poll_exits_with_the_code_of_the_signal_and_no_handler_raises(number, code):
    loop = "print(flush=True)\ntry:\n    while not signals.word[0]: pass\nexcept: print('raised', file=sys.stderr)\n"
    assert ended(loop + "signals.poll()", (number, 0.0))[:2] == (code, "")
    assert ended(loop + "import flypend.geometry", (number, 0.0))[:2] == (code, "")


def test_what_does_not_poll_is_ended_after_a_grace():
    code, told, took = ended("signals.PATIENCE = 2.0\n" + STUCK, (signal.SIGTERM, 0.0))
    assert (code, told) == (143, "flypend: terminated\n")
    assert took > 2.0
    busy = "print(flush=True)\nwhile time.process_time() < 60: pass\n"
    code, told, took = ended("signals.GRACE = 1.0\n" + busy, (signal.SIGTERM, 0.0))
    assert (code, told) == (143, "flypend: terminated\n")
    assert took > 1.0


def test_a_second_signal_ends_it_at_once_unless_it_is_an_echo():
    stuck = "signals.PATIENCE = 5.0\n" + STUCK
    code, told, took = ended(stuck, (signal.SIGINT, 2 * signals.ECHO), (signal.SIGINT, 0.0))
    assert (code, told) == (130, "flypend: interrupted\n")
    assert took < 5.0
    assert ended(stuck, (signal.SIGTERM, 0.1), (signal.SIGTERM, 0.0))[2] > 5.0


def test_what_has_polled_has_all_the_time_that_it_needs():
    cleaning = "try: signals.poll()\nexcept SystemExit: time.sleep(3)\n"
    code = "signals.PATIENCE = 1.0\nprint(flush=True)\nwhile not signals.word[0]: pass\n" + cleaning
    assert ended(code, (signal.SIGINT, 0.0))[0] == 0


def test_a_signal_that_is_ignored_stays_ignored():
    code = "import signal\nsignal.signal(signal.SIGINT, signal.SIG_IGN)\n" + INSTALLED.replace(
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n", ""
    )
    code += STRIKE + "time.sleep(0.2)\nsignals.poll()\n"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_the_core_imports_nothing_heavy():
    code = "import sys; import flypend.signals, flypend.cli; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"numpy", "casadi", "click", "rich", "subprocess", "concurrent.futures"} & set(done.stdout.split())
