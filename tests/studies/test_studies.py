"""Studies: the same physical starts for everyone, laws by name, the ladder with its negative controls, and reports."""

import dataclasses
import io
import json
import math
import re
import sys

import numpy as np
import pytest
from rich.console import Console

import flypend as fp
from benchmarks import circles
from benchmarks.circles import Tracking, hehn2011, tracking_table
from flypend import Plant, geometry
from flypend.files import whole as files
from flypend.flight.ensemble import Ensemble
from flypend.flight.metrics import Metrics, wilson
from flypend.laws import Controller, Law, inverted
from flypend.model.state import FLIP_PACKED
from flypend.pictures import figures
from flypend.pictures.studies import comparison_figure, ladder_figure
from flypend.report.studies import (
    comparison_markdown,
    comparison_table,
    ladder_rows,
    ladder_table,
    write_comparison,
    write_ladder,
)
from flypend.studies import Comparison, Ladder, compare, ladder, law_named, paper_starts, random_starts
from flypend.studies.compare import summary
from flypend.studies.ladder import RUNGS, rung_named, rungs_for

VEHICLE = fp.vehicle("hehn2011")

# Starts ---------------------------------------------------------------------------------------------------------------

# Section IV of the paper: y(0) and y_dot(0) of its five experiments, 1/√2 rounded, and the start that they share.
Y = [[0.7071, 0, 0.7071], [0.7071, 0, 0.7071], [0.1, 0.0995, -0.99], [0, 0, -1], [-0.7071, 0, 0.7071]]
Y_DOT = [[0.5, 0, -0.5], [0.7, 0, -0.7], [2.2263, 0.25, 0.25], [0, 0, 0], [0.7, 0, 0.7]]
COMMON = {
    "x": [0, 0, 0],  # the paper's (1, 1, 1) is of no concern to a law that holds a position
    "x_dot": [2, 1.5, 1],
    "R": [[0.36, 0.48, -0.8], [-0.8, 0.6, 0], [0.48, 0.64, 0.6]],
    "omega": [0.8, -0.3, 0.5],
}


def test_the_papers_starts_are_its_numbers():
    starts = paper_starts()
    assert starts.batch_shape == (5,)
    np.testing.assert_allclose(starts.y, Y, atol=1e-4)  # printed to four digits
    np.testing.assert_allclose(starts.y_dot, Y_DOT, atol=1e-4)
    for name, value in COMMON.items():
        np.testing.assert_allclose(getattr(starts, name), np.broadcast_to(value, (5, *np.shape(value))), atol=1e-12)


def test_random_starts_are_within_the_stated_bounds_reach_them_and_cover_all_attitudes():
    starts = random_starts(2000, 5)
    assert starts.batch_shape == (2000,)
    assert not np.any(starts.x)
    for name, bound in (("omega", 3.0), ("y_dot", 3.0), ("x_dot", 2.0)):
        length = geometry.norm(getattr(starts, name))
        assert 0.99 * bound < length.max() <= bound * (1 + 1e-12)
    np.testing.assert_allclose(geometry.dot(starts.y, starts.y_dot), 0, atol=1e-12)
    # A uniform unit vector has mean 0 and variance 1/3 per component: 0.577/√2000 = 0.013 for the mean.
    for vectors in (starts.y, starts.z, starts.R[..., 0]):
        np.testing.assert_allclose(vectors.mean(axis=0), 0, atol=5 * 0.013)
        np.testing.assert_allclose(np.mean(vectors**2, axis=0), 1 / 3, atol=0.04)
    # The angle of a uniform rotation has the density (1 − cos θ)/π: mean π/2 + 2/π, variance 0.42.
    angle = np.arccos(np.clip((np.trace(starts.R, axis1=1, axis2=2) - 1) / 2, -1, 1))
    assert np.mean(angle) == pytest.approx(np.pi / 2 + 2 / np.pi, abs=5 * 0.65 / np.sqrt(2000))


def test_a_seed_gives_the_same_starts_and_another_gives_others():
    np.testing.assert_array_equal(random_starts(4, 1).packed(), random_starts(4, 1).packed())
    assert np.min(np.abs(random_starts(4, 1).y - random_starts(4, 2).y)) > 1e-6


# Comparisons ----------------------------------------------------------------------------------------------------------


def hover(t, state):
    """A Controller's function, e₃ up: some thrust, a push and some damping, none of them symmetric."""
    return fp.Wrench(VEHICLE.weight * (1 + 0.1 * state.y[1]), np.array([1e-4, 2e-4, -1e-4]) - 0.01 * state.omega)


def mirrored(t, state):
    """The same controller as seen with e₃ down."""
    return hover(t, state.flipped()).flipped()


