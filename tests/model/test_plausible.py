"""Numbers in another unit are refused with the unit that was meant; machines of any size pass; files have a base."""

import numpy as np
import pytest

import flypend as fp
from flypend.model.by_name import vehicle_names
from flypend.model.plausible import RULES, check_plausible

HEHN = fp.vehicle("hehn2011")
TEN = {key: 10 * value for key, value in HEHN.body.to_dict().items() if key != "cup_angle"}


@pytest.mark.parametrize("vehicle", [fp.vehicle(name) for name in vehicle_names()], ids=vehicle_names())
@pytest.mark.parametrize(
    ("field", "factor", "unit"),
    [
        ("mass", 1e3, "g"), ("bob_mass", 1e4, "g"), ("rotor_positions", 1e3, "mm"), ("rod_length", 1e3, "mm"),
        ("inertia", 1e9, "g·mm²"), ("inertia", 1e6, "kg·mm²"), ("inertia", 1e7, "g·cm²"), ("gravity", 1e3, "mm/s²"),
        ("gravity", 1e2, "cm/s²"), ("rotor_limits", 1e3, "mN"), ("rotor_lag", 1e3, "ms"),
    ],
)  # fmt: skip
def test_a_number_in_another_unit_is_refused_and_its_unit_named(vehicle, field, factor, unit):
    if unit == "g" and factor * getattr(vehicle, field) < 30 * vehicle.mass and field == "bob_mass":
        factor = 31 * vehicle.mass / vehicle.bob_mass
    with pytest.raises(fp.InputError) as caught:
        vehicle.replace(rod_end=None, **{field: factor * getattr(vehicle, field)})
    assert caught.value.field == field
    assert f"in {unit}? write " in str(caught.value)


@pytest.mark.parametrize(
    ("changes", "field", "hint"),
    [
        ({"inertia": [2000.0, 2000.0, 3000.0]}, "inertia", "in g·mm²? write 2e-06"),
        ({"drag_ratio": 16.0}, "drag_ratio", "in mm? write 0.016"),
        ({"rotor_limits": [8.0, 357.0]}, "rotor_limits", "in gf? write 0.07848"),
        ({"rod_end": 1130.0}, "rod_end", "in mm? write 1.13"),
        ({"rod_inertia": 1e4}, "rod_inertia", "in g·mm²? write 1e-05"),
        ({"pivot_offset": (0, 0, 3.0)}, "pivot_offset", "in mm? write 0.003"),
        ({"body": {"disc_radius": 0.5}}, "body.disc_radius", "at most 0.2404 m"),
        ({"body": {"disc_radius": 0.13}, "mount": "hub"}, "body.disc_radius", "at most 0.1202 m"),
        ({"body": {"disc_radius": 63.5}}, "body.disc_radius", "in mm? write 0.0635"),
        ({"body": {"hub_radius": 30}}, "body.hub_radius", "in mm? write 0.03"),
        ({"body": {"arm_radius": 6}}, "body.arm_radius", "in mm? write 0.006"),
        ({"body": {"rod_radius": 5}}, "body.rod_radius", "in mm? write 0.005"),
        ({"body": {"cup_angle": 60}}, "body.cup_angle", "in degrees? write 1.047"),
    ],
)
def test_what_no_machine_has_is_refused_with_a_hint(changes, field, hint):
    with pytest.raises(fp.InputError) as caught:
        HEHN.replace(**changes)
    assert caught.value.field == field
    assert hint in str(caught.value)


@pytest.mark.parametrize("scale", [0.1, 3.0, 10.0])
@pytest.mark.parametrize("vehicle", [fp.vehicle(name) for name in vehicle_names()], ids=vehicle_names())
def test_machines_of_any_size_pass(vehicle, scale):
    """The same machine at another scale: lengths with s, masses with s³, inertias with s⁵, forces with s³."""
    body = vehicle.body and {
        key: value if key == "cup_angle" else scale * value for key, value in vehicle.body.to_dict().items()
    }
    changes = {
        "mass": scale**3, "bob_mass": scale**3, "rod_length": scale, "inertia": scale**5, "rod_inertia": scale**5,
        "rotor_positions": scale, "drag_ratio": scale, "rotor_limits": scale**3, "rotor_lag": scale**0.5,
        "rod_spin_inertia": scale**5,
    }  # fmt: skip
    end = None if vehicle.rod_end is None else scale * vehicle.rod_end
    vehicle.replace(rod_end=end, body=body, **{name: by * getattr(vehicle, name) for name, by in changes.items()})


