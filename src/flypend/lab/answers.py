"""Replies to the requests of a page: flights, maps and machine code."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from typing import Any

from flypend.errors import InputError
from flypend.flight.kernels.stopping import StoppedError
from flypend.flight.live import engine_facts, live_loop
from flypend.flight.verdict import verdict
from flypend.lab.controls import sliders
from flypend.lab.export import python, toml
from flypend.lab.flying import MOST_STEPS, fly, region
from flypend.lab.own import NONE, OwnLaws
from flypend.lab.setting import Setting, setting_of
from flypend.lab.tuning import Tell
from flypend.laws import BoundLaw
from flypend.pages import replay
from flypend.pages.offers import plain

log = logging.getLogger(__name__)
Replies = Iterator[dict[str, Any]]


def answer(message: Any, own: OwnLaws = NONE, tell: Tell = lambda: None) -> Replies:
    """Yield the replies to `message`, the last a refusal if it cannot be answered.

    `own` are the custom laws; `tell` is called before a compilation. Raises StoppedError if a kernel is stopped.
    """
    number = message.get("number")
    try:
        for reply in ANSWERS[message["kind"]](message, own, tell):
            yield {"number": number, **reply}
    except StoppedError:
        raise
    except InputError as error:
        yield refusal(error, number)
    except Exception as error:  # the page needs a reply
        log.exception("a setting could not be flown")
        reason = f"{type(error).__name__}: {error}"
        yield refusal(InputError("setting", "one that can be computed", reason), number)


def refusal(error: InputError, number: Any = None) -> dict[str, Any]:
    """Return the reply to a request that failed with `error`."""
    return {"kind": "error", "number": number, "field": error.field, "message": str(error)}


def _flight(message: Any, own: OwnLaws, tell: Tell) -> Replies:
    """Yield the packed run, its verdict, the sliders, and the start in numbers."""
    begun = time.perf_counter()
    setting = setting_of(message.get("setting"), own)
    run = fly(setting, tell)
    packed = replay.pack(run, verdict(run))
    yield {
        "kind": "flight",
        "run": packed,
        "verdict": packed["verdict"],
        "sliders": sliders(setting),
        "start": plain(setting.start),
        "milliseconds": 1e3 * (time.perf_counter() - begun),
    }


def _export(message: Any, own: OwnLaws, _: Tell) -> Replies:
    """Yield the setting as a run file and as Python."""
    setting = setting_of(message.get("setting"), own)
    yield {"kind": "export", "toml": toml(setting), "python": python(setting)}


def _map(message: Any, own: OwnLaws, tell: Tell) -> Replies:
    """Yield the region of attraction, chunk by chunk."""
    for chunk in region(setting_of(message.get("setting"), own), tell):
        yield {"kind": "map", **chunk}


def _engine(message: Any, own: OwnLaws, _: Tell) -> Replies:
    """Yield machine code with which the page flies settings like this one, and its sliders; None if it cannot."""
    facts, shown = None, None
    with suppress(InputError):
        setting = setting_of(message.get("setting"), own)
        facts, shown = engine_of(setting), sliders(setting)
    yield {"kind": "engine", "key": message.get("key"), "engine": facts, "sliders": shown}


# In the order in which a page needs them.
ANSWERS: dict[str, Callable[[Any, OwnLaws, Tell], Replies]] = {
    "fly": _flight, "engine": _engine, "export": _export, "map": _map,
}  # fmt: skip


def engine_of(setting: Setting) -> dict[str, Any] | None:
    """Return what a page needs to fly settings like `setting` by itself; None for one that only the server flies.

    The page changes numbers of the plant, and gains but those from which the law, which must be one of the package,
    computes others in advance.
    """
    law = setting.flight.law
    if setting.where or not isinstance(law, BoundLaw):
        return None
    exact = replace(setting.flight.tolerances, max_steps=MOST_STEPS)
    return engine_facts(live_loop(setting.flight), exact)