@pytest.mark.parametrize("plant", ["ideal", Plant(rate=100.0, delay=0.003, seed=2)], ids=["ideal", "sampled"])
def test_a_law_with_e3_down_flies_the_same_physical_starts(plant):
    """A controller and its mirror image end in the same physical states, each given in its own frame."""
    laws = [Controller(name="up", function=hover), Controller(name="down", function=mirrored, e3="down")]
    starts = random_starts(3, 2)
    result = compare(VEHICLE, laws, starts, 1.0, plant=plant, workers=1).ensembles
    up, down = result["up"], result["down"]
    np.testing.assert_allclose(down.starts.packed() * FLIP_PACKED, starts.packed(), atol=1e-14)
    np.testing.assert_allclose(down.final.packed() * FLIP_PACKED, up.final.packed(), atol=1e-9)
    assert np.max(np.abs(down.final.packed() - up.final.packed())) > 0.1  # negative control: unturned they differ
    for name in ("excursion", "effort", "peak_force"):
        np.testing.assert_allclose(getattr(down, name), getattr(up, name), rtol=1e-9)
    single = fp.simulate(VEHICLE, laws[1], starts[2].flipped(), 1.0, plant=plant if plant == "ideal" else
                         plant.replace(seed=plant.seed + 2))  # fmt: skip
    np.testing.assert_allclose(single.flipped().states.packed()[-1], up.final.packed()[2], atol=1e-9)


def test_a_comparison_as_arrays_has_laws_and_runs():
    laws = [Controller(name=name, function=hover, rate=50.0) for name in ("a", "b")]
    result = compare(VEHICLE, laws, random_starts(3, 1), 1.0, plant="ideal")
    data = result.to_xarray()
    assert dict(data.sizes) == {"law": 2, "run": 3}
    np.testing.assert_array_equal(data["excursion"].sel(law="b"), result.ensembles["b"].excursion)
    assert len(data.to_dataframe()) == 6


def test_a_ladder_as_arrays_has_rungs_laws_and_runs():
    laws = [Controller(name=name, function=hover, rate=50.0) for name in ("a", "b")]
    result = ladder(VEHICLE, laws, random_starts(3, 1), 1.0, rungs={"rotors": "rotors", "ideal wrench": "ideal"})
    data = result.to_xarray()
    assert dict(data.sizes) == {"rung": 2, "law": 2, "run": 3}
    expected = result.rungs["ideal wrench"].ensembles["b"].excursion
    np.testing.assert_array_equal(data["excursion"].sel(rung="ideal wrench", law="b"), expected)
    assert len(data.to_dataframe()) == 12


def test_kernels_are_compiled_ahead_of_the_flights_but_not_far_ahead(monkeypatch):
    """Those compiled far ahead would have left the cache, which holds 64, before they fly."""
    module, events = sys.modules["flypend.studies.compare"], []
    monkeypatch.setattr(module, "kernel_of", lambda flight: events.append(("compile", flight.duration)))
    monkeypatch.setattr(module, "fly_many", lambda flight, **_: events.append(("fly", flight.duration)))
    (flight,) = module.flights_of(VEHICLE, [inverted()], random_starts(2, 1), 1.0).values()
    times = [float(k) for k in range(1, 11)]
    module.fly_each({str(k): flight.replace(duration=k) for k in times}, 1, lambda *_: None)
    for kind in ("compile", "fly"):
        assert [duration for what, duration in events if what == kind] == times
    for k in times:
        assert events.index(("compile", k)) < events.index(("fly", k))
        if k > module.AHEAD:
            assert events.index(("compile", k)) > events.index(("fly", k - module.AHEAD))


def test_a_law_that_returns_no_wrench_is_refused_before_any_flight():
    told = []
    broken = Law(name="broken", e3="up", control=lambda t, state, vehicle, gains: "no wrench")
    with pytest.raises(fp.InputError, match="it returns str"):
        compare(VEHICLE, [inverted(), broken], random_starts(2, 1), 1.0, progress=lambda *now: told.append(now))
    assert not told


def test_names_are_made_unique_and_progress_names_the_law():
    told = []
    laws = [Controller(name=name, function=hover, rate=50.0) for name in ("a", "b", "a", "a")]
    result = compare(VEHICLE, laws, random_starts(2, 1), 1.0, plant="ideal", progress=lambda *now: told.append(now))
    assert list(result.ensembles) == ["a", "b", "a (2)", "a (3)"]
    assert [row["law"] for row in result.rows()] == list(result.ensembles)
    assert [now for now in told if now[1] == 2] == [("a", 2, 2), ("b", 2, 2), ("a (2)", 2, 2), ("a (3)", 2, 2)]


def made(success, law="a", **columns):
    """An ensemble of constructed results."""
    n = len(success)
    blank = {entry.name: np.zeros(n) for entry in dataclasses.fields(Metrics)}
    blank |= {"success": np.array(success, dtype=bool), "cause": np.where(success, "", "rod")}
    state = fp.State(y=np.tile([0.0, 0, 1], (n, 1)))
    return Ensemble(starts=state, final=state, law=law, vehicle=VEHICLE, e3="up", **(blank | columns))


