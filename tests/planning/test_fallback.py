"""Until there is a plan a sketch of it flies: it goes the way of the plan, where the law may not."""

from dataclasses import replace

import numpy as np
import pytest

import flypend as fp
from flypend.flight.tasks import task_starts
from flypend.model.state import SIZE
from flypend.planning import fallback, receding_horizon
from flypend.planning.fallback import Fallback, Schedule
from flypend.planning.problem import request
from flypend.plants.equations import EquationsEngine
from flypend.plants.loop import Loop

HEHN = fp.vehicle("hehn2011")
HUB = HEHN.replace(mount="hub")
STARTS = fp.random_starts(40, seed=3301)
FIRST, WAIT, HORIZON = 0.012, 0.066, 12.5  # s, s, √(l/g)


def waits_of(vehicle):
    return Fallback(Loop(vehicle, fp.laws.inverted().bind(vehicle), fp.Plant()), 0.01)


def begin_of(start, vehicle=HEHN):
    return np.append(start.packed(), np.full(4, vehicle.rotor_limits[0]))


def asking(vehicle):
    def ask(_, here):
        start, rotors = fp.State.from_packed(here[:SIZE]), np.clip(here[SIZE:], *vehicle.rotor_limits)
        return request(vehicle, start, "excursion", np.zeros(3), rotors)

    return ask


def sketched(waits, start, vehicle=HEHN, *, measured=False):
    return waits.sketch(0.0, begin_of(start, vehicle), HORIZON, FIRST, WAIT, asking(vehicle), measured=measured)


@pytest.fixture(scope="module")
def ends():
    """Where sketches and the law lead from each start, (40, 24 + n) each."""
    waits = waits_of(HEHN)
    both = [(sketched(waits, STARTS[i])[1], waits.until(0.0, begin_of(STARTS[i]), WAIT)[1]) for i in range(40)]
    return [np.array(some) for some in zip(*both, strict=True)]


def test_plans_after_a_sketch_stray_less_than_after_the_law(ends):
    """By a tenth on average over ten starts, and by a sixth from the worst."""

    def strays(path_end):
        state, rotors = fp.State.from_packed(path_end[:SIZE]), np.clip(path_end[SIZE:], *HEHN.rotor_limits)
        return fp.plan(HEHN, state, rotors=rotors, time_limit=120).excursion

    best = np.array([fp.plan(HEHN, STARTS[i], time_limit=120).excursion for i in range(10)])
    by_sketch, by_law = (np.array([strays(end) for end in some[:10]]) / best for some in ends)
    assert np.mean(by_sketch) < 0.9 * np.mean(by_law)
    assert np.max(by_sketch) < 5 / 6 * np.max(by_law)


def test_the_law_recovers_from_where_a_sketch_leads(ends):
    """If there is no plan after all, nothing is lost."""
    alone = fp.simulate_ensemble(HEHN, fp.laws.inverted(), STARTS, 20)
    after = fp.simulate_ensemble(HEHN, fp.laws.inverted(), fp.State.from_packed(ends[0][:, :SIZE]), 20)
    assert np.all(alone.success)
    assert np.all(after.success)


def test_commands_of_a_sketch_lead_where_it_says():
    """The plant, in steps of a millisecond, ends where the pilot predicts it, in steps of a stage."""
    waits = waits_of(HEHN)
    schedule, there = sketched(waits, STARTS[0])
    assert schedule.at(FIRST - 1e-3) is None
    assert schedule.at(WAIT) is None
    _, here = waits.until(0.0, begin_of(STARTS[0]), FIRST)
    engine = EquationsEngine(HEHN)
    engine.reset(here[:SIZE], here[SIZE:])
    for k in range(54):
        engine.step(schedule.at(FIRST + 1e-3 * k), 1e-3, np.zeros(6))
    np.testing.assert_allclose(np.append(engine.packed, engine.rotors), there, atol=2e-3)


def test_a_sketch_under_which_the_rod_touches_is_not_flown(monkeypatch):
    waits, start = waits_of(HUB), task_starts(HUB, 3, 501)["random"][2]
    schedule, there = sketched(waits, start, HUB)
    assert schedule is not None
    full = np.array([[HUB.rotor_limits[1], HUB.rotor_limits[0], HUB.rotor_limits[0], HUB.rotor_limits[1]]])
    monkeypatch.setattr(fallback, "make_sketch", lambda _, h, begin, end: Schedule(begin, begin + 0.5, 1.0, full))
    otherwise, elsewhere = sketched(waits, start, HUB)
    assert otherwise is None
    np.testing.assert_array_equal(elsewhere, waits.until(0.0, begin_of(start, HUB), WAIT)[1])
    assert not np.array_equal(elsewhere, there)


@pytest.mark.parametrize("number", [1, 12])
def test_from_a_start_nearer_than_its_clearance_a_sketch_flies_that_keeps_the_rod_as_far(number):
    """Constant forces flew there, from where the best plan strays 5.7 and 3.1 times as far as from the start."""
    start = task_starts(HUB, 26, seed=501)["random"][number]
    waits, begin = waits_of(HUB), begin_of(start, HUB)
    assert fallback.room(begin[None], HUB) < 0.01
    found, there = sketched(waits, start, HUB)
    assert found is not None
    instead, elsewhere = waits.until(0.0, begin, WAIT)
    assert instead is not None

    def strays(end):
        state, rotors = fp.State.from_packed(end[:SIZE]), np.clip(end[SIZE:], *HUB.rotor_limits)
        return fp.plan(HUB, state, rotors=rotors, time_limit=120).excursion

    assert strays(there) < strays(elsewhere) / 2


def test_a_sketch_that_is_late_is_not_flown(monkeypatch):
    waits = waits_of(HEHN)
    monkeypatch.setattr(fallback.time, "process_time", iter([0.0, 0.5]).__next__)
    found, there = sketched(waits, STARTS[0], measured=True)
    assert found is None
    np.testing.assert_array_equal(there, waits.until(0.0, begin_of(STARTS[0]), WAIT)[1])


def test_after_a_failure_there_is_no_sketch(monkeypatch):
    """Only the law is known to lead somewhere."""
    begun, of_sketch = [], Fallback.sketch

    def counted(self, t, *given, **more):
        begun.append(t)
        return of_sketch(self, t, *given, **more)

    monkeypatch.setattr(Fallback, "sketch", counted)
    monkeypatch.setattr(receding_horizon, "plan_within", lambda *given: replace(NO_PLAN, reason="none"))
    monkeypatch.setattr(receding_horizon, "PAUSE", 0.1)
    run = fp.simulate(HEHN, fp.nmpc(HEHN), STARTS[0], 8.0, plant="rotors")
    assert begun == pytest.approx([0.0], abs=1e-5)  # the board's least delay
    assert fp.metrics(run).success


NO_PLAN = replace(fp.plan(HEHN, fp.State(y=(0, 0, 1))), status="failed")
