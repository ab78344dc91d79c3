"""Sampled flights: each departure from the ideal alone does what it says, and without any they are the ideal flight."""

import re

import casadi as ca
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import flypend as fp
from flypend import geometry as geo
from flypend.flight import sampled
from flypend.flight.integrate import integrate
from flypend.flight.request import Tolerances
from flypend.laws import Computer
from flypend.model import Disturbance, disturbed_motion, linear_momentum, total_energy
from flypend.model.state import FLIP_PACKED, MAX_STATE
from flypend.plants import MOTION_CAPTURE, PRESETS, Noise, Plant, Wind, plant
from flypend.plants.equations import EquationsEngine
from flypend.plants.plant import MISMATCHED
from tests.few import slow

VEHICLE = fp.vehicle("hehn2011")
ROD = VEHICLE.replace(rod_inertia=2e-3)
LOW, HIGH = VEHICLE.rotor_limits
HOVER = VEHICLE.weight / 4
UPRIGHT = fp.State(y=(0, 0, 1))
TUMBLING = fp.State(x_dot=(0.5, 0, 0), omega=(0.3, 2.0, 0.1), y=(0.6, 0, 0.8), y_dot=(0, 2.0, 0))

# Nothing but sampling: what the law asks for acts at once and is held.
HELD = Plant(limits=False, lag=0.0)
ENGINES = pytest.mark.parametrize("engine", ["equations", "mujoco"])

# Sums of a thousand steps of order ten, eps each.
ROUNDOFF = 1e-11


def law(control, e3="up"):
    """A law of one function of (t, state)."""
    return full_law(lambda t, state, vehicle, k: control(t, state), e3)


def full_law(control, e3="up"):
    return fp.Law(name="test", e3=e3, control=control)


def lift(thrust):
    """Thrust (t) and no moment: a vehicle under an upright rod goes straight up and down."""
    return law(lambda t, state: fp.Wrench(thrust(t), ca.SX.zeros(3)))


def ramp(t):
    return VEHICLE.weight * (1 + 0.3 * t)


def push(t, state):
    """A smooth wrench that keeps the vehicle busy for a second."""
    return fp.Wrench(5 + ca.sin(3 * t), 1e-3 * ca.vertcat(ca.cos(5 * t), ca.sin(4 * t), -state.omega[0]))


def calm(t, state):
    """A feedback with the thrust of hover that damps the rates of the vehicle."""
    return fp.Wrench(VEHICLE.weight + ca.SX(0), -0.02 * state.omega)


def fly(vehicle, control, start, duration, plant):
    """The flight, step by step (the reference of the kernel), sampled at every control tick."""
    ticks = np.arange(round(duration * plant.rate) + 1) / plant.rate
    run = fp.simulate(vehicle, control, start, duration, plant=plant, times=np.minimum(ticks, duration), engine="scipy")
    np.testing.assert_allclose(run.t, ticks[: len(run.t)], rtol=0, atol=1e-12)
    return run


def final(run):
    return run.states.packed()[-1]


# What is refused -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Noise(attitude=-1e-3), "noise.attitude: expected a finite number >= 0, got -0.001"),
        (lambda: Noise(y_dot="big"), "noise.y_dot: expected a finite number >= 0, got 'big'"),
        (lambda: Noise(x=np.nan), "noise.x: expected a finite number >= 0, got nan"),
        (lambda: Wind(on_bob=(1, 2)), "wind.on_bob: expected numbers of shape (3), got shape (2,)"),
        (lambda: Wind(on_vehicle=np.zeros((2, 3))), "wind.on_vehicle: expected numbers of shape (3), got shape (2, 3)"),
        (
            lambda: Wind(on_vehicle=(1, np.inf, 0)),
            "wind.on_vehicle: expected finite numbers, got 1 that are NaN or infinite",
        ),
        (lambda: Wind(gust_on_bob=-1), "wind.gust_on_bob: expected a finite number >= 0 N, got -1"),
        (lambda: Wind(knock_on_bob=-1), "wind.knock_on_bob: expected a finite number >= 0 N s, got -1"),
        (lambda: Wind(knock_period=0), "wind.knock_period: expected a finite number > 0 s, got 0"),
        (lambda: Wind(gust_time=0), "wind.gust_time: expected a finite number > 0 s, got 0"),
        (lambda: Plant(engine="mujaco"), "plant.engine: expected one of equations, mujoco, got 'mujaco'"),
        (lambda: Plant(interface="rate"), "plant.interface: expected one of wrench, rates, got 'rate'"),
        (lambda: Plant(limits="no"), "plant.limits: expected true or false, got 'no'"),
        (lambda: fp.Ideal(lag="no"), "plant.lag: expected true or false, got 'no'"),
        (lambda: Plant(lag=-0.01), "plant.lag: expected a finite number >= 0 s, got -0.01"),
        (lambda: Plant(rate=0), "plant.rate: expected a finite number > 0 Hz, got 0"),
        (lambda: Plant(delay=np.nan), "plant.delay: expected a finite number >= 0 s, got nan"),
        (lambda: Plant(noise=0.1), "plant.noise: expected a Noise or None, got 0.1"),
        (lambda: Plant(wind=(1, 0, 0)), "plant.wind: expected a Wind or None, got (1, 0, 0)"),
        (lambda: Plant(pivot_offset=[0.1]), "plant.pivot_offset: expected numbers of shape (3), got shape (1,)"),
        (
            lambda: Plant(pivot_offset=np.zeros((1, 3))),
            "plant.pivot_offset: expected numbers of shape (3), got shape (1, 3)",
        ),
        (lambda: Plant(mismatch=1.1), "plant.mismatch: expected factors by name, got 1.1"),
        (lambda: Plant(mismatch={"mas": 1.1}), "plant.mismatch.mas: expected one of mass, bob_mass, rod_length"),
        (lambda: Plant(mismatch={"mass": 0}), "plant.mismatch.mass: expected a finite number > 0, got 0"),
        (lambda: Plant(rate_loop_rate=-1), "plant.rate_loop_rate: expected a finite number > 0 Hz, got -1"),
        (lambda: Plant(rate_loop_gain=0), "plant.rate_loop_gain: expected a finite number > 0 1/s, got 0"),
        (lambda: Plant(seed=-1), "plant.seed: expected an integer from 0 to 2⁶², got -1"),
        (lambda: Plant(seed=0.5), "plant.seed: expected an integer from 0 to 2⁶², got 0.5"),
        (lambda: Plant().replace(rates=50), "plant.rates: expected one of engine, limits"),
        (lambda: Plant().replace(rate=-50), "plant.rate: expected a finite number > 0 Hz, got -50"),
        (
            lambda: plant("rotor"),
            "plant: expected one of ideal, rotors, mujoco, hehn2011, laboratory, got 'rotor' (did you mean 'rotors'",
        ),
        (
            lambda: plant(None),
            "plant: expected a Plant, Ideal() or one of ideal, rotors, mujoco, hehn2011, laboratory",
        ),
    ],
)
def test_what_is_out_of_range_is_refused_in_one_line(make, message):
    with pytest.raises(fp.InputError, match="^" + re.escape(message)) as caught:
        make()
    assert "\n" not in str(caught.value)


