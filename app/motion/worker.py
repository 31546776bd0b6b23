"""The worker of a session: the only one that talks to the driver, ``stop`` excepted.

It is stepped, not timed: :meth:`Worker.run_once` is one cycle, called by the session's thread or,
without any thread, by a test.
"""

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from types import MappingProxyType

from rotemina.app.motion.history import LiveHistory
from rotemina.app.motion.live_model import LiveModel
from rotemina.app.motion.mailbox import ClearFault, Command, Mailbox, Move, Play, SetEffects
from rotemina.app.motion.recorder import PlaybackRecorder
from rotemina.app.motion.state import (
    CommandRefused,
    Connection,
    Event,
    Faulted,
    PlaybackFinished,
    SessionState,
    StateChanged,
)
from rotemina.drivers.abilities import EffectCarrier, TrajectoryPlayer
from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver
from rotemina.drivers.errors import DriverError, StateError
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError


class Worker:
    """Connects, executes queued commands, takes samples, records, and publishes ``state``.

    ``state`` is replaced as a whole, so any thread may look at it; so are ``targets``, where the
    device was last sent, of each axis that it has been sent anywhere since it last held.
    """

    def __init__(
        self,
        driver: Driver,
        mailbox: Mailbox,
        history: LiveHistory,
        clock: Clock,
        emit: Callable[[Event], None],
    ) -> None:
        self.state = SessionState(locked=_NOT_CONNECTED)
        self.targets: Mapping[str, float] = _NOWHERE
        self._driver = driver
        self._mailbox = mailbox
        self._history = history
        self._clock = clock
        self._emit = emit
        self._model = LiveModel(driver.robot)
        self._recorder: PlaybackRecorder | None = None
        self._next = self.state
        # Set by other threads, each in one assignment.
        self._stop_asked_s: float | None = None
        self._stop_failure: Exception | None = None

    def stopped(self, host_time_s: float, failure: Exception | None) -> None:
        """Note, from any thread, that a stop was handed to the device, or failed to be."""
        self.targets = _NOWHERE
        self._stop_asked_s = host_time_s
        if failure is not None:  # a later stop that succeeds does not mend what this one found
            self._stop_failure = failure
        self._mailbox.bell.set()

    def run_once(self) -> None:
        """Do one cycle. Whatever the driver raises ends in the failed state, never in here."""
        try:
            self._cycle()
        except Exception as error:  # a driver may raise anything; motion must lock and say so
            self._fail(_described(error))
        self._publish()

    def shut_down(self) -> None:
        """Stop and let go of the device."""
        self._mailbox.clear()
        with suppress(Exception):  # the link may be gone; there is nobody left to tell
            self._driver.stop()
        self._end_recording(completed=False)
        with suppress(Exception):
            self._driver.close()
        self._set_disconnected(Connection.DISCONNECTED, self._next.fault)
        self._publish()

    def _cycle(self) -> None:
        if self._mailbox.take_connection_request():
            self._connect()
        if self._next.connection is not Connection.CONNECTED:
            return
        failure, self._stop_failure = self._stop_failure, None
        if failure is not None:
            raise failure
        self._execute()
        self._take_samples()

    def _connect(self) -> None:
        if self._next.connection is Connection.CONNECTED:
            return
        self._next = SessionState(connection=Connection.CONNECTING, locked="connecting; wait")
        self._publish()
        self._mailbox.clear()
        self._stop_failure = None
        self.targets = _NOWHERE
        self._driver.open()
        self._history.clear()
        self._model.restart()
        self._next = replace(self._next, connection=Connection.CONNECTED)

    def _execute(self) -> None:
        while (taken := self._mailbox.take()) is not None:
            try:
                self._do(taken.command)
            except (InputError, StateError) as error:
                self._emit(CommandRefused(str(error)))
            # A stop that came while the command was on its way must not be undone by it.
            if self._mailbox.generation != taken.generation:
                self.targets = _NOWHERE
                self._driver.stop()

    def _do(self, command: Command) -> None:
        if isinstance(command, Move):
            self._driver.move_to(command.targets)
            self.targets = MappingProxyType({**self.targets, **command.targets})
        elif isinstance(command, Play):
            self._play(command)
        elif isinstance(command, SetEffects):
            assert isinstance(self._driver, EffectCarrier), "the session refuses on any other"
            self._driver.set_effects(command.effects)
        elif isinstance(command, ClearFault):
            self._driver.clear_fault()
            self.targets = _NOWHERE
            self._model.restart()
            self._next = replace(self._next, fault=None)

    def _play(self, command: Play) -> None:
        driver = self._driver
        assert isinstance(driver, TrajectoryPlayer), "the session refuses to play on any other"
        recorder = PlaybackRecorder(command.trajectory, driver.name)
        driver.play(command.trajectory)
        self.targets = _NOWHERE
        self._recorder = recorder

    def _take_samples(self) -> None:
        samples = self._driver.read()
        status = self._driver.status()
        model = self._model.follow(samples)
        self._history.append(samples, model)
        self._next = self._updated(samples, model, status)
        self._note_standstill(status)
        faulted = status.state is DeviceState.FAULT and self.state.fault != self._next.fault
        if faulted:
            self._mailbox.clear()
            self.targets = _NOWHERE
        # Published before events tell of it: a subscriber may answer with the next command.
        self._publish()
        if self._recorder is not None:
            self._recorder.add(samples)
            if status.state is not DeviceState.PLAYING:
                self._end_recording(completed=True)
        if faulted:
            self._emit(Faulted(self._next.fault or ""))

    def _updated(self, samples: Samples, model: FloatArray, status: DeviceStatus) -> SessionState:
        fault = self._next.fault
        if status.state is DeviceState.FAULT:
            fault = status.fault or "the device reports a fault"
        state = replace(self._next, activity=status.state, progress=status.progress, fault=fault)
        if len(samples):
            axes = self._driver.axes
            state = replace(
                state,
                measured=_by_axis(axes, samples.measured),
                command=_by_axis(axes, samples.command),
                model=_by_axis(axes, model),
                device_time_s=float(samples.device_time_s[-1]),
                sample_host_time_s=self._clock(),
            )
        known = status.position_known and state.sample_host_time_s is not None
        state = replace(state, position_known=known)
        return replace(state, locked=_lock_reason(state))

    def _note_standstill(self, status: DeviceStatus) -> None:
        asked_s = self._stop_asked_s
        if asked_s is None:
            return
        self._next = replace(self._next, standstill_s=None)
        if status.state in (DeviceState.IDLE, DeviceState.FAULT):
            self._stop_asked_s = None
            self._next = replace(self._next, standstill_s=self._clock() - asked_s)

    def _end_recording(self, *, completed: bool) -> None:
        recorder, self._recorder = self._recorder, None
        if recorder is None:
            return
        record = recorder.finish()
        self._emit(PlaybackFinished(record, completed and recorder.complete and record is not None))

    def _fail(self, message: str) -> None:
        """Lock motion; only an explicit reconnection ends this."""
        self._mailbox.clear()
        self.targets = _NOWHERE
        with suppress(Exception):  # best effort: the device is expected not to answer
            self._driver.stop()
        with suppress(Exception):
            self._driver.close()
        self._set_disconnected(Connection.FAILED, message)
        self._publish()
        self._end_recording(completed=False)
        self._emit(Faulted(message))

    def _set_disconnected(self, connection: Connection, fault: str | None) -> None:
        self._next = replace(
            self._next,
            connection=connection,
            activity=DeviceState.CLOSED,
            position_known=False,
            fault=fault,
        )
        self._next = replace(self._next, locked=_lock_reason(self._next))

    def _publish(self) -> None:
        before, self.state = self.state, self._next
        if _told(before) != _told(self.state):
            self._emit(StateChanged(self.state))


_NOWHERE: Mapping[str, float] = MappingProxyType({})
_NOT_CONNECTED = "not connected; connect first"


def _lock_reason(state: SessionState) -> str | None:
    if state.connection is Connection.FAILED:
        return f"the device failed ({state.fault}); reconnect, then check where it stands"
    if state.connection is not Connection.CONNECTED:
        return _NOT_CONNECTED
    if state.fault is not None:
        return f"the device reports a fault ({state.fault}); clear it first"
    if not state.position_known:
        return "the position is not known yet"
    return None


def _told(state: SessionState) -> tuple[object, ...]:
    """Return what of a state is worth an event; positions are read from the history instead."""
    return (state.connection, state.activity, state.fault, state.locked, state.position_known)


def _by_axis(axes: tuple[str, ...], values: FloatArray) -> MappingProxyType[str, float]:
    return MappingProxyType(dict(zip(axes, values[-1].tolist(), strict=True)))


def _described(error: Exception) -> str:
    if isinstance(error, DriverError | InputError):
        return str(error)
    return f"unexpected {type(error).__name__} from the driver: {error}"
