"""MuJoCo as the judge: bodies, joints and motors against the package's equations, with and without disturbances."""

import sys
from xml.etree import ElementTree

import casadi as ca
import mujoco
import numpy as np
import pytest

import flypend as fp
from flypend import geometry as geo
from flypend.compile.numeric import as_numpy
from flypend.flight.integrate import integrate
from flypend.flight.request import Tolerances
from flypend.laws.closed_loop import close_loop
from flypend.model import Disturbance, disturbed_motion, equations_of_motion, mjcf, total_energy
from flypend.model.mjcf import model_xml
from flypend.model.state import FLIP, SIZE
from flypend.plants.actuation import Actuation, make_engine
from flypend.plants.mujoco import MujocoEngine, mujoco_coordinates
from tests.few import few

VEHICLES = ["nayak2018", "hehn2011"]
UNIFORM = "uniform rod"
WITH_ROD = [*VEHICLES, UNIFORM]
OFFSET = np.array([0.03, -0.05, 0.08])  # m; a third of the arm
NOTHING = {"force_on_vehicle": np.zeros(3), "force_on_bob": np.zeros(3), "pivot_offset": np.zeros(3)}

# Accelerations are sums of some ten products of order up to 1e3 (a hundred rad/s² times a hundred), eps each.
ROUNDOFF = 1e-11


def _named(name):
    """A vehicle of the package, or hehn2011 with a uniform rod of length 2 l and the bob's mass."""
    if name != UNIFORM:
        return fp.vehicle(name)
    vehicle = fp.vehicle("hehn2011")
    return vehicle.replace(rod_inertia=vehicle.bob_mass * vehicle.rod_length**2 / 3)


def _tilted(name):
    """The vehicle with principal axes that are not those of the body."""
    vehicle = _named(name)
    Q = geo.random_rotation(np.random.default_rng(0))
    return vehicle.replace(inertia=Q @ vehicle.I @ Q.T)


def _disturbances(rng, size=()):
    return {
        "force_on_vehicle": rng.standard_normal((*size, 3)),
        "force_on_bob": 0.3 * rng.standard_normal((*size, 3)),
        "pivot_offset": OFFSET,
    }


def _wrench(rng, vehicle, size=()):
    """Up to twice the weight, and a moment for some rad/s²."""
    thrust = vehicle.weight * rng.uniform(0, 2, size)
    return fp.Wrench(thrust, geo.apply(vehicle.I, rng.uniform(-3, 3, (*size, 3))))


def _forces(vehicle, wrench):
    return vehicle.unmixing() @ np.append(wrench.thrust, wrench.moment)


def _external(disturbances):
    return {name: disturbances[name] for name in ("force_on_vehicle", "force_on_bob")}


def _fly(vehicle, start, forces, duration, timestep, disturbances=NOTHING):
    engine = MujocoEngine(vehicle.replace(pivot_offset=disturbances["pivot_offset"]), timestep=timestep)
    engine.reset(start.packed())
    external = _external(disturbances)
    for _ in range(round(duration / timestep)):
        engine.step(forces, **external)
    return engine.packed


def _integrated(motion, start, duration, *arguments):
    """The packed state after `duration` from the rates `motion(state, *arguments)`, to 1e-11."""
    packed = ca.SX.sym("s", SIZE)
    rates = motion(fp.State.symbolic(packed), *arguments)
    function = as_numpy(ca.Function("rates", [packed], [ca.densify(ca.cse(rates.packed()))]))
    run = integrate(lambda t, s: function(s), start.packed(), duration, Tolerances(rtol=1e-11))
    assert run.outcome.status == "completed"
    return run([duration])[0]


def _error(a, b):
    return np.max(np.abs(a - b))


# The derivation of `disturbed_motion` -----------------------------------------------------------------------------


def _solved(state, wrench, vehicle, disturbances):
    """ẍ, ω̇, ÿ of a rigid rod by Newton and Euler, as one linear system: nothing is eliminated by hand."""
    M, m, l, g = vehicle.mass, vehicle.bob_mass, vehicle.rod_length, np.array([0, 0, -vehicle.gravity])
    R, w, y, o = state.R, state.omega, state.y, disturbances["pivot_offset"]
    eye, zero, turn = np.eye(3), np.zeros((3, 3)), geo.hat(y)
    system = np.block(
        [  # c̈, ω̇, ÿ, P on the rod, ẍ
            [M * eye, zero, zero, eye, zero],
            [zero, vehicle.inertia, zero, geo.hat(o) @ R.T, zero],
            [zero, zero, m * l * eye, -eye, m * eye],
            [-eye, R @ geo.hat(o), zero, zero, eye],
            [zero, zero, vehicle.rod_inertia * turn + np.outer(y, y), l * turn, zero],
        ]
    )
    right = [
        M * g + wrench.thrust * R[:, 2] + disturbances["force_on_vehicle"],
        wrench.moment - np.cross(w, vehicle.inertia @ w),
        m * g + disturbances["force_on_bob"],
        R @ np.cross(w, np.cross(w, o)),
        -(state.y_dot @ state.y_dot) * y,
    ]
    solution = np.linalg.solve(system, np.concatenate(right))
    return {"x_ddot": solution[12:15], "omega_dot": solution[3:6], "y_ddot": solution[6:9]}


