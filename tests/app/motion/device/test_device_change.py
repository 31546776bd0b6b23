"""Another device can be connected in any state of the present one, and inherits nothing of it."""

import threading

import pytest

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
WAIT_S = 20.0
HOOKS = ("open", "close", "read", "move_to")


class FailingDevice(Simulator):
    """A machine whose driver fails or hangs in the calls of ``actions``."""

    name = "device"
    built_in_kind = None

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self.actions = {}
        self.calls, self.has_closed = [], threading.Event()

    def _act(self, hook):
        self.calls.append(hook)
        self.actions.get(hook, lambda: None)()

    def _open(self):
        self._act("open")
        super()._open()

    def _close(self):
        super()._close()
        self._act("close")
        self.has_closed.set()

    def _read(self):
        self._act("read")
        return super()._read()

    def _move_to(self, targets, speeds, permit):
        self._act("move_to")
        super()._move_to(targets, speeds, permit)

    def _stop(self):
        self.calls.append("stop")
        super()._stop()


def make_failure(error):
    def fail():
        raise error

    return fail


def never_connect(_harness):
    pass


def fail_to_open(harness):
    harness.driver.actions["open"] = make_failure(DriverTimeoutError("nobody answers"))
    harness.connect()


def lose_connection(harness):
    harness.connect()
    harness.driver.actions["read"] = make_failure(ConnectionLostError("the port has disappeared"))
    harness.step()


def unplug(harness):
    harness.connect()
    failure = make_failure(ConnectionLostError("the port has disappeared"))
    harness.driver.actions = {"read": failure, "close": failure}


def break_driver(harness):
    harness.connect()
    harness.driver.actions = dict.fromkeys(
        HOOKS, make_failure(RuntimeError("a mistake of a plugin"))
    )
    harness.step()


def enter_fault(harness):
    harness.connect()
    harness.driver._fault = "limit switch of x"
    harness.step()


def enter_doubt(harness):
    lose_connection(harness)
    del harness.driver.actions["read"]
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


# Devices that hang


