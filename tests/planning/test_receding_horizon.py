"""Plans in flight: real-time iterations solve what they should, and nmpc flies no worse than what it falls back on."""

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.board.delay import LEAST
from flypend.flight.tasks import task_starts
from flypend.geometry import norm
from flypend.planning import real_time as real_time_module
from flypend.planning import receding_horizon
from flypend.planning.dynamics import Units
from flypend.planning.inequalities import BASE, OWN
from flypend.planning.multistart import NOT_KEPT, Verdict
from flypend.planning.planner import plan_within
from flypend.planning.problem import request
from flypend.planning.real_time import PlanInFlight, RealTime, hover_under, in_weights
from flypend.planning.solver import Measures
from flypend.plants.equations import EquationsEngine
from flypend.settings.laws import law_from, law_named
from tests.few import slow

HEHN = fp.vehicle("hehn2011")
LAW = fp.laws.inverted()
STARTS = fp.random_starts(3, seed=2026)
HANGING = fp.State(y=(0, 0, -1))
NONE = np.zeros(6)
LEAST_DELAY = 0.002 * LEAST  # s, that the board believes in


def flown_by(law, start, duration=6.0, plant="rotors", vehicle=HEHN):
    """Return the run, and the pilot that flew it."""
    pilots = []

    def make(loop, rotors):
        pilots.append(law.flight_computer(loop, rotors))
        return pilots[-1]

    run = fp.simulate(vehicle, replace(law, flight_computer=make), start, duration, plant=plant)
    return run, pilots[0]


def modes(some):
    return [mode for _, mode, _ in some.changes]


@pytest.fixture(scope="module")
def planned():
    """What flies: a plan after so many iterations. `fp.plan` solves on with a barrier a hundredth of that in flight."""
    return plan_within(
        request(HEHN, STARTS[1], "excursion", np.zeros(3)), *receding_horizon.ATTEMPTS[0], receding_horizon.ROUNDS
    )


def real_time(plan, kept=None):
    """Return real-time iterations on `plan` with what they have `kept`, and its states in own units."""
    asked = request(plan.vehicle, plan.states[0], "excursion", np.zeros(3), kept=kept)
    units, n = Units.of(plan.vehicle), len(plan.vehicle.rotor_spins)
    per_stage = (len(plan.t) - 1) // len(plan.commands)
    states = (np.column_stack([plan.packed, plan.rotor_forces]) / units.states(n))[::per_stage]
    made = RealTime(asked, states, plan.commands / units.force, plan.stage / units.time, len(plan.commands), 50)
    return made, states


# Real-time iterations ------------------------------------------------------------------------------------------------


def test_an_iteration_on_an_undisturbed_plan_hardly_changes_it(planned):
    made, states = real_time(planned)
    assert made.improve(5, states[5], 0.0, NONE)
    # A larger barrier moves commands away from their limits; the pivot moves by a hundredth of the rod's length.
    np.testing.assert_allclose(made.states[:, :3], states[:, :3], atol=0.01)


def test_an_iteration_joins_where_the_flight_is_and_obeys_the_plant(planned):
    made, states = real_time(planned)
    there = states[10].copy()
    there[:3] += 0.05
    there[3:6] -= 0.1
    for _ in range(4):
        assert made.improve(10, there, 0.0, NONE)
    np.testing.assert_array_equal(made.states[10], there)
    units = Units.of(HEHN)
    own, engine = units.states(4), EquationsEngine(HEHN)
    for k in range(10, len(planned.commands)):
        engine.reset(made.states[k, :24] * own[:24], made.states[k, 24:] * own[24:])
        engine.step(made.commands[k] * units.force, planned.stage, NONE)
        found = np.append(engine.packed, engine.rotors) / own
        np.testing.assert_allclose(found, made.states[k + 1], atol=1e-9)  # rounding, amplified by a stage
    # It still ends in hover: twice its tolerances.
    end = made.states[-1]
    assert norm(end[:3]) < 0.02
    assert norm([*end[18:20].tolist(), 0.0]) < 0.03