@pytest.mark.parametrize("name", VEHICLES)
def test_disturbed_motion_solves_the_equations_of_newton_and_euler(name):
    rng, vehicle = np.random.default_rng(1), _tilted(name)
    for state in fp.State.random(rng, 100):
        wrench, disturbances = _wrench(rng, vehicle), _disturbances(rng)
        rates = disturbed_motion(state, wrench, vehicle, "up", Disturbance(**disturbances))
        wanted = _solved(state, wrench, vehicle, disturbances)
        for field in ("x_ddot", "omega_dot", "y_ddot"):
            assert _error(getattr(rates, field), wanted[field]) < ROUNDOFF, field


@pytest.mark.parametrize("name", VEHICLES)
def test_an_extended_rod_moves_as_a_point_bob_and_a_mass_at_the_pivot(name):
    """A uniform rod of length 2 l, and a body nearly all of whose inertia is its own."""
    rng, vehicle = np.random.default_rng(7), _tilted(name)
    point = vehicle.bob_mass * vehicle.rod_length**2
    for inertia in (point / 3, 20 * point):
        rod = vehicle.replace(rod_inertia=inertia)
        for state in fp.State.random(rng, 50):
            wrench, disturbances = _wrench(rng, rod), _disturbances(rng)
            rates = disturbed_motion(state, wrench, rod, "up", Disturbance(**disturbances))
            wanted = _solved(state, wrench, rod, disturbances)
            for field in ("x_ddot", "omega_dot", "y_ddot"):
                assert _error(getattr(rates, field), wanted[field]) < ROUNDOFF, field
            free = disturbed_motion(state, wrench, vehicle, "up", Disturbance(**disturbances))
            assert _error(free.y_ddot, rates.y_ddot) > 1e-3


@pytest.mark.parametrize("e3", ["up", "down"])
@pytest.mark.parametrize("name", VEHICLES)
def test_without_disturbances_it_is_the_equations_of_motion(name, e3):
    rng, vehicle = np.random.default_rng(2), _tilted(name)
    states, wrench = fp.State.random(rng, 1000), _wrench(rng, vehicle, (1000,))
    ideal = equations_of_motion(states, wrench, vehicle, e3).packed()
    assert _error(disturbed_motion(states, wrench, vehicle, e3, Disturbance(**NOTHING)).packed(), ideal) < ROUNDOFF
    assert _error(disturbed_motion(states, wrench, vehicle, e3).packed(), ideal) < ROUNDOFF


def test_each_disturbance_counts():
    rng, vehicle = np.random.default_rng(3), fp.vehicle("hehn2011")
    state, wrench, disturbances = fp.State.random(rng), _wrench(rng, vehicle), _disturbances(rng)
    full = disturbed_motion(state, wrench, vehicle, "up", Disturbance(**disturbances)).packed()
    for name in disturbances:
        some = Disturbance(**{**disturbances, name: np.zeros(3)})
        without = disturbed_motion(state, wrench, vehicle, "up", some).packed()
        assert _error(without, full) > 0.1, name


@pytest.mark.parametrize("name", VEHICLES)
def test_power_is_what_thrust_moment_and_wind_supply(name):
    rng, vehicle = np.random.default_rng(4), _tilted(name)
    states, wrench, disturbances = fp.State.random(rng, 500), _wrench(rng, vehicle, (500,)), _disturbances(rng, (500,))
    rates = disturbed_motion(states, wrench, vehicle, "up", Disturbance(**disturbances))
    M, m, l, w = vehicle.mass, vehicle.bob_mass, vehicle.rod_length, states.omega
    g, o = np.array([0, 0, -vehicle.gravity]), np.broadcast_to(OFFSET, w.shape)
    c_dot = states.x_dot - geo.apply(states.R, np.cross(w, o))
    c_ddot = rates.x_ddot - geo.apply(states.R, np.cross(rates.omega_dot, o) + np.cross(w, np.cross(w, o)))
    p_dot, p_ddot = states.x_dot + l * states.y_dot, rates.x_ddot + l * rates.y_ddot
    gain = M * geo.dot(c_dot, c_ddot - g) + m * geo.dot(p_dot, p_ddot - g)
    gain += geo.dot(w, geo.apply(vehicle.inertia, rates.omega_dot))
    supply = wrench.thrust * geo.dot(states.z, c_dot) + geo.dot(wrench.moment, w)
    supply += geo.dot(disturbances["force_on_vehicle"], c_dot) + geo.dot(disturbances["force_on_bob"], p_dot)
    assert _error(gain, supply) < 10 * ROUNDOFF  # products of accelerations and velocities of order ten


