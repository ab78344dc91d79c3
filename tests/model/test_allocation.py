"""From wrench to rotor forces: within limits, exact where feasible, roll and pitch before thrust before yaw."""

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog

import flypend as fp
from flypend.compile.numeric import as_numpy
from flypend.model.allocation import allocate

property_test = settings(max_examples=80, deadline=None, derandomize=True)

# The linear programs are solved to 1e-7 of the forces, in N; a moment is a force times an arm below 1 m.
SOLVER = 1e-6
# Forces are sums of four products of order the largest force, a few N.
ROUNDOFF = 1e-13


def _turned(vehicle, angle):
    """The vehicle with its rotors turned about the body's third axis."""
    c, s = np.cos(angle), np.sin(angle)
    return vehicle.replace(rotor_positions=vehicle.rotor_positions @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]))


def _with_rotors(angles):
    arm = 0.2 * np.array([[np.cos(a), np.sin(a), 0] for a in angles])
    return fp.vehicle("hehn2011").replace(rotor_positions=arm, rotor_spins=[(-1) ** k for k in range(len(angles))])


PLUS = fp.vehicle("hehn2011")
QUADROTORS = {
    "plus": PLUS,
    "X": _turned(PLUS, np.pi / 4),
    "turned by 20 degrees": _turned(PLUS, np.radians(20)),
    "H": PLUS.replace(rotor_positions=[[0.2, 0.1, 0], [0.2, -0.1, 0], [-0.2, -0.1, 0], [-0.2, 0.1, 0]]),
    "no least force": PLUS.replace(rotor_limits=[0, 3.5]),
}
VEHICLES = QUADROTORS | {"hexarotor": _with_rotors(np.arange(6) * np.pi / 3)}


def _function(vehicle):
    thrust, moment = ca.SX.sym("f"), ca.SX.sym("tau", 3)
    function = as_numpy(ca.Function("forces", [thrust, moment], [ca.densify(allocate(thrust, moment, vehicle))]))
    return lambda wrench: function(wrench[0], wrench[1:])


ALLOCATE = {name: _function(vehicle) for name, vehicle in VEHICLES.items()}


def _reach(vehicle):
    """Largest thrust and moments (4,) of the vehicle, each alone."""
    low, high = vehicle.rotor_limits
    return np.append(high * len(vehicle.rotor_spins), np.abs(vehicle.mixing()[1:]).sum(axis=1) / 2 * (high - low))


# From half of what is feasible, where all is reproduced, to four times as much, where all is cut.
shares = st.floats(0.3, 4).flatmap(lambda size: st.tuples(*[st.floats(-size, size)] * 4)).map(np.array)
each = pytest.mark.parametrize("name", VEHICLES)
each_quadrotor = pytest.mark.parametrize("name", QUADROTORS)


# Limits and exactness --------------------------------------------------------------------------------------------


@each
@property_test
@given(share=shares)
def test_forces_are_within_the_limits(name, share):
    vehicle = VEHICLES[name]
    low, high = vehicle.rotor_limits
    forces = ALLOCATE[name](share * _reach(vehicle))
    assert np.all(forces >= low)
    assert np.all(forces <= high)


@each
@property_test
@given(data=st.data())
def test_a_wrench_that_forces_within_the_limits_give_is_reproduced(name, data):
    # With more than four rotors: one that the forces of least norm give.
    vehicle = VEHICLES[name]
    low, high = vehicle.rotor_limits
    parts = np.array(data.draw(st.tuples(*[st.floats(0, 1)] * 4)))
    direction = vehicle.unmixing() @ (vehicle.mixing() @ (2 * np.resize(parts, len(vehicle.rotor_spins)) - 1))
    wanted = (low + high) / 2 + (high - low) / 2 * direction / max(1, np.max(np.abs(direction)))
    wrench = vehicle.mixing() @ wanted
    forces = ALLOCATE[name](wrench)
    np.testing.assert_allclose(forces, wanted, rtol=0, atol=ROUNDOFF)
    np.testing.assert_allclose(vehicle.mixing() @ forces, wrench, rtol=0, atol=10 * ROUNDOFF)


@each
@pytest.mark.parametrize("size", [1e3, 1e30, 1e150, 1e300])
def test_extreme_wrenches_give_forces_within_the_limits_and_no_nan(name, size):
    vehicle = VEHICLES[name]
    low, high = vehicle.rotor_limits
    rng = np.random.default_rng(0)
    for signs in np.vstack([rng.choice([-1, 0, 1], (40, 4)), rng.uniform(-1, 1, (40, 4))]):
        forces = ALLOCATE[name](size * signs)
        assert np.all((low <= forces) & (forces <= high)), signs  # false for NaN


def test_what_is_asked_for_least_alone_gets_all_it_can():
    # A wrench far beyond reach in one component: the rotors that help are at their limits, to the roundoff of 100 N.
    low, high = PLUS.rotor_limits
    middle = (low + high) / 2
    for wrench, forces in (
        ([100, 0, 0, 0], [high, high, high, high]),
        ([-100, 0, 0, 0], [low, low, low, low]),
        ([4 * middle, 17, 0, 0], [middle, low, middle, high]),  # the left rotor pushes up: roll
        ([4 * middle, 0, 17, 0], [low, middle, high, middle]),  # the back rotor pushes up: pitch
        ([4 * middle, 0, 0, 1.6], [high, low, high, low]),  # those that spin clockwise
    ):
        np.testing.assert_allclose(ALLOCATE["plus"](np.array(wrench)), forces, rtol=0, atol=100 * ROUNDOFF)


