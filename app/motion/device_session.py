"""A session with a device: who owns the driver, its thread, its stop and what it tells."""

import logging
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import replace

from rotemina.app.motion.history import LiveHistory
from rotemina.app.motion.mailbox import (
    Ask,
    ClearFault,
    Mailbox,
    RefusedError,
    SetEffects,
    Wish,
)
from rotemina.app.motion.sensor_corrections import SensorCorrections
from rotemina.app.motion.state import (
    Callback,
    Connection,
    Event,
    SessionState,
)
from rotemina.app.motion.worker import Tap, Worker
from rotemina.drivers.abilities import Display, Parameterised, TrajectoryPlayer
from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver
from rotemina.drivers.model_abilities import EffectCarrier
from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.kinematics import SETPOINT_PERIOD_S

_LOG = logging.getLogger(__name__)


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
    ) -> None:
        self.driver = driver
        self.robot = driver.robot
        self.history = history if history is not None else LiveHistory(driver.axes)
        self._clock = clock if clock is not None else driver.clock
        self._period_s = period_s if period_s is not None else driver.service_period_s
        self._stale_after_s = stale_after_s
        self._mailbox = Mailbox(queue_size)
        self._worker = Worker(
            driver, self._mailbox, self.history, self._clock, self._emit, self._tell_samples
        )
        self._thread: threading.Thread | None = None
        self._closing = threading.Event()
        # Guards what follows; never held while the driver is called.
        self._lock = threading.Lock()
        self._latched: str | None = None
        self._barred: str | None = None
        self._callbacks: list[Callback] = []
        self._taps: dict[Tap, bool] = {}  # whether it has failed
        self._stop_latency_s: float | None = None
        self._stop_asked_s: float | None = None

    def start(self) -> None:
        """Connect to the device and keep talking to it, on a thread of its own.

        Raises
        ------
        RefusedError
            If the session was started before.
        """
        if self._thread is not None:
            raise RefusedError("the session was started before; make another one")
        self._mailbox.wish(Wish(self.driver))
        self._thread = threading.Thread(target=self._run, name="motion session", daemon=True)
        self._thread.start()

    def close(self, timeout_s: float = 5.0) -> bool:
        """Stop, let go of the device and end the worker; safe to call twice.

        Returns whether the worker ended in time; one that hangs in a device is left behind.
        """
        self._closing.set()
        self._mailbox.bell.set()
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
        self._mailbox.wish(Wish(self.driver))

    def reconnect(self) -> None:
        """Connect again after a failure; never happens by itself.

        Raises
        ------
        RefusedError
            If the session is connected.
        """
        if self._worker.state.connection in (Connection.CONNECTED, Connection.CONNECTING):
            raise RefusedError("the device is connected")
        self._mailbox.wish(Wish(self.driver))

    def disconnect(self) -> None:
        """Stop, and let go of the device; it holds."""
        self.stop()
        self._mailbox.wish(Wish(None))

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
        self.stop()
        self.driver = driver
        self._period_s = driver.service_period_s
        self._mailbox.wish(Wish(driver))

    def run_once(self) -> None:
        """Do one cycle of the worker's; only where no thread was started."""
        self._worker.run_once()

    def confirm_position(self) -> None:
        """Trust the position again after a lost connection: somebody has looked.

        Raises
        ------
        RefusedError
            If the session is not connected.
        """
        self._ask(lambda _: self._worker.confirm_position())

    def stop(self) -> None:
        """Halt every axis now; any thread, any time. Never waits and never raises.

        Queued commands are dropped. The device is told from this very thread.
        """
        asked_s = self._clock()
        self._stop_asked_s = asked_s  # first: whoever sends speeds looks at it before each
        self._mailbox.clear()
        failure = None
        try:
            self.driver.stop()
        except Exception as error:  # told by the worker: a stop button must not raise
            failure = error
        latency_s = self._clock() - asked_s
        self._worker.stopped(asked_s, failure)
        with self._lock:
            self._stop_latency_s = latency_s

    def emergency_stop(self, reason: str = "emergency stop") -> None:
        """Stop, and let nothing move until :meth:`release`; any thread, never waits or raises."""
        self._latched = reason
        self.stop()

    def release(self) -> None:
        """Let the machine move again after an emergency stop; it stands until it is told to."""
        self._latched = None

    def bar(self, reason: str | None) -> None:
        """Accept no motion for this reason, on any path, until None is said; what moves goes on."""
        self._barred = reason

    def accept_parameters(self) -> None:
        """Move with the device's parameters as they are.

        Raises
        ------
        RefusedError
            If the device has none, or is not connected.
        """
        self._ask_parameters(lambda driver: driver.accept_parameters())

    def write_parameters(self) -> None:
        """Write the robot file's parameters into the device.

        Raises
        ------
        RefusedError
            If the device has none, or is not connected.
        """
        self._ask_parameters(lambda driver: driver.write_parameters())

    def show(self, row: int, text: str) -> None:
        """Show text on the device's display; nothing happens where there is none."""

        def action(driver: Driver) -> None:
            if isinstance(driver, Display):
                driver.show(row, text)

        if isinstance(self.driver, Display):
            self._ask(action)

    def clear_fault(self) -> None:
        """Acknowledge a device's fault; nothing happens without one.

        Raises
        ------
        RefusedError
            If the connection failed: reconnect instead.
        """
        state = self._worker.state
        if state.connection is not Connection.CONNECTED:
            raise RefusedError(state.locked or "not connected")
        if state.fault is not None:
            self._mailbox.post(ClearFault())

    @property
    def corrections(self) -> SensorCorrections:
        """The calibrations that are applied to the axes' readings; any thread."""
        return self._worker.corrections

    @property
    def effects(self) -> tuple[AxisEffect, ...] | None:
        """The effects on a simulated machine; None where the device is none that carries any."""
        return self.driver.effects if isinstance(self.driver, EffectCarrier) else None

    def set_effects(self, effects: Sequence[AxisEffect]) -> None:
        """Put other effects on a simulated machine, also while it moves.

        Raises
        ------
        EffectError
            With axis, effect, parameter, value and bound.
        RefusedError
            If the device carries no effects, is not connected, or a queue is full.
        """
        if not isinstance(self.driver, EffectCarrier):
            raise RefusedError(
                f"driver {self.driver.name!r} is a real machine: its effects are its own; "
                "connect to the simulator"
            )
        self.driver.check_effects(effects)
        if self._worker.state.connection is not Connection.CONNECTED:
            raise RefusedError(self._worker.state.locked or "not connected; connect first")
        self._mailbox.post(SetEffects(tuple(effects)))

    def snapshot(self) -> SessionState:
        """Return the present state; any thread."""
        state = self._worker.state
        received_s = state.sample_host_time_s
        age_s = None if received_s is None else self._clock() - received_s
        locked = state.locked
        if locked is None and age_s is not None and age_s > self._stale_after_s:
            locked = f"the device has sent nothing for {age_s:.1f} s; wait, or reconnect"
        locked = locked or self._barred
        if self._latched is not None:
            locked = f"{self._latched} is latched; release it first"
        return replace(
            state,
            age_s=age_s,
            locked=locked,
            queued=len(self._mailbox),
            latched=self._latched,
            owners=self._worker.ownership.owners,
            stop_latency=self._worker.latency.figures(),
            stop_latency_s=self._stop_latency_s,
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
        """Have each portion of samples told to ``callback``, with the model's answers (n, axes).

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
    def stop_asked_s(self) -> float | None:
        """Host time of the latest stop, whoever asked for it; None before the first."""
        return self._stop_asked_s

    def _ask(self, action: Callable[[Driver], None]) -> None:
        """Have something done on the thread that talks to the driver."""
        if self._worker.state.connection is not Connection.CONNECTED:
            raise RefusedError(self._worker.state.locked or "not connected; connect first")
        self._mailbox.post(Ask(action))

    def _ask_parameters(self, action: Callable[[Parameterised], None]) -> None:
        def asked(driver: Driver) -> None:
            assert isinstance(driver, Parameterised), "the session refuses on any other"
            action(driver)

        if not isinstance(self.driver, Parameterised):
            raise RefusedError(f"driver {self.driver.name!r} keeps no parameters")
        self._ask(asked)

    def _refuse_if_unready(self, state: SessionState) -> None:
        """Refuse what needs a sound device, but not a known position."""
        if state.connection is not Connection.CONNECTED or state.fault or state.silent_s > 0.0:
            raise RefusedError(f"motion is locked: {state.locked}")
        if self._latched is not None:
            raise RefusedError(f"{self._latched} is latched; release it first")
        if self._barred is not None:
            raise RefusedError(f"motion is locked: {self._barred}")

    def _emit(self, event: Event) -> None:
        with self._lock:
            callbacks = tuple(self._callbacks)
        for callback in callbacks:
            try:
                callback(event)
            except Exception:  # a subscriber's mistake must not stop the machine's worker
                _LOG.exception("a subscriber failed on %s", type(event).__name__)

    def _tell_samples(self, samples: Samples, model: FloatArray) -> None:
        with self._lock:
            taps = tuple(self._taps.items())
        for callback, failed in taps:
            try:
                callback(samples, model)
            except Exception:  # as of a subscriber; said once, not sixty times a second
                if not failed:
                    _LOG.exception("a tap failed")
                    with self._lock:
                        if callback in self._taps:  # it may have ended itself
                            self._taps[callback] = True

    def _run(self) -> None:
        next_s = time.monotonic()
        while not self._closing.is_set():
            self._worker.run_once()
            # By the clock, not after the work: what is late once is not late for ever.
            next_s = max(next_s + self._period_s, time.monotonic())
            self._mailbox.bell.wait(next_s - time.monotonic())
            self._mailbox.bell.clear()
        self._worker.shut_down()
