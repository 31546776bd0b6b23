"""Motion session, the only interface through which a program moves a machine."""

import threading
import time
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device import (
    ConnectionRequest,
    DeviceLink,
    LiveHistory,
    SensorCorrections,
    SessionSubscribers,
    SessionWorker,
)
from rotemina.app.motion.limits import Guard
from rotemina.app.motion.model import CommandMemory, ModelInUse, PreparedModel
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.app.motion.session.backlash import BacklashCompensation
from rotemina.app.motion.session.captures import CaptureRequests
from rotemina.app.motion.session.compensation import AxisInverses
from rotemina.app.motion.session.device_service import DeviceService
from rotemina.app.motion.session.heartbeat import MAX_PAUSE_S, Heartbeat, PauseWatch
from rotemina.app.motion.session.motion_requests import MotionRequests
from rotemina.app.motion.session.narrowed_ranges import NarrowedRanges
from rotemina.app.motion.session.profile_execution import ProfileRequests
from rotemina.app.motion.session.regulation import FeedbackLoops
from rotemina.app.motion.session.reservations import AxisReservations
from rotemina.app.motion.session.routing import MoveRouting
from rotemina.app.motion.session.tip_bounds import TipBounds
from rotemina.app.motion.session.tool import ToolSwitch
from rotemina.app.motion.session.undo import UndoHistory
from rotemina.app.motion.state import (
    PROGRAM,
    STOP_AND_LOCK_REASON,
    ConnectionState,
    RunLabels,
    SessionState,
    StopRequest,
)
from rotemina.drivers.contract import (
    Clock,
    DeviceState,
    Driver,
    GateEpoch,
    Permit,
    PermitPurpose,
)
from rotemina.sim.messages import format_rounded, message

#: A device that takes longer to be released, or to open, is abandoned when another is requested.
MAX_RELEASE_S = 3.0
_MOVING_STATES = (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING)