def test_a_row_tells_the_numbers_of_its_ensemble():
    causes = np.array(["", "rod", "", "diverged", "", "rod", "", "", "", ""])
    settling = np.where(causes == "", np.arange(10.0), np.nan)
    excursion = np.array([1.0] * 9 + [7.0])
    result = made(
        causes == "",
        cause=causes,
        settling=settling,
        excursion=excursion,
        effort=np.arange(1.0, 11.0),
        peak_force=np.arange(10.0),
    )
    low, high = wilson(7, 10)
    assert summary(result) == {
        "runs": 10, "successes": 7, "success": 0.7, "wilson_low": low, "wilson_high": high,
        "settling_p50": 6.0, "settling_p95": pytest.approx(np.percentile([0, 2, 4, 6, 7, 8, 9], 95)),
        "excursion_p50": 1.0, "excursion_p95": pytest.approx(np.percentile(excursion, 95)), "excursion_max": 7.0,
        "effort_p50": 5.5, "peak_force_max": 9.0, "causes": {"diverged": 1, "rod": 2},
        "lowest_p5": 0.0, "box_x_p95": 0.0, "box_y_p95": 0.0, "box_z_p95": 0.0,
    }  # fmt: skip
    assert Comparison({"it": result}).rows() == [{"law": "it", **summary(result)}]


# Laws by name ---------------------------------------------------------------------------------------------------------

TILTED = fp.State(y=(0.6, 0.0, 0.8), omega=(0.1, 0.2, 0.3))

KINDS = {
    "A_LAW": """
A_LAW = fp.Law(name="mine", e3="up", control=lambda t, s, vehicle, k: fp.Wrench(k.f * vehicle.weight, 0 * s.omega),
               gains={"f": 2.0})
""",
    "A_CONTROLLER": """
A_CONTROLLER = fp.laws.Controller(name="mine", function=lambda t, s: fp.Wrench(2 * WEIGHT, np.zeros(3)))
""",
    "maker": """
def maker(factor=2.0, **more):
    def control(t, state, vehicle, gains):
        return fp.Wrench(factor * vehicle.weight, 0 * state.omega)
    return fp.Law(name="mine", e3="up", control=control)
""",
    "symbolic": """
def symbolic(t, state, vehicle, gains):
    return fp.Wrench(2 * vehicle.weight, 0 * state.omega)
""",
    "plain": """
def plain(t, state):
    assert isinstance(t, float) and isinstance(state.omega, np.ndarray)
    return fp.Wrench(2 * WEIGHT, np.zeros(3))
""",
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder to stand in, whose modules are forgotten afterwards."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    known = set(sys.modules)
    yield tmp_path
    for name in set(sys.modules) - known:
        if name.startswith("law_of_"):
            del sys.modules[name]


@pytest.fixture
def write(folder):
    """Write a module of one's own, with flypend and NumPy at hand."""

    def written(name, text):
        (folder / f"{name}.py").write_text(
            f"import numpy as np\nimport flypend as fp\nWEIGHT = {VEHICLE.weight!r}\n{text}", encoding="utf-8"
        )

    return written


def test_laws_of_the_package_are_known_by_name():
    for name in fp.laws.law_names():
        law = law_named(name)
        assert (law.name, type(law)) == (name, Law)


def test_detuned_is_the_inverted_law_with_other_gains():
    bound, own = law_named("detuned").bind(VEHICLE), inverted().bind(VEHICLE)
    assert law_named("detuned").name == "detuned"
    differing = {name for name in own.gains if own.gains[name] != bound.gains[name]}
    assert {"attitude_bandwidth", "rate_feedforward"} <= differing
    assert bound.gains["attitude_bandwidth"] < 0.7 * own.gains["attitude_bandwidth"]
    assert bound.gains["rate_feedforward"] == 0


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("where", ["here", "on the path"])
def test_laws_of_ones_own_of_every_kind(write, folder, monkeypatch, tmp_path_factory, name, where):
    """All say the same: twice the weight along z; so all accelerate alike."""
    module = f"law_of_{name.lower()}_{where.replace(' ', '_')}"
    write(module, KINDS[name])
    if where == "on the path":
        monkeypatch.syspath_prepend(str(folder))
        monkeypatch.chdir(tmp_path_factory.mktemp("elsewhere"))
    law = law_named(f"{module}:{name}")
    assert isinstance(law, Controller if name in ("A_CONTROLLER", "plain") else Law)
    assert law.name == (name if name in ("symbolic", "plain") else "mine")
    assert law.e3 == "up"
    run = fp.simulate(VEHICLE, law, TILTED, 0.02, plant="ideal")
    np.testing.assert_allclose(run.thrust[1:], 2 * VEHICLE.weight, rtol=1e-12)  # rotors start at their least force
    np.testing.assert_allclose(run.moment, 0, atol=1e-15)


def test_a_law_in_a_package_and_a_factory_of_flypend(write, folder):
    (folder / "law_of_mine").mkdir()
    write("law_of_mine/inner", KINDS["symbolic"])
    assert law_named("law_of_mine.inner:symbolic").name == "symbolic"
    assert law_named("flypend.laws:inverted").name == "inverted"
    assert law_named("flypend.laws:corrected").e3 == "down"


def test_a_plain_callable_is_sampled_at_500_hz(write):
    write("law_of_rate", KINDS["plain"])
    assert law_named("law_of_rate:plain").rate == 500.0


WRONG = """
number = 3.0
def none(): return 3.0
def one(a): return a
def three(a, b, c): return a
def five(a, b, c, d, e): return a
"""


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("invertd", "expected one of .*, detuned, plan, nmpc, got 'invertd' .did you mean 'inverted'.."),
        ("", "expected one of .*, got ''"),
        ("law_of_nobody:law", "can be imported.*law_of_nobody"),
        ("law_of_wrongs:nothing", "expected one of none, one, three, five, got 'nothing'"),
        ("law_of_wrongs:", "file.py:function or module:function"),
        (":number", "file.py:function or module:function"),
        (":", "file.py:function or module:function"),
        ("..law_of_wrongs:number", "can be imported"),
        ("law_of_wrongs:number:number", "can be imported"),
        ("law_of_wrongs:number", "a Law, a Controller, a function that makes one.*number"),
        ("law_of_wrongs:none", "a Law, a Controller, a function"),
        ("law_of_wrongs:one", r"a function of \(t, state, vehicle, .*got one of \(a"),
        ("law_of_wrongs:three", r"a function of \(t, state, vehicle, .*got three of \(a"),
        ("law_of_wrongs:five", r"a function of \(t, state, vehicle, .*got five of \(a"),
        ("law_of_wrongs:np", "a Law, a Controller, a function"),
        ("builtins:type", "a Law, a Controller, a function"),  # has no signature
    ],
)
def test_a_law_that_is_none_is_told_in_one_line(write, name, words):
    write("law_of_wrongs", WRONG)
    with pytest.raises(fp.InputError, match=words) as error:
        law_named(name)
    assert error.value.field == "--law"
    assert "\n" not in str(error.value)


