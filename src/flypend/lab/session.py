"""What happens with the messages of one page: the last one asked for is the one that is answered."""

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
MOST_BRACKETS = 500  # a setting with many pokes has a hundred; thousands exhaust the parser
KINDS = ("fly", "map", "stop")
Send = Callable[[dict[str, Any]], Awaitable[Any]]
Tell = Callable[[], Any]


class Slot:
    """Room for one piece of work: what comes while it is busy waits, and only the last that came is done next.

    `work(message, tell)` is an iterator of replies, made in a thread of `pool` one by one; it is dropped when another
    message comes. `send` takes each reply.
    """

    def __init__(self, pool: Executor, work: Callable[[Any, Tell], Iterator[dict[str, Any]]], send: Send) -> None:
        self.pool, self.work, self.send = pool, work, send
        self.pending: Any = None
        self.task: asyncio.Task[None] | None = None

    def put(self, message: Any) -> None:
        """Ask for `message`, instead of whatever waits."""
        self.pending = message
        if self.task is None or self.task.done():
            self.task = asyncio.get_running_loop().create_task(self._run())

    def drop(self) -> None:
        """Leave what waits, and what is under way as soon as its present piece is made."""
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
            except Exception as error:  # a page waits for an answer, and others for the server
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
    """The reply to "fly": the packed run, its verdict, the sliders, the start in numbers, and the exports.

    `own` are laws of one's own.
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
    """The replies to "map": chunks of the region of attraction; `own` are laws of one's own."""
    number = message.get("number")
    try:
        for chunk in region(setting_of(message.get("setting"), own), tell):
            yield {"kind": "map", "number": number, **chunk}
    except InputError as error:
        yield refusal(error, number)


def refusal(error: InputError, number: Any = None) -> dict[str, Any]:
    """The reply to what cannot be done."""
    return {"kind": "error", "number": number, "field": error.field, "message": str(error)}


def read(text: Any) -> dict[str, Any]:
    """The message in `text`. Raises InputError if it is none."""
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
