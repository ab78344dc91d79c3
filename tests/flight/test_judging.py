"""The kernel of the ideal plant looks at few of the judged times, and finds what a look at all of them finds."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.flight.criterion import Criterion, lean
from flypend.flight.kernels import ideal_kernel
from flypend.flight.kernels.ideal import Moments
from flypend.flight.request import Tolerances
from flypend.laws import references
from flypend.plants import Ideal
from flypend.plants.loop import Loop
from tests.few import each_once

CORRECTED = {"vehicle": "nayak2018", "law": fp.laws.corrected(), "duration": 6.5}
WIDE = Criterion(target="e3", position=100.0, rod=0.1, axis=0.1)


def hopping(t):
    """A reference with jumps and kinks: to and fro between two places every 0.7 s, and along a zigzag."""
    return ca.vertcat(0.1 * ca.sign(ca.sin(2 * np.pi / 1.4 * t)), 0.02 * ca.fabs(ca.sin(2 * t)), 0 * t)


def inverted(duration, reference=None, vehicle="hehn2011", **gains):
    return {"vehicle": vehicle, "law": fp.laws.inverted(reference=reference, **gains), "duration": duration}


CASES = {
    "inverted": {**inverted(2.5)},
    "inverted, to the end": {**inverted(10.0)},
    "inverted, tight": {**inverted(6.0), "criterion": Criterion(rod=0.004, axis=0.003, position=0.02)},
    "inverted, loose": {**inverted(4.0), "rtol": 1e-3},
    "inverted, 1e-4": {**inverted(5.0), "rtol": 1e-4},
    "inverted, accurate": {**inverted(3.0), "rtol": 1e-9},
    "crazyflie, every 37 ms": {**inverted(3.0, vehicle="crazyflie"), "period": 0.037},
    "every millisecond": {**inverted(2.5), "period": 1e-3},
    "at few times": {**inverted(4.0), "grid": np.array([0.3, 0.31, 1.0, 2.9, 3.3, 3.9])},
    # The start is out, and the place farthest away: once it is judged, once not.
    "at the start and the end": {**inverted(4.0), "grid": np.array([0.0, 3.9]), "away": 2.0},
    "in the first step": {**inverted(4.0), "grid": np.array([1e-4, 1e-3, 3.9]), "away": 2.0},
    "on the way alone": {
        **inverted(4.0),
        "criterion": Criterion(position=np.inf, rod=0.2, axis=0.2),
        "grid": np.array([2.5]),
        "away": 20.0,
    },
    "corrected": {**CORRECTED, "criterion": WIDE},
    "corrected, anywhere": {**CORRECTED, "criterion": Criterion(target="e3", position=np.inf)},
    "printed": {**CORRECTED, "law": fp.laws.printed(), "duration": 1.5, "criterion": WIDE},
    "circle": {**inverted(4.0, references.circle(0.4, 1.2))},
    # The lean that an eight requires has a kink wherever its acceleration passes through zero.
    "eight": {**inverted(3.0, references.lemniscate(0.3, 1.5)), "criterion": Criterion(rod=0.1, axis=0.1)},
    "jumps": {**inverted(4.0, hopping), "criterion": Criterion(rod=0.3, axis=0.5)},
}


def targets(law, vehicle, times):
    """Reference positions (n, 3) and leans (n,) at `times`."""
    if law.reference is None:
        return np.zeros((len(times), 3)), 0.0
    t = ca.SX.sym("t")
    velocity = ca.jacobian(law.reference(t), t)
    x = references.sample(law.reference, times)
    if not ca.depends_on(velocity, t):
        return x, 0.0
    acceleration = ca.Function("a", [t], [ca.densify(ca.jacobian(velocity, t))])
    return x, lean(np.array(acceleration(times[None])).T, vehicle.g)


def at_every_time(flown, times, law, vehicle, criterion):
    """The first five reductions (n, 5) from the states at all `times` (k,): those of `metrics`, run by run.

    The distance of a run that ends early is judged at its end as well.
    """
    s, (x_ref, moving) = flown.samples, targets(law, vehicle, times)
    distance = np.linalg.norm(s[..., :3] - x_ref, axis=-1)
    excess = criterion.excess(s[..., 18:21], s[..., [8, 11, 14]], distance, moving, law.e3)
    taken, place = ~np.isnan(s[..., 0]), np.arange(len(times))
    last = [np.max(np.where(~(part <= 0) & taken, place, -1), axis=1) for part in excess]
    after, count = np.max(last, axis=0) + 1, np.sum(taken, axis=1)
    since = np.where(after < count, times[np.minimum(after, len(times) - 1)], np.inf)
    reached = np.max(np.where(taken, distance, -np.inf), axis=1)
    at_end = np.linalg.norm(flown.final[:, :3] - targets(law, vehicle, flown.end)[0], axis=1)
    reached = np.where(flown.code == 0, reached, np.maximum(reached, at_end))
    return np.stack([since, *(np.where(one >= 0, times[one], -1.0) for one in last), reached], axis=1)


def differences(case, method, runs, seed, precision="double"):
    """(runs, runs whose times differ, successes, largest relative error of the excursion)."""
    case = {"criterion": Criterion(), "rtol": 1e-6, "period": 0.01, "away": 0.0, **case}
    vehicle, duration, criterion = fp.vehicle(case["vehicle"]), case["duration"], case["criterion"]
    law, rng = case["law"].bind(vehicle), np.random.default_rng(seed)
    grid = case.get("grid", np.linspace(0, duration, round(duration / case["period"]) + 1))
    kernel = ideal_kernel(Loop(vehicle, law, Ideal()), criterion, method=method, precision=precision)
    differ = successes = worst = 0
    for first in range(0, runs, 250):
        starts = fp.State.random(rng, min(250, runs - first)).packed() + case["away"] * np.eye(24)[0]
        flown = kernel.fly(starts, duration, Tolerances(rtol=case["rtol"]), judge_at=grid, keep_at=grid)
        every, own = at_every_time(flown, grid, law, vehicle, criterion), flown.reductions
        differ += np.sum(np.any(own[:, :4] != every[:, :4], axis=1))
        successes += np.sum((flown.code == 0) & np.all(own[:, 1:4] < duration - criterion.hold - 1e-9, axis=1))
        some = every[:, 4] > 0
        worst = max(worst, np.max(np.abs(own[some, 4] / every[some, 4] - 1), initial=0.0))
    return runs, int(differ), int(successes), worst


@pytest.mark.parametrize(("name", "method"), each_once(CASES, ("dp5", "dop853")))
def test_the_times_are_those_of_a_look_at_every_time(name, method):
    """Settling, last times out of tolerance and so verdict and cause, to the last bit."""
    runs = 16 if name == "printed" else 64
    _, differ, _, worst = differences(CASES[name], method, runs, seed=5)
    assert differ == 0
    # A quintic between steps that were allowed an error of `rtol`: most of it is a large distance passed quickly.
    assert worst < 30 * CASES[name].get("rtol", 1e-6) + 1e-9


def test_the_times_are_those_in_single_precision():
    assert differences(CASES["inverted, 1e-4"], "dp5", 64, seed=5, precision="float")[1] == 0


def test_the_cases_hold_successes_and_failures():
    """Negative control: a test in which all runs fail from the start would find no difference either."""
    found = {name: differences(CASES[name], "dp5", 64, seed=5)[2] for name in ("inverted", "corrected", "eight")}
    assert all(0 < successes < 64 for successes in found.values()), found


@pytest.mark.slow
@pytest.mark.parametrize("method", ["dp5", "dop853"])
def test_the_times_are_those_of_a_look_at_every_time_in_a_hundred_thousand_runs(method):
    """Fifty thousand runs by each method, over all cases."""
    found = {name: differences(case, method, 500 if name == "printed" else 3600, 77) for name, case in CASES.items()}
    assert sum(runs for runs, *_ in found.values()) > 50_000
    assert {name: differ for name, (_, differ, _, _) in found.items() if differ} == {}


# Where a time is among the judged ones ------------------------------------------------------------------------------


@pytest.mark.parametrize("times", [np.linspace(0, 10, 1001), np.array([0.2]), np.array([0.0]),
                                   np.cumsum(np.random.default_rng(1).exponential(size=300) ** 3)])  # fmt: skip
def test_the_table_is_never_ahead(times):
    """Entry b is a lower bound from b / rate on, rounding of single precision included."""
    moments = Moments.of(times)
    probes = np.union1d(times, np.random.default_rng(2).uniform(0, times[-1] + 1, 2000))
    for shift in (1.0, 1 - 1.2e-7, 1 + 1.2e-7):
        bins = np.minimum(np.floor(probes * moments.rate * shift), len(moments.bins) - 1).astype(int)
        assert np.all(moments.bins[bins] <= np.searchsorted(times, probes, side="right"))
    assert moments.judged[-1] == moments.kept[-1] == np.inf
    if len(times) > 500:  # on a uniform grid it is at most one place behind
        behind = np.searchsorted(times, probes, side="right") - moments.bins[bins]
        assert np.max(behind[probes <= times[-1]]) <= 1


# Forces ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", ["dp5", "dop853"])
def test_forces_are_those_of_the_whole_flight(method):
    """Against 20,000 samples: the mean square to the error of a step, the peak to what lies between two stages.

    More runs than lanes: the last one flies where another one flew.
    """
    vehicle, starts = fp.vehicle("nayak2018"), fp.State.random(np.random.default_rng(6), 40)
    options = {"plant": "ideal", "rtol": 1e-8, "method": method}
    many = fp.simulate_ensemble(vehicle, fp.laws.corrected(), starts, 6.5, workers=1, **options)
    times = np.linspace(0, 6.5, 20_001)
    for i in (0, len(starts) - 1):
        run = fp.simulate(vehicle, fp.laws.corrected(), starts[i], 6.5, plant="ideal", rtol=1e-8, times=times)
        single = fp.metrics(run)
        assert many.effort[i] == pytest.approx(single.effort, rel=1e-6)
        assert many.peak_force[i] == pytest.approx(single.peak_force, rel=1e-2)
        coarse = fp.metrics(fp.simulate(vehicle, fp.laws.corrected(), starts[i], 6.5, plant="ideal", rtol=1e-8))
        assert abs(many.effort[i] / single.effort - 1) < abs(coarse.effort / single.effort - 1)


def test_a_run_that_ends_at_its_start_has_the_forces_of_the_start():
    """Where the law is singular at once, |v_e| = 0, they are no numbers; a rod that touches at once has some."""
    vehicle, touching = fp.vehicle("hehn2011"), fp.State(y=(0.0, 1.0, 0.0), y_dot=(0.0, 0.0, -30.0))
    cases = {
        "singular": (vehicle, fp.laws.printed(), fp.State(y=(0.0, 0.0, 1.0))),
        "collided": (vehicle.replace(mount="hub"), fp.laws.inverted(), touching),
    }
    for cause, (machine, law, start) in cases.items():
        starts = fp.State.from_packed(np.tile(start.packed(), (2, 1)))
        many = fp.simulate_ensemble(machine, law, starts, 1.0, plant="ideal", workers=1)
        single = fp.metrics(fp.simulate(machine, law, start, 1.0, plant="ideal"))
        assert (many.cause[0], many.end[0], single.cause, single.end) == (cause, 0.0, cause, 0.0)
        assert many.excursion[0] == single.excursion == 0.0
        for name in ("effort", "peak_force"):
            value = getattr(single, name)
            assert np.isnan(value) == (cause == "singular")
            assert getattr(many, name)[0] == pytest.approx(value, rel=1e-12, nan_ok=True), name
