"""Air: RotorPy's forces, drag that only takes energy, terminal velocity, ground effect, and both engines."""

import casadi as ca
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import flypend as fp
from flypend import geometry as geo
from flypend.compile.numeric import as_numpy
from flypend.compile.program import lower
from flypend.model.air import AIR, Air, air_wrench, ground_gain
from flypend.model.motion import Disturbance, disturbed_motion
from flypend.plants import Plant
from flypend.plants.actuation import make_engine
from flypend.plants.equations import rotor_step

VEHICLE = fp.vehicle("hehn2011")
ENGINES = pytest.mark.parametrize("engine", ["equations", "mujoco"])
# RotorPy's Hummingbird: thrust, rotor drag, induced inflow, translational lift per rotor speed, and drag of the body.
K_ETA, K_D, K_Z, K_H, C_D = 5.57e-6, 1.19e-4, 2.32e-4, 3.39e-3, np.array([5e-3, 5e-3, 1e-2])
HUMMINGBIRD = Air(rotor_drag=K_D / K_ETA**0.5, inflow=K_Z / K_ETA**0.5, lift=K_H, body_drag=C_D)


def wrench_of(vehicle, effects=AIR, ground=None):
    s, r = ca.SX.sym("s", 24), ca.SX.sym("r", 4)
    force, moment = air_wrench(fp.State.symbolic(s), r, vehicle, effects, ground)
    return as_numpy(ca.Function("air", [s, r], [ca.densify(force), ca.densify(moment)]))


def as_in_rotorpy(vehicle, state, forces):
    """Force and moment by the formulas of RotorPy's Multirotor.compute_body_wrench, less the thrust."""
    velocity = state.R.T @ state.x_dot - np.cross(state.omega, vehicle.pivot_offset)
    force, moment = -np.linalg.norm(velocity) * C_D * velocity, np.zeros(3)
    for place, speed in zip(vehicle.rotor_positions, np.sqrt(forces / K_ETA), strict=True):
        seen = velocity + np.cross(state.omega, place)
        acting = -speed * np.diag([K_D, K_D, K_Z]) @ seen + np.array([0, 0, K_H * (seen[0] ** 2 + seen[1] ** 2)])
        force, moment = force + acting, moment + np.cross(place, acting)
    return force, moment


@pytest.mark.parametrize("offset", [(0, 0, 0), (0.03, -0.02, 0.05)])
def test_forces_are_those_of_rotorpy(offset):
    vehicle, rng = VEHICLE.replace(air=HUMMINGBIRD, pivot_offset=offset), np.random.default_rng(1)
    for state in fp.State.random(rng, 50):
        forces = rng.uniform(0, 3.5, 4)
        found, expected = wrench_of(vehicle)(state.packed(), forces), as_in_rotorpy(vehicle, state, forces)
        for a, b in zip(found, expected, strict=True):
            np.testing.assert_allclose(a, b, rtol=0, atol=1e-13)  # ten products of order one


def test_each_effect_acts_alone():
    vehicle, state = VEHICLE.replace(air=HUMMINGBIRD), fp.State.random(np.random.default_rng(2)).packed()
    forces = np.full(4, 1.3)
    alone = [np.concatenate(wrench_of(vehicle, (name,))(state, forces)) for name in AIR]
    assert all(np.linalg.norm(part) > 1e-3 for part in alone)
    np.testing.assert_allclose(sum(alone), np.concatenate(wrench_of(vehicle)(state, forces)), rtol=0, atol=1e-14)
    for name, part in zip(AIR, alone, strict=True):
        only = VEHICLE.replace(air=None).replace(air=Air(**{name: getattr(HUMMINGBIRD, name)}))
        np.testing.assert_array_equal(np.concatenate(wrench_of(only)(state, forces)), part)


def test_derivatives_exist_at_rest_and_without_thrust():
    """There the forces of body and rotors end in kinks of roots; the drag of the body is level."""
    s, r = ca.SX.sym("s", 24), ca.SX.sym("r", 4)
    wrench = ca.vertcat(*air_wrench(fp.State.symbolic(s), r, VEHICLE.replace(air=HUMMINGBIRD), AIR))
    slopes = as_numpy(ca.Function("slopes", [s, r], [ca.densify(ca.jacobian(wrench, ca.vertcat(s, r)))]))
    still = fp.State(y=(0, 0, 1)).packed()
    assert np.isfinite(slopes(still, np.array([0.0, -1.0, 1e-40, 1.0]))).all()
    drag = slopes(still, np.zeros(4))
    assert abs(drag).max() < 1e-14  # roundoff of the root's floor


