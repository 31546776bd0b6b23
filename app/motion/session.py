"""A motion session: the one place through which a program moves a machine."""

import logging
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from rotemina.app.motion.guard import Guard, Leg, Place
from rotemina.app.motion.history import LiveHistory
from rotemina.app.motion.mailbox import (
    Ask,
    ClearFault,
    Drive,
    Home,
    Mailbox,
    Move,
    Play,
    RefusedError,
    SetEffects,
)
from rotemina.app.motion.ownership import HOMING, OPERATOR, PLAYBACK
from rotemina.app.motion.state import (
    Callback,
    Connection,
    Event,
    SessionState,
)
from rotemina.app.motion.undo import Undo
from rotemina.app.motion.worker import Worker
from rotemina.drivers.abilities import (
    Display,
    EffectCarrier,
    Homer,
    Parameterised,
    TrajectoryPlayer,
    VelocityMover,
)
from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver
from rotemina.drivers.samples import DeviceState
from rotemina.sim.kinematics.keep_out import KeepOutZone
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.checked import CheckedTrajectory, accepted
from rotemina.sim.trajectory.kinematics import SETPOINT_PERIOD_S
from rotemina.sim.trajectory.limits import OutOfLimitsError, check_target

LEASE_S = 0.15  # of a speed that nobody renews
_LOG = logging.getLogger(__name__)


