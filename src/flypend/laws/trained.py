"""A policy that was trained elsewhere, as a law: a network from observations to actions of the environments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import casadi as ca

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import Scalar, norm
from flypend.laws.bound import Control, computer_of
from flypend.laws.gain import DELAY_REACH, NOT_NEGATIVE, Bounds, Gain, document_gains, table
from flypend.laws.law import Law
from flypend.laws.network import Network, read_onnx
from flypend.laws.references import Reference, hover
from flypend.laws.seen import ATTITUDES, moment_action, observe_state, rotor_action, thrust_action
from flypend.laws.throw import derivatives
from flypend.model import State, Vehicle, Wrench

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
        An ONNX file (extra "onnx"), whose operators are `laws.network.OPERATORS`; or the layers, each
        (W (n, k), b (n,)) or (W, b, activation), as in `laws.network`.
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
