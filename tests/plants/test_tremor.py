"""Tremor in hover: linear theory against flights, and the gains that follow from it."""

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.compile.numeric import as_numpy
from flypend.flight.request import Flight
from flypend.flight.tasks import task_starts
from flypend.laws import inverted
from flypend.laws.inverted_gains import CALM
from flypend.plants import SUITES, Plant
from flypend.plants.loop import Loop
from flypend.plants.tremor import CALM_TREMOR, LIGHT, MOST_TREMOR, calm, too_noisy, tremor
from tests.few import slow

VEHICLE = fp.vehicle("hehn2011")
UPRIGHT = fp.State(y=(0.0, 0.0, 1.0))
POSES = ("position", "attitude", "rod")
MOCAP, ONBOARD = SUITES["mocap"], SUITES["onboard"]
SLOWER, SLOW = (  # the calmest gains do for the slow one
    MOCAP.replace(**{name: replace(getattr(MOCAP, name), rate=rate) for name in POSES}) for rate in (110.0, 150.0)
)
PLAIN = inverted().with_gains(inverted().gains_for(VEHICLE)).bind(VEHICLE)


@pytest.mark.parametrize(
    ("sensors", "changes", "delay"),
    [slow(MOCAP, {}, 0.0), (ONBOARD, {}, 0.0), (MOCAP, {"rod_length": 0.16, "rotor_lag": 0.06}, 0.02)],
    ids=["mocap", "onboard", "short rod, slow rotors, delay"],
)
def test_vehicles_tremble_as_theory_says(sensors, changes, delay):
    runs, duration, vehicle = 60, 16.0, VEHICLE.replace(**changes)
    law = inverted(latency=delay)  # of which nothing moves enough to tell it
    law = law.with_gains(law.gains_for(vehicle)).bind(vehicle)
    hover = fp.State(x=np.zeros((runs, 3)), y=np.tile([0.0, 0.0, 1.0], (runs, 1)))
    sensors = sensors.replace(start=fp.Noise(x=1e-3, x_dot=1e-3, attitude=1e-3, y=1e-3, y_dot=1e-3))
    late = np.arange(8.0, duration, 0.02)  # on board, the bias of the gyroscope is known well after some ten seconds
    plant = Plant(sensors=sensors, delay=delay)
    flown = fp.simulate_ensemble(vehicle, law, hover, duration, plant=plant, times=late).samples
    place = np.sqrt(np.mean(np.sum(flown.x**2, axis=-1)))
    axis = np.sqrt(np.mean(np.sum(flown.R[..., :2, 2] ** 2, axis=-1)))
    expected = tremor(law, sensors, 1 / 500.0, delay)
    # What the theory leaves out, and for the place, which wanders slowly, the small number of independent seconds.
    assert axis == pytest.approx(expected.axis, rel=0.1)
    assert place == pytest.approx(expected.place, rel=0.25)


def test_latency_delay_and_lag_each_add_to_the_tremor():
    prompt = MOCAP.replace(**{name: replace(getattr(MOCAP, name), latency=0.0) for name in POSES})
    least = tremor(PLAIN, prompt, 0.002).axis
    slow = inverted().bind(VEHICLE.replace(rotor_lag=0.06))
    quick = inverted(**{name: slow.gains[name] for name in slow.gains if name != "form"})
    quick = quick.bind(VEHICLE.replace(rotor_lag=0.0))
    assert tremor(PLAIN, MOCAP, 0.002).axis > 1.02 * least
    assert tremor(PLAIN, prompt, 0.002, 0.02).axis > 1.05 * least
    assert tremor(slow, prompt, 0.002).axis > 1.05 * tremor(quick, prompt, 0.002).axis


def test_noise_of_the_readings_passes_through_in_proportion():
    """The estimator's gain depends on the ratio of what it believes: all noise times 3 makes all tremor times 3."""
    named = {name: getattr(SLOWER, name) for name in ("force_error", "moment_error")}
    louder = SLOWER.noisier(3.0).replace(**{name: 3 * value for name, value in named.items()})
    once, thrice = tremor(PLAIN, SLOWER, 0.002), tremor(PLAIN, louder, 0.002)
    np.testing.assert_allclose(thrice, 3 * np.array(once), rtol=1e-6)


