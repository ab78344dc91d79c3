"""The ideal plant as WebAssembly, flown by Node.js through the engine of the pages, beside the native kernel."""

from dataclasses import replace

import numpy as np
import pytest
from by_page import DURATION, EXACT, OTHERS, PAIRS, ended_by_page, flown_by_page

import flypend as fp
from flypend.flight.kernels.ideal import ideal_kernel
from flypend.flight.live import PERIOD, tunable
from flypend.flight.request import Tolerances
from flypend.flight.verdict import goal
from flypend.lab.flying import poke_state
from flypend.lab.setting import Poke
from flypend.laws.references import circle
from flypend.model.state import convert_packed
from flypend.plants import plant
from flypend.plants.loop import Loop
from tests.few import slow

EVERY = 50  # rows
CHANGES = np.random.default_rng(1).standard_normal((4, 24))
OTHER_STEPS = np.linspace(0.8, 1.25, 30)  # one in ten of them meets a corner as unluckily as the worst by rounding
TIGHT = Tolerances(rtol=1e-12, max_steps=1_000_000)  # more steps than pages take by themselves


def start():
    return fp.State(y=(0.6, 0.0, 0.8), y_dot=(0, 0.2, 0), x=(0.1, 0, 0))


def loop_of(law, vehicle="hehn2011", **given):
    machine = fp.vehicle(vehicle)
    return Loop(machine, getattr(fp.laws, law)(**given).bind(machine), plant("ideal"))


def flown_here(loop, packed, exact=EXACT):
    """States (n, 24) at every `EVERY`th row, in the frame of the law, NaN after the end, and what the kernel tells."""
    kernel = ideal_kernel(loop, goal(loop.law.e3), method=exact.method_for(loop.law), precision=exact.precision)
    rows = np.arange(round(DURATION / PERIOD) + 1)
    flown = kernel.fly(
        packed[None], DURATION, exact, judge_at=rows[::5] * PERIOD, keep_at=rows[EVERY::EVERY] * PERIOD,
        workers=1,
    )  # fmt: skip
    return np.concatenate([packed[None], flown.samples[0]]), flown


