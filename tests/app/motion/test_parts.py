"""Parts of a session, each tested without the others."""

import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device import DeviceLink, LiveHistory, MoveCommand, SessionSubscribers
from rotemina.app.motion.limits import Guard
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.app.motion.session.reservations import AxisReservations
from rotemina.app.motion.session.tool import ToolSwitch
from rotemina.app.motion.session.undo import UndoHistory
from rotemina.app.motion.state import PROGRAM, StopRequest
from rotemina.drivers.contract import DriverError
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot

MOVE = MoveCommand(Guard(load_robot("rotemina")).plan_move(None, {"x": 0.03}))


@pytest.fixture
def link(clock):
    driver = Simulator(load_robot("rotemina"), clock=clock)
    history = LiveHistory(driver.axes)
    link = DeviceLink(
        driver, history, SessionSubscribers(), clock=clock, queue_size=2, stale_after_s=1.0
    )
    link.connect()
    link.worker.run_once()
    clock.advance(0.02)
    link.worker.run_once()
    return link


@pytest.fixture
def admission(link):
    return RequestAdmission(link, Guard(link.robot), UndoHistory(link.robot))


def stop_link(link):
    link.stop(StopRequest(PROGRAM, "", None))


def test_a_refused_request_leaves_neither_an_owner_nor_a_command(link, admission):
    permit = admission.resolve_permit(None)
    stop_link(link)
    with pytest.raises(RequestRefusedError, match="a stop came after"):
        admission.queue(MOVE, permit, ("x",), "somebody")
    assert not link.worker.ownership.owners
    assert not len(link.mailbox)


def test_a_queued_move_keeps_the_rest_position_for_undo(link, admission):
    rest = dict(link.worker.state.command)
    admission.queue_move(MOVE, admission.resolve_permit(None), ("x",), "somebody")
    assert admission.undo_history.has_previous({**rest, "x": 0.03})
    assert link.worker.ownership.owners == {"x": "somebody"}


def test_reserved_axes_are_refused_to_other_owners(link, admission):
    reservations = AxisReservations(link, admission)
    reservations.reserve("one")
    with pytest.raises(RequestRefusedError, match="one controls axis"):
        reservations.check("another")
    reservations.take_over(["x"], "another")
    assert not reservations.is_reserved_by("one")


def test_a_tool_can_be_switched_on_only_while_motion_is_not_locked(link, admission):
    tool = ToolSwitch(link, admission)
    link.bar_reason = "a replay"
    with pytest.raises(RequestRefusedError, match="a replay"):
        tool.switch(True)
    link.bar_reason = None
    tool.switch(True)
    link.worker.run_once()
    assert tool.is_on


def test_a_link_that_cannot_stop_its_device_does_not_raise(link, monkeypatch):
    def raise_error():
        raise DriverError("the link is lost")

    monkeypatch.setattr(link.driver, "halt", raise_error)
    stop_link(link)
    link.worker.run_once()
    assert "the link is lost" in link.snapshot().lock_reason


def test_a_failing_subscriber_does_not_affect_the_others():
    subscribers, events = SessionSubscribers(), []

    def raise_error(event):
        raise ValueError(event)

    subscribers.subscribe(raise_error)
    unsubscribe = subscribers.subscribe(events.append)
    subscribers.emit("first")
    unsubscribe()
    subscribers.emit("second")
    assert events == ["first"]
