"""Advice names the law that does best, and for a machine that none flies a change that was seen to work."""

import numpy as np
import pytest

import flypend as fp
from flypend.studies.advice import CHANGES, advise, change, changes_of

HEHN = fp.vehicle("hehn2011")

pytestmark = pytest.mark.usefixtures("one_plan")


def weak(force):
    """hehn2011 with rotors of so many newtons; it weighs 5.4."""
    return HEHN.replace(rotor_limits=(0.0, force))


@pytest.fixture(scope="module")
def checks(one_plan):
    return {name: fp.check(HEHN, getattr(fp.laws, name)(), runs=24, margins=False) for name in ("inverted", "lqr")}


def test_the_best_law_is_the_one_that_succeeds(checks):
    advice = advise(HEHN, checks)
    assert advice.law == "inverted"
    (line,) = advice.lines()
    flown = checks["lqr"].tasks["random"]
    assert line.startswith("best: inverted. inverted: 24 of 24")
    assert f"lqr: {int(flown.success.sum())} of 24" in line


def test_of_laws_that_succeed_alike_the_one_that_strays_least_is_best(checks):
    slow = fp.check(HEHN, fp.laws.inverted(position_bandwidth=0.5), runs=24, margins=False)
    assert slow.envelope["random"] in ("all", "most")
    both = {"slow": slow, "usual": checks["inverted"]}
    excursions = {law: check.tasks["random"].percentile("excursion", 50) for law, check in both.items()}
    assert (
        advise(HEHN, both).law == advise(HEHN, dict(reversed(both.items()))).law == min(excursions, key=excursions.get)
    )


def test_drawn_vehicles_count_where_they_were_flown():
    wide = HEHN.replace(bands={"thrust_scale": (0.3, 0.31)})
    found = fp.check(wide, runs=18, duration=6.0, margins=False, bands=True)
    assert found.envelope["random"] == "all"
    lines = advise(HEHN, {"inverted": found}).lines()
    assert "0 of 18" in lines[0]
    assert lines[1] == "narrow them by a longer log: inverted will do for the vehicle as written"


def test_for_rotors_too_weak_to_hover_stronger_ones_are_advised_and_a_longer_rod_is_not():
    told = []
    changes = changes_of(weak(1.3), progress=lambda _, done, total: told.append((done, total)))
    assert told == [(done, len(CHANGES) + 1) for done in range(len(CHANGES))] + [(len(CHANGES) + 1,) * 2]
    found = {name: one for one in changes for name in one.factors}
    assert found["rotor_limits"].works
    assert not found["rod_length"].works
    assert "N each" in found["rotor_limits"].describe()
    flown = change(weak(1.3), found["rotor_limits"].factors)
    again = fp.simulate_ensemble(flown, fp.laws.inverted(), fp.random_starts(24, 5), 30.0)
    assert again.rate > 0.8  # from other starts, too


def test_what_nothing_helps_is_said():
    check = fp.check(weak(0.2), margins=False)
    lines = advise(weak(0.2), {"inverted": check}).lines()
    assert lines[0] == "none of these laws will do. inverted: cannot hover"
    assert "not even a longer rod" in lines[1]
    assert "0 of 100" in lines[1]


def test_rotors_without_lag_are_not_made_quicker():
    assert set(changes_of(weak(0.2).replace(rotor_lag=0.0))[-1].factors) == set(CHANGES) - {"rotor_lag"}


def test_a_changed_vehicle_keeps_its_shape():
    whole = HEHN.replace(**fp.rod_with_bob(0.02, 0.6, 0.04))
    new = change(whole, {"rod_length": 2.0, "bob_mass": 0.5, "rotor_limits": 1.5})
    assert new.rod_inertia == pytest.approx(2.0 * whole.rod_inertia)
    assert (new.rod_end, new.rod_length) == (2 * whole.rod_end, 2 * whole.rod_length)
    np.testing.assert_allclose(new.rotor_limits, [whole.rotor_limits[0], 1.5 * whole.rotor_limits[1]])
    for name, (factors, _) in CHANGES.items():  # from the smallest on
        assert list(factors) == sorted(factors, key=lambda factor: abs(np.log(factor))), name
