"""Friction of the joint, and a rod that spins: against the Lagrangian of the whole rod, Newton and Euler, MuJoCo."""

import casadi as ca
import mujoco
import numpy as np
import pytest

import flypend as fp
from flypend import geometry as geo
from flypend.compile.numeric import as_numpy
from flypend.compile.program import lower
from flypend.model import equations_of_motion, total_energy
from flypend.model.joint import CREEP, friction, on_rod, stiffness, swing
from flypend.model.mjcf import model_xml
from flypend.model.motion import Disturbance, disturbed_motion
from flypend.plants import Plant
from flypend.plants.actuation import make_engine
from flypend.plants.equations import rotor_step

ROUNDOFF = 1e-11  # sums of some ten products of order up to 1e3, eps each
ENGINES = pytest.mark.parametrize("engine", ["equations", "mujoco"])
ROD = fp.rod_with_bob(0.03, 0.9, 0.05)
PLAIN = fp.vehicle("hehn2011").replace(**ROD)
RUBBING = PLAIN.replace(pivot_damping=2e-3, pivot_friction=5e-3)
SPINNING = PLAIN.replace(rod_spin=40.0, rod_spin_inertia=4e-4)
BOTH = RUBBING.replace(rod_spin=-60.0, rod_spin_inertia=3e-4, pivot_offset=(0.02, -0.01, 0.04))
MACHINES = {"rubbing": RUBBING, "spinning": SPINNING, "both, pivot off centre": BOTH}


def spin_of(vehicle):
    return vehicle.rod_spin * vehicle.rod_spin_inertia


def motion(state, wrench, vehicle):
    torque = friction(state, vehicle) if vehicle.rubs else None
    joint = Disturbance(pivot_offset=vehicle.pivot_offset, joint_torque=torque, spin=spin_of(vehicle))
    return disturbed_motion(state, wrench, vehicle, "up", joint)


# Euler-Lagrange on SO(3) × SO(3): the rod is a body with an attitude of its own --------------------------------------


def residual_function(vehicle):
    """Residual of the Euler-Lagrange equations of vehicle R and rod Q, both rotations, for accelerations given.

    Nothing of `flypend.model` is used. Variations are R Σ̂ and Q Ŝ, so that d/dt ∂L/∂ω + ω × ∂L/∂ω, less what L changes
    by the variation itself, is the torque in the frame of each body.
    """
    v, w, W, a, alpha, A = (ca.SX.sym(name, 3) for name in ("v", "omega", "rod omega", "a", "alpha", "rod alpha"))
    R, Q, f, tau, joint = (
        ca.SX.sym("R", 3, 3),
        ca.SX.sym("Q", 3, 3),
        ca.SX.sym("f"),
        ca.SX.sym("tau", 3),
        ca.SX.sym("j", 3),
    )
    x, g, o = ca.SX.sym("x", 3), vehicle.gravity, ca.DM(vehicle.pivot_offset)
    along = ca.diag(ca.DM([vehicle.rod_inertia, vehicle.rod_inertia, vehicle.rod_spin_inertia]))
    tip = ca.DM([0, 0, vehicle.rod_length])

    def lagrangian(x, v, R, w, Q, W):
        c, c_dot = x - R @ o, v - R @ ca.cross(w, o)
        b, b_dot = x + Q @ tip, v + Q @ ca.cross(W, tip)
        kinetic = vehicle.mass * ca.sumsqr(c_dot) + ca.dot(ca.DM(vehicle.inertia) @ w, w)
        kinetic += vehicle.bob_mass * ca.sumsqr(b_dot) + ca.dot(along @ W, W)
        return kinetic / 2 - g * (vehicle.mass * c[2] + vehicle.bob_mass * b[2])

    small, eps = ca.SX.sym("small", 3), ca.SX.zeros(3)
    L = lagrangian(x, v, R, w, Q, W)
    state, rates = ca.vertcat(x, v, ca.vec(R), w, ca.vec(Q), W), None
    rates = ca.vertcat(v, a, ca.vec(R @ ca.skew(w)), alpha, ca.vec(Q @ ca.skew(W)), A)

    def turned(of_R, of_Q):
        return ca.substitute(ca.gradient(lagrangian(x, v, of_R, w, of_Q, W), small), small, eps)

    by_R, by_Q = turned(R @ (ca.SX.eye(3) + ca.skew(small)), Q), turned(R, Q @ (ca.SX.eye(3) + ca.skew(small)))

    def ddt(p):
        return ca.jtimes(p, state, rates)

    p_v, p_w, p_W = (ca.gradient(L, of) for of in (v, w, W))
    thrust = f * R[:, 2]  # at the centre of mass c = x − R o
    r_x = ddt(p_v) - ca.gradient(L, x) - thrust
    r_R = ddt(p_w) + ca.cross(w, p_w) - by_R - (tau - ca.cross(o, R.T @ thrust)) + R.T @ joint
    r_Q = ddt(p_W) + ca.cross(W, p_W) - by_Q - Q.T @ joint
    inputs = [x, v, R, w, Q, W, f, tau, joint, a, alpha, A]
    return ca.Function("residual", inputs, [ca.vertcat(r_x, r_R, r_Q)])


