"""`thrust_scale`: rotors that push more or less than asked, as the law believes and as the plant has it."""

import re

import numpy as np
import pytest

import flypend as fp
from flypend.errors import InputError
from flypend.model.air import Air

SCALE = 0.87
START = fp.State(y=(0, 0.6, -0.8), x=(0.3, 0, 0))


def test_a_scale_of_one_changes_nothing():
    plain = fp.vehicle("hehn2011")
    told = plain.replace(thrust_scale=1.0, bands=None)
    assert told.commanded() is told
    assert told == plain
    assert told.to_dict() == plain.to_dict()
    assert "thrust_scale" not in plain.to_dict()


def test_a_law_that_knows_the_scale_flies_the_machine_that_has_it():
    """Masses as weighed and rotors of that strength move as the law's vehicle does: equations that share no unit."""
    # Rotors begin at the least force.
    machine = fp.vehicle("hehn2011").replace(thrust_scale=SCALE, rotor_limits=(0, 3.5))
    real = fp.Plant(strength=SCALE, mismatch={"mass": SCALE, "bob_mass": SCALE, "inertia": SCALE})
    nominal = fp.simulate(machine, fp.laws.inverted(), START, duration=3)
    flown = fp.simulate(machine.commanded(), fp.laws.inverted(), START, duration=3, plant=real)
    assert np.abs(nominal.x - flown.x).max() < 1e-6  # roundoff, grown by 3 s of swing-up
    ignored = fp.simulate(machine.replace(thrust_scale=1.0), fp.laws.inverted(), START, duration=3)
    assert np.abs(nominal.x - ignored.x).max() > 1e-2


def test_the_air_acts_on_the_force_that_is_there():
    machine = fp.vehicle("hehn2011").replace(thrust_scale=SCALE)
    names = ("rotor_drag", "inflow")
    machine = machine.replace(bands={name: (0.0, getattr(machine.air, name)) for name in names})
    air, commanded = machine.air, machine.commanded().air
    assert {name: machine.commanded().bands[name][1] for name in names} == {n: getattr(commanded, n) for n in names}
    force, speed = 1.3, 2.0  # commanded, N; m/s
    true = air.rotor_drag * np.sqrt(SCALE * force) * speed
    assert commanded.rotor_drag * np.sqrt(force) * speed == pytest.approx(true / SCALE)
    assert isinstance(commanded, Air)
    assert np.allclose(np.array(commanded.body_drag) * SCALE, air.body_drag)


@pytest.mark.parametrize("text", [fp.Vehicle.to_mjcf, fp.Vehicle.to_urdf, fp.Vehicle.to_sdf])
def test_other_engines_hover_at_the_force_that_a_law_asks_for(text):
    machine = fp.vehicle("hehn2011").replace(thrust_scale=SCALE)
    masses = map(float, re.findall(r'mass(?: value)?(?:="|>)([0-9.e-]+)', text(machine)))
    assert sum(masses) * machine.gravity == pytest.approx(machine.commanded().weight, rel=1e-3)


def test_a_plan_and_a_bound_law_take_the_commanded_vehicle():
    machine = fp.vehicle("hehn2011").replace(thrust_scale=SCALE)
    law = fp.laws.inverted().bind(machine)
    assert law.vehicle == machine.commanded()
    assert law.bind(machine) is law
    assert fp.plan(machine, fp.State(y=(0, 0, -1))).vehicle.weight == pytest.approx(machine.weight / SCALE)


def test_bands_travel_through_toml(tmp_path):
    from flypend.files.toml import toml_text

    bands = {"rod_length": (0.55, 0.58), "inertia": ((3e-3, 3e-3, 5e-3), (4e-3, 4e-3, 6e-3)), "delay": (0.0, 0.01)}
    machine = fp.vehicle("hehn2011").replace(bands=bands, thrust_scale=0.9)
    file = tmp_path / "mine.toml"
    file.write_text(toml_text(machine.to_dict()))
    again = fp.vehicle(file)
    assert again == machine
    assert dict(again.bands) == bands
    assert again.thrust_scale == 0.9


@pytest.mark.parametrize(
    ("bands", "said"),
    [
        ({"rod": (1, 2)}, "bands.rod"),
        ({"rod_length": (2, 1)}, "low <= high"),
        ({"rod_length": 1}, r"shape \(2\)"),
        ({"rod_length": [[0.5], [0.6]]}, r"shape \(2\)"),
        ({"inertia": ((1, 2, 3), (4, 5))}, r"shape \(2, 3\)"),
        ({"inertia": ((1, 2), (4, 5))}, r"bands\.inertia: expected numbers of shape \(2, 3\)"),
        ({"strength": ([0.9] * 6, [1.1] * 6)}, r"shape \(2, 4\)"),
        ({"thrust_scale": (0, 2)}, "0 < low"),
        ({"inertia": ((0, 1, 1), (1, 2, 2))}, "0 < low"),
        ({"spin_up": (0, 0)}, "0 < low"),
        ({"rod_length": (-1, 1)}, "0 < low"),
        ({"delay": (-0.1, 0)}, "0 <= low"),
        ({"delay": (0, np.inf)}, "finite"),
        ("all", "a table"),
    ],
)
def test_bands_that_are_none_are_refused(bands, said):
    with pytest.raises(InputError, match=said):
        fp.vehicle("hehn2011").replace(bands=bands)


@pytest.mark.parametrize("scale", [0, 1e-300, 0.04, 21, 97, 1e9])
def test_a_scale_that_no_rotors_have_is_refused_by_its_name(scale):
    with pytest.raises(InputError, match=r"^thrust_scale: "):
        fp.vehicle("hehn2011").replace(thrust_scale=scale)


def test_what_is_plausible_as_written_is_so_in_units_of_commanded_force():
    refused, plain = [], fp.vehicle("hehn2011")
    for factor in np.geomspace(1e-3, 1e3, 25):
        written = plain.to_dict() | {"rotor_limits": factor * plain.rotor_limits, "thrust_scale": 0.1}
        try:
            fp.Vehicle.from_dict(written).commanded()
        except InputError as error:
            refused.append((str(error), np.ravel(written[error.field.removeprefix("vehicle.")])[0]))
    assert refused
    assert all(f"with {number:g}" in said for said, number in refused)  # one that is written
