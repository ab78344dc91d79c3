"""The law that really inverts: throw the bob up, flip the rod under it, balance, and hold or follow a position.

World with e₃ up. The bob p = x + l y is itself a thrust vehicle whose thrust axis is the rod: with F the force on the
quadrotor, D = F_b/m − F_v/M and F_v, F_b external forces on vehicle and bob,

    p̈ = −g e₃ + F_b/m + a y,          (M+m) a = F·y − M l |ẏ|² − M D·y
    ÿ + |ẏ|² y = u,                    l u = P_y (D − F/M),             P_y v = −y × (y × v)

so u and a can be chosen freely by F = −M l u + ((M+m) a + M l |ẏ|²) y + M D. The part along y is the one that the
paper's law lacks. A cascade follows: position → desired rod direction d → F → desired thrust axis z_d → moment.

docs/laws/inverted.md derives it line by line.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import casadi as ca

from flypend import errors
from flypend.geometry import E3, apply, cross, dot, norm, scale, smooth_norm, tangent_part
from flypend.laws.inverted_gains import BOUNDS, Gains, computer_of, gains_for
from flypend.laws.law import Control, Law
from flypend.laws.references import Path, Reference, hover
from flypend.laws.sphere import velocity_error
from flypend.laws.throw import (
    Demand,
    carrying,
    coasted,
    demand,
    derivatives,
    largest_thrust,
    lifted,
    limited_force,
    rod_force,
    steering_force,
)
from flypend.model import State, Vehicle, Wrench, disturbed_motion, lie_derivative

FORMS = ("full", "light")


def inverted(reference: Reference | None = None, *, form: str = "full", **gains: float) -> Law:
    """The inverted law, about a `reference` of the pivot, with the gains of `gains_for` unless given.

    Parameters
    ----------
    reference : callable, optional
        Position (3,) of the pivot as a CasADi function of time, m; default hover at the origin. See `laws.references`.
    form : "full" or "light"
        "light" turns the target of the axis with a demand whose direction turns steadily, without the second derivative
        of the demand: three quarters of the operations, for processors that are short of time.
    **gains : float
        Any field of `Gains`, in its unit; the others are proposed for the vehicle that flies.

    Raises
    ------
    InputError
        For an unknown gain or form, a gain out of range, or bandwidths that are not separated.
    """
    errors.one_of("form", form, FORMS)
    errors.only_known("", gains, BOUNDS)
    given = {name: errors.number(name, value, at_least=BOUNDS[name]) for name, value in gains.items()}
    options = {} if form == "full" else {"form": form}

    @cache
    def for_vehicle(vehicle: Vehicle) -> Law:
        followed = reference or hover()
        return _law(gains_for(vehicle, **given), options, followed, carrying(followed))

    return Law(name="inverted", e3="up", gains={**given, **options}, control=_unbound, for_vehicle=for_vehicle)


def _unbound(*_: Any) -> Control:
    raise TypeError("the inverted law takes its gains from the vehicle: use law.bound(vehicle)")


def _law(gains: Gains, options: dict[str, str], reference: Reference, path: Path) -> Law:
    def control(t: Any, state: State, vehicle: Vehicle, k: Any, forces: tuple[Any, Any]) -> Control:
        return inverted_control(t, state, vehicle, k, path, forces, light="form" in options)

    return Law(
        name="inverted",
        e3="up",
        gains={**vars(gains), **options},
        control=control,
        computer=computer_of(gains),
        uses_forces=True,
        reference=reference,
        along=lambda other: _law(gains, options, reference, other),
        fixed=("thrust_coast_share", "pump_share"),
    )


def inverted_control(
    t: Any,
    state: State,
    vehicle: Vehicle,
    k: Gains,
    path: Path,
    forces: tuple[Any, Any],
    *,
    light: bool = False,
) -> Control:
    """The law for symbols of `t` (s) and `state`.

    `vehicle` and gains `k` as in `inverted`; `path` is what pivot and bob follow; `forces` are the estimated external
    forces on vehicle and bob, each (3, 1), N; `light` chooses the form.
    """
    z, z_dot = state.z, apply(state.R, cross(state.omega, E3))
    x_ref, p_ref, y_ref = path(t, vehicle, forces[1])
    v_ref, a_ref, jerk_ref = derivatives(p_ref, t, 3)
    height = state.x[2] - x_ref[2]

    def errors_at(y: Any, y_dot: Any) -> tuple[Any, Any]:
        return state.x + vehicle.l * y - p_ref, state.x_dot + vehicle.l * y_dot - v_ref

    def force(y: Any, y_dot: Any) -> Any:
        return rod_force(*errors_at(y, y_dot), a_ref, jerk_ref, y, y_dot, height, forces, vehicle, k)

    # The axis is for the rod after coasting over the time that turning takes; the thrust after a share of it, the
    # whole of which makes both forces one.
    ahead = coasted(state.y, state.y_dot, k.coast_time)
    present = force(*coasted(state.y, state.y_dot, k.thrust_coast_share * k.coast_time))
    f = ca.fmin(ca.fmax(dot(present, z), 0), largest_thrust(vehicle))
    wrench = Wrench(f, ca.SX.sym("moment", 3))
    rates = disturbed_motion(state, wrench, vehicle, "up", force_on_vehicle=forces[0], force_on_bob=forces[1])

    def axis(turned: Any) -> Any:
        return lifted(turned, k.tilt_limit) + 0.028 * vehicle.weight * E3  # ε e₃: off zero

    if light:  # the demand is held while the rest is differentiated, and its direction turns steadily: ω̇_d = 0
        e, v = errors_at(*ahead)
        wish = demand(e, v, a_ref, jerk_ref, *ahead, vehicle.g * E3 - forces[1] / vehicle.m, k)
        held = Demand(*(ca.SX.sym(name, 3) for name in Demand._fields))
        wanted = axis(steering_force(held, v[2], *ahead, height, forces, vehicle, k))
        turning = ca.vertcat(held.A_dot, cross(held.omega_d, held.d))
        wanted_dot = lie_derivative(wanted, state, rates, t) + ca.jtimes(wanted, ca.vertcat(held.A, held.d), turning)
        wanted, wanted_dot = ca.substitute([wanted, ca.densify(wanted_dot)], list(held), list(wish))
    else:
        wanted = axis(force(*ahead))
        wanted_dot = lie_derivative(wanted, state, rates, t)
    per_length = 1 / smooth_norm(wanted, 0.006 * vehicle.weight)
    # ż_d up to a part along z_d, which the transport of Lemma 2 does not see.
    z_d, z_d_dot = scale(per_length, wanted), scale(per_length, wanted_dot)
    v_e = velocity_error(z, z_dot, z_d, k.rate_feedforward * z_d_dot)
    spring = scale(1 / ca.sqrt((1 + dot(z, z_d)) / 2 + 0.014), tangent_part(z, z_d))  # 2 sin(θ/2), to 0 only at θ = π
    stiffness, damping = k.attitude_bandwidth**2, 2 * k.attitude_damping * k.attitude_bandwidth
    # No faster than the vehicle can stop: the spring alone would turn it at stiffness / damping per radian.
    u_z = stiffness * limited_force(spring, k.turn_rate * damping / stiffness) - damping * v_e

    # z̈ = −|ż|² z + u_z with R ω̇ = z × u_z across z, the paper's (setmu) solved for ω̇; the yaw rate is damped.
    turn = apply(state.R.T, cross(z, u_z) + state.omega[2] * z_dot)
    alpha = ca.vertcat(turn[0], turn[1], -k.yaw_damping * state.omega[2])
    moment = apply(vehicle.I, alpha) + cross(state.omega, apply(vehicle.I, state.omega))
    signals = {"rod_error": norm(state.y - y_ref), "axis_error": norm(z - z_d)}
    return Control(wrench=Wrench(f, moment), signals=signals)


inverted.gains_for = lambda vehicle: vars(gains_for(vehicle)).copy()  # type: ignore[attr-defined]
inverted.known_gains = (*BOUNDS, "form")  # type: ignore[attr-defined]
