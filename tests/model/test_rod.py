"""Rods with an extent: their mass, centre and inertia, and the point bob that moves like them."""

import numpy as np
import pytest

import flypend as fp
from flypend.errors import InputError
from flypend.model import kinetic_energy, potential_energy
from flypend.model.rod import rod_with_bob, stretch, uniform_rod


def summed(mass, length, bob_mass, points=200_000):
    """Mass, centre and inertia about the centre as sums over slices."""
    at = np.append((np.arange(points) + 0.5) * length / points, length)
    masses = np.append(np.full(points, mass / points), bob_mass)
    center = masses @ at / masses.sum()
    return masses.sum(), center, masses @ (at - center) ** 2


@pytest.mark.parametrize("bob", [0.0, 0.02, 1.0])
def test_a_rod_is_the_sum_of_its_slices(bob):
    rod = rod_with_bob(0.05, 1.2, bob)
    # The midpoint rule's error is the square of a slice, 4e-11.
    found = (rod["bob_mass"], rod["rod_length"], rod["rod_inertia"])
    np.testing.assert_allclose(found, summed(0.05, 1.2, bob), rtol=1e-9)
    assert rod["rod_end"] == 1.2


def test_a_bob_on_a_massless_rod_is_the_point_mass():
    assert rod_with_bob(0.0, 0.7, 0.1) == {"bob_mass": 0.1, "rod_length": 0.7, "rod_inertia": 0.0, "rod_end": 0.7}


@pytest.mark.parametrize(("heavier", "longer"), [(1.0, 1.3), (0.6, 1.0), (1.7, 0.8)])
def test_a_stretched_rod_is_made_of_heavier_and_longer_parts(heavier, longer):
    vehicle = fp.vehicle("hehn2011").replace(**rod_with_bob(0.05, 1.2, 0.02))
    made = rod_with_bob(heavier * 0.05, longer * 1.2, heavier * 0.02)
    assert stretch(vehicle, heavier, longer) == pytest.approx(made | {"rod_spin_inertia": 0.0}, rel=1e-14)


def test_a_disc_on_a_rod_stays_one_when_it_gets_lighter():
    """Its moment about the rod's axis becomes less as well: at most twice that across it, as a vehicle requires."""
    vehicle = fp.vehicle("hehn2011").replace(rod_inertia=1e-3, rod_spin_inertia=2e-3)
    new = vehicle.replace(**stretch(vehicle, 0.25, 1.0))
    assert new.rod_spin_inertia == 2 * new.rod_inertia == pytest.approx(5e-4)


def test_the_letters_are_those_of_the_equivalent_bob():
    """A uniform rod of length L swings like a bob at 2 L/3 with 3/4 of its mass; the rest moves with the pivot."""
    vehicle = fp.vehicle("hehn2011").replace(**uniform_rod(0.08, 0.9))
    np.testing.assert_allclose((vehicle.M, vehicle.m, vehicle.l), (0.52, 0.06, 0.6), rtol=1e-14)
    assert vehicle.reach == 0.9
    point = fp.vehicle("hehn2011")
    assert (point.M, point.m, point.l, point.reach) == (0.5, 0.05, 0.565, 0.565)


def test_energies_are_those_of_the_slices():
    vehicle = fp.vehicle("hehn2011").replace(**rod_with_bob(0.05, 0.9, 0.03))
    state = fp.State.random(np.random.default_rng(4))
    along = (np.arange(20_000) + 0.5) * 0.9 / 20_000
    at = np.append(along, 0.9)
    masses = np.append(np.full(20_000, 0.05 / 20_000), 0.03)
    velocities = state.x_dot + at[:, None] * state.y_dot
    kinetic = (masses @ (velocities**2).sum(1) + 0.5 * state.x_dot @ state.x_dot) / 2
    kinetic += state.omega @ vehicle.inertia @ state.omega / 2
    heights = state.x[2] + at * state.y[2]
    assert kinetic_energy(state, vehicle) == pytest.approx(kinetic, rel=1e-8)  # midpoint rule, 20,000 slices
    assert potential_energy(state, vehicle, "up") == pytest.approx(
        9.81 * (masses @ heights + 0.5 * state.x[2]), rel=1e-8
    )


def test_the_inverted_law_stands_a_uniform_rod():
    """Of hehn2011's mass and twice its length, with the law's gains for it; MuJoCo has bodies of its own."""
    pytest.importorskip("mujoco")
    vehicle = fp.vehicle("hehn2011").replace(**uniform_rod(0.05, 1.0))
    starts = fp.random_starts(3, 11)
    for plant in ("rotors", "mujoco"):
        assert fp.simulate_ensemble(vehicle, fp.laws.inverted(), starts, 10.0, plant=plant).success.all()


@pytest.mark.parametrize(
    ("change", "field"),
    [({"rod_inertia": -1}, "rod_inertia"), ({"rod_end": 0.1}, "rod_end"), ({"rod_end": "far"}, "rod_end")],
)
def test_an_impossible_rod_is_refused(change, field):
    with pytest.raises(InputError) as refused:
        fp.vehicle("hehn2011").replace(**change)
    assert refused.value.field == field
    with pytest.raises(InputError):
        uniform_rod(0.0, 1.0)


@pytest.mark.parametrize("radius", [0.1, 0.37, 1.3])
def test_a_disc_spins_with_the_most_inertia_that_a_body_can_have(radius):
    """About its axis a disc has m r²/2, about a diameter m r²/4."""
    across, along = 0.1 * radius**2 / 4, 0.1 * radius**2 / 2
    fp.vehicle("hehn2011").replace(rod_inertia=across, rod_spin_inertia=along)
    with pytest.raises(InputError, match="rod_spin_inertia"):
        fp.vehicle("hehn2011").replace(rod_inertia=across, rod_spin_inertia=1.001 * along)
