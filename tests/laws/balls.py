"""The claimed V̇ against the symbolic one in ball arithmetic (python-flint), for random vehicles, gains and states.

A ball encloses a real number, and every operation encloses all possible results. Vehicle and gains are symbols of the
program, so that no constant is rounded before the balls begin. An identity holds only if the ball of the difference
contains 0; it says something only if that ball is narrow.
"""

import casadi as ca
import numpy as np
from flint import arb, ctx

from flypend.compile.program import interpret, lower
from flypend.export.records import SymbolicVehicle, params_of, params_record
from flypend.laws.closed_loop import WRENCH, wrench_in
from flypend.model import State, equations_of_motion
from flypend.model.state import SIZE

BITS = 200
OPERATIONS = {
    "add": arb.__add__,
    "sub": arb.__sub__,
    "mul": arb.__mul__,
    "div": arb.__truediv__,
    "neg": arb.__neg__,
    "fabs": arb.__abs__,
    "sqrt": arb.sqrt,
    "log": arb.log,
    "sin": arb.sin,
    "cos": arb.cos,
}


class RateCheck:
    """The difference of exact and claimed V̇ of `law` on `vehicle`, and the sum of the sizes of the terms of V̇.

    Through a `lag` the wrench that acts is part of the state; the lag is a symbol, and so is the wrench.
    """

    def __init__(self, law, vehicle, *, lag=False):
        self.law, self.vehicle, self.lag = law.bind(vehicle), vehicle, lag
        record = params_record(vehicle)
        t, s = ca.SX.sym("t"), ca.SX.sym("s", SIZE + WRENCH * lag + lag)
        p, k = ca.SX.sym("p", record.length), ca.SX.sym("k", len(self.law.numbers))
        body, state = SymbolicVehicle(p, record, vehicle), State.symbolic(s)
        gains = {name: k[i] for i, name in enumerate(self.law.numbers)}
        acting = wrench_in(s[: SIZE + WRENCH]) if lag else None
        body.rotor_lag = s[-1] if lag else None
        control = self.law.evaluate(t, state, body, gains=gains, acting=acting)
        rates = equations_of_motion(state, acting or control.wrench, body, self.law.e3).packed()
        if lag:
            command = ca.vertcat(control.wrench.thrust, control.wrench.moment)
            rates = ca.vertcat(rates, (command - s[SIZE:-1]) / body.rotor_lag, 0)
        flow = ca.vertcat(s, t), ca.vertcat(rates, 1)
        terms = [ca.jtimes(term, *flow) for term in control.lyapunov.values()]
        claimed = control.signals["V_rate_claimed"]
        self.function = ca.Function("rate", [t, s, p, k], [sum(terms) - claimed, ca.vertcat(*terms)])
        self.program = lower(self.function)

    def numbers(self, rng):
        """Time, and parameters and gains up to 20 % off those of the vehicle."""
        params, gains = params_of(self.vehicle), np.array(list(self.law.numbers.values()))
        return rng.uniform(0, 10), *(
            values * np.exp(rng.uniform(-0.2, 0.2, values.shape)) for values in (params, gains)
        )

    def __call__(self, rng, speed=12.0):
        """Return the ball of the difference at a random state, over the sum of the sizes of the terms."""
        ctx.prec = BITS
        time, params, gains = self.numbers(rng)
        state = random_state(rng, speed)
        if self.lag:  # thrust of either sign, N, moments, N m, and a lag, s
            state += [*rng.uniform(-10, 10, 1), *rng.uniform(-1, 1, 3), *rng.uniform(0.001, 1.0, 1)]
        vectors = [[time], state, params, gains]
        entries = [[value if isinstance(value, arb) else arb(float(value)) for value in vector] for vector in vectors]
        [difference], terms = interpret(self.program, [vector.__getitem__ for vector in entries], OPERATIONS, arb)
        return difference / sum(map(abs, terms))


def random_state(rng, speed):
    """A packed state whose balls contain a point of the manifold: rational unit vectors, ẏ = w × y."""
    x, x_dot, omega, w = ([arb(float(entry)) for entry in rng.uniform(-speed, speed, 3)] for _ in range(4))
    y = sphere(rng)
    return [*x, *x_dot, *rotation(rng), *omega, *y, *cross(w, y)]


def sphere(rng):
    """A point of S² by stereographic projection of two binary fractions."""
    a, b = (arb(float(entry)) for entry in rng.normal(size=2))
    whole = 1 + a * a + b * b
    return [2 * a / whole, 2 * b / whole, (whole - 2) / whole]


def rotation(rng):
    """A rotation by rows, from a quaternion of four binary fractions."""
    w, a, b, c = (arb(float(entry)) for entry in rng.normal(size=4))
    n = w * w + a * a + b * b + c * c
    rows = [
        w * w + a * a - b * b - c * c, 2 * (a * b - w * c), 2 * (a * c + w * b),
        2 * (a * b + w * c), w * w - a * a + b * b - c * c, 2 * (b * c - w * a),
        2 * (a * c - w * b), 2 * (b * c + w * a), w * w - a * a - b * b + c * c,
    ]  # fmt: skip
    return [entry / n for entry in rows]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
