"""Steps of worlds under AddressSanitizer; 10⁷ of each task are `python -m benchmarks.sanitised`."""

import shutil

import pytest

from benchmarks.sanitised import CASES, FOUND, buffers, stepped


@pytest.fixture(autouse=True)
def clang():
    assert shutil.which("clang"), "clang is missing: run `make test-tools`"


def test_the_sanitiser_finds_nothing():
    """13 worlds fill no whole group; each begins anew several times."""
    status, said = stepped("hub", steps=20_000, count=13)
    assert status == 0, said


def test_it_finds_an_array_that_is_a_byte_short():
    status, said = stepped("hub", steps=100, count=13, planted="observations")
    assert status == FOUND
    assert "heap-buffer-overflow" in said


def test_it_finds_a_buffer_that_is_a_vector_short():
    status, said = stepped("hub", steps=100, count=13, planted="action")
    assert status == FOUND
    assert "stack-buffer-overflow" in said


@pytest.mark.slow
@pytest.mark.parametrize("case", ["hub", "onboard"])
def test_it_finds_any_buffer_that_is_a_vector_short(case):
    """From the numbers of a world's beginning to what the rod touches: every access is checked."""
    assert {"observed", "held", "begun", "draws"} < set(buffers(case))
    for name in buffers(case):
        status, said = stepped(case, steps=2000, count=13, planted=name)
        assert status == FOUND, name
        assert "stack-buffer-overflow" in said


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_ten_million_steps_find_nothing(case):
    status, said = stepped(case, steps=10**7, count=4100)
    assert status == 0, said