def test_commands_keep_the_limits_with_room_for_feedback(planned):
    made, states = real_time(planned)
    for k in range(20):
        made.improve(k, states[k], 0.0, NONE)
    low, high = HEHN.rotor_limits / Units.of(HEHN).force
    assert low < np.min(made.commands) < np.max(made.commands) < high


def test_forces_from_outside_move_the_end_to_the_hover_that_they_leave(planned):
    made, states = real_time(planned)
    outside = np.array([0.05, 0.0, 0.0, 0.0, 0.01, 0.0])
    for _ in range(8):
        made.improve(0, states[0], 0.0, outside)
    wanted, end = hover_under(outside, HEHN.m / (HEHN.M + HEHN.m), 4), made.states[-1]
    np.testing.assert_allclose(end[18:21], wanted[18:21], atol=0.02)
    np.testing.assert_allclose(end[[8, 11, 14]], wanted[[8, 11, 14]], atol=0.04)
    assert norm(wanted[18:21] - states[-1, 18:21]) > 0.05  # without them it would end there


def test_hover_under_forces_is_an_equilibrium_of_the_plant():
    forces = np.array([0.3, -0.2, 0.1, 0.02, 0.05, -0.03])
    outside, units = in_weights(forces, np.zeros(3), HEHN), Units.of(HEHN)
    hover = hover_under(outside, HEHN.m / (HEHN.M + HEHN.m), 4) * units.states(4)
    engine = EquationsEngine(HEHN)
    engine.reset(hover[:24], hover[24:])
    engine.step(hover[24:], 0.01, forces)
    np.testing.assert_allclose(engine.packed, hover[:24], atol=1e-12)


def test_acceleration_of_the_reference_weighs_like_a_force():
    """Free fall of the frame leaves no weight: the force that it takes is one weight down, shared as the masses are."""
    falling = in_weights(np.zeros(6), np.array([0, 0, -HEHN.g]), HEHN)
    np.testing.assert_allclose(falling[:3] + falling[3:], [0, 0, 1], atol=1e-12)
    assert falling[5] / falling[2] == pytest.approx(HEHN.m / HEHN.M)


# Flights -------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def nominal():
    return flown_by(fp.nmpc(HEHN), STARTS[1])


def test_it_plans_flies_and_hands_over(nominal):
    run, flown = nominal
    result = fp.metrics(run)
    assert result.success
    assert modes(flown) == ["planned", "hovering"]
    # What computing is charged: 11.9 ms of sketch and two stages of plan, 51.9 ms; then the next command is due.
    assert flown.changes[0][0] == pytest.approx(0.052, abs=1.1 * LEAST_DELAY)
    assert result.excursion < 1.05 * flown.plans[0].excursion
    assert result.excursion < 0.5 * fp.metrics(fp.simulate(HEHN, LAW, STARTS[1], 6)).excursion


def test_flights_repeat_bit_for_bit(nominal):
    again, _ = flown_by(fp.nmpc(HEHN), STARTS[1], 1.0)
    np.testing.assert_array_equal(again.packed, nominal[0].packed[: len(again.t)])


@pytest.mark.parametrize("factor", [slow(0.9), 1.1])
def test_masses_off_by_a_tenth_and_late_commands(factor):
    plant = fp.Plant(mismatch={"mass": factor, "bob_mass": factor}, delay=0.01)
    run, flown = flown_by(fp.nmpc(latency=0.01), STARTS[2], 6, plant)
    result = fp.metrics(run)
    assert result.success
    assert modes(flown) == ["planned", "hovering"]
    assert result.excursion < 1.5 * flown.plans[0].excursion


def test_a_wrong_thrust_scale_is_not_taken_for_a_force():
    """Taken for a force, masses x 0.8 led this start 5.4 m away, and never to hover."""
    start, plant = fp.random_starts(16, seed=7100)[1], fp.Plant(mismatch={"mass": 0.8, "bob_mass": 0.8})
    run, flown = flown_by(fp.nmpc(), start, 6, plant)
    law = fp.simulate(HEHN, LAW, start, 6, plant=plant)
    assert fp.metrics(run).success
    assert modes(flown) == ["planned", "hovering"]
    assert fp.metrics(run).excursion < 0.7 * fp.metrics(law).excursion


