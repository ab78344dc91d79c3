"""The signals of a law along a sampled flight, evaluated when somebody asks for them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.laws import BoundLaw
from flypend.laws.closed_loop import close_loop
from flypend.model import Vehicle


class Signals(Mapping[str, NDArray[np.float64]]):
    """Signals (n,) by name, computed on first access: writing the closed loop in symbols takes longer than a flight.

    Parameters
    ----------
    compute : callable
        Returns the signals as a dict.
    """

    def __init__(self, compute: Callable[[], dict[str, NDArray[np.float64]]]) -> None:
        self._compute = compute

    @cached_property
    def _values(self) -> dict[str, NDArray[np.float64]]:
        return self._compute()

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __reduce__(self) -> tuple[Any, ...]:
        """As a plain dict: CasADi's symbols cannot be pickled."""
        return dict, (dict(self),)


def signals_along(vehicle: Vehicle, law: BoundLaw, t: NDArray[np.float64], packed: NDArray[np.float64]) -> Signals:
    """The signals of `law` at times `t` (n,), s, and `packed` states (n, 24) in the frame of the law.

    Each is a function of time and state alone. A rate such as V_rate is the one along the ideal closed loop of
    `vehicle`, whose wrench acts as commanded; what V does under the plant that was flown, V itself shows.
    """

    def compute() -> dict[str, NDArray[np.float64]]:
        loop = close_loop(vehicle, law)
        values = np.array(loop.outputs(t[None], packed.T))[4:]
        return dict(zip(loop.signal_names, values, strict=True))

    return Signals(compute)
