"""The exported files under compilers, checkers and a fuzzer, and what they cost a processor."""

import re
import sys

import pytest
from cbuild import build, run

import flypend as fp
from benchmarks import cortex, damaged_memory, export_cost
from flypend.export.interface import interface
from flypend.export.write import core
from flypend.laws.by_name import FACTORIES
from flypend.plants.sensors import sensors_called
from tests.few import slow

VEHICLE = fp.vehicle("hehn2011")
LAWS = {
    "inverted": fp.laws.inverted(),
    "light": fp.laws.inverted(form="light"),
    "corrected": fp.laws.corrected(),
    "printed": fp.laws.printed(),
    "lqr": fp.laws.lqr(),
}
SANITIZERS = ("-g", "-fsanitize=fuzzer,address,undefined,float-cast-overflow", "-fno-sanitize-recover=all")


@pytest.fixture(scope="module")
def exports(tmp_path_factory):
    folder = tmp_path_factory.mktemp("exports")
    made = {}

    def export(name, precision):
        if (name, precision) not in made:
            made[name, precision] = fp.export_c(
                LAWS[name], VEHICLE, folder / f"{name}-{precision}", precision=precision, check=False
            )
        return made[name, precision]

    return export


@pytest.mark.parametrize(
    ("compiler", "name", "precision"),
    [
        ("gcc", "inverted", "float"), ("gcc", "light", "double"), ("clang", "corrected", "float"),
        ("clang", "lqr", "float"), slow("gcc", "printed", "float"), slow("gcc", "lqr", "double"),
        slow("clang", "inverted", "double"),
    ],
)  # fmt: skip
def test_it_compiles_without_a_warning_and_gives_the_numbers_of_python(exports, compiler, name, precision):
    folder = exports(name, precision)
    program = build(folder, ("flypend_law.c", "flypend_test.c"), f"test-{compiler}", compiler)
    said = run([str(program)])
    assert "100 vectors" in said
    assert "100 periods" in said


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize(("flag", "compiles"), [("-O2", True), ("-ffast-math", False), ("-ffinite-math-only", False)])
def test_flags_that_drop_the_checks_for_nan_do_not_compile(exports, compiler, flag, compiles):
    said = run([compiler, "-fsyntax-only", flag, "flypend_law.c"], exports("corrected", "float"), check=False)
    assert (said.returncode == 0) == compiles
    assert compiles or "-ffinite-math-only let a compiler" in said.stderr


def test_no_vector_lies_so_near_an_exceptional_set_that_rounding_decides(tmp_path):
    fp.export_c(fp.laws.almost_global(), fp.vehicle("hummingbird"), tmp_path, precision="float", check=False)
    assert "100 vectors" in run([str(build(tmp_path, ("flypend_law.c", "flypend_test.c"), "test"))])


def test_a_wrong_number_in_the_vectors_is_found(exports, tmp_path):
    folder = exports("corrected", "double")
    text = (folder / "flypend_vectors.h").read_text()
    start = text.index("{{0.", text.index("flypend_vectors[]")) if "{{0." in text else text.index("flypend_vectors[]")
    number = re.compile(r"\d\.\d{6}").search(text, start)
    (tmp_path / "flypend_vectors.h").write_text(
        text[: number.start()] + f"{float(number[0]) + 1e-3:.6f}" + text[number.end() :]
    )
    for name in ("flypend_law.h", "flypend_law.c", "flypend_test.c"):
        (tmp_path / name).write_bytes((folder / name).read_bytes())
    program = build(tmp_path, ("flypend_law.c", "flypend_test.c"), "test")
    assert run([str(program)], check=False).returncode == 1


def test_cmake_builds_it_and_ctest_passes(exports):
    folder = exports("corrected", "double")
    run(["cmake", "-S", ".", "-B", "build", "-DCMAKE_C_FLAGS=-Werror"], folder)
    run(["cmake", "--build", "build"], folder)
    assert "100% tests passed" in run(["ctest", "--test-dir", "build"], folder)


def _called(folder, source, *flags):
    """What an object calls that it does not hold; with the compiler's own checks of the stack off."""
    build(folder, (source,), "asked.o", flags=("-O0", "-c", "-fno-stack-protector", *flags))
    return {line.split()[-1] for line in run(["nm", "-u", "asked.o"], folder).splitlines()}


LIBRARY = {"memcpy", "memset", "_GLOBAL_OFFSET_TABLE_"}


