"""The certified sets on docs/laws/theorem.md: `python -m benchmarks.certified`, some seconds."""

import flypend as fp

VEHICLES = ("hehn2011", "crazyflie", "nayak2018")


def main():
    """Print c and the extent of the certified set of each vehicle."""
    for name in VEHICLES:
        found = fp.laws.almost_global().bind(fp.vehicle(name)).certified_set()
        far = found.extent
        print(
            f"{name}: c = {found.c:.3g} m²/s²; bob {100 * far['bob']:.3g} cm, height {100 * far['height']:.2g} cm, "
            f"speed {far['speed']:.2g} m/s, rod {far['rod']:.2g}°, axis {far['axis']:.2g}°, "
            f"yaw rate {far['yaw_rate']:.2g} rad/s"
        )


if __name__ == "__main__":
    main()
