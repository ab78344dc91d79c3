"""Ensembles: member i is the single run, whatever flies beside it, in whatever process, in the order of the starts."""

import dataclasses
import math

import casadi as ca
import numpy as np
import pytest
from joblib.externals.loky import get_reusable_executor

import flypend as fp
from flypend import Plant
from flypend.flight import ensemble
from flypend.flight.ensemble import Ensemble, simulate_ensemble
from flypend.flight.metrics import Metrics, metrics, wilson
from flypend.laws import Controller, corrected, inverted, printed
from flypend.paper import experiment
from flypend.plants import Noise, Wind

VEHICLE = fp.vehicle("hehn2011")
FIELDS = [entry.name for entry in dataclasses.fields(Metrics)]
BLOWN = Plant(
    rate=100.0, noise=Noise(x=0.01, attitude=0.01, omega=0.1, y_dot=0.1), wind=Wind(gust_on_vehicle=0.3), seed=7
)


@pytest.fixture(scope="module")
def starts():
    return fp.State.random(np.random.default_rng(3), 5)


@pytest.fixture(scope="module", autouse=True)
def _no_process_stays():
    yield
    get_reusable_executor().shutdown(wait=True)


def weak(gain):
    """A law of one's own: a closure over `gain` that no module can be asked for."""

    def control(t, state, vehicle, gains):
        return fp.Wrench(vehicle.weight * state.R[2, 2], -gain * gains.k * state.omega)

    return fp.Law(name="weak", e3="up", control=control, gains={"k": 0.01})


def counted(gain):
    """A plain callable of one's own, a closure as well."""
    return Controller(name="plain", function=lambda t, state: fp.Wrench(gain, -0.01 * state.omega), rate=50.0)


def same(one, other):
    """Whether two values are equal, NaN being equal to itself."""
    return one == other or (isinstance(one, float) and math.isnan(one) and math.isnan(other))


def is_the_single_run(result, i, law, start, duration, plant):
    run = fp.simulate(VEHICLE, law, start, duration, plant=plant)
    np.testing.assert_array_equal(result.final.packed()[i], run.packed[-1])
    single, accuracy = metrics(run), {}
    if plant == "ideal" and not isinstance(law, Controller):
        # Forces come from the steps: those of a run that is sampled finely. Between steps, a distance is a quintic.
        fine = metrics(fp.simulate(VEHICLE, law, start, duration, plant=plant, times=np.linspace(0, duration, 20_001)))
        single = dataclasses.replace(single, effort=fine.effort, peak_force=fine.peak_force)
        # The stages of a step lie some milliseconds apart, so the top of a peak may fall between them.
        accuracy = {"excursion": 1e-6, "effort": 1e-6, "peak_force": 5e-3}
    for name in FIELDS:
        got, wanted = np.asarray(getattr(result, name))[i].item(), getattr(single, name)
        if plant == "ideal" and name in ("lowest", "box_x", "box_y", "box_z") and not isinstance(law, Controller):
            assert math.isnan(got), name  # the kernel of the ideal plant does not follow them
            continue
        # A kernel judges in fused operations, `metrics` in NumPy's: the same numbers up to roundoff.
        assert same(got, wanted) or got == pytest.approx(wanted, rel=accuracy.get(name, 1e-9)), name


# A member is a single run ---------------------------------------------------------------------------------------------

CASES = {
    "symbolic, ideal": (inverted, "ideal"),
    "symbolic, rotors": (inverted, "rotors"),
    "of one's own, ideal": (lambda: weak(1.0), "ideal"),
    "of one's own, rotors": (lambda: weak(1.0), Plant(rate=100.0, delay=0.004)),
    "callable, ideal": (lambda: counted(5.0), "ideal"),
    "callable, thrust and rates": (lambda: counted(5.0), "hehn2011"),
    "e3 down, ideal": (corrected, "ideal"),
    "e3 down, rotors": (corrected, Plant(rate=100.0)),
}


@pytest.mark.parametrize("case", CASES)
def test_each_member_is_the_single_run_to_the_last_bit(case, starts):
    factory, plant = CASES[case]
    law = factory()
    result = simulate_ensemble(VEHICLE, law, starts, 0.3, plant=plant, workers=1)
    assert len(result) == 5
    assert (result.law, result.vehicle, result.e3) == (law.name, VEHICLE, law.e3)
    for i in range(5):
        is_the_single_run(result, i, law, starts[i], 0.3, plant)
    assert len(np.unique(result.final.packed(), axis=0)) == 5  # and no two are the same


