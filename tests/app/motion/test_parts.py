"""Parts of a session, each without the others."""

import pytest

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.guard import Guard
from rotemina.app.motion.mailbox import Move, RefusedError
from rotemina.app.motion.recent_history import LiveHistory
from rotemina.app.motion.reservations import Reservations
from rotemina.app.motion.stop import PROGRAM, StopRequest
from rotemina.app.motion.subscribers import Subscribers
from rotemina.app.motion.tool import Tool
from rotemina.app.motion.undo import Undo
from rotemina.drivers.errors import DriverError
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot

MOVE = Move(Guard(load_robot("rotemina")).move(None, {"x": 0.03}))


@pytest.fixture
def link(clock):
    driver = Simulator(load_robot("rotemina"), clock=clock)
    history = LiveHistory(driver.axes)
    link = DeviceLink(driver, history, Subscribers(), clock=clock, queue_size=2, stale_after_s=1.0)
    link.connect()
    link.worker.run_once()
    clock.advance(0.02)
    link.worker.run_once()
    return link


@pytest.fixture
def admission(link):
    return Admission(link, Guard(link.robot), Undo(link.robot))


def halt(link):
    link.stop(StopRequest(PROGRAM, "", None))


def test_a_refused_request_leaves_neither_an_owner_nor_a_command(link, admission):
    permit = admission.drawn(None)
    halt(link)
    with pytest.raises(RefusedError, match="a stop came after"):
        admission.queue(MOVE, permit, ("x",), "somebody")
    assert not link.worker.ownership.owners
    assert not len(link.mailbox)


def test_a_queued_move_keeps_where_the_machine_rests(link, admission):
    rest = dict(link.worker.state.command)
    admission.queue_move(MOVE, admission.drawn(None), ("x",), "somebody")
    assert admission.way_back.leads_from({**rest, "x": 0.03})
    assert link.worker.ownership.owners == {"x": "somebody"}


def test_reserved_axes_are_nobody_else_s(link, admission):
    reservations = Reservations(link, admission)
    reservations.reserve("one")
    with pytest.raises(RefusedError, match="one controls axis"):
        reservations.check("another")
    reservations.take_over(["x"], "another")
    assert not reservations.held_by("one")


def test_a_tool_is_switched_on_only_while_nothing_is_locked(link, admission):
    tool = Tool(link, admission)
    link.barred = "a replay"
    with pytest.raises(RefusedError, match="a replay"):
        tool.switch(True)
    link.barred = None
    tool.switch(True)
    link.worker.run_once()
    assert tool.on


def test_a_link_that_cannot_stop_its_device_does_not_raise(link, monkeypatch):
    def fails():
        raise DriverError("the link is lost")

    monkeypatch.setattr(link.driver, "halt", fails)
    halt(link)
    link.worker.run_once()
    assert "the link is lost" in link.snapshot().locked


def test_a_failing_subscriber_keeps_nothing_from_the_others():
    subscribers, told = Subscribers(), []

    def fails(event):
        raise ValueError(event)

    subscribers.subscribe(fails)
    end = subscribers.subscribe(told.append)
    subscribers.emit("first")
    end()
    subscribers.emit("second")
    assert told == ["first"]
