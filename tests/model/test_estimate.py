"""A vehicle from its parts: bands hold what others identified, units are asked back, and every guess has a source."""

import re
from importlib import resources

import numpy as np
import pytest

import flypend as fp
from flypend.errors import InputError
from flypend.files.toml import parse_toml
from flypend.model.estimate import (
    AIR,
    MERIT,
    THRUST_BAND,
    THRUST_COEFFICIENT,
    TORQUE,
    TORQUE_BAND,
    Measured,
    guess,
    parts,
)

MINE = {
    "mass": "620 g", "arm": "17 cm", "propeller": "8x4.5", "motor": "920 KV", "battery": "3S", "rod_length": 0.9,
    "rod_mass": 0.03, "bob_mass": "40 g",
}  # fmt: skip
BARE = {"motor": None, "battery": None}
# Machines of the package whose numbers come from elsewhere: parts, and what lies outside its band, for a reason.
FLOWN = {
    "crazyflie": ({"propeller": "45mm", "motor": "14000 KV", "battery": "1S"}, {}),
    "crazyflie-brushless": ({"propeller": "55mm", "motor": "10000 KV", "battery": "1S"}, {}),
    "hummingbird": ({"propeller": "8x4.5"}, {"rotor_lag": "RotorPy takes 5 ms, a fifth of other motors"}),
    "x500": (
        {"propeller": "1045", "motor": "920 KV", "battery": "4S"},
        {"drag_ratio": "several times that of a propeller on a stand, as the vehicle's file says"},
    ),
}


@pytest.mark.parametrize("name", FLOWN)
def test_bands_hold_the_numbers_that_others_identified(name):
    parts, outside = FLOWN[name]
    true = fp.vehicle(name)
    arm = float(np.linalg.norm(true.rotor_positions[0]))
    found = fp.Vehicle.estimate(mass=true.mass, arm=arm, rod_length=true.reach, rod_mass=true.bob_mass, **parts)
    truth = {"inertia": np.diag(true.inertia), **{one: getattr(true, one) for one in ("drag_ratio", "rotor_lag")}}
    truth["rotor_limits"] = true.rotor_limits
    if true.air is not None:
        truth["rotor_drag"] = true.air.rotor_drag
    missed = set()
    for field, value in truth.items():
        low, high = (np.array(end) for end in found.bands[field])
        if not np.all((low <= value) & (value <= high)):
            missed.add(field)
    assert missed == set(outside)


def test_the_torque_ratio_is_that_of_momentum_theory():
    """Torque is power over speed, and power the ideal T √(T/2ρA) over the figure of merit, whatever size and speed."""
    diameter, turns = 0.23, 90.0  # m, 1/s
    thrust = THRUST_COEFFICIENT * AIR * turns**2 * diameter**4
    power = thrust * np.sqrt(thrust / (2 * AIR * np.pi * diameter**2 / 4)) / MERIT
    assert pytest.approx(TORQUE * diameter, rel=1e-12) == power / (2 * np.pi * turns) / thrust


@pytest.mark.parametrize("name", parts()["propellers"])
def test_propellers_in_the_table_lie_within_the_band_of_those_that_are_not(name):
    part = parts()["propellers"][name]
    general = THRUST_COEFFICIENT * AIR * part["diameter"] ** 4 / (4 * np.pi**2)
    assert 1 / THRUST_BAND <= part["thrust_constant"] / general <= THRUST_BAND
    assert 1 / TORQUE_BAND <= part["drag_ratio"] / (TORQUE * part["diameter"]) <= TORQUE_BAND


def test_coefficients_of_a_propeller_give_its_constants():
    """Thrust C_T ρ n² D⁴ and torque C_P ρ n² D⁵/2π, of the coefficients that stand beside the constants."""
    text = (resources.files("flypend") / "model" / "parts.toml").read_text(encoding="utf-8")
    tables = re.findall(r'propellers\."([^"]+)"\](?:.|\n)+?C_T = ([\d.]+)(?:.|\n)+?C_P = ([\d.]+\d)', text)
    assert len(tables) >= 4
    for name, thrust, power in tables:
        part, c_t, c_p = parts()["propellers"][name], float(thrust), float(power)
        wanted = c_t * AIR * part["diameter"] ** 4 / (4 * np.pi**2), c_p * part["diameter"] / (2 * np.pi * c_t)
        np.testing.assert_allclose((part["thrust_constant"], part["drag_ratio"]), wanted, rtol=1e-3)  # four digits


def test_a_motor_with_its_speed_in_its_name_has_that_speed():
    for name, part in parts()["motors"].items():
        if (number := name.rpartition("-")[2]).isdigit() and "lag" not in part:
            assert part["kv"] == int(number), name


