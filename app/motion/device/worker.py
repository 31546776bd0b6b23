"""The worker of a session, the only object that calls the driver, except for ``stop``.

The worker has no timer. :meth:`SessionWorker.run_once` executes one cycle. The session's thread
calls it, or a test without a thread.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device.device_report import with_samples, with_status
from rotemina.app.motion.device.executor import CommandExecutor
from rotemina.app.motion.device.held_inverses import HostInverses
from rotemina.app.motion.device.mailbox import (
    ClearFaultCommand,
    ConnectionRequest,
    HomeCommand,
    Mailbox,
    MoveCommand,
    PlayCommand,
    RunProfileCommand,
    VelocityCommand,
    VoltageCommand,
)
from rotemina.app.motion.device.ownership import AxisOwnership
from rotemina.app.motion.device.position_trust import CONNECTION_LOST, PositionTrust
from rotemina.app.motion.device.recent_deviation import ReadingDeviation
from rotemina.app.motion.device.recent_history import LiveHistory
from rotemina.app.motion.device.sample_portions import SampleBatches
from rotemina.app.motion.device.sensor_corrections import SensorCorrections
from rotemina.app.motion.device.stop_progress import StopTracking
from rotemina.app.motion.model import (
    MachineIdentity,
    ModelInUse,
    ModelOutputs,
    PreparedModel,
    SessionModels,
)
from rotemina.app.motion.state import (
    NOT_CONNECTED,
    AlarmRaised,
    CommandRefused,
    ConnectionState,
    FaultRaised,
    ModelChanged,
    PlaybackFinished,
    PlaybackNotes,
    SessionEvent,
    SessionState,
    StateChanged,
    StopLatency,
    StopRequest,
    StopRequested,
    find_lock_reason,
)
from rotemina.drivers.abilities import AxisHomer, LinkReporter
from rotemina.drivers.contract import (
    Clock,
    DeviceResetError,
    DeviceSamples,
    DeviceState,
    DeviceStatus,
    Driver,
    DriverError,
    Gate,
    LinkQuality,
    MachineKind,
    StateError,
)
from rotemina.sim.errors import InputError, describe_exception
from rotemina.sim.messages import AxisName, join_messages, message

#: Called with samples and the outputs of the models for these samples.
SampleCallback = Callable[[DeviceSamples, ModelOutputs], None]


class SessionWorker:
    """Connects, executes queued commands, takes samples, records, and publishes ``state``.

    ``state`` is replaced as a whole, so any thread may read it.

    The device is read in every cycle, possibly every millisecond. Its samples are processed in
    batches, at the rate of a display. ``send_samples`` is called with each batch, and must not
    raise.
    """

    def __init__(
        self,
        driver: Driver,
        gate: Gate,
        mailbox: Mailbox,
        history: LiveHistory,
        clock: Clock,
        emit: Callable[[SessionEvent], None],
        send_samples: SampleCallback = lambda _, __: None,
    ) -> None:
        #: Corrects readings before anything else uses them.
        self.corrections = SensorCorrections(driver.axes)
        self.state = SessionState(lock_reason=NOT_CONNECTED)
        self.ownership = AxisOwnership()
        self.latency = StopLatency()
        #: The driver that is or was last open; replaced only on the thread of this worker.
        self.driver = driver
        self._gate = gate
        self._mailbox = mailbox
        self._history = history
        self._clock = clock
        self._emit = emit
        self._send_samples = send_samples
        self.models = SessionModels(driver)
        self._trust = PositionTrust(driver.robot)
        #: Deviation of readings from commands, which checks of the tip take into account.
        self.deviation = ReadingDeviation(driver.robot)
        self.notes = PlaybackNotes()
        #: Inverses that the host applies, because the device cannot.
        self.inverses = HostInverses(driver.robot)
        #: Executor for the current driver. Any thread may read its targets and speeds.
        self.executor = self._make_executor(driver)
        self._next_state = self.state
        self._batches = SampleBatches()
        # Whether a motion was passed to the driver since the latest samples.
        self._has_started_motion = False
        self._stops = StopTracking(clock)
        #: Whether another worker has replaced this one, because it hangs in its driver.
        self.is_retired = False
        #: Whether the worker has ended and released its driver.
        self.has_ended = False
        self._predecessor: SessionWorker | None = None

    @property
    def is_resting_since_stop(self) -> bool:
        """Whether the device has reported no motion since it came to rest after the last stop."""
        return self._stops.is_resting

    @property
    def at_rest(self) -> bool:
        """Whether no axis moves, no command waits, and none was started since the last samples."""
        is_idle = self.state.activity is DeviceState.IDLE
        return is_idle and not self._mailbox.is_busy and not self._has_started_motion

    @property
    def driver_hangs(self) -> bool:
        """Whether an earlier worker still hangs in the driver, so that it cannot be called."""
        predecessor = self._predecessor
        if predecessor is None:
            return False
        return not predecessor.has_ended or predecessor.driver_hangs

    def make_successor(self) -> "SessionWorker":
        """Return a worker that replaces this one, which hangs in its driver.

        Another thread calls this. When the driver call returns, this worker no longer changes the
        state of the session, and its gate refuses its commands.
        """
        # If this worker does not hang after all, it may end the recording at the same moment.
        with suppress(Exception):
            self._end_recording(completed=False)
        successor = SessionWorker(
            self.driver,
            self._gate,
            self._mailbox,
            self._history,
            self._clock,
            self._emit,
            self._send_samples,
        )
        if self._next_state.connection is ConnectionState.CONNECTED:
            self._trust.doubt(CONNECTION_LOST, self._find_lost_axes())
        successor.corrections, successor.ownership, successor.latency = (
            self.corrections,
            self.ownership,
            self.latency,
        )
        successor.models, successor.notes, successor._trust = self.models, self.notes, self._trust
        successor.executor = successor._make_executor(self.driver)
        successor._stops, successor.state, successor._predecessor = self._stops, self.state, self
        successor._set_disconnected(ConnectionState.DISCONNECTED, None)
        self._retire()
        return successor

    def _retire(self) -> None:
        """Replace all objects that this worker shares with the session by new ones."""
        self.is_retired = True
        gate = Gate(self._clock)
        gate.stop(latch=message("engine", "another device is connected"))
        self.driver.gate = self._gate = gate
        self._mailbox = Mailbox(1)
        self._emit = self._send_samples = _ignore
        self._history = LiveHistory(self.driver.axes, seconds=1.0, rate_hz=1.0)
        self.corrections = SensorCorrections(self.driver.axes)
        self.ownership, self.latency = AxisOwnership(), StopLatency()
        self.models, self.notes = SessionModels(self.driver), PlaybackNotes()
        self._trust = PositionTrust(self.driver.robot)
        self._stops = StopTracking(self._clock)

    def note_stop(
        self, host_time_s: float, failure: Exception | None, request: StopRequest
    ) -> None:
        """Take note that a stop was passed to the device, or that this failed. Thread-safe."""
        self.executor.forget()
        self._stops.note(host_time_s, failure, request)
        self._mailbox.wake_event.set()

    def run_once(self) -> None:
        """Execute one cycle. An exception of the driver is not raised, but leads to a failure."""
        for request in self._stops.take_unreported():
            self._emit(StopRequested(request))
        # A playback that was dropped from the queue also needs an event that ends it.
        for play in self._mailbox.take_dropped_plays():
            self._emit(_make_unplayed_event(play))
        try:
            self._cycle()
        except Exception as error:
            # A driver may raise any exception. Motion must then be locked and the reason shown.
            if self._next_state.connection is ConnectionState.CONNECTED:
                self._trust.doubt(CONNECTION_LOST, self._find_lost_axes())
            is_lost = isinstance(error, ConnectionError | TimeoutError)
            self._fail(
                _describe_error(error),
                link_lost=is_lost and not isinstance(error, DeviceResetError),
            )
        self._publish()

    def use_model(self, prepared: PreparedModel) -> None:
        """Use another model from now on. Call this only on the worker's thread.

        Raises
        ------
        RequestRefusedError
            If the machine is moving, or the model belongs to another machine.
        """
        if self.driver.status().state is not DeviceState.IDLE or self.executor.recorder:
            raise RequestRefusedError("the machine is still moving; change the model at rest")
        difference = prepared.model.machine.find_difference(MachineIdentity.of(self.driver))
        if difference is not None:
            raise RequestRefusedError(
                "the model belongs to another machine: {why}; diagnose this one", why=difference
            )
        self.models.use_model(prepared)
        self._announce_model()

    def _check_machine(self) -> None:
        """Return to the nominal model if the model in use belongs to another machine."""
        model, machine = self.models.model, MachineIdentity.of(self.driver)
        difference = model.machine.find_difference(machine)
        if difference is not None:
            nominal = ModelInUse.make_nominal(self.driver)
            self.models.use_model(PreparedModel(nominal, ()))
            self._announce_model(difference if model.is_corrected else "")

    def _announce_model(self, reason: str = "") -> None:
        """Restart the gap in the history, and report that another model is in use."""
        self._history.restart_gap()
        self._next_state = replace(self._next_state, model_id=self.models.model.id)
        self._publish()
        self._emit(ModelChanged(self.models.model, reason))

    def confirm_position(self) -> None:
        """Trust the position again after a confirmation. Call this only on the worker's thread."""
        self._trust.confirm()

    def shut_down(self) -> None:
        """Stop and release the device."""
        self._release_device()
        self._publish()
        self.has_ended = True

    def _drop_requests_and_stop(self) -> None:
        self._gate.start_connection()
        self._mailbox.clear()
        self.executor.forget()
        self.ownership.free_axes()
        if not self.driver_hangs:
            # The connection may be lost already.
            with suppress(Exception):
                self.driver.stop()

    def _release_device(self) -> None:
        self._drop_requests_and_stop()
        self._end_recording(completed=False)
        if not self.driver_hangs:
            with suppress(Exception):
                self.driver.close()
        self._set_disconnected(ConnectionState.DISCONNECTED, self._next_state.fault)

    def _use_driver(self, driver: Driver) -> None:
        if driver is self.driver:
            return
        # From now on, nothing of the previous device must be shown.
        self._next_state = _CONNECTING
        self._publish()
        self._history.clear()
        self._stops.restart()
        if not _is_same_machine(driver, self.driver):
            # Doubts about the previous machine do not apply to another one.
            self._trust.confirm()
        self.driver, self._predecessor = driver, None
        self.executor = self._make_executor(driver)

    def _cycle(self) -> None:
        request = self._mailbox.take_connection_request()
        if request is not None:
            self._change_connection(request)
        if self._next_state.connection is not ConnectionState.CONNECTED:
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
            # Another worker claims the request if releasing the device takes too long here.
            return
        self._use_driver(driver)
        self._connect()
        latch_reason = self._gate.latch_reason
        if is_other and latch_reason is not None:
            self._publish()
            alarm = message("engine", "{stop} is still active with {name}; release it to move")
            self._emit(AlarmRaised(alarm.fill(stop=latch_reason, name=driver.name)))

    def _connect(self) -> None:
        if self._next_state.connection is ConnectionState.CONNECTED:
            return
        self._next_state = _CONNECTING
        self._publish()
        # Requests, failures and readings from before the connection no longer apply.
        self._mailbox.clear()
        self._stops.take_failure()
        self.executor.forget()
        self._batches.restart()
        self.corrections.restart()
        self.models.prepare()
        self.driver.open()
        self._gate.start_connection()
        self._history.clear()
        self.models.begin_connection()
        self._check_machine()
        self._trust.restart()
        self.deviation.restart()
        self._has_started_motion = False
        model_id = self.models.model.id
        self._next_state = replace(
            self._next_state, connection=ConnectionState.CONNECTED, model_id=model_id
        )

    def _execute(self) -> None:
        while (queued := self._mailbox.take_command()) is not None:
            self._has_started_motion |= isinstance(queued.command, _MOTION_COMMANDS)
            if isinstance(queued.command, PlayCommand):
                self.notes.begin(shown=queued.command.shown)
            was_at_rest, stop_s = (
                self._next_state.activity is DeviceState.IDLE,
                self._stops.requested_s,
            )
            try:
                self.executor.execute(queued.command, queued.permit)
                if (
                    was_at_rest
                    and isinstance(queued.command, _MOTION_COMMANDS)
                    and queued.permit.is_valid
                ):
                    self._stops.note_rest_before(stop_s)
                if isinstance(queued.command, ClearFaultCommand) and queued.permit.is_valid:
                    self.models.restart()
                    self._next_state = replace(self._next_state, fault=None)
            except (InputError, StateError) as error:
                self._emit(CommandRefused(str(error)))
            if isinstance(queued.command, PlayCommand) and self.executor.recorder is None:
                self._emit(_make_unplayed_event(queued.command))
        try:
            self.executor.continue_move()
        except (InputError, StateError) as error:
            self._emit(CommandRefused(str(error)))

    def _take_samples(self) -> None:
        corrected = self.corrections.correct(self.driver.read())
        samples = self.inverses.convert_samples(corrected, self.driver.status)
        now_s = self._clock()
        self._batches.add(samples, now_s)
        self._next_state = self._stops.with_confirmation(
            self._next_state, now_s, lambda: self.driver.stop_pending
        )
        if self._batches.is_idle:
            return
        status = self.driver.status()
        is_new_state = (
            status.state is not self._next_state.activity and not self.executor.between_segments
        )
        if self._batches.is_due(urgent=is_new_state):
            self._process_batch(self._batches.take(now_s, len(self.driver.axes)), status)

    def _process_batch(self, samples: DeviceSamples, status: DeviceStatus) -> None:
        events = self._check_positions(samples, status)
        model_outputs = self.models.follow(samples)
        self.deviation.follow(samples, model_outputs.nominal)
        self._history.append(
            samples, model_outputs.in_use, model_outputs.nominal, model_outputs.doubt
        )
        self._next_state = self._make_state(samples, model_outputs, status)
        self._next_state = self._stops.with_progress(self._next_state, status.state)
        self._free_axes_at_rest(status)
        has_new_fault = (
            status.state is DeviceState.FAULT and self.state.fault != self._next_state.fault
        )
        self.notes.add(*(event.message for event in events if isinstance(event, FaultRaised)))
        if has_new_fault:
            self.notes.add(self._next_state.fault or "")
            self._mailbox.clear()
            self.executor.forget()
        # Publish before emitting events, because a subscriber may react with the next command.
        self._publish()
        self._has_started_motion = False
        if len(samples):
            self._send_samples(samples, model_outputs)
        if self.executor.recorder is not None:
            self.executor.recorder.add(samples, model_outputs, self.models.memory.number)
            if status.state is not DeviceState.PLAYING:
                self._end_recording(completed=True)
        if has_new_fault:
            self._emit(FaultRaised(self._next_state.fault or ""))
        for event in events:
            self._emit(event)

    def _check_positions(self, samples: DeviceSamples, status: DeviceStatus) -> list[SessionEvent]:
        """Stop and lock motion if an axis is not where it should be. Return events to report."""
        if not status.position_known or status.state is DeviceState.HOMING:
            self._trust.restart()
            return []
        lock_reason, alarms = self._trust.judge(samples)
        events: list[SessionEvent] = [AlarmRaised(alarm) for alarm in alarms]
        if lock_reason is not None:
            # As after a stop by the operator, no earlier request may pass any more.
            self._gate.stop()
            self._mailbox.clear()
            self.executor.forget()
            self.driver.halt()
            events.append(FaultRaised(message("engine", "stopped: {lock}").fill(lock=lock_reason)))
            if axes := self.inverses.forget():
                events.append(
                    AlarmRaised(_INVERSE_OFF.fill(axes=join_messages(map(AxisName, axes), ", ")))
                )
        return events

    def _free_axes_at_rest(self, status: DeviceStatus) -> None:
        if (
            status.state in (DeviceState.IDLE, DeviceState.FAULT)
            and not self.executor.between_segments
        ):
            self.executor.note_rest()
            self.ownership.free_axes(lambda: len(self._mailbox) > 0)

    def _make_state(
        self, samples: DeviceSamples, model_outputs: ModelOutputs, status: DeviceStatus
    ) -> SessionState:
        if self._next_state.activity is DeviceState.HOMING and status.state is DeviceState.IDLE:
            self._trust.trust_homed_axes(self.executor.homed_axes - set(status.unhomed))
        driver = self.driver
        between_segments = self.executor.between_segments
        state = with_status(self._next_state, driver, status, between_segments=between_segments)
        state = replace(state, link=self._read_link_quality(), model_id=self.models.model.id)
        unsettled_axes, host_time_s = self.models.unsettled_axes, self._batches.received_s
        state = with_samples(
            state, driver.axes, samples, model_outputs, unsettled_axes, host_time_s
        )
        is_position_known = status.position_known and state.sample_host_time_s is not None
        state = replace(state, position_known=is_position_known, doubt=self._trust.reason)
        if state.activity is not DeviceState.IDLE:
            state = replace(state, last_motion_s=self._clock())
        return replace(state, lock_reason=find_lock_reason(state))

    def _read_link_quality(self) -> LinkQuality | None:
        driver = self.driver
        if not isinstance(driver, LinkReporter):
            return None
        quality = driver.link_quality()
        self.latency.add(quality.stop_s)
        return quality

    def _find_lost_axes(self) -> Sequence[str]:
        """Return the axes whose position may be wrong after a lost connection."""
        driver = self.driver
        return driver.homing_axes if isinstance(driver, AxisHomer) else driver.axes

    def _make_executor(self, driver: Driver) -> CommandExecutor:
        return CommandExecutor(
            driver,
            self._clock,
            self.corrections,
            self.inverses,
            lambda: self.notes.make_metadata(self.driver, self.models.model),
        )

    def _end_recording(self, *, completed: bool) -> None:
        recorder, self.executor.recorder = self.executor.recorder, None
        if recorder is not None:
            self._emit(self.notes.finish(recorder, self.models.model, completed=completed))

    def _fail(self, message: str, *, link_lost: bool) -> None:
        """Lock motion until an explicit reconnection."""
        self.notes.add(message)
        was_connected = self._next_state.connection is ConnectionState.CONNECTED
        self._next_state = replace(self._next_state, link_lost=link_lost and was_connected)
        self._drop_requests_and_stop()
        with suppress(Exception):
            self.driver.close()
        self._set_disconnected(ConnectionState.FAILED, message)
        self._publish()
        self._end_recording(completed=False)
        self._emit(FaultRaised(message))

    def _set_disconnected(self, connection: ConnectionState, fault: str | None) -> None:
        self.inverses.restart()
        self._next_state = replace(
            self._next_state,
            connection=connection,
            activity=DeviceState.CLOSED,
            position_known=False,
            fault=fault,
            silent_s=0.0,
            stopping=False,
            doubt=self._trust.reason,
        )
        self._next_state = replace(self._next_state, lock_reason=find_lock_reason(self._next_state))

    def _publish(self) -> None:
        previous, self.state = self.state, self._next_state
        if previous is not self.state and _select_event_fields(previous) != _select_event_fields(
            self.state
        ):
            self._emit(StateChanged(self.state))