@pytest.mark.parametrize("name", MACHINES)
def test_the_equations_are_those_of_the_lagrangian_of_the_whole_rod(name):
    vehicle, rng = MACHINES[name], np.random.default_rng(4)
    residual, spin = residual_function(vehicle), vehicle.rod_spin
    for state in fp.State.random(rng, 20):
        wrench = fp.Wrench(rng.uniform(-10, 10), 0.1 * rng.standard_normal(3))
        rates = motion(state, wrench, vehicle)
        y, u, b = state.y, state.y_dot, rates.y_ddot
        Q = np.column_stack([*np.linalg.svd(y[None])[2][1:], y])
        Q[:, 0] *= np.linalg.det(Q)  # any frame of the rod with y as its third axis
        W = Q.T @ (np.cross(y, u) + spin * y)
        A = Q.T @ (np.cross(y, b) + spin * u)  # ẇ in the frame of the rod is that of the world, turned
        found = residual(
            state.x, state.x_dot, state.R, state.omega, Q, W, wrench.thrust, wrench.moment,
            friction(state, vehicle), rates.x_ddot, rates.omega_dot, A,
        )  # fmt: skip
        assert np.max(np.abs(found.full())) < ROUNDOFF
        if spin:  # negative control
            free = motion(state, wrench, vehicle.replace(rod_spin=0.0))
            assert np.max(np.abs(free.y_ddot - b)) > 1e-2


# Friction -------------------------------------------------------------------------------------------------------


def test_friction_is_across_the_rod_against_the_swing():
    rng = np.random.default_rng(1)
    for state in fp.State.random(rng, 50):
        w, torque = swing(state), friction(state, RUBBING)
        assert abs(state.y @ w) < 1e-14 * np.linalg.norm(w) + 1e-14
        size = np.linalg.norm(torque)
        assert size == pytest.approx(
            2e-3 * np.linalg.norm(w) + 5e-3 / np.hypot(1, CREEP / np.linalg.norm(w)), rel=1e-12
        )
        assert w @ torque == pytest.approx(-size * np.linalg.norm(w), rel=1e-12)


def test_a_vehicle_that_turns_with_its_rod_feels_none():
    y, axis = np.array([0.6, 0, 0.8]), np.array([0, 1.0, 0])
    state = fp.State(y=y, y_dot=3 * np.cross(axis, y), omega=3 * axis)
    np.testing.assert_allclose(friction(state, RUBBING), 0, atol=1e-16)


def test_energy_is_lost_by_friction_alone():
    rng = np.random.default_rng(2)
    s = ca.SX.sym("s", 24)
    state = fp.State.symbolic(s)
    rates = disturbed_motion(
        state, fp.Wrench(ca.SX(0), ca.SX(3, 1)), RUBBING, "up", Disturbance(joint_torque=friction(state, RUBBING))
    )
    change = ca.jtimes(total_energy(state, RUBBING, "up"), s, rates.packed())
    power = as_numpy(ca.Function("power", [s], [change, ca.dot(friction(state, RUBBING), swing(state))]))
    for start in fp.State.random(rng, 30):
        lost, taken = power(start.packed())
        assert lost == pytest.approx(taken, abs=1e-12)
        assert lost < 0


def test_a_spin_takes_no_energy_and_keeps_the_momentum_about_the_vertical():
    """Without thrust, y₃ spin + (m l² y × ẏ)·e₃ of a rod about the centre of mass of both is constant."""
    start = fp.State(y=(0.6, 0, 0.8), y_dot=(0, 2, 0)).packed()
    machine = make_engine(SPINNING, Plant(lag=0.0))
    machine.reset(start, np.zeros(4))
    M, m, l = SPINNING.M, SPINNING.m, SPINNING.l

    def kept():
        state = fp.State.trusted(machine.packed)
        angular = M * m / (M + m) * l**2 * np.cross(state.y, state.y_dot) + spin_of(SPINNING) * state.y
        return np.append(angular, total_energy(state, SPINNING, "up"))

    before = kept()
    for _ in range(500):
        machine.step(np.zeros(4), 2e-3, np.zeros(6))
    np.testing.assert_allclose(kept(), before, rtol=0, atol=1e-8)  # of order four, |ω| h = 0.05
    plain = make_engine(PLAIN, Plant(lag=0.0))
    plain.reset(start, np.zeros(4))
    for _ in range(500):
        plain.step(np.zeros(4), 2e-3, np.zeros(6))
    assert np.linalg.norm(plain.packed[18:21] - machine.packed[18:21]) > 0.1


