"""Hold-to-jog: an axis moves only while its button is held."""

import time
from contextlib import suppress

from PySide6.QtCore import QEvent, QObject, Qt, QTimer
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QPushButton

from rotemina.app.workbench import Workbench
from rotemina.drivers.contract import Clock, Permit
from rotemina.sim.errors import InputError

# The interval at which the commanded speed is renewed. It is much shorter than the time for which
# a commanded speed stays valid.
RENEW_INTERVAL_MS = 50
# A key that has not repeated for this long counts as released: its release event may be lost.
MAX_KEY_REPEAT_GAP_S = 1.0


class HoldToJog(QObject):
    """Motion of one axis while a button is held.

    A commanded speed is valid only for a short time (a lease) and is renewed while the button is
    down. The motion ends

    - when the button is released, disabled or hidden,
    - when the machine is stopped; the button must then be pressed again,
    - when another window or program, a menu, a dialog or a locked screen takes the focus,
    - when a modifier key is pressed or released,
    - when a key stops repeating, because its release may have been lost,
    - when the window hangs, because the lease is then not renewed.
    """

    def __init__(
        self, workbench: Workbench, axis: str, parent: QObject, clock: Clock = time.monotonic
    ) -> None:
        super().__init__(parent)
        self._workbench, self._axis = workbench, axis
        self._button: QPushButton | None = None
        self._speed, self._clock = 0.0, clock
        # The permit issued at the press: a later stop makes it invalid.
        self._permit: Permit | None = None
        # Time of the last key press, including automatic repeats; None if the mouse was used.
        self._last_key_s: float | None = None
        self._modifiers = Qt.KeyboardModifier.NoModifier
        self._renew_timer = QTimer(self, interval=RENEW_INTERVAL_MS)
        self._renew_timer.timeout.connect(self._renew_speed)

    @property
    def is_active(self) -> bool:
        """Whether the axis is being moved."""
        return self._button is not None

    def watch_button(self, button: QPushButton) -> None:
        """Watch whether a button is pressed by a key or by the mouse. Call it once per button."""
        button.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Note how the button is held. A held key repeats its press, and the mouse does not."""
        if event.type() == QEvent.Type.KeyPress:
            self._last_key_s = self._clock()
        elif event.type() == QEvent.Type.MouseButtonPress:
            self._last_key_s = None
        return False

    def begin(self, button: QPushButton, speed: float) -> None:
        """Move at a speed, m/s or rad/s, while the button is held."""
        self._button, self._speed = button, speed
        self._permit = self._workbench.session.permit()
        self._modifiers = QGuiApplication.keyboardModifiers()
        self._renew_timer.start()
        self._renew_speed()

    def end(self) -> None:
        """Stop the axis if it is being moved."""
        if self._button is None:
            return
        self._button = None
        self._renew_timer.stop()
        # The command is refused if the axis has been stopped, locked or reserved by another owner
        # in the meantime. The lease then expires by itself.
        with suppress(InputError):
            self._workbench.session.move_velocity({self._axis: 0.0}, permit=self._permit)

    def _renew_speed(self) -> None:
        session, speeds, permit = self._workbench.session, {self._axis: self._speed}, self._permit
        if not self._is_held():
            self.end()
        elif not self._workbench.run_request(lambda: session.move_velocity(speeds, permit=permit)):
            # End at the first refusal, so that its reason is reported only once.
            self.end()

    def _is_held(self) -> bool:
        button = self._button
        return (
            button is not None
            and self._permit is not None
            and self._permit.is_valid
            and button.isDown()
            and button.isEnabled()
            and button.isActiveWindow()
            and QGuiApplication.applicationState() is Qt.ApplicationState.ApplicationActive
            # Qt does not hide a dock that is behind another tab, but moves it out of view.
            and not button.visibleRegion().isEmpty()
            and QGuiApplication.keyboardModifiers() == self._modifiers
            and QApplication.activePopupWidget() is None
            and QApplication.activeModalWidget() is None
            and (
                self._last_key_s is None or self._clock() - self._last_key_s <= MAX_KEY_REPEAT_GAP_S
            )
        )