class MotionSession:
    """Owns a driver: only one worker thread calls it, and only a stop bypasses that thread.

    Every motion passes through here, so every motion respects ranges, the bounds of the tip, and
    owners. A request is checked on the caller's thread. It is either refused at once with the
    reason (:class:`rotemina.sim.errors.InputError`), or queued for the worker. :meth:`snapshot`,
    ``history`` and events show what the device does. After a failure nothing moves until
    :meth:`reconnect`.

    The session itself connects, stops and reports. Its attributes handle all other requests. The
    frequently used methods of :class:`MotionRequests` and :class:`SessionSubscribers` are also
    methods of the session: ``go_to``, ``jog``, ``move_by``, ``move_velocity``, ``go_safely``,
    ``home``, ``undo``, ``play``, ``check_play``, ``tip_path``, ``set_voltage``, ``subscribe`` and
    ``tap``.

    Parameters
    ----------
    driver : Driver
    history : LiveHistory, optional
        Receives the samples; by default it holds one minute.
    clock : callable, optional
        The host's time, s; by default the driver's clock.
    period_s : float, optional
        Period at which the worker reads the device when nothing wakes it; by default the driver's.
    queue_size : int
        Largest number of waiting commands.
    stale_after_s : float
        Motion is refused when the latest sample is older than this.
    max_release_s : float
        Longest time that a device may take to finish a call before it is released or replaced.
        After this time the device is abandoned, and a new thread continues without it.
    local_time : callable
        Returns the local time, for texts.

    Attributes
    ----------
    inverses : AxisInverses
        Inverses of piezo axes.
    loops : FeedbackLoops
        Feedback loops around axes.
    bounds : TipBounds
        The keep-out zone and the taught floor.
    backlash : BacklashCompensation
        One-sided approaches of stepper axes.
    ranges : NarrowedRanges
        Ranges of axes, narrowed within those of the robot file.
    reservations : AxisReservations
        Exclusive reservation of all axes.
    profiles : ProfileRequests
        Profiles that the device runs by itself.
    captures : CaptureRequests
        Samples at a high rate.
    tool : ToolSwitch
        The tool at the tip.
    service : DeviceService
        Parameters, display, faults, effects.
    """

    def __init__(
        self,
        driver: Driver,
        *,
        history: LiveHistory | None = None,
        clock: Clock | None = None,
        period_s: float | None = None,
        queue_size: int = 16,
        stale_after_s: float = 1.0,
        max_release_s: float = MAX_RELEASE_S,
        local_time: Callable[[], datetime] = datetime.now,
    ) -> None:
        clock = clock if clock is not None else driver.clock
        self.robot = driver.robot
        self.history = history if history is not None else LiveHistory(driver.axes)
        subscribers = SessionSubscribers()
        link = DeviceLink(
            driver,
            self.history,
            subscribers,
            clock=clock,
            queue_size=queue_size,
            stale_after_s=stale_after_s,
        )
        guard = Guard(driver.robot)
        admission = RequestAdmission(link, guard, UndoHistory(driver.robot))
        self.inverses = AxisInverses(link, admission)
        self.loops = FeedbackLoops(link, admission)
        self.bounds = TipBounds(link, admission, guard)
        self.ranges = NarrowedRanges(link, admission, guard)
        self.reservations = AxisReservations(link, admission)
        self.profiles = ProfileRequests(link, admission, guard, self.inverses, self.reservations)
        self.captures = CaptureRequests(link)
        self.tool = ToolSwitch(link, admission)
        self.service = DeviceService(link)
        self.backlash = BacklashCompensation(link, admission, self.ranges)
        routing = MoveRouting(link, admission, guard, self.backlash)
        moves = MotionRequests(link, admission, guard, self.inverses, self.loops, routing)
        self.go_to, self.jog, self.move_by = moves.go_to, moves.jog, moves.move_by
        self.move_velocity = moves.move_velocity
        self.go_safely, self.home, self.undo = moves.go_safely, moves.home, moves.undo
        self.play, self.set_voltage = moves.play, moves.set_voltage
        self.check_play, self.tip_path = moves.check_play, moves.tip_path
        self.subscribe, self.tap = subscribers.subscribe, subscribers.tap
        self._link, self._admission, self._moves = link, admission, moves
        self._subscribers = subscribers
        self._period_s = period_s if period_s is not None else driver.service_period_s
        self._max_release_s = max_release_s
        self._local_time = local_time
        self._thread: threading.Thread | None = None
        self._closing = threading.Event()
        self._pause_watch = PauseWatch(clock)
        #: Heartbeat of the thread that shows the session to an operator. Once it has begun to beat,
        #: motion stops if the beats cease.
        self.screen_heartbeat = Heartbeat(clock)
        #: Heartbeat of the worker.
        self.pulse = Heartbeat(clock)

    @property
    def driver(self) -> Driver:
        """The driver in use."""
        return self._link.driver

    @property
    def setpoint_period_s(self) -> float:
        """Period of the device's set-points, s. A dry run needs it."""
        return self._link.setpoint_period_s

    def start(self) -> None:
        """Connect to the device and communicate with it on a separate thread.

        Raises
        ------
        RequestRefusedError
            If the session has already been started.
        """
        if self._thread is not None:
            raise RequestRefusedError("the session has already been started; create a new one")
        self._link.connect()
        self._start_thread(self._link.worker)

    def close(self, timeout_s: float = 5.0) -> bool:
        """Stop, release the device and end the worker; safe to call twice.

        Returns
        -------
        bool
            Whether the worker ended in time. A worker that hangs in its device is abandoned.
        """
        self._closing.set()
        self._link.mailbox.wake_event.set()
        thread = self._thread
        if thread is None:
            self._link.worker.shut_down()
            return True
        if thread is not threading.current_thread():
            thread.join(timeout_s)
        return not thread.is_alive()

    def connect(self) -> None:
        """Ask the worker to connect. For programs that call :meth:`run_once` themselves."""
        self._watch_request(self._link.connect())

    def reconnect(self) -> None:
        """Connect again after a failure; this never happens automatically.

        Raises
        ------
        RequestRefusedError
            If the session is connected, or an earlier call still hangs in the driver.
        """
        connection = self._link.snapshot().connection
        if connection is ConnectionState.CONNECTING:
            raise RequestRefusedError("the device is being connected; wait")
        if connection is ConnectionState.CONNECTED:
            raise RequestRefusedError("the device is connected")
        if self._link.worker.driver_hangs:
            raise RequestRefusedError(
                "{name} still hangs in an earlier call; choose Connect on the panel "
                "Connection to open it again, or choose another device",
                name=self.driver.name,
            )
        self._watch_request(self._link.connect())

    def disconnect(self) -> None:
        """Stop, and release the device, which holds its position."""
        self.stop(message("engine", "the device is being released"))
        self._watch_request(self._link.disconnect())

    def use_driver(self, driver: Driver) -> None:
        """Stop, release the device, and connect to another one.

        Inverses, loops, one-sided approaches and the undo history are dropped. A latched stop stays
        latched. This never waits: a device that hangs is abandoned after ``max_release_s``.

        Raises
        ------
        RequestRefusedError
            If the other driver is for another robot.
        """
        if tuple(driver.axes) != tuple(self.driver.axes):
            raise RequestRefusedError(
                "driver {name} is for a robot with axes {axes}; this one has "
                "{these}; start the program with that robot",
                name=repr(driver.name),
                axes=", ".join(driver.axes),
                these=", ".join(self.driver.axes),
            )
        self.stop(message("engine", "another device is being connected"))
        self._period_s = driver.service_period_s
        self._watch_request(self._link.exchange_driver(driver))
        self.inverses.forget()
        self.loops.forget()
        self.backlash.clear()
        with self._admission.lock:
            self._admission.undo_history.forget()

    def run_once(self) -> None:
        """Execute one cycle of the worker, if no thread was started."""
        self._step(self._link.worker)

    def _step(self, worker: SessionWorker) -> None:
        self.pulse.beat()
        self._stop_after_pause()
        state = worker.state
        is_moving = state.activity in _MOVING_STATES and not state.stopping
        # A motion continues only while the operator can see it in the window.
        if is_moving and self.screen_heartbeat.is_silent:
            self.stop(message("engine", "the window does not respond"))
        worker.run_once()
        if worker.state.connection is not state.connection:
            # Connecting may take long, but does not count as a pause.
            self._pause_watch.restart()

    def _stop_after_pause(self) -> None:
        """Stop, and drop all requests, if this program did not run for a while."""
        paused_s = self._pause_watch.measure_pause()
        # The caller of a stepped simulation decides how far it advances, so a jump of its clock
        # does not count as a pause.
        is_simulation = self._thread is None and self.driver.virtual_time
        is_connected = self._link.worker.state.connection is ConnectionState.CONNECTED
        if paused_s > MAX_PAUSE_S and is_connected and not is_simulation:
            self.stop(
                message(
                    "engine",
                    "this program did not run for {paused} s (computer asleep or overloaded); "
                    "check the machine, then move again",
                ).fill(paused=format_rounded(paused_s, 2))
            )

    def confirm_position(self) -> None:
        """Trust the position again, for example after a lost connection.

        Call this only after someone has looked at the machine. A stop that comes before the worker
        executes the request cancels it.

        Raises
        ------
        RequestRefusedError
            If the session is not connected.
        """

        def confirm(_: Driver, permit: Permit) -> None:
            if permit.epoch == self._link.gate.epoch:
                self._link.worker.confirm_position()

        self._link.queue_driver_call(confirm)

    def stop(self, why: str = "", *, by: str = PROGRAM) -> None:
        """Halt all axes now. Any thread may call this at any time; it never waits or raises.

        Queued commands are dropped. The calling thread itself halts the device. ``why`` is the
        reason. Pass ``ownership.OPERATOR`` as ``by`` only if a person requested the stop.
        """
        self._link.stop(StopRequest(by, why, self._local_time()))

    def emergency_stop(self, why: str = STOP_AND_LOCK_REASON, *, by: str = PROGRAM) -> None:
        """Stop, and lock motion until :meth:`release`. Thread-safe; never waits or raises."""
        self._link.stop(StopRequest(by, why, self._local_time()), latch=why)

    def release(self) -> None:
        """Permit motion again after an emergency stop; nothing moves before the next command."""
        self._link.gate.release()

    def bar_motion(self, reason: str | None) -> None:
        """Refuse all new motion for a reason; None ends this. Running motion continues."""
        self._link.bar_reason = reason

    def dismiss_stop(self) -> None:
        """Treat the latest stop as over, because the next motion is being prepared."""
        self._link.record_accepted_epoch(self._link.gate.epoch)

    @property
    def is_untouched_since_stop(self) -> bool:
        """Whether nothing has moved, and no motion was accepted, since the latest stop."""
        return self._link.is_untouched_since_stop

    @property
    def stop_requested_s(self) -> float | None:
        """Host time of the latest stop, by any requester; None before the first."""
        return self._link.stop_requested_s

    @property
    def epoch(self) -> GateEpoch:
        """Counts of stops, connections and releases so far. Any thread may read them."""
        return self._link.gate.epoch

    def permit(self, purpose: PermitPurpose = PermitPurpose.MOTION) -> Permit:
        """Return a permit for a plan of several requests, all of which the next stop cancels.

        Pass it to the requests as ``permit``. A request without a permit takes a new one before its
        first check.
        """
        return self._link.gate.permit(purpose)

    def snapshot(self) -> SessionState:
        """Return the current state. Thread-safe."""
        state = self._link.snapshot()
        return replace(state, tip=self.bounds.compute_tip(state))

    @property
    def reported(self) -> SessionState:
        """The latest report of the device, without age, locks and tip. Thread-safe.

        This is cheaper than :meth:`snapshot` if only command, activity or progress are needed.
        """
        return self._link.worker.state

    @property
    def at_rest(self) -> bool:
        """Whether no axis moves, no command waits, and none was executed since the last samples."""
        return self._link.worker.at_rest

    @property
    def can_undo(self) -> bool:
        """Whether there is a previous position to go back to."""
        return self._moves.can_undo

    @property
    def path_check_basis(self) -> tuple[object, ...]:
        """All values that a path check depends on; the check stays valid while they are equal."""
        return self._moves.path_check_basis

    @property
    def corrections(self) -> SensorCorrections:
        """The calibrations that are applied to readings. Thread-safe."""
        return self._link.worker.corrections

    @property
    def labels(self) -> RunLabels:
        """Run, operator and sample, stored in every playback and recording. Thread-safe."""
        return self._link.worker.notes.labels

    @labels.setter
    def labels(self, labels: RunLabels) -> None:
        self._link.worker.notes.labels = labels

    @property
    def model(self) -> ModelInUse:
        """The model used for predictions. Thread-safe."""
        return self._link.worker.models.model

    @property
    def memory(self) -> CommandMemory:
        """The commands to the machine since it was connected. Thread-safe."""
        return self._link.worker.models.memory

    def use_model(self, model: ModelInUse) -> None:
        """Use another model for predictions from now on; commands to the machine stay the same.

        The memory of the model is computed from the commands since the connection, which takes
        about a second. A window must therefore not call this from its own thread. An event reports
        when the model is in use.

        Raises
        ------
        RequestRefusedError
            If the machine is not at rest or not connected.
        EffectError
            If an effect of the model cannot be used.
        """
        if not self.at_rest:
            raise RequestRefusedError("the machine is still moving; change the model at rest")
        prepared = PreparedModel.of(model, self.memory)
        self._link.queue_driver_call(lambda _, __: self._link.worker.use_model(prepared))

    def note_contact(self, what: str) -> None:
        """Note a contact, since it may cause the effects found in the current motion."""
        self._link.worker.notes.add(what)

    def _watch_request(self, request: ConnectionRequest) -> None:
        """Let another thread execute a request if the current worker does not begin it in time."""
        if self._thread is None:
            return
        timer = threading.Timer(self._max_release_s, self._replace_hung_worker, (request,))
        timer.daemon = True
        timer.start()

    def _replace_hung_worker(self, request: ConnectionRequest) -> None:
        if self._closing.is_set():
            return
        worker = self._link.replace_hung_worker(request, self._max_release_s)
        if worker is not None:
            self._pause_watch.restart()
            self._start_thread(worker)

    def _start_thread(self, worker: SessionWorker) -> None:
        self._thread = threading.Thread(
            target=self._run, args=(worker,), name="motion session", daemon=True
        )
        self._thread.start()

    def _run(self, worker: SessionWorker) -> None:
        mailbox = self._link.mailbox
        next_s = time.monotonic()
        while not self._closing.is_set() and not worker.is_retired:
            self._step(worker)
            # Add the period to the planned time, so that one late cycle does not delay later ones.
            next_s = max(next_s + self._period_s, time.monotonic())
            mailbox.wake_event.wait(next_s - time.monotonic())
            mailbox.wake_event.clear()
        if not worker.is_retired:
            self.pulse.end()
        worker.shut_down()
