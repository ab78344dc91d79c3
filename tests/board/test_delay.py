"""The delay that the flight computer finds: whether it is the true one, what hides it, and what it is worth."""

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import flypend as fp
from flypend.board.delay import DelayEstimator
from flypend.board.nominal import Nominal
from flypend.compile.numeric import as_numpy
from flypend.flight import sampled
from flypend.flight.request import Flight
from flypend.flight.sampled import fly_stepwise
from flypend.geometry import cross
from flypend.plants import ROTORS, SUITES
from flypend.plants.equations import EquationsEngine
from flypend.plants.loop import Loop
from tests.few import few, slow

VEHICLE = fp.vehicle("hehn2011")
NONE = np.zeros(0)
TOLD, REACH = 0.025, 0.06
HOVER = VEHICLE.weight / 4 * np.ones(4)


def made(vehicle=VEHICLE, period=0.002, lag_left=0.0):
    return DelayEstimator(Nominal(vehicle), TOLD, REACH, period, lag_left)


def busy(t):
    """Rotor forces (n, 4), N, that turn the vehicle about; linear between multiples of 8 ms."""
    knots = np.arange(0, t.max() + 0.1, 0.008)
    turn = 0.4 * np.sin(9 * knots)[:, None] * [1, 0, -1, 0] + 0.3 * np.sin(6 * knots + 1)[:, None] * [0, 1, 0, -1]
    return np.stack([np.interp(t, knots, column) for column in (HOVER + turn).T], axis=-1)


def turned(forces, period, vehicle=VEHICLE, substeps=20):
    """Angular velocities (n, 3) at multiples of a `period` under `forces` of the time t (s): small Euler steps."""
    omega, out, h = np.zeros(3), [], period / substeps
    mixing, inertia, mobility = vehicle.mixing(), vehicle.I, h * vehicle.I_inv
    for k in range(round(2.5 / period)):
        out.append(omega)
        for tau in (mixing @ forces(k * period + (np.arange(substeps) + 0.5) * h).T)[1:].T:
            omega = omega + mobility @ (tau - cross(omega, inertia @ omega))
    return np.array(out)


def found(delay, *, wrong=1.0, noise=0.0, signal=busy, period=0.002):
    """The delays estimated along a flight whose commands act `delay` (s) late, moments `wrong` times as large."""
    estimator = made(period=period)
    step, memory = as_numpy(estimator.find()), estimator.begin(HOVER)
    omegas = turned(lambda t: HOVER + wrong * (signal(np.maximum(t - delay, 0)) - HOVER), period)
    omegas = omegas + noise * np.random.default_rng(0).standard_normal(omegas.shape)
    delays = []
    for k, omega in enumerate(omegas):
        acting = signal(np.array([k * period]))[0]
        memory, *_ = step(memory, omega, acting, acting, NONE)
        delays.append(memory[2])
    return np.array(delays)


SOME = ((0.0, 0.01), (0.013, 0.001), (0.04, 0.002), (0.04, 0.01), (0.08, 0.002))


@pytest.mark.parametrize(("delay", "period"), few(SOME, (0.0, 0.013, 0.04, 0.08), (0.001, 0.002, 0.01)))
def test_it_finds_the_true_delay(delay, period):
    # 0.5 ms: in steps of 10 ms the mean moment of a period is that of its ends.
    assert found(delay, period=period)[-1] == pytest.approx(delay, abs=5e-4)


@pytest.mark.parametrize("delay", [0.005, 0.013])
def test_it_does_not_overshoot(delay):
    """What its filters remember is held against the delay as it is known now, not as it was believed then.

    By more than a seventh, for the moment is not linear over the 12 ms between what is told and what is true.
    """
    delays = found(delay)
    assert np.all((delays - TOLD) / (delay - TOLD) < 8 / 7)


def test_it_does_not_go_beyond_its_reach():
    assert found(0.12)[-1] == TOLD + REACH


def test_strength_and_inertia_do_not_look_like_a_delay():
    for wrong in (0.75, 1.25):
        assert found(0.03, wrong=wrong)[-1] == pytest.approx(0.03, abs=5e-3)


def test_noise_of_the_gyroscope_hides_it_only_where_nothing_moves():
    assert found(0.04, noise=0.02)[-1] == pytest.approx(0.04, abs=3e-3)
    still = found(0.04, noise=0.02, signal=lambda t: np.tile(HOVER, (len(t), 1)))
    np.testing.assert_allclose(still, TOLD, atol=1e-12)


def test_a_lag_longer_than_believed_counts_as_delay():
    """A lag T + e is, to first order in the frequency, a lag T and a delay e."""
    loop = Loop(VEHICLE, fp.laws.inverted().bind(VEHICLE), ROTORS)
    late = _flown(loop, ROTORS.replace(lag=VEHICLE.rotor_lag + 0.02))
    assert 0.01 < late < 0.025
    assert _flown(loop, ROTORS) < 0.002


def _flown(loop, plant, duration=1.5):
    """The delay that the board of `loop` has found by the end of a throw in `plant`, s."""
    start, seen = fp.State(y=(0.0, 0.6, -0.8)), []

    original = sampled.SteppedBoard.command

    def command(self, t, measured):
        answer = original(self, t, measured)
        seen.append(self.delay)
        return answer

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sampled.SteppedBoard, "command", command)
        fly_stepwise(Flight(vehicle=loop.vehicle, law=loop.law, starts=start, duration=duration, plant=plant, seed=1))
    return seen[-1]


