"""Check a certificate, and that it is of a law of the package: `python -m flypend.laws.verify FILE [VEHICLE]`."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from flypend import InputError, laws, model
from flypend.laws.certificate import check
from flypend.laws.certified import BODY, differs


def unlike(certificate: Any, vehicle: str | None = None) -> tuple[str, str]:
    """Return in what a certificate is not of flypend's law of that name on its `vehicle`, and what that law is.

    The first is empty where none is found. The law has the gains in the file, and the second tells those that are no
    defaults. `vehicle` is a name or a TOML file; default the name in the file.
    """
    try:
        machine = model.vehicle(vehicle or certificate["vehicle"])
        machine = machine.replace(mount="hub") if certificate["body"] else machine
        gains = {key: value for key, value in certificate["numbers"].items() if key not in (*BODY, "rotor_lag")}
        make = {"almost_global": laws.almost_global, "almost_global_lag": laws.almost_global_lag}[certificate["law"]]
        usual = make().bind(machine).numbers
        own = [f"{name} {value:g}" for name, value in gains.items() if value != usual.get(name)]
        label = f"{', '.join([make.__name__, *own])} on {machine.name}"
        return differs(certificate, make(**gains).bind(machine)), label
    except (InputError, LookupError, TypeError, ValueError) as reason:
        return f"no law of flypend is in the file: {reason}", ""


def main(path: str, vehicle: str | None = None) -> int:
    """Check the file at `path`, and compare its program with the law that it names, on `vehicle`.

    Return 0 if it is proved, 1 if not, and 2 if there is no such file.
    """
    try:
        certificate = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        print(f"{path}: expected a certificate, as CertifiedSet.save writes it, got {error}", file=sys.stderr)
        return 2
    reason, law = check(certificate), ""
    if not reason:
        reason, law = unlike(certificate, vehicle)
    if reason:
        print(f"not proved: {reason}")
        return 1
    print(f"proved: V <= {certificate['c']} m^2/s^2, |omega_3| <= {certificate['w']} rad/s, {law}")
    return 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m flypend.laws.verify", description="Check a certificate.")
    parser.add_argument("path", metavar="FILE")
    parser.add_argument("vehicle", metavar="VEHICLE", nargs="?", help="its name or TOML file; default that in FILE")
    sys.exit(main(**vars(parser.parse_args())))