@pytest.mark.parametrize("number", [0, *(slow(number) for number in (1, 2))])
def test_a_delay_that_nobody_told_of_is_found(number):
    """Not looked for, 30 ms lost every plan, and the law between them."""
    plant = fp.Plant(delay=0.03)
    by_plan, by_law = (fp.simulate(HEHN, law, STARTS[number], 8, plant=plant) for law in (fp.nmpc(), LAW))
    assert fp.metrics(by_plan).success
    assert fp.metrics(by_plan).excursion < 0.7 * fp.metrics(by_law).excursion


def test_it_flies_on_sensors_with_their_estimator():
    run, flown = flown_by(fp.nmpc(), STARTS[0], 6, fp.Plant(sensors="mocap"))
    assert fp.metrics(run).success
    assert modes(flown) == ["planned", "hovering"]


def test_a_poke_that_the_law_answers_by_dropping_the_rod_is_caught():
    plant = fp.Plant(wind=fp.Wind(knock_on_vehicle=0.5, knock_on_bob=0.15, knock_period=3.0), seed=0)
    upright = fp.State(y=(0, 0, 1))
    run, flown = flown_by(fp.nmpc(), upright, 3.0, plant)
    law = fp.simulate(HEHN, LAW, upright, 3.0, plant=plant)
    assert modes(flown)[:3] == ["hovering", "waiting", "planned"]
    assert np.min(law.y[:, 2]) < 0
    assert np.max(norm(run.x)) < 0.5 * np.max(norm(law.x))


def test_a_reference_is_followed():
    circle = fp.laws.references.circle(radius=0.5, rate=1.5)
    run, flown = flown_by(fp.nmpc(reference=circle), HANGING, 7.0)
    assert fp.metrics(run).success
    assert modes(flown) == ["planned", "hovering"]
    assert np.max(norm(run.x - run.x_ref)[run.t > 5]) < 0.1


def test_wind_is_observed():
    plant = fp.Plant(wind=fp.Wind(on_vehicle=(0.4, 0.0, 0.0), on_bob=(0.05, 0.0, 0.0)))
    run, flown = flown_by(fp.nmpc(), STARTS[1], 6.0, plant)
    assert modes(flown) == ["planned", "hovering"]
    assert np.max(norm(run.x[run.t > 5])) < 0.05


def test_on_a_hub_nothing_is_touched():
    hub = HEHN.replace(mount="hub")
    start = task_starts(hub, 3, 501)["random"][2]
    run, flown = flown_by(fp.nmpc(hub), start, 5.0, vehicle=hub)
    result = fp.metrics(run)
    assert result.success
    assert modes(flown) == ["planned", "hovering"]
    assert result.clearance > 0


def test_other_vehicles_need_no_tuning():
    small = fp.vehicle("crazyflie").replace(rotor_lag=0.072, rod_length=0.5)
    run, flown = flown_by(fp.nmpc(small), HANGING, 6.0, vehicle=small)
    assert fp.metrics(run).success
    assert modes(flown) == ["planned", "hovering"]


# Constraints ---------------------------------------------------------------------------------------------------------

OFF = [fp.Plant(mismatch={"mass": factor, "bob_mass": factor}) for factor in (0.9, 1.1)]
WALL = -0.45  # m: lowest x
MIDDLE, RADIUS = np.array([0.16, 0.0, -0.45]), 0.05  # m, as in test_constraints: a ball that the bob passes


def beyond(run):
    """How far pivot or rod go beyond the wall, m."""
    return WALL - min(np.min(run.x[:, 0]), np.min(run.x[:, 0] + HEHN.reach * run.y[:, 0]))


