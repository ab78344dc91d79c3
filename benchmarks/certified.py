"""The certified sets on docs/laws/theorem.md: `python -m benchmarks.certified`, minutes; most of them through a lag.

The last two numbers are the largest angle between rod and thrust axis in the set, and the one at which the rod would be
proved to touch nothing on a hub, too.
"""

import math

import flypend as fp
from flypend.laws.certificate import evaluate_program, lean, touching
from flypend.laws.certified import statement
from flypend.model.shipped import vehicle_names


def main():
    """Print c and the extent of the certified set of each vehicle, without lag and through its own."""
    for made in (fp.laws.almost_global(), fp.laws.almost_global_lag()):
        for name in vehicle_names():
            found = made.bind(fp.vehicle(name)).certified_set()
            far = found.extent
            most = math.degrees(lean(evaluate_program(found.certificate, found.c)))
            hub = statement(made.bind(fp.vehicle(name).replace(mount="hub")))
            free = max(degrees for degrees in range(90) if not touching(hub, math.radians(degrees)))
            label = f"{name}, lag" if found.law.uses_wrench else name
            print(
                f"{label}: c = {found.c:.3g} m²/s²; "
                f"bob {100 * far['bob']:.3g} cm, height {100 * far['height']:.2g} cm, "
                f"speed {far['speed']:.2g} m/s, rod {far['rod']:.2g}°, axis {far['axis']:.2g}°, "
                f"yaw rate {far['yaw_rate']:.2g} rad/s, rod to axis {most:.3g}°, free to {free}°",
                flush=True,
            )


if __name__ == "__main__":
    main()
