"""Check a certificate of Theorem C in ball arithmetic: `python -m flypend.laws.certificate FILE`.

The file says: for every state with V ≤ c and |ω₃| ≤ w, at any heading, the law asks each rotor for a force within its
limits. Through a lag, V is V', |η_α3| ≤ k_yaw w, and the forces that act are within the limits, too. This module
imports nothing of flypend. It evaluates the law's program on Taylor models of degree 2 over the unit ball, which
contains {V ≤ c} in the coordinates of the chart lemma (docs/laws/theorem-proof.md, section 8):

    value = a + l·x + x·Qx + r,   |x| ≤ 1,   ξ = diag(radii) x

Every number is a ball of python-flint, so no rounding is lost.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from flint import arb, arb_mat

FORMAT = "flypend certificate 1"
ZERO = arb(0)


class NotProvedError(Exception):
    """The check fails; the message says where."""


def up(value: Any) -> Any:
    """An upper bound of |value|, exact."""
    return arb(value).abs_upper()


class Taylor:
    """A Taylor model; l (1, n) and Q (n, n) are None where they vanish, r ≥ 0 bounds the remainder."""

    def __init__(self, a: Any, l: Any = None, Q: Any = None, r: Any = ZERO) -> None:
        self.a, self.l, self.Q, self.r = a, l, Q, up(r)
        self._norms: tuple[Any, Any] | None = None

    @property
    def constant(self) -> bool:
        """Whether the value is a."""
        return self.l is None and self.Q is None and not self.r > 0

    @property
    def norms(self) -> tuple[Any, Any]:
        """Bounds on |l| and on the spectral norm of Q, (tr Q⁸)^(1/8)."""
        if self._norms is None:
            linear = ZERO if self.l is None else up(up((self.l * self.l.transpose())[0, 0]).sqrt())
            square = ZERO
            if self.Q is not None:
                power = self.Q * self.Q.transpose()
                power = power * power
                square = up(up((power * power.transpose()).trace()).sqrt().sqrt().sqrt())
            self._norms = linear, square
        return self._norms

    @property
    def spread(self) -> Any:
        """Bound on |value − a|."""
        return up(sum(self.norms) + self.r)


def _sum(x: Any, y: Any) -> Any:
    return y if x is None else x if y is None else x + y


def _times(x: Any, factor: Any) -> Any:
    return None if x is None else x * factor


def _outer(l: Any, m: Any) -> Any:
    product = l.transpose() * m
    return (product + product.transpose()) / 2


def add(A: Taylor, B: Taylor) -> Taylor:
    """A + B."""
    return Taylor(A.a + B.a, _sum(A.l, B.l), _sum(A.Q, B.Q), A.r + B.r)


def scaled(A: Taylor, k: Any) -> Taylor:
    """`k` A."""
    return Taylor(A.a * k, _times(A.l, k), _times(A.Q, k), A.r * up(k))


def mul(A: Taylor, B: Taylor) -> Taylor:
    """A B; terms of degree 3 and 4 go to the remainder."""
    if A.constant or B.constant:
        return scaled(B, A.a) if A.constant else scaled(A, B.a)
    Q = _sum(_times(A.Q, B.a), _times(B.Q, A.a))
    if A.l is not None and B.l is not None:
        Q = _sum(Q, _outer(A.l, B.l))
    (la, qa), (lb, qb) = A.norms, B.norms
    r = la * qb + qa * lb + qa * qb + A.r * (up(B.a) + lb + qb + B.r) + B.r * (up(A.a) + la + qa)
    return Taylor(A.a * B.a, _sum(_times(A.l, B.a), _times(B.l, A.a)), Q, r)


def composed(A: Taylor, f: Any, slope: Any, half_bend: Any, sixth: Any) -> Taylor:
    """φ(A) for φ(a) = `f`, φ'(a), ½φ''(a), and a bound `sixth` on |φ'''|/6 over the range of A."""
    Q = _times(A.Q, slope)
    if A.l is not None:
        Q = _sum(Q, _outer(A.l, A.l) * half_bend)
    linear, square = A.norms
    rest = square + A.r
    r = up(slope) * A.r + up(half_bend) * (2 * linear * rest + rest * rest) + up(sixth) * A.spread * A.spread * A.spread
    return Taylor(f, _times(A.l, slope), Q, r)


def sqrt(A: Taylor) -> Taylor:
    """√A."""
    whole = A.a + arb(0, A.spread)
    if not whole > 0:
        raise NotProvedError("a root of what may not be positive")
    root = A.a.sqrt()
    return composed(A, root, 1 / (2 * root), -1 / (8 * A.a * root), 1 / (16 * whole * whole * whole.sqrt()))


def inverse(A: Taylor) -> Taylor:
    """1/A."""
    whole = A.a + arb(0, A.spread)
    if not (whole > 0 or whole < 0):
        raise NotProvedError("a division by what may vanish")
    square = whole * whole
    return composed(A, 1 / A.a, -1 / (A.a * A.a), 1 / (A.a * A.a * A.a), 1 / (square * square))


OPERATIONS: dict[str, Callable[..., Taylor]] = {
    "add": add, "mul": mul, "sqrt": sqrt, "neg": lambda A: scaled(A, -1), "sub": lambda A, B: add(A, scaled(B, -1)),
    "div": lambda A, B: mul(A, inverse(B)),
}  # fmt: skip


def radii(k: Any, c: Any) -> list[Any]:
    """Half axes of an ellipsoid of ξ that contains {V ≤ c}, for the gains `k`."""

    def spring(stiffness: str, reach: str) -> Any:
        return 2 * k[stiffness] / (2 + c / (k[stiffness] * k[reach] * k[reach]))

    rod, axis = k["rod_weight"] * k["rod_stiffness"], k["axis_weight"] * k["axis_stiffness"]
    if not (c < rod and c < axis):
        raise NotProvedError("c is so large that rod or thrust axis may point backwards, where the chart ends")
    for name in ("rod_barrier", "axis_barrier"):
        if not (k[name] > 0 and k[name] <= 1):
            raise NotProvedError(f"{name} is not in (0, 1]")
    level, upright = spring("position_stiffness", "position_reach"), spring("height_stiffness", "height_reach")
    weights = [level, level, upright, *[arb(1)] * 3, *[rod] * 2, *[k["rod_weight"]] * 2, *[axis] * 2]
    weights += [k["axis_weight"]] * 2
    if "rotor_lag" in k:
        for name in ("rotor_lag", "wrench_damping", "yaw_damping"):
            if not k[name] > 0:
                raise NotProvedError(f"{name} is not positive")
        weights += [k["thrust_weight"], *[k["moment_weight"]] * 2]
    return [up((2 * c / weight).sqrt()) for weight in weights]


def evaluated(certificate: Any, c: Any) -> tuple[list[list[Taylor]], list[Taylor]]:
    """Return (f, u) of each wrench of the program on {V ≤ c}, commanded and then acting, and ż (3)."""
    numbers = {name: arb(value) for name, value in certificate["numbers"].items()}
    sizes = radii(numbers, c)

    def given(vector: int, entry: int) -> Taylor:
        if vector == 1:
            return Taylor(numbers[certificate["parameters"][entry]])
        return Taylor(ZERO, arb_mat([[size if i == entry else ZERO for i, size in enumerate(sizes)]]))

    values: list[Taylor] = []
    for name, arguments, number in certificate["operations"]:
        if name == "input":
            values.append(given(*arguments))
        elif name == "constant":
            values.append(Taylor(arb(number)))
        else:
            values.append(OPERATIONS[name](*(values[place] for place in arguments)))
    found = [values[place] for place in certificate["outputs"]]
    if len(found) != (11 if "rotor_lag" in numbers else 7):
        raise NotProvedError("the program has not the outputs of a law")
    return [found[i : i + 4] for i in range(0, len(found) - 3, 4)], found[-3:]


def _length(vector: list[Taylor], *, moved: bool = True) -> Any:
    """Bound on the length of `vector`; without its linear part if not `moved`."""
    sizes = [up(t.a) + (t.spread if moved else t.norms[1] + t.r) for t in vector]
    return up(sum((size * size for size in sizes), ZERO).sqrt())


def _spins(certificate: Any, c: Any, w: Any, wrenches: Any, turn: Any) -> list[tuple[Any, Any, list[Any]]]:
    """Return what ω₃, |ω₃| ≤ w, adds to each wrench: bounds on I⁻¹ τ, across and along the axis, and on ω × I ω.

    `turn` bounds |ż| = |(ω₁, ω₂)|. The last includes T d/dt(ω × I ω) in what is commanded through a lag T.
    """
    k = {name: arb(value) for name, value in certificate["numbers"].items()}
    I = [[arb(entry) for entry in row] for row in certificate["inertia"]]
    J = [[up(I[i][j] - (I[0][0] if i == j else 0)) for j in range(3)] for i in range(3)]  # ω × I ω = ω × J ω
    yaw, speed = up(k["yaw_damping"]) * w, [turn, turn, w]

    def crossed(one: list[Any], two: list[Any]) -> list[Any]:
        """Bounds on a × J b, from those on the entries of a and b."""
        momentum = [sum((J[i][j] * two[j] for j in range(3)), ZERO) for i in range(3)]
        return [one[i - 2] * momentum[i - 1] + one[i - 1] * momentum[i - 2] for i in range(3)]

    gyroscopic = crossed(speed, speed)
    if "rotor_lag" not in k:
        return [(w * turn, yaw, gyroscopic)]
    T, drift, pushed = up(k["rotor_lag"]), 2 * yaw, _length(wrenches[1][1:])  # |ω̇₃| ≤ k_yaw w + |η_α3|
    both = 2 * pushed + up((2 * c / k["moment_weight"]).sqrt())  # |u| + |u_a|
    across = w * turn + T * (w * both + drift * turn + w * w * turn)
    along = yaw * (up(1 - T * k["yaw_damping"]) + up(1 - T * (k["yaw_damping"] + k["wrench_damping"])))
    alpha = [pushed + w * turn] * 2 + [drift]
    growing = [
        here + T * (one + two)
        for here, one, two in zip(gyroscopic, crossed(alpha, speed), crossed(speed, alpha), strict=True)
    ]
    return [(across, along, growing), (w * turn, drift, gyroscopic)]


def force_ranges(certificate: Any, c: Any, w: Any) -> list[tuple[Any, Any]]:
    """Return bounds on each rotor's force, N, over {V ≤ c, |ω₃| ≤ w} at every heading; first on those commanded.

    With h_i = (I U_i)₁₂ and U_i the row of the rotor, its force is U_i0 f + |h_i| k·u + spin, k a unit vector.
    """
    wrenches, z_dot = evaluated(certificate, c)
    spins = _spins(certificate, c, w, wrenches, _length(z_dot))
    I = [[arb(entry) for entry in row] for row in certificate["inertia"]]
    out = []
    for (f, *u), (across, along, gyroscopic) in zip(wrenches, spins, strict=True):
        none = arb_mat([[ZERO] * (14 if len(wrenches) == 1 else 17)])
        linear_f, linear_u = (none if f.l is None else f.l), [none if t.l is None else t.l for t in u]
        gram = arb_mat([[(p * q.transpose())[0, 0] for q in linear_u] for p in linear_u])
        fourth = gram * gram
        largest = up(up((fourth * fourth).trace()).sqrt().sqrt())  # at least the largest eigenvalue
        inner = [up((p * linear_f.transpose())[0, 0]) for p in linear_u]
        mixed = up(sum((size * size for size in inner), ZERO).sqrt())
        for row in certificate["unmixing"]:
            U = [arb(entry) for entry in row]
            IU = [sum((I[i][j] * U[1 + j] for j in range(3)), ZERO) for i in range(3)]
            h = up((IU[0] * IU[0] + IU[1] * IU[1]).sqrt())
            share = up(U[0])
            linear = up((share * share * f.norms[0] * f.norms[0] + 2 * share * h * mixed + h * h * largest).sqrt())
            rest = share * (f.norms[1] + f.r) + h * _length(u, moved=False)
            spin = h * across + up(IU[2]) * along + sum((up(U[1 + j]) * gyroscopic[j] for j in range(3)), ZERO)
            spread = up(linear + rest + spin)
            out.append((U[0] * f.a - spread, U[0] * f.a + spread))
    return out


def check(certificate: Any) -> str:
    """Return why the certificate does not hold, in one line; empty if it is proved."""
    if certificate.get("format") != FORMAT:
        return f"not a file of {FORMAT}"
    c, w = arb(certificate["c"]), arb(certificate["w"])
    low, high = (arb(limit) for limit in certificate["limits"])
    if not (c > 0 and w >= 0):
        return "c must be positive, and w not negative"
    try:
        ranges = force_ranges(certificate, c, w)
    except NotProvedError as reason:
        return str(reason)
    rotors = len(certificate["unmixing"])
    for i, (least, most) in enumerate(ranges):
        if not (least >= low and most <= high):
            found = f"{float(least.mid()):.4g} to {float(most.mid()):.4g} N"
            verb = "be asked for" if i < rotors else "give"
            return f"rotor {i % rotors} may {verb} {found}, outside {float(low):g} to {float(high):g} N"
    return ""


def main(path: str) -> int:
    """Check the file at `path`."""
    certificate = json.loads(Path(path).read_text(encoding="utf-8"))
    reason = check(certificate)
    told = f"V <= {certificate['c']:g}, |omega_3| <= {certificate['w']:g} rad/s on {certificate['vehicle']}"
    print(f"not proved: {reason}" if reason else f"proved: {told}")
    return 1 if reason else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
