"""Measurement noise, wind gusts and knocks as functions of standard normal draws.

The noise and wind parameters are inputs of the functions, so one compiled flight serves all values.
"""

from __future__ import annotations

from dataclasses import astuple, fields

import casadi as ca
import numpy as np

from flypend.geometry import Numbers, Scalar, Vector, clip, tangent_part, unit
from flypend.model import State
from flypend.model.state import SIZE
from flypend.plants.cascade import rotation_by
from flypend.plants.noise import Noise
from flypend.plants.plant import Wind

# Each control tick draws 24 numbers: the first 18 are for the measurement, the other 6 for the gusts.
MEASUREMENT, GUSTS = slice(0, 18), slice(18, 24)
NEVER = -1e3  # a standard normal number is never below it
TINY = 1e-300  # keeps draws that are all zero, as without any randomness, from making NaN
NOISE_SIZE, WIND_SIZE = 6, 12
# What `gusts` remembers: the gust in standard deviations, ticks since the interval of a knock began, and the tick of
# its knock, not rounded.
GUST_MEMORY = 8


def noise_numbers(noise: Noise | None) -> Numbers:
    """Parameters (6,) of `noise` for `measurement`: its fields in declaration order."""
    return np.zeros(NOISE_SIZE) if noise is None else np.array(astuple(noise), dtype=float)


def wind_numbers(wind: Wind | None, period: float) -> Numbers:
    """Parameters (12,) of `wind` for `gusts`, with all forces held constant over a control `period`, s.

    The decay of a gust over one period, its standard deviations (N) per axis on vehicle and bob, the constant forces on
    both, N; the forces of a knock on both, N, and the ticks of its interval.
    """
    if wind is None:
        return np.zeros(WIND_SIZE)
    decay, gusty = np.exp(-period / wind.gust_time), (wind.gust_on_vehicle, wind.gust_on_bob)
    knocking = (wind.knock_on_vehicle / period, wind.knock_on_bob / period, max(1, round(wind.knock_period / period)))
    return np.array([decay, *gusty, *wind.on_vehicle, *wind.on_bob, *knocking])


def measurement(*, moved: bool = False) -> ca.Function:
    """CasADi function (state (24,), draws (18,), `noise_numbers`) → measured state (24,), on the manifold.

    If the origin is `moved`, the numbers end with the position (3,) at which it is seen, m.
    """
    packed, draws, sigma = ca.SX.sym("s", SIZE), ca.SX.sym("n", 18), ca.SX.sym("sigma", NOISE_SIZE)
    origin = ca.SX.sym("o", 3 if moved else 0)
    noise = dict(zip((entry.name for entry in fields(Noise)), ca.vertsplit(sigma), strict=True))
    s, draw = State.symbolic(packed), [draws[3 * i : 3 * i + 3] for i in range(6)]
    error = [noise[name] * each for name, each in zip(noise, draw, strict=True)]
    error[0] -= origin if moved else 0
    error[4] = tangent_part(s.y, error[4])
    measured = displace(s, ca.vertcat(*error))
    return ca.Function("measure", [packed, draws, ca.vertcat(sigma, origin)], [ca.cse(ca.densify(measured.packed()))])


def displace(s: State, error: Numbers) -> State:
    """Return the state, on the manifold, that a local `error` (18, 1) makes of `s`, in CasADi.

    The error is (δx, δẋ, φ, δω, δy, δẏ), with R exp(φ̂) for the attitude.
    """
    y = unit(s.y + error[12:15])
    return State(
        x=s.x + error[0:3], x_dot=s.x_dot + error[3:6], R=s.R @ rotation_by(error[6:9]), omega=s.omega + error[9:12],
        y=y, y_dot=tangent_part(y, s.y_dot + error[15:18]),
    )  # fmt: skip