# The ladder -----------------------------------------------------------------------------------------------------------

CLIMBED = ("ideal wrench", "lag 20 ms", "delay 15 ms")


@pytest.fixture(scope="module")
def climbed():
    """Three rungs, four starts, three laws; the inverted law settles in less than 5 s from these starts."""
    told = []
    laws = [law_named(name) for name in ("inverted", "corrected", "detuned")]
    rungs = {name: RUNGS[name] for name in CLIMBED}
    result = ladder(
        VEHICLE, laws, random_starts(4, 1), 6.0, rungs=rungs, workers=1, progress=lambda *now: told.append(now)
    )
    return result, told


def test_the_inverted_law_stands_on_every_rung_and_the_controls_on_none(climbed):
    result, _ = climbed
    for comparison in result.rungs.values():
        assert [row["successes"] for row in comparison.rows()] == [4, 0, 0]
        # The law of the paper, corrected, hangs the rod; the detuned one loses it.
        assert all(row["causes"] == {"rod": 4} for row in comparison.rows()[1:])
        assert comparison.ensembles["inverted"].excursion.max() < 3  # m
        assert comparison.ensembles["corrected"].excursion.min() > 50  # m: it falls meanwhile
    assert result.broken("inverted") == []
    assert result.broken("corrected") == result.broken("detuned") == list(CLIMBED)


def test_the_ladder_names_what_it_flies(climbed):
    result, told = climbed
    assert list(result.rungs) == list(CLIMBED)
    # On a slow machine, flights are told of before they end, too.
    assert [now for now in told if now[1] == 4] == [
        (f"flying {law} on {rung}", 4, 4) for rung in CLIMBED for law in ("inverted", "corrected", "detuned")
    ]


def test_all_rungs_and_laws_have_the_same_starts_and_their_own_plant(climbed):
    result, _ = climbed
    finals = []
    for comparison in result.rungs.values():
        for ensemble in comparison.ensembles.values():
            physical = ensemble.starts if ensemble.law != "corrected" else ensemble.starts.flipped()
            np.testing.assert_allclose(physical.packed(), random_starts(4, 1).packed(), atol=1e-14)
        finals.append(comparison.ensembles["inverted"].excursion)
    assert len(np.unique(np.round(finals, 6), axis=0)) == 3


