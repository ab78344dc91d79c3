"""The signals of a law along a sampled flight, evaluated on demand."""

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
    """Signals (n,) by name, computed on first access: building the symbolic closed loop takes longer than a flight.

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
        """Pickle as a plain dict: CasADi symbols cannot be pickled."""
        return dict, (dict(self),)


def signals_along(vehicle: Vehicle, law: BoundLaw, t: NDArray[np.float64], packed: NDArray[np.float64]) -> Signals:
    """Return the signals of `law` at times `t` (n,), s, and `packed` states (n, 24) in the law's frame.

    Each is a function of time and state alone. Rates such as V_rate are along the ideal closed loop of `vehicle`, where
    the wrench acts as commanded. Under the plant that was flown, V may change at a different rate.
    """

    def compute() -> dict[str, NDArray[np.float64]]:
        loop = close_loop(vehicle, law)
        values = np.array(loop.outputs(t[None], packed.T))[4:]
        return dict(zip(loop.signal_names, values, strict=True))

    return Signals(compute)
