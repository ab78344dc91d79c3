"""Another checker of certificates without lag, in ball arithmetic (python-flint): nothing is rounded without a bound.

It shares no line with `flypend.laws.certificate`. Taylor models have degree 2, a + l·x + x·Qx ± r over |x| ≤ 1, and
remainders are summed from operation to operation, so that only a smaller c is proved.
"""

from functools import cached_property

from flint import arb, arb_mat

ZERO = arb(0)


class Taylor:
    """a + l·x + x·Qx ± r; l (1, n) and Q (n, n), None where they vanish."""

    def __init__(self, a, l=None, Q=None, r=ZERO):
        self.a, self.l, self.Q, self.r = a, l, Q, r.abs_upper()

    @cached_property
    def linear(self):
        """Bound on |l·x|."""
        return ZERO if self.l is None else root_of(square(self.l))

    @cached_property
    def quadratic(self):
        """Bound on |x·Qx|: the Frobenius norm."""
        return ZERO if self.Q is None else root_of((self.Q * self.Q.transpose()).trace())

    @property
    def rest(self):
        """Bound on all but a + l·x."""
        return self.quadratic + self.r

    @property
    def range(self):
        """A ball with all values."""
        return self.a + arb(0, (self.linear + self.rest).abs_upper())


def square(l):
    return (l * l.transpose())[0, 0]


def root_of(value):
    return value.abs_upper().sqrt().abs_upper()


def plus(x, y, sign=1):
    return (None if y is None else y * arb(sign)) if x is None else x if y is None else x + y * arb(sign)


def scaled(x, factor):
    return None if x is None else x * factor


def symmetric(l, m):
    if l is None or m is None:
        return None
    product = l.transpose() * m
    return (product + product.transpose()) * arb("0.5")


def add(A, B, sign=1):
    return Taylor(A.a + sign * B.a, plus(A.l, B.l, sign), plus(A.Q, B.Q, sign), A.r + B.r)


def mul(A, B):
    l = plus(scaled(A.l, B.a), scaled(B.l, A.a))
    Q = plus(plus(scaled(A.Q, B.a), scaled(B.Q, A.a)), symmetric(A.l, B.l))
    dropped = A.linear * B.quadratic + A.quadratic * (B.linear + B.quadratic)
    return Taylor(
        A.a * B.a, l, Q, dropped + A.r * B.range.abs_upper() + B.r * (A.a.abs_upper() + A.linear + A.quadratic)
    )


def compose(A, value, slope, bend, third):
    """φ(A): its value, slope and half of its second derivative at a, and a bound on |φ'''|/6 over the range."""
    Q = plus(scaled(A.Q, slope), scaled(symmetric(A.l, A.l), bend))
    r = abs(slope) * A.r + abs(bend) * A.rest * (2 * A.linear + A.rest) + abs(third) * (A.linear + A.rest) ** 3
    return Taylor(value, scaled(A.l, slope), Q, r)


def sqrt(A):
    assert A.range > 0
    f = A.a.sqrt()
    return compose(A, f, 1 / (2 * f), -1 / (8 * A.a * f), 1 / (16 * A.range**2 * A.range.sqrt()))


def inverse(A):
    assert A.range > 0 or A.range < 0
    return compose(A, 1 / A.a, -1 / A.a**2, 1 / A.a**3, 1 / A.range**4)


ANSWERS = {
    "add": add, "sub": lambda A, B: add(A, B, -1), "mul": mul, "div": lambda A, B: mul(A, inverse(B)), "sqrt": sqrt,
    "neg": lambda A: add(Taylor(ZERO), A, -1),
}  # fmt: skip


def half_axes(k, c):
    """Half axes of the ellipsoid of the chart lemma, docs/laws/theorem-proof.md, section 8."""

    def pull(stiffness, reach):
        return 2 * k[stiffness] / (2 + c / (k[stiffness] * k[reach] ** 2))

    level, upright = pull("position_stiffness", "position_reach"), pull("height_stiffness", "height_reach")
    k_y, k_z = k["rod_weight"] * k["rod_stiffness"], k["axis_weight"] * k["axis_stiffness"]
    assert c < k_y  # where the chart covers the set
    assert c < k_z
    weights = [level] * 2 + [upright] + [arb(1)] * 3 + [k_y] * 2 + [k["rod_weight"]] * 2 + [k_z] * 2
    return [(2 * c / weight).sqrt() for weight in weights + [k["axis_weight"]] * 2]


def proves(certificate, c):
    """Whether all rotor forces are within the limits on {V ≤ c, |ω₃| ≤ w} at every heading, by (C2)."""
    numbers = {name: arb(value) for name, value in certificate["numbers"].items()}
    c, w = arb(c), arb(certificate["w"])
    axes, values = half_axes(numbers, c), []
    for name, places, number in certificate["operations"]:
        if name == "constant":
            values.append(Taylor(arb(number)))
        elif name == "input" and places[0]:
            values.append(Taylor(numbers[certificate["parameters"][places[1]]]))
        elif name == "input":
            row = [axes[i] if i == places[1] else ZERO for i in range(len(axes))]
            values.append(Taylor(ZERO, arb_mat([row])))
        else:
            values.append(ANSWERS[name](*(values[place] for place in places)))
    f, *rest = (values[place] for place in certificate["outputs"])
    u, rates = rest[:3], rest[3:6]
    turn = root_of(sum((rate.range.abs_upper() ** 2 for rate in rates), ZERO))
    push = root_of(sum((part.range.abs_upper() ** 2 for part in u), ZERO))  # |k·u| for every unit vector k
    I = arb_mat([[arb(x) for x in row] for row in certificate["inertia"]])
    U = arb_mat([[arb(x) for x in row] for row in certificate["unmixing"]])
    speed, (low, high) = (turn, turn, w), certificate["limits"]
    J = [[abs(I[i, j] - (I[0, 0] if i == j else 0)) for j in range(3)] for i in range(3)]
    momentum = [sum((J[i][j] * speed[j] for j in range(3)), ZERO) for i in range(3)]
    gyroscopic = [speed[i - 2] * momentum[i - 1] + speed[i - 1] * momentum[i - 2] for i in range(3)]
    for i in range(U.nrows()):
        own = [U[i, j] for j in range(4)]
        lever = [sum((I[a, b] * own[1 + b] for b in range(3)), ZERO) for a in range(3)]
        h = root_of(lever[0] ** 2 + lever[1] ** 2)
        spin = h * w * turn + abs(lever[2]) * numbers["yaw_damping"] * w
        spin += sum((abs(own[1 + j]) * gyroscopic[j] for j in range(3)), ZERO)
        force = own[0] * f.range + arb(0, (h * push + spin).abs_upper())
        if not (force > low and force < high):
            return False
    return True