def test_the_rungs_are_those_promised():
    """Limits alone, lag on top of them, and everything else on top of the plant "rotors", one at a time."""
    rotors = Plant()
    assert RUNGS["ideal wrench"] == fp.Ideal()
    assert RUNGS["limits"] == Plant(lag=0.0)
    assert [RUNGS[f"lag {ms} ms"].lag for ms in (10, 20, 30, 40)] == [0.01, 0.02, 0.03, 0.04]
    assert [RUNGS[f"{rate} Hz"].rate for rate in (200, 100, 50)] == [200, 100, 50]
    assert [RUNGS[f"delay {ms} ms"].delay for ms in (5, 15, 30)] == [0.005, 0.015, 0.03]
    assert RUNGS["noise"].noise.x > 0
    for sign, factor in (("+", 1.1), ("-", 0.9)):
        assert RUNGS[f"mass {sign}10 %"].mismatch == {"mass": factor, "bob_mass": factor}
        assert RUNGS[f"inertia {sign}10 %"].mismatch == {"inertia": factor}
    assert np.linalg.norm(RUNGS["pivot offset 5 cm"].pivot_offset) == 0.05
    assert RUNGS["MuJoCo"] == Plant(engine="mujoco")
    for name, plant in RUNGS.items():
        if name not in ("ideal wrench", "limits", "MuJoCo"):
            changed = [e.name for e in dataclasses.fields(Plant) if getattr(plant, e.name) != getattr(rotors, e.name)]
            assert len(changed) == 1, name


@pytest.mark.parametrize("scale", [1.0, 0.8])
def test_rungs_of_the_joint_are_sized_by_the_rod(scale):
    """A hanging rod swings with the damping ratio that the rung has; dry friction is a share of m g l."""
    written = fp.vehicle("hummingbird").replace(thrust_scale=scale)
    found, vehicle = rungs_for(written), written.commanded()  # as a flight has it
    world = found["viscous friction"].true_vehicle(vehicle)
    # m l² θ̈ + c θ̇ + m g l θ = 0 with the vehicle held: c = 2 ζ m l √(g l).
    ratio = world.pivot_damping / (2 * vehicle.m * vehicle.l**2) / np.sqrt(vehicle.g / vehicle.l)
    assert ratio == pytest.approx(0.02)
    dry = found["dry friction"].true_vehicle(vehicle)
    assert dry.pivot_friction == pytest.approx(0.002 * vehicle.m * vehicle.g * vehicle.l)
    assert found["rod spin 10 turns/s"].true_vehicle(vehicle).rod_spin == pytest.approx(20 * np.pi)
    both = found["viscous friction, dry friction, rod spin 10 turns/s, rod +10 %"].true_vehicle(vehicle)
    assert (both.pivot_damping, both.pivot_friction) == (world.pivot_damping, dry.pivot_friction)
    assert not any("spin 10" in name for name in rungs_for(fp.vehicle("hehn2011")))  # a point mass has no spin


def test_a_joint_is_worse_by_what_the_plant_adds():
    vehicle = fp.vehicle("hummingbird").replace(pivot_damping=1e-3, pivot_friction=2e-4, rod_spin=5.0)
    worse = Plant(pivot_damping=2e-3, pivot_friction=1e-4, rod_spin=-3.0).true_vehicle(vehicle)
    assert worse == vehicle.replace(pivot_damping=3e-3, pivot_friction=2e-4 + 1e-4, rod_spin=2.0)
    assert Plant().true_vehicle(vehicle) == vehicle
    with pytest.raises(fp.InputError, match="rod_spin_inertia"):
        Plant(rod_spin=1.0).true_vehicle(fp.vehicle("hehn2011"))
    with pytest.raises(fp.InputError, match="friction that takes a millisecond"):
        Plant(pivot_friction=1.0).true_vehicle(vehicle)
    with pytest.raises(fp.InputError, match=r"plant\.pivot_damping"):
        Plant(pivot_damping=-1.0)


def test_rungs_of_a_vehicle_take_its_own_numbers():
    found = rungs_for(VEHICLE)
    assert list(found)[: len(RUNGS)] == list(RUNGS)
    assert found["one rotor -20 %"].strength == (1.0, 1.0, 1.0, 0.8)
    assert found["ground one radius below"].ground == -VEHICLE.body.disc_radius
    for name in ("rotor_drag", "inflow", "lift", "body_drag"):
        assert found[name.replace("_", " ")] == Plant(air=(name,))
    for rung in found.values():
        if rung != fp.Ideal():
            rung.true_vehicle(VEHICLE)  # raises if the vehicle lacks something
    bare = rungs_for(VEHICLE.replace(air=None, body=None))
    assert not {"air", "rotor drag", "ground one radius below"} & bare.keys()
    assert rungs_for(fp.vehicle("nayak2018")).keys() <= found.keys()


def test_rungs_together_have_all_their_departures():
    rungs = rungs_for(VEHICLE)
    found = rung_named("noise, mass +10 %, rod +10 %,delay 15 ms, air", rungs)
    expected = RUNGS["noise"].replace(
        mismatch={"mass": 1.1, "bob_mass": 1.1, "rod_length": 1.1}, delay=0.015, air=("all",)
    )
    assert found == expected
    assert rung_named("noise", rungs) is rungs["noise"]
    assert rungs["lag 40 ms, delay 15 ms, 100 Hz"] == Plant(lag=0.04, delay=0.015, rate=100.0)
    for names, words in [
        ("lag 10 ms, lag 20 ms", "expected rungs that change different numbers, got lag twice"),
        ("mass +10 %, mass -10 %", "expected rungs that change different numbers, got mismatch twice"),
        ("ideal wrench, noise", "expected rungs with numbers, got 'ideal wrench'"),
        ("noise, delai 15 ms", r"expected one of .*, got 'delai 15 ms' \(did you mean 'delay 15 ms'\?\)"),
    ]:
        with pytest.raises(fp.InputError, match=rf"^--rung: {words}"):
            rung_named(names, rungs)


