"""The link to a device: its driver, the gate, the queue, and the worker that talks to it."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

from rotemina.app.motion.mailbox import A, Ask, ConnectionRequest, Mailbox, RefusedError, able
from rotemina.app.motion.recent_history import LiveHistory
from rotemina.app.motion.state import NOT_CONNECTED, Alarmed, Connection, SessionState
from rotemina.app.motion.stop import StopRequest
from rotemina.app.motion.subscribers import Subscribers
from rotemina.app.motion.worker import Worker
from rotemina.drivers.abilities import TrajectoryPlayer
from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import Epoch, Gate, Permit, Purpose
from rotemina.sim.messages import Message, message
from rotemina.sim.quantities import fixed, rounded
from rotemina.sim.trajectory.speed_and_acceleration import SETPOINT_PERIOD_S

_EXCHANGED = message("engine", "another device is being connected; wait")


class DeviceLink:
    """What all parts of a session share; every method may be called from any thread.

    One worker talks to the driver, and only a stop goes past that. The link runs no thread:
    whoever holds it steps :attr:`worker`.

    Parameters
    ----------
    driver : Driver
    history : LiveHistory
        Where samples go.
    subscribers : Subscribers
    clock : callable
        The host's time, s.
    queue_size : int
        How many commands may wait.
    stale_after_s : float
        Motion is refused when the latest sample is older.
    """

    def __init__(
        self,
        driver: Driver,
        history: LiveHistory,
        subscribers: Subscribers,
        *,
        clock: Clock,
        queue_size: int,
        stale_after_s: float,
    ) -> None:
        self.driver = driver
        self.robot = driver.robot
        self.clock = clock
        self.mailbox = Mailbox(queue_size)
        self.gate = Gate(clock, self._locks)
        driver.gate = self.gate
        self.worker = Worker(
            driver,
            self.gate,
            self.mailbox,
            history,
            clock,
            subscribers.emit,
            subscribers.pass_on,
        )
        #: Why no motion is accepted on any path; None while it is.
        self.barred: str | None = None
        #: Host time of the latest stop, whoever asked for it; None before the first.
        self.stop_asked_s: float | None = None
        self._emit = subscribers.emit
        # Each hangs in its driver, which may still be open; replaced as a whole.
        self._left_alone: tuple[Worker, ...] = ()
        self._stale_after_s = stale_after_s
        self._stop: StopRequest | None = None
        self._stop_epoch = Epoch()  # right after that stop
        self._accepted_epoch = Epoch()  # of the permit of the latest accepted request

    @property
    def setpoint_period_s(self) -> float:
        """How often the device applies set-points, s."""
        driver = self.driver
        return (
            driver.setpoint_period_s if isinstance(driver, TrajectoryPlayer) else SETPOINT_PERIOD_S
        )

    def connect(self) -> ConnectionRequest:
        """Ask the worker to connect."""
        return self._request(self.driver)

    def disconnect(self) -> ConnectionRequest:
        """Ask the worker to release the device."""
        return self._request(None)

    def exchange(self, driver: Driver) -> ConnectionRequest:
        """Ask the worker to release the device and to connect to another one."""
        # Until the worker has exchanged them, both drivers are stopped and neither is moved.
        driver.gate = self.gate
        self.driver = driver
        self.gate.reconnected()
        self._stop = None  # it was the stop of the device before
        return self.connect()

    def replace_hung_worker(self, request: ConnectionRequest, patience_s: float) -> Worker | None:
        """Return a new worker in place of one that has not come to a request; None if it has.

        The new worker does what the old one was asked to. An event says what is left alone.
        """
        if not request.claim():
            return None
        hung = self.worker
        self.worker = hung.successor()
        self._left_alone = (*(one for one in self._left_alone if not one.has_ended), hung)
        self.gate.reconnected()
        self.mailbox.repeat_connection_request(request)
        self._emit(
            Alarmed(
                message(
                    "engine",
                    "{name} has not answered for {seconds} s and could not be disconnected: the "
                    "program leaves it alone. If its machine moves, use its emergency stop "
                    "switch; check cable and device",
                ).fill(name=hung.driver.name, seconds=rounded(patience_s, 2))
            )
        )
        return self.worker

    def _request(self, driver: Driver | None) -> ConnectionRequest:
        request = ConnectionRequest(driver)
        self.mailbox.request_connection(request)
        return request

    def ask(self, action: Callable[[Driver, Permit], None], permit: Permit | None = None) -> None:
        """Have something done on the thread that talks to the driver.

        Raises
        ------
        RefusedError
            If the device is not connected, the permit passes no more, or the queue is full.
        """
        permit = self.gate.permit(Purpose.ENQUIRY) if permit is None else permit
        self.refuse_unconnected()
        self.mailbox.post(Ask(action), permit)

    def ask_able(
        self,
        ability: type[A],
        refusal: Message,
        action: Callable[[A, Permit], None],
        permit: Permit | None = None,
    ) -> None:
        """Have something done by a driver that has an ability.

        Raises
        ------
        RefusedError
            As :func:`able` and :meth:`ask`.
        """
        able(self.driver, ability, refusal)

        def act(driver: Driver, permit: Permit) -> None:
            assert isinstance(driver, ability), "the session refuses on any other"
            action(driver, permit)

        self.ask(act, permit)

    def refuse_unconnected(self) -> None:
        """Refuse a request that needs a connection if there is none.

        Raises
        ------
        RefusedError
            With what is missing.
        """
        state = self.worker.state
        if state.connection is not Connection.CONNECTED:
            raise RefusedError(state.locked or NOT_CONNECTED)

    def stop(self, request: StopRequest, latch: str | None = None) -> None:
        """Close the gate for earlier requests, empty the queue, stop all drivers that may be open.

        Never waits and never raises. With ``latch`` nothing moves until the gate is released.
        """
        asked_s = self.clock()
        self._stop, self.stop_asked_s = request, asked_s
        # During an exchange the worker still has the previous driver.
        drivers = dict.fromkeys((self.worker.driver, self.driver))
        self.gate.stop(latch)
        self._stop_epoch = self.gate.epoch
        self.mailbox.clear()
        for worker in self._left_alone:
            if not worker.has_ended:
                with suppress(Exception):  # nobody relies on a device that hangs
                    worker.driver.halt()
        failure = None
        for driver in drivers:
            try:
                driver.halt()
            except Exception as error:  # told by the worker: a stop button must not raise
                failure = error
        self.worker.stopped(asked_s, failure, request)

    def note_accepted(self, epoch: Epoch) -> None:
        """Note that the machine is operated again: a stop before this epoch is history."""
        self._accepted_epoch = epoch

    @property
    def is_untouched_since_stop(self) -> bool:
        """Whether nothing has moved, and no motion was accepted, since the latest stop."""
        accepted, stopped = self._accepted_epoch.stops, self._stop_epoch.stops
        return accepted < stopped and self.worker.is_resting_since_stop

    def snapshot(self) -> SessionState:
        """Return the present state, without the tip's."""
        state = self.worker.state
        if self.worker.driver is not self.driver:
            # Nothing that the device before said is true of the one that is being connected.
            state = SessionState(connection=Connection.CONNECTING)
        age_s, silent_s = self._age_s(state), state.silent_s
        if self._is_stale(state):
            silent_s = max(silent_s, age_s or 0.0)
        now, stopped = self.gate.epoch, self._stop_epoch
        same = (now.releases, now.connections) == (stopped.releases, stopped.connections)
        latched = self.gate.latched
        locked = self._locked(state)
        if latched is not None:
            locked = message("engine", "{stop} is active; release it first").fill(stop=latched)
        return replace(
            state,
            age_s=age_s,
            silent_s=silent_s,
            locked=locked,
            queued=len(self.mailbox),
            stop=self._stop,
            halted=same and self.is_untouched_since_stop,
            latched=latched,
            owners=self.worker.ownership.owners,
            stop_latency=self.worker.latency.figures(),
        )

    def unready(self, state: SessionState) -> str | None:
        """Return why nothing can be done that needs a sound device, but no known position."""
        if self.worker.driver is not self.driver:
            return _EXCHANGED
        if state.connection is not Connection.CONNECTED or state.fault or state.silent_s > 0.0:
            return state.locked or message("engine", "not connected")
        return self.barred

    def _locks(self, permit: Permit) -> str | None:
        """Return the locks on a permit's purpose besides a stop; under the gate's lock."""
        state = self.worker.state
        if permit.purpose is Purpose.MOTION:
            locked = self._locked(state)
        elif permit.purpose is Purpose.HOMING:
            locked = self.unready(state)
        else:
            return None
        other = permit.owner and self.worker.ownership.other_than(permit.owner, permit.axes)
        if locked or not other:
            return locked
        return message("engine", "an axis is driven by {other}").fill(other=other)

    def _locked(self, state: SessionState) -> str | None:
        """Return why no motion is accepted, but for a latch."""
        if self.worker.driver is not self.driver:
            return _EXCHANGED
        if state.locked is None and self._is_stale(state):
            return message(
                "engine", "the device has sent nothing for {seconds} s; wait, or reconnect"
            ).fill(seconds=fixed(self._age_s(state) or 0.0, 1))
        return state.locked or self.barred

    def _is_stale(self, state: SessionState) -> bool:
        """Return whether a connected device should have sent a sample long ago."""
        age_s = self._age_s(state)
        connected = state.connection is Connection.CONNECTED
        return connected and age_s is not None and age_s > self._stale_after_s

    def _age_s(self, state: SessionState) -> float | None:
        received_s = state.sample_host_time_s
        return None if received_s is None else self.clock() - received_s
