"""The request: one record that is made and checked once, the same from every border."""

import dataclasses

import numpy as np
import pytest

import flypend as fp
from flypend import plants
from flypend.files import reading
from flypend.flight.ensemble import fly_many
from flypend.flight.request import Flight, Tolerances
from flypend.flight.simulate import fly
from flypend.laws import BoundLaw
from flypend.plants import ROTORS, Ideal, Sampled
from flypend.settings.runfile import run_of

VEHICLE = fp.vehicle("hehn2011")
HANGING = fp.State(y=(0.0, 0.0, -1.0))


def request(**changes):
    return Flight(**{"vehicle": VEHICLE, "law": fp.laws.inverted(), "starts": HANGING, "duration": 0.5, **changes})


def batch(runs=5):
    return fp.random_starts(runs, 3)


# What it holds --------------------------------------------------------------------------------------------------------


def test_it_holds_types_and_its_defaults_are_said_once():
    flight = request()
    assert isinstance(flight.law, BoundLaw)
    assert flight.law.vehicle == VEHICLE
    assert flight.plant == ROTORS == Sampled() == fp.Plant()
    assert flight.tolerances == Tolerances(rtol=1e-9)
    assert (flight.single, flight.runs, flight.seed) == (True, 1, 0)
    np.testing.assert_array_equal(flight.grid, np.linspace(0, 0.5, 51))


@pytest.mark.parametrize("name", ["ideal", "rotors", "mujoco", "hehn2011"])
def test_a_name_becomes_a_plant_at_the_border(name):
    plant = plants.plant(name)
    assert isinstance(plant, Ideal if name == "ideal" else Sampled)
    assert plants.plant(plant) is plant
    assert run_of(settings(plant=name)).flight.plant == plant


def settings(**more):
    start = {"y": [0.0, 0.0, -1.0]}
    return {"vehicle": "hehn2011", "law": {"name": "inverted"}, "start": start, "duration": 0.5, **more}


def test_the_rotors_turn_unless_somebody_asks_for_the_ideal_plant():
    assert run_of(settings()).flight.plant == ROTORS
    assert run_of({"experiment": 4}).flight.plant == Ideal()  # the paper's data say so
    table = {key: value for key, value in settings(duration=1.0).items() if key != "start"}
    assert fp.study({**table, "vary": {"start": {"y": "uniform"}}}).flight.plant == ROTORS
    run = fp.simulate(VEHICLE, fp.laws.inverted(), HANGING, 0.5)
    np.testing.assert_array_equal(
        run.packed, fp.simulate(VEHICLE, fp.laws.inverted(), HANGING, 0.5, plant=ROTORS).packed
    )
    runs = fp.simulate_ensemble(VEHICLE, fp.laws.inverted(), batch(2), 0.5)
    rotors = fp.simulate_ensemble(VEHICLE, fp.laws.inverted(), batch(2), 0.5, plant="rotors")
    np.testing.assert_array_equal(runs.final.packed(), rotors.final.packed())
    ideal = fp.simulate(VEHICLE, fp.laws.inverted(), HANGING, 0.5, plant="ideal")
    assert np.max(np.abs(ideal.y[-1] - run.y[-1])) > 1e-4  # negative control: it is another flight


def test_every_border_makes_the_same_request():
    ours, theirs = request(), run_of(settings()).flight
    for entry in dataclasses.fields(Flight):
        one, other = getattr(ours, entry.name), getattr(theirs, entry.name)
        if entry.name == "starts":
            one, other = one.packed().tolist(), other.packed().tolist()
        elif entry.name == "law":
            one, other = (one.name, one.gains), (other.name, other.gains)
        assert one == other, entry.name
    np.testing.assert_array_equal(fly(ours).packed, fly(theirs).packed)


