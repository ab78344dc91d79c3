"""Compiled kernels against independent integrators, and what their runs do not do to each other."""

import ctypes
import dataclasses
import operator
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.compile.llvm import jit, runge_kutta
from flypend.compile.program import interpret
from flypend.flight.criterion import Criterion
from flypend.flight.kernels import ideal_kernel, sampled_kernel
from flypend.flight.kernels.ideal import ideal_problem
from flypend.flight.request import Flight, Tolerances
from flypend.flight.sampled import fly_stepwise
from flypend.model.rod import uniform_rod
from flypend.plants import Ideal, Noise, Plant, Wind
from flypend.plants.loop import Loop
from tests.few import few, slow

NAYAK, HEHN = fp.vehicle("nayak2018"), fp.vehicle("hehn2011")
CORRECTED, INVERTED = fp.laws.corrected().bind(NAYAK), fp.laws.inverted().bind(HEHN)
DURATION = 6.5


def random_starts(runs, seed=11):
    return fp.State.random(np.random.default_rng(seed), runs).packed()


def off(states, reference):
    """Largest error of each run, relative to 1 + |entry|: positions are up to 130 m."""
    return np.max(np.abs(states - reference) / (1 + np.abs(reference)), axis=-1)


# The arbiter: heyoka's Taylor series of machine precision, from the same program -----------------------------------


@pytest.fixture(scope="module")
def arbiter():
    """`arbiter(starts, times)`: states (times, n, 24) of the corrected law, four runs at a time."""
    hy = pytest.importorskip("heyoka", reason="heyoka has wheels for x86_64 only")
    program = ideal_problem(Loop(NAYAK, CORRECTED, Ideal()), Criterion()).rates
    names = hy.make_vars(*(f"s{i}" for i in range(24)))
    operations = {"add": operator.add, "sub": operator.sub, "mul": operator.mul, "div": operator.truediv,
                  "neg": operator.neg, "sqrt": hy.sqrt}  # fmt: skip
    rates = interpret(program, [lambda _: hy.time, names.__getitem__], operations, hy.expression)[0]
    system = list(zip(names, rates, strict=True))
    lanes = 4
    integrator = hy.taylor_adaptive_batch(system, np.zeros((24, lanes)), tol=1e-15, compact_mode=True)

    def fly(starts, times):
        out = np.empty((len(times), len(starts), 24))
        for first in range(0, len(starts), lanes):
            some = starts[first : first + lanes]
            integrator.set_time(0.0)
            integrator.state[:] = np.resize(some, (lanes, 24)).T
            for i, moment in enumerate(times):
                integrator.propagate_until(float(moment))
                out[i, first : first + lanes] = integrator.state.T[: len(some)]
        return out

    return fly


def sensitivity(starts, kernel):
    """How much each run amplifies a change of its start, over some random directions."""
    rng, size = np.random.default_rng(0), 1e-7
    before = kernel.fly(starts, DURATION, Tolerances(rtol=1e-12)).final
    found = np.zeros(len(starts))
    for _ in range(8):
        moved = starts.copy()
        moved[:, 15:18] += size * rng.standard_normal((len(starts), 3))
        moved[:, 21:24] += size * np.cross(starts[:, 18:21], rng.standard_normal((len(starts), 3)))
        found = np.maximum(found, off(kernel.fly(moved, DURATION, Tolerances(rtol=1e-12)).final, before) / size)
    return found


