"""A policy that was trained elsewhere, as a law: a network from observations to actions of the environments.

The network comes as layers or from an ONNX file, and becomes expressions in symbols.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import Numbers, Scalar, norm
from flypend.laws.bound import Control, computer_of
from flypend.laws.gain import DELAY_REACH, NOT_NEGATIVE, Bounds, Gain, document_gains, table
from flypend.laws.law import Law
from flypend.laws.policy import ATTITUDES, moment_action, observe_state, rotor_action, thrust_action
from flypend.laws.references import Reference, hover
from flypend.laws.throw import derivatives
from flypend.model import State, Vehicle, Wrench

MOST_WEIGHTS = 30_000  # exported C holds them in flash: 120 kB of single precision


class Layer(NamedTuple):
    """W v + b (n, 1) of a vector v (k, 1), each entry then passed to an activation function.

    Parameters
    ----------
    W : (n, k)
        Weights, as those of `torch.nn.Linear`; the transpose of a kernel of JAX's libraries.
    b : (n,)
        Biases.
    activation : str
        One of `ACTIVATIONS`.
    number : float
        The number that "elu" and "leaky_relu" take.
    """

    W: Any
    b: Any
    activation: str = "identity"
    number: float = 1.0


def tanh(v: Any) -> Any:
    """Return tanh v by basic arithmetic, which any processor has and exported C may use; 3e-13 off at most.

    The seventh convergent of Lambert's continued fraction u/(1 + u²/(3 + u²/(5 + …))) for u = v/4, and twice
    tanh 2u = 2 tanh u/(1 + tanh² u). From |v| = 20 on tanh is 1 in double precision.
    """
    u = ca.fmin(ca.fmax(v, -20), 20) / 4
    s = u * u
    t = u * (135135 + s * (17325 + s * (378 + s))) / (135135 + s * (62370 + s * (3150 + 28 * s)))
    for _ in range(2):
        t = 2 * t / (1 + t * t)
    return t


def expm1_negative(v: Any) -> Any:
    """Return exp(v) − 1 for v ≤ 0, by `tanh`."""
    t = tanh(v / 2)
    return 2 * t / (1 - t)


ACTIVATIONS: Mapping[str, Callable[[Any, float], Any]] = {
    "identity": lambda v, number: v,
    "tanh": lambda v, number: tanh(v),
    "relu": lambda v, number: ca.fmax(v, 0),
    "sigmoid": lambda v, number: (1 + tanh(v / 2)) / 2,
    "softplus": lambda v, number: ca.fmax(v, 0) + ca.log(1 + ca.exp(-ca.fabs(v))),
    "softsign": lambda v, number: v / (1 + ca.fabs(v)),
    "elu": lambda v, number: ca.fmax(v, 0) + number * expm1_negative(ca.fmin(v, 0)),
    "leaky_relu": lambda v, number: ca.fmax(v, 0) + number * ca.fmin(v, 0),
}


@dataclass(frozen=True, eq=False)
class Network:
    """Layers, one after the other.

    Parameters
    ----------
    layers : sequence of Layer, or of (W, b)
        The layers.

    Raises
    ------
    InputError
        If a layer does not fit the one before, an activation is unknown, a weight is not finite, or there are more than
        `MOST_WEIGHTS`.
    """

    layers: Sequence[Layer]

    def __post_init__(self) -> None:
        if not isinstance(self.layers, Sequence) or isinstance(self.layers, str) or not len(self.layers):
            raise InputError("network", "layers (W, b), one after the other", repr(self.layers)[:80])
        checked: list[Layer] = []
        for i, given in enumerate(self.layers):
            checked.append(_check_layer(f"network.layers[{i}]", given, len(checked[-1].b) if checked else None))
        object.__setattr__(self, "layers", tuple(checked))
        if (size := sum(layer.W.size + layer.b.size for layer in checked)) > MOST_WEIGHTS:
            raise InputError("network", f"at most {MOST_WEIGHTS} weights", f"{size}")

    @property
    def inputs(self) -> int:
        """Length of what it takes."""
        return int(self.layers[0].W.shape[1])

    @property
    def outputs(self) -> int:
        """Length of what it returns."""
        return len(self.layers[-1].b)

    def __call__(self, v: Numbers) -> Numbers:
        """Return the output (outputs, 1) for `v` (inputs, 1), in CasADi."""
        for layer in self.layers:
            v = ACTIVATIONS[layer.activation](ca.mtimes(ca.DM(layer.W), v) + ca.DM(layer.b), layer.number)
        return v


def _check_layer(field: str, given: Any, before: int | None) -> Layer:
    """Return the layer `given`, which takes what the one before returns; messages begin with `field`."""
    if not isinstance(given, tuple | list) or not 2 <= len(given) <= 4:
        raise InputError(field, "(W, b) or (W, b, activation)", repr(given)[:80])
    layer = Layer(*given)
    W = errors.array(f"{field}.W", layer.W, (None, before))
    b = errors.array(f"{field}.b", layer.b, (len(W),))
    errors.one_of(f"{field}.activation", layer.activation, ACTIVATIONS)
    return Layer(W, b, layer.activation, errors.number(f"{field}.number", layer.number))


# ONNX files -----------------------------------------------------------------------------------------------------------

_AS_IS = ("Identity", "Flatten", "Cast", "Dropout")
_ACTIVATIONS = {
    "Tanh": "tanh", "Relu": "relu", "Sigmoid": "sigmoid", "Softplus": "softplus", "Softsign": "softsign",
    "Elu": "elu", "LeakyRelu": "leaky_relu",
}  # fmt: skip
_NUMBERS = {"Elu": 1.0, "LeakyRelu": 0.01}  # ONNX's defaults of the attribute alpha
_REAL = (1, 10, 11, 16)  # ONNX's numbers of the types float, float16, double and bfloat16
_BY_ENTRY: Mapping[str, Callable[[Any, Any], Any]] = {
    "Add": np.add, "Sub": np.subtract, "Mul": np.multiply, "Div": np.divide,
}  # fmt: skip
OPERATORS = ("Gemm", "MatMul", *_BY_ENTRY, *_ACTIVATIONS, "Clip", *_AS_IS, "Constant")


def read_onnx(path: Path) -> Network:
    """Return the network in the ONNX file `path`: a chain of `OPERATORS` from one input to one output.

    A last Clip is left out: it is that of the actions, from −1 to 1.

    Raises InputError if onnx is not installed (extra "onnx"), there is no such file, or it holds anything
    else.
    """
    errors.require("onnx", extra="onnx", for_="network")
    import onnx

    if not path.is_file():
        raise InputError("network", "an ONNX file that is there", str(path))
    try:
        graph = onnx.load(path).graph
        constants = {one.name: onnx.numpy_helper.to_array(one) for one in graph.initializer}
    except Exception as error:  # of protobuf, of files with weights beside it, of the types of tensors
        raise InputError("network", "an ONNX file", f"{path}: {type(error).__name__}") from None
    given = [one for one in graph.input if one.name not in constants]
    if len(given) != 1 or len(graph.output) != 1:
        raise InputError("network", "one input and one output", f"{len(given)} and {len(graph.output)} in {path}")
    sizes = given[0].type.tensor_type.shape.dim  # the last says how many numbers; 0 where the file leaves it open
    chain = _Chain(given[0].name, constants, sizes[-1].dim_value if sizes else 0)
    for node in graph.node:
        chain.add(node, {one.name: onnx.helper.get_attribute_value(one) for one in node.attribute})
    if chain.last != graph.output[0].name:
        raise InputError("network", "operators that follow one another to the output", f"another graph in {path}")
    return Network(chain.layers)


class _Chain:
    """Layers, made of operators one after the other on `width` numbers; `last` is what the last one returns."""

    def __init__(self, last: str, constants: dict[str, NDArray[Any]], width: int) -> None:
        self.last, self.constants, self.width, self.layers = last, constants, width, list[Layer]()
        self._limited = False

    def add(self, node: Any, attributes: Mapping[str, Any]) -> None:
        """Add a `node` of the graph."""
        kind = errors.one_of("network.operator", node.op_type, OPERATORS)
        if kind == "Constant":
            import onnx

            if "value" not in attributes:
                raise InputError("network", "constants that are tensors", f"a constant of {', '.join(attributes)}")
            self.constants[node.output[0]] = onnx.numpy_helper.to_array(attributes["value"])
            return
        others = self._constants_of(kind, node)
        if kind == "Clip":
            self._limited = [np.ravel(other).tolist() for other in others] == [[-1.0], [1.0]]
            if not self._limited:
                raise InputError("network", "a Clip from −1 to 1 at the end", "another one")
        elif kind in _ACTIVATIONS:
            self._activate(_ACTIVATIONS[kind], float(attributes.get("alpha", _NUMBERS.get(kind, 1.0))))
        elif kind == "Cast" and attributes.get("to") not in _REAL:
            raise InputError("network", "a Cast to real numbers", f"one to type {attributes.get('to')} of ONNX")
        elif kind not in _AS_IS:
            self._map(kind, node.input[0] == self.last, others, attributes)
        self.last = node.output[0]

    def _constants_of(self, kind: str, node: Any) -> list[Any]:
        """Return the constants that a `node` takes beside what the last one returns."""
        if list(node.input).count(self.last) != 1 or self._limited:
            raise InputError("network", "operators that follow one another", f"{kind} of something else, or twice")
        others = [self.constants.get(name) for name in node.input if name != self.last]
        if any(other is None or np.iscomplexobj(other) for other in others):
            raise InputError("network", f"constants beside the input of {kind}", "what is computed, or not real")
        if kind in ("Gemm", "MatMul", *_BY_ENTRY) and not others:
            raise InputError("network", f"a constant beside the input of {kind}", "none")
        return others

    def _activate(self, activation: str, number: float) -> None:
        if not self.layers or self.layers[-1].activation != "identity":
            raise InputError("network", f"a linear operator before {activation}", "none")
        self.layers[-1] = self.layers[-1]._replace(activation=activation, number=number)

    def _map(self, kind: str, first: bool, others: Sequence[Any], attributes: Mapping[str, Any]) -> None:
        """Add a linear operator: as a layer, or to the last one, if that has no activation yet."""
        if kind in ("Gemm", "MatMul"):
            turned = attributes.get("transA", 0) or not first
            W = np.asarray(others[0], dtype=float)
            if W.ndim != 2 or turned:
                raise InputError("network", f"{kind} of a row and a matrix", "another order")
            W = attributes.get("alpha", 1.0) * (W if attributes.get("transB", 0) else W.T)
            b = attributes.get("beta", 1.0) * np.ravel(others[1]) if len(others) > 1 else np.zeros(1)
            if b.size not in (1, len(W)):
                raise InputError("network", f"{kind} with {len(W)} biases", f"{b.size}")
            self._append(W, np.broadcast_to(b, len(W)))
            return
        value = np.ravel(np.asarray(others[0], dtype=float))
        if not self.layers:
            width = max(value.size, self.width)  # one number may hold for all
            self._append(np.eye(width), np.zeros(width))
        last = self.layers[-1]
        if last.activation != "identity":
            last = Layer(np.eye(len(last.b)), np.zeros(len(last.b)))
            self.layers.append(last)
        if kind == "Div" and not first:
            raise InputError("network", "Div by a constant", "Div of a constant")
        if value.size not in (1, len(last.b)):
            raise InputError("network", f"{kind} with {len(last.b)} numbers", f"{value.size}")
        change = _BY_ENTRY[kind]
        if kind in ("Mul", "Div"):
            factor = np.broadcast_to(change(1.0, value), len(last.b))
            self.layers[-1] = last._replace(W=factor[:, None] * last.W, b=factor * last.b)
        else:
            sign = 1.0 if first or kind == "Add" else -1.0
            b = change(last.b, value) if first or kind == "Add" else change(value, last.b)
            self.layers[-1] = last._replace(W=sign * last.W, b=b)

    def _append(self, W: Any, b: Any) -> None:
        """Add the layer W v + b, joined with the last one if that has no activation."""
        last = self.layers[-1] if self.layers else None
        if last is not None and last.activation == "identity" and W.shape[1:] == last.b.shape:
            self.layers[-1] = Layer(W @ last.W, W @ last.b + b)
        else:
            self.layers.append(Layer(W, b))


# The law --------------------------------------------------------------------------------------------------------------

GAINS = table(
    (
        Gain("action", "rotors", doc="What the policy commands: `action` of the environment",
             choices=("rotors", "wrench")),
        Gain(
            "lead", 1.0, "",
            "Rotors are commanded f̂ + lead (f − f̂), where f̂ is their modelled force; 1 as in the environments",
            Bounds(low=1.0),
        ),
        Gain("latency", 0.0, "s", "Delay that the flight computer compensates by prediction", NOT_NEGATIVE),
        Gain("delay_reach", 0.0, "s", DELAY_REACH, NOT_NEGATIVE),
    )
)  # fmt: skip


@errors.named_arguments
@document_gains(GAINS)
def trained(network: str | Path | Sequence[Any], reference: Reference | None = None, **gains: Any) -> Law:
    """Build a law from a policy that was trained in `flypend.envs`, or in worlds of the same convention.

    The network gets what an environment with `observe="state"` shows: position and velocity of the pivot relative to
    the reference, m and m/s, the columns of R (9 numbers; 6 with `attitude="6d"`), the angular velocity in the body
    frame, rad/s, and the rod's direction and rate, 1/s, in the world frame with e₃ up: 24 or 21 numbers. With
    `attitude="body"` it gets 18, all in the body frame, with the vertical (3) for the attitude. It returns an action,
    which is limited to [−1, 1]: a number per rotor, from its least to its largest force, or thrust and moments.

    Parameters
    ----------
    network : str, Path or sequence
        An ONNX file (extra "onnx"), whose operators are `laws.trained.OPERATORS`; or the layers, each
        (W (n, k), b (n,)) or (W, b, activation), as in `laws.trained.Layer`.
    reference : callable, optional
        Pivot position (3,), m, as a CasADi function of time; default hover at the origin. See `laws.references`.
    **gains : float or str
        Any of the gains below, in the stated unit.

    {gains}

    Raises
    ------
    InputError
        If the file holds no suitable network, a shape does not fit, a weight is not finite, or a gain is unknown or out
        of range. `bind` raises it if the network is for another number of rotors.
    """
    from_file = isinstance(network, str | Path)
    layers: Any = network
    known = read_onnx(Path(layers)) if from_file else Network(layers)
    if known.inputs not in ATTITUDES:
        wanted = 'one of 24, 21 or 18 observations (observe="state" of the environment)'
        raise InputError("network", wanted, f"one of {known.inputs}")
    followed = reference or hover()

    def control(t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace) -> Control:
        """The network on the state relative to the reference, as its environment showed it."""
        x_ref = followed(t)
        x, x_dot = state.x - x_ref, state.x_dot - ca.densify(derivatives(x_ref, t, 1)[0])
        seen = observe_state(State(**(vars(state) | {"x": x, "x_dot": x_dot})), ATTITUDES[known.inputs])
        action = ca.fmax(ca.fmin(known(seen), 1), -1)
        return Control(wrench=_wrench(action, vehicle, k.action), signals={"position_error": norm(x)})

    return Law(
        name=Path(str(network)).stem if from_file else "trained", e3="up", gains=GAINS, given=gains, control=control,
        prepare=partial(_check_outputs, known.outputs), reference=followed, computer=computer_of,
    )  # fmt: skip


def _wrench(action: Any, vehicle: Vehicle, kind: str) -> Wrench:
    if kind == "wrench":
        return Wrench(thrust_action(action[0], vehicle), moment_action(action[1:], vehicle))
    wrench = ca.mtimes(vehicle.mixing(), rotor_action(action, vehicle))
    return Wrench(wrench[0], wrench[1:])


def _check_outputs(outputs: int, vehicle: Vehicle, gains: Mapping[str, Any]) -> dict[str, Any]:
    wanted = len(vehicle.rotor_spins) if gains["action"] == "rotors" else 4
    if outputs != wanted:
        raise InputError("network", f"{wanted} actions, for {vehicle.name}", f"{outputs}")
    return {}