def test_a_controller_is_sampled_at_its_own_rate_where_the_plant_is_ideal():
    controller = fp.Controller(name="plain", function=lambda t, state: fp.Wrench(5.0, np.zeros(3)), rate=50.0)
    flight = request(law=controller, plant=Ideal())
    assert flight.plant == Sampled(limits=False, lag=0.0, rate=50.0)
    assert flight.through(ROTORS).plant == ROTORS


def test_a_copy_is_checked_again_and_a_member_has_its_own_seed():
    flight = request(starts=batch(), plant=Sampled(seed=7))
    assert [flight.member(i).seed for i in (0, 4)] == [7, 11]
    assert flight.through(Sampled(seed=2)).seed == 2
    assert flight.replace(duration=1.0).duration == 1.0
    assert flight.loop.plant.seed == 0  # machine code does not depend on it
    for changes, field in (({"duration": -1.0}, "duration"), ({"durations": 1.0}, "flight.durations")):
        with pytest.raises(fp.InputError) as caught:
            flight.replace(**changes)
        assert caught.value.field == field


# What is refused ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"vehicle": "hehn2011"}, "vehicle: expected a Vehicle, "),
        ({"law": "inverted"}, "law: expected a Law or "),
        ({"starts": np.zeros(24)}, "starts: expected a State, "),
        (
            {"plant": "rotor"},
            "plant: expected one of ideal, rotors, mujoco, hehn2011, laboratory, got 'rotor'",
        ),
        ({"plant": 3}, "plant: expected a Plant, Ideal() or one of ideal"),
        ({"duration": 1e7}, "duration: expected at most 20000 s"),
        ({"judge_period": 0}, "judge_period: expected a finite number > 0 s"),
        ({"times": [0.2, 0.1]}, "times: expected increasing times"),
        ({"times": [0.2, 0.7]}, "times: expected times inside 0 .. 0.5 s"),
        ({"gains": {"rod_bandwidth": [3.0]}}, "gains: expected nothing for a single start"),
        ({"tolerances": Tolerances(method="dp5")}, "method: expected nothing in a sampled flight, got 'dp5'"),
        ({"tolerances": Tolerances(precision="float")}, "precision: expected 'double' in a sampled flight"),
    ],
)
def test_what_makes_no_sense_is_told_in_one_line(changes, line):
    with pytest.raises(fp.InputError) as caught:
        request(**changes)
    assert str(caught.value).startswith(line)


@pytest.mark.parametrize(
    ("gains", "line"),
    [
        ({"rod_bandwidth": [3.0, 4.0]}, "gains.rod_bandwidth: expected a number, or 5 of them, got shape (2,)"),
        ({"rod_bandwidth": -1.0}, "gains.rod_bandwidth: expected a finite number > 0 rad/s, got -1"),
        (
            {"rod_bandwidth": [3.0, 3.0, 0.0, 3.0, 3.0]},
            "gains.rod_bandwidth: expected a finite number > 0 rad/s, got 0",
        ),
        ({"rod_bandwith": 3.0}, "gains.rod_bandwith: expected one of"),
        ({"hanging_share": 1.5}, "gains.hanging_share: expected at most 1"),
    ],
)
def test_gains_of_each_run_have_the_bounds_of_the_law(gains, line):
    for asked in (
        lambda: request(starts=batch(), gains=gains),
        lambda: fp.simulate_ensemble(VEHICLE, fp.laws.inverted(), batch(), 0.1, gains=gains),
    ):
        with pytest.raises(fp.InputError) as caught:
            asked()
        assert str(caught.value).startswith(line)


