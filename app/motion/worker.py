"""The worker of a session: the only thread that talks to the driver, except for ``stop``.

It is stepped, not timed: :meth:`Worker.run_once` is one cycle, called by the session's thread or,
without any thread, by a test.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace

from rotemina.app.motion.device_report import with_samples, with_status
from rotemina.app.motion.executor import Executor
from rotemina.app.motion.held_inverses import HeldInverses
from rotemina.app.motion.live_models import LiveModels, ModelOutputs, PreparedModel
from rotemina.app.motion.mailbox import (
    ClearFault,
    ConnectionRequest,
    Drive,
    Home,
    Mailbox,
    Move,
    Play,
    RefusedError,
    RunProfile,
    SetVoltage,
)
from rotemina.app.motion.model_in_use import Machine, ModelInUse
from rotemina.app.motion.ownership import Ownership
from rotemina.app.motion.playback_notes import PlaybackNotes
from rotemina.app.motion.position_trust import LOST, PositionTrust
from rotemina.app.motion.recent_deviation import ReadingDeviation
from rotemina.app.motion.recent_history import LiveHistory
from rotemina.app.motion.sample_portions import SamplePortions
from rotemina.app.motion.sensor_corrections import SensorCorrections
from rotemina.app.motion.state import (
    NOT_CONNECTED,
    Alarmed,
    CommandRefused,
    Connection,
    Event,
    Faulted,
    ModelChanged,
    PlaybackFinished,
    SessionState,
    StateChanged,
    Stopped,
    lock_reason,
)
from rotemina.app.motion.stop import StopRequest
from rotemina.app.motion.stop_progress import StopTracking
from rotemina.app.motion.stop_send_latency import StopLatency
from rotemina.drivers.abilities import Homer, Linked
from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver, MachineKind
from rotemina.drivers.errors import DeviceResetError, DriverError, StateError
from rotemina.drivers.gate import Gate
from rotemina.drivers.line_quality import LinkQuality
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.messages import AxisName, joined, message

#: Called with samples and what the models say of them.
Tap = Callable[[Samples, ModelOutputs], None]


class Worker:
    """Connects, executes queued commands, takes samples, records, and publishes ``state``.

    ``state`` is replaced as a whole, so any thread may look at it.

    The device is read in every cycle, which may be every millisecond; what it said is worked up in
    portions, as fast as a screen could show it. ``tell`` gets each portion; it must not raise.
    """

    def __init__(
        self,
        driver: Driver,
        gate: Gate,
        mailbox: Mailbox,
        history: LiveHistory,
        clock: Clock,
        emit: Callable[[Event], None],
        tell: Tap = lambda _, __: None,
    ) -> None:
        #: What puts readings right, before anybody sees them.
        self.corrections = SensorCorrections(driver.axes)
        self.state = SessionState(locked=NOT_CONNECTED)
        self.ownership = Ownership()
        self.latency = StopLatency()
        #: The one that is open, or was open last; exchanged on this worker's thread.
        self.driver = driver
        self._gate = gate
        self._mailbox = mailbox
        self._history = history
        self._clock = clock
        self._emit = emit
        self._tell = tell
        self.models = LiveModels(driver)
        self._trust = PositionTrust(driver.robot)
        #: What the tip's bounds are judged on beside commands.
        self.deviation = ReadingDeviation(driver.robot)
        self.notes = PlaybackNotes()
        #: Of axes that the device does not compensate by itself.
        self.inverses = HeldInverses(driver.robot)
        #: Of the driver in use; what it was told may be looked at by any thread.
        self.executor = self._executor_of(driver)
        self._next = self.state
        self._portions = SamplePortions()
        self._stirred = False  # since the state was published
        self._stops = StopTracking(clock)
        #: Whether another worker has taken the place of this one, which hangs in its driver.
        self.is_retired = False
        #: Whether it has released its driver for good.
        self.has_ended = False
        self._predecessor: Worker | None = None

    @property
    def is_resting_since_stop(self) -> bool:
        """Whether the device has not been seen to move since the latest stop brought it to rest."""
        return self._stops.is_latest

    @property
    def at_rest(self) -> bool:
        """Whether nothing moves, waits, or was handed over since the device was looked at last."""
        resting = self.state.activity is DeviceState.IDLE
        return resting and not self._mailbox.busy and not self._stirred

    @property
    def driver_hangs(self) -> bool:
        """Whether an earlier worker still hangs in this worker's driver, which is left alone."""
        before = self._predecessor
        if before is None:
            return False
        return not before.has_ended or before.driver_hangs

    def successor(self) -> "Worker":
        """Return a worker that takes the place of this one, which hangs in its driver.

        Whatever this one still does when its driver returns changes nothing of what the session
        shows, and passes no gate. Called on another thread.
        """
        with suppress(Exception):  # it may not hang after all
            self._end_recording(completed=False)
        made = Worker(
            self.driver,
            self._gate,
            self._mailbox,
            self._history,
            self._clock,
            self._emit,
            self._tell,
        )
        if self._next.connection is Connection.CONNECTED:
            self._trust.doubt(LOST, self._lost_axes())
        made.corrections, made.ownership, made.latency = (
            self.corrections,
            self.ownership,
            self.latency,
        )
        made.models, made.notes, made._trust = self.models, self.notes, self._trust
        made.executor = made._executor_of(self.driver)
        made._stops, made.state, made._predecessor = self._stops, self.state, self
        made._set_disconnected(Connection.DISCONNECTED, None)
        self._retire()
        return made

    def _retire(self) -> None:
        """Replace everything that is shared by something that nobody looks at."""
        self.is_retired = True
        gate = Gate(self._clock)
        gate.stop(latch=message("engine", "another device is connected"))
        self.driver.gate = self._gate = gate
        self._mailbox = Mailbox(1)
        self._emit = self._tell = _ignore
        self._history = LiveHistory(self.driver.axes, seconds=1.0, rate_hz=1.0)
        self.corrections = SensorCorrections(self.driver.axes)
        self.ownership, self.latency = Ownership(), StopLatency()
        self.models, self.notes = LiveModels(self.driver), PlaybackNotes()
        self._trust = PositionTrust(self.driver.robot)
        self._stops = StopTracking(self._clock)

    def stopped(self, host_time_s: float, failure: Exception | None, request: StopRequest) -> None:
        """Note, from any thread, that a stop was handed to the device, or failed to be."""
        self.executor.forget()
        self._stops.note(host_time_s, failure, request)
        self._mailbox.wake_event.set()

    def run_once(self) -> None:
        """Do one cycle. Whatever the driver raises ends in the failed state, never in here."""
        for request in self._stops.unreported():
            self._emit(Stopped(request))
        for play in self._mailbox.take_dropped_plays():
            self._emit(_never_began(play))
        try:
            self._cycle()
        except Exception as error:  # a driver may raise anything; motion must lock and say so
            if self._next.connection is Connection.CONNECTED:
                self._trust.doubt(LOST, self._lost_axes())
            lost = isinstance(error, ConnectionError | TimeoutError)
            self._fail(
                _described(error), link_lost=lost and not isinstance(error, DeviceResetError)
            )
        self._publish()

    def use_model(self, prepared: PreparedModel) -> None:
        """Answer by another model from now on; on the worker's thread.

        Raises
        ------
        RefusedError
            If the machine moves, or is another than the model's.
        """
        if self.driver.status().state is not DeviceState.IDLE or self.executor.recorder:
            raise RefusedError(
                message("engine", "the machine is still moving; change the model at rest")
            )
        why = prepared.model.machine.differs(Machine.of(self.driver))
        if why is not None:
            raise RefusedError(
                message(
                    "engine", "the model belongs to another machine: {why}; diagnose this one"
                ).fill(why=why)
            )
        self.models.use(prepared)
        self._note_model()

    def _check_machine(self) -> None:
        """Go back to the nominal model where the machine is another than the model's."""
        model, machine = self.models.model, Machine.of(self.driver)
        why = model.machine.differs(machine)
        if why is not None:
            nominal = ModelInUse.nominal_of(self.driver)
            self.models.use(PreparedModel(nominal, ()))
            self._note_model(why if model.corrected else "")

    def _note_model(self, why: str = "") -> None:
        """Begin the gap again, and tell which model it is of."""
        self._history.restart_gap()
        self._next = replace(self._next, model_id=self.models.model.id)
        self._publish()
        self._emit(ModelChanged(self.models.model, why))

    def confirm_position(self) -> None:
        """Trust the device's position again after a lost connection; on the worker's thread."""
        self._trust.confirm()

    def shut_down(self) -> None:
        """Stop and release the device."""
        self._release_device()
        self._publish()
        self.has_ended = True

    def _let_go(self) -> None:
        """Forget all requests, and stop as far as possible; there is nobody left to tell."""
        self._gate.reconnected()
        self._mailbox.clear()
        self.executor.forget()
        self.ownership.release()
        if not self.driver_hangs:
            with suppress(Exception):  # the link may be gone
                self.driver.stop()

    def _release_device(self) -> None:
        self._let_go()
        self._end_recording(completed=False)
        if not self.driver_hangs:
            with suppress(Exception):
                self.driver.close()
        self._set_disconnected(Connection.DISCONNECTED, self._next.fault)

    def _use(self, driver: Driver) -> None:
        if driver is self.driver:
            return
        # Nothing of the device before is shown from here on.
        self._next = _CONNECTING
        self._publish()
        self._history.clear()
        self._stops.restart()
        if not _is_same_machine(driver, self.driver):
            self._trust.confirm()  # another device vouches for itself
        self.driver, self._predecessor = driver, None
        self.executor = self._executor_of(driver)

    def _cycle(self) -> None:
        request = self._mailbox.take_connection_request()
        if request is not None:
            self._change_connection(request)
        if self._next.connection is not Connection.CONNECTED:
            return
        if (failure := self._stops.take_failure()) is not None:
            raise failure
        self._execute()
        self._take_samples()

    def _change_connection(self, request: ConnectionRequest) -> None:
        driver = request.driver
        is_other = driver is not self.driver
        if is_other:
            self._release_device()
        if not request.claim() or driver is None:
            return  # where another has claimed it, releasing took too long
        self._use(driver)
        self._connect()
        latched = self._gate.latched
        if is_other and latched is not None:
            self._publish()
            text = message("engine", "{stop} is still active with {name}; release it to move")
            self._emit(Alarmed(text.fill(stop=latched, name=driver.name)))

    def _connect(self) -> None:
        if self._next.connection is Connection.CONNECTED:
            return
        self._next = _CONNECTING
        self._publish()
        self._mailbox.clear()
        self._stops.take_failure()
        self.executor.forget()
        self._portions.restart()
        self.corrections.restart()
        self.models.prepare()
        self.driver.open()
        self._gate.reconnected()
        self._history.clear()
        self.models.begin_anew()
        self._check_machine()
        self._trust.restart()
        self.deviation.restart()
        self._stirred = False
        model_id = self.models.model.id
        self._next = replace(self._next, connection=Connection.CONNECTED, model_id=model_id)

    def _execute(self) -> None:
        while (posted := self._mailbox.take()) is not None:
            self._stirred |= isinstance(posted.command, _STIRRING)
            if isinstance(posted.command, Play):
                self.notes.begin(shown=posted.command.shown)
            rests, stop_s = self._next.activity is DeviceState.IDLE, self._stops.asked_s
            try:
                self.executor.do(posted.command, posted.permit)
                if rests and isinstance(posted.command, _STIRRING) and posted.permit.valid:
                    self._stops.over(stop_s)
                if isinstance(posted.command, ClearFault) and posted.permit.valid:
                    self.models.restart()
                    self._next = replace(self._next, fault=None)
            except (InputError, StateError) as error:
                self._emit(CommandRefused(str(error)))
            if isinstance(posted.command, Play) and self.executor.recorder is None:
                self._emit(_never_began(posted.command))
        try:
            self.executor.go_on()
        except (InputError, StateError) as error:
            self._emit(CommandRefused(str(error)))

    def _take_samples(self) -> None:
        read = self.corrections.corrected(self.driver.read())
        samples = self.inverses.wanted(read, self.driver.status)
        now_s = self._clock()
        self._portions.add(samples, now_s)
        self._next = self._stops.confirmed(self._next, now_s, lambda: self.driver.stop_pending)
        if self._portions.idle:
            return
        status = self.driver.status()
        news = status.state is not self._next.activity and not self.executor.between_segments
        if self._portions.due(news=news):
            self._work_up(self._portions.take(now_s, len(self.driver.axes)), status)

    def _work_up(self, samples: Samples, status: DeviceStatus) -> None:
        found = self._supervised(samples, status)
        answers = self.models.follow(samples)
        self.deviation.follow(samples, answers.nominal)
        self._history.append(samples, answers.in_use, answers.nominal, answers.doubt)
        self._next = self._updated(samples, answers, status)
        self._next = self._stops.followed(self._next, status.state)
        self._note_rest(status)
        faulted = status.state is DeviceState.FAULT and self.state.fault != self._next.fault
        self.notes.add(*(one.message for one in found if isinstance(one, Faulted)))
        if faulted:
            self.notes.add(self._next.fault or "")
            self._mailbox.clear()
            self.executor.forget()
        # Published before events tell of it: a subscriber may answer with the next command.
        self._publish()
        self._stirred = False
        if len(samples):
            self._tell(samples, answers)
        if self.executor.recorder is not None:
            self.executor.recorder.add(samples, answers, self.models.memory.number)
            if status.state is not DeviceState.PLAYING:
                self._end_recording(completed=True)
        if faulted:
            self._emit(Faulted(self._next.fault or ""))
        for event in found:
            self._emit(event)

    def _supervised(self, samples: Samples, status: DeviceStatus) -> list[Event]:
        """Stop and lock motion where an axis is not where it was sent; return what to tell."""
        if not status.position_known or status.state is DeviceState.HOMING:
            self._trust.restart()
            return []
        lock, alarms = self._trust.judge(samples)
        found: list[Event] = [Alarmed(alarm) for alarm in alarms]
        if lock is not None:
            self._gate.stop()
            self._mailbox.clear()
            self.executor.forget()
            self.driver.halt()
            found.append(Faulted(message("engine", "stopped: {lock}").fill(lock=lock)))
            if off := self.inverses.forget():
                found.append(Alarmed(_TAKEN_OFF.fill(axes=joined(map(AxisName, off), ", "))))
        return found

    def _note_rest(self, status: DeviceStatus) -> None:
        """Free the axes when nothing moves and nobody waits."""
        if (
            status.state in (DeviceState.IDLE, DeviceState.FAULT)
            and not self.executor.between_segments
        ):
            self.executor.rested()
            self.ownership.release(lambda: len(self._mailbox) > 0)

    def _updated(
        self, samples: Samples, answers: ModelOutputs, status: DeviceStatus
    ) -> SessionState:
        if self._next.activity is DeviceState.HOMING and status.state is DeviceState.IDLE:
            self._trust.homed(self.executor.sought - set(status.unhomed))
        driver = self.driver
        between_segments = self.executor.between_segments
        state = with_status(self._next, driver, status, between_segments=between_segments)
        state = replace(state, link=self._link(), model_id=self.models.model.id)
        unsettled, received_s = self.models.unsettled, self._portions.received_s
        state = with_samples(state, driver.axes, samples, answers, unsettled, received_s)
        known = status.position_known and state.sample_host_time_s is not None
        state = replace(state, position_known=known, doubt=self._trust.reason)
        if state.activity is not DeviceState.IDLE:
            state = replace(state, moved_s=self._clock())
        return replace(state, locked=lock_reason(state))

    def _link(self) -> LinkQuality | None:
        driver = self.driver
        if not isinstance(driver, Linked):
            return None
        quality = driver.link_quality()
        self.latency.add(quality.stop_s)
        return quality

    def _lost_axes(self) -> Sequence[str]:
        """Return the axes that may be elsewhere after a lost connection."""
        driver = self.driver
        return driver.homing_axes if isinstance(driver, Homer) else driver.axes

    def _executor_of(self, driver: Driver) -> Executor:
        return Executor(
            driver,
            self._clock,
            self.corrections,
            self.inverses,
            lambda: self.notes.metadata(self.driver, self.models.model),
        )

    def _end_recording(self, *, completed: bool) -> None:
        recorder, self.executor.recorder = self.executor.recorder, None
        if recorder is not None:
            self._emit(self.notes.finished(recorder, self.models.model, completed=completed))

    def _fail(self, message: str, *, link_lost: bool) -> None:
        """Lock motion; only an explicit reconnection ends this."""
        self.notes.add(message)
        was_connected = self._next.connection is Connection.CONNECTED
        self._next = replace(self._next, link_lost=link_lost and was_connected)
        self._let_go()
        with suppress(Exception):
            self.driver.close()
        self._set_disconnected(Connection.FAILED, message)
        self._publish()
        self._end_recording(completed=False)
        self._emit(Faulted(message))

    def _set_disconnected(self, connection: Connection, fault: str | None) -> None:
        self.inverses.restart()
        self._next = replace(
            self._next,
            connection=connection,
            activity=DeviceState.CLOSED,
            position_known=False,
            fault=fault,
            silent_s=0.0,
            stopping=False,
            doubt=self._trust.reason,
        )
        self._next = replace(self._next, locked=lock_reason(self._next))

    def _publish(self) -> None:
        before, self.state = self.state, self._next
        if before is not self.state and _told(before) != _told(self.state):
            self._emit(StateChanged(self.state))