def test_rotors_above_each_other_may_overlap():
    places = np.array([*HEHN.rotor_positions, *(HEHN.rotor_positions + np.array([0, 0, 0.05]))])
    coaxial = HEHN.replace(rotor_positions=places, rotor_spins=[1, -1, 1, -1, -1, 1, -1, 1])
    with pytest.raises(fp.InputError, match=r"^body\.disc_radius"):
        coaxial.replace(rotor_positions=[*HEHN.rotor_positions, *(HEHN.rotor_positions + np.array([0.05, 0, 0]))])


@pytest.mark.parametrize("rule", RULES, ids=[rule.what for rule in RULES])
def test_the_usual_ratio_of_a_rule_is_within_its_limits_and_each_vehicle_keeps_it(rule):
    assert rule.low < rule.usual < rule.high
    for name in vehicle_names():
        ratio = rule.ratio(fp.vehicle(name))
        assert np.isnan(ratio) or rule.low <= ratio <= rule.high / 3, name  # not at the edge
    check_plausible(HEHN)


# A base -------------------------------------------------------------------------------------------------------------


def test_a_file_names_its_base_and_what_differs(tmp_path):
    (tmp_path / "mine.toml").write_text('base = "hehn2011"\nmass = 0.6\n[body]\nhub_radius = 0.04\n', encoding="utf-8")
    mine = fp.vehicle(tmp_path / "mine.toml")
    assert mine == HEHN.replace(mass=0.6, body={"hub_radius": 0.04})
    assert fp.Vehicle.from_toml(str(tmp_path / "mine.toml")) == mine
    below = tmp_path / "below"
    below.mkdir()
    (below / "again.toml").write_text('base = "../mine.toml"\nbob_mass = 0.06\n', encoding="utf-8")
    assert fp.vehicle(below / "again.toml") == mine.replace(bob_mass=0.06)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('base = "hehn2012"', r"^vehicle\.base: expected one of .*'hehn2012' \(did you mean 'hehn2011'\?\)"),
        ("base = 3", r"^vehicle\.base: expected one of .*got 3"),
        ('base = "none.toml"', r"none\.toml: expected a readable TOML file"),
        ('base = "mine.toml"', r"^vehicle\.base: expected a file that is not based on itself"),
        ('base = "hehn2011"\nmas = 1', r"^vehicle\.mas: expected one of .*'mas' \(did you mean 'mass'\?\)"),
        ('base = "hehn2011"\nmass = 500', r"^vehicle\.mass: .*in g\? write 0\.5"),
        ('base = "hehn2011"\nbody = 3', r"^vehicle\.body: expected a Body, or its fields as a dict, got 3"),
        ("mass = 1\n[body]", r"^vehicle\.bob_mass: expected a number: mass of the rod .*kg"),
        ('base = "nayak2018"\n[body]\nhub_radius = 1.0', r"^vehicle\.body"),
    ],
)
def test_a_base_that_does_not_fit_is_one_line(tmp_path, text, message):
    (tmp_path / "mine.toml").write_text(text, encoding="utf-8")
    with pytest.raises(fp.InputError, match=message) as caught:
        fp.vehicle(tmp_path / "mine.toml")
    assert "\n" not in str(caught.value)


def test_what_is_missing_is_told_with_shape_and_unit():
    numbers = HEHN.to_dict()
    for field, words in (("inertia", ("(3,) or (3, 3)", "kg m²")), ("rotor_positions", ("(n, 3)", "m"))):
        with pytest.raises(fp.InputError) as caught:
            fp.Vehicle.from_dict({key: value for key, value in numbers.items() if key != field})
        assert caught.value.field == f"vehicle.{field}"
        assert all(word in caught.value.expected for word in words)
    with pytest.raises(
        fp.InputError, match=r"^body\.disc_radius: expected disc_radius, arm_radius, hub_radius, .* m, "
    ):
        HEHN.replace(body=None).replace(body={})
