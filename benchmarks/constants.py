"""What each number of the inverted law is worth: `python -m benchmarks.constants [vehicles] [starts] [seed]`.

Each is taken out alone: set to the value that is named beside it. Then the same vehicles fly from the same starts under
the rotors plant: hehn2011 and `vehicles` random ones that flip their rods, nayak2018 and as many that pump. A row has
the successes, and the p95 of the distance over that with everything in place (geometric mean over the vehicles).
The random vehicles are of `benchmarks.vehicles`, with a lag of at most half of √(l/g).
"""

import sys
from contextlib import ExitStack, contextmanager
from importlib import import_module
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np

import flypend as fp
from benchmarks.vehicles import DURATION, numbers, random_vehicle
from flypend.laws import axis, inverted_gains, throw
from flypend.laws.gain import Gain
from flypend.laws.inverted_gains import GAINS, NUMBERS, PUMPING, Scales
from flypend.laws.throw import bob_path
from flypend.studies.starts import random_starts

inverted = import_module("flypend.laws.inverted")
MOST_LAG = 0.5  # √(l/g): beyond this whatever one changes decides about a vehicle

# Constants of the equations, which here become gains, so that one compiled law flies all rows.
OPEN = {
    "AXIS_LIFT": inverted, "AXIS_FLOOR": inverted, "ANTIPODE_PUSH": inverted, "ANTIPODE_FLOOR": inverted,
    "TURN": inverted, "SPUN": axis, "CIRCLING": throw, "PUMP_RATE": throw, "FAR_PULL": throw, "LEVEL_SHARE": throw,
    "FLIP_WIDTH": throw, "THRUST_SHARE": throw,
}  # fmt: skip
# Numbers of the law's own that are no gains.
OWN = ("haste", "shift")
# Those of the flight computer are constants of the compiled code.
COMPUTER = ("lead", "latency", "delay_reach", "observer")

# Row: (for all vehicles, what is changed).
ROWS = {
    "height_bandwidth = position_bandwidth": {"height_bandwidth": NUMBERS["position_bandwidth"]},
    "position_damping = 1": {"position_damping": 1.0},
    "rod_damping = 0.7": {"rod_damping": 0.7},
    "attitude_damping = 0.7": {"attitude_damping": 0.7},
    "rate_feedforward = 0": {"rate_feedforward": 0.0},
    "rate_feedforward = 1": {"rate_feedforward": 1.0},
    "coast_time = 0": {"coast": 1e-6},
    "throw_speed = 0": {"throw_speed": 0.0},
    "flip_speed = 0": {"flip_speed": 0.0},
    "flip_by_rod = 0": {"flip_by_rod": 0.0},
    "flip_by_height = 0": {"flip_by_height": 0.0},
    "hanging_share = 0": {"hanging_share": 0.0},
    "catch_time = 0": {"catch_time": 0.0},
    "catch_by_axis = 0": {"catch_by_axis": 0.0},
    "catch_within halved": {"catch_within": NUMBERS["catch_within"] / 2},
    "catch_width halved": {"catch_width": NUMBERS["catch_width"] / 2},
    "descent_limit = 0.9 g": {"descent": 0.9},
    "tilt_limit = π": {"tilt_limit": 3.14159},
    "yaw_damping = 0": {"yaw_damping": 0.0},
    "haste = 0": {"haste": 0.0},
    "shift = 0": {"shift": 0.0},
    "AXIS_LIFT = 0": {"AXIS_LIFT": 0.0},
    "AXIS_FLOOR = 0": {"AXIS_FLOOR": 1e-6},
    "ANTIPODE_PUSH = 0": {"ANTIPODE_PUSH": 0.0},
    "ANTIPODE_FLOOR = 0": {"ANTIPODE_FLOOR": 1e-6},
    "TURN = ∞": {"TURN": 1e3},
    "SPUN = ∞": {"SPUN": 1e3},
    "FAR_PULL = ∞": {"FAR_PULL": 1e3},
    "FLIP_WIDTH = 0": {"FLIP_WIDTH": 1e-3},
    "THRUST_SHARE = 1": {"THRUST_SHARE": 1.0},
    "CIRCLING = 0": {"CIRCLING": 0.0},
    "PUMP_RATE halved": {"PUMP_RATE": throw.PUMP_RATE / 2},
    "LEVEL_SHARE = ∞": {"LEVEL_SHARE": 1e3},
    "FEEDFORWARD = ∞": {"FEEDFORWARD": 1e3},
    "LEAST_ATTITUDE = 0": {"LEAST_ATTITUDE": 0.0},
    "LAG_SHARE = ∞": {"LAG_SHARE": 1e3},
} | {f"{name} of a vehicle that flips": {name: NUMBERS[name]} for name in PUMPING}  # fmt: skip