def test_a_batch_is_its_members_and_numpy_is_casadi():
    rng, vehicle = np.random.default_rng(5), _tilted("hehn2011")
    states, wrench, disturbances = fp.State.random(rng, 20), _wrench(rng, vehicle, (20,)), _disturbances(rng, (20,))
    batch = disturbed_motion(states, wrench, vehicle, "up", Disturbance(**disturbances)).packed()
    symbols = [ca.SX.sym(name, size) for name, size in (("s", SIZE), ("w", 4), ("F_v", 3), ("F_b", 3), ("o", 3))]
    s, w, F_v, F_b, o = symbols
    wind = Disturbance(force_on_vehicle=F_v, force_on_bob=F_b, pivot_offset=o)
    symbolic = disturbed_motion(fp.State.symbolic(s), fp.Wrench(w[0], w[1:]), vehicle, "up", wind)
    function = ca.Function("rates", symbols, [symbolic.packed()])
    for k, state in enumerate(states):
        mine = {name: value if value.ndim == 1 else value[k] for name, value in disturbances.items()}
        one = fp.Wrench(wrench.thrust[k], wrench.moment[k])
        assert _error(disturbed_motion(state, one, vehicle, "up", Disturbance(**mine)).packed(), batch[k]) < ROUNDOFF
        values = function(state.packed(), np.append(one.thrust, one.moment), *mine.values())
        assert _error(np.asarray(values).ravel(), batch[k]) < ROUNDOFF


def test_the_frame_turned_by_pi_sees_the_same_motion():
    rng, vehicle = np.random.default_rng(6), fp.vehicle("nayak2018")
    states, wrench, disturbances = fp.State.random(rng, 50), _wrench(rng, vehicle, (50,)), _disturbances(rng, (50,))
    up = disturbed_motion(states, wrench, vehicle, "up", Disturbance(**disturbances))
    turned = {name: geo.apply(FLIP, value) for name, value in disturbances.items()}
    down = disturbed_motion(states.flipped(), wrench.flipped(), vehicle, "down", Disturbance(**turned))
    for field in ("x_ddot", "omega_dot", "y_ddot"):
        assert _error(geo.apply(FLIP, getattr(down, field)), getattr(up, field)) < ROUNDOFF, field


# The model that MuJoCo is given -----------------------------------------------------------------------------------


def test_the_model_has_the_masses_of_the_vehicle_and_nothing_touches():
    vehicle = _tilted("nayak2018")
    model = mujoco.MjModel.from_xml_string(model_xml(vehicle.replace(pivot_offset=OFFSET), timestep=1e-3))
    body, bob = model.body("vehicle").id, model.body("bob").id
    assert model.body_mass[body] == vehicle.M
    assert model.body_mass[bob] == vehicle.m
    assert model.body_ipos[body].tolist() == (-OFFSET).tolist()
    assert model.body_ipos[bob].tolist() == [0, 0, vehicle.l]
    axes = np.empty(9)
    mujoco.mju_quat2Mat(axes, model.body_iquat[body])
    axes = axes.reshape(3, 3)
    assert _error(axes @ np.diag(model.body_inertia[body]) @ axes.T, vehicle.I) < 1e-15
    assert np.sum(model.body_mass) == vehicle.M + vehicle.m
    assert model.ngeom > 0
    assert not np.any(model.geom_contype)
    assert not np.any(model.geom_conaffinity)
    assert not np.any(model.dof_damping)
    assert not np.any(model.dof_armature)
    assert (model.opt.density, model.opt.viscosity) == (0, 0)
    assert model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4


@pytest.mark.parametrize("seed", range(20))
def test_a_planar_body_is_accepted(seed):
    Q = geo.random_rotation(np.random.default_rng(seed))
    inertia = Q @ np.diag([1.0, 2.0, 3.0]) @ Q.T  # MuJoCo refuses a third of these as they come, for roundoff
    vehicle = fp.vehicle("nayak2018").replace(inertia=(inertia + inertia.T) / 2)
    mujoco.MjModel.from_xml_string(model_xml(vehicle, timestep=1e-3))


def test_a_rotor_at_the_centre_of_mass_is_accepted():
    vehicle = fp.vehicle("hehn2011")
    positions, spins = np.vstack([vehicle.rotor_positions, np.zeros(3)]), [*vehicle.rotor_spins, 1]
    engine = MujocoEngine(vehicle.replace(rotor_positions=positions, rotor_spins=spins))
    engine.step(np.ones(5))
    assert engine.model.nu == 5


