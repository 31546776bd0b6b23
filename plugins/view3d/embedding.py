"""The view inside the window: drawn by a process of its own, whose window stands in ours.

A browser engine has no place in the process that stops a machine: what crashes, hangs or is ended
by its own sandbox there is that process alone. (PySide6 6.11 moreover crashes within itself when an
event filter of the whole application, as the one for Esc, meets an object of Qt WebEngine.)
"""

import os
import sys
from collections.abc import Mapping
from importlib.util import find_spec

from PySide6.QtCore import QObject, QProcess, QTimer, Signal
from PySide6.QtGui import QGuiApplication, QWindow
from PySide6.QtWidgets import QWidget

from rotemina.app.shell.language import translate

_COMMAND = ("-m", "rotemina.plugins.view3d.web_window")
_FRAMELESS = "--frameless"
_UNSAFE = "QTWEBENGINE_DISABLE_SANDBOX"
# Where it was seen that keys stay with our window: elsewhere the view keeps a window of its own.
_ADOPTING = ("xcb",)
_ENDING_MS = 2000
_SAYINGS = {"loaded": "loaded", "stop": "stop_asked", "latch": "latch_asked"}


def why_not(environment: Mapping[str, str], user: int | None) -> str | None:
    """Return why no view can stand in the window, or None.

    ``user`` is the number of the user under Unix: as root, Qt WebEngine ends at once.
    """
    if find_spec("PySide6.QtWebEngineWidgets") is None:
        return translate(
            "view3d",
            "Qt WebEngine, which displays the view inside the window, is not installed."
            " Install it with  pip install 'rotemina[view3d]'  or use the browser.",
        )
    if user == 0 and environment.get(_UNSAFE) != "1":
        return translate("view3d", "Qt WebEngine does not run for the user root. Use the browser.")
    return None


def user_number() -> int | None:
    """Return the number of the user under Unix, None elsewhere."""
    return os.geteuid() if hasattr(os, "geteuid") else None


class WebProcess(QObject):
    """Shows one address by Qt WebEngine until released.

    Signals
    -------
    made(QWidget or None) : its window, to be put into ours; None where it stays one of its own.
    loaded() : the page has come.
    ended(str) : it broke off, and why; not after :meth:`release`.
    stop_asked(), latch_asked() : Esc or Shift+Esc was pressed in it.
    """

    made = Signal(object)
    loaded = Signal()
    ended = Signal(str)
    stop_asked = Signal()
    latch_asked = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._adopting = QGuiApplication.platformName() in _ADOPTING
        self._widget: QWidget | None = None
        self._process = QProcess(self)
        self._process.setProcessChannelMode(QProcess.ProcessChannelMode.ForwardedErrorChannel)
        self._process.readyReadStandardOutput.connect(self._hear)
        self._process.finished.connect(self._finish)
        self._process.errorOccurred.connect(self._fail)

    def start(self, url: str) -> None:
        """Begin to show an address."""
        frame = [_FRAMELESS] if self._adopting else []
        arguments = [*_COMMAND, translate("view3d", "RoTeMiNa 3-D view"), *frame]
        self._process.start(sys.executable, arguments)
        self._process.write(f"{url}\n".encode())

    def release(self, wait: bool = False) -> None:
        """End the process, by force if it must be; ``wait`` until then where the program ends."""
        self.blockSignals(True)
        if self._widget is not None:
            self._widget.deleteLater()
            self._widget = None
        process = self._process
        process.finished.connect(self.deleteLater)
        process.closeWriteChannel()
        if process.state() == QProcess.ProcessState.NotRunning:
            self.deleteLater()
        elif not wait:
            QTimer.singleShot(_ENDING_MS, process, process.kill)
        elif not process.waitForFinished(_ENDING_MS):
            process.kill()
            process.waitForFinished(_ENDING_MS)

    def _hear(self) -> None:
        while self._process.canReadLine():
            word, *rest = bytes(self._process.readLine().data()).decode().split() or [""]
            if word == "window":
                self._adopt(int(rest[0]))
            elif word == "failed":
                self.ended.emit(translate("view3d", "the page was not loaded"))
            elif word in _SAYINGS:
                getattr(self, _SAYINGS[word]).emit()

    def _adopt(self, number: int) -> None:
        if self._adopting:
            window = QWindow.fromWinId(number)
            self._widget = QWidget.createWindowContainer(window)
        self.made.emit(self._widget)

    def _finish(self, code: int, _: QProcess.ExitStatus) -> None:
        self.ended.emit(translate("view3d", "exit status {code}").format(code=code))

    def _fail(self, error: QProcess.ProcessError) -> None:
        if error == QProcess.ProcessError.FailedToStart:
            self.ended.emit(self._process.errorString())