def test_presets_and_copies():
    assert plant("rotors") == Plant()
    assert plant("mujoco") == Plant(engine="mujoco")
    hehn = plant("hehn2011")
    assert (hehn.interface, hehn.rate, hehn.delay) == ("rates", 50.0, 0.03)
    assert plant(hehn) is hehn
    assert hehn.replace(rate=100.0) == Plant(interface="rates", rate=100.0, delay=0.03)
    assert set(PRESETS) == {"ideal", "rotors", "mujoco", "hehn2011", "laboratory"}


def test_a_plant_keeps_its_own_copies():
    factors, offset = {"mass": 1.1}, np.array([0.1, 0, 0])
    kept = Plant(mismatch=factors, pivot_offset=offset)
    factors["mass"], offset[0] = 2.0, 1.0
    assert kept.mismatch == {"mass": 1.1}
    assert kept.pivot_offset == (0.1, 0, 0)


def test_a_centre_of_mass_that_is_off_turns_the_vehicle_and_leaves_its_parts_in_place():
    c, offset = np.array([0.003, -0.002, 0.004]), np.array([0.01, 0.0, 0.02])
    vehicle = VEHICLE.replace(pivot_offset=offset)
    true = Plant(centre_of_mass=c, mismatch={"rotor_positions": 1.1}).true_vehicle(vehicle)
    np.testing.assert_allclose(true.rotor_positions + c, 1.1 * vehicle.rotor_positions)
    np.testing.assert_allclose(true.pivot_offset + c, offset)
    # Equal rotor forces push at the middle of the rotors, which is at -c from where the mass is.
    force = np.array([0.0, 0.0, 4.0])
    turning = (Plant(centre_of_mass=c).true_vehicle(VEHICLE).mixing() @ np.ones(4))[1:]
    np.testing.assert_allclose(turning, np.cross(-c, force), atol=1e-15)
    both = Plant(centre_of_mass=c, pivot_offset=offset).true_vehicle(VEHICLE)
    np.testing.assert_allclose(both.pivot_offset, offset - c)
    assert Plant(centre_of_mass=(0, 0, 0)).true_vehicle(VEHICLE) == VEHICLE


# Lag, hold, delay, limits ----------------------------------------------------------------------------------------


@ENGINES
@pytest.mark.parametrize(("lag", "time"), [(None, VEHICLE.rotor_lag), (0.05, 0.05)])
def test_rotor_lag_is_first_order_with_its_time_constant(engine, lag, time):
    run = fly(VEHICLE, lift(lambda t: VEHICLE.weight + 0 * t), UPRIGHT, 0.2, Plant(engine=engine, lag=lag))
    expected = HOVER + (LOW - HOVER) * np.exp(-run.t / time)  # from the least force
    # Ours is exact; MuJoCo's filter is integrated by RK4 in steps of 2 ms, which leaves (h/τ)⁴/120 of the change.
    off = 1e-13 if engine == "equations" else (HOVER - LOW) * (2e-3 / time) ** 4 / 120
    np.testing.assert_allclose(run.rotor_forces, np.repeat(expected[:, None], 4, axis=1), rtol=0, atol=off)
    # The motion feels the forces as they rise, not only the record: ẋ₃ is their impulse.
    impulse = 4 * (HOVER * run.t + (LOW - HOVER) * time * (1 - np.exp(-run.t / time)))
    expected = impulse / (VEHICLE.M + VEHICLE.m) - VEHICLE.g * run.t
    # RK4 of steps h/τ = 1/20: (1/20)⁴/2880; in MuJoCo what its forces are off, over a time constant.
    off = 1e-9 + 4 * off * time / (VEHICLE.M + VEHICLE.m)
    np.testing.assert_allclose(run.x_dot[:, 2], expected, rtol=0, atol=off)


