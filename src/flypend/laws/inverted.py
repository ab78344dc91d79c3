"""The inverted law: throw the bob up, flip the rod below it, balance, and hold a position or follow a reference.

The world has e₃ up. The bob p = x + l y is itself a thrust vehicle, with the rod as its thrust axis. With F the force
on the quadrotor, F_v and F_b the external forces on vehicle and bob, and D = F_b/m − F_v/M,

    p̈ = −g e₃ + F_b/m + a y,          (M+m) a = F·y − M l |ẏ|² − M D·y
    ÿ + |ẏ|² y = u,                    l u = P_y (D − F/M),             P_y v = −y × (y × v)

so F = −M l u + ((M+m) a + M l |ẏ|²) y + M D gives any desired u and a. The paper's law lacks the component along y.
The result is a cascade: position → desired rod direction d → F → desired thrust axis z_d → moment.

docs/laws/inverted.md derives it line by line.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any, NamedTuple

import casadi as ca

from flypend import errors
from flypend.geometry import E1, E3, Scalar, Vector, apply, cross, dot, norm, scale, smooth_norm, tangent_part
from flypend.laws.axis import DAMPING, axis_moment, braking_force, gyroscopic_lead, spin_of
from flypend.laws.bound import Control, computer_of
from flypend.laws.course import DERIVATIVES, HELD, Course, at_rest, motion, rate_along
from flypend.laws.gain import document_gains
from flypend.laws.inverted_gains import GAINS, angular_authority, calm, go_together, scales
from flypend.laws.law import Law
from flypend.laws.passage import FREE, Passage, heading, passage_of, steer
from flypend.laws.references import Path, Reference, hover
from flypend.laws.smooth import soft
from flypend.laws.sphere import ANTIPODE_FLOOR, velocity_error
from flypend.laws.throw import (
    Bob,
    Demand,
    Pose,
    Rod,
    bob_path,
    coast,
    demand,
    derivatives,
    largest_thrust,
    lift,
    limit_force,
    low_rod,
    rod_force,
    steering_force,
)
from flypend.model import Disturbance, State, Vehicle, Wrench, disturbed_motion, lie_derivative
from flypend.model.altered import Altered

# ε in the thrust axis's target F + ε (M+m) g e₃, which points along e₃ where the desired force F vanishes (free fall).
AXIS_LIFT = 0.028
# s, in weights, of the target's smoothed length √(|·|² + s²): the target stays smooth even where that sum vanishes.
# Both are small compared with hover, where |F| is one weight; both were tuned with the other parameters on hehn2011.
AXIS_FLOOR = 0.006
# Largest angle, rad, between a rod being caught and the force demanded: short of the rotor plane on a hub; on a cup, a
# share of the cone.
HUB_CONE, CUP_SHARE = 1.4, 0.8
# Length, rad, of the turn demanded at the antipode of the thrust axis's target, where its spring vanishes.
ANTIPODE_PUSH = 0.03
# Largest rate demanded of the thrust axis, in units of √α: the vehicle stops from it within TURN²/2 rad.
TURN = 1.3
# Errors of the rod, its rate in √(g/l), and velocity in √(g l), at which half of the calm is left: some ten times those
# of hover on noisy sensors, and small beside those of a catch, whose excursion calm gains would enlarge.
NEAR = (0.12, 0.2, 0.35)
# Rotors that follow a fast spin are at their limits, where no lead helps: the body turns on for this multiple of their
# lag, chosen among 0.4 to 2 by how many spins of 20 to 40 rad/s recover.
SPIN_LAG = 1.3


@errors.named_arguments
@document_gains(GAINS, "; and from `bind`, if the bandwidths are not separated")
def inverted(reference: Reference | None = None, **gains: float | str) -> Law:
    """Build the inverted law about a `reference` for the pivot. Gains not given follow from the vehicle."""
    followed = reference or hover()
    return Law(
        name="inverted", e3="up", gains=GAINS, given=gains, control=inverted_control, computer=computer_of,
        uses_forces=True, reference=followed, path=bob_path(followed), check=go_together, prepare=_prepare, calm=calm,
    )  # fmt: skip


def nearness(state: State, x_dot_ref: Vector, y_ref: Vector, vehicle: Vehicle) -> Scalar:
    """Return how near the motion is to its reference: 1 there, 1/2 where one error has its size in `NEAR`."""
    rod, swing, drift = state.y - y_ref, state.y_dot, state.x_dot - x_dot_ref
    far = (
        dot(rod, rod) / NEAR[0] ** 2
        + dot(swing, swing) * vehicle.l / vehicle.g / NEAR[1] ** 2
        + dot(drift, drift) / (vehicle.g * vehicle.l) / NEAR[2] ** 2
    )
    return 1 / (1 + far)


class Mounting(NamedTuple):
    """What the law takes from the vehicle besides gains.

    passage : Passage, optional
        Where the rod may cross the rotor plane of a hub; None for a rod that may pass anywhere.
    cone : float, optional
        Largest angle between a rod being caught and the force on the vehicle, rad; None for no limit.
    side : float
        1 if the side of the rotor plane on which the rod is decides whether it is too low, else 0.
    rotor_lag, lag_left : float
        Lag of the rotors, and what is left of it after their lead, s.
    haste : float
        Relative rise of the attitude bandwidth while the rod is thrown.
    shift : float
        Sideways component added to the direction demanded of a rod that hangs, which moves it off its rest.
    """

    passage: Passage | None
    cone: float | None
    side: float
    rotor_lag: float
    lag_left: float
    haste: float
    shift: float


def _prepare(vehicle: Vehicle, gains: Mapping[str, Any]) -> dict[str, Any]:
    hub = vehicle.mount == "hub"
    cones = {"gimbal": None, "hub": HUB_CONE}
    numbers = scales(vehicle).numbers
    mounting = Mounting(
        passage=passage_of(vehicle) if hub else None,
        cone=cones[vehicle.mount] if vehicle.mount in cones else CUP_SHARE * vehicle.body.cup_angle,
        side=float(hub),
        rotor_lag=vehicle.rotor_lag,
        lag_left=SPIN_LAG * vehicle.rotor_lag if gains["delay_reach"] else vehicle.rotor_lag / gains["lead"],
        haste=numbers["haste"],
        shift=numbers["shift"],
    )
    return {"mounting": mounting, "calming": {}}


def inverted_control(
    t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, forces: tuple[Vector, Vector], *, path: Path
) -> Control:
    """Evaluate the law for symbols `t` (s) and `state`, with the gains `k` of `inverted`.

    `forces` are the estimated external forces on vehicle and bob, each (3, 1), N; `path` is the path of pivot and bob.
    On noisy sensors `k.calming` has factors of gains, which act near the path.
    """
    if not k.calming:
        return _cascade(t, state, vehicle, k, forces, path)
    near = ca.SX.sym("near")  # held constant while rates are derived
    calmed = {name: (1 + near * (ratio - 1)) * getattr(k, name) for name, ratio in k.calming.items()}
    found = _cascade(t, state, vehicle, SimpleNamespace(**{**vars(k), **calmed}), forces, path)
    x_ref, _, y_ref = path(t, vehicle, forces[1])
    share = nearness(state, derivatives(x_ref, t, 1)[0], y_ref, vehicle)
    values = [found.wrench.thrust, found.wrench.moment, *found.signals.values()]
    f, moment, *signals = ca.substitute(values, [near], [share])
    return Control(wrench=Wrench(f, moment), signals=dict(zip(found.signals, signals, strict=True)))


def _cascade(
    t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, forces: tuple[Vector, Vector], path: Path
) -> Control:
    """Evaluate the law as `inverted_control` does, with gains that are the same everywhere."""
    x_ref, p_ref, y_ref = path(t, vehicle, forces[1])
    p = [ca.densify(value) for value in (p_ref, *derivatives(p_ref, t, DERIVATIVES))]
    ideal = motion(p, vehicle) if ca.depends_on(p[2], t) else None

    def bob_at(rod: Rod, course: Course) -> Bob:
        return course.bob(state.x, state.x_dot, rod, vehicle.l)

    def force(rod: Rod, course: Course, pose: Pose) -> Vector:
        return course.force + rod_force(bob_at(rod, course), rod, pose, forces, vehicle, k)

    # The thrust axis serves the rod after it has coasted for the time that the axis takes to turn. So does the thrust
    # of a vehicle that flips its rod; that of one that pumps serves the rod as it is.
    rod = Rod(state.y, state.y_dot)
    times = k.coast_time, (1 - k.pump_share) * k.coast_time
    ahead, nearer = (coast(rod, time) for time in times)
    path_ahead, path_nearer = (HELD.coast(time, vehicle) if ideal else at_rest(p) for time in times)
    low, steering, height = low_rod(ahead, state.z, path_ahead.up, k), FREE, state.x[2] - x_ref[2]
    if k.mounting.passage is not None:
        caught = force(ahead, path_ahead, Pose(0, height, E1, 1))
        caught = scale(1 / smooth_norm(caught, AXIS_FLOOR * vehicle.weight), caught)
        steering = steer(state, heading(state, ahead.y, caught, k.coast_time), k.mounting.passage)
    # Held constant while ż_d is derived, since the rate of ω, on which it depends, is not known yet.
    clear = ca.SX.sym("clear")
    authority = angular_authority(vehicle)
    spin = spin_of(state, vehicle, authority, TURN * ca.sqrt(authority), k.mounting.rotor_lag)
    calm, brake = spin.calm, (1 - spin.calm) * braking_force(state, vehicle)
    pose = Pose(low, height, steering.aside, clear)
    present = force(nearer, path_nearer, pose._replace(low=low_rod(nearer, state.z, path_nearer.up, k)))
    f = ca.fmin(ca.fmax(dot(calm * present + brake, state.z), 0), spin.thrust * largest_thrust(vehicle))
    wrench = Wrench(f, ca.SX.sym("moment", 3))
    # Observed forces are those on the equivalent point bob and its mass at the pivot: the rod shares none of them out.
    point_bob: Any = Altered(vehicle, rod_inertia=0.0)
    rates = disturbed_motion(state, wrench, point_bob, "up", Disturbance(*forces))

    def axis(turned: Vector) -> Vector:
        return lift(turned, k.tilt_limit) + AXIS_LIFT * vehicle.weight * (HELD.z if ideal else E3)

    def rate(wanted: Vector) -> Vector:
        found = lie_derivative(wanted, state, rates, t)
        return found + rate_along(wanted, ideal[1]) if ideal else found

    if k.form == "light":
        # Differentiate with the demand's own rate held constant: its direction turns steadily, ω̇_d = 0.
        bob = bob_at(ahead, path_ahead)
        wish = demand(bob, ahead, low, forces[1], vehicle, k)
        held = Demand(*(ca.SX.sym(name, 3) for name in Demand._fields))
        wanted = axis(path_ahead.force + steering_force(held, bob.v[2], ahead, pose, forces, vehicle, k))
        turning = ca.vertcat(held.A_dot, cross(held.omega_d, held.d))
        wanted_dot = rate(wanted) + ca.jtimes(wanted, ca.vertcat(held.A, held.d), turning)
        wanted, wanted_dot = ca.substitute([wanted, ca.densify(wanted_dot)], list(held), list(wish))
    else:
        wanted = axis(force(ahead, path_ahead, pose))
        wanted_dot = rate(wanted)
    f, wanted, wanted_dot = ca.substitute([f, wanted, ca.densify(wanted_dot)], [clear], [calm * steering.clear])
    wanted, wanted_dot = calm * wanted + brake, calm * wanted_dot
    per_length = 1 / smooth_norm(wanted, AXIS_FLOOR * vehicle.weight)
    # From here on in the body frame, where z = e₃ and half of what follows is zero. ż_d is known up to a component
    # along z_d, which the transport map of Lemma 2 annihilates.
    z_d, z_d_dot = (apply(state.R.T, scale(per_length, v)) for v in (wanted, wanted_dot))
    z_dot = cross(state.omega, E3)
    fed = k.rate_feedforward * z_d_dot
    if ideal:
        fed = fed + (1 - k.rate_feedforward) * apply(state.R.T, ideal[1].z)
    v_e = velocity_error(E3, z_dot, z_d, fed)
    # Length 2 sin(θ/2), with θ the angle between z and z_d, up to near the antipode θ = π, where it drops to 0.
    spring = scale(1 / ca.sqrt((1 + z_d[2]) / 2 + ANTIPODE_FLOOR), tangent_part(E3, z_d))
    spring = spring + ANTIPODE_PUSH * ((1 - z_d[2]) / 2) ** 4 * E1
    # Faster while the rod is thrown: what counts then is agility, and in hover the margin against delay.
    bandwidth = k.attitude_bandwidth * (1 + k.mounting.haste * low)
    stiffness, damping = bandwidth**2, 2 * k.attitude_damping * bandwidth
    # Turn no faster than the vehicle can stop; the bare spring would turn it at stiffness / damping per radian.
    pull = stiffness * limit_force(spring, spin.rate * damping / stiffness)
    u_z = pull - damping * v_e
    u_z = calm * u_z + (1 - calm) * soft(u_z, DAMPING * spin.acceleration)

    # What is left of the rotors' lag turns a spinning body on before they act.
    yaw = steering.yaw - k.yaw_damping * state.omega[2]
    turned = -calm * k.mounting.lag_left * state.omega[2]
    moment = axis_moment(state, vehicle, u_z, yaw, turned=turned, compensated=calm)
    moment = moment + gyroscopic_lead(state, vehicle, pull / damping, 1 - calm)
    if ideal:
        f, moment, z_d = ca.substitute([f, moment, z_d], list(HELD), list(ideal[0]))
    signals = {"rod_error": norm(state.y - y_ref), "axis_error": norm(E3 - z_d)}
    return Control(wrench=Wrench(f, moment), signals=signals)
