"""The delay of a loop, found in flight by the flight computer.

Commands act a delay d after their measurement: the wrench W of the rotor model at time t acts at t + d. Over a control
period h, the angular velocity changes by

    Δω = h J⁻¹ (τ̄ − ω × Jω),    τ̄ the mean moment of W from t − h − d to t − d,

which is measured, and ∂Δω/∂d = J⁻¹ (τ(t − h − d) − τ(t − d)) follows from the same past wrenches. So d is estimated by
recursive least squares with forgetting. While moments hardly change, as in hover, they tell nothing, and d stays. A
rotor lag longer than believed counts as delay. Errors in proportion to the thrust and along τ are the vehicle's trim
(see `trim`); τ does not correlate with its rate.

A predictor with a false delay oscillates about as fast as 1/d, and a loop that oscillates fits several delays. So both
sides of what is linear in d, e + d̂ s = d s with error e and slope s, pass the same filter, whose band is below that.
Were e and s filtered by themselves, errors of old estimates would be corrected again and again, and d̂ would overshoot.
The same holds for what is linear in the trim.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

from flypend.board import trim as trimming
from flypend.board.command import OUTSIDE
from flypend.board.nominal import Nominal
from flypend.compile.record import Field, Record
from flypend.geometry import Numbers, Scalar, clip
from flypend.laws.inverted_gains import angular_authority
from flypend.model.momenta import angular_acceleration
from flypend.model.state import SIZE
from flypend.plants.cascade import cascade_step
from flypend.plants.lag import Ramp, hold, join_ramps, step_timing

# Time over which the past is forgotten, s.
FORGETTING = 0.5
# What is assumed of the delay before the flight weighs as much as the rate of a moment that, for a second, changes by
# √0.1 of the largest per second.
DOUBT = 0.1
# Moments at a false time look weak: they count half for the strength of the trim while the delay found moves as fast as
# this, s/s.
SETTLED = 0.007
# Longest delay times the cut-off of the two filters, 1.
BAND = np.pi / 2
# Time between the forces that are remembered, s, at least; rotors with a lag change little within it.
SPACING = 8e-3
# Shortest delay, in control periods, so that the mean over it exists.
LEAST = 1e-3
WRENCH = 4


class DelayEstimator:
    """What finds the delay of a loop, and predicts over it.

    Parameters
    ----------
    nominal : Nominal
        The nominal vehicle.
    told, reach : float
        The delay (s) to begin with, and how much longer it may be.
    period : float
        Control period, s.
    lag_left : float
        What is left of the rotors' lag after the computer's lead, s. It is predicted over as well, under the last
        command.
    assumed : float
        The delay of the forces that act, s, as an estimator of the state assumes it until the flight has told enough.
    """

    def __init__(
        self, nominal: Nominal, initial: float, reach: float, period: float, lag_left: float = 0.0, assumed: float = 0.0
    ) -> None:
        self._assumed = max(assumed, LEAST * period)
        self._lag_left = lag_left
        self._nominal, self._period = nominal, period
        self._told, self._longest = max(initial, LEAST * period), initial + reach
        self._stride = max(1, round(SPACING / period))
        self.depth = int(np.ceil(self._longest / self._spacing - 1e-9))

    @property
    def record(self) -> Record:
        """Table of the memory."""
        fields = (
            Field("begun", 0, "1 once it has a measurement, else 0"),
            Field("phase", 0, "control periods since the newest forces remembered"),
            Field("found", 0, "the delay, s"),
            Field.of(trimming.RECORD),
            Field("information", 0, "what the past tells of the delay, rad^2/s^5"),
            Field("omega", 3, "angular velocity at the last measurement, body, rad/s"),
            Field("earlier", 3, "what the moment that acted then makes of it, rad/s^2"),
            Field("smooth", 10, "error, slope, model, rad/s^2, rad/s^3 and rad/s^2, and thrust, N, filtered"),
            Field("smoother", 10, "the same, filtered again"),
            Field("past", self.depth * self._nominal.rotors, "forces of the rotors, newest first, N"),
        )
        return Record("delay", "Estimator of the delay of the loop.", fields)

    @property
    def _spacing(self) -> float:
        return self._stride * self._period

    def begin(self, rotors: Numbers) -> Numbers:
        """Return the memory before the first step, for rotor forces (n,), N: numbers or CasADi symbols."""
        past = ca.repmat(rotors, self.depth, 1)
        still = {field.name: np.zeros(max(field.size, 1)) for field in self.record.fields}
        memory = self.record.join(still | {"phase": 1, "found": self._told, "past": past})
        return memory if isinstance(rotors, ca.SX) else np.asarray(ca.DM(memory)).ravel()

    def find(self) -> ca.Function:
        """Return (memory, ω (3,), rotors (n,), last command (n,), params) → memory, horizon, wrenches (4, 3).

        The horizon (s) is the delay and the lag that is left. The wrenches, N and N m, are the mean and the change of
        their ramp over it (see `plants.lag`), and the one that acts now.
        """
        b, h = self._nominal, self._period
        memory, omega = ca.SX.sym("memory", self.record.length), ca.SX.sym("w", 3)
        rotors, command = ca.SX.sym("r", b.rotors), ca.SX.sym("u", b.rotors)
        begun, phase, delay, trim, known, before, earlier, smooth, smoother, past = self.record.split(memory).values()
        entries = self._entries(past, rotors)
        at, over = self.weights(delay, phase)
        acting, impulse, now = (self._wrench(forces) for forces in (entries @ at, entries @ over, rotors))
        # In rad/s²: what is measured less what is expected, and, per second, what a longer delay adds to that.
        turning, *others = (
            ca.mtimes(b.vehicle.I_inv, wrench[1:]) for wrench in (acting, now, self._wrench(entries[:, -1]))
        )
        model, slope = (earlier + turning) / 2, (earlier - turning) / h
        wrong = (omega - before) / h - model - angular_acceleration(ca.SX.zeros(3), (before + omega) / 2, b.vehicle)
        spread = sum(ca.sumsqr(other - turning) for other in others)
        trim = trimming.follow_lever(trim, ca.mtimes(b.vehicle.I, wrong), acting[0], spread, begun, h, b.vehicle)
        share, parts = -np.expm1(-BAND / self._longest * h), trimming.RECORD.split(trim)
        tilting = ca.mtimes(b.vehicle.I_inv, parts["lever"])
        whole = wrong + slope * delay + acting[0] * tilting + parts["strength"] * model
        smooth = smooth + share * (begun * ca.vertcat(whole, slope, model, acting[0]) - smooth)
        smoother = smoother + share * (smooth - smoother)
        whole, slope, model, thrust = ca.vertsplit(smoother, [0, 3, 6, 9, 10])
        lacking = whole - slope * delay
        information = np.exp(-h / FORGETTING) * known + h * ca.sumsqr(slope)
        gain = 1 / (information + DOUBT * angular_authority(b.vehicle) ** 2)
        moves = gain * ca.dot(slope, lacking - thrust * tilting - parts["strength"] * model)
        found = delay + h * moves
        sure = h * gain * information / (1 + (moves / SETTLED) ** 2)
        trim = trimming.follow_strength(trim, lacking, model, thrust, sure, b.vehicle)
        found = clip(found, LEAST * h, self._longest)
        phase, past = self._age(phase, entries)
        kept = self.record.join({
            "begun": 1, "phase": phase, "found": found, "trim": trim, "information": information, "omega": omega,
            "earlier": turning, "smooth": smooth, "smoother": smoother, "past": ca.vec(past),
        })  # fmt: skip
        horizon = delay + self._lag_left
        ramp = self._extend(Ramp(impulse / delay, now - acting), delay, rotors, command)
        wrenches = ca.horzcat(ramp.mean, ramp.change, acting)
        outputs = [ca.densify(v) for v in (kept, horizon, wrenches)]
        return ca.Function("find_delay", [memory, omega, rotors, command, b.symbols], ca.cse(outputs))

    def _extend(self, past: Ramp, delay: Scalar, rotors: Numbers, command: Numbers) -> Ramp:
        """Return the ramp of the wrench over delay and lag left: the `past` one over the `delay` (s) goes on.

        After that, the rotors follow the last `command`.
        """
        e = self._lag_left
        if e == 0:
            return past
        forces, _ = hold(rotors, command, step_timing(self._nominal.lag, e))
        return join_ramps(past, forces.mix(self._nominal.vehicle.mixing()), delay, e)

    def acting(self) -> ca.Function:
        """Return (memory, rotors (n,), params) → the forces (n,) that act by then, N, after a step with that memory.

        Their delay is the one found, as far as the past tells it, and else the one assumed: the `initial` one is in the
        middle of what a predictor survives, and of forces one knows better.
        """
        b, memory = self._nominal, ca.SX.sym("memory", self.record.length)
        rotors = ca.SX.sym("r", b.rotors)
        parts = self.record.split(memory)
        share = parts["information"] / (parts["information"] + DOUBT * angular_authority(b.vehicle) ** 2)
        at, _ = self.weights(self._assumed + share * (parts["found"] - self._assumed), parts["phase"])
        forces = ca.densify(self._entries(parts["past"], rotors) @ at)
        return ca.Function("acting", [memory, rotors, b.symbols], [ca.cse(forces)])

    def carry(self) -> ca.Function:
        """Return (state (24,), horizon, wrenches (4, 3), `OUTSIDE` (8,), params) → state (24,) at the horizon."""
        b = self._nominal
        packed, horizon, outside = ca.SX.sym("s", SIZE), ca.SX.sym("d"), ca.SX.sym("F", OUTSIDE.length)
        wrenches, parts = ca.SX.sym("W", WRENCH, 3), OUTSIDE.split(outside)
        scaled = ca.vertcat((1 + parts["scale"]) * wrenches[0, :], wrenches[1:, :])
        moved = cascade_step(packed, Ramp(scaled[:, 0], scaled[:, 1]), parts["forces"], horizon, b.vehicle)
        return ca.Function("act_later", [packed, horizon, wrenches, outside, b.symbols], [ca.cse(ca.densify(moved))])

    def skip(self) -> ca.Function:
        """Return (memory, rotors (n,)) → memory after a period without measurement: the delay stays."""
        memory, rotors = ca.SX.sym("memory", self.record.length), ca.SX.sym("r", self._nominal.rotors)
        parts = self.record.split(memory)
        phase, past = self._age(parts["phase"], self._entries(parts["past"], rotors))
        kept = self.record.join(parts | {"begun": 0, "phase": phase, "past": ca.vec(past)})
        return ca.Function("skip_delay", [memory, rotors], [ca.densify(kept)])

    def _entries(self, past: Numbers, rotors: Numbers) -> Numbers:
        """Return the forces (n, k) of the rotors now and remembered, newest first."""
        return ca.horzcat(rotors, ca.reshape(past, self._nominal.rotors, self.depth))

    def _age(self, phase: Scalar, entries: Numbers) -> tuple[Scalar, Numbers]:
        """Return phase and remembered forces a period later: every `stride` periods the newest is remembered."""
        full = phase > self._stride - 0.5
        return ca.if_else(full, 1, phase + 1), ca.if_else(full, entries[:, :-1], entries[:, 1:])

    def _wrench(self, rotors: Numbers) -> Numbers:
        return ca.mtimes(self._nominal.vehicle.mixing(), rotors)

    def weights(self, age: Scalar, phase: Scalar) -> tuple[Numbers, Numbers]:
        """Return the weights (k,) of the forces now and remembered, which are linear in between.

        Those of the force an `age` (s) ago, and of its integral since (s). `phase` is the number of periods since the
        newest one that is remembered.
        """
        at, over = ([ca.SX(0)] * (self.depth + 1) for _ in range(2))
        at[0] = ca.SX(1)
        newest, end = phase / self._stride, age / self._spacing  # in units of the spacing, as is what follows
        for i in range(self.depth):
            begin, length = (i - 1, 1) if i else (-newest, newest)  # of this interval, ages since the newest
            share = clip((end - newest - begin) / length, 0, 1)  # of it that is younger than `age`
            half = share**2 / 2
            at[i], at[i + 1] = at[i] - share, share
            over[i], over[i + 1] = over[i] + length * (share - half), length * half
        return ca.vertcat(*at), self._spacing * ca.vertcat(*over)