@ENGINES
@pytest.mark.parametrize("rate", [50.0, 300.0])
def test_a_command_is_held_until_the_next(engine, rate):
    run = fly(VEHICLE, lift(ramp), UPRIGHT, 0.2, HELD.replace(engine=engine, rate=rate))
    wanted = ramp(run.t[:-1])
    np.testing.assert_allclose(run.rotor_forces[1:], np.tile(wanted[:, None] / 4, 4), rtol=0, atol=1e-13)
    np.testing.assert_allclose(run.thrust[1:], wanted, rtol=0, atol=1e-13)
    # ẋ₃ grows over a period by what the force at its beginning gives: it was constant.
    gain = (wanted / (VEHICLE.M + VEHICLE.m) - VEHICLE.g) / rate
    np.testing.assert_allclose(np.diff(run.x_dot[:, 2]), gain, rtol=0, atol=1e-13)


@ENGINES
@pytest.mark.parametrize("periods", [0.0, 0.25, 1.0, 1.5, 3.0])
def test_a_delay_shifts_commands_by_itself(engine, periods):
    rate = 100.0
    run = fly(VEHICLE, lift(ramp), UPRIGHT, 0.2, HELD.replace(engine=engine, rate=rate, delay=periods / rate))
    whole, part = int(periods), periods % 1
    commanded = ramp(run.t[:-1])  # at the beginning of each period
    before = np.append(np.full(whole + 1, 4 * LOW), commanded)  # rotors idle until the first command arrives
    old, new = before[: len(commanded)], before[1 : len(commanded) + 1]
    force = part * old + (1 - part) * new  # mean over a period: the new command arrives after its share `part`
    gain = (force / (VEHICLE.M + VEHICLE.m) - VEHICLE.g) / rate
    np.testing.assert_allclose(np.diff(run.x_dot[:, 2]), gain, rtol=0, atol=1e-13)
    np.testing.assert_allclose(run.thrust[1:], new, rtol=0, atol=1e-13)


@pytest.mark.parametrize(("wanted", "limited"), [(100.0, 4 * HIGH), (-3.0, 4 * LOW)])
def test_limits_hold_rotor_forces_and_can_be_taken_off(wanted, limited):
    control = lift(lambda t: wanted + 0 * t)
    assert fly(VEHICLE, control, UPRIGHT, 0.01, Plant(lag=0.0)).thrust[-1] == pytest.approx(limited, abs=1e-13)
    free = fly(VEHICLE, control, UPRIGHT, 0.01, HELD)
    assert free.thrust[-1] == pytest.approx(wanted, abs=1e-12)
    assert free.x_dot[-1, 2] == pytest.approx((wanted / (VEHICLE.M + VEHICLE.m) - VEHICLE.g) * 0.01, abs=1e-12)


# Mismatch, wind, pivot -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", MISMATCHED)
def test_mismatch_changes_what_flies_and_not_what_the_law_knows(name):
    known = []

    def control(t, state, vehicle, k):
        known.append(vehicle)
        wrench = push(t, state)
        forces = ca.vertcat(wrench.thrust, wrench.moment)
        return fp.Wrench(forces[0] * vehicle.weight, forces[1:] * vehicle.l)  # of what the law believes in

    true = ROD.replace(**{name: 1.2 * np.asarray(getattr(ROD, name))})

    def translated(t, state, vehicle, k):
        """On the true vehicle: the wrench of the rotor forces that the law means."""
        wrench = control(t, state, ROD, k)
        felt = ca.mtimes(true.mixing() @ ROD.unmixing(), ca.vertcat(wrench.thrust, wrench.moment))
        return fp.Wrench(felt[0], felt[1:])

    without, mismatched = Plant(limits=False), Plant(limits=False, mismatch={name: 1.2})
    run = fly(ROD, full_law(control), TUMBLING, 0.3, mismatched)
    assert known
    assert all(vehicle is ROD for vehicle in known)
    expected = fly(true, full_law(translated), TUMBLING, 0.3, without)
    np.testing.assert_allclose(run.states.packed(), expected.states.packed(), rtol=0, atol=1e-10)
    np.testing.assert_allclose(run.moment, expected.moment, rtol=0, atol=1e-12)
    nominal = fly(ROD, full_law(control), TUMBLING, 0.3, without)
    assert np.max(np.abs(run.states.packed() - nominal.states.packed())) > 1e-4


def test_mismatch_of_the_lag_multiplies_the_lag_of_the_plant():
    assert Plant(mismatch={"rotor_lag": 1.5}).true_vehicle(VEHICLE).rotor_lag == pytest.approx(0.03)
    assert Plant(mismatch={"rotor_lag": 1.5}, lag=0.1).true_vehicle(VEHICLE).rotor_lag == pytest.approx(0.15)
    assert Plant(lag=0.1).true_vehicle(VEHICLE).rotor_lag == 0.1
    assert Plant().true_vehicle(VEHICLE) == VEHICLE


