"""The form for GPUs, on a CPU: the kernel's results, and runs that do not touch each other."""

import subprocess
import sys

import numpy as np
import pytest

import flypend as fp
from flypend.compile.llvm import runge_kutta
from flypend.flight.kernels import ideal_kernel
from flypend.flight.kernels.gpu import array_kernel
from flypend.plants import Ideal
from flypend.plants.loop import Loop

jax = pytest.importorskip("jax")

NAYAK, HEHN = fp.vehicle("nayak2018"), fp.vehicle("hehn2011")
CORRECTED = fp.laws.corrected().bind(NAYAK)


def random_starts(runs, seed=11):
    return fp.State.random(np.random.default_rng(seed), runs).packed()


def setting(duration=2.0, rtol=1e-8, most=1_000_000):
    """Duration, tolerances and the most steps."""
    return duration, rtol, rtol, most


@pytest.fixture(scope="module")
def corrected():
    return array_kernel(Loop(NAYAK, CORRECTED, Ideal()))


def test_it_takes_the_steps_of_the_kernel(corrected):
    starts = random_starts(32)
    reference = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal()), method="dp5").fly(starts, 2.0, rtol=1e-8)
    flown = corrected.fly(starts, setting())
    assert flown.status.tolist() == ["completed"] * 32
    assert flown.final.dtype == np.float64
    # The same method; powers in the step control differ by some per cent, and the steps with them.
    assert np.mean(flown.steps) == pytest.approx(np.mean(reference.steps), rel=0.1)
    tight = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal())).fly(starts, 2.0, rtol=1e-12)
    error = np.max(np.abs(flown.final - tight.final), axis=1)
    assert np.median(error) < 1e-6
    assert np.median(error) < 3 * np.median(np.max(np.abs(reference.final - tight.final), axis=1))


def test_doubles_are_on_inside_and_nothing_changes_outside(corrected):
    before = jax.numpy.zeros(1).dtype
    corrected.fly(random_starts(32), setting())
    assert jax.numpy.zeros(1).dtype == before


def test_a_lost_run_takes_no_other_along(corrected):
    starts = random_starts(32)
    bad = starts.copy()
    bad[3, 16], bad[7, 3] = np.nan, 2e6
    good, mixed = (corrected.fly(some, setting()) for some in (starts, bad))
    assert mixed.code[3] == runge_kutta.UNDEFINED
    assert mixed.status[7] == "diverged"
    assert mixed.end[7] < 1
    rest = np.delete(np.arange(32), [3, 7])
    np.testing.assert_array_equal(mixed.final[rest], good.final[rest])


def test_too_many_steps_end_a_run(corrected):
    flown = corrected.fly(random_starts(32), setting(most=10))
    assert np.all(flown.code == runge_kutta.TOO_MANY)
    assert np.all(flown.steps == 10)


def test_a_singular_run_ends_where_that_of_the_kernel_does():
    law, starts = fp.laws.printed().bind(NAYAK), random_starts(16, seed=9)
    reference = ideal_kernel(Loop(NAYAK, law, Ideal())).fly(starts, 1.0, rtol=1e-9)
    flown = array_kernel(Loop(NAYAK, law, Ideal()), method="dop853").fly(starts, setting(1.0, 1e-9))
    assert flown.status.tolist() == reference.status.tolist()
    assert "singular" in flown.status
    np.testing.assert_allclose(flown.end, reference.end, atol=1e-4)


def test_gains_may_vary():
    kernel = array_kernel(Loop(NAYAK, CORRECTED, Ideal(), ("k_1",)))
    starts, gains = np.repeat(random_starts(1), 3, axis=0), np.array([[9.0], [9.0], [12.0]])
    flown = kernel.fly(starts, setting(0.5), parameters=gains)
    np.testing.assert_array_equal(flown.final[0], flown.final[1])
    own = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal(), ("k_1",))).fly(starts, 0.5, rtol=1e-10, parameters=gains)
    np.testing.assert_allclose(flown.final, own.final, atol=1e-5)
    with pytest.raises(fp.errors.InputError, match="parameters"):
        kernel.fly(starts, setting(0.5), parameters=np.zeros((2, 1)))


