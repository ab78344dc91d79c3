"""Check a certificate of Theorem C by validated computation: `python -m flypend.laws.verify FILE [VEHICLE]`.

The file says: for every state with V ≤ c and |ω₃| ≤ w, at any heading, the law asks each rotor for a force within its
limits. Through a lag, V is V', |η_α3| ≤ k_yaw w, and the forces that act are within the limits, too. With a body, the
rod of a hub touches neither rotor disc nor arm. This module uses nothing of flypend. It evaluates the law's program on
Taylor models of degree 3 over the unit ball, which contains {V ≤ c} in the coordinates of the chart lemma
(docs/laws/theorem-proof.md, section 8):

    value = P(x) + δ(x),   P = a + l·x + x·Qx + T(x, x, x),   |x| ≤ 1,   ξ = diag(radii) x

An operation i leaves a remainder of its own, |ϱ_i| ≤ rho, and passes on those of its arguments j:

    δ_i(x) = ϱ_i(x) + Σ_j C_ij(x) δ_j(x),   C_ij(x) = a + l·x ± radius

Summing |C| |δ| forgets that remainders cancel as values do, and is a hundred times too large at the end. So bounds are
also carried backwards, as in automatic differentiation: the remainder of a value is Σ_i λ_i(x) ϱ_i(x) with
λ_j = Σ_i λ_i C_ij. Of λ the constant and the linear part are kept; the rest meets the bound on δ_j at once.

Numbers are doubles, of unit roundoff u = 2⁻⁵³, and what rounding loses is bounded in advance: a sum of n products of k
factors is off by at most (n + k) u times the sum of their sizes, in any order (Higham 2002, section 3.1).

- The coefficients of P sum at most five products of four factors: ROUND times the Frobenius norms of what enters, or of
  what comes out of a sum or of the product with a constant.
- λ_j sums over the operations that use j, at most TERMS: ROUND (|a| + |l|) |λ_i| for each.
- Bounds and norms are sums of at most 10⁴ non-negative numbers: they are too small by less than the factor UP.
- What underflows is below TINY, squares below its square. TINY is added to each norm and to each bound.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

FORMAT = "flypend certificate 1"
BLOCK = 1000  # operations between two backward passes: fewer cost time, and more lose what the next one starts from
ROUND, UP, TINY = 1e-12, 1 + 1e-11, 1e-150
TERMS, OPERATIONS = 5000, 10**5  # most uses of a value, and operations of a program
GAP = 1e-9  # m, more than rounding moves a distance
MET = 100  # values whose share of a bound is added at a time


class NotProvedError(Exception):
    """The check fails; the message says where."""


@dataclass(eq=False)
class Polynomial:
    """P of degree 3: l (n,), Q (n, n) and T (n, n, n) are symmetric, None where they vanish."""

    a: float
    l: Any = None
    Q: Any = None
    T: Any = None

    @property
    def constant(self) -> bool:
        """Whether P is a."""
        return self.l is None and self.Q is None and self.T is None

    @cached_property
    def sizes(self) -> tuple[float, float, float]:
        """Bounds on |l·x|, |x·Qx| and |T(x, x, x)| over the unit ball."""
        return _length(self.l), _spectral(self.Q), _length(self.T)

    @property
    def spread(self) -> float:
        """Bound on |P − a|."""
        return sum(self.sizes) * UP

    @property
    def whole(self) -> float:
        """Sum of |a| and the Frobenius norms, to which rounding is relative."""
        return abs(self.a) + sum(map(_length, (self.l, self.Q, self.T)))


def _length(entries: Any) -> float:
    """Bound on the Frobenius norm."""
    return 0.0 if entries is None else math.sqrt(np.vdot(entries, entries)) * UP + TINY


def _spectral(Q: Any) -> float:
    """Bound on the spectral norm, ‖Q¹⁶‖_F^(1/16), with Q scaled to a Frobenius norm of 1."""
    size = _length(Q)
    if size <= 2 * TINY:
        return size
    power = Q / size
    for _ in range(4):
        power = power @ power
    return size * float(min(1.0, (_length(power) + ROUND) ** (1 / 16))) * UP


def _sum(x: Any, y: Any) -> Any:
    return y if x is None else x if y is None else x + y


def _times(x: Any, factor: float) -> Any:
    return None if x is None or factor == 0 else x * factor


def _square(l: Any, m: Any) -> Any:
    """Return the symmetric part of l ⊗ m."""
    if l is None or m is None:
        return None
    product = np.multiply.outer(l, m)
    return (product + product.T) / 2


def _cube(l: Any, Q: Any) -> Any:
    """Return the symmetric part of l ⊗ Q."""
    if l is None or Q is None:
        return None
    product = np.multiply.outer(l, Q)
    return (product + product.transpose(1, 0, 2) + product.transpose(1, 2, 0)) / 3


class Factor(NamedTuple):
    """C(x) = a + l·x ± radius."""

    a: float
    l: Any
    radius: float


Result = tuple[Polynomial, float, tuple[Factor, ...]]  # of an operation: P, rho, and a factor for each argument


def plus(A: Polynomial, B: Polynomial, sign: float = 1.0) -> Result:
    """A + `sign` B."""
    P = Polynomial(
        A.a + sign * B.a, _sum(A.l, _times(B.l, sign)), _sum(A.Q, _times(B.Q, sign)), _sum(A.T, _times(B.T, sign))
    )
    return P, ROUND * P.whole, (Factor(1.0, None, 0.0), Factor(sign, None, 0.0))


def times(A: Polynomial, B: Polynomial, left: float, right: float) -> Result:
    """A B, whose remainders are at most `left` and `right`; terms of degree 4 to 6 go to rho.

    (A + δ)(B + ε) − A B = (B + ε/2) δ + (A + δ/2) ε.
    """
    for P, other, place in ((A, B, 1), (B, A, 0)):
        if P.constant:
            scaled = Polynomial(P.a * other.a, _times(other.l, P.a), _times(other.Q, P.a), _times(other.T, P.a))
            own, others = (left, right) if place else (right, left)
            factors = Factor(other.a, other.l, sum(other.sizes[1:]) + others / 2), Factor(P.a, None, own / 2)
            return scaled, ROUND * scaled.whole, factors if place else factors[::-1]
    l = _sum(_times(A.l, B.a), _times(B.l, A.a))
    Q = _sum(_sum(_times(A.Q, B.a), _times(B.Q, A.a)), _square(A.l, B.l))
    T = _sum(_sum(_times(A.T, B.a), _times(B.T, A.a)), _sum(_cube(A.l, B.Q), _cube(B.l, A.Q)))
    (la, qa, ta), (lb, qb, tb) = A.sizes, B.sizes
    rho = la * tb + ta * lb + (qa + ta) * (qb + tb) + ROUND * A.whole * B.whole
    factors = Factor(B.a, B.l, qb + tb + right / 2), Factor(A.a, A.l, qa + ta + left / 2)
    return Polynomial(A.a * B.a, l, Q, T), rho, factors


def compose(A: Polynomial, error: float, values: Sequence[float], fourth: float, third: float) -> Result:
    """φ(A + δ), |δ| ≤ `error`: `values` are φ(a), φ'(a), φ''(a)/2, φ'''(a)/6.

    `fourth` bounds |φ''''|/24 over the range of A, and `third` |φ'''| over that of A + δ.
    """
    f, slope, bend, sixth = values
    linear, rest = A.sizes[0], A.sizes[1] + A.sizes[2]
    square = _square(A.l, A.l)
    P = Polynomial(
        f, _times(A.l, slope), _sum(_times(A.Q, slope), _times(square, bend)),
        _sum(_sum(_times(A.T, slope), _times(_cube(A.l, A.Q), 2 * bend)), _times(_cube(A.l, square), sixth)),
    )  # fmt: skip
    rho = abs(bend) * (2 * linear * A.sizes[2] + rest**2) + fourth * A.spread**4
    rho += abs(sixth) * rest * (3 * linear**2 + 3 * linear * rest + rest**2)
    size = A.whole
    rho += ROUND * (abs(f) + size * (abs(slope) + size * (abs(bend) + size * abs(sixth))))
    moved = A.spread + error
    radius = 2 * abs(bend) * (rest + error) + third * moved**2 / 2
    return P, rho, (Factor(slope, _times(A.l, 2 * bend), radius),)


def root(A: Polynomial, error: float) -> Result:
    """√(A + δ)."""
    a, least = A.a, A.a / UP - A.spread * UP
    sure = least - error * UP
    if not sure > 0:
        raise NotProvedError("a root of what may not be positive")
    f = math.sqrt(a)
    values = f, 1 / (2 * f), -1 / (8 * a * f), 1 / (16 * a**2 * f)
    return compose(A, error, values, 5 / (128 * least**3.5) * UP, 3 / (8 * sure**2.5) * UP)


def inverse(A: Polynomial, error: float) -> Result:
    """1/(A + δ)."""
    a, least = A.a, abs(A.a) / UP - A.spread * UP
    sure = least - error * UP
    if not sure > 0:
        raise NotProvedError("a division by what may vanish")
    return compose(A, error, (1 / a, -1 / a**2, 1 / a**3, -1 / a**4), 1 / least**5 * UP, 6 / sure**4 * UP)


class Edge(NamedTuple):
    """What a value takes from that at the place j: the factor C = a + l·x ± radius, and a bound on |l|."""

    j: int
    a: float
    l: Any
    radius: float
    steep: float


@dataclass(eq=False)
class Value:
    """What an operation answers: P until it is used no more, rho, a bound on |δ|, and the factors C_ij."""

    P: Polynomial | None
    rho: float = 0.0
    error: float = 0.0
    passed: tuple[Edge, ...] = ()


def _errors(values: list[Value], targets: Sequence[int], n: int) -> Any:
    """Return bounds on |δ| of the `targets`, carried backwards, for x in R^n."""
    rows = len(targets)
    waiting = {place: np.zeros((1 + n, rows)) for place in targets}  # λ of each target, constant and linear part
    for row, place in enumerate(targets):
        waiting[place][0, row] = 1.0
    # A value that meets λ adds `lost` |λ| and `bent` |linear part of λ|; many at a time.
    found, met, added = np.zeros(rows), [], []
    for i in range(max(targets), -1, -1):
        here, value = waiting.pop(i, None), values[i]
        if here is not None:
            lost, bent = value.rho + TINY, 0.0
            for j, a, l, radius, steep in value.passed:
                error = values[j].error
                lost += (radius + ROUND * (abs(a) + steep)) * error
                bent += steep * error
                there = waiting.get(j)
                if there is None:
                    there = waiting[j] = a * here
                elif abs(a) == 1:  # half of all: sums
                    (np.add if a > 0 else np.subtract)(there, here, out=there)
                elif a:
                    there += a * here
                if l is not None:
                    there[1:] += l[:, None] * here[0]
            met.append(here)
            added.append((lost, lost + bent))
        if met and (len(met) == MET or not i):
            all_, (constant, linear) = np.stack(met), np.array(added).T
            found += constant @ np.abs(all_[:, 0])
            found += linear @ (np.sqrt(np.einsum("ijk,ijk->ik", all_[:, 1:], all_[:, 1:])) + TINY)
            met.clear()
            added.clear()
    return found * UP


Model = tuple[Polynomial, float]  # P and a bound on |δ|


class _Tape:
    """The values of a program, in order; a division is two."""

    def __init__(self) -> None:
        self.values: list[Value] = []

    def put(self, result: Result, *arguments: int) -> int:
        """Append what an operation on the values at `arguments` answers, and return its place."""
        P, rho, factors = result
        passed, error = [], rho
        for j, C in zip(arguments, factors, strict=True):
            if self.values[j].error != 0:  # true of what is not a number, too
                passed.append(Edge(j, *C, _length(C.l)))
                error += (abs(C.a) + passed[-1].steep + C.radius) * self.values[j].error
        self.values.append(Value(P, rho, error * UP + TINY if arguments else 0.0, tuple(passed)))
        return len(self.values) - 1

    def apply(self, name: str, own: list[int], number: float) -> int:
        """Append what the operation `name` answers to the values at `own`, and return its place."""
        given, errors = [_alive(self.values[j]) for j in own], [self.values[j].error for j in own]
        if name == "constant":
            return self.put((Polynomial(float(number)), 0.0, ()))
        if name in ("add", "sub"):
            return self.put(plus(given[0], given[1], 1.0 if name == "add" else -1.0), *own)
        if name == "mul":
            return self.put(times(given[0], given[1], errors[0], errors[1]), *own)
        if name == "div":
            second = self.put(inverse(given[1], errors[1]), own[1])
            place = self.apply("mul", [own[0], second], 0.0)
            self.values[second].P = None
            return place
        if name == "sqrt":
            return self.put(root(given[0], errors[0]), *own)
        if name == "neg":
            P, _, factors = plus(Polynomial(0.0), given[0], -1.0)
            return self.put((P, 0.0, factors[1:]), *own)
        raise NotProvedError(f"{name} is not an operation")


def evaluate(operations: list[Any], inputs: Any, outputs: list[int]) -> list[Model]:
    """Return P and a bound on |δ| of each of the `outputs` of the program; `inputs(vector, entry)` is a P."""
    used = Counter(place for name, arguments, _ in operations if name != "input" for place in arguments)
    if len(operations) > OPERATIONS or max(used.values(), default=0) > TERMS:
        raise NotProvedError("the program is too long, or uses a value too often, for the bounds on rounding")
    tape, places, n, first = _Tape(), [], 0, 0  # places: of each operation on the tape
    last = {place: i for i, (name, arguments, _) in enumerate(operations) if name != "input" for place in arguments}
    last |= dict.fromkeys(outputs, len(operations))
    for i, (name, arguments, number) in enumerate(operations):
        if name == "input":
            P = inputs(*arguments)
            n = n if P.l is None else len(P.l)
            places.append(tape.put((P, 0.0, ())))
        else:
            places.append(tape.apply(name, [places[place] for place in arguments], number))
            for place in arguments:
                if last[place] == i:
                    tape.values[places[place]].P = None
        if len(tape.values) - first >= BLOCK:
            kept = [at for place, at in enumerate(places) if at >= first and last.get(place, -1) > i]
            _tighten(tape.values, kept, n)
            first = len(tape.values)
    found = [places[place] for place in outputs]
    _tighten(tape.values, found, n)
    return [(_alive(tape.values[j]), tape.values[j].error) for j in found]


def _alive(value: Value) -> Polynomial:
    if value.P is None:
        raise NotProvedError("the program uses a value that is gone")
    return value.P


def _tighten(values: list[Value], places: list[int], n: int) -> None:
    """Replace the bounds on |δ| at `places` by those carried backwards, where these are smaller."""
    targets = sorted({j for j in places if values[j].error > UP * values[j].rho + TINY})
    if targets:
        for j, error in zip(targets, _errors(values, targets, n).tolist(), strict=True):
            values[j].error = min(values[j].error, error)


def radii(k: Any, c: float) -> list[float]:
    """Half axes of an ellipsoid of ξ that contains {V ≤ c}, for the gains `k`."""

    def spring(stiffness: str, reach: str) -> float:
        return float(2 * k[stiffness] / (2 + c / (k[stiffness] * k[reach] * k[reach])))

    rod, axis = k["rod_weight"] * k["rod_stiffness"], k["axis_weight"] * k["axis_stiffness"]
    if not (c * UP < rod and c * UP < axis):
        raise NotProvedError("c is so large that rod or thrust axis may point backwards, where the chart ends")
    for name in ("rod_barrier", "axis_barrier"):
        if not (k[name] > 0 and k[name] <= 1):
            raise NotProvedError(f"{name} is not in (0, 1]")
    level, upright = spring("position_stiffness", "position_reach"), spring("height_stiffness", "height_reach")
    weights = [level, level, upright, *[1.0] * 3, *[rod] * 2, *[k["rod_weight"]] * 2, *[axis] * 2]
    weights += [k["axis_weight"]] * 2
    if "rotor_lag" in k:
        for name in ("rotor_lag", "wrench_damping", "yaw_damping"):
            if not k[name] > 0:
                raise NotProvedError(f"{name} is not positive")
        weights += [k["thrust_weight"], *[k["moment_weight"]] * 2]
    return [math.sqrt(2 * c / weight) * UP for weight in weights]


class Answer(NamedTuple):
    """What the program answers: (f, u) of each wrench, commanded and then acting, ż (3) and y·z."""

    wrenches: list[list[Model]]
    axis_rate: list[Model]
    cosine: Model


def split(found: list[Model]) -> Answer:
    """Return the outputs of the program by what they are."""
    return Answer([found[i : i + 4] for i in range(0, len(found) - 4, 4)], found[-4:-1], found[-1])


def evaluate_program(certificate: Any, c: float) -> Answer:
    """Return what the program answers on {V ≤ c}."""
    numbers = certificate["numbers"]
    sizes = np.diag(radii(numbers, c))

    def given(vector: int, entry: int) -> Polynomial:
        return Polynomial(numbers[certificate["parameters"][entry]]) if vector else Polynomial(0.0, sizes[entry])

    try:
        found = evaluate(certificate["operations"], given, certificate["outputs"])
    except OverflowError:
        raise NotProvedError("the bounds are too large for a number") from None
    if len(found) != (12 if "rotor_lag" in numbers else 8):
        raise NotProvedError("the program has not the outputs of a law")
    return split(found)


def _norm(sizes: Sequence[float]) -> float:
    """Bound on the length of a vector whose entries are at most `sizes`."""
    return math.sqrt(sum(size * size for size in sizes)) * UP + TINY


def _far(model: Model) -> float:
    """Bound on |P| + |δ|."""
    P, error = model
    return (abs(P.a) + P.spread + error) * UP


def _above(one: Any, two: Any) -> Any:
    """Return bounds on the entries of the product of two matrices."""
    return np.abs(one @ two) + ROUND * (np.abs(one) @ np.abs(two)) + TINY


def _spins(certificate: Any, c: float, w: float, wrenches: Any, turn: float) -> list[tuple[float, float, list[float]]]:
    """Return what ω₃, |ω₃| ≤ w, adds to each wrench: bounds on I⁻¹ τ, across and along the axis, and on ω × I ω.

    `turn` bounds |ż| = |(ω₁, ω₂)|. The last includes T d/dt(ω × I ω) in what is commanded through a lag T.
    """
    k, I = certificate["numbers"], np.array(certificate["inertia"])
    J = np.abs(I - I[0, 0] * np.eye(3)) + ROUND * np.abs(I[0, 0])  # ω × I ω = ω × J ω
    yaw, speed = abs(k["yaw_damping"]) * w, [turn, turn, w]

    def crossed(one: list[float], two: list[float]) -> list[float]:
        """Bounds on a × J b, from those on the entries of a and b."""
        momentum = J @ two
        return [float(one[i - 2] * momentum[i - 1] + one[i - 1] * momentum[i - 2]) for i in range(3)]

    gyroscopic = crossed(speed, speed)
    if "rotor_lag" not in k:
        return [(w * turn, yaw, gyroscopic)]
    T, drift, pushed = k["rotor_lag"], 2 * yaw, _norm([_far(model) for model in wrenches[1][1:]])
    both = 2 * pushed + math.sqrt(2 * c / k["moment_weight"])  # |u| + |u_a|
    across = w * turn + T * (w * both + drift * turn + w * w * turn)
    fast, slow = T * (k["yaw_damping"] + k["wrench_damping"]), T * k["yaw_damping"]
    along = yaw * (abs(1 - slow) + abs(1 - fast) + ROUND * (1 + fast))  # |ω̇₃| ≤ k_yaw w + |η_α3|
    alpha = [pushed + w * turn] * 2 + [drift]
    growing = [
        here + T * (one + two)
        for here, one, two in zip(gyroscopic, crossed(alpha, speed), crossed(speed, alpha), strict=True)
    ]
    return [(across, along, growing), (w * turn, drift, gyroscopic)]


def ranges_of(certificate: Any, c: float, w: float, answer: Answer) -> list[tuple[float, float]]:
    """Return bounds on each rotor's force, N, over {V ≤ c, |ω₃| ≤ w} at every heading; first on those commanded.

    With h_i = (I U_i)₁₂ and U_i the row of the rotor, its force is U_i0 f + |h_i| k·u + spin, k a unit vector.
    """
    wrenches = answer.wrenches
    spins = _spins(certificate, c, w, wrenches, _norm([_far(model) for model in answer.axis_rate]))
    unmixing, I = np.array(certificate["unmixing"]), np.array(certificate["inertia"])
    shares, arms = np.abs(unmixing), _above(unmixing[:, 1:], I.T)
    out = []
    for ((F, error), *u), (across, along, gyroscopic) in zip(wrenches, spins, strict=True):
        none = np.zeros(14 if len(wrenches) == 1 else 17)
        linear_f, rows = (none if F.l is None else F.l), np.array([none if P.l is None else P.l for P, _ in u])
        gram = rows @ rows.T
        largest = _spectral(gram) + ROUND * float(np.trace(gram))  # at least the largest eigenvalue
        mixed = _norm(_above(rows, linear_f).tolist())
        turned = _norm([(abs(P.a) + P.sizes[1] + P.sizes[2] + off) * UP for P, off in u])
        for own, share, (one, two, three) in zip(unmixing[:, 0], shares, arms, strict=True):
            h = _norm([one, two])
            linear = math.sqrt((share[0] * F.sizes[0]) ** 2 + 2 * share[0] * h * mixed + h * h * largest) + TINY
            rest = share[0] * (F.sizes[1] + F.sizes[2] + error) + h * turned
            spin = h * across + three * along + float(share[1:] @ gyroscopic)
            spread = (linear + rest + spin + ROUND * abs(own * F.a)) * UP
            out.append((float(own * F.a - spread), float(own * F.a + spread)))
    return out


def check(certificate: Any) -> str:
    """Return why the certificate does not hold, in one line; empty if it is proved."""
    try:
        if certificate["format"] != FORMAT:
            return f"not a file of {FORMAT}"
        c, w = float(certificate["c"]), float(certificate["w"])
        if not (c > 0 and w >= 0):
            return "c must be positive, and w not negative"
        with np.errstate(all="ignore"):  # no comparison holds for what is not a number
            answer = evaluate_program(certificate, c)
            return outside(certificate, ranges_of(certificate, c, w, answer)) or name_touch(certificate, lean(answer))
    except NotProvedError as reason:
        return str(reason)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as broken:
        return f"no certificate: {type(broken).__name__}, {broken}"


def outside(certificate: Any, ranges: list[tuple[float, float]]) -> str:
    """Return which of the `ranges` of force is not within the limits, in one line; empty if none."""
    (low, high), rotors = certificate["limits"], len(certificate["unmixing"])
    for i, (least, most) in enumerate(ranges):
        if not (least >= low and most <= high):
            verb = "be asked for" if i < rotors else "give"
            return f"rotor {i % rotors} may {verb} {least:.4g} to {most:.4g} N, outside {low:g} to {high:g} N"
    return ""


def lean(answer: Answer) -> float:
    """Bound on the angle between rod and thrust axis, rad; π if there is none."""
    P, error = answer.cosine
    least = P.a - (P.spread + error + ROUND) * UP
    return 2 * math.asin(math.sqrt((1 - least) / 2)) * UP if least > -1 else math.pi


def name_touch(certificate: Any, theta: float) -> str:
    """Return what the rod may touch, in one line; empty if it is known to touch nothing, or there is no body.

    θ, rad, bounds the angle between rod and axis. A point at the distance r from the axis and the height h is at least
    r cos θ − |h| sin θ from the line along the rod, if that is positive: the angle between the two is at least
    π/2 − θ − arctan(|h|/r). An arm begins at the rim of the hub like the rod, and the distance there is the least.
    """
    body = certificate["body"]
    if body is None:
        return ""
    for i, (x, y, height) in enumerate(body["rotors"]):
        from_axis, height = math.hypot(x, y), abs(height)
        disc = (from_axis - body["disc_radius"]) * math.cos(theta) - height * math.sin(theta) - body["rod_radius"]
        between = math.pi / 2 - theta - math.atan2(height, from_axis)
        arm = 2 * body["hub_radius"] * math.sin(between / 2) - body["arm_radius"] - body["rod_radius"]
        for part, gap in (("disc", disc), ("arm", arm)):
            if not (theta < math.pi / 2 and gap > GAP):
                return f"the rod may touch {part} {i + 1}: it leans by up to {math.degrees(theta):.3g} degrees"
    return ""
