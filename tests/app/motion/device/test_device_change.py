"""Another device can be connected in any state of the present one, and inherits nothing of it."""

import threading

import pytest
from tests.app.conftest import UnrulySimulator
from tests.app.motion.event_log import WAIT_S, EventLog

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    AlarmRaised,
    ConnectionState,
    FaultRaised,
    PlaybackFinished,
    StateChanged,
    StopRequested,
)
from rotemina.drivers.contract import (
    ConnectionLostError,
    DeviceState,
    DriverTimeoutError,
    MachineKind,
)
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import make_example

ROBOT = load_robot("rotemina")
HOOKS = ("open", "close", "read", "move_to")


class FailingDevice(UnrulySimulator):
    """A machine whose driver fails or hangs in the calls of ``before``."""

    name = "device"
    built_in_kind = None

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self.calls, self.has_closed = [], threading.Event()

    def _run_before(self, hook):
        self.calls.append(hook)
        super()._run_before(hook)

    def _close(self):
        super()._close()
        self._run_before("close")
        self.has_closed.set()


def fail_to_open(harness):
    harness.driver.fail("open", DriverTimeoutError("nobody answers"))
    harness.connect()


def lose_connection(harness):
    harness.connect()
    harness.driver.fail("read", ConnectionLostError("the port has disappeared"))
    harness.step()


def unplug(harness):
    harness.connect()
    for hook in ("read", "close"):
        harness.driver.fail(hook, ConnectionLostError("the port has disappeared"))


def break_driver(harness):
    harness.connect()
    for hook in HOOKS:
        harness.driver.fail(hook, RuntimeError("a mistake of a plugin"))
    harness.step()


def enter_fault(harness):
    harness.connect()
    harness.driver._fault = "limit switch of x"
    harness.step()


def enter_doubt(harness):
    lose_connection(harness)
    del harness.driver.before["read"]
    harness.session.reconnect()
    assert harness.step().doubt is not None


def stop(harness):
    harness.connect()
    harness.session.stop("the sample is ready")
    harness.step()


def move(harness):
    harness.connect()
    harness.session.go_to({"x": 0.05})
    assert harness.step().activity is DeviceState.MOVING


def play(harness):
    harness.connect()
    harness.session.play(make_example(ROBOT))
    harness.step_until(DeviceState.PLAYING)


def home(harness):
    harness.connect()
    harness.session.home()
    assert harness.step().activity is DeviceState.HOMING


def begin_disconnecting(harness):
    harness.connect()
    harness.session.disconnect()


def disconnect(harness):
    begin_disconnecting(harness)
    harness.step()


def begin_connecting(harness):
    harness.session.connect()


def never_connect(_harness):
    pass


PREPARATIONS = (
    never_connect,
    fail_to_open,
    lose_connection,
    unplug,
    break_driver,
    enter_fault,
    enter_doubt,
    stop,
    move,
    play,
    home,
    begin_disconnecting,
    disconnect,
    begin_connecting,
)


@pytest.mark.parametrize("bring_into", PREPARATIONS, ids=lambda function: function.__name__)
def test_another_device_can_be_connected_in_any_state_of_the_present_one(make_harness, bring_into):
    harness = make_harness(connect=False, driver=FailingDevice)
    bring_into(harness)
    session, old = harness.session, harness.driver
    new = Simulator(ROBOT, {"start_fraction": 0.25}, clock=harness.clock)
    session.use_driver(new)
    connecting_state = session.snapshot()
    assert (
        connecting_state.connection,
        connecting_state.fault,
        connecting_state.doubt,
        connecting_state.measured,
        connecting_state.unhomed,
    ) == ((ConnectionState.CONNECTING, None, None, {}, ()))
    state = harness.step()
    assert (state.connection, state.lock_reason) == (ConnectionState.CONNECTED, None)
    assert (state.fault, state.doubt, state.stop, state.unhomed) == (None, None, None, ())
    assert (state.stop_latency_s, state.standstill_s) == (None, None)
    assert state.command["x"] == pytest.approx(0.25 * 0.055, abs=1e-9)
    assert old.status().state is DeviceState.CLOSED
    session.go_to({"x": 0.014})
    assert harness.step_until_idle().command["x"] == 0.014


def test_a_latched_stop_applies_to_the_next_device_and_is_reported(make_harness):
    harness = make_harness(driver=FailingDevice)
    session = harness.session
    session.emergency_stop()
    harness.step()
    session.use_driver(Simulator(ROBOT, clock=harness.clock))
    state = harness.step()
    assert state.connection is ConnectionState.CONNECTED
    assert state.latch_reason is not None
    assert [event.message for event in harness.list_events(AlarmRaised)] == [
        "stop and lock is still active with simulator; release it to move"
    ]
    with pytest.raises(InputError, match="release it first"):
        session.go_to({"x": 0.03})
    session.release()
    session.go_to({"x": 0.03})
    assert harness.step_until_idle().command["x"] == 0.03


def test_a_new_driver_of_the_same_machine_keeps_the_doubt(make_harness):
    harness = make_harness(connect=False, driver=FailingDevice)
    lose_connection(harness)
    harness.session.use_driver(FailingDevice(ROBOT, clock=harness.clock))
    state = harness.step()
    assert state.fault is None
    assert "may be wrong" in state.lock_reason
    # Not the same settings.
    harness.session.use_driver(FailingDevice(ROBOT, {"seed": 1}, clock=harness.clock))
    assert harness.step().lock_reason is None


