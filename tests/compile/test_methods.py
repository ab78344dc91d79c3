"""The tableaus are those of the literature, as SciPy has them."""

import numpy as np
import pytest
from scipy.integrate import DOP853, RK45

from flypend.compile.methods import method
from flypend.errors import InputError


def test_dop853_is_scipys_bit_by_bit():
    ours, theirs = method("dop853"), DOP853
    pairs = (
        (ours.A, theirs.A), (ours.B, theirs.B), (ours.C, theirs.C), (ours.errors[0], theirs.E5),
        (ours.errors[1], theirs.E3), (ours.A_extra, theirs.A_EXTRA), (ours.C_extra, theirs.C_EXTRA),
        (ours.dense, theirs.D),
    )  # fmt: skip
    for own, other in pairs:
        np.testing.assert_array_equal(own, other, strict=True)


def test_dp5_is_scipys_bit_by_bit():
    ours = method("dp5")
    pairs = ((ours.A, RK45.A), (ours.B, RK45.B), (ours.C, RK45.C), (ours.errors[0], RK45.E), (ours.dense, RK45.P))
    for own, other in pairs:
        np.testing.assert_array_equal(own, other)


@pytest.mark.parametrize("name", ["dop853", "dp5"])
def test_a_row_of_the_tableau_sums_to_its_time(name):
    scheme = method(name)
    np.testing.assert_allclose(scheme.A.sum(axis=1), scheme.C[: len(scheme.A)], atol=1e-13)  # roundoff of 12 terms
    assert scheme.B.sum() == pytest.approx(1, abs=1e-14)


def test_another_name_is_refused():
    with pytest.raises(InputError, match="method"):
        method("euler")