def test_what_is_predicted_is_where_the_vehicle_is_when_its_command_acts():
    """Without lag left and with the delay known, against small steps of the same equations."""
    delay = 0.04
    estimator = DelayEstimator(Nominal(VEHICLE), delay, 0.02, 0.002, 0.0)
    find, carry, memory = as_numpy(estimator.find()), as_numpy(estimator.carry()), estimator.begin(busy(np.zeros(1))[0])
    engine = EquationsEngine(VEHICLE.replace(rotor_lag=0.0))
    engine.reset(fp.State(y=(0.0, 0.6, 0.8), omega=(1.0, -2.0, 0.5)).packed(), HOVER)
    states, predicted = [], []
    for k in range(200):
        states.append(engine.packed)
        acting = busy(np.array([k * 0.002]))[0]
        memory, horizon, wrenches = find(memory, engine.packed[15:18], acting, acting, NONE)
        predicted.append(carry(engine.packed, horizon, wrenches, np.zeros(8), NONE))
        for j in range(4):
            engine.step(busy(np.array([max(0.0, k * 0.002 + (j + 0.5) * 0.0005 - delay)]))[0], 0.0005, np.zeros(6))
    late = round(delay / 0.002)
    wrong = np.abs(np.array(predicted)[50:-late] - np.array(states)[50 + late :]).max()
    nothing = np.abs(np.array(states)[50:-late] - np.array(states)[50 + late :]).max()
    assert wrong < 5e-3 < 0.1 < nothing


def test_forces_that_act_are_late_by_the_delay_found_once_it_is():
    """An estimator moves by them; where nothing is told, they are as late as it assumes."""
    estimator = DelayEstimator(Nominal(VEHICLE), TOLD, REACH, 0.002, assumed=0.02)
    find, acting, memory = as_numpy(estimator.find()), as_numpy(estimator.acting()), estimator.begin(HOVER)
    delay, times, tells = 0.045, 0.002 * np.arange(1, 1251), estimator.record.place("information")
    off = {"found": [], "at once": [], "assumed": []}
    for t, omega in zip(times, turned(lambda t: busy(np.maximum(t - delay, 0)), 0.002), strict=True):
        memory, *_ = find(memory, omega, *[busy(np.array([t - 0.002]))[0]] * 2, NONE)
        untold = np.array(memory)
        untold[tells] = 0.0
        for name, late, known in (("found", delay, memory), ("at once", 0.0, memory), ("assumed", 0.02, untold)):
            act = acting(known, busy(np.array([t]))[0], NONE)
            off[name].append(np.abs(act - busy(np.maximum([t - late], 0))[0]).max())
    # N; forces change by 3.6 N/s, and are remembered every 8 ms.
    assert max(off["found"][500:]) < 0.02 < 0.1 < max(off["at once"][500:])
    assert max(off["assumed"][500:]) < 0.02


@settings(deadline=None)  # a busy machine must not decide
@given(st.floats(0.002, 0.08), st.integers(1, 4), st.integers(0, 100))
def test_mean_and_end_are_those_of_the_wrench_between_what_is_remembered(delay, phase, seed):
    """What is remembered is linear in between, so the integrals by the trapezoidal rule are exact at its knots."""
    estimator, rng = made(), np.random.default_rng(seed)
    ages = np.append(0.0, 0.002 * phase + 0.008 * np.arange(estimator.depth))
    values = rng.standard_normal(len(ages))
    at, over = (np.array(w).ravel() for w in as_numpy(_weights(estimator))(delay, float(phase)))
    fine = np.unique(np.append(np.linspace(0, delay, 20001), ages[ages < delay]))
    signal = np.interp(fine, ages, values)
    assert at @ values == pytest.approx(np.interp(delay, ages, values), abs=1e-12)
    assert over @ values == pytest.approx(np.trapezoid(signal, fine), abs=1e-12)


def _weights(estimator):
    age, phase = ca.SX.sym("age"), ca.SX.sym("phase")
    return ca.Function("weights", [age, phase], [ca.densify(w) for w in estimator.weights(age, phase)])


# What it is worth -------------------------------------------------------------------------------------------------


def stand(sensors, **gains):
    """How many of 40 flights stand under an untold delay of twice what is expected."""
    plant = ROTORS.replace(delay=0.05, sensors=None if sensors is None else SUITES[sensors].replace(command_delay=0.0))
    law, starts = fp.laws.inverted(**gains), fp.random_starts(40, 77)
    return int(fp.simulate_ensemble(VEHICLE, law, starts, 10.0, plant=plant).success.sum())


@pytest.mark.parametrize("sensors", [None, "mocap"])
def test_an_untold_delay_of_twice_what_is_expected_is_no_loss(sensors):
    assert stand(sensors) >= 36


@pytest.mark.parametrize("sensors", [None, slow("mocap")])
def test_without_reach_hardly_a_flight_stands(sensors):
    """Negative control of the test above."""
    assert stand(sensors, delay_reach=0.0) <= 4


def test_a_delay_that_nobody_told_is_not_felt_as_a_force():
    """With an accelerometer, of 80 ms. An estimator that goes on to assume none loses nine flights of ten."""
    plant = ROTORS.replace(delay=0.08, sensors=SUITES["mocap"].replace(command_delay=0.0))
    starts = fp.random_starts(40, 78)
    assert fp.simulate_ensemble(VEHICLE, fp.laws.inverted(), starts, 10.0, plant=plant).success.sum() >= 28


def test_a_reference_is_followed_at_the_time_when_commands_act():
    """The law looks ahead by the delay found: at 1 m/s, 40 ms that nobody told of would be 40 mm behind."""
    circle = fp.laws.references.circle(0.5, 2.0)
    at_once, late = (
        fp.simulate(VEHICLE, fp.laws.inverted(circle), fp.State(y=(0, 0, 1)), 14.0, plant=ROTORS.replace(delay=delay))
        for delay in (0.0, 0.04)
    )
    assert np.max(np.linalg.norm(late.x - at_once.x, axis=-1)[late.t > 10]) < 2e-3