def test_broken_is_below_the_share():
    rates = {"all": 10, "nine": 9, "eight": 8, "none": 0}
    result = Ladder({rung: Comparison({"a": made([True] * n + [False] * (10 - n))}) for rung, n in rates.items()})
    assert result.broken("a") == ["eight", "none"]
    assert result.broken("a", below=0.95) == ["nine", "eight", "none"]
    assert result.broken("a", below=0.0) == []


# Tables and reports ---------------------------------------------------------------------------------------------------


def wide(law, rate, n=2000):
    """An ensemble whose numbers take all the place they can: four digits of runs, every cause, far flights."""
    rng = np.random.default_rng(8)
    success = np.arange(n) < rate * n
    causes = rng.choice(["rod", "axis", "position", "diverged", "singular"], n)
    return made(
        success,
        law,
        cause=np.where(success, "", causes),
        settling=np.where(success, rng.uniform(5, 9.99, n), np.nan),
        excursion=rng.uniform(10, 99_999, n),
        effort=rng.uniform(1, 1.2, n),
        peak_force=rng.uniform(3000, 3500, n),
    )


RATES = {
    "inverted": 0.9995,
    "lqr": 0.26,
    "corrected": 0.0,
    "detuned": 0.517,
    "a_law_with_a_long_name": 0.9,
    "a[/b]|c": 1,
}


@pytest.fixture(scope="module")
def wides():
    return Comparison({name: wide(name, rate) for name, rate in RATES.items()})


def printed(table):
    out = io.StringIO()
    Console(file=out, width=80, color_system=None).print(table)
    lines = out.getvalue().splitlines()
    assert "…" not in out.getvalue()
    assert all(len(line) <= 80 for line in lines)
    return lines


def test_a_comparison_fits_80_columns_with_nothing_cut_off(wides):
    lines = printed(comparison_table(wides))
    text = " ".join(" ".join(lines).split())
    for name in ("inverted", "lqr", "corrected", "detuned", "a[/b]|c"):
        assert any(line.split()[:2] == [name, "2000"] for line in lines), name
    assert "99.95 (99.7-100.0)" in text
    assert "0 (0.0-0.2)" in text
    assert " -/- " in text  # of nothing there is no median
    assert "nan" not in text
    corrected = summary(wides.ensembles["corrected"])
    assert sum(corrected["causes"].values()) == 2000
    assert "corrected: " + ", ".join(f"{cause} {n}" for cause, n in corrected["causes"].items()) in text
    assert "a[/b]|c: " not in text  # it has not failed


def test_what_is_printed_are_the_numbers():
    result = made(
        [True] * 3 + [False],
        settling=np.array([1.234, 2.0, 3.0, np.nan]),
        excursion=np.array([0.1234, 0.2, 0.3, 1234.5]),
        effort=np.full(4, 1.0049),
        peak_force=np.full(4, 3.4567),
    )
    lines = printed(comparison_table(Comparison({"it": result})))
    assert next(line for line in lines if line.split()[:1] == ["law"]).split()[-3:] == ["effort", "peak", "N"]
    line = next(line for line in lines if line.split()[:1] == ["it"])
    assert line.split() == ["it", "4", "75", "(30.1-95.4)", "2/2.9", "0.25/1049", "1", "3.46"]


@pytest.mark.parametrize("count", [1, 2, 4])
def test_a_ladder_fits_80_columns_with_nothing_cut_off(wides, count):
    chosen = dict(list(wides.ensembles.items())[:count])
    result = Ladder(dict.fromkeys(RUNGS, Comparison(chosen)))
    lines = printed(ladder_table(result))
    text = " ".join(" ".join(lines).split())
    for name in chosen:
        assert name in text
    assert "inverted falls below 90 % on: none" in text
    assert count == 1 or "lqr falls below 90 % on: all" in text
    assert sum("100.0 %," in line for line in lines) == len(RUNGS)


def test_a_ladder_names_the_rungs_that_break(wides):
    good, bad = Comparison({"a[/b]|c": made([True])}), Comparison({"a[/b]|c": made([False])})
    result = Ladder({"one": good, "two": bad, "three": bad})
    text = " ".join(" ".join(printed(ladder_table(result))).split())
    assert text.endswith("a[/b]|c falls below 90 % on: two, three")
    assert ladder_rows(result) == [["one", "100.0 %, 0 m"], ["two", "0.0 %, 0 m"], ["three", "0.0 %, 0 m"]]