def test_units_and_names_mean_the_same_as_numbers():
    plain = {**MINE, "mass": 0.62, "arm": 0.17, "propeller": 8 * 0.0254, "battery": 3 * 3.7, "bob_mass": 0.04}
    assert fp.Vehicle.estimate(**plain) == fp.Vehicle.estimate(**MINE)
    named = fp.Vehicle.estimate(**{**MINE, "propeller": "hummingbird"})
    assert named.drag_ratio == 0.0244  # of the table, not of the scaling law
    assert fp.Vehicle.estimate(**{**MINE, "propeller": "0845"}) == fp.Vehicle.estimate(**MINE)


def test_the_text_is_the_vehicle_with_a_source_for_every_number():
    found = guess(Measured(**MINE))
    table = parse_toml("mine", found.text())
    assert fp.Vehicle.from_dict(table) == fp.Vehicle.estimate(**MINE)
    without = {name for name in table if name not in found.sources}
    assert without == {"name", "gravity", "mount"}
    unknown = {"gravity", "rod_end", "rod_inertia", "rotor_positions", "rotor_spins"}  # measured, or of what is banded
    banded = {name for name in table if name not in ("name", "mount", "body", "air", "bands")} - unknown
    assert banded <= set(table["bands"])


def test_bands_are_taken_as_known_before_by_identification():
    from flypend.identification.fit import search_from
    from flypend.identification.model import places

    mine = fp.Vehicle.estimate(**MINE)
    search = search_from(mine, pwm=False, accelerometer=True)
    at = places(search.table)
    assert search.spread[at["lag"]] == pytest.approx(np.log(2.2) / 1.96, rel=1e-3)
    assert search.spread[at["delay"]] == pytest.approx(0.025 / 1.96)
    assert search.guess[at["delay"]] == pytest.approx(0.025)
    plain = search_from(mine.replace(bands=None), pwm=False, accelerometer=True)
    assert plain.spread[at["delay"]] == 0.02


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"mass": 620}, r"mass: expected .* \(in g\? write 620g\)"),
        ({"arm": 170}, "in mm. write 170mm"),
        ({"arm": "17 furlongs"}, "m, cm, mm, in"),
        ({"propeller": 8}, "10x4.5"),
        ({"propeller": "99x4"}, "propeller"),
        ({"motor": None}, "motor that goes with the battery"),
        ({"battery": None}, "battery that goes with the motor"),
        ({"motor": "fast"}, "920 KV"),
        ({"mass": "5 kg"}, "thrust: expected at least 12.4 N"),
        ({"thrust": 820, **BARE}, r"thrust: expected 1\.5.* times its share of .*820 N \(in gf\? write 820gf\)"),
        ({"thrust": 0.82, **BARE}, r"\(in kgf\? write 0\.82kgf\)"),
        ({"motor": "9200 KV"}, "at most 20 times the weight"),
        ({"inertia": [5000, 5000, 9000]}, r"in kg·mm²\? write 0.005"),
        ({"rotors": 5}, "an even number"),
        ({"rod_mass": 0, "bob_mass": 0}, "the mass of the rod"),
        ({"rod_length": -1}, "rod_length"),
        ({"bob_mass": 5, "rod_length": "12 cm"}, r"bob_mass: .*machine's 0.62 kg.* \(in g\? write 5g\)"),
        ({"bob_mass": "5 kg", "thrust": 20, **BARE}, "bob_mass: .*machine's 0.62 kg"),
        ({"bob_mass": "620 g"}, "rod and bob"),  # each is allowed
        ({"rod_mass": "0.01 g", "bob_mass": 0}, "0.00062 to 0.62 kg of rod and bob"),
        ({"rod_length": "12 m"}, r"rod_length: expected 0.085 to 8.5 m \(0.5 to 50 times the arm of 0.17 m"),
        ({"rod_length": "6 cm"}, "rod_length: expected 0.085"),
        ({"arm": "1.7 m"}, "arm: .* at most 5 diameters of the propeller, 1.02 m"),
        ({"propeller": "20mm", **BARE}, "arm: .* at most 5 diameters"),
        ({"mass": "62 kg", **BARE}, "at most 97.3 N from a propeller of 0.203 m.* mass is 62 kg"),
        ({"mass": "2 kg", "arm": "3 cm", "propeller": "2x1", **BARE}, "below the speed of sound"),
        ({"inertia": [1, 1, 1]}, "inertia: expected 0.00036 to 0.18 .*0.0045 is common, got 1 and 1$"),
        ({"inertia": [1e-6, 1e-6, 2e-6]}, "inertia: expected 0.00036"),
        ({"inertia": [5e-3, 5e-3, 5e-4]}, "yaw at least 0.2 of the larger"),
    ],
)
def test_nonsense_is_refused_with_what_would_be_plausible(changes, said):
    with pytest.raises(InputError, match=said):
        fp.Vehicle.estimate(**{**MINE, **changes})
