"""What a flight computer takes of a Crazyflie: stack, cycles, flash and RAM, law by law.

    python -m benchmarks.app_cost

Compiled with the firmware's flags and run on QEMU's Cortex-M4F. A law is the controller of `flypend export-app`, in
stand-ins for the firmware: its rod observer, its safety rules and the law; without the firmware's own PID controller.
"with estimator" is `flypend_sensors_step` for motion capture, and "tracked plan" is `flypend_plan_command`; neither is
part of the app. Stack: the deepest of all calls, painted before each. Cycles: the dearest call (benchmarks/cortex).
Flash and RAM: of the objects, code with constants and static memory.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
from pathlib import Path

import numpy as np

import flypend as fp
from benchmarks import cortex
from flypend.export.plan import export_plan
from flypend.export.source import initializer
from flypend.plants.sensing import readings_record
from flypend.plants.sensors import sensors_called

STANDINS = Path(__file__).parents[1] / "tests" / "export" / "standins"
HEADERS = (
    "FreeRTOS.h", "task.h", "app.h", "app_channel.h", "controller.h", "controller_pid.h", "estimator.h", "log.h",
    "motors.h", "param.h", "platform_defaults.h", "pm.h", "stabilizer_types.h", "supervisor.h",
)  # fmt: skip
APP = ("flypend_app.c", "flypend_law.c", "flypend_frames.c")
FLAGS = (*cortex.FLAGS, "-Os", "-fno-math-errno", "-ffunction-sections", "-fdata-sections", "-std=gnu11")
FEW = 212  # ms in the app, the last of them under the law: each instruction of them is traced
LAWS = {
    "inverted": fp.laws.inverted,
    "light": lambda: fp.laws.inverted(form="light"),
    "corrected": fp.laws.corrected,
    "lqr": fp.laws.lqr,
    "learned": fp.laws.learned,
    "almost_global": fp.laws.almost_global,
}
PAINTED = """
#include <stdint.h>
#include <string.h>
#include "{header}"
{memory}
static void say(const char *text)
{{
    register uint32_t what __asm__("r0") = 4; /* SYS_WRITE0 */
    register const char *which __asm__("r1") = text;
    __asm__ volatile("bkpt 0xab" : "+r"(what) : "r"(which) : "memory");
}}
__attribute__((noinline)) static uint32_t used(void)
{{
    volatile uint32_t *here;
    uint32_t depth = 4096;
    __asm__ volatile("mov %0, sp" : "=r"(here));
    for (int i = 1; i <= 4096; i++) {{
        here[-i] = 0xa5a5a5a5U;
    }}
    {call}
    while ((depth > 0) && (here[-(int)depth] == 0xa5a5a5a5U)) {{
        depth--;
    }}
    return 4 * depth;
}}
int main(void)
{{
    char text[] = "stack 000000 flown 1\\n";
    uint32_t most = 0;
    {begin}
    for (int i = 0; i < 5; i++) {{
        const uint32_t now = used();
        most = (now > most) ? now : most;
    }}
    for (int i = 11; i > 5; i--) {{
        text[i] = (char)('0' + most % 10);
        most /= 10;
    }}
    say(text);
    return 0;
}}
"""


def main() -> None:
    """Print a table."""
    print("| law | stack, bytes | cycles | flash, bytes | RAM, bytes |")
    print("|---|---|---|---|---|")
    vehicle = fp.vehicle("crazyflie")
    for name, make in LAWS.items():
        with tempfile.TemporaryDirectory() as folder:
            app = exported(make(), vehicle, Path(folder))
            cells = stack(app)[0], app_cycles(app), *size(app, APP)
            print(f"| {name} | {' | '.join(map(str, cells))} |", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        code = with_estimator(fp.laws.inverted(), vehicle, Path(folder))
        print(f"| inverted, with estimator | {told(code)} |", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        print(f"| tracked plan | {told(planned(vehicle, Path(folder)))} |", flush=True)


def exported(law: fp.laws.Law, vehicle: fp.Vehicle, folder: Path) -> Path:
    """The app of `law` among stand-ins for the firmware."""
    fp.export_app("crazyflie", law, vehicle, folder / "app", height=4.0)  # some do not swing up
    for header in HEADERS:
        (folder / "app" / header).write_text('#include "firmware.h"\n')
    return folder / "app"


def stack(app: Path, *defined: str) -> tuple[int, int]:
    """Bytes of stack of the app's controller, and in how many periods the law flew, refusals and a landing beside."""
    words = [*FLAGS, *defined, "-I.", f"-I{STANDINS / 'crazyflie'}", *cortex.LINKED, *APP, STANDINS / "stack.c", "-lm"]
    return _run("arm-none-eabi-gcc", *words, "-o", "stack.elf", folder=app) or _painted(app / "stack.elf")


