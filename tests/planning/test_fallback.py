"""Until there is a plan a sketch of it flies: it goes the way of the plan, where the law may not."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

import flypend as fp
from flypend.flight.tasks import task_starts
from flypend.model.state import SIZE
from flypend.planning import fallback, receding_horizon
from flypend.planning.dynamics import Units
from flypend.planning.fallback import Fallback, Schedule
from flypend.planning.problem import request
from flypend.plants.equations import EquationsEngine
from flypend.plants.loop import Loop

HEHN = fp.vehicle("hehn2011")
HUB = HEHN.replace(mount="hub")
STARTS = fp.random_starts(40, seed=3301)
FIRST, ALONE, HORIZON = 0.012, 0.054, 12.5  # s, s, √(l/g)
LEGS = (0.019, 0.0196)  # s: a stage each
STAGE = fallback.stages_of(HORIZON)[1] * Units.of(HEHN).time  # s
WAIT = FIRST + 2 * STAGE


def waits_of(vehicle):
    return Fallback(Loop(vehicle, fp.laws.inverted().bind(vehicle), fp.Plant()), 0.01)


def begin_of(start, vehicle=HEHN):
    return np.append(start.packed(), np.full(4, vehicle.rotor_limits[0]))


def asking(vehicle):
    def ask(_, here):
        start, rotors = fp.State.from_packed(here[:SIZE]), np.clip(here[SIZE:], *vehicle.rotor_limits)
        return request(vehicle, start, "excursion", np.zeros(3), rotors)

    return ask


def sketched(waits, start, vehicle=HEHN, legs=LEGS, *, measured=False):
    begin = begin_of(start, vehicle)
    return waits.sketch(0.0, begin, HORIZON, FIRST, legs, ALONE, asking(vehicle), measured=measured)


def strays(end, vehicle=HEHN):
    """Return the excursion of the best plan from an `end` (24 + n,)."""
    state, rotors = fp.State.from_packed(end[:SIZE]), np.clip(end[SIZE:], *vehicle.rotor_limits)
    return fp.plan(vehicle, state, rotors=rotors, time_limit=120).excursion


@pytest.fixture(scope="module")
def ends():
    """Where sketches and the law lead from each start, (40, 24 + n) each."""
    waits = waits_of(HEHN)
    leads = [(sketched(waits, STARTS[i]), waits.until(0.0, begin_of(STARTS[i]), FIRST + ALONE)) for i in range(40)]
    return [np.array([lead.there for lead in some]) for some in zip(*leads, strict=True)]


def test_plans_after_a_sketch_stray_less_than_after_the_law(ends):
    """By a tenth on average over ten starts, and by a sixth from the worst."""
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
    """The plant, in steps of a tenth of a millisecond, ends where the pilot predicts it, in steps of some."""
    lead, begin = sketched(waits_of(HEHN), STARTS[0]), begin_of(STARTS[0])
    np.testing.assert_array_equal(lead.schedule.at(0.0), begin[SIZE:])
    assert lead.wait == pytest.approx(WAIT)
    assert lead.schedule.at(-1e-4) is None
    assert lead.schedule.at(WAIT) is None
    engine, edges = EquationsEngine(HEHN), [0.0, FIRST, FIRST + STAGE, WAIT]
    engine.reset(begin[:SIZE], begin[SIZE:])
    for first, last in pairwise(edges):
        for k in range(100):
            h = (last - first) / 100
            engine.step(lead.schedule.at(first + h * k), h, np.zeros(6))
    np.testing.assert_allclose(np.append(engine.packed, engine.rotors), lead.there, atol=1e-4)


def _light(vehicle):
    """A machine of four fifths of all masses: its scales of thrust and moment are 5/4."""
    return vehicle.replace(mass=0.8 * vehicle.mass, bob_mass=0.8 * vehicle.bob_mass, inertia=0.8 * vehicle.inertia)


def test_masses_that_are_found_count_on_the_way_to_a_plan():
    """A plan begins where the sketches lead a machine of the scales that are estimated, not the one that was told."""
    begin = begin_of(STARTS[0])
    loop = Loop(HEHN, fp.laws.inverted().bind(HEHN), fp.Plant())
    pilot, engine = fp.nmpc(HEHN).flight_computer(loop, begin[SIZE:]), EquationsEngine(_light(HEHN))
    pilot._error.scales = np.full(2, 1.25)
    coming = pilot._begin(0.0, begin[:SIZE], begin[SIZE:])
    engine.reset(begin[:SIZE], begin[SIZE:])
    for first, last in pairwise(coming.schedule.times):
        engine.step(coming.schedule.at(first), last - first, np.zeros(6))
    np.testing.assert_allclose(engine.packed, coming.plan.packed[0], atol=1e-3)


def test_masses_that_are_found_count_under_the_law_and_under_constant_forces():
    """Where both lead is where they lead the machine of these masses, as the law and the commands do not know them."""
    begin, wait, scales = begin_of(STARTS[0]), 0.1, np.full(2, 1.25)
    plant = fp.Plant(mismatch={"mass": 0.8, "bob_mass": 0.8, "inertia": 0.8})
    flown = fp.simulate(HEHN, fp.laws.inverted(), STARTS[0], wait, plant=plant).states[-1].packed()
    waits = waits_of(HEHN)
    assert np.max(np.abs(waits.until(0.0, begin, wait).there[:SIZE] - flown)) > 0.1
    waits.scales = scales
    np.testing.assert_allclose(waits.until(0.0, begin, wait).there[:SIZE], flown, atol=1e-9)
    command, _, end = fallback.evasion(HUB, begin[:SIZE], begin[SIZE:], wait, scales)
    held = Schedule(np.linspace(0, wait, fallback.STEPS + 1), [command] * fallback.STEPS)
    np.testing.assert_allclose(held.fly(_light(HUB), begin, substeps=1)[-1], end, atol=1e-9)


def test_the_plan_begins_where_its_sketches_lead():
    """Guesses are solved on from there: the first state is that, and equations of motion hold from it on."""
    lead = sketched(waits_of(HEHN), STARTS[0])
    own = Units.of(HEHN).states(4)
    np.testing.assert_allclose(lead.found.states[0] * own, lead.there, atol=1e-12)
    assert lead.found.lacks == ""
    assert len(lead.found.commands) == fallback.stages_of(HORIZON)[0] - 2


def test_each_leg_is_flown_by_what_the_one_before_found():
    """All of the first sketch flies only where there are no legs."""
    alone, legs = (sketched(waits_of(HEHN), STARTS[0], legs=some).schedule for some in ((), LEGS))
    np.testing.assert_array_equal(alone.at(FIRST), legs.at(FIRST))
    assert np.max(np.abs(alone.at(FIRST + STAGE) - legs.at(FIRST + STAGE))) > 0.01
    assert alone.times[-1] == pytest.approx(FIRST + ALONE)


def test_a_leg_after_which_the_rod_touches_is_not_flown(monkeypatch):
    """The sketch before it flies on, of which that is known."""
    start = task_starts(HUB, 3, 501)["random"][2]
    room, asked = fallback.room, []

    def refused(path, vehicle):
        asked.append(len(path))
        return room(path, vehicle) - (1.0 if len(path) == fallback.SUBSTEPS + 1 and len(asked) == 2 else 0.0)

    monkeypatch.setattr(fallback, "room", refused)
    lead = sketched(waits_of(HUB), start, HUB)
    monkeypatch.setattr(fallback, "room", room)
    first, both = (sketched(waits_of(HUB), start, HUB, legs).schedule for legs in ((), LEGS))
    second = FIRST + STAGE
    np.testing.assert_array_equal(lead.schedule.at(second), first.at(second))
    assert not np.array_equal(lead.schedule.at(second), both.at(second))


def test_a_sketch_under_which_the_rod_touches_is_not_flown(monkeypatch):
    waits, start = waits_of(HUB), task_starts(HUB, 3, 501)["random"][2]
    lead = sketched(waits, start, HUB)
    assert lead.found is not None
    low, high = HUB.rotor_limits
    full = [np.array([high, low, low, high])]
    monkeypatch.setattr(fallback, "_schedule", lambda _, begin, end, stage: Schedule((begin, begin + 0.5), full))
    otherwise = sketched(waits, start, HUB)
    assert otherwise[0] is otherwise[3] is None
    np.testing.assert_array_equal(otherwise.there, waits.until(0.0, begin_of(start, HUB), FIRST + ALONE).there)
    assert not np.array_equal(otherwise.there, lead.there)


@pytest.mark.parametrize("number", [1, 12])
def test_from_a_start_nearer_than_its_clearance_a_sketch_flies_that_keeps_the_rod_as_far(number):
    """The law or constant forces lead where the best plan strays four and three times as far as from the start."""
    start = task_starts(HUB, 26, seed=501)["random"][number]
    waits, begin = waits_of(HUB), begin_of(start, HUB)
    assert fallback.room(begin[None], HUB) < 0.01
    lead, instead = sketched(waits, start, HUB), waits.until(0.0, begin, FIRST + ALONE)
    assert lead.found is not None
    assert strays(lead.there, HUB) < strays(instead.there, HUB) / 2


def test_a_sketch_that_is_late_is_not_flown(monkeypatch):
    waits = waits_of(HEHN)
    monkeypatch.setattr(fallback, "process_time", iter([0.0, 0.5]).__next__)
    lead = sketched(waits, STARTS[0], measured=True)
    assert lead.schedule is lead.found is None
    np.testing.assert_array_equal(lead.there, waits.until(0.0, begin_of(STARTS[0]), FIRST + ALONE).there)


def test_a_leg_that_is_late_is_not_flown(monkeypatch):
    waits = waits_of(HEHN)
    first = sketched(waits, STARTS[0], legs=())
    monkeypatch.setattr(fallback, "process_time", iter([0.0, 0.0, 0.0, 0.5, 0.5, 0.5]).__next__)
    lead = sketched(waits, STARTS[0], measured=True)
    np.testing.assert_array_equal(lead.schedule.at(FIRST + STAGE), first.schedule.at(FIRST + STAGE))


def test_legs_that_take_longer_than_a_plan_are_not_begun():
    lead = sketched(waits_of(HEHN), STARTS[0], legs=(ALONE, ALONE))
    assert lead.found is None
    assert lead.wait == FIRST + ALONE


def test_a_plan_counts_the_iterations_of_all_its_sketches():
    assert sum(fallback.LEGS) >= sketched(waits_of(HEHN), STARTS[0]).found.iterations > fallback.LEGS[-1]


def test_after_a_failure_there_is_no_sketch(monkeypatch):
    """Only the law is known to lead somewhere."""
    begun, of_sketch = [], Fallback.sketch

    def counted(self, t, *given, **more):
        begun.append(t)
        return of_sketch(self, t, *given, **more)

    monkeypatch.setattr(Fallback, "sketch", counted)
    asked, of_plan = [], receding_horizon.Pilot._plan
    monkeypatch.setattr(receding_horizon.Pilot, "_plan", lambda *given: asked.append(of_plan(*given)) or asked[-1])
    monkeypatch.setattr(receding_horizon, "plan_within", lambda *given: replace(NO_PLAN, reason="none"))
    monkeypatch.setattr(receding_horizon, "plan_of", lambda *given: replace(NO_PLAN, reason="none"))
    monkeypatch.setattr(receding_horizon, "PAUSE", 0.1)
    run = fp.simulate(HEHN, fp.nmpc(HEHN), STARTS[0], 8.0, plant="rotors")
    assert len(asked) > 1
    assert begun == pytest.approx([0.0], abs=1e-5)  # the board's least delay
    assert fp.metrics(run).success


NO_PLAN = replace(fp.plan(HEHN, fp.State(y=(0, 0, 1))), status="failed")
