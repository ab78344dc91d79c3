"""The exported board: against Python's, in flight, where it refuses, and how it goes on."""

import re
from dataclasses import replace

import numpy as np
import pytest
from boards import hexarotor
from numpy.random import default_rng

import flypend as fp
from flypend.board.computer import SteppedBoard
from flypend.board.program import initial_memory
from flypend.export import compiled, records, vectors
from flypend.export.interface import interface
from flypend.export.library import CompiledBoard, library
from flypend.export.write import core
from flypend.flight import request
from flypend.laws.references import circle
from flypend.model.state import FLIP_PACKED
from flypend.plants.equations import EquationsEngine
from flypend.plants.loop import Loop
from flypend.plants.plant import Sampled
from flypend.plants.sensors import sensors_called
from tests.few import each_once, slow

VEHICLES = {name: fp.vehicle(name) for name in ("hehn2011", "crazyflie")}
VEHICLE = VEHICLES["hehn2011"]
VEHICLES["prompt"] = VEHICLE.replace(rotor_lag=0.0)
LAW = fp.laws.inverted()  # one, which is compiled once
INVERTED = LAW.bind(VEHICLE)
OK, NULL, NOT_FINITE, ROD, ATTITUDE, PARAMS, SINGULAR, WRONG_VEHICLE, NOT_BEGUN = range(9)
START = fp.State.random(default_rng(3))
LEAST, LARGEST = VEHICLE.rotor_limits


def board(precision="double", rate=500.0, law=INVERTED, vehicle=VEHICLE):
    return CompiledBoard(library(law, vehicle, precision, rate))


# Numbers --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("machine", "name", "rate"),
    [
        ("crazyflie", "inverted", 300.0), ("hehn2011", "light", 100.0), ("crazyflie", "corrected", 500.0),
        ("hehn2011", "learned", 500.0), ("prompt", "corrected", 500.0), slow("hehn2011", "inverted", 500.0),
        slow("hehn2011", "lqr", 100.0),
    ],
)  # fmt: skip
def test_it_commands_what_the_board_of_python_commands(machine, name, rate):
    vehicle = VEHICLES[machine]
    law = LAW if name == "inverted" else fp.laws.inverted(form="light") if name == "light" else getattr(fp.laws, name)()
    bound = law.bind(vehicle)
    loop = Loop(vehicle, bound, Sampled(rate=rate))
    steps = 30
    for precision, limit in (("double", 1e-12), ("float", 1e-4)):
        wanted = vectors.flights(loop, 3, steps, 5, precision)
        for flight in range(3):
            code = board(precision, rate, bound, vehicle)
            for i in range(flight * steps, (flight + 1) * steps):
                rotors = code.step(wanted.measurement[i], wanted.path[i])
                assert code.status == OK
                assert np.linalg.norm(rotors - wanted.rotors[i]) < limit * vehicle.weight
    assert np.ptp(wanted.rotors) > 0.1 * vehicle.weight / 4  # far from constant


def test_six_rotors_a_full_inertia_matrix_and_other_numbers_at_run_time():
    vehicle = hexarotor(VEHICLE)
    other = vehicle.replace(mass=0.7, bob_mass=0.06, drag_ratio=0.02, rotor_limits=(0.1, 3.0))
    law = fp.laws.inverted().bind(vehicle)
    changed = replace(fp.laws.inverted().bind(other), computer=law.computer)  # whose numbers are constants of the code
    wanted = vectors.flights(Loop(other, changed, Sampled()), 1, 30, 2, "double")
    code = library(law, vehicle, "double")
    code.params[:] = records.params_of(other)
    code.gains[:] = [changed.numbers[field.name] for field in code.made.gains.fields]
    made = CompiledBoard(code)
    rotors = np.array([made.step(m, p) for m, p in zip(wanted.measurement, wanted.path, strict=True)])
    assert made.status == OK
    assert np.max(np.abs(rotors - wanted.rotors)) < 1e-11


def test_one_program_is_one_function_however_often_it_is_called():
    told, slow = (fp.laws.inverted(latency=latency, delay_reach=0).bind(VEHICLE) for latency in (0.024, 0.075))
    for law, steps in ((INVERTED, 0), (told, 1), (slow, 3)):
        routine = interface(law, VEHICLE).board
        calls = [routine.programs[call.program].name for call in routine.calls]
        assert sum(name.startswith("twin") for name in calls) == steps
        assert len(set(calls)) == len(routine.programs)
        assert (len(calls) > len(routine.programs)) == (steps > 1)


