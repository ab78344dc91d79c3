"""Manoeuvres at the limit, planned, flown with feedback and replayed, with the plan as the ghost.

python examples/manoeuvres.py door            # writes door.html
python examples/manoeuvres.py door mujoco     # flown in MuJoCo

cube: a rod of 0.565 m is turned from hanging to inverted inside a cube of 1 m. door: with the rod up through an opening
of 0.5 m, less than the rod is long. low: through one of 0.4 m by 0.7 m, lying. slalom: past three points with the rod
up. poke: somebody has pushed the rod, which now falls at 4 rad/s, and must stay above the horizon.
"""

import sys

import casadi as ca
import numpy as np

import flypend as fp

VEHICLE = fp.vehicle("hehn2011")
UP, DOWN = (0, 0, 1), (0, 0, -1)
AHEAD = fp.State(x=(-1.5, 0, 0), y=UP)
BEYOND = {"target": (1.5, 0, 0), "objective": "effort"}
DOOR = fp.Window(centre=(0, 0.3, 0.3), width=0.5, height=1.0)
LOW = fp.Window(centre=(0, 0.3, 0.3), width=0.7, height=0.4)

ROUND, BLOW = 4.0, 0.12  # s, N s


def angle(t):
    """Return two turns, rad, from rest to rest within a `ROUND`."""
    s = ca.fmin(t / ROUND, 1)
    return 4 * np.pi * s**3 * (10 - 15 * s + 6 * s**2)


def circle(t):
    """Return where the pivot is to be at time `t`, s."""
    return ca.vertcat(0.5 * ca.cos(angle(t)), 0.5 * ca.sin(angle(t)), 0)


def eight(t):
    """Return where the pivot is to be at time `t`, s."""
    return ca.vertcat(0.5 * ca.sin(angle(t)), 0.5 * ca.sin(angle(t)) * ca.cos(angle(t)), 0)


# For each its start, and what the plan keeps.
MANOEUVRES = {
    "cube": (fp.State(x=(0, 0, 0.25), y=DOWN), {"target": (0, 0, -0.25), "box": ((-0.5,) * 3, (0.5,) * 3)}),
    "door": (AHEAD, BEYOND | {"window": DOOR, "lean": np.pi / 2}),
    "low": (AHEAD, BEYOND | {"window": LOW}),
    "slalom": (
        AHEAD,
        BEYOND | {"waypoints": [(-0.75, 0.5, 0.2), (0, -0.5, -0.2), (0.75, 0.5, 0.2)], "lean": np.pi / 2},
    ),
    "poke": (fp.State(y=UP, y_dot=(4, 0, 0)), {"lean": np.pi / 2}),
    "circle": (fp.State(x=(0.5, 0, 0), y=UP), {"path": circle, "duration": ROUND, "lean": np.pi / 2}),
    "eight": (fp.State(y=UP), {"path": eight, "duration": ROUND, "lean": np.pi / 2}),
}


def hit(impulse, part, direction):
    """Return hover after a blow of an `impulse`, N s, along a unit vector (3,) on a `part`: the bob or the vehicle."""
    push, across = impulse * direction, impulse * direction * (1, 1, 0)  # along the rod a blow moves both
    sign, mass = (1, VEHICLE.m) if part == "bob" else (-1, VEHICLE.M)
    along = (push - across) / (VEHICLE.M + VEHICLE.m)
    x_dot = along + (0 if part == "bob" else across / mass)
    return fp.State(y=UP, x_dot=x_dot, y_dot=sign * across / (mass * VEHICLE.l))


def worst():
    """Return the start after a `BLOW` on that part, from that direction, after which the best plan strays farthest."""
    turn, tilt = np.meshgrid(np.radians((0, 22.5, 45)), np.radians((-45, 0, 45)))  # the rest by symmetry
    around = np.stack([np.cos(turn) * np.cos(tilt), np.sin(turn) * np.cos(tilt), np.sin(tilt)], axis=-1).reshape(-1, 3)
    blows = [(part, direction) for part in ("bob", "vehicle") for direction in around]
    starts = fp.State.from_packed(np.array([hit(BLOW, *blow).packed() for blow in blows]))
    found = fp.plan_ensemble(VEHICLE, starts, lean=np.pi / 2)
    hardest = int(np.argmax(np.where(found.success, found.excursion, 0)))
    part, direction = blows[hardest]
    print(f"{BLOW} N s on the {part} along {np.round(direction, 2)}")
    return starts[hardest]


def fly(name, plant="rotors"):
    """Return the plan of a manoeuvre, and its flight in a plant."""
    start, kept = (worst(), {"lean": np.pi / 2}) if name == "worst" else MANOEUVRES[name]
    plan = fp.plan(VEHICLE, start, time_limit=60, **kept)
    if not plan:
        sys.exit(f"{name}: {plan.reason}")
    return plan, fp.simulate(VEHICLE, fp.track(plan), start, plan.duration + 2, plant=plant)


if __name__ == "__main__":
    chosen = sys.argv[1] if len(sys.argv) > 1 else "door"
    planned, run = fly(chosen, *sys.argv[2:3])
    print(planned)
    print(f"stands: {fp.metrics(run).success}")
    run.to_html(f"{chosen}.html", ghost=planned.trajectory, title=chosen, windows=planned.windows)
