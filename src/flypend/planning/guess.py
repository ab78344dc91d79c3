"""Guesses from which plans begin: a rod pumped up by a pivot that hardly moves, or one that leans in a window.

A pumped guess follows the equations of the rod and asks the thrust for the pivot's acceleration a; the vehicle turns
towards that thrust as if nothing limited its rotors. So it has gaps, which the solver closes. In own units, with
E = |H|²/2 + y₃ the energy of the rod, which is 1 upright and at rest,

    Ė = −a · ẏ,   d(H₃)/dt = −a · (e₃ × y),   F = (M+m)(e₃ + a) + m ÿ,

so that a = −k (E* − E) ẏ + k_c H₃ (e₃ × y) pumps, and stops the rod from circling. Near the top, a balances it instead.

Upright is a saddle, from which no first step tells a rod which way to lean: the height of its end does not change with
a small lean. Where the lean is limited and there is a window to pass, most guesses therefore lean in the wall. Their
rods lean by λ(t), a level vector, which takes an acceleration λ − λ̈ of the pivot while it is small. λ is the least sum
of bumps that brings the pivot from the start to rest at the target, through the middle of each window at a given speed,
and leans as wanted there. Thrust and attitude follow from it, as far as the rotors can. Arcs are made likewise.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

from flypend.building import built
from flypend.compile.llvm.stagewise import WIDTH, Stagewise, stagewise
from flypend.geometry import E3, cross, dot, norm, unit
from flypend.model import State
from flypend.model.state import SIZE
from flypend.planning.dynamics import Array, Stage, cayley, turn_by
from flypend.planning.problem import Request
from flypend.planning.riccati import solve
from flypend.plants.lag import hold

# Per style: largest acceleration of the pivot, k, bandwidth of its position, E*, k_c, the height y₃ above which the rod
# is balanced, its squared speed up to which it is, and whether it is caught below that height instead of pumped. They
# were chosen on 40 starts of hehn2011, so that many starts are solved from several of them.
CATCH = ((3.0, 0.7), (4.0, 1.5), (5.0, 3.0), (8.0, 3.0))
PUMPS = np.array(
    [
        (0.5, 1.0, 1.0, 1.0, 0.5, 0.9, 1.5, 0),
        (1.0, 2.0, 1.5, 1.0, 1.0, 0.9, 1.5, 0),
        (2.0, 4.0, 1.5, 1.0, 1.0, 0.9, 1.5, 0),
        (1.0, 2.0, 2.5, 1.0, 1.0, 0.9, 1.5, 0),
        (2.0, 2.0, 2.5, 1.0, 1.0, 0.9, 1.5, 0),
        (0.3, 1.0, 1.0, 1.0, 0.5, 0.999, 1.5, 0),  # lets a leaning rod fall, which takes less room than to catch it
        (4.0, 4.0, 2.0, 1.0, 1.0, 0.9, 1.5, 0),
        (0.7, 1.5, 1.2, 1.05, 0.7, 0.9, 1.5, 0),
    ]
)
# For a rod that may not fall: caught, gently and hard.
CATCHES = np.array([(largest, k, bandwidth, 1.0, 0.5, 0.9, 1e3, 1) for largest, k in CATCH for bandwidth in (0.3, 0.7)])
SUBSTEPS = 3
POLES = 0.7  # −p, all four of the balanced rod near the top: ẍ = a, ÿ = y − a
ALIGNED = 0.7  # cosine between thrust and wanted force from which the force counts as given
KICK = 0.5  # acceleration that moves a hanging rod at rest
ATTITUDE_SHARE = 0.5  # stiffness of the attitude per largest angular acceleration, 1/rad

ENERGY, TOP, NEVER = 3, 5, 2.0  # places in a style, and a height that no rod has: it is not balanced

assert len(PUMPS) == len(CATCHES) == WIDTH
# Per style: lean along the width of a window and along its normal, as shares of what is allowed, and speed, own units;
# two guesses stay upright. Then those for another attempt. They were chosen on windows of 0.3 m to 0.5 m by 0.55 m and
# 0.7 m, with hehn2011.
FIRST = [(0, 0, 0), (0, 0, 0), (0, 0.4, 2), (0.4, 0, 2), (0.6, 0, 3), (-0.6, 0, 3), (0.4, 0, 3), (0, 0.4, 3)]
AGAIN = [
    (-0.4, 0, 2), (-0.4, 0, 3), (0.6, 0, 2), (-0.6, 0, 2), (0, 0.6, 3), (0, 0.4, 2.5), (0.5, 0, 2.5), (-0.5, 0, 2.5)
]  # fmt: skip
WAYS = np.array([FIRST, AGAIN])
AZIMUTHS = np.pi / 4 * np.arange(8) + 0.2  # of the ways in which the rod turns, off the planes of the rotors,
BUMPS_ASIDE = (0.3, 0.8)  # and how wide: a straight rod turns in its plane anyway
PLANAR = 1e-6  # share of the largest singular value below which an arc stays in a plane
BUMPS = 16
MOST = 0.95  # of the lean that is allowed
LEAST = 1e-9


def styles(asked: Request) -> Array:
    """Return the styles (9, lanes) for what is `asked`, the last entry being the stiffness of the attitude, own units.

    They depend on whether the rod may fall and be pumped up again, and on whether it is to hang at the end.
    """
    vehicle = asked.vehicle
    low, high = vehicle.rotor_limits
    moments = vehicle.mixing()[1:3]
    largest = np.sum(np.abs(moments), axis=1) * (high - low) / 2 / np.diag(vehicle.I)[:2]
    stiffness = ATTITUDE_SHARE * float(np.min(largest)) * asked.units.time**2
    found = np.vstack([(PUMPS if asked.falls else CATCHES).T, np.full(WIDTH, stiffness)])
    if asked.end.y[2] < 0:
        found[ENERGY], found[TOP] = -1.0, NEVER
    return found


@built(maxsize=8)
def pump_program(rotors: int) -> Stagewise:
    """Return the compiled guess (state, style, limits, timing, vehicle) → state after a stage, and command."""
    return stagewise(_pump(Stage(rotors)), shared=(1, 2, 3, 4))


def _pump(stage: Stage) -> ca.Function:
    machine, s = stage.machine, State.symbolic(stage.before[:SIZE])
    style, limits = ca.SX.sym("style", 9), ca.SX.sym("limits", 2)
    h, e3 = stage.timing[0] / SUBSTEPS, ca.SX(ca.DM(E3))
    x, x_dot, R, omega, y, H = s.x, s.x_dot, s.R, s.omega, s.y, cross(s.y, s.y_dot)
    for _ in range(SUBSTEPS):
        a = _acceleration(x, x_dot, y, H, style, e3)
        F = _force(a, y, H, machine.m, e3)
        # Turned away from that force, the vehicle cannot give it.
        thrust = ca.fmax(dot(F, R[:, 2]), 0)
        trust = _smooth_step(10 * (thrust / ca.sqrt(dot(F, F) + 1e-4) - ALIGNED))
        a = trust * a + (1 - trust) * (a + thrust * R[:, 2] - F)
        H_dot = -cross(y, e3 + a)
        z_d = ca.mtimes(R.T, F / ca.sqrt(dot(F, F) + 1e-4))
        tilt = 2 * cross(e3, z_d) / (1.1 + z_d[2])
        turning = style[8] * tilt - 1.8 * ca.sqrt(style[8]) * omega
        turning[2] = -2 * omega[2]
        x_dot, omega = x_dot + h * a, omega + h * turning
        x, R = x + h * x_dot, ca.mtimes(R, cayley(h * omega))
        H = H + h * H_dot
        y = turn_by(h * H, y)
        H = H - dot(H, y) * y
    wrench = ca.vertcat(ca.fmax(dot(F, R[:, 2]), 0), ca.mtimes(machine.I, turning))
    mixing = machine.mixing()
    wanted = ca.mtimes(mixing.T, solve(ca.mtimes(mixing, mixing.T), wrench))
    command = ca.fmin(ca.fmax(wanted, limits[0]), limits[1])
    _, rotors = hold(stage.before[SIZE:], command, stage.timing)
    moved = State.symbolic(ca.vertcat(x, x_dot, ca.vec(R.T), omega, y, cross(H, y))).packed()
    inputs = [stage.before, style, limits, stage.timing, machine.numbers]
    return ca.Function("pump", inputs, ca.cse([ca.densify(ca.vertcat(moved, rotors)), ca.densify(command)]))


def _force(a: ca.SX, y: ca.SX, H: ca.SX, m: ca.SX, e3: ca.SX) -> ca.SX:
    """Return the force of the rotors that gives the pivot the acceleration `a`."""
    return e3 + a + m * (cross(-cross(y, e3 + a), y) - dot(H, H) * y)


def _acceleration(x: ca.SX, x_dot: ca.SX, y: ca.SX, H: ca.SX, style: ca.SX, e3: ca.SX) -> ca.SX:
    """Return the acceleration of the pivot that a `style` asks for."""
    largest, gain, bandwidth, energy, uncircle, top, slow, caught, _ = ca.vertsplit(style)
    y_dot, speed = cross(H, y), dot(H, H)
    pump = -gain * (energy - speed / 2 - y[2]) * y_dot + uncircle * H[2] * cross(e3, y)
    high = _smooth_step(25 * (y[2] - top)) * _smooth_step(4 * (slow - speed))
    stuck = ca.logic_and(speed + 1 - y[2] ** 2 < 0.02, y[2] * energy < 0)  # at rest, where it is not to be
    kick = ca.if_else(stuck, KICK, 0) * ca.SX([1, 0, 0])
    back = -(bandwidth**2) * x - 1.6 * bandwidth * x_dot
    p = POLES
    balance = (1 + 6 * p**2 + p**4) * y + 4 * p * (1 + p**2) * y_dot + p**4 * x + 4 * p**3 * x_dot
    balance[2] = back[2]
    a = (1 - high) * (pump + back) + high * balance + kick
    a[2] = 0.6 * a[2]
    # The rod follows −(e₃ + a) across it: of that force the part along the rod is free, and carries it if it can.
    up = e3 - y[2] * y
    across = 2 * ca.sqrt(gain) * y_dot - gain * up
    catch = y[2] * y + across - e3
    low = caught * (1 - high)
    a = (1 - low) * a + low * catch
    return a * ca.fmin(1, largest / (norm(a) + 1e-9))


def _smooth_step(value: ca.SX) -> ca.SX:
    """Return a step from 0 to 1 about `value` 0, without an exponential."""
    return (1 + value / ca.sqrt(1 + value**2)) / 2


def arcs(asked: Request, stages: int, h: float) -> list[tuple[Array, Array]]:
    """Return guesses as `lean_guess` does, in which the rod turns to its end on one smooth arc: the quickest ways.

    The rod is y = w/|w| with w a quintic step from the start to the end, its first rate that of the start, and a bump
    sideways that says which way it turns. What it does needs the force −ÿ across the rod. That along the rod is free:
    the least change of it, from what carries the rod, that brings the pivot to rest at the target. There are as many as
    ways in `AZIMUTHS` and `BUMPS_ASIDE`.
    """
    t, T = np.linspace(0, 1, stages + 1)[:, None], stages * h
    step, start = t**3 * (10 - 15 * t + 6 * t**2), asked.start
    across, begun = 16 * (t * (1 - t)) ** 2, t * (1 - t) ** 3 * T * start[21:24]
    left, share = T * (1 - t), np.full((stages + 1, 1), h)
    share[[0, -1]] /= 2
    rest, found = -np.concatenate([start[3:6], start[:3] + T * start[3:6]]), []
    for azimuth in AZIMUTHS:
        for aside in BUMPS_ASIDE:
            way = aside * np.array([np.cos(azimuth), np.sin(azimuth), 0])
            y = unit((1 - step) * start[18:21] + step * asked.end.y + across * way + begun)
            bent = np.gradient(np.gradient(y, h, axis=0), h, axis=0)
            a = y * (y[:, 2:] + np.sum(bent * y, axis=1, keepdims=True)) - bent - E3
            moves = np.hstack([y, left * y]) * share
            missed = rest - np.concatenate([np.sum(share * a, axis=0), np.sum(share * left * a, axis=0)])
            a = a + y * (np.linalg.lstsq((moves / np.sqrt(share)).T, missed, rcond=PLANAR)[0][:, None] / np.sqrt(share))
            x_dot = start[3:6] + _integral(a, h)
            found.append(_with_thrust(asked, start[:3] + _integral(x_dot, h), y, h))
    return found


def leans(asked: Request, style: int) -> bool:
    """Whether a guess of this `style` leans in the windows that are `asked` for."""
    return asked.leaning and bool(np.any(WAYS[int(asked.again), style]))


def lean_guess(asked: Request, style: int, stages: int, h: float) -> tuple[Array, Array]:
    """Return states (stages + 1, 24 + n) and commands (stages, n) of a guess that leans, in stages of `h`, own units.

    The first state is the start, from which it may jump.
    """
    windows, most = asked.kept.windows, float(asked.kept.lean or 0)
    along, across, speed = WAYS[int(asked.again), style]
    begin, middles = asked.start[:3], [(w.centre - asked.target) / asked.units.length for w in windows]
    route = np.array([begin, *middles, np.zeros(3)])
    passed = np.cumsum(np.linalg.norm(np.diff(route, axis=0), axis=1))
    when = np.clip(np.rint(stages * passed[:-1] / passed[-1]).astype(int), 1, stages - 1)
    wanted = np.array([most * (along * w.axes[0, :2] + across * w.axes[2, :2]) for w in windows])
    onward = np.array([-np.sign(begin @ w.axes[2]) * unit(w.axes[2] * (1, 1, 0))[:2] for w in windows])
    lean, level = _lean(stages, h, when, wanted, (route[1:] - begin)[:, :2], speed * onward)
    size = np.hypot(*lean.T)[:, None] + LEAST
    held = np.minimum(size, MOST * most)
    # In the wall the middle of the rod is at the height of the middle of the window.
    under = asked.vehicle.reach / asked.units.length * np.cos(np.hypot(*wanted.T)) / 2
    heights = [begin[2], *(route[1:-1, 2] - under), 0.0]
    x = np.column_stack([begin[:2] + level, _smooth(np.arange(stages + 1.0), [0, *when, stages], heights)])
    return _with_thrust(asked, x, np.hstack([np.sin(held) * lean / size, np.cos(held)]), h)


def _lean(
    stages: int, h: float, when: Array, wanted: Array, places: Array, speeds: Array
) -> tuple[Array, Array]:  # fmt: skip
    """Return λ and the way of the pivot, (stages + 1, 2) each.

    At the stages `when` (k,), λ is as `wanted` (k, 2), and the pivot passes `places` (k + 1, 2), about its start, with
    `speeds` (k, 2); in the last place it rests.
    """
    width = stages / (BUMPS + 1)
    off = (np.arange(stages + 1)[:, None] - width * np.arange(1, BUMPS + 1)) / width
    bumps = np.cos(np.pi / 2 * np.clip(off, -1, 1)) ** 2
    fast = _integral(bumps, h) - np.gradient(bumps, h, axis=0)
    far = _integral(fast, h)
    rows = np.array([*far[[*when, stages]], *fast[[*when, stages]], *bumps[when]])
    shares = np.linalg.lstsq(rows, np.array([*places, *speeds, np.zeros(2), *wanted]), rcond=None)[0]
    return bumps @ shares, far @ shares


def _integral(values: Array, h: float) -> Array:
    """Return the integral of `values` (stages + 1, k) from the first on, by trapezia."""
    whole: Array = h * (np.cumsum(values, axis=0) - (values + values[0]) / 2)
    return whole


def _smooth(at: Array, knots: list[int], values: list[float]) -> Array:
    """Return smooth steps through `values` at `knots`, which grow."""
    k = np.clip(np.searchsorted(knots, at, side="right") - 1, 0, len(knots) - 2)
    first, run = np.array(knots)[k], np.diff(knots)[k]
    share = (at - first) / run
    steps: Array = np.array(values)[k] + np.diff(values)[k] * share**2 * (3 - 2 * share)
    return steps


def _with_thrust(asked: Request, x: Array, y: Array, h: float) -> tuple[Array, Array]:
    """Return states and commands for pivot and rod, (stages + 1, 3) each, that move like this."""
    m = asked.vehicle.m / (asked.vehicle.M + asked.vehicle.m)
    x_dot, y_dot = np.gradient(x, h, axis=0), np.gradient(y, h, axis=0)
    force = E3 + np.gradient(x_dot + m * y_dot, h, axis=0)
    z, forward = unit(force), asked.start[[6, 9, 12]]
    first = unit(forward - (z @ forward)[:, None] * z)
    R = np.stack([first, cross(z, first), z], axis=-1)
    turning = np.swapaxes(R, 1, 2) @ np.gradient(R, h, axis=0)
    omega = np.stack([turning[:, 2, 1], turning[:, 0, 2], turning[:, 1, 0]], axis=-1)
    low, high = asked.vehicle.rotor_limits / asked.units.force
    forces = np.repeat(np.clip(np.linalg.norm(force, axis=1), low, high)[:, None], asked.rotors, axis=1)
    states = np.hstack([x, x_dot, R.reshape(len(x), 9), omega, y, y_dot, forces])
    states[0] = asked.start
    return states, forces[:-1]
