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


@pytest.fixture(scope="module")
def corrected():
    return array_kernel(NAYAK, CORRECTED)


def test_it_takes_the_steps_of_the_kernel(corrected):
    starts = random_starts(32)
    reference = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal()), method="dp5").fly(starts, 2.0, rtol=1e-8)
    flown = corrected.fly(starts, 2.0, rtol=1e-8)
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
    corrected.fly(random_starts(32), 2.0, rtol=1e-8)
    assert jax.numpy.zeros(1).dtype == before


def test_a_lost_run_takes_no_other_along(corrected):
    starts = random_starts(32)
    bad = starts.copy()
    bad[3, 16], bad[7, 3] = np.nan, 2e6
    good, mixed = (corrected.fly(some, 2.0, rtol=1e-8) for some in (starts, bad))
    assert mixed.code[3] == runge_kutta.UNDEFINED
    assert mixed.status[7] == "diverged"
    assert mixed.end[7] < 1
    rest = np.delete(np.arange(32), [3, 7])
    np.testing.assert_array_equal(mixed.final[rest], good.final[rest])


def test_too_many_steps_end_a_run(corrected):
    flown = corrected.fly(random_starts(32), 2.0, rtol=1e-8, max_steps=10)
    assert np.all(flown.code == runge_kutta.TOO_MANY)
    assert np.all(flown.steps == 10)


def test_a_singular_run_ends_where_that_of_the_kernel_does():
    law, starts = fp.laws.printed().bind(NAYAK), random_starts(16, seed=9)
    reference = ideal_kernel(Loop(NAYAK, law, Ideal())).fly(starts, 1.0, rtol=1e-9)
    flown = array_kernel(NAYAK, law, method="dop853").fly(starts, 1.0, rtol=1e-9)
    assert flown.status.tolist() == reference.status.tolist()
    assert "singular" in flown.status
    np.testing.assert_allclose(flown.end, reference.end, atol=1e-4)


def test_gains_may_vary():
    kernel = array_kernel(NAYAK, CORRECTED, ("k_1",))
    starts, gains = np.repeat(random_starts(1), 3, axis=0), np.array([[9.0], [9.0], [12.0]])
    flown = kernel.fly(starts, 0.5, rtol=1e-8, parameters=gains)
    np.testing.assert_array_equal(flown.final[0], flown.final[1])
    own = ideal_kernel(Loop(NAYAK, CORRECTED, Ideal(), ("k_1",))).fly(starts, 0.5, rtol=1e-10, parameters=gains)
    np.testing.assert_allclose(flown.final, own.final, atol=1e-5)
    with pytest.raises(fp.errors.InputError, match="parameters"):
        kernel.fly(starts, 0.5, rtol=1e-8, parameters=np.zeros((2, 1)))


def test_jax_is_imported_when_it_is_used_and_not_before():
    program = "import sys, flypend.flight.kernels.gpu, flypend.cli.app; sys.exit('jax' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


@pytest.mark.slow
def test_the_inverted_law_agrees_with_the_kernel():
    """Compiling its 1400 operations takes 20 s."""
    law, starts = fp.laws.inverted().bind(HEHN), random_starts(16)
    tight = ideal_kernel(Loop(HEHN, law, Ideal())).fly(starts, 3.0, rtol=1e-11)
    flown = array_kernel(HEHN, law).fly(starts, 3.0, rtol=1e-9)
    assert np.median(np.max(np.abs(flown.final - tight.final), axis=1)) < 1e-6