def _accelerations(engine):
    """ẍ, ω̇ and ÿ from MuJoCo's accelerations: no integrator is involved."""
    data = engine.data
    mujoco.mj_forward(engine.model, data)
    R, R_rod = (data.body(body).xmat.reshape(3, 3) for body in ("vehicle", "bob"))
    omega, omega_dot = data.qvel[3:6], data.qacc[3:6]
    of_vehicle = R_rod.T @ R @ omega
    w = data.qvel[6:9] + of_vehicle  # of the rod, in its frame
    w_dot = data.qacc[6:9] + R_rod.T @ R @ omega_dot - np.cross(w, of_vehicle)
    axis = np.array([0, 0, 1])
    return {
        "x_ddot": data.qacc[0:3].copy(),
        "omega_dot": omega_dot.copy(),
        "y_ddot": R_rod @ (np.cross(w_dot, axis) + np.cross(w, np.cross(w, axis))),
    }


@pytest.mark.parametrize("name", WITH_ROD)
def test_accelerations_agree_for_any_rotor_forces(name):
    rng, vehicle = np.random.default_rng(7), _tilted(name)
    for state in fp.State.random(rng, 50):
        disturbances, forces = _disturbances(rng), rng.uniform(-1, 4, 4)
        engine = MujocoEngine(vehicle.replace(pivot_offset=OFFSET))
        engine.step(forces, **_external(disturbances))  # leaves forces behind, which reset has to take away
        engine.reset(state.packed())
        free = disturbed_motion(state, fp.Wrench(0.0, np.zeros(3)), vehicle, "up", Disturbance(pivot_offset=OFFSET))
        for field, value in _accelerations(engine).items():
            assert _error(value, getattr(free, field)) < 1e-9, field
        engine.data.ctrl[:] = forces
        engine.data.xfrc_applied[engine.model.body("vehicle").id, :3] = disturbances["force_on_vehicle"]
        engine.data.xfrc_applied[engine.model.body("bob").id, :3] = disturbances["force_on_bob"]
        wrench = vehicle.mixing() @ forces
        rates = disturbed_motion(state, fp.Wrench(wrench[0], wrench[1:]), vehicle, "up", Disturbance(**disturbances))
        for field, value in _accelerations(engine).items():
            # the bob's own inertia is 4e-12 of that of the rod, of accelerations up to a hundred
            assert _error(value, getattr(rates, field)) < 1e-9, field


# Motion without feedback ------------------------------------------------------------------------------------------


def _errors(name, rng, timesteps, motion, disturbed):
    """Largest difference of the states after 1 s, one row per start, one column per timestep."""
    vehicle, rows = _tilted(name) if disturbed else _named(name), []
    for start in fp.State.random(rng, 20):
        wrench, disturbances = _wrench(rng, vehicle), _disturbances(rng) if disturbed else NOTHING
        forces, symbolic = _forces(vehicle, wrench), fp.Wrench(wrench.thrust, ca.DM(wrench.moment))
        ours = _integrated(motion, start, 1.0, symbolic, vehicle, disturbances)
        rows.append([_error(_fly(vehicle, start, forces, 1.0, h, disturbances), ours) for h in timesteps])
    return np.array(rows)


@pytest.mark.parametrize("name", few(("hehn2011", UNIFORM), WITH_ROD))
def test_under_a_constant_wrench_mujoco_moves_as_the_equations_of_motion(name):
    def ideal(state, wrench, vehicle, _):
        return equations_of_motion(state, wrench, vehicle, "up")

    coarse, half, fine = _errors(name, np.random.default_rng(8), (8e-3, 4e-3, 0.5e-3), ideal, False).T
    assert np.max(coarse) < 1e-5
    assert 14 < np.median(coarse / half) < 18  # order 4: 16
    assert np.max(fine) < 1e-9  # RK4 leaves 1e-10, the bob's own inertia 3e-10


@pytest.mark.parametrize("name", few(("nayak2018", UNIFORM), WITH_ROD))
def test_under_disturbances_mujoco_moves_as_disturbed_motion(name):
    def disturbed(state, wrench, vehicle, disturbances):
        return disturbed_motion(state, wrench, vehicle, "up", Disturbance(**disturbances))

    coarse, half, fine = _errors(name, np.random.default_rng(9), (8e-3, 4e-3, 0.5e-3), disturbed, True).T
    assert np.max(coarse) < 2e-4  # moments of wind and rod turn hehn2011 by tens of rad/s
    assert 14 < np.median(coarse / half) < 18
    assert np.max(fine) < 4e-9


