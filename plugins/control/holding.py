"""Hold-to-jog: an axis goes while its button is held, and by nothing else."""

from contextlib import suppress

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QPushButton

from rotemina.app.shell.workbench import Workbench
from rotemina.sim.errors import InputError

RENEW_MS = 50  # well within the lease of a speed


class Holding(QObject):
    """Renews the speed of one axis while a button is down.

    Release, loss of focus, another window, a modifier key, a dock that is hidden or a button that
    is locked end it; and so does a window that hangs, because nobody renews the lease then.
    """

    def __init__(self, workbench: Workbench, axis: str, parent: QObject) -> None:
        super().__init__(parent)
        self._workbench, self._axis = workbench, axis
        self._button: QPushButton | None = None
        self._speed = 0.0
        self._modifiers = Qt.KeyboardModifier.NoModifier
        self._renewing = QTimer(self, interval=RENEW_MS)
        self._renewing.timeout.connect(self._renew)

    @property
    def busy(self) -> bool:
        """Whether the axis is being driven."""
        return self._button is not None

    def begin(self, button: QPushButton, speed: float) -> None:
        """Go at a speed, m/s or rad/s, while the button is held."""
        self._button, self._speed = button, speed
        self._modifiers = QGuiApplication.keyboardModifiers()
        self._renewing.start()
        self._renew()

    def end(self) -> None:
        """Halt the axis."""
        if self._button is None:
            return
        self._button = None
        self._renewing.stop()
        with suppress(InputError):  # it is locked or another's by now; the lease ends by itself
            self._workbench.session.move_velocity({self._axis: 0.0})

    def _renew(self) -> None:
        session, speeds = self._workbench.session, {self._axis: self._speed}
        if not self._held():
            self.end()
        elif not self._workbench.ask(lambda: session.move_velocity(speeds)):
            self.end()  # the reason is told once

    def _held(self) -> bool:
        button = self._button
        return (
            button is not None
            and button.isDown()
            and button.isEnabled()
            and button.isActiveWindow()
            # A dock behind another one is not hidden for Qt, only moved away.
            and not button.visibleRegion().isEmpty()
            and QGuiApplication.keyboardModifiers() == self._modifiers
        )
