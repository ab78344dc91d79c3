"""What a flight computer takes of a Crazyflie: stack, cycles, flash and RAM, law by law.

    python -m benchmarks.app_cost

Compiled with the firmware's flags and run on QEMU's Cortex-M4F. A law is the controller of `flypend export-app`, in
stand-ins for the firmware: its observers of pose and rod, its safety rules and the law, "with estimator" that for
motion capture, "with plan" a tracked plan before the law; without the firmware's own PID controller. Stack: the deepest
of all calls, painted before each. Cycles: the dearest call (benchmarks/cortex). Flash and RAM: of the objects, code
with constants and static memory.
"""

from __future__ import annotations

import re
import tempfile
from functools import cache
from pathlib import Path

import flypend as fp
from benchmarks import cortex, run

STANDINS = Path(__file__).parents[1] / "tests" / "export" / "standins"
HEADERS = (
    "FreeRTOS.h", "task.h", "app.h", "app_channel.h", "controller.h", "controller_pid.h", "estimator.h", "log.h",
    "motors.h", "param.h", "platform_defaults.h", "pm.h", "stabilizer_types.h", "supervisor.h",
)  # fmt: skip
FLAGS = (*cortex.FLAGS, "-Os", "-fno-math-errno", "-ffunction-sections", "-fdata-sections", "-std=gnu11")
INCLUDED = ("-I.", f"-I{STANDINS / 'crazyflie'}")
FEW = 212  # ms in the app, the last of them under the law: each instruction of them is traced
LAWS = {  # and what `export_app` takes beside them
    "inverted": (fp.laws.inverted, {}),
    "light": (lambda: fp.laws.inverted(form="light"), {}),
    "corrected": (fp.laws.corrected, {}),
    "lqr": (fp.laws.lqr, {}),
    "learned": (fp.laws.learned, {}),
    "almost_global": (fp.laws.almost_global, {}),
    "inverted, with estimator": (fp.laws.inverted, {"sensors": "mocap"}),
    "inverted, with plan": (fp.laws.inverted, {"planned": True}),
}


def main() -> None:
    """Print a table."""
    print("| law | stack, bytes | cycles | flash, bytes | RAM, bytes |")
    print("|---|---|---|---|---|")
    vehicle = fp.vehicle("crazyflie")
    for name in LAWS:
        with tempfile.TemporaryDirectory() as folder:
            app = exported(name, vehicle, Path(folder))
            cells = stack(app)[0], app_cycles(app), *size(app)
            print(f"| {name} | {' | '.join(map(str, cells))} |", flush=True)


def exported(name: str, vehicle: fp.Vehicle, folder: Path) -> Path:
    """The app of a law of LAWS among stand-ins for the firmware."""
    make, options = LAWS[name]
    fp.export_app("crazyflie", make(), vehicle, folder / "app", height=4.0, **options)  # some do not swing up
    for header in HEADERS:
        (folder / "app" / header).write_text('#include "firmware.h"\n')
    return folder / "app"


def stack(app: Path, *defined: str) -> tuple[int, int]:
    """Bytes of stack of the app's controller, and in how many periods the law flew, refusals and a landing beside."""
    words = [*FLAGS, *defined, *INCLUDED, *cortex.LINKED, *_objects(app), STANDINS / "stack.c", "-lm"]
    run("arm-none-eabi-gcc", *words, "-o", "stack.elf", folder=app)
    return _painted(app / "stack.elf")


def app_cycles(app: Path) -> int:
    """Cycles of the dearest call of the app's controller."""
    _, flown = stack(app, f"-DROUNDS={FEW}", "-DDEPTH=16U")
    assert flown > 2
    return max(cortex.cycles(app / "stack.elf", "controllerOutOfTree"))


def size(folder: Path) -> tuple[int, int]:
    """Bytes of flash and of RAM of the objects."""
    lines = run("arm-none-eabi-size", *_objects(folder), folder=folder).splitlines()
    text, data, bss = (sum(int(line.split()[i]) for line in lines[1:]) for i in range(3))
    return text + data, data + bss


@cache
def _objects(folder: Path) -> list[str]:
    """Compile the sources in `folder`, once for all that is measured of them."""
    sources = sorted(path.name for path in folder.glob("flypend_*.c"))
    run("arm-none-eabi-gcc", *FLAGS, *INCLUDED, "-c", *sources, folder=folder)
    return [name.replace(".c", ".o") for name in sources]


def _painted(elf: Path) -> tuple[int, int]:
    output = ("-chardev", "stdio,id=said", "-semihosting-config", "enable=on,target=native,chardev=said")
    said = run(*cortex.QEMU, *output, "-kernel", elf, folder=elf.parent)
    found = re.search(r"stack (\d+) flown (\d+)", said)
    return int(found[1]), int(found[2])


if __name__ == "__main__":
    main()