def test_what_remains_is_the_inertia_of_the_bob(monkeypatch):
    rng, vehicle = np.random.default_rng(10), fp.vehicle("hehn2011")
    start, wrench = fp.State.random(rng), _wrench(rng, vehicle)
    constant = fp.Wrench(wrench.thrust, ca.DM(wrench.moment))
    ours = _integrated(equations_of_motion, start, 1.0, constant, vehicle, "up")
    remainder = []
    for inertia in (4e-9, 4e-8, 4e-7):
        monkeypatch.setattr(mjcf, "BOB_INERTIA", inertia)
        remainder.append(_error(_fly(vehicle, start, _forces(vehicle, wrench), 1.0, 1e-3), ours))
    assert np.allclose(np.divide(remainder[1:], remainder[:-1]), 10, rtol=0.05)  # linear in it
    assert remainder[0] < 100 * 4e-9  # per s², at rod accelerations below a hundred rad/s²


@pytest.mark.parametrize("offset", [np.zeros(3), OFFSET], ids=["centred", "offset"])
@pytest.mark.parametrize("name", VEHICLES)
def test_energy_and_momentum_in_free_flight(name, offset):
    vehicle = _tilted(name)
    M, m, l, duration = vehicle.M, vehicle.m, vehicle.l, 5.0
    engine = MujocoEngine(vehicle.replace(pivot_offset=offset))

    def momentum():
        s = fp.State.from_packed(engine.packed)
        return M * (s.x_dot - s.R @ np.cross(s.omega, offset)) + m * (s.x_dot + l * s.y_dot)

    for start in fp.State.random(np.random.default_rng(11), 2):
        engine.reset(start.packed())
        energy, before = engine.energy(), momentum()
        if not offset.any():
            assert abs(energy - total_energy(start, vehicle, "up")) < 1e-11  # J, of one; the bob's inertia again
        for _ in range(round(duration / engine.timestep)):
            engine.step(np.zeros(4))
        # 600 J of kinetic and of potential energy and 27 N s by then: only the roundoff of 1e4 steps, 1e-13 of either
        assert abs(engine.energy() - energy) < 1e-10
        assert _error(momentum() - before, (M + m) * duration * np.array([0, 0, -vehicle.g])) < 1e-11


# The ideal closed loop --------------------------------------------------------------------------------------------

# A packed state in the frame turned by π about e₁ is this times itself.
FLIP_PACKED = np.concatenate([[1, -1, -1]] * 2 + [[1, -1, -1, -1, 1, 1, -1, 1, 1]] + [[1, -1, -1]] * 3)


def _closed_loop(vehicle, law, start, duration, timestep):
    """The packed state, in the law's frame (e₃ down), after a flight in MuJoCo under the wrench held over each step."""
    outputs, unmixing = as_numpy(close_loop(vehicle, law).outputs), vehicle.unmixing()
    engine = MujocoEngine(vehicle, timestep=timestep)
    engine.reset(start.flipped().packed())
    for k in range(round(duration / timestep)):
        control = outputs(k * timestep, FLIP_PACKED * engine.packed)
        wrench = fp.Wrench(control[0], control[1:4]).flipped()
        engine.step(unmixing @ np.append(wrench.thrust, wrench.moment))
    return FLIP_PACKED * engine.packed


@pytest.mark.parametrize("seed", [0, 1, 3])
@pytest.mark.parametrize("name", VEHICLES)
def test_the_corrected_law_flies_the_same_in_mujoco(name, seed):
    vehicle, law, duration = fp.vehicle(name), fp.laws.corrected(), 1.5
    start = fp.State.random(np.random.default_rng(seed))
    assert _error(FLIP_PACKED * start.packed(), start.flipped().packed()) < 1e-15
    run = fp.simulate(vehicle, law, start, duration, rtol=1e-10, plant="ideal")
    end = np.concatenate([np.ravel(getattr(run, field)[-1]) for field in ("x", "x_dot", "R", "omega", "y", "y_dot")])
    full, half = (_closed_loop(vehicle, law, start, duration, h) - end for h in (1e-3, 0.5e-3))
    # Holding the wrench delays it by half a step on average: the difference is of first order, and without that part of
    # second order.
    assert np.max(np.abs(full)) < 10 * 1e-3
    assert abs(np.max(np.abs(full)) / np.max(np.abs(half)) - 2) < 0.02
    assert np.max(np.abs(2 * half - full)) < 30 * 1e-3**2


# State in, state out, and what is refused -------------------------------------------------------------------------