def test_viscous_friction_damps_a_small_swing_as_a_textbook_says():
    """A heavy vehicle that hovers: θ̈ = −(g/l) θ − c/(m l²) θ̇, of which the envelope is e^(−c t/2 m l²)."""
    vehicle = PLAIN.replace(
        mass=500.0, inertia=(5e4, 5e4, 9e4), rotor_limits=(0, 5000), pivot_damping=1e-2, rotor_lag=0.0,
        rotor_positions=10 * PLAIN.rotor_positions,
    )  # fmt: skip
    m, l = vehicle.m, vehicle.l
    # On a vehicle of finite mass the rod swings at √(g/l (M+m)/M), its inertia being that of the reduced mass.
    rate, ratio = np.sqrt(9.81 / l * (vehicle.M + m) / vehicle.M), (vehicle.M + m) / vehicle.M
    decay = 1e-2 / (2 * m * l**2) * ratio
    start = fp.State(y=(1e-3, 0, -np.sqrt(1 - 1e-6)))
    machine = make_engine(vehicle, Plant(lag=0.0))
    forces = np.full(4, vehicle.weight / 4)
    machine.reset(start.packed(), forces)
    for _ in range(2000):
        machine.step(forces, 2e-3, np.zeros(6))
    swinging = np.sqrt(rate**2 - decay**2)
    expected = 1e-3 * np.exp(-4 * decay) * (np.cos(4 * swinging) + decay / swinging * np.sin(4 * swinging))
    assert np.exp(-4 * decay) < 0.8
    assert machine.packed[18] == pytest.approx(expected, abs=2e-8)  # amplitude squared, and what turns the vehicle


# MuJoCo ----------------------------------------------------------------------------------------------------------

FORCES = np.array([1.3, 1.5, 1.2, 1.4])
TUMBLING = fp.State(x_dot=(1, -1, 0.5), omega=(2, -1, 3), y=(0.6, 0, 0.8), y_dot=(0, 2, 0))


def flown(engine, vehicle, step=2e-3):
    machine = make_engine(vehicle, Plant(engine=engine, lag=0.0))
    machine.reset(TUMBLING.packed(), FORCES)
    for _ in range(round(0.4 / step)):
        machine.step(FORCES, step, np.zeros(6))
    return machine.packed


@pytest.mark.parametrize("name", MACHINES)
def test_mujoco_agrees(name):
    vehicle = MACHINES[name].replace(rotor_lag=0.0)
    ours, theirs = flown("equations", vehicle), flown("mujoco", vehicle, 2.5e-4)
    # Its friction is held for 0.25 ms; a spin is its own, with a rod that has three moments of inertia.
    np.testing.assert_allclose(theirs, ours, rtol=0, atol=1e-5 if vehicle.rubs else 1e-7)
    plain = flown("mujoco", vehicle.replace(pivot_damping=0, pivot_friction=0, rod_spin=0))
    assert np.max(np.abs(plain - theirs)) > 1e-2


def test_a_spin_stays_in_mujoco():
    machine = make_engine(SPINNING, Plant(engine="mujoco"))
    machine.reset(TUMBLING.packed(), FORCES)
    for _ in range(800):
        machine.step(FORCES, 5e-4, np.zeros(6))
    data = machine._engine.data
    rod = data.body("bob").xmat.reshape(3, 3)
    vehicle = data.body("vehicle").xmat.reshape(3, 3)
    omega = rod @ data.qvel[6:9] + vehicle @ data.qvel[3:6]
    assert rod[:, 2] @ omega == pytest.approx(SPINNING.rod_spin, rel=1e-7)  # of its integrator, at 0.02 rad a step


def test_viscous_friction_is_the_damping_of_mujocos_own_joint():
    """Written into the model, with a rod that has little inertia about its axis: MuJoCo integrates it itself."""
    vehicle = PLAIN.replace(pivot_damping=4e-3, rotor_lag=0.0, rod_spin_inertia=1e-6)
    xml = model_xml(vehicle.replace(pivot_damping=0), timestep=1e-4, bare=True)
    xml = xml.replace('type="ball"/>', 'type="ball" damping="4e-3"/>')
    # A ball joint also damps the spin, and stops it at once: that is stiff, and takes an implicit integrator.
    model = mujoco.MjModel.from_xml_string(xml.replace("RK4", "implicitfast"))
    data = mujoco.MjData(model)
    engine = make_engine(vehicle, Plant(engine="mujoco", lag=0.0))
    engine.reset(TUMBLING.packed(), FORCES)
    data.qpos[:], data.qvel[:] = engine._engine.data.qpos, engine._engine.data.qvel
    data.ctrl[:] = FORCES
    for _ in range(4000):
        mujoco.mj_step(model, data)
    ours = flown("equations", vehicle)
    # Its implicit integrator is of first order, in steps of 0.1 ms.
    np.testing.assert_allclose(data.qpos[:3], ours[:3], rtol=0, atol=2e-3)
    rod = np.empty(9)
    mujoco.mju_quat2Mat(rod, data.body("bob").xquat)
    np.testing.assert_allclose(rod[[2, 5, 8]], ours[18:21], rtol=0, atol=2e-3)
    assert np.max(np.abs(flown("equations", vehicle.replace(pivot_damping=0))[18:21] - ours[18:21])) > 1e-2