class WatchedSession:
    """A session on its own threads, with its events; every wait is for an event."""

    def __init__(self, driver, **options):
        self.session = MotionSession(driver, **options)
        self.events = []
        self._news = threading.Condition()
        self.session.subscribe(self._note)

    def _note(self, event):
        with self._news:
            self.events.append(event)
            self._news.notify_all()

    def list_events(self, kind):
        return [event for event in self.events if isinstance(event, kind)]

    def wait_until(self, condition):
        """Wait until a condition holds; it is checked after every event."""
        with self._news:
            assert self._news.wait_for(lambda: condition(self), WAIT_S), self.session.snapshot()

    def wait_for_connection(self, connection):
        """Wait until the worker of the present driver is in a connection state."""
        self.wait_until(
            lambda watched_session: (
                watched_session.session._link.worker.driver is watched_session.session.driver
                and watched_session.session.reported.connection is connection
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

        device.actions[hook] = hang
        watched_session = WatchedSession(device, **{"max_release_s": 0.0, **options})
        created.append(watched_session)
        watched_session.session.start()
        if hook == "close":
            device.actions["read"] = make_failure(ConnectionLostError("the port has disappeared"))
        elif hook == "move_to":
            watched_session.wait_for_connection(ConnectionState.CONNECTED)
            watched_session.session.go_to({"x": 0.03})
        assert is_hanging.wait(WAIT_S)
        watched_session.events.clear()
        return watched_session, device

    yield make
    release_event.set()
    for watched_session in created:
        watched_session.session.close()


@pytest.mark.parametrize("hook", HOOKS)
def test_a_hanging_device_does_not_prevent_using_another_one(make_hanging, release_event, hook):
    watched_session, device = make_hanging(hook)
    session = watched_session.session
    new = Simulator(ROBOT)
    session.use_driver(new)
    watched_session.wait_for_connection(ConnectionState.CONNECTED)
    state = session.snapshot()
    assert (state.fault, state.doubt, state.lock_reason) == (None, None, None)
    (alarm,) = watched_session.list_events(AlarmRaised)
    assert "device has not answered" in alarm.message
    assert watched_session.list_events(FaultRaised) == []
    # That of the change; the hanging thread reported none.
    assert len(watched_session.list_events(StopRequested)) == 1

    session.go_to({"x": 0.028})
    watched_session.wait_until(
        lambda _: session.reported.activity is DeviceState.IDLE and _at(session, 0.028)
    )
    watched_session.events.clear()
    epoch = session.epoch
    device.actions.clear()
    release_event.set()
    assert device.has_closed.wait(WAIT_S)  # closed as soon as the call returned
    session.go_to({"x": 0.029})
    watched_session.wait_until(
        lambda _: session.reported.activity is DeviceState.IDLE and _at(session, 0.029)
    )
    assert session.epoch == epoch
    assert session.snapshot().connection is ConnectionState.CONNECTED
    assert (
        watched_session.list_events(FaultRaised) == watched_session.list_events(AlarmRaised) == []
    )
    assert {event.state.connection for event in watched_session.list_events(StateChanged)} == {
        ConnectionState.CONNECTED
    }
    assert session.driver is new


def _at(session, position):
    return session.reported.command.get("x") == position


def test_a_stop_still_reaches_an_abandoned_device(make_hanging):
    watched_session, device = make_hanging("read")
    watched_session.session.use_driver(Simulator(ROBOT))
    watched_session.wait_for_connection(ConnectionState.CONNECTED)
    device.calls.clear()
    watched_session.session.stop()
    assert device.calls == ["stop"]


def test_a_hanging_device_is_disconnected_and_cannot_be_reconnected(make_hanging):
    watched_session, device = make_hanging("read")
    watched_session.session.disconnect()
    watched_session.wait_until(
        lambda watched_session: (
            watched_session.session.snapshot().connection is ConnectionState.DISCONNECTED
        )
    )
    with pytest.raises(RequestRefusedError, match="device still hangs in an earlier call"):
        watched_session.session.reconnect()
    watched_session.session.use_driver(FailingDevice(ROBOT, {"seed": 1}))
    watched_session.wait_for_connection(ConnectionState.CONNECTED)
    assert device.calls[-1] != "close"


def test_the_playback_of_a_hanging_device_ends(make_hanging, release_event):
    device = FailingDevice(ROBOT)
    watched_session = WatchedSession(device, max_release_s=0.0)
    watched_session.session.start()
    watched_session.wait_for_connection(ConnectionState.CONNECTED)
    watched_session.session.play(make_example(ROBOT))
    watched_session.wait_until(
        lambda watched: watched.session.reported.activity is DeviceState.PLAYING
    )
    is_hanging = threading.Event()
    device.actions["read"] = lambda: (is_hanging.set(), release_event.wait(WAIT_S))
    assert is_hanging.wait(WAIT_S)
    watched_session.session.use_driver(Simulator(ROBOT))
    watched_session.wait_for_connection(ConnectionState.CONNECTED)
    (finished,) = watched_session.list_events(PlaybackFinished)
    assert not finished.completed
    release_event.set()
    assert watched_session.session.close()


def test_the_session_waits_for_a_device_that_is_only_slow(make_hanging, release_event):
    watched_session, device = make_hanging("close", max_release_s=WAIT_S)
    watched_session.session.use_driver(Simulator(ROBOT))
    assert watched_session.session.snapshot().connection is ConnectionState.CONNECTING
    release_event.set()
    watched_session.wait_for_connection(ConnectionState.CONNECTED)
    assert watched_session.list_events(AlarmRaised) == []
    assert device.has_closed.is_set()


def test_the_identity_of_a_lost_device_stays_known(make_harness):
    class Emulated(FailingDevice):
        def _identify(self):
            return MachineKind.VIRTUAL

    harness = make_harness(connect=False, driver=Emulated)
    assert not harness.session.driver.is_identified
    lose_connection(harness)
    assert harness.session.driver.machine_kind is MachineKind.VIRTUAL
