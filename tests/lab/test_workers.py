"""Processes that answer pages: what they fly cannot be cut in pieces, and they end all the same."""

import asyncio
import json
import signal
import time
from types import SimpleNamespace

import pytest
from test_lab import Lab, asked, cpu
from tornado.websocket import websocket_connect

from flypend.lab import worker
from flypend.lab.own import OwnLaws
from flypend.lab.session import Slot
from flypend.lab.shares import Shares
from flypend.lab.worker import Limits, Worker, Workers

LAW = """
import os
import time
from types import SimpleNamespace
import numpy as np
import flypend as fp

def mine(t, state, vehicle, *, way=1.0, brake=0.02):
    if state.x[2] > 1e9:  # no symbols, please
        return fp.Wrench(0.0, np.zeros(3))
    if round(way) == 2:
        while True:
            pass
    if round(way) == 3:
        os.abort()
    if round(way) == 4:
        os._exit(7)
    if round(way) == 5:
        end = time.thread_time() + 0.02
        while time.thread_time() < end:
            pass
    return fp.Wrench(vehicle.weight, -brake * np.asarray(state.omega))
"""
USUAL, ENDLESS, ABORT, EXIT, SLOW = range(1, 6)
SHORT = Limits(reply=1.0, stopping=0.3)


@pytest.fixture
def place(tmp_path):
    (tmp_path / "mine.py").write_text(LAW, encoding="utf-8")
    return tmp_path / "mine.py"


def setting(way, **more):
    return asked("mine", "rotors", gains={"way": float(way)}, duration=0.1, **more)


class Desk:
    """A page whose slots have processes; `asks` awaits the reply to the last of some messages."""

    def __init__(self, own, limits=SHORT):
        self.sent, self.workers, shares = [], Workers(own, limits), Shares(2)
        page = shares.page()
        self.slots = {kind: Slot(page, i, shares, self.workers, self.send) for i, kind in enumerate(("fly", "map"))}

    async def send(self, line):
        reply = json.loads(line)
        if reply["kind"] != "compiling":
            self.sent.append(reply)

    def put(self, number, wanted, kind="fly"):
        self.slots[kind].put({"kind": kind, "number": number, "setting": wanted})

    async def reply(self, number):
        async with asyncio.timeout(120):
            while not (found := [reply for reply in self.sent if reply["number"] == number]):
                await asyncio.sleep(0.01)
        return found[0]

    async def asks(self, number, wanted, kind="fly"):
        self.put(number, wanted, kind)
        return await self.reply(number)

    def process(self, kind="fly"):
        return self.slots[kind]._worker.process

    def close(self):
        for slot in self.slots.values():
            slot.close()
        self.workers.close()


def at_desk(own, scenario, limits=SHORT):
    async def run():
        desk = Desk(own, limits)
        try:
            return await scenario(desk)
        finally:
            desk.close()
            await asyncio.sleep(0.05)

    return asyncio.run(run())


@pytest.mark.parametrize("way", [ENDLESS, ABORT, EXIT])
def test_a_law_that_never_returns_is_refused_and_the_next_request_answered(place, way):
    async def scenario(desk):
        return await desk.asks(1, setting(way)), await desk.asks(2, setting(USUAL))

    refused, flown = at_desk(OwnLaws([f"{place}:mine"]), scenario)
    assert refused["kind"] == "error"
    assert refused["field"] == ("flight" if way == ENDLESS else "setting")
    assert {ENDLESS: "at most 1 s of processor time", ABORT: "SIGABRT", EXIT: "exit code 7"}[way] in refused["message"]
    assert (flown["kind"], flown["number"]) == ("flight", 2)


def test_a_newer_request_ends_what_hangs_in_a_single_call(place):
    async def scenario(desk):
        desk.put(1, setting(ENDLESS))
        await asyncio.sleep(0.3)
        return await desk.asks(2, setting(USUAL)), desk.sent

    flown, sent = at_desk(OwnLaws([f"{place}:mine"]), scenario, Limits(reply=60.0, stopping=0.3))
    assert (flown["kind"], flown["number"]) == ("flight", 2)
    assert [reply["number"] for reply in sent] == [2]