def test_drag_only_takes_energy():
    rng, vehicle = np.random.default_rng(3), VEHICLE.replace(pivot_offset=(0.02, 0.01, 0.05))
    act = wrench_of(vehicle, ("rotor_drag", "inflow", "body_drag"))
    for state in fp.State.random(rng, 200, max_omega=10.0):
        force, moment = act(state.packed(), rng.uniform(0, 3.5, 4))
        velocity = state.R.T @ state.x_dot - np.cross(state.omega, vehicle.pivot_offset)
        assert force @ velocity + moment @ state.omega < 0


def dropped(engine, vehicle, plant, start, forces, duration, step=2e-3):
    machine = make_engine(vehicle, plant.replace(engine=engine, lag=0.0))
    machine.reset(start.packed(), forces)
    states = [machine.packed]
    for _ in range(round(duration / step)):
        machine.step(forces, step, np.zeros(6))
        states.append(machine.packed)
    return np.array(states)


@ENGINES
def test_a_fall_ends_at_the_terminal_velocity(engine):
    """Without thrust, level, rod along the fall: v = −v_T tanh(g t/v_T), c v_T² = (M + m) g."""
    vehicle = VEHICLE.replace(air={"body_drag": (0, 0, 0.2)}, rotor_lag=0.0)
    terminal = np.sqrt(vehicle.weight / 0.2)
    plant = Plant(air=("body_drag",))
    states = dropped(engine, vehicle, plant, fp.State(y=(0, 0, -1)), np.zeros(4), 3.0)
    t = 2e-3 * np.arange(len(states))
    # MuJoCo holds the drag within 0.5 ms: (h g/v_T)²/24 of it.
    np.testing.assert_allclose(states[:, 5], -terminal * np.tanh(9.81 * t / terminal), rtol=0, atol=1e-6)
    assert states[-1, 5] == pytest.approx(-terminal, rel=1e-4)


@ENGINES
def test_rotor_drag_slows_level_flight_exponentially(engine):
    """With a bob of no mass: v̇ = −n rotor_drag √f v/M."""
    vehicle = VEHICLE.replace(bob_mass=1e-9, rotor_lag=0.0)
    forces = np.full(4, vehicle.weight / 4)
    rate = 4 * vehicle.air.rotor_drag * np.sqrt(forces[0]) / vehicle.mass
    states = dropped(engine, vehicle, Plant(air=("rotor_drag",)), fp.State(x_dot=(2, 0, 0), y=(0, 0, -1)), forces, 1.0)
    assert 0.3 < rate < 1  # 1/s
    np.testing.assert_allclose(states[-1, 3], 2 * np.exp(-rate), rtol=1e-6)


@ENGINES
def test_inflow_damps_a_climb(engine):
    """With the thrust of hover, v̇ = −n inflow √f v/(M + m) along the axis, rod included."""
    vehicle = VEHICLE.replace(rotor_lag=0.0)
    forces = np.full(4, vehicle.weight / 4)
    rate = 4 * vehicle.air.inflow * np.sqrt(forces[0]) / (vehicle.M + vehicle.m)
    states = dropped(engine, vehicle, Plant(air=("inflow",)), fp.State(x_dot=(0, 0, 1), y=(0, 0, -1)), forces, 1.0)
    np.testing.assert_allclose(states[-1, 5], np.exp(-rate), rtol=1e-6)


def test_the_gain_of_the_ground_is_that_of_cheeseman_and_bennett():
    for height in (0.5, 1.0, 2.0, 10.0):  # in radii
        assert float(ground_gain(height * 0.1, 0.1)) == pytest.approx(1 / (1 - (1 / (4 * height)) ** 2) - 1, rel=1e-14)
    assert float(ground_gain(1.0, 1.0)) == pytest.approx(1 / 15, rel=1e-14)
    assert float(ground_gain(-3.0, 1.0)) == pytest.approx(1 / 3, rel=1e-14)  # as at half a radius


@ENGINES
def test_less_thrust_hovers_above_the_ground(engine):
    vehicle, ground = VEHICLE.replace(rotor_lag=0.0), -0.1
    gain = float(ground_gain(0.1, vehicle.body.disc_radius))
    forces = np.full(4, vehicle.weight / 4 / (1 + gain))
    states = dropped(engine, vehicle, Plant(ground=ground), fp.State(y=(0, 0, -1)), forces, 0.2)
    np.testing.assert_allclose(states[-1], states[0], rtol=0, atol=1e-9)  # an equilibrium, unstable by 3 1/s² at most
    away = dropped(engine, vehicle, Plant(), fp.State(y=(0, 0, -1)), forces, 0.2)
    assert away[-1, 2] < -9.81 * gain / (1 + gain) * 0.2**2 / 2 * 0.99