@ENGINES
@pytest.mark.parametrize("e3", ["up", "down"])
def test_wind_accelerates_vehicle_and_bob(engine, e3):
    # In free fall the momentum grows by gravity and both forces, and the energy by their work.
    on_vehicle, on_bob = np.array([0.3, -0.2, 0.1]), np.array([-0.05, 0.02, 0.04])
    rest = law(lambda t, state: fp.Wrench(0 * t, ca.SX.zeros(3)), e3=e3)
    start = TUMBLING if e3 == "up" else TUMBLING.flipped()
    blown = HELD.replace(engine=engine, wind=Wind(on_vehicle=on_vehicle, on_bob=on_bob))
    run = fly(VEHICLE, rest, start, 0.5, blown)
    run = run if e3 == "up" else run.flipped()  # wind is given with e₃ up, whatever the frame of the law
    momentum = linear_momentum(run.states, VEHICLE)
    force = on_vehicle + on_bob - [0, 0, VEHICLE.weight]
    np.testing.assert_allclose(momentum - momentum[0], run.t[:, None] * force, rtol=0, atol=ROUNDOFF)
    bob = run.x + VEHICLE.l * run.y
    work = (run.x - run.x[0]) @ on_vehicle + (bob - bob[0]) @ on_bob
    energy = total_energy(run.states, VEHICLE, "up")
    np.testing.assert_allclose(energy - energy[0], work, rtol=0, atol=1e-9)  # RK4: |ẏ| h = 2e-3, to the fourth, summed


def _integrated(vehicle, forces_of, start, duration, **disturbances):
    """The packed state after `duration` (s) under rotor forces (t), to 1e-12, by another integrator."""
    mixing = vehicle.mixing()

    def rates(t, s):
        wrench = mixing @ forces_of(t)
        # Intermediate stages of the integrator lie off the manifold, where State would refuse them.
        packed = ca.DM(s)
        state, wrench = fp.State.symbolic(packed), fp.Wrench(ca.DM(wrench[0]), ca.DM(wrench[1:]))
        motion = disturbed_motion(state, wrench, vehicle, "up", Disturbance(**disturbances))
        return np.array(motion.packed())[:, 0]

    return integrate(rates, start.packed(), duration, Tolerances(rtol=1e-12))([duration])[0]


@ENGINES
def test_a_pivot_beside_the_centre_of_mass_turns_the_vehicle(engine):
    offset = np.array([0.02, -0.03, 0.05])
    forces = np.array([1.2, 1.5, 1.3, 1.4])
    wrench = VEHICLE.mixing() @ forces
    control = law(lambda t, state: fp.Wrench(wrench[0] + 0 * t, ca.SX(ca.DM(wrench[1:]))))
    run = fly(VEHICLE, control, TUMBLING, 0.3, HELD.replace(engine=engine, pivot_offset=offset))
    expected = _integrated(VEHICLE, lambda t: forces, TUMBLING, 0.3, pivot_offset=offset)
    np.testing.assert_allclose(final(run), expected, rtol=0, atol=1e-8)  # RK4 with ω h below 1e-2, 300 steps
    centred = fly(VEHICLE, control, TUMBLING, 0.3, HELD.replace(engine=engine))
    assert np.max(np.abs(final(run) - final(centred))) > 0.1


@pytest.mark.parametrize("options", [{"rate": 300.0}, {"rate": 5000.0}, {"rate": 500.0, "delay": 0.0013}])
def test_both_engines_fly_for_the_same_time_at_any_rate(options):
    # Rates and delays that are no multiple of an engine's step; the one takes the mean force of a lagging rotor over a
    # step where the other integrates it: (h/τ)²/24 of the change of force, times h.
    settings = {"limits": False, "wind": Wind(on_vehicle=(0.2, 0, 0)), **options}
    first, second = (
        fly(VEHICLE, law(push), TUMBLING, 0.3, Plant(engine=e, **settings)) for e in ("equations", "mujoco")
    )
    np.testing.assert_allclose(final(first), final(second), rtol=0, atol=1e-4)
    np.testing.assert_allclose(first.rotor_forces, second.rotor_forces, rtol=0, atol=1e-4)
    unlagged = [
        fly(VEHICLE, law(push), TUMBLING, 0.3, HELD.replace(engine=e, **options)) for e in ("equations", "mujoco")
    ]
    np.testing.assert_allclose(final(unlagged[0]), final(unlagged[1]), rtol=0, atol=1e-8)


# Noise and gusts -------------------------------------------------------------------------------------------------


@pytest.fixture
def measured(monkeypatch):
    """What the flight computer is given: a list of packed states, filled by the next flight."""
    seen = []

    class Spy(sampled.SteppedBoard):
        def command(self, t, packed):
            seen.append(packed)
            return super().command(t, packed)

    monkeypatch.setattr(sampled, "SteppedBoard", Spy)
    return seen


