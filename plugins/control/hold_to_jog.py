"""Hold-to-jog: an axis moves only while its button is held."""

import time
from contextlib import suppress

from PySide6.QtCore import QEvent, QObject, Qt, QTimer
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QPushButton

from rotemina.app.shell.workbench import Workbench
from rotemina.drivers.clock import Clock
from rotemina.drivers.gate import Permit
from rotemina.sim.errors import InputError

RENEW_MS = 50  # well within the lease of a speed
REPEATED_S = 1.0  # a key that repeats no more for so long is let go of, whoever saw that


class Holding(QObject):
    """Renews the speed of one axis while a button is down.

    A stop, release, loss of focus, another window or program, a locked screen, a menu or dialog, a
    modifier key, a dock that is hidden or a button that is locked end it; so does a key that stops
    repeating, for its release may be lost, and a window that hangs, because nobody renews the lease
    then. After a stop the button has to be pressed again.
    """

    def __init__(
        self, workbench: Workbench, axis: str, parent: QObject, clock: Clock = time.monotonic
    ) -> None:
        super().__init__(parent)
        self._workbench, self._axis = workbench, axis
        self._button: QPushButton | None = None
        self._speed, self._clock = 0.0, clock
        self._permit: Permit | None = None  # of the press: a stop since then ends it
        self._key_s: float | None = None  # when the key said last that it is down
        self._modifiers = Qt.KeyboardModifier.NoModifier
        self._renewing = QTimer(self, interval=RENEW_MS)
        self._renewing.timeout.connect(self._renew)

    @property
    def busy(self) -> bool:
        """Whether the axis is being driven."""
        return self._button is not None

    def watch(self, button: QPushButton) -> None:
        """Tell presses by a key from those by the mouse; once for each button."""
        button.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Note how the button is held; a key says so again and again."""
        if event.type() == QEvent.Type.KeyPress:
            self._key_s = self._clock()
        elif event.type() == QEvent.Type.MouseButtonPress:
            self._key_s = None
        return False

    def begin(self, button: QPushButton, speed: float) -> None:
        """Go at a speed, m/s or rad/s, while the button is held."""
        self._button, self._speed = button, speed
        self._permit = self._workbench.session.permit()
        self._modifiers = QGuiApplication.keyboardModifiers()
        self._renewing.start()
        self._renew()

    def end(self) -> None:
        """Halt the axis."""
        if self._button is None:
            return
        self._button = None
        self._renewing.stop()
        # Stopped, locked or another's by now, it is refused; the lease ends by itself.
        with suppress(InputError):
            self._workbench.session.move_velocity({self._axis: 0.0}, permit=self._permit)

    def _renew(self) -> None:
        session, speeds, permit = self._workbench.session, {self._axis: self._speed}, self._permit
        if not self._held():
            self.end()
        elif not self._workbench.ask(lambda: session.move_velocity(speeds, permit=permit)):
            self.end()  # the reason is told once

    def _held(self) -> bool:
        button = self._button
        return (
            button is not None
            and self._permit is not None
            and self._permit.valid
            and button.isDown()
            and button.isEnabled()
            and button.isActiveWindow()
            and QGuiApplication.applicationState() is Qt.ApplicationState.ApplicationActive
            # A dock behind another one is not hidden for Qt, only moved away.
            and not button.visibleRegion().isEmpty()
            and QGuiApplication.keyboardModifiers() == self._modifiers
            and QApplication.activePopupWidget() is None
            and QApplication.activeModalWidget() is None
            and (self._key_s is None or self._clock() - self._key_s <= REPEATED_S)
        )
