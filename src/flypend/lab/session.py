"""The messages of one page: parsed, queued and answered. Only the latest request is answered."""

from __future__ import annotations

import asyncio
import json
import logging
import math
import time
from collections.abc import Awaitable, Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from threading import Lock
from typing import Any

from flypend.errors import InputError
from flypend.flight.verdict import verdict
from flypend.lab.budget import Abandoned
from flypend.lab.controls import sliders
from flypend.lab.engine import engine_of
from flypend.lab.export import python, toml
from flypend.lab.flying import fly
from flypend.lab.map import region
from flypend.lab.own import NONE, OwnLaws
from flypend.lab.setting import setting_of
from flypend.lab.tuning import tuned
from flypend.pages import replay
from flypend.pages.starts import plain

log = logging.getLogger(__name__)
MOST_BRACKETS = 500  # a setting with many pokes has a hundred; thousands overflow the parser's stack
KINDS = ("fly", "map", "engine", "stop")
LATELY = 5.0  # s
GREEDY = 0.5  # s of processor time within about LATELY; a usual flight takes 0.03 s
Send = Callable[[dict[str, Any]], Awaitable[Any]]
Tell = Callable[[], Any]
Wanted = Callable[[], bool]
Work = Callable[..., Iterator[dict[str, Any]]]  # (message, tell, wanted=)


def _always() -> bool:
    return True


@dataclass
class Lanes:
    """Threads for answers: `quick`, and `slow` for pages that have lately taken much processor time.

    Such pages wait for each other, and keep nobody else waiting.
    """

    quick: Executor
    slow: Executor


class Slot:
    """A queue of length one: only the latest request is kept until a thread takes it up.

    `work(message, tell, wanted=)` returns an iterator of replies, which a thread of `lanes` advances one by one; a new
    message abandons it. `wanted()` says whether anybody waits. `send` sends each reply.
    """

    def __init__(self, lanes: Lanes, work: Work, send: Send) -> None:
        self.lanes, self.work, self.send = lanes, work, send
        self.load, self.noted = 0.0, time.monotonic()  # processor time taken lately, s, as of then
        self.pending: Any = None
        self.dropped = False
        self.task: asyncio.Task[None] | None = None
        self._message: Any = None  # in progress, with its replies
        self._replies: Iterator[dict[str, Any]] | None = None
        self._lock = Lock()

    def put(self, message: Any) -> None:
        """Queue `message` in place of any that waits."""
        with self._lock:
            self.pending, self.dropped = message, False
        if self.task is None or self.task.done():
            self.task = asyncio.get_running_loop().create_task(self._run())

    def drop(self) -> None:
        """Discard the waiting request, and abandon the one in progress."""
        with self._lock:
            self.pending, self.dropped = None, True

    async def _run(self) -> None:
        while self.pending is not None:
            self._replies = None
            await self._answer()

    async def _answer(self) -> None:
        """Answer the request that is the latest when a thread is free: reply by reply, until another one comes."""
        loop = asyncio.get_running_loop()
        while self.pending is None or self._replies is None:
            try:
                reply = await loop.run_in_executor(self._lane(), self._advance, loop)
            except Abandoned:
                return
            except Exception as error:  # the page needs a reply, and the server must survive for the others
                log.exception("a setting could not be flown")
                reason = f"{type(error).__name__}: {error}"
                refused = InputError("setting", "one that can be computed", reason)
                await self.send(refusal(refused, self._message.get("number")))
                return
            if reply is None or self.dropped:
                return
            await self.send(reply)

    def _lane(self) -> Executor:
        """Return the threads for the next reply; what the page took fades with LATELY."""
        now = time.monotonic()
        self.load, self.noted = self.load * math.exp((self.noted - now) / LATELY), now
        return self.lanes.slow if self.load > GREEDY else self.lanes.quick

    def _advance(self, loop: asyncio.AbstractEventLoop) -> dict[str, Any] | None:
        """Take up the latest request, unless one is in progress, and return its next reply; None at the end."""
        with self._lock:
            if self.dropped:
                return None
            if self._replies is None:
                self._message, self.pending = self.pending, None
                self._replies = self.work(self._message, partial(self._tell, loop), wanted=lambda: not self.dropped)
        begun = time.thread_time()
        try:
            return next(self._replies, None)
        finally:
            self.load += time.thread_time() - begun

    def _tell(self, loop: asyncio.AbstractEventLoop) -> None:
        """Send "compiling", from a thread."""
        told = {"kind": "compiling", "number": self._message.get("number")}
        asyncio.run_coroutine_threadsafe(_ignore(self.send(told)), loop)


async def _ignore(sent: Awaitable[Any]) -> None:
    await sent


def flights(message: Any, tell: Tell, own: OwnLaws = NONE, wanted: Wanted = _always) -> Iterator[dict[str, Any]]:
    """Yield the reply to "fly": the packed run, its verdict, the sliders, the start in numbers, and the exports.

    `own` are the custom laws. Raises Abandoned once the flight is no longer `wanted`.
    """
    begun = time.perf_counter()
    number = message.get("number")
    try:
        setting = setting_of(message.get("setting"), own)
        run = fly(setting, tell, wanted)
        told = verdict(run, tuned(setting).criterion)
        yield {
            "kind": "flight",
            "number": number,
            "run": replay.pack(run, told),
            "verdict": told,
            "sliders": sliders(setting),
            "start": plain(setting.start),
            "toml": toml(setting),
            "python": python(setting),
            "milliseconds": 1e3 * (time.perf_counter() - begun),
        }
    except InputError as error:
        yield refusal(error, number)


def maps(message: Any, tell: Tell, own: OwnLaws = NONE, wanted: Wanted = _always) -> Iterator[dict[str, Any]]:
    """Yield the replies to "map": chunks of the region of attraction, while it is `wanted`; `own` as in `flights`."""
    number = message.get("number")
    try:
        for chunk in region(setting_of(message.get("setting"), own), tell, wanted):
            yield {"kind": "map", "number": number, **chunk}
    except InputError as error:
        yield refusal(error, number)


def engines(message: Any, tell: Tell, own: OwnLaws = NONE, wanted: Wanted = _always) -> Iterator[dict[str, Any]]:
    """Yield the reply to "engine": machine code with which the page flies settings like this one; None if it cannot."""
    number, key = message.get("number"), message.get("key")
    try:
        facts = engine_of(setting_of(message.get("setting"), own))
    except InputError:
        facts = None
    yield {"kind": "engine", "number": number, "key": key, "engine": facts}


def refusal(error: InputError, number: Any = None) -> dict[str, Any]:
    """Return the reply to a request that failed with `error`."""
    return {"kind": "error", "number": number, "field": error.field, "message": str(error)}


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