def _errors(run, measured):
    """Errors of each channel (n, 3), the rod's in a frame of its own: (n, 2)."""
    truth = run.states[: len(measured)]
    got = fp.State.from_packed(measured)
    basis = np.linalg.svd(truth.y[:, None, :])[2][:, 1:, :]  # two unit vectors across y
    return {
        "x": got.x - truth.x,
        "x_dot": got.x_dot - truth.x_dot,
        "attitude": Rotation.from_matrix(np.swapaxes(truth.R, 1, 2) @ got.R).as_rotvec(),
        "omega": got.omega - truth.omega,
        "y": geo.apply(basis, got.y),
        "y_dot": geo.apply(basis, got.y_dot - truth.y_dot),
    }


def test_noise_has_the_statistics_asked_for(measured):
    run = fly(VEHICLE, law(push), TUMBLING, 4.0, Plant(noise=MOTION_CAPTURE))
    packed = np.array(measured)
    assert len(packed) == len(run.t) - 1
    errors = _errors(run, packed)
    n = len(packed)
    for name, error in errors.items():
        wanted = getattr(MOTION_CAPTURE, name)
        # Of n k numbers the standard deviation scatters by 1/√(2 n k), here 1.1 %, and the mean by σ/√n: four of each.
        assert np.std(error) == pytest.approx(wanted, rel=4 / np.sqrt(2 * error.size)), name
        assert np.all(np.abs(error.mean(axis=0)) < 4 * wanted / np.sqrt(n)), name
        assert np.all(np.abs(np.mean(error[1:] * error[:-1], axis=0)) < 4 * wanted**2 / np.sqrt(n)), name  # white
    together = np.hstack([error / getattr(MOTION_CAPTURE, name) for name, error in errors.items()])
    off_diagonal = np.corrcoef(together.T)[~np.eye(together.shape[1], dtype=bool)]
    assert np.max(np.abs(off_diagonal)) < 5 / np.sqrt(n)  # each drawn for itself; 240 pairs


def test_a_measured_state_lies_on_the_manifold(measured):
    fly(VEHICLE, law(push), TUMBLING, 0.5, Plant(noise=Noise(attitude=0.5, y=0.5, y_dot=2.0)))
    packed = np.array(measured)
    y, y_dot = packed[:, 18:21], packed[:, 21:24]
    assert np.max(np.abs(geo.norm(y) - 1)) < 1e-15
    assert np.max(np.abs(geo.dot(y, y_dot))) < 1e-14
    assert np.max(geo.rotation_defect(packed[:, 6:15].reshape(-1, 3, 3))) < 1e-14


@pytest.mark.parametrize("channel", ["x", "x_dot", "attitude", "omega", "y", "y_dot"])
def test_noise_on_one_channel_leaves_the_others_alone(channel, measured):
    run = fly(VEHICLE, law(push), TUMBLING, 0.1, Plant(noise=Noise(**{channel: 1e-3})))
    for name, error in _errors(run, np.array(measured)).items():
        # A rod measured elsewhere has its rate projected: by 1e-3 of |ẏ| = 2, times a few.
        quiet = 1e-12 if name != "y_dot" or channel != "y" else 1e-2
        assert (np.std(error) > 5e-4) if name == channel else (np.max(np.abs(error)) < quiet), name


def test_without_noise_the_truth_is_measured(measured):
    run = fly(VEHICLE, law(push), TUMBLING, 0.1, Plant())
    # The states of a trajectory are projected once more: a few roundoffs.
    np.testing.assert_allclose(np.array(measured), run.states.packed()[:-1], rtol=0, atol=4e-15)


@pytest.mark.parametrize("disturbed", [Plant(noise=MOTION_CAPTURE), Plant(wind=Wind(gust_on_vehicle=0.5))])
def test_the_same_seed_gives_the_same_flight_and_another_another(disturbed):
    first, again, other = (
        fly(VEHICLE, law(calm), TUMBLING, 0.3, disturbed.replace(seed=seed)).states.packed() for seed in (7, 7, 8)
    )
    np.testing.assert_array_equal(first, again)
    assert np.max(np.abs(first - other)) > 1e-4
    np.testing.assert_array_equal(first[0], other[0])


@pytest.mark.parametrize("on", ["vehicle", "bob"])
def test_gusts_have_the_variance_and_the_correlation_time_asked_for(on):
    # In free fall the momentum grows over a period by the force that acted in it.
    sigma, time, rate, duration = 0.02, 0.04, 250.0, 40.0
    wind = Wind(on_vehicle=(0.01, 0, 0), gust_time=time, **{f"gust_on_{on}": sigma})
    run = fly(
        VEHICLE, lift(lambda t: 0 * t), fp.State(y=(0, 0, -1)), duration, HELD.replace(rate=rate, wind=wind, seed=3)
    )
    force = np.diff(linear_momentum(run.states, VEHICLE), axis=0) * rate + [-0.01, 0, VEHICLE.weight]
    force = force[25:]  # the gust starts at rest; 25 periods are 2.5 correlation times
    independent = duration / time * 3  # samples: the integral of the squared correlation is `time`, three axes
    assert np.std(force) == pytest.approx(sigma, rel=4 / np.sqrt(2 * independent))
    assert np.max(np.abs(force.mean(axis=0))) < 4 * sigma * np.sqrt(2 * time / duration)
    for shift in (1, 10, 25):
        correlation = np.mean(force[shift:] * force[:-shift]) / np.mean(force**2)
        assert correlation == pytest.approx(np.exp(-shift / rate / time), abs=4 / np.sqrt(independent))


