"""Theorem C: the largest set {V ≤ c, |ω₃| ≤ w} on which the law of Theorem B or D keeps every rotor in its limits."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.building import built
from flypend.errors import InputError
from flypend.files.whole import whole_file
from flypend.geometry import E3, Numbers, Scalar, cross, dot, hat
from flypend.laws import certificate as checker
from flypend.laws.almost_global_bounds import farthest, stands
from flypend.laws.almost_global_gains import axis_step, rod_step
from flypend.laws.bound import COMPUTER, BoundLaw
from flypend.laws.chart import LAGGED, SIZE, law_at
from flypend.laws.closed_loop import COMMANDS, WRENCH, symbolic_loop, wrench_in
from flypend.laws.guarantee import least_distance, list_unmodelled
from flypend.laws.step import Step
from flypend.model import State, Vehicle, Wrench
from flypend.model.momenta import angular_acceleration
from flypend.model.state import SIZE as PACKED

BODY = ("M", "m", "l", "g")
# The yaw rate takes this share of the room between hover and the limits, and is at most 1 rad/s.
YAW_SHARE, MOST_YAW = 0.05, 1.0
# The search for c begins at SOME l g, which most vehicles come near, or where the linear part of the forces uses LINEAR
# of the room; it ends in vain below LEAST l g. It aims at the share AIM, which is taken to grow like the power STEEP of
# c until two are known. CLOSE is the ratio of what is not proved to what is; APART that of two points of a secant.
SOME, LINEAR, LEAST, AIM, STEEP, CLOSE, APART = 9e-3, 0.785, 1e-9, 0.97, 4.5, 1.05, 1.03
# Points of the chart, |ξ_i| < REACH, at which a program is compared with ours and with the law; largest relative
# differences. The first is some hundred roundoffs; the second leaves room for moments that cancel.
POINTS, REACH, SAME, SAME_LAW = 20, 0.5, 1e-12, 1e-9


@dataclass(frozen=True, eq=False)
class CertifiedSet:
    """A set of states that the law does not leave, and in which it asks no rotor for more or less than it can give.

    It is {V ≤ c, |ω₃| ≤ w}, at every heading. The law is `almost_global` about a reference at rest, without lag; every
    flight that begins in the set converges, limits or not (Theorem C, docs/laws/theorem-proof.md). For
    `almost_global_lag` it is a set of states and rotor forces: V is V', |η_α3| ≤ k_yaw w, and every rotor gives a
    force within its limits, too. On a hub the rod touches nothing in the set.

    Parameters
    ----------
    c : float
        Largest V, m²/s².
    yaw_rate : float
        w, rad/s.
    extent : dict
        How far it reaches along one error while the others vanish: `bob` and `height` (m, of the bob's position),
        `speed` (m/s, of the bob), `rod` and `axis` (degrees, to their targets), `rod_rate`, `axis_rate` and `yaw_rate`
        (rad/s, of their errors). Through a lag also `thrust` (N) and `acceleration` (rad/s², of the vehicle's
        rotation): errors of what acts.
    law : BoundLaw
        The law.
    certificate : dict
        What `flypend.laws.certificate` checks.
    """

    c: float
    yaw_rate: float
    extent: dict[str, float]
    law: BoundLaw
    certificate: dict[str, Any]

    def __repr__(self) -> str:
        """Return c, the vehicle and the extent in one line."""
        sizes = ", ".join(f"{name} {value:.3g}" for name, value in self.extent.items())
        return f"<CertifiedSet of {self.law.name} on {self.law.vehicle.name}: V <= {self.c:.3g}; {sizes}>"

    def contains(self, state: State, rotors: Any = None) -> Any:
        """Whether `state`, single or a batch, lies in the set: a bool, or an array of them. e₃ is up.

        `rotors` are the forces of the n rotors, N, (n,) or one row for each state: those of a law through a lag, else
        None. Raises InputError for others.
        """
        # Computed in double precision: a margin far above its roundoff.
        inside = np.all(self.ratios(state, self._wrench(rotors)) <= 1 - 1e-9, axis=-1)
        if rotors is not None:  # six rotors can give a small wrench by large forces
            low, high = self.law.vehicle.rotor_limits
            inside = inside & np.all((low <= np.asarray(rotors)) & (np.asarray(rotors) <= high), axis=-1)
        return inside if state.batch_shape else bool(inside)

    def ratios(self, state: State, wrench: Any = None) -> NDArray[np.float64]:
        """Return V/c and |ω₃|/w, and through a lag |η_α3|/(k_yaw w), (..., 2 or 3): at most 1 in the set.

        `wrench` (4,) or (..., 4) is the one that acts, thrust (N) and moment (N m): that of a law through a lag, else
        None.
        """
        packed = state.packed()
        if wrench is not None:
            packed = np.concatenate([packed, np.broadcast_to(wrench, (*packed.shape[:-1], WRENCH))], axis=-1)
        found: NDArray[np.float64] = np.array(self._ratios(packed.reshape(-1, packed.shape[-1]).T)).T
        return found.reshape(*packed.shape[:-1], -1)

    def _wrench(self, rotors: Any) -> NDArray[np.float64] | None:
        vehicle = self.law.vehicle
        if self.law.uses_wrench:
            forces = errors.array("rotors", rotors, (len(vehicle.rotor_spins),), batch=True)
            return np.asarray(forces @ vehicle.mixing().T)
        if rotors is not None:
            raise InputError("rotors", "None: without lag their forces are as commanded", "forces")
        return None

    @cached_property
    def _ratios(self) -> ca.Function:
        """`ratios` of packed states, with the wrench that acts through a lag, (24 or 28, n)."""
        lag, law = self.law.uses_wrench, self.law
        t, s = ca.SX.sym("t"), ca.SX.sym("s", PACKED + WRENCH * lag)
        state, acting = State.symbolic(s[:PACKED]), wrench_in(s) if lag else None
        V = sum(law.evaluate(t, state, law.vehicle, acting=acting).lyapunov.values())
        found = ratios(V, state, acting, law.vehicle, law.gains["yaw_damping"], self.c, self.yaw_rate)
        return ca.Function("ratios", [s], [ca.cse(ca.densify(ca.substitute(found, t, 0)))])

    def save(self, path: str | Path) -> None:
        """Write the certificate to the file `path`, as JSON; `python -m flypend.laws.verify` checks it."""
        with whole_file(path, (".json",)) as whole:
            whole.write_text(json.dumps(self.certificate), encoding="utf-8")


def ratios(
    V: Scalar, state: State, acting: Wrench | None, vehicle: Vehicle, yaw_damping: Scalar, c: Scalar, w: Scalar
) -> Numbers:
    """Return V/c and |ω₃|/w, and |η_α3|/(k_yaw w) of the wrench `acting` through a lag: (2 or 3, 1), in CasADi."""
    found = [V / c, ca.fabs(state.omega[2]) / w]
    if acting is not None:
        alpha = angular_acceleration(acting.moment, state.omega, vehicle)
        found.append(ca.fabs(alpha[2] / yaw_damping + state.omega[2]) / w)
    return ca.vertcat(*found)


def certified_set(law: BoundLaw) -> CertifiedSet:
    """Return the largest set that is proved for `law`, within 5 % of c.

    Takes seconds, and through a lag some ten. Raises InputError if the theorem does not cover the law's vehicle
    or reference, or nothing can be proved.
    """
    missing = list_unmodelled(law.vehicle, on_hub=True)
    if missing:
        raise InputError("law.vehicle", "one that the theorem models", missing)
    if law.reference is None or not stands(law.reference):
        raise InputError("law.reference", "one at rest", "one that moves")
    found = statement(law)
    found["c"] = c = _search(json.dumps(found))
    if not c:
        raise InputError("law", "gains for which some c can be proved", f"none down to c = {_least(found):g} m²/s²")
    return CertifiedSet(c, found["w"], _extent(law, c, found["w"]), law, found)


def _least(found: dict[str, Any]) -> float:
    return float(LEAST * found["numbers"]["l"] * found["numbers"]["g"])


@lru_cache(maxsize=8)  # a basin, its hand-over and its report each ask for the same set
def _search(stated: str) -> float:
    """Return the largest c that is proved for a `statement`, given as JSON, within 5 %; 0 if there is none."""
    found = json.loads(stated)
    least = _least(found)
    proved, refused, c, before = 0.0, math.inf, _guess(found, SOME / LEAST * least), None
    while c >= least and CLOSE * proved < refused:
        share = _share(found, c)
        proved, refused = (max(proved, c), refused) if share <= 1 else (proved, min(refused, c))
        if not share < math.inf:
            c = math.sqrt(proved * c) if proved else c / 4
            continue
        # A secant in logarithms.
        slope = max(0.5, math.log(share / before[1]) / math.log(c / before[0])) if before else STEEP
        following = c * min(4.0, max(0.25, (AIM / share) ** (1 / slope)))
        if share <= 1 and not before:
            following = max(following, APART * c)
        if share <= 1 and before and following <= CLOSE * c:
            break
        before = c, share
        c = following if proved < following < refused else min(CLOSE * proved, math.sqrt(proved * refused))
    return proved


def _guess(found: dict[str, Any], most: float) -> float:
    """Return a c, at most `most`, at which the linear part of the forces uses `LINEAR` of the room at ω₃ = 0."""
    tiny, numbers = 1e-6 * most, found["numbers"]
    chart, k = chart_function(tuple(numbers)), list(numbers.values())
    ends = np.diag(checker.radii(numbers, tiny))  # so near that differences are the linear part
    forth, back = (np.array([np.array(chart(xi, k)[0]).ravel() for xi in side]) for side in (ends, -ends))
    middle, slopes = (forth + back)[0] / 2, (forth - back).T / 2
    models = [(checker.Polynomial(float(a), l), 0.0) for a, l in zip(middle, slopes, strict=True)]
    share = _largest(found, checker.ranges_of(found, tiny, 0.0, checker.split(models)))
    return min(most, tiny * (LINEAR / share) ** 2)


def _share(found: dict[str, Any], c: float) -> float:
    """Return the largest share of the room between hover and a limit that a rotor's force may use; ∞ if unbounded."""
    try:
        answer = checker.evaluate_program(found, c)
    except checker.NotProvedError:
        return math.inf
    ranges = checker.ranges_of(found, c, found["w"], answer)
    share = _largest(found, ranges)
    refused = checker.outside(found, ranges) or checker.name_touch(found, checker.lean(answer))
    return max(1.0 + 1e-9, share) if refused else share


def _largest(found: dict[str, Any], ranges: list[tuple[float, float]]) -> float:
    """Return which share of the room between a middle force and the limits the widest of the `ranges` uses."""
    low, high = found["limits"]
    used = [(most - least) / min(least + most - 2 * low, 2 * high - least - most) for least, most in ranges]
    return float(max(used))


def statement(law: BoundLaw) -> dict[str, Any]:
    """Return a certificate for `law` without its c: numbers, limits, and the program of the law in the chart."""
    vehicle = law.vehicle
    gains = {name: value for name, value in law.numbers.items() if name not in COMPUTER}
    numbers = {**{name: float(getattr(vehicle, name)) for name in BODY}, **gains}
    if law.uses_wrench:
        numbers["rotor_lag"] = vehicle.rotor_lag
    operations, outputs = _program(tuple(numbers))
    unmixing, limits = vehicle.unmixing(), [float(limit) for limit in vehicle.rotor_limits]
    hover = unmixing[:, 0] * vehicle.weight
    room = float(min(np.min(hover - limits[0]), np.min(limits[1] - hover)))
    if room <= 0:
        raise InputError("vehicle.rotor_limits", "forces beyond those of hover, both ways", limits)
    costs = float(numbers["yaw_damping"] * np.max(np.abs(unmixing[:, 1:] @ vehicle.I[:, 2])))
    return {
        "format": "flypend certificate 1", "law": law.name, "vehicle": vehicle.name, "numbers": numbers,
        "parameters": list(numbers), "inertia": np.array(vehicle.I).tolist(), "unmixing": unmixing.tolist(),
        "limits": limits, "w": min(MOST_YAW, YAW_SHARE * room / costs) if costs else MOST_YAW,
        "operations": operations, "outputs": outputs, "body": _solid(vehicle),
    }  # fmt: skip


def _solid(vehicle: Vehicle) -> dict[str, Any] | None:
    """Return what the rod must not touch, m: rotors (n, 3) from the pivot, and radii. None if it may pass anywhere."""
    if vehicle.mount != "hub":
        return None
    radii = {name: getattr(vehicle.body, name) for name in ("disc_radius", "arm_radius", "hub_radius", "rod_radius")}
    return {"rotors": vehicle.rotors_from_pivot.tolist(), **radii}


@built(maxsize=8)
def chart_function(names: tuple[str, ...]) -> ca.Function:
    """Return (ξ, numbers) → f and u of each wrench, ż, y·z, and p − p_ref, v, y, ẏ, z (15,) of the law in the chart.

    The law is the one through a lag if "rotor_lag" is among the `names` of the numbers.
    """
    values = ca.SX.sym("k", len(names))
    k = SimpleNamespace(**{name: values[i] for i, name in enumerate(names)})
    lag = getattr(k, "rotor_lag", None)
    xi = ca.SX.sym("xi", SIZE if lag is None else LAGGED)
    found = law_at(xi, k, k.M, k.m, k.l, k.g, lag)
    return ca.Function(
        "chart", [xi, values],
        [
            ca.densify(ca.vertcat(*found.wrenches, found.axis_rate, dot(found.rod, found.axis))),
            ca.densify(ca.vertcat(*found[2:])),
        ],
        {"cse": True},
    )  # fmt: skip


_NAMES = {
    ca.OP_ADD: "add", ca.OP_SUB: "sub", ca.OP_MUL: "mul", ca.OP_NEG: "neg", ca.OP_SQRT: "sqrt", ca.OP_SQ: "mul",
    ca.OP_TWICE: "add", ca.OP_INPUT: "input",
}  # fmt: skip


class _Operations:
    """Operations (name, places of arguments, constant), each once, with their places."""

    def __init__(self) -> None:
        self.places: dict[tuple[str, tuple[int, ...], float], int] = {}

    def put(self, name: str, arguments: list[int], value: float = 0.0) -> int:
        """Return the place of an operation."""
        if name in ("add", "mul"):
            arguments = sorted(arguments)
        return self.places.setdefault((name, tuple(arguments), value), len(self.places))

    def divide(self, above: list[int], below: int) -> int:
        """Return the place of a quotient, of 1 if nothing is `above`: many share a denominator."""
        inverse = self.put("div", [self.put("constant", [], 1.0), below])
        return self.put("mul", [*above, inverse]) if above else inverse


@built(maxsize=8)
def _program(names: tuple[str, ...]) -> tuple[list[Any], list[int]]:
    """Return the wrenches, ż and y·z of the chart as operations [name, places, constant], and the places of these."""
    function = chart_function(names).slice("law", [0, 1], [0]).expand()
    made, work, outputs = _Operations(), dict[int, int](), [0] * function.nnz_out(0)
    for i in range(function.n_instructions()):
        code, taken, given = (
            function.instruction_id(i), function.instruction_input(i), function.instruction_output(i)
        )  # fmt: skip
        if code == ca.OP_OUTPUT:
            if given[0] == 0:
                outputs[given[1]] = work[taken[0]]
            continue
        arguments = list(taken) if code == ca.OP_INPUT else [work[slot] for slot in taken]
        if code == ca.OP_CONST:
            work[given[0]] = made.put("constant", [], float(function.instruction_constant(i)))
        elif code in (ca.OP_INV, ca.OP_DIV):
            work[given[0]] = made.divide(arguments[:-1], arguments[-1])
        else:
            work[given[0]] = made.put(_NAMES[code], arguments * (2 if code in (ca.OP_SQ, ca.OP_TWICE) else 1))
    return [[name, list(places), value] for name, places, value in made.places], outputs


def differs(certificate: dict[str, Any], law: BoundLaw) -> str:
    """Return in what a certificate is not one of `law`, in one line; empty if it is.

    Numbers are compared exactly. The program, another reading of the law, is compared with the law itself at random
    states of the chart.
    """
    own = statement(law)
    for key in ("law", "vehicle", "numbers", "parameters", "inertia", "unmixing", "limits", "body"):
        if certificate[key] != own[key]:
            return f"its {key} is not that of the law"
    program, numbers = chart_function(tuple(own["numbers"])), list(own["numbers"].values())
    worst, apart, rng = 0.0, 0.0, np.random.default_rng(0)
    loop = symbolic_loop(law.vehicle, law, lag=law.uses_wrench)
    command = [loop.signals[name] for name in COMMANDS] if law.uses_wrench else [loop.wrench.thrust, loop.wrench.moment]
    wrench = ca.Function("w", [loop.s], [ca.vertcat(*command)])
    for _ in range(POINTS):
        xi = rng.uniform(-REACH, REACH, program.size1_in(0))
        with np.errstate(all="ignore"):
            asked = _run(certificate, xi, numbers)
        fresh, place = (np.array(part).ravel() for part in program(xi, numbers))
        worst = np.maximum(worst, np.max(np.abs(asked - fresh)) / np.max(np.abs(fresh)))  # keeps what is no number
        state = _state(place, asked[-4:-1], law)
        command_here, *acting = _wrenches(asked, state, law)
        found = np.array(wrench(np.concatenate([state.packed(), *acting]))).ravel()
        scale = np.linalg.norm(command_here[1:]) + 1e-6 * law.vehicle.weight * law.vehicle.l
        off = np.abs(command_here - found) / np.array([law.vehicle.weight, scale, scale, scale])
        apart = np.maximum(apart, np.max(off))
    if worst <= SAME and apart <= SAME_LAW:  # false where either is not a number
        return ""
    return f"its program differs from the law by {np.maximum(worst, apart):.2g}"


def _run(certificate: dict[str, Any], xi: Any, numbers: Any, sqrt: Callable[[Any], Any] = math.sqrt) -> NDArray[Any]:
    """Return what the program of `certificate` answers to numbers, of any kind that has a `sqrt`."""
    two: dict[str, Callable[..., Any]] = {
        "add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b, "div": lambda a, b: a / b,
        "neg": lambda a: -a, "sqrt": sqrt,
    }  # fmt: skip
    values: list[Any] = []
    for name, places, number in certificate["operations"]:
        if name == "input":
            values.append((xi, numbers)[places[0]][places[1]])
        elif name == "constant":
            values.append(type(numbers[0])(number))
        else:
            values.append(two[name](*(values[place] for place in places)))
    return np.array([values[place] for place in certificate["outputs"]])


def _state(place: NDArray[np.float64], z_dot: NDArray[np.float64], law: BoundLaw) -> State:
    """Return the state at a `place` of the chart, with the least heading and ω₃ = 0."""
    p, v, y, y_dot, z = place.reshape(5, 3)
    K, l = hat(cross(E3, z)), law.vehicle.l
    R = np.eye(3) + K + K @ K / (1 + z[2])
    assert law.reference is not None
    x_ref = np.array(ca.DM(law.reference(0.0))).ravel()
    flat = R.T @ z_dot
    return State(x=x_ref + p + l * (E3 - y), x_dot=v - l * y_dot, R=R, omega=(-flat[1], flat[0], 0.0), y=y, y_dot=y_dot)


def _wrenches(asked: NDArray[np.float64], state: State, law: BoundLaw) -> list[NDArray[np.float64]]:
    """Return thrust and moment (4,) of each (f, u) in what the program answers, at a `state` without yaw rate."""
    I, omega, lag = np.array(law.vehicle.I), state.omega, law.vehicle.rotor_lag
    gyroscopic = cross(omega, I @ omega)
    turns = [cross(E3, state.R.T @ u) for u in (asked[1:4], asked[5:8])[: 1 + law.uses_wrench]]
    moments = [I @ turn + gyroscopic for turn in turns]
    if law.uses_wrench:
        moments[0] += lag * (cross(turns[1], I @ omega) + cross(omega, I @ turns[1]))
    return [np.append(asked[4 * i], moment) for i, moment in enumerate(moments)]


def _extent(law: BoundLaw, c: float, w: float) -> dict[str, float]:
    k = SimpleNamespace(**law.gains)

    def angle(step: Step) -> float:
        return math.degrees(2 * math.acos(math.sqrt(least_distance(c, step) / 2)))  # 1 + cos φ = 2 cos²(φ/2)

    extent = {
        "bob": farthest(c, k.position_stiffness, k.position_reach),
        "height": farthest(c, k.height_stiffness, k.height_reach),
        "speed": math.sqrt(2 * c),
        "rod": angle(rod_step(k)),
        "axis": angle(axis_step(k)),
        "rod_rate": math.sqrt(2 * c / k.rod_weight),
        "axis_rate": math.sqrt(2 * c / k.axis_weight),
        "yaw_rate": w,
    }
    if law.uses_wrench:
        extent |= {"thrust": math.sqrt(2 * c / k.thrust_weight), "acceleration": math.sqrt(2 * c / k.moment_weight)}
    return extent
