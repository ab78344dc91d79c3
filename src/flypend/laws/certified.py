"""Theorem C: the largest set {V ≤ c, |ω₃| ≤ w} on which Theorem B's law keeps every rotor within its limits."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.errors import InputError
from flypend.files.whole import whole_file
from flypend.geometry import E3, cross
from flypend.laws.almost_global_bounds import stands
from flypend.laws.bound import BoundLaw
from flypend.laws.chart import SIZE, law_at
from flypend.laws.closed_loop import lyapunov_function, symbolic_loop
from flypend.laws.guarantee import unmodelled
from flypend.model import State

BODY = ("M", "m", "l", "g")
# The yaw rate takes this share of the room between hover and the limits, and is at most 1 rad/s.
YAW_SHARE, MOST_YAW = 0.05, 1.0
LEAST, CLOSE = 1e-9, 1.05  # c below which nothing is sought; ratio of what is not proved to what is
# Points of the chart, |ξ_i| < REACH, at which a program is compared with ours and with the law; largest relative
# differences. The first is some hundred roundoffs; the second leaves room for moments that cancel.
POINTS, REACH, SAME, SAME_LAW = 20, 0.5, 1e-12, 1e-9


@dataclass(frozen=True, eq=False)
class CertifiedSet:
    """A set of states that the law does not leave, and in which it asks no rotor for more or less than it can give.

    It is {V ≤ c, |ω₃| ≤ w}, at every heading. The law is `almost_global` about a reference at rest, without lag; every
    flight that begins in the set converges, limits or not (Theorem C, docs/laws/theorem-proof.md).

    Parameters
    ----------
    c : float
        Largest V, m²/s².
    yaw_rate : float
        w, rad/s.
    extent : dict
        How far it reaches along one error while the others vanish: `bob` and `height` (m, of the bob's position),
        `speed` (m/s, of the bob), `rod` and `axis` (degrees, to their targets), `rod_rate`, `axis_rate` and `yaw_rate`
        (rad/s, of their errors).
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

    def contains(self, state: State) -> Any:
        """Whether `state`, single or a batch, lies in the set: a bool, or an array of them. e₃ is up."""
        value = lyapunov_function(self.law.vehicle, self.law)
        assert value is not None
        packed = np.atleast_2d(state.packed())
        V = np.array(value(0.0, packed.T, [])).ravel()
        # V is computed in double precision: a margin far above its roundoff.
        inside = (self.c * (1 - 1e-9) >= V) & (np.abs(packed[:, 17]) <= self.yaw_rate)
        return inside.reshape(state.batch_shape) if state.batch_shape else bool(inside[0])

    def save(self, path: str | Path) -> None:
        """Write the certificate to the file `path`, as JSON; `python -m flypend.laws.certificate` checks it."""
        with whole_file(path, (".json",)) as whole:
            whole.write_text(json.dumps(self.certificate), encoding="utf-8")


def certified_set(law: BoundLaw) -> CertifiedSet:
    """Return the largest set that is proved for `law`, within 5 % of c.

    Raises InputError if the theorem does not cover the law's vehicle or reference, or nothing can be proved.
    """
    errors.require("flint", extra="proof", for_="law")
    from flypend.laws.certificate import check

    missing = unmodelled(law.vehicle)
    if missing:
        raise InputError("law.vehicle", "one that the theorem models", missing)
    if law.reference is None or not stands(law.reference):
        raise InputError("law.reference", "one at rest", "one that moves")
    found = statement(law)
    proved, refused = 0.0, math.inf
    c = 1e-3
    while refused > CLOSE * proved and c >= LEAST:
        if check(found | {"c": c}):
            refused = c
        else:
            proved = c
        c = math.sqrt(proved * refused) if proved and refused < math.inf else 2 * proved if proved else refused / 8
    if not proved:
        raise InputError("law", "gains for which some c can be proved", f"none down to c = {LEAST:g}")
    found["c"] = proved
    return CertifiedSet(proved, found["w"], _extent(law, proved, found["w"]), law, found)


def statement(law: BoundLaw) -> dict[str, Any]:
    """Return a certificate for `law` without its c: numbers, limits, and the program of the law in the chart."""
    vehicle = law.vehicle
    gains = {name: value for name, value in law.numbers.items() if name not in ("lead", "latency", "delay_reach")}
    numbers = {**{name: float(getattr(vehicle, name)) for name in BODY}, **gains}
    law_alone = chart_function(tuple(numbers)).slice("law", [0, 1], [0]).expand()
    operations, outputs = _program(law_alone)
    unmixing, limits = vehicle.unmixing(), [float(limit) for limit in vehicle.rotor_limits]
    hover = unmixing[:, 0] * vehicle.weight
    room = float(min(np.min(hover - limits[0]), np.min(limits[1] - hover)))
    if room <= 0:
        raise InputError("vehicle.rotor_limits", "forces beyond those of hover, both ways", limits)
    costs = numbers["yaw_damping"] * np.max(np.abs(unmixing[:, 1:] @ vehicle.I[:, 2]))
    return {
        "format": "flypend certificate 1", "law": law.name, "vehicle": vehicle.name, "numbers": numbers,
        "parameters": list(numbers), "inertia": np.array(vehicle.I).tolist(), "unmixing": unmixing.tolist(),
        "limits": limits, "w": min(MOST_YAW, YAW_SHARE * room / costs) if costs else MOST_YAW,
        "operations": operations, "outputs": outputs,
    }  # fmt: skip


def chart_function(names: tuple[str, ...]) -> ca.Function:
    """Return (ξ (14,), numbers) → f, u and ż (7,), and p − p_ref, v, y, ẏ and z (15,), of the law in the chart."""
    xi, values = ca.SX.sym("xi", SIZE), ca.SX.sym("k", len(names))
    k = SimpleNamespace(**{name: values[i] for i, name in enumerate(names)})
    found = law_at(xi, k, k.M, k.m, k.l, k.g)
    return ca.Function(
        "chart", [xi, values],
        [ca.densify(ca.vertcat(*found[:3])), ca.densify(ca.vertcat(*found[3:]))], {"cse": True},
    )  # fmt: skip


_NAMES = {
    ca.OP_ADD: "add", ca.OP_SUB: "sub", ca.OP_MUL: "mul", ca.OP_DIV: "div", ca.OP_NEG: "neg", ca.OP_SQRT: "sqrt",
}  # fmt: skip


def _program(function: ca.Function) -> tuple[list[Any], list[int]]:
    """Return the first output of `function` as operations [name, places of arguments, constant], and its places."""
    operations: list[Any] = []
    work: dict[int, int] = {}
    outputs = [0] * function.nnz_out(0)

    def put(name: str, places: list[int], value: float = 0.0) -> int:
        operations.append([name, places, value])
        return len(operations) - 1

    for i in range(function.n_instructions()):
        code, taken, given = (
            function.instruction_id(i), function.instruction_input(i), function.instruction_output(i)
        )  # fmt: skip
        if code == ca.OP_OUTPUT:
            if given[0] == 0:
                outputs[given[1]] = work[taken[0]]
            continue
        if code == ca.OP_CONST:
            work[given[0]] = put("constant", [], float(function.instruction_constant(i)))
        elif code == ca.OP_INPUT:
            work[given[0]] = put("input", list(taken))
        elif code in (ca.OP_SQ, ca.OP_TWICE):
            work[given[0]] = put("mul" if code == ca.OP_SQ else "add", [work[taken[0]]] * 2)
        elif code == ca.OP_INV:
            work[given[0]] = put("div", [put("constant", [], 1.0), work[taken[0]]])
        else:
            work[given[0]] = put(_NAMES[code], [work[slot] for slot in taken])
    return operations, outputs


def differs(certificate: dict[str, Any], law: BoundLaw) -> str:
    """Return in what a certificate is not one of `law`, in one line; empty if it is.

    Numbers are compared exactly. The program, another reading of the law, is compared with the law itself at random
    states of the chart.
    """
    own = statement(law)
    for key in ("law", "vehicle", "numbers", "inertia", "unmixing", "limits"):
        if certificate[key] != own[key]:
            return f"its {key} is not that of the law"
    value, program = lyapunov_function(law.vehicle, law), chart_function(tuple(own["numbers"]))
    assert value is not None
    numbers, rng = list(own["numbers"].values()), np.random.default_rng(0)
    worst, apart = 0.0, 0.0
    loop = symbolic_loop(law.vehicle, law)
    wrench = ca.Function("w", [loop.s], [ca.vertcat(loop.wrench.thrust, loop.wrench.moment)])
    for _ in range(POINTS):
        xi = rng.uniform(-REACH, REACH, SIZE)
        asked = _run(certificate, xi, numbers)
        fresh, place = (np.array(part).ravel() for part in program(xi, numbers))
        worst = max(worst, float(np.max(np.abs(asked - fresh)) / np.max(np.abs(fresh))))
        state = _state(place, asked[4:7], law)
        apart = max(apart, _apart(asked, np.array(wrench(state.packed())).ravel(), state, law))
    if worst <= SAME and apart <= SAME_LAW:  # false where either is not a number
        return ""
    return f"its program differs from the law by {max(worst, apart):.2g}"


def _run(certificate: dict[str, Any], xi: NDArray[np.float64], numbers: list[float]) -> NDArray[np.float64]:
    """Return what the program of `certificate` answers to numbers."""
    two: dict[str, Callable[..., float]] = {
        "add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b, "div": lambda a, b: a / b,
        "neg": lambda a: -a, "sqrt": math.sqrt,
    }  # fmt: skip
    values: list[float] = []
    for name, places, number in certificate["operations"]:
        if name == "input":
            values.append((xi, numbers)[places[0]][places[1]])
        elif name == "constant":
            values.append(number)
        else:
            values.append(two[name](*(values[place] for place in places)))
    return np.array([values[place] for place in certificate["outputs"]])


def _state(place: NDArray[np.float64], z_dot: NDArray[np.float64], law: BoundLaw) -> State:
    """Return the state at a `place` of the chart, with the least heading and ω₃ = 0."""
    p, v, y, y_dot, z = place.reshape(5, 3)
    across, l = np.cross(E3, z), law.vehicle.l
    K = np.array([[0, -across[2], across[1]], [across[2], 0, -across[0]], [-across[1], across[0], 0]])
    R = np.eye(3) + K + K @ K / (1 + z[2])
    assert law.reference is not None
    x_ref = np.array(ca.DM(law.reference(0.0))).ravel()
    flat = R.T @ z_dot
    return State(x=x_ref + p + l * (E3 - y), x_dot=v - l * y_dot, R=R, omega=(-flat[1], flat[0], 0.0), y=y, y_dot=y_dot)


def _apart(asked: NDArray[np.float64], wrench: NDArray[np.float64], state: State, law: BoundLaw) -> float:
    """Return the largest relative difference of thrust and moment, from f and u that are `asked`, and the `wrench`."""
    I, omega = np.array(law.vehicle.I), state.omega
    moment = I @ cross(E3, state.R.T @ asked[1:4]) + cross(omega, I @ omega)
    scale = np.linalg.norm(moment) + 1e-6 * law.vehicle.weight * law.vehicle.l
    return float(max(abs(asked[0] - wrench[0]) / law.vehicle.weight, np.linalg.norm(moment - wrench[1:]) / scale))


def _extent(law: BoundLaw, c: float, w: float) -> dict[str, float]:
    k = SimpleNamespace(**law.gains)

    def far(stiffness: float, reach: float) -> float:
        return reach * math.sqrt((1 + c / (stiffness * reach**2)) ** 2 - 1)

    def angle(weight: float, barrier: float) -> float:
        low, high = 0.0, math.pi / 2  # Ψ(0) > 1 ≥ c/k
        for _ in range(60):
            middle = (low + high) / 2
            cosine = math.cos(middle)
            psi = (1 - barrier) * (1 - cosine) - 2 * barrier * math.log((1 + cosine) / 2)
            low, high = (middle, high) if weight * psi <= c else (low, middle)
        return math.degrees(low)

    return {
        "bob": far(k.position_stiffness, k.position_reach),
        "height": far(k.height_stiffness, k.height_reach),
        "speed": math.sqrt(2 * c),
        "rod": angle(k.rod_weight * k.rod_stiffness, k.rod_barrier),
        "axis": angle(k.axis_weight * k.axis_stiffness, k.axis_barrier),
        "rod_rate": math.sqrt(2 * c / k.rod_weight),
        "axis_rate": math.sqrt(2 * c / k.axis_weight),
        "yaw_rate": w,
    }