# Sampled where it is asked --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("plant", ["ideal", "rotors", "callable"])
def test_samples_of_an_ensemble_are_those_of_single_runs_and_change_no_verdict(plant):
    """In the kernels and one by one: one flight each, judged on its grid, kept at times of its own."""
    law = fp.laws.inverted()
    if plant == "callable":
        plant = "rotors"
        law = fp.Controller(name="plain", function=lambda t, s: fp.Wrench(VEHICLE.weight, -0.01 * s.omega))
    times, starts = [0.0, 0.1234, 0.4], batch()
    kept = fp.simulate_ensemble(VEHICLE, law, starts, 0.5, plant=plant, times=times, workers=1)
    plain = fp.simulate_ensemble(VEHICLE, law, starts, 0.5, plant=plant, workers=1)
    assert kept.samples.batch_shape == (5, 3)
    np.testing.assert_allclose(kept.t, times if plant == "ideal" else [0.0, 0.124, 0.4])
    for name in ("success", "settling", "excursion", "effort", "peak_force", "end", "cause"):
        np.testing.assert_array_equal(getattr(kept, name), getattr(plain, name), err_msg=name)
    np.testing.assert_array_equal(kept.final.packed(), plain.final.packed())
    for i in (0, 4):
        run = fp.simulate(VEHICLE, law, starts[i], 0.5, plant=plant, times=times)
        np.testing.assert_allclose(kept.samples[i].packed(), run.packed, rtol=0, atol=1e-12)


def test_an_ensemble_flies_once(monkeypatch):
    from flypend.flight.kernels.ideal import IdealKernel
    from flypend.flight.kernels.sampled import SampledKernel

    flown = []
    for kind in (IdealKernel, SampledKernel):
        monkeypatch.setattr(
            kind, "fly", lambda self, *a, own=kind.fly, **k: flown.append(k["keep_at"]) or own(self, *a, **k)
        )
    for plant in (Ideal(), ROTORS):
        fly_many(request(starts=batch(), plant=plant, times=np.array([0.1, 0.4])), workers=1)
    assert len(flown) == 2
    assert all(len(times) == 2 for times in flown)


def test_samples_after_the_end_of_a_run_are_nan():
    case = fp.paper.experiment("4")
    starts = fp.State.from_packed(np.stack([case.start.packed()] * 2))
    end = fp.simulate(case.vehicle, case.law("printed"), starts[0], 0.3, plant="ideal").outcome.time
    assert end < 0.29
    for engine in ("kernel", "scipy"):
        runs = fp.simulate_ensemble(
            case.vehicle,
            case.law("printed"),
            starts,
            0.3,
            plant="ideal",
            times=[end / 2, 0.29],
            engine=engine,
            workers=1,
        )
        assert runs.cause.tolist() == ["singular", "singular"]
        assert np.isfinite(runs.samples.packed()[:, 0]).all()
        assert np.isnan(runs.samples.packed()[:, 1]).all()


# One family of results ------------------------------------------------------------------------------------------------


def results():
    inverted, starts = fp.laws.inverted(), batch()
    return {
        "ideal": fp.simulate(VEHICLE, inverted, HANGING, 0.2, plant="ideal"),
        "rotors": fp.simulate(VEHICLE, inverted, HANGING, 0.2),
        "ensemble": fp.simulate_ensemble(VEHICLE, inverted, starts, 0.2),
        "samples and gains": fp.simulate_ensemble(
            VEHICLE, inverted, starts, 0.2, times=[0.0, 0.1], gains={"rod_bandwidth": np.linspace(5, 9, 5)}
        ),
        "sensitivity": fp.sensitivity(fp.vehicle("nayak2018"), fp.laws.corrected(), HANGING, 0.1, gains=("k_1",)),
        "by the start": fp.sensitivity(fp.vehicle("nayak2018"), fp.laws.corrected(), HANGING, 0.1),
    }


def test_results_have_the_same_names_and_their_frames_have_rows():
    for name, result in results().items():
        assert isinstance(result.final, fp.State), name
        assert isinstance(result.vehicle, fp.Vehicle), name
        assert isinstance(result.law, str), name
        assert result.e3 in ("up", "down"), name
        data = result.to_xarray()
        assert data.attrs["law"] == result.law
        frame = data.to_dataframe()
        assert len(frame) > 0, name
        assert len(frame) < 1e5, name  # the mechanism is no product of what has nothing to do with each other
    rotors = results()["rotors"].to_xarray()
    assert rotors.sizes["t"] == 21
    np.testing.assert_array_equal(rotors["y"].isel(t=3), results()["rotors"].y[3])


