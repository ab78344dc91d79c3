"""The firmware's stabilizer with an app in it, as a library of this machine."""

from __future__ import annotations

import re
from pathlib import Path

from benchmarks import run

HOST = Path(__file__).with_name("host")
MODULES = "src/modules/src"
# What decides how it flies. The rest of the firmware is not compiled; of what it would do, host.c does what is called.
SOURCES = (
    *(f"{MODULES}/{name}.c" for name in (
        "app_channel", "app_handler", "axis3fSubSampler", "collision_avoidance", "commander", "crtp_commander",
        "crtp_commander_generic", "crtp_commander_high_level", "crtp_commander_rpyt", "crtp_localization_service",
        "crtp_supervisor", "kalman_supervisor", "peer_localization", "planner", "platformservice",
        "power_distribution_quadrotor", "pptraj", "pptraj_compressed", "stabilizer", "supervisor",
        "supervisor_state_machine",
    )),
    *(f"{MODULES}/controller/{name}.c" for name in (
        "attitude_pid_controller", "controller", "controller_pid", "position_controller_pid",
    )),
    *(f"{MODULES}/estimator/{name}.c" for name in ("estimator", "estimator_kalman")),
    *(f"{MODULES}/kalman_core/{name}.c" for name in ("kalman_core", "mm_pose", "mm_position")),
    *(f"src/utils/src/{name}.c" for name in ("filter", "num", "pid", "rateSupervisor", "statsCnt")),
    *(f"vendor/CMSIS/CMSIS/DSP/Source/{name}.c" for name in (
        "CommonTables/arm_common_tables", "FastMathFunctions/arm_cos_f32", "FastMathFunctions/arm_sin_f32",
        "MatrixFunctions/arm_mat_mult_f32", "MatrixFunctions/arm_mat_scale_f32", "MatrixFunctions/arm_mat_trans_f32",
    )),
)  # fmt: skip
INCLUDES = (
    "src/config", "src/platform/interface", "src/deck/interface", "src/deck/drivers/interface", "src/drivers/interface",
    "src/hal/interface", "src/modules/interface", "src/modules/interface/kalman_core",
    "src/modules/interface/lighthouse", "src/modules/interface/outlierfilter", "src/modules/interface/controller",
    "src/modules/interface/estimator", "src/modules/interface/cpx", "src/modules/interface/p2pDTR",
    "src/utils/interface", "src/utils/interface/kve", "src/utils/interface/lighthouse", "src/utils/interface/tdoa",
    "vendor/libdw1000/inc", "vendor/CMSIS/CMSIS/Core/Include", "vendor/CMSIS/CMSIS/DSP/Include",
)  # fmt: skip
DEFINED = ("-D__FPU_PRESENT=1", "-DCRAZYFLIE_FW", "-D__fp16=_Float16")
FLAGS = ("-std=gnu11", "-O2", "-fPIC", "-fno-strict-aliasing", "-fno-math-errno", "-w", *DEFINED)


def build(firmware: Path, app: Path, airframe: str) -> Path:
    """Return the library of `firmware` with `app`, an export for `airframe`, beside the app."""
    run("make", f"CRAZYFLIE_BASE={firmware}", f"{airframe}_defconfig", folder=app)
    run(firmware / "scripts/kconfig/merge_config.sh", "-O", "build", "-m", "build/.config", "app-config", folder=app)
    run("make", "-C", firmware, f"OOT={app}", f"KBUILD_OUTPUT={app / 'build'}", "silentoldconfig", folder=app)
    folder = app / "host"
    folder.mkdir(exist_ok=True)
    (folder / "compensation.c").write_text(_compensation((firmware / "src/drivers/src/motors.c").read_text()))
    includes = searched(firmware, app, app / "build/include/generated")
    sources = [*(firmware / name for name in SOURCES), *sorted(app.glob("flypend_*.c")), HOST / "host.c"]
    made = []
    for source in [*sources, folder / "compensation.c"]:
        done = folder / f"{Path(source).stem}.o"
        run("gcc", *FLAGS, *includes, "-include", "groups.h", "-c", source, "-o", done, folder=folder)
        made.append(done)
    (folder / "absent.c").write_text(_absent(made))
    library = folder / "firmware.so"
    run("gcc", *FLAGS, "-shared", *made, "absent.c", "-lm", "-o", library, folder=folder)
    return library


def searched(firmware: Path, app: Path, configured: Path) -> list[str]:
    """Where its headers are, as flags; that of its configuration is in `configured`."""
    return [f"-I{path}" for path in (HOST, configured, *(firmware / name for name in INCLUDES), app)]


def _compensation(motors: str) -> str:
    """The one function of the motor driver that is no driver."""
    found = re.search(r"^float motorsCompensateBatteryVoltage\(.*?^}\n", motors, re.MULTILINE | re.DOTALL)
    head = ("autoconf.h", "cfassert.h", "motors.h", "platform_defaults.h", "stabilizer_types.h")
    return "#include <math.h>\n" + "".join(f'#include "{name}"\n' for name in head) + found[0]


def _absent(objects: list[Path]) -> str:
    """Functions that end the program, for those that nothing here defines and no flight here calls."""
    wanted, defined = set(), set()
    for line in run("nm", *objects, folder=objects[0].parent).splitlines():
        if found := re.search(r" ([A-Z]) (\w+)$", line):
            (wanted if found[1] == "U" else defined).add(found[2])
    find = "nm -D --defined-only $(gcc -print-file-name=libc.so.6) $(gcc -print-file-name=libm.so.6)"
    known = run("sh", "-c", find, folder=objects[0].parent)
    defined |= {line.split()[-1].split("@")[0] for line in known.splitlines() if line.strip()}
    lines = ["#include <stdio.h>\n#include <stdlib.h>\n"]
    for name in sorted(wanted - defined - {"_GLOBAL_OFFSET_TABLE_"}):
        lines.append(f'void {name}(void) {{ fprintf(stderr, "not on the host: {name}\\n"); abort(); }}\n')
    return "".join(lines)