def test_a_tracking_table_fits_80_columns_and_says_who_fell():
    rows = [
        Tracking("inverted", "circle R = 0.1 m", True, 0.01234, 0.0206, "error about 0.1"),
        Tracking("lqr", "hover", False, math.nan, math.nan, "offset about 0.05"),
    ]
    lines = printed(tracking_table(rows))
    cells = [re.split(r"\s{2,}", line.strip()) for line in lines]
    assert ["circle R = 0.1 m", "inverted", "yes", "0.0123", "0.0206", "error about 0.1"] in cells
    assert ["hover", "lqr", "no", "-", "-", "offset about 0.05"] in cells


def is_a_table(lines):
    """A Markdown table: head, rule and rows, with the same number of cells in each."""
    widths = {len(re.split(r"(?<!\\)\|", line)) for line in lines}
    assert len(widths) == 1
    assert all(line.startswith("|") and line.endswith("|") for line in lines)
    assert re.fullmatch(r"\|(---\|)+", lines[1])
    return widths.pop() - 2


def test_markdown_is_well_formed(wides):
    lines = comparison_markdown(wides).splitlines()
    assert is_a_table(lines) == 8
    assert len(lines) == 2 + len(RATES)
    assert lines[-1].startswith(r"| a[/b]\|c | 2000 | 100 (")
    assert "| diverged" in lines[3] or "| axis" in lines[3]


def test_a_report_of_a_comparison_is_whole(wides, tmp_path):
    settings = {"laws": list(RATES), "seed": 1}
    write_comparison(wides, settings, tmp_path / "out")
    names = ["comparison.pdf", "comparison.png", "out", "report.json", "report.md"]
    assert sorted(path.name for path in tmp_path.rglob("*")) == names
    report = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert report["settings"] == settings
    assert report["flypend"] == fp.__version__
    for told, row in zip(report["laws"], wides.rows(), strict=True):
        assert told == {k: None if isinstance(v, float) and math.isnan(v) else v for k, v in row.items()}
    assert report["laws"][2]["settling_p50"] is None  # JSON has no NaN
    text = (tmp_path / "out" / "report.md").read_text(encoding="utf-8")
    assert text.startswith("# Laws compared\n")
    assert "seed: 1" in text
    assert comparison_markdown(wides) in text
    assert (tmp_path / "out" / "comparison.png").read_bytes().startswith(b"\x89PNG")


