"""Stop, and stop and lock, by key and button, whatever else is open or has the focus."""

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

from rotemina.app.language import marked, translate, translate_message
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.text import FittedButton
from rotemina.app.workbench import OperatorRequests
from rotemina.drivers.contract import Clock

# A second press in panic must not release the lock that the first one set.
MIN_RELEASE_DELAY_S = 1.0
# A second press within this time locks, which is the safer state for someone in panic.
MAX_DOUBLE_PRESS_S = 1.0
# Finds windows that opened by themselves without getting the focus.
_WINDOW_CHECK_MS = 100
_INPUT_EVENTS = frozenset(
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
_SOFTWARE_STOP_NOTE = marked(
    "shell", "This is a stop by software, not the machine's emergency stop switch."
)


class StopInputFilter(QObject):
    """Event filter that stops all motion on Esc and on clicks on the stop buttons.

    It works whatever else is open or has the focus. Shift+Esc locks, and so does a second Esc
    within a second. The event then continues to its receiver, so that Esc also closes a dialog.

    Every key and every click reaches a window before any widget in it, so the windows are filtered.
    A filter on the application would be called in Python for each of the thousands of events
    between widgets, and would wait each time for other running Python code. But an input can open a
    menu that receives the next input before its window is known. Therefore the application is
    filtered from each input until the input is handled completely, and while a menu is open.
    """

    _input_received = Signal()

    def __init__(
        self,
        requests: OperatorRequests,
        stop: QPushButton,
        emergency: QPushButton,
        parent: QObject,
        clock: Clock = time.monotonic,
    ) -> None:
        super().__init__(parent)
        self._requests = requests
        self._escape = DoublePress(clock)
        self._is_escape_down = False
        self._stop_buttons = ((stop, requests.stop), (emergency, requests.emergency_stop))
        self._filters_application = False
        self._is_closed = False
        self._window_timer = QTimer(self, interval=_WINDOW_CHECK_MS)
        self._window_timer.timeout.connect(self._watch_windows_only)

    def start(self) -> None:
        """Filter every window of the program, including those that open later."""
        _get_application().focusWindowChanged.connect(self._watch)
        self._input_received.connect(self._watch_windows_only, Qt.ConnectionType.QueuedConnection)
        self._window_timer.start()
        self._watch_all()

    def close(self) -> None:
        """Stop filtering, because nothing is left that could be stopped."""
        gui = _get_application()
        self._is_closed = True
        self._window_timer.stop()
        for watched in (gui, *gui.allWindows()):
            watched.removeEventFilter(self)

    def _watch_all(self) -> None:
        for window in _get_application().allWindows():
            self._watch(window)

    def _watch(self, window: QWindow | None) -> None:
        if window is not None and not self._is_closed:
            window.installEventFilter(self)

    def _watch_windows_only(self) -> None:
        """Filter only windows again, including those that the input opened."""
        self._watch_all()
        if self._filters_application and QApplication.activePopupWidget() is None:
            self._filters_application = False
            _get_application().removeEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Stop if the event requests it, and let the event continue."""
        if event.type() in _INPUT_EVENTS and not (self._filters_application or self._is_closed):
            self._filters_application = True
            _get_application().installEventFilter(self)
            self._input_received.emit()
        if isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_Escape:
            if event.type() == QEvent.Type.KeyPress:
                self._on_escape(event)
            elif event.type() == QEvent.Type.KeyRelease and not event.isAutoRepeat():
                self._is_escape_down = False
        elif isinstance(event, QMouseEvent) and event.type() == QEvent.Type.MouseButtonPress:
            self._on_click(event)
        return False

    def _on_click(self, event: QMouseEvent) -> None:
        """Stop if a stop button was pressed, even if an open menu receives the click."""
        position = event.globalPosition().toPoint()
        for button, stop in self._stop_buttons:
            is_over = button.isVisible() and button.rect().contains(button.mapFromGlobal(position))
            # While locked, a press on the lock button means to release; the button handles that
            # itself.
            if is_over and not (
                button.isCheckable() and self._requests.session.snapshot().latch_reason
            ):
                stop()

    def _on_escape(self, event: QKeyEvent) -> None:
        # One press is seen several times: at its window, at a widget and at the widget's parents.
        is_double_press = not self._is_escape_down and self._escape.register_press()
        self._is_escape_down = True
        if is_double_press or event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self._requests.emergency_stop()
        else:
            self._requests.stop()


class DoublePress:
    """Detector of a press that follows another one within a second."""

    def __init__(self, clock: Clock = time.monotonic) -> None:
        self._clock = clock
        self._last_press_s = -MAX_DOUBLE_PRESS_S

    def register_press(self) -> bool:
        """Record a press; return whether it follows another one within a second."""
        previous_s, self._last_press_s = self._last_press_s, self._clock()
        return self._last_press_s - previous_s < MAX_DOUBLE_PRESS_S


def _get_application() -> QGuiApplication:
    application = QApplication.instance()
    assert isinstance(application, QGuiApplication)
    return application


class EmergencyButton(FittedButton):
    """Button that stops and locks, shows the lock, and releases it when pressed again."""

    def __init__(self, requests: OperatorRequests, clock: Clock = time.monotonic) -> None:
        super().__init__(translate("shell", "Stop and lock"))
        self.setObjectName("emergency")
        self.setCheckable(True)
        # Without the focus, the space bar cannot release the lock.
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setAccessibleName(translate("shell", "Stop and lock"))
        self._requests, self._clock = requests, clock
        self._latched_at_s: float | None = None
        self._show(None)
        self.pressed.connect(self._press)
        self.clicked.connect(lambda _: self._show(requests.session.snapshot().latch_reason))

    def refresh(self, state: SessionState) -> None:
        """Show whether the machine is locked, by this button or otherwise."""
        if not self.isDown():
            self._show(state.latch_reason)

    def _press(self) -> None:
        # The state of the last frame may be older than the lock, so the state is read again.
        self._show(self._requests.session.snapshot().latch_reason)
        if self._latched_at_s is None:
            self._requests.emergency_stop()
            self._latched_at_s = self._clock()
        elif self._clock() - self._latched_at_s >= MIN_RELEASE_DELAY_S:
            self._requests.release()

    def _show(self, latched: str | None) -> None:
        if latched is None:
            self._latched_at_s = None
        elif self._latched_at_s is None:
            self._latched_at_s = self._clock()
        self.setChecked(latched is not None)
        self.setText(
            _break_at_last_space(
                translate("shell", "Stop and lock")
                if latched is None
                else translate("shell", "Locked – release")
            )
        )
        tooltip_lines = (
            (
                translate("shell", "Stop all axes and block motion until release (Shift+Esc)."),
                translate("shell", _SOFTWARE_STOP_NOTE),
            )
            if latched is None
            else (
                translate("shell", "Locked: {latched}.").format(latched=translate_message(latched)),
                translate("shell", "Press to release; nothing moves without a command."),
            )
        )
        self.setToolTip(make_tooltip(*tooltip_lines))

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw a padlock at the left, closed while the machine is locked."""
        super().paintEvent(event)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        colour = self.palette().buttonText().color()
        painter.translate(0.0, self.height() / 2.0)
        # The padlock grows with the text.
        painter.scale(*(2 * (QFontInfo(self.font()).pixelSize() / 13.0,)))
        body = QRectF(8.0, -1.0, 10.0, 8.0)
        shackle = QRectF(body.left() + 2.0, body.top() - 6.0, 6.0, 12.0)
        if not self.isChecked():
            shackle.translate(4.0, 0.0)
        painter.setPen(QPen(colour, 1.5))
        painter.drawArc(shackle, 0, 180 * 16)
        painter.fillRect(body, colour)


def _break_at_last_space(text: str) -> str:
    return "\n".join(text.rsplit(" ", 1))


class StopButton(FittedButton):
    """Button that stops when it is pressed, not when it is released: a stop must not wait."""

    def __init__(self, requests: OperatorRequests) -> None:
        super().__init__(translate("shell", "STOP (Esc)"))
        self.setObjectName("stop")
        self.setToolTip(
            make_tooltip(
                translate(
                    "shell",
                    "Stop all axes and hold their positions (Esc); a second press within 1 s "
                    "locks.",
                ),
                translate("shell", _SOFTWARE_STOP_NOTE),
            )
        )
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        double_press = DoublePress()
        self.pressed.connect(
            lambda: requests.emergency_stop() if double_press.register_press() else requests.stop()
        )
