"""Flights with identified numbers: `python -m benchmarks.identified_flown [machines] [seed] [starts] [folder]`.

Vehicles of `benchmarks.vehicles`, from 0.03 to 5 kg. Each flies the manoeuvre of `identify` for 60 s in MuJoCo, guessed
wrong and with the gusts, noise, biases, delay, sag and unequal rotors of `benchmarks.identified`. Then the inverted law
flies the true machine from random starts with the sensors mocap: first with its true numbers, which shows what machine
and law allow, then believing what was identified. A machine is taken if the law flies it from 95 % of the starts with
true numbers; the others are counted, and of them those that the theory of tremor foretells. Machines whose result is
in the folder are not flown again.
"""

import json
import sys
from pathlib import Path

import numpy as np

import flypend as fp
from benchmarks.identified import LATENCY, around, logged
from benchmarks.vehicles import numbers, random_vehicle
from flypend.flight.metrics import wilson
from flypend.flight.request import bound_to
from flypend.identification.manoeuvre import rehearse
from flypend.plants.tremor import too_noisy
from flypend.studies.starts import random_starts

SECONDS, DURATION, WANTED = 60, 30.0, 0.95
FACTORS = ("mass", "bob_mass", "rod_length", "rod_inertia", "drag_ratio", "rotor_lag")


def rate(nominal, true, plant, scale, starts):
    """Return the share of the starts from which the inverted law, which believes in a vehicle, flies the true one.

    `scale` is the true thrust scale, which `plant.strength` leaves out. The inertia is off by one factor, of its roll
    and pitch moments.
    """
    wrong = {name: getattr(true, name) / value for name in FACTORS if (value := getattr(nominal, name))}
    wrong["inertia"] = float(np.mean(np.diag(true.inertia)[:2] / np.diag(nominal.inertia)[:2]))
    strength = tuple(scale / nominal.thrust_scale * np.array(plant.strength))
    moved = true.pivot_offset - nominal.pivot_offset
    world = plant.replace(
        sensors="mocap", noise=None, wind=None, mismatch=wrong, strength=strength, pivot_offset=moved,
    )  # fmt: skip
    return fp.simulate_ensemble(nominal, fp.laws.inverted(), starts, DURATION, plant=world).success


def flown(k, seed, count):
    """Return what came of machine `k`: its numbers and successes with true and with identified numbers."""
    rng = np.random.default_rng([seed, k])
    true = random_vehicle(rng)
    roll, yaw = true.inertia[0, 0], true.inertia[2, 2]
    true = true.replace(inertia=(roll, roll, min(yaw, 1.9 * roll)))  # a guess may have 5 % less of roll and pitch
    plant, scale, guess = around(true, rng)
    starts = random_starts(count, seed + 1000 + k)
    power, agility, lag = numbers(true)
    found = {"mass": true.mass, "rod": true.rod_length, "power": power, "agility": agility, "lag": lag}
    told = true.replace(thrust_scale=scale)
    try:
        known = rate(told, true, plant, scale, starts)
    except fp.InputError as error:
        return {**found, "refused": str(error)}
    noisy = too_noisy(bound_to(told, fp.laws.inverted()), plant.replace(sensors="mocap", noise=None))
    found |= {"known": int(known.sum()), "noisy": bool(noisy)}
    if known.mean() < WANTED:
        return found
    flying = plant.replace(engine="mujoco", strength=tuple(scale * np.array(plant.strength)))
    rehearsed = rehearse(guess, true, flying, duration=SECONDS, latency=LATENCY, bias=0.01, seed=seed + k)
    machine, spent = logged(rehearsed, guess)
    found["identified"] = int(rate(machine.vehicle, true, plant, scale, starts).sum())
    found["spent"] = spent
    return found


def main():
    """Fly machines until as many as are asked for have been taken; print what came of them."""
    wanted, seed, starts = (int(text) for text in (*sys.argv[1:4], *("20", "0", "50")[len(sys.argv[1:4]) :]))
    keep, taken, others, k = sys.argv[4:], [], [], 0
    while len(taken) < wanted:
        kept = Path(keep[0], f"{seed}-{k}-{starts}.json") if keep else None
        if kept and kept.exists():
            found = json.loads(kept.read_text(encoding="utf-8"))
        else:
            found = flown(k, seed, starts)
            if kept:
                kept.write_text(json.dumps(found), encoding="utf-8")
        shown = ", ".join(f"{name} {value:.3g}" for name, value in found.items() if not isinstance(value, str))
        print(f"{k}: {shown} {found.get('refused', '')}", file=sys.stderr, flush=True)
        (taken if "identified" in found else others).append(found)
        k += 1
    good = sum(one["identified"] >= WANTED * starts for one in taken)
    low, high = wilson(good, wanted)
    print(f"machines with 95 % of the starts: {good} of {wanted} ({low:.0%} to {high:.0%})")
    for name in ("known", "identified"):
        every = sum(one[name] for one in taken)
        low, high = wilson(every, wanted * starts)
        print(f"starts, {name} numbers: {every} of {wanted * starts} ({low:.1%} to {high:.1%})")
    refused, foretold = (sum(bool(one.get(name)) for one in others) for name in ("refused", "noisy"))
    weak = len(others) - refused
    print(f"not taken: {refused} refused by the law, {weak} below 95 % with true numbers, {foretold} of them foretold")
    print(f"taken, though told that hover trembles too much: {sum(one['noisy'] for one in taken)}")
    print(f"masses {min(m['mass'] for m in taken):.2g} to {max(m['mass'] for m in taken):.2g} kg")
    print(f"rods {min(m['rod'] for m in taken):.2g} to {max(m['rod'] for m in taken):.2g} m")
    print(f"processor time of a log of {SECONDS} s: {np.mean([m['spent'] for m in taken]):.0f} s")


if __name__ == "__main__":
    main()
