"""Nothing moves after a stop, wherever between its check and its act a request has come."""

import threading
from contextlib import suppress

import numpy as np
import pytest

from rotemina.app.motion.executor import Executor
from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.operation import Operation
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap

REST = 0.0275
TARGET = 0.05
TIME_S = np.arange(2001) / 1000.0
PATH = Record.from_signals(
    TIME_S, {("x", Tap.CMD): REST + 2e-3 * np.sin(np.pi * TIME_S) ** 2}, {"x": "m"}
)
REQUESTS = {
    "go_to": lambda session: session.go_to({"x": TARGET}),
    "jog": lambda session: session.jog("x", 0.01),
    "move_by": lambda session: session.move_by({"x": 0.01, "zn": 1e-6}),
    "move_velocity": lambda session: session.move_velocity({"x": 0.01}, 0.15),
    "play": lambda session: session.play(PATH),
    "go_safely": lambda session: session.go_safely({"x": TARGET}),
    "home": lambda session: session.home(["x"]),
    "set_voltage": lambda session: session.set_voltage("zn", 70.0),
}


@pytest.fixture(autouse=True)
def gate_alone(monkeypatch):
    """Leave out the executor's second halt, for drivers that pass no gate: ours must."""
    monkeypatch.setattr(Executor, "_halt_if_overtaken", lambda *_: None)


def between_check_and_act(stepped, monkeypatch, action):
    """Do something at the very moment in which a request has passed all checks of the session."""
    post = stepped.session._link.mailbox.post

    def later(command, permit):
        action()
        post(command, permit)

    monkeypatch.setattr(stepped.session._link.mailbox, "post", later)


def stands(stepped, seconds=1.0):
    before = stepped.session.snapshot().command
    stepped.step(0.02, round(seconds / 0.02))
    return dict(stepped.session.snapshot().command) == dict(before)


@pytest.mark.parametrize("request_name", REQUESTS)
@pytest.mark.parametrize("event", ["stop", "emergency_stop", "disconnect"])
def test_a_stop_between_the_checks_of_a_request_and_its_queue(
    stepped, monkeypatch, request_name, event
):
    between_check_and_act(stepped, monkeypatch, getattr(stepped.session, event))
    if event == "disconnect":  # which the worker carries out in between as well
        between_check_and_act(stepped, monkeypatch, stepped.session.run_once)
    with suppress(InputError):
        REQUESTS[request_name](stepped.session)
    assert stands(stepped)
    assert stepped.session.snapshot().activity in (DeviceState.IDLE, DeviceState.CLOSED)


@pytest.mark.parametrize("request_name", REQUESTS)
@pytest.mark.parametrize("event", ["stop", "emergency_stop"])
def test_a_stop_between_the_queue_and_the_driver(stepped, monkeypatch, request_name, event):
    """The worker has taken the request already when the stop comes."""
    session = stepped.session
    hand_over = session._link.worker.executor._hand_over

    def later(command, permit):
        getattr(session, event)()
        hand_over(command, permit)

    monkeypatch.setattr(session._link.worker.executor, "_hand_over", later)
    REQUESTS[request_name](session)
    assert stands(stepped)


@pytest.mark.parametrize("hook", ["_move_to", "_move_velocity", "_play", "_home"])
def test_a_stop_inside_the_driver_just_before_its_device(stepped, monkeypatch, hook):
    session, inner = stepped.session, getattr(stepped.driver, hook)

    def later(*given):
        session.emergency_stop()
        inner(*given)

    monkeypatch.setattr(stepped.driver, hook, later)
    name = {"_move_to": "go_to", "_play": "play", "_home": "home"}.get(hook, "move_velocity")
    REQUESTS[name](session)
    assert stands(stepped)


def test_a_stop_between_two_legs_ends_the_move(stepped):
    stepped.session.go_safely({"x": REST + 1e-4, "z": 0.041})
    stepped.step(0.02, 2)
    stepped.session.stop()
    stepped.until_idle()
    assert stands(stepped)


def test_a_request_made_while_latched_is_void_after_the_release(stepped, monkeypatch):
    session = stepped.session
    session.emergency_stop()
    permit = session.permit()
    session.release()
    stepped.step(0.02, 3)
    with pytest.raises(RefusedError, match="try again"):
        session.go_to({"x": TARGET}, permit=permit)
    assert stands(stepped)


def test_a_plan_ends_with_the_stop_that_comes_while_it_is_made(stepped, tmp_path, monkeypatch):
    """Re-centring is planned on a thread of its own: a stop, or a stop and a release, end it."""
    from rotemina.app.motion import operation as module

    planned, planning = threading.Event(), threading.Event()
    plan = module.plan_recentring

    def slowly(*given):
        made = plan(*given)
        planning.set()
        planned.wait()
        return made

    monkeypatch.setattr(module, "plan_recentring", slowly)
    told = []
    operation = Operation(
        stepped.session, tmp_path, tmp_path, clock=stepped.clock, told=told.append
    )
    stepped.session.go_to({"zn": 20e-6})
    stepped.until_idle()
    stepped.step(0.02, 5)
    operation.recentre()
    planning.wait()
    stepped.session.emergency_stop()
    stepped.session.release()
    planned.set()
    operation._planning.join()
    assert stands(stepped)
    assert "try again" in told[0]
    operation.close()


def test_a_stop_does_not_wait_for_the_check_of_a_path(stepped, monkeypatch):
    """The check of a long path holds no lock that a stop, or another request, needs."""
    session, checking, checked = stepped.session, threading.Event(), threading.Event()

    def check(*_):
        checking.set()
        assert checked.wait(20.0)

    monkeypatch.setattr(session.bounds._guard, "play", check)
    refusals = []

    def play():
        try:
            session.play(PATH)
        except InputError as error:
            refusals.append(str(error))

    thread = threading.Thread(target=play)
    thread.start()
    assert checking.wait(20.0)
    session.stop()  # would hang here
    checked.set()
    thread.join()
    assert "a stop came after this request" in refusals[0]
    assert stands(stepped)


def test_a_machine_that_moved_while_a_path_was_checked_does_not_play_it(stepped, monkeypatch):
    session = stepped.session

    def meanwhile(*_):
        monkeypatch.undo()
        session.go_to({"x": REST + 1e-4})
        stepped.until_idle()
        stepped.step(0.02, 5)

    monkeypatch.setattr(session.bounds._guard, "play", meanwhile)
    with pytest.raises(RefusedError, match="have changed; play again"):
        session.play(PATH)
    assert stands(stepped)


def test_while_drivers_are_exchanged_nothing_is_accepted_and_both_are_stopped(stepped):
    session, old = stepped.session, stepped.driver
    session.go_to({"x": TARGET})
    stepped.step(0.02, 10)
    new = type(old)(session.robot, clock=stepped.clock)
    session.use(new)  # the worker still has the old one
    with pytest.raises(RefusedError, match="another device is being connected"):
        session.go_to({"x": REST})
    stops = old.stops
    session.stop()
    assert old.stops == stops + 1
    stepped.step()
    assert session.snapshot().locked is None
    session.go_to({"x": REST + 1e-4})
    assert stepped.until_idle().command["x"] == REST + 1e-4


def test_faults_are_not_cleared_nor_anything_switched_on_while_a_stop_is_latched(stepped):
    session = stepped.session
    session.emergency_stop()
    for request in (
        lambda: session.tool.switch(True),
        lambda: session.service.set_effects([]),
        lambda: session.bounds.teach_floor(),
    ):
        with pytest.raises(InputError, match="release it first"):
            request()
    session.tool.switch(False)
    stepped.step()
    assert session.tool.on is False
