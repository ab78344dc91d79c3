"""Theorem D in flight, and Ideal(lag=True): the wrench follows its command through the lag, in both engines."""

from dataclasses import replace

import numpy as np
import pytest

import flypend as fp
from flypend.geometry import E3, norm

HEHN = fp.vehicle("hehn2011")
LAGGED = fp.Ideal(lag=True)
START = fp.State.random(np.random.default_rng(5))
FORCES = (3.0, 0.0, 1.0, 2.0)


@pytest.mark.parametrize("law", [fp.laws.almost_global_lag, fp.laws.almost_global], ids=lambda law: law.__name__)
def test_kernel_and_reference_integrator_agree(law):
    times = np.linspace(0, 1, 51)
    plant = fp.Ideal(lag=True, rotors=FORCES)
    one, two = (
        fp.simulate(HEHN, law(), START, 1.0, plant=plant, rtol=1e-11, times=times, engine=engine)
        for engine in ("kernel", "scipy")
    )
    assert one.outcome == two.outcome
    for name in ("x", "x_dot", "R", "omega", "y", "y_dot", "thrust", "moment"):
        # Two step controls at 1e-11, through rates of up to 1e3.
        np.testing.assert_allclose(getattr(one, name), getattr(two, name), rtol=0, atol=1e-7)
    np.testing.assert_allclose(one.rotor_forces[0], FORCES, atol=1e-12)
    np.testing.assert_allclose(one.signals["V_rate_claimed"], two.signals["V_rate_claimed"], rtol=1e-6)


def test_the_wrench_follows_its_command_through_the_lag():
    h, lag = 1e-4, 0.04
    run = fp.simulate(
        HEHN.replace(rotor_lag=lag), fp.laws.almost_global(), START, 0.3, plant=LAGGED, rtol=1e-12,
        times=np.arange(0, 0.3, h),
    )  # fmt: skip
    slope = (run.thrust[2:] - run.thrust[:-2]) / (2 * h)
    wanted = (run.signals["thrust_command"] - run.thrust)[1:-1] / lag
    # The central difference errs by h²/6 times the third derivative, some 1e5 N/s³ here.
    np.testing.assert_allclose(slope, wanted, atol=1e-8 * 1e5)
    assert run.thrust[0] == pytest.approx(4 * HEHN.rotor_limits[0])  # rotors begin at their minimum


def test_v_falls_at_its_claimed_rate_and_the_wrench_arrives():
    run = fp.simulate(HEHN, fp.laws.almost_global_lag(), START, 12.0, plant=LAGGED, rtol=1e-11)
    V, rate, claimed = (run.signals[name] for name in ("V", "V_rate", "V_rate_claimed"))
    np.testing.assert_allclose(rate, claimed, rtol=0, atol=1e-11 * np.max(np.abs(rate)))  # roundoff
    assert np.max(np.diff(V)) <= 1e-9 * V[0]
    terms = [run.signals[f"V_{i}"] for i in range(1, 8)]
    np.testing.assert_allclose(sum(terms), V, rtol=1e-12)
    # The slowest mode is that of B, some −0.9 /s: e^(−0.9 · 12) of an error of some metres.
    assert norm(run.x[-1]) < 1e-3
    assert norm(run.y[-1] - E3) < 1e-3
    assert abs(run.signals["thrust_error"][-1]) < 1e-3
    assert run.thrust[-1] == pytest.approx(HEHN.weight, abs=1e-3)


def test_a_law_that_does_not_know_the_lag_lets_v_rise():
    run = fp.simulate(HEHN.replace(rotor_lag=0.06), fp.laws.almost_global(), START, 4.0, plant=LAGGED)
    assert np.max(np.diff(run.signals["V"])) > 1e-3 * run.signals["V"][0]


def test_each_run_of_an_ensemble_has_rotors_of_its_own():
    starts = fp.random_starts(3, 7)
    forces = np.random.default_rng(1).uniform(0, 3, (3, 4))
    times = np.linspace(0, 0.5, 11)
    law, plant = fp.laws.almost_global_lag(), fp.Ideal(lag=True, rotors=forces)
    assert plant in {fp.Ideal(lag=True, rotors=forces.tolist())}  # equal, and hashable as every plant
    flown = fp.simulate_ensemble(HEHN, law, starts, 0.5, plant=plant, times=times)
    np.testing.assert_allclose(flown.wrenches[:, 0] @ HEHN.unmixing().T, forces, atol=1e-12)
    for i in range(3):
        alone = fp.simulate(HEHN, law, starts[i], 0.5, plant=replace(plant, rotors=forces[i]), times=times)
        np.testing.assert_allclose(flown.samples.x[i], alone.x, atol=1e-9)
        np.testing.assert_allclose(flown.wrenches[i, :, 0], alone.thrust, atol=1e-8)


@pytest.mark.parametrize("plant", ["rotors", "ideal"])
def test_the_law_flies_where_its_wrench_is_known_only(plant):
    with pytest.raises(fp.InputError, match=r"^plant: expected flypend\.Ideal\(lag=True\), for almost_global_lag"):
        fp.simulate(HEHN, fp.laws.almost_global_lag(), START, 1.0, plant=plant)


def test_what_a_lag_needs():
    still = HEHN.replace(rotor_lag=0.0)
    with pytest.raises(fp.InputError, match=r"^vehicle\.rotor_lag: expected a lag > 0 s"):
        fp.laws.almost_global_lag().bind(still)
    with pytest.raises(fp.InputError, match=r"^vehicle\.rotor_lag: expected a lag > 0 s, for Ideal"):
        fp.simulate(still, fp.laws.almost_global(), START, 1.0, plant=LAGGED)
    with pytest.raises(fp.InputError, match=r"^plant\.rotors: expected nothing without lag"):
        fp.Ideal(rotors=FORCES)
    with pytest.raises(fp.InputError, match=r"^plant\.rotors: expected forces of 4 rotors"):
        fp.simulate(HEHN, fp.laws.almost_global(), START, 1.0, plant=fp.Ideal(lag=True, rotors=(1.0, 2.0)))
    with pytest.raises(fp.InputError, match=r"^plant\.lag: expected true or false"):
        fp.Ideal(lag=0.02)


def test_what_is_guaranteed_of_a_start_holds_along_its_flight():
    law = fp.laws.almost_global_lag().bind(HEHN)
    told = law.guarantee(START)
    run = fp.simulate(HEHN, law, START, 5.0, plant=LAGGED)
    assert told.covered
    assert pytest.approx(run.signals["V"][0], rel=1e-12) == told.V
    assert np.max(norm(run.x)) <= told.excursion
    assert np.max(norm(run.y_dot)) <= told.rod_rate
    assert told.thrust[0] <= np.min(np.abs(run.thrust))
    assert np.max(np.abs(run.thrust)) <= told.thrust[1]
    assert any("rotor_lag" in line for line in told.assumes)
    upside_down = fp.State(y=(0, 0, 1), R=np.diag([1.0, -1.0, -1.0]))
    assert not law.guarantee(upside_down).covered