def gusts(*, knocks: bool = True) -> ca.Function:
    """CasADi function (memory (8,), draws (6,), `wind_numbers`) → memory, forces on vehicle and bob (6,), N.

    A flight whose memory begins with six draws, followed by zeros, has gusts of equal strength from its start.
    Without `knocks` there are none, whatever the numbers, at less cost.
    """
    memory, draws, numbers = ca.SX.sym("g", GUST_MEMORY), ca.SX.sym("n", 6), ca.SX.sym("w", WIND_SIZE)
    decay, on_vehicle, on_bob, constant = numbers[0], numbers[1], numbers[2], numbers[3:9]
    gust = decay * memory[:6] + ca.sqrt(1 - decay**2) * draws
    blowing = ca.vertcat(on_vehicle * gust[:3], on_bob * gust[3:]) + constant
    if not knocks:
        return ca.Function("gusts", [memory, draws, numbers], [ca.vertcat(gust, memory[6:]), blowing])
    clock, moment = memory[6], memory[7]
    ticks = numbers[11]
    moment = ca.if_else(clock < 1, ticks * uniform(draws), moment)
    hit = ca.logic_and(clock <= moment, moment < clock + 1)
    knock = ca.vertcat(numbers[9] * direction(draws[:3]), numbers[10] * direction(draws[3:]))
    following = ca.if_else(clock + 1 < ticks, clock + 1, 0)
    outputs = [ca.vertcat(gust, following, moment), blowing + ca.if_else(hit, knock, 0)]
    return ca.Function("gusts", [memory, draws, numbers], outputs)


def uniform(draws: Numbers) -> Scalar:
    """Return a number uniform in (0, 1) from four normal ones: the share of two in the sum of squares; 0 from zeros."""
    two = ca.sumsqr(draws[:2])
    return two / ca.fmax(two + ca.sumsqr(draws[2:4]), TINY)


def direction(draws: Numbers) -> Vector:
    """Return a unit vector uniform on S² from three normal numbers; 0 from zeros."""
    return draws / ca.sqrt(ca.fmax(ca.sumsqr(draws), TINY))


# Coefficients of Wichura's algorithm AS 241, Applied Statistics 37 (1988), PPND16: numerators and denominators of
# rational functions, of 0.425² − (p − 1/2)² and of √(−ln p) − 1.6, from the highest power down.
_MIDDLE = (
    (2.5090809287301226727e3, 3.3430575583588128105e4, 6.7265770927008700853e4, 4.5921953931549871457e4,
     1.3731693765509461125e4, 1.9715909503065514427e3, 1.3314166789178437745e2, 3.3871328727963666080),
    (5.2264952788528545610e3, 2.8729085735721942674e4, 3.9307895800092710610e4, 2.1213794301586595867e4,
     5.3941960214247511077e3, 6.8718700749205790830e2, 4.2313330701600911252e1, 1.0),
)  # fmt: skip
_TAIL = (
    (7.7454501427834140764e-4, 2.27238449892691845833e-2, 2.41780725177450611770e-1, 1.27045825245236838258,
     3.64784832476320460504, 5.76949722146069140550, 4.63033784615654529590, 1.42343711074968357734),
    (1.05075007164441684324e-9, 5.47593808499534494600e-4, 1.51986665636164571966e-2, 1.48103976427480074590e-1,
     6.89767334985100004550e-1, 1.67638483018380384940, 2.05319162663775882187, 1.0),
)  # fmt: skip
LEAST_PROBABILITY = 1e-10  # above which the tail is that of AS 241


def normal_quantile(probability: Scalar) -> Scalar:
    """Return below what a standard normal number is with this `probability`, in CasADi.

    From `LEAST_PROBABILITY` on, to 16 digits; below it is that of none, −1000.
    """
    p = clip(probability, LEAST_PROBABILITY, 1 - LEAST_PROBABILITY)
    q = p - 0.5
    middle = q * _ratio(_MIDDLE, 0.425**2 - q**2)
    tail = _ratio(_TAIL, ca.sqrt(-ca.log(ca.fmin(p, 1 - p))) - 1.6)
    found = ca.if_else(q**2 < 0.425**2, middle, ca.if_else(q < 0, -tail, tail))
    return ca.if_else(probability < LEAST_PROBABILITY, NEVER, found)


def _ratio(coefficients: tuple[tuple[float, ...], tuple[float, ...]], r: Scalar) -> Scalar:
    above, below = (ca.polyval(ca.DM(list(some)), r) for some in coefficients)
    return above / below