def errors_are_inside_the_tolerance(arbiter, runs):
    starts = random_starts(runs)
    reference = arbiter(starts, [DURATION])[0]
    for method in ("dop853", "dp5"):
        kernel = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal()), method=method)
        for rtol in (1e-9, 1e-12):
            errors = off(kernel.fly(starts, DURATION, Tolerances(rtol=rtol)).final, reference)
            # Some hundred steps, each allowed `rtol`, and a loop that forgets: the median run is off by 1 to 4 rtol.
            assert np.median(errors) < 10 * rtol
            allowed = 1000 * rtol
            far = np.flatnonzero(errors > allowed)
            assert len(far) <= max(1, runs // 100)
            # The rest, 0.6 % of ten thousand, passed close to |ẏ| = 0 with a thrust axis that turns over: there a run
            # amplifies every error. 99.9 % of all runs are off by at most a hundred errors of a step, amplified.
            if len(far):
                unexplained = errors[far] > 100 * rtol * sensitivity(starts[far], kernel)
                assert np.sum(unexplained) <= runs // 1000


def test_errors_are_inside_the_tolerance(arbiter):
    errors_are_inside_the_tolerance(arbiter, 96)


@pytest.mark.slow
def test_errors_are_inside_the_tolerance_in_ten_thousand_runs(arbiter):
    errors_are_inside_the_tolerance(arbiter, 10_000)


@pytest.mark.parametrize(("method", "rtol"), [("dop853", 1e-8), ("dp5", 1e-8)])
def test_samples_between_steps_are_as_good_as_the_steps(arbiter, method, rtol):
    starts, times = random_starts(8, seed=3), np.linspace(0.05, 2.0, 37)
    reference = arbiter(starts, times).transpose(1, 0, 2)
    kernel = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal()), method=method)
    flown = kernel.fly(starts, 2.0, Tolerances(rtol=rtol), keep_at=times)
    assert flown.samples.shape == (8, 37, 24)
    # The polynomials are of order 7 and 4; that of order 4 loses a factor of ten or two in the middle of a step.
    assert np.max(off(flown.samples, reference)) < (300 if method == "dp5" else 100) * rtol


def test_a_sample_at_the_end_is_the_end():
    starts = random_starts(3)
    flown = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal())).fly(
        starts, 1.0, Tolerances(rtol=1e-9), keep_at=[0.0, 0.5, 1.0]
    )
    np.testing.assert_allclose(flown.samples[:, 0], starts, atol=1e-12)
    np.testing.assert_allclose(flown.samples[:, 2], flown.final, atol=1e-10)


@pytest.mark.parametrize(("method", "order"), [("dop853", 8), ("dp5", 5)])
def test_the_error_falls_with_the_order_of_the_method(arbiter, method, order):
    """error ~ steps^(−p): the steps grow by a factor of 1.3 (order 8) or 1.6 (order 5) for a decade of error."""
    starts, kernel = random_starts(64, seed=5), ideal_kernel(Loop(NAYAK, CORRECTED, Ideal()), method=method)
    reference = arbiter(starts, [3.0])[0]
    flown = [kernel.fly(starts, 3.0, Tolerances(rtol=10.0**decade)) for decade in range(-11, -6)]
    errors = [np.median(off(some.final, reference)) for some in flown]
    slope = np.polyfit(np.log10([np.mean(some.steps) for some in flown]), np.log10(errors), 1)[0]
    # The cautious first steps are the same for all: the more so in few steps, it looks steeper than it is.
    assert -slope == pytest.approx(order, rel=0.3)


@pytest.mark.parametrize("precision", ["double", "float"])
def test_a_float_is_a_coarse_double(precision):
    starts = random_starts(64, seed=6)
    reference = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal())).fly(starts, 2.0, Tolerances(rtol=1e-10)).final
    kernel = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal()), method="dp5", precision=precision)
    flown = kernel.fly(starts, 2.0, Tolerances(rtol=1e-4))
    assert np.all(flown.status == "completed")
    assert np.median(off(flown.final, reference)) < 1e-2


# Ends of runs, and neighbours ----------------------------------------------------------------------------------------


def explosive(vehicle):
    """A law that drives omega to infinity in finite time if it starts with ω₁ > 0, to zero if not."""

    def control(t, state, vehicle, gains):
        return fp.Wrench(vehicle.weight, ca.mtimes(ca.DM(vehicle.I), state.omega[0] * state.omega))

    return fp.Law(name="explosive", e3="up", control=control, gains={"k": 1.0}).bind(vehicle)