def app_cycles(app: Path) -> int:
    """Cycles of the dearest call of the app's controller."""
    _, flown = stack(app, f"-DROUNDS={FEW}", "-DDEPTH=16U")
    assert flown > 2
    return max(cortex.cycles(app / "stack.elf", "controllerOutOfTree"))


def with_estimator(law: fp.laws.Law, vehicle: fp.Vehicle, folder: Path) -> tuple[Path, tuple[str, ...], str]:
    """The flight computer for motion capture, its sources and the function of a step."""
    fp.export_c(law, vehicle, folder, precision="float", sensors="mocap", check=False)
    sensors = sensors_called("mocap", "sensors")
    record = readings_record(sensors)
    known = {"attitude": np.eye(3).ravel(), "rod": np.array([0.0, 0.0, 1.0])}
    numbers = np.concatenate([known.get(field.name, np.zeros(field.size or 1)) for field in record.fields])
    memory = f"""
static flypend_sensors computer;
static flypend_rotors rotors;
static const flypend_path path;
static const flypend_state state = {{.R = {{1, 0, 0, 0, 1, 0, 0, 0, 1}}, .y = {{0, 0, 1}}}};
static const flypend_readings readings = {initializer(record, numbers, "float")};
"""
    call = "(void)flypend_sensors_step(&computer, &readings, &path, &flypend_default_params, &rotors);"
    begin = "(void)flypend_sensors_begin(&computer, &flypend_default_gains, &flypend_default_params, &state);"
    text = PAINTED.format(header="flypend_sensors.h", memory=memory, call=call, begin=begin)
    (folder / "main.c").write_text(text)
    return folder, ("flypend_law.c", "flypend_sensors.c"), "flypend_sensors_step"


def planned(vehicle: fp.Vehicle, folder: Path) -> tuple[Path, tuple[str, ...], str]:
    """A plan from hanging with its tracking gains, its sources and the function of a step."""
    start = fp.State(y=(0, 0, -1.0))
    export_plan(fp.plan(vehicle, start), folder / "plan", precision="float")
    state = ", ".join(f"{float(value)!r}f" for value in start.packed())
    memory = f"static const float state[24] = {{{state}}};\nstatic float rotors[4], command[4], t = 0.113f;\n"
    call = "(void)flypend_plan_command(t, state, rotors, command);"
    text = PAINTED.format(header="flypend_plan.h", memory=memory, call=call, begin="")
    (folder / "plan" / "main.c").write_text(text)
    return folder / "plan", ("flypend_plan.c",), "flypend_plan_command"


def told(given: tuple[Path, tuple[str, ...], str]) -> str:
    """The cells of a row."""
    folder, sources, function = given
    words = [*FLAGS, "-I.", *cortex.LINKED, "main.c", *sources, cortex.HERE / "start.c", "-lm", "-o", "main.elf"]
    _run("arm-none-eabi-gcc", *words, folder=folder)
    cells = _painted(folder / "main.elf")[0], max(cortex.cycles(folder / "main.elf", function)), *size(folder, sources)
    return " | ".join(map(str, cells))


def size(folder: Path, sources: tuple[str, ...]) -> tuple[int, int]:
    """Bytes of flash and of RAM of the objects."""
    headers = [f"-I{STANDINS / 'crazyflie'}"] if "flypend_app.c" in sources else []
    _run("arm-none-eabi-gcc", *FLAGS, "-I.", *headers, "-c", *sources, folder=folder)
    lines = _run("arm-none-eabi-size", *(name.replace(".c", ".o") for name in sources), folder=folder).splitlines()
    found = np.array([[int(number) for number in line.split()[:3]] for line in lines[1:]]).sum(axis=0)
    statics = 0
    if "flypend_sensors.c" in sources or "flypend_plan.c" in sources:  # the computer is the caller's
        statics = _static(folder / "main.elf")
    return int(found[0] + found[1]), int(found[1] + found[2] + statics)


def _static(elf: Path) -> int:
    listed = subprocess.run(["arm-none-eabi-nm", "-S", str(elf)], check=True, capture_output=True, text=True).stdout
    return sum(int(line.split()[1], 16) for line in listed.splitlines() if line.endswith(" computer"))


def _painted(elf: Path) -> tuple[int, int]:
    output = ("-chardev", "stdio,id=said", "-semihosting-config", "enable=on,target=native,chardev=said")
    said = _run(*cortex.QEMU, *output, "-kernel", elf, folder=elf.parent)
    found = re.search(r"stack (\d+) flown (\d+)", said)
    return int(found[1]), int(found[2])


def _run(*words: object, folder: Path) -> str:
    done = subprocess.run(list(map(str, words)), cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{' '.join(map(str, words))}\n{done.stdout}{done.stderr}")
    return done.stdout


if __name__ == "__main__":
    main()
