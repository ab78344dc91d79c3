"""One thread at a time builds expressions."""

import sys
from concurrent.futures import ThreadPoolExecutor

import casadi as ca
import pytest

import flypend as fp
from flypend.building import building
from flypend.plants import SUITES


def fly_on_sensors(vehicle):
    fp.simulate_ensemble(
        vehicle, fp.laws.inverted(), fp.random_starts(2, 1), 0.5, plant=fp.Plant(sensors=SUITES["mocap"])
    )


@pytest.mark.parametrize(
    "call",
    [
        lambda vehicle: fp.linearise(fp.laws.lqr(), vehicle),
        lambda vehicle: fp.simulate(vehicle, fp.laws.repaired(), fp.random_starts(1, 1)[0], 0.2),
        fly_on_sensors,
        lambda vehicle: fp.plan(vehicle, fp.State(y=[0.6, 0, 0.8]), duration=1.0),
    ],
    ids=["linearise", "simulate", "fly on sensors", "plan"],
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
