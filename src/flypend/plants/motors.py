"""Motors between command and force: battery voltage, strength of each rotor, and a lag of its own up and down."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Any

import casadi as ca
import numpy as np

from flypend.geometry import Numbers, Scalar, clip, differentiable_root, is_symbolic
from flypend.plants.lag import TIMING_SIZE, Ramp, hold, step_timing
from flypend.plants.plant import Plant

# Fields of a plant on which a step of its motion does not depend: they act before it, after it or on the vehicle.
BESIDE = (
    "engine", "limits", "lag", "rate", "delay", "noise", "sensors", "pivot_offset", "centre_of_mass", "pivot_damping",
    "pivot_friction", "rod_spin", "mismatch", "wind", "interface", "rate_loop_rate", "rate_loop_gain", "seed",
)  # fmt: skip


def motion_parts(plant: Plant) -> Plant:
    """Return what a step of the motion depends on: motors, air and ground of `plant`."""
    return Plant(**{each.name: getattr(plant, each.name) for each in fields(plant) if each.name not in BESIDE})


def settle_forces(command: Numbers, most: float, strength: Any, sag: Scalar) -> Numbers:
    """Return the forces (n,), N, at which rotors settle under a `command` (n,), N, in CasADi; itself if unchanged.

    `most` is the largest command, N; `strength` and `sag` are as in `Plant`, and may be symbols.

    At a given throttle the speed of a rotor is proportional to the voltage V, its force to V², and the current of all
    to their power, Σ f^(3/2). So the share `sag` of the voltage is lost at maximum command of all rotors:

        (V/V₀)² u_i,   V/V₀ = 1 − sag · mean of (u_i/u_max)^(3/2)
    """
    if is_symbolic(sag) or sag > 0:
        command = sag_forces(command, most, sag)
    if is_symbolic(strength):
        return strength * command
    return command if strength == 1.0 else ca.DM(np.broadcast_to(strength, (command.numel(),))) * command


def sag_forces(command: Numbers, most: Scalar, sag: Scalar) -> Numbers:
    """Return (V/V₀)² u_i of `settle_forces` for commands (n,) and their largest, `most`, N; all may be symbols."""
    share = clip(command / most, 0, 1)
    load = ca.sum1(share * differentiable_root(share)) / command.numel()
    return (1 - sag * load) ** 2 * command


def timing_size(plant: Plant) -> int:
    """Return the number of inputs of a step of the rotors; see `motor_timing`."""
    return TIMING_SIZE if plant.spin_up == 1.0 else 2 * TIMING_SIZE


def motor_timing(
    lag: Scalar, plant: Plant, duration: Scalar, timing: Callable[[Any, Any], Numbers] = step_timing
) -> Numbers:
    """Return the `timing` of falling forces, whose time constant is `lag` (s), then of rising ones if it differs."""
    falling = timing(lag, duration)
    if plant.spin_up == 1.0:
        return falling
    both = [falling, timing(plant.spin_up * lag, duration)]
    return ca.vertcat(*both) if is_symbolic(falling) else np.concatenate(both)


def follow(rotors: Numbers, target: Numbers, timing: Numbers) -> tuple[Ramp, Numbers]:
    """Return the ramp of the forces `rotors` (n,) over a step towards `target` (n,), N, and their end, in CasADi.

    `timing` is the result of `motor_timing`. A force rises or falls throughout a step, so this is exact too.
    """
    falling, end = hold(rotors, target, timing[:TIMING_SIZE])
    if timing.numel() == TIMING_SIZE:
        return falling, end
    rising, end_above = hold(rotors, target, timing[TIMING_SIZE:])
    below = rotors < target
    mean, change = (ca.if_else(below, *pair) for pair in zip(rising, falling, strict=True))
    return Ramp(mean, change), ca.if_else(below, end_above, end)
