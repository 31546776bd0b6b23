"""Applies changes of effects to the running simulator, one at a time, and reports the outcome."""

from enum import Enum, auto

from PySide6.QtCore import QElapsedTimer, QObject, QTimer, Signal

from rotemina.app.language import describe_error, translate_message
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    CommandRefused,
    ConnectionState,
    SessionEvent,
    SessionState,
)
from rotemina.plugins.effects import tr
from rotemina.sim.errors import InputError
from rotemina.sim.robot import AxisEffect

# While a slider is dragged, changes are sent at most once in this time.
MIN_CHANGE_INTERVAL_MS = 120

# If a change takes longer than this, the operator is shown that it is being prepared.
PREPARING_AFTER_MS = 300

# A command has been executed this many cycles after the worker has taken it from the queue.
_COMPLETION_CYCLES = 2

Effects = tuple[AxisEffect, ...]


class ApplyState(Enum):
    """State of the latest requested change."""

    APPLIED = auto()
    UNDER_WAY = auto()
    PREPARING = auto()
    REFUSED = auto()


class LiveEffects(QObject):
    """Sends effects to a session and tracks whether they are applied, without blocking.

    The session checks a change at once. Its worker thread applies the change later, and compiles
    an effect when it is first used. Of the changes requested in the meantime, only the newest is
    kept.

    Signals
    -------
    changed() : ``apply_state`` or ``reason`` changed.
    refused(str) : the session refused a change at once. The workbench shows later refusals.
    replaced(tuple or None) : something else replaced the effects, or the device has none.
    """

    changed = Signal()
    refused = Signal(str)
    replaced = Signal(object)
    _event_received = Signal(object)

    def __init__(self, session: MotionSession, parent: QObject) -> None:
        super().__init__(parent)
        self._session = session
        self.apply_state = ApplyState.APPLIED
        self.reason = ""
        self._last_effects = session.service.effects
        self._waiting_effects: Effects | None = None
        self._sent_effects: Effects | None = None
        self._refusal = ""
        self._attempts = 0
        self._cycle_times_s: list[float | None] = []
        self._clock = QElapsedTimer()
        self._pause = QTimer(self, interval=MIN_CHANGE_INTERVAL_MS, singleShot=True)
        self._pause.timeout.connect(self._send)
        self._event_received.connect(self._on_event)
        self.destroyed.connect(session.subscribe(self._event_received.emit))

    def request(self, effects: Effects) -> None:
        """Apply effects soon. Of requests in quick succession, only the last one is applied."""
        self._waiting_effects, self._attempts = effects, 0
        self._set_state(ApplyState.UNDER_WAY)
        if not self._pause.isActive():
            self._pause.start()

    def refresh(self, state: SessionState) -> None:
        """Check the outcome of the running change. Call this in every frame."""
        current_effects = self._session.service.effects
        if self._sent_effects is None:
            self._report_replacement(current_effects)
        elif current_effects == self._sent_effects:
            self._finish(ApplyState.APPLIED)
        elif state.connection is not ConnectionState.CONNECTED:
            reason = (
                translate_message(state.lock_reason) if state.lock_reason else tr("not connected")
            )
            self._finish(ApplyState.REFUSED, reason)
        elif self._is_done(state):
            self._retry_or_refuse()
        elif self._clock.elapsed() >= PREPARING_AFTER_MS:
            self._set_state(ApplyState.PREPARING)

    def _send(self) -> None:
        # While a change is running, the next one waits: `_finish` sends it.
        if self._waiting_effects is None or self._sent_effects is not None:
            return
        effects, self._waiting_effects = self._waiting_effects, None
        self._attempts += 1
        self._refusal, self._cycle_times_s = "", []
        try:
            self._session.service.set_effects(effects)
        except InputError as error:
            self._set_state(ApplyState.REFUSED, describe_error(error))
            self.refused.emit(describe_error(error))
            return
        self._sent_effects = effects
        self._clock.start()

    def _report_replacement(self, current_effects: Effects | None) -> None:
        """Emit ``replaced`` if the effects have changed without a request of this object."""
        is_replaced = current_effects != self._last_effects
        self._last_effects = current_effects
        if is_replaced and self._waiting_effects is None:
            self.replaced.emit(current_effects)

    def _is_done(self, state: SessionState) -> bool:
        """Return whether the worker has taken the command and has finished enough cycles since.

        Each new device time counts as a cycle. During a fault the device time stands still, so the
        elapsed time decides instead.
        """
        if state.queued:
            return False
        if state.fault is not None:
            return bool(self._refusal) or self._clock.elapsed() >= PREPARING_AFTER_MS
        if state.device_time_s not in self._cycle_times_s:
            self._cycle_times_s.append(state.device_time_s)
        return len(self._cycle_times_s) > _COMPLETION_CYCLES

    def _retry_or_refuse(self) -> None:
        """Report a refused change, or send one again that a stop has removed from the queue."""
        if self._refusal or self._attempts > 1:
            self._finish(
                ApplyState.REFUSED, self._refusal or tr("the simulator did not accept the change")
            )
            return
        self._waiting_effects = self._waiting_effects or self._sent_effects
        self._sent_effects = None
        self._send()

    def _finish(self, state: ApplyState, reason: str = "") -> None:
        self._sent_effects, self._last_effects = None, self._session.service.effects
        if self._waiting_effects is None:
            self._set_state(state, reason)
        elif not self._pause.isActive():
            self._send()

    def _set_state(self, state: ApplyState, reason: str = "") -> None:
        if (state, reason) != (self.apply_state, self.reason):
            self.apply_state, self.reason = state, reason
            self.changed.emit()

    def _on_event(self, event: SessionEvent) -> None:
        if self._sent_effects is not None and isinstance(event, CommandRefused):
            self._refusal = event.message