def test_a_short_rod_behind_slow_rotors_is_foretold_to_tremble():
    short = VEHICLE.replace(rod_length=0.08, rotor_lag=0.06)
    law, quiet = inverted().bind(short), MOCAP.replace(rod=replace(MOCAP.rod, noise=MOCAP.rod.noise / 2))
    assert "half the noise of the rod readings" in too_noisy(law, Plant(sensors=MOCAP))
    assert tremor(law, quiet, 0.002).axis < tremor(law, MOCAP, 0.002).axis / 1.3
    assert not too_noisy(law, Plant())
    assert not too_noisy(PLAIN, Plant(sensors=MOCAP))


def test_gains_are_as_calm_as_the_sensors_need():
    law = inverted().bind(VEHICLE)
    assert calm(law, Plant(sensors=MOCAP.replace(rod=replace(MOCAP.rod, noise=1e-3)))) is law
    slower = calm(law, Plant(sensors=SLOW))
    assert slower.calm > 0
    assert tremor(slower, SLOW, 0.002).axis < CALM_TREMOR < tremor(law, SLOW, 0.002).axis
    assert slower.prepared["calming"]["rod_damping"] > 1
    assert set(slower.prepared["calming"]) == set(CALM[True])
    assert slower.gains == law.gains


def test_a_law_that_is_built_anew_is_as_calm_without_a_search(monkeypatch):
    """As for each flight of a page. Other gains are searched for, and so are those that are given."""
    found = calm(inverted().bind(VEHICLE), Plant(sensors=SLOW))
    monkeypatch.setattr("flypend.plants.tremor.tremor", lambda *_: 1 / 0)
    assert calm(inverted().bind(VEHICLE), Plant(sensors=SLOW)).calm == found.calm > 0
    others = ({"rod_damping": 1.01 * found.gains["rod_damping"]}, {"rod_damping": found.gains["rod_damping"]})
    for law in (inverted(**gains) for gains in others):
        with pytest.raises(ZeroDivisionError):
            calm(law.bind(VEHICLE), Plant(sensors=SLOW))


def test_gains_are_calm_near_the_reference_only():
    """Far away, moments are those of the law as it is; near, they follow the axis with more damping."""
    t, packed = ca.SX.sym("t"), ca.SX.sym("s", 24)
    law = inverted().bind(VEHICLE)
    wrenches = [law.calm_by(share).upright(t, packed, ca.SX(6, 1))[1:] for share in (0.0, 1.0)]
    moments = as_numpy(ca.Function("moments", [t, packed], wrenches))

    def apart(state):
        plain, found = moments(0.0, state.packed())
        return np.linalg.norm(found - plain) / np.linalg.norm(plain)

    assert apart(fp.State(y=(0.01, 0, np.sqrt(1 - 1e-4)), omega=(0.1, 0, 0))) > 0.1
    rng = np.random.default_rng(0)
    assert np.median([apart(fp.State.random(rng)) for _ in range(50)]) < 0.03


def test_a_machine_lighter_than_believed_stands_on_slow_rotors():
    """With the default gains the rotors' lag and the quicker rod resonate, and half of these flights end in a cone."""
    vehicle = fp.vehicle("crazyflie")
    law, plant = inverted().bind(vehicle), Plant(sensors=ONBOARD, mismatch=LIGHT)
    light = vehicle.replace(**{name: share * getattr(vehicle, name) for name, share in LIGHT.items()})
    assert tremor(law, ONBOARD, 0.002).axis < MOST_TREMOR < tremor(law, ONBOARD, 0.002, flown=light).axis / 1.2
    starts = task_starts(vehicle, 24, 20261125, directions=3)["random"]
    late = np.arange(16.0, 20.0, 0.02)
    flown = fp.simulate_ensemble(vehicle, law, starts, 20.0, plant=plant, times=late)
    assert np.sum(flown.success) >= 23
    axis = np.sqrt(np.mean(np.sum(flown.samples.R[flown.success, :, :2, 2] ** 2, axis=-1)))
    expected = tremor(calm(law, plant), ONBOARD, 0.002, flown=light).axis
    assert axis == pytest.approx(expected, rel=0.2)  # the estimator's own model is wrong as well, and it finds forces