@pytest.mark.parametrize("precision", ["double", "float"])
def test_the_only_function_of_the_library_is_the_square_root(exports, precision):
    folder = exports("inverted", precision)
    called = _called(folder, "flypend_law.c")
    root = "sqrt" if precision == "double" else "sqrtf"
    assert root in called
    assert called <= {root, *LIBRARY}
    source = (folder / "flypend_law.c").read_text()
    loops = re.findall(r"\b(?:for|while|do|goto)\b[^{;]*;[^;]*;", source)
    assert loops
    assert all(re.search(r"[ik] < (?:count|4|FLYPEND_ROTORS|FLYPEND_MEMORY|FLYPEND_WORDS);", loop) for loop in loops)


def _library(folder, law, sensors=None):
    """`folder` with the sources that are flown."""
    for name, text in core(interface(law, VEHICLE, sensors=sensors_called(sensors)), "float").items():
        (folder / name).write_text(text)
    return folder


@pytest.mark.parametrize("name", [*FACTORIES, "light", "calm"])
def test_no_law_calls_more_of_the_library(name, tmp_path):
    calm = LAWS["inverted"].bind(VEHICLE).calm_by(0.5)
    law = calm if name == "calm" else LAWS[name] if name in LAWS else FACTORIES[name]()
    assert _called(_library(tmp_path, law), "flypend_law.c") <= {"sqrtf", *LIBRARY}


@pytest.mark.parametrize("sensors", ["mocap", slow("onboard")])
def test_nor_does_a_computer_with_an_estimator(sensors, tmp_path):
    called = _called(_library(tmp_path, LAWS["inverted"], sensors), "flypend_sensors.c")
    assert {name for name in called if not name.startswith("flypend_")} <= {"sqrtf", *LIBRARY}


def test_cppcheck_is_quiet(exports, tmp_path):
    """But for the body of the longest function, whose statements are those of the others: the slow test has it."""
    folder = exports("corrected", "float")
    text, cut = re.subn(
        r"(static void carry\(.*\)\n\{\n)(?:    .*\n)+\}", r"\1}", (folder / "flypend_law.c").read_text()
    )
    assert cut == 1
    (tmp_path / "flypend_law.c").write_text(text)
    sources = (tmp_path / "flypend_law.c", "flypend_test.c", "adapters/flypend_frames.c")
    checks = ("--std=c99", "--enable=warning,style,performance,portability", "--error-exitcode=1", "--quiet")
    run(["cppcheck", *checks, "-I.", "--suppress=missingIncludeSystem", *sources], folder)


def test_cppcheck_would_speak(tmp_path):
    (tmp_path / "bad.c").write_text("int f(int *p);\nint f(int *p)\n{\n    int a[2];\n    return a[2] + *p;\n}\n")
    assert run(["cppcheck", "--error-exitcode=1", "--quiet", "bad.c"], tmp_path, check=False).returncode == 1


def _fuzzer(folder, source="flypend_law.c", level="-O0"):
    """-O0 compiles ten times as fast, and runs a ninth as fast: a minute of fuzzing wants -O1."""
    return build(folder, (source, "flypend_fuzz.c"), f"fuzz-{source}", "clang", (*SANITIZERS, level))


FEW = ("-seed=1", "-runs=5000", "-max_len=4096")  # a check that is left out is found in 60 runs


def test_no_bits_make_an_output_that_is_not_finite(exports):
    fuzzer = _fuzzer(exports("inverted", "float"))
    run([str(fuzzer), *FEW])  # other seeds, laws and double: the slow test below


@pytest.mark.parametrize("what", [slow("law"), "board"])
def test_the_fuzzer_finds_code_without_its_last_check(exports, what):
    folder = exports("inverted", "float")
    source = (folder / "flypend_law.c").read_text()
    check = {
        "law": "return numbers(w, 4) ? FLYPEND_OK : FLYPEND_SINGULAR;",
        "board": "return (numbers(in->command, FLYPEND_ROTORS) && numbers(in->memory, FLYPEND_MEMORY)) "
        "? FLYPEND_OK : FLYPEND_SINGULAR;",
    }[what]
    assert check in source
    (folder / "weak.c").write_text(source.replace(check, "return FLYPEND_OK;"))
    done = run([str(_fuzzer(folder, "weak.c")), *FEW], folder, check=False)
    assert done.returncode != 0


