"""The trim: moments in proportion to the thrust that the model lacks, found in flight and made up for."""

import numpy as np
import pytest

import flypend as fp
from flypend.board import trim as trimming
from flypend.board.computer import SteppedBoard
from flypend.board.nominal import Nominal
from flypend.board.trim import DOUBT, trim
from flypend.compile.numeric import as_numpy
from flypend.flight import sampled
from flypend.flight.request import Flight
from flypend.flight.sampled import fly_stepwise
from flypend.flight.tasks import task_starts
from flypend.plants import PRESETS, ROTORS, SUITES
from tests.few import each_once, slow

VEHICLE = fp.vehicle("crazyflie")
NONE = np.zeros(0)


def found(plant, duration=4.0, vehicle=VEHICLE, y=(0.0, 0.0, 1.0), what="lever"):
    """What the board finds of its trim in `duration` (s) in `plant`, from rest with the rod at `y`; levers are in m."""
    law, trims = fp.laws.inverted().bind(vehicle), []
    original = SteppedBoard.command

    def command(self, t, measured):
        answer = original(self, t, measured)
        trims.append(self._memory[self._stages.made.own.place(f"delay.trim.{what}")].copy())
        return answer

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sampled.SteppedBoard, "command", command)
        start = fp.State(y=y)
        fly_stepwise(Flight(vehicle=vehicle, law=law, starts=start, duration=duration, plant=plant, seed=1))
    return np.array(trims)


def test_a_centre_of_mass_that_is_off_is_found():
    """About it, the thrust exerts −r × f e₃, and the load of the rod r × m g e₃."""
    off = np.array([0.001, -0.002, 0.0])
    share = VEHICLE.M / (VEHICLE.M + VEHICLE.m)
    np.testing.assert_allclose(
        found(ROTORS.replace(centre_of_mass=off))[-1], -share * np.cross(off, [0, 0, 1]), rtol=0.02, atol=2e-6
    )


def test_unequal_rotors_are_found():
    strength = np.array([0.97, 1.02, 1.0, 1.01])
    wrench = VEHICLE.mixing() @ (strength * VEHICLE.weight / 4)
    np.testing.assert_allclose(
        found(ROTORS.replace(strength=strength))[-1], wrench[1:] / wrench[0], rtol=0.05, atol=2e-6
    )


def test_nothing_is_found_where_nothing_is_lacking():
    assert np.abs(found(ROTORS)).max() < 1e-6


@pytest.mark.parametrize("y", [(0.0, 0.6, -0.8), (0.1, 0.0, -np.sqrt(0.99))])
def test_a_false_delay_in_a_throw_is_taken_for_no_moment(y):
    """The law believes in a delay that this plant does not have; trims of 2 to 3 mm would follow."""
    assert np.abs(found(ROTORS, 2.0, fp.vehicle("hehn2011"), y)).max() < 1e-3


WRONG = {
    "weak rotors": ({"strength": 0.85}, -0.15),
    "light inertia": ({"mismatch": {"inertia": 0.8}}, 0.25),
    "centre of mass off": ({"centre_of_mass": (0, 0.002, 0)}, 0.0),
}


@pytest.mark.parametrize(("name", "sensors"), each_once(WRONG, (None, "mocap")))
def test_the_strength_of_moments_is_found_in_a_throw(name, sensors):
    """To a quarter, since one throw stands against the doubt before the flight. A lever is told from it."""
    wrong, strength = WRONG[name]
    plant = ROTORS.replace(sensors=sensors, delay=0.02, **wrong)
    assert found(plant, 3.0, y=(0.0, 0.6, -0.8), what="strength")[-1] == pytest.approx(strength, rel=0.25, abs=0.03)


def stand(observer=1.5):
    """How many of twelve flights of a light machine with weak rotors and a short rod stand."""
    late, law = np.arange(18.0, 20.0, 0.02), fp.laws.inverted(observer=observer)
    plant = ROTORS.replace(
        strength=0.85, mismatch={"mass": 0.8, "bob_mass": 0.8, "rod_length": 0.85}, sensors=SUITES["mocap"], delay=0.02
    )
    flown = fp.simulate_ensemble(VEHICLE, law, fp.random_starts(12, 5), 20.0, plant=plant, times=late)
    return np.sum(np.all(flown.samples.y[..., 2] > 0.95, axis=1))


