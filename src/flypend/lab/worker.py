"""Processes that answer pages.

A request is Python, CasADi, LLVM, machine code and users' laws, most of which can neither be cut in pieces nor share an
interpreter fairly. A process can be paused anywhere, and killed.
"""

from __future__ import annotations

import asyncio
import json
import logging
import os
import signal
import socket
import time
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from multiprocessing import forkserver, get_context
from queue import SimpleQueue
from threading import Thread
from typing import Any, NamedTuple

import numpy as np

from flypend.errors import InputError
from flypend.flight.kernels.stopping import StoppedError, Word, join
from flypend.lab.answers import answer
from flypend.lab.own import OwnLaws

log = logging.getLogger(__name__)
GRACE = 0.1  # s of processor that a request has although there is a newer one: in a drag, flights are to be seen
LONGEST_REPLY = 2**26  # bytes
SPARES = 2  # idle processes kept for the next page; a reload finds its kernels in them
END = b"\n"  # after the replies to a request
COMPILING = b'{"kind":"compiling"'  # how a line begins that is no reply yet
_context: Any = get_context("forkserver")
_context.set_forkserver_preload([__name__])


def encode(reply: dict[str, Any]) -> bytes:
    """Return `reply` as a line of JSON. Raises ValueError if it has NaN."""
    return json.dumps(reply, allow_nan=False, separators=(",", ":")).encode() + b"\n"


class Limits(NamedTuple):
    """Processor time after which the system ends a process, s.

    Parameters
    ----------
    reply : float
        That one reply may take; the longest compilation of the package takes 5.
    stopping : float
        After a stop. Until then the process may end the request by itself, and keeps what it has compiled.
    """

    reply: float = 20.0
    stopping: float = 5.0


class Worker:
    """A process that answers one request at a time, as a server sees it."""

    def __init__(
        self, process: Any, limits: Limits, replies: asyncio.StreamReader, requests: asyncio.StreamWriter
    ) -> None:
        self.process, self._limits, self._replies, self._requests = process, limits, replies, requests

    @classmethod
    async def start(cls, own: OwnLaws, limits: Limits) -> Worker:
        """Start a process that flies the custom laws `own`, too."""
        ours, theirs = socket.socketpair()
        process = _context.Process(target=work, args=(theirs, own, limits), daemon=True)

        def begin() -> None:
            with theirs:
                process.start()

        try:
            await asyncio.to_thread(begin)
        except BaseException:  # cancelled, while the thread goes on: the process finds its channel closed, and ends
            ours.close()
            raise
        return cls(process, limits, *await asyncio.open_connection(sock=ours, limit=LONGEST_REPLY))

    def ask(self, message: dict[str, Any]) -> None:
        """Send a request, once the one before has ended."""
        self._requests.write(json.dumps(message).encode() + b"\n")  # NaN included, which settings refuse

    def stop(self, grace: float = 0.0) -> None:
        """End the present request once it has taken `grace` s of processor."""
        self.ask({"kind": "stop", "grace": grace})

    async def reply(self) -> bytes:
        """Return the next line: a reply, END, or nothing if the process has ended."""
        try:
            return await self._replies.readline()
        except ConnectionError:
            return b""

    def switch(self, on: bool) -> None:
        """Let the process run, or make it wait."""
        if self.process.is_alive():
            with suppress(ProcessLookupError):  # it may end meanwhile
                os.kill(self.process.pid, signal.SIGCONT if on else signal.SIGSTOP)

    def kill(self) -> None:
        """End the process at once."""
        self.process.kill()
        self._requests.close()

    async def failure(self) -> InputError:
        """Return why the process has ended."""
        await asyncio.to_thread(self.process.join)
        code = self.process.exitcode
        if code == -signal.SIGPROF:
            return InputError("flight", f"at most {self._limits.reply:g} s of processor time in the laboratory", "more")
        got = f"the end of its process by {signal.Signals(-code).name}" if code < 0 else f"exit code {code}"
        return InputError("setting", "one that can be computed", got)


class Workers:
    """The processes of a server whose custom laws are `own`."""

    def __init__(self, own: OwnLaws, limits: Limits | None = None) -> None:
        self._own, self._limits = own, limits or Limits()
        self._spare: list[Worker] = []

    async def take(self) -> Worker:
        """Return an idle process."""
        while self._spare:
            worker = self._spare.pop()
            if worker.process.is_alive():
                return worker
        return await Worker.start(self._own, self._limits)

    async def prepare(self) -> None:
        """Start an idle process, and before it the one that all are forked from, which takes a second."""
        self.give(await Worker.start(self._own, self._limits))

    def give(self, worker: Worker) -> None:
        """Take back an idle process."""
        self._spare.append(worker)
        if len(self._spare) > SPARES:
            self._spare.pop(0).kill()

    def close(self) -> None:
        """End the idle processes."""
        while self._spare:
            self._spare.pop().kill()


def work(channel: socket.socket, own: OwnLaws, limits: Limits) -> None:
    """Answer the requests that come through `channel`, until it is closed: the life of a worker.

    This thread reads, so that a stop is heard; another one answers.
    """
    # A group of its own hears no Ctrl-C. If the server is killed, the process that forks ends, unless another holds
    # the pipe that tells it so; the system then sends SIGHUP to the groups that it leaves with a paused process.
    os.setpgid(0, 0)
    os.close(forkserver._forkserver._forkserver_alive_fd)  # type: ignore[attr-defined]
    word: Word = np.zeros(1, dtype=np.int64)
    requests: SimpleQueue[dict[str, Any]] = SimpleQueue()

    def stop(*_: Any) -> None:
        word[0] = 1
        signal.setitimer(signal.ITIMER_PROF, limits.stopping)  # SIGPROF, which ends the process

    signal.signal(signal.SIGVTALRM, stop)
    answering = partial(_answer, channel=channel, word=word, own=own, seconds=limits.reply)
    Thread(target=_answer_all, args=(requests, answering, word), daemon=True).start()
    begun = 0.0
    for line in channel.makefile("rb"):
        message = json.loads(line)
        if message["kind"] == "stop":
            left = message["grace"] - (time.process_time() - begun)
            signal.setitimer(signal.ITIMER_VIRTUAL, max(left, 1e-6))
        else:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
            word[0], begun = 0, time.process_time()
            requests.put(message)
    os._exit(0)


def _answer_all(requests: SimpleQueue[dict[str, Any]], answering: Callable[[dict[str, Any]], None], word: Word) -> None:
    # Python handles signals in the main thread, which waits in a read unless the signal is delivered to it.
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGVTALRM])
    try:
        with join(word):
            while True:
                answering(requests.get())
    except OSError:  # the server has ended
        os._exit(0)
    except BaseException:  # a law that calls sys.exit, a reply with NaN
        log.exception("a setting could not be flown")
        os._exit(1)


def _answer(message: dict[str, Any], channel: socket.socket, word: Word, own: OwnLaws, seconds: float) -> None:
    """Send the replies to a `message` until a newer one has come, each within `seconds` of processor time."""

    def tell() -> None:
        channel.sendall(encode({"kind": "compiling", "number": message.get("number")}))

    with suppress(StoppedError):
        signal.setitimer(signal.ITIMER_PROF, seconds)
        for reply in answer(message, own, tell):
            channel.sendall(encode(reply))
            if word[0]:
                break
            signal.setitimer(signal.ITIMER_PROF, seconds)
    signal.setitimer(signal.ITIMER_PROF, 0)
    channel.sendall(END)
