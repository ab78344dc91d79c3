"""Routines: calls of programs give what CasADi gives, wherever their memory lies."""

import casadi as ca
import numpy as np
import pytest
from llvmlite import ir
from test_vector import compiled

import flypend as fp
from flypend.board.program import board
from flypend.compile.llvm.emit import define_routine
from flypend.compile.llvm.vector import Lanes
from flypend.compile.routine import lower_calls
from flypend.plants.loop import Loop
from flypend.plants.plant import PRESETS


def run(routine, inputs, width):
    lanes = Lanes(ir.Module("test"), width)
    call = compiled(lanes, define_routine(lanes, routine), len(routine.inputs) + len(routine.outputs))
    return call(inputs, [((max(1, len(cells)), width), np.float64) for cells in routine.outputs])


def agrees(function, width=2, seed=1):
    rng = np.random.default_rng(seed)
    inputs = [rng.normal(size=(max(1, function.nnz_in(i)), width)) for i in range(function.n_in())]
    found = run(lower_calls(function), inputs, width)
    for lane in range(width):
        expected = function.call([ca.DM(x[: function.nnz_in(i), lane]) for i, x in enumerate(inputs)])
        for ours, theirs in zip(found, expected, strict=True):
            np.testing.assert_allclose(ours[: theirs.numel(), lane], np.array(theirs).ravel(), rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("name", ["rotors", "hehn2011"])
def test_a_board_as_calls_is_what_casadi_says(name):
    vehicle = fp.vehicle("hehn2011")
    agrees(board(Loop(vehicle, fp.laws.inverted().bind(vehicle), PRESETS[name])).step)
