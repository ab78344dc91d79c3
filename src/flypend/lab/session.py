"""The messages of one page: parsed, queued and answered. Only the latest request of a kind is answered."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable
from typing import Any

from flypend.errors import InputError
from flypend.lab.answers import ANSWERS, refusal
from flypend.lab.shares import Page, Shares
from flypend.lab.worker import COMPILING, END, GRACE, Worker, Workers, encode

MOST_BRACKETS = 500  # a setting with many pokes has a hundred; thousands overflow the parser's stack
KINDS = (*ANSWERS, "stop")
Send = Callable[[bytes], Awaitable[Any]]


class Slot:
    """Requests of one kind of a `page`: a queue of length one, in which the latest waits for a core.

    A newer request stops the one in progress. Of requests that are stopped without a reply, each has twice as long as
    the one before, so that something comes while a slider moves on. The page's job has the `rank` in `shares`. `send`
    sends each reply.
    """

    def __init__(self, page: Page, rank: int, shares: Shares, workers: Workers, send: Send) -> None:
        self._page, self._rank, self._shares, self._workers, self._send = page, rank, shares, workers, send
        self._pending: Any = None
        self._worker: Worker | None = None
        self._task: asyncio.Task[None] | None = None
        self._busy = self._stopped = self._dropped = False  # of the request in progress
        self._grace = GRACE

    def put(self, message: Any) -> None:
        """Queue `message` in place of any that waits."""
        self._pending = message
        self._stop(self._grace)
        if self._task is None or self._task.done():
            self._task = asyncio.get_running_loop().create_task(self._run())

    def drop(self) -> None:
        """Discard the waiting request, and stop the one in progress."""
        self._pending, self._dropped = None, True
        self._stop()

    def close(self) -> None:
        """End all work at once."""
        worker, self._worker, self._pending = self._worker, None, None
        if self._task is not None and not self._task.done():
            self._task.cancel()
            if worker is not None:
                worker.kill()
        elif worker is not None:
            self._workers.give(worker)

    def _stop(self, grace: float = 0.0) -> None:
        if self._worker is not None and self._busy and not self._stopped:
            self._stopped, self._grace = True, 2 * self._grace
            self._worker.stop(grace)

    async def _run(self) -> None:
        while self._pending is not None:
            try:
                self._worker = self._worker or await self._workers.take()
            except (OSError, EOFError) as error:  # no process, memory or socket left
                message, self._pending = self._pending, None
                lacking = InputError("setting", "a process that computes it", str(error))
                await self._send(encode(refusal(lacking, message.get("number"))))
                return
            if not await self._answer(self._worker):
                self._worker.kill()
                self._worker = None

    async def _answer(self, worker: Worker) -> bool:
        """Answer the request that is the latest when it has a core, and return whether `worker` lives."""
        message: Any = None
        while True:
            with self._shares.job(self._page, self._rank, worker.switch) as job:
                if message is None:
                    await job.begun.wait()
                    message, self._pending = self._pending, None
                    if message is None:
                        return True
                    worker.ask(message)
                    self._busy, self._stopped, self._dropped = True, False, False
                line = await worker.reply()
            self._busy = line not in (END, b"")
            if line == END:
                return True
            if not line and not self._stopped:
                line = encode(refusal(await worker.failure(), message.get("number")))
            if line and not self._dropped:
                self._grace = self._grace if line.startswith(COMPILING) else GRACE
                await self._send(line)
            if not self._busy:
                return False


def read(text: Any) -> dict[str, Any]:
    """Parse the message `text`. Raises InputError if it is not a valid message."""
    try:
        nested = isinstance(text, str) and text.count("[") + text.count("{") > MOST_BRACKETS
        message = json.loads(text) if isinstance(text, str) and not nested else None
    except ValueError:
        message = None
    if not isinstance(message, dict) or message.get("kind") not in KINDS:
        raise InputError("message", f"JSON with a kind among {', '.join(KINDS)}", repr(text)[:80])
    if not isinstance(message.get("number"), int | None):
        raise InputError("message.number", "an integer", repr(message["number"])[:80])
    return message
