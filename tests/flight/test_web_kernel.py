"""Kernels as WebAssembly, flown by Node.js through the engine of the pages, beside native ones."""

import base64
import json
import subprocess
from pathlib import Path

import numpy as np
import pytest
from llvmlite import ir

import flypend as fp
from flypend.compile import wasm
from flypend.compile.llvm import jit
from flypend.compile.llvm.sampled import ARGUMENTS
from flypend.compile.llvm.target import wasm32
from flypend.flight.criterion import REDUCTIONS
from flypend.flight.kernels.sampled import plant_numbers, sampled_kernel
from flypend.flight.kernels.web import web_kernel
from flypend.laws.references import circle
from flypend.model.state import seen_packed
from flypend.plants import plant
from flypend.plants.loop import Loop
from flypend.plants.plant import Noise, Wind

DURATION, KEPT = 6.0, 60
LAWS = ("inverted", "corrected", "printed", "repaired", "almost_global", "lqr")
SEED = 7
CHANGE = np.random.default_rng(1).standard_normal(24)


def flown_by_page(loop, starts, tmp_path, width=1):
    """States and rotor forces at `KEPT` times, and the reductions, of flights of the module."""
    runs, n = len(starts), len(loop.vehicle.rotor_spins)
    count = round(DURATION * loop.sampled.rate)
    keep = np.arange(0, count + 1, count // KEPT)
    least = np.full((runs, n), loop.vehicle.rotor_limits[0])
    given = {
        "starts": np.concatenate([seen_packed(starts.packed(), loop.law.e3), least], axis=1),
        "parameters": np.zeros((runs, 1)), "plant": plant_numbers(loop),
        "seeds": SEED + np.arange(runs), "runs": runs, "ticks": count, "sample_ticks": keep, "sample_count": len(keep),
        "judged": np.ones_like(keep), "rows": np.arange(len(keep) + 1), "row_count": len(keep),
        "samples": np.full((runs, len(keep), 24 + n), np.nan), "reductions": np.zeros((runs, len(REDUCTIONS))),
        "final": np.zeros((runs, 24)), "end": np.zeros(runs), "status": np.zeros(runs, dtype=np.int64),
        "stop": np.zeros(1, dtype=np.int64),
    }  # fmt: skip
    told = {
        name: {"kind": str(value.dtype), "bytes": base64.b64encode(np.ascontiguousarray(value)).decode()}
        if isinstance(value, np.ndarray) else {"number": value}
        for name, value in given.items()
    }  # fmt: skip
    code, into, out = (tmp_path / name for name in ("kernel.wasm", "in.json", "out.json"))
    code.write_bytes(web_kernel(loop, fp.Criterion(), width))
    into.write_text(json.dumps(told))
    subprocess.run(["node", Path(__file__).with_name("fly.mjs"), code, ",".join(ARGUMENTS), into, out], check=True)
    found = {
        name: np.frombuffer(base64.b64decode(text), given[name].dtype)
        for name, text in json.loads(out.read_text()).items()
    }
    return {name: found[name].reshape(given[name].shape) for name in ("samples", "reductions", "end", "status")}


def flown_here(loop, starts):
    count = round(DURATION * loop.sampled.rate)
    keep = np.arange(0, count + 1, count // KEPT)
    kernel = sampled_kernel(loop, fp.Criterion())
    return kernel.fly(starts.packed(), DURATION, judge_at=keep, keep_at=keep, first_seed=SEED, workers=1)


def assert_equal(loop, starts, tmp_path, width=1):
    """Closer than 1e-9, or, where a flight amplifies rounding, than what a change of the start by 1e-12 makes of it.

    A flight that makes 1e-3 of that is chaos, which no two processors share.
    """
    page, here = flown_by_page(loop, starts, tmp_path, width), flown_here(loop, starts)
    own = seen_packed(page["samples"][..., :24], loop.law.e3)
    assert np.array_equal(page["status"], here.code)
    scale, kept = 1 + np.abs(here.samples[..., :24]), here.samples[..., :24]
    beside = flown_here(loop, fp.State.trusted(starts.packed() + 1e-12 * CHANGE)).samples[..., :24]
    apart = np.maximum.accumulate(np.nanmax(np.abs(beside - kept) / scale, axis=-1), axis=-1)
    error = np.nanmax(np.abs(own - kept) / scale, axis=-1)
    assert np.array_equal(np.isnan(own), np.isnan(kept))
    assert np.all((error < 1e-9) | (error < apart) | (apart > 1e-3))
    assert np.all(error[:, : KEPT // 6] < 1e-9)  # and always in the first second
    return error


def start():
    return fp.State.from_packed(fp.State(y=(0.6, 0.0, 0.8), y_dot=(0, 0.2, 0), x=(0.1, 0, 0)).packed()[None])


def loop_of(law, vehicle="hehn2011", through="rotors"):
    machine = fp.vehicle(vehicle)
    return Loop(machine, getattr(fp.laws, law)().bind(machine), plant(through) if isinstance(through, str) else through)


@pytest.mark.parametrize("vehicle", ["hehn2011", "nayak2018", "crazyflie"])
@pytest.mark.parametrize("law", LAWS)
def test_a_page_flies_what_the_package_flies(law, vehicle, tmp_path):
    error = assert_equal(loop_of(law, vehicle), start(), tmp_path)
    if law in ("inverted", "corrected", "repaired"):  # these settle
        assert error.max() < 1e-9


@pytest.mark.parametrize("width", [1, 2])
def test_noise_gusts_delay_and_observer_are_those_of_the_package(tmp_path, width):
    real = plant("rotors").replace(
        delay=0.006,
        noise=Noise(x=1e-3, x_dot=1e-2, attitude=2e-3, omega=1e-2, y=2e-3, y_dot=2e-2),
        wind=Wind(gust_on_vehicle=0.1, gust_on_bob=0.01),
    )
    starts = fp.random_starts(4, 11)
    error = assert_equal(loop_of("inverted", through=real), starts, tmp_path, width)
    assert error.shape == (4, KEPT + 1)


def test_a_reference_that_moves_is_followed(tmp_path):
    machine = fp.vehicle("hehn2011")
    law = fp.laws.inverted(reference=circle(radius=0.5, rate=1.5))
    assert_equal(Loop(machine, law.bind(machine), plant("rotors")), start(), tmp_path)


# The module -----------------------------------------------------------------------------------------------------------


def test_the_module_takes_two_things_and_gives_one(tmp_path):
    (tmp_path / "kernel.wasm").write_bytes(web_kernel(loop_of("inverted"), fp.Criterion()))
    script = """
        const module = new WebAssembly.Module(require('fs').readFileSync('kernel.wasm'));
        const names = (list) => list.map(({ name }) => name).sort().join();
        console.log(names(WebAssembly.Module.imports(module)), names(WebAssembly.Module.exports(module)));
    """
    said = subprocess.run(["node", "-e", script], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert said.split() == ["__linear_memory,__stack_pointer", "kernel"]


def rooted():
    """A module with a function that is not exported, one that is, and a call of the C library."""
    made = ir.Module("rooted")
    kind = ir.FunctionType(ir.DoubleType(), [ir.DoubleType()])
    sine, inner, outer = (ir.Function(made, kind, name) for name in ("sin", "inner", "outer"))
    inner.attributes.add("noinline")
    for function, called in ((inner, sine), (outer, inner)):
        builder = ir.IRBuilder(function.append_basic_block())
        builder.ret(builder.call(called, function.args))
    return made


def test_only_functions_of_the_object_are_exported():
    code = jit.compiled(rooted(), wasm32())
    assert wasm.module(code, ["outer"]).startswith(wasm.HEAD)
    with pytest.raises(ValueError, match="sin"):
        wasm.module(code, ["sin"])
    with pytest.raises(ValueError, match="whole"):
        wasm.module(code[:-3], ["outer"])
    with pytest.raises(ValueError, match="object file"):
        wasm.module(b"ELF" + code, ["outer"])


def test_what_the_c_library_would_give_is_asked_of_the_page(tmp_path):
    (tmp_path / "a.wasm").write_bytes(wasm.module(jit.compiled(rooted(), wasm32()), ["outer", "inner"]))
    script = """
        const env = { sin: Math.sin, __linear_memory: new WebAssembly.Memory({ initial: 1 }) };
        env.__stack_pointer = new WebAssembly.Global({ value: "i32", mutable: true }, 1024);
        const module = new WebAssembly.Module(require("fs").readFileSync("a.wasm"));
        const { outer, inner } = new WebAssembly.Instance(module, { env }).exports;
        console.log(outer(0.5) === Math.sin(0.5) && inner(0.5) === Math.sin(0.5));
    """
    said = subprocess.run(["node", "-e", script], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert said.strip() == "true"