def test_a_report_of_a_ladder_is_whole(climbed, tmp_path):
    result, _ = climbed
    write_ladder(result, {"runs": 4}, tmp_path / "out")
    names = ["ladder.pdf", "ladder.png", "out", "report.json", "report.md"]
    assert sorted(path.name for path in tmp_path.rglob("*")) == names
    report = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert list(report["rungs"]) == list(CLIMBED)
    for rung, comparison in result.rungs.items():
        for row in comparison.rows():
            assert report["rungs"][rung][row["law"]]["successes"] == row["successes"]
    lines = (tmp_path / "out" / "report.md").read_text(encoding="utf-8").splitlines()
    assert is_a_table([line for line in lines if line.startswith("|")]) == 4
    assert "- inverted: none" in lines
    assert "- corrected: all" in lines
    assert (tmp_path / "out" / "ladder.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("kind", ["comparison", "ladder"])
@pytest.mark.parametrize("there", [True, False])
def test_a_report_that_fails_leaves_nothing_new(wides, tmp_path, monkeypatch, kind, there):
    def fail(*_):
        raise RuntimeError("out of ink")

    out = tmp_path / "out"
    if there:
        out.mkdir()
        (out / "report.md").write_text("old")
    monkeypatch.setattr(files, "save_figure", fail)
    write, result = (write_comparison, wides) if kind == "comparison" else (write_ladder, Ladder({"one": wides}))
    with pytest.raises(RuntimeError, match="out of ink"):
        write(result, {}, out)
    left = {path.name: path.read_text() for path in tmp_path.rglob("*") if path.is_file()}
    assert left == ({"report.md": "old"} if there else {})
    assert [path.name for path in tmp_path.iterdir()] == (["out"] if there else [])


def test_a_report_where_a_file_stands_is_refused(wides, tmp_path):
    (tmp_path / "out").write_text("mine")
    with pytest.raises(fp.InputError, match="expected a folder, got a file"):
        write_comparison(wides, {}, tmp_path / "out")
    assert (tmp_path / "out").read_text() == "mine"


# Pictures -------------------------------------------------------------------------------------------------------------


def test_the_figure_of_a_comparison_counts_those_that_stand():
    """Of ten runs, eight stand: from 0, the curve rises by 10 % at each of their times, and goes on at 80 %."""
    times = np.array([3.0, 1.0, 2.0, 4.0, 5.0, 6.0, 7.0, 8.0, np.nan, np.nan])
    result = made(np.isfinite(times), settling=times, excursion=np.nan_to_num(times, nan=0.1) / 10)
    nobody = made([False] * 3, "b", settling=np.full(3, np.nan), excursion=np.ones(3))
    figure = comparison_figure(Comparison({"a": result, "b": nobody}))
    figure.canvas.draw()
    for axes, unit in zip(figure.axes, (1.0, 0.1), strict=True):
        one, none = axes.get_lines()[:2]
        x, y = np.array(one.get_data())
        right = axes.get_xlim()[1]
        np.testing.assert_allclose(x, [*(unit * np.arange(9)), right])
        np.testing.assert_allclose(y, [*(10 * np.arange(9)), 80])
        np.testing.assert_allclose(none.get_data(), [[0, right], [0, 0]])  # who does not stand is counted by no step
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == ["a: 80.0 % of 10", "b: 0.0 % of 3"]


def test_the_figure_of_a_comparison_in_which_nobody_stands(tmp_path):
    nobody = made([False] * 3, settling=np.full(3, np.nan), excursion=np.ones(3))
    figures.save_figure(comparison_figure(Comparison({"b": nobody})), tmp_path / "a.png")


def test_the_figure_of_a_ladder_shows_rates_with_their_intervals():
    rates = {"one": 10, "two": 7, "three": 0}
    excursion = np.arange(1.0, 11.0)
    result = Ladder({r: Comparison({"a": made(np.arange(10) < n, excursion=excursion)}) for r, n in rates.items()})
    figure = ladder_figure(result)
    figure.canvas.draw()
    above, below = figure.axes
    (container,) = above.containers
    np.testing.assert_allclose(container[0].get_ydata(), [100, 70, 0])
    ends = np.array([segment[:, 1] for segment in container[2][0].get_segments()])
    np.testing.assert_allclose(ends, [[100 * end for end in wilson(n, 10)] for n in rates.values()], atol=1e-9)
    np.testing.assert_allclose(below.get_lines()[0].get_ydata(), np.percentile(excursion, 95))
    assert [text.get_text() for text in below.get_xticklabels()] == list(rates)


# The set-up of Hehn and D'Andrea --------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def tracked():
    return {row.case: row for row in hehn2011(("inverted",))}


def test_the_inverted_law_does_better_than_what_was_published(tracked):
    assert list(tracked) == list(circles.CASES) == ["hover", "circle R = 0.1 m", "circle R = 0.5 m"]
    assert all(row.stood and row.law == "inverted" for row in tracked.values())
    assert tracked["hover"].offset < 0.05  # m, published
    assert tracked["circle R = 0.1 m"].error < 0.1
    for row in tracked.values():
        assert 0 < row.offset <= row.error < 0.1
        assert row.error > 1e-3  # noise and 2 % of model error are there
    assert [tracked[case].published for case in tracked] == ["offset about 0.05", "error about 0.1", "–"]


def test_the_setup_is_theirs():
    assert (circles.PLANT.interface, circles.PLANT.rate, circles.PLANT.delay) == ("rates", 50.0, 0.03)
    assert circles.PLANT.noise.x > 0
    time = np.linspace(0, 2 * np.pi / circles.RATE, 50)
    for case, radius in (("circle R = 0.1 m", 0.1), ("circle R = 0.5 m", 0.5), ("hover", 0.0)):
        path = fp.laws.references.sample(circles.CASES[case], time)
        np.testing.assert_allclose(np.hypot(path[:, 0], path[:, 1]), radius, atol=1e-12)


def only_hover(monkeypatch, **plant):
    monkeypatch.setattr(circles, "CASES", {"hover": circles.CASES["hover"]})
    monkeypatch.setattr(circles, "PLANT", circles.PLANT.replace(**plant))


def test_an_offset_that_is_there_is_told(monkeypatch):
    """Negative control: a wind that the law does not observe pushes it off."""
    only_hover(monkeypatch, wind=fp.plants.Wind(on_vehicle=(0.4, 0, 0)), noise=None)
    monkeypatch.setattr(circles, "_law", lambda _, reference: inverted(reference=reference, observer=0.0))
    (row,) = hehn2011(("inverted",))
    assert row.offset > 0.05
    assert row.error == pytest.approx(row.offset, rel=0.1)


def test_a_run_that_diverges_is_told_without_numbers(monkeypatch):
    only_hover(monkeypatch, wind=fp.plants.Wind(on_vehicle=(1e8, 0, 0)))
    (row,) = hehn2011(("inverted",))
    assert not row.stood
    assert math.isnan(row.offset)
    assert math.isnan(row.error)


@pytest.mark.parametrize(
    ("name", "words"),
    [("corrected", "a law that follows a reference, got 'corrected'"), ("invrted", "did you mean 'inverted'")],
)
def test_only_laws_of_the_package_that_follow_a_reference_fly_there(name, words):
    with pytest.raises(fp.InputError, match=words) as error:
        hehn2011((name,))
    assert error.value.field == "law"
