"""The certified sets on docs/laws/theorem.md: `python -m benchmarks.certified`, minutes; most of them through a lag."""

import flypend as fp
from flypend.model.by_name import vehicle_names


def main():
    """Print c and the extent of the certified set of each vehicle, without lag and through its own."""
    for made in (fp.laws.almost_global(), fp.laws.almost_global_lag()):
        for name in vehicle_names():
            found = made.bind(fp.vehicle(name)).certified_set()
            far = found.extent
            label = f"{name}, lag" if found.law.uses_wrench else name
            print(
                f"{label}: c = {found.c:.3g} m²/s²; "
                f"bob {100 * far['bob']:.3g} cm, height {100 * far['height']:.2g} cm, "
                f"speed {far['speed']:.2g} m/s, rod {far['rod']:.2g}°, axis {far['axis']:.2g}°, "
                f"yaw rate {far['yaw_rate']:.2g} rad/s",
                flush=True,
            )


if __name__ == "__main__":
    main()
