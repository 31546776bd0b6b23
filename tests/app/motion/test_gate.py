"""Nothing moves after a stop, at any point between the check and the execution of a request."""

import threading
from contextlib import suppress

import numpy as np
import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device.executor import CommandExecutor
from rotemina.app.operation import OperatorControl
from rotemina.drivers.contract import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap

REST = 0.0275
TARGET = 0.05
TIME_S = np.arange(2001) / 1000.0
SWING = Record.from_signals(
    TIME_S, {("x", Tap.CMD): REST + 2e-3 * np.sin(np.pi * TIME_S) ** 2}, {"x": "m"}
)
REQUESTS = {
    "go_to": lambda session: session.go_to({"x": TARGET}),
    "jog": lambda session: session.jog("x", 0.01),
    "move_by": lambda session: session.move_by({"x": 0.01, "zn": 1e-6}),
    "move_velocity": lambda session: session.move_velocity({"x": 0.01}, 0.15),
    "play": lambda session: session.play(SWING),
    "go_safely": lambda session: session.go_safely({"x": TARGET}),
    "home": lambda session: session.home(["x"]),
    "set_voltage": lambda session: session.set_voltage("zn", 70.0),
}


@pytest.fixture(autouse=True)
def without_second_halt(monkeypatch):
    """Disable the second halt of the executor, so that only the gate prevents motion."""
    monkeypatch.setattr(CommandExecutor, "_halt_if_overtaken", lambda *_: None)


def run_after_checks(harness, monkeypatch, action):
    """Execute an action right after a request has passed all checks of the session."""
    post = harness.session._link.mailbox.post

    def post_after_action(command, permit):
        action()
        post(command, permit)

    monkeypatch.setattr(harness.session._link.mailbox, "post", post_after_action)


@pytest.mark.parametrize(
    ("request_name", "event"),
    [*((name, "stop") for name in REQUESTS), ("go_to", "emergency_stop"), ("go_to", "disconnect")],
)
def test_a_stop_between_checks_and_queue_prevents_motion(harness, monkeypatch, request_name, event):
    run_after_checks(harness, monkeypatch, getattr(harness.session, event))
    if event == "disconnect":  # the worker must also execute it in between
        run_after_checks(harness, monkeypatch, harness.session.run_once)
    with suppress(InputError):
        REQUESTS[request_name](harness.session)
    assert not harness.session._link.worker.ownership.owners
    assert harness.holds_position()
    assert harness.session.snapshot().activity in (DeviceState.IDLE, DeviceState.CLOSED)


@pytest.mark.parametrize("request_name", REQUESTS)
def test_a_stop_between_queue_and_driver_prevents_motion(harness, monkeypatch, request_name):
    """The worker has already taken the request when the stop comes."""
    session = harness.session
    dispatch = session._link.worker.executor._dispatch

    def dispatch_after_stop(command, permit):
        session.stop()
        dispatch(command, permit)

    monkeypatch.setattr(session._link.worker.executor, "_dispatch", dispatch_after_stop)
    REQUESTS[request_name](session)
    assert harness.holds_position()


@pytest.mark.parametrize("hook", ["_move_to", "_move_velocity", "_play", "_home"])
def test_a_stop_inside_the_driver_prevents_motion(harness, monkeypatch, hook):
    session, original_hook = harness.session, getattr(harness.driver, hook)

    def call_after_stop(*args):
        session.emergency_stop()
        original_hook(*args)

    monkeypatch.setattr(harness.driver, hook, call_after_stop)
    name = {"_move_to": "go_to", "_play": "play", "_home": "home"}.get(hook, "move_velocity")
    REQUESTS[name](session)
    assert harness.holds_position()


def test_a_stop_between_two_legs_ends_the_move(harness):
    harness.session.go_safely({"x": REST + 1e-4, "z": 0.041})
    harness.step(0.02, 2)
    harness.session.stop()
    harness.step_until_idle()
    assert harness.holds_position()


def test_a_request_from_before_the_release_is_refused(harness, monkeypatch):
    session = harness.session
    session.emergency_stop()
    permit = session.permit()
    session.release()
    harness.step(0.02, 3)
    with pytest.raises(RequestRefusedError, match="try again"):
        session.go_to({"x": TARGET}, permit=permit)
    assert harness.holds_position()


def test_a_stop_during_planning_cancels_the_plan(harness, tmp_path, monkeypatch):
    """Re-centring is planned on a separate thread; a stop ends it, even if released before."""
    from rotemina.app.operation import operation as module

    can_finish, has_planned = threading.Event(), threading.Event()
    plan = module.plan_recentring

    def plan_slowly(*args):
        result = plan(*args)
        has_planned.set()
        can_finish.wait()
        return result

    monkeypatch.setattr(module, "plan_recentring", plan_slowly)
    messages = []
    operation = OperatorControl(
        harness.session, tmp_path, tmp_path, clock=harness.clock, notify=messages.append
    )
    harness.session.go_to({"zn": 20e-6})
    harness.step_until_idle()
    harness.step(0.02, 5)
    operation.recentre()
    has_planned.wait()
    harness.session.emergency_stop()
    harness.session.release()
    can_finish.set()
    operation._planning_thread.join()
    assert harness.holds_position()
    assert "try again" in messages[0]
    operation.close()


def test_a_stop_does_not_wait_for_the_check_of_a_path(harness, monkeypatch):
    """The check of a long path holds no lock that a stop or another request needs."""
    session, check_started, check_can_finish = harness.session, threading.Event(), threading.Event()

    def check(*_):
        check_started.set()
        assert check_can_finish.wait(20.0)

    monkeypatch.setattr(session.bounds._guard, "check_trajectory", check)
    refusals = []

    def play():
        try:
            session.play(SWING)
        except InputError as error:
            refusals.append(str(error))

    thread = threading.Thread(target=play)
    thread.start()
    assert check_started.wait(20.0)
    session.stop()  # it would hang here
    check_can_finish.set()
    thread.join()
    assert "a stop came after this request" in refusals[0]
    assert harness.holds_position()


def test_a_path_is_refused_if_the_machine_moved_during_its_check(harness, monkeypatch):
    session = harness.session

    def move_during_check(*_):
        monkeypatch.undo()
        session.go_to({"x": REST + 1e-4})
        harness.step_until_idle()
        harness.step(0.02, 5)

    monkeypatch.setattr(session.bounds._guard, "check_trajectory", move_during_check)
    with pytest.raises(RequestRefusedError, match="have changed; play again"):
        session.play(SWING)
    assert harness.holds_position()


def test_while_drivers_are_exchanged_requests_are_refused_and_both_drivers_stop(harness):
    session, old = harness.session, harness.driver
    session.go_to({"x": TARGET})
    harness.step(0.02, 10)
    new = type(old)(session.robot, clock=harness.clock)
    session.use_driver(new)  # the worker still has the old one
    with pytest.raises(RequestRefusedError, match="another device is being connected"):
        session.go_to({"x": REST})
    stops = old.stops
    session.stop()
    assert old.stops == stops + 1
    harness.step()
    assert session.snapshot().lock_reason is None
    session.go_to({"x": REST + 1e-4})
    assert harness.step_until_idle().command["x"] == REST + 1e-4