def test_calm_gains_are_stable_and_tremble_less():
    for name in ("hehn2011", "crazyflie", "nayak2018"):
        law = inverted().bind(fp.vehicle(name))
        told = [tremor(law.calm_by(share), MOCAP, 0.002).axis for share in (0.0, 0.5, 1.0)]
        assert told[2] < told[1] < told[0]


def test_a_flight_takes_the_gains_of_its_sensors_and_back():
    def flight(law, plant):
        return Flight(vehicle=VEHICLE, law=law, starts=UPRIGHT, duration=1.0, plant=plant)

    law = inverted().bind(VEHICLE)
    flown = flight(law, Plant(sensors=SLOWER))
    assert flown.loop.law is flown.law
    assert flown.law.calm > 0
    assert flight(flown.law, Plant(sensors=SLOWER)).law is flown.law
    assert flown.through(Plant()).law is law
    assert Loop(VEHICLE, flown.law, Plant(sensors=SLOWER.replace(rates="differenced"))).law is law


def test_given_gains_stay():
    damped = inverted(rod_damping=0.5).bind(VEHICLE)
    found = calm(damped, Plant(sensors=SLOWER))
    assert found.gains["rod_damping"] == 0.5
    assert set(CALM[True]) - set(found.prepared["calming"]) == {"rod_damping"}
    assert calm(PLAIN, Plant(sensors=SLOWER)) is PLAIN


def test_a_gain_that_differs_from_run_to_run_stays_as_if_given():
    def flight(law, **gains):
        starts = fp.State(y=[[0.0, 0.0, 1.0]] * 2) if gains else UPRIGHT
        return Flight(vehicle=VEHICLE, law=law, starts=starts, duration=1.0, plant=Plant(sensors=SLOWER), gains=gains)

    law = inverted().bind(VEHICLE)
    value = law.numbers["rod_damping"]
    varied, given = flight(law, rod_damping=[value, 0.5]), flight(inverted(rod_damping=value))
    assert varied.law.prepared["calming"] == given.law.prepared["calming"]
    assert varied.law.calm == given.law.calm > 0
    assert "rod_damping" in flight(law).law.prepared["calming"]
    assert varied.loop.law is varied.replace(duration=2.0).law is varied.law  # compiled once
    assert varied.through(Plant()).law.prepared["calming"] == {}
    assert flight(varied.law).law is flight(law).law
    assert flight(law, throw_speed=[1.0, 2.0]).law is flight(law).law  # which is never calmed
    all_ = flight(law, **{name: [0.5, 0.9] for name in CALM[True]})
    assert (all_.law.calm, all_.law.prepared["calming"]) == (0.0, {})


def test_a_law_on_a_path_is_calmed_for_hover_and_stays_on_its_path():
    law = inverted(reference=fp.laws.references.circle(0.5, 4.0)).bind(VEHICLE)
    found = calm(law, Plant(sensors=SLOWER))
    assert found.calm == calm(inverted().bind(VEHICLE), Plant(sensors=SLOWER)).calm
    assert found.path is law.path
    assert found.reference is law.reference


def test_a_law_on_another_computer_stays_on_it():
    """A plan's board predicts for itself; with the law's own computer, tracked flights stray twice as far."""
    law = inverted().bind(VEHICLE)
    changed = replace(law, computer=replace(law.computer, latency=0.0, lead=1.0, models_lag=True))
    found = calm(changed, Plant(sensors=MOCAP))
    assert found.calm > 0
    assert found.computer == changed.computer


def test_a_loop_that_does_not_stand_trembles_without_bound():
    restless = inverted(rod_damping=0.01).bind(VEHICLE)
    assert fp.linearise(restless, VEHICLE).spectral_abscissa > 0
    assert tremor(restless, MOCAP, 0.002) == (np.inf, np.inf)