class MotionSession:
    """Owns a driver: one worker thread talks to it, and every motion passes through here.

    A request is checked on the caller's thread and refused at once with the reason
    (:class:`rotemina.sim.errors.InputError`), or queued for the worker. Whatever the device then
    does is seen in :meth:`snapshot`, ``history`` and events. After a failure nothing moves until
    :meth:`reconnect`.

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
        self._worker = Worker(driver, self._mailbox, self.history, self._clock, self._emit)
        self._thread: threading.Thread | None = None
        self._closing = threading.Event()
        # Guards what follows; never held while the driver is called.
        self._lock = threading.Lock()
        self._guard = Guard(self.robot)
        self._undo = Undo(self.robot)
        self._latched: str | None = None
        self._callbacks: list[Callback] = []
        self._stop_latency_s: float | None = None

    def start(self) -> None:
        """Connect to the device and keep talking to it, on a thread of its own.

        Raises
        ------
        RefusedError
            If the session was started before.
        """
        if self._thread is not None:
            raise RefusedError("the session was started before; make another one")
        self._mailbox.request_connection()
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
        self._mailbox.request_connection()

    def reconnect(self) -> None:
        """Connect again after a failure; never happens by itself.

        Raises
        ------
        RefusedError
            If the session is connected.
        """
        if self._worker.state.connection in (Connection.CONNECTED, Connection.CONNECTING):
            raise RefusedError("the device is connected")
        self._mailbox.request_connection()

    def run_once(self) -> None:
        """Do one cycle of the worker's; only where no thread was started."""
        self._worker.run_once()

    # --- motion -----------------------------------------------------------------------------------

    def go_to(self, targets: Mapping[str, float], owner: str = OPERATOR) -> None:
        """Send axes to positions, m or rad; also in mid-move.

        Close above the tip's floor the move slows down by itself.

        Raises
        ------
        OutOfLimitsError
            If any target is beyond a limit, or the tip might leave its bounds; then no axis moves.
        RefusedError
            If no motion is possible now: not connected, a fault, a playback, a full queue, an axis
            that another owner drives.
        """
        with self._lock:
            self._post_move(dict(targets), owner)

    def move_velocity(
        self, velocities: Mapping[str, float], lease_s: float = LEASE_S, owner: str = OPERATOR
    ) -> dict[str, float]:
        """Let axes go at speeds, m/s or rad/s, until the lease runs out; renew it to go on.

        Returns the speeds that are used: close to the tip's bounds they are lower. A speed of 0
        halts an axis.

        Raises
        ------
        OutOfLimitsError
            If there is no such axis, or the tip might leave its bounds within the lease.
        RefusedError
            If the device cannot, or as :meth:`go_to`.
        """
        driver = self.driver
        if not isinstance(driver, VelocityMover):
            raise RefusedError(f"driver {driver.name!r} cannot move at a speed; send targets")
        driver.check_velocity(velocities, lease_s)
        with self._lock:
            self._refuse_if_locked()
            self._worker.ownership.claim(velocities, owner)
            used = self._guard.velocity(self._place(), velocities, lease_s)
            reach = self._guard.reach(self._place(), used, lease_s)
            self._note_rest()
            self._mailbox.post(Drive(used, lease_s, self._clock(), reach))
        return used

    def home(self, axes: Sequence[str] | None = None) -> None:
        """Find the limit switches of axes, or of all that have some.

        Raises
        ------
        RefusedError
            If the device has none, or is not at rest.
        """
        driver = self.driver
        if not isinstance(driver, Homer):
            raise RefusedError(f"driver {driver.name!r} has no switches to be found")
        wanted = driver.homing_axes if axes is None else tuple(axes)
        with self._lock:
            state = self.snapshot()
            self._refuse_if_unready(state)
            if state.activity is not DeviceState.IDLE or len(self._mailbox):
                raise RefusedError("the machine is still moving; stop it or wait before homing")
            self._worker.ownership.claim(wanted, HOMING)
            self._undo.forget()
            self._mailbox.post(Home(wanted))

    def confirm_position(self) -> None:
        """Trust the position again after a lost connection: somebody has looked.

        Raises
        ------
        RefusedError
            If the session is not connected.
        """
        self._ask(lambda _: self._worker.confirm_position())

    def undo(self) -> None:
        """Go back to where the axes rested before the latest move: up, across, down.

        Raises
        ------
        OutOfLimitsError, RefusedError
            As :meth:`go_to`, or if there is no move to take back.
        """
        with self._lock:
            self._refuse_if_locked()
            if self._worker.state.activity is not DeviceState.IDLE or len(self._mailbox):
                raise RefusedError("the machine is still moving; stop it or wait before going back")
            place = self._place()
            legs: list[Leg] = []
            ways = self._undo.back(dict(self._worker.state.command))
            for targets in ways:
                legs += self._guard.move(place, targets)
                place = self._guard.place({}, {**self._worker.state.command, **targets})
            self._worker.ownership.claim(ways[0], OPERATOR)
            self._mailbox.post(Move(tuple(legs)))

    def take_over(self, axes: Sequence[str], owner: str) -> None:
        """Make axes an owner's that another one drives; they go on until told otherwise."""
        self._worker.ownership.take_over(axes, owner)

    def jog(self, axis: str, distance: float, owner: str = OPERATOR) -> None:
        """Move one axis by a distance (m or rad) from where it was last sent.

        Raises
        ------
        OutOfLimitsError, RefusedError
            As :meth:`go_to`.
        """
        if axis not in self.robot.axes:
            check_target(self.robot, axis, 0.0)
        with self._lock:
            self._refuse_if_locked()
            self._post_move({axis: self._target_of(axis) + distance}, owner)

    def play(self, trajectory: Record | CheckedTrajectory) -> None:
        """Play a trajectory; events tell how it ends, with the record.

        A bare record is checked on the caller's thread, which takes half a second for a million
        rows; what a dry run allowed (``dry_run(…).require()``) is not checked again.

        Raises
        ------
        OutOfLimitsError, TrajectoryError
            If it exceeds a limit or is not one for this robot.
        RefusedError
            If the device cannot play or is not at rest, or as :meth:`go_to`.
        """
        if not isinstance(self.driver, TrajectoryPlayer):
            raise RefusedError(f"driver {self.driver.name!r} cannot play trajectories")
        checked = accepted(self.robot, trajectory, self.setpoint_period_s)
        with self._lock:
            self._refuse_if_locked()
            if self._worker.state.activity is not DeviceState.IDLE or len(self._mailbox):
                raise RefusedError("the machine is still moving; stop it or wait before playing")
            self._guard.play(self._place(), checked)
            self._worker.ownership.claim(self.driver.axes, PLAYBACK)
            self._note_rest()
            self._mailbox.post(Play(checked))

    def stop(self) -> None:
        """Halt every axis now; any thread, any time. Never waits and never raises.

        Queued commands are dropped. The device is told from this very thread.
        """
        asked_s = self._clock()
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

    # --- bounds and parameters --------------------------------------------------------------------

    @property
    def keep_out(self) -> KeepOutZone | None:
        """The tip's bounds; None where the robot has no tip."""
        return self._guard.zone

    def teach_floor(self, clearance: float = 0.0) -> float:
        """Put the tip's floor where the tip is now, or that much lower; return its height, m.

        Raises
        ------
        OutOfLimitsError
            If the robot has no tip.
        RefusedError
            If the position is not known.
        """
        self._refuse_if_locked()
        zone = self._guard.zone
        if zone is None:
            raise OutOfLimitsError(f"robot {self.robot.name!r} has no tip that a floor could hold")
        command = self._worker.state.command
        tip = zone.tip(np.array([command[axis] for axis in self.driver.axes]))
        self._guard.teach_floor(float(tip[2]) - clearance)
        return float(tip[2]) - clearance

    def clear_floor(self) -> None:
        """Take the tip's floor away."""
        self._guard.teach_floor(None)

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
        if self._latched is not None:
            locked = f"{self._latched} is latched; release it first"
        return replace(
            state,
            age_s=age_s,
            locked=locked,
            queued=len(self._mailbox),
            latched=self._latched,
            owners=self._worker.ownership.owners,
            tip=self._tip(state),
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

    def _post_move(self, targets: dict[str, float], owner: str) -> None:
        self._refuse_if_locked()
        legs = self._guard.move(self._place(), targets)
        self._worker.ownership.claim(targets, owner)
        self._note_rest()
        self._mailbox.post(Move(legs))

    def _place(self) -> Place:
        """Return where the axes may be by what they have been told and said last."""
        worker = self._worker
        state = worker.state
        return self._guard.place(
            state.measured, state.command, worker.targets, worker.reaches, *self._mailbox.pending()
        )

    def _note_rest(self) -> None:
        """Keep where the machine rests, to come back to, before it begins to move."""
        if self._worker.state.activity is DeviceState.IDLE and not len(self._mailbox):
            self._undo.note(self._worker.state.command)

    def _tip(self, state: SessionState) -> tuple[float, float, float] | None:
        zone = self._guard.zone
        if zone is None or not state.command:
            return None
        x, y, z = zone.tip(np.array([state.command[axis] for axis in self.driver.axes])).tolist()
        return x, y, z

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

    def _target_of(self, axis: str) -> float:
        """Return where an axis was last sent by a command that nobody refused, or stands."""
        target = self._mailbox.target_of(axis)
        if target is None:
            target = self._worker.targets.get(axis)
        if target is None:
            target = self._worker.state.command.get(axis, float("nan"))
        return target

    def _refuse_if_unready(self, state: SessionState) -> None:
        """Refuse what needs a sound device, but not a known position."""
        if state.connection is not Connection.CONNECTED or state.fault or state.silent_s > 0.0:
            raise RefusedError(f"motion is locked: {state.locked}")
        if self._latched is not None:
            raise RefusedError(f"{self._latched} is latched; release it first")

    def _refuse_if_locked(self) -> None:
        state = self.snapshot()
        if state.locked is not None:
            raise RefusedError(f"motion is locked: {state.locked}")
        if state.activity is DeviceState.HOMING:
            raise RefusedError("the machine looks for its switches; wait, or stop it first")
        if state.activity is DeviceState.PLAYING or self._mailbox.holds_play():
            raise RefusedError("a trajectory is playing and owns every axis; stop it first")

    def _emit(self, event: Event) -> None:
        with self._lock:
            callbacks = tuple(self._callbacks)
        for callback in callbacks:
            try:
                callback(event)
            except Exception:  # a subscriber's mistake must not stop the machine's worker
                _LOG.exception("a subscriber failed on %s", type(event).__name__)

    def _run(self) -> None:
        next_s = time.monotonic()
        while not self._closing.is_set():
            self._worker.run_once()
            # By the clock, not after the work: what is late once is not late for ever.
            next_s = max(next_s + self._period_s, time.monotonic())
            self._mailbox.bell.wait(next_s - time.monotonic())
            self._mailbox.bell.clear()
        self._worker.shut_down()
