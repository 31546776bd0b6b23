"""A motion session: the only interface through which a program moves a machine."""

import threading
import time
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.backlash import Backlash
from rotemina.app.motion.captures import Captures
from rotemina.app.motion.command_memory import CommandMemory
from rotemina.app.motion.compensation import Inverses
from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.device_service import Service
from rotemina.app.motion.guard import Guard
from rotemina.app.motion.heartbeat import Heartbeat
from rotemina.app.motion.live_models import PreparedModel
from rotemina.app.motion.mailbox import ConnectionRequest, RefusedError
from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.motion.motion_requests import Moves
from rotemina.app.motion.narrowed_ranges import NarrowedRanges
from rotemina.app.motion.pause_watch import MAX_PAUSE_S, PauseWatch
from rotemina.app.motion.profile_execution import Profiles
from rotemina.app.motion.recent_history import LiveHistory
from rotemina.app.motion.regulation import Loops
from rotemina.app.motion.reservations import Reservations
from rotemina.app.motion.routing import Routing
from rotemina.app.motion.run_labels import RunLabels
from rotemina.app.motion.sensor_corrections import SensorCorrections
from rotemina.app.motion.state import Connection, SessionState
from rotemina.app.motion.stop import LOCKED, PROGRAM, StopRequest
from rotemina.app.motion.subscribers import Subscribers
from rotemina.app.motion.tip_bounds import TipBounds
from rotemina.app.motion.tool import Tool
from rotemina.app.motion.undo import Undo
from rotemina.app.motion.worker import Worker
from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import Epoch, Permit, Purpose
from rotemina.drivers.samples import DeviceState
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

#: How long a device may take to be released or to be opened when another one is wanted, s.
MAX_RELEASE_S = 3.0
_MOVES = (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING)