def test_reset_and_packed_are_inverse():
    engine = MujocoEngine(_tilted("hehn2011").replace(pivot_offset=OFFSET))
    assert _error(engine.packed, fp.State(y=(0, 0, 1)).packed()) == 0
    states = fp.State.random(np.random.default_rng(12), 300, max_omega=30, max_y_dot=30)
    for state in states:
        engine.reset(state.packed())
        assert _error(engine.packed, state.packed()) < 1e-12
        mujoco.mj_kinematics(engine.model, engine.data)
        R, R_rod = (engine.data.body(name).xmat.reshape(3, 3) for name in ("vehicle", "bob"))
        np.testing.assert_allclose(R, state.R, rtol=0, atol=1e-12)  # MuJoCo's own reading of its coordinates
        np.testing.assert_allclose(R_rod[:, 2], state.y, rtol=0, atol=1e-12)
        rod = R_rod.T @ R @ state.omega + engine.data.qvel[6:9]
        assert abs(rod[2]) < 1e-12  # no spin about its own axis
        assert engine.data.time == 0


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("angle", [0, 1e-300, 1e-17, 1e-15, 1e-12, 1e-8, 1e-5])
def test_reset_near_the_poles(sign, angle):
    engine = MujocoEngine(fp.vehicle("hehn2011"))
    for turn in np.diag([1.0, 1, 1]), np.diag([1.0, -1, -1]), np.diag([-1.0, 1, -1]), np.diag([-1.0, -1, 1]):
        state = fp.State(y=(np.sin(angle), 0, sign * np.cos(angle)), y_dot=(0, 3, 0), R=turn, omega=(1, 2, 3))
        engine.reset(state.packed())
        assert _error(engine.packed, state.packed()) < 1e-14


def test_a_step_and_a_reset_leave_nothing_behind_but_the_state():
    forces, wind = np.array([1.0, 2, 1.5, 1.2]), {"force_on_vehicle": (1, 2, 3), "force_on_bob": (3, 2, 1)}
    used, fresh = (MujocoEngine(fp.vehicle("hehn2011")) for _ in range(2))
    used.reset(fp.State.random(np.random.default_rng(13)).packed())
    used.step(forces, **wind)
    fresh.reset(used.packed)
    for engine in (used, fresh):
        engine.step(forces)
    assert _error(used.packed, fresh.packed) < 1e-12
    used.step(forces, **wind)
    used.energy()
    for engine in (used, fresh):
        engine.reset(fp.State(y=(1, 0, 0)).packed())
        engine.energy()  # with the forces at rest that reset leaves
        engine.step(forces)
    assert np.array_equal(used.packed, fresh.packed)


def test_a_state_that_diverges_is_not_reset_in_silence(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # MuJoCo writes MUJOCO_LOG.TXT there
    engine = MujocoEngine(fp.vehicle("hehn2011"))
    engine.reset(fp.State(y=(0, 0, 1), x_dot=(1e11, 0, 0)).packed())
    engine.step(np.zeros(4))
    assert engine.packed[3] == 1e11


def test_what_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    vehicle = fp.vehicle("hehn2011")
    engine = MujocoEngine(vehicle, timestep=1e-3)
    assert engine.timestep == 1e-3
    before = engine.packed
    for wrong in ([1, 2, 3], [1], np.ones(5)):
        with pytest.raises(fp.InputError, match=r"^forces: expected numbers of shape \(4\), got shape "):
            engine.step(wrong)
    for bad in (np.nan, np.inf, -np.inf, 1e11):
        for arguments in (
            {"forces": [1, bad, 1, 1]},
            {"forces": [bad, -bad, 1, 1]},
            {"forces": np.ones(4), "force_on_vehicle": (0, bad, 0)},
            {"forces": np.ones(4), "force_on_bob": (0, 0, bad)},
        ):
            with pytest.raises(fp.InputError, match=r"^forces: expected finite numbers, got "):
                engine.step(**arguments)
    assert np.array_equal(engine.packed, before)
    with pytest.raises(fp.InputError, match=r"^packed state: expected a single state, got a batch of shape \(2,\)$"):
        engine.reset(fp.State.random(np.random.default_rng(0), 2).packed())
    with pytest.raises(fp.InputError, match=r"^y: expected a unit vector"):
        engine.reset(np.concatenate([fp.State(y=(0, 0, 1)).packed()[:18], np.zeros(6)]))
    with pytest.raises(fp.InputError, match=r"^timestep: expected a finite number > 0 s"):
        MujocoEngine(vehicle, timestep=0)
    for offset in ((1, 2), (0, 0, np.nan), np.zeros((2, 3))):
        with pytest.raises(fp.InputError, match=r"^pivot_offset: expected"):
            vehicle.replace(pivot_offset=offset)
    assert not list(tmp_path.iterdir())  # MuJoCo writes its warnings to MUJOCO_LOG.TXT: there were none


def test_without_mujoco_there_is_one_clear_line(monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    line = r"^plant: expected the extra mujoco \(pip install .*\), got no module mujoco$"
    with pytest.raises(fp.InputError, match=line):
        MujocoEngine(fp.vehicle("hehn2011"))
    assert model_xml(fp.vehicle("hehn2011"), timestep=1e-3).startswith("<mujoco")


def test_a_bare_model_moves_as_one_that_can_be_seen():
    """Bit by bit: geoms have neither mass nor contacts. It is what flights run, since it is faster."""
    vehicle = fp.vehicle("hehn2011")
    final = []
    for bare in (False, True):
        xml = model_xml(vehicle, timestep=2e-3, lag=vehicle.rotor_lag, bare=bare)
        model = mujoco.MjModel.from_xml_string(xml)
        assert (model.ngeom, model.nlight) == ((0, 0) if bare else (10, 1))
        data = mujoco.MjData(model)
        data.qpos[7:11] = np.cos(0.3), np.sin(0.3), 0, 0
        data.qvel[:] = np.linspace(-2, 2, model.nv)
        data.ctrl[:] = 1.0, 2.0, 1.5, 0.5
        mujoco.mj_step(model, data, nstep=250)
        final.append(np.concatenate([data.qpos, data.qvel, data.act]))
    assert np.array_equal(*final)
    assert not np.allclose(final[0][:3], 0)


@pytest.mark.parametrize("name", ["hehn2011", "crazyflie", UNIFORM])
def test_a_vehicle_as_mjcf_moves_as_our_equations(name, tmp_path):
    """The text alone, through MuJoCo's own writer, with MuJoCo's own steps; its joint off the centre of mass."""
    vehicle = _tilted(name).replace(pivot_offset=OFFSET / 10)
    commands = np.linspace(0.6, 1.1, 4) * vehicle.weight / 4
    model = mujoco.MjModel.from_xml_string(vehicle.to_mjcf(timestep=0.5e-3))
    mujoco.mj_saveLastXML(str(tmp_path / "machine.xml"), model)
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "machine.xml"))
    start = fp.State.random(np.random.default_rng(3))
    data = mujoco.MjData(model)
    coordinates = mujoco_coordinates(start.packed())
    data.qpos[:], data.qvel[:], data.ctrl[:] = coordinates[:11], coordinates[11:], commands
    mujoco.mj_step(model, data, nstep=600)
    mujoco.mj_forward(model, data)

    engine = make_engine(vehicle, fp.Plant(rate=1000.0))
    engine.reset(start.packed(), np.zeros(4))
    acting = Actuation(engine, vehicle, fp.Plant(rate=1000.0))
    for _ in range(300):
        acting.advance(commands, 1e-3, np.zeros(6))
    ours = fp.State.from_packed(engine.packed)
    pivot, rod = data.body("vehicle"), data.body("bob")
    theirs = np.concatenate([pivot.xpos, pivot.xmat, rod.xmat[2::3], data.act])
    # RK4 in steps of 0.5 ms and of 1 ms: 1e-7 on the Crazyflie, which is the quickest.
    assert np.allclose(theirs, np.concatenate([ours.x, ours.R.ravel(), ours.y, engine.rotors]), rtol=0, atol=1e-6)
    assert np.linalg.norm(ours.y - start.y) > 0.1
    data.ctrl[:] = 10 * vehicle.rotor_limits[1]
    mujoco.mj_step(model, data, nstep=2000)
    assert np.allclose(data.act, vehicle.rotor_limits[1])  # a second later, MuJoCo has kept it within the limits


