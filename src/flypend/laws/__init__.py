"""Control laws. Each is a factory that accepts gains as keyword arguments and returns a `Law`.

A custom law is a Python function, `balance(t, state, vehicle, *, k_p=4.0) -> Wrench`: see `from_function`. To add a
Lyapunov function, a reference or a frame, build a `Law` directly.
"""

from typing import Any

from flypend.laws.almost_global import almost_global, almost_global_lag
from flypend.laws.bound import BoundLaw, Computer, Control, Guard
from flypend.laws.by_name import FACTORIES, law_from_dict, law_names
from flypend.laws.gain import Bounds, Gain
from flypend.laws.inverted import inverted
from flypend.laws.law import Law
from flypend.laws.law_error import LawError
from flypend.laws.learned import learned
from flypend.laws.lqr import lqr
from flypend.laws.own import Controller, from_function
from flypend.laws.repaired import repaired
from flypend.laws.supervised import supervised
from flypend.laws.theorem1 import corrected, printed
from flypend.laws.trained import trained
from flypend.registry import LAWS

AnyLaw = Law | BoundLaw | Controller

__all__ = [
    "AnyLaw",
    "BoundLaw",
    "Bounds",
    "Computer",
    "Control",
    "Controller",
    "Gain",
    "Guard",
    "Law",
    "LawError",
    "almost_global",
    "almost_global_lag",
    "corrected",
    "from_function",
    "inverted",
    "law_from_dict",
    "law_names",
    "learned",
    "lqr",
    "printed",
    "repaired",
    "supervised",
    "trained",
]

# A law that is in the registry alone is an attribute as well; those above are what type checkers see.
globals().update(FACTORIES)
__all__ += [name for name in FACTORIES if name not in __all__]


def __getattr__(name: str) -> Any:
    """Return a law that plans, `nmpc`, `track` or `plan_and_track`: planning stands on laws, and makes them."""
    if name not in LAWS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return LAWS[name]()


def __dir__() -> list[str]:
    return sorted({*__all__, *LAWS})
