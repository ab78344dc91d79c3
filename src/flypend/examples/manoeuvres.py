"""Manoeuvres at the limit, planned, flown with feedback and replayed, with the plan as the ghost.

python examples/manoeuvres.py door            # writes door.html
python examples/manoeuvres.py door mujoco     # flown in MuJoCo

cube: a rod of 0.565 m is turned from hanging to inverted inside a cube of 1 m. door: with the rod up through an opening
of 0.5 m, less than the rod is long. low: through one of 0.4 m by 0.7 m, lying. slalom: past three points with the rod
up. poke: somebody has pushed the rod, which now falls at 4 rad/s, and must stay above the horizon.
"""

import sys

import numpy as np

import flypend as fp

VEHICLE = fp.vehicle("hehn2011")
UP, DOWN = (0, 0, 1), (0, 0, -1)
AHEAD = fp.State(x=(-1.5, 0, 0), y=UP)
BEYOND = {"target": (1.5, 0, 0), "objective": "effort"}
DOOR = fp.Window(centre=(0, 0.3, 0.3), width=0.5, height=1.0)
LOW = fp.Window(centre=(0, 0.3, 0.3), width=0.7, height=0.4)

# For each its start, and what is wished.
MANOEUVRES = {
    "cube": (fp.State(x=(0, 0, 0.25), y=DOWN), {"target": (0, 0, -0.25), "box": ((-0.5,) * 3, (0.5,) * 3)}),
    "door": (AHEAD, BEYOND | {"window": DOOR, "lean": np.pi / 2}),
    "low": (AHEAD, BEYOND | {"window": LOW}),
    "slalom": (
        AHEAD,
        BEYOND | {"waypoints": [(-0.75, 0.5, 0.2), (0, -0.5, -0.2), (0.75, 0.5, 0.2)], "lean": np.pi / 2},
    ),
    "poke": (fp.State(y=UP, y_dot=(4, 0, 0)), {"lean": np.pi / 2}),
}


def fly(name, plant="rotors"):
    """Return the plan of a manoeuvre, and its flight in a plant."""
    start, wishes = MANOEUVRES[name]
    plan = fp.plan(VEHICLE, start, time_limit=60, **wishes)
    if not plan:
        sys.exit(f"{name}: {plan.reason}")
    return plan, fp.simulate(VEHICLE, fp.track(plan), start, plan.duration + 2, plant=plant)


if __name__ == "__main__":
    chosen = sys.argv[1] if len(sys.argv) > 1 else "door"
    planned, run = fly(chosen, *sys.argv[2:3])
    print(planned)
    print(f"stands: {fp.metrics(run).success}")
    run.to_html(f"{chosen}.html", ghost=planned.trajectory, title=chosen)