@contextmanager
def changed(changes):
    """Within it the law's pure numbers, and the constants of its gains, are those of `changes` where they are named."""
    own = Scales.numbers.fget
    fixed = {name: value for name, value in changes.items() if hasattr(inverted_gains, name)}
    with ExitStack() as stack:
        for name, value in fixed.items():
            stack.enter_context(patch.object(inverted_gains, name, value))
        stack.enter_context(patch.object(Scales, "numbers", property(lambda scales: {**own(scales), **changes})))
        yield


def control(t, state, vehicle, k, forces, *, path):
    """The law with the constants of `OPEN`, and its `OWN` numbers, taken from its gains `k`."""
    with ExitStack() as stack:
        for name, module in OPEN.items():
            stack.enter_context(patch.object(module, name, getattr(k, name)))
        own = k.mounting._replace(**{name: getattr(k, name) for name in OWN})
        return inverted.inverted_control(
            t, state, vehicle, SimpleNamespace(**vars(k) | {"mounting": own}), forces, path=path
        )


def open_law():
    """The inverted law, with a gain for each constant of its equations."""
    law = fp.laws.inverted()
    constants = [Gain(name, getattr(module, name)) for name, module in OPEN.items()]
    own = [Gain(name, lambda v, name=name: inverted_gains.scales(v).numbers[name]) for name in OWN]
    gains = [*GAINS.values(), *constants, *own]
    return fp.Law(
        name="inverted", e3="up", gains=gains, control=control, computer=law.computer, uses_forces=True,
        reference=law.reference, path=bob_path(law.reference), prepare=law.prepare,
    )  # fmt: skip


def gains_of(law, vehicle, changes):
    """The gains of `law` for `vehicle` after `changes`, but those that are constants of the compiled code."""
    with changed(changes):
        values = law.propose(vehicle)
    values |= {name: value for name, value in changes.items() if name in OPEN}
    return {name: value for name, value in values.items() if law.table[name].numeric and name not in COMPUTER}


def flown(vehicle, rows, starts):
    """Successes and distances (1 + rows, starts): as it is, then with each of `rows`; NaN where one changes nothing."""
    law = open_law()
    gains = [gains_of(law, vehicle, changes) for changes in ({}, *rows)]
    differing = [0] + [i for i, given in enumerate(gains) if given != gains[0]]
    many = starts[np.tile(np.arange(len(starts)), len(differing))]
    given = {name: np.repeat([gains[i][name] for i in differing], len(starts)) for name in gains[0]}
    found = fp.simulate_ensemble(vehicle, law, many, DURATION, plant="rotors", gains=given)
    success, distance = np.full((2, len(gains), len(starts)), np.nan)
    success[differing] = found.success.reshape(-1, len(starts))
    distance[differing] = found.excursion.reshape(-1, len(starts))
    return success, distance


def told(success, distance):
    """Of arrays (vehicles, rows, starts): one text per row."""
    far = np.log(np.percentile(distance, 95, axis=-1))
    ratio = np.exp(np.ma.masked_invalid(far - far[:, :1]).mean(axis=0).filled(0))
    missing = np.isnan(success).any(axis=-1)
    counts = np.where(missing[..., None], success[:, :1], success).sum(axis=(0, -1))
    same = missing.all(axis=0)
    return ["=" if s else f"{c:.0f}, {r:.2f}" for s, c, r in zip(same, counts, ratio, strict=True)]


def vehicles(count, seed):
    """hehn2011 and `count` random vehicles that flip, nayak2018 and `count` that pump."""
    groups = {True: [fp.vehicle("hehn2011")], False: [fp.vehicle("nayak2018")]}
    rng = np.random.default_rng(seed)
    while min(len(group) for group in groups.values()) <= count:
        vehicle = random_vehicle(rng)
        group = groups[inverted_gains.scales(vehicle).agile]
        if len(group) <= count and numbers(vehicle)[2] <= MOST_LAG:
            group.append(vehicle)
    return groups


def main():
    """Print the table."""
    count, runs, seed = (int(value) for value in (sys.argv[1:] + ["5", "24", "4041"][len(sys.argv) - 1 :]))
    starts, columns = random_starts(runs, seed), []
    for group in vehicles(count, seed).values():
        found = [flown(vehicle, list(ROWS.values()), starts) for vehicle in group]
        columns.append(told(*(np.array(values) for values in zip(*found, strict=True))))
    print(f"| | flip, of {(count + 1) * runs} | pump, of {(count + 1) * runs} |\n|---|---|---|")
    for name, *cells in zip(["everything in place", *ROWS], *columns, strict=True):
        print(f"| {name} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