def test_an_ensemble_as_arrays_has_every_run_with_its_gains():
    runs = results()["samples and gains"]
    data = runs.to_xarray()
    np.testing.assert_array_equal(data["gains.rod_bandwidth"], np.linspace(5, 9, 5))
    np.testing.assert_array_equal(data["final_R"], runs.final.R)
    np.testing.assert_array_equal(data["y"].sel(t=0.1), runs.samples.y[:, 1])
    assert data["final_R"].dims == ("run", "axis", "body_axis")
    assert data["settling"].attrs["units"] == "s"
    assert data["final_x"].attrs["units"] == "m"
    assert len(data[["success", "cause", "excursion"]].to_dataframe()) == 5


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("seed", -3), ("seed", 1.5), ("seed", "a"), ("criterion", 3), ("tolerances", 1e-6), ("gains", 3),
        ("judge_period", 1e-9),
    ],
)  # fmt: skip
def test_a_request_is_checked_whole(field, value):
    given = {
        "vehicle": fp.vehicle("hehn2011"),
        "law": fp.laws.inverted(),
        "starts": fp.State(y=(0, 0, 1)),
        "duration": 1.0,
    }
    with pytest.raises(fp.InputError, match=rf"^{field}: "):
        Flight(**given, **{field: value})


@pytest.mark.parametrize(("runs", "seed"), [(-1, 1), (2.5, 1), ("3", 1), (10**15, 1), (3, -1), (3, 1.5), (3, None)])
def test_random_starts_take_whole_numbers(runs, seed):
    with pytest.raises(fp.InputError, match=r"^(runs|seed): "):
        fp.random_starts(runs, seed)


def test_a_lag_that_a_law_knows_is_one_of_the_vehicle():
    prompt = fp.vehicle("hehn2011").replace(rotor_lag=0.0)
    with pytest.raises(fp.InputError, match=r"^vehicle\.rotor_lag: "):
        fp.simulate(prompt, fp.laws.lqr(), fp.State(y=(0, 0, 1)), 0.1, plant=fp.Ideal(lag=True))


@pytest.mark.parametrize("law", ["inverted", "lqr"])
def test_without_gravity_there_is_no_inverted_pose(law):
    with pytest.raises(fp.InputError, match=r"^vehicle\.gravity: "):
        getattr(fp.laws, law)().bind(fp.vehicle("hehn2011").replace(gravity=0.0))


# What cannot be flown, and what would not fit -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "line"),
    [
        (lambda: fp.Plant(dely=1), r"^Sampled.dely: expected one of .*, got 'dely' \(did you mean 'delay'\?\)$"),
        (lambda: fp.State(x=(0, 0, 0)), r"^State.y: expected .*unit vector from .*, got nothing$"),
        (lambda: fp.State((0, 0, 0)), r"^State: expected arguments by name, such as x=, got 1 without$"),
        (lambda: fp.Criterion(rodd=1), r"^Criterion.rodd: .* \(did you mean 'rod'\?\)$"),
        (lambda: fp.Vehicle(mass=1.0), r"^Vehicle.bob_mass: .*mass of the rod with its bob, kg, got nothing$"),
        (
            lambda: fp.Law(name="a", e3="up", control=lambda t, s: None),
            r"^law.control: expected a function \(t, state, vehicle, gains\[, forces\]\), got one \(t, s\)$",
        ),
        (lambda: fp.Controller(name="a", function=lambda t: None), r"^controller.function: .*, got one \(t\)$"),
        (lambda: fp.random_starts(3), r"^random_starts.seed: expected an integer, got nothing$"),
        (lambda: fp.simulate_ensemble(), r"^simulate_ensemble.vehicle: expected a Vehicle, such as .*, got nothing$"),
        (
            lambda: fp.Vehicle.estimate(mass="620 g"),
            r"^estimate.arm: expected .*mass without the rod, .*, got nothing$",
        ),
        (lambda: fp.Vehicle.estimate(0.62), r"^estimate: expected arguments by name, such as mass=, got 1 without$"),
        (lambda: fp.Law(name="a", e3="up", control=None), r"^law.control: expected a function .*, got None$"),
    ],
)
def test_wrong_calls_are_one_line(make, line):
    with pytest.raises(fp.InputError, match=line):
        make()