def test_each_member_is_the_single_run_in_mujoco(starts):
    pytest.importorskip("mujoco")
    result = simulate_ensemble(VEHICLE, inverted(), starts, 0.1, plant="mujoco", workers=1)
    for i in range(5):
        is_the_single_run(result, i, inverted(), starts[i], 0.1, "mujoco")


def test_member_i_has_the_seed_of_the_plant_and_i(starts):
    result = simulate_ensemble(VEHICLE, weak(1.0), starts, 0.2, plant=BLOWN, workers=1)
    for i in range(5):
        is_the_single_run(result, i, weak(1.0), starts[i], 0.2, BLOWN.replace(seed=7 + i))
    # Negative control: with the seed of another member it is another flight.
    other = fp.simulate(VEHICLE, weak(1.0), starts[1], 0.2, plant=BLOWN.replace(seed=7)).packed[-1]
    assert np.max(np.abs(other - result.final.packed()[1])) > 1e-6


def test_the_accuracy_is_that_asked_for(starts):
    for rtol in (1e-4, 1e-9):
        result = simulate_ensemble(VEHICLE, weak(1.0), starts, 0.3, rtol=rtol, workers=1, plant="ideal")
        run = fp.simulate(VEHICLE, weak(1.0), starts[4], 0.3, rtol=rtol, plant="ideal")
        np.testing.assert_array_equal(result.final.packed()[4], run.packed[-1])
        assert len(run.drift) < 30 if rtol == 1e-4 else len(run.drift) > 3


def test_the_frame_is_that_of_the_law(starts):
    """A law with e₃ down takes and gives states with e₃ down; it is judged with e₃ up all the same."""
    hanging = fp.State(y=np.tile([0.0, 0.0, 1.0], (2, 1)))  # along gravity
    result = simulate_ensemble(experiment("1").vehicle, corrected(), hanging, 1.5, workers=1, plant="ideal")
    assert np.all(result.final.y[:, 2] > 0.99)  # y₃: it stays
    assert result.cause.tolist() == ["rod", "rod"]
    np.testing.assert_array_equal(result.starts.packed(), hanging.packed())


# Processes and order -------------------------------------------------------------------------------------------------


@pytest.fixture
def small_tasks(monkeypatch):
    """Two runs to a task, so that few starts are several tasks."""
    monkeypatch.setattr(ensemble, "CHUNK", 2)
    monkeypatch.setattr("flypend.flight.kernels.results.LEAST_SHARE", 2)
    monkeypatch.setattr("flypend.flight.kernels.sampled.PIECE", 2)


def test_processes_change_nothing_and_the_order_is_that_of_the_starts(starts, small_tasks):
    """Symbolic laws, closures, callables, seeds and frames: all of it travels to another process, and back in order."""
    flown = {
        "inverted": (inverted(), "ideal"),
        "closure": (weak(1.0), BLOWN),
        "callable": (counted(5.0), "ideal"),
        "e3 down": (corrected(), "ideal"),
        "reference": (inverted(reference=fp.laws.references.circle(0.1)), Plant(rate=50.0)),
    }
    for law, plant in flown.values():
        told = {1: [], 2: []}
        one, two = (
            simulate_ensemble(
                VEHICLE, law, starts, 0.2, plant=plant, workers=n, progress=lambda *now, to=told[n]: to.append(now)
            )
            for n in told
        )
        np.testing.assert_array_equal(one.final.packed(), two.final.packed())
        for name in FIELDS:
            np.testing.assert_array_equal(getattr(one, name), getattr(two, name), err_msg=name)
        for now in told.values():  # kernels are asked ten times a second
            assert now[-1] == (5, 5)
            assert now == sorted(now)
        if law is flown["callable"][0]:
            assert told[1] == told[2] == [(2, 5), (4, 5), (5, 5)]
        seeded = plant if isinstance(plant, str) else plant.replace(seed=plant.seed + 4)
        is_the_single_run(two, 4, law, starts[4], 0.2, seeded)


def test_a_law_that_no_other_process_can_have_is_flown_in_this_one(starts, small_tasks):
    held = ca.SX.sym("held")  # CasADi's symbols cannot be pickled, no more than a loaded C library

    def function(t, state):
        return fp.Wrench(VEHICLE.weight + 0.0 * held.numel(), -0.01 * state.omega)

    law = Controller(name="bound to this process", function=function, rate=50.0)
    one, two = (simulate_ensemble(VEHICLE, law, starts, 0.1, workers=n, plant="ideal") for n in (1, 2))
    np.testing.assert_array_equal(one.final.packed(), two.final.packed())