# Priority: an independent solution by linear programs -----------------------------------------------------------


def _scaled(vehicle, wrench):
    """Roll and pitch (2,) after scaling what they ask of the rotors of each spin by as little as makes it feasible.

    For the rotors of one spin: the largest factor s in [0, 1] with low ≤ s r_i + a ≤ high for some a.
    """
    low, high = vehicle.rotor_limits
    asked = np.linalg.pinv(vehicle.mixing())[:, 1:3] @ wrench[1:3]
    for spin in (1, -1):
        members = vehicle.rotor_spins == spin
        r, one = asked[members][:, None], np.ones((members.sum(), 1))
        solution = linprog(
            [-1, 0],
            A_ub=np.block([[r, one], [-r, -one]]),
            b_ub=np.concatenate([high * one, -low * one])[:, 0],
            bounds=[(0, 1), (None, None)],
        )
        assert solution.status == 0
        asked[members] *= solution.x[0]
    return vehicle.mixing()[1:3] @ asked


def _nearest(vehicle, row, wanted, rows, values):
    """The value of mixing row `row` nearest to `wanted` among forces within limits with `rows` at their `values`."""
    n, mixing = len(vehicle.rotor_spins), vehicle.mixing()
    objective = np.append(np.zeros(n), 1)  # variables: forces, and e ≥ |mixing[row] · forces − wanted|
    solution = linprog(
        objective,
        A_ub=np.block([[mixing[row], -1], [-mixing[row], -1]]),
        b_ub=[wanted, -wanted],
        A_eq=np.hstack([mixing[rows], np.zeros((len(rows), 1))]),
        b_eq=values,
        bounds=[tuple(vehicle.rotor_limits)] * n + [(0, None)],
    )
    assert solution.status == 0
    return mixing[row] @ solution.x[:n], solution.x[:n]


@each_quadrotor
@settings(property_test, max_examples=40)
@given(share=shares)
def test_roll_and_pitch_come_before_thrust_before_yaw(name, share):
    vehicle = VEHICLES[name]
    wrench = share * _reach(vehicle)
    roll_pitch = _scaled(vehicle, wrench)
    thrust, _ = _nearest(vehicle, 0, wrench[0], [1, 2], roll_pitch)
    yaw, wanted = _nearest(vehicle, 3, wrench[3], [0, 1, 2], [thrust, *roll_pitch])
    forces = ALLOCATE[name](wrench)
    got = vehicle.mixing() @ forces
    np.testing.assert_allclose(got, [thrust, *roll_pitch, yaw], rtol=0, atol=SOLVER)
    # Four rotors, four numbers: the forces are then the same. Yaw is a force times c, 16 mm: c divides its error.
    np.testing.assert_allclose(forces, wanted, rtol=0, atol=SOLVER / vehicle.drag_ratio)


def test_the_priority_is_felt():
    """The test above is about something: each of the three gives way in more than a tenth of such cases, yaw most."""
    rng = np.random.default_rng(1)
    cut = []
    for name in ("plus", "X"):
        vehicle = VEHICLES[name]
        for share in rng.uniform(-1.2, 1.2, (300, 4)):
            wrench = share * _reach(vehicle)
            error = np.abs(vehicle.mixing() @ ALLOCATE[name](wrench) - wrench) / _reach(vehicle)
            cut.append([error[0] > 1e-9, max(error[1:3]) > 1e-9, error[3] > 1e-9])
    thrust, roll_pitch, yaw = np.mean(cut, axis=0)
    assert 0.1 < roll_pitch < thrust < yaw < 0.98


# What is refused -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "vehicle",
    [
        # A centre of mass beside the middle: thrust is not shared equally, yaw is.
        PLUS.replace(rotor_positions=PLUS.rotor_positions + np.array([0.03, 0, 0])),
        # A kite about its centre of mass: yaw is not shared equally, thrust is.
        PLUS.replace(rotor_positions=[[0.2, 0, 0], [-0.05, -0.17, 0], [-0.1, 0, 0], [-0.05, 0.17, 0]]),
        # Three rotors of one spin.
        _with_rotors([0, 0.5, 2.2, 3.8, 5]),
    ],
)
def test_an_asymmetric_vehicle_is_refused(vehicle):
    message = r"^rotor_positions: expected rotors that share thrust and yaw equally, got an asymmetric vehicle$"
    with pytest.raises(fp.InputError, match=message):
        allocate(ca.SX.sym("f"), ca.SX.sym("tau", 3), vehicle)
    law = fp.Law(name="rest", e3="up", control=lambda t, state, vehicle, k: fp.Wrench(0 * t, 0 * state.omega))
    with pytest.raises(fp.InputError, match=message):
        fp.simulate(vehicle, law, fp.State(y=(0, 0, 1)), 0.1, plant="rotors")