# Flights --------------------------------------------------------------------------------------------------------


def _apart(one, other):
    assert str(one.outcome) == str(other.outcome)
    names = ("x", "x_dot", "R", "omega", "y", "y_dot", "rotor_forces")
    return max(float(np.max(np.abs(getattr(one, name) - getattr(other, name)))) for name in names)


WINDY = fp.Plant(wind=fp.Wind(on_vehicle=(0.3, 0, 0), on_bob=(0, 0.1, 0)), rate=200.0, delay=0.01)
# A path of eight derivatives is shifted over the latency as far as they tell, and its snap least of all, which the
# thrust axis follows; hover is exact.
MOVING = fp.laws.inverted(circle(0.5, 1.5), form="light")


@pytest.mark.parametrize(
    ("law", "plant", "limit"),
    [
        (LAW, "mujoco", 1e-9), (LAW, "rotors", 1e-9), (LAW, WINDY, 1e-9),
        (fp.laws.corrected(), "rotors", 1e-9), (MOVING, "rotors", 1e-3),
    ],
)  # fmt: skip
def test_it_flies_as_the_kernel_does(law, plant, limit):
    kernel = fp.simulate(VEHICLE, law, START, 4.0, plant=plant)
    flown = fp.simulate(VEHICLE, compiled(law, VEHICLE), START, 4.0, plant=plant)
    assert _apart(kernel, flown) < limit
    assert flown.law == f"{law.name}-c"


def test_a_machine_whose_rotors_push_less_than_asked_flies_its_code():
    machine = VEHICLE.replace(thrust_scale=0.93)
    in_c, law = (fp.simulate(machine, law, START, 0.2) for law in (compiled(LAW, machine), LAW))
    np.testing.assert_allclose(in_c.x, law.x, atol=1e-9)


def test_nothing_of_the_flight_computer_is_left_in_python(monkeypatch):
    def no(*_):
        raise AssertionError("Python computed a command")

    monkeypatch.setattr(SteppedBoard, "command", no)
    run = fp.simulate(VEHICLE, compiled(LAW, VEHICLE), START, 0.2)
    assert run.outcome.status == "completed"


def test_single_precision_inverts_as_well():
    python = fp.simulate(VEHICLE, fp.laws.inverted(), START, 4.0, plant="mujoco")
    run = fp.simulate(VEHICLE, compiled(LAW, VEHICLE, "float"), START, 4.0, plant="mujoco")
    assert 1e-9 < _apart(python, run) < 1e-3  # another precision, the same flight
    assert np.max(np.abs(run.y[-20:] - [0, 0, 1])) < 0.05


@pytest.mark.parametrize("plant", ["rotors", slow("mujoco")])
def test_the_crazyflie_stands_inverted_by_the_exported_c_alone(plant):
    vehicle = VEHICLES["crazyflie"]
    starts = fp.State.random(default_rng(2024), 6)
    runs = fp.simulate_ensemble(vehicle, compiled(LAW, vehicle, "float"), starts, 8.0, plant=plant, workers=1)
    assert runs.rate == 1.0


def test_a_refused_state_ends_a_flight_as_singular(monkeypatch):
    monkeypatch.setattr(request, "MOST_SPIN", np.inf)  # a flight refuses such a start before the C does
    start = fp.State(y=(0, 0, 1), omega=(1e20, 1e20, 0))  # ω × I ω overflows single precision
    run = fp.simulate(VEHICLE, compiled(LAW, VEHICLE, "float"), start, 0.1, plant="rotors")
    assert run.outcome.status == "singular"


def test_it_needs_rotors_within_limits_and_its_vehicle():
    flown = compiled(LAW, VEHICLE)
    for plant in ("ideal", "hehn2011", fp.Plant(limits=False)):
        with pytest.raises(fp.InputError, match="plant: expected rotor forces within limits"):
            fp.simulate(VEHICLE, flown, START, 0.1, plant=plant)
    with pytest.raises(fp.InputError, match="vehicle: expected hehn2011, which the law was compiled for"):
        fp.simulate(VEHICLE.replace(mass=1.0), flown, START, 0.1, plant="rotors")
    with pytest.raises(fp.InputError, match="law: expected a Law"):
        compiled(flown, VEHICLE)


# Where it refuses -----------------------------------------------------------------------------------------------


def _measurement(seed=7):
    return fp.State.random(default_rng(seed)).packed().copy()


