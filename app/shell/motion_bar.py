"""The tool bar of motion: phase, what the robot does, emergency stop and stop, always in sight."""

import time
from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QLabel, QPushButton, QToolBar

from rotemina.app.motion.state import Connection, SessionState
from rotemina.app.shell.controls import ElidedLabel, plain_tip
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.model_chip import ModelChip
from rotemina.app.shell.phase import PhaseLabel, doing
from rotemina.app.shell.requests import Requests
from rotemina.app.shell.workbench import Workbench
from rotemina.drivers.clock import Clock

RELEASE_AFTER_S = 1.0  # a second press in alarm must not release what the first one latched
_SOFTWARE = marked("shell", "This is a stop by software, not the machine's emergency switch.")


class StopWatch(QObject):
    """Stops all motion on Esc and on the stop buttons, whatever else is open or has the focus.

    Shift+Esc latches, and so does the emergency button; only that releases what it latched. The
    event goes on to where it was meant for, so that Esc closes a dialog too.
    """

    def __init__(
        self, requests: Requests, stop: QPushButton, emergency: QPushButton, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._requests = requests
        self._stops = ((stop, requests.stop), (emergency, requests.emergency_stop))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Stop, and let the event pass."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            self._press(event)
        elif isinstance(event, QMouseEvent) and event.type() == QEvent.Type.MouseButtonPress:
            self._click(event)
        return False

    def _click(self, event: QMouseEvent) -> None:
        """Stop where a button was pressed although a menu that is open takes the click."""
        at = event.globalPosition().toPoint()
        for button, stop in self._stops:
            over = button.isVisible() and button.rect().contains(button.mapFromGlobal(at))
            if over and not button.isChecked():
                stop()

    def _press(self, event: QKeyEvent) -> None:
        if event.key() != Qt.Key.Key_Escape:
            return
        if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self._requests.emergency_stop()
        else:
            self._requests.stop()


class EmergencyButton(QPushButton):
    """Latches the emergency stop, shows that it is latched, and releases it by another press."""

    def __init__(self, requests: Requests, clock: Clock = time.monotonic) -> None:
        super().__init__(translate("shell", "E-STOP"))
        self.setObjectName("emergency")
        self.setCheckable(True)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # no space bar may release it
        self.setAccessibleName(translate("shell", "Emergency stop"))
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
            translate("shell", "E-STOP")
            if latched is None
            else translate("shell", "Latched – release")
        )
        tip = (
            (
                translate(
                    "shell", "Stop all axes, and let nothing move until it is released (Shift+Esc)."
                ),
                translate("shell", _SOFTWARE),
            )
            if latched is None
            else (
                translate("shell", "Latched: {latched}.").format(latched=spoken(latched)),
                translate("shell", "Press to release; nothing moves until it is told to."),
            )
        )
        self.setToolTip(plain_tip(*tip))


class MotionBar(QToolBar):
    """Phase and stops; it can neither be moved nor hidden."""

    def __init__(self, requests: Workbench) -> None:
        super().__init__(translate("shell", "Motion"))
        self.setObjectName("motion")
        self.setMovable(False)
        self.toggleViewAction().setVisible(False)  # the stop button is always in sight
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        title = QLabel(requests.robot.name)
        title.setProperty("heading", True)
        title.setTextFormat(Qt.TextFormat.PlainText)
        self.phase, self.doing = PhaseLabel(), ElidedLabel()
        self.doing.setProperty("quiet", True)
        self.reconnect = _button(
            translate("shell", "Reconnect"),
            translate("shell", "Connect again to the device"),
            requests.reconnect,
        )
        self.emergency = EmergencyButton(requests)
        self.stop = QPushButton(translate("shell", "STOP"))
        self.stop.setObjectName("stop")
        self.stop.setToolTip(
            plain_tip(
                translate("shell", "Stop all axes and hold (Esc)."), translate("shell", _SOFTWARE)
            )
        )
        self.stop.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        # On pressing, not on release: a stop must not wait for the finger to lift.
        self.stop.pressed.connect(requests.stop)
        self.model = ModelChip(requests)
        for widget in (title, self.phase, self.doing, self.model):
            self.addWidget(widget)
        self._offer = self.addWidget(self.reconnect)
        self._offer.setVisible(False)
        for widget in (self.emergency, self.stop):
            self.addWidget(widget)

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        self.phase.show_state(state)
        self.doing.show_text(doing(state))
        self.emergency.refresh(state)
        self.model.refresh(state)
        self._offer.setVisible(state.connection is Connection.FAILED)


def _button(text: str, tip: str, run: Callable[[], object]) -> QPushButton:
    button = QPushButton(text)
    button.setToolTip(tip)
    button.clicked.connect(lambda _: run())
    return button