def _end(model, data, vehicle):
    """Place and attitude of the vehicle, and direction of the rod, after 600 steps of unequal rotors."""
    data.ctrl[:] = np.linspace(0.6, 1.1, 4) * vehicle.weight / 4
    mujoco.mj_step(model, data, nstep=600)
    mujoco.mj_forward(model, data)
    pivot, rod = data.body("vehicle"), data.body("bob")
    return np.concatenate([pivot.xpos, pivot.xmat, rod.xmat[2::3]])


@pytest.mark.parametrize("name", ["hehn2011", "crazyflie", UNIFORM])
def test_a_vehicle_as_urdf_moves_as_the_one_as_mjcf(name):
    """With motors in the frames of its rotors; the joint off the centre of mass, the inertia tilted, the rod tumbling.

    The ring adds a millionth to the rod's inertia: 2e-5 to 6e-5 at the end, and ten times less with a tenth of it.
    """
    vehicle = _tilted(name).replace(pivot_offset=OFFSET / 10)
    ours = mujoco.MjModel.from_xml_string(vehicle.to_mjcf(timestep=0.5e-3, lag=False))
    spec = mujoco.MjSpec.from_string(vehicle.to_urdf())
    spec.compiler.fusestatic = False
    spec.body("vehicle").add_freejoint()
    spec.option.timestep, spec.option.integrator = 0.5e-3, mujoco.mjtIntegrator.mjINT_RK4
    spec.option.gravity, spec.option.disableflags = [0, 0, -vehicle.g], mujoco.mjtDisableBit.mjDSBL_CONTACT
    for k, spin in enumerate(vehicle.rotor_spins):
        spec.body(f"rotor{k}").add_site(name=f"rotor{k}")
        motor = spec.add_actuator(name=f"rotor{k}", target=f"rotor{k}", trntype=mujoco.mjtTrn.mjTRN_SITE)
        motor.gear[:] = 0, 0, 1, 0, 0, vehicle.drag_ratio * spin
    theirs = spec.compile()
    assert sum(theirs.body_mass) == pytest.approx(sum(ours.body_mass), rel=1e-6)
    (box,) = ElementTree.fromstring(vehicle.to_urdf()).iter("box")  # what is drawn as the vehicle
    sides = np.array(box.get("size").split(), dtype=float)
    np.testing.assert_allclose(sides, 0.08 * np.max(np.abs(vehicle.rotor_positions)), rtol=1e-6)

    start = fp.State.random(np.random.default_rng(3))
    u, w = start.R.T @ start.y, start.omega
    v = start.R.T @ start.y_dot - np.cross(w, u)
    first, second = np.arctan2(-u[1], u[2]), np.arcsin(u[0])
    rates = (u[1] * v[2] - v[1] * u[2]) / (u[1] ** 2 + u[2] ** 2), v[0] / np.cos(second)
    coordinates, ends = mujoco_coordinates(start.packed()), []
    for model in (ours, theirs):
        data = mujoco.MjData(model)
        data.qpos[:7], data.qvel[:6] = coordinates[:7], coordinates[11:17]
        data.qpos[7:] = coordinates[7:11] if model is ours else (first, second)
        data.qvel[6:] = coordinates[17:] if model is ours else rates
        ends.append(_end(model, data, vehicle))
    assert np.linalg.norm(ends[0][-3:] - start.y) > 0.1
    assert np.allclose(*ends, rtol=0, atol=1e-4)


