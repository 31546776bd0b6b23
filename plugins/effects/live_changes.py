"""Changes of effects on the running simulator: one at a time, with the outcome."""

from enum import Enum, auto

from PySide6.QtCore import QElapsedTimer, QObject, QTimer, Signal

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import CommandRefused, Connection, Event, SessionState
from rotemina.app.shell.engine_words import error_text, spoken
from rotemina.plugins.effects import tr
from rotemina.sim.errors import InputError
from rotemina.sim.robot.model import AxisEffect

PAUSE_MS = 120  # a slider that is dragged changes the simulator this often at most
LONG_MS = 300  # from here on the operator is told that something is being prepared
_CYCLES = 2  # of the worker, after which a command that was taken has been done

Effects = tuple[AxisEffect, ...]


class ApplyState(Enum):
    """The state of a request relative to the simulator."""

    APPLIED = auto()
    UNDER_WAY = auto()
    PREPARING = auto()
    REFUSED = auto()


class LiveEffects(QObject):
    """Sends effects to a session, and follows the outcome; never waits.

    The session checks at once and its worker does the rest, on its own thread: a first use compiles
    there. While a change is on its way the next one waits, and only the newest.

    Signals
    -------
    changed() : ``apply_state`` or ``reason`` did.
    refused(str) : at once, by the session. What its worker refuses, the workbench tells.
    replaced(tuple) : someone else put other effects in place.
    """

    changed = Signal()
    refused = Signal(str)
    replaced = Signal(object)
    _happened = Signal(object)

    def __init__(self, session: MotionSession, parent: QObject) -> None:
        super().__init__(parent)
        self._session = session
        self.apply_state = ApplyState.APPLIED
        self.reason = ""
        self._seen = session.service.effects
        self._wanted: Effects | None = None
        self._sent: Effects | None = None
        self._told = ""
        self._tries = 0
        self._cycles: list[float | None] = []
        self._clock = QElapsedTimer()
        self._pause = QTimer(self, interval=PAUSE_MS, singleShot=True)
        self._pause.timeout.connect(self._send)
        self._happened.connect(self._on_event)
        self.destroyed.connect(session.subscribe(self._happened.emit))

    def ask(self, effects: Effects) -> None:
        """Have effects put in place soon; of several that are asked in a row the last."""
        self._wanted, self._tries = effects, 0
        self._stand(ApplyState.UNDER_WAY)
        if not self._pause.isActive():
            self._pause.start()

    def refresh(self, state: SessionState) -> None:
        """Check the outcome of the running change; once a frame."""
        now = self._session.service.effects
        if self._sent is None:
            self._notice_others(now)
        elif now == self._sent:
            self._end(ApplyState.APPLIED)
        elif state.connection is not Connection.CONNECTED:
            why = spoken(state.locked) if state.locked else tr("not connected")
            self._end(ApplyState.REFUSED, why)
        elif self._was_done(state):
            self._not_taken()
        elif self._clock.elapsed() >= LONG_MS:
            self._stand(ApplyState.PREPARING)

    def _send(self) -> None:
        if self._wanted is None or self._sent is not None:
            return  # what is under way comes first; its end sends the rest
        effects, self._wanted = self._wanted, None
        self._tries += 1
        self._told, self._cycles = "", []
        try:
            self._session.service.set_effects(effects)
        except InputError as error:
            self._stand(ApplyState.REFUSED, error_text(error))
            self.refused.emit(error_text(error))
            return
        self._sent = effects
        self._clock.start()

    def _notice_others(self, now: Effects | None) -> None:
        changed, self._seen = now != self._seen, now
        if changed and self._wanted is None:
            self.replaced.emit(now)

    def _was_done(self, state: SessionState) -> bool:
        """Whether the worker took the command and has done whole cycles since.

        Cycles are told by the device's time, which stands still in a fault.
        """
        if state.queued:
            return False
        if state.fault is not None:
            return bool(self._told) or self._clock.elapsed() >= LONG_MS
        if state.device_time_s not in self._cycles:
            self._cycles.append(state.device_time_s)
        return len(self._cycles) > _CYCLES

    def _not_taken(self) -> None:
        """Send again what a stop swept out of the queue; tell of what was refused."""
        if self._told or self._tries > 1:
            self._end(
                ApplyState.REFUSED, self._told or tr("the simulator did not accept the change")
            )
            return
        self._wanted = self._wanted or self._sent
        self._sent = None
        self._send()

    def _end(self, standing: ApplyState, reason: str = "") -> None:
        self._sent, self._seen = None, self._session.service.effects
        if self._wanted is None:
            self._stand(standing, reason)
        elif not self._pause.isActive():
            self._send()

    def _stand(self, standing: ApplyState, reason: str = "") -> None:
        if (standing, reason) != (self.apply_state, self.reason):
            self.apply_state, self.reason = standing, reason
            self.changed.emit()

    def _on_event(self, event: Event) -> None:
        if self._sent is not None and isinstance(event, CommandRefused):
            self._told = event.message