def test_an_inverted_vehicle_gains_nothing_from_the_ground():
    over = fp.State(R=np.diag([1.0, -1.0, -1.0]), y=(0, 0, 1)).packed()
    force, moment = wrench_of(VEHICLE, (), ground=-0.1)(over, np.ones(4))
    np.testing.assert_array_equal(np.concatenate([force, moment]), 0)


@ENGINES
@pytest.mark.parametrize("offset", [(0, 0, 0), (0.02, -0.01, 0.04)])
def test_the_flight_is_that_of_an_independent_integrator(engine, offset):
    """SciPy on Newton and Euler's equations with RotorPy's forces, in NumPy."""
    vehicle = VEHICLE.replace(air=HUMMINGBIRD, pivot_offset=offset, rotor_lag=0.0)
    forces, start = np.array([1.2, 1.5, 1.3, 1.4]), fp.State(x_dot=(2, -1, 1), omega=(1, 2, -1), y=(0.6, 0, 0.8))
    mixing = vehicle.mixing()
    s, F, m = ca.SX.sym("s", 24), ca.SX.sym("F", 3), ca.SX.sym("m", 3)
    wrench = fp.Wrench(ca.DM(mixing[0] @ forces), ca.DM(mixing[1:] @ forces) + m)
    motion = disturbed_motion(
        fp.State.symbolic(s), wrench, vehicle, "up", Disturbance(force_on_vehicle=F, pivot_offset=np.array(offset))
    )
    rates = as_numpy(ca.Function("rates", [s, F, m], [ca.densify(motion.packed())]))

    def moving(t, packed):
        state = fp.State.trusted(packed)
        force, moment = as_in_rotorpy(vehicle, state, forces)
        return rates(packed, state.R @ force, moment)

    expected = solve_ivp(moving, (0, 0.4), start.packed(), rtol=1e-10, atol=1e-12).y[:, -1]
    found = dropped(engine, vehicle, Plant(air="all"), start, forces, 0.4)[-1]
    # Of order four in 2 ms; MuJoCo holds forces of some newtons, which turn at 2 rad/s, for 0.5 ms.
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-8 if engine == "equations" else 5e-6)
    still = dropped(engine, vehicle, Plant(), start, forces, 0.4)[-1]
    assert geo.norm(still[:3] - found[:3]) > 0.03


def test_air_that_no_plant_names_changes_no_program():
    plain = lower(rotor_step(VEHICLE.replace(air=None).replace(air=None)))
    assert lower(rotor_step(VEHICLE)) == plain
    assert lower(rotor_step(VEHICLE, Plant(air="all"))) != plain


def test_bad_air_is_told_in_one_line():
    law, start = fp.laws.inverted(), fp.State(y=(0, 0, 1))
    with pytest.raises(fp.InputError, match=r"^air\.inflow: expected a finite number >= 0, got -1$"):
        VEHICLE.replace(air={"inflow": -1})
    with pytest.raises(fp.InputError, match=r"^air\.body_drag: expected numbers >= 0, got \[0\.0, 0\.0, -1\.0\]$"):
        VEHICLE.replace(air={"body_drag": (0, 0, -1)})
    with pytest.raises(
        fp.InputError, match=r"^air\.drag: expected one of rotor_drag, inflow, lift, body_drag, got 'drag'"
    ):
        VEHICLE.replace(air={"drag": 1})
    with pytest.raises(fp.InputError, match=r"^plant\.air: expected one of .*, got 'wind'"):
        Plant(air=("wind",))
    none = VEHICLE.replace(air=Air(inflow=0.01))
    with pytest.raises(
        fp.InputError, match=r"^vehicle\.air: expected a coefficient 'lift' > 0, for plant\.air, got none"
    ):
        fp.simulate(none, law, start, 0.1, plant=Plant(air=("lift",)))
    with pytest.raises(
        fp.InputError, match=r"^vehicle\.air: expected coefficients of the air, for plant\.air, got none"
    ):
        fp.simulate(VEHICLE.replace(air=Air()), law, start, 0.1, plant=Plant(air="all"))
    with pytest.raises(
        fp.InputError, match=r"^vehicle\.body: expected the radius of the rotor discs, for plant\.ground"
    ):
        fp.simulate(VEHICLE.replace(body=None), law, start, 0.1, plant=Plant(ground=-1))


def test_a_vehicle_with_air_survives_its_toml():
    again = fp.Vehicle.from_dict(VEHICLE.to_dict())
    assert again == VEHICLE
    assert again.air == VEHICLE.air
    assert VEHICLE.replace(air={"lift": 0.5}).air.inflow == VEHICLE.air.inflow
