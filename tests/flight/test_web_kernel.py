"""Kernels as WebAssembly, flown by Node.js through the engine of the pages, beside native ones."""

import json
import subprocess
from pathlib import Path

import casadi as ca
import numpy as np
import pytest
from by_page import DURATION, EXACT, OTHERS, PAIRS, SEED, ended_by_page, flown_by_page
from llvmlite import ir

import flypend as fp
from flypend.compile import wasm
from flypend.compile.llvm import jit
from flypend.compile.llvm.emit import Lanes, Module, define
from flypend.compile.llvm.target import wasm32
from flypend.compile.program import LIBRARY, LIBRARY_2, lower
from flypend.flight.kernels.pieces import pieces_kernel
from flypend.flight.kernels.sampled import sampled_kernel
from flypend.flight.kernels.web import web_module
from flypend.flight.live import tunable
from flypend.flight.simulate import Signals
from flypend.laws.references import circle
from flypend.model.state import convert_packed
from flypend.plants import plant
from flypend.plants.loop import Loop
from flypend.plants.plant import Noise, Plant, Wind

KEPT = 60
CHANGE = np.random.default_rng(1).standard_normal(24)


def flown_here(loop, starts):
    count = round(DURATION * loop.sampled.rate)
    keep, judge = np.arange(0, count + 1, count // KEPT), np.arange(0, count + 1, round(loop.sampled.rate / 100))
    kernel = sampled_kernel(loop, fp.Criterion())
    return kernel.fly(starts.packed(), DURATION, judge_at=judge, keep_at=keep, first_seed=SEED, workers=1)


def assert_equal(loop, starts, tmp_path):
    """Closer than 1e-9, or, where a flight amplifies rounding, than what a change of the start by 1e-12 makes of it.

    A flight that makes 1e-3 of that is chaos, which no two processors share.
    """
    (page, ends), here = flown_by_page(loop, starts, tmp_path), flown_here(loop, starts)
    own = convert_packed(page[:, :: (page.shape[1] - 1) // KEPT, :24], loop.law.e3)
    assert [end["status"] for end in ends] == here.code.tolist()
    scale, kept = 1 + np.abs(here.samples[..., :24]), here.samples[..., :24]
    beside = flown_here(loop, fp.State.trusted(starts.packed() + 1e-12 * CHANGE)).samples[..., :24]
    apart = np.maximum.accumulate(np.nanmax(np.abs(beside - kept) / scale, axis=-1), axis=-1)
    error = np.nanmax(np.abs(own - kept) / scale, axis=-1)
    assert np.array_equal(np.isnan(own), np.isnan(kept))
    assert np.all((error < 1e-9) | (error < apart) | (apart > 1e-3))
    assert np.all(error[:, : KEPT // 6] < 1e-9)  # and always in the first second
    told = (here.code == 0) & (apart[:, -1] < 1e-3)
    effort = np.array([end["reductions"][5] for end in ends])
    np.testing.assert_allclose(effort[told], here.reductions[told, 5], rtol=1e-3)  # what may differ in the flights
    return error


def start():
    return fp.State.from_packed(fp.State(y=(0.6, 0.0, 0.8), y_dot=(0, 0.2, 0), x=(0.1, 0, 0)).packed()[None])


def loop_of(law, vehicle="hehn2011", through="rotors"):
    machine = fp.vehicle(vehicle)
    return Loop(machine, getattr(fp.laws, law)().bind(machine), plant(through) if isinstance(through, str) else through)


REAL = plant("rotors").replace(
    delay=0.006,
    noise=Noise(x=1e-3, x_dot=1e-2, attitude=2e-3, omega=1e-2, y=2e-3, y_dot=2e-2),
    wind=Wind(gust_on_vehicle=0.1, gust_on_bob=0.01),
)


@pytest.mark.parametrize(("law", "vehicle"), PAIRS)
def test_a_page_flies_what_the_package_flies(law, vehicle, tmp_path):
    error = assert_equal(loop_of(law, vehicle), start(), tmp_path)
    if law in ("inverted", "corrected", "repaired"):  # these settle
        assert error.max() < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize(("law", "vehicle"), OTHERS)
def test_a_page_flies_all_that_ships(law, vehicle, tmp_path):
    assert_equal(loop_of(law, vehicle), start(), tmp_path)


def test_noise_gusts_delay_and_observer_are_those_of_the_package(tmp_path):
    starts = fp.random_starts(4, 11)
    error = assert_equal(loop_of("inverted", through=REAL), starts, tmp_path)
    assert error.shape == (4, KEPT + 1)


@pytest.mark.parametrize(
    ("mount", "through", "lanes"),
    [("gimbal", REAL, 2), ("gimbal", REAL, 1), ("hub", plant("rotors"), 2), ("gimbal", Plant(floor=-0.75), 2)],
)
def test_flights_that_share_lanes_end_as_in_the_package(mount, through, lanes, tmp_path):
    """Seven of them, so that one flies alone; lanes keep their own seeds, and some touch a hub or a floor early."""
    vehicle, starts = fp.vehicle("hehn2011").replace(mount=mount), fp.random_starts(7, 5)
    loop = Loop(vehicle, fp.laws.inverted().bind(vehicle), through)
    codes, ends, reductions = ended_by_page(loop, starts, tmp_path, lanes=lanes)
    rate = loop.sampled.rate
    judged = np.arange(0, round(DURATION * rate) + 1, round(rate / 100))
    here = sampled_kernel(loop, fp.Criterion()).fly(starts.packed(), DURATION, judge_at=judged, first_seed=SEED)
    assert codes == here.code.tolist()
    np.testing.assert_allclose(ends, here.end, atol=1e-9)
    lived = here.code == 0
    assert lived.any()
    assert lived.all() == (mount == "gimbal" and through.floor is None)
    np.testing.assert_allclose(reductions[lived], here.reductions[lived], rtol=1e-6, atol=1e-9)


def test_a_reference_that_moves_is_followed(tmp_path):
    machine = fp.vehicle("hehn2011")
    law = fp.laws.inverted(reference=circle(radius=0.5, rate=1.5))
    assert_equal(Loop(machine, law.bind(machine), plant("rotors")), start(), tmp_path)


def test_what_changes_on_the_way_changes_it_as_in_the_package(tmp_path):
    rng, loop = np.random.default_rng(3), loop_of("inverted", through=REAL)
    loop = Loop(loop.vehicle, loop.law, loop.plant, ("rod_bandwidth", "throw_speed"))
    pieces, flight = [], pieces_kernel(loop, fp.Criterion()).begin(start()[0], seed=SEED)
    here = []
    for ticks in (1, 400, 99, 1000, 500, 1000):
        piece = {
            "ticks": ticks, "impulses": rng.normal(0, 0.05, 6).tolist(),
            "gains": {"rod_bandwidth": loop.law.gains["rod_bandwidth"] * rng.uniform(0.9, 1.1)},
            "knobs": {
                "delay": [rng.uniform(0, 0.02)], "lag": [rng.uniform(0.01, 0.05)], "gust_on_vehicle": [0.05],
                "on_bob": rng.normal(0, 0.1, 3).tolist(), "origin": rng.normal(0, 0.2, 3).tolist(),
            },
        }  # fmt: skip
        pieces.append(piece)
        flight.tune(piece["gains"])
        flight.turn(**piece["knobs"])
        here.append(flight.advance(ticks, piece["impulses"]))
    # The page keeps no knob that a piece does not tell; here all pieces tell the same ones.
    page, _ = flown_by_page(loop, start(), tmp_path, pieces)
    assert flight.outcome.status == "completed"
    # Roundoff of two compilers, grown along a loop that is not stable by itself: 3.5e-9 in 4 of 84,028 numbers.
    np.testing.assert_allclose(page[0], np.concatenate(here), atol=1e-8)


@pytest.mark.parametrize("law", ["printed", "corrected", "repaired", "almost_global"])
def test_a_page_knows_the_lyapunov_function_of_the_gains_and_the_place_it_flies(law, tmp_path):
    rng, loop, shown = np.random.default_rng(4), loop_of(law), []
    loop = Loop(loop.vehicle, loop.law, loop.plant, tunable(loop.law))
    gains = {name: loop.law.gains[name] * rng.uniform(0.95, 1.05) for name in loop.parameters}
    pieces = [{"ticks": 20, "gains": gains, "knobs": {"origin": rng.normal(0, 0.2, 3).tolist()}} for _ in range(4)]
    rows = flown_by_page(loop, start(), tmp_path, pieces, shown)[0][0]
    flown = getattr(fp.laws, law)(**gains).bind(loop.vehicle)
    for i, (piece, numbers) in enumerate(zip(pieces, shown, strict=True), 1):
        state = rows[20 * i, :24].copy()
        state[:3] -= piece["knobs"]["origin"]
        t = np.array([20 * i / loop.sampled.rate])
        V = Signals(loop.vehicle, flown, t, convert_packed(state, flown.e3)[None])["V"]
        assert numbers[6] == pytest.approx(V[0], rel=1e-9)


# The module -----------------------------------------------------------------------------------------------------------


def test_the_module_takes_two_things_and_gives_one(tmp_path):
    (tmp_path / "kernel.wasm").write_bytes(web_module(loop_of("inverted"), fp.Criterion(), EXACT))
    script = """
        const module = new WebAssembly.Module(require('fs').readFileSync('kernel.wasm'));
        const names = (list) => list.map(({ name }) => name).sort().join();
        console.log(names(WebAssembly.Module.imports(module)), names(WebAssembly.Module.exports(module)));
    """
    said = subprocess.run(["node", "-e", script], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert said.split() == ["__linear_memory,__stack_pointer,exp", "context_size,kernel,shown,turned"]


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
    code = jit.compile_module(rooted(), wasm32())
    assert wasm.module(code, ["outer"]).startswith(wasm.HEAD)
    with pytest.raises(ValueError, match="sin"):
        wasm.module(code, ["sin"])
    with pytest.raises(ValueError, match="whole"):
        wasm.module(code[:-3], ["outer"])
    with pytest.raises(ValueError, match="object file"):
        wasm.module(b"ELF" + code, ["outer"])


def test_what_the_c_library_would_give_is_asked_of_the_page(tmp_path):
    (tmp_path / "a.wasm").write_bytes(wasm.module(jit.compile_module(rooted(), wasm32()), ["outer", "inner"]))
    script = """
        const env = { sin: Math.sin, __linear_memory: new WebAssembly.Memory({ initial: 1 }) };
        env.__stack_pointer = new WebAssembly.Global({ value: "i32", mutable: true }, 1024);
        const module = new WebAssembly.Module(require("fs").readFileSync("a.wasm"));
        const { outer, inner } = new WebAssembly.Instance(module, { env }).exports;
        console.log(outer(0.5) === Math.sin(0.5) && inner(0.5) === Math.sin(0.5));
    """
    said = subprocess.run(["node", "-e", script], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert said.strip() == "true"


def test_the_page_has_every_function_of_the_c_library(tmp_path):
    """Each that a law may call, by the engine of the pages, at places in its domain."""
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    one = [getattr(ca, name)(x + (name == "acosh")) for name in LIBRARY]
    two = [x**y if name == "pow" else getattr(ca, name)(x, y) for name in LIBRARY_2]
    every, places = ca.Function("every", [x, y], [ca.vertcat(*one, *two)]), [[0.03, 0.2], [0.7, 3.1], [0.99, -0.4]]
    made = Module()
    define(Lanes(made, 1, target=wasm32()), lower(every), visible=True)
    (tmp_path / "a.wasm").write_bytes(wasm.module(jit.compile_module(made, wasm32()), ["every"]))
    (tmp_path / "a.mjs").write_text(f"""
        import {{ readFileSync }} from "node:fs";
        import {{ Engine }} from {json.dumps((Path(__file__).parents[2] / "web/src/engine.js").as_uri())};
        const engine = await Engine.from(new WebAssembly.Module(readFileSync("a.wasm")));
        const [x, y] = [1, 1].map((length) => engine.reserve(Float64Array, length));
        const out = engine.reserve(Float64Array, {len(one) + len(two)});
        console.log(JSON.stringify({json.dumps(places)}.map((place) => {{
            [x.view()[0], y.view()[0]] = place;
            engine.call("every", x, y, out);
            return Array.from(out.view());
        }})));
    """)
    said = subprocess.run(["node", "a.mjs"], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    np.testing.assert_allclose(json.loads(said), [every(*place).full().ravel() for place in places], rtol=1e-14)
