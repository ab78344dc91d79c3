"""The board as one program: the same as its stages, and the only thing that a flight computer needs to keep."""

from pathlib import Path

import numpy as np
import pytest

import flypend as fp
from flypend.board.computer import SteppedBoard
from flypend.board.program import board, initial_memory, parts
from flypend.compile.numeric import as_numpy
from flypend.compile.routine import lower_calls
from flypend.plants import Plant
from flypend.plants.loop import Loop

VEHICLE = fp.vehicle("hehn2011")
LAW = fp.laws.inverted().bind(VEHICLE)
NONE = np.zeros(0)
PLANTS = {
    "rotors": Plant(),
    "slow": Plant(rate=100.0),
    "rates": Plant(interface="rates", rate=50.0, delay=0.03),
    "without limits": Plant(limits=False),
}


@pytest.mark.parametrize("name", PLANTS)
def test_one_step_of_the_program_is_its_stages_one_after_the_other(name):
    loop = Loop(VEHICLE, LAW, PLANTS[name])
    made, rng = board(loop), np.random.default_rng(3)
    least = np.full(4, VEHICLE.rotor_limits[0])
    stepped, step, memory = SteppedBoard(loop, least), as_numpy(made), initial_memory(loop, least)
    assert len(memory) == parts(loop).memory.length == made.size1_in(0)
    for k, state in enumerate(fp.State.random(rng, 30)):
        t = k / loop.plant.rate
        command = stepped.command(t, state.packed())
        memory, given = step(memory, np.append(t, state.packed()), NONE, NONE, NONE)
        np.testing.assert_allclose(given, command, rtol=1e-12, atol=1e-12)


def test_a_program_of_ones_own_steers_in_place_of_the_law():
    """It gets what the law gets, and what it commands is what the board remembers."""
    loop, least, state = Loop(VEHICLE, LAW, Plant()), np.full(4, VEHICLE.rotor_limits[0]), fp.State(y=(0.0, 0.6, 0.8))
    given = []

    def steer(*predicted):
        given.append(predicted)
        return own.law(*predicted)

    own, plain = SteppedBoard(loop, least, steer=steer), SteppedBoard(loop, least)
    held = SteppedBoard(loop, least, steer=lambda *_: np.full(4, 2.0))
    for k in range(40):
        t, measured = k / loop.plant.rate, state.packed()
        np.testing.assert_array_equal(own.command(t, measured), plain.command(t, measured))
        np.testing.assert_array_equal(held.command(t, measured), np.full(4, 2.0))
        np.testing.assert_array_equal(given[k][1], plain.predicted[0])
    # When the last command acts, the rotors of the model have followed the first for 39 periods.
    followed = 2 - (2 - least) * np.exp(-39 / loop.plant.rate / VEHICLE.rotor_lag)
    np.testing.assert_allclose(held.predicted[1], followed, rtol=1e-9)


def test_it_remembers_as_many_commands_as_can_be_under_way():
    for latency, rate, commands in ((0.0, 500.0, 1), (0.024, 500.0, 12), (0.003, 100.0, 1), (0.03, 50.0, 2)):
        law = fp.laws.inverted(latency=latency, delay_reach=0).bind(VEHICLE)
        memory = parts(Loop(VEHICLE, law, Plant(rate=rate))).memory
        assert memory.split(np.arange(memory.length))["commands"].size == 4 * commands


def test_nothing_but_its_memory_decides_what_it_answers():
    loop = Loop(VEHICLE, LAW, Plant())
    step, least = as_numpy(board(loop)), np.full(4, VEHICLE.rotor_limits[0])
    measured = np.append(0.1, fp.State(y=(0.0, 0.0998, 0.995)).packed())
    memory = initial_memory(loop, least)
    first = step(memory, measured, NONE, NONE, NONE)
    np.testing.assert_array_equal(first[1], step(memory, measured, NONE, NONE, NONE)[1])
    # Negative control: with what it remembers of the first step it answers otherwise.
    assert np.max(np.abs(first[1] - step(first[0], measured, NONE, NONE, NONE)[1])) > 1e-3


def test_a_control_period_predicts_in_one_step():
    """A prediction of more steps than one must be wanted."""
    made = lower_calls(board(Loop(VEHICLE, LAW, Plant())))
    assert made.operations() < 3600  # some 3,000; a step more of the prediction takes 900
    find = next(program for program in made.programs if program.name == "find_delay")
    told = f"{made.operations():,} operations, {sum(find.counts().values()):,} of them to find the delay"
    assert len(made.calls) == len(made.programs) == 6  # "calls six programs"
    assert told in (Path(__file__).parents[2] / "docs" / "flight" / "engine.md").read_text(encoding="utf-8")
    slow = fp.laws.inverted(latency=0.075, delay_reach=0).bind(VEHICLE)
    assert lower_calls(board(Loop(VEHICLE, slow, Plant()))).operations() < 2400 + 2 * 900