def _of_sdf(text, step, gravity):
    """A specification for MuJoCo of the links, frames and joints in an SDF model, whatever they are."""
    model = ElementTree.fromstring(text).find("model")
    spec = mujoco.MjSpec()
    spec.option.timestep, spec.option.integrator = step, mujoco.mjtIntegrator.mjINT_RK4
    spec.option.gravity, spec.option.disableflags = [0, 0, -gravity], mujoco.mjtDisableBit.mjDSBL_CONTACT
    joints = {joint.findtext("child"): joint for joint in model.iter("joint")}
    for link in model.iter("link"):
        joint = joints.get(link.get("name"))
        body = (spec.worldbody if joint is None else spec.body(joint.findtext("parent"))).add_body(
            name=link.get("name")
        )
        if joint is None:
            body.add_freejoint()
        else:
            assert joint.get("type") == "ball"
            body.add_joint(type=mujoco.mjtJoint.mjJNT_BALL)
        inertial = link.find("inertial")
        body.mass = float(inertial.findtext("mass"))
        body.ipos = _pose(inertial)
        names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
        body.fullinertia = [float(inertial.findtext(f"inertia/{name}")) for name in names]
        body.explicitinertial = True
        for shape in link.iter("visual"):
            kind = shape.find("geometry")[0]
            assert all(float(value) > 0 for size in kind for value in size.text.split())
    for frame in model.iter("frame"):
        spec.body(frame.get("attached_to")).add_site(name=frame.get("name"), pos=_pose(frame))
    return spec


def _pose(element):
    *place, roll, pitch, yaw = map(float, element.findtext("pose").split())
    assert roll == pitch == yaw == 0
    return place


@pytest.mark.parametrize("name", ["hehn2011", "crazyflie", UNIFORM])
def test_a_vehicle_as_sdf_is_the_one_as_mjcf(name):
    """Masses, moments, places and motion, from what is written alone; no engine that reads SDF is on hand."""
    vehicle = _tilted(name).replace(pivot_offset=OFFSET / 10)
    ours = mujoco.MjModel.from_xml_string(vehicle.to_mjcf(timestep=0.5e-3, lag=False))
    spec = _of_sdf(vehicle.to_sdf(), 0.5e-3, vehicle.g)
    for k, spin in enumerate(vehicle.rotor_spins):
        motor = spec.add_actuator(name=f"rotor{k}", target=f"rotor{k}", trntype=mujoco.mjtTrn.mjTRN_SITE)
        motor.gear[:] = 0, 0, 1, 0, 0, vehicle.drag_ratio * spin
    theirs = spec.compile()
    assert np.allclose(theirs.body_mass, ours.body_mass, rtol=1e-15)
    assert np.allclose(theirs.body_ipos, ours.body_ipos, rtol=0, atol=1e-15)
    assert np.allclose(theirs.site_pos, ours.site_pos, rtol=0, atol=1e-15)
    start = fp.State.random(np.random.default_rng(3))
    coordinates, ends = mujoco_coordinates(start.packed()), []
    for model in (ours, theirs):
        data = mujoco.MjData(model)
        data.qpos[:], data.qvel[:] = coordinates[:11], coordinates[11:]
        ends.append(_end(model, data, vehicle))
    assert np.linalg.norm(ends[0][-3:] - start.y) > 0.1
    # The inertia's axes are found anew: roundoff, which tumbling multiplies.
    assert np.allclose(*ends, rtol=0, atol=1e-8), abs(ends[0] - ends[1]).max()