def test_what_becomes_of_a_lane_does_not_change_its_neighbours():
    """NaN, divergence and step limits end a run with their status; the others keep every bit."""
    law = explosive(HEHN)
    starts = random_starts(24, seed=8)
    starts[:, 15] = -np.abs(starts[:, 15]) - 0.1
    bad = starts.copy()
    bad[3, 16] = np.nan
    bad[10, 15] = 40.0
    bad[17, 0] = np.inf
    for method in ("dop853", "dp5"):
        kernel = ideal_kernel(Loop(HEHN, law, Ideal()), method=method)
        judged = partial(kernel.fly, exact=Tolerances(rtol=1e-8), judge_at=np.linspace(0, 1, 11), workers=1)
        good, mixed = (judged(some, 1.0) for some in (starts, bad))
        assert np.all(good.status == "completed")
        assert mixed.status[[3, 10, 17]].tolist() == ["singular", "diverged", "diverged"]
        assert mixed.code[3] == runge_kutta.UNDEFINED
        rest = np.delete(np.arange(24), [3, 10, 17])
        np.testing.assert_array_equal(mixed.final[rest], good.final[rest])
        np.testing.assert_array_equal(mixed.reductions[rest], good.reductions[rest])
        assert np.all(mixed.steps < 5000)


def test_a_singular_lane_ends_as_singular_and_its_neighbours_go_on():
    """The printed law meets |v_e| = 0 in all starts but those where the guard was never near."""
    law = fp.laws.printed().bind(NAYAK)
    kernel = ideal_kernel(Loop(NAYAK, law, Ideal()))
    starts = random_starts(16, seed=9)
    flown = kernel.fly(starts, 1.0, Tolerances(rtol=1e-9), workers=1)
    singular = flown.status == "singular"
    assert singular.any()
    assert np.all(flown.end[singular] < 1.0)
    for i in (int(np.argmax(singular)), int(np.argmin(singular))):
        alone = kernel.fly(starts[i : i + 1], 1.0, Tolerances(rtol=1e-9))
        np.testing.assert_array_equal(alone.final[0], flown.final[i])
        assert alone.end[0] == flown.end[i]


def test_a_run_that_needs_too_many_steps_ends(monkeypatch):
    monkeypatch.setattr("flypend.flight.request.MAX_STEPS", 20)
    flown = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal())).fly(random_starts(9), DURATION, Tolerances(rtol=1e-9))
    assert np.all(flown.code == runge_kutta.TOO_MANY)
    assert np.all(flown.steps == 20)
    assert np.all((flown.end > 0) & (flown.end < DURATION))


def test_samples_after_the_end_are_nan():
    law, starts = explosive(HEHN), random_starts(4, seed=8)
    starts[:, 15] = 20.0
    times = np.linspace(0, 1, 11)
    flown = ideal_kernel(Loop(HEHN, law, Ideal())).fly(starts, 1.0, Tolerances(rtol=1e-8), keep_at=times)
    assert np.all(flown.status == "diverged")
    for end, samples in zip(flown.end, flown.samples, strict=True):
        np.testing.assert_array_equal(np.isnan(samples).all(axis=1), times > end)
        assert np.isfinite(samples[times <= end]).all()


@pytest.mark.parametrize("method", ["dop853", "dp5"])
@pytest.mark.parametrize("rtol", [1e-4, 1e-8])
def test_a_run_is_the_same_in_any_company(method, rtol):
    """Bit by bit: alone, in a batch, in another order, on one thread or three."""
    starts = random_starts(1300, seed=4)
    kernel = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal()), method=method)
    times = np.linspace(0, 2, 9)
    together = kernel.fly(starts, 2.0, Tolerances(rtol=rtol), judge_at=times, keep_at=times, workers=3)
    one = kernel.fly(starts[::-1], 2.0, Tolerances(rtol=rtol), judge_at=times, keep_at=times, workers=1)
    for name in ("final", "end", "code", "reductions", "samples", "steps"):
        np.testing.assert_array_equal(getattr(together, name), getattr(one, name)[::-1])
    for i in (0, 7, 523, 1299):
        alone = kernel.fly(starts[i : i + 1], 2.0, Tolerances(rtol=rtol), judge_at=times, keep_at=times)
        np.testing.assert_array_equal(alone.samples[0], together.samples[i])
        np.testing.assert_array_equal(alone.reductions[0], together.reductions[i])


