"""A learned law: a small network from the state, seen in the body frame, to rotor forces. See `laws.policy`.

Its wrench is one that the rotors can give, so that allocation changes nothing. Policies come from `flypend learn`.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from importlib import resources
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import casadi as ca

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import Scalar, Vector, norm, smooth_norm
from flypend.laws.bound import Computer, Control, computer_of
from flypend.laws.gain import DELAY_REACH, NOT_NEGATIVE, Bounds, Gain, check_gravity, document_gains, table
from flypend.laws.law import Law
from flypend.laws.policy import Policy, features, load, shares
from flypend.laws.references import Reference, hover
from flypend.laws.throw import derivatives
from flypend.model import State, Vehicle, Wrench

FOLDER = resources.files("flypend") / "policies"
USUAL, SHIPPED, ON_HUB = "usual", "hehn2011", "hehn2011-hub"
# In rod lengths: farther off, the network is shown a place at this distance, in the same direction, and flies home from
# there. On a gimbal it was trained nearer; on a hub flights to 19 rod lengths succeed, which are left as they are.
REACH, REACH_ON_HUB = 4.0, 20.0
LEAST_SHARE = 0.02  # of its range: what a rotor keeps to both limits in hover, whatever the estimated forces

GAINS = table(
    (
        Gain("policy", USUAL, doc="Name of a shipped policy, or a file of `flypend learn` (.npz); usual: by mount"),
        Gain(
            "lead", lambda v: 2.1 if v.rotor_lag > 0 else 1.0, "",
            "Rotors are commanded f̂ + lead (f − f̂), where f̂ is their modelled force", Bounds(low=1.0),
        ),
        Gain("observer", 1.5, "1/s", "Bandwidth of the external-force observer; 0 for none", NOT_NEGATIVE),
        Gain("latency", 0.0, "s", "Delay that the flight computer compensates by prediction", NOT_NEGATIVE),
        Gain("delay_reach", 0.06, "s", DELAY_REACH, NOT_NEGATIVE),
    )
)  # fmt: skip


@errors.named_arguments
@document_gains(GAINS, ", there is no such policy, or it is for another number of rotors")
def learned(reference: Reference | None = None, **gains: Any) -> Law:
    """Build the learned law."""
    followed = reference or hover()

    def control(
        t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, forces: tuple[Vector, Vector]
    ) -> Control:
        """The learned law about the reference, which it is shown at most `k.reach` rod lengths away."""
        return learned_control(t, state, vehicle, k.network, forces, followed, k.reach)

    return Law(
        name="learned", e3="up", gains=GAINS, given=gains, control=control, prepare=_prepare, reference=followed,
        computer=_computer,
        uses_forces=True,
    )  # fmt: skip


def _computer(gains: Mapping[str, Any]) -> Computer:
    """Return the flight computer settings for these `gains`: the network was trained behind the rotors' lag."""
    return computer_of({**gains, "models_lag": True})


def _prepare(vehicle: Vehicle, gains: Any) -> dict[str, Any]:
    check_gravity(vehicle)
    usual = ON_HUB if vehicle.mount == "hub" else SHIPPED
    network = policy(usual if gains["policy"] == USUAL else gains["policy"])
    if len(network.D) != len(vehicle.rotor_spins):
        raise InputError("vehicle", f"one with {len(network.D)} rotors, like the policy", f"{len(vehicle.rotor_spins)}")
    return {"network": network, "reach": REACH_ON_HUB if vehicle.mount == "hub" else REACH}


def policy_names() -> list[str]:
    """Return the names of the policies shipped with the package."""
    return sorted(entry.name.removesuffix(".npz") for entry in FOLDER.iterdir() if entry.name.endswith(".npz"))


def policy(name: str) -> Policy:
    """Return the policy `name` shipped with the package, or that of the file `name` (.npz). Raises InputError."""
    if name.endswith(".npz"):
        return load(Path(name))
    return _read_shipped(errors.one_of("policy", name, policy_names()))


@lru_cache(maxsize=8)
def _read_shipped(name: str) -> Policy:
    with resources.as_file(FOLDER / f"{name}.npz") as path:
        return load(path)


def learned_control(
    t: Scalar,
    state: State,
    vehicle: Vehicle,
    network: Policy,
    forces: tuple[Vector, Vector],
    reference: Reference,
    reach: float,
) -> Control:
    """Evaluate the `network` for symbols `t` (s) and `state` of `vehicle` about its `reference`.

    It is shown no place farther off than `reach`, in rod lengths.

    Of the external `forces` on vehicle and bob, each (3, 1), N, the vertical part is carried: hover then takes less or
    more than the weight.
    """
    x_ref = reference(t)
    x, x_dot = state.x - x_ref, state.x_dot - ca.densify(derivatives(x_ref, t, 1)[0])
    far = reach * vehicle.l
    x = x * far / ca.fmax(smooth_norm(x, 1e-6 * far), far)
    phi = features(state, x, x_dot, vehicle.l, ca.sqrt(vehicle.l / vehicle.g))
    low, high = vehicle.rotor_limits
    level = (vehicle.weight - forces[0][2] - forces[1][2]) / len(vehicle.rotor_spins)
    hover_share = ca.fmin(ca.fmax((level - low) / (high - low), LEAST_SHARE), 1 - LEAST_SHARE)
    rotors = low + (high - low) * shares(network.asked(phi), hover_share)
    wrench = ca.mtimes(vehicle.mixing(), rotors)
    return Control(wrench=Wrench(wrench[0], wrench[1:]), signals={"position_error": norm(x)})