_INVERSE_OFF = message(
    "engine", "the inverse of axis {axes} is off: the axis receives its targets as commands"
)
_CONNECTING = SessionState(
    connection=ConnectionState.CONNECTING, lock_reason=message("engine", "connecting; wait")
)
_MOTION_COMMANDS = (
    MoveCommand,
    VelocityCommand,
    PlayCommand,
    HomeCommand,
    RunProfileCommand,
    VoltageCommand,
)


def _ignore(*_: object) -> None:
    pass


def _is_same_machine(driver: Driver, other: Driver) -> bool:
    # Each simulator starts from its own initial position.
    is_simulated = driver.built_in_kind is MachineKind.SIMULATED
    has_same_settings = type(driver) is type(other) and driver.settings == other.settings
    return has_same_settings and not is_simulated


def _select_event_fields(state: SessionState) -> tuple[object, ...]:
    """Return the fields of a state whose change causes an event.

    Positions are not included, because displays read them from the history.
    """
    return (state.phase, state.activity, state.fault, state.lock_reason, state.position_known)


def _make_unplayed_event(play: PlayCommand) -> PlaybackFinished:
    return PlaybackFinished(None, completed=False, shown=play.shown)


def _describe_error(error: Exception) -> str:
    if isinstance(error, DriverError | InputError):
        return str(error)
    return message("engine", "unexpected {name} from the driver: {error}").fill(
        name=type(error).__name__, error=describe_exception(error)
    )