def test_results_come_in_the_order_of_the_starts_though_the_first_take_longest(small_tasks):
    """Start 0 keeps its process busy while the others are done; heights tell who is who."""

    def function(t, state):
        if state.x[0] > 0 and t == 0.0:
            np.linalg.svd(np.random.default_rng(0).random((700, 700)))
        return fp.Wrench(VEHICLE.weight, np.zeros(3))

    x = np.stack([np.arange(6) == 0, np.zeros(6), np.arange(6)], axis=-1).astype(float)
    starts = fp.State(x=x, y=np.tile([0.0, 0, -1], (6, 1)))
    done = []
    law = Controller(name="busy", function=function, rate=50.0)
    result = simulate_ensemble(
        VEHICLE, law, starts, 0.04, workers=2, progress=lambda n, of: done.append((n, of)), plant="ideal"
    )
    np.testing.assert_allclose(result.final.x[:, 2], np.arange(6), atol=1e-9)
    assert done == [(2, 6), (4, 6), (6, 6)]


def test_progress_is_told_as_tasks_of_eight_come_in():
    done, starts = [], fp.State(y=np.tile([0.0, 0, -1], (20, 1)))
    simulate_ensemble(
        VEHICLE,
        counted(5.0),
        starts,
        0.02,
        workers=1,
        progress=lambda n, of: done.append((n, of, len(done))),
        plant="ideal",
    )
    assert done == [(8, 20, 0), (16, 20, 1), (20, 20, 2)]


# Neighbours ----------------------------------------------------------------------------------------------------------


def test_a_member_that_diverges_leaves_its_neighbours_alone():
    """Whoever starts at x₁ > 1 m is thrown off by 1e12 N, beyond every bound within a step."""

    def function(t, state):
        return fp.Wrench(1e12 if state.x[0] > 1 else VEHICLE.weight, -0.01 * state.omega)

    law, plant = Controller(name="wild", function=function), Plant(limits=False, lag=0.0, rate=100.0)
    y = fp.State.random(np.random.default_rng(1), 4).y
    tame = fp.State(x=np.zeros((4, 3)), y=y)
    with_one = fp.State(x=np.array([0.0, 0, 2, 0])[:, None] * [1.0, 0, 0], y=y)
    calm = simulate_ensemble(VEHICLE, law, tame, 0.3, plant=plant, workers=1)
    result = simulate_ensemble(VEHICLE, law, with_one, 0.3, plant=plant, workers=1)
    assert result.cause.tolist()[2] == "diverged"
    assert "diverged" not in calm.cause
    assert result.end[2] < 0.05
    rest = [0, 1, 3]
    np.testing.assert_array_equal(result.final.packed()[rest], calm.final.packed()[rest])
    for name in FIELDS:
        np.testing.assert_array_equal(getattr(result, name)[rest], getattr(calm, name)[rest])
    assert np.all(np.isfinite(result.final.packed()))


def test_a_member_that_meets_a_singularity_is_named():
    case = experiment("4")
    starts = fp.State(
        y=np.stack([case.start.y, [0.0, 0, 1]]), y_dot=np.stack([case.start.y_dot, np.zeros(3)]), omega=np.zeros((2, 3))
    )
    result = simulate_ensemble(case.vehicle, printed(**case.gains), starts, 0.3, workers=1, plant="ideal")
    single = fp.simulate(case.vehicle, printed(**case.gains), starts[0], 0.3, plant="ideal")
    assert (result.cause[0], result.end[0]) == ("singular", single.outcome.time)
    assert single.outcome.time < 0.3
    np.testing.assert_array_equal(result.final.packed()[0], single.packed[-1])


# What is told about many ---------------------------------------------------------------------------------------------


def made(success, **columns):
    n = len(success)
    state = fp.State(y=np.tile([0.0, 0, 1], (n, 1)))
    blank = {name: np.zeros(n) for name in FIELDS} | {"starts": state, "final": state}
    return Ensemble(law="a", vehicle=VEHICLE, e3="up", **(blank | {"success": np.array(success)} | columns))


def test_rate_interval_and_percentiles():
    result = made([True] * 8 + [False] * 2, settling=np.array([*np.arange(8.0), np.nan, np.nan]))
    assert len(result) == 10
    assert result.rate == 0.8
    assert result.interval == wilson(8, 10)
    assert result.percentile("settling", 50) == 3.5  # of those that settle
    assert result.percentile("settling", 100) == 7.0
    assert math.isnan(made([False] * 3, settling=np.full(3, np.nan)).percentile("settling", 50))


