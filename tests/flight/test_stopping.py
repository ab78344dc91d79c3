"""Every kernel call hears Ctrl-C and SIGTERM within half a second, however many runs it flies."""

import signal
import subprocess
import sys
import threading
import time

import pytest

import flypend as fp
from flypend.flight.kernels.stopping import StoppedError, heard, interruptible, joined

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
    """Seconds to allow for the end of a process with all its imports: ten times what it takes to start an empty one."""
    begin = time.monotonic()
    subprocess.run([sys.executable, "-c", "pass"], check=True)
    return 10 * (time.monotonic() - begin)


def told_after(process, number, wait):
    """Send a signal `wait` seconds after the process is ready, and return the seconds until it ends."""
    assert process.stdout.readline() == "ready\n"
    time.sleep(wait)
    assert process.poll() is None, "it ended by itself"
    sent = time.monotonic()
    process.send_signal(number)
    process.wait(60)
    return time.monotonic() - sent


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_an_interrupt_ends_a_call_from_the_main_thread(call):
    warm = call.replace("19_000.0", "1.0").replace("10.0", "0.5")
    command = [sys.executable, "-c", CODE.format(warm=warm, call=call)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        took = told_after(process, signal.SIGINT, 0.3)
        assert "KeyboardInterrupt" in process.stderr.read()
    assert took < HEARD + busy()


def test_what_was_stopped_is_not_believed():
    """A call in another thread that is stopped raises, and never returns its half-filled arrays."""
    vehicle, law, start, ends = fp.vehicle("hehn2011"), fp.laws.lqr(), fp.State(y=(0, 0, 1.0)), []

    def fly(word):
        try:
            with joined(word):
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