def test_states_that_are_kept_need_not_be_judged():
    starts, times = random_starts(20), np.linspace(0, 1, 7)
    kernel = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal()), method="dp5")
    both = kernel.fly(starts, 1.0, Tolerances(rtol=1e-6), judge_at=times, keep_at=times)
    kept = kernel.fly(starts, 1.0, Tolerances(rtol=1e-6), keep_at=times)
    assert kept.reductions is None
    np.testing.assert_array_equal(kept.samples, both.samples)


def test_what_is_kept_changes_nothing_of_how_a_run_is_judged():
    """Kept at moments of its own, some of them those at which it is judged: one flight, the same bits of both."""
    starts, judged, kept = random_starts(40), np.linspace(0, 2, 21), np.array([0.0, 0.1, 0.777, 1.3, 2.0])
    for precision, rtol in (("double", 1e-8), ("float", 1e-4)):
        kernel = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal()), method="dp5", precision=precision)
        plain = kernel.fly(starts, 2.0, Tolerances(rtol=rtol), judge_at=judged)
        both = kernel.fly(starts, 2.0, Tolerances(rtol=rtol), judge_at=judged, keep_at=kept)
        only = kernel.fly(starts, 2.0, Tolerances(rtol=rtol), keep_at=kept)
        np.testing.assert_array_equal(both.reductions, plain.reductions)
        np.testing.assert_array_equal(both.samples, only.samples)
        assert both.samples.shape == (40, 5, 24)
    # Negative control: judged where it is kept, a run is judged otherwise.
    assert np.any(kernel.fly(starts, 2.0, Tolerances(rtol=rtol), judge_at=kept).reductions != plain.reductions)


def test_what_is_kept_of_a_sampled_flight_changes_nothing_of_how_it_is_judged():
    starts, judged, kept = random_starts(12), np.arange(0, 201, 5), np.array([0, 5, 33, 200])
    kernel = sampled_kernel(Loop(HEHN, INVERTED, Plant()), Criterion())
    plain = kernel.fly(starts, 0.4, judge_at=judged)
    both = kernel.fly(starts, 0.4, judge_at=judged, keep_at=kept)
    every = kernel.fly(starts, 0.4, judge_at=(), keep_at=np.arange(201))
    np.testing.assert_array_equal(both.reductions, plain.reductions)
    np.testing.assert_array_equal(both.samples, every.samples[:, kept])


def test_other_python_threads_run_during_a_call():
    starts, ticks = random_starts(3000), []
    kernel = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal()))
    kernel.fly(starts[:8], DURATION, Tolerances(rtol=1e-9))

    def fly_all():
        kernel.fly(starts, DURATION, Tolerances(rtol=1e-11), workers=1)
        return time.perf_counter()

    with ThreadPoolExecutor(1) as pool:
        flying = pool.submit(fly_all)
        while not flying.done():
            ticks.append(time.perf_counter())
            time.sleep(1e-3)
    # It is one call: one that held the lock would let this thread run before and after.
    assert len([tick for tick in ticks if tick < flying.result()]) > 30


def test_an_interruption_leaves_the_queue_empty_and_is_raised_soon():
    starts, told = random_starts(200_000), []
    kernel = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal()))

    def interrupted(taken, runs):
        told.append((taken, runs))
        raise KeyboardInterrupt

    begin = time.perf_counter()
    kernel.fly(starts[:256], DURATION, Tolerances(rtol=1e-9))
    for_256 = time.perf_counter() - begin
    begin = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        kernel.fly(starts, DURATION, Tolerances(rtol=1e-9), progress=interrupted)
    (taken, runs) = told[0]
    assert 0 < taken < runs == 200_000
    assert time.perf_counter() - begin < 1 + for_256  # all of them would take some hundred times that


# Sampled flights: the kernel does what the flight in Python does ----------------------------------------------------