def _broken(name):
    measurement, path = _measurement(), np.zeros(27)
    match name:
        case "rod":
            measurement[18:21] *= 1.001
        case "position":
            measurement[0] = np.nan
        case "path":
            path[3] = np.inf
        case "rates":
            measurement[16] = np.nan
        case "attitude":
            measurement[6:15] *= -1
        case "everything":
            measurement[:] = np.nan
    return measurement, path


@pytest.mark.parametrize(
    ("name", "status", "levels"),
    [
        ("rod", ROD, True), ("position", NOT_FINITE, True), ("path", NOT_FINITE, True), ("rates", NOT_FINITE, False),
        ("attitude", ATTITUDE, False), ("everything", NOT_FINITE, False),
    ],
)  # fmt: skip
@pytest.mark.parametrize("precision", ["double", "float"])
def test_the_safe_command_levels_where_the_attitude_can_be_trusted(name, status, levels, precision):
    made = board(precision)
    rotors = made.step(*_broken(name))
    assert made.status == status
    if levels:
        assert np.ptp(rotors) > 0.01
        assert np.all((rotors >= LEAST - 1e-6) & (rotors <= LARGEST + 1e-6))
    else:
        assert np.allclose(rotors, LEAST)


@pytest.mark.parametrize(("machine", "late"), each_once(VEHICLES, (False, True)))
def test_without_a_rod_to_be_seen_the_vehicle_levels_out_and_carries_its_weight(machine, late):
    vehicle = VEHICLES[machine]
    law = LAW.bind(vehicle)
    delay = round(law.computer.latency * 500) if late else 0
    for seed in range(3):
        made, engine = board(law=law, vehicle=vehicle), EquationsEngine(vehicle)
        start, idle = fp.State.random(default_rng(seed)), np.full(4, vehicle.rotor_limits[0])
        engine.reset(fp.State(R=start.R, omega=start.omega, y=(0, 0, -1)).packed(), idle)
        under_way, falling = [idle] * delay, []
        for _ in range(1750):
            under_way.append(made.step(np.append(engine.packed[:18], np.full(6, np.nan))))
            assert made.status == NOT_FINITE
            engine.step(under_way.pop(0), 2e-3, np.zeros(6))
            state = fp.State.from_packed(engine.packed)
            falling.append(state.x_dot[2] + vehicle.m / (vehicle.M + vehicle.m) * vehicle.l * state.y_dot[2])
        assert state.z[2] > 0.999
        assert np.linalg.norm(state.omega) < 0.1
        assert np.ptp(falling[1500:]) < 0.01  # the centre of mass keeps the speed that turning over cost


def test_a_dropout_in_flight_is_survived():
    made, engine, idle = board(), EquationsEngine(VEHICLE), np.full(4, LEAST)
    engine.reset(fp.State(y=(0, 0, 1)).packed(), idle)
    wind = np.array([0.3, 0, 0, 0, 0.02, 0])
    nominal, unknown = [], made.code.made.memory.place("observer.unknown").start
    for k in range(2500):
        measured = engine.packed.copy()
        if 1500 <= k < 1515:  # 30 ms
            measured[18] = np.nan
        rotors = made.step(measured)
        assert (made.status == OK) == (not 1500 <= k < 1515)
        engine.step(rotors, 2e-3, wind)
        nominal.append(made.memory[unknown : unknown + 3].copy())  # the estimate of the sum of the forces
    assert np.allclose(nominal[1499], wind[:3] + wind[3:], atol=0.05)
    assert np.allclose(nominal[1515], nominal[1499], atol=0.05)  # kept over the gap, not begun from nothing
    assert fp.State.from_packed(engine.packed).y[2] > 0.98


def test_after_a_refusal_it_remembers_the_command_that_was_given():
    made, n = board(), 4
    for _k in range(20):
        made.step(_measurement(), np.zeros(27))
    before = made.memory.copy()
    safe = made.step(_broken("rod")[0])
    assert made.status == ROD
    first = made.code.made.memory.place("commands").start
    assert np.array_equal(made.memory[first : first + n], safe)
    lag = np.exp(-2e-3 / VEHICLE.rotor_lag)  # its rotor model is at the command's own time, before the delay
    assert np.allclose(made.memory[:n], safe + (before[:n] - safe) * lag, rtol=1e-12)
    assert np.all(np.isfinite(made.memory))