def test_the_driver_of_another_robot_is_refused(harness):
    with pytest.raises(RequestRefusedError, match="start the program with that robot"):
        harness.session.use_driver(Simulator(load_robot("picma"), clock=harness.clock))
    assert harness.step().lock_reason is None


def wait_for_connection(log, connection):
    """Wait until the worker of the present driver is in a connection state."""
    session = log.session
    log.wait_until(
        lambda: (
            session._link.worker.driver is session.driver
            and session.reported.connection is connection
        )
    )


@pytest.fixture
def release_event():
    """An event that releases all hanging calls; it is set at the end."""
    event = threading.Event()
    yield event
    event.set()


@pytest.fixture
def make_hanging(release_event):
    """Return a function that makes a session whose device hangs in one call."""
    created = []

    def make(hook, **options):
        device = FailingDevice(ROBOT)
        is_hanging = threading.Event()

        def hang():
            is_hanging.set()
            release_event.wait(WAIT_S)

        device.before[hook] = hang
        log = EventLog(MotionSession(device, **{"max_release_s": 0.0, **options}))
        created.append(log)
        log.session.start()
        if hook == "close":
            device.fail("read", ConnectionLostError("the port has disappeared"))
        elif hook == "move_to":
            wait_for_connection(log, ConnectionState.CONNECTED)
            log.session.go_to({"x": 0.03})
        assert is_hanging.wait(WAIT_S)
        log.events.clear()
        return log, device

    yield make
    release_event.set()
    for log in created:
        log.session.close()


@pytest.mark.parametrize("hook", HOOKS)
def test_a_hanging_device_does_not_prevent_using_another_one(make_hanging, release_event, hook):
    log, device = make_hanging(hook)
    session = log.session
    new = Simulator(ROBOT)
    session.use_driver(new)
    wait_for_connection(log, ConnectionState.CONNECTED)
    state = session.snapshot()
    assert (state.fault, state.doubt, state.lock_reason) == (None, None, None)
    (alarm,) = log.list_events(AlarmRaised)
    assert "device has not answered" in alarm.message
    assert log.list_events(FaultRaised) == []
    # That of the change; the hanging thread reported none.
    assert len(log.list_events(StopRequested)) == 1

    session.go_to({"x": 0.028})
    log.wait_until(lambda: rests_at(session, 0.028))
    log.events.clear()
    epoch = session.epoch
    device.before.clear()
    release_event.set()
    assert device.has_closed.wait(WAIT_S)  # closed as soon as the call returned
    session.go_to({"x": 0.029})
    log.wait_until(lambda: rests_at(session, 0.029))
    assert session.epoch == epoch
    assert session.snapshot().connection is ConnectionState.CONNECTED
    assert log.list_events(FaultRaised) == log.list_events(AlarmRaised) == []
    assert {event.state.connection for event in log.list_events(StateChanged)} == {
        ConnectionState.CONNECTED
    }
    assert session.driver is new


def rests_at(session, position):
    state = session.reported
    return state.activity is DeviceState.IDLE and state.command.get("x") == position


def test_a_stop_still_reaches_an_abandoned_device(make_hanging):
    log, device = make_hanging("read")
    log.session.use_driver(Simulator(ROBOT))
    wait_for_connection(log, ConnectionState.CONNECTED)
    device.calls.clear()
    log.session.stop()
    assert device.calls == ["stop"]


def test_a_hanging_device_is_disconnected_and_cannot_be_reconnected(make_hanging):
    log, device = make_hanging("read")
    log.session.disconnect()
    log.wait_until(lambda: log.session.snapshot().connection is ConnectionState.DISCONNECTED)
    with pytest.raises(RequestRefusedError, match="device still hangs in an earlier call"):
        log.session.reconnect()
    log.session.use_driver(FailingDevice(ROBOT, {"seed": 1}))
    wait_for_connection(log, ConnectionState.CONNECTED)
    assert device.calls[-1] != "close"


def test_the_playback_of_a_hanging_device_ends(make_hanging, release_event):
    device = FailingDevice(ROBOT)
    log = EventLog(MotionSession(device, max_release_s=0.0))
    log.session.start()
    wait_for_connection(log, ConnectionState.CONNECTED)
    log.session.play(make_example(ROBOT))
    log.wait_until(lambda: log.session.reported.activity is DeviceState.PLAYING)
    is_hanging = threading.Event()
    device.before["read"] = lambda: (is_hanging.set(), release_event.wait(WAIT_S))
    assert is_hanging.wait(WAIT_S)
    log.session.use_driver(Simulator(ROBOT))
    wait_for_connection(log, ConnectionState.CONNECTED)
    (finished,) = log.list_events(PlaybackFinished)
    assert not finished.completed
    release_event.set()
    assert log.session.close()


def test_the_session_waits_for_a_device_that_is_only_slow(make_hanging, release_event):
    log, device = make_hanging("close", max_release_s=WAIT_S)
    log.session.use_driver(Simulator(ROBOT))
    assert log.session.snapshot().connection is ConnectionState.CONNECTING
    release_event.set()
    wait_for_connection(log, ConnectionState.CONNECTED)
    assert log.list_events(AlarmRaised) == []
    assert device.has_closed.is_set()


def test_the_identity_of_a_lost_device_stays_known(make_harness):
    class Emulated(FailingDevice):
        def _identify(self):
            return MachineKind.VIRTUAL

    harness = make_harness(connect=False, driver=Emulated)
    assert not harness.session.driver.is_identified
    lose_connection(harness)
    assert harness.session.driver.machine_kind is MachineKind.VIRTUAL