@pytest.mark.parametrize("kind", ["law in Python", "kernel"])
def test_a_newer_request_stops_a_flight_and_keeps_the_process(place, kind):
    """Five minutes of Python, and some seconds of machine code."""
    stiff = {"attitude_bandwidth": 1700.0, "attitude_damping": 70.0}
    long = {"law in Python": setting(SLOW), "kernel": asked(gains=stiff, duration=30.0)}[kind]
    long |= {"duration": 30.0}
    quick = {"law in Python": setting(USUAL), "kernel": asked(duration=0.1)}[kind]

    async def scenario(desk):
        await desk.asks(1, quick)
        process = desk.process()
        begun = cpu(process.pid)
        desk.put(2, long)
        await asyncio.sleep(0.05)
        await desk.asks(3, quick)
        assert desk.process() is process
        return cpu(process.pid) - begun

    assert at_desk(OwnLaws([f"{place}:mine"]), scenario, Limits()) < 2.0


def test_kinds_of_requests_do_not_wait_for_each_other(place):
    async def scenario(desk):
        desk.put(1, setting(ENDLESS), "map")
        await asyncio.sleep(0.2)
        flown = await desk.asks(2, setting(USUAL))
        return flown, desk.slots["map"]._busy

    flown, mapping = at_desk(OwnLaws([f"{place}:mine"]), scenario, Limits())
    assert flown["kind"] == "flight"
    assert mapping


def test_a_page_that_keeps_changing_its_mind_sees_a_flight_in_the_end(place):
    """Each flight takes 1 s of processor, and 0.1 s after it begins there is a newer one."""

    async def scenario(desk):
        number = 0
        while not desk.sent:
            number += 1
            desk.put(number, setting(SLOW))
            await asyncio.sleep(0.1)
        return desk.sent[0]

    assert at_desk(OwnLaws([f"{place}:mine"]), scenario, Limits())["kind"] == "flight"


def test_a_mistake_in_a_law_spoils_no_other_flight(place):
    own = OwnLaws([f"{place}:mine"])
    place.write_text("def", encoding="utf-8")  # before there is any process

    async def scenario(desk):
        return await desk.asks(1, asked(duration=0.1)), await desk.asks(2, setting(USUAL)), list(own)

    flown, refused, names = at_desk(own, scenario)
    assert (flown["kind"], refused["kind"]) == ("flight", "error")
    assert "mine.py" in refused["message"]
    assert names == ["mine"]


def test_numbers_that_are_none_are_refused(place):
    async def scenario(desk):
        return await desk.asks(1, asked(duration=float("nan"))), await desk.asks(2, asked(duration=0.1))

    refused, flown = at_desk(OwnLaws(), scenario)
    assert (refused["kind"], refused["field"], flown["kind"]) == ("error", "duration", "flight")


def test_nothing_of_a_server_that_is_killed_is_left(place):
    """Not even the processes that wait for their turn, which a kill of the server leaves stopped."""
    lab = Lab("--law", f"{place}:mine")

    async def scenario():
        pages = [await websocket_connect(f"ws://{lab.host}/socket") for _ in range(5)]
        for page in pages:
            await page.write_message(json.dumps({"kind": "fly", "number": 1, "setting": setting(ENDLESS)}))
        while len(lab.family) < 8:  # it, the two that fork and count, and five
            await asyncio.sleep(0.05)
        await asyncio.sleep(1.0)
        found = lab.family
        lab.process.send_signal(signal.SIGKILL)
        lab.process.communicate()
        for page in pages:
            page.close()
        return found

    found = asyncio.run(scenario())
    end = time.monotonic() + 60
    while (left := [one for one in found if cpu(one)]) and time.monotonic() < end:
        time.sleep(0.1)
    assert left == []


def test_a_page_that_goes_while_its_process_starts_leaves_it_its_channel(monkeypatch):
    """Closed too soon, its number was another file's by the time the process got it."""
    seen = []

    class Slow:
        def __init__(self, args, **_):
            self.channel = args[0]

        def start(self):
            time.sleep(0.2)
            seen.append(self.channel.fileno())

    async def scenario():
        start = asyncio.create_task(Worker.start(OwnLaws([]), SHORT))
        await asyncio.sleep(0.05)
        start.cancel()
        await asyncio.wait([start])

    monkeypatch.setattr(worker, "_context", SimpleNamespace(Process=Slow))
    asyncio.run(scenario())  # which waits for its threads
    assert len(seen) == 1
    assert seen[0] >= 0
