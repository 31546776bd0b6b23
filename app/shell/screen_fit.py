"""Keeps a window, with its frame, within the screen that it is on."""

from PySide6.QtCore import QObject, QPoint, QSize, Qt, QTimer
from PySide6.QtGui import QScreen
from PySide6.QtWidgets import QStyle, QWidget

#: px: the window's least size. What is in it has to do with that, and never makes it larger.
LEAST = QSize(800, 600)
WHOLE_SCREEN = Qt.WindowState.WindowMaximized | Qt.WindowState.WindowFullScreen


def fit_on_screen(window: QWidget, *, move: bool = True) -> None:
    """Make a window no larger than the room on its screen, and move it there.

    One that takes the whole screen is left as it is.
    """
    room = window.screen().availableGeometry()
    frame = _frame(window)
    most = room.size() - frame
    window.setMinimumSize(LEAST.boundedTo(most))
    if window.windowState() & WHOLE_SCREEN:
        return
    size = window.size().boundedTo(most)
    if size != window.size():
        window.resize(size)
    free = most - size
    at = window.pos() - room.topLeft()
    to = QPoint(max(min(at.x(), free.width()), 0), max(min(at.y(), free.height()), 0))
    if move and to != at:
        window.move(to + room.topLeft())


def _frame(window: QWidget) -> QSize:
    """Return what the window's frame takes; until there is one, what a title bar takes."""
    frame = window.frameGeometry().size() - window.size()
    if frame.isNull() and not window.isVisible():
        return QSize(0, window.style().pixelMetric(QStyle.PixelMetric.PM_TitleBarHeight))
    return frame


class ScreenFit(QObject):
    """Fits a window on its screen once it is shown, is on another one, or that one changes."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._screen: QScreen | None = None
        # Not at once: the desktop gives a window its frame a little later.
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(lambda: fit_on_screen(window))

    def fit_soon(self) -> None:
        """Fit the window, which is shown or takes the whole screen no longer."""
        handle = self._window.windowHandle()
        if handle is not None and self._screen is None:
            handle.screenChanged.connect(self._use)
            self._use(handle.screen())
        self._soon.start()

    def _use(self, screen: QScreen) -> None:
        """Fit the window on another screen; it is not moved, as it may just be dragged there."""
        if self._screen is not None:
            self._screen.availableGeometryChanged.disconnect(self._soon.start)
        screen.availableGeometryChanged.connect(self._soon.start)
        self._screen = screen
        fit_on_screen(self._window, move=False)