@pytest.mark.parametrize(("on", "mass"), [("vehicle", -VEHICLE.M), ("bob", VEHICLE.m)])
def test_a_gust_acts_where_it_is_said_to(on, mass):
    # From rest in free fall l ÿ = F_b/m − F_v/M across the rod; the momentum tells the force of the first period.
    run = fly(VEHICLE, lift(lambda t: 0 * t), UPRIGHT, 0.01, HELD.replace(wind=Wind(**{f"gust_on_{on}": 0.1})))
    period = run.t[1]
    force = linear_momentum(run.states, VEHICLE)[1] / period
    assert np.min(np.abs(force[:2])) > 1e-4
    expected = force[:2] / mass / VEHICLE.l * period
    np.testing.assert_allclose(run.y_dot[1, :2], expected, rtol=1e-5)  # the rod turns by its rate times the period


# The rate interface ----------------------------------------------------------------------------------------------


def test_the_rate_loop_tracks_body_rates_with_its_gain():
    # A law that asks for ω = (ω₁, 0, 0) whatever the state: τ = I k (ω₁ − ω) + ω × I ω turns into that command.
    gain, wanted = 30.0, 0.7
    inertia = ca.DM(VEHICLE.I)

    def control(t, state):
        omega = state.omega
        track = gain * ca.mtimes(inertia, ca.vertcat(wanted, 0, 0) - omega)
        return fp.Wrench(VEHICLE.weight + 0 * t, track + ca.cross(omega, ca.mtimes(inertia, omega)))

    for loop_rate in (500.0, 2000.0):
        settings = Plant(interface="rates", rate=50.0, lag=0.0, rate_loop_rate=loop_rate, rate_loop_gain=gain)
        run = fly(VEHICLE, law(control), UPRIGHT, 0.2, settings)
        steps = run.t * loop_rate
        np.testing.assert_allclose(run.omega[:, 0], wanted * (1 - (1 - gain / loop_rate) ** steps), rtol=0, atol=1e-12)
        # The law acts at 50 Hz, the loop between: the moment at a tick is that of the last step of the loop.
        np.testing.assert_allclose(run.omega[:, 1:], 0, rtol=0, atol=1e-12)


@pytest.mark.parametrize("limits", [True, False])
def test_with_a_loop_as_fast_as_the_law_the_rate_interface_is_the_wrench_interface(limits):
    wrench = Plant(limits=limits, lag=0.0, rate=1000.0)
    rates = wrench.replace(interface="rates", rate_loop_rate=1000.0)
    first, second = (fly(VEHICLE, law(push), TUMBLING, 0.5, p) for p in (wrench, rates))
    np.testing.assert_allclose(second.states.packed(), first.states.packed(), rtol=0, atol=1e-9)
    np.testing.assert_allclose(second.rotor_forces, first.rotor_forces, rtol=0, atol=1e-9)


def test_between_commands_the_rate_loop_makes_a_difference_of_first_order():
    # Held for a period, body rates and a wrench differ by what the rates change in it.
    difference = []
    for rate in (100.0, 200.0, 400.0):
        settings = Plant(limits=False, lag=0.0, rate=rate, rate_loop_rate=2000.0)
        runs = [fly(VEHICLE, law(calm), TUMBLING, 0.5, settings.replace(interface=i)) for i in ("wrench", "rates")]
        difference.append(np.max(np.abs(final(runs[0]) - final(runs[1]))))
    assert difference[0] > 1e-4
    assert difference[1] / difference[0] == pytest.approx(1 / 2, abs=0.15)
    assert difference[2] / difference[1] == pytest.approx(1 / 2, abs=0.15)


# Towards the ideal -----------------------------------------------------------------------------------------------

CORRECTED = fp.laws.corrected(k_d=1, k_1=9, k_2=4)
DOWN = fp.State(x_dot=(1, 0.5, 0), omega=(0.8, -0.3, 0.5), y=(0.6, 0, 0.8), y_dot=(0, 1.0, 0))


@pytest.mark.parametrize(("control", "start"), [slow(law(push), TUMBLING), (law(calm), TUMBLING), (CORRECTED, DOWN)])
def test_a_fast_sampled_flight_converges_to_the_ideal_one_with_order_one(control, start):
    # Also for a law with e₃ down: its thrust and moment are turned into rotor forces and back.
    ideal = fp.simulate(VEHICLE, control, start, 1.0, rtol=1e-11, plant="ideal")
    error = []
    for rate in (1000.0, 2000.0, 4000.0):
        run = fp.simulate(VEHICLE, control, start, 1.0, plant=HELD.replace(rate=rate))
        assert run.e3 == control.e3
        np.testing.assert_allclose(run.t, ideal.t, rtol=0, atol=1e-12)
        error.append(np.max(np.abs(run.states.packed() - ideal.states.packed())))
        # What acted at a sample is what was asked for one period before; the first record is the idle rotors.
        later = slice(1, None)
        atol = 1e-12 + 2 / rate * np.max(np.abs(np.gradient(ideal.thrust, ideal.t)))
        np.testing.assert_allclose(run.thrust[later], ideal.thrust[later], rtol=0, atol=atol)
        np.testing.assert_allclose(run.rotor_forces.sum(axis=1), run.thrust * (1 if run.e3 == "up" else -1), rtol=1e-12)
    assert error[1] / error[0] == pytest.approx(1 / 2, abs=0.02)
    assert error[2] / error[1] == pytest.approx(1 / 2, abs=0.02)
    assert error[2] < 0.01


