"""Machine code for the page, with which it shows at once what the server then confirms."""

from __future__ import annotations

from typing import Any

from flypend.flight.live import engine_facts, live_loop, tunable
from flypend.lab.setting import SYMBOLS, Setting
from flypend.laws import BoundLaw
from flypend.pages.sliders import sliders_of


def engine_of(setting: Setting) -> dict[str, Any] | None:
    """Return what a page needs to fly settings like `setting` by itself; None for one that only the server flies.

    The page changes gains and numbers of the plant. The law must be one of the package whose equations read all gains
    that have sliders, the plant a sampled one.
    """
    law = setting.flight.law
    with SYMBOLS:
        if setting.where or not isinstance(law, BoundLaw) or set(tunable(law)) != set(sliders_of(law)):
            return None
        return engine_facts(live_loop(setting.flight))