_TAKEN_OFF = message(
    "engine", "the inverse of axis {axes} is off: the axis receives its targets as commands"
)
_CONNECTING = SessionState(
    connection=Connection.CONNECTING, locked=message("engine", "connecting; wait")
)
_STIRRING = (Move, Drive, Play, Home, RunProfile, SetVoltage)


def _ignore(*_: object) -> None:
    """Tell nobody."""


def _is_same_machine(driver: Driver, other: Driver) -> bool:
    """Return whether two drivers reach the same machine, which stays where it is meanwhile."""
    is_computed = driver.built_in_kind is MachineKind.SIMULATED  # each begins anew
    same = type(driver) is type(other) and driver.settings == other.settings
    return same and not is_computed


def _told(state: SessionState) -> tuple[object, ...]:
    """Return what of a state is worth an event; positions are read from the history instead."""
    return (state.phase, state.activity, state.fault, state.locked, state.position_known)


def _never_began(play: Play) -> PlaybackFinished:
    """Return the end of a playback of which the device has played nothing."""
    return PlaybackFinished(None, completed=False, shown=play.shown)


def _described(error: Exception) -> str:
    if isinstance(error, DriverError | InputError):
        return str(error)
    return message("engine", "unexpected {name} from the driver: {error}").fill(
        name=type(error).__name__, error=reason_of(error)
    )