class MotionSession:
    """Owns a driver: only one worker thread talks to it, and only a stop bypasses that.

    Every motion passes through here: ranges, the tip's bounds and owners hold on every path. A
    request is checked on the caller's thread and refused at once with the reason
    (:class:`rotemina.sim.errors.InputError`), or queued for the worker. :meth:`snapshot`,
    ``history`` and events show the actions of the device. After a failure nothing moves until
    :meth:`reconnect`.

    The session connects, stops and reports; its parts do the rest. The frequently used ones of
    :class:`Moves` and :class:`Subscribers` are the session's own methods: ``go_to``, ``jog``,
    ``move_by``, ``move_velocity``, ``go_safely``, ``home``, ``undo``, ``play``, ``check_play``,
    ``tip_path``, ``set_voltage``, ``subscribe`` and ``tap``.

    Parameters
    ----------
    driver : Driver
    history : LiveHistory, optional
        Where samples go; a minute's worth by default.
    clock : callable, optional
        The host's time, s; the driver's by default.
    period_s : float, optional
        How often the worker reads the device when nothing else calls it; as the driver wishes.
    queue_size : int
        How many commands may wait.
    stale_after_s : float
        Motion is refused when the latest sample is older.
    max_release_s : float
        A device that takes longer to do what is under way, when it is to be released or another
        one is to be connected, is left alone: a new thread goes on without it.
    local_time : callable
        The time of day, for what is told to people.

    Attributes
    ----------
    inverses : Inverses
        Of piezo axes, on and off.
    loops : Loops
        Around axes, closed and opened.
    bounds : TipBounds
        The keep-out zone and the floor that is taught.
    backlash : Backlash
        One-sided approaches of stepper axes.
    ranges : NarrowedRanges
        Of axes, inside those of the robot file.
    reservations : Reservations
        Owners that keep every axis.
    profiles : Profiles
        That the device runs by itself.
    captures : Captures
        Samples at a high rate.
    tool : Tool
    service : Service
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
        subscribers = Subscribers()
        link = DeviceLink(
            driver,
            self.history,
            subscribers,
            clock=clock,
            queue_size=queue_size,
            stale_after_s=stale_after_s,
        )
        guard = Guard(driver.robot)
        admission = Admission(link, guard, Undo(driver.robot))
        self.inverses = Inverses(link, admission)
        self.loops = Loops(link, admission)
        self.bounds = TipBounds(link, admission, guard)
        self.ranges = NarrowedRanges(link, admission, guard)
        self.reservations = Reservations(link, admission)
        self.profiles = Profiles(link, admission, guard, self.inverses, self.reservations)
        self.captures = Captures(link)
        self.tool = Tool(link, admission)
        self.service = Service(link)
        self.backlash = Backlash(link, admission, self.ranges)
        routing = Routing(link, admission, guard, self.backlash)
        moves = Moves(link, admission, guard, self.inverses, self.loops, routing)
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
        self._pauses = PauseWatch(clock)
        #: Of the thread that shows this to an operator; once it beats, nothing moves without it.
        self.screen = Heartbeat(clock)
        #: Of the worker.
        self.pulse = Heartbeat(clock)

    # --- connection -------------------------------------------------------------------------------

    @property
    def driver(self) -> Driver:
        """The driver in use."""
        return self._link.driver

    @property
    def setpoint_period_s(self) -> float:
        """Period of the device's set-points, s; a dry run for it needs this."""
        return self._link.setpoint_period_s

    def start(self) -> None:
        """Connect to the device and keep communicating with it, on a separate thread.

        Raises
        ------
        RefusedError
            If the session was started before.
        """
        if self._thread is not None:
            raise RefusedError(
                message("engine", "the session has already been started; create a new one")
            )
        self._link.connect()
        self._start_thread(self._link.worker)

    def close(self, timeout_s: float = 5.0) -> bool:
        """Stop, release the device and end the worker; safe to call twice.

        Returns whether the worker ended in time; one that hangs in a device is left behind.
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
        """Ask the worker to connect; for a program that steps :meth:`run_once` itself."""
        self._expect(self._link.connect())

    def reconnect(self) -> None:
        """Connect again after a failure; never happens automatically.

        Raises
        ------
        RefusedError
            If the session is connected, or an earlier call still hangs in the driver.
        """
        connection = self._link.snapshot().connection
        if connection is Connection.CONNECTING:
            raise RefusedError(message("engine", "the device is being connected; wait"))
        if connection is Connection.CONNECTED:
            raise RefusedError(message("engine", "the device is connected"))
        if self._link.worker.driver_hangs:
            raise RefusedError(
                message(
                    "engine",
                    "{name} still hangs in an earlier call; choose Connect on the panel "
                    "Connection to open it anew, or another device",
                ).fill(name=self.driver.name)
            )
        self._expect(self._link.connect())

    def disconnect(self) -> None:
        """Stop, and release the device; it holds."""
        self.stop(message("engine", "the device is being released"))
        self._expect(self._link.disconnect())

    def use(self, driver: Driver) -> None:
        """Stop, release the device, and connect to another one.

        It has neither inverses nor loops, and no way leads back to where the first one was. A
        stop that is latched stays so. This never waits: a device that hangs is left alone after
        ``max_release_s``.

        Raises
        ------
        RefusedError
            If the other driver is for another robot.
        """
        if tuple(driver.axes) != tuple(self.driver.axes):
            raise RefusedError(
                message(
                    "engine",
                    "driver {name} is for a robot with axes {axes}; this one has "
                    "{these}; start the program with that robot",
                ).fill(
                    name=repr(driver.name),
                    axes=", ".join(driver.axes),
                    these=", ".join(self.driver.axes),
                )
            )
        self.stop(message("engine", "another device is being connected"))
        self._period_s = driver.service_period_s
        self._expect(self._link.exchange(driver))
        self.inverses.forget()
        self.loops.forget()
        self.backlash.forget()
        with self._admission.lock:
            self._admission.way_back.forget()

    def run_once(self) -> None:
        """Do one cycle of the worker's, where no thread was started.

        What an operator began moves on only as long as he can see it.
        """
        self._step(self._link.worker)

    def _step(self, worker: Worker) -> None:
        self.pulse.beat()
        self._stop_after_pause()
        state = worker.state
        moves = state.activity in _MOVES and not state.stopping
        if moves and self.screen.silent:
            self.stop(message("engine", "the window does not respond"))
        worker.run_once()
        if worker.state.connection is not state.connection:
            self._pauses.restart()  # connecting takes its time

    def _stop_after_pause(self) -> None:
        """Cancel all that is under way or waits, where this program did not run for a while."""
        paused_s = self._pauses.measure_pause()
        # A stepped simulation is advanced as far as its caller likes.
        is_simulation = self._thread is None and self.driver.virtual_time
        connected = self._link.worker.state.connection is Connection.CONNECTED
        if paused_s > MAX_PAUSE_S and connected and not is_simulation:
            self.stop(
                message(
                    "engine",
                    "this program stood still for {paused} s (computer asleep or overloaded); "
                    "look at the machine, then move again",
                ).fill(paused=rounded(paused_s, 2))
            )

    def confirm_position(self) -> None:
        """Trust the position again after a lost connection: someone has looked.

        A stop that comes before the worker hears of it withdraws that.

        Raises
        ------
        RefusedError
            If the session is not connected.
        """

        def confirm(_: Driver, permit: Permit) -> None:
            if permit.epoch == self._link.gate.epoch:
                self._link.worker.confirm_position()

        self._link.ask(confirm)

    # --- stop -------------------------------------------------------------------------------------

    def stop(self, why: str = "", *, by: str = PROGRAM) -> None:
        """Halt every axis now; any thread, any time. Never waits and never raises.

        Queued commands are dropped. The device is told from this very thread. ``by`` is
        ``ownership.OPERATOR`` only where a person asked for it.
        """
        self._link.stop(StopRequest(by, why, self._local_time()))

    def emergency_stop(self, why: str = LOCKED, *, by: str = PROGRAM) -> None:
        """Stop, and let nothing move until :meth:`release`; any thread, never waits or raises."""
        self._link.stop(StopRequest(by, why, self._local_time()), latch=why)

    def release(self) -> None:
        """Permit motion again after an emergency stop; the machine rests until the next command."""
        self._link.gate.release()

    def bar(self, reason: str | None) -> None:
        """Refuse all motion for this reason, on any path, until None; present motion continues."""
        self._link.barred = reason

    def dismiss_stop(self) -> None:
        """Count the latest stop as past: the machine is being prepared for its next motion."""
        self._link.note_accepted(self._link.gate.epoch)

    @property
    def is_untouched_since_stop(self) -> bool:
        """Whether nothing has moved, and no motion was accepted, since the latest stop."""
        return self._link.is_untouched_since_stop

    @property
    def stop_asked_s(self) -> float | None:
        """Host time of the latest stop, by anyone; None before the first."""
        return self._link.stop_asked_s

    @property
    def epoch(self) -> Epoch:
        """How many stops, connections and releases there have been; any thread."""
        return self._link.gate.epoch

    def permit(self, purpose: Purpose = Purpose.MOTION) -> Permit:
        """Return a permit of now, for a plan whose requests are to end with the next stop.

        Requests take it as ``permit``; those without one draw their own before their first check.
        """
        return self._link.gate.permit(purpose)

    # --- state ------------------------------------------------------------------------------------

    def snapshot(self) -> SessionState:
        """Return the present state; any thread."""
        state = self._link.snapshot()
        return replace(state, tip=self.bounds.tip(state))

    @property
    def reported(self) -> SessionState:
        """What the device said last, without age, locks and tip, which are worked out; any thread.

        It costs nothing, for whoever looks at command, activity or progress alone.
        """
        return self._link.worker.state

    @property
    def at_rest(self) -> bool:
        """Whether nothing moves, waits, or was handed over since the device was looked at last."""
        return self._link.worker.at_rest

    @property
    def undoable(self) -> bool:
        """Whether there is a move to take back."""
        return self._moves.undoable

    @property
    def standing(self) -> tuple[object, ...]:
        """What a check of a path rests on; it is equal as long as that holds."""
        return self._moves.standing

    # --- readings and their model -----------------------------------------------------------------

    @property
    def corrections(self) -> SensorCorrections:
        """The calibrations that are applied to the axes' readings; any thread."""
        return self._link.worker.corrections

    @property
    def labels(self) -> RunLabels:
        """Run, operator and sample, which every playback and recording names; any thread."""
        return self._link.worker.notes.labels

    @labels.setter
    def labels(self, labels: RunLabels) -> None:
        self._link.worker.notes.labels = labels

    @property
    def model(self) -> ModelInUse:
        """The model that predictions are made with; any thread."""
        return self._link.worker.models.model

    @property
    def memory(self) -> CommandMemory:
        """What the machine was commanded since it was connected; any thread."""
        return self._link.worker.models.memory

    def use_model(self, model: ModelInUse) -> None:
        """Use another model for predictions from now on; commands to the machine stay the same.

        Its memory is computed from the commands since the connection, which takes about a second:
        call it from a thread of its own in a window. An event tells when it is in use.

        Raises
        ------
        RefusedError
            If the machine is not at rest or not connected.
        EffectError
            If an effect of the model cannot be used.
        """
        if not self.at_rest:
            raise RefusedError(
                message("engine", "the machine is still moving; change the model at rest")
            )
        prepared = PreparedModel.of(model, self.memory)
        self._link.ask(lambda _, __: self._link.worker.use_model(prepared))

    def note_contact(self, what: str) -> None:
        """Note a contact: effects learned from the present motion may come from it."""
        self._link.worker.notes.add(what)

    def _expect(self, request: ConnectionRequest) -> None:
        """Have another thread do a request where the present one does not come to it in time."""
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
            self._pauses.restart()
            self._start_thread(worker)

    def _start_thread(self, worker: Worker) -> None:
        self._thread = threading.Thread(
            target=self._run, args=(worker,), name="motion session", daemon=True
        )
        self._thread.start()

    def _run(self, worker: Worker) -> None:
        mailbox = self._link.mailbox
        next_s = time.monotonic()
        while not self._closing.is_set() and not worker.is_retired:
            self._step(worker)
            # By the clock, not after the work: what is late once is not late for ever.
            next_s = max(next_s + self._period_s, time.monotonic())
            mailbox.wake_event.wait(next_s - time.monotonic())
            mailbox.wake_event.clear()
        if not worker.is_retired:
            self.pulse.end()
        worker.shut_down()
