"""A session with a device: who owns the driver, its thread, its stop and what it tells."""

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime

from rotemina.app.motion.command_memory import CommandMemory
from rotemina.app.motion.heartbeat import Heartbeat
from rotemina.app.motion.history import LiveHistory
from rotemina.app.motion.live_models import ModelOutputs, PreparedModel
from rotemina.app.motion.mailbox import (
    Ask,
    ConnectionRequest,
    Mailbox,
    RefusedError,
)
from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.motion.sensor_corrections import SensorCorrections
from rotemina.app.motion.state import (
    Callback,
    Connection,
    Event,
    SessionState,
)
from rotemina.app.motion.stop_request import PROGRAM, StopRequest
from rotemina.app.motion.worker import Tap, Worker
from rotemina.drivers.abilities import TrajectoryPlayer
from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import Epoch, Gate, Permit, Purpose
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.trajectory.kinematics import SETPOINT_PERIOD_S

_LOG = logging.getLogger(__name__)
_MOVES = (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING)


class DeviceSession:
    """Owns a driver: one worker thread talks to it, and only a stop goes past that.

    What the device does is seen in :meth:`snapshot`, ``history`` and events. After a failure
    nothing moves until :meth:`reconnect`.

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
    local_time : callable
        The time of day, for what is told to people.
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
        local_time: Callable[[], datetime] = datetime.now,
    ) -> None:
        self.driver = driver
        self.robot = driver.robot
        self.history = history if history is not None else LiveHistory(driver.axes)
        self._clock = clock if clock is not None else driver.clock
        self._period_s = period_s if period_s is not None else driver.service_period_s
        self._stale_after_s = stale_after_s
        self._local_time = local_time
        self._mailbox = Mailbox(queue_size)
        self._gate = Gate(self._clock, self._locks)
        driver.gate = self._gate
        self._worker = Worker(
            driver,
            self._gate,
            self._mailbox,
            self.history,
            self._clock,
            self._emit,
            self._tell_samples,
        )
        self._thread: threading.Thread | None = None
        self._closing = threading.Event()
        # Guards what follows; never held while the driver is called.
        self._lock = threading.Lock()
        self._barred: str | None = None
        self._callbacks: list[Callback] = []
        self._taps: dict[Tap, bool] = {}  # whether it has failed
        self._stop_asked_s: float | None = None
        self._stop: StopRequest | None = None
        #: Of the thread that shows this to an operator; once it beats, nothing moves without it.
        self.screen = Heartbeat(self._clock)
        #: Of the worker.
        self.pulse = Heartbeat(self._clock)

    def start(self) -> None:
        """Connect to the device and keep talking to it, on a thread of its own.

        Raises
        ------
        RefusedError
            If the session was started before.
        """
        if self._thread is not None:
            raise RefusedError("the session was started before; make another one")
        self._mailbox.request_connection(ConnectionRequest(self.driver))
        self._thread = threading.Thread(target=self._run, name="motion session", daemon=True)
        self._thread.start()

    def close(self, timeout_s: float = 5.0) -> bool:
        """Stop, let go of the device and end the worker; safe to call twice.

        Returns whether the worker ended in time; one that hangs in a device is left behind.
        """
        self._closing.set()
        self._mailbox.wake_event.set()
        thread = self._thread
        if thread is None:
            self._worker.shut_down()
            return True
        if thread is not threading.current_thread():
            thread.join(timeout_s)
        return not thread.is_alive()

    @property
    def setpoint_period_s(self) -> float:
        """How often the device applies set-points, s; what a dry run for it is to be told."""
        driver = self.driver
        return (
            driver.setpoint_period_s
            if isinstance(driver, TrajectoryPlayer)
            else (SETPOINT_PERIOD_S)
        )

    def connect(self) -> None:
        """Ask the worker to connect; for a program that steps :meth:`run_once` itself."""
        self._mailbox.request_connection(ConnectionRequest(self.driver))

    def reconnect(self) -> None:
        """Connect again after a failure; never happens by itself.

        Raises
        ------
        RefusedError
            If the session is connected.
        """
        if self._worker.state.connection in (Connection.CONNECTED, Connection.CONNECTING):
            raise RefusedError("the device is connected")
        self._mailbox.request_connection(ConnectionRequest(self.driver))

    def disconnect(self) -> None:
        """Stop, and let go of the device; it holds."""
        self.stop("the device is let go of")
        self._mailbox.request_connection(ConnectionRequest(None))

    def use(self, driver: Driver) -> None:
        """Stop, let go of the device, and connect to another one.

        Raises
        ------
        RefusedError
            If the other driver is for another robot.
        """
        if tuple(driver.axes) != tuple(self.driver.axes):
            raise RefusedError(
                f"driver {driver.name!r} is for a robot with axes {', '.join(driver.axes)}; this "
                f"one has {', '.join(self.driver.axes)}; start the program with that robot"
            )
        self.stop("another device is connected")
        # Until the worker has exchanged them, both drivers are stopped and neither is moved.
        driver.gate = self._gate
        self.driver = driver
        self._gate.reconnected()
        self._period_s = driver.service_period_s
        self._mailbox.request_connection(ConnectionRequest(driver))

    def run_once(self) -> None:
        """Do one cycle of the worker's; only where no thread was started."""
        self._cycle()

    def confirm_position(self) -> None:
        """Trust the position again after a lost connection: somebody has looked.

        A stop that comes before the worker hears of it withdraws that.

        Raises
        ------
        RefusedError
            If the session is not connected.
        """

        def confirm(_: Driver, permit: Permit) -> None:
            if permit.epoch == self._gate.epoch:
                self._worker.confirm_position()

        self._ask(confirm)

    def stop(self, why: str = "", *, by: str = PROGRAM) -> None:
        """Halt every axis now; any thread, any time. Never waits and never raises.

        Queued commands are dropped. The device is told from this very thread. ``by`` is
        ``ownership.OPERATOR`` only where a person asked for it.
        """
        self._halt(StopRequest(by, why, self._local_time()))

    def emergency_stop(self, why: str = "emergency stop", *, by: str = PROGRAM) -> None:
        """Stop, and let nothing move until :meth:`release`; any thread, never waits or raises."""
        self._halt(StopRequest(by, why, self._local_time()), latch=why)

    def release(self) -> None:
        """Let the machine move again after an emergency stop; it stands until it is told to."""
        self._gate.release()

    def bar(self, reason: str | None) -> None:
        """Accept no motion for this reason, on any path, until None is said; what moves goes on."""
        self._barred = reason

    @property
    def corrections(self) -> SensorCorrections:
        """The calibrations that are applied to the axes' readings; any thread."""
        return self._worker.corrections

    @property
    def model(self) -> ModelInUse:
        """The model that predictions are made with; any thread."""
        return self._worker.models.model

    @property
    def memory(self) -> CommandMemory:
        """What the machine was commanded since it was connected; any thread."""
        return self._worker.models.memory

    def use_model(self, model: ModelInUse) -> None:
        """Make predictions with another model from now on; what is sent stays as it is.

        What it remembers is carried on from what the machine was commanded since it was connected,
        which takes a second or so: a window asks from another thread. An event tells when it is
        in use.

        Raises
        ------
        RefusedError
            If the machine is not at rest or not connected.
        EffectError
            If an effect of the model cannot be used.
        """
        if not self.at_rest:
            raise RefusedError("the machine is still moving; change the model at rest")
        prepared = PreparedModel.of(model, self.memory)
        self._ask(lambda _, __: self._worker.use_model(prepared))

    def note_contact(self, what: str) -> None:
        """Note a contact: what is learned from the motion under way may come from it."""
        self._worker.note(what)

    def snapshot(self) -> SessionState:
        """Return the present state; any thread."""
        state = self._worker.state
        latched = self._gate.latched
        locked = self._locked(state)
        if latched is not None:
            locked = f"{latched} is latched; release it first"
        return replace(
            state,
            age_s=self._age_s(state),
            locked=locked,
            queued=len(self._mailbox),
            stop=self._stop,
            latched=latched,
            owners=self._worker.ownership.owners,
            stop_latency=self._worker.latency.figures(),
        )

    def subscribe(self, callback: Callback) -> Callable[[], None]:
        """Have events told to ``callback``, on the worker's thread; return how to end that."""
        with self._lock:
            self._callbacks.append(callback)

        def unsubscribe() -> None:
            with self._lock:
                if callback in self._callbacks:
                    self._callbacks.remove(callback)

        return unsubscribe

    def tap(self, callback: Tap) -> Callable[[], None]:
        """Have each portion of samples told to ``callback``, with the models' answers.

        It is called on the worker's thread, which waits for it: at most every 16 ms, after the
        state is published and before events tell of it. Returns how to end that.
        """
        with self._lock:
            self._taps[callback] = False

        def end() -> None:
            with self._lock:
                self._taps.pop(callback, None)

        return end

    @property
    def at_rest(self) -> bool:
        """Whether nothing moves, waits, or was handed over since the device was looked at last."""
        return self._worker.at_rest

    @property
    def stop_asked_s(self) -> float | None:
        """Host time of the latest stop, whoever asked for it; None before the first."""
        return self._stop_asked_s

    @property
    def epoch(self) -> Epoch:
        """How many stops, connections and releases there have been; any thread."""
        return self._gate.epoch

    def permit(self, purpose: Purpose = Purpose.MOTION) -> Permit:
        """Return a permit of now, for a plan whose requests are to end with the next stop.

        Requests take it as ``permit``; those without one draw their own before their first check.
        """
        return self._gate.permit(purpose)

    def _halt(self, request: StopRequest, latch: str | None = None) -> None:
        """Shut the gate on what was asked before, then tell every driver that may be open."""
        asked_s = self._clock()
        self._stop, self._stop_asked_s = request, asked_s
        self._gate.stop(latch)
        self._mailbox.clear()
        failure = None
        # During an exchange the worker still has the driver from before.
        for driver in dict.fromkeys((self._worker.driver, self.driver)):
            try:
                driver.halt()
            except Exception as error:  # told by the worker: a stop button must not raise
                failure = error
        self._worker.stopped(asked_s, failure, request)

    def _locks(self, permit: Permit) -> str | None:
        """Return what locks a permit's purpose beside a stop; under the gate's lock."""
        state = self._worker.state
        if permit.purpose is Purpose.MOTION:
            locked = self._locked(state)
        elif permit.purpose is Purpose.HOMING:
            locked = self._unready(state)
        else:
            return None
        other = permit.owner and self._worker.ownership.other_than(permit.owner, permit.axes)
        return locked or (f"an axis is driven by {other}" if other else None)

    def _locked(self, state: SessionState) -> str | None:
        """Return why no motion is accepted, but for a latch."""
        if self._worker.driver is not self.driver:
            return "another device is being connected; wait"
        age_s = self._age_s(state)
        if state.locked is None and age_s is not None and age_s > self._stale_after_s:
            return f"the device has sent nothing for {age_s:.1f} s; wait, or reconnect"
        return state.locked or self._barred

    def _unready(self, state: SessionState) -> str | None:
        """Return why nothing can be done that needs a sound device, but no known position."""
        if self._worker.driver is not self.driver:
            return "another device is being connected; wait"
        if state.connection is not Connection.CONNECTED or state.fault or state.silent_s > 0.0:
            return state.locked or "not connected"
        return self._barred

    def _age_s(self, state: SessionState) -> float | None:
        received_s = state.sample_host_time_s
        return None if received_s is None else self._clock() - received_s

    def _ask(self, action: Callable[[Driver, Permit], None], permit: Permit | None = None) -> None:
        """Have something done on the thread that talks to the driver."""
        permit = self.permit(Purpose.ENQUIRY) if permit is None else permit
        if self._worker.state.connection is not Connection.CONNECTED:
            raise RefusedError(self._worker.state.locked or "not connected; connect first")
        self._mailbox.post(Ask(action), permit)

    def _emit(self, event: Event) -> None:
        with self._lock:
            callbacks = tuple(self._callbacks)
        for callback in callbacks:
            try:
                callback(event)
            except Exception:  # a subscriber's mistake must not stop the machine's worker
                _LOG.exception("a subscriber failed on %s", type(event).__name__)

    def _tell_samples(self, samples: Samples, answers: ModelOutputs) -> None:
        with self._lock:
            taps = tuple(self._taps.items())
        for callback, failed in taps:
            try:
                callback(samples, answers)
            except Exception:  # as of a subscriber; said once, not sixty times a second
                if not failed:
                    _LOG.exception("a tap failed")
                    with self._lock:
                        if callback in self._taps:  # it may have ended itself
                            self._taps[callback] = True

    def _cycle(self) -> None:
        """Do one cycle; what an operator began moves on only as long as he can see it."""
        self.pulse.beat()
        state = self._worker.state
        moves = state.activity in _MOVES and not state.stopping
        if moves and self.screen.silent:
            self.stop("the window does not answer")
        self._worker.run_once()

    def _run(self) -> None:
        next_s = time.monotonic()
        while not self._closing.is_set():
            self._cycle()
            # By the clock, not after the work: what is late once is not late for ever.
            next_s = max(next_s + self._period_s, time.monotonic())
            self._mailbox.wake_event.wait(next_s - time.monotonic())
            self._mailbox.wake_event.clear()
        self.pulse.end()
        self._worker.shut_down()