@ENGINES
def test_a_law_with_e3_down_flies_the_same_as_its_mirror_with_e3_up(engine):
    packed = ca.SX.sym("s", 24)
    wrench = CORRECTED.bind(VEHICLE).evaluate(0, fp.State.symbolic(packed), VEHICLE).wrench
    function = ca.Function("corrected", [packed], [ca.vertcat(-wrench.thrust, ca.diag([1, -1, -1]) @ wrench.moment)])

    def mirrored(t, state):
        answer = function(FLIP_PACKED * state.packed())
        return fp.Wrench(answer[0], answer[1:])

    settings = Plant(engine=engine)
    down = fly(VEHICLE, CORRECTED, DOWN, 0.5, settings)
    up = fly(VEHICLE, law(mirrored), DOWN.flipped(), 0.5, settings)
    assert (down.e3, up.e3) == ("down", "up")
    np.testing.assert_allclose(down.flipped().states.packed(), up.states.packed(), rtol=0, atol=1e-10)
    np.testing.assert_allclose(down.flipped().thrust, up.thrust, rtol=0, atol=1e-12)
    np.testing.assert_allclose(down.flipped().moment, up.moment, rtol=0, atol=1e-12)
    assert np.all(down.thrust < 0)


@pytest.mark.parametrize("interface", ["wrench", "rates"])
def test_a_callable_flies_as_the_law_of_the_same_formula(interface):
    def function(t, state):
        return fp.Wrench(VEHICLE.weight, -0.02 * state.omega)

    settings = Plant(interface=interface, rate=200.0, delay=0.01)
    symbolic = fly(VEHICLE, law(calm), TUMBLING, 0.3, settings)
    plain = fly(VEHICLE, fp.Controller(name="plain", function=function), TUMBLING, 0.3, settings)
    np.testing.assert_allclose(plain.states.packed(), symbolic.states.packed(), rtol=0, atol=1e-12)
    down = fp.Controller(name="down", e3="down", function=lambda t, state: function(t, state.flipped()).flipped())
    turned = fly(VEHICLE, down, TUMBLING.flipped(), 0.3, settings)
    np.testing.assert_allclose(turned.flipped().states.packed(), symbolic.states.packed(), rtol=0, atol=1e-12)


# The engine ------------------------------------------------------------------------------------------------------


def test_the_step_is_of_order_four_with_lagging_rotors_and_exact_for_the_rotors():
    disturbances = {
        "force_on_vehicle": [0.5, -0.3, 0.2],
        "force_on_bob": [0.05, 0.1, -0.05],
        "pivot_offset": (0.03, 0, 0.05),
    }
    wind = np.array(disturbances["force_on_vehicle"] + disturbances["force_on_bob"])
    command, begin, duration = np.array([1.0, 2.0, 1.5, 1.2]), np.array([3.0, 0.1, 2.5, 0.5]), 0.16

    def forces(t):
        return command + (begin - command) * np.exp(-t / VEHICLE.rotor_lag)

    exact = _integrated(VEHICLE, forces, TUMBLING, duration, **{k: np.array(v) for k, v in disturbances.items()})
    error = []
    for steps in (16, 32, 64):
        engine = EquationsEngine(VEHICLE.replace(pivot_offset=disturbances["pivot_offset"]))
        engine.reset(TUMBLING.packed(), begin)
        for _ in range(steps):
            engine.step(command, duration / steps, wind)
        np.testing.assert_allclose(engine.rotors, forces(duration), rtol=0, atol=1e-14)
        error.append(np.max(np.abs(engine.packed - exact)))
    assert np.log2(error[0] / error[1]) == pytest.approx(4, abs=0.35)
    assert np.log2(error[1] / error[2]) == pytest.approx(4, abs=0.35)
    assert error[2] > 1e-11  # above the accuracy of what it is compared with


@pytest.mark.parametrize("step", [1e-3, 1e-2])
def test_a_step_ends_on_the_manifold(step):
    engine = EquationsEngine(VEHICLE)
    engine.reset(fp.State(omega=(3, -2, 4), y=(0.6, 0, 0.8), y_dot=(0, 5, 0)).packed(), np.full(4, 1.0))
    for _ in range(100):
        engine.step(np.array([1.0, 1.4, 1.3, 1.2]), step, np.zeros(6))
        y, y_dot = engine.packed[18:21], engine.packed[21:24]
        assert abs(geo.norm(y) - 1) < 1e-15
        assert abs(geo.dot(y, y_dot)) < 1e-14
        # A Newton step squares the defect, which a step of order four leaves at (ω h)⁵.
        rate = geo.norm(engine.packed[15:18])
        assert geo.rotation_defect(engine.packed[6:15].reshape(3, 3)) < 1e-14 + (rate * step) ** 10


# How flights end -------------------------------------------------------------------------------------------------


