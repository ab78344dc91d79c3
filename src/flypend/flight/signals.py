"""The signals of a law along a sampled flight, evaluated on demand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.laws import BoundLaw
from flypend.laws.closed_loop import close_loop, lyapunov_function, signal_names
from flypend.model import Vehicle


class Signals(Mapping[str, NDArray[np.float64]]):
    """Signals (n,) of `law` by name, computed on first access: building the closed loop takes longer than a flight.

    V is computed without the rest, whose rates take most of that time: it is all that a page asks for.

    Parameters
    ----------
    vehicle, law
        The ideal closed loop, along which rates such as V_rate are.
    t : (n,)
        Times, s.
    packed : (n, 24)
        States in the law's frame.
    """

    def __init__(self, vehicle: Vehicle, law: BoundLaw, t: NDArray[np.float64], packed: NDArray[np.float64]) -> None:
        self._vehicle, self._law, self._t, self._packed = vehicle, law, t, packed

    @cached_property
    def _names(self) -> tuple[str, ...]:
        return signal_names(self._vehicle, self._law)

    @cached_property
    def _lyapunov(self) -> NDArray[np.float64] | None:
        function = lyapunov_function(self._vehicle, self._law)
        return None if function is None else np.array(function(self._t[None], self._packed.T, []))[0]

    @cached_property
    def _values(self) -> dict[str, NDArray[np.float64]]:
        loop = close_loop(self._vehicle, self._law)
        values = np.array(loop.outputs(self._t[None], self._packed.T))[4:]
        return dict(zip(loop.signal_names, values, strict=True))

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        if name not in self._names:
            raise KeyError(name)
        if name == "V" and self._lyapunov is not None:
            return self._lyapunov
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle as a plain dict: CasADi symbols cannot be pickled."""
        return dict, (dict(self),)