@pytest.mark.parametrize("plant", OFF)
def test_a_wall_is_kept_with_masses_off_by_a_tenth(plant):
    """The law goes through by 0.3 m."""
    box = ((WALL, -np.inf, -np.inf), (np.inf, np.inf, np.inf))
    kept, law = (fp.simulate(HEHN, law, STARTS[1], 1.5, plant=plant) for law in (fp.nmpc(HEHN, box=box), LAW))
    assert beyond(kept) < 0
    assert beyond(law) > 0.2


@pytest.mark.parametrize("plant", OFF)
def test_plans_that_do_not_know_of_a_wall_go_through(plant):
    assert beyond(fp.simulate(HEHN, fp.nmpc(), STARTS[1], 1.5, plant=plant)) > 0.1


def away(m):
    return ca.norm_2(m.x + HEHN.l * m.y - MIDDLE) - RADIUS


@pytest.mark.parametrize("plant", OFF)
def test_a_constraint_of_ones_own_is_kept_in_flight(plant):
    kept, free = (
        np.min(norm(run.x + HEHN.l * run.y - MIDDLE)) - RADIUS
        for run in (fp.simulate(HEHN, law, HANGING, 1.0, plant=plant) for law in (fp.nmpc(HEHN, keep=away), fp.nmpc()))
    )
    assert kept > -0.01
    assert free < -0.01


FALLING = fp.State(y=(0, 0, -1), x_dot=(0, 0, -2.5))  # its bob is 0.14 m above the floor that it cannot avoid
FLOOR = -0.7  # m


def test_where_no_plan_is_in_time_to_keep_walls_that_which_breaks_them_least_is_flown():
    """Not the law, which breaks them by far more."""
    start, walls = fp.random_starts(16, 9100)[6], fp.Constraints(box=((-0.6, -0.6, -np.inf), (0.6, 0.6, np.inf)))
    run, pilot = flown_by(fp.nmpc(HEHN, constraints=walls), start, 1.2)
    by_law = fp.simulate(HEHN, LAW, start, 1.2, plant="rotors")
    nmpc, law = (np.max(np.abs([run.x, run.x + HEHN.reach * run.y])[..., :2]) - 0.6 for run in (run, by_law))
    assert modes(pilot)[:2] == ["planned"]
    assert nmpc < 0.05
    assert law > 0.3


def test_a_floor_that_a_plan_touches_is_kept_in_flight():
    """A barrier about the floor jams once the flight is a millimetre below the plan; then it falls far below."""
    start = fp.random_starts(32, 7601)[31]
    run, pilot = flown_by(fp.nmpc(HEHN, floor=FLOOR), start, 1.0)
    plan = pilot.plans[0]
    planned, flown = (np.min([each.x[:, 2], each.x[:, 2] + HEHN.reach * each.y[:, 2]]) for each in (plan, run))
    assert planned < FLOOR + 1e-3
    assert flown > FLOOR - 1e-3


def test_a_plan_that_breaks_a_floor_is_taken_only_if_that_is_asked_for():
    asked = request(HEHN, FALLING, "excursion", np.zeros(3), kept=fp.Constraints(floor=FLOOR))
    strict = plan_within(asked, 12.5, 22, receding_horizon.ROUNDS)
    assert not strict
    found = plan_within(asked, 12.5, 22, receding_horizon.ROUNDS, fp.Constraints())
    assert found
    assert found.end_error < 0.1


def test_what_hovers_and_breaks_a_constraint_is_nearer_to_a_plan_than_what_never_hovers():
    """However much it breaks: the other is no flight at all."""
    none, some = np.zeros(2), np.array([True, True])
    end, lack = np.array([1.5, 0.5]), np.array([0.0, 5.0])
    verdict = Verdict(Measures(none + 1, none + 1, lack, none, end, none, some, none), soft=False)
    assert verdict.of(np.arange(2)) == (np.inf, 1, NOT_KEPT)


def test_a_sketch_does_not_know_of_walls():
    """Four iterations that do choose the way worse."""
    walled, free = (flown_by(fp.nmpc(HEHN, floor=floor), STARTS[1], 0.04)[0] for floor in (-0.5, None))
    unaware = walled.t < 0.012 + 0.019  # the first stage of the sketch: without walls, guesses are solved on meanwhile
    np.testing.assert_array_equal(walled.packed[unaware], free.packed[unaware])