@pytest.mark.slow
@pytest.mark.parametrize("precision", ["float", "double"])
@pytest.mark.parametrize("name", LAWS)
def test_a_minute_of_fuzzing_and_cppcheck_for_every_law(exports, name, precision):
    folder = exports(name, precision)
    run([str(_fuzzer(folder, level="-O1")), "-max_total_time=60", "-max_len=4096"])
    checks = ("--std=c99", "--enable=warning,style,performance,portability", "--error-exitcode=1", "--quiet")
    run(["cppcheck", *checks, "flypend_law.c"], folder)


def test_the_goals_of_cost_are_met(monkeypatch, capsys):
    # The board: 25 microseconds on a desktop core; a third of an STM32F405 at 500 Hz, 1,000 bytes of stack, 64 KB,
    # of which a tenth follows a path that moves.
    # The bare law: a fifth, 1,000 bytes and 32 KB.
    limits = {"board": (0.5, 33, 65_536, 1_000, 66_000), "law": (0.05, 20, 32_000, 1_000, 10_000)}
    monkeypatch.setattr(sys, "argv", ["export_cost", "--law", "inverted", "--precision", "float"])
    export_cost.main()
    head, _, *rows = (line.strip("| ").split(" | ") for line in capsys.readouterr().out.splitlines())
    cost = {row[0].split(", ")[1]: dict(zip(head, row, strict=True)) for row in rows}
    for part, (least, share, code, stack, instructions) in limits.items():
        assert least < export_cost.microseconds(LAWS["inverted"].bind(VEHICLE), VEHICLE, "double", part) < 25
        assert 2 < float(cost[part]["M4%"]) < share
        assert 8_000 < int(cost[part]["text"]) < code
        assert 100 < int(cost[part]["stack"]) < stack
        assert 1_000 < int(cost[part]["instr"]) < instructions


def test_the_corrected_law_takes_less_than_three_microseconds():
    assert 0.01 < export_cost.microseconds(LAWS["corrected"].bind(VEHICLE), VEHICLE, "double", "law") < 3


def test_cycles_are_those_of_what_runs(tmp_path):
    """Three rounds of a loop, a skipped branch, and the manual's timings."""
    assert cortex.cost("vdiv.f32", "s1, s2, s3") == cortex.cost("vsqrt.f32", "s1, s2") == 14
    assert cortex.cost("vldr", "s0, [r1]") == 2
    assert [cortex.cost("bne.n", "12 <x>", taken=taken) for taken in (True, False)] == [3, 1]
    assert cortex.cost("push", "{r4, r5, lr}") == 4
    assert cortex.cost("vpush", "{d8-d15}") == 17
    assert cortex.cost("vadd.f32", "s1, s2, s3") == cortex.cost("it", "mi") == 1
    loop = r"""
__attribute__((naked, noinline)) void once(int n) {
    __asm__("1: subs r0, #1; bne 1b; bx lr");
}
int main(void) { once(3); once(10); return 0; }
"""
    (tmp_path / "main.c").write_text(loop)
    words = ("arm-none-eabi-gcc", *cortex.FLAGS, "-O2", *cortex.LINKED, "main.c", cortex.HERE / "start.c")
    run([*words, "-o", "main.elf"], tmp_path)
    # n subtractions, n − 1 branches back and one on, the return.
    assert cortex.cycles(tmp_path / "main.elf", "once") == [3 + 3 * 2 + 1 + 3, 10 + 3 * 9 + 1 + 3]


@pytest.mark.parametrize(
    ("computer", "count", "level"),
    [
        ("board-float", 5_000, "-O0"),
        *(slow(name, 10**6, "-O1") for name in damaged_memory.COMPUTERS),
    ],
)
def test_no_damaged_memory_is_flown_on(tmp_path, computer, count, level):
    """In ten ways, under two sanitizers; a whole memory of the past cannot be told from a sound one."""
    rows = damaged_memory.damaged(damaged_memory.built(tmp_path, computer, level=level), count, seed=3)
    for row in rows:
        assert row.tried > count / 20
        if row.kind != damaged_memory.REPLAYED:
            assert row.refused == row.tried, row


def test_without_the_check_damage_flies_on(tmp_path):
    rows = damaged_memory.damaged(
        damaged_memory.built(tmp_path, "board-float", checked=False, level="-O0"), 2000, seed=3
    )
    assert sum(row.other for row in rows) > 500
