"""Another device can be connected whatever the present one does, and shows nothing of it."""

import threading

import pytest

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    Alarmed,
    Connection,
    Faulted,
    PlaybackFinished,
    StateChanged,
    Stopped,
)
from rotemina.drivers.driver import MachineKind
from rotemina.drivers.errors import ConnectionLostError, DriverTimeoutError
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.first_trajectory import example_for

ROBOT = load_robot("rotemina")
WAIT_S = 20.0
HOOKS = ("open", "close", "read", "move_to")


class Device(Simulator):
    """A machine whose driver fails, or hangs until it is set free, in the calls of ``acts``."""

    name = "device"
    built_in_kind = None

    def __init__(self, *given, **named):
        super().__init__(*given, **named)
        self.acts = {}
        self.calls, self.left = [], threading.Event()

    def _act(self, hook):
        self.calls.append(hook)
        self.acts.get(hook, lambda: None)()

    def _open(self):
        self._act("open")
        super()._open()

    def _close(self):
        super()._close()
        self._act("close")
        self.left.set()

    def _read(self):
        self._act("read")
        return super()._read()

    def _move_to(self, targets, speeds, permit):
        self._act("move_to")
        super()._move_to(targets, speeds, permit)

    def _stop(self):
        self.calls.append("stop")
        super()._stop()


def failing(error):
    def fail():
        raise error

    return fail


def never_connected(_stepped):
    pass


def refused_to_open(stepped):
    stepped.driver.acts["open"] = failing(DriverTimeoutError("nobody answers"))
    stepped.connect()


def lost(stepped):
    stepped.connect()
    stepped.driver.acts["read"] = failing(ConnectionLostError("the port has disappeared"))
    stepped.step()


def unplugged(stepped):
    stepped.connect()
    gone = failing(ConnectionLostError("the port has disappeared"))
    stepped.driver.acts = {"read": gone, "close": gone}


def broken(stepped):
    stepped.connect()
    stepped.driver.acts = dict.fromkeys(HOOKS, failing(RuntimeError("a mistake of a plugin")))
    stepped.step()


def in_fault(stepped):
    stepped.connect()
    stepped.driver._fault = "limit switch of x"
    stepped.step()


def doubted(stepped):
    lost(stepped)
    del stepped.driver.acts["read"]
    stepped.session.reconnect()
    assert stepped.step().doubt is not None


def stopped(stepped):
    stepped.connect()
    stepped.session.stop("the sample is ready")
    stepped.step()


def moving(stepped):
    stepped.connect()
    stepped.session.go_to({"x": 0.05})
    assert stepped.step().activity is DeviceState.MOVING


def playing(stepped):
    stepped.connect()
    stepped.session.play(example_for(ROBOT))
    stepped.until(DeviceState.PLAYING)


def homing(stepped):
    stepped.connect()
    stepped.session.home()
    assert stepped.step().activity is DeviceState.HOMING


def disconnecting(stepped):
    stepped.connect()
    stepped.session.disconnect()


def disconnected(stepped):
    disconnecting(stepped)
    stepped.step()


def connecting(stepped):
    stepped.session.connect()


STATES = (
    never_connected,
    refused_to_open,
    lost,
    unplugged,
    broken,
    in_fault,
    doubted,
    stopped,
    moving,
    playing,
    homing,
    disconnecting,
    disconnected,
    connecting,
)


@pytest.mark.parametrize("bring_into", STATES, ids=lambda state: state.__name__)
def test_another_device_is_connected_in_any_state_of_the_present_one(make_stepped, bring_into):
    stepped = make_stepped(connect=False, driver=Device)
    bring_into(stepped)
    session, old = stepped.session, stepped.driver
    new = Simulator(ROBOT, {"start_fraction": 0.25}, clock=stepped.clock)
    session.use(new)
    shown = session.snapshot()
    assert (shown.connection, shown.fault, shown.doubt, shown.measured, shown.unhomed) == (
        (Connection.CONNECTING, None, None, {}, ())
    )
    state = stepped.step()
    assert (state.connection, state.locked) == (Connection.CONNECTED, None)
    assert (state.fault, state.doubt, state.stop, state.unhomed) == (None, None, None, ())
    assert (state.stop_latency_s, state.standstill_s) == (None, None)
    assert state.command["x"] == pytest.approx(0.25 * 0.055, abs=1e-9)
    assert old.status().state is DeviceState.CLOSED
    session.go_to({"x": 0.014})
    assert stepped.until_idle().command["x"] == 0.014


def test_a_latched_stop_stays_with_the_next_device_and_that_is_told(make_stepped):
    stepped = make_stepped(driver=Device)
    session = stepped.session
    session.emergency_stop()
    stepped.step()
    session.use(Simulator(ROBOT, clock=stepped.clock))
    state = stepped.step()
    assert state.connection is Connection.CONNECTED
    assert state.latched is not None
    assert [one.message for one in stepped.told(Alarmed)] == [
        "stop and lock is still active with simulator; release it to move"
    ]
    with pytest.raises(InputError, match="release it first"):
        session.go_to({"x": 0.03})
    session.release()
    session.go_to({"x": 0.03})
    assert stepped.until_idle().command["x"] == 0.03


def test_the_same_machine_keeps_its_doubt_when_its_driver_is_made_anew(make_stepped):
    stepped = make_stepped(connect=False, driver=Device)
    lost(stepped)
    stepped.session.use(Device(ROBOT, clock=stepped.clock))
    state = stepped.step()
    assert state.fault is None
    assert "may be wrong" in state.locked
    stepped.session.use(Device(ROBOT, {"seed": 1}, clock=stepped.clock))  # not the same settings
    assert stepped.step().locked is None