def test_places_are_those_of_the_world_wherever_the_reference_is():
    """A flight and its wall moved together are the same, but for rounding."""
    by = np.array([0.3, -0.2, 0.4])
    low, high = np.array([-0.45, -2.0, -2.0]), np.array([2.0, 2.0, 2.0])
    one = fp.simulate(HEHN, fp.nmpc(box=(low, high)), STARTS[1], 0.4)
    moved = fp.nmpc(reference=fp.laws.references.hover(by), box=(low + by, high + by))
    other = fp.simulate(HEHN, moved, replace(STARTS[1], x=by), 0.4)
    np.testing.assert_allclose(other.x, one.x + by, atol=1e-6)


def test_a_window_counts_until_the_pivot_is_through():
    window = fp.Window((0.5, 0, 0), 1.0, 1.0)
    receding = fp.nmpc(window=window, floor=-2.0).flight_computer
    assert receding.kept(np.array([1.0, 0, 0]), np.zeros(3)).windows == (window,)
    assert receding.kept(np.array([0.4, 0, 0]), np.zeros(3)).given == {"floor": -2.0}


def test_hover_in_a_wall_is_refused():
    window = fp.Window((0, 2, 0.25), 0.3, 0.3)
    with pytest.raises(fp.InputError, match=r"^window: expected a wall that hover at the reference is clear of"):
        fp.nmpc(HEHN, window=window)
    fp.nmpc(HEHN, window=replace(window, centre=(1.0, 2, 0.25)))
    with pytest.raises(fp.InputError, match=r"^vehicle.body: "):
        fp.nmpc(HEHN.replace(body=None), window=window)


def test_beside_a_moving_reference_only_lean_and_clearance_mean_something():
    circle = fp.laws.references.circle()
    assert fp.nmpc(reference=circle, lean=1.0, clearance=0.02).flight_computer.constraints.lean == 1.0
    with pytest.raises(fp.InputError, match=r"^cost: expected nothing beside a reference that moves"):
        fp.nmpc(reference=circle, cost=lambda m: m.omega)


def test_thrust_scale_changes_the_unit_of_force_and_no_force(planned):
    """Believed to push 0.8 of what they should, rotors are still commanded within their limits in N, and no less."""
    made, states = real_time(planned)
    unit, scales = Units.of(HEHN).force, np.array([0.8, 1.0])
    before = made.commands * unit
    assert np.max(before) > 0.99 * HEHN.rotor_limits[1]  # where a unit that is off by a quarter shows
    there = states[0].copy()
    there[24:] *= 0.8  # the same forces in N, in the new unit
    assert made.improve(0, there, 0.0, NONE, scales)
    commands = made.commands * unit / 0.8
    low, high = HEHN.rotor_limits
    assert low < np.min(commands)
    assert 0.95 * high < np.max(commands) < high
    assert np.corrcoef(commands.ravel(), before.ravel())[0, 1] > 0.9


def test_aiming_in_another_unit_of_force_leaves_every_force_in_newtons(planned):
    solver = real_time(planned)[0]._solver
    numbers, hover = solver._problem.vehicle.copy(), solver.states[-1].copy()
    before = [solver.states[:, 24:].copy(), solver.commands.copy()]
    solver.aim(numbers, hover, 1.25)
    for old, new in zip(before, (solver.states[:, 24:], solver.commands), strict=True):
        np.testing.assert_allclose(1.25 * new, old, rtol=1e-14)


def test_constraints_of_ones_own_see_newtons_whatever_the_thrust_scale(planned):
    made, states = real_time(planned, fp.Constraints(keep=away))
    solver, place = made._solver, OWN + BASE - 2
    assert solver._problem.numbers[place, 0] == Units.of(HEHN).force
    made.improve(0, states[0], 0.0, NONE, np.array([0.8, 1.0]))
    assert solver._problem.numbers[place, 0] == pytest.approx(Units.of(HEHN).force / 0.8)


