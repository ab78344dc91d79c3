"""Fair shares of the cores, on a clock of the test's own."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from flypend.lab.shares import AHEAD, CREDIT, QUANTUM, Job, Shares

STEP = 0.01  # s; the tests look this often, and the shares change hands each QUANTUM


class Machine:
    """Shares on a clock that only `run` advances; `had` is what each job has had of a core, s."""

    def __init__(self, cores):
        self.now, self.had = 0.0, {}
        self.shares = Shares(cores, lambda: self.now)

    def start(self, page, rank=0):
        job = Job(page, rank, lambda _: None)
        self.had[job] = 0.0
        self.shares.add(job)
        return job

    def run(self, seconds=STEP):
        """Let time pass, and look where asyncio would."""
        for _ in range(round(seconds / STEP)):
            self.now += STEP
            for job in self.shares.jobs:
                self.had[job] += STEP * job.running
            if round(self.now / STEP) % round(QUANTUM / STEP) == 0:
                self.shares.look()

    def serve(self, job, seconds):
        """Run until `job` has had `seconds`, remove it, and return how long it took."""
        begun = self.now
        while self.had[job] < seconds - 1e-9:
            self.run()
        self.shares.remove(job)
        return self.now - begun


@given(cores=st.integers(1, 4), heavy=st.integers(1, 8), turns=st.integers(1, 40))
def test_pages_that_always_have_work_get_the_same(cores, heavy, turns):
    machine = Machine(cores)
    jobs = [machine.start(machine.shares.page()) for _ in range(heavy)]
    machine.run(turns * heavy * QUANTUM)
    had = [machine.had[job] for job in jobs]
    assert max(had) - min(had) <= 2 * QUANTUM + 1e-9  # a new page begins one behind
    assert sum(had) == pytest.approx(machine.now * min(cores, heavy))  # no core is idle while one waits


@given(
    cores=st.integers(1, 4),
    heavy=st.integers(4, 8),
    asks=st.lists(st.tuples(st.integers(1, 6), st.integers(1, 4)), min_size=1, max_size=12),
    data=st.data(),
)
def test_a_light_page_is_answered_as_if_it_were_alone(cores, heavy, asks, data):
    """It asks for less than its share: each time for so many steps, after rests of heavy / cores + 1 times as many."""
    machine = Machine(cores)
    light = machine.shares.page()
    jobs = [machine.start(machine.shares.page()) for _ in range(heavy)]
    machine.run(data.draw(st.integers(heavy * 3, 99)) * QUANTUM)
    for steps, more in asks:
        assert machine.serve(machine.start(light), steps * STEP) <= steps * STEP + 1e-9
        machine.run((heavy // cores + more) * steps * STEP)
    had = [machine.had[job] for job in jobs]
    assert max(had) - min(had) <= QUANTUM + AHEAD + 1e-9


def test_negative_control_a_page_that_asks_for_more_than_its_share_waits():
    machine = Machine(2)
    jobs = [machine.start(machine.shares.page()) for _ in range(6)]
    greedy = machine.shares.page()
    machine.run(1.0)
    waits = [machine.serve(machine.start(greedy), 0.1) for _ in range(60)]
    assert max(waits) > 0.25
    assert machine.had[jobs[0]] > 0.5


@given(cores=st.integers(1, 3), heavy=st.integers(1, 6), idle=st.floats(0, 60))
def test_what_a_page_saves_up_ends(cores, heavy, idle):
    """However long it has asked for nothing, soon the others run beside it."""
    machine = Machine(cores)
    saver = machine.shares.page()
    jobs = [machine.start(machine.shares.page()) for _ in range(heavy)]
    machine.run(round(idle, 2))
    begun = [machine.had[job] for job in jobs]
    saving = machine.start(saver)
    machine.run((CREDIT + QUANTUM + (heavy + 1) * QUANTUM) * 2)
    assert all(machine.had[job] > before for job, before in zip(jobs, begun, strict=True))
    assert machine.had[saving] > 0


@given(cores=st.integers(1, 3), lives=st.lists(st.integers(1, 5), min_size=20, max_size=60))
def test_pages_that_come_and_go_starve_nobody(cores, lives):
    """As many new pages as there are cores, at every moment; each is gone when it has had a little."""
    machine = Machine(cores)
    steady = machine.start(machine.shares.page())
    new = []
    for steps in lives:
        new += [machine.start(machine.shares.page()) for _ in range(cores + 1)]
        machine.run(steps * STEP)
        for job in [job for job in new if machine.had[job] > 0]:
            new.remove(job)
            machine.shares.remove(job)
    machine.run(QUANTUM)
    assert machine.had[steady] > 0.2 * machine.now / (1 + len(new))


def test_of_a_page_flights_come_before_maps():
    machine = Machine(1)
    page, other = machine.shares.page(), machine.shares.page()
    mapping = machine.start(page, rank=2)
    assert mapping.running
    flight = machine.start(page, rank=0)
    assert (flight.running, mapping.running) == (True, False)
    waiting = machine.start(other)
    machine.run(QUANTUM)
    assert waiting.running  # two jobs have no larger share
    machine.shares.remove(waiting)
    machine.shares.remove(flight)
    assert mapping.running


def test_a_page_is_charged_for_all_that_it_runs():
    machine = Machine(4)
    many, one = machine.shares.page(), machine.shares.page()
    jobs = [machine.start(many, rank) for rank in range(3)]
    single = machine.start(one)
    rest = [machine.start(machine.shares.page()) for _ in range(4)]
    machine.run(30 * QUANTUM)
    had = [sum(machine.had[job] for job in jobs), machine.had[single], *(machine.had[job] for job in rest)]
    assert max(had) - min(had) <= 3 * QUANTUM + AHEAD