def test_a_light_machine_with_weak_rotors_and_a_short_rod_stands():
    assert stand() == 12


@pytest.mark.slow
def test_if_the_strength_of_moments_is_not_believed_it_falls(monkeypatch):
    """Negative control of the test above: one or two flights stand."""
    monkeypatch.setattr(trimming, "MOST_STRENGTH", 0.0)
    assert stand(observer=1.501) < 6  # another program


def test_what_is_sent_takes_the_moment_back():
    send = as_numpy(trim(Nominal(VEHICLE), limits=True))
    command, lever = np.array([0.09, 0.1, 0.11, 0.08]), np.array([1e-3, -2e-3, 1e-4])
    strong = np.concatenate([lever, [0, 0.25], np.zeros(9)])
    wanted = VEHICLE.mixing() @ command
    wanted[1:] = wanted[1:] / 1.25 - wanted[0] * lever
    np.testing.assert_allclose(VEHICLE.mixing() @ send(command, strong, NONE), wanted, rtol=0, atol=1e-12)
    lever = np.concatenate([lever, np.zeros(11)])
    sent = send(command, lever, NONE)
    wanted = VEHICLE.mixing() @ command
    wanted[1:] -= wanted[0] * lever[:3]
    np.testing.assert_allclose(VEHICLE.mixing() @ sent, wanted, rtol=0, atol=1e-12)
    low, high = VEHICLE.rotor_limits
    full = send(np.full(4, high), lever, NONE)
    assert np.all((full >= low - 1e-15) & (full <= high + 1e-15))
    np.testing.assert_allclose((VEHICLE.mixing() @ full)[1:3], -4 * high * lever[:2], rtol=1e-12)
    assert np.isnan(send(np.array([np.nan, 0.1, 0.1, 0.1]), lever, NONE)).all()


@pytest.mark.parametrize("sensors", [None, slow(SUITES["mocap"])], ids=["perfect", "mocap"])
def test_a_short_rod_on_unequal_rotors_stands_at_its_reference(sensors):
    """Two rotors are 8 % apart. Negative control: without a trim it is far off."""
    vehicle = fp.vehicle("hehn2011").replace(rod_length=0.15)
    starts = fp.State(x=np.zeros((8, 3)), y=np.tile([0.0, 0.0, 1.0], (8, 1)))
    plant, off = ROTORS.replace(strength=(1.04, 1.0, 0.96, 1.0), sensors=sensors), []
    for doubt, observer in ((DOUBT, 1.5), (1e9, 1.501)):  # two programs
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(trimming, "DOUBT", doubt)
            law = fp.laws.inverted(observer=observer)
            flown = fp.simulate_ensemble(vehicle, law, starts, 20.0, plant=plant, times=np.arange(17.0, 20.0, 0.1))
        off.append(np.linalg.norm(np.nanmean(flown.samples.x, axis=(0, 1))))
    assert off[0] < 0.1 * off[1]
    assert off[1] > 0.05  # m: several times what hover trembles by


def test_crazyflie_stands_with_its_centre_of_mass_off_by_three_millimetres():
    """Without a trim none of these flights ends up."""
    starts = task_starts(VEHICLE, 40, 2026)["random"]
    late = np.arange(10.0, 12.0, 0.02)
    flown = fp.simulate_ensemble(
        VEHICLE, fp.laws.inverted(), starts, 12, plant=ROTORS.replace(centre_of_mass=(0.0, 0.003, 0.0)), times=late
    )
    assert flown.success.sum() >= 38
    assert np.percentile(np.linalg.norm(flown.samples.x, axis=-1), 95) < 0.02


def test_a_laboratory_leaves_crazyflie_standing():
    """All its errors at once, 20 s: the centre of mass alone cost every flight without a trim."""
    flown = fp.simulate_ensemble(
        VEHICLE, fp.laws.inverted(), task_starts(VEHICLE, 40, 2026)["random"], 20, plant=PRESETS["laboratory"]
    )
    assert flown.success.sum() >= 34