# What goes wrong: the law flies --------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def by_law():
    return fp.simulate(HEHN, LAW, STARTS[1], 8.0, engine="scipy")


def same_flight(run, by_law):
    np.testing.assert_array_equal(run.packed, by_law.packed[: len(run.t)])


def test_without_a_plan_the_law_flies_as_if_alone(by_law, monkeypatch):
    def no_plan(*_):
        raise fp.InputError("start", "another", "this")

    monkeypatch.setattr(receding_horizon, "request", no_plan)
    run, flown = flown_by(fp.nmpc(), STARTS[1], 8.0)
    same_flight(run, by_law)
    assert modes(flown)[:2] == ["waiting", "waiting"]
    assert flown.changes[0][2] == "start: expected another, got this"
    assert 1 < modes(flown).count("waiting") <= len(receding_horizon.ATTEMPTS)


def test_a_late_plan_is_not_flown(by_law, monkeypatch):
    monkeypatch.setattr(receding_horizon, "MEASURED_AT_FIRST", 1e-5)
    monkeypatch.setattr(receding_horizon, "LATE", 1.0)
    run, flown = flown_by(fp.nmpc(computing="measured"), STARTS[1], 1.0)
    same_flight(run, by_law)
    assert {why for _, _, why in flown.changes} == {"the plan is late"}


def test_a_blow_in_mid_throw_is_noticed_at_once_and_planned_for():
    """The plan is left within three stages; waiting until it is a rod length off doubled the excursion."""
    start = fp.random_starts(16, seed=7100)[1]
    plant = fp.Plant(wind=fp.Wind(knock_on_vehicle=4 * HEHN.M, knock_period=10.0), seed=1011)
    run, flown = flown_by(fp.nmpc(), start, 10, plant)
    law = fp.simulate(HEHN, LAW, start, 10, plant=plant)
    struck = run.t[np.argmax(norm(np.diff(run.x_dot, axis=0)))]
    assert [(mode, why) for _, mode, why in flown.changes][1] == ("waiting", "the flight is not as predicted")
    assert struck < flown.changes[1][0] < struck + 3 * flown.plans[0].stage
    assert modes(flown)[2:] == ["planned", "hovering"]
    assert fp.metrics(run).success
    assert fp.metrics(run).excursion < 0.8 * fp.metrics(law).excursion


def test_after_two_plans_that_are_not_flown_as_predicted_the_law_flies_until_hover(monkeypatch):
    monkeypatch.setattr(real_time_module, "GAP", 0.0)
    run, flown = flown_by(fp.nmpc(), STARTS[1], 9.0)
    assert modes(flown)[:5] == ["planned", "waiting", "planned", "waiting", "hovering"]
    assert flown.changes[4][0] > flown.changes[3][0] + 1  # s: nothing but the law brings it there
    assert fp.metrics(run).success


def test_iterations_that_fail_end_a_plan(monkeypatch):
    monkeypatch.setattr(RealTime, "improve", lambda *_: False)
    _, flown = flown_by(fp.nmpc(), STARTS[1], 0.4)
    assert [why for _, mode, why in flown.changes if mode == "waiting"] == ["10 iterations failed"]


def test_feedback_alone_flies_when_no_iteration_is_in_time(monkeypatch):
    """The nominal then is the plan; without disturbances that is enough."""
    monkeypatch.setattr(PlanInFlight, "_improve", lambda *_: None)
    run, flown = flown_by(fp.nmpc(), STARTS[1])
    assert fp.metrics(run).success
    assert flown.spent == []