# --- devices that hang ----------------------------------------------------------------------------


class Watched:
    """A session on its own threads, and what it tells; every wait is for an event."""

    def __init__(self, driver, **options):
        self.session = MotionSession(driver, **options)
        self.events = []
        self._news = threading.Condition()
        self.session.subscribe(self._note)

    def _note(self, event):
        with self._news:
            self.events.append(event)
            self._news.notify_all()

    def told(self, kind):
        return [event for event in self.events if isinstance(event, kind)]

    def wait(self, holds):
        """Wait until something holds that an event tells of."""
        with self._news:
            assert self._news.wait_for(lambda: holds(self), WAIT_S), self.session.snapshot()

    def wait_for(self, connection):
        """Wait until the worker of the driver in use is in a state."""
        self.wait(
            lambda own: (
                own.session._link.worker.driver is own.session.driver
                and own.session.reported.connection is connection
            )
        )


@pytest.fixture
def free():
    """An event that sets free all that hangs; set at the end."""
    event = threading.Event()
    yield event
    event.set()


@pytest.fixture
def watched(free):
    """Make a session whose device hangs in one call."""
    made = []

    def make(hook, **options):
        device = Device(ROBOT)
        hangs = threading.Event()

        def hang():
            hangs.set()
            free.wait(WAIT_S)

        device.acts[hook] = hang
        own = Watched(device, **{"max_release_s": 0.0, **options})
        made.append(own)
        own.session.start()
        if hook == "close":
            device.acts["read"] = failing(ConnectionLostError("the port has disappeared"))
        elif hook == "move_to":
            own.wait_for(Connection.CONNECTED)
            own.session.go_to({"x": 0.03})
        assert hangs.wait(WAIT_S)
        own.events.clear()
        return own, device

    yield make
    free.set()
    for one in made:
        one.session.close()


@pytest.mark.parametrize("hook", HOOKS)
def test_a_device_that_hangs_keeps_nobody_from_another_one(watched, free, hook):
    own, device = watched(hook)
    session = own.session
    new = Simulator(ROBOT)
    session.use(new)
    own.wait_for(Connection.CONNECTED)
    state = session.snapshot()
    assert (state.fault, state.doubt, state.locked) == (None, None, None)
    (alarm,) = own.told(Alarmed)
    assert "device has not answered" in alarm.message
    assert own.told(Faulted) == []
    assert len(own.told(Stopped)) == 1  # of the change, which the hanging thread did not tell

    session.go_to({"x": 0.028})
    own.wait(lambda one: session.reported.activity is DeviceState.IDLE and _at(session, 0.028))
    own.events.clear()
    epoch = session.epoch
    device.acts.clear()
    free.set()
    assert device.left.wait(WAIT_S)  # released as soon as it returned
    session.go_to({"x": 0.029})
    own.wait(lambda one: session.reported.activity is DeviceState.IDLE and _at(session, 0.029))
    assert session.epoch == epoch
    assert session.snapshot().connection is Connection.CONNECTED
    assert own.told(Faulted) == own.told(Alarmed) == []
    assert {one.state.connection for one in own.told(StateChanged)} == {Connection.CONNECTED}
    assert session.driver is new


def _at(session, position):
    return session.reported.command.get("x") == position


def test_a_stop_still_reaches_a_device_that_was_left_alone(watched):
    own, device = watched("read")
    own.session.use(Simulator(ROBOT))
    own.wait_for(Connection.CONNECTED)
    device.calls.clear()
    own.session.stop()
    assert device.calls == ["stop"]


def test_a_device_that_hangs_is_disconnected_and_not_connected_again_by_itself(watched):
    own, device = watched("read")
    own.session.disconnect()
    own.wait(lambda one: one.session.snapshot().connection is Connection.DISCONNECTED)
    with pytest.raises(RefusedError, match="device still hangs in an earlier call"):
        own.session.reconnect()
    own.session.use(Device(ROBOT, {"seed": 1}))
    own.wait_for(Connection.CONNECTED)
    assert device.calls[-1] != "close"


def test_the_playback_of_a_device_that_hangs_is_ended(watched, free):
    device = Device(ROBOT)
    own = Watched(device, max_release_s=0.0)
    own.session.start()
    own.wait_for(Connection.CONNECTED)
    own.session.play(example_for(ROBOT))
    own.wait(lambda one: one.session.reported.activity is DeviceState.PLAYING)
    hangs = threading.Event()
    device.acts["read"] = lambda: (hangs.set(), free.wait(WAIT_S))
    assert hangs.wait(WAIT_S)
    own.session.use(Simulator(ROBOT))
    own.wait_for(Connection.CONNECTED)
    (finished,) = own.told(PlaybackFinished)
    assert not finished.completed
    free.set()
    assert own.session.close()


def test_a_device_that_is_only_slow_is_waited_for(watched, free):
    own, device = watched("close", max_release_s=WAIT_S)
    own.session.use(Simulator(ROBOT))
    assert own.session.snapshot().connection is Connection.CONNECTING
    free.set()
    own.wait_for(Connection.CONNECTED)
    assert own.told(Alarmed) == []
    assert device.left.is_set()


def test_what_a_device_said_of_itself_is_known_while_it_is_lost(make_stepped):
    class Emulated(Device):
        def _identify(self):
            return MachineKind.VIRTUAL

    stepped = make_stepped(connect=False, driver=Emulated)
    assert not stepped.session.driver.is_identified
    lost(stepped)
    assert stepped.session.driver.machine_kind is MachineKind.VIRTUAL
