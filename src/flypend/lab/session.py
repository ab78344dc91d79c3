"""The messages of one page: parsed, queued and answered. Only the latest request is answered."""

from __future__ import annotations

import asyncio
import json
import logging
import time
from collections.abc import Awaitable, Callable, Iterator
from concurrent.futures import Executor
from typing import Any

from flypend.errors import InputError
from flypend.lab.controls import sliders
from flypend.lab.export import python, toml
from flypend.lab.flying import fly, verdict
from flypend.lab.map import region
from flypend.lab.own import NONE, OwnLaws
from flypend.lab.setting import plain, setting_of
from flypend.lab.tuning import tuned
from flypend.pages import replay

log = logging.getLogger(__name__)
MOST_BRACKETS = 500  # a setting with many pokes has a hundred; thousands overflow the parser's stack
KINDS = ("fly", "map", "stop")
Send = Callable[[dict[str, Any]], Awaitable[Any]]
Tell = Callable[[], Any]


class Slot:
    """A queue of length one: while a request is in progress, only the latest new one is kept.

    `work(message, tell)` returns an iterator of replies, which a thread of `pool` advances one by one; a new message
    abandons it. `send` sends each reply.
    """

    def __init__(self, pool: Executor, work: Callable[[Any, Tell], Iterator[dict[str, Any]]], send: Send) -> None:
        self.pool, self.work, self.send = pool, work, send
        self.pending: Any = None
        self.task: asyncio.Task[None] | None = None

    def put(self, message: Any) -> None:
        """Queue `message` in place of any that waits."""
        self.pending = message
        if self.task is None or self.task.done():
            self.task = asyncio.get_running_loop().create_task(self._run())

    def drop(self) -> None:
        """Discard the waiting request, and abandon the one in progress after its current reply."""
        self.pending = False

    async def _run(self) -> None:
        while self.pending:
            message, self.pending = self.pending, None
            await self._answer(message)

    async def _answer(self, message: Any) -> None:
        loop = asyncio.get_running_loop()

        def tell() -> None:
            told = {"kind": "compiling", "number": message.get("number")}
            asyncio.run_coroutine_threadsafe(_ignore(self.send(told)), loop)

        replies = self.work(message, tell)
        while True:
            try:
                reply = await loop.run_in_executor(self.pool, next, replies, None)
            except Exception as error:  # the page needs a reply, and the server must survive for the others
                log.exception("a setting could not be flown")
                reason = f"{type(error).__name__}: {error}"
                await self.send(
                    refusal(InputError("setting", "one that can be computed", reason), message.get("number"))
                )
                return
            if reply is None or self.pending is False:
                return
            await self.send(reply)
            if self.pending is not None:
                return


async def _ignore(sent: Awaitable[Any]) -> None:
    await sent


def flights(message: Any, tell: Tell, own: OwnLaws = NONE) -> Iterator[dict[str, Any]]:
    """Yield the reply to "fly": the packed run, its verdict, the sliders, the start in numbers, and the exports.

    `own` are the custom laws.
    """
    begun = time.perf_counter()
    number = message.get("number")
    try:
        setting = setting_of(message.get("setting"), own)
        run = fly(setting, tell)
        machine = tuned(setting)
        yield {
            "kind": "flight",
            "number": number,
            "run": replay.pack(run),
            "verdict": verdict(run, machine),
            "sliders": sliders(setting),
            "start": plain(setting.start),
            "toml": toml(setting),
            "python": python(setting),
            "milliseconds": 1e3 * (time.perf_counter() - begun),
        }
    except InputError as error:
        yield refusal(error, number)


def maps(message: Any, tell: Tell, own: OwnLaws = NONE) -> Iterator[dict[str, Any]]:
    """Yield the replies to "map": chunks of the region of attraction; `own` are the custom laws."""
    number = message.get("number")
    try:
        for chunk in region(setting_of(message.get("setting"), own), tell):
            yield {"kind": "map", "number": number, **chunk}
    except InputError as error:
        yield refusal(error, number)


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