@ENGINES
def test_a_law_that_destabilises_ends_as_diverged(engine, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # MuJoCo writes a log of its warnings where it runs
    # f = 50 ẋ₃ held for h: v grows by the factor 1 + a h per tick, against gravity.
    a, g, h = 50 / (VEHICLE.M + VEHICLE.m), VEHICLE.g, 1 / HELD.rate
    control = law(lambda t, state: fp.Wrench(50 * state.x_dot[2], ca.SX.zeros(3)))
    start = fp.State(x_dot=(0, 0, 1), y=(0, 0, -1))
    run = fly(VEHICLE, control, start, 5.0, HELD.replace(engine=engine))
    assert run.outcome.status == "diverged"
    assert "left" in run.outcome.reason

    def ticks(speed):
        return np.log(speed / (1 - g / a)) / np.log(1 + a * h)

    # The last tick before MAX_STATE, give or take one. Before, the thrust makes the hanging rod swing faster than an
    # explicit step can follow, √(f/M l) h = 2.8, and turns sideways.
    swinging = VEHICLE.M * VEHICLE.l * (2.8 / h) ** 2 / 50
    assert ticks(swinging) * h < run.outcome.time < (ticks(MAX_STATE) + 10) * h
    assert run.t[-1] == pytest.approx(run.outcome.time)
    assert np.all(np.isfinite(run.states.packed()))
    assert np.max(np.abs(run.states.packed())) < MAX_STATE
    early = run.t < 0.1
    expected = (1 - g / a) * (1 + a * h) ** (run.t / h) + g / a
    np.testing.assert_allclose(run.x_dot[early, 2], expected[early], rtol=1e-9)


@ENGINES
@pytest.mark.parametrize("settings", [{}, {"limits": False}, {"interface": "rates"}])
@pytest.mark.parametrize("broken", [lambda t: ca.sqrt(0.1 - t), lambda t: 1 / ca.if_else(t < 0.1, 1, 0)])
def test_a_wrench_that_is_no_number_ends_the_flight_and_is_not_limited_away(engine, settings, broken):
    # Rotor limits would turn NaN into the least force, in silence.
    run = fly(VEHICLE, lift(broken), UPRIGHT, 0.3, Plant(engine=engine, **settings))
    assert run.outcome.status == "singular"
    assert run.outcome.reason == "the law's wrench is not a finite number"
    assert run.outcome.time == pytest.approx(0.1, abs=2.1e-3)  # within a period
    assert run.t[-1] == pytest.approx(run.outcome.time)
    assert np.all(np.isfinite(run.states.packed()))


@ENGINES
def test_a_force_too_large_for_an_engine_ends_as_diverged(engine, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run = fly(VEHICLE, lift(lambda t: 1e12 + 0 * t), UPRIGHT, 0.3, HELD.replace(engine=engine))
    assert run.outcome.status == "diverged"
    assert run.outcome.time == 0
    np.testing.assert_array_equal(run.states.packed(), UPRIGHT.packed()[None])


def test_the_computer_around_a_law_is_checked():
    for name, value in (("lead", 0.9), ("latency", -0.01), ("observer", np.nan), ("force_limit", -1)):
        with pytest.raises(fp.InputError, match=f"^{name}: expected a finite number >= "):
            Computer(**{name: value})
    with pytest.raises(fp.InputError, match=r"^models_lag: "):
        Computer(models_lag="x")


@pytest.mark.parametrize("lag", [7e-4, 3e-3])
def test_mujoco_follows_a_short_lag(lag):
    # The longest step of a flight is 2 ms; RK4 would be unstable in a filter of less than 0.72 ms.
    first, second = (fly(VEHICLE, law(push), TUMBLING, 0.3, Plant(engine=e, lag=lag)) for e in ("equations", "mujoco"))
    np.testing.assert_allclose(final(first), final(second), rtol=0, atol=2e-4)


def test_a_lag_too_short_for_mujoco_is_none():
    first, second = (fly(VEHICLE, law(push), TUMBLING, 0.3, Plant(engine="mujoco", lag=lag)) for lag in (0.0, 1e-9))
    np.testing.assert_array_equal(final(first), final(second))


@pytest.mark.parametrize(
    ("fields", "name"),
    [
        ({"delay": 30.0}, "delay"), ({"rate": 1e4, "delay": 0.2}, "delay"), ({"rate": 1e-9}, "rate"),
        ({"rate_loop_rate": 1e12}, "rate_loop_rate"), ({"seed": 2**70}, "seed"), ({"seed": True}, "seed"),
    ],
)  # fmt: skip
def test_what_would_take_for_ever_is_refused(fields, name):
    with pytest.raises(fp.InputError, match=rf"^plant\.{name}: "):
        Plant(**fields)


def test_forces_at_the_start_are_of_all_rotors():
    vehicle = fp.vehicle("hehn2011").replace(rotor_lag=0.02)
    for rotors in ([1.0, 1.0, 1.0], np.ones((2, 4))):
        with pytest.raises(fp.InputError, match=r"^plant\.rotors: "):
            fp.Ideal(lag=True, rotors=rotors).initial_wrench(vehicle, 1, "up")


def test_an_ideal_plant_with_forces_of_each_run_is_hashable_too():
    forces = [[1.0, 2.0, 3.0, 4.0], [4.0, 3.0, 2.0, 1.0]]
    assert fp.Ideal(lag=True, rotors=np.array(forces)) in {fp.Ideal(lag=True, rotors=forces)}
