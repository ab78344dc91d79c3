"""One thread at a time builds expressions."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import casadi as ca
import pytest

import flypend as fp
from flypend.building import building, no_numbers
from flypend.plants import SUITES


def fly_on_sensors(vehicle):
    fp.simulate_ensemble(
        vehicle, fp.laws.inverted(), fp.random_starts(2, 1), 0.5, plant=fp.Plant(sensors=SUITES["mocap"])
    )


def lean(t, state, vehicle, *, k=2.0):
    return fp.Wrench(vehicle.weight, -k * state.omega)


@pytest.mark.parametrize(
    "call",
    [
        lambda vehicle: fp.linearise(fp.laws.lqr(), vehicle),
        lambda vehicle: fp.simulate(vehicle, fp.laws.repaired(), fp.random_starts(1, 1)[0], 0.2),
        fly_on_sensors,
        lambda vehicle: fp.laws.from_function(lean),
        lambda vehicle: fp.simulate(vehicle, fp.laws.lqr(), fp.State(y=(0.6, 0, 0.8)), 0.1).to_html(None, live=True),
        lambda vehicle: fp.plan(vehicle, fp.State(y=[0.6, 0, 0.8]), duration=1.0),
    ],
    ids=["linearise", "simulate", "fly on sensors", "wrap a function", "write a page", "plan"],
)
def test_expressions_are_built_by_one_thread_at_a_time(call):
    # CasADi crashes, once in a hundred times, if two threads build: what a thread builds, it builds under the lock.
    without = set()

    def profile(frame, event, _):
        code = frame.f_code
        symbolic = event == "call" and code.co_filename.endswith("casadi.py")
        symbolic = symbolic and any(isinstance(value, ca.SX) for value in frame.f_locals.values())
        if symbolic and not building._is_owned():
            without.add(f"{frame.f_back.f_code.co_qualname}: {code.co_qualname}")

    def watched():
        sys.setprofile(profile)
        call(fp.vehicle("hehn2011").replace(mass=0.5017))  # nothing of this vehicle is built yet

    with ThreadPoolExecutor(1) as pool:
        pool.submit(watched).result()
    assert not without


def test_a_process_that_is_forked_while_another_thread_builds_builds_too():
    program = """
import multiprocessing, threading, time
from flypend.building import building, builds

held = threading.Event()

def hold():
    with building:
        held.set()
        time.sleep(0.3)

@builds
def job(number):
    return number + 1

threading.Thread(target=hold).start()
held.wait()
with multiprocessing.get_context("fork").Pool(1) as pool:
    print(*pool.map_async(job, [6]).get(timeout=20))
"""
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
    assert told.stdout == "7\n", told.stderr


def test_a_symbol_is_no_number_where_branches_would_be_lost():
    symbol = ca.SX.sym("x")
    with no_numbers():
        assert float(ca.SX(2.0)) == 2.0
        with pytest.raises(TypeError):
            float(symbol)
    assert float(symbol) != float(symbol)  # NaN
