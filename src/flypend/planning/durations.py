"""The search over durations: more time is never the worse, and the shortest flight that there is.

**More time.** A flight that hovers sooner can wait. So a plan with one horizon is also solved from the best with a
shorter one, followed by hover, and the shorter is kept where even that is worse.

**The least time.** A flight with less time is near one with a little more. From each of many guesses, the horizon of a
plan is shortened in small steps, its stages with it: states and commands stay, and leave gaps for the solver to close.
A step that fails is halved, until it is too small to matter. Guesses lead to ways that differ in how far they can be
shortened, so only those that fall behind are dropped, not those that cost more.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from flypend.planning.multistart import FINAL, FINAL_IN_TIME, SOFT_LAST, Found, Guess, Job, Watch, count_agreeing
from flypend.planning.problem import STAGES_PER_UNIT, Request
from flypend.planning.result import Plan
from flypend.planning.search import Tried, finish, guesses_of, improve, together
from flypend.planning.solver import Settings

HORIZONS = (12.5, 20.0, 32.0, 48.0)  # √(l/g), tried in turn: 3 s on hehn2011
# Tried before a time that is asked for, which may be longer than is good, and the last of them before `HORIZONS` where
# something is in the way: a low window costs 20 times as much without. Else it is not worth its time: eight guesses
# with 8 lead to a plan that is better by 2 % than with 12.5 from 1 of 384 starts.
SHORTER = (6.0, 8.0)
EQUAL = 1e-3  # share by which a shorter flight must be better to be kept
STOPPED = "stopped at the time limit"

# Of the search for the least time. Its first plans have horizons that shrink by `COARSE`, until `FAILURES` in a row.
COARSE, FAILURES = 0.8, 2
LOOSE = 1.1  # from this times the shortest of them, all guesses are tried,
TRIES = 50  # with so many iterations each, as has every attempt to shorten: those that work take 25
# Shares by which all are shortened, as often as it works; and by how much those that go on may then be behind.
STEPS: Mapping[float, float] = MappingProxyType(
    {0.06: 0.1, 0.03: 0.05, 0.015: 0.02, 0.008: 0.01, 0.004: 0.005, 0.002: 0.0}
)
MOST = 8  # go on
FEWEST = 56  # stages, so that switching times are free enough
LEAST = 0.02  # √(l/g), a few control periods: no plan is shorter, even from a start that hovers


class Search:
    """Attempts at a plan, and what they took, until this thread's processor time is the `deadline` (s).

    The `attempts` are the same request in one or several forms, of which the first counts that leads to a plan.
    """

    def __init__(self, attempts: Sequence[Request], deadline: float) -> None:
        self._attempts, self._deadline = attempts, deadline
        self._spent = 0.0

    @property
    def over(self) -> bool:
        """Whether its time is over."""
        return time.thread_time() >= self._deadline

    def cold(self, horizon: float) -> Tried:
        """Try all forms of the request in turn, each from all styles of guesses."""
        for asked in self._attempts:
            tried = self._judge(asked, horizon, together(asked, horizon, self._deadline))
            if tried or self.over:
                break
        return tried

    def warm(self, tried: Tried, horizon: float, guess: Guess, watch: Watch | None = None) -> Tried:
        """Try another `horizon`, from a `guess` that comes of what was `tried`."""
        return self._judge(tried.asked, horizon, improve(tried.job, horizon, guess, self._deadline, watch))

    def each(self, horizon: float, stages: int) -> list[Tried]:
        """Try the last form of the request from every guess that there is, each by itself, in so many `stages`."""
        asked, tries = self._attempts[-1], []
        for style, guess in enumerate(guesses_of(asked, horizon, stages)):
            job = Job(asked, style)
            found = improve(job, horizon, guess, self._deadline, Watch([job], [0], TRIES))
            tries.append(self._judge(asked, horizon, found))
        return tries

    def finish(self, tried: Tried, settings: Settings = FINAL) -> Tried:
        """Solve what was `tried` to the end; as it is if nothing better comes of that, or its time is over."""
        if not tried or self.over:
            return tried
        forms = [tried.asked, *(self._attempts[-1:] if self._attempts[-1] is not tried.asked else [])]
        for asked in forms:  # what kept a constraint by chance may not do so to the end
            job = Job(asked, tried.found.style)
            found = finish(job, tried.horizon, tried.found, self._deadline, settings)
            if (final := tried.better_of(self._judge(asked, tried.horizon, found))) is not tried:
                return final
        return tried

    def make_plan(self, best: Tried, costs: Sequence[float]) -> Plan:
        """Return the plan of the `best`, with what the search took, and how many `costs` agree with its."""
        plan = replace(best.plan, solve_time=self._spent, guesses=len(costs))
        if best:
            plan = replace(plan, agreeing=max(1, count_agreeing(costs)))
        if not self.over:
            return plan
        if best:
            return replace(plan, status="feasible", reason=STOPPED)
        return replace(plan, reason=f"{plan.reason} within the time limit")

    def _judge(self, asked: Request, horizon: float, found: Found) -> Tried:
        self._spent += found.spent
        return Tried.of(asked, found, horizon)


def ladder(duration: float | None, asked: Request) -> list[float]:
    """Return the horizons to try, √(l/g), up to a `duration` of so many.

    With a path there is no other, since it says where to be at each time; nor where the end is no place to wait.
    """
    waits = asked.waits and not asked.structure.path
    if duration is None:
        return [*(SHORTER[-1:] if waits and asked.structure.soft else ()), *HORIZONS]
    shorter = [] if not waits else [each for each in (*SHORTER, *HORIZONS) if each < (1 - EQUAL) * duration]
    return [*shorter, duration]


def in_time(search: Search, horizons: Sequence[float], least: float) -> Plan:
    """Return the best plan with the last of `horizons`, or with the first from `least` on that has any.

    It is one with a shorter horizon if that is better.
    """
    best: Tried | None = None
    costs: list[float] = []
    for horizon in horizons:
        cold = search.cold(horizon)
        costs += cold.found.costs
        tries = [cold, search.warm(best, horizon, _append_hover(best, horizon))] if best else [cold]
        latest = min(filter(None, tries), key=lambda each: each.found.cost, default=cold)
        if not best or (latest and latest.found.cost <= (1 + EQUAL) * best.found.cost):
            best = latest
        if search.over or (best and horizon >= least):
            break
    assert best is not None
    return search.make_plan(search.finish(best), costs)


def shortest(search: Search, horizons: Sequence[float], longest: float | None) -> Plan:
    """Return the shortest plan, which begins with the first of `horizons` that has any.

    It fails if it takes longer than the `longest`, √(l/g). That is tried first, but is not all: guesses rarely lead to
    a plan with little more than the least time.
    """
    for horizon in horizons if longest is None else (longest, *horizons):
        first = best = search.cold(horizon)
        if first or search.over:
            break
    if not first:
        return search.make_plan(first, first.found.costs)
    failures, horizon = 0, first.horizon
    while failures < FAILURES and (horizon := COARSE * horizon) >= LEAST:
        tried = search.cold(horizon)
        best, failures = (tried, 0) if tried else (best, failures + 1)
    horizon = min(LOOSE * best.horizon, first.horizon)
    tries = search.each(horizon, max(FEWEST, round(STAGES_PER_UNIT * horizon)))
    field = [best, *filter(None, tries)]
    reached = [np.inf] * (len(tries) + 1)
    for step, behind in STEPS.items():
        field = sorted((_shorten(search, each, step) for each in field), key=lambda each: each.horizon)
        reached[: len(field)] = [each.horizon for each in field]
        field = [each for each in field if each.horizon <= (1 + behind) * field[0].horizon][:MOST]
    plan = search.make_plan(search.finish(field[0], FINAL_IN_TIME), reached)
    if longest is None or not plan or field[0].horizon <= longest:
        return plan
    return replace(plan, status="failed", reason=f"the shortest flight that was found takes {plan.duration:.3g} s")


def _shorten(search: Search, tried: Tried, step: float) -> Tried:
    """Return what was `tried` with a horizon shortened by the share `step`, as often as that works."""
    while (horizon := (1 - step) * tried.horizon) >= LEAST:
        watch = Watch([tried.job], [0], TRIES, SOFT_LAST)
        shorter = search.warm(tried, horizon, (tried.found.states, tried.found.commands), watch)
        if not shorter:
            break
        tried = shorter
    return tried


def _append_hover(tried: Tried, horizon: float) -> Guess:
    """Return what was `tried`, followed by hover until `horizon` (√(l/g))."""
    states, commands = tried.found.states, tried.found.commands
    wait = max(0, round((horizon / tried.horizon - 1) * len(commands)))
    hover = tried.asked.rest
    hover[6:15] = states[-1, 6:15]  # the heading does not matter
    return np.vstack([states, np.tile(hover, (wait, 1))]), np.vstack([commands, np.ones((wait, commands.shape[1]))])
