"""Machine code for the page, with which it shows at once what the server then confirms."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from flypend.flight.live import live_loop, tunable
from flypend.flight.live_engine import engine_facts
from flypend.lab.flying import MOST_STEPS
from flypend.lab.setting import Setting
from flypend.laws import BoundLaw
from flypend.pages.sliders import sliders_of


def engine_of(setting: Setting) -> dict[str, Any] | None:
    """Return what a page needs to fly settings like `setting` by itself; None for one that only the server flies.

    The page changes numbers of the plant and gains but those that are `fixed`: from these the law, which must be one of
    the package, computes others in advance.
    """
    law = setting.flight.law
    if setting.where or not isinstance(law, BoundLaw):
        return None
    fixed = set(sliders_of(law)) - set(tunable(law))
    exact = replace(setting.flight.tolerances, max_steps=MOST_STEPS)
    return engine_facts(live_loop(setting.flight), exact) | {"fixed": sorted(fixed)}