GUSTY = Wind(on_vehicle=(0.2, 0.0, 0.0), on_bob=(0.0, 0.05, 0.0), gust_on_vehicle=0.2, gust_on_bob=0.05)
NOISY = Noise(x=1e-3, x_dot=1e-2, attitude=3e-3, omega=2e-2, y=3e-3, y_dot=3e-2)
PLANTS = {
    "rotors": Plant(),
    "lag": Plant(lag=0.04, rate=250.0),
    "none": Plant(limits=False, lag=0.0, rate=500.0),  # slower, it is lost, and amplifies roundoff
    "wind": Plant(wind=Wind(on_vehicle=(0.2, 0.0, 0.0)), rate=100.0),  # nothing is drawn
    "delay": Plant(delay=0.013, rate=200.0),
    "noise": Plant(noise=NOISY, rate=200.0, seed=5),
    "gusts": Plant(wind=GUSTY, rate=200.0, seed=6),
    "knocks": Plant(wind=Wind(knock_on_vehicle=0.1, knock_on_bob=0.02, knock_period=0.1), rate=200.0, seed=7),
    "rates": Plant(interface="rates", rate=50.0, delay=0.03),
    "mismatch": Plant(mismatch={"mass": 1.1, "rod_length": 0.9, "rotor_lag": 1.2}, rate=200.0),
    "pivot": Plant(pivot_offset=(0.0, 0.01, 0.02), rate=200.0),
    "motors": Plant(spin_up=1.5, sag=0.1, strength=(1.0, 0.9, 1.1, 1.0)),
    "air": Plant(air="all", ground=-0.3, rate=200.0),
    "air, motors and the rest": Plant(
        air=("rotor_drag", "inflow"),
        spin_up=0.7,
        sag=0.05,
        interface="rates",
        rate=50.0,
        delay=0.013,
        wind=GUSTY,
        noise=NOISY,
        mismatch={"rod_length": 1.1},
        pivot_offset=(0.0, 0.01, 0.02),
        seed=4,
    ),
}


# The board of `inverted` also finds a delay, and is told of rates.
BOARDS = ("delay", "noise", "rates", "mismatch", "air, motors and the rest")
FLOWN = [(name, "corrected") for name in PLANTS] + [(name, "inverted") for name in BOARDS]


@pytest.mark.parametrize(("name", "law"), few(FLOWN, PLANTS, ("inverted", "corrected")))
def test_the_sampled_kernel_flies_as_python_does(name, law):
    vehicle, plant = (HEHN, PLANTS[name])
    law = getattr(fp.laws, law)().bind(vehicle)
    starts = fp.State.random(np.random.default_rng(2), 3)
    ticks = np.arange(0, round(0.4 * plant.rate) + 1)
    kernel = sampled_kernel(Loop(vehicle, law, plant.replace(seed=0)), Criterion())
    flown = kernel.fly(starts.packed(), 0.4, judge_at=ticks, keep_at=ticks, first_seed=plant.seed)
    flight = Flight(vehicle=vehicle, law=law, starts=starts, duration=0.4, plant=plant)
    for i in (0, 2):
        samples = fly_stepwise(flight.member(i))
        own = samples.packed * (1.0 if law.e3 == "up" else fp.model.state.FLIP_PACKED)
        assert samples.outcome.status == flown.status[i]
        np.testing.assert_allclose(flown.samples[i, :, :24], own, rtol=0, atol=1e-9)
        np.testing.assert_allclose(flown.samples[i, :, 24:], samples.rotors, rtol=0, atol=1e-9)


IDLE = (
    (0.0, True, 0.0, "gimbal"), (1e-6, False, 0.0, "gimbal"), (0.0, True, 0.05, "hub"), (1e-6, False, 0.05, "hub"),
    (0.0, False, 0.0, "cup"), (1e-6, True, 0.05, "cup"),
)  # fmt: skip