# What is refused -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "starts",
    [fp.State(y=(0, 0, 1)), fp.State(y=np.tile([0.0, 0, 1], (2, 2, 1))), np.zeros((3, 24)), [fp.State(y=(0, 0, 1))]],
    ids=["one state", "two axes", "packed", "a list"],
)
def test_starts_have_to_be_a_batch(starts):
    with pytest.raises(fp.InputError, match=r"^starts: expected a State"):
        simulate_ensemble(VEHICLE, inverted(), starts, 0.1, plant="ideal")


def test_what_a_single_run_refuses_is_refused(starts):
    for options, field in (({"plant": "rotor"}, "plant"), ({"rtol": 0.0, "plant": "ideal"}, "rtol")):
        with pytest.raises(fp.InputError, match=field):
            simulate_ensemble(VEHICLE, inverted(), starts[:2], 0.1, workers=1, **options)
    with pytest.raises(fp.InputError, match="duration"):
        simulate_ensemble(VEHICLE, inverted(), starts[:2], -1.0, workers=1, plant="ideal")


def test_nothing_to_fly_and_nobody_to_fly_it_are_refused(starts):
    with pytest.raises(fp.InputError, match=r"^starts: expected at least one"):
        simulate_ensemble(VEHICLE, inverted(), starts[:0], 0.1)
    with pytest.raises(fp.InputError, match=r"^workers: "):
        simulate_ensemble(VEHICLE, inverted(), starts[:2], 0.1, workers=0)


def test_what_is_refused_in_another_process_is_told_as_here(starts, small_tasks):
    with pytest.raises(fp.InputError, match=r"^duration: expected a finite number > 0 s, got -1$"):
        simulate_ensemble(VEHICLE, inverted(), starts, -1.0, workers=2, plant="ideal")


def test_times_that_do_not_increase_are_refused(starts):
    for times in ([0.5, 0.2], [0.2, 0.2], [-0.1, 0.5], [0.5, 1.5], []):
        with pytest.raises(fp.InputError, match=r"^times: expected (increasing times|times inside)"):
            simulate_ensemble(VEHICLE, inverted(), starts, 1.0, times=times, plant="ideal")


def test_states_that_are_kept_change_no_verdict(starts):
    plain, kept = (
        simulate_ensemble(VEHICLE, inverted(), starts, 1.0, times=times, plant="ideal") for times in (None, [0.0, 0.7])
    )
    for name in FIELDS:
        np.testing.assert_array_equal(getattr(plain, name), getattr(kept, name), err_msg=name)


@pytest.mark.parametrize("plant", ["rotors", "ideal", "mujoco"])
@pytest.mark.parametrize(("law", "gain"), [("inverted", "lead"), ("inverted", "observer"), ("lqr", "position_error")])
def test_gains_per_run_that_change_nothing_are_refused(plant, law, gain):
    starts, vehicle = fp.random_starts(2, 1), fp.vehicle("hehn2011")
    with pytest.raises(fp.InputError, match=rf"^law\.gains\.{gain}: "):
        simulate_ensemble(vehicle, getattr(fp.laws, law)(), starts, 0.1, plant=plant, gains={gain: [1.5, 2.0]})


def test_gains_of_a_callable_that_does_not_take_them_are_refused():
    law = fp.Controller(name="push", function=lambda t, state: fp.Wrench(1.0, np.zeros(3)), gains={"k": 1.0})
    with pytest.raises(fp.InputError, match=r"^gains: "):
        simulate_ensemble(fp.vehicle("hehn2011"), law, fp.random_starts(2, 1), 0.1, gains={"k": [1.0, 2.0]})


@pytest.mark.parametrize("engine", ["kernel", "scipy"])
def test_through_a_lag_the_wrenches_at_the_kept_times_are_those_of_the_single_run(starts, engine):
    times, plant = np.array([0.03, 0.1]), fp.Ideal(lag=True)
    result = simulate_ensemble(VEHICLE, inverted(), starts[:2], 0.1, plant=plant, times=times, engine=engine, workers=1)
    for i in range(2):
        run = fp.simulate(VEHICLE, inverted(), starts[i], 0.1, plant=plant, times=times, engine=engine)
        wanted = np.column_stack([run.thrust, run.moment])
        np.testing.assert_allclose(result.wrenches[i], wanted, rtol=1e-7, atol=1e-9)  # other steps, same tolerance
