"""Commands that write flight computers for hardware: export-c, export-app."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from pathlib import Path

import click

import flypend as fp
from flypend.cli.options import LAW_HELP, option, options_of, out_option, sensors_asked, sensors_option, vehicle_option
from flypend.cli.terminal import bold, console, say
from flypend.errors import InputError, one_of


@click.command("export-c")
@click.option("--law", default="inverted", help=f"Law to export: {LAW_HELP}.")
@vehicle_option
@out_option("c-out")
@click.option("--precision", default="double", help="double or float.")
@click.option("--rate", default=500.0, help="Control rate, Hz.")
@sensors_option
@click.option("--light", is_flag=True, help="Export the light form of the inverted law.")
@click.option(
    "--check/--no-check",
    "tested",
    default=True,
    help="Fly the law first, which takes seconds, and state the result in the header.",
)
def export_c(
    law: str, vehicle: str, out: Path, precision: str, rate: float, sensors: str, light: bool, tested: bool
) -> None:
    """Export the flight computer of a law as C99: observer, prediction, law, allocation, lead; see docs/export.

    With nmpc, the flight computer is that of the inverted law. Beside it comes a plan from hanging at rest, with code
    that improves the plan in flight.
    """
    from flypend.compile.c99 import PRECISIONS
    from flypend.export.write import BESIDE, check_folder
    from flypend.files.staging import staging
    from flypend.plants.sensors import sensors_called

    if light:
        one_of("--law", law, ("inverted",))
    chosen = fp.laws.inverted(form="light") if light else fp.laws.inverted() if law == "nmpc" else _symbolic(law)
    kind = next(known for known in PRECISIONS if known == one_of("--precision", precision, PRECISIONS))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", UserWarning)
        read = sensors_called(sensors_asked(sensors), "--sensors")
        machine = fp.vehicle(vehicle)
        check_folder(out, BESIDE)
        with staging(out) as folder:
            if law == "nmpc":
                fp.export_nmpc(fp.plan(machine, fp.State(y=(0, 0, -1))), folder, precision=kind)
            fp.export_c(chosen, machine, out, precision=kind, rate=rate, sensors=read, check=tested)
    for warning in said:
        say(f"flypend: warning: {warning.message}")
    if law == "nmpc":
        console.print(f"C code of the plan is in {bold(out / 'flypend_nmpc.c')}; its header says how to fly it.")
    console.print(f"C code of the {chosen.name} law is in {bold(out)}; start with README.md.")


@dataclass(frozen=True)
class App:
    """Options of an app, as `export_app` takes them."""

    height: float | None = option("Height, m, below which the law stays off. Default: what a swing-up needs.")
    airframe: str | None = option(
        "Airframe of a Crazyflie, cf2 or cf21bl; default the one with the nearest arm length."
    )
    rate: float | None = option("Control rate, Hz. Default: 500 for crazyflie, 400 for px4.")
    planned: bool = option("Swing the hanging rod up along a plan; the law flies the rest.", "--plan")


@click.command("export-app")
@click.argument("target")
@click.argument("vehicle")
@out_option("app")
@click.option("--law", default="inverted", help=f"Law to export: {LAW_HELP}.")
@options_of(App, "own")
@sensors_option
def export_app(target: str, vehicle: str, out: Path, law: str, own: App, sensors: str) -> None:
    """Write an app for the firmware of TARGET, crazyflie or px4, that flies VEHICLE; see docs/export."""
    from flypend.plants.sensors import sensors_called

    read = sensors_called(sensors_asked(sensors), "--sensors")
    machine, chosen = fp.vehicle(vehicle), _symbolic(law)
    flown = fp.export_app(target, chosen, machine, out, sensors=read, **vars(own))
    (least, largest), (low, high) = flown.rotor_limits, machine.rotor_limits
    if (least, largest) != (low, high):
        say(f"rotor forces {low:.3g} to {high:.3g} N become {least:.3g} to {largest:.3g} N, the firmware's limits")
    console.print(f"The app with the {chosen.name} law is in {bold(out)}; start with README.md.")


def _symbolic(name: str) -> fp.Law:
    """The law called `name`. Raises InputError for one that is not written in symbols."""
    from flypend.studies import law_named

    chosen = law_named(name)
    if not isinstance(chosen, fp.Law):
        because = f" ({chosen.because})" if chosen.because else ""
        raise InputError("--law", "a law written in symbols", f"{name}, which is not{because}")
    return chosen
