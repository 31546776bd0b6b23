"""Stop, and stop and lock: by key and by button, whatever else is open or has the focus."""

import time

from PySide6.QtCore import QEvent, QObject, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import (
    QFontInfo,
    QGuiApplication,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QWindow,
)
from PySide6.QtWidgets import QApplication, QPushButton

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.operator_requests import Requests
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.fitted_text import FittedButton
from rotemina.drivers.clock import Clock

RELEASE_AFTER_S = 1.0  # a second press in alarm must not release what the first one latched
LOCKS_WITHIN_S = 1.0  # of a first press, a second one: alarm leads to the safer state
_LOOK_MS = 100  # for windows that opened by themselves and have no focus
_INPUT = frozenset(
    {
        QEvent.Type.KeyPress,
        QEvent.Type.KeyRelease,
        QEvent.Type.MouseButtonPress,
        QEvent.Type.MouseButtonRelease,
        QEvent.Type.MouseButtonDblClick,
        QEvent.Type.Wheel,
        QEvent.Type.TouchBegin,
        QEvent.Type.TouchEnd,
        QEvent.Type.TabletPress,
        QEvent.Type.TabletRelease,
    }
)
_SOFTWARE = marked("shell", "This is a stop by software, not the machine's emergency stop switch.")


class StopWatch(QObject):
    """Stops all motion on Esc and on the stop buttons, whatever else is open or has the focus.

    Shift+Esc locks, and so does a second Esc within a second. The event continues to where it was
    meant for, so that Esc closes a dialog too.

    Every key and every click reaches a window before any widget in it, so windows are what is
    watched: a filter of the whole program would be called in Python for each of the thousands of
    events that widgets send each other, and would wait each time for what else runs there. Only an
    input can open a menu that takes the next one before it is known; so the whole program is
    watched from an input until all that it did is done, and while a menu is open.
    """

    _input_came = Signal()

    def __init__(
        self,
        requests: Requests,
        stop: QPushButton,
        emergency: QPushButton,
        parent: QObject,
        clock: Clock = time.monotonic,
    ) -> None:
        super().__init__(parent)
        self._requests = requests
        self._escape = SecondPress(clock)
        self._down = False
        self._stops = ((stop, requests.stop), (emergency, requests.emergency_stop))
        self._alert = False  # whether the whole program is watched
        self._ended = False
        self._looks = QTimer(self, interval=_LOOK_MS)
        self._looks.timeout.connect(self._rest)

    def start(self) -> None:
        """Watch every window of the program, also those that open later."""
        _application().focusWindowChanged.connect(self._watch)
        self._input_came.connect(self._rest, Qt.ConnectionType.QueuedConnection)
        self._looks.start()
        self._watch_all()

    def close(self) -> None:
        """End: nothing is left that could be stopped."""
        gui = _application()
        self._ended = True
        self._looks.stop()
        for watched in (gui, *gui.allWindows()):
            watched.removeEventFilter(self)

    def _watch_all(self) -> None:
        for window in _application().allWindows():
            self._watch(window)

    def _watch(self, window: QWindow | None) -> None:
        if window is not None and not self._ended:
            window.installEventFilter(self)

    def _rest(self) -> None:
        """Watch windows alone again, with those that the input has opened."""
        self._watch_all()
        if self._alert and QApplication.activePopupWidget() is None:
            self._alert = False
            _application().removeEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Stop, and let the event pass."""
        if event.type() in _INPUT and not (self._alert or self._ended):
            self._alert = True
            _application().installEventFilter(self)
            self._input_came.emit()
        if isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_Escape:
            if event.type() == QEvent.Type.KeyPress:
                self._press(event)
            elif event.type() == QEvent.Type.KeyRelease and not event.isAutoRepeat():
                self._down = False
        elif isinstance(event, QMouseEvent) and event.type() == QEvent.Type.MouseButtonPress:
            self._click(event)
        return False

    def _click(self, event: QMouseEvent) -> None:
        """Stop where a button was pressed although a menu that is open takes the click."""
        at = event.globalPosition().toPoint()
        for button, stop in self._stops:
            over = button.isVisible() and button.rect().contains(button.mapFromGlobal(at))
            # A press on the lock that is closed means to release it, which is the button's own.
            if over and not (button.isCheckable() and self._requests.session.snapshot().latched):
                stop()

    def _press(self, event: QKeyEvent) -> None:
        # One press comes by again and again: through its window, to a widget, to its parents.
        again = not self._down and self._escape.again()
        self._down = True
        if again or event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self._requests.emergency_stop()
        else:
            self._requests.stop()


class SecondPress:
    """Tells whether a press follows another one within a second."""

    def __init__(self, clock: Clock = time.monotonic) -> None:
        self._clock = clock
        self._pressed_s = -LOCKS_WITHIN_S

    def again(self) -> bool:
        """Note a press; return whether there was one just before."""
        before_s, self._pressed_s = self._pressed_s, self._clock()
        return self._pressed_s - before_s < LOCKS_WITHIN_S


def _application() -> QGuiApplication:
    application = QApplication.instance()
    assert isinstance(application, QGuiApplication)
    return application


class EmergencyButton(FittedButton):
    """Stops and locks, shows that the machine is locked, and releases it by another press."""

    def __init__(self, requests: Requests, clock: Clock = time.monotonic) -> None:
        super().__init__(translate("shell", "Stop and lock"))
        self.setObjectName("emergency")
        self.setCheckable(True)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # no space bar may release it
        self.setAccessibleName(translate("shell", "Stop and lock"))
        self._requests, self._clock = requests, clock
        self._latched_at_s: float | None = None
        self._show(None)
        self.pressed.connect(self._press)
        self.clicked.connect(lambda _: self._show(requests.session.snapshot().latched))

    def refresh(self, state: SessionState) -> None:
        """Show whether it is latched, whoever did that."""
        if not self.isDown():
            self._show(state.latched)

    def _press(self) -> None:
        self._show(self._requests.session.snapshot().latched)  # now, not at the last frame
        if self._latched_at_s is None:
            self._requests.emergency_stop()
            self._latched_at_s = self._clock()
        elif self._clock() - self._latched_at_s >= RELEASE_AFTER_S:
            self._requests.release()

    def _show(self, latched: str | None) -> None:
        if latched is None:
            self._latched_at_s = None
        elif self._latched_at_s is None:
            self._latched_at_s = self._clock()
        self.setChecked(latched is not None)
        self.setText(
            _two_lines(
                translate("shell", "Stop and lock")
                if latched is None
                else translate("shell", "Locked – release")
            )
        )
        tip = (
            (
                translate("shell", "Stop all axes and block motion until release (Shift+Esc)."),
                translate("shell", _SOFTWARE),
            )
            if latched is None
            else (
                translate("shell", "Locked: {latched}.").format(latched=spoken(latched)),
                translate("shell", "Press to release; nothing moves without a command."),
            )
        )
        self.setToolTip(plain_tip(*tip))

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw a lock at the left, shut while the machine is locked."""
        super().paintEvent(event)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        colour = self.palette().buttonText().color()
        painter.translate(0.0, self.height() / 2.0)
        painter.scale(*(2 * (QFontInfo(self.font()).pixelSize() / 13.0,)))  # as large as the text
        body = QRectF(8.0, -1.0, 10.0, 8.0)
        shackle = QRectF(body.left() + 2.0, body.top() - 6.0, 6.0, 12.0)
        if not self.isChecked():
            shackle.translate(4.0, 0.0)
        painter.setPen(QPen(colour, 1.5))
        painter.drawArc(shackle, 0, 180 * 16)
        painter.fillRect(body, colour)


def _two_lines(text: str) -> str:
    """Return a text broken at its last space."""
    return "\n".join(text.rsplit(" ", 1))


class StopButton(FittedButton):
    """Stops on pressing, not on release: a stop must not wait for the finger to lift."""

    def __init__(self, requests: Requests) -> None:
        super().__init__(translate("shell", "STOP (Esc)"))
        self.setObjectName("stop")
        self.setToolTip(
            plain_tip(
                translate(
                    "shell",
                    "Stop all axes and hold their positions (Esc); a second press within 1 s "
                    "locks.",
                ),
                translate("shell", _SOFTWARE),
            )
        )
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        second = SecondPress()
        self.pressed.connect(
            lambda: requests.emergency_stop() if second.again() else requests.stop()
        )