@pytest.mark.parametrize(
    ("thrust", "limits", "lag", "mount"), few(IDLE, (0.0, 1e-6), (True, False), (0.0, 0.05), ("gimbal", "hub", "cup"))
)
def test_no_thrust_is_no_thrust(thrust, limits, lag, mount):
    """A command that is a constant, 0 above all; within limits the rotors keep their minimum force."""
    vehicle = HEHN.replace(mount=mount)
    law = fp.Law(name="idle", e3="up", control=lambda t, s, v, k: fp.Wrench(ca.SX(thrust), ca.SX.zeros(3)))
    start = fp.State(x_dot=(0.3, 0.1, 0.2), y=(0.0, 0.28, 0.96), omega=(0.5, -0.3, 0.2), y_dot=(0.4, 0, 0))
    plant = Plant(limits=limits, lag=lag)
    least = vehicle.rotor_limits[0]
    wanted = least if limits else thrust / 4
    kernel = fp.simulate(vehicle, law, start, 0.05, plant=plant)
    mujoco = fp.simulate(vehicle, law, start, 0.05, plant=plant.replace(engine="mujoco"))
    python = fly_stepwise(Flight(vehicle=vehicle, law=law.bind(vehicle), starts=start, duration=0.05, plant=plant))
    assert kernel.outcome.status == mujoco.outcome.status == python.outcome.status
    if mount == "cup" and not limits and lag == 0:  # it would have to pull
        assert kernel.outcome.status == "collided"
        assert kernel.outcome.time == pytest.approx(python.outcome.time, abs=1e-12)
        return
    assert kernel.outcome.status == "completed"
    end = wanted + (least - wanted) * (np.exp(-0.05 / lag) if lag else 0.0)
    np.testing.assert_allclose(kernel.rotor_forces[-1], end, rtol=0, atol=1e-12)
    np.testing.assert_allclose(mujoco.rotor_forces[-1], end, rtol=0, atol=1e-8)  # its filter has steps
    here = python.at(kernel.t * plant.rate)
    np.testing.assert_allclose(kernel.x, here.packed[:, :3], rtol=0, atol=1e-12)
    np.testing.assert_allclose(kernel.rotor_forces, here.rotors, rtol=0, atol=1e-12)
    np.testing.assert_allclose(kernel.x, mujoco.x, rtol=0, atol=1e-9)  # whose steps are its own


def test_lag_noise_and_wind_are_inputs_of_one_machine_code():
    """Each has its effect, and none is in the code, whose result is that of the flight in Python (above)."""
    noisy = Plant(noise=NOISY, wind=GUSTY, rate=200.0)
    one = sampled_kernel(Loop(HEHN, INVERTED, noisy), Criterion())
    others = [
        noisy.replace(lag=0.04), noisy.replace(lag=0.0), noisy.replace(noise=Noise(x=0.01)),
        noisy.replace(wind=Wind(on_bob=(0.1, 0.0, 0.0), gust_on_bob=0.01)), noisy.replace(mismatch={"rotor_lag": 1.5}),
    ]  # fmt: skip
    starts, ticks = random_starts(2), np.arange(41)
    seen = {one.fly(starts, 0.2, judge_at=ticks).final.tobytes()}
    for plant in others:
        other = sampled_kernel(Loop(HEHN, INVERTED, plant), Criterion())
        assert other.function is one.function
        assert other.loop.plant == plant
        seen.add(other.fly(starts, 0.2, judge_at=ticks).final.tobytes())
    assert len(seen) == 1 + len(others)
    for plant in (noisy.replace(noise=None), noisy.replace(wind=Wind(on_bob=(0.1, 0, 0)), noise=None), Plant()):
        assert sampled_kernel(Loop(HEHN, INVERTED, plant), Criterion()).function is not one.function
        with pytest.raises(ValueError, match="same structure"):
            one.through(plant)


