"""Signals along sampled flights: those of the law at the states flown, computed when they are asked for."""

import pickle

import numpy as np

import flypend as fp
from flypend.flight import simulate as simulated
from flypend.laws.closed_loop import close_loop
from flypend.plants import Plant

NAYAK, CORRECTED = fp.vehicle("nayak2018"), fp.laws.corrected()
START = fp.State(y=(0.6, 0.0, 0.8), y_dot=(0.0, 0.5, 0.0), omega=(0.3, 0.0, 0.0))


def fly(plant):
    return fp.simulate(NAYAK, CORRECTED, START, 1.0, plant=plant)


def test_they_are_those_of_the_ideal_flight_where_the_states_are():
    ideal, rotors = fly("ideal"), fly("rotors")
    assert list(rotors.signals) == list(ideal.signals)
    for name, values in rotors.signals.items():
        assert values.shape == rotors.t.shape
        np.testing.assert_allclose(values[0], ideal.signals[name][0], rtol=1e-12, atol=1e-12)
    # Negative control: the rotors are late, so that V is another one later on.
    assert np.max(np.abs(rotors.signals["V"] - ideal.signals["V"])) > 1e-3


def test_without_limits_lag_and_delay_the_rate_is_that_of_v():
    run = fly(Plant(limits=False, lag=0.0, rate=5000.0))
    slope = np.gradient(run.signals["V"], run.t)[5:-5]
    # Central differences over 10 ms, and a wrench held for 0.2 ms.
    np.testing.assert_allclose(slope, run.signals["V_rate"][5:-5], rtol=0, atol=2e-2 * np.max(np.abs(slope)))


def test_they_are_computed_once_and_travel_as_numbers():
    run = fly("rotors")
    assert run.signals["V"] is run.signals["V"]
    sent = pickle.loads(pickle.dumps(run.signals))
    assert isinstance(sent, dict)
    np.testing.assert_array_equal(sent["V"], run.signals["V"])


def test_a_law_without_signals_has_none():
    law = fp.Law(
        name="push", e3="up", control=lambda t, state, vehicle, k: fp.Wrench(vehicle.weight, -0.1 * state.omega)
    )
    run = fp.simulate(NAYAK, law, fp.State(y=(0, 0, 1)), 0.1, plant="rotors")
    assert dict(run.signals) == {}


def test_v_alone_is_the_v_of_the_whole_loop(monkeypatch):
    """It needs no rates; a law without V tells so without the loop, and may have a signal of that name."""
    run, states = fly("rotors"), fly("rotors").packed
    whole = close_loop(NAYAK, run.flight.law)
    place = 4 + whole.signal_names.index("V")
    np.testing.assert_array_equal(run.signals["V"], np.array(whole.outputs(run.t[None], states.T))[place])

    def push(t, state, vehicle, k):
        return fp.laws.Control(wrench=fp.Wrench(vehicle.weight, -0.1 * state.omega), signals={"V": 2 * state.x[0]})

    own = fp.simulate(NAYAK, fp.Law(name="push", e3="up", control=push), START, 0.1, plant="rotors")
    np.testing.assert_allclose(own.signals["V"], 2 * own.x[:, 0], rtol=0, atol=0)

    def refuse(*_):
        raise AssertionError("the closed loop is built")

    monkeypatch.setattr(simulated, "close_loop", refuse)
    run = fly("rotors")
    assert "V" in run.signals
    assert run.signals["V"].shape == run.t.shape
    inverted = fp.simulate(NAYAK, fp.laws.inverted(), START, 0.1, plant="rotors")
    assert "V" not in inverted.signals