# Vehicles --------------------------------------------------------------------------------------------------------


def test_a_free_joint_changes_no_program_and_the_ideal_plant_has_one():
    assert PLAIN.free_joint
    assert not any(vehicle.free_joint for vehicle in MACHINES.values())
    plain = lower(rotor_step(PLAIN))
    assert lower(rotor_step(PLAIN.replace(rod_spin_inertia=1e-4))) == plain  # it does not spin
    assert all(lower(rotor_step(vehicle)) != plain for vehicle in MACHINES.values())
    wrench = fp.Wrench(5.0, np.zeros(3))
    ideal = [equations_of_motion(TUMBLING, wrench, v, "up").packed() for v in (PLAIN, BOTH)]
    np.testing.assert_array_equal(*ideal)


def test_both_engines_fly_under_a_law_alike():
    """By the kernels: a rod that spins, rubs and hangs off centre, under a law that amplifies no difference."""
    law = fp.Law(
        name="steady", e3="up", control=lambda t, state, vehicle, k: fp.Wrench(vehicle.weight, -1e-2 * state.omega)
    )
    runs = []
    for engine in ("equations", "mujoco"):
        plant = Plant(engine=engine)
        runs.append(fp.simulate(BOTH, law, TUMBLING, 0.6, plant=plant))
        stepped = fp.simulate(BOTH, law, TUMBLING, 0.6, plant=plant, engine="scipy")
        np.testing.assert_allclose(runs[-1].packed, stepped.packed, rtol=0, atol=1e-8)  # sums in another order
    assert 1e-9 < np.max(np.abs(runs[0].packed - runs[1].packed)) < 1e-4
    free = fp.simulate(BOTH.replace(rod_spin=0.0), law, TUMBLING, 0.6)
    assert np.max(np.abs(free.y - runs[0].y)) > 1e-2


def test_bad_joints_are_told_in_one_line():
    for changes, words in [
        ({"pivot_damping": -1}, r"^pivot_damping: expected a finite number >= 0 N m s, got -1$"),
        ({"pivot_friction": np.inf}, r"^pivot_friction: expected a finite number >= 0 N m, got inf$"),
        ({"rod_spin": 3.0}, r"^rod_spin_inertia: expected a number > 0 for a rod that spins, got 0$"),
        (
            {"rod_spin_inertia": 1.0},
            r"^rod_spin_inertia: expected at most twice rod_inertia, as in every solid body, got",
        ),
        ({"pivot_offset": (1, 2)}, r"^pivot_offset: expected numbers of shape \(3\), got shape \(2,\)$"),
    ]:
        with pytest.raises(fp.InputError, match=words):
            PLAIN.replace(**changes)
    assert stiffness(RUBBING) < 100
    with pytest.raises(fp.InputError, match=r"^vehicle\.pivot_friction: expected friction that takes a millisecond"):
        fp.simulate(PLAIN.replace(pivot_friction=1.0), fp.laws.inverted(), TUMBLING, 0.1)


def test_the_couple_of_a_torque_is_that_torque():
    rng = np.random.default_rng(3)
    for state in fp.State.random(rng, 20):
        torque = geo.project_tangent(state.y, rng.standard_normal(3))
        P = on_rod(state, torque, 0.7, 0.4)
        np.testing.assert_allclose(0.4 * np.cross(state.y, P), torque - 0.7 * state.y_dot, atol=1e-13)


def test_the_pivot_is_where_the_mount_is():
    """Distances from the rod to the discs are those of discs moved the other way."""
    hub = fp.vehicle("hehn2011").replace(mount="hub")
    start = fp.State(y=(0.8, 0.1, np.sqrt(1 - 0.65)))
    up = hub.replace(pivot_offset=(0, 0, 0.05))
    down = hub.replace(rotor_positions=hub.rotor_positions - np.array([0, 0, 0.05]))
    runs = [fp.simulate(v, fp.laws.inverted(), start, 0.002) for v in (up, down)]
    assert runs[0].clearance[0] == pytest.approx(runs[1].clearance[0], abs=1e-12)
    assert runs[0].clearance[0] != pytest.approx(
        fp.simulate(hub, fp.laws.inverted(), start, 0.002).clearance[0], abs=1e-3
    )