@pytest.mark.parametrize("centre_of_mass", [slow((0.0, 0.0, 0.0)), (0.003, -0.002, 0.001)], ids=["centred", "off"])
def test_machines_share_machine_code_and_each_flies_as_in_python(centre_of_mass):
    vehicle = HEHN.replace(**uniform_rod(0.05, 1.0))
    law, nominal = fp.laws.inverted().bind(vehicle), Plant(rate=200.0, centre_of_mass=centre_of_mass)
    ratios = {"mass": 1.1, "bob_mass": 0.8, "rod_length": 0.9, "rod_inertia": 0.7, "inertia": 1.2, "drag_ratio": 1.3}
    wrong = [nominal.replace(mismatch={name: ratio}) for name, ratio in ratios.items()]
    wrong += [nominal.replace(mismatch=ratios), nominal.replace(sag=0.1, strength=(1.0, 0.9, 1.1, 1.0))]
    starts, ticks = fp.State.random(np.random.default_rng(4), 2), np.arange(61)
    kernels = [sampled_kernel(Loop(vehicle, law, plant), Criterion()) for plant in wrong]
    assert {kernel.function for kernel in kernels} == {kernels[0].function}
    assert sampled_kernel(Loop(vehicle, law, nominal), Criterion()).function is not kernels[0].function
    ends = set()
    for plant, kernel in zip(wrong, kernels, strict=True):
        flown = kernel.fly(starts.packed(), 0.3, judge_at=ticks, keep_at=ticks)
        ends.add(flown.final.tobytes())
        flight = Flight(vehicle=vehicle, law=law, starts=starts, duration=0.3, plant=plant)
        expected = fly_stepwise(flight.member(1)).packed
        np.testing.assert_allclose(flown.samples[1, :, :24], expected, rtol=0, atol=1e-9)
    assert len(ends) == len(wrong)


def filler_of_the_stack(length=320_000):
    """A function that leaves NaN in the memory in which the next call finds its own, and tells it."""
    module = f"""
        declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)
        define void @fill(ptr %told) {{
            %memory = alloca [{length} x i8], align 64
            call void @llvm.memset.p0.i64(ptr %memory, i8 -1, i64 {length}, i1 true)
            %first = load volatile double, ptr %memory
            store double %first, ptr %told
            ret void
        }}
    """
    return jit.Native(jit.compile_module(module), "fill", (ctypes.c_void_p,))


def test_what_nobody_drew_is_zero():
    """Not what memory held before."""
    starts, ticks, told = random_starts(8, seed=3), np.arange(0, 101, 10), np.zeros(1)
    windy = Plant(wind=Wind(on_vehicle=(0.2, 0.0, 0.0)), rate=100.0)
    kernel = sampled_kernel(Loop(HEHN, INVERTED, windy), Criterion())
    fill = filler_of_the_stack()

    def filled(*arguments):
        fill(told.ctypes.data)
        kernel.function(*arguments)

    flown = dataclasses.replace(kernel, function=filled).fly(starts, 1.0, judge_at=ticks, workers=1)
    assert np.isnan(told).all()
    assert np.all(flown.status == "completed")


def test_a_sampled_flight_is_the_same_in_any_company():
    plant = PLANTS["noise"]
    starts, ticks = random_starts(70, seed=2), np.arange(0, 41, 4)
    kernel = sampled_kernel(Loop(HEHN, INVERTED, plant.replace(seed=0)), Criterion())
    together = kernel.fly(starts, 0.2, judge_at=ticks, keep_at=ticks, first_seed=9, workers=3)
    for i in (0, 33, 69):
        alone = kernel.fly(starts[i : i + 1], 0.2, judge_at=ticks, keep_at=ticks, first_seed=9 + i)
        np.testing.assert_array_equal(alone.samples[0], together.samples[i])
        np.testing.assert_array_equal(alone.reductions[0], together.reductions[i])


def test_a_lane_of_a_sampled_flight_that_is_lost_takes_no_other_along():
    starts, ticks = random_starts(8, seed=2), np.arange(0, 101, 10)
    kernel = sampled_kernel(Loop(HEHN, INVERTED, Plant()), Criterion())
    good = kernel.fly(starts, 0.2, judge_at=ticks, keep_at=ticks)
    bad = starts.copy()
    bad[2, 16], bad[5, 3] = np.nan, 2e6
    mixed = kernel.fly(bad, 0.2, judge_at=ticks, keep_at=ticks)
    assert mixed.status[[2, 5]].tolist() == ["singular", "diverged"]
    rest = [0, 1, 3, 4, 6, 7]
    np.testing.assert_array_equal(mixed.samples[rest], good.samples[rest])
    np.testing.assert_array_equal(mixed.final[rest], good.final[rest])