@pytest.mark.parametrize("number", [0, slow(1)])
def test_switches_at_any_time_lose_no_flight(number, monkeypatch):
    """Plans are lost at random moments, up to as often as nmpc tries; the law alone would stand, and so it stands."""
    rng, command = np.random.default_rng(number), PlanInFlight.command

    def unreliable(self, *given):
        found, lost = command(self, *given)
        return found, lost or ("lost" if rng.random() < 0.01 else "")

    monkeypatch.setattr(PlanInFlight, "command", unreliable)
    monkeypatch.setattr(receding_horizon, "PAUSE", 0.1)
    run, flown = flown_by(fp.nmpc(), STARTS[number], 9.0)
    assert modes(flown).count("waiting") >= 2
    assert fp.metrics(run).success


def test_a_slow_computer_plans_less_and_stands():
    run, flown = flown_by(fp.nmpc(computing=0.02), STARTS[1], 8.0)
    assert fp.metrics(run).success
    # 76 iterations of guesses, each 0.7 of what is charged.
    assert flown.changes[0][0] == pytest.approx(1.064, abs=1e-5)  # and the delay that is found, a few µs


def test_a_computer_too_slow_for_any_plan_flies_the_law():
    run, flown = flown_by(fp.nmpc(computing=10), STARTS[1], 1.0)
    law = fp.simulate(HEHN, LAW, STARTS[1], 1.0)
    np.testing.assert_allclose(run.x, law.x, atol=1e-9)
    assert flown.changes[0][1:] == ("waiting", "a plan would take longer than its flight")


def test_time_that_is_measured_is_charged():
    run, flown = flown_by(fp.nmpc(computing="measured"), STARTS[1], 8.0)
    assert fp.metrics(run).success
    assert flown.changes


# Wherever a law is named ---------------------------------------------------------------------------------------------


def test_it_is_a_row_beside_laws():
    rows = fp.compare(HEHN, [law_named("nmpc"), LAW], STARTS[:2], 2.0, workers=1).rows()
    assert [row["law"] for row in rows] == ["nmpc", "inverted"]
    assert rows[0]["excursion_p50"] < rows[1]["excursion_p50"]


def test_a_table_gives_gains_and_reference_of_the_law_it_falls_back_on():
    circle = {"shape": "circle", "radius": 0.3}
    law = law_from({"name": "nmpc", "latency": 0.01, "gains": {"observer": 2.0}, "reference": circle})
    assert law.flight_computer.law.given["observer"] == 2.0
    assert law.flight_computer.latency == 0.01
    assert float(law.reference(0.0)[0]) == pytest.approx(0.3)


@pytest.mark.parametrize(
    ("call", "line"),
    [
        (lambda: fp.nmpc(computing=0), "computing: expected a finite number > 0 s"),
        (lambda: fp.nmpc(computing="a number of seconds"), "computing: expected 'measured', or a number of seconds"),
        (lambda: fp.nmpc(clearance=-1), "clearance: expected a finite number >= 0 m"),
        (lambda: fp.nmpc(waypoints=[(0, 0, 1)]), "waypoints: expected nothing: a plan that begins in flight"),
        (lambda: fp.nmpc(path=fp.laws.references.circle()), "path: expected nothing: the reference is the path"),
        (lambda: fp.nmpc(HEHN, ceiling=0.3), "ceiling: expected room for pivot and rod at the start"),
        (lambda: fp.simulate(HEHN, fp.nmpc(ceiling=0.3), HANGING, 1), "ceiling: expected room for pivot and rod"),
        (lambda: fp.nmpc(reference=fp.laws.references.circle(), floor=-2), "floor: expected nothing beside a ref"),
        (lambda: fp.nmpc(otherwise=3), "otherwise: expected a Law"),
        (lambda: fp.nmpc(HEHN.replace(rotor_limits=[0.0, 1.3])), "rotors that lift"),
        (lambda: fp.simulate(HEHN, fp.nmpc(), HANGING, 1, plant="hehn2011"), "wrench: a plan commands rotor forces"),
        (lambda: fp.export_c(fp.nmpc(), HEHN, "c-out"), "law: expected a Law"),
        (lambda: law_from({"name": "nmpc", "gains": {"latenc": 0.0}}), "did you mean 'latency'"),
    ],
)
def test_what_cannot_be_is_told(call, line):
    with pytest.raises(fp.InputError, match=line):
        call()