def test_a_period_without_a_call_repeats_the_last_command():
    made, n = board(), 4
    last = made.step(_measurement())
    made.step(_measurement(8))
    table = made.code.made.memory
    first, observer, finding, found = (
        table.place(name).start for name in ("commands", "observer.begun", "delay.begun", "delay.found")
    )
    last, delay = made.memory[first : first + n].copy(), made.memory[found]
    assert made.code.call("flypend_board_pass", made.numbers) == OK
    assert np.array_equal(made.memory[first : first + n], last)
    assert made.memory[observer] == made.memory[finding] == 0  # observer and delay estimator begin anew
    assert made.memory[found] == delay


@pytest.mark.parametrize("sensors", [None, "onboard"])
def test_the_header_says_where_each_part_of_the_memory_lies(sensors):
    made = interface(INVERTED, VEHICLE, 500.0, sensors_called(sensors, "sensors"))
    file, prefix = ("flypend_law.h", "MEMORY") if sensors is None else ("flypend_sensors.h", "SENSORS_MEMORY")
    memory = made.memory if sensors is None else made.sensing.memory
    told = {
        name: int(where)
        for name, where in re.findall(rf"#define FLYPEND_{prefix}(\w*) (\d+)", core(made, "double")[file])
    }
    places = {f"_{path.replace('.', '_').upper()}": place.start for path, _, place in memory.leaves()}
    assert told == {"": memory.length, **places}
    assert "_DELAY_FOUND" in told
    assert ("_ESTIMATE_COVARIANCE" in told) == (sensors is not None)
    begun = np.asarray(initial_memory(made.loop, np.full(4, LEAST))).ravel()
    assert sensors or list(begun[told["_COMMANDS"] : told["_COMMANDS"] + 4]) == [LEAST] * 4


def test_no_measurement_no_board_no_params_are_refused_and_answered():
    made, rotors = board(), np.full(4, np.nan)
    assert np.allclose(made.step(None), LEAST)
    assert made.status == NULL
    code = made.code
    for arguments in ([None] * 4, [None, _measurement(), np.zeros(27), code.params]):
        rotors[:] = np.nan
        assert code.call("flypend_board_step", *arguments, rotors) == NULL
        assert np.all(np.isfinite(rotors))
    assert code.call("flypend_board_step", *[None] * 5) == NULL
    assert code.call("flypend_board_begin", None, code.gains, code.params) == NULL
    assert code.call("flypend_board_pass", None) == NULL


def test_a_board_that_was_not_begun_is_refused():
    made, blank, rotors = board(), np.zeros(10_000, np.uint8), np.empty(4)
    arguments = (_measurement(), np.zeros(27), made.code.params, rotors)
    assert made.code.call("flypend_board_step", blank, *arguments) == NOT_BEGUN
    assert np.all(rotors >= LEAST)
    other = library(INVERTED, VEHICLE, "double", 250.0)  # a board of the same law at another rate
    assert other.call("flypend_board_step", made.numbers, *arguments) == NOT_BEGUN
    made.step(*_broken("rod"))
    assert made.status == ROD
    made.memory[5] += 1e-9
    with_rod, level = made.step(_measurement()), board()
    assert made.status == NOT_BEGUN
    assert np.allclose(
        with_rod, level.step(_broken("rod")[0])
    )  # it levels out: a broken rod says nothing of the attitude
    assert made.code.call("flypend_board_pass", made.numbers) == NOT_BEGUN


@pytest.mark.parametrize("precision", ["double", "float"])
def test_no_measurement_however_wild_spoils_the_memory_for_good(precision):
    """Of good periods after it, all but the first few are flown."""
    rng, largest = default_rng(4), float(np.finfo(np.float64 if precision == "double" else np.float32).max)
    good = fp.State(x=(0.01, 0, 0), y=(0, 0.28, 0.96)).packed()
    for _ in range(300):
        made = board(precision)
        for _ in range(5):
            made.step(good)
        for _ in range(3):
            wild = good.copy()
            wild[[0, 1, 2, 3, 4, 5, 15, 16, 17]] *= 0
            places = rng.choice([0, 1, 2, 3, 4, 5, 15, 16, 17], 3)
            wild[places] = rng.choice([-1, 1], 3) * largest ** rng.uniform(0, 1, 3)
            made.step(wild)
        flown = []
        for _ in range(40):
            made.step(good)
            flown.append(made.status)
        assert set(flown) <= {OK, SINGULAR}
        assert flown[-20:] == [OK] * 20


