"""The flight computer: what it predicts, how it leads the rotors, and which forces it believes in."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend import geometry as geo
from flypend.board.command import finish, total_forces, usable_lead
from flypend.board.nominal import Nominal
from flypend.board.observer import RECORD, observer
from flypend.compile.numeric import as_numpy
from flypend.flight import sampled
from flypend.laws import Computer
from flypend.plants import MOTION_CAPTURE, ROTORS, Plant, Wind
from flypend.plants.equations import EquationsEngine
from flypend.plants.loop import Loop

VEHICLE = fp.vehicle("hehn2011")
M, m, l = VEHICLE.M, VEHICLE.m, VEHICLE.l
LOW, HIGH = VEHICLE.rotor_limits
HOVER = VEHICLE.weight / 4
UPRIGHT = fp.State(y=(0, 0, 1))
TUMBLING = fp.State(x_dot=(0.5, 0, 0), omega=(0.3, 2.0, 0.1), y=(0.6, 0, 0.8), y_dot=(0, 2.0, 0))


def busy(t, state, vehicle, k):
    """A wrench that turns the vehicle about and meets the limits of its rotors now and then."""
    return fp.Wrench(7 + 6 * ca.sin(7 * t), 0.15 * ca.vertcat(ca.cos(9 * t), ca.sin(8 * t), 0) - 0.01 * state.omega)


def law(control=busy, **computer):
    return fp.Law(name="test", e3="up", control=control, computer=Computer(**computer))


class Log:
    """What flight computers did in the flights since it was cleared."""

    def __init__(self):
        self.clear()

    def clear(self):
        self.predicted, self.rotors, self.forces, self.commands = [], [], [], []


@pytest.fixture
def log(monkeypatch):
    seen = Log()

    class Spy(sampled.SteppedBoard):
        def command(self, t, packed):
            command = super().command(t, packed)
            state, rotors, outside = self.predicted
            found = (state, rotors, total_forces(Nominal(VEHICLE))(state, rotors, outside).full().ravel())
            for column, value in zip((seen.predicted, seen.rotors, seen.forces), found, strict=True):
                column.append(value)
            seen.commands.append(command)
            return command

    monkeypatch.setattr(sampled, "SteppedBoard", Spy)
    return seen


def fly(control, start, duration, plant):
    """The flight, step by step (the reference of the kernel), sampled at every control tick."""
    ticks = np.arange(round(duration * plant.rate) + 1) / plant.rate
    times = np.minimum(ticks, duration)
    return fp.simulate(VEHICLE, control, start, duration, plant=plant, times=times, engine="scipy")


# Prediction ------------------------------------------------------------------------------------------------------


def _prediction_error(log, run, ticks):
    """Largest error of the state and of the rotor forces predicted `ticks` ahead."""
    n = len(run.t) - ticks - 1
    state = np.array(log.predicted)[:n] - run.states.packed()[ticks : ticks + n]
    rotors = np.array(log.rotors)[:n] - run.rotor_forces[ticks : ticks + n]
    return np.max(np.abs(state)), np.max(np.abs(rotors))


@pytest.mark.parametrize(
    ("rate", "delay"),
    [(500.0, 0.0), (500.0, 0.02), (100.0, 0.03), (50.0, 0.02), (200.0, 0.005)],
)
@pytest.mark.parametrize("limits", [True, False])
def test_with_a_perfect_model_it_predicts_the_state_at_actuation(rate, delay, limits, log):
    # From the first tick on, while the rotors still idle: it knows what it has commanded, and what comes before.
    run = fly(law(latency=delay), TUMBLING, 1.0, Plant(rate=rate, delay=delay, limits=limits))
    state, rotors = _prediction_error(log, run, round(delay * rate))
    # One step of up to 25 ms, which predicts as well as tests/plants/test_cascade.py says, against steps of 2 ms; over
    # a quarter of that, (1/4)⁴ of the error.
    assert state < (1e-3 if delay > 5e-3 else 1e-5)
    assert rotors < 1e-12
    touched = np.any(np.isclose(np.array(log.commands), LOW)) and np.any(np.isclose(np.array(log.commands), HIGH))
    assert touched == limits


def test_a_prediction_within_a_period_is_the_state_between_two_ticks(log):
    # 3 ms of a period of 10 ms: until the new command arrives, the one before acts.
    rate, delay = 100.0, 0.003
    run = fly(law(latency=delay), TUMBLING, 0.5, Plant(rate=rate, delay=delay))
    engine = EquationsEngine(VEHICLE)
    for k in range(1, len(run.t) - 1):
        engine.reset(run.states.packed()[k], run.rotor_forces[k])
        for _ in range(3):
            engine.step(log.commands[k - 1], 1e-3, np.zeros(6))
        np.testing.assert_allclose(log.predicted[k], engine.packed, rtol=0, atol=1e-6)
        np.testing.assert_allclose(log.rotors[k], engine.rotors, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    "wrong", [{"delay": 0.01}, {"delay": 0.03}, {"mismatch": {"inertia": 1.2}}, {"mismatch": {"rotor_lag": 2.0}}]
)
def test_a_wrong_model_predicts_a_wrong_state(wrong, log):
    """Negative control of the tests above."""
    run = fly(law(latency=0.02), TUMBLING, 1.0, Plant(delay=0.02).replace(**wrong))
    assert _prediction_error(log, run, 10)[0] > 1e-2


def test_in_the_rate_interface_the_prediction_follows_the_loop_on_board(log):
    run = fly(law(latency=0.03), TUMBLING, 1.0, Plant(interface="rates", rate=50.0, delay=0.03, rate_loop_gain=20.0))
    steps = np.array(log.predicted)
    truth = run.states.packed()
    # Recorded at 50 Hz, predicted 1.5 periods ahead: between the truth one and two periods ahead in every tick,
    # compared on what moves steadily, the position.
    x = (truth[1:-1, :3] + truth[2:, :3])[: len(steps) - 2] / 2
    assert np.max(np.abs(steps[: len(x), :3] - x)) < 2e-3  # ẍ T²/8 of 20 m/s² and 20 ms: 1e-3
    late = np.max(np.abs(steps[: len(x), :3] - truth[: len(x), :3]))
    assert late > 0.05  # 30 ms at some m/s


@pytest.mark.parametrize("gain", [10.0, 20.0])
def test_the_rates_asked_for_are_those_with_which_the_loop_on_board_gives_the_moment(gain):
    loop = Loop(VEHICLE, law().bind(VEHICLE), Plant(interface="rates", rate_loop_gain=gain))
    moment, omega = np.array([0.02, -0.03, 0.01]), TUMBLING.omega
    asked = finish(loop, Nominal(VEHICLE))([5.0, *moment], TUMBLING.packed(), np.full(4, HOVER), [])
    thrust, *rates = np.array(asked).ravel()
    given = gain * VEHICLE.I @ (rates - omega) + np.cross(omega, VEHICLE.I @ omega)
    np.testing.assert_allclose([thrust, *given], [5.0, *moment], rtol=0, atol=1e-15)


def test_the_law_is_evaluated_at_the_time_of_actuation():
    # A thrust that depends on time alone arrives as what it should be then, whatever the delay that is planned for.
    def thrust(t, state, vehicle, k):
        return fp.Wrench(VEHICLE.weight * (1 + t), ca.SX.zeros(3))

    settings = Plant(rate=100.0, delay=0.03, lag=0.0, limits=False)
    for latency, early in ((0.0, 0.0), (0.03, 0.03)):
        run = fly(law(thrust, latency=latency), UPRIGHT, 0.2, settings)
        expected = VEHICLE.weight * (1 + run.t[:-4] + early)
        np.testing.assert_allclose(run.thrust[4:], expected, rtol=0, atol=1e-12)


# Lead ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("lead", [1.0, 1.5, 2.5])
def test_lead_divides_the_time_constant_of_the_rotors(lead):
    # Commands c = f̂ + λ (f − f̂), held for h: the distance to f shrinks per period by 1 − λ (1 − e^{−h/T}).
    def constant(t, state, vehicle, k):
        return fp.Wrench(VEHICLE.weight + 0 * t, ca.SX.zeros(3))

    lag = VEHICLE.rotor_lag
    for rate in (100.0, 4000.0):
        run = fly(law(constant, lead=lead), UPRIGHT, 0.1, Plant(rate=rate))
        factor = 1 - lead * (1 - np.exp(-1 / rate / lag))
        distance = (run.rotor_forces[:, 0] - HOVER) / (LOW - HOVER)
        np.testing.assert_allclose(distance, factor ** np.arange(len(run.t)), rtol=0, atol=1e-12)
    # At a high rate: first order with T/λ, to λ² h/2T = 4 % of the exponent.
    np.testing.assert_allclose(distance, np.exp(-lead * run.t / lag), rtol=0, atol=0.02)


def test_lead_stays_within_the_limits_unless_they_are_off():
    def most(t, state, vehicle, k):
        return fp.Wrench(0.9 * 4 * HIGH + 0 * t, ca.SX.zeros(3))

    wanted, lag, rate = 0.9 * HIGH, VEHICLE.rotor_lag, 500.0
    limited, free = (
        fly(law(most, lead=3.0), UPRIGHT, 0.01, Plant(limits=limits, rate=rate)) for limits in (True, False)
    )
    rise = 1 - np.exp(-1 / rate / lag)
    assert limited.rotor_forces[1, 0] == pytest.approx(LOW + (HIGH - LOW) * rise, abs=1e-12)
    assert free.rotor_forces[1, 0] == pytest.approx(LOW + 3 * (wanted - LOW) * rise, abs=1e-12)


# Force observer --------------------------------------------------------------------------------------------------

BANDWIDTH = 1.5


def _observed(force, start, rotors, duration=5.0, period=2e-3, vehicle=VEHICLE):
    """Times (n,), estimates (n, 6) and rods (n, 3) under constant `force` (6,) and rotor forces; no flight computer."""
    engine = EquationsEngine(vehicle.replace(rotor_lag=0))
    observe = _observer(period)
    engine.reset(start.packed(), rotors(0.0))
    estimates, rods = [], []
    times = np.arange(round(duration / period) + 1) * period
    for t in times:
        estimates.append(observe(engine.packed, rotors(t)))
        rods.append(engine.packed[18:21])
        for part in range(4):
            engine.step(rotors(t + (part + 0.5) * period / 4), period / 4, force)  # held at the middle
    return times, np.array(estimates), np.array(rods)


def _update(period):
    return as_numpy(observer(Nominal(VEHICLE), Computer(observer=BANDWIDTH), period, 4))


def _observer(period):
    """What an observer estimates, measurement after measurement."""
    update, memory = _update(period), np.zeros(RECORD.length)

    def observe(measured, rotors):
        memory[:], forces, _ = update(measured, rotors, memory, np.zeros(0))
        return forces

    return observe


def hovering(t):
    return np.full(4, HOVER)


@pytest.mark.parametrize("y", [(0, 0, 1), (0.6, 0, 0.8), (0, -0.8, -0.6), (1, 0, 0)])
def test_the_estimate_of_a_force_converges_exponentially_to_the_truth(y):
    # Force per mass the same on both: nothing turns the rod, whatever its tilt, and both forces are seen in full.
    per_mass = np.array([0.6, -0.4, 0.3])
    force = np.concatenate([M * per_mass, m * per_mass])
    t, estimate, _ = _observed(force, fp.State(y=y), hovering)
    share = 1 - (1 - BANDWIDTH * 2e-3) ** (np.arange(len(t)))  # N̂ grows by L T (N − N̂) per period
    np.testing.assert_allclose(estimate, share[:, None] * force, rtol=0, atol=1e-5)  # trapezoidal rule, T = 2 ms
    np.testing.assert_allclose(share, 1 - np.exp(-BANDWIDTH * t), rtol=0, atol=1e-3)
    assert np.max(np.abs(estimate[-1] - force)) < 2 * np.exp(-BANDWIDTH * 5) * np.max(force)


@pytest.mark.parametrize("scale", [-0.2, 0.3])
def test_what_scales_the_thrust_of_a_tumbling_vehicle_is_told_from_a_force(scale):
    force, engine = np.array([0.3, -0.2, 0.1, 0.02, 0, 0.03]), EquationsEngine(VEHICLE.replace(rotor_lag=0))
    update, memory = _update(2e-3), np.zeros(RECORD.length)
    engine.reset(TUMBLING.packed(), np.full(4, HOVER))
    shares = []
    for _ in range(1500):
        memory, forces, found = update(engine.packed, np.full(4, HOVER), memory, np.zeros(0))
        shares.append(found.item() / scale)
        for _ in range(4):
            engine.step(np.full(4, (1 + scale) * HOVER), 5e-4, force)
    # The constant force, which rises as slowly behind the filter as the thrust does at first, is not taken for a scale.
    assert min(shares) > -0.05
    assert max(shares) < 1.05
    assert shares[-1] > 0.95
    assert forces[:3] + forces[3:] == pytest.approx(force[:3] + force[3:], abs=0.03)


def test_of_a_force_along_the_rod_the_sum_is_seen_and_not_who_feels_it():
    # D = F_b/m − F_v/M along an upright rod turns nothing: the bob is taken to feel its share by mass.
    force = np.array([0, 0, 0.5, 0, 0, -0.1])
    *_, estimate, rods = _observed(force, UPRIGHT, hovering)
    np.testing.assert_array_equal(rods[-1], [0, 0, 1])
    share = 1 - (1 - BANDWIDTH * 2e-3) ** (len(estimate) - 1)
    np.testing.assert_allclose(estimate[-1, [2, 5]], share * 0.4 / (M + m) * np.array([M, m]), rtol=0, atol=1e-6)


def test_a_force_across_the_rod_is_told_apart_by_who_feels_it():
    # A rod hanging in a sidewind of its own swings about; the mean of the estimates is the truth across it.
    force = np.array([0.3, 0, 0, -0.02, 0.03, 0])
    t, estimate, rods = _observed(force, fp.State(y=(0, 0, -1)), hovering, duration=8.0)
    late = t > 4
    across = geo.tangent_part(rods[late], estimate[late, 3:] - force[3:])
    # What the rod's swing (0.3 rad) hides along itself comes back with the lag of the observer.
    assert np.max(np.abs(across)) < 0.01
    np.testing.assert_allclose(
        estimate[late, :3] + estimate[late, 3:], np.tile([0.28, 0.03, 0], (late.sum(), 1)), rtol=0, atol=1e-3
    )


def test_without_a_force_the_estimate_is_zero_whatever_is_done():
    def rotors(t):
        return HOVER * (1 + 0.8 * np.sin([9 * t, 7 * t, 9.5 * t, 6 * t]))

    for period in (2e-3, 2e-2):
        _, estimate, rods = _observed(np.zeros(6), TUMBLING, rotors, duration=3.0, period=period)
        assert np.max(geo.norm(np.diff(rods, axis=0))) > period  # it tumbles
        # L times the error of the trapezoidal rule, T²/12 of a rate of thrust of 40 N/s, tripled for its turning.
        assert np.max(np.abs(estimate)) < BANDWIDTH * period**2 / 12 * 120
    lighter = VEHICLE.replace(mass=0.9 * M)
    _, estimate, _ = _observed(np.zeros(6), TUMBLING, rotors, vehicle=lighter)
    assert np.max(np.abs(estimate)) > 0.1  # negative control: 50 g that are missing look like a tenth of the thrust


def test_an_estimate_is_limited_in_length():
    limit = Computer().force_limit * VEHICLE.weight
    force = np.array([10.0, 3.0, -5.0, 6.0, 0, 2.0])
    _, estimate, _ = _observed(force, fp.State(y=(0, 0, -1)), hovering, duration=2.0)
    lengths = geo.norm(estimate[:, :3])
    assert np.max(lengths) == pytest.approx(limit, rel=1e-12)
    assert np.max(geo.norm(estimate[:, 3:])) <= limit * (1 + 1e-12)
    last = estimate[-1, :3] / limit
    assert last @ force[:3] / geo.norm(force[:3]) > 0.9  # shortened, not turned


def test_the_observer_is_off_with_bandwidth_zero_and_starts_at_zero(log):
    fly(law(), TUMBLING, 0.1, Plant(wind=WIND))
    np.testing.assert_array_equal(np.array(log.forces), 0)
    # One measurement tells no force, however far from equilibrium.
    np.testing.assert_array_equal(_observer(0.02)(TUMBLING.packed(), np.full(4, LOW)), np.zeros(6))


# The inverted law in the wind ------------------------------------------------------------------------------------

WIND = Wind(on_vehicle=(0.5, 0, 0), on_bob=(0, 0.05, 0))


def _last_second(run):
    return run.t >= run.t[-1] - 1


def test_a_constant_wind_leaves_no_steady_position_error(log):
    run = fly(fp.laws.inverted(), UPRIGHT, 9.0, Plant(wind=WIND))
    last = _last_second(run)
    assert np.max(geo.norm(run.x[last])) < 0.02
    # The rod leans against the force on the bob, y ∥ g e₃ − F_b/m, and stays up.
    lean = geo.unit(VEHICLE.g * np.array([0, 0, 1]) - np.array(WIND.on_bob) / m)
    np.testing.assert_allclose(run.y[last], np.tile(lean, (last.sum(), 1)), rtol=0, atol=2e-3)
    # What is believed: the sum of both in full, and of the difference D what lies across the rod.
    estimate, force = log.forces[-1], np.array(WIND.on_vehicle + WIND.on_bob)
    np.testing.assert_allclose(estimate[:3] + estimate[3:], force[:3] + force[3:], rtol=0, atol=1e-3)
    along = (force[3:] / m - force[:3] / M) @ lean * lean
    # Who feels what is along the rod is not seen, and a little of it passes for a scale of the thrust.
    np.testing.assert_allclose(estimate[3:], force[3:] - m * M / (M + m) * along, rtol=0, atol=2e-3)


def test_without_the_observer_the_wind_does_leave_one(log):
    """Negative control of the test above."""
    run = fly(fp.laws.inverted(observer=0.0), UPRIGHT, 9.0, Plant(wind=WIND))
    assert run.outcome.status == "completed"
    assert np.min(geo.norm(run.x[_last_second(run)])) > 0.1
    np.testing.assert_array_equal(np.array(log.forces), 0)


def test_with_the_delay_that_is_planned_for_a_throw_raises_no_false_alarm(log):
    control = fp.laws.inverted().bind(VEHICLE)
    start = fp.State.random(np.random.default_rng(12345))
    fly(control, start, 2.0, Plant(delay=control.computer.latency))
    quiet = np.max(np.abs(log.forces))
    log.clear()
    fly(control, start, 2.0, Plant(delay=control.computer.latency, mismatch={"mass": 1.1}))
    assert quiet < 0.01  # 2 % of the force that a tenth of the mass weighs
    assert np.max(np.abs(log.forces)) > 10 * quiet


def test_noise_is_not_taken_for_a_force(log):
    # White noise of v in m/s shows as a force of L (M+m) v.
    fly(fp.laws.inverted(), UPRIGHT, 3.0, Plant(noise=MOTION_CAPTURE))
    forces = np.array(log.forces)[500:]
    assert np.std(forces[:, :3] + forces[:, 3:]) < 5 * BANDWIDTH * (M + m) * MOTION_CAPTURE.x_dot


# At 50 Hz a lead of 2.1 overshoots between two commands (lag 20 ms), and the thrust axis swings by 0.06 for ever.
def test_the_lead_does_not_overshoot_within_a_period():
    # With 28 ms of latency the law trembles by 0.012 at 50 Hz, whatever the lead: docs/laws/inverted.md.
    vehicle, law = fp.vehicle("hehn2011"), fp.laws.inverted(latency=0.024)
    slow, fast = Plant(rate=50.0), Plant(rate=500.0)
    bound = law.bind(vehicle)
    assert usable_lead(bound, vehicle, fast) == bound.computer.lead
    assert usable_lead(bound, vehicle, slow) * (1 - np.exp(-0.02 / 0.02)) == pytest.approx(1, abs=1e-12)
    run = fp.simulate(vehicle, law, fp.State(y=(0, np.sin(0.1), np.cos(0.1))), 6.0, plant=slow)
    assert np.max(np.abs(run.z[-100:] - [0, 0, 1])) < 1e-3


@pytest.mark.parametrize("delay", [0.0, 0.02])
def test_a_light_machine_with_strong_rotors_stands(delay):
    """By a force that stays, instead of a scale of the thrust, none of these did."""
    vehicle = fp.vehicle("crazyflie")
    plant = ROTORS.replace(mismatch={"mass": 0.8}, strength=1.15, delay=delay)
    runs = fp.simulate_ensemble(vehicle, fp.laws.inverted(), fp.random_starts(12, 4321), 15.0, plant=plant)
    assert runs.success.all()