@pytest.mark.parametrize(("law", "vehicle"), PAIRS)
def test_a_page_flies_the_ideal_plant(law, vehicle, tmp_path):
    assert_equal(law, vehicle, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize(("law", "vehicle"), OTHERS)
def test_a_page_flies_all_that_ships(law, vehicle, tmp_path):
    assert_equal(law, vehicle, tmp_path)


def assert_equal(law, vehicle, tmp_path):
    """Closer than 1e-9, or than three times what changes of the start by 1e-12, or of the tolerance, make of it.

    The tolerance is tight: near the corners of a law, the steps depend on rounding.
    """
    loop, packed = loop_of(law, vehicle), start().packed()
    page, [told] = flown_by_page(loop, start(), tmp_path, exact=TIGHT)
    here, flown = flown_here(loop, packed, TIGHT)
    assert told["status"] == flown.code[0]
    assert told["end"] == pytest.approx(flown.end[0], abs=1e-9)
    error, lived = (
        np.max(np.abs(convert_packed(page[0, ::EVERY, :24], loop.law.e3) - here), axis=1),
        ~np.isnan(here[:, 0]),
    )
    assert np.array_equal(~np.isnan(error), lived)
    moved = [flown_here(loop, packed + 1e-12 * change, TIGHT)[0] for change in CHANGES]
    moved += [flown_here(loop, packed, replace(TIGHT, rtol=share * TIGHT.rtol))[0] for share in OTHER_STEPS]
    apart = np.maximum.accumulate(np.max(np.abs(moved - here), axis=(0, 2)))
    scale = 1 + np.max(np.abs(here), axis=1)
    # A change of the start comes once, rounding at every step.
    assert np.all((error < 1e-9 * scale)[lived] | (error < 3 * apart)[lived])
    if told["status"] == 0:
        judged = [np.inf if value is None else value for value in told["reductions"]]  # JSON has no infinity
        np.testing.assert_allclose(judged[:6], flown.reductions[0, :6], rtol=1e-5, atol=1e-6)
        assert judged[6] == pytest.approx(flown.reductions[0, 6], rel=0.01)  # the peak of a force, seen at the steps


@pytest.mark.parametrize("law", ["corrected", "repaired", "almost_global"])
def test_a_law_without_corners_needs_no_tight_tolerance(law, tmp_path):
    loop = loop_of(law)
    page, _ = flown_by_page(loop, start(), tmp_path)
    here, _ = flown_here(loop, start().packed())
    np.testing.assert_allclose(convert_packed(page[0, ::EVERY, :24], loop.law.e3), here, rtol=1e-9, atol=1e-9)


def test_its_rotor_forces_are_those_that_the_law_requires(tmp_path):
    loop = loop_of("corrected", "nayak2018")
    page, _ = flown_by_page(loop, start(), tmp_path)
    run = fp.simulate(loop.vehicle, fp.laws.corrected(), start(), DURATION, plant="ideal")
    ticks = np.rint(run.t / PERIOD).astype(int)
    np.testing.assert_allclose(page[0, ticks, 24:], run.rotor_forces, atol=1e-9)


@pytest.mark.parametrize("law", ["corrected", slow("inverted")])
def test_pokes_gains_and_a_moved_place_are_those_of_the_package(law, tmp_path):
    rng, loop = np.random.default_rng(3), loop_of(law)
    loop = replace(loop, parameters=tunable(loop.law))
    state, pieces, here = start().in_frame(loop.law.e3), [], []
    for ticks in (1, 400, 99, 700):
        gains = {name: loop.law.gains[name] * rng.uniform(0.97, 1.03) for name in loop.parameters}
        velocity, origin = rng.normal(0, 0.1, 3), rng.normal(0, 0.2, 3)
        impulses = [0, 0, 0, *(loop.vehicle.bob_mass * velocity)]
        pieces.append({"ticks": ticks, "impulses": impulses, "gains": gains, "knobs": {"origin": origin.tolist()}})
        state = poke_state(state, loop.vehicle, "up", Poke(0.0, "bob", velocity))
        flown = getattr(fp.laws, law)(**gains)
        run = fp.simulate(loop.vehicle, flown, _moved(state, -origin).in_frame(flown.e3), ticks * PERIOD, plant="ideal")
        state = _moved(run.states[-1].in_frame(flown.e3), origin)
        here.append(state.packed())
    page, _ = flown_by_page(loop, start(), tmp_path, pieces)
    ends = np.cumsum([piece["ticks"] for piece in pieces])
    np.testing.assert_allclose(page[0, ends, :24], here, atol=1e-9 if law == "corrected" else 1e-6)


def _moved(state, by):
    packed = state.packed().copy()
    packed[:3] += by
    return fp.State.from_packed(packed)


def test_a_flight_in_pieces_is_judged_as_a_whole(tmp_path):
    """The criterion's times, excursion and forces of pieces are those of one flight."""
    loop = loop_of("inverted")
    count = round(DURATION / PERIOD)
    _, [whole] = flown_by_page(loop, start(), tmp_path, [{"ticks": count}])
    _, [parts] = flown_by_page(loop, start(), tmp_path, [{"ticks": n} for n in (3, 297, 1000, 1, count - 1301)])
    np.testing.assert_allclose(parts["reductions"], whole["reductions"], rtol=1e-5, atol=1e-6)
    assert whole["reductions"][0] == pytest.approx(2.0, abs=0.02)


def test_flights_that_take_the_lanes_in_turn_end_as_in_the_package(tmp_path):
    """More of them than the page flies in one call, some of which LQR loses."""
    loop, starts = loop_of("lqr"), fp.random_starts(21, 5)
    codes, ends, reductions = ended_by_page(loop, starts, tmp_path)
    flown = ideal_kernel(loop, goal("up")).fly(
        starts.packed(), DURATION, EXACT, judge_at=PERIOD * np.arange(0, round(DURATION / PERIOD) + 1, 5)
    )
    assert codes == flown.code.tolist()
    np.testing.assert_allclose(ends, flown.end, rtol=1e-6)
    good = np.isfinite(flown.reductions[:, 0]) & (flown.code == 0)
    assert 0 < good.sum() < len(good)
    np.testing.assert_allclose(reductions[good, :5], flown.reductions[good, :5], rtol=1e-4, atol=0.011)


def test_a_reference_that_moves_is_followed_from_piece_to_piece(tmp_path):
    loop = loop_of("inverted", reference=circle(radius=0.5, rate=1.5))
    count = round(DURATION / PERIOD)
    whole, _ = flown_by_page(loop, start(), tmp_path)
    parts, _ = flown_by_page(loop, start(), tmp_path, [{"ticks": 500}] * (count // 500))
    here, _ = flown_here(loop, start().packed())
    np.testing.assert_allclose(whole[0, ::EVERY, :24], here, atol=1e-6)
    np.testing.assert_allclose(parts[0, ::EVERY, :24], here, atol=1e-6)