def test_gains_are_changed_by_the_function_for_it_only():
    made, other = board(), board()
    softer = made.code.gains * 0.9
    assert made.code.call("flypend_board_set_gains", made.numbers, softer) == OK
    measured = fp.State(x=(0.01, 0, 0), y=(0, 0.28, 0.96)).packed()
    assert not np.allclose(made.step(measured), other.step(measured))
    assert made.status == OK
    made.numbers[8:16] = np.array([made.code.gains[0]]).view(np.uint8)  # past mark and check
    made.step(_measurement())
    assert made.status == NOT_BEGUN


@pytest.mark.parametrize("plant", ["rotors", "mujoco"])
def test_a_memory_that_is_damaged_in_flight_begins_again(plant, monkeypatch):
    """As adapters do: a period of the safe command, then the law, from the rotor forces of that command."""
    flown = []

    def struck(self, t, measured, command=CompiledBoard.command):
        if round(t * 500) in (300, 301, 700, 1200):
            self.memory[len(flown) % len(self.memory)] += 0.5
            flown.append(t)
        return command(self, t, measured)

    monkeypatch.setattr(CompiledBoard, "command", struck)
    run = fp.simulate(VEHICLE, compiled(LAW, VEHICLE), START, 6.0, plant=plant)
    assert run.outcome.status == "completed"
    assert len(flown) == 4
    assert np.min(run.y[-20:, 2]) > 0.99


def _field(word):
    """A check word after one more word, as the header tells: h ↦ R L (h ^ word)."""
    h = word
    for shift in (5, 7):
        h ^= (h << shift) & 0xFFFFFFFF
    return h ^ h >> 9


@pytest.mark.parametrize("precision", ["double", "float"])
def test_the_check_word_is_what_its_comment_says(precision):
    """One orbit of 2³² − 1 words, so a product in a field; L lowers no bit and R raises none."""
    made = board(precision)
    end = int(made.code.c.flypend_board_memory()) + made.memory.nbytes
    words = made.numbers[:end].view(np.uint32).tolist()
    h = words[0]
    for word in words[2:]:
        h = _field(h ^ word)
    assert h == words[1]
    basis = [_field(1 << i) for i in range(32)]
    step = np.array([[column >> row & 1 for column in basis] for row in range(32)], np.int64)

    def power(n):
        found, square = np.eye(32, dtype=np.int64), step
        while n:
            found, square, n = (found @ square % 2 if n & 1 else found), square @ square % 2, n >> 1
        return found

    order = 2**32 - 1
    assert np.array_equal(power(order), np.eye(32))
    assert not any(np.array_equal(power(order // prime), np.eye(32)) for prime in (3, 5, 17, 257, 65537))
    for bits in range(32):  # the last bits of a word and the first of the next, 32 in a row
        assert _is_invertible(step[bits:, bits:])
    moved = basis
    for _ in range(1000):  # two bits, up to so many words apart
        assert all(word & (word - 1) for word in moved)
        moved = list(map(_field, moved))


def _is_invertible(matrix):
    """Whether a matrix of bits is, by elimination modulo 2."""
    m = matrix.copy() % 2
    for i in range(len(m)):
        pivot = i + int(np.argmax(m[i:, i]))
        m[[i, pivot]] = m[[pivot, i]]
        if not m[i, i]:
            return False
        m[i + 1 :] ^= np.outer(m[i + 1 :, i], m[i])
    return True


def test_a_vehicle_with_other_spins_stops_the_rotors():
    turned = VEHICLE.replace(rotor_spins=-VEHICLE.rotor_spins)
    code = library(INVERTED, VEHICLE, "double")
    made, params = CompiledBoard(code), records.params_of(turned)
    rotors = np.full(4, np.nan)
    blank = np.zeros(10_000, np.uint8)
    assert code.call("flypend_board_begin", blank, code.gains, params) == WRONG_VEHICLE
    assert code.call("flypend_board_step", made.numbers, _measurement(), np.zeros(27), params, rotors) == WRONG_VEHICLE
    assert np.array_equal(rotors, np.zeros(4))


def test_a_law_with_the_other_third_axis_is_flown_in_its_own():
    law = fp.laws.corrected().bind(VEHICLE)
    assert law.e3 == "down"
    made = board(law=law)
    state = _measurement()
    python = SteppedBoard(Loop(VEHICLE, law, Sampled()), np.full(4, LEAST))
    assert np.allclose(made.step(state), python.command(0.0, state), rtol=1e-12)
    assert not np.allclose(made.step(state * FLIP_PACKED), python.command(0.0, state), rtol=1e-2)
