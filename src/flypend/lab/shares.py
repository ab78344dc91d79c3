"""Fair shares of the cores for pages: whose jobs run, and whose wait.

Each page has a clock that advances while its jobs have a core. Those whose clocks are furthest behind run: pages that
always have work take turns, and one that asks for little has the machine for itself, as if nobody else were there.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from joblib import cpu_count

QUANTUM = 0.05  # s between looks at who runs; longer than a usual flight
AHEAD = 0.2  # s on a core, by which the pages that run are at most ahead of the one furthest behind
CREDIT = 1.0  # s on a core that a page can be behind the others: it then runs as long without a break


@dataclass
class Page:
    """A page, and its clock `time`, s."""

    time: float


@dataclass(eq=False)
class Job:
    """Work of a `page`; of its jobs, the one of least `rank` comes first. `switch` lets it run or wait."""

    page: Page
    rank: int
    switch: Callable[[bool], None]
    running: bool = False
    begun: asyncio.Event = field(default_factory=asyncio.Event)

    def turn(self, on: bool) -> None:
        """Let it run, or wait."""
        if self.running != on:
            self.running = on
            self.switch(on)
        if on:
            self.begun.set()


class Shares:
    """The jobs of all pages, of which at most `cores` run at a time; `clock` in s."""

    def __init__(self, cores: int | None = None, clock: Callable[[], float] = time.monotonic) -> None:
        self.cores, self.clock = cores or cpu_count(), clock
        self.jobs: list[Job] = []
        self.least = 0.0  # the clock furthest behind of those with work; it never goes back
        self._noted = clock()
        self._timer: asyncio.TimerHandle | None = None

    def page(self) -> Page:
        """Return a new page: it comes after those that wait already, or pages that come and go would pass them."""
        return Page(self.least + QUANTUM)

    @contextmanager
    def job(self, page: Page, rank: int, switch: Callable[[bool], None]) -> Iterator[Job]:
        """Yield a job that has its turns, in the running loop of asyncio, until the end of the block."""
        job = Job(page, rank, switch)
        self.add(job)
        if self._timer is None:
            self._tick()
        try:
            yield job
        finally:
            self.remove(job)

    def add(self, job: Job) -> None:
        """Add a job, which waits or runs."""
        self._note()
        if all(other.page is not job.page for other in self.jobs):
            job.page.time = max(job.page.time, self.least - CREDIT)
        self.jobs.append(job)
        self.look()

    def remove(self, job: Job) -> None:
        """Remove a job, which no longer runs."""
        self._note()
        self.jobs.remove(job)
        job.turn(False)
        self.look()

    def look(self) -> None:
        """Give the cores to those whose turn it is."""
        self._note()
        order = sorted(self.jobs, key=lambda job: (job.page.time, job.rank))
        chosen = [job for job in order[: self.cores] if job.page.time <= order[0].page.time + AHEAD]
        for job in self.jobs:
            if job not in chosen:
                job.turn(False)
        for job in chosen:
            job.turn(True)

    def _note(self) -> None:
        now = self.clock()
        for job in self.jobs:
            if job.running:
                job.page.time += now - self._noted
        self._noted = now
        if self.jobs:
            self.least = max(self.least, min(job.page.time for job in self.jobs))

    def _tick(self) -> None:
        self.look()
        waits = not all(job.running for job in self.jobs)
        self._timer = asyncio.get_running_loop().call_later(QUANTUM, self._tick) if waits else None
