"""The link to a device: its driver, the gate, the queue, and the worker that calls the driver."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device.mailbox import (
    AbilityT,
    ConnectionRequest,
    DriverCallCommand,
    Mailbox,
    require_ability,
)
from rotemina.app.motion.device.recent_history import LiveHistory
from rotemina.app.motion.device.subscribers import SessionSubscribers
from rotemina.app.motion.device.worker import SessionWorker
from rotemina.app.motion.state import (
    NOT_CONNECTED,
    AlarmRaised,
    ConnectionState,
    SessionState,
    StopRequest,
)
from rotemina.drivers.abilities import TrajectoryPlayer
from rotemina.drivers.contract import (
    Clock,
    Driver,
    Gate,
    GateEpoch,
    Permit,
    PermitPurpose,
)
from rotemina.sim.messages import Message, format_fixed, format_rounded, message
from rotemina.sim.trajectory import DEFAULT_SETPOINT_PERIOD_S

_DEVICE_CHANGE_REASON = message("engine", "another device is being connected; wait")


class DeviceLink:
    """The access that all parts of a session share to a device. Methods are thread-safe.

    One worker calls the driver; only a stop bypasses the worker. The link runs no thread: its
    session steps :attr:`worker`.

    Parameters
    ----------
    driver : Driver
    history : LiveHistory
        Receives the samples.
    subscribers : SessionSubscribers
    clock : callable
        The host's time, s.
    queue_size : int
        Largest number of waiting commands.
    stale_after_s : float
        Motion is refused when the latest sample is older than this.
    """

    def __init__(
        self,
        driver: Driver,
        history: LiveHistory,
        subscribers: SessionSubscribers,
        *,
        clock: Clock,
        queue_size: int,
        stale_after_s: float,
    ) -> None:
        self.driver = driver
        self.robot = driver.robot
        self.clock = clock
        self.mailbox = Mailbox(queue_size)
        self.gate = Gate(clock, self._find_lock_reason)
        driver.gate = self.gate
        self.worker = SessionWorker(
            driver,
            self.gate,
            self.mailbox,
            history,
            clock,
            subscribers.emit,
            subscribers.send_samples,
        )
        #: Why all motion is refused, or None while it is permitted.
        self.bar_reason: str | None = None
        #: Host time of the latest stop, by any requester; None before the first.
        self.stop_requested_s: float | None = None
        self._emit = subscribers.emit
        # Workers that hang in a call of their driver, which may still be open. Replaced as a whole,
        # because stops read this tuple from other threads.
        self._abandoned_workers: tuple[SessionWorker, ...] = ()
        self._stale_after_s = stale_after_s
        self._stop: StopRequest | None = None
        # The gate's epoch right after the latest stop.
        self._stop_epoch = GateEpoch()
        # Epoch of the permit of the latest accepted request.
        self._accepted_epoch = GateEpoch()

    @property
    def setpoint_period_s(self) -> float:
        """Period at which the device applies set-points, s."""
        driver = self.driver
        return (
            driver.setpoint_period_s
            if isinstance(driver, TrajectoryPlayer)
            else DEFAULT_SETPOINT_PERIOD_S
        )

    def connect(self) -> ConnectionRequest:
        """Ask the worker to connect."""
        return self._request(self.driver)

    def disconnect(self) -> ConnectionRequest:
        """Ask the worker to release the device."""
        return self._request(None)

    def exchange_driver(self, driver: Driver) -> ConnectionRequest:
        """Ask the worker to release the device and to connect to another one."""
        # Until the worker has changed over, a stop halts both drivers, and neither may move.
        driver.gate = self.gate
        self.driver = driver
        self.gate.start_connection()
        # The latest stop was a stop of the previous device.
        self._stop = None
        return self.connect()

    def replace_hung_worker(
        self, request: ConnectionRequest, patience_s: float
    ) -> SessionWorker | None:
        """Replace the worker if it has not begun to execute a connection request.

        Return the new worker, which executes the request, or None if the request has begun. An
        event says which device is no longer used.
        """
        if not request.claim():
            return None
        hung_worker = self.worker
        self.worker = hung_worker.make_successor()
        self._abandoned_workers = (
            *(worker for worker in self._abandoned_workers if not worker.has_ended),
            hung_worker,
        )
        self.gate.start_connection()
        self.mailbox.repeat_connection_request(request)
        self._emit(
            AlarmRaised(
                message(
                    "engine",
                    "{name} has not answered for {seconds} s and could not be disconnected: the "
                    "program no longer uses it. If its machine moves, use its emergency stop "
                    "switch; check cable and device",
                ).fill(name=hung_worker.driver.name, seconds=format_rounded(patience_s, 2))
            )
        )
        return self.worker

    def _request(self, driver: Driver | None) -> ConnectionRequest:
        request = ConnectionRequest(driver)
        self.mailbox.request_connection(request)
        return request

    def queue_driver_call(
        self, action: Callable[[Driver, Permit], None], permit: Permit | None = None
    ) -> None:
        """Queue a call of ``action`` on the thread that talks to the driver.

        Raises
        ------
        RequestRefusedError
            If the device is not connected, the permit is no longer valid, or the queue is full.
        """
        permit = self.gate.permit(PermitPurpose.ENQUIRY) if permit is None else permit
        self.require_connection()
        self.mailbox.post(DriverCallCommand(action), permit)

    def queue_ability_call(
        self,
        ability: type[AbilityT],
        refusal: Message,
        action: Callable[[AbilityT, Permit], None],
        permit: Permit | None = None,
    ) -> None:
        """Queue a call of ``action`` for a driver that has an ability.

        Raises
        ------
        RequestRefusedError
            See :func:`require_ability` and :meth:`queue_driver_call`.
        """
        require_ability(self.driver, ability, refusal)

        def call_action(driver: Driver, permit: Permit) -> None:
            assert isinstance(driver, ability), "the ability was required above"
            action(driver, permit)

        self.queue_driver_call(call_action, permit)

    def require_connection(self) -> None:
        """Check that the device is connected, for a request that needs a connection.

        Raises
        ------
        RequestRefusedError
            If the device is not connected. The message says why.
        """
        state = self.worker.state
        if state.connection is not ConnectionState.CONNECTED:
            raise RequestRefusedError(state.lock_reason or NOT_CONNECTED)

    def stop(self, request: StopRequest, latch: str | None = None) -> None:
        """Invalidate earlier requests, empty the queue, and halt all drivers that may be open.

        Never waits and never raises. With ``latch``, the name of an emergency stop, nothing moves
        until the gate is released.
        """
        requested_s = self.clock()
        self._stop, self.stop_requested_s = request, requested_s
        # While the device is being changed, the worker still has the previous driver.
        drivers = dict.fromkeys((self.worker.driver, self.driver))
        self.gate.stop(latch)
        self._stop_epoch = self.gate.epoch
        self.mailbox.clear()
        for worker in self._abandoned_workers:
            if not worker.has_ended:
                # Nothing depends on a device that hangs, so its failures are ignored.
                with suppress(Exception):
                    worker.driver.halt()
        failure = None
        for driver in drivers:
            try:
                driver.halt()
            except Exception as error:
                # A stop button must not raise; the worker reports the failure.
                failure = error
        self.worker.note_stop(requested_s, failure, request)

    def record_accepted_epoch(self, epoch: GateEpoch) -> None:
        """Remember that the machine is in use again, so that an earlier stop is no longer shown."""
        self._accepted_epoch = epoch

    @property
    def is_untouched_since_stop(self) -> bool:
        """Whether nothing has moved, and no motion was accepted, since the latest stop."""
        accepted_stops, latest_stop = self._accepted_epoch.stops, self._stop_epoch.stops
        return accepted_stops < latest_stop and self.worker.is_resting_since_stop

    def snapshot(self) -> SessionState:
        """Return the current state, without the position of the tip."""
        state = self.worker.state
        if self.worker.driver is not self.driver:
            # The state of the previous device says nothing about the one that is being connected.
            state = SessionState(connection=ConnectionState.CONNECTING)
        age_s, silent_s = self._compute_age_s(state), state.silent_s
        if self._is_stale(state):
            silent_s = max(silent_s, age_s or 0.0)
        epoch, stop_epoch = self.gate.epoch, self._stop_epoch
        is_same_connection = (epoch.releases, epoch.connections) == (
            stop_epoch.releases,
            stop_epoch.connections,
        )
        latch_reason = self.gate.latch_reason
        lock_reason = self._find_motion_lock_reason(state)
        if latch_reason is not None:
            lock_reason = message("engine", "{stop} is active; release it first").fill(
                stop=latch_reason
            )
        return replace(
            state,
            age_s=age_s,
            silent_s=silent_s,
            lock_reason=lock_reason,
            queued=len(self.mailbox),
            stop=self._stop,
            halted=is_same_connection and self.is_untouched_since_stop,
            latch_reason=latch_reason,
            owners=self.worker.ownership.owners,
            stop_latency=self.worker.latency.compute_statistics(),
        )

    def find_unready_reason(self, state: SessionState) -> str | None:
        """Return why the device is not ready for requests that need no known position, or None."""
        if self.worker.driver is not self.driver:
            return _DEVICE_CHANGE_REASON
        if state.connection is not ConnectionState.CONNECTED or state.fault or state.silent_s > 0.0:
            return state.lock_reason or message("engine", "not connected")
        return self.bar_reason

    def _find_lock_reason(self, permit: Permit) -> str | None:
        """Return why requests with a permit are refused, apart from stops, or None.

        The gate calls this while it holds its own lock.
        """
        state = self.worker.state
        if permit.purpose is PermitPurpose.MOTION:
            lock_reason = self._find_motion_lock_reason(state)
        elif permit.purpose is PermitPurpose.HOMING:
            lock_reason = self.find_unready_reason(state)
        else:
            return None
        other_owner = permit.owner and self.worker.ownership.find_other_owner(
            permit.owner, permit.axes
        )
        if lock_reason or not other_owner:
            return lock_reason
        return message("engine", "an axis is driven by {other}").fill(other=other_owner)

    def _find_motion_lock_reason(self, state: SessionState) -> str | None:
        """Return why no motion is accepted, apart from a latched stop, or None."""
        if self.worker.driver is not self.driver:
            return _DEVICE_CHANGE_REASON
        if state.lock_reason is None and self._is_stale(state):
            return message(
                "engine", "the device has sent nothing for {seconds} s; wait, or reconnect"
            ).fill(seconds=format_fixed(self._compute_age_s(state) or 0.0, 1))
        return state.lock_reason or self.bar_reason

    def _is_stale(self, state: SessionState) -> bool:
        age_s = self._compute_age_s(state)
        is_connected = state.connection is ConnectionState.CONNECTED
        return is_connected and age_s is not None and age_s > self._stale_after_s

    def _compute_age_s(self, state: SessionState) -> float | None:
        received_s = state.sample_host_time_s
        return None if received_s is None else self.clock() - received_s