@pytest.mark.parametrize("method", ["dp5", "dop853"])
def test_it_judges_as_the_kernel_does(method):
    """Dense output and reductions of its own: since when, last time outside, excursion, effort, peak."""
    starts, times = random_starts(32), np.linspace(0.0, 1.5, 151)
    loop = Loop(NAYAK, CORRECTED, Ideal())
    criterion = fp.Criterion(target="e3", position=np.inf, rod=1.0, axis=0.5)
    reference = ideal_kernel(loop, criterion, method=method).fly(starts, 1.5, rtol=1e-10, judge_at=times)
    flown = array_kernel(loop, criterion, method=method).fly(starts, setting(1.5, 1e-10), judge_at=times)
    assert flown.status.tolist() == reference.status.tolist()
    got, wanted = flown.reductions, reference.reductions
    np.testing.assert_array_equal(got[:, :4], wanted[:, :4])  # times of samples
    np.testing.assert_allclose(got[:, 4:6], wanted[:, 4:6], rtol=1e-5)
    # The peak is the largest force at a stage. Steps differ by some per cent, and with them the times of the stages.
    np.testing.assert_allclose(got[:, 6], wanted[:, 6], rtol=1e-3)
    assert len(np.unique(wanted[:, 0])) > 3


def test_an_ensemble_on_jax_has_the_verdicts_of_the_kernel():
    starts = fp.State.random(np.random.default_rng(5), 48)
    options = {"criterion": fp.Criterion(target="e3", position=np.inf), "plant": "ideal", "rtol": 1e-7}
    gains, told = {"k_1": np.linspace(4.0, 20.0, 48)}, []
    ours, theirs = (
        fp.simulate_ensemble(NAYAK, fp.laws.corrected(), starts, 6.5, gains=gains, engine=engine, **options,
                             progress=lambda *now: told.append(now))
        for engine in ("kernel", "jax")
    )  # fmt: skip
    assert 0 < ours.rate < 1
    np.testing.assert_array_equal(theirs.success, ours.success)
    np.testing.assert_array_equal(theirs.cause, ours.cause)
    np.testing.assert_allclose(theirs.excursion, ours.excursion, rtol=1e-3)
    assert told[-1] == (48, 48)
    # Negative control: without the gains of each run the verdicts are others.
    plain = fp.simulate_ensemble(NAYAK, fp.laws.corrected(), starts, 6.5, engine="jax", **options)
    assert np.any(plain.settling != theirs.settling)


@pytest.mark.parametrize(
    ("options", "line"),
    [
        ({}, "plant: expected 'ideal', with the engine jax"),
        ({"plant": "ideal", "times": [0.0]}, "times: expected nothing, with the engine jax"),
        ({"plant": "ideal", "precision": "float"}, "precision: expected 'double', with the engine jax"),
        ({"plant": "ideal", "engine": "jaks"}, "engine: expected one of kernel, scipy, jax, got 'jaks'"),
    ],
)
def test_what_it_lacks_is_refused(options, line):
    starts = fp.State.random(np.random.default_rng(5), 2)
    with pytest.raises(fp.InputError) as caught:
        fp.simulate_ensemble(NAYAK, fp.laws.corrected(), starts, 0.1, **{"engine": "jax", **options})
    assert str(caught.value).startswith(line)


def test_a_controller_does_not_fly_on_jax():
    starts = fp.State.random(np.random.default_rng(5), 2)
    control = fp.Controller(name="plain", function=lambda t, state: fp.Wrench(5.0, np.zeros(3)))
    with pytest.raises(fp.InputError, match=r"^law: expected a Law, written in symbols, got plain"):
        fp.simulate_ensemble(NAYAK, control, starts, 0.1, engine="jax", plant="ideal")


def test_jax_is_imported_when_it_is_used_and_not_before():
    program = "import sys, flypend.flight.kernels.gpu, flypend.cli.app; sys.exit('jax' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


@pytest.mark.slow
def test_the_inverted_law_agrees_with_the_kernel():
    """Compiling its 1400 operations takes 20 s."""
    law, starts = fp.laws.inverted().bind(HEHN), random_starts(16)
    tight = ideal_kernel(Loop(HEHN, law, Ideal())).fly(starts, 3.0, rtol=1e-11)
    flown = array_kernel(Loop(HEHN, law, Ideal())).fly(starts, setting(3.0, 1e-9))
    assert np.median(np.max(np.abs(flown.final - tight.final), axis=1)) < 1e-6