def own(**changes):
    given = {
        "vehicle": fp.vehicle("hehn2011"),
        "law": fp.laws.lqr(),
        "starts": fp.State(y=(0, 0, 1.0)),
        "duration": 1.0,
    }
    return fp.Flight(**given | changes)


def test_a_start_in_degrees_is_asked_about():
    with pytest.raises(fp.InputError, match=r"start.omega: expected at most 200 rad/s .*, got 360 rad/s; is it in deg"):
        own(starts=fp.State(y=(0, 0, 1.0), omega=(0, 360, 0)))
    own(starts=fp.State(y=(0, 0, 1.0), omega=(0, 199, 0)))


@pytest.mark.parametrize("change", [{"bob_mass": 1.0}, {"mass": 5.0}])
def test_a_vehicle_that_cannot_lift_itself_is_told_so_at_once(change):
    vehicle = fp.vehicle("hehn2011").replace(**change)
    with pytest.raises(fp.InputError, match=rf"rotors that lift it: more than its weight, {vehicle.weight:.4g} N"):
        own(vehicle=vehicle)
    own(vehicle=vehicle, plant="ideal")  # which has no limits
    own(vehicle=vehicle, plant=fp.Plant(limits=False))


def test_results_beyond_the_memory_are_refused_with_what_they_need(monkeypatch):
    monkeypatch.setattr(reading, "free_memory", lambda: 1e9)
    with pytest.raises(
        fp.InputError, match=r"duration: .* fits the 1 GB of free memory, got 1000001 samples, .* 2 GB$"
    ):
        own(duration=10_000.0)
    own(duration=10_000.0, times=[1.0])
    many = fp.State(y=np.tile([0, 0, 1.0], (1000, 1)))
    with pytest.raises(fp.InputError, match=r"times: .* got 1000 runs with 10000 samples each, which need 2.24 GB$"):
        own(starts=many, times=np.linspace(0.0, 1.0, 10_000))
    own(starts=many)
    with pytest.raises(fp.InputError, match=r"runs: .* got 100000000 starts, which need 100 GB$"):
        fp.random_starts(10**8, 1)
    with pytest.raises(
        fp.InputError, match=r"judge_period: expected at most 1e\+07 .*, got 1e-09 s, which takes 1e\+09"
    ):
        own(judge_period=1e-9)


def test_the_free_memory_is_a_number_of_bytes():
    assert 1e7 < reading.free_memory() < 1e14


def test_results_fit_a_screen():
    runs = fp.simulate_ensemble(fp.vehicle("hehn2011"), fp.laws.lqr(), fp.random_starts(3, 1), 0.1)
    law = fp.laws.inverted(throw_speed=2.0)
    for thing in (fp.vehicle("hehn2011"), law, law.bind(fp.vehicle("hehn2011")), runs):
        assert len(repr(thing)) < 160
        assert "\n" not in repr(thing)
    assert "throw_speed=2.0" in repr(law)
    assert " of 3 succeed" in repr(runs)


def test_the_largest_number_of_steps_holds_for_every_engine_and_is_told():
    flight = request(starts=batch()[0], duration=4.0, plant=Ideal(), tolerances=Tolerances(max_steps=5))
    for engine in ("kernel", "scipy"):
        outcome = fly(flight, engine).outcome
        assert (outcome.status, outcome.reason) == ("diverged", "5 steps were not enough")
    for wrong in (0, -3, 2.5, "many"):
        with pytest.raises(fp.InputError, match=r"max_steps"):
            Tolerances(max_steps=wrong)
